//! The page that goes back through a learning management system: what the report says, without its pictures, replays and logs, small
//! enough to be uploaded for a whole class.

use maud::{Markup, html};

use super::head::{anchor, earned, facts, meaning, scores, verdict};
use super::task::{diagnosed, not_run, stopped};
use super::task_check::checked;
use super::task_shown::TaskShown;
use super::task_tables::hidden;
use super::viewer::ViewerCode;
use super::{foreign, page, prose};
use crate::stop_words::stop_of_whole_file;
use crate::visible::{shortened, visible};
use kinemark_grader::record::grade::{CheckGrade, Grade, Outcome, Stopped, TaskGrade};
use kinemark_grader::record::hints::Hints;
use kinemark_grader::record::quantity::points;

/// The most bytes of a page.
pub const MOST_BYTES: usize = 100_000;

/// Characters of a message that are shown.
const MOST_CHARACTERS: usize = 600;

/// What the page shows.
#[derive(Debug, Clone, Copy)]
pub struct FeedbackPage<'a> {
    /// The lab's title.
    pub title: &'a str,
    /// Points, with those that people gave.
    pub points: f64,
    /// The maximum, where it is known.
    pub max_points: Option<f64>,
    /// What else decided the points, in sentences: lateness, points by hand.
    pub facts: &'a [String],
    /// How to see the replay.
    pub replay: Option<&'a str>,
    /// The grade; none where points were given without a file.
    pub grade: Option<&'a Grade>,
    /// The hints of the lab.
    pub hints: &'a Hints,
}

/// How much of a grade is shown.
#[derive(Clone, Copy)]
enum Detail {
    /// Scores, and so many facts of each check that lost points.
    Facts(usize),
    /// The scores alone.
    Scores,
    /// The total alone.
    Total,
}

/// The page, of at most [`MOST_BYTES`] bytes: where a grade has more to say, the facts of each check become fewer.
pub fn feedback_page(shown: &FeedbackPage<'_>) -> String {
    let details = [
        Detail::Facts(usize::MAX),
        Detail::Facts(3),
        Detail::Facts(1),
        Detail::Facts(0),
        Detail::Scores,
    ];
    let mut pages = details.into_iter().map(|detail| with_detail(shown, detail));
    pages
        .find(|page| page.len() <= MOST_BYTES)
        .unwrap_or_else(|| with_detail(shown, Detail::Total))
}

fn with_detail(shown: &FeedbackPage<'_>, detail: Detail) -> String {
    let name = shortened(shown.title, MOST_CHARACTERS);
    let title = match shown.max_points {
        Some(of) => format!("{name}: {} of {} points", points(shown.points), points(of)),
        None => format!("{name}: {} points", points(shown.points)),
    };
    let engine = shown.grade.map_or("kinemark", |grade| &grade.engine);
    let body = html! {
        (head(shown))
        @if let Some(grade) = shown.grade {
            main {
                @let whole_file = stop_of_whole_file(grade);
                @if let Some(stop) = whole_file { (not_run(&cut_stop(stop), None)) }
                @if !matches!(detail, Detail::Total) { (scores(grade)) }
                @if let Detail::Facts(most) = detail {
                    @for (i, task) in grade.tasks.iter().enumerate().filter(|_| whole_file.is_none()) { (task_section(i, task, shown.hints, most)) }
                }
            }
            @if matches!(detail, Detail::Facts(_)) { (facts(grade)) }
        }
    };
    page(&title, engine, &body, &[], ViewerCode::Inside)
}

fn head(shown: &FeedbackPage<'_>) -> Markup {
    let share = match shown.max_points {
        Some(of) if of > 0.0 => (shown.points / of).clamp(0.0, 1.0),
        _ => 0.0,
    };
    html! {
        header class="head" {
            p class="eyebrow" { "Kinemark feedback" }
            h1 { (foreign(&shortened(shown.title, MOST_CHARACTERS))) }
            @if let Some(grade) = shown.grade {
                p class="by" { (foreign(&grade.lab.name)) " · submission " (foreign(&shortened(&grade.submission.name, MOST_CHARACTERS))) }
            }
            div class="result" {
                p class="score" {
                    b { (points(shown.points)) }
                    span { @if let Some(of) = shown.max_points { "of " (points(of)) " " } "points" }
                }
                @if shown.max_points.is_some() {
                    svg class="meter" viewBox="0 0 100 2" preserveAspectRatio="none" aria-hidden="true" focusable="false" {
                        rect class="rest" width="100" height="2" {}
                        rect class="part" width=(format!("{:.2}", 100.0 * share)) height="2" {}
                    }
                }
                @if let Some(grade) = shown.grade {
                    p { (verdict(grade.verdict, grade.points)) " " (meaning(grade.verdict, grade.tasks.iter().flat_map(|task| &task.checks))) }
                }
            }
            @if !shown.facts.is_empty() {
                ul class="note hint" { @for fact in shown.facts { li { (prose(fact)) } } }
            }
            @if let Some(replay) = shown.replay { p class="mode" { (prose(replay)) } }
        }
    }
}

