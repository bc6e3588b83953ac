//! The seam to a student's code ([`controller`]), who opens it ([`host`]), what answers must look like ([`answer`]), and the
//! script language ([`rhai`]).

pub mod answer;
pub mod controller;
pub mod host;
pub mod rhai;
