//! The proof or the counterexample of a claim, for readers: what the kernel accepted, in the names of the sheet.

use super::counterexample::Values;
use super::print::tex;
use super::script::Found;
use super::session::term_of;
use super::{Decision, Options, decided};
use crate::algebra::{coefficients_in, degree_in};
use claims::Sheet;
use kernel::{
    Axiom, AxiomRow, Certificate, Checker, DERIVATIVES_EXIST, Fact, Inference, LawSource, Origin, Polynomial, Property,
    Statement, Term, With, Witness,
};
use numbers::{Field, Rational};
use std::collections::{BTreeMap, BTreeSet};
use std::fmt;
use texmath::Relation;

/// Terms of a polynomial that are printed; `--proof` writes all.
const MOST_TERMS: usize = 16;

/// A proof or a counterexample, line by line; shown without marks.
#[derive(Clone, Debug, Default)]
pub struct Explanation {
    /// What stands in a line, with a mark before and behind each formula.
    lines: Vec<String>,
}

/// The marks before and behind a formula; no TeX holds them.
const FORMULA: [char; 2] = ['\u{2}', '\u{3}'];

/// A formula within a line of an [`Explanation`].
pub fn formula(tex: impl fmt::Display) -> String {
    let [before, behind] = FORMULA;
    let tex = tex.to_string();
    // a polynomial that is not printed whole ends in words
    let (shown, words) = tex.split_at(tex.find(CUT).unwrap_or(tex.len()));
    format!("{before}{shown}{behind}{words}")
}

/// A line without the marks of [`formula`].
pub(super) fn unmarked(line: &str) -> String {
    line.replace(FORMULA, "")
}

/// Where a polynomial is cut off.
const CUT: &str = " + ... (";

/// A condition under which a verdict holds, as [`Decision::provided`] has it.
fn condition(text: &str) -> String {
    match text.strip_prefix(DERIVATIVES_EXIST) {
        Some(names) => {
            let names: Vec<String> = names.trim().split(", ").map(formula).collect();
            format!("{DERIVATIVES_EXIST} {}", names.join(", "))
        }
        None => formula(text),
    }
}

impl Explanation {
    /// Adds lines of words, in which formulas stand as [`formula`] writes them.
    pub fn say(&mut self, words: &str) {
        self.lines.extend(words.lines().map(str::to_owned));
    }

    /// Each line: how far it is indented, and its parts, of which every second is TeX, from the second on.
    pub fn lines(&self) -> impl Iterator<Item = (usize, Vec<&str>)> {
        self.lines.iter().flat_map(|line| line.split('\n')).map(|line| {
            let text = line.trim_start_matches(' ');
            (line.len() - text.len(), text.split(FORMULA).collect())
        })
    }
}

impl fmt::Display for Explanation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.lines.iter().try_for_each(|line| writeln!(f, "{}", unmarked(line)))
    }
}

