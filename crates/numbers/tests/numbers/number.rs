//! Laws that every number must keep, each to the digits it promises.

use num_dual::DualNum;
use num_traits::{One, Zero};
use numbers::{Analytic, Counted, DoubleDouble, Dual, Field, Rational, Wide};
use proptest::prelude::*;

/// The one helper of comparisons: all parts of a number, dual parts too, as f64. `==` and approx look at the
/// real part of a dual number alone.
trait Parts {
    fn parts(&self) -> Vec<f64>;
}
impl Parts for f32 {
    fn parts(&self) -> Vec<f64> {
        vec![f64::from(*self)]
    }
}
impl Parts for f64 {
    fn parts(&self) -> Vec<f64> {
        vec![*self]
    }
}
impl Parts for Counted<f64> {
    fn parts(&self) -> Vec<f64> {
        vec![self.0]
    }
}
impl Parts for DoubleDouble {
    fn parts(&self) -> Vec<f64> {
        vec![self.high(), self.low()]
    }
}
impl<const DIGITS: usize> Parts for Wide<DIGITS> {
    fn parts(&self) -> Vec<f64> {
        vec![self.to_f64()]
    }
}
impl<T: Parts> Parts for Dual<T> {
    fn parts(&self) -> Vec<f64> {
        [self.re.parts(), self.eps.parts()].concat()
    }
}

/// Every part of `left - right` is within `tolerance` of 0: the subtraction is done in the number itself.
fn close<T: Field + Parts>(left: &T, right: &T, tolerance: f64) -> bool {
    let apart = left.clone() - right.clone();
    let zeros = vec![0.0; apart.parts().len()];
    approx::relative_eq!(apart.parts().as_slice(), zeros.as_slice(), epsilon = tolerance)
}

/// Operands are below 8 in size, so products of three below 512 and their derivatives below 192: with some ten
/// roundings of half an epsilon each, 4096 epsilons bound every law below with room.
fn tolerance<T: Analytic>() -> f64 {
    4096.0 * T::epsilon().to_f64()
}

fn field_laws<T: Field>(a: &T, b: &T, c: &T, same: impl Fn(&T, &T) -> bool) -> Result<(), TestCaseError> {
    let [x, y, z] = [a, b, c].map(|number| move || number.clone());
    prop_assert!(same(&(x() + y()), &(y() + x())), "sum commutes");
    prop_assert!(same(&(x() * y()), &(y() * x())), "product commutes");
    prop_assert!(same(&((x() + y()) + z()), &(x() + (y() + z()))), "sum associates");
    prop_assert!(same(&((x() * y()) * z()), &(x() * (y() * z()))), "product associates");
    prop_assert!(
        same(&(x() * (y() + z())), &(x() * y() + x() * z())),
        "product distributes"
    );
    prop_assert!(
        same(&(x() + T::zero()), &x()) && same(&(x() * T::one()), &x()),
        "neutral elements"
    );
    prop_assert!(same(&(x() + (-x())), &T::zero()), "opposite");
    prop_assert!(same(&(x() - y()), &(x() + (-y()))), "difference");
    prop_assert!(same(&(x() * y() / y()), &x()), "quotient undoes product");
    prop_assert!(same(&x().to_power(3), &(x() * x() * x())), "power");
    let (mut sum, mut product) = (x(), x());
    sum += y();
    product *= y();
    prop_assert!(same(&sum, &(x() + y())) && same(&product, &(x() * y())), "assigning");
    sum -= y();
    product /= y();
    prop_assert!(same(&sum, &x()) && same(&product, &x()), "assigning back");
    Ok(())
}

fn function_laws<T: Analytic + Parts>(angle: &T, size: &T) -> Result<(), TestCaseError> {
    let same = |a: &T, b: &T| close(a, b, tolerance::<T>());
    let (sin, cos) = angle.sincos();
    let one = sin.clone() * sin.clone() + cos.clone() * cos.clone();
    prop_assert!(same(&one, &T::one()), "sin² + cos² = 1");
    let back = (size.clone() * sin.clone()).atan2(&(size.clone() * cos.clone()));
    prop_assert!(same(&back, angle), "atan2 undoes polar coordinates");
    // the arc cosine is in [0, pi]; where its slope is steep, the rounding of cos is magnified by 1/sin
    if sin.to_f64().abs() > 0.1 {
        let folded = if angle.to_f64() < 0.0 {
            -angle.clone()
        } else {
            angle.clone()
        };
        prop_assert!(same(&cos.acos(), &folded), "acos undoes cos");
    }
    let root = size.sqrt();
    prop_assert!(same(&(root.clone() * root), size), "root squared");
    let half = T::from_ratio(1, 2);
    prop_assert!(same(&size.powf(&half), &size.sqrt()), "root as a power");
    Ok(())
}

