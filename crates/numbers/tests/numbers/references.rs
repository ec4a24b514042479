//! Every number against two references that know nothing of each other, dashu (through `Wide`) and astro-float, on
//! random arguments and on the hardest known: near multiples of pi/2, tiny, huge, subnormal, infinite.

use astro_float::{BigFloat, Consts, Radix, RoundingMode};
use numbers::{Analytic, DoubleDouble, Endpoint, Field, Sequence, Wide};
use std::cell::RefCell;

type Exact = Wide<80>;

/// Bits of the second reference: room for the gap between the two parts of a double-double.
const BITS: usize = 1280;
const NEAREST: RoundingMode = RoundingMode::ToEven;

thread_local! {
    static CONSTANTS: RefCell<Consts> = RefCell::new(Consts::new().expect("memory for constants"));
}

fn read(value: &BigFloat) -> Exact {
    let text = CONSTANTS.with_borrow_mut(|constants| value.format(Radix::Dec, NEAREST, constants));
    Exact::parse(&text.expect("a decimal")).expect("a number")
}

/// An f64 for astro-float, which reads a subnormal as half of it (0.9.6): taken out of that range first.
fn limb(part: f64) -> BigFloat {
    let scale = 2.0_f64.powi(200);
    if part.abs() > f64::MIN_POSITIVE {
        return BigFloat::from_f64(part, BITS);
    }
    BigFloat::from_f64(part * scale, BITS).div(&BigFloat::from_f64(scale, BITS), BITS, NEAREST)
}

fn big(value: DoubleDouble) -> BigFloat {
    let [high, low] = [value.high(), value.low()].map(limb);
    high.add(&low, BITS, NEAREST)
}

/// Sine and cosine by astro-float.
fn second_sincos(x: DoubleDouble) -> (Exact, Exact) {
    let x = big(x);
    let (sin, cos) = CONSTANTS.with_borrow_mut(|c| (x.sin(BITS, NEAREST, c), x.cos(BITS, NEAREST, c)));
    (read(&sin), read(&cos))
}

fn second_acos(x: DoubleDouble) -> Exact {
    read(&CONSTANTS.with_borrow_mut(|c| big(x).acos(BITS, NEAREST, c)))
}

/// The angle of a point to the right of the axis.
fn second_angle(y: DoubleDouble, x: DoubleDouble) -> Exact {
    let ratio = big(y).div(&big(x), BITS, NEAREST);
    read(&CONSTANTS.with_borrow_mut(|c| ratio.atan(BITS, NEAREST, c)))
}

/// Angles whose sine or cosine is hard: the worst cases of f64 (Muller et al., "Elementary Functions", 3rd edition,
/// table 11.1 and Ng's 5.319e255), multiples of pi/2 from either side, and the ends of the range.
fn hard_angles() -> Vec<f64> {
    let mut angles = vec![
        6_381_956_970_095_103.0 * 2.0_f64.powi(797),
        5.319_372_648_326_541e255,
        1e22,
        6_134_899_525_417_045.0,
        f64::MAX,
        1e300,
        2.0_f64.powi(120),
        1_647_099.0,
        1_647_100.0,
        f64::MIN_POSITIVE,
        5e-324,
        1e-300,
        1e-160,
        1e-20,
        2.0_f64.powi(-26),
        2.0_f64.powi(-27),
        std::f64::consts::FRAC_PI_4,
    ];
    for quarters in [
        1, 2, 3, 4, 5, 7, 22, 355, 1_000_000, 1_048_575, 1_048_576, 1_048_577, 16_331_239,
    ] {
        let nearest = (Exact::pi() * Exact::from_ratio(quarters, 2)).to_f64();
        angles.extend([nearest, nearest.next_up(), nearest.next_down()]);
    }
    angles.iter().flat_map(|angle| [*angle, -angle]).collect()
}

/// The same with digits beyond f64: random second parts, and the multiples of pi/2 to all digits.
fn hard_double_angles() -> Vec<DoubleDouble> {
    let mut sequence = Sequence::new(21);
    let mut angles: Vec<DoubleDouble> = hard_angles()
        .into_iter()
        .flat_map(|angle| {
            [0.0, angle * 1e-17 * sequence.between(-1.0, 1.0), angle * 1e-30]
                .map(|low| DoubleDouble::from_sum(angle, low))
        })
        .collect();
    for quarters in [1, 2, 3, 22, 355, 1_048_576, 16_331_239] {
        let multiple = Exact::pi() * Exact::from_ratio(quarters, 2);
        angles.push(DoubleDouble::from_wide(&multiple));
        angles.push(DoubleDouble::from_wide(&multiple).above());
    }
    angles.push(DoubleDouble::from_sum(2.0_f64.powi(1000), 1e-10));
    angles
}

