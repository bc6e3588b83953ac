//! Grading a motion task: its run and hidden runs, its checks, where it leaves the reference, and what its plots draw.

use std::collections::BTreeMap;

use kinemark_sim::source::Source;
use kinemark_sim::trace::Trace;

use super::first_lost::first_lost;
use super::points::{counted, judged, not_finite_help, without_hints};
use super::{Grader, Host, InProcess, Interrupted, MOST_LOG_LINES};
use crate::attempt::motion::{self, EarlyEnd, MotionRun, Session};
use crate::attempt::stopped;
use crate::check::{self, Climb, MotionFacts, stay};
use crate::judge::diagnose;
use crate::judge::diverged::RunawayWords as _;
use crate::judge::divergence;
use crate::judge::hidden_runs::HiddenRuns;
use crate::judge::robustness_sweep::{self, Undecided};
use crate::lab::model::{Band, Check, CheckKind, MotionTask, Task};
use crate::lab::staff::Mutant;
use crate::lab::staff::sound::Whose;
use crate::lab::watched::PathToFollow;
use crate::record::grade::{
    Digests, LogEntry, Outcome, RungDigest, SecondDigests, Stopped, TaskGrade, TaskKind,
};
use crate::record::graded::{AskedPath, Goal, TaskRun, TcpPath};
use crate::record::names::{Names, contacts, events};
use crate::record::verdict::Verdict;
use crate::submission::controller::Stop;

