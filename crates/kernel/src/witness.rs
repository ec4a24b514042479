//! Witnesses: a point at which everything given holds, and where the claim holds or fails.

use super::certificate::Certificate;
use super::check::Checker;
use super::enclosure;
use super::expand::{Expansion, Quotient, Refusal, vanishes};
use super::polynomial::Polynomial;
use super::statement::{
    FunctionOf, Given, Implicit, Instance, Law, Origin, Property, Quantity, Statement, named_value,
};
use super::term::{Elementary, Function, Node, Symbol, Term};
use num_traits::Zero;
use numbers::Rational;
use std::collections::{BTreeMap, BTreeSet, HashMap};

/// A point: values of symbols and functions.
#[derive(Clone, Debug, Default)]
pub struct Witness {
    /// Values in terms of the symbols that `sample` gives: what the premises determine.
    pub solved: Vec<(Symbol, Term)>,
    /// Values of all other symbols, without symbols.
    pub sample: Vec<(Symbol, Term)>,
    /// Unknown functions, each a term in its symbol.
    pub functions: Vec<(Function, Symbol, Term)>,
    /// Values of unknown functions at single times: function, order of the derivative, time, value.
    pub table: Vec<(Function, u32, Term, Term)>,
    /// What shows that premises hold whose sides are equal numbers of different form.
    pub certificate: Certificate,
}

impl Witness {
    /// The terms that it gives values by.
    fn terms(&self) -> impl Iterator<Item = Term> {
        let values = self.solved.iter().chain(&self.sample).map(|(_, value)| *value);
        let named = self.functions.iter().map(|(.., term)| *term);
        let tabled = self.table.iter().flat_map(|(_, _, time, value)| [*time, *value]);
        values.chain(named).chain(tabled)
    }
}

type Outcome<T> = Result<T, Refusal>;

/// How often values are put into values before these are taken to go in a circle.
const MOST_SUBSTITUTIONS: usize = 64;

/// The laws of intervals are followed to this derivative at their ends.
const DERIVATIVES_AT_AN_END: usize = 2;

fn refused<T>(why: impl Into<String>) -> Outcome<T> {
    Err(Refusal::Other(why.into()))
}

/// The statement at a witness.
pub struct At<'a> {
    statement: &'a mut Statement,
    witness: &'a Witness,
    /// The periods of functions that only have values at single times.
    periods: BTreeMap<Function, Term>,
    effort: u64,
    /// What was expanded so far: of identities, and of numbers.
    identities: Expansion,
    numbers: Expansion,
    solved: HashMap<Symbol, Term>,
    sample: HashMap<Symbol, Term>,
    /// Symbols of the sample that the values of generic symbols depend on: around the point these run, all else stays.
    around: BTreeSet<Symbol>,
    /// Polynomials that the certificate of the witness shows to vanish.
    zeros: Vec<Polynomial>,
}

impl<'a> At<'a> {
    /// The statement at a witness of which nothing is checked: to print its values, and no verdict rests on it.
    pub fn unchecked(statement: &'a mut Statement, witness: &'a Witness, effort: u64) -> Self {
        let mut at = Self::bare(statement, witness, effort);
        // values are then looked up but for whole periods
        let _ = at.check_periods();
        at
    }

    fn bare(statement: &'a mut Statement, witness: &'a Witness, effort: u64) -> Self {
        Self {
            solved: witness.solved.iter().copied().collect(),
            sample: witness.sample.iter().copied().collect(),
            periods: BTreeMap::new(),
            around: BTreeSet::new(),
            identities: Expansion::new(BTreeSet::new(), effort),
            numbers: Expansion::new(witness.certificate.whole.iter().copied().collect(), effort),
            zeros: Vec::new(),
            statement,
            witness,
            effort,
        }
    }

    /// The statement at a witness, every given of it checked.
    ///
    /// # Errors
    /// A [`Refusal`] that says which given is not known to hold.
    pub fn new(statement: &'a mut Statement, witness: &'a Witness, effort: u64) -> Outcome<Self> {
        let mut at = Self::bare(statement, witness, effort);
        if at.statement.quantities.contains(&Quantity::Numbered) {
            return refused("recursions are not followed to an index that is a number");
        }
        let count = at.statement.terms.len();
        if witness.terms().any(|term| term.0 as usize >= count) {
            return refused("a value is no term");
        }
        at.check_values()?;
        at.check_functions()?;
        at.follow_certificate()?;
        at.check_table()?;
        at.check_existence()?;
        at.check_generic()?;
        at.check_ends()?;
        at.check_implicit()?;
        for number in 0..at.statement.givens.len() {
            let given = at.statement.givens[number].clone();
            let holds = match &given.law {
                None => at.holds(&given),
                Some(law) => at.law_holds(number, &given, law),
            };
            holds.map_err(|refusal| match refusal {
                Refusal::Other(why) => Refusal::Other(format!("({}): {why}", given.origin)),
                refusal => refusal,
            })?;
        }
        at.intervals_go_on()?;
        at.powers_are_defined()?;
        Ok(at)
    }

    /// The statement, to print what is at the point.
    pub fn statement(&mut self) -> &mut Statement {
        self.statement
    }

    /// The value of a term at the point, as a term without symbols.
    ///
    /// # Errors
    /// A [`Refusal`] where an unknown function has no value at a time that the term speaks of.
    pub fn value(&mut self, term: Term) -> Outcome<Term> {
        let translated = self.translate(term, None)?;
        Ok(self.sampled(translated, None))
    }

    /// Values of the sample hold no symbols, real ones are real; solved values hold no solved symbols.
    fn check_values(&mut self) -> Outcome<()> {
        for (symbol, value) in self.witness.sample.iter().chain(&self.witness.solved) {
            if self.statement.quantity(*symbol).is_none() {
                return refused("a value is given to a symbol that is none");
            }
            if self.statement.definitions.contains_key(symbol) {
                return refused("an abbreviation has no value of its own");
            }
            let written = self.statement.written_out(*value);
            if written != *value {
                return refused("a value holds an abbreviation");
            }
        }
        self.check_sample()?;
        self.check_moving()
    }

    /// Checks that the values of the sample are numbers, real ones of real symbols.
    fn check_sample(&self) -> Outcome<()> {
        for (symbol, value) in &self.witness.sample {
            if !self.statement.terms.is_closed(*value) || self.solved.contains_key(symbol) {
                return refused("a value of the sample holds symbols, or is given twice");
            }
            let complex = self.statement.complex_symbols.contains(symbol);
            let imaginary = |term: &Term| *self.statement.terms.node(*term) == Node::Imaginary;
            if !complex && self.statement.terms.inside(*value).iter().any(imaginary) {
                return refused("a real symbol has a complex value");
            }
            if !complex || !self.statement.terms.inside(*value).iter().any(imaginary) {
                let mut known = HashMap::new();
                type Enclosed = numbers::Interval<numbers::Wide<40>>;
                let enclosed: Option<Enclosed> = enclosure::term_value(&self.statement.terms, *value, &mut known);
                if enclosed.is_none() {
                    return refused("a value of the sample is not defined");
                }
            }
        }
        Ok(())
    }

