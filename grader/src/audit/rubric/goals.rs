//! Goals of a run that a hand cannot tell apart, stays of a moment, targets that are nearly the path that checks follow, and targets that are
//! not where the body of their name is.

use kinemark_sim::kinematics::forward_kinematics;
use nalgebra::Vector3;
use toml::Table;

use super::{Doubt, Rubric};
use crate::audit::typed;
use crate::lab::{Lab, Task, TaskWork};
use crate::record::quantity::with_unit;
use crate::task::model::{Band, MotionTask};
use crate::task::tcp::tcp_in;
use crate::task::value::Value;
use crate::task::watched::PathToFollow;
use kinemark_sim::text::number::list;

/// Who is given a point of a body is given it to this \[m\].
const BESIDE_M: f64 = 1e-3;
/// A stay of fewer control periods is none: a hand that passes by is there as long.
const SHORTEST_STAY: f64 = 3.0;

/// Looks at every motion task.
pub(super) fn rule(rubric: &Rubric<'_>, doubts: &mut Vec<Doubt>) {
    let table = typed::table(rubric.lab).unwrap_or_default();
    for task in &rubric.lab.tasks {
        let TaskWork::Motion(motion, judged) = &task.work else {
            continue;
        };
        let typed = typed::named(&table, "tasks", &task.name);
        let checks = typed.map_or(Vec::new(), |typed| typed::tables(typed, "checks"));
        let reached = judged.iter().find_map(|check| {
            let typed = checks
                .iter()
                .find(|typed| typed::name(typed) == check.name)?;
            let (kind, _) = typed::kind(typed)?;
            let (band, _) = check.kind.band()?;
            (kind == "pose-reached").then_some((check.name.as_str(), band))
        });
        doubts.extend(reached.and_then(|check| near_start(rubric.lab, task, motion, check)));
        doubts.extend(reached.and_then(|check| near_goals(task, motion, check)));
        doubts.extend(short_stays(task, motion, &checks));
        doubts.extend(other_target(task, motion));
        doubts.extend(other_body(rubric.lab, task, motion));
        doubts.extend(trimmed_away(task, motion));
    }
    at_corners(rubric.lab, doubts);
}

/// Targets that are right with the lab's own numbers, and not at the ends of what students draw: one of the two does not vary.
fn at_corners(lab: &Lab, doubts: &mut Vec<Doubt>) {
    // the first two have every number at an end
    let corners = lab.corners().unwrap_or_default().into_iter().take(2);
    for corner in corners {
        let numbers: Vec<_> = corner
            .variant
            .parameters()
            .map(|(name, value)| (name.to_owned(), value.clone()))
            .collect();
        // one that cannot be loaded is found where the solution is tried in it
        let Ok(lab) = lab.with_parameters(&numbers) else {
            continue;
        };
        for task in &lab.tasks {
            let TaskWork::Motion(motion, _) = &task.work else {
                continue;
            };
            let found = other_target(task, motion).or_else(|| other_body(&lab, task, motion));
            if let Some(found) = found.filter(|found| doubts.iter().all(|d| d.of != found.of)) {
                let what = format!("with {}, {}", corner.words, found.what);
                doubts.push(Doubt { what, ..found });
            }
        }
    }
}

fn doubt(of: String, what: String, help: &str) -> Doubt {
    Doubt {
        rule: "goals",
        of,
        what,
        help: help.to_owned(),
    }
}

/// Two goals in a row, the second of which earns points where the first is.
fn near_goals(task: &Task, motion: &MotionTask, (check, band): (&str, Band)) -> Option<Doubt> {
    let pairs = motion.goals.windows(2).enumerate();
    let apart = pairs.filter_map(|(i, goals)| {
        // at one place, the hand may have to turn
        let turns = goals.iter().any(|goal| goal.orientation.is_some());
        let apart_m = (goals[1].position_m - goals[0].position_m).norm();
        (!turns && apart_m < band.zero).then_some((i, apart_m))
    });
    let (i, apart_m) = apart.min_by(|a, b| a.1.total_cmp(&b.1))?;
    Some(doubt(
        format!("{}/goal {}", task.name, i + 2),
        format!(
            "it is {} from the goal before it, and check `{check}` gives points up to {}: who stays there earns some here",
            with_unit(apart_m, "m"),
            with_unit(band.zero, "m")
        ),
        "narrow the band, or move the goals apart",
    ))
}

