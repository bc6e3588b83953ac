//! effort-match: how far the efforts that `control` returns are from those that the prescribed motion takes \[N m or N, root mean square\].
//!
//! For mode `prescribed`, where the joints follow laws and a command moves nothing: it says which efforts the submission expects. They
//! are compared at the calls of `control`, for one joint or for the worst.

use kinemark_sim::control::Mode;

use crate::check::prelude::*;

/// The keys.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct Table {
    /// The joint; the one with the greatest difference where it is left out.
    joint: Option<At<String>>,
    /// Difference that earns all points \[N m, or N of a prismatic joint\].
    full_n_m: BandEnd,
    /// Difference that earns none.
    zero_n_m: BandEnd,
}

impl MotionTable for Table {
    const NAME: &'static str = "effort-match";
    type Check = InBand<EffortMatch>;

    fn lacks(task: &MotionTask) -> Option<&'static str> {
        (task.servo.mode != Mode::Prescribed).then_some("`mode = \"prescribed\"` in [tasks.motion]")
    }

    fn read(&self, reading: &MotionReading<'_>) -> Result<Self::Check, LabError> {
        let joint = reading.maybe_joint(self.joint.as_ref())?;
        let unit = reading.units(joint).effort();
        reading.in_band([self.full_n_m, self.zero_n_m], unit, EffortMatch(joint))
    }
}

/// Of the joint of this index in `q`; of the worst one where there is none.
#[derive(Debug)]
pub(crate) struct EffortMatch(Option<usize>);

impl RunMeasure for EffortMatch {
    fn judge(&self, facts: &MotionFacts<'_>, band: Band) -> Finding {
        let period = facts.motion.periods.ticks_per_control.get() as usize;
        let calls: Vec<usize> = (0..facts.applied_ticks()).step_by(period).collect();
        let trace = facts.trace;
        let off = |joint: usize| -> Vec<f64> {
            let differences = calls
                .iter()
                .map(|&tick| trace.command.at(tick)[joint] - trace.effort.at(tick)[joint]);
            differences.map(f64::abs).collect()
        };
        let (worst, value) = facts.worst_joint(self.0, |joint| root_mean_square(&off(joint)));
        let off = off(worst);
        let (name, unit) = (facts.joint_name(worst), facts.units(worst).effort());
        let quantity = format!("distance from the effort that the motion of joint `{name}` takes");
        let t_s = calls.iter().map(|&tick| facts.time_s(tick)).collect();
        let furthest = greatest(off.iter().copied()).map_or(0, |(call, _)| calls[call]);
        Finding::against(band, value, unit, quantity.clone())
            .drawn(curve(quantity, unit, t_s, off, Some(band)))
            .shown_at(facts, || {
                let [expected, taken] = [&trace.command, &trace.effort]
                    .map(|signal| trimmed(signal.at(furthest)[worst], 4));
                let message = format!(
                    "`control` is {} {unit} off the effort of joint `{name}` (root mean square); at {} it returns {expected}, and the \
                     motion takes {taken} {unit}",
                    trimmed(value, 4),
                    seconds(facts.time_s(furthest)),
                );
                (message, format!("command[{worst}]"), furthest)
            })
            .advise("Compare both curves in the effort plot: at rest only gravity is left, at constant speed there is no acceleration.")
    }
}

/// 0 of nothing.
fn root_mean_square(values: &[f64]) -> f64 {
    let squares: f64 = values.iter().map(|value| value * value).sum();
    (squares / values.len().max(1) as f64).sqrt()
}

#[cfg(test)]
mod tests {
    use crate::check::by_hand::{HandRow, judged, value};

    const MOTION: &str = "mode = \"prescribed\"\nduration_s = 1.0\n\
        laws = [{ joint = \"shoulder\", sine = { amplitude = 0.5, angular_frequency_rad_s = 2.0 } }]";
    const KIND: &str = "effort-match = { full_n_m = 1.0, zero_n_m = 5.0 }";

    #[test]
    fn the_worst_joint_is_compared_at_calls_of_control() {
        let finding = judged(MOTION, KIND, |t_s| HandRow {
            // 3 off half of the time, and far off where `control` is not called
            command: [1.0, 4.0],
            effort: [
                1.5,
                match (t_s * 1000.0).round() as u64 % 10 {
                    0 if t_s < 0.4999 => 7.0,
                    0 => 4.0,
                    _ => -90.0,
                },
            ],
            ..HandRow::default()
        });
        // sqrt(9 / 2)
        assert!((value(&finding) - 4.5_f64.sqrt()).abs() < 1e-12);
        let evidence = &finding.evidence[0];
        assert_eq!(
            (evidence.tick, evidence.signal.as_str()),
            (Some(0), "command[1]")
        );
        let shoulder = "effort-match = { joint = \"shoulder\", full_n_m = 1.0, zero_n_m = 5.0 }";
        let finding = judged(MOTION, shoulder, |_| HandRow {
            command: [1.0, 0.0],
            effort: [1.5, 50.0],
            ..HandRow::default()
        });
        assert_eq!((value(&finding), finding.score), (0.5, 1.0));
    }

    #[test]
    fn an_effort_that_is_no_number_earns_nothing() {
        let finding = judged(MOTION, KIND, |_| HandRow {
            command: [f64::NAN, 0.0],
            ..HandRow::default()
        });
        assert_eq!(finding.score, 0.0);
    }
}
