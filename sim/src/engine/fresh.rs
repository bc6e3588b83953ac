//! Contact points are recomputed as soon as surfaces have moved, where the engine would reuse old ones.
//!
//! Between two convex shapes the engine keeps its contact points, fixed to the surfaces, until they have moved by 1 mm or 1 degree. A
//! rolling can then rests on a point behind its centre, and its weight accelerates it: on a level shelf it gained 0.05 m/s every
//! second. Recomputed points are where the surfaces are. Only surfaces that stick to each other keep their points; otherwise a body at
//! rest would creep.

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

/// Surfaces may rotate against each other by this much \[rad\] and keep their contact points: that of a can which rolls slower than
/// 0.3 mm/s, driven by its weight through `r` times as much.
const CLINGS_RAD: f64 = 1e-5;
/// Surfaces may slide by this much \[m\] and keep their contact points.
const CLINGS_M: f64 = 1e-5;
/// Contact points this near to each other \[m\] count as one.
const SAME_M: f64 = 1e-6;

/// The engine's queries, without old contact points where surfaces have moved.
pub(super) fn queries() -> impl PersistentQueryDispatcher<ContactManifoldData, ContactData> {
    FreshContacts.chain(DefaultQueryDispatcher)
}

/// Makes the engine recompute the points of `manifold`, unless the surfaces stick to each other.
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

/// Drops the nearest point if it repeats a corner that was already found: otherwise one end of a lying can would carry twice its share,
/// and in another step the other end.
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

/// Recomputes contact points; leaves all other queries to the engine.
struct FreshContacts;

impl PersistentQueryDispatcher<ContactManifoldData, ContactData> for FreshContacts {
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
        // the engine's dispatcher calls its own implementation of this
        Err(Unsupported)
    }
}

impl QueryDispatcher for FreshContacts {
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
