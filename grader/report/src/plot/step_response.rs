//! Step responses of a joint as a picture: runs and linear predictions over time, one panel for each signal.

use super::axis::{Axis, extent};
use super::canvas::{Entry, Swatch};
use super::signals::line;
use super::timeline::{Line, MOST_POINTS, Panel, Timeline};
use super::{Plot, reading};
use crate::palette::{
    BLUE, Colour, FRAME, MUTED_DASHED, PURPLE_DASHED, SERIES, SERIES_DASHED, VERMILLION_DASHED,
};
use crate::visible::{file_stem, shortened};

/// The most curves that differ in colour.
const MOST_SERIES: usize = SERIES.len();

/// A curve over time.
#[derive(Debug, Clone, PartialEq)]
pub struct ResponseCurve<'a> {
    /// Which of the labels of the picture it belongs to.
    pub series: usize,
    /// Whether it is a prediction, and drawn dashed; else it is a run.
    pub is_prediction: bool,
    /// Time between two values \[s\]; the first value is at time zero.
    pub step_s: f64,
    /// The values; where one is not finite, the line has a gap.
    pub values: &'a [f64],
}

/// A pair of axes with curves of one signal.
#[derive(Debug, Clone, PartialEq)]
pub struct ResponsePanel<'a> {
    /// What is drawn, without its unit.
    pub name: String,
    /// Its unit.
    pub unit: String,
    /// The curves.
    pub curves: Vec<ResponseCurve<'a>>,
    /// What the signal should be, if that is drawn.
    pub command: Option<f64>,
    /// A size that the signal cannot exceed, if that is drawn.
    pub limit: Option<f64>,
    /// The lowest and the highest value that are drawn; all are, if this is none.
    pub range: Option<(f64, f64)>,
}

/// A picture of step responses.
#[derive(Debug, Clone, PartialEq)]
pub struct ResponsePicture<'a> {
    /// Its title.
    pub title: String,
    /// What each series is called, where there are several; one series has no label.
    pub labels: Vec<String>,
    /// Until when it is drawn \[s\].
    pub end_s: f64,
    /// Where the run ended before its time, if it did and is the only one \[s\].
    pub stopped_s: Option<f64>,
    /// The panels, from top to bottom.
    pub panels: Vec<ResponsePanel<'a>>,
}

impl ResponsePicture<'_> {
    fn colour(&self, curve: &ResponseCurve<'_>) -> Colour {
        let series = curve.series % MOST_SERIES;
        match (self.labels.is_empty(), curve.is_prediction) {
            (true, false) => BLUE,
            (true, true) => PURPLE_DASHED,
            (false, false) => SERIES[series],
            (false, true) => SERIES_DASHED[series],
        }
    }

    /// Among several series the colour of a limit would be that of one of them.
    fn limit_colour(&self) -> Colour {
        if self.labels.is_empty() {
            VERMILLION_DASHED
        } else {
            FRAME
        }
    }

    fn legend(&self) -> Vec<Entry> {
        let has = |test: fn(&ResponsePanel<'_>) -> bool| self.panels.iter().any(test);
        let predicts = has(|panel| panel.curves.iter().any(|curve| curve.is_prediction));
        let mut legend = Vec::new();
        if self.labels.is_empty() {
            legend.push(Entry::new(Swatch::Line(BLUE), "run"));
            if predicts {
                legend.push(Entry::new(Swatch::Line(PURPLE_DASHED), "linear theory"));
            }
        }
        for (series, label) in self.labels.iter().enumerate() {
            let colour = SERIES[series % MOST_SERIES];
            legend.push(Entry::new(Swatch::Line(colour), shortened(label, 40)));
        }
        if predicts && !self.labels.is_empty() {
            legend.push(Entry::new(
                Swatch::Line(SERIES_DASHED[0]),
                "dashed: linear theory",
            ));
        }
        if has(|panel| panel.command.is_some()) {
            legend.push(Entry::new(Swatch::Line(MUTED_DASHED), "command"));
        }
        if has(|panel| panel.limit.is_some()) {
            legend.push(Entry::new(
                Swatch::Line(VERMILLION_DASHED),
                "limit of the motor",
            ));
        }
        legend
    }

    fn panel(&self, shown: &ResponsePanel<'_>) -> Panel {
        let lines = shown.curves.iter().map(|curve| self.line(shown, curve));
        let lines: Vec<Line> = lines.collect();
        let finite = lines
            .iter()
            .flat_map(|line| &line.points)
            .map(|point| point.1);
        let values = finite
            .chain(shown.command)
            .filter(|value| value.is_finite());
        let axis = match shown.range {
            Some((low, high)) => Axis::exact(low, high),
            None => Axis::around(values.clone(), 1e-9),
        };
        // a limit far from all values would flatten them
        let near = extent(values).map_or(0.0, |(low, high)| 1.3 * low.abs().max(high.abs()));
        let limits = shown.limit.filter(|limit| *limit <= near).into_iter();
        let limits = limits
            .flat_map(|limit| [limit, -limit])
            .map(|at| (at, self.limit_colour()));
        let unit = &shown.unit;
        let name = shortened(&shown.name, 60);
        Panel {
            heading: format!("{name} [{unit}]"),
            name,
            unit: unit.clone(),
            axis,
            lines,
            levels: shown
                .command
                .map(|at| (at, MUTED_DASHED))
                .into_iter()
                .chain(limits)
                .collect(),
            spans: Vec::new(),
            bands: Vec::new(),
        }
    }

    fn line(&self, panel: &ResponsePanel<'_>, curve: &ResponseCurve<'_>) -> Line {
        let inside = |value: f64| match panel.range {
            Some((low, high)) if !(low..=high).contains(&value) => f64::NAN,
            _ => value,
        };
        let times = (0..curve.values.len()).map(|tick| tick as f64 * curve.step_s);
        let points = times
            .zip(curve.values)
            .map(|(t_s, value)| (t_s, inside(*value)));
        // half a step more: times are rounded
        let end_s = self.end_s + 0.5 * curve.step_s;
        let points = points.take_while(|(t_s, _)| *t_s <= end_s).collect();
        line(points, self.colour(curve), false)
    }
}

