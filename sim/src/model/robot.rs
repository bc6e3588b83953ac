//! The immutable robot: what a description says, and the moving bodies the recursive algorithms walk over.

use nalgebra::{Matrix3, Vector3};

use super::air::Drag;
use super::drive::Drive;
use super::inertia::{Inertia, Solid};
use super::joint_friction::JointFriction;
use super::sensor::Sensor;
use super::unphysical::UnphysicalLinks;
use crate::joint_space::{JointAccelerations, JointEfforts, JointPositions, JointVelocities};
use crate::spatial::{Pose, Symmetric3};
use crate::text::Dimensions;

/// How a joint moves.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum JointKind {
    /// Revolute, between limits if it has them \[rad\].
    Revolute,
    /// Revolute without limits \[rad\].
    Continuous,
    /// Prismatic \[m\].
    Prismatic,
    /// Does not move and has no entry in `q`.
    Fixed,
}

impl JointKind {
    /// The word of the robot file.
    pub fn name(self) -> &'static str {
        match self {
            Self::Revolute => "revolute",
            Self::Continuous => "continuous",
            Self::Prismatic => "prismatic",
            Self::Fixed => "fixed",
        }
    }

    /// Whether the joint is revolute.
    pub fn turns(self) -> bool {
        matches!(self, Self::Revolute | Self::Continuous)
    }
}

/// Limits of a joint, in SI units of its kind; `None` means unlimited.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Limits {
    /// Lowest position \[rad or m\].
    pub lower: Option<f64>,
    /// Highest position \[rad or m\].
    pub upper: Option<f64>,
    /// Greatest speed \[rad/s or m/s\].
    pub speed: Option<f64>,
    /// Greatest effort \[N m or N\].
    pub effort: Option<f64>,
}

/// A joint of the description, including fixed ones.
#[derive(Debug, Clone, PartialEq)]
pub struct Joint {
    /// Its name.
    pub name: String,
    /// How it moves.
    pub kind: JointKind,
    /// Index of the parent link.
    pub parent: usize,
    /// Index of the child link.
    pub child: usize,
    /// Pose of the child's frame in the parent link at `q = 0`.
    pub parent_from_child: Pose,
    /// Unit axis in the child's frame; zero for a fixed joint.
    pub axis: Vector3<f64>,
    /// Viscous damping \[N m s/rad or N s/m\].
    pub damping: f64,
    /// Dry (Coulomb) friction \[N m or N\].
    pub dry_friction: JointFriction,
    /// Inertia of the drive as felt at the joint, if it is described without a `drive` \[kg m² or kg\].
    pub armature: f64,
    /// The drive, if it is described.
    pub drive: Option<Drive>,
    /// Limits.
    pub limits: Limits,
    /// The joint that it mimics, if it has no entry in `q` of its own.
    pub mimic: Option<Mimic>,
    /// Whether it has no drive: a joint in a loop that follows the others.
    pub passive: bool,
    /// Initial guess of its position when the loops are first closed \[rad or m\].
    pub guess: f64,
}

/// A joint that follows another: its position is `multiplier * q + offset` of the master's.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Mimic {
    /// Index of the master among all joints.
    pub joint: usize,
    /// Position of this joint per unit of the master's position.
    pub multiplier: f64,
    /// Position of this joint with the master at zero \[rad or m\].
    pub offset: f64,
}

/// The kinds of joints that close loops.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LoopKind {
    /// A hinge: one point and the direction of the axis coincide, 5 constraints.
    Revolute,
    /// One point coincides: 3 constraints.
    Spherical,
}

impl LoopKind {
    /// The word of the robot file.
    pub fn name(self) -> &'static str {
        match self {
            Self::Revolute => "revolute",
            Self::Spherical => "spherical",
        }
    }

    /// Number of its constraints, including redundant ones.
    pub fn constraint_count(self) -> usize {
        match self {
            Self::Revolute => 5,
            Self::Spherical => 3,
        }
    }
}

/// A joint that closes a loop: two frames that stay together. The axis of a hinge is the `z` of both.
#[derive(Debug, Clone, PartialEq)]
pub struct Loop {
    /// Its kind.
    pub kind: LoopKind,
    /// Indices of the two links.
    pub links: [usize; 2],
    /// Pose of its frame in each of the links.
    pub link_from_end: [Pose; 2],
    /// Attachment of its frame on each side.
    pub ends: [Attachment; 2],
}

