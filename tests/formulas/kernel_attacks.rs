//! Certificates and witnesses made by hand to deceive the kernel: each would give a wrong verdict if it were accepted.

use num_traits::{One, Zero};
use vibro_audit::claim::{Sheet, Statements, vocabulary};
use vibro_audit::kernel::{
    Axiom, Certificate, Elementary, Evaluated, FunctionOf, Inference, LawSource, Node, Polynomial, Property, Quantity,
    Question, Statement, Symbol, Term, With, Witness, evaluate, follows, prove, questions, refute,
};
use vibro_audit::number::Rational;
use vibro_audit::tex::Name;

/// The first question of the last claim of a sheet.
fn question(text: &str) -> Question {
    all_questions(text).remove(0)
}

fn all_questions(text: &str) -> Vec<Question> {
    let sheet = Sheet::read(text, &vocabulary().unwrap()).unwrap();
    let position = *sheet.rows().last().unwrap();
    let statements = Statements::gather(&sheet, position).unwrap();
    questions(&statements, &sheet.symbols).unwrap()
}

fn symbol(statement: &Statement, printed: &str) -> Symbol {
    let all = (0..statement.terms().symbols()).map(|n| Symbol(n as u32));
    let mut found = all.filter(|symbol| statement.terms().symbol_name(*symbol) == printed);
    found.next().unwrap_or_else(|| panic!("no symbol {printed}"))
}

fn proof(statement: Statement, steps: Vec<Inference>) -> With<Certificate> {
    With {
        statement,
        evidence: Certificate {
            whole: Vec::new(),
            steps,
        },
    }
}

fn identity(target: Polynomial, fact: usize) -> Inference {
    Inference::Zero {
        target,
        power: 1,
        squares: Vec::new(),
        factors: Vec::new(),
        terms: vec![(Polynomial::integer(1), fact)],
    }
}

#[test]
fn there_is_no_imaginary_unit_among_real_numbers() {
    let asked =
        question("[symbols]\nparameters = ['x']\n[[equation]]\nlabel = \"1\"\nrole = \"claim\"\ntex = 'x = x + 1'\n");
    let mut statement = asked.statement.clone();
    let unit = statement.terms_mut().add(Node::Imaginary);
    let steps = vec![
        Inference::Axiom(Axiom::ImaginarySquare),
        Inference::Zero {
            target: Polynomial::integer(1),
            power: 2,
            squares: vec![(Rational::one(), Polynomial::generator(unit))],
            factors: Vec::new(),
            terms: vec![(Polynomial::integer(1), 0)],
        },
    ];
    assert!(follows(&proof(statement, steps)).is_err());
}

#[test]
fn a_principal_root_jumps_where_its_radicand_crosses_the_cut() {
    // ln(exp(i x)) = i x is false for x = 7, although both sides have the derivative i wherever that exists
    let asked = question(
        "[symbols]\nparameters = ['x', 'z']\ncomplex = ['z']\n[[equation]]\nlabel = \"1\"\nrole = \"claim\"\n\
         tex = '\\ln(\\exp(i x)) + z - z = i x'\n",
    );
    let mut statement = asked.statement.clone();
    let time = statement.fresh("s");
    let terms = statement.terms_mut();
    let (at, unit) = (terms.symbol(time), terms.add(Node::Imaginary));
    let angle = terms.product(vec![unit, at]);
    let power = terms.elementary(Elementary::Exp, angle);
    let logarithm = terms.elementary(Elementary::Ln, power);
    let of = terms.difference(logarithm, angle);
    let zero = terms.integer(0);
    let one = terms.integer(1);
    let nothing = terms.product(vec![unit, zero]);
    let x = symbol(&statement, "x");
    let x = statement.terms_mut().symbol(x);
    let terms = statement.terms_mut();
    let (at_nothing, ln_one) = (
        terms.elementary(Elementary::Exp, nothing),
        terms.elementary(Elementary::Ln, one),
    );
    let whole = terms.elementary(Elementary::Ln, at_nothing);
    let goal = statement.goal()[0].1;
    let _ = (ln_one, goal);
    let steps = vec![
        Inference::Constant {
            of,
            time,
            at: zero,
            flight: None,
            steps: vec![Inference::Axiom(Axiom::ExpNonzero(angle))],
        },
        Inference::Axiom(Axiom::ExpNonzero({
            let terms = statement.terms_mut();
            terms.product(vec![unit, x])
        })),
        // exp(i 0) = 1, ln exp(i 0) = i 0
        Inference::Axiom(Axiom::ExpOfZero(nothing)),
        Inference::Axiom(Axiom::ExpNonzero(nothing)),
        Inference::Law {
            source: LawSource::Derived(0),
            at: Some(x),
        },
    ];
    let result = follows(&proof(statement, steps));
    // all but the value of ln exp(i 0), which is 0 by ln(exp 0), is derived: the law itself must not be
    let refused = result.as_ref().err().map(ToString::to_string).unwrap_or_default();
    assert!(
        refused.contains("step 0"),
        "the derivative of a principal branch is taken across its cut: {refused:?} ({whole:?})"
    );
}