    /// Checks that no value depends on the running time or on what is no symbol, and that functions and real symbols have
    /// real values, where no solved one holds another.
    fn check_moving(&self) -> Outcome<()> {
        let is_imaginary = |term: &Term| *self.statement.terms.node(*term) == Node::Imaginary;
        for (_, _, time, _) in &self.witness.table {
            if self.statement.terms.inside(*time).iter().any(is_imaginary) {
                return refused("a function of real times at a complex one");
            }
        }
        let table = self.witness.table.iter().map(|(.., value)| (None, *value));
        let named = self.witness.functions.iter().map(|(.., term)| (None, *term));
        let solved = self.witness.solved.iter().map(|(symbol, value)| (Some(symbol), *value));
        for (symbol, value) in solved.chain(table).chain(named) {
            for inner in self.statement.terms.inside(value) {
                match self.statement.terms.node(inner) {
                    Node::Symbol(other)
                        if matches!(self.statement.quantity(*other), None | Some(Quantity::Running)) =>
                    {
                        return refused("a value depends on the running time, or on a symbol that is none");
                    }
                    Node::Symbol(other) if symbol.is_some() && self.solved.contains_key(other) => {
                        return refused("a solved value holds a solved symbol");
                    }
                    Node::Imaginary if !symbol.is_some_and(|own| self.statement.complex_symbols.contains(own)) => {
                        return refused("a real symbol or function has a complex value");
                    }
                    _ => {}
                }
            }
        }
        Ok(())
    }

    /// The point lies in no thin set of the generic symbols: around it they take all values that the premises in
    /// parameters and times allow, as the ranks of two Jacobians show.
    fn check_generic(&mut self) -> Outcome<()> {
        let generic = self.statement.generic.clone();
        if generic.is_empty() {
            return Ok(());
        }
        for symbol in &generic {
            let term = self.statement.terms.symbol(*symbol);
            let value = self.translate(term, None)?;
            self.around.extend(self.statement.symbols_in(value));
        }
        match self.takes_all_values(&generic, false)? || self.takes_all_values(&generic, true)? {
            true => Ok(()),
            false => refused("the point may lie in a thin set of the generic symbols"),
        }
    }

    /// Returns true if symbols take, around the point, all values that premises and definitions in them, and perhaps in
    /// parameters and instants, allow.
    fn takes_all_values(&mut self, of: &[Symbol], with_others: bool) -> Outcome<bool> {
        let (premises, symbols) = self.premises_on(of, with_others);
        let (mut values, mut free) = (Vec::new(), BTreeSet::new());
        for &symbol in &symbols {
            let term = self.statement.terms.symbol(symbol);
            let value = self.translate(term, None)?;
            free.extend(self.statement.symbols_in(value));
            values.push(value);
        }
        let free: Vec<Symbol> = free.into_iter().collect();
        // abbreviations are symbols of their own here
        let definitions = std::mem::take(&mut self.statement.definitions);
        let within = self.jacobian(&premises, &symbols);
        self.statement.definitions = definitions;
        let (within, around) = (self.rank(within)?, self.jacobian(&values, &free));
        Ok(self.rank(around)? + within >= symbols.len())
    }

    /// Whether a term is a sum of symbols with numbers as coefficients.
    fn is_linear(&self, term: Term) -> bool {
        let quotient = Expansion::new(BTreeSet::new(), self.effort).of(&self.statement.terms, term);
        let is_symbol = |term: Term| matches!(self.statement.terms.node(term), Node::Symbol(_));
        quotient.is_ok_and(|quotient| {
            let of = &quotient.numerator;
            quotient.divisors.is_empty() && of.degree() <= 1 && of.generators().into_iter().all(is_symbol)
        })
    }

    /// Terms in these symbols, and perhaps in parameters and instants, that vanish by premises or definitions, as far as
    /// they bind these symbols, directly or through others; and all symbols that take part.
    fn premises_on(&mut self, of: &[Symbol], with_others: bool) -> (Vec<Term>, Vec<Symbol>) {
        let plain = |given: &&Given| given.law.is_none() && given.property == Property::Zero;
        let mut open: Vec<Term> = self
            .statement
            .givens
            .iter()
            .filter(plain)
            .map(|given| given.term)
            .collect();
        for (symbol, meaning) in self.statement.definitions.clone() {
            let symbol = self.statement.terms.symbol(symbol);
            open.push(self.statement.terms.difference(symbol, meaning));
        }
        let is_other = |symbol: Symbol| {
            let quantity = self.statement.quantity(symbol);
            let is_parameter = matches!(quantity, Some(Quantity::Parameter | Quantity::Index));
            is_parameter || self.statement.instant_of(symbol).is_some()
        };
        let fixed = |symbol: &Symbol| of.contains(symbol) || (with_others && is_other(*symbol));
        open.retain(|&term| {
            let inside = self.statement.terms.inside(term);
            let is_plain = |inner: Term| match self.statement.terms.node(inner) {
                Node::Symbol(symbol) => fixed(symbol),
                Node::Value(..) => false,
                _ => true,
            };
            // a premise with others is linear: what it allows has no parts, of which one may be thin
            let own = self.statement.symbols_in(term).iter().all(|symbol| of.contains(symbol));
            inside.into_iter().all(is_plain) && (own || self.is_linear(term))
        });
        let (mut premises, mut symbols): (Vec<Term>, BTreeSet<Symbol>) = (Vec::new(), of.iter().copied().collect());
        while let Some(next) = open.iter().position(|&term| {
            self.statement
                .symbols_in(term)
                .iter()
                .any(|symbol| symbols.contains(symbol))
        }) {
            let term = open.remove(next);
            symbols.extend(self.statement.symbols_in(term));
            premises.push(term);
        }
        (premises, symbols.into_iter().collect())
    }

    fn jacobian(&mut self, of: &[Term], by: &[Symbol]) -> Vec<Vec<Term>> {
        let rows = of.iter().map(|&term| {
            let row = by.iter().map(|&symbol| self.statement.derivative(term, symbol));
            row.collect()
        });
        rows.collect()
    }

    /// The rank of a matrix at the point, where its entries are rational there.
    fn rank(&mut self, matrix: Vec<Vec<Term>>) -> Outcome<usize> {
        let mut rows: Vec<Vec<Rational>> = Vec::new();
        for row in matrix {
            let mut values = Vec::new();
            for term in row {
                let value = self.value(term)?;
                let quotient = self.numerator(value)?;
                match quotient.numerator.as_constant() {
                    Some(value) if value.is_zero() || quotient.divisors.is_empty() => values.push(value),
                    _ => return refused("a derivative of a generic symbol is not rational"),
                }
            }
            rows.push(values);
        }
        let (mut rank, columns) = (0, rows.first().map_or(0, Vec::len));
        for column in 0..columns {
            let Some(pivot) = (rank..rows.len()).find(|&row| !rows[row][column].is_zero()) else {
                continue;
            };
            rows.swap(rank, pivot);
            let (reduced, below) = rows.split_at_mut(rank + 1);
            let pivot = &reduced[rank];
            for row in below {
                let factor = row[column].clone() / pivot[column].clone();
                for (entry, above) in row.iter_mut().zip(pivot).skip(column) {
                    *entry = entry.clone() - factor.clone() * above.clone();
                }
            }
            rank += 1;
        }
        Ok(rank)
    }

