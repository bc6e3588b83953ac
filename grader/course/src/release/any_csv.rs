//! Tables for every other system: a fresh one with a column a check, or any CSV with points and comments filled into columns that are
//! named by their headers.

use std::collections::BTreeMap;

use super::decided::{Decided, decided};
use super::directory::Keys;
use super::feedback::Feedback;
use super::fill::{CommentForm, FileRow, file_name, matched, put_comment, put_points};
use super::formula::harmless;
use super::number::{Decimal, points_text};
use super::sheet::Sheet;
use super::{Column, Export, ExportUse, Form, Made, Material, OutFile, ReleaseError};

pub(super) const FORM: Form = Form {
    name: "csv",
    title: "CSV: a table with a column a check, or any CSV with named columns filled in",
    export: ExportUse::Optional("a CSV with a column that says who it is, and one for the points"),
    columns: &[Column::Id, Column::Points, Column::Comment],
    make,
};

/// The columns of a fresh table before those of the checks; `id`, `points` and `comment` are looked for in a file that is filled in.
const COLUMNS: [&str; 6] = ["id", "points", "max_points", "status", "late_s", "comment"];

fn make(material: &Material<'_>) -> Result<Made, ReleaseError> {
    match material.export {
        Some(export) => filled(material, export),
        None => Ok(Made {
            files: vec![OutFile {
                path: "grades.csv".to_owned(),
                bytes: fresh(material).into_bytes(),
            }],
            notes: Vec::new(),
        }),
    }
}

/// A row for everybody, in the roster's order.
fn fresh(material: &Material<'_>) -> String {
    let checks = check_names(material);
    let mut rows = Vec::new();
    let header = COLUMNS.map(str::to_owned).into_iter();
    rows.push(header.chain(checks.iter().cloned()).collect());
    for row in material.rows {
        let standing = row.standing;
        let decided = decided(row);
        let maximum = decided
            .and_then(|decided| decided.max_points)
            .unwrap_or(material.max_points);
        let feedback = Feedback::of(material, row);
        let mut cells = vec![
            row.person.id.to_string(),
            decided
                .map(|decided| points_text(decided.points))
                .unwrap_or_default(),
            points_text(maximum),
            status_name(row),
            standing
                .late_s
                .map(|late_s| late_s.to_string())
                .unwrap_or_default(),
            feedback.map(|feedback| feedback.line()).unwrap_or_default(),
        ];
        let points = decided
            .map(|decided| by_check(&decided))
            .unwrap_or_default();
        cells.extend(
            checks
                .iter()
                .map(|check| points.get(check).cloned().unwrap_or_default()),
        );
        rows.push(cells);
    }
    let lines = rows.iter().map(|cells: &Vec<String>| {
        let cells: Vec<String> = cells.iter().map(|cell| field(cell)).collect();
        cells.join(",") + "\r\n"
    });
    lines.collect()
}

/// The checks of all grades, in the order of the lab.
fn check_names(material: &Material<'_>) -> Vec<String> {
    let mut names: Vec<String> = Vec::new();
    for decided in material.rows.iter().filter_map(decided) {
        for check in decided.checks() {
            let name = check.name();
            if !names.contains(&name) {
                names.push(name);
            }
        }
    }
    names
}

fn by_check(decided: &Decided<'_>) -> BTreeMap<String, String> {
    let checks = decided.checks().into_iter();
    checks
        .map(|check| (check.name(), points_text(check.points)))
        .collect()
}

fn status_name(row: &super::Row<'_>) -> String {
    let name = serde_json::to_value(row.standing.status).unwrap_or_default();
    name.as_str().unwrap_or_default().to_owned()
}

/// A cell of a fresh table: no formula, and in quotes where it needs them.
fn field(text: &str) -> String {
    let text = harmless(text);
    if text.contains([',', ';', '\t', '"', '\r', '\n'])
        || text.starts_with(' ')
        || text.ends_with(' ')
    {
        format!("\"{}\"", text.replace('"', "\"\""))
    } else {
        text.into_owned()
    }
}

fn filled(material: &Material<'_>, export: Export<'_>) -> Result<Made, ReleaseError> {
    let mut sheet = Sheet::read(export.name, export.bytes)?;
    let columns = material.columns;
    let find = |named: Option<&str>, usual: &str| {
        sheet.column(named.unwrap_or(usual), &[named.unwrap_or(usual)])
    };
    let missing = |name: &str| {
        sheet.no_column(
            &format!("`{name}`"),
            "name the columns by their headers: one that says who it is, one for the points, one for the comment",
        )
    };
    let id = columns.id.unwrap_or("id");
    let id = find(columns.id, "id")?.ok_or_else(|| missing(id))?;
    let points = find(columns.points, "points")?;
    let comment = find(columns.comment, "comment")?;
    for (named, found) in [(columns.points, points), (columns.comment, comment)] {
        if let (Some(named), None) = (named, found) {
            return Err(missing(named));
        }
    }
    if points.is_none() && comment.is_none() {
        return Err(missing("points"));
    }
    sheet.check_widths()?;
    let rows: Vec<FileRow> = sheet
        .below_header()
        .map(|at| FileRow {
            at,
            line: sheet.line(at),
            keys: Keys {
                id: sheet.value(at, id).trim().to_owned(),
                ..Keys::default()
            },
        })
        .collect();
    let mut notes = Vec::new();
    let all = matched(
        material,
        &rows,
        |people, keys, _| people.find_any(&keys.id),
        &mut notes,
    );
    let decimal = decimal(&sheet, points);
    for one in &all {
        if let Some(column) = points {
            put_points(&mut sheet, one, column, decimal, &mut notes);
        }
        if let Some(column) = comment {
            put_comment(
                &mut sheet,
                one,
                column,
                CommentForm::Line,
                material,
                &mut notes,
            );
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

/// The decimal sign of the column; where no number of it has decimals, a comma where cells are apart by semicolons.
fn decimal(sheet: &Sheet, points: Option<usize>) -> Decimal {
    let cells: Vec<String> = points
        .into_iter()
        .flat_map(|at| sheet.below_header().map(move |row| (row, at)))
        .map(|(row, at)| sheet.value(row, at).into_owned())
        .collect();
    let of_cells = Decimal::of_cells(cells.iter().map(String::as_str));
    let is_comma = sheet.delimiter() == ';';
    of_cells.unwrap_or(if is_comma {
        Decimal::Comma
    } else {
        Decimal::Point
    })
}

#[cfg(test)]
mod tests;
