//! joint-limits: how far a joint leaves its position limits, or is commanded beyond a limit that stops it \[rad or m\]. Inside the
//! limits the value is negative: the margin that is left.

use kinemark_sim::control::Mode;

use crate::check::prelude::*;

/// The keys.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct Table {
    /// Distance beyond a limit that earns all points \[rad, or m of a prismatic joint\].
    full_rad: BandEnd,
    /// Distance that earns none.
    zero_rad: BandEnd,
}

impl MotionTable for Table {
    const NAME: &'static str = "joint-limits";
    type Check = InBand<JointLimits>;

    fn read(&self, reading: &MotionReading<'_>) -> Result<Self::Check, LabError> {
        let unit = reading.units(None).position();
        reading.in_band([self.full_rad, self.zero_rad], unit, JointLimits)
    }
}

/// The distance beyond the limits of any joint.
#[derive(Debug)]
pub(crate) struct JointLimits;

impl RunMeasure for JointLimits {
    fn judge(&self, facts: &MotionFacts<'_>, band: Band) -> Finding {
        let trace = facts.trace;
        let mut worst = (f64::NEG_INFINITY, 0, 0); // value, tick, joint
        let mut breach: Option<(usize, usize)> = None;
        for (index, joint) in facts.robot.moving_joints().enumerate() {
            let lower = joint.limits.lower.unwrap_or(f64::NEG_INFINITY);
            let upper = joint.limits.upper.unwrap_or(f64::INFINITY);
            let outside = |position: f64| (position - upper).max(lower - position);
            let commands = trace.command.component(index);
            for (tick, (q, command)) in trace.q.component(index).zip(commands).enumerate() {
                let mut beyond = outside(q);
                // a joint on its stop goes no farther, however wrong its command is
                if facts.motion.servo.mode == Mode::Position && beyond >= 0.0 {
                    beyond = beyond.max(outside(command));
                }
                if beyond > worst.0 {
                    worst = (beyond, tick, index);
                }
                if beyond > band.full && breach.is_none_or(|(first, _)| tick < first) {
                    breach = Some((tick, index));
                }
            }
        }
        let (value, tick, joint) = worst;
        let unit = facts.units(joint).position();
        let quantity = "greatest violation of a joint limit (negative: within the limits)";
        let mut finding = Finding::against(band, value, unit, quantity);
        if let (Some((first, first_joint)), true) = (breach, finding.is_lost()) {
            let message = format!(
                "joint `{}` leaves its limits at {}; joint `{}` is {} {unit} beyond at its worst, at {}",
                facts.joint_name(first_joint),
                seconds(facts.time_s(first)),
                facts.joint_name(joint),
                trimmed(value, 4),
                seconds(facts.time_s(tick)),
            );
            finding = finding.with(Evidence {
                value: Some(trace.q.at(first)[first_joint]),
                limit: Some(band.full),
                unit: facts.units(first_joint).position().to_owned(),
                ..facts.evidence(message, format!("q[{first_joint}]"), first)
            });
        }
        finding.advise(match facts.units(joint) {
            JointUnits::Sliding => "Take positions between the limits.",
            JointUnits::Turning | JointUnits::Mixed => {
                "Take angles between the limits: `wrap_pi` brings an angle into (-pi, pi]."
            }
        })
    }
}
