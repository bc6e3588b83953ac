//! Which shapes are near each other, and at which points.
//!
//! Contact points are recomputed as soon as surfaces have moved, where the library would reuse old ones. Between two convex shapes it
//! keeps its contact points, fixed to the surfaces, until they have moved by 1 mm or 1 degree. A rolling can then rests on a point
//! behind its centre, and its weight accelerates it: on a level shelf it gained 0.05 m/s every second. Only surfaces that stick to each
//! other keep their points; otherwise a body at rest would creep.

use parry3d_f64::bounding_volume::{Aabb, BoundingVolume as _};
use parry3d_f64::math::{Pose as EnginePose, Vector};
use parry3d_f64::partitioning::{Bvh, BvhLeafUpdateStatus, BvhWorkspace};
use parry3d_f64::query::details::ContactManifoldsWorkspace;
use parry3d_f64::query::{
    ContactManifold, DefaultQueryDispatcher, PersistentQueryDispatcher as _, TrackedContact,
};
use parry3d_f64::shape::{PackedFeatureId, Shape, SharedShape};

use crate::model::contact::Party;
use crate::model::robot::Contact;

/// Surfaces may rotate against each other by this much \[rad\] and keep their contact points: that of a can which rolls slower than
/// 0.3 mm/s, driven by its weight through `r` times as much.
const CLINGS_RAD: f64 = 1e-5;
/// Surfaces may slide by this much \[m\] and keep their contact points.
const CLINGS_M: f64 = 1e-5;
/// Contact points this near to each other \[m\] count as one.
const SAME_M: f64 = 1e-6;
/// Surfaces nearer than this touch exactly \[m\] ...
const EXACT_M: f64 = 1e-12;
/// ... and are looked at again this much apart \[m\].
const APART_M: f64 = 1e-7;
/// Bounds are this much larger than the shapes \[m\], so that what rests need not be sorted anew.
const MARGIN_M: f64 = 0.01;

/// What carries a shape.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Carrier {
    /// Fixed to the world.
    World,
    /// A kinematic body, by its place among those.
    Driven(usize),
    /// A dynamic body, by its place among those.
    Free(usize),
    /// A moving body of the robot.
    Arm(usize),
}

/// A shape in the world.
pub(super) struct Collider {
    pub(super) party: Party,
    pub(super) carrier: Carrier,
    pub(super) surface: Contact,
    pub(super) shape: SharedShape,
    pub(super) carrier_from_shape: EnginePose,
    pub(super) world_from_shape: EnginePose,
    pub(super) bounds: Aabb,
}

impl Collider {
    pub(super) fn new(
        party: Party,
        carrier: Carrier,
        surface: Contact,
        (shape, carrier_from_shape): (SharedShape, EnginePose),
    ) -> Self {
        Self {
            party,
            carrier,
            surface,
            bounds: shape.compute_aabb(&carrier_from_shape),
            world_from_shape: carrier_from_shape,
            carrier_from_shape,
            shape,
        }
    }

    pub(super) fn place(&mut self, world_from_carrier: &EnginePose) {
        self.world_from_shape = *world_from_carrier * self.carrier_from_shape;
        self.bounds = self.shape.compute_aabb(&self.world_from_shape);
    }

    /// The ground has no finite bounds.
    pub(super) fn is_bounded(&self) -> bool {
        self.shape.as_halfspace().is_none()
    }
}

/// What a contact point keeps from step to step.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Memory {
    /// Correction of the place \[kg m\].
    pub(super) place: f64,
    /// Normal impulse \[N s\].
    pub(super) impulse: f64,
    /// Friction impulse on the second shape, world axes \[N s\].
    pub(super) rubbed: Vector,
    /// Where both act, world axes \[m\].
    pub(super) p: Vector,
}

pub(super) type Manifold = ContactManifold<(), Memory>;

/// Two shapes that are near each other.
pub(super) struct Pair {
    pub(super) colliders: [usize; 2],
    pub(super) manifolds: Vec<Manifold>,
    workspace: Option<ContactManifoldsWorkspace>,
    /// Whether its manifolds are those of this step.
    pub(super) is_fresh: bool,
}

impl Pair {
    /// Finds its contact points, up to `ahead_m` apart.
    fn look(&mut self, colliders: &[Collider], ahead_m: f64) {
        let [first, second] = self.colliders.map(|index| &colliders[index]);
        let shapes = [first, second].map(|one| one.shape.as_ref());
        let first_from_second = first.world_from_shape.inv_mul(&second.world_from_shape);
        for manifold in &mut self.manifolds {
            forget_if_moved(&first_from_second, manifold);
        }
        self.search(shapes, &first_from_second, ahead_m);
        if self.manifolds.iter().any(|one| is_lost(shapes, one)) {
            let mut apart = first_from_second;
            apart.translation += apart.translation.normalize_or_zero() * APART_M;
            for manifold in &mut self.manifolds {
                manifold.mark_shapes_deformed();
            }
            self.search(shapes, &apart, ahead_m);
        }
        self.manifolds.iter_mut().for_each(drop_double);
    }

    fn search(&mut self, shapes: [&dyn Shape; 2], first_from_second: &EnginePose, ahead_m: f64) {
        let [first, second] = shapes;
        let found = DefaultQueryDispatcher.contact_manifolds(
            first_from_second,
            first,
            second,
            ahead_m,
            &mut self.manifolds,
            &mut self.workspace,
        );
        if found.is_err() {
            self.manifolds.clear();
        }
    }
}

