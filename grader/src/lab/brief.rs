//! The brief's table of points, and the numbers in its text: made from the lab, so that brief and grader cannot disagree.

use std::fmt::Write as _;

use kinemark_sim::text::expression::evaluate_named;
use kinemark_sim::text::number::trimmed;

use super::model::{Lab, Task, TaskWork};
use crate::check::Criterion;
use crate::record::quantity::points;

/// The line before the table.
pub const BEGIN: &str = "<!-- grading: begin -->";
/// The line after it.
pub const END: &str = "<!-- grading: end -->";

/// The brief with its table as `lab` has it; a brief without the two marks is returned as it is.
pub fn with_grading(brief: &str, lab: &Lab) -> String {
    let Some((head, rest)) = brief.split_once(BEGIN) else {
        return brief.to_owned();
    };
    let Some((_, tail)) = rest.split_once(END) else {
        return brief.to_owned();
    };
    format!("{head}{BEGIN}\n{}{END}{tail}", table(lab))
}

/// Whether a brief has the two marks, in their order.
pub fn has_place_for_grading(brief: &str) -> bool {
    let behind = brief.split_once(BEGIN).map(|(_, rest)| rest);
    behind.is_some_and(|rest| rest.contains(END))
}

/// The files of the pictures in a brief, `![...](frame.svg)`, in their order.
pub fn pictures(brief: &str) -> impl Iterator<Item = &str> {
    let begun = brief.split("![").skip(1);
    let paths = begun.filter_map(|rest| {
        let (alternative, rest) = rest.split_once("](")?;
        // of a macro or a picture elsewhere, with a link somewhere behind it
        (!alternative.contains(']')).then_some(rest.split_once(')')?.0)
    });
    // a title may stand behind the path
    let paths = paths.filter_map(|path| path.split_whitespace().next());
    let paths = paths.map(|path| path.trim_start_matches("./"));
    paths.filter(|path| !path.contains("://") && !path.starts_with("data:"))
}

/// How a mark begins that stands behind a number, invisible where the brief is shown: `3.0<!-- = line_x -->`.
const MARK: &str = "<!-- =";
const MARK_END: &str = "-->";

/// Decimals of a number whose mark names none: a micrometre, if it is a length.
const DECIMALS: usize = 6;

/// The brief with the numbers of `lab` before its marks `<!-- = expression -->` or `<!-- = expression | decimals -->`.
///
/// Without decimals a number has as many as it needs, at most six, and at least as many as stood there.
///
/// # Errors
/// In words, with the line: a mark without a number before it or without an end, or an expression that has no value.
pub fn with_numbers(brief: &str, lab: &Lab) -> Result<String, String> {
    let mut out = String::new();
    let mut rest = brief;
    while let Some((before, behind)) = rest.split_once(MARK) {
        let line = brief[..brief.len() - rest.len() + before.len()]
            .matches('\n')
            .count()
            + 1;
        let Some((mark, tail)) = behind.split_once(MARK_END) else {
            return Err(format!("line {line}: the mark has no `{MARK_END}`"));
        };
        let text = before.trim_end_matches(|c: char| c.is_ascii_digit() || c == '.');
        let digits = &before[text.len()..];
        if digits.trim_matches('.').is_empty() {
            return Err(format!(
                "line {line}: no number stands before the mark `{}`",
                mark.trim()
            ));
        }
        // a sign, unless it stands between two numbers
        let unsigned = text.strip_suffix(['-', '−']);
        let between = |before: &str| before.ends_with(|c: char| c.is_ascii_digit());
        let text = match unsigned {
            Some(before) if !between(before) => before,
            _ => text,
        };
        let (expression, decimals) = match mark.split_once('|') {
            None => (mark, None),
            Some((expression, decimals)) => match decimals.trim().parse::<usize>() {
                Ok(decimals) if decimals <= 12 => (expression, Some(decimals)),
                _ => {
                    return Err(format!(
                        "line {line}: `{}` is no number of decimals",
                        decimals.trim()
                    ));
                }
            },
        };
        let value =
            evaluate_named(expression, &lab.parameters, "parameter").map_err(|problem| {
                let help = problem
                    .help
                    .map(|help| format!(" ({help})"))
                    .unwrap_or_default();
                format!("line {line}: {}{help}", problem.message)
            })?;
        let number = match decimals {
            Some(decimals) => format!("{value:.decimals$}"),
            None => {
                let stood = digits
                    .split_once('.')
                    .map_or(0, |(_, decimals)| decimals.len());
                let short = trimmed(value, DECIMALS);
                let needed = short
                    .split_once('.')
                    .map_or(0, |(_, decimals)| decimals.len());
                format!("{value:.*}", needed.max(stood))
            }
        };
        out.push_str(text);
        out.push_str(&number);
        out.push_str(MARK);
        out.push_str(mark);
        out.push_str(MARK_END);
        rest = tail;
    }
    out.push_str(rest);
    Ok(out)
}

