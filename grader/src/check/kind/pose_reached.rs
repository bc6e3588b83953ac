//! pose-reached: the TCP stays at every goal, in order, for the goal's dwell.
//!
//! Measured at each goal is the greatest distance during the best dwell \[m\]; the score is the mean of the goals' scores. Reported
//! is how near the arm settles before it leaves.

use kinemark_sim::control::Mode;

use crate::check::prelude::*;

/// The keys.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct Table {
    /// Distance from a goal that earns all points \[m\].
    full_m: BandEnd,
    /// Distance from a goal that earns none \[m\].
    zero_m: BandEnd,
}

impl MotionTable for Table {
    const NAME: &'static str = "pose-reached";
    type Check = InBand<PoseReached>;

    fn lacks(task: &MotionTask) -> Option<&'static str> {
        lacks_goals(task)
    }

    fn read(&self, reading: &MotionReading<'_>) -> Result<Self::Check, LabError> {
        reading.in_band([self.full_m, self.zero_m], "m", PoseReached)
    }
}

/// The distance from each goal during its dwell.
#[derive(Debug)]
pub(crate) struct PoseReached;

impl RunMeasure for PoseReached {
    fn judge(&self, facts: &MotionFacts<'_>, band: Band) -> Finding {
        let goals = 0..facts.motion.goals.len();
        let settled_m = |goal: usize| {
            let dwell = facts.dwells.get(goal);
            dwell.map_or(f64::INFINITY, |dwell| dwell.settled_m)
        };
        let score_of = |goal: usize| band.score(settled_m(goal));
        let score = goals.clone().map(score_of).sum::<f64>() / goals.len() as f64;
        let mut lost: Vec<usize> = goals.clone().filter(|goal| score_of(*goal) < 1.0).collect();
        lost.sort_by(|a, b| settled_m(*b).total_cmp(&settled_m(*a)));
        let settles = lost
            .first()
            .is_some_and(|&goal| settled(facts, goal, band).is_some());
        // what comes after a goal that the arm does not go to says the same again
        let untouched = |goal: usize| never_nearer(facts, goal, band).is_some();
        let first_untouched = lost.iter().copied().filter(|goal| untouched(*goal)).min();
        lost.retain(|goal| first_untouched.is_none_or(|first| *goal <= first || !untouched(*goal)));
        let evidence = lost.into_iter().map(|goal| evidence(facts, goal, band));
        let worst_m = goals.map(settled_m).fold(0.0, f64::max);
        let quantity = "greatest distance from a goal while it is held";
        let measure = measure(quantity, worst_m, "m", [band.full, band.zero]);
        let finding = Finding::scored(score, measure)
            .because(evidence.collect())
            .drawn(next_goal_curve(facts, band));
        if settles {
            // the angles are right, so a hint about them would be beside the point
            return Finding {
                insists: true,
                ..finding.advise("The place is right, and the arm was not there for long enough: stay there longer before you go on.")
            };
        }
        finding.advise("Compare the joint angles you command with those your inverse kinematics gives for the goal, and hold them until the dwell is over.")
    }

    fn judges_dwells(&self) -> bool {
        true
    }
}

/// The distance from a goal at a tick \[m\].
fn distance_m(facts: &MotionFacts<'_>, goal: usize, tick: usize) -> f64 {
    (facts.trace.tcp_position(tick) - facts.motion.goals[goal].position_m).norm()
}

/// The window that is judged at a goal: its first and last tick.
fn window(facts: &MotionFacts<'_>, goal: usize) -> Option<[usize; 2]> {
    let last = facts.dwells.get(goal)?.settled_last;
    let ticks = facts.motion.goals[goal].dwell_ticks as usize;
    Some([last.saturating_sub(ticks), last])
}

/// The first and last tick of the longest stretch of the judged window in which the TCP is as near as all points ask, if it lasts a twentieth
/// of the window: a shorter one is passing by.
fn settled(facts: &MotionFacts<'_>, goal: usize, band: Band) -> Option<[usize; 2]> {
    let [first, last] = window(facts, goal)?;
    let is_near = |tick: &usize| distance_m(facts, goal, *tick) <= band.full;
    let mut longest: Option<[usize; 2]> = None;
    let mut tick = first;
    while tick <= last {
        let count = (tick..=last).take_while(is_near).count();
        if count > longest.map_or(0, |[from, to]| to + 1 - from) {
            longest = Some([tick, tick + count - 1]);
        }
        tick += count + 1;
    }
    longest.filter(|[from, to]| 20 * (to - from) >= last - first)
}

/// A goal that the TCP does not go to.
struct NeverNearer {
    /// The tick from which on it should.
    from: usize,
    /// The goal that it held before, and until when, in words.
    held: String,
    nearest_m: f64,
}

