//! Pictures over time besides those of the joints: distance to the goals, what checks judged, what the submission drew.

use kinemark_sim::text::number::typeset;
use kinemark_sim::watch::event::EventKind;

use super::axis::{Axis, extent};
use super::canvas::{Entry, Swatch};
use super::timeline::{Line, MOST_POINTS, Panel, Timeline};
use crate::goal::{current_goal, distances_m};
use crate::palette::{
    AMBER_DASHED, BLUE, Colour, GREEN, GREEN_DASHED, MUTED_DASHED, PURPLE_DASHED, VERMILLION_DASHED,
};
use crate::shown_unit::{joined, shown_unit};
use crate::visible::{shortened, visible};
use kinemark_grader::record::graded::{Curve, Goal, StepBackdrop, TaskRun};

/// Panels of one picture.
pub(super) const MOST_PANELS: usize = 6;
/// What is drawn of each joint: its position, its velocity, its effort.
const KINDS_OF_JOINTS: usize = 3;
/// Points of all pictures of joints.
const MOST_POINTS_OF_JOINTS: usize = 18_000;
/// Signals of a submission that are drawn.
const MOST_SIGNALS: usize = 18;
/// Goals whose distance is drawn besides the current one's.
const MOST_GOALS: usize = 4;

/// When a run ended \[s\].
pub(super) fn end_s(run: &TaskRun) -> f64 {
    time_s(run, run.trace.len().saturating_sub(1) as u64)
}

/// The time of a tick \[s\]; a whole rate is divided by, so that the time is the nearest number to its decimal.
pub(super) fn time_s(run: &TaskRun, tick: u64) -> f64 {
    let rate_hz = (1.0 / run.trace.step_s).round();
    if (rate_hz * run.trace.step_s - 1.0).abs() < 1e-9 {
        tick as f64 / rate_hz
    } else {
        tick as f64 * run.trace.step_s
    }
}

/// When a run ended, if before its time \[s\].
pub(super) fn stopped_s(run: &TaskRun) -> Option<f64> {
    let early = |kind: &EventKind| matches!(kind, EventKind::Stopped | EventKind::Diverged);
    let stopped = run.trace.events.iter().any(|event| early(&event.kind)) || run.trace.is_empty();
    stopped.then(|| end_s(run))
}

/// The moment at which a run first differs from the reference solution's, in words.
pub(super) fn differs(run: &TaskRun) -> Option<(f64, String)> {
    let found = run.divergence.as_ref()?;
    let words = format!("differs first from the reference ({})", found.signal);
    Some((found.time_s, words))
}

pub(super) fn timeline(
    run: &TaskRun,
    title: String,
    panels: Vec<Panel>,
    legend: Vec<Entry>,
) -> Timeline {
    Timeline {
        title,
        panels,
        legend,
        marks: differs(run).into_iter().collect(),
        end_s: end_s(run),
        stopped_s: stopped_s(run),
        most_points: most_points(run),
    }
}

/// Points of a picture: many joints make many pictures, which share what a page has room for.
pub(super) fn most_points(run: &TaskRun) -> usize {
    let pictures = KINDS_OF_JOINTS * run.robot.n().div_ceil(MOST_PANELS).max(1);
    (MOST_POINTS_OF_JOINTS / pictures).min(MOST_POINTS)
}

pub(super) fn line(points: Vec<(f64, f64)>, colour: Colour, held: bool) -> Line {
    Line {
        points,
        colour,
        width: if held { 1.5 } else { 2.0 },
        held,
        cut: None,
    }
}

pub(super) fn values(lines: &[Line]) -> impl Iterator<Item = f64> + '_ {
    lines
        .iter()
        .flat_map(|line| line.points.iter().map(|point| point.1))
}

