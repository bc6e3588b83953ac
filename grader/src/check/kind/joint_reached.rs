//! joint-reached: a joint stands at a position for the last part of the run.
//!
//! Measured is the greatest distance from the position over the last `hold_s` \[rad or m\].

use crate::check::prelude::*;

/// The keys.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct Table {
    /// The joint.
    joint: At<String>,
    /// Where it should stand \[rad, or m of a prismatic joint\].
    position_rad: f64,
    /// The part at the end of the run that counts \[s\]; a multiple of the physics step.
    hold_s: At<f64>,
    /// Distance that earns all points.
    full_rad: BandEnd,
    /// Distance that earns none.
    zero_rad: BandEnd,
}

impl MotionTable for Table {
    const NAME: &'static str = "joint-reached";
    type Check = InBand<JointReached>;

    fn read(&self, reading: &MotionReading<'_>) -> Result<Self::Check, LabError> {
        let measure = JointReached {
            joint: reading.joint(&self.joint)?,
            position: self.position_rad,
            hold_ticks: reading.ticks(&self.hold_s, "`hold_s`")? as usize,
        };
        let unit = reading.units(Some(measure.joint)).position();
        reading.in_band([self.full_rad, self.zero_rad], unit, measure)
    }
}

/// The distance of a joint from a position.
#[derive(Debug)]
pub(crate) struct JointReached {
    /// Index in `q`.
    joint: usize,
    /// Where it should stand \[rad or m\].
    position: f64,
    /// Ticks at the end in which it must stand there.
    hold_ticks: usize,
}

impl RunMeasure for JointReached {
    fn judge(&self, facts: &MotionFacts<'_>, band: Band) -> Finding {
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
        let mut finding = Finding::against(band, value, unit, quantity);
        if finding.is_lost() {
            let message = self.message(facts, value, (first, worst));
            finding = finding.with(Evidence {
                value: Some(facts.trace.q.at(worst)[joint]),
                limit: Some(self.position),
                unit: unit.to_owned(),
                ..facts.evidence(message, format!("q[{joint}]"), worst)
            });
        }
        let title = format!("distance of joint `{name}` from its target");
        let values = (0..facts.trace.len()).map(error_at).collect();
        let mut curve = facts.curve(title, unit, values, band);
        curve.marks = vec![(facts.time_s(first), "judged from here".to_owned())];
        finding
            .advise(format!(
                "Return {position} for joint `{name}` from `control`, at every call."
            ))
            .drawn(curve)
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
                "joint `{name}` is where it began at the end, at {} {unit}: {position} {unit} was asked for",
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