/// Draws step responses. The same curves give the same bytes.
pub fn response_picture(picture: &ResponsePicture<'_>) -> Plot {
    let title = shortened(&picture.title.replace('`', ""), 90);
    let timeline = Timeline {
        title: title.clone(),
        panels: picture
            .panels
            .iter()
            .map(|panel| picture.panel(panel))
            .collect(),
        legend: picture.legend(),
        marks: Vec::new(),
        end_s: picture.end_s,
        stopped_s: picture.stopped_s,
        most_points: MOST_POINTS,
    };
    let (svg, axes, head) = timeline.draw();
    Plot {
        name: file_stem(&title),
        title,
        svg,
        axes: reading::json(&axes),
        head: Some(head),
    }
}

#[cfg(test)]
mod tests {
    use super::super::reading::tests::Reader;
    use super::*;
    use crate::palette::hex;

    fn curve(values: &[f64], series: usize, is_prediction: bool) -> ResponseCurve<'_> {
        ResponseCurve {
            series,
            is_prediction,
            step_s: 0.01,
            values,
        }
    }

    fn drawn(labels: &[&str], curves: Vec<ResponseCurve<'_>>, range: Option<(f64, f64)>) -> Plot {
        response_picture(&ResponsePicture {
            title: "Step of `elbow` <1>".to_owned(),
            labels: labels.iter().map(|label| (*label).to_owned()).collect(),
            end_s: 1.0,
            stopped_s: None,
            panels: vec![ResponsePanel {
                name: "elbow, position".to_owned(),
                unit: "rad".to_owned(),
                curves,
                command: Some(1.0),
                limit: None,
                range,
            }],
        })
    }

    #[test]
    fn what_is_read_off_is_the_run_and_the_prediction() {
        let run: Vec<f64> = (0..=100)
            .map(|i| 1.0 - libm::exp(-0.1 * f64::from(i)))
            .collect();
        let theory: Vec<f64> = run.iter().map(|value| 0.9 * value).collect();
        let curves = vec![curve(&run, 0, false), curve(&theory, 0, true)];
        let plot = drawn(&[], curves, None);
        for (series, values) in [&run, &theory].into_iter().enumerate() {
            let reader = Reader::new(&plot, 0, series);
            for tick in (5..95).step_by(10) {
                let (low, high) = reader.at(0.01 * tick as f64).expect("a value");
                assert!(low <= values[tick] && values[tick] <= high, "{low} {high}");
                assert!(high - low < 0.05);
            }
        }
        assert!(plot.svg.contains("linear theory") && plot.svg.contains("command"));
        assert!(plot.svg.contains("<title>Step of elbow &lt;1&gt;</title>"));
        assert_eq!(plot.name, "step-of-elbow-1");
    }

    #[test]
    fn series_differ_in_colour_and_values_beyond_the_range_are_left_out() {
        let (low, high) = (vec![0.98; 101], vec![0.5; 101]);
        let curves = vec![curve(&low, 0, false), curve(&high, 1, false)];
        let all = drawn(&["kd 2", "kd 5"], curves.clone(), None);
        let near = drawn(&["kd 2", "kd 5"], curves, Some((0.95, 1.05)));
        let lines = |plot: &Plot, colour: Colour| {
            plot.svg
                .matches(&format!("stroke=\"{}\"", hex(colour.light)))
                .count()
        };
        // the second colour is in the legend only where its values are beyond the range
        assert_eq!(lines(&all, SERIES[1]), lines(&near, SERIES[1]) + 1);
        assert_eq!(lines(&all, SERIES[0]), lines(&near, SERIES[0]));
        assert!(all.svg.contains("kd 2") && all.svg.contains("kd 5"));
    }

    #[test]
    fn nothing_and_what_is_no_number_are_drawn_as_empty_axes() {
        let wild = [f64::NAN, f64::INFINITY, 1e300];
        for values in [&wild[..], &[]] {
            let plot = drawn(&[], vec![curve(values, 0, false)], None);
            assert!(!plot.svg.contains("NaN") && !plot.svg.contains("inf"));
        }
    }
}
