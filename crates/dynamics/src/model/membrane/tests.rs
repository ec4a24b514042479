//! Voltages against sixty digits, a second way, and the paper.

use super::super::Device;
use super::*;
use numbers::{Dual, Field, Wide, seeded};
use proptest::prelude::*;

type Number = Wide<60>;

/// The membrane of Table 1, its decimals as exact ratios.
fn table_1<T: Analytic>() -> Membrane<T> {
    let ratio = |n, d| T::from_ratio(n, d);
    let membrane = Membrane::new(
        ratio(35, 10_000),
        T::from_integer(408_470),
        ratio(26, 10),
        ratio(5, 1000),
        ratio(63, 10_000),
        T::from_integer(2000),
    );
    membrane.unwrap_or_else(|error| panic!("{error}"))
}

/// The velocity unit of the device that FACTS infers.
fn unit() -> f64 {
    let device = Device {
        capsule_mass: 0.1245,
        forcing_amplitude: 5.0,
        angular_frequency: 5.0 * std::f64::consts::PI,
        incline: 0.0,
        gravity: 9.8,
    };
    device.scales().map_or(f64::NAN, |scales| scales.velocity)
}

fn relative(value: f64, exact: &Number) -> f64 {
    ((Number::from_f64(value) - exact.clone()) / exact.clone())
        .to_f64()
        .abs()
}

