//! Claims with matrices, derivatives, integrals, sums, products, cases, and with conjugates and moduli of complex numbers,
//! reduced to claims about numbers: goals, of which all must hold for the claim to, and goals of which none may fail.
//!
//! What is done here is trusted: each reduction is by definition of the operation, or by a rule that it names. The rules are
//! recorded in the statements that they rewrite, and so in each goal that comes of them.

mod bound;
mod bounds;
mod build;
mod cases;
mod complex;
mod conditions;
mod defined;
mod derivative;
mod divisors;
mod endless;
mod evaluate;
mod factorial;
mod finite;
mod floor;
mod gaussian;
mod germ;
mod induction;
mod inequality;
mod infinite;
mod instances;
mod integers;
mod integral;
mod known;
mod law;
mod leibniz;
mod limit;
mod matrix;
mod moments;
mod prepared;
mod ranges;
mod recurrence;
mod relations;
mod riemann;
mod roots;
mod rule;
mod running;
mod sequences;
mod series;
mod sign_cases;
mod supplied;
mod table;
mod tails;
mod telescope;
mod thin;
mod unbounded;

use super::definition::{Local, inlined};
use super::elaborate;
use super::premise::Statements;
pub(crate) use build::infinity;
pub use conditions::{Conditional, Provided, under_conditions};
pub use divisors::divisors;
pub use inequality::alternatives as other_ways;
pub use infinite::{Multiple, Proposal};
pub use known::{KnownIntegral, Matched, known_integrals};
pub use rule::{Rule, Rules};
pub use sign_cases::{number_in, of_nothing, sign_cases};
pub use table::Row;
pub use tails::{SeriesTest, Test};
pub use thin::{thin_domains, values};

use numbers::Rational;
use std::collections::BTreeSet;
use texmath::{Condition, Equation, Map, Name, Operation, Symbols, Tree, any, names_in, put_in};

/// The most primes of a name that stands for a number in a proof.
const MOST_PRIMES: u8 = 9;

/// Searches for what reductions need, of which nothing is trusted: what they find is shown to be right.
pub trait Proposals {
    /// Returns an antiderivative of a tree by a letter.
    fn antiderivative(&self, _of: &Tree, _by: &Name, _symbols: &Symbols) -> Option<Tree> {
        None
    }

    /// Returns a factor without the letter and a function whose derivative by the letter is a tree plus the factor times another.
    fn reduction_formula(&self, _of: &Tree, _other: &Tree, _by: &Name, _symbols: &Symbols) -> Option<[Tree; 2]> {
        None
    }

    /// Returns numbers between two others, in ascending order, at which a tree in one letter is 0.
    fn zeros(&self, _of: &Tree, _by: &Name, _between: [&Tree; 2]) -> Vec<Tree> {
        Vec::new()
    }

    /// Returns a definite integral as a multiple of one of known value.
    fn known_integral(&self, _of: &Tree, _by: &Name, _limits: [&Tree; 2]) -> Option<Matched> {
        None
    }

    /// Returns a function of an index whose differences are the terms of a sum.
    fn telescoping(&self, _term: &Tree, _index: &Name, _symbols: &Symbols) -> Option<Tree> {
        None
    }

    /// Returns a test of the convergence of a sum to infinity, with bounds of it; its index runs from 0 on.
    fn series_test(&self, _term: &Tree, _index: &Name, _symbols: &Symbols) -> Option<SeriesTest> {
        None
    }

    /// Returns the terms of a sum to infinity as those of known sums and differences; its index runs from 0 on.
    fn summation(&self, _term: &Tree, _index: &Name, _symbols: &Symbols) -> Option<Proposal> {
        None
    }
}

/// No search at all.
struct NoProposals;

impl Proposals for NoProposals {}

/// A claim without operations.
#[derive(Clone, Debug)]
pub struct Goal {
    pub statements: Statements,
    pub symbols: Symbols,
    /// What it is of the claim: the case, the value of an index, a step; empty where it is the claim itself.
    pub part: String,
    /// The numbers that stand for letters of the claim.
    pub values: Vec<(Name, Rational)>,
    /// True for a case that nothing may lie in.
    pub may_be_empty: bool,
}