    /// Functions that are named have values at all times, or are what their own law says; none is in the table too.
    fn check_functions(&mut self) -> Outcome<()> {
        for (function, time, term) in &self.witness.functions {
            let same = self.witness.functions.iter().filter(|(other, ..)| other == function);
            if same.count() > 1 {
                return refused("a function is named twice");
            }
            if self.statement.quantity(*time) != Some(Quantity::Fresh) {
                return refused("a function is a term in a symbol of its own");
            }
            let written = self.statement.written_out(*term);
            if written != *term {
                return refused("a function holds an abbreviation");
            }
            let smooth = |inner: &Term| match self.statement.terms.node(*inner) {
                Node::Imaginary => false,
                Node::RealPower(..) | Node::Elementary(Elementary::Arcsin | Elementary::Arccos, _) => {
                    !self.statement.terms.holds(*inner, *time)
                }
                Node::Symbol(symbol) => !self.statement.complex_symbols.contains(symbol),
                Node::Elementary(Elementary::Root(_) | Elementary::Ln, of) => {
                    !self.statement.terms.holds(*of, *time) || self.positive_everywhere(*of, *time)
                }
                Node::Quotient(_, below) => {
                    !self.statement.terms.holds(*below, *time) || self.positive_everywhere(*below, *time)
                }
                _ => true,
            };
            if !self.statement.terms.inside(*term).iter().all(smooth) {
                return refused("a function is not smooth everywhere");
            }
        }
        // what a named function makes all its declared derivatives, whether they are named or not
        let mut implied: BTreeMap<Function, (Symbol, Term)> = BTreeMap::new();
        for (function, time, term) in self.witness.functions.clone() {
            if self.chain(function).iter().any(|f| self.is_tabled(*f)) {
                return refused("a function is named, and it or its derivative is in the table");
            }
            let (mut of, mut slope, mut seen) = (function, term, BTreeSet::new());
            loop {
                if let Some((other, known)) = implied.get(&of).copied() {
                    let by = self.statement.terms.symbol(time);
                    let known = self.statement.terms.substitute(known, other, by);
                    let difference = self.statement.terms.difference(slope, known);
                    if !self.vanishes_identically(difference)? {
                        return refused("a function is not the derivative that it is declared to be");
                    }
                } else {
                    implied.insert(of, (time, slope));
                }
                let Some(next) = self.statement.derivatives.get(&of).copied().filter(|_| seen.insert(of)) else {
                    break;
                };
                (of, slope) = (next, self.statement.derivative(slope, time));
            }
        }
        Ok(())
    }

    /// What the witness writes has a value at the point, and a real one where that is wanted.
    fn check_existence(&mut self) -> Outcome<()> {
        let mut written: Vec<(Term, bool)> = Vec::new();
        for (symbol, value) in self.witness.sample.iter().chain(&self.witness.solved) {
            written.push((*value, !self.statement.complex_symbols.contains(symbol)));
        }
        for (.., time, value) in &self.witness.table {
            written.extend([(*time, true), (*value, true)]);
        }
        for (_, time, term) in &self.witness.functions {
            // what depends on the time is smooth everywhere
            let fixed = |inner: &Term| !self.statement.terms.holds(*inner, *time);
            let inside = self.statement.terms.inside(*term);
            written.extend(inside.into_iter().filter(fixed).map(|inner| (inner, true)));
        }
        for (term, is_real) in written {
            let value = self.value(term)?;
            self.exists(value)?;
            if is_real && self.statement.complex && !self.is_real_number(value)? {
                return refused("a value is not known to be real");
            }
        }
        Ok(())
    }

    /// Whether a number without symbols is real for certain.
    fn is_real_number(&mut self, term: Term) -> Outcome<bool> {
        if self.is_enclosed(term) {
            return Ok(true);
        }
        let quotient = self.numerator(term)?;
        if !quotient.divisors.is_empty() {
            return Ok(false);
        }
        let [real, imaginary] = self.parts(&quotient.numerator);
        Ok(vanishes(&imaginary) && self.is_real(&real))
    }

    /// Whether all generators are real for certain: over complex numbers, those that have an enclosure.
    fn is_real(&self, polynomial: &Polynomial) -> bool {
        !self.statement.complex || polynomial.generators().iter().all(|&term| self.is_enclosed(term))
    }

    fn is_enclosed(&self, term: Term) -> bool {
        type Enclosed = numbers::Interval<numbers::Wide<40>>;
        let odd = |inner: &Term| matches!(self.statement.terms.node(*inner), Node::Elementary(Elementary::Root(index), _) if index % 2 == 1);
        let value: Option<Enclosed> = enclosure::term_value(&self.statement.terms, term, &mut HashMap::new());
        value.is_some() && !(self.statement.complex && self.statement.terms.inside(term).iter().any(odd))
    }

    /// Derivatives of implicit quantities that the statement speaks of are what the equations of these make them.
    fn check_implicit(&mut self) -> Outcome<()> {
        let partials = self.partials();
        let mut determined = BTreeSet::new();
        for implicit in self.statement.implicit.clone() {
            let own = |(of, by): &&(Symbol, Symbol)| implicit.of.contains(of) && implicit.by.contains(by);
            let wanted: BTreeSet<(Symbol, Symbol)> = partials.iter().filter(own).copied().collect();
            if wanted.is_empty() || (implicit.equations.len() < implicit.of.len() && !self.is_free(&implicit)?) {
                continue;
            }
            for (origin, term) in &implicit.equations {
                for &by in &implicit.by {
                    if wanted.iter().any(|(_, wanted)| *wanted == by) {
                        self.check_slope(origin, *term, &implicit, by)?;
                    }
                }
            }
            determined.extend(wanted);
        }
        match determined == partials {
            true => Ok(()),
            false => refused("nothing determines a derivative of an implicit quantity"),
        }
    }

    /// The derivatives of implicit quantities in what is given and claimed: of what, and by what.
    fn partials(&mut self) -> BTreeSet<(Symbol, Symbol)> {
        let goals = self.statement.goal.iter().map(|(_, term)| *term);
        let givens = self.statement.givens.iter().map(|given| given.term);
        let spoken: BTreeSet<Term> = goals.chain(givens).collect();
        let mut partials = BTreeSet::new();
        for term in spoken {
            let term = self.statement.written_out(term);
            for symbol in self.statement.symbols_in(term) {
                if let Some(Quantity::Partial { of, by }) = self.statement.quantity(symbol) {
                    partials.insert((of, by));
                }
            }
        }
        partials
    }

    /// The total derivative of an equation of implicit quantities by one that these depend on vanishes.
    fn check_slope(&mut self, origin: &Origin, term: Term, implicit: &Implicit, by: Symbol) -> Outcome<()> {
        let written = self.statement.written_out(term);
        if !self.statement.is_smooth_along(written) {
            return refused("an equation of implicit quantities is not differentiated");
        }
        let slope = self.statement.along(written, implicit, by);
        let is_between = |symbol: Symbol| match self.statement.quantity(symbol) {
            Some(Quantity::Partial { of, .. }) => !implicit.of.contains(&of),
            _ => false,
        };
        if self.statement.symbols_in(slope).into_iter().any(is_between) {
            return refused("nothing determines the derivative of what is neither implicit nor what that depends on");
        }
        self.vanishes_by(origin.clone(), slope)
    }

    /// A term vanishes as a given of this origin would.
    fn vanishes_by(&mut self, origin: Origin, term: Term) -> Outcome<()> {
        self.holds(&Given {
            origin,
            property: Property::Zero,
            term,
            law: None,
        })
    }

