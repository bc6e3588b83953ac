//! The grade as text for a terminal: points, values against bands, the first moment it went wrong, one next step.
//!
//! Colours are ANSI sequences; whoever prints strips them where they do not belong. The text makes sense without them.

use std::fmt::Write as _;

use kinemark_sim::text::number::seconds;
use owo_colors::OwoColorize as _;
use unicode_width::UnicodeWidthStr as _;

pub(crate) use super::check_text::loss_without_evidence;
use super::check_text::{folds, line, push_checks};
use super::moment::{fragment, last_before, of_task};
use super::stop_words::stop_of_whole_file;
use super::visible::visible;
use kinemark_grader::record::grade::{
    Diagnosis, Divergence, EventRecord, Grade, GradeMode, Stopped, TaskGrade, TaskKind,
};
use kinemark_grader::record::quantity::{points, with_unit};
use kinemark_grader::record::verdict::Verdict;

/// What is said of a module that nobody can read.
const NO_SOURCES: &str =
    "sources: none beside this module; hand in the files that it is built from with it";

/// How much of a grade is shown.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Detail {
    /// The points alone, in one line.
    Total,
    /// Of each task the first check that lost points in full, and of the others a line each at most.
    Folded,
    /// Every check in full.
    Everything,
}

/// Renders `grade`, every check in full.
pub fn text(grade: &Grade) -> String {
    detailed(grade, Detail::Everything)
}

/// Renders as much of `grade` as is asked for.
pub fn detailed(grade: &Grade, detail: Detail) -> String {
    if detail == Detail::Total {
        return total(grade);
    }
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
        let width = name_width(grade.tasks.iter().map(|task| task.name.as_str()));
        for task in &grade.tasks {
            out.push('\n');
            push_task(&mut out, task, width, &grade.submission.name, detail);
        }
    }
    out.push('\n');
    let has_checks = stop_of_whole_file(grade).is_none();
    if detail == Detail::Folded && has_checks && folds(grade) {
        let how = "`kinemark grade -v` shows every check in full";
        line(&mut out, &how.dimmed().to_string());
    }
    out.push_str(&total(grade));
    out
}

/// The line of the points.
fn total(grade: &Grade) -> String {
    let earned = format!(
        "{} of {} points",
        points(grade.points),
        points(grade.max_points)
    );
    let later = points_at_hand_in(grade).map_or_else(String::new, |later| format!("; {later}"));
    let undecided = grade.tasks.iter().any(|task| !task.verdict.is_decided());
    let again = if undecided {
        ", but not all is decided: grade it again"
    } else {
        ""
    };
    format!("{}{later}{again}\n", earned.bold())
}

/// The points that practice leaves open, in words, if there are any.
pub(crate) fn points_at_hand_in(grade: &Grade) -> Option<String> {
    (grade.points_at_hand_in > 0.0)
        .then(|| format!("{} more when you hand in", points(grade.points_at_hand_in)))
}

/// The width of a column with the names of tasks, so that their points stand below each other.
pub(crate) fn name_width<'a>(names: impl Iterator<Item = &'a str>) -> usize {
    names.map(|name| name.chars().count()).fold(10, usize::max)
}

/// The lines of a task, in the order in which they are printed; its name in a column of this width.
fn push_task(out: &mut String, task: &TaskGrade, width: usize, file: &str, detail: Detail) {
    let verdict = match task.verdict {
        Verdict::Passed => task.verdict.name().green().to_string(),
        Verdict::Missed => task.verdict.name().yellow().to_string(),
        _ => task.verdict.name().red().to_string(),
    };
    let earned = format!("{}/{}", points(task.points), points(task.max_points));
    line(
        out,
        &format!(
            "{:<width$} {:>8}  {verdict}  {}",
            task.name.bold(),
            earned,
            visible(&task.title)
        ),
    );
    if let Some(stopped) = &task.stopped {
        push_stopped(out, stopped, file, &task.name);
    }
    push_unresolved(out, task);
    for diagnosis in &task.diagnoses {
        push_diagnosis(out, diagnosis, task.kind);
    }
    if let Some(differs) = &task.divergence {
        push_difference(out, differs, &task.name);
    }
    push_checks(out, task, detail == Detail::Everything);
    let hidden = task.hidden.iter();
    let hidden: Vec<String> = hidden
        .map(|class| format!("{} {}/{}", class.class, class.good, class.total))
        .collect();
    if !hidden.is_empty() {
        let words = format!("hidden {}: {}", hidden_word(task.kind), hidden.join(", "));
        line(out, &format!("  {}", words.dimmed()));
    }
}