/// The proof or the counterexample of the claim at a position.
pub fn explain(sheet: &Sheet, position: usize, decision: &Decision, options: &Options) -> Explanation {
    let mut lines = vec![format!(
        "({}) {}: {}",
        decision.label, decision.verdict, decision.reason
    )];
    if !decision.readings.is_empty() {
        lines.push(format!("read as: {}", decision.readings.join("; ")));
    }
    let reductions = decision.reductions();
    if !reductions.is_empty() {
        lines.push(format!("reduced by rules that are trusted: {reductions}"));
    }
    if !decision.provided.is_empty() {
        let provided: Vec<String> = decision.provided.iter().map(|own| condition(own)).collect();
        lines.push(format!("provided: {}", provided.join("; ")));
    }
    let mut given = Vec::new();
    if let Ok(statements) = Decision::without_search(sheet, position) {
        let premises = statements.premises.iter();
        given.extend(premises.map(|premise| format!("  ({})  {}", premise.label, formula(&premise.equation))));
    }
    let entry = sheet.entries.get(position);
    let local = entry.map_or(&[][..], |entry| &entry.local);
    given.extend(
        local
            .iter()
            .map(|(definition, _)| format!("  where  {}", formula(definition))),
    );
    if !given.is_empty() {
        lines.push("\ngiven".into());
        lines.append(&mut given);
    }
    let decided = decided(sheet, position, options);
    let printed: Vec<String> = entry
        .map_or(&[][..], |entry| &entry.equations)
        .iter()
        .map(ToString::to_string)
        .collect();
    // what is decided of an integral, a series or a limit is not what is printed
    if decided
        .iter()
        .any(|one| !printed.contains(&one.question.equation.to_string()))
    {
        lines.push("\nprinted".into());
        lines.extend(printed.iter().map(|equation| format!("  {}", formula(equation))));
    }
    for one in decided {
        let instance = match one.question.instance.as_str() {
            "" => String::new(),
            instance => format!("  ({instance})"),
        };
        let part = match one.goal.part.as_str() {
            "" => String::new(),
            part if part == one.question.equation.to_string() => String::new(),
            part => format!(": {part}"),
        };
        lines.push(format!(
            "\nclaim{part}\n  {}{instance}",
            formula(&one.question.equation)
        ));
        match &one.found {
            Found::Proved { certificate, .. } => {
                Proof::replayed(certificate).write(certificate.evidence.steps.len(), &mut lines);
            }
            Found::Refuted { witness } => refutation(witness, one.question.equation.relation, &mut lines),
        }
    }
    Explanation { lines }
}

/// The facts of a certificate as the kernel's checker finds them, each with the step that adds it.
pub(super) struct Proof {
    pub(super) statement: Statement,
    pub(super) facts: Vec<(Fact, Inference)>,
    pub(super) laws: Vec<Inference>,
    /// Each fact as a linear combination of those that are no linear combinations.
    pub(super) combinations: Vec<BTreeMap<usize, Polynomial>>,
    /// For each goal, its numerator and the fact that shows it.
    pub(super) goals: Vec<(Property, Polynomial, Option<usize>)>,
    /// The numbers that the facts have as steps for readers.
    pub(super) numbers: BTreeMap<usize, usize>,
}

/// A fact that is inserted into what is to be shown.
struct Insertion {
    fact: usize,
    coefficient: Polynomial,
    /// The fact solved for a generator, and this.
    solved: Option<String>,
    pivot: Option<String>,
    /// What remains to be shown to be 0.
    rest: Polynomial,
}

impl Proof {
    pub(super) fn replayed(certificate: &With<Certificate>) -> Self {
        let mut statement = certificate.statement.clone();
        let goal = statement.goal().to_vec();
        let mut checker = Checker::new(&mut statement, &certificate.evidence, u64::MAX);
        let (mut steps, mut laws) = (Vec::new(), Vec::new());
        for step in &certificate.evidence.steps {
            if checker.apply(step).is_err() {
                break;
            }
            steps.resize(checker.facts.len(), step.clone());
            laws.resize(checker.laws(), step.clone());
        }
        let all = checker.facts.clone();
        let absurd = checker.is_absurd();
        let mut goals = Vec::new();
        for (property, term) in goal {
            // the fact from which on the goal is known: what is known only grows
            let (mut least, mut most) = (if absurd { all.len() } else { 0 }, all.len());
            while least < most {
                let middle = usize::midpoint(least, most);
                checker.facts = all[..middle].to_vec();
                match checker.knows(property, term).unwrap_or(false) {
                    true => most = middle,
                    false => least = middle + 1,
                }
            }
            let quotient = checker.expansion.of(checker.statement.terms(), term);
            let numerator = quotient.map(|quotient| quotient.numerator).unwrap_or_default();
            goals.push((property, numerator, most.checked_sub(1)));
        }
        let mut combinations: Vec<BTreeMap<usize, Polynomial>> = Vec::new();
        for (number, step) in steps.iter().enumerate() {
            let sum = linear(step).and_then(|terms| sum_of(terms, &combinations));
            combinations.push(sum.unwrap_or_else(|| BTreeMap::from([(number, Polynomial::integer(1))])));
        }
        Self {
            statement,
            facts: all.into_iter().zip(steps).collect(),
            laws,
            combinations,
            goals,
            numbers: BTreeMap::new(),
        }
    }

