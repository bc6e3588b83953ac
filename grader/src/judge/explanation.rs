//! A grade explained to the course staff: the submission graded once more on every hidden case and run with nothing withheld.

use super::Interrupted;
use super::exposed::{ExposedLab, expose};
use super::grader::{Grader, TaskScores, grade};
use super::hidden_attempts::counted_score;
use super::single_case::SingleCase;
use crate::check::{Criterion, Finding};
use crate::lab::{Lab, Staff, Task, TaskWork};
use crate::record::explanation::{
    DrawCheck, ExplainedAttempt, ExplainedDraw, ExplainedTask, Explanation,
};
use crate::record::grade::{CheckGrade, Outcome, TaskKind};
use crate::record::graded::GradedRun;
use crate::record::verdict::Verdict;
use crate::submission::handed_in::Submission;
use crate::submission::host::{Host, InProcess};

/// Grades `submission` as [`grade`] does, and once more on everything hidden. Hidden numbers are the same, and so are the calls of a
/// function task and their order: what was graded is explained.
///
/// # Errors
/// [`Interrupted`] if the host says so.
pub fn explain(
    lab: &Lab,
    staff: &Staff,
    submission: &Submission,
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
    Ok(Explanation {
        graded,
        tasks,
        hints: lab.hints(),
    })
}

/// What every exposed lab is graded with.
struct Exposition<'a> {
    staff: &'a Staff,
    /// The course staff's part with nothing hidden.
    open: Staff,
    submission: &'a Submission,
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
        let solution = Submission::from(&self.staff.solution);
        let mut reference = grade(&exposed.lab, Some(&self.open), &solution, &mut InProcess)?;
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
        Ok(ExplainedAttempt { graded, draws })
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
        let reached = of_solution.and_then(|task| value(task.checks.get(i)?));
        DrawCheck {
            bounds: bounds_at(exposed.task(), i, reached).unwrap_or(check.bounds.clone()),
            score: was_judged.then_some(score),
            counted: Some(counted_score(score)),
            measure: judged.and_then(|check| check.measure.clone()),
            reference: reached,
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

/// What earns all points and what earns none of a check of a motion task whose band depends on the reference, which reaches this value.
fn bounds_at(task: &Task, check: usize, reached: Option<f64>) -> Option<[String; 2]> {
    let TaskWork::Motion(_, checks) = &task.work else {
        return None;
    };
    let fixed = checks.get(check)?.kind.at_reference(reached?)?;
    Some(fixed.bounds())
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