/// All pairs of one world, in the order of their shapes.
#[derive(Default)]
pub(super) struct Pairs {
    pairs: Vec<Pair>,
    tree: Bvh,
    workspace: BvhWorkspace,
    /// The shapes without finite bounds.
    boundless: Vec<usize>,
    found: Vec<[usize; 2]>,
    /// The pairs of the last step, while those of this step are listed.
    known: Vec<Pair>,
}

impl Pairs {
    pub(super) fn new(colliders: &[Collider]) -> Self {
        let mut tree = Bvh::new();
        let bounded = colliders.iter().enumerate();
        for (index, collider) in bounded.filter(|(_, collider)| collider.is_bounded()) {
            tree.insert(collider.bounds.loosened(MARGIN_M), index as u32);
        }
        Self {
            tree,
            boundless: (0..colliders.len())
                .filter(|index| !colliders[*index].is_bounded())
                .collect(),
            ..Self::default()
        }
    }

    pub(super) fn as_slice(&self) -> &[Pair] {
        &self.pairs
    }

    pub(super) fn as_mut_slice(&mut self) -> &mut [Pair] {
        &mut self.pairs
    }

    /// Notes where the shapes of `moved` are now.
    pub(super) fn sort(&mut self, colliders: &[Collider], moved: impl Iterator<Item = usize>) {
        let mut changed = false;
        for index in moved {
            let status = self.tree.insert_or_update_partially(
                colliders[index].bounds,
                index as u32,
                MARGIN_M,
            );
            changed |= status != BvhLeafUpdateStatus::Unchanged;
        }
        if changed {
            self.tree.refit(&mut self.workspace);
        }
    }

    /// Finds the contact points, up to `ahead_m` apart, of the shapes for which `moves` with those for which they `meet`. Pairs of
    /// which neither moves keep their points.
    pub(super) fn find(
        &mut self,
        colliders: &[Collider],
        ahead_m: f64,
        moves: impl Fn(&Collider) -> bool,
        meet: impl Fn(&Collider, &Collider) -> bool,
    ) {
        self.found.clear();
        for (index, collider) in colliders.iter().enumerate() {
            if !moves(collider) {
                continue;
            }
            let bounds = collider.bounds.loosened(ahead_m);
            let near = self.tree.intersect_aabb(&bounds).map(|leaf| leaf as usize);
            for other in near.chain(self.boundless.iter().copied()) {
                let second = &colliders[other];
                // of two that move, only the first finds the pair
                let is_first = index < other || !moves(second);
                let near = !second.is_bounded() || bounds.intersects(&second.bounds);
                if other != index && is_first && near && meet(collider, second) {
                    self.found.push([index.min(other), index.max(other)]);
                }
            }
        }
        self.found.sort_unstable();
        self.merge(|pair| pair.iter().any(|index| moves(&colliders[*index])));
        for pair in self.pairs.iter_mut().filter(|pair| pair.is_fresh) {
            pair.look(colliders, ahead_m);
        }
    }

    /// Keeps the pairs that were found and those of which nothing moves, and adds the new ones.
    fn merge(&mut self, moves: impl Fn(&[usize; 2]) -> bool) {
        std::mem::swap(&mut self.pairs, &mut self.known);
        let mut known = self.known.drain(..).peekable();
        let mut found = self.found.iter().peekable();
        loop {
            let next = match (known.peek(), found.peek()) {
                (None, None) => break,
                (Some(pair), None) => pair.colliders,
                (None, Some(found)) => **found,
                (Some(pair), Some(found)) => pair.colliders.min(**found),
            };
            let was = known.next_if(|pair| pair.colliders == next);
            let is = found.next_if(|found| **found == next).is_some();
            match was {
                Some(mut pair) if is || !moves(&next) => {
                    pair.is_fresh = is;
                    self.pairs.push(pair);
                }
                None if is => self.pairs.push(Pair {
                    colliders: next,
                    manifolds: Vec::new(),
                    workspace: None,
                    is_fresh: true,
                }),
                _ => {}
            }
        }
    }
}

/// Makes the library recompute the points of `manifold`, unless the surfaces stick to each other.
fn forget_if_moved(first_from_second: &EnginePose, manifold: &mut Manifold) {
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

/// Whether the library may have lost the normal: it searches for it in the difference of two shapes, and finds none where they touch
/// exactly, to the last bit.
fn is_lost(shapes: [&dyn Shape; 2], manifold: &Manifold) -> bool {
    let touches = |point: &TrackedContact<Memory>| {
        point.fid1 == PackedFeatureId::UNKNOWN && point.dist.abs() <= EXACT_M
    };
    let searched = |shape: &dyn Shape| shape.as_polygonal_feature_map().is_some();
    manifold.points.iter().any(touches) && shapes.into_iter().all(searched)
}

/// Drops the point of least distance if it lies on a face or edge whose corners were already found: otherwise one end of a can on its
/// side would carry twice its share, and in another step the other end.
fn drop_double(manifold: &mut Manifold) {
    let is_corner = |point: &TrackedContact<Memory>| point.fid1 != PackedFeatureId::UNKNOWN;
    let corners = manifold.points.iter().filter(|point| is_corner(point));
    let nearest = corners
        .map(|corner| corner.dist)
        .fold(f64::INFINITY, f64::min);
    if nearest < f64::INFINITY {
        manifold
            .points
            .retain(|point| is_corner(point) || point.dist < nearest - SAME_M);
    }
}

/// The vertices of a hull; none of any other shape.
pub(super) fn vertices(shape: &dyn Shape) -> usize {
    let hull = shape.as_convex_polyhedron();
    hull.map_or(0, |hull| hull.points().len())
}
