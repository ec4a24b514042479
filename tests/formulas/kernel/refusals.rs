//! What breaks one condition is refused, and accepted once the condition is met: of axioms and inferences, of what a
//! statement gives, and of witnesses.

use super::axioms::{given_and, power, stated};
use super::forge::*;
use super::rules::{FLIGHT, with_facts};
use vibro_audit::kernel::{
    At, Certificate, Checker, EFFORT, Elementary, Evaluated, Inference, LawSource, Node, Origin, Polynomial, Property,
    Quantity, Statement, Symbol, Term, With, Witness, evaluate, follows, prove,
};
use vibro_audit::number::{Field, Rational};

/// Whether steps can be followed, wherever they lead.
fn steps(statement: &Statement, forge: impl FnOnce(&mut Statement) -> Vec<Inference>) -> bool {
    let mut own = statement.clone();
    let steps = forge(&mut own);
    let mut checker = Checker::new(&mut own, &Certificate::default(), EFFORT);
    checker.follow(&steps).is_ok()
}

/// Whether a sample of integers, and whatever else `forge` makes a witness of, is a counterexample.
fn fails(statement: &Statement, values: &[(&str, i64)], forge: impl FnOnce(&mut Statement, &mut Witness)) -> bool {
    let outcome = refutes(statement, |own| {
        let mut witness = Witness {
            sample: sample(own, values),
            ..Witness::default()
        };
        forge(own, &mut witness);
        witness
    });
    outcome.is_ok()
}

/// Whether an axiom is accepted under conditions that semicolons part.
fn under(complex: bool, conditions: &str, step: impl FnOnce(&mut Statement) -> Inference) -> bool {
    let conditions: Vec<&str> = conditions.split("; ").collect();
    let mut own = stated(complex, &conditions);
    let step = step(&mut own);
    given_and(&mut own, step, Vec::new()).is_ok()
}

/// The first of these symbols that is given something of.
fn met(own: &mut Statement, names: [&str; 2]) -> Term {
    let given = own.givens()[0].term;
    let first = own.terms().holds(given, symbol(own, names[0]));
    of(own, names[usize::from(!first)])
}

#[test]
fn a_weaker_condition_is_not_enough_for_an_axiom() {
    type Case = (bool, &'static str, &'static str, fn(&mut Statement) -> Inference);
    let angles: fn(&mut Statement) -> Inference = |own| axiom("AngleUnique", &[of(own, "x"), of(own, "y")]);
    let sine: fn(&mut Statement) -> Inference = |own| axiom("SinePositive", &[of(own, "x")]);
    let exp_of_ln: fn(&mut Statement) -> Inference = |own| axiom("ExpOfLn", &[of(own, "x")]);
    let whole: fn(&mut Statement) -> Inference = |own| axiom("IntegerAtLeastOne", &[met(own, ["n", "x"])]);
    let real_power: fn(&mut Statement) -> Inference = |own| {
        let (x, y) = (of(own, "x"), of(own, "y"));
        {
            let value = power(own, x, y);
            of_value("RealPower", value, own)
        }
    };
    let one_turn = r"x - y < 2 \pi; y - x < 2 \pi; \sin x = \sin y; \cos x = \cos y";
    let to_its_end = r"x - y \le 2 \pi; y - x < 2 \pi; \sin x = \sin y; \cos x = \cos y";
    let from_its_start = r"x - y < 2 \pi; y - x \le 2 \pi; \sin x = \sin y; \cos x = \cos y";
    let cases: &[Case] = &[
        (false, r"x > 0; x < \pi", r"x \ge 0; x < \pi", sine),
        (false, r"x > 0; x < \pi", r"x > 0; x \le \pi", sine),
        (false, one_turn, to_its_end, angles),
        (false, one_turn, from_its_start, angles),
        (true, "n > 0", r"n \ge 0", |own| axiom("LnOfNegative", &[of(own, "n")])),
        (false, "n > 0", r"n \ge 0", whole),
        (false, "n > 0", "x > 0", whole),
        (false, "x > 0", r"x \ge 0", real_power),
        (false, "x > 0", r"x \neq 0", real_power),
        (false, "x > 0", r"x \ge 0", exp_of_ln),
        (false, "x > 0", r"x \neq 0", exp_of_ln),
        // x is complex, n and m are not
        (true, "e^m = e^n", "e^x = e^n", |own| {
            axiom("ExpInjective", &[of(own, "n"), met(own, ["m", "x"])])
        }),
    ];
    for (number, (complex, enough, weaker, axiom)) in cases.iter().enumerate() {
        assert!(under(*complex, enough, axiom), "case {number} with {enough}");
        assert!(!under(*complex, weaker, axiom), "case {number} with {weaker}");
    }
    // of half an integer more, no multiple of pi is known; (x y)^n is not (x x)^n
    for (shift, factor, accepted) in [((1, 1), "y", true), ((1, 2), "x", false)] {
        for name in ["SineOfHalfTurns", "CosineOfTurns", "CosineOfHalfTurns"] {
            let followed = under(false, "n > 0", |own| {
                let (n, shift) = (of(own, "n"), Rational::from_ratio(shift.0, shift.1));
                let shift = own.terms_mut().number(shift);
                axiom(name, &[own.terms_mut().sum(vec![n, shift])])
            });
            assert_eq!(followed, accepted);
        }
        let followed = under(false, r"x \neq 0; y \neq 0", |own| {
            let (x, y, n, factor) = (of(own, "x"), of(own, "y"), of(own, "n"), of(own, factor));
            let product = own.terms_mut().product(vec![x, y]);
            let (power, factors) = (power(own, product, n), [x, factor]);
            power_of_product(power, [factors[0], factors[1]], own)
        });
        assert_eq!(followed, accepted);
    }
}

