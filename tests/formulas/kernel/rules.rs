//! The statement says what is printed, derivatives are derivatives, and each rule takes what it should and no more.

use super::digits::{Value, value};
use super::forge::*;
use proptest::prelude::*;
use std::collections::{BTreeSet, HashMap};
use vibro_audit::kernel::{
    Certificate, Checker, Elementary, Expansion, Inference, LawSource, Node, Polynomial, Property, Statement, Summand,
    Witness,
};
use vibro_audit::number::{Field, Rational};

/// The value of the right side of `y = ...` at x = 0.7 and n = 3.
fn printed(formula: &str, instance: usize) -> f64 {
    // signs on one side alone are not read: which of them are meant cannot be told
    let left = if formula.contains(r"\pm") { r"y \pm 0" } else { "y" };
    let asked = read(
        "parameters = ['x', 'y']\nintegers = ['n']",
        &[],
        &format!("{left} = {formula}"),
    )
    .unwrap();
    let mut own = asked[instance].statement.clone();
    let at = point(&mut own, &[("x", 0.7), ("y", 0.0), ("n", 3.0)]);
    let (_, goal) = own.goal()[0];
    let found = value(&own, goal, &at).unwrap_or_else(|| panic!("{formula}"));
    -float(&found)
}

fn float(value: &Value) -> f64 {
    value.re.to_string().parse().unwrap()
}

fn point(own: &mut Statement, values: &[(&str, f64)]) -> HashMap<vibro_audit::kernel::Symbol, Value> {
    let known: Vec<String> = (0..own.terms().symbols())
        .map(|n| {
            own.terms()
                .symbol_name(vibro_audit::kernel::Symbol(n as u32))
                .to_string()
        })
        .collect();
    let met = values
        .iter()
        .filter(|(name, _)| known.iter().any(|known| known == name));
    met.map(|(name, value)| (symbol(own, name), Value::number(*value)))
        .collect()
}

#[test]
fn what_is_printed_is_what_is_stated() {
    let x = 0.7_f64;
    let cases: &[(&str, f64)] = &[
        (r"\sin x", x.sin()),
        (r"\cos x", x.cos()),
        (r"\tan x", x.tan()),
        (r"\cot x", 1.0 / x.tan()),
        (r"\sec x", 1.0 / x.cos()),
        (r"\csc x", 1.0 / x.sin()),
        (r"\sinh x", x.sinh()),
        (r"\cosh x", x.cosh()),
        (r"\tanh x", x.tanh()),
        (r"\coth x", 1.0 / x.tanh()),
        (r"\arsinh x", x.asinh()),
        (r"\arcosh(x + 1)", (x + 1.0).acosh()),
        (r"\artanh x", x.atanh()),
        (r"\arcsin x", x.asin()),
        (r"\arccos x", x.acos()),
        (r"\arctan x", x.atan()),
        (r"\ln x", x.ln()),
        (r"\exp x", x.exp()),
        (r"e^x", x.exp()),
        (r"e", 1.0_f64.exp()),
        (r"\pi", std::f64::consts::PI),
        (r"\sqrt{x}", x.sqrt()),
        (r"\sqrt[3]{-x}", -x.cbrt()),
        (r"x^{2/3}", x.powf(2.0 / 3.0)),
        (r"x^{-1/2}", x.powf(-0.5)),
        (r"x^{-3}", x.powi(-3)),
        (r"x^0", 1.0),
        (r"2^x", 2.0_f64.powf(x)),
        (r"x^n", x.powi(3)),
        (r"|x - 1|", 1.0 - x),
        (r"\frac{1 - x}{1 + x}", (1.0 - x) / (1.0 + x)),
        (r"-x^2", -x * x),
        (r"(1 - x)(2 + x)", (1.0 - x) * (2.0 + x)),
    ];
    for (formula, expected) in cases {
        let found = printed(formula, 0);
        assert!((found - expected).abs() < 1e-12, "{formula}: {found}, not {expected}");
    }
    for (instance, sign) in [(0, 1.0), (1, -1.0)] {
        let found = printed(r"1 \pm 2x \mp 3", instance);
        assert!((found - (1.0 + sign * (2.0 * x - 3.0))).abs() < 1e-12, "{found}");
    }
}

#[test]
fn relations_are_stated_with_their_direction() {
    use Property::{NonNegative, Nonzero, Positive, Zero};
    for (claim, property, at_one) in [
        ("x = 3", Zero, -2.0),
        (r"x \neq 3", Nonzero, -2.0),
        ("x < 3", Positive, 2.0),
        (r"x \le 3", NonNegative, 2.0),
        ("x > 3", Positive, -2.0),
        (r"x \ge 3", NonNegative, -2.0),
    ] {
        let mut own = statement("parameters = ['x']", &[], claim);
        let at = point(&mut own, &[("x", 1.0)]);
        let (stated, goal) = own.goal()[0];
        assert_eq!(stated, property, "{claim}");
        assert!(
            (float(&value(&own, goal, &at).unwrap()) - at_one).abs() < 1e-12,
            "{claim}"
        );
    }
}

