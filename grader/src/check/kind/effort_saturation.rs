//! effort-saturation: for how long the effort of a joint is at its limit \[s\].

use crate::check::prelude::*;

problems! {
    /// A limit that is not there: every run would earn all points.
    enum NoLimit {
        Joint { joint: String }:
            "lab::effort_saturation", "joint `{joint}` has no limit of its effort: every run would earn these points", "a joint without such a limit",
            "give the servo an `effort_limit`, or the joint `limit = { effort = .. }` in the robot file, or name another joint";
        Robot:
            "lab::effort_saturation", "no joint has a limit of its effort in this task: every run would earn these points", "this check",
            "give the servo an `effort_limit`, or the joints `limit = { effort = .. }` in the robot file, or leave the check out";
    }
}

/// The keys.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct Table {
    /// The joint; any joint where it is left out.
    joint: Option<At<String>>,
    /// Time that earns all points \[s\].
    full_s: BandEnd,
    /// Time that earns none \[s\].
    zero_s: BandEnd,
}

impl MotionTable for Table {
    const NAME: &'static str = "effort-saturation";
    type Check = InBand<EffortSaturation>;

    fn read(&self, reading: &MotionReading<'_>) -> Result<Self::Check, LabError> {
        let joint = reading.maybe_joint(self.joint.as_ref())?;
        let mut gains = reading.motion.servo.gains.iter().enumerate();
        let has_limit = gains.any(|(index, gains)| {
            joint.is_none_or(|joint| joint == index) && gains.effort_limit.is_finite()
        });
        match &self.joint {
            _ if has_limit => (),
            Some(typed) => {
                let joint = typed.get_ref().clone();
                return reading.refuse_at(typed, NoLimit::Joint { joint });
            }
            None => return reading.refuse(NoLimit::Robot),
        }
        reading.in_band([self.full_s, self.zero_s], "s", EffortSaturation(joint))
    }
}

/// The time at a limit, of the joint of this index in `q`; of any where there is none.
#[derive(Debug)]
pub(crate) struct EffortSaturation(Option<usize>);

impl RunMeasure for EffortSaturation {
    fn judge(&self, facts: &MotionFacts<'_>, band: Band) -> Finding {
        let gains = &facts.motion.servo.gains;
        let at_limit = |tick: usize| {
            let efforts = facts.trace.effort.at(tick).iter().zip(gains).enumerate();
            let mut efforts = efforts.filter(|(joint, _)| self.0.is_none_or(|of| of == *joint));
            let found = efforts.find(|(_, (effort, gains))| effort.abs() >= gains.effort_limit);
            found.map(|(joint, _)| joint)
        };
        // ticks with a joint at its limit there
        let saturated: Vec<(usize, usize)> = (0..facts.applied_ticks())
            .filter_map(|tick| Some((tick, at_limit(tick)?)))
            .collect();
        let so_far_s = |tick: usize| {
            let count = saturated.partition_point(|(saturated, _)| *saturated <= tick);
            facts.time_s(count)
        };
        let what = match self.0 {
            Some(joint) => {
                format!(
                    "time with the effort of joint `{}` at its limit",
                    facts.joint_name(joint)
                )
            }
            None => "time with an effort at its limit".to_owned(),
        };
        let so_far = (0..facts.trace.len()).map(so_far_s).collect();
        let curve = facts.curve(what.clone(), "s", so_far, band);
        let mut finding = Finding::of_curve(band, Statistic::SoFar, "s", what, curve);
        let used_up = (0..saturated.len()).find(|count| facts.time_s(count + 1) > band.full);
        if let Some(&(tick, joint)) = used_up.and_then(|index| saturated.get(index)) {
            finding = finding.shown_at(facts, || {
                let message = format!(
                    "efforts are at their limit for {} in all, first at {}; the {} allowed are used up at {} by joint `{}` at {} {}",
                    seconds(facts.time_s(saturated.len())),
                    seconds(facts.time_s(saturated[0].0)),
                    seconds(band.full),
                    seconds(facts.time_s(tick)),
                    facts.joint_name(joint),
                    trimmed(facts.trace.effort.at(tick)[joint], 3),
                    facts.units(joint).effort(),
                );
                (message, format!("effort[{joint}]"), tick)
            });
        }
        finding.advise("Ask for smaller steps: spread the move over more time.")
    }
}

#[cfg(test)]
mod tests {
    use crate::check::by_hand::{HandRow, judged, refused_without_limits, value};

    #[test]
    fn of_a_joint_that_is_named_only_its_own_effort_counts() {
        let motion = "mode = \"effort\"\nduration_s = 1.0\nservo = { effort_limit = [5.0, 2.0] }";
        let row = |t_s: f64| HandRow {
            effort: [5.0, if t_s < 0.25 { -2.0 } else { 0.0 }],
            ..HandRow::default()
        };
        let of = |joint: &str| {
            let kind = format!("effort-saturation = {{ {joint}full_s = 0.1, zero_s = 0.4 }}");
            judged(motion, &kind, row)
        };
        assert!((value(&of("")) - 1.0).abs() < 1e-9);
        let elbow = of("joint = \"elbow\", ");
        assert!((value(&elbow) - 0.25).abs() < 1e-9 && (elbow.score - 0.5).abs() < 1e-9);
        assert!(
            elbow.evidence[0]
                .message
                .contains("by joint `elbow` at -2 N m"),
            "{elbow:?}"
        );
    }
    #[test]
    fn a_limit_that_is_not_there_gives_no_points_away() {
        let motion = "mode = \"effort\"\nduration_s = 1.0";
        for (keys, words) in [
            ("", "no joint has a limit"),
            ("joint = \"elbow\", ", "joint `elbow` has no limit"),
        ] {
            let kind = format!("effort-saturation = {{ {keys}full_s = 0.0, zero_s = 0.1 }}");
            let refused = refused_without_limits(motion, &kind);
            assert!(
                refused.contains("lab::effort_saturation") && refused.contains(words),
                "{refused}"
            );
        }
    }
}
