//! Pictures over time: panels below each other with one time axis, a legend above, nothing on top of the data.

use kinemark_sim::text::number::seconds;

use super::Head;
use super::axis::Axis;
use super::canvas::{Align, Canvas, Entry, Swatch, UNITS, WIDTH, picture};
use super::course::{Course, Point, courses};
use super::reading::Axes;
use crate::palette::{Colour, FRAME, GRID, MUTED, MUTED_DASHED, RED};
use crate::visible::shortened;

/// A line over time.
pub(super) struct Line {
    /// Times \[s\] and values, in order of time.
    pub(super) points: Vec<(f64, f64)>,
    pub(super) colour: Colour,
    /// Width \[px\].
    pub(super) width: f64,
    /// Whether a value is held until the next.
    pub(super) held: bool,
    /// The size at which values are cut off, if some are greater.
    pub(super) cut: Option<f64>,
}

/// One pair of axes.
pub(super) struct Panel {
    /// What the vertical axis shows, with its unit.
    pub(super) heading: String,
    /// What it shows, short and without its unit.
    pub(super) name: String,
    /// Unit of the vertical axis; empty where it has none.
    pub(super) unit: String,
    pub(super) axis: Axis,
    pub(super) lines: Vec<Line>,
    /// Values drawn as lines across.
    pub(super) levels: Vec<(f64, Colour)>,
    /// Times from and to \[s\] that are shaded.
    pub(super) spans: Vec<(f64, f64, Colour)>,
    /// Values from and to that are shaded.
    pub(super) bands: Vec<(f64, f64, Colour)>,
}

/// A picture over time.
pub(super) struct Timeline {
    pub(super) title: String,
    pub(super) panels: Vec<Panel>,
    pub(super) legend: Vec<Entry>,
    /// Moments \[s\] with their words.
    pub(super) marks: Vec<(f64, String)>,
    /// The last moment \[s\].
    pub(super) end_s: f64,
    /// Where the run ended before its time \[s\].
    pub(super) stopped_s: Option<f64>,
    /// Points of all its lines.
    pub(super) most_points: usize,
}

const LEFT: f64 = 68.0;
const RIGHT: f64 = WIDTH - 20.0;
/// Points of all lines of a picture: with some six bytes each, a picture stays well below 60 KB.
pub(super) const MOST_POINTS: usize = 5000;
/// A held value that is new more often than this makes no corners, which nobody would see, in units of the picture: a fifth of a pixel.
const NARROWEST_STEP: i32 = 2;
/// Marks that are numbered and listed.
const MOST_MARKS: usize = 6;

/// Says when a run stopped, beside its line.
fn stopped_here(canvas: &mut Canvas, t_s: f64, x: f64, heading_y: f64) {
    let words = format!("stopped here, {}", seconds(t_s));
    let (align, x) = if x < 0.5 * WIDTH {
        (Align::Start, x.max(300.0))
    } else {
        (Align::End, x + 6.0)
    };
    canvas.text(&words, (x, heading_y), align, RED);
}

impl Timeline {
    /// Draws it, and returns where its axes lie and what is above them.
    pub(super) fn draw(&self) -> (String, Vec<Axes>, Head) {
        let mut axes = Vec::new();
        let panel_height = match self.panels.len() {
            0 | 1 => 210.0,
            2 => 150.0,
            3 => 125.0,
            _ => 105.0,
        };
        let legend = self.legend_with_marks();
        // the legend's height is known once it is laid out, which a picture of its own does
        let mut top = 0.0;
        picture("", 1.0, |canvas| top = canvas.legend(&legend, 20.0, 50.0));
        let numbers = if self.marks.is_empty() { 0.0 } else { 24.0 };
        let pitch = panel_height + 30.0;
        let height = top + numbers + pitch * self.panels.len() as f64 + 42.0;
        let place = |i: usize, panel: &Panel| {
            let below = if i == 0 { 0.0 } else { numbers };
            let from = top + below + pitch * i as f64 + 8.0 + 15.0 + numbers - below;
            Place {
                time: Axis::exact(0.0, self.end_s),
                value: panel.axis,
                top: from,
                bottom: from + panel_height,
            }
        };
        let signals: Vec<Vec<Option<Point>>> = self
            .panels
            .iter()
            .enumerate()
            .flat_map(|(i, panel)| {
                let place = place(i, panel);
                let signals = panel.lines.iter().map(|line| place.points(line).collect());
                signals.collect::<Vec<_>>()
            })
            .collect();
        let mut courses = courses(&signals, self.most_points).into_iter();
        let svg = picture(&self.title, height, |canvas| {
            canvas.title(&self.title, (20.0, 24.0));
            canvas.legend(&legend, 20.0, 50.0);
            for (i, panel) in self.panels.iter().enumerate() {
                let below = if i == 0 { 0.0 } else { numbers };
                let heading_y = top + below + pitch * i as f64 + 8.0;
                let place = place(i, panel);
                let last = i + 1 == self.panels.len();
                canvas.heading(&panel.heading, (20.0, heading_y));
                if i == 0
                    && let Some(t_s) = self.stopped_s
                {
                    stopped_here(canvas, t_s, place.x(t_s), heading_y);
                }
                let courses: Vec<Course> = courses.by_ref().take(panel.lines.len()).collect();
                self.panel(canvas, panel, &courses, &place, last);
                let edges = [LEFT, place.top, RIGHT, place.bottom];
                axes.push(Axes::over_time(
                    panel,
                    &courses,
                    &self.legend,
                    place.time.max,
                    edges,
                ));
                if i == 0 {
                    self.numbers(canvas, &place, heading_y + 19.0);
                }
            }
        });
        let head = Head::above(&legend, top, height);
        (svg, axes, head)
    }

