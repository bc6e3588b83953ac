//! Where the axes of a picture lie and what its lines are called, so that a viewer can read values off and put a cursor into it.

use serde::Serialize;

use super::canvas::{Entry, Swatch, UNITS};
use super::plane::Plane;
use super::timeline::Panel;
use super::view::View;
use crate::report::theme::{Colour, MUTED_DASHED, RED, hex};
use crate::report::visible::visible;

/// One pair of axes; places are in units of the picture, y downwards.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(tag = "kind", rename_all = "lowercase")]
pub(super) enum Axes {
    /// Over time.
    Time(OverTime),
    /// A plane of the lab's frame.
    Plane(InPlane),
}

/// Axes over time. A line of a series is every polyline of its colour that lies in the box.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(super) struct OverTime {
    /// Left, top, right, bottom.
    #[serde(rename = "box")]
    edges: [i32; 4],
    /// Times at left and right \[s\].
    t: [f64; 2],
    /// Values at bottom and top.
    y: [f64; 2],
    /// Whether equal ways up are equal ratios.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    log: bool,
    unit: String,
    /// What stands above the panel.
    name: String,
    series: Vec<Series>,
}

#[derive(Debug, Clone, PartialEq, Serialize)]
struct Series {
    name: String,
    colour: String,
}

/// A plane: a point `p` of the lab's frame lies at `zero[0] + signs[0] * p[axes[0]] * pixelsPerM` from the left, and at
/// `zero[1] - signs[1] * p[axes[1]] * pixelsPerM` from the top.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct InPlane {
    #[serde(rename = "box")]
    edges: [i32; 4],
    /// The coordinates to the right and up.
    axes: [usize; 2],
    signs: [i32; 2],
    zero: [f64; 2],
    pixels_per_m: f64,
}

/// A box in units of the picture, from one in pixels.
fn edges(left: f64, top: f64, right: f64, bottom: f64) -> [i32; 4] {
    [left, top, right, bottom].map(|x| (x * UNITS).round() as i32)
}

/// A hundredth of a unit cannot be seen.
fn hundredths(x: f64) -> f64 {
    (x * 100.0).round() / 100.0
}

impl Axes {
    /// The axes of a panel over time up to `end_s`, which lies in the box of these pixels; its lines are called what the legend calls them.
    pub(super) fn over_time(
        panel: &Panel,
        legend: &[Entry],
        end_s: f64,
        [left, top, right, bottom]: [f64; 4],
    ) -> Self {
        let mut series: Vec<Series> = Vec::new();
        for line in &panel.lines {
            let key = hex(line.colour.light);
            // where the effort stands at its limit and how far other goals are cannot be told from marks of that colour
            let is_read = |colour: Colour| ![RED.light, MUTED_DASHED.light].contains(&colour.light);
            if is_read(line.colour) && series.iter().all(|known| known.colour != key) {
                let told = legend.iter().find(|entry| match entry.swatch {
                    Swatch::Line(colour) => colour.light == line.colour.light,
                    _ => false,
                });
                series.push(Series {
                    name: visible(told.map_or("value", |entry| &entry.text)).into_owned(),
                    colour: key,
                });
            }
        }
        Self::Time(OverTime {
            edges: edges(left, top, right, bottom),
            t: [0.0, end_s],
            y: [panel.axis.min, panel.axis.max],
            log: panel.axis.is_logarithmic(),
            unit: visible(&panel.unit).into_owned(),
            name: panel.name.clone(),
            series,
        })
    }

    /// The axes of a view of a plane.
    pub(super) fn in_plane(view: &View, plane: &Plane) -> Self {
        let sign = |backwards: bool| if backwards { -1 } else { 1 };
        let zero = [
            view.left - view.x.min * view.pixels_per_m,
            view.top + view.y.max * view.pixels_per_m,
        ];
        Self::Plane(InPlane {
            edges: edges(
                view.left,
                view.top,
                view.left + view.width(),
                view.top + view.height(),
            ),
            axes: [plane.across.coordinate, plane.up.coordinate],
            signs: [sign(plane.across.backwards), sign(plane.up.backwards)],
            zero: zero.map(|x| hundredths(x * UNITS)),
            pixels_per_m: hundredths(view.pixels_per_m * UNITS),
        })
    }
}

/// Axes as JSON.
pub(super) fn json(axes: &[Axes]) -> String {
    // texts and numbers have a JSON form; a number that is not finite is `null`
    serde_json::to_string(axes).unwrap_or_else(|_| "[]".to_owned())
}
