//! Denavit-Hartenberg tables, in the two conventions that share the name: each row becomes a joint, and a fixed offset where the
//! link's frame lies beyond the joint.
//!
//! Standard: `A_i = Rz(theta) Tz(d) Tx(a) Rx(alpha)`; joint `i` moves about the z of frame `i - 1`, and frame `i` is at the far end.
//! Modified (Craig): `T_i = Rx(alpha) Tx(a) Rz(theta) Tz(d)`; joint `i` moves about the z of frame `i` itself.
//!
//! Source: Siciliano et al., *Robotics* (2009), eq. 2.52; Craig, *Introduction to Robotics* (3rd ed.), eq. 3.6.

use std::ops::Range;

use nalgebra::{Matrix3, Vector3};

use super::drives::Driven;
use super::robot_reader::{Resolver, kind, undriven};
use super::robot_tables::{DhConvention, DhRowTable, DhTable};
use crate::format::assembly::description::{Description, FramePart, JointPart, LinkPart};
use crate::format::robot_problem::{RobotError, RobotProblem};
use crate::model::robot::{JointKind, Limits};
use crate::part::values::Allowed;
use crate::spatial::{Pose, pose, rotation_from_rpy_deg};
use crate::text::Spanned;

impl Resolver<'_> {
    /// Adds the table's links, joints and tool to `description`, whose links are those of `[[links]]`.
    pub(crate) fn dh(
        &self,
        table: &DhTable,
        description: &mut Description,
    ) -> Result<(), RobotError> {
        if table.rows.is_empty() {
            return self.refuse_dh(
                table.convention.span(),
                "the DH table has no rows".to_owned(),
                "add a [[dh.rows]] table for each joint",
            );
        }
        let names: Vec<Spanned<String>> = table
            .rows
            .iter()
            .enumerate()
            .map(|(i, row)| {
                let row = row.get_ref();
                row.link
                    .clone()
                    .unwrap_or_else(|| Spanned::new(row.joint.span(), format!("link{}", i + 1)))
            })
            .collect();
        let mut given = std::mem::take(&mut description.links);
        let is_row = |link: &LinkPart| names.iter().any(|n| n.get_ref() == link.name.get_ref());
        let base = match given.first() {
            Some(first) if !is_row(first) => given.remove(0),
            _ => LinkPart::bare(Spanned::new(table.convention.span(), "base".to_owned())),
        };
        let mut carrier = base.name.clone();
        description.links.push(base);
        let mut before = self.values.origin(table.base.as_ref())?;
        for (row, name) in table.rows.iter().zip(&names) {
            let at = given
                .iter()
                .position(|link| link.name.get_ref() == name.get_ref());
            let link = at.map_or_else(|| LinkPart::bare(name.clone()), |at| given.remove(at));
            self.row(table, row, &carrier, before, link, description)?;
            before = Pose::identity();
            carrier = name.clone();
        }
        description.links.append(&mut given);
        let named_tcp = self.file.tables.frames.iter();
        if !named_tcp.into_iter().any(|f| f.name.get_ref() == "tcp") {
            description.frames.push(FramePart {
                name: Spanned::new(table.convention.span(), "tcp".to_owned()),
                link: carrier,
                link_from_frame: self.values.origin(table.tool.as_ref())?,
            });
        } else if table.tool.is_some() {
            return self.refuse_dh(
                table.convention.span(),
                "the tool centre point is said twice: as `tool` and as a frame `tcp`".to_owned(),
                "drop one of them",
            );
        }
        Ok(())
    }

    fn refuse_dh<T>(&self, at: Range<usize>, message: String, help: &str) -> Result<T, RobotError> {
        let problem = RobotProblem::Own {
            code: "robot::dh",
            message,
            label: "this table".to_owned(),
            help: Some(help.to_owned()),
        };
        self.err(at, problem)
    }

    fn row(
        &self,
        table: &DhTable,
        row: &Spanned<DhRowTable>,
        parent: &Spanned<String>,
        before: Pose,
        link: LinkPart,
        description: &mut Description,
    ) -> Result<(), RobotError> {
        let row = row.get_ref();
        let joint = row.joint.get_ref();
        let number =
            |n: &Option<_>, what| self.values.number_or(n.as_ref(), what, Allowed::Any, 0.0);
        let along_x = pose(
            rotation_from_rpy_deg([number(&row.alpha_deg, "alpha_deg")?, 0.0, 0.0]),
            Vector3::new(number(&row.a_m, "a_m")?, 0.0, 0.0),
        );
        let along_z = pose(
            rotation_from_rpy_deg([0.0, 0.0, number(&row.theta_deg, "theta_deg")?]),
            Vector3::new(0.0, 0.0, number(&row.d_m, "d_m")?),
        );
        let direction =
            self.values
                .number_or(row.direction.as_ref(), "direction", Allowed::Any, 1.0)?;
        if ![1.0, -1.0].contains(&direction) {
            return self.refuse_dh(
                row.joint.span(),
                format!("the direction of joint `{joint}` is {direction}"),
                "write 1, or -1 where q counts against theta or d",
            );
        }
        let kind = kind(*row.kind.get_ref());
        // the joint's own frame, and the link's frame in it
        let (origin, beyond) = match table.convention.get_ref() {
            DhConvention::Standard => (before * along_z, along_x),
            DhConvention::Modified => (before * along_x * along_z, Pose::identity()),
        };
        let still = beyond.translation.vector == Vector3::zeros()
            && *beyond.rotation.matrix() == Matrix3::identity();
        let mut part = JointPart::fixed(
            row.joint.clone(),
            parent.clone(),
            link.name.clone(),
            origin * beyond,
        );
        if kind != JointKind::Fixed {
            part.kind = kind;
            part.axis = Vector3::z() * direction;
            self.resist(row, kind, &mut part)?;
            part.mimic = self.mimic(row.mimic.as_ref())?;
            part.limits = match &row.limit {
                Some(limit) => self.limits(joint, kind, limit)?,
                None => Limits::default(),
            };
            if !still {
                // the joint moves a carrier without mass; the link is fixed to it at the far end
                let carrier = Spanned::new(row.joint.span(), format!("{joint}_axis"));
                part.parent_from_child = origin;
                part.child = carrier.clone();
                description.links.push(LinkPart::bare(carrier.clone()));
                description.joints.push(part);
                part = JointPart::fixed(
                    Spanned::new(row.joint.span(), format!("{joint}_offset")),
                    carrier,
                    link.name.clone(),
                    beyond,
                );
            }
        }
        description.links.push(link);
        description.joints.push(part);
        Ok(())
    }

    /// What resists or drives the joint of a row.
    fn resist(
        &self,
        row: &DhRowTable,
        kind: JointKind,
        part: &mut JointPart,
    ) -> Result<(), RobotError> {
        part.damping = self.not_negative(&row.damping, "damping")?;
        part.dry_friction = self.friction(row.dry_friction.as_ref())?;
        part.armature = self.not_negative(&row.armature, "armature")?;
        let driven = Driven {
            joint: row.joint.get_ref(),
            armature: part.armature,
            undriven: undriven(kind, row.mimic.is_some(), false),
        };
        part.drive = self.drive(&driven, row.drive.as_ref())?;
        Ok(())
    }
}
