//! A lab's brief as a page: what `brief.md` says, for a browser, with its tables, its formulas, its folds and its pictures, and behind the
//! first picture the lab's arm, which the reader moves.
//!
//! The page loads the pictures that lie beside it and nothing else. Without scripts it is the text and its pictures.

use maud::{DOCTYPE, PreEscaped, html};
use pulldown_cmark::Parser;

use crate::code_block::{CodeParts, coloured};
use crate::formula::{MARKDOWN, drawn};
use crate::html::viewer::{self, ViewerCode};
use crate::replay::LiveArm;

/// What a browser may load for a page without an arm: its own styles, and pictures from its own folder.
const POLICY: &str = "default-src 'none'; style-src 'unsafe-inline'; img-src 'self' file: data:; base-uri 'none'; form-action 'none'";

/// What a page is made of.
#[derive(Clone, Copy)]
pub struct Brief<'a> {
    /// The lab's title.
    pub title: &'a str,
    /// The brief in Markdown. Links to pictures stay as they are written, so the pictures must lie beside the page. A brief is its
    /// course's own text: HTML in it is kept.
    pub text: &'a str,
    /// Where the parts of its programs are.
    pub parts: CodeParts<'a>,
    /// Whether what it says in two languages shows that in Python first.
    pub python_first: bool,
    /// The lab's arm, where it can be moved.
    pub arm: Option<LiveArm<'a>>,
}

/// The page of a brief.
pub fn brief_page(brief: &Brief<'_>) -> String {
    let mut text = String::new();
    let events = Parser::new_ext(brief.text, MARKDOWN).map(drawn);
    let events = coloured(events, brief.parts, brief.python_first);
    pulldown_cmark::html::push_html(&mut text, events.into_iter());
    // a wide table or a long line of a program scrolls by itself, by keys too; the page does not
    let mut text = text
        .replace(
            "<table>",
            &format!("<div class=\"wide\"{}><table>", scroller("Table")),
        )
        .replace("</table>", "</table></div>")
        .replace("<pre>", &format!("<pre{}>", scroller("Program")));
    let arm = brief.arm.map(|arm| arm.json());
    if arm.is_some() {
        text.insert_str(arm_at(&text), &viewer::arm_place().into_string());
    }
    let policy = match arm {
        Some(_) => viewer::policy_with_pictures(),
        None => POLICY.to_owned(),
    };
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta http-equiv="Content-Security-Policy" content=(policy);
                meta name="viewport" content="width=device-width, initial-scale=1";
                meta name="color-scheme" content="light dark";
                meta name="referrer" content="no-referrer";
                title { (brief.title) }
                style {
                    (PreEscaped(include_str!("html/page.css")))
                    (viewer::style(arm.is_some()))
                    (PreEscaped(include_str!("html/brief.css")))
                }
            }
            body class="brief" {
                main { (PreEscaped(text)) }
                @if let Some(arm) = &arm {
                    (viewer::arm_data(arm))
                    (viewer::script(ViewerCode::Inside))
                }
            }
        }
    };
    page.into_string()
}

/// What lets the keyboard scroll an element, under a name.
fn scroller(name: &str) -> String {
    format!(" tabindex=\"0\" role=\"group\" aria-label=\"{name}\"")
}

/// Where the arm stands: behind the paragraph of the first picture, which shows it at rest; without one before the second heading.
fn arm_at(text: &str) -> usize {
    let behind = |mark: &str, end: &str| {
        let from = text.find(mark)?;
        Some(from + text[from..].find(end)? + end.len())
    };
    behind("<img ", "</p>")
        .or_else(|| text.find("<h2"))
        .unwrap_or(text.len())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::replay::ArmShows;
    use kinemark_grader::record::sample;

    #[test]
    fn a_brief_keeps_its_tables_pictures_and_hints() {
        let page = brief_page(&Brief {
            title: "Lab <1>",
            text: "# Lab\n\n| a | b |\n|---|---|\n| 1 | 2 |\n\n![the arm](frame.svg)\n\n<details>\n<summary>why</summary>\n\nso\n\n</details>\n\n```\nfn f() {}\n```\n\nWith $q^2$.\n\n```rust\nfn g() {}\n```\n",
            parts: &|_: &str| vec![("keyword", 0..2)],
            python_first: false,
            arm: None,
        });
        for part in [
            "<title>Lab &lt;1&gt;</title>",
            "<h1>Lab</h1>",
            "<div class=\"wide\" tabindex=\"0\" role=\"group\" aria-label=\"Table\"><table>",
            "<td>1</td>",
            "<img src=\"frame.svg\" alt=\"the arm\" />",
            "<summary>why</summary>",
            "<p>so</p>",
            "<pre tabindex=\"0\" role=\"group\" aria-label=\"Program\"><code>fn f() {}",
            "aria-label=\"Program\"><code class=\"language-rust\"><span class=\"code-keyword\">fn</span> g() {}",
            "<p>With <math><msup><mi>q</mi><mn>2</mn></msup></math>.</p>",
        ] {
            assert!(page.contains(part), "{part}\n{page}");
        }
        for absent in ["<script", "http://", "https://", "@font-face"] {
            assert!(!page.contains(absent), "{absent}");
        }
    }

    #[test]
    fn the_arm_stands_behind_the_first_picture() {
        let run = sample::task_run();
        let page = |text: &str| {
            let arm = LiveArm::of(&run.robot, "lab", ArmShows::default());
            brief_page(&Brief {
                title: "Lab",
                text,
                parts: &|_: &str| Vec::new(),
                python_first: false,
                arm,
            })
        };
        let place = "<div class=\"arm\" data-arm=\"arm\"></div>";
        let shown = page("# Lab\n\n![the arm](frame.svg) here\n\n## One\n\n![a plot](plot.svg)\n");
        assert!(
            shown.contains(&format!("alt=\"the arm\" /> here</p>{place}")),
            "{place}"
        );
        assert!(page("# Lab\n\ntext\n\n## One\n").contains(&format!("{place}<h2>One")));
        // its own data and code, and pictures from its folder, are all that a browser may load
        assert!(
            shown.contains("script-src 'sha256-")
                && shown.contains("img-src 'self' file: data: blob:")
        );
        assert!(shown.contains(
            "<script type=\"application/json\" id=\"arm\">{\"format\":\"kinemark-arm/1\""
        ));
        let (before_code, _) = shown.split_once("<script>").expect("the viewer");
        for absent in ["http://", "https://"] {
            assert!(!before_code.contains(absent), "{absent}");
        }
    }
}
