//! The report: one file with everything in it, that asks nothing of the network and runs no code but the viewer's of its replays.

mod band;
mod beyond;
mod case_columns;
mod chapters;
mod comparison;
mod costs;
mod explanation;
pub mod feedback;
mod figure;
mod head;
mod look;
mod printed;
mod shown_cases;
mod since;
mod source;
mod static_page;
mod task;
mod task_check;
mod task_shown;
mod task_tables;
pub(crate) mod viewer;

use maud::{DOCTYPE, Markup, PreEscaped, html};

pub use self::comparison::comparison;
pub use self::explanation::{OVERVIEW_FILE, StaffPage, explanation};
pub use self::figure::still_figure;
pub use self::head::verdict_words;
use self::head::{facts, head, scores};
use self::printed::Printed;
pub use self::since::{Earlier, EarlierCheck};
use self::source::{ScriptLines, source};
pub use self::static_page::{SmallScript, StaticPage};
pub use self::viewer::{ViewerCode, whole};
use crate::palette::plot_css;
use crate::plot::Plot;
use crate::replay::Replay;
use crate::stop_words::stop_of_whole_file;
use crate::visible::visible;
use kinemark_grader::record::graded::GradedRun;
use kinemark_grader::record::quantity::points;

/// What a page shows besides the grade and its runs.
#[derive(Debug, Clone, Copy, Default)]
pub struct PageExtras<'a> {
    /// The submission, where it is a script.
    pub script: Option<&'a [u8]>,
    /// The sources beside a module, by their paths.
    pub module_sources: &'a [(String, Vec<u8>)],
    /// Whose it is, in the words of whoever asked for the page.
    pub label: Option<&'a str>,
    /// Whether every motion task has its storyboard as chapters, and not only those that lost points.
    pub all_chapters: bool,
    /// An earlier report, with which this one is compared.
    pub since: Option<&'a Earlier>,
}

/// The page of a graded run. `plots` holds the plots of each of its runs, in the same order.
///
/// Everything a submission wrote is shown as text, with characters that hide, reorder or steer what is around them written out.
/// The same grade gives the same bytes.
pub fn html(graded: &GradedRun, plots: &[Vec<Plot>], extras: &PageExtras<'_>) -> String {
    html_with(graded, plots, extras, ViewerCode::Inside)
}

/// The same page with the viewer's code where `code` says.
pub fn html_with(
    graded: &GradedRun,
    plots: &[Vec<Plot>],
    extras: &PageExtras<'_>,
    code: ViewerCode<'_>,
) -> String {
    page_with_notice(graded, plots, extras, code, &html! {})
}

/// The page of a graded run, with a notice at its top.
fn page_with_notice(
    graded: &GradedRun,
    plots: &[Vec<Plot>],
    extras: &PageExtras<'_>,
    code: ViewerCode<'_>,
    notice: &Markup,
) -> String {
    let grade = &graded.grade;
    let drawn = |name: &str| {
        let at = graded.runs.iter().position(|run| run.task == name)?;
        Some((
            &graded.runs[at],
            plots.get(at).map_or(&[][..], Vec::as_slice),
        ))
    };
    let cases_of = |name: &str| graded.cases.iter().find(|shown| shown.task == name);
    let replays: Vec<(usize, String)> = grade
        .tasks
        .iter()
        .enumerate()
        .filter_map(|(i, task)| {
            let replay = Replay::of(drawn(&task.name)?.0, Some(task));
            (!replay.is_empty()).then(|| (i, replay.json()))
        })
        .collect();
    let has_replay = |index: usize| replays.iter().any(|(i, _)| *i == index);
    let label = extras.label.filter(|label| !label.trim().is_empty());
    let student = grade
        .variant
        .as_ref()
        .and_then(|variant| variant.student.as_deref());
    let whose = label
        .or(student)
        .map_or_else(String::new, |whose| format!("{}, ", visible(whose)));
    let title = format!(
        "{whose}{}: {} of {} points",
        visible(title_of(graded)),
        points(grade.points),
        points(grade.max_points)
    );
    let whole_file = stop_of_whole_file(grade);
    let script = extras.script.and_then(ScriptLines::of);
    let script = script.as_ref();
    let body = html! {
        a class="skip" href="#scores" { "Skip to the scores" }
        (notice)
        (head(grade, title_of(graded), label, &look::look(grade, has_replay)))
        main {
            @if let Some(stop) = whole_file { (task::not_run(stop, script)) }
            @if let Some(earlier) = extras.since { (since::since(grade, earlier, whole_file.is_none())) }
            (beyond::beyond(graded, extras.all_chapters))
            (scores(grade))
            // of a file that is no program every section would say the same
            @for (i, task) in grade.tasks.iter().enumerate().filter(|_| whole_file.is_none()) {
                (task::section(i, task, drawn(&task.name), cases_of(&task.name), has_replay(i), script, extras.all_chapters))
            }
            (source(grade, script, extras.module_sources, &Printed::of(graded, has_replay)))
        }
        (facts(grade))
    };
    page(&title, &grade.engine, &body, &replays, code)
}