    /// Returns true if implicit quantities of which too few equations are given may have all derivatives that meet these at
    /// the point: the slopes of the equations are independent there (implicit function theorem), and nothing else that is given
    /// speaks of the quantities, but the equations of others that depend on them.
    fn is_free(&mut self, implicit: &Implicit) -> Outcome<bool> {
        let depends_on_them = |other: &&Implicit| {
            other.equations.len() == other.of.len() && other.by.iter().any(|by| implicit.of.contains(by))
        };
        let others = self.statement.implicit.iter().filter(depends_on_them);
        let mut known: Vec<Term> = others
            .flat_map(|other| &other.equations)
            .map(|(_, term)| *term)
            .collect();
        known.extend(implicit.equations.iter().map(|(_, term)| *term));
        for given in self.statement.givens.clone() {
            // what holds at every index or in every interval speaks of these too
            if given
                .law
                .as_ref()
                .is_some_and(|law| law.interval.is_some() || law.every_index)
            {
                return Ok(false);
            }
            let written = self.statement.written_out(given.term);
            let speaks = implicit.of.iter().any(|of| self.statement.terms.holds(written, *of));
            if speaks && given.property == Property::Zero && !known.contains(&given.term) {
                return Ok(false);
            }
        }
        let size = implicit.equations.len();
        let choices = (0_u32..1 << implicit.of.len().min(8)).filter(|choice| choice.count_ones() as usize == size);
        for choice in choices {
            let chosen = implicit
                .of
                .iter()
                .enumerate()
                .filter(|(place, _)| choice >> place & 1 == 1);
            let minor = Implicit {
                of: chosen.map(|(_, of)| *of).collect(),
                ..implicit.clone()
            };
            let given = Given {
                origin: Origin::Witness("derivatives exist"),
                property: Property::Nonzero,
                term: super::implicit::slope_determinant(self.statement, &minor),
                law: None,
            };
            if self.holds(&given).is_ok() {
                return Ok(true);
            }
        }
        Ok(false)
    }

    /// Whether a term is a polynomial in even powers of a symbol with positive coefficients, once the sample is put in.
    fn positive_everywhere(&self, term: Term, time: Symbol) -> bool {
        let mut terms = self.statement.terms.clone();
        let sample = &self.sample;
        let term = terms.rewrite(term, &mut |_, node| match node {
            Node::Symbol(symbol) if *symbol != time => sample.get(symbol).copied(),
            _ => None,
        });
        let Ok(quotient) = Expansion::new(BTreeSet::new(), self.effort).of(&terms, term) else {
            return false;
        };
        let of_time = terms.symbol(time);
        let positive = |(monomial, value): &(super::polynomial::Monomial, dashu_ratio::RBig)| {
            monomial
                .iter()
                .all(|(generator, power)| *generator == of_time && power % 2 == 0)
                && Rational(value.clone()) > Rational::zero()
        };
        let constant = quotient
            .numerator
            .terms()
            .iter()
            .any(|(monomial, _)| monomial.is_empty());
        quotient.divisors.is_empty() && constant && quotient.numerator.terms().iter().all(positive)
    }

    /// The facts of the certificate that comes along, of terms without symbols.
    fn follow_certificate(&mut self) -> Outcome<()> {
        let mut bare = Statement {
            givens: Vec::new(),
            goal: Vec::new(),
            implicit: Vec::new(),
            ..self.statement.clone()
        };
        let mut checker = Checker::new(&mut bare, &self.witness.certificate, self.effort);
        checker.follow(&self.witness.certificate.steps)?;
        // what generic symbols exclude is not asked of the point here
        if !checker.excluded().is_empty() {
            return refused("a witness takes nothing as not 0");
        }
        let zeros = checker.facts.iter().filter(|fact| fact.property == Property::Zero);
        self.zeros = zeros.map(|fact| fact.polynomial.clone()).collect();
        self.statement.terms = bare.terms;
        Ok(())
    }

    /// A term with the solved symbols, the functions and the table put in. Values at the `running` time stay.
    fn translate(&mut self, term: Term, running: Option<Symbol>) -> Outcome<Term> {
        self.translated(term, running, MOST_SUBSTITUTIONS)
    }

    fn translated(&mut self, term: Term, running: Option<Symbol>, left: usize) -> Outcome<Term> {
        if left == 0 {
            return refused("values are given in terms of each other in a circle");
        }
        let written = self.statement.written_out(term);
        let mut terms = std::mem::take(&mut self.statement.terms);
        let mut failure = None;
        let declared = &self.statement.derivatives;
        let (witness, solved, periods) = (self.witness, &self.solved, &self.periods);
        let result = terms.rewrite(written, &mut |terms, node| match node {
            Node::Symbol(symbol) if running != Some(*symbol) => solved.get(symbol).copied(),
            Node::Value(function, order, at) => {
                let named = named_value(terms, declared, &witness.functions, (*function, *order, *at));
                if named.is_some() {
                    return named;
                }
                if running.is_some_and(|running| terms.holds(*at, running)) {
                    return None;
                }
                let found = lookup(terms, witness, periods, *function, *order, *at);
                if found.is_none() {
                    failure = Some(*function);
                }
                found
            }
            _ => None,
        });
        // a named function may be made of others; the values of those are looked up in turn
        let again = |terms: &super::term::Terms| {
            terms.inside(result).iter().any(|&inner| match terms.node(inner) {
                Node::Value(_, _, at) => !running.is_some_and(|running| terms.holds(*at, running)),
                Node::Symbol(symbol) => running != Some(*symbol) && solved.contains_key(symbol),
                _ => false,
            })
        };
        let more = failure.is_none() && again(&terms) && result != written;
        self.statement.terms = terms;
        match failure {
            Some(function) => {
                let name = self.statement.terms.function_name(function);
                refused(format!("`{name}` has no value at one of its times"))
            }
            None if more => self.translated(result, running, left - 1),
            None => Ok(result),
        }
    }

    /// A translated term with the sample put in; the `running` time stays. Over the reals, powers whose exponents become
    /// integers are such.
    fn sampled(&mut self, term: Term, running: Option<Symbol>) -> Term {
        let (sample, complex) = (&self.sample, self.statement.complex);
        self.statement.terms.rewrite(term, &mut |terms, node| match node {
            Node::Symbol(symbol) if running != Some(*symbol) => sample.get(symbol).copied(),
            Node::RealPower(base, exponent) if !complex => {
                let Node::Number(exponent) = terms.node(*exponent) else {
                    return None;
                };
                let exponent = i32::try_from(exponent.0.clone().into_parts().0)
                    .ok()
                    .filter(|_| *exponent.0.denominator() == dashu_int::UBig::ONE)?;
                // 0^0 is 1 only where the exponent is written as an integer
                let is_nonzero = |base: Term| matches!(terms.node(base), Node::Number(value) if !value.0.is_zero());
                if exponent == 0 && !is_nonzero(*base) {
                    return None;
                }
                let power = terms.add(Node::Power(*base, exponent.checked_abs()?));
                if exponent >= 0 {
                    return Some(power);
                }
                let one = terms.integer(1);
                Some(terms.quotient(one, power))
            }
            _ => None,
        })
    }

    fn numerator(&mut self, term: Term) -> Outcome<Quotient> {
        self.numbers.of(&self.statement.terms, term)
    }

    /// A polynomial with the sign of a quotient.
    fn with_sign_of(&mut self, quotient: Quotient) -> Outcome<Polynomial> {
        let mut product = quotient.numerator;
        for (divisor, power) in &quotient.divisors {
            if power % 2 == 1 {
                product = Expansion::new(BTreeSet::new(), self.effort).times(&product, divisor)?;
            }
        }
        Ok(product)
    }

