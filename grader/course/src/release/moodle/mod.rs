//! Moodle: the course's own grading worksheet filled in, and the zip of feedback files in the folders of Moodle's export.

mod feedback_zip;
mod headers;

use self::headers::{Field, LANGUAGES, Language};
use super::directory::Keys;
use super::fill::{
    CommentForm, FileRow, Matched, matched, put_comment, put_points, with_equal_maximum,
};
use super::number::{Decimal, number};
use super::sheet::Sheet;
use super::{Column, ExportUse, Form, Made, Material, Note, OutFile, ReleaseError};
use crate::release::decided::decided;

pub(super) const FORM: Form = Form {
    name: "moodle",
    title: "Moodle: the grading worksheet filled in, and a zip of feedback files",
    export: ExportUse::Required(
        "the assignment's grading worksheet (Submissions > Actions > Download grading worksheet)",
    ),
    columns: &[Column::Id, Column::Points, Column::Comment],
    make,
};

/// What to do about a worksheet whose headers are not known.
const OTHER_LANGUAGE: &str =
    "download the worksheet with Moodle in English, and upload it in English too";

/// Where the columns of a worksheet are.
struct Places {
    language: &'static Language,
    identifier: usize,
    grade: usize,
    full_name: Option<usize>,
    email: Option<usize>,
    id_number: Option<usize>,
    username: Option<usize>,
    maximum: Option<usize>,
    feedback: Option<usize>,
}

fn make(material: &Material<'_>) -> Result<Made, ReleaseError> {
    let Some(export) = material.export else {
        return Ok(Made::default());
    };
    let mut sheet = Sheet::read(export.name, export.bytes)?;
    let places = places(&sheet, material)?;
    sheet.check_widths()?;
    let mut notes = Vec::new();
    let rows: Vec<FileRow> = sheet
        .below_header()
        .map(|at| FileRow {
            at,
            line: sheet.line(at),
            keys: keys(&sheet, at, &places),
        })
        .collect();
    let mut all = matched(
        material,
        &rows,
        |people, keys, names| people.find(keys, names),
        &mut notes,
    );
    if let Some(column) = places.maximum {
        let cell = |one: &Matched<'_>| {
            let cell = sheet.value(one.at, column);
            (sheet.line(one.at), cell.into_owned())
        };
        all = with_equal_maximum(material, export.name, all, cell, &mut notes)?;
    }
    let decimal = decimal(&sheet, &places);
    for one in &all {
        put_grade(&mut sheet, one, &places, decimal, &mut notes);
        if let Some(column) = places.feedback {
            put_comment(
                &mut sheet,
                one,
                column,
                CommentForm::Html,
                material,
                &mut notes,
            );
        }
    }
    let folders = all.iter().filter_map(|one| {
        let name = places
            .full_name
            .map(|at| sheet.value(one.at, at).into_owned());
        let number = participant(&sheet.value(one.at, places.identifier))?;
        let folder = feedback_zip::folder(&name.unwrap_or_default(), &number);
        Some((folder, one.row))
    });
    let zip = feedback_zip::of(material, folders)?;
    let files = vec![
        OutFile {
            path: super::fill::file_name(export.name),
            bytes: sheet.bytes(),
        },
        OutFile {
            path: "feedback.zip".to_owned(),
            bytes: zip,
        },
    ];
    Ok(Made { files, notes })
}

/// Writes the grade, unless Moodle would pass over it: it takes none above the maximum, and reports none that it leaves out.
fn put_grade(
    sheet: &mut Sheet,
    one: &Matched<'_>,
    places: &Places,
    decimal: Decimal,
    notes: &mut Vec<Note>,
) {
    let maximum = places
        .maximum
        .and_then(|at| number(&sheet.value(one.at, at)));
    match (decided(one.row), maximum) {
        (Some(decided), Some(maximum)) if decided.points > maximum => {
            notes.push(Note::AboveMaximum {
                student: one.row.person.id.clone(),
                points: decided.points,
                maximum,
            });
        }
        _ => put_points(sheet, one, places.grade, decimal, notes),
    }
}

/// Finds the columns by their headers, or by those that were named.
fn places(sheet: &Sheet, material: &Material<'_>) -> Result<Places, ReleaseError> {
    let found = |field: Field| sheet.column(field.words(), &field.headers());
    let required = |field: Field| {
        let at = found(field)?;
        at.ok_or_else(|| sheet.no_column(field.words(), OTHER_LANGUAGE))
    };
    let named = |name: Option<&str>, field: Field| match name {
        None => found(field),
        Some(name) => match sheet.column(name, &[name])? {
            Some(at) => Ok(Some(at)),
            None => Err(sheet.no_column(
                &format!("`{name}`"),
                "name a column by its header, as the file has it",
            )),
        },
    };
    if found(Field::Scale)?.is_some() && found(Field::Maximum)?.is_none() {
        return Err(ReleaseError::Scale {
            name: sheet.name().to_owned(),
        });
    }
    let columns = material.columns;
    let identifier = required(Field::Identifier)?;
    let grade = named(columns.points, Field::Grade)?;
    let grade = grade.ok_or_else(|| sheet.no_column(Field::Grade.words(), OTHER_LANGUAGE))?;
    let modified = required(Field::ModifiedGrade)?;
    let header = sheet.headers().swap_remove(modified);
    let language = LANGUAGES
        .iter()
        .find(|language| language.has(Field::ModifiedGrade, &header));
    Ok(Places {
        language: language.unwrap_or(&LANGUAGES[0]),
        identifier,
        grade,
        full_name: found(Field::FullName)?,
        email: found(Field::Email)?,
        id_number: named(columns.id, Field::IdNumber)?,
        username: found(Field::Username)?,
        maximum: found(Field::Maximum)?,
        feedback: named(columns.comment, Field::Feedback)?,
    })
}

fn keys(sheet: &Sheet, row: usize, places: &Places) -> Keys {
    let cell = |column: Option<usize>| {
        column.map_or_else(String::new, |at| sheet.value(row, at).trim().to_owned())
    };
    Keys {
        // a participant's number is another one in each assignment
        lms_id: String::new(),
        id: cell(places.id_number),
        email: cell(places.email),
        login: cell(places.username),
        name: cell(places.full_name),
    }
}

/// The decimal sign: that of the file's own grades and maxima; where they have no decimals, a comma where the language of the headers
/// has one or cells are apart by semicolons.
fn decimal(sheet: &Sheet, places: &Places) -> Decimal {
    let columns = [places.maximum, Some(places.grade)];
    let cells: Vec<String> = sheet
        .below_header()
        .flat_map(|row| {
            let columns = columns.into_iter().flatten();
            columns.map(move |at| (row, at))
        })
        .map(|(row, at)| sheet.value(row, at).into_owned())
        .collect();
    let of_cells = Decimal::of_cells(cells.iter().map(String::as_str));
    of_cells.unwrap_or(
        if places.language.has_decimal_comma || sheet.delimiter() == ';' {
            Decimal::Comma
        } else {
            Decimal::Point
        },
    )
}

/// The number of a participant: the digits at the end of `Participant 12` or `Teilnehmer/in12`.
fn participant(identifier: &str) -> Option<String> {
    let identifier = identifier.trim();
    let number = identifier.trim_start_matches(|c: char| !c.is_ascii_digit());
    let digits = !number.is_empty() && number.chars().all(|c| c.is_ascii_digit());
    digits.then(|| number.to_owned())
}

#[cfg(test)]
mod tests;
