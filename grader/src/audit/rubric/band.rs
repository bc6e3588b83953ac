//! Bands in which nobody can lose, and bands in which the reference solution has hardly any room.

use std::f64::consts::PI;

use kinemark_sim::kinematics::workspace::sample_workspace;
use nalgebra::Vector3;

use super::{Doubt, Rubric};
use crate::audit::typed;
use crate::audit::variants::{NOT_SPENT, is_thin};
use crate::lab::{Lab, Task, TaskWork};
use crate::record::grade::Measure;
use crate::record::quantity::{with_unit, with_unit_unlike};
use crate::task::model::{Band, MotionTask};

/// A distance of this share of the workspace is no precision any more.
const SHARE_OF_REACH: f64 = 0.25;
/// The same of an angle \[rad\]: an eighth of a turn.
const WIDE_RAD: f64 = std::f64::consts::FRAC_PI_4;
/// A task may use at least so many times the operations of the reference solution.
const LEAST_BUDGET: u64 = 3;
/// Points of the workspace.
const SAMPLES: usize = 2000;

/// Bands whose end of full points nobody can miss.
pub(super) fn rule(rubric: &Rubric<'_>, doubts: &mut Vec<Doubt>) {
    let of_lab = reach_m(rubric.lab);
    let joints = TypedJoints::of(rubric.lab);
    for task in &rubric.lab.tasks {
        let reach_m = task.own.as_deref().map_or(of_lab, reach_m);
        match &task.work {
            TaskWork::Function(_, checks) => {
                for check in checks {
                    if let Some(band) = check.kind.band() {
                        let size = (reach_m, joints.is_of_turning(task, &check.name));
                        doubts.extend(doubt(task, &check.name, band, (None, None), size));
                    }
                }
            }
            TaskWork::Motion(motion, checks) => {
                for check in checks {
                    if joints.is_of_one_way(task, &check.name) && !motion.goals.is_empty() {
                        doubts.push(of_one_way(task, &check.name));
                    }
                    let joint = joints.joint(task, &check.name);
                    let band = check.kind.band();
                    let band = band.or_else(|| of_reference(rubric, &task.name, &check.name));
                    if let Some(band) = band {
                        doubts.extend(doubt(
                            task,
                            &check.name,
                            band,
                            (Some(motion), joint),
                            (reach_m, joints.is_of_turning(task, &check.name)),
                        ));
                    }
                }
            }
        }
    }
}

/// The joints that checks name in lab.toml.
struct TypedJoints<'a> {
    lab: &'a Lab,
    table: toml::Table,
}

impl<'a> TypedJoints<'a> {
    fn of(lab: &'a Lab) -> Self {
        let table = typed::table(lab).unwrap_or_default();
        Self { lab, table }
    }

    /// The kind of a check with its keys.
    fn kind(&self, task: &Task, check: &str) -> Option<(&str, &toml::Table)> {
        let typed = typed::named(&self.table, "tasks", &task.name)?;
        typed::kind(typed::named(typed, "checks", check)?)
    }

    /// Whether a check measures how the TCP is turned.
    fn is_of_turning(&self, task: &Task, check: &str) -> bool {
        let kind = self.kind(task, check);
        kind.is_some_and(|(kind, _)| kind.contains("orientation"))
    }

    /// Whether a check compares the whole way with that of the reference solution, in a task that asks for no path.
    fn is_of_one_way(&self, task: &Task, check: &str) -> bool {
        let over = self
            .kind(task, check)
            .filter(|(kind, _)| *kind == "trajectory-match");
        let over = over.and_then(|(_, keys)| keys.get("over")?.as_str());
        let typed = typed::named(&self.table, "tasks", &task.name);
        let motion = typed.and_then(|task| task.get("motion"));
        over == Some("run") && motion.is_some_and(|motion| motion.get("paths").is_none())
    }

    /// The entry of the joint that a check reads, if it reads one.
    fn joint(&self, task: &Task, check: &str) -> Option<usize> {
        let (_, kind) = self.kind(task, check)?;
        let name = kind.get("joint")?.as_str()?;
        let mut joints = self.lab.of_task(task).robot.moving_joints();
        joints.position(|joint| joint.name == name)
    }
}

fn of_one_way(task: &Task, check: &str) -> Doubt {
    Doubt {
        rule: "band",
        of: format!("{}/{check}", task.name),
        what: "it compares the whole way with the reference solution's, and the goals leave the way free: another branch or another pace loses the points"
            .to_owned(),
        help: "compare the stays alone, `over = \"dwells\"`, or give the task a path".to_owned(),
    }
}

