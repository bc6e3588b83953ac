//! A box.

use nalgebra::{Point3, Vector3};

use super::drawn::{Drawn, ReplayForm};
use super::faces::{Detail, Faces};

/// A box, centred on its frame.
#[derive(Debug, Clone, Copy)]
pub(super) struct Block {
    /// Edge lengths along x, y, z \[m\].
    pub(super) size_m: [f64; 3],
}

impl Block {
    /// A corner by three bits: low or high in x, y, z.
    fn corner(&self, bits: usize) -> Point3<f64> {
        let sign = |bit: usize| if bits & bit == 0 { -0.5 } else { 0.5 };
        let signs = Vector3::new(sign(1), sign(2), sign(4));
        Point3::from(Vector3::from(self.size_m).component_mul(&signs))
    }
}

impl Drawn for Block {
    fn faces(&self, _: Detail) -> Faces {
        let sides = [
            [0, 2, 3, 1],
            [4, 5, 7, 6],
            [0, 1, 5, 4],
            [2, 6, 7, 3],
            [0, 4, 6, 2],
            [1, 3, 7, 5],
        ];
        let corner = |bits| self.corner(bits);
        let face = |side: [usize; 4]| (side.map(corner).to_vec(), vec![true; 4]);
        Faces::convex(sides.into_iter().map(face).collect())
    }

    fn outline_m(&self) -> Vec<Point3<f64>> {
        (0..8).map(|bits| self.corner(bits)).collect()
    }

    fn replay_form(&self) -> ReplayForm {
        ReplayForm::Box(self.size_m)
    }

    #[cfg(feature = "log")]
    fn log_forms(&self) -> Vec<(Option<kinemark_sim::spatial::Pose>, super::LogForm)> {
        vec![(None, super::LogForm::Box(self.size_m))]
    }
}
