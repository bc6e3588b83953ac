//! What the lab says against what it grades: points and numbers in the brief, names of joints and bodies in checks, hints.

use kinemark_sim::text::Dimension;
use toml::{Table, Value as Toml};

use super::titles::TOUCHES;
use super::{Doubt, Rubric};
use crate::audit::quantities::{bare, stated, unit_of_key};
use crate::audit::typed;
use crate::lab::{Lab, Task, TaskWork};
use crate::record::quantity::points;
use crate::task::value::Value;

/// Looks at the brief, then at the checks.
pub(super) fn rule(rubric: &Rubric<'_>, doubts: &mut Vec<Doubt>) {
    if let Some(brief) = rubric.brief {
        of_headings(rubric.lab, brief, doubts);
        of_targets(rubric.lab, brief, doubts);
        of_budgets(rubric.lab, brief, doubts);
        of_variants(rubric.lab, brief, doubts);
        of_comments(rubric.lab, brief, doubts);
        of_sizes(rubric.lab, brief, doubts);
        of_commands(rubric.lab, brief, doubts);
    }
    let Some(table) = typed::table(rubric.lab) else {
        return;
    };
    let typed = table.get("tasks").and_then(Toml::as_array);
    for (task, typed) in rubric.lab.tasks.iter().zip(typed.into_iter().flatten()) {
        of_names(rubric.lab, task, typed, doubts);
    }
    of_hints(rubric.lab, &table, doubts);
    if let Some(brief) = rubric.brief {
        of_title(rubric.lab, brief, doubts);
    }
}

/// A row of a table that names dimensions of the robot, and gives other numbers for them.
fn of_sizes(lab: &Lab, brief: &str, doubts: &mut Vec<Doubt>) {
    let rows = brief
        .lines()
        .filter(|line| line.trim_start().starts_with('|'));
    for row in rows {
        let keys: Vec<&str> = row
            .split('`')
            .skip(1)
            .step_by(2)
            .filter_map(|code| code.strip_prefix("robot."))
            .collect();
        let values: Option<Vec<f64>> = keys.iter().map(|key| size_of(lab, key)).collect();
        let cell = row.trim().trim_end_matches('|').rsplit('|').next();
        let (Some(values), Some(cell)) = (values, cell) else {
            continue;
        };
        // what a mark computes is right
        if cell.contains("<!--") || cell.contains('`') || values.is_empty() {
            continue;
        }
        let words: Vec<&str> = cell.split_whitespace().collect();
        let mut stated: Vec<(f64, &str)> = stated(&words)
            .into_iter()
            .map(|stated| (stated.value, stated.unit))
            .collect();
        if stated.is_empty() {
            // in another unit, such as N s/m, which is that of the robot
            let numbers = words.iter().filter_map(|word| bare(word).parse().ok());
            stated = numbers.map(|number| (number, "")).collect();
        }
        if stated.len() != values.len() {
            continue;
        }
        let pairs = keys.iter().zip(values).zip(stated);
        for ((key, value), (stated, unit)) in pairs {
            if (value - stated).abs() > 1e-6 * value.abs().max(1e-3) {
                let in_unit = |number: f64| format!("{number} {unit}").trim_end().to_owned();
                doubts.push(doubt(
                    format!("robot.{key}"),
                    format!(
                        "the brief says {}, and the robot has {}",
                        in_unit(stated),
                        in_unit(value)
                    ),
                    "write the robot's number in the brief",
                ));
            }
        }
    }
}

/// The size that a submission reads as `robot.KEY` or `robot.KEY[INDEX]`.
fn size_of(lab: &Lab, key: &str) -> Option<f64> {
    let (name, index) = match key.split_once('[') {
        Some((name, rest)) => (name, rest.strip_suffix(']')?.parse::<usize>().ok()?),
        None => (key, 0),
    };
    match lab.robot.dimensions().get(name)? {
        Dimension::Number(number) => Some(*number),
        Dimension::List(numbers) if key.contains('[') => numbers.get(index).copied(),
        Dimension::List(_) | Dimension::Text(_) => None,
    }
}

