//! Points at which the premises of a claim hold and the claim does not.

use super::point::family;
use super::print::{simplified, tex};
use kernel::{
    At, EFFORT, Function, Node, Origin, Property, Quantity, Statement, Symbol, Term, With, Witness, term_value,
};
use numbers::{Field, Interval, Rational, Wide};
use std::collections::{BTreeSet, HashMap};
use std::fmt;
use texmath::Relation;

/// A point, in the names of the sheet, and the two sides of the claim there.
#[derive(Clone, Debug, PartialEq)]
pub struct Counterexample {
    /// The symbols that premises and claim speak of, with their values.
    pub point: Vec<(String, String)>,
    pub left: String,
    pub right: String,
    /// The first figures of both sides, where these are real.
    pub decimals: (Option<String>, Option<String>),
    /// The terms of the left and of the right side with their values, where there are several.
    pub terms: (Terms, Terms),
}

/// Terms, each with its value.
pub type Terms = Vec<(String, String)>;

/// A side of an equation at a point.
#[derive(Clone, Debug)]
pub struct Side {
    pub value: String,
    side: String,
    terms: Terms,
}

impl Side {
    /// The side as it stands, and each of its terms below it, with what it is there; nothing of a number.
    pub fn worked_out(&self) -> impl Iterator<Item = (usize, String)> {
        let whole = (self.side != self.value).then(|| (0, format!("{} = {}", self.side, self.value)));
        let terms = self.terms.iter().map(|(term, value)| (1, format!("{term} = {value}")));
        whole.into_iter().chain(terms)
    }
}

impl fmt::Display for Counterexample {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (name, value) in &self.point {
            write!(f, "{name}={value}; ")?;
        }
        write!(f, "left={}; right={}", self.left, self.right)
    }
}

/// An equation that gives a map, differentiated along it: `slope` vanishes, and so does `at_values`, as TeX.
pub struct Derivation {
    pub label: String,
    pub by: String,
    pub slope: String,
    pub at_values: String,
}

/// A statement at a witness.
pub struct Values<'a>(At<'a>);

impl<'a> Values<'a> {
    /// The values at a witness that the kernel has taken. `statement` is the one that the witness is about.
    pub fn new(statement: &'a mut Statement, witness: &'a Witness) -> Self {
        Self(At::unchecked(statement, witness, EFFORT))
    }

    fn statement(&mut self) -> &mut Statement {
        self.0.statement()
    }

    /// The value of a term, in its simplest form.
    fn of(&mut self, term: Term) -> Term {
        let value = self.0.value(term).unwrap_or(term);
        simplified(self.statement().terms_mut(), value)
    }

    /// The sides of what is written as their difference.
    fn sides(&mut self, difference: Term) -> [Term; 2] {
        match self.statement().terms().node(difference).clone() {
            Node::Sum(parts) if parts.len() == 2 => [parts[0], negated(self.statement(), parts[1])],
            _ => [difference, self.statement().terms_mut().integer(0)],
        }
    }

    /// The premises that are no laws: the label and both sides.
    pub fn premises(&mut self) -> Vec<(String, [Side; 2])> {
        let mut found = Vec::new();
        for given in self.statement().givens().to_vec() {
            if given.property == Property::Zero && given.law.is_none() {
                let sides = self.sides(given.term).map(|side| Side {
                    value: self.shown(side),
                    side: tex(self.statement().terms(), side),
                    terms: self.terms(side),
                });
                found.push((given.origin.to_string(), sides));
            }
        }
        found
    }

    /// The values of unknown functions that the claim and its premises speak of: function, order of the derivative, time.
    fn spoken(&mut self) -> BTreeSet<(Function, u32, Term)> {
        let own = self.statement();
        let givens = own
            .givens()
            .iter()
            .filter(|given| !matches!(given.origin, Origin::Declared(_)));
        let goals = own.goal().iter().map(|(_, term)| *term);
        let written: Vec<Term> = givens.map(|given| given.term).chain(goals).collect();
        let mut spoken = BTreeSet::new();
        for term in written {
            let term = own.written_out(term);
            spoken.extend(values_in(own, term));
        }
        spoken
    }

    /// The laws that hold at all times: the label, both sides, and what the functions in it are at the times that are spoken of.
    pub fn laws(&mut self) -> Vec<(String, [String; 2], Terms)> {
        let (mut found, spoken) = (Vec::new(), self.spoken());
        for given in self.statement().givens().to_vec() {
            let is_law = given
                .law
                .as_ref()
                .is_some_and(|law| law.interval.is_none() && law.time.is_some());
            if given.property != Property::Zero || !is_law || matches!(given.origin, Origin::Declared(_)) {
                continue;
            }
            let functions: BTreeSet<Function> = values_in(self.statement(), given.term)
                .into_iter()
                .map(|(of, ..)| of)
                .collect();
            let sides = self.sides(given.term);
            let mut values = Terms::new();
            for &(function, order, time) in spoken.iter().filter(|(of, ..)| functions.contains(of)) {
                let at = self.of(time);
                if self.statement().terms().is_closed(at) {
                    let [value, named] = [time, at].map(|time| self.statement().value(function, order, time));
                    let named = tex(self.statement().terms(), named);
                    values.push((named, self.shown(value)));
                }
            }
            values.dedup();
            found.push((
                given.origin.to_string(),
                sides.map(|side| tex(self.statement().terms(), side)),
                values,
            ));
        }
        found
    }

