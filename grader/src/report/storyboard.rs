//! The storyboard of a motion task: six moments of the run in one picture, for places that show no page.

mod board;
mod camera;
mod face;
mod layers;
mod moment;
mod order;
mod scenery;
mod stage;
mod svg;
mod view;

use nalgebra::Point3;

use self::board::Board;
use self::camera::Camera;
use self::face::Face;
use self::moment::{Moment, moments};
use self::scenery::Scenery;
use self::stage::Stage;
use self::view::View;
use crate::grade::TaskGrade;
use crate::graded::TaskRun;

/// Width of the picture, its margin, and the room between two panels \[px\].
const WIDTH: f64 = 1000.0;
const MARGIN: f64 = 20.0;
const GAP: f64 = 16.0;
const COLUMNS: usize = 3;
const PANEL: f64 = (WIDTH - 2.0 * MARGIN - 2.0 * GAP) / COLUMNS as f64;

/// The storyboard of `run` with what its grade says of it, as an SVG of its own. The same run and grade give the same bytes.
///
/// A run without a tick has one panel: the arm as its file has it.
pub fn storyboard(run: &TaskRun, grade: &TaskGrade) -> String {
    let stage = Stage::of(run);
    let camera = Camera::of(run);
    let mut panels: Vec<Panel> = moments(run, grade)
        .into_iter()
        .map(|moment| Panel::of(&stage, Some(moment.tick), moment))
        .collect();
    if panels.is_empty() {
        let words = grade
            .stopped
            .as_ref()
            .map(|stopped| format!("stopped before the first tick: {}", stopped.message));
        let words = words.unwrap_or_else(|| "stopped before the first tick".to_owned());
        let moment = Moment {
            tick: 0,
            words: vec![words],
            bad: true,
            touch_m: None,
        };
        panels.push(Panel::of(&stage, None, moment));
    }
    let scenery = Scenery::of(run, &stage);
    let board = Board {
        view: View::around(&camera, &panels, &scenery),
        run,
        grade,
        camera,
        panels,
        scenery,
    };
    board.draw()
}

/// One moment with all that is seen at it.
struct Panel {
    moment: Moment,
    faces: Vec<Face>,
    joints: Vec<Point3<f64>>,
    tcp: Point3<f64>,
}

impl Panel {
    fn of(stage: &Stage<'_>, tick: Option<usize>, moment: Moment) -> Self {
        let (joints, tcp) = stage.joints(tick);
        Self {
            faces: stage.faces(tick),
            moment,
            joints,
            tcp,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::sample;

    /// What must hold of every storyboard, whatever the run.
    fn sound(run: &TaskRun) -> String {
        let graded = sample::graded();
        let grade = graded.grade.tasks.iter().find(|task| task.name == "move");
        let grade = grade.expect("the motion task");
        let svg = storyboard(run, grade);
        assert_eq!(svg, storyboard(run, grade), "the same bytes");
        assert!(svg.starts_with("<svg ") && svg.ends_with("</svg>\n"));
        assert!(
            !svg.contains("NaN") && !svg.contains("inf "),
            "numbers only"
        );
        assert!(svg.len() < 900_000, "{} bytes", svg.len());
        svg
    }

    fn panels(svg: &str) -> usize {
        svg.matches("<clipPath").count()
    }

    #[test]
    fn a_run_is_shown_in_six_panels_with_their_links() {
        let svg = sound(&sample::task_run());
        assert_eq!(panels(&svg), 6);
        assert!(svg.contains("href=\"../report.html#task=move&amp;t=8\""));
        assert!(svg.contains("Goal 1 reached"), "its captions");
        assert!(svg.contains("reference"), "its legend");
    }

    #[test]
    fn runs_of_no_tick_of_one_and_of_many_joints_are_shown() {
        assert_eq!(panels(&sound(&sample::chain(2, 0, |_, _| 0.0))), 1);
        assert_eq!(panels(&sound(&sample::stopped_after(0))), 1);
        assert_eq!(panels(&sound(&sample::stopped_after(3))), 4);
        let wave =
            |tick: u64, joint: usize| 0.2 * libm::sin(0.004 * tick as f64 + 0.5 * joint as f64);
        assert_eq!(panels(&sound(&sample::chain(25, 1000, wave))), 6);
    }

    #[test]
    fn positions_that_are_no_numbers_are_shown_as_they_last_were() {
        let wild = |tick: u64, _: usize| match tick {
            0..400 => 0.001 * tick as f64,
            400..600 => f64::NAN,
            _ => f64::INFINITY,
        };
        sound(&sample::chain(3, 1000, wild));
        sound(&sample::chain(3, 1000, |tick, _| {
            libm::pow(10.0, tick as f64 * 0.3)
        }));
    }

    #[test]
    fn hostile_names_are_words_in_the_picture() {
        let mut graded = sample::graded();
        let grade = &mut graded.grade.tasks[3];
        let hostile = "</text><script>alert(1)</script>\u{0}\u{1b}[2J\u{202E}\"'&".repeat(30);
        grade.title.clone_from(&hostile);
        for check in &mut grade.checks {
            check.title.clone_from(&hostile);
        }
        let mut run = sample::task_run();
        run.task = "a b\"<".to_owned();
        let svg = storyboard(&run, grade);
        assert!(!svg.contains("<script") && !svg.contains(['\0', '\u{1b}', '\u{202E}']));
        assert!(svg.contains("#task=a%20b%22%3C&amp;t="));
        #[cfg(not(target_family = "wasm"))]
        crate::report::png::png(&svg).expect("a picture");
    }
}
