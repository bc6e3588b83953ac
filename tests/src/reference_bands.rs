//! Bands that name the reference, and distances of whole runs from it: graded with the reference solution, in practice with what the
//! lab ships, and where neither is there.

use kinemark_grader::audit::practice_forms;
use kinemark_grader::judge::grade;
use kinemark_grader::lab::copies::Copies;
use kinemark_grader::lab::practice::{PRACTICE_FILE, file_text};
use kinemark_grader::lab::{Lab, Staff, Variant};
use kinemark_grader::record::grade::{CheckGrade, Outcome, TaskGrade};
use kinemark_grader::record::graded::GradedRun;
use kinemark_grader::record::verdict::Verdict;
use kinemark_grader::submission::host::InProcess;
use kinemark_sim::text::{Dimension, Source};

use crate::testbed::root;

/// A step of the elbow under a law that the brief prescribes; `checks` are those of its only task.
fn lab_text(checks: &str) -> String {
    format!(
        "format = 1\nname = \"97-law\"\ntitle = \"A law\"\nrobot = \"rrbot\"\nframe = \"lab\"\n\
         [parameters]\nstep = 1.0\nkp = 100.0\nki = 0.01\nkd = 10.0\nslack = 0.25\n\
         [variants]\nstep = {{ from = 0.6, to = 1.4, step = 0.1 }}\n\
         [[tasks]]\nname = \"law\"\ntitle = \"The law\"\n\
         motion = {{ mode = \"effort\", duration_s = 3.0, control_period_ms = 1.0, target = {{ elbow = \"= step\", kp = \"= kp\", ki = \"= ki\", kd = \"= kd\" }}, servo = {{ effort_limit = [30.0, 15.0] }} }}\n\
         {checks}\n"
    )
}

const RISE: &str = "[[tasks.checks]]\nname = \"rise\"\ntitle = \"Quick\"\npoints = 2.0\n\
    rise-time = { joint = \"elbow\", target_rad = \"= step\", full_s = \"= 1.25 * reference\", zero_s = \"= 2 * reference + slack\" }\n";
const MATCH: &str = "[[tasks.checks]]\nname = \"match\"\ntitle = \"As prescribed\"\npoints = 3.0\n\
    response-match = { joint = \"elbow\", full_rad = 0.001, zero_rad = 0.1 }\n";

/// The prescribed law, with these expressions for its gains.
fn law([kp, ki, kd]: [&str; 3]) -> String {
    format!(
        "fn init(robot, task) {{ this.sum = [0.0, 0.0]; }}\n\
         fn control(o) {{\n    let t = o.target;\n    let e = [0.0, t.elbow] - o.q;\n    this.sum += e * o.dt;\n    \
         e * ({kp}) + this.sum * ({ki}) - o.qd * ({kd})\n}}\n"
    )
}

const RIGHT: [&str; 3] = ["t.kp", "t.ki", "t.kd"];

/// The labs folder with this lab, and the course staff's with its solution.
struct Course {
    labs: Copies,
    reference: Copies,
}

impl Course {
    fn new(checks: &str, solution: &str) -> Self {
        let robot =
            std::fs::read_to_string(root().join("labs/robots/rrbot.toml")).expect("a robot");
        Self {
            labs: Copies::from_texts([
                ("97-law/lab.toml", lab_text(checks).as_str()),
                ("robots/rrbot.toml", robot.as_str()),
            ]),
            reference: Copies::from_texts([("97-law/solution.rhai", solution)]),
        }
    }

    fn lab(&self, step: Option<f64>) -> Lab {
        let variant = step.map(|step| {
            let numbers = [("step".to_owned(), Dimension::Number(step))];
            Variant::new("97-law", None, &numbers).expect("a variant")
        });
        Lab::load_variant(&self.labs, "97-law", variant.as_ref()).expect("the lab")
    }

    fn staff(&self, lab: &Lab) -> Staff {
        let staff = Staff::load(&self.reference, lab, None).expect("the staff's part");
        staff.expect("a solution")
    }

    /// Ships what students get of the solution.
    fn filled(mut self) -> Self {
        let lab = self.lab(None);
        let forms = practice_forms(&self.labs, &lab, &self.staff(&lab), &|| {}).expect("forms");
        assert_eq!(forms.len(), 21);
        self.labs.add(
            format!("97-law/{PRACTICE_FILE}"),
            file_text(&forms).expect("JSON"),
        );
        self
    }

