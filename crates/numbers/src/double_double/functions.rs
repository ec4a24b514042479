//! The functions of flights.
//!
//! Sine and cosine: the angle less the nearest multiple of pi/2, with pi/2 in five pieces (185 bits); the rest as
//! j/32 + t with |t| <= 1/64; sine and cosine of j/32 from a table, of t by Taylor's polynomials, whose terms below
//! 2^-60 are summed in f64; and the theorem of addition. Each of the ten products and sums of parts is below 1.5
//! times the result and rounded within 7 u²: below 64 u² in all. Arcs: the angle in f64, and one step of Newton's
//! method on it, which leaves the cube of 2^-52.

use super::DoubleDouble;
use crate::derivable::Elementary;
use crate::error_free::{quick_two_sum, two_sum};
use crate::{Analytic, Field, Wide};
use num_traits::{One, Zero};
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};
use std::sync::LazyLock;

/// Digits that a constant is computed with.
type Exact = Wide<80>;

/// Angles up to this size are reduced here: 2^20 quarters of a turn.
const LARGEST: f64 = (1_u64 << 20) as f64 * FRAC_PI_2;
/// What is left of an angle is reduced again in many digits where it is smaller than this.
const CANCELLED: f64 = 1.0 / (1_u64 << 50) as f64;
/// Steps of the table in a unit of angle.
const STEPS: f64 = 32.0;

struct Constants {
    pi: DoubleDouble,
    /// pi/2: four pieces of 33 bits, whose products by integers up to 2^20 are exact, and one of 53.
    pieces: [f64; 5],
    /// Sine and cosine of j/32, for angles up to pi/4.
    table: Vec<(DoubleDouble, DoubleDouble)>,
    /// 1/3!, 1/5!, 1/7! and 1/2!, 1/4!, 1/6!, with signs.
    sine: [DoubleDouble; 3],
    cosine: [DoubleDouble; 3],
}

static CONSTANTS: LazyLock<Constants> = LazyLock::new(|| {
    let half_turn = Exact::pi();
    let mut left = half_turn.clone() / Exact::from_integer(2);
    let mut pieces = [0.0; 5];
    for (index, piece) in pieces.iter_mut().enumerate() {
        let nearest = left.to_f64();
        // 20 bits fewer, so that the product by 20 bits fits
        *piece = if index < 4 {
            f64::from_bits(nearest.to_bits() >> 20 << 20)
        } else {
            nearest
        };
        left -= Exact::from_f64(*piece);
    }
    let entry = |j: i64| {
        let (sin, cos) = Exact::from_ratio(j, STEPS as i64).sincos();
        (DoubleDouble::from_wide(&sin), DoubleDouble::from_wide(&cos))
    };
    let reciprocal = |factorial: i64| DoubleDouble::from_ratio(1, factorial);
    Constants {
        pi: DoubleDouble::from_wide(&half_turn),
        pieces,
        table: (0..=26).map(entry).collect(),
        sine: [-6, 120, -5040].map(reciprocal),
        cosine: [-2, 24, -720].map(reciprocal),
    }
});

impl DoubleDouble {
    /// Sine and cosine of up to 1/64 in size.
    #[inline]
    fn small_sincos(self, constants: &Constants) -> (Self, Self) {
        let square = self * self;
        let s = square.high;
        let tail = |terms: [f64; 3]| terms[0] + s * (terms[1] + s * terms[2]);
        // 1/9!, 1/11!, 1/13! and 1/8!, 1/10!, 1/12!
        let sine_tail = tail([1.0 / 362_880.0, -1.0 / 39_916_800.0, 1.0 / 6_227_020_800.0]);
        let cosine_tail = tail([1.0 / 40_320.0, -1.0 / 3_628_800.0, 1.0 / 479_001_600.0]);
        let series = |terms: &[Self; 3], tail: f64| {
            let third = terms[2] + Self::from_parts(s * tail, 0.0);
            ((third * square + terms[1]) * square + terms[0]) * square
        };
        let sin = series(&constants.sine, sine_tail) * self + self;
        let cos = series(&constants.cosine, cosine_tail) + Self::one();
        (sin, cos)
    }

    /// Sine and cosine of up to pi/4 in size.
    #[inline]
    fn reduced_sincos(self, constants: &Constants) -> (Self, Self) {
        let index = (self.high.abs() * STEPS).round();
        if index == 0.0 {
            return self.small_sincos(constants);
        }
        let Some(&(table_sin, table_cos)) = constants.table.get(index as usize) else {
            return self.sincos_through_wide();
        };
        let negative = self.high < 0.0;
        let size = if negative { -self } else { self };
        let (sin, cos) = (size - Self::from_parts(index / STEPS, 0.0)).small_sincos(constants);
        let sine = table_sin * cos + table_cos * sin;
        let cosine = table_cos * cos - table_sin * sin;
        (if negative { -sine } else { sine }, cosine)
    }

    /// The angle less `quarters` times pi/2; `None` where too many digits cancel.
    #[inline]
    fn less_quarters(self, quarters: f64, pieces: &[f64; 5]) -> Option<Self> {
        let (sum, first) = two_sum(self.high, -(quarters * pieces[0]));
        let (sum, second) = two_sum(sum, -(quarters * pieces[1]));
        let (sum, third) = two_sum(sum, self.low);
        let (sum, fourth) = two_sum(sum, -(quarters * pieces[2]));
        let (errors, fifth) = two_sum(first, second);
        let (errors, sixth) = two_sum(errors, third);
        let (errors, seventh) = two_sum(errors, fourth);
        let (errors, eighth) = two_sum(errors, -(quarters * pieces[3]));
        let rest = (fifth + sixth) + (seventh + eighth) - quarters * pieces[4];
        let (high, low) = two_sum(sum, errors);
        let (high, low) = quick_two_sum(high, low + rest);
        (high.abs() > CANCELLED).then_some(Self { high, low })
    }