/// A shape of a link.
#[derive(Debug, Clone, PartialEq)]
pub struct Shape {
    /// The solid, centred on its own frame.
    pub solid: Solid,
    /// Pose of that frame in the link.
    pub link_from_shape: Pose,
}

/// Surface properties of a link or body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Contact {
    /// Coefficient of friction, a ratio of forces.
    pub friction: f64,
    /// Coefficient of restitution, a ratio of speeds.
    pub restitution: f64,
    /// Coefficient of rolling resistance: the lever arm at which the normal force resists rolling \[m\].
    pub rolling_m: f64,
}

impl Contact {
    /// The coefficient of rolling resistance of what has only round shapes, as a part of their least radius: between a steel ball on
    /// steel (0.001) and a rubber wheel on concrete (0.01).
    pub const ROLLING_OF_RADIUS: f64 = 0.005;

    /// The coefficient of rolling resistance \[m\] of what has `shapes` and states none: 0 unless all of them are balls, cylinders or
    /// capsules.
    pub fn usual_rolling_m(shapes: &[Shape]) -> f64 {
        let radius = |shape: &Shape| match shape.solid {
            Solid::Cylinder { radius_m, .. }
            | Solid::Capsule { radius_m, .. }
            | Solid::Sphere { radius_m } => radius_m,
            Solid::Box { .. } | Solid::Mesh(_) => 0.0,
        };
        let least = shapes.iter().map(radius).reduce(f64::min);
        least.unwrap_or(0.0) * Self::ROLLING_OF_RADIUS
    }
}

/// A link of the description.
#[derive(Debug, Clone, PartialEq)]
pub struct Link {
    /// Its name.
    pub name: String,
    /// Its shapes.
    pub shapes: Vec<Shape>,
    /// Its mass properties, in its own frame.
    pub inertia: Inertia,
    /// Its surface, if described.
    pub contact: Option<Contact>,
    /// Its air drag, if any.
    pub drag: Option<Drag>,
    /// Where it is fixed.
    pub attachment: Attachment,
}

/// A frame fixed to a link; every link is also a frame with the link's name.
#[derive(Debug, Clone, PartialEq)]
pub struct Frame {
    /// Its name.
    pub name: String,
    /// Index of the link it is fixed to.
    pub link: usize,
    /// Where it is fixed.
    pub attachment: Attachment,
}

/// A pose fixed to a moving body, or to the world if `body` is `None`.
#[derive(Debug, Clone, PartialEq)]
pub struct Attachment {
    /// Index of the moving body.
    pub body: Option<usize>,
    /// Its pose on that body, or in the world.
    pub body_from_here: Pose,
}

/// The rigid body that one joint moves: its child link and all links attached to that by fixed joints.
///
/// The body's frame has its origin on the joint and its `z` along the joint's axis.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Body {
    /// The parent body, always of a lower index; `None` for the world.
    pub(crate) parent: Option<usize>,
    /// Whether the joint is revolute about z (else prismatic along z).
    pub(crate) turns: bool,
    /// Index of its joint, or of that joint's master, in `q`.
    pub(crate) q_index: usize,
    /// Position of its joint per entry of `q`: 1, or the multiplier of a mimic joint.
    pub(crate) gear: f64,
    /// Position of its joint with that entry at zero: 0, or the offset of a mimic joint.
    pub(crate) offset: f64,
    /// Axes of this body in the parent body's axes at `q = 0`.
    pub(crate) parent_from_body: Matrix3<f64>,
    /// Origin of this body in the parent body at `q = 0` \[m\].
    pub(crate) p_body_in_parent: Vector3<f64>,
    /// Mass \[kg\].
    pub(crate) mass_kg: f64,
    /// Mass times centre of mass \[kg m\].
    pub(crate) first_moment: Vector3<f64>,
    /// Rotational inertia about the body's origin \[kg m²\].
    pub(crate) inertia: Symmetric3,
    pub(crate) damping: f64,
    /// Mean of the dry friction in the two directions.
    pub(crate) dry_friction: f64,
    /// What dry friction gives towards lesser positions beyond its mean; 0 if both directions have the same.
    pub(crate) dry_skew: f64,
    /// Inertia of the drive, from wherever it is described.
    pub(crate) armature: f64,
}

