//! Pictures of two runs: how far their TCPs are apart, joints and efforts of both, and how far these are apart.

use kinemark_sim::model::robot::Joint;
use kinemark_sim::trace::Signal;

use super::axis::Axis;
use super::canvas::{Entry, Swatch};
use super::signals::{MOST_PANELS, line, most_points, time_s, values};
use super::timeline::{Line, Panel, Timeline};
use super::{Plot, Plots, file_stem};
use crate::palette::{BLUE, PURPLE_DASHED};
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
    for (names, titles, of) in [
        (
            ["joints-both", "joints-apart"],
            ["Joint positions of both", "Joint positions, B less A"],
            Of::Positions,
        ),
        (
            ["effort-both", "effort-apart"],
            ["Joint efforts of both", "Joint efforts, B less A"],
            Of::Efforts,
        ),
    ] {
        let legend = vec![
            Entry::new(Swatch::Line(BLUE), "A"),
            Entry::new(Swatch::Line(PURPLE_DASHED), "B"),
        ];
        let overlaid = both.joints(titles[0], legend, &|i, joint| both.overlaid(i, joint, of));
        let legend = vec![Entry::new(Swatch::Line(BLUE), "difference")];
        let apart = both.joints(titles[1], legend, &|i, joint| both.apart(i, joint, of));
        pictures.extend(overlaid.into_iter().map(|picture| (names[0], picture)));
        pictures.extend(apart.into_iter().map(|picture| (names[1], picture)));
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
        let lines = vec![line(apart.collect(), BLUE, false)];
        let panel = panel("distance of the TCPs", "m", lines);
        let legend = vec![Entry::new(Swatch::Line(BLUE), "difference")];
        self.timeline("How far the TCPs are apart".to_owned(), vec![panel], legend)
    }

    /// A joint of both runs, each to its end.
    fn overlaid(&self, i: usize, joint: &Joint, of: Of) -> Panel {
        let is_held = matches!(of, Of::Efforts);
        let of_run = |run: &TaskRun| -> Vec<(f64, f64)> {
            let values = of.signal(run).component(i).enumerate();
            values
                .map(|(tick, value)| (time_s(run, tick as u64), value))
                .collect()
        };
        let lines = vec![
            line(of_run(self.a), BLUE, is_held),
            line(of_run(self.b), PURPLE_DASHED, is_held),
        ];
        panel(&shortened(&joint.name, 40), of.unit(joint), lines)
    }

    /// A joint of B less that of A.
    fn apart(&self, i: usize, joint: &Joint, of: Of) -> Panel {
        let [a, b] = [self.a, self.b].map(|run| of.signal(run).component(i));
        let apart = a.zip(b).take(self.ticks).enumerate();
        let apart = apart.map(|(tick, (a, b))| (time_s(self.a, tick as u64), b - a));
        let lines = vec![line(apart.collect(), BLUE, false)];
        panel(&shortened(&joint.name, 40), of.unit(joint), lines)
    }

    fn joints(
        &self,
        title: &str,
        legend: Vec<Entry>,
        panel: &dyn Fn(usize, &Joint) -> Panel,
    ) -> Vec<Timeline> {
        let joints: Vec<(usize, &Joint)> = self.a.robot.moving_joints().enumerate().collect();
        let parts = joints.len().div_ceil(MOST_PANELS);
        let pictures = joints.chunks(MOST_PANELS).enumerate().map(|(part, chunk)| {
            let panels = chunk.iter().map(|(i, joint)| panel(*i, joint));
            let title = match parts {
                1 => title.to_owned(),
                _ => format!("{title} ({} of {parts})", part + 1),
            };
            self.timeline(title, panels.collect(), legend.clone())
        });
        pictures.collect()
    }

    fn timeline(&self, title: String, panels: Vec<Panel>, legend: Vec<Entry>) -> Timeline {
        let lines = panels.iter().flat_map(|panel| &panel.lines);
        let last = lines.filter_map(|line| line.points.last());
        let end_s = last.fold(0.0, |end_s: f64, (t_s, _)| end_s.max(*t_s));
        let mark = self
            .first
            .map(|first| (first.time_s, format!("first apart ({})", first.signal)));
        Timeline {
            title,
            panels,
            legend,
            marks: mark.into_iter().collect(),
            end_s,
            stopped_s: None,
            most_points: most_points(self.a),
        }
    }
}

fn panel(name: &str, unit: &str, lines: Vec<Line>) -> Panel {
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
