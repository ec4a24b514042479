//! What the points say of a verdict.

use super::compiler::Unwitnessed;
use super::formula::{Binder, Formula, Op, Work};
use super::gap::Gap;
use super::motion::Flown;
use super::point::{Miss, Point, Style};
use super::space::Slot;
use super::system::{Forcing, System, WORK, WORK_ON_A_GUESS};
use super::tolerance::{
    APART_EXACT, APART_INEXACT, APART_WIDE, COARSE, DOUBTFUL_PROOF, DOUBTFUL_REFUTATION, EQUAL_WIDE, ROUNDED_AWAY,
    STEADY,
};
use super::value::{Complexes, Function, Numbers, Real, Reals, Value};
use claims::{Fault, Sheet, Standing, Statements, Verdict};
use numbers::{Sequence, Wide};
use std::collections::{BTreeMap, BTreeSet};
use texmath::{Equation, Name, Names, Operation, Relation, Symbols, Tree, any, any_side, number_of, read_expression};

/// What numbers say of one claim.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Evidence {
    /// Decimal digits in which the sides agree, at the worst point; nothing where there is no point, or for an
    /// inequality.
    pub digits: Option<f64>,
    /// The same at the median of the points.
    pub median: Option<f64>,
    /// Points at which all premises hold and both sides have a value.
    pub points: usize,
    /// The largest residual of a premise at any of the points, relative to the size of its terms.
    pub residual: Option<f64>,
    /// The worst point: names, values, and the two sides.
    pub worst: String,
    /// What contradicts the verdict.
    pub against: Option<String>,
    /// True if the sides of an undecided claim differ at a point at which all premises hold.
    pub differs: bool,
    /// How the derivatives compare with the maps of the device, where points are of its motion.
    pub flown: Option<Flown>,
    pub notes: Vec<String>,
}

/// Starts for each point wanted; most starts lead to a point.
const MOST_STARTS: usize = 12;
/// Points at which agreement weighs against a refutation: for claims that are analytic, and for those in pieces.
const MANY: usize = 24;
const MANY_PIECES: usize = 60;
/// Operations after which a few points are enough.
const ENOUGH_WORK: u64 = 40_000;
const FEW: usize = 6;
/// Special starts from which a proof is tried.
const PROBES: u64 = 60;
/// Operations for these.
const PROBE_WORK: u64 = 20_000;

/// Witnesses for the claim at `position` of the sheet, at up to `points` points, held against the verdict. Where the
/// points agree with a claim that is refuted or undecided, more are looked at.
///
/// # Errors
/// The [`Fault`] of a claim or premise that makes no sense.
pub fn witness(sheet: &Sheet, position: usize, verdict: Verdict, points: usize) -> Result<Evidence, Fault> {
    witness_near(sheet, position, verdict, points, &[])
}

/// The same, with a start at a point that is known, as `x` and `3/2 \pi`: the counterexample of a refutation or the point of a
/// proof, where no random one lies.
///
/// # Errors
/// As of [`witness`].
pub fn witness_near(
    sheet: &Sheet,
    position: usize,
    verdict: Verdict,
    points: usize,
    known: &[(String, String)],
) -> Result<Evidence, Fault> {
    let named = known.iter();
    let named: Vec<(&str, f64)> = named
        .filter_map(|(name, value)| Some((name.as_str(), printed_value(value)?)))
        .collect();
    let statements = Statements::gather(sheet, position)?;
    let is_guess = sheet
        .entries
        .get(position)
        .is_some_and(|entry| entry.standing != Standing::Said);
    let mut work = if is_guess { WORK_ON_A_GUESS } else { WORK };
    Ok(of_claim(
        &statements,
        &sheet.symbols,
        verdict,
        points,
        &named,
        &mut work,
    ))
}

/// The same for one of many claims that may hold, which share a budget of operations: what this one takes is taken off.
///
/// # Errors
/// As of [`witness`].
pub fn trial(sheet: &Sheet, position: usize, points: usize, budget: &mut u64) -> Result<Evidence, Fault> {
    let statements = Statements::gather(sheet, position)?;
    let share = WORK_ON_A_GUESS.min(*budget);
    let mut left = share;
    let evidence = of_claim(&statements, &sheet.symbols, Verdict::Proved, points, &[], &mut left);
    *budget -= share - left;
    Ok(evidence)
}

/// The value of a number as a counterexample prints it: a rational one, or one times pi.
fn printed_value(printed: &str) -> Option<f64> {
    let (factor, unit) = match printed.trim().strip_suffix(r"\pi") {
        Some(factor) => (factor.trim(), std::f64::consts::PI),
        None => (printed, 1.0),
    };
    let factor = match factor {
        "" => 1.0,
        "-" => -1.0,
        factor => number_of(&read_expression(factor, &Names::default()).ok()?)?.embed::<f64>()?,
    };
    Some(factor * unit)
}

fn of_claim(
    statements: &Statements,
    symbols: &Symbols,
    verdict: Verdict,
    points: usize,
    named: &[(&str, f64)],
    work: &mut u64,
) -> Evidence {
    if has_members_under_two_indices(statements) {
        return without_points("no witness: members of one family under two indices".to_owned());
    }
    let mut system = match System::new(statements, symbols, Forcing::Any) {
        Ok(system) => system,
        Err(reason) => return without_points(no_witness(&reason)),
    };
    system.work = Work::new(*work);
    let over = Witness {
        symbols,
        statements,
        system,
        verdict,
        named,
    };
    let evidence = match over.system.is_complex {
        true => over.evidence::<Complexes>(points),
        false => over.evidence::<Reals>(points),
    };
    *work = over.system.work.left();
    evidence
}

