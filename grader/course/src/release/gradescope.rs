//! Gradescope: `results.json` of each student's submission, as an autograder writes it.
//!
//! Every test is visible, because a hidden one hides the total. Hidden cases are counted by class in the text.

use kinemark_grader::record::grade::{TaskGrade, TaskKind};
use serde::Serialize;

use super::check_text::check_text;
use super::decided::{CheckPoints, Decided, decided};
use super::feedback::{Feedback, plain};
use super::{ExportUse, Form, Made, Material, OutFile, ReleaseError};

pub(super) const FORM: Form = Form {
    name: "gradescope",
    title: "Gradescope: results.json in a folder a student",
    export: ExportUse::Unused,
    columns: &[],
    make,
};

/// Source: Gradescope, *Autograder Specifications*, "Output format".
#[derive(Serialize)]
struct Results {
    /// Stands above the sum of the tests, to which points by hand for the total do not belong.
    score: f64,
    output: String,
    output_format: &'static str,
    test_output_format: &'static str,
    test_name_format: &'static str,
    visibility: &'static str,
    stdout_visibility: &'static str,
    tests: Vec<Test>,
}

#[derive(Serialize)]
struct Test {
    score: f64,
    max_score: f64,
    status: &'static str,
    name: String,
    number: String,
    output: String,
    visibility: &'static str,
}

fn make(material: &Material<'_>) -> Result<Made, ReleaseError> {
    let mut files = Vec::new();
    for row in material.rows {
        let (Some(decided), Some(feedback)) = (decided(row), Feedback::of(material, row)) else {
            continue;
        };
        let results = results(&decided, feedback.text());
        // numbers and text alone cannot fail to be written
        let mut bytes = serde_json::to_vec_pretty(&results).unwrap_or_default();
        bytes.push(b'\n');
        files.push(OutFile {
            path: format!("{}/results.json", row.person.id.folder()),
            bytes,
        });
    }
    Ok(Made {
        files,
        notes: Vec::new(),
    })
}

fn results(decided: &Decided<'_>, feedback: String) -> Results {
    let tasks = decided.grade.into_iter().flat_map(|grade| &grade.tasks);
    let hidden: Vec<String> = tasks.filter_map(hidden).collect();
    Results {
        score: decided.points,
        output: format!("{feedback}{}", hidden.concat()),
        output_format: "text",
        test_output_format: "text",
        test_name_format: "text",
        visibility: "visible",
        stdout_visibility: "hidden",
        tests: decided.checks().iter().map(test).collect(),
    }
}

/// Hidden cases of a task by class: how many were good.
fn hidden(task: &TaskGrade) -> Option<String> {
    let what = match task.kind {
        TaskKind::Function => "cases",
        TaskKind::Motion => "runs",
    };
    let classes = task.hidden.iter();
    let classes: Vec<String> = classes
        .map(|class| format!("{} {}/{}", plain(&class.class, 80), class.good, class.total))
        .collect();
    (!classes.is_empty()).then(|| {
        format!(
            "{}, hidden {what}: {}\n",
            plain(&task.title, 80),
            classes.join(", ")
        )
    })
}

fn test(of: &CheckPoints<'_>) -> Test {
    let (task, check) = (of.task, of.check);
    let (task_number, check_number) = of.number;
    Test {
        score: of.points,
        max_score: check.max_points,
        status: if of.points >= check.max_points {
            "passed"
        } else {
            "failed"
        },
        name: format!("{}: {}", plain(&task.title, 80), plain(&check.title, 120)),
        number: format!("{task_number}.{check_number}"),
        output: check_text(of),
        visibility: "visible",
    }
}

#[cfg(test)]
mod tests;
