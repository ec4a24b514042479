//! Each axiom at random arguments that meet its conditions, and refused where one of these is left out.

use super::digits::{Value, polynomial, value};
use super::forge::{
    axiom, integer_power, of, of_value, power_of_product, power_of_sum, statement, symbol, unique_root,
};
use crate::common::sample;
use proptest::prelude::*;
use std::collections::{BTreeSet, HashMap};
use vibro_audit::kernel::{
    AxiomRow, Certificate, Checker, Elementary, Fact, Inference, Node, Polynomial, Property, Refusal, Statement,
    Symbol, Term,
};
use vibro_audit::number::{Field, Rational};

/// An axiom in the symbols x, y (complex where the case is), n, m (integers).
struct Case {
    complex: bool,
    /// What must be given; the axiom is refused without any one of these.
    conditions: &'static [&'static str],
    axiom: fn(&mut Statement) -> Inference,
    /// The value of y, where it depends on that of x.
    second: fn(&Value) -> Option<Value>,
}

const REAL: &str = "parameters = ['x', 'y']\nintegers = ['n', 'm']";
const COMPLEX: &str = "parameters = ['x', 'y']\ncomplex = ['x', 'y']\nintegers = ['n', 'm']";

pub fn stated(complex: bool, conditions: &[&str]) -> Statement {
    let claim = "x + y + n + m = y + x + m + n";
    statement(if complex { COMPLEX } else { REAL }, conditions, claim)
}

pub fn given_and(own: &mut Statement, step: Inference, whole: Vec<Term>) -> Result<Vec<Fact>, Refusal> {
    let certificate = Certificate {
        whole,
        steps: Vec::new(),
    };
    let mut checker = Checker::new(own, &certificate, 1_000_000);
    for number in 0..checker.statement.givens().len() {
        checker.apply(&Inference::Given(number))?;
    }
    let known = checker.facts.len();
    checker.apply(&step)?;
    Ok(checker.facts.split_off(known))
}

fn free(_: &Value) -> Option<Value> {
    None
}

fn same(value: &Value) -> Option<Value> {
    Some(value.clone())
}

fn squared(value: &Value) -> Option<Value> {
    Some(value.times(value))
}

fn cubed(value: &Value) -> Option<Value> {
    Some(value.times(value).times(value))
}

fn elementary(own: &mut Statement, function: Elementary) -> Term {
    let x = of(own, "x");
    own.terms_mut().elementary(function, x)
}

pub fn power(own: &mut Statement, base: Term, exponent: Term) -> Term {
    own.terms_mut().add(Node::RealPower(base, exponent))
}

/// x + y written in another way, x and y.
fn sum(own: &mut Statement) -> (Term, [Term; 2]) {
    let (x, y) = (of(own, "x"), of(own, "y"));
    let (two, minus) = (own.terms_mut().integer(2), own.terms_mut().negative(x));
    let twice = own.terms_mut().product(vec![two, x]);
    (own.terms_mut().sum(vec![minus, y, twice]), [x, y])
}

/// n as the root of its own power.
fn unique_of_integer(own: &mut Statement, index: u32) -> Inference {
    let value = of(own, "n");
    let power = own.terms_mut().add(Node::Power(value, index.try_into().unwrap()));
    let root = own.terms_mut().elementary(Elementary::Root(index), power);
    unique_root(root, value, own)
}