#[test]
fn the_domain_of_what_is_written_is_given() {
    use Property::{NonNegative, Nonzero, Positive};
    for (formula, property, inside, outside) in [
        (r"\frac{1}{x}", Nonzero, 1.0, 0.0),
        (r"\sqrt{x}", NonNegative, 0.0, -1.0),
        (r"\ln x", Positive, 1.0, 0.0),
        (r"\arcsin x", NonNegative, 1.0, 2.0),
        (r"\arccos x", NonNegative, -1.0, -2.0),
        (r"x^{1/3}", NonNegative, 0.0, -1.0),
        (r"\tan(x - 1)", Nonzero, 1.0, 1.0 + std::f64::consts::FRAC_PI_2),
        (r"x^y", NonNegative, 1.0, -1.0),
    ] {
        let mut own = statement("parameters = ['x', 'y']", &[], &format!("y = {formula}"));
        for (x, is_inside) in [(inside, true), (outside, false)] {
            let at = point(&mut own, &[("x", x), ("y", 0.0)]);
            let holds = own.givens().iter().all(|given| {
                value(&own, given.term, &at).is_some_and(|found| {
                    let found = float(&found);
                    match given.property {
                        Property::Zero => found.abs() < 1e-12,
                        Nonzero => found.abs() > 1e-12,
                        Positive => found > 1e-12,
                        NonNegative => found > -1e-12,
                        Property::Integer => true,
                    }
                })
            });
            assert!(own.givens().iter().any(|given| given.property == property), "{formula}");
            assert_eq!(holds, is_inside, "{formula} at {x}");
        }
    }
}

#[test]
fn derivatives_are_the_limits_of_differences() {
    let formulas = [
        r"x^3 y - 2 x",
        r"\frac{x y}{1 + x^2}",
        r"\sin(x^2) \cos(3 x)",
        r"e^{x y}",
        r"\ln(1 + x^2)",
        r"\sqrt{x} + \sqrt[3]{x}",
        r"\arcsin(x/2) + \arccos(x/3) \arctan x",
        r"x^{y}",
        r"y^{x}",
        r"(x + y)^4 (x - y)^2",
        r"A^2 + x",
    ];
    for formula in formulas {
        let symbols = "parameters = ['x', 'y']\nabbreviations = ['A = x y']";
        let mut own = statement(symbols, &[], &format!("0 = -({formula})"));
        let (goal, by) = (own.goal()[0].1, symbol(&own, "x"));
        let slope = own.derivative(goal, by);
        let step = 1.0 / 1048576.0;
        let mut of = |x: f64, term| {
            let at = point(&mut own, &[("x", x), ("y", 1.5)]);
            float(&value(&own, term, &at).unwrap())
        };
        let difference = (of(0.7 + step, goal) - of(0.7 - step, goal)) / (2.0 * step);
        let found = of(0.7, slope);
        assert!(
            (found - difference).abs() < 1e-8,
            "{formula}: {found}, not {difference}"
        );
    }
}

/// Facts known beforehand: 0 and 1 not negative, 2 and 3 positive, 4 not zero, 5 zero: a, b, c, d, e, f.
pub fn with_facts(step: impl FnOnce(&[Polynomial]) -> Inference) -> bool {
    let symbols = "parameters = ['a', 'b', 'c', 'd', 'e', 'f']";
    let mut own = statement(symbols, &[], "a + b + c + d + e + f = f + e + d + c + b + a");
    let generators: Vec<Polynomial> = ["a", "b", "c", "d", "e", "f"]
        .iter()
        .map(|name| generator(of(&mut own, name)))
        .collect();
    let mut checker = Checker::new(&mut own, &Certificate::default(), 100_000);
    let properties = [
        Property::NonNegative,
        Property::NonNegative,
        Property::Positive,
        Property::Positive,
        Property::Nonzero,
        Property::Zero,
    ];
    for (property, generator) in properties.into_iter().zip(&generators) {
        checker.suppose(property, generator.clone());
    }
    checker.apply(&step(&generators)).is_ok()
}

fn number(value: i64) -> Rational {
    Rational::from_integer(value)
}

fn summand(factor: i64, facts: &[usize], root: Polynomial) -> Summand {
    Summand {
        factor: number(factor),
        facts: facts.to_vec(),
        root,
    }
}