    /// The facts that a step rests on and names, through linear combinations.
    pub(super) fn below(&self, step: &Inference) -> BTreeSet<usize> {
        let mut below = BTreeSet::new();
        named(step, &mut |fact| {
            below.extend(self.combinations.get(fact).into_iter().flat_map(BTreeMap::keys))
        });
        below
    }

    fn write(mut self, steps: usize, lines: &mut Vec<String>) {
        let goals = std::mem::take(&mut self.goals);
        let mut shown: BTreeSet<usize> = BTreeSet::new();
        let known = goals.iter().filter_map(|(.., fact)| *fact);
        let mut open: Vec<usize> = known.flat_map(|fact| self.combinations[fact].keys().copied()).collect();
        while let Some(fact) = open.pop() {
            if shown.insert(fact) {
                open.extend(self.below(&self.facts[fact].1).range(..fact));
            }
        }
        self.numbers = shown.iter().copied().zip(1..).collect();
        let ways: Vec<Vec<Insertion>> = goals.iter().map(|(.., fact)| self.insertions(*fact)).collect();
        lines.push(format!(
            "\nproof, from a certificate of {steps} steps that the kernel accepts; [n] is what step n says to be 0"
        ));
        for &number in &shown {
            let (fact, step) = self.facts[number].clone();
            let polynomial = self.polynomial(&fact.polynomial);
            let source = self.source(&step);
            lines.push(format!(
                "  {}. {source}:\n     {}",
                self.numbers[&number],
                formula(format!("{polynomial} {}", relation(fact.property)))
            ));
            let solved = ways
                .iter()
                .flatten()
                .find(|way| way.fact == number && way.solved.is_some());
            if let Some(solved) = solved.and_then(|way| way.solved.clone()) {
                lines.push(format!("     so {}", formula(solved)));
            }
        }
        let mut next = shown.len() + 1;
        for ((property, numerator, fact), ways) in goals.into_iter().zip(ways) {
            let printed = self.polynomial(&numerator);
            let is_zero = relation(property);
            lines.push(format!(
                "  {next}. It is to be shown that {}, where N is the numerator of left - right:\n     {}",
                formula(format!("N {is_zero}")),
                formula(format!("N = {printed}"))
            ));
            next += 1;
            let Some(fact) = fact else {
                lines.push(format!(
                    "     {} by itself, when multiplied out",
                    formula(format!("N {is_zero}"))
                ));
                continue;
            };
            let factor = ratio(&self.facts[fact].0.polynomial, &numerator);
            for way in ways {
                let of = self.numbers[&way.fact];
                let how = match way.pivot {
                    Some(pivot) => format!("Insert {} from step {of}", formula(pivot)),
                    None => format!("Take ({}) [{of}] off", formula(self.polynomial(&way.coefficient))),
                };
                let rest = self.polynomial(&way.rest);
                lines.push(format!(
                    "  {next}. {how}:\n     {}",
                    formula(format!("{factor}N = {rest}"))
                ));
                next += 1;
            }
            let sum = self.sum(&self.combinations[fact].clone());
            lines.push(format!(
                "  so {}, for in one line\n     {} = {sum}",
                formula(format!("N {is_zero}")),
                formula(format!("{factor}N"))
            ));
        }
    }

