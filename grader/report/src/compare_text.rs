//! A comparison as text for a terminal.

use kinemark_sim::text::number::{metres, seconds};
use owo_colors::OwoColorize as _;

use super::text::Detail;
use super::visible::visible;
use kinemark_grader::record::comparison::{
    CheckComparison, Comparison, MotionComparison, Pair, SideRecord,
};
use kinemark_grader::record::comparison::{JOINT_TOLERANCE_RAD, POSITION_TOLERANCE_M};
use kinemark_grader::record::grade::Outcome;
use kinemark_grader::record::quantity::{difference_of_points, points};

/// Renders a comparison: its total alone, with the checks that earn all their points in both folded, or everything.
pub fn text(comparison: &Comparison, detail: Detail) -> String {
    if detail == Detail::Total {
        return total(comparison) + "\n";
    }
    let mut lines = vec![visible(&comparison.lab).bold().to_string()];
    for (letter, side) in [("A", &comparison.a), ("B", &comparison.b)] {
        lines.push(side_line(letter, side));
    }
    for note in &comparison.notes {
        lines.push(visible(note).dimmed().to_string());
    }
    for task in &comparison.tasks {
        lines.push(String::new());
        let name = visible(&task.name);
        let width = name.chars().count();
        let name = name.bold().to_string();
        let judged = [Outcome::Full; 2];
        lines.push(format!(
            "{}  {}",
            row(&name, width, &task.points, judged),
            visible(&task.title)
        ));
        let is_folded = |check: &&CheckComparison| {
            detail == Detail::Folded
                && [check.outcome_a, check.outcome_b] == [Outcome::Full; 2]
                && check.points.difference == 0.0
        };
        for check in task.checks.iter().filter(|check| !is_folded(check)) {
            let name = format!("  {}", visible(&check.name));
            let outcomes = [check.outcome_a, check.outcome_b];
            lines.push(format!(
                "{}  {}",
                row(&name, name.chars().count(), &check.points, outcomes),
                visible(&check.title)
            ));
        }
        match task.checks.iter().filter(is_folded).count() {
            0 => {}
            1 => lines.push("  1 check has all its points in both".dimmed().to_string()),
            full => {
                let words = format!("  {full} checks have all their points in both");
                lines.push(words.dimmed().to_string());
            }
        }
        for (letter, ended) in [("A", &task.ended_a), ("B", &task.ended_b)] {
            let words = ended.as_ref().map(|ended| ended.words(letter));
            lines.extend(words.map(|words| format!("  {}", visible(&words).yellow())));
        }
        lines.extend(task.motion.as_ref().map(motion));
    }
    lines.push(String::new());
    lines.push(total(comparison));
    let text: Vec<&str> = lines.iter().map(|line| line.trim_end()).collect();
    text.join("\n") + "\n"
}

/// The points of both, in a line.
fn total(comparison: &Comparison) -> String {
    let [a, b] = [comparison.a.points, comparison.b.points];
    format!(
        "{} in A, {} in B: {}",
        points(a).bold(),
        points(b).bold(),
        change(difference_of_points(a, b))
    )
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

/// A name that is `width` wide, and the points of both; what is not judged has none.
fn row(name: &str, width: usize, pair: &Pair, outcomes: [Outcome; 2]) -> String {
    let space = " ".repeat(24_usize.saturating_sub(width));
    let of = |earned: f64, outcome, max| format!("{}/{}", mark(earned, outcome), points(max));
    format!(
        "{name}{space} {:>9} {:>9} {:>6}",
        of(pair.a, outcomes[0], pair.max),
        of(pair.b, outcomes[1], pair.of_b()),
        change(pair.difference)
    )
}

/// Points earned; a dash where nothing was judged.
fn mark(earned: f64, outcome: Outcome) -> String {
    match outcome {
        Outcome::NotJudged | Outcome::AtHandIn => "\u{2013}".to_owned(),
        Outcome::Full | Outcome::Partial | Outcome::None => points(earned),
    }
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
        metres(POSITION_TOLERANCE_M)
    )
}