#[test]
fn signs_are_made_of_signs() {
    let one = || Polynomial::integer(1);
    let sign = |target: Polynomial, strict, factors: Vec<(usize, u32)>, summands: Vec<Summand>| Inference::Sign {
        target,
        strict,
        factors,
        summands,
        terms: Vec::new(),
    };
    // a + b is not negative; nothing says that it is positive
    let sum = || vec![summand(1, &[0], one()), summand(1, &[1], one())];
    assert!(with_facts(|g| sign(g[0].plus(&g[1]), false, vec![], sum())));
    assert!(!with_facts(|g| sign(g[0].plus(&g[1]), true, vec![], sum())));
    // c + a b e² is positive by c, e² c is not by itself
    assert!(with_facts(|g| {
        let last = g[0].times(&g[1]).times(&g[4]).times(&g[4]);
        let summands = vec![summand(1, &[2], one()), summand(1, &[0, 1], g[4].clone())];
        sign(g[2].plus(&last), true, vec![], summands)
    }));
    assert!(!with_facts(|g| {
        sign(
            g[2].times(&g[4]).times(&g[4]),
            true,
            vec![],
            vec![summand(1, &[2], g[4].clone())],
        )
    }));
    // not by negative numbers, by facts of no sign, or after factors that may be negative
    assert!(!with_facts(|g| sign(
        g[0].negated(),
        false,
        vec![],
        vec![summand(-1, &[0], one())]
    )));
    assert!(!with_facts(|g| sign(
        g[4].clone(),
        false,
        vec![],
        vec![summand(1, &[4], one())]
    )));
    assert!(!with_facts(|g| {
        sign(g[0].clone(), false, vec![(4, 1)], vec![summand(1, &[0], g[4].clone())])
    }));
    assert!(with_facts(|g| {
        sign(g[0].clone(), false, vec![(2, 1)], vec![summand(1, &[0, 2], one())])
    }));
    assert!(!with_facts(|g| sign(
        g[0].clone(),
        false,
        vec![(0, 1)],
        vec![summand(1, &[0, 0], one())]
    )));
}

#[test]
fn what_vanishes_is_a_combination_of_what_vanishes() {
    let made = |target: Polynomial, power, squares: Vec<(Rational, Polynomial)>, factors, terms| Inference::Zero {
        target,
        power,
        squares,
        factors,
        terms,
    };
    let one = || Polynomial::integer(1);
    assert!(with_facts(|g| made(
        g[5].times(&g[0]),
        1,
        vec![],
        vec![],
        vec![(g[0].clone(), 5)]
    )));
    // e (e f) = e² f: e is not 0; a may be
    assert!(with_facts(|g| made(
        g[0].times(&g[5]),
        1,
        vec![],
        vec![(4, 1)],
        vec![(g[0].times(&g[4]), 5)]
    )));
    assert!(!with_facts(|g| made(
        g[4].times(&g[5]),
        1,
        vec![],
        vec![(0, 1)],
        vec![(g[0].times(&g[4]), 5)]
    )));
    assert!(!with_facts(|g| made(one(), 0, vec![], vec![], vec![(g[0].clone(), 5)])));
    assert!(!with_facts(|g| made(g[0].clone(), 1, vec![], vec![], vec![(one(), 0)])));
    // squares: an even power and positive numbers, every one of them
    let with_squares = |target: Polynomial, power, squares: Vec<(Rational, Polynomial)>| {
        // their sum is made known first
        let mut own = statement("parameters = ['a', 'b']", &[], "a + b = b + a");
        let (a, b) = (generator(of(&mut own, "a")), generator(of(&mut own, "b")));
        let mut sum = (0..power).fold(Polynomial::integer(1), |product, _| product.times(&target));
        for (factor, root) in &squares {
            sum = sum.plus(&root.times(root).scaled(factor));
        }
        let _ = (a, b);
        let mut checker = Checker::new(&mut own, &Certificate::default(), 100_000);
        checker.suppose(Property::Zero, sum);
        checker
            .apply(&made(target, power, squares, vec![], vec![(Polynomial::integer(1), 0)]))
            .is_ok()
    };
    let mut own = statement("parameters = ['a', 'b']", &[], "a + b = b + a");
    let (a, b) = (generator(of(&mut own, "a")), generator(of(&mut own, "b")));
    assert!(with_squares(
        a.clone(),
        2,
        vec![(number(1), b.clone()), (number(2), a.clone())]
    ));
    assert!(!with_squares(
        a.clone(),
        2,
        vec![(number(1), b.clone()), (number(-2), a.clone())]
    ));
    assert!(!with_squares(a.clone(), 2, vec![(number(-1), b.clone())]));
    assert!(!with_squares(a.clone(), 3, vec![(number(1), b.clone())]));
}

