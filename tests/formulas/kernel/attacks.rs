//! Holes that were found by reading, each with the wrong verdict that it would have made.

use super::forge::*;
use vibro_audit::kernel::{
    Certificate, Checker, Draft, Elementary, Evaluated, Function, Inference, LawSource, Node, Origin, Polynomial,
    Property, Quantity, Statement, Symbol, Term, Terms, With, Witness, evaluate, prove, refute,
};
use vibro_audit::number::{Field, Rational};

fn square(polynomial: &Polynomial) -> Polynomial {
    polynomial.times(polynomial)
}

/// `1 = 0` from a fact that is a sum of squares and 1.
fn absurd_by_squares(root: Polynomial, fact: usize) -> Inference {
    Inference::Zero {
        target: Polynomial::integer(1),
        power: 2,
        squares: vec![(Rational::from_integer(1), root)],
        factors: Vec::new(),
        terms: vec![(Polynomial::integer(1), fact)],
    }
}

#[test]
fn the_imaginary_unit_is_no_real_number() {
    let statement = statement("parameters = ['x', 'y']", &[], "x = y");
    let outcome = accepts(&statement, |own| {
        let unit = own.terms_mut().add(Node::Imaginary);
        vec![axiom("ImaginarySquare", &[]), absurd_by_squares(generator(unit), 0)]
    });
    assert!(outcome.is_err());
}

#[test]
fn a_term_does_not_hold_itself() {
    let statement = statement("parameters = ['x', 'y']", &[], "x = y");
    let outcome = accepts_whole(&statement, |own| {
        let one = integer(own, 1);
        let next = Term(u32::try_from(own.terms().len()).unwrap());
        let term = own.terms_mut().add(Node::Sum(vec![next, one]));
        (vec![term], vec![Inference::Unfold(term)])
    });
    assert!(outcome.is_err());
}

#[test]
fn a_root_has_an_index_of_two_or_more_and_no_larger_than_a_power_can_be() {
    let statement = statement("parameters = ['x', 'y']", &[], "x = y");
    for index in [0, 1 << 31, u32::MAX] {
        let outcome = accepts(&statement, |own| {
            let four = integer(own, 4);
            let root = own.terms_mut().elementary(Elementary::Root(index), four);
            let value = own.terms_mut().elementary(Elementary::Root(i32::MAX as u32), four);
            vec![
                of_value("RootPower", root, own),
                of_value("RootPower", value, own),
                of_value("RootNonNegative", value, own),
                unique_root(root, value, own),
                zero(Polynomial::integer(1), Vec::new()),
            ]
        });
        let refusal = outcome.unwrap_err().to_string();
        assert!(refusal.contains("step 0"), "{refusal}");
    }
}

#[test]
fn the_terms_of_a_statement_are_not_exchanged() {
    let question = statement("parameters = ['x', 'y']", &[], "x = y");
    let goal = question.goal()[0].1;
    // the term of this number vanishes
    let mut terms = Terms::default();
    let mut last = terms.integer(0);
    while last.0 < goal.0 {
        last = terms.add(Node::Power(last, 1));
    }
    let mut exchanged = question.clone();
    *exchanged.terms_mut() = terms;
    let certificate = With {
        statement: exchanged,
        evidence: Certificate::default(),
    };
    let mut own = question.clone();
    let point = Witness {
        sample: sample(&mut own, &[("x", 1), ("y", 1)]),
        ..Witness::default()
    };
    let point = With {
        statement: own,
        evidence: point,
    };
    let Ok(Evaluated::Holds(point)) = evaluate(&question, &point) else {
        panic!("x = y holds where both are 1");
    };
    let refusal = prove(&question, &certificate, &point).unwrap_err().to_string();
    assert!(refusal.contains("another statement"), "{refusal}");
}

#[test]
fn exponents_do_not_saturate() {
    let large = |base: &str, last| format!("((({base}^{{1000}})^{{1000}})^{{1000}})^{{{last}}}");
    for (left, right, same) in [
        (large("x", 5), large("x", 6), false),
        (large(r"(1/x)", 5), large(r"(1/x)", 6), false),
        (format!("{} x", large("x", 5)), large("x", 5), false),
        ("(x^{20})^3".into(), "(x^{30})^2".into(), true),
    ] {
        let claim = format!("{left} = {right}");
        let claim = claim.as_str();
        let statement = statement("parameters = ['x']", &[], claim);
        assert_eq!(accepts(&statement, |_| Vec::new()).is_ok(), same, "{claim}");
    }
    let statement = statement(
        "parameters = ['x', 'y']",
        &[],
        r"\left(\frac{1}{x+y}\right)^{2} = \left(\frac{1}{x+y}\right)^{3}",
    );
    assert!(accepts(&statement, |_| Vec::new()).is_err());
}

/// A claim that is false of all numbers but one.
fn x_is_1() -> Statement {
    statement("parameters = ['x']\nnonzero = ['x']", &[], "x = 1")
}

#[test]
fn exponents_of_factors_do_not_saturate() {
    let statement = x_is_1();
    let nonzero = nonzero(&statement);
    let outcome = accepts(&statement, |own| {
        let x = of(own, "x");
        // x^(2^32 - 1) (x - 1) = x^(2^32) - x^(2^32 - 1)
        let factors = vec![(0, i32::MAX as u32), (0, i32::MAX as u32), (0, 1)];
        let target = generator(x).minus(&Polynomial::integer(1));
        vec![Inference::Given(nonzero), zero_after(target, factors, Vec::new())]
    });
    assert!(outcome.is_err());
}