    /// What is inserted in turn into the numerator that a fact is, until nothing remains of it: where that can be, a fact
    /// solved for a generator that then is gone.
    fn insertions(&mut self, fact: Option<usize>) -> Vec<Insertion> {
        let Some(fact) = fact.filter(|fact| self.facts[*fact].0.property == Property::Zero) else {
            return Vec::new();
        };
        let mut open: Vec<(usize, Polynomial)> = self.combinations[fact].clone().into_iter().collect();
        let mut rest = self.facts[fact].0.polynomial.clone();
        let mut found = Vec::new();
        if open.iter().all(|(number, _)| *number == fact) {
            return found;
        }
        while !open.is_empty() {
            let next = open.iter().enumerate().find_map(|(place, (number, coefficient))| {
                let polynomial = &self.facts[*number].0.polynomial;
                let after = rest.minus(&coefficient.times_within(polynomial, MOST_TERMS * MOST_TERMS)?);
                let is_gone = |pivot: &Term| {
                    let lead = coefficients_in(polynomial, *pivot);
                    let is_solved = lead.len() == 2 && lead.last().and_then(Polynomial::as_constant).is_some();
                    is_solved && degree_in(&rest, *pivot) > 0 && degree_in(&after, *pivot) == 0
                };
                let pivot = polynomial.generators().into_iter().find(is_gone)?;
                Some((place, Some(pivot)))
            });
            let (place, pivot) = next.unwrap_or((0, None));
            let (number, coefficient) = open.remove(place);
            let polynomial = self.facts[number].0.polynomial.clone();
            rest = rest.minus(&coefficient.times(&polynomial));
            let solved = pivot.and_then(|pivot| self.solved(&polynomial, pivot));
            let pivot = pivot.map(|pivot| tex(self.statement.terms(), pivot));
            found.push(Insertion {
                fact: number,
                coefficient,
                solved,
                pivot,
                rest: rest.clone(),
            });
        }
        found
    }

    /// A polynomial that is 0, solved for a generator that it is linear in.
    fn solved(&mut self, polynomial: &Polynomial, pivot: Term) -> Option<String> {
        let coefficients = coefficients_in(polynomial, pivot);
        let [others, lead] = coefficients.as_slice() else {
            return None;
        };
        let value = others.scaled(&(-<Rational as Field>::from_integer(1) / lead.as_constant()?));
        let value = self.polynomial(&value);
        Some(format!("{} = {value}", tex(self.statement.terms(), pivot)))
    }

    fn polynomial(&mut self, polynomial: &Polynomial) -> String {
        let count = polynomial.terms().len();
        let shown = Polynomial::from_terms(polynomial.terms().iter().take(MOST_TERMS).cloned());
        let term = term_of(self.statement.terms_mut(), &shown);
        let shown = tex(self.statement.terms(), term);
        match count > MOST_TERMS {
            true => format!("{shown}{CUT}{count} terms)"),
            false => shown,
        }
    }

    /// A linear combination of facts, as `(-r_T) [1] + [2]`.
    fn sum(&mut self, terms: &BTreeMap<usize, Polynomial>) -> String {
        let part = |(fact, coefficient): (&usize, &Polynomial)| match self.polynomial(coefficient).as_str() {
            "1" => format!("[{}]", self.number(*fact)),
            coefficient => format!("({}) [{}]", formula(coefficient), self.number(*fact)),
        };
        let parts: Vec<String> = terms.iter().map(part).collect();
        if parts.is_empty() {
            "0".into()
        } else {
            parts.join(" + ")
        }
    }

    /// The number of a fact as a step for readers.
    fn number(&self, fact: usize) -> usize {
        self.numbers.get(&fact).copied().unwrap_or_default()
    }

    fn given(&self, number: usize) -> String {
        let given = self.statement.givens().get(number);
        match given.map(|given| &given.origin) {
            Some(Origin::Premise(label)) => format!("({label})"),
            Some(origin @ Origin::DerivativesExist(_)) => condition(&origin.to_string()),
            Some(origin) => origin.to_string(),
            None => String::new(),
        }
    }

    pub(super) fn law(&self, source: LawSource) -> String {
        match source {
            LawSource::Given { given, shift: 0 } => self.given(given),
            LawSource::Given { given, shift } => format!("{}, impacts moved on by {shift}", self.given(given)),
            LawSource::Derived(law) => match self.laws.get(law) {
                Some(Inference::Derivative(of)) => format!("the derivative of {}", self.law(*of)),
                Some(Inference::Constant { of, .. }) => {
                    format!(
                        "{}, constant as its derivative is 0",
                        formula(tex(self.statement.terms(), *of))
                    )
                }
                _ => "a derived law".into(),
            },
        }
    }