fn exact(value: DoubleDouble) -> Exact {
    value.to_wide()
}

/// Whether two references agree to 60 digits.
fn agree(first: &Exact, second: &Exact) -> bool {
    first == second || ((first.clone() - second.clone()) / first.clone()).to_f64().abs() < 1e-60
}

/// The distance of a result from the exact value, relative to it, in units of 2^-106; 0 where both are 0 or apart by
/// what underflow allows.
fn error(found: DoubleDouble, expected: &Exact) -> f64 {
    let apart = (exact(found) - expected.clone()).to_f64().abs();
    if apart <= 2.0_f64.powi(-1067) {
        return 0.0;
    }
    apart / expected.to_f64().abs() * 2.0_f64.powi(106)
}

/// Whether the bounds of a result enclose the exact value.
fn encloses<E: Endpoint>(found: &E, expected: &Exact, wide: impl Fn(&E) -> Exact) -> bool {
    let (below, above) = (found.below(), found.above());
    let from = !below.is_finite() || wide(&below) <= *expected;
    let to = !above.is_finite() || *expected <= wide(&above);
    from && to
}

fn of_f64(value: &f64) -> Exact {
    Exact::from_f64(*value)
}

fn of_double(value: &DoubleDouble) -> Exact {
    exact(*value)
}

/// Any finite f64, all exponents alike.
fn any(sequence: &mut Sequence) -> f64 {
    loop {
        let value = f64::from_bits(sequence.draw());
        if value.is_finite() {
            return value;
        }
    }
}

fn double(sequence: &mut Sequence, size: f64) -> DoubleDouble {
    let high = sequence.between(-size, size);
    DoubleDouble::from_sum(high, high * sequence.between(-1e-16, 1e-16))
}

#[test]
fn the_kernels_of_f64_are_rounded_to_nearest_on_the_hardest_angles() {
    let mut sequence = Sequence::new(22);
    let random = (0..400).map(|index| {
        if index % 2 == 0 {
            any(&mut sequence)
        } else {
            sequence.between(-30.0, 30.0)
        }
    });
    for angle in hard_angles().into_iter().chain(random.collect::<Vec<_>>()) {
        let first = Exact::from_f64(angle).sincos();
        let second = second_sincos(Analytic::from_f64(angle));
        assert!(
            agree(&first.0, &second.0) && agree(&first.1, &second.1),
            "the references differ at {angle}"
        );
        let found = angle.bounded_sincos();
        assert_eq!(found, (first.0.to_f64(), first.1.to_f64()), "{angle}");
        assert!(encloses(&found.0, &first.0, of_f64) && encloses(&found.1, &first.1, of_f64));
        // the standard library's is close, though it promises nothing
        let (sin, cos) = angle.sin_cos();
        assert!(
            (sin - found.0).abs() <= 1.2e-16 && (cos - found.1).abs() <= 1.2e-16,
            "{angle}"
        );
    }
}

#[test]
fn the_kernels_of_f64_for_arcs_and_powers_are_within_one_ulp() {
    let mut sequence = Sequence::new(23);
    for index in 0..400 {
        let x = if index % 2 == 0 {
            sequence.between(-1.0, 1.0)
        } else {
            1.0 - sequence.between(0.0, 1.0).powi(12)
        };
        let cosine = Exact::from_f64(x).acos();
        assert!(
            agree(&cosine, &second_acos(Analytic::from_f64(x))),
            "the references differ at {x}"
        );
        assert!(encloses(&x.bounded_acos(), &cosine, of_f64), "{x}");
        let (y, x) = if index % 2 == 0 {
            (any(&mut sequence), any(&mut sequence))
        } else {
            (x, sequence.between(-1.0, 1.0))
        };
        let angle = Exact::from_f64(y).atan2(&Exact::from_f64(x));
        assert!(encloses(&y.bounded_atan2(&x), &angle, of_f64), "{y} {x}");
        let (base, power) = (sequence.between(0.0, 20.0), sequence.between(-300.0, 300.0));
        let exact = Exact::from_f64(base).powf(&Exact::from_f64(power));
        assert!(encloses(&base.bounded_powf(&power), &exact, of_f64), "{base} {power}");
        let whole = power.round();
        let exact = Exact::from_f64(base).powf(&Exact::from_f64(whole));
        assert!(encloses(&base.bounded_powf(&whole), &exact, of_f64), "{base} {whole}");
    }
}

