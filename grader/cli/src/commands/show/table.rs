//! The tree as a table: a link a line, with the joint that moves it.

use std::fmt::Write as _;

use kinemark_sim::robot::{Joint, JointKind, Robot};
use nalgebra::Vector3;
use owo_colors::OwoColorize as _;

use super::tree::{Branch, branches};

const HEADS: [&str; 8] = [
    "link", "kg", "joint", "q", "type", "limits", "speed", "effort",
];

/// A page \[characters\].
pub(super) const WIDEST: usize = 100;

/// A number with four digits that matter.
pub(super) fn number(value: f64) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    let size = value.abs();
    if !(1e-3..1e6).contains(&size) {
        let text = format!("{value:.3e}");
        let (mantissa, exponent) = text.split_once('e').unwrap_or((&text, "0"));
        return format!("{}e{exponent}", trimmed(mantissa));
    }
    // digits before the point take from those after it
    let whole = [1.0, 10.0, 100.0, 1000.0]
        .iter()
        .filter(|power| size >= **power)
        .count();
    let decimals = 4 - whole;
    trimmed(&format!("{value:.decimals$}")).to_owned()
}

fn trimmed(text: &str) -> &str {
    if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.')
    } else {
        text
    }
}

/// Three numbers with commas.
pub(super) fn triple(values: &[f64; 3]) -> String {
    values.map(number).join(", ")
}

/// The whole table, with a line end after each row; columns that say nothing are left out, and what a page has no room for.
pub(super) fn table(robot: &Robot) -> String {
    let all = 0..HEADS.len();
    let short = 0..HEADS.len() - 2;
    let whole = drawn(robot, true, all.clone());
    if whole.width <= WIDEST {
        return whole.text;
    }
    let flat = drawn(robot, false, all);
    if flat.width <= WIDEST {
        return flat.text;
    }
    drawn(robot, false, short).text
}

struct Drawn {
    text: String,
    width: usize,
}

fn drawn(robot: &Robot, stairs: bool, columns: std::ops::Range<usize>) -> Drawn {
    let branches = branches(robot, stairs);
    let rows: Vec<[String; 8]> = branches.iter().map(|branch| row(robot, branch)).collect();
    let shown: Vec<usize> = columns
        .filter(|&c| c == 0 || rows.iter().any(|row| !row[c].is_empty()))
        .collect();
    let width = |c: usize| {
        let cells = rows.iter().map(|row| row[c].chars().count());
        cells.max().unwrap_or(0).max(HEADS[c].chars().count())
    };
    let mut text = String::new();
    let head: Vec<String> = shown.iter().map(|&c| padded(HEADS[c], width(c))).collect();
    let _ = writeln!(text, "{}", head.join("  ").trim_end().dimmed());
    for row in &rows {
        let cells: Vec<String> = shown.iter().map(|&c| padded(&row[c], width(c))).collect();
        text.push_str(cells.join("  ").trim_end());
        text.push('\n');
    }
    let width = shown.iter().map(|&c| width(c) + 2).sum::<usize>() - 2;
    Drawn { text, width }
}

fn padded(text: &str, width: usize) -> String {
    format!("{text:<width$}")
}

fn row(robot: &Robot, branch: &Branch) -> [String; 8] {
    let link = &robot.links()[branch.link];
    let mass_kg = link.inertia.mass_kg;
    let mass = if mass_kg == 0.0 {
        String::new()
    } else {
        number(mass_kg)
    };
    let name = format!("{}{}", branch.lines, link.name);
    let Some(joint) = branch.joint.map(|j| &robot.joints()[j]) else {
        let mut cells: [String; 8] = Default::default();
        (cells[0], cells[1]) = (name, mass);
        return cells;
    };
    let unit = if joint.kind.turns() { "rad" } else { "m" };
    let of = |limit: Option<f64>, unit: &str| {
        limit.map_or_else(String::new, |limit| format!("{} {unit}", number(limit)))
    };
    [
        name,
        mass,
        joint.name.clone(),
        entry(robot, joint),
        kind(joint),
        range(joint, unit),
        of(joint.limits.speed, &format!("{unit}/s")),
        of(
            joint.limits.effort,
            if joint.kind.turns() { "N m" } else { "N" },
        ),
    ]
}

/// Its entry of `q`, and whether that is free.
fn entry(robot: &Robot, joint: &Joint) -> String {
    if joint.mimic.is_some() {
        return "mimic".to_owned();
    }
    match robot
        .moving_joints()
        .position(|other| other.name == joint.name)
    {
        Some(i) if robot.dependent().contains(&i) => format!("{i} loop"),
        Some(i) => i.to_string(),
        None => String::new(),
    }
}

/// Its type, and its axis unless that is z.
fn kind(joint: &Joint) -> String {
    let name = joint.kind.name();
    if joint.kind == JointKind::Fixed || joint.axis == Vector3::z() {
        return name.to_owned();
    }
    let letters = [
        ("x", Vector3::x()),
        ("y", Vector3::y()),
        ("z", Vector3::z()),
    ];
    for (letter, axis) in letters {
        if joint.axis == axis {
            return format!("{name} {letter}");
        }
        if joint.axis == -axis {
            return format!("{name} -{letter}");
        }
    }
    format!("{name} ({})", triple(&joint.axis.into()))
}

fn range(joint: &Joint, unit: &str) -> String {
    match (joint.limits.lower, joint.limits.upper) {
        (None, None) => String::new(),
        (Some(low), None) => format!("from {} {unit}", number(low)),
        (None, Some(high)) => format!("to {} {unit}", number(high)),
        (Some(low), Some(high)) => format!("{} .. {} {unit}", number(low), number(high)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short_and_lose_nothing_that_matters() {
        for (value, text) in [
            (0.0, "0"),
            (-2.0, "-2"),
            (0.5, "0.5"),
            (1.234_56, "1.235"),
            (12.345_6, "12.35"),
            (1234.56, "1235"),
            (99.999_9, "100"),
            (0.012_345, "0.0123"),
            (0.000_012_345, "1.234e-5"),
            (12_345_678.0, "1.235e7"),
            (-1e-9, "-1e-9"),
        ] {
            assert_eq!(number(value), text);
        }
    }
}