/// What a claim comes to.
#[derive(Clone, Debug, Default)]
pub struct Reduced {
    /// What must hold for the others to bear on the claim.
    pub lemmas: Vec<Goal>,
    /// The claim holds where all of these do; none where no way to prove it is known.
    pub sufficient: Vec<Goal>,
    /// Whether it fails where one of these does.
    pub is_equivalent: bool,
    /// It fails where one of these others does.
    pub necessary: Vec<Goal>,
    /// Conditions, shown by lemmas, without which an integral has no value.
    pub converging: Vec<Equation>,
    /// Goals for where a factor of all terms of a sum is 0, so that it has a value without these conditions.
    pub where_zero: Vec<Goal>,
    /// Why nothing is sufficient.
    pub reason: String,
}

impl Reduced {
    /// The claim as its own only goal.
    pub fn itself(goal: Goal) -> Self {
        Self {
            sufficient: vec![goal],
            is_equivalent: true,
            ..Self::default()
        }
    }

    /// The same once other claims are shown.
    fn after(mut self, lemmas: Vec<Goal>) -> Self {
        self.lemmas.extend(lemmas);
        self
    }
}

impl Goal {
    fn of(statements: &Statements, symbols: &Symbols, part: String) -> Self {
        Self {
            statements: statements.clone().with_overview(symbols),
            symbols: symbols.clone(),
            part,
            values: Vec::new(),
            may_be_empty: false,
        }
    }

    /// The goal of a claim at numbers for letters of it.
    fn at(mut self, pairs: &[(&Name, Rational)]) -> Self {
        self.values = pairs
            .iter()
            .map(|(name, value)| ((*name).clone(), value.clone()))
            .collect();
        self
    }

    /// Leaves out the premises and conditions that hold an operation: what is shown without them holds with them.
    fn rest_on_numbers(&mut self) {
        let Self {
            statements, symbols, ..
        } = self;
        let is_plain = |tree: &Tree| !has_operation(tree, symbols);
        let of_numbers = |equation: &Equation| is_plain(&equation.left) && is_plain(&equation.right);
        statements.premises.retain(|premise| of_numbers(&premise.equation));
        statements
            .assume
            .retain(|condition| condition.sides().into_iter().all(is_plain));
    }
}

/// Whether a tree holds an operation, or a power that is a transpose.
fn has_operation(tree: &Tree, symbols: &Symbols) -> bool {
    any(tree, &mut |node| match node {
        Tree::Operation(..) => true,
        Tree::RealPower(_, exponent, _) => symbols.transposes(exponent),
        node => factorial::is_one(node) || cases::is_sign(node) || floor::is_one(node),
    })
}

/// All trees of the statements, definitions too.
fn trees(statements: &Statements) -> Vec<&Tree> {
    let claims = statements.claims.iter().flat_map(|claim| [&claim.left, &claim.right]);
    let premises = statements.premises.iter().flat_map(|premise| {
        let own = [&premise.equation.left, &premise.equation.right];
        let locals = premise.locals.iter().map(|local| &local.tree);
        own.into_iter()
            .chain(locals)
            .chain(premise.assume.iter().flat_map(Condition::sides))
    });
    let locals = statements.locals.iter().map(|local| &local.tree);
    let assume = statements.assume.iter().flat_map(Condition::sides);
    claims.chain(premises).chain(locals).chain(assume).collect()
}

