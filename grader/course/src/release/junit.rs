//! JUnit XML, one file a student: a suite a task, a case a check. Programs for continuous integration draw it.

use kinemark_grader::record::grade::{Outcome, TaskGrade};

use super::check_text::check_text;
use super::decided::{CheckPoints, decided};
use super::feedback::plain;
use super::number::points_text;
use super::{ExportUse, Form, Made, Material, OutFile, ReleaseError, Row};

pub(super) const FORM: Form = Form {
    name: "junit",
    title: "JUnit: an XML file a student",
    export: ExportUse::Unused,
    columns: &[],
    make,
};

/// What became of the cases of a suite.
#[derive(Default, Clone, Copy)]
struct Counts {
    tests: usize,
    failures: usize,
    errors: usize,
    skipped: usize,
}

fn make(material: &Material<'_>) -> Result<Made, ReleaseError> {
    let files = material.rows.iter().filter_map(|row| {
        Some(OutFile {
            path: format!("{}.xml", row.person.id.folder()),
            bytes: document(material, row)?.into_bytes(),
        })
    });
    Ok(Made {
        files: files.collect(),
        notes: Vec::new(),
    })
}

fn document(material: &Material<'_>, row: &Row<'_>) -> Option<String> {
    let decided = decided(row)?;
    let checks = decided.checks();
    let mut total = Counts::default();
    let mut suites = String::new();
    let tasks = decided.grade.into_iter().flat_map(|grade| &grade.tasks);
    for (i, task) in tasks.enumerate() {
        let of_task: Vec<&CheckPoints<'_>> = checks
            .iter()
            .filter(|check| check.number.0 == i + 1)
            .collect();
        suites += &suite(material, task, &of_task, &mut total);
    }
    let maximum = decided.max_points.map(points_text).unwrap_or_default();
    Some(format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"{}\"{}>\n{}{suites}</testsuites>\n",
        attribute(material.title),
        total.attributes(),
        // a suite of its own: `testsuites` has no properties
        format_args!(
            "  <testsuite name=\"points\" tests=\"0\" failures=\"0\" errors=\"0\" skipped=\"0\">\n{}  </testsuite>\n",
            properties(&points_text(decided.points), &maximum)
        )
    ))
}

fn suite(
    material: &Material<'_>,
    task: &TaskGrade,
    checks: &[&CheckPoints<'_>],
    total: &mut Counts,
) -> String {
    let mut counts = Counts::default();
    let mut cases = String::new();
    for check in checks {
        cases += &case(material, check, &mut counts);
    }
    total.add(counts);
    let earned: f64 = checks.iter().map(|check| check.points).sum();
    format!(
        "  <testsuite name=\"{}\"{}>\n{}{cases}  </testsuite>\n",
        attribute(&task.title),
        counts.attributes(),
        properties(&points_text(earned), &points_text(task.max_points)),
    )
}

fn case(material: &Material<'_>, of: &CheckPoints<'_>, counts: &mut Counts) -> String {
    counts.tests += 1;
    let check = of.check;
    let scored = format!(
        "{} of {} points",
        points_text(of.points),
        points_text(check.max_points)
    );
    let said = text(&check_text(of));
    let outcome = match check.outcome {
        // points by hand can make it full
        _ if of.points >= check.max_points => String::new(),
        Outcome::NotJudged
            if (of.task.stopped.as_ref()).is_some_and(|stopped| stopped.kept.is_none()) =>
        {
            counts.errors += 1;
            let stopped = of
                .task
                .stopped
                .as_ref()
                .map(|stopped| stopped.message.as_str());
            format!(
                "      <error message=\"{}\" type=\"{}\">{said}</error>\n",
                attribute(stopped.unwrap_or_default()),
                of.task.verdict.name()
            )
        }
        Outcome::NotJudged | Outcome::AtHandIn => {
            counts.skipped += 1;
            format!(
                "      <skipped message=\"{}\"/>\n",
                attribute(&check_text(of))
            )
        }
        Outcome::Full | Outcome::Partial | Outcome::None => {
            counts.failures += 1;
            let first = check.evidence.first().map(|fact| fact.message.as_str());
            let message =
                first.map_or_else(|| scored.clone(), |first| format!("{scored}: {first}"));
            format!(
                "      <failure message=\"{}\" type=\"points-lost\">{said}</failure>\n",
                attribute(&message)
            )
        }
    };
    format!(
        "    <testcase name=\"{}\" classname=\"{}\">\n{outcome}      <system-out>{}</system-out>\n    </testcase>\n",
        attribute(&check.title),
        attribute(&format!("{}.{}", material.lab, of.task.name)),
        text(&scored),
    )
}

fn properties(points: &str, maximum: &str) -> String {
    format!(
        "    <properties>\n      <property name=\"points\" value=\"{points}\"/>\n      <property name=\"max_points\" value=\"{maximum}\"/>\n    </properties>\n"
    )
}

impl Counts {
    fn add(&mut self, other: Self) {
        self.tests += other.tests;
        self.failures += other.failures;
        self.errors += other.errors;
        self.skipped += other.skipped;
    }

    fn attributes(self) -> String {
        format!(
            " tests=\"{}\" failures=\"{}\" errors=\"{}\" skipped=\"{}\"",
            self.tests, self.failures, self.errors, self.skipped
        )
    }
}

/// Text in an attribute.
fn attribute(value: &str) -> String {
    text(&plain(value, 300))
}

/// Text in an element: escaped, without the characters that XML 1.0 has no way to write.
fn text(value: &str) -> String {
    let mut out = String::new();
    for c in value.chars() {
        match c {
            '&' => out += "&amp;",
            '<' => out += "&lt;",
            '>' => out += "&gt;",
            '"' => out += "&quot;",
            '\n' => out += "&#10;",
            '\t' => out += "&#9;",
            c if c.is_control() || matches!(c, '\u{FFFE}' | '\u{FFFF}') => {}
            c => out.push(c),
        }
    }
    out
}

#[cfg(test)]
mod tests;