    /// Where a fact comes from.
    pub(super) fn source(&mut self, step: &Inference) -> String {
        let print = |term| formula(tex(self.statement.terms(), term));
        let below = self.below(step);
        let facts: Vec<String> = below.iter().map(|fact| self.number(*fact).to_string()).collect();
        let by = |how: &str| match facts.as_slice() {
            [] => how.to_string(),
            [one] => format!("{how}, with step {one}"),
            _ => format!("{how}, with the steps {}", facts.join(", ")),
        };
        match step {
            Inference::Given(number) => format!("By {}", self.given(*number)),
            Inference::Law { source, at: None } => format!("By {}", self.law(*source)),
            Inference::Law { source, at: Some(at) } => format!("By {}, at {}", self.law(*source), print(*at)),
            Inference::Axiom(axiom) => format!("By the axiom: {}", described(axiom)),
            Inference::Unfold(_) => "By definition".into(),
            Inference::Enclosure(_) => "By interval arithmetic".into(),
            Inference::Between { .. } => by("By interval arithmetic between bounds"),
            Inference::Zero {
                power,
                squares,
                factors,
                ..
            } => by(match (power, squares.len(), factors.len()) {
                (1, 0, 0) => "By a linear combination",
                (_, 0, _) => "As a power of it, or a multiple by what is not 0, is a linear combination",
                _ => "As the sum of it and of squares is a linear combination",
            }),
            Inference::Nonzero { .. } => by("As it divides a product of factors that are not 0"),
            Inference::Sign { .. } => by("As a sum of squares and of products of what has a sign"),
            Inference::Squeezed { .. } => by("As neither positive nor negative"),
            Inference::Congruence { left, right } => {
                format!("By equal arguments of {} and {}", print(*left), print(*right))
            }
            Inference::Cases { on, order, .. } => {
                let cases = if *order { "positive, 0 or negative" } else { "0 or not" };
                let how = format!("In every case: {cases} is\n         {}", formula(self.polynomial(on)));
                by(&how)
            }
            Inference::Generic(term) => format!("For generic symbols {} is not 0", print(*term)),
            Inference::Along { implicit, equation, by } => {
                let equations = self.statement.implicit().get(*implicit).map(|own| &own.equations);
                let label = equations.and_then(|equations| equations.get(*equation));
                let label = label.map_or("the equation of a map".to_owned(), |(origin, _)| origin.to_string());
                let by = self.statement.terms().symbol_name(*by);
                format!(
                    "By ({label}) along the map, differentiated with respect to {}",
                    formula(by)
                )
            }
            Inference::Derivative(_) | Inference::Constant { .. } => String::new(),
        }
    }
}

/// The terms of a step that is a linear combination of facts.
fn linear(step: &Inference) -> Option<&[(Polynomial, usize)]> {
    match step {
        Inference::Zero {
            power: 1,
            squares,
            factors,
            terms,
            ..
        } if squares.is_empty() && factors.is_empty() => Some(terms),
        _ => None,
    }
}

/// A sum of multiples of combinations; `None` where a coefficient would be too long to read.
fn sum_of(terms: &[(Polynomial, usize)], of: &[BTreeMap<usize, Polynomial>]) -> Option<BTreeMap<usize, Polynomial>> {
    let mut sum: BTreeMap<usize, Polynomial> = BTreeMap::new();
    for (coefficient, fact) in terms {
        for (other, inner) in of.get(*fact)? {
            let product = coefficient.times_within(inner, MOST_TERMS)?;
            let known = sum.entry(*other).or_default();
            *known = known.plus(&product);
        }
    }
    sum.retain(|_, coefficient| !coefficient.is_zero());
    Some(sum)
}

/// The facts that a step names.
pub(super) fn named(step: &Inference, take: &mut dyn FnMut(usize)) {
    match step {
        Inference::Zero { factors, terms, .. }
        | Inference::Nonzero { factors, terms, .. }
        | Inference::Sign { factors, terms, .. } => {
            factors.iter().for_each(|(fact, _)| take(*fact));
            terms.iter().for_each(|(_, fact)| take(*fact));
        }
        Inference::Between { within, .. } => within.iter().flatten().for_each(|fact| take(*fact)),
        Inference::Squeezed { low, high } => [*low, *high].into_iter().for_each(&mut *take),
        Inference::Cases { branches, .. } => branches.iter().flatten().for_each(|inner| named(inner, take)),
        _ => {}
    }
    if let Inference::Sign { summands, .. } = step {
        summands
            .iter()
            .flat_map(|summand| &summand.facts)
            .for_each(|fact| take(*fact));
    }
}