/// A row or line that says what `control` returns in another unit than any command has.
fn of_commands(lab: &Lab, brief: &str, doubts: &mut Vec<Doubt>) {
    let has_motion = lab
        .tasks
        .iter()
        .any(|task| matches!(task.work, TaskWork::Motion(..)));
    let line = brief
        .lines()
        .find(|line| line.contains("`control(") && !line.contains("not "));
    let wrong = ["degrees", "deg", "deg/s", "rpm"];
    let said = line.and_then(|line| {
        let mut words = line.split(|c: char| c.is_whitespace() || "|,;()".contains(c));
        words.find(|word| wrong.contains(word))
    });
    if let Some(said) = said.filter(|_| has_motion) {
        doubts.push(doubt(
            "control".to_owned(),
            format!("the brief says that `control` returns something in {said}, and commands are in rad, rad/s, m, m/s, N m or N"),
            "write the unit of the mode of the servo",
        ));
    }
}

/// A brief whose first heading has no word of the lab's title.
fn of_title(lab: &Lab, brief: &str, doubts: &mut Vec<Doubt>) {
    let first = brief.lines().find(|line| !line.trim().is_empty());
    let Some(heading) = first.filter(|line| line.starts_with("# ")) else {
        return;
    };
    let mut words = lab.title.split(|c: char| !c.is_alphanumeric());
    let is_there = words.any(|word| word.chars().count() > 3 && has_word(heading, word));
    let is_long = lab.title.split_whitespace().count() > 1;
    if is_long && !is_there {
        doubts.push(doubt(
            "title".to_owned(),
            format!(
                "the lab is called \"{}\", and the brief begins with \"{}\"",
                lab.title,
                heading.trim_start_matches("# ")
            ),
            "give both the same name: students look for it in lists and in the report",
        ));
    }
}

pub(super) fn doubt(of: String, what: String, help: &str) -> Doubt {
    Doubt {
        rule: "words",
        of,
        what,
        help: help.to_owned(),
    }
}

/// `(9 points` in a heading that names a task.
fn of_headings(lab: &Lab, brief: &str, doubts: &mut Vec<Doubt>) {
    for heading in brief.lines().filter(|line| line.starts_with('#')) {
        let stated = heading.split_once(" point").and_then(|(before, _)| {
            let number = before.rsplit(['(', ' ']).next()?;
            number.parse::<f64>().ok()
        });
        let mut tasks = lab.tasks.iter();
        let task = tasks.find(|task| has_word(heading, &task.name));
        if let (Some(stated), Some(task)) = (stated, task)
            && points(stated) != points(task.max_points())
        {
            doubts.push(doubt(
                task.name.clone(),
                format!(
                    "the brief's heading says {} points, the checks of the task have {}",
                    points(stated),
                    points(task.max_points())
                ),
                "write the same in the heading: `kinemark lab fill` writes the table alone",
            ));
        }
    }
}

/// `target.KEY` = NUMBER in the brief, where no task has that number.
fn of_targets(lab: &Lab, brief: &str, doubts: &mut Vec<Doubt>) {
    let key_and_number = |span: &str| {
        let (key, rest) = span.split_once(['`', ' ', '='])?;
        let rest = rest.trim_start_matches(['`', ' ']);
        let rest = match rest.strip_prefix('=') {
            Some(rest) => rest,
            // the sign was what ended the key
            None if span[key.len()..].starts_with('=') => rest,
            None => return None,
        };
        Some((key.to_owned(), number_at(rest.trim_start())?))
    };
    let mentions = brief.split("target.").skip(1).filter_map(key_and_number);
    for (key, stated) in mentions {
        let targets = lab.tasks.iter().filter_map(|task| match &task.work {
            TaskWork::Motion(motion, _) => Some(&motion.target),
            TaskWork::Function(..) => None,
        });
        let given: Vec<f64> = targets
            .filter_map(|target| match target {
                Value::Map(entries) => entries.iter().find(|(name, _)| *name == key),
                _ => None,
            })
            .filter_map(|(_, value)| match value {
                Value::Number(number) => Some(*number),
                _ => None,
            })
            .collect();
        let is_near = |given: &f64| (given - stated).abs() <= 0.005 * given.abs().max(1e-9);
        let of = format!("target.{key}");
        if given.is_empty() || given.iter().any(is_near) || doubts.iter().any(|d| d.of == of) {
            continue;
        }
        let given: Vec<String> = given.iter().map(f64::to_string).collect();
        doubts.push(doubt(
            of,
            format!("the brief says {stated}, lab.toml {}", given.join(" and ")),
            "write the same number, with a mark that `kinemark lab fill` keeps right: `0.5<!-- = step -->`",
        ));
    }
}

