//! The constraints of one step, made from contact points, joint limits and dry friction, and what their impulses do.

use nalgebra::{Matrix3, Vector3};

use super::arm::Arm;
use super::convert::{from_vector, vector};
use super::engine_settings::{
    DEEP_M, LANDS_M_S, NEAR_M, RECOVERS, SKIN_M, friction_of, restitution_of, rolling_of,
};
use super::free_body::FreeBody;
use super::pairs::{Carrier, Collider, Memory, Pairs};
use super::rows::PART;
use super::settle::{Constraints, JointFriction, Point, Rolling};
use super::world::{ArmStep, Driven, tangents};
use crate::dynamics::dry_friction::friction_by_entry;
use crate::kinematics::position_range::position_ranges;
use crate::model::robot::Robot;

/// What moves in a step.
pub(super) struct Movers<'a> {
    pub(super) robot: &'a Robot,
    /// The robot, if it takes part.
    pub(super) arm: Option<&'a mut Arm>,
    pub(super) free: &'a mut [FreeBody],
    pub(super) driven: &'a [Driven],
}

/// Where a point of the constraints comes from.
#[derive(Debug, Clone, Copy)]
struct Origin {
    pair: usize,
    manifold: usize,
    point: usize,
    tangents: [Vector3<f64>; 2],
    /// Where the impulse acts, world axes \[m\].
    p: Vector3<f64>,
}

/// What two surfaces have together.
#[derive(Debug, Clone, Copy)]
struct Surface {
    friction: f64,
    restitution: f64,
}

/// A contact point in the world at the start of a step.
struct Spot {
    carriers: [Carrier; 2],
    p: Vector3<f64>,
    normal: Vector3<f64>,
    /// How far the point is from where each carrier has it: both carriers are moved to the time of the kick \[m\].
    shifts: [Vector3<f64>; 2],
}

/// The constraints of one world, with the memory of the last step.
pub(super) struct Contacts {
    constraints: Constraints,
    origins: Vec<Origin>,
    /// The joint and the side (0 lower, 1 upper) of the points behind those of contact.
    limits: Vec<(usize, usize)>,
    /// Start of each dynamic body in the vector of velocities; none for a sleeping one.
    offsets: Vec<Option<usize>>,
    /// All velocities before the step, after it, and the displacement, without and with contact.
    before: Vec<f64>,
    free: Vec<f64>,
    velocities: Vec<f64>,
    free_displacement: Vec<f64>,
    displacement: Vec<f64>,
    /// The displacement with contact before places were corrected.
    kicked: Vec<f64>,
    /// What each dynamic body that is awake answers to impulses: its inverse mass and inertia tensor.
    inverse: Vec<(f64, Matrix3<f64>)>,
    /// Ranges of the joints, and the greatest impulses of their dry friction in a step.
    ranges: Vec<(f64, f64)>,
    frictions: Vec<[f64; 2]>,
    friction_memory: Vec<f64>,
    limit_memory: Vec<[f64; 2]>,
    /// The state of the robot after the step.
    arm_after: (Vec<f64>, Vec<f64>),
    dt_s: f64,
}

impl Contacts {
    pub(super) fn new(robot: &Robot, dt_s: f64) -> Self {
        let frictions = friction_by_entry(robot)
            .iter()
            .map(|friction| [friction.positive * dt_s, friction.negative * dt_s])
            .collect();
        let ranges = position_ranges(robot);
        Self {
            constraints: Constraints::default(),
            origins: Vec::new(),
            limits: Vec::new(),
            offsets: Vec::new(),
            before: Vec::new(),
            free: Vec::new(),
            velocities: Vec::new(),
            free_displacement: Vec::new(),
            displacement: Vec::new(),
            kicked: Vec::new(),
            inverse: Vec::new(),
            ranges: ranges
                .iter()
                .map(|range| (range.lower, range.upper))
                .collect(),
            friction_memory: vec![0.0; robot.n()],
            limit_memory: vec![[0.0; 2]; robot.n()],
            frictions,
            arm_after: (vec![0.0; robot.n()], vec![0.0; robot.n()]),
            dt_s,
        }
    }