    /// The legend, and below it the words and times of the marks by their numbers.
    fn legend_with_marks(&self) -> Vec<Entry> {
        let mut legend = self.legend.clone();
        let marks = self.marks.iter().take(MOST_MARKS).enumerate();
        legend.extend(marks.map(|(i, (t_s, text))| {
            Entry::new(
                Swatch::Number(i + 1),
                format!("{}, {}", shortened(text, 60), seconds(*t_s)),
            )
        }));
        legend
    }

    fn panel(
        &self,
        canvas: &mut Canvas,
        panel: &Panel,
        courses: &[Course],
        place: &Place,
        last: bool,
    ) {
        let (top, bottom) = (place.top, place.bottom);
        for (from_s, to_s, colour) in &panel.spans {
            let (from, to) = (place.x(*from_s), place.x(*to_s));
            canvas.area((from, top), (to.max(from + 1.0), bottom), *colour, 0.16);
        }
        for (from, to, colour) in &panel.bands {
            let (from, to) = (place.y(*from), place.y(*to));
            canvas.area((LEFT, to), (RIGHT, from.max(to + 2.0)), *colour, 0.2);
        }
        let times = place.time.ticks(8);
        let values = place.value.ticks(((bottom - top) / 34.0) as usize);
        let across = times.iter().map(|tick| place.x(tick.value));
        let up = values.iter().map(|tick| place.y(tick.value));
        for x in across.clone() {
            canvas.line(&[(x, top), (x, bottom)], GRID, 1.0);
        }
        for y in up.clone() {
            canvas.line(&[(LEFT, y), (RIGHT, y)], GRID, 1.0);
        }
        for (tick, x) in times.iter().zip(across).filter(|_| last) {
            canvas.text(&tick.label, (x, bottom + 13.0), Align::Middle, MUTED);
        }
        for (tick, y) in values.iter().zip(up) {
            canvas.text(&tick.label, (LEFT - 8.0, y), Align::End, MUTED);
        }
        if last {
            let middle = 0.5 * (LEFT + RIGHT);
            canvas.text("time [s]", (middle, bottom + 31.0), Align::Middle, MUTED);
        }
        for (value, colour) in &panel.levels {
            if place.value.holds(*value) {
                let y = place.y(*value);
                canvas.line(&[(LEFT, y), (RIGHT, y)], *colour, 1.5);
            }
        }
        for (t_s, _) in &self.marks {
            let x = place.x(*t_s);
            canvas.line(&[(x, top), (x, bottom)], MUTED_DASHED, 1.0);
        }
        for (line, course) in panel.lines.iter().zip(courses) {
            for [upper, lower] in &course.bands {
                canvas.band(upper, lower, line.colour, line.width);
            }
            for piece in &course.lines {
                canvas.stroke(piece, line.colour, line.width);
            }
        }
        let corners = [
            (LEFT, top),
            (RIGHT, top),
            (RIGHT, bottom),
            (LEFT, bottom),
            (LEFT, top),
        ];
        canvas.line(&corners, FRAME, 1.0);
        if let Some(t_s) = self.stopped_s {
            let x = place.x(t_s);
            canvas.line(&[(x, top), (x, bottom)], RED, 2.0);
        }
    }

    /// The numbers of the marks above the first panel; one that would stand on another is moved aside.
    fn numbers(&self, canvas: &mut Canvas, place: &Place, y: f64) {
        let mut free = LEFT;
        for (i, (t_s, _)) in self.marks.iter().take(MOST_MARKS).enumerate() {
            let x = place.x(*t_s);
            let beside = x.max(free);
            canvas.line(&[(beside, y + 8.0), (x, place.top)], MUTED, 1.0);
            canvas.number(i + 1, (beside, y));
            free = beside + 19.0;
        }
    }
}

/// Where a panel lies in its picture.
struct Place {
    time: Axis,
    value: Axis,
    top: f64,
    bottom: f64,
}

impl Place {
    fn x(&self, t_s: f64) -> f64 {
        LEFT + self.time.fraction(t_s).clamp(0.0, 1.0) * (RIGHT - LEFT)
    }

    fn y(&self, value: f64) -> f64 {
        self.bottom - self.value.fraction(value).clamp(0.0, 1.0) * (self.bottom - self.top)
    }

    /// The points of a line in units of the picture; a held value makes a corner before the next, where that can be seen.
    fn points<'a>(&'a self, line: &'a Line) -> impl Iterator<Item = Option<Point>> + 'a {
        let mut before: Option<Point> = None;
        line.points.iter().flat_map(move |&(t_s, value)| {
            if !(value.is_finite() && t_s.is_finite()) {
                before = None;
                return [None, None];
            }
            let x = (self.x(t_s) * UNITS).round() as i32;
            let y = (self.y(value) * UNITS).round() as i32;
            let corner = before
                .replace((x, y))
                .filter(|before| line.held && x - before.0 > NARROWEST_STEP)
                .map(|before| (x, before.1));
            [Some(corner.unwrap_or((x, y))), Some((x, y))]
        })
    }
}
