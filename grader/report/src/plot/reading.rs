//! Where the axes of a picture lie and what its lines are called, so that a viewer can read values off and put a cursor into it.

use serde::Serialize;

use super::canvas::{Entry, Swatch, UNITS, half_width};
use super::course::Course;
use super::plane::Plane;
use super::timeline::Panel;
use super::view::View;
use crate::palette::{Colour, GREEN_DASHED, MUTED_DASHED, RED, VERMILLION_DASHED, hex};
use crate::visible::visible;

/// One pair of axes; places are in units of the picture, y downwards.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(tag = "kind", rename_all = "lowercase")]
pub(super) enum Axes {
    /// Over time.
    Time(OverTime),
    /// A plane of the lab's frame.
    Plane(InPlane),
}

/// Axes over time. A line of a series is every path of its colour and dashes that lies in the box: drawn, or, where the values go up
/// and down faster than can be seen, a filled band from the lowest to the highest.
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
    /// Values that earn all points and none, where the panel has one of each.
    #[serde(skip_serializing_if = "Option::is_none")]
    full: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    zero: Option<f64>,
    series: Vec<Series>,
}

#[derive(Debug, Clone, PartialEq, Serialize)]
struct Series {
    name: String,
    colour: String,
    /// The dashes of the line, if it has some.
    #[serde(skip_serializing_if = "Option::is_none")]
    dashes: Option<&'static str>,
    /// How far above or below what is drawn a value may lie, in units of the picture.
    off: f64,
    /// How far a band reaches beyond its lowest and its highest value, in units of the picture.
    pad: i32,
    /// The size at which values are cut off, if some are greater.
    #[serde(skip_serializing_if = "Option::is_none")]
    cut: Option<f64>,
}

