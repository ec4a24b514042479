//! 1-1 motions the other way round: which restitutions a flight time and a phase ask for.
//!
//! Of a device (d, g), T_1 and the phase psi of the forcing halfway through the flight from bottom to top, (10) and (12)
//! give the velocity just after each impact, then (9) and (11) that just before: no equation is left to solve. With
//! h = pi T_1 / 2, P = sin psi, Q = cos psi, T_2 = 2 n - T_1 and
//!
//! - x_1 = d - (P/pi)(T_1 cos h - (2/pi) sin h),  y_1 = T_1 (g T_1/2 + Q sin(h)/pi)
//! - x_2 = d + (P/pi)(T_2 cos h + (2/pi) sin h),  y_2 = T_2 (g T_2/2 - Q sin(h)/pi)
//!
//! the speeds are, over the flight times: away from the bottom (x_1 + y_1)/T_1, at the top (x_1 - y_1)/T_1, away from the top
//! (x_2 - y_2)/T_2, at the bottom (x_2 + y_2)/T_2. The restitutions are quotients of two of them each.

use numbers::{Analytic, Interval};

/// A device and a 1-1 motion of n forcing periods in it, whose restitutions follow.
#[derive(Clone, Debug)]
pub struct ExplicitOneOne<T> {
    /// T_1, T_2
    pub times: [T; 2],
    /// f + g at the bottom impact and at the top one.
    pub pushes: [T; 2],
    /// The phases of the forcing at the two impacts.
    pub phases: [T; 2],
    /// Times T_2, T_1: the speeds just before the impacts at the bottom, at the top.
    pub scaled_arrivals: [T; 2],
    /// Times T_1, T_2: the speeds just after the impacts at the bottom, at the top.
    pub scaled_launches: [T; 2],
}

impl<T: Analytic> ExplicitOneOne<T> {
    /// The motion over `total` / 2 forcing periods.
    pub fn new([d, g]: [&T; 2], total: &T, t_1: &T, middle: &T) -> Self {
        let t_2 = total.clone() - t_1.clone();
        let half = T::from_ratio(1, 2);
        let over_pi = T::one() / T::pi();
        let h = T::pi() * t_1.clone() * half.clone();
        let (sin_h, cos_h) = h.sincos();
        let (p, q) = middle.sincos();
        let lag = (over_pi.clone() + over_pi.clone()) * sin_h.clone();
        let p_over_pi = p * over_pi.clone();
        let x_1 = d.clone() - p_over_pi.clone() * (t_1.clone() * cos_h.clone() - lag.clone());
        let x_2 = d.clone() + p_over_pi * (t_2.clone() * cos_h + lag);
        let swing = q * sin_h * over_pi;
        let fall = g.clone() * half;
        let y_1 = t_1.clone() * (fall.clone() * t_1.clone() + swing.clone());
        let y_2 = t_2.clone() * (fall * t_2.clone() - swing);
        let phases = [middle.clone() - h.clone(), middle.clone() + h];
        let pushes = phases.each_ref().map(|phase| phase.sincos().1 + g.clone());
        Self {
            scaled_arrivals: [x_2.clone() + y_2.clone(), x_1.clone() - y_1.clone()],
            scaled_launches: [x_1 + y_1, x_2 - y_2],
            times: [t_1.clone(), t_2],
            pushes,
            phases,
        }
    }

    /// The speeds just before the impacts at the bottom and at the top. No flight time may contain 0.
    pub fn arrivals(&self) -> [T; 2] {
        let [t_1, t_2] = self.times.clone();
        let [bottom, top] = self.scaled_arrivals.clone();
        [bottom / t_2, top / t_1]
    }

    /// The speeds just after them, as [`ExplicitOneOne::arrivals`].
    pub fn launches(&self) -> [T; 2] {
        let [t_1, t_2] = self.times.clone();
        let [bottom, top] = self.scaled_launches.clone();
        [bottom / t_1, top / t_2]
    }

