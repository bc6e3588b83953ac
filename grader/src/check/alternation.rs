//! A feedback that turns round at every sample: too strong for the period at which it is sampled, in words.
//!
//! A *turn* is a step of the signal against the one before. Where four of five samples of a window are turns, and the signal's
//! range there is more than 1 % of its greatest size, each sample overcorrects the one before.

use kinemark_sim::control::Mode;
use kinemark_sim::text::number::trimmed;

use super::facts::MotionFacts;

/// Fewer samples say nothing.
const LEAST_SAMPLES: usize = 6;

/// Whether the samples turn round, nearly each.
fn alternates(samples: &[f64]) -> bool {
    if samples.len() < LEAST_SAMPLES {
        return false;
    }
    let (low, high) = samples
        .iter()
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), sample| {
            (low.min(*sample), high.max(*sample))
        });
    let is_wide = high - low > 0.01 * low.abs().max(high.abs());
    let turns = samples
        .windows(3)
        .filter(|three| (three[1] - three[0]) * (three[2] - three[1]) < 0.0)
        .count();
    is_wide && 5 * turns >= 4 * (samples.len() - 2)
}

/// Why joint `joint` rattles from tick `first` on, and what to do about it; none where neither its command nor its servo turns
/// round at every sample.
pub(super) fn explained(
    facts: &MotionFacts<'_>,
    joint: usize,
    first: usize,
) -> Option<(String, String)> {
    let trace = facts.trace;
    let periods = &facts.motion.periods;
    // the efforts of the last row are never applied
    let applied = trace.len().saturating_sub(1);
    let from_first = |stride: usize| (first.next_multiple_of(stride)..applied).step_by(stride);
    let control = periods.ticks_per_control.get() as usize;
    let commands: Vec<f64> = from_first(control)
        .map(|tick| trace.command.at(tick)[joint])
        .collect();
    if alternates(&commands) {
        let period_ms = trimmed(periods.control_s() * 1e3, 4);
        return Some((
            format!(
                "its command turns round at every control period of {period_ms} ms: the gains are too high for that period"
            ),
            format!(
                "Lower the gains: a command is held for {period_ms} ms before you see what it did, and each one now overcorrects the one before."
            ),
        ));
    }
    let servo = control.min(periods.ticks_per_servo.get() as usize);
    let efforts: Vec<f64> = from_first(servo)
        .map(|tick| trace.effort.at(tick)[joint])
        .collect();
    if facts.motion.servo.mode != Mode::Effort && alternates(&efforts) {
        let period_ms = trimmed(periods.servo_s() * 1e3, 4);
        return Some((
            format!(
                "its servo turns the effort round at every servo period of {period_ms} ms: the servo's gains are too high for that period"
            ),
            "This is the task's own servo, not your code: tell your instructor.".to_owned(),
        ));
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_turns_round_at_each_sample_alternates() {
        let rattle: Vec<f64> = (0..20)
            .map(|k| if k % 2 == 0 { 5.0 } else { -4.0 })
            .collect();
        assert!(alternates(&rattle));
        assert!(!alternates(&rattle[..5]));
        let swing: Vec<f64> = (0..20).map(|k| libm::sin(f64::from(k))).collect();
        assert!(!alternates(&swing));
        // noise of a millionth on a command that stands
        let still: Vec<f64> = rattle.iter().map(|x| 3.0 + 1e-6 * x).collect();
        assert!(!alternates(&still));
        assert!(!alternates(&[f64::NAN; 20]));
    }
}
