//! The interface to a student's code ([`controller`]), the hosts that open it ([`host`], [`not_text`]), the parsing of answers ([`answer`]), and the
//! languages ([`rhai`], [`python`], [`plugin`] for compiled modules).

pub mod answer;
pub mod controller;
pub mod handed_in;
pub mod host;
pub mod not_text;
mod output;
pub mod plugin;
#[cfg(feature = "python")]
pub mod python;
pub mod rhai;
mod robot_model;
