//! Times that the brief says of runs and calls, against those of lab.toml.

use toml::Value;

use super::{Doubt, Rubric};
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
    let mut typed = Vec::new();
    let table = typed::table(rubric.lab).unwrap_or_default();
    table
        .iter()
        .for_each(|(key, value)| times_typed(key, value, &mut typed));
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
            if known.any(|x| is_near(*x, stated_s)) {
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

fn is_near(a: f64, b: f64) -> bool {
    (a - b).abs() <= 1e-6 * b.abs()
}

/// The times \[s\] at a key of lab.toml: it ends with its unit.
fn times_typed(key: &str, value: &Value, found: &mut Vec<f64>) {
    let unit_s = match key.rsplit('_').next() {
        Some("s") => 1.0,
        Some("ms") => 1e-3,
        _ => 0.0,
    };
    let is_time = unit_s > 0.0;
    match value {
        Value::Float(number) if is_time => found.push(unit_s * number),
        Value::Integer(number) if is_time => found.push(unit_s * *number as f64),
        Value::Array(items) => items.iter().for_each(|item| times_typed(key, item, found)),
        Value::Table(table) => {
            let mut entries = table.iter();
            entries
                .by_ref()
                .for_each(|(key, item)| times_typed(key, item, found));
        }
        // an expression such as "= 0.5 * period" has numbers, too
        Value::String(text) if is_time => {
            let parts = text.split(|c: char| !(c.is_ascii_digit() || c == '.'));
            let numbers = parts.filter_map(|part| part.parse::<f64>().ok());
            found.extend(numbers.map(|number| unit_s * number));
        }
        Value::Float(_)
        | Value::Integer(_)
        | Value::String(_)
        | Value::Boolean(_)
        | Value::Datetime(_) => {}
    }
}

/// The sentences of a brief, those with a mark left out: what a mark computes is right.
fn sentences(brief: &str) -> impl Iterator<Item = &str> {
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
        .any(|word| ["called", "calls"].contains(&bare(word)) || word.contains("control`"));
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

/// The times among words, each with the place of its number: `3 s`, `10 ms`, `2 seconds`.
fn times(words: &[&str]) -> impl Iterator<Item = (usize, f64)> {
    words.windows(2).enumerate().filter_map(|(at, pair)| {
        let number: f64 = bare(pair[0]).parse().ok()?;
        let scale = match bare(pair[1]) {
            "s" | "second" | "seconds" => 1.0,
            "ms" | "millisecond" | "milliseconds" => 1e-3,
            _ => return None,
        };
        Some((at, number * scale))
    })
}

/// A word without what stands around it.
fn bare(word: &str) -> &str {
    let of_word = |c: char| c.is_alphanumeric() || c == '.' || c == '-';
    word.trim_matches(|c| !of_word(c)).trim_end_matches('.')
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
