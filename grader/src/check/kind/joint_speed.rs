//! joint-speed: the greatest speed of a joint over the run \[rad/s or m/s\]. A speed that is no number earns nothing.

use crate::check::prelude::*;

/// The keys.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct Table {
    /// The joint; the fastest one where it is left out.
    joint: Option<At<String>>,
    /// Whether more is better: then all points from `full` on, and none up to `zero`; false where it is left out.
    #[serde(default)]
    at_least: bool,
    /// Speed that earns all points \[rad/s, or m/s of a prismatic joint\].
    full_rad_s: BandEnd,
    /// Speed that earns none.
    zero_rad_s: BandEnd,
}

impl MotionTable for Table {
    const NAME: &'static str = "joint-speed";
    type Check = InBand<JointSpeed>;

    fn read(&self, reading: &MotionReading<'_>) -> Result<Self::Check, LabError> {
        let joint = reading.maybe_joint(self.joint.as_ref())?;
        let unit = reading.units(joint).speed();
        reading.in_band_either(
            self.at_least,
            [self.full_rad_s, self.zero_rad_s],
            unit,
            JointSpeed(joint),
        )
    }
}

/// The speed of the joint of this index in `q`; of the fastest one where there is none.
#[derive(Debug)]
pub(crate) struct JointSpeed(Option<usize>);

impl RunMeasure for JointSpeed {
    fn judge(&self, facts: &MotionFacts<'_>, band: Band) -> Finding {
        let fastest = |tick: usize| {
            let qd = facts.trace.qd.at(tick);
            facts.worst_joint(self.0, |joint| qd[joint].abs())
        };
        let values: Vec<f64> = (0..facts.trace.len()).map(|tick| fastest(tick).1).collect();
        let (tick, value) = greatest(values.iter().copied()).unwrap_or_default();
        let first_above = values.iter().position(|speed| *speed > band.full);
        let first_above = first_above.filter(|_| !band.more_is_better());
        let (joint, _) = fastest(tick);
        let unit = facts.units(joint).speed();
        let moves = match facts.units(joint) {
            JointUnits::Sliding => "slides",
            JointUnits::Turning | JointUnits::Mixed => "turns",
        };
        let name = facts.joint_name(joint);
        let (title, unit_of_curve, quantity) = match self.0 {
            Some(_) => (
                format!("speed of joint `{name}`"),
                unit,
                format!("greatest speed of joint `{name}`"),
            ),
            None => (
                "speed of the fastest joint".to_owned(),
                JointUnits::of_all(facts.robot).speed(),
                "greatest speed of a joint".to_owned(),
            ),
        };
        let curve = facts.curve(title, unit_of_curve, values, band);
        Finding::of_curve(band, Statistic::Greatest, unit, quantity, curve)
            .shown_at(facts, || {
                let mut message = format!(
                    "joint `{name}` {moves} at {} {unit} at {}",
                    trimmed(value, 3),
                    seconds(facts.time_s(tick)),
                );
                message += &match first_above {
                    Some(first) => format!(
                        "; {} {unit} are first passed at {}",
                        trimmed(band.full, 3),
                        seconds(facts.time_s(first)),
                    ),
                    None => ", its greatest speed".to_owned(),
                };
                (message, format!("qd[{joint}]"), tick)
            })
            .advise(band.advice(
                "Scale all joint velocities down together where the largest is too high: the direction of the hand stays.",
                "Give the fastest part of the move less time.",
            ))
    }
}

#[cfg(test)]
mod tests {
    use crate::check::by_hand::{HandRow, judged, value};

    const MOTION: &str = "mode = \"velocity\"\nduration_s = 1.0";
    const KIND: &str = "joint-speed = { full_rad_s = 1.0, zero_rad_s = 3.0 }";

    #[test]
    fn the_fastest_joint_counts_whichever_way_it_turns() {
        let finding = judged(MOTION, KIND, |t_s| HandRow {
            qd: [0.5, -2.0 * t_s],
            ..HandRow::default()
        });
        // the last tick of the run is 1 s
        assert!((value(&finding) - 2.0).abs() < 1e-12, "{finding:?}");
        assert!((finding.score - 0.5).abs() < 1e-12);
        let message = &finding.evidence[0].message;
        assert!(
            message.contains("joint `elbow`") && message.contains("first passed at 0.501 s"),
            "{message}"
        );
        assert_eq!(judged(MOTION, KIND, |_| HandRow::default()).score, 1.0);
    }

    #[test]
    fn a_joint_that_is_named_counts_alone_and_more_may_be_better() {
        let kind = "joint-speed = { joint = \"shoulder\", at_least = true, full_rad_s = 1.0, zero_rad_s = 0.0 }";
        let finding = judged(MOTION, kind, |t_s| HandRow {
            qd: [0.5 * t_s, 4.0],
            ..HandRow::default()
        });
        assert!((value(&finding) - 0.5).abs() < 1e-12 && (finding.score - 0.5).abs() < 1e-12);
        assert_eq!(
            finding.evidence[0].message,
            "joint `shoulder` turns at 0.5 rad/s at 1 s, its greatest speed"
        );
        assert!(finding.next_step.ends_with("less time."), "{finding:?}");
    }

    #[test]
    fn a_speed_that_is_no_number_earns_nothing() {
        let finding = judged(MOTION, KIND, |_| HandRow {
            qd: [f64::NAN, 0.0],
            ..HandRow::default()
        });
        assert_eq!(finding.score, 0.0);
    }
}
