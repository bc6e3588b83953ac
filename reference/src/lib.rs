//! Closed forms and exact linear responses: the oracles that tests and `lab check` compare with.
//!
//! Everything here is derived on paper for one mechanism or one loop, and shares no algorithm with the simulator:
//!
//! - [`planar_2r`]: the planar arm with two revolute joints; kinematics, both inverse branches, dynamics, energy.
//! - [`rppr`]: the robot with a revolute, two prismatic and a revolute joint; kinematics, both inverse branches, rates.
//! - [`linear_response`]: rational transfer functions and their step responses as sums of exponentials.
//!   - `pid_loop`: the loops of one joint under PID, as transfer functions.
//!   - `transfer_function`: ratio of polynomials; poles, zeros, gain, step response.
//!   - `step_metrics`: rise, settling, overshoot and peak of a response, found without sampling.
//!   - `exponential_sum`, `polynomial`, `two_double`: the mathematics below them.
//!
//! Units are SI and angles radians. The planar arm is described in the *lab frame*: x up along the base, y sideways,
//! z along the joint axes. Nothing here is used to give a grade.

pub mod linear_response;
pub mod planar_2r;
pub mod rppr;
