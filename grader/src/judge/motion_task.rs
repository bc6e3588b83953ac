//! Grading a motion task: its visible run is judged and diagnosed, then its hidden runs, and both together make the grade.

use std::sync::Arc;

use kinemark_sim::control::Mode;
use kinemark_sim::text::Source;
use kinemark_sim::trace::Trace;

use super::Interrupted;
use super::check_grades::check_grades;
use super::diagnose::{self, Diagnosed, MutantRun, Settled, Unfolding};
use super::divergence;
use super::first_lost::first_lost;
use super::grader::{GradedTask, Grader, TaskScores};
use super::hidden_attempts::HiddenAttempts;
use super::judged::JudgedCheck;
use super::motion_judge::MotionJudge;
use super::motion_record::{MotionResult, level_digests, second_digests};
use crate::attempt::motion::Session;
use crate::attempt::{Attempt, Disclosure, Ended};
use crate::check::{Check, MotionCheck, cause};
use crate::lab::staff::Mutant;
use crate::lab::{Task, TaskWork};
use crate::record::grade::{CheckGrade, Digests, Divergence, Instant, Outcome, repair_first};
use crate::record::graded::Curve;
use crate::record::staff_fault::StaffSubmission;
use crate::record::verdict::Verdict;
use crate::submission::handed_in::Submission;
use crate::submission::host::{Host, InProcess};
use crate::task::model::{Function, MotionTask};
use crate::task::workcell::Workcell;