/// The number of the given that says that a symbol is not 0.
fn nonzero(statement: &Statement) -> usize {
    let mut givens = statement.givens().iter();
    givens.position(|given| given.property == Property::Nonzero).unwrap()
}

#[test]
fn a_huge_negative_exponent_is_not_one_less() {
    let mut own = x_is_1();
    let nonzero = nonzero(&own);
    let base = of(&mut own, "x");
    let [all, most, one] = [i64::from(i32::MIN), i64::from(i32::MIN) + 1, -1].map(|n| integer(&mut own, n));
    let [a, b, c] = [all, most, one].map(|n| own.terms_mut().add(Node::RealPower(base, n)));
    let steps = vec![
        Inference::Given(nonzero),
        // a - b c
        power_of_sum(a, [most, one], &mut own),
        // a x^n - 1
        integer_power(a, i32::MIN, &mut own),
        // b x^n - 1
        integer_power(b, i32::MIN + 1, &mut own),
        // c x - 1
        integer_power(c, -1, &mut own),
        // a - b = 0, times x^n
        zero_after(
            generator(a).minus(&generator(b)),
            vec![(0, i32::MAX as u32)],
            vec![(Polynomial::integer(1), 2), (Polynomial::integer(-1), 3)],
        ),
    ];
    // a = b says x^(-2^31) = x^(-2^31 + 1)
    let followed = Checker::new(&mut own, &Certificate::default(), 1_000_000).follow(&steps);
    assert!(followed.is_err());
}

#[test]
fn a_power_of_0_with_a_negative_exponent_has_no_value() {
    // where it is defined, y > 0
    let statement = statement(
        "parameters = ['x', 'y']\nnonnegative = ['y']",
        &[],
        "y + y^x > y^x | assume = ['x < 0']",
    );
    let outcome = refutes(&statement, |own| Witness {
        sample: sample(own, &[("x", -1), ("y", 0)]),
        ..Witness::default()
    });
    assert!(outcome.is_err());
}

#[test]
fn an_integer_power_needs_a_base_that_has_a_value() {
    let statement = statement("parameters = ['x']", &[], r"x \neq 0");
    let outcome = accepts(&statement, |own| {
        let (one, two, x) = (integer(own, 1), integer(own, 2), of(own, "x"));
        let base = own.terms_mut().quotient(one, x);
        let power = own.terms_mut().add(Node::RealPower(base, two));
        // the power times x² is 1, so x is not 0
        vec![
            integer_power(power, 2, own),
            Inference::Nonzero {
                target: generator(x),
                cofactor: generator(power).times(&generator(x)),
                factors: Vec::new(),
                terms: vec![(Polynomial::integer(1), 0)],
            },
        ]
    });
    assert!(outcome.is_err());
}

#[test]
fn a_logarithm_is_not_differentiated_across_its_cut() {
    // ln(e^z) = z for z = 2 pi i would be 0 = 2 pi i
    let question = statement("parameters = ['z']\ncomplex = ['z']", &[], r"\ln(e^z) = z");
    let outcome = accepts(&question, |own| {
        let time = own.fresh("t");
        let z = of(own, "z");
        let (t, one, nought) = (own.terms_mut().symbol(time), integer(own, 1), integer(own, 0));
        let product = own.terms_mut().product(vec![z, t]);
        let power = own.terms_mut().elementary(Elementary::Exp, product);
        let logarithm = own.terms_mut().elementary(Elementary::Ln, power);
        let difference = own.terms_mut().difference(logarithm, product);
        let start = own.terms_mut().substitute(product, time, nought);
        let start_power = own.terms_mut().elementary(Elementary::Exp, start);
        let start_logarithm = own.terms_mut().elementary(Elementary::Ln, start_power);
        let unit_logarithm = own.terms_mut().elementary(Elementary::Ln, one);
        let at_one = own.terms_mut().substitute(product, time, one);
        let power_at_one = own.terms_mut().elementary(Elementary::Exp, at_one);
        let power_of_z = own.terms_mut().elementary(Elementary::Exp, z);
        let logarithm_at_one = own.terms_mut().elementary(Elementary::Ln, power_at_one);
        let logarithm_of_z = own.terms_mut().elementary(Elementary::Ln, power_of_z);
        let _ = unit_logarithm;
        vec![
            Inference::Constant {
                of: difference,
                time,
                at: nought,
                interval: None,
                steps: vec![axiom("ExpNonzero", &[product])],
            },
            // 0: exp(0 z) is not 0; 1, 2: exp z and exp(z 1) are not 0
            axiom("ExpNonzero", &[start]),
            axiom("ExpNonzero", &[z]),
            axiom("ExpNonzero", &[at_one]),
            // 3: ln exp(z 1) - z - ln exp(z 0)
            Inference::Law {
                source: LawSource::Derived(0),
                at: Some(one),
            },
            // 4: exp(z 0) = 1
            axiom("ExpOfZero", &[start]),
            // 5: exp(z 1) = exp z
            Inference::Congruence {
                left: power_at_one,
                right: power_of_z,
            },
            // 6: ln of these
            Inference::Congruence {
                left: logarithm_at_one,
                right: logarithm_of_z,
            },
            // 7: ln exp(0 z) = ln 1
            Inference::Congruence {
                left: start_logarithm,
                right: unit_logarithm,
            },
            zero(
                generator(logarithm_of_z)
                    .minus(&generator(z))
                    .minus(&generator(unit_logarithm)),
                vec![
                    (Polynomial::integer(1), 3),
                    (Polynomial::integer(-1), 6),
                    (Polynomial::integer(1), 7),
                ],
            ),
        ]
    });
    let refusal = outcome.unwrap_err().to_string();
    assert!(refusal.contains("step 0"), "{refusal}");
}

