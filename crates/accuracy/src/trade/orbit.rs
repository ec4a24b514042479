//! The task `orbit`: a 1-1 orbit from guesses that are 0.1% to 20% off, by the paper's equations, along the explicit curve, and by
//! our own means.

use super::contest::{self, BITS, EVERY, Exact, Means, OF_THE_MACHINE, RIGHT, Task};
use super::{TradeError, TradeOptions, TradeRow, Unsolved};
use crate::paper_equations::{DerivativeMethod, Eq16, PaperEquations};
use dynamics::model::{Bracket, Motion, Sample, Side, root};
use dynamics::orbit::{OneOneEquations, OrbitOptions, ProvedOrbit, isolate_one_one, newton_one_one, sharpen};
use numbers::{Analytic, Digits, Dual, Interval, Machine, Rung, Sequence, at_digits, seeded};
use roots::{
    SearchError, SimpleConvergency, find_root_brent, find_root_inverse_quadratic, find_root_newton_raphson,
    find_root_regula_falsi, find_root_secant,
};

/// Problems: a tenth of what is asked for where one costs next to nothing.
const FEWER: usize = 10;

/// How far guesses are off, in percent. The paper's equations as printed, tolerances and counts of iterations are
/// compared at [`USUAL`] alone.
const OFF: [f64; 4] = [0.1, 1.0, 5.0, 20.0];

/// As far as a guess from a plot is off.
const USUAL: f64 = 5.0;

/// A bracket around a guess reaches so many times as far as the guess is off: the root is inside, and in most problems
/// no other.
const AROUND: f64 = 1.2;

/// An orbit, by parameters that f32 holds exactly.
struct Point {
    motion: Motion<f64>,
    /// Phase, velocity at the bottom and at the top, T_1; in many digits.
    exact: Vec<Exact>,
    /// T_1, psi, t_k and the velocity at the bottom.
    near: [f64; 4],
    /// Which way the guess at each is off.
    up: [bool; 4],
    /// By which part.
    off: f64,
}

impl Point {
    /// As tables have it.
    fn place(&self) -> String {
        let [g, d] = [self.motion.g(), self.motion.d()];
        let [r_b, r_t] = [Side::Bottom, Side::Top].map(|side| self.motion.restitution(side));
        let [t_1, psi, ..] = self.guess();
        format!("g={g};d={d};r_B={r_b};r_T={r_t};T_1={t_1};psi={psi}")
    }

    /// T_1, psi, t_k and the velocity at the bottom, each off.
    fn guess(&self) -> [f64; 4] {
        std::array::from_fn(|n| self.near[n] * (1.0 + if self.up[n] { self.off } else { -self.off }))
    }

    /// What holds T_1 for certain, whichever way the guess is off.
    fn bracket(&self) -> [f64; 2] {
        let [t_1, ..] = self.guess();
        [1.0, -1.0].map(|sign| t_1 / (1.0 + sign * AROUND * self.off))
    }

    fn motion<T: Analytic>(&self) -> Option<Motion<T>> {
        self.motion.convert(|value| T::from_f64(*value)).ok()
    }
}

/// Random motions, by parameters that f32 holds exactly.
pub fn motions(options: &TradeOptions, count: usize) -> Vec<Motion<f64>> {
    let mut sequence = Sequence::new(options.seed);
    let mut between = |low, high| f64::from(sequence.on_grid(BITS, low, high) as f32);
    let mut draw = || {
        Motion::new(
            between(-0.3, 0.5),
            between(0.1, 1.0),
            between(0.2, 0.9),
            between(0.2, 0.9),
        )
    };
    std::iter::repeat_with(|| draw().ok()).flatten().take(count).collect()
}

/// How far an answer may be from an orbit that it is taken for.
const BESIDE: f64 = 1e-3;

/// What an answer is that is not the orbit beside the guess.
fn miss(point: &Point, found: &[Exact]) -> Unsolved {
    let (Some(motion), Some(t_1)) = (point.motion::<Exact>(), found.last()) else {
        return Unsolved::LeftDomain;
    };
    let balance = OneOneEquations::new(&motion, 1);
    let Some([psi, excess]) = balance.middle(t_1) else {
        return Unsolved::NoOrbit;
    };
    let [bottom, top] = balance.velocities(t_1, &psi);
    let [phase, _] = balance.phases(t_1, &psi);
    let is_orbit = excess.to_f64().abs() < BESIDE && error(found, &[phase, bottom, top, t_1.clone()]) < BESIDE;
    if is_orbit {
        Unsolved::AnotherOrbit
    } else {
        Unsolved::NoOrbit
    }
}

