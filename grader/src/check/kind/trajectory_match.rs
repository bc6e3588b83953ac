//! trajectory-match: how far the TCP is from the reference's, whichever time shift fits best \[m, root mean square\].
//!
//! Over `dwells`, each of the best dwells is compared with the reference's dwell at the same goal, point by point from their
//! beginnings, and the worst goal counts: between goals every path is right. The reference's path is that of `practice.json`; in a
//! variant of which it has none, the goals stand for it. Over the `run`, all of it is compared with the run of the reference solution in
//! the same variant, at the shift that fits best: only where the brief prescribes the motion. That needs the solution, so in practice
//! it is judged when the submission is handed in. Joint motion is never compared: other branches are as good.

use nalgebra::Vector3;

use crate::check::prelude::*;
use crate::record::graded::TcpPath;
use crate::task::model::MotionGoal;

/// The part of a run that is compared with the reference's path.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum Span {
    /// The dwells at the goals.
    Dwells,
    /// The whole run.
    Run,
}

problems! {
    /// What cannot be compared.
    enum MatchProblem {
        NoGoals:
            "lab::trajectory_match", "there are no dwells to compare: this task has no `goals`", "this check",
            "compare over the `run`, or add goals";
        ShiftOfDwells:
            "lab::trajectory_match", "`max_shift_s` has no meaning over `dwells`, which are found wherever they are", "this check",
            "remove it";
        Shift { shift_s: f64 }:
            "lab::trajectory_match", "`max_shift_s` must be 0 to 60 s, got {shift_s}", "this check", "change it";
    }
}

/// The keys.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct Table {
    /// The part that is compared: `dwells` or `run`.
    over: Span,
    /// Greatest time shift in either direction \[s\], up to 60; 0 where it is left out. Over `run` only.
    max_shift_s: Option<f64>,
    /// Distance that earns all points \[m\].
    full_m: f64,
    /// Distance that earns none \[m\].
    zero_m: f64,
}

impl MotionTable for Table {
    const NAME: &'static str = "trajectory-match";
    type Check = InBand<TrajectoryMatch>;

    fn read(&self, reading: &MotionReading<'_>) -> Result<Self::Check, LabError> {
        if self.over == Span::Dwells && reading.motion.goals.is_empty() {
            return reading.refuse(MatchProblem::NoGoals);
        }
        let max_shift_s = match (self.over, self.max_shift_s) {
            (Span::Dwells, Some(_)) => return reading.refuse(MatchProblem::ShiftOfDwells),
            (_, None) => 0.0,
            (Span::Run, Some(shift_s)) if (0.0..=60.0).contains(&shift_s) => shift_s,
            (Span::Run, Some(shift_s)) => return reading.refuse(MatchProblem::Shift { shift_s }),
        };
        let measure = TrajectoryMatch {
            span: self.over,
            max_shift_ticks: (max_shift_s / reading.motion.periods.step_s).round() as u64,
        };
        reading.in_band([self.full_m, self.zero_m], "m", measure)
    }
}

/// The distance from the reference's path.
#[derive(Debug)]
pub(crate) struct TrajectoryMatch {
    span: Span,
    /// Greatest time shift, in ticks.
    max_shift_ticks: u64,
}

impl RunMeasure for TrajectoryMatch {
    fn judge(&self, facts: &MotionFacts<'_>, band: Band) -> Finding {
        let matched = match (self.span, facts.reference) {
            (Span::Dwells, Some(reference)) => dwells(facts, reference),
            (Span::Dwells, None) => dwells_at_goals(facts),
            (Span::Run, _) => {
                let solution = facts.solution;
                solution.and_then(|solution| run(facts, solution, self.max_shift_ticks))
            }
        };
        let rms_m = matched.as_ref().map(|matched| matched.rms_m);
        let value = rms_m.unwrap_or(f64::INFINITY);
        let mut finding = Finding::against(band, value, "m", "distance from the reference's path");
        if let Some(matched) = matched {
            finding = finding.shown_at(facts, || {
                let message = format!(
                    "{} from the reference's path (root mean square){}; the furthest is {} at {}",
                    metres(matched.rms_m),
                    matched.where_,
                    metres(matched.furthest_m),
                    seconds(facts.time_s(matched.furthest_tick)),
                );
                (message, "tcp".to_owned(), matched.furthest_tick)
            });
        }
        finding.advise("Look at the path plot: the dashed line is the reference's.")
    }

