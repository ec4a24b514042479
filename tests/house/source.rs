//! Rust source as a row of tokens, without comments and literals, and with what only tests see marked.

/// A token with the line it stands on, counted from 1.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Token {
    pub text: String,
    pub line: usize,
    /// Whether the token belongs to an item under `#[cfg(test)]`.
    pub test: bool,
}

/// The tokens of `text`: identifiers and numbers, `::` as one, every other sign on its own. Comments are left
/// out; a string or character becomes `""`.
pub fn tokens(text: &str) -> Vec<Token> {
    let mut reader = Reader {
        chars: text.chars().collect(),
        at: 0,
        line: 1,
        tokens: Vec::new(),
    };
    while reader.at < reader.chars.len() {
        reader.step();
    }
    mark_tests(&mut reader.tokens);
    reader.tokens
}

struct Reader {
    chars: Vec<char>,
    at: usize,
    line: usize,
    tokens: Vec<Token>,
}

impl Reader {
    fn peek(&self, ahead: usize) -> char {
        self.chars.get(self.at + ahead).copied().unwrap_or('\0')
    }

    fn advance(&mut self) {
        self.line += usize::from(self.peek(0) == '\n');
        self.at += 1;
    }

    fn push(&mut self, text: &str) {
        self.tokens.push(Token {
            text: text.to_owned(),
            line: self.line,
            test: false,
        });
    }

    fn step(&mut self) {
        match (self.peek(0), self.peek(1)) {
            ('/', '/') => self.skip_while(|c| c != '\n'),
            ('/', '*') => self.skip_block_comment(),
            (':', ':') => {
                self.push("::");
                self.at += 2;
            }
            ('"', _) => self.skip_string(),
            ('\'', _) => self.skip_char_or_lifetime(),
            (c, _) if c.is_alphanumeric() || c == '_' => self.word(),
            (c, _) => {
                if !c.is_whitespace() {
                    self.push(&c.to_string());
                }
                self.advance();
            }
        }
    }

    fn skip_while(&mut self, wanted: impl Fn(char) -> bool) {
        while self.at < self.chars.len() && wanted(self.peek(0)) {
            self.advance();
        }
    }

    fn skip_block_comment(&mut self) {
        let mut depth = 0_usize;
        while self.at < self.chars.len() {
            let change = (self.peek(0), self.peek(1));
            match change {
                ('/', '*') => depth += 1,
                ('*', '/') => depth -= 1,
                _ => {
                    self.advance();
                    continue;
                }
            }
            self.at += 2;
            if depth == 0 {
                return;
            }
        }
    }

    fn skip_string(&mut self) {
        self.push("\"\"");
        self.advance();
        while self.at < self.chars.len() && self.peek(0) != '"' {
            if self.peek(0) == '\\' {
                self.advance();
            }
            self.advance();
        }
        self.advance();
    }

    /// `r"..."`, `br#"..."#`: ends at a quote with as many `#` as it began with.
    fn skip_raw_string(&mut self, hashes: usize) {
        self.push("\"\"");
        self.at += hashes + 1;
        while self.at < self.chars.len() {
            let ends = self.peek(0) == '"' && (1..=hashes).all(|ahead| self.peek(ahead) == '#');
            self.advance();
            if ends {
                self.at += hashes;
                return;
            }
        }
    }

    fn skip_char_or_lifetime(&mut self) {
        if self.peek(1) == '\\' {
            self.push("\"\"");
            self.at += 3;
            self.skip_while(|c| c != '\'');
            self.advance();
        } else if self.peek(2) == '\'' {
            self.push("\"\"");
            self.advance();
            self.advance();
            self.advance();
        } else {
            self.advance();
        }
    }

    fn word(&mut self) {
        let start = self.at;
        self.skip_while(|c| c.is_alphanumeric() || c == '_');
        let word: String = self.chars[start..self.at].iter().collect();
        let hashes = (0..).take_while(|&ahead| self.peek(ahead) == '#').count();
        match word.as_str() {
            "r" | "br" | "cr" if self.peek(hashes) == '"' => self.skip_raw_string(hashes),
            "b" | "c" if self.peek(0) == '"' => self.skip_string(),
            // A raw identifier: `r#use` is no `use`.
            "r" if hashes == 1 => self.at += 1,
            _ => self.push(&word),
        }
    }
}