fn cases() -> Vec<Case> {
    let mut cases = Vec::new();
    let mut add = |complex, conditions, second, axiom| {
        cases.push(Case {
            complex,
            conditions,
            axiom,
            second,
        });
    };
    for complex in [false, true] {
        let real = !complex;
        add(complex, &[], free, |own| axiom("Pythagoras", &[sum(own).0]));
        add(complex, &[], free, |own| {
            let (sum, parts) = sum(own);
            axiom("SineOfSum", &[sum, parts[0], parts[1]])
        });
        add(complex, &[], free, |own| {
            let (sum, parts) = sum(own);
            axiom("CosineOfSum", &[sum, parts[0], parts[1]])
        });
        add(complex, &[], free, |own| {
            let (sum, parts) = sum(own);
            axiom("ExpOfSum", &[sum, parts[0], parts[1]])
        });
        add(complex, &[], free, |own| {
            let x = of(own, "x");
            axiom("SineOfNegative", &[own.terms_mut().negative(x), x])
        });
        add(complex, &[], free, |own| {
            let x = of(own, "x");
            axiom("CosineOfNegative", &[own.terms_mut().negative(x), x])
        });
        add(complex, &[], free, |own| {
            let x = of(own, "x");
            axiom("SineOfZero", &[own.terms_mut().difference(x, x)])
        });
        add(complex, &[], free, |own| {
            let x = of(own, "x");
            axiom("CosineOfZero", &[own.terms_mut().difference(x, x)])
        });
        add(complex, &[], free, |own| {
            let x = of(own, "x");
            axiom("ExpOfZero", &[own.terms_mut().difference(x, x)])
        });
        add(complex, &[], free, |_| axiom("SineOfPi", &[]));
        add(complex, &[], free, |own| {
            let x = of(own, "x");
            axiom("ArctanOfZero", &[own.terms_mut().difference(x, x)])
        });
        add(complex, &[], free, |_| axiom("CosineOfPi", &[]));
        add(complex, &[], free, |own| axiom("SineOfHalfTurns", &[of(own, "n")]));
        add(complex, &[], free, |own| axiom("CosineOfTurns", &[of(own, "n")]));
        add(complex, &[], free, |own| axiom("CosineOfHalfTurns", &[of(own, "n")]));
        add(complex, &[r"n \ge 0"], free, |own| {
            let (x, y, n) = (of(own, "x"), of(own, "y"), of(own, "n"));
            let product = own.terms_mut().product(vec![y, x]);
            power_of_product(power(own, product, n), [x, y], own)
        });
        add(complex, &[r"x \neq 0", r"y \neq 0"], free, |own| {
            let (x, y, n) = (of(own, "x"), of(own, "y"), of(own, "n"));
            let product = own.terms_mut().product(vec![x, y]);
            power_of_product(power(own, product, n), [x, y], own)
        });
        add(complex, &["n > 0"], free, |own| {
            axiom("IntegerAtLeastOne", &[of(own, "n")])
        });
        add(complex, &[], free, |own| axiom("ExpNonzero", &[of(own, "x")]));
        add(complex, if real { &["x > 0"] } else { &[r"x \neq 0"] }, free, |own| {
            axiom("ExpOfLn", &[of(own, "x")])
        });
        add(complex, if real { &[r"x \ge 0"] } else { &[] }, free, |own| {
            of_value("RootPower", elementary(own, Elementary::Root(2)), own)
        });
        add(complex, &[], free, |own| {
            of_value("RootPower", elementary(own, Elementary::Root(3)), own)
        });
        add(complex, if real { &["x > 0"] } else { &[r"x \neq 0"] }, free, |own| {
            let (x, y) = (of(own, "x"), of(own, "y"));
            {
                let value = power(own, x, y);
                of_value("RealPower", value, own)
            }
        });
        add(complex, &[r"x \neq 0"], free, |own| {
            let (x, n, m) = (of(own, "x"), of(own, "n"), of(own, "m"));
            let exponent = own.terms_mut().sum(vec![n, m]);
            power_of_sum(power(own, x, exponent), [n, m], own)
        });
        add(complex, &[r"x \neq 0"], free, |own| {
            let (x, n, m) = (of(own, "x"), of(own, "n"), of(own, "m"));
            let product = own.terms_mut().product(vec![m, n]);
            axiom("PowerOfPower", &[x, product, n, m])
        });
        add(complex, &[r"x \neq 0"], free, |own| {
            let (x, n) = (of(own, "x"), of(own, "n"));
            axiom("PowerNonzero", &[x, n])
        });
        add(complex, &[], free, |own| {
            let (one, y) = (own.terms_mut().integer(1), of(own, "y"));
            axiom("PowerOfOne", &[one, y])
        });
        add(complex, &[], free, |own| {
            let (x, three) = (of(own, "x"), own.terms_mut().integer(3));
            integer_power(power(own, x, three), 3, own)
        });
        add(complex, &[r"x \neq 0"], free, |own| {
            let (x, three) = (of(own, "x"), own.terms_mut().integer(-3));
            integer_power(power(own, x, three), -3, own)
        });
        let ends: &'static [&'static str] = if real { &[r"1 - x \ge 0", r"1 + x \ge 0"] } else { &[] };
        add(complex, ends, free, |own| {
            let value = elementary(own, Elementary::Arcsin);
            of_value("SineOfArcsin", value, own)
        });
        add(complex, ends, free, |own| {
            let value = elementary(own, Elementary::Arccos);
            of_value("CosineOfArccos", value, own)
        });
    }
    add(false, &[r"n \ge 0", r"m \ge 0"], free, |own| {
        let (x, n, m) = (of(own, "x"), of(own, "n"), of(own, "m"));
        let exponent = own.terms_mut().sum(vec![n, m]);
        axiom("PowerOfSum", &[x, exponent, n, m])
    });
    add(true, &[], free, |_| axiom("ImaginarySquare", &[]));
    add(true, &[], free, |own| axiom("ExpOfImaginary", &[of(own, "x")]));
    // n and m are real among complex symbols
    add(true, &[r"n \ge 0"], free, |own| {
        axiom("RootOfNegative", &[of(own, "n")])
    });
    add(true, &["n > 0"], free, |own| axiom("LnOfNegative", &[of(own, "n")]));
    for index in [2, 3] {
        let unique: fn(&mut Statement) -> Inference = match index {
            2 => |own| unique_of_integer(own, 2),
            _ => |own| unique_of_integer(own, 3),
        };
        add(true, &[r"n \ge 0"], free, unique);
    }
    add(false, &[], free, |own| axiom("ExpPositive", &[of(own, "x")]));
    add(false, &["e^x = e^y"], same, |own| {
        axiom("ExpInjective", &[of(own, "x"), of(own, "y")])
    });
    add(false, &[], free, |own| axiom("LnOfExp", &[of(own, "x")]));
    add(false, &[r"x \ge 0"], free, |own| {
        of_value("RootNonNegative", elementary(own, Elementary::Root(4)), own)
    });
    add(false, &[r"x \ge 0", "x^2 = y"], squared, |own| {
        let (y, value) = (of(own, "y"), of(own, "x"));
        unique_root(own.terms_mut().elementary(Elementary::Root(2), y), value, own)
    });
    add(false, &["x^3 = y"], cubed, |own| {
        let (y, value) = (of(own, "y"), of(own, "x"));
        unique_root(own.terms_mut().elementary(Elementary::Root(3), y), value, own)
    });
    let ends: &[&str] = &[r"1 - x \ge 0", r"1 + x \ge 0"];
    add(false, ends, free, |own| {
        let value = elementary(own, Elementary::Arcsin);
        of_value("CosineOfArcsin", value, own)
    });
    add(false, ends, free, |own| {
        let value = elementary(own, Elementary::Arccos);
        of_value("SineOfArccos", value, own)
    });
    add(false, ends, free, |own| {
        let value = elementary(own, Elementary::Arcsin);
        of_value("ArcAbove", value, own)
    });
    add(false, ends, free, |own| {
        let value = elementary(own, Elementary::Arcsin);
        of_value("ArcBelow", value, own)
    });
    add(false, ends, free, |own| {
        let value = elementary(own, Elementary::Arccos);
        of_value("ArcAbove", value, own)
    });
    add(false, ends, free, |own| {
        let value = elementary(own, Elementary::Arccos);
        of_value("ArcBelow", value, own)
    });
    add(false, &[], free, |own| {
        let value = elementary(own, Elementary::Arctan);
        of_value("SineOfArctan", value, own)
    });
    add(false, &[], free, |own| {
        let value = elementary(own, Elementary::Arctan);
        of_value("CosineOfArctan", value, own)
    });
    add(false, &[], free, |own| {
        let value = elementary(own, Elementary::Arctan);
        of_value("ArcAbove", value, own)
    });
    add(false, &[], free, |own| {
        let value = elementary(own, Elementary::Arctan);
        of_value("ArcBelow", value, own)
    });
    add(
        false,
        &[
            r"\sin x = \sin y",
            r"\cos x = \cos y",
            r"x - y < 2 \pi",
            r"y - x < 2 \pi",
        ],
        same,
        |own| axiom("AngleUnique", &[of(own, "x"), of(own, "y")]),
    );
    add(false, &["x > 0", r"x < \pi"], free, |own| {
        axiom("SinePositive", &[of(own, "x")])
    });
    cases
}