fn table(lab: &Lab) -> String {
    let mut text = String::from(
        "\n| task | check | points | all points | none | |\n|---|---|---:|---|---|---|\n",
    );
    let mut total = 0.0;
    for task in &lab.tasks {
        let checks = task.checks();
        for check in &checks {
            total += check.points;
            let [full, zero] = bounds(lab, task, check);
            let needs: Vec<String> = check
                .needs
                .iter()
                .map(|&need| format!("\"{}\"", checks[need].title))
                .collect();
            let note = if needs.is_empty() {
                String::new()
            } else {
                let earn = if needs.len() == 1 { "earns" } else { "earn" };
                format!("counts once {} {earn} something", needs.join(" and "))
            };
            // writing into a string cannot fail
            let _ = writeln!(
                text,
                "| {} | {} | {} | {full} | {zero} | {note} |",
                task.name,
                check.title,
                points(check.points)
            );
        }
    }
    let _ = writeln!(text, "| | **together** | **{}** | | | |\n", points(total));
    text
}

/// What earns all points and what earns none, with the numbers of the lab's variant where they are known.
fn bounds(lab: &Lab, task: &Task, check: &Criterion) -> [String; 2] {
    let known = || {
        let TaskWork::Motion(_, checks) = &task.work else {
            return None;
        };
        let own = checks.iter().find(|known| known.name == check.name)?;
        let value = lab.practice.value(&task.name, &check.name)?;
        Some(own.kind.at_reference(value)?.bounds())
    };
    let bounds = check.bounds.clone();
    let Some(numbers) = known() else {
        return bounds;
    };
    // `up to 0.332 s (the reference + 0.1 s)`
    let both = |number: String, words: &String| {
        let words = words
            .trim_start_matches("up to ")
            .trim_start_matches("from ");
        if number.ends_with(words) {
            number
        } else {
            format!("{number} ({words})")
        }
    };
    let [full, zero] = numbers;
    [both(full, &bounds[0]), both(zero, &bounds[1])]
}

