//! All 1-1 motions of an extreme scene: by the program's own search, and by Newton's method on the paper's equations.

use super::StressError;
use super::paper::{Formula, Paper, Values};
use super::quantity::{Exact, Number, largest, narrow, widen};
use super::row::{Evaluation, Form, StressRow, place};
use dynamics::model::{Forcing, Motion, Parameters, Side};
use dynamics::orbit::{OpenOrbit, OrbitImpact, OutputPrecision, RoundedOrbit, Word, find, find_as, shoot};
use numbers::{Analytic, Decimal, Decimals, DoubleDouble, Dual, Rung, seeded};

/// Parameters at which motions are looked for.
pub(super) struct Scene {
    /// The extreme.
    pub case: &'static str,
    /// g, d, r_B, r_T
    pub parameters: [f64; 4],
    /// The forcing periods that the motions take.
    pub periods: u32,
}

/// The paper's three equations in t_k, T_1 and Zdot_k.
pub(super) struct Triple([Formula; 3]);

const NAMES: [&str; 6] = ["g", "d", "r_B", "r_T", "periods", "phase"];

const FORMULA: &str = "1-1 motion";

/// Figures of the decimals that are asked for.
const DECIMALS: usize = 30;

/// Newton steps from the motion itself, rounded: some to settle, none to wander.
const STEPS: usize = 8;

/// How far a parameter is moved, relatively, to see what the motion does.
const MOVED: f64 = 1e-30;

/// A motion that is known.
pub(super) struct Known {
    pub fixes: Vec<OrbitImpact<Exact>>,
    pub condition: f64,
}

/// r_B r_T near 1 and r_B near 0 belong to (14) and (16), which have cases of their own.
pub(super) fn scenes() -> Vec<Scene> {
    let scene = |case, parameters, periods| Scene {
        case,
        parameters,
        periods,
    };
    let mut scenes = Vec::new();
    for d in [1e-2, 1e-5, 1e-10, 1e-15] {
        scenes.push(scene("d near 0", [0.12201, d, 0.5, 0.5], 1));
    }
    for (d, periods) in [(2.0, 3), (2.0, 4), (4.0, 6)] {
        scenes.push(scene("d large", [0.12201, d, 0.5, 0.5], periods));
    }
    for g in [1e-2, 1e-6, 1e-12, 0.0] {
        scenes.push(scene("g near 0", [g, 0.4, 0.5, 0.5], 1));
    }
    for less in [1e-2, 1e-6, 1e-12, 0.0] {
        scenes.push(scene("g near 1", [1.0 - less, 1.5, 0.8, 0.8], 1));
    }
    scenes.push(scene("g above 1", [1.1, 1.572303, 0.8, 0.8], 1));
    scenes.push(scene("g above 1", [1.0 + 1e-12, 1.5, 0.8, 0.8], 1));
    scenes.push(scene("r_B r_T near 1", [0.12201, 0.4, 1.0 - 1e-15, 1.0], 1));
    scenes.push(scene("r_B near 0", [0.07, 0.29, 1e-15, 0.5], 1));
    for parameters in [
        [5e-324, 0.4, 0.5, 0.5],
        [0.12201, 5e-324, 0.5, 0.5],
        [0.07, 0.29, 5e-324, 0.5],
    ] {
        scenes.push(scene("subnormal", parameters, 1));
    }
    scenes
}

impl Triple {
    /// (14), (15) and (16), mended.
    pub fn new(paper: &Paper) -> Result<Self, StressError> {
        let mend = [super::velocity::MEND];
        Ok(Self([
            paper.formula("14", &[])?,
            paper.formula("15", &[])?,
            paper.formula("16", &mend)?,
        ]))
    }