    /// A rational number that a term without symbols is; none where it is not known to be one.
    fn rational(&mut self, term: Term) -> Outcome<Option<Rational>> {
        let quotient = self.numerator(term)?;
        Ok(quotient
            .numerator
            .as_constant()
            .filter(|_| quotient.divisors.is_empty()))
    }

    fn vanishes_identically(&mut self, term: Term) -> Outcome<bool> {
        Ok(vanishes(&self.identities.of(&self.statement.terms, term)?.numerator))
    }

    /// Whether a term vanishes for all values of generic symbols around the point.
    fn vanishes_nearby(&mut self, term: Term) -> Outcome<bool> {
        let translated = self.translate(term, None)?;
        let (sample, around) = (&self.sample, &self.around);
        let nearby = self.statement.terms.rewrite(translated, &mut |_, node| match node {
            Node::Symbol(symbol) if !around.contains(symbol) => sample.get(symbol).copied(),
            _ => None,
        });
        self.vanishes_identically(nearby)
    }

    /// The sign of a number: of its real and imaginary part; `None` where it is not certain. 0 needs the certificate.
    fn number(&mut self, term: Term) -> Outcome<Option<[i8; 2]>> {
        self.exists(term)?;
        // mostly the number is not 0, which shows before anything is multiplied out
        if !self.statement.complex
            && let Some(sign) = enclosure::term_sign(&self.statement.terms, term)
        {
            return Ok(Some([sign, 0]));
        }
        let quotient = self.numerator(term)?;
        let polynomial = self.with_sign_of(quotient)?;
        let [real, imaginary] = self.parts(&polynomial);
        Ok(match (self.sign(&real), self.sign(&imaginary)) {
            (Some(real), Some(imaginary)) => Some([real, imaginary]),
            // one part that is not 0 is enough to tell that the number is not, if all else but the unit is real
            (Some(sign), None) if sign != 0 && self.is_real(&imaginary) => Some([sign, 2]),
            (None, Some(sign)) if sign != 0 && self.is_real(&real) => Some([2, sign]),
            _ if !self.statement.complex => None,
            _ => enclosure::complex_signs(&self.statement.terms, &polynomial).and_then(|[real, imaginary]| {
                let apart = |sign: Option<i8>| sign.is_some_and(|sign| sign != 0);
                (apart(real) || apart(imaginary)).then_some([real.unwrap_or(2), imaginary.unwrap_or(2)])
            }),
        })
    }

    /// Over the reals no power that a premise or the claim writes is one of 0 whose exponent is not positive.
    fn powers_are_defined(&mut self) -> Outcome<()> {
        if self.statement.complex {
            return Ok(());
        }
        let givens = self.statement.givens.iter().filter(|given| given.law.is_none());
        let written: Vec<Term> = givens.map(|given| given.term).collect();
        let claimed: Vec<Term> = self.statement.goal.iter().map(|(_, term)| *term).collect();
        let beside = self.statement.beside.clone();
        for term in written.into_iter().chain(claimed).chain(beside) {
            let term = self.statement.written_out(term);
            for inner in self.statement.terms.inside(term) {
                if let Node::RealPower(base, exponent) = *self.statement.terms.node(inner)
                    && !self.property(Property::Positive, base)?
                    && !self.property(Property::Positive, exponent)?
                {
                    return refused("a power of 0 whose exponent is not positive");
                }
            }
        }
        Ok(())
    }

    /// A number without symbols has a value.
    fn exists(&mut self, term: Term) -> Outcome<()> {
        let written = self.statement.written_out(term);
        for inner in self.statement.terms.inside(written) {
            // whether a power of 0 has a value hangs on its exponent
            if let Node::RealPower(base, _) = *self.statement.terms.node(inner) {
                self.is_in_domain(Property::Nonzero, base)?;
            }
        }
        for (property, of) in self.statement.domain(term) {
            self.is_in_domain(property, of)?;
        }
        Ok(())
    }

    fn is_in_domain(&mut self, property: Property, of: Term) -> Outcome<()> {
        let of = self.numerator(of)?;
        // inner conditions come first in their own right; a sign takes the divisors along
        let polynomial = match property {
            Property::Nonzero => of.numerator,
            _ => self.with_sign_of(of)?,
        };
        self.in_domain(property, &polynomial)
    }

    fn in_domain(&mut self, property: Property, polynomial: &Polynomial) -> Outcome<()> {
        if property == Property::Nonzero && self.statement.complex {
            let signs = enclosure::complex_signs(&self.statement.terms, polynomial);
            let apart = |sign: Option<i8>| sign.is_some_and(|sign| sign != 0);
            if signs.is_some_and(|signs| signs.into_iter().any(apart)) {
                return Ok(());
            }
        }
        let [real, imaginary] = self.parts(polynomial);
        let all_real = self.is_real(&real) && self.is_real(&imaginary);
        let (real, imaginary) = (self.sign(&real), self.sign(&imaginary));
        let apart = |part: Option<i8>, other: Option<i8>| part.is_some_and(|s| s != 0) && (all_real || other.is_some());
        let fits = match property {
            Property::Nonzero => apart(real, imaginary) || apart(imaginary, real),
            Property::Positive => real == Some(1) && imaginary == Some(0),
            Property::NonNegative => real.is_some_and(|s| s >= 0) && imaginary == Some(0),
            Property::Zero | Property::Integer => false,
        };
        match fits {
            true => Ok(()),
            false => refused("something written is not defined at the point"),
        }
    }

    /// Real and imaginary part, where all generators but the imaginary unit are real.
    fn parts(&mut self, polynomial: &Polynomial) -> [Polynomial; 2] {
        let unit = self.statement.terms.add(Node::Imaginary);
        let mut parts = [Vec::new(), Vec::new()];
        for (monomial, value) in polynomial.terms() {
            let power = monomial
                .iter()
                .find(|(term, _)| *term == unit)
                .map_or(0, |(_, power)| *power);
            let rest = monomial.iter().copied().filter(|(term, _)| *term != unit).collect();
            let value = if power % 4 >= 2 { -value.clone() } else { value.clone() };
            parts[power as usize % 2].push((rest, value));
        }
        parts.map(Polynomial::from_terms)
    }

    fn sign(&self, polynomial: &Polynomial) -> Option<i8> {
        if vanishes(polynomial) || self.zeros.iter().any(|zero| zero.is_multiple_of(polynomial)) {
            return Some(0);
        }
        self.statement.sign_of(polynomial)
    }

    /// Whether a property holds of a term at the point.
    pub fn property(&mut self, property: Property, term: Term) -> Outcome<bool> {
        let value = self.value(term)?;
        let Some([real, imaginary]) = self.number(value)? else {
            return refused("a value is too close to 0 to tell");
        };
        let ordered = matches!(property, Property::Positive | Property::NonNegative);
        if ordered && (real == 2 || imaginary == 2) {
            return refused("a value is not known to be real");
        }
        Ok(match property {
            Property::Zero => [real, imaginary] == [0, 0],
            Property::Nonzero => [real, imaginary] != [0, 0],
            Property::Positive => [real, imaginary] == [1, 0],
            Property::NonNegative => (0..2).contains(&real) && imaginary == 0,
            Property::Integer => match self.rational(value)? {
                Some(value) => is_integer(&value),
                None => return refused("not known to be an integer"),
            },
        })
    }

