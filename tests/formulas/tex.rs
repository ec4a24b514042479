//! The reader and the printer of TeX: every formula of the paper, every spelling, and what no input may do.

use crate::common;

use common::formulas::{PAPER, names};
use common::trees::{Hashed, equation, flat, tree};
use proptest::prelude::*;
use vibro_audit::tex::{Equation, ReadError, Reason, Tree, evaluate, read, read_conditions, read_expression};

fn equations(tex: &str) -> Vec<Equation> {
    read(tex, &names()).unwrap_or_else(|error| panic!("{error}\n{}", error.caret(tex)))
}

#[test]
fn the_papers_formulas_are_read_as_printed() {
    for (label, count, tex) in PAPER {
        let equations = equations(tex);
        assert_eq!(equations.len(), *count, "({label})");
        for equation in equations {
            let at = tex.get(equation.at.0..equation.end.0).expect("a place in the formula");
            assert!(at.contains('=') && !at.ends_with([',', '.']), "({label}) {at}");
            assert_prints(&[equation]);
        }
    }
}

#[test]
fn the_papers_formulas_mean_what_they_say() {
    let printed = |label: &str| -> Vec<String> {
        let formulas = PAPER.iter().filter(|(known, ..)| *known == label);
        formulas
            .flat_map(|(_, _, tex)| equations(tex))
            .map(|equation| equation.to_string())
            .collect()
    };
    assert_eq!(
        printed("3"),
        [r"\dot{Z}(t) = -r \dot{Z}^-(t_k) + \overline{g} \cdot (t - t_k) + F_1(t) - F_1(t_k)"]
    );
    assert_eq!(
        printed("10"),
        [r"-d = -r_B \dot{Z}_k T_1 + \frac{\overline{g}}{2} T_1^2 + F_2(t_{k+1}) - F_2(t_k) - F_1(t_k) T_1"]
    );
    assert_eq!(
        printed("19"),
        [
            r"\lambda_{1,2} = \frac{Tr(DP) \pm \sqrt{\Delta}}{2}",
            r"\Delta = Tr(DP)^2 - 4 Det(DP)"
        ]
        .map(|tex| tex.replace("Tr(DP)^2", "[Tr(DP)]^2"))
    );
    assert_eq!(printed("13")[3], "f(t) = f(t + T)");
    assert_eq!(printed("20").len(), 4);
    assert!(matches!(
        equations(PAPER.last().expect("a formula").2)[0].left,
        Tree::Symbol(..)
    ));
}

/// What was read prints as TeX that reads as the same, and prints the same again.
fn assert_prints(equations: &[Equation]) {
    for equation in equations {
        let printed = equation.to_string();
        let again = read(&printed, &names()).unwrap_or_else(|error| panic!("{error}\n{}", error.caret(&printed)));
        assert_eq!(again, std::slice::from_ref(equation), "{printed}");
        assert_eq!(again[0].to_string(), printed);
    }
}

#[test]
fn a_product_behind_a_quotient_with_a_function_prints_with_a_dot() {
    assert_safe(r"U_k = \left[\frac{A_k}f{\pi R_c^2}\right]^2 d");
    let read = read(r"U_k = \left[\frac{A_k}f{\pi R_c^2}\right]^2 d", &names()).unwrap();
    assert!(
        read[0].to_string().contains(r"\frac{A_k}{f} \cdot (\pi R_c^2)"),
        "{}",
        read[0]
    );
}

/// Reading ends with a value or an error, and an error can be shown.
fn assert_safe(tex: &str) {
    match read(tex, &names()) {
        Ok(equations) => assert_prints(&equations),
        Err(error) => {
            assert!(error.at <= tex.len() && tex.is_char_boundary(error.at));
            assert!(error.caret(tex).ends_with('^'));
        }
    }
    if let Err(error) = read_conditions(tex, &names()) {
        assert!(error.caret(tex).ends_with('^'));
    }
    if let Ok(tree) = read_expression(tex, &names()) {
        let printed = tree.to_string();
        match read_expression(&printed, &names()) {
            // A long chain of slashes is flat as read and deep as printed.
            Err(error) => assert!(matches!(error.reason, Reason::TooDeep { .. }), "{tex}: {error}"),
            Ok(again) => assert!(again == tree, "{tex} printed as {printed}"),
        }
    }
}

#[test]
fn deep_input_is_an_error_and_no_overflow() {
    for unit in [
        "(",
        "[",
        "{",
        "-",
        r"\frac{",
        r"\frac12{",
        r"\left(",
        "x^{",
        r"\dot{",
        "f(",
        "a/",
        "a-b c(",
        "Tr(DP(",
        "|",
        "|-",
        r"\left|",
        r"\sqrt[3]{",
        "x^{a",
        "x^{-|",
        r"x^{1/",
        r"\sin^{a}(",
        "1/2(",
    ] {
        for count in [90, 99, 101, 300, 99_000 / unit.len(), 100_000] {
            let tex = unit.repeat(count);
            assert!(read(&tex, &names()).is_err(), "{unit} {count}");
            let close = match unit.chars().last() {
                Some('(') => ")",
                Some('[') => "]",
                Some('{') => "}",
                _ if unit == r"\left|" => r"\right|",
                _ if unit == "x^{a" => "}",
                Some('|') => "|",
                _ => "",
            };
            let closed = format!("{tex}a{}", close.repeat(count));
            assert_safe(&closed);
            if let Ok(tree) = read_expression(&closed, &names()) {
                assert!(evaluate(&tree, &mut Hashed).is_ok(), "{unit} {count}");
            }
        }
    }
}

