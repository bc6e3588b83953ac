//! The ticks that a replay shows: at a fixed period, at every event, and the last.

use kinemark_sim::trace::Trace;

/// Time from one frame to the next \[s\].
const PERIOD_S: f64 = 0.01;

/// Ticks of a run that can be shown: those before the first row with a number that is not finite.
pub(super) fn sound_ticks(trace: &Trace) -> usize {
    let finite = |row: &[f64]| row.iter().all(|x| x.is_finite());
    (0..trace.len())
        .find(|tick| {
            !(finite(trace.q.at(*tick))
                && finite(trace.tcp.at(*tick))
                && finite(trace.bodies.at(*tick)))
        })
        .unwrap_or(trace.len())
}

/// The ticks of the frames, of `ticks` ticks: every `coarseness` periods, those of `moments`, and the last.
pub(super) fn frames(step_s: f64, ticks: usize, coarseness: usize, moments: &[u64]) -> Vec<usize> {
    let Some(last) = ticks.checked_sub(1) else {
        return Vec::new();
    };
    let stride = ((PERIOD_S / step_s).round() as usize)
        .max(1)
        .saturating_mul(coarseness);
    let mut frames: Vec<usize> = (0..ticks).step_by(stride).collect();
    frames.extend(moments.iter().map(|tick| (*tick as usize).min(last)));
    frames.push(last);
    frames.sort_unstable();
    frames.dedup();
    frames
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::sample;

    #[test]
    fn every_period_every_event_and_the_last() {
        assert_eq!(frames(0.001, 26, 1, &[7, 10, 99]), [0, 7, 10, 20, 25]);
        assert_eq!(frames(0.001, 41, 2, &[]), [0, 20, 40]);
        assert_eq!(frames(0.002, 12, 1, &[]), [0, 5, 10, 11]);
        assert_eq!(frames(0.05, 3, 1, &[]), [0, 1, 2]);
        assert_eq!(frames(0.001, 1, 1, &[5]), [0]);
        assert!(frames(0.001, 0, 1, &[5]).is_empty());
    }

    #[test]
    fn a_row_that_is_not_finite_ends_what_is_shown() {
        let broken = |at: u64| {
            sample::chain(
                2,
                30,
                move |tick, _| if tick == at { f64::NAN } else { 0.5 },
            )
        };
        assert_eq!(sound_ticks(&broken(12).trace), 12);
        assert_eq!(sound_ticks(&broken(0).trace), 0);
        assert_eq!(sound_ticks(&broken(99).trace), 30);
    }
}
