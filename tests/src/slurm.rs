//! `kinemark course grade --slurm`: against stand-ins for `sbatch` and `squeue`, and with `KINEMARK_SLURM=1` against a real Slurm.
#![cfg(unix)]

use std::os::unix::fs::PermissionsExt as _;
use std::process::{Command, Stdio};

use crate::course_class::{
    LAB, Stands, class, class_in, has_graded, large_class_in, records, standings,
};
use crate::testbed::{CommandResult, TestBed, files_below, until};

/// A folder's name that a job script has to quote.
const ODD: &str = "Anna's $course \"A\" 100%a";

/// Does what Slurm does with a job, at once: a task after the other, with the log where Slurm has it. `lost` names tasks that die, and
/// `join` the job that joins.
const SBATCH: &str = r#"#!/bin/sh
[ "$1" != --version ] || exit 0
bed=$(dirname "$(dirname "$0")")
echo "$@" >>"$bed/sbatch.args"
for option; do
  case $option in
    --array=*) tasks=$(echo "${option#*=}" | tr , ' ') ;;
    --chdir=*) folder=${option#*=} ;;
    --output=*) output=${option#*=} ;;
    --job-name=*) name=${option#*=} ;;
    --partition=no) echo "sbatch: error: invalid partition specified: no" >&2; exit 1 ;;
  esac
  script=$option
done
cd "$folder" || exit 1
number=$(($(cat "$bed/jobs" 2>/dev/null || echo 10) + 1))
echo $number >"$bed/jobs"
log() { printf %s "$output" | sed "s/%%/|/g; s/%a/$1/g; s/|/%/g"; }
lost() { grep -qx "$1" "$bed/lost" 2>/dev/null; }
if [ -z "$tasks" ]; then
  lost join || sh "$script" >"$(log)" 2>&1
fi
for task in $tasks; do
  if lost "$task"; then
    echo "$name|$number|$task|OUT_OF_MEMORY" >>"$bed/queue"
  else
    SLURM_ARRAY_TASK_ID=$task sh "$script" >"$(log "$task")" 2>&1
    echo "$name|$number|$task|COMPLETED" >>"$bed/queue"
  fi
done
echo "$number;far"
"#;

/// Lists what `queue` has for the names that are asked about; `active` is a state that every job is in for so many looks.
const SQUEUE: &str = r#"#!/bin/sh
[ "$1" != --version ] || exit 0
bed=$(dirname "$(dirname "$0")")
[ ! -e "$bed/silent" ] || { echo "slurm_load_jobs error: Unable to contact slurm controller" >&2; exit 1; }
for option; do
  case $option in --name=*) names=$(echo "${option#*=}" | tr , '|') ;; esac
done
echo "CLUSTER: far"
looks=$(cat "$bed/looks" 2>/dev/null || echo 0)
if [ "$looks" -gt 0 ]; then
  echo $((looks - 1)) >"$bed/looks"
  grep -E "^($names)\|" "$bed/queue" | sed 's/[A-Z_]*$/RUNNING/'
else
  grep -E "^($names)\|" "$bed/queue" || true
fi
"#;

/// A course in a folder with an odd name, and stand-ins for Slurm's commands beside it.
fn cluster() -> (TestBed, String) {
    let bed = class_in(TestBed::named(ODD));
    for (name, text) in [("sbatch", SBATCH), ("squeue", SQUEUE)] {
        bed.write(&format!("../bin/{name}"), text);
        let mode = std::fs::Permissions::from_mode(0o755);
        std::fs::set_permissions(bed.path("../bin").join(name), mode).expect("mode");
    }
    let bin = bed.path("../bin").canonicalize().expect("bin");
    let path = std::env::var("PATH").expect("PATH");
    (bed, format!("{}:{path}", bin.display()))
}

fn grade(bed: &TestBed, path: &str, more: &[&str]) -> CommandResult {
    let args = ["course", "grade", "in", LAB, "--slurm", "3"];
    let mut command = bed.command(&[&args, more].concat());
    command.env("PATH", path);
    command.output().expect("the binary runs").into()
}

