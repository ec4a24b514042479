//! The equations of a 1-1 motion, without a denominator that can vanish.
//!
//! Unknown are T_1 and the phase psi of the forcing halfway through the flight from bottom to top. With
//! h = pi T_1 / 2, P = sin psi, Q = cos psi, F_1 and F_2 change over that flight by 2 Q sin(h)/pi and
//! 2 P sin(h)/pi², and over the flight back, T_2 = 2 n - T_1, by the opposite. (9) to (13) are then linear in the
//! velocities v at the bottom, w at the top, and in P and Q:
//!
//! - (9) + (11): (1 + r_B) v + (1 + r_T) w = 2 n g
//! - (9):        r_B v + w = g T_1 + 2 Q sin(h)/pi
//! - (10), (9):  a = T_1 (r_B v - w) = 2 (d - P kappa/pi), kappa = T_1 cos h - (2/pi) sin h
//! - (10) + (12), (9), (11): T_1 (r_B v - w) + T_2 (r_T w - v) + 4 n P cos(h)/pi = 0
//!
//! The first and the third always give v and w: their determinant is N = 1 + 2 r_B + r_B r_T, never 0. Put into the
//! second and the fourth, times N T_1, they leave, with rho = r_B r_T and K = N T_1 - (1 + 2 r_T + rho) T_2,
//!
//! - h_1 = (1 - rho) a - T_1 [4 n g r_B - N (g T_1 + 2 Q sin(h)/pi)]
//! - h_2 = K a - T_1 [2 n g (1 - rho) T_2 - 4 n N P cos(h)/pi]
//!
//! which hold for rho = 1, g = 0, velocities of 0 and T_1 = r_T T_2 as for any other.

use crate::model::{Motion, Side};
use crate::orbit::equations::flight::{LaunchedFlight, OrbitImpact};
use crate::orbit::equations::square_system::{Decision, SquareSystem, not_excluded};
use crate::orbit::interval_box::IntervalBox;
use numbers::{Analytic, Endpoint, Interval};

/// The equations of the 1-1 motions of a [`Motion`] that take `periods` periods of the forcing f = cos(phase).
#[derive(Clone, Debug, PartialEq)]
pub struct OneOneEquations<T> {
    g: T,
    d: T,
    r_b: T,
    r_t: T,
    /// 2 n
    total: T,
    /// 1 - r_B r_T
    loss: T,
    /// N
    scale: T,
    /// 1 + 2 r_T + r_B r_T
    mirror: T,
    /// 4 n g r_B
    lift: T,
    /// N g
    weight: T,
    /// 2 / pi
    two_over_pi: T,
    /// 2 N / pi
    swing: T,
    /// pi / 2
    quarter: T,
}

/// What every equation needs of T_1 and psi.
pub struct SharedTerms<T> {
    t_1: T,
    /// psi
    phase: T,
    t_2: T,
    /// sin h, cos h
    half: (T, T),
    /// sin psi, cos psi
    middle: (T, T),
    /// a = T_1 (r_B v - w)
    a: T,
    /// kappa
    kappa: T,
    /// K
    k: T,
}

impl<T: Analytic> OneOneEquations<T> {
    /// Returns true if these are the equations of a motion: between two walls, under the forcing cos(pi t).
    pub fn describes(motion: &Motion<T>) -> bool {
        motion.has_top() && motion.other_forcing().is_none()
    }

    /// The equations; `periods` at least 1.
    pub fn new(motion: &Motion<T>, periods: u32) -> Self {
        let [r_b, r_t] = [Side::Bottom, Side::Top].map(|side| motion.restitution(side).clone());
        let rho = r_b.clone() * r_t.clone();
        let two = T::from_integer(2);
        let total = T::from_integer(2 * i64::from(periods));
        let scale = T::one() + two.clone() * r_b.clone() + rho.clone();
        let two_over_pi = two.clone() / T::pi();
        let g = motion.g().clone();
        Self {
            d: motion.d().clone(),
            loss: T::one() - rho.clone(),
            mirror: T::one() + two.clone() * r_t.clone() + rho,
            lift: two * total.clone() * g.clone() * r_b.clone(),
            weight: scale.clone() * g.clone(),
            swing: scale.clone() * two_over_pi.clone(),
            quarter: T::pi() * T::from_ratio(1, 2),
            two_over_pi,
            scale,
            total,
            g,
            r_b,
            r_t,
        }
    }

    /// Gravity along the capsule.
    pub fn g(&self) -> &T {
        &self.g
    }