    /// The robot's state after a step in which it took part.
    pub(super) fn read_arm(&self, q: &mut [f64], qd: &mut [f64]) {
        q.copy_from_slice(&self.arm_after.0);
        qd.copy_from_slice(&self.arm_after.1);
    }

    /// Visits of points since the last call.
    pub(super) fn take_visits(&mut self) -> u64 {
        self.constraints.take_visits()
    }

    /// Moves everything through a step; the points of `pairs` get its impulses.
    pub(super) fn solve(
        &mut self,
        movers: &mut Movers<'_>,
        arm: Option<&ArmStep<'_>>,
        colliders: &[Collider],
        pairs: &mut Pairs,
        travel_m: f64,
    ) {
        self.gather(movers, arm);
        let mut at_s = 0.5 * self.dt_s;
        self.build(movers, arm, colliders, pairs, travel_m, None);
        let landing = self.landing();
        if let Some(fraction) = landing {
            at_s = fraction * self.dt_s;
            if self.has_free_pair(colliders, pairs) {
                self.build(movers, arm, colliders, pairs, travel_m, Some(at_s));
            }
        }
        if self.constraints.points.is_empty() {
            self.fly(movers, arm);
            forget(pairs);
            return;
        }
        self.weigh(movers, arm, at_s);
        self.constraints.prepare();
        self.displacement.copy_from_slice(&self.free_displacement);
        self.constraints.find_touches(&mut self.displacement);
        if !self.constraints.any_touches() {
            self.fly(movers, arm);
            forget(pairs);
            return;
        }
        self.let_bounce(at_s);
        self.velocities.copy_from_slice(&self.free);
        self.constraints.settle(&mut self.velocities);
        let after_s = self.dt_s - at_s;
        for (i, moved) in self.displacement.iter_mut().enumerate() {
            *moved = self.free_displacement[i] + after_s * (self.velocities[i] - self.free[i]);
        }
        if landing.is_none() && arm.is_some_and(|arm| arm.gives) {
            // a joint that friction holds must not creep by what the smooth step knows better than a trapezoid
            for i in 0..arm.map_or(0, |arm| arm.q.len()) {
                self.displacement[i] = 0.5 * self.dt_s * (self.before[i] + self.velocities[i]);
            }
        }
        self.kicked.clone_from(&self.displacement);
        self.constraints
            .correct_places(&mut self.displacement, after_s);
        self.move_all(movers, arm);
        self.remember(pairs);
    }

    /// Lists all velocities.
    fn gather(&mut self, movers: &Movers<'_>, arm: Option<&ArmStep<'_>>) {
        for list in [
            &mut self.before,
            &mut self.free,
            &mut self.velocities,
            &mut self.free_displacement,
            &mut self.displacement,
        ] {
            list.clear();
        }
        self.offsets.clear();
        if let Some(arm) = arm {
            self.before.extend_from_slice(arm.qd);
            self.free.extend_from_slice(arm.next_qd);
            let moved = arm.next_q.iter().zip(arm.q).map(|(next, q)| next - q);
            self.free_displacement.extend(moved);
            let parts = self.before.len().next_multiple_of(PART);
            for list in [
                &mut self.before,
                &mut self.free,
                &mut self.free_displacement,
            ] {
                list.resize(parts, 0.0);
            }
        }
        for body in movers.free.iter() {
            self.offsets
                .push((!body.sleeps).then_some(self.before.len()));
            if !body.sleeps {
                let [before, after, moved] = body.free_motion(self.dt_s);
                self.before.extend(before);
                self.free.extend(after);
                self.free_displacement.extend(moved);
            }
        }
        self.velocities.resize(self.before.len(), 0.0);
        self.displacement.resize(self.before.len(), 0.0);
    }

