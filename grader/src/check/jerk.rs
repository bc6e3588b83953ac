//! jerk: the root mean square jerk of the TCP over the run \[m/s³\].
//!
//! The TCP's position is taken at every call of `control`, a period `T` apart; the jerk of four positions in a row is
//! `|p[k+3] - 3 p[k+2] + 3 p[k+1] - p[k]| / T³`. A run of fewer than four calls has none.

use super::{Finding, MotionFacts};
use crate::lab::model::Band;
use crate::record::grade::{Evidence, Measure};
use crate::record::graded::Curve;
use crate::record::quantity::{seconds, trimmed};

/// Judges the check.
pub fn judge(facts: &MotionFacts<'_>, band: Band, check: &str) -> Finding {
    let trace = facts.trace;
    let periods = &facts.motion.periods;
    let stride = periods.ticks_per_control.get() as usize;
    let period_s = periods.control_s();
    let places: Vec<_> = (0..trace.len())
        .step_by(stride)
        .map(|tick| trace.tcp_position(tick))
        .collect();
    let jerks: Vec<f64> = places
        .windows(4)
        .map(|p| {
            let third = p[3] - p[0] + 3.0 * (p[1] - p[2]);
            third.norm() / (period_s * period_s * period_s)
        })
        .collect();
    let squares: f64 = jerks.iter().map(|jerk| jerk * jerk).sum();
    let value = (squares / jerks.len().max(1) as f64).sqrt();
    let score = band.score(value);
    // the middle of the four
    let tick_of = |k: usize| (k * stride + 3 * stride / 2).min(trace.len().saturating_sub(1));
    let worst = (0..jerks.len())
        .max_by(|a, b| jerks[*a].total_cmp(&jerks[*b]).then(b.cmp(a)))
        .unwrap_or(0);
    let mut evidence = Vec::new();
    if score < 1.0 {
        let message = format!(
            "the TCP's jerk has a root mean square of {} m/s³, and is {} m/s³ around {}",
            trimmed(value, 2),
            trimmed(jerks.get(worst).copied().unwrap_or(f64::NAN), 2),
            seconds(facts.time_s(tick_of(worst))),
        );
        evidence.push(Evidence {
            value: value.is_finite().then_some(value),
            limit: Some(band.full),
            unit: "m/s³".to_owned(),
            ..facts.evidence(message, "tcp".to_owned(), tick_of(worst))
        });
    }
    Finding {
        insists: false,
        score,
        measure: Some(Measure {
            quantity: "root mean square jerk of the TCP".to_owned(),
            value: value.is_finite().then_some(value),
            unit: "m/s³".to_owned(),
            full: band.full,
            zero: band.zero,
        }),
        evidence,
        next_step: "Let the acceleration come and go smoothly, such as along a quintic.".to_owned(),
        curve: Some(Curve {
            check: check.to_owned(),
            title: "jerk of the TCP".to_owned(),
            unit: "m/s³".to_owned(),
            t_s: (0..jerks.len()).map(|k| facts.time_s(tick_of(k))).collect(),
            values: jerks,
            full: Some(band.full),
            zero: Some(band.zero),
            marks: Vec::new(),
            step: None,
        }),
    }
}

#[cfg(test)]
mod tests {
    use super::super::by_hand::{HandRow, judged, value};

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
    fn a_jolt_is_told_with_its_time() {
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