/// The orbits of random motions, with guesses that are so many percent off.
fn points(options: &TradeOptions) -> Vec<Point> {
    let wanted = options.points / FEWER;
    let mut sequence = Sequence::new(options.seed);
    let orbits = motions(options, wanted)
        .into_iter()
        .filter_map(|motion| orbits(motion, &mut sequence));
    let mut points: Vec<Point> = orbits.flatten().collect();
    points.truncate(wanted);
    points
}

/// The orbits of a motion with what is known of them in many digits.
fn orbits(motion: Motion<f64>, sequence: &mut Sequence) -> Option<Vec<Point>> {
    let search = isolate_one_one(
        &motion.convert(|value| Interval::from_f64(*value)).ok()?,
        1,
        &OrbitOptions::DEFAULT,
    );
    let points = search.motions.iter().filter_map(|root| {
        let proved = ProvedOrbit::Pair { root, periods: 1 };
        let exact: Vec<Exact> = at_digits(100, || {
            let orbit = proved.orbit::<Digits>(&motion).ok()?;
            let values = [
                &orbit.phases[0],
                &orbit.velocities[0],
                &orbit.velocities[1],
                &orbit.times[0],
            ];
            Some(values.map(|value| value.midpoint().convert()).to_vec())
        })?;
        let up = [(); 4].map(|()| sequence.on_grid(BITS, 0.0, 1.0) >= 0.5);
        let [t_1, psi] = root.enclosure.map(|side| side.midpoint());
        let [phase, velocity] = [exact[0].to_f64(), exact[1].to_f64()];
        Some(Point {
            motion: motion.clone(),
            exact,
            near: [t_1, psi, phase / std::f64::consts::PI, velocity],
            up,
            off: USUAL / 100.0,
        })
    });
    Some(points.collect())
}

/// The certified orbit, which rests on equations without a denominator, and the mended triple.
fn exact(point: &Point) -> Option<[Vec<Exact>; 2]> {
    let near = [&point.exact[0], &point.exact[3], &point.exact[1]].map(Analytic::to_f64);
    let near = [near[0] / std::f64::consts::PI, near[1], near[2]].map(<Exact as Analytic>::from_f64);
    let again = by_triple(point, Eq16::Mended, DerivativeMethod::Duals, near)?;
    Some([point.exact.clone(), again])
}

/// The largest of the error of the phase, in rad around the circle, and of the relative errors of both velocities and of
/// T_1.
fn error(found: &[Exact], exact: &[Exact]) -> f64 {
    let turn = Exact::pi() + Exact::pi();
    let apart = found[0].clone() - exact[0].clone();
    let turns = (apart.to_f64() / std::f64::consts::TAU).round();
    let phase = (apart - <Exact as Analytic>::from_f64(turns) * turn).to_f64().abs();
    let others = contest::worst_relative_error(&found[1..], &exact[1..]);
    // unlike f64::max this lets NaN through
    if phase <= others { others } else { phase }
}

#[derive(Clone, Copy)]
enum Way {
    /// (14) to (16) by Newton's method.
    PaperEquations(Eq16, DerivativeMethod),
    /// The curve of 1-1 motions, a root of one equation in T_1 alone, by a root finder of the crate `roots`, to what the
    /// number holds or to a tolerance of 10^-n.
    Curve(Finder, Option<i32>),
    /// The same by Newton's method kept within its bracket, with dual numbers.
    OwnOnCurve,
    /// Newton's method on the two equations of [`OneOneEquations`], with derivatives by hand, until its steps no longer shrink or
    /// for so many iterations.
    Newton(Option<usize>),
    /// The same, and then Krawczyk's operator: the answer is proved to be within its bound of the only orbit near.
    Certified,
}

#[derive(Clone, Copy)]
enum Finder {
    Brent,
    InverseQuadratic,
    Newton,
    RegulaFalsi,
    Secant,
}