/// A second way: bisection of the relation of the shape for a, the area as printed, the difference in 60 digits.
fn by_bisection(membrane: &Membrane<Number>, speed: &Number) -> Number {
    let deflection = membrane.deflection(speed);
    let (ball, rim) = (membrane.ball_radius.clone(), membrane.membrane_radius.clone());
    let off = |angle: &Number| {
        let (sin, cos) = angle.sincos();
        (ball.clone() - deflection.clone()) * cos + rim.clone() * sin - ball.clone()
    };
    let half = Number::from_ratio(1, 2);
    let (mut low, mut high) = (Number::from_integer(0), Number::pi() * half.clone());
    for _ in 0..220 {
        let middle = (low.clone() + high.clone()) * half.clone();
        if off(&middle).to_f64() < 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    let (sin, cos) = low.sincos();
    let square = |x: Number| x.clone() * x;
    let cap = Number::from_integer(2) * square(ball.clone()) * (Number::from_integer(1) - cos.clone());
    let cone = (square(rim.clone()) - square(ball * sin)) / cos;
    let ratio = (cap + cone) / square(rim);
    Number::from_integer(2000) * (square(ratio) - Number::from_integer(1))
}

#[test]
fn the_voltage_keeps_its_digits_from_the_slightest_to_the_hardest_impact() {
    let (membrane, exact) = (table_1::<f64>(), table_1::<Number>());
    for exponent in -120..=30 {
        let speed = 10.0_f64.powf(f64::from(exponent) / 10.0);
        let wide = Number::from_f64(speed);
        let error = relative(membrane.voltage(&speed), &exact.voltage(&wide));
        assert!(error < 1e-14, "{speed}: {error}");
        assert!(relative(membrane.area(&speed), &exact.area(&wide)) < 1e-14, "{speed}");
        assert!(
            relative(membrane.deflection(&speed), &exact.deflection(&wide)) < 5e-15,
            "{speed}"
        );
    }
}

#[test]
fn the_closed_form_is_the_root_of_the_relation_of_the_shape() {
    let membrane = table_1::<Number>();
    for speed in [1e-9, 1e-3, 0.1, 1.0, 8.0, 50.0, 1e3] {
        let speed = Number::from_f64(speed);
        let (found, again) = (membrane.voltage(&speed), by_bisection(&membrane, &speed));
        // the subtraction of the second way loses what the slightest impact has of its 60 digits
        let apart = ((found.clone() - again) / found).to_f64().abs();
        assert!(apart < 1e-40, "{speed}: {apart}");
    }
}

#[test]
fn the_shape_touches_the_ball_and_ends_at_the_rim() {
    let membrane = table_1::<Number>();
    let (ball, rim) = (membrane.ball_radius.clone(), membrane.membrane_radius.clone());
    for deflection in [1e-20, 1e-6, 1e-3, 4.999e-3, 5e-3, 5.001e-3, 1.0, 1e6] {
        let deflection = Number::from_f64(deflection);
        let Shape { cos, fall } = membrane.shape(&deflection);
        assert!((cos.clone() + fall.clone() - Number::from_integer(1)).to_f64().abs() < 1e-60);
        // sin a = sqrt((1 - cos a)(1 + cos a)), divided by delta so that the slightest says something too
        let sin = (fall * (Number::from_integer(1) + cos.clone())).sqrt();
        let off = (ball.clone() - deflection.clone()) * cos + rim.clone() * sin - ball.clone();
        assert!((off / deflection.clone()).to_f64().abs() < 1e-40, "{deflection}");
    }
}

#[test]
fn the_printed_voltages_come_out() {
    // impact velocities of the certified 1-1 orbits, without unit; printed: 37876.8, 61152.5, 61054.4 V
    let (membrane, unit) = (table_1::<f64>(), unit());
    for (velocities, printed) in [
        ([0.677_448_503_7, -0.514_768_503_7], 37_876.8),
        ([0.886_872_082_6, -0.903_827_178_6], 61_152.5),
        ([0.947_189_536_0, -0.840_652_476_6], 61_054.4),
    ] {
        let mean = velocities.map(|velocity| membrane.voltage(&(velocity * unit)));
        let mean = mean.iter().sum::<f64>() / 2.0;
        assert!((mean - printed).abs() < 0.06, "{mean} V");
    }
}

#[test]
fn the_printed_subtraction_agrees_until_it_loses_its_digits() {
    let membrane = table_1::<f64>();
    for (speed, lost) in [(8.0, 0.0..1e-14), (1e-7, 1e-10..1e-6), (1e-15, 0.5..100.0)] {
        let ratio = membrane.voltage_as_printed(&speed) / membrane.voltage(&speed);
        assert!(lost.contains(&(ratio - 1.0).abs()), "{speed}: {ratio}");
    }
    let (exact, speed) = (table_1::<Number>(), Number::from_f64(1e-6));
    let apart = exact.voltage_as_printed(&speed) - exact.voltage(&speed);
    assert!(apart.to_f64().abs() < 1e-50);
}

#[test]
fn without_speed_there_is_no_voltage() {
    let membrane = table_1::<f64>();
    assert_eq!((membrane.deflection(&0.0), membrane.voltage(&0.0)), (0.0, 0.0));
    assert_eq!(membrane.voltage(&-0.0), 0.0);
    assert!(membrane.voltage(&f64::NAN).is_nan());
    let still = table_1::<Dual<f64>>().voltage(&seeded(0.0));
    assert_eq!((still.re, still.eps), (0.0, 0.0));
    assert_eq!(table_1::<Number>().voltage(&Number::from_integer(0)).to_f64(), 0.0);
}

#[test]
fn what_is_no_membrane_is_named() {
    let error = |mass, stiffness, exponent, ball, rim, volts| {
        let found = Membrane::new(mass, stiffness, exponent, ball, rim, volts);
        found.err().map(|error| error.to_string()).unwrap_or_default()
    };
    let narrow = error(0.0035, 4e5, 2.6, 0.005, 0.005, 2000.0);
    assert_eq!(narrow, "membrane_radius is 0.005, must be above ball_radius, 0.005");
    let nan = f64::NAN;
    for (name, message) in [
        ("ball_mass", error(0.0, 4e5, 2.6, 0.005, 0.006, 2000.0)),
        ("stiffness", error(0.0035, nan, 2.6, 0.005, 0.006, 2000.0)),
        ("exponent", error(0.0035, 4e5, -1.0, 0.005, 0.006, 2000.0)),
        ("ball_radius", error(0.0035, 4e5, 2.6, -0.005, 0.006, 2000.0)),
        ("membrane_radius", error(0.0035, 4e5, 2.6, 0.005, f64::INFINITY, 2000.0)),
        ("input_voltage", error(0.0035, 4e5, 2.6, 0.005, 0.006, 0.0)),
        ("beyond the range", error(1e-300, 1e300, 2.6, 0.005, 0.006, 1.0)),
    ] {
        assert!(message.contains(name), "{name}: {message}");
    }
}

proptest! {
    #[test]
    fn a_harder_impact_gives_more_voltage(exponent in -12.0_f64..3.0, more in 1e-12_f64..2.0) {
        let speed = 10.0_f64.powf(exponent);
        let membrane = table_1::<f64>();
        let (less, harder) = (membrane.voltage(&speed), membrane.voltage(&(speed * (1.0 + more))));
        prop_assert!(harder > less, "{} {}", less, harder);
        prop_assert_eq!(membrane.voltage(&-speed), less);
    }

    #[test]
    fn its_derivative_is_the_limit_of_differences(exponent in -6.0_f64..2.0) {
        let speed = 10.0_f64.powf(exponent);
        let slope = table_1::<Dual<f64>>().voltage(&seeded(speed)).eps;
        let exact = table_1::<Number>();
        let step = speed * 1e-15;
        let at = |speed: f64, step: f64| exact.voltage(&(Number::from_f64(speed) + Number::from_f64(step)));
        let rise = (at(speed, step) - at(speed, -step)).to_f64() / (2.0 * step);
        prop_assert!((slope / rise - 1.0).abs() < 1e-12, "{} {}", slope, rise);
    }

    #[test]
    fn any_membrane_keeps_its_digits(
        exponent in 0.5_f64..5.0,
        ball in 1e-4_f64..1e-1,
        wider in 1e-6_f64..10.0,
        speed in -9.0_f64..3.0,
    ) {
        let (rim, speed) = (ball * (1.0 + wider), 10.0_f64.powf(speed));
        let float = Membrane::new(0.0035, 4e5, exponent, ball, rim, 2000.0);
        let wide = [0.0035, 4e5, exponent, ball, rim, 2000.0].map(Number::from_f64);
        let [mass, stiffness, exponent, ball, rim, volts] = wide;
        let exact = Membrane::new(mass, stiffness, exponent, ball, rim, volts);
        let (Ok(float), Ok(exact)) = (float, exact) else {
            return Err(TestCaseError::fail("a membrane"));
        };
        let error = relative(float.voltage(&speed), &exact.voltage(&Number::from_f64(speed)));
        prop_assert!(error < 2e-14, "{}", error);
    }
}
