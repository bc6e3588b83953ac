//! Graded submissions get the verdicts they must get: `tests/submissions/LAB/CASE/{submission.rhai or submission.py, expect.toml}`.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use kinemark_grader::audit::Form;
use kinemark_grader::lab::{Lab, Staff};
use kinemark_grader::record::grade::{Grade, Outcome, TaskGrade};
use kinemark_grader::record::quantity::points;
use kinemark_grader::record::sums::contradictions;
use kinemark_grader::record::visible_part;
use kinemark_report::text::text as shown;
use kinemark_sim::text::Source;
use toml::{Table, Value};

use crate::every_case::every_case;
use crate::testbed::{grade, lab, root, staff};

/// Names of what is in a folder, sorted.
fn names(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).expect("a folder");
    let name = |entry: std::io::Result<std::fs::DirEntry>| {
        entry
            .expect("entry")
            .file_name()
            .into_string()
            .expect("UTF-8")
    };
    let mut names: Vec<String> = entries.map(name).collect();
    names.sort();
    names
}

#[test]
fn every_submission_gets_the_verdict_it_must_get() {
    let labs = labs_with_staff();
    let cases = all_submissions(&labs);
    assert!(cases.len() >= 98, "{} submissions", cases.len());
    let forms = forms(&labs);
    every_case(&cases, |(lab, _, path)| {
        gets_its_verdict(&forms[lab.name.as_str()], lab, path)
    });
}

/// Every lab in its own form, by name: what the course staff's submissions do there is tried once for all that are graded.
pub(crate) fn forms(labs: &[(Lab, Staff)]) -> BTreeMap<&str, Form<'_>> {
    let forms = labs.iter();
    let forms = forms.map(|(lab, staff)| (lab.name.as_str(), Form::new(lab, staff)));
    forms.collect()
}

/// The labs that have submissions, with the course staff's part of each.
pub(crate) fn labs_with_staff() -> Vec<(Lab, Staff)> {
    let both = |name: &String| {
        let lab = lab(name);
        let staff = staff(&lab, None);
        (lab, staff)
    };
    let folder = root().join("tests/submissions");
    names(&folder).iter().map(both).collect()
}

/// Every submission: its name, its lab with the course staff's part, and its folder.
pub(crate) fn all_submissions(labs: &[(Lab, Staff)]) -> Vec<(String, Submission<'_>)> {
    let mut cases = Vec::new();
    for (lab, staff) in labs {
        let folder = root().join("tests/submissions").join(&lab.name);
        for case in names(&folder) {
            let path = folder.join(&case);
            cases.push((format!("{}/{case}", lab.name), (lab, staff, path)));
        }
    }
    cases
}

/// A lab, the course staff's part of it, and the folder of a submission.
pub(crate) type Submission<'l> = (&'l Lab, &'l Staff, PathBuf);

/// The file of a submission, by its name and its text.
pub(crate) fn submission_in(folder: &Path) -> (&'static str, String) {
    let mut names = ["submission.py", "submission.rhai"].into_iter();
    let file = names.find(|name| folder.join(name).is_file());
    let file = file.unwrap_or_else(|| panic!("no submission in {}", folder.display()));
    let text = std::fs::read_to_string(folder.join(file)).expect("text");
    (file, text)
}

fn gets_its_verdict(form: &Form<'_>, lab: &Lab, folder: &Path) {
    let read = |file: &str| {
        let path = folder.join(file);
        std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
    };
    let expect: Table = read("expect.toml").parse().expect("expect.toml");
    knows(&expect, &["verdict", "tasks"]);
    let (file, submission) = submission_in(folder);
    let graded = form.graded(&Source::new(file, submission.as_str()).into());
    let graded = graded.expect("not interrupted");
    assert_eq!(contradictions(&graded), [], "{}", shown(&graded));
    // what `kinemark verify` compares without the course staff's part
    let practice = grade(lab, None, file, &submission).grade;
    assert_eq!(contradictions(&practice), [], "{}", shown(&practice));
    let hidden = visible_part::contradictions(&graded, &practice);
    assert_eq!(hidden, [], "{}", shown(&graded));
    assert_eq!(
        Some(graded.verdict.name()),
        word(&expect, "verdict"),
        "{}",
        shown(&graded)
    );
    let tasks = expect
        .get("tasks")
        .and_then(Value::as_table)
        .expect("tasks");
    for (name, wanted) in tasks {
        let task = graded.tasks.iter().find(|task| task.name == *name);
        let wanted = wanted.as_table().expect("a task");
        task_is_as_wanted(&graded, task.expect("the task"), wanted);
    }
}

fn task_is_as_wanted(graded: &Grade, task: &TaskGrade, wanted: &Table) {
    knows(
        wanted,
        &["verdict", "points", "diagnosis", "says", "line", "lost"],
    );
    let place = format!("{}: {}", task.name, shown(graded));
    if let Some(verdict) = word(wanted, "verdict") {
        assert_eq!(task.verdict.name(), verdict, "{place}");
    }
    if let Some(wanted) = word(wanted, "points") {
        let earned = format!("{}/{}", points(task.points), points(task.max_points));
        assert_eq!(earned, wanted, "{place}");
    }
    let named: Vec<&str> = task.diagnoses.iter().map(|d| d.mistake.as_str()).collect();
    assert_eq!(named, Vec::from_iter(word(wanted, "diagnosis")), "{place}");
    if let Some(says) = word(wanted, "says") {
        assert!(format!("{task:?}").contains(says), "no {says:?} in {place}");
    }
    if let Some(line) = wanted.get("line") {
        let at = task.stopped.as_ref().and_then(|stopped| stopped.line);
        assert_eq!(at.map(|line| line as i64), line.as_integer(), "{place}");
    }
    if let Some(lost) = wanted.get("lost") {
        let checks = task.checks.iter();
        let found = checks.filter(|check| check.outcome != Outcome::Full);
        let found: Vec<Value> = found.map(|check| check.name.as_str().into()).collect();
        assert_eq!(Some(&found), lost.as_array(), "{place}");
    }
}

fn word<'t>(table: &'t Table, key: &str) -> Option<&'t str> {
    table.get(key).map(|value| value.as_str().expect("a text"))
}

fn knows(table: &Table, keys: &[&str]) {
    let unknown = table.keys().find(|key| !keys.contains(&key.as_str()));
    assert_eq!(unknown, None, "no such key");
}