/// A file of the stand-ins; empty where it is not there.
fn text(bed: &TestBed, name: &str) -> String {
    std::fs::read_to_string(bed.path("..").join(name)).unwrap_or_default()
}

/// Standings and records of the class graded by one process.
fn expected() -> (Vec<Stands>, Vec<(String, Vec<u8>)>) {
    let one = class();
    one.run(&["course", "grade", "in", LAB, "--no-reports"]);
    (standings(&one), records(&one))
}

#[test]
fn a_class_on_a_cluster_has_the_grades_of_one_machine() {
    let (bed, path) = cluster();
    let ran = grade(
        &bed,
        &path,
        &[
            "--no-reports",
            "--sbatch=--partition=short",
            "--sbatch",
            "--time=30",
        ],
    );
    assert_eq!(ran.code, Some(1), "{ran:?}");
    assert!(
        ran.stdout
            .contains("6 to grade: job 11 (3 of 3 parts), then job 12 joins them"),
        "{ran:?}"
    );
    assert!(
        ran.stdout.contains("6 graded, 1 missing, 1 needs you"),
        "{ran:?}"
    );
    assert_eq!((standings(&bed), records(&bed)), expected());
    let args = text(&bed, "sbatch.args");
    let (array, join) = args.split_once('\n').expect("two jobs");
    assert!(
        array.contains("--partition=short --time=30") && array.contains("--array=1,2,3"),
        "{array}"
    );
    assert!(
        join.contains("--partition=short --time=30") && join.contains("--dependency=afterany:11"),
        "{join}"
    );
    // nothing is left to do: no job
    let ran = grade(&bed, &path, &["--json"]);
    assert_eq!(ran.code, Some(1), "{ran:?}");
    assert!(ran.stdout.contains("\"standings\": ["), "{ran:?}");
    assert_eq!(text(&bed, "sbatch.args").lines().count(), 2);
}

#[test]
fn a_part_that_died_is_named_and_submitted_again_alone() {
    let (bed, path) = cluster();
    bed.write("../lost", "2\njoin\n");
    let ran = grade(&bed, &path, &["--no-reports"]);
    assert_eq!(ran.code, Some(4), "{ran:?}");
    assert!(
        ran.stderr
            .contains("part 2/3 ended as OUT_OF_MEMORY and left"),
        "{ran:?}"
    );
    assert!(ran.stderr.contains("part-2.log"), "{ran:?}");
    assert!(ran.stdout.contains("not graded yet"), "{ran:?}");
    bed.write("../lost", "");
    let ran = grade(&bed, &path, &["--no-reports"]);
    assert_eq!(ran.code, Some(1), "{ran:?}");
    let args = text(&bed, "sbatch.args");
    assert!(
        args.lines()
            .nth(2)
            .is_some_and(|third| third.contains("--array=2 ")),
        "{args}"
    );
    assert_eq!((standings(&bed), records(&bed)), expected());
}

#[test]
fn what_a_dead_part_left_is_graded_by_the_join_and_said() {
    let (bed, path) = cluster();
    bed.write("../lost", "1\n");
    let ran = grade(&bed, &path, &["--no-reports"]);
    assert_eq!(ran.code, Some(1), "{ran:?}");
    assert!(
        ran.stderr.contains(
            "part 1/3 ended as OUT_OF_MEMORY; what it left open was graded by the job that joins"
        ),
        "{ran:?}"
    );
    assert_eq!((standings(&bed), records(&bed)), expected());
}

