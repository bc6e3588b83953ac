//! The brief's table of points: made from the lab, so that brief and grader cannot disagree.

use std::fmt::Write as _;

use super::model::{CheckKind, Lab};
use crate::quantity::{points, with_unit};

/// The line before the table.
pub const BEGIN: &str = "<!-- grading: begin -->";
/// The line after it.
pub const END: &str = "<!-- grading: end -->";

/// The brief with its table as `lab` has it; a brief without the two marks is returned as it is.
pub fn with_grading(brief: &str, lab: &Lab) -> String {
    let Some((head, rest)) = brief.split_once(BEGIN) else {
        return brief.to_owned();
    };
    let Some((_, tail)) = rest.split_once(END) else {
        return brief.to_owned();
    };
    format!("{head}{BEGIN}\n{}{END}{tail}", table(lab))
}

fn table(lab: &Lab) -> String {
    let mut text = String::from(
        "\n| task | check | points | all points | none | |\n|---|---|---:|---|---|---|\n",
    );
    let mut total = 0.0;
    for task in &lab.tasks {
        for check in &task.checks {
            total += check.points;
            let (full, zero) = match (&check.kind, check.kind.band()) {
                (CheckKind::IkReach(band) | CheckKind::IkBranches(band), _) => (
                    format!("every target within {}", with_unit(band.full, "m")),
                    format!("every target {} off", with_unit(band.zero, "m")),
                ),
                (CheckKind::BodyFalls(fall), _) => (
                    fall.side.map_or_else(
                        || "it falls".to_owned(),
                        |side| format!("it falls over the {} side", side.name()),
                    ),
                    format!(
                        "it stays ({} if it topples, {} if it moves)",
                        with_unit(fall.toppled, ""),
                        with_unit(fall.moved, "")
                    ),
                ),
                (CheckKind::PathCoverage { shares, .. }, _) => (
                    format!("from {}", with_unit(shares.full, "")),
                    format!("up to {}", with_unit(shares.zero, "")),
                ),
                (CheckKind::Robustness(ladder), _) => {
                    let repeated = &task.checks[ladder.check].title;
                    (
                        format!("\"{repeated}\" in full on every rung"),
                        "nothing on any rung".to_owned(),
                    )
                }
                (_, Some((band, unit))) => (
                    format!("up to {}", with_unit(band.full, unit)),
                    format!("from {}", with_unit(band.zero, unit)),
                ),
                (_, None) => ("every one".to_owned(), "none".to_owned()),
            };
            let needs: Vec<String> = check
                .needs
                .iter()
                .map(|&need| format!("\"{}\"", task.checks[need].title))
                .collect();
            let note = if needs.is_empty() {
                String::new()
            } else {
                format!("counts once {} earns something", needs.join(" and "))
            };
            // writing into a string cannot fail
            let _ = writeln!(
                text,
                "| {} | {} | {} | {full} | {zero} | {note} |",
                task.name,
                check.title,
                points(check.points)
            );
        }
    }
    let _ = writeln!(text, "| | **together** | **{}** | | | |\n", points(total));
    text
}