    /// The gap.
    pub fn d(&self) -> &T {
        &self.d
    }

    /// The restitution of a wall.
    pub fn restitution(&self, side: Side) -> T {
        match side {
            Side::Bottom => self.r_b.clone(),
            Side::Top => self.r_t.clone(),
        }
    }

    /// Twice the number of periods: T_1 + T_2.
    pub fn total(&self) -> T {
        self.total.clone()
    }

    /// What the values at (T_1, psi) share; its methods take it again.
    pub fn parts(&self, t_1: &T, middle: &T) -> SharedTerms<T> {
        let t_2 = self.total() - t_1.clone();
        let half = (self.quarter.clone() * t_1.clone()).sincos();
        let (phase, middle) = (middle.clone(), middle.sincos());
        let kappa = t_1.clone() * half.1.clone() - self.two_over_pi.clone() * half.0.clone();
        let drift = self.two_over_pi.clone() * kappa.clone() * middle.0.clone();
        let a = self.d.clone() + self.d.clone() - drift;
        let k = self.scale.clone() * t_1.clone() - self.mirror.clone() * t_2.clone();
        SharedTerms {
            t_1: t_1.clone(),
            phase,
            t_2,
            half,
            middle,
            a,
            kappa,
            k,
        }
    }

    /// [h_1, h_2], both 0 exactly on the 1-1 motions with T_1 in (0, 2 n). The velocities may have any sign.
    pub fn residual(&self, t_1: &T, middle: &T) -> [T; 2] {
        self.residual_at(&self.parts(t_1, middle))
    }

    /// As [`OneOneEquations::residual`].
    pub fn residual_at(&self, at: &SharedTerms<T>) -> [T; 2] {
        let carried =
            self.weight.clone() * at.t_1.clone() + self.swing.clone() * (at.half.0.clone() * at.middle.1.clone());
        let first = self.loss.clone() * at.a.clone() - at.t_1.clone() * (self.lift.clone() - carried);
        let pull = self.g.clone() * self.loss.clone() * at.t_2.clone();
        let swung = self.swing.clone() * (at.middle.0.clone() * at.half.1.clone());
        let second = at.k.clone() * at.a.clone() - self.total() * at.t_1.clone() * (pull - swung);
        [first, second]
    }

    /// [h_1, h_2] and their derivatives, one row each, by T_1 and psi. The derivatives by hand share the sines of
    /// the values; dual numbers through [`OneOneEquations::residual`] give the same at three times the cost.
    pub fn linearised(&self, t_1: &T, middle: &T) -> ([T; 2], [[T; 2]; 2]) {
        let at = self.parts(t_1, middle);
        (self.residual_at(&at), self.slopes_at(&at))
    }

    /// The derivatives of [`OneOneEquations::linearised`].
    pub fn slopes_at(&self, at: &SharedTerms<T>) -> [[T; 2]; 2] {
        let (sin_h, cos_h) = at.half.clone();
        let (p, q) = at.middle.clone();
        let quarter_turn = self.quarter.clone() * at.t_1.clone();
        let a_by_t = at.t_1.clone() * sin_h.clone() * p.clone();
        let a_by_psi = -(self.two_over_pi.clone() * at.kappa.clone() * q.clone());

        let pulled = self.weight.clone() * (at.t_1.clone() + at.t_1.clone()) - self.lift.clone();
        let swung = self.swing.clone() * q.clone() * (sin_h.clone() + quarter_turn.clone() * cos_h.clone());
        let first_by_t = self.loss.clone() * a_by_t.clone() + pulled + swung;
        let turned = self.swing.clone() * a_by_t.clone();
        let first_by_psi = self.loss.clone() * a_by_psi.clone() - turned;

        let k_by_t = self.scale.clone() + self.mirror.clone();
        let pull = self.g.clone() * self.loss.clone() * (at.t_2.clone() - at.t_1.clone());
        let swung = self.swing.clone() * p * (cos_h.clone() - quarter_turn * sin_h);
        let second_by_t = k_by_t * at.a.clone() + at.k.clone() * a_by_t - self.total() * (pull - swung);
        let turned = self.total() * self.swing.clone() * (at.t_1.clone() * cos_h * q);
        let second_by_psi = at.k.clone() * a_by_psi + turned;
        [[first_by_t, first_by_psi], [second_by_t, second_by_psi]]
    }

