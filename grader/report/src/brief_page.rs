//! A lab's brief as a page: what `brief.md` says, for a browser, with its tables, its formulas, its folds and its pictures.
//!
//! The page loads the pictures that lie beside it and nothing else.

use maud::{DOCTYPE, PreEscaped, html};
use pulldown_cmark::Parser;

use crate::code_block::{CodeParts, coloured};
use crate::formula::{MARKDOWN, drawn};

/// What a browser may load for the page: its own styles, and pictures from its own folder.
const POLICY: &str = "default-src 'none'; style-src 'unsafe-inline'; img-src 'self' file: data:; base-uri 'none'; form-action 'none'";

/// The page of a brief in Markdown. Links to pictures stay as they are written, so the pictures must lie beside the page.
///
/// A brief is its course's own text: HTML in it is kept. Programs in it are coloured by `parts`.
pub fn brief_page(title: &str, brief: &str, parts: CodeParts<'_>) -> String {
    let mut text = String::new();
    let events = Parser::new_ext(brief, MARKDOWN).map(drawn);
    pulldown_cmark::html::push_html(&mut text, coloured(events, parts));
    // a wide table or a long line of a program scrolls by itself, the page does not
    let text = text
        .replace("<table>", "<div class=\"wide\"><table>")
        .replace("</table>", "</table></div>");
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta http-equiv="Content-Security-Policy" content=(POLICY);
                meta name="viewport" content="width=device-width, initial-scale=1";
                meta name="color-scheme" content="light dark";
                meta name="referrer" content="no-referrer";
                title { (title) }
                style { (PreEscaped(include_str!("html/page.css"))) (PreEscaped(include_str!("html/brief.css"))) }
            }
            body class="brief" { main { (PreEscaped(text)) } }
        }
    };
    page.into_string()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_brief_keeps_its_tables_pictures_and_hints() {
        let page = brief_page(
            "Lab <1>",
            "# Lab\n\n| a | b |\n|---|---|\n| 1 | 2 |\n\n![the arm](frame.svg)\n\n<details>\n<summary>why</summary>\n\nso\n\n</details>\n\n```\nfn f() {}\n```\n\nWith $q^2$.\n\n```rust\nfn g() {}\n```\n",
            &|_: &str| vec![("keyword", 0..2)],
        );
        for part in [
            "<title>Lab &lt;1&gt;</title>",
            "<h1>Lab</h1>",
            "<div class=\"wide\"><table>",
            "<td>1</td>",
            "<img src=\"frame.svg\" alt=\"the arm\" />",
            "<summary>why</summary>",
            "<p>so</p>",
            "<pre><code>fn f() {}",
            "<pre><code class=\"language-rust\"><span class=\"code-keyword\">fn</span> g() {}",
            "<p>With <math><msup><mi>q</mi><mn>2</mn></msup></math>.</p>",
        ] {
            assert!(page.contains(part), "{part}\n{page}");
        }
        for absent in ["<script", "http://", "https://", "@font-face"] {
            assert!(!page.contains(absent), "{absent}");
        }
    }
}
