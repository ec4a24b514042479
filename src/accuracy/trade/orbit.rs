//! The task `orbit`: a 1-1 orbit from a guess that is 5% off, by the paper's equations, along the explicit curve, and by
//! our own means.

use super::contest::{self, BITS, EVERY, Exact, Means, OF_THE_MACHINE, Task};
use super::{TradeError, TradeOptions, TradeRow, Unsolved};
use crate::model::{Bracket, Motion, Sample, Side, root};
use crate::number::{Analytic, Digits, Dual, Interval, Machine, Rung, Sequence, at_digits, seeded};
use crate::orbit::{Balance, Equations, Proved, Sixteen, Triple, TripleSlopes, nearest, one_to_one, sharpen};
use roots::{
    SearchError, SimpleConvergency, find_root_brent, find_root_inverse_quadratic, find_root_newton_raphson,
    find_root_regula_falsi, find_root_secant,
};

/// Problems: a tenth of what is asked for where one costs next to nothing.
const FEWER: usize = 10;

/// How far the guess is off.
const OFF: f64 = 0.05;

/// A bracket around the guess, as parts of it: the root is inside, and in most problems no other.
const AROUND: [f64; 2] = [0.94, 1.06];

/// An orbit, by parameters that f32 holds exactly.
struct Point {
    motion: Motion<f64>,
    /// Phase, velocity at the bottom and at the top, T_1; in many digits.
    exact: Vec<Exact>,
    /// T_1, psi, t_k and the velocity at the bottom, each 5% off.
    guess: [f64; 4],
}

impl Point {
    /// As tables have it.
    fn place(&self) -> String {
        let [g, d] = [self.motion.g(), self.motion.d()];
        let [r_b, r_t] = [Side::Bottom, Side::Top].map(|side| self.motion.restitution(side));
        let [t_1, psi, ..] = self.guess;
        format!("g={g};d={d};r_B={r_b};r_T={r_t};T_1={t_1};psi={psi}")
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
    let balance = Balance::new(&motion, 1);
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

/// The orbits of random motions.
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
    let search = one_to_one(&motion.convert(|value| Interval::from_f64(*value)).ok()?, 1);
    let points = search.motions.iter().filter_map(|root| {
        let proved = Proved::Pair { root, periods: 1 };
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
        let mut off = |value: f64| {
            value
                * if sequence.on_grid(BITS, 0.0, 1.0) < 0.5 {
                    1.0 - OFF
                } else {
                    1.0 + OFF
                }
        };
        let [t_1, psi] = root.enclosure.map(|side| side.midpoint());
        let [phase, velocity] = [exact[0].to_f64(), exact[1].to_f64()];
        let guess = [t_1, psi, phase / std::f64::consts::PI, velocity].map(&mut off);
        let motion = motion.clone();
        Some(Point { motion, exact, guess })
    });
    Some(points.collect())
}

/// The certified orbit, which rests on equations without a denominator, and the mended triple.
fn exact(point: &Point) -> Option<[Vec<Exact>; 2]> {
    let near = [&point.exact[0], &point.exact[3], &point.exact[1]].map(Analytic::to_f64);
    let near = [near[0] / std::f64::consts::PI, near[1], near[2]].map(<Exact as Analytic>::from_f64);
    let again = by_triple(point, Sixteen::Mended, TripleSlopes::Duals, near)?;
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
    Triple(Sixteen, TripleSlopes),
    /// The curve of 1-1 motions, a root of one equation in T_1 alone, by a root finder of the crate `roots`.
    Curve(Finder),
    /// The same by Newton's method kept within its bracket, with dual numbers.
    OwnOnCurve,
    /// Newton's method on the two equations of [`Balance`], with derivatives by hand.
    Newton,
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

const ALL: [Way; 12] = [
    Way::Triple(Sixteen::AsPrinted, TripleSlopes::Duals),
    Way::Triple(Sixteen::AsPrinted, TripleSlopes::Differences),
    Way::Triple(Sixteen::Mended, TripleSlopes::Duals),
    Way::Triple(Sixteen::Mended, TripleSlopes::Differences),
    Way::Curve(Finder::Brent),
    Way::Curve(Finder::InverseQuadratic),
    Way::Curve(Finder::Newton),
    Way::Curve(Finder::RegulaFalsi),
    Way::Curve(Finder::Secant),
    Way::OwnOnCurve,
    Way::Newton,
    Way::Certified,
];

impl Means<Point> for Way {
    fn name(&self) -> &'static str {
        match self {
            Self::Triple(Sixteen::AsPrinted, TripleSlopes::Duals) => "printed-dual",
            Self::Triple(Sixteen::AsPrinted, TripleSlopes::Differences) => "printed-difference",
            Self::Triple(Sixteen::Mended, TripleSlopes::Duals) => "mended-dual",
            Self::Triple(Sixteen::Mended, TripleSlopes::Differences) => "mended-difference",
            Self::Curve(Finder::Brent) => "curve-brent",
            Self::Curve(Finder::InverseQuadratic) => "curve-inverse-quadratic",
            Self::Curve(Finder::Newton) => "curve-newton",
            Self::Curve(Finder::RegulaFalsi) => "curve-regula-falsi",
            Self::Curve(Finder::Secant) => "curve-secant",
            Self::OwnOnCurve => "curve-own",
            Self::Newton => "newton",
            Self::Certified => "certified",
        }
    }

    fn rungs(&self) -> &'static [Rung] {
        match self {
            Self::Curve(_) => OF_THE_MACHINE,
            _ => EVERY,
        }
    }