/// Numbers of either sign that a division by is well conditioned.
fn operand() -> impl Strategy<Value = f64> {
    (0.125..8.0_f64, any::<bool>()).prop_map(|(size, negative)| if negative { -size } else { size })
}

fn dual<T: Field>(re: T, eps: T) -> Dual<T> {
    Dual::new(re, eps)
}

proptest! {
    #[test]
    fn rationals_keep_the_field_laws_exactly(
        a in any::<(i32, i16)>(), b in any::<(i32, i16)>(), c in any::<(i32, i16)>()
    ) {
        let number = |(n, d): (i32, i16)| Rational::new(i64::from(n), i64::from(d).abs() + 1);
        let (Some(a), Some(b), Some(c)) = (number(a), number(b), number(c)) else { return Ok(()) };
        prop_assume!(!b.is_zero());
        field_laws(&a, &b, &c, |left, right| left == right)?;
    }

    #[test]
    fn floats_keep_the_field_laws(a in operand(), b in operand(), c in operand()) {
        field_laws(&a, &b, &c, |l, r| close(l, r, tolerance::<f64>()))?;
        let [x, y, z] = [a, b, c].map(|n| n as f32);
        field_laws(&x, &y, &z, |l, r| close(l, r, tolerance::<f32>()))?;
        let [x, y, z] = [a, b, c].map(Counted);
        field_laws(&x, &y, &z, |l, r| close(l, r, tolerance::<f64>()))?;
    }

    #[test]
    fn wide_numbers_keep_the_field_laws(a in operand(), b in operand(), c in operand()) {
        let third = Wide::<40>::from_ratio(1, 3);
        let [x, y, z] = [a, b, c].map(|n| Wide::<40>::from_f64(n) * third.clone());
        field_laws(&x, &y, &z, |l, r| close(l, r, 1e-40))?;
    }

    #[test]
    fn double_doubles_and_their_duals_keep_the_field_laws(a in operand(), b in operand(), c in operand()) {
        let third = DoubleDouble::from_ratio(1, 3);
        let [x, y, z] = [a, b, c].map(|n| DoubleDouble::from_f64(n) * third);
        field_laws(&x, &y, &z, |l, r| close(l, r, tolerance::<DoubleDouble>()))?;
        let [x, y, z] = [(x, y), (y, z), (z, x)].map(|(re, eps)| dual(re, eps));
        field_laws(&x, &y, &z, |l, r| close(l, r, 1e6 * tolerance::<DoubleDouble>()))?;
        function_laws(&dual(x.re * third, y.re), &dual(x.re * x.re + third, z.re))?;
    }

    #[test]
    fn duals_keep_the_field_laws_in_both_parts(
        a in (operand(), operand()), b in (operand(), operand()), c in (operand(), operand())
    ) {
        let [x, y, z] = [a, b, c].map(|(re, eps)| dual(re, eps));
        // a division by 0.125 squared enters the dual part
        field_laws(&x, &y, &z, |l, r| close(l, r, 1024.0 * tolerance::<f64>()))?;
        let [x, y, z] = [a, b, c].map(|(re, eps)| dual(Wide::<40>::from_f64(re), Wide::from_f64(eps)));
        field_laws(&x, &y, &z, |l, r| close(l, r, 1e-40))?;
        let [x, y, z] = [(a, b), (b, c), (c, a)]
            .map(|((p, q), (r, s))| dual(dual(p, q), dual(r, s)));
        field_laws(&x, &y, &z, |l, r| close(l, r, 1024.0 * 1024.0 * tolerance::<f64>()))?;
    }

    #[test]
    fn functions_undo_each_other(angle in -3.0..3.0_f64, size in 0.125..8.0_f64) {
        function_laws(&angle, &size)?;
        function_laws(&(angle as f32), &(size as f32))?;
        function_laws(&Counted(angle), &Counted(size))?;
        function_laws(&Wide::<40>::from_f64(angle), &Wide::from_f64(size))?;
    }

    #[test]
    fn functions_of_duals_undo_each_other_in_both_parts(
        angle in -3.0..3.0_f64, size in 0.5..8.0_f64, turn in -1.0..1.0_f64, growth in -1.0..1.0_f64
    ) {
        function_laws(&dual(angle, turn), &dual(size, growth))?;
        let wide = Wide::<40>::from_f64;
        function_laws(&dual(wide(angle), wide(turn)), &dual(wide(size), wide(growth)))?;
    }

    #[test]
    fn every_finite_f64_passes_through_and_the_rest_stays_no_number(bits in any::<u64>()) {
        let value = f64::from_bits(bits);
        let back = [
            <f64 as Analytic>::from_f64(value).to_f64(),
            Wide::<40>::from_f64(value).to_f64(),
            Counted::<f64>::from_f64(value).to_f64(),
            Dual::<f64>::from_f64(value).to_f64(),
        ];
        for back in back {
            prop_assert!(back == value || !value.is_finite());
            prop_assert!(!back.is_finite() || value.is_finite());
        }
        let narrow = f32::from_bits(bits as u32);
        prop_assert!(narrow.is_nan() || <f32 as Analytic>::from_f64(f64::from(narrow)) == narrow);
    }

    #[test]
    fn sixty_digits_agree_with_forty(a in operand(), b in operand()) {
        let (few, many) = (Wide::<40>::from_f64, Wide::<60>::from_f64);
        let few = Analytic::atan2(&(few(a).sincos().0 / few(b)), &few(b));
        let many = Analytic::atan2(&(many(a).sincos().0 / many(b)), &many(b));
        prop_assert!((lengthened(&few) - many).to_f64().abs() < 1e-40);
    }
}

