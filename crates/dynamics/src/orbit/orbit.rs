//! A periodic motion of which every value is an enclosure.

use crate::model::{Motion, Side};
use crate::orbit::clearance::{OrbitFlight, least};
use crate::orbit::equations::flight::{LaunchedFlight, OrbitImpact};
use crate::orbit::inconclusive::{Inconclusive, Property, undecided};
use crate::orbit::stability::{FlightJacobian, Multiplier, OrbitKind, determinant, loss_factor, multipliers, trace};
use crate::orbit::word::Word;
use numbers::{Analytic, Endpoint, Field, Interval};

/// A periodic motion: its impacts, its stability and whether it keeps off the walls between them.
///
/// Every interval holds the exact value for every motion within the intervals of the parameters; what is no
/// interval was decided from intervals. That rests on the fixes given, see `certified`.
#[derive(Clone, Debug, PartialEq)]
pub struct Orbit<E: Endpoint> {
    /// Its impacts in the order of the lists below: from a bottom impact that follows a top one, of several the
    /// fastest; on one wall, from the fastest. Which one that is where two are equally fast is left to rounding.
    pub word: Word,
    /// n: the forcing periods it takes. The times add up to 2 n.
    pub periods: u32,
    /// Of each impact, reduced: the middle of each lies in [0, 2 pi).
    pub phases: Vec<Interval<E>>,
    /// Just before each impact.
    pub velocities: Vec<Interval<E>>,
    /// Of the flight after each impact.
    pub times: Vec<Interval<E>>,
    /// Of the derivative of the map over the whole motion.
    pub trace: Interval<E>,
    /// Its determinant, the product of r² over the impacts.
    pub determinant: Interval<E>,
    /// Its eigenvalues, see [`multipliers`].
    pub multipliers: [Multiplier<Interval<E>>; 2],
    /// Node, focus or saddle.
    pub kind: OrbitKind,
    /// Whether it attracts: |trace| < 1 + determinant < 2. Where every restitution is 1 the determinant is 1 and
    /// nothing attracts.
    pub stable: bool,
    /// The least distance from a wall at the turning points strictly inside the flights, negative beyond the wall;
    /// `None` where no flight turns.
    pub clearance: Option<Interval<E>>,
    /// Whether the ball keeps between the walls: the clearance is positive, or nothing turns.
    pub admissible: bool,
    /// Whether the fixes were proved to enclose a motion, and one only. Without a proof the intervals enclose
    /// nothing, and are the best guess.
    pub certified: bool,
}

impl<E: Endpoint> Orbit<E> {
    /// The orbit whose impacts `fixes` enclose, in the order of `word` or of a rotation of it that may start a word.
    /// The caller has proved that they enclose a motion.
    ///
    /// # Errors
    /// `Undecided` where a wider number is needed; `Backwards` and `Timeless` where there certainly is no such
    /// motion; `Count`.
    pub fn from_impacts(
        word: &Word,
        periods: u32,
        motion: &Motion<Interval<E>>,
        fixes: &[OrbitImpact<Interval<E>>],
    ) -> Result<Self, Inconclusive> {
        let (wanted, found) = (word.impacts(), fixes.len());
        if wanted != found {
            return Err(Inconclusive::Count { wanted, found });
        }
        check_signs(word, fixes)?;
        let first = first_of(word, fixes);
        let word = word.rotated(first);
        let fixes: Vec<_> = fixes.iter().cycle().skip(first).take(found).cloned().collect();

        let sides: Vec<Side> = word.sides().collect();
        let links = flight_jacobians(&sides, motion, &fixes);
        let (trace, determinant) = (trace(&links), determinant(&links));
        let kind = kind(&trace, &determinant)?;
        let damped = is_damped(&links)?;

        let clearance = clearance(&sides, motion, &fixes)?;
        let admissible = match &clearance {
            None => true,
            Some(clearance) if clearance.is_positive() => true,
            Some(clearance) if clearance.is_negative() => false,
            Some(_) => return undecided(Property::Clearance),
        };
        let values = |value: fn(&OrbitImpact<Interval<E>>) -> Interval<E>| fixes.iter().map(value).collect();
        Ok(Self {
            phases: values(|fix| reduced(&fix.phase)),
            velocities: values(|fix| fix.velocity.clone()),
            times: values(|fix| fix.time.clone()),
            multipliers: multipliers(&trace, &loss_factor(&links), kind),
            stable: damped && kind != OrbitKind::Saddle,
            certified: true,
            word,
            periods,
            trace,
            determinant,
            kind,
            clearance,
            admissible,
        })
    }

