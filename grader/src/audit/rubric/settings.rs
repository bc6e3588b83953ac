//! Settings of the robot and of the servo that do nothing, or not what one may think.

use kinemark_sim::control::Mode;
use kinemark_sim::text::number::{list, metres};
use toml::Table;

use super::{Doubt, Rubric};
use crate::audit::typed;
use crate::lab::{Lab, TaskWork};
use crate::record::quantity::with_unit;
use crate::task::model::MotionTask;
use crate::task::value::Value as Given;

/// What `robot` holds in submissions besides the dimensions.
const OF_ROBOT: [&str; 7] = [
    "name",
    "joints",
    "joint_names",
    "lower",
    "upper",
    "effort",
    "effort_limit",
];

/// A robot without a frame `tcp`, and gains of a servo that a task does not have.
pub(super) fn rule(rubric: &Rubric<'_>, doubts: &mut Vec<Doubt>) {
    let lab = rubric.lab;
    let robot = &lab.robot;
    if robot.frame("tcp").is_none() {
        doubts.push(Doubt {
            rule: "settings",
            of: "tcp".to_owned(),
            what: format!(
                "robot `{}` has no frame `tcp`, so its last link, `{}`, is taken for it",
                robot.name(),
                robot.tcp().name
            ),
            help: "add a frame `tcp` to the robot where the hand is".to_owned(),
        });
    }
    for name in robot.dimensions().names() {
        if OF_ROBOT.contains(&name) {
            doubts.push(Doubt {
                rule: "settings",
                of: name.to_owned(),
                what: format!(
                    "submissions cannot read the dimension `{name}` of robot `{}`: `robot.{name}` is something else there",
                    robot.name()
                ),
                help: "call the dimension otherwise".to_owned(),
            });
        }
    }
    let typed = typed::table(lab).unwrap_or_default();
    for task in &lab.tasks {
        doubts.extend(sideways_gravity(&task.name, &typed));
        let TaskWork::Motion(motion, _) = &task.work else {
            continue;
        };
        doubts.extend(of_target(&task.name, motion));
        doubts.extend(wide_switch(lab.of_task(task), &task.name, &typed));
        doubts.extend(long_run(rubric, &task.name, motion, &typed));
        doubts.extend(above_robot(lab.of_task(task), &task.name, &typed));
        let has_gain = motion.servo.gains.iter().any(|gains| {
            [gains.kp, gains.ki, gains.kd]
                .iter()
                .any(|gain| *gain != 0.0)
        });
        let follows = matches!(motion.servo.mode, Mode::Position | Mode::Velocity);
        if follows && !has_gain {
            doubts.push(Doubt {
                rule: "settings",
                of: format!("{}/servo", task.name),
                what: "kp, ki and kd are zero for every joint: a command does nothing".to_owned(),
                help: "give the servo gains, `servo = { kp = ... }`, or choose mode `effort`"
                    .to_owned(),
            });
        }
        if motion.servo.mode == Mode::Effort && has_gain {
            doubts.push(Doubt {
                rule: "settings",
                of: format!("{}/servo", task.name),
                what: "kp, ki and kd do nothing in mode `effort`: a command is the effort itself"
                    .to_owned(),
                help: "remove them, or choose mode `position` or `velocity`".to_owned(),
            });
        }
    }
}

/// Gravity that pulls sideways more than down, as that of another frame would.
fn sideways_gravity(task: &str, typed: &Table) -> Option<Doubt> {
    let typed = typed::named(typed, "tasks", task)?;
    let mut works = ["motion", "function"]
        .into_iter()
        .filter_map(|work| typed.get(work));
    works.find_map(|work| {
        let gravity = work.get("gravity_m_s2")?.as_array()?;
        let gravity: Vec<f64> = gravity.iter().map(typed::number).collect::<Option<_>>()?;
        let [x, y, z] = gravity.try_into().ok()?;
        (libm::hypot(x, y) > z.abs()).then(|| Doubt {
            rule: "settings",
            of: format!("{task}/gravity_m_s2"),
            what: format!(
                "gravity is {} in the world, where z is up: it pulls sideways",
                list(&[x, y, z])
            ),
            help: "write it along z of the world, whatever the lab's frame is: [0, 0, -9.81]"
                .to_owned(),
        })
    })
}

/// A limit switch that reads true over more than this share of the joint's range says nothing.
const WIDE_SWITCH: f64 = 0.1;

/// A limit switch with a hysteresis of another unit.
fn wide_switch(lab: &Lab, task: &str, typed: &Table) -> Option<Doubt> {
    let motion = typed::named(typed, "tasks", task)?.get("motion")?;
    let sensors = typed::tables(motion.as_table()?, "sensors");
    sensors.into_iter().find_map(|sensor| {
        let hysteresis = typed::number(sensor.get("hysteresis")?)?;
        let name = sensor.get("joint")?.as_str()?;
        let mut joints = lab.robot.moving_joints();
        let limits = &joints.find(|joint| joint.name == name)?.limits;
        let range = limits.upper? - limits.lower?;
        (hysteresis > WIDE_SWITCH * range).then(|| Doubt {
            rule: "settings",
            of: format!("{task}/{}", typed::name(sensor)),
            what: format!(
                "its hysteresis is {hysteresis}, and joint `{name}` moves by {range} from limit to limit: once pressed it is hardly let go"
            ),
            help: "write the hysteresis in metres or radians".to_owned(),
        })
    })
}

