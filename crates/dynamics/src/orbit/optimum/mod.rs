//! The best device of a choice: the largest voltage of a stable and admissible 1-1 motion, proved to be the largest.

pub mod cell;
pub mod design;
pub mod explicit;
pub mod incumbent;
pub mod local_word;
pub mod record;
pub mod search;
pub mod sensitivity;
pub mod supremum;

/// The paper's membrane and scales, and ranges of d, g, r_B and r_T that are exact in f64.
#[cfg(test)]
pub(crate) fn paper_choice(ranges: [[f64; 2]; 4]) -> design::Choice {
    use crate::model::Membrane;
    use numbers::{Field, Interval};
    let ratio = |above, below| Interval::from_ratio(above, below);
    let membrane = Membrane::new(
        ratio(35, 10_000),
        ratio(408_470, 1),
        ratio(26, 10),
        ratio(5, 1000),
        ratio(63, 10_000),
        ratio(2000, 1),
    );
    design::Choice {
        devices: design::Devices {
            gap: design::Gap::Itself,
            pull: design::Pull::Itself,
            // A pi / (M omega) with A = 5, M = 0.1245, omega = 5 pi
            unit: design::Unit::Same(ratio(10_000, 1245)),
            membrane: membrane.expect("a membrane"),
        },
        ranges: ranges.map(|[low, high]| {
            let [low, high] = [low, high].map(Interval::point);
            design::Range { low, high }
        }),
        max_periods: 1,
        margin: Interval::point(0.0),
        clearance: Interval::point(0.0),
    }
}