/// What a claim comes to; `None` where it is about numbers as it stands.
///
/// # Errors
/// Why an operation has no meaning here, or is not reduced.
pub fn reduced(
    statements: &Statements,
    symbols: &Symbols,
    proposals: &dyn Proposals,
) -> Result<Option<Reduced>, String> {
    if !complex::takes_part(statements, symbols) {
        return Ok(without_operations(statements, symbols, proposals)?.map(|mut reduced| {
            reduced.lemmas.iter_mut().for_each(Goal::rest_on_numbers);
            reduced
        }));
    }
    let written = written_out(statements, symbols)?;
    complex::refuse_inside(&written, symbols)?;
    let reduced = match without_operations(&written, symbols, proposals)? {
        Some(reduced) => reduced,
        None => Reduced::itself(Goal::of(&written, symbols, String::new())),
    };
    complex::as_real(reduced, symbols).map(Some)
}

/// What a claim with operations comes to, of real or of complex numbers.
fn without_operations(
    statements: &Statements,
    symbols: &Symbols,
    proposals: &dyn Proposals,
) -> Result<Option<Reduced>, String> {
    let setting = || sequences::Setting::of(statements, symbols).ok();
    if sequences::is_spoken_of(statements, symbols) && setting().is_some_and(|own| own.has_multiples(statements)) {
        return of_sequences(&written_out(statements, symbols)?, symbols).map(Some);
    }
    if !trees(statements).into_iter().any(|tree| has_operation(tree, symbols)) {
        return Ok(None);
    }
    let (written, symbols) = bound::apart(&unbounded::finite(&written_out(statements, symbols)?), symbols);
    let symbols = &symbols;
    if let Some((rest, search, lemmas)) = supplied::supplied(&written, symbols, proposals) {
        return Ok(Some(or_itself(&rest, symbols, &search)?.after(lemmas)));
    }
    if let Some((rest, extended, lemmas)) = floor::as_integers(&written, symbols)? {
        return Ok(Some(or_itself(&rest, &extended, proposals)?.after(lemmas)));
    }
    if let Some(summed) = infinite::summed(&written, symbols, proposals)? {
        return of_sums(summed, proposals).map(Some);
    }
    let (statements, lemmas) = with_values(&written, symbols, proposals)?;
    Ok(Some(in_each_case(&statements, symbols, proposals)?.after(lemmas)))
}

/// Reduces a claim; one about numbers comes to itself.
fn or_itself(statements: &Statements, symbols: &Symbols, proposals: &dyn Proposals) -> Result<Reduced, String> {
    let reduced = without_operations(statements, symbols, proposals)?;
    Ok(reduced.unwrap_or_else(|| Reduced::itself(Goal::of(statements, symbols, String::new()))))
}

/// Reduces a claim whose sums to infinity have been replaced.
fn of_sums(summed: infinite::Summed, proposals: &dyn Proposals) -> Result<Reduced, String> {
    let symbols = &summed.symbols;
    let mut reduced = or_itself(&summed.statements, symbols, proposals)?;
    if summed.is_bounded {
        // it may hold for the value of the sum, and fail for another number between its bounds
        reduced.is_equivalent = false;
        reduced.necessary.clear();
    }
    reduced.converging.extend(summed.converging);
    if let Some(there) = summed.where_zero {
        let there = or_itself(&there, symbols, proposals)?;
        if !there.is_equivalent || !there.lemmas.is_empty() {
            return Err("a sum whose terms may all be 0".to_owned());
        }
        reduced.where_zero = there.sufficient;
    }
    Ok(reduced.after(summed.lemmas))
}

