//! Points around round solids.

use nalgebra::Point3;

/// Points of a round edge.
const ROUND: usize = 32;

/// Points of a circle about z.
pub(super) fn ring(radius_m: f64, z_m: f64) -> impl Iterator<Item = Point3<f64>> {
    (0..ROUND).map(move |i| {
        let (s, c) = libm::sincos(std::f64::consts::TAU * i as f64 / ROUND as f64);
        Point3::new(radius_m * c, radius_m * s, z_m)
    })
}

/// Points of a ball on the z axis.
pub(super) fn ball(radius_m: f64, z_m: f64) -> impl Iterator<Item = Point3<f64>> {
    (0..=ROUND / 2).flat_map(move |i| {
        let (s, c) = libm::sincos(std::f64::consts::TAU * i as f64 / ROUND as f64);
        ring(radius_m * s, z_m + radius_m * c)
    })
}