/// A band that depends on the reference solution, with what that reaches.
fn of_reference(rubric: &Rubric<'_>, task: &str, check: &str) -> Option<(Band, &'static str)> {
    let mut tasks = rubric.reference?.tasks.iter();
    let graded = tasks.find(|known| known.name == task)?;
    let graded = graded.checks.iter().find(|known| known.name == check)?;
    let measure = graded.measure.as_ref()?;
    measure.reference?;
    let units = ["s", "m", "rad", "N m", "N", "N m or N", ""];
    let unit = units.into_iter().find(|unit| *unit == measure.unit)?;
    let (full, zero) = (measure.full, measure.zero);
    Some((Band { full, zero }, unit))
}

/// A value may be so many times what the reference solution reaches, and still earn everything.
const FAR_ABOVE: f64 = 100.0;

/// Units in which what is as good as can be has no size: a distance, an angle, a share.
const WITH_A_BEST: [&str; 7] = ["m", "rad", "s", "", "N m", "N", "N m or N"];

fn is_far_above(measure: &Measure) -> bool {
    let has_best = WITH_A_BEST.contains(&measure.unit.as_str());
    !has_best
        && measure.full < measure.zero
        && measure
            .value
            .is_some_and(|value| value > 0.0 && measure.full > FAR_ABOVE * value)
}

/// A time that is longer than the reference solution's by this share is no fault yet.
const SLOWER: f64 = 0.1;
/// A share of this, such as of a step that is overshot, is next to nothing.
const LITTLE: f64 = 0.01;

/// Whether a submission that is hardly worse than the reference solution earns nothing.
fn is_close(measure: &Measure, value: f64) -> bool {
    let room = match measure.unit.as_str() {
        "s" => SLOWER * value,
        "" => LITTLE,
        _ => return false,
    };
    measure.full < measure.zero && measure.zero - value < room
}

/// A deviation of this share from what is asked for is not what is asked for.
const FAR_OFF: f64 = 0.25;

/// Whether a band follows a reference solution that does something else than what is judged.
fn is_far_off(measure: &Measure, value: f64) -> bool {
    let is_deviation = measure.unit.is_empty() && measure.full < measure.zero;
    is_deviation && measure.reference.is_some() && value > FAR_OFF
}

/// What is predicted on paper should be about what the reference solution does.
const UNLIKE: f64 = 0.5;

fn is_unlike(measure: &Measure) -> bool {
    let (Some(value), Some(predicted)) = (measure.value, measure.prediction) else {
        return false;
    };
    let apart = (value - predicted).abs();
    // where both are next to nothing, shares say nothing
    let width = (measure.zero - measure.full).abs();
    apart > UNLIKE * value.abs().max(predicted.abs()) && apart > 0.1 * width
}

/// Bands against what the reference solution reaches: those of speeds, jerks, energies and the like, for which nothing says what can be, far
/// above it; those that follow one that is far from what is judged; those in which next to
/// the reference solution nothing is earned; predictions of quite another number, of another arm or
/// another loop.
pub(super) fn against_reference(rubric: &Rubric<'_>, doubts: &mut Vec<Doubt>) {
    for (task, grade) in rubric.graded_tasks() {
        for check in &grade.checks {
            let measure = check.measure.as_ref();
            let Some((measure, value)) = measure.and_then(|m| Some((m, m.value?))) else {
                continue;
            };
            let in_words = |number: f64| with_unit(number, &measure.unit);
            let mut doubt = |what: String, help: &str| {
                doubts.push(Doubt {
                    rule: "band",
                    of: format!("{}/{}", task.name, check.name),
                    what,
                    help: help.to_owned(),
                });
            };
            if is_far_above(measure) {
                doubt(
                    format!(
                        "all points up to {}, and the reference solution reaches {}: hardly anybody can lose one",
                        in_words(measure.full),
                        in_words(value)
                    ),
                    "narrow the band: `full` is the worst that still earns everything",
                );
            }
            if is_far_off(measure, value) {
                doubt(
                    format!(
                        "the reference solution itself reaches {}, and the band begins there: is what is judged what is asked for?",
                        in_words(value)
                    ),
                    "compare the number in the check with what the brief and `target` ask for",
                );
            }
            // answers of functions can be exact
            let moves = matches!(task.work, TaskWork::Motion(..));
            if moves && is_close(measure, value) {
                doubt(
                    format!(
                        "no points from {} on, and the reference solution reaches {}: a submission that is hardly worse earns nothing",
                        in_words(measure.zero),
                        in_words(value)
                    ),
                    "widen the band: `zero` is what earns nothing, and solutions differ",
                );
            }
            if let Some(predicted) = measure.prediction.filter(|_| is_unlike(measure)) {
                doubt(
                    format!(
                        "the prediction is {}, and the reference solution reaches {}",
                        in_words(predicted),
                        in_words(value)
                    ),
                    "is `prediction` of this joint, with this inertia and these gains? Students see it beside their curve",
                );
            }
        }
    }
}

