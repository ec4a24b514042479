//! Certificates that the search finds, broken at random: of a true claim none may lead to a false one, and whatever is
//! accepted of a broken one must be true all the same.
//!
//! Truth does not come from the kernel. A certificate is taken to the misprinted twin of its sheet, whose claim is
//! known to be false: there nothing may be accepted, broken or not. And the facts that a broken certificate adds are
//! evaluated at random points where everything given holds.

use super::digits::{Value, polynomial, value};
use crate::common::attacks::{self, Attack};
use crate::common::sample;
use std::collections::{BTreeMap, HashMap};
use vibro_audit::claim::{Sheet, Statements, questions};
use vibro_audit::kernel::{
    AxiomRow, Certificate, Checker, Function, Inference, LawSource, Node, Polynomial, Property, Statement, Summand,
    Symbol, Term, With, follows,
};
use vibro_audit::number::{Field, Rational, Sequence};
use vibro_audit::prove::certificates;

/// Random breaks in all.
const BREAKS: [usize; 2] = [2000, 200];

/// Twins of which certificates are taken.
const TWINS: [usize; 2] = [40, 8];

/// The first where corpora are run whole, else the second.
fn sampled([all, some]: [usize; 2]) -> usize {
    sample::of(all, some)
}

fn claim_of(sheet: &Sheet) -> Option<usize> {
    (0..sheet.entries.len()).rfind(|&n| sheet.is_claim(n))
}

/// Pairs of a true sheet and its misprinted twin, in order.
fn twins() -> Vec<(Attack, Attack)> {
    let is = |attack: &Attack, truth: &str| attack.truth("", true).as_deref() == Some(truth);
    let (wrong, right): (Vec<_>, Vec<_>) = attacks::all()
        .into_iter()
        .partition(|attack| attack.name.ends_with("-wrong"));
    let mut right: BTreeMap<String, Attack> = right.into_iter().map(|attack| (attack.path(), attack)).collect();
    let twin = |wrong: Attack| {
        let path = wrong.path();
        let right = right.remove(path.strip_suffix("-wrong")?)?;
        (is(&right, "true") && is(&wrong, "false")).then_some((right, wrong))
    };
    wrong.into_iter().filter_map(twin).collect()
}

/// Applies `new` to every term, `polynomial` to every polynomial and `number` to every fact that a step speaks of.
struct Visit<'a> {
    term: &'a mut dyn FnMut(&mut Term),
    polynomial: &'a mut dyn FnMut(&mut Polynomial),
    fact: &'a mut dyn FnMut(&mut usize),
}

impl Visit<'_> {
    fn steps(&mut self, steps: &mut [Inference]) {
        for step in steps {
            self.step(step);
        }
    }

    fn step(&mut self, step: &mut Inference) {
        match step {
            Inference::Given(_) | Inference::Derivative(_) | Inference::Along { .. } => {}
            Inference::Law { at, .. } => at.iter_mut().for_each(|term| (self.term)(term)),
            Inference::Axiom(axiom) => axiom.terms.iter_mut().for_each(|term| (self.term)(term)),
            Inference::Unfold(term) => (self.term)(term),
            Inference::Enclosure(polynomial) => (self.polynomial)(polynomial),
            Inference::Zero {
                target,
                squares,
                factors,
                terms,
                ..
            } => {
                (self.polynomial)(target);
                squares.iter_mut().for_each(|(_, root)| (self.polynomial)(root));
                self.facts(factors, terms);
            }
            Inference::Nonzero {
                target,
                cofactor,
                factors,
                terms,
            } => {
                (self.polynomial)(target);
                (self.polynomial)(cofactor);
                self.facts(factors, terms);
            }
            Inference::Sign {
                target,
                factors,
                summands,
                terms,
                ..
            } => {
                (self.polynomial)(target);
                for Summand { facts, root, .. } in summands {
                    facts.iter_mut().for_each(|fact| (self.fact)(fact));
                    (self.polynomial)(root);
                }
                self.facts(factors, terms);
            }
            Inference::Squeezed { low, high } => {
                (self.fact)(low);
                (self.fact)(high);
            }
            Inference::Between { target, within } => {
                (self.polynomial)(target);
                within.iter_mut().flatten().for_each(|fact| (self.fact)(fact));
            }
            Inference::Congruence { left, right } => {
                (self.term)(left);
                (self.term)(right);
            }
            Inference::Generic(term) => (self.term)(term),
            Inference::Cases {
                on, target, branches, ..
            } => {
                (self.polynomial)(on);
                (self.polynomial)(target);
                branches.iter_mut().for_each(|steps| self.steps(steps));
            }
            Inference::Constant { of, at, steps, .. } => {
                (self.term)(of);
                (self.term)(at);
                self.steps(steps);
            }
        }
    }

    fn facts(&mut self, factors: &mut [(usize, u32)], terms: &mut [(Polynomial, usize)]) {
        factors.iter_mut().for_each(|(fact, _)| (self.fact)(fact));
        for (coefficient, fact) in terms {
            (self.polynomial)(coefficient);
            (self.fact)(fact);
        }
    }
}

