//! How many of a class earned how much: bars over points, with the quartiles marked.

use super::axis::Axis;
use super::canvas::{Align, Canvas, Entry, Swatch, WIDTH, picture, text_width};
use super::{Head, Plot};
use crate::palette::{BLUE, FRAME, GRID, INK, MUTED, MUTED_DASHED, PURPLE};
use crate::visible::{file_stem, shortened};

/// What a histogram shows.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Histogram<'a> {
    /// Its title.
    pub title: &'a str,
    /// What lies along the axis, with its unit.
    pub quantity: &'a str,
    /// What is counted, in the plural.
    pub counted: &'a str,
    /// From, to and count of each bin, in order, without gaps.
    pub bins: &'a [(f64, f64, usize)],
    /// Lower quartile, median and upper quartile, where there are any.
    pub quartiles: Option<[f64; 3]>,
}

const LEFT: f64 = 52.0;
const RIGHT: f64 = WIDTH - 20.0;
/// Height of the panel \[px\].
const PANEL: f64 = 230.0;
/// Half of the room that a count takes \[px\].
const LABEL_HALF: f64 = 16.0;
/// Room between neighbouring bars \[px\].
const GAP: f64 = 3.0;

/// Bars over the bins, each with its count; nothing without bins.
pub fn histogram(histogram: &Histogram<'_>) -> Option<Plot> {
    let (first, last) = (histogram.bins.first()?, histogram.bins.last()?);
    let legend = legend(histogram);
    let title = shortened(histogram.title, 120);
    // the legend's height is known once it is laid out, which a picture of its own does
    let mut top = 0.0;
    picture("", 1.0, |canvas| top = canvas.legend(&legend, 20.0, 50.0));
    let most = histogram.bins.iter().map(|bin| bin.2).max().unwrap_or(0);
    let place = Place {
        across: Axis::exact(first.0, last.1),
        // room for the count above the highest bar
        up: Axis::exact(0.0, 1.12 * most.max(1) as f64),
        top: top + 12.0,
    };
    let height = place.bottom() + 42.0;
    let svg = picture(&title, height, |canvas| {
        canvas.title(&title, (20.0, 24.0));
        canvas.legend(&legend, 20.0, 50.0);
        place.draw(canvas, histogram);
    });
    let percent = |of: f64| format!("{:.2}%", 100.0 * (top - 5.0) / of);
    Some(Plot {
        name: file_stem(&title),
        title,
        svg,
        axes: "[]".to_owned(),
        head: Some(Head {
            legend: legend.iter().map(Entry::shown).collect(),
            of_height: percent(height),
            of_width: percent(WIDTH),
        }),
    })
}

fn legend(histogram: &Histogram<'_>) -> Vec<Entry> {
    let mut legend = vec![Entry::new(Swatch::Area(BLUE), histogram.counted)];
    if histogram.quartiles.is_some() {
        legend.push(Entry::new(Swatch::Line(PURPLE), "median"));
        legend.push(Entry::new(Swatch::Line(MUTED_DASHED), "quartiles"));
    }
    legend
}

/// Where the panel lies.
struct Place {
    across: Axis,
    up: Axis,
    top: f64,
}

impl Place {
    fn bottom(&self) -> f64 {
        self.top + PANEL
    }

    fn x(&self, value: f64) -> f64 {
        LEFT + self.across.fraction(value).clamp(0.0, 1.0) * (RIGHT - LEFT)
    }

    fn y(&self, value: f64) -> f64 {
        self.bottom() - self.up.fraction(value).clamp(0.0, 1.0) * PANEL
    }

