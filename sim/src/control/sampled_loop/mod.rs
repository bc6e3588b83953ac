//! The sampled-data limit of joint servos: how fast the loop of robot and servo grows or decays from sample to sample, and which
//! gains and periods would keep it from growing.
//!
//! At rest at one position the robot is `M q̈ + D q̇ + K q = τ` (`M` with armature, `D` the viscous damping, `K` the slope of the
//! effort that holds it against gravity), held effort makes that an exact difference equation over the servo period, and the servo
//! is one already ([`super::servo`]). Together they are `x⁺ = A x`, and they are unstable where an eigenvalue of `A` lies outside
//! the unit circle.
//!
//! It is a linear statement at one position: limits of effort and integral, dry friction, joint stops, contact and air are left out.
//! A loop that is unstable here may be saved by an effort limit from growing beyond a buzz, and one that is stable here may
//! still run away from far off. In velocity mode positions are not fed back, so they and gravity's slope are left out: what gravity
//! does there is a slow drift and no fault of the gains.
//!
//! Source: Åström & Wittenmark, *Computer-Controlled Systems* (1997), sec. 2.3 (exact sampling of a held input).

mod linear;
mod stability;

pub use stability::{SampledLoop, sampled_loop};
