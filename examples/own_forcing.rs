//! A forcing of one's own: two harmonics, over any number. Impacts by the one-impact map, in f64 and in 50 digits, with
//! the derivative beside each.
//!
//! `cargo run --example own_forcing`

use vibro_audit::model::{Forcing, ForcingError, Impact, Motion, Passage, Side, next_impact};
use vibro_audit::number::{Analytic, Wide};

/// cos(pi t) + sin(2 pi t)/4, of period 2 as the paper's.
fn shaken<T: Analytic>() -> Result<Forcing<T>, ForcingError> {
    let quarter = T::one() / T::from_integer(4);
    Forcing::periodic(T::from_integer(2), &[T::one()], &[T::zero(), quarter])
}

/// The velocities of so many impacts, and the trace of the derivative of each map.
fn follow<T: Analytic>(impacts: usize) -> Result<Vec<(f64, f64)>, Box<dyn std::error::Error>> {
    let part = |numerator: i64, denominator: i64| T::from_integer(numerator) / T::from_integer(denominator);
    let motion = Motion::new(part(61, 500), part(2, 5), part(1, 2), part(1, 2))?;
    let forcing = shaken::<T>()?;
    let mut impact = Impact {
        side: Side::Bottom,
        time: part(1, 5),
        velocity: part(4, 5),
    };
    let mut found = Vec::new();
    for _ in 0..impacts {
        let leg = next_impact(&motion, &forcing, &impact)?;
        let derivative = Passage::new(&motion, &forcing, &impact, &leg.duration).by_formula()?;
        found.push((leg.to.velocity.to_f64(), derivative.trace().to_f64()));
        impact = leg.to;
    }
    Ok(found)
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let pairs = follow::<f64>(10)?.into_iter().zip(follow::<Wide<50>>(10)?);
    for ((velocity, trace), (exact, _)) in pairs {
        println!(
            "velocity {velocity:+.15}, off by {:.0e}; trace {trace:+.6}",
            (velocity - exact).abs()
        );
    }
    Ok(())
}
