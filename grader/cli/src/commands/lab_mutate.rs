//! `kinemark lab check --mutate`: the reference solution with one small change at a time, graded: what no check notices is either right,
//! or a hole in the rubric.

use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::channel;

use indicatif::ProgressBar;
use kinemark_grader::audit::Accepted;
use kinemark_grader::audit::mutate::{Bench, Fate, Mutation, MutationReport, drawn};
use kinemark_grader::lab::{Lab, Staff};
use kinemark_grader::submission::rhai::STACK_BYTES;
use serde::Serialize;

use crate::disk::Folder;
use crate::failure::{Failure, LOST};
use crate::mutation_text::{kept_text, text};
use crate::{output, pool};

/// What is asked of the changes of the solution.
#[derive(Debug, Clone, clap::Args)]
pub(crate) struct MutateArgs {
    /// Change the reference solution in every small way, one at a time, and show which check notices which change; nothing else is tried
    #[arg(long, conflicts_with_all = ["salts", "variants", "quick", "page"])]
    pub(crate) mutate: bool,
    /// Of all changes try only so many, drawn by --seed
    #[arg(long, value_name = "N", requires = "mutate", conflicts_with = "keep")]
    pub(crate) draw: Option<usize>,
    /// Which changes are drawn: the same number draws the same ones
    #[arg(long, value_name = "N", requires = "draw", default_value_t = 0)]
    pub(crate) seed: u64,
    /// Copy the solution with change N to the lab's mutants, for a person to name
    #[arg(long, value_name = "N", requires = "mutate")]
    pub(crate) keep: Option<usize>,
    /// Name of the copy, without `.rhai` [default: mutation-N]
    #[arg(long = "as", value_name = "NAME", requires = "keep")]
    pub(crate) kept_name: Option<String>,
}

impl MutateArgs {
    /// Whether something is asked that only changes of the solution have.
    pub(crate) fn is_given(&self) -> bool {
        self.draw.is_some() || self.keep.is_some() || self.kept_name.is_some()
    }
}

/// Tries the changes, or keeps one.
pub(crate) fn run(
    args: &MutateArgs,
    (json, jobs): (bool, Option<usize>),
    (lab, staff): (&Lab, &Staff),
    reference: &Folder,
) -> Result<ExitCode, Failure> {
    let bench = Bench::new(lab, staff).map_err(|losing| {
        Failure::broken(
            losing.to_string(),
            "run `kinemark lab check` without --mutate first: changes say something only of a solution with full marks",
        )
    })?;
    if let Some(number) = args.keep {
        return keep(&bench, number, args.kept_name.as_deref(), reference, json);
    }
    let accepted = Accepted::load(reference, lab)?;
    let count = bench.mutations().len();
    let chosen = match args.draw {
        Some(draw) => drawn(&lab.name, count, draw, args.seed),
        None => (0..count).collect(),
    };
    let jobs = jobs.unwrap_or_else(pool::default_jobs);
    let report = MutationReport::new(&bench, fates(&bench, &chosen, jobs), &accepted);
    if json {
        output::print_formatted(&report)?;
    } else {
        output::print(&text(&report, bench.solution()))?;
    }
    let is_bad = !report.problems.is_empty();
    Ok(ExitCode::from(if is_bad { LOST } else { 0 }))
}

/// The fates of the chosen changes, in their order, whatever the number of threads.
fn fates(bench: &Bench<'_>, chosen: &[usize], jobs: usize) -> Vec<(usize, Fate)> {
    let progress = ProgressBar::new(chosen.len() as u64);
    let next = AtomicUsize::new(0);
    let (results, waiting) = channel();
    let work = || {
        let results = results.clone();
        while let Some(index) = chosen.get(next.fetch_add(1, Ordering::Relaxed)) {
            let fate = bench
                .mutations()
                .get(*index)
                .map(|mutation| bench.fate(mutation));
            progress.inc(1);
            if results.send((*index, fate)).is_err() {
                break;
            }
        }
    };
    std::thread::scope(|scope| {
        for _ in 0..jobs.clamp(1, chosen.len().max(1)) {
            let started = std::thread::Builder::new()
                // a change and the solution may nest as deep as their budgets allow
                .stack_size(2 * STACK_BYTES)
                .spawn_scoped(scope, work);
            // the others do its part
            if started.is_err() {
                break;
            }
        }
    });
    // what is left where no thread could be had, on this one, whose stack is as large
    work();
    drop(results);
    progress.finish_and_clear();
    let mut fates: Vec<(usize, Fate)> = waiting
        .into_iter()
        .filter_map(|(index, fate)| Some((index, fate?)))
        .collect();
    fates.sort_by_key(|(index, _)| *index);
    fates
}

/// A copy of a change among the mutants.
#[derive(Debug, Serialize)]
pub(crate) struct Kept<'b> {
    /// The file.
    pub(crate) written: PathBuf,
    /// Its name in mutants.toml.
    pub(crate) name: String,
    /// The tasks in which it loses points.
    pub(crate) tasks: Vec<String>,
    /// The change.
    pub(crate) mutation: &'b Mutation,
    /// What came of it.
    #[serde(flatten)]
    pub(crate) fate: Fate,
}

/// Writes the solution with one change as a new file of the folder `mutants`.
fn keep(
    bench: &Bench<'_>,
    number: usize,
    name: Option<&str>,
    reference: &Folder,
    json: bool,
) -> Result<ExitCode, Failure> {
    let mutations = bench.mutations();
    let mutation = number.checked_sub(1).and_then(|index| mutations.get(index));
    let mutation = mutation.ok_or_else(|| {
        Failure::usage(
            format!(
                "there is no mutation {number}: the solution has {}",
                mutations.len()
            ),
            "`kinemark lab check LAB --mutate` lists them",
        )
    })?;
    let name = name.map_or_else(|| format!("mutation-{number}"), str::to_owned);
    let is_plain = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-';
    if name.is_empty() || name.starts_with('-') || !name.chars().all(is_plain) {
        return Err(Failure::usage(
            format!("`{name}` is no name of a mutant"),
            "write small letters, digits and `-`, as in `sine-for-cosine`",
        ));
    }
    let fate = bench.fate(mutation);
    if matches!(fate, Fate::Unparsed | Fate::Equivalent) {
        return Err(Failure::usage(
            format!("mutation {number} does what the solution does, so it is no mistake"),
            "keep one that is caught, or one that survives",
        ));
    }
    let mut tasks: Vec<String> = match &fate {
        Fate::Caught { by } => by.iter().map(|catch| catch.task.clone()).collect(),
        _ => Vec::new(),
    };
    tasks.dedup();
    let folder = reference.path().join(&bench.lab().name).join("mutants");
    let written = folder.join(format!("{name}.rhai"));
    let program = mutation.program(bench.solution().text());
    output::write_new_file(
        &written,
        program.as_bytes(),
        "give another name with --as NAME",
    )?;
    let kept = Kept {
        written,
        name,
        tasks,
        mutation,
        fate,
    };
    if json {
        output::print_formatted(&kept)?;
    } else {
        let list = reference
            .path()
            .join(&bench.lab().name)
            .join("mutants.toml");
        output::print(&kept_text(&kept, &list))?;
    }
    Ok(ExitCode::SUCCESS)
}