/// Submitted and left alone, found again by the same command, which submits nothing while jobs are in the queue.
#[test]
fn jobs_in_the_queue_are_found_again() {
    let (bed, path) = cluster();
    bed.write("../lost", "1\n2\n3\njoin\n");
    let ran = grade(&bed, &path, &["--detach"]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    assert!(
        ran.stdout.contains("next: the same command again waits"),
        "{ran:?}"
    );
    bed.write("../looks", "2");
    let ran = grade(&bed, &path, &["--detach"]);
    assert!(
        ran.code == Some(0) && ran.stdout.contains("in the queue already"),
        "{ran:?}"
    );
    bed.write("../looks", "2");
    let ran = grade(&bed, &path, &[]);
    assert_eq!(ran.code, Some(4), "{ran:?}");
    assert_eq!(text(&bed, "looks"), "0\n", "it did not wait");
    assert_eq!(text(&bed, "sbatch.args").lines().count(), 2);
}

/// Ctrl-C ends the waiting, and says what ends the jobs; what is handed in meanwhile is not forgotten.
#[test]
fn the_jobs_go_on_when_nobody_waits() {
    let (bed, path) = cluster();
    bed.write("../lost", "1\n2\n3\njoin\n");
    grade(&bed, &path, &["--detach"]);
    bed.write("../looks", "100000");
    let mut waiting = bed.command(&["course", "grade", LAB, "--slurm", "3"]);
    waiting.env("PATH", &path).stderr(Stdio::piped());
    let mut waiting = waiting
        .stdout(Stdio::null())
        .spawn()
        .expect("the binary runs");
    // the second look is the first after it has found the run
    let looks = || text(&bed, "looks").trim().parse().unwrap_or(100_000);
    until(|| looks() <= 99_998);
    let id = waiting.id().to_string();
    let sent = Command::new("kill").args(["-INT", &id]).status();
    assert!(sent.expect("kill runs").success());
    waiting.wait().expect("it ends");
    let ran: CommandResult = waiting.wait_with_output().expect("its output").into();
    assert_eq!(ran.code, Some(130), "{ran:?}");
    assert!(
        ran.stderr.contains("the jobs go on")
            && ran
                .stderr
                .contains("scancel --name=kinemark-01-kinematics-"),
        "{ran:?}"
    );
}

/// Jobs are in the queue for part of a class, and the rest is handed in.
#[test]
fn what_is_handed_in_while_jobs_run_is_not_forgotten() {
    let (bed, path) = cluster();
    let later = [100, 101, 102, 103, 104].map(|id| format!("in/s{id}.rhai"));
    let texts = later
        .each_ref()
        .map(|name| std::fs::read(bed.path(name)).expect("a file"));
    for name in &later {
        std::fs::remove_file(bed.path(name)).expect("removed");
    }
    let ran = grade(&bed, &path, &["--detach", "--no-reports"]);
    assert!(ran.stdout.contains("(1 of 3 parts)"), "{ran:?}");
    for (name, text) in later.iter().zip(texts) {
        bed.write(name, text);
    }
    bed.write("../looks", "1");
    let ran = grade(&bed, &path, &["--no-reports"]);
    assert_eq!(ran.code, Some(4), "{ran:?}");
    assert!(
        ran.stderr
            .contains("handed in after the jobs were submitted"),
        "{ran:?}"
    );
    let ran = grade(&bed, &path, &["--no-reports"]);
    assert_eq!(ran.code, Some(1), "{ran:?}");
    assert_eq!((standings(&bed), records(&bed)), expected());
}

/// What a job script is and where its log goes can be read in the book, by its owner alone.
#[test]
fn scripts_and_logs_are_in_the_book() {
    let (bed, path) = cluster();
    grade(&bed, &path, &["--no-reports", "--jobs", "2"]);
    let runs = bed.path("book/slurm");
    let mut found: Vec<String> = files_below(&runs)
        .into_iter()
        .map(|(name, _)| name)
        .collect();
    found
        .iter_mut()
        .for_each(|name| *name = name.split_once('/').expect("a run").1.to_owned());
    assert_eq!(
        found,
        [
            "join.log",
            "join.sh",
            "part-1.log",
            "part-2.log",
            "part-3.log",
            "part.sh",
            "run.json"
        ]
    );
    let mode = runs.metadata().expect("runs").permissions().mode();
    assert_eq!(mode & 0o777, 0o700);
    assert!(text(&bed, "sbatch.args").contains("--cpus-per-task=2"));
}

#[test]
fn what_stands_in_the_way_of_a_cluster_is_said() {
    let (bed, path) = cluster();
    let ran = grade(&bed, "/nowhere", &[]);
    assert_eq!(ran.code, Some(2), "{ran:?}");
    assert!(
        ran.stderr
            .contains("there is no `sbatch` on this machine's PATH"),
        "{ran:?}"
    );
    assert!(!bed.path("book/journal").exists(), "something was done");
    let ran = grade(&bed, &path, &["--sbatch=--partition=no"]);
    assert_eq!(ran.code, Some(4), "{ran:?}");
    assert!(
        ran.stderr.contains("invalid partition specified: no"),
        "{ran:?}"
    );
    let ran = grade(&bed, &path, &["--sbatch=--array=7"]);
    assert_eq!(ran.code, Some(2), "{ran:?}");
    bed.write("../silent", "");
    grade(&bed, &path, &["--detach"]);
    let ran = grade(&bed, &path, &["--detach"]);
    assert_eq!(ran.code, Some(4), "{ran:?}");
    assert!(ran.stderr.contains("squeue does not answer"), "{ran:?}");
    for more in [&["--shard", "1/2"][..], &["--detach"]] {
        let args = [&["course", "grade", "in", LAB], more].concat();
        let slurm: &[&str] = if more.len() == 2 {
            &["--slurm", "2"]
        } else {
            &[]
        };
        let ran = bed.run(&[&args, slurm].concat());
        assert_eq!(ran.code, Some(2), "{ran:?}");
    }
}

/// Runs one of Slurm's commands.
fn slurm(program: &str, args: &[&str]) -> String {
    let ran = Command::new(program).args(args).output().expect("Slurm");
    assert!(ran.status.success(), "{program} {args:?}: {ran:?}");
    String::from_utf8_lossy(&ran.stdout).into_owned()
}

/// The same grades as on one machine, a part that is killed while it grades, and what the same command makes of it.
#[test]
fn a_real_slurm_grades_and_a_killed_part_goes_on() {
    if std::env::var_os("KINEMARK_SLURM").is_none() {
        println!("NOT RUN: KINEMARK_SLURM is not set (.ci/full slurm)");
        return;
    }
    let path = std::env::var("PATH").expect("PATH");
    let one = large_class_in(TestBed::new(), 90);
    let ran = one.run(&["course", "grade", "in", LAB, "--no-reports"]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    let expected = (standings(&one), records(&one));

    let bed = large_class_in(TestBed::named(ODD), 90);
    let ran = grade(
        &bed,
        &path,
        &["--no-reports", "--detach", "--sbatch=--time=30"],
    );
    assert_eq!(ran.code, Some(0), "{ran:?}");
    let number = |after: &str| {
        let rest = ran.stdout.split_once(after).expect("a job").1;
        rest.split(' ').next().expect("a number").to_owned()
    };
    let (array, join) = (number(": job "), number("then job "));
    slurm("scancel", &[&join]);
    // as soon as it has graded somebody
    until(|| has_graded(&bed));
    slurm(
        "scancel",
        &["--signal=KILL", "--full", &format!("{array}_2")],
    );
    let ran = grade(&bed, &path, &["--no-reports"]);
    assert_eq!(ran.code, Some(4), "{ran:?}");
    assert!(ran.stdout.contains("in the queue already"), "{ran:?}");
    assert!(
        ran.stderr.contains("part 2/3 ended as CANCELLED and left"),
        "{ran:?}"
    );
    assert!(!ran.stderr.contains("part 1/3"), "{ran:?}");

    let ran = grade(&bed, &path, &["--no-reports"]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    assert!(ran.stdout.contains("(1 of 3 parts)"), "{ran:?}");
    assert_eq!((standings(&bed), records(&bed)), expected);
    let ran = grade(&bed, &path, &["--sbatch=--partition=no-such"]);
    assert_eq!(ran.code, Some(0), "nothing to do: {ran:?}");
    std::fs::remove_dir_all(bed.path("book")).expect("removed");
    let ran = grade(&bed, &path, &["--sbatch=--partition=no-such"]);
    assert_eq!(ran.code, Some(4), "{ran:?}");
    assert!(ran.stderr.contains("nvalid partition"), "{ran:?}");
}
