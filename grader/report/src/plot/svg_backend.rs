//! The SVG of a plot, written as it is drawn: what plotters draws on, with the colour and the dashes of a pen.
//!
//! Polylines and polygons are paths of steps from point to point, and neighbours that look the same are one path: less than half the
//! bytes of their points.

use std::convert::Infallible;
use std::fmt::Write as _;

use plotters::prelude::DrawingBackend;
use plotters_backend::text_anchor::HPos;
use plotters_backend::{
    BackendColor, BackendCoord, BackendStyle, BackendTextStyle, DrawingErrorKind, FontStyle,
};

use crate::palette::{Colour, hex};

type DrawResult = Result<(), DrawingErrorKind<Infallible>>;

/// A picture in the making. A style says how wide a line is and how much an area covers; its colour is the pen's, which has a dark
/// form and dashes besides.
#[derive(Debug)]
pub(super) struct SvgBackend {
    size: (u32, u32),
    svg: String,
    pen: Colour,
    /// The look of the path that can go on, and its last point.
    open: Option<(String, BackendCoord)>,
}

impl SvgBackend {
    /// An empty picture of so many units across and down.
    pub(super) fn new(size: (u32, u32), pen: Colour) -> Self {
        Self {
            size,
            svg: String::new(),
            pen,
            open: None,
        }
    }

    /// The same with another pen.
    pub(super) fn with(&mut self, pen: Colour) -> &mut Self {
        self.pen = pen;
        self
    }

    /// What was drawn, with the end of the picture.
    pub(super) fn finish(mut self) -> String {
        self.end_path();
        self.svg.push_str("</svg>\n");
        self.svg
    }

    fn end_path(&mut self) {
        if self.open.take().is_some() {
            self.svg.push_str("\"/>\n");
        }
    }

    /// Writes an element without content.
    fn element(&mut self, element: &str) {
        self.end_path();
        self.svg.push_str(element);
        self.svg.push_str("/>\n");
    }

    /// Writes points as steps; a path that is not closed goes on with the next one that looks the same.
    fn path(&mut self, look: String, points: impl Iterator<Item = BackendCoord>, is_closed: bool) {
        let goes_on = matches!(&self.open, Some((before, _)) if *before == look && !is_closed);
        let mut at = match self.open.take() {
            Some((_, at)) if goes_on => at,
            before => {
                self.svg
                    .push_str(if before.is_some() { "\"/>\n" } else { "" });
                self.svg.push_str("<path");
                self.svg.push_str(&look);
                self.svg.push_str(" d=\"");
                (0, 0)
            }
        };
        for (i, point) in points.enumerate() {
            let (dx, dy) = (point.0 - at.0, point.1 - at.1);
            let start = match (i, dx < 0) {
                (0, _) => "m",
                (_, true) => "",
                (_, false) => " ",
            };
            let between = if dy < 0 { "" } else { " " };
            // writing into a string cannot fail
            let _ = write!(self.svg, "{start}{dx}{between}{dy}");
            at = point;
        }
        if is_closed {
            self.svg.push_str("z\"/>\n");
        } else {
            self.open = Some((look, at));
        }
    }

    fn colour(&self) -> String {
        hex(self.pen.light)
    }

    /// What is drawn with the pen: an area, or its edge.
    fn fill_and_stroke(&self, fill: bool) -> String {
        if fill {
            return format!(" fill=\"{}\" stroke=\"none\"", self.colour());
        }
        format!(" fill=\"none\"{}", self.stroke())
    }

    /// The pen's colour and dashes for a line.
    fn stroke(&self) -> String {
        let colour = self.colour();
        let dashes = self.pen.dashes;
        let dashes = dashes.map(|dashes| format!(" stroke-dasharray=\"{dashes}\""));
        format!(" stroke=\"{colour}\"{}", dashes.unwrap_or_default())
    }
}

/// How much it covers, unless that is all.
fn opacity(colour: BackendColor) -> String {
    if colour.alpha < 1.0 {
        format!(" opacity=\"{}\"", colour.alpha)
    } else {
        String::new()
    }
}

impl DrawingBackend for SvgBackend {
    type ErrorType = Infallible;

    fn get_size(&self) -> (u32, u32) {
        self.size
    }

    fn ensure_prepared(&mut self) -> DrawResult {
        Ok(())
    }

    fn present(&mut self) -> DrawResult {
        Ok(())
    }

    fn draw_pixel(&mut self, (x, y): BackendCoord, color: BackendColor) -> DrawResult {
        self.draw_rect((x, y), (x + 1, y + 1), &color, true)
    }

    fn draw_line<S: BackendStyle>(
        &mut self,
        from: BackendCoord,
        to: BackendCoord,
        style: &S,
    ) -> DrawResult {
        self.draw_path([from, to], style)
    }

    fn draw_rect<S: BackendStyle>(
        &mut self,
        upper_left: BackendCoord,
        bottom_right: BackendCoord,
        style: &S,
        fill: bool,
    ) -> DrawResult {
        let style = style.color();
        if style.alpha == 0.0 {
            return Ok(());
        }
        let (x, y) = upper_left;
        let (width, height) = (bottom_right.0 - x, bottom_right.1 - y);
        let look = opacity(style) + self.fill_and_stroke(fill).as_str();
        self.element(&format!(
            "<rect x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\"{look}"
        ));
        Ok(())
    }

    fn draw_path<S: BackendStyle, I: IntoIterator<Item = BackendCoord>>(
        &mut self,
        path: I,
        style: &S,
    ) -> DrawResult {
        if style.color().alpha == 0.0 {
            return Ok(());
        }
        let look = format!(
            " fill=\"none\"{}{} stroke-width=\"{}\"",
            opacity(style.color()),
            self.stroke(),
            style.stroke_width()
        );
        self.path(look, path.into_iter(), false);
        Ok(())
    }