impl Grader<'_> {
    pub(super) fn motion(
        &self,
        task: &Task,
        work: &MotionTask,
        checks: &[Check<dyn MotionCheck>],
        host: &mut dyn Host,
    ) -> Result<GradedTask, Interrupted> {
        let path = self.lab.practice.path(&task.name);
        let judge = MotionJudge::new(self.lab, task, (work, checks), self.submission, path);
        let judge = self.beside_reference(judge);
        let checks = &judge.checks[..];
        let attempt = self.own_attempt(&judge, host);
        let disclosure = Disclosure::Run {
            names: judge.names(),
            task: work,
        };
        let mut visible = judge.judge(&attempt, disclosure, host)?;
        let (differs, diagnosed) = self.compared(&judge, &attempt, visible.verdict);
        let first_lost = first_losses(&judge, &visible.checks);
        let (diagnoses, rulings) = Diagnosed::parts(diagnosed);
        let diagnoses = self.in_words_of(task, diagnoses);
        lead_to_goals(checks, &mut visible.checks);
        if visible.stopped.is_none() && diagnoses.is_empty() {
            let unsolved = self.unsolved_before(task, work);
            name_cause(
                &judge,
                &attempt.recorded,
                &first_lost,
                unsolved,
                &mut visible.checks,
            );
        }
        let hidden = self.hidden(&judge, &attempt, host)?;
        let grades = check_grades(
            checks,
            &visible.checks,
            &first_lost,
            &hidden,
            visible.stopped.is_some() || !diagnoses.is_empty(),
        );
        let mut verdict = visible.verdict.min(missed_by(&grades));
        let digest = attempt.recorded.digest();
        let all = match self.staff.filter(|_| !hidden.is_empty()) {
            Some(staff) => staff.keyed(hidden.digest(digest.all)),
            None => digest.all,
        };
        let classes = hidden.classes();
        let mut stopped = visible.stopped.take();
        if let Some((worst, record)) = hidden.into_stopped() {
            verdict = verdict.min(worst);
            // what stopped the visible run has its place, and that of a hidden one has none
            stopped = stopped.or(Some(record));
        }
        let result = MotionResult {
            verdict,
            stopped,
            checks: grades,
            diagnoses,
            hidden: classes,
            digests: Digests {
                all: all.to_hex().to_string(),
                seconds: second_digests(&attempt.recorded, &digest.seconds),
                rungs: level_digests(checks, &visible.sweeps),
            },
            divergence: differs,
        };
        let scores = TaskScores {
            checks: visible.checks.iter().map(|check| check.score).collect(),
            cases: Vec::new(),
            rulings,
        };
        let grade = result.grade(&judge, &attempt);
        let run = result.run(&judge, attempt, &visible.dwells, curves(visible.checks));
        Ok(GradedTask {
            grade,
            run: Some(run),
            cases: None,
            scores,
        })
    }

    /// The run of what is graded.
    fn own_attempt(&self, judge: &MotionJudge<'_>, host: &mut dyn Host) -> Attempt<Trace> {
        let is_kept = self.is_kept_solution();
        match is_kept.then(|| self.solution_attempt(judge)).flatten() {
            Some(run) => Attempt::clone(&run),
            None => judge.attempt(host),
        }
    }

    /// An earlier task of the function from which such a motion is made, if it lost more than half of its points: the Jacobian for
    /// velocities, and inverse kinematics for positions and where a lab has no task of the Jacobian. A function that is wrong in some
    /// cases alone says nothing about the motion.
    fn unsolved_before(&self, task: &Task, work: &MotionTask) -> Option<&str> {
        let before = self.lab.tasks.iter();
        let before = before.take_while(|known| known.name != task.name);
        let of = |is: fn(&Function) -> bool| {
            before.clone().filter(move |known| match &known.work {
                TaskWork::Function(work, _) => is(&work.function),
                TaskWork::Motion(..) => false,
            })
        };
        let is_jacobian: fn(&Function) -> bool =
            |function| matches!(function, Function::Jacobian(_));
        let is_inverse: fn(&Function) -> bool =
            |function| matches!(function, Function::InverseKinematics(_));
        let mut functions = match work.servo.mode {
            Mode::Velocity if of(is_jacobian).next().is_some() => of(is_jacobian),
            Mode::Velocity | Mode::Position => of(is_inverse),
            Mode::Effort | Mode::Prescribed => return None,
        };
        let lost = functions.find(|known| self.broken.contains(&known.name))?;
        Some(&lost.name)
    }

    /// The judge with what is known of the reference solution.
    fn beside_reference<'j>(&self, judge: MotionJudge<'j>) -> MotionJudge<'j> {
        let Some(staff) = self.staff else {
            return judge.in_practice();
        };
        if !judge.needs_reference() {
            return judge;
        }
        let Some(run) = self.solution_attempt(&judge) else {
            return judge;
        };
        let judge = judge.against(&staff.solution, run);
        if let Some(run) = &judge.of_reference.run {
            let (whose, ended) = (StaffSubmission::Solution, run.ended.as_ref());
            self.note_stop(whose, judge.task, &staff.solution, ended);
        }
        judge
    }

    /// Where a run that lost points first differs from the reference solution's, and which mutant it matches.
    fn compared(
        &self,
        judge: &MotionJudge<'_>,
        attempt: &Attempt<Trace>,
        verdict: Verdict,
    ) -> (Option<Divergence>, Option<Diagnosed>) {
        let ended = attempt.ended.as_ref();
        if verdict != Verdict::Missed || !ended.is_none_or(Ended::is_diverged) {
            return (None, None);
        }
        let solution = self.solution_run(judge);
        let trace = &attempt.recorded;
        let periods = &judge.work.periods;
        let differs = match (&solution, self.staff) {
            (Some(solution), _) => {
                divergence::from_run(trace, &solution.recorded, &self.lab.robot, periods)
            }
            (None, Some(_)) => None,
            (None, None) => {
                let path = judge.reference;
                path.and_then(|path| divergence::from_path(trace, path, periods))
            }
        };
        let diagnosed = if judge.work.goals.is_empty() {
            solution.map(|solution| self.whole_run_mistakes(judge, attempt, &solution))
        } else {
            self.settled_mistakes(judge, attempt)
        };
        (differs, diagnosed)
    }

    /// The mutant that settles at the same positions as a run with goals that reached its end.
    fn settled_mistakes(
        &self,
        judge: &MotionJudge<'_>,
        attempt: &Attempt<Trace>,
    ) -> Option<Diagnosed> {
        if attempt.ended.is_some() {
            return None;
        }
        let mutants = self
            .mutants_of(judge.task)
            .map(|mutant| (mutant, self.mutant_run(judge, mutant)));
        let student = Settled::of(judge.work, &attempt.recorded);
        let band = judge.pose_band;
        Some(diagnose::motion_task(judge.work, band, &student, mutants))
    }

    /// The run of a mutant to its end, as far as comparisons need it.
    fn mutant_run(&self, judge: &MotionJudge<'_>, mutant: &Mutant) -> Arc<MutantRun> {
        let make = || {
            let run = self.staff_run(
                judge,
                StaffSubmission::Mutant(mutant.name.clone()),
                &mutant.source,
            );
            MutantRun::of(judge.work, &run)
        };
        match self.known {
            Some(known) => known.mutant_run((&judge.task.name, &mutant.name), make),
            None => Arc::new(make()),
        }
    }

    /// Makes the run of a mutant, which is then known.
    pub(super) fn prepare_run(
        &self,
        task: &Task,
        work: &MotionTask,
        checks: &[Check<dyn MotionCheck>],
        mutant: &Mutant,
    ) {
        let judge = MotionJudge::new(self.lab, task, (work, checks), self.submission, None);
        self.mutant_run(&judge, mutant);
    }

    /// The mutant whose whole run agrees with that of a submission.
    fn whole_run_mistakes(
        &self,
        judge: &MotionJudge<'_>,
        attempt: &Attempt<Trace>,
        solution: &Attempt<Trace>,
    ) -> Diagnosed {
        let task = judge.task;
        let compared = diagnose::Compared {
            student: &attempt.recorded,
            ended: attempt.ended.as_ref(),
            reference: &solution.recorded,
            periods: judge.work.periods,
        };
        let note = |mutant: &Mutant, ended: Option<&Ended>| {
            let whose = StaffSubmission::Mutant(mutant.name.clone());
            self.note_stop(whose, task, &mutant.source, ended);
        };
        let cell = self.lab.workcell();
        let robot = judge.work.robot_of_run(cell.robot);
        let cell = Workcell {
            robot: &robot,
            ..cell
        };
        let mutants = self.mutants_of(task).map(|mutant| {
            if self.known.is_some() {
                return (mutant, Unfolding::Made(self.mutant_run(judge, mutant)));
            }
            let opening = self.opening(task, &Submission::from(&mutant.source));
            match Session::open(cell, judge.work, &opening, &mut InProcess) {
                Ok(session) => (mutant, Unfolding::Session(Box::new(session))),
                Err(attempt) => {
                    note(mutant, attempt.ended.as_ref());
                    (mutant, Unfolding::NotStarted)
                }
            }
        });
        diagnose::whole_run(compared, mutants, &note)
    }

    /// The reference solution's run of a task, if the course staff's part is present and the run reaches its end.
    fn solution_run(&self, judge: &MotionJudge<'_>) -> Option<Arc<Attempt<Trace>>> {
        let run = match &judge.of_reference.run {
            Some(run) => run.clone(),
            None => self.solution_attempt(judge)?,
        };
        run.ended.is_none().then_some(run)
    }

    /// The reference solution's run of a task, if the course staff's part is present.
    fn solution_attempt(&self, judge: &MotionJudge<'_>) -> Option<Arc<Attempt<Trace>>> {
        let solution = &self.staff?.solution;
        let make = || self.staff_run(judge, StaffSubmission::Solution, solution);
        Some(match self.known {
            Some(known) => known.solution_run(&judge.task.name, None, make),
            None => Arc::new(make()),
        })
    }

    /// The run of a submission of the course staff; an early stop is recorded.
    fn staff_run(
        &self,
        judge: &MotionJudge<'_>,
        whose: StaffSubmission,
        source: &Source,
    ) -> Attempt<Trace> {
        let run = judge.attempt_of(source);
        self.note_stop(whose, judge.task, source, run.ended.as_ref());
        run
    }

    /// The hidden runs of a task whose visible run reached its last tick.
    fn hidden(
        &self,
        judge: &MotionJudge<'_>,
        visible: &Attempt<Trace>,
        host: &mut dyn Host,
    ) -> Result<HiddenAttempts, Interrupted> {
        match self.staff {
            Some(staff) if judge.is_whole(visible, visible.ended.as_ref()) => {
                let sources = (self.submission, &staff.solution);
                let task = &judge.task.name;
                HiddenAttempts::run(&staff.runs(task), task, sources, self.known, host)
            }
            _ => Ok(HiddenAttempts::default()),
        }
    }
}