#[test]
fn what_is_squeezed_is_neither_positive_nor_negative() {
    let squeezed = |first: Property, second: Property| {
        let mut own = statement("parameters = ['a']", &[], "a = a");
        let a = generator(of(&mut own, "a"));
        let mut checker = Checker::new(&mut own, &Certificate::default(), 1000);
        checker.suppose(first, a.clone());
        checker.suppose(second, a.negated());
        checker.apply(&Inference::Squeezed { low: 0, high: 1 }).is_ok()
    };
    assert!(squeezed(Property::NonNegative, Property::NonNegative));
    assert!(squeezed(Property::NonNegative, Property::Positive));
    assert!(!squeezed(Property::NonNegative, Property::Nonzero));
    assert!(!squeezed(Property::Nonzero, Property::NonNegative));
    assert!(!with_facts(|_| Inference::Squeezed { low: 0, high: 1 }));
}

/// Returns true if a sum of terms is shown to be positive where x and y lie between the bounds that are given.
fn between(target: &str, bounds: &[&str], within: Vec<[usize; 2]>) -> bool {
    let mut own = statement("parameters = ['x', 'y', 'z']", bounds, &format!("{target} = 0"));
    let (_, target) = own.goal()[0];
    let target = Expansion::new(BTreeSet::new(), 100_000)
        .of(own.terms(), target)
        .unwrap();
    assert!(target.divisors.is_empty());
    let mut checker = Checker::new(&mut own, &Certificate::default(), 100_000);
    for given in 0..bounds.len() {
        checker.apply(&Inference::Given(given)).unwrap();
    }
    let target = target.numerator;
    checker.apply(&Inference::Between { target, within }).is_ok()
}

#[test]
fn what_is_positive_between_bounds_is_so_at_each_value() {
    let unit = ["x \\ge 0", "x \\le 1"];
    let is_positive = |target: &str| between(target, &unit, vec![[0, 1]]);
    assert!(is_positive(r"x^2 - x + 1"));
    assert!(is_positive(r"\cos x"));
    assert!(is_positive(r"\sqrt{x} - x + \frac{1}{100}"));
    assert!(is_positive(r"\exp(x) - x"));
    // 0 at an end, below 0 in between or beyond, without a value at some, without a bound
    for wrong in [
        r"x",
        r"1 - x",
        r"x^2 - x + \frac{1}{4}",
        r"x^2 - x + \frac{6}{25}",
        r"\cos(2 x)",
        r"2 + \sqrt{x - \frac{1}{2}}",
        r"2 + \arcsin(2 x)",
        r"x^2 + 1 + y^2",
        r"-1",
    ] {
        assert!(!is_positive(wrong), "{wrong}");
    }
    let square = ["x > 0", "x < 1", "y \\ge x", "y \\le 2", "y > 1", "z \\ne 0"];
    let target = r"2 y - x + \sin(x y)";
    assert!(between(target, &square, vec![[0, 1], [4, 3]]));
    assert!(!between(target, &square, vec![[0, 1]]));
    assert!(!between(target, &square, vec![[1, 0], [4, 3]]));
    assert!(!between(target, &square, vec![[0, 1], [2, 3]]));
    assert!(!between(target, &square, vec![[0, 1], [4, 5]]));
    assert!(!between(target, &square, vec![[0, 1], [0, 1]]));
    assert!(!between(target, &square, vec![[0, 1], [4, 9]]));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn no_polynomial_that_fails_at_a_point_is_shown_to_be_positive_between_bounds(
        coefficients in proptest::collection::vec(-9_i64..10, 6), low in -3_i64..2, width in 1_i64..4, part in 0_u32..=64,
    ) {
        let [a, b, c, d, e, f] = [0, 1, 2, 3, 4, 5].map(|n| coefficients[n]);
        let target = format!(r"({a}) + ({b}) x + ({c}) x^2 + ({d}) x^3 + ({e}) \sin x + ({f}) \exp x");
        let high = low + width;
        let bounds = [format!(r"x \ge {low}"), format!(r"x \le {high}")];
        let is_shown = between(&target, &bounds.each_ref().map(String::as_str), vec![[0, 1]]);
        let value = |x: f64| {
            let powers = a as f64 + b as f64 * x + c as f64 * x * x + d as f64 * x * x * x;
            powers + e as f64 * x.sin() + f as f64 * x.exp()
        };
        let at = value(low as f64 + width as f64 * f64::from(part) / 64.0);
        prop_assert!(!is_shown || at > -1e-9, "{target} from {low} to {high}: {at}");
        let least = (0..=1000).map(|n| value(low as f64 + width as f64 * f64::from(n) / 1000.0)).fold(f64::MAX, f64::min);
        prop_assert!(is_shown || least < 0.05, "{target} from {low} to {high} is not shown: {least}");
    }
}

