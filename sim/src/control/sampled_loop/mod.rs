//! The sampled-data limit of joint servos: how fast the loop of robot and servo grows or decays from sample to sample, and which
//! gains and periods would make it stable.
//!
//! At rest in one configuration the robot is `M q̈ + D q̇ + K q = τ` (`M` with armature, `D` the viscous damping, `K` the slope of the
//! gravity efforts). Held effort makes that an exact difference equation over the servo period, and the servo is one already
//! ([`super::servo`]). Together they are `x⁺ = A x`, and they are unstable where an eigenvalue of `A` lies outside the unit circle.
//!
//! The result is linear and holds near one configuration: limits of effort and integral, dry friction, joint limits, contact and air
//! are left out. An effort limit may keep an unstable loop at a small oscillation, and a stable loop may still diverge from a distant
//! start. In velocity mode positions are not fed back, so they and the slope of gravity are left out: gravity then causes a slow drift,
//! which the gains are not responsible for.
//!
//! Source: Åström & Wittenmark, *Computer-Controlled Systems* (1997), sec. 2.3 (exact sampling of a held input).

mod linear;
mod stability;

pub use stability::{
    SampledLoop, VariedGain, is_sampled_loop_stable, sampled_loop, stable_gain_factor,
};
