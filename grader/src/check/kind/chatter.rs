//! chatter: how often the effort of a joint turns round, in reversals per second \[Hz\].
//!
//! A *reversal* is counted where the effort has come back from its last extreme by more than 1 % of the joint's effort limit (of
//! the joint's greatest effort in the run, where it has no limit). The side from which it goes first is no reversal. The count is
//! divided by the length of the run. An effort that swings at `f` turns round `2 f` times a second.

use crate::check::alternation;
use crate::check::prelude::*;

/// An effort comes back by more than this share of its limit to have turned round.
const HYSTERESIS: f64 = 0.01;

/// The keys.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct Table {
    /// The joint; the one with the most reversals where it is left out.
    joint: Option<At<String>>,
    /// Reversals in a second that earn all points \[Hz\].
    full_hz: BandEnd,
    /// Reversals in a second that earn none \[Hz\].
    zero_hz: BandEnd,
}

impl MotionTable for Table {
    const NAME: &'static str = "chatter";
    type Check = InBand<Chatter>;

    fn read(&self, reading: &MotionReading<'_>) -> Result<Self::Check, LabError> {
        let joint = reading.maybe_joint(self.joint.as_ref())?;
        reading.in_band([self.full_hz, self.zero_hz], "Hz", Chatter(joint))
    }
}

/// Of the joint of this index in `q`; of the worst one where there is none.
#[derive(Debug)]
pub(crate) struct Chatter(Option<usize>);

impl RunMeasure for Chatter {
    fn judge(&self, facts: &MotionFacts<'_>, band: Band) -> Finding {
        let run_s = facts.time_s(facts.applied_ticks());
        let (worst, _) = facts.worst_joint(self.0, |joint| {
            reversals_of(facts, joint).map_or(f64::NAN, |ticks| ticks.len() as f64)
        });
        let name = facts.joint_name(worst);
        let ticks = reversals_of(facts, worst);
        let so_far = match &ticks {
            Some(ticks) => count_so_far(ticks, facts.trace.len(), run_s),
            None => vec![f64::NAN; facts.trace.len()],
        };
        let ticks = ticks.unwrap_or_default();
        let first = ticks.first().copied().unwrap_or(0);
        let quantity = format!("reversals of the effort of joint `{name}` per second");
        let title =
            format!("reversals of the effort of joint `{name}` so far, per second of the run");
        let curve = facts.curve(title, "Hz", so_far, band);
        let finding = Finding::of_curve(band, Statistic::SoFar, "Hz", quantity, curve);
        let explained = match finding.is_lost() {
            true => alternation::explained(facts, worst, first),
            false => None,
        };
        let (why, help) = explained.unzip();
        let help = help.unwrap_or_else(|| {
            "Lower the gains that see noise, derivatives first, or filter what they see.".to_owned()
        });
        finding.advise(help).shown_at(facts, || {
            let mut message = format!(
                "the effort of joint `{name}` turns round {} times in {}, first at {}",
                ticks.len(),
                seconds(run_s),
                seconds(facts.time_s(first)),
            );
            if let Some(why) = why {
                message = format!("{message}; {why}");
            }
            (message, format!("effort[{worst}]"), first)
        })
    }
}

/// The ticks at which a joint's effort turns round; none where it is no number somewhere.
fn reversals_of(facts: &MotionFacts<'_>, joint: usize) -> Option<Vec<usize>> {
    let efforts = facts.applied_efforts(joint);
    if !efforts.iter().all(|effort| effort.is_finite()) {
        return None;
    }
    let limit = facts.motion.servo.gains[joint].effort_limit;
    let limit = if limit.is_finite() {
        limit
    } else {
        efforts.iter().fold(0.0, |most: f64, e| most.max(e.abs()))
    };
    Some(reversals(&efforts, HYSTERESIS * limit))
}

/// The count of `reversals` up to every tick, that included, over the length of the run \[Hz\].
fn count_so_far(reversals: &[usize], ticks: usize, run_s: f64) -> Vec<f64> {
    let count = |tick: usize| reversals.partition_point(|reversal| *reversal <= tick);
    (0..ticks).map(|tick| count(tick) as f64 / run_s).collect()
}