/// A point near the origin: x, y complex where the case is, n and m integers.
fn point(case: &Case, own: &Statement, drawn: &[(i64, i64)]) -> HashMap<Symbol, Value> {
    let number = |n: usize| Value::rational(&Rational::from_ratio(drawn[n].0, 16));
    let complex = |n: usize| {
        let mut value = number(n);
        if case.complex {
            value.im = Value::rational(&Rational::from_ratio(drawn[n].1, 16)).re;
        }
        value
    };
    let x = complex(0);
    let y = (case.second)(&x).unwrap_or_else(|| complex(1));
    let integer = |n: usize| Value::number(drawn[n].0 as f64);
    HashMap::from([
        (symbol(own, "x"), x),
        (symbol(own, "y"), y),
        (symbol(own, "n"), integer(2)),
        (symbol(own, "m"), integer(3)),
    ])
}

fn holds(property: Property, found: &Value, scale: &astro_float::BigFloat) -> bool {
    let is_real = Value {
        re: found.im.clone(),
        im: Value::number(0.0).im,
    }
    .is_nothing(scale);
    match property {
        Property::Zero => found.is_nothing(scale),
        // powers of small numbers are far smaller than 1, and known to 150 digits
        Property::Nonzero => !found.is_nothing(&Value::number(1e-60).re),
        Property::Positive => is_real && found.is_positive() && !found.is_nothing(scale),
        Property::NonNegative => is_real && (found.is_positive() || found.is_nothing(scale)),
        Property::Integer => is_real && found.is_integer(),
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: sample::of(60, 20), failure_persistence: None, ..ProptestConfig::default() })]
    #[test]
    fn axioms_hold_where_their_conditions_do(drawn in prop::collection::vec((-50_i64..50, -50_i64..50), 4)) {
        for (number, case) in cases().iter().enumerate() {
            let mut own = stated(case.complex, case.conditions);
            let at = point(case, &own, &drawn);
            let met = own.givens().iter().all(|given| {
                value(&own, given.term, &at).is_some_and(|found| {
                    holds(given.property, &found, &Value::number(1.0).re)
                })
            });
            if !met {
                continue;
            }
            let axiom = (case.axiom)(&mut own);
            let facts = given_and(&mut own, axiom.clone(), Vec::new());
            let facts = facts.unwrap_or_else(|refusal| panic!("case {number} {axiom:?}: {refusal}"));
            prop_assert!(!facts.is_empty());
            for fact in facts {
                let Some((found, scale)) = polynomial(&own, &fact.polynomial, &at) else {
                    // 0 to a power that is a symbol
                    continue;
                };
                prop_assert!(holds(fact.property, &found, &scale), "case {number} {axiom:?} {fact:?} at {at:?}");
            }
        }
    }

    #[test]
    fn enclosures_have_the_right_sign(drawn in prop::collection::vec((0_usize..12, -9_i64..9, 0_u32..3), 1..6)) {
        let mut own = stated(false, &[]);
        let closed = closed_terms(&mut own);
        let mut sum = Polynomial::default();
        for (which, coefficient, exponent) in drawn {
            let mut product = Polynomial::integer(coefficient);
            for _ in 0..exponent {
                product = product.times(&Polynomial::generator(closed[which % closed.len()]));
            }
            sum = sum.plus(&product);
        }
        let (found, scale) = polynomial(&own, &sum, &HashMap::new()).unwrap();
        for (polynomial, found) in [(sum.clone(), found.clone()), (sum.negated(), Value::number(0.0).minus(&found))] {
            let is_positive = holds(Property::Positive, &found, &scale);
            prop_assert_eq!(given_and(&mut own, Inference::Enclosure(polynomial), Vec::new()).is_ok(), is_positive);
        }
    }
}

