//! Where a frame lies in its parent: a position, and a rotation said in exactly one way.

use std::ops::Range;

use nalgebra::{Matrix3, Vector3};
use toml::Spanned;

use super::part_problem::{PartError, PartProblem};
use super::part_tables::{OriginTable, TripleAt};
use super::values::{Allowed, Values};
use crate::spatial::{Pose, pose, rotation_about_axis_deg, rotation_from_rpy_deg};

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
        match table {
            OriginTable {
                rpy_deg: Some(rpy),
                axis: None,
                angle_deg: None,
                x_axis: None,
                y_axis: None,
                ..
            } => Ok(rotation_from_rpy_deg(
                self.triple(rpy.get_ref(), "rpy_deg")?.into(),
            )),
            OriginTable {
                rpy_deg: None,
                axis: Some(axis),
                angle_deg: Some(angle),
                x_axis: None,
                y_axis: None,
                ..
            } => Ok(rotation_about_axis_deg(
                self.unit(axis, "axis")?,
                self.number(angle, "angle_deg", Allowed::Any)?,
            )),
            OriginTable {
                rpy_deg: None,
                axis: None,
                angle_deg: None,
                x_axis: Some(x),
                y_axis: Some(y),
                ..
            } => self.rotation_of_axes(x, y),
            OriginTable {
                rpy_deg: None,
                axis: None,
                angle_deg: None,
                x_axis: None,
                y_axis: None,
                ..
            } => Ok(Matrix3::identity()),
            OriginTable {
                rpy_deg,
                axis,
                angle_deg,
                x_axis,
                y_axis,
                ..
            } => {
                let at = [
                    rpy_deg.as_ref().map(Spanned::span),
                    axis.as_ref().map(Spanned::span),
                    angle_deg.as_ref().map(Spanned::span),
                    x_axis.as_ref().map(Spanned::span),
                    y_axis.as_ref().map(Spanned::span),
                ];
                let at = at.into_iter().flatten().max_by_key(|at| at.start);
                self.clash(
                    at.unwrap_or(0..0),
                    "this rotation is half said, or said twice",
                )
            }
        }
    }

    /// From the axes `x` and `y` of the frame, said in its parent. What rounding leaves them off a right angle, `y` takes.
    fn rotation_of_axes(&self, x: &TripleAt, y: &TripleAt) -> Result<Matrix3<f64>, PartError> {
        let x_axis = self.unit(x, "x_axis")?;
        let y_axis = self.unit(y, "y_axis")?;
        if x_axis.dot(&y_axis).abs() > 1e-6 {
            return self.clash(y.span(), "`y_axis` is not perpendicular to `x_axis`");
        }
        let z_axis = x_axis.cross(&y_axis).normalize();
        Ok(Matrix3::from_columns(&[
            x_axis,
            z_axis.cross(&x_axis),
            z_axis,
        ]))
    }

    /// Refuses a rotation; every such message helps with all the ways to say one.
    fn clash<T>(&self, at: Range<usize>, message: &str) -> Result<T, PartError> {
        let help = "say a rotation in one way: `rpy_deg`, or `axis` with `angle_deg`, or `x_axis` with `y_axis`";
        self.err(
            at,
            PartProblem::Origin {
                message: message.to_owned(),
                help: help.to_owned(),
            },
        )
    }
}
