//! The storyboard of a motion task: six moments of the run in one picture, for places that show no page.

mod board;
mod camera;
mod cause;
mod face;
mod layers;
mod moment;
mod order;
mod scenery;
mod stage;
mod svg;
mod target;
mod view;

use nalgebra::Point3;

use self::board::Board;
use self::camera::Camera;
use self::face::Face;
use self::moment::{Moment, moments};
use self::scenery::Scenery;
use self::stage::Stage;
use self::target::{Target, targets};
use self::view::View;
use kinemark_grader::record::grade::TaskGrade;
use kinemark_grader::record::graded::TaskRun;

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
    board(run, grade).draw()
}

/// One panel of a storyboard, for a page that writes its captions itself.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Chapter {
    /// The time of its moment \[s\].
    pub(crate) time_s: f64,
    /// What happened then, a sentence each.
    pub(crate) words: Vec<String>,
    /// Whether it cost points, or ended the run.
    pub(crate) is_bad: bool,
    /// The picture, as a part of a page; its names begin with the prefix that was given.
    pub(crate) svg: String,
}

/// Whether a run has moments to show: of an arm that stands from its first tick to its last, such as one whose submission stops at once,
/// all pictures are the same.
pub fn has_storyboard(run: &TaskRun) -> bool {
    let trace = &run.trace;
    let bits = |tick: usize| trace.q.at(tick).iter().map(|q| q.to_bits());
    let arm_moves = (1..trace.len()).any(|tick| !bits(tick).eq(bits(0)));
    let touches = !trace.contacts.is_empty();
    !trace.is_empty() && (arm_moves || touches)
}

/// The panels of a storyboard one by one; none of a run without a tick.
pub(crate) fn chapters(run: &TaskRun, grade: &TaskGrade, prefix: &str) -> Vec<Chapter> {
    if !has_storyboard(run) {
        return Vec::new();
    }
    board(run, grade).chapters(prefix)
}

fn board<'a>(run: &'a TaskRun, grade: &'a TaskGrade) -> Board<'a> {
    let stage = Stage::of(run);
    let camera = Camera::of(run);
    let targets = targets(run);
    let mut panels: Vec<Panel> = moments(run, grade)
        .into_iter()
        .map(|moment| Panel::of(&stage, &targets, Some(moment.tick), moment))
        .collect();
    if panels.is_empty() {
        let moment = Moment {
            tick: 0,
            words: not_run(grade),
            bad: true,
            touch_m: None,
        };
        panels.push(Panel::of(&stage, &targets, None, moment));
    }
    let scenery = Scenery::of(run, &stage);
    Board {
        view: View::around(&camera, &panels, &scenery),
        run,
        grade,
        camera,
        panels,
        scenery,
    }
}

/// Why nothing was run, a sentence each.
fn not_run(grade: &TaskGrade) -> Vec<String> {
    let mut words = vec!["stopped before the first tick".to_owned()];
    if let Some(stopped) = &grade.stopped {
        words.push(stopped.message.clone());
        words.extend(stopped.line.map(|line| {
            let source = stopped.source_line.as_deref().unwrap_or_default();
            format!("line {line}: {}", source.trim())
        }));
        words.extend(stopped.help.as_ref().map(|help| format!("next: {help}")));
    }
    words
}

/// One moment with all that is seen at it.
struct Panel {
    moment: Moment,
    faces: Vec<Face>,
    joints: Vec<Point3<f64>>,
    tcp: Point3<f64>,
    /// From each joint with a target to where the TCP would be if it were there.
    aims: Vec<[Point3<f64>; 2]>,
}

impl Panel {
    fn of(stage: &Stage<'_>, targets: &[Target], tick: Option<usize>, moment: Moment) -> Self {
        let (joints, tcp) = stage.joints(tick);
        Self {
            faces: stage.faces(tick),
            aims: targets
                .iter()
                .filter_map(|target| target.aim(stage, tick))
                .collect(),
            moment,
            joints,
            tcp,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use kinemark_grader::record::sample;

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
    fn what_was_never_run_is_shown_with_its_line_beside_the_arm() {
        let mut graded = sample::graded();
        let stopped = graded
            .grade
            .tasks
            .iter_mut()
            .find_map(|task| task.stopped.take());
        let grade = &mut graded.grade.tasks[3];
        grade.stopped = Some(kinemark_grader::record::grade::Stopped {
            message: "`wrist` is not known".to_owned(),
            line: Some(12),
            source_line: Some("    let q = wrist;".to_owned()),
            help: None,
            tick: None,
            time_s: None,
            ..stopped.expect("a task that was stopped")
        });
        let mut run = sample::chain(2, 0, |_, _| 0.0);
        run.task = "move".to_owned();
        let svg = storyboard(&run, grade);
        assert_eq!(panels(&svg), 1);
        for words in [
            ">Wrist is not known<",
            ">Line 12: let q = wrist;<",
            "not run",
        ] {
            assert!(svg.contains(words), "{words}");
        }
        assert!(
            svg.contains("href=\"../report.html#task=move\""),
            "no moment"
        );
    }

    #[test]
    fn links_are_written_in_full_or_all_by_their_times() {
        let graded = sample::graded();
        let mut run = sample::task_run();
        assert!(storyboard(&run, &graded.grade.tasks[3]).contains(">#task=move&amp;t=8<"));
        run.task = "through-the-shoulder-and-back".to_owned();
        let svg = storyboard(&run, &graded.grade.tasks[3]);
        assert!(svg.contains(">t=8<") && svg.contains(">t=0<"));
        assert!(!svg.contains('\u{2026}'), "nothing is cut");
    }

    #[test]
    fn points_are_those_of_the_terminal_and_captions_have_no_code() {
        let mut graded = sample::graded();
        let grade = &mut graded.grade.tasks[3];
        (grade.points, grade.max_points) = (9.999, 10.0);
        let svg = storyboard(&sample::task_run(), grade);
        assert!(svg.contains(">9.99 of 10 points<"));
        assert!(!svg.contains('`'), "backticks in a picture");
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
        crate::png::png(&svg).expect("a picture");
    }
}