/// Returns true if members of one family stand under two indices of sums, `x_i` and `x_j`: values are chosen for names, and these are
/// two.
fn has_members_under_two_indices(statements: &Statements) -> bool {
    let claims = statements.claims.iter();
    let equations = claims.chain(statements.premises.iter().map(|premise| &premise.equation));
    let locals = statements.locals.iter().map(|local| &local.tree);
    let trees = equations
        .flat_map(|equation| [&equation.left, &equation.right])
        .chain(locals);
    let (mut indices, mut names): (BTreeSet<String>, BTreeSet<Name>) = Default::default();
    for tree in trees {
        any(tree, &mut |node| {
            match node {
                Tree::Operation(operation, _) => {
                    if let Operation::Series { index, .. } = &**operation {
                        indices.insert(index.to_string());
                    }
                }
                Tree::Symbol(name, _) | Tree::Call(name, ..) => {
                    names.insert(name.clone());
                }
                _ => {}
            }
            false
        });
    }
    let members: Vec<&Name> = names.iter().filter(|name| indices.contains(&name.subscript)).collect();
    let are_two =
        |pair: &[&Name]| matches!(pair, [one, other] if one.base == other.base && one.accents == other.accents);
    members.windows(2).any(are_two)
}

fn without_points(note: String) -> Evidence {
    Evidence {
        notes: vec![note],
        ..Evidence::default()
    }
}

fn no_witness(reason: &Unwitnessed) -> String {
    format!("no witness: {reason}")
}

/// A claim with its verdict.
struct Witness<'a> {
    symbols: &'a Symbols,
    statements: &'a Statements,
    system: System,
    verdict: Verdict,
    /// Values of the counterexample, or of the point of the proof, by the names that these have.
    named: &'a [(&'a str, f64)],
}

/// A point with the worst gap of the claim's equations there.
type Asked<V> = (Point<V>, Gap);

/// The points found so far, and why starts led to none.
struct Search<V> {
    found: Vec<Asked<V>>,
    /// Points that a proof may exclude.
    excluded: Vec<Asked<V>>,
    missed: BTreeMap<Miss, usize>,
    undefined: usize,
    starts: usize,
}

impl<V> Search<V> {
    /// Why there is no point.
    fn reason(&self, system: &System, verdict: Verdict) -> String {
        let starts = self.starts;
        // of what is proved the kernel has a point
        let untried = match verdict {
            Verdict::Proved => "not tried at random points",
            _ => "no point",
        };
        if system.work.is_over() {
            return format!("{untried}: the formulas are too large to be evaluated often enough");
        }
        if verdict == Verdict::Proved {
            return format!("{untried}: none of {starts} starts led to one");
        }
        if self.undefined > 0 {
            return format!(
                "no point was found at which the premises hold and both sides have a value: of {} points of the premises none lies where the claim is defined",
                self.undefined
            );
        }
        let most = self
            .missed
            .iter()
            .max_by_key(|(_, count)| **count)
            .map(|(miss, _)| *miss);
        match most {
            Some(Miss::Conditions) => format!("no point was found at which the assumptions hold, from {starts} starts"),
            Some(Miss::Derivatives) => {
                format!("no point was found at which the premises give the derivatives, from {starts} starts")
            }
            _ => format!("no point was found at which the premises hold, from {starts} starts"),
        }
    }
}

