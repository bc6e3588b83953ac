//! A lab graded on a Slurm cluster: the scripts of its parts and of the job that joins them, submitted, found again and waited for.
//!
//! A run is a folder below `book/slurm/`, and its jobs carry the folder's name: whoever reads the book can ask Slurm for them, also
//! after the process that submitted them has ended. Nothing else is remembered. What a run left open follows from the journal.

use std::collections::BTreeMap;
use std::fs;
use std::path::PathBuf;
use std::time::Duration;

use indicatif::{ProgressBar, ProgressStyle};
use kinemark_course::book::{Book, RUNS};
use serde::{Deserialize, Serialize};

use crate::course_folder::book_failure;
use crate::failure::{Failure, warn_in_words};
use crate::shard::Shard;
use crate::slurm_queue::{self, COMPLETED, QueuedJob, has_ended};
use crate::slurm_script::{Scripts, Work, log_option, text_of};
use crate::{interrupt, output};

/// How a lab is graded on a Slurm cluster.
#[derive(Debug, clap::Args)]
pub(crate) struct SlurmArgs {
    /// Grade on a Slurm cluster, in N parts: a job array, and a job that joins what it graded
    #[arg(long, value_name = "N", conflicts_with = "shard", value_parser = clap::value_parser!(u32).range(1..))]
    pub(crate) slurm: Option<u32>,
    /// With --slurm: an option of `sbatch` for each job, such as --sbatch=--partition=short; can be given several times
    #[arg(long, value_name = "OPTION", requires = "slurm", allow_hyphen_values = true, value_parser = sbatch_option)]
    pub(crate) sbatch: Vec<String>,
    /// With --slurm: submit the jobs, and do not wait for them
    #[arg(long, requires = "slurm")]
    pub(crate) detach: bool,
}

/// Options of `sbatch` that are set here, or that would change what it prints and does.
const OURS: [&str; 11] = [
    "--array",
    "--chdir",
    "--clusters",
    "--dependency",
    "--error",
    "--job-name",
    "--output",
    "--parsable",
    "--test-only",
    "--wait",
    "--wrap",
];

/// The same options by one letter.
const OURS_SHORT: &str = "aDMdeJoW";

fn sbatch_option(typed: &str) -> Result<String, String> {
    let Some(option) = typed.strip_prefix('-') else {
        return Err("write an option with its dashes, such as --sbatch=--time=30".to_owned());
    };
    let name = typed.split('=').next().unwrap_or(typed);
    let is_short = |letter| !option.starts_with('-') && OURS_SHORT.contains(letter);
    if OURS.contains(&name) || option.starts_with(is_short) {
        return Err(format!(
            "`{name}` is set by kinemark, or cannot be used with it"
        ));
    }
    Ok(typed.to_owned())
}

/// The files of a run.
const RUN_FILE: &str = "run.json";
const PART_SCRIPT: &str = "part.sh";
const JOIN_SCRIPT: &str = "join.sh";
/// What helps where a file of a run cannot be written.
const HELP: &str = "free some space, then try again";

/// What a run's folder says of it.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
struct RunFile {
    lab: String,
    /// How many parts the class has.
    count: u32,
    /// The numbers of the parts that are graded.
    parts: Vec<u32>,
}

/// A run.
#[derive(Debug)]
pub(crate) struct SlurmRun {
    folder: PathBuf,
    name: String,
    file: RunFile,
}

impl SlurmRun {
    /// The run of `lab` in the book `book` whose jobs are in Slurm's queue, if there is one.
    pub(crate) fn in_queue(book: &Book, lab: &str) -> Result<Option<Self>, Failure> {
        let mut runs = Self::all(book, lab);
        let names: Vec<&str> = runs.iter().map(|run| run.name.as_str()).collect();
        let jobs = slurm_queue::jobs(&names)?;
        let active = jobs.iter().find(|job| !job.has_ended());
        let at = active.and_then(|job| runs.iter().position(|run| run.name == job.name));
        Ok(at.map(|at| runs.swap_remove(at)))
    }