#[test]
fn a_number_with_a_complex_part_that_is_not_real_may_be_0() {
    // i sqrt(-1) = -1 is true
    let asked = question(
        "[symbols]\nparameters = ['z']\ncomplex = ['z']\n[[equation]]\nlabel = \"1\"\nrole = \"claim\"\n\
         tex = 'i \\sqrt{-1} + z = z - 1'\n",
    );
    let mut statement = asked.statement.clone();
    let zero = statement.terms_mut().integer(0);
    let z = symbol(&statement, "z");
    let witness = Witness {
        sample: vec![(z, zero)],
        ..Witness::default()
    };
    let with = With {
        statement,
        evidence: witness,
    };
    assert!(refute(&asked.statement, &with).is_err());
}

#[test]
fn a_derivative_of_a_derivative_is_not_free() {
    // f(t) = t^2, g = f', h = g': h(1) = 2
    let asked = question(
        "[symbols]\nparameters = ['x']\ntimes = ['t', 't_k']\nfunctions = { h = '', g = 'h', f = 'g' }\n\
         [[equation]]\nlabel = \"1\"\nrole = \"premise\"\ntex = 'f(t) = t^2'\n\
         [[equation]]\nlabel = \"2\"\nrole = \"claim\"\ntex = 'h(x) = 2'\nfollows_from = [\"1\"]\n",
    );
    let mut statement = asked.statement.clone();
    let line = |letter: &str| {
        FunctionOf::Line(Name {
            base: letter.into(),
            ..Name::default()
        })
    };
    let (f, h) = (statement.function_of(line("f")), statement.function_of(line("h")));
    let time = statement.fresh("s");
    let at = statement.terms_mut().symbol(time);
    let square = statement.terms_mut().add(Node::Power(at, 2));
    let (five, zero) = (statement.terms_mut().integer(5), statement.terms_mut().integer(0));
    let x = symbol(&statement, "x");
    let mut sample = vec![(x, zero)];
    if let Some(n) = statement.quantities().iter().position(|q| *q == Quantity::Running) {
        sample.push((Symbol(n as u32), zero));
    }
    let witness = Witness {
        sample,
        functions: vec![(f, time, square), (h, time, five)],
        ..Witness::default()
    };
    let with = With {
        statement,
        evidence: witness,
    };
    assert!(refute(&asked.statement, &with).is_err());
}

#[test]
fn a_law_holds_at_all_times_not_at_that_of_the_sample() {
    // f(t) = t^2 at all t: f(2) = 4
    let asked = question(
        "[symbols]\ntimes = ['t', 't_k']\nfunctions = { f = '' }\n\
         [[equation]]\nlabel = \"1\"\nrole = \"premise\"\ntex = 'f(t) = t^2'\n\
         [[equation]]\nlabel = \"2\"\nrole = \"claim\"\ntex = 'f(2) = 4'\nfollows_from = [\"1\"]\n",
    );
    let mut statement = asked.statement.clone();
    let f = statement.function_of(FunctionOf::Line(Name {
        base: "f".into(),
        ..Name::default()
    }));
    let time = statement.fresh("s");
    let at = statement.terms_mut().symbol(time);
    let one = statement.terms_mut().integer(1);
    let running = statement
        .quantities()
        .iter()
        .position(|q| *q == Quantity::Running)
        .unwrap();
    let witness = Witness {
        sample: vec![(Symbol(running as u32), one)],
        functions: vec![(f, time, at)],
        ..Witness::default()
    };
    let with = With {
        statement,
        evidence: witness,
    };
    assert!(refute(&asked.statement, &with).is_err());
}

