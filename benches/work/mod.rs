//! The jobs that are timed, each as a closure that does it once: for the benches, and for the table beside other tools.

#![allow(dead_code)] // whoever includes this file times some of them

use std::hint::black_box;
use vibro_audit::accuracy::Latency;
use vibro_audit::claim::{self, Sheet};
use vibro_audit::impact::{Event, Kind, Simulation, Start};
use vibro_audit::model::{Motion, MotionError, Side};
use vibro_audit::number::{Analytic, Interval, Wide};
use vibro_audit::orbit::{
    BifurcationCondition, ConditionedOneOne, OneOneEquations, Orbit, OrbitOptions, Parameters, ProvedOrbit, ProvedRoot,
    isolate_one_one, newton_one_one, newton_one_one_bifurcation,
};
use vibro_audit::prove::{self, Decision, Options};

/// The paper's device at pi/6, where g = 0.1245·9.8/(2·5), with these walls.
pub fn motion(d: f64, r_b: f64, r_t: f64) -> Motion<f64> {
    Motion::new(0.122_01, d, r_b, r_t).expect("a motion")
}

/// Where every figure of the paper starts.
pub fn start() -> Start<f64> {
    Start::impact(Side::Bottom, 6.18, 0.5293)
}

/// L, the latency of one pair by Rust's `sin_cos` or the C library's `sincos`, whichever is less: each argument waits for
/// the last result.
pub fn latency() -> impl FnMut() -> f64 {
    let pair = Latency::measured().pair();
    let mut x = 1.0_f64;
    move || {
        let (sin, cos) = pair(x);
        x = sin + cos + 0.5;
        x
    }
}

/// The paper's device at pi/6, d = 0.4 and r_B = r_T = 0.5, exactly.
pub struct Exactly;

impl Parameters for Exactly {
    fn motion<T: Analytic>(&self) -> Result<Motion<T>, MotionError> {
        let [g, d, half] = [(12_201, 100_000), (2, 5), (1, 2)].map(|(above, below)| T::from_ratio(above, below));
        Motion::new(g, d, half.clone(), half)
    }
}

/// The next impact of one motion.
pub fn impact(r_b: f64, r_t: f64, d: f64) -> impl FnMut() -> Option<Event<f64>> {
    let mut simulation = Simulation::new(&motion(d, r_b, r_t), &start());
    move || simulation.next()
}

/// The gaps of Fig. 3.
pub fn gaps() -> Vec<Motion<f64>> {
    (0..401)
        .map(|index| motion(0.1 + 0.001 * f64::from(index), 0.6, 0.3))
        .collect()
}

/// 500 impacts, through rests; the sum of the velocities, so that nothing is left out.
pub fn run(events: impl Iterator<Item = Event<f64>>) -> f64 {
    let impacts = events.filter(|event| event.kind == Kind::Impact);
    impacts.take(500).map(|event| event.velocity).sum()
}

/// 401 gaps of Fig. 3, 500 impacts of each, on one core.
pub fn sweep() -> impl FnMut() -> f64 {
    let gaps = gaps();
    move || {
        let sums = gaps
            .iter()
            .map(|motion| run(Simulation::new(motion, black_box(&start()))));
        sums.sum()
    }
}

/// (T_1, psi, v, w) of the 1-1 motion of Fig. 2 at d = 0.4, from a start 5% off in T_1 and in the phase.
pub fn orbit() -> impl FnMut() -> Option<[f64; 4]> {
    let balance = OneOneEquations::new(&motion(0.4, 0.5, 0.5), 1);
    // as every peer starts: 1.05 T_1, 0.95 phase
    let (t_1, phase) = (1.05 * 1.116_500_659_3, 0.95 * 0.489_395_114_7);
    let guess = [t_1, phase + std::f64::consts::FRAC_PI_2 * t_1];
    move || {
        let [t_1, middle] = newton_one_one(&balance, black_box(guess))?;
        let [v, w] = balance.velocities(&t_1, &middle);
        Some([t_1, middle, v, w])
    }
}

/// (T_1, psi, d) where the period of the 1-1 motion of Fig. 2 doubles.
pub fn doubling() -> impl FnMut() -> Option<[f64; 3]> {
    let base = motion(0.4, 0.5, 0.5);
    move || {
        let system = ConditionedOneOne {
            family: &base,
            periods: 1,
            condition: BifurcationCondition::MultiplierMinusOne,
            apart: Vec::new(),
        };
        newton_one_one_bifurcation(&system, black_box([1.3, 2.2, 0.26]))
    }
}

/// How many 1-1 motions of one period there are at d = 0.4: all, guaranteed, without a guess and nothing prepared.
pub fn all_orbits() -> impl FnMut() -> usize {
    let enclosed: Motion<Interval<f64>> = Exactly.motion().expect("a motion");
    move || {
        isolate_one_one(black_box(&enclosed), 1, &OrbitOptions::DEFAULT)
            .motions
            .len()
    }
}

/// The stable 1-1 motion at d = 0.4 to 50 digits, with its bound, stability and clearance, from its proved f64 enclosure.
pub fn many_digits() -> impl FnMut() -> Orbit<Wide<50>> {
    let enclosed: Motion<Interval<f64>> = Exactly.motion().expect("a motion");
    let motions = isolate_one_one(&enclosed, 1, &OrbitOptions::DEFAULT).motions;
    let stable = |root: &ProvedRoot<f64, 2>| {
        let orbit = ProvedOrbit::Pair { root, periods: 1 }.orbit::<f64>(&Exactly);
        orbit.is_ok_and(|orbit| orbit.stable)
    };
    let root = motions.into_iter().find(stable).expect("a stable motion");
    move || {
        let proved = ProvedOrbit::Pair {
            root: black_box(&root),
            periods: 1,
        };
        proved.orbit(&Exactly).expect("a motion")
    }
}

/// The paper's sheet with the three misprints of (22) mended.
pub fn mended() -> String {
    claim::EQUATIONS
        .replace(r"[r_B + r_B T_1(f", r"[r_B \epsilon_1 + r_B T_1(f")
        .replace(r"[r_T - r_T T_2(f", r"[r_T \epsilon_2 - r_T T_2(f")
        .replace(
            r"\overline{g} T_1 + \dot{Z}_k r_B'''",
            r"\overline{g} T_1 - \dot{Z}_k r_B'''",
        )
}

/// The proof of (22) as mended, from its premises.
pub fn proof() -> impl FnMut() -> Decision {
    let symbols = claim::vocabulary().expect("the embedded vocabulary");
    let sheet = Sheet::read(&mended(), &symbols).expect("the mended sheet");
    let position = sheet.find("22").expect("an equation of the paper");
    let options = Options::default();
    move || prove::decide(&sheet, black_box(position), &options)
}