impl Body {
    /// Dry friction of its joint.
    #[inline]
    pub(crate) fn joint_friction(&self) -> JointFriction {
        JointFriction {
            positive: self.dry_friction + self.dry_skew,
            negative: self.dry_friction - self.dry_skew,
        }
    }

    /// The position of its joint \[rad or m\].
    #[inline]
    pub(crate) fn position(&self, q: &[f64]) -> f64 {
        self.gear * q[self.q_index] + self.offset
    }

    /// The rate of its joint from `qd`, or the acceleration from `qdd`.
    #[inline]
    pub(crate) fn rate(&self, qd: &[f64]) -> f64 {
        self.gear * qd[self.q_index]
    }
}

/// A robot: a tree of links and joints, and the loops that close it; immutable once built.
#[derive(Debug, Clone, PartialEq)]
pub struct Robot {
    pub(crate) name: String,
    pub(crate) dimensions: Dimensions,
    pub(crate) links: Vec<Link>,
    pub(crate) joints: Vec<Joint>,
    pub(crate) moving: Vec<usize>,
    pub(crate) frames: Vec<Frame>,
    /// Index of the frame that commands and checks refer to.
    pub(crate) tcp: usize,
    pub(crate) bodies: Vec<Body>,
    pub(crate) world_inertia: Inertia,
    pub(crate) loops: Vec<Loop>,
    pub(crate) dependent: Vec<usize>,
    pub(crate) independent: Vec<usize>,
    pub(crate) home: Vec<f64>,
    pub(crate) warnings: Vec<String>,
    pub(crate) unphysical: Option<UnphysicalLinks>,
    pub(crate) sensors: Vec<Sensor>,
}

/// Values for a robot with another number of joints.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("expected {expected} numbers, one per joint that moves, got {found}")]
pub struct JointCountError {
    /// Joints that move.
    pub expected: usize,
    /// Values given.
    pub found: usize,
}

impl Robot {
    /// Its name.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Its dimensions, in file order.
    pub fn dimensions(&self) -> &Dimensions {
        &self.dimensions
    }

    /// Its links, in file order; the first is the root, fixed to the world.
    pub fn links(&self) -> &[Link] {
        &self.links
    }

    /// All its joints, in file order, fixed ones too.
    pub fn joints(&self) -> &[Joint] {
        &self.joints
    }

    /// The joints that have an entry in `q`, in its order.
    pub fn moving_joints(&self) -> impl ExactSizeIterator<Item = &Joint> {
        self.moving.iter().map(|&i| &self.joints[i])
    }

    /// The length of `q`: joints that move, less those that mimic another.
    pub fn n(&self) -> usize {
        self.moving.len()
    }

    /// Its frames: one for every link, then the named frames of the file.
    pub fn frames(&self) -> &[Frame] {
        &self.frames
    }

    /// The frame or link called `name`.
    pub fn frame(&self, name: &str) -> Option<&Frame> {
        self.frames.iter().find(|frame| frame.name == name)
    }

    /// The frame to which commands and checks refer: the one called `tcp`, else the last link.
    pub fn tcp(&self) -> &Frame {
        &self.frames[self.tcp]
    }

    /// This robot with the frame called `name` in place of its TCP; `None` where it has no such frame.
    pub fn with_tcp(mut self, name: &str) -> Option<Self> {
        self.tcp = self.frames.iter().position(|frame| frame.name == name)?;
        Some(self)
    }

    /// The loops that close its chains.
    pub fn loops(&self) -> &[Loop] {
        &self.loops
    }

    /// Entries of `q` of the independent joints, in order; all of them without loops.
    pub fn independent(&self) -> &[usize] {
        &self.independent
    }

    /// Entries of `q` of the dependent joints, which follow from the independent ones by loop closure, in order.
    pub fn dependent(&self) -> &[usize] {
        &self.dependent
    }

    /// Configuration with every loop closed and the independent joints at zero; all zeros without loops.
    pub fn home(&self) -> &[f64] {
        &self.home
    }

    /// Its sensors, in file order.
    pub fn sensors(&self) -> &[Sensor] {
        &self.sensors
    }

