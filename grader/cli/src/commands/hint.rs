//! `kinemark hint`: the hints of a check, one step more at each call.

use std::fmt::Write as _;
use std::process::ExitCode;

use kinemark_grader::lab::{Lab, Task};
use kinemark_grader::record::hints::{CheckHints, Hints};
use kinemark_report::visible::visible;
use kinemark_sim::text::suggest;
use owo_colors::OwoColorize as _;
use serde::Serialize;

use crate::failure::{self, Failure};
use crate::labs_folder::{self, LabsFolderArgs};
use crate::last_report::last_report;
use crate::unfolded_hints::UnfoldedHints;
use crate::{output, working_lab};

/// Show the hints of a check, one step more at each call
#[derive(Debug, clap::Args)]
#[command(
    after_help = "Examples:\n  kinemark hint\n  kinemark hint fk\n  kinemark hint fk/position\n  kinemark hint fk/position --all\n\n\
    The first hint is the question that `kinemark grade` shows, the last one says what to do. Hints cost no points, and nobody is \
    notified. Without CHECK it is the first check that lost points in the report in `out`, or a list of the checks that have hints.\n\
    How far you are is in .kinemark-hints.json beside the submission, which is not handed in.\n\
    Exit codes: 0 shown, 2 usage, 3 the lab is broken, 4 how far you are cannot be written."
)]
pub(crate) struct Args {
    /// The task or the check, as `kinemark grade` names it
    #[arg(value_name = "TASK[/CHECK]")]
    pub(crate) check: Option<String>,
    /// The lab [default: that of kinemark.toml, of variant.toml, of the folder, or of the last report]
    #[arg(long, value_name = "LAB")]
    pub(crate) lab: Option<String>,
    /// Show all hints of the check
    #[arg(long)]
    pub(crate) all: bool,
    /// Begin again with the question
    #[arg(long, conflicts_with = "all")]
    pub(crate) restart: bool,
    /// Print the hints as JSON
    #[arg(long)]
    pub(crate) json: bool,
    #[command(flatten)]
    pub(crate) labs_folder: LabsFolderArgs,
}

/// What is known of the hints of a lab.
struct LabHints {
    lab: Lab,
    hints: Hints,
    /// `TASK/CHECK` of those that lost points in the last report.
    lost: Vec<String>,
    unfolded: UnfoldedHints,
}

/// What was meant.
enum Chosen<'h> {
    Check(&'h CheckHints),
    /// Checks to choose from.
    List(Vec<&'h CheckHints>),
}

/// A check with the hints that are unfolded, for programs.
#[derive(Serialize)]
struct Unfolded<'a> {
    lab: &'a str,
    #[serde(flatten)]
    check: Row<'a>,
    /// The question first; as many as are unfolded.
    hints: &'a [String],
    is_last: bool,
}

/// A list of checks, for programs.
#[derive(Serialize)]
struct Listed<'a> {
    lab: &'a str,
    checks: Vec<Row<'a>>,
}

/// A check that has hints.
#[derive(Serialize)]
struct Row<'a> {
    task: &'a str,
    check: &'a str,
    title: &'a str,
    /// Whether it lost points in the last report.
    lost_points: bool,
    unfolded: usize,
    of: usize,
}

