//! Annotations of GitHub Actions, one file a student: printed in a job, each line marks the submission where points were lost.
//!
//! GitHub shows the first ten errors and the first ten warnings of a step, so what lost most stands first.

use kinemark_grader::record::grade::{Outcome, TaskGrade};
use kinemark_report::moment::{has_lost, lost_points};

use super::decided::{CheckPoints, Decided, decided};
use super::feedback::plain;
use super::number::points_text;
use super::{ExportUse, Form, Made, Material, OutFile, ReleaseError};

pub(super) const FORM: Form = Form {
    name: "github",
    title: "GitHub: annotations for a job, one file a student",
    export: ExportUse::Unused,
    columns: &[],
    make,
};

fn make(material: &Material<'_>) -> Result<Made, ReleaseError> {
    let files = material.rows.iter().filter_map(|row| {
        Some(OutFile {
            path: format!("{}.txt", row.person.id.folder()),
            bytes: lines(material, &decided(row)?).into_bytes(),
        })
    });
    Ok(Made {
        files: files.collect(),
        notes: Vec::new(),
    })
}

fn lines(material: &Material<'_>, decided: &Decided<'_>) -> String {
    let file = decided
        .grade
        .map_or("", |grade| grade.submission.name.as_str());
    let mut all: Vec<(f64, String)> = Vec::new();
    for task in decided.grade.into_iter().flat_map(|grade| &grade.tasks) {
        all.extend(stop(file, task));
    }
    let checks = decided.checks();
    all.extend(
        checks
            .iter()
            .filter(|of| has_lost(of.check))
            .map(|of| loss(file, of)),
    );
    // stable: equal ones stay in the lab's order
    all.sort_by(|one, other| other.0.total_cmp(&one.0));
    let mut text: String = all.into_iter().map(|(_, line)| line).collect();
    let of = decided
        .max_points
        .map(|maximum| format!(" of {}", points_text(maximum)));
    text += &command(
        "notice",
        &[("title", material.title)],
        &format!(
            "{}{} points",
            points_text(decided.points),
            of.unwrap_or_default()
        ),
    );
    text
}

/// What stopped a task, at its line.
fn stop(file: &str, task: &TaskGrade) -> Option<(f64, String)> {
    let stopped = task.stopped.as_ref()?;
    let number =
        |number: Option<usize>| number.map(|number| number.to_string()).unwrap_or_default();
    let (line, column) = (number(stopped.line), number(stopped.column));
    let title = format!("{}: {}", task.title, task.verdict.name());
    let mut message = stopped.message.clone();
    if let Some(help) = &stopped.help {
        message += &format!("\nNext: {help}");
    }
    let places = [
        ("file", file),
        ("line", line.as_str()),
        ("col", column.as_str()),
        ("title", title.as_str()),
    ];
    let lost = (task.max_points - task.points).max(0.0);
    Some((lost, command("error", &places, &message)))
}

/// What a check lost: an error where it earned nothing.
fn loss(file: &str, of: &CheckPoints<'_>) -> (f64, String) {
    let check = of.check;
    let kind = match check.outcome {
        Outcome::None => "error",
        _ => "warning",
    };
    let title = format!(
        "{}, {}: {} of {} points",
        of.task.title,
        check.title,
        points_text(of.points),
        points_text(check.max_points)
    );
    let facts = check.evidence.iter().map(|fact| fact.message.clone());
    let next = check.next_step.iter().map(|next| format!("Next: {next}"));
    let hints = of.hints.iter().map(|hint| format!("Hint: {hint}"));
    let message: Vec<String> = facts.chain(next).chain(hints).collect();
    let message = if message.is_empty() {
        title.clone()
    } else {
        message.join("\n")
    };
    let line = command(kind, &[("file", file), ("title", &title)], &message);
    (lost_points(check), line)
}

/// A workflow command, one line.
///
/// Source: actions/toolkit, `core/src/command.ts`: `%`, CR and LF are escaped in the message, `:` and `,` in properties as well.
fn command(kind: &str, properties: &[(&str, &str)], message: &str) -> String {
    let properties = properties.iter().filter(|(_, value)| !value.is_empty());
    let properties: Vec<String> = properties
        .map(|(name, value)| {
            let value = escaped(&plain(value, 200))
                .replace(':', "%3A")
                .replace(',', "%2C");
            format!("{name}={value}")
        })
        .collect();
    let lines: Vec<String> = message.lines().map(|line| plain(line, 600)).collect();
    format!(
        "::{kind} {}::{}\n",
        properties.join(","),
        escaped(&lines.join("\n"))
    )
}

fn escaped(text: &str) -> String {
    text.replace('%', "%25")
        .replace('\r', "%0D")
        .replace('\n', "%0A")
}

#[cfg(test)]
mod tests;