#[test]
fn double_double_arithmetic_keeps_its_proved_bounds() {
    let mut sequence = Sequence::new(24);
    let mut worst = [0.0_f64; 4];
    for index in 0..20_000 {
        // close numbers of opposite sign now and then, and far exponents
        let a = double(&mut sequence, 4.0);
        let b = match index % 3 {
            0 => double(&mut sequence, 4.0),
            1 => -a + double(&mut sequence, 1e-12),
            _ => double(&mut sequence, 1.0) * DoubleDouble::from_f64(2.0_f64.powi((index % 60) - 30)),
        };
        let (x, y) = (exact(a), exact(b));
        let errors = [
            error(a + b, &(x.clone() + y.clone())),
            error(a * b, &(x.clone() * y.clone())),
            error(a / b, &(x.clone() / y)),
            error((a * a).sqrt(), &exact(a * a).sqrt()),
        ];
        for (worst, error) in worst.iter_mut().zip(errors) {
            *worst = worst.max(error);
        }
    }
    println!("worst sum, product, quotient, root: {worst:.2?} u²");
    for (worst, bound) in worst.into_iter().zip([3.1, 7.0, 15.1, 3.2]) {
        assert!(worst < bound, "{worst} of {bound}");
    }
}

#[test]
fn double_double_arithmetic_is_bounded_over_the_whole_range() {
    let mut sequence = Sequence::new(25);
    for _ in 0..20_000 {
        let mut number = || {
            let high = any(&mut sequence);
            DoubleDouble::from_sum(high, high * sequence.between(-1e-16, 1e-16))
        };
        let (a, b) = (number(), number());
        let (x, y) = (exact(a), exact(b));
        assert!(encloses(&(a + b), &(x.clone() + y.clone()), of_double), "{a} + {b}");
        assert!(encloses(&(a * b), &(x.clone() * y.clone()), of_double), "{a} * {b}");
        if b.high() != 0.0 {
            assert!(encloses(&(a / b), &(x.clone() / y), of_double), "{a} / {b}");
        }
        let size = if a.high() < 0.0 { -a } else { a };
        assert!(encloses(&size.sqrt(), &exact(size).sqrt(), of_double), "root of {size}");
    }
}

#[test]
fn double_double_sine_and_cosine_keep_their_bound_on_the_hardest_angles() {
    let mut worst = 0.0_f64;
    for angle in hard_double_angles() {
        let second = second_sincos(angle);
        let found = angle.sincos();
        let errors = (error(found.0, &second.0), error(found.1, &second.1));
        worst = worst.max(errors.0).max(errors.1);
        assert!(errors.0 < 64.0 && errors.1 < 64.0, "{angle}: {errors:?}");
        assert!(encloses(&found.0, &second.0, of_double) && encloses(&found.1, &second.1, of_double));
    }
    println!("worst on the hardest angles: {worst:.2} u²");
}

#[test]
fn double_double_functions_keep_their_bounds_on_random_arguments() {
    let mut sequence = Sequence::new(26);
    let mut worst = [0.0_f64; 5];
    for index in 0..4000 {
        let angle = double(&mut sequence, [0.8, 0.02, 10.0, 1e6][index % 4]);
        let (sin, cos) = exact(angle).sincos();
        let found = angle.sincos();
        let unit = if index % 2 == 0 {
            double(&mut sequence, 1.0)
        } else {
            found.1
        };
        let other = double(&mut sequence, 10.0_f64.powi((index % 21) as i32 - 10));
        let errors = [
            error(found.0, &sin),
            error(found.1, &cos),
            error(unit.acos(), &exact(unit).acos()),
            error(
                Analytic::atan2(&unit, &other),
                &Analytic::atan2(&exact(unit), &exact(other)),
            ),
            error(DoubleDouble::asin(&unit), &num_dual::DualNum::asin(&exact(unit))),
        ];
        for (worst, error) in worst.iter_mut().zip(errors) {
            *worst = worst.max(error);
        }
        if index % 20 == 0 {
            let second = second_sincos(angle);
            assert!(
                agree(&sin, &second.0) && agree(&cos, &second.1),
                "the references differ at {angle}"
            );
            assert!(
                agree(&exact(unit).acos(), &second_acos(unit)),
                "the references differ at {unit}"
            );
            if other.high() > 0.0 {
                let angle = Analytic::atan2(&exact(unit), &exact(other));
                assert!(
                    agree(&angle, &second_angle(unit, other)),
                    "the references differ at {unit} {other}"
                );
            }
        }
    }
    println!("worst sin, cos, acos, atan2, asin: {worst:.2?} u²");
    for (worst, bound) in worst.into_iter().zip([64.0, 64.0, 128.0, 128.0, 128.0]) {
        assert!(worst < bound, "{worst} of {bound}");
    }
}