    /// The graded run of a submission; with the reference solution, or in practice.
    fn grade(&self, step: Option<f64>, is_graded: bool, submission: &str) -> GradedRun {
        let lab = self.lab(step);
        let staff = is_graded.then(|| self.staff(&lab));
        let source = Source::new("mine.rhai", submission);
        grade(&lab, staff.as_ref(), &source.into(), &mut InProcess).expect("not interrupted")
    }
}

fn task(run: &GradedRun) -> &TaskGrade {
    &run.grade.tasks[0]
}

fn check<'r>(run: &'r GradedRun, name: &str) -> &'r CheckGrade {
    let mut checks = task(run).checks.iter();
    checks.find(|check| check.name == name).expect("the check")
}

#[test]
fn a_band_is_made_of_what_the_reference_reaches_in_the_same_variant() {
    let course = Course::new(RISE, &law(RIGHT));
    let mut reached = Vec::new();
    for step in [None, Some(0.6), Some(1.4)] {
        let run = course.grade(step, true, &law(RIGHT));
        assert_eq!(run.grade.points, 2.0, "{step:?}");
        let measure = check(&run, "rise").measure.clone().expect("a measure");
        let reference = measure.reference.expect("what the reference reaches");
        // the reference is the submission here
        assert_eq!(measure.value, Some(reference));
        assert_eq!(measure.full, 1.25 * reference);
        assert_eq!(measure.zero, 2.0 * reference + 0.25);
        reached.push(reference);
    }
    // every variant has its own
    assert!(
        reached[0] < reached[1] && reached[1] < reached[2],
        "{reached:?}"
    );

    // softer gains are slower: partial credit against the reference's value
    let run = course.grade(None, true, &law(["0.35 * t.kp", "t.ki", "0.6 * t.kd"]));
    let slow = check(&run, "rise");
    let measure = slow.measure.as_ref().expect("a measure");
    let value = measure.value.expect("a value");
    assert_eq!(slow.outcome, Outcome::Partial, "{measure:?}");
    let score = (measure.zero - value) / (measure.zero - measure.full);
    assert!((slow.points - 2.0 * score).abs() < 0.01, "{slow:?}");
    // both curves are drawn, tick by tick
    let curve = &run.runs[0].curves[0];
    let reference = curve.reference.as_ref().expect("the reference's curve");
    assert_eq!(reference.len(), curve.values.len());
    assert!(reference[300] > curve.values[300] + 0.05);
}

#[test]
fn practice_judges_by_what_the_lab_ships_with_the_same_bits() {
    let course = Course::new(RISE, &law(RIGHT)).filled();
    let lab = course.lab(None);
    let student = lab.variant_of("practice", "practice 7").expect("a variant");
    let step = student.parameters().find_map(|(_, value)| match value {
        Dimension::Number(number) => Some(*number),
        Dimension::List(_) | Dimension::Text(_) => None,
    });
    for step in [None, step] {
        let submission = law(["0.5 * t.kp", "t.ki", "0.8 * t.kd"]);
        let [practice, graded] = [false, true].map(|staff| course.grade(step, staff, &submission));
        let [a, b] = [&practice, &graded].map(|run| check(run, "rise").measure.clone());
        assert!(
            a.as_ref()
                .is_some_and(|measure| measure.reference.is_some())
        );
        assert_eq!(a, b);
        assert_eq!(practice.grade.points, graded.grade.points);
        assert_eq!(practice.grade.points_at_hand_in, 0.0);
        // of the reference's run itself nothing reaches a student
        assert_eq!(practice.runs[0].curves[0].reference, None);
    }
    // what students get: one value a variant, no code, no path where the lab gives none
    let shipped = course
        .labs
        .iter()
        .find(|(path, _)| path.ends_with(PRACTICE_FILE));
    let shipped = String::from_utf8_lossy(shipped.expect("shipped").1).into_owned();
    assert_eq!(shipped.matches("\"rise\":").count(), 21);
    assert!(!shipped.contains("points_m") && !shipped.contains("fn "));
}

