//! The motion at a bifurcation: located to the last digit, and what a table says of it.

use crate::model::{Motion, Side};
use crate::number::{Analytic, Endpoint, Field, Interval, Rung, Telling, Told};
use crate::orbit::bifurcation::one_one::LocatedBifurcation;
use crate::orbit::equations::conditions::{BifurcationKind, Condition};
use crate::orbit::equations::one_one::OneOneEquations;
use crate::orbit::equations::one_one_bifurcations::{Conditioned, Symmetric, Touching};
use crate::orbit::equations::square_system::SquareSystem;
use crate::orbit::family::Family;
use crate::orbit::inconclusive::{Inconclusive, Property};
use crate::orbit::interval_box::IntervalBox;
use crate::orbit::orbit::{OrbitImpact, clearance, reduced};
use crate::orbit::rounding::larger;
use crate::orbit::solve::krawczyk::{ProvedRoot, sharpen};
use num_dual::DualNum;
use num_traits::One;

/// Where an impact has velocity 0, a flight starts and ends on the wall itself. Its turning points are told with this
/// velocity instead, towards the wall: of the motions on the side on which there are any.
pub(crate) const SLOWLY: f64 = 1e-14;

/// And the clearance is that of the event itself within this: turning points follow the velocity with slopes of some
/// units.
const NEARLY: f64 = 1e-12;

/// And the flight before is followed until so long before it ends, where it has a velocity.
pub(crate) const SHORTLY: f64 = 1e-9;

/// A bifurcation of a 1-1 motion, as numbers: a row of a table.
#[derive(Clone, Debug, PartialEq)]
pub struct Instant<N = f64> {
    /// What happens.
    pub event: BifurcationKind,
    /// n
    pub periods: u32,
    /// The value of the swept parameter.
    pub parameter: N,
    /// The gap.
    pub d: N,
    /// Of the impacts at the bottom and at the top, in [0, 2 pi).
    pub phases: [N; 2],
    /// Just before each.
    pub velocities: [N; 2],
    /// Of the flight after each.
    pub times: [N; 2],
    /// Of the derivative of the map; infinite where an impact has velocity 0.
    pub trace: N,
    /// The least distance from a wall at the turning points strictly inside the flights, 0 at a touch; infinite
    /// where nothing turns.
    pub clearance: N,
    /// Whether the ball keeps between the walls, the touch itself allowed.
    pub admissible: bool,
    /// No parameter, gap, phase, velocity or time above is farther than this from the exact one. `None` where an
    /// enclosure is too wide for the figures of a decimal.
    pub error_bound: Option<N>,
    /// The number type whose enclosures these are of.
    pub computed_in: Rung,
}

impl<N: Told> Instant<N> {
    /// The same in f64.
    pub fn nearest(&self) -> Instant {
        let pair = |values: &[N; 2]| values.each_ref().map(Told::to_f64);
        Instant {
            event: self.event,
            periods: self.periods,
            parameter: self.parameter.to_f64(),
            d: self.d.to_f64(),
            phases: pair(&self.phases),
            velocities: pair(&self.velocities),
            times: pair(&self.times),
            trace: self.trace.to_f64(),
            clearance: self.clearance.to_f64(),
            admissible: self.admissible,
            error_bound: self.error_bound.as_ref().map(Told::to_f64),
            computed_in: self.computed_in,
        }
    }
}

/// A bifurcation of which every value is an enclosure; see [`Instant`] for what they are.
#[derive(Clone, Debug, PartialEq)]
pub struct EnclosedBifurcation<E: Endpoint> {
    event: BifurcationKind,
    periods: u32,
    parameter: Interval<E>,
    d: Interval<E>,
    phases: [Interval<E>; 2],
    velocities: [Interval<E>; 2],
    times: [Interval<E>; 2],
    /// `None` where it is infinite.
    trace: Option<Interval<E>>,
    /// `None` where nothing turns.
    clearance: Option<Interval<E>>,
    admissible: bool,
}

