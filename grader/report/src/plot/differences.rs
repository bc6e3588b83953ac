//! Pictures of how far two runs are from each other: their TCPs, their joints, their efforts.

use kinemark_sim::model::robot::Joint;
use kinemark_sim::trace::Signal;

use super::axis::Axis;
use super::canvas::{Entry, Swatch};
use super::signals::{MOST_PANELS, line, most_points, time_s, values};
use super::timeline::{Panel, Timeline};
use super::{Plot, Plots, file_stem};
use crate::theme::BLUE;
use crate::visible::shortened;
use kinemark_grader::record::comparison::FirstDifference;
use kinemark_grader::record::graded::TaskRun;

/// All pictures of what differs between two runs with the same joints, as far as both go. The same two give the same bytes.
pub fn differences(a: &TaskRun, b: &TaskRun, first: Option<&FirstDifference>) -> Vec<Plot> {
    let mut plots = Plots {
        stem: file_stem(&a.task),
        made: Vec::new(),
    };
    let both = Both {
        a,
        b,
        ticks: a.trace.len().min(b.trace.len()),
        first,
    };
    let mut pictures = vec![("tcp-apart", both.tcp())];
    for (name, title, of) in [
        ("joints-apart", "Joint positions, B less A", Of::Positions),
        ("effort-apart", "Joint efforts, B less A", Of::Efforts),
    ] {
        pictures.extend(
            both.joints(title, of)
                .into_iter()
                .map(|picture| (name, picture)),
        );
    }
    for (name, picture) in pictures {
        let (svg, axes, head) = picture.draw();
        plots.add(name, picture.title, svg, &axes, Some(head));
    }
    plots.made
}

#[derive(Clone, Copy)]
enum Of {
    Positions,
    Efforts,
}

impl Of {
    fn unit(self, joint: &Joint) -> &'static str {
        match (self, joint.kind.turns()) {
            (Self::Positions, true) => "rad",
            (Self::Positions, false) => "m",
            (Self::Efforts, true) => "N\u{a0}m",
            (Self::Efforts, false) => "N",
        }
    }

    fn signal(self, run: &TaskRun) -> &Signal {
        match self {
            Self::Positions => &run.trace.q,
            Self::Efforts => &run.trace.effort,
        }
    }
}

struct Both<'a> {
    a: &'a TaskRun,
    b: &'a TaskRun,
    /// Ticks that both have.
    ticks: usize,
    first: Option<&'a FirstDifference>,
}

impl Both<'_> {
    fn tcp(&self) -> Timeline {
        let apart = (0..self.ticks).map(|tick| {
            let apart = self.b.trace.tcp_position(tick) - self.a.trace.tcp_position(tick);
            (time_s(self.a, tick as u64), apart.norm())
        });
        let panel = panel("distance of the TCPs", "m", apart.collect());
        self.timeline("How far the TCPs are apart".to_owned(), vec![panel])
    }

    fn joints(&self, title: &str, of: Of) -> Vec<Timeline> {
        let joints: Vec<(usize, &Joint)> = self.a.robot.moving_joints().enumerate().collect();
        let parts = joints.len().div_ceil(MOST_PANELS);
        let pictures = joints.chunks(MOST_PANELS).enumerate().map(|(part, chunk)| {
            let panels = chunk.iter().map(|(i, joint)| {
                let pairs = of
                    .signal(self.a)
                    .component(*i)
                    .zip(of.signal(self.b).component(*i));
                let apart = pairs.take(self.ticks).enumerate();
                let apart = apart.map(|(tick, (a, b))| (time_s(self.a, tick as u64), b - a));
                panel(&shortened(&joint.name, 40), of.unit(joint), apart.collect())
            });
            let title = match parts {
                1 => title.to_owned(),
                _ => format!("{title} ({} of {parts})", part + 1),
            };
            self.timeline(title, panels.collect())
        });
        pictures.collect()
    }

    fn timeline(&self, title: String, panels: Vec<Panel>) -> Timeline {
        let mark = self
            .first
            .map(|first| (first.time_s, format!("first apart ({})", first.signal)));
        Timeline {
            title,
            panels,
            legend: vec![Entry::new(Swatch::Line(BLUE), "difference")],
            marks: mark.into_iter().collect(),
            end_s: time_s(self.a, self.ticks.saturating_sub(1) as u64),
            stopped_s: None,
            most_points: most_points(self.a),
        }
    }
}

fn panel(name: &str, unit: &str, points: Vec<(f64, f64)>) -> Panel {
    let lines = vec![line(points, BLUE, false)];
    Panel {
        heading: format!("{name} [{unit}]"),
        name: name.to_owned(),
        unit: unit.to_owned(),
        axis: Axis::around(values(&lines), 1e-6),
        lines,
        levels: Vec::new(),
        spans: Vec::new(),
        bands: Vec::new(),
    }
}
