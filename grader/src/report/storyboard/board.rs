//! The whole picture: title, panels in rows, a caption with its link under each, and the legend.

use super::camera::Camera;
use super::scenery::Scenery;
use super::svg::{Anchor, Svg, escaped, hex, text_width, wrapped};
use super::view::View;
use super::{COLUMNS, GAP, MARGIN, PANEL, Panel, WIDTH};
use crate::grade::TaskGrade;
use crate::graded::TaskRun;
use crate::quantity::trimmed;
use crate::report::moment::fragment;
use crate::report::number::significant;
use crate::report::theme::{BLUE, Colour, GREEN, INK, MUTED, PAPER, PURPLE, RED, VERMILLION};
use crate::report::visible::{shortened, visible};

/// Size of captions and height of their lines \[px\].
const WORDS: f64 = 12.0;
const LINE: f64 = 16.0;
/// Lines of a caption.
const MOST_LINES: usize = 5;
const FONT: &str = "'DejaVu Sans',system-ui,'Segoe UI',Roboto,'Helvetica Neue',Arial,sans-serif";

/// The picture.
pub(super) struct Board<'a> {
    pub(super) run: &'a TaskRun,
    pub(super) grade: &'a TaskGrade,
    pub(super) camera: Camera,
    pub(super) view: View,
    pub(super) panels: Vec<Panel>,
    pub(super) scenery: Scenery,
}

impl Board<'_> {
    pub(super) fn draw(&self) -> String {
        let captions: Vec<Vec<String>> = self.panels.iter().map(caption).collect();
        // each row is as high as its longest caption
        let mut tops = vec![46.0];
        for row in captions.chunks(COLUMNS) {
            let lines = row.iter().map(Vec::len).max().unwrap_or(0);
            let top = tops.last().copied().unwrap_or_default();
            tops.push(top + self.view.height + 40.0 + LINE * lines as f64);
        }
        let height = (tops.last().copied().unwrap_or_default() + 34.0).round();
        let mut svg = Svg::default();
        let title = format!(
            "{}: {}",
            shortened(&self.grade.name, 40),
            shortened(&self.grade.title, 70)
        );
        svg.raw(&format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" role=\"img\" width=\"{WIDTH}\" height=\"{height}\" \
             viewBox=\"0 0 {WIDTH} {height}\" font-family=\"{FONT}\">\n<title>Storyboard of {}</title>\n<desc>{}</desc>\n\
             <rect width=\"{WIDTH}\" height=\"{height}\" fill=\"{}\"/>\n",
            escaped(&title),
            escaped(&self.description()),
            hex(PAPER.light)
        ));
        svg.text(&title, (MARGIN, 30.0), 17.0, Anchor::Start, INK);
        let points = format!(
            "{} of {} points",
            significant(self.grade.points, 4),
            significant(self.grade.max_points, 4)
        );
        let right = (WIDTH - MARGIN, 30.0);
        svg.text(&points, right, 14.0, Anchor::End, MUTED);
        for (i, (panel, caption)) in self.panels.iter().zip(&captions).enumerate() {
            let left = MARGIN + (PANEL + GAP) * (i % COLUMNS) as f64;
            let corner = (left, tops[i / COLUMNS]);
            self.panel(&mut svg, i, panel, corner);
            self.words(&mut svg, i, panel, caption, corner);
        }
        self.legend(&mut svg, height - 18.0);
        svg.raw("</svg>\n");
        svg.body
    }

    /// All captions, for a screen reader.
    fn description(&self) -> String {
        let told = self.panels.iter().map(|panel| {
            let words = panel.moment.words.join("; ");
            format!("{} s: {}.", self.time(panel), visible(&words))
        });
        shortened(&told.collect::<Vec<_>>().join(" "), 2000)
    }

    fn time_s(&self, panel: &Panel) -> f64 {
        panel.moment.tick as f64 * self.run.trace.step_s
    }

    /// The time of a panel \[s\], to the tick.
    fn time(&self, panel: &Panel) -> String {
        trimmed(self.time_s(panel), 4)
    }

    /// The caption of a panel: number, time, link, and what happened.
    fn words(
        &self,
        svg: &mut Svg,
        index: usize,
        panel: &Panel,
        caption: &[String],
        corner: (f64, f64),
    ) {
        let (left, top) = (corner.0, corner.1 + self.view.height + 19.0);
        let badge = if panel.moment.bad { VERMILLION } else { MUTED };
        svg.disc((left + 9.0, top - 4.0), 8.5, &hex(badge.light), badge, 1.0);
        let number = (index + 1).to_string();
        svg.text(&number, (left + 9.0, top), 11.5, Anchor::Middle, PAPER);
        let time = self.time(panel);
        let shown = format!("{time}\u{a0}s");
        svg.text(&shown, (left + 25.0, top), 13.5, Anchor::Start, INK);
        let fragment = fragment(&self.run.task, self.time_s(panel));
        svg.raw(&format!(
            "<a href=\"../report.html{}\">",
            escaped(&fragment)
        ));
        let right = (left + PANEL, top);
        let room = PANEL - 40.0 - text_width(&shown, 13.5);
        let fitting = wrapped(&fragment, 11.0, room, 1).join("");
        svg.text(&fitting, right, 11.0, Anchor::End, BLUE);
        svg.raw("</a>\n");
        for (i, line) in caption.iter().enumerate() {
            let at = (left, top + 5.0 + LINE * (i + 1) as f64);
            svg.text(line, at, WORDS, Anchor::Start, INK);
        }
    }

    fn legend(&self, svg: &mut Svg, y: f64) {
        let mut x = MARGIN;
        let mut entry = |svg: &mut Svg, words: &str, colour: Colour, dashes: &str, ring: bool| {
            let middle = (x + 10.0, y - 4.0);
            if ring {
                svg.disc(middle, 5.0, "none", colour, 2.0);
            } else {
                let line = vec![(x, y - 4.0), (x + 20.0, y - 4.0)];
                svg.lines(&[line], colour.light, 2.0, dashes);
            }
            svg.text(words, (x + 27.0, y), WORDS, Anchor::Start, MUTED);
            x += 27.0 + text_width(words, WORDS) + 18.0;
        };
        entry(svg, "TCP up to then", BLUE, "", false);
        if !self.scenery.reference.is_empty() {
            entry(svg, "reference", PURPLE, "5 4", false);
        }
        if !self.scenery.paths.is_empty() {
            entry(svg, "path asked for", GREEN, "6 4", false);
        }
        if !self.scenery.goals.is_empty() {
            entry(svg, "goal", GREEN, "", true);
        }
        if self.panels.iter().any(|p| p.moment.touch_m.is_some()) {
            entry(svg, "contact", RED, "", true);
        }
        let step = significant(self.view.grid_m(), 3);
        let words = format!("grid {step}\u{a0}m");
        svg.text(&words, (WIDTH - MARGIN, y), WORDS, Anchor::End, MUTED);
    }
}

/// What happened at a moment, in lines.
fn caption(panel: &Panel) -> Vec<String> {
    let words = visible(&panel.moment.words.join("; ")).into_owned();
    let mut words = shortened(&words, 400);
    // messages begin in lower case where they follow something
    if let Some(first) = words.get(..1).map(str::to_uppercase) {
        words.replace_range(..1, &first);
    }
    wrapped(&words, WORDS, PANEL, MOST_LINES)
}