    fn draw(&self, canvas: &mut Canvas, histogram: &Histogram<'_>) {
        let bottom = self.bottom();
        // counts are integers, and so are their ticks
        let is_whole = |value: f64| (value - value.round()).abs() < 1e-9;
        for tick in self.up.ticks(4).iter().filter(|tick| is_whole(tick.value)) {
            let y = self.y(tick.value);
            canvas.line(&[(LEFT, y), (RIGHT, y)], GRID, 1.0);
            canvas.text(&tick.label, (LEFT - 8.0, y), Align::End, MUTED);
        }
        for (from, to, count) in histogram.bins {
            let (left, right) = (self.x(*from) + 0.5 * GAP, self.x(*to) - 0.5 * GAP);
            let y = self.y(*count as f64);
            if *count > 0 {
                canvas.area((left, y), (right.max(left + 1.0), bottom), BLUE, 0.75);
                let (x, align) = self.beside_lines(histogram, 0.5 * (left + right));
                canvas.text(&count.to_string(), (x, y - 9.0), align, INK);
            }
        }
        if let Some([lower, median, upper]) = histogram.quartiles {
            for (value, colour, width) in [
                (lower, MUTED_DASHED, 1.5),
                (upper, MUTED_DASHED, 1.5),
                (median, PURPLE, 2.0),
            ] {
                let x = self.x(value);
                canvas.line(&[(x, self.top), (x, bottom)], colour, width);
            }
        }
        canvas.line(&[(LEFT, bottom), (RIGHT, bottom)], FRAME, 1.0);
        self.edges(canvas, histogram.bins);
        let middle = 0.5 * (LEFT + RIGHT);
        let quantity = shortened(histogram.quantity, 60);
        canvas.text(&quantity, (middle, bottom + 31.0), Align::Middle, MUTED);
    }

    /// Where a bar's count is written: over its middle, or beside a line that would go through it.
    fn beside_lines(&self, histogram: &Histogram<'_>, middle: f64) -> (f64, Align) {
        let mut lines = histogram.quartiles.iter().flatten().map(|at| self.x(*at));
        match lines.find(|line| (line - middle).abs() < LABEL_HALF) {
            Some(line) if line >= middle => (line - 5.0, Align::End),
            Some(line) => (line + 5.0, Align::Start),
            None => (middle, Align::Middle),
        }
    }

    /// The edges of the bins, as many as there is room for also where letters are larger.
    fn edges(&self, canvas: &mut Canvas, bins: &[(f64, f64, usize)]) {
        let edges = bins.iter().map(|bin| bin.0);
        let edges: Vec<f64> = edges.chain(bins.last().map(|bin| bin.1)).collect();
        let mut free = f64::NEG_INFINITY;
        for edge in edges {
            let label = kinemark_sim::text::number::typeset(edge, 4);
            let (x, half) = (self.x(edge), 0.8 * text_width(&label));
            if x - half < free {
                continue;
            }
            canvas.text(&label, (x, self.bottom() + 13.0), Align::Middle, MUTED);
            free = x + half + 4.0;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shown(bins: &[(f64, f64, usize)], quartiles: Option<[f64; 3]>) -> Option<Plot> {
        histogram(&Histogram {
            title: "Points <of> a lab",
            quantity: "points",
            counted: "students",
            bins,
            quartiles,
        })
    }

    #[test]
    fn every_bin_has_its_count_and_nothing_has_no_picture() {
        let bins = [(0.0, 2.0, 3), (2.0, 4.0, 0), (4.0, 5.0, 17)];
        let plot = shown(&bins, Some([1.0, 4.2, 5.0])).expect("a picture");
        assert!(plot.svg.contains(">\n17\n<") && plot.svg.contains(">\n3\n<"));
        assert_eq!(plot.svg.matches("opacity=\"0.75\"").count(), 2, "two bars");
        assert!(plot.svg.contains("<title>Points &lt;of&gt; a lab</title>"));
        assert!(plot.svg.contains(">\nmedian\n<"));
        assert!(!plot.svg.contains("NaN"));
        assert!(
            !shown(&bins, None)
                .expect("a picture")
                .svg
                .contains("median")
        );
        assert_eq!(shown(&[], None), None);
    }

    #[test]
    fn a_bar_is_as_high_as_its_count() {
        let plot = shown(&[(0.0, 1.0, 10), (1.0, 2.0, 5)], None).expect("a picture");
        let heights: Vec<f64> = plot
            .svg
            .split("<rect ")
            .filter(|rect| rect.contains("opacity=\"0.75\""))
            .filter_map(|rect| {
                let (_, rest) = rect.split_once("height=\"")?;
                rest.split('"').next()?.parse().ok()
            })
            .collect();
        assert_eq!(heights.len(), 2);
        assert!((heights[0] / heights[1] - 2.0).abs() < 0.01, "{heights:?}");
    }
}