#[test]
fn long_input_is_read_or_refused_soon() {
    let start = std::time::Instant::now();
    for (unit, count) in [
        ("+a", 49_000),
        ("+a", 100_000),
        ("+|a|", 24_000),
        ("|a|", 33_000),
        ("+a^{b}", 16_000),
        ("a^{b c d e f g h}", 5_000),
        ("<a", 40_000),
        ("x,", 49_000),
        ("a^{9^{9^{9^9}}}", 5_000),
        ("(|a|)", 19_000),
        ("a/2b", 24_000),
    ] {
        let tex = format!("a{}", unit.repeat(count));
        let read =
            read(&tex, &names()).map(|equations| equations.iter().map(|equation| equation.to_string().len()).sum());
        let expression = read_expression(&tex, &names()).map(|tree| tree.to_string().len());
        assert!(read.is_err() || expression.is_err(), "{unit}");
        for length in [read, expression].into_iter().flatten() {
            assert!(length < 1_000_000, "{unit}: {length}");
        }
    }
    // Nothing here is computed or searched: a megabyte is read and printed.
    assert!(start.elapsed().as_secs() < 60, "{:?}", start.elapsed());
}

#[test]
fn towers_of_powers_are_read_and_not_computed() {
    let tree = read_expression("x^{9^{9^9}}", &names()).expect("a formula");
    assert_eq!(tree.to_string(), "x^{9^{9^9}}");
    let Tree::RealPower(_, exponent, _) = tree else {
        panic!("{tree}");
    };
    assert!(matches!(*exponent, Tree::RealPower(..)));
}

/// Pairs of spellings that mean the same, in the formulas of the paper.
const RESPELLINGS: &[(&str, &str)] = &[
    ("(", r"\left("),
    (")", r"\Bigr)"),
    (r"\frac{", r"\dfrac{"),
    (r"\frac{1}{", r"\frac1{"),
    (" ", r" \, "),
    (" ", "\n"),
    ("r_B", "r_{B}"),
    ("r_B ", r"r_{\mathrm{B}}"),
    ("r_T T_2", r"r_T \cdot T_2"),
    ("r_B T_1", r"(r_B T_1)"),
    ("r_B \\dot", r"r_B\times\dot"),
    ("T_1^2", "T^2_1"),
    ("T_2^2", "{T_2}^{2}"),
    ("r_B^2", "(r_B)^2"),
    (r"\dot{Z}_k", r"{\dot Z}_k"),
    (r"\dot{Z}_{k+1}", r"\dot{Z_{1+k}}"),
    (r"\overline{g}", r"\bar g"),
    ("k+1", "{1} + k"),
    ("F_1", r"F_{\rm 1}"),
    ("Tr(DP)", r"\operatorname{tr}[DP]"),
    ("Det(DP)", r"\det DP"),
    (r"\epsilon", r"\varepsilon"),
    (
        r"\frac{\partial t_{k+1}}{\partial t_k}",
        r"(\partial t_{k+1}/\partial t_k)",
    ),
    ("-", "−"),
    ("=", r"&\equiv"),
];

fn respelled(tex: &str, chosen: &[bool]) -> String {
    let pairs = RESPELLINGS.iter().zip(chosen).filter(|(_, chosen)| **chosen);
    pairs.fold(tex.to_owned(), |tex, ((from, to), _)| tex.replace(from, to))
}

const SOUP: &[&str] = &[
    "a",
    "b",
    "T",
    "r",
    "T",
    "r",
    "f",
    "F_1",
    "Z",
    r"\dot",
    r"\dot{Z}",
    r"\bar",
    "_",
    "^",
    "{",
    "}",
    "{",
    "}",
    "(",
    ")",
    "(",
    ")",
    "[",
    "]",
    "+",
    "-",
    "=",
    "=",
    ",",
    r"\\",
    r"\qquad",
    r"\frac",
    r"\frac12",
    r"\sqrt",
    r"\partial",
    "/",
    r"\cdot",
    "*",
    "'",
    "2",
    "12",
    ".5",
    "0.26",
    "_k",
    "_{k+1}",
    "^2",
    "^n",
    "^{a b}",
    "^{ab}",
    "^{2/3}",
    "^{-",
    "e",
    "1e3",
    "|",
    "|",
    r"\left|",
    r"\right|",
    r"\lvert",
    r"\rvert",
    r"\sqrt[3]",
    r"\le",
    "<",
    r"\neq",
    r"\in",
    r"\mathbb{Z}",
    r"\infty",
    r"\operatorname{sgn}",
    r"\mathrm{T}",
    "^{-1}",
    "^-",
    "^{1/2}",
    r"\pm",
    r"\cos",
    "Tr",
    "(DP)",
    r"\det",
    r"\mathrm{Tr}",
    r"\text{and}",
    r"\left",
    r"\right",
    "eta",
    " ",
    r"\pi",
    r"\{",
    r"\}",
    "&",
    "%",
    "\n",
    ".",
    r"\frac{a}{b}",
    r"\frac{\partial a}{\partial b}",
    "{}",
    r"\lbrace",
    r"\sum",
    "é",
    "−",
];