fn closed_terms(own: &mut Statement) -> Vec<Term> {
    let terms = own.terms_mut();
    let pi = terms.add(Node::Pi);
    let [two, five, minus] = [2, 5, -7].map(|n| terms.integer(n));
    let small = terms.number(Rational::from_ratio(-3, 7));
    let power = terms.add(Node::RealPower(five, small));
    let quotient = terms.quotient(pi, minus);
    let mut closed = vec![pi, power, quotient];
    for (function, of) in [
        (Elementary::Root(2), five),
        (Elementary::Root(3), minus),
        (Elementary::Root(5), two),
        (Elementary::Sin, five),
        (Elementary::Cos, quotient),
        (Elementary::Exp, small),
        (Elementary::Ln, five),
        (Elementary::Arcsin, small),
        (Elementary::Arccos, small),
        (Elementary::Arctan, minus),
    ] {
        closed.push(terms.elementary(function, of));
    }
    closed
}

#[test]
fn an_axiom_without_one_of_its_conditions_is_refused() {
    for (number, case) in cases().iter().enumerate() {
        for left_out in 0..case.conditions.len() {
            let mut kept = case.conditions.to_vec();
            kept.remove(left_out);
            let mut own = stated(case.complex, &kept);
            let axiom = (case.axiom)(&mut own);
            let outcome = given_and(&mut own, axiom.clone(), Vec::new());
            assert!(
                outcome.is_err(),
                "case {number} without {}: {axiom:?}",
                case.conditions[left_out]
            );
        }
    }
}