impl<E: Endpoint> EnclosedBifurcation<E> {
    /// As `telling` has it.
    pub fn told<T: Telling<E>>(&self, telling: &T) -> Instant<T::Number> {
        let tell = |values: &[Interval<E>; 2]| values.each_ref().map(|value| telling.tell(value));
        let or_infinite =
            |value: &Option<Interval<E>>| value.as_ref().map_or_else(Told::infinite, |value| telling.tell(value));
        let columns = [&self.phases, &self.velocities, &self.times].into_iter().flatten();
        let bounded: Vec<&Interval<E>> = columns.chain([&self.parameter, &self.d]).collect();
        let errors = bounded.iter().map(|value| telling.error(&telling.tell(value), value));
        let error = errors.fold(E::zero(), larger);
        // the clearance beside an impact of velocity 0 has twelve figures in any number
        let known = bounded.into_iter().chain(&self.trace).all(|value| telling.holds(value));
        Instant {
            event: self.event,
            periods: self.periods,
            parameter: telling.tell(&self.parameter),
            d: telling.tell(&self.d),
            phases: tell(&self.phases),
            velocities: tell(&self.velocities),
            times: tell(&self.times),
            trace: or_infinite(&self.trace),
            clearance: or_infinite(&self.clearance),
            admissible: self.admissible,
            error_bound: known.then(|| telling.bound(error)),
            computed_in: E::rung(),
        }
    }
}

impl LocatedBifurcation {
    /// The event over `E`, proved again and located as well as `E` can.
    ///
    /// # Errors
    /// `Undecided` where `E` is too narrow.
    pub fn settle<E: Endpoint>(
        &self,
        family: &impl Family,
        periods: u32,
    ) -> Result<EnclosedBifurcation<E>, Inconclusive>
    where
        Interval<E>: DualNum,
    {
        let [t_1, middle, parameter] = self.refined::<E>(family, periods)?;
        let open = |what| Inconclusive::Undecided { what };
        let motion = family.motion_at(&parameter).map_err(|_| open(Property::Direction))?;
        let balance = OneOneEquations::new(&motion, periods);
        let phases = balance.phases(&t_1, &middle).map(|phase| reduced(&phase));
        let velocities = balance.velocities(&t_1, &middle);
        let times = [t_1.clone(), balance.total() - t_1.clone()];
        let (clearance, admissible) = self.kept(&motion, &phases, &velocities, &times)?;
        Ok(EnclosedBifurcation {
            event: self.event(),
            periods,
            d: motion.d().clone(),
            trace: self.trace(&balance, &t_1, &middle),
            parameter,
            phases,
            velocities,
            times,
            clearance,
            admissible,
        })
    }

    /// (T_1, psi, parameter) over `E`.
    fn refined<E: Endpoint>(&self, family: &impl Family, periods: u32) -> Result<IntervalBox<E, 3>, Inconclusive>
    where
        Interval<E>: DualNum,
    {
        let line = || Interval::from_integer(i64::from(periods));
        let on_line = |[middle, parameter]: IntervalBox<E, 2>| [line(), middle, parameter];
        let refined = match self {
            Self::Condition(condition, root) => {
                let condition = *condition;
                let apart = Vec::new();
                let system = Conditioned {
                    family,
                    periods,
                    condition,
                    apart,
                };
                prove_over(&system, root)
            }
            Self::Touch(touch, root) => {
                let touch = *touch;
                let system = Touching { family, periods, touch };
                prove_over(&system, root).map(|[t_1, middle, parameter, _]| [t_1, middle, parameter])
            }
            Self::Crossing(root) | Self::Turn(root) => prove_over(&Symmetric { family, periods }, root).map(on_line),
        };
        refined.ok_or(Inconclusive::Undecided {
            what: Property::Existence,
        })
    }

