//! Canvas: one column of the course's own gradebook export filled in. Everything else stays as it is, because Canvas takes every cell of
//! the file for a change, and an unknown header for a new assignment.

use super::decided::decided;
use super::directory::Keys;
use super::fill::{FileRow, Matched, file_name, matched, put_points, with_equal_maximum};
use super::number::{Decimal, number};
use super::sheet::Sheet;
use super::{Column, ExportUse, Form, Made, Material, Note, OutFile, ReleaseError};
use crate::standing::Status;
use crate::student::{StudentId, folded};

pub(super) const FORM: Form = Form {
    name: "canvas",
    title: "Canvas: the gradebook export with one column filled in",
    export: ExportUse::Required(
        "the course's gradebook (Grades > Export > Export Entire Gradebook)",
    ),
    columns: &[Column::Points],
    make,
};

/// What Canvas writes for somebody whom the lab does not count for.
const EXCUSED: &str = "EX";
/// What Canvas writes where an assignment is not given to somebody.
const NOT_ASSIGNED: &str = "N/A";

/// Where the columns that say who it is are.
struct Identity {
    name: Vec<usize>,
    lms_id: usize,
    sis_id: Option<usize>,
    login: Option<usize>,
}

fn make(material: &Material<'_>) -> Result<Made, ReleaseError> {
    let Some(export) = material.export else {
        return Ok(Made::default());
    };
    let mut sheet = Sheet::read(export.name, export.bytes)?;
    let identity = identity(&sheet)?;
    let column = column(&sheet, material)?;
    sheet.check_widths()?;
    let possible = possible(&sheet, column)?;
    let rows: Vec<FileRow> = sheet
        .below_header()
        .filter(|row| is_student(&sheet, *row))
        .map(|at| FileRow {
            at,
            line: sheet.line(at),
            keys: keys(&sheet, at, &identity),
        })
        .collect();
    let mut notes = Vec::new();
    let mut all = matched(
        material,
        &rows,
        |people, keys, names| people.find(keys, names),
        &mut notes,
    );
    // the student that Canvas makes for previews
    notes.retain(|note| !matches!(note, Note::NotInRoster { who, .. } if who == "Student, Test"));
    if let Some(possible) = possible {
        all = with_equal_maximum(material, export.name, all, |_| possible.clone(), &mut notes)?;
    }
    let decimal = decimal(&sheet, column);
    for one in &all {
        put(&mut sheet, one, column, decimal, &mut notes);
    }
    let is_in = |id: &StudentId| all.iter().any(|one| one.row.person.id == *id);
    for row in material.rows {
        if row.standing.status == Status::Excused && !is_in(&row.person.id) {
            notes.push(Note::NotInExport {
                student: row.person.id.clone(),
            });
        }
    }
    Ok(Made {
        files: vec![OutFile {
            path: file_name(export.name),
            bytes: sheet.bytes(),
        }],
        notes,
    })
}

/// The line and the text of the column's maximum, where the gradebook has it.
///
/// # Errors
/// A column that Canvas computes.
fn possible(sheet: &Sheet, column: usize) -> Result<Option<(usize, String)>, ReleaseError> {
    let Some(row) = points_possible(sheet) else {
        return Ok(None);
    };
    let cell = sheet.value(row, column).trim().to_owned();
    if number(&cell).is_none() && !cell.is_empty() {
        return Err(ReleaseError::ReadOnly {
            name: sheet.name().to_owned(),
            column: sheet.headers().swap_remove(column),
        });
    }
    Ok(Some((sheet.line(row), cell)))
}

/// Writes points, or that the lab does not count. What Canvas says of somebody without points is kept.
fn put(
    sheet: &mut Sheet,
    one: &Matched<'_>,
    column: usize,
    decimal: Decimal,
    notes: &mut Vec<Note>,
) {
    let was = sheet.value(one.at, column).trim().to_owned();
    let student = || one.row.person.id.clone();
    let is_excused = one.row.standing.status == Status::Excused;
    let has_points = decided(one.row).is_some();
    match was.to_ascii_uppercase().as_str() {
        NOT_ASSIGNED if is_excused || has_points => {
            notes.push(Note::NotAssigned { student: student() });
        }
        EXCUSED if has_points => notes.push(Note::ExcusedThere { student: student() }),
        NOT_ASSIGNED | EXCUSED => {}
        _ if !is_excused => put_points(sheet, one, column, decimal, notes),
        _ => {
            sheet.set(one.at, column, EXCUSED);
            if !was.is_empty() {
                notes.push(Note::Replaced {
                    student: student(),
                    was,
                    now: EXCUSED.to_owned(),
                });
            }
        }
    }
}

fn identity(sheet: &Sheet) -> Result<Identity, ReleaseError> {
    let one = |name: &str| sheet.column(name, &[name]);
    let no_gradebook = |wanted: &str| {
        sheet.no_column(
            wanted,
            "export the gradebook from Canvas again: this is not its header",
        )
    };
    let name = match (one("Student")?, one("FirstName")?, one("LastName")?) {
        (Some(name), ..) => vec![name],
        (None, Some(first), Some(last)) => vec![first, last],
        _ => return Err(no_gradebook("`Student`")),
    };
    Ok(Identity {
        name,
        lms_id: one("ID")?.ok_or_else(|| no_gradebook("`ID`"))?,
        sis_id: one("SIS User ID")?,
        login: one("SIS Login ID")?,
    })
}

