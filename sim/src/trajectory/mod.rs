//! Trajectories: time in; position, velocity and acceleration out, with an exact end time.
//!
//! | module | what it holds |
//! |---|---|
//! | [`axis`] | the trait of all trajectories, samples, limits |
//! | [`cubic`] | positions and velocities at both ends in a given time |
//! | [`quintic`] | positions, velocities and accelerations at both ends in a given time |
//! | [`trapezoid`] | rest to rest under limits of speed and acceleration |
//! | [`jerk_limited`] | rest to rest under limits of speed, acceleration and jerk |
//! | [`spline`] | via points at given times |
//! | [`joints`] | several axes that start and end together |
//! | [`joint_law`] | a law of one joint over a run: polynomial, sine, trapezoid, table |
//! | [`turn`] | rotation about one fixed axis |
//! | [`line`](mod@line), [`arc`] | straight and circular paths in task space |
//! | [`path`] | a path with a time law: pose, twist and its rate |
//! | [`TrajectoryError`] | why a trajectory cannot be planned |
//!
//! A trajectory lives on the closed interval from 0 to its duration. There the ends are exact to the bit in position, and
//! acceleration is the limit from inside. Before and after, it holds the end position with velocity and acceleration zero,
//! even if the velocity requested at that end is not zero. A time that is NaN gives NaN, never a position.

pub mod arc;
pub mod axis;
pub mod cubic;
pub mod jerk_limited;
pub mod joint_law;
pub mod joints;
pub mod line;
pub mod path;
pub mod quintic;
pub mod spline;
mod trajectory_error;
pub mod trapezoid;
pub mod turn;

pub use arc::{Arc, ArcOrientation};
pub use axis::{JerkLimits, Knot, Limits, RestToRest, Sample, Trajectory};
pub use cubic::Cubic;
pub use jerk_limited::JerkLimited;
pub use joint_law::{JointLaw, Sine};
pub use joints::{JointSample, JointTrajectory};
pub use line::Line;
pub use path::{AlongPath, Path, PathPoint, PoseSample, TwistRate};
pub use quintic::Quintic;
pub use spline::{Spline, SplineEnds};
pub use trajectory_error::TrajectoryError;
pub use trapezoid::Trapezoid;
pub use turn::Turn;
