//! An explanation as text for a terminal: every hidden case and run with its numbers, what the submission made of it, and what that
//! costs. It is for the course staff.

use kinemark_sim::text::number::{metres, seconds, trimmed};
use owo_colors::OwoColorize as _;

use super::stop_words::{is_missing_function, stop_of_whole_file};
use super::text::{hidden_word, name_width};
use super::visible::visible;
use kinemark_grader::record::explanation::{DrawCheck, ExplainedDraw, ExplainedTask, Explanation};
use kinemark_grader::record::grade::{CaseGrade, Evidence, Stopped, TaskGrade, TaskKind};
use kinemark_grader::record::quantity::{points, with_unit};

/// The first line of everything that shows hidden numbers.
pub(crate) const FOR_STAFF: &str = "For course staff only: this shows hidden numbers and answers.";

/// How the points of a motion task come about.
pub(crate) const HOW_RUNS_COUNT: &str = "The points of a check are the mean of the visible run and all hidden runs. The score of a hidden run is rounded down to twentieths.";

/// Renders an explanation; the paragraph for the student is another text.
pub fn text(explanation: &Explanation) -> String {
    let grade = &explanation.graded.grade;
    let mut lines = vec![
        format!(
            "{}  {}",
            grade.lab.name.bold(),
            visible(&grade.submission.name)
        ),
        FOR_STAFF.yellow().bold().to_string(),
    ];
    if let Some(variant) = &grade.variant {
        lines.push(visible(&variant.words()).dimmed().to_string());
    }
    lines.push(format!(
        "{} of {} points",
        points(grade.points),
        points(grade.max_points)
    ));
    if explanation.tasks.is_empty() {
        lines.push("Nothing is hidden in this lab.".to_owned());
    }
    let whole_file = stop_of_whole_file(grade);
    if let Some(stopped) = whole_file {
        lines.push("Nothing of it could be run:".to_owned());
        push_stopped(&mut lines, stopped, "  ");
    }
    let width = name_width(explanation.tasks.iter().map(|task| task.name.as_str()));
    for task in &explanation.tasks {
        lines.push(String::new());
        let record = grade.tasks.iter().find(|record| record.name == task.name);
        push_task(&mut lines, task, width, record, whole_file.is_some());
    }
    push_hints(&mut lines, explanation);
    let lines: Vec<&str> = lines.iter().map(|line| line.trim_end()).collect();
    lines.join("\n") + "\n"
}

/// All hints of the checks that lost points, which the student's report does not have.
fn push_hints(lines: &mut Vec<String>, explanation: &Explanation) {
    let losses = explanation.hints.of_losses(&explanation.graded.grade);
    if losses.is_empty() {
        return;
    }
    lines.push(String::new());
    lines.push("Hints of the checks that lost points".bold().to_string());
    for check in losses {
        lines.push(format!("  {}  {}", check.name(), visible(&check.title)));
        let numbered = check.hints.iter().zip(1..);
        lines.extend(numbered.map(|(hint, number)| format!("    {number}. {}", visible(hint))));
    }
}

fn push_task(
    lines: &mut Vec<String>,
    task: &ExplainedTask,
    width: usize,
    record: Option<&TaskGrade>,
    nothing_ran: bool,
) {
    let earned = record.map_or_else(String::new, |record| {
        format!("{}/{}", points(record.points), points(record.max_points))
    });
    lines.push(format!(
        "{:<width$} {earned:>8}  {}",
        visible(&task.name).bold(),
        visible(&task.title)
    ));
    let stopped = record.and_then(|record| record.stopped.as_ref());
    if let Some(stopped) = stopped.filter(|_| !nothing_ran) {
        push_stopped(lines, stopped, "  ");
    }
    let nothing_ran = nothing_ran || record.is_some_and(is_missing_function);
    match task.kind {
        _ if nothing_ran => {}
        TaskKind::Function => lines.extend(bands(task)),
        TaskKind::Motion => {
            lines.push(format!("  {}", HOW_RUNS_COUNT.dimmed()));
            lines.extend(record.into_iter().flat_map(|record| sums(task, record)));
        }
    }
    if !task.counts && !nothing_ran {
        let why =
            "The visible run did not reach its end, so these runs were not part of the grade.";
        lines.push(format!("  {}", why.yellow()));
    }
    for (class, draws) in task.classes() {
        let good = draws.iter().filter(|draw| draw.good).count();
        lines.push(format!(
            "  hidden {} of the class \"{}\": {good} of {} good",
            hidden_word(task.kind),
            visible(class),
            draws.len()
        ));
        // without a call every one of them says the same
        let draws = if nothing_ran { Vec::new() } else { draws };
        for draw in draws {
            push_draw(lines, draw);
        }
    }
}

/// The bands of a function task, once for all its cases.
fn bands(task: &ExplainedTask) -> Vec<String> {
    let mut draws = task.attempts.iter().flat_map(|attempt| &attempt.draws);
    let checks = draws.next().map_or(&[][..], |draw| &draw.checks);
    let band = |check: &DrawCheck| {
        let line = format!("{}: {}", visible(&check.title), band_of(check));
        format!("  {}", line.dimmed())
    };
    checks.iter().map(band).collect()
}

/// What earns all points of a check, and what earns none.
pub(crate) fn band_of(check: &DrawCheck) -> String {
    let [full, zero] = &check.bounds;
    format!("all points {full}, none {zero}")
}

