//! effort-saturation: for how long some joint's effort is at its limit \[s\].

use crate::check::prelude::*;

/// The keys.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct Table {
    /// Time that earns all points \[s\].
    full_s: BandEnd,
    /// Time that earns none \[s\].
    zero_s: BandEnd,
}

impl MotionTable for Table {
    const NAME: &'static str = "effort-saturation";
    type Check = InBand<EffortSaturation>;

    fn read(&self, reading: &MotionReading<'_>) -> Result<Self::Check, LabError> {
        reading.in_band([self.full_s, self.zero_s], "s", EffortSaturation)
    }
}

/// The time at a limit.
#[derive(Debug)]
pub(crate) struct EffortSaturation;

impl RunMeasure for EffortSaturation {
    fn judge(&self, facts: &MotionFacts<'_>, band: Band) -> Finding {
        let gains = &facts.motion.servo.gains;
        let at_limit = |tick: usize| {
            let mut efforts = facts.trace.effort.at(tick).iter().zip(gains);
            efforts.position(|(effort, gains)| effort.abs() >= gains.effort_limit)
        };
        // ticks with a joint at its limit there
        let saturated: Vec<(usize, usize)> = (0..facts.applied_ticks())
            .filter_map(|tick| Some((tick, at_limit(tick)?)))
            .collect();
        let so_far_s = |tick: usize| {
            let count = saturated.partition_point(|(saturated, _)| *saturated <= tick);
            facts.time_s(count)
        };
        let what = "time with an effort at its limit";
        let so_far = (0..facts.trace.len()).map(so_far_s).collect();
        let curve = facts.curve(what, "s", so_far, band);
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
