//! trajectory-match: how far the TCP is from the reference's path in `reference-path.json`, whichever time shift fits best \[m, root
//! mean square\].
//!
//! Over `dwells`, each of the best dwells is compared with the reference's dwell at the same goal, point by point from their
//! beginnings, and the worst goal counts: between goals every path is right. Over the `run`, all of it is compared, at the shift
//! that fits best. Joint motion is never compared: other branches are as good. A variant has numbers of its own and no path; where
//! its reference dwells is at the goals.

use std::ops::Range;

use kinemark_sim::model::robot::Robot;
use kinemark_sim::text::Problem;
use kinemark_sim::text::number::{metres, seconds};
use nalgebra::Vector3;
use schemars::JsonSchema;
use serde::Deserialize;

use crate::check::contract::{CheckKind, FirstLoss, MotionCheck};
use crate::check::facts::MotionFacts;
use crate::check::finding::Finding;
use crate::check::reading::InTask;
use crate::check::registry::{MotionTable, lacks_goals};
use crate::record::graded::TcpPath;
use crate::task::model::{Band, MotionGoal, MotionTask};
use crate::task::problem::LabError;

/// The part of a run that is compared with the reference's path.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum Span {
    /// The dwells at the goals.
    Dwells,
    /// The whole run.
    Run,
}

/// Why there is nothing to compare with.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
enum Mismatch {
    #[error("`reference-path.json` has no path for task `{task}`")]
    NoPath { task: String },
    #[error("`max_shift_s` has no meaning over `dwells`, which are found wherever they are")]
    ShiftOfDwells,
    #[error("`max_shift_s` must be 0 to 60 s, got {shift_s}")]
    Shift { shift_s: f64 },
}

impl Problem for Mismatch {
    fn code(&self) -> &'static str {
        "lab::trajectory_match"
    }

    fn label(&self) -> String {
        "this check".to_owned()
    }

    fn help(&self) -> Option<String> {
        let help = match self {
            Self::NoPath { .. } => {
                "put the reference solution's TCP path there: see docs/lab-format.md"
            }
            Self::ShiftOfDwells => "remove it",
            Self::Shift { .. } => "change it",
        };
        Some(help.to_owned())
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
    type Check = TrajectoryMatch;

    fn lacks(task: &MotionTask) -> Option<&'static str> {
        lacks_goals(task)
    }

    fn read(&self, at: Range<usize>, reading: &InTask<'_>) -> Result<TrajectoryMatch, LabError> {
        let refuse = |problem| reading.report.refuse(at.clone(), problem);
        if !reading.has_reference_path {
            let task = reading.task.to_owned();
            return refuse(Mismatch::NoPath { task });
        }
        let max_shift_s = match (self.over, self.max_shift_s) {
            (Span::Dwells, Some(_)) => return refuse(Mismatch::ShiftOfDwells),
            (_, None) => 0.0,
            (Span::Run, Some(shift_s)) if (0.0..=60.0).contains(&shift_s) => shift_s,
            (Span::Run, Some(shift_s)) => return refuse(Mismatch::Shift { shift_s }),
        };
        let step_s = reading.motion.periods.step_s;
        Ok(TrajectoryMatch {
            span: self.over,
            max_shift_ticks: (max_shift_s / step_s).round() as u64,
            band: reading.report.band(self.full_m, self.zero_m, at)?,
        })
    }
}

/// The check as read.
#[derive(Debug)]
pub(crate) struct TrajectoryMatch {
    span: Span,
    /// Greatest time shift, in ticks.
    max_shift_ticks: u64,
    band: Band,
}

impl CheckKind for TrajectoryMatch {
    fn band(&self, _: &Robot) -> Option<(Band, &'static str)> {
        Some((self.band, "m"))
    }

    fn follows_one_path(&self) -> bool {
        self.span == Span::Run
    }
}

impl MotionCheck for TrajectoryMatch {
    fn judge(&self, facts: &MotionFacts<'_>) -> Finding {
        let matched = match (self.span, facts.reference) {
            (Span::Dwells, Some(reference)) => dwells(facts, reference),
            (Span::Dwells, None) => dwells_at_goals(facts),
            (Span::Run, reference) => {
                reference.and_then(|reference| run(facts, reference, self.max_shift_ticks))
            }
        };
        let rms_m = matched.as_ref().map(|matched| matched.rms_m);
        let value = rms_m.unwrap_or(f64::INFINITY);
        let quantity = "distance from the reference's path";
        let mut finding = Finding::against(self.band, value, "m", quantity);
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

    fn first_loss(&self) -> FirstLoss {
        FirstLoss::Evidence
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
