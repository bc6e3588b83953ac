//! Slurm's own commands: `sbatch` submits a job, `squeue` lists what has become of it. Both are asked in words and answer in lines.

use std::ffi::OsStr;
use std::io::ErrorKind;
use std::path::Path;
use std::process::Command;

use crate::failure::Failure;

/// A job, or one task of a job array, as `squeue` lists it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct QueuedJob {
    pub(crate) name: String,
    /// The number of the job; tasks of an array have that of the array.
    pub(crate) id: String,
    /// The number of the task in its array.
    pub(crate) task: Option<u32>,
    /// Such as `RUNNING`.
    pub(crate) state: String,
}

/// States in which a job stays; in any other it waits or runs, or will.
const ENDED: [&str; 10] = [
    "BOOT_FAIL",
    "CANCELLED",
    COMPLETED,
    "DEADLINE",
    "FAILED",
    "NODE_FAIL",
    "OUT_OF_MEMORY",
    "PREEMPTED",
    "REVOKED",
    "TIMEOUT",
];

/// The state of a job that ended well.
pub(crate) const COMPLETED: &str = "COMPLETED";

/// Whether a job in this state has ended, well or not.
pub(crate) fn has_ended(state: &str) -> bool {
    ENDED.contains(&state)
}

impl QueuedJob {
    /// Whether it has ended, well or not.
    pub(crate) fn has_ended(&self) -> bool {
        has_ended(&self.state)
    }
}

/// Refuses a machine without Slurm's commands, before anything is done.
pub(crate) fn require() -> Result<(), Failure> {
    for program in ["sbatch", "squeue"] {
        if let Err(error) = Command::new(program).arg("--version").output() {
            return Err(not_there(program, &error));
        }
    }
    Ok(())
}

fn not_there(program: &str, error: &std::io::Error) -> Failure {
    let what = match error.kind() {
        ErrorKind::NotFound => format!("there is no `{program}` on this machine's PATH"),
        _ => format!("`{program}` cannot be run: {error}"),
    };
    Failure::usage(
        what,
        "log in where your cluster's jobs are submitted, and give the command there; without --slurm it grades on this machine",
    )
}

/// Submits the script `script` of the folder `folder` with `options`; gives the number of the job.
pub(crate) fn submit<S: AsRef<OsStr>>(
    folder: &Path,
    script: &str,
    options: &[S],
) -> Result<String, Failure> {
    let ran = Command::new("sbatch")
        // what a site or a person sets for all jobs must not make one wait here, or an array of another
        .env_remove("SBATCH_WAIT")
        .env_remove("SBATCH_ARRAY_INX")
        .args(options)
        .arg("--parsable")
        .arg(folder.join(script))
        .output()
        .map_err(|error| not_there("sbatch", &error))?;
    let said = String::from_utf8_lossy(&ran.stdout);
    match job_number(&said) {
        Some(number) if ran.status.success() => Ok(number.to_owned()),
        _ => Err(Failure::fault(
            format!("sbatch refuses the job: {}", last_line(&ran.stderr)),
            "check the options after --sbatch; `sinfo` lists the partitions of the cluster",
        )),
    }
}

/// The number in what `sbatch --parsable` prints: `12`, or `12;CLUSTER`.
fn job_number(said: &str) -> Option<&str> {
    let number = said.lines().last()?.split(';').next()?.trim();
    let is_number = !number.is_empty() && number.bytes().all(|byte| byte.is_ascii_digit());
    is_number.then_some(number)
}

/// The jobs of these names, those that ended a short while ago among them.
pub(crate) fn jobs(names: &[&str]) -> Result<Vec<QueuedJob>, Failure> {
    if names.is_empty() {
        return Ok(Vec::new());
    }
    let ran = Command::new("squeue")
        .args(["--noheader", "--array", "--states=all"])
        .arg("--format=%j|%F|%K|%T")
        .arg(format!("--name={}", names.join(",")))
        .output()
        .map_err(|error| not_there("squeue", &error))?;
    if !ran.status.success() {
        return Err(Failure::fault(
            format!("squeue does not answer: {}", last_line(&ran.stderr)),
            "jobs that were submitted go on; the same command looks for them again",
        ));
    }
    let lines = String::from_utf8_lossy(&ran.stdout);
    // with several clusters there are headings between the lines
    Ok(lines.lines().filter_map(queued_job).collect())
}

fn queued_job(line: &str) -> Option<QueuedJob> {
    let mut cells = line.trim().split('|').map(str::to_owned);
    let (name, id, task, state) = (cells.next()?, cells.next()?, cells.next()?, cells.next()?);
    Some(QueuedJob {
        name,
        id,
        task: task.parse().ok(),
        state,
    })
}

/// The last line of what a command complains of.
fn last_line(bytes: &[u8]) -> String {
    let text = String::from_utf8_lossy(bytes);
    let last = text.lines().rfind(|line| !line.trim().is_empty());
    last.map_or_else(|| "it does not say why".to_owned(), str::to_owned)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_number_of_a_job_is_read_and_nothing_else() {
        assert_eq!(job_number("12\n"), Some("12"));
        assert_eq!(job_number("a notice of the site\n12;far\n"), Some("12"));
        for said in ["", "\n", "Submitted batch job 12\n", ";far"] {
            assert_eq!(job_number(said), None, "{said:?}");
        }
    }

    #[test]
    fn lines_of_the_queue_are_read_and_headings_are_not() {
        let job = queued_job("kinemark-01-x|12|3|RUNNING").unwrap();
        assert_eq!((job.id.as_str(), job.task), ("12", Some(3)));
        assert!(!job.has_ended());
        let join = queued_job("kinemark-01-x|13|N/A|OUT_OF_MEMORY\n").unwrap();
        assert_eq!(join.task, None);
        assert!(join.has_ended());
        assert_eq!(queued_job("CLUSTER: far"), None);
        assert!(jobs(&[]).unwrap().is_empty());
    }
}
