//! Statements that are made by hand, and what breaks one condition of a point or of a step.

use kernel::{
    Certificate, Checker, Draft, EFFORT, Elementary, Evaluated, Function, Given, Inference, Law, Letter, Node, Origin,
    Piecewise, Polynomial, Property, Quantity, Sequence, Statement, Symbol, Term, Terms, With, Witness, Word,
    WordMultiple, WordProof, WordQuestion, WordSource, Words, evaluate, prove_in_words,
};
use numbers::{Field, Rational};

/// The sequence of the instants t, and those of the values of x where intervals begin and where they end.
const INSTANTS: usize = 0;
const BEGINNINGS: usize = 1;
const ENDS: usize = 2;

/// A draft about a function x of the intervals between instants t, with whatever values at their ends.
fn draft(complex: bool) -> Draft {
    let sequence = |name: &str, has_instants| Sequence {
        text: [format!("{name}_k"), format!("{name}_{{k"), "}".to_owned()],
        has_instants,
        is_complex: false,
    };
    let sequences = vec![sequence("t", true), sequence("b", false), sequence("e", false)];
    let x = Piecewise {
        text: "x".to_owned(),
        ends: vec![Some([BEGINNINGS, ENDS])],
    };
    Draft::new(complex, sequences, vec![x], Default::default())
}

fn parameter(draft: &mut Draft, name: &str) -> Symbol {
    draft.symbol_of(Quantity::Parameter, name)
}

fn give(draft: &mut Draft, property: Property, term: Term, law: Option<Law>) {
    draft.parts().givens.push(Given {
        origin: Origin::Premise("p".to_owned()),
        property,
        term,
        law,
    });
}

/// Returns true if a point is accepted at which everything given holds and a goal fails.
fn fails(statement: &Statement, forge: impl FnOnce(&mut Statement) -> Witness) -> bool {
    let mut own = statement.clone();
    let evidence = forge(&mut own);
    let outcome = evaluate(
        statement,
        &With {
            statement: own,
            evidence,
        },
    );
    matches!(outcome, Ok(Evaluated::Fails(_)))
}

/// A witness that gives integers to symbols.
fn sample(own: &mut Statement, values: &[(Symbol, i64)]) -> Witness {
    let values = values
        .iter()
        .map(|&(symbol, value)| (symbol, own.terms_mut().integer(value)));
    Witness {
        sample: values.collect(),
        ..Witness::default()
    }
}

/// The law over the time `running`: of an interval, or of the real line.
fn law(running: Symbol, interval: Option<i32>) -> Option<Law> {
    Some(Law {
        time: Some(running),
        interval,
        every_index: interval.is_some(),
        conditions: Vec::new(),
    })
}

/// The function x of the interval with this offset.
fn on_interval(own: &mut Statement, offset: i32) -> Function {
    let at = own.fresh("s");
    let at = own.terms_mut().symbol(at);
    let value = own.value_within(0, offset, 0, at);
    match own.terms().node(value) {
        Node::Value(function, ..) => *function,
        node => panic!("{node:?}"),
    }
}

#[test]
fn a_law_of_an_interval_holds_where_no_member_of_a_sequence_is_named() {
    let mut draft = draft(false);
    let running = draft.symbol_of(Quantity::Running, "t");
    let time = draft.terms_mut().symbol(running);
    let value = draft.value_within(0, 0, 0, time);
    give(&mut draft, Property::Zero, value, law(running, Some(0)));
    *draft.parts().interval = Some(0);
    let one = draft.terms_mut().integer(1);
    let goal = draft.terms_mut().difference(value, one);
    let statement = draft.finish(vec![(Property::Zero, goal)]);
    for (constant, accepted) in [(0, true), (5, false)] {
        let outcome = fails(&statement, |own| {
            let (function, time) = (on_interval(own, 0), own.fresh("s"));
            let constant = own.terms_mut().integer(constant);
            Witness {
                functions: vec![(function, time, constant)],
                ..Witness::default()
            }
        });
        assert_eq!(outcome, accepted, "x = {constant}");
    }
}

