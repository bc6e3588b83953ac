//! The record of a motion task, and its run for plots and replay.

use kinemark_sim::trace::{SecondDigest, Trace};

use super::grader::MOST_LOG_LINES;
use super::motion_judge::MotionJudge;
use crate::attempt::Attempt;
use crate::check::{self, Check, Dwell, MotionCheck, SweepRuns};
use crate::record::grade::{
    CheckGrade, Diagnosis, Digests, Divergence, HiddenClass, LevelDigest, LogEntry, Outcome,
    SecondDigests, Stopped, TaskGrade, TaskKind,
};
use crate::record::graded::{AskedPath, Curve, Goal, TaskRun};
use crate::record::names::{contacts, events};
use crate::record::quantity::sum_of_points;
use crate::record::run_figures::RunFigures;
use crate::record::verdict::Verdict;

/// The result of a motion task, visible and hidden runs together.
pub(super) struct MotionResult {
    pub(super) verdict: Verdict,
    pub(super) stopped: Option<Stopped>,
    pub(super) checks: Vec<CheckGrade>,
    pub(super) diagnoses: Vec<Diagnosis>,
    pub(super) hidden: Vec<HiddenClass>,
    pub(super) digests: Digests,
    pub(super) divergence: Option<Divergence>,
}

impl MotionResult {
    /// The record.
    pub(super) fn grade(&self, judge: &MotionJudge<'_>, attempt: &Attempt<Trace>) -> TaskGrade {
        let (task, trace) = (judge.task, &attempt.recorded);
        let names = judge.names();
        let log = trace.log.iter().take(MOST_LOG_LINES);
        TaskGrade {
            name: task.name.clone(),
            title: task.title.clone(),
            kind: TaskKind::Motion,
            verdict: self.verdict,
            points: sum_of_points(self.checks.iter().map(|check| check.points)),
            max_points: max_points(&self.checks, false),
            points_at_hand_in: max_points(&self.checks, true),
            stopped: self.stopped.clone(),
            checks: self.checks.clone(),
            diagnoses: self.diagnoses.clone(),
            cases: Vec::new(),
            hidden: self.hidden.clone(),
            events: events(&names, trace, &judge.work.periods),
            contacts: contacts(&names, trace),
            operations: attempt.operations,
            log: log
                .map(|line| LogEntry {
                    at: line.tick,
                    text: line.text.clone(),
                    line: line.line,
                })
                .collect(),
            digests: self.digests.clone(),
            divergence: self.divergence.clone(),
            figures: self.figures(judge, trace),
        }
    }

    /// What a run with full points took.
    fn figures(&self, judge: &MotionJudge<'_>, trace: &Trace) -> Option<RunFigures> {
        let gains = judge.work.servo.gains.iter();
        let limits: Vec<f64> = gains.map(|gains| gains.effort_limit).collect();
        let is_full = self.verdict == Verdict::Passed;
        let stride = judge.work.periods.ticks_per_control.get() as usize;
        is_full
            .then(|| RunFigures::of(trace, stride, &limits))
            .flatten()
    }

    /// The visible run, for renderers.
    pub(super) fn run(
        self,
        judge: &MotionJudge<'_>,
        attempt: Attempt<Trace>,
        dwells: &[Dwell],
        curves: Vec<Curve>,
    ) -> TaskRun {
        let (lab, task, work) = (judge.lab, judge.task, judge.work);
        let checks = &judge.checks;
        let titles = checks.iter();
        let titles = titles.map(|check| (check.name.clone(), check.title.clone()));
        let paths = work.paths.iter().map(|path| AskedPath {
            name: path.name.clone(),
            points_m: path.points_m.iter().map(|p| (*p).into()).collect(),
            tube_m: check::path_band(checks, &path.name).map(|band| [band.full, band.zero]),
        });
        let gains = work.servo.gains.iter();
        TaskRun {
            task: task.name.clone(),
            robot: lab.robot.clone(),
            scene: work.scene.clone(),
            sensors: work.sensors.clone(),
            seen_from: lab.frame.clone(),
            mode: work.servo.mode,
            effort_limits: gains.map(|gains| gains.effort_limit).collect(),
            goals: goals(judge, dwells),
            reference_tcp: judge.reference.cloned(),
            paths: paths.collect(),
            curves,
            check_titles: titles.collect(),
            divergence: self.divergence,
            reference_overlay: None,
            trace: attempt.recorded,
        }
    }
}

/// What checks are worth: those that are judged when the submission is handed in, or the others.
fn max_points(checks: &[CheckGrade], at_hand_in: bool) -> f64 {
    let counted = checks
        .iter()
        .filter(|check| (check.outcome == Outcome::AtHandIn) == at_hand_in);
    counted.map(|check| check.max_points).sum()
}

/// The goals with the dwells that were judged.
fn goals(judge: &MotionJudge<'_>, dwells: &[Dwell]) -> Vec<Goal> {
    let band = judge.pose_band;
    let goals = judge.work.goals.iter().enumerate();
    let goals = goals.map(|(i, goal)| Goal {
        position_m: goal.position_m.into(),
        dwell_s: judge.work.periods.time_s(goal.dwell_ticks),
        full_m: band.full,
        zero_m: band.zero,
        stay: dwells
            .get(i)
            .map(|dwell| (dwell.first as u64, dwell.last as u64)),
    });
    goals.collect()
}

/// Digests of every simulated second of a run.
pub(super) fn second_digests(trace: &Trace, seconds: &[SecondDigest]) -> Vec<SecondDigests> {
    let seconds = seconds.iter().map(|second| {
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
    });
    seconds.collect()
}

/// Digests of the runs of all levels of robustness checks, in the lab's order.
pub(super) fn level_digests(
    checks: &[Check<dyn MotionCheck>],
    sweeps: &[SweepRuns],
) -> Vec<LevelDigest> {
    let mut digests = Vec::new();
    for sweep in sweeps {
        let check = checks.iter().find(|check| check.name == sweep.check);
        let Some(defined) = check.and_then(|check| check.kind.sweep()) else {
            continue;
        };
        for (level, facts) in defined.levels.iter().zip(&sweep.levels) {
            digests.push(LevelDigest {
                check: sweep.check.clone(),
                rung: level.name.clone(),
                digest: facts.digest.clone(),
            });
        }
    }
    digests
}
