//! The paper's own three equations for a 1-1 orbit, (14) to (16), and Newton's method on them.
//!
//! For comparison: they divide by 1 - r_B r_T, by r_B (T_1 - r_T T_2) and by r_B T_1, and lose digits where one of
//! these is small; [`OneOneEquations`](dynamics::orbit::OneOneEquations) has no denominator. They are those of motions over one forcing period.

use dynamics::model::{Forcing, Motion, Side};
use num_dual::DualNum;
use numbers::{Analytic, Dual, seeded};

/// Steps before Newton's method is given up.
const MOST_STEPS: usize = 60;

/// Which (16) is meant.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Eq16 {
    /// As printed: `- F_1(t_k) T_1` outside of the bracket, so that its factor 1/(r_B T_1) is missing.
    AsPrinted,
    /// With that term inside.
    Mended,
}

/// How the derivatives of the equations are found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DerivativeMethod {
    /// By dual numbers, exactly.
    Duals,
    /// By forward differences over the root of a rounding.
    Differences,
}

/// (14), (15) and (16) in t_k, T_1 and Zdot_k.
#[derive(Clone, Debug)]
pub struct PaperEquations<T> {
    motion: Motion<T>,
    forcing: Forcing<T>,
    sixteen: Eq16,
}

impl<T: Analytic> PaperEquations<T> {
    /// The equations of a motion under f = cos(pi t).
    pub fn new(motion: &Motion<T>, sixteen: Eq16) -> Self {
        let (motion, forcing) = (motion.clone(), Forcing::harmonic(&T::zero()));
        Self {
            motion,
            forcing,
            sixteen,
        }
    }

    /// Zdot_k minus the right sides of (14), (15) and (16), term by term as the paper prints them; T = 2.
    pub fn residuals(&self, [time, t_1, velocity]: &[T; 3]) -> [T; 3] {
        let [r_b, r_t] = [Side::Bottom, Side::Top].map(|side| self.motion.restitution(side).clone());
        let (g, d) = (self.motion.g().clone(), self.motion.d().clone());
        let (start, end) = (self.forcing.at(time), self.forcing.at(&(time.clone() + t_1.clone())));
        let two = T::from_integer(2);
        let t_2 = two.clone() - t_1.clone();
        let half = g.clone() / two.clone();
        let gained = g.clone() * t_1.clone() + end.f1.clone() - start.f1.clone();
        let fourteen = (g * two - (T::one() + r_t.clone()) * gained.clone()) / (T::one() - r_b.clone() * r_t.clone());
        let squares = t_1.clone() * t_1.clone() + t_2.clone() * t_2.clone();
        let bracket = half.clone() * squares
            - r_t.clone() * t_2.clone() * gained
            - start.f1.clone() * t_1.clone()
            - end.f1 * t_2.clone();
        let fifteen = bracket / (r_b.clone() * t_1.clone() - r_b.clone() * r_t * t_2);
        let fallen = d + half * t_1.clone() * t_1.clone() + end.f2 - start.f2;
        let carried = start.f1 * t_1.clone();
        let below = r_b * t_1.clone();
        let sixteen = match self.sixteen {
            Eq16::AsPrinted => fallen / below - carried,
            Eq16::Mended => (fallen - carried) / below,
        };
        [fourteen, fifteen, sixteen].map(|right| velocity.clone() - right)
    }

    /// Zdot_{k+1}, from (9).
    pub fn velocity_at_top(&self, [time, t_1, velocity]: &[T; 3]) -> T {
        let (start, end) = (self.forcing.at(time), self.forcing.at(&(time.clone() + t_1.clone())));
        let launch = self.motion.restitution(Side::Bottom).clone() * velocity.clone();
        self.motion.g().clone() * t_1.clone() - launch + end.f1 - start.f1
    }

