//! The ticks of a run that matter to a replay: those that can be shown, those that are stepped through, and those at which it is held
//! against the run.

use kinemark_sim::trace::Trace;

/// Time from one step to the next \[s\].
const PERIOD_S: f64 = 0.01;
/// Numbers of all rows looked at, at most: so many take 64 MB. Of a longer run not every tick is looked at.
const MOST_NUMBERS: usize = 8 << 20;

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

/// The ticks stepped through, of `ticks` ticks: one every period, those of `moments`, and the last.
pub(super) fn steps(step_s: f64, ticks: usize, moments: &[u64]) -> Vec<usize> {
    let stride = ((PERIOD_S / step_s).round() as usize).max(1);
    every(stride, ticks, moments)
}

/// The ticks at which rows of `numbers` numbers in all are looked at: all, if they are not too many, else evenly fewer, those of
/// `moments`, and the last.
pub(super) fn looked(ticks: usize, numbers: usize, moments: &[u64]) -> Vec<usize> {
    let stride = ticks.saturating_mul(numbers).div_ceil(MOST_NUMBERS).max(1);
    every(stride, ticks, moments)
}

fn every(stride: usize, ticks: usize, moments: &[u64]) -> Vec<usize> {
    let Some(last) = ticks.checked_sub(1) else {
        return Vec::new();
    };
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
    use kinemark_grader::record::sample;

    #[test]
    fn every_period_every_event_and_the_last() {
        assert_eq!(steps(0.001, 26, &[7, 10, 99]), [0, 7, 10, 20, 25]);
        assert_eq!(steps(0.002, 12, &[]), [0, 5, 10, 11]);
        assert_eq!(steps(0.05, 3, &[]), [0, 1, 2]);
        assert_eq!(steps(0.001, 1, &[5]), [0]);
        assert!(steps(0.001, 0, &[5]).is_empty());
    }

    #[test]
    fn of_a_long_run_with_much_to_look_at_not_every_tick_is() {
        assert_eq!(looked(10_001, 200, &[]).len(), 10_001);
        let long = looked(600_001, 200, &[7]);
        assert!(long.len() * 200 <= MOST_NUMBERS + 400, "{}", long.len());
        assert!(long.contains(&7) && long.ends_with(&[600_000]));
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