/// Whether a product is refused because it prints as `(f + a)(b)`: with a function f, that may be a value of f + a.
fn may_be_an_operator(error: Option<&ReadError>) -> bool {
    error.is_some_and(|error| {
        error
            .to_string()
            .contains("a bracket after a function without argument")
    })
}

/// Returns true if the argument of a function contains the function, `f(f + a)`: it prints as a product.
fn takes_itself(tree: &Tree) -> bool {
    fn speaks(tree: &Tree, base: &str) -> bool {
        matches!(tree, Tree::Symbol(name, _) if name.base == base)
            || tree.find_below(&mut |part| speaks(part, base).then_some(())).is_some()
    }
    let is_own = match tree {
        Tree::Call(name, argument, _) => {
            matches!(**argument, Tree::Sum(_) | Tree::Product(_)) && speaks(argument, &name.base)
        }
        _ => false,
    };
    is_own || tree.find_below(&mut |part| takes_itself(part).then_some(())).is_some()
}

proptest! {
    // The cases are found anew in each run; a file of old failures would need its own folder.
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(512) })]

    #[test]
    fn trees_print_as_tex_that_reads_back(tree in tree()) {
        prop_assume!(!takes_itself(&tree));
        let printed = tree.to_string();
        let again = read_expression(&printed, &names());
        prop_assume!(!may_be_an_operator(again.as_ref().err()));
        prop_assert_eq!(again.as_ref(), Ok(&tree), "{}", printed);
        prop_assert_eq!(again.map(|tree| tree.to_string()), Ok(printed));
    }

    #[test]
    fn equations_print_as_tex_that_reads_back(equation in equation()) {
        prop_assume!(!takes_itself(&equation.left) && !takes_itself(&equation.right));
        let printed = equation.to_string();
        let again = read(&printed, &names());
        prop_assume!(!may_be_an_operator(again.as_ref().err()));
        prop_assert_eq!(again, Ok(vec![equation]), "{}", printed);
    }

    #[test]
    fn values_survive_printing(tree in tree()) {
        prop_assume!(!takes_itself(&tree));
        let again = read_expression(&tree.to_string(), &names());
        prop_assume!(!may_be_an_operator(again.as_ref().err()));
        let again = again.expect("a formula");
        let value = |tree: &Tree| evaluate(tree, &mut Hashed).map_err(|error| error.to_string());
        prop_assert_eq!(value(&tree), value(&again));
    }

    #[test]
    fn respelled_formulas_are_the_same(formula in prop::sample::select(PAPER), chosen in prop::collection::vec(any::<bool>(), RESPELLINGS.len())) {
        let tex = respelled(formula.2, &chosen);
        let flat = |equations: Vec<Equation>| -> Vec<(Tree, Tree)> {
            equations.iter().map(|equation| (flat(&equation.left), flat(&equation.right))).collect()
        };
        let read = read(&tex, &names()).map_err(|error| TestCaseError::fail(format!("{error}\n{}", error.caret(&tex))))?;
        prop_assert_eq!(flat(read), flat(equations(formula.2)), "{}", tex);
    }

    #[test]
    fn any_text_is_safe(text in ".{0,60}") {
        assert_safe(&text);
    }

    #[test]
    fn any_bytes_are_safe(bytes in prop::collection::vec(any::<u8>(), 0..60)) {
        assert_safe(&String::from_utf8_lossy(&bytes));
    }

    #[test]
    fn a_soup_of_tokens_is_safe(tokens in prop::collection::vec(prop::sample::select(SOUP), 1..14)) {
        assert_safe(&tokens.concat());
    }

    #[test]
    fn damaged_formulas_are_safe(
        formula in prop::sample::select(PAPER),
        from in any::<prop::sample::Index>(),
        length in 0usize..4,
        insert in prop::sample::select(SOUP),
        end in any::<prop::sample::Index>(),
        cut in any::<bool>(),
    ) {
        let mut text: Vec<char> = formula.2.chars().collect();
        let from = from.index(text.len());
        let to = (from + length).min(text.len());
        text.splice(from..to, insert.chars());
        if cut {
            text.truncate(end.index(text.len() + 1));
        }
        assert_safe(&text.into_iter().collect::<String>());
    }
}
