//! The end of a chatter: infinitely many impacts in a finite time.

use super::expansion::Expansion;
use crate::number::Analytic;

/// The angle after which a chatter is complete, for a ball that leaves a wall with velocity `start.w` and is pressed
/// back to it, with restitution `r`; `None` where that is not yet known to the precision of the number, or where the
/// chatter may not complete at all.
///
/// With U = w / (1 - r), push a and its slope j, the angle is 2U/a - (4/3) jU²/a³ + O(U³): the functional equation
/// T(w, a) = flight + T(r w', a') solved order by order. The third order has the coefficients
/// (8/9)(2r²+3r+2)/(1+r+r²) j²/a⁵, at most 2.1, and -(2/3)(1+r)²/(1+r+r²) a''/a⁴, at most 0.9; twice that bounds the
/// error where U a'/a² is small.
pub(super) fn accumulation<T: Analytic>(start: &Expansion<T>, r: &T, epsilon: f64) -> Option<T> {
    let (a, w) = (start.push.to_f64(), start.w.to_f64());
    let room = T::one() - r.clone();
    let reach = w / room.to_f64();
    let slope = start.sin.to_f64();
    // how much the push changes meanwhile, over itself
    let change = (slope * reach / (a * a)).abs().max(reach * reach / (a * a * a));
    // 1 / 0 for r = 1, and NaN: no
    if !(a > 0.0 && change < 0.01) {
        return None;
    }
    let error = 2.0 * (2.1 * slope * slope / (a * a) + 0.9 * start.cos.to_f64().abs() / a) * (reach / a).powi(3);
    if error > 0.25 * epsilon {
        return None;
    }
    let push = &start.push;
    let flight = start.w.clone() / (room * push.clone());
    let bend = start.sin.clone() * flight.clone() / push.clone() * T::from_ratio(4, 3);
    Some(flight.clone() * (T::from_integer(2) + bend))
}