/// The verdict that checks alone leave: missed where one of them lost points, hidden runs among them.
fn missed_by(checks: &[CheckGrade]) -> Verdict {
    let is_lost = |check: &CheckGrade| !matches!(check.outcome, Outcome::Full | Outcome::AtHandIn);
    match checks.iter().any(is_lost) {
        true => Verdict::Missed,
        false => Verdict::Passed,
    }
}

/// The moment at which each check began to lose points in the visible run.
fn first_losses(judge: &MotionJudge<'_>, judged: &[JudgedCheck]) -> Vec<Option<Instant>> {
    let losses = judged
        .iter()
        .map(|judged| first_lost(judged.loss()?, &judge.work.periods));
    losses.collect()
}

/// Leads from what could not be judged, because the TCP did not stay at a goal, to the check that judges whether it does.
fn lead_to_goals(checks: &[Check<dyn MotionCheck>], judged: &mut [JudgedCheck]) {
    let judges_goals = |i: &usize| checks[*i].kind.dwell_band().is_some();
    let lost = |i: &usize| judged[*i].loss().is_some();
    let Some(goals) = (0..judged.len()).find(|i| judges_goals(i) && lost(i)) else {
        return;
    };
    for check in judged.iter_mut() {
        let loss = check.loss();
        if loss.is_some_and(|finding| finding.waits_for_goals) {
            check.look_first_at = Some(goals);
        }
    }
}