#[test]
fn cases_cover() {
    let cases = |order, branches: usize, target_of_case: i64| {
        let mut own = statement("parameters = ['a']", &[], "a = a");
        let a = generator(of(&mut own, "a"));
        let mut checker = Checker::new(&mut own, &Certificate::default(), 1000);
        let target = a.times(&a).plus(&Polynomial::integer(target_of_case));
        // a² is not negative, in each case: a square
        let step = Inference::Sign {
            target: target.clone(),
            strict: false,
            factors: vec![],
            summands: vec![summand(1, &[], a.clone())],
            terms: vec![],
        };
        let step = Inference::Cases {
            on: a.clone(),
            order,
            property: Property::NonNegative,
            target,
            branches: vec![vec![step]; branches],
        };
        checker.apply(&step).is_ok() && checker.facts.len() == 1
    };
    assert!(cases(true, 3, 0) && cases(false, 2, 0));
    assert!(!cases(true, 2, 0) && !cases(false, 3, 0) && !cases(true, 1, 0));
    assert!(!cases(true, 3, 1));
}

#[test]
fn equal_arguments_have_equal_values() {
    let congruent = |premises: &[&str], left: &str, right: &str| {
        let mut own = statement(
            "parameters = ['a', 'b']\ntimes = ['t']\nfunctions = { f = '' }",
            premises,
            &format!("f(a) + \\sin {left} + \\cos {right} = 0"),
        );
        let find = |own: &Statement, function| {
            (0..own.terms().len())
                .map(|n| vibro_audit::kernel::Term(n as u32))
                .find(|term| matches!(own.terms().node(*term), Node::Elementary(found, _) if *found == function))
        };
        let (sine, cosine) = (
            find(&own, Elementary::Sin).unwrap(),
            find(&own, Elementary::Cos).unwrap(),
        );
        let Node::Elementary(_, right) = *own.terms().node(cosine) else {
            unreachable!()
        };
        let other = own.terms_mut().elementary(Elementary::Sin, right);
        let count = own.givens().iter().filter(|given| given.law.is_none()).count();
        let mut checker = Checker::new(&mut own, &Certificate::default(), 10_000);
        for number in 0..count {
            checker.apply(&Inference::Given(number)).unwrap();
        }
        let same = Inference::Congruence {
            left: sine,
            right: other,
        };
        let different = Inference::Congruence {
            left: sine,
            right: cosine,
        };
        assert!(checker.apply(&different).is_err());
        checker.apply(&same).is_ok()
    };
    assert!(congruent(&["a = b"], "a", "b"));
    assert!(congruent(&[], "(a + a)", "(2 a)"));
    assert!(!congruent(&[], "a", "b"));
    assert!(!congruent(&["a = -b"], "a", "b"));
}

pub const FLIGHT: &str =
    "parameters = ['g', 's']\ntimes = ['t', 't_k']\nstates = ['x', '\\dot{x}']\ncontinuous = ['x']";

#[test]
fn a_law_of_flight_holds_from_its_impact_to_the_next() {
    let own = statement(
        FLIGHT,
        &[r"\dot{x}(t) = g t"],
        r"\dot{x}_{k+1} = \dot{x}_k + g (t_{k+1} - t_k) + 0 s",
    );
    let law_number = given(&own, "p0", true);
    let at = |name: &str, shift: i32| {
        let outcome = accepts(&own, |own| {
            let at = of(own, name);
            vec![law(law_number, shift, Some(at))]
        });
        !outcome.unwrap_err().to_string().contains("step 0")
    };
    assert!(at("t_k", 0) && at("t_{k+1}", 0) && at("t_{k+1}", 1) && at("t_k", -1));
    assert!(!at("s", 0) && !at("t_k", 1) && !at("t_{k+1}", -1) && !at("g", 0));
}

#[test]
fn what_has_no_derivative_keeps_its_value() {
    // f' = 0: f is constant; f' = 0 for t > 0 says nothing across 0
    let constant = |premise: &str| {
        let own = statement(
            "parameters = ['a', 'b']\ntimes = ['t']\nfunctions = { f = '' }",
            &[premise],
            "f(a) = f(b)",
        );
        let law_number = given(&own, "p0", true);
        accepts(&own, |own| {
            let (f, time) = (function(own, "f"), own.fresh("s"));
            let (s, a, b) = (own.terms_mut().symbol(time), of(own, "a"), of(own, "b"));
            let term = own.value(f, 0, s);
            let (first, second) = (own.value(f, 0, a), own.value(f, 0, b));
            vec![
                Inference::Constant {
                    of: term,
                    time,
                    at: b,
                    interval: None,
                    steps: vec![law(law_number, 0, Some(s))],
                },
                Inference::Law {
                    source: LawSource::Derived(0),
                    at: Some(a),
                },
                zero(
                    generator(first).minus(&generator(second)),
                    vec![(Polynomial::integer(1), 0)],
                ),
            ]
        })
        .is_ok()
    };
    assert!(constant("f'(t) = 0"));
    assert!(!constant("f'(t) = 1"));
    assert!(!constant("f'(t) = 0 | assume = ['t > 0']"));
    assert!(!constant("f'(t) t = 0"));
    assert!(!constant(r"f'(t) = 0 \sqrt{t}"));
}