/// Words of a band's two lines.
fn band_entries(full: Option<f64>, zero: Option<f64>, unit: &str, scale: f64) -> Vec<Entry> {
    let limit = |value: f64| joined(&typeset(value * scale, 4), unit);
    let mut entries = Vec::new();
    if let Some(full) = full {
        entries.push(Entry::new(
            Swatch::Line(GREEN_DASHED),
            format!("full points at {}", limit(full)),
        ));
    }
    if let Some(zero) = zero {
        entries.push(Entry::new(
            Swatch::Line(VERMILLION_DASHED),
            format!("none at {}", limit(zero)),
        ));
    }
    entries
}

/// Distance of the TCP to the goals, on a logarithmic axis: millimetres matter as much as metres.
pub(super) fn error(run: &TaskRun) -> Option<Timeline> {
    if run.goals.is_empty() {
        return None;
    }
    let distances: Vec<Vec<f64>> = run
        .goals
        .iter()
        .map(|goal| distances_m(run, goal).collect())
        .collect();
    let times = |tick: usize| time_s(run, tick as u64);
    let current = (0..run.trace.len()).map(|tick| {
        let goal = current_goal(&run.goals, tick as u64).unwrap_or(0);
        (times(tick), distances[goal][tick])
    });
    let current: Vec<(f64, f64)> = current.collect();
    let mut lines = Vec::new();
    let others = run.goals.len() > 1 && run.goals.len() <= MOST_GOALS;
    if others {
        for distance in &distances {
            let points = distance
                .iter()
                .enumerate()
                .map(|(tick, d)| (times(tick), *d))
                .collect();
            lines.push(Line {
                points,
                colour: MUTED_DASHED,
                width: 1.2,
                held: false,
                cut: None,
            });
        }
    }
    lines.push(line(current, BLUE, false));
    let bands = goal_bands(&run.goals);
    let axis = distance_axis(&bands, &lines);
    let mut legend = vec![Entry::new(Swatch::Line(BLUE), "to the current goal")];
    if others {
        legend.push(Entry::new(Swatch::Line(MUTED_DASHED), "to each goal"));
    }
    for (full, zero) in &bands {
        let (unit, scale) = shown_unit("m", *zero);
        legend.extend(band_entries(Some(*full), Some(*zero), unit, scale));
    }
    let mut spans: Vec<_> = run
        .goals
        .iter()
        .filter_map(|goal| stay_s(run, goal))
        .collect();
    spans.dedup();
    if !spans.is_empty() {
        legend.push(Entry::new(Swatch::Area(GREEN), "judged stay"));
    }
    let panel = Panel {
        heading: "distance of the TCP to the goal [m], logarithmic".to_owned(),
        name: "distance to the goal".to_owned(),
        unit: "m".to_owned(),
        axis,
        lines,
        levels: bands
            .iter()
            .flat_map(|band| [(band.0, GREEN_DASHED), (band.1, VERMILLION_DASHED)])
            .collect(),
        spans: spans
            .into_iter()
            .map(|(from, to)| (from, to, GREEN))
            .collect(),
        bands: Vec::new(),
    };
    Some(timeline(
        run,
        "Distance to the goal".to_owned(),
        vec![panel],
        legend,
    ))
}

/// The bands of goals, each once: distances that earn all points and none.
fn goal_bands(goals: &[Goal]) -> Vec<(f64, f64)> {
    let mut bands: Vec<(f64, f64)> = Vec::new();
    for goal in goals {
        if !bands.contains(&(goal.full_m, goal.zero_m)) && bands.len() < MOST_GOALS {
            bands.push((goal.full_m, goal.zero_m));
        }
    }
    bands
}

/// An axis for distances, from below the narrowest band.
fn distance_axis(bands: &[(f64, f64)], lines: &[Line]) -> Axis {
    let least = bands
        .iter()
        .map(|band| band.0)
        .fold(f64::INFINITY, f64::min);
    let least = if least > 0.0 && least.is_finite() {
        least
    } else {
        1e-3
    };
    let greatest = extent(values(lines)).map_or(1.0, |reach| reach.1);
    Axis::decades(
        least / 9.0,
        greatest.max(bands.iter().map(|band| band.1).fold(0.0, f64::max)),
    )
}