/// Axioms of one real number.
const OF_REAL: &[fn(&mut Statement, Term) -> Inference] = &[
    |_, of| axiom("ExpPositive", &[of]),
    |_, of| axiom("ExpInjective", &[of, of]),
    |_, of| axiom("LnOfExp", &[of]),
    |_, of| axiom("AngleUnique", &[of, of]),
    |_, of| axiom("SinePositive", &[of]),
    |own, of| {
        let value = own.terms_mut().elementary(Elementary::Arctan, of);
        of_value("SineOfArctan", value, own)
    },
    |own, of| {
        let value = own.terms_mut().elementary(Elementary::Arctan, of);
        of_value("CosineOfArctan", value, own)
    },
    |own, of| {
        let value = own.terms_mut().elementary(Elementary::Arctan, of);
        of_value("ArcAbove", value, own)
    },
    |own, value| {
        let square = own.terms_mut().add(Node::Power(value, 2));
        let root = own.terms_mut().elementary(Elementary::Root(2), square);
        unique_root(root, value, own)
    },
];

#[test]
fn an_axiom_is_about_terms_that_have_values() {
    let others: &[fn(&mut Statement, Term) -> Inference] = &[
        |_, of| axiom("ExpNonzero", &[of]),
        |_, of| axiom("ExpOfLn", &[of]),
        |own, of| {
            let value = own.terms_mut().elementary(Elementary::Root(3), of);
            of_value("RootPower", value, own)
        },
        |own, of| {
            let value = own.terms_mut().elementary(Elementary::Arcsin, of);
            of_value("SineOfArcsin", value, own)
        },
        |own, base| {
            let value = power(own, base, base);
            of_value("RealPower", value, own)
        },
        |own, base| {
            let three = integer(own, 3);
            let (power, exponent) = (power(own, base, three), 3);
            integer_power(power, exponent, own)
        },
        |own, base| {
            let n = of(own, "n");
            let twice = own.terms_mut().sum(vec![n, n]);
            let (power, parts) = (power(own, base, twice), [n, n]);
            power_of_sum(power, [parts[0], parts[1]], own)
        },
        |own, nearly| {
            // n as what is added to x makes it
            let (x, n) = (of(own, "x"), of(own, "n"));
            let rest = own.terms_mut().difference(nearly, x);
            let (exponent, square) = (own.terms_mut().sum(vec![n, rest]), own.terms_mut().product(vec![x, x]));
            let (power, factors) = (power(own, square, exponent), [x, x]);
            power_of_product(power, [factors[0], factors[1]], own)
        },
    ];
    for (number, axiom) in OF_REAL.iter().chain(others).enumerate() {
        for (last, accepted) in [(r"y \ge 0", true), ("y < 1", false)] {
            let given = format!(r"x > 0; x < \pi; 1 - x \ge 0; 1 + x \ge 0; {last}");
            // x + 0 root y expands to x, and has a value only where y is not negative
            let followed = under(false, &given, |own| {
                let (x, y, nought) = (of(own, "x"), of(own, "y"), integer(own, 0));
                let root = own.terms_mut().elementary(Elementary::Root(2), y);
                let nothing = own.terms_mut().product(vec![nought, root]);
                let argument = own.terms_mut().sum(vec![x, nothing]);
                axiom(own, argument)
            });
            assert_eq!(followed, accepted, "case {number} with {last}");
        }
    }
}

#[test]
fn an_axiom_of_real_numbers_is_about_terms_that_are_real_for_certain() {
    let others: &[fn(&mut Statement, Term) -> Inference] = &[
        |_, of| axiom("RootOfNegative", &[of]),
        |_, of| axiom("LnOfNegative", &[of]),
        |_, of| axiom("IntegerAtLeastOne", &[of]),
    ];
    for (number, axiom) in OF_REAL.iter().chain(others).enumerate() {
        for (name, accepted) in [("n", true), ("x", false)] {
            // 1 + x - x, where x is complex and n is not
            let followed = under(true, r"m \neq 0", |own| {
                let (one, of) = (integer(own, 1), of(own, name));
                let rest = own.terms_mut().difference(of, of);
                let argument = own.terms_mut().sum(vec![one, rest]);
                axiom(own, argument)
            });
            assert_eq!(followed, accepted, "case {number} of {name}");
        }
    }
}