#[test]
fn derivatives_of_laws_hold_where_the_laws_do() {
    let slope = |premise: &str, claim: &str| {
        let own = statement(
            "parameters = ['a']\npositive = ['a']\ntimes = ['t']\nfunctions = { f = '' }",
            &[premise],
            claim,
        );
        let law_number = given(&own, "p0", true);
        let positive = given(&own, "[symbols] a", false);
        accepts(&own, |own| {
            let a = of(own, "a");
            let f = function(own, "f");
            let value = own.value(f, 1, a);
            let source = LawSource::Given {
                given: law_number,
                shift: 0,
            };
            vec![
                Inference::Given(positive),
                Inference::Derivative(source),
                Inference::Law {
                    source: LawSource::Derived(0),
                    at: Some(a),
                },
                zero(
                    generator(value).minus(&generator(a).scaled(&number(2))),
                    vec![(Polynomial::integer(1), 1)],
                ),
            ]
        })
        .is_ok()
    };
    assert!(slope("f(t) = t^2", "f'(a) = 2 a"));
    assert!(slope("f(t) = t^2 | assume = ['t > 0']", "f'(a) = 2 a"));
    assert!(!slope("f(t) = t^2 | assume = ['t < 0']", "f'(a) = 2 a"));
    assert!(!slope("f(t) = t^2 | assume = ['t = 1']", "f'(a) = 2 a"));
    // a is positive, and a law for t >= 0 holds on both sides of it
    assert!(slope("f(t) = t^2 | assume = ['t \\ge 0']", "f'(a) = 2 a"));
    assert!(!slope("f(t) = t^2 | assume = ['-t^2 \\ge 0']", "f'(a) = 2 a"));
    assert!(!slope(r"f(t) \ge t^2", "f'(a) = 2 a"));
}

#[test]
fn what_holds_at_a_single_time_or_from_it_on_has_no_derivative_there() {
    let slope_at_1 = |premise: &str| {
        let own = statement("times = ['t']\nfunctions = { f = '' }", &[premise], "f'(1) = 2");
        let given = given(&own, "p0", true);
        accepts(&own, |own| {
            let one = integer(own, 1);
            let f = function(own, "f");
            let value = own.value(f, 1, one);
            vec![
                Inference::Derivative(LawSource::Given { given, shift: 0 }),
                Inference::Law {
                    source: LawSource::Derived(0),
                    at: Some(one),
                },
                zero(
                    generator(value).minus(&Polynomial::integer(2)),
                    vec![(Polynomial::integer(1), 0)],
                ),
            ]
        })
        .is_ok()
    };
    for premise in [
        "f(t) = 2 t",
        r"f(t) = 2 t + 0 \sqrt{t}",
        r"f(t) = 2 t + 0 \ln(t)",
        r"f(t) = 2 t | assume = ['t \ge 0']",
        r"f(t) = 2 t | assume = ['\sqrt{t} < 2']",
        r"f(t) (\sqrt{t})^0 = 2 t",
    ] {
        assert!(slope_at_1(premise), "{premise}");
    }
    for premise in [
        r"f(t) (\sqrt{-(t-1)^2})^0 = 2 t",
        r"f(t) = 2 t + 0 \sqrt{-(t-1)^2}",
        r"f(t) = 2 t + 0 \sqrt{t-1}",
        r"f(t) = 2 t + 0 \sqrt{1-t}",
        r"f(t) = 2 t + 0 \arcsin(1 + (t-1)^2)",
        r"f(t) = 2 t + 0 \arccos(2 t^2 - 1)",
        r"f(t) = 2 t | assume = ['-(t-1)^2 \ge 0']",
        r"f(t) = 2 t | assume = ['t \ge 1']",
        r"f(t) = 2 t | assume = ['t = 1']",
        r"f(t) = 2 t | assume = ['0 \sqrt{-(t-1)^2} = 0']",
        r"f(t) = 2 t | assume = ['\sqrt{-(t-1)^2} + 1 > 0']",
    ] {
        assert!(!slope_at_1(premise), "{premise}");
    }
}

const SMOOTH: &str = "parameters = ['a', 'b', 'c']\ntimes = ['t']\nfunctions = { F = 'f', f = '' }";

