//! The plots of a motion task, as SVG that follows a reader's light or dark screen.

mod asked;
mod axis;
mod canvas;
mod differences;
mod joints;
mod path;
mod plane;
mod reading;
mod scenery;
mod signals;
mod thin;
mod timeline;
mod view;

use kinemark_sim::control::Mode;

pub use self::differences::differences;
use self::joints::Of;
use self::reading::Axes;
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
    /// Where its axes lie and what its lines are called, as JSON, for a viewer that reads values off.
    pub axes: String,
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
    if let Some((svg, title, axes)) = path::path(run) {
        plots.add("path", title, svg, &axes);
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
            joints::joints(run, of)
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
        let (svg, axes) = picture.draw();
        plots.add(&name, picture.title, svg, &axes);
    }
    plots.made
}

/// Plots with names that differ.
struct Plots {
    stem: String,
    made: Vec<Plot>,
}

impl Plots {
    fn add(&mut self, name: &str, title: String, svg: String, axes: &[Axes]) {
        let wanted = format!("{}-{name}", self.stem);
        let taken = |name: &str| self.made.iter().any(|plot| plot.name == name);
        let mut name = wanted.clone();
        let mut number = 2;
        while taken(&name) {
            name = format!("{wanted}-{number}");
            number += 1;
        }
        let title = shortened(&title, 120);
        let axes = reading::json(axes);
        self.made.push(Plot {
            name,
            title,
            svg,
            axes,
        });
    }
}

#[cfg(test)]
mod tests {
    use kinemark_sim::trace::PlotSignal;

    use super::*;
    use crate::graded::{Curve, StepBackdrop};
    use crate::report::sample;
    use crate::report::theme::{BLUE, MUTED_DASHED, PURPLE_DASHED};

    /// What must hold of every picture, whatever the run.
    fn sound(run: &TaskRun) -> Vec<Plot> {
        let plots = plots(run);
        let mut names: Vec<&str> = plots.iter().map(|plot| plot.name.as_str()).collect();
        names.sort_unstable();
        names.dedup();
        assert_eq!(names.len(), plots.len(), "two plots share a name");
        for plot in &plots {
            let Plot { name, svg, .. } = plot;
            assert!(
                name.bytes()
                    .all(|b| b.is_ascii_lowercase() || b.is_ascii_digit() || b == b'-'),
                "{name}"
            );
            assert!(svg.len() < 60_000, "{name}: {} bytes", svg.len());
            assert!(
                svg.starts_with("<svg ") && svg.ends_with("</svg>\n"),
                "{name}"
            );
            assert!(!svg.contains("NaN") && !svg.contains("inf"), "{name}");
            let longest = svg.lines().map(|line| line.matches(',').count()).max();
            assert!(
                longest < Some(1_500),
                "{name}: {longest:?} points in a line"
            );
        }
        plots
    }

    #[test]
    fn a_run_has_its_pictures() {
        let names: Vec<String> = sound(&sample::task_run())
            .into_iter()
            .map(|plot| plot.name)
            .collect();
        let expected = [
            "path",
            "error",
            "joints",
            "effort",
            "check-trajectory-match",
            "signals",
        ];
        assert_eq!(names, expected.map(|name| format!("move-{name}")));
    }