#[test]
fn double_double_powers_and_angles_are_bounded_over_the_whole_range() {
    let mut sequence = Sequence::new(27);
    for index in 0..1000 {
        let mut number = || {
            let high = any(&mut sequence);
            DoubleDouble::from_sum(high, high * sequence.between(-1e-16, 1e-16))
        };
        let (a, b) = (number(), number());
        if a.high() != 0.0 && b.high() != 0.0 {
            let angle = Analytic::atan2(&exact(a), &exact(b));
            assert!(encloses(&Analytic::atan2(&a, &b), &angle, of_double), "{a} {b}");
        }
        let base = double(&mut sequence, 4.0);
        let base = if base.high() < 0.0 { -base } else { base };
        let base = if index % 5 == 0 {
            DoubleDouble::from_sum(1.0, base.high() * 1e-30)
        } else {
            base
        };
        let power = double(&mut sequence, if index % 5 == 0 { 1e31 } else { 400.0 });
        // dashu's power has no value for some huge exponents; its logarithm and exponential do
        let expected = num_dual::DualNum::exp(&(exact(power) * num_dual::DualNum::ln(&exact(base))));
        assert!(encloses(&base.powf(&power), &expected, of_double), "{base} to {power}");
    }
}

#[test]
fn double_double_is_as_f64_at_infinities_zeros_and_what_is_no_number() {
    let values = [
        0.0,
        -0.0,
        1.0,
        -1.0,
        f64::INFINITY,
        f64::NEG_INFINITY,
        f64::NAN,
        f64::MAX,
        5e-324,
        f64::MIN,
    ];
    let same = |ours: DoubleDouble, theirs: f64| {
        assert!(ours.low() == 0.0 || theirs.is_finite(), "the second part stays clean");
        ours.high().total_cmp(&theirs).is_eq() || (ours.high().is_nan() && theirs.is_nan()) || ours.high() == theirs
    };
    let number = DoubleDouble::from_f64;
    for a in values {
        // both parts together are nearest, the first alone need not be where they tie
        let (ours, theirs) = (Analytic::sqrt(&number(a)).high(), a.sqrt());
        assert!(
            same(number(a).sqrt(), a.sqrt()) || ours == theirs.next_up(),
            "root of {a}"
        );
        assert!(same(-number(a), -a), "-{a}");
        assert!(same(number(a).acos(), a.acos()), "acos {a}");
        assert!(number(a).sincos().0.high().is_nan() != a.is_finite(), "sin {a}");
        for b in values {
            assert!(same(number(a) + number(b), a + b), "{a} + {b}");
            assert!(same(number(a) - number(b), a - b), "{a} - {b}");
            assert!(same(number(a) * number(b), a * b), "{a} * {b}");
            assert!(same(number(a) / number(b), a / b), "{a} / {b}");
            assert!(
                same(Analytic::atan2(&number(a), &number(b)), a.atan2(b)),
                "{a} atan2 {b}"
            );
            assert_eq!(number(a).partial_cmp(&number(b)), a.partial_cmp(&b));
            if a >= 0.0 {
                assert!(same(Analytic::powf(&number(a), &number(b)), a.powf(b)), "{a} to {b}");
            }
        }
    }
}

#[test]
fn pi_is_the_same_everywhere() {
    let second = CONSTANTS.with_borrow_mut(|constants| constants.pi(BITS, NEAREST));
    assert!(agree(&Exact::pi(), &read(&second)));
    assert!(error(DoubleDouble::pi(), &Exact::pi()) < 1.0);
    assert!(encloses(&f64::pi(), &Exact::pi(), of_f64));
}

#[test]
fn many_digits_enclose_more_digits() {
    let mut sequence = Sequence::new(28);
    let more = |value: &Wide<20>| value.convert::<80>();
    for _ in 0..500 {
        let third = Wide::<20>::from_ratio(1, 3);
        let [a, b] = [(); 2].map(|()| Wide::<20>::from_f64(sequence.between(-9.0, 9.0)) * third.clone());
        let (x, y) = (more(&a), more(&b));
        let (u, v) = (|| a.clone(), || b.clone());
        assert!(encloses(&(u() + v()), &(x.clone() + y.clone()), more));
        assert!(encloses(&(u() - v()), &(x.clone() - y.clone()), more));
        assert!(encloses(&(u() * v()), &(x.clone() * y.clone()), more));
        assert!(encloses(&(u() / v()), &(x.clone() / y.clone()), more));
        assert!(encloses(&a.sincos().0, &x.sincos().0, more) && encloses(&a.sincos().1, &x.sincos().1, more));
        assert!(encloses(&Analytic::atan2(&a, &b), &Analytic::atan2(&x, &y), more));
        let cosine = a.sincos().1;
        assert!(encloses(&cosine.acos(), &more(&cosine).acos(), more));
        let square = u() * u();
        assert!(encloses(&square.sqrt(), &more(&square).sqrt(), more));
        assert!(encloses(&square.powf(&b), &more(&square).powf(&y), more));
    }
}
