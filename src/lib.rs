#![doc = include_str!("../README.md")]

pub mod accuracy;
pub mod algebra;
pub mod claim;
pub mod cli;
pub mod evidence;
pub mod model;
pub mod number;
pub mod report;
pub mod tex;
