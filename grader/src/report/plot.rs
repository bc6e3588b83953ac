//! The plots of a motion task, as SVG that follows a reader's light or dark screen.

mod axis;
mod canvas;
mod path;
mod signals;
mod thin;
mod timeline;

use kinemark_sim::control::Mode;

use self::signals::Of;
use crate::graded::TaskRun;
use crate::report::visible::{file_stem, shortened};

/// One picture.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Plot {
    /// Its file name without extension: lowercase letters, digits and hyphens; no two plots of a run share one.
    pub name: String,
    /// What it shows.
    pub title: String,
    /// The whole SVG file.
    pub svg: String,
}

impl Plot {
    /// The picture to stand in a page that brings the style sheet of plots itself.
    pub(crate) fn inline(&self) -> impl Iterator<Item = &str> {
        let (head, rest) = self.svg.split_once("<style>").unwrap_or((&self.svg, ""));
        let (_, tail) = rest.split_once("</style>").unwrap_or(("", rest));
        [head, tail].into_iter()
    }
}

/// All plots of a run: the TCP's path, its distance to the goals, joints, efforts, one for each curve that a check judged, and the
/// signals the submission drew. The same run gives the same bytes.
pub fn plots(run: &TaskRun) -> Vec<Plot> {
    let mut plots = Plots {
        stem: file_stem(&run.task),
        made: Vec::new(),
    };
    if let Some((svg, title)) = path::path(run) {
        plots.add("path", title, svg);
    }
    let mut pictures: Vec<(String, timeline::Timeline)> = Vec::new();
    pictures.extend(signals::error(run).map(|picture| ("error".to_owned(), picture)));
    let mut of_joints = vec![("joints", Of::Positions)];
    if run.mode == Mode::Velocity {
        of_joints.push(("velocities", Of::Velocities));
    }
    of_joints.push(("effort", Of::Efforts));
    for (name, of) in of_joints {
        pictures.extend(
            signals::joints(run, of)
                .into_iter()
                .map(|picture| (name.to_owned(), picture)),
        );
    }
    for curve in &run.curves {
        let name = format!("check-{}", file_stem(&curve.check));
        pictures.push((name, signals::curve(run, curve)));
    }
    pictures.extend(
        signals::own(run)
            .into_iter()
            .map(|picture| ("signals".to_owned(), picture)),
    );
    for (name, picture) in pictures {
        plots.add(&name, picture.title.clone(), picture.draw());
    }
    plots.made
}

/// Plots with names that differ.
struct Plots {
    stem: String,
    made: Vec<Plot>,
}

impl Plots {
    fn add(&mut self, name: &str, title: String, svg: String) {
        let wanted = format!("{}-{name}", self.stem);
        let taken = |name: &str| self.made.iter().any(|plot| plot.name == name);
        let mut name = wanted.clone();
        let mut number = 2;
        while taken(&name) {
            name = format!("{wanted}-{number}");
            number += 1;
        }
        let title = shortened(&title, 120);
        self.made.push(Plot { name, title, svg });
    }
}
