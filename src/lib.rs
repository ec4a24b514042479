#![doc = include_str!("../README.md")]

pub mod accuracy;
pub mod algebra;
pub mod claim;
pub mod cli;
pub mod evidence;
pub mod impact;
pub mod model;
pub mod number;
pub mod orbit;
pub mod reference;
pub mod report;
pub mod scene;
pub mod tex;
