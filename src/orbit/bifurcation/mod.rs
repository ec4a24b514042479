//! Bifurcations: detected along a branch or isolated in a cover, located and proved.

pub(crate) mod detect;
pub(crate) mod instant;
pub(crate) mod moment;
pub(crate) mod one_one;