    /// Makes the constraints of all points that may touch in this step; if bodies meet at `kick_s`, both see the point where it is then.
    fn build(
        &mut self,
        movers: &mut Movers<'_>,
        arm: Option<&ArmStep<'_>>,
        colliders: &[Collider],
        pairs: &Pairs,
        travel_m: f64,
        kick_s: Option<f64>,
    ) {
        self.constraints.clear();
        self.origins.clear();
        self.limits.clear();
        let near_m = 2.0 * travel_m + NEAR_M;
        let mut with_arm = false;
        for (pair_index, pair) in pairs.as_slice().iter().enumerate() {
            if !pair.is_fresh {
                continue;
            }
            let [first, second] = pair.colliders.map(|index| &colliders[index]);
            let carriers = [first.carrier, second.carrier];
            let surface = Surface {
                friction: friction_of(&first.surface, &second.surface),
                restitution: restitution_of(&first.surface, &second.surface),
            };
            for (manifold_index, manifold) in pair.manifolds.iter().enumerate() {
                let from = self.constraints.points.len();
                let place1 = match manifold.subshape_pos1() {
                    Some(place) => first.world_from_shape * *place,
                    None => first.world_from_shape,
                };
                let place2 = match manifold.subshape_pos2() {
                    Some(place) => second.world_from_shape * *place,
                    None => second.world_from_shape,
                };
                let normal = from_vector(place1.rotation * manifold.local_n1);
                let across = tangents(&normal);
                for (point_index, contact) in manifold.points.iter().enumerate() {
                    if contact.dist > near_m {
                        continue;
                    }
                    let p = (place1 * contact.local_p1 + place2 * contact.local_p2) * 0.5;
                    let mut spot = Spot {
                        carriers,
                        p: from_vector(p),
                        normal,
                        shifts: [Vector3::zeros(); 2],
                    };
                    if let ([Carrier::Free(a), Carrier::Free(b)], Some(kick_s)) = (carriers, kick_s)
                        && contact.data.impulse == 0.0
                    {
                        let apart = (movers.free[b].v - movers.free[a].v) * (0.5 * kick_s);
                        spot.shifts = [apart, -apart];
                    }
                    let memory = &contact.data;
                    let point = self.point(movers, &spot, &across, surface, contact.dist, memory);
                    self.constraints.points.push(point);
                    self.origins.push(Origin {
                        pair: pair_index,
                        manifold: manifold_index,
                        point: point_index,
                        tangents: across,
                        p: acts_at(movers, &spot),
                    });
                }
                if self.constraints.points.len() > from {
                    with_arm |= carriers.iter().any(|one| matches!(one, Carrier::Arm(_)));
                    let arm_m = rolling_of(&first.surface, &second.surface);
                    let rolling = (arm_m > 0.0).then(|| {
                        let rows = across.map(|axis| self.turning_row(movers, carriers, &axis));
                        Rolling::new(rows, arm_m)
                    });
                    self.constraints.add_patches(from, rolling);
                }
            }
        }
        if let Some(arm) = arm.filter(|arm| with_arm && arm.gives) {
            self.add_joints(movers, arm);
        }
    }

    fn point(
        &mut self,
        movers: &mut Movers<'_>,
        spot: &Spot,
        across: &[Vector3<f64>; 2],
        surface: Surface,
        gap_m: f64,
        memory: &Memory,
    ) -> Point {
        let normal = self.row(movers, spot, &spot.normal);
        let tangents =
            (surface.friction > 0.0).then(|| across.map(|axis| self.row(movers, spot, &axis)));
        let mut driven_m = 0.0;
        for (sign, carrier) in [-1.0, 1.0].into_iter().zip(spot.carriers) {
            if let Carrier::Driven(index) = carrier {
                let displacement = movers.driven[index].displacement(&spot.p);
                driven_m += sign * spot.normal.dot(&displacement);
            }
        }
        // what is deep inside comes out bit by bit
        let least_gap_m = if gap_m < -DEEP_M {
            gap_m * (1.0 - RECOVERS)
        } else {
            SKIN_M
        };
        let rubbed = from_vector(memory.rubbed);
        Point {
            normal,
            tangents,
            friction: surface.friction,
            restitution: surface.restitution,
            gap_m: gap_m + driven_m,
            least_gap_m,
            place: memory.place,
            impulse: memory.impulse,
            rubbed: if tangents.is_some() {
                across.map(|axis| axis.dot(&rubbed))
            } else {
                [0.0; 2]
            },
            ..Point::default()
        }
    }

