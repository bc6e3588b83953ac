//! Bands that do not fit to each other, or to what they are about: of two checks of one answer, of a path and how much of it counts.

use toml::Table;

use super::{Doubt, Rubric};
use crate::audit::typed;

/// A band that is wider than its sibling's by this factor was typed in another unit.
const WIDER: f64 = 3.0;
/// A body that was put down stands upright to about a degree.
const LEAST_TILT_DEG: f64 = 1.0;
/// Who followed less than this share of a path has not followed it.
const LEAST_COVERAGE: f64 = 0.5;

/// Looks at the checks of every task.
pub(super) fn rule(rubric: &Rubric<'_>, doubts: &mut Vec<Doubt>) {
    let table = typed::table(rubric.lab).unwrap_or_default();
    for task in typed::tables(&table, "tasks") {
        let checks: Vec<Typed<'_>> = typed::tables(task, "checks")
            .into_iter()
            .filter_map(|check| {
                let (kind, keys) = typed::kind(check)?;
                Some(Typed {
                    of: format!("{}/{}", typed::name(task), typed::name(check)),
                    kind,
                    keys,
                })
            })
            .collect();
        for check in &checks {
            doubts.extend(wider_branches(check, &checks));
            doubts.extend(little_coverage(check));
            doubts.extend(wide_gate(check, &checks));
            doubts.extend(narrow_tilt(check));
        }
    }
}

/// A check as it is typed.
struct Typed<'t> {
    of: String,
    kind: &'t str,
    keys: &'t Table,
}

impl Typed<'_> {
    fn number(&self, key: &str) -> Option<f64> {
        let value = self.keys.get(key)?;
        value
            .as_float()
            .or_else(|| value.as_integer().map(|x| x as f64))
    }

    fn is_of_path_of(&self, other: &Self) -> bool {
        self.keys.get("path").is_some() && self.keys.get("path") == other.keys.get("path")
    }
}

fn doubt(of: &Typed<'_>, what: String, help: &str) -> Doubt {
    Doubt {
        rule: "band",
        of: of.of.clone(),
        what,
        help: help.to_owned(),
    }
}

/// Branches that may be much farther off than the one that has to reach.
fn wider_branches(check: &Typed<'_>, checks: &[Typed<'_>]) -> Option<Doubt> {
    let full_m = check
        .number("full_m")
        .filter(|_| check.kind == "ik-branches")?;
    let reach = checks.iter().find(|other| other.kind == "ik-reach")?;
    let reach_m = reach.number("full_m")?;
    (full_m > WIDER * reach_m).then(|| {
        doubt(
            check,
            format!(
                "a branch may be {full_m} m off, and `{}` gives all points up to {reach_m} m",
                reach.of
            ),
            "judge both by the same distance: it is the same answer",
        )
    })
}

/// All points for less than half of a path.
fn little_coverage(check: &Typed<'_>) -> Option<Doubt> {
    let full = check
        .number("full")
        .filter(|_| check.kind == "path-coverage")?;
    (full < LEAST_COVERAGE).then(|| {
        doubt(
            check,
            format!("all points for {full} of the path: who leaves out most of it has them"),
            "raise `full`: it is a share, 1 for the whole path",
        )
    })
}

/// An angle that is to be met by less than a hand can.
fn narrow_tilt(check: &Typed<'_>) -> Option<Doubt> {
    let keys = ["upright_deg", "turned_within_deg"].into_iter();
    let (key, angle_deg) = keys
        .filter_map(|key| Some((key, check.number(key)?)))
        .find(|(_, angle_deg)| *angle_deg < LEAST_TILT_DEG)?;
    Some(doubt(
        check,
        format!("`{key}` is {angle_deg} degrees, less than any body stands still by"),
        "is the number in degrees? A few of them are usual",
    ))
}

/// A path that counts as covered from farther away than anything near it earns a point.
fn wide_gate(check: &Typed<'_>, checks: &[Typed<'_>]) -> Option<Doubt> {
    let within_m = check.number("within_m")?;
    let near = checks
        .iter()
        .filter(|other| other.kind == "path-deviation" && other.is_of_path_of(check));
    let zero_m = near
        .filter_map(|other| other.number("zero_m"))
        .reduce(f64::max)?;
    (within_m > WIDER * zero_m).then(|| {
        doubt(
            check,
            format!("what is within {within_m} m of the path counts, and at {zero_m} m nothing is earned for its deviation"),
            "let `within_m` be of the size of the deviation that still earns points",
        )
    })
}