#[test]
fn a_law_of_intervals_holds_in_the_one_after_the_last_instant() {
    // x(t) = t in each interval, so that x begins with t_{k+1} after the instant of that number
    let mut draft = draft(false);
    let running = draft.symbol_of(Quantity::Running, "t");
    let [first, last] = [0, 1].map(|offset| draft.member(INSTANTS, offset));
    let after = draft.member(BEGINNINGS, 1);
    let time = draft.terms_mut().symbol(running);
    let value = draft.value_within(0, 0, 0, time);
    let term = draft.terms_mut().difference(value, time);
    give(&mut draft, Property::Zero, term, law(running, Some(0)));
    let [start, hundred] = [draft.terms_mut().symbol(after), draft.terms_mut().integer(100)];
    let goal = draft.terms_mut().difference(start, hundred);
    let statement = draft.finish(vec![(Property::Zero, goal)]);
    for (beginning, accepted) in [(1, true), (7, false)] {
        let outcome = fails(&statement, |own| {
            let (function, time) = (on_interval(own, 0), own.fresh("s"));
            let named = own.terms_mut().symbol(time);
            Witness {
                functions: vec![(function, time, named)],
                ..sample(own, &[(first, 0), (last, 1), (after, beginning)])
            }
        });
        assert_eq!(outcome, accepted, "x begins with {beginning}");
    }
}

#[test]
fn a_named_function_has_the_members_of_sequences_at_both_ends() {
    for (sequence, offset) in [(BEGINNINGS, 0), (ENDS, 1)] {
        let mut draft = draft(false);
        let [first, last] = [0, 1].map(|offset| draft.member(INSTANTS, offset));
        let end = draft.member(sequence, offset);
        let [value, hundred] = [draft.terms_mut().symbol(end), draft.terms_mut().integer(100)];
        let goal = draft.terms_mut().difference(value, hundred);
        let statement = draft.finish(vec![(Property::Zero, goal)]);
        for (own_value, accepted) in [(3, true), (7, false)] {
            let outcome = fails(&statement, |own| {
                let (function, time) = (on_interval(own, 0), own.fresh("s"));
                let three = own.terms_mut().integer(3);
                Witness {
                    functions: vec![(function, time, three)],
                    ..sample(own, &[(first, 0), (last, 1), (end, own_value)])
                }
            });
            assert_eq!(outcome, accepted, "sequence {sequence}: {own_value}");
        }
    }
}

#[test]
fn single_values_of_an_interval_are_apart_from_its_ends() {
    let mut draft = draft(false);
    let [first, last] = [0, 1].map(|offset| draft.member(INSTANTS, offset));
    let one = draft.terms_mut().integer(1);
    let goal = draft.value_within(0, 0, 0, one);
    let statement = draft.finish(vec![(Property::Zero, goal)]);
    for (instants, accepted) in [([0, 2], true), ([0, 1], false), ([1, 2], false)] {
        let outcome = fails(&statement, |own| {
            let function = on_interval(own, 0);
            let five = own.terms_mut().integer(5);
            Witness {
                table: vec![(function, 0, one, five)],
                ..sample(own, &[(first, instants[0]), (last, instants[1])])
            }
        });
        assert_eq!(outcome, accepted, "{instants:?}");
    }
}

