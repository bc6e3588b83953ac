//! Write a submission for Kinemark in Rust, compiled to WebAssembly.
//!
//! Implement [`Submission`] for a type of your own, and name the functions that you wrote in [`export!`]:
//!
//! ```
//! use kinemark_plugin::math::{cos, sin};
//! use kinemark_plugin::{Observation, Robot, Submission, export};
//!
//! #[derive(Default)]
//! struct Arm;
//!
//! impl Submission for Arm {
//!     fn forward_kinematics(&mut self, robot: &Robot, q: &[f64]) -> [f64; 3] {
//!         let l: [f64; 2] = robot.dimensions().array("link_lengths");
//!         let x = robot.dimensions().number("base_height") + l[0] * cos(q[0]) + l[1] * cos(q[0] + q[1]);
//!         let y = l[0] * sin(q[0]) + l[1] * sin(q[0] + q[1]);
//!         [x, y, 0.0]
//!     }
//!
//!     fn control(&mut self, observation: &Observation, command: &mut [f64]) {
//!         command.copy_from_slice(observation.q());
//!     }
//! }
//!
//! export!(Arm: forward_kinematics, control);
//! ```
//!
//! All numbers are `f64` in SI units: rad, m, s, N m, N. What a function gets is lent to it for the call: copy what you keep into
//! fields of your type. A panic ends the call, and the feedback has its words and its line.
//!
//! # With and without the standard library
//!
//! The feature `std` is on by default. Without it (`default-features = false`) the crate needs neither the standard library nor an
//! allocator; its feature `panic-handler` then defines the panic handler.
//!
//! With the standard library, `x.sin()` is Rust's own function: the same in every run, but not always to the last bit what scripts
//! get, more bytes of module, and more instructions. [`math::sin`] and its kin are those of scripts. `println!` and `dbg!` print
//! nowhere: use [`log!`].

#![no_std]

#[cfg(any(feature = "std", not(target_arch = "wasm32")))]
extern crate std;

mod answer;
mod buffer;
mod export;
mod host;
pub mod linear;
mod map;
pub mod math;
mod observation;
mod output;
mod panic;
mod robot;
pub mod robot_model;
mod rows;
mod submission;
mod text;

pub use answer::Answer;
pub use map::{Field, Map};
pub use observation::Observation;
pub use output::{log, plot};
pub use robot::Robot;
pub use rows::Rows;
pub use submission::Submission;

/// The README's example compiles.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

/// What [`export!`] writes into a submission; not for use by hand.
#[doc(hidden)]
pub mod private {
    pub use crate::export::{AnswerAt, MapAt, NumbersAt, ObservationAt, RobotAt, State, TextAt};
    pub use crate::output::log_arguments;
}