    /// Zdot_k less what each equation says it is.
    fn residuals<T: Number>(&self, motion: &Motion<T>, periods: u32, unknowns: &[T; 3]) -> Option<[T; 3]> {
        let [start, t_1, v] = unknowns;
        let forcing = Forcing::harmonic(&T::zero());
        let [before, after] = [start.clone(), start.clone() + t_1.clone()].map(|time| forcing.at(&time));
        let total = T::from_integer(2 * i64::from(periods));
        let restitution = |side| motion.restitution(side).clone();
        let values = Values::new([
            ("r_B", restitution(Side::Bottom)),
            ("r_T", restitution(Side::Top)),
            (r"\overline{g}", motion.g().clone()),
            ("d", motion.d().clone()),
            ("T", total.clone()),
            ("T_1", t_1.clone()),
            ("T_2", total - t_1.clone()),
            ("F_1(t_k)", before.f1),
            ("F_1(t_{k+1})", after.f1),
            ("F_2(t_k)", before.f2),
            ("F_2(t_{k+1})", after.f2),
        ]);
        let residual = |formula: &Formula| Some(v.clone() - formula.values(values.clone())?.pop()?);
        let [a, b, c] = &self.0;
        Some([residual(a)?, residual(b)?, residual(c)?])
    }

    /// Newton's method from the motion as `T` holds it.
    fn solved<T: Number>(
        &self,
        parameters: &Motion<f64>,
        periods: u32,
        known: &Known,
    ) -> Option<Vec<OrbitImpact<Exact>>> {
        let motion: Motion<T> = parameters.motion().ok()?;
        let lifted = motion.convert(|value| Dual::from_re(value.clone())).ok()?;
        let first = known.fixes.first()?;
        let exact = [
            first.phase.clone() / Exact::pi(),
            first.time.clone(),
            first.velocity.clone(),
        ];
        let mut unknowns: [T; 3] = exact.each_ref().map(narrow);
        for _ in 0..STEPS {
            let mut columns: Vec<[T; 3]> = Vec::new();
            let mut values = None;
            for column in 0..3 {
                let mut at = unknowns.clone().map(Dual::from_re);
                at[column] = seeded(unknowns[column].clone());
                let found = self.residuals(&lifted, periods, &at)?;
                columns.push(found.each_ref().map(|value| value.eps.clone()));
                values = Some(found.map(|value| value.re));
            }
            let step = cramer(&columns, &values?)?;
            let mut finite = true;
            for (unknown, step) in unknowns.iter_mut().zip(step) {
                *unknown -= step;
                finite &= unknown.to_f64().is_finite();
            }
            if !finite {
                return None;
            }
        }
        let [start, t_1, v] = unknowns;
        let forcing = Forcing::harmonic(&T::zero());
        let end = start.clone() + t_1.clone();
        let gain = forcing.at(&end).f1 - forcing.at(&start).f1;
        let r_b = motion.restitution(Side::Bottom).clone();
        let w = motion.g().clone() * t_1.clone() - r_b * v.clone() + gain;
        let t_2 = T::from_integer(2 * i64::from(periods)) - t_1.clone();
        let fix = |time: T, velocity: T, flight: T| OrbitImpact {
            phase: widen(&(time * T::pi())),
            velocity: widen(&velocity),
            time: widen(&flight),
        };
        Some(vec![fix(start, v, t_1), fix(end, w, t_2)])
    }
}

/// The solution of three linear equations, given by columns.
fn cramer<T: Number>(columns: &[[T; 3]], right: &[T; 3]) -> Option<[T; 3]> {
    let [a, b, c] = columns else {
        return None;
    };
    let minor = |x: &[T; 3], y: &[T; 3], i: usize, j: usize| x[i].clone() * y[j].clone() - x[j].clone() * y[i].clone();
    let volume = |x: &[T; 3], y: &[T; 3], z: &[T; 3]| {
        let [p, q, r] = [minor(y, z, 1, 2), minor(y, z, 2, 0), minor(y, z, 0, 1)];
        x[0].clone() * p + x[1].clone() * q + x[2].clone() * r
    };
    let below = volume(a, b, c);
    let above = [volume(right, b, c), volume(a, right, c), volume(a, b, right)];
    Some(above.map(|above| above / below.clone()))
}

