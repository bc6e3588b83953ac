//! What every source of a robot says in the end: links, joints, frames and loops with their numbers worked out and their places kept.
//!
//! A TOML file, a URDF, a DH table or a configuration string becomes a [`Description`]; `assemble` makes the robot of it.

use nalgebra::Vector3;
use toml::Spanned;

use super::file::Dimensions;
use super::inertia::Inertia;
use super::model::{Contact, JointKind, Limits, LoopKind, Shape};
use crate::air::Drag;
use crate::source::Source;
use crate::spatial::Pose;

/// A robot in parts that nobody has fitted together yet.
#[derive(Debug, Clone)]
pub(super) struct Description {
    pub(super) source: Source,
    pub(super) name: String,
    /// Where to point when the whole is wrong.
    pub(super) at: std::ops::Range<usize>,
    pub(super) dimensions: Dimensions,
    /// The first is the root.
    pub(super) links: Vec<LinkPart>,
    pub(super) joints: Vec<JointPart>,
    pub(super) frames: Vec<FramePart>,
    pub(super) loops: Vec<LoopPart>,
    pub(super) warnings: Vec<String>,
}

#[derive(Debug, Clone)]
pub(super) struct LinkPart {
    pub(super) name: Spanned<String>,
    pub(super) shapes: Vec<Shape>,
    pub(super) inertia: Inertia,
    pub(super) contact: Option<Contact>,
    pub(super) drag: Option<Drag>,
}

impl LinkPart {
    /// A link without shape or mass.
    pub(super) fn bare(name: Spanned<String>) -> Self {
        Self {
            name,
            shapes: Vec::new(),
            inertia: Inertia::zero(),
            contact: None,
            drag: None,
        }
    }
}

#[derive(Debug, Clone)]
pub(super) struct JointPart {
    pub(super) name: Spanned<String>,
    pub(super) kind: JointKind,
    pub(super) parent: Spanned<String>,
    pub(super) child: Spanned<String>,
    pub(super) parent_from_child: Pose,
    /// Unit axis in the child's frame; zero for a fixed joint.
    pub(super) axis: Vector3<f64>,
    pub(super) damping: f64,
    pub(super) dry_friction: f64,
    pub(super) armature: f64,
    pub(super) limits: Limits,
    pub(super) mimic: Option<MimicPart>,
    pub(super) passive: bool,
    pub(super) guess: f64,
}

impl JointPart {
    /// A fixed joint between two links.
    pub(super) fn fixed(
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
            dry_friction: 0.0,
            armature: 0.0,
            limits: Limits::default(),
            mimic: None,
            passive: false,
            guess: 0.0,
        }
    }
}

#[derive(Debug, Clone)]
pub(super) struct MimicPart {
    pub(super) joint: Spanned<String>,
    pub(super) multiplier: f64,
    pub(super) offset: f64,
}

#[derive(Debug, Clone)]
pub(super) struct FramePart {
    pub(super) name: Spanned<String>,
    pub(super) link: Spanned<String>,
    pub(super) link_from_frame: Pose,
}

#[derive(Debug, Clone)]
pub(super) struct LoopPart {
    pub(super) at: std::ops::Range<usize>,
    pub(super) kind: LoopKind,
    pub(super) links: [Spanned<String>; 2],
    /// The axis of a hinge is the `z` of both frames.
    pub(super) link_from_end: [Pose; 2],
}