    /// The same without the claim that the fixes were proved to enclose a motion.
    pub fn uncertified(self) -> Self {
        let certified = false;
        Self { certified, ..self }
    }
}

/// `phase` less whole turns.
pub(crate) fn reduced<E: Endpoint>(phase: &Interval<E>) -> Interval<E> {
    let turn = Interval::<E>::pi() + Interval::pi();
    let turns = (phase.to_f64() / turn.to_f64()).floor();
    let mut phase = match turns == 0.0 {
        true => phase.clone(), // a difference would be rounded outward for nothing
        false => phase.clone() - turn.clone() * Interval::from_f64(turns),
    };
    // the quotient is rounded, which matters next to a whole turn
    if phase.to_f64() < 0.0 {
        phase += turn.clone();
    }
    if (phase.clone() - turn.clone()).to_f64() >= 0.0 {
        phase -= turn;
    }
    phase
}

fn check_signs<E: Endpoint>(word: &Word, fixes: &[OrbitImpact<Interval<E>>]) -> Result<(), Inconclusive> {
    for (impact, (side, fix)) in word.sides().zip(fixes).enumerate() {
        let towards = side.signed(fix.velocity.clone());
        if (-towards.clone()).low() >= E::zero() {
            return Err(Inconclusive::Backwards { impact });
        }
        if fix.time.high() <= E::zero() {
            return Err(Inconclusive::Timeless { impact });
        }
        if !towards.is_positive() {
            return undecided(Property::Direction);
        }
        if !fix.time.is_positive() {
            return undecided(Property::Order);
        }
    }
    Ok(())
}

/// The index of the fastest impact that may stand first.
pub(crate) fn first_of<E: Endpoint>(word: &Word, fixes: &[OrbitImpact<Interval<E>>]) -> usize {
    let sides: Vec<Side> = word.sides().collect();
    let speed = |index: usize| sides[index].signed(fixes[index].velocity.clone());
    let starts = (0..word.impacts()).filter(|index| word.may_start_at(*index));
    let fastest = starts.reduce(|best, index| {
        let faster = (speed(index) - speed(best)).to_f64() > 0.0;
        if faster { index } else { best }
    });
    fastest.unwrap_or(0)
}

/// The least distance from a wall over the turning points of all flights, see [`Orbit::clearance`].
///
/// # Errors
/// `Undecided` where a flight turns within rounding of one of its ends.
pub(crate) fn clearance<E: Endpoint>(
    sides: &[Side],
    motion: &Motion<Interval<E>>,
    fixes: &[OrbitImpact<Interval<E>>],
) -> Result<Option<Interval<E>>, Inconclusive> {
    let mut nearest = None;
    for (side, fix) in sides.iter().zip(fixes) {
        let path = OrbitFlight {
            flight: LaunchedFlight::after(motion, *side, fix),
            time: fix.time.clone(),
        };
        nearest = least(nearest, path.clearance()?);
    }
    Ok(nearest)
}

/// What the derivative of a periodic motion is made of: a link for each impact, at the wall of `sides`, and the flight
/// after it; the last flight ends at the first impact.
pub fn flight_jacobians<T: Analytic>(
    sides: &[Side],
    motion: &Motion<T>,
    fixes: &[OrbitImpact<T>],
) -> Vec<FlightJacobian<T>> {
    let pushes: Vec<_> = fixes.iter().map(|fix| motion.push(&fix.phase)).collect();
    let link = |(index, side): (usize, &Side)| {
        let next = (index + 1) % fixes.len();
        FlightJacobian {
            restitution: motion.restitution(*side).clone(),
            velocity: fixes[index].velocity.clone(),
            time: fixes[index].time.clone(),
            push: pushes[index].clone(),
            pull: pushes[next].clone(),
            arrival: fixes[next].velocity.clone(),
        }
    };
    sides.iter().enumerate().map(link).collect()
}

