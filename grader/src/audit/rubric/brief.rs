//! What is graded and the brief does not mention: functions to write, what they are given and answer, what a task lends, what it gives,
//! sensors.

use kinemark_sim::control::{Gains, Mode};

use super::{Doubt, Rubric};
use crate::lab::TaskWork;
use crate::task::model::{Case, Given};
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
                let given = format!("which `given` holds in task \"{title}\"");
                let answered = format!("an entry of the answer in task \"{title}\"");
                for (name, is_given) in entries(&function.cases) {
                    needs(name, if is_given { &given } else { &answered }, doubts);
                }
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

/// The names of what functions of the lab's own are given (`true`) and answer.
fn entries(cases: &[Case]) -> impl Iterator<Item = (&str, bool)> {
    cases.iter().flat_map(|case| {
        let (given, expected) = match &case.given {
            Given::Values { given, expected } => (&given[..], &expected[..]),
            _ => (&[][..], &[][..]),
        };
        let given = given.iter().map(|(name, _)| (&name[..], true));
        // an answer of a single number has no name
        let expected = expected.iter().filter(|(name, _)| !name.is_empty());
        given.chain(expected.map(|(name, _)| (&name[..], false)))
    })
}

/// A gain of a servo, by its key, with the unit by which a brief speaks of it without the key.
type Gain = (&'static str, &'static str, fn(&Gains) -> f64);

/// Gains of servos that the brief speaks of, and gives another number for.
pub(super) fn gains(rubric: &Rubric<'_>, doubts: &mut Vec<Doubt>) {
    let Some(brief) = rubric.brief else {
        return;
    };
    let given: Vec<f64> = brief
        .split(|c: char| !(c.is_ascii_digit() || c == '.'))
        .filter_map(|part| part.trim_end_matches('.').parse().ok())
        .collect();
    let kinds: [Gain; 2] = [
        ("kp", "N m/rad", |gains| gains.kp),
        ("kd", "N m s/rad", |gains| gains.kd),
    ];
    for task in &rubric.lab.tasks {
        let TaskWork::Motion(motion, _) = &task.work else {
            continue;
        };
        // gains do nothing in mode `effort`
        let has_gains = motion.servo.mode != Mode::Effort;
        let kinds = kinds
            .iter()
            .filter(|(key, unit, _)| has_gains && (mentions(brief, key) || brief.contains(unit)));
        for (key, _, gain) in kinds {
            let mut gains = motion.servo.gains.iter().map(gain);
            let is_missing = |gain: &f64| {
                gain.abs() > 0.0
                    && !given
                        .iter()
                        .any(|given| (given - gain).abs() <= 1e-9 * gain.abs())
            };
            if let Some(gain) = gains.find(is_missing) {
                doubts.push(Doubt {
                    rule: "brief",
                    of: format!("{}/{key}", task.name),
                    what: format!("the servo has {key} = {gain}, and the brief, which speaks of such gains, has no such number"),
                    help: "write the gains of this task in the brief, with a mark where they differ from student to student"
                        .to_owned(),
                });
            }
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