    /// A row of the velocity of the second carrier's matter against the first's, along `direction`.
    fn row(&mut self, movers: &mut Movers<'_>, spot: &Spot, direction: &Vector3<f64>) -> usize {
        let mut driven = 0.0;
        for (sign, carrier) in [-1.0, 1.0].into_iter().zip(spot.carriers) {
            if let Carrier::Driven(index) = carrier {
                driven += sign * direction.dot(&movers.driven[index].velocity(&spot.p));
            }
        }
        let rows = &mut self.constraints.rows;
        let row = rows.start(driven);
        let sides = [-1.0, 1.0].into_iter().zip(spot.carriers).zip(spot.shifts);
        for ((sign, carrier), shift) in sides {
            let along = direction * sign;
            match carrier {
                Carrier::World | Carrier::Driven(_) => {}
                Carrier::Free(index) => {
                    if let Some(at) = self.offsets[index] {
                        let turn = (spot.p + shift - movers.free[index].x).cross(&along);
                        rows.add(at, &[along.x, along.y, along.z, turn.x, turn.y, turn.z]);
                    }
                }
                Carrier::Arm(index) => {
                    if let Some(arm) = &mut movers.arm {
                        let p = arm.carried(index, &spot.p);
                        rows.add(0, arm.along(movers.robot, index, &p, &along));
                    }
                }
            }
        }
        row
    }

    /// A row of the angular velocity of the second carrier against the first's, along `axis`.
    fn turning_row(
        &mut self,
        movers: &mut Movers<'_>,
        carriers: [Carrier; 2],
        axis: &Vector3<f64>,
    ) -> usize {
        let mut driven = 0.0;
        for (sign, carrier) in [-1.0, 1.0].into_iter().zip(carriers) {
            if let Carrier::Driven(index) = carrier {
                driven += sign * axis.dot(&movers.driven[index].twist.angular);
            }
        }
        let rows = &mut self.constraints.rows;
        let row = rows.start(driven);
        for (sign, carrier) in [-1.0, 1.0].into_iter().zip(carriers) {
            let about = axis * sign;
            match carrier {
                Carrier::World | Carrier::Driven(_) => {}
                Carrier::Free(index) => {
                    if let Some(at) = self.offsets[index] {
                        rows.add(at, &[0.0, 0.0, 0.0, about.x, about.y, about.z]);
                    }
                }
                Carrier::Arm(index) => {
                    if let Some(arm) = &mut movers.arm {
                        rows.add(0, arm.about(movers.robot, index, &about));
                    }
                }
            }
        }
        row
    }

    /// Adds the limits and the dry friction of the joints.
    fn add_joints(&mut self, movers: &mut Movers<'_>, arm: &ArmStep<'_>) {
        let Some(links) = &mut movers.arm else {
            return;
        };
        for i in 0..arm.q.len() {
            let (lower, upper) = self.ranges[i];
            for (side, (sign, limit)) in [(1.0, lower), (-1.0, upper)].into_iter().enumerate() {
                // a joint that starts outside is not thrown back in
                let gap = (sign * (arm.q[i] - limit)).max(0.0);
                let travel = (arm.next_q[i] - arm.q[i]).abs();
                if gap > 2.0 * travel + NEAR_M {
                    continue;
                }
                let normal = self.constraints.rows.start(0.0);
                self.constraints.rows.add(0, links.joint(i, sign));
                let from = self.constraints.points.len();
                self.limits.push((i, side));
                self.constraints.points.push(Point {
                    normal,
                    gap_m: gap,
                    impulse: self.limit_memory[i][side],
                    ..Point::default()
                });
                self.constraints.add_patches(from, None);
            }
            if self.frictions[i].iter().any(|most| *most > 0.0) {
                let row = self.constraints.rows.start(0.0);
                self.constraints.rows.add(0, links.joint(i, 1.0));
                self.constraints.frictions.push(JointFriction {
                    row,
                    joint: i,
                    most: self.frictions[i],
                    impulse: self.friction_memory[i],
                });
            }
        }
    }

