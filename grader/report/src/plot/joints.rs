//! Pictures of all joints over time: positions, velocities, efforts, each with its command and limits.

use kinemark_sim::control::Mode;
use kinemark_sim::model::robot::Joint;
use kinemark_sim::text::number::typeset;
use kinemark_sim::trace::Signal;

use super::axis::{Axis, extent};
use super::canvas::{Entry, Swatch};
use super::signals::{MOST_PANELS, end_s, line, time_s, timeline, values};
use super::timeline::{Line, Panel, Timeline};
use crate::palette::{BLUE, RED, VERMILLION, VERMILLION_DASHED};
use crate::shown_unit::joined;
use crate::visible::shortened;
use kinemark_grader::record::graded::TaskRun;

/// What a picture of all joints shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Of {
    Positions,
    Velocities,
    Efforts,
}

impl Of {
    /// The signal's letter and its unit for a joint.
    fn letter_and_unit(self, joint: &Joint) -> (&'static str, &'static str) {
        match (self, joint.kind.turns()) {
            (Self::Positions, true) => ("q", "rad"),
            (Self::Positions, false) => ("q", "m"),
            (Self::Velocities, true) => ("qd", "rad/s"),
            (Self::Velocities, false) => ("qd", "m/s"),
            (Self::Efforts, true) => ("effort", "N\u{a0}m"),
            (Self::Efforts, false) => ("effort", "N"),
        }
    }

    fn signal(self, run: &TaskRun) -> &Signal {
        match self {
            Self::Positions => &run.trace.q,
            Self::Velocities => &run.trace.qd,
            Self::Efforts => &run.trace.effort,
        }
    }

    fn is_commanded(self, run: &TaskRun) -> bool {
        matches!(
            (self, run.mode),
            (Self::Positions, Mode::Position)
                | (Self::Velocities, Mode::Velocity)
                | (Self::Efforts, Mode::Effort | Mode::Prescribed)
        )
    }

    fn title(self) -> &'static str {
        match self {
            Self::Positions => "Joint positions",
            Self::Velocities => "Joint velocities",
            Self::Efforts => "Joint efforts",
        }
    }
}

/// Pictures of all joints, at most six to one.
pub(super) fn joints(run: &TaskRun, of: Of) -> Vec<Timeline> {
    let joints: Vec<(usize, &Joint)> = run.robot.moving_joints().enumerate().collect();
    let chunks: Vec<_> = joints.chunks(MOST_PANELS).collect();
    let mut pictures = Vec::new();
    for (part, chunk) in chunks.iter().enumerate() {
        let panels: Vec<Panel> = chunk
            .iter()
            .map(|(i, joint)| joint_panel(run, of, *i, joint))
            .collect();
        let (recorded, commanded) = match (of, run.mode) {
            (Of::Efforts, Mode::Prescribed) => ("taken", "expected"),
            (Of::Efforts, _) => ("applied", "command"),
            _ => ("measured", "command"),
        };
        let mut legend = vec![Entry::new(Swatch::Line(BLUE), recorded)];
        if of.is_commanded(run) {
            legend.push(Entry::new(Swatch::Line(VERMILLION), commanded));
        }
        let has_levels = panels.iter().any(|panel| !panel.levels.is_empty());
        if has_levels {
            legend.push(Entry::new(Swatch::Line(VERMILLION_DASHED), "limit"));
        }
        if panels
            .iter()
            .any(|panel| panel.lines.iter().any(|line| line.colour == RED))
        {
            legend.push(Entry::new(Swatch::Line(RED), "at the limit"));
        }
        let title = match chunks.len() {
            1 => of.title().to_owned(),
            of_parts => format!("{} ({} of {of_parts})", of.title(), part + 1),
        };
        pictures.push(timeline(run, title, panels, legend));
    }
    pictures
}

