//! Numbers with a unit that titles, hints and the brief say, against those of the check, the robot and the scene.

use kinemark_sim::text::Dimension;
use toml::{Table, Value};

use super::times::sentences;
use super::words::doubt;
use super::{Doubt, Rubric};
use crate::audit::quantities::{bare, is_same, stated, typed_at};
use crate::audit::typed;
use crate::lab::{Lab, TaskWork};
use crate::record::quantity::with_unit;
use crate::task::model::MotionTask;

/// A hint whose number is such a power of ten of a band's was typed in another unit, or for another band.
const POWERS: [f64; 6] = [1e-3, 1e-2, 1e-1, 1e1, 1e2, 1e3];
/// What stands before a number that is an end of a band: others may be anything, such as what an example has.
const OF_BANDS: [&str; 8] = [
    "within", "most", "below", "under", "than", "to", "for", "least",
];
/// Masses are rounded in a brief.
const ROUNDED: f64 = 0.02;
/// Numbers that are written as words, from two on.
const COUNTS: [&str; 9] = [
    "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten",
];

/// Looks at the checks, then at the brief.
pub(super) fn rule(rubric: &Rubric<'_>, doubts: &mut Vec<Doubt>) {
    let table = typed::table(rubric.lab).unwrap_or_default();
    for task in typed::tables(&table, "tasks") {
        for check in typed::tables(task, "checks") {
            doubts.extend(of_title(task, check));
            doubts.extend(of_hints(task, check));
        }
    }
    let Some(brief) = rubric.brief else {
        return;
    };
    let typed: Vec<(f64, &str)> = table
        .iter()
        .flat_map(|(key, value)| typed_at(key, value))
        .collect();
    for sentence in sentences(brief) {
        let words: Vec<&str> = sentence.split_whitespace().collect();
        doubts.extend(of_efforts(rubric.lab, &words));
        doubts.extend(of_masses(rubric.lab, &words, &typed));
        doubts.extend(of_ends(rubric.lab, &words));
        doubts.extend(of_counts(rubric.lab, &words));
        doubts.extend(of_keys(rubric.lab, &words));
    }
}

/// The numbers with a unit that a check has at its keys.
fn of_check(check: &Table) -> Vec<(f64, &'static str)> {
    let kinds = check.iter().filter(|(_, value)| value.is_table());
    kinds
        .flat_map(|(kind, value)| typed_at(kind, value))
        .collect()
}

