//! The grade as text for a terminal: points, values against bands, the first moment it went wrong, one next step.
//!
//! Colours are ANSI sequences; whoever prints strips them where they do not belong. The text makes sense without them.

use std::fmt::Write as _;

use kinemark_sim::text::number::seconds;
use owo_colors::OwoColorize as _;
use unicode_width::UnicodeWidthStr as _;

use super::measured::Measured;
use super::moment::{fragment, last_before, of_task};
use super::stop_words::stop_of_whole_file;
use super::visible::visible;
use kinemark_grader::record::grade::{
    CheckGrade, EventRecord, Evidence, Grade, GradeMode, Instant, Measure, Outcome, Stopped,
    TaskGrade, TaskKind,
};
use kinemark_grader::record::hints;
use kinemark_grader::record::quantity::{points, with_unit};
use kinemark_grader::record::verdict::Verdict;

/// What is said of a module that nobody can read.
const NO_SOURCES: &str =
    "sources: none beside this module; hand in the files that it is built from with it";

/// Renders `grade`.
pub fn text(grade: &Grade) -> String {
    let mut out = String::new();
    let mode = match grade.mode {
        GradeMode::Graded => "graded on visible and hidden cases",
        GradeMode::Practice => "practice: visible cases only",
    };
    line(
        &mut out,
        &format!(
            "{}  {}",
            grade.lab.name.bold(),
            visible(&grade.submission.name)
        ),
    );
    line(&mut out, &mode.dimmed().to_string());
    if let Some(variant) = &grade.variant {
        line(&mut out, &visible(&variant.words()).dimmed().to_string());
    }
    if grade.is_without_sources() {
        line(&mut out, &NO_SOURCES.dimmed().to_string());
    }
    if let Some(stopped) = stop_of_whole_file(grade) {
        // the same in all tasks: said once
        out.push('\n');
        line(
            &mut out,
            "Nothing of it could be run, so no task earns a point.",
        );
        push_stopped(&mut out, stopped, &grade.submission.name, "");
    } else {
        for task in &grade.tasks {
            out.push('\n');
            push_task(&mut out, task, &grade.submission.name);
        }
    }
    out.push('\n');
    let total = format!(
        "{} of {} points",
        points(grade.points),
        points(grade.max_points)
    );
    let later = points_at_hand_in(grade).map_or_else(String::new, |later| format!("; {later}"));
    let total = format!("{}{later}", total.bold());
    let undecided = grade.tasks.iter().any(|task| !task.verdict.is_decided());
    if undecided {
        line(
            &mut out,
            &format!("{total}, but not all is decided: grade it again"),
        );
    } else {
        line(&mut out, &total);
    }
    out
}

/// The points that practice leaves open, in words, if there are any.
pub(crate) fn points_at_hand_in(grade: &Grade) -> Option<String> {
    (grade.points_at_hand_in > 0.0)
        .then(|| format!("{} more when you hand in", points(grade.points_at_hand_in)))
}

fn line(out: &mut String, text: &str) {
    out.push_str(text.trim_end());
    out.push('\n');
}

// long: the lines of a task in the order in which they are printed
fn push_task(out: &mut String, task: &TaskGrade, file: &str) {
    let verdict = match task.verdict {
        Verdict::Passed => task.verdict.name().green().to_string(),
        Verdict::Missed => task.verdict.name().yellow().to_string(),
        _ => task.verdict.name().red().to_string(),
    };
    let earned = format!("{}/{}", points(task.points), points(task.max_points));
    line(
        out,
        &format!(
            "{:<10} {:>8}  {verdict}  {}",
            task.name.bold(),
            earned,
            visible(&task.title)
        ),
    );
    if let Some(stopped) = &task.stopped {
        push_stopped(out, stopped, file, &task.name);
    }
    if let Some(event) = task.first_unresolved() {
        line(
            out,
            &format!(
                "  {} {} {}",
                "inaccurate:".yellow().bold(),
                unresolved(event),
                fragment(&task.name, event.time_s).dimmed()
            ),
        );
    }
    if task.unresolved_hidden() > 0 {
        let words = unresolved_hidden(task);
        line(out, &format!("  {} {words}", "inaccurate:".yellow().bold()));
    }
    for diagnosis in &task.diagnoses {
        line(
            out,
            &format!(
                "  {} {} {}",
                "likely:".magenta().bold(),
                diagnosis.says,
                format!(
                    "(matches {} of the {} {} in which this mistake shows)",
                    diagnosis.agreeing,
                    diagnosis.telling,
                    match task.kind {
                        TaskKind::Function => "answers",
                        TaskKind::Motion => "moments",
                    }
                )
                .dimmed()
            ),
        );
    }
    if let Some(differs) = &task.divergence {
        line(
            out,
            &format!(
                "  {} at {}: {} {}",
                "first differs".cyan(),
                seconds(differs.time_s),
                visible(&differs.message),
                format!(
                    "[tick {}, {}] {}",
                    differs.tick,
                    differs.signal,
                    fragment(&task.name, differs.time_s)
                )
                .dimmed()
            ),
        );
    }
    for check in &task.checks {
        push_check(out, check, &task.name);
    }
    let lost: Vec<String> = task
        .hidden
        .iter()
        .map(|class| format!("{} {}/{}", class.class, class.good, class.total))
        .collect();
    if !lost.is_empty() {
        line(
            out,
            &format!(
                "  {}",
                format!("hidden {}: {}", hidden_word(task.kind), lost.join(", ")).dimmed()
            ),
        );
    }
}

