//! Rays: how far it is along one to a shape, whatever the engine has stepped or left out.

use nalgebra::Vector3;
use parry3d_f64::math::Pose as EnginePose;
use parry3d_f64::query::Ray as EngineRay;
use parry3d_f64::shape::{Shape as EngineShape, SharedShape};

use super::collider::shape_of;
use super::convert::vector;
use super::engine_error::EngineError;
use super::pairs::Collider;
use crate::kinematics::FramePoses;
use crate::kinematics::forward::BodyPose;
use crate::model::contact::Party;
use crate::model::robot::Robot;

/// A ray of limited length and the nearest thing it has met; of things at the same distance, the first it was shown.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Ray {
    from: Vector3<f64>,
    direction: Vector3<f64>,
    range_m: f64,
    nearest: Option<(Party, f64)>,
}

impl Ray {
    /// A ray `from` a point along the unit vector `direction`, both in the world.
    pub(crate) fn new(from: &Vector3<f64>, direction: &Vector3<f64>, range_m: f64) -> Self {
        let finite = from.iter().chain(direction).all(|x| x.is_finite());
        Self {
            from: *from,
            direction: *direction,
            // a ray that is not finite hits nothing
            range_m: if finite { range_m } else { f64::NEG_INFINITY },
            nearest: None,
        }
    }

    /// The nearest party hit so far, and its distance \[m\].
    pub(crate) fn nearest(&self) -> Option<(Party, f64)> {
        self.nearest
    }

    fn met(&mut self, party: Party, distance_m: f64) {
        let nearer = self.nearest.is_none_or(|(_, known)| distance_m < known);
        if nearer && distance_m <= self.range_m {
            self.nearest = Some((party, distance_m));
        }
    }

    /// Tests the ray against the ground.
    pub(super) fn meet_ground(&mut self) {
        if self.from.z <= 0.0 {
            self.met(Party::Ground, 0.0);
        } else if self.direction.z < 0.0 {
            self.met(Party::Ground, -self.from.z / self.direction.z);
        }
    }

    /// Tests the ray against a shape in the world.
    pub(super) fn meet_collider(&mut self, collider: &Collider) {
        let (from, direction) = (self.from, self.direction);
        let place = &collider.world_from_shape;
        self.meet(
            collider.party,
            collider.shape.as_ref(),
            place,
            &from,
            &direction,
        );
    }

    /// Tests the ray against a shape, in a frame in which the ray starts at `from` along `direction`.
    fn meet(
        &mut self,
        party: Party,
        shape: &dyn EngineShape,
        place: &EnginePose,
        from: &Vector3<f64>,
        direction: &Vector3<f64>,
    ) {
        if self.range_m < 0.0 {
            return;
        }
        let ray = EngineRay::new(vector(from), vector(direction));
        if let Some(distance_m) = shape.cast_ray(place, &ray, self.range_m, true) {
            self.met(party, distance_m);
        }
    }
}

/// The shapes of a robot's links, for ray casting.
pub(crate) struct LinkShapes(Vec<LinkShape>);

struct LinkShape {
    link: usize,
    body: Option<usize>,
    body_from_shape: EnginePose,
    shape: SharedShape,
}

impl LinkShapes {
    /// The shapes of all links.
    ///
    /// # Errors
    /// A mesh without a hull.
    pub(crate) fn new(robot: &Robot) -> Result<Self, EngineError> {
        let mut shapes = Vec::new();
        for (index, link) in robot.links().iter().enumerate() {
            for shape in &link.shapes {
                let place = &link.attachment.body_from_here;
                let (shape, body_from_shape) = shape_of(&link.name, shape, place)?;
                shapes.push(LinkShape {
                    link: index,
                    body: link.attachment.body,
                    body_from_shape,
                    shape,
                });
            }
        }
        Ok(Self(shapes))
    }

    /// Tests `ray` against all links except those fixed to `own`, a moving body or the world.
    pub(crate) fn meet(&self, poses: &FramePoses, own: Option<usize>, ray: &mut Ray) {
        for LinkShape {
            link,
            body,
            body_from_shape,
            shape,
        } in self.0.iter().filter(|shape| shape.body != own)
        {
            let placed = body.map_or(BodyPose::WORLD, |body| poses.placed[body]);
            let body_from_world = placed.world_from_body.transpose();
            let from = body_from_world * (ray.from - placed.position);
            let direction = body_from_world * ray.direction;
            ray.meet(
                Party::Link(*link),
                &**shape,
                body_from_shape,
                &from,
                &direction,
            );
        }
    }
}
