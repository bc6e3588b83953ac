//! Robots, kinematics, dynamics, control and the deterministic run.
//!
//! This crate knows no lab, mark, file or terminal: it is handed text and numbers and returns values.
//!
//! | module | what it holds |
//! |---|---|
//! | [`source`] | text from outside, and errors that point into it |
//! | [`robot`] | the immutable robot and its TOML description |
//! | [`air`] | how air drags on bodies and links |
//! | [`scene`] | what is around the robot, and its TOML description |
//! | [`scene_check`] | what is wrong with a scene before anything runs in it |
//! | [`engine`] | contact, and the only place that knows how it is computed |
//! | [`hybrid`] | the step in a scene: smooth while the robot is free, contact while it touches |
//! | [`joint`] | vectors over the joints that move |
//! | [`spatial`] | poses, twists, symmetric tensors |
//! | [`kinematics`] | where frames are and how they move |
//! | [`dynamics`] | RNEA, CRBA, ABA, energy, the smooth step |
//! | [`control`] | joint servos: command in, effort out |
//! | [`trajectory`] | time in; position, velocity, acceleration out |
//! | [`sensor`] | what the robot measures, with noise, quantisation, delay and rate |
//! | [`ticks`] | time as whole numbers of physics steps |
//! | [`random`] | numbers drawn from a seed |
//! | [`run`] | the tick loop: observe, control, servo, step |
//! | [`runaway`] | when motion is beyond all reason |
//! | [`event`] | what can happen in a run |
//! | [`event_words`] | the same in words |
//! | [`watch`] | what did happen: limits, singular positions, contacts, falls |
//! | [`trace`] | the columns of one run and their digests |
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

pub mod air;
pub mod control;
pub mod dynamics;
pub mod engine;
pub mod event;
pub mod event_words;
pub mod hybrid;
pub mod joint;
pub mod kinematics;
pub mod random;
pub mod robot;
pub mod run;
pub mod runaway;
pub mod scene;
pub mod scene_check;
pub mod sensor;
pub mod source;
pub mod spatial;
pub mod ticks;
pub mod trace;
pub mod trajectory;
pub mod watch;