    /// By how much each restitution is above its least value and below its largest, times the speed of arrival and
    /// both flight times: not below 0 where it is in its range.
    pub fn within(&self, ranges: &[[T; 2]; 2]) -> [T; 4] {
        let [t_1, t_2] = self.times.clone();
        let [[least_b, largest_b], [least_t, largest_t]] = ranges.clone();
        let [launch_b, launch_t] = self.scaled_launches.clone();
        let [arrival_b, arrival_t] = self.scaled_arrivals.clone();
        let launches = [launch_b * t_2.clone(), launch_t * t_1.clone()];
        let arrivals = [arrival_b * t_1, arrival_t * t_2];
        let [launch_b, launch_t] = launches;
        let [arrival_b, arrival_t] = arrivals;
        [
            launch_b.clone() - least_b * arrival_b.clone(),
            largest_b * arrival_b - launch_b,
            launch_t.clone() - least_t * arrival_t.clone(),
            largest_t * arrival_t - launch_t,
        ]
    }

    /// (1 + Det - margin - Tr) and (1 + Det - margin + Tr), times the square of the product of both speeds of arrival: not
    /// below 0 where the motion is stable by `margin`. No flight time may contain 0.
    ///
    /// With the speeds of arrival a at the bottom, b at the top, and of launch u_B, u_T, the trace of (22) as mended is
    /// Tr (a b)² = 2 a b u_B u_T - k, k = (a + u_B)(b + u_T) f_0 f_1 T_1 T_2 - 2 n [f_1 a u_B (b + u_T) - f_0 b u_T (a + u_B)],
    /// f_0 and f_1 being f + g at the two impacts; and Det (a b)² = (u_B u_T)².
    pub fn stability(&self, margin: &T) -> [T; 2] {
        let [a, b] = self.arrivals();
        let [u_b, u_t] = self.launches();
        let [t_1, t_2] = self.times.clone();
        let [f_0, f_1] = self.pushes.clone();
        let (at_bottom, at_top) = (a.clone() + u_b.clone(), b.clone() + u_t.clone());
        let (before, after) = (a.clone() * b.clone(), u_b.clone() * u_t.clone());
        let crossed = (t_1.clone() * f_0.clone()) * (t_2.clone() * f_1.clone());
        let total = t_1 + t_2;
        let at_bottom_part = f_1 * (a * u_b) * at_top.clone();
        let at_top_part = f_0 * (b * u_t) * at_bottom.clone();
        let k = at_bottom * at_top * crossed - total * (at_bottom_part - at_top_part);
        let square = |value: T| value.clone() * value;
        let held = margin.clone() * square(before.clone());
        [
            square(before.clone() - after.clone()) + k.clone() - held.clone(),
            square(before + after) - k - held,
        ]
    }
}

impl<T: Analytic> ExplicitOneOne<T> {
    /// The same of known restitutions, over the product of both speeds of arrival and (1 + r_B)(1 + r_T): of a motion that
    /// has them it has the same sign as [`ExplicitOneOne::stability`], and no zero where a speed of arrival is 0. No flight
    /// time may contain 0.
    ///
    /// With beta = r/(1 + r) of each wall: (1 + Det - Tr) a b / ((1 + r_B)(1 + r_T)) = k + (1 - r_B r_T)² a b / ((1 + r_B)(1 + r_T)),
    /// k = f_0 f_1 T_1 T_2 - 2 n (beta_B f_1 a - beta_T f_0 b).
    pub fn stability_of(&self, known: &Restitutions<T>) -> [T; 2] {
        let [a, b] = self.arrivals();
        let [t_1, t_2] = self.times.clone();
        let [f_0, f_1] = self.pushes.clone();
        let product = a.clone() * b.clone();
        let total = t_1.clone() + t_2.clone();
        let [beta_b, beta_t] = known.shares.clone();
        let k = (t_1 * f_0.clone()) * (t_2 * f_1.clone()) - total * (beta_b * f_1 * a - beta_t * f_0 * b);
        let [fold, doubling] = known.weights.clone();
        [k.clone() + fold * product.clone(), doubling * product - k]
    }
}

