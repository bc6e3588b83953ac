//! Overlap queries without a simulation step: which parties overlap, what lies below a point, what a straight path enters.
//!
//! The shapes are those of a run. A surface of triangles has no inside: only shapes that cross it overlap.

use std::cmp::Ordering;

use nalgebra::Vector3;
use parry3d_f64::bounding_volume::{Aabb, BoundingVolume as _};
use parry3d_f64::math::{Pose as EnginePose, Vector};
use parry3d_f64::partitioning::{Bvh, BvhBuildStrategy};
use parry3d_f64::query::{Ray, RayCast as _, contact, intersection_test};
use parry3d_f64::shape::SharedShape;

use super::collider::shape_of;
use super::convert::{engine_pose, from_vector, vector};
use super::engine_error::EngineError;
use super::pairs::vertices;
use super::work::{self, WorkBudget};
use crate::kinematics::FramePoses;
use crate::model::contact::Party;
use crate::model::robot::{Robot, Shape};
use crate::model::scene::{BodyKind, Scene};
use crate::spatial::Pose;

/// Where centres coincide, the search for the separating direction has no start; an offset of this much gives it one \[m\].
const ASIDE_M: f64 = 1e-7;

/// Farther than anything can be \[m\]: numbers of a scene are at most a millionth of it.
const ANYWHERE_M: f64 = 1e12;

/// Two parties that overlap.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Overlap {
    /// Both parties, the lesser first.
    pub parties: [Party; 2],
    /// Penetration depth: how far one must move until they only touch \[m\].
    pub depth_m: f64,
    /// The point of deepest penetration, in the world \[m\].
    pub p_in_world: Vector3<f64>,
    /// Whether a run pushes them apart; false if both are fixed or kinematic.
    pub pushes: bool,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Mobility {
    /// Fixed to the world.
    Stands,
    /// Follows a prescribed motion.
    Driven,
    /// A dynamic body, or a link that joints move.
    Moves,
}

#[derive(Debug, Clone)]
struct Solid {
    shape: SharedShape,
    owner_from_shape: EnginePose,
    world_from_shape: EnginePose,
    bounds: Aabb,
    /// Its centre of volume, inside every convex shape \[m\].
    p_centre_in_shape: Vector,
}

#[derive(Debug, Clone)]
struct Part {
    party: Party,
    mobility: Mobility,
    solids: Vec<Solid>,
}

/// The poses of all shapes of a scene and of a robot in it.
#[derive(Debug, Clone)]
pub struct Layout {
    /// The bodies in their order, then the ground, then the links in theirs.
    parts: Vec<Part>,
    /// Which of them are where, until something moves; all but the ground.
    index: Option<Bvh>,
}

impl Layout {
    /// The bodies of `scene` where they start, and `robot` at `q = 0` until it is placed.
    ///
    /// # Errors
    /// Meshes that the engine cannot use.
    pub fn new(scene: &Scene, robot: Option<&Robot>) -> Result<Self, EngineError> {
        let mut parts = Vec::new();
        for (index, body) in scene.bodies.iter().enumerate() {
            let mobility = match body.kind {
                BodyKind::Fixed => Mobility::Stands,
                BodyKind::Kinematic(_) => Mobility::Driven,
                BodyKind::Free => Mobility::Moves,
            };
            let solids = solids(&body.name, &body.shapes)?;
            let mut part = Part {
                party: Party::Body(index),
                mobility,
                solids,
            };
            part.place(&body.world_from_body);
            parts.push(part);
        }
        if scene.environment.ground.is_some() {
            parts.push(Part {
                party: Party::Ground,
                mobility: Mobility::Stands,
                solids: vec![Solid::new(
                    SharedShape::halfspace(Vector::Z),
                    EnginePose::IDENTITY,
                )],
            });
        }
        for (index, link) in robot.into_iter().flat_map(Robot::links).enumerate() {
            parts.push(Part {
                party: Party::Link(index),
                mobility: match link.attachment.body {
                    Some(_) => Mobility::Moves,
                    None => Mobility::Stands,
                },
                solids: solids(&link.name, &link.shapes)?,
            });
        }
        let mut layout = Self { parts, index: None };
        if let Some(robot) = robot {
            layout.place_robot(robot, &FramePoses::new(robot));
        }
        Ok(layout)
    }

    /// Moves the links of `robot`, which must be the one the layout was made with.
    pub fn place_robot(&mut self, robot: &Robot, poses: &FramePoses) {
        self.index = None;
        for part in &mut self.parts {
            if let Party::Link(index) = part.party {
                // every link is the frame of its index
                part.place(&poses.world_from(&robot.frames()[index]));
            }
        }
    }

    /// Moves body `index` of the scene.
    pub fn place_body(&mut self, index: usize, world_from_body: &Pose) {
        self.index = None;
        self.parts[index].place(world_from_body);
    }

