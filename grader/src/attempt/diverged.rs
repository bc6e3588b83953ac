//! A simulation that diverged, in words: what grew without bound, the likely cause, and what to do about it.

use kinemark_sim::control::{Mode, SampledLoop};
use kinemark_sim::diagnosis::Cause;
use kinemark_sim::run::DivergenceKind;
use kinemark_sim::text::number::trimmed;

use crate::record::names::Names;
use crate::task::model::MotionTask;

/// What a student can do about a servo.
const SERVO_HELP: &str = "this is the task's own servo, not your code: tell your instructor";

/// Describes a divergence in words, with the names of a run.
pub(crate) trait DivergedWords {
    /// A message about the divergence of a run of `task`, and the next step.
    fn diverged(
        &self,
        what: &DivergenceKind,
        cause: Option<&Cause>,
        task: &MotionTask,
    ) -> (String, String);

    /// Why the servo itself is the cause, with its computed stability limits.
    fn servo(&self, servo: &SampledLoop, task: &MotionTask) -> String;
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
        match cause {
            Some(Cause::ServoGains(servo)) => (
                format!("{lost}; {}", self.servo(servo, task)),
                SERVO_HELP.to_owned(),
            ),
            Some(Cause::ServoIntegral(servo)) => (
                format!(
                    "{lost}; sampled every {} ms, its servo makes each error {} times as large from sample to sample, and without its integral gains it would not",
                    trimmed(task.periods.servo_s() * 1e3, 4),
                    trimmed(servo.spectral_radius, 4)
                ),
                SERVO_HELP.to_owned(),
            ),
            Some(Cause::Feedback { joint, calls }) => (
                format!(
                    "{lost}; the command of `{}` turned round at each of the last {calls} calls of `control`, further each time",
                    self.joint(*joint)
                ),
                format!(
                    "your feedback is too strong for a period of {} ms: a correction is held that long before you see what it did. Lower its gains",
                    trimmed(task.periods.control_s() * 1e3, 4)
                ),
            ),
            None => (
                lost,
                match (what, task.servo.mode) {
                    (DivergenceKind::BodyRunaway { .. } | DivergenceKind::InContact { .. }, _) => {
                        "press less hard, or more slowly".to_owned()
                    }
                    (_, Mode::Effort) => "command less effort, and take it back in time".to_owned(),
                    (_, Mode::Position | Mode::Velocity) => {
                        "command less, or more slowly".to_owned()
                    }
                },
            ),
        }
    }

    fn servo(&self, servo: &SampledLoop, task: &MotionTask) -> String {
        let mut text = format!(
            "sampled every {} ms, its servo makes each error {} times as large from sample to sample",
            trimmed(task.periods.servo_s() * 1e3, 4),
            trimmed(servo.spectral_radius, 3)
        );
        let percent = |share: f64| format!("{} %", trimmed(100.0 * share, 2));
        let mut ways = Vec::new();
        if let Some(share) = servo.stable_share.filter(|share| *share < 1.0) {
            let joint = self.joint(servo.worst_joint);
            ways.push(format!("{} of the gains of `{joint}`", percent(share)));
        } else if let Some(share) = servo.stable_share_of_all.filter(|share| *share < 1.0) {
            ways.push(format!("{} of all its gains", percent(share)));
        }
        if let Some(period_s) = servo.stable_period_s.filter(|period| period.is_finite()) {
            ways.push(format!("a period of {} ms", trimmed(1e3 * period_s, 3)));
        }
        if !ways.is_empty() {
            text += &format!("; it is stable with at most {}", ways.join(", or "));
        }
        text
    }
}
