//! The plots of a motion task and of a class, as SVG that follows a reader's light or dark screen.

mod axis;
mod canvas;
mod case_picture;
mod course;
mod differences;
mod given_paths;
mod histogram;
mod joints;
mod path;
mod plane;
mod reading;
mod scenery;
mod signals;
mod step_response;
mod svg_backend;
mod thin;
mod timeline;
mod view;

use self::canvas::{Entry, WIDTH};
pub(crate) use self::case_picture::{case_legend, case_picture};
pub use self::differences::differences;
pub use self::histogram::{Histogram, histogram};
use self::joints::Of;
use self::reading::Axes;
pub use self::step_response::{ResponseCurve, ResponsePanel, ResponsePicture, response_picture};
use crate::visible::{file_stem, shortened};
use kinemark_grader::record::graded::TaskRun;

/// The picture of the path, in its file name.
const PATH: &str = "path";

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
    /// Its title and legend for a narrow page, where the picture's own would be too small to read; none where it has more to it.
    pub(crate) head: Option<Head>,
}

/// What stands above the panels of a picture, for a page to show in its own way.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Head {
    /// A small picture of each line or mark, and its words.
    pub(crate) legend: Vec<(String, String)>,
    /// How much of the picture's height its own head takes, as CSS has it.
    pub(crate) of_height: String,
    /// The same as a share of its width.
    pub(crate) of_width: String,
}

impl Head {
    /// The head of a picture of a height, whose first panel begins below `top`.
    fn above(legend: &[Entry], top: f64, height: f64) -> Self {
        // the first heading reaches a little higher where its letters are larger
        let percent = |of: f64| format!("{:.2}%", 100.0 * (top - 5.0) / of);
        Self {
            legend: legend.iter().map(Entry::shown).collect(),
            of_height: percent(height),
            of_width: percent(WIDTH),
        }
    }
}

impl Plot {
    /// The picture as a file of its own, with a line at its foot that says where it is from, as `01-kinematics · move`.
    pub fn captioned(&self, caption: &str) -> String {
        canvas::captioned(&self.svg, caption)
    }

    /// The picture to stand in a page that brings the style sheet of plots itself.
    pub(crate) fn inline(&self) -> impl Iterator<Item = &str> {
        let (head, rest) = self.svg.split_once("<style>").unwrap_or((&self.svg, ""));
        let (_, tail) = rest.split_once("</style>").unwrap_or(("", rest));
        [head, tail].into_iter()
    }
}

/// All plots of a run: the TCP's path, its distance to the goals, positions, velocities and efforts of the joints, one for each curve that a check judged, and the
/// signals the submission drew. The same run gives the same bytes.
pub fn plots(run: &TaskRun) -> Vec<Plot> {
    let mut plots = Plots {
        stem: file_stem(&run.task),
        made: Vec::new(),
    };
    if let Some((svg, title, axes, head)) = path::path(run) {
        plots.add(PATH, title, svg, &axes, Some(head));
    }
    let mut pictures: Vec<(String, timeline::Timeline)> = Vec::new();
    pictures.extend(signals::error(run).map(|picture| ("error".to_owned(), picture)));
    for (name, of) in [
        ("joints", Of::Positions),
        ("velocities", Of::Velocities),
        ("effort", Of::Efforts),
    ] {
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
        let (svg, axes, head) = picture.draw();
        plots.add(&name, picture.title, svg, &axes, Some(head));
    }
    plots.made
}

/// The file of the picture of a task's path, in the folder of a report's plots.
pub fn path_file(task: &str) -> String {
    format!("{}-{PATH}.svg", file_stem(task))
}

/// Plots with names that differ.
struct Plots {
    stem: String,
    made: Vec<Plot>,
}

impl Plots {
    fn add(&mut self, name: &str, title: String, svg: String, axes: &[Axes], head: Option<Head>) {
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
            head,
        });
    }
}

#[cfg(test)]
mod tests {
    use kinemark_sim::control::Mode;
    use kinemark_sim::trace::PlotSignal;

