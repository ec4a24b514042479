//! Statements from sheets, and certificates and witnesses made by hand.

use vibro_audit::claim::{Question, Sheet, Statements, Unreadable, questions, vocabulary};
use vibro_audit::kernel::{
    Axiom, Certificate, Elementary, Function, Given, Inference, LawSource, Node, Polynomial, Property, Refusal,
    Statement, Symbol, Term, With, Witness, follows, refute,
};

/// A sheet with these lines under `[symbols]`, premises, and one claim.
pub fn sheet(symbols: &str, premises: &[&str], claim: &str) -> String {
    let mut text = format!("[symbols]\n{symbols}\n");
    for (number, premise) in premises.iter().enumerate() {
        // what follows a bar are more keys of the entry
        let (tex, more) = premise.split_once(" | ").unwrap_or((premise, ""));
        text += &format!("[[equation]]\nlabel = \"p{number}\"\nrole = \"premise\"\ntex = '''{tex}'''\n{more}\n");
    }
    let labels: Vec<String> = (0..premises.len()).map(|number| format!("\"p{number}\"")).collect();
    let (tex, more) = claim.split_once(" | ").unwrap_or((claim, ""));
    text += &format!(
        "[[equation]]\nlabel = \"c\"\nrole = \"claim\"\ntex = '''{tex}'''\nfollows_from = [{}]\n{more}\n",
        labels.join(", ")
    );
    text
}

/// The questions of the only claim.
pub fn read(symbols: &str, premises: &[&str], claim: &str) -> Result<Vec<Question>, Unreadable> {
    read_sheet(&sheet(symbols, premises, claim))
}

/// The questions of the only claim of a sheet.
pub fn read_sheet(text: &str) -> Result<Vec<Question>, Unreadable> {
    let sheet = Sheet::read(text, &vocabulary().unwrap()).unwrap();
    let position = (0..sheet.entries.len()).find(|&n| sheet.is_claim(n)).unwrap();
    let statements = Statements::gather(&sheet, position).unwrap();
    questions(&statements, &sheet.symbols)
}

/// The statement of the only claim.
pub fn statement(symbols: &str, premises: &[&str], claim: &str) -> Statement {
    read(symbols, premises, claim).unwrap().remove(0).statement
}

/// The symbol that is printed like this.
pub fn symbol(statement: &Statement, printed: &str) -> Symbol {
    let number = (0..statement.terms().symbols()).find(|&n| {
        let n = u32::try_from(n).unwrap();
        statement.terms().symbol_name(Symbol(n)) == printed
    });
    Symbol(u32::try_from(number.unwrap_or_else(|| panic!("{printed} in {}", names(statement)))).unwrap())
}

fn names(statement: &Statement) -> String {
    let symbols = 0..u32::try_from(statement.terms().symbols()).unwrap();
    let names: Vec<&str> = symbols.map(|n| statement.terms().symbol_name(Symbol(n))).collect();
    names.join(" ")
}

/// The symbol as a term.
pub fn of(statement: &mut Statement, printed: &str) -> Term {
    let symbol = symbol(statement, printed);
    statement.terms_mut().symbol(symbol)
}

/// The unknown function that is printed like this.
pub fn function(statement: &Statement, printed: &str) -> Function {
    let number = (0..statement.functions().len()).find(|&n| {
        let n = u32::try_from(n).unwrap();
        statement.terms().function_name(Function(n)) == printed
    });
    Function(u32::try_from(number.unwrap_or_else(|| panic!("no function {printed}"))).unwrap())
}

/// An integer as a term.
pub fn integer(statement: &mut Statement, value: i64) -> Term {
    statement.terms_mut().integer(value)
}

/// A generator.
pub fn generator(term: Term) -> Polynomial {
    Polynomial::generator(term)
}

/// `target` is 0 as a combination of facts.
pub fn zero(target: Polynomial, terms: Vec<(Polynomial, usize)>) -> Inference {
    Inference::Zero {
        target,
        power: 1,
        squares: Vec::new(),
        factors: Vec::new(),
        terms,
    }
}

/// `target` is 0, as is what is multiplied by facts that are not.
pub fn zero_after(target: Polynomial, factors: Vec<(usize, u32)>, terms: Vec<(Polynomial, usize)>) -> Inference {
    Inference::Zero {
        target,
        power: 1,
        squares: Vec::new(),
        factors,
        terms,
    }
}

/// An instance of the given law.
pub fn law(given: usize, shift: i32, at: Option<Term>) -> Inference {
    Inference::Law {
        source: LawSource::Given { given, shift },
        at,
    }
}

/// The number of the given with this label that is a law, or not.
pub fn given(statement: &Statement, label: &str, is_law: bool) -> usize {
    let found = statement
        .givens()
        .iter()
        .position(|given| given.origin.to_string() == label && given.law.is_some() == is_law);
    found.unwrap_or_else(|| panic!("{label}: {:#?}", statement.givens()))
}