const FINDERS: [Finder; 5] = [
    Finder::Brent,
    Finder::InverseQuadratic,
    Finder::Newton,
    Finder::RegulaFalsi,
    Finder::Secant,
];

/// Tolerances of root finders, as powers of 1/10.
const TOLERANCES: [i32; 5] = [2, 4, 6, 9, 12];

/// Counts of iterations.
const ITERATIONS: [usize; 6] = [1, 2, 3, 4, 5, 6];

impl Way {
    /// Those that are compared from guesses that are so many percent off.
    fn all_for(off: f64) -> Vec<Self> {
        let is_usual = off == USUAL;
        let mut all = Vec::new();
        for sixteen in [Eq16::AsPrinted, Eq16::Mended] {
            if is_usual || sixteen == Eq16::Mended {
                all.extend(
                    [DerivativeMethod::Duals, DerivativeMethod::Differences]
                        .map(|slopes| Self::PaperEquations(sixteen, slopes)),
                );
            }
        }
        for finder in FINDERS {
            all.push(Self::Curve(finder, None));
            if is_usual {
                all.extend(TOLERANCES.map(|zeros| Self::Curve(finder, Some(zeros))));
            }
        }
        all.extend([Self::OwnOnCurve, Self::Newton(None)]);
        if is_usual {
            all.extend(ITERATIONS.map(|count| Self::Newton(Some(count))));
        }
        all.push(Self::Certified);
        all
    }
}

impl Means<Point> for Way {
    fn name(&self) -> &'static str {
        match self {
            Self::PaperEquations(Eq16::AsPrinted, DerivativeMethod::Duals) => "printed-dual",
            Self::PaperEquations(Eq16::AsPrinted, DerivativeMethod::Differences) => "printed-difference",
            Self::PaperEquations(Eq16::Mended, DerivativeMethod::Duals) => "mended-dual",
            Self::PaperEquations(Eq16::Mended, DerivativeMethod::Differences) => "mended-difference",
            Self::Curve(Finder::Brent, _) => "curve-brent",
            Self::Curve(Finder::InverseQuadratic, _) => "curve-inverse-quadratic",
            Self::Curve(Finder::Newton, _) => "curve-newton",
            Self::Curve(Finder::RegulaFalsi, _) => "curve-regula-falsi",
            Self::Curve(Finder::Secant, _) => "curve-secant",
            Self::OwnOnCurve => "curve-own",
            Self::Newton(_) => "newton",
            Self::Certified => "certified",
        }
    }

    fn setting(&self) -> String {
        match self {
            Self::Curve(_, Some(zeros)) => format!("tol=1e-{zeros}"),
            Self::Newton(Some(count)) => format!("iterations={count}"),
            _ => String::new(),
        }
    }

    fn is_proved(&self) -> bool {
        matches!(self, Self::Certified)
    }

    fn rungs(&self) -> &'static [Rung] {
        match self {
            // coarser than a rounding of f32
            Self::Curve(_, Some(7..)) => &OF_THE_MACHINE[1..],
            Self::Curve(..) => OF_THE_MACHINE,
            _ => EVERY,
        }
    }

    fn answer<T: Machine>(&self, point: &Point) -> Result<Vec<T>, Unsolved> {
        let number = <T as Analytic>::from_f64;
        let [t_1, psi, time, velocity] = point.guess();
        if let Self::PaperEquations(sixteen, slopes) = self {
            let guess = [time, t_1, velocity].map(number);
            return by_triple(point, *sixteen, *slopes, guess).ok_or(Unsolved::NoConvergence);
        }
        let motion = point.motion::<T>().ok_or(Unsolved::LeftDomain)?;
        let balance = OneOneEquations::new(&motion, 1);
        let [t_1, psi] = match self {
            Self::PaperEquations(..) => return Err(Unsolved::LeftDomain),
            Self::Curve(finder, zeros) => on_curve(&balance, finder.root(&balance, point, *zeros)?)?,
            Self::OwnOnCurve => on_curve(&balance, bracketed(&motion, &balance, point.bracket())?)?,
            Self::Newton(count) => {
                newton(&balance, [number(t_1), number(psi)], *count).ok_or(Unsolved::NoConvergence)?
            }
            Self::Certified => certified(point, [t_1, psi]).ok_or(Unsolved::NoConvergence)?,
        };
        let [bottom, top] = balance.velocities(&t_1, &psi);
        let [phase, _] = balance.phases(&t_1, &psi);
        Ok(vec![phase, bottom, top, t_1])
    }
}