/// The radius of the workspace about its middle \[m\].
fn reach_m(lab: &Lab) -> f64 {
    let workspace = sample_workspace(&lab.robot, lab.robot.tcp(), SAMPLES);
    let points = workspace.points_m();
    let Some(first) = points.first() else {
        return f64::INFINITY;
    };
    let fold =
        |f: fn(f64, f64) -> f64| points.iter().fold(*first, |so_far, p| so_far.zip_map(p, f));
    let middle: Vector3<f64> = (fold(f64::min) + fold(f64::max)) * 0.5;
    let far = points.iter().map(|p| (p - middle).norm());
    far.fold(0.0, f64::max)
}

fn doubt(
    task: &Task,
    check: &str,
    (band, unit): (Band, &'static str),
    (motion, joint): (Option<&MotionTask>, Option<usize>),
    (reach_m, is_of_turning): (f64, bool),
) -> Option<Doubt> {
    // where more is better, a band beyond what can be is one that the reference solution does not reach
    if band.more_is_better() {
        return None;
    }
    let most_effort = motion.map(|motion| {
        let gains = motion.servo.gains.iter().enumerate();
        let of_check = gains.filter(|(entry, _)| joint.is_none_or(|joint| joint == *entry));
        let efforts = of_check.map(|(_, gains)| gains.effort_limit);
        efforts.fold(0.0, f64::max)
    });
    let run_s = motion.map(|motion| motion.periods.time_s(motion.ticks));
    let (limit, words) = match unit {
        "s" => (run_s?, "the whole run takes"),
        "m" => (
            SHARE_OF_REACH * reach_m,
            "a quarter of the robot's reach is",
        ),
        "rad" => (WIDE_RAD, "an eighth of a turn is"),
        "N m" | "N" | "N m or N" => (most_effort?, "no effort is greater than"),
        "" => (1.0, "that is the whole of it:"),
        _ => return None,
    };
    // nothing is turned away by more than half a turn; an angle of a joint may be
    if unit == "rad" && joint.is_none() && is_of_turning && band.full < limit && band.zero > PI {
        return Some(Doubt {
            rule: "band",
            of: format!("{}/{check}", task.name),
            what: format!(
                "no points from {} on, and nothing is turned away by more than half a turn, {}: nobody earns nothing",
                with_unit(band.zero, unit),
                with_unit(PI, unit)
            ),
            help: "is the number in radians? `zero` is the least that earns nothing".to_owned(),
        });
    }
    // nobody's hand is farther off than the workspace is wide
    let widest = 2.0 * reach_m;
    if unit == "m" && band.full < limit && band.zero > widest && widest.is_finite() {
        return Some(Doubt {
            rule: "band",
            of: format!("{}/{check}", task.name),
            what: format!(
                "no points from {} on, and the robot's workspace is {} wide: hardly anybody earns nothing",
                with_unit(band.zero, unit),
                with_unit(widest, unit)
            ),
            help: "are the numbers in metres? `zero` is the least that earns nothing".to_owned(),
        });
    }
    (limit.is_finite() && band.full >= limit).then(|| Doubt {
        rule: "band",
        of: format!("{}/{check}", task.name),
        what: format!(
            "all points up to {}, and {words} {}: hardly anybody can lose one",
            with_unit(band.full, unit),
            with_unit(limit, unit)
        ),
        help: "narrow the band: `full` is the worst that still earns everything".to_owned(),
    })
}

/// Whether a time is fewer than two control periods from losing points: who commands a period later loses some. What is well below the
/// end of full points is as it should be.
fn is_within_periods(motion: &MotionTask, measure: &Measure) -> bool {
    let room_s = measure.value.map(|value| measure.full - value);
    measure.unit == "s"
        && measure.full < measure.zero
        && room_s.is_some_and(|room_s| {
            (0.0..2.0 * motion.periods.control_s()).contains(&room_s)
                && room_s < (1.0 - NOT_SPENT) * measure.full
        })
}

/// Times in which the reference solution has less room than two control periods.
pub(super) fn periods(rubric: &Rubric<'_>, doubts: &mut Vec<Doubt>) {
    for (task, grade) in rubric.graded_tasks() {
        let TaskWork::Motion(motion, _) = &task.work else {
            continue;
        };
        for check in &grade.checks {
            let of = format!("{}/{}", task.name, check.name);
            let is_known = doubts.iter().any(|doubt| doubt.of == of);
            let measure = check.measure.as_ref();
            let measure = measure.filter(|measure| is_within_periods(motion, measure));
            if let Some((value, full)) = measure
                .filter(|_| !is_known)
                .and_then(|measure| Some((measure.value?, measure.full)))
            {
                doubts.push(Doubt {
                    rule: "margin",
                    of,
                    what: format!(
                        "the reference solution takes {}, and all points are earned up to {}: less than two control periods of {} s are between \
                         them",
                        with_unit_unlike(value, full, "s"),
                        with_unit_unlike(full, value, "s"),
                        motion.periods.control_s()
                    ),
                    help: "widen the band: who commands one period later loses points".to_owned(),
                });
            }
        }
    }
}

/// Tasks in which the reference solution uses most of what a task may use.
pub(super) fn budgets(rubric: &Rubric<'_>, doubts: &mut Vec<Doubt>) {
    for (task, grade) in rubric.graded_tasks() {
        let allowed = rubric.lab.of_task(task).budgets.operations_per_task;
        if grade.operations.saturating_mul(LEAST_BUDGET) > allowed {
            doubts.push(Doubt {
                rule: "margin",
                of: format!("{}/budgets", task.name),
                what: format!(
                    "the reference solution uses {} of the {allowed} operations of a task: who solves it otherwise may be stopped",
                    grade.operations
                ),
                help: "raise `operations_per_task` in [budgets], or mend the solution".to_owned(),
            });
        }
    }
}

/// Bands in which the reference solution has hardly any room, in its own numbers or in some variant.
pub(super) fn margins(rubric: &Rubric<'_>, doubts: &mut Vec<Doubt>) {
    let mut thin = |task: &str, check: &str, margin: f64, whose: &str| {
        let of = format!("{task}/{check}");
        if doubts
            .iter()
            .all(|doubt| doubt.rule != "margin" || doubt.of != of)
        {
            doubts.push(Doubt {
                rule: "margin",
                of,
                what: format!(
                    "{whose} the reference solution is {} of the band's width from losing points: who solves it otherwise may lose some",
                    with_unit(margin, "")
                ),
                help: "widen the band, or mend the solution".to_owned(),
            });
        }
    };
    for margin in rubric.margins.iter().filter(|margin| margin.is_thin) {
        let (task, check) = (&margin.task, &margin.check);
        thin(task, check, margin.least.max(0.0), "in a variant");
    }
    for task in rubric.reference.iter().flat_map(|grade| &grade.tasks) {
        for check in &task.checks {
            if let Some(measure) = check.measure.as_ref().filter(|measure| is_thin(measure)) {
                let margin =
                    measure.margin().unwrap_or_default() / (measure.zero - measure.full).abs();
                thin(&task.name, &check.name, margin, "with the lab's numbers");
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn measure(value: f64, unit: &str, prediction: Option<f64>) -> Measure {
        Measure {
            quantity: String::new(),
            value: Some(value),
            unit: unit.to_owned(),
            full: 1000.0,
            zero: 1000.4,
            reference: None,
            prediction,
        }
    }

    #[test]
    fn a_band_far_above_what_is_reached_is_found_where_nothing_else_bounds_it() {
        assert!(is_far_above(&measure(9.0, "m/s³", None)));
        assert!(!is_far_above(&measure(11.0, "m/s³", None)));
        assert!(
            !is_far_above(&measure(0.0, "N s", None)),
            "nothing is touched"
        );
        assert!(
            !is_far_above(&measure(1e-9, "m", None)),
            "as good as can be"
        );
    }

    #[test]
    fn a_prediction_of_another_arm_is_found() {
        assert!(is_unlike(&measure(0.232, "s", Some(0.1))));
        assert!(!is_unlike(&measure(0.232, "s", Some(0.201))));
        assert!(
            !is_unlike(&measure(0.015, "s", Some(0.005))),
            "both are next to nothing"
        );
        assert!(!is_unlike(&measure(0.232, "s", None)));
    }
}
