//! A plot in a page: its picture, and for a narrow page its title and legend as text of the page.

use maud::{Markup, PreEscaped, html};

use crate::plot::Plot;
use crate::visible::visible;

/// The figure of a plot of a task. A picture with a head of its own fits any page; another scrolls where it is narrow.
pub(super) fn figure(plot: &Plot, task: &str) -> Markup {
    let head = plot.head.as_ref();
    let places = head.map(|head| format!("--cut:{};--rise:-{}", head.of_height, head.of_width));
    let class = if head.is_some() { "plot fits" } else { "plot" };
    let tabindex = head.is_none().then_some("0");
    html! {
        figure class=(class) style=[places] tabindex=[tabindex] aria-label=(plot.title) data-task=(visible(task)) data-panels=(plot.axes) {
            @for part in plot.inline() { (PreEscaped(part)) }
            @if let Some(head) = head {
                figcaption {
                    b { (plot.title) }
                    ul { @for (swatch, words) in &head.legend { li { (PreEscaped(swatch)) (words) } } }
                }
            }
        }
    }
}