#[test]
fn derivatives_along_a_map_are_not_free() {
    // y' = 2 x: its derivative by x is 2
    let asked = question(
        "[symbols]\nstates = ['x']\ntimes = ['t_k']\nmaps = { M = ['x_{k+1} = 2 x_k'] }\n\
         [[equation]]\nlabel = \"1\"\nrole = \"claim\"\ntex = '\\frac{\\partial x_{k+1}}{\\partial x_k} = 2'\n",
    );
    let mut statement = asked.statement.clone();
    let all = (0..statement.terms().symbols()).map(|n| Symbol(n as u32));
    let all: Vec<Symbol> = all.collect();
    let sample = all
        .into_iter()
        .map(|symbol| {
            let partial = matches!(statement.quantity(symbol), Some(Quantity::Partial { .. }));
            let value = if partial { 17 } else { 0 };
            (symbol, statement.terms_mut().integer(value))
        })
        .collect();
    let with = With {
        statement,
        evidence: Witness {
            sample,
            ..Witness::default()
        },
    };
    assert!(refute(&asked.statement, &with).is_err());
}

#[test]
fn a_law_of_a_derivative_along_a_map_moves_on_with_its_map() {
    // if the derivative of x_{n+1} by x_n is x_n at each n, x_n and x_{n+1} need not be equal
    let asked = question(
        "[symbols]\nindices = ['n']\nstates = ['x']\ntimes = ['t_n']\nmaps = { M = { of = ['x_{n+1}'], by = ['x_n'] } }\n\
         [[equation]]\nlabel = \"1\"\nrole = \"premise\"\ntex = '\\frac{\\partial x_{n+1}}{\\partial x_n} = x_n'\n\
         [[equation]]\nlabel = \"2\"\nrole = \"claim\"\ntex = 'x_n = x_{n+1}'\nfollows_from = [\"1\"]\n",
    );
    let statement = asked.statement.clone();
    let law = statement.givens().iter().position(|given| given.law.is_some()).unwrap();
    let at = |shift| Inference::Law {
        source: LawSource::Given { given: law, shift },
        at: None,
    };
    let steps = vec![at(0), at(1)];
    let (x, y) = (symbol(&statement, "x_n"), symbol(&statement, "x_{n+1}"));
    let mut statement = statement;
    let (x, y) = (statement.terms_mut().symbol(x), statement.terms_mut().symbol(y));
    let target = Polynomial::generator(x).minus(&Polynomial::generator(y));
    let mut steps = steps;
    steps.push(Inference::Zero {
        target,
        power: 1,
        squares: Vec::new(),
        factors: Vec::new(),
        terms: vec![(Polynomial::integer(-1), 0), (Polynomial::integer(1), 1)],
    });
    assert!(follows(&proof(statement, steps)).is_err());
}

#[test]
fn over_complex_numbers_a_root_in_a_premise_says_nothing_of_its_radicand() {
    // z = sqrt(x) with principal branches: x = -1, z = i
    let asked = question(
        "[symbols]\nparameters = ['x', 'z']\ncomplex = ['z']\n\
         [[equation]]\nlabel = \"1\"\nrole = \"premise\"\ntex = 'z = \\sqrt{x}'\n\
         [[equation]]\nlabel = \"2\"\nrole = \"claim\"\ntex = 'x \\ge 0'\nfollows_from = [\"1\"]\n",
    );
    let x = symbol(&asked.statement, "x");
    let order = asked.statement.givens().iter().find(|given| {
        given.property == Property::NonNegative && *asked.statement.terms().node(given.term) == Node::Symbol(x)
    });
    assert!(order.is_none(), "{order:?}");
}

#[test]
fn a_power_of_0_with_a_negative_exponent_has_no_value() {
    // where it is defined, y > 0
    let asked = question(
        "[symbols]\nparameters = ['x', 'y']\nnonnegative = ['y']\n\
         [[equation]]\nlabel = \"1\"\nrole = \"claim\"\ntex = 'y + y^x > y^x'\nassume = ['x < 0']\n",
    );
    let mut statement = asked.statement.clone();
    let (x, y) = (symbol(&statement, "x"), symbol(&statement, "y"));
    let (minus, zero) = (statement.terms_mut().integer(-1), statement.terms_mut().integer(0));
    let with = With {
        statement,
        evidence: Witness {
            sample: vec![(x, minus), (y, zero)],
            ..Witness::default()
        },
    };
    assert!(refute(&asked.statement, &with).is_err());
}

