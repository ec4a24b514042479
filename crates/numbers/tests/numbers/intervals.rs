//! What an interval promises: the result of every number inside is inside, and a smaller interval has no larger
//! result. Numbers and results are computed in 80 digits, which is as good as exactly.

use numbers::{Analytic, DoubleDouble, Endpoint, Field, Interval, Rational, Wide};
use proptest::prelude::*;
use std::fmt::Display;

type Exact = Wide<80>;

/// An end that can be compared with the exact value. Zero has no sign here, as in an interval: the angle of a
/// negative zero is that of zero.
trait Known: Endpoint + Display {
    fn known(&self) -> Exact;
}
impl Known for f64 {
    fn known(&self) -> Exact {
        Exact::from_f64(*self + 0.0)
    }
}
impl Known for DoubleDouble {
    fn known(&self) -> Exact {
        Exact::from_f64(self.high() + 0.0) + Exact::from_f64(self.low() + 0.0)
    }
}
impl Known for Wide<20> {
    fn known(&self) -> Exact {
        if num_traits::Zero::is_zero(self) {
            Field::from_integer(0)
        } else {
            self.convert()
        }
    }
}

/// Whether the exact value is inside; a value that there is none of (a division by 0, overflow of the
/// reference) is not asked for.
fn holds<E: Known>(all: &Interval<E>, one: &Exact) -> bool {
    let from = !all.low().is_finite() || all.low().known() <= *one;
    let to = !all.high().is_finite() || *one <= all.high().known();
    !one.is_valid() || (from && to)
}

fn operations<T: Analytic>(x: &T, y: &T) -> Vec<(&'static str, T)> {
    let (a, b) = (|| x.clone(), || y.clone());
    vec![
        ("sum", a() + b()),
        ("difference", a() - b()),
        ("product", a() * b()),
        ("quotient", a() / b()),
        ("opposite", -a()),
        ("second power", x.to_power(2)),
        ("third power", x.to_power(3)),
        ("inverse fifth power", x.to_power(-5)),
    ]
}

fn functions<T: Analytic>(x: &T, y: &T) -> Vec<(&'static str, T)> {
    let (sin, cos) = x.sincos();
    let mut results = vec![
        ("sine", sin),
        ("cosine", cos),
        ("angle", y.atan2(x)),
        ("arc cosine", y.acos()),
    ];
    results.extend([("root", x.sqrt()), ("power", x.powf(y))]);
    results
}

/// Two intervals, each with a narrower one in it that holds the number.
struct Nested<E> {
    broad: [Interval<E>; 2],
    narrow: [Interval<E>; 2],
    inside: [E; 2],
}

/// From five numbers in order: broad ends, narrow ends, the one inside.
fn nested<E: Endpoint>(numbers: [[f64; 5]; 2]) -> Option<Nested<E>> {
    if numbers.iter().flatten().any(|number| !number.is_finite()) {
        return None;
    }
    let sorted = numbers.map(|mut five| {
        five.sort_by(f64::total_cmp);
        five.map(E::from_f64)
    });
    let part = |low: usize, high: usize| {
        sorted
            .clone()
            .map(|five| Interval::new(five[low].clone(), five[high].clone()))
    };
    Some(Nested {
        broad: part(0, 4),
        narrow: part(1, 3),
        inside: sorted.clone().map(|five| five[2].clone()),
    })
}

fn promises<E: Known>(
    numbers: [[f64; 5]; 2],
    all: impl Fn(&Interval<E>, &Interval<E>) -> Vec<(&'static str, Interval<E>)>,
    one: impl Fn(&Exact, &Exact) -> Vec<(&'static str, Exact)>,
) -> Result<(), TestCaseError> {
    let Some(Nested { broad, narrow, inside }) = nested::<E>(numbers) else {
        return Ok(());
    };
    let exact = one(&inside[0].known(), &inside[1].known());
    let narrow_results = all(&narrow[0], &narrow[1]);
    let broad_results = all(&broad[0], &broad[1]);
    for (((name, small), (_, large)), (_, value)) in narrow_results.iter().zip(&broad_results).zip(&exact) {
        prop_assert!(
            small.low() <= small.high() || small.is_whole(),
            "{name} of {narrow:?} is {small}"
        );
        prop_assert!(
            holds(small, value),
            "{name} of {inside:?} in {narrow:?} is {value}, not in {small}"
        );
        // what is outside a domain altogether, 0 as a divisor too, has no value, and claims nothing
        let outside = small.is_whole()
            && matches!(
                *name,
                "root" | "arc cosine" | "power" | "quotient" | "inverse fifth power"
            );
        prop_assert!(
            outside || small.is_subset(large),
            "{name} of {narrow:?} in {broad:?}: {small} not in {large}"
        );
    }
    Ok(())
}

fn five(one: impl Strategy<Value = f64> + Clone) -> impl Strategy<Value = [f64; 5]> {
    [one.clone(), one.clone(), one.clone(), one.clone(), one]
}

/// Numbers of which many are 0, equal or on a boundary of a function.
fn plain() -> impl Strategy<Value = f64> + Clone {
    prop_oneof![4 => -10.0..10.0_f64, 1 => Just(0.0), 1 => Just(-0.0), 1 => Just(1.0), 1 => Just(-1.0), 1 => -1.0..1.0_f64]
}

/// Every finite f64, all exponents alike.
fn every() -> impl Strategy<Value = f64> + Clone {
    any::<u64>().prop_map(f64::from_bits)
}

/// Five angles close to one of any size, so that extremes lie between some of them and not between others.
fn angles() -> impl Strategy<Value = [f64; 5]> {
    let size = prop_oneof![-30.0..30.0_f64, -1e6..1e6_f64, every()];
    let multiple = (-100_000..100_000_i64).prop_map(|quarters| (Exact::pi() * Exact::from_ratio(quarters, 2)).to_f64());
    let widths = prop_oneof![Just(0.0), Just(1e-15), Just(1e-9), Just(0.1), Just(2.0), Just(8.0)];
    (prop_oneof![size, multiple], widths, five(-1.0..1.0_f64))
        .prop_map(|(at, width, offsets)| offsets.map(|offset| at + offset * width))
}

fn within_both<E: Known>(numbers: [[f64; 5]; 2]) -> Result<(), TestCaseError> {
    promises::<E>(numbers, operations, operations)?;
    promises::<E>(numbers, functions, functions)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1000))]

    #[test]
    fn results_are_inside_and_grow_with_the_interval(x in five(plain()), y in five(plain())) {
        within_both::<f64>([x, y])?;
    }

    #[test]
    fn arithmetic_holds_over_the_whole_range(x in five(every()), y in five(every())) {
        promises::<f64>([x, y], operations, operations)?;
        promises::<DoubleDouble>([x, y], operations, operations)?;
    }

    #[test]
    fn extremes_inside_are_found_for_angles_of_any_size(x in angles()) {
        promises::<f64>([x, x], |x, _| pair(x), |x, _| pair(x))?;
    }
}

