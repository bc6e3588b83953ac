//! Standard gravity.

use nalgebra::Vector3;

/// Standard gravity in the world, z up \[m/s²\].
pub const GRAVITY_M_S2: Vector3<f64> = Vector3::new(0.0, 0.0, -9.81);