#[test]
fn solutions_obey_what_is_declared_of_their_symbol() {
    // x^2 = 1 with x positive has one solution: -1 is none
    let all = all_questions(
        "[symbols]\nparameters = ['x']\npositive = ['x']\n\
         [[equation]]\nlabel = \"1\"\nrole = \"premise\"\ntex = 'x^2 = 1'\n\
         [[equation]]\nlabel = \"2\"\nrole = \"claim\"\ntex = 'x_{1,2} = \\pm 1'\nfollows_from = [\"1\"]\n",
    );
    let lower = all
        .iter()
        .find(|asked| asked.instance.starts_with("the lower"))
        .unwrap();
    let says = |(property, term): &(Property, Term)| {
        *property == Property::Positive && lower.statement.terms().is_closed(*term)
    };
    assert!(lower.statement.goal().iter().any(says), "{:?}", lower.statement.goal());
    let _ = (identity(Polynomial::integer(0), 0), Rational::zero());
}

/// A sheet that claims x = 1 of all x that are not 0.
const X_IS_1: &str =
    "[symbols]\nparameters = ['x']\nnonzero = ['x']\n[[equation]]\nlabel = \"1\"\nrole = \"claim\"\ntex = 'x = 1'\n";

#[test]
fn exponents_do_not_saturate() {
    let asked = question(X_IS_1);
    let x = symbol(&asked.statement, "x");
    let mut statement = asked.statement.clone();
    let term = statement.terms_mut().symbol(x);
    let nonzero = statement
        .givens()
        .iter()
        .position(|given| given.property == Property::Nonzero);
    let steps = vec![
        Inference::Given(nonzero.unwrap()),
        // x^(2^32 - 1) (x - 1) = x^(2^32) - x^(2^32 - 1)
        Inference::Zero {
            target: Polynomial::generator(term).minus(&Polynomial::integer(1)),
            power: 1,
            squares: Vec::new(),
            factors: vec![(0, i32::MAX as u32), (0, i32::MAX as u32), (0, 1)],
            terms: Vec::new(),
        },
    ];
    assert!(follows(&proof(statement, steps)).is_err());
}

#[test]
fn printed_powers_do_not_saturate() {
    let asked = question(
        "[symbols]\nparameters = ['x']\npositive = ['x']\n[[equation]]\nlabel = \"1\"\nrole = \"claim\"\n\
         tex = '(((x^{1000})^{1000})^{1000})^{5} x = (((x^{1000})^{1000})^{1000})^{5}'\n",
    );
    assert!(follows(&proof(asked.statement.clone(), Vec::new())).is_err());
}

#[test]
fn the_root_of_index_0_is_none() {
    let asked = question(X_IS_1);
    let mut statement = asked.statement.clone();
    let two = statement.terms_mut().integer(2);
    let root = statement.terms_mut().elementary(Elementary::Root(0), two);
    assert!(follows(&proof(statement, vec![Inference::Axiom(Axiom::RootPower(root))])).is_err());
}

#[test]
fn roots_of_huge_indices_are_not_alike() {
    let asked = question(X_IS_1);
    let mut statement = asked.statement.clone();
    let two = statement.terms_mut().integer(2);
    let [a, b] =
        [1_u32 << 31, (1_u32 << 31) + 2].map(|index| statement.terms_mut().elementary(Elementary::Root(index), two));
    let steps = vec![
        Inference::Axiom(Axiom::RootPower(a)),
        Inference::Axiom(Axiom::RootNonNegative(a)),
        Inference::Axiom(Axiom::RootUnique { root: b, value: a }),
        Inference::Axiom(Axiom::Enclosure(
            Polynomial::generator(a).minus(&Polynomial::generator(b)),
        )),
        Inference::Nonzero {
            target: Polynomial::integer(0),
            cofactor: Polynomial::integer(1),
            factors: vec![(3, 1)],
            terms: vec![(Polynomial::integer(1), 2)],
        },
    ];
    assert!(follows(&proof(statement, steps)).is_err());
}

#[test]
fn no_term_stands_in_itself() {
    let asked = question(X_IS_1);
    let mut statement = asked.statement.clone();
    let one = statement.terms_mut().integer(1);
    let own = Term(statement.terms().len() as u32);
    let own = statement.terms_mut().add(Node::Sum(vec![own, one]));
    let with = With {
        statement,
        evidence: Certificate {
            whole: vec![own],
            steps: vec![Inference::Axiom(Axiom::Unfold(own))],
        },
    };
    assert!(follows(&with).is_err());
}

