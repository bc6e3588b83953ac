//! effort-saturation: for how long some joint's effort is at its limit \[s\].

use std::ops::Range;

use kinemark_sim::model::robot::Robot;
use kinemark_sim::text::number::{seconds, trimmed};
use schemars::JsonSchema;
use serde::Deserialize;

use crate::check::contract::{CheckKind, FirstLoss, MotionCheck};
use crate::check::facts::MotionFacts;
use crate::check::finding::Finding;
use crate::check::reading::InTask;
use crate::check::registry::MotionTable;
use crate::record::grade::Evidence;
use crate::task::model::Band;
use crate::task::problem::LabError;

/// The keys.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct Table {
    /// Time that earns all points \[s\].
    full_s: f64,
    /// Time that earns none \[s\].
    zero_s: f64,
}

impl MotionTable for Table {
    const NAME: &'static str = "effort-saturation";
    type Check = EffortSaturation;

    fn read(&self, at: Range<usize>, reading: &InTask<'_>) -> Result<EffortSaturation, LabError> {
        let band = reading.report.band(self.full_s, self.zero_s, at)?;
        Ok(EffortSaturation { band })
    }
}

/// The check as read.
#[derive(Debug)]
pub(crate) struct EffortSaturation {
    band: Band,
}

impl CheckKind for EffortSaturation {
    fn band(&self, _: &Robot) -> Option<(Band, &'static str)> {
        Some((self.band, "s"))
    }
}

/// A tick with a joint whose effort is at its limit there.
type AtLimit = (usize, usize);

/// The time at a limit.
struct Saturation {
    /// The time so far, at every tick \[s\].
    so_far_s: Vec<f64>,
    /// Where it began.
    first: Option<AtLimit>,
    /// Where the time that earns everything was used up.
    breach: Option<AtLimit>,
}

impl EffortSaturation {
    fn measure(&self, facts: &MotionFacts<'_>) -> Saturation {
        let gains = &facts.motion.servo.gains;
        let at_limit = |tick: usize| {
            let mut efforts = facts.trace.effort.at(tick).iter().zip(gains);
            efforts.position(|(effort, gains)| effort.abs() >= gains.effort_limit)
        };
        let mut count = 0;
        let (mut first, mut breach) = (None, None);
        let so_far_s = (0..facts.trace.len()).map(|tick| {
            if tick < facts.applied_ticks()
                && let Some(joint) = at_limit(tick)
            {
                count += 1;
                first.get_or_insert((tick, joint));
                if facts.time_s(count) > self.band.full {
                    breach.get_or_insert((tick, joint));
                }
            }
            facts.time_s(count)
        });
        Saturation {
            so_far_s: so_far_s.collect(),
            first,
            breach,
        }
    }

    /// Where the time allowed was used up, and by which joint.
    fn evidence(&self, facts: &MotionFacts<'_>, saturation: &Saturation) -> Option<Evidence> {
        let (tick, joint) = saturation.breach?;
        let value = *saturation.so_far_s.last()?;
        let started = saturation.first.map_or(tick, |(tick, _)| tick);
        let message = format!(
            "efforts are at their limit for {} in all, first at {}; the {} allowed are used up at {} by joint `{}` at {} {}",
            seconds(value),
            seconds(facts.time_s(started)),
            seconds(self.band.full),
            seconds(facts.time_s(tick)),
            facts.joint_name(joint),
            trimmed(facts.trace.effort.at(tick)[joint], 3),
            facts.units(joint).effort(),
        );
        Some(Evidence {
            value: Some(value),
            limit: Some(self.band.full),
            unit: "s".to_owned(),
            ..facts.evidence(message, format!("effort[{joint}]"), tick)
        })
    }
}

impl MotionCheck for EffortSaturation {
    fn judge(&self, facts: &MotionFacts<'_>) -> Finding {
        let what = "time with an effort at its limit";
        let saturation = self.measure(facts);
        let value = saturation.so_far_s.last().copied().unwrap_or(0.0);
        let evidence = self.evidence(facts, &saturation);
        let finding = Finding::against(self.band, value, "s", what);
        let evidence = evidence.filter(|_| finding.is_lost());
        finding
            .because(evidence.into_iter().collect())
            .advise("Ask for smaller steps: spread the move over more time.")
            .drawn(facts.curve(what, "s", saturation.so_far_s, self.band))
    }

    fn first_loss(&self) -> FirstLoss {
        FirstLoss::SoFar
    }
}
