//! The range finder: how far it is from a frame's origin along an axis of it to the first surface.

use crate::engine::{LinkShapes, Ray};
use crate::kinematics::FramePoses;
use crate::model::robot::Robot;
use crate::model::sensor::RangeFinder;
use crate::step::hybrid::HybridStep;

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
