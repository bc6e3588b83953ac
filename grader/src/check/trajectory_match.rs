//! trajectory-match: how far the TCP is from the reference's path, whichever time shift fits best \[m, root mean square\].
//!
//! Over `dwells`, each of the best stays is compared with the reference's stay at the same goal: between goals every road is
//! right, so only what the task fixes counts. Over the `run`, all of it is compared. Joint motion is never compared: other
//! branches are as good. A variant has numbers of its own and no path; where its reference dwells is at the goals.

use nalgebra::Vector3;

use super::{Finding, MotionFacts};
use crate::lab::model::{Band, MatchSpan, MotionGoal};
use crate::record::grade::{Evidence, Measure};
use crate::record::graded::TcpPath;
use crate::record::quantity::{metres, seconds};

/// Judges the check.
pub fn judge(
    facts: &MotionFacts<'_>,
    span: MatchSpan,
    max_shift_ticks: u64,
    band: Band,
) -> Finding {
    let matched = match (span, facts.reference) {
        (MatchSpan::Dwells, Some(reference)) => dwells(facts, reference),
        (MatchSpan::Dwells, None) => dwells_at_goals(facts),
        (MatchSpan::Run, reference) => {
            reference.and_then(|reference| run(facts, reference, max_shift_ticks))
        }
    };
    let value = matched
        .as_ref()
        .map_or(f64::INFINITY, |matched| matched.rms_m);
    let score = band.score(value);
    let mut evidence = Vec::new();
    if let Some(matched) = matched
        && score < 1.0
    {
        let message = format!(
            "{} from the reference's path (root mean square){}; the furthest is {} at {}",
            metres(matched.rms_m),
            matched.where_,
            metres(matched.furthest_m),
            seconds(facts.time_s(matched.furthest_tick)),
        );
        evidence.push(Evidence {
            value: Some(matched.rms_m),
            limit: Some(band.full),
            unit: "m".to_owned(),
            ..facts.evidence(message, "tcp".to_owned(), matched.furthest_tick)
        });
    }
    Finding {
        insists: false,
        score,
        measure: Some(Measure {
            quantity: "distance from the reference's path".to_owned(),
            value: value.is_finite().then_some(value),
            unit: "m".to_owned(),
            full: band.full,
            zero: band.zero,
        }),
        evidence,
        next_step: "Look at the path plot: the dashed line is the reference's.".to_owned(),
        curve: None,
    }
}

struct Matched {
    rms_m: f64,
    furthest_m: f64,
    furthest_tick: usize,
    where_: String,
}

/// Root mean square and furthest of `(tick, distance)`; `None` of nothing.
fn summary(distances: impl Iterator<Item = (usize, f64)>, where_: String) -> Option<Matched> {
    let (mut sum, mut count, mut furthest) = (0.0, 0.0, (0, 0.0));
    for (tick, distance) in distances {
        sum += distance * distance;
        count += 1.0;
        if distance > furthest.1 {
            furthest = (tick, distance);
        }
    }
    (count > 0.0).then(|| Matched {
        rms_m: (sum / count).sqrt(),
        furthest_m: furthest.1,
        furthest_tick: furthest.0,
        where_,
    })
}

fn point(path: &TcpPath, index: usize) -> Vector3<f64> {
    Vector3::from(path.points_m[index])
}

/// Compares the stays; the worst goal counts.
fn dwells(facts: &MotionFacts<'_>, reference: &TcpPath) -> Option<Matched> {
    let per_point = ticks_per_point(facts, reference);
    let windows = reference_dwells(reference, &facts.motion.goals, per_point)?;
    let mut worst: Option<Matched> = None;
    for (i, (stay, (first, last))) in facts.stays.iter().zip(windows).enumerate() {
        let points = last - first;
        let distances = (0..=points).filter_map(|k| {
            let tick = stay.first + k * per_point;
            (tick <= stay.last).then(|| {
                let gap = facts.trace.tcp_position(tick) - point(reference, first + k);
                (tick, gap.norm())
            })
        });
        let matched = summary(distances, at_goal(i))?;
        worst = Some(worse(worst, matched));
    }
    worst
}

/// Compares the stays with standing at the goals; the worst goal counts.
fn dwells_at_goals(facts: &MotionFacts<'_>) -> Option<Matched> {
    let goals = facts.motion.goals.iter();
    let mut worst: Option<Matched> = None;
    for (i, (stay, goal)) in facts.stays.iter().zip(goals).enumerate() {
        let distances = (stay.first..=stay.last).map(|tick| {
            let gap = facts.trace.tcp_position(tick) - goal.position_m;
            (tick, gap.norm())
        });
        let matched = summary(distances, at_goal(i))?;
        worst = Some(worse(worst, matched));
    }
    worst
}

fn at_goal(index: usize) -> String {
    format!(" during the dwell at goal {}", index + 1)
}

/// The worse of the two; of equal ones the first.
fn worse(known: Option<Matched>, found: Matched) -> Matched {
    match known {
        Some(known) if known.rms_m >= found.rms_m => known,
        _ => found,
    }
}

/// Where the reference dwells: for each goal in order, the earliest window that stays nearest to it.
fn reference_dwells(
    reference: &TcpPath,
    goals: &[MotionGoal],
    per_point: usize,
) -> Option<Vec<(usize, usize)>> {
    let near = 1e-3; // the reference stands within a millimetre, or it is no reference
    let mut windows = Vec::new();
    let mut from = 0;
    for goal in goals {
        let length = (goal.dwell_ticks as usize).div_ceil(per_point);
        let inside = |k: usize| (point(reference, k) - goal.position_m).norm() <= near;
        let mut run = 0;
        let mut found = None;
        for k in from..reference.points_m.len() {
            run = if inside(k) { run + 1 } else { 0 };
            if run > length {
                found = Some((k - length, k));
                break;
            }
        }
        let window = found?;
        from = window.1;
        windows.push(window);
    }
    Some(windows)
}

fn ticks_per_point(facts: &MotionFacts<'_>, reference: &TcpPath) -> usize {
    ((reference.period_s / facts.motion.periods.step_s).round() as usize).max(1)
}

/// Compares the whole run at the shift, in whole points of the path, that fits best; past its ends the path stands still.
fn run(facts: &MotionFacts<'_>, reference: &TcpPath, max_shift_ticks: u64) -> Option<Matched> {
    let per_point = ticks_per_point(facts, reference);
    let end = reference.points_m.len().checked_sub(1)? as i64;
    let most = (max_shift_ticks as usize / per_point) as i64;
    let mut best: Option<Matched> = None;
    for shift in -most..=most {
        let distances = (0..facts.trace.len()).step_by(per_point).map(|tick| {
            let k = ((tick / per_point) as i64 - shift).clamp(0, end) as usize;
            let gap = facts.trace.tcp_position(tick) - point(reference, k);
            (tick, gap.norm())
        });
        let shift_s = shift as f64 * reference.period_s;
        let matched = summary(distances, format!(" at a shift of {}", seconds(shift_s)))?;
        if best.as_ref().is_none_or(|best| matched.rms_m < best.rms_m) {
            best = Some(matched);
        }
    }
    best
}