fn kind<E: Endpoint>(trace: &Interval<E>, determinant: &Interval<E>) -> Result<OrbitKind, Inconclusive> {
    let apart = trace.square() - Interval::from_integer(4) * determinant.clone();
    if apart.is_negative() {
        return Ok(OrbitKind::Focus);
    }
    let level = Interval::from_integer(1) + determinant.clone();
    let [above, below] = [trace.clone() - level.clone(), -trace.clone() - level];
    if above.is_positive() || below.is_positive() {
        return Ok(OrbitKind::Saddle);
    }
    if apart.is_positive() && above.is_negative() && below.is_negative() {
        return Ok(OrbitKind::Node);
    }
    undecided(Property::Kind)
}

/// Whether some restitution is below 1, so that the determinant is.
fn is_damped<E: Endpoint>(links: &[FlightJacobian<Interval<E>>]) -> Result<bool, Inconclusive> {
    let losses = links
        .iter()
        .map(|link| Interval::<E>::from_integer(1) - link.restitution.clone());
    let losses: Vec<_> = losses.collect();
    if losses.iter().any(Interval::is_positive) {
        return Ok(true);
    }
    let none = losses.iter().all(|loss| loss.magnitude() == E::zero());
    if none { Ok(false) } else { undecided(Property::Damping) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::orbit::equations::words::WordEquations;
    use crate::orbit::options::OrbitOptions;
    use crate::orbit::solve::words::search_word;
    use std::f64::consts::TAU;

    type Line = Interval<f64>;

    fn motion(g: i64, d: i64, r_b: i64, r_t: i64) -> Motion<Line> {
        let [d, r_b, r_t] = [d, r_b, r_t].map(|hundredths| Line::from_ratio(hundredths, 100));
        Motion::new(Line::from_ratio(g, 100_000), d, r_b, r_t).expect("a motion")
    }

    fn pair(d: i64, r_b: i64, r_t: i64) -> Orbit<f64> {
        let motion = motion(12_201, d, r_b, r_t);
        let found = search_word(&Word::pair(), 1, &motion, &OrbitOptions::DEFAULT).expect("a search");
        found[0].orbit(&motion).expect("decided")
    }

    fn fixes(orbit: &Orbit<f64>) -> Vec<OrbitImpact<Line>> {
        let impacts = orbit.phases.iter().zip(&orbit.velocities).zip(&orbit.times);
        let fix = |((phase, velocity), time): ((&Line, &Line), &Line)| OrbitImpact {
            phase: *phase,
            velocity: *velocity,
            time: *time,
        };
        impacts.map(fix).collect()
    }

    #[test]
    fn a_printed_orbit_has_its_trace_determinant_and_kind() {
        let orbit = pair(40, 50, 50);
        assert!(orbit.trace.contains(&orbit.rounded().trace) && (orbit.rounded().trace + 0.371_267_776).abs() < 1e-9);
        assert!(orbit.determinant.contains(&0.0625) && orbit.kind == OrbitKind::Focus && orbit.stable);
        let [up, down] = orbit.multipliers;
        assert!((up.re + down.re - orbit.trace).contains_zero() && up.im.is_positive() && down.im.is_negative());
    }

    #[test]
    fn listed_from_anywhere_and_turns_later_it_is_the_same_orbit() {
        let motion = motion(12_201, 26, 60, 30);
        let word: Word = "BTT".parse().expect("a word");
        let found = search_word(&word, 1, &motion, &OrbitOptions::DEFAULT).expect("a search");
        let orbit = found[0].orbit(&motion).expect("decided");
        let mut later = fixes(&orbit);
        for fix in &mut later {
            fix.phase += Line::from_integer(6) * Line::pi();
        }
        let again = Orbit::from_impacts(&word, 1, &motion, &later).expect("decided");
        for (one, other) in orbit.phases.iter().zip(&again.phases) {
            assert!(one.intersection(other).is_some() && (0.0..TAU).contains(&other.midpoint()));
        }
        assert_eq!(
            (orbit.kind, orbit.velocities, orbit.word),
            (again.kind, again.velocities, again.word)
        );
    }

    #[test]
    fn of_several_starts_the_fastest_is_first() {
        let motion = motion(12_201, 25, 60, 30);
        let word: Word = "BTBT".parse().expect("a word");
        let found = search_word(&word, 2, &motion, &OrbitOptions::DEFAULT).expect("a search");
        let orbit = found[0].orbit(&motion).expect("decided");
        assert!((orbit.velocities[0] - orbit.velocities[2]).is_positive());
        let mut turned = fixes(&orbit);
        turned.rotate_left(2);
        let again = Orbit::from_impacts(&word, 2, &motion, &turned).expect("decided");
        assert_eq!((again.velocities, again.times), (orbit.velocities, orbit.times));
    }

    #[test]
    fn what_is_no_motion_says_why() {
        let motion = motion(12_201, 40, 50, 50);
        let orbit = pair(40, 50, 50);
        let checked = |fixes: &[OrbitImpact<Line>]| Orbit::from_impacts(&Word::pair(), 1, &motion, fixes);
        let good = fixes(&orbit);
        assert_eq!(checked(&good), Ok(orbit.clone()));
        assert_eq!(checked(&good[..1]), Err(Inconclusive::Count { wanted: 2, found: 1 }));
        let changed = |change: fn(&mut OrbitImpact<Line>)| {
            let mut fixes = good.clone();
            change(&mut fixes[1]);
            checked(&fixes)
        };
        let backwards = changed(|fix| fix.velocity = -fix.velocity);
        assert_eq!(backwards, Err(Inconclusive::Backwards { impact: 1 }));
        let at_rest = changed(|fix| fix.velocity = Line::point(0.0));
        assert_eq!(at_rest, Err(Inconclusive::Backwards { impact: 1 }));
        let timeless = changed(|fix| fix.time = Line::point(0.0));
        assert_eq!(timeless, Err(Inconclusive::Timeless { impact: 1 }));
        let undecided = |what| Err(Inconclusive::Undecided { what });
        let wide = changed(|fix| fix.velocity = Line::new(-1.0, 1.0));
        assert_eq!(wide, undecided(Property::Direction));
        let wide = changed(|fix| fix.time = Line::new(-1.0, 1.0));
        assert_eq!(wide, undecided(Property::Order));
        let wide = changed(|fix| fix.velocity = Line::new(-0.9, -0.2));
        assert_eq!(wide, undecided(Property::Kind));
    }

    #[test]
    fn without_a_loss_nothing_attracts() {
        let [g, d, r] = [0.12201, 0.3, 1.0].map(Line::point);
        let motion = Motion::new(g, d, r, r).expect("a motion");
        let found = search_word(&Word::pair(), 1, &motion, &OrbitOptions::DEFAULT).expect("a search");
        let orbits: Vec<_> = found
            .iter()
            .map(|cycle| cycle.orbit(&motion).expect("decided"))
            .collect();
        assert!(orbits.iter().any(|orbit| orbit.kind == OrbitKind::Focus));
        assert!(
            orbits
                .iter()
                .all(|orbit| !orbit.stable && orbit.determinant.contains(&1.0))
        );
    }

    #[test]
    fn a_phase_is_brought_into_one_turn() {
        for phase in [0.0, 1.0, TAU, -1e-20, -1.0, 100.0, -100.0, 1e-300] {
            let found = reduced(&Line::point(phase));
            assert!((0.0..TAU + 1e-15).contains(&found.midpoint()), "{phase}: {found}");
            assert!((found.midpoint().cos() - phase.cos()).abs() < 1e-13);
        }
    }

    #[test]
    fn enclosures_hold_the_equations_in_every_number() {
        let motion = motion(12_201, 33, 60, 30);
        let orbit = pair(33, 60, 30);
        let system = WordEquations {
            motion,
            word: Word::pair(),
            periods: 1,
        };
        let residuals = system.residuals(&orbit.phases);
        assert!(residuals.iter().all(Interval::contains_zero));
    }
}
