//! Times that the brief says of runs and calls, against those of lab.toml.

use super::{Doubt, Rubric};
use crate::audit::quantities::{bare, is_same, stated, typed_at};
use crate::audit::typed;
use crate::lab::{Lab, TaskWork};
use crate::task::model::MotionTask;

/// What begins another sentence, or another line of a list or table.
const ENDS: [&str; 6] = [". ", ".\n", "\n\n", "\n- ", "\n|", ";"];

/// A time in the brief that no run, no period and no number of lab.toml has.
pub(super) fn rule(rubric: &Rubric<'_>, doubts: &mut Vec<Doubt>) {
    let Some(brief) = rubric.brief else {
        return;
    };
    let motions: Vec<&MotionTask> = motions(rubric.lab).collect();
    if motions.is_empty() {
        return;
    }
    let table = typed::table(rubric.lab).unwrap_or_default();
    let typed = table.iter().flat_map(|(key, value)| typed_at(key, value));
    let typed: Vec<f64> = typed
        .filter(|(_, unit)| *unit == "s")
        .map(|(time_s, _)| time_s)
        .collect();
    let durations = motions.iter().map(|m| m.periods.time_s(m.ticks));
    let durations: Vec<f64> = durations.collect();
    let periods = motions.iter().map(|m| m.periods.control_s());
    let periods: Vec<f64> = periods.collect();
    let others = motions.iter();
    let others: Vec<f64> = others
        .flat_map(|m| [m.periods.servo_s(), m.periods.step_s])
        .collect();
    for sentence in sentences(brief) {
        let words: Vec<&str> = sentence.split_whitespace().collect();
        let stated = [
            (duration_s(&words), "a time of", "runs take", &durations),
            (
                period_s(&words),
                "a call every",
                "calls are every",
                &periods,
            ),
        ];
        for (stated_s, what, of_lab, real) in stated {
            let Some(stated_s) = stated_s else { continue };
            let mut known = real.iter().chain(&others).chain(&typed);
            if known.any(|x| is_same(*x, stated_s)) {
                continue;
            }
            let mut real: Vec<String> = real.iter().map(|x| format!("{x} s")).collect();
            real.dedup();
            doubts.push(Doubt {
                rule: "words",
                of: "brief".to_owned(),
                what: format!(
                    "it says {what} {stated_s} s, and in lab.toml {of_lab} {}",
                    real.join(" and ")
                ),
                help: "write the same time in the brief".to_owned(),
            });
        }
    }
}

fn motions(lab: &Lab) -> impl Iterator<Item = &MotionTask> {
    lab.tasks.iter().filter_map(|task| match &task.work {
        TaskWork::Motion(motion, _) => Some(&**motion),
        TaskWork::Function(..) => None,
    })
}

/// The sentences of a brief, those with a mark left out: what a mark computes is right.
pub(super) fn sentences(brief: &str) -> impl Iterator<Item = &str> {
    let mut parts = vec![brief];
    for end in ENDS {
        parts = parts.into_iter().flat_map(|part| part.split(end)).collect();
    }
    parts.into_iter().filter(|part| !part.contains("<!--"))
}

/// The one time in a sentence about how long a run is.
fn duration_s(words: &[&str]) -> Option<f64> {
    let has = |wanted: &[&str]| words.iter().any(|word| wanted.contains(&bare(word)));
    let is_of_run =
        has(&["run", "runs"]) && has(&["takes", "take", "lasts", "last", "long", "ends", "end"]);
    // how long to stay is known from goals and bodies
    let is_about = is_of_run || has(&["stay", "stays", "within"]);
    let mut times = times(words);
    let (Some((_, time_s)), None) = (times.next(), times.next()) else {
        return None;
    };
    is_about.then_some(time_s)
}

/// How often `control` is called: `every 10 ms`, `100 times a second`, `at 100 Hz`.
fn period_s(words: &[&str]) -> Option<f64> {
    let is_about = words
        .iter()
        .any(|word| ["called", "calls"].contains(&bare(word)) || word.starts_with("`control"));
    if !is_about {
        return None;
    }
    let every = times(words).find(|(at, _)| {
        let before = at.checked_sub(1).and_then(|before| words.get(before));
        before.is_some_and(|before| ["every", "each"].contains(&bare(before)))
    });
    let often = words.windows(2).enumerate().find_map(|(at, pair)| {
        let number: f64 = bare(pair[0]).parse().ok()?;
        let after = |by: usize| words.get(at + by).map(|word| bare(word));
        let is_often = bare(pair[1]) == "Hz"
            || bare(pair[1]) == "times"
                && after(3) == Some("second")
                && matches!(after(2), Some("a" | "per" | "every" | "each"));
        (is_often && number > 0.0).then(|| 1.0 / number)
    });
    every.map(|(_, time_s)| time_s).or(often)
}

/// The times \[s\] among words, each with the place of its number: `3 s`, `10 ms`, `2 seconds`.
fn times(words: &[&str]) -> impl Iterator<Item = (usize, f64)> {
    let times = stated(words).into_iter();
    let times = times.filter(|stated| stated.unit == "s");
    times.map(|stated| (stated.at, stated.value))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn words(text: &str) -> Vec<&str> {
        text.split_whitespace().collect()
    }

    #[test]
    fn times_of_runs_are_found_where_a_sentence_has_one() {
        for (text, expected) in [
            ("The run takes 8 s", Some(8.0)),
            ("each run is **2.5** seconds long", Some(2.5)),
            ("the run lasts 8 s, of which 2 s count", None),
            ("The run ends at 12 s", Some(12.0)),
            ("stay there for 0.5 s", Some(0.5)),
            ("be there within 8 s", Some(8.0)),
            ("hold it for 0.5 s", None),
            ("the run takes long", None),
        ] {
            assert_eq!(duration_s(&words(text)), expected, "{text}");
        }
    }

    #[test]
    fn periods_of_calls_are_found_however_they_are_said() {
        for (text, expected) in [
            ("`control` is called every 10 ms", Some(0.01)),
            ("Kinemark calls it 100 times a second", Some(0.01)),
            ("it is called at 50 Hz", Some(0.02)),
            ("`control(observation)` | every 20 ms |", Some(0.02)),
            ("the light blinks every 10 ms", None),
            ("it is called 3 times", None),
        ] {
            assert_eq!(period_s(&words(text)), expected, "{text}");
        }
    }

    #[test]
    fn sentences_with_a_mark_are_left_out() {
        let brief = "The run takes 3 s. It is 0.5<!-- = x --> m long.\n- one\n- two";
        let found: Vec<&str> = sentences(brief).collect();
        assert_eq!(found, ["The run takes 3 s", "- one", "two"]);
    }
}
