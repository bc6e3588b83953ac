//! joint-reached: a joint stands at a position for the last part of the run.
//!
//! Measured is the greatest distance from the position over the last `hold_s` \[rad or m\].

use std::ops::Range;

use kinemark_sim::model::robot::Robot;
use kinemark_sim::text::number::{seconds, trimmed};
use schemars::JsonSchema;
use serde::Deserialize;
use toml::Spanned;

use crate::check::contract::{CheckKind, FirstLoss, MotionCheck};
use crate::check::facts::MotionFacts;
use crate::check::finding::Finding;
use crate::check::reading::{InTask, NumberAt};
use crate::check::registry::MotionTable;
use crate::record::grade::Evidence;
use crate::task::joint_units::JointUnits;
use crate::task::model::Band;
use crate::task::problem::LabError;

/// The keys.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct Table {
    /// The joint.
    #[schemars(with = "String")]
    joint: Spanned<String>,
    /// Where it should stand \[rad, or m of a prismatic joint\].
    position_rad: f64,
    /// The part at the end of the run that counts \[s\]; a multiple of the physics step.
    #[schemars(with = "f64")]
    hold_s: NumberAt,
    /// Distance that earns all points.
    #[schemars(with = "f64")]
    full_rad: NumberAt,
    /// Distance that earns none.
    zero_rad: f64,
}

impl MotionTable for Table {
    const NAME: &'static str = "joint-reached";
    type Check = JointReached;

    fn read(&self, _: Range<usize>, reading: &InTask<'_>) -> Result<JointReached, LabError> {
        let full = &self.full_rad;
        Ok(JointReached {
            joint: reading.joint(&self.joint)?,
            position: self.position_rad,
            hold_ticks: reading.ticks(&self.hold_s, "`hold_s`")? as usize,
            band: reading
                .report
                .band(*full.get_ref(), self.zero_rad, full.span())?,
        })
    }
}

/// The check as read.
#[derive(Debug)]
pub(crate) struct JointReached {
    /// Index in `q`.
    joint: usize,
    /// Where it should stand \[rad or m\].
    position: f64,
    /// Ticks at the end in which it must stand there.
    hold_ticks: usize,
    band: Band,
}

impl CheckKind for JointReached {
    fn band(&self, robot: &Robot) -> Option<(Band, &'static str)> {
        Some((self.band, JointUnits::of(robot, self.joint).position()))
    }
}

impl MotionCheck for JointReached {
    fn judge(&self, facts: &MotionFacts<'_>) -> Finding {
        let joint = self.joint;
        let (name, unit) = (facts.joint_name(joint), facts.units(joint).position());
        let position = trimmed(self.position, 4);
        let last = facts.last_tick();
        let first = last.saturating_sub(self.hold_ticks);
        let error_at = |tick: usize| (facts.trace.q.at(tick)[joint] - self.position).abs();
        let worst = (first..=last)
            .max_by(|a, b| error_at(*a).total_cmp(&error_at(*b)))
            .unwrap_or(last);
        let value = error_at(worst);
        let quantity = format!("distance of joint `{name}` from {position} {unit}");
        let mut finding = Finding::against(self.band, value, unit, quantity);
        if finding.is_lost() {
            let counts_from = (first, worst);
            let message = self.message(facts, value, counts_from);
            finding = finding.with(Evidence {
                value: Some(facts.trace.q.at(worst)[joint]),
                limit: Some(self.position),
                unit: unit.to_owned(),
                ..facts.evidence(message, format!("q[{joint}]"), worst)
            });
        }
        let title = format!("distance of joint `{name}` from its target");
        let values = (0..facts.trace.len()).map(error_at).collect();
        let mut curve = facts.curve(title, unit, values, self.band);
        curve.marks = vec![(facts.time_s(first), "judged from here".to_owned())];
        finding
            .advise(format!(
                "Return {position} for joint `{name}` from `control`, at every call."
            ))
            .drawn(curve)
    }

    fn first_loss(&self) -> FirstLoss {
        FirstLoss::Evidence
    }
}

impl JointReached {
    /// Why points are lost: `value` off at tick `worst`, of those from `first` on.
    fn message(
        &self,
        facts: &MotionFacts<'_>,
        value: f64,
        (first, worst): (usize, usize),
    ) -> String {
        let (name, unit) = (
            facts.joint_name(self.joint),
            facts.units(self.joint).position(),
        );
        let position = trimmed(self.position, 4);
        let last = facts.last_tick();
        let at_end = facts.trace.q.at(last)[self.joint];
        let started = facts.trace.q.at(0)[self.joint];
        let is_to_move = (self.position - started).abs() > 1e-3;
        if is_to_move && (at_end - started).abs() < 1e-3 {
            format!(
                "joint `{name}` did not move: it stands at {} {unit}, {position} {unit} was asked for",
                trimmed(at_end, 4),
            )
        } else {
            format!(
                "joint `{name}` is {} {unit} from {position} {unit} at {}, within the last {} that count",
                trimmed(value, 4),
                seconds(facts.time_s(worst)),
                seconds(facts.time_s(last - first)),
            )
        }
    }
}
