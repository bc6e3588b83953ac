//! A plot in a page: its picture, and for a narrow page its title and legend as text of the page.

use maud::{Markup, PreEscaped, html};

use super::kept_with_units;
use crate::plot::Plot;
use crate::visible::visible;

/// The figure of a plot of a task, which the viewer knows by both.
pub(super) fn figure(plot: &Plot, task: &str) -> Markup {
    drawn(plot, Some(task))
}

/// The figure of a plot on a page without a viewer.
pub fn still_figure(plot: &Plot) -> Markup {
    drawn(plot, None)
}

/// A picture with a head of its own fits any page; another scrolls where it is narrow.
fn drawn(plot: &Plot, task: Option<&str>) -> Markup {
    let head = plot.head.as_ref();
    let places = head.map(|head| format!("--cut:{};--rise:-{}", head.of_height, head.of_width));
    let class = if head.is_some() { "plot fits" } else { "plot" };
    let tabindex = head.is_none().then_some("0");
    let (named, panels) = (task.map(visible), task.map(|_| &plot.axes));
    html! {
        figure class=(class) style=[places] tabindex=[tabindex] aria-label=(plot.title) data-task=[named] data-panels=[panels] {
            @for part in plot.inline() { (PreEscaped(part)) }
            @if let Some(head) = head {
                figcaption {
                    b { (plot.title) }
                    ul { @for (swatch, words) in &head.legend { li { (PreEscaped(swatch)) (kept_with_units(words)) } } }
                }
            }
        }
    }
}
