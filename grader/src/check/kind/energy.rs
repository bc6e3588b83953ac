//! energy: the mechanical work of all motors, whichever its sign \[J\].
//!
//! `Σ |τ[k] (q[k+1] - q[k])|` over ticks and joints: the effort is held from tick to tick, so each term is the work over the step.
//! Work against a motor counts as much as work of it: brakes get hot, too.

use crate::check::prelude::*;

/// The keys.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct Table {
    /// Whether more is better: then all points from `full` on, and none up to `zero`; false where it is left out.
    #[serde(default)]
    at_least: bool,
    /// Work that earns all points \[J\].
    full_j: BandEnd,
    /// Work that earns none \[J\].
    zero_j: BandEnd,
}

impl MotionTable for Table {
    const NAME: &'static str = "energy";
    type Check = InBand<Energy>;

    fn read(&self, reading: &MotionReading<'_>) -> Result<Self::Check, LabError> {
        reading.in_band_either(self.at_least, [self.full_j, self.zero_j], "J", Energy)
    }
}

/// The work of all motors.
#[derive(Debug)]
pub(crate) struct Energy;

impl RunMeasure for Energy {
    fn judge(&self, facts: &MotionFacts<'_>, band: Band) -> Finding {
        let trace = facts.trace;
        let mut of_joints = vec![0.0; facts.robot.n()];
        let mut sum = 0.0;
        let mut so_far = vec![0.0];
        for tick in 0..facts.applied_ticks() {
            let moves = trace.q.at(tick + 1).iter().zip(trace.q.at(tick));
            let efforts = trace.effort.at(tick).iter().zip(&mut of_joints);
            for ((effort, of_joint), (to, from)) in efforts.zip(moves) {
                let work = (effort * (to - from)).abs();
                *of_joint += work;
                sum += work;
            }
            so_far.push(sum);
        }
        let curve = facts.curve("work of the motors so far", "J", so_far, band);
        Finding::of_curve(band, Statistic::SoFar, "J", "work of the motors", curve)
            .shown_at(facts, || {
                let (worst, of_worst) = facts.worst_joint(None, |joint| of_joints[joint]);
                let message = format!(
                    "the motors do {} J of work, {} J of it the one of joint `{}`",
                    trimmed(sum, 3),
                    trimmed(of_worst, 3),
                    facts.joint_name(worst)
                );
                (message, format!("effort[{worst}]"), facts.last_tick())
            })
            .advise(band.advice(
                "Take a shorter way, or a slower one that needs less braking.",
                "Let the motors do more: move further or faster.",
            ))
    }
}

#[cfg(test)]
mod tests {
    use crate::check::by_hand::{HandRow, judged, value};

    const MOTION: &str = "mode = \"effort\"\nduration_s = 1.0";
    const KIND: &str = "energy = { full_j = 3.0, zero_j = 7.0 }";

    #[test]
    fn work_of_and_against_the_motors_adds_up() {
        // 4 N m over half a radian there and back, and 2 N m over half a radian: 2 + 2 + 1
        let finding = judged(MOTION, KIND, |t_s| HandRow {
            q: [0.5 - (t_s - 0.5).abs(), -0.5 * t_s],
            effort: [4.0, 2.0],
            ..HandRow::default()
        });
        assert!((value(&finding) - 5.0).abs() < 1e-12);
        assert!((finding.score - 0.5).abs() < 1e-12);
        assert_eq!(
            finding.evidence[0].message,
            "the motors do 5 J of work, 4 J of it the one of joint `shoulder`"
        );
    }

    #[test]
    fn holding_still_is_no_work_and_no_number_earns_nothing() {
        let finding = judged(MOTION, KIND, |_| HandRow {
            effort: [50.0, 50.0],
            ..HandRow::default()
        });
        assert_eq!((value(&finding), finding.score), (0.0, 1.0));
        let finding = judged(MOTION, KIND, |_| HandRow {
            effort: [f64::NAN, 0.0],
            ..HandRow::default()
        });
        assert_eq!(finding.score, 0.0);
    }
}