/// Says what the whole run shows at the first check that lost points, or which task to repair first, and leads there from the others. One of those that says already
/// what its curve shows stays as it is.
fn name_cause(
    judge: &MotionJudge<'_>,
    trace: &Trace,
    first_lost: &[Option<Instant>],
    unsolved: Option<&str>,
    judged: &mut [JudgedCheck],
) {
    let Some(first) = judged.iter().position(|check| check.loss().is_some()) else {
        return;
    };
    let facts = judge.facts(trace);
    let earliest = first_lost.iter().flatten().map(|lost| lost.tick as usize);
    let cause = cause::of_run(&facts, earliest.min());
    if cause.is_none() && unsolved.is_none() {
        return;
    }
    if let Some(finding) = &mut judged[first].finding {
        if let Some(cause) = cause {
            cause.explains(&facts, finding);
        }
        if let Some(task) = unsolved {
            finding.insists = true;
            finding.next_step = repair_first(task);
        }
    }
    let title = &judge.checks[first].title;
    let others = judged.iter_mut().skip(first + 1);
    for check in others.filter(|check| check.loss().is_some()) {
        if let Some(finding) = check.finding.as_mut().filter(|finding| !finding.insists) {
            check.look_first_at = Some(first);
            finding.insists = true;
            finding.next_step =
                format!("First look at \"{title}\": what is seen there may be why.");
        }
    }
}

/// The curves that checks judged.
fn curves(judged: Vec<JudgedCheck>) -> Vec<Curve> {
    let findings = judged.into_iter().filter_map(|check| check.finding);
    findings.filter_map(|finding| finding.curve).collect()
}
