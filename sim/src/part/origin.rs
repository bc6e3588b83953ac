//! Where a frame lies in its parent: a position, and a rotation said in exactly one way.

use std::ops::Range;

use nalgebra::{Matrix3, Vector3};

use super::part_problem::{PartError, PartProblem};
use super::part_tables::{OriginTable, TripleAt};
use super::values::{Allowed, Values};
use crate::spatial::{Pose, pose, rotation_about_axis_deg, rotation_from_rpy_deg};
use crate::text::Spanned;

/// The help for a rotation that is given in none of these ways, or in more than one.
const WAYS: &str =
    "say a rotation in one way: `rpy_deg`, or `axis` with `angle_deg`, or `x_axis` with `y_axis`";

impl Values<'_> {
    pub(crate) fn origin(&self, origin: Option<&OriginTable>) -> Result<Pose, PartError> {
        let Some(table) = origin else {
            return Ok(Pose::identity());
        };
        let position_m = match &table.xyz_m {
            Some(xyz) => self.triple(xyz, "xyz_m")?,
            None => Vector3::zeros(),
        };
        Ok(pose(self.rotation(table)?, position_m))
    }

    fn rotation(&self, table: &OriginTable) -> Result<Matrix3<f64>, PartError> {
        let OriginTable {
            rpy_deg,
            axis,
            angle_deg,
            x_axis,
            y_axis,
            ..
        } = table;
        match (rpy_deg, (axis, angle_deg), (x_axis, y_axis)) {
            (None, (None, None), (None, None)) => Ok(Matrix3::identity()),
            (Some(rpy), (None, None), (None, None)) => Ok(rotation_from_rpy_deg(
                self.triple(rpy.get_ref(), "rpy_deg")?.into(),
            )),
            (None, (Some(axis), Some(angle)), (None, None)) => Ok(rotation_about_axis_deg(
                self.unit(axis, "axis")?,
                self.number(angle, "angle_deg", Allowed::Any)?,
            )),
            (None, (None, None), (Some(x), Some(y))) => self.rotation_of_axes(x, y),
            _ => {
                let triples = [axis, x_axis, y_axis].map(|axis| axis.as_ref().map(Spanned::span));
                let others = [
                    rpy_deg.as_ref().map(Spanned::span),
                    angle_deg.as_ref().map(Spanned::span),
                ];
                let given = triples.into_iter().chain(others).flatten();
                self.clash(
                    given.max_by_key(|at| at.start).unwrap_or(0..0),
                    &half_or_twice(table),
                    WAYS,
                )
            }
        }
    }

    /// From the axes `x` and `y` of the frame, said in its parent. What rounding leaves them off a right angle, `y` takes.
    fn rotation_of_axes(&self, x: &TripleAt, y: &TripleAt) -> Result<Matrix3<f64>, PartError> {
        let x_axis = self.unit(x, "x_axis")?;
        let y_axis = self.unit(y, "y_axis")?;
        if x_axis.dot(&y_axis).abs() > 1e-6 {
            return self.clash(
                y.span(),
                "`y_axis` is not perpendicular to `x_axis`",
                "choose y_axis so that its dot product with x_axis is 0",
            );
        }
        let z_axis = x_axis.cross(&y_axis).normalize();
        Ok(Matrix3::from_columns(&[
            x_axis,
            z_axis.cross(&x_axis),
            z_axis,
        ]))
    }

    /// Refuses a rotation.
    fn clash<T>(&self, at: Range<usize>, message: &str, help: &str) -> Result<T, PartError> {
        self.err(
            at,
            PartProblem::Origin {
                message: message.to_owned(),
                help: help.to_owned(),
            },
        )
    }
}

/// What is wrong with a rotation that has keys of several ways to say one, or a part of those of one way.
fn half_or_twice(table: &OriginTable) -> String {
    let ways = [
        (table.rpy_deg.is_some(), "`rpy_deg`"),
        (
            table.axis.is_some() || table.angle_deg.is_some(),
            "`axis` with `angle_deg`",
        ),
        (
            table.x_axis.is_some() || table.y_axis.is_some(),
            "`x_axis` with `y_axis`",
        ),
    ];
    let given: Vec<&str> = ways
        .into_iter()
        .filter_map(|(given, way)| given.then_some(way))
        .collect();
    if given.len() > 1 {
        let count = if given.len() == 2 { "two" } else { "three" };
        return format!("{count} rotations: keep {}", given.join(", or "));
    }
    let (there, missing) = if table.axis.is_some() {
        ("axis", "angle_deg")
    } else if table.angle_deg.is_some() {
        ("angle_deg", "axis")
    } else if table.x_axis.is_some() {
        ("x_axis", "y_axis")
    } else {
        ("y_axis", "x_axis")
    };
    format!("`{there}` without `{missing}`: a rotation needs both")
}