    /// By the theorem of addition on the two parts, so that their exponents may be far apart.
    #[cold]
    fn sincos_through_wide(self) -> (Self, Self) {
        let (a_sin, a_cos) = Exact::from_f64(self.high).sincos();
        let (b_sin, b_cos) = Exact::from_f64(self.low).sincos();
        let sin = a_sin.clone() * b_cos.clone() + a_cos.clone() * b_sin.clone();
        let cos = a_cos * b_cos - a_sin * b_sin;
        (Self::from_wide(&sin), Self::from_wide(&cos))
    }

    /// The angle in [-pi/2, pi/2] whose sine is `self`, for `self` in [-1, 1].
    pub fn asin(&self) -> Self {
        Analytic::atan2(self, &self.cosine_of_arc())
    }

    /// The root of 1 - x², as (1 - x)(1 + x), which keeps its digits near the ends; NaN beyond.
    fn cosine_of_arc(&self) -> Self {
        ((Self::one() - *self) * (Self::one() + *self)).root()
    }

    /// An angle as f64 has it, one of the multiples of pi/4 that infinities and zeros have.
    fn multiple_of_eighth(angle: f64) -> Self {
        if angle == 0.0 || angle.is_nan() {
            return Self::from_parts(angle, 0.0);
        }
        let eighths = (angle / FRAC_PI_4).round();
        CONSTANTS.pi * Self::from_parts(eighths * 0.25, 0.0)
    }
}

impl Analytic for DoubleDouble {
    fn pi() -> Self {
        CONSTANTS.pi
    }

    #[inline]
    fn sqrt(&self) -> Self {
        self.root()
    }

    fn sincos(&self) -> (Self, Self) {
        let size = self.high.abs();
        if size == 0.0 {
            return (*self, Self::one());
        }
        if !size.is_finite() {
            let none = Self::from_parts(f64::NAN, 0.0);
            return (none, none);
        }
        let constants = &*CONSTANTS;
        if size <= FRAC_PI_4 {
            return self.reduced_sincos(constants);
        }
        if size > LARGEST {
            return self.sincos_through_wide();
        }
        let quarters = (self.high / FRAC_PI_2).round();
        let Some(rest) = self.less_quarters(quarters, &constants.pieces) else {
            return self.sincos_through_wide();
        };
        let (sin, cos) = rest.reduced_sincos(constants);
        match (quarters as i64).rem_euclid(4) {
            0 => (sin, cos),
            1 => (cos, -sin),
            2 => (-sin, -cos),
            _ => (-cos, sin),
        }
    }

    fn acos(&self) -> Self {
        if *self == Self::one() {
            return Self::zero();
        }
        Analytic::atan2(&self.cosine_of_arc(), self)
    }

    fn atan2(&self, x: &Self) -> Self {
        let rough = self.high.atan2(x.high);
        let special = |part: f64| part == 0.0 || !part.is_finite();
        if special(self.high) || special(x.high) {
            return Self::multiple_of_eighth(rough);
        }
        // both scaled by one power of two; if the smaller vanishes, so does what it does to the angle
        let ((y_unit, y_power), (x_unit, x_power)) = (self.normalised(), x.normalised());
        let apart = y_power - x_power;
        if apart < -900 {
            return if x.high > 0.0 {
                *self / *x
            } else {
                Self::multiple_of_eighth(rough)
            };
        }
        if apart > 900 {
            return Self::multiple_of_eighth(rough);
        }
        let (y, x) = (y_unit.scaled(apart.min(0)), x_unit.scaled((-apart).min(0)));
        let rough = y.high.atan2(x.high);
        let (sin, cos) = Self::from_parts(rough, 0.0).sincos();
        let step = (y * cos - x * sin) / (x * cos + y * sin);
        Self::from_parts(rough, 0.0) + step
    }

    /// Rounded to nearest, through many digits; NaN for a negative base.
    fn powf(&self, exponent: &Self) -> Self {
        let rough = self.high.powf(exponent.high);
        let special = |part: f64| part == 0.0 || !part.is_finite();
        if special(self.high) || special(exponent.high) {
            return Self::from_parts(rough, 0.0);
        }
        let power = exponent.to_wide();
        let value = if self.high == 1.0 {
            // the second part alone is the distance from 1, however small
            let logarithm = Wide::from_f64(self.low).elementary(Elementary::Ln1p);
            (power * logarithm).elementary(Elementary::Exp)
        } else {
            self.to_wide().powf(&power)
        };
        Self::through_wide(&value, self.high > 0.0, rough)
    }

    #[inline]
    fn from_f64(value: f64) -> Self {
        Self { high: value, low: 0.0 }
    }

    #[inline]
    fn to_f64(&self) -> f64 {
        self.high
    }

    /// 2^-105: twice u², to which the parts are rounded. There are numbers nearer to 1.
    fn epsilon() -> Self {
        Self::from_parts(1.0 / (1_u128 << 105) as f64, 0.0)
    }
}
