//! A capsule: a cylinder along z with a half ball on each end.

use nalgebra::Point3;

use super::drawn::{Drawn, ReplayForm};
use super::faces::{Detail, Faces};
use super::outline::ball;

/// A capsule along z, centred on its frame.
#[derive(Debug, Clone, Copy)]
pub(super) struct Capsule {
    pub(super) radius_m: f64,
    /// Without the half balls \[m\].
    pub(super) length_m: f64,
}

impl Drawn for Capsule {
    fn faces(&self, detail: Detail) -> Faces {
        Faces::round(self.radius_m, self.length_m, detail)
    }

    fn outline_m(&self) -> Vec<Point3<f64>> {
        let half_m = 0.5 * self.length_m;
        ball(self.radius_m, half_m)
            .chain(ball(self.radius_m, -half_m))
            .collect()
    }

    fn replay_form(&self) -> ReplayForm {
        let (radius_m, length_m) = (self.radius_m, self.length_m);
        ReplayForm::Capsule { radius_m, length_m }
    }

    #[cfg(feature = "log")]
    fn log_forms(&self) -> Vec<(Option<kinemark_sim::spatial::Pose>, super::LogForm)> {
        use super::LogForm;
        let (radius_m, length_m) = (self.radius_m, self.length_m);
        let end = |side: f64| {
            let along = nalgebra::Vector3::new(0.0, 0.0, side * length_m);
            let pose = kinemark_sim::spatial::pose(nalgebra::Matrix3::identity(), along);
            (Some(pose), LogForm::Sphere { radius_m })
        };
        vec![
            (None, LogForm::Cylinder { radius_m, length_m }),
            end(-0.5),
            end(0.5),
        ]
    }
}
