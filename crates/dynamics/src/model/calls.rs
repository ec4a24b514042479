//! What tests alone count: how often a thing was modelled, to hold that what is not wanted never is.
//!
//! No part of the library as it is built for use: the counters are there in tests and with the feature `calls`.

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
    /// The Jacobian of one impact and the flight after it, of which DP is a product.
    Jacobian,
    /// A Lyapunov exponent of a cycle.
    Exponent,
    /// A box that Krawczyk's operator is applied to.
    Certificate,
    /// An instant of a trajectory, between the impacts.
    Snapshot,
    /// A figure that is drawn.
    Figure,
}

impl Call {
    /// All of them.
    pub const ALL: [Self; 9] = [
        Self::Membrane,
        Self::Deflection,
        Self::Step,
        Self::Growth,
        Self::Jacobian,
        Self::Exponent,
        Self::Certificate,
        Self::Snapshot,
        Self::Figure,
    ];
}

thread_local! {
    static COUNTS: Cell<[u64; Call::ALL.len()]> = const { Cell::new([0; Call::ALL.len()]) };
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