impl Grader<'_> {
    pub(super) fn motion(
        &self,
        task: &Task,
        work: &MotionTask,
        host: &mut dyn Host,
    ) -> Result<(TaskGrade, TaskRun), Interrupted> {
        let opening = self.opening(task, self.submission);
        let MotionRun {
            trace,
            ended,
            operations,
        } = motion::run(self.lab, work, &opening, host);
        let names = Names {
            robot: &self.lab.robot,
            scene: work.scene.as_ref().map(|scene| &scene.scene),
            seen_from: &self.lab.frame,
        };
        let mut verdict = Verdict::Passed;
        let mut stopped_record = None;
        if let Some((tick, why)) = &ended {
            let mut record = match why {
                EarlyEnd::Stopped(stop) => {
                    verdict = stopped::verdict(stop).ok_or(Interrupted)?;
                    stopped::record(stop, self.submission.text())
                }
                EarlyEnd::InvalidOutput(what) => {
                    verdict = Verdict::InvalidOutput;
                    said(what.clone(), not_finite_help(what))
                }
                EarlyEnd::Diverged { what, cause } => {
                    verdict = Verdict::Missed;
                    let (message, help) = names.blow_up(what, cause.as_ref(), work);
                    said(message, Some(help))
                }
            };
            let of_whole_file =
                matches!(why, EarlyEnd::Stopped(stop) if !stopped::is_of_one_call(stop));
            if !of_whole_file {
                record.tick = Some(*tick);
                record.time_s = Some(work.periods.time_s(*tick));
            }
            stopped_record = Some(record);
        }
        let band = pose_band(&task.checks);
        let reference = self.reference_path(&task.name);
        let mut facts = MotionFacts {
            robot: &self.lab.robot,
            names,
            motion: work,
            trace: &trace,
            stays: stay::best_stays(&trace, &work.goals, band),
            pose_band: band,
            reference,
            climbs: Vec::new(),
        };
        let mut can_be_judged = ended.is_none();
        if can_be_judged {
            match robustness_sweep::climbs(self.lab, task, work, &opening, &facts, host) {
                Ok(climbs) => facts.climbs = climbs,
                Err(Undecided(stop)) => {
                    // a rung that this machine could not run decides nothing, nor does the grade without it
                    can_be_judged = false;
                    verdict = stopped::verdict(&stop).ok_or(Interrupted)?;
                    stopped_record = Some(stopped::record(&stop, self.submission.text()));
                }
            }
        }
        let judged = judged(&task.checks, can_be_judged, |check| {
            check::judge_motion(check, &facts)
        });
        let stays = facts.stays;
        let rungs = rung_digests(task, &facts.climbs);
        let mut checks = Vec::new();
        let mut curves = Vec::new();
        let mut check_titles = BTreeMap::new();
        for (asked, (mut check, curve)) in task.checks.iter().zip(judged) {
            check.first_lost = first_lost(&asked.kind, &check, curve.as_ref(), &work.periods);
            check_titles.insert(check.name.clone(), check.title.clone());
            checks.push(check);
            curves.extend(curve);
        }
        if checks.iter().any(|check| check.outcome != Outcome::Full) {
            verdict = verdict.min(Verdict::Missed);
        }
        let ran_away = matches!(ended, Some((_, EarlyEnd::Diverged { .. })));
        let compares = verdict == Verdict::Missed && (ended.is_none() || ran_away);
        let solution = compares.then(|| self.solution_run(task, work)).flatten();
        let differs = match (&solution, self.staff) {
            _ if !compares => None,
            (Some(solution), _) => {
                divergence::from_run(&trace, solution, &self.lab.robot, &work.periods)
            }
            (None, Some(_)) => None,
            (None, None) => {
                reference.and_then(|path| divergence::from_path(&trace, path, &work.periods))
            }
        };
        let diagnoses = if !compares {
            Vec::new()
        } else if work.goals.is_empty() {
            solution.as_ref().map_or_else(Vec::new, |solution| {
                let compared = diagnose::Compared {
                    student: &trace,
                    ended: ended.as_ref(),
                    reference: solution,
                    periods: work.periods,
                };
                let mutants = self.mutants_of(task).filter_map(|mutant| {
                    let opening = self.opening(task, &mutant.source);
                    match Session::open(self.lab, work, &opening, &mut InProcess) {
                        Ok(session) => Some((mutant, session)),
                        Err(run) => {
                            self.note_stop(Whose::Mutant(mutant), task, &mutant.source, &run.ended);
                            None
                        }
                    }
                });
                let stopped = |mutant: &Mutant, stop: &Stop| {
                    self.note_fault(Whose::Mutant(mutant), task, &mutant.source, stop);
                };
                diagnose::whole_run(compared, mutants, &stopped)
            })
        } else if ended.is_none() {
            let mutants = self.mutants_of(task).map(|mutant| {
                let opening = self.opening(task, &mutant.source);
                let run = motion::run(self.lab, work, &opening, &mut InProcess);
                self.note_stop(Whose::Mutant(mutant), task, &mutant.source, &run.ended);
                (mutant, run.trace)
            });
            diagnose::motion_task(work, band, &trace, mutants)
        } else {
            Vec::new()
        };
        let explained = !diagnoses.is_empty();
        let digest = trace.digest();
        let mut all_digest = digest.all;
        let mut hidden = Vec::new();
        if ended.is_none() {
            let runs = self
                .staff
                .map_or(Vec::new(), |staff| staff.runs(&task.name));
            let seen = HiddenRuns::run(&runs, &task.name, self.submission, host)?;
            if let Some(staff) = self.staff.filter(|_| !runs.is_empty()) {
                all_digest = staff.keyed(seen.digest(all_digest));
            }
            seen.count_in(&mut checks, &task.checks);
            hidden = seen.classes();
            if checks.iter().any(|check| check.outcome != Outcome::Full) {
                verdict = verdict.min(Verdict::Missed);
            }
            if let Some((worst, record)) = seen.into_stopped() {
                verdict = verdict.min(worst);
                stopped_record = Some(record);
            }
        }
        let mut checks = without_hints(checks, explained);
        let points = counted(&mut checks);
        let grade = TaskGrade {
            name: task.name.clone(),
            title: task.title.clone(),
            kind: TaskKind::Motion,
            verdict,
            points,
            max_points: task.max_points(),
            stopped: stopped_record,
            checks,
            diagnoses,
            cases: Vec::new(),
            hidden,
            events: events(&names, &trace, &work.periods),
            contacts: contacts(&names, &trace),
            operations,
            log: trace
                .log
                .iter()
                .take(MOST_LOG_LINES)
                .map(|line| LogEntry {
                    at: line.tick,
                    text: line.text.clone(),
                })
                .collect(),
            digests: Digests {
                all: all_digest.to_hex().to_string(),
                seconds: digest
                    .seconds
                    .iter()
                    .map(|second| {
                        let signal = |i: usize| second.signals[i].to_hex()[..16].to_owned();
                        SecondDigests {
                            q: signal(0),
                            qd: signal(1),
                            command: signal(2),
                            effort: signal(3),
                            tcp: signal(4),
                            bodies: (trace.bodies.width() > 0).then(|| signal(5)),
                            sensors: (trace.sensors.width() > 0).then(|| signal(6)),
                        }
                    })
                    .collect(),
                rungs,
            },
            divergence: differs.clone(),
        };
        let goals = work.goals.iter().enumerate().map(|(i, goal)| Goal {
            position_m: goal.position_m.into(),
            dwell_s: work.periods.time_s(goal.dwell_ticks),
            full_m: band.full,
            zero_m: band.zero,
            stay: stays
                .get(i)
                .map(|stay| (stay.first as u64, stay.last as u64)),
        });
        let run = TaskRun {
            task: task.name.clone(),
            robot: self.lab.robot.clone(),
            scene: work.scene.clone(),
            sensors: work.sensors.clone(),
            seen_from: self.lab.frame.clone(),
            mode: work.servo.mode,
            effort_limits: work.servo.gains.iter().map(|g| g.effort_limit).collect(),
            goals: goals.collect(),
            reference_tcp: reference.cloned(),
            paths: work
                .paths
                .iter()
                .map(|path| asked(path, &task.checks))
                .collect(),
            curves,
            check_titles,
            divergence: differs,
            ghost: None,
            trace,
        };
        Ok((grade, run))
    }

    /// The reference solution's run of a task, with the staff's part and if it comes to its end.
    fn solution_run(&self, task: &Task, work: &MotionTask) -> Option<Trace> {
        let solution = &self.staff?.solution;
        let opening = self.opening(task, solution);
        let run = motion::run(self.lab, work, &opening, &mut InProcess);
        self.note_stop(Whose::Solution, task, solution, &run.ended);
        run.ended.is_none().then_some(run.trace)
    }

    /// Keeps that a submission of the staff stopped, if it did.
    fn note_stop(
        &self,
        whose: Whose<'_>,
        task: &Task,
        source: &Source,
        ended: &Option<(u64, EarlyEnd)>,
    ) {
        if let Some((_, EarlyEnd::Stopped(stop))) = ended {
            self.note_fault(whose, task, source, stop);
        }
    }

    fn reference_path(&self, task: &str) -> Option<&TcpPath> {
        let mut paths = self.lab.reference_paths.paths.iter();
        paths.find(|(name, _)| name == task).map(|(_, path)| path)
    }
}

