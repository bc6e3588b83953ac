//! Goals that are reached one after the other in another order than the task has them.

use super::{Cause, Lost};
use crate::check::facts::MotionFacts;
use kinemark_sim::text::number::seconds;

/// A stay shorter than this share of what is asked for passes by.
const LEAST_STAY: f64 = 0.5;

pub(super) fn seen(lost: &Lost<'_>) -> Option<Cause> {
    let facts = lost.facts;
    let count = facts.motion.goals.len();
    // the first stay at each goal, whatever comes before it
    let stays: Vec<usize> = (0..count)
        .map(|goal| first_stay(facts, goal))
        .collect::<Option<_>>()?;
    let mut order: Vec<usize> = (0..count).collect();
    order.sort_by_key(|goal| stays[*goal]);
    if order.windows(2).all(|pair| pair[0] < pair[1]) {
        return None;
    }
    let visited: Vec<String> = order.iter().map(|goal| (goal + 1).to_string()).collect();
    let tick = stays[order[0]];
    Some(Cause {
        words: format!(
            "the hand stands at the goals in the order {}: at {} it is at goal {}",
            visited.join(", "),
            seconds(facts.time_s(tick)),
            visited[0],
        ),
        signal: "tcp".to_owned(),
        tick,
        question: Some(
            "In which order does the task have its goals? If that is yours, too: which way does each of your angles turn its joint?"
                .to_owned(),
        ),
    })
}

/// The tick at which the hand first stays near a goal.
fn first_stay(facts: &MotionFacts<'_>, goal: usize) -> Option<usize> {
    let near_m = facts.pose_band.zero.max(1e-3);
    let goal = &facts.motion.goals[goal];
    let least = (LEAST_STAY * goal.dwell_ticks as f64) as usize;
    let is_near = |tick: usize| (facts.trace.tcp_position(tick) - goal.position_m).norm() <= near_m;
    let mut since = None;
    for tick in 0..facts.trace.len() {
        match (is_near(tick), since) {
            (false, _) => since = None,
            (true, None) => since = Some(tick),
            (true, Some(began)) if tick - began >= least => return Some(began),
            (true, Some(_)) => {}
        }
    }
    None
}
