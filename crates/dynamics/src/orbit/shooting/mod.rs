//! A second method, which shares no equation with the first: a periodic motion as the fixed point of its return map.

pub(crate) mod confirm;
pub(crate) mod return_map;
