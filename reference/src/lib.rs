//! Closed forms, derived on paper and apart from the simulator: the oracles of its tests.
//!
//! Each is for one mechanism or one loop, takes any dimensions, masses or gains, and shares no algorithm with `sim`:
//!
//! | module | closed form of |
//! |---|---|
//! | [`planar_2r`] | the planar arm with two revolute joints: kinematics, both inverse branches, dynamics, energy |
//! | [`joint_loop`] | one joint under a continuous PID controller: poles, gain and step response of its transfer functions |
//! | [`sampled_joint`] | one joint under a sampled PID controller whose effort is held: its state at every sample |
//!
//! Units are SI and angles radians. The planar arm is described in the *lab frame*: x up along the base, y sideways,
//! z along the joint axes. Nothing here is used to give a grade.

pub mod joint_loop;
pub mod planar_2r;
pub mod sampled_joint;
