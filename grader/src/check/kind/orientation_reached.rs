//! orientation-reached: the TCP is turned as each goal asks while it stays there.
//!
//! Measured at each goal with `rpy_deg` or `axis` is the greatest angle by which the TCP is turned otherwise, over the same part of the
//! run that `pose-reached` judges \[rad\]; the score is the mean of these goals' scores. A goal that was never held, by the band of
//! `pose-reached`, earns nothing.

use super::finish_time::first_hold;
use crate::check::prelude::*;
use crate::task::model::GoalOrientation;

/// The keys.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct Table {
    /// Angle that earns all points \[rad\].
    full_rad: BandEnd,
    /// Angle that earns none \[rad\].
    zero_rad: BandEnd,
}

impl MotionTable for Table {
    const NAME: &'static str = "orientation-reached";
    type Check = InBand<OrientationReached>;

    fn lacks(task: &MotionTask) -> Option<&'static str> {
        let has_none = task.goals.iter().all(|goal| goal.orientation.is_none());
        has_none.then_some("`goals` with `rpy_deg` or `axis` in [tasks.motion]")
    }

    fn read(&self, reading: &MotionReading<'_>) -> Result<Self::Check, LabError> {
        reading.in_band([self.full_rad, self.zero_rad], "rad", OrientationReached)
    }
}

/// The angle from how each goal asks.
#[derive(Debug)]
pub(crate) struct OrientationReached;

/// A goal with an orientation, as it was held.
struct Held {
    /// Counted from 0.
    goal: usize,
    orientation: GoalOrientation,
    /// The greatest angle off \[rad\] and its tick; none where the goal was never held.
    worst: Option<(f64, usize)>,
}

impl Held {
    fn angle_rad(&self) -> f64 {
        self.worst.map_or(f64::INFINITY, |(angle_rad, _)| angle_rad)
    }
}

fn held(facts: &MotionFacts<'_>) -> Vec<Held> {
    let goals = facts.motion.goals.iter().enumerate();
    let turned = goals.filter_map(|(i, goal)| Some((i, goal, goal.orientation?)));
    turned
        .map(|(i, goal, orientation)| {
            let dwell = facts.dwells.get(i);
            let dwell = dwell.filter(|dwell| facts.pose_band.score(dwell.settled_m) > 0.0);
            let worst = dwell.map(|dwell| {
                let last = dwell.settled_last;
                let first = last.saturating_sub(goal.dwell_ticks as usize);
                let angle_rad =
                    |tick: usize| orientation.angle_rad(&facts.trace.tcp_rotation(tick));
                let worst = greatest((first..=last).map(angle_rad));
                worst.map_or((f64::NAN, last), |(i, angle_rad)| (angle_rad, first + i))
            });
            Held {
                goal: i,
                orientation,
                worst,
            }
        })
        .collect()
}

impl RunMeasure for OrientationReached {
    fn judge(&self, facts: &MotionFacts<'_>, band: Band) -> Finding {
        let held = held(facts);
        let scores = held.iter().map(|held| band.score(held.angle_rad()));
        let score = scores.sum::<f64>() / held.len() as f64;
        let worst = greatest(held.iter().map(Held::angle_rad));
        let worst_rad = worst.map_or(f64::NAN, |(_, angle_rad)| angle_rad);
        let mut lost: Vec<&Held> = held.iter().collect();
        lost.retain(|held| band.score(held.angle_rad()) < 1.0);
        lost.sort_by(|a, b| b.angle_rad().total_cmp(&a.angle_rad()));
        let first_missed = match lost.iter().all(|held| held.worst.is_none()) {
            true => lost.iter().map(|held| held.goal).min(),
            false => None,
        };
        let evidence = lost.into_iter().map(|held| evidence(facts, held, band));
        let quantity = "greatest angle from the orientation of a goal while it is held";
        let measure = measure(quantity, worst_rad, "rad", [band.full, band.zero]);
        let finding = Finding::scored(score, measure).because(evidence.collect());
        if let Some(goal) = first_missed {
            return first_hold(finding, goal);
        }
        finding.advise("Which joint turns the hand without moving it? Compare its angle with what the goal asks for.")
    }
}

fn evidence(facts: &MotionFacts<'_>, held: &Held, band: Band) -> Evidence {
    let number = held.goal + 1;
    let Some((angle_rad, tick)) = held.worst else {
        let message = format!("goal {number} was never held, so its orientation cannot be judged");
        return facts.evidence(message, "tcp".to_owned(), facts.last_tick());
    };
    let rotation = facts.trace.tcp_rotation(tick);
    let mut message = format!(
        "goal {number}: while it is held the TCP is turned up to {} degrees away, at {}",
        trimmed(angle_rad.to_degrees(), 2),
        seconds(facts.time_s(tick)),
    );
    if let GoalOrientation::Axis { of_tcp, along } = held.orientation {
        message += &format!(
            ": its axis {} points along {}, not {}",
            list(of_tcp.as_slice()),
            list((rotation * of_tcp).as_slice()),
            list(along.as_slice()),
        );
    }
    Evidence {
        value: Some(angle_rad),
        limit: Some(band.full),
        unit: "rad".to_owned(),
        ..facts.evidence(message, "tcp".to_owned(), tick)
    }
}