#[test]
fn a_logarithm_is_not_differentiated_around_the_unit_circle() {
    // ln(exp(i x)) = i x is false for x = 7, although both sides have the derivative i wherever that exists
    let statement = statement(
        "parameters = ['x', 'z']\ncomplex = ['z']",
        &[],
        r"\ln(\exp(i x)) + z - z = i x",
    );
    let outcome = accepts(&statement, |own| {
        let time = own.fresh("s");
        let terms = own.terms_mut();
        let (at, unit, zero) = (terms.symbol(time), terms.add(Node::Imaginary), terms.integer(0));
        let angle = terms.product(vec![unit, at]);
        let power = terms.elementary(Elementary::Exp, angle);
        let logarithm = terms.elementary(Elementary::Ln, power);
        vec![Inference::Constant {
            of: terms.difference(logarithm, angle),
            time,
            at: zero,
            interval: None,
            steps: vec![axiom("ExpNonzero", &[angle])],
        }]
    });
    let refusal = outcome.unwrap_err().to_string();
    assert!(refusal.contains("step 0"), "{refusal}");
}

#[test]
fn a_law_of_real_times_says_nothing_of_complex_ones() {
    let statement = statement(
        "parameters = ['z']\ncomplex = ['z']\ntimes = ['t']\nfunctions = { f = '' }",
        &[r"f(t) = 0", r"e^t > 0"],
        r"e^z \neq -1",
    );
    let given = given(&statement, "p1", true);
    let outcome = accepts(&statement, |own| {
        let z = of(own, "z");
        vec![law(given, 0, Some(z))]
    });
    let refusal = outcome.unwrap_err().to_string();
    assert!(refusal.contains("step 0"), "{refusal}");
}

#[test]
fn the_domain_of_a_premise_is_that_of_principal_branches_where_complex_numbers_take_part() {
    // x = -1 and z = i
    let statement = statement(
        "parameters = ['x', 'z']\ncomplex = ['z']",
        &[r"z = \sqrt{x}"],
        r"x \ge 0",
    );
    let given = statement
        .givens()
        .iter()
        .position(|given| given.property == Property::NonNegative);
    assert!(given.is_none());
}

#[test]
fn a_complex_number_is_not_split_by_parts_that_are_complex() {
    for claim in [r"e^{i\pi/2} = i", r"\sqrt{-1} = i", r"\frac{1}{1 + e^{i \pi}} = 2"] {
        let statement = statement("parameters = ['x']", &[], claim);
        assert!(refutes(&statement, |_| Witness::default()).is_err(), "{claim}");
    }
    let statement = statement("parameters = ['x']", &[], r"1 + i = 2");
    assert!(refutes(&statement, |_| Witness::default()).is_ok());
}

#[test]
fn a_number_with_a_complex_part_that_is_not_real_may_be_0() {
    // i sqrt(-1) = -1 is true
    let statement = statement("parameters = ['z']\ncomplex = ['z']", &[], r"i \sqrt{-1} + z = z - 1");
    let outcome = refutes(&statement, |own| Witness {
        sample: sample(own, &[("z", 0)]),
        ..Witness::default()
    });
    assert!(outcome.is_err());
}

#[test]
fn an_odd_root_of_a_negative_number_is_complex_where_complex_numbers_take_part() {
    // the principal root of -8 is 1 + sqrt 3 i
    let statement = statement(
        r"parameters = ['z']
complex = ['z']",
        &[],
        r"z + \sqrt[3]{-8} = z - 2",
    );
    let outcome = accepts(&statement, |own| {
        let minus = statement_term(own, |node| matches!(node, Node::Elementary(Elementary::Root(3), _)));
        let root = generator(minus);
        let quadratic = square(&root)
            .minus(&root.scaled(&Rational::from_integer(2)))
            .plus(&Polynomial::integer(4));
        vec![
            of_value("RootPower", minus, own),
            Inference::Enclosure(quadratic),
            zero_after(
                root.plus(&Polynomial::integer(2)),
                vec![(1, 1)],
                vec![(Polynomial::integer(1), 0)],
            ),
        ]
    });
    assert!(outcome.is_err());
}

#[test]
fn an_inverse_function_has_no_enclosure_outside_its_domain() {
    let statement = statement("parameters = ['z', 'x', 'y']\ncomplex = ['z']", &[], r"z x = z y");
    let outcome = accepts(&statement, |own| {
        // a hair more than 1
        let hair = own
            .terms_mut()
            .number(Rational::from_integer(1) + Rational::from_ratio(1, 10).to_power(60));
        let arc = own.terms_mut().elementary(Elementary::Arcsin, hair);
        let sine = own.terms_mut().elementary(Elementary::Sin, arc);
        let rest = Polynomial::constant(&(Rational::from_integer(1) + Rational::from_ratio(1, 10).to_power(70)))
            .minus(&generator(sine));
        vec![of_value("SineOfArcsin", arc, own), Inference::Enclosure(rest)]
    });
    assert!(outcome.is_err());
}