/// The symbol of a statement that has the name and the quantity of one of another, new where there is none.
fn symbol_like(from: &Statement, symbol: Symbol, to: &mut Statement) -> Symbol {
    let (quantity, name) = (from.quantity(symbol).unwrap(), from.terms().symbol_name(symbol));
    let mut all = (0..u32::try_from(to.quantities().len()).unwrap()).map(Symbol);
    let is_alike = |known: &Symbol| to.quantity(*known) == Some(quantity) && to.terms().symbol_name(*known) == name;
    all.find(is_alike).unwrap_or_else(|| to.symbol_of(quantity, name))
}

/// The function of a statement that has the name of one of another and is of the same kind.
fn function_like(from: &Statement, function: Function, to: &mut Statement) -> Function {
    let of = |statement: &Statement, function: Function| {
        let own = statement.functions()[function.0 as usize];
        (own, statement.terms().function_name(function).to_owned())
    };
    let wanted = of(from, function);
    let mut all = (0..u32::try_from(to.functions().len()).unwrap()).map(Function);
    all.find(|known| of(to, *known) == wanted)
        .unwrap_or_else(|| to.new_function(wanted.1.clone()))
}

/// The certificate in the terms of another statement: symbols and functions by what they stand for.
fn moved(from: &With<Certificate>, to: &Statement) -> With<Certificate> {
    let mut own = to.clone();
    let mut known: HashMap<Term, Term> = HashMap::new();
    for number in 0..from.statement.terms().len() {
        let term = Term(u32::try_from(number).unwrap());
        let of = |part: &Term| known.get(part).copied().unwrap_or(*part);
        let all = |parts: &[Term]| parts.iter().map(of).collect::<Vec<Term>>();
        let node = match from.statement.terms().node(term) {
            Node::Symbol(symbol) => Node::Symbol(symbol_like(&from.statement, *symbol, &mut own)),
            Node::Value(function, order, at) => {
                Node::Value(function_like(&from.statement, *function, &mut own), *order, of(at))
            }
            Node::Sum(parts) => Node::Sum(all(parts)),
            Node::Product(parts) => Node::Product(all(parts)),
            Node::Power(base, exponent) => Node::Power(of(base), *exponent),
            Node::Quotient(a, b) => Node::Quotient(of(a), of(b)),
            Node::RealPower(a, b) => Node::RealPower(of(a), of(b)),
            Node::Elementary(function, at) => Node::Elementary(*function, of(at)),
            node => node.clone(),
        };
        let there = own.terms_mut().add(node);
        known.insert(term, there);
    }
    let mut evidence = from.evidence.clone();
    evidence.whole = evidence.whole.iter().map(|term| known[term]).collect();
    let mut visit = Visit {
        term: &mut |term| *term = known[term],
        polynomial: &mut |polynomial| {
            let terms = polynomial.terms().iter().map(|(monomial, value)| {
                let mut monomial: vibro_audit::kernel::Monomial =
                    monomial.iter().map(|(term, power)| (known[term], *power)).collect();
                monomial.sort_unstable();
                (monomial, value.clone())
            });
            *polynomial = Polynomial::from_terms(terms);
        },
        fact: &mut |_| {},
    };
    visit.steps(&mut evidence.steps);
    for step in &mut evidence.steps {
        if let Inference::Constant { time, .. } = step {
            let term = own_symbol(&from.statement, *time);
            if let Some(term) = term
                && let Node::Symbol(symbol) = own.terms().node(known[&term])
            {
                *time = *symbol;
            }
        }
    }
    With {
        statement: own,
        evidence,
    }
}

fn own_symbol(statement: &Statement, symbol: Symbol) -> Option<Term> {
    let all = (0..statement.terms().len()).map(|n| Term(u32::try_from(n).unwrap()));
    all.into_iter()
        .find(|term| *statement.terms().node(*term) == Node::Symbol(symbol))
}

