//! A cylinder along z.

use nalgebra::Point3;

use super::drawn::{Drawn, ReplayForm};
use super::faces::{Detail, Faces};
use super::outline::ring;

/// A cylinder along z, centred on its frame.
#[derive(Debug, Clone, Copy)]
pub(super) struct Cylinder {
    pub(super) radius_m: f64,
    pub(super) length_m: f64,
}

impl Drawn for Cylinder {
    fn faces(&self, detail: Detail) -> Faces {
        let (radius_m, half_m) = (self.radius_m, 0.5 * self.length_m);
        Faces::turned(
            &[(radius_m, -half_m), (radius_m, half_m)],
            detail.around,
            true,
        )
    }

    fn outline_m(&self) -> Vec<Point3<f64>> {
        let half_m = 0.5 * self.length_m;
        ring(self.radius_m, half_m)
            .chain(ring(self.radius_m, -half_m))
            .collect()
    }

    fn replay_form(&self) -> ReplayForm {
        let (radius_m, length_m) = (self.radius_m, self.length_m);
        ReplayForm::Cylinder { radius_m, length_m }
    }

    #[cfg(feature = "log")]
    fn log_forms(&self) -> Vec<(Option<kinemark_sim::spatial::Pose>, super::LogForm)> {
        let (radius_m, length_m) = (self.radius_m, self.length_m);
        vec![(None, super::LogForm::Cylinder { radius_m, length_m })]
    }
}