#[test]
fn what_practice_cannot_judge_is_left_for_the_hand_in() {
    // a variant of which the lab ships nothing, and a whole run to compare with
    let checks = format!("{RISE}{MATCH}");
    let course = Course::new(&checks, &law(RIGHT)).filled();
    let run = course.grade(None, false, &law(RIGHT));
    assert_eq!(check(&run, "match").outcome, Outcome::AtHandIn);
    assert_eq!(run.grade.verdict, Verdict::Passed);
    assert_eq!(
        (
            run.grade.points,
            run.grade.max_points,
            run.grade.points_at_hand_in
        ),
        (2.0, 2.0, 3.0)
    );
    let run = course.grade(Some(0.65), false, &law(RIGHT));
    assert_eq!(check(&run, "rise").outcome, Outcome::AtHandIn);
    assert_eq!(
        (run.grade.max_points, run.grade.points_at_hand_in),
        (0.0, 5.0)
    );
    let text = kinemark_report::text::text(&run.grade);
    assert!(text.contains("judged when you hand in"), "{text}");
    assert!(text.contains("5 more when you hand in"), "{text}");
    let run = course.grade(Some(0.65), true, &law(RIGHT));
    assert_eq!((run.grade.points, run.grade.max_points), (5.0, 5.0));
}

/// Figures of the source document: over 3 s from the run with 100, 0.01 and 10, in mrad (root mean square).
#[test]
fn the_distance_of_responses_shows_a_wrong_gain() {
    let course = Course::new(MATCH, &law(RIGHT));
    for (gains, mrad, within) in [
        (["100", "0.01", "10"], 0.0, 1e-12),
        (["100", "0.01", "9.4"], 4.8, 0.1),
        (["105", "0.01", "10"], 3.9, 0.1),
        (["50", "0.01", "5"], 23.0, 0.6),
        (["100", "120", "10"], 49.0, 0.6),
        (["100", "0.01", "2"], 67.0, 0.6),
    ] {
        let run = course.grade(None, true, &law(gains));
        let measure = check(&run, "match").measure.clone().expect("a measure");
        let apart = 1000.0 * measure.value.expect("a value");
        assert!((apart - mrad).abs() < within, "{gains:?}: {apart} mrad");
        // `reference` is what the curve is drawn with, not a number of this measure
        assert_eq!(measure.reference, None);
        assert!(run.runs[0].curves[0].reference.is_some());
    }
}

#[test]
fn a_reference_that_fails_decides_nothing() {
    for (solution, why) in [
        ("fn control(o) { [0.0, 1.0 / 0] }", "does not reach the end"),
        ("fn control(o) { [0.0, 0.0] }", "has no value for \"Quick\""),
    ] {
        let course = Course::new(RISE, solution);
        let run = course.grade(None, true, &law(RIGHT));
        assert_eq!(task(&run).verdict, Verdict::GraderFault, "{solution}");
        let stopped = task(&run).stopped.as_ref().expect("a stop");
        assert!(stopped.message.contains(why), "{}", stopped.message);
        assert_eq!(check(&run, "rise").outcome, Outcome::NotJudged);
    }
}

#[test]
fn a_band_over_the_reference_has_an_order_and_a_place() {
    let load = |checks: &str| {
        let course = Copies::from_texts([
            ("97-law/lab.toml", lab_text(checks).as_str()),
            (
                "robots/rrbot.toml",
                &std::fs::read_to_string(root().join("labs/robots/rrbot.toml")).expect("a robot"),
            ),
        ]);
        let error = Lab::load(&course, "97-law").expect_err("refused");
        error.to_string()
    };
    for (from, to, words) in [
        (
            "2 * reference + slack",
            "1.2 * reference",
            "`full` may exceed `zero`",
        ),
        ("= 2 * reference + slack", "= 3", "`full` may exceed `zero`"),
        (
            "1.25 * reference",
            "1 / reference",
            "not linear in `reference`",
        ),
        (
            "1.25 * reference",
            "1.25 * referense",
            "no parameter is called `referense`",
        ),
        (
            "points = 2.0",
            "points = \"= reference\"",
            "`reference` has no value here",
        ),
        (
            "target_rad = \"= step\"",
            "target_rad = \"= reference\"",
            "`reference` has no value here",
        ),
    ] {
        assert!(RISE.contains(from), "{from}");
        let error = load(&RISE.replacen(from, to, 1));
        assert!(error.contains(words), "{to}: {error}");
    }
}