/// What a task lost; a task that lost nothing is in the table of scores.
fn task_section(index: usize, task: &TaskGrade, hints: &Hints, most: usize) -> Markup {
    let id = anchor(index);
    let of = TaskShown {
        name: &task.name,
        kind: task.kind,
        run: None,
        has_replay: false,
        cases: None,
        stopped: task.stopped.is_some(),
        hints: Some(hints),
        script: None,
    };
    let lost: Vec<CheckGrade> = task
        .checks
        .iter()
        .filter(|check| check.outcome != Outcome::Full)
        .map(|check| cut(check, most))
        .collect();
    html! {
        section class="task" id=(id) data-task=(visible(&task.name)) aria-labelledby={ (id) "-title" } {
            div class="title" {
                h2 id={ (id) "-title" } { (foreign(&task.title)) }
                p { (verdict(task.verdict, task.points)) " " (earned(task.points, task.max_points)) }
            }
            p class="lead" { (meaning(task.verdict, task.checks.iter())) }
            @if let Some(stop) = &task.stopped { (stopped(&cut_stop(stop), &of)) }
            @for diagnosis in &task.diagnoses { (diagnosed(diagnosis, task.kind)) }
            @if !lost.is_empty() {
                h3 { "Checks that lost points" }
                ul class="checks" { @for check in &lost { li { (checked(check, None, &id, &of)) } } }
            }
            @if !task.hidden.is_empty() { (hidden(&id, task)) }
        }
    }
}

/// A check with its first `most` facts, none of them too long.
fn cut(check: &CheckGrade, most: usize) -> CheckGrade {
    let mut check = check.clone();
    check.evidence.truncate(most);
    for fact in &mut check.evidence {
        fact.message = shortened(&fact.message, MOST_CHARACTERS);
    }
    check.next_step = check
        .next_step
        .map(|next| shortened(&next, MOST_CHARACTERS));
    // a moment without a replay leads nowhere
    check.first_lost = None;
    check
}

fn cut_stop(stop: &Stopped) -> Stopped {
    let mut stop = stop.clone();
    stop.message = shortened(&stop.message, MOST_CHARACTERS);
    stop.help = stop.help.map(|help| shortened(&help, MOST_CHARACTERS));
    for further in &mut stop.further {
        further.help = shortened(&further.help, MOST_CHARACTERS);
    }
    stop
}

#[cfg(test)]
mod tests {
    use super::*;
    use kinemark_grader::record::grade::Evidence;
    use kinemark_grader::record::sample;
    use std::sync::LazyLock;

    static NO_HINTS: LazyLock<Hints> = LazyLock::new(Hints::default);

    fn shown<'a>(grade: Option<&'a Grade>, facts: &'a [String]) -> FeedbackPage<'a> {
        FeedbackPage {
            title: "Kinematics <b>& \u{202E}more",
            points: 7.25,
            max_points: Some(12.0),
            facts,
            replay: Some("To see the runs: kinemark grade 01 submission.rhai"),
            grade,
            hints: &NO_HINTS,
        }
    }

    #[test]
    fn a_page_says_what_the_report_says_and_loads_nothing() {
        let grade = sample::graded().grade;
        let facts = vec!["By hand: +1 for the total: a <script>\u{7} in `why`".to_owned()];
        let page = feedback_page(&shown(Some(&grade), &facts));
        for part in [
            "<b>7.25</b>",
            "of 12 points",
            "a &lt;script&gt;⟨U+0007⟩ in <code>why</code>",
            "Kinematics &lt;b&gt;&amp; ⟨U+202E⟩more",
            "prefers-color-scheme:dark",
            "id=\"scores\"",
            "kinemark grade 01 submission.rhai",
        ] {
            assert!(page.contains(part), "{part}");
        }
        for absent in [
            "<script",
            "http://",
            "https://",
            "@font-face",
            "src=",
            "#task=",
            "replay-",
        ] {
            assert!(!page.contains(absent), "{absent}");
        }
        assert!(page.len() <= MOST_BYTES);
    }

    #[test]
    fn a_grade_that_says_too_much_is_cut_until_it_fits() {
        let mut grade = sample::graded().grade;
        let fact = Evidence {
            message: "<&\">".repeat(500),
            ..Evidence::default()
        };
        let first = grade.tasks[0].checks[0].clone();
        for _ in 0..30 {
            let mut check = first.clone();
            check.evidence = vec![fact.clone(); 20];
            grade.tasks[0].checks.push(check);
        }
        let page = feedback_page(&shown(Some(&grade), &[]));
        assert!(page.len() <= MOST_BYTES, "{}", page.len());
        assert!(page.contains("id=\"scores\"") && page.contains("class=\"evidence\""));
        // more checks than fit at all
        for _ in 0..1000 {
            grade.tasks[0].checks.push(first.clone());
        }
        let page = feedback_page(&shown(Some(&grade), &[]));
        assert!(page.len() <= MOST_BYTES, "{}", page.len());
        assert!(page.contains("<b>7.25</b>"));
    }

    #[test]
    fn points_without_a_file_have_a_page_too() {
        let facts = vec!["By hand: +9 for the total: shown in person".to_owned()];
        let page = feedback_page(&FeedbackPage {
            max_points: None,
            ..shown(None, &facts)
        });
        assert!(page.contains("shown in person") && !page.contains("class=\"meter\""));
    }
}