    /// The clearance, and whether the motion keeps between the walls.
    fn kept<E: Endpoint>(
        &self,
        motion: &Motion<Interval<E>>,
        phases: &[Interval<E>; 2],
        velocities: &[Interval<E>; 2],
        times: &[Interval<E>; 2],
    ) -> Result<(Option<Interval<E>>, bool), Inconclusive> {
        let sides = [Side::Bottom, Side::Top];
        let mut fixes: [OrbitImpact<Interval<E>>; 2] = std::array::from_fn(|i| OrbitImpact {
            phase: phases[i].clone(),
            velocity: velocities[i].clone(),
            time: times[i].clone(),
        });
        if let Self::Condition(Condition::SlowImpact(_), _) = self {
            // both impacts at once, where the motion is its own mirror image
            for slow in [0, 1].into_iter().filter(|&impact| velocities[impact].contains_zero()) {
                fixes[slow].velocity = Interval::from_f64(sides[slow].sign() * SLOWLY);
                fixes[1 - slow].time -= Interval::from_f64(SHORTLY);
            }
        }
        let Some(mut clearance) = clearance(&sides, motion, &fixes)? else {
            return Ok((None, true));
        };
        if matches!(self, Self::Condition(Condition::SlowImpact(_), _)) {
            clearance += Interval::new(E::from_f64(-NEARLY), E::from_f64(NEARLY));
        }
        // without loss an impact of velocity 0 is a contact of its reflection in time too; without gravity a ball with two of
        // them stands still while the capsule moves, and touches whenever that turns
        let kept = motion.restitution(Side::Bottom).clone() * motion.restitution(Side::Top).clone();
        let has_loss = (Interval::one() - kept).is_positive();
        let stands = motion.g().contains_zero() && velocities.iter().all(Interval::contains_zero);
        let touches = match self {
            Self::Touch(..) => true,
            Self::Condition(Condition::SlowImpact(_), _) => {
                (stands || !has_loss) && clearance.magnitude().to_f64() <= 2.0 * NEARLY
            }
            _ => false,
        };
        if touches && clearance.contains_zero() {
            return Ok((Some(Interval::from_integer(0)), true));
        }
        if clearance.contains_zero() {
            let what = Property::Clearance;
            return Err(Inconclusive::Undecided { what });
        }
        let positive = clearance.is_positive();
        Ok((Some(clearance), positive))
    }

    /// `None` where it is infinite.
    fn trace<E: Endpoint>(
        &self,
        balance: &OneOneEquations<Interval<E>>,
        t_1: &Interval<E>,
        middle: &Interval<E>,
    ) -> Option<Interval<E>> {
        let sum = Interval::one() + balance.determinant();
        let twice = Interval::from_integer(2) * balance.loss_factor();
        Some(match self {
            Self::Condition(Condition::MultiplierMinusOne, _) => -sum,
            Self::Condition(Condition::DoublePositive, _) => twice,
            Self::Condition(Condition::DoubleNegative, _) => -twice,
            Self::Condition(Condition::SlowImpact(_), _) => return None,
            Self::Touch(..) => {
                let [v, w] = balance.scaled_velocities(t_1, middle);
                let zero = Interval::from_integer(0);
                balance.trace_above(&zero, t_1, middle) / (v * w)
            }
            _ => sum,
        })
    }
}

/// The root over `E`, proved again there: the only one in the box that `F` proved.
///
/// `None` where no box around it proves it.
pub fn prove_over<F: Endpoint, E: Endpoint, const D: usize>(
    system: &impl SquareSystem<E, D>,
    root: &ProvedRoot<F, D>,
) -> Option<IntervalBox<E, D>> {
    let proved = sharpen(system, root.enclosure.each_ref().map(|side| carried(&side.midpoint())))?;
    let known = |side: &Interval<F>| Interval::new(carried(&side.low()), carried(&side.high()));
    // one solution in the new box, and it lies where the old one is the only one: the same
    let mut sides = proved.enclosure.iter().zip(&root.unique);
    sides
        .all(|(side, unique)| side.is_subset(&known(unique)))
        .then_some(proved.enclosure)
}

/// A number in another type, to some thirty digits.
fn carried<F: Endpoint, E: Endpoint>(number: &F) -> E {
    let high = number.to_f64();
    let low = (number.clone() - F::from_f64(high)).to_f64();
    E::from_f64(high) + E::from_f64(low)
}
