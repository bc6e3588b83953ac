//! joint-speed: the greatest speed of a joint over the run or a part of it \[rad/s or m/s\]. A speed that is no number earns nothing.

use kinemark_sim::text::Problem;

use crate::check::prelude::*;

problems! {
    /// A part of the run that is none.
    enum SpeedProblem {
        Part { from_s: f64, to_s: f64 }:
            "lab::joint_speed", "the part that counts ends before it begins, got {from_s} s to {to_s} s", "this part",
            "exchange the two";
    }
}

/// The keys.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct Table {
    /// The joint; the fastest one where it is left out.
    joint: Option<At<String>>,
    /// Whether more is better: then all points from `full` on, and none up to `zero`; false where it is left out.
    #[serde(default)]
    at_least: bool,
    /// Where the part of the run begins that counts \[s\]; the start where it is left out.
    from_s: Option<At<f64>>,
    /// Where it ends \[s\]; the end of the run where it is left out.
    to_s: Option<At<f64>>,
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
        let [first, last] = reading.part_of_run(
            self.from_s.as_ref(),
            self.to_s.as_ref(),
            |from_s, to_s| -> Box<dyn Problem> { Box::new(SpeedProblem::Part { from_s, to_s }) },
        )?;
        reading.in_band_either(
            self.at_least,
            [self.full_rad_s, self.zero_rad_s],
            unit,
            JointSpeed { joint, first, last },
        )
    }
}

/// The greatest speed in a part of the run.
#[derive(Debug)]
pub(crate) struct JointSpeed {
    /// The index of the joint in `q`; the fastest one where there is none.
    joint: Option<usize>,
    /// The first tick that counts.
    first: usize,
    /// The last tick that counts.
    last: usize,
}

impl RunMeasure for JointSpeed {
    fn judge(&self, facts: &MotionFacts<'_>, band: Band) -> Finding {
        let fastest = |tick: usize| {
            let qd = facts.trace.qd.at(tick);
            facts.worst_joint(self.joint, |joint| qd[joint].abs())
        };
        let last = self.last.min(facts.last_tick());
        let first = self.first.min(last);
        // what does not count is a gap of the curve
        let speed = |tick: usize| match (first..=last).contains(&tick) {
            true => fastest(tick).1,
            false => f64::NAN,
        };
        let values: Vec<f64> = (0..facts.trace.len()).map(speed).collect();
        let counted = &values[first..=last];
        let value = Statistic::Greatest.of(counted);
        let (tick, _) = greatest(counted.iter().copied()).unwrap_or_default();
        let tick = first + tick;
        let first_above = values.iter().position(|speed| *speed > band.full);
        let first_above = first_above.filter(|_| !band.more_is_better());
        let (joint, _) = fastest(tick);
        let unit = facts.units(joint).speed();
        let moves = match facts.units(joint) {
            JointUnits::Sliding => "slides",
            JointUnits::Turning | JointUnits::Mixed => "turns",
        };
        let name = facts.joint_name(joint);
        let (title, unit_of_curve, quantity) = match self.joint {
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
        let mut finding = Finding::against(band, value, unit, quantity);
        finding.statistic = Some(Statistic::Greatest);
        finding
            .drawn(facts.curve(title, unit_of_curve, values, band))
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
    fn only_the_part_that_is_named_counts() {
        let kind = "joint-speed = { from_s = 0.5, full_rad_s = 1.0, zero_rad_s = 3.0 }";
        let of = |early: f64, late: f64| {
            judged(MOTION, kind, |t_s| HandRow {
                qd: [if t_s < 0.4999 { early } else { late }, 0.5],
                ..HandRow::default()
            })
        };
        let early = of(9.0, 0.0);
        assert_eq!((value(&early), early.score), (0.5, 1.0));
        let late = of(0.0, -2.0);
        assert!(
            (late.score - 0.5).abs() < 1e-12 && late.evidence[0].tick == Some(500),
            "{late:?}"
        );
        assert_eq!(of(0.0, f64::NAN).score, 0.0);
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