/// The statements with what has a closed form written so, and what must hold for that: sums of symbolic length, roots of symbolic
/// index, signs, functions that are given, derivatives of integrals, Riemann sums and limits.
fn with_values(
    written: &Statements,
    symbols: &Symbols,
    proposals: &dyn Proposals,
) -> Result<(Statements, Vec<Goal>), String> {
    let written = induction::with_lengths(written, symbols);
    let (written, closed) = match finite::closed(&written, symbols, proposals) {
        Some(closed) => (closed.statements, closed.lemmas),
        None => (written, Vec::new()),
    };
    let (written, mut lemmas) = roots::as_powers(&written, symbols)?;
    lemmas.extend(closed);
    let laws = law::Laws {
        statements: &written,
        symbols,
    };
    let mut statements = rewritten(&written, Rule::SignCases, &cases::signs);
    statements = rewritten(&statements, Rule::FunctionFormulas, &|tree| laws.in_integrals(tree));
    let all = trees(&statements);
    if all.iter().any(|tree| binds_bare_function(tree, symbols)) {
        let running = symbols.running().cloned().unwrap_or_default();
        return Err(format!(
            "a function without its argument where `{running}` is bound: write it"
        ));
    }
    if integral::is_indefinite(&statements) && all.into_iter().any(cases::stands_in) {
        return Err("an antiderivative by cases".to_owned());
    }
    let differentiated;
    (statements, differentiated) = leibniz::differentiated(&statements, symbols)?;
    lemmas.extend(differentiated);
    if let Some((integrals, needed)) = riemann::integrated(&statements, symbols) {
        statements = integrals;
        lemmas.extend(needed);
    }
    if limit::stands_in(&statements) {
        let needed;
        (statements, needed) = limit::evaluated(&statements, symbols)?;
        lemmas.extend(needed);
    }
    Ok((statements, lemmas))
}

/// Reduces a claim in each of its cases.
fn in_each_case(statements: &Statements, symbols: &Symbols, proposals: &dyn Proposals) -> Result<Reduced, String> {
    let mut goals = Vec::new();
    let split = cases::split(statements, symbols)?;
    for (part, statements) in split.choices {
        let by_numbers = evaluate::evaluated(&statements, symbols);
        match by_numbers {
            Ok(evaluated) => goals.push(Goal::of(&evaluated, symbols, part)),
            Err(_) if integral::is_indefinite(&statements) => {
                let differentiated = integral::differentiated(&statements, symbols)?;
                let evaluated = evaluate::evaluated(&differentiated, symbols)?;
                goals.push(Goal::of(&evaluated, symbols, part));
            }
            Err(reason) if part.is_empty() => {
                return Ok(over_an_index(&statements, symbols, proposals, reason)?.after(split.lemmas));
            }
            Err(reason) => return Err(reason),
        }
    }
    Ok(Reduced {
        lemmas: split.lemmas,
        sufficient: goals,
        is_equivalent: true,
        ..Reduced::default()
    })
}

/// What a claim without operations comes to once it is not decided as it stands: the induction along a sequence, the signs
/// of what stands between bars, and numbers for its integers. `None` where it has none of these.
pub fn reduced_by_cases(statements: &Statements, symbols: &Symbols) -> Option<Reduced> {
    let written = written_out(statements, symbols).ok()?;
    if let Some(reduced) = along_a_sequence(statements, symbols) {
        return Some(reduced);
    }
    let necessary = instances::of(&written, symbols);
    let is_real = !trees(&written).into_iter().any(|tree| symbols.may_be_complex(tree));
    let may_be_split = is_real && (1..=cases::MOST_BARS).contains(&cases::bars(&written));
    let with_cases = may_be_split.then(|| {
        rewritten(
            &cases::between_bounds(&written),
            Rule::ModulusCases,
            &cases::absolute_values,
        )
    });
    let split = with_cases.and_then(|with_cases| cases::split(&with_cases, symbols).ok());
    let (choices, lemmas) = split.map_or_else(Default::default, |split| (split.choices, split.lemmas));
    let goal = |(part, own): (String, Statements)| Goal::of(&own, symbols, part);
    let sufficient: Vec<Goal> = choices.into_iter().map(goal).collect();
    let is_any = !(necessary.is_empty() && sufficient.is_empty());
    is_any.then_some(Reduced {
        lemmas,
        is_equivalent: !sufficient.is_empty(),
        sufficient,
        necessary,
        ..Reduced::default()
    })
}

/// Reduces inequalities without sums by induction over one of their integers; None where no integer has a first value.
pub fn by_induction(statements: &Statements, symbols: &Symbols) -> Option<Reduced> {
    let written = written_out(statements, symbols).ok()?;
    let goals = induction::of_inequalities(&written.by(Rule::InequalityInduction), symbols)?;
    Some(Reduced {
        sufficient: goals,
        ..Reduced::default()
    })
}

