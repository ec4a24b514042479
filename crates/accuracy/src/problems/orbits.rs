//! Periodic motions: proved enclosures, confirmed by the return map.

use super::problem::{Given, Problem};
use super::values::{Number, Values, read};
use super::{Means, Why};
use dynamics::model::Parameters;
use dynamics::orbit::{
    FoundOrbits, OrbitOptions, OutputPrecision, ProvedOrbit, RoundedOrbit, Word, confirm_orbit, find, find_as,
    isolate_one_one, search_word,
};
use numbers::{Decimal, Decimals, Interval, Rung, Told};
use std::f64::consts::{PI, TAU};

/// The figures in which enclosures are told.
const FIGURES: Decimals = Decimals(44);

/// What the answers rest on.
pub const MEANS: [&str; 2] = ["proved enclosure", "return map in 100 digits"];

/// The motion by both means.
pub fn twice(problem: &Problem) -> Result<[RoundedOrbit<Decimal>; 2], Why> {
    let given = problem.given()?;
    let (word, periods) = problem.word()?;
    let orbit = nearest(
        problem,
        find_as(
            &OutputPrecision::decimals(FIGURES, Rung::Wide(50)),
            &given,
            &word,
            periods,
        )?,
    )?;
    if orbit.error_bound.is_none() {
        return Err(Why::Unproved);
    }
    let again = confirm_orbit(&given, &orbit, FIGURES)?;
    Ok([orbit, again])
}

/// The quantities by both means.
pub fn both(problem: &Problem) -> Result<[Values<Number>; 2], Why> {
    Ok(twice(problem)?.map(|orbit| values(&orbit).convert(|decimal| read(&decimal))))
}

fn values<N: Clone>(orbit: &RoundedOrbit<N>) -> Values<N> {
    let lists = [&orbit.phases[..], &orbit.velocities, &orbit.times];
    Values::of_cycle(lists, orbit.trace.clone())
}

/// The motion in f64.
pub fn in_f64(problem: &Problem, means: Means) -> Result<RoundedOrbit, Why> {
    let given = problem.given()?;
    let (word, periods) = problem.word()?;
    match means {
        Means::Default => nearest(problem, find(&given, &word, periods)?),
        Means::Double => {
            let all = narrow(&given, &word, periods)?;
            nearest(problem, FoundOrbits::from_orbits(all))
        }
    }
}

/// The quantities in f64.
pub fn solved(problem: &Problem, means: Means) -> Result<Values<f64>, Why> {
    Ok(values(&in_f64(problem, means)?))
}

/// The motions in intervals of f64 and nothing wider: the middles.
fn narrow(given: &Given, word: &Word, periods: u32) -> Result<Vec<RoundedOrbit>, Why> {
    let motion = given.motion::<Interval<f64>>()?;
    let orbit = |proved: ProvedOrbit| proved.orbit::<f64>(given).ok().map(|orbit| orbit.rounded());
    Ok(if *word == Word::pair() {
        let roots = isolate_one_one(&motion, periods, &OrbitOptions::DEFAULT).motions;
        let pairs = roots.iter().map(|root| ProvedOrbit::Pair { root, periods });
        pairs.filter_map(orbit).collect()
    } else {
        let cycles = search_word(word, periods, &motion, &OrbitOptions::DEFAULT)?;
        cycles.iter().map(ProvedOrbit::Word).filter_map(orbit).collect()
    })
}

/// The motion that the problem means: of those over its periods, the one whose first impact is nearest to its start.
fn nearest<N: Told>(problem: &Problem, found: FoundOrbits<N>) -> Result<RoundedOrbit<N>, Why> {
    let start = problem.begin()?;
    let [phase, velocity] = [&start.phase, &start.velocity].map(dynamics::model::Exact::value::<f64>);
    let (_, periods) = problem.word()?;
    let away = |orbit: &RoundedOrbit<N>| {
        let turned = orbit.phases[0].to_f64() - phase;
        let around = (turned + PI).rem_euclid(TAU) - PI;
        around.hypot(orbit.velocities[0].to_f64() - velocity)
    };
    let own = found.orbits.into_iter().filter(|orbit| orbit.periods == periods);
    own.min_by(|one, other| away(one).total_cmp(&away(other)))
        .ok_or(Why::NoOrbit)
}