    /// Makes short paths cheap to look along ([`Layout::entered`]), until something is placed anew.
    pub fn index(&mut self) {
        let merged = |part: &Part| {
            let bounds = part.solids.iter().map(|solid| solid.bounds);
            bounds.reduce(|one, other| one.merged(&other))
        };
        let parts = self.parts.iter().enumerate();
        // the ground has no finite bounds
        let boxed = parts.filter(|(_, part)| part.party != Party::Ground);
        let bounds = boxed.filter_map(|(index, part)| Some((index, merged(part)?)));
        self.index = Some(Bvh::from_iter(BvhBuildStrategy::default(), bounds));
    }

    /// The overlaps deeper than `least_m` of bodies with each other and the ground, in their order; pairs that are both fixed to the
    /// world are left out. Once `budget` is spent, so is what comes after.
    pub fn among_bodies(&self, least_m: f64, budget: &mut WorkBudget) -> Vec<Overlap> {
        let is_link = |part: &Part| matches!(part.party, Party::Link(_));
        let parts: Vec<&Part> = self.parts.iter().filter(|part| !is_link(part)).collect();
        let mut found = Vec::new();
        for (index, first) in parts.iter().enumerate() {
            for second in &parts[index + 1..] {
                found.extend(overlap(first, second, least_m, budget));
            }
        }
        found.sort_by_key(|overlap| overlap.parties);
        found
    }

    /// The overlaps deeper than `least_m` of links with bodies and the ground, in their order; pairs that are both fixed to the world
    /// are left out, and so are pairs of links. Once `budget` is spent, so is what comes after.
    pub fn of_links(&self, least_m: f64, budget: &mut WorkBudget) -> Vec<Overlap> {
        let is_link = |part: &&Part| matches!(part.party, Party::Link(_));
        let mut found = Vec::new();
        for link in self.parts.iter().filter(is_link) {
            for other in self.parts.iter().filter(|part| !is_link(part)) {
                found.extend(overlap(link, other, least_m, budget));
            }
        }
        found.sort_by_key(|overlap| overlap.parties);
        found
    }

    /// Centres of the shapes of body `index`, in the world \[m\].
    pub fn centres_of(&self, index: usize) -> impl Iterator<Item = Vector3<f64>> {
        let solids = self.parts[index].solids.iter();
        solids.map(|solid| from_vector(solid.world_from_shape * solid.p_centre_in_shape))
    }

    /// The first party that the straight path `from` one point `to` another enters, without body `index`, the links that joints move,
    /// and anything that contains `from`.
    pub fn entered(
        &self,
        index: usize,
        from: &Vector3<f64>,
        to: &Vector3<f64>,
        budget: &mut WorkBudget,
    ) -> Option<Party> {
        let ray = Ray::new(vector(from), vector(&(to - from)));
        let counts = |fraction| fraction > 0.0;
        let hit = match &self.index {
            None => first_hit(index, &ray, 1.0, self.parts.iter(), counts, budget),
            Some(known) => {
                let path = Aabb::from_points([vector(from), vector(to)]);
                let leaves = known.intersect_aabb(&path);
                let mut near: Vec<usize> = leaves.map(|leaf| leaf as usize).collect();
                let ground = |part: &Part| part.party == Party::Ground;
                near.extend(self.parts.iter().position(ground));
                // as all of them would be looked at
                near.sort_unstable();
                let parts = near.into_iter().map(|part| &self.parts[part]);
                first_hit(index, &ray, 1.0, parts, counts, budget)
            }
        };
        hit.map(|(party, _)| party)
    }

    /// The first party, without body `index`, that a ray from `p_in_world` in the direction `down` hits, and the point.
    pub fn below(
        &self,
        index: usize,
        p_in_world: &Vector3<f64>,
        down: &Vector3<f64>,
        budget: &mut WorkBudget,
    ) -> Option<(Party, Vector3<f64>)> {
        let ray = Ray::new(vector(p_in_world), vector(down));
        let parts = self.parts.iter();
        let (party, distance_m) = first_hit(index, &ray, ANYWHERE_M, parts, |_| true, budget)?;
        Some((party, p_in_world + down * distance_m))
    }
}