/// What a claim without operations about members of a sequence comes to, by the recurrence that gives it.
pub fn along_a_sequence(statements: &Statements, symbols: &Symbols) -> Option<Reduced> {
    let written = written_out(statements, symbols).ok()?;
    if !sequences::is_spoken_of(&written, symbols) {
        return None;
    }
    let reduced = of_sequences(&written, symbols);
    Some(reduced.unwrap_or_else(|reason| Reduced {
        reason,
        ..Reduced::default()
    }))
}

/// Reduces a claim about members of sequences: by the recurrence that gives one, or by the premises at each index.
fn of_sequences(statements: &Statements, symbols: &Symbols) -> Result<Reduced, String> {
    let setting = sequences::Setting::of(statements, symbols)?;
    recurrence::reduced(statements, &setting).or_else(|why| running::reduced(statements, &setting).map_err(|_| why))
}

/// What a claim with definite integrals, or with sums and products of symbolic length, comes to.
fn over_an_index(
    statements: &Statements,
    symbols: &Symbols,
    proposals: &dyn Proposals,
    reason: String,
) -> Result<Reduced, String> {
    let integrated = integral::integrated(statements, symbols, proposals);
    if let Ok(Some(found)) = integrated {
        return of_integrated(found, symbols);
    }
    let refuted = unbounded::refuted_by_value(statements);
    if integral::are_numbers(&refuted, symbols) {
        let goal = Goal::of(&refuted, symbols, String::new());
        // one that is not shown to have a value is not decided
        if elaborate::questions(&goal.statements, &goal.symbols).is_ok() {
            return Ok(Reduced::itself(goal));
        }
    }
    integrated?;
    if sequences::is_spoken_of(statements, symbols) {
        return of_sequences(statements, symbols);
    }
    let mut necessary = instances::of(statements, symbols);
    necessary.extend(instances::of_integrals(statements, symbols));
    let (mut induction, why) = match induction::goals(statements, symbols, proposals) {
        Ok(goals) => (goals, String::new()),
        Err(why) => (induction::Induction::default(), why),
    };
    if necessary.is_empty() {
        necessary.append(&mut induction.necessary);
    } else {
        // these show something without the lemmas
        induction.sufficient.append(&mut induction.lemmas);
    }
    if necessary.is_empty() && induction.sufficient.is_empty() {
        let found = instances::with_integrals(statements, symbols, proposals);
        return found
            .map(|found| Reduced {
                reason: reason.clone(),
                ..found
            })
            .ok_or(reason);
    }
    Ok(Reduced {
        lemmas: induction.lemmas,
        sufficient: induction.sufficient,
        necessary,
        reason: why,
        ..Reduced::default()
    })
}

/// Reduces a claim whose integrals have been replaced by values. Factorials of letters are positive quantities with a known
/// recurrence, which is enough to prove the claim; small numbers refute it.
fn of_integrated(found: integral::Integrated, symbols: &Symbols) -> Result<Reduced, String> {
    let has_factorials = trees(&found.statements).into_iter().any(factorial::stands_in);
    if !has_factorials || evaluate::evaluated(&found.statements, symbols).is_ok() {
        return found.into_goal(symbols);
    }
    Ok(Reduced {
        sufficient: induction::with_factorials(&found.statements, symbols, String::new())?,
        necessary: instances::of(&found.statements, symbols),
        lemmas: found.lemmas,
        converging: found.converging,
        ..Reduced::default()
    })
}

