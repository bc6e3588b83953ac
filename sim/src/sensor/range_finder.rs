//! The range finder: how far it is from a frame's origin along an axis of it to the first surface.

use nalgebra::Vector3;

use crate::engine::{LinkShapes, Ray};
use crate::hybrid::HybridStep;
use crate::kinematics::FramePoses;
use crate::robot::Robot;

/// A ray fixed to a frame of the robot. It sees bodies, ground and all links but those fixed together with its own.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RangeFinder {
    /// Index of the frame among [`Robot::frames`]; the ray starts at its origin.
    pub frame: usize,
    /// Direction of the ray in the frame, a unit vector.
    pub axis: Vector3<f64>,
    /// How far it sees, and what it reads when it sees nothing \[m\].
    pub range_m: f64,
}

impl RangeFinder {
    /// The distance to what the ray meets first \[m\], if that is within its range.
    pub(super) fn distance_m(
        &self,
        robot: &Robot,
        poses: &FramePoses,
        links: &LinkShapes,
        scene: Option<&HybridStep>,
    ) -> Option<f64> {
        let frame = &robot.frames()[self.frame];
        let world_from_frame = poses.world_from(frame);
        let direction = world_from_frame.rotation * self.axis;
        let mut ray = Ray::new(
            &world_from_frame.translation.vector,
            &direction,
            self.range_m,
        );
        links.meet(poses, frame.attachment.body, &mut ray);
        if let Some(scene) = scene {
            scene.show(&mut ray);
        }
        ray.nearest().map(|(_, distance_m)| distance_m)
    }
}