#[test]
fn what_is_given_says_no_more_than_it_says() {
    for (premise, claim, follows) in [
        ("x > 0", r"x \neq 0", true),
        ("x > 0", r"x \ge 0", true),
        ("x > 0", "x = 0", false),
        (r"x \neq 0", "x = 0", false),
        (r"x \neq 0", "x > 0", false),
        (r"x \ge 0", "x > 0", false),
        (r"x \ge 0", r"x \neq 0", false),
        ("x = 0", r"x \ge 0", true),
        ("x = 0", "x > 0", false),
        // sums of quotients, and powers of sums
        (r"y \neq 1", r"\frac{1}{x} + \frac{1}{y} = \frac{x + y}{x y}", true),
        (r"y \neq 1", r"\frac{1}{x} + \frac{1}{y} = \frac{2}{x}", false),
        (r"y \neq 1", r"\frac{1}{x} = \frac{1}{x}", true),
        (r"y \neq 1", "(x + y)^2 = x^2 + 2 x y + y^2", true),
        (r"y \neq 1", "(x + y)^2 = x^2", false),
    ] {
        let own = statement("parameters = ['x', 'y']", &[premise], claim);
        let outcome = accepts(&own, |_| vec![Inference::Given(0)]);
        assert_eq!(outcome.is_ok(), follows, "{premise}: {claim}: {outcome:?}");
    }
    // a factor that may be 0 does not make a product that is not
    for (fact, accepted) in [(0, false), (2, true), (4, true), (5, false)] {
        let followed = with_facts(|known| Inference::Nonzero {
            target: known[fact].clone(),
            cofactor: Polynomial::integer(1),
            factors: vec![(fact, 1)],
            terms: Vec::new(),
        });
        assert_eq!(followed, accepted, "fact {fact}");
    }
    // each case must lead to what is to be shown
    for (target, accepted) in [(0, true), (1, false)] {
        let followed = with_facts(|known| Inference::Cases {
            on: known[0].clone(),
            order: false,
            property: Property::Zero,
            target: known[0].scaled(&Rational::from_integer(target)),
            branches: vec![Vec::new(), Vec::new()],
        });
        assert_eq!(followed, accepted, "target {target}");
    }
}

#[test]
fn generic_symbols_are_free_and_nothing_else_is_generic() {
    let symbols = "parameters = ['x', 'y', 'z']\ngeneric = ['x', 'y']";
    for (premises, factor, accepted) in [
        (vec![], "x", true),
        (vec!["z = 1"], "x", true),
        (vec![], "z", false),
        (vec!["x = y"], "x", false),
        (vec!["z = 1", "x^2 = y^2"], "x", false),
    ] {
        let own = statement(symbols, &premises, r"x - y + z \neq z");
        let followed = steps(&own, |own| {
            let (x, y, factor) = (of(own, "x"), of(own, "y"), of(own, factor));
            let difference = own.terms_mut().difference(x, y);
            vec![Inference::Generic(own.terms_mut().product(vec![factor, difference]))]
        });
        assert_eq!(followed, accepted, "{premises:?} {factor}");
    }
}

#[test]
fn a_law_is_taken_where_it_holds() {
    // at the running time of its own flight
    let claim = r"\dot{x}(t) = \dot{x}^+(t_{k+1}) + g (t - t_{k+1})";
    let own = statement(FLIGHT, &[r"\dot{x}(t) = g t"], claim);
    assert_eq!(own.interval(), Some(1));
    for (shift, accepted) in [(1, true), (0, false), (2, false)] {
        let given = given(&own, "p0", true);
        let followed = steps(&own, |own| vec![law(given, shift, Some(of(own, "t")))]);
        assert_eq!(followed, accepted, "shift {shift}");
    }
    // a law of indices has no time
    let doubles = "x_{n+1} = 2 x_n";
    let own = statement("states = ['x_n']\nindices = ['n']", &[doubles], doubles);
    let number = given(&own, "p0", true);
    assert!(accepts(&own, |_| vec![law(number, 0, None)]).is_ok());
    assert!(!steps(&own, |own| vec![law(number, 0, Some(of(own, "x_n")))]));
    // the trace of a map is of one map, and its law is not moved on to the next
    let symbols = "times = ['t']\nstates = ['x_n']\nindices = ['n']\nfunctions = { f = '' }\n\
                   maps = { D = { of = ['x_{n+1}'], by = ['x_n'] } }";
    for (premise, shift, accepted) in [
        ("f(t) = x_n + Tr(D) t", 0, true),
        ("f(t) = x_n + Tr(D) t", 1, false),
        ("f(t) = x_n + 2 t", 1, true),
    ] {
        let own = statement(symbols, &[premise], "f(t) = x_n Tr(D)");
        let given = given(&own, "p0", true);
        let derivative = Inference::Derivative(LawSource::Given { given, shift });
        assert_eq!(steps(&own, |_| vec![derivative]), accepted, "{premise}, shift {shift}");
        let at_time = steps(&own, |own| vec![law(given, shift, Some(of(own, "t")))]);
        assert_eq!(at_time, accepted, "{premise}, shift {shift}");
    }
    // over complex numbers, roots jump where what is under them moves
    let symbols = "parameters = ['z', 'y']\ncomplex = ['z']\ntimes = ['t']\nfunctions = { f = '' }";
    for (premise, accepted) in [(r"f(t) = t \sqrt{y}", true), (r"f(t) = \sqrt{t}", false)] {
        let own = statement(symbols, &[premise], "f(y) = z");
        let given = given(&own, "p0", true);
        let derivative = Inference::Derivative(LawSource::Given { given, shift: 0 });
        assert_eq!(steps(&own, |_| vec![derivative]), accepted, "{premise}");
    }
}

