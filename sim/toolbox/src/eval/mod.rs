//! Requests to a robot and their answers: one JSON object in, one out ([`answer_line`]), or typed, by the function of an operation
//! ([`kinematics::fk`] of a [`kinematics::Fk`]). docs/robot-eval.md is the reference.
//!
//! | file | what it holds |
//! |---|---|
//! | `operation` | the list of operations, and how a line becomes an answer |
//! | `robot_info`, `kinematics`, `inverse_kinematics`, `dynamics`, `trajectory`, `simulation` | requests and answers, by group |
//! | `simulation_record` | the answer to `simulate` |
//! | `joint_state`, `number_fields` | what fields of many requests have in common |
//! | `field_reader` | JSON to typed requests, with errors that name the field |
//! | `refusal` | why a request is not answered |

pub mod dynamics;
mod field_reader;
pub mod inverse_kinematics;
mod joint_state;
pub mod kinematics;
mod number_fields;
mod operation;
mod refusal;
pub mod robot_info;
pub mod simulation;
mod simulation_record;
pub mod trajectory;

pub use number_fields::{Numbers, TwistRows};
pub use operation::{OPERATIONS, Operation, Subject, answer_line, operation_names, refused};
pub use refusal::{Code, Refusal};
pub use simulation_record::{ContactRecord, EventRecord, SampledRun, SceneRecord};