/// Unfolds one hint more, and prints it.
pub(crate) fn run(args: &Args) -> Result<ExitCode, Failure> {
    let mut known = known(args)?;
    let hints = known.hints.clone();
    match known.chosen(args.check.as_deref(), &hints)? {
        Chosen::Check(check) => {
            let (name, of) = (check.name(), check.hints.len());
            let before = known.unfolded.of(&known.lab.name, &name).min(of);
            let now = match before {
                _ if args.all => of,
                _ if args.restart => 1,
                before => (before + 1).min(of),
            };
            known.unfolded.set(&known.lab.name, &name, now);
            if args.json {
                output::print_formatted(&Unfolded {
                    lab: &known.lab.name,
                    check: known.row(check),
                    hints: &check.hints[..now],
                    is_last: now == of,
                })?;
            } else {
                output::print_lines(&known.text(args, check, before))?;
            }
        }
        Chosen::List(checks) if args.all => {
            return Err(Failure::usage(
                "--all needs a check".to_owned(),
                &format!("name one, such as `{}`", example(&checks, args)),
            ));
        }
        Chosen::List(checks) => {
            for check in checks.iter().filter(|_| args.restart) {
                known.unfolded.set(&known.lab.name, &check.name(), 0);
            }
            known.print_list(args, &checks)?;
            if !args.restart {
                return Ok(ExitCode::SUCCESS);
            }
        }
    }
    // shown first: a full disk must not cost the hint
    known.unfolded.write()?;
    Ok(ExitCode::SUCCESS)
}

fn known(args: &Args) -> Result<LabHints, Failure> {
    let submission = working_lab::submission(args.lab.as_deref())?;
    let name = match &args.lab {
        Some(name) => name.clone(),
        None => {
            let help = "name the lab, such as `kinemark hint --lab 01-kinematics`";
            working_lab::lab_of(&submission, None, &args.labs_folder, help)?
        }
    };
    let (files, _) = labs_folder::open(&args.labs_folder)?;
    let name = labs_folder::full_name(files.as_ref(), &name)?;
    let lab = Lab::load(files.as_ref(), &name)?;
    let hints = lab.hints();
    let (unfolded, note) = UnfoldedHints::beside(&submission);
    if let Some(note) = note {
        failure::note_in_words(&note);
    }
    let report = last_report(&submission, &lab.name);
    let lost = report.map_or_else(Vec::new, |(_, grade)| {
        let lost = hints.of_losses(&grade).into_iter();
        lost.map(CheckHints::name).collect()
    });
    Ok(LabHints {
        lab,
        hints,
        lost,
        unfolded,
    })
}

/// A command that shows hints, as an example.
fn example(checks: &[&CheckHints], args: &Args) -> String {
    let first = checks.first().map(|check| check.name());
    command(&first.unwrap_or_else(|| "TASK/CHECK".to_owned()), args)
}

/// The command that goes on with a check.
fn command(check: &str, args: &Args) -> String {
    let lab = args.lab.as_ref().map(|lab| format!(" --lab {lab}"));
    format!("kinemark hint {check}{}", lab.unwrap_or_default())
}

impl LabHints {
    fn has_lost(&self, check: &CheckHints) -> bool {
        self.lost.contains(&check.name())
    }

