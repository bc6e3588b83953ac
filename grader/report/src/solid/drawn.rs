//! What every renderer asks a solid for, and the list of the solids that there are.

use kinemark_sim::model::inertia::Solid;
use kinemark_sim::spatial::Pose;
use nalgebra::Point3;

use super::block::Block;
use super::capsule::Capsule;
use super::cylinder::Cylinder;
use super::faces::{Detail, Faces};
use super::sphere::Sphere;
use super::surface::Surface;

/// How finely a solid is drawn that a viewer knows no form of.
const FINE: Detail = Detail {
    around: 32,
    triangles: usize::MAX,
};

/// A solid as renderers see it, in its own frame. Its faces are enough; the rest is shorter or rounder.
pub(crate) trait Drawn {
    /// Its faces.
    fn faces(&self, detail: Detail) -> Faces;

    /// Points whose convex hull is the solid, or nearly \[m\].
    fn outline_m(&self) -> Vec<Point3<f64>> {
        self.faces(FINE).corners().collect()
    }

    /// Triangles that it is described by, which a picture may have to thin; none of a solid with a formula.
    fn own_triangles(&self) -> usize {
        0
    }

    /// What the viewer of replays draws.
    fn replay_form(&self) -> ReplayForm {
        ReplayForm::Surface(self.faces(FINE).surface())
    }

    /// What viewers of logs draw: parts, each where the solid is or at its own pose in the solid's frame.
    #[cfg(feature = "log")]
    fn log_forms(&self) -> Vec<(Option<Pose>, LogForm)> {
        vec![(None, LogForm::Surface(self.faces(FINE).surface()))]
    }
}

/// What the viewer of replays can draw.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum ReplayForm {
    /// Edge lengths \[m\].
    Box([f64; 3]),
    /// Along z \[m\].
    Cylinder { radius_m: f64, length_m: f64 },
    /// Along z, the length without its half balls \[m\].
    Capsule { radius_m: f64, length_m: f64 },
    /// \[m\]
    Sphere { radius_m: f64 },
    /// Anything else.
    Surface(Surface),
}

/// What viewers of logs can draw.
#[cfg(feature = "log")]
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum LogForm {
    /// Edge lengths \[m\].
    Box([f64; 3]),
    /// Along z \[m\].
    Cylinder { radius_m: f64, length_m: f64 },
    /// \[m\]
    Sphere { radius_m: f64 },
    /// Anything else.
    Surface(Surface),
}

/// A solid as renderers see it.
pub(crate) fn drawn(solid: &Solid) -> Box<dyn Drawn + '_> {
    match *solid {
        Solid::Box { size_m } => Box::new(Block { size_m }),
        Solid::Cylinder { radius_m, length_m } => Box::new(Cylinder { radius_m, length_m }),
        Solid::Capsule { radius_m, length_m } => Box::new(Capsule { radius_m, length_m }),
        Solid::Sphere { radius_m } => Box::new(Sphere { radius_m }),
        Solid::Mesh(ref mesh) => Box::new(mesh),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Vector3;

    const DETAIL: Detail = Detail {
        around: 16,
        triangles: 200,
    };

    fn primitives() -> [Solid; 4] {
        [
            Solid::Box {
                size_m: [1.0, 2.0, 3.0],
            },
            Solid::Cylinder {
                radius_m: 0.5,
                length_m: 2.0,
            },
            Solid::Capsule {
                radius_m: 0.5,
                length_m: 2.0,
            },
            Solid::Sphere { radius_m: 0.5 },
        ]
    }

    #[test]
    fn faces_are_closed_and_look_outwards() {
        for solid in primitives() {
            drawn(&solid).faces(DETAIL).assert_closed();
        }
    }

    #[test]
    fn outlines_have_the_extent_of_their_solid() {
        for solid in primitives() {
            let (_, half) = solid.extent_m();
            let outline = drawn(&solid).outline_m();
            for axis in 0..3 {
                let reach = outline.iter().map(|p| p[axis]).fold(0.0, f64::max);
                assert!(
                    (reach - half[axis]).abs() < 1e-12,
                    "{solid:?} {axis} {reach}"
                );
            }
        }
    }

    /// A primitive of which only the faces are known.
    struct FacesAlone(Block);

    impl Drawn for FacesAlone {
        fn faces(&self, detail: Detail) -> Faces {
            self.0.faces(detail)
        }
    }

    #[test]
    fn faces_are_enough_for_every_renderer() {
        let block = FacesAlone(Block {
            size_m: [1.0, 2.0, 3.0],
        });
        let ReplayForm::Surface(surface) = block.replay_form() else {
            panic!("no form is known");
        };
        assert_eq!(surface.bounds(), ([-0.5, -1.0, -1.5], [0.5, 1.0, 1.5]));
        // two triangles a side, all looking outwards
        assert_eq!(surface.triangles().len(), 12);
        for triangle in surface.triangles() {
            let [a, b, c] = triangle.map(|i| Vector3::from(surface.vertices()[i as usize]));
            assert!((b - a).cross(&(c - a)).dot(&a) > 0.0);
        }
        assert_eq!(block.outline_m().len(), 24);
        #[cfg(feature = "log")]
        assert_eq!(
            block.log_forms(),
            [(None, LogForm::Surface(surface.clone()))]
        );
    }
}
