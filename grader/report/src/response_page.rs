//! A step response as a page: pictures, the table of measures, and the facts around them, in one file.

use maud::{Markup, html};

use crate::html::{StaticPage, foreign, prose, still_figure};
use crate::plot::Plot;

/// What a page of a step response shows.
#[derive(Debug, Clone, Copy)]
pub struct ResponsePage<'a> {
    /// The engine that made it.
    pub engine: &'a str,
    /// Its title.
    pub title: &'a str,
    /// The pictures.
    pub pictures: &'a [Plot],
    /// What the columns of the table hold.
    pub head: &'a [String],
    /// The rows of the table, with a cell for each column.
    pub rows: &'a [Vec<String>],
    /// How many columns at the left hold words.
    pub words: usize,
    /// Labels and facts; a label that repeats is shown once.
    pub facts: &'a [(String, String)],
}

const CSS: &str = "main>section{margin-top:1.25rem}.measures td,.measures th{white-space:nowrap}.around{margin:0}\
    .around dt{color:var(--muted);font-size:.84rem;margin-top:.7rem}.around dd{margin:0;max-width:60rem}\
    .around dt:first-child{margin-top:0}.plots.alone{columns:1;max-width:52rem}";

impl ResponsePage<'_> {
    /// The page. It asks nothing of the network; the same input gives the same bytes.
    pub fn html(&self) -> String {
        let title = self.title.replace('`', "");
        let body = html! {
            header class="head" {
                p class="eyebrow" { "Kinemark" }
                h1 { (foreign(&title)) }
            }
            main {
                section {
                    div class="plots alone" { @for picture in self.pictures { (still_figure(picture)) } }
                }
                section {
                    h2 { "Measures" }
                    (self.table())
                    p class="quiet" {
                        "The final value is the mean over the last 0.2 s. Rise is the time from 10 % to 90 % of the step from the start to the final value, \
                         settling the last time at which the joint is more than 2 % of that step from it, overshoot how far it goes beyond."
                    }
                }
                section {
                    h2 { "What was analysed" }
                    (self.around())
                }
            }
            footer { p class="quiet" { (foreign(self.engine)) } }
        };
        let page = StaticPage {
            title: &title,
            engine: self.engine,
            css: CSS,
            script: None,
        };
        page.around(&body)
    }

    fn table(&self) -> Markup {
        let class = |column: usize| (column >= self.words).then_some("number");
        html! {
            div class="wide" {
                table class="measures" {
                    thead { tr { @for (i, cell) in self.head.iter().enumerate() { th scope="col" class=[class(i)] { (cell) } } } }
                    tbody {
                        @for row in self.rows {
                            tr { @for (i, cell) in row.iter().enumerate() { td class=[class(i)] { (cell) } } }
                        }
                    }
                }
            }
        }
    }

    fn around(&self) -> Markup {
        let before = |i: usize| i.checked_sub(1).and_then(|i| self.facts.get(i));
        html! {
            dl class="around" {
                @for (i, (label, fact)) in self.facts.iter().enumerate() {
                    @if before(i).is_none_or(|before| before.0 != *label) { dt { (label) } }
                    dd { (prose(fact)) }
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_page_has_its_table_and_facts_and_no_markup_of_others() {
        let facts = ["step", "others", "others"]
            .map(|label| (label.to_owned(), format!("a `<b>` of {label}")));
        let (head, row) = (
            vec![String::new(), "rise [ms]".to_owned()],
            vec!["run".to_owned(), "231.7".to_owned()],
        );
        let page = ResponsePage {
            engine: "kinemark 1",
            title: "Step of `<elbow>`",
            pictures: &[],
            head: &head,
            rows: &[row],
            words: 1,
            facts: &facts,
        };
        let page = page.html();
        assert!(page.contains("<title>Step of &lt;elbow&gt;</title>"));
        assert!(page.contains("<td class=\"number\">231.7</td>") && page.contains("<td>run</td>"));
        assert_eq!(page.matches("<dt>").count(), 2);
        assert_eq!(page.matches("<code>&lt;b&gt;</code> of others").count(), 2);
        assert!(
            !page.contains("<script") && !page.contains("http://") && !page.contains("https://")
        );
    }
}