/// The term with this node.
fn statement_term(statement: &Statement, is: impl Fn(&Node) -> bool) -> Term {
    let all = (0..statement.terms().len()).map(|n| Term(u32::try_from(n).unwrap()));
    all.into_iter().find(|&term| is(statement.terms().node(term))).unwrap()
}

#[test]
fn states_at_later_impacts_are_as_complex_as_the_others() {
    let statement = statement(
        "states = ['z_n']\nindices = ['n']\ncomplex = ['z_n']",
        &["z_{n+1} = z_n"],
        r"z_n^2 \neq -1",
    );
    let given = given(&statement, "p0", true);
    let outcome = accepts(&statement, |own| {
        let mut steps = vec![law(given, 5, None)];
        let mut copy = own.clone();
        copy.instance(given, None, 5, None).unwrap();
        assert!(own.adopt(&copy));
        let later = of(own, "z_{n+5}");
        let square = square(&generator(later)).plus(&Polynomial::integer(1));
        steps.push(Inference::Cases {
            on: square.clone(),
            order: false,
            property: Property::Nonzero,
            target: square,
            branches: vec![vec![absurd_by_squares(generator(later), 1)], vec![]],
        });
        steps
    });
    let refusal = outcome.unwrap_err().to_string();
    assert!(refusal.contains("complex"), "{refusal}");
}

#[test]
fn a_derived_law_keeps_the_domain_of_its_conditions() {
    // f is 0 for t >= 0 only
    let statement = statement(
        "parameters = ['a']\ntimes = ['t']\nfunctions = { f = '' }",
        &[r"f(t) = 0 | assume = ['0 \sqrt{t} \neq 1']"],
        r"f'(-1) = 0",
    );
    let given = given(&statement, "p0", true);
    let outcome = accepts(&statement, |own| {
        let one = integer(own, 1);
        let minus = own.terms_mut().negative(one);
        vec![
            Inference::Derivative(LawSource::Given { given, shift: 0 }),
            Inference::Law {
                source: LawSource::Derived(0),
                at: Some(minus),
            },
        ]
    });
    assert!(outcome.is_err());
}

#[test]
fn a_law_with_an_index_in_it_is_shifted_as_a_whole() {
    // x_{n+1} = n + 1
    let statement = statement("states = ['x_n']\nindices = ['n']", &["x_n = n"], "x_{n+1} = x_n");
    let given = given(&statement, "p0", true);
    let outcome = accepts(&statement, |own| {
        let (later, now) = (of(own, "x_{n+1}"), of(own, "x_n"));
        vec![
            law(given, 0, None),
            law(given, 1, None),
            zero(
                generator(later).minus(&generator(now)),
                vec![(Polynomial::integer(1), 1), (Polynomial::integer(-1), 0)],
            ),
        ]
    });
    assert!(outcome.is_err());
}

#[test]
fn a_law_of_a_derivative_along_a_map_moves_on_with_its_map() {
    // if the derivative of x_{n+1} by x_n is x_n at each n, x_n and x_{n+1} need not be equal
    let statement = statement(
        "indices = ['n']\nstates = ['x']\ntimes = ['t_n']\nmaps = { M = { of = ['x_{n+1}'], by = ['x_n'] } }",
        &[r"\frac{\partial x_{n+1}}{\partial x_n} = x_n"],
        "x_n = x_{n+1}",
    );
    let given = statement.givens().iter().position(|given| given.law.is_some()).unwrap();
    let outcome = accepts(&statement, |own| {
        let (now, later) = (of(own, "x_n"), of(own, "x_{n+1}"));
        vec![
            law(given, 0, None),
            law(given, 1, None),
            zero(
                generator(now).minus(&generator(later)),
                vec![(Polynomial::integer(-1), 0), (Polynomial::integer(1), 1)],
            ),
        ]
    });
    assert!(outcome.is_err());
}

#[test]
fn an_index_is_an_integer() {
    let statement = statement("parameters = ['a']\nindices = ['n']", &[], r"\cos(2 \pi n) = 1");
    let outcome = refutes(&statement, |own| Witness {
        sample: {
            let half = own.terms_mut().number(Rational::from_ratio(1, 2));
            vec![(symbol(own, "n"), half)]
        },
        ..Witness::default()
    });
    assert!(outcome.is_err());
}

#[test]
fn laws_hold_at_all_times_and_not_only_at_that_of_the_claim() {
    let statement = statement(
        "parameters = ['a']\ntimes = ['t']\nfunctions = { f = '' }",
        &["f(t) = t^2"],
        "f(t) + f(a) = t^2 + a^2",
    );
    for running_is_solved in [false, true] {
        let outcome = refutes(&statement, |own| {
            let (f, time) = (function(own, "f"), own.fresh("s"));
            let nought = integer(own, 0);
            let mut values = sample(own, &[("a", 1)]);
            let t = (symbol(own, "t"), nought);
            if !running_is_solved {
                values.push(t);
            }
            Witness {
                sample: values,
                solved: if running_is_solved { vec![t] } else { Vec::new() },
                functions: vec![(f, time, nought)],
                ..Witness::default()
            }
        });
        assert!(outcome.is_err());
    }
}

