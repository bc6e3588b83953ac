//! jerk: the root mean square jerk of the TCP over the run \[m/s³\].
//!
//! The TCP's position is taken at every call of `control`, a period `T` apart; the jerk of four positions in a row is
//! `|p[k+3] - 3 p[k+2] + 3 p[k+1] - p[k]| / T³`. A run of fewer than four calls has none.

use crate::check::prelude::*;

/// The keys.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct Table {
    /// Jerk that earns all points \[m/s³\].
    full_m_s3: BandEnd,
    /// Jerk that earns none \[m/s³\].
    zero_m_s3: BandEnd,
}

impl MotionTable for Table {
    const NAME: &'static str = "jerk";
    type Check = InBand<Jerk>;

    fn read(&self, reading: &MotionReading<'_>) -> Result<Self::Check, LabError> {
        reading.in_band([self.full_m_s3, self.zero_m_s3], "m/s³", Jerk)
    }
}

/// The jerk of the TCP.
#[derive(Debug)]
pub(crate) struct Jerk;

impl RunMeasure for Jerk {
    fn judge(&self, facts: &MotionFacts<'_>, band: Band) -> Finding {
        let stride = facts.motion.periods.ticks_per_control.get() as usize;
        let jerks = jerks_m_s3(facts, stride);
        let (worst, of_worst) = greatest(jerks.iter().copied()).unwrap_or((0, f64::NAN));
        // the middle of the four
        let tick_of = |k: usize| (k * stride + 3 * stride / 2).min(facts.last_tick());
        let t_s = (0..jerks.len()).map(|k| facts.time_s(tick_of(k))).collect();
        let quantity = "root mean square jerk of the TCP";
        let value = Statistic::RootMeanSquare.of(&jerks);
        // single moments may be far above the mean, so the band is no limit for them
        let curve = curve("jerk of the TCP", "m/s³", t_s, jerks, None);
        Finding::of_curve(band, Statistic::RootMeanSquare, "m/s³", quantity, curve)
            .shown_at(facts, || {
                let message = format!(
                    "the TCP's jerk has a root mean square of {} m/s³, and is {} m/s³ around {}",
                    trimmed(value, 2),
                    trimmed(of_worst, 2),
                    seconds(facts.time_s(tick_of(worst))),
                );
                (message, "tcp".to_owned(), tick_of(worst))
            })
            .advise("Let the acceleration come and go smoothly, such as along a quintic.")
    }
}

/// The jerk of every four positions in a row, `stride` ticks apart \[m/s³\].
fn jerks_m_s3(facts: &MotionFacts<'_>, stride: usize) -> Vec<f64> {
    let period_s = facts.motion.periods.control_s();
    let ticks = (0..facts.trace.len()).step_by(stride);
    let p_tcp_m: Vec<_> = ticks.map(|tick| facts.trace.tcp_position(tick)).collect();
    let jerks = p_tcp_m.windows(4).map(|p| {
        let third = p[3] - p[0] + 3.0 * (p[1] - p[2]);
        third.norm() / (period_s * period_s * period_s)
    });
    jerks.collect()
}

#[cfg(test)]
mod tests {
    use crate::check::by_hand::{HandRow, judged, value};

    const MOTION: &str = "mode = \"effort\"\nduration_s = 1.0";

    #[test]
    fn a_turning_arm_has_radius_times_the_cube_of_its_rate() {
        // 1 rad/s about the shoulder, the TCP 2 m above it and 0.05 m along its axis: 2 m/s³ without a break
        let kind = "jerk = { full_m_s3 = 1.0, zero_m_s3 = 3.0 }";
        let finding = judged(MOTION, kind, |t_s| HandRow {
            q: [t_s, 0.0],
            ..HandRow::default()
        });
        // chords for arcs: (2 sin(T/2)/T)³, short by T²/8
        assert!((value(&finding) - 2.0).abs() < 2.0 * 1.3e-5);
        assert!((finding.score - 0.5).abs() < 1e-4);
        let still = judged(MOTION, kind, |_| HandRow::default());
        assert_eq!((value(&still), still.score), (0.0, 1.0));
    }

    #[test]
    fn a_jolt_is_reported_with_its_time() {
        let kind = "jerk = { full_m_s3 = 0.0, zero_m_s3 = 1.0 }";
        let finding = judged(MOTION, kind, |t_s| HandRow {
            q: [if t_s > 0.495 { 1e-4 } else { 0.0 }, 0.0],
            ..HandRow::default()
        });
        // one step of 0.2 mm gives 1, -2 and 1 times 0.2 mm / 1e-6 s³ among 98
        let expected = 200.0 * (6.0_f64 / 98.0).sqrt();
        assert!((value(&finding) - expected).abs() < 1e-4 * expected);
        assert!(
            finding.evidence[0]
                .message
                .contains("is 400 m/s³ around 0.495 s")
        );
        assert_eq!(finding.score, 0.0);
        let lost = judged(MOTION, kind, |_| HandRow {
            q: [f64::NAN, 0.0],
            ..HandRow::default()
        });
        assert_eq!(lost.score, 0.0);
    }
}
