//! Labs: the TOML types ([`mod@file`]), what they become ([`Lab`]), the way from one to the other ([`load`]), and the cases that
//! hidden draws add ([`draw`]). What somebody begins a lab with is [`new_lab`]. A student's numbers ([`variant`]), drawn by the lab's rules
//! ([`variant_rule`]), make a lab like any other: nothing downstream knows. Variants at the ends of these rules are [`corner`]s.

pub mod brief;
mod case_robot;
pub mod copies;
pub mod corner;
pub mod draw;
pub mod file;
mod hints;
pub mod load;
mod model;
pub mod new_lab;
mod parameters;
pub mod practice;
pub mod schema;
pub mod staff;
pub mod variant;
pub mod variant_rule;

pub use model::{Lab, Task, TaskWork};
pub use practice::Practice;
pub use staff::Staff;
pub use variant::Variant;
