//! What tests alone count: how often a thing was modelled, to hold that what is not wanted never is.
//!
//! No part of the library as it is built for use: the counters are there under `cfg(test)` only.

use std::cell::Cell;

/// What is counted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Call {
    /// A membrane that is made.
    Membrane,
    /// An impact whose deflection, area or voltage is computed.
    Deflection,
    /// A step of a simulated motion: an impact, a rest or a release.
    Step,
    /// A step through which the growth of errors is followed.
    Growth,
}

thread_local! {
    static COUNTS: Cell<[u64; 4]> = const { Cell::new([0; 4]) };
}

/// One more, on this thread.
pub fn count(call: Call) {
    let mut counts = COUNTS.get();
    counts[call as usize] += 1;
    COUNTS.set(counts);
}

/// How often, on this thread so far.
pub fn counted(call: Call) -> u64 {
    COUNTS.get()[call as usize]
}