    /// Values read off a picture are those of the run.
    #[test]
    fn axes_tell_where_values_lie() {
        let run = sample::task_run();
        let plots = plots(&run);
        let axes = |name: &str| -> serde_json::Value {
            let plot = plots.iter().find(|plot| plot.name == name);
            serde_json::from_str(&plot.expect("the plot").axes).expect("JSON")
        };
        let number = |value: &serde_json::Value| value.as_f64().expect("a number");
        let joints = axes("move-joints");
        let elbow = &joints[1];
        assert_eq!(elbow["kind"], "time");
        assert_eq!(elbow["unit"], "rad");
        assert_eq!(elbow["name"], "elbow, q[1]");
        let names: Vec<_> = elbow["series"]
            .as_array()
            .expect("series")
            .iter()
            .map(|s| s["name"].clone())
            .collect();
        assert_eq!(names, ["command", "measured"]);
        assert_eq!(number(&elbow["t"][1]), 8.0);
        // the last point of the measured line
        let svg = &plots
            .iter()
            .find(|plot| plot.name == "move-joints")
            .expect("the plot")
            .svg;
        let bottom = number(&elbow["box"][3]);
        let (top, (low, high)) = (
            number(&elbow["box"][1]),
            (number(&elbow["y"][0]), number(&elbow["y"][1])),
        );
        let right = number(&elbow["box"][2]);
        let ends: Vec<f64> = svg
            .lines()
            .filter(|line| line.contains("<polyline") && line.contains("stroke=\"#006CAE\""))
            .filter_map(|line| {
                line.split("points=\"")
                    .nth(1)?
                    .split('"')
                    .next()?
                    .split_whitespace()
                    .last()
            })
            .filter_map(|point| point.split_once(','))
            .map(|(x, y)| (x.parse::<f64>().expect("x"), y.parse::<f64>().expect("y")))
            .filter(|(x, y)| (x - right).abs() < 1.0 && *y >= top && *y <= bottom)
            .map(|(_, y)| low + (bottom - y) / (bottom - top) * (high - low))
            .collect();
        let q = run.trace.q.at(8000)[1];
        assert!(
            ends.iter().any(|end| (end - q).abs() < 2e-3 * (high - low)),
            "{ends:?} {q}"
        );
        let error = axes("move-error");
        assert_eq!(error[0]["log"], true);
        // the path: y of the lab to the right, x up; the goals' close looks after it
        let path = axes("move-path");
        assert_eq!(path[0]["axes"], serde_json::json!([1, 0]));
        assert_eq!(path[0]["signs"], serde_json::json!([1, 1]));
        assert_eq!(path.as_array().map(Vec::len), Some(3));
        let across =
            |view: &serde_json::Value| number(&view["zero"][0]) + 1.4 * number(&view["pixelsPerM"]);
        // goal 1, at y = 1.4 m, lies in the middle of its close look
        let middle = 0.5 * (number(&path[1]["box"][0]) + number(&path[1]["box"][2]));
        assert!((across(&path[1]) - middle).abs() < 2.0);
    }

    #[test]
    fn the_same_run_gives_the_same_bytes() {
        assert_eq!(plots(&sample::task_run()), plots(&sample::task_run()));
    }

    #[test]
    fn where_a_run_was_stopped_is_marked() {
        for ticks in [0, 1, 700] {
            for plot in sound(&sample::stopped_after(ticks)) {
                assert!(
                    plot.svg.contains("stopped here"),
                    "{} after {ticks}",
                    plot.name
                );
            }
        }
    }

    #[test]
    fn a_run_without_a_row_has_empty_axes() {
        let mut run = sample::chain(2, 0, |_, _| 0.0);
        run.goals = sample::task_run().goals;
        for plot in sound(&run) {
            assert!(
                plot.svg.contains("stopped here") || plot.name.ends_with("path"),
                "{}",
                plot.name
            );
        }
    }

    #[test]
    fn values_that_are_no_numbers_break_the_line_only() {
        let wild = |tick: u64, joint: usize| match (tick % 7, joint) {
            (3, 0) => f64::NAN,
            (4, 0) => f64::INFINITY,
            (_, 0) => 1e300,
            (_, 1) => tick as f64 * -1e305,
            _ => 1e-300,
        };
        let mut run = sample::chain(3, 3000, wild);
        run.goals = sample::task_run().goals;
        run.effort_limits = vec![1e-3, 0.0, f64::NAN];
        run.curves = vec![Curve {
            check: String::new(),
            title: "\u{202E}".repeat(500),
            unit: "m".to_owned(),
            t_s: vec![0.0, f64::NAN, 1e300, -5.0],
            values: vec![f64::NAN, 1.0, f64::INFINITY, -1e308],
            full: Some(f64::NAN),
            zero: Some(0.0),
            marks: vec![
                (f64::NAN, "x".to_owned()),
                (1e300, "<y>".repeat(99)),
                (-1.0, "z".to_owned()),
            ],
            step: None,
        }];
        sound(&run);
    }

