//! A 1-1 motion over one forcing period from four numbers that fix it: by the paper's own equations (9) to (12),
//! solved for what they are linear in. Nothing is shared with the forms that are judged.

use numbers::Analytic;

/// A motion that closes. Times are those of the forcing cos(pi t).
pub(super) struct Closed<T> {
    pub r_b: T,
    pub r_t: T,
    pub g: T,
    pub d: T,
    /// T_1 and T_2.
    pub flights: [T; 2],
    /// The velocities just before the impacts at the bottom and at the top.
    pub velocities: [T; 2],
    /// t_k and t_{k+1}.
    pub times: [T; 2],
    /// The phase halfway through the flight to the top.
    pub middle: T,
}

/// The names of what [`Closed::list`] gives.
pub(super) const NAMES: [&str; 11] = [
    "r_B", "r_T", "g", "d", "T_1", "T_2", "Zdot_k", "Zdot_k+1", "t_k", "t_k+1", "psi",
];

/// sin and cos of pi t.
fn wave<T: Analytic>(time: &T) -> (T, T) {
    (time.clone() * T::pi()).sincos()
}

fn square<T: Analytic>(value: &T) -> T {
    value.clone() * value.clone()
}

impl<T: Analytic> Closed<T> {
    /// The motion of these restitutions whose first flight takes `t_1` around the phase `middle`. `None` where the
    /// velocities do not point to their walls, or the walls stand in the wrong order.
    pub fn by_phase(r_b: &T, r_t: &T, t_1: &T, middle: &T) -> Option<Self> {
        let t_2 = T::from_integer(2) - t_1.clone();
        let half = t_1.clone() * T::from_ratio(1, 2);
        let centre = middle.clone() / T::pi();
        let times = [centre.clone() - half.clone(), centre + half];
        let [(sin_0, _), (sin_1, _)] = times.each_ref().map(wave);
        let [f1_0, f1_1] = [sin_0 / T::pi(), sin_1 / T::pi()];
        let gain = f1_1.clone() - f1_0.clone();
        // (11) with (9) in it, and (10) + (12) with (9) in it, linear in v and g: Cramer's rule
        let rho = r_b.clone() * r_t.clone();
        let [a, b] = [T::one() - rho.clone(), r_t.clone() * t_1.clone() - t_2.clone()];
        let right = -((T::one() + r_t.clone()) * gain.clone());
        let c = rho * t_2.clone() - r_b.clone() * t_1.clone();
        let squares = (square(t_1) + square(&t_2)) * T::from_ratio(1, 2);
        let e = squares - r_t.clone() * t_1.clone() * t_2.clone();
        let swung = f1_0 * t_1.clone() + f1_1 * t_2.clone() + r_t.clone() * t_2.clone() * gain.clone();
        let determinant = a.clone() * e.clone() - b.clone() * c.clone();
        let v = (right.clone() * e - b * swung.clone()) / determinant.clone();
        let g = (a * swung - c * right) / determinant;
        let w = gain - r_b.clone() * v.clone() + g.clone() * t_1.clone();
        Self::kept(r_b, r_t, g, [t_1.clone(), t_2], [v, w], times, middle.clone())
    }

    /// The motion of these restitutions whose first flight takes `t_1` and whose velocities are in the ratio of
    /// `speeds`, both given as positive numbers: (9) to (12) are linear in everything but the phase, which follows
    /// from the forcing's amplitude being 1. `None` where the walls stand in the wrong order.
    pub fn by_speeds(r_b: &T, r_t: &T, t_1: &T, speeds: [&T; 2]) -> Option<Self> {
        let t_2 = T::from_integer(2) - t_1.clone();
        let [v, w] = [speeds[0].clone(), -speeds[1].clone()];
        let sum = (T::one() + r_b.clone()) * v.clone() + (T::one() + r_t.clone()) * w.clone();
        let g = sum * T::from_ratio(1, 2);
        let (sin_h, cos_h) = wave(&(t_1.clone() * T::from_ratio(1, 2)));
        let rise = r_b.clone() * v.clone() + w.clone() - g.clone() * t_1.clone();
        let q = rise * T::pi() / (sin_h.clone() + sin_h);
        let first = t_1.clone() * (r_b.clone() * v.clone() - w.clone());
        let second = t_2.clone() * (r_t.clone() * w.clone() - v.clone());
        let four = T::from_integer(4);
        let p = -((first + second) * T::pi() / (four * cos_h));
        let amplitude = (square(&p) + square(&q)).sqrt();
        let middle = p.atan2(&q);
        let half = t_1.clone() * T::from_ratio(1, 2);
        let centre = middle.clone() / T::pi();
        let times = [centre.clone() - half.clone(), centre + half];
        let velocities = [v / amplitude.clone(), w / amplitude.clone()];
        let g = g / amplitude;
        Self::kept(r_b, r_t, g, [t_1.clone(), t_2], velocities, times, middle)
    }