/// How many operations a call may use.
fn of_budgets(lab: &Lab, brief: &str, doubts: &mut Vec<Doubt>) {
    let budgets = [
        lab.budgets.operations_per_call,
        lab.budgets.operations_per_task,
    ];
    let mentions = brief.match_indices(" operations");
    for (before, after) in mentions.map(|(at, _)| brief.split_at(at)) {
        let rest = after.split(['.', ',', '\n']).next().unwrap_or_default();
        // what a whole task may use, shared out among its calls
        if has_word(rest, "average") {
            continue;
        }
        let word = before
            .rsplit(|c: char| c.is_whitespace() || c == '(')
            .next();
        let digits: Option<u64> = word.and_then(|word| word.replace(',', "").parse().ok());
        let is_call = before.rsplit(['.', '\n']).next().is_some_and(|sentence| {
            has_word(sentence, "call") && (has_word(sentence, "may") || has_word(sentence, "most"))
        });
        if let (Some(stated), true) = (digits, is_call)
            && !budgets.contains(&stated)
        {
            doubts.push(doubt(
                "budgets".to_owned(),
                format!(
                    "the brief says {stated} operations, a call has {}",
                    lab.budgets.operations_per_call
                ),
                "write the same in the brief and in `operations_per_call`",
            ));
        }
    }
}

/// The unit of a parameter, or of an element of one: that of a key whose value it is.
fn typed_unit(table: &Table, entry: &str) -> Option<&'static str> {
    fn of(key: &str, value: &Toml, wanted: &str) -> Option<&'static str> {
        match value {
            Toml::String(text) if text == wanted => unit_of_key(key),
            Toml::Array(items) => items.iter().find_map(|item| of(key, item, wanted)),
            Toml::Table(table) => table.iter().find_map(|(key, item)| of(key, item, wanted)),
            _ => None,
        }
    }
    let wanted = format!("= {entry}");
    table
        .iter()
        .find_map(|(key, value)| of(key, value, &wanted))
}

/// Whether the band of a check ends at a number, with either sign.
fn is_of_band(lab: &Lab, value: f64) -> bool {
    let mut all = lab.tasks.iter().flat_map(|task| match &task.work {
        TaskWork::Function(_, checks) => {
            let bands = checks.iter().map(|check| check.kind.band());
            bands.collect::<Vec<_>>()
        }
        TaskWork::Motion(_, checks) => checks.iter().map(|check| check.kind.band()).collect(),
    });
    let is_end = |end: f64| same(end.abs(), value.abs());
    all.any(|band| band.is_some_and(|(band, _)| is_end(band.full) || is_end(band.zero)))
}

/// Numbers that differ from student to student, typed without a mark.
fn of_variants(lab: &Lab, brief: &str, doubts: &mut Vec<Doubt>) {
    let table = typed::table(lab).unwrap_or_default();
    for rule in &lab.variants {
        let name = &rule.name;
        let values: Vec<(String, f64)> = match lab.parameters.get(name) {
            Some(Dimension::Number(value)) => vec![(name.clone(), *value)],
            Some(Dimension::List(values)) => {
                let entries = values.iter().enumerate();
                entries.map(|(i, x)| (format!("{name}[{i}]"), *x)).collect()
            }
            _ => Vec::new(),
        };
        for (entry, value) in values {
            let is_marked = marks(brief).any(|mark| mark.contains(&entry) || mark.trim() == *name);
            // 1 and 0.5 stand in every text
            let is_telling = (value * 10.0 - (value * 10.0).round()).abs() > 1e-9
                || value.abs() > 1.0 && (value - value.round()).abs() > 1e-9;
            // a limit of a check may be the same number by chance
            let is_alone = is_telling && !is_of_band(lab, value);
            let unit = typed_unit(&table, &entry);
            let mut said = unmarked_numbers(brief).filter(|(number, _)| same(*number, value));
            if is_marked || !said.any(|(_, of)| is_alone || of.is_some() && of == unit) {
                continue;
            }
            doubts.push(doubt(
                entry.clone(),
                format!(
                    "the brief says {value}, which differs from student to student, without a mark"
                ),
                &format!("write `{value}<!-- = {entry} -->`: each student reads the own number"),
            ));
        }
    }
}