    /// Every run of `lab` that the book has; a folder that is none is passed over.
    fn all(book: &Book, lab: &str) -> Vec<Self> {
        let entries = fs::read_dir(book.root().join(RUNS)).into_iter().flatten();
        let read = entries.filter_map(|entry| {
            let folder = entry.ok()?.path();
            let name = folder.file_name()?.to_str()?.to_owned();
            let file: RunFile =
                serde_json::from_slice(&fs::read(folder.join(RUN_FILE)).ok()?).ok()?;
            (file.lab == lab).then_some(Self { folder, name, file })
        });
        read.collect()
    }

    /// Writes the scripts of a new run and submits them: the parts as an array, then what joins them.
    pub(crate) fn submit(book: &Book, work: &Work<'_>) -> Result<(Self, [String; 2]), Failure> {
        let scripts = Scripts::new(work)?;
        let run = Self::begin(book, work)?;
        run.write(PART_SCRIPT, scripts.part.as_bytes())?;
        run.write(JOIN_SCRIPT, scripts.join.as_bytes())?;
        let options = |log: &str, more: String| {
            let jobs = work.jobs.map(|jobs| format!("--cpus-per-task={jobs}"));
            let mut options: Vec<String> = jobs.into_iter().collect();
            options.extend_from_slice(work.options);
            options.push(format!("--job-name={}", run.name));
            options.push(format!("--chdir={}", text_of(&run.folder)?));
            options.push(log_option(&run.folder, log)?);
            options.push(more);
            Ok::<_, Failure>(options)
        };
        let parts: Vec<String> = run.file.parts.iter().map(u32::to_string).collect();
        let parts = options("part-%a.log", format!("--array={}", parts.join(",")))?;
        let array = match slurm_queue::submit(&run.folder, PART_SCRIPT, &parts) {
            Ok(array) => array,
            Err(refused) => {
                // nothing runs: a folder that stays would say nothing
                let _ = fs::remove_dir_all(&run.folder);
                return Err(refused);
            }
        };
        let join = options("join.log", format!("--dependency=afterany:{array}"))?;
        let join = slurm_queue::submit(&run.folder, JOIN_SCRIPT, &join)?;
        Ok((run, [array, join]))
    }

    /// A folder of its own with what it is for: from here on it is found by its name.
    fn begin(book: &Book, work: &Work<'_>) -> Result<Self, Failure> {
        let day = jiff::Timestamp::now().strftime("%Y%m%dT%H%M%SZ");
        let prefix = format!("kinemark-{}-{day}-", work.lab);
        let folder = book.begin_run(&prefix).map_err(book_failure)?;
        let name = folder.file_name().unwrap_or_default();
        let run = Self {
            name: name.to_string_lossy().into_owned(),
            file: RunFile {
                lab: work.lab.to_owned(),
                count: work.parts.first().map_or(1, |part| part.count()),
                parts: work.parts.iter().map(|part| part.number()).collect(),
            },
            folder,
        };
        run.write(RUN_FILE, output::json(&run.file)?.as_bytes())?;
        Ok(run)
    }

    fn write(&self, name: &str, bytes: &[u8]) -> Result<(), Failure> {
        output::write_private_file(&self.folder.join(name), bytes, HELP)
    }

    /// Its folder, as people read it.
    pub(crate) fn shown(&self) -> String {
        output::path(&self.folder)
    }

    /// Says which parts did not end well in the states `seen`; `left` counts what of a part nobody has graded or tried.
    ///
    /// # Errors
    /// Exit code 4 where something is left.
    pub(crate) fn verdict(
        &self,
        seen: &BTreeMap<u32, String>,
        left: impl Fn(Shard) -> usize,
    ) -> Result<(), Failure> {
        let mut open = Vec::new();
        for part in Shard::all(self.file.count) {
            let number = part.number();
            if !self.file.parts.contains(&number) {
                match left(part) {
                    0 => {}
                    count => open.push(format!(
                        "part {part} has {count} that were handed in after the jobs were submitted"
                    )),
                }
                continue;
            }
            let state = seen.get(&number);
            let state = state.filter(|state| has_ended(state) && *state != COMPLETED);
            let ended = state.map_or("ended".to_owned(), |state| format!("ended as {state}"));
            let log = output::path(&self.folder.join(format!("part-{number}.log")));
            match left(part) {
                0 if state.is_none() => {}
                0 => warn_in_words(
                    &format!(
                        "part {part} {ended}; what it left open was graded by the job that joins"
                    ),
                    &format!("its log is {log}"),
                ),
                count => open.push(format!("part {part} {ended} and left {count} open: {log}")),
            }
        }
        if open.is_empty() {
            return Ok(());
        }
        Err(Failure::fault(
            format!("not everything was graded\n{}", open.join("\n")),
            "read the logs, and join.log beside them; the same command submits these parts again",
        ))
    }