    /// With d by (10).
    fn kept(r_b: &T, r_t: &T, g: T, flights: [T; 2], velocities: [T; 2], times: [T; 2], middle: T) -> Option<Self> {
        let [(sin_0, cos_0), (_, cos_1)] = times.each_ref().map(wave);
        let t_1 = flights[0].clone();
        let pi_square = square(&T::pi());
        // F_2 = -cos / pi²
        let lift = (cos_1 - cos_0) / pi_square;
        let start = sin_0 / T::pi() * t_1.clone();
        let launched = r_b.clone() * velocities[0].clone() * t_1.clone();
        let d = launched - g.clone() * square(&t_1) * T::from_ratio(1, 2) + lift + start;
        let flies = d.to_f64() > 0.0 && velocities[0].to_f64() > 0.0 && velocities[1].to_f64() < 0.0;
        flies.then(|| Self {
            r_b: r_b.clone(),
            r_t: r_t.clone(),
            g,
            d,
            flights,
            velocities,
            times,
            middle,
        })
    }

    /// All of it, as forms are given it.
    pub fn list(self) -> Vec<T> {
        let Self {
            r_b,
            r_t,
            g,
            d,
            flights: [t_1, t_2],
            velocities: [v, w],
            times: [start, end],
            middle,
        } = self;
        vec![r_b, r_t, g, d, t_1, t_2, v, w, start, end, middle]
    }

    /// From what [`Closed::list`] gave.
    pub fn of(list: &[T]) -> Option<Self> {
        let [r_b, r_t, g, d, t_1, t_2, v, w, start, end, middle] = list else {
            return None;
        };
        Some(Self {
            r_b: r_b.clone(),
            r_t: r_t.clone(),
            g: g.clone(),
            d: d.clone(),
            flights: [t_1.clone(), t_2.clone()],
            velocities: [v.clone(), w.clone()],
            times: [start.clone(), end.clone()],
            middle: middle.clone(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use dynamics::model::{Forcing, Impact, Map, Motion, Side};

    fn assert_returns(closed: &Closed<f64>) {
        let motion = Motion::new(closed.g, closed.d, closed.r_b, closed.r_t).unwrap();
        let forcing = Forcing::harmonic(&0.0);
        let start = Impact {
            side: Side::Bottom,
            time: closed.times[0],
            velocity: closed.velocities[0],
        };
        let up = Map::P1.apply_through(&motion, &forcing, &start).unwrap();
        let down = Map::P2.apply_through(&motion, &forcing, &up.to).unwrap();
        assert!((up.duration - closed.flights[0]).abs() < 1e-12);
        assert!((down.duration - closed.flights[1]).abs() < 1e-12);
        assert!((up.to.velocity - closed.velocities[1]).abs() < 1e-12);
        assert!((down.to.velocity - closed.velocities[0]).abs() < 1e-12);
    }

    #[test]
    fn the_ball_comes_back_to_where_it_started() {
        let first = Closed::by_phase(&0.5, &0.5, &1.1165, &2.2432).unwrap();
        assert_returns(&first);
        let speeds = first.velocities.map(f64::abs);
        let second = Closed::by_speeds(&0.5, &0.5, &1.1165, speeds.each_ref()).unwrap();
        assert_returns(&second);
        assert!((first.d - second.d).abs() < 1e-12 && (first.g - second.g).abs() < 1e-12);
        assert!((first.middle - second.middle).abs() < 1e-12);
    }

    #[test]
    fn a_motion_whose_velocities_point_away_is_none() {
        assert!(Closed::by_phase(&0.5, &0.5, &1.1165, &-1.0).is_none());
    }
}
