//! A grade explained to the course staff: the submission graded once more on every hidden case and run with nothing withheld.

use kinemark_sim::text::Source;
use serde::Serialize;

use super::Interrupted;
use super::exposed::{ExposedLab, HiddenDraw, expose};
use super::grader::{Grader, TaskScores, grade};
use super::hidden_attempts::counted_score;
use super::single_case::SingleCase;
use crate::check::{Criterion, Finding};
use crate::lab::{Lab, Staff, Task, TaskWork};
use crate::record::grade::{CaseGrade, CheckGrade, Evidence, Measure, Outcome, Stopped, TaskKind};
use crate::record::graded::GradedRun;
use crate::record::quantity::with_unit_unlike;
use crate::record::verdict::Verdict;
use crate::submission::host::{Host, InProcess};

/// A grade with everything that is hidden in it. It is for the course staff: it has hidden numbers and the reference solution's runs.
#[derive(Debug, Clone)]
pub struct Explanation {
    /// The grade, made again: equal to the record of it where engine, lab and submission are the same.
    pub graded: GradedRun,
    /// The tasks with hidden cases or runs, in the lab's order.
    pub tasks: Vec<ExplainedTask>,
}

/// A task with hidden cases or runs.
#[derive(Debug, Clone)]
pub struct ExplainedTask {
    /// Its name.
    pub name: String,
    /// Its title.
    pub title: String,
    /// Its kind.
    pub kind: TaskKind,
    /// The share of points of each check before it is rounded, in `[0, 1]`: of a motion task in the visible run alone, of a function
    /// task over all cases.
    pub scores: Vec<f64>,
    /// Whether the hidden ones count in the grade. Hidden runs do not if the visible run did not reach its end.
    pub counts: bool,
    /// All cases of a function task as one attempt; each hidden run as one.
    pub attempts: Vec<ExplainedAttempt>,
}

/// An attempt at an exposed lab.
#[derive(Debug, Clone)]
pub struct ExplainedAttempt {
    /// The lab, of this task alone.
    pub lab: Lab,
    /// The grade in that lab, with the reference solution's motion in its runs.
    pub graded: GradedRun,
    /// The hidden cases, or the one hidden run.
    pub draws: Vec<ExplainedDraw>,
}

/// A hidden case or run with what the submission made of it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ExplainedDraw {
    /// The case or run.
    pub draw: HiddenDraw,
    /// Whether it counts as good in its class.
    pub good: bool,
    /// Of a case: answer, expected answer and error.
    pub case: Option<CaseGrade>,
    /// Of a case of inverse kinematics: the distance of each answered branch from the target, in the order of the answer \[m\].
    pub branches_m: Vec<f64>,
    /// The stop of the submission in it.
    pub stopped: Option<Stopped>,
    /// Its checks, in the lab's order.
    pub checks: Vec<DrawCheck>,
}

/// A check in one hidden case or run.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct DrawCheck {
    /// Its name.
    pub name: String,
    /// Its title.
    pub title: String,
    /// What earns all points and what earns none, in words.
    pub bounds: [String; 2],
    /// The share of its points; `None` where it was not judged, or does not look at such a case.
    pub score: Option<f64>,
    /// The share that goes into the points: that of a run is rounded down to twentieths. The points of a function task are made from
    /// all its cases, so a case has no share of its own.
    pub counted: Option<f64>,
    /// What was measured, with its band.
    pub measure: Option<Measure>,
    /// The value of the reference solution in the same run.
    pub reference: Option<f64>,
    /// Why points were lost.
    pub evidence: Vec<Evidence>,
}

impl DrawCheck {
    /// Whether points were lost in it, or it was not judged in a run.
    pub fn is_lost(&self) -> bool {
        self.counted.or(self.score).is_some_and(|score| score < 1.0)
    }