/// The column of the assignment: the one that was named by header, title or number, or the only one whose title holds the lab's title
/// or name.
fn column(sheet: &Sheet, material: &Material<'_>) -> Result<usize, ReleaseError> {
    let headers = sheet.headers();
    let assignments: Vec<(usize, &str, &str)> = headers
        .iter()
        .enumerate()
        .filter_map(|(at, header)| {
            let (title, id) = title_and_id(header)?;
            Some((at, title, id))
        })
        .collect();
    let found: Vec<usize> = match material.columns.points {
        Some(named) => {
            let exact = headers.iter().position(|header| header == named.trim());
            let same = |text: &str| folded(text) == folded(named);
            match exact {
                Some(at) if assignments.iter().any(|(other, ..)| *other == at) => vec![at],
                Some(_) => {
                    return Err(ReleaseError::ReadOnly {
                        name: sheet.name().to_owned(),
                        column: named.to_owned(),
                    });
                }
                None => {
                    let fits = assignments
                        .iter()
                        .filter(|(_, title, id)| same(title) || same(id));
                    fits.map(|(at, ..)| *at).collect()
                }
            }
        }
        None => {
            let (title, name) = (folded(material.title), folded(material.lab));
            let holds = |text: &str| {
                let text = folded(text);
                [&title, &name]
                    .into_iter()
                    .any(|part| !part.is_empty() && text.contains(part.as_str()))
            };
            let fits = assignments.iter().filter(|(_, title, _)| holds(title));
            fits.map(|(at, ..)| *at).collect()
        }
    };
    let wanted = match material.columns.points {
        Some(named) => format!("`{named}`"),
        None => format!("the lab ({} or {})", material.title, material.lab),
    };
    let shown = |columns: &mut dyn Iterator<Item = usize>| -> Vec<String> {
        columns.map(|at| headers[at].clone()).collect()
    };
    match found[..] {
        [one] => Ok(one),
        [] => Err(ReleaseError::NoColumn {
            name: sheet.name().to_owned(),
            wanted,
            found: shown(&mut assignments.iter().map(|(at, ..)| *at)),
            help: "name the assignment's column with --column \"TITLE (ID)\"; where it is not there, make the assignment in Canvas and export again"
                .to_owned(),
        }),
        ref several => Err(ReleaseError::SeveralColumns {
            name: sheet.name().to_owned(),
            wanted,
            found: shown(&mut several.iter().copied()),
        }),
    }
}

/// The title and the number of an assignment's header, `TITLE (ID)`.
fn title_and_id(header: &str) -> Option<(&str, &str)> {
    let (title, id) = header.strip_suffix(')')?.rsplit_once(" (")?;
    let is_number = !id.is_empty() && id.chars().all(|c| c.is_ascii_digit());
    is_number.then_some((title, id))
}

/// The row `    Points Possible`.
fn points_possible(sheet: &Sheet) -> Option<usize> {
    sheet
        .below_header()
        .find(|row| sheet.value(*row, 0).contains("Points Possible"))
}

/// Whether a row is a student's: not the maxima, and not the row that says which assignments are posted by hand.
fn is_student(sheet: &Sheet, row: usize) -> bool {
    let is_posting = |cell: &str| {
        let cell = cell.trim().to_lowercase();
        cell.is_empty() || cell == "muted" || cell.starts_with("manual posting")
    };
    let mut cells = (0..sheet.headers().len()).map(|at| sheet.value(row, at));
    let is_maxima = sheet.value(row, 0).contains("Points Possible");
    !is_maxima && !cells.all(|cell| is_posting(&cell))
}

fn keys(sheet: &Sheet, row: usize, identity: &Identity) -> Keys {
    let cell = |at: usize| sheet.value(row, at).trim().to_owned();
    let name: Vec<String> = identity.name.iter().map(|at| cell(*at)).collect();
    Keys {
        lms_id: cell(identity.lms_id),
        id: identity.sis_id.map(cell).unwrap_or_default(),
        email: String::new(),
        login: identity.login.map(cell).unwrap_or_default(),
        name: name.join(" "),
    }
}

/// The decimal sign of the column, else of the whole file; where no number has decimals, a comma where cells are apart by semicolons.
fn decimal(sheet: &Sheet, column: usize) -> Decimal {
    let of = |columns: std::ops::Range<usize>| {
        let cells: Vec<String> = sheet
            .below_header()
            .flat_map(|row| columns.clone().map(move |at| (row, at)))
            .map(|(row, at)| sheet.value(row, at).into_owned())
            .collect();
        Decimal::of_cells(cells.iter().map(String::as_str))
    };
    let is_comma = sheet.delimiter() == ';';
    of(column..column + 1)
        .or_else(|| {
            // names, ids and sections stand before the first assignment
            let headers = sheet.headers();
            let first = headers
                .iter()
                .position(|header| title_and_id(header).is_some());
            of(first.unwrap_or(headers.len())..headers.len())
        })
        .unwrap_or(if is_comma {
            Decimal::Comma
        } else {
            Decimal::Point
        })
}

#[cfg(test)]
mod tests;
