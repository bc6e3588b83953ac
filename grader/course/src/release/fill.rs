//! Filling a file of the LMS in: whose row is whose, points and comments into their cells, everything else as it was.

use std::collections::BTreeMap;

use super::decided::decided;
use super::directory::{Directory, Keys, names_of};
use super::feedback::{Feedback, is_ours};
use super::number::{Decimal, number, says};
use super::sheet::Sheet;
use super::{Material, Note, ReleaseError, Row};

/// A row of the file and what it says of a person.
pub(super) struct FileRow {
    /// The row of the sheet.
    pub(super) at: usize,
    /// Its line, from one.
    pub(super) line: usize,
    /// What it says.
    pub(super) keys: Keys,
}

/// A row of the file and the person whose it is.
pub(super) struct Matched<'a> {
    /// The row of the sheet.
    pub(super) at: usize,
    /// The person.
    pub(super) row: &'a Row<'a>,
}

/// How a comment is written.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum CommentForm {
    /// As HTML.
    Html,
    /// As one line of text.
    Line,
}

/// Whose the rows of the file are; a row that is nobody's for certain, and a person without a row, are noted.
pub(super) fn matched<'a>(
    material: &Material<'a>,
    rows: &[FileRow],
    find: impl Fn(&Directory<'a>, &Keys, &BTreeMap<String, usize>) -> Result<usize, String>,
    notes: &mut Vec<Note>,
) -> Vec<Matched<'a>> {
    let directory = Directory::new(material.rows);
    let names = names_of(rows.iter().map(|row| &row.keys));
    let found: Vec<Result<usize, String>> = rows
        .iter()
        .map(|row| find(&directory, &row.keys, &names))
        .collect();
    let mut times = vec![0; material.rows.len()];
    for at in found.iter().flatten() {
        times[*at] += 1;
    }
    let mut all = Vec::new();
    for (file_row, found) in rows.iter().zip(found) {
        let found = found.and_then(|person| match times[person] {
            1 => Ok(person),
            _ => Err(format!(
                "several rows are those of {}",
                material.rows[person].person.id
            )),
        });
        match found {
            Ok(person) => all.push(Matched {
                at: file_row.at,
                row: &material.rows[person],
            }),
            Err(why) => notes.push(Note::NotInRoster {
                line: file_row.line,
                who: file_row.keys.who().to_owned(),
                why,
            }),
        }
    }
    for (person, row) in material.rows.iter().enumerate() {
        if times[person] != 1 && decided(row).is_some() {
            notes.push(Note::NotInExport {
                student: row.person.id.clone(),
            });
        }
    }
    all
}

/// The rows whose grade counts to the maximum that the LMS has there; `cell` gives the line and the text of that maximum. The others are
/// noted: points are not scaled.
///
/// # Errors
/// No grade counts to the LMS's maximum, and neither does the lab of today.
pub(super) fn with_equal_maximum<'a>(
    material: &Material<'_>,
    name: &str,
    all: Vec<Matched<'a>>,
    cell: impl Fn(&Matched<'a>) -> (usize, String),
    notes: &mut Vec<Note>,
) -> Result<Vec<Matched<'a>>, ReleaseError> {
    let mut equal = Vec::new();
    let mut others = Vec::new();
    let mut is_any_equal = false;
    for one in all {
        let (line, cell) = cell(&one);
        let ours = decided(one.row).and_then(|decided| decided.max_points);
        match (ours, number(&cell)) {
            (Some(ours), Some(theirs)) if !says(&cell, ours) => others.push((one, line, theirs)),
            (ours, theirs) => {
                is_any_equal |= ours.is_some() && theirs.is_some();
                equal.push(one);
            }
        }
    }
    if let Some((_, line, theirs)) = others.first()
        && !is_any_equal
        && (theirs - material.max_points).abs() >= 0.005
    {
        return Err(ReleaseError::Maximum {
            name: name.to_owned(),
            line: *line,
            theirs: *theirs,
            ours: material.max_points,
        });
    }
    for (one, _, theirs) in others {
        let decided = decided(one.row);
        notes.push(Note::OtherMaximum {
            student: one.row.person.id.clone(),
            points: decided.map_or(0.0, |decided| decided.points),
            maximum: decided
                .and_then(|decided| decided.max_points)
                .unwrap_or(0.0),
            theirs,
        });
    }
    Ok(equal)
}

/// Writes points into a cell, unless it says them already.
pub(super) fn put_points(
    sheet: &mut Sheet,
    matched: &Matched<'_>,
    column: usize,
    decimal: Decimal,
    notes: &mut Vec<Note>,
) {
    let Some(decided) = decided(matched.row) else {
        return;
    };
    let was = sheet.value(matched.at, column).trim().to_owned();
    if says(&was, decided.points) {
        return;
    }
    let now = decimal.cell(decided.points);
    if !matches!(was.as_str(), "" | "-") {
        notes.push(Note::Replaced {
            student: matched.row.person.id.clone(),
            was,
            now: now.clone(),
        });
    }
    sheet.set(matched.at, column, &now);
}

/// Writes the comment into a cell, unless a person wrote one there.
pub(super) fn put_comment(
    sheet: &mut Sheet,
    matched: &Matched<'_>,
    column: usize,
    form: CommentForm,
    material: &Material<'_>,
    notes: &mut Vec<Note>,
) {
    let Some(feedback) = Feedback::of(material, matched.row) else {
        return;
    };
    let student = || matched.row.person.id.clone();
    let was = sheet.value(matched.at, column);
    if !(was.trim().is_empty() || is_ours(&was)) {
        notes.push(Note::KeptComment { student: student() });
        return;
    }
    let comment = match form {
        CommentForm::Html => feedback.html(),
        CommentForm::Line => feedback.line(),
    };
    let comment = if sheet.encoding().has(&comment) {
        comment
    } else if form == CommentForm::Html {
        with_references(&comment, sheet)
    } else {
        notes.push(Note::Unencodable { student: student() });
        sheet.encoding().without_foreign(&comment)
    };
    sheet.set(matched.at, column, &comment);
}

/// HTML with a reference for each character that the file's encoding lacks.
fn with_references(html: &str, sheet: &Sheet) -> String {
    let mut all = String::new();
    for c in html.chars() {
        if sheet.encoding().has(c.encode_utf8(&mut [0; 4])) {
            all.push(c);
        } else {
            all += &format!("&#{};", u32::from(c));
        }
    }
    all
}

/// The name of a file without the folders that may stand in front.
pub(super) fn file_name(name: &str) -> String {
    let name = name.rsplit(['/', '\\']).next().unwrap_or_default();
    if name.is_empty() {
        "grades.csv".to_owned()
    } else {
        name.to_owned()
    }
}
