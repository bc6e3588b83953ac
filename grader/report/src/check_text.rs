//! The checks of a task in lines for a terminal: each in full, or folded, so that what to look at first is what there is to read.

use std::fmt::Write as _;

use kinemark_sim::text::number::seconds;
use owo_colors::OwoColorize as _;

use super::measured::Measured;
use super::moment::{fragment, has_lost};
use super::visible::visible;
use kinemark_grader::record::grade::{
    CheckGrade, Evidence, Grade, Instant, Measure, Outcome, TaskGrade,
};
use kinemark_grader::record::hints;
use kinemark_grader::record::quantity::points;

/// Adds a line, without blanks at its end.
pub(super) fn line(out: &mut String, text: &str) {
    out.push_str(text.trim_end());
    out.push('\n');
}

/// How much of a check is shown.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Part {
    /// Everything that is known of it.
    Everything,
    /// Its points, its title, and its value if it lost points.
    OneLine,
}

/// Adds the checks of a task: every one in full, or the first that lost points in full and of the others a line each at most.
pub(super) fn push_checks(out: &mut String, task: &TaskGrade, all: bool) {
    let first = task.checks.iter().position(has_lost);
    for (i, check) in task.checks.iter().enumerate() {
        match check.outcome {
            _ if all || first == Some(i) => push_check(out, check, &task.name, Part::Everything),
            Outcome::NotJudged => {}
            _ => push_check(out, check, &task.name, Part::OneLine),
        }
    }
    if !all {
        push_waiting(out, task);
    }
}

/// Whether a grade has checks of which [`push_checks`] shows less than is known.
pub(super) fn folds(grade: &Grade) -> bool {
    let is_folded = |task: &TaskGrade| {
        let first = task.checks.iter().position(has_lost);
        let checks = task.checks.iter().enumerate();
        let mut others = checks.filter(|(i, _)| Some(*i) != first);
        others.any(|(_, check)| check.measure.is_some() || check.next_step.is_some())
    };
    grade.tasks.iter().any(is_folded)
}

/// Adds the checks of a task that were not judged, because others come first, in one line.
fn push_waiting(out: &mut String, task: &TaskGrade) {
    let is_waiting = |check: &&CheckGrade| check.outcome == Outcome::NotJudged;
    let waiting: Vec<&CheckGrade> = task.checks.iter().filter(is_waiting).collect();
    if waiting.is_empty() {
        return;
    }
    let earned: f64 = waiting.iter().map(|check| check.points).sum();
    let most: f64 = waiting.iter().map(|check| check.max_points).sum();
    let titles: Vec<_> = waiting.iter().map(|check| visible(&check.title)).collect();
    let earned = format!("{}/{}", points(earned), points(most));
    let count = match waiting.len() {
        1 => "1 check".to_owned(),
        several => format!("{several} checks"),
    };
    let words = format!("{count} not judged yet: {}", titles.join("; "));
    line(
        out,
        &format!("  {} {earned:>9}  {}", ".".dimmed(), words.dimmed()),
    );
}

fn push_check(out: &mut String, check: &CheckGrade, task: &str, part: Part) {
    let (mark, word) = match check.outcome {
        Outcome::Full => ("+".green().to_string(), ""),
        Outcome::Partial => ("~".yellow().to_string(), ""),
        Outcome::None => ("-".red().to_string(), ""),
        Outcome::NotJudged => (".".dimmed().to_string(), "  not judged"),
        Outcome::AtHandIn => (".".dimmed().to_string(), "  judged when you hand in"),
    };
    let earned = match check.outcome {
        Outcome::AtHandIn => format!("({})", points(check.max_points)),
        _ => format!("{}/{}", points(check.points), points(check.max_points)),
    };
    let value = match part {
        Part::OneLine if has_lost(check) => short_value(check),
        Part::OneLine | Part::Everything => String::new(),
    };
    line(
        out,
        &format!(
            "  {mark} {earned:>9}  {}{word}{value}",
            visible(&check.title)
        ),
    );
    if part == Part::OneLine {
        return;
    }
    if let Some(measure) = &check.measure {
        line(
            out,
            &format!("               {}", band(measure, check.outcome).dimmed()),
        );
    }
    if let Some(first) = loss_without_evidence(check) {
        let at = format!("[tick {}] {}", first.tick, fragment(task, first.time_s));
        line(
            out,
            &format!(
                "               points are lost from {} on {}",
                seconds(first.time_s),
                at.dimmed()
            ),
        );
    }
    for evidence in &check.evidence {
        line(
            out,
            &format!("               {}", evidence_text(evidence, task)),
        );
    }
    if let Some(next) = &check.next_step {
        let more = match check.has_hints {
            true => format!("  (kinemark hint {})", hints::name(task, &check.name)),
            false => String::new(),
        };
        line(
            out,
            &format!("               {} {next}{}", "next:".cyan(), more.dimmed()),
        );
    }
}

/// The value of a check beside what earns all points, for a line that has its title already.
fn short_value(check: &CheckGrade) -> String {
    let Some(measure) = &check.measure else {
        return String::new();
    };
    let measured = Measured::of(measure);
    let to = band_words(measure)[0];
    let value = format!("({}; all points {to} {})", measured.value, measured.full);
    format!("  {}", value.dimmed())
}

/// The words before the limits of all points and of none.
fn band_words(measure: &Measure) -> [&'static str; 2] {
    match measure.zero >= measure.full {
        true => ["up to", "from"],
        false => ["at", "at"],
    }
}

/// Where a check began to lose points, if its evidence shows other moments only.
pub(crate) fn loss_without_evidence(check: &CheckGrade) -> Option<Instant> {
    let first = check.first_lost?;
    let has_evidence = check
        .evidence
        .iter()
        .any(|fact| fact.tick == Some(first.tick));
    (!has_evidence).then_some(first)
}

/// The value against its band, and the margin of a run that is full.
fn band(measure: &Measure, outcome: Outcome) -> String {
    let measured = Measured::of(measure);
    let [to, from] = band_words(measure);
    let mut text = format!(
        "{}: {}; all points {to} {}, none {from} {}",
        measure.quantity, measured.value, measured.full, measured.zero
    );
    // with a margin the visible run is full; hidden ones may have lost points
    if let (Outcome::Full | Outcome::Partial, Some(margin)) = (outcome, measured.margin)
        && measure.margin() > Some(0.0)
    {
        let _ = write!(text, "; margin {margin}");
    }
    if let Some(beside) = measured.beside {
        let _ = write!(text, "; {beside}");
    }
    text
}

fn evidence_text(evidence: &Evidence, task: &str) -> String {
    let message = visible(&evidence.message).into_owned();
    match (evidence.tick, evidence.time_s) {
        (Some(tick), Some(time_s)) => {
            let link = fragment(task, time_s);
            format!(
                "{message} {}",
                format!("[tick {tick}, {}] {link}", evidence.signal).dimmed()
            )
        }
        _ => message,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A hint on hidden runs sends the reader to the margins of the visible one.
    #[test]
    fn a_margin_is_shown_where_only_hidden_runs_lost_points() {
        let measure = |value| Measure {
            quantity: "way".to_owned(),
            value: Some(value),
            unit: "s".to_owned(),
            full: 2.0,
            zero: 4.0,
            reference: None,
            prediction: None,
        };
        let has_margin = |value, outcome| band(&measure(value), outcome).contains("; margin");
        assert!(has_margin(1.0, Outcome::Full) && has_margin(1.0, Outcome::Partial));
        assert!(!has_margin(3.0, Outcome::Partial) && !has_margin(1.0, Outcome::NotJudged));
    }
}