    /// The derivatives along maps that the claim speaks of: the label of each equation that gives a map, what it is
    /// differentiated by, the derivative, which vanishes, and the same with values put in for all but what is sought.
    pub fn derivatives(&mut self) -> Vec<Derivation> {
        let goals: Vec<Term> = self.statement().goal().iter().map(|(_, term)| *term).collect();
        let mut sought = BTreeSet::new();
        for goal in goals {
            let written = self.statement().written_out(goal);
            sought.extend(partials_in(self.statement(), written));
        }
        let mut found = Vec::new();
        for step in self.statement().implicit().to_vec() {
            for &by in &step.by {
                for (label, equation) in &step.equations {
                    let slope = self.statement().along(*equation, &step, by);
                    let partials = partials_in(self.statement(), slope);
                    if partials.iter().any(|symbol| sought.contains(symbol)) {
                        found.push(self.derivation(&label.to_string(), slope, by, &partials));
                    }
                }
            }
        }
        found
    }

    fn derivation(&mut self, label: &str, slope: Term, by: Symbol, partials: &BTreeSet<Symbol>) -> Derivation {
        let mut constant = slope;
        let mut terms = Vec::new();
        for &partial in partials {
            let zero = self.statement().terms_mut().integer(0);
            constant = self.statement().terms_mut().substitute(constant, partial, zero);
            let factor = self.statement().derivative(slope, partial);
            let (factor, partial) = (self.of(factor), self.statement().terms_mut().symbol(partial));
            terms.push(self.statement().terms_mut().product(vec![factor, partial]));
        }
        terms.push(self.of(constant));
        let at_values = self.statement().terms_mut().sum(terms);
        let terms = self.statement().terms();
        Derivation {
            label: label.to_owned(),
            by: terms.symbol_name(by).to_string(),
            slope: tex(terms, slope),
            at_values: tex(terms, at_values),
        }
    }

    /// The value of a term as TeX; its first figures and `...` where the exact value takes too many characters to be read.
    fn shown(&mut self, term: Term) -> String {
        let value = self.of(term);
        let exact = tex(self.statement().terms(), value);
        match exact.len() > LONGEST_VALUE {
            true => self.decimal(value).map_or(exact, |figures| format!("{figures}...")),
            false => exact,
        }
    }

    /// The terms that a side, or what it abbreviates, is the sum of, each with its value.
    fn terms(&mut self, side: Term) -> Terms {
        let side = match self.statement().terms().node(side) {
            Node::Sum(_) => side,
            _ => self.statement().written_out(side),
        };
        let Node::Sum(parts) = self.statement().terms().node(side).clone() else {
            return Vec::new();
        };
        let each = parts.into_iter().map(|part| {
            let printed = tex(self.statement().terms(), part);
            (printed, self.shown(part))
        });
        each.collect()
    }

    /// The first figures of the value of a term, as an enclosure of 40 digits has them.
    pub fn decimal(&mut self, term: Term) -> Option<String> {
        let value = self.of(term);
        let enclosure: Interval<Wide<40>> = term_value(self.statement().terms(), value, &mut HashMap::new())?;
        let (low, high) = (
            enclosure.low().to_decimal(FIGURES),
            enclosure.high().to_decimal(FIGURES),
        );
        (low == high).then_some(low)
    }
}

/// The most characters of an exact value.
const LONGEST_VALUE: usize = 1000;

/// Figures of a value that are printed beside it.
const FIGURES: usize = 12;

/// The point of a witness, in the names of the sheet.
pub fn point(witness: &With<Witness>) -> Vec<(String, String)> {
    let mut statement = witness.statement.clone();
    named(&mut Values::new(&mut statement, &witness.evidence), &witness.evidence)
}

