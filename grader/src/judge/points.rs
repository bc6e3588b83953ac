//! Judging a task's checks in order: what each earned, its evidence, and the next step it names.

use crate::check::Finding;
use crate::lab::model::Check;
use crate::record::grade::{CheckGrade, Outcome};
use crate::record::graded::Curve;
use crate::record::quantity::{sum_of_points, whole_hundredths};

/// Judges the checks in order; one whose needs earned nothing, or of a task that cannot be judged, earns nothing itself.
pub(crate) fn judged(
    checks: &[Check],
    can_be_judged: bool,
    judge: impl Fn(&Check) -> Finding,
) -> Vec<(CheckGrade, Option<Curve>)> {
    let mut grades: Vec<(CheckGrade, Option<Curve>)> = Vec::new();
    for check in checks {
        let mut grade = CheckGrade {
            name: check.name.clone(),
            title: check.title.clone(),
            outcome: Outcome::NotJudged,
            points: 0.0,
            max_points: check.points,
            measure: None,
            first_lost: None,
            evidence: Vec::new(),
            next_step: None,
        };
        let mut curve = None;
        let missing = check
            .needs
            .iter()
            .find(|&&need| grades[need].0.points <= 0.0);
        match (can_be_judged, missing) {
            (false, _) => {}
            (true, Some(&need)) => {
                grade.next_step = Some(format!(
                    "First earn something in \"{}\".",
                    checks[need].title
                ));
            }
            (true, None) => {
                let mut finding = judge(check);
                // a trace of a point would be shown as none
                if finding.score < 1e-6 {
                    finding.score = 0.0;
                }
                grade.outcome = if finding.score >= 1.0 {
                    Outcome::Full
                } else if finding.score > 0.0 {
                    Outcome::Partial
                } else {
                    Outcome::None
                };
                grade.points = check.points * finding.score.clamp(0.0, 1.0);
                grade.measure = finding.measure;
                if grade.outcome != Outcome::Full {
                    grade.evidence = finding.evidence;
                    let hint = check.hint.clone().filter(|_| !finding.insists);
                    grade.next_step = Some(hint.unwrap_or(finding.next_step));
                }
                curve = finding.curve;
            }
        }
        grades.push((grade, curve));
    }
    grades
}

/// The points as they are told, whole hundredths, and their sum: so what is shown adds up, wherever it is shown.
pub(super) fn counted(checks: &mut [CheckGrade]) -> f64 {
    for check in checks.iter_mut() {
        check.points = whole_hundredths(check.points, check.max_points);
    }
    sum_of_points(checks.iter().map(|check| check.points))
}

/// Where a stop or a diagnosis explains the loss, a check's general hint would read as another one.
pub(super) fn without_hints(mut checks: Vec<CheckGrade>, explained: bool) -> Vec<CheckGrade> {
    for check in &mut checks {
        if explained && check.outcome != Outcome::NotJudged {
            check.next_step = None;
        }
    }
    checks
}

/// Where numbers that are not finite come from.
pub(super) fn not_finite_help(message: &str) -> Option<String> {
    let shown = message.contains("NaN") || message.contains("infinity");
    shown.then(|| {
        "NaN comes from `acos` or `sqrt` of a number outside their range and from 0 / 0, infinity from a division by zero".to_owned()
    })
}