#[test]
fn a_parameter_does_not_run_with_the_time() {
    let statement = statement(
        "parameters = ['x', 'a', 'b']\ntimes = ['t']\nfunctions = { g = '' }",
        &["g(t) = x"],
        "g(a) + g(t) = g(b) + g(t)",
    );
    let outcome = refutes(&statement, |own| {
        let (g, time) = (function(own, "g"), own.fresh("s"));
        let (t, s) = (of(own, "t"), own.terms_mut().symbol(time));
        Witness {
            solved: vec![(symbol(own, "x"), t)],
            sample: sample(own, &[("t", 0), ("a", 0), ("b", 1)]),
            functions: vec![(g, time, s)],
            ..Witness::default()
        }
    });
    assert!(outcome.is_err());
}

#[test]
fn real_functions_have_real_values() {
    let statement = statement(
        "parameters = ['a']\ntimes = ['t']\nfunctions = { f = '' }",
        &[],
        r"f(a)^2 \ge 0",
    );
    let outcome = refutes(&statement, |own| {
        let (f, unit, a) = (function(own, "f"), own.terms_mut().add(Node::Imaginary), of(own, "a"));
        Witness {
            sample: sample(own, &[("a", 1)]),
            table: vec![(f, 0, a, unit)],
            ..Witness::default()
        }
    });
    assert!(outcome.is_err());
    let outcome = refutes(&statement, |own| {
        let (f, unit, time) = (function(own, "f"), own.terms_mut().add(Node::Imaginary), own.fresh("s"));
        Witness {
            sample: sample(own, &[("a", 1)]),
            functions: vec![(f, time, unit)],
            ..Witness::default()
        }
    });
    assert!(outcome.is_err());
}

#[test]
fn functions_with_the_same_derivative_differ_by_a_constant() {
    let statement = statement(
        "parameters = ['a', 'b']\ntimes = ['t']\nfunctions = { F = 'h', G = 'h', h = '' }",
        &[],
        "F(a) - F(b) = G(a) - G(b)",
    );
    let outcome = refutes(&statement, |own| {
        let (first, second) = (function(own, "F"), function(own, "G"));
        let (a, b, nought, one) = (of(own, "a"), of(own, "b"), integer(own, 0), integer(own, 1));
        Witness {
            sample: sample(own, &[("a", 0), ("b", 1)]),
            table: vec![
                (first, 0, a, nought),
                (first, 0, b, one),
                (second, 0, a, nought),
                (second, 0, b, nought),
            ],
            ..Witness::default()
        }
    });
    assert!(outcome.is_err());
    let outcome = refutes(&statement, |own| {
        let (first, second, time) = (function(own, "F"), function(own, "G"), own.fresh("s"));
        let (s, nought) = (own.terms_mut().symbol(time), integer(own, 0));
        Witness {
            sample: sample(own, &[("a", 0), ("b", 1)]),
            functions: vec![(first, time, s), (second, time, nought)],
            ..Witness::default()
        }
    });
    assert!(outcome.is_err());
}

#[test]
fn named_functions_are_derivatives_of_each_other_over_several_steps() {
    let statement = statement(
        "parameters = ['a']\ntimes = ['t']\nfunctions = { F = 'G', G = 'f', f = '' }",
        &["F(t) = 0"],
        "f(a) = 0",
    );
    let outcome = refutes(&statement, |own| {
        let (first, last, time) = (function(own, "F"), function(own, "f"), own.fresh("s"));
        let (nought, one) = (integer(own, 0), integer(own, 1));
        Witness {
            sample: sample(own, &[("a", 0)]),
            functions: vec![(first, time, nought), (last, time, one)],
            ..Witness::default()
        }
    });
    assert!(outcome.is_err());
    let outcome = refutes(&statement, |own| {
        let (first, last, time) = (function(own, "F"), function(own, "f"), own.fresh("s"));
        let (nought, one, a) = (integer(own, 0), integer(own, 1), of(own, "a"));
        Witness {
            sample: sample(own, &[("a", 0)]),
            functions: vec![(first, time, nought)],
            table: vec![(last, 0, a, one)],
            ..Witness::default()
        }
    });
    assert!(outcome.is_err());
}

#[test]
fn a_function_with_a_pole_is_not_smooth() {
    // no function is 1/(2 - t) at all times
    let statement = statement(
        "parameters = ['a']\ntimes = ['t']\nfunctions = { f = '' }",
        &["f(t) (2 - t) = 1"],
        "f(a) = 7",
    );
    let outcome = refutes(&statement, |own| {
        let (f, time) = (function(own, "f"), own.fresh("s"));
        let (s, one, two) = (own.terms_mut().symbol(time), integer(own, 1), integer(own, 2));
        let below = own.terms_mut().difference(two, s);
        let quotient = own.terms_mut().quotient(one, below);
        let mut values = sample(own, &[("a", 0)]);
        values.push((time, one));
        Witness {
            sample: values,
            functions: vec![(f, time, quotient)],
            ..Witness::default()
        }
    });
    assert!(outcome.is_err());
}