/// The brief without its marks `<!-- = expression -->`, which are for whoever writes the lab; a mark without an end stays.
pub fn without_marks(brief: &str) -> String {
    let mut out = String::new();
    let mut rest = brief;
    while let Some((before, behind)) = rest.split_once(MARK)
        && let Some((_, tail)) = behind.split_once(MARK_END)
    {
        out += before;
        rest = tail;
    }
    out + rest
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lab::copies::Copies;

    #[test]
    fn pictures_are_found_with_and_without_a_title() {
        let brief = "![an arm](arm.svg) and [a page](page.md), ![a plot](p.svg \"a plot\"), ![](https://a.b/c.svg), `vec![0.0; 2]` and [more](#more)";
        assert_eq!(pictures(brief).collect::<Vec<_>>(), ["arm.svg", "p.svg"]);
    }

    const LAB: &str = r#"
format = 1
name = "x"
title = "X"
robot = "r"
parameters = { far = 3.0, l = [0.25, -1.5] }
[[tasks]]
name = "t"
title = "T"
function = { call = "forward_kinematics", cases = [{ name = "c", q_rad = ["= l[0]"] }] }
checks = [{ name = "c", title = "C", points = 1.0, fk-error = { full_m = 0.1, zero_m = 0.2 } }]
"#;
    const ROBOT: &str = r#"
format = 1
name = "r"
links = [{ name = "a" }, { name = "b", shapes = [{ box = { size_m = [1.0, 1.0, 1.0] } }], inertia = { mass_kg = 1.0 } }]
joints = [{ name = "j", type = "revolute", parent = "a", child = "b", axis = [0.0, 0.0, 1.0] }]
"#;

    #[test]
    fn the_number_before_a_mark_is_that_of_the_lab() {
        let files = Copies::from_texts([("x/lab.toml", LAB), ("robots/r.toml", ROBOT)]);
        let lab = Lab::load(&files, "x").unwrap();
        for (brief, expected) in [
            ("from 9.0<!-- = far --> m", "from 3.0<!-- = far --> m"),
            ("9<!-- = far / 8 -->", "0.375<!-- = far / 8 -->"),
            ("9<!-- = far / 7 | 2 -->", "0.43<!-- = far / 7 | 2 -->"),
            ("9<!-- = far / 7 -->", "0.428571<!-- = far / 7 -->"),
            (
                "-9.2<!-- =l[1] --> to 2<!-- =l[0]-->",
                "-1.5<!-- =l[1] --> to 0.25<!-- =l[0]-->",
            ),
            ("1.0-9.0<!-- = far -->", "1.0-3.0<!-- = far -->"),
            (
                "no mark <!-- but a comment -->",
                "no mark <!-- but a comment -->",
            ),
        ] {
            assert_eq!(with_numbers(brief, &lab).as_deref(), Ok(expected));
            // what is right already stays
            assert_eq!(with_numbers(expected, &lab).as_deref(), Ok(expected));
        }
        for (brief, why) in [
            (
                "a\nb<!-- = far -->",
                "line 2: no number stands before the mark `far`",
            ),
            (
                "1<!-- = near -->",
                "line 1: no parameter is called `near` (parameters: far, l)",
            ),
            ("1<!-- = far", "line 1: the mark has no `-->`"),
            (
                "1<!-- = far | x -->",
                "line 1: `x` is no number of decimals",
            ),
        ] {
            assert_eq!(with_numbers(brief, &lab), Err(why.to_owned()));
        }
    }

    #[test]
    fn a_brief_without_marks_keeps_everything_else() {
        for (brief, expected) in [
            (
                "from 3.0<!-- = far --> to -1.5<!-- =l[1] | 2 -->.",
                "from 3.0 to -1.5.",
            ),
            (BEGIN, BEGIN),
            (
                "a <!-- comment --> $x = 1$ ≤",
                "a <!-- comment --> $x = 1$ ≤",
            ),
            ("1<!-- = far -->2<!-- = far", "12<!-- = far"),
        ] {
            assert_eq!(without_marks(brief), expected);
        }
    }

    #[test]
    fn the_table_says_what_a_check_waits_for() {
        let check = |name: &str, needs: &str| {
            format!(
                "{{ name = \"{name}\", title = \"{name}\", points = 1.0, needs = {needs}, fk-error = {{ full_m = 0.1, zero_m = 0.2 }} }}"
            )
        };
        let (head, _) = LAB.split_once("checks =").unwrap();
        let checks = [
            check("a", "[]"),
            check("b", "[\"a\"]"),
            check("c", "[\"a\", \"b\"]"),
        ];
        let text = format!("{head}checks = [{}]\n", checks.join(", "));
        let files = Copies::from_texts([("x/lab.toml", &*text), ("robots/r.toml", ROBOT)]);
        let table = table(&Lab::load(&files, "x").unwrap());
        assert!(
            table.contains("counts once \"a\" earns something"),
            "{table}"
        );
        assert!(
            table.contains("counts once \"a\" and \"b\" earn something"),
            "{table}"
        );
    }

    #[test]
    fn a_variant_is_a_lab_of_other_numbers() {
        let files = Copies::from_texts([("x/lab.toml", LAB), ("robots/r.toml", ROBOT)]);
        let lab = Lab::load(&files, "x").unwrap();
        let changed = [("far".to_owned(), kinemark_sim::text::Dimension::Number(2.5))];
        let other = lab.with_parameters(&changed).unwrap();
        assert_eq!(
            with_numbers("0<!-- = far -->", &other).as_deref(),
            Ok("2.5<!-- = far -->")
        );
        let unknown = [(
            "near".to_owned(),
            kinemark_sim::text::Dimension::Number(2.5),
        )];
        let error = lab.with_parameters(&unknown).unwrap_err();
        assert_eq!(error.to_string(), "lab `x` has no parameter `near`");
    }
}