/// The points of each check of a motion task as the mean of its runs.
fn sums(task: &ExplainedTask, record: &TaskGrade) -> Vec<String> {
    let checks = record.checks.iter().zip(&task.scores).enumerate();
    let sums = checks.map(|(i, (check, visible_score))| {
        let draws = task.attempts.iter().flat_map(|attempt| &attempt.draws);
        let counted = draws.filter_map(|draw| draw.checks.get(i)?.counted);
        let counted: Vec<String> = counted.map(|share| trimmed(share, 2)).collect();
        format!(
            "  {:>9}  {}: visible run {}, hidden {}",
            format!("{}/{}", points(check.points), points(check.max_points)),
            visible(&check.title),
            share(*visible_score),
            counted.join(", ")
        )
    });
    sums.collect()
}

/// A share of points, rounded down, so that only all of them look like it.
pub(crate) fn share(score: f64) -> String {
    trimmed((score * 1000.0).floor() / 1000.0, 3)
}

fn push_draw(lines: &mut Vec<String>, explained: &ExplainedDraw) {
    let draw = &explained.draw;
    let lost = explained.checks.iter().any(DrawCheck::is_lost);
    let mark = match (explained.good, lost) {
        (true, false) => "+".green().to_string(),
        (true, true) => "~".yellow().to_string(),
        (false, _) => "-".red().to_string(),
    };
    let what = match draw.kind {
        TaskKind::Function => "case",
        TaskKind::Motion => "run",
    };
    lines.push(format!(
        "    {mark} {what} {:<3} {}",
        draw.number,
        visible(&draw.words)
    ));
    if let Some(stopped) = &explained.stopped {
        push_stopped(lines, stopped, "        ");
    }
    if let Some(case) = &explained.case {
        push_case(lines, case, &explained.branches_m, lost);
    }
    let is_shown = |check: &&DrawCheck| check.is_lost() || check.counted.is_some();
    let shown = explained.checks.iter().filter(is_shown);
    let (judged, unjudged): (Vec<_>, Vec<_>) = shown.partition(|check| check.score.is_some());
    for check in judged {
        push_check(lines, check);
    }
    if !unjudged.is_empty() {
        let titles: Vec<_> = unjudged.iter().map(|check| visible(&check.title)).collect();
        let line = format!(". not judged   {}", titles.join("; "));
        lines.push(format!("        {}", line.dimmed()));
    }
}

/// The answer to a case, in one line where no point is lost.
fn push_case(lines: &mut Vec<String>, case: &CaseGrade, branches_m: &[f64], lost: bool) {
    let answer = visible(&case.answer);
    let off = case_error(case, branches_m);
    if !lost && case.good {
        let off = off.map_or_else(String::new, |off| format!(", off by {off}"));
        lines.push(format!("        answer    {answer}{off}"));
        return;
    }
    lines.push(format!("        answer    {answer}"));
    if let Some(expected) = &case.expected {
        lines.push(format!("        expected  {}", visible(expected)));
    }
    lines.extend(off.map(|off| format!("        off by    {off}")));
}

/// How far an answer is off: of inverse kinematics branch by branch.
pub(crate) fn case_error(case: &CaseGrade, branches_m: &[f64]) -> Option<String> {
    if !branches_m.is_empty() {
        let branches: Vec<String> = branches_m.iter().map(|off_m| metres(*off_m)).collect();
        return Some(branches.join(" and "));
    }
    let relative = || case.relative_error.map(|relative| with_unit(relative, ""));
    case.error_m.map(metres).or_else(relative)
}

fn push_stopped(lines: &mut Vec<String>, stopped: &Stopped, indent: &str) {
    let at = match (stopped.time_s, &stopped.case) {
        (Some(time_s), _) => format!(" (at {})", seconds(time_s)),
        (None, Some(case)) => format!(" (case \"{}\")", visible(case)),
        (None, None) => String::new(),
    };
    lines.push(format!(
        "{indent}{} {}{at}",
        "stopped:".red(),
        visible(&stopped.message)
    ));
    if let (Some(line), Some(source)) = (stopped.line, &stopped.source_line) {
        lines.push(format!("{indent}line {line}: {}", visible(source)));
    }
}

fn push_check(lines: &mut Vec<String>, check: &DrawCheck) {
    let mark = match check.score {
        Some(score) if score >= 1.0 => "+".green().to_string(),
        Some(score) if score > 0.0 => "~".yellow().to_string(),
        _ => "-".red().to_string(),
    };
    let title = visible(&check.title);
    lines.push(format!(
        "        {mark} {:<12} {title}: {}",
        scores(check),
        visible(&value_of(check))
    ));
    // of a case the value says the same
    if check.counted.is_some() {
        lines.extend(
            check
                .evidence
                .iter()
                .map(|fact| format!("                       {}", evidence(fact))),
        );
    }
}

/// The share that a check earned in a draw, and the share that counts if it is another one.
pub(crate) fn scores(check: &DrawCheck) -> String {
    let Some(score) = check.score else {
        return "not judged".to_owned();
    };
    match check.counted {
        Some(counted) if (counted - score).abs() > 1e-9 => {
            format!("{} counts {}", share(score), trimmed(counted, 2))
        }
        _ => share(score),
    }
}

/// The measured value of a check beside that of the reference solution, and its band.
pub(crate) fn value_of(check: &DrawCheck) -> String {
    let reference = check.measure.as_ref().zip(check.reference);
    let reference = reference.map_or_else(String::new, |(measure, value)| {
        format!(" (reference solution: {})", with_unit(value, &measure.unit))
    });
    let words = check.words();
    match (check.score, check.counted) {
        (Some(_), Some(_)) => format!("{words}{reference}; {}", band_of(check)),
        _ => words,
    }
}

fn evidence(fact: &Evidence) -> String {
    let message = visible(&fact.message);
    match fact.time_s {
        Some(time_s) => format!("{message} {}", format!("[at {}]", seconds(time_s)).dimmed()),
        None => message.into_owned(),
    }
}
