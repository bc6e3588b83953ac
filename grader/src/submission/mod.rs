//! The interface to a student's code ([`controller`]), the hosts that open it ([`host`]), the parsing of answers ([`answer`]), and the
//! script language ([`rhai`]).

pub mod answer;
pub mod controller;
pub mod host;
pub mod rhai;
