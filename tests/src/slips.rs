//! Slips as classes hand them in: `tests/slips/LAB/NAME.rhai`. The head of each file has, a line each, the `task` that loses points, what
//! is said of it (`says`), what the student is asked (`asks`), the check to look at `first`, and advice that would mislead (`never`); without `check` the first check
//! that lost points counts. A file with `verdict: passed` is right, and nothing is said of it. What `stopped`
//! the task, what `helps` and at which `line` are of a submission that fails.

use std::path::Path;

use kinemark_grader::lab::Lab;
use kinemark_grader::record::grade::{Outcome, TaskGrade};

use crate::every_case::every_case;
use crate::testbed::{grade, lab, root};

/// A file of a lab.
type Slip<'l> = (&'l Lab, String);

#[test]
fn every_slip_is_named_by_its_cause() {
    let folder = root().join("tests/slips");
    let labs: Vec<Lab> = names(&folder).iter().map(|name| lab(name)).collect();
    let mut cases: Vec<(String, Slip<'_>)> = Vec::new();
    for lab in &labs {
        for file in names(&folder.join(&lab.name)) {
            let path = folder.join(&lab.name).join(&file);
            let text = std::fs::read_to_string(path).expect("a slip");
            cases.push((format!("{}/{file}", lab.name), (lab, text)));
        }
    }
    assert!(cases.len() >= 50, "{} slips", cases.len());
    every_case(&cases, |(lab, text)| is_named(lab, text));
}

fn names(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).expect("a folder");
    let name = |entry: std::io::Result<std::fs::DirEntry>| entry.expect("entry").file_name();
    let mut names: Vec<String> = entries
        .map(|entry| name(entry).into_string().expect("UTF-8"))
        .collect();
    names.sort();
    names
}

/// What the head of a file says under `key`.
fn heads<'t>(text: &'t str, key: &str) -> Vec<&'t str> {
    let lines = text.lines().take_while(|line| line.starts_with("// "));
    let values = lines.filter_map(|line| line.strip_prefix("// ")?.split_once(": "));
    let of_key = values.filter(|(known, _)| *known == key);
    of_key.map(|(_, value)| value).collect()
}

fn is_named(lab: &Lab, text: &str) {
    let graded = grade(lab, None, "submission.rhai", text).grade;
    let [name] = heads(text, "task")[..] else {
        panic!("one task");
    };
    let mut tasks = graded.tasks.iter();
    let task = tasks.find(|task| task.name == name).expect("the task");
    if heads(text, "verdict") == ["passed"] {
        assert_eq!(task.verdict.name(), "passed", "{}", all_said(task));
        return;
    }
    if is_stopped_as_said(task, text) {
        return;
    }
    let lost = |outcome: Outcome| matches!(outcome, Outcome::None | Outcome::Partial);
    let mut checks = task.checks.iter();
    let check = match heads(text, "check")[..] {
        [named] => checks.find(|check| check.name == named),
        _ => checks.find(|check| lost(check.outcome)),
    };
    let check = check.unwrap_or_else(|| panic!("nothing is lost: {}", all_said(task)));
    assert!(lost(check.outcome), "{name}: {:?}", check.outcome);
    let messages: Vec<&str> = check
        .evidence
        .iter()
        .map(|fact| fact.message.as_str())
        .collect();
    let said = messages.join(" | ");
    for first in heads(text, "first") {
        assert_eq!(check.look_first_at.as_deref(), Some(first), "{said}");
    }
    let asked = check.next_step.as_deref().unwrap_or_default();
    for says in heads(text, "says") {
        assert!(said.contains(says), "says: {said}\nasks: {asked}");
    }
    for asks in heads(text, "asks") {
        assert!(asked.contains(asks), "says: {said}\nasks: {asked}");
    }
    let everything = all_said(task);
    for never in heads(text, "never") {
        assert!(!everything.contains(never), "{never}: {everything}");
    }
}

/// Whether the head says what stopped the task; then it is checked.
fn is_stopped_as_said(task: &TaskGrade, text: &str) -> bool {
    let [said] = heads(text, "stopped")[..] else {
        return false;
    };
    let stopped = task.stopped.as_ref().expect("a stop");
    assert!(stopped.message.contains(said), "{}", stopped.message);
    for helps in heads(text, "helps") {
        let help = stopped.help.as_deref().unwrap_or_default();
        assert!(help.contains(helps), "{help}");
    }
    for line in heads(text, "line") {
        let found = stopped.line.map(|line| line.to_string());
        assert_eq!(found.as_deref(), Some(line));
    }
    true
}

/// Everything that the checks of a task say and ask.
fn all_said(task: &TaskGrade) -> String {
    let lines = task.checks.iter().map(|check| {
        let messages = check.evidence.iter().map(|fact| fact.message.as_str());
        let messages: Vec<&str> = messages.collect();
        let asked = check.next_step.as_deref().unwrap_or_default();
        format!("{}: {} -> {asked}", check.name, messages.join(" | "))
    });
    lines.collect::<Vec<_>>().join("\n")
}
