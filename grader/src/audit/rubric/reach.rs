//! What the robot is asked to reach: cases of inverse kinematics, goals, points of paths; and where on the way it is nearly singular.

use kinemark_sim::kinematics::branches::{BranchFinder, Reach};
use kinemark_sim::kinematics::forward_kinematics;
use kinemark_sim::kinematics::joint_samples::JointSamples;
use kinemark_sim::kinematics::manipulability::{LINEAR, Manipulability};
use kinemark_sim::model::robot::Robot;
use kinemark_sim::text::number::{list, metres, trimmed};
use nalgebra::{Matrix6xX, Vector3};

use super::{Doubt, Rubric};
use crate::attempt::branches::{count_different, count_distinct, stands_beyond_limit};
use crate::lab::{Lab, Staff, Task, TaskWork};
use crate::task::model::{Case, Function, Given, MotionTask};
use crate::task::pose::PoseForm;
use crate::task::pose_target::pose_target;
use crate::task::task_joints::TaskJoints;

/// A singular value below this share of the greatest that the robot has anywhere is nearly zero.
const NEARLY_SINGULAR: f64 = 0.02;
/// Configurations at which the greatest singular values are looked for.
const SAMPLES: usize = 256;
/// Places on a segment of a path that are tried.
const ON_A_SEGMENT: usize = 20;
/// Hidden cases of a draw that are tried: they are alike.
const OF_A_DRAW: usize = 10;
/// As many branches may be a continuum: then nobody can count them.
const CONTINUUM: usize = 16;

/// What is out of reach, beyond limits, or reached only where the robot is nearly singular.
pub(super) fn reach(rubric: &Rubric<'_>, doubts: &mut Vec<Doubt>) {
    let Rubric { lab, staff, .. } = *rubric;
    for task in &lab.tasks {
        match &task.work {
            TaskWork::Function(function, _) => {
                for case in &function.cases {
                    doubts.extend(angles_within_limits(lab, task, case));
                }
            }
            TaskWork::Motion(motion, _) => of_motion(lab, task, motion, doubts),
        }
    }
    of_hidden_runs(lab, staff, doubts);
    for (task, case) in hidden_cases(lab, staff) {
        if let Some(doubt) = angles_within_limits(lab, task, case)
            && !doubts.contains(&doubt)
        {
            doubts.push(doubt);
        }
    }
}

/// The same in hidden runs, those that are drawn and at the ends of what they are drawn from, for what is not doubted in the visible one.
fn of_hidden_runs(lab: &Lab, staff: &Staff, doubts: &mut Vec<Doubt>) {
    for task in &lab.tasks {
        let drawn = staff.runs(&task.name).into_iter();
        for run in drawn.chain(staff.runs_at_ends(&task.name)) {
            let mut tasks = run.lab.tasks.iter();
            let drawn = tasks.find(|drawn| drawn.name == task.name);
            let Some((drawn, TaskWork::Motion(motion, _))) = drawn.map(|task| (task, &task.work))
            else {
                continue;
            };
            let mut found = Vec::new();
            of_motion(&run.lab, drawn, motion, &mut found);
            for doubt in found {
                let of = format!("{} in class \"{}\"", doubt.of, run.class);
                let is_known = |known: &Doubt| known.of == doubt.of || known.of == of;
                if !doubts.iter().any(is_known) {
                    doubts.push(Doubt { of, ..doubt });
                }
            }
        }
    }
}

/// The first hidden cases of each draw, with their tasks.
fn hidden_cases<'a>(lab: &'a Lab, staff: &'a Staff) -> impl Iterator<Item = (&'a Task, &'a Case)> {
    staff.draws.iter().flat_map(move |draw| {
        let task = lab.tasks.iter().find(|task| task.name == draw.task);
        let cases = draw.cases.iter().take(OF_A_DRAW);
        cases.filter_map(move |case| Some((task?, case)))
    })
}

/// What a case is called: its name, or its class where it is hidden, so that all of a class are one.
fn case_name(task: &Task, case: &Case) -> String {
    let name = case.hidden_class.as_deref().unwrap_or(&case.name);
    format!("{}/{name}", task.name)
}

fn robot_of<'a>(lab: &'a Lab, task: &'a Task, case: &'a Case) -> &'a Robot {
    case.robot.as_deref().unwrap_or(&lab.of_task(task).robot)
}

/// Angles beyond so many turns are degrees.
const MOST_TURNS: f64 = 2.0;

/// A joint without limits that is turned by many turns.
fn many_turns(robot: &Robot, q: &[f64]) -> Option<String> {
    let mut joints = robot.moving_joints().zip(q);
    let (joint, angle) = joints.find(|(joint, angle)| {
        let turns = angle.abs() / (2.0 * std::f64::consts::PI);
        joint.kind.turns() && turns > MOST_TURNS
    })?;
    Some(format!(
        "joint `{}` would be at {angle} rad, more than {MOST_TURNS} turns: are these degrees?",
        joint.name
    ))
}