/// The errors: relative of velocities and times, in radians of phases.
pub(super) fn errors(found: &[OrbitImpact<Exact>], exact: &[OrbitImpact<Exact>]) -> Vec<f64> {
    let relative = |found: &Exact, exact: &Exact| {
        let apart = found.clone() - exact.clone();
        let is_same = num_traits::Zero::is_zero(&apart);
        if is_same {
            0.0
        } else {
            (apart / exact.clone()).to_f64().abs()
        }
    };
    let around = |apart: Exact| {
        let turn = Exact::pi() + Exact::pi();
        let turns = (apart.to_f64() / turn.to_f64()).round();
        (apart - turn * <Exact as Analytic>::from_f64(turns)).to_f64().abs()
    };
    if found.len() != exact.len() {
        return vec![f64::NAN];
    }
    let pairs = found.iter().zip(exact);
    pairs
        .flat_map(|(found, exact)| {
            [
                around(found.phase.clone() - exact.phase.clone()),
                relative(&found.velocity, &exact.velocity),
                relative(&found.time, &exact.time),
            ]
        })
        .collect()
}

/// The motion near one that was found, by its return map in the number that judges, and how it changes with the
/// parameters.
pub(super) fn known(parameters: [f64; 4], near: &RoundedOrbit) -> Option<Known> {
    let exact = parameters.map(<Exact as Analytic>::from_f64);
    let returns = |[g, d, r_b, r_t]: [Exact; 4]| {
        let motion = Motion::new(g, d, r_b, r_t).ok()?;
        Some(shoot(&motion, near).ok()?.fixes)
    };
    let fixes = returns(exact.clone())?;
    let mut changes = vec![0.0; 3 * fixes.len()];
    for index in 0..exact.len() {
        let mut moved = exact.clone();
        // less, since no restitution may be above 1
        moved[index] *= Exact::from(1.0) - Exact::from(MOVED);
        let errors = errors(&returns(moved)?, &fixes);
        for (change, error) in changes.iter_mut().zip(errors) {
            *change += error / MOVED;
        }
    }
    let condition = largest(changes);
    Some(Known { fixes, condition })
}

fn fixes_of<N>(orbit: &RoundedOrbit<N>, widen: impl Fn(&N) -> Exact) -> Vec<OrbitImpact<Exact>> {
    let lists = orbit.phases.iter().zip(&orbit.velocities).zip(&orbit.times);
    let fix = |((phase, velocity), time): ((&N, &N), &N)| OrbitImpact {
        phase: widen(phase),
        velocity: widen(velocity),
        time: widen(time),
    };
    lists.map(fix).collect()
}