fn below_of(random: &mut Sequence, below: usize) -> usize {
    (random.draw() % u64::try_from(below.max(1)).unwrap()) as usize
}

/// How a certificate is broken.
const KINDS: [&str; 12] = [
    "a coefficient",
    "a sign",
    "an exponent",
    "the number of a fact",
    "an argument of an axiom",
    "another axiom",
    "a dropped step",
    "a step out of order",
    "a dropped factor",
    "a dropped summand",
    "another given or shift",
    "a target",
];

/// Breaks one thing of a kind; `false` where there is nothing of this kind.
fn broken(certificate: &mut With<Certificate>, kind: usize, random: &mut Sequence) -> bool {
    let mut draw = |below: usize| below_of(random, below);
    let terms = certificate.statement.terms().len();
    let steps = &mut certificate.evidence.steps;
    if steps.is_empty() {
        return false;
    }
    match kind {
        0..=2 => {
            let mut count = 0;
            let mut visit = Visit {
                term: &mut |_| {},
                polynomial: &mut |polynomial| count += usize::from(!polynomial.is_zero()),
                fact: &mut |_| {},
            };
            visit.steps(steps);
            let (chosen, which, by) = (draw(count), draw(1000), 1 + draw(3) as i64);
            let mut number = 0;
            let mut visit = Visit {
                term: &mut |_| {},
                polynomial: &mut |polynomial| {
                    if polynomial.is_zero() {
                        return;
                    }
                    if number == chosen {
                        let mut list = polynomial.terms().to_vec();
                        let at = which % list.len();
                        let (monomial, value) = &mut list[at];
                        match kind {
                            0 => *value += Rational::from_integer(by).0,
                            1 => *value = -value.clone(),
                            _ => match monomial.last_mut() {
                                Some((_, power)) => *power += u32::try_from(by).unwrap(),
                                None => *value += Rational::from_integer(1).0,
                            },
                        }
                        *polynomial = Polynomial::from_terms(list);
                    }
                    number += 1;
                },
                fact: &mut |_| {},
            };
            visit.steps(steps);
            count > 0
        }
        3 => {
            let mut count = 0;
            Visit {
                term: &mut |_| {},
                polynomial: &mut |_| {},
                fact: &mut |_| count += 1,
            }
            .steps(steps);
            let (chosen, up) = (draw(count), draw(2) == 0);
            let mut number = 0;
            Visit {
                term: &mut |_| {},
                polynomial: &mut |_| {},
                fact: &mut |fact| {
                    if number == chosen {
                        *fact = if up || *fact == 0 { *fact + 1 } else { *fact - 1 };
                    }
                    number += 1;
                },
            }
            .steps(steps);
            count > 0
        }
        4 => {
            let mut count = 0;
            Visit {
                term: &mut |_| count += 1,
                polynomial: &mut |_| {},
                fact: &mut |_| {},
            }
            .steps(steps);
            let (chosen, other) = (draw(count), draw(terms));
            let mut number = 0;
            let mut changed = false;
            Visit {
                term: &mut |term| {
                    if number == chosen {
                        let new = Term(u32::try_from(other).unwrap());
                        changed = *term != new;
                        *term = new;
                    }
                    number += 1;
                },
                polynomial: &mut |_| {},
                fact: &mut |_| {},
            }
            .steps(steps);
            changed
        }
        5 => {
            let axioms: Vec<usize> = (0..steps.len())
                .filter(|&n| matches!(steps[n], Inference::Axiom(_) | Inference::Enclosure(_)))
                .collect();
            if axioms.is_empty() {
                return false;
            }
            let at = axioms[draw(axioms.len())];
            match &mut steps[at] {
                Inference::Enclosure(polynomial) => *polynomial = polynomial.negated(),
                Inference::Axiom(axiom) => {
                    // another axiom of as many letters
                    let fits = |row: &&AxiomRow| row.letters.len() == axiom.terms.len() && row.name != axiom.name;
                    let others: Vec<&AxiomRow> = AxiomRow::all().iter().filter(fits).collect();
                    axiom.name = others[draw(others.len())].name;
                }
                _ => return false,
            }
            true
        }
        6 => {
            let at = draw(steps.len());
            steps.remove(at);
            // what comes later is one fact less
            if draw(2) == 0 {
                Visit {
                    term: &mut |_| {},
                    polynomial: &mut |_| {},
                    fact: &mut |fact| {
                        if *fact > at {
                            *fact -= 1;
                        }
                    },
                }
                .steps(steps);
            }
            true
        }
        7 => {
            let (a, b) = (draw(steps.len()), draw(steps.len()));
            steps.swap(a, b);
            a != b
        }
        8 | 9 => {
            let first = draw(steps.len());
            for n in 0..steps.len() {
                let at = (first + n) % steps.len();
                let dropped = match &mut steps[at] {
                    Inference::Zero { factors, terms, .. } | Inference::Nonzero { factors, terms, .. } => {
                        if kind == 8 && !factors.is_empty() {
                            factors.pop();
                            true
                        } else if kind == 9 && !terms.is_empty() {
                            terms.pop();
                            true
                        } else {
                            false
                        }
                    }
                    Inference::Sign { factors, summands, .. } => {
                        if kind == 8 && !factors.is_empty() {
                            factors.pop();
                            true
                        } else {
                            kind == 9 && summands.pop().is_some()
                        }
                    }
                    _ => false,
                };
                if dropped {
                    return true;
                }
            }
            false
        }
        10 => {
            let chosen: Vec<usize> = (0..steps.len())
                .filter(|&n| {
                    matches!(
                        steps[n],
                        Inference::Given(_) | Inference::Law { .. } | Inference::Along { .. }
                    )
                })
                .collect();
            if chosen.is_empty() {
                return false;
            }
            let at = chosen[draw(chosen.len())];
            let (by, which) = (1 + draw(3), draw(2));
            match &mut steps[at] {
                Inference::Given(number) => {
                    *number = if which == 0 {
                        *number + by
                    } else {
                        number.saturating_sub(by)
                    }
                }
                Inference::Law {
                    source: LawSource::Given { given, shift },
                    ..
                } => match which {
                    0 => *given += by,
                    _ => *shift += by as i32,
                },
                Inference::Law {
                    source: LawSource::Derived(number),
                    ..
                } => *number += by,
                Inference::Along { equation, .. } => *equation += by,
                _ => {}
            }
            true
        }
        _ => {
            let at = draw(steps.len());
            let by = Polynomial::integer(1 + draw(3) as i64);
            match &mut steps[at] {
                Inference::Zero { target, .. }
                | Inference::Nonzero { target, .. }
                | Inference::Sign { target, .. }
                | Inference::Cases { target, .. } => *target = target.plus(&by),
                Inference::Given(_) => steps[at] = Inference::Enclosure(by.negated()),
                _ => return false,
            }
            true
        }
    }
}