    fn holds(&mut self, given: &Given) -> Outcome<()> {
        if given.property == Property::Zero && !self.statement.generic.is_empty() {
            // the premises hold for all values of generic symbols nearby, so that nothing thin in them is the cause
            if !self.vanishes_nearby(given.term)? {
                return refused("the premise does not hold identically in the generic symbols");
            }
        }
        if !self.property(given.property, given.term)? {
            return refused("it does not hold at the point");
        }
        if given.property == Property::NonNegative && !self.statement.generic.is_empty() {
            // a bound that is just met at the point must be met nearby too
            if !self.property(Property::Positive, given.term)? && !self.vanishes_nearby(given.term)? {
                return refused("the premise may hold in a thin set of the generic symbols only");
            }
        }
        Ok(())
    }

    /// Whether a property fails at the point and, where there are generic symbols, all around it.
    fn fails_of(&mut self, property: Property, term: Term) -> Outcome<bool> {
        if self.property(property, term)? {
            return Ok(false);
        }
        if self.statement.generic.is_empty() || property == Property::Zero {
            return Ok(true);
        }
        if property != Property::NonNegative && self.vanishes_nearby(term)? {
            return Ok(true);
        }
        let negative = self.statement.terms.negative(term);
        let strictly = matches!(property, Property::Positive | Property::NonNegative)
            && self.property(Property::Positive, negative)?;
        match strictly {
            true => Ok(true),
            false => refused("the claim may fail in a thin set of the generic symbols only"),
        }
    }

    fn law_holds(&mut self, number: usize, given: &Given, law: &Law) -> Outcome<()> {
        if given.property != Property::Zero {
            return refused("a law that is an inequality");
        }
        match (law.time, law.interval, law.every_index) {
            (None, None, true) => self.sequence_holds(number, given),
            (None, ..) => refused("a law without a time"),
            (Some(_), None, true) => refused("a law that runs over times and indices"),
            (Some(time), None, false) => match self.period_of(given.term, time) {
                Some((function, period)) if self.periods.get(&function) == Some(&period) => Ok(()),
                _ => self.vanishes_at_all_times(given.term, time),
            },
            (Some(_), Some(base), _) => {
                for interval in self.intervals() {
                    let running = self.statement.fresh("t");
                    let at = Some(self.statement.terms.symbol(running));
                    let within = Some((running, interval));
                    let Some(instance) = self.statement.instance(number, at, interval - base, within) else {
                        return refused("the law does not extend to an interval of the statement");
                    };
                    self.vanishes_at_all_times(instance.term, running)?;
                }
                Ok(())
            }
        }
    }

    /// Laws of intervals hold before the first instant and after the last one too. There are functions there, from what is
    /// known at that instant, where the laws and their first derivatives hold there, or can be solved for what is not known.
    fn intervals_go_on(&mut self) -> Outcome<()> {
        let laws: Vec<(usize, i32)> = (self.statement.givens.iter().enumerate())
            .filter_map(|(number, given)| Some((number, given.law.as_ref()?.interval?)))
            .collect();
        let intervals = self.intervals();
        let (false, (Some(first), Some(last))) = (laws.is_empty(), (intervals.first(), intervals.last())) else {
            return Ok(());
        };
        for (interval, offset) in [(first - 1, *first), (last + 1, last + 1)] {
            let instants = self.statement.instants.clone();
            // the laws moved on to this interval name its ends by their index
            let time = match self.statement.instant(offset) {
                Some(time) => time,
                None => self.statement.fresh("t"),
            };
            self.statement.instants.insert(offset, time);
            let at = self.statement.terms.symbol(time);
            let rows = self.at_an_end(&laws, interval, at)?;
            let rows = rows
                .into_iter()
                .map(|row| self.without_length(row, interval, offset, at));
            let rows = rows.collect();
            let solved = self.can_be_solved(rows);
            self.statement.instants = instants;
            solved?;
        }
        Ok(())
    }

    /// Laws of an interval and their first derivatives at one of its ends, without those that say the same.
    fn at_an_end(&mut self, laws: &[(usize, i32)], interval: i32, at: Term) -> Outcome<Vec<Term>> {
        let mut rows: Vec<Term> = Vec::new();
        for &(number, base) in laws {
            let running = self.statement.fresh("t");
            let now = Some(self.statement.terms.symbol(running));
            let within = Some((running, interval));
            let Some(instance) = self.statement.instance(number, now, interval - base, within) else {
                continue;
            };
            let mut term = instance.term;
            for _ in 0..=DERIVATIVES_AT_AN_END {
                let there = self.statement.moved(term, Some((running, at)), 0);
                term = self.statement.derivative(term, running);
                let mut is_known = false;
                for known in rows.clone() {
                    let difference = self.statement.terms.difference(there, known);
                    is_known |= self.vanishes_identically(difference)?;
                }
                if !is_known {
                    rows.push(there);
                }
            }
        }
        Ok(rows)
    }

    /// A term at an instant that ends an interval of no length: its other end is the same time, and values of what is
    /// continuous are those of the interval on the other side.
    fn without_length(&mut self, term: Term, interval: i32, offset: i32, at: Term) -> Term {
        let mut term = self.statement.written_out(term);
        if let Some(&start) = self.statement.instants.get(&interval) {
            term = self.statement.terms.substitute(term, start, at);
        }
        let beyond = if interval == offset { offset - 1 } else { offset };
        for (function, time, body) in self.witness.functions.clone() {
            let ends = match self.statement.functions.get(function.0 as usize) {
                Some(FunctionOf::Interval { piecewise, offset }) if *offset == beyond => self.ends(*piecewise),
                _ => continue,
            };
            let mut slope = body;
            for end in ends {
                if let Some([before, after]) = end
                    && before == after
                {
                    let member = self.statement.member(after, offset);
                    let value = self.statement.terms.substitute(slope, time, at);
                    term = self.statement.terms.substitute(term, member, value);
                }
                slope = self.statement.derivative(slope, time);
            }
        }
        term
    }

    /// The sequences of the values of a piecewise function and its derivatives at the ends of intervals.
    fn ends(&self, piecewise: usize) -> Vec<Option<[usize; 2]>> {
        let own = self.statement.piecewise.get(piecewise);
        own.map_or(Vec::new(), |own| own.ends.clone())
    }

    /// Terms that vanish at the point, or can be made to by numbers that it does not give: they are linear in these, with
    /// a matrix of full rank.
    fn can_be_solved(&mut self, rows: Vec<Term>) -> Outcome<()> {
        let mut open: Vec<(Node, Symbol)> = Vec::new();
        let mut equations = Vec::new();
        for row in rows {
            // what no value can break asks for none
            let here = self.sampled(row, None);
            if self.vanishes_identically(row)? && self.exists(here).is_ok() {
                continue;
            }
            let inside = self.statement.terms.inside(row).into_iter();
            let own = inside.map(|inner| self.statement.terms.node(inner).clone());
            let own: Vec<Node> = own.filter(|node| self.is_open(node)).collect();
            if own.is_empty() {
                self.vanishes_by(Origin::Witness("the interval beyond an instant"), row)?;
                continue;
            }
            for node in own {
                if !open.iter().any(|(known, _)| *known == node) {
                    open.push((node, self.statement.fresh("u")));
                }
            }
            equations.push(self.statement.terms.rewrite(row, &mut |terms, node| {
                let known = open.iter().find(|(known, _)| known == node);
                known.map(|(_, symbol)| terms.symbol(*symbol))
            }));
        }
        let unknown: Vec<Symbol> = open.into_iter().map(|(_, symbol)| symbol).collect();
        let matrix = self.jacobian(&equations, &unknown);
        let is_linear = matrix.iter().flatten().all(|&entry| {
            let symbols = self.statement.symbols_in(entry);
            !symbols.iter().any(|symbol| unknown.contains(symbol))
        });
        match is_linear && self.rank(matrix)? == equations.len() {
            true => Ok(()),
            false => refused("the interval beyond an instant cannot be had from what is known there"),
        }
    }

