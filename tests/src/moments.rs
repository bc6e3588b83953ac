//! Moments at which points were lost: terminal, page, replay and storyboard show the same moment of the visible run.

use kinemark_grader::lab::{Lab, Staff};
use kinemark_grader::record::grade::{Outcome, TaskGrade};
use kinemark_grader::record::graded::GradedRun;
use kinemark_report::moment::first_loss_of;
use kinemark_report::{html, replay::Replay, storyboard::storyboard, text::text};
use serde_json::Value;

use crate::testbed::{grade, lab, root, staff};

/// The known submission `case` of a lab, graded for practice.
fn graded(name: &str, case: &str) -> GradedRun {
    graded_by(&lab(name), name, case, None)
}

fn graded_by(lab: &Lab, name: &str, case: &str, staff: Option<&Staff>) -> GradedRun {
    let path = root().join(format!("tests/submissions/{name}/{case}/submission.rhai"));
    let submission = std::fs::read_to_string(path).expect("a submission");
    grade(lab, staff, "submission.rhai", &submission)
}

fn task<'a>(graded: &'a GradedRun, name: &str) -> &'a TaskGrade {
    let mut tasks = graded.grade.tasks.iter();
    tasks.find(|task| task.name == name).expect("the task")
}

/// The replay of a task.
fn replay(graded: &GradedRun, name: &str) -> Value {
    let mut runs = graded.runs.iter();
    let run = runs.find(|run| run.task == name).expect("the run");
    serde_json::from_str(&Replay::of(run, Some(task(graded, name))).json()).expect("JSON")
}

/// What the terminal shows, without its colours.
fn plain(graded: &GradedRun) -> String {
    let text = text(&graded.grade);
    let mut parts = text.split('\u{1b}');
    let first = parts.next().unwrap_or_default().to_owned();
    let rest = parts.filter_map(|part| Some(part.split_once('m')?.1));
    rest.fold(first, |text, part| text + part)
}

fn board(graded: &GradedRun, name: &str) -> String {
    let mut runs = graded.runs.iter();
    let run = runs.find(|run| run.task == name).expect("the run");
    storyboard(run, task(graded, name))
}

#[test]
fn a_loss_is_marked_where_the_band_was_left() {
    let graded = graded("04-knock-with-velocity", "cuts-the-corner");
    let knock = task(&graded, "knock");
    let check = knock
        .checks
        .iter()
        .find(|check| check.title == "On the first line");
    let check = check.expect("the check");
    let first = check.first_lost.expect("a moment");
    // the evidence gives the furthest point; the loss began before it
    let furthest = check.evidence[0].tick.expect("a tick");
    assert!(first.tick + 100 < furthest, "{first:?}, {furthest}");
    let curve = graded.runs[0]
        .curves
        .iter()
        .find(|curve| curve.check == check.name);
    let curve = curve.expect("the curve it judged");
    let full = curve.full.expect("a band");
    let at = curve
        .t_s
        .iter()
        .position(|t_s| (t_s - first.time_s).abs() < 1e-9);
    let at = at.expect("a sample there");
    assert!(curve.values[at] > full && curve.values[at - 1] <= full);
    // terminal, replay and storyboard have that moment
    let link = format!("#task=knock&t={}", first.time_s);
    assert_eq!(first_loss_of(knock).expect("a loss").fragment(), link);
    let output = plain(&graded);
    assert!(
        output.contains(&format!(
            "points are lost from {} s on [tick {}] {link}",
            first.time_s, first.tick
        )),
        "{output}"
    );
    let events = replay(&graded, "knock")["events"].clone();
    let mut marks = events.as_array().expect("events").iter();
    let mark = marks.find(|mark| mark["kind"] == "breach" && mark["tick"] == first.tick);
    let text = mark.expect("a mark")["text"]
        .as_str()
        .expect("words")
        .to_owned();
    assert_eq!(text, "On the first line: beyond 8.2 mm from here on");
    let board = board(&graded, "knock");
    assert!(board.contains(&link.replace('&', "&amp;")), "a panel");
    assert!(
        board.contains("Lost: On the first line (0 of 3): beyond 8.2 mm"),
        "{board}"
    );
    let seek = format!(
        "Points were lost at <a class=\"seek\" href=\"{}\">",
        link.replace('&', "&amp;")
    );
    assert!(
        html::html(&graded, &[], &html::PageExtras::default()).contains(&seek),
        "the page"
    );
    // and the reported points add up
    let parts: f64 = knock.checks.iter().map(|check| check.points).sum();
    assert!(
        (parts - knock.points).abs() < 1e-9,
        "{parts}, {}",
        knock.points
    );
    let hundredths = knock.points * 100.0;
    assert!(
        (hundredths - hundredths.round()).abs() < 1e-6,
        "{}",
        knock.points
    );
}

#[test]
fn a_run_under_a_disturbance_has_no_moment_of_the_run_that_is_shown() {
    let graded = graded("02-jacobian-velocity", "undamped-with-feedback");
    let shoulder = task(&graded, "through-the-shoulder");
    let lost: Vec<_> = shoulder
        .checks
        .iter()
        .filter(|check| check.outcome != Outcome::Full)
        .collect();
    assert!(!lost.is_empty());
    for check in lost {
        for fact in check.evidence.iter().filter(|fact| fact.run.is_some()) {
            assert_eq!(
                (fact.tick, fact.time_s, fact.run.as_deref()),
                (None, None, Some("payload"))
            );
            assert!(
                fact.message.starts_with("in the run `payload` ("),
                "{}",
                fact.message
            );
        }
        assert_eq!(check.first_lost, None);
    }
    assert_eq!(
        first_loss_of(shoulder).expect("a loss").fragment(),
        "#task=through-the-shoulder"
    );
    let replay = replay(&graded, "through-the-shoulder");
    let events = replay["events"].as_array().expect("events");
    assert!(
        events.iter().all(|event| event["kind"] != "breach"),
        "{events:?}"
    );
    assert!(!board(&graded, "through-the-shoulder").contains("Lost"));
}