/// Points where everything given holds, of a statement without unknown functions and equations between symbols.
fn points(statement: &Statement, random: &mut Sequence) -> Vec<HashMap<Symbol, Value>> {
    let mut found = Vec::new();
    for _ in 0..60 {
        let mut at = HashMap::new();
        for n in 0..statement.quantities().len() {
            let symbol = Symbol(u32::try_from(n).unwrap());
            let drawn = i64::try_from(below_of(random, 97)).unwrap() - 48;
            let is_integer = statement.givens().iter().any(|given| {
                given.property == Property::Integer && *statement.terms().node(given.term) == Node::Symbol(symbol)
            });
            let drawn = if is_integer { (drawn % 5) * 16 } else { drawn };
            at.insert(symbol, Value::rational(&Rational::from_ratio(drawn, 16)));
        }
        let holds = statement.givens().iter().all(|given| {
            given.law.is_none()
                && value(statement, given.term, &at).is_some_and(|found| {
                    let scale = Value::number(1.0).re;
                    match given.property {
                        Property::Zero => found.is_nothing(&scale),
                        Property::Nonzero => !found.is_nothing(&scale),
                        Property::Positive => found.is_positive() && !found.is_nothing(&scale),
                        Property::NonNegative => found.is_positive() || found.is_nothing(&scale),
                        Property::Integer => found.is_integer(),
                    }
                })
        });
        if holds {
            found.push(at);
        }
        if found.len() == 2 {
            break;
        }
    }
    found
}

/// The first fact that a certificate adds, broken as it may be, and that is false at the point.
fn false_fact(certificate: &With<Certificate>, at: &HashMap<Symbol, Value>) -> Option<String> {
    let mut own = certificate.statement.clone();
    let mut checker = Checker::new(&mut own, &certificate.evidence, 2_000_000);
    for step in &certificate.evidence.steps {
        // what is refused is left out, so that later steps are tried too
        let _ = checker.apply(step);
    }
    if checker.is_absurd() {
        return Some("0 = 1".into());
    }
    let facts = checker.facts.clone();
    for fact in facts {
        let Some((found, scale)) = polynomial(&own, &fact.polynomial, at) else {
            continue;
        };
        let true_there = match fact.property {
            Property::Zero => found.is_nothing(&scale),
            Property::Nonzero => !found.is_nothing(&Value::number(1e-40).re),
            Property::Positive => found.is_positive(),
            Property::NonNegative => found.is_positive() || found.is_nothing(&scale),
            Property::Integer => found.is_integer(),
        };
        if !true_there {
            return Some(format!("{fact:?}"));
        }
    }
    None
}