#[test]
fn a_flight_starts_after_one_impact_and_ends_before_the_next() {
    for (claim, at, accepted) in [
        (r"\dot{x}_k^+ = g t_k", "t_k", true),
        (r"\dot{x}_k = g t_k", "t_k", false),
        (r"\dot{x}_{k+1} = g t_{k+1}", "t_{k+1}", true),
        (r"\dot{x}_{k+1}^+ = g t_{k+1}", "t_{k+1}", false),
        // beside a flight, the state at an impact is that before it
        (r"\dot{x}(t_k) = g t_k", "t_k", false),
        (r"\dot{x}^+(t_k) = g t_k", "t_k", true),
    ] {
        let own = statement(FLIGHT, &[r"\dot{x}(t) = g t"], claim);
        let given = given(&own, "p0", true);
        let outcome = accepts(&own, |own| vec![law(given, 0, Some(of(own, at)))]);
        assert_eq!(outcome.is_ok(), accepted, "{claim}: {outcome:?}");
    }
}

#[test]
fn a_map_is_differentiated_by_what_it_starts_from_alone() {
    // a and the time at the start do not move with the state there
    let symbols = "parameters = ['a']\ntimes = ['t', 't_k']\nstates = ['x']\n\
                   maps = { D = { of = ['x_{k+1}'], by = ['t_k', 'x_k'] } }";
    let claim = r"\frac{\partial x_{k+1}}{\partial x_k} = a";
    let own = statement(symbols, &["x_{k+1} = a x_k + t_k"], claim);
    let along = |own: &mut Statement, by| {
        let (implicit, equation, by) = (0, 0, symbol(own, by));
        vec![Inference::Along { implicit, equation, by }]
    };
    let outcome = accepts(&own, |own| along(own, "x_k"));
    assert!(outcome.is_ok(), "{outcome:?}");
    assert!(!steps(&own, |own| along(own, "a")));
    // nor what holds at single states only, or from one on
    for premise in [
        r"x_{k+1} = a x_k + t_k + 0 \sqrt{-(x_k-1)^2}",
        r"x_{k+1} (\sqrt{-(x_k-1)^2})^0 = a x_k + t_k",
        r"x_{k+1} = a x_k + t_k + 0 \sqrt{x_k - 1}",
    ] {
        let own = statement(symbols, &[premise], claim);
        assert!(
            own.implicit()[0].equations.is_empty() || !steps(&own, |own| along(own, "x_k")),
            "{premise}"
        );
    }
    for assumed in [r"-(x_k-1)^2 \ge 0", "x_k = 1", r"\sqrt{-(x_k-1)^2} + 1 > 0"] {
        let own = statement(
            symbols,
            &[&format!("x_{{k+1}} = a x_k + t_k | assume = ['{assumed}']")],
            claim,
        );
        assert!(
            own.implicit()[0].equations.is_empty() || !steps(&own, |own| along(own, "x_k")),
            "{assumed}"
        );
    }
    // what determines a map speaks of no derivatives, and of states before times
    let determining = |of: &str, premises: &[&str]| {
        let own = statement(&symbols.replace("['x_{k+1}']", of), premises, claim);
        let labels: Vec<String> = own.implicit()[0]
            .equations
            .iter()
            .map(|(origin, _)| origin.to_string())
            .collect();
        labels.join(" ")
    };
    let partial = r"x_{k+1} = \frac{\partial x_{k+1}}{\partial x_k} x_k";
    assert_eq!(determining("['x_{k+1}']", &[partial]), "");
    assert_eq!(determining("['x_{k+1}']", &[partial, "x_{k+1} = a x_k"]), "p1");
    let premises = &["t_{k+1} = t_k + 1", "x_{k+1} = t_{k+1}^2", "x_{k+1} = a t_{k+1}"];
    assert_eq!(determining("['t_{k+1}', 'x_{k+1}']", premises), "p1 p2");
}

#[test]
fn derivatives_imply_a_map_from_one_impact_to_the_next_only() {
    let is_read = |premises: &[&str], last: &str| {
        let claim = format!(r"\frac{{\partial x_{{{last}}}}}{{\partial x_k}} = r");
        read("parameters = ['r']\ntimes = ['t_k']\nstates = ['x']", premises, &claim).is_ok()
    };
    assert!(is_read(&["x_{k+1} = r x_k"], "k+1"));
    assert!(!is_read(&["x_{k+2} = r x_k"], "k+2"));
    assert!(!is_read(&["x_{k+1} = r x_k^+", "x_k^+ = x_k"], "k+1"));
}

