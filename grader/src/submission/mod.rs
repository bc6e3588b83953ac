//! The seam to a student's code ([`controller`]), what answers must look like ([`answer`]), and the script host ([`rhai`]).

pub mod answer;
pub mod controller;
pub mod rhai;