/// The statements with all definitions and abbreviations put in; each definition must have a value.
fn written_out(statements: &Statements, symbols: &Symbols) -> Result<Statements, String> {
    let too_large = || "what is defined is too large once it is put in".to_owned();
    let inline =
        |equation: &Equation, locals: &[Local]| super::definition::inlined_in(equation, locals).ok_or_else(too_large);
    let condition = |condition: &Condition, locals: &[Local]| {
        Ok::<Condition, String>(match condition {
            Condition::Relation(relation) => Condition::Relation(inline(relation, locals)?),
            Condition::Integer(tree) => Condition::Integer(inlined(tree, locals).ok_or_else(too_large)?),
        })
    };
    let mut written = statements.clone();
    let locals = std::mem::take(&mut written.locals);
    for claim in &mut written.claims {
        *claim = inline(claim, &locals)?;
    }
    for assumed in &mut written.assume {
        *assumed = condition(assumed, &locals)?;
    }
    for premise in &mut written.premises {
        let locals = std::mem::take(&mut premise.locals);
        premise.equation = inline(&premise.equation, &locals)?;
        for assumed in &mut premise.assume {
            *assumed = condition(assumed, &locals)?;
        }
    }
    // what nothing speaks of must have a value all the same
    for local in &locals {
        let tree = inlined(&local.tree, &locals).ok_or_else(too_large)?;
        let is_used = trees(statements)
            .into_iter()
            .any(|tree| derivative::mentions(tree, &local.name));
        if !is_used {
            written.claims.push(Equation::between(tree.clone(), tree));
        }
    }
    // numbers are put in for letters, and what moves is followed, within abbreviations too
    written = rewritten(&written, Rule::Definitions, &|tree| {
        put_in(tree, &|name| symbols.meaning(name, &|_| false))
    });
    Ok(match written.has_formulas_of(statements) {
        true => written,
        false => written.by(Rule::Definitions),
    })
}

/// The statements with each formula of claims, premises and assumptions rewritten by a rule, which is recorded where it
/// changes any.
fn rewritten(statements: &Statements, rule: Rule, new: &dyn Fn(&Tree) -> Tree) -> Statements {
    let equation = |equation: &Equation| Equation {
        left: new(&equation.left),
        right: new(&equation.right),
        ..equation.clone()
    };
    let condition = |condition: &Condition| match condition {
        Condition::Relation(relation) => Condition::Relation(equation(relation)),
        Condition::Integer(tree) => Condition::Integer(new(tree)),
    };
    let mut rewritten = statements.clone();
    rewritten.claims = statements.claims.iter().map(equation).collect();
    rewritten.assume = statements.assume.iter().map(condition).collect();
    for premise in &mut rewritten.premises {
        premise.equation = equation(&premise.equation);
        premise.assume = premise.assume.iter().map(condition).collect();
    }
    match rewritten.has_formulas_of(statements) {
        true => rewritten,
        false => rewritten.by(rule),
    }
}

/// Whether a sum, an integral or a limit binds the running symbol of functions that stand in it without their argument.
fn binds_bare_function(tree: &Tree, symbols: &Symbols) -> bool {
    let is_bare = |node: &Tree| match node {
        Tree::Symbol(name, _) => {
            let flies = symbols.is_in_flight(name) && name.subscript.is_empty();
            flies || (symbols.is_function(name) && !symbols.is_parameter(name))
        }
        _ => false,
    };
    any(tree, &mut |node| {
        let Tree::Operation(operation, _) = node else {
            return false;
        };
        let is_over_time = operation.letter().is_some() && operation.letter() == symbols.running();
        let is_derivative = matches!(**operation, Operation::Derivative { order: 1.., .. });
        let parts = operation.parts().into_iter().filter(|(_, is_bound)| *is_bound);
        let mut parts = parts.filter(|_| is_over_time && !is_derivative && !is_antiderivative(operation));
        parts.any(|(part, _)| any(part, &mut |node| is_bare(node)))
    })
}

fn is_antiderivative(operation: &Operation) -> bool {
    matches!(operation, Operation::Integral { limits: None, .. })
}

/// Whether premises, relations or assumed equations say anything of a symbol: then other symbols may depend on it.
fn is_spoken_of(statements: &Statements, symbols: &Symbols, name: &Name) -> bool {
    let speaks = |equation: &Equation| equation.left.has_free(name) || equation.right.has_free(name);
    let mut premises = statements.premises.iter();
    is_tied(statements, symbols, name)
        || premises.any(|premise| speaks(&premise.equation))
        || stands_in_symbols(symbols, name)
}