    /// Returns true for a number of a sequence, or a value of a function of an interval, that the point does not give.
    fn is_open(&self, node: &Node) -> bool {
        match node {
            Node::Symbol(symbol) => {
                let is_given = self.solved.contains_key(symbol) || self.sample.contains_key(symbol);
                !is_given && self.statement.number_of(*symbol).is_some()
            }
            Node::Value(function, ..) => {
                let of = self.statement.functions.get(function.0 as usize);
                let is_given = self.witness.functions.iter().any(|(named, ..)| named == function);
                !is_given && matches!(of, Some(FunctionOf::Interval { .. }))
            }
            _ => false,
        }
    }

    fn vanishes_at_all_times(&mut self, term: Term, time: Symbol) -> Outcome<()> {
        let translated = self.translate(term, Some(time))?;
        // what does not run has a value
        for (property, of) in self.statement.domain(translated) {
            if !self.statement.terms.holds(of, time) {
                let of = self.sampled(of, None);
                self.is_in_domain(property, of)?;
            }
        }
        if self.vanishes_identically(translated)? {
            return Ok(());
        }
        if self.statement.generic.is_empty() {
            let sampled = self.sampled(translated, Some(time));
            let quotient = self.numerator(sampled)?;
            if vanishes(&quotient.numerator) || self.zeros.iter().any(|zero| zero.is_multiple_of(&quotient.numerator)) {
                return Ok(());
            }
        }
        refused("the law does not hold at all times")
    }

    /// The intervals between the first and the last instant that the statement speaks of.
    fn intervals(&self) -> Vec<i32> {
        let mut instants = BTreeSet::new();
        for quantity in &self.statement.quantities {
            if let Quantity::Member { offset, .. } = quantity {
                instants.insert(*offset);
            }
        }
        for function in &self.statement.functions {
            if let FunctionOf::Interval { offset, .. } = function {
                instants.extend([*offset, *offset + 1]);
            }
        }
        match (instants.first(), instants.last()) {
            (Some(first), Some(last)) => (*first..*last).collect(),
            _ => Vec::new(),
        }
    }

    /// A recursion that can be solved for its first and its last member goes on in both directions from any values.
    fn sequence_holds(&mut self, number: usize, given: &Given) -> Outcome<()> {
        let (own, symbols) = self.members_in(given.term);
        self.is_alone(number, &own)?;
        let (Some((&low, &first)), Some((&high, &last))) = (symbols.first_key_value(), symbols.last_key_value()) else {
            return refused("a recursion without members of sequences");
        };
        for end in [first, last] {
            let slope = self.statement.derivative(given.term, end);
            let closed = self.property(Property::Nonzero, slope)?;
            if !closed || self.runs(slope) || low == high {
                return refused("a recursion that cannot be solved for its ends");
            }
        }
        let of = |quantity: &Quantity| match quantity {
            Quantity::Member { sequence, offset } if own.contains(sequence) => Some(*offset),
            _ => None,
        };
        let spoken: BTreeSet<i32> = self.statement.quantities.iter().filter_map(of).collect();
        let (Some(&from), Some(&to)) = (spoken.first(), spoken.last()) else {
            return Ok(());
        };
        for shift in (from - low)..=(to - high) {
            let Some(Instance { property, term, .. }) = self.statement.instance(number, None, shift, None) else {
                return refused("the recursion does not extend so far");
            };
            let given = Given {
                property,
                term,
                law: None,
                ..given.clone()
            };
            self.holds(&given)?;
        }
        Ok(())
    }

    /// The sequences of numbers that a term speaks of, and their members by offset.
    fn members_in(&mut self, term: Term) -> (BTreeSet<usize>, BTreeMap<i32, Symbol>) {
        let term = self.statement.written_out(term);
        let (mut sequences, mut members) = (BTreeSet::new(), BTreeMap::new());
        for symbol in self.statement.symbols_in(term) {
            if let Some((sequence, offset)) = self.statement.number_of(symbol) {
                sequences.insert(sequence);
                members.insert(offset, symbol);
            }
        }
        (sequences, members)
    }

    /// A recursion is of one sequence, of which no other recursion, no law of intervals and no declaration says anything.
    fn is_alone(&mut self, number: usize, own: &BTreeSet<usize>) -> Outcome<()> {
        if own.len() != 1 {
            return refused("a recursion of several sequences");
        }
        for (other, given) in self.statement.givens.clone().into_iter().enumerate() {
            if given.law.as_ref().is_some_and(|law| law.interval.is_some()) {
                return refused("a recursion beside laws of intervals");
            }
            let is_recursion = given.law.is_some_and(|law| law.every_index);
            let is_declared = matches!(given.origin, Origin::Declared(_));
            let is_other = other != number && (is_recursion || is_declared);
            if is_other && !self.members_in(given.term).0.is_disjoint(own) {
                return refused("something else is said of a sequence of a recursion, or only at some indices");
            }
        }
        Ok(())
    }

    /// Returns true if a term is another one at another index.
    fn runs(&self, term: Term) -> bool {
        let mut symbols = self.statement.symbols_in(term).into_iter();
        symbols.any(|symbol| {
            let quantity = self.statement.quantity(symbol);
            matches!(quantity, Some(Quantity::Index | Quantity::Member { .. }))
        })
    }

    /// The function and its period, where a law says nothing else.
    fn period_of(&mut self, term: Term, time: Symbol) -> Option<(Function, Term)> {
        let term = self.statement.written_out(term);
        let quotient = Expansion::new(BTreeSet::new(), self.effort)
            .of(&self.statement.terms, term)
            .ok()?;
        let [(a, x), (b, y)] = quotient.numerator.terms() else {
            return None;
        };
        let single = |monomial: &super::polynomial::Monomial| match monomial.as_slice() {
            [(generator, 1)] => match self.statement.terms.node(*generator) {
                Node::Value(function, 0, at) => Some((*function, *at)),
                _ => None,
            },
            _ => None,
        };
        let ((f, u), (g, v)) = (single(a)?, single(b)?);
        if f != g || *x != -y.clone() || !quotient.divisors.is_empty() {
            return None;
        }
        let period = self.statement.terms.difference(u, v);
        for at in [u, v] {
            let slope = self.statement.derivative(at, time);
            let one = self.statement.terms.integer(1);
            let steady = self.statement.terms.difference(slope, one);
            if !self.vanishes_identically(steady).ok()? {
                return None;
            }
        }
        // the running time cancels
        let zero = self.statement.terms.integer(0);
        let period = self.statement.terms.substitute(period, time, zero);
        Some((f, period))
    }

    /// Times in the table are different, modulo the period of a function that has one: then there is a smooth function
    /// with these values (Hermite interpolation; for periodic ones, trigonometric).
    fn check_table(&mut self) -> Outcome<()> {
        for (function, ..) in &self.witness.table {
            let has_derivative = |own: &Function| self.statement.derivatives.contains_key(own);
            if self.derives(*function).iter().all(has_derivative) {
                return refused("a function that is a derivative of its own has only single values");
            }
        }
        for (f, ..) in &self.witness.table {
            for (g, ..) in &self.witness.table {
                let linear = self.derives(*f).contains(g) || self.derives(*g).contains(f);
                if self.chain(*f).contains(g) && !linear {
                    return refused("two functions with the same derivative have only single values");
                }
            }
        }
        self.check_periods()?;
        self.check_table_apart()
    }

