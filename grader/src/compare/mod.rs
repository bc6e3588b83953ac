//! Compares two graded submissions of one lab: the points of each check, and the first difference of their motions.

use kinemark_sim::model::robot::Robot;
use kinemark_sim::text::number::{list, metres, trimmed};

use crate::judge::divergence;
use crate::lab::Lab;
use crate::lab::TaskWork;
use crate::record::comparison::{
    CheckComparison, Comparison, Ended, FORMAT, FirstDifference, MotionComparison, Pair,
    SideRecord, TaskComparison, comparable, ended, runs,
};
use crate::record::grade::{Grade, GradeMode, TaskGrade, TaskKind};
use crate::record::graded::{GradedRun, TaskRun};
use crate::record::quantity::points;

/// One of the two submissions.
#[derive(Debug, Clone, Copy)]
pub struct Side<'a> {
    /// Its name besides its letter, such as its folder.
    pub name: &'a str,
    /// Its record, as read from its report.
    pub recorded: &'a Grade,
    /// Its lab.
    pub lab: &'a Lab,
    /// Its runs, repeated for the comparison.
    pub again: &'a GradedRun,
}

/// Why two submissions cannot be compared.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("the two cannot be compared: {}", .0.join("; "))]
pub struct NotComparable(pub Vec<String>);

/// Compares two submissions of one lab.
///
/// Points are those of the records, each of the maximum that its lab gives: a lab that was changed in between can be held side by side.
/// Motions are those of the repeated runs, compared by joints and TCP with the tolerances of
/// [`divergence`], up to the end of the shorter one.
///
/// # Errors
/// [`NotComparable`] for different labs, or if no task is in both.
pub fn compare(a: &Side<'_>, b: &Side<'_>) -> Result<Comparison, NotComparable> {
    if a.recorded.lab.name != b.recorded.lab.name {
        let labs =
            [a, b].map(|side| format!("`{}` is of lab `{}`", side.name, side.recorded.lab.name));
        return Err(NotComparable(labs.to_vec()));
    }
    let mut notes = differing_grounds(a.recorded, b.recorded);
    let mut tasks = Vec::new();
    let mut apart = Vec::new();
    for task_a in &a.recorded.tasks {
        let task_b = b
            .recorded
            .tasks
            .iter()
            .find(|task| task.name == task_a.name);
        match task_b
            .ok_or("A alone has it".to_owned())
            .and_then(|task_b| {
                agree(task_a, task_b)?;
                Ok(task_b)
            }) {
            Ok(task_b) => tasks.push(task(task_a, task_b, a, b, &mut notes)),
            Err(why) => apart.push(format!("task `{}`: {why}", task_a.name)),
        }
    }
    let only_b = b
        .recorded
        .tasks
        .iter()
        .filter(|task| !a.recorded.tasks.iter().any(|other| other.name == task.name));
    apart.extend(only_b.map(|task| format!("task `{}`: B alone has it", task.name)));
    if tasks.is_empty() {
        apart.extend(notes);
        return Err(NotComparable(apart));
    }
    notes.extend(apart.into_iter().map(|why| format!("not compared: {why}")));
    Ok(Comparison {
        format: FORMAT,
        lab: a.recorded.lab.name.clone(),
        a: record(a),
        b: record(b),
        notes,
        tasks,
    })
}

fn record(side: &Side<'_>) -> SideRecord {
    let grade = side.recorded;
    SideRecord {
        name: side.name.to_owned(),
        submission: grade.submission.name.clone(),
        digest: grade.submission.digest.clone(),
        verdict: grade.verdict,
        points: grade.points,
        max_points: grade.max_points,
    }
}

/// Differences in what two records are based on, such as robot, variant and engine.
fn differing_grounds(a: &Grade, b: &Grade) -> Vec<String> {
    let mut notes = Vec::new();
    let variant = |grade: &Grade| {
        let words = grade.variant.as_ref().map(|variant| variant.words());
        words.unwrap_or_else(|| "the default variant".to_owned())
    };
    if a.variant != b.variant {
        notes.push(format!(
            "other numbers: A has {}, B has {}",
            variant(a),
            variant(b)
        ));
    } else if a.lab.digest != b.lab.digest {
        notes.push("the lab was changed between the two".to_owned());
    }
    if a.robot.name == b.robot.name {
        // other numbers are reported already
        if a.robot.digest != b.robot.digest && a.variant == b.variant {
            notes.push(format!(
                "robot `{}` was changed between the two",
                a.robot.name
            ));
        }
    } else {
        notes.push(format!(
            "other robots: A has `{}`, B has `{}`",
            a.robot.name, b.robot.name
        ));
    }
    if a.scenes != b.scenes {
        notes.push("other scenes".to_owned());
    }
    if a.mode != b.mode {
        let mode = |grade: &Grade| match grade.mode {
            GradeMode::Graded => "with hidden cases",
            GradeMode::Practice => "on visible cases only",
        };
        notes.push(format!("A was graded {}, B {}", mode(a), mode(b)));
    }
    if a.engine != b.engine {
        notes.push(format!("A was graded by {}, B by {}", a.engine, b.engine));
    }
    if a.submission.digest == b.submission.digest {
        notes.push("A and B are the same submission".to_owned());
    }
    notes
}