/// A run goes on for so many times what the reference solution needs, and for at least so long \[s\].
const LONG: (f64, f64) = (8.0, 10.0);

/// A run that goes on long after the reference solution is done.
fn long_run(rubric: &Rubric<'_>, task: &str, motion: &MotionTask, typed: &Table) -> Option<Doubt> {
    let mut graded = rubric.graded_tasks();
    let (_, grade) = graded.find(|(known, _)| known.name == task)?;
    let typed = typed::named(typed, "tasks", task)?;
    let is_of_end = |check: &&Table| {
        typed::kind(check).is_some_and(|(kind, _)| ["finish-time", "time-limit"].contains(&kind))
    };
    let of_end = typed::tables(typed, "checks").into_iter().filter(is_of_end);
    // what takes longest is when all is done
    let done_s = of_end
        .filter_map(|typed| {
            let mut checks = grade.checks.iter();
            let check = checks.find(|check| check.name == typed::name(typed))?;
            check.measure.as_ref()?.value
        })
        .reduce(f64::max)?;
    let run_s = motion.periods.time_s(motion.ticks);
    let (times, least_s) = LONG;
    (run_s > times * done_s && run_s - done_s > least_s).then(|| Doubt {
        rule: "settings",
        of: format!("{task}/duration_s"),
        what: format!(
            "the run takes {}, and the reference solution is done after {}: every grade simulates the rest",
            with_unit(run_s, "s"),
            with_unit(done_s, "s")
        ),
        help: "shorten `duration_s` to about twice what a good run takes".to_owned(),
    })
}

/// Bodies that move before anybody touches them.
pub(super) fn bodies(rubric: &Rubric<'_>, doubts: &mut Vec<Doubt>) {
    for moved in rubric.moved_bodies {
        doubts.push(Doubt {
            rule: "settings",
            of: format!("{}/{}", moved.task, moved.body),
            what: format!(
                "while the arm stands still, the body moves by {} in the first second",
                metres(moved.moved_m)
            ),
            help: "let it stand on what is below it: compare its place with that body's upper face"
                .to_owned(),
        });
    }
    if rubric.lab.kept_after_stop < LEAST_KEPT {
        doubts.push(Doubt {
            rule: "settings",
            of: "kept_after_stop".to_owned(),
            what: format!(
                "who stops once, in one call of thousands, keeps {} of what was earned until then",
                with_unit(rubric.lab.kept_after_stop, "")
            ),
            help: "write a share such as 0.8, or leave `kept_after_stop` out".to_owned(),
        });
    }
}

/// Who is stopped in one call should keep at least this share of the points.
const LEAST_KEPT: f64 = 0.5;

/// A limit of the servo above that of the robot's joint, which holds.
fn above_robot(lab: &Lab, task: &str, typed: &Table) -> Option<Doubt> {
    let servo = typed::named(typed, "tasks", task)?
        .get("motion")?
        .get("servo")?;
    // one number for all joints is an upper bound, and no joint's own
    let limits = servo.get("effort_limit")?.as_array()?.iter();
    let limits: Vec<f64> = limits.map(typed::number).collect::<Option<_>>()?;
    let mut joints = lab.robot.moving_joints().zip(limits);
    let (joint, of_servo, of_robot) = joints.find_map(|(joint, of_servo)| {
        let of_robot = joint.limits.effort?;
        (of_servo > of_robot).then_some((&joint.name, of_servo, of_robot))
    })?;
    Some(Doubt {
        rule: "settings",
        of: format!("{task}/servo"),
        what: format!(
            "`effort_limit` gives joint `{joint}` {of_servo}, and the robot's own limit is {of_robot}: that is what it has"
        ),
        help: "write the lesser number in `effort_limit`, or the greater one in the robot file"
            .to_owned(),
    })
}

/// A key of the target that says what the servo has, and says something else.
fn of_target(task: &str, motion: &MotionTask) -> Option<Doubt> {
    let Given::Map(entries) = &motion.target else {
        return None;
    };
    entries.iter().find_map(|(name, stated)| {
        let gains = motion.servo.gains.iter();
        let of_servo: Vec<f64> = match name.as_str() {
            "effort_limit" => gains.map(|gains| gains.effort_limit).collect(),
            "kp" => gains.map(|gains| gains.kp).collect(),
            "ki" => gains.map(|gains| gains.ki).collect(),
            "kd" => gains.map(|gains| gains.kd).collect(),
            _ => return None,
        };
        let is = match stated {
            // one number may be that of one joint
            Given::Number(stated) => of_servo.contains(stated),
            Given::List(stated) if stated.len() == of_servo.len() => {
                let mut pairs = stated.iter().zip(&of_servo);
                pairs.all(|(stated, of_servo)| *stated == Given::Number(*of_servo))
            }
            _ => true,
        };
        // gains do nothing there, and a limit of efforts does
        let counts = name == "effort_limit" || motion.servo.mode != Mode::Effort;
        (counts && !is).then(|| Doubt {
            rule: "settings",
            of: format!("{task}/{name}"),
            what: format!(
                "the target gives students another `{name}` than the servo has, {}",
                list(&of_servo)
            ),
            help:
                "write the same in `target` and in `servo`, or call the key of the target otherwise"
                    .to_owned(),
        })
    })
}