fn stay_s(run: &TaskRun, goal: &Goal) -> Option<(f64, f64)> {
    let (first, last) = goal.stay?;
    Some((time_s(run, first), time_s(run, last)))
}

/// Words of what a step response is drawn with.
fn step_entries(step: &StepBackdrop, unit: &str, scale: f64) -> Vec<Entry> {
    let mut entries = Vec::new();
    if step.prediction.is_some() {
        entries.push(Entry::new(Swatch::Line(AMBER_DASHED), "linear prediction"));
    }
    if let Some(target) = step.target {
        let target = joined(&typeset(target * scale, 4), unit);
        let target = format!("target {target}");
        entries.push(Entry::new(Swatch::Line(MUTED_DASHED), target));
    }
    if let Some((_, _, words)) = &step.band {
        entries.push(Entry::new(Swatch::Area(GREEN), shortened(words, 70)));
    }
    entries
}

/// How large the values of a curve are: its limits, else its greatest value.
fn typical_value(curve: &Curve) -> f64 {
    let typical = [curve.full, curve.zero]
        .into_iter()
        .flatten()
        .map(f64::abs)
        .reduce(f64::max);
    let reach = extent(curve.values.iter().copied());
    typical
        .or(reach.map(|(min, max)| min.abs().max(max.abs())))
        .unwrap_or(1.0)
}

/// What the run did, in the unit that is shown, and what a linear loop would have done.
fn curve_lines(curve: &Curve, scale: f64) -> Vec<Line> {
    let over_time = |values: &[f64]| {
        let values = values.iter().map(|value| value * scale);
        curve.t_s.iter().copied().zip(values).collect()
    };
    let mut lines = vec![line(over_time(&curve.values), BLUE, false)];
    if let Some(reference) = &curve.reference {
        lines.push(line(over_time(reference), PURPLE_DASHED, false));
    }
    let step = curve.step.as_ref();
    // its dashes on the run's line: where both are one, both are seen
    if let Some(prediction) = step.and_then(|step| step.prediction.as_ref()) {
        lines.push(line(over_time(prediction), AMBER_DASHED, false));
    }
    lines
}

/// The marks of a curve in order of time: the first forty that have a time.
fn curve_marks(curve: &Curve) -> Vec<(f64, String)> {
    let mut marks: Vec<(f64, String)> = curve
        .marks
        .iter()
        .filter(|mark| mark.0.is_finite())
        .take(40)
        .cloned()
        .collect();
    marks.sort_by(|a, b| a.0.total_cmp(&b.0));
    marks
}

/// What the run is above the reference solution's, in a unit of its own size.
fn difference(curve: &Curve) -> Option<Panel> {
    let reference = curve.reference.as_ref()?;
    let apart = || curve.values.iter().zip(reference).map(|(own, of)| own - of);
    let typical = extent(apart()).map_or(0.0, |(low, high)| low.abs().max(high.abs()));
    let (unit, scale) = shown_unit(&curve.unit, typical);
    let points = curve
        .t_s
        .iter()
        .copied()
        .zip(apart().map(|gap| gap * scale));
    let lines = vec![line(points.collect(), BLUE, false)];
    let name = "run less reference".to_owned();
    Some(Panel {
        heading: format!("{name} [{}]", visible(unit)),
        name,
        unit: unit.to_owned(),
        // what is off by rounding is drawn as nothing
        axis: Axis::around(values(&lines), 1e-3 * typical_value(curve) * scale),
        lines,
        levels: Vec::new(),
        spans: Vec::new(),
        bands: Vec::new(),
    })
}