    /// [psi, 1 - 1/(P² + Q²)] for a given T_1, where h_2 = 0 gives P and then h_1 = 0 gives Q: an equation in T_1
    /// alone, with values in (-inf, 1] and poles where both denominators vanish. `None` where it has no value.
    pub fn middle(&self, t_1: &T) -> Option<[T; 2]> {
        let at = self.parts(t_1, &T::zero());
        let (sin_h, cos_h) = at.half.clone();
        let two = T::from_integer(2);
        let pull = self.total() * self.g.clone() * self.loss.clone() * at.t_1.clone() * at.t_2.clone();
        let p_above = two.clone() * at.k.clone() * self.d.clone() - pull;
        let swung = self.total() * self.scale.clone() * at.t_1.clone() * cos_h;
        let p_below = self.two_over_pi.clone() * (at.k.clone() * at.kappa.clone() - swung);
        let p = p_above / p_below;
        let a = two * self.d.clone() - self.two_over_pi.clone() * at.kappa.clone() * p.clone();
        let rise = self.lift.clone() - self.weight.clone() * at.t_1.clone();
        let q_above = at.t_1.clone() * rise - self.loss.clone() * a;
        let q_below = self.swing.clone() * at.t_1.clone() * sin_h;
        let q = q_above / q_below;
        let square = p.clone() * p.clone() + q.clone() * q.clone();
        let excess = T::one() - T::one() / square;
        excess.to_f64().is_finite().then(|| [p.atan2(&q), excess])
    }

    /// [N T_1 v, N T_1 w]: the velocities at the bottom and at the top without a division, for their signs.
    pub fn scaled_velocities(&self, t_1: &T, middle: &T) -> [T; 2] {
        self.scaled_velocities_at(&self.parts(t_1, middle))
    }

    /// As [`OneOneEquations::scaled_velocities`].
    pub fn scaled_velocities_at(&self, at: &SharedTerms<T>) -> [T; 2] {
        let pull = self.total() * self.g.clone() * at.t_1.clone();
        let up = (T::one() + self.r_t.clone()) * at.a.clone();
        let down = (T::one() + self.r_b.clone()) * at.a.clone();
        [pull.clone() + up, pull * self.r_b.clone() - down]
    }

    /// [v, w]: the velocities just before the impacts at the bottom and at the top. `t_1` must not contain 0.
    pub fn velocities(&self, t_1: &T, middle: &T) -> [T; 2] {
        self.velocities_at(&self.parts(t_1, middle))
    }

    /// Computes [`OneOneEquations::velocities`] from shared terms.
    pub fn velocities_at(&self, at: &SharedTerms<T>) -> [T; 2] {
        let scale = self.scale.clone() * at.t_1.clone();
        self.scaled_velocities_at(at).map(|scaled| scaled / scale.clone())
    }

    /// The phases of the forcing at the two impacts, not reduced.
    pub fn phases(&self, t_1: &T, middle: &T) -> [T; 2] {
        let half = T::pi() * t_1.clone() * T::from_ratio(1, 2);
        [middle.clone() - half.clone(), middle.clone() + half]
    }

    /// Computes [`OneOneEquations::phases`] from shared terms.
    pub fn phases_at(&self, at: &SharedTerms<T>) -> [T; 2] {
        self.phases(&at.t_1, &at.phase)
    }

    /// The two impacts, at the bottom and at the top. `t_1` must not contain 0.
    pub fn impacts(&self, t_1: &T, middle: &T) -> [OrbitImpact<T>; 2] {
        let [v, w] = self.velocities(t_1, middle);
        let [bottom, top] = self.phases(t_1, middle);
        let t_2 = self.total() - t_1.clone();
        [(bottom, v, t_1.clone()), (top, w, t_2)].map(|(phase, velocity, time)| OrbitImpact { phase, velocity, time })
    }

    /// The flight from the bottom, 0, or from the top, 1. `t_1` must not contain 0.
    pub fn flight(&self, index: usize, t_1: &T, middle: &T) -> LaunchedFlight<T> {
        let [v, w] = self.velocities(t_1, middle);
        let [at_bottom, at_top] = self.phases(t_1, middle);
        let (side, before, phase) = if index == 0 {
            (Side::Bottom, v, at_bottom)
        } else {
            (Side::Top, w, at_top)
        };
        let launch = -(self.restitution(side) * before);
        LaunchedFlight::new(side, phase, launch, self.g.clone(), self.d.clone())
    }