/// The symbols and functions that the claim and its premises speak of, with their values.
fn named(values: &mut Values<'_>, witness: &Witness) -> Vec<(String, String)> {
    let mut spoken: BTreeSet<Symbol> = BTreeSet::new();
    let own = values.statement();
    let givens = own
        .givens()
        .iter()
        .filter(|given| !matches!(given.origin, Origin::Declared(_)));
    let goals = own.goal().iter().map(|(_, term)| *term);
    let written: Vec<Term> = givens.map(|given| given.term).chain(goals).collect();
    for &term in &written {
        let whole = own.written_out(term);
        for inner in own.terms().inside(term).into_iter().chain(own.terms().inside(whole)) {
            if let Node::Symbol(symbol) = own.terms().node(inner) {
                spoken.insert(*symbol);
            }
        }
    }
    let order = |symbol: &Symbol, statement: &Statement| match statement.quantity(*symbol) {
        Some(Quantity::Parameter | Quantity::Index | Quantity::Abbreviation { .. }) => Some(0),
        Some(Quantity::Running) => Some(1),
        Some(Quantity::Member { .. }) if statement.instant_of(*symbol).is_some() => Some(1),
        Some(Quantity::Member { .. } | Quantity::Numbered) => Some(2),
        Some(Quantity::Partial { .. } | Quantity::Fixed) => Some(3),
        Some(Quantity::Fresh) | None => None,
    };
    let mut symbols: Vec<(i32, Symbol)> = spoken
        .into_iter()
        .filter_map(|symbol| Some((order(&symbol, values.statement())?, symbol)))
        .collect();
    symbols.sort();
    let mut point = Vec::new();
    for (_, symbol) in symbols {
        let term = values.statement().terms_mut().symbol(symbol);
        let found = values.of(term);
        if values.statement().terms().is_closed(found) {
            let name = values.statement().terms().symbol_name(symbol).to_string();
            point.push((name, values.shown(term)));
        }
    }
    let valued = values.spoken();
    // a value at a number that nothing speaks of is left out, beside values at times of the sheet
    let at_number: Vec<bool> = {
        let terms = values.statement().terms();
        witness
            .table
            .iter()
            .map(|(.., time, _)| terms.is_closed(*time))
            .collect()
    };
    let is_elsewhere = |function: Function| {
        let mut rows = witness.table.iter().zip(&at_number);
        rows.any(|((of, ..), at_number)| *of == function && !at_number)
    };
    for ((function, order, time, _), at_number) in witness.table.iter().zip(&at_number) {
        let is_spoken = valued.iter().any(|(.., at)| at == time);
        if *at_number && !is_spoken && is_elsewhere(*function) {
            continue;
        }
        let named = values.statement().value(*function, *order, *time);
        let name = tex(values.statement().terms(), named);
        point.push((name, values.shown(named)));
    }
    let valued: BTreeSet<Function> = valued.into_iter().map(|(of, ..)| of).collect();
    let is_spoken = |function: Function, statement: &Statement| !family(statement, function).is_disjoint(&valued);
    for (function, time, term) in &witness.functions {
        if !is_spoken(*function, values.statement()) {
            continue;
        }
        let terms = values.statement().terms();
        let name = format!("{}({})", terms.function_name(*function), terms.symbol_name(*time));
        point.push((name, values.shown(*term)));
    }
    point
}

/// The point of a witness, in the names of the sheet, and the two sides of the relation whose goal fails there.
pub fn at(witness: &With<Witness>, relation: Relation) -> Option<Counterexample> {
    let mut statement = witness.statement.clone();
    let mut values = Values::new(&mut statement, &witness.evidence);
    let point = named(&mut values, &witness.evidence);
    let goals = values.statement().goal().to_vec();
    for (property, goal) in goals {
        let mut sides = values.sides(goal);
        if matches!(relation, Relation::Less | Relation::LessOrEqual) {
            // what is positive is right - left
            sides.reverse();
        }
        let [first, second] = sides;
        let (left, right) = (values.of(first), values.of(second));
        if property == Property::Zero && left == right {
            continue;
        }
        let terms = (values.terms(first), values.terms(second));
        let decimals = (values.decimal(first), values.decimal(second));
        return Some(Counterexample {
            point,
            left: values.shown(left),
            right: values.shown(right),
            decimals,
            terms,
        });
    }
    None
}

/// The values of unknown functions in a term.
fn values_in(statement: &Statement, term: Term) -> Vec<(Function, u32, Term)> {
    let inside = statement.terms().inside(term).into_iter();
    let value = |inner| match statement.terms().node(inner) {
        Node::Value(function, order, time) => Some((*function, *order, *time)),
        _ => None,
    };
    inside.filter_map(value).collect()
}

/// The derivatives along maps in a term.
fn partials_in(statement: &Statement, term: Term) -> BTreeSet<Symbol> {
    let inside = statement.terms().inside(term).into_iter();
    let partial = |inner| match statement.terms().node(inner) {
        Node::Symbol(symbol) => {
            matches!(statement.quantity(*symbol), Some(Quantity::Partial { .. })).then_some(*symbol)
        }
        _ => None,
    };
    inside.filter_map(partial).collect()
}

/// `x` of `-x`, as goals are written.
fn negated(statement: &mut Statement, term: Term) -> Term {
    if let Node::Product(parts) = statement.terms().node(term).clone()
        && let [minus, of] = parts.as_slice()
        && *statement.terms().node(*minus) == Node::Number(<Rational as Field>::from_integer(-1))
    {
        return *of;
    }
    statement.terms_mut().negative(term)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_counterexample_is_one_line() {
        let text = |a: &str, b: &str| (a.to_string(), b.to_string());
        let counterexample = Counterexample {
            point: vec![text("r_B", "1/2"), text("T", "2")],
            left: "2".to_string(),
            right: "3".to_string(),
            decimals: (None, None),
            terms: (Vec::new(), Vec::new()),
        };
        assert_eq!(counterexample.to_string(), "r_B=1/2; T=2; left=2; right=3");
    }
}
