//! A simulation that diverged, in words: what grew without bound, the likely cause, and what to do about it.

use kinemark_sim::control::Mode;
use kinemark_sim::diagnosis::Cause;
use kinemark_sim::run::DivergenceKind;
use kinemark_sim::text::number::trimmed;

use crate::record::names::Names;
use crate::task::model::MotionTask;

/// What a student can do about a servo.
const SERVO_HELP: &str = "this is the task's own servo, not your code: tell your instructor";

/// What a student can do about damping.
const ROBOT_HELP: &str = "this is the task's own robot, not your code: tell your instructor";

/// Describes a divergence in words, with the names of a run.
pub(crate) trait DivergedWords {
    /// A message about the divergence of a run of `task`, and the next step.
    fn diverged(
        &self,
        what: &DivergenceKind,
        cause: Option<&Cause>,
        task: &MotionTask,
    ) -> (String, String);
}

impl DivergedWords for Names<'_> {
    fn diverged(
        &self,
        what: &DivergenceKind,
        cause: Option<&Cause>,
        task: &MotionTask,
    ) -> (String, String) {
        let lost = match what {
            DivergenceKind::NotFinite { joint } => format!(
                "the simulation diverged at joint `{}`: its motion is no longer finite",
                self.joint(*joint)
            ),
            DivergenceKind::Runaway { joint, bound_j, .. } => format!(
                "the simulation diverged at joint `{}`: kinetic energy above {bound_j:.0e} J",
                self.joint(*joint)
            ),
            DivergenceKind::BodyRunaway { body, speed_m_s } => {
                format!(
                    "the simulation diverged at body `{}`: it moves at {speed_m_s:.0} m/s",
                    self.body(*body)
                )
            }
            DivergenceKind::InContact { body: Some(body) } => {
                format!(
                    "the simulation diverged at body `{body}`: the contact force on it is unbounded"
                )
            }
            DivergenceKind::InContact { body: None } => {
                "the simulation diverged: a contact force on a link is unbounded".to_owned()
            }
        };
        let because = |cause: &Cause| format!("{lost}; {}", cause.clause(self, &task.periods));
        match cause {
            Some(cause @ (Cause::ServoGains(_) | Cause::ServoIntegral(_))) => {
                (because(cause), SERVO_HELP.to_owned())
            }
            Some(cause @ Cause::Feedback { .. }) => (
                because(cause),
                format!(
                    "your feedback is too strong for a period of {} ms: a correction is held that long before you see what it did. Lower its gains",
                    trimmed(task.periods.control_s() * 1e3, 4)
                ),
            ),
            Some(cause @ Cause::DrivesOn { .. }) => (
                because(cause),
                "an effort that brakes has the opposite sign of the velocity: compute errors as wanted minus measured".to_owned(),
            ),
            Some(cause @ Cause::StiffDamping { .. }) => (because(cause), ROBOT_HELP.to_owned()),
            Some(cause @ Cause::LongStep { .. }) => (because(cause), gentler(what, task)),
            None => (lost, gentler(what, task)),
        }
    }
}

/// What a student can do about a motion that is too violent.
fn gentler(what: &DivergenceKind, task: &MotionTask) -> String {
    let help = match (what, task.servo.mode) {
        (DivergenceKind::BodyRunaway { .. } | DivergenceKind::InContact { .. }, _) => {
            "press less hard, or more slowly"
        }
        (_, Mode::Effort | Mode::Prescribed) => "command less effort, and take it back in time",
        (_, Mode::Position | Mode::Velocity) => {
            "command less, or more slowly; if the arm moved away from where it should be, look at the sign of your correction, and at the unit"
        }
    };
    help.to_owned()
}