/// The numbers of one unit, in words.
fn listed(numbers: &[(f64, &'static str)], unit: &str) -> String {
    let same = numbers.iter().filter(|(_, known)| *known == unit);
    let words: Vec<String> = same
        .map(|(number, unit)| with_unit(*number, unit))
        .collect();
    words.join(" and ")
}

/// A title that says another number than any of its check.
fn of_title(task: &Table, check: &Table) -> Option<Doubt> {
    let title = check.get("title").and_then(Value::as_str)?;
    let words: Vec<&str> = title.split_whitespace().collect();
    let numbers = of_check(check);
    let other = stated(&words).into_iter().find(|stated| {
        let of_unit = |(_, unit): &&(f64, &str)| *unit == stated.unit;
        let mut known = numbers.iter().filter(of_unit).peekable();
        known.peek().is_some() && !known.any(|(number, _)| is_same(*number, stated.value))
    })?;
    Some(doubt(
        format!("{}/{}", typed::name(task), typed::name(check)),
        format!(
            "\"{title}\" says {}, and the check has {}",
            with_unit(other.value, other.unit),
            listed(&numbers, other.unit)
        ),
        "say in the title what the check measures",
    ))
}

/// A hint whose number is an end of the check's band but for a power of ten.
fn of_hints(task: &Table, check: &Table) -> Option<Doubt> {
    let numbers = of_check(check);
    let hints = check.get("hints").and_then(Value::as_array)?;
    hints.iter().filter_map(Value::as_str).find_map(|hint| {
        let words: Vec<&str> = hint.split_whitespace().collect();
        let (stated, end) = stated(&words).into_iter().find_map(|stated| {
            let before = &words[stated.at.saturating_sub(2)..stated.at];
            if !before.iter().any(|word| OF_BANDS.contains(&bare(word))) {
                return None;
            }
            let known = numbers.iter().filter(|(_, unit)| *unit == stated.unit);
            let known: Vec<f64> = known.map(|(number, _)| *number).collect();
            if known.iter().any(|known| is_same(*known, stated.value)) {
                return None;
            }
            let is_power = |end: &&f64| {
                let powers = POWERS.iter();
                let mut ends = powers.map(|power| power * **end);
                **end != 0.0 && ends.any(|end| is_same(end, stated.value))
            };
            let apart = |end: &f64| (stated.value / end).max(end / stated.value);
            let ends = known.iter().filter(is_power);
            let nearest = ends.min_by(|a, b| apart(a).total_cmp(&apart(b)))?;
            Some((stated, *nearest))
        })?;
        Some(doubt(
            format!("{}/{}", typed::name(task), typed::name(check)),
            format!(
                "a hint says {}, and the check has {}",
                with_unit(stated.value, stated.unit),
                with_unit(end, stated.unit)
            ),
            "write the number of the band in the hint",
        ))
    })
}

/// A limit of efforts that the brief gives a joint, and the servo another.
fn of_efforts(lab: &Lab, words: &[&str]) -> Option<Doubt> {
    let is_of_limit = |word: &&str| ["most", "limit", "limits", "limited"].contains(&bare(word));
    if !words.iter().any(is_of_limit) {
        return None;
    }
    stated(words).into_iter().find_map(|stated| {
        if !["N m", "N"].contains(&stated.unit) {
            return None;
        }
        let [at, the, joint] = words.get(stated.at + stated.words..)?.first_chunk()?;
        if *at != "at" || *the != "the" {
            return None;
        }
        let joint = bare(joint);
        let limits = motions(lab).filter_map(|(lab, motion)| {
            let mut joints = lab.robot.moving_joints();
            let entry = joints.position(|known| known.name == joint)?;
            Some(motion.servo.gains.get(entry)?.effort_limit)
        });
        let limits: Vec<f64> = limits.collect();
        let is_limit = limits.iter().any(|limit| is_same(*limit, stated.value));
        (!limits.is_empty() && !is_limit).then(|| {
            doubt(
                format!("effort_limit of {joint}"),
                format!(
                    "the brief says {}, and the servo has {}",
                    with_unit(stated.value, stated.unit),
                    with_unit(limits[0], stated.unit)
                ),
                "write the limit of the servo in the brief",
            )
        })
    })
}

fn motions(lab: &Lab) -> impl Iterator<Item = (&Lab, &MotionTask)> {
    lab.tasks.iter().filter_map(|task| match &task.work {
        TaskWork::Motion(motion, _) => Some((lab.of_task(task), &**motion)),
        TaskWork::Function(..) => None,
    })
}

/// A number right behind a key of the target, such as `` `max_rate`, 0.5 rad/s ``, that no target has.
fn of_keys(lab: &Lab, words: &[&str]) -> Option<Doubt> {
    stated(words).into_iter().find_map(|stated| {
        let before = words.get(stated.at.checked_sub(1)?)?;
        let code = before.strip_prefix('`')?.trim_end_matches([',', ':', ';']);
        let code = code.strip_suffix('`')?;
        let key = code.rsplit('.').next()?;
        let given = motions(lab).filter_map(|(_, motion)| motion.target_number(key));
        let given: Vec<f64> = given.collect();
        let is_near = |given: &f64| (given - stated.value).abs() <= 0.005 * given.abs();
        (!given.is_empty() && !given.iter().any(is_near)).then(|| {
            let given: Vec<String> = given.iter().map(f64::to_string).collect();
            doubt(
                format!("target.{key}"),
                format!(
                    "the brief says {}, lab.toml {}",
                    with_unit(stated.value, stated.unit),
                    given.join(" and ")
                ),
                "write the same number, with a mark where it differs from student to student",
            )
        })
    })
}

/// A mass in the brief that nothing has.
fn of_masses(lab: &Lab, words: &[&str], typed: &[(f64, &str)]) -> Option<Doubt> {
    let masses = stated(words)
        .into_iter()
        .filter(|stated| stated.unit == "kg");
    let mut masses = masses.peekable();
    masses.peek()?;
    let mut known: Vec<f64> = typed
        .iter()
        .filter(|(_, unit)| *unit == "kg")
        .map(|(mass_kg, _)| *mass_kg)
        .collect();
    let labs = lab.tasks.iter().map(|task| lab.of_task(task));
    for robot in labs.chain([lab]).map(|lab| &lab.robot) {
        known.extend(robot.links().iter().map(|link| link.inertia.mass_kg));
        known.push(robot.mass_kg());
    }
    let bodies = lab.scenes.iter().flat_map(|scene| &scene.scene.bodies);
    let of_tasks = motions(lab).filter_map(|(_, motion)| motion.scene.as_ref());
    let of_tasks = of_tasks.flat_map(|scene| &scene.scene.bodies);
    known.extend(bodies.chain(of_tasks).map(|body| body.inertia.mass_kg));
    // a mass may be a number of the lab's own
    known.extend(lab.parameters.iter().filter_map(|(_, value)| match value {
        Dimension::Number(number) => Some(*number),
        _ => None,
    }));
    let is_known = |mass_kg: f64| {
        known
            .iter()
            .any(|known| (known - mass_kg).abs() <= ROUNDED * known.abs())
    };
    let other = masses.find(|stated| !is_known(stated.value))?;
    Some(doubt(
        format!("{} kg", other.number),
        "the brief says so, and neither a link, nor a body, nor lab.toml has such a mass"
            .to_owned(),
        "write the mass of the robot file, of the scene or of lab.toml",
    ))
}

/// The first and the last piece of a path that do not count.
fn of_ends(lab: &Lab, words: &[&str]) -> Option<Doubt> {
    let at = words.windows(3).position(|words| {
        let words = words.iter().map(|word| bare(word));
        words.eq(["first", "and", "last"])
    })?;
    let piece = stated(&words[at..]).into_iter().next()?;
    if piece.unit != "m" || piece.at > 4 {
        return None;
    }
    let paths = motions(lab).flat_map(|(_, motion)| &motion.paths);
    let trims: Vec<f64> = paths.map(|path| path.trim_m).collect();
    let is_trim = trims.iter().any(|trim_m| is_same(*trim_m, piece.value));
    (!trims.is_empty() && !is_trim).then(|| {
        doubt(
            "trim_m".to_owned(),
            format!(
                "the brief says that the first and last {} do not count, and paths have a `trim_m` of {}",
                with_unit(piece.value, "m"),
                with_unit(trims[0], "m")
            ),
            "write the same in the brief and in `trim_m`",
        )
    })
}

/// As many goals or places as no task has.
fn of_counts(lab: &Lab, words: &[&str]) -> Option<Doubt> {
    let counts: Vec<usize> = motions(lab)
        .map(|(_, motion)| motion.goals.len())
        .filter(|count| *count > 0)
        .collect();
    let said = words.windows(2).find_map(|pair| {
        let is_of_goals = ["goals", "places"].contains(&bare(pair[1]));
        let word = bare(pair[0]).to_lowercase();
        let count = COUNTS.iter().position(|known| *known == word);
        let count = count.map(|index| index + 2).or(word.parse().ok());
        is_of_goals.then_some((count?, pair))
    });
    let (_, pair) = said.filter(|(count, _)| !counts.is_empty() && !counts.contains(count))?;
    Some(doubt(
        "goals".to_owned(),
        format!(
            "the brief says \"{} {}\", and tasks have {}",
            pair[0],
            bare(pair[1]),
            counts
                .iter()
                .map(usize::to_string)
                .collect::<Vec<_>>()
                .join(" and ")
        ),
        "say in the brief how many goals there are",
    ))
}