    /// The check that was meant by what was typed, or those to choose from.
    fn chosen<'h>(&self, typed: Option<&str>, hints: &'h Hints) -> Result<Chosen<'h>, Failure> {
        let Some(typed) = typed else {
            let first = hints.checks().iter().find(|check| self.has_lost(check));
            return Ok(first.map_or_else(
                || Chosen::List(hints.checks().iter().collect()),
                Chosen::Check,
            ));
        };
        let (task, check) = match typed.split_once('/') {
            Some((task, check)) => (self.task(task, hints)?, Some(check)),
            None => (self.task(typed, hints)?, None),
        };
        let of_task = hints
            .checks()
            .iter()
            .filter(|known| known.task == task.name);
        let of_task: Vec<&CheckHints> = of_task.collect();
        if let Some(check) = check {
            let found = of_task.iter().find(|known| known.check == check);
            return found
                .map(|found| Chosen::Check(found))
                .ok_or_else(|| without_hints(task, check, &of_task));
        }
        let lost = of_task.iter().find(|check| self.has_lost(check));
        Ok(match (lost, &of_task[..]) {
            (Some(check), _) | (None, [check]) => Chosen::Check(check),
            (None, []) => {
                return Err(Failure::usage(
                    format!("no check of task `{}` has hints", task.name),
                    "the brief has more, and `kinemark hint` lists the checks that have hints",
                ));
            }
            (None, _) => Chosen::List(of_task),
        })
    }

    fn task(&self, name: &str, hints: &Hints) -> Result<&Task, Failure> {
        let tasks = self.lab.tasks.iter();
        let found = tasks.clone().find(|task| task.name == name);
        found.ok_or_else(|| {
            let mut checks = hints.checks().iter();
            let help = match checks.find(|known| known.check == name) {
                Some(check) => format!("did you mean the check `{}`?", check.name()),
                None => suggest(name, "tasks", tasks.map(|task| task.name.as_str())),
            };
            Failure::usage(
                format!("lab `{}` has no task `{}`", self.lab.name, visible(name)),
                &help,
            )
        })
    }

    fn row<'a>(&self, check: &'a CheckHints) -> Row<'a> {
        let of = check.hints.len();
        Row {
            task: &check.task,
            check: &check.check,
            title: &check.title,
            lost_points: self.has_lost(check),
            unfolded: self.unfolded.of(&self.lab.name, &check.name()).min(of),
            of,
        }
    }

    /// The hint that is new, or all of them; `before` were unfolded before.
    fn text(&self, args: &Args, check: &CheckHints, before: usize) -> String {
        let Row {
            unfolded,
            of,
            lost_points,
            ..
        } = self.row(check);
        let name = check.name();
        let lost = if lost_points {
            ", which lost points in the last report"
        } else {
            ""
        };
        let mut text = format!("{} ({name}){lost}\n", visible(&check.title).bold());
        let first = if args.all { 0 } else { unfolded - 1 };
        for (at, hint) in check.hints[..unfolded].iter().enumerate().skip(first) {
            let number = format!("Hint {} of {of} for {name}:", at + 1);
            let _ = writeln!(text, "{} {}", number.cyan(), visible(hint));
        }
        let more = command(&name, args);
        let next = match (unfolded < of, before == of && !args.all && of > 1) {
            (true, _) => format!("the next one: {more}"),
            (false, true) => format!("That was the last one again; all of them: {more} --all"),
            (false, false) => "That was the last one.".to_owned(),
        };
        let _ = writeln!(text, "{}", next.dimmed());
        if unfolded == of
            && let Some(other) = self.lost.iter().find(|other| **other != name)
        {
            let other = command(other, args);
            let _ = writeln!(text, "{}", format!("another check: {other}").dimmed());
        }
        text
    }

    /// The checks that have hints, with how many of them are unfolded.
    fn print_list(&self, args: &Args, checks: &[&CheckHints]) -> Result<(), Failure> {
        let rows = checks.iter().map(|check| self.row(check));
        if args.json {
            return output::print_formatted(&Listed {
                lab: &self.lab.name,
                checks: rows.collect(),
            });
        }
        if checks.is_empty() {
            let text = format!("no check of lab `{}` has hints\n", self.lab.name);
            return output::print_lines(&text);
        }
        let width = checks.iter().map(|check| check.name().len()).max();
        let width = width.unwrap_or_default();
        let mut text = "Checks that have hints, with how many you have unfolded:\n".to_owned();
        for (check, row) in checks.iter().zip(rows) {
            let (name, unfolded, of) = (check.name(), row.unfolded, row.of);
            let title = visible(row.title);
            let _ = writeln!(text, "  {name:<width$}  {unfolded} of {of}  {title}");
        }
        let _ = writeln!(text, "\nShow one with `{}`.", example(checks, args));
        output::print_lines(&text)
    }
}

/// Why there is no hint to a check that was named.
fn without_hints(task: &Task, check: &str, of_task: &[&CheckHints]) -> Failure {
    let known = of_task.iter().map(|known| known.check.as_str());
    let is_there = task.checks().iter().any(|known| known.name == check);
    let what = if is_there {
        format!("check `{}/{check}` has no hints", task.name)
    } else {
        format!("task `{}` has no check `{}`", task.name, visible(check))
    };
    let help = if is_there {
        format!("with hints: {}", known.collect::<Vec<_>>().join(", "))
    } else {
        suggest(check, "checks with hints", known)
    };
    Failure::usage(what, &help)
}
