//! Branches of an answer of inverse kinematics: which are different, and which the joints can take.
//!
//! Two branches are the same if every joint that moves the TCP agrees. A joint that does not, such as a wrist that turns about the TCP
//! or a gripper, can stand anywhere and makes no branch.

use kinemark_sim::model::robot::Robot;
use kinemark_sim::text::number::{list, trimmed};

use crate::submission::answer;
use crate::task::jacobian::jacobian_in;
use crate::task::joint_units::JointUnits;
use crate::task::model::Rows;
use crate::task::task_joints::TaskJoints;
use crate::task::value::Value;

/// Longer lists are not accepted as a list of branches.
const MOST_LISTED: usize = 64;
/// Answers that move the TCP by less than a band are the same branch; two branches inside the workspace differ by far more \[rad\].
const NEAR_RAD: f64 = 0.02;
/// The same of prismatic joints \[m\].
const NEAR_M: f64 = 1e-3;
/// A limit may be passed by this \[rad or m\]: rounding, and no more.
const LIMIT_SLACK: f64 = 1e-6;
/// Configurations at which it is tried whether a joint moves the TCP.
const TRIED: usize = 6;
/// A joint moves the TCP if it does so by more than this \[m/rad or m/m\].
const LEAST_MOTION: f64 = 1e-9;

/// Branches as positions of all joints, of which at most `most` may differ by more than full turns, so that an answer cannot try every combination of signs.
///
/// # Errors
/// In words: a value of another shape, and too many branches.
pub(super) fn distinct_branches(
    value: &Value,
    robot: &Robot,
    joints: &TaskJoints,
    (most, is_turned): (usize, bool),
) -> Result<Vec<Vec<f64>>, String> {
    let answered = answer::branches(value, joints.count(), MOST_LISTED)?;
    let whole = |branch: &Vec<f64>| {
        joints.positions(robot, branch).ok_or_else(|| {
            format!(
                "the branch {}, at which the robot's loops cannot be closed",
                list(branch)
            )
        })
    };
    let branches: Vec<Vec<f64>> = answered.iter().map(whole).collect::<Result<_, _>>()?;
    let count = match is_turned {
        true => count_different(robot, &branches),
        false => count_distinct(robot, &branches),
    };
    match count {
        distinct if distinct > most => Err(format!(
            "{distinct} different branches where at most {most} exist: return the right ones only"
        )),
        _ => Ok(branches),
    }
}

/// The number of branches that differ by more than full turns and rounding, in joints that move the TCP.
pub fn count_distinct(robot: &Robot, branches: &[Vec<f64>]) -> usize {
    distinct(robot, branches, &joints_that_move_the_tcp(robot))
}

/// The number of branches that differ by more than full turns and rounding in any joint, for poses that all joints make together.
pub fn count_different(robot: &Robot, branches: &[Vec<f64>]) -> usize {
    distinct(robot, branches, &vec![true; robot.n()])
}

fn distinct(robot: &Robot, branches: &[Vec<f64>], counts: &[bool]) -> usize {
    let mut distinct: Vec<&Vec<f64>> = Vec::new();
    for branch in branches {
        let mut known = distinct.iter();
        if !known.any(|known| agree(robot, counts, branch, known)) {
            distinct.push(branch);
        }
    }
    distinct.len()
}

/// Whether two answers are the same branch: angles of joints that move the TCP equal up to full turns to 0.02 rad, positions of prismatic
/// ones equal to 0.001 m.
pub fn same_branch(robot: &Robot, a: &[f64], b: &[f64]) -> bool {
    // most answers of one branch agree in every joint, and that costs no kinematics
    agree(robot, &vec![true; robot.n()], a, b)
        || agree(robot, &joints_that_move_the_tcp(robot), a, b)
}

fn agree(robot: &Robot, moves: &[bool], a: &[f64], b: &[f64]) -> bool {
    let joints = robot.moving_joints().zip(moves).zip(a.iter().zip(b));
    let circle = 2.0 * std::f64::consts::PI;
    let mut joints = joints.filter(|((_, moves), _)| **moves);
    joints.all(|((joint, _), (a, b))| {
        if joint.kind.turns() {
            let gap = (a - b).abs() % circle;
            gap.min(circle - gap) <= NEAR_RAD
        } else {
            (a - b).abs() <= NEAR_M
        }
    })
}

/// For each joint that moves, whether it moves the TCP's position anywhere: tried at a few configurations that share no symmetry.
fn joints_that_move_the_tcp(robot: &Robot) -> Vec<bool> {
    let world = robot.frames()[0].name.as_str();
    let mut moves = vec![false; robot.n()];
    for tried in 0..TRIED {
        // of most arms the first configuration says it of every joint
        if moves.iter().all(|moves| *moves) {
            break;
        }
        // angles that are no rational part of a turn
        let joints = robot.home().iter().enumerate();
        let q: Vec<f64> = joints
            .map(|(i, home)| home + 0.37 * (tried as f64) * (1.0 + 0.61 * i as f64))
            .collect();
        let Some(jacobian) = jacobian_in(robot, world, &q, Rows::LINEAR) else {
            continue;
        };
        for (joint, moves) in moves.iter_mut().enumerate() {
            *moves |= jacobian.iter().any(|row| row[joint].abs() > LEAST_MOTION);
        }
    }
    moves
}