#[test]
fn a_law_holds_once_the_point_is_put_in_and_identically_where_symbols_are_generic() {
    // f(t) = a t, of a function that is named 2 t, or a t
    for is_generic in [false, true] {
        let mut draft = draft(false);
        let (running, a) = (draft.symbol_of(Quantity::Running, "t"), parameter(&mut draft, "a"));
        let function = draft.new_function("f");
        let [time, factor] = [running, a].map(|symbol| draft.terms_mut().symbol(symbol));
        let value = draft.value(function, 0, time);
        let product = draft.terms_mut().product(vec![factor, time]);
        let term = draft.terms_mut().difference(value, product);
        give(&mut draft, Property::Zero, term, law(running, None));
        if is_generic {
            draft.parts().generic.push(a);
        }
        let three = draft.terms_mut().integer(3);
        let goal = draft.terms_mut().difference(factor, three);
        let statement = draft.finish(vec![(Property::Zero, goal)]);
        for (is_named_by_it, sampled, accepted) in [(false, 2, !is_generic), (false, 4, false), (true, 2, true)] {
            let outcome = fails(&statement, |own| {
                let time = own.fresh("s");
                let named = own.terms_mut().symbol(time);
                let slope = if is_named_by_it {
                    factor
                } else {
                    own.terms_mut().integer(2)
                };
                let named = own.terms_mut().product(vec![slope, named]);
                Witness {
                    functions: vec![(function, time, named)],
                    ..sample(own, &[(a, sampled)])
                }
            });
            assert_eq!(outcome, accepted, "generic: {is_generic}, {is_named_by_it}, {sampled}");
        }
    }
}

#[test]
fn premises_hold_for_all_generic_symbols_nearby() {
    // of x and the generic a: x = a, x >= a, and a other than 0 hold at a = x = -1
    for (property, is_solved, accepted) in [
        (Property::Zero, false, false),
        (Property::Zero, true, true),
        (Property::NonNegative, false, false),
        (Property::NonNegative, true, true),
        (Property::Nonzero, false, true),
    ] {
        let mut draft = draft(false);
        let [a, x] = ["a", "x"].map(|name| parameter(&mut draft, name));
        draft.parts().generic.push(a);
        let [of_a, of_x, two] = [
            draft.terms_mut().symbol(a),
            draft.terms_mut().symbol(x),
            draft.terms_mut().integer(2),
        ];
        let difference = draft.terms_mut().difference(of_x, of_a);
        let given = if property == Property::Nonzero {
            of_a
        } else {
            difference
        };
        give(&mut draft, property, given, None);
        let goal = draft.terms_mut().difference(of_a, two);
        let statement = draft.finish(vec![(Property::Zero, goal)]);
        let outcome = fails(&statement, |own| match is_solved {
            true => Witness {
                solved: vec![(x, of_a)],
                ..sample(own, &[(a, -1)])
            },
            false => sample(own, &[(a, -1), (x, -1)]),
        });
        assert_eq!(outcome, accepted, "{property:?}, solved: {is_solved}");
    }
}

#[test]
fn a_symbol_has_one_value() {
    let mut draft = draft(false);
    let x = parameter(&mut draft, "x");
    let goal = draft.terms_mut().symbol(x);
    let statement = draft.finish(vec![(Property::Zero, goal)]);
    for (twice, accepted) in [(false, true), (true, false)] {
        let outcome = fails(&statement, |own| {
            let one = own.terms_mut().integer(1);
            Witness {
                solved: vec![(x, one)],
                ..sample(own, &[(x, 2)][..usize::from(twice)])
            }
        });
        assert_eq!(outcome, accepted, "twice: {twice}");
    }
}

#[test]
fn a_power_whose_exponent_is_an_integer_at_the_point_is_one() {
    // (p + 1)^q = 9
    let mut draft = draft(false);
    let [p, q] = ["p", "q"].map(|name| parameter(&mut draft, name));
    let [of_p, of_q] = [p, q].map(|symbol| draft.terms_mut().symbol(symbol));
    let [one, nine] = [1, 9].map(|number| draft.terms_mut().integer(number));
    let base = draft.terms_mut().sum(vec![of_p, one]);
    let power = draft.terms_mut().add(Node::RealPower(base, of_q));
    let difference = draft.terms_mut().difference(power, nine);
    give(&mut draft, Property::Zero, difference, None);
    let statement = draft.finish(vec![(Property::Zero, of_p)]);
    for (exponent, accepted) in [(2, true), (4, false)] {
        let outcome = fails(&statement, |own| sample(own, &[(p, 2), (q, exponent)]));
        assert_eq!(outcome, accepted, "exponent {exponent}");
    }
}

