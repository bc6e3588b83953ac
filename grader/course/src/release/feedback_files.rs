//! A folder a student with the feedback as text and as a page, and with the whole report where it was made: for mail, for a web space,
//! for comments that take files.

use super::feedback::Feedback;
use super::{ExportUse, Form, Made, Material, OutFile, ReleaseError};

pub(super) const FORM: Form = Form {
    name: "feedback",
    title: "Feedback: a folder a student with feedback.txt, feedback.html and the report",
    export: ExportUse::Unused,
    columns: &[],
    make,
};

fn make(material: &Material<'_>) -> Result<Made, ReleaseError> {
    let mut files = Vec::new();
    for row in material.rows {
        let Some(feedback) = Feedback::of(material, row) else {
            continue;
        };
        let folder = row.person.id.folder();
        let mut add = |name: &str, text: String| {
            files.push(OutFile {
                path: format!("{folder}/{name}"),
                bytes: text.into_bytes(),
            });
        };
        add("feedback.txt", feedback.text());
        add("feedback.html", feedback.page());
        if let Some(report) = row.report {
            add("report.html", report.to_owned());
        }
    }
    Ok(Made {
        files,
        notes: Vec::new(),
    })
}