/// Share of the way to a goal that the TCP must leave untouched for its best stay to say nothing.
const UNTOUCHED: f64 = 0.95;

/// Whether the TCP does not go to a goal: it stays where it was at the last goal that it held, or goes away.
fn never_nearer(facts: &MotionFacts<'_>, goal: usize, band: Band) -> Option<NeverNearer> {
    // a run that ended early has fewer dwells than goals
    let before = facts.dwells.iter().take(goal).enumerate();
    let mut held = before.filter(|(_, dwell)| band.score(dwell.settled_m) > 0.0);
    let (number, from) = held.next_back().map(|(i, dwell)| (i + 1, dwell.last))?;
    let nearest_m = (from..facts.trace.len())
        .map(|tick| distance_m(facts, goal, tick))
        .fold(f64::INFINITY, f64::min);
    let began_m = distance_m(facts, goal, from);
    (nearest_m >= UNTOUCHED * began_m && nearest_m > band.zero).then(|| NeverNearer {
        from,
        held: format!("goal {number}, over at {}", seconds(facts.time_s(from))),
        nearest_m,
    })
}

/// Why the goal with this index loses points.
fn evidence(facts: &MotionFacts<'_>, index: usize, band: Band) -> Evidence {
    let (number, goal) = (index + 1, &facts.motion.goals[index]);
    let position = list(goal.position_m.as_slice());
    let Some(dwell) = facts.dwells.get(index) else {
        let message = format!("the run ended before goal {number} at {position} was held");
        return facts.evidence(message, "tcp".to_owned(), facts.last_tick());
    };
    let [first, last] = window(facts, index).unwrap_or([dwell.first, dwell.last]);
    if let Some(stays) = never_nearer(facts, index, band) {
        let message = format!(
            "goal {number} at {position}: after the dwell at {} the TCP comes no nearer than {}",
            stays.held,
            metres(stays.nearest_m),
        );
        return Evidence {
            value: Some(dwell.settled_m),
            limit: Some(band.full),
            unit: "m".to_owned(),
            ..facts.evidence(message, "tcp".to_owned(), stays.from)
        };
    }
    // the earliest of the worst moments of the window
    let worst = (first..=last).fold(first, |worst, tick| {
        let is_worse = distance_m(facts, index, tick) > distance_m(facts, index, worst);
        if is_worse { tick } else { worst }
    });
    let p = facts.trace.tcp_position(worst);
    let away = p - goal.position_m;
    let mut message = format!(
        "goal {number} at {position}: in its best {}, from {} to {}, the TCP is up to {} away: at {} it is at {}, off by {} along x, y, z",
        seconds(facts.motion.periods.time_s(goal.dwell_ticks)),
        seconds(facts.time_s(first)),
        seconds(facts.time_s(last)),
        metres(dwell.settled_m),
        seconds(facts.time_s(worst)),
        list(p.as_slice()),
        list(away.as_slice()),
    );
    if facts.motion.servo.mode == Mode::Position {
        message += &format!(
            ", with the joints at {} under the command {}",
            list(facts.trace.q.at(worst)),
            list(facts.trace.command.at(worst)),
        );
    }
    match settled(facts, index, band) {
        Some([_, to]) if to == last => {
            let end = metres(distance_m(facts, index, last));
            message += &format!("; at the end it is {end} away: it was still settling");
        }
        Some([from, to]) => {
            message += &format!(
                "; it is within {} from {} to {} only: too short a stay",
                metres(band.full),
                seconds(facts.time_s(from)),
                seconds(facts.time_s(to)),
            );
        }
        None => {}
    }
    Evidence {
        value: Some(dwell.settled_m),
        limit: Some(band.full),
        unit: "m".to_owned(),
        ..facts.evidence(message, "tcp".to_owned(), worst)
    }
}

/// Distance from the goal that is next: the first until its dwell ends, then the second, and so on.
fn next_goal_curve(facts: &MotionFacts<'_>, band: Band) -> Curve {
    let goals = &facts.motion.goals;
    let distance_m = |tick: usize| {
        let done = facts.dwells.iter().take_while(|dwell| dwell.last < tick);
        let next = done.count().min(goals.len() - 1);
        (facts.trace.tcp_position(tick) - goals[next].position_m).norm()
    };
    let values = (0..facts.trace.len()).map(distance_m).collect();
    let marks = facts.dwells.iter().enumerate().map(|(i, dwell)| {
        let number = i + 1;
        let words = match band.score(dwell.settled_m) > 0.0 {
            true => format!("goal {number} held"),
            false => format!("best stay near goal {number} ends"),
        };
        (facts.time_s(dwell.last), words)
    });
    Curve {
        marks: marks.collect(),
        ..facts.curve("distance from the next goal", "m", values, band)
    }
}