/// The first of `parts` that a ray hits, without body `index` and links that joints move, and where; of those at the same distance the
/// first one.
fn first_hit<'p>(
    index: usize,
    ray: &Ray,
    most: f64,
    parts: impl Iterator<Item = &'p Part>,
    counts: impl Fn(f64) -> bool,
    budget: &mut WorkBudget,
) -> Option<(Party, f64)> {
    let mut first: Option<(Party, f64)> = None;
    for part in parts {
        let arm = part.mobility == Mobility::Moves && matches!(part.party, Party::Link(_));
        if arm || part.party == Party::Body(index) {
            continue;
        }
        budget.spend(work::LOOK * part.solids.len() as u64);
        for solid in &part.solids {
            let near = first.map_or(most, |(_, near)| near);
            // the ground has no finite bounds
            let boxed = solid.shape.as_halfspace().is_none();
            if boxed && !solid.bounds.intersects_local_ray(ray, near) {
                continue;
            }
            budget.spend(work::CONTACT * (1 + solid.hulls()));
            let hit = solid
                .shape
                .cast_ray(&solid.world_from_shape, ray, near, true);
            if let Some(hit) = hit.filter(|hit| counts(*hit))
                && first.is_none_or(|(_, near)| hit < near)
            {
                first = Some((part.party, hit));
            }
        }
    }
    first
}

fn solids(owner: &str, shapes: &[Shape]) -> Result<Vec<Solid>, EngineError> {
    let solid = |shape| {
        let (shape, place) = shape_of(owner, shape, &Pose::identity())?;
        Ok(Solid::new(shape, place))
    };
    shapes.iter().map(solid).collect()
}

impl Solid {
    fn new(shape: SharedShape, owner_from_shape: EnginePose) -> Self {
        let p_centre_in_shape = shape.mass_properties(1.0).local_com;
        Self {
            bounds: shape.compute_aabb(&owner_from_shape),
            world_from_shape: owner_from_shape,
            owner_from_shape,
            p_centre_in_shape,
            shape,
        }
    }

    /// How much more its vertices cost, if it is a hull ([`super::work`]).
    fn hulls(&self) -> u64 {
        (vertices(self.shape.as_ref()) / work::HULL_VERTICES) as u64
    }

    /// How many of its triangles are near `other`, if it is a surface.
    fn triangles_near(&self, other: &Self) -> u64 {
        let Some(surface) = self.shape.as_trimesh() else {
            return 0;
        };
        let here_from_other = self.world_from_shape.inverse() * other.world_from_shape;
        let bounds = other.shape.compute_aabb(&here_from_other);
        surface.bvh().intersect_aabb(&bounds).count() as u64
    }

    /// How deep it is in `other`, and where; none where they are apart.
    fn depth_in(&self, other: &Self, budget: &mut WorkBudget) -> Option<(f64, Vector)> {
        // the engine takes a half space that comes second where it is not
        if other.shape.as_halfspace().is_some() && self.shape.as_halfspace().is_none() {
            return other.depth_in(self, budget);
        }
        budget.spend(work::LOOK);
        if !self.bounds.intersects(&other.bounds) {
            return None;
        }
        let triangles = self.triangles_near(other) + other.triangles_near(self);
        budget.spend(work::CONTACT * (1 + triangles) * (1 + self.hulls() + other.hulls()));
        let (mut here, there) = (self.world_from_shape, &other.world_from_shape);
        let shapes = (self.shape.as_ref(), other.shape.as_ref());
        let mut found = contact(&here, shapes.0, there, shapes.1, 0.0);
        if matches!(found, Ok(None))
            && intersection_test(&here, shapes.0, there, shapes.1).is_ok_and(|met| met.intersecting)
        {
            here.translation += Vector::new(ASIDE_M, 2.0 * ASIDE_M, 3.0 * ASIDE_M);
            found = contact(&here, shapes.0, there, shapes.1, 0.0);
        }
        let found = found.ok().flatten()?;
        Some((-found.dist, (found.point1 + found.point2) * 0.5))
    }
}

impl Part {
    fn place(&mut self, world_from_owner: &Pose) {
        let world_from_owner = engine_pose(world_from_owner);
        for solid in &mut self.solids {
            solid.world_from_shape = world_from_owner * solid.owner_from_shape;
            solid.bounds = solid.shape.compute_aabb(&solid.world_from_shape);
        }
    }
}

fn overlap(first: &Part, second: &Part, least_m: f64, budget: &mut WorkBudget) -> Option<Overlap> {
    if first.mobility == Mobility::Stands && second.mobility == Mobility::Stands {
        return None;
    }
    let mut deepest: Option<(f64, Vector)> = None;
    for a in &first.solids {
        for b in &second.solids {
            if budget.is_spent() {
                return None;
            }
            if let Some((depth_m, p)) = a.depth_in(b, budget)
                && depth_m > deepest.map_or(least_m, |(most, _)| most)
            {
                deepest = Some((depth_m, p));
            }
        }
    }
    let (depth_m, p) = deepest?;
    Some(Overlap {
        parties: match first.party.cmp(&second.party) {
            Ordering::Greater => [second.party, first.party],
            _ => [first.party, second.party],
        },
        depth_m,
        p_in_world: from_vector(p),
        pushes: first.mobility == Mobility::Moves || second.mobility == Mobility::Moves,
    })
}