impl Witness<'_> {
    fn evidence<N: Numbers>(&self, points: usize) -> Evidence {
        let mut search = Search::<N::Of<f64>> {
            found: Vec::new(),
            excluded: Vec::new(),
            missed: BTreeMap::new(),
            undefined: 0,
            starts: 0,
        };
        self.look::<N>(&mut search, points, 0);
        if search.found.is_empty() {
            self.look_at_point::<N>(&mut search);
        }
        let agrees = |search: &Search<N::Of<f64>>| {
            search.found.iter().all(|(_, gap)| match gap.is_inequality {
                true => !gap.fails,
                // in many digits only what differs there is kept
                false => gap.digits() >= DOUBTFUL_REFUTATION && !gap.is_close,
            })
        };
        if self.verdict != Verdict::Proved && !search.found.is_empty() && agrees(&search) {
            let pieces = self.system.has_pieces();
            let many = if self.fails() && pieces { MANY_PIECES } else { MANY };
            self.look::<N>(&mut search, many, 1);
        }
        let mut is_undefined = false;
        if !search.found.is_empty() && agrees(&search) {
            match self.verdict {
                Verdict::Proved => self.probe::<N>(&mut search),
                Verdict::Refuted | Verdict::Conditional => is_undefined = self.look_at_point::<N>(&mut search),
                _ => {}
            }
            self.look_closer::<N>(&mut search);
        }
        if search.found.is_empty() {
            search.found = std::mem::take(&mut search.excluded);
            if search.found.is_empty() {
                return without_points(search.reason(&self.system, self.verdict));
            }
            let note = "only points were found at which a factor in generic symbols vanishes";
            return Evidence {
                notes: vec![note.to_string()],
                ..self.summary::<N>(&search.found)
            };
        }
        let mut evidence = self.summary::<N>(&search.found);
        match self.verdict {
            Verdict::Proved => self.against_proof::<N>(&search.found, &mut evidence),
            _ if self.fails() && agrees(&search) && is_undefined => {
                let note = "the sides agree where they have a value; at the counterexample one is not seen to have any";
                evidence.notes.push(note.to_string());
            }
            _ if self.fails() && agrees(&search) => self.against_refutation::<N>(&search.found, &mut evidence),
            Verdict::Refuted => {
                if self.holds_for_cosine::<N>() {
                    let note =
                        "true for this forcing: it holds where the unknown function is a cosine alone, cos(pi t + phi)";
                    evidence.notes.push(note.to_string());
                }
            }
            _ if agrees(&search) => {
                evidence
                    .notes
                    .push(format!("holds at {} random points", search.found.len()));
            }
            _ => {
                let confirmed = self.worst_first(&search.found).into_iter().take(3);
                let mut confirmed = confirmed.filter(|(point, _)| self.differs::<N>(point) == Some(true));
                let confirmed = confirmed.next();
                evidence.differs = confirmed.is_some();
                evidence.notes.push(match confirmed {
                    Some((point, gap)) => format!("fails at a random point: {}", show::<N>(&self.system, point, gap)),
                    None => "the points do not tell".to_string(),
                });
            }
        }
        evidence
    }

    /// Looks for points until there are `wanted`.
    fn look<N: Numbers>(&self, search: &mut Search<N::Of<f64>>, wanted: usize, seed: u64) {
        let before = self.system.work.left();
        let has_motion = !self.system.space.courses.is_empty() || self.system.start.is_some();
        for start in 0..wanted * MOST_STARTS {
            let hopeless = start >= 3 * MOST_STARTS && search.found.is_empty() && search.undefined == 0;
            let dear = before - self.system.work.left() > ENOUGH_WORK && search.found.len() >= FEW && seed == 0;
            if search.found.len() >= wanted || hopeless || dear || self.system.work.is_over() {
                break;
            }
            let style = match start % 3 {
                _ if has_motion && start % 6 != 5 => Style::Moderate,
                0 => Style::Moderate,
                1 => Style::Spread,
                _ => Style::Special,
            };
            search.starts += 1;
            let number = (seed + 1).wrapping_mul(1000).wrapping_add(start as u64);
            let point = match self.system.point::<N>(number, style) {
                Ok(point) => point,
                Err(miss) => {
                    *search.missed.entry(miss).or_default() += 1;
                    continue;
                }
            };
            match self.gap::<N>(&point) {
                Some(gap) if self.system.is_excluded::<N>(&point) => search.excluded.push((point, gap)),
                Some(gap) => search.found.push((point, gap)),
                None => search.undefined += 1,
            }
        }
    }

    /// Looks at the point that starts at the values of the counterexample, or of the point of the proof. True if a limit, an
    /// integral or a sum of the claim has no value there that is seen.
    fn look_at_point<N: Numbers>(&self, search: &mut Search<N::Of<f64>>) -> bool {
        let slots = 0..self.system.space.slots.len();
        let value = |slot: usize| {
            let name = self.system.space.show(slot, &self.system.letter)?;
            let (_, value) = self.named.iter().find(|(known, _)| *known == name)?;
            Some((slot, *value))
        };
        let values: BTreeMap<usize, f64> = slots.filter_map(value).collect();
        if values.is_empty() {
            return false;
        }
        let Ok(point) = self.system.point_at::<N>(0, Style::Moderate, &values) else {
            return false;
        };
        let gap = self.gap::<N>(&point);
        let may_diverge = |node: &Tree| match node {
            Tree::Operation(operation, _) => {
                use Operation::{Integral, Limit, Series};
                matches!(**operation, Limit { .. } | Integral { .. } | Series { .. })
            }
            _ => false,
        };
        let mut claims = self.statements.claims.iter();
        let is_undefined = gap.is_none() && claims.any(|claim| any_side(claim, &mut |node| may_diverge(node)));
        if let Some(gap) = gap.filter(|_| !self.system.is_excluded::<N>(&point)) {
            search.found.push((point, gap));
        }
        is_undefined
    }

    /// Looks at the first point in 40 digits, where that costs little: what differs there alone is seen.
    fn look_closer<N: Numbers>(&self, search: &mut Search<N::Of<f64>>) {
        let system = &self.system;
        let is_small = system.space.courses.is_empty() && system.maps.steps.is_empty() && !system.is_inexact();
        let Some((point, known)) = search
            .found
            .first_mut()
            .filter(|(_, gap)| is_small && !gap.is_inequality)
        else {
            return;
        };
        let wide = self.system.widened::<N>(point);
        let gap = wide.and_then(|wide| self.worst_gap::<N, Wide<40>>(&wide.values, &wide.running));
        if let Some(gap) = gap.filter(|gap| gap.relative > self.apart()) {
            *known = gap;
        }
    }

    /// Looks at special points, as long as these cost little: what fails there is added.
    fn probe<N: Numbers>(&self, search: &mut Search<N::Of<f64>>) {
        let before = self.system.work.left();
        for start in 0..PROBES {
            if before - self.system.work.left() > PROBE_WORK {
                return;
            }
            let style = if start % 4 == 3 { Style::Spread } else { Style::Special };
            let Ok(point) = self.system.point::<N>(9000 + start, style) else {
                continue;
            };
            let gap = self
                .gap::<N>(&point)
                .filter(|gap| gap.fails && (gap.is_inequality || gap.digits() < DOUBTFUL_PROOF));
            if let Some(gap) = gap.filter(|_| !self.system.is_excluded::<N>(&point)) {
                search.found.push((point, gap));
            }
        }
    }

    /// The worst gap of the claim's equations at a point; nothing where a side has no value.
    fn gap<N: Numbers>(&self, point: &Point<N::Of<f64>>) -> Option<Gap> {
        self.worst_gap::<N, f64>(&point.values, &point.running)
    }

    fn worst_gap<N: Numbers, T: Real>(&self, values: &[N::Of<T>], running: &N::Of<T>) -> Option<Gap> {
        let program = &self.system.written_program;
        let written = program.run(&self.system.inputs(values, Some(running)));
        let is_undefined = |&output: &usize| written.get(output).is_none_or(|value| value.size().is_nan());
        if program.outputs.iter().any(is_undefined) {
            return None;
        }
        let gaps = self
            .system
            .questions
            .iter()
            .map(|question| self.system.gap::<N, T>(question, values, running));
        let gaps: Option<Vec<Gap>> = gaps.collect();
        gaps?.into_iter().max_by(|a, b| a.badness().total_cmp(&b.badness()))
    }

    /// Whether the claim fails at a point in 40 digits: steadily so while the point is refined.
    fn differs<N: Numbers>(&self, point: &Point<N::Of<f64>>) -> Option<bool> {
        // what is found by steps has few digits: a difference far beyond their error is one all the same
        if self.system.is_inexact()
            && self
                .gap::<N>(point)
                .is_some_and(|gap| gap.fails && gap.relative > COARSE)
        {
            return Some(true);
        }
        let wide = self.system.widened::<N>(point)?;
        if !self.system.allows_closely::<N>(&wide) {
            return None;
        }
        let gap = self.worst_gap::<N, Wide<40>>(&wide.values, &wide.running)?;
        if gap.fails && gap.apart > 0.0 && gap.apart <= ROUNDED_AWAY {
            return None;
        }
        if gap.is_inequality {
            // sides that are too close to tell are equal only where nothing parts them
            let may_round = gap.apart > 0.0 || self.system.rounds() || self.statements.claims.iter().any(is_extreme);
            let is_open = gap.fails && gap.relative <= EQUAL_WIDE && may_round;
            return (!is_open).then_some(gap.fails);
        }
        if gap.relative <= self.apart() {
            return Some(false);
        }
        let finer = self.system.refined::<N>(wide)?;
        let again = self.worst_gap::<N, Wide<40>>(&finer.values, &finer.running)?;
        ((again.apart - gap.apart).abs() <= STEADY * gap.apart).then_some(true)
    }

    /// Whether the claim fails, too, where the generic symbols are a little different: a proof may exclude what is thin in
    /// them.
    fn differs_nearby<N: Numbers>(&self, point: &Point<N::Of<f64>>) -> bool {
        let Some(near) = self.system.nearby::<N>(point) else {
            return false;
        };
        near.is_none_or(|near| {
            self.gap::<N>(&near)
                .is_some_and(|gap| gap.digits() < DOUBTFUL_PROOF || gap.fails)
        })
    }

    /// The relative gap in 40 digits above which sides differ.
    fn apart(&self) -> f64 {
        if self.system.is_inexact() {
            APART_INEXACT
        } else if self.system.rows.is_empty() {
            APART_EXACT
        } else {
            APART_WIDE
        }
    }

    fn worst_first<'b, V>(&self, found: &'b [Asked<V>]) -> Vec<&'b Asked<V>> {
        let mut sorted: Vec<&Asked<V>> = found.iter().collect();
        sorted.sort_by(|(_, a), (_, b)| b.badness().total_cmp(&a.badness()));
        sorted
    }

    /// Digits, the worst point, and how the maps flown compare.
    fn summary<N: Numbers>(&self, found: &[Asked<N::Of<f64>>]) -> Evidence {
        let equal = found.iter().all(|(_, gap)| !gap.is_inequality);
        let mut digits: Vec<f64> = found.iter().map(|(_, gap)| gap.digits()).collect();
        digits.sort_by(f64::total_cmp);
        let residuals = found.iter().map(|(point, _)| self.system.residual::<N>(&point.values));
        let worst = self
            .worst_first(found)
            .first()
            .map(|(point, gap)| show::<N>(&self.system, point, gap));
        let reals =
            |point: &Point<N::Of<f64>>| -> Vec<f64> { point.values.iter().map(|value| value.parts()[0]).collect() };
        let flown = found
            .iter()
            .filter_map(|(point, _)| self.system.flown(&reals(point)))
            .reduce(Flown::and);
        Evidence {
            digits: digits.first().copied().filter(|_| equal),
            median: digits.get(digits.len() / 2).copied().filter(|_| equal),
            points: found.len(),
            residual: residuals.reduce(f64::max),
            worst: worst.unwrap_or_default(),
            against: None,
            differs: false,
            notes: flown.iter().map(ToString::to_string).collect(),
            flown,
        }
    }

    fn against_proof<N: Numbers>(&self, found: &[Asked<N::Of<f64>>], evidence: &mut Evidence) {
        let doubtful = |(_, gap): &&&Asked<N::Of<f64>>| match gap.is_inequality {
            true => gap.fails,
            false => gap.digits() < DOUBTFUL_PROOF || gap.is_close,
        };
        for (point, gap) in self.worst_first(found).iter().filter(doubtful).take(3) {
            let says = match self.system.shaped || !self.differs_nearby::<N>(point) {
                true => None,
                false => self.differs::<N>(point),
            };
            match says {
                Some(true) => {
                    let text = if gap.is_inequality {
                        "the inequality fails"
                    } else {
                        "the sides differ"
                    };
                    evidence.against = Some(format!("proved, but {text}: {}", show::<N>(&self.system, point, gap)));
                    return;
                }
                Some(false) => evidence
                    .notes
                    .push("few digits in f64 at one point; in 40 digits the sides agree there".to_string()),
                None => evidence
                    .notes
                    .push("few digits in f64 at one point, which could not be refined".to_string()),
            }
        }
    }

    /// Returns true if the verdict shows a point at which the claim fails.
    fn fails(&self) -> bool {
        matches!(self.verdict, Verdict::Refuted | Verdict::Conditional)
    }

    /// What agreement at all points means for a refutation.
    fn against_refutation<N: Numbers>(&self, found: &[Asked<N::Of<f64>>], evidence: &mut Evidence) {
        let count = found.len();
        let what = match self
            .statements
            .claims
            .iter()
            .any(|claim| claim.relation != Relation::Equal)
        {
            true => "the inequality holds",
            false => "the sides agree",
        };
        let special = || format!("{what} at {count} random points; the counterexample is special");
        let tried = || format!("{what} at the integers that are tried");
        let enough = if self.system.has_pieces() {
            MANY_PIECES * 3 / 4
        } else {
            MANY / 2
        };
        let is_telling = |point| !self.system.drowns::<N>(point) && !self.system.is_at_an_end::<N>(point);
        let mut telling = found.iter().filter(|(point, _)| is_telling(point));
        let few: Vec<_> = telling.by_ref().take(3).collect();
        if few.len() + telling.count() < enough || self.hides_from_points() {
            evidence.notes.push(special());
            return;
        }
        if self.is_about_integers() {
            evidence.notes.push(tried());
            return;
        }
        let gap = |point: &Point<N::Of<f64>>| {
            let wide = self.system.widened::<N>(point)?;
            self.worst_gap::<N, Wide<40>>(&wide.values, &wide.running)
                .map(|gap| gap.relative)
        };
        let wide: Option<Vec<f64>> = few.into_iter().map(|(point, _)| gap(point)).collect();
        let Some(wide) = wide else {
            evidence
                .notes
                .push("the sides agree in f64; the points could not be refined".to_string());
            return;
        };
        let worst = wide.into_iter().fold(0.0, f64::max);
        if worst <= self.apart().min(EQUAL_WIDE) {
            let text = format!("refuted, but the sides agree at each of {count} points, at three of them to 25 digits");
            evidence.against = Some(text);
        } else {
            evidence
                .notes
                .push(format!("the sides differ by {worst:.0e} of their size"));
        }
    }

    /// Whether a claim can fail where no random point sees it: where inequalities become equalities, by numbers and
    /// powers so large or small that one side drowns the other, on a jump or a branch cut, on a part of the premises'
    /// solutions that is thinner than the rest or another factor of a product that vanishes, for functions of another shape, or because a condition takes one of the
    /// values of a pair away, or another premise ties them to something else.
    fn hides_from_points(&self) -> bool {
        let system = &self.system;
        self.statements
            .claims
            .iter()
            .any(|claim| claim.relation != Relation::Equal || is_extreme(claim))
            || self
                .statements
                .premises
                .iter()
                .any(|premise| is_extreme(&premise.equation))
            || system.shaped
            || system.divides
            || system
                .questions
                .iter()
                .filter_map(|question| question.pair)
                .any(|slot| {
                    let rows = system.rows.iter().chain(&system.written);
                    let rows = rows.filter(|row| system.formulas.slots(&[**row]).contains(&slot));
                    rows.count() > 1
                        || !system.conditions.is_empty()
                        || system.has_domain()
                        || self.premises_have_domains()
                })
            || system.has_jumps()
            || system.flows_may_end()
            || !system.is_a_graph()
    }

    /// Returns true if a claim is about integers: it may fail at others than those that are tried, and a running index has one
    /// value at all points.
    fn is_about_integers(&self) -> bool {
        self.system.index_runs || self.system.kinds.iter().any(|kind| kind.integer || kind.index)
    }

    /// Whether a premise may be undefined somewhere, be it one that points need not be solved for.
    fn premises_have_domains(&self) -> bool {
        let is_partial = |tree: &Tree| {
            matches!(
                tree,
                Tree::Quotient(..)
                    | Tree::Root(..)
                    | Tree::RealPower(..)
                    | Tree::Power(_, i32::MIN..0, ..)
                    | Tree::Call(..)
            )
        };
        let mut premises = self.statements.premises.iter();
        premises.any(|premise| any_side(&premise.equation, &mut |tree| is_partial(tree)))
    }

    /// Whether the claim holds, to the precision of f64, where the forcing is a cosine of period 2.
    fn holds_for_cosine<N: Numbers>(&self) -> bool {
        let is_forced = |system: &System| {
            system
                .space
                .courses
                .iter()
                .any(|course| course.flight.is_none() && course.law.is_none())
        };
        // without times nothing is forced
        let has_times = self.symbols.times().next().is_some() || self.symbols.running().is_some();
        if !has_times || !is_forced(&self.system) {
            return false;
        }
        let Ok(system) = System::new(self.statements, self.symbols, Forcing::Cosine) else {
            return false;
        };
        let other = Witness { system, ..*self };
        // what is in pieces may hold on one of them at a few points
        let is_plain = |claim: &Equation| claim.relation == Relation::Equal;
        let is_smooth = !other.system.has_pieces() && self.statements.claims.iter().all(is_plain);
        let enough = if is_smooth { FEW } else { MANY_PIECES };
        let mut found = 0;
        for start in 0..(enough * MOST_STARTS) as u64 {
            let Ok(point) = other.system.point::<N>(1000 + start, Style::Moderate) else {
                continue;
            };
            match other.gap::<N>(&point) {
                Some(gap) if gap.digits() > DOUBTFUL_REFUTATION => found += 1,
                Some(_) => return false,
                None => {}
            }
            if found == enough {
                return true;
            }
        }
        false
    }
}

