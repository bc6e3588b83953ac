//! Limits of a URDF joint, and what to make of those that say it cannot move.

use crate::format::robot_problem::{RobotError, RobotProblem};
use crate::format::xml::reader::{Node, Reader};
use crate::model::robot::{JointKind, Limits};
use crate::part::values::Allowed;

/// Reads `<limit>` of a joint that moves.
///
/// Speed and effort of zero mean none, as exporters write them. So do equal positions: the format reads an absent `lower` or `upper`
/// as zero, and a joint that cannot move would be `fixed`; a warning says so.
pub(super) fn limits(
    reader: &mut Reader<'_>,
    node: Node<'_>,
    owner: &str,
    kind: JointKind,
) -> Result<Limits, RobotError> {
    let Some(limit) = reader.child(node, "limit", owner) else {
        if kind != JointKind::Continuous {
            let message = format!(
                "{owner} is {} but has no `<limit>`: it is taken as unlimited",
                kind.name()
            );
            reader.warn(Reader::tag(node), &message);
        }
        return Ok(Limits::default());
    };
    // rates of the rate are for planners and change nothing here
    let known = [
        "lower",
        "upper",
        "effort",
        "velocity",
        "acceleration",
        "deceleration",
        "jerk",
    ];
    reader.check(limit, owner, &known, &[]);
    let read = |name, allowed| reader.number(limit, name, owner, allowed);
    let (lower, upper) = (read("lower", Allowed::Any)?, read("upper", Allowed::Any)?);
    let positive = |value: Option<f64>| value.filter(|value| *value > 0.0);
    let mut limits = Limits {
        lower: None,
        upper: None,
        speed: positive(read("velocity", Allowed::NotNegative)?),
        effort: positive(read("effort", Allowed::NotNegative)?),
    };
    if kind == JointKind::Continuous {
        if lower.is_some() || upper.is_some() {
            let message =
                format!("{owner} is continuous: its `lower` and `upper` limits are left out");
            reader.warn(Reader::tag(limit), &message);
        }
        return Ok(limits);
    }
    let (low, high) = (lower.unwrap_or(0.0), upper.unwrap_or(0.0));
    if low < high {
        (limits.lower, limits.upper) = (Some(low), Some(high));
    } else if low > high {
        let problem = RobotProblem::Limit {
            message: format!("{owner}: lower limit {low} is not below upper limit {high}"),
            help: "swap them; a limit that is not written counts as 0".to_owned(),
        };
        return reader.err(Reader::tag(limit), problem);
    } else {
        let message = format!(
            "{owner}: limits from {low} to {high} say that it cannot move; they are left out \
             (a joint that cannot move is `fixed`)"
        );
        reader.warn(Reader::tag(limit), &message);
    }
    Ok(limits)
}