    use super::reading::tests::Reader;
    use super::*;
    use crate::palette::{AMBER_DASHED, BLUE, MUTED_DASHED, PURPLE_DASHED, hex};
    use kinemark_grader::record::graded::{Curve, StepBackdrop};
    use kinemark_grader::record::sample;

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
            "velocities",
            "effort",
            "check-trajectory-match",
            "signals",
        ];
        assert_eq!(names, expected.map(|name| format!("move-{name}")));
    }

    /// Values read off a picture are those of the run.
    #[test]
    fn the_picture_of_a_path_is_found_by_its_task() {
        let plots = plots(&sample::task_run());
        let file = path_file("move");
        assert!(
            plots
                .iter()
                .any(|plot| format!("{}.svg", plot.name) == file)
        );
    }

    #[test]
    fn axes_show_where_values_lie() {
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

    /// What is read off a panel at every so many ticks holds the value of the run, and gives it within `most` of the panel's height,
    /// or as a range.
    fn read_at_ticks(
        plots: &[Plot],
        (plot, panel, series): (&str, usize, usize),
        value: impl Fn(usize) -> f64,
        ticks: std::ops::Range<usize>,
        most: f64,
    ) {
        let plot = plots.iter().find(|p| p.name == plot).expect("the plot");
        let reader = Reader::new(plot, panel, series);
        for tick in ticks.step_by(7) {
            let (low, high) = reader.at(0.001 * tick as f64).expect("a value");
            let exact = value(tick);
            assert!(
                low <= exact && exact <= high,
                "{} at {tick}: {exact} is not within {low} and {high}",
                plot.name
            );
            // a jump is read as from where to where
            let around = (tick.saturating_sub(2)..=tick + 2).map(&value);
            let (least, greatest) = axis::extent(around).expect("values");
            let height = (high - low - (greatest - least)) / reader.height();
            assert!(height <= most, "{} at {tick}: {low} to {high}", plot.name);
        }
    }

    #[test]
    fn what_is_read_off_a_smooth_line_is_the_runs_value() {
        let run = sample::task_run();
        let plots = plots(&run);
        for joint in 0..2 {
            let q = |tick: usize| run.trace.q.at(tick)[joint];
            read_at_ticks(&plots, ("move-joints", joint, 1), q, 2..7998, 0.15);
            let qd = |tick: usize| run.trace.qd.at(tick)[joint];
            read_at_ticks(&plots, ("move-velocities", joint, 0), qd, 2..7998, 0.15);
            let effort = |tick: usize| run.trace.effort.at(tick)[joint];
            read_at_ticks(&plots, ("move-effort", joint, 0), effort, 2..7998, 0.15);
        }
    }

    #[test]
    fn a_chatter_is_read_as_from_its_lowest_to_its_highest() {
        let sign = |tick: u64| if tick.is_multiple_of(2) { 1.0 } else { -1.0 };
        let mut run = sample::chain(2, 10_001, |tick, _| 15.0 * sign(tick));
        run.effort_limits = vec![15.0; 2];
        let plots = plots(&run);
        let effort = plots.iter().find(|plot| plot.name.ends_with("effort"));
        let effort = effort.expect("efforts");
        let reader = Reader::new(effort, 0, 0);
        for tick in (10..9990).step_by(13) {
            let (low, high) = reader.at(0.001 * f64::from(tick)).expect("a band");
            assert!((low + 15.0).abs() < 0.2 && (high - 15.0).abs() < 0.2);
        }
        // a rectangle
        assert!(effort.svg.len() < 12_000, "{}", effort.svg.len());
    }

    #[test]
    fn what_is_read_off_25_joints_holds_the_runs_values() {
        // slow and fast waves, noise, and jumps, by joint
        let row = |tick: u64, joint: usize| match joint % 4 {
            0 => libm::sin(0.001 * (tick * (1 + joint as u64)) as f64),
            1 => libm::sin(0.2 * tick as f64) * 3.0,
            2 => (tick.wrapping_mul(7_919) % 1_000) as f64,
            _ => (tick / 500 % 3) as f64,
        };
        let run = sample::chain(25, 10_001, row);
        let plots = sound(&run);
        // in a page, where a task has 300 KB, of which its replay takes up to 120
        let inline = plots.iter().flat_map(Plot::inline).map(str::len);
        let bytes = inline
            .chain(plots.iter().map(|p| p.axes.len()))
            .sum::<usize>();
        assert!(bytes < 180_000, "{bytes}");
        let effort = |tick: usize, joint: usize| run.trace.effort.at(tick)[joint];
        for joint in 0..25 {
            let name = match joint / 6 {
                0 => format!("{}-effort", run.task),
                part => format!("{}-effort-{}", run.task, part + 1),
            };
            // the fast waves may be bands
            let is_slow = joint % 4 == 0 && joint <= 8;
            let most = if is_slow { 0.15 } else { 1.1 };
            let place = (name.as_str(), joint % 6, 0);
            read_at_ticks(&plots, place, |tick| effort(tick, joint), 2..9_998, most);
        }
    }

    #[test]
    fn a_value_beyond_the_picture_is_read_as_cut_off() {
        let mut run = sample::chain(1, 2_001, |_, _| 5.0);
        run.mode = Mode::Effort;
        run.effort_limits = vec![15.0];
        let spike = sample::chain(1, 2_001, |tick, _| if tick == 1000 { 81.08 } else { 5.0 });
        run.trace.command = spike.trace.command;
        let plots = plots(&run);
        let effort = plots.iter().find(|plot| plot.name.ends_with("effort"));
        let reader = Reader::new(effort.expect("efforts"), 0, 0);
        assert_eq!(reader.cut(), Some(22.5));
        let (_, high) = reader.at(1.0).expect("a value");
        assert!(high >= 22.5, "{high}");
    }

    #[test]
    fn a_file_of_its_own_says_where_it_is_from() {
        for plot in plots(&sample::task_run()) {
            let file = plot.captioned("01-kinematics \u{b7} <move>");
            assert!(file.contains("\n01-kinematics \u{b7} &lt;move&gt;\n"));
            assert!(!plot.svg.contains("01-kinematics"));
            let height = |svg: &str| -> f64 {
                let (_, rest) = svg.split_once(" height=\"").expect("a height");
                rest.split_once('"')
                    .expect("a height")
                    .0
                    .parse()
                    .expect("a number")
            };
            assert!((height(&file) - height(&plot.svg) - 22.0).abs() < 1e-9);
        }
    }

    #[test]
    fn what_was_judged_is_called_by_its_title() {
        let mut run = sample::task_run();
        let check = run.curves[0].check.clone();
        run.check_titles = [(check, "Follows `the` path".to_owned())].into();
        let plots = plots(&run);
        assert!(
            plots
                .iter()
                .any(|plot| plot.title == "Judged: Follows the path")
        );
    }

    #[test]
    fn the_band_of_a_judged_curve_is_known_to_a_reader() {
        let mut run = sample::task_run();
        let axes = |run: &TaskRun| -> serde_json::Value {
            let plots = plots(run);
            let plot = plots.iter().find(|plot| plot.name.contains("-check-"));
            serde_json::from_str(&plot.expect("a curve").axes).expect("JSON")
        };
        (run.curves[0].full, run.curves[0].zero) = (Some(0.25), Some(0.5));
        run.curves[0].unit = "rad".to_owned();
        let panel = axes(&run)[0].clone();
        assert_eq!(
            (&panel["full"], &panel["zero"]),
            (&0.25.into(), &0.5.into())
        );
        // without an end there is no side that costs points
        run.curves[0].zero = None;
        assert!(axes(&run)[0].get("full").is_none());
    }

    #[test]
    fn every_axis_has_two_numbers() {
        for height in [105.0, 125.0, 150.0, 210.0] {
            for (min, max) in [
                (-0.9, 0.9),
                (-15.0, 17.0),
                (-33.0, 3.0),
                (0.0, 1e-3),
                (0.3, 0.301),
            ] {
                let ticks = axis::Axis::exact(min, max).ticks((height / 34.0) as usize);
                assert!((2..=12).contains(&ticks.len()), "{min} to {max}: {ticks:?}");
            }
        }
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
            reference: None,
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
    fn a_step_response_has_its_reference_prediction_target_and_band() {
        let lag = |t_s: f64, rate: f64| 1.0 - libm::exp(-rate * t_s);
        let t_s: Vec<f64> = (0..1000).map(|tick| 0.001 * f64::from(tick)).collect();
        let of = |rate: f64| t_s.iter().map(|t_s| lag(*t_s, rate)).collect();
        let mut run = sample::chain(2, 1000, |_, _| 0.0);
        run.curves = vec![Curve {
            reference: Some(of(9.0)),
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
            ">\nreference\n<",
            "run less reference",
            "linear prediction",
            "target 1.05\u{a0}rad",
            "within 2 % of the final value",
        ] {
            assert!(plot.svg.contains(word), "no {word:?}");
        }
        // the run lags behind the reference: the difference is below zero
        let difference = Reader::new(plot, 1, 0);
        let (low, high) = difference.at(0.1).expect("a value");
        let expected = lag(0.1, 8.0) - lag(0.1, 9.0);
        assert!(
            low <= expected && expected <= high && high < 0.0,
            "{low} {high}"
        );
        // the run, the reference, the prediction and the target are four lines of different looks
        for colour in [BLUE, AMBER_DASHED, PURPLE_DASHED, MUTED_DASHED] {
            let dashes = colour
                .dashes
                .map(|dashes| format!("dasharray=\"{dashes}\" stroke-"));
            let dashes = dashes.unwrap_or_default();
            let key = format!("stroke=\"{}\" stroke-{dashes}width", hex(colour.light));
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