/// Phase, velocities and T_1 by (14) to (16), from (t_k, T_1, Zdot_k).
fn by_triple<T: Machine>(point: &Point, sixteen: Eq16, slopes: DerivativeMethod, guess: [T; 3]) -> Option<Vec<T>> {
    let triple = PaperEquations::new(&point.motion::<T>()?, sixteen);
    let found = triple.solved(guess, slopes)?;
    let top = triple.velocity_at_top(&found);
    let [time, t_1, velocity] = found;
    Some(vec![time * T::pi(), velocity, top, t_1])
}

/// (T_1, psi) on the curve.
fn on_curve<T: Analytic>(balance: &OneOneEquations<T>, t_1: T) -> Result<[T; 2], Unsolved> {
    let [psi, _] = balance.middle(&t_1).ok_or(Unsolved::LeftDomain)?;
    Ok([t_1, psi])
}

impl Finder {
    /// The root near a guess, to 10^-`zeros` or as well as `T` has it. The crate works in f64; the equation is evaluated in
    /// `T`.
    fn root<T: Machine>(self, balance: &OneOneEquations<T>, point: &Point, zeros: Option<i32>) -> Result<T, Unsolved> {
        let excess = |t_1: f64| {
            let value = balance.middle(&<T as Analytic>::from_f64(t_1));
            value.map_or(f64::NAN, |[_, excess]| excess.to_f64())
        };
        let slope = |t_1: f64| (excess(t_1 + 1e-6) - excess(t_1 - 1e-6)) / 2e-6;
        let ([guess, ..], [low, high]) = (point.guess(), point.bracket());
        let finest = 4.0 * <T as Analytic>::epsilon().to_f64();
        let mut convergency = SimpleConvergency {
            eps: zeros.map_or(finest, |zeros| 0.1_f64.powi(zeros)),
            max_iter: 100,
        };
        let found: Result<f64, SearchError> = match self {
            Self::Brent => find_root_brent(low, high, excess, &mut convergency),
            Self::InverseQuadratic => find_root_inverse_quadratic(low, high, excess, &mut convergency),
            Self::Newton => find_root_newton_raphson(guess, excess, slope, &mut convergency),
            Self::RegulaFalsi => find_root_regula_falsi(low, high, excess, &mut convergency),
            Self::Secant => find_root_secant(low, high, excess, &mut convergency),
        };
        match found {
            Ok(root) => Ok(<T as Analytic>::from_f64(root)),
            Err(SearchError::NoBracketing) => Err(Unsolved::NoBracket),
            Err(_) => Err(Unsolved::NoConvergence),
        }
    }
}

/// The root in a bracket by [`root`].
fn bracketed<T: Machine>(motion: &Motion<T>, balance: &OneOneEquations<T>, bracket: [f64; 2]) -> Result<T, Unsolved> {
    let [low, high] = bracket.map(<T as Analytic>::from_f64);
    let excess = |t_1: &T| Some(balance.middle(t_1)?[1].to_f64());
    let [Some(at_low), Some(at_high)] = [excess(&low), excess(&high)] else {
        return Err(Unsolved::LeftDomain);
    };
    let values = [at_low, at_high];
    if at_low * at_high > 0.0 {
        return Err(Unsolved::NoBracket);
    }
    let lifted = motion.convert(|value| Dual::from_re(value.clone()));
    let lifted = OneOneEquations::new(&lifted.map_err(|_| Unsolved::LeftDomain)?, 1);
    let sample = |t_1: &T| {
        let excess = lifted.middle(&seeded(t_1.clone())).map(|[_, excess]| excess);
        let excess = excess.unwrap_or_else(|| Dual::from_re(<T as Analytic>::from_f64(f64::NAN)));
        Sample {
            value: excess.re,
            slope: excess.eps,
            // 1 - 1/(P² + Q²) next to its root
            size: 2.0,
        }
    };
    let (low, high) = (&low, &high);
    Ok(root(&Bracket { low, high, values }, sample))
}

/// The most iterations of Newton's method that is to end by itself.
const MOST_ITERATIONS: usize = 60;

