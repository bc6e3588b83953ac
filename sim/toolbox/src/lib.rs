//! Questions to a robot and their answers: what the commands `kinemark robot` and `kinemark scene` print, as values.
//!
//! This crate opens no file and has no terminal: it is handed texts, and what reads meshes by their names. It builds for
//! WebAssembly.
//!
//! | module | what it holds |
//! |---|---|
//! | [`robot_show`] | a robot as text for people and as JSON |
//! | [`robot_convert`] | any robot as a robot file |
//! | [`eval`] | requests and answers: kinematics, dynamics, trajectories, simulation |
//! | [`response`] | the step response of a joint: run, linear theory, measures, limits of stability |
//! | [`scene_check`] | what is wrong with a scene, as text and as JSON |
//! | [`styled_text`] | text with emphasis, which a terminal or a page shows in its own way |

pub mod eval;
mod joint_names;
pub mod response;
pub mod robot_convert;
pub mod robot_show;
pub mod scene_check;
pub mod styled_text;
