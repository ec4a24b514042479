//! Nothing panics by its own word.

use super::File;
use super::source::{Token, test_files, tokens};

const METHODS: [&str; 4] = ["unwrap", "expect", "unwrap_err", "expect_err"];
const MACROS: [&str; 4] = ["panic", "todo", "unimplemented", "unreachable"];

/// Every call outside tests that gives up where an error should be returned.
pub fn check_panics(sources: &[File]) -> Vec<String> {
    let read: Vec<(&File, Vec<Token>)> = sources.iter().map(|file| (file, tokens(&file.text))).collect();
    let for_tests: Vec<String> = read
        .iter()
        .flat_map(|(file, tokens)| test_files(&file.path, tokens))
        .collect();
    let mut complaints = Vec::new();
    for (file, tokens) in read.iter().filter(|(file, _)| !for_tests.contains(&file.path)) {
        for (index, token) in tokens.iter().enumerate().filter(|(_, token)| !token.test) {
            let before = index.checked_sub(1).map_or("", |index| &tokens[index].text);
            let after = tokens.get(index + 1).map_or("", |token| &token.text);
            // A field named `expect` is no call; `Option::unwrap` handed to `map` is one.
            let method = METHODS.contains(&&*token.text) && (before == "::" || (before == "." && after == "("));
            let macro_call = MACROS.contains(&&*token.text) && after == "!";
            if method || macro_call {
                complaints.push(format!("{}:{}: `{}` outside tests", file.path, token.line, token.text));
            }
        }
    }
    complaints
}

#[test]
fn whatever_panics_is_found_outside_tests() {
    let broken = [
        "fn f() { x.unwrap() }",
        "fn f() { x\n    .expect(\"why\") }",
        "fn f() { x.map(Result::unwrap) }",
        "fn f() { panic!() }",
        "fn f() { todo!() }",
        "fn f() { unimplemented!() }",
        "fn f() { core::unreachable!(\"never\") }",
        "#[cfg(test)] mod tests {} fn f() { x.unwrap() }",
        "#[cfg(test)] use a::b; fn f() { x.unwrap_err() }",
        "#[cfg(not(test))] fn f() { x.unwrap() }",
    ];
    for text in broken {
        assert_eq!(check_panics(&[File::new("src/tex/read.rs", text)]).len(), 1, "{text}");
    }
}

#[test]
fn what_only_looks_like_a_panic_is_left_alone() {
    let right = [
        "// x.unwrap()\n/// x.unwrap();\nconst S: &str = \"panic!\";",
        "fn f() { x.unwrap_or(0); x.unwrap_or_default(); x.unwrap_or_else(g) }",
        "fn f() { claim.expect == Verdict::Proved }",
        "#[expect(clippy::x)] fn f() {}",
        "#[cfg(test)] mod tests { fn f() { x.unwrap(); panic!() } }",
    ];
    for text in right {
        assert!(check_panics(&[File::new("src/tex/read.rs", text)]).is_empty(), "{text}");
    }
}

#[test]
fn a_test_module_in_its_own_file_may_unwrap() {
    let test = File::new("src/tex/tests.rs", "fn f() { x.unwrap() }");
    let module = |text| File::new("src/tex/mod.rs", text);
    assert!(check_panics(&[module("#[cfg(test)] mod tests;"), test.clone()]).is_empty());
    assert_eq!(check_panics(&[module("mod tests;"), test]).len(), 1);
}