#[test]
fn functions_are_not_named_in_a_circle() {
    let statement = statement(
        "parameters = ['a']\ntimes = ['t']\nfunctions = { f = '', g = '' }",
        &[],
        "f(a) = g(a)",
    );
    let outcome = refutes(&statement, |own| {
        let (f, g, time) = (function(own, "f"), function(own, "g"), own.fresh("s"));
        let (s, one) = (own.terms_mut().symbol(time), integer(own, 1));
        let (f_value, g_value) = (own.value(f, 0, s), own.value(g, 0, s));
        let (f_next, g_next) = (
            own.terms_mut().sum(vec![f_value, one]),
            own.terms_mut().sum(vec![g_value, one]),
        );
        Witness {
            sample: sample(own, &[("a", 0)]),
            functions: vec![(f, time, g_next), (g, time, f_next)],
            ..Witness::default()
        }
    });
    assert!(outcome.is_err());
}

#[test]
fn what_a_function_is_a_period_of_is_the_same_at_all_times() {
    // f(t) = f(2t + 1) at all times: f is constant
    let statement = statement(
        "parameters = ['a', 'b']\ntimes = ['t']\nfunctions = { f = '' }",
        &["f(t) = f(2t + 1)"],
        "f(a) = f(b)",
    );
    let outcome = refutes(&statement, |own| {
        let (f, a, b) = (function(own, "f"), of(own, "a"), of(own, "b"));
        let half = own.terms_mut().number(Rational::from_ratio(1, 2));
        let mut values = sample(own, &[("a", 0)]);
        values.push((symbol(own, "b"), half));
        let (nought, one) = (integer(own, 0), integer(own, 1));
        Witness {
            sample: values,
            table: vec![(f, 0, a, nought), (f, 0, b, one)],
            ..Witness::default()
        }
    });
    assert!(outcome.is_err());
}

#[test]
fn a_value_that_only_a_law_speaks_of_exists_too() {
    // x = 1/sin pi does not exist
    let statement = statement(
        "parameters = ['a', 'x', 'c']\ntimes = ['t']\nfunctions = { f = '' }",
        &["f(t) x = 1"],
        r"f(a) \neq 0",
    );
    let outcome = refutes(&statement, |own| {
        let (f, time, pi) = (function(own, "f"), own.fresh("s"), own.terms_mut().add(Node::Pi));
        let c = own.fresh("c");
        let (nothing, one) = (own.terms_mut().elementary(Elementary::Sin, pi), integer(own, 1));
        let value = own.terms_mut().symbol(c);
        let inverse = own.terms_mut().quotient(one, value);
        let mut values = sample(own, &[("a", 0)]);
        values.push((c, nothing));
        Witness {
            sample: values,
            solved: vec![(symbol(own, "x"), inverse)],
            functions: vec![(f, time, value)],
            certificate: Certificate {
                whole: Vec::new(),
                steps: vec![axiom("SineOfPi", &[])],
            },
            ..Witness::default()
        }
    });
    assert!(outcome.is_err());
}

#[test]
fn a_state_at_the_end_of_a_flight_is_what_the_flight_comes_to() {
    let statement = statement(
        "times = ['t', 't_k']\nstates = ['x']\ncontinuous = ['x']",
        &["x(t) = 0"],
        "x_{k+1} = 0",
    );
    let outcome = refutes(&statement, |own| {
        let flight = own.functions().iter().position(|_| true).unwrap();
        let flight = Function(u32::try_from(flight).unwrap());
        let (time, nought) = (own.fresh("s"), integer(own, 0));
        let values = sample(own, &[("x_{k+1}", 5)]);
        Witness {
            sample: values,
            functions: vec![(flight, time, nought)],
            ..Witness::default()
        }
    });
    assert!(outcome.is_err());
}

#[test]
fn derivatives_along_a_map_are_what_its_equations_make_them() {
    type Value = fn(&Quantity) -> i64;
    let at_one: Value = |quantity| match quantity {
        Quantity::Partial { .. } => 7,
        _ => 1,
    };
    let at_nought: Value = |quantity| match quantity {
        Quantity::Partial { .. } => 17,
        _ => 0,
    };
    let tripled: Value = |quantity| match quantity {
        Quantity::Member { offset, .. } => 3_i64.pow(offset.unsigned_abs()),
        Quantity::Partial { .. } => 5,
        _ => 1,
    };
    for (symbols, premises, claim, value) in [
        (
            "parameters = ['r']\ntimes = ['t', 't_k']\nstates = ['x']\nmaps = { D = { of = ['x_{k+1}'], by = ['x_k'] } }",
            &["x_{k+1} = r x_k"][..],
            r"\frac{\partial x_{k+1}}{\partial x_k} = r",
            at_one,
        ),
        (
            "states = ['x']\ntimes = ['t_k']\nmaps = { M = ['x_{k+1} = 2 x_k'] }",
            &[],
            r"\frac{\partial x_{k+1}}{\partial x_k} = 2",
            at_nought,
        ),
        (
            "parameters = ['a']\nstates = ['x']\nindices = ['n']",
            &["x_{n+1} = 3 x_n"],
            r"\frac{\partial x_{n+2}}{\partial x_{n+1}} = 3",
            tripled,
        ),
    ] {
        let statement = statement(symbols, premises, claim);
        let outcome = refutes(&statement, |own| {
            let values: Vec<i64> = own.quantities().iter().map(value).collect();
            let values = (0..).zip(values);
            Witness {
                sample: values
                    .map(|(number, value)| (Symbol(number), integer(own, value)))
                    .collect(),
                ..Witness::default()
            }
        });
        assert!(outcome.is_err(), "{claim}");
    }
}

