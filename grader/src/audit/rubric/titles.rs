//! Titles of checks against their keys: the side, the touch, the part of the run, the entry, and which end of the band is the better.

use toml::{Table, Value as Toml};

use super::words::{doubt, has_word};
use super::{Doubt, Rubric};
use crate::audit::typed;

/// Looks at the title of every check.
pub(super) fn rule(rubric: &Rubric<'_>, doubts: &mut Vec<Doubt>) {
    let Some(table) = typed::table(rubric.lab) else {
        return;
    };
    of_checks(&table, doubts);
    of_entries(&table, doubts);
}

/// A check as it is written, with the words that students read.
struct Titled<'a> {
    /// `TASK/CHECK`
    of: String,
    title: &'a str,
    kind: &'a str,
    keys: &'a Table,
    /// How long the task's run is \[s\]; without an end where it has none.
    run_s: f64,
}

impl Titled<'_> {
    /// The first of `words` that the title has.
    fn first_of(&self, words: &'static [&'static str]) -> Option<&'static str> {
        words
            .iter()
            .find(|words| has_word(self.title, words))
            .copied()
    }

    fn text(&self, key: &str) -> Option<&str> {
        self.keys.get(key)?.as_str()
    }
}

/// Each title against the keys of its own check.
fn of_checks(table: &Table, doubts: &mut Vec<Doubt>) {
    const QUESTIONS: [fn(&Titled<'_>) -> Option<Doubt>; 5] =
        [of_touch, of_side, of_whole_run, of_opposites, of_end];
    for task in typed::tables(table, "tasks") {
        let run_s = task
            .get("motion")
            .and_then(|motion| typed::number(motion.get("duration_s")?))
            .unwrap_or(f64::INFINITY);
        for check in typed::tables(task, "checks") {
            let Some((kind, keys)) = typed::kind(check) else {
                continue;
            };
            let check = Titled {
                of: format!("{}/{}", typed::name(task), typed::name(check)),
                title: check
                    .get("title")
                    .and_then(Toml::as_str)
                    .unwrap_or_default(),
                kind,
                keys,
                run_s,
            };
            doubts.extend(QUESTIONS.iter().filter_map(|question| question(&check)));
        }
    }
}

/// Words that exclude each other.
const OPPOSITES: [[&str; 2]; 4] = [
    ["near", "far"],
    ["left", "right"],
    ["front", "back"],
    ["above", "below"],
];

/// Words of a moment at which something is touched.
pub(super) const TOUCHES: [&str; 6] = ["touch", "touches", "touched", "push", "pushed", "hits"];

/// Words of a whole run.
const WHOLE: [&str; 5] = [
    "all the time",
    "the whole time",
    "the whole run",
    "always",
    "throughout",
];

/// A title about a touch with a check that looks at the whole run.
fn of_touch(check: &Titled<'_>) -> Option<Doubt> {
    let title = check.title;
    check.first_of(&TOUCHES)?;
    (check.text("at") == Some("run")).then(|| {
        doubt(
            check.of.clone(),
            format!("\"{title}\" is about a touch, and at = \"run\" looks at the whole run"),
            "write at = \"touch\", or another title",
        )
    })
}

/// A title about a side with a check for which all sides are as good.
fn of_side(check: &Titled<'_>) -> Option<Doubt> {
    let title = check.title;
    check.first_of(&["side", "near edge", "far edge"])?;
    (check.kind == "body-falls" && !check.keys.contains_key("side")).then(|| {
        doubt(
            check.of.clone(),
            format!("\"{title}\" is about a side, and without `side` all sides are as good"),
            "write side = \"near\" or \"far\", or another title",
        )
    })
}

/// A title about the whole run with a check of less than half of it.
fn of_whole_run(check: &Titled<'_>) -> Option<Doubt> {
    let title = check.title;
    check.first_of(&WHOLE)?;
    let (key, part_s) = ["last_s", "hold_s"].into_iter().find_map(|key| {
        let part_s = typed::number(check.keys.get(key)?)?;
        (2.0 * part_s < check.run_s).then_some((key, part_s))
    })?;
    Some(doubt(
        check.of.clone(),
        format!(
            "\"{title}\" is about the whole run, and `{key}` = {part_s} looks at its last part"
        ),
        "choose a kind of check that looks at the whole run, such as joint-tracking, or another title",
    ))
}

/// A title that says the opposite of a key, such as `side = "near"`.
fn of_opposites(check: &Titled<'_>) -> Option<Doubt> {
    let title = check.title;
    let (key, value, other) = check.keys.iter().find_map(|(key, value)| {
        let value = value.as_str()?;
        let pair = OPPOSITES.iter().find(|pair| pair.contains(&value))?;
        let other = pair.iter().find(|word| **word != value)?;
        (has_word(title, other) && !has_word(title, value)).then_some((key, value, other))
    })?;
    Some(doubt(
        check.of.clone(),
        format!("\"{title}\" says {other}, and {key} = \"{value}\""),
        "say the same in the title and in the key",
    ))
}

/// A check that reads one entry of an answer, and is called after another.
fn of_entries(table: &Table, doubts: &mut Vec<Doubt>) {
    for task in typed::tables(table, "tasks") {
        let checks = typed::tables(task, "checks");
        let read = |check: &Table| -> Option<String> {
            let (_, keys) = typed::kind(check)?;
            Some(keys.get("entry")?.as_str()?.to_owned())
        };
        let entries: Vec<String> = checks.iter().filter_map(|check| read(check)).collect();
        for check in &checks {
            let title = check.get("title").and_then(Toml::as_str);
            let (Some(title), Some(own)) = (title, read(check)) else {
                continue;
            };
            let words = format!("{} {title}", typed::name(check));
            let other = entries
                .iter()
                .find(|entry| **entry != own && has_word(&words, entry));
            if let Some(other) = other.filter(|_| !has_word(&words, &own)) {
                doubts.push(doubt(
                    format!("{}/{}", typed::name(task), typed::name(check)),
                    format!("\"{title}\" is about `{other}`, and reads the entry `{own}`"),
                    "name the entry that is meant, or give the check another name and title",
                ));
            }
        }
    }
}

/// Words of a time that is the better the shorter; of a speed they say the reverse.
const SHORT: [&str; 5] = ["in time", "within the time", "quick", "quickly", "soon"];
/// Words of what has a most, and of what has a least.
const LESS: [&str; 2] = ["at most", "no more than"];
const MORE: [&str; 3] = ["at least", "no less than", "not before"];

/// A check that is upside down: its title asks for little, and more is better, or the reverse.
fn of_end(check: &Titled<'_>) -> Option<Doubt> {
    let (title, keys) = (check.title, check.keys);
    // of kinds that can be either
    if !keys.keys().any(|key| key.starts_with("full")) {
        return None;
    }
    let at_least = keys.get("at_least").and_then(Toml::as_bool) == Some(true);
    let is_time = keys.contains_key("full_s");
    let less = check
        .first_of(&LESS)
        .or_else(|| check.first_of(&SHORT).filter(|_| is_time));
    let (words, is) = match (less, check.first_of(&MORE)) {
        (Some(less), None) if at_least => (less, "with at_least = true more is better"),
        (None, Some(more)) if !at_least && is_of_size(keys) => {
            (more, "without at_least = true less is better")
        }
        _ => return None,
    };
    Some(doubt(
        check.of.clone(),
        format!("\"{title}\" says \"{words}\", and {is}"),
        "remove `at_least`, or set it, or choose another title",
    ))
}

/// Whether a band is of a time or a speed, of which both can be asked: errors are the better the less.
fn is_of_size(keys: &Table) -> bool {
    ["full_s", "full_rad_s", "full_m_s"]
        .iter()
        .any(|key| keys.contains_key(*key))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_title_that_says_the_opposite_of_a_key_is_found() {
        let table = |title: &str| {
            let text = format!(
                "[[tasks]]\nname = \"t\"\n[[tasks.checks]]\nname = \"c\"\ntitle = \"{title}\"\nbody-falls = {{ side = \"near\" }}\n"
            );
            text.parse::<Table>().expect("TOML")
        };
        for (title, count) in [
            ("Over the far edge", 1),
            ("Over the near edge", 0),
            ("Near, not far", 0),
            ("It falls", 0),
        ] {
            let mut doubts = Vec::new();
            of_checks(&table(title), &mut doubts);
            assert_eq!(doubts.len(), count, "{title}: {doubts:?}");
        }
    }

    #[test]
    fn a_title_about_a_side_with_a_check_of_none_is_found() {
        for (title, keys, count) in [
            ("It falls on the robot's side", "", 1),
            ("It falls on the robot's side", "side = \"near\"", 0),
            ("It falls", "", 0),
        ] {
            let text = format!(
                "[[tasks]]\nname = \"t\"\n[[tasks.checks]]\nname = \"c\"\ntitle = \"{title}\"\nbody-falls = {{ {keys} }}\n"
            );
            let mut doubts = Vec::new();
            of_checks(&text.parse::<Table>().expect("TOML"), &mut doubts);
            assert_eq!(doubts.len(), count, "{title}: {doubts:?}");
        }
    }

    #[test]
    fn a_title_of_the_whole_run_with_a_check_of_its_last_part_is_found() {
        for (title, check, count) in [
            (
                "It is held all the time",
                "steady-error = { last_s = 0.5 }",
                1,
            ),
            (
                "It is held all the time",
                "joint-reached = { hold_s = 0.5 }",
                1,
            ),
            (
                "It is held all the time",
                "joint-reached = { hold_s = 2.0 }",
                0,
            ),
            ("It stands at the end", "steady-error = { last_s = 0.5 }", 0),
        ] {
            let text = format!(
                "[[tasks]]\nname = \"t\"\nmotion = {{ duration_s = 2.0 }}\n[[tasks.checks]]\nname = \"c\"\ntitle = \"{title}\"\n{check}\n"
            );
            let mut doubts = Vec::new();
            of_checks(&text.parse::<Table>().expect("TOML"), &mut doubts);
            assert_eq!(doubts.len(), count, "{title}: {doubts:?}");
        }
    }

    #[test]
    fn a_title_that_names_the_entry_of_another_check_is_found() {
        let table = |title: &str| {
            let check = |name: &str, title: &str, entry: &str| {
                format!(
                    "[[tasks.checks]]\nname = \"{name}\"\ntitle = \"{title}\"\nfunction-cases = {{ entry = \"{entry}\" }}\n"
                )
            };
            let text = format!(
                "[[tasks]]\nname = \"t\"\n{}{}",
                check("first", title, "inertia"),
                check("second", "The damping ratio", "damping_ratio")
            );
            text.parse::<Table>().expect("TOML")
        };
        for (title, count) in [
            ("The damping ratio", 1),
            ("The inertia", 0),
            ("Inertia and damping ratio", 0),
            ("What resists", 0),
        ] {
            let mut doubts = Vec::new();
            of_entries(&table(title), &mut doubts);
            assert_eq!(doubts.len(), count, "{title}: {doubts:?}");
        }
    }

    #[test]
    fn a_title_of_a_touch_with_a_check_of_the_whole_run_is_found() {
        for (at, count) in [("run", 1), ("touch", 0)] {
            let text = format!(
                "[[tasks]]\nname = \"t\"\n[[tasks.checks]]\nname = \"c\"\ntitle = \"The can is pushed\"\ntcp-speed = {{ at = \"{at}\" }}\n"
            );
            let mut doubts = Vec::new();
            of_checks(&text.parse::<Table>().expect("TOML"), &mut doubts);
            assert_eq!(doubts.len(), count, "{at}: {doubts:?}");
        }
    }

    #[test]
    fn a_title_that_asks_for_less_where_more_is_better_is_found() {
        for (title, keys, count) in [
            (
                "It falls in time",
                "full_s = 2.0, zero_s = 1.0, at_least = true",
                1,
            ),
            ("It falls in time", "full_s = 1.0, zero_s = 2.0", 0),
            (
                "The joint is quick",
                "full_rad_s = 2.0, zero_rad_s = 1.0, at_least = true",
                0,
            ),
            ("It takes at least 15 s", "full_s = 1.0, zero_s = 2.0", 1),
            (
                "It takes at least 15 s",
                "full_s = 2.0, zero_s = 1.0, at_least = true",
                0,
            ),
            (
                "At least one branch reaches",
                "full_m = 0.1, zero_m = 0.2",
                0,
            ),
            (
                "Within the time, and at least once",
                "full_s = 1.0, zero_s = 2.0",
                0,
            ),
        ] {
            let text = format!(
                "[[tasks]]\nname = \"t\"\n[[tasks.checks]]\nname = \"c\"\ntitle = \"{title}\"\ntime-limit = {{ {keys} }}\n"
            );
            let mut doubts = Vec::new();
            of_checks(&text.parse::<Table>().expect("TOML"), &mut doubts);
            assert_eq!(doubts.len(), count, "{title}: {doubts:?}");
        }
    }
}
