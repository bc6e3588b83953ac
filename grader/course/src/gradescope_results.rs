//! A grade as Gradescope's autograder reports it: `results.json`.
//!
//! Students see at each upload how they did in the visible cases, without a score. The checks with their scores, of which hidden cases
//! are part, show when the grades are published: a grader that returned them at each upload could be asked for every hidden case.
//!
//! Source: Gradescope's autograder documentation, "Autograder Specifications".

use kinemark_grader::record::grade::{CheckGrade, Grade, Outcome, TaskGrade};
use kinemark_grader::record::quantity::points;
use kinemark_report::visible::visible;
use serde::Serialize;

/// What is shown where the grader or its machine failed; plain enough for a string in a shell script.
pub const FAILED: &str = "This upload could not be graded: the grader or its machine failed. This is not zero points. \
    Upload it again. If that does not help, write to course staff, who can see why.";

/// `results.json`.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct GradescopeResults {
    /// Points; left out where nothing is decided, because a score would be one.
    #[serde(skip_serializing_if = "Option::is_none")]
    score: Option<f64>,
    output: String,
    output_format: &'static str,
    test_output_format: &'static str,
    test_name_format: &'static str,
    /// Left out where nothing is decided: the sum of no tests would be zero.
    #[serde(skip_serializing_if = "Option::is_none")]
    tests: Option<Vec<Test>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    extra_data: Option<ExtraData>,
}

/// A line of Gradescope's list.
#[derive(Debug, Clone, PartialEq, Serialize)]
struct Test {
    name: String,
    status: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    score: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    max_score: Option<f64>,
    #[serde(skip_serializing_if = "String::is_empty")]
    output: String,
    visibility: &'static str,
}

/// What course staff find again in Gradescope's export.
#[derive(Debug, Clone, PartialEq, Serialize)]
struct ExtraData {
    engine: String,
    lab: String,
    lab_digest: String,
    submission_digest: String,
    verdict: &'static str,
}

/// One upload, graded.
#[derive(Debug, Clone, Copy)]
pub struct Upload<'a> {
    /// In the visible cases.
    pub practice: &'a Grade,
    /// In visible and hidden cases.
    pub graded: &'a Grade,
    /// Whether students see the points of hidden cases at once.
    pub hidden_at_upload: bool,
    /// What else students should know, a sentence each.
    pub notes: &'a [String],
}

impl GradescopeResults {
    /// The results of an upload that was graded; where the grader or its machine failed, those of none.
    pub fn of(upload: Upload<'_>) -> Self {
        let Upload {
            practice, graded, ..
        } = upload;
        if !practice.verdict.is_decided() || !graded.verdict.is_decided() {
            return Self::none(FAILED);
        }
        let mut tests = Vec::new();
        if !upload.hidden_at_upload {
            tests.extend(checks(practice).map(|(task, check)| seen(task, check)));
        }
        let visibility = if upload.hidden_at_upload {
            "visible"
        } else {
            "after_published"
        };
        tests.extend(checks(graded).map(|(task, check)| scored(task, check, visibility)));
        Self {
            score: Some(graded.points),
            output: output(upload),
            tests: Some(tests),
            extra_data: Some(ExtraData {
                engine: graded.engine.clone(),
                lab: graded.lab.name.clone(),
                lab_digest: graded.lab.digest.clone(),
                submission_digest: graded.submission.digest.clone(),
                verdict: graded.verdict.name(),
            }),
            ..Self::none("")
        }
    }

    /// The results of an upload that has no points, not even zero; `why` is for the student.
    pub fn none(why: &str) -> Self {
        Self {
            score: None,
            output: why.to_owned(),
            output_format: "text",
            test_output_format: "text",
            test_name_format: "text",
            tests: None,
            extra_data: None,
        }
    }
}

fn checks(grade: &Grade) -> impl Iterator<Item = (&TaskGrade, &CheckGrade)> {
    let tasks = grade.tasks.iter();
    tasks.flat_map(|task| task.checks.iter().map(move |check| (task, check)))
}

fn earned(points_earned: f64, most: f64) -> String {
    format!("{} of {}", points(points_earned), points(most))
}

/// What stands above the list.
fn output(upload: Upload<'_>) -> String {
    let Upload {
        practice, graded, ..
    } = upload;
    let shown = if upload.hidden_at_upload {
        graded
    } else {
        practice
    };
    let total = earned(shown.points, shown.max_points);
    let file = visible(&shown.submission.name);
    let mut lines = vec![if upload.hidden_at_upload {
        format!("{}: {total} points for {file}.", shown.lab.name)
    } else {
        format!(
            "{}: {total} points for {file} in the visible cases. Hidden cases count too: your points show when the grades are published.",
            shown.lab.name
        )
    }];
    if let Some(variant) = &shown.variant {
        lines.push(visible(&variant.words()).into_owned());
    }
    lines.extend(upload.notes.iter().map(|note| visible(note).into_owned()));
    for task in &shown.tasks {
        if let Some(stopped) = &task.stopped {
            let place = stopped.line.map(|line| format!(" (line {line})"));
            lines.push(format!(
                "{} stopped: {}{}",
                visible(&task.title),
                visible(&stopped.message),
                place.unwrap_or_default()
            ));
            lines.extend(stopped.help.as_deref().map(next));
        }
        for diagnosis in &task.diagnoses {
            lines.push(format!(
                "{}: likely: {}",
                visible(&task.title),
                visible(&diagnosis.says)
            ));
        }
    }
    lines.join("\n")
}

