//! Bifurcations: detected along a branch or isolated in a cover, located and proved.

pub(crate) mod detect;

pub(crate) mod one_one;
pub(crate) mod point;
pub(crate) mod words;