/// What the lab is called: its title, or its name where it has none.
fn title_of(graded: &GradedRun) -> &str {
    if graded.title.trim().is_empty() {
        &graded.grade.lab.name
    } else {
        &graded.title
    }
}

/// A whole page with its styles, and with the viewer where it has replays: their numbers, by which [`viewer::place`] names the places
/// where they are shown, and their data.
pub(crate) fn page(
    title: &str,
    engine: &str,
    body: &Markup,
    replays: &[(usize, String)],
    code: ViewerCode<'_>,
) -> String {
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta http-equiv="Content-Security-Policy" content=(viewer::policy(!replays.is_empty(), code));
                meta name="viewport" content="width=device-width, initial-scale=1";
                meta name="color-scheme" content="light dark";
                meta name="referrer" content="no-referrer";
                meta name="generator" content=(visible(engine));
                title { (title) }
                style { (PreEscaped(include_str!("page.css"))) (PreEscaped(plot_css())) (viewer::style(!replays.is_empty())) }
            }
            body {
                (body)
                @for (i, json) in replays { (viewer::data(*i, json)) }
                @if !replays.is_empty() { (viewer::script(code)) }
            }
        }
    };
    page.into_string()
}

/// Text from outside, isolated so that its direction cannot reach what stands beside it.
pub fn foreign(text: &str) -> Markup {
    html! { bdi { (visible(text)) } }
}

/// Units that stand after a number.
const UNITS: [&str; 24] = [
    "m", "mm", "cm", "km", "s", "ms", "rad", "mrad", "%", "N", "N m", "N s", "J", "W", "Hz", "kg",
    "g", "m/s", "mm/s", "rad/s", "m/s²", "rad/s²", "°", "°C",
];

/// Text in which no line breaks between a number, or the bracket of a list of numbers, and its unit.
fn kept_with_units(text: &str) -> String {
    let mut kept = String::with_capacity(text.len() + 16);
    let mut rest = text;
    while let Some((before, after)) = rest.split_once(' ') {
        kept.push_str(before);
        let word = after.split([' ', '\u{a0}']).next().unwrap_or_default();
        let unit = word.trim_end_matches([',', '.', ';', ':', ')', ']']);
        let ends_in_digit = |text: &str| text.ends_with(|c: char| c.is_ascii_digit());
        let is_list = before.ends_with(']') || before.strip_suffix(')').is_some_and(ends_in_digit);
        let is_number = is_list || ends_in_digit(before);
        // a product of units is one unit
        let is_product = kept.ends_with("\u{a0}N") && matches!(unit, "m" | "s");
        let is_kept = is_number && UNITS.contains(&unit) || is_product;
        kept.push(if is_kept { '\u{a0}' } else { ' ' });
        rest = after;
    }
    kept.push_str(rest);
    kept
}

