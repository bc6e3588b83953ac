//! One picture: lines, shapes and words in pixels.

use plotters::prelude::{
    BLACK, DrawingBackend, FontStyle, IntoFont, RGBAColor, ShapeStyle, TextStyle,
};
use plotters::style::Color as _;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::svg_backend::SvgBackend;
use crate::palette::{self, Colour, INK, MUTED, PAPER};
use crate::visible::{shortened, visible};

/// Units of the picture in a pixel: the writer knows whole units only, and a tenth of a pixel looks smooth.
pub(super) const UNITS: f64 = 10.0;

/// Width of every picture \[px\].
pub(super) const WIDTH: f64 = 640.0;

/// Size of ordinary words \[px\].
pub(super) const TEXT: f64 = 13.0;

/// How much of a band covers what is below it.
const BAND: f64 = 0.7;

/// Half the width of a line of `width` pixels, in units of the picture: so far a band reaches above and below its edges.
pub(super) fn half_width(width: f64) -> i32 {
    (0.5 * width * UNITS).round() as i32
}

/// Where a word's given place is in it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Align {
    Start,
    Middle,
    End,
}

/// What a legend shows before its words.
#[derive(Debug, Clone, Copy)]
pub(super) enum Swatch {
    /// A line.
    Line(Colour),
    /// A shaded area.
    Area(Colour),
    /// A body: a shaded area with its outline.
    Body(Colour),
    /// A body's outline alone.
    Outline(Colour),
    /// A filled dot.
    Dot(Colour),
    /// A ring.
    Ring(Colour),
    /// A cross.
    Cross(Colour),
    /// The number of a mark.
    Number(usize),
}

/// One line of a legend.
#[derive(Debug, Clone)]
pub(super) struct Entry {
    pub(super) swatch: Swatch,
    pub(super) text: String,
}

impl Entry {
    pub(super) fn new(swatch: Swatch, text: impl Into<String>) -> Self {
        Self {
            swatch,
            text: text.into(),
        }
    }

    /// A small picture of its own, and its words.
    pub(super) fn shown(&self) -> (String, String) {
        let size = (SWATCH, ROW);
        let (w, h) = units(size);
        let drawn = drawn(size, |canvas| canvas.swatch(self.swatch, (2.0, 0.5 * ROW)));
        let picture = format!(
            "<svg class=\"plot\" aria-hidden=\"true\" width=\"{SWATCH}\" height=\"{ROW}\" viewBox=\"0 0 {w} {h}\">{drawn}"
        );
        (picture, visible(&self.text).into_owned())
    }
}

/// A picture in the making.
pub(super) struct Canvas {
    backend: SvgBackend,
}

/// How much what is drawn covers; its colour is the pen's.
fn covering(alpha: f64) -> RGBAColor {
    BLACK.mix(alpha)
}

fn units((x, y): (f64, f64)) -> (i32, i32) {
    ((x * UNITS).round() as i32, (y * UNITS).round() as i32)
}

/// Makes a picture of `height` pixels; `title` is what a screen reader says, and `draw` what is seen.
pub(super) fn picture(title: &str, height: f64, draw: impl FnOnce(&mut Canvas)) -> String {
    sized_picture(title, (WIDTH, height), draw)
}

/// The same of another width: `size` is width and height.
pub(super) fn sized_picture(
    title: &str,
    size: (f64, f64),
    draw: impl FnOnce(&mut Canvas),
) -> String {
    let (w, h) = units(size);
    let drawn = drawn(size, |canvas| {
        canvas.area((0.0, 0.0), size, PAPER, 1.0);
        draw(canvas);
    });
    let title = maud::html! { title { (title) } }.into_string();
    let (width, height) = size;
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"plot\" role=\"img\" width=\"{width}\" height=\"{height}\" \
         font-family=\"sans-serif\" viewBox=\"0 0 {w} {h}\">{title}<style>{}</style>\n{drawn}",
        palette::plot_css()
    )
}

/// What is drawn in so many pixels across and down, and the end of its SVG.
fn drawn((width, height): (f64, f64), draw: impl FnOnce(&mut Canvas)) -> String {
    let (w, h) = units((width, height));
    let mut canvas = Canvas {
        backend: SvgBackend::new((w.unsigned_abs(), h.unsigned_abs()), INK),
    };
    draw(&mut canvas);
    canvas.backend.finish()
}

/// Height of a caption \[px\].
const CAPTION: f64 = 22.0;