    fn compares_runs(&self) -> bool {
        self.span == Span::Run
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

/// Compares the dwells; the worst goal counts.
fn dwells(facts: &MotionFacts<'_>, reference: &TcpPath) -> Option<Matched> {
    let per_point = ticks_per_point(facts, reference);
    // it stands within a millimetre, or as near as all points ask for; points are rounded to a tenth of a millimetre
    let mut nears = [1e-3, facts.pose_band.full + 1e-4].into_iter();
    let goals = &facts.motion.goals;
    let windows = nears.find_map(|near| reference_dwells(reference, goals, per_point, near))?;
    let pairs = facts.dwells.iter().zip(windows).enumerate();
    worst(pairs.map(|(i, (dwell, (first, last)))| {
        let ticks = (first..=last).map(|k| (k, dwell.first + (k - first) * per_point));
        let distances = ticks
            .filter(|(_, tick)| *tick <= dwell.last)
            .map(|(k, tick)| {
                let gap = facts.trace.tcp_position(tick) - point(reference, k);
                (tick, gap.norm())
            });
        summary(distances, at_goal(i))
    }))
}

/// Compares the dwells with standing at the goals; the worst goal counts.
fn dwells_at_goals(facts: &MotionFacts<'_>) -> Option<Matched> {
    let pairs = facts.dwells.iter().zip(&facts.motion.goals).enumerate();
    worst(pairs.map(|(i, (dwell, goal))| {
        let distances = (dwell.first..=dwell.last).map(|tick| {
            let gap = facts.trace.tcp_position(tick) - goal.position_m;
            (tick, gap.norm())
        });
        summary(distances, at_goal(i))
    }))
}

/// The worst of all, of equal ones the first; none where one is missing.
fn worst(all: impl Iterator<Item = Option<Matched>>) -> Option<Matched> {
    let mut all: Vec<Matched> = all.collect::<Option<_>>()?;
    let (worst, _) = greatest(all.iter().map(|matched| matched.rms_m))?;
    Some(all.swap_remove(worst))
}

fn at_goal(index: usize) -> String {
    format!(" during the dwell at goal {}", index + 1)
}

/// Where the reference dwells: for each goal in order, the earliest window that stays `near` it \[m\].
fn reference_dwells(
    reference: &TcpPath,
    goals: &[MotionGoal],
    per_point: usize,
    near: f64,
) -> Option<Vec<(usize, usize)>> {
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

/// Compares the whole run at the shift, in whole control periods, that fits best; past its ends the reference stands still.
fn run(facts: &MotionFacts<'_>, solution: &Trace, max_shift_ticks: u64) -> Option<Matched> {
    let period = facts.motion.periods.ticks_per_control.get() as usize;
    let last = solution.len().checked_sub(1)? as i64;
    let most = (max_shift_ticks as usize / period) as i64;
    let mut best: Option<Matched> = None;
    for shift in -most..=most {
        let shift_ticks = shift * period as i64;
        let distances = (0..facts.trace.len()).step_by(period).map(|tick| {
            let of_solution = (tick as i64 - shift_ticks).clamp(0, last) as usize;
            let gap = facts.trace.tcp_position(tick) - solution.tcp_position(of_solution);
            (tick, gap.norm())
        });
        let shift_s = shift_ticks as f64 * facts.motion.periods.step_s;
        let where_ = match shift {
            0 => String::new(),
            _ => format!(" at a shift of {}", seconds(shift_s)),
        };
        let matched = summary(distances, where_)?;
        if best.as_ref().is_none_or(|best| matched.rms_m < best.rms_m) {
            best = Some(matched);
        }
    }
    best
}

#[cfg(test)]
mod tests {
    use super::*;

    /// One goal at the origin; the reference comes within `off` of it after three points and stays.
    fn windows(off: f64, near: f64) -> Option<Vec<(usize, usize)>> {
        let reference = TcpPath {
            period_s: 0.02,
            points_m: (0..10)
                .map(|k| [if k < 3 { 0.1 } else { off }, 0.0, 0.0])
                .collect(),
        };
        let goal = MotionGoal {
            position_m: Vector3::zeros(),
            dwell_ticks: 80,
            orientation: None,
        };
        reference_dwells(&reference, &[goal], 20, near)
    }

    #[test]
    fn a_reference_that_stands_a_little_off_dwells_where_the_band_says() {
        assert_eq!(windows(0.0009, 1e-3), Some(vec![(3, 7)]));
        assert_eq!(windows(0.0015, 1e-3), None);
        assert_eq!(windows(0.0015, 2.1e-3), Some(vec![(3, 7)]));
    }
}
