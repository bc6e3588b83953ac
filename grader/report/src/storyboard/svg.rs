//! The storyboard's SVG: polygons, lines and words, with colours of their own and in the light form only.

use std::fmt::Write as _;

use crate::palette::{Colour, Rgb, hex};

/// Where a word's given place is in it.
#[derive(Debug, Clone, Copy)]
pub(super) enum Anchor {
    Start,
    Middle,
    End,
}

/// An SVG in the making; lengths are pixels.
#[derive(Debug, Default)]
pub(super) struct Svg {
    pub(super) body: String,
}

/// Text that stands for itself in SVG.
pub(super) fn escaped(text: &str) -> String {
    maud::html! { (text) }.into_string()
}

// writing into a string cannot fail
impl Svg {
    pub(super) fn raw(&mut self, text: &str) {
        self.body.push_str(text);
    }

    /// The outline of points as path data.
    fn path(&mut self, points: &[(f64, f64)], closed: bool) {
        for (i, (x, y)) in points.iter().enumerate() {
            let letter = if i == 0 { 'M' } else { 'L' };
            let _ = write!(self.body, "{letter}{x:.1} {y:.1}");
        }
        if closed {
            self.body.push('Z');
        }
    }

    /// Areas of one colour; the thin line around them closes the gaps between neighbours.
    pub(super) fn areas(&mut self, areas: &[Vec<(f64, f64)>], colour: Rgb) {
        if areas.is_empty() {
            return;
        }
        self.raw("<path d=\"");
        for area in areas {
            self.path(area, true);
        }
        let hex = hex(colour);
        let _ = writeln!(
            self.body,
            "\" fill=\"{hex}\" stroke=\"{hex}\" stroke-width=\".5\"/>"
        );
    }

    /// Lines of one colour.
    pub(super) fn lines(
        &mut self,
        lines: &[Vec<(f64, f64)>],
        colour: Rgb,
        width: f64,
        dashes: &str,
    ) {
        if lines.iter().all(|line| line.len() < 2) {
            return;
        }
        self.raw("<path d=\"");
        for line in lines.iter().filter(|line| line.len() > 1) {
            self.path(line, false);
        }
        let _ = write!(
            self.body,
            "\" fill=\"none\" stroke=\"{}\" stroke-width=\"{width}\" stroke-linejoin=\"round\" stroke-linecap=\"round\"",
            hex(colour)
        );
        if !dashes.is_empty() {
            let _ = write!(self.body, " stroke-dasharray=\"{dashes}\"");
        }
        self.raw("/>\n");
    }

    /// A disc with an edge.
    pub(super) fn disc(
        &mut self,
        (x, y): (f64, f64),
        radius: f64,
        fill: &str,
        edge: Colour,
        width: f64,
    ) {
        let _ = writeln!(
            self.body,
            "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{radius}\" fill=\"{fill}\" stroke=\"{}\" stroke-width=\"{width}\"/>",
            hex(edge.light)
        );
    }

    /// Words with their line at `at`.
    pub(super) fn text(
        &mut self,
        text: &str,
        (x, y): (f64, f64),
        size: f64,
        anchor: Anchor,
        colour: Colour,
    ) {
        let anchor = match anchor {
            Anchor::Start => "",
            Anchor::Middle => " text-anchor=\"middle\"",
            Anchor::End => " text-anchor=\"end\"",
        };
        let _ = writeln!(
            self.body,
            "<text x=\"{x:.1}\" y=\"{y:.1}\" font-size=\"{size}\"{anchor} fill=\"{}\">{}</text>",
            hex(colour.light),
            escaped(text)
        );
    }
}

/// About how wide words of a size are in the font of the PNG, on the safe side \[px\].
pub(super) fn text_width(text: &str, size: f64) -> f64 {
    let em = |c: char| match c {
        'i' | 'j' | 'l' | '.' | ',' | '\'' | '|' | ' ' | '\u{a0}' | ':' | ';' | '`' => 0.34,
        'm' | 'w' | 'M' | 'W' | '@' | '%' | '\u{2026}' => 0.98,
        't' | 'f' | 'r' | '-' | '(' | ')' | '[' | ']' => 0.42,
        'A'..='Z' | '=' | '#' | '&' => 0.76,
        '\u{2E80}'.. => 1.05,
        _ => 0.63,
    };
    size * text.chars().map(em).sum::<f64>()
}

/// Words broken into lines of at most `width` pixels; the last of `most` ends in an ellipsis where something is left out.
pub(super) fn wrapped(text: &str, size: f64, width: f64, most: usize) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    let words = text.split(' ').filter(|word| !word.is_empty());
    for word in words {
        let joined = match lines.last() {
            Some(line) => format!("{line} {word}"),
            None => word.to_owned(),
        };
        match lines.last_mut() {
            Some(line) if text_width(&joined, size) <= width => *line = joined,
            _ => lines.push(word.to_owned()),
        }
        if lines.len() > most {
            lines.pop();
            if let Some(line) = lines.last_mut() {
                line.push_str(" \u{2026}");
            }
            break;
        }
    }
    for line in &mut lines {
        // a word that is longer than a line
        if text_width(line, size) > width {
            let mut cut = String::new();
            for c in line.chars() {
                if text_width(&cut, size) > width - 2.0 * size {
                    break;
                }
                cut.push(c);
            }
            cut.push('\u{2026}');
            *line = cut;
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_are_broken_between_words_and_cut_at_the_end() {
        let text = "the elbow touches the shelf and pushes the can over its edge";
        let lines = wrapped(text, 12.0, 150.0, 9);
        assert!(lines.len() > 2 && lines.join(" ") == text, "{lines:?}");
        assert!(lines.iter().all(|line| text_width(line, 12.0) <= 150.0));
        let cut = wrapped(text, 12.0, 150.0, 2);
        assert_eq!(cut.len(), 2);
        assert!(cut[1].ends_with('\u{2026}'));
        let long = wrapped(&"x".repeat(5000), 12.0, 150.0, 2);
        assert!(long.len() == 1 && text_width(&long[0], 12.0) <= 150.0);
        assert!(wrapped("", 12.0, 150.0, 2).is_empty());
    }
}