    /// Waits until none of its jobs is in the queue, and gives the state in which each part was seen last. `left` counts what is not
    /// graded yet.
    pub(crate) fn wait(
        &self,
        left: impl Fn() -> Result<usize, Failure>,
    ) -> Result<BTreeMap<u32, String>, Failure> {
        let mut seen = BTreeMap::new();
        let progress = Progress::new(left()?);
        let mut pause = SHORTEST_PAUSE;
        let mut unanswered = 0;
        loop {
            let jobs = match slurm_queue::jobs(&[&self.name]) {
                Ok(jobs) => {
                    unanswered = 0;
                    jobs
                }
                // a controller that restarts is back soon
                Err(failure) if unanswered >= MOST_UNANSWERED => return Err(failure),
                Err(_) => {
                    unanswered += 1;
                    self.pause(pause)?;
                    continue;
                }
            };
            for job in &jobs {
                if let Some(task) = job.task {
                    seen.insert(task, job.state.clone());
                }
            }
            if jobs.iter().all(QueuedJob::has_ended) {
                progress.bar.finish_and_clear();
                return Ok(seen);
            }
            progress.show(left()?, &jobs);
            self.pause(pause)?;
            pause = (pause * 2).min(LONGEST_PAUSE);
        }
    }

    /// Sleeps, and wakes for Ctrl-C, which ends the waiting alone.
    fn pause(&self, pause: Duration) -> Result<(), Failure> {
        let step = Duration::from_millis(50);
        let mut slept = Duration::ZERO;
        while slept < pause {
            if interrupt::asked() {
                return Err(Failure::left_alone(format!(
                    "the same command waits for them again, and this ends them:\nscancel --name={}",
                    self.name
                )));
            }
            std::thread::sleep(step);
            slept += step;
        }
        Ok(())
    }
}

/// Between two looks at the queue, at first and in the end: a controller serves everybody.
const SHORTEST_PAUSE: Duration = Duration::from_millis(250);
const LONGEST_PAUSE: Duration = Duration::from_secs(5);
/// How often `squeue` may fail in a row.
const MOST_UNANSWERED: u32 = 10;

/// How far a run is, on a terminal.
struct Progress {
    bar: ProgressBar,
    all: usize,
}

impl Progress {
    fn new(all: usize) -> Self {
        let bar = ProgressBar::new(all as u64);
        if let Ok(style) = ProgressStyle::with_template("{pos}/{len} {wide_bar} {msg}") {
            bar.set_style(style);
        }
        Self { bar, all }
    }

    fn show(&self, left: usize, jobs: &[QueuedJob]) {
        let running = jobs.iter().filter(|job| job.state == "RUNNING").count();
        let ended = jobs.iter().filter(|job| job.has_ended()).count();
        let waiting = jobs.len() - running - ended;
        self.bar.set_position(self.all.saturating_sub(left) as u64);
        self.bar
            .set_message(format!("jobs: {running} running, {waiting} waiting"));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn options_that_are_set_here_are_refused() {
        for typed in [
            "--partition=short",
            "--time=30",
            "-p",
            "-N1",
            "--mem-per-cpu=1G",
        ] {
            assert_eq!(sbatch_option(typed).as_deref(), Ok(typed));
        }
        for typed in [
            "--array=1",
            "--wait",
            "-a1",
            "-W",
            "-d",
            "partition=short",
            "",
        ] {
            assert!(sbatch_option(typed).is_err(), "{typed}");
        }
    }
}
