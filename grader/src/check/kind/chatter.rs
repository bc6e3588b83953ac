//! chatter: how often the effort of a joint turns round, in reversals per second \[Hz\].
//!
//! A *reversal* is counted where the effort has come back from its last extreme by more than 1 % of the joint's effort limit (of
//! the joint's greatest effort in the run, where it has no limit). The side from which it goes first is no reversal. The count is
//! divided by the length of the run. An effort that swings at `f` turns round `2 f` times a second.

use std::ops::Range;

use kinemark_sim::model::robot::Robot;
use kinemark_sim::text::number::seconds;
use schemars::JsonSchema;
use serde::Deserialize;
use toml::Spanned;

use crate::check::alternation;
use crate::check::contract::{CheckKind, FirstLoss, MotionCheck};
use crate::check::facts::MotionFacts;
use crate::check::finding::Finding;
use crate::check::joint_effort::applied;
use crate::check::reading::InTask;
use crate::check::registry::MotionTable;
use crate::task::model::Band;
use crate::task::problem::LabError;

/// An effort comes back by more than this share of its limit to have turned round.
const HYSTERESIS: f64 = 0.01;

/// The keys.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct Table {
    /// The joint; the one with the most reversals where it is left out.
    #[schemars(with = "Option<String>")]
    joint: Option<Spanned<String>>,
    /// Reversals in a second that earn all points \[Hz\].
    full_hz: f64,
    /// Reversals in a second that earn none \[Hz\].
    zero_hz: f64,
}

impl MotionTable for Table {
    const NAME: &'static str = "chatter";
    type Check = Chatter;

    fn read(&self, at: Range<usize>, reading: &InTask<'_>) -> Result<Chatter, LabError> {
        Ok(Chatter {
            joint: reading.maybe_joint(self.joint.as_ref())?,
            band: reading.report.band(self.full_hz, self.zero_hz, at)?,
        })
    }
}

/// The check as read.
#[derive(Debug)]
pub(crate) struct Chatter {
    /// Index in `q`; the worst of all joints where there is none.
    joint: Option<usize>,
    band: Band,
}

impl CheckKind for Chatter {
    fn band(&self, _: &Robot) -> Option<(Band, &'static str)> {
        Some((self.band, "Hz"))
    }
}

impl MotionCheck for Chatter {
    fn judge(&self, facts: &MotionFacts<'_>) -> Finding {
        let run_s = facts.time_s(facts.applied_ticks());
        let (worst, value) = facts.worst_joint(self.joint, |joint| {
            reversals_of(facts, joint).map_or(f64::NAN, |ticks| ticks.len() as f64 / run_s)
        });
        let name = facts.joint_name(worst);
        let ticks = reversals_of(facts, worst).unwrap_or_default();
        let first = ticks.first().copied().unwrap_or(0);
        let quantity = format!("reversals of the effort of joint `{name}` per second");
        let title =
            format!("reversals of the effort of joint `{name}` so far, per second of the run");
        let finding = Finding::against(self.band, value, "Hz", quantity)
            .advise("Lower the gains that see noise, derivatives first, or filter what they see.");
        let explained = match finding.is_lost() {
            true => alternation::told(facts, worst, first),
            false => None,
        };
        let (why, help) = explained.unzip();
        let finding = finding.shown_at(facts, || {
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
        });
        let finding = match help {
            Some(help) => finding.advise(help),
            None => finding,
        };
        let so_far = count_so_far(&ticks, facts.trace.len(), run_s);
        finding.drawn(facts.curve(title, "Hz", so_far, self.band))
    }

    fn first_loss(&self) -> FirstLoss {
        FirstLoss::SoFar
    }
}

/// The ticks at which a joint's effort turns round; none where it is no number somewhere.
fn reversals_of(facts: &MotionFacts<'_>, joint: usize) -> Option<Vec<usize>> {
    let efforts = applied(facts, joint);
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
    let mut so_far = vec![0.0; ticks];
    for tick in reversals {
        so_far[*tick] = 1.0;
    }
    let mut count = 0.0;
    for value in &mut so_far {
        count += *value;
        *value = count / run_s;
    }
    so_far
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