const CFG_TEST: [&str; 7] = ["#", "[", "cfg", "(", "test", ")", "]"];
const CFG_TEST_INNER: [&str; 8] = ["#", "!", "[", "cfg", "(", "test", ")", "]"];

fn stands_at(tokens: &[Token], at: usize, wanted: &[&str]) -> bool {
    tokens
        .get(at..at + wanted.len())
        .is_some_and(|found| found.iter().zip(wanted).all(|(a, b)| a.text == *b))
}

/// Marks each item under `#[cfg(test)]`, from the attribute to its closing brace or semicolon.
fn mark_tests(tokens: &mut [Token]) {
    if stands_at(tokens, 0, &CFG_TEST_INNER) {
        tokens.iter_mut().for_each(|token| token.test = true);
    }
    for start in 0..tokens.len() {
        if stands_at(tokens, start, &CFG_TEST) {
            let end = item_end(tokens, start + CFG_TEST.len());
            tokens[start..end].iter_mut().for_each(|token| token.test = true);
        }
    }
}

/// Where the item that begins at `start` is over: behind its outermost `}` or a `;` outside all brackets.
fn item_end(tokens: &[Token], start: usize) -> usize {
    let mut depth = 0_usize;
    for (index, token) in tokens.iter().enumerate().skip(start) {
        match token.text.as_str() {
            "{" | "(" | "[" => depth += 1,
            "}" | ")" | "]" => {
                depth = depth.saturating_sub(1);
                if depth == 0 && token.text == "}" {
                    return index + 1;
                }
            }
            ";" if depth == 0 => return index + 1,
            _ => {}
        }
    }
    tokens.len()
}

/// The modules that `path` declares for tests alone and keeps in files of their own: those files' paths.
pub fn test_files(path: &str, tokens: &[Token]) -> Vec<String> {
    let folder = module_folder(path);
    let declared = tokens
        .windows(3)
        .filter(|row| row[0].test && row[0].text == "mod" && row[2].text == ";");
    declared
        .flat_map(|row| {
            let name = &row[1].text;
            [format!("{folder}/{name}.rs"), format!("{folder}/{name}/mod.rs")]
        })
        .collect()
}

/// Where the child modules of the file at `path` stand.
fn module_folder(path: &str) -> String {
    let stem = path.strip_suffix(".rs").unwrap_or(path);
    let (folder, name) = stem.rsplit_once('/').unwrap_or(("", stem));
    if matches!(name, "mod" | "lib" | "main") {
        folder.to_owned()
    } else {
        stem.to_owned()
    }
}

#[test]
fn comments_strings_and_characters_hide_what_is_in_them() {
    let text = "a // crate::x\n/* b /* c */ d */ \"e \\\" f\" r#\"g \" h\"# 'i' '\\'' &'j k::l r#use b\"m\" '\"' n";
    let texts: Vec<String> = tokens(text).into_iter().map(|token| token.text).collect();
    assert_eq!(
        texts,
        [
            "a", "\"\"", "\"\"", "\"\"", "\"\"", "&", "j", "k", "::", "l", "use", "\"\"", "\"\"", "n"
        ]
    );
}

#[test]
fn lines_are_counted_through_comments_and_strings() {
    let found = tokens("/* 1\n2 */ \"3\n4\"\nlast");
    assert_eq!(
        found.last().map(|token| (token.text.as_str(), token.line)),
        Some(("last", 4))
    );
}

#[test]
fn only_the_item_under_cfg_test_is_marked() {
    let found = tokens("#[cfg(test)] use a::{b}; fn c() {} #[cfg(test)] mod d { fn e() {} } fn f() {}");
    let plain: Vec<&str> = found
        .iter()
        .filter(|token| !token.test)
        .map(|token| token.text.as_str())
        .collect();
    assert_eq!(plain.join(" "), "; fn c ( ) { } fn f ( ) { }");
}

#[test]
fn a_test_module_in_a_file_of_its_own_is_found() {
    let text = "#[cfg(test)]\nmod tests;\nmod other;";
    assert_eq!(
        test_files("src/tex/mod.rs", &tokens(text)),
        ["src/tex/tests.rs", "src/tex/tests/mod.rs"]
    );
    assert_eq!(test_files("src/tex/read.rs", &tokens(text))[0], "src/tex/read/tests.rs");
}
