//! The report: one file with everything in it, that asks nothing of the network and runs no code.

mod band;
mod head;
mod task;

use maud::{DOCTYPE, Markup, PreEscaped, html};

use self::head::{facts, head, scores};
use crate::graded::GradedRun;
use crate::quantity::points;
use crate::report::plot::Plot;
use crate::report::theme::plot_css;
use crate::report::visible::visible;

/// What a browser may load for the page: its own styles and nothing else.
const POLICY: &str = "default-src 'none'; style-src 'unsafe-inline'; img-src data:; base-uri 'none'; form-action 'none'";

/// The page of a graded run. `plots` holds the plots of each of its runs, in the same order.
///
/// Everything a submission wrote is shown as text, with characters that hide, reorder or steer what is around them written out.
/// The same grade gives the same bytes.
pub fn html(graded: &GradedRun, plots: &[Vec<Plot>]) -> String {
    let grade = &graded.grade;
    let drawn = |name: &str| {
        let at = graded.runs.iter().position(|run| run.task == name)?;
        Some((
            &graded.runs[at],
            plots.get(at).map_or(&[][..], Vec::as_slice),
        ))
    };
    let title = format!(
        "{}: {} of {} points",
        visible(&grade.lab.name),
        points(grade.points),
        points(grade.max_points)
    );
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta http-equiv="Content-Security-Policy" content=(POLICY);
                meta name="viewport" content="width=device-width, initial-scale=1";
                meta name="color-scheme" content="light dark";
                meta name="referrer" content="no-referrer";
                meta name="generator" content=(visible(&grade.engine));
                title { (title) }
                style { (PreEscaped(include_str!("html/page.css"))) (PreEscaped(plot_css())) }
            }
            body {
                a class="skip" href="#scores" { "Skip to the scores" }
                (head(grade))
                main {
                    (scores(grade))
                    @for (i, task) in grade.tasks.iter().enumerate() {
                        (task::section(i, task, drawn(&task.name)))
                    }
                }
                (facts(grade))
            }
        }
    };
    page.into_string()
}

/// Text from outside, isolated so that its direction cannot reach what stands beside it.
fn foreign(text: &str) -> Markup {
    html! { bdi { (visible(text)) } }
}

/// A sentence from outside, with what stands in backticks as code.
fn prose(text: &str) -> Markup {
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
    use crate::report::plot::plots;
    use crate::report::sample;

    fn page(graded: &GradedRun) -> String {
        let plots: Vec<_> = graded.runs.iter().map(plots).collect();
        html(graded, &plots)
    }

    #[test]
    fn the_same_grade_gives_the_same_bytes() {
        assert_eq!(page(&sample::graded()), page(&sample::graded()));
    }

    #[test]
    fn hostile_text_is_text() {
        let page = page(&sample::graded());
        assert!(!page.contains("<script"), "a script was written");
        assert!(!page.contains("<img"), "an image was written");
        assert!(
            !page.contains("<b>reached"),
            "markup of a log line was written"
        );
        assert!(page.contains("&lt;b&gt;reached"));
        assert!(!page.contains('\u{1b}') && !page.contains('\u{202E}'));
    }

    #[test]
    fn nothing_is_loaded() {
        let page = page(&sample::graded()).replace("http://www.w3.org/2000/svg", "");
        for word in [
            "http:", "https:", " src=\"", "<link", "url(", "@import", "<script",
        ] {
            assert!(!page.contains(word), "{word}");
        }
    }

    #[test]
    fn a_log_of_ten_thousand_lines_stays_small() {
        let mut graded = sample::graded();
        let line = crate::grade::LogEntry {
            at: 0,
            text: "<i>".repeat(2_000),
        };
        graded.grade.tasks[3].log = vec![line; 10_000];
        let plain = page(&sample::graded()).len();
        assert!(page(&graded).len() < plain + 2_000_000);
    }
}
