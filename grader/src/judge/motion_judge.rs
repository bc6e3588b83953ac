//! Judging the run of a motion task, in the same way for visible runs, hidden runs and the levels of a robustness sweep.

use kinemark_sim::text::Source;
use kinemark_sim::trace::Trace;

use super::Interrupted;
use super::judged::{JudgedCheck, all_full, judge};
use super::opening::opening;
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
use crate::submission::host::Host;
use crate::task::model::{Band, MotionTask};

/// A motion task with a submission that is tried on it.
pub(super) struct MotionJudge<'a> {
    pub(super) lab: &'a Lab,
    pub(super) task: &'a Task,
    pub(super) work: &'a MotionTask,
    pub(super) checks: &'a [Check<dyn MotionCheck>],
    pub(super) opening: Opening,
    /// The reference solution's path, if the lab ships it.
    pub(super) reference: Option<&'a TcpPath>,
    /// The band by which dwells are chosen.
    pub(super) pose_band: Band,
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
        submission: &Source,
        reference: Option<&'a TcpPath>,
    ) -> Self {
        Self {
            lab,
            task,
            work,
            checks,
            opening: opening(lab, task, submission),
            reference,
            pose_band: check::dwell_band(checks),
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

    /// The facts of a run for the checks.
    pub(super) fn facts<'t>(&self, trace: &'t Trace) -> MotionFacts<'t>
    where
        'a: 't,
    {
        MotionFacts {
            robot: &self.lab.robot,
            names: self.names(),
            motion: self.work,
            trace,
            dwells: check::best_dwells(trace, &self.work.goals, self.pose_band),
            pose_band: self.pose_band,
            reference: self.reference,
            sweeps: Vec::new(),
        }
    }

    /// Judges a run by every check of its task. A run that reached its end is first repeated under the disturbances of robustness
    /// checks.
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
        let mut ended = attempt.ended.clone();
        if ended.is_none() {
            match robustness_sweep::sweeps(self, &facts, host) {
                Ok(sweeps) => facts.sweeps = sweeps,
                // if this machine could not run a level, nothing is decided, and neither is the grade
                Err(Undecided(stop)) => ended = Some(Ended::stopped_by(stop, 0)),
            }
        }
        let checks = judge(self.checks, ended.is_none(), |check| {
            check::judge_motion(check, &facts)
        });
        let verdict = ended.as_ref().map_or(Some(Verdict::Passed), Ended::verdict);
        let mut verdict = verdict.ok_or(Interrupted)?;
        if !all_full(&checks) {
            verdict = verdict.min(Verdict::Missed);
        }
        let source = &self.opening.source;
        Ok(JudgedRun {
            checks,
            dwells: facts.dwells,
            sweeps: facts.sweeps,
            verdict,
            stopped: ended.map(|ended| ended.record(source, disclosure)),
        })
    }
}