/// The same value in 60 digits, limb by limb: each limb is what f64 has left to say.
fn lengthened(value: &Wide<40>) -> Wide<60> {
    let (mut left, mut sum) = (value.clone(), Wide::<60>::zero());
    for _ in 0..5 {
        let limb = left.to_f64();
        left -= Wide::from_f64(limb);
        sum += Wide::<60>::from_f64(limb);
    }
    sum
}

proptest! {
    #[test]
    fn no_function_of_a_wide_number_panics_on_any_bits(a in any::<u64>(), b in any::<u64>(), power in -2000..2000_i32) {
        let [a, b] = [a, b].map(|bits| Wide::<40>::from_f64(f64::from_bits(bits)));
        let far = a.to_power(power);
        for (x, y) in [(&a, &b), (&far, &b), (&b, &far)] {
            let (u, v) = (|| x.clone(), || y.clone());
            let results = [u() + v(), u() - v(), u() * v(), u() / v(), Analytic::atan2(&u(), &v()), Analytic::powf(&u(), &v())];
            let more = [Analytic::sqrt(x), Analytic::acos(x), x.sincos().0, DualNum::exp(x), x.ln(), x.tan(), x.sinh()];
            for result in results.iter().chain(&more) {
                // reading back and printing neither panic
                prop_assert!(result.is_valid() || result.to_f64().is_nan());
            }
        }
    }
}

#[test]
fn zero_and_one_are_what_they_say() {
    assert!(Wide::<40>::zero().is_zero() && !Wide::<40>::one().is_zero());
    assert!(!Wide::<40>::INVALID.is_zero());
    assert!(Rational::zero().is_zero() && Counted::<f32>::zero().is_zero());
}

#[test]
fn tangents_of_double_doubles_are_those_of_more_digits() {
    let third = DoubleDouble::from_ratio(1, 3);
    for n in [0.1, 1.0, 4.5, -7.25, 1e4] {
        let x = DoubleDouble::from_f64(n) * third;
        let (found, expected) = (x.tan().to_wide::<60>(), x.to_wide::<60>().tan());
        let error = ((found - expected.clone()) / expected).to_f64().abs();
        assert!(error < 1e-30, "{n}: {error}");
    }
}