/// Restitutions, as [`ExplicitOneOne::stability_of`] takes them.
#[derive(Clone, Debug)]
pub struct Restitutions<T> {
    /// r/(1 + r) of the bottom and of the top.
    shares: [T; 2],
    /// (1 - r_B r_T)² and (1 + r_B r_T)², less the margin, over (1 + r_B)(1 + r_T).
    weights: [T; 2],
}

impl Restitutions<Interval> {
    /// Of restitutions in these intervals.
    pub fn new([r_b, r_t]: [Interval; 2], margin: Interval) -> Self {
        let one = Interval::point(1.0);
        let both = (one + r_b) * (one + r_t);
        let rho = r_b * r_t;
        // as 1 - 1/(1 + r), r occurs once
        let share = |r: Interval| one - one / (one + r);
        Self {
            shares: [share(r_b), share(r_t)],
            weights: [
                ((one - rho).square() - margin) / both,
                ((one + rho).square() - margin) / both,
            ],
        }
    }

    /// The same over another number.
    pub fn convert<U>(&self, convert: impl Fn(&Interval) -> U + Copy) -> Restitutions<U> {
        Restitutions {
            shares: self.shares.each_ref().map(convert),
            weights: self.weights.each_ref().map(convert),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Motion;
    use crate::orbit::equations::one_one::OneOneEquations;
    use crate::orbit::solve::one_one::newton_one_one;

    #[test]
    fn the_restitutions_of_a_known_motion_come_out_with_its_speeds_and_its_trace() {
        // FACTS: r .5 .5, beta pi/6, d .4, and one over two periods
        for (motion, periods, guess) in [
            (Motion::new(0.122_01, 0.4, 0.5, 0.5), 1, [1.1, 2.2]),
            (Motion::new(0.122_01, 0.44, 0.6, 0.3), 2, [2.9, 7.53]),
        ] {
            let motion: Motion<f64> = motion.expect("a motion");
            let balance = OneOneEquations::new(&motion, periods);
            let [t_1, middle] = newton_one_one(&balance, guess).expect("a motion");
            let explicit = ExplicitOneOne::new([motion.d(), motion.g()], &balance.total(), &t_1, &middle);
            let [v, w] = balance.velocities(&t_1, &middle);
            let [a, b] = explicit.arrivals();
            assert!((a - v).abs() < 1e-12 && (b + w).abs() < 1e-12, "{a} {v} {b} {w}");
            let [u_b, u_t] = explicit.launches();
            let [r_b, r_t] = [u_b / a, u_t / b];
            let apart = |wall, r: f64| (r - motion.restitution(wall)).abs();
            assert!(apart(crate::model::Side::Bottom, r_b) < 1e-11 && apart(crate::model::Side::Top, r_t) < 1e-11);
            let [below, above] = explicit.stability(&0.0).map(|slack| slack / (a * b).powi(2));
            let trace = 0.5 * (above - below);
            let [scaled_v, scaled_w] = balance.scaled_velocities(&t_1, &middle);
            let known = balance.trace_above(&0.0, &t_1, &middle) / (scaled_v * scaled_w);
            assert!((trace - known).abs() < 1e-9 * known.abs().max(1.0), "{trace} {known}");
            assert!((0.5 * (above + below) - 1.0 - (r_b * r_t).powi(2)).abs() < 1e-9 * known.abs().max(1.0));
            let line = |x: f64| Interval::point(x);
            let known = Restitutions::new([line(r_b), line(r_t)], line(0.0)).convert(|value| value.midpoint());
            let both = (1.0 + r_b) * (1.0 + r_t) / (a * b);
            let [fold, doubling] = explicit.stability_of(&known).map(|slack| slack * both);
            let apart = (fold - below).abs() + (doubling - above).abs();
            assert!(
                apart < 1e-8 * known_size(&[below, above]),
                "{fold} {below} {doubling} {above}"
            );
            let within = explicit.within(&[[0.0, r_b], [r_t, 1.0]]);
            assert!(within[1].abs() < 1e-11 && within[2].abs() < 1e-11 && within[0] > 0.0 && within[3] > 0.0);
        }
    }

    fn known_size(values: &[f64]) -> f64 {
        values.iter().fold(1.0, |size: f64, value| size.max(value.abs()))
    }
}