fn next(step: &str) -> String {
    format!("next: {}", visible(step))
}

/// A check in the visible cases, for information: without a score, so that the scores of the list add up to the lab's points.
fn seen(task: &TaskGrade, check: &CheckGrade) -> Test {
    Test {
        name: format!(
            "Visible cases: {} ({} points)",
            name(task, check),
            earned(check.points, check.max_points)
        ),
        score: None,
        max_score: None,
        ..scored(task, check, "visible")
    }
}

/// A check with its points.
fn scored(task: &TaskGrade, check: &CheckGrade, visibility: &'static str) -> Test {
    Test {
        name: name(task, check),
        // a check may have its points but for a hundredth, or none to have
        status: if check.outcome == Outcome::Full {
            "passed"
        } else {
            "failed"
        },
        score: Some(check.points),
        max_score: Some(check.max_points),
        output: evidence(check),
        visibility,
    }
}

fn name(task: &TaskGrade, check: &CheckGrade) -> String {
    format!("{}: {}", visible(&task.title), visible(&check.title))
}

/// Why points were lost, a line each, and the next step.
fn evidence(check: &CheckGrade) -> String {
    let mut lines = Vec::new();
    if check.outcome == Outcome::NotJudged {
        lines.push("not judged: something before it failed".to_owned());
    }
    if check.outcome == Outcome::AtHandIn {
        lines.push("judged with the reference solution, when the grades are published".to_owned());
    }
    let messages = check.evidence.iter().take(5);
    lines.extend(messages.map(|fact| visible(&fact.message).into_owned()));
    lines.extend(check.next_step.as_deref().map(next));
    lines.join("\n")
}

#[cfg(test)]
mod tests {
    use super::*;
    use kinemark_grader::record::sample;
    use kinemark_grader::record::verdict::Verdict;
    use serde_json::{Value, json};

    fn results(practice: &Grade, graded: &Grade, hidden_at_upload: bool) -> Value {
        let upload = Upload {
            practice,
            graded,
            hidden_at_upload,
            notes: &["The course uses another engine.".to_owned()],
        };
        serde_json::to_value(GradescopeResults::of(upload)).unwrap()
    }

    fn scores(results: &Value, key: &str) -> f64 {
        let tests = results["tests"].as_array().unwrap();
        tests.iter().filter_map(|test| test[key].as_f64()).sum()
    }

    #[test]
    fn students_see_visible_cases_and_no_score_of_hidden_ones() {
        let grade = sample::graded().grade;
        let results = results(&grade, &grade, false);
        let tests = results["tests"].as_array().unwrap();
        for test in tests {
            let is_shown = test["visibility"] == "visible";
            assert_eq!(is_shown, test.get("score").is_none(), "{test}");
            assert!(is_shown || test["visibility"] == "after_published");
            assert!(test["status"] == "passed" || test["status"] == "failed");
        }
        let max: f64 = grade
            .tasks
            .iter()
            .flat_map(|task| &task.checks)
            .map(|check| check.max_points)
            .sum();
        // an autograder whose maxima do not add up to the assignment's points is refused
        assert_eq!(scores(&results, "max_score"), max);
        assert_eq!(results["score"], json!(grade.points));
        let output = results["output"].as_str().unwrap();
        assert!(output.contains("in the visible cases"), "{output}");
        assert!(output.contains("The course uses another engine."));
    }

    #[test]
    fn course_staff_may_show_everything_at_once() {
        let grade = sample::graded().grade;
        let results = results(&grade, &grade, true);
        let tests = results["tests"].as_array().unwrap();
        assert!(tests.iter().all(|test| test["visibility"] == "visible"));
        assert!(tests.iter().all(|test| test.get("score").is_some()));
    }

    #[test]
    fn what_is_not_decided_is_no_score_and_no_empty_list() {
        let grade = sample::graded().grade;
        for verdict in [Verdict::HostLimit, Verdict::GraderFault] {
            let failed = Grade {
                verdict,
                ..grade.clone()
            };
            for (practice, graded) in [(&grade, &failed), (&failed, &grade)] {
                let results = results(practice, graded, false);
                assert!(results.get("score").is_none());
                assert!(results.get("tests").is_none());
                assert_eq!(results["output"], json!(FAILED));
            }
        }
        // it stands in a shell script between quotes, and in JSON
        assert!(!FAILED.contains(['\'', '"', '\\', '\n']));
    }

    #[test]
    fn text_of_a_submission_steers_nothing() {
        let mut grade = sample::graded().grade;
        grade.submission.name = "a\u{1b}[2J\u{202e}.rhai".to_owned();
        let output = results(&grade, &grade, false)["output"].to_string();
        assert!(output.contains("⟨U+001B⟩") && output.contains("⟨U+202E⟩"));
    }
}