/// e to the power of twice this is 1e24: beyond, one of two exponentials is no part of the other in 25 digits.
const DROWNING: f64 = 28.0;

/// Characters of the longest printed number, and the highest power, with which random points tell a difference.
const LONGEST_NUMBER: usize = 9;
const HIGHEST_POWER: u32 = 8;

fn is_extreme(equation: &Equation) -> bool {
    any_side(equation, &mut |tree| match tree {
        Tree::Number(value) => value.to_string().len() > LONGEST_NUMBER,
        Tree::Power(_, exponent, _) => exponent.unsigned_abs() > HIGHEST_POWER,
        _ => false,
    })
}

impl System {
    /// The operations of claim and premises.
    fn ops(&self) -> impl Iterator<Item = Op> + '_ {
        let sides = self.questions.iter().flat_map(|question| question.sides.as_flattened());
        let all: Vec<_> = sides.chain(&self.rows).chain(&self.late).copied().collect();
        self.formulas.parts(&all).into_iter().map(|part| self.formulas.op(part))
    }

    /// Returns true if a value in claim or premises is found by steps that never end.
    fn is_inexact(&self) -> bool {
        self.ops()
            .any(|op| matches!(op, Op::Bind { kind, .. } if !matches!(kind, Binder::Sum | Binder::Product)))
    }

    /// Whether claim or premises are more than rational, so that sides may be rounded to the same number.
    fn rounds(&self) -> bool {
        self.ops().any(|op| {
            matches!(
                op,
                Op::Root(..) | Op::RealPower(..) | Op::IntegerPower(..) | Op::Apply(..) | Op::Pi
            )
        })
    }

    /// Whether claim or premises have pieces on which they may differ.
    fn has_pieces(&self) -> bool {
        let within = |function| {
            matches!(
                function,
                Function::Sin | Function::Cos | Function::Exp | Function::Sinh | Function::Cosh
            )
        };
        self.ops().any(|op| match op {
            Op::Root(..) | Op::RealPower(..) | Op::If { .. } => true,
            Op::Apply(function, _) => !within(function),
            _ => false,
        })
    }

    /// Whether claim or premises have operations that may be undefined somewhere.
    fn has_domain(&self) -> bool {
        self.ops().any(|op| {
            matches!(
                op,
                Op::Divide(..) | Op::Power(_, i32::MIN..0) | Op::Root(..) | Op::RealPower(..) | Op::Apply(..)
            )
        })
    }

    /// Whether an exponential of claim or premises is so large or so small at a point that 40 digits may lose what
    /// stands beside it.
    fn drowns<N: Numbers>(&self, point: &Point<N::Of<f64>>) -> bool {
        let arguments = self.ops().filter_map(|op| match op {
            Op::Apply(Function::Exp | Function::Sinh | Function::Cosh, argument) => Some(argument),
            _ => None,
        });
        let program = self.formulas.program(&arguments.collect::<Vec<_>>());
        let found = program.outputs(&program.run(&self.inputs(&point.values, None)));
        found.iter().any(|argument| argument.parts()[0].abs() > DROWNING)
    }

    /// Whether claim or premises have jumps or branch cuts on which a point may lie; a number lies on none of which its
    /// digits do not tell.
    fn has_jumps(&self) -> bool {
        let varies = |formula: Formula| !self.formulas.slots(&[formula]).is_empty() || self.formulas.runs(formula);
        self.ops().any(|op| match op {
            Op::Apply(Function::Sgn, argument) => varies(argument),
            Op::Root(of, _) | Op::RealPower(of, _) => self.is_complex && varies(of),
            Op::Apply(Function::Sin | Function::Cos | Function::Exp | Function::Sinh | Function::Cosh, _) => false,
            Op::Apply(_, argument) => self.is_complex && varies(argument),
            _ => false,
        })
    }

    /// The slots that stand once in a row, below operations that can be undone.
    fn solvable(&self, row: Formula) -> Vec<usize> {
        let parts = self.formulas.parts(&[row]);
        // In how many ways a part is reached, and whether what is above it can be undone.
        let mut reached: BTreeMap<Formula, (usize, bool)> = BTreeMap::from([(row, (1, true))]);
        let mut slots = Vec::new();
        for &part in parts.iter().rev() {
            let Some(&(ways, undone)) = reached.get(&part) else {
                continue;
            };
            let op = self.formulas.op(part);
            for operand in op.operands() {
                let undoes = match op {
                    Op::Multiply(a, b) => self.is_nonzero(if operand == a { b } else { a }) && a != b,
                    Op::Divide(a, b) => a != b && (operand == a || self.is_nonzero(a)),
                    Op::Add(..) | Op::Negate(_) | Op::Root(..) => true,
                    Op::Power(_, exponent) => exponent != 0,
                    Op::Apply(function, _) => matches!(
                        function,
                        Function::Exp
                            | Function::Ln
                            | Function::Sinh
                            | Function::Arctan
                            | Function::Arsinh
                            | Function::Artanh
                    ),
                    _ => false,
                };
                let known = reached.entry(operand).or_insert((0, true));
                known.0 = (known.0 + ways).min(2);
                known.1 &= undone && undoes;
            }
            if let Op::Slot(slot) = op
                && (ways, undone) == (1, true)
            {
                slots.push(slot);
            }
        }
        slots
    }

    /// Whether a formula vanishes nowhere that the sheet speaks of, as far as its form shows.
    fn is_nonzero(&self, formula: Formula) -> bool {
        let kind = |slot: usize| self.kinds.get(slot).copied().unwrap_or_default();
        match self.formulas.op(formula) {
            Op::Slot(slot) => kind(slot).positive || kind(slot).nonzero || kind(slot).generic,
            Op::Multiply(a, b) => self.is_nonzero(a) && self.is_nonzero(b),
            Op::Divide(a, _) | Op::Negate(a) | Op::Power(a, _) | Op::Root(a, _) => self.is_nonzero(a),
            _ => self.is_positive(formula) || matches!(self.formulas.op(formula), Op::Ratio(n, _) if n != 0),
        }
    }

    fn is_positive(&self, formula: Formula) -> bool {
        match self.formulas.op(formula) {
            Op::Ratio(above, _) => above > 0,
            Op::Pi | Op::Apply(Function::Exp | Function::Cosh, _) => !self.is_complex,
            Op::Slot(slot) => self.kinds.get(slot).is_some_and(|kind| kind.positive),
            Op::Add(a, b) | Op::Multiply(a, b) | Op::Divide(a, b) => self.is_positive(a) && self.is_positive(b),
            Op::Power(a, _) | Op::Root(a, _) | Op::RealPower(a, _) => self.is_positive(a),
            _ => false,
        }
    }

    /// Whether a law for a derivative may have poles: beyond them the constants of integration are others.
    fn flows_may_end(&self) -> bool {
        let used = |n: &usize| self.ops().any(|op| matches!(op, Op::Flow { law, .. } if law == *n));
        let bodies = (0..self.formulas.laws.len())
            .filter(used)
            .filter_map(|n| self.formulas.laws.get(n));
        let mut parts = bodies.flat_map(|law| self.formulas.parts(&[law.body]));
        parts.any(|part| match self.formulas.op(part) {
            Op::Divide(_, below) => self.formulas.runs(below),
            Op::Power(base, exponent) => exponent < 0 && self.formulas.runs(base),
            Op::Apply(Function::Ln, _) | Op::RealPower(..) | Op::Root(..) => self.formulas.runs(part),
            _ => false,
        })
    }

    /// Whether a row vanishes whatever its slots are, as a law of flight does at the impact that it starts from.
    fn is_identity(&self, row: Formula) -> bool {
        let program = self.formulas.program(&[row]);
        let vanishes = |seed: u64| {
            let mut random = Sequence::new(seed);
            let slots: Vec<f64> = self.space.slots.iter().map(|_| random.between(0.3, 2.0)).collect();
            let values = program.run(&self.inputs(&slots, None));
            let sizes = program.sizes(&values, &|_| 0.0);
            let last = program.outputs.first().copied();
            let both = last
                .zip(sizes)
                .and_then(|(last, sizes)| Some((*values.get(last)?, *sizes.get(last)?)));
            both.is_some_and(|(value, size)| value.abs() <= 64.0 * f64::EPSILON * size)
        };
        !self.is_complex && (1..=3).all(vanishes)
    }

    /// Whether each premise gives a symbol of its own, which it can be solved for wherever it is defined: then no part of
    /// the solutions is thinner than the rest, but where such symbols depend on each other.
    fn is_a_graph(&self) -> bool {
        let mut alone: Vec<Vec<usize>> = self
            .rows
            .iter()
            .chain(&self.late)
            .filter(|row| !self.is_identity(**row))
            .map(|row| self.solvable(*row))
            .collect();
        alone.sort_by_key(Vec::len);
        let mut taken: BTreeMap<usize, usize> = BTreeMap::new();
        // An augmenting path from row to row (Kuhn 1955).
        fn place(row: usize, alone: &[Vec<usize>], taken: &mut BTreeMap<usize, usize>, seen: &mut Vec<usize>) -> bool {
            for &slot in alone.get(row).map_or(&[][..], Vec::as_slice) {
                if seen.contains(&slot) {
                    continue;
                }
                seen.push(slot);
                let other = taken.get(&slot).copied();
                if other.is_none_or(|other| place(other, alone, taken, seen)) {
                    taken.insert(slot, row);
                    return true;
                }
            }
            false
        }
        (0..alone.len()).all(|row| place(row, &alone, &mut taken, &mut Vec::new()))
    }
}