    /// Warnings: facts that a reader of the description should know although they are not errors.
    pub fn warnings(&self) -> &[String] {
        &self.warnings
    }

    /// The links whose mass properties no body can have, in a robot that is for kinematics only; `None` in any other.
    ///
    /// Links that no joint moves are not among them for their tensors, which move nothing, and neither are those whose tensor is
    /// taken as it is or was balanced ([`OnUnphysical`](super::unphysical::OnUnphysical)).
    pub fn unphysical(&self) -> Option<&UnphysicalLinks> {
        self.unphysical.as_ref()
    }

    /// Checks that mass, centre of mass and tensor of every link count, as dynamics needs them.
    ///
    /// # Errors
    /// [`Robot::unphysical`].
    pub fn check_inertias(&self) -> Result<(), &UnphysicalLinks> {
        self.unphysical.as_ref().map_or(Ok(()), Err)
    }

    /// Checks that the mass and the centre of mass of every link count, whatever its tensor.
    ///
    /// # Errors
    /// [`Robot::unphysical`], if a mass is negative.
    pub fn check_masses(&self) -> Result<(), &UnphysicalLinks> {
        let is_of_mass = |found: &&UnphysicalLinks| {
            let mut links = found.links().iter();
            links.any(|link| !link.why.is_of_tensor())
        };
        self.unphysical
            .as_ref()
            .filter(is_of_mass)
            .map_or(Ok(()), Err)
    }

    /// Whether every entry of `q` moves one body of a tree: no loop and no mimic joint.
    pub(crate) fn is_plain_tree(&self) -> bool {
        self.loops.is_empty() && self.bodies.len() == self.moving.len()
    }

    /// Mass of all links \[kg\].
    pub fn mass_kg(&self) -> f64 {
        self.links.iter().map(|link| link.inertia.mass_kg).sum()
    }

    pub(crate) fn bodies(&self) -> &[Body] {
        &self.bodies
    }

    /// All links that are fixed to the world, as one body in world axes.
    pub(crate) fn world_inertia(&self) -> &Inertia {
        &self.world_inertia
    }

    fn counted(&self, found: usize) -> Result<(), JointCountError> {
        let expected = self.n();
        if found == expected {
            Ok(())
        } else {
            Err(JointCountError { expected, found })
        }
    }

    /// Joint positions \[rad or m\] of this robot.
    ///
    /// # Errors
    /// Another count than [`Robot::n`].
    pub fn positions(&self, values: &[f64]) -> Result<JointPositions, JointCountError> {
        self.counted(values.len())?;
        Ok(JointPositions::new(values.iter().copied()))
    }

    /// Joint velocities \[rad/s or m/s\] of this robot.
    ///
    /// # Errors
    /// Another count than [`Robot::n`].
    pub fn velocities(&self, values: &[f64]) -> Result<JointVelocities, JointCountError> {
        self.counted(values.len())?;
        Ok(JointVelocities::new(values.iter().copied()))
    }

    /// Joint accelerations \[rad/s² or m/s²\] of this robot.
    ///
    /// # Errors
    /// Another count than [`Robot::n`].
    pub fn accelerations(&self, values: &[f64]) -> Result<JointAccelerations, JointCountError> {
        self.counted(values.len())?;
        Ok(JointAccelerations::new(values.iter().copied()))
    }

    /// Joint efforts \[N m or N\] of this robot.
    ///
    /// # Errors
    /// Another count than [`Robot::n`].
    pub fn efforts(&self, values: &[f64]) -> Result<JointEfforts, JointCountError> {
        self.counted(values.len())?;
        Ok(JointEfforts::new(values.iter().copied()))
    }
}

/// For each link, whether it is in the subtree of the joint `joint` (an index among all joints).
pub(crate) fn carried_by(robot: &Robot, joint: usize) -> Vec<bool> {
    let mut children = vec![Vec::new(); robot.links().len()];
    for joint in robot.joints() {
        children[joint.parent].push(joint.child);
    }
    let mut carried = vec![false; robot.links().len()];
    let mut ahead = vec![robot.joints()[joint].child];
    while let Some(link) = ahead.pop() {
        carried[link] = true;
        ahead.extend(&children[link]);
    }
    carried
}