/// How many times a polynomial is another one, as a factor to be printed.
fn ratio(of: &Polynomial, unit: &Polynomial) -> String {
    let lead = |polynomial: &Polynomial| polynomial.terms().first().map(|(_, value)| value.clone());
    match lead(of).zip(lead(unit)).map(|(of, unit)| of / unit) {
        Some(factor) if of.is_multiple_of(unit) && factor != dashu_ratio::RBig::ONE => format!("({factor}) "),
        _ => String::new(),
    }
}

fn relation(property: Property) -> &'static str {
    match property {
        Property::Zero => "= 0",
        Property::Nonzero => r"\neq 0",
        Property::Positive => "> 0",
        Property::NonNegative => r"\ge 0",
        Property::Integer => r"\in \mathbb{Z}",
    }
}

/// The name of an axiom in words, and its source.
fn described(axiom: &Axiom) -> String {
    let letters = axiom.name.chars();
    let words = letters.flat_map(|c| [c.is_ascii_uppercase().then_some(' '), Some(c.to_ascii_lowercase())]);
    let words: String = words.flatten().collect();
    let source = AxiomRow::named(axiom.name).map_or("", |row| row.source);
    format!("{} ({source})", words.trim())
}

/// The point of a witness, what the premises and the two sides are there.
fn refutation(witness: &With<Witness>, relation: Relation, lines: &mut Vec<String>) {
    let Some(found) = super::counterexample::at(witness, relation) else {
        return;
    };
    match found.point.is_empty() {
        true => lines.push("\nthe claim does not hold".into()),
        false => lines.push("\nevery premise holds, exactly, and the claim does not, where".into()),
    }
    lines.extend(
        found
            .point
            .iter()
            .map(|(name, value)| format!("  {}", formula(format!("{name} = {value}")))),
    );
    let mut statement = witness.statement.clone();
    let mut values = Values::new(&mut statement, &witness.evidence);
    let premises = values.premises();
    if !premises.is_empty() {
        lines.push("there the premises are".into());
    }
    for (label, [left, right]) in premises {
        lines.push(format!(
            "  ({label})  {}",
            formula(format!("{} = {}", left.value, right.value))
        ));
        for side in [left, right] {
            lines.extend(
                side.worked_out()
                    .map(|(depth, line)| format!("{:depth$}{}", "", formula(line), depth = 8 + 2 * depth)),
            );
        }
    }
    for (label, [left, right], of) in values.laws() {
        lines.push(format!(
            "  ({label})  {}, at all times",
            formula(format!("{left} = {right}"))
        ));
        lines.extend(
            of.iter()
                .map(|(named, value)| format!("        {}", formula(format!("{named} = {value}")))),
        );
    }
    if !witness.evidence.table.is_empty() {
        lines.push("functions with these values exist: those of a smooth function and of its derivatives may be chosen freely at".into());
        lines.push("  finitely many times; of a periodic one too, as the values above agree where times are whole periods apart".into());
    }
    let derivations = values.derivatives();
    if !derivations.is_empty() {
        lines.push(
            "the partial derivatives follow from the premises that give the map, differentiated implicitly".into(),
        );
    }
    for derivation in derivations {
        lines.push(format!(
            "  ({}) by {}:  {}",
            derivation.label,
            formula(&derivation.by),
            formula(format!("{} = 0", derivation.slope))
        ));
        lines.push(format!("        {}", formula(format!("{} = 0", derivation.at_values))));
    }
    lines.push("and the claim is".into());
    for (side, value, decimal, terms) in [
        ("left ", found.left, found.decimals.0, found.terms.0),
        ("right", found.right, found.decimals.1, found.terms.1),
    ] {
        let decimal = decimal
            .filter(|_| value.contains('\\'))
            .map_or(String::new(), |decimal| format!(", about {decimal}"));
        lines.push(format!("  {side} = {}{decimal}", formula(value)));
        lines.extend(
            terms
                .iter()
                .map(|(term, value)| format!("    {}", formula(format!("{term} = {value}")))),
        );
    }
}
