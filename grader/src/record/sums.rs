//! Whether a record agrees with itself: its points are the sums of those of its checks, and its verdicts follow from them. That needs
//! nothing but the record.

use serde::Serialize;

use super::grade::{CheckGrade, Grade, GradeMode, Outcome, TaskGrade, TaskKind};
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
    // hidden cases and the reference solution are parts of the same folder
    let mode = match grade.reference {
        Some(_) => GradeMode::Graded,
        None => GradeMode::Practice,
    };
    found.extend(contradiction("mode", words(grade.mode), words(mode)));
    for (i, task) in grade.tasks.iter().enumerate() {
        of_task(&format!("tasks[{i}]"), task, &mut found);
        of_mode(&format!("tasks[{i}]"), task, grade.mode, &mut found);
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
        (
            "points_at_hand_in",
            grade.points_at_hand_in,
            tasks().map(|task| task.points_at_hand_in).sum(),
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
        of_check(&format!("{dot}checks[{i}]"), check, found);
    }
    let of_checks = |at_hand_in: bool| {
        let checks = task.checks.iter();
        let checks = checks.filter(|check| (check.outcome == Outcome::AtHandIn) == at_hand_in);
        checks.map(|check| check.max_points).sum::<f64>()
    };
    let sum = sum_of_points(task.checks.iter().map(|check| check.points));
    let sums = [
        ("points", task.points, sum),
        ("max_points", task.max_points, of_checks(false)),
        ("points_at_hand_in", task.points_at_hand_in, of_checks(true)),
    ];
    found.extend(differing_sums(&dot, sums));
    let is_full = |check: &CheckGrade| matches!(check.outcome, Outcome::Full | Outcome::AtHandIn);
    let has_all = task.stopped.is_none() && task.checks.iter().all(is_full);
    let follows = match (task.verdict, has_all) {
        (Verdict::Passed, false) => Verdict::Missed,
        (Verdict::Missed, true) => Verdict::Passed,
        (verdict, _) => verdict,
    };
    found.extend(differing_verdict(&dot, task.verdict, follows));
}

fn of_check(place: &str, check: &CheckGrade, found: &mut Vec<Contradiction>) {
    let outcome = outcome_of(check);
    let outcomes = [check.outcome, outcome].map(words);
    let [recorded, follows] = outcomes;
    found.extend(contradiction(
        &format!("{place}.outcome"),
        recorded,
        follows,
    ));
    let dot = format!("{place}.");
    let hundredths = (check.points * 100.0).round() / 100.0;
    let possible = match check.points.total_cmp(&check.max_points).is_eq() {
        true => check.max_points,
        false => hundredths.clamp(0.0, check.max_points.max(0.0)),
    };
    found.extend(differing_sums(&dot, [("points", check.points, possible)]));
    // what lost nothing has no reason for it
    if outcome == Outcome::Full {
        let reasons = [
            ("evidence", !check.evidence.is_empty()),
            ("next_step", check.next_step.is_some()),
            ("first_lost", check.first_lost.is_some()),
        ];
        let reasons = reasons.into_iter().filter(|(_, is_there)| *is_there);
        found.extend(reasons.map(|(name, _)| Contradiction {
            place: format!("{dot}{name}"),
            recorded: "of lost points".to_owned(),
            follows: "none, for no points are lost".to_owned(),
        }));
    }
}

/// What a task cannot have in a mode, and how many of its hidden cases and runs there can be.
fn of_mode(place: &str, task: &TaskGrade, mode: GradeMode, found: &mut Vec<Contradiction>) {
    let mut refuse = |what: &str, recorded: String, follows: &str| {
        found.extend(contradiction(
            &format!("{place}.{what}"),
            recorded,
            follows.to_owned(),
        ));
    };
    let open = task
        .checks
        .iter()
        .position(|check| check.outcome == Outcome::AtHandIn);
    match (mode, open) {
        (GradeMode::Graded, Some(i)) => {
            refuse(
                &format!("checks[{i}].outcome"),
                words(Outcome::AtHandIn),
                "a judged check",
            );
        }
        (GradeMode::Practice, _) if !task.hidden.is_empty() => {
            refuse(
                "hidden",
                format!("{} classes", task.hidden.len()),
                "none in practice",
            );
        }
        _ => {}
    }
    let is_full = task
        .checks
        .iter()
        .all(|check| check.outcome == Outcome::Full);
    for (i, class) in task.hidden.iter().enumerate() {
        // every check is full only where it is so in every run
        let least = match task.kind {
            TaskKind::Motion if is_full => class.total,
            TaskKind::Motion | TaskKind::Function => 0,
        };
        let good = class.good.max(least).min(class.total);
        refuse(
            &format!("hidden[{i}].good"),
            class.good.to_string(),
            &good.to_string(),
        );
    }
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
    let [recorded, follows] = [recorded, follows].map(|verdict| verdict.name().to_owned());
    contradiction(&format!("{place}verdict"), recorded, follows)
}