#[test]
fn a_table_is_of_times_that_are_apart() {
    let table = |premises: &[&str], a: i64, b: i64| {
        let own = statement(SMOOTH, premises, "f(a) = f(b) + 0 c");
        refutes(&own, |own| {
            let f = function(own, "f");
            let (at_a, at_b, nought, one) = (of(own, "a"), of(own, "b"), integer(own, 0), integer(own, 1));
            Witness {
                sample: {
                    let third = |own: &mut Statement, n| own.terms_mut().number(Rational::from_ratio(n, 3));
                    let (x, y, z) = (third(own, a), third(own, b), integer(own, 0));
                    vec![(symbol(own, "a"), x), (symbol(own, "b"), y), (symbol(own, "c"), z)]
                },
                table: vec![(f, 0, at_a, nought), (f, 0, at_b, one)],
                ..Witness::default()
            }
        })
        .is_ok()
    };
    assert!(table(&[], 0, 1) && table(&[], 1, 7));
    assert!(!table(&[], 1, 1));
    // with the period 1, thirds are apart and wholes are not
    let period: &[&str] = &["f(t + 1) = f(t)"];
    assert!(table(period, 0, 1) && table(period, 1, 6) && table(&["f(t) = f(t + 1)"], 0, 2));
    assert!(!table(period, 0, 3) && !table(period, 1, 7));
    // other laws bind the function
    assert!(!table(&["f(t + 1) = 2 f(t)"], 0, 1));
    assert!(!table(&["f(t) = f(-t)"], 0, 1));
    assert!(!table(&[r"f(t) \ge 0"], 0, 1));
    assert!(!table(&["f'(t) = 0"], 0, 1));
    assert!(!table(&["f(t + 1) = f(t)", "f(t + 2/7) = f(t)"], 0, 1));
}

#[test]
fn a_named_function_obeys_its_laws() {
    let named =
        |premises: &[&str],
         claim: &str,
         make: &dyn Fn(&mut Statement, vibro_audit::kernel::Term) -> vibro_audit::kernel::Term| {
            let own = statement(SMOOTH, premises, claim);
            refutes(&own, |own| {
                let (f, time) = (function(own, "f"), own.fresh("s"));
                let s = own.terms_mut().symbol(time);
                let term = make(own, s);
                let values: Vec<(&str, i64)> = ["a", "b", "c"]
                    .into_iter()
                    .zip([1, 2, 0])
                    .filter(|(name, _)| {
                        (0..own.terms().symbols())
                            .any(|n| own.terms().symbol_name(vibro_audit::kernel::Symbol(n as u32)) == *name)
                    })
                    .collect();
                Witness {
                    sample: sample(own, &values),
                    functions: vec![(f, time, term)],
                    ..Witness::default()
                }
            })
            .is_ok()
        };
    let square = |own: &mut Statement, s| own.terms_mut().add(Node::Power(s, 2));
    assert!(named(&["f(-t) = f(t)"], "f(a) = f(b)", &square));
    assert!(!named(&["f(-t) = -f(t)"], "f(a) = f(b)", &square));
    assert!(!named(&["f(-t) = f(t)"], "f(a) = f(-a) + 0 b", &square));
    assert!(!named(&[r"f(t) \ge 0"], "f(a) = f(b)", &square));
    // smooth everywhere or not
    let over = |own: &mut Statement, s, rest: i64, power: i32| {
        let (one, rest, power) = (
            integer(own, 1),
            integer(own, rest),
            own.terms_mut().add(Node::Power(s, power)),
        );
        let below = own.terms_mut().sum(vec![rest, power]);
        own.terms_mut().quotient(one, below)
    };
    assert!(named(&[], "f(a) = f(b)", &|own, s| over(own, s, 1, 2)));
    assert!(!named(&[], "f(a) = f(b)", &|own, s| over(own, s, -5, 2)));
    assert!(!named(&[], "f(a) = f(b)", &|own, s| over(own, s, 0, 2)));
    assert!(!named(&[], "f(a) = f(b)", &|own, s| over(own, s, 1, 3)));
    let root = |index| {
        move |own: &mut Statement, s| {
            let cube = own.terms_mut().add(Node::Power(s, 3));
            own.terms_mut().elementary(Elementary::Root(index), cube)
        }
    };
    assert!(!named(&[], "f(a) = f(b)", &root(2)) && !named(&[], "f(a) = f(b)", &root(3)));
    // the symbol of a function is its own
    let own = statement(SMOOTH, &[], "f(a) = f(b)");
    let outcome = refutes(&own, |own| {
        let (f, a) = (function(own, "f"), of(own, "a"));
        Witness {
            sample: sample(own, &[("a", 1), ("b", 2)]),
            functions: vec![(f, symbol(own, "a"), a)],
            ..Witness::default()
        }
    });
    assert!(outcome.is_err());
}

