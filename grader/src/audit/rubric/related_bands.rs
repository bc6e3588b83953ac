//! Bands that do not fit to each other, or to what they are about: of two checks of one answer, of a path and how much of it counts, of an
//! answer and how exactly computers compute.

use toml::{Table, Value};

use super::{Doubt, Rubric};
use crate::audit::typed;

/// A band that is wider than its sibling's by this factor was typed in another unit.
const WIDER: f64 = 3.0;
/// A body that was put down stands upright to about a degree.
const LEAST_TILT_DEG: f64 = 1.0;
/// Who followed less than this share of a path has not followed it.
const LEAST_COVERAGE: f64 = 0.5;

/// Two right ways to compute an answer differ by rounding: by some 1e-15 of its size, and more where terms cancel.
const ROUNDING: f64 = 1e-9;
/// Differences with the best of steps give a Jacobian to about this share.
const BY_DIFFERENCES: f64 = 1e-7;

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
                    check,
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
            doubts.extend(beyond_limits(check));
            doubts.extend(below_rounding(check));
            doubts.extend(needs_of_another_segment(check, &checks));
        }
    }
}

/// A check as it is typed.
struct Typed<'t> {
    of: String,
    check: &'t Table,
    kind: &'t str,
    keys: &'t Table,
}

impl Typed<'_> {
    fn number(&self, key: &str) -> Option<f64> {
        typed::number(self.keys.get(key)?)
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

/// A joint is at its limit to about this: a contact with a stop, and what a controller is off by \[rad or m\].
const AT_LIMIT: f64 = 0.1;

/// All points for a joint that is well beyond its limit.
fn beyond_limits(check: &Typed<'_>) -> Option<Doubt> {
    let is_of_limits = check.kind == "joint-limits";
    let keys = ["full_rad", "full_m"].into_iter();
    let (key, full) = keys
        .filter_map(|key| Some((key, check.number(key)?)))
        .find(|(_, full)| is_of_limits && *full > AT_LIMIT)?;
    Some(doubt(
        check,
        format!("`{key}` is {full}: a joint that is so far beyond its limit earns all points"),
        "let `full` be 0, or little more",
    ))
}

/// Kinds that judge what a function answers, and may be as good as rounding lets them.
const OF_ANSWERS: [&str; 5] = [
    "fk-error",
    "fk-orientation",
    "ik-reach",
    "jacobian-match",
    "function-cases",
];

/// All points only for an answer that is computed as the engine computes it.
fn below_rounding(check: &Typed<'_>) -> Option<Doubt> {
    if !OF_ANSWERS.contains(&check.kind) {
        return None;
    }
    let (least, words) = match check.kind {
        "jacobian-match" => (
            BY_DIFFERENCES,
            "who computes the Jacobian by differences loses points",
        ),
        _ => (
            ROUNDING,
            "two right ways to compute an answer differ by their rounding",
        ),
    };
    let keys = ["full", "full_m", "full_rad"].into_iter();
    let (key, full) = keys
        .filter_map(|key| Some((key, check.number(key)?)))
        .find(|(_, full)| *full < least)?;
    Some(doubt(
        check,
        format!("`{key}` is {full}: {words}"),
        "widen the band: 1e-6 is near enough to tell right from wrong",
    ))
}

/// A check of one segment of a path that counts once another segment has earned points, while a check of its own segment is there.
fn needs_of_another_segment(check: &Typed<'_>, checks: &[Typed<'_>]) -> Option<Doubt> {
    let segment = |of: &Typed<'_>| of.keys.get("segment").and_then(Value::as_integer);
    let own = segment(check)?;
    let name = |of: &Typed<'_>| typed::name(of.check).to_owned();
    let needs = check.check.get("needs")?.as_array()?;
    let is_needed =
        |other: &&Typed<'_>| needs.iter().any(|need| need.as_str() == Some(&name(other)));
    let others = checks
        .iter()
        .filter(|other| other.is_of_path_of(check) && segment(other).is_some());
    let (needed, free): (Vec<_>, Vec<_>) = others.partition(is_needed);
    let of_own = |other: &&Typed<'_>| segment(other) == Some(own) && other.of != check.of;
    if needed.iter().any(of_own) {
        return None;
    }
    let (wrong, right) = (needed.first()?, free.into_iter().find(of_own)?);
    Some(doubt(
        check,
        format!(
            "it is about segment {own} of the path, and needs `{}`, which is about segment {}",
            name(wrong),
            segment(wrong).unwrap_or_default()
        ),
        &format!("did you mean `{}`?", name(right)),
    ))
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

#[cfg(test)]
mod tests {
    use super::*;

    /// The checks of a task, each a line of TOML behind its name.
    fn doubts(checks: &[&str]) -> Vec<String> {
        let mut text = String::new();
        for (i, check) in checks.iter().enumerate() {
            text += &format!("[[checks]]\nname = \"c{i}\"\n{check}\n");
        }
        let table: Table = text.parse().expect("TOML");
        let checks = typed::tables(&table, "checks");
        let checks: Vec<Typed<'_>> = checks
            .into_iter()
            .map(|check| {
                let (kind, keys) = typed::kind(check).expect("a kind");
                let of = typed::name(check).to_owned();
                Typed {
                    of,
                    check,
                    kind,
                    keys,
                }
            })
            .collect();
        let found = checks.iter().flat_map(|check| {
            let segment = needs_of_another_segment(check, &checks);
            let others = beyond_limits(check).into_iter().chain(segment);
            below_rounding(check).into_iter().chain(others)
        });
        found.map(|doubt| doubt.of).collect()
    }

    #[test]
    fn a_check_that_needs_the_other_segment_is_found() {
        let segments = |needs: &str| {
            doubts(&[
                "path-deviation = { path = \"line\", segment = 1 }",
                "path-deviation = { path = \"line\", segment = 2 }",
                &format!("needs = [{needs}]\npath-speed = {{ path = \"line\", segment = 2 }}"),
            ])
        };
        assert_eq!(segments("\"c0\""), ["c2"]);
        assert_eq!(segments("\"c1\""), [""; 0]);
        assert_eq!(segments("\"c0\", \"c1\""), [""; 0], "both, on purpose");
        // where nothing judges its own segment, another is a gate like any
        let alone = [
            "path-deviation = { path = \"line\", segment = 1 }",
            "needs = [\"c0\"]\npath-speed = { path = \"line\", segment = 2 }",
        ];
        assert_eq!(doubts(&alone), [""; 0]);
    }

    #[test]
    fn a_band_below_rounding_or_differences_is_found() {
        assert_eq!(doubts(&["jacobian-match = { full = 1e-9 }"]), ["c0"]);
        assert_eq!(doubts(&["jacobian-match = { full = 1e-5 }"]), [""; 0]);
        assert_eq!(doubts(&["fk-error = { full_m = 1e-8 }"]), [""; 0]);
        assert_eq!(doubts(&["function-cases = { full = 0.0 }"]), ["c0"]);
        assert_eq!(doubts(&["finish-time = { full_s = 0.0 }"]), [""; 0]);
    }

    #[test]
    fn a_joint_well_beyond_its_limit_is_found() {
        assert_eq!(doubts(&["joint-limits = { full_rad = 0.5 }"]), ["c0"]);
        assert_eq!(doubts(&["joint-limits = { full_rad = 0.0 }"]), [""; 0]);
        assert_eq!(doubts(&["joint-reached = { full_rad = 0.5 }"]), [""; 0]);
    }
}