/// Newton's method in `T` for so many iterations, or until the steps no longer shrink.
fn newton<T: Analytic>(balance: &OneOneEquations<T>, guess: [T; 2], count: Option<usize>) -> Option<[T; 2]> {
    let [mut t_1, mut psi] = guess;
    let mut last = f64::INFINITY;
    for iteration in 1..=count.unwrap_or(MOST_ITERATIONS) {
        let ([first, second], [[a, b], [c, d]]) = balance.linearised(&t_1, &psi);
        let determinant = a.clone() * d.clone() - b.clone() * c.clone();
        let steps = [
            (d * first.clone() - b * second.clone()) / determinant.clone(),
            (a * second - c * first) / determinant,
        ];
        let size: f64 = steps.iter().map(|step| step.to_f64().abs()).sum();
        if !size.is_finite() {
            return None;
        }
        let [by_time, by_phase] = steps;
        t_1 -= by_time;
        psi -= by_phase;
        // a step squares to the next one
        let is_small = size * size <= T::epsilon().to_f64() || (size >= last && last < 1e-4);
        if count.map_or(is_small, |count| iteration == count) {
            return Some([t_1, psi]);
        }
        last = size;
    }
    None
}

/// The middle of a proved enclosure.
fn certified<T: Machine>(point: &Point, guess: [f64; 2]) -> Option<[T; 2]> {
    let near = newton_one_one(&OneOneEquations::new(&point.motion::<f64>()?, 1), guess)?;
    let balance = OneOneEquations::new(&point.motion::<Interval<T>>()?, 1);
    let root = sharpen(&balance, near.map(<T as Analytic>::from_f64))?;
    Some(root.enclosure.map(|side| side.midpoint()))
}

/// The trade of task `orbit`: a part for each distance of the guesses.
pub(super) fn rows(options: &TradeOptions) -> Result<Vec<TradeRow>, TradeError> {
    let mut points = points(options);
    let mut rows = Vec::new();
    for off in OFF {
        for point in &mut points {
            point.off = off / 100.0;
        }
        let task = Task {
            name: format!("orbit/guess-{off}%"),
            points: &points,
            error,
            miss,
            place: Point::place,
            right: RIGHT,
        };
        rows.extend(contest::rows(&task, exact, &Way::all_for(off), options)?);
    }
    Ok(rows)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_mended_equations_and_ours_reach_the_orbit_from_a_guess_and_the_printed_ones_do_not() {
        let options = TradeOptions {
            points: 200,
            seconds_per_row: 0.0,
            ..TradeOptions::default()
        };
        let rows = rows(&options).expect("a trade");
        let median = |method: &str, number: Rung| {
            let is_usual = |row: &TradeRow| row.task == "orbit/guess-5%" && row.setting.is_empty();
            let named = |row: &&TradeRow| is_usual(row) && row.method == method && row.number == number;
            rows.iter().find(named).expect("a row").digits
        };
        for method in ["mended-dual", "newton", "certified"] {
            assert!(median(method, Rung::Double) > 13.0, "{method}");
            assert!(median(method, Rung::Wide(50)) > 55.0, "{method}");
        }
        assert!(median("curve-own", Rung::DoubleDouble) > 27.0 && median("curve-brent", Rung::Double) > 11.0);
        assert!(median("printed-dual", Rung::Double) < 2.0 && median("printed-difference", Rung::Double) < 2.0);
        let after = |count: &str| {
            let named = |row: &&TradeRow| row.setting == count && row.number == Rung::Double;
            rows.iter().find(named).expect("a row")
        };
        // each iteration doubles the digits, and costs as much as the one before
        let (two, three) = (after("iterations=2"), after("iterations=3"));
        assert!(three.kept(0.5) > 1.7 * two.kept(0.5) && three.operations < 2 * two.operations);
        // a better guess is solved by as many, and from 20% off by fewer
        let solved = |task: &str| {
            let named = |row: &&TradeRow| row.task == task && row.method == "curve-brent" && row.setting.is_empty();
            rows.iter().find(named).expect("a row").solved
        };
        assert!(
            solved("orbit/guess-0.1%") > solved("orbit/guess-5%")
                && solved("orbit/guess-5%") > solved("orbit/guess-20%")
        );
    }
}
