//! What came of the changes of a solution, for a terminal: every change with what caught it, every check with what it caught, and what
//! survived.

use std::fmt::Write as _;
use std::path::Path;

use kinemark_grader::audit::mutate::{Catch, Fate, MutationReport, TriedMutation};
use kinemark_sim::text::Source;
use owo_colors::OwoColorize as _;

use crate::commands::lab_mutate::Kept;
use crate::output;

/// A line of the list is cut off here.
const MOST_COLUMNS: usize = 88;

/// The whole report.
pub(crate) fn text(report: &MutationReport, solution: &Source) -> String {
    let mut out = format!(
        "{}  {} mutations of {}",
        report.lab.bold(),
        report.total,
        report.solution
    );
    if report.tried < report.total {
        let _ = write!(out, ", {} of them drawn", report.tried);
    }
    out += "\n\n";
    for tried in &report.mutations {
        push_line(&mut out, tried);
    }
    push_checks(&mut out, report);
    let survivors = report.mutations.iter();
    let mut survivors = survivors
        .filter(|tried| tried.fate == Fate::Survived)
        .peekable();
    if survivors.peek().is_some() {
        out += "\nsurvivors: they do something else, and keep all points\n";
    }
    for tried in survivors {
        push_survivor(&mut out, tried, (&report.solution, solution));
    }
    let others = report.problems.iter().filter(|problem| {
        let mut survivors = report
            .mutations
            .iter()
            .filter(|tried| tried.is_unexplained());
        !survivors.any(|tried| problem.mutation == Some(tried.mutation.number))
    });
    for problem in others {
        let _ = writeln!(out, "\n{} {}", "-".red(), problem.what);
        let _ = writeln!(out, "    {} {}", "next:".cyan(), problem.help);
    }
    out += &sums(report);
    out
}

/// A change in a line: its number, its place, the line after it, and what caught it.
fn push_line(out: &mut String, tried: &TriedMutation) {
    let mutation = &tried.mutation;
    let mark = match &tried.fate {
        Fate::Survived if tried.accepted.is_none() => "-".red().to_string(),
        Fate::Survived | Fate::Equivalent | Fate::Unparsed => " ".to_owned(),
        Fate::Caught { .. } => "+".green().to_string(),
    };
    let fate = match &tried.fate {
        Fate::Unparsed => "does not compile".to_owned(),
        Fate::Equivalent => "does the same".to_owned(),
        Fate::Survived if tried.is_choice() => "survives, as right".to_owned(),
        Fate::Survived if tried.accepted.is_some() => "survives, accepted".to_owned(),
        Fate::Survived => "survives".to_owned(),
        Fate::Caught { by } => by.iter().map(Catch::words).collect::<Vec<_>>().join(", "),
    };
    let place = format!("{}:{}", mutation.line, mutation.column);
    let mut after: String = mutation.after.chars().take(MOST_COLUMNS).collect();
    if after.len() < mutation.after.len() {
        after.push('…');
    }
    let number = mutation.number;
    let _ = writeln!(
        out,
        "{mark} {number:>4} {place:<7} {:<9} {after}\n                         {}",
        mutation.operator.0,
        fate.dimmed()
    );
}

/// The checks, each with the number of changes that it caught.
fn push_checks(out: &mut String, report: &MutationReport) {
    let _ = writeln!(out, "\n{:<44} {:>7} {:>10}", "check", "caught", "alone");
    for row in &report.checks {
        let name = row.catch.words();
        if row.caught == 0 {
            let _ = writeln!(
                out,
                "{name:<44} {:>7}             no mutation loses this",
                0
            );
        } else {
            let _ = writeln!(out, "{name:<44} {:>7} {:>10}", row.caught, row.only);
        }
    }
}

/// A survivor with its place, the line before and after, and what to do.
fn push_survivor(out: &mut String, tried: &TriedMutation, (file, solution): (&str, &Source)) {
    let mutation = &tried.mutation;
    let line = solution.text().lines().nth(mutation.line - 1);
    let line = line.unwrap_or_default();
    let indent = line.chars().take_while(|c| c.is_whitespace()).count();
    let caret = " ".repeat((mutation.column - 1).saturating_sub(indent));
    let mark = if tried.accepted.is_some() {
        "+".green().to_string()
    } else {
        "-".red().to_string()
    };
    let _ = writeln!(
        out,
        "\n{mark} {:>4}  {file}:{}:{}  ({})\n    {}\n    {caret}^\n    {}",
        mutation.number,
        mutation.line,
        mutation.column,
        mutation.operator.0,
        line.trim(),
        mutation.after
    );
    match &tried.accepted {
        Some(accepted) => {
            let word = if accepted.is_choice {
                "as right"
            } else {
                "accepted"
            };
            let _ = writeln!(out, "    {word}: {}", accepted.because);
        }
        None => {
            let _ = writeln!(
                out,
                "    {} narrow a band, add a case or a hidden one in which it shows, or write into accepted.toml, with `choice` for `mutation` if it is \
                 as right as the solution:\n{}",
                "next:".cyan(),
                mutation.entry()
            );
        }
    }
}

/// The last line.
fn sums(report: &MutationReport) -> String {
    let share = report.share.map_or_else(String::new, |share| {
        format!(" ({:.1} % of the mistakes)", 100.0 * share)
    });
    let accepted = report
        .mutations
        .iter()
        .filter(|tried| tried.accepted.is_some());
    let mut parts = vec![
        format!("{} equivalent", report.equivalent),
        format!("{} caught{share}", report.caught),
        format!(
            "{} survive: {} as right, {} accepted",
            report.survived,
            report.choices,
            accepted.count().saturating_sub(report.choices)
        ),
    ];
    if report.unparsed > 0 {
        parts.insert(0, format!("{} not compiled", report.unparsed));
    }
    let conclusion = match report.problems.len() {
        0 => "nothing is wrong".green().to_string(),
        1 => "1 problem".red().to_string(),
        count => format!("{count} problems").red().to_string(),
    };
    format!(
        "\n{} tried: {}; {conclusion}\n",
        report.tried,
        parts.join(", ")
    )
}

/// What was kept, and what a person writes about it in the file `list`.
pub(crate) fn kept_text(kept: &Kept<'_>, list: &Path) -> String {
    let tasks: Vec<String> = kept
        .tasks
        .iter()
        .map(|task| format!("\"{task}\""))
        .collect();
    let mut out = format!("wrote {}\n", output::path(&kept.written));
    let _ = writeln!(
        out,
        "    {}\n    {}",
        kept.mutation.before, kept.mutation.after
    );
    if kept.fate == Fate::Survived {
        out += "    It keeps all points: a mutant must lose some, so narrow a band or add a case first.\n";
    }
    let _ = writeln!(
        out,
        "{} name it in {}, with what a student reads who makes this mistake:\n\n[[mutants]]\nname = \"{}\"\ntasks = [{}]\nsays = \"\"",
        "next:".cyan(),
        output::path(list),
        kept.name,
        tasks.join(", ")
    );
    out
}