    /// What was measured in words: of a run the value, of a case what is wrong with the answer.
    pub fn words(&self) -> String {
        let of_run = self.measure.as_ref().filter(|_| self.counted.is_some());
        if let Some(measure) = of_run {
            let value = measure.value.map_or_else(
                || "nothing to measure".to_owned(),
                |value| with_unit_unlike(value, measure.full, &measure.unit),
            );
            return format!("{}: {value}", measure.quantity);
        }
        match (self.evidence.first(), self.score) {
            (Some(fact), _) => fact.message.clone(),
            (None, Some(_)) => "right".to_owned(),
            (None, None) => "not judged".to_owned(),
        }
    }
}

impl ExplainedTask {
    /// Its hidden cases or runs by class, classes in the order of their first draw.
    pub fn classes(&self) -> Vec<(&str, Vec<&ExplainedDraw>)> {
        let mut classes: Vec<(&str, Vec<&ExplainedDraw>)> = Vec::new();
        for draw in self.attempts.iter().flat_map(|attempt| &attempt.draws) {
            let class = draw.draw.class.as_str();
            match classes.iter_mut().find(|(known, _)| *known == class) {
                Some((_, draws)) => draws.push(draw),
                None => classes.push((class, vec![draw])),
            }
        }
        classes
    }
}

impl Explanation {
    /// All hidden cases and runs, in the order of tasks and draws.
    pub fn draws(&self) -> impl Iterator<Item = &ExplainedDraw> {
        let attempts = self.tasks.iter().flat_map(|task| &task.attempts);
        attempts.flat_map(|attempt| &attempt.draws)
    }
}

/// Grades `submission` as [`grade`] does, and once more on everything hidden. Hidden numbers are the same, and so are the calls of a
/// function task and their order: what was graded is explained.
///
/// # Errors
/// [`Interrupted`] if the host says so.
pub fn explain(
    lab: &Lab,
    staff: &Staff,
    submission: &Source,
    host: &mut dyn Host,
) -> Result<Explanation, Interrupted> {
    let (graded, scores) = Grader::new(lab, Some(staff), submission).graded(host)?;
    let passed = graded
        .grade
        .tasks
        .iter()
        .filter(|task| task.kind == TaskKind::Function && task.verdict == Verdict::Passed);
    let open = Exposition {
        staff,
        open: staff.without_hidden(),
        submission,
        passed: passed.map(|task| task.name.clone()).collect(),
    };
    let mut tasks = Vec::new();
    for ((task, record), scores) in lab.tasks.iter().zip(&graded.grade.tasks).zip(scores) {
        // a solution without an answer is a fault that the grade already has
        let exposed = expose(lab, staff, task).unwrap_or_default();
        if exposed.is_empty() {
            continue;
        }
        let attempts = exposed
            .into_iter()
            .map(|exposed| open.attempt(exposed, host));
        tasks.push(ExplainedTask {
            name: task.name.clone(),
            title: task.title.clone(),
            kind: record.kind,
            scores: scores.checks,
            counts: !record.hidden.is_empty(),
            attempts: attempts.collect::<Result<_, _>>()?,
        });
    }
    Ok(Explanation { graded, tasks })
}

/// What every exposed lab is graded with.
struct Exposition<'a> {
    staff: &'a Staff,
    /// The course staff's part with nothing hidden.
    open: Staff,
    submission: &'a Source,
    /// Function tasks that passed in the grade.
    passed: Vec<String>,
}

impl Exposition<'_> {
    fn attempt(
        &self,
        exposed: ExposedLab,
        host: &mut dyn Host,
    ) -> Result<ExplainedAttempt, Interrupted> {
        let mut grader = Grader::new(&exposed.lab, Some(&self.open), self.submission);
        grader.passed.clone_from(&self.passed);
        grader.judges_each_case = true;
        let (mut graded, mut scores) = grader.graded(host)?;
        let solution = &self.staff.solution;
        let mut reference = grade(&exposed.lab, None, solution, &mut InProcess)?;
        for (run, of_solution) in graded.runs.iter_mut().zip(reference.runs.drain(..)) {
            let task = reference.grade.tasks.first();
            // a solution that stops early is nothing to compare with
            let is_whole = task.is_some_and(|task| task.stopped.is_none());
            run.reference_overlay = is_whole.then_some(of_solution.trace);
        }
        let draws = match &exposed.task().work {
            TaskWork::Function(..) => {
                let first = exposed.visible_cases();
                let scores = scores
                    .first_mut()
                    .map(|scores| scores.cases.split_off(first));
                cases(&exposed, &mut graded, scores.unwrap_or_default())
            }
            TaskWork::Motion(..) => run(&exposed, &graded, &reference, scores.first()),
        };
        Ok(ExplainedAttempt {
            lab: exposed.lab,
            graded,
            draws,
        })
    }
}