    /// When the first surfaces meet that were apart and come together fast enough to count as an impact, as a fraction of the step.
    fn landing(&self) -> Option<f64> {
        let constraints = &self.constraints;
        let mut first: Option<f64> = None;
        for point in constraints.points.iter().take(self.origins.len()) {
            let Some(fraction) = self.lands_at(point) else {
                continue;
            };
            first = Some(first.map_or(fraction, |known| known.min(fraction)));
        }
        first
    }

    /// When the surfaces at `point` meet, as a fraction of the step; none if they touched before, or come together slowly.
    fn lands_at(&self, point: &Point) -> Option<f64> {
        let rows = &self.constraints.rows;
        let came = rows.speed(point.normal, &self.before);
        if came >= -LANDS_M_S {
            return None;
        }
        let moved = point.gap_m + rows.along(point.normal, &self.free_displacement);
        // the gap at the start: what is driven moved, too
        let closes = came * self.dt_s;
        let start = (moved - closes).max(0.0);
        (moved < 0.0).then(|| {
            let fraction = start / (start - moved);
            fraction.clamp(0.0, 1.0)
        })
    }

    /// Whether two dynamic bodies meet in this step that did not touch before.
    fn has_free_pair(&self, colliders: &[Collider], pairs: &Pairs) -> bool {
        let is_free = |index: &usize| matches!(colliders[*index].carrier, Carrier::Free(_));
        self.origins.iter().any(|origin| {
            let pair = &pairs.as_slice()[origin.pair];
            pair.colliders.iter().all(is_free)
        })
    }

    /// Computes how everything answers to impulses `at_s` after the start of the step.
    fn weigh(&mut self, movers: &mut Movers<'_>, arm: Option<&ArmStep<'_>>, at_s: f64) {
        let n = arm.map_or(0, |arm| arm.q.len());
        if let (Some(links), Some(arm)) = (&mut movers.arm, arm) {
            if arm.gives {
                links.weigh(movers.robot);
            } else {
                links.hold();
            }
        }
        self.inverse.clear();
        for body in movers.free.iter_mut().filter(|body| !body.sleeps) {
            self.inverse
                .push((1.0 / body.mass_kg, body.turn_to(at_s, self.dt_s)));
        }
        let (links, inverse) = (movers.arm.as_deref(), &self.inverse);
        self.constraints.rows.respond(|at, jacobian, response| {
            if at < n {
                response.fill(0.0);
                if let Some(links) = links {
                    links.respond(&jacobian[..n], &mut response[..n]);
                }
                return;
            }
            let (inverse_mass, tensor) = &inverse[(at - n.next_multiple_of(PART)) / PART];
            for i in 0..3 {
                response[i] = jacobian[i] * inverse_mass;
                response[3 + i] = (0..3).map(|j| tensor[(i, j)] * jacobian[3 + j]).sum();
            }
        });
    }

    /// Gives the points that land the speed and the gap at the end of the step that their restitution asks for.
    fn let_bounce(&mut self, at_s: f64) {
        let after_s = self.dt_s - at_s;
        for index in 0..self.origins.len() {
            let point = self.constraints.points[index];
            if !point.touches || point.restitution <= 0.0 {
                continue;
            }
            let rows = &self.constraints.rows;
            let [came, comes] =
                [&self.before, &self.free].map(|list| rows.speed(point.normal, list));
            if came >= -LANDS_M_S {
                continue;
            }
            let at = at_s / self.dt_s;
            let hits = came + at * (comes - came);
            // what gravity and the like change until the end of the step
            let leaves = -point.restitution * hits + (1.0 - at) * (comes - came);
            let point = &mut self.constraints.points[index];
            if leaves > 0.0 {
                point.bounce_m_s = leaves;
                point.least_gap_m = point.least_gap_m.max(0.0) + leaves * after_s;
            }
        }
    }