#[test]
fn names_stand_for_what_is_declared() {
    // e is the base of the exponential unless something is declared to be e
    for (symbols, claim, is_own) in [
        ("parameters = ['x', 'y']", "y = e^x", false),
        ("parameters = ['x', 'y']", "y q = e^x | where = ['q = 2 y']", false),
        ("parameters = ['x', 'y', 'e']", "y = e^x", true),
        ("parameters = ['x', 'y']\nabbreviations = ['e = y^2']", "y = e^x", true),
        ("parameters = ['x', 'y']", "y = e^x | where = ['e = 2 y']", true),
    ] {
        let own = statement(symbols, &[], claim);
        let all = (0..u32::try_from(own.terms().len()).unwrap()).map(|n| own.terms().node(Term(n)));
        let powers: Vec<&Node> = all
            .filter(|node| matches!(node, Node::RealPower(..) | Node::Elementary(Elementary::Exp, _)))
            .collect();
        assert!(!powers.is_empty());
        let own_base = |node: &&Node| matches!(node, Node::RealPower(..));
        assert!(
            powers.iter().all(|node| own_base(node) == is_own),
            "{symbols} {claim}: {powers:?}"
        );
    }
    // a motion and a function stand for their values at the running time; a motion has no primes
    let symbols = "parameters = ['g']\ntimes = ['t', 't_k']\nstates = ['x']\nfunctions = { f = '' }";
    for (claim, is_read) in [("x = g", true), ("x' = g", false), ("f = g", true), ("f' = g", true)] {
        assert_eq!(read(symbols, &[], claim).is_ok(), is_read, "{claim}");
    }
    // an unknown function is one of real numbers
    let symbols = "parameters = ['x', 'z']\ncomplex = ['z']\ntimes = ['t']\nfunctions = { f = '' }";
    for (claim, is_read) in [("f(x) = z", true), ("f(z) = z", false)] {
        assert_eq!(read(symbols, &[], claim).is_ok(), is_read, "{claim}");
    }
    // the base of a power is not negative, unless the exponent is an integer
    let symbols = "parameters = ['x', 'y']\nintegers = ['n']\nabbreviations = ['A = y / 2']";
    for (exponent, is_bound) in [
        ("n + 1", false),
        ("2 n^2", false),
        (r"n + \frac{1}{2}", true),
        (r"\pi", true),
        (r"\sin y", true),
        ("A", true),
        ("n A", true),
    ] {
        let own = statement(symbols, &[], &format!("y = x^{{{exponent}}}"));
        let bound = own.givens().iter().any(|given| given.property == Property::NonNegative);
        assert_eq!(bound, is_bound, "{exponent}");
    }
}

#[test]
fn what_is_declared_is_given_of_what_it_names() {
    let positive = |symbols: &str, claim: &str| {
        let own = statement(symbols, &[], claim);
        let positive = own.givens().iter().filter(|given| given.property == Property::Positive);
        let mut names: Vec<String> = positive
            .filter_map(|given| match own.terms().node(given.term) {
                Node::Symbol(symbol) => Some(own.terms().symbol_name(*symbol).to_string()),
                _ => None,
            })
            .collect();
        names.sort();
        names.join(" ")
    };
    let symbols = "times = ['t_k', 's_k']\nstates = ['x']\npositive = ['x_k', 't_k']";
    assert_eq!(positive(symbols, "x_k + x_{k+1} + t_k + t_{k+1} + s_k = 1"), "t_k x_k");
    let symbols = "times = ['t_k']\nabbreviations = ['A = t_{k+1} - t_k']\npositive = ['A']";
    assert_eq!(positive(symbols, r"t_{k+1} \neq t_k"), "A");
    // two properties of one term are two givens
    let own = statement("parameters = ['x']", &[r"x \ge 0", r"x \neq 0"], "x > 0");
    let properties: Vec<Property> = own.givens().iter().map(|given| given.property).collect();
    assert_eq!(properties, [Property::NonNegative, Property::Nonzero]);
    // a premise is one, whatever its label
    let labels = ["the domain of the claim", "the assumptions", "[symbols] x"];
    for label in labels.into_iter().chain(["derivatives exist of x"]) {
        let text = sheet("parameters = ['x']", &["x = 1"], r"x \neq 0").replace("p0", label);
        let asked = read_sheet(&text).unwrap().remove(0);
        assert_eq!(asked.statement.givens()[0].origin, Origin::Premise(label.to_owned()));
    }
    // a state is as complex as it is declared, whatever else is
    let symbols = "parameters = ['w', 'y']\nstates = ['z_n', 'x_n']\nindices = ['n']\ncomplex = ['z_n', 'w']";
    let mut own = statement(symbols, &[], r"z_n = w + x_n + \sin y");
    for (name, is_real) in [("z_n", false), ("w", false), ("x_n", true), ("y", true)] {
        let term = of(&mut own, name);
        let sine = own.terms_mut().elementary(Elementary::Sin, term);
        assert_eq!([own.is_real(term), own.is_real(sine)], [is_real; 2], "{name}");
    }
}

