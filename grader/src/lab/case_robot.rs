//! The robot of a case: the lab's or one that is typed as a row of joints, with dimensions of its own, and with the frame that the task
//! takes for the TCP.

use std::borrow::Cow;

use kinemark_sim::format::{RobotDescription, RobotError};
use kinemark_sim::model::robot::Robot;
use kinemark_sim::text::Dimension;

use crate::task::model::About;

/// The description of a case's robot: the lab's, or the row of joints `row`; where the lab's robot is a row, too, with the dimensions
/// that both have.
///
/// # Errors
/// A row that is none.
pub(super) fn description<'l>(
    of_lab: &'l RobotDescription,
    row: Option<&str>,
) -> Result<Cow<'l, RobotDescription>, RobotError> {
    match row {
        None => Ok(Cow::Borrowed(of_lab)),
        Some(row) => {
            let description = RobotDescription::of_row(row)?;
            let has = |name: &str| description.dimensions().get(name).is_some();
            let of_both = of_lab
                .dimensions()
                .iter()
                .filter(|(name, _)| of_lab.is_row() && has(name));
            let of_both: Vec<(String, Dimension)> = of_both
                .map(|(name, value)| (name.to_owned(), value.clone()))
                .collect();
            Ok(Cow::Owned(description.with_dimensions(&of_both)?))
        }
    }
}

/// The robot of a case; `None` where it is the lab's. A frame that the robot does not have changes nothing: loading refuses it.
///
/// # Errors
/// Dimensions that the robot does not have, or that make none.
pub(super) fn built(
    of_lab: &RobotDescription,
    row: Option<&str>,
    dimensions: &[(String, Dimension)],
    about: &About,
) -> Result<Option<Robot>, RobotError> {
    if row.is_none() && about.frame.is_none() {
        return of_lab.build_changed(dimensions);
    }
    let robot = description(of_lab, row)?.build(dimensions)?;
    Ok(match &about.frame {
        Some(frame) if robot.frame(frame).is_some() => robot.with_tcp(frame),
        _ => Some(robot),
    })
}
