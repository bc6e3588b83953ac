//! The interface to a student's code ([`controller`]), the hosts that open it ([`host`], [`not_text`]), the parsing of answers ([`answer`]), and the
//! script language ([`rhai`]).

pub mod answer;
pub mod controller;
pub mod handed_in;
pub mod host;
pub mod not_text;
mod output;
pub mod plugin;
pub mod rhai;
mod robot_model;