/// A first goal at which the arm starts: who never moves earns something.
fn near_start(
    lab: &Lab,
    task: &Task,
    motion: &MotionTask,
    (check, band): (&str, Band),
) -> Option<Doubt> {
    let goal = motion.goals.first()?;
    let lab = lab.of_task(task);
    let start = tcp_in(&lab.robot, &lab.frame, &motion.start_q)?;
    let apart_m = (goal.position_m - start).norm();
    (goal.orientation.is_none() && apart_m < band.zero).then(|| {
        doubt(
            format!("{}/goal 1", task.name),
            format!(
                "the arm starts {} from it, and check `{check}` gives points up to {}: who never moves earns some",
                with_unit(apart_m, "m"),
                with_unit(band.zero, "m")
            ),
            "let the arm start elsewhere, or move the goal",
        )
    })
}

/// Goals and bodies that count as held in a moment.
fn short_stays(task: &Task, motion: &MotionTask, checks: &[&Table]) -> Vec<Doubt> {
    let period_s = motion.periods.control_s();
    let least_s = SHORTEST_STAY * period_s;
    let is_moment = |stay_s: f64| stay_s > 0.0 && stay_s < least_s * (1.0 - 1e-9);
    let said = |of: String, key: &str, stay_s: f64| {
        doubt(
            of,
            format!(
                "`{key}` is {stay_s} s, less than {SHORTEST_STAY} control periods of {period_s} s: what passes by counts as a stay"
            ),
            "ask for a longer stay",
        )
    };
    let goals = motion.goals.iter().enumerate();
    let goals = goals.filter_map(|(i, goal)| {
        let stay_s = motion.periods.time_s(goal.dwell_ticks);
        let of = format!("{}/goal {}", task.name, i + 1);
        is_moment(stay_s).then(|| said(of, "dwell_s", stay_s))
    });
    let held = checks.iter().filter_map(|check| {
        let (_, kind) = typed::kind(check)?;
        let stay_s = kind.get("hold_s").and_then(toml::Value::as_float)?;
        let of = format!("{}/{}", task.name, typed::name(check));
        is_moment(stay_s).then(|| said(of, "hold_s", stay_s))
    });
    goals.take(1).chain(held).collect()
}

/// A point in the target that is called as a body of the scene, and is beside it. Above or below it may be on purpose: its top, its foot.
fn other_body(lab: &Lab, task: &Task, motion: &MotionTask) -> Option<Doubt> {
    let Value::Map(entries) = &motion.target else {
        return None;
    };
    let lab = lab.of_task(task);
    let (robot, scene) = (&lab.robot, motion.scene.as_ref()?);
    let poses = forward_kinematics(robot, &robot.positions(&motion.start_q).ok()?);
    let world_from_lab = poses.world_from(robot.frame(&lab.frame)?);
    entries.iter().find_map(|(key, value)| {
        let body = scene.scene.bodies.iter().find(|body| body.name == *key)?;
        let Value::List(numbers) = value else {
            return None;
        };
        let numbers = numbers.iter().map(|number| match number {
            Value::Number(number) => Some(*number),
            _ => None,
        });
        let [x, y, z] = numbers.collect::<Option<Vec<f64>>>()?.try_into().ok()?;
        let given = world_from_lab * nalgebra::Point3::new(x, y, z);
        let is = body.world_from_body.translation.vector;
        let off = given.coords - is;
        let beside_m = match kinemark_sim::spatial::direction(motion.gravity_m_s2) {
            Some(down) => (off - down * off.dot(&down)).norm(),
            None => off.norm(),
        };
        let is = world_from_lab.inverse() * nalgebra::Point3::from(is);
        (beside_m > BESIDE_M).then(|| {
            doubt(
                format!("{}/{key}", task.name),
                format!(
                    "students are given `{key}` at {}, and the body `{key}` stands at {}",
                    list(&[x, y, z]),
                    list(is.coords.as_slice())
                ),
                "write both from the same parameters, or call the key otherwise",
            )
        })
    })
}

