//! Runs in which the submission fails: they go on with the last command, every check judges the whole run, and a share is kept.

use kinemark_grader::lab::{Lab, TaskWork};
use kinemark_grader::record::grade::{Outcome, TaskGrade};
use kinemark_grader::record::verdict::Verdict;
use kinemark_grader::task::files::Files as _;
use proptest::prelude::*;

use crate::testbed::{Folder, TestBed, grade, lab, root, staff};

/// `source` with a control function that does `otherwise` from a tick on, and keeps its commands in `this.last`.
fn from_tick(source: &str, tick: u64, otherwise: &str) -> String {
    let own = source.replacen("fn control(", "fn control_before(", 1);
    assert_ne!(own, source, "a control function");
    format!(
        "{own}\nfn control(observation) {{\n    if observation.tick >= {tick} {{ {otherwise} }}\n    \
         this.last = this.control_before(observation);\n    this.last\n}}\n"
    )
}

const CRASH: &str = "let none = []; return none[3];";
const ENDLESS: &str = "loop { }";
const INVALID: &str = "return [0.0 / 0.0, 1.0];";
const HOLD: &str = "return this.last;";

/// The grade of a motion task in practice.
fn practised(lab: &Lab, task: &str, source: &str) -> TaskGrade {
    let mut own = lab.clone();
    own.tasks.retain(|known| known.name == task);
    let graded = grade(&own, None, "mine.rhai", source).grade;
    graded.tasks.into_iter().next().expect("the task")
}

fn solution(lab: &Lab) -> String {
    staff(lab, None).solution.text().to_owned()
}

#[test]
fn a_crash_after_the_work_keeps_its_share() {
    let lab = lab("04-knock-with-velocity");
    let solution = solution(&lab);
    // the reference is at the end of its lines after 7.3 s
    for (otherwise, verdict, words) in [
        (CRASH, Verdict::Crashed, "past the end"),
        (ENDLESS, Verdict::OverBudget, "operations"),
        (INVALID, Verdict::InvalidOutput, "NaN"),
    ] {
        let submission = from_tick(&solution, 8200, otherwise);
        let task = practised(&lab, "knock", &submission);
        assert_eq!(task.verdict, verdict);
        let stopped = task.stopped.as_ref().expect("a stop");
        assert_eq!((stopped.tick, stopped.kept), (Some(8200), Some(0.8)));
        assert!(stopped.message.contains(words), "{}", stopped.message);
        assert_eq!(task.points, 0.8 * task.max_points, "{task:#?}");
        assert!(
            task.checks
                .iter()
                .all(|check| check.outcome == Outcome::Partial)
        );
        // hidden runs alike
        let graded = grade(&lab, Some(&staff(&lab, None)), "mine.rhai", &submission).grade;
        let task = graded.tasks.iter().find(|task| task.name == "knock");
        let task = task.expect("the task");
        assert_eq!(task.points, 0.8 * task.max_points, "{otherwise}");
        assert_eq!(task.verdict, verdict);
    }
}

#[test]
fn a_failure_in_the_first_call_leaves_an_arm_at_rest() {
    for name in [
        "00-step-response",
        "01-kinematics",
        "02-jacobian-velocity",
        "03-knock-with-position",
        "04-knock-with-velocity",
        "06-typed-robots",
    ] {
        let lab = lab(name);
        for task in &lab.tasks {
            let TaskWork::Motion(work, _) = &task.work else {
                continue;
            };
            let graded = practised(&lab, &task.name, "fn control(o) { let a = []; a[1] }");
            assert_eq!(graded.points, 0.0, "{name}, {}", task.name);
            assert_eq!(graded.verdict, Verdict::Crashed);
            assert!(
                graded
                    .stopped
                    .is_some_and(|stopped| stopped.kept == Some(0.8))
            );
            assert_eq!(
                graded.digests.seconds.len() as u64,
                (work.ticks + 1).div_ceil(1000)
            );
        }
    }
}

#[test]
fn the_share_is_the_labs() {
    let bed = TestBed::new();
    bed.copy_labs();
    let path = "labs/04-knock-with-velocity/lab.toml";
    bed.edit(
        path,
        "frame = \"lab\"",
        "kept_after_stop = 0.25\nframe = \"lab\"",
    );
    let own = Lab::load(&Folder(bed.path("labs")), "04-knock-with-velocity").expect("the lab");
    let submission = from_tick(&solution(&own), 8200, CRASH);
    let task = practised(&own, "knock", &submission);
    assert_eq!(task.points, 0.25 * task.max_points);
    bed.edit(path, "kept_after_stop = 0.25", "kept_after_stop = 1.25");
    let files = Folder(bed.path("labs"));
    assert!(files.bytes(path).is_ok());
    let error = Lab::load(&files, "04-knock-with-velocity").expect_err("refused");
    assert!(
        error.to_string().contains("a share is 0 to 1, got 1.25"),
        "{error}"
    );
}

/// Submissions of motion tasks: every reference solution, and mutants that lose points in different ways.
fn submissions() -> Vec<(Lab, String, String)> {
    let mut all = Vec::new();
    for (name, task, mutants) in [
        ("00-step-response", "pid", &["derivative-sign"][..]),
        ("01-kinematics", "move", &["absolute-elbow"]),
        (
            "03-knock-with-position",
            "knock",
            &["no-compensation", "one-leap"],
        ),
        ("04-knock-with-velocity", "knock", &[]),
    ] {
        let lab = lab(name);
        let folder = root().join("reference").join(name).join("mutants");
        let mut sources = vec![solution(&lab)];
        for mutant in mutants {
            let path = folder.join(format!("{mutant}.rhai"));
            sources.extend(std::fs::read_to_string(path).ok());
        }
        all.extend(
            sources
                .into_iter()
                .filter(|source| source.contains("fn control("))
                .map(|source| (lab.clone(), task.to_owned(), source)),
        );
    }
    assert!(all.len() >= 6, "{}", all.len());
    all
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    /// Failing at a tick never earns more than holding the last command from there on, nor more than a run without a fault that has
    /// full marks.
    #[test]
    fn cutting_a_submission_never_raises_its_points(which in 0..6_usize, share in 0.0..1.0_f64) {
        let all = submissions();
        let (lab, task, source) = &all[which];
        let TaskWork::Motion(work, _) = &lab.tasks.iter().find(|known| known.name == *task).expect("the task").work else {
            panic!("a motion task");
        };
        // a failure after the last call is none
        let every = u64::from(work.periods.ticks_per_control.get());
        let last_call = (work.ticks - 1) / every * every;
        let tick = ((work.ticks as f64 * share) as u64).clamp(1, last_call);
        let [cut, held, whole] = [
            from_tick(source, tick, CRASH),
            from_tick(source, tick, HOLD),
            source.clone(),
        ].map(|source| practised(lab, task, &source));
        prop_assert!(cut.points <= held.points);
        // to hundredths, check by check
        for (cut, held) in cut.checks.iter().zip(&held.checks) {
            prop_assert!(cut.points <= 0.8 * held.points + 0.006, "{cut:?} {held:?}");
        }
        if whole.points >= whole.max_points {
            prop_assert!(cut.points < whole.points);
        }
    }
}