    /// (Tr(DP) - `level`) v w (N T_1)²: the distance of the trace from a level, without its poles at v = 0 and w = 0.
    ///
    /// From (20), (21) and (18): Tr(DP) v w = (1 + r_B)(1 + r_T) f_0 f_1 T_1 T_2
    /// - 2 n [r_B (1 + r_T) f_1 v + r_T (1 + r_B) f_0 w] + 2 rho v w, where f_0 = f(t_k) + g, f_1 = f(t_{k+1}) + g.
    pub fn trace_above(&self, level: &T, t_1: &T, middle: &T) -> T {
        self.trace_above_at(level, &self.parts(t_1, middle))
    }

    /// Computes [`OneOneEquations::trace_above`] from shared terms.
    pub fn trace_above_at(&self, level: &T, at: &SharedTerms<T>) -> T {
        let [v, w] = self.scaled_velocities_at(at);
        let scale = self.scale.clone() * at.t_1.clone();
        let (even, odd) = (
            at.half.1.clone() * at.middle.1.clone(),
            at.half.0.clone() * at.middle.0.clone(),
        );
        let start = even.clone() + odd.clone() + self.g.clone();
        let end = even - odd + self.g.clone();
        let by_bottom = self.r_b.clone() * (T::one() + self.r_t.clone());
        let by_top = self.r_t.clone() * (T::one() + self.r_b.clone());
        let both = (T::one() + self.r_b.clone()) * (T::one() + self.r_t.clone());
        let product = both * start.clone() * end.clone() * at.t_1.clone() * at.t_2.clone() * scale.clone();
        let crossed = self.total() * (by_bottom * end * v.clone() + by_top * start * w.clone());
        let twice = T::from_integer(2) * self.r_b.clone() * self.r_t.clone() - level.clone();
        scale * (product - crossed) + twice * v * w
    }

    /// Det(DP) = (r_B r_T)², (23) on a 1-1 motion.
    pub fn determinant(&self) -> T {
        let rho = self.r_b.clone() * self.r_t.clone();
        rho.clone() * rho
    }

    /// 1 - r_B r_T.
    pub fn loss(&self) -> &T {
        &self.loss
    }

    /// r_B r_T, half the trace at which a node becomes a focus.
    pub fn loss_factor(&self) -> T {
        self.r_b.clone() * self.r_t.clone()
    }
}

impl<E: Endpoint> OneOneEquations<Interval<E>> {
    /// Whether v >= 0 >= w somewhere, with T_1 and T_2 not negative: a proof may reach beyond the boxes examined.
    pub(crate) fn may_fly(&self, t_1: &Interval<E>, [v, w]: &[Interval<E>; 2]) -> bool {
        let t_2 = self.total() - t_1.clone();
        !v.is_negative() && !w.is_positive() && !t_1.is_negative() && !t_2.is_negative()
    }
}

/// h_1 = h_2 = 0 in (T_1, psi), for motions with v > 0 > w.
impl<E: Endpoint> SquareSystem<E, 2> for OneOneEquations<Interval<E>> {
    fn linearised(&self, [t_1, middle]: &IntervalBox<E, 2>) -> (IntervalBox<E, 2>, [IntervalBox<E, 2>; 2]) {
        OneOneEquations::linearised(self, t_1, middle)
    }

    fn values(&self, [t_1, middle]: &IntervalBox<E, 2>) -> IntervalBox<E, 2> {
        self.residual(t_1, middle)
    }

    fn is_wanted(&self, [t_1, middle]: &IntervalBox<E, 2>) -> bool {
        self.may_fly(t_1, &self.scaled_velocities(t_1, middle))
    }