/// The rows of a scene: in each number and form, of all motions the one that falls shortest of what is allowed.
///
/// # Errors
/// `Point` where there is no motion, or one that the return map does not confirm.
pub(super) fn rows(triple: &Triple, scene: &Scene) -> Result<Vec<StressRow>, StressError> {
    let [g, d, r_b, r_t] = scene.parameters;
    let at = |phase: f64| place(&NAMES, &[g, d, r_b, r_t, f64::from(scene.periods), phase]);
    let fault = |phase: f64| StressError::Point {
        case: scene.case,
        at: at(phase),
    };
    let motion = Motion::new(g, d, r_b, r_t).map_err(|_| fault(f64::NAN))?;
    let word = Word::pair();
    let found = find(&motion, &word, scene.periods).map_err(|_| fault(f64::NAN))?;
    let wider = find_as(
        &OutputPrecision::decimals(Decimals(DECIMALS), Rung::Wide(50)),
        &motion,
        &word,
        scene.periods,
    )
    .map_err(|_| fault(f64::NAN))?;
    let mut rows: Vec<StressRow> = Vec::new();
    for (orbit, decimal) in found.orbits.iter().zip(&wider.orbits) {
        if orbit.periods != scene.periods {
            continue;
        }
        let phase = orbit.phases.first().copied().unwrap_or(f64::NAN);
        let known = known(scene.parameters, orbit).ok_or_else(|| fault(phase))?;
        let parsed = |decimal: &Decimal| Exact::parse(&decimal.to_string()).unwrap_or(Exact::INVALID);
        let solved = |fixes: Option<Vec<OrbitImpact<Exact>>>| fixes.unwrap_or_default();
        let periods = scene.periods;
        let made = [
            (
                "f32",
                Form::Printed,
                f64::from(f32::EPSILON),
                solved(triple.solved::<f32>(&motion, periods, &known)),
            ),
            (
                "f64",
                Form::Printed,
                f64::EPSILON,
                solved(triple.solved::<f64>(&motion, periods, &known)),
            ),
            (
                "double-double",
                Form::Printed,
                DoubleDouble::epsilon().to_f64(),
                solved(triple.solved::<DoubleDouble>(&motion, periods, &known)),
            ),
            ("f64", Form::Stable, f64::EPSILON, fixes_of(orbit, widen)),
            ("decimal 30", Form::Stable, 1e-30, fixes_of(decimal, parsed)),
        ];
        for (number, form, epsilon, fixes) in made {
            let error = largest(errors(&fixes, &known.fixes));
            let evaluation = Evaluation::with(number, epsilon, form, error);
            keep_worse(
                &mut rows,
                StressRow::new(scene.case, FORMULA, evaluation, known.condition, at(phase)),
            );
        }
    }
    // a box or a motion that the search says it cannot decide is not claimed to be anything
    let refused =
        |open: &OpenOrbit| StressRow::refused(scene.case, FORMULA, Rung::Double, at(f64::NAN), open.to_string());
    rows.extend(found.open.iter().map(refused));
    if rows.is_empty() {
        Err(fault(f64::NAN))
    } else {
        Ok(rows)
    }
}

/// Of two rows of the same number and form the one that falls shorter of what is allowed.
fn keep_worse(rows: &mut Vec<StressRow>, row: StressRow) {
    let same = |other: &&mut StressRow| other.number == row.number && other.form == row.form;
    match rows.iter_mut().find(same) {
        Some(other) if row.digits - row.allowed < other.digits - other.allowed => *other = row,
        Some(_) => {}
        None => rows.push(row),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn three_equations_are_solved() {
        let columns = [[2.0, 0.0, 1.0], [1.0, 3.0, 0.0], [0.0, 1.0, 4.0]];
        // 2x + y, 3y + z, x + 4z at (1, 2, 3)
        assert_eq!(cramer(&columns, &[4.0, 9.0, 13.0]), Some([1.0, 2.0, 3.0]));
    }

    #[test]
    fn phases_are_compared_around_the_circle_and_all_else_relatively() {
        let fix = |phase: f64, velocity: f64, time: f64| OrbitImpact {
            phase: Exact::from(phase),
            velocity: Exact::from(velocity),
            time: Exact::from(time),
        };
        let turn = 2.0 * std::f64::consts::PI;
        let found = errors(&[fix(1e-3 + turn, 1.0, 2.0)], &[fix(0.0, 1.001, 2.0)]);
        assert!((found[0] - 1e-3).abs() < 1e-12 && (found[1] - 1e-3).abs() < 1e-5);
        assert_eq!(found[2], 0.0);
        assert!(errors(&[], &[fix(0.0, 1.0, 1.0)])[0].is_nan());
    }

    #[test]
    fn a_harmless_scene_has_all_digits_in_both_forms_and_one_without_motions_is_an_error() {
        let triple = Triple::new(&Paper::new().unwrap()).unwrap();
        let scene = |d| Scene {
            case: "harmless",
            parameters: [0.12201, d, 0.5, 0.5],
            periods: 1,
        };
        let found = rows(&triple, &scene(0.4)).unwrap();
        assert_eq!(found.len(), 5);
        for row in &found {
            assert!(row.digits > row.allowed - 1.5, "{row:#?}");
        }
        assert!(matches!(rows(&triple, &scene(40.0)), Err(StressError::Point { .. })));
    }
}
