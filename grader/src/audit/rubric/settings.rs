//! Settings of the robot and of the servo that do nothing, or not what one may think.

use kinemark_sim::control::Mode;

use super::{Doubt, Rubric};
use crate::lab::TaskWork;

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
    for task in &lab.tasks {
        let TaskWork::Motion(motion, _) = &task.work else {
            continue;
        };
        let has_gain = motion.servo.gains.iter().any(|gains| {
            [gains.kp, gains.ki, gains.kd]
                .iter()
                .any(|gain| *gain != 0.0)
        });
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