    fn answer<T: Machine>(&self, point: &Point) -> Result<Vec<T>, Unsolved> {
        let number = <T as Analytic>::from_f64;
        let [t_1, psi, time, velocity] = point.guess;
        if let Self::Triple(sixteen, slopes) = self {
            let guess = [time, t_1, velocity].map(number);
            return by_triple(point, *sixteen, *slopes, guess).ok_or(Unsolved::NoConvergence);
        }
        let motion = point.motion::<T>().ok_or(Unsolved::LeftDomain)?;
        let balance = Balance::new(&motion, 1);
        let [t_1, psi] = match self {
            Self::Triple(..) => return Err(Unsolved::LeftDomain),
            Self::Curve(finder) => on_curve(&balance, finder.root(&balance, t_1)?)?,
            Self::OwnOnCurve => on_curve(&balance, bracketed(&motion, &balance, t_1)?)?,
            Self::Newton => newton(&balance, [number(t_1), number(psi)]).ok_or(Unsolved::NoConvergence)?,
            Self::Certified => certified(point, [t_1, psi]).ok_or(Unsolved::NoConvergence)?,
        };
        let [bottom, top] = balance.velocities(&t_1, &psi);
        let [phase, _] = balance.phases(&t_1, &psi);
        Ok(vec![phase, bottom, top, t_1])
    }
}

/// Phase, velocities and T_1 by (14) to (16), from (t_k, T_1, Zdot_k).
fn by_triple<T: Machine>(point: &Point, sixteen: Sixteen, slopes: TripleSlopes, guess: [T; 3]) -> Option<Vec<T>> {
    let triple = Triple::new(&point.motion::<T>()?, sixteen);
    let found = triple.solved(guess, slopes)?;
    let top = triple.velocity_at_top(&found);
    let [time, t_1, velocity] = found;
    Some(vec![time * T::pi(), velocity, top, t_1])
}

/// (T_1, psi) on the curve.
fn on_curve<T: Analytic>(balance: &Balance<T>, t_1: T) -> Result<[T; 2], Unsolved> {
    let [psi, _] = balance.middle(&t_1).ok_or(Unsolved::LeftDomain)?;
    Ok([t_1, psi])
}

impl Finder {
    /// The root near `guess`. The crate works in f64; the equation is evaluated in `T`.
    fn root<T: Machine>(self, balance: &Balance<T>, guess: f64) -> Result<T, Unsolved> {
        let excess = |t_1: f64| {
            let value = balance.middle(&<T as Analytic>::from_f64(t_1));
            value.map_or(f64::NAN, |[_, excess]| excess.to_f64())
        };
        let slope = |t_1: f64| (excess(t_1 + 1e-6) - excess(t_1 - 1e-6)) / 2e-6;
        let [low, high] = AROUND.map(|part| part * guess);
        let mut convergency = SimpleConvergency {
            eps: 4.0 * <T as Analytic>::epsilon().to_f64(),
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

/// The root near `guess` by [`root`].
fn bracketed<T: Machine>(motion: &Motion<T>, balance: &Balance<T>, guess: f64) -> Result<T, Unsolved> {
    let [low, high] = AROUND.map(|part| <T as Analytic>::from_f64(part * guess));
    let excess = |t_1: &T| Some(balance.middle(t_1)?[1].to_f64());
    let [Some(at_low), Some(at_high)] = [excess(&low), excess(&high)] else {
        return Err(Unsolved::LeftDomain);
    };
    let values = [at_low, at_high];
    if at_low * at_high > 0.0 {
        return Err(Unsolved::NoBracket);
    }
    let lifted = motion.convert(|value| Dual::from_re(value.clone()));
    let lifted = Balance::new(&lifted.map_err(|_| Unsolved::LeftDomain)?, 1);
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

/// Newton's method in `T` until the steps no longer shrink.
fn newton<T: Analytic>(balance: &Balance<T>, guess: [T; 2]) -> Option<[T; 2]> {
    let [mut t_1, mut psi] = guess;
    let mut last = f64::INFINITY;
    for _ in 0..60 {
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
        if size * size <= T::epsilon().to_f64() || (size >= last && last < 1e-4) {
            return Some([t_1, psi]);
        }
        last = size;
    }
    None
}

/// The middle of a proved enclosure.
fn certified<T: Machine>(point: &Point, guess: [f64; 2]) -> Option<[T; 2]> {
    let near = nearest(&Balance::new(&point.motion::<f64>()?, 1), guess)?;
    let balance = Balance::new(&point.motion::<Interval<T>>()?, 1);
    let root = sharpen(&Equations(&balance), near.map(<T as Analytic>::from_f64))?;
    Some(root.enclosure.map(|side| side.midpoint()))
}

/// The trade of task `orbit`.
pub(super) fn rows(options: &TradeOptions) -> Result<Vec<TradeRow>, TradeError> {
    let task = Task {
        name: "orbit".to_owned(),
        points: &points(options),
        exact,
        error,
        miss,
        place: Point::place,
    };
    contest::rows(&task, &ALL, options)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_mended_equations_and_ours_reach_the_orbit_and_the_printed_ones_do_not() {
        let options = TradeOptions {
            points: 200,
            seconds_per_row: 0.0,
            ..TradeOptions::default()
        };
        let rows = rows(&options).expect("a trade");
        let median = |method: &str, number: Rung| {
            let named = |row: &&TradeRow| row.method == method && row.number == number;
            rows.iter().find(named).expect("a row").digits
        };
        for method in ["mended-dual", "newton", "certified"] {
            assert!(median(method, Rung::Double) > 13.0, "{method}");
            assert!(median(method, Rung::Wide(50)) > 55.0, "{method}");
        }
        assert!(median("curve-own", Rung::DoubleDouble) > 27.0 && median("curve-brent", Rung::Double) > 11.0);
        assert!(median("printed-dual", Rung::Double) < 2.0 && median("printed-difference", Rung::Double) < 2.0);
    }
}