/// A statement at a sample of integers, where the claim holds.
fn at_point(statement: &Statement, values: &[(&str, i64)]) -> With<Witness> {
    let mut own = statement.clone();
    let evidence = Witness {
        sample: sample(&mut own, values),
        ..Witness::default()
    };
    With {
        statement: own,
        evidence,
    }
}

#[test]
fn certificates_and_points_are_of_the_statement_that_they_are_taken_for() {
    let made = || statement("parameters = ['x', 'y']", &["x = y"], "x^2 = y^2 + 0 x");
    let [one, other] = [made(), made()];
    let certificate = |statement: &Statement| With {
        statement: statement.clone(),
        evidence: Certificate {
            whole: Vec::new(),
            steps: {
                let mut own = statement.clone();
                let (x, y) = (generator(of(&mut own, "x")), generator(of(&mut own, "y")));
                let squares = x.times(&x).minus(&y.times(&y));
                vec![Inference::Given(0), zero(squares, vec![(x.plus(&y), 0)])]
            },
        },
    };
    let values = [("x", 1), ("y", 1)];
    let point = |statement: &Statement| match evaluate(statement, &at_point(statement, &values)) {
        Ok(Evaluated::Holds(point)) => point,
        outcome => panic!("{outcome:?}"),
    };
    let outcome = prove(&one, &certificate(&one), &point(&one));
    assert!(outcome.is_ok(), "{outcome:?}");
    assert!(prove(&one, &certificate(&other), &point(&one)).is_err());
    assert!(prove(&one, &certificate(&one), &point(&other)).is_err());
    assert!(evaluate(&one, &at_point(&other, &values)).is_err());
    // nor are its terms those of another one with the same symbols
    let question = statement("parameters = ['x', 'y']", &[], "x = y");
    let mut own = question.clone();
    *own.terms_mut() = statement("parameters = ['x', 'y']", &[], "0 x = 0 y").terms().clone();
    let exchanged = With {
        statement: own,
        evidence: Certificate::default(),
    };
    assert!(follows(&exchanged).is_ok());
    assert!(prove(&question, &exchanged, &point(&question)).is_err());
    // where nothing is asked, nothing is proved
    assert!(follows(&certificate(&one.premises())).is_err());
    let asked = read("parameters = ['x', 'y']", &["y = 1"], r"x_{1,2} = y \pm y").unwrap();
    assert!(asked[1].statement.goal().is_empty());
    assert!(accepts(&asked[1].statement, |_| Vec::new()).is_err());
}

#[test]
fn what_a_witness_writes_has_a_real_value_of_its_own() {
    // a value is written in symbols of the sample, and in no abbreviation
    let symbols =
        "parameters = ['a', 'x', 'y']\nabbreviations = ['A = 2 y']\ntimes = ['t']\nfunctions = { f = '', g = '' }";
    let own = statement(symbols, &["x + f(a) = A + f(a)"], "f(a) + g(a) = x + y");
    for (of_symbol, of_function, accepted) in [(false, false, true), (true, false, false), (false, true, false)] {
        let outcome = fails(&own, &[("a", 0), ("y", 1)], |own, witness| {
            let (y, time) = (of(own, "y"), own.fresh("s"));
            let (two, short, a) = (integer(own, 2), of(own, "A"), of(own, "a"));
            let long = own.terms_mut().product(vec![two, y]);
            let (f, g) = (function(own, "f"), function(own, "g"));
            let value = own.value(g, 0, a);
            let sum = |own: &mut Statement, of| own.terms_mut().sum(vec![of, value]);
            let of_f = sum(own, if of_function { short } else { long });
            witness.solved = vec![(symbol(own, "x"), if of_symbol { short } else { long })];
            witness.functions = vec![(f, time, of_f), (g, time, two)];
        });
        assert_eq!(outcome, accepted, "{of_symbol} {of_function}");
    }
    // whatever it writes, wanted or not, has a value, and a real one of a real symbol
    for (complex, made, value, accepted) in [
        (false, Elementary::Ln, 2, true),
        (false, Elementary::Ln, -2, false),
        (false, Elementary::Ln, 0, false),
        (false, Elementary::Root(2), 2, true),
        (false, Elementary::Root(2), -2, false),
        (true, Elementary::Root(2), 2, true),
        (true, Elementary::Root(2), -2, false),
    ] {
        let symbols = if complex { "complex = ['y', 'z']" } else { "" };
        let own = statement(&format!("parameters = ['x', 'y', 'z']\n{symbols}"), &[], "y x = z + 1");
        let outcome = fails(&own, &[("y", value), ("z", 100)], |own, witness| {
            let (one, y) = (integer(own, 1), of(own, "y"));
            let value = own.terms_mut().elementary(made, y);
            let inverse = own.terms_mut().quotient(one, value);
            let unused = own.fresh("c");
            witness.solved = vec![(unused, value), (symbol(own, "x"), one)];
            if complex {
                witness.solved = vec![(symbol(own, "x"), inverse)];
            }
        });
        assert_eq!(outcome, accepted, "{made:?} of {value}");
    }
    // what a law divides by is not 0, though no more than 0 is divided
    let symbols = "parameters = ['a', 'x']\ntimes = ['t']\nfunctions = { f = '' }";
    let own = statement(symbols, &[r"f(t) = \frac{0}{x}"], "f(a) = 1");
    for (value, accepted) in [(1, true), (0, false)] {
        let outcome = fails(&own, &[("a", 0), ("x", value)], |own, witness| {
            witness.functions = vec![(function(own, "f"), own.fresh("s"), integer(own, 0))];
        });
        assert_eq!(outcome, accepted, "x = {value}");
    }
}