    /// Moves everything without contact.
    fn fly(&mut self, movers: &mut Movers<'_>, arm: Option<&ArmStep<'_>>) {
        for body in movers.free.iter_mut().filter(|body| !body.sleeps) {
            body.fly(self.dt_s);
        }
        if let Some(arm) = arm {
            self.arm_after.0.copy_from_slice(arm.next_q);
            self.arm_after.1.copy_from_slice(arm.next_qd);
        }
        self.friction_memory.fill(0.0);
        self.limit_memory.fill([0.0; 2]);
    }

    /// Moves everything with the impulses of contact.
    fn move_all(&mut self, movers: &mut Movers<'_>, arm: Option<&ArmStep<'_>>) {
        for (body, at) in movers.free.iter_mut().zip(&self.offsets) {
            let Some(at) = *at else {
                continue;
            };
            let six = |list: &[f64], base: &[f64]| -> [f64; 6] {
                std::array::from_fn(|i| list[at + i] - base[at + i])
            };
            let kick = six(&self.velocities, &self.free);
            let moved = six(&self.displacement, &self.kicked);
            if kick.iter().chain(&moved).all(|x| *x == 0.0) {
                body.fly(self.dt_s);
            } else {
                body.fly_kicked(&kick, &moved);
            }
        }
        if let Some(arm) = arm {
            for i in 0..arm.q.len() {
                let (q, qd) = (&mut self.arm_after.0[i], &mut self.arm_after.1[i]);
                // what contact left alone keeps its bits
                let change = self.displacement[i] - self.free_displacement[i];
                *q = if change == 0.0 {
                    arm.next_q[i]
                } else {
                    arm.q[i] + self.displacement[i]
                };
                *qd = self.velocities[i];
            }
        }
    }

    /// Writes the impulses to the points of `pairs`, for the next step and for whoever reads contacts.
    fn remember(&mut self, pairs: &mut Pairs) {
        forget(pairs);
        for (point, origin) in self.constraints.points.iter().zip(&self.origins) {
            let pair = &mut pairs.as_mut_slice()[origin.pair];
            let memory = &mut pair.manifolds[origin.manifold].points[origin.point].data;
            let rubbed =
                origin.tangents[0] * point.rubbed[0] + origin.tangents[1] * point.rubbed[1];
            *memory = Memory {
                place: point.place,
                impulse: point.impulse,
                rubbed: vector(&rubbed),
                p: vector(&origin.p),
            };
        }
        self.limit_memory.fill([0.0; 2]);
        let limits = &self.constraints.points[self.origins.len()..];
        for (point, (joint, side)) in limits.iter().zip(&self.limits) {
            self.limit_memory[*joint][*side] = point.impulse;
        }
        self.friction_memory.fill(0.0);
        for friction in &self.constraints.frictions {
            self.friction_memory[friction.joint] = friction.impulse;
        }
    }
}

/// Where the impulse of a point acts: on a link that moves, where its matter is in the middle of the step.
fn acts_at(movers: &Movers<'_>, spot: &Spot) -> Vector3<f64> {
    let link = spot.carriers.iter().find_map(|carrier| match carrier {
        Carrier::Arm(index) => Some(*index),
        _ => None,
    });
    match (&movers.arm, link) {
        (Some(arm), Some(index)) => arm.carried(index, &spot.p),
        _ => spot.p,
    }
}

/// Clears the impulses of all points of this step.
fn forget(pairs: &mut Pairs) {
    for pair in pairs.as_mut_slice().iter_mut().filter(|pair| pair.is_fresh) {
        for manifold in &mut pair.manifolds {
            for point in &mut manifold.points {
                point.data = Memory::default();
            }
        }
    }
}
