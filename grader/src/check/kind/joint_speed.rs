//! joint-speed: the greatest speed of any joint over the run \[rad/s or m/s\]. A speed that is no number earns nothing.

use crate::check::prelude::*;

/// The keys.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct Table {
    /// Speed that earns all points \[rad/s, or m/s of a prismatic joint\].
    full_rad_s: BandEnd,
    /// Speed that earns none.
    zero_rad_s: BandEnd,
}

impl MotionTable for Table {
    const NAME: &'static str = "joint-speed";
    type Check = InBand<JointSpeed>;

    fn read(&self, reading: &MotionReading<'_>) -> Result<Self::Check, LabError> {
        let unit = reading.units(None).speed();
        reading.in_band([self.full_rad_s, self.zero_rad_s], unit, JointSpeed)
    }
}

/// The speed of the fastest joint.
#[derive(Debug)]
pub(crate) struct JointSpeed;

impl RunMeasure for JointSpeed {
    fn judge(&self, facts: &MotionFacts<'_>, band: Band) -> Finding {
        let speeds = |tick: usize| facts.trace.qd.at(tick).iter().map(|speed| speed.abs());
        let fastest = |tick: usize| greatest(speeds(tick)).unwrap_or_default();
        let values: Vec<f64> = (0..facts.trace.len()).map(|tick| fastest(tick).1).collect();
        let (tick, value) = greatest(values.iter().copied()).unwrap_or_default();
        let first_above = values.iter().position(|speed| *speed > band.full);
        let (joint, _) = fastest(tick);
        let unit = facts.units(joint).speed();
        let moves = match facts.units(joint) {
            JointUnits::Sliding => "slides",
            JointUnits::Turning | JointUnits::Mixed => "turns",
        };
        let unit_of_all = JointUnits::of_all(facts.robot).speed();
        let curve = facts.curve("speed of the fastest joint", unit_of_all, values, band);
        let quantity = "greatest speed of a joint";
        Finding::of_curve(band, Statistic::Greatest, unit, quantity, curve)
            .shown_at(facts, || {
                let message = format!(
                    "joint `{}` {moves} at {} {unit} at {}; {} {unit} are first passed at {}",
                    facts.joint_name(joint),
                    trimmed(value, 3),
                    seconds(facts.time_s(tick)),
                    trimmed(band.full, 3),
                    seconds(facts.time_s(first_above.unwrap_or(tick))),
                );
                (message, format!("qd[{joint}]"), tick)
            })
            .advise("Scale all joint velocities down together where the largest is too high: the direction of the hand stays.")
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
    fn a_speed_that_is_no_number_earns_nothing() {
        let finding = judged(MOTION, KIND, |_| HandRow {
            qd: [f64::NAN, 0.0],
            ..HandRow::default()
        });
        assert_eq!(finding.score, 0.0);
    }
}