    /// Checks that the laws of functions with single values are periods, one for each of them.
    fn check_periods(&mut self) -> Outcome<()> {
        let mut laws: Vec<(Function, Term)> = Vec::new();
        for given in self.statement.givens.clone() {
            let Some(Law {
                time: Some(time),
                interval: None,
                ..
            }) = given.law
            else {
                continue;
            };
            let term = self.statement.written_out(given.term);
            let tabled =
                self.statement
                    .terms
                    .inside(term)
                    .into_iter()
                    .any(|inner| match self.statement.terms.node(inner) {
                        Node::Value(function, ..) => self.chain(*function).iter().any(|f| self.is_tabled(*f)),
                        _ => false,
                    });
            if !tabled {
                continue;
            }
            match self.period_of(given.term, time) {
                Some(law) => laws.push(law),
                None => {
                    return refused(format!(
                        "({}) binds a function that has only single values",
                        given.origin
                    ));
                }
            }
        }
        for (function, period) in laws {
            let translated = self.translate(period, None)?;
            if !self.property(Property::Nonzero, period)? {
                return refused("a period is 0");
            }
            // a derivative has the period of its function
            for function in self.derives(function) {
                let known = *self.periods.entry(function).or_insert(period);
                let known = self.translate(known, None)?;
                let [sum, difference] = [
                    self.statement.terms.sum(vec![known, translated]),
                    self.statement.terms.difference(known, translated),
                ];
                if !self.vanishes_identically(sum)? && !self.vanishes_identically(difference)? {
                    return refused("a function has two periods");
                }
            }
        }
        Ok(())
    }

    /// Checks that the times of single values are different, also from the ends of intervals, where the values are members
    /// of sequences.
    fn check_table_apart(&mut self) -> Outcome<()> {
        let table = &self.witness.table;
        for (n, (f, order, a, _)) in table.iter().enumerate() {
            for (g, other, b, _) in table.iter().skip(n + 1) {
                if !self.chain(*f).contains(g) || (a == b && (f, order) != (g, other)) {
                    continue;
                }
                self.check_apart(*f, *a, *b)?;
            }
        }
        for (function, _, time, _) in table {
            let Some(FunctionOf::Interval { offset, .. }) = self.statement.functions.get(function.0 as usize) else {
                continue;
            };
            let ends = [*offset, *offset + 1].map(|offset| self.statement.instants.get(&offset).copied());
            for end in ends.into_iter().flatten() {
                let end = self.statement.terms.symbol(end);
                self.check_apart(*function, *time, end)?;
            }
        }
        Ok(())
    }

    /// A function with all its declared derivatives.
    fn derives(&self, function: Function) -> BTreeSet<Function> {
        let (mut of, mut derived) = (Some(function), BTreeSet::new());
        while let Some(function) = of.filter(|function| derived.insert(*function)) {
            of = self.statement.derivatives.get(&function).copied();
        }
        derived
    }

    fn is_tabled(&self, function: Function) -> bool {
        self.witness.table.iter().any(|(f, ..)| *f == function)
    }

    /// A function with all that it is a derivative of and all its derivatives.
    fn chain(&self, function: Function) -> BTreeSet<Function> {
        let mut chain = BTreeSet::from([function]);
        loop {
            let size = chain.len();
            for (&f, &g) in &self.statement.derivatives {
                if chain.contains(&f) || chain.contains(&g) {
                    chain.extend([f, g]);
                }
            }
            if chain.len() == size {
                return chain;
            }
        }
    }

    fn check_apart(&mut self, function: Function, a: Term, b: Term) -> Outcome<()> {
        let apart = self.statement.terms.difference(a, b);
        let apart = self.value(apart)?;
        if self.number(apart)?.is_none_or(|signs| signs == [0, 0]) {
            return refused("two times of the table may be the same");
        }
        let chain = self.chain(function);
        let mut periods = self.periods.iter().filter(|(f, _)| chain.contains(f));
        if let Some((_, &period)) = periods.next() {
            let period = self.value(period)?;
            let turns = self.statement.terms.quotient(apart, period);
            if self.rational(turns)?.is_none_or(|turns| is_integer(&turns)) {
                return refused("two times of the table may be the same but for whole periods");
            }
        }
        Ok(())
    }

    /// A function that is named has the members of sequences as its values at the two ends of its interval.
    fn check_ends(&mut self) -> Outcome<()> {
        for (function, time, term) in self.witness.functions.clone() {
            let Some(FunctionOf::Interval { piecewise, offset }) = self.statement.functions.get(function.0 as usize)
            else {
                continue;
            };
            let (mut slope, offsets) = (term, [*offset, *offset + 1]);
            for end in self.ends(*piecewise) {
                for (sequence, offset) in end.into_iter().flatten().zip(offsets) {
                    let Some(member) = self.statement.known(Quantity::Member { sequence, offset }) else {
                        continue;
                    };
                    let Some(&end) = self.statement.instants.get(&offset) else {
                        return refused("a value at the end of an interval, at no time");
                    };
                    let (end, member) = (self.statement.terms.symbol(end), self.statement.terms.symbol(member));
                    let value = self.statement.terms.substitute(slope, time, end);
                    let difference = self.statement.terms.difference(value, member);
                    self.vanishes_by(Origin::Witness("the ends of an interval"), difference)?;
                }
                slope = self.statement.derivative(slope, time);
            }
        }
        Ok(())
    }

    /// Whether one of the goals fails at the point.
    pub fn fails(&mut self) -> Outcome<bool> {
        for (property, term) in self.statement.goal.clone() {
            for (condition, of) in self.statement.domain(term) {
                if self.fails_of(condition, of)? {
                    // a solution that is not defined is none
                    return Ok(true);
                }
            }
            if self.fails_of(property, term)? {
                return Ok(true);
            }
        }
        Ok(false)
    }
}

/// The value in the table at a time that is identically the one sought, but for whole periods.
fn lookup(
    terms: &mut super::term::Terms,
    witness: &Witness,
    periods: &BTreeMap<Function, Term>,
    function: Function,
    order: u32,
    at: Term,
) -> Option<Term> {
    let mut expansion = Expansion::new(BTreeSet::new(), 100_000);
    let own = || witness.table.iter().filter(|(f, n, ..)| (*f, *n) == (function, order));
    let solved: HashMap<Symbol, Term> = witness.solved.iter().copied().collect();
    let period = periods.get(&function).map(|&period| {
        terms.rewrite(period, &mut |_, node| match node {
            Node::Symbol(symbol) => solved.get(symbol).copied(),
            _ => None,
        })
    });
    for (_, _, time, value) in own() {
        let apart = terms.difference(at, *time);
        if vanishes(&expansion.of(terms, apart).ok()?.numerator) {
            return Some(*value);
        }
    }
    for (_, _, time, value) in own() {
        for turns in (-6..=6).filter(|turns| *turns != 0) {
            let factor = terms.integer(turns);
            let moved = terms.product(vec![factor, period?]);
            let time = terms.sum(vec![*time, moved]);
            let apart = terms.difference(at, time);
            if vanishes(&expansion.of(terms, apart).ok()?.numerator) {
                return Some(*value);
            }
        }
    }
    None
}

fn is_integer(value: &Rational) -> bool {
    *value.0.denominator() == dashu_int::UBig::ONE
}
