//! A comparison as text for a terminal.

use owo_colors::OwoColorize as _;

use super::visible::visible;
use crate::compare::{Comparison, MotionComparison, Pair, SideRecord};
use crate::divergence::{JOINT_TOLERANCE_RAD, PLACE_TOLERANCE_M};
use crate::quantity::{metres, points, seconds};

/// Renders a comparison.
pub fn text(comparison: &Comparison) -> String {
    let mut lines = vec![comparison.lab.bold().to_string()];
    for (letter, side) in [("A", &comparison.a), ("B", &comparison.b)] {
        lines.push(side_line(letter, side));
    }
    for note in &comparison.notes {
        lines.push(visible(note).dimmed().to_string());
    }
    for task in &comparison.tasks {
        lines.push(String::new());
        lines.push(format!(
            "{}  {}",
            row(&task.name.bold().to_string(), task.name.len(), &task.points),
            task.title
        ));
        for check in &task.checks {
            let name = format!("  {}", check.name);
            lines.push(format!(
                "{}  {}",
                row(&name, name.len(), &check.points),
                check.title
            ));
        }
        lines.extend(task.motion.as_ref().map(motion));
    }
    let total = comparison.b.points - comparison.a.points;
    lines.push(String::new());
    lines.push(format!(
        "{} in A, {} in B: {}",
        points(comparison.a.points).bold(),
        points(comparison.b.points).bold(),
        change(total)
    ));
    let text: Vec<&str> = lines.iter().map(|line| line.trim_end()).collect();
    text.join("\n") + "\n"
}

fn side_line(letter: &str, side: &SideRecord) -> String {
    format!(
        "{letter}  {}: {}, {} of {} points, {}",
        visible(&side.name),
        visible(&side.submission),
        points(side.points),
        points(side.max_points),
        side.verdict.name()
    )
}

/// A name that is `width` wide, and the points of both.
fn row(name: &str, width: usize, pair: &Pair) -> String {
    let space = " ".repeat(24_usize.saturating_sub(width));
    let of = |earned: f64| format!("{}/{}", points(earned), points(pair.max));
    format!(
        "{name}{space} {:>9} {:>9} {:>6}",
        of(pair.a),
        of(pair.b),
        change(pair.difference)
    )
}

/// A difference of points with its sign.
pub(crate) fn change(difference: f64) -> String {
    if difference > 0.0 {
        format!("+{}", points(difference))
    } else if difference < 0.0 {
        format!("\u{2212}{}", points(-difference))
    } else {
        "=".to_owned()
    }
}

/// How two motions compare, in a line.
fn motion(motion: &MotionComparison) -> String {
    match &motion.first {
        Some(first) => format!(
            "  {} at {}: {} {}",
            "first differ".cyan(),
            seconds(first.time_s),
            visible(&first.message),
            format!("[tick {}, {}]", first.tick, first.signal).dimmed()
        ),
        None => format!("  {}", together(motion)),
    }
}

/// What is said of motions that are never apart.
pub(crate) fn together(motion: &MotionComparison) -> String {
    if motion.same_bits {
        return "the motions are the same, bit for bit".to_owned();
    }
    format!(
        "the motions are never more than {JOINT_TOLERANCE_RAD} rad or {} apart, as far as both go",
        metres(PLACE_TOLERANCE_M)
    )
}