fn joint_panel(run: &TaskRun, of: Of, i: usize, joint: &Joint) -> Panel {
    let (symbol, unit) = of.letter_and_unit(joint);
    let mut heading = format!("{}, {symbol}[{i}] [{unit}]", shortened(&joint.name, 40));
    let mut lines = vec![line(
        column(run, of.signal(run), i),
        BLUE,
        of == Of::Efforts,
    )];
    lines[0].width = 2.0;
    if of.is_commanded(run) {
        let mut command = command(run, i);
        if of == Of::Efforts {
            let limit = run.effort_limits.get(i).copied().unwrap_or(f64::INFINITY);
            if let Some(greatest) = cut(&mut command, 1.5 * limit) {
                let cut_at = joined(&typeset(greatest, 3), unit);
                heading.push_str(&format!(" \u{2013} commands up to ±{cut_at} are cut off"));
            }
        }
        lines.insert(0, command);
    }
    let reach = extent(values(&lines)).unwrap_or((0.0, 0.0));
    let mut levels: Vec<f64> = match of {
        Of::Positions => [joint.limits.lower, joint.limits.upper]
            .into_iter()
            .flatten()
            .collect(),
        Of::Velocities => joint
            .limits
            .speed
            .into_iter()
            .flat_map(|v| [-v, v])
            .collect(),
        Of::Efforts => run
            .effort_limits
            .get(i)
            .into_iter()
            .flat_map(|e| [-e, *e])
            .collect(),
    };
    levels.retain(|level| level.is_finite());
    if of == Of::Efforts {
        let limit = run.effort_limits.get(i).copied().unwrap_or(f64::INFINITY);
        if limit.is_finite() {
            // a limit far away would flatten the curve: it is named in the heading instead
            let greatest = reach.0.abs().max(reach.1.abs());
            if limit > 8.0 * greatest {
                levels.clear();
                heading.push_str(&format!(
                    " \u{2013} limit ±{}, far outside",
                    joined(&typeset(limit, 4), unit)
                ));
            }
            lines.extend(
                [limit, -limit]
                    .into_iter()
                    .filter_map(|side| at_limit(run, i, side)),
            );
        }
    } else {
        // limits are drawn where the joint comes near them
        let near = (reach.1 - reach.0).max(0.5);
        levels.retain(|level| *level <= reach.1 + near && *level >= reach.0 - near);
    }
    let axis = Axis::around(values(&lines).chain(levels.iter().copied()), 0.025);
    Panel {
        heading,
        name: format!("{}, {symbol}[{i}]", shortened(&joint.name, 40)),
        unit: unit.to_owned(),
        axis,
        lines,
        levels: levels
            .into_iter()
            .map(|level| (level, VERMILLION_DASHED))
            .collect(),
        spans: Vec::new(),
        bands: Vec::new(),
    }
}

/// A thick line where the effort stood at a limit; gaps too short to be seen are closed.
fn at_limit(run: &TaskRun, joint: usize, limit: f64) -> Option<Line> {
    let shortest_s = end_s(run) / 150.0;
    let mut points: Vec<(f64, f64)> = Vec::new();
    // where the stretch that is open now began
    let mut start_s = 0.0;
    for (tick, effort) in run.trace.effort.component(joint).enumerate() {
        let is_at_limit = effort * limit.signum() >= limit.abs();
        if !is_at_limit {
            continue;
        }
        let t_s = time_s(run, tick as u64);
        match points.last().map(|last| last.0) {
            Some(last_s) if t_s - last_s <= shortest_s => {
                if last_s > start_s {
                    points.pop();
                }
            }
            last_s => {
                points.extend(last_s.map(|_| (t_s, f64::NAN)));
                start_s = t_s;
            }
        }
        points.push((t_s, limit));
    }
    (!points.is_empty()).then_some(Line {
        points,
        colour: RED,
        width: 4.0,
        held: false,
        cut: None,
    })
}

fn column(run: &TaskRun, signal: &Signal, joint: usize) -> Vec<(f64, f64)> {
    let values = signal.component(joint).take(run.trace.len());
    values
        .enumerate()
        .map(|(tick, value)| (time_s(run, tick as u64), value))
        .collect()
}

/// Cuts values off at a size, so that a few great ones do not flatten the rest; the greatest size there was, if one was cut.
fn cut(line: &mut Line, most: f64) -> Option<f64> {
    let sizes = line.points.iter().map(|(_, value)| value.abs());
    let greatest = sizes.filter(|size| size.is_finite()).fold(0.0, f64::max);
    if greatest <= most {
        return None;
    }
    for (_, value) in &mut line.points {
        if value.is_finite() {
            *value = value.clamp(-most, most);
        }
    }
    line.cut = Some(most);
    Some(greatest)
}

/// A command is held until the next one.
fn command(run: &TaskRun, joint: usize) -> Line {
    line(column(run, &run.trace.command, joint), VERMILLION, true)
}