/// Comments right behind a number that are nearly marks, and change nothing.
fn of_comments(lab: &Lab, brief: &str, doubts: &mut Vec<Doubt>) {
    for (at, _) in brief.match_indices("<!--") {
        let (before, comment) = brief.split_at(at);
        let is_behind_a_number = before.ends_with(|c: char| c.is_ascii_digit());
        if !is_behind_a_number || comment.starts_with("<!-- =") {
            continue;
        }
        let end = comment.find("-->").map_or(comment.len(), |end| end + 3);
        let comment = comment[..end].lines().next().unwrap_or_default();
        let inside = comment.trim_start_matches(['<', '!', '-', '=', ' ']);
        let inside = inside.trim_end_matches(['>', '-', ' ']);
        let mut words = inside.split(|c: char| !(c.is_alphanumeric() || c == '_'));
        // other comments are nobody's marks
        if !words.any(|word| lab.parameters.get(word).is_some()) {
            continue;
        }
        doubts.push(doubt(
            format!("line {}", before.matches('\n').count() + 1),
            format!("`{comment}` stands behind a number in the brief, and is no mark: everybody reads the same number"),
            &format!("write `<!-- = {inside} -->`"),
        ));
    }
}

fn same(a: f64, b: f64) -> bool {
    (a - b).abs() <= 1e-9 * b.abs()
}

/// What stands in the marks `<!-- = ... -->` of a brief.
fn marks(brief: &str) -> impl Iterator<Item = &str> {
    let marks = brief.split("<!-- =").skip(1);
    marks.filter_map(|rest| Some(rest.split_once("-->")?.0))
}

/// The numbers of a brief that have no mark, each with its unit.
fn unmarked_numbers(brief: &str) -> impl Iterator<Item = (f64, Option<&'static str>)> {
    let is_of_number = |c: char| c.is_ascii_digit() || c == '.' || c == '-';
    let mut at = 0;
    std::iter::from_fn(move || {
        loop {
            let rest = brief.get(at..)?;
            let start = at + rest.find(is_of_number)?;
            let text = &brief[start..];
            let end = text.find(|c| !is_of_number(c)).unwrap_or(text.len());
            at = start + end;
            let is_marked = brief[at..].trim_start().starts_with("<!-- =");
            let number = text[..end].trim_end_matches('.').parse();
            if let (Ok(number), false) = (number, is_marked) {
                let words: Vec<&str> = text.split_whitespace().take(4).collect();
                let with_unit = stated(&words).into_iter().find(|stated| stated.at == 0);
                return Some((number, with_unit.map(|stated| stated.unit)));
            }
        }
    })
}

/// A check that reads one joint, and is called after another; one that reads a touch of one body, and is called after another.
fn of_names(lab: &Lab, task: &Task, typed: &Toml, doubts: &mut Vec<Doubt>) {
    let robot = &lab.of_task(task).robot;
    let joints: Vec<&str> = robot
        .moving_joints()
        .map(|joint| joint.name.as_str())
        .collect();
    let scene = match &task.work {
        TaskWork::Motion(motion, _) => motion.scene.as_deref(),
        TaskWork::Function(..) => None,
    };
    let bodies: Vec<&str> = scene.map_or(Vec::new(), |scene| {
        let bodies = scene.scene.bodies.iter();
        bodies.map(|body| body.name.as_str()).collect()
    });
    let checks = typed.get("checks").and_then(Toml::as_array);
    for (check, typed) in task.checks().iter().zip(checks.into_iter().flatten()) {
        let words = format!("{} {}", check.name, check.title);
        let kinds = typed.as_table().into_iter().flat_map(Table::values);
        for kind in kinds.filter_map(Toml::as_table) {
            let read = kind.get("joint").and_then(Toml::as_str);
            let between = kind.get("between").or_else(|| kind.get("touch"));
            let parties = between.and_then(Toml::as_array).into_iter().flatten();
            let parties: Vec<&str> = parties.filter_map(Toml::as_str).collect();
            let (read, known, key): (Vec<&str>, _, _) = match read {
                Some(joint) => (vec![joint], &joints, "joint"),
                None if parties.len() == 2 => (parties, &bodies, "touch of"),
                None => continue,
            };
            let says = |name: &&&str| has_word(&words, name);
            let other = known.iter().filter(|name| !read.contains(name)).find(says);
            let bodies_read = read.iter().filter(|name| known.contains(name));
            let is_of_another = bodies_read.filter(says).count() == 0;
            // "the part does not touch the fence", and the arm and the fence are read
            let is_of_touch = TOUCHES.iter().any(|word| has_word(&words, word));
            let has_unsaid =
                key != "joint" && is_of_touch && !read.iter().all(|name| has_word(&words, name));
            if let (Some(other), true) = (other, is_of_another || has_unsaid) {
                doubts.push(doubt(
                    format!("{}/{}", task.name, check.name),
                    format!(
                        "\"{}\" is about `{other}`, and reads the {key} `{}`",
                        check.title,
                        read.join("` and `")
                    ),
                    "name what is meant, or give the check another name and title",
                ));
            }
        }
    }
}