/// A sentence from outside, with what stands in backticks as code.
pub fn prose(text: &str) -> Markup {
    let text = visible(text);
    let parts: Vec<&str> = text.split('`').collect();
    if parts.len().is_multiple_of(2) {
        return foreign(&text);
    }
    html! {
        bdi {
            @for (i, part) in parts.iter().enumerate() {
                @if i % 2 == 1 { code { (part) } } @else { (part) }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plot::plots;
    use kinemark_grader::record::sample;

    fn page(graded: &GradedRun) -> String {
        let plots: Vec<_> = graded.runs.iter().map(plots).collect();
        html(graded, &plots, &PageExtras::default())
    }

    #[test]
    fn a_number_and_its_unit_stay_on_one_line() {
        let kept = |text| kept_with_units(text).replace('\u{a0}', "_");
        assert_eq!(
            kept("37.2 mm off at [1.4, 0.05] m, (1, 0.6) m, 12 N m and 3 of 4 s."),
            "37.2_mm off at [1.4, 0.05]_m, (1, 0.6)_m, 12_N_m and 3 of 4_s."
        );
        assert_eq!(kept("in 1 metre m s 5"), "in 1 metre m s 5");
    }

    #[test]
    fn the_same_grade_gives_the_same_bytes() {
        assert_eq!(page(&sample::graded()), page(&sample::graded()));
    }

    /// The page but for the viewer's code: what comes from the grade.
    fn own(page: &str) -> String {
        let (head, tail) = page.rsplit_once("<script>").expect("the viewer");
        let (_, tail) = tail.split_once("</script>").expect("its end");
        format!("{head}{tail}")
    }

    #[test]
    fn a_page_with_the_viewer_beside_it_becomes_whole() {
        let graded = sample::graded();
        let plots: Vec<_> = graded.runs.iter().map(plots).collect();
        let address = "../../viewer-0123.js";
        let beside = html_with(
            &graded,
            &plots,
            &PageExtras::default(),
            ViewerCode::Beside(address),
        );
        assert!(beside.len() + 300_000 < page(&graded).len());
        assert!(beside.contains("<script src=\"../../viewer-0123.js\"></script>"));
        assert_eq!(whole(&beside, address), page(&graded));
    }

    #[test]
    fn hostile_text_is_text() {
        let mut graded = sample::graded();
        let hostile = "</script><script>alert(1)</script><!--<img src=x>\u{2028}\u{202E}\u{1b}[2J";
        graded.grade.tasks[3].title = hostile.to_owned();
        graded.grade.tasks[3].checks[3].evidence[0].message = hostile.to_owned();
        graded.runs[0].trace.log[0].text = hostile.to_owned();
        let page = own(&page(&graded));
        // the data of one replay is the only script element but the viewer's
        assert_eq!(page.matches("<script").count(), 1);
        assert_eq!(page.matches("</script").count(), 1);
        assert!(!page.contains("<!--"), "a comment was opened");
        assert!(!page.contains("<img"), "an image was written");
        assert!(
            !page.contains("<b>reached"),
            "markup of a log line was written"
        );
        assert!(page.contains("&lt;b&gt;reached"));
        assert!(!page.contains(['\u{1b}', '\u{202E}', '\u{2028}']));
    }

    #[test]
    fn nothing_is_loaded() {
        // a name of a format, and a part of the same page
        let page = own(&page(&sample::graded()))
            .replace("http://www.w3.org/2000/svg", "")
            .replace("url(#", "");
        for word in ["http:", "https:", " src=\"", "<link", "url(", "@import"] {
            assert!(!page.contains(word), "{word}");
        }
    }

    #[test]
    fn a_report_without_a_run_has_no_script() {
        let mut graded = sample::graded();
        graded.runs.clear();
        let page = page(&graded);
        for word in [
            "<script",
            "script-src",
            "data-replay",
            "class=\"seek\"",
            "blob:",
        ] {
            assert!(!page.contains(word), "{word}");
        }
    }

    #[test]
    fn a_motion_task_has_its_replay_and_links_into_it() {
        let page = page(&sample::graded());
        for part in [
            "<div class=\"replay\" data-replay=\"replay-4\" data-task=\"move\"></div>",
            "<script type=\"application/json\" id=\"replay-4\">{\"format\":\"kinemark-replay/2\",\"task\":\"move\"",
            "<a class=\"seek\" href=\"#task=move&amp;t=3.71\">3.71 s</a>",
            "<a class=\"seek\" href=\"#task=move&amp;t=2.4\">2.400 s</a>",
        ] {
            assert!(page.contains(part), "{part}");
        }
        // data first, code last
        assert!(page.rfind("</script></body>").is_some());
        assert!(page.find("id=\"replay-4\"") < page.rfind("<script>"));
    }

    #[test]
    fn the_title_of_the_lab_leads_and_its_name_follows() {
        let mut graded = sample::graded();
        let page_of = |graded: &GradedRun| own(&page(graded));
        assert!(page_of(&graded).contains("<h1><bdi>Where is the hand?</bdi></h1>"));
        assert!(page_of(&graded).contains("<bdi>01-kinematics</bdi> · robot "));
        graded.title = " ".to_owned();
        assert!(page_of(&graded).contains("<h1><bdi>01-kinematics</bdi></h1>"));
    }

    #[test]
    fn a_passed_task_is_folded_and_so_are_the_full_checks_of_another() {
        let page = own(&page(&sample::graded()));
        let mut sections = page.split("<section class=\"task").skip(1);
        let passed = sections.next().expect("the warm-up");
        let (open, folded) = passed
            .split_once("<details class=\"more\">")
            .expect("folded");
        assert!(
            open.contains("Warm-up") && !open.contains("<article"),
            "{open}"
        );
        assert!(folded.contains("<summary>Checks</summary>") && folded.contains("<article"));
        let lost = sections.last().expect("the move");
        let (open, folded) = lost.split_once("<details class=\"more\">").expect("folded");
        assert!(
            open.contains("<article") && !open.contains("Done in time"),
            "{open}"
        );
        assert!(folded.contains("with all points</summary>") && folded.contains("Done in time"));
        // what a lost check judged is drawn beside it, and nowhere else
        assert!(open.contains("class=\"check pictured\""));
        assert_eq!(open.matches("<figure").count(), 1);
        assert!(folded.contains("<figure"));
    }

    #[test]
    fn what_hidden_runs_cost_is_shown_once_a_task() {
        let mut graded = sample::graded();
        let task = &mut graded.grade.tasks[3];
        let class = "an arm of other lengths".to_owned();
        task.hidden = vec![kinemark_grader::record::grade::HiddenClass {
            class: class.clone(),
            good: 0,
            total: 1,
            under_resolved: 0,
        }];
        let message = "in 1 of 1 hidden runs points are lost";
        for check in &mut task.checks {
            check.outcome = kinemark_grader::record::grade::Outcome::Partial;
            let mut fact =
                check.evidence.first().cloned().unwrap_or_else(|| {
                    sample::graded().grade.tasks[3].checks[3].evidence[0].clone()
                });
            fact.message = message.to_owned();
            (fact.tick, fact.time_s, fact.case) = (None, None, Some(class.clone()));
            check.evidence.push(fact);
        }
        let count = task.checks.len();
        let titles: Vec<&str> = task
            .checks
            .iter()
            .map(|check| check.title.as_str())
            .collect();
        let cell = format!("<td><bdi>{}</bdi></td>", titles.join("; "));
        let page = own(&page(&graded));
        assert!(!page.contains(message));
        assert_eq!(page.matches(&cell).count(), 1, "{cell}");
        assert_eq!(page.matches("href=\"#task-4-hidden\"").count(), count);
        assert_eq!(page.matches("id=\"task-4-hidden\"").count(), 1);
    }

    #[test]
    fn why_a_check_was_not_judged_is_shown() {
        let mut graded = sample::graded();
        let check = &mut graded.grade.tasks[3].checks[0];
        check.outcome = kinemark_grader::record::grade::Outcome::NotJudged;
        check.measure = None;
        check.next_step = Some("Not judged until \"Done in time\" earns points.".to_owned());
        let words = "Not judged: a check that it needs earned nothing.";
        assert!(own(&page(&graded)).contains(words));
    }

    #[test]
    fn a_run_of_ten_seconds_stays_small() {
        let graded = sample::graded();
        let size = own(&page(&graded)).len();
        // eight seconds of two joints, with all plots
        assert!(size < 300_000, "{size} bytes");
    }

    #[test]
    fn a_log_of_ten_thousand_lines_stays_small() {
        let mut graded = sample::graded();
        let line = kinemark_grader::record::grade::LogEntry {
            at: 0,
            text: "<i>".repeat(2_000),
            line: Some(2),
        };
        graded.grade.tasks[3].log = vec![line; 10_000];
        let plain = page(&sample::graded()).len();
        assert!(page(&graded).len() < plain + 2_000_000);
    }
}
