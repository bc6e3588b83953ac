//! Several tips in order: groups of goals, each with its own joints and method, that may share joints.
//!
//! Goals of one group are solved together. Groups are solved one after another, each from the solution of the one before; a later one
//! may undo the solution of an earlier one if they share joints. [`solve_by_priority`] prevents that: later groups move only in the
//! null space of those before.

use super::adaptive::Rules;
use super::ik_step::StepScratch;
use super::null_space::{SecondaryTask, follow};
use super::query::check_goals;
use super::system::System;
use super::{Goal, IkAnswer, IkError, IkSettings, IkSolver};
use crate::kinematics::chain::Chain;
use crate::kinematics::position_range::position_ranges;
use crate::model::robot::Robot;

/// Goals that are solved together.
#[derive(Debug, Clone, PartialEq)]
pub struct Group<'f> {
    /// The goals.
    pub goals: Vec<Goal<'f>>,
    /// How, and with which joints.
    pub settings: IkSettings,
}

/// The configuration found for several groups, and the residual of each.
#[derive(Debug, Clone, PartialEq)]
pub struct GroupsAnswer {
    /// The joint positions, shape `(n)` \[rad or m\].
    pub q: Vec<f64>,
    /// Whether every group is within its tolerance at `q`.
    pub reached: bool,
    /// The answer of each group, judged at the final `q`.
    pub groups: Vec<IkAnswer>,
}

/// Solves `groups` one after another from `q0`, shape `(n)`.
///
/// # Errors
/// [`IkError`] for an invalid query.
pub fn solve_in_turn(
    robot: &Robot,
    groups: &[Group<'_>],
    q0: &[f64],
) -> Result<GroupsAnswer, IkError> {
    let mut solvers = Vec::with_capacity(groups.len());
    for group in groups {
        solvers.push(IkSolver::new(robot, &group.goals, group.settings.clone())?);
    }
    let mut q = q0.to_vec();
    let mut answers = Vec::with_capacity(groups.len());
    for solver in &mut solvers {
        let answer = solver.solve(&q)?;
        q.clone_from(&answer.q);
        answers.push(answer);
    }
    // a later group may have moved the frames of an earlier one
    for (answer, solver) in answers.iter_mut().zip(&mut solvers) {
        let residual = solver.system.place(&q);
        answer.reached = solver.reached(&residual);
        answer.residual_m = residual.distance_m;
        answer.residual_rad = residual.angle_rad;
        answer.q.clone_from(&q);
    }
    Ok(GroupsAnswer {
        reached: answers.iter().all(|answer| answer.reached),
        q,
        groups: answers,
    })
}

/// Solves `levels` of goals by priority from `q0`, shape `(n)`: the first as if it were alone, each further one as well as possible
/// while all before stay within tolerance. All levels move the same joints: those of `settings`, or all that move a frame of a goal.
///
/// A level that cannot be reached comes as near as possible and does not constrain those after it. If the first is not reached, the
/// others are not improved.
///
/// # Errors
/// [`IkError`] for an invalid query.
pub fn solve_by_priority(
    robot: &Robot,
    levels: &[Vec<Goal<'_>>],
    settings: &IkSettings,
    q0: &[f64],
) -> Result<GroupsAnswer, IkError> {
    let Some((first, later)) = levels.split_first() else {
        return Err(IkError::NoGoal);
    };
    for level in later {
        check_goals(level)?;
    }
    let joints = match &settings.chain {
        Some(chain) => chain.clone(),
        None => joints_of(robot, levels),
    };
    let alone = IkSettings {
        chain: Some(joints.clone()),
        posture: None,
        ..settings.clone()
    };
    // all at once first: if that converges the result meets all levels, and if not it is a good start for the first
    let all: Vec<Goal<'_>> = levels.iter().flatten().copied().collect();
    let together = IkSolver::new(robot, &all, alone.clone())?.solve(q0)?;
    let answer = IkSolver::new(robot, first, alone)?.solve(&together.q)?;
    let ranges = position_ranges(robot);
    let rules: Rules<'_> = settings.rules(&ranges, false);
    let stacked = |goals: &[Goal<'_>]| {
        let system = System::new(robot, goals, Some(&joints), settings.error_clamp, true);
        let scratch = StepScratch::new(system.rows(), system.unknowns.len());
        (system, scratch)
    };
    let mut q = answer.q.clone();
    let mut held = first.clone();
    let mut iterations = vec![together.iterations + answer.iterations];
    for level in later {
        let (mut system, mut scratch) = stacked(&held);
        let (mut lower, mut lower_scratch) = stacked(level);
        let secondary = SecondaryTask::System(&mut lower, &mut lower_scratch);
        iterations.push(follow(&mut system, &mut scratch, &rules, secondary, &mut q));
        let residual = lower.place(&q);
        if residual.within(settings.tolerance_m, settings.tolerance_rad) {
            held.extend(level);
        }
    }
    if let Some(posture) = &settings.posture {
        let (mut system, mut scratch) = stacked(&held);
        follow(
            &mut system,
            &mut scratch,
            &rules,
            SecondaryTask::Posture(posture),
            &mut q,
        );
    }
    let groups: Vec<IkAnswer> = levels
        .iter()
        .zip(iterations)
        .map(|(level, iterations)| {
            let residual = stacked(level).0.place(&q);
            IkAnswer {
                q: q.clone(),
                reached: residual.within(settings.tolerance_m, settings.tolerance_rad),
                residual_m: residual.distance_m,
                residual_rad: residual.angle_rad,
                iterations,
            }
        })
        .collect();
    Ok(GroupsAnswer {
        reached: groups.iter().all(|answer| answer.reached),
        q,
        groups,
    })
}

/// The joints that move a frame of any goal, each once and in order.
fn joints_of(robot: &Robot, levels: &[Vec<Goal<'_>>]) -> Vec<usize> {
    let goals = levels.iter().flatten();
    let mut all: Vec<usize> = goals
        .flat_map(|goal| Chain::new(robot, goal.frame).joints().to_vec())
        .collect();
    all.sort_unstable();
    all.dedup();
    all
}