fn angles_within_limits(lab: &Lab, task: &Task, case: &Case) -> Option<Doubt> {
    let Given::Q(q) = &case.given else {
        return None;
    };
    let robot = robot_of(lab, task, case);
    // degrees would be many whole turns
    let beyond = stands_beyond_limit(robot, q).or_else(|| many_turns(robot, q))?;
    Some(Doubt {
        rule: "reach",
        of: case_name(task, case),
        what: format!("at {}, {beyond}", list(q)),
        help: match case.hidden_class {
            Some(_) => "narrow the ranges of the draw in hidden.toml to the limits of the joints",
            None => "take angles within the limits of the joints",
        }
        .to_owned(),
    })
}

fn of_motion(lab: &Lab, task: &Task, motion: &MotionTask, doubts: &mut Vec<Doubt>) {
    let lab = lab.of_task(task);
    let robot = &lab.robot;
    starts_within_limits(robot, task, motion, doubts);
    let Ok(mut finder) = BranchFinder::new(robot, &motion.start_q) else {
        return;
    };
    let greatest = greatest_singular_values(robot);
    let goals = motion.goals.iter().enumerate();
    let goals = goals.map(|(i, goal)| (format!("goal {}", i + 1), vec![goal.position_m]));
    let paths = motion.paths.iter().map(|path| {
        let on_segment = |ends: &[Vector3<f64>]| {
            let [from, to] = [ends[0], ends[1]];
            (0..=ON_A_SEGMENT).map(move |k| from + (to - from) * (k as f64 / ON_A_SEGMENT as f64))
        };
        let points = path.points_m.windows(2).flat_map(on_segment).collect();
        (path.name.clone(), points)
    });
    for (name, points) in goals.chain(paths) {
        let of = format!("{}/{name}", task.name);
        let mut least: Option<(f64, Vector3<f64>)> = None;
        for point in points {
            let Some(p_in_world) = in_world(lab, robot, &motion.start_q, &point) else {
                continue;
            };
            let place = list(point.as_slice());
            match finder.reach(&p_in_world) {
                Ok(Reach::Not { residual_m, .. }) => {
                    doubts.push(Doubt {
                        rule: "reach",
                        of: of.clone(),
                        what: format!(
                            "{place} is out of reach by {}, within the limits of the joints",
                            metres(residual_m)
                        ),
                        help: "move it to where the robot can be: the operation `workspace` of `kinemark robot eval` says where".to_owned(),
                    });
                    least = None;
                    break;
                }
                Ok(Reach::In(branches)) => {
                    // the best branch, which a solution may take
                    let best = branches.iter().map(|q| least_share(robot, q, &greatest));
                    let best = best.fold(0.0, f64::max);
                    if least.is_none_or(|(share, _)| best < share) {
                        least = Some((best, point));
                    }
                }
                Err(_) => {}
            }
        }
        if let Some((share, point)) = least.filter(|(share, _)| *share < NEARLY_SINGULAR) {
            doubts.push(Doubt {
                rule: "reach",
                of,
                what: format!(
                    "at {} every branch is nearly singular: the least singular value of the Jacobian is {} % of the greatest that the \
                     robot has anywhere",
                    list(point.as_slice()),
                    trimmed(100.0 * share, 2),
                ),
                help: "move it away from the boundary of the workspace, unless that is what the task is about".to_owned(),
            });
        }
    }
}

/// Where a run starts, and where those of disturbances do.
fn starts_within_limits(robot: &Robot, task: &Task, motion: &MotionTask, doubts: &mut Vec<Doubt>) {
    let mut starts = vec![(format!("{}/start", task.name), &motion.start_q)];
    if let TaskWork::Motion(_, checks) = &task.work {
        for check in checks {
            for level in check.kind.sweep().map_or(&[][..], |sweep| &sweep.levels) {
                let of = format!("{}/{}/{}", task.name, check.name, level.name);
                starts.extend(level.start.as_ref().map(|start| (of, &start.q)));
            }
        }
    }
    for (of, q) in starts {
        if let Some(beyond) = stands_beyond_limit(robot, q) {
            doubts.push(Doubt {
                rule: "reach",
                of,
                what: format!("the run starts at {}: {beyond}", list(q)),
                help: "let it start within the limits of the joints".to_owned(),
            });
        }
    }
}

fn singular_values(robot: &Robot, q: &[f64]) -> Vec<f64> {
    let Ok(positions) = robot.positions(q) else {
        return Vec::new();
    };
    let poses = forward_kinematics(robot, &positions);
    let mut jacobian = Matrix6xX::zeros(robot.n());
    kinemark_sim::kinematics::jacobian::fill(robot, &poses, robot.tcp(), &mut jacobian);
    Manipulability::of(&jacobian, LINEAR)
        .singular_values()
        .to_vec()
}

