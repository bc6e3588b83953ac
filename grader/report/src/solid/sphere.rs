//! A ball.

use nalgebra::Point3;

use super::drawn::{Drawn, ReplayForm};
use super::faces::{Detail, Faces};
use super::outline::ball;

/// A ball, centred on its frame.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sphere {
    pub(super) radius_m: f64,
}

impl Drawn for Sphere {
    fn faces(&self, detail: Detail) -> Faces {
        Faces::round(self.radius_m, 0.0, detail)
    }

    fn outline_m(&self) -> Vec<Point3<f64>> {
        ball(self.radius_m, 0.0).collect()
    }

    fn replay_form(&self) -> ReplayForm {
        let radius_m = self.radius_m;
        ReplayForm::Sphere { radius_m }
    }

    #[cfg(feature = "log")]
    fn log_forms(&self) -> Vec<(Option<kinemark_sim::spatial::Pose>, super::LogForm)> {
        let radius_m = self.radius_m;
        vec![(None, super::LogForm::Sphere { radius_m })]
    }
}