/// A path of which more than half does not count.
fn trimmed_away(task: &Task, motion: &MotionTask) -> Option<Doubt> {
    motion.paths.iter().find_map(|path| {
        let segments = path.points_m.windows(2);
        let shortest_m = segments
            .map(|ends| (ends[1] - ends[0]).norm())
            .reduce(f64::min)?;
        let judged_m = shortest_m - 2.0 * path.trim_m;
        (judged_m < 0.5 * shortest_m).then(|| {
            doubt(
                format!("{}/{}", task.name, path.name),
                format!(
                    "`trim_m` leaves {} of a segment of {}: most of it does not count",
                    with_unit(judged_m.max(0.0), "m"),
                    with_unit(shortest_m, "m")
                ),
                "lower `trim_m`: it is taken away at either end of each segment",
            )
        })
    })
}

/// A list of points in the target that is a path but for a few numbers.
fn other_target(task: &Task, motion: &MotionTask) -> Option<Doubt> {
    let Value::Map(entries) = &motion.target else {
        return None;
    };
    entries.iter().find_map(|(key, value)| {
        let points = points_of(value)?;
        let is_path = |path: &&PathToFollow| differing(&points, path) == Some(0);
        if motion.paths.iter().any(|path| is_path(&path)) {
            return None;
        }
        let path = motion.paths.iter().find(|path| {
            // two thirds are the same: it is meant to be this one
            let numbers = points.iter().flatten().count();
            differing(&points, path).is_some_and(|differing| 3 * differing <= numbers)
        })?;
        let at = points
            .iter()
            .zip(&path.points_m)
            .position(|(given, point)| !is_same(given, point))?;
        Some(doubt(
            format!("{}/{key}", task.name),
            format!(
                "students are given point {} at {:?}, and checks follow path `{}`, which has it at {:?}",
                at + 1,
                points[at],
                path.name,
                path.points_m[at].as_slice()
            ),
            "write both from the same parameters: `points_m = [\"= from\", ...]`",
        ))
    })
}

/// A list of points of two or three numbers.
fn points_of(value: &Value) -> Option<Vec<Vec<f64>>> {
    let Value::List(points) = value else {
        return None;
    };
    let point = |value: &Value| -> Option<Vec<f64>> {
        let Value::List(numbers) = value else {
            return None;
        };
        let numbers = numbers.iter().map(|number| match number {
            Value::Number(number) => Some(*number),
            _ => None,
        });
        numbers.collect()
    };
    let points: Vec<Vec<f64>> = points.iter().map(point).collect::<Option<_>>()?;
    let fits = points.iter().all(|point| (2..=3).contains(&point.len()));
    (fits && points.len() > 1).then_some(points)
}

/// How many numbers of `points` are not those of `path`; `None` where it has more points or fewer.
fn differing(points: &[Vec<f64>], path: &PathToFollow) -> Option<usize> {
    (points.len() == path.points_m.len()).then(|| {
        let pairs = points.iter().zip(&path.points_m);
        let numbers = pairs.flat_map(|(given, point)| given.iter().zip(point.iter()));
        numbers.filter(|(a, b)| !is_near(**a, **b)).count()
    })
}

fn is_same(given: &[f64], point: &Vector3<f64>) -> bool {
    given.iter().zip(point.iter()).all(|(a, b)| is_near(*a, *b))
}

fn is_near(a: f64, b: f64) -> bool {
    (a - b).abs() <= 1e-9
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_are_compared_with_a_path_of_as_many() {
        let path = PathToFollow {
            name: "line".to_owned(),
            points_m: vec![Vector3::new(1.0, 2.0, 0.5), Vector3::new(1.0, 3.0, 0.5)],
            trim_m: 0.1,
        };
        // in the plane, the third number is the lab's
        assert_eq!(differing(&[vec![1.0, 2.0], vec![1.0, 3.2]], &path), Some(1));
        assert_eq!(differing(&[vec![1.0, 2.0]], &path), None);
        let number = Value::Number;
        let list = Value::List(vec![
            Value::List(vec![number(1.0), number(2.0)]),
            Value::List(vec![number(1.0), number(3.0)]),
        ]);
        assert_eq!(points_of(&list), Some(vec![vec![1.0, 2.0], vec![1.0, 3.0]]));
        assert_eq!(points_of(&number(1.0)), None);
    }
}