/// Each singular value of the linear Jacobian where it is greatest, over the joint ranges: how many are not zero is the number of
/// directions in which the robot can move its TCP at all.
fn greatest_singular_values(robot: &Robot) -> Vec<f64> {
    let mut samples = JointSamples::new(robot);
    let mut q = vec![0.0; robot.n()];
    let mut greatest: Vec<f64> = Vec::new();
    for _ in 0..SAMPLES {
        samples.next_into(&mut q);
        let values = singular_values(robot, &q);
        greatest.resize(values.len(), 0.0);
        for (most, value) in greatest.iter_mut().zip(values) {
            *most = most.max(value);
        }
    }
    greatest
}

/// The least singular value at `q` as a share of the greatest that it has anywhere, among those that are not always zero.
fn least_share(robot: &Robot, q: &[f64], greatest: &[f64]) -> f64 {
    let scale = greatest.first().copied().unwrap_or(0.0);
    let values = singular_values(robot, q);
    let pairs = values.iter().zip(greatest);
    let shares = pairs.filter(|(_, most)| **most > 1e-6 * scale);
    shares.map(|(value, most)| value / most).fold(1.0, f64::min)
}

/// Cases of inverse kinematics whose number of branches is not what the engine finds.
pub(super) fn branches(rubric: &Rubric<'_>, doubts: &mut Vec<Doubt>) {
    let Rubric { lab, staff, .. } = *rubric;
    let mut known: Vec<String> = Vec::new();
    let visible = lab.tasks.iter().flat_map(|task| {
        let cases = match &task.work {
            TaskWork::Function(function, _) => &function.cases[..],
            TaskWork::Motion(..) => &[],
        };
        cases.iter().map(move |case| (task, case))
    });
    for (task, case) in visible.chain(hidden_cases(lab, staff)) {
        let of = case_name(task, case);
        if let Some(what) = wrong_count(lab, task, case)
            && !known.contains(&of)
        {
            known.push(of.clone());
            doubts.push(Doubt {
                rule: "branches",
                of,
                what,
                help: match case.hidden_class {
                    Some(_) => "change `branches` or the ranges of the draw in hidden.toml",
                    None => "change `branches`, or the position",
                }
                .to_owned(),
            });
        }
    }
}

/// Why the number of branches of a case is not what the engine finds. It looks for positions within the limits of joints, so tasks without
/// limits are not counted.
fn wrong_count(lab: &Lab, task: &Task, case: &Case) -> Option<String> {
    let TaskWork::Function(work, _) = &task.work else {
        return None;
    };
    let (
        Function::InverseKinematics(form),
        Given::Position {
            position_m,
            branches,
            pose,
        },
        true,
    ) = (&work.function, &case.given, work.about.within_limits)
    else {
        return None;
    };
    let robot = robot_of(lab, task, case);
    let home = robot.home().to_vec();
    let target = pose_target(robot, &lab.of_task(task).frame, *form, pose)?;
    let joints = TaskJoints::of(robot, &work.about.ignored);
    let chain = (!work.about.ignored.is_empty()).then_some(joints.entries());
    let mut finder = BranchFinder::of_kind(robot, &home, target, chain).ok()?;
    let stated = *branches as usize;
    let place = match form {
        PoseForm::Full => format!("the pose at {}", list(position_m)),
        _ => list(pose),
    };
    match finder.reach_target(target).ok()? {
        Reach::Not { .. } if stated == 0 => None,
        Reach::Not {
            residual_m,
            residual_rad,
        } => {
            let turned = match form.is_turned() {
                true => format!(" and {}°", trimmed(residual_rad.to_degrees(), 2)),
                false => String::new(),
            };
            let by = metres(residual_m);
            Some(format!(
                "{place} is out of reach by {by}{turned}, within the limits of the joints, and {stated} branches are stated"
            ))
        }
        Reach::In(found) => {
            let count = match form.is_turned() {
                true => count_different(robot, &found),
                false => count_distinct(robot, &found),
            };
            // some of a continuum, or more than a search may find
            if count >= CONTINUUM || count == stated || (stated > count && count > 2) {
                return None;
            }
            let found = match count {
                1 => "one branch reaches".to_owned(),
                count => format!("{count} branches reach"),
            };
            Some(format!(
                "{found} {place} within the limits of the joints, and {stated} are stated"
            ))
        }
    }
}

/// A place of the lab's frame in the world.
fn in_world(lab: &Lab, robot: &Robot, q: &[f64], p_in_lab: &Vector3<f64>) -> Option<Vector3<f64>> {
    let q = robot.positions(q).ok()?;
    let poses = forward_kinematics(robot, &q);
    let world_from_lab = poses.world_from(robot.frame(&lab.frame)?);
    Some(world_from_lab.transform_point(&(*p_in_lab).into()).coords)
}