/// The first joint that a branch puts beyond its limits, in words. A revolute joint that can make a full turn gets to every angle, so
/// whole turns more or less make no difference to it.
pub fn beyond_limit(robot: &Robot, q: &[f64]) -> Option<String> {
    first_beyond(robot, q, true)
}

/// The first joint that stands beyond its limits, in words: where a run starts, whole turns count.
pub fn stands_beyond_limit(robot: &Robot, q: &[f64]) -> Option<String> {
    first_beyond(robot, q, false)
}

/// The first joint beyond its limits; with `whole_turns` angles of joints that turn fully count up to whole turns.
fn first_beyond(robot: &Robot, q: &[f64], whole_turns: bool) -> Option<String> {
    let joints = robot.moving_joints().zip(q).enumerate();
    let mut beyond = joints.filter(|(_, (joint, value))| {
        let (lower, upper) = (joint.limits.lower, joint.limits.upper);
        let range = upper.unwrap_or(f64::INFINITY) - lower.unwrap_or(f64::NEG_INFINITY);
        let turns_fully = whole_turns && joint.kind.turns() && range >= 2.0 * std::f64::consts::PI;
        let below = lower.is_some_and(|lower| **value < lower - LIMIT_SLACK);
        let above = upper.is_some_and(|upper| **value > upper + LIMIT_SLACK);
        !turns_fully && (below || above)
    });
    beyond.next().map(|(i, (joint, value))| {
        let unit = JointUnits::of(robot, i).position();
        let end = |limit: Option<f64>| limit.map_or("any".to_owned(), |limit| trimmed(limit, 4));
        format!(
            "joint `{}` would be at {} {unit}, beyond its limits of {} to {} {unit}",
            joint.name,
            trimmed(*value, 4),
            end(joint.limits.lower),
            end(joint.limits.upper),
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use kinemark_sim::format::RobotFile;
    use kinemark_sim::text::Source;

    /// A shoulder of so much to both sides, an elbow that turns fully, and a wrist that turns about the TCP.
    fn arm(shoulder_rad: f64) -> Robot {
        let text = format!(
            "format = 1\nname = \"arm\"\n\
             links = [{{ name = \"a\" }}, {{ name = \"b\" }}, {{ name = \"c\" }}, {{ name = \"d\" }}]\n\
             [[joints]]\nname = \"shoulder\"\ntype = \"revolute\"\nparent = \"a\"\nchild = \"b\"\naxis = [0.0, 1.0, 0.0]\n\
             limit = {{ lower = -{shoulder_rad}, upper = {shoulder_rad} }}\n\
             [[joints]]\nname = \"elbow\"\ntype = \"revolute\"\nparent = \"b\"\nchild = \"c\"\naxis = [0.0, 1.0, 0.0]\n\
             origin = {{ xyz_m = [0.0, 0.0, 1.0] }}\nlimit = {{ lower = -6.3, upper = 6.3 }}\n\
             [[joints]]\nname = \"wrist\"\ntype = \"revolute\"\nparent = \"c\"\nchild = \"d\"\naxis = [0.0, 0.0, 1.0]\n\
             origin = {{ xyz_m = [0.0, 0.0, 1.0] }}\nlimit = {{ lower = -3.0, upper = 3.0 }}\n\
             [[frames]]\nname = \"tcp\"\nlink = \"d\"\n"
        );
        let file = RobotFile::parse(Source::new("arm.toml", text)).expect("a robot file");
        file.build(&[]).expect("a robot")
    }

    #[test]
    fn a_wrist_that_turns_about_the_tcp_makes_no_branch() {
        let robot = arm(2.2);
        assert_eq!(joints_that_move_the_tcp(&robot), [true, true, false]);
        let same = [vec![0.3, 0.8, 0.0], vec![0.3, 0.8, 1.0]];
        assert_eq!(count_distinct(&robot, &same), 1);
        let other = [vec![0.3, 0.8, 0.0], vec![1.1, -0.8, 0.0]];
        assert_eq!(count_distinct(&robot, &other), 2);
        assert!(same_branch(
            &robot,
            &[0.3, 0.8, 0.0],
            &[0.3, 0.8 + std::f64::consts::TAU, 2.0]
        ));
    }

    #[test]
    fn a_joint_stays_within_its_limits_unless_it_turns_fully() {
        let robot = arm(2.2);
        assert_eq!(beyond_limit(&robot, &[2.2, 6.3, 3.0]), None);
        let words =
            beyond_limit(&robot, &[0.3 + 3.0 * std::f64::consts::TAU, 0.8, 0.0]).expect("beyond");
        assert_eq!(
            words,
            "joint `shoulder` would be at 19.1496 rad, beyond its limits of -2.2 to 2.2 rad"
        );
        // all angles are in reach of the elbow
        assert_eq!(beyond_limit(&robot, &[0.3, 7.0, 0.0]), None);
        assert!(beyond_limit(&robot, &[0.3, 0.8, -3.1]).is_some());
    }
}
