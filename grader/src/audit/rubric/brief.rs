//! What is graded and the brief does not mention: functions to write, what a task lends, what it gives, sensors.

use super::{Doubt, Rubric};
use crate::lab::TaskWork;
use crate::task::value::Value;

/// Names that students need and cannot read anywhere.
pub(super) fn rule(rubric: &Rubric<'_>, doubts: &mut Vec<Doubt>) {
    let Some(brief) = rubric.brief else {
        return;
    };
    let mut known: Vec<String> = Vec::new();
    let mut needs = |name: &str, what: &str, doubts: &mut Vec<Doubt>| {
        if mentions(brief, name) || known.iter().any(|known| known == name) {
            return;
        }
        known.push(name.to_owned());
        doubts.push(Doubt {
            rule: "brief",
            of: name.to_owned(),
            what: format!("the brief does not mention `{name}`, {what}"),
            help: "say what it is, with its unit: students read nothing else".to_owned(),
        });
    };
    for task in &rubric.lab.tasks {
        let title = &task.title;
        let grants = match &task.work {
            TaskWork::Function(function, _) => {
                let what = format!("the function that task \"{title}\" calls");
                needs(function.name(), &what, doubts);
                &function.grants
            }
            TaskWork::Motion(motion, _) => {
                needs(
                    "control",
                    &format!("the function that task \"{title}\" calls"),
                    doubts,
                );
                let what = format!("which `observation.target` holds in task \"{title}\"");
                if let Value::Map(entries) = &motion.target {
                    entries
                        .iter()
                        .for_each(|(name, _)| needs(name, &what, doubts));
                }
                let what = format!("a sensor of task \"{title}\"");
                for sensor in &motion.sensors {
                    needs(&sensor.name, &what, doubts);
                }
                &motion.grants
            }
        };
        for grant in grants {
            let what = format!("which task \"{title}\" lends");
            needs(grant.name(), &what, doubts);
        }
    }
}

/// Whether `text` has `name` as a word of its own.
fn mentions(text: &str, name: &str) -> bool {
    let is_of_name = |c: char| c.is_alphanumeric() || c == '_';
    text.match_indices(name).any(|(at, _)| {
        let before = text[..at].chars().next_back();
        let after = text[at + name.len()..].chars().next();
        !before.is_some_and(is_of_name) && !after.is_some_and(is_of_name)
    })
}

#[cfg(test)]
mod tests {
    use super::mentions;

    #[test]
    fn a_name_is_a_word_of_its_own() {
        assert!(mentions("call `fk(q)` first", "fk"));
        assert!(!mentions("call `fkine` first", "fk"));
        assert!(!mentions("the my_fk", "fk"));
    }
}