/// The ticks at which the effort has come back from an extreme by more than `hysteresis`.
fn reversals(efforts: &[f64], hysteresis: f64) -> Vec<usize> {
    let mut ticks = Vec::new();
    let Some(&first) = efforts.first() else {
        return ticks;
    };
    // before it has gone anywhere both ends of its range are extremes
    let (mut low, mut high) = (first, first);
    let mut rises = None;
    for (tick, &effort) in efforts.iter().enumerate() {
        (low, high) = (low.min(effort), high.max(effort));
        let turned = match rises {
            None => (high - low > hysteresis).then_some(effort > low),
            Some(true) => (high - effort > hysteresis).then_some(false),
            Some(false) => (effort - low > hysteresis).then_some(true),
        };
        if turned.is_some() {
            if rises.is_some() {
                ticks.push(tick);
            }
            rises = turned;
            (low, high) = (effort, effort);
        }
    }
    ticks
}

#[cfg(test)]
mod tests {
    use super::reversals;
    use crate::check::by_hand::{HandRow, judged, value};

    const MOTION: &str = "mode = \"effort\"\nduration_s = 2.0";
    const KIND: &str = "chatter = { full_hz = 10.0, zero_hz = 50.0 }";

    #[test]
    fn turning_points_beyond_the_hysteresis_count() {
        let of = |efforts: &[f64]| reversals(efforts, 1.0);
        assert!(of(&[0.0, 5.0, 10.0]).is_empty());
        assert_eq!(of(&[0.0, 5.0, 10.0, 9.5, 12.0, 10.5, 9.0]), [5]);
        assert_eq!(of(&[0.0, -5.0, 5.0, -5.0]), [2, 3]);
        // from the first extreme, not from the first value
        assert_eq!(of(&[0.0, 0.9, -0.9, -3.0, -1.5]), [4]);
        assert!(of(&[]).is_empty());
    }

    #[test]
    fn a_swing_turns_round_twice_a_period() {
        // 10 Hz, ±2 N m: well above 1 % of 100 N m; and the other joint below it
        let finding = judged(MOTION, KIND, |t_s| {
            let wave = libm::cos(2.0 * std::f64::consts::PI * 10.0 * t_s);
            HandRow {
                effort: [0.4 * wave, 2.0 * wave],
                ..HandRow::default()
            }
        });
        // begins at a crest, so the first half period goes down and every later one turns it: 39 of 40
        assert_eq!(value(&finding), 19.5);
        let expected = (50.0 - 19.5) / 40.0;
        assert!((finding.score - expected).abs() < 1e-12);
        assert!(
            finding.evidence[0]
                .message
                .starts_with("the effort of joint `elbow` turns round 39 times in 2 s"),
            "{}",
            finding.evidence[0].message
        );
    }

    #[test]
    fn a_command_that_alternates_is_explained() {
        let finding = judged(MOTION, KIND, |t_s| {
            let call = (t_s * 100.0 + 1e-6) as u64;
            let effort = if call.is_multiple_of(2) { 30.0 } else { -30.0 };
            HandRow {
                command: [0.0, effort],
                effort: [0.0, effort],
                ..HandRow::default()
            }
        });
        // 200 calls, 199 changes, the first of which is no reversal
        assert_eq!((value(&finding), finding.score), (99.0, 0.0));
        assert!(
            finding.evidence[0]
                .message
                .contains("turns round at every control period of 10 ms"),
            "{}",
            finding.evidence[0].message
        );
        let steady = judged(MOTION, KIND, |_| HandRow {
            effort: [3.0, 4.0],
            ..HandRow::default()
        });
        assert_eq!((value(&steady), steady.score), (0.0, 1.0));
        let lost = judged(MOTION, KIND, |_| HandRow {
            effort: [f64::NAN, 0.0],
            ..HandRow::default()
        });
        assert_eq!(lost.score, 0.0);
    }
}
