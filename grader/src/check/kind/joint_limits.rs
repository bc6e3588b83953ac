//! joint-limits: how far a joint leaves its position limits, or is commanded beyond a limit that stops it \[rad or m\]. Inside the
//! limits the value is negative: the margin that is left.

use kinemark_sim::control::Mode;

use crate::check::prelude::*;

problems! {
    /// A limit that is not there: every run would earn all points.
    enum NoLimit {
        Joint { joint: String }:
            "lab::joint_limits", "joint `{joint}` has no limits of its position: every run would earn these points", "a joint without limits",
            "give it `limit = { lower = .., upper = .. }` in the robot file, or name another joint";
        Robot:
            "lab::joint_limits", "no joint of this robot has limits of its position: every run would earn these points", "this check",
            "give joints `limit = { lower = .., upper = .. }` in the robot file, or leave the check out";
    }
}

/// The keys.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct Table {
    /// The joint; the one that is furthest beyond its limits where it is left out.
    joint: Option<At<String>>,
    /// Distance beyond a limit that earns all points \[rad, or m of a prismatic joint\].
    full_rad: BandEnd,
    /// Distance that earns none.
    zero_rad: BandEnd,
}

impl MotionTable for Table {
    const NAME: &'static str = "joint-limits";
    type Check = InBand<JointLimits>;

    fn read(&self, reading: &MotionReading<'_>) -> Result<Self::Check, LabError> {
        let joint = reading.maybe_joint(self.joint.as_ref())?;
        let mut joints = reading.robot.moving_joints().enumerate();
        let has_limit = joints.any(|(index, of)| {
            joint.is_none_or(|joint| joint == index)
                && (of.limits.lower.is_some() || of.limits.upper.is_some())
        });
        match &self.joint {
            _ if has_limit => (),
            Some(typed) => {
                let joint = typed.get_ref().clone();
                return reading.refuse_at(typed, NoLimit::Joint { joint });
            }
            None => return reading.refuse(NoLimit::Robot),
        }
        let unit = reading.units(joint).position();
        reading.in_band([self.full_rad, self.zero_rad], unit, JointLimits(joint))
    }
}

/// The distance beyond the limits of the joint of this index in `q`; of any where there is none.
#[derive(Debug)]
pub(crate) struct JointLimits(Option<usize>);

impl RunMeasure for JointLimits {
    fn judge(&self, facts: &MotionFacts<'_>, band: Band) -> Finding {
        let trace = facts.trace;
        let mut worst = (f64::NEG_INFINITY, 0, 0); // value, tick, joint
        let mut breach: Option<(usize, usize)> = None;
        let joints = facts.robot.moving_joints().enumerate();
        for (index, joint) in joints.filter(|(index, _)| self.0.is_none_or(|of| of == *index)) {
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
        let (value, tick, joint) = (worst.0, worst.1, self.0.unwrap_or(worst.2));
        let unit = facts.units(joint).position();
        let of = match self.0 {
            Some(joint) => format!("of the limits of joint `{}`", facts.joint_name(joint)),
            None => "of a joint limit".to_owned(),
        };
        let quantity = format!("greatest violation {of} (negative: within the limits)");
        let mut finding = Finding::against(band, value, unit, quantity);
        if let (Some((first, first_joint)), true) = (breach, finding.is_lost()) {
            let (name, first_s) = (facts.joint_name(joint), seconds(facts.time_s(first)));
            let message = match value < 0.0 {
                // the band asks for room before the limit
                true => format!(
                    "joint `{name}` comes within {} {unit} of a limit at {}, and {} {unit} are asked for",
                    trimmed(-value, 4),
                    seconds(facts.time_s(tick)),
                    trimmed(-band.full, 4),
                ),
                false => format!(
                    "joint `{}` leaves its limits at {first_s}; joint `{name}` is {} {unit} beyond at its worst, at {}",
                    facts.joint_name(first_joint),
                    trimmed(value, 4),
                    seconds(facts.time_s(tick)),
                ),
            };
            finding = finding.with(Evidence {
                value: Some(trace.q.at(first)[first_joint]),
                limit: Some(band.full),
                unit: facts.units(first_joint).position().to_owned(),
                ..facts.evidence(message, format!("q[{first_joint}]"), first)
            });
        }
        finding.advise(match facts.units(joint) {
            _ if value < 0.0 => "Keep away from the limits: turn back before, and slower.",
            JointUnits::Sliding => "Take positions between the limits.",
            JointUnits::Turning | JointUnits::Mixed => {
                "Take angles between the limits: `wrap_pi` brings an angle into (-pi, pi]."
            }
        })
    }
}

#[cfg(test)]
mod tests {
    use crate::check::by_hand::{HandRow, judged, judged_sliding, refused_without_limits, value};

    #[test]
    fn a_joint_that_is_named_is_judged_alone_and_in_its_unit() {
        let motion = "mode = \"effort\"\nduration_s = 1.0";
        let kind = "joint-limits = { joint = \"elbow\", full_rad = 0.0, zero_rad = 0.1 }";
        let finding = judged_sliding(motion, kind, |_| HandRow::default());
        let measure = finding.measure.as_ref().expect("a measure");
        assert_eq!(measure.unit, "m");
        assert!(measure.quantity.contains("joint `elbow`"), "{measure:?}");
        assert!(!value(&finding).is_nan());
    }
    /// A band below zero asks for room before the limit.
    #[test]
    fn a_joint_that_comes_near_its_limit_has_not_left_it() {
        let motion = "mode = \"effort\"\nduration_s = 1.0";
        let kind = "joint-limits = { joint = \"shoulder\", full_rad = -6.0, zero_rad = -1.0 }";
        let finding = judged(motion, kind, |_| HandRow {
            q: [1.0, 0.0],
            ..HandRow::default()
        });
        let message = &finding.evidence.first().expect("a fact").message;
        assert!(
            message.contains("joint `shoulder` comes within 5."),
            "{message}"
        );
        assert!(message.ends_with("and 6 rad are asked for"), "{message}");
        assert!(finding.next_step.starts_with("Keep away"), "{finding:?}");
    }

    #[test]
    fn a_limit_that_is_not_there_gives_no_points_away() {
        let motion = "mode = \"effort\"\nduration_s = 1.0";
        for (keys, words) in [
            ("", "no joint of this robot"),
            ("joint = \"elbow\", ", "joint `elbow` has no limits"),
        ] {
            let kind = format!("joint-limits = {{ {keys}full_rad = 0.0, zero_rad = 0.1 }}");
            let refused = refused_without_limits(motion, &kind);
            assert!(
                refused.contains("lab::joint_limits") && refused.contains(words),
                "{refused}"
            );
        }
    }
}
