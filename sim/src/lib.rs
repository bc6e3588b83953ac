//! Robots, kinematics, dynamics, control and the deterministic run.
//!
//! This crate knows no lab, grade, file or terminal: it gets text and numbers and returns values.
//!
//! | module | what it holds |
//! |---|---|
//! | [`text`] | text from outside, expressions in it, and errors that point into it |
//! | [`spatial`] | poses, twists, symmetric tensors |
//! | [`random`] | numbers drawn from a seed |
//! | [`ticks`] | time as integer counts of physics steps |
//! | [`joint_space`] | vectors over the joints that move |
//! | [`trajectory`] | time in; position, velocity, acceleration out |
//! | [`model`] | the values: robot, scene, sensor, mesh, air, contact |
//! | [`kinematics`] | where frames are and how they move |
//! | [`part`] | what descriptions have in common: numbers over dimensions, origins, shapes, masses, mesh files |
//! | [`sensor`] | one file a kind of sensor: its table, reading, writing, and what it measures |
//! | [`mod@format`] | from text to the model: one folder a format of robots; scenes, strings of joints |
//! | [`dynamics`] | RNEA, CRBA, ABA, energy, drag and friction |
//! | [`control`] | joint servos: command in, effort out; when they are stable |
//! | [`engine`] | contact; the only module that knows how it is computed |
//! | [`step`] | one step: smooth while the robot is free, contact while it touches |
//! | [`sensing`] | what the sensors read, with noise, quantisation, delay and rate |
//! | [`run`] | the tick loop: observe, control, servo, step |
//! | [`watch`] | what happened: limits, singular configurations, contacts, falls |
//! | [`trace`] | the columns of one run and their digests |
//! | [`diagnosis`] | why a run diverged |
//! | [`scene_check`] | what is wrong with a scene before anything runs in it |
//!
//! A module uses those above it in this table, and none below it; docs/architecture.md has the same order, and a test reads it.
//!
//! Conventions: SI units and radians; the world is z-up; `a_from_b` maps coordinates in `b` to coordinates in `a`; Jacobian
//! rows are `[linear; angular]`; arrays over joints follow the file order of the joints that move. All transcendental functions
//! come from `libm`, so that every platform computes the same bits.

#![cfg_attr(
    test,
    expect(
        clippy::float_cmp,
        reason = "tests state exact values where exactness is the claim"
    )
)]

pub mod control;
pub mod diagnosis;
pub mod dynamics;
pub mod engine;
pub mod format;
pub mod joint_space;
pub mod kinematics;
pub mod model;
pub mod part;
pub mod random;
pub mod run;
pub mod scene_check;
pub mod sensing;
pub mod sensor;
pub mod spatial;
pub mod step;
pub mod text;
pub mod ticks;
pub mod trace;
pub mod trajectory;
pub mod watch;