/// Whether a task can be compared.
fn agree(a: &TaskGrade, b: &TaskGrade) -> Result<(), String> {
    if a.kind != b.kind {
        return Err("it is a motion in one and a function in the other".to_owned());
    }
    Ok(())
}

/// The checks that only one of the two has, because the lab was changed between them.
fn checks_apart(a: &TaskGrade, b: &TaskGrade) -> Vec<String> {
    let missing = |of: &TaskGrade, in_other: &TaskGrade, letter: &str| -> Vec<String> {
        let checks = of.checks.iter();
        let alone = checks.filter(|check| {
            let mut others = in_other.checks.iter();
            others.all(|other| other.name != check.name)
        });
        alone
            .map(|check| {
                format!(
                    "not compared: {letter} alone has check `{}/{}`, {} of {} points",
                    of.name,
                    check.name,
                    points(check.points),
                    points(check.max_points)
                )
            })
            .collect()
    };
    let mut apart = missing(a, b, "A");
    apart.extend(missing(b, a, "B"));
    apart
}

fn task(
    task_a: &TaskGrade,
    task_b: &TaskGrade,
    a: &Side<'_>,
    b: &Side<'_>,
    notes: &mut Vec<String>,
) -> TaskComparison {
    notes.extend(checks_apart(task_a, task_b));
    let checks = task_a.checks.iter().filter_map(|check| {
        let other = task_b
            .checks
            .iter()
            .find(|other| other.name == check.name)?;
        Some(CheckComparison {
            name: check.name.clone(),
            title: check.title.clone(),
            outcome_a: check.outcome,
            outcome_b: other.outcome,
            points: Pair::new(
                (check.points, check.max_points),
                (other.points, other.max_points),
            ),
        })
    });
    let motion = match (task_a.kind, runs(&task_a.name, a.again, b.again)) {
        (TaskKind::Motion, Some((run_a, run_b))) => match comparable(run_a, run_b) {
            Ok(()) => Some(motion(&task_a.name, run_a, run_b, a, b)),
            Err(why) => {
                notes.push(format!(
                    "not compared: the motions of task `{}`: {why}",
                    task_a.name
                ));
                None
            }
        },
        _ => None,
    };
    // as recorded with the points; what no record says, from the repeated run
    let ended = |task: &TaskGrade, again: &GradedRun| {
        let run = again.runs.iter().find(|run| run.task == task.name);
        let recorded = task.stopped.as_ref().map(Ended::of);
        recorded.or_else(|| ended(run?, None))
    };
    TaskComparison {
        ended_a: ended(task_a, a.again),
        ended_b: ended(task_b, b.again),
        name: task_a.name.clone(),
        title: task_a.title.clone(),
        verdict_a: task_a.verdict,
        verdict_b: task_b.verdict,
        points: Pair::new(
            (task_a.points, task_a.max_points),
            (task_b.points, task_b.max_points),
        ),
        checks: checks.collect(),
        motion,
    }
}

fn motion(
    name: &str,
    run_a: &TaskRun,
    run_b: &TaskRun,
    a: &Side<'_>,
    b: &Side<'_>,
) -> MotionComparison {
    let seconds = |graded: &GradedRun| {
        let task = graded.grade.tasks.iter().find(|task| task.name == name);
        task.map(|task| task.digests.seconds.clone())
    };
    let same_bits = run_a.trace.len() == run_b.trace.len() && seconds(a.again) == seconds(b.again);
    let work = a.lab.tasks.iter().find(|task| task.name == name);
    let periods = work.and_then(|task| match &task.work {
        TaskWork::Motion(motion, _) => Some(&motion.periods),
        TaskWork::Function(..) => None,
    });
    let first = periods.and_then(|periods| {
        divergence::from_run(&run_a.trace, &run_b.trace, &run_a.robot, periods)
    });
    MotionComparison {
        same_bits,
        first: first.map(|found| FirstDifference {
            message: words(
                &found.signal,
                &found.yours,
                &found.reference,
                found.distance,
                &found.unit,
                &run_a.robot,
            ),
            tick: found.tick,
            time_s: found.time_s,
            signal: found.signal,
            a: found.yours,
            b: found.reference,
            distance: found.distance,
            tolerance: found.tolerance,
            unit: found.unit,
        }),
    }
}

fn words(signal: &str, a: &[f64], b: &[f64], distance: f64, unit: &str, robot: &Robot) -> String {
    let index = signal
        .strip_prefix("q[")
        .and_then(|rest| rest.strip_suffix(']'));
    let joint = index
        .and_then(|index| index.parse().ok())
        .and_then(|index| robot.moving_joints().nth(index));
    match (joint, a, b) {
        (Some(joint), [a], [b]) => format!(
            "`{}` is at {} {unit} in A, at {} {unit} in B",
            joint.name,
            trimmed(*a, 4),
            trimmed(*b, 4)
        ),
        _ => format!(
            "the TCP is at {} m in A, {} from where it is in B, {} m",
            list(a),
            metres(distance),
            list(b)
        ),
    }
}