/// An instance of an axiom as a step.
pub fn axiom(name: &'static str, terms: &[Term]) -> Inference {
    let terms = terms.to_vec();
    Inference::Axiom(Axiom { name, terms })
}

/// An axiom of the argument of a function, of a root or of a power, given by its value; `ArcAbove` and `ArcBelow` are those of
/// the inverse function that the value is one of.
pub fn of_value(name: &'static str, value: Term, own: &mut Statement) -> Inference {
    match own.terms().node(value).clone() {
        Node::Elementary(Elementary::Root(index), of) => {
            let index = own.terms_mut().integer(i64::from(index));
            axiom(name, &[index, of])
        }
        Node::Elementary(function, of) => {
            let own_function = match (name, function) {
                ("ArcAbove", Elementary::Arcsin) => "ArcsinAbove",
                ("ArcAbove", Elementary::Arccos) => "ArccosAbove",
                ("ArcAbove", _) => "ArctanAbove",
                ("ArcBelow", Elementary::Arcsin) => "ArcsinBelow",
                ("ArcBelow", Elementary::Arccos) => "ArccosBelow",
                ("ArcBelow", _) => "ArctanBelow",
                _ => name,
            };
            axiom(own_function, &[of])
        }
        Node::RealPower(base, exponent) => match own.is_complex() {
            true => axiom("ComplexPower", &[base, exponent]),
            false => axiom("RealPower", &[base, exponent]),
        },
        _ => axiom(name, &[value]),
    }
}

/// The step that a root is a value.
pub fn unique_root(root: Term, value: Term, own: &mut Statement) -> Inference {
    let Node::Elementary(Elementary::Root(index), of) = own.terms().node(root).clone() else {
        panic!("no root")
    };
    let terms = [own.terms_mut().integer(i64::from(index)), of, value];
    match index % 2 == 0 || own.is_complex() {
        true => axiom("RootUnique", &terms),
        false => axiom("OddRootUnique", &terms),
    }
}

/// An integer power whose exponent is written out.
pub fn integer_power(power: Term, exponent: i32, own: &mut Statement) -> Inference {
    let Node::RealPower(base, of) = own.terms().node(power).clone() else {
        panic!("no power")
    };
    let terms = [base, of, own.terms_mut().integer(i64::from(exponent).abs())];
    match exponent < 0 {
        true => axiom("NegativePower", &terms),
        false => axiom("IntegerPower", &terms),
    }
}

/// An integer power as the product of those to the parts of its exponent, of a base that is given not to be 0.
pub fn power_of_sum(power: Term, [a, b]: [Term; 2], own: &mut Statement) -> Inference {
    let Node::RealPower(base, exponent) = own.terms().node(power).clone() else {
        panic!("no power")
    };
    axiom("NonzeroPowerOfSum", &[base, exponent, a, b])
}

/// An integer power of a product as the product of those of its factors, of factors that are given not to be
/// 0, else with an exponent that is given not to be negative.
pub fn power_of_product(power: Term, [a, b]: [Term; 2], own: &mut Statement) -> Inference {
    let Node::RealPower(base, exponent) = own.terms().node(power).clone() else {
        panic!("no power")
    };
    let is_nonzero = |given: &Given| matches!(given.property, Property::Nonzero | Property::Positive);
    match own.givens().iter().any(is_nonzero) {
        true => axiom("NonzeroPowerOfProduct", &[base, a, b, exponent]),
        false => axiom("PowerOfProduct", &[base, a, b, exponent]),
    }
}

/// What comes of a certificate made by `forge`.
pub fn accepts(statement: &Statement, forge: impl FnOnce(&mut Statement) -> Vec<Inference>) -> Result<(), Refusal> {
    accepts_whole(statement, |own| (Vec::new(), forge(own)))
}

/// What comes of a certificate with whole terms.
pub fn accepts_whole(
    statement: &Statement,
    forge: impl FnOnce(&mut Statement) -> (Vec<Term>, Vec<Inference>),
) -> Result<(), Refusal> {
    let mut own = statement.clone();
    let (whole, steps) = forge(&mut own);
    follows(&With {
        statement: own,
        evidence: Certificate { whole, steps },
    })
}

/// What comes of a counterexample made by `forge`.
pub fn refutes(statement: &Statement, forge: impl FnOnce(&mut Statement) -> Witness) -> Result<(), Refusal> {
    let mut own = statement.clone();
    let evidence = forge(&mut own);
    refute(
        statement,
        &With {
            statement: own,
            evidence,
        },
    )
    .map(|_| ())
}

/// A sample of integers by names.
pub fn sample(statement: &mut Statement, values: &[(&str, i64)]) -> Vec<(Symbol, Term)> {
    let pairs = values.iter().map(|&(name, value)| {
        let value = integer(statement, value);
        (symbol(statement, name), value)
    });
    pairs.collect()
}
