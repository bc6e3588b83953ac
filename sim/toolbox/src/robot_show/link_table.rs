//! The tree as a table: a link a line, with the joint that moves it.

use kinemark_sim::model::robot::{Joint, JointKind, Robot};
use kinemark_sim::text::number::short;
use nalgebra::Vector3;

use super::link_tree::{Branch, branches};
use crate::styled_text::{Emphasis, StyledText};

const HEADS: [&str; 8] = [
    "link", "kg", "joint", "q", "type", "limits", "speed", "effort",
];

/// A page \[characters\].
pub(super) const WIDEST: usize = 100;

/// Three numbers with commas.
pub(super) fn triple(values: &[f64; 3]) -> String {
    values.map(short).join(", ")
}

/// The whole table, with a line end after each row; empty columns are left out, and what a page has no room for.
pub(super) fn table(robot: &Robot) -> StyledText {
    let all = 0..HEADS.len();
    let short = 0..HEADS.len() - 2;
    let whole = columns_of(robot, true, all.clone());
    if whole.width <= WIDEST {
        return whole.text;
    }
    let flat = columns_of(robot, false, all);
    if flat.width <= WIDEST {
        return flat.text;
    }
    columns_of(robot, false, short).text
}

/// A table with some of the columns.
struct Table {
    text: StyledText,
    /// \[characters\].
    width: usize,
}

fn columns_of(robot: &Robot, stairs: bool, columns: std::ops::Range<usize>) -> Table {
    let branches = branches(robot, stairs);
    let rows: Vec<[String; 8]> = branches.iter().map(|branch| row(robot, branch)).collect();
    let shown: Vec<usize> = columns
        .filter(|&c| c == 0 || rows.iter().any(|row| !row[c].is_empty()))
        .collect();
    let width = |c: usize| {
        let cells = rows.iter().map(|row| row[c].chars().count());
        cells.max().unwrap_or(0).max(HEADS[c].chars().count())
    };
    let mut text = StyledText::default();
    let head: Vec<String> = shown.iter().map(|&c| padded(HEADS[c], width(c))).collect();
    text.push(Emphasis::Faint, head.join("  ").trim_end());
    text.plain("\n");
    for row in &rows {
        let cells: Vec<String> = shown.iter().map(|&c| padded(&row[c], width(c))).collect();
        text.plain(format!("{}\n", cells.join("  ").trim_end()));
    }
    let width = shown.iter().map(|&c| width(c) + 2).sum::<usize>() - 2;
    Table { text, width }
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
        short(mass_kg)
    };
    let name = format!("{}{}", branch.lines, link.name);
    let Some(joint) = branch.joint.map(|j| &robot.joints()[j]) else {
        let mut cells: [String; 8] = Default::default();
        (cells[0], cells[1]) = (name, mass);
        return cells;
    };
    let unit = if joint.kind.turns() { "rad" } else { "m" };
    let of = |limit: Option<f64>, unit: &str| {
        limit.map_or_else(String::new, |limit| format!("{} {unit}", short(limit)))
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
        (Some(low), None) => format!("from {} {unit}", short(low)),
        (None, Some(high)) => format!("to {} {unit}", short(high)),
        (Some(low), Some(high)) => format!("{} .. {} {unit}", short(low), short(high)),
    }
}