/// What the first event of a run that is not resolved means for whoever reads its grade.
pub(crate) fn unresolved(event: &EventRecord) -> String {
    format!(
        "the simulation is not accurate from {} on: {}. Unless your commands cause this, tell your instructor",
        seconds(event.time_s),
        visible(&event.message)
    )
}

/// The same of hidden runs, of which only the count is given.
pub(crate) fn unresolved_hidden(task: &TaskGrade) -> String {
    let all: u32 = task.hidden.iter().map(|class| class.total).sum();
    format!(
        "the simulation is not accurate to the end of {} of {all} hidden runs. Unless your commands cause this, tell your instructor",
        task.unresolved_hidden()
    )
}

/// What is hidden in a task of this kind.
pub(crate) fn hidden_word(kind: TaskKind) -> &'static str {
    match kind {
        TaskKind::Function => "cases",
        TaskKind::Motion => "runs",
    }
}

fn push_stopped(out: &mut String, stopped: &Stopped, file: &str, task: &str) {
    let mut where_ = String::new();
    if let Some(time_s) = stopped.time_s {
        let _ = write!(
            where_,
            " (at {}, tick {})",
            seconds(time_s),
            stopped.tick.unwrap_or(0),
        );
    }
    if stopped.time_s.is_some() {
        // a first call that failed leaves the section alone
        let link =
            last_before(stopped).map_or_else(|| of_task(task), |last| fragment(task, last.time_s));
        let _ = write!(where_, " {}", link.dimmed());
    }
    if let Some(case) = &stopped.case {
        let _ = write!(where_, " (case \"{case}\")");
    }
    line(
        out,
        &format!(
            "  {} {}{where_}",
            "stopped:".red().bold(),
            visible(&stopped.message)
        ),
    );
    if let (Some(number), Some(source)) = (stopped.line, &stopped.source_line) {
        let column = stopped.column.unwrap_or(1);
        let place = format!("{}:{number}:{column}", visible(file));
        line(out, &format!("    {}", place.dimmed()));
        let gutter = number.to_string();
        line(
            out,
            &format!("    {} {}", format!("{gutter} |").dimmed(), visible(source)),
        );
        if let Some(column) = stopped.column_in_source_line() {
            // as wide as what is shown before the caret
            let head: String = source.chars().take(column.saturating_sub(1)).collect();
            let before = " ".repeat(visible(&head).width());
            let bar = format!("{:gutter$} |", "", gutter = gutter.len());
            line(
                out,
                &format!("    {} {before}{}", bar.dimmed(), "^".red().bold()),
            );
        }
    }
    if let Some(kept) = stopped.kept {
        line(out, &format!("  {}", kept_words(stopped, kept)));
    }
    if let Some(help) = &stopped.help {
        line(out, &format!("  {} {}", "next:".cyan(), visible(help)));
    }
    for (i, further) in stopped.further.iter().enumerate() {
        let label = if i == 0 { "also:" } else { "     " };
        line(
            out,
            &format!("  {} {}", label.cyan(), visible(&further.words())),
        );
    }
}

/// What is kept of a run in which the submission failed.
pub(crate) fn kept_words(stopped: &Stopped, kept: f64) -> String {
    let went_on = match stopped.tick {
        Some(0) => "No command was ever returned, so the arm was asked to rest",
        _ => "The run went on with the last command",
    };
    let kept = with_unit(kept, "");
    format!("{went_on}. The task keeps {kept} of the points that this run earns.")
}

fn push_check(out: &mut String, check: &CheckGrade, task: &str) {
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
    line(
        out,
        &format!("  {mark} {earned:>9}  {}{word}", visible(&check.title)),
    );
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
pub fn band(measure: &Measure, outcome: Outcome) -> String {
    let measured = Measured::of(measure);
    let (to, from) = if measure.zero >= measure.full {
        ("up to", "from")
    } else {
        ("at", "at")
    };
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
