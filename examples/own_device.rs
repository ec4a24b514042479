//! A device of one's own, through the trait `Parameters`: a capsule on a slope whose restitutions come from heights of
//! rebound, of which all periodic motions are proved.
//!
//! `cargo run --example own_device`

use vibro_audit::model::{Exact, Motion, MotionError, Parameters};
use vibro_audit::number::{Analytic, Rational};
use vibro_audit::orbit::{Word, find};

/// A device as its maker measures it. Rational numbers, so that every number type has them to its last digit.
struct Measured {
    /// Gravity along the slope as a part of the largest acceleration of the capsule.
    gravity: Rational,
    /// The length of the capsule, without unit.
    length: Rational,
    /// How high a ball rebounds that falls from height 1, at the bottom and at the top: the squares of r_B and r_T.
    rebounds: [Rational; 2],
}

impl Parameters for Measured {
    fn motion<T: Analytic>(&self) -> Result<Motion<T>, MotionError> {
        let [bottom, top] = self.rebounds.each_ref().map(|height| height.value::<T>().sqrt());
        Motion::new(self.gravity.value(), self.length.value(), bottom, top)
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let part = |numerator, denominator| Rational::new(numerator, denominator).ok_or("a denominator of 0");
    let device = Measured {
        gravity: part(61, 500)?,
        length: part(2, 5)?,
        rebounds: [part(1, 4)?, part(3, 10)?],
    };
    let found = find(&device, &Word::pair(), 1)?;
    println!("{} motions, {} places left open", found.orbits.len(), found.open.len());
    for orbit in &found.orbits {
        println!("{} {:?} within {:?}", orbit.kind, orbit.velocities, orbit.error_bound);
    }
    Ok(())
}