    /// Where Newton's method leads from `guess`, to the precision of `T` where it converges.
    ///
    /// `None` where the steps do not settle. What is found solves the equations chosen, as printed or mended.
    pub fn solved(&self, guess: [T; 3], slopes: DerivativeMethod) -> Option<[T; 3]>
    where
        T: DualNum,
    {
        let mut point = guess;
        let mut last = f64::INFINITY;
        for _ in 0..MOST_STEPS {
            let values = self.residuals(&point);
            let columns = match slopes {
                DerivativeMethod::Duals => self.by_duals(&point)?,
                DerivativeMethod::Differences => self.by_differences(&point, &values),
            };
            let step = solved(&columns, &values);
            let size = step.iter().map(|part| part.to_f64().abs()).sum::<f64>();
            if !size.is_finite() {
                return None;
            }
            for (unknown, step) in point.iter_mut().zip(step) {
                *unknown -= step;
            }
            // quadratic near the end, linear over differences: rounding is reached where steps stop shrinking
            if size <= T::epsilon().to_f64() || (size >= last && last < 1e-4) {
                return Some(point);
            }
            last = size;
        }
        None
    }

    fn by_duals(&self, point: &[T; 3]) -> Option<[[T; 3]; 3]>
    where
        T: DualNum,
    {
        let motion = self.motion.convert(|value| Dual::from_re(value.clone())).ok()?;
        let triple = PaperEquations::new(&motion, self.sixteen);
        Some(std::array::from_fn(|column| {
            let at = std::array::from_fn(|unknown| {
                let value = point[unknown].clone();
                if unknown == column {
                    seeded(value)
                } else {
                    Dual::from_re(value)
                }
            });
            triple.residuals(&at).map(|value| value.eps)
        }))
    }

    fn by_differences(&self, point: &[T; 3], values: &[T; 3]) -> [[T; 3]; 3] {
        // a power of 2, added without rounding to numbers of order 1
        let step = T::from_f64((0.5 * T::epsilon().to_f64().log2()).round().exp2());
        std::array::from_fn(|column| {
            let mut at = point.clone();
            at[column] += step.clone();
            let moved = self.residuals(&at);
            std::array::from_fn(|row| (moved[row].clone() - values[row].clone()) / step.clone())
        })
    }
}

/// x of sum_j columns_j x_j = values, by Cramer's rule.
fn solved<T: Analytic>(columns: &[[T; 3]; 3], values: &[T; 3]) -> [T; 3] {
    let below = determinant([&columns[0], &columns[1], &columns[2]]);
    std::array::from_fn(|unknown| {
        let mut replaced = columns.each_ref();
        replaced[unknown] = values;
        determinant(replaced) / below.clone()
    })
}

fn determinant<T: Analytic>([a, b, c]: [&[T; 3]; 3]) -> T {
    let minor = |i: usize, j: usize| b[i].clone() * c[j].clone() - b[j].clone() * c[i].clone();
    a[0].clone() * minor(1, 2) - a[1].clone() * minor(0, 2) + a[2].clone() * minor(0, 1)
}

#[cfg(test)]
mod tests {
    use super::*;
    use numbers::Wide;

    fn found<T: Analytic + DualNum>(sixteen: Eq16, slopes: DerivativeMethod) -> Option<[T; 3]> {
        let ratio = T::from_ratio;
        let motion = Motion::new(ratio(12_201, 100_000), ratio(2, 5), ratio(1, 2), ratio(1, 2)).expect("a motion");
        let guess = [(1, 6), (21, 20), (4, 5)].map(|(above, below)| ratio(above, below));
        PaperEquations::new(&motion, sixteen).solved(guess, slopes)
    }

    #[test]
    fn the_mended_equations_lead_to_the_orbit_in_every_number() {
        for slopes in [DerivativeMethod::Duals, DerivativeMethod::Differences] {
            let [time, t_1, velocity] = found::<f64>(Eq16::Mended, slopes).expect("an orbit");
            // FACTS: v .8327202251, phase .4893951147, T1 1.1165006593
            assert!(
                (time * std::f64::consts::PI - 0.489_395_114_7).abs() < 1e-9,
                "{slopes:?}"
            );
            assert!((t_1 - 1.116_500_659_3).abs() < 1e-9 && (velocity - 0.832_720_225_1).abs() < 1e-9);
            let wide = found::<Wide<50>>(Eq16::Mended, slopes).expect("an orbit");
            assert!((wide[2].to_f64() - velocity).abs() < 1e-14);
        }
    }

    #[test]
    fn as_printed_they_lead_elsewhere() {
        let printed = found::<f64>(Eq16::AsPrinted, DerivativeMethod::Duals);
        assert!(
            printed.is_none_or(|[_, t_1, _]| (t_1 - 1.116_500_659_3).abs() > 1e-2),
            "{printed:?}"
        );
    }
}