#[test]
fn a_stop_leads_to_the_last_tick_there_is() {
    let lab = lab("01-kinematics");
    let of = |source: &str| grade(&lab, None, "mine.rhai", source);
    let late = of("fn control(o) { if o.time >= 3.01 { throw \"no\" } [0.0, 0.0] }");
    let stopped = task(&late, "move").stopped.as_ref().expect("a stop");
    assert_eq!(stopped.tick, Some(3010));
    let loss = first_loss_of(task(&late, "move")).expect("a loss");
    assert_eq!(loss.fragment(), "#task=move&t=3.009");
    let output = plain(&late);
    assert!(
        output.contains("(at 3.01 s, tick 3010) #task=move&t=3.009"),
        "{output}"
    );
    let page = html::html(&late, &[], &html::PageExtras::default());
    assert!(page.contains("<a class=\"seek\" href=\"#task=move&amp;t=3.009\">3.01 s</a>"));
    let ticks = late
        .runs
        .iter()
        .find(|run| run.task == "move")
        .map(|run| run.trace.len());
    assert_eq!(ticks, Some(8001), "it goes on with the last command");
    let board = board(&late, "move");
    assert!(
        board.contains(">3.009\u{a0}s<") && board.contains("Stopped at 3.01 s: "),
        "{board}"
    );
    // a first call that fails leaves nothing to show but the section
    let at_once = of("fn control(o) { throw \"no\" }");
    let output = plain(&at_once);
    assert!(output.contains("(at 0 s, tick 0) #task=move\n"), "{output}");
    let loss = first_loss_of(task(&at_once, "move")).expect("a loss");
    assert_eq!(loss.fragment(), "#task=move");
    // which is there without a script, too
    assert!(html::html(&at_once, &[], &html::PageExtras::default()).contains("id=\"task=move\""));
}

#[test]
fn a_held_goal_is_reported_at_the_worst_moment_of_its_best_dwell() {
    let graded = graded("03-knock-with-position", "sags");
    let hold = task(&graded, "hold");
    let timed = hold.checks[0]
        .evidence
        .iter()
        .filter_map(|fact| Some((fact.time_s?, fact)));
    let mut count = 0;
    for (time_s, fact) in timed {
        assert!(
            fact.message
                .contains(&format!(" away: at {time_s} s it is at ")),
            "{fact:?}"
        );
        count += 1;
    }
    assert_eq!(count, 2, "both goals");
    // both are in the picture: what cost points comes before what fills it
    let board = board(&graded, "hold");
    assert!(
        board.contains("Lost: The hand stands at both places (0 of 6)"),
        "{board}"
    );
    assert_eq!(
        board.matches(">Lost: The hand stands").count(),
        2,
        "{board}"
    );
}

#[test]
fn the_costliest_check_is_in_the_picture() {
    let graded = graded("03-knock-with-position", "stays");
    let board = board(&graded, "knock");
    assert!(
        board.contains("Lost: The can is pushed, not hit (0 of 2)"),
        "{board}"
    );
    assert!(!board.contains('`'));
}

#[test]
fn what_stands_from_the_start_is_no_news() {
    let graded = graded("03-knock-with-position", "good");
    let run = graded
        .runs
        .iter()
        .find(|run| run.task == "knock")
        .expect("the run");
    let standing = run
        .trace
        .contacts
        .iter()
        .any(|contact| contact.first_tick < 10);
    assert!(standing, "the can stands on the shelf");
    let replay = replay(&graded, "knock");
    let events = replay["events"].as_array().expect("events");
    let early = |event: &&Value| event["kind"] == "contact" && event["tick"].as_u64() < Some(100);
    assert_eq!(events.iter().filter(early).count(), 0, "{events:?}");
    assert!(
        events.iter().any(|event| event["kind"] == "contact"),
        "the arm's is"
    );
    let page = html::html(&graded, &[], &html::PageExtras::default());
    assert!(page.contains("Before anything moved: "));
    // the first row of the table of contacts is the arm's
    let contacts = page
        .split_once("aria-label=\"Contacts\"")
        .expect("the table")
        .1;
    let first = contacts.split_once("<th scope=\"row\">").expect("a row").1;
    let first = first.split_once("</th>").expect("its end").0;
    assert!(first.contains("forearm"), "{first}");
}

#[test]
fn a_mean_with_hidden_runs_says_what_the_visible_one_earns() {
    let name = "00-step-response";
    let lab = lab(name);
    let graded = graded_by(&lab, name, "soft-gains", Some(&staff(&lab, None)));
    let pid = task(&graded, "pid");
    let shoulder = pid
        .checks
        .iter()
        .find(|check| check.title == "The shoulder is held");
    let shoulder = shoulder.expect("the check");
    let output: Vec<&str> = shoulder
        .evidence
        .iter()
        .map(|fact| fact.message.as_str())
        .collect();
    let mean =
        "the visible run alone earns 0 of 1; the points are the mean of it and 2 hidden runs";
    assert!(output.contains(&mean), "{output:?}");
    // a check that needs it earns something just where it does
    for (task, asked) in graded.grade.tasks.iter().zip(&lab.tasks) {
        for (check, asked) in task.checks.iter().zip(asked.checks()) {
            for need in &asked.needs {
                let needed = &task.checks[*need];
                assert!(
                    check.points <= 0.0 || needed.points > 0.0,
                    "{}: {check:?} needs {needed:?}",
                    task.name
                );
            }
        }
    }
}