#[test]
fn an_odd_root_is_the_real_one_over_the_reals_alone() {
    // the cube root of x is negative for -2 <= x <= -1; the principal one is not real there
    for (complex, accepted) in [(false, true), (true, false)] {
        let mut draft = draft(complex);
        let x = parameter(&mut draft, "x");
        let [of_x, one, two] = [
            draft.terms_mut().symbol(x),
            draft.terms_mut().integer(1),
            draft.terms_mut().integer(2),
        ];
        let low = draft.terms_mut().sum(vec![of_x, two]);
        let above = draft.terms_mut().sum(vec![of_x, one]);
        let high = draft.terms_mut().negative(above);
        for bound in [low, high] {
            give(&mut draft, Property::NonNegative, bound, None);
        }
        let root = draft.terms_mut().elementary(Elementary::Root(3), of_x);
        let mut own = draft.finish(vec![(Property::Zero, root)]);
        let mut checker = Checker::new(&mut own, &Certificate::default(), EFFORT);
        let steps = [
            Inference::Given(0),
            Inference::Given(1),
            Inference::Between {
                target: Polynomial::generator(root).negated(),
                within: vec![[0, 1]],
            },
        ];
        assert_eq!(checker.follow(&steps).is_ok(), accepted, "complex: {complex}");
    }
}

#[test]
fn a_polynomial_of_integers_is_an_integer_at_each_of_them() {
    let mut terms = Terms::default();
    let x = Polynomial::generator(terms.add(Node::Bound));
    let product = x.times(&x.minus(&Polynomial::integer(1)));
    for (divisor, accepted) in [(2, true), (4, false)] {
        let quotient = product.scaled(&Rational::from_ratio(1, divisor));
        assert_eq!(quotient.is_integer_valued(), accepted, "x (x - 1) / {divisor}");
    }
}

#[test]
fn an_integral_of_numbers_is_between_numbers() {
    let mut draft = draft(false);
    let x = parameter(&mut draft, "x");
    let terms = draft.terms_mut();
    let [letter, one, of_x] = [terms.add(Node::Bound), terms.integer(1), terms.symbol(x)];
    assert!(terms.integral(letter, one, one).is_some());
    assert!(terms.integral(letter, one, of_x).is_none());
    assert!(terms.integral(letter, of_x, one).is_none());
    assert!(terms.integral(of_x, one, one).is_none());
}

#[test]
fn what_is_multiplied_by_a_word_has_no_vectors() {
    // u w = v w follows from u = v; a claim is its own line
    for (is_vector, is_claimed, accepted) in [(false, true, true), (true, true, false), (false, false, false)] {
        let word = |names: &str| Word {
            letters: names
                .chars()
                .map(|name| Letter {
                    name: name.to_string(),
                    is_transposed: false,
                    is_vector,
                })
                .collect(),
            ..Word::default()
        };
        let difference = |left: &str, right: &str| {
            let mut words = Words::of(word(left), Rational::from_integer(1));
            words.add(word(right), Rational::from_integer(-1));
            words
        };
        let question = WordQuestion {
            claims: vec![difference("uw", if is_claimed { "vw" } else { "wv" })],
            givens: vec![difference("u", "v")],
            provided: Vec::new(),
        };
        let proof = WordProof {
            lines: vec![vec![WordMultiple {
                coefficient: Rational::from_integer(1),
                front: Word::default(),
                of: WordSource::Given(0),
                behind: word("w"),
            }]],
            claims: vec![0],
            point: ["u", "v", "w"]
                .map(|name| (name.to_owned(), Rational::from_integer(1)))
                .into(),
        };
        let outcome = prove_in_words(&question, &proof);
        assert_eq!(
            outcome.is_ok(),
            accepted,
            "vectors: {is_vector}, claimed: {is_claimed}: {outcome:?}"
        );
    }
}