#[test]
fn broken_certificates_prove_nothing_false() {
    let mut sources: Vec<(String, With<Certificate>, Option<Statement>)> = Vec::new();
    let paper = vibro_audit::claim::paper().unwrap();
    for position in (0..paper.entries.len()).filter(|&n| paper.is_claim(n)) {
        for certificate in certificates(&paper, position) {
            sources.push((paper.entries[position].label.clone(), certificate, None));
        }
    }
    let of_paper = sources.len();
    // spread over the classes
    let all = twins();
    let mut order: Vec<usize> = (0..all.len()).collect();
    order.sort_by_key(|n| (n * 67) % all.len());
    let mut taken = 0;
    for n in order {
        if taken == sampled(TWINS) {
            break;
        }
        let (right, wrong) = &all[n];
        let (sheet_of_right, sheet_of_wrong) = (right.read().unwrap(), wrong.read().unwrap());
        let (Some(claim), Some(twin)) = (claim_of(&sheet_of_right), claim_of(&sheet_of_wrong)) else {
            continue;
        };
        let found = certificates(&sheet_of_right, claim);
        let statements = Statements::gather(&sheet_of_wrong, twin)
            .ok()
            .and_then(|statements| questions(&statements, &sheet_of_wrong.symbols).ok())
            .unwrap_or_default();
        if found.is_empty() || found.len() != statements.len() || statements.len() != 1 {
            continue;
        }
        taken += 1;
        for (certificate, question) in found.into_iter().zip(statements) {
            sources.push((right.path(), certificate, Some(question.statement)));
        }
    }
    println!("{of_paper} certificates of the paper, {taken} of twins");
    assert!(taken == sampled(TWINS) && of_paper > 0);
    let mut wrong = Vec::new();
    // unbroken: right where it is, not at the twin
    for (label, certificate, twin) in &sources {
        assert!(follows(certificate).is_ok(), "{label}");
        if let Some(twin) = twin
            && follows(&moved(certificate, twin)).is_ok()
        {
            wrong.push(format!("{label}: its certificate proves the twin"));
        }
    }
    let mut random = Sequence::new(11);
    let mut counts: BTreeMap<&str, (usize, usize)> = BTreeMap::new();
    let (mut breaks, mut to_twins, mut evaluated) = (0, 0, 0);
    let mut number = 0;
    while breaks < sampled(BREAKS) {
        number += 1;
        assert!(number < 20 * sampled(BREAKS), "too little to break");
        let (label, certificate, twin) = &sources[below_of(&mut random, sources.len())];
        let kind = number % KINDS.len();
        let mut changed = certificate.clone();
        if !broken(&mut changed, kind, &mut random) || changed.evidence.steps == certificate.evidence.steps {
            continue;
        }
        breaks += 1;
        let count = counts.entry(KINDS[kind]).or_default();
        count.0 += 1;
        count.1 += usize::from(follows(&changed).is_ok());
        if let Some(twin) = twin {
            to_twins += 1;
            if follows(&moved(&changed, twin)).is_ok() {
                wrong.push(format!("{label}: {} proves the twin", KINDS[kind]));
            }
        }
        // values of functions, and derivatives along maps, are not free
        let is_free = changed.statement.functions().is_empty() && changed.statement.implicit().is_empty();
        if is_free && changed.evidence.steps.len() < 300 {
            for at in points(&changed.statement, &mut random) {
                evaluated += 1;
                if let Some(fact) = false_fact(&changed, &at) {
                    wrong.push(format!("{label}: {} makes {fact}", KINDS[kind]));
                }
            }
        }
    }
    println!("{breaks} breaks, {to_twins} of them taken to the twin, {evaluated} evaluations");
    for (kind, (count, accepted)) in &counts {
        println!("{kind}: {accepted} of {count} accepted of the true claim");
    }
    assert!(
        wrong.is_empty(),
        "{} wrong: {}",
        wrong.len(),
        wrong[..wrong.len().min(10)].join("\n")
    );
}