#[test]
fn an_axiom_of_real_numbers_is_refused_for_complex_ones() {
    let real_only: &[fn(&mut Statement) -> Inference] = &[
        |own| axiom("ExpPositive", &[of(own, "x")]),
        |own| axiom("LnOfExp", &[of(own, "x")]),
        |own| axiom("ExpInjective", &[of(own, "x"), of(own, "x")]),
        |own| of_value("RootNonNegative", elementary(own, Elementary::Root(2)), own),
        |own| {
            let x = of(own, "x");
            let square = own.terms_mut().add(Node::Power(x, 2));
            unique_root(own.terms_mut().elementary(Elementary::Root(2), square), x, own)
        },
        |own| {
            let x = of(own, "x");
            let cube = own.terms_mut().add(Node::Power(x, 3));
            unique_root(own.terms_mut().elementary(Elementary::Root(3), cube), x, own)
        },
        |own| {
            let value = elementary(own, Elementary::Arctan);
            of_value("SineOfArctan", value, own)
        },
        |own| {
            let value = elementary(own, Elementary::Arctan);
            of_value("CosineOfArctan", value, own)
        },
        |own| {
            let value = elementary(own, Elementary::Arcsin);
            of_value("CosineOfArcsin", value, own)
        },
        |own| {
            let value = elementary(own, Elementary::Arccos);
            of_value("SineOfArccos", value, own)
        },
        |own| {
            let value = elementary(own, Elementary::Arctan);
            of_value("ArcAbove", value, own)
        },
        |own| {
            let value = elementary(own, Elementary::Arccos);
            of_value("ArcBelow", value, own)
        },
        |own| {
            let value = elementary(own, Elementary::Arcsin);
            of_value("ArcBelow", value, own)
        },
        |own| axiom("AngleUnique", &[of(own, "x"), of(own, "x")]),
        |own| axiom("SinePositive", &[of(own, "x")]),
        |own| axiom("RootOfNegative", &[of(own, "x")]),
        |own| axiom("LnOfNegative", &[of(own, "x")]),
    ];
    for (number, axiom) in real_only.iter().enumerate() {
        let mut own = stated(true, &[]);
        let axiom = axiom(&mut own);
        assert!(
            given_and(&mut own, axiom.clone(), Vec::new()).is_err(),
            "case {number}: {axiom:?}"
        );
    }
}

