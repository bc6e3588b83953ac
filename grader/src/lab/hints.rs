//! What a grade knows of a lab's hints: the questions. The steps behind them stay in the lab.

use std::ops::Range;

use kinemark_sim::text::Source;

use super::file::LabTable;
use super::model::Lab;
use crate::record::hints::{CheckHints, Hints};

impl Lab {
    /// The hints of its checks.
    pub fn hints(&self) -> Hints {
        let checks = self.tasks.iter().flat_map(|task| {
            let checks = task.checks().into_iter();
            let checks = checks.filter(|check| !check.hints.is_empty());
            checks.map(|check| CheckHints {
                task: task.name.clone(),
                check: check.name.clone(),
                title: check.title.clone(),
                hints: check.hints.clone(),
            })
        });
        checks.collect()
    }
}

/// The text of a lab file with the question of each check alone: what a grade follows from, and what a report holds. It is a lab file
/// too, and its own text with questions alone is itself.
pub(super) fn with_questions_alone(source: &Source, lab: &LabTable) -> String {
    let checks = lab.tasks.iter().flat_map(|task| &task.checks);
    let steps = checks.filter_map(|check| check.get_ref().steps_behind_question());
    let mut steps: Vec<Range<usize>> = steps.collect();
    steps.sort_by_key(|range| range.start);
    let mut text = String::new();
    let mut from = 0;
    for range in steps {
        text += &source.text()[from..range.start];
        from = range.end;
    }
    text + &source.text()[from..]
}

#[cfg(test)]
mod tests {
    use crate::judge::parts;
    use crate::lab::Lab;
    use crate::lab::copies::Copies;
    use crate::task::problem::LoadError;
    use kinemark_sim::text::Source;

    const ROBOT: &str = r#"
format = 1
name = "r"
links = [{ name = "a" }, { name = "b", shapes = [{ box = { size_m = [1.0, 1.0, 1.0] } }], inertia = { mass_kg = 1.0 } }]
joints = [{ name = "j", type = "revolute", parent = "a", child = "b", axis = [0.0, 0.0, 1.0] }]
"#;
    const LAB: &str = r#"
format = 1
name = "x"
title = "X"
robot = "r"
[[tasks]]
name = "t"
title = "T"
function = { call = "forward_kinematics", cases = [{ name = "c", q_rad = [1.0] }] }
[[tasks.checks]]
name = "c"
title = "C"
points = 1.0
HINTS
fk-error = { full_m = 0.1, zero_m = 0.2 }
[[tasks.checks]]
name = "d"
title = "D"
points = 1.0
hints = ["And this?"]
fk-error = { full_m = 0.1, zero_m = 0.2 }
"#;

    fn load(hints: &str) -> Result<Lab, LoadError> {
        let text = LAB.replace("HINTS", hints);
        let files = Copies::from_texts([("x/lab.toml", &*text), ("robots/r.toml", ROBOT)]);
        Lab::load(&files, "x")
    }

    #[test]
    fn a_grade_follows_from_the_questions_alone() {
        let digest = |lab: &Lab| {
            parts(lab, None, &Source::new("s.rhai", "").into())
                .lab
                .digest
        };
        let short = load("hints = [\"Why?\"]").unwrap();
        assert_eq!(short.graded_text, short.source.text());
        for hints in [
            "hints = [\"Why?\", \"So.\", \"Do this.\"]",
            "hints = [\"Why?\" # a comment\n    , 'So ]',\n]",
        ] {
            let lab = load(hints).unwrap();
            assert_eq!(lab.graded_text, short.graded_text);
            assert_eq!(digest(&lab), digest(&short));
            let copies = lab.graded_copies();
            let copied = Lab::load(&copies, "x").unwrap();
            assert_eq!(copied.graded_text, lab.graded_text);
            // what a course hands out and keeps has all of them
            let whole = Lab::load(&lab.copies(), "x").unwrap();
            assert_eq!(whole.hints(), lab.hints());
            assert!(lab.hints().of("t", "c").len() > 1);
        }
        let other = load("hints = [\"When?\"]").unwrap();
        assert_ne!(digest(&other), digest(&short));
    }

    #[test]
    fn hints_begin_with_a_question_and_are_few() {
        for (hints, message) in [
            ("hints = []", "check `c` must have 1 to 6 hints, got 0"),
            (
                "hints = [\"Why?\", \"1\", \"2\", \"3\", \"4\", \"5\", \"6\"]",
                "check `c` must have 1 to 6 hints, got 7",
            ),
            ("hints = [\"Why?\", \" \"]", "hint 2 of check `c` is empty"),
            (
                "hints = [\"Do this.\", \"Why?\"]",
                "the first hint of check `c` must end with `?`",
            ),
            (
                "hints = \"Why?\"",
                "`\"Why?\"` is a string, expected a list",
            ),
            ("hint = \"Do this.\"", "`hint` is now `hints`, a list"),
            ("hint = [\"Why?\"]", "`hint` is now `hints`, a list"),
            ("hins = [\"Why?\"]", "unknown key `hins`"),
        ] {
            let error = load(hints).unwrap_err();
            assert_eq!(error.to_string(), message, "{hints}");
            let LoadError::Lab(error) = error else {
                panic!("{hints}: no place");
            };
            let place = format!("{error:?}");
            assert!(place.contains("lab.toml"), "{hints}: {place}");
        }
    }
}