#[test]
fn generic_symbols_are_not_taken_where_they_are_thin() {
    // x = y is thin in x and y
    let question = statement(
        "parameters = ['x', 'y', 'u', 'v']\ngeneric = ['x', 'y']",
        &["(x - y) u = (x - y) v"],
        "u = v",
    );
    let outcome = refutes(&question, |own| Witness {
        solved: {
            let y = of(own, "y");
            vec![(symbol(own, "x"), y)]
        },
        sample: sample(own, &[("y", 1), ("u", 1), ("v", 2)]),
        ..Witness::default()
    });
    assert!(outcome.is_err());
    for claim in [r"x \neq y", r"(x - y)^2 > 0"] {
        let question = statement("parameters = ['x', 'y']\ngeneric = ['x', 'y']", &[], claim);
        let outcome = refutes(&question, |own| Witness {
            sample: sample(own, &[("x", 1), ("y", 1)]),
            ..Witness::default()
        });
        assert!(outcome.is_err(), "{claim}");
    }
}

#[test]
fn a_pair_of_solutions_is_admissible() {
    // x is positive: -1 is no solution
    let asked = read(
        "parameters = ['x']\npositive = ['x']",
        &["x^2 = 1"],
        r"x_{1,2} = 0 \pm 1",
    )
    .unwrap();
    assert!(asked.iter().any(|question| {
        accepts(&question.statement, |_| Vec::new()).is_err()
            && refute(
                &question.statement,
                &With {
                    statement: question.statement.clone(),
                    evidence: Witness {
                        sample: {
                            let mut own = question.statement.clone();
                            sample(&mut own, &[("x", 1)])
                        },
                        ..Witness::default()
                    },
                },
            )
            .is_ok()
    }));
    // the goal of the lower one says so
    let asked = read("parameters = ['x']\npositive = ['x']", &["x^2 = 1"], r"x_{1,2} = \pm 1").unwrap();
    let lower = asked
        .iter()
        .find(|question| question.instance.starts_with("the lower"))
        .unwrap();
    let goal = lower.statement.goal();
    let is_closed = |term| lower.statement.terms().is_closed(term);
    let mut says = goal.iter().filter(|(property, _)| *property == Property::Positive);
    assert!(says.any(|(_, term)| is_closed(*term)), "{goal:?}");
}

#[test]
fn a_pair_of_solutions_is_of_no_law() {
    let asked = read(
        "parameters = ['x']\ntimes = ['t']\nfunctions = { f = '' }",
        &["x^2 = 1", "f(t + 1) = x f(t)"],
        r"x_{1,2} = 0 \pm 1",
    );
    assert!(asked.is_err());
}

#[test]
fn what_is_assumed_of_a_claim_determines_no_map() {
    // the assumption is of the point: the derivative is r
    let statement = statement(
        "parameters = ['r']\ntimes = ['t', 't_k']\nstates = ['x', 'y']\nmaps = { D = { of = ['t_{k+1}', 'x_{k+1}'], by = ['t_k', 'x_k'] } }",
        &["x_{k+1} = t_{k+1} - t_k", "t_{k+1} = t_k + 1"],
        r"\frac{\partial x_{k+1}}{\partial x_k} = 0 | assume = ['x_{k+1} = 1 + t_{k+1} 0']",
    );
    for (label, _) in &statement.implicit()[0].equations {
        assert_ne!(*label, Origin::Assumptions);
    }
}

#[test]
fn a_recursion_with_a_factor_that_vanishes_somewhere_is_no_recursion() {
    // (n - 3) x_{n+1} = x_n makes x_3 = 0 and with it all before
    let statement = statement(
        "states = ['x_n']\nindices = ['n']",
        &["(n - 3) x_{n+1} = x_n"],
        "x_n = 0 | assume = ['n < 3']",
    );
    let outcome = refutes(&statement, |own| Witness {
        sample: sample(own, &[("n", 2), ("x_n", 1), ("x_{n+1}", -1)]),
        ..Witness::default()
    });
    assert!(outcome.is_err());
}

#[test]
fn a_state_that_is_positive_is_so_at_every_impact() {
    // no such sequence goes on for ever
    let statement = statement(
        "states = ['x_n']\nindices = ['n']\npositive = ['x_n']",
        &["x_{n+1} = x_n - 1"],
        "x_n = 5",
    );
    let outcome = refutes(&statement, |own| Witness {
        sample: sample(own, &[("x_n", 2), ("x_{n+1}", 1)]),
        ..Witness::default()
    });
    assert!(outcome.is_err());
}

#[test]
fn a_law_of_sequences_and_times_holds_at_every_index() {
    let statement = statement(
        "times = ['t']\nstates = ['x_n']\nindices = ['n']\nfunctions = { f = '' }",
        &["f(t) = x_n t"],
        "x_{n+1} = x_n",
    );
    let outcome = refutes(&statement, |own| {
        let (f, time) = (function(own, "f"), own.fresh("s"));
        let s = own.terms_mut().symbol(time);
        Witness {
            sample: sample(own, &[("x_n", 1), ("x_{n+1}", 2)]),
            functions: vec![(f, time, s)],
            ..Witness::default()
        }
    });
    assert!(outcome.is_err());
}

