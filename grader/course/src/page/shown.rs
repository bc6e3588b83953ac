//! How the pages of a class show numbers, tables and sections.

use kinemark_sim::text::number::trimmed;
use maud::{Markup, PreEscaped, html};

/// Rules beside those of the report.
pub(super) const CSS: &str = include_str!("class.css");

/// A number of points as a mean has it.
pub(super) fn tenths(value: f64) -> String {
    trimmed(value, 1)
}

/// A share as whole per cent, kept on one line.
pub(super) fn percent(share: f64) -> String {
    format!("{}\u{a0}%", trimmed(100.0 * share, 0))
}

/// What may be absent.
pub(super) fn or_dash(text: Option<String>) -> String {
    text.unwrap_or_else(|| "–".to_owned())
}

/// A number of things, in words.
pub(super) fn count(n: usize, one: &str, many: &str) -> String {
    format!("{n} {}", if n == 1 { one } else { many })
}

/// A section of a page with its heading.
pub(super) fn section(id: &str, title: &str, body: &Markup) -> Markup {
    html! {
        section id=(id) aria-labelledby={ (id) "-title" } tabindex="-1" {
            h2 id={ (id) "-title" } { (title) }
            (body)
        }
    }
}

/// A table; where the page is narrow each row is a card with the columns' names in it. `head` has each column's name and whether it
/// holds numbers, and the first cell of a row names it.
pub(super) fn table(
    caption: &str,
    class: &str,
    head: &[(&str, bool)],
    rows: &[Vec<Markup>],
) -> Markup {
    let number = |is_number: bool| is_number.then_some("number");
    html! {
        div class="wide" tabindex="0" role="group" aria-label=(caption) {
            table class={ "cards " (class) } role="table" {
                caption class="unseen" { (caption) }
                thead role="rowgroup" {
                    tr role="row" {
                        @for (name, is_number) in head { th scope="col" role="columnheader" class=[number(*is_number)] { (name) } }
                    }
                }
                tbody role="rowgroup" {
                    @for row in rows {
                        tr role="row" {
                            @for (i, (cell, (name, is_number))) in row.iter().zip(head).enumerate() {
                                @if i == 0 { th scope="row" role="rowheader" { (cell) } }
                                @else { td role="cell" class=[number(*is_number)] data-label=(name) { (cell) } }
                            }
                        }
                    }
                }
            }
        }
    }
}

/// The title of a picture, for a screen reader.
pub(super) fn picture_title(words: &str) -> Markup {
    html! { title { (words) } }
}

/// Markup of several parts.
pub(super) fn all(parts: impl IntoIterator<Item = Markup>) -> Markup {
    PreEscaped(parts.into_iter().map(Markup::into_string).collect())
}