#[test]
fn what_is_not_known_to_be_real_has_no_sign() {
    let own = statement("parameters = ['z']\ncomplex = ['z']", &[], "z = 1");
    let mut with = at_point(&own, &[("z", 1)]);
    let terms = with.statement.terms_mut();
    let (one, unit, pi) = (terms.integer(1), terms.add(Node::Imaginary), terms.add(Node::Pi));
    // 1 + i sin pi is 1, which no enclosure tells
    let sine = terms.elementary(Elementary::Sin, pi);
    let rest = terms.product(vec![unit, sine]);
    let unsure = terms.sum(vec![one, rest]);
    let mut at = At::new(&mut with.statement, &with.evidence, EFFORT).unwrap();
    assert_eq!(at.property(Property::Nonzero, unsure), Ok(true));
    for property in [Property::Positive, Property::NonNegative] {
        assert_eq!(at.property(property, one), Ok(true));
        assert!(at.property(property, unsure).is_err(), "{property:?}");
    }
    // a quotient of complex numbers has a value where the divisor is not 0
    let own = statement("parameters = ['z']\ncomplex = ['z']", &[], r"e^{\frac{1}{z^2 + 1}} = 1");
    for (turn, accepted) in [(2, true), (1, false)] {
        let outcome = fails(&own, &[], |own, witness| {
            let (unit, turn) = (own.terms_mut().add(Node::Imaginary), integer(own, turn));
            let value = own.terms_mut().product(vec![unit, turn]);
            witness.sample = vec![(symbol(own, "z"), value)];
        });
        assert_eq!(outcome, accepted, "{turn} i");
    }
}

#[test]
fn functions_in_a_table_or_by_name_fit_together() {
    let claim = "f(a) = f(b) + 0 F(a)";
    let table = |functions: &str, premises: &[&str], claim: &str, tabled: &[&str]| {
        let symbols = format!("parameters = ['a', 'b']\ntimes = ['t']\nfunctions = {functions}");
        let own = statement(&symbols, premises, claim);
        fails(&own, &[("a", 0)], |own, witness| {
            let seventh = own.terms_mut().number(Rational::from_ratio(1, 7));
            witness.sample.push((symbol(own, "b"), seventh));
            let (a, b) = (of(own, "a"), of(own, "b"));
            for name in tabled {
                let named = function(own, name);
                let (first, second) = (integer(own, 0), integer(own, 1));
                witness.table.extend([(named, 0, a, first), (named, 0, b, second)]);
            }
        })
    };
    // a function that is its own derivative is an exponential
    assert!(table("{ f = '' }", &[], "f(a) = f(b)", &["f"]));
    let (send, judged) = std::sync::mpsc::channel();
    std::thread::spawn(move || send.send(table("{ f = 'f' }", &[], "f(a) = f(b)", &["f"])));
    assert_eq!(judged.recv_timeout(std::time::Duration::from_secs(60)), Ok(false));
    // a function and its derivative have values of their own
    assert!(table("{ F = 'f', f = '' }", &[], claim, &["F", "f"]));
    // the periods of a function and of its derivative are one
    let (own, other) = ("F(t + 1) = F(t)", r"f(t + \frac{2}{7}) = f(t)");
    assert!(table("{ F = 'f', f = '' }", &[own], claim, &["F", "f"]));
    assert!(!table("{ F = 'f', f = '' }", &[other, own], claim, &["F", "f"]));
    assert!(!table("{ F = 'f', f = '' }", &[own, other], claim, &["F", "f"]));
    // a function that is named has no other derivative in the table
    let named = |of_table: bool, slope: i64| {
        let symbols = "parameters = ['a']\ntimes = ['t']\nfunctions = { F = 'f', f = '' }";
        let own = statement(symbols, &[], "F(a) + f(a) = 7");
        fails(&own, &[("a", 0)], |own, witness| {
            let time = own.fresh("s");
            let (s, slope, a) = (own.terms_mut().symbol(time), integer(own, slope), of(own, "a"));
            let (whole, derivative) = (function(own, "F"), function(own, "f"));
            witness.functions = vec![(whole, time, s)];
            match of_table {
                true => witness.table = vec![(derivative, 0, a, slope)],
                false => witness.functions.push((derivative, time, slope)),
            }
        })
    };
    assert!(named(false, 1));
    assert!(!named(false, 2) && !named(true, 2));
}

