//! Robustness sweeps: the motion is repeated under every level of disturbance and judged by the repeated check.

use std::collections::BTreeMap;

use kinemark_sim::random::KeyedStream;
use kinemark_sim::run::Disturbance;
use kinemark_sim::text::number::seconds;
use kinemark_sim::trace::Trace;

use super::motion_judge::MotionJudge;
use super::side_by_side;
use crate::attempt::motion;
use crate::attempt::{Attempt, Disclosure, Ended};
use crate::check::robustness::{EarlyEnd, LevelOutcome};
use crate::check::{self, Check, Finding, Level, MotionCheck, MotionFacts, SweepRuns};
use crate::record::grade::Evidence;
use crate::record::quantity::with_unit;
use crate::submission::controller::Stop;
use crate::submission::host::Host;
use crate::task::workcell::Workcell;

/// Why a sweep decides nothing.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Undecided(pub(super) Stop);

/// Runs every level of every robustness check whose repeated check earns points in `undisturbed`.
///
/// # Errors
/// [`Undecided`] if the person, the machine or the grader stopped a run.
pub(super) fn sweeps(
    judge: &MotionJudge<'_>,
    undisturbed: &MotionFacts<'_>,
    host: &mut dyn Host,
) -> Result<Vec<SweepRuns>, Undecided> {
    let mut runs: Vec<LevelRun<'_>> = Vec::new();
    let mut names = Vec::new();
    for check in judge.checks.iter() {
        let Some(sweep) = check.kind.sweep() else {
            continue;
        };
        let repeated = &judge.checks[sweep.check];
        let before = check::judge_motion(repeated, undisturbed);
        let earns = before.score > 0.0;
        for (place, level) in sweep.levels.iter().enumerate().filter(|_| earns) {
            let of = (names.len(), place, repeated);
            match runs.iter_mut().find(|run| run.level.is_same_run(level)) {
                Some(run) => run.judged_by.push(of),
                None => runs.push(LevelRun {
                    level,
                    judged_by: vec![of],
                }),
            }
        }
        names.push(&check.name);
    }
    let outcomes = side_by_side::in_order(&runs, host, |run, host| {
        let attempt = attempt(judge, run.level, host);
        let of_each = run.judged_by.iter();
        let of_each = of_each.map(|(_, _, repeated)| judged(judge, repeated, &attempt));
        of_each.collect::<Result<Vec<LevelOutcome>, Undecided>>()
    })?;
    let mut levels = vec![BTreeMap::new(); names.len()];
    for (run, outcomes) in runs.iter().zip(outcomes) {
        for ((of, place, _), outcome) in run.judged_by.iter().zip(outcomes) {
            levels[*of].insert(*place, outcome);
        }
    }
    let sweeps = names.into_iter().zip(levels);
    let sweeps = sweeps.map(|(check, levels)| SweepRuns {
        check: check.clone(),
        levels: levels.into_values().collect(),
    });
    Ok(sweeps.collect())
}

/// A run that is made once, though several checks may be judged in it.
struct LevelRun<'a> {
    level: &'a Level,
    /// Which sweeps have this level, and at which place, with the check that each of them repeats.
    judged_by: Vec<(usize, usize, &'a Check<dyn MotionCheck>)>,
}

/// Runs the task under one level of disturbance.
fn attempt(judge: &MotionJudge<'_>, level: &Level, host: &mut dyn Host) -> Attempt<Trace> {
    let lab = judge.lab;
    let mut robot = lab.robot.clone();
    if level.payload_kg > 0.0 {
        robot = robot.with_payload(level.payload_kg);
    }
    if level.friction > 0.0 {
        robot = robot.with_more_friction(level.friction);
    }
    if let Some(factor) = level.damping {
        robot = robot.with_damping_times(factor);
    }
    let disturbance = Disturbance {
        q_noise: level.q_noise,
        qd_noise: level.qd_noise,
        seed: seed([&lab.name, &judge.task.name, &level.name]),
        delay_periods: level.delay_periods,
        known: Some(&lab.robot),
    };
    let cell = Workcell {
        robot: &robot,
        ..lab.workcell()
    };
    let mut work = judge.work.clone();
    let pushes = level.pushes.iter();
    work.pushes.extend(pushes.map(|(_, push)| *push));
    if let Some(start) = &level.start {
        work.start_q.clone_from(&start.q);
        work.start_qd.clone_from(&start.qd);
    }
    motion::run_disturbed(cell, &work, &judge.opening, host, &disturbance)
}

/// Seed of the noise of a level: the same for every submission, on every platform.
fn seed(names: [&str; 3]) -> u64 {
    KeyedStream::new("kinemark 2026 noise of a rung", &names, &[]).bits()
}

/// The finding of the repeated check in the run of a level, or how that run ended early.
fn judged(
    judge: &MotionJudge<'_>,
    repeated: &Check<dyn MotionCheck>,
    attempt: &Attempt<Trace>,
) -> Result<LevelOutcome, Undecided> {
    let found = || check::judge_motion(repeated, &judge.facts(&attempt.recorded));
    let outcome = match &attempt.ended {
        None => Ok(found()),
        Some(ended) => {
            let message = end_message(judge, ended)?;
            if judge.is_whole(attempt, Some(ended)) {
                let kept = judge.lab.kept_after_stop;
                let time_s = judge.work.periods.time_s(ended.at);
                Ok(kept_finding(found(), kept, &message, time_s))
            } else {
                let tick = ended.at;
                Err(EarlyEnd { message, tick })
            }
        }
    };
    Ok(LevelOutcome {
        outcome,
        digest: attempt.recorded.digest().all.to_hex().to_string(),
    })
}

/// What was found in a level in which the submission failed: a share of it counts, and the failure is the first evidence.
fn kept_finding(finding: Finding, kept: f64, failure: &str, time_s: f64) -> Finding {
    let mut evidence = vec![Evidence {
        message: format!(
            "at {}: {failure}; with the last command held, {} of what the run earns count",
            seconds(time_s),
            with_unit(kept, "")
        ),
        ..Evidence::default()
    }];
    evidence.extend(finding.evidence);
    Finding {
        score: finding.score * kept,
        evidence,
        ..finding
    }
}

fn end_message(judge: &MotionJudge<'_>, ended: &Ended) -> Result<String, Undecided> {
    let disclosure = Disclosure::Run {
        names: judge.names(),
        task: judge.work,
    };
    let record = ended.record(judge.opening.program.text(), disclosure);
    let Some(stop) = ended.stop() else {
        return Ok(record.message);
    };
    if !ended.verdict().is_some_and(|verdict| verdict.is_decided()) {
        return Err(Undecided(stop.clone()));
    }
    let line = record.line.map(|line| format!(" (line {line})"));
    let line = line.unwrap_or_default();
    Ok(format!(
        "the submission was stopped: {}{line}",
        record.message
    ))
}