/// A picture with a line of quiet words below it.
pub(super) fn captioned(svg: &str, caption: &str) -> String {
    let parts = || {
        let (start, rest) = svg.split_once(" height=\"")?;
        let (height, rest) = rest.split_once('"')?;
        let (look, rest) = rest.split_once(" viewBox=\"")?;
        let (_, rest) = rest.split_once('"')?;
        let drawn = rest.strip_suffix("</svg>\n")?;
        Some((start, height.parse::<f64>().ok()?, look, drawn))
    };
    let Some((start, height, look, drawn)) = parts() else {
        return svg.to_owned();
    };
    let caption = shortened(caption, 90);
    let foot = picture("", height + CAPTION, |canvas| {
        canvas.area((0.0, height), (WIDTH, height + CAPTION), PAPER, 1.0);
        let at = (WIDTH - 20.0, height + 0.5 * CAPTION - 4.0);
        canvas.text(&caption, at, Align::End, MUTED);
    });
    // what stands below the paper of the whole
    let foot = foot.split_once("</style>\n").map_or("", |(_, drawn)| drawn);
    let foot = foot.split_once('\n').map_or("", |(_, drawn)| drawn);
    let (w, h) = (WIDTH * UNITS, ((height + CAPTION) * UNITS).round());
    let height = height + CAPTION;
    format!("{start} height=\"{height}\"{look} viewBox=\"0 0 {w} {h}\"{drawn}{foot}")
}

impl Canvas {
    /// A filled rectangle.
    pub(super) fn area(&mut self, from: (f64, f64), to: (f64, f64), colour: Colour, alpha: f64) {
        let style = covering(alpha).filled();
        self.backend
            .with(colour)
            .draw_rect(units(from), units(to), &style, true)
            .ok();
    }

    /// A line through points in units of the picture.
    pub(super) fn stroke(&mut self, points: &[(i32, i32)], colour: Colour, width: f64) {
        let style = ShapeStyle {
            color: covering(1.0),
            filled: false,
            stroke_width: (width * UNITS) as u32,
        };
        let backend = self.backend.with(colour);
        match points {
            [] => {}
            // a single point would not show
            [point] => backend
                .draw_circle(*point, (width * UNITS) as u32, &style.filled(), true)
                .ok()
                .unwrap_or(()),
            _ => backend
                .draw_path(points.iter().copied(), &style)
                .ok()
                .unwrap_or(()),
        }
    }

    /// The area between two edges in units of the picture, both from left to right, as thick as a line of `width` pixels where they meet.
    pub(super) fn band(
        &mut self,
        upper: &[(i32, i32)],
        lower: &[(i32, i32)],
        colour: Colour,
        width: f64,
    ) {
        let half = half_width(width);
        let upper = upper.iter().map(|(x, y)| (*x, y - half));
        let lower = lower.iter().rev().map(|(x, y)| (*x, y + half));
        let style = covering(BAND).filled();
        let area = upper.chain(lower);
        self.backend.with(colour).fill_polygon(area, &style).ok();
    }

    /// A line through points in pixels.
    pub(super) fn line(&mut self, points: &[(f64, f64)], colour: Colour, width: f64) {
        let points: Vec<_> = points.iter().copied().map(units).collect();
        self.stroke(&points, colour, width);
    }

    /// A filled convex area with an outline through points in pixels; nothing with fewer than three.
    pub(super) fn polygon(&mut self, points: &[(f64, f64)], colour: Colour, alpha: f64) {
        if points.len() < 3 || alpha == 0.0 {
            return;
        }
        let style = covering(alpha).filled();
        let points = points.iter().copied().map(units);
        self.backend.with(colour).fill_polygon(points, &style).ok();
    }

    /// A filled disc.
    pub(super) fn disc(&mut self, centre: (f64, f64), radius: f64, colour: Colour, alpha: f64) {
        let style = covering(alpha).filled();
        let radius = (radius * UNITS).round() as u32;
        self.backend
            .with(colour)
            .draw_circle(units(centre), radius, &style, true)
            .ok();
    }

    /// A circle's edge.
    pub(super) fn ring(&mut self, centre: (f64, f64), radius: f64, colour: Colour, width: f64) {
        let style = covering(1.0).stroke_width((width * UNITS) as u32);
        let radius = (radius * UNITS).round() as u32;
        self.backend
            .with(colour)
            .draw_circle(units(centre), radius, &style, false)
            .ok();
    }

    /// An upright cross on its corner.
    pub(super) fn cross(&mut self, (x, y): (f64, f64), arm: f64, colour: Colour, width: f64) {
        self.line(&[(x - arm, y - arm), (x + arm, y + arm)], colour, width);
        self.line(&[(x - arm, y + arm), (x + arm, y - arm)], colour, width);
    }