#[test]
fn a_flight_and_a_map_come_to_the_states_that_are_solved_for() {
    // x is 0 in flight, and so at its end
    let own = statement(
        "parameters = ['c']\ntimes = ['t', 't_k']\nstates = ['x']\ncontinuous = ['x']",
        &["x(t) = 0"],
        "x_{k+1} + x_k + c + t_k + t_{k+1} = 100",
    );
    for (end, accepted) in [(0, true), (5, false)] {
        let values = [("c", 1), ("t_k", 0), ("t_{k+1}", 1), ("x_k", 0)];
        let outcome = fails(&own, &values, |own, witness| {
            let flight = own.functions().len().checked_sub(1).unwrap();
            let flight = vibro_audit::kernel::Function(u32::try_from(flight).unwrap());
            witness.solved = vec![(symbol(own, "x_{k+1}"), integer(own, end))];
            witness.functions = vec![(flight, own.fresh("s"), integer(own, 0))];
        });
        assert_eq!(outcome, accepted, "x = {end}");
    }
    // with one equation for two states their derivatives are free, unless something else speaks of the states
    let symbols = "parameters = ['w']\ntimes = ['t_k']\nstates = ['x', 'y']\n\
                   maps = { D = { of = ['x_{k+1}', 'y_{k+1}'], by = ['x_k', 'y_k'] } }";
    for (second, accepted) in [(r"w \neq 8", true), ("y_{k+1} = y_{k+2}", false)] {
        let own = statement(
            symbols,
            &["x_{k+1} + y_{k+1} = x_k", second],
            r"\frac{\partial x_{k+1}}{\partial x_k} + 0 \frac{\partial y_{k+1}}{\partial x_k} = w",
        );
        let outcome = refutes(&own, |own| {
            let count = u32::try_from(own.quantities().len()).unwrap();
            let mut values = Vec::new();
            for symbol in (0..count).map(Symbol) {
                let value = match own.quantity(symbol) {
                    Some(Quantity::Partial { of, .. }) if own.terms().symbol_name(of) == "x_{k+1}" => 6,
                    Some(Quantity::Partial { .. }) => -5,
                    _ if own.terms().symbol_name(symbol) == "x_k" => 2,
                    _ => 1,
                };
                values.push((symbol, integer(own, value)));
            }
            Witness {
                sample: values,
                ..Witness::default()
            }
        });
        assert_eq!(outcome.is_ok(), accepted, "{second}: {outcome:?}");
    }
}

#[test]
fn a_recursion_is_solved_for_its_ends() {
    let symbols = "parameters = ['a']\nstates = ['x_n']\nindices = ['n']";
    let own = statement(symbols, &["a x_{n+1} = x_n"], "x_n + x_{n+1} = 7 a + 1");
    // with a = 0, all states are 0
    for (a, accepted) in [(1, true), (0, false)] {
        let values = [("a", a), ("x_n", a), ("x_{n+1}", 1)];
        assert_eq!(fails(&own, &values, |_, _| ()), accepted, "a = {a}");
    }
}

#[test]
fn generic_symbols_take_all_values_around_a_point() {
    let symbols = "parameters = ['x', 'p', 'c', 'w']\ngeneric = ['x']";
    // p is 0 unless x is 1
    let law = r"\arctan(x p) + w = \arctan(c p)";
    for (premises, accepted) in [(vec!["w = 0", "c = 1"], true), (vec![law, "w = 0", "c = 1"], false)] {
        let own = statement(symbols, &premises, "p = 0 (x + w + c)");
        let outcome = fails(&own, &[("w", 0), ("c", 1)], |own, witness| {
            let (free, one, two) = (own.fresh("s"), integer(own, 1), integer(own, 2));
            let value = own.terms_mut().symbol(free);
            witness.solved = vec![(symbol(own, "p"), value)];
            witness.sample.push((free, two));
            match accepted {
                true => witness.sample.push((symbol(own, "x"), one)),
                false => witness.solved.push((symbol(own, "x"), one)),
            }
        });
        assert_eq!(outcome, accepted, "{premises:?}");
    }
    // an inequality fails around a point where it fails by more than nothing
    let own = statement("parameters = ['x']\ngeneric = ['x']", &[], "x > 0");
    for (value, accepted) in [(-1, true), (0, false), (1, false)] {
        assert_eq!(fails(&own, &[("x", value)], |_, _| ()), accepted, "x = {value}");
    }
}
#[test]
fn a_witness_takes_nothing_as_not_zero() {
    // x = 1 makes x not 0; a certificate of the witness that takes 0 as not 0 would make everything vanish
    let own = statement("parameters = ['x']", &["x = 1"], r"x \neq 0");
    let outcome = refutes(&own, |own| {
        let nought = integer(own, 0);
        let steps = vec![
            Inference::Generic(nought),
            zero_after(Polynomial::integer(1), vec![(0, 1)], Vec::new()),
        ];
        Witness {
            sample: sample(own, &[("x", 1)]),
            certificate: Certificate {
                whole: Vec::new(),
                steps,
            },
            ..Witness::default()
        }
    });
    assert!(outcome.is_err());
}