/// A curve that a check judged, with its band and marks.
pub(super) fn curve(run: &TaskRun, curve: &Curve) -> Timeline {
    let typical = typical_value(curve);
    let (unit, scale) = shown_unit(&curve.unit, typical);
    let lines = curve_lines(curve, scale);
    let step = curve.step.as_ref();
    let target = step.and_then(|step| step.target);
    let levels: Vec<_> = [
        (curve.zero, VERMILLION_DASHED),
        (curve.full, GREEN_DASHED),
        (target, MUTED_DASHED),
    ]
    .into_iter()
    .filter_map(|(level, colour)| Some((level? * scale, colour)))
    .collect();
    let band = step.and_then(|step| step.band.as_ref());
    let bands: Vec<_> = band
        .map(|(from, to, _)| (from * scale, to * scale, GREEN))
        .into_iter()
        .collect();
    let edges = || bands.iter().flat_map(|(from, to, _)| [*from, *to]);
    let shown = || {
        values(&lines)
            .chain(levels.iter().map(|level| level.0))
            .chain(edges())
    };
    let (least, greatest) = extent(shown()).unwrap_or((0.0, 1.0));
    let lowest_level = levels
        .iter()
        .map(|level| level.0)
        .fold(f64::INFINITY, f64::min);
    // a band that would be a hair's breadth at the foot of the picture
    let is_wide =
        step.is_none() && least >= 0.0 && lowest_level > 0.0 && greatest > 40.0 * typical * scale;
    let (axis, word) = if is_wide {
        (Axis::decades(lowest_level / 9.0, greatest), ", logarithmic")
    } else {
        (Axis::around(shown(), 1e-9), "")
    };
    let judged = run.check_titles.get(&curve.check).unwrap_or(&curve.check);
    // a picture has no code: its marks are left out
    let title = shortened(&curve.title.replace('`', ""), 70);
    let panel = Panel {
        heading: format!("{title} [{}]{word}", visible(unit)),
        name: title,
        unit: unit.to_owned(),
        axis,
        lines,
        levels,
        spans: Vec::new(),
        bands,
    };
    let mut legend = band_entries(curve.full, curve.zero, unit, scale);
    if step.is_some() || curve.reference.is_some() {
        legend.push(Entry::new(Swatch::Line(BLUE), "run"));
    }
    if curve.reference.is_some() {
        legend.push(Entry::new(Swatch::Line(PURPLE_DASHED), "reference"));
    }
    if let Some(step) = step {
        legend.extend(step_entries(step, unit, scale));
    }
    let last_s = extent(curve.t_s.iter().copied()).map_or(0.0, |reach| reach.1);
    let difference = difference(curve);
    Timeline {
        title: format!("Judged: {}", shortened(&judged.replace('`', ""), 60)),
        panels: std::iter::once(panel).chain(difference).collect(),
        legend,
        marks: curve_marks(curve),
        end_s: last_s.max(end_s(run)),
        stopped_s: stopped_s(run),
        most_points: most_points(run),
    }
}

/// What the submission drew with `plot`, at most eighteen signals.
pub(super) fn own(run: &TaskRun) -> Vec<Timeline> {
    let all = &run.trace.plots;
    let shown = &all[..all.len().min(MOST_SIGNALS)];
    let parts = shown.len().div_ceil(MOST_PANELS);
    let mut pictures = Vec::new();
    for (part, chunk) in shown.chunks(MOST_PANELS).enumerate() {
        let panels = chunk.iter().map(|signal| {
            let points = signal
                .samples
                .iter()
                .map(|(tick, value)| (time_s(run, *tick), *value));
            // between two of them nothing is known, so the last one stands
            let lines = vec![line(points.collect(), BLUE, true)];
            Panel {
                heading: format!("{} [as plotted]", shortened(&signal.name, 60)),
                name: shortened(&signal.name, 60),
                unit: String::new(),
                axis: Axis::around(values(&lines), 0.0),
                lines,
                levels: Vec::new(),
                spans: Vec::new(),
                bands: Vec::new(),
            }
        });
        let mut title = "Signals of the submission".to_owned();
        if parts > 1 {
            title.push_str(&format!(" ({} of {parts})", part + 1));
        }
        if all.len() > shown.len() {
            title.push_str(&format!(", the first {} of {}", shown.len(), all.len()));
        }
        pictures.push(timeline(run, title, panels.collect(), Vec::new()));
    }
    pictures
}
