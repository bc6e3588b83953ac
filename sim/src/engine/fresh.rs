//! Contact points found anew in every step, where the engine would carry old ones along.
//!
//! Between two convex shapes the engine keeps its contact points, fixed to the surfaces, until they have gone 1 mm or 1 degree. A
//! can that rolls then stands on a point behind its centre, and its weight drives it on: on a level shelf it gained 0.05 m/s every
//! second. Points found anew are where the surfaces are.

use rapier3d_f64::geometry::{ContactData, ContactManifold, ContactManifoldData};
use rapier3d_f64::math::{Pose, Vector};
use rapier3d_f64::parry::query::details::{
    ContactManifoldsWorkspace, NormalConstraints, ShapeCastOptions,
};
use rapier3d_f64::parry::query::{
    ClosestPoints, Contact, DefaultQueryDispatcher, NonlinearRigidMotion,
    PersistentQueryDispatcher, QueryDispatcher, ShapeCastHit, ShapeDistance, ShapeIntersection,
    Unsupported,
};
use rapier3d_f64::parry::shape::Shape;

/// The engine's own queries, without old contact points.
pub(super) fn queries() -> impl PersistentQueryDispatcher<ContactManifoldData, ContactData> {
    Forget.chain(DefaultQueryDispatcher)
}

/// Answers nothing; makes who answers next start from the poses alone.
struct Forget;

impl PersistentQueryDispatcher<ContactManifoldData, ContactData> for Forget {
    fn contact_manifolds(
        &self,
        _: &Pose,
        _: &dyn Shape,
        _: &dyn Shape,
        _: f64,
        manifolds: &mut Vec<ContactManifold>,
        _: &mut Option<ContactManifoldsWorkspace>,
    ) -> Result<(), Unsupported> {
        for manifold in manifolds {
            manifold.mark_shapes_deformed();
        }
        Err(Unsupported)
    }

    fn contact_manifold_convex_convex(
        &self,
        _: &Pose,
        _: &dyn Shape,
        _: &dyn Shape,
        _: Option<&dyn NormalConstraints>,
        _: Option<&dyn NormalConstraints>,
        _: f64,
        manifold: &mut ContactManifold,
    ) -> Result<(), Unsupported> {
        manifold.mark_shapes_deformed();
        Err(Unsupported)
    }
}

impl QueryDispatcher for Forget {
    fn intersection_test(
        &self,
        _: &Pose,
        _: &dyn Shape,
        _: &dyn Shape,
    ) -> Result<ShapeIntersection, Unsupported> {
        Err(Unsupported)
    }

    fn distance(
        &self,
        _: &Pose,
        _: &dyn Shape,
        _: &dyn Shape,
    ) -> Result<ShapeDistance, Unsupported> {
        Err(Unsupported)
    }

    fn contact(
        &self,
        _: &Pose,
        _: &dyn Shape,
        _: &dyn Shape,
        _: f64,
    ) -> Result<Option<Contact>, Unsupported> {
        Err(Unsupported)
    }

    fn closest_points(
        &self,
        _: &Pose,
        _: &dyn Shape,
        _: &dyn Shape,
        _: f64,
    ) -> Result<ClosestPoints, Unsupported> {
        Err(Unsupported)
    }

    fn cast_shapes(
        &self,
        _: &Pose,
        _: Vector,
        _: &dyn Shape,
        _: &dyn Shape,
        _: ShapeCastOptions,
    ) -> Result<Option<ShapeCastHit>, Unsupported> {
        Err(Unsupported)
    }

    fn cast_shapes_nonlinear(
        &self,
        _: &NonlinearRigidMotion,
        _: &dyn Shape,
        _: &NonlinearRigidMotion,
        _: &dyn Shape,
        _: f64,
        _: f64,
        _: bool,
    ) -> Result<Option<ShapeCastHit>, Unsupported> {
        Err(Unsupported)
    }
}