#[test]
fn the_terms_of_a_statement_are_not_exchanged() {
    let asked = question(X_IS_1);
    let mut statement = asked.statement.clone();
    let goal = statement.goal()[0].1;
    let mut terms = vibro_audit::kernel::Terms::default();
    // the term of this number vanishes
    let mut last = terms.integer(0);
    while last.0 < goal.0 {
        let one = terms.integer(1);
        last = terms.add(Node::Power(last, 1));
        let _ = one;
    }
    *statement.terms_mut() = terms;
    let mut own = asked.statement.clone();
    let one = own.terms_mut().integer(1);
    let point = Witness {
        sample: vec![(symbol(&own, "x"), one)],
        ..Witness::default()
    };
    let point = With {
        statement: own,
        evidence: point,
    };
    let Evaluated::Holds(point) = evaluate(&asked.statement, &point).unwrap() else {
        panic!("x = 1 holds at 1");
    };
    let refusal = prove(&asked.statement, &proof(statement, Vec::new()), &point).unwrap_err();
    assert!(refusal.to_string().contains("another statement"), "{refusal}");
}

#[test]
fn a_huge_negative_exponent_is_not_one_less() {
    let asked = question(X_IS_1);
    let x = symbol(&asked.statement, "x");
    let mut statement = asked.statement.clone();
    let nonzero = statement
        .givens()
        .iter()
        .position(|given| given.property == Property::Nonzero);
    let terms = statement.terms_mut();
    let base = terms.symbol(x);
    let [all, most, one] = [i64::from(i32::MIN), i64::from(i32::MIN) + 1, -1].map(|n| terms.integer(n));
    let [a, b, c] = [all, most, one].map(|n| terms.add(Node::RealPower(base, n)));
    let p = Polynomial::generator;
    let steps = vec![
        Inference::Given(nonzero.unwrap()),
        Inference::Axiom(Axiom::IntegerPowerOfSum {
            power: a,
            parts: [most, one],
        }), // a - b c
        Inference::Axiom(Axiom::IntegerPower {
            power: a,
            exponent: i32::MIN,
        }), // a x^n - 1
        Inference::Axiom(Axiom::IntegerPower {
            power: b,
            exponent: i32::MIN + 1,
        }), // b x^n - 1
        Inference::Axiom(Axiom::IntegerPower { power: c, exponent: -1 }), // c x - 1
        // a - b = 0, times x^n
        Inference::Zero {
            target: p(a).minus(&p(b)),
            power: 1,
            squares: Vec::new(),
            factors: vec![(0, i32::MAX as u32)],
            terms: vec![(Polynomial::integer(1), 2), (Polynomial::integer(-1), 3)],
        },
    ];
    // a = b says x^(-2^31) = x^(-2^31 + 1)
    let mut copy = statement.clone();
    let followed = vibro_audit::kernel::Checker::new(&mut copy, &Certificate::default(), 1_000_000).follow(&steps);
    assert!(followed.is_err());
}

#[test]
fn a_derivative_along_a_recursion_is_not_free() {
    let asked = question(
        "[symbols]\nparameters = ['a']\nstates = ['x']\nindices = ['n']\n[[equation]]\nlabel = \"p\"\nrole = \"premise\"\ntex = 'x_{n+1} = 3 x_n'\n\
         [[equation]]\nlabel = \"1\"\nrole = \"claim\"\ntex = '\\frac{\\partial x_{n+2}}{\\partial x_{n+1}} = 3'\nfollows_from = [\"p\"]\n",
    );
    let mut own = asked.statement.clone();
    let mut sample = Vec::new();
    for (number, quantity) in (0_u32..).zip(asked.statement.quantities()) {
        let value = match quantity {
            Quantity::State { index, .. } => 3_i64.pow(index.unsigned_abs()),
            Quantity::Partial { .. } => 5,
            _ => 1,
        };
        sample.push((Symbol(number), own.terms_mut().integer(value)));
    }
    let point = With {
        statement: own,
        evidence: Witness {
            sample,
            ..Witness::default()
        },
    };
    assert!(refute(&asked.statement, &point).is_err());
}