#[test]
fn a_counterexample_lies_where_everything_given_holds() {
    let at = |premises: &[&str], claim: &str, values: &[(&str, i64)]| {
        let own = statement("parameters = ['x', 'y']\nintegers = ['n']", premises, claim);
        refutes(&own, |own| Witness {
            sample: sample(own, values),
            ..Witness::default()
        })
        .is_ok()
    };
    assert!(at(&[], "x = y", &[("x", 1), ("y", 2)]));
    assert!(!at(&[], "x = y", &[("x", 1), ("y", 1)]));
    assert!(!at(&[], "x = y", &[("x", 1)]));
    assert!(at(&["x > 0", r"y \ge 0", r"x \neq 3"], "x = y", &[("x", 1), ("y", 0)]));
    assert!(!at(&["x > 0"], "x = y", &[("x", 0), ("y", 1)]));
    assert!(!at(&[r"x \ge 0"], "x = y", &[("x", -1), ("y", 1)]));
    assert!(!at(&[r"x \neq 3"], "x = y", &[("x", 3), ("y", 1)]));
    assert!(!at(&["x = 2 y"], "x = y", &[("x", 3), ("y", 1)]));
    assert!(at(&[], r"\frac{1}{x} = y", &[("x", 1), ("y", 2)]));
    assert!(!at(&[], r"\frac{1}{x} = y", &[("x", 0), ("y", 2)]));
    assert!(!at(&[], r"\sqrt{x} = y", &[("x", -1), ("y", 2)]));
    assert!(!at(&[], r"\frac{1}{\sin(\pi x)} = y", &[("x", 1), ("y", 2)]));
    assert!(at(&[], "x < y", &[("x", 2), ("y", 2)]) && !at(&[], r"x \le y", &[("x", 2), ("y", 2)]));
    assert!(at(&[], r"x \neq y", &[("x", 2), ("y", 2)]) && !at(&[], r"x \neq y", &[("x", 1), ("y", 2)]));
}

#[test]
fn complex_counterexamples() {
    let at = |claim: &str, re: i64, im: i64| {
        let own = statement("parameters = ['z', 'x']\ncomplex = ['z']", &[], claim);
        refutes(&own, |own| {
            let (unit, re, im) = (own.terms_mut().add(Node::Imaginary), integer(own, re), integer(own, im));
            let turned = own.terms_mut().product(vec![unit, im]);
            let value = own.terms_mut().sum(vec![re, turned]);
            Witness {
                sample: vec![(symbol(own, "z"), value)],
                ..Witness::default()
            }
        })
        .is_ok()
    };
    for (claim, re, im, fails) in [
        ("z^2 = -1", 1, 1, true),
        ("z^2 = -1", 0, 1, false),
        (r"z^2 \neq -1", 0, 1, true),
        (r"e^z = 1 + z", 0, 1, true),
        (r"\sin z = z", 0, 1, true),
        (r"\cos z = 1", 0, 1, true),
        (r"\sin z = \frac{e^{iz} - e^{-iz}}{2 i}", 1, 1, false),
        (r"\cos z = \frac{e^{iz} + e^{-iz}}{2}", 1, 1, false),
        (r"\sqrt{z^2} = z", -1, 1, true),
        (r"\sqrt{z^2} = z", 1, 1, false),
        (r"\ln(z^2) = 2 \ln z", -1, 1, true),
        (r"\ln(z^2) = 2 \ln z", 1, 1, false),
        (r"\frac{1}{z^2 + 1} = z", 0, 1, false),
        (r"\frac{1}{z} = z", 1, 1, true),
    ] {
        assert_eq!(at(claim, re, im), fails, "{claim} at {re} + {im} i");
    }
}

#[test]
fn the_arc_tangent_of_a_real_number_is_an_angle_among_complex_numbers_too() {
    let own = statement("parameters = ['z', 'x']\ncomplex = ['z']", &[], "z x = x z");
    let step = |letter: &'static str, name: &'static str, function| {
        let outcome = accepts(&own, |own| {
            let x = of(own, letter);
            let arc = own.terms_mut().elementary(function, x);
            vec![of_value(name, arc, own)]
        });
        outcome.is_ok()
    };
    assert!(step("x", "ArcAbove", Elementary::Arctan) && step("x", "CosineOfArctan", Elementary::Arctan));
    assert!(!step("z", "ArcAbove", Elementary::Arctan) && !step("x", "ArcAbove", Elementary::Arcsin));
}

#[test]
fn pairs_are_asked_in_three_questions() {
    let asked = read("parameters = ['x', 'b']", &["x^2 - 2 b x = 0"], r"x_{1,2} = b \pm b").unwrap();
    let instances: Vec<&str> = asked.iter().map(|question| question.instance.as_str()).collect();
    let expected = [
        "every solution",
        "the upper value is a solution",
        "the lower value is a solution",
    ];
    assert_eq!(instances, expected);
    // (b + b)² - 2 b (b + b) and 0
    assert!(
        asked[1..]
            .iter()
            .all(|question| accepts(&question.statement, |_| Vec::new()).is_ok())
    );
}