/// That the simulation is not accurate, of the visible run and of hidden ones.
fn push_unresolved(out: &mut String, task: &TaskGrade) {
    let inaccurate = "inaccurate:".yellow().bold().to_string();
    if let Some(event) = task.first_unresolved() {
        let at = fragment(&task.name, event.time_s);
        let words = unresolved(event);
        line(out, &format!("  {inaccurate} {words} {}", at.dimmed()));
    }
    if task.unresolved_hidden() > 0 {
        line(out, &format!("  {inaccurate} {}", unresolved_hidden(task)));
    }
}

/// What the mistake may be.
fn push_diagnosis(out: &mut String, diagnosis: &Diagnosis, kind: TaskKind) {
    let noun = match kind {
        TaskKind::Function => "answers",
        TaskKind::Motion => "moments",
    };
    let agrees = format!(
        "(matches {} of the {} {noun} in which this mistake shows)",
        diagnosis.agreeing, diagnosis.telling
    );
    line(
        out,
        &format!(
            "  {} {} {}",
            "likely:".magenta().bold(),
            diagnosis.says,
            agrees.dimmed()
        ),
    );
}

/// Where a run first differs from the reference.
fn push_difference(out: &mut String, differs: &Divergence, task: &str) {
    let place = format!(
        "[tick {}, {}] {}",
        differs.tick,
        differs.signal,
        fragment(task, differs.time_s)
    );
    line(
        out,
        &format!(
            "  {} at {}: {} {}",
            "first differs".cyan(),
            seconds(differs.time_s),
            visible(&differs.message),
            place.dimmed()
        ),
    );
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

#[cfg(test)]
mod tests {
    use super::*;
    use kinemark_grader::record::grade::{CheckGrade, Outcome};
    use kinemark_grader::record::sample::graded;

    /// A grade with one task, of whose checks two lost points, one is full and two wait.
    fn of_five() -> Grade {
        let mut grade = graded().grade;
        grade.tasks.truncate(1);
        let task = &mut grade.tasks[0];
        let full = task.checks[0].clone();
        let named = |title: &str, outcome| CheckGrade {
            title: title.to_owned(),
            outcome,
            ..full.clone()
        };
        let lost = |title: &str| CheckGrade {
            next_step: Some(format!("Look at {title}.")),
            points: 0.0,
            ..named(title, Outcome::None)
        };
        let waiting = |title: &str| CheckGrade {
            measure: None,
            points: 0.0,
            ..named(title, Outcome::NotJudged)
        };
        task.checks = vec![
            named("is full", Outcome::Full),
            waiting("waits"),
            lost("first"),
            lost("second"),
            waiting("waits, too"),
        ];
        grade
    }

    fn plain(grade: &Grade, detail: Detail) -> Vec<String> {
        let text = detailed(grade, detail);
        // a colour is `ESC [ ... m`
        let mut parts = text.split('\u{1b}');
        let first = parts.next().unwrap_or_default().to_owned();
        let shown = parts.map(|part| part.split_once('m').map_or("", |(_, shown)| shown));
        let text: String = std::iter::once(first.as_str()).chain(shown).collect();
        text.lines().map(str::to_owned).collect()
    }

    #[test]
    fn the_first_check_that_lost_points_is_in_full_and_others_in_a_line() {
        let lines = plain(&of_five(), Detail::Folded);
        let with = |words: &str| lines.iter().filter(|line| line.contains(words)).count();
        assert_eq!(with("next: Look at first."), 1, "{lines:#?}");
        assert_eq!(with("next: "), 1, "{lines:#?}");
        assert_eq!(with("is full"), 1);
        assert_eq!(with("angle turned: "), 1, "of the first alone: {lines:#?}");
        let second = lines.iter().find(|line| line.contains("second"));
        assert!(second.is_some_and(|line| line.contains("all points")));
        let waiting: Vec<_> = lines.iter().filter(|line| line.contains("waits")).collect();
        assert_eq!(
            waiting,
            ["  .       0/2  2 checks not judged yet: waits; waits, too"]
        );
        assert_eq!(with("`kinemark grade -v`"), 1);
        let everything = plain(&of_five(), Detail::Everything);
        let steps = everything.iter().filter(|line| line.contains("next: "));
        assert_eq!(steps.count(), 2, "{everything:#?}");
        assert!(!everything.join("\n").contains("kinemark grade -v"));
    }

    #[test]
    fn the_total_is_the_last_line_of_everything() {
        let grade = of_five();
        let total = plain(&grade, Detail::Total);
        assert_eq!(total.len(), 1);
        assert_eq!(plain(&grade, Detail::Everything).last(), total.first());
    }
}
