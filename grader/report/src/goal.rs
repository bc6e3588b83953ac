//! Which goal the TCP is on its way to at a tick.

use kinemark_grader::record::graded::{Goal, TaskRun};

/// Index of the goal that is current at `tick`: the first whose judged stay has not ended; a goal without a stay remains current.
pub(crate) fn current_goal(goals: &[Goal], tick: u64) -> Option<usize> {
    let last = goals.len().checked_sub(1)?;
    let ahead = |goal: &Goal| goal.stay.is_none_or(|(_, end)| tick <= end);
    Some(goals.iter().position(ahead).unwrap_or(last))
}

/// Distance of the TCP to a goal at every tick \[m\].
pub(crate) fn distances_m<'a>(run: &'a TaskRun, goal: &'a Goal) -> impl Iterator<Item = f64> + 'a {
    let [gx, gy, gz] = goal.position_m;
    (0..run.trace.len()).map(move |tick| {
        let row = run.trace.tcp.at(tick);
        let (x, y, z) = (row[0] - gx, row[1] - gy, row[2] - gz);
        (x * x + y * y + z * z).sqrt()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn goal(stay: Option<(u64, u64)>) -> Goal {
        Goal {
            position_m: [0.0; 3],
            dwell_s: 0.5,
            full_m: 0.002,
            zero_m: 0.02,
            stay,
        }
    }

    #[test]
    fn the_next_goal_is_current_once_the_stay_has_ended() {
        let goals = [goal(Some((10, 20))), goal(Some((30, 40)))];
        let current: Vec<_> = [0, 20, 21, 99].map(|t| current_goal(&goals, t)).into();
        assert_eq!(current, [Some(0), Some(0), Some(1), Some(1)]);
    }

    #[test]
    fn a_goal_never_reached_stays_current() {
        assert_eq!(current_goal(&[goal(None), goal(None)], 99), Some(0));
        assert_eq!(current_goal(&[], 0), None);
    }
}
