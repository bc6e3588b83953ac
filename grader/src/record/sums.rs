//! Whether a record agrees with itself: its points are the sums of those of its checks, and its verdicts follow from them. That needs
//! nothing but the record.

use super::grade::{CheckGrade, Grade, Outcome, TaskGrade};
use super::quantity::{points, sum_of_points};
use super::verdict::Verdict;

/// A place at which a record contradicts itself.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Contradiction {
    /// The place, such as `tasks[3].points`.
    pub place: String,
    /// What is recorded there.
    pub recorded: String,
    /// What follows from the rest of the record.
    pub follows: String,
}

/// The places at which a record contradicts itself.
pub fn contradictions(grade: &Grade) -> Vec<Contradiction> {
    let mut found = Vec::new();
    for (i, task) in grade.tasks.iter().enumerate() {
        of_task(&format!("tasks[{i}]"), task, &mut found);
    }
    let tasks = || grade.tasks.iter();
    let sums = [
        (
            "points",
            grade.points,
            sum_of_points(tasks().map(|task| task.points)),
        ),
        (
            "max_points",
            grade.max_points,
            tasks().map(|task| task.max_points).sum(),
        ),
    ];
    found.extend(differing_sums("", sums));
    let least = tasks().map(|task| task.verdict).min();
    let least = least.unwrap_or(Verdict::Passed);
    found.extend(differing_verdict("", grade.verdict, least));
    found
}

fn of_task(place: &str, task: &TaskGrade, found: &mut Vec<Contradiction>) {
    let dot = format!("{place}.");
    for (i, check) in task.checks.iter().enumerate() {
        let outcome = outcome_of(check);
        if check.outcome != outcome {
            found.push(Contradiction {
                place: format!("{dot}checks[{i}].outcome"),
                recorded: format!("{:?}", check.outcome),
                follows: format!("{outcome:?}"),
            });
        }
        let within = check.points.clamp(0.0, check.max_points);
        let place = format!("{dot}checks[{i}].");
        found.extend(differing_sums(&place, [("points", check.points, within)]));
    }
    let sum = sum_of_points(task.checks.iter().map(|check| check.points));
    found.extend(differing_sums(&dot, [("points", task.points, sum)]));
    let is_full = |check: &CheckGrade| matches!(check.outcome, Outcome::Full | Outcome::AtHandIn);
    let has_all = task.stopped.is_none() && task.checks.iter().all(is_full);
    let follows = match (task.verdict, has_all) {
        (Verdict::Passed, false) => Verdict::Missed,
        (Verdict::Missed, true) => Verdict::Passed,
        (verdict, _) => verdict,
    };
    found.extend(differing_verdict(&dot, task.verdict, follows));
}

/// The outcome that goes with the points of a check.
fn outcome_of(check: &CheckGrade) -> Outcome {
    let has_none = points(check.points) == points(0.0);
    match check.outcome {
        Outcome::Full if check.points < check.max_points && has_none => Outcome::None,
        Outcome::Full if check.points < check.max_points => Outcome::Partial,
        Outcome::None | Outcome::NotJudged | Outcome::AtHandIn if !has_none => Outcome::Partial,
        outcome => outcome,
    }
}

fn differing_sums<const N: usize>(place: &str, sums: [(&str, f64, f64); N]) -> Vec<Contradiction> {
    // a sum of hundredths has a rounding error, and nothing else
    let differ = sums
        .into_iter()
        .filter(|(_, recorded, sum)| (recorded - sum).abs().total_cmp(&1e-6).is_gt());
    let contradictions = differ.map(|(name, recorded, sum)| Contradiction {
        place: format!("{place}{name}"),
        recorded: points(recorded),
        follows: points(sum),
    });
    contradictions.collect()
}

fn differing_verdict(place: &str, recorded: Verdict, follows: Verdict) -> Option<Contradiction> {
    (recorded != follows).then(|| Contradiction {
        place: format!("{place}verdict"),
        recorded: recorded.name().to_owned(),
        follows: follows.name().to_owned(),
    })
}