/// The hidden cases of a function task. Their expected answers, which a record leaves out where they are answers to the task, are added
/// to the record.
fn cases(
    exposed: &ExposedLab,
    graded: &mut GradedRun,
    scores: Vec<SingleCase>,
) -> Vec<ExplainedDraw> {
    let first = exposed.visible_cases();
    let Some(task) = graded.grade.tasks.first_mut() else {
        return Vec::new();
    };
    let stopped = task.stopped.as_ref();
    let shown = exposed.draws.iter().zip(&mut task.cases[first..]);
    let draws = shown.zip(scores).map(|((draw, case), single)| {
        case.expected.clone_from(&draw.expected);
        ExplainedDraw {
            draw: draw.clone(),
            good: case.good,
            stopped: stopped
                .filter(|stopped| stopped.case.as_deref() == Some(case.name.as_str()))
                .cloned(),
            case: Some(case.clone()),
            checks: case_checks(exposed.task(), &case.name, &single),
            branches_m: single.branches_m,
        }
    });
    draws.collect()
}

/// The checks of the case called `name`, whose evidence need not name it.
fn case_checks(task: &Task, name: &str, single: &SingleCase) -> Vec<DrawCheck> {
    let head = format!("{name}: ");
    let evidence = |finding: &Finding| {
        let mut evidence = finding.evidence.clone();
        for fact in &mut evidence {
            if let Some(message) = fact.message.strip_prefix(&head) {
                fact.message = message.to_owned();
            }
        }
        evidence
    };
    let checks = task.checks().into_iter().zip(&single.findings);
    let checks = checks.map(|(check, finding)| DrawCheck {
        score: finding.as_ref().map(|finding| finding.score),
        measure: finding.as_ref().and_then(|finding| finding.measure.clone()),
        evidence: finding.as_ref().map_or_else(Vec::new, evidence),
        ..unjudged(check)
    });
    checks.collect()
}

/// The hidden run of a motion task.
fn run(
    exposed: &ExposedLab,
    graded: &GradedRun,
    reference: &GradedRun,
    scores: Option<&TaskScores>,
) -> Vec<ExplainedDraw> {
    let (Some(draw), Some(record), Some(scores)) =
        (exposed.draws.first(), graded.grade.tasks.first(), scores)
    else {
        return Vec::new();
    };
    let of_solution = reference.grade.tasks.first();
    let task = exposed.task().checks();
    let checks = task.into_iter().enumerate().map(|(i, check)| {
        let judged = record.checks.get(i);
        let value = |grade: &CheckGrade| grade.measure.as_ref().and_then(|measure| measure.value);
        let score = scores.checks.get(i).copied().unwrap_or(0.0);
        let was_judged = judged.is_some_and(|check| check.outcome != Outcome::NotJudged);
        DrawCheck {
            score: was_judged.then_some(score),
            counted: Some(counted_score(score)),
            measure: judged.and_then(|check| check.measure.clone()),
            reference: of_solution.and_then(|task| value(task.checks.get(i)?)),
            evidence: judged.map_or_else(Vec::new, |check| check.evidence.clone()),
            ..unjudged(check)
        }
    });
    vec![ExplainedDraw {
        draw: draw.clone(),
        good: scores.checks.iter().all(|score| *score >= 1.0),
        case: None,
        branches_m: Vec::new(),
        stopped: record.stopped.clone(),
        checks: checks.collect(),
    }]
}

/// A check that found nothing.
fn unjudged(check: &Criterion) -> DrawCheck {
    DrawCheck {
        name: check.name.clone(),
        title: check.title.clone(),
        bounds: check.bounds.clone(),
        score: None,
        counted: None,
        measure: None,
        reference: None,
        evidence: Vec::new(),
    }
}