/// Identities of the runs of all rungs, in the lab's order.
fn rung_digests(task: &Task, climbs: &[Climb]) -> Vec<RungDigest> {
    let mut digests = Vec::new();
    for climb in climbs {
        let check = task.checks.iter().find(|check| check.name == climb.check);
        let Some(CheckKind::Robustness(ladder)) = check.map(|check| &check.kind) else {
            continue;
        };
        for (rung, facts) in ladder.rungs.iter().zip(&climb.rungs) {
            digests.push(RungDigest {
                check: climb.check.clone(),
                rung: rung.name.clone(),
                digest: facts.digest.clone(),
            });
        }
    }
    digests
}

/// A path as the plots draw it, with the band of the first check that measures the distance from it.
fn asked(path: &PathToFollow, checks: &[Check]) -> AskedPath {
    let band = checks.iter().find_map(|check| match &check.kind {
        CheckKind::PathDeviation { path: of, band, .. } if of.name == path.name => Some(*band),
        _ => None,
    });
    AskedPath {
        name: path.name.clone(),
        points_m: path.points_m.iter().map(|p| (*p).into()).collect(),
        tube_m: band.map(|band| [band.full, band.zero]),
    }
}

/// The band by which stays are chosen.
pub(crate) fn pose_band(checks: &[Check]) -> Band {
    let found = checks.iter().find_map(|check| match &check.kind {
        CheckKind::PoseReached(band) => Some(*band),
        _ => None,
    });
    found.unwrap_or(Band {
        full: 0.002,
        zero: 0.02,
    })
}

fn said(message: String, help: Option<String>) -> Stopped {
    Stopped {
        message,
        help,
        line: None,
        column: None,
        source_line: None,
        tick: None,
        time_s: None,
        case: None,
    }
}
