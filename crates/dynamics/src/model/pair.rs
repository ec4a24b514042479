//! The derivative DP = DP_2 DP_1 of the pair of maps, its trace (22) and its determinant (23).

use super::ahead::Forced;
use super::flight::Impact;
use super::forcing::Forcing;
use super::jacobian::{JacobianError, Passage, not_zero};
use super::motion::{Motion, Side};
use nalgebra::Matrix2;
use numbers::Analytic;

/// Two flights that close a motion: P_2 after P_1, t_{k+2} = t_k and a whole number of periods.
#[derive(Clone, Debug, PartialEq)]
pub struct Pair<T> {
    /// From the bottom to the top.
    pub first: Passage<T>,
    /// From the top to the bottom.
    pub second: Passage<T>,
}

impl<T: Analytic> Pair<T> {
    /// The two flights from an impact at the bottom, with T_1 and T_2 known; Zdot_{k+1} is taken from (9).
    ///
    /// `velocity` and the velocity at the top are not asked to point towards their walls; the ways that fly do.
    pub fn new(motion: &Motion<T>, forcing: &Forcing<T>, time: &T, velocity: &T, durations: [&T; 2]) -> Self {
        let [first, second] = durations;
        let impact = Impact {
            side: Side::Bottom,
            time: time.clone(),
            velocity: velocity.clone(),
        };
        let between = time.clone() + first.clone();
        let (start, end) = (forcing.at(time), forcing.at(&between));
        let launch = motion.restitution(Side::Bottom).clone() * velocity.clone();
        let velocity = motion.g().clone() * first.clone() - launch + end.f1 - start.f1;
        let top = Impact {
            side: Side::Top,
            time: between,
            velocity,
        };
        let second = Passage::new(motion, forcing, &top, second);
        Self {
            first: Passage::new(motion, forcing, &impact, first),
            second,
        }
    }

    /// DP = DP_2 DP_1 of (18), each factor by `means`.
    ///
    /// # Errors
    /// Those of `means`.
    pub fn product(
        &self,
        means: impl Fn(&Passage<T>) -> Result<Matrix2<T>, JacobianError>,
    ) -> Result<Matrix2<T>, JacobianError> {
        Ok(means(&self.second)? * means(&self.first)?)
    }

    /// DP = DP_2 DP_1 of (18) by (20) and (21), as [`Pair::product`] has it by [`Passage::by_formula`]; the forcing at the
    /// impact between the flights is evaluated once for both.
    ///
    /// # Errors
    /// `Grazing` where a denominator, minus the velocity of arrival, is exactly 0.
    pub fn by_formula(&self) -> Result<Matrix2<T>, JacobianError> {
        let forcing = &self.first.forcing;
        let times = [&self.first.impact.time, &self.second.impact.time, &self.second.end()];
        let [start, between, end] = times.map(|time| forcing.at(time));
        Ok(self.second.entries(&between, &end)? * self.first.entries(&start, &between)?)
    }

    /// Tr(DP) by (22) with its three misprints mended: a factor epsilon_1 beside the first r_B, a factor epsilon_2
    /// beside the first r_T, and + r_B Zdot_k replaced by - in epsilon_4. Holds where t_{k+2} is t_k and a whole
    /// number of periods, whatever the velocities.
    ///
    /// # Errors
    /// `Grazing` where epsilon_1 or epsilon_2, the velocities of arrival up to sign, is exactly 0.
    pub fn trace_by_formula(&self) -> Result<T, JacobianError> {
        let Known {
            g,
            r_b,
            r_t,
            t_1,
            t_2,
            v,
            start,
            end,
        } = self.known();
        let e_1 = not_zero(start.f1.clone() - end.f1.clone() + v.clone() * r_b.clone() - g.clone() * t_1.clone())?;
        let integrals = start.f1 - end.f1 + g.clone() * t_2.clone();
        let e_2 = not_zero(integrals + r_t.clone() * e_1.clone())?;
        let e_3 = end.f.clone() * t_2.clone() + g.clone() * t_2.clone() + r_t.clone() * e_1.clone();
        let e_4 = start.f.clone() * t_1.clone() + g.clone() * t_1.clone() - v * r_b.clone();
        let (at_start, at_end) = (start.f + g.clone(), end.f + g);
        let both = e_1.clone() * e_2.clone();
        let head = (r_b.clone() * e_1.clone() + r_b.clone() * t_1.clone() * at_end.clone())
            * (r_t.clone() * e_2.clone() - r_t.clone() * t_2.clone() * at_start.clone())
            / both.clone();
        let cross = e_3.clone() * e_4.clone() / both;
        let by_top = r_t * t_2 / e_2.clone() * (at_start.clone() + e_4 / e_1.clone() * at_end.clone());
        let by_bottom = r_b * t_1 / e_1 * (at_end - e_3 / e_2 * at_start);
        Ok(head - cross - by_top + by_bottom)
    }

    /// Det(DP) by (23). Holds where [`Pair::trace_by_formula`] does; on a 1-1 orbit it is (r_B r_T)².
    ///
    /// # Errors
    /// `Grazing` where the denominator, the velocity of arrival at the bottom, is exactly 0.
    pub fn determinant_by_formula(&self) -> Result<T, JacobianError> {
        let Known {
            g,
            r_b,
            r_t,
            t_1,
            t_2,
            v,
            start,
            end,
        } = self.known();
        let both = r_b * r_t.clone();
        let above = both.clone() * both.clone() * v.clone();
        let integrals = start.f1.clone() - end.f1.clone() + r_t.clone() * start.f1 - r_t.clone() * end.f1;
        let below = integrals + g.clone() * t_2 - g * r_t * t_1 + v * both;
        Ok(above / not_zero(below)?)
    }

    fn known(&self) -> Known<T> {
        let Passage {
            motion,
            forcing,
            impact,
            duration,
        } = &self.first;
        Known {
            g: motion.g().clone(),
            r_b: motion.restitution(Side::Bottom).clone(),
            r_t: motion.restitution(Side::Top).clone(),
            t_1: duration.clone(),
            t_2: self.second.duration.clone(),
            v: impact.velocity.clone(),
            start: forcing.at(&impact.time),
            end: forcing.at(&self.first.end()),
        }
    }
}

/// What (22) and (23) are written in.
struct Known<T> {
    g: T,
    r_b: T,
    r_t: T,
    t_1: T,
    t_2: T,
    v: T,
    start: Forced<T>,
    end: Forced<T>,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_mended_formulas_are_trace_and_determinant_of_the_product() {
        let Ok(motion) = Motion::new(0.12, 0.4, 0.6, 0.3) else {
            panic!("a motion")
        };
        // any velocity and durations that add up to the period: the formulas ask for no more
        let pair = Pair::new(&motion, &Forcing::harmonic(&0.1), &0.25, &0.8, [&0.9, &1.1]);
        assert_eq!(pair.by_formula(), pair.product(Passage::by_formula));
        let Ok(product) = pair.by_formula() else {
            panic!("no grazing")
        };
        let near =
            |formula: Result<f64, JacobianError>, value: f64| formula.is_ok_and(|found| (found - value).abs() < 1e-12);
        assert!(near(pair.trace_by_formula(), product.trace()));
        assert!(near(pair.determinant_by_formula(), product.determinant()));
    }
}
