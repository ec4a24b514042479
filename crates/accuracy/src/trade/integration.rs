//! A flight integrated adaptively, as one does who does not know its closed form.

use differential_equations::prelude::{
    ControlFlag, ExplicitRungeKutta, IVP, Interpolation, ODE, Solout, Solution, Status,
};
use dynamics::model::{Flight, Side};
use numbers::{Analytic, Machine};
use roots::{SimpleConvergency, find_root_brent};

/// Place and velocity since the start.
type State = [f64; 2];

/// The right side, evaluated in `T`; the crate integrates in f64.
struct Fall<T> {
    /// g, and the phase of the forcing at the start.
    g: T,
    phase: T,
}

impl<T: Analytic> ODE<f64, State> for Fall<T> {
    fn diff(&self, time: f64, state: &State, slope: &mut State) {
        let phase = T::pi() * T::from_f64(time) + self.phase.clone();
        let (_, cos) = phase.sincos();
        *slope = [state[1], (cos + self.g.clone()).to_f64()];
    }
}

/// Stops where the ball is behind a wall.
struct Walls {
    top: f64,
    bottom: f64,
}

impl Walls {
    fn behind(&self, state: &State) -> f64 {
        (state[0] - self.bottom).max(self.top - state[0])
    }
}

/// Of the time at which the dense output meets the wall.
const LOCATED: f64 = 1e-15;

impl Solout<f64, State> for Walls {
    fn solout<I>(
        &mut self,
        time: f64,
        before: f64,
        state: &State,
        _: &State,
        dense: &mut I,
        solution: &mut Solution<f64, State>,
    ) -> ControlFlag<f64, State>
    where
        I: Interpolation<f64, State> + ?Sized,
    {
        if time <= before || self.behind(state) <= 0.0 {
            return ControlFlag::Continue;
        }
        let mut at = |time: f64| dense.interpolate(time).unwrap_or([f64::NAN; 2]);
        // the start itself is on a wall
        let inside = before.max(LOCATED);
        let mut convergency = SimpleConvergency {
            eps: LOCATED,
            max_iter: 100,
        };
        let found = find_root_brent(inside, time, |time| self.behind(&at(time)), &mut convergency);
        let Ok(met) = found else {
            return ControlFlag::Continue;
        };
        let state = at(met);
        solution.push(met, state);
        ControlFlag::Terminate
    }
}

/// Time and velocity of the impact that ends a flight, by the pair of Dormand and Prince of orders 8, 5 and 3 with its
/// dense output (DOP853; E. Hairer, S. P. Nørsett, G. Wanner, 1993, "Solving Ordinary Differential Equations I", II.5),
/// its steps chosen for this tolerance, relative and absolute. `None` where it comes to none before the time `until`: a
/// wall touched and left within a step is missed.
///
/// The events of the crate are not used: where they are located they are off by more than the tolerance.
pub(super) fn by_integration<T: Machine>(
    flight: &Flight<T>,
    [g, phase]: [&T; 2],
    until: f64,
    tolerance: f64,
) -> Option<Vec<T>> {
    let [top, bottom] = [Side::Top, Side::Bottom].map(|side| flight.target(side).to_f64());
    let fall = Fall {
        g: g.clone(),
        phase: phase.clone(),
    };
    let launch = flight.state(&T::zero()).velocity.to_f64();
    let method = ExplicitRungeKutta::dop853().rtol(tolerance).atol(tolerance);
    let solution = IVP::ode(&fall, 0.0, until, [0.0, launch])
        .solout(Walls { top, bottom })
        .method(method)
        .solve()
        .ok()?;
    let is_found = solution.status == Status::Interrupted;
    let (time, state) = solution.t.last().zip(solution.y.last()).filter(|_| is_found)?;
    Some([*time, state[1]].map(<T as Analytic>::from_f64).to_vec())
}
