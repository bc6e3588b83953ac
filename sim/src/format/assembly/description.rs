//! What every source of a robot says in the end: links, joints, frames and loops with their numbers worked out and their places kept.
//!
//! A TOML file, a URDF, a DH table or a joint string becomes a [`Description`]; `assemble` makes the robot of it.

use nalgebra::Vector3;

use crate::model::air::Drag;
use crate::model::drive::Drive;
use crate::model::inertia::Inertia;
use crate::model::joint_friction::JointFriction;
use crate::model::robot::{Contact, JointKind, Limits, LoopKind, Shape};
use crate::model::unphysical::OnUnphysical;
use crate::spatial::Pose;
use crate::text::{Dimensions, Source, Spanned};

/// A robot in parts that nobody has fitted together yet.
#[derive(Debug, Clone)]
pub(crate) struct Description {
    pub(crate) source: Source,
    pub(crate) name: String,
    /// Where to point when the whole is wrong.
    pub(crate) at: std::ops::Range<usize>,
    pub(crate) dimensions: Dimensions,
    /// The first is the root.
    pub(crate) links: Vec<LinkPart>,
    pub(crate) joints: Vec<JointPart>,
    pub(crate) frames: Vec<FramePart>,
    pub(crate) loops: Vec<LoopPart>,
    pub(crate) warnings: Vec<String>,
    pub(crate) unphysical: UnphysicalWords,
}

/// What a format says of inertias that no body can have.
#[derive(Debug, Clone, Copy)]
pub(crate) struct UnphysicalWords {
    /// How to have tensors taken as they are, or balanced.
    pub(crate) remedy: &'static str,
    /// Whether a warning lists what was treated: only where the description itself does not say so.
    pub(crate) lists_treated: bool,
}

impl UnphysicalWords {
    /// Of a source that has none.
    pub(crate) const NONE: Self = Self {
        remedy: "",
        lists_treated: false,
    };
}

#[derive(Debug, Clone)]
pub(crate) struct LinkPart {
    pub(crate) name: Spanned<String>,
    pub(crate) shapes: Vec<Shape>,
    pub(crate) inertia: Inertia,
    /// Where the inertia stands, and what to do if no body can have it; `None` where it cannot be so.
    pub(crate) given_inertia: Option<GivenInertia>,
    pub(crate) contact: Option<Contact>,
    pub(crate) drag: Option<Drag>,
}

/// An inertia that was written out in full, not taken from shapes.
#[derive(Debug, Clone)]
pub(crate) struct GivenInertia {
    pub(crate) at: std::ops::Range<usize>,
    pub(crate) on_unphysical: OnUnphysical,
}

impl LinkPart {
    /// A link without shape or mass.
    pub(crate) fn bare(name: Spanned<String>) -> Self {
        Self {
            name,
            shapes: Vec::new(),
            inertia: Inertia::zero(),
            given_inertia: None,
            contact: None,
            drag: None,
        }
    }
}

#[derive(Debug, Clone)]
pub(crate) struct JointPart {
    pub(crate) name: Spanned<String>,
    pub(crate) kind: JointKind,
    pub(crate) parent: Spanned<String>,
    pub(crate) child: Spanned<String>,
    pub(crate) parent_from_child: Pose,
    /// Unit axis in the child's frame; zero for a fixed joint.
    pub(crate) axis: Vector3<f64>,
    pub(crate) damping: f64,
    pub(crate) dry_friction: JointFriction,
    pub(crate) armature: f64,
    pub(crate) drive: Option<Drive>,
    pub(crate) limits: Limits,
    pub(crate) mimic: Option<MimicPart>,
    pub(crate) passive: bool,
    pub(crate) guess: f64,
}

impl JointPart {
    /// A fixed joint between two links.
    pub(crate) fn fixed(
        name: Spanned<String>,
        parent: Spanned<String>,
        child: Spanned<String>,
        parent_from_child: Pose,
    ) -> Self {
        Self {
            name,
            kind: JointKind::Fixed,
            parent,
            child,
            parent_from_child,
            axis: Vector3::zeros(),
            damping: 0.0,
            dry_friction: JointFriction::default(),
            armature: 0.0,
            drive: None,
            limits: Limits::default(),
            mimic: None,
            passive: false,
            guess: 0.0,
        }
    }
}

#[derive(Debug, Clone)]
pub(crate) struct MimicPart {
    pub(crate) joint: Spanned<String>,
    pub(crate) multiplier: f64,
    pub(crate) offset: f64,
}

#[derive(Debug, Clone)]
pub(crate) struct FramePart {
    pub(crate) name: Spanned<String>,
    pub(crate) link: Spanned<String>,
    pub(crate) link_from_frame: Pose,
}

#[derive(Debug, Clone)]
pub(crate) struct LoopPart {
    pub(crate) at: std::ops::Range<usize>,
    pub(crate) kind: LoopKind,
    pub(crate) links: [Spanned<String>; 2],
    /// The axis of a hinge is the `z` of both frames.
    pub(crate) link_from_end: [Pose; 2],
}