    /// Words, their middle at the height of `at`.
    pub(super) fn text(&mut self, text: &str, at: (f64, f64), align: Align, colour: Colour) {
        self.sized(text, at, align, colour, TEXT, FontStyle::Normal);
    }

    /// The title of a picture.
    pub(super) fn title(&mut self, text: &str, at: (f64, f64)) {
        self.sized(text, at, Align::Start, INK, 15.0, FontStyle::Bold);
    }

    /// The heading of a panel, as much of it as there is room for.
    pub(super) fn heading(&mut self, text: &str, at: (f64, f64)) {
        let mut fits = text.chars().count();
        while fits > 1 && text_width(&shortened(text, fits)) > WIDTH - 8.0 - at.0 {
            fits -= 1;
        }
        let text = &shortened(text, fits);
        self.sized(text, at, Align::Start, INK, TEXT, FontStyle::Normal);
    }

    fn sized(
        &mut self,
        text: &str,
        at: (f64, f64),
        align: Align,
        colour: Colour,
        size: f64,
        font: FontStyle,
    ) {
        let anchor = match align {
            Align::Start => HPos::Left,
            Align::Middle => HPos::Center,
            Align::End => HPos::Right,
        };
        let style: TextStyle<'_> = ("sans-serif", size * UNITS)
            .into_font()
            .style(font)
            .color(&BLACK)
            .pos(Pos::new(anchor, VPos::Center));
        let backend = self.backend.with(colour);
        backend.draw_text(text, &style, units(at)).ok();
    }

    /// Writes a legend from the left at height `y`, in as many rows as it needs, and returns the height below it.
    pub(super) fn legend(&mut self, entries: &[Entry], left: f64, y: f64) -> f64 {
        let (mut x, mut y) = (left, y);
        for entry in entries {
            let width = SWATCH + text_width(&entry.text) + GAP;
            if x > left && x + width - GAP > WIDTH - 12.0 {
                (x, y) = (left, y + ROW);
            }
            self.swatch(entry.swatch, (x, y));
            self.text(&entry.text, (x + SWATCH, y), Align::Start, MUTED);
            x += width;
        }
        if entries.is_empty() { y - 6.0 } else { y + ROW }
    }

    fn swatch(&mut self, swatch: Swatch, (x, y): (f64, f64)) {
        let centre = (x + 9.0, y);
        match swatch {
            Swatch::Line(colour) => self.line(&[(x, y), (x + 19.0, y)], colour, 2.0),
            Swatch::Area(colour) => self.area((x, y - 5.0), (x + 18.0, y + 5.0), colour, 0.2),
            Swatch::Body(colour) | Swatch::Outline(colour) => {
                let (left, top, right, bottom) = (x + 0.5, y - 5.0, x + 18.0, y + 5.0);
                if matches!(swatch, Swatch::Body(_)) {
                    self.area((left, top), (right, bottom), colour, 0.25);
                }
                let corners = [(left, top), (right, top), (right, bottom), (left, bottom)];
                let around: Vec<_> = corners.into_iter().chain([corners[0]]).collect();
                self.line(&around, colour, 1.2);
            }
            Swatch::Dot(colour) => self.disc(centre, 4.0, colour, 1.0),
            Swatch::Ring(colour) => self.ring(centre, 4.0, colour, 1.6),
            Swatch::Cross(colour) => self.cross(centre, 4.0, colour, 2.0),
            Swatch::Number(number) => {
                self.disc(centre, 8.0, MUTED, 1.0);
                self.sized(
                    &number.to_string(),
                    centre,
                    Align::Middle,
                    PAPER,
                    11.0,
                    FontStyle::Bold,
                );
            }
        }
    }

    /// The number of a mark in a disc.
    pub(super) fn number(&mut self, number: usize, (x, y): (f64, f64)) {
        self.swatch(Swatch::Number(number), (x - 9.0, y));
    }
}

/// Space a swatch takes in a legend \[px\].
const SWATCH: f64 = 25.0;
/// Space between two entries \[px\].
const GAP: f64 = 16.0;
/// Height of a row \[px\].
const ROW: f64 = 19.0;

/// About how wide words are at the ordinary size, on the safe side \[px\].
pub(super) fn text_width(text: &str) -> f64 {
    let em = |c: char| match c {
        'i' | 'j' | 'l' | '.' | ',' | '\'' | '|' | ' ' => 0.36,
        'm' | 'w' | 'M' | 'W' | '…' => 0.9,
        'A'..='Z' => 0.72,
        '\u{2E80}'.. => 1.05,
        _ => 0.6,
    };
    text.chars().map(em).sum::<f64>() * TEXT
}