    fn fill_polygon<S: BackendStyle, I: IntoIterator<Item = BackendCoord>>(
        &mut self,
        path: I,
        style: &S,
    ) -> DrawResult {
        if style.color().alpha == 0.0 {
            return Ok(());
        }
        let look = format!("{} fill=\"{}\"", opacity(style.color()), self.colour());
        self.path(look, path.into_iter(), true);
        Ok(())
    }

    fn draw_circle<S: BackendStyle>(
        &mut self,
        (x, y): BackendCoord,
        radius: u32,
        style: &S,
        fill: bool,
    ) -> DrawResult {
        if style.color().alpha == 0.0 {
            return Ok(());
        }
        let look = opacity(style.color()) + self.fill_and_stroke(fill).as_str();
        let width = style.stroke_width();
        self.element(&format!(
            "<circle cx=\"{x}\" cy=\"{y}\" r=\"{radius}\"{look} stroke-width=\"{width}\""
        ));
        Ok(())
    }

    fn draw_text<S: BackendTextStyle>(
        &mut self,
        text: &str,
        style: &S,
        (x, y): BackendCoord,
    ) -> DrawResult {
        self.end_path();
        let anchor = match style.anchor().h_pos {
            HPos::Left => "start",
            HPos::Right => "end",
            HPos::Center => "middle",
        };
        let (size, colour) = (style.size(), self.colour());
        let weight = match style.style() {
            FontStyle::Bold => " font-weight=\"bold\"",
            _ => "",
        };
        // half the height of an x below the middle
        let _ = writeln!(
            self.svg,
            "<text x=\"{x}\" y=\"{y}\" dy=\"0.5ex\" text-anchor=\"{anchor}\" font-size=\"{size}\" opacity=\"1\" \
             fill=\"{colour}\"{weight}>"
        );
        push_escaped(&mut self.svg, text);
        self.svg.push_str("\n</text>\n");
        Ok(())
    }
}

/// Text that stands for itself.
fn push_escaped(svg: &mut String, text: &str) {
    for c in text.chars() {
        match c {
            '<' => svg.push_str("&lt;"),
            '>' => svg.push_str("&gt;"),
            '&' => svg.push_str("&amp;"),
            '"' => svg.push_str("&quot;"),
            '\'' => svg.push_str("&apos;"),
            other => svg.push(other),
        }
    }
}

#[cfg(test)]
mod tests {
    use plotters::prelude::{BLACK, ShapeStyle};
    use plotters::style::Color as _;

    use super::*;
    use crate::palette::{BLUE, GREEN, GREEN_DASHED};

    fn line(alpha: f64) -> ShapeStyle {
        ShapeStyle {
            color: BLACK.mix(alpha),
            filled: false,
            stroke_width: 20,
        }
    }

    #[test]
    fn lines_that_look_the_same_are_one_path_of_steps() {
        let mut svg = SvgBackend::new((100, 100), BLUE);
        svg.draw_path([(10, 20), (30, 5), (30, 7)], &line(1.0))
            .unwrap();
        svg.draw_line((0, 0), (1, -1), &line(1.0)).unwrap();
        svg.fill_polygon([(1, 1), (2, 1), (2, 2)], &line(0.2))
            .unwrap();
        svg.with(GREEN)
            .draw_path([(1, 1), (2, 2)], &line(1.0))
            .unwrap();
        svg.with(BLUE)
            .draw_path([(1, 1), (2, 2)], &line(1.0))
            .unwrap();
        svg.with(GREEN_DASHED)
            .draw_path([(1, 1), (2, 2)], &line(1.0))
            .unwrap();
        svg.draw_rect((1, 2), (4, 6), &line(0.0), true).unwrap();
        assert_eq!(
            svg.finish(),
            "<path fill=\"none\" stroke=\"#006CAE\" stroke-width=\"20\" d=\"m10 20 20-15 0 2m-30-7 1-1\"/>\n\
             <path opacity=\"0.2\" fill=\"#006CAE\" d=\"m1 1 1 0 0 1z\"/>\n\
             <path fill=\"none\" stroke=\"#007E5C\" stroke-width=\"20\" d=\"m1 1 1 1\"/>\n\
             <path fill=\"none\" stroke=\"#006CAE\" stroke-width=\"20\" d=\"m1 1 1 1\"/>\n\
             <path fill=\"none\" stroke=\"#007E5C\" stroke-dasharray=\"60 35\" stroke-width=\"20\" d=\"m1 1 1 1\"/>\n</svg>\n"
        );
    }

    #[test]
    fn areas_and_words_stand_for_themselves() {
        let mut svg = SvgBackend::new((100, 100), BLUE);
        svg.draw_rect((1, 2), (4, 6), &line(0.5), true).unwrap();
        svg.draw_circle((5, 6), 7, &line(1.0), false).unwrap();
        let style = plotters::style::TextStyle::from(("sans-serif", 130.0));
        svg.draw_text("a<b & \"c\"", &style, (8, 9)).unwrap();
        assert_eq!(
            svg.finish(),
            "<rect x=\"1\" y=\"2\" width=\"3\" height=\"4\" opacity=\"0.5\" fill=\"#006CAE\" stroke=\"none\"/>\n\
             <circle cx=\"5\" cy=\"6\" r=\"7\" fill=\"none\" stroke=\"#006CAE\" stroke-width=\"20\"/>\n\
             <text x=\"8\" y=\"9\" dy=\"0.5ex\" text-anchor=\"start\" font-size=\"130\" opacity=\"1\" fill=\"#006CAE\">\n\
             a&lt;b &amp; &quot;c&quot;\n</text>\n</svg>\n"
        );
    }
}
