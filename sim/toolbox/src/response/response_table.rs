//! The measures as a table: a row for the linear theory and one for the run, for each value of the sweep.

use kinemark_sim::text::number::short;

use super::analysis::{Analysis, Measured, Response};

/// What stands where a measure is missing.
const MISSING: &str = "-";

/// A table of words: a head, and rows of as many cells.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct ResponseTable {
    /// What the columns hold, with units.
    pub head: Vec<String>,
    /// The rows.
    pub rows: Vec<Vec<String>>,
}

impl ResponseTable {
    /// The table as lines of equal columns, numbers to the right.
    pub(super) fn lines(&self) -> Vec<String> {
        let all = || std::iter::once(&self.head).chain(&self.rows);
        let widths: Vec<usize> = (0..self.head.len())
            .map(|column| {
                all()
                    .map(|row| row[column].chars().count())
                    .max()
                    .unwrap_or(0)
            })
            .collect();
        let words = self.words();
        let line = |row: &Vec<String>| {
            let cells = row.iter().zip(&widths).enumerate();
            let cells = cells.map(|(column, (cell, &width))| match column < words {
                true => format!("{cell:<width$}"),
                false => format!("{cell:>width$}"),
            });
            cells.collect::<Vec<_>>().join("  ").trim_end().to_owned()
        };
        all().map(line).collect()
    }

    /// How many columns at the left hold words.
    pub fn words(&self) -> usize {
        if self.head.first().is_some_and(String::is_empty) {
            1
        } else {
            2
        }
    }
}

/// A number of a column, or the sign of a missing one.
fn cell(value: Option<f64>, words: impl Fn(f64) -> String) -> String {
    value.map_or_else(|| MISSING.to_owned(), words)
}

/// A fraction as a percentage; a thousandth of a percent is nothing.
fn percent(fraction: f64) -> String {
    let percent = 100.0 * fraction;
    short(if percent.abs() < 1e-3 { 0.0 } else { percent })
}

/// Thousandths of a unit with their sign, to the hundredth.
fn signed_thousandths(value: f64) -> String {
    let text = format!("{:+.2}", 1000.0 * value);
    match text.as_str() {
        "+0.00" | "-0.00" => "0.00".to_owned(),
        _ => text,
    }
}

fn measures(measured: &Measured, peak_effort: String) -> Vec<String> {
    let thousandths = |value: f64| short(1000.0 * value);
    vec![
        cell(measured.final_value, |value| format!("{value:.5}")),
        cell(
            Some(measured.peak).filter(|peak| peak.is_finite()),
            |value| format!("{value:.5}"),
        ),
        cell(measured.rise_s, thousandths),
        cell(measured.settling_s, thousandths),
        cell(measured.overshoot, percent),
        cell(measured.beyond_command, signed_thousandths),
        peak_effort,
    ]
}

fn peak_effort(response: &Response) -> String {
    let run = &response.run;
    let limit = if run.is_limited() { " (limit)" } else { "" };
    format!("{}{limit}", short(run.peak_effort()))
}

/// The measures of an analysis.
pub fn response_table(analysis: &Analysis) -> ResponseTable {
    let unit = analysis.unit(analysis.settings.joint);
    let mut head: Vec<String> = analysis.varied.iter().map(ToString::to_string).collect();
    head.extend([
        String::new(),
        format!("final [{unit}]"),
        format!("peak [{unit}]"),
        "rise [ms]".to_owned(),
        "settling [ms]".to_owned(),
        "overshoot [%]".to_owned(),
        format!("beyond [m{unit}]"),
        format!("effort [{}]", analysis.effort_unit()),
    ]);
    let mut rows = Vec::new();
    for response in &analysis.responses {
        let theory = response.theory.as_ref();
        let of_theory = theory.map(|theory| {
            let efforts = MISSING.to_owned();
            ("theory", measures(&theory.measured, efforts))
        });
        let of_run = ("run", measures(&response.measured, peak_effort(response)));
        for (which, cells) in of_theory.into_iter().chain([of_run]) {
            let mut row: Vec<String> = response.value.iter().map(|value| short(*value)).collect();
            row.push(which.to_owned());
            row.extend(cells);
            rows.push(row);
        }
    }
    ResponseTable { head, rows }
}
