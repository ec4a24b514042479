//! For tests: the structure of what is read, in a notation of its own.

use super::{Invariant, Name, Names, Tree, read_expression, read_name};

/// The vocabulary of the tests.
pub(super) fn names() -> Names {
    let plain = Names::default();
    let name = |tex: &str| read_name(tex, &plain).unwrap();
    let functions = ["f", "F_1", "Z", r"\dot{Z}"];
    let base = "DP".to_owned();
    Names {
        functions: functions.into_iter().map(name).collect(),
        words: vec!["eta".into(), "et".into()],
        matrices: vec![Name {
            base,
            ..Name::default()
        }],
        ..Names::default()
    }
}

/// The structure of `tex`; where it cannot be read, the message.
pub(super) fn shape(tex: &str) -> String {
    match read_expression(tex, &names()) {
        Ok(tree) => nested(&tree),
        Err(error) => error.to_string(),
    }
}

/// Checks that each spelling has the structure beside it.
pub(super) fn check(spellings: &[(&str, &str)]) {
    for (tex, wanted) in spellings {
        assert_eq!(shape(tex), *wanted, "{tex}");
    }
}

/// Checks that none of these is read, and that each message holds what is beside it.
pub(super) fn refuse(spellings: &[(&str, &str)]) {
    for (tex, wanted) in spellings {
        let error = read_expression(tex, &names()).expect_err(tex);
        assert!(error.to_string().contains(wanted), "{tex}: {error}");
    }
}

fn nested(tree: &Tree) -> String {
    let all = |sign: &str, parts: &[Tree]| {
        let parts: Vec<String> = parts.iter().map(nested).collect();
        format!("({sign} {})", parts.join(" "))
    };
    match tree {
        Tree::Number(value) => value.to_string(),
        Tree::Symbol(name, _) => name.to_string(),
        Tree::Call(name, argument, _) => format!("<{name} {}>", nested(argument)),
        Tree::Partial { of, by, .. } => format!("d({of})/d({by})"),
        Tree::Invariant {
            kind: Invariant::Trace,
            of,
            ..
        } => format!("trace({of})"),
        Tree::Invariant { of, .. } => format!("determinant({of})"),
        Tree::Negate(body) => format!("(- {})", nested(body)),
        Tree::Sum(terms) => all("+", terms),
        Tree::Product(factors) => all("*", factors),
        Tree::Quotient(above, below, _) => format!("(/ {} {})", nested(above), nested(below)),
        Tree::Power(base, exponent, _) => format!("(^ {} {exponent})", nested(base)),
        Tree::RealPower(base, exponent, _) => format!("(^^ {} {})", nested(base), nested(exponent)),
        Tree::Root(radicand, 2, _) => format!("(sqrt {})", nested(radicand)),
        Tree::Root(radicand, index, _) => format!("(root {} {index})", nested(radicand)),
        Tree::PlusMinus(body) => format!("(+- {})", nested(body)),
        Tree::MinusPlus(body) => format!("(-+ {})", nested(body)),
        Tree::Operation(..) => format!("[{tree}]"),
    }
}