    #[test]
    fn a_step_response_has_its_prediction_target_and_band() {
        let lag = |t_s: f64, rate: f64| 1.0 - libm::exp(-rate * t_s);
        let t_s: Vec<f64> = (0..1000).map(|tick| 0.001 * f64::from(tick)).collect();
        let of = |rate: f64| t_s.iter().map(|t_s| lag(*t_s, rate)).collect();
        let mut run = sample::chain(2, 1000, |_, _| 0.0);
        run.curves = vec![Curve {
            check: "settle".to_owned(),
            title: "position of joint `elbow`".to_owned(),
            unit: "rad".to_owned(),
            values: of(8.0),
            full: None,
            zero: None,
            marks: vec![(0.489, "settled".to_owned())],
            step: Some(StepBackdrop {
                prediction: Some(of(12.0)),
                target: Some(1.05),
                band: Some((0.98, 1.02, "within 2 % of the final value".to_owned())),
            }),
            t_s,
        }];
        let plots = sound(&run);
        let plot = plots
            .iter()
            .find(|plot| plot.name.ends_with("check-settle"))
            .expect("the curve");
        for word in [
            ">\nrun\n<",
            "linear prediction",
            "target 1.05\u{a0}rad",
            "within 2 % of the final value",
        ] {
            assert!(plot.svg.contains(word), "no {word:?}");
        }
        // the run, the prediction and the target are three lines of different looks
        for colour in [BLUE, PURPLE_DASHED, MUTED_DASHED] {
            let (r, g, b) = colour.light;
            let key = format!("stroke=\"#{r:02X}{g:02X}{b:02X}\"");
            assert!(plot.svg.matches(&key).count() >= 2, "{key}");
        }
    }

    #[test]
    fn one_value_that_chatters_stays_small() {
        let chatter = |tick: u64, joint: usize| {
            if (tick + joint as u64).is_multiple_of(2) {
                30.0
            } else {
                -30.0
            }
        };
        let mut run = sample::chain(6, 60_001, chatter);
        run.effort_limits = vec![30.0; 6];
        sound(&run);
    }

    #[test]
    fn many_joints_are_spread_over_pictures() {
        let run = sample::chain(25, 1000, |tick, joint| {
            libm::sin(0.001 * (tick * joint as u64) as f64)
        });
        let count = |word: &str, plots: &[Plot]| {
            plots.iter().filter(|plot| plot.name.contains(word)).count()
        };
        let plots = sound(&run);
        assert_eq!(
            ["joints", "velocities", "effort"].map(|word| count(word, &plots)),
            [5, 5, 5]
        );
    }

    #[test]
    fn hostile_names_are_words_in_a_picture() {
        let mut run = sample::task_run();
        let name = "</text><script>alert(1)</script>&\u{0}\u{1b}[2J\u{202E}".repeat(50);
        let plot = PlotSignal {
            name,
            samples: vec![(0, 1.0), (u64::MAX, 2.0)],
        };
        run.trace.plots = vec![plot; 40];
        let plots = sound(&run);
        let signals: Vec<&Plot> = plots
            .iter()
            .filter(|plot| plot.name.contains("signals"))
            .collect();
        assert_eq!(signals.len(), 3);
        for plot in signals {
            assert!(
                !plot.svg.contains("<script") && !plot.svg.contains(['\0', '\u{1b}', '\u{202E}'])
            );
            assert!(plot.svg.contains("&lt;script"));
        }
    }
}