#[test]
fn an_axiom_of_a_sum_needs_that_sum() {
    let wrong: &[fn(&mut Statement) -> Inference] = &[
        |own| {
            let (sum, [x, _]) = sum(own);
            axiom("SineOfSum", &[sum, x, x])
        },
        |own| {
            let (sum, [x, _]) = sum(own);
            axiom("CosineOfSum", &[sum, x, x])
        },
        |own| {
            let (sum, [_, y]) = sum(own);
            axiom("ExpOfSum", &[sum, sum, y])
        },
        |own| axiom("SineOfNegative", &[of(own, "x"), of(own, "x")]),
        |own| axiom("CosineOfNegative", &[of(own, "y"), of(own, "x")]),
        |own| axiom("SineOfZero", &[of(own, "x")]),
        |own| axiom("CosineOfZero", &[of(own, "x")]),
        |own| axiom("ExpOfZero", &[of(own, "x")]),
        |own| axiom("SineOfHalfTurns", &[of(own, "x")]),
        |own| axiom("CosineOfTurns", &[of(own, "x")]),
        |own| {
            let n = of(own, "n");
            let half = own.terms_mut().number(Rational::from_ratio(1, 2));
            axiom("CosineOfTurns", &[own.terms_mut().product(vec![half, n])])
        },
        |own| {
            let (x, y) = (of(own, "x"), of(own, "y"));
            let exponent = own.terms_mut().sum(vec![x, y]);
            power_of_sum(power(own, x, exponent), [x, y], own)
        },
        |own| {
            let (x, three) = (of(own, "x"), own.terms_mut().integer(3));
            integer_power(power(own, x, three), 2, own)
        },
        |own| {
            let (x, least) = (of(own, "x"), own.terms_mut().integer(i64::from(i32::MIN)));
            integer_power(power(own, x, least), i32::MIN, own)
        },
        |own| of_value("RootPower", of(own, "x"), own),
        |own| of_value("RealPower", of(own, "x"), own),
        |own| {
            let value = elementary(own, Elementary::Arctan);
            of_value("SineOfArcsin", value, own)
        },
        |own| of_value("RootNonNegative", elementary(own, Elementary::Root(3)), own),
        |own| Inference::Unfold(of(own, "x")),
        |_| axiom("ImaginarySquare", &[]),
        |_| Inference::Enclosure(Polynomial::default()),
    ];
    for (number, axiom) in wrong.iter().enumerate() {
        let mut own = stated(false, &["x > 0"]);
        let axiom = axiom(&mut own);
        assert!(
            given_and(&mut own, axiom.clone(), Vec::new()).is_err(),
            "case {number}: {axiom:?}"
        );
    }
}

#[test]
fn a_whole_term_is_what_it_stands_for_where_it_has_a_value() {
    for (conditions, accepted) in [(vec![r"y \neq 0"], true), (vec![], false)] {
        let mut own = stated(false, &conditions);
        let (x, y) = (of(&mut own, "x"), of(&mut own, "y"));
        let quotient = own.terms_mut().quotient(x, y);
        let outcome = given_and(&mut own, Inference::Unfold(quotient), vec![quotient]);
        assert_eq!(outcome.is_ok(), accepted);
        let known = outcome.unwrap_or_default();
        let expected = Polynomial::generator(quotient)
            .times(&Polynomial::generator(y))
            .minus(&Polynomial::generator(x));
        assert!(known.iter().all(|fact| fact.polynomial == expected));
    }
    let mut own = statement("parameters = ['x', 'y']\nabbreviations = ['A = x y']", &[], "A = y x");
    let symbol = of(&mut own, "A");
    let facts = given_and(&mut own, Inference::Unfold(symbol), Vec::new()).unwrap();
    assert_eq!(facts.len(), 1);
    // over complex numbers the imaginary unit has a square
    let mut own = stated(true, &[]);
    assert!(given_and(&mut own, axiom("ImaginarySquare", &[]), Vec::new()).is_ok());
}

#[test]
fn each_axiom_of_the_table_is_tried() {
    let name = |case: &Case| match (case.axiom)(&mut stated(case.complex, case.conditions)) {
        Inference::Axiom(axiom) => axiom.name,
        step => panic!("no axiom: {step:?}"),
    };
    let tried: BTreeSet<&str> = cases().iter().map(name).collect();
    let wanted: BTreeSet<&str> = AxiomRow::all().iter().map(|row| row.name).collect();
    assert_eq!(tried, wanted);
}