/// Names with values, and the two sides.
fn show<N: Numbers>(system: &System, point: &Point<N::Of<f64>>, gap: &Gap) -> String {
    let complex = |[re, im]: [f64; 2], digits: &dyn Fn(f64) -> String| match im {
        0.0 => digits(re),
        im => format!("{} + {} i", digits(re), digits(im)),
    };
    let short = |x: f64| format!("{x:.6}");
    let long = |x: f64| format!("{x:.15e}");
    let spoken_of = system.spoken_of();
    let is_named = |slot: &Slot| matches!(slot, Slot::Parameter(_) | Slot::Time { .. } | Slot::State { .. });
    let named = system
        .space
        .slots
        .iter()
        .zip(&point.values)
        .enumerate()
        .filter(|(_, (slot, _))| is_named(slot));
    let named = named.filter(|(number, _)| spoken_of.binary_search(number).is_ok());
    let mut parts: Vec<String> = named
        .filter_map(|(number, (_, value))| {
            let name = system.space.show(number, &system.letter)?;
            Some(format!("{name}={}", complex(value.parts(), &short)))
        })
        .collect();
    if system.runs {
        parts.push(format!("t={}", complex(point.running.parts(), &short)));
    }
    parts.push(format!("left={}", complex(gap.left, &long)));
    parts.push(format!("right={}", complex(gap.right, &long)));
    parts.join("; ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_claim_of_the_paper_has_a_witness() {
        let sheet = claims::paper().unwrap();
        for (position, entry) in sheet.entries.iter().enumerate() {
            if entry.role != claims::Role::Claim {
                continue;
            }
            let evidence = witness(&sheet, position, entry.expect, 6).unwrap();
            assert_eq!(evidence.against, None, "{}", entry.label);
            assert_eq!(evidence.points, 6, "{}", entry.label);
            let proved = entry.expect == Verdict::Proved;
            assert_eq!(evidence.digits > Some(10.0), proved, "{} {evidence:?}", entry.label);
        }
    }

    #[test]
    fn a_wrong_verdict_is_contradicted() {
        let sheet = claims::paper().unwrap();
        for (label, wrong) in [
            ("16", Verdict::Proved),
            ("22", Verdict::Proved),
            ("14", Verdict::Refuted),
        ] {
            let evidence = witness(&sheet, sheet.find(label).unwrap(), wrong, 6).unwrap();
            assert!(evidence.against.is_some(), "{label} {evidence:?}");
        }
    }

    fn of(tex: &str, premises: &[(&str, &str)], verdict: Verdict) -> Evidence {
        let mut text = String::new();
        for (label, tex) in premises {
            text += &format!("[[equation]]\nlabel = \"{label}\"\nrole = \"premise\"\ntex = '''{tex}'''\n");
        }
        let labels: Vec<&str> = premises.iter().map(|(label, _)| *label).collect();
        text +=
            &format!("[[equation]]\nlabel = \"c\"\nrole = \"claim\"\ntex = '''{tex}'''\nfollows_from = {labels:?}\n");
        let symbols = claims::vocabulary().unwrap();
        let sheet = Sheet::read(&text, &symbols).unwrap();
        witness(&sheet, sheet.find("c").unwrap(), verdict, 6).unwrap()
    }

    #[test]
    fn what_holds_for_a_cosine_alone_is_said() {
        let periodic = [("p", "f(t) = f(t + T)"), ("q", "T = T_1 + T_2")];
        let evidence = of(r"F_1(t_{k+2}) = F_1(t_k)", &periodic, Verdict::Refuted);
        assert!(
            evidence.against.is_none() && evidence.digits < Some(3.0),
            "{evidence:?}"
        );
        assert!(
            evidence
                .notes
                .iter()
                .any(|note| note.starts_with("true for this forcing")),
            "{evidence:?}"
        );
        let evidence = of("f(t_{k+2}) = f(t_k)", &periodic, Verdict::Proved);
        assert!(
            evidence.against.is_none() && evidence.digits > Some(12.0),
            "{evidence:?}"
        );
    }

    #[test]
    fn a_term_too_small_for_f64_is_no_reason_to_contradict() {
        let given = [("p", "d = r T")];
        let evidence = of("d = r T + 0.0000000000000000001", &given, Verdict::Refuted);
        assert!(
            evidence.against.is_none() && evidence.digits > Some(14.0),
            "{evidence:?}"
        );
        assert!(of("d = T r", &given, Verdict::Refuted).against.is_some());
        assert!(of("d = 1.000001 T r", &given, Verdict::Proved).against.is_some());
    }

    #[test]
    fn laws_of_functions_shape_the_forcing() {
        let opposite = [("p", "f(t) = -f(t + T_1)")];
        let evidence = of("f(t_{k+1}) = -f(t_k)", &opposite, Verdict::Proved);
        assert!(
            evidence.against.is_none() && evidence.digits > Some(12.0),
            "{evidence:?}"
        );
        let growing = [("p", "f(t) = d t")];
        let integral = r"F_1(t_{k+1}) - F_1(t_k) = d (t_{k+1}^2 - t_k^2)/2";
        assert!(of(integral, &growing, Verdict::Proved).digits > Some(12.0));
    }

    #[test]
    fn a_flight_has_the_slope_of_its_law() {
        let law = [(
            "3",
            r"\dot{Z}(t) = -r\dot{Z}^{-}(t_k) + \overline{g}(t - t_k) + F_1(t) - F_1(t_k)",
        )];
        let slope = of(r"\ddot{Z}(t) = f(t) + \overline{g}", &law, Verdict::Proved);
        assert!(slope.against.is_none() && slope.digits > Some(12.0), "{slope:?}");
        assert!(
            of(r"\ddot{Z}(t) = f(t) - \overline{g}", &law, Verdict::Proved)
                .against
                .is_some()
        );
    }

    #[test]
    fn what_premises_leave_open_of_a_map_stays_open() {
        let velocity = [(
            "9",
            r"\dot{Z}_{k+1} = -r_B \dot{Z}_k + \overline{g}T_1 + F_1(t_{k+1}) - F_1(t_k)",
        )];
        let by_velocity = r"\frac{\partial \dot{Z}_{k+1}}{\partial \dot{Z}_k}";
        let chain = r"-r_B + \frac{\partial t_{k+1}}{\partial \dot{Z}_k} [f(t_{k+1}) + \overline{g}]";
        let evidence = of(&format!("{by_velocity} = {chain}"), &velocity, Verdict::Proved);
        assert!(evidence.digits > Some(12.0) && evidence.flown.is_none(), "{evidence:?}");
        let alone = of(&format!("{by_velocity} = -r_B"), &velocity, Verdict::Refuted);
        assert!(alone.digits < Some(3.0), "{alone:?}");
    }

    #[test]
    fn premises_without_a_common_point_leave_no_digits() {
        let evidence = of("r = 2", &[("p", "d = -1")], Verdict::Refuted);
        assert_eq!((evidence.digits, evidence.points), (None, 0));
        assert!(!evidence.notes.is_empty());
    }
}
