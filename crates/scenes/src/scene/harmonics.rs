//! The forcing of a scene where it is not the paper's, as typed or over one number.

use super::Quantity;
use dynamics::model::{Forcing, Motion, MotionError};
use numbers::Analytic;
use std::cmp::Ordering;

/// The amplitudes of a forcing of period 2, as typed or over one number.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Harmonics<Q> {
    pub cosines: Vec<Q>,
    pub sines: Vec<Q>,
}

impl Harmonics<Quantity> {
    pub fn over_number<T: Analytic>(&self) -> Harmonics<T> {
        let values = |typed: &[Quantity]| typed.iter().map(Quantity::value).collect();
        Harmonics {
            cosines: values(&self.cosines),
            sines: values(&self.sines),
        }
    }

    /// The harmonics that are not 0.
    pub fn count(&self) -> usize {
        let is_there = |typed: Option<&Quantity>| typed.is_some_and(|typed| typed.sign() != Ordering::Equal);
        let orders = 0..self.cosines.len().max(self.sines.len());
        orders
            .filter(|index| is_there(self.cosines.get(*index)) || is_there(self.sines.get(*index)))
            .count()
    }

    /// Returns true if f half a period later is -f.
    pub fn is_odd(&self) -> bool {
        let mut amplitudes = self.cosines.iter().enumerate().chain(self.sines.iter().enumerate());
        amplitudes.all(|(index, typed)| index % 2 == 0 || typed.sign() == Ordering::Equal)
    }
}

/// The motion under a forcing, or under that of the paper.
pub(super) fn driven<T: Analytic>(
    motion: Motion<T>,
    harmonics: Option<Harmonics<T>>,
) -> Result<Motion<T>, MotionError> {
    let Some(Harmonics { cosines, sines }) = harmonics else {
        return Ok(motion);
    };
    motion.with_forcing(Forcing::periodic(T::from_integer(2), &cosines, &sines)?)
}
