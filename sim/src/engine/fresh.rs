//! Contact points found anew as soon as surfaces have moved, where the engine would carry old ones along.
//!
//! Between two convex shapes the engine keeps its contact points, fixed to the surfaces, until they have gone 1 mm or 1 degree. A
//! can that rolls then stands on a point behind its centre, and its weight drives it on: on a level shelf it gained 0.05 m/s every
//! second. Points found anew are where the surfaces are. Only surfaces that cling to each other keep their points, or what is held
//! would creep.

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
use rapier3d_f64::parry::shape::{PackedFeatureId, Shape};

/// By this little \[rad\] surfaces may turn against each other and keep their contact points: a can that rolls slower than
/// 0.3 mm/s, driven by its weight through `r` times as much.
const CLINGS_RAD: f64 = 1e-5;
/// By this little \[m\] they may slide.
const CLINGS_M: f64 = 1e-5;
/// Points this near to each other \[m\] are one.
const SAME_M: f64 = 1e-6;

/// The engine's own queries, without old contact points where surfaces have moved.
pub(super) fn queries() -> impl PersistentQueryDispatcher<ContactManifoldData, ContactData> {
    Fresh.chain(DefaultQueryDispatcher)
}

/// Has the points of `manifold` found anew, unless the surfaces cling to each other.
fn forget_if_moved(first_from_second: &Pose, manifold: &mut ContactManifold) {
    let n1 = manifold.local_n1;
    let turned = n1.cross(first_from_second.rotation * manifold.local_n2);
    let clings = turned.length() <= CLINGS_RAD
        && manifold.points.iter().all(|point| {
            let apart = *first_from_second * point.local_p2 - point.local_p1;
            (apart - n1 * apart.dot(n1)).length() <= CLINGS_M
        });
    if !clings {
        manifold.mark_shapes_deformed();
    }
}

/// Drops the nearest point where it is a corner found already: that end of a lying can would carry twice its share, and the next
/// time the other.
fn drop_double(manifold: &mut ContactManifold) {
    let double = manifold.points.iter().position(|point| {
        point.fid1 == PackedFeatureId::UNKNOWN
            && manifold.points.iter().any(|other| {
                other.fid1 != PackedFeatureId::UNKNOWN
                    && (other.local_p1 - point.local_p1).length() <= SAME_M
            })
    });
    if let Some(index) = double {
        manifold.points.remove(index);
    }
}

/// Finds contact points; leaves all else to the engine.
struct Fresh;

impl PersistentQueryDispatcher<ContactManifoldData, ContactData> for Fresh {
    fn contact_manifolds(
        &self,
        first_from_second: &Pose,
        first: &dyn Shape,
        second: &dyn Shape,
        ahead_m: f64,
        manifolds: &mut Vec<ContactManifold>,
        workspace: &mut Option<ContactManifoldsWorkspace>,
    ) -> Result<(), Unsupported> {
        for manifold in manifolds.iter_mut() {
            forget_if_moved(first_from_second, manifold);
        }
        let engine = DefaultQueryDispatcher;
        engine.contact_manifolds(
            first_from_second,
            first,
            second,
            ahead_m,
            manifolds,
            workspace,
        )?;
        manifolds.iter_mut().for_each(drop_double);
        Ok(())
    }

    fn contact_manifold_convex_convex(
        &self,
        _: &Pose,
        _: &dyn Shape,
        _: &dyn Shape,
        _: Option<&dyn NormalConstraints>,
        _: Option<&dyn NormalConstraints>,
        _: f64,
        _: &mut ContactManifold,
    ) -> Result<(), Unsupported> {
        // asked of the engine's own, by itself
        Err(Unsupported)
    }
}

impl QueryDispatcher for Fresh {
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
