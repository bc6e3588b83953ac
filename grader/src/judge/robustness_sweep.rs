//! Climbs the ladder of a robustness check: the same motion once more under every rung, judged by the check that is repeated.

use kinemark_sim::random::KeyedStream;
use kinemark_sim::run::Disturbance;

use crate::attempt::motion::{self, EarlyEnd, MotionRun};
use crate::attempt::stopped;
use crate::check::robustness::{RungEnd, RungFacts};
use crate::check::{self, Climb, MotionFacts, stay};
use crate::judge::Host;
use crate::judge::diverged::RunawayWords as _;
use crate::lab::ladder::Rung;
use crate::lab::model::{CheckKind, Lab, MotionTask, Task};
use crate::submission::controller::{Opening, Stop};

/// Why a climb says nothing about the work.
#[derive(Debug, Clone, PartialEq)]
pub struct Undecided(pub Stop);

/// Runs every rung of every robustness check of `task` whose repeated check earns anything in `undisturbed`.
///
/// # Errors
/// [`Undecided`] if the person, the machine or the grader stopped a run.
pub fn climbs(
    lab: &Lab,
    task: &Task,
    motion: &MotionTask,
    opening: &Opening,
    undisturbed: &MotionFacts<'_>,
    host: &mut dyn Host,
) -> Result<Vec<Climb>, Undecided> {
    let mut climbs = Vec::new();
    for check in &task.checks {
        let CheckKind::Robustness(ladder) = &check.kind else {
            continue;
        };
        let repeated = &task.checks[ladder.check];
        let before = check::judge_motion(repeated, undisturbed);
        let mut rungs = Vec::new();
        if before.score > 0.0 {
            for rung in &ladder.rungs {
                let run = run(lab, task, motion, opening, rung, host);
                rungs.push(facts(run, &opening.source, undisturbed, |facts| {
                    check::judge_motion(repeated, facts)
                })?);
            }
        }
        climbs.push(Climb {
            check: check.name.clone(),
            repeated: repeated.title.clone(),
            rungs,
        });
    }
    Ok(climbs)
}

fn run(
    lab: &Lab,
    task: &Task,
    motion: &MotionTask,
    opening: &Opening,
    rung: &Rung,
    host: &mut dyn Host,
) -> MotionRun {
    let mut robot = lab.robot.clone();
    if rung.payload_kg > 0.0 {
        robot = robot.with_payload(rung.payload_kg);
    }
    if rung.friction > 0.0 {
        robot = robot.with_more_friction(rung.friction);
    }
    if let Some(factor) = rung.damping {
        robot = robot.with_damping_times(factor);
    }
    let disturbance = Disturbance {
        q_noise: rung.q_noise,
        qd_noise: rung.qd_noise,
        seed: seed([&lab.name, &task.name, &rung.name]),
        delay_periods: rung.delay_periods,
        known: Some(&lab.robot),
    };
    motion::run_disturbed(lab, motion, opening, host, &robot, &disturbance)
}

/// Where the noise of a rung starts: the same for every submission, everywhere.
fn seed(names: [&str; 3]) -> u64 {
    KeyedStream::new("kinemark 2026 noise of a rung", &names, &[]).bits()
}

fn facts(
    run: MotionRun,
    source: &str,
    undisturbed: &MotionFacts<'_>,
    judge: impl Fn(&MotionFacts<'_>) -> check::Finding,
) -> Result<RungFacts, Undecided> {
    let MotionRun { trace, ended, .. } = run;
    let digest = trace.digest().all.to_hex().to_string();
    let outcome = match ended {
        None => {
            let band = undisturbed.pose_band;
            Ok(judge(&MotionFacts {
                robot: undisturbed.robot,
                names: undisturbed.names,
                motion: undisturbed.motion,
                stays: stay::best_stays(&trace, &undisturbed.motion.goals, band),
                trace: &trace,
                pose_band: band,
                reference: undisturbed.reference,
                climbs: Vec::new(),
            }))
        }
        Some((tick, why)) => {
            let message = match why {
                EarlyEnd::Stopped(stop) => {
                    let verdict = stopped::verdict(&stop);
                    if !verdict.is_some_and(|verdict| verdict.is_decided()) {
                        return Err(Undecided(stop));
                    }
                    let record = stopped::record(&stop, source);
                    let line = record.line.map(|line| format!(" (line {line})"));
                    let line = line.unwrap_or_default();
                    format!("the submission was stopped: {}{line}", record.message)
                }
                EarlyEnd::InvalidOutput(what) => what,
                EarlyEnd::Diverged { what, cause } => {
                    let motion = undisturbed.motion;
                    undisturbed.names.blow_up(&what, cause.as_ref(), motion).0
                }
            };
            Err(RungEnd { message, tick })
        }
    };
    Ok(RungFacts { outcome, digest })
}