fn contradiction(place: &str, recorded: String, follows: String) -> Option<Contradiction> {
    (recorded != follows).then(|| Contradiction {
        place: place.to_owned(),
        recorded,
        follows,
    })
}

/// A value of the record as it is written there.
fn words(value: impl Serialize) -> String {
    let text = serde_json::to_string(&value).unwrap_or_default();
    text.trim_matches('"').to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::grade::{Evidence, HiddenClass, Part};
    use crate::record::sample;

    /// What a record that somebody changed says against itself, place by place.
    #[test]
    fn a_record_that_was_changed_contradicts_itself() {
        type Change = fn(&mut Grade);
        let reference = || Part {
            name: "01-kinematics".to_owned(),
            digest: "x".to_owned(),
        };
        // two warm-ups, which lose nothing
        let whole = || {
            let mut grade = sample::graded().grade;
            grade.tasks.truncate(1);
            grade.tasks.push(grade.tasks[0].clone());
            grade.verdict = Verdict::Passed;
            (grade.points, grade.max_points) = (2.0, 2.0);
            grade
        };
        assert_eq!(contradictions(&whole()), []);
        let changes: [(Change, &[&str]); 9] = [
            (|grade| grade.mode = GradeMode::Graded, &["mode"]),
            (|grade| grade.points = 3.0, &["points"]),
            (
                |grade| grade.points_at_hand_in = 3.0,
                &["points_at_hand_in"],
            ),
            (
                |grade| grade.tasks[1].max_points = 3.0,
                &["tasks[1].max_points", "max_points"],
            ),
            (
                |grade| grade.tasks[0].checks[0].points = 0.995,
                &[
                    "tasks[0].checks[0].outcome",
                    "tasks[0].checks[0].points",
                    "tasks[0].points",
                ],
            ),
            (
                |grade| grade.tasks[0].checks[0].evidence.push(Evidence::default()),
                &["tasks[0].checks[0].evidence"],
            ),
            (
                |grade| grade.tasks[1].hidden.push(class(1, 2)),
                &["tasks[1].hidden", "tasks[1].hidden[0].good"],
            ),
            (
                |grade| grade.tasks[1].hidden.push(class(3, 2)),
                &["tasks[1].hidden", "tasks[1].hidden[0].good"],
            ),
            (
                |grade| grade.tasks[0].verdict = Verdict::Missed,
                &["tasks[0].verdict", "verdict"],
            ),
        ];
        for (change, expected) in changes {
            let mut grade = whole();
            change(&mut grade);
            let found = contradictions(&grade);
            let places: Vec<&str> = found.iter().map(|it| it.place.as_str()).collect();
            assert_eq!(places, expected);
        }
        let mut graded = whole();
        (graded.mode, graded.reference) = (GradeMode::Graded, Some(reference()));
        graded.tasks[0].hidden.push(class(2, 2));
        assert_eq!(contradictions(&graded), []);
        graded.tasks[0].checks[0].outcome = Outcome::AtHandIn;
        let found = contradictions(&graded);
        let mut places = found.iter().map(|it| it.place.as_str());
        assert!(places.any(|place| place == "tasks[0].checks[0].outcome"));
    }

    fn class(good: u32, total: u32) -> HiddenClass {
        HiddenClass {
            class: "elsewhere".to_owned(),
            good,
            total,
            under_resolved: 0,
        }
    }
}