/// Two checks that measure different things, and ask the same.
fn of_hints(lab: &Lab, table: &Table, doubts: &mut Vec<Doubt>) {
    let typed = table.get("tasks").and_then(Toml::as_array);
    let mut known: Vec<(String, &[String], &str)> = Vec::new();
    for (task, typed) in lab.tasks.iter().zip(typed.into_iter().flatten()) {
        let typed = typed.get("checks").and_then(Toml::as_array);
        for (check, typed) in task.checks().iter().zip(typed.into_iter().flatten()) {
            let kind = kind_of(typed);
            // a file that was just begun has the same TODO everywhere
            let waits = |hint: &String| hint.starts_with("TODO");
            if check.hints.is_empty() || check.hints.iter().all(waits) {
                continue;
            }
            let of = format!("{}/{}", task.name, check.name);
            let same = known
                .iter()
                .find(|(_, hints, other)| *hints == check.hints && *other != kind);
            if let Some((first, ..)) = same {
                doubts.push(doubt(
                    of.clone(),
                    format!("its hints are those of {first}, which measures something else"),
                    "write hints that lead to what this check measures",
                ));
            }
            known.push((of, &check.hints, kind));
        }
    }
}

/// The kind of a check: its only table.
fn kind_of(check: &Toml) -> &str {
    let mut entries = check.as_table().into_iter().flatten();
    let kind = entries.find(|(_, value)| value.is_table());
    kind.map_or("", |(key, _)| key)
}

/// The number at the beginning of a text.
fn number_at(text: &str) -> Option<f64> {
    let end = text.find(|c: char| !(c.is_ascii_digit() || c == '.' || c == '-'));
    let digits = text[..end.unwrap_or(text.len())].trim_end_matches('.');
    digits.parse().ok()
}

/// Whether a text has a word, in whatever letters; `-` and `_` part words.
pub(super) fn has_word(text: &str, word: &str) -> bool {
    let parts = |text: &str| -> Vec<String> {
        let parts = text.split(|c: char| !c.is_alphanumeric());
        let parts = parts.filter(|part| !part.is_empty());
        parts.map(str::to_lowercase).collect()
    };
    let (text, word) = (parts(text), parts(word));
    !word.is_empty() && text.windows(word.len()).any(|part| part == word)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_without_a_mark_are_found_and_the_others_are_not() {
        let brief = "Go to 1.45<!-- = x --> and -0.25, in 3 s. A mark: <!-- = y[1] -->";
        let found: Vec<_> = unmarked_numbers(brief).collect();
        // what stands in a mark is part of none
        assert!(
            found.starts_with(&[(-0.25, None), (3.0, Some("s"))]),
            "{found:?}"
        );
        assert_eq!(marks(brief).collect::<Vec<_>>(), [" x ", " y[1] "]);
    }

    #[test]
    fn words_are_found_whole_and_in_any_letters() {
        assert!(has_word("The Shoulder stays", "shoulder"));
        assert!(has_word("hold/limit-lower stays", "limit_lower"));
        assert!(!has_word("The shoulders stay", "shoulder"));
        assert!(!has_word("anything", ""));
    }
}
