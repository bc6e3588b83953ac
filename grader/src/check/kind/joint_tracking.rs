//! joint-tracking: how far a joint is from a law of motion, `q(t)`, over the run or a part of it \[root mean square, rad or m\].
//!
//! The law is what the brief asks for; `control` may follow it by any means. An arm that stays is as far off as the law goes.

use kinemark_sim::text::Problem;
use kinemark_sim::trajectory::{JointLaw, TrajectoryError};

use crate::check::prelude::*;
use crate::task::law::LawOf;

problems! {
    /// A law that cannot be followed.
    enum LawProblem {
        Kind:
            "lab::law", "a law is one of `constant`, `polynomial`, `sine`, `trapezoid` and `table`", "this law",
            "give exactly one of them, such as `law = { sine = { amplitude = 0.5, angular_frequency_rad_s = 1.0 } }`";
        Trajectory { error: TrajectoryError }:
            "lab::law", "{error}", "this law";
        Part { from_s: f64, to_s: f64 }:
            "lab::law", "the part that counts ends before it begins, got {from_s} s to {to_s} s", "this part",
            "exchange the two";
    }
}

/// The keys.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct Table {
    /// A joint that moves.
    joint: At<String>,
    /// Its law: one of those of [prescribed motion](#prescribed-motion), such as `{ sine = { amplitude = 0.5, angular_frequency_rad_s = 1.0 } }`.
    law: At<LawOf>,
    /// Where the part of the run begins that counts \[s\]; the start where it is left out.
    from_s: Option<At<f64>>,
    /// Where it ends \[s\]; the end of the run where it is left out.
    to_s: Option<At<f64>>,
    /// Distance that earns all points \[rad, or m of a prismatic joint\].
    full_rad: BandEnd,
    /// Distance that earns none.
    zero_rad: BandEnd,
}

impl MotionTable for Table {
    const NAME: &'static str = "joint-tracking";
    type Check = InBand<JointTracking>;

    fn read(&self, reading: &MotionReading<'_>) -> Result<Self::Check, LabError> {
        let joint = reading.joint(&self.joint)?;
        let refuse = |problem: LawProblem| -> Result<JointLaw, LabError> {
            reading.refuse_at(&self.law, problem)
        };
        let law = match self.law.get_ref().law() {
            None => refuse(LawProblem::Kind)?,
            Some(Err(error)) => refuse(LawProblem::Trajectory { error })?,
            Some(Ok(law)) => law,
        };
        let [first, last] = reading.part_of_run(
            self.from_s.as_ref(),
            self.to_s.as_ref(),
            |from_s, to_s| -> Box<dyn Problem> { Box::new(LawProblem::Part { from_s, to_s }) },
        )?;
        let unit = reading.units(Some(joint)).position();
        let measure = JointTracking {
            joint,
            law,
            first,
            last,
        };
        reading.in_band([self.full_rad, self.zero_rad], unit, measure)
    }
}

/// The distance of a joint from a law.
#[derive(Debug)]
pub(crate) struct JointTracking {
    /// Index in `q`.
    joint: usize,
    law: JointLaw,
    /// The first tick that counts.
    first: usize,
    /// The last one.
    last: usize,
}

impl RunMeasure for JointTracking {
    fn judge(&self, facts: &MotionFacts<'_>, band: Band) -> Finding {
        let joint = self.joint;
        let (name, unit) = (facts.joint_name(joint), facts.units(joint).position());
        let asked = |tick: usize| self.law.at(facts.time_s(tick)).position;
        let is = |tick: usize| facts.trace.q.at(tick)[joint];
        let last = self.last.min(facts.last_tick());
        let first = self.first.min(last);
        // what does not count is a gap of the curve
        let error = |tick: usize| match (first..=last).contains(&tick) {
            true => (is(tick) - asked(tick)).abs(),
            false => f64::NAN,
        };
        let errors: Vec<f64> = (0..facts.trace.len()).map(error).collect();
        let counted = &errors[first..=last];
        let value = Statistic::RootMeanSquare.of(counted);
        let quantity = format!("root mean square distance of joint `{name}` from its law");
        let title = format!("distance of joint `{name}` from its law");
        let mut finding = Finding::against(band, value, unit, quantity);
        finding.statistic = Some(Statistic::RootMeanSquare);
        let (worst, _) = greatest(counted.iter().copied()).unwrap_or_default();
        let worst = first + worst;
        finding
            .shown_at(facts, || {
                let message = format!(
                    "joint `{name}` is at {} {unit} at {}, where its law is at {} {unit}: there it is furthest off",
                    trimmed(is(worst), 4),
                    seconds(facts.time_s(worst)),
                    trimmed(asked(worst), 4),
                );
                (message, format!("q[{joint}]"), worst)
            })
            .advise(format!(
                "Is joint `{name}` late, or off by a constant? The first asks for the law's velocity and acceleration in your command, the second \
                 for what holds it against gravity and friction."
            ))
            .drawn(facts.curve(title, unit, errors.clone(), band))
    }
}

#[cfg(test)]
mod tests {
    use crate::check::by_hand::{HandRow, judged, value};

    const MOTION: &str = "mode = \"effort\"\nduration_s = 1.0";

    #[test]
    fn a_joint_that_lags_is_off_by_its_lag() {
        let kind = "joint-tracking = { joint = \"elbow\", law = { polynomial = [0.1, 0.5] }, full_rad = 0.01, zero_rad = 0.09 }";
        let of = |elbow: fn(f64) -> f64| {
            judged(MOTION, kind, |t_s| HandRow {
                q: [0.0, elbow(t_s)],
                ..HandRow::default()
            })
        };
        let right = of(|t_s| 0.1 + 0.5 * t_s);
        assert!(value(&right) < 1e-12 && right.score == 1.0, "{right:?}");
        // 0.1 s late
        let late = of(|t_s| 0.05 + 0.5 * t_s);
        assert!((value(&late) - 0.05).abs() < 1e-12, "{late:?}");
        assert!((late.score - 0.5).abs() < 1e-9);
        let message = &late.evidence[0].message;
        assert!(message.starts_with("joint `elbow` is at "), "{message}");
    }

    #[test]
    fn only_the_part_that_is_named_counts() {
        let kind = "joint-tracking = { joint = \"elbow\", law = { constant = 0.3 }, from_s = 0.5, full_rad = 0.01, zero_rad = 0.1 }";
        let finding = judged(MOTION, kind, |t_s| HandRow {
            q: [0.0, if t_s < 0.4999 { -9.0 } else { 0.3 }],
            ..HandRow::default()
        });
        assert_eq!((value(&finding), finding.score), (0.0, 1.0));
    }
}