/// Returns true if a premise speaks of a function and of another one that stands in a value.
fn ties_functions(statements: &Statements, symbols: &Symbols, name: &Name, value: &matrix::Value) -> bool {
    let is_other = |other: &&Name| symbols.is_function(other) && *other != name;
    let mut others: BTreeSet<Name> = BTreeSet::new();
    match value {
        matrix::Value::Number(tree) => names_in(tree, &mut others),
        matrix::Value::Matrix(rows) => rows.iter().flatten().for_each(|entry| names_in(entry, &mut others)),
    }
    let speaks = |equation: &Equation, name: &Name| equation.left.has_free(name) || equation.right.has_free(name);
    let mut premises = statements.premises.iter().map(|premise| &premise.equation);
    premises.any(|premise| {
        let mut others = others.iter().filter(is_other);
        speaks(premise, name)
            && others.any(|other| other.without_dots() != name.without_dots() && speaks(premise, other))
    })
}

/// Whether an assumed equation ties a symbol to others.
fn is_tied(statements: &Statements, symbols: &Symbols, name: &Name) -> bool {
    let speaks = |equation: &Equation| equation.left.has_free(name) || equation.right.has_free(name);
    let is_other = |node: &Tree| match node {
        Tree::Symbol(other, _) => other != name && symbols.is_parameter(other),
        _ => false,
    };
    let mut assumed = statements.assume.iter();
    assumed.any(|condition| match condition {
        Condition::Relation(relation) => {
            let sides = [&relation.left, &relation.right];
            let is_equal = relation.relation == texmath::Relation::Equal;
            is_equal && speaks(relation) && sides.into_iter().any(|side| any(side, &mut |node| is_other(node)))
        }
        Condition::Integer(_) => false,
    })
}

/// Whether relations, periods, derivatives of functions or maps of `[symbols]` speak of a symbol: it is not replaced there.
/// The running time in the derivative of a function is the function's argument, whatever it is.
fn stands_in_symbols(symbols: &Symbols, name: &Name) -> bool {
    let in_equation = |equation: &Equation| equation.left.has_free(name) || equation.right.has_free(name);
    let is_argument = symbols.running() == Some(name);
    let slopes = symbols.functions().filter(|_| !is_argument);
    let slopes = slopes.filter_map(|(_, slope)| slope);
    let mut trees = symbols.periods().map(|(_, period)| period).chain(slopes);
    let in_map = |map: &Map| match map {
        Map::Equations(equations) => equations.iter().any(in_equation),
        Map::Premises { .. } | Map::Product(_) => false,
    };
    symbols.relations.iter().any(in_equation)
        || trees.any(|tree| tree.has_free(name))
        || symbols.maps().any(|(_, map)| in_map(map))
}

/// That a symbol may be differentiated by: it is no integer.
fn is_continuous(statements: &Statements, symbols: &Symbols, name: &Name) -> Result<(), String> {
    let is_integer = integers::integers(statements, symbols).contains(name) || symbols.is_integer(name);
    match is_integer {
        true => Err(format!("`{name}` is an integer: nothing is differentiated by it")),
        false => Ok(()),
    }
}

/// A name that nothing in the statements has, like `like`.
fn fresh(statements: &Statements, symbols: &Symbols, like: &str) -> Name {
    fresh_like(statements, symbols, build::plain(like))
}

fn fresh_like(statements: &Statements, symbols: &Symbols, mut name: Name) -> Name {
    let is_met = |name: &Name| {
        symbols.knows(name)
            || trees(statements)
                .into_iter()
                .any(|tree| derivative::mentions(tree, name))
    };
    // a function is known with any number of primes, but not with another accent
    while is_met(&name) {
        match name.primes < MOST_PRIMES {
            true => name.primes += 1,
            false => {
                name.primes = 0;
                name.accents.push("\\tilde".to_owned());
            }
        }
    }
    name
}
