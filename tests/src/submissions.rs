//! Graded submissions with the verdicts they must get: `tests/submissions/LAB/CASE/{submission.rhai, expect.toml}`.

use std::collections::BTreeMap;

use kinemark_grader::record::grade::Outcome;
use kinemark_grader::record::quantity::points;
use kinemark_report::text::text as shown;
use toml::Table;

use crate::testbed::{grade, lab, root, staff};

fn text<'t>(table: &'t Table, key: &str) -> Option<&'t str> {
    table.get(key).map(|value| value.as_str().expect("a text"))
}

#[test]
fn every_submission_gets_the_verdict_it_must_get() {
    let folder = root().join("tests/submissions");
    let mut seen = 0;
    for lab_folder in std::fs::read_dir(&folder).expect("submissions") {
        let lab_folder = lab_folder.expect("entry").path();
        let lab = lab(&lab_folder.file_name().expect("name").to_string_lossy());
        let staff = staff(&lab, None);
        let mut cases: BTreeMap<String, _> = BTreeMap::new();
        for case in std::fs::read_dir(&lab_folder).expect("cases") {
            let path = case.expect("entry").path();
            cases.insert(
                path.file_name()
                    .expect("name")
                    .to_string_lossy()
                    .into_owned(),
                path,
            );
        }
        for (name, path) in cases {
            let read = |file: &str| {
                let path = path.join(file);
                std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
            };
            let expect: Table = read("expect.toml").parse().expect("expect.toml");
            let graded = grade(
                &lab,
                Some(&staff),
                "submission.rhai",
                &read("submission.rhai"),
            )
            .grade;
            assert_eq!(
                Some(graded.verdict.name()),
                text(&expect, "verdict"),
                "{name}: {}",
                shown(&graded)
            );
            let known = ["verdict", "tasks"];
            assert!(
                expect.keys().all(|key| known.contains(&key.as_str())),
                "{name}"
            );
            let tasks = expect
                .get("tasks")
                .and_then(|tasks| tasks.as_table())
                .expect("tasks");
            for (task_name, wanted) in tasks {
                let wanted = wanted.as_table().expect("a task");
                let task = graded
                    .tasks
                    .iter()
                    .find(|task| task.name == *task_name)
                    .expect("task");
                let place = format!("{name}/{task_name}: {}", shown(&graded));
                for key in wanted.keys() {
                    let known = ["verdict", "points", "diagnosis", "says", "line", "lost"];
                    assert!(known.contains(&key.as_str()), "{name}: unknown key {key}");
                }
                if let Some(verdict) = text(wanted, "verdict") {
                    assert_eq!(task.verdict.name(), verdict, "{place}");
                }
                if let Some(wanted) = text(wanted, "points") {
                    let earned = format!("{}/{}", points(task.points), points(task.max_points));
                    assert_eq!(earned, wanted, "{place}");
                }
                let told: Vec<&str> = task.diagnoses.iter().map(|d| d.mistake.as_str()).collect();
                assert_eq!(told, Vec::from_iter(text(wanted, "diagnosis")), "{place}");
                if let Some(says) = text(wanted, "says") {
                    assert!(format!("{task:?}").contains(says), "{place}");
                }
                if let Some(line) = wanted.get("line") {
                    let at = task.stopped.as_ref().and_then(|stopped| stopped.line);
                    assert_eq!(at.map(|line| line as i64), line.as_integer(), "{place}");
                }
                if let Some(lost) = wanted.get("lost") {
                    let lost: Vec<&str> = lost
                        .as_array()
                        .expect("lost")
                        .iter()
                        .map(|c| c.as_str().expect("check"))
                        .collect();
                    let found: Vec<&str> = task
                        .checks
                        .iter()
                        .filter(|check| check.outcome != Outcome::Full)
                        .map(|check| check.name.as_str())
                        .collect();
                    assert_eq!(found, lost, "{place}");
                }
            }
            seen += 1;
        }
    }
    assert!(seen >= 10, "{seen} submissions");
}