    /// With the sines of the box computed once.
    fn examined(&self, [t_1, middle]: &IntervalBox<E, 2>) -> Result<[IntervalBox<E, 2>; 2], Decision> {
        let at = self.parts(t_1, middle);
        if !self.may_fly(t_1, &self.scaled_velocities_at(&at)) {
            return Err(Decision::Unwanted);
        }
        not_excluded(&self.residual_at(&at))?;
        Ok(self.slopes_at(&at))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{Forcing, Pair, Passage};
    use numbers::{Dual, Sequence, seeded};

    fn motion(g: f64, d: f64, r_b: f64, r_t: f64) -> Motion<f64> {
        let Ok(motion) = Motion::new(g, d, r_b, r_t) else {
            panic!("a motion")
        };
        motion
    }

    /// Newton steps from (T_1, psi) to a motion near it.
    fn solved(balance: &OneOneEquations<f64>, mut at: [f64; 2]) -> [f64; 2] {
        for _ in 0..60 {
            let ([a, b], [[p, q], [r, s]]) = balance.linearised(&at[0], &at[1]);
            let determinant = p * s - q * r;
            at[0] -= (s * a - q * b) / determinant;
            at[1] -= (p * b - r * a) / determinant;
        }
        at
    }

    #[test]
    fn a_point_that_balances_is_a_motion_of_the_two_maps_for_any_periods() {
        for (motion, start, periods) in [
            (motion(0.12201, 0.4, 0.5, 0.5), [1.1, 2.2], 1),
            (motion(0.12201, 0.44, 0.6, 0.3), [2.9, 7.53], 2),
            (motion(1.1, 1.572303, 0.8, 0.8), [1.0, 1.0], 1),
            (motion(0.1, 0.7, 1.0, 1.0), [1.05, 1.6], 1),
        ] {
            let balance = OneOneEquations::new(&motion, periods);
            let [t_1, middle] = solved(&balance, start);
            let [v, w] = balance.velocities(&t_1, &middle);
            let [phase, _] = balance.phases(&t_1, &middle);
            let t_2 = balance.total() - t_1;
            let forcing = Forcing::harmonic(&phase);
            let [start, end] = [0.0, t_1].map(|t| forcing.at(&t));
            let r_b = motion.restitution(Side::Bottom);
            let r_t = motion.restitution(Side::Top);
            let g = motion.g();
            let nine = -r_b * v + g * t_1 + end.f1 - start.f1 - w;
            let ten = -r_b * v * t_1 + g / 2.0 * t_1 * t_1 + end.f2 - start.f2 - start.f1 * t_1 + motion.d();
            let eleven = -r_t * w + g * t_2 + start.f1 - end.f1 - v;
            let twelve = -r_t * w * t_2 + g / 2.0 * t_2 * t_2 + start.f2 - end.f2 - end.f1 * t_2 - motion.d();
            for (name, residual) in [("(9)", nine), ("(10)", ten), ("(11)", eleven), ("(12)", twelve)] {
                assert!(residual.abs() < 1e-13, "{name} {residual:e} at {t_1} {middle}");
            }
        }
    }

    #[test]
    fn the_trace_without_poles_is_that_of_the_product_of_jacobians() {
        let motion = motion(0.12201, 0.4, 0.5, 0.5);
        let balance = OneOneEquations::new(&motion, 1);
        let [t_1, middle] = solved(&balance, [1.1, 2.2]);
        let [v, w] = balance.velocities(&t_1, &middle);
        let [phase, _] = balance.phases(&t_1, &middle);
        let t_2 = 2.0 - t_1;
        let pair = Pair::new(&motion, &Forcing::harmonic(&phase), &0.0, &v, [&t_1, &t_2]);
        let Ok(product) = pair.product(Passage::by_formula) else {
            panic!("a product")
        };
        let [scaled_v, scaled_w] = balance.scaled_velocities(&t_1, &middle);
        assert!((scaled_v / scaled_w - v / w).abs() < 1e-14);
        let above = balance.trace_above(&0.25, &t_1, &middle) / (scaled_v * scaled_w);
        assert!((product.trace() - 0.25 - above).abs() < 1e-13);
        assert!((product.determinant() - balance.determinant()).abs() < 1e-13);
    }

    #[test]
    fn the_derivatives_by_hand_are_those_of_dual_numbers() {
        let mut sequence = Sequence::new(7);
        for _ in 0..200 {
            let [g, d, r_b, r_t, t_1, middle] = std::array::from_fn(|_| sequence.between(0.0, 1.0));
            let balance = OneOneEquations::new(&motion(g, d + 0.01, r_b.max(0.01), r_t.max(0.01)), 2);
            let lifted = OneOneEquations::new(
                &Motion::new(g, d + 0.01, r_b.max(0.01), r_t.max(0.01))
                    .and_then(|motion| motion.convert(|&x| Dual::from_re(x)))
                    .unwrap(),
                2,
            );
            let (t_1, middle) = (4.0 * t_1, 6.0 * middle);
            let (_, by_hand) = balance.linearised(&t_1, &middle);
            let by_t = lifted.residual(&seeded(t_1), &Dual::from_re(middle));
            let by_psi = lifted.residual(&Dual::from_re(t_1), &seeded(middle));
            for row in 0..2 {
                assert!((by_hand[row][0] - by_t[row].eps).abs() < 1e-12);
                assert!((by_hand[row][1] - by_psi[row].eps).abs() < 1e-12);
            }
        }
    }
}
