//! Judging the run of a motion task, in the same way for visible runs, hidden runs and the levels of a robustness sweep.

use std::borrow::Cow;

use kinemark_sim::text::Source;
use kinemark_sim::trace::Trace;

use super::Interrupted;
use super::judged::{JudgedCheck, all_full, judge};
use super::opening::opening;
use super::reached::OfReference;
use super::robustness_sweep::{self, Undecided};
use crate::attempt::motion;
use crate::attempt::{Attempt, Disclosure, Ended};
use crate::check::{self, Check, Dwell, MotionCheck, MotionFacts, SweepRuns};
use crate::lab::{Lab, Task};
use crate::record::grade::Stopped;
use crate::record::graded::TcpPath;
use crate::record::names::Names;
use crate::record::verdict::Verdict;
use crate::submission::controller::Opening;
use crate::submission::handed_in::Submission;
use crate::submission::host::{Host, InProcess};
use crate::task::model::{Band, MotionTask};

/// A motion task with a submission that is tried on it.
pub(super) struct MotionJudge<'a> {
    pub(super) lab: &'a Lab,
    pub(super) task: &'a Task,
    pub(super) work: &'a MotionTask,
    /// Its checks; with numbers in the bands that name the reference, once those are known.
    pub(super) checks: Cow<'a, [Check<dyn MotionCheck>]>,
    pub(super) opening: Opening,
    /// The reference solution's path, if the lab ships it.
    pub(super) reference: Option<&'a TcpPath>,
    /// The band by which dwells are chosen.
    pub(super) pose_band: Band,
    /// What is known of the reference solution.
    pub(super) of_reference: OfReference,
}

/// A run, judged.
pub(super) struct JudgedRun {
    /// One per check of the task.
    pub(super) checks: Vec<JudgedCheck>,
    /// The dwells at the goals.
    pub(super) dwells: Vec<Dwell>,
    /// The runs of robustness checks.
    pub(super) sweeps: Vec<SweepRuns>,
    /// The verdict on this run alone.
    pub(super) verdict: Verdict,
    /// How it ended, if it ended early or could not be decided.
    pub(super) stopped: Option<Stopped>,
}

impl<'a> MotionJudge<'a> {
    pub(super) fn new(
        lab: &'a Lab,
        task: &'a Task,
        (work, checks): (&'a MotionTask, &'a [Check<dyn MotionCheck>]),
        submission: &Submission,
        reference: Option<&'a TcpPath>,
    ) -> Self {
        Self {
            lab: lab.of_task(task),
            task,
            work,
            checks: Cow::Borrowed(checks),
            opening: opening(lab, task, submission),
            reference,
            pose_band: check::dwell_band(checks),
            of_reference: OfReference::default(),
        }
    }

    /// The robot, scene and frame that name things in its runs.
    pub(super) fn names(&self) -> Names<'a> {
        Names {
            robot: &self.lab.robot,
            scene: self.work.scene.as_ref().map(|scene| &scene.scene),
            seen_from: &self.lab.frame,
        }
    }

    /// Runs the task once.
    pub(super) fn attempt(&self, host: &mut dyn Host) -> Attempt<Trace> {
        motion::run(self.lab.workcell(), self.work, &self.opening, host)
    }

    /// Runs the task once under a submission of the course staff.
    pub(super) fn attempt_of(&self, source: &Source) -> Attempt<Trace> {
        let opening = opening(self.lab, self.task, &Submission::from(source));
        motion::run(self.lab.workcell(), self.work, &opening, &mut InProcess)
    }

    /// The facts of a run for the checks.
    pub(super) fn facts<'t>(&'t self, trace: &'t Trace) -> MotionFacts<'t> {
        MotionFacts {
            robot: &self.lab.robot,
            names: self.names(),
            motion: self.work,
            trace,
            dwells: check::best_dwells(trace, &self.work.goals, self.pose_band),
            pose_band: self.pose_band,
            reference: self.reference,
            solution: self.of_reference.whole_run(),
            reached: &self.of_reference.reached,
            sweeps: Vec::new(),
        }
    }

    /// Whether there is a run to its last tick: one call may have failed in it, after which the last command was held.
    pub(super) fn is_whole(&self, attempt: &Attempt<Trace>, ended: Option<&Ended>) -> bool {
        ended.is_none_or(|ended| {
            ended.why.is_of_one_call() && attempt.recorded.len() as u64 > self.work.ticks
        })
    }

    /// Judges a run by every check of its task. A run that reached its last tick is first repeated under the disturbances of robustness
    /// checks. Where the submission failed, a share of the points is kept.
    ///
    /// # Errors
    /// [`Interrupted`] if the user interrupted the grade.
    pub(super) fn judge(
        &self,
        attempt: &Attempt<Trace>,
        disclosure: Disclosure<'_>,
        host: &mut dyn Host,
    ) -> Result<JudgedRun, Interrupted> {
        let mut facts = self.facts(&attempt.recorded);
        let mut ended = self.ended(attempt);
        if self.is_whole(attempt, ended.as_ref()) {
            match robustness_sweep::sweeps(self, &facts, host) {
                Ok(sweeps) => facts.sweeps = sweeps,
                // if this machine could not run a level, nothing is decided, and neither is the grade
                Err(Undecided(stop)) => ended = Some(Ended::stopped_by(stop, 0)),
            }
        }
        let at_hand_in = &self.of_reference.at_hand_in;
        let is_whole = self.is_whole(attempt, ended.as_ref());
        let mut checks = judge(&self.checks, is_whole, at_hand_in, |check| {
            check::judge_motion(check, &facts)
        });
        let kept = ended
            .as_ref()
            .filter(|_| is_whole)
            .map(|_| self.lab.kept_after_stop);
        if let Some(kept) = kept {
            checks.iter_mut().for_each(|check| check.keep(kept));
        }
        let verdict = ended.as_ref().map_or(Some(Verdict::Passed), Ended::verdict);
        let mut verdict = verdict.ok_or(Interrupted)?;
        if !all_full(&checks) {
            verdict = verdict.min(Verdict::Missed);
        }
        let source = self.opening.program.text();
        Ok(JudgedRun {
            checks,
            dwells: facts.dwells,
            sweeps: facts.sweeps,
            verdict,
            stopped: ended.map(|ended| Stopped {
                kept,
                ..ended.record(source, disclosure)
            }),
        })
    }
}