proptest! {
    // functions of many digits take a tenth of a millisecond each
    #![proptest_config(ProptestConfig::with_cases(40))]

    #[test]
    fn results_in_more_digits_are_inside_and_grow_with_the_interval(x in five(plain()), y in five(plain())) {
        within_both::<DoubleDouble>([x, y])?;
        within_both::<Wide<20>>([x, y])?;
    }

    #[test]
    fn extremes_inside_are_found_in_more_digits(x in angles()) {
        promises::<DoubleDouble>([x, x], |x, _| pair(x), |x, _| pair(x))?;
        promises::<Wide<20>>([x, x], |x, _| pair(x), |x, _| pair(x))?;
    }

    #[test]
    fn a_rational_is_inside_what_embeds_it(n in any::<i64>(), d in 1..i64::MAX) {
        let Some(value) = Rational::new(n, d) else { return Ok(()) };
        let exact = Exact::from_integer(n) / Exact::from_integer(d);
        let inside = |all: Option<Interval<f64>>| all.is_some_and(|all| holds(&all, &exact));
        prop_assert!(inside(value.embed()) && inside(Some(Interval::from_ratio(n, d))));
        let Some(all) = value.embed::<Interval<DoubleDouble>>() else { return Ok(()) };
        prop_assert!(holds(&all, &exact) && all.width().to_f64() <= 1e-28 * exact.to_f64().abs());
        let Some(all) = value.embed::<Interval<Wide<20>>>() else { return Ok(()) };
        prop_assert!(holds(&all, &exact));
    }
}

fn pair<T: Analytic>(x: &T) -> Vec<(&'static str, T)> {
    let (sin, cos) = x.sincos();
    vec![("sine", sin), ("cosine", cos)]
}

/// One ulp on either side and no more: an interval that is right but wide proves nothing.
#[test]
fn results_are_no_wider_than_rounding_asks() {
    let x = Interval::point(0.7_f64);
    let y = Interval::point(0.3_f64);
    for (name, result) in operations(&x, &y).into_iter().take(6).chain(functions(&x, &y)) {
        let ulps = result.width() / (result.magnitude() * f64::EPSILON);
        let allowed = if name == "power" { 5.0 } else { 2.5 };
        assert!(ulps <= allowed, "{name} is {ulps} ulps wide");
    }
}

/// An end that is not a number must not pass as one that claims something.
#[test]
fn what_has_no_value_claims_nothing() {
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        assert!(Interval::<f64>::from_f64(bad).is_whole() && Interval::<Wide<20>>::from_f64(bad).is_whole());
        assert!(Interval::<DoubleDouble>::from_f64(bad).is_whole());
    }
    fn whole<E: Known>() {
        let (all, one) = (Interval::<E>::whole(), Interval::point(E::one()));
        assert!(all.contains(&E::one()) && all.contains_zero() && all == Interval::whole() && one.is_inside(&all));
        for (name, result) in operations(&all, &one) {
            // even powers may know that they are not negative
            assert!(
                result.is_whole() || result.low().is_zero() || result.low() < E::zero(),
                "{name}: {result}"
            );
            assert!(!result.high().is_finite(), "{name}: {result}");
        }
        let (sin, cos) = all.sincos();
        assert!(sin == Interval::new(-E::one(), E::one()) && cos == sin);
        assert_eq!(all.intersection(&one), Some(one.clone()));
        assert!(all.hull(&one).is_whole() && (one.clone() / (one.clone() - one)).is_whole());
    }
    whole::<f64>();
    whole::<DoubleDouble>();
    whole::<Wide<20>>();
}