#[test]
fn what_is_assumed_of_a_premise_at_running_times_is_no_fact() {
    let statement = statement(
        "parameters = ['x', 'a']\ntimes = ['t']\nfunctions = { f = '' }",
        &["x = 1 | assume = ['t > 0']"],
        "f(t) t \\le f(t) t + t + a - a",
    );
    let assumed = statement
        .givens()
        .iter()
        .any(|given| given.property == Property::Positive && given.law.is_none());
    assert!(!assumed, "{:#?}", statement.givens());
}

#[test]
fn a_fractional_exponent_needs_a_base_that_is_not_negative_in_assumptions_too() {
    let statement = statement("parameters = ['x']", &[], r"|x| = x | assume = ['x^{1/3} \le 1']");
    let outcome = refutes(&statement, |own| Witness {
        sample: sample(own, &[("x", -1)]),
        certificate: Certificate::default(),
        ..Witness::default()
    });
    assert!(outcome.is_err());
}

#[test]
fn the_inverse_hyperbolic_cosine_is_principal_where_complex_numbers_take_part() {
    let statement = statement(
        "parameters = ['z']\ncomplex = ['z']",
        &[],
        r"\arcosh z = \ln(z + \sqrt{z^2 - 1})",
    );
    assert!(accepts(&statement, |_| Vec::new()).is_err());
}

#[test]
fn what_is_declared_of_states_and_times_is_given() {
    // a complex state is no real number, a positive one is positive
    let complex = statement(
        "states = ['z_n']\nindices = ['n']\ncomplex = ['z_n']",
        &["z_{n+1} = z_n"],
        r"z_n^2 \neq -1",
    );
    assert!(complex.is_complex());
    let positive = statement(
        "states = ['x_n']\nindices = ['n']\npositive = ['x_n']",
        &[],
        r"|x_n| = x_n",
    );
    assert!(
        positive
            .givens()
            .iter()
            .any(|given| given.property == Property::Positive)
    );
    let outcome = refutes(&positive, |own| Witness {
        sample: sample(own, &[("x_n", -1)]),
        ..Witness::default()
    });
    assert!(outcome.is_err());
}

#[test]
fn a_step_speaks_of_terms_that_are_there_and_of_monomials_in_order() {
    let own = statement("parameters = ['x']", &[], "x = x");
    for beyond in [Term(u32::MAX), Term(own.terms().len() as u32)] {
        assert!(accepts(&own, |_| vec![axiom("Pythagoras", &[beyond])]).is_err());
        assert!(accepts(&own, |_| vec![axiom("CosineOfNegative", &[beyond, beyond])]).is_err());
        let beside = generator(beyond);
        assert!(accepts(&own, |_| vec![Inference::Enclosure(beside)]).is_err());
    }
    // t t, written with a repeat, and t to the power 0, which are no monomials
    for monomial in [vec![1, 1], vec![0]] {
        let outcome = accepts(&own, |own| {
            let (one, x) = (integer(own, 1), of(own, "x"));
            let cosine = own.terms_mut().elementary(Elementary::Cos, one);
            assert_ne!(cosine, x);
            let monomial = monomial.iter().map(|power| (cosine, *power)).collect();
            vec![Inference::Enclosure(Polynomial::from_terms([(
                monomial,
                Rational::from_integer(1).0,
            )]))]
        });
        assert!(outcome.is_err());
    }
    // a witness gives no value by a term that is none
    let outcome = refutes(&statement("parameters = ['x']", &[], "x = 1"), |own| Witness {
        sample: vec![(symbol(own, "x"), Term(u32::MAX))],
        ..Witness::default()
    });
    assert!(outcome.is_err());
}

#[test]
fn a_point_is_one_of_the_terms_that_the_statement_has() {
    let [own, other] = ["x = 1", "x = 2"].map(|premise| statement("parameters = ['x']", &[premise], "x = x"));
    let point = |own: &Statement, value: i64| {
        let mut extended = own.clone();
        let evidence = Witness {
            sample: sample(&mut extended, &[("x", value)]),
            ..Witness::default()
        };
        match evaluate(
            own,
            &With {
                statement: extended,
                evidence,
            },
        ) {
            Ok(Evaluated::Holds(point)) => Some(point),
            _ => None,
        }
    };
    let certificate = With {
        statement: own.clone(),
        evidence: Certificate::default(),
    };
    assert!(prove(&own, &certificate, &point(&own, 1).unwrap()).is_ok());
    // the same statement with the terms of another
    let mut changed = own.clone();
    *changed.terms_mut() = other.terms().clone();
    let elsewhere = point(&changed, 2).unwrap();
    assert!(prove(&own, &certificate, &elsewhere).is_err());
}

#[test]
fn an_abbreviation_is_what_it_stands_for_where_that_has_a_value() {
    let mut draft = Draft::new(false, Vec::new(), Vec::new(), Default::default());
    let [short, below] = ["a", "y"].map(|name| draft.fresh(name));
    let one = draft.terms_mut().integer(1);
    let below = draft.terms_mut().symbol(below);
    let quotient = draft.terms_mut().quotient(one, below);
    draft.parts().definitions.insert(short, quotient);
    let short = draft.terms_mut().symbol(short);
    let nothing = draft.terms_mut().integer(0);
    let own = draft.finish(vec![(Property::Zero, nothing)]);
    assert!(accepts(&own, |_| Vec::new()).is_ok());
    assert!(accepts(&own, |_| vec![Inference::Unfold(short)]).is_err());
}