/// Half a unit, to which drawn points are rounded.
const ROUNDING: f64 = 0.5;

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
        courses: &[Course],
        legend: &[Entry],
        end_s: f64,
        [left, top, right, bottom]: [f64; 4],
    ) -> Self {
        // of several goals each has a band of its own, which no one curve is judged by
        let only = |colour: Colour| {
            let mut levels = panel.levels.iter().filter(|level| level.1 == colour);
            let first = levels.next().map(|level| level.0);
            first.filter(|value| levels.next().is_none() && value.is_finite())
        };
        let band = only(GREEN_DASHED).zip(only(VERMILLION_DASHED));
        let mut series: Vec<Series> = Vec::new();
        for (line, course) in panel.lines.iter().zip(courses) {
            let (colour, dashes) = (hex(line.colour.light), line.colour.dashes);
            let mut known = series.iter();
            let is_new = known.all(|known| known.colour != colour || known.dashes != dashes);
            // marks look like where the effort stands at its limit, and like how far other goals are
            if is_new && ![RED, MUTED_DASHED].contains(&line.colour) {
                let entry = legend.iter().find(|entry| match entry.swatch {
                    Swatch::Line(colour) => colour == line.colour,
                    _ => false,
                });
                series.push(Series {
                    name: visible(entry.map_or("value", |entry| &entry.text)).into_owned(),
                    colour,
                    dashes,
                    off: course.off + ROUNDING,
                    pad: half_width(line.width),
                    cut: line.cut,
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
            full: band.map(|(full, _)| full),
            zero: band.map(|(_, zero)| zero),
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

#[cfg(test)]
pub(super) mod tests {
    use serde_json::Value;

    use super::super::Plot;

    /// Reads the values of one series off a picture, as the viewer does.
    pub(crate) struct Reader {
        panel: Value,
        series: Value,
        /// Points of each path, and whether it is a band.
        paths: Vec<(Vec<(f64, f64)>, bool)>,
    }

    fn number(value: &Value) -> f64 {
        value.as_f64().expect("a number")
    }

    fn between<'a>(text: &'a str, from: &str, to: &str) -> Option<&'a str> {
        Some(text.split_once(from)?.1.split_once(to)?.0)
    }

    /// The points of each part of `m1 2 3-4m5 6`, steps from the one before.
    fn parts(d: &str) -> Vec<Vec<(f64, f64)>> {
        let mut at = (0.0, 0.0);
        let parts = d.trim_end_matches('z').split('m').skip(1).map(|part| {
            let spaced = part.replace('-', " -");
            let steps: Vec<f64> = spaced
                .split_whitespace()
                .map(|step| step.parse().expect("a number"))
                .collect();
            let points = steps.chunks(2).map(|step| {
                at = (at.0 + step[0], at.1 + step[1]);
                at
            });
            points.collect()
        });
        parts.collect()
    }

    impl Reader {
        pub(crate) fn new(plot: &Plot, panel: usize, series: usize) -> Self {
            let axes: Value = serde_json::from_str(&plot.axes).expect("JSON");
            let panel = axes[panel].clone();
            let series = panel["series"][series].clone();
            let colour = series["colour"].as_str().expect("a colour");
            let edges: Vec<f64> = (0..4).map(|i| number(&panel["box"][i])).collect();
            let inside = |p: &(f64, f64)| {
                edges[0] - 1.0 <= p.0
                    && p.0 <= edges[2] + 1.0
                    && edges[1] - 40.0 <= p.1
                    && p.1 <= edges[3] + 40.0
            };
            let paths = plot.svg.lines().filter(|line| line.starts_with("<path"));
            let paths = paths.flat_map(|line| {
                let of = |name: &str| between(line, &format!(" {name}=\""), "\"");
                let is_band = of("fill") == Some(colour);
                let is_dashed_alike = of("stroke-dasharray") == series["dashes"].as_str();
                let is_its = is_band || of("stroke") == Some(colour) && is_dashed_alike;
                let parts = of("d").filter(|_| is_its).map_or_else(Vec::new, parts);
                parts.into_iter().map(move |path| (path, is_band))
            });
            let paths = paths.filter(|(path, _)| path.iter().all(inside)).collect();
            Self {
                panel,
                series,
                paths,
            }
        }

        pub(crate) fn cut(&self) -> Option<f64> {
            self.series["cut"].as_f64()
        }

        pub(crate) fn height(&self) -> f64 {
            number(&self.panel["y"][1]) - number(&self.panel["y"][0])
        }

        /// The lowest and the highest value there may have been at a moment.
        pub(crate) fn at(&self, t_s: f64) -> Option<(f64, f64)> {
            let edge = |i: usize| number(&self.panel["box"][i]);
            let t = [0, 1].map(|i| number(&self.panel["t"][i]));
            let x = edge(0) + (t_s - t[0]) / (t[1] - t[0]) * (edge(2) - edge(0));
            let (from, to) = (x - 0.5, x + 0.5);
            let mut found: Option<(f64, f64)> = None;
            for (path, is_band) in &self.paths {
                let pad = if *is_band {
                    number(&self.series["pad"])
                } else {
                    0.0
                };
                let mut seen: Option<(f64, f64)> = None;
                let closed = path.iter().chain(path.first().filter(|_| *is_band));
                let closed: Vec<_> = closed.copied().collect();
                for two in closed.windows(2) {
                    let (a, b) = if two[0].0 <= two[1].0 {
                        (two[0], two[1])
                    } else {
                        (two[1], two[0])
                    };
                    if b.0 < from || a.0 > to {
                        continue;
                    }
                    let slope = if b.0 > a.0 {
                        (b.1 - a.1) / (b.0 - a.0)
                    } else {
                        0.0
                    };
                    let ends = match b.0 > a.0 {
                        true => [from.max(a.0), to.min(b.0)].map(|x| a.1 + (x - a.0) * slope),
                        false => [a.1, b.1],
                    };
                    for y in ends {
                        let (top, bottom) = seen.unwrap_or((y, y));
                        seen = Some((top.min(y), bottom.max(y)));
                    }
                }
                if let Some((top, bottom)) = seen {
                    let (t, b) = found.unwrap_or((f64::INFINITY, f64::NEG_INFINITY));
                    found = Some((t.min(top + pad), b.max(bottom - pad)));
                }
            }
            let (top, bottom) = found?;
            let off = number(&self.series["off"]) + 1e-6;
            let y = [0, 1].map(|i| number(&self.panel["y"][i]));
            let value = |at: f64| y[0] + (edge(3) - at) / (edge(3) - edge(1)) * (y[1] - y[0]);
            Some((value(bottom + off), value(top - off)))
        }
    }
}
