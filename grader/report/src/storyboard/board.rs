//! The whole picture: title, panels in rows, a caption with its link under each, and the legend.

use kinemark_sim::text::number::trimmed;

use super::camera::Camera;
use super::scenery::Scenery;
use super::svg::{Anchor, Svg, escaped, text_width, wrapped};
use super::view::View;
use super::{COLUMNS, Chapter, GAP, MARGIN, PANEL, Panel, WIDTH};
use crate::moment::{fragment, of_task};
use crate::palette::{BLUE, Colour, GREEN, INK, MUTED, PAPER, PURPLE, RED, VERMILLION, hex};
use crate::visible::shortened;
use kinemark_grader::record::grade::TaskGrade;
use kinemark_grader::record::graded::TaskRun;
use kinemark_grader::record::quantity::points;
use kinemark_sim::text::number::typeset;

/// Size of captions and height of their lines \[px\].
const WORDS: f64 = 12.0;
const LINE: f64 = 16.0;
/// Lines of a sentence of a caption.
const MOST_LINES: usize = 9;
/// Width of the words beside a single panel \[px\].
const BESIDE: f64 = 400.0;
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
        let captions: Vec<Vec<String>> = self
            .panels
            .iter()
            .map(|panel| caption(panel, self.room()))
            .collect();
        // each row is as high as its longest caption; that of a single panel stands beside it
        let mut tops = vec![46.0];
        for row in captions.chunks(COLUMNS) {
            let lines = row.iter().map(Vec::len).max().unwrap_or(0);
            let words = 40.0 + LINE * lines as f64;
            let top = tops.last().copied().unwrap_or_default();
            tops.push(if self.is_single() {
                top + self.view.height.max(words) + 12.0
            } else {
                top + self.view.height + words
            });
        }
        let height = (tops.last().copied().unwrap_or_default() + 34.0).round();
        let width = self.width();
        let mut svg = Svg::default();
        let title = format!(
            "{}: {}",
            shortened(&self.grade.name, 40),
            shortened(&self.grade.title, 70)
        );
        svg.raw(&format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" role=\"img\" width=\"{width}\" height=\"{height}\" \
             viewBox=\"0 0 {width} {height}\" font-family=\"{FONT}\">\n<title>Storyboard of {}</title>\n<desc>{}</desc>\n\
             <rect width=\"{width}\" height=\"{height}\" fill=\"{}\"/>\n",
            escaped(&title),
            escaped(&self.description()),
            hex(PAPER.light)
        ));
        let earned = format!(
            "{} of {} points",
            points(self.grade.points),
            points(self.grade.max_points)
        );
        let right = (width - MARGIN, 30.0);
        svg.text(&earned, right, 14.0, Anchor::End, MUTED);
        let room = width - 2.0 * MARGIN - text_width(&earned, 14.0) - GAP;
        let title = wrapped(&title, 17.0, room, 1).concat();
        svg.text(&title, (MARGIN, 30.0), 17.0, Anchor::Start, INK);
        // all links in full, or all of them shortened to their time
        let is_roomy = self.panels.iter().all(|panel| {
            let room = self.room() - 40.0 - text_width(&self.shown_time(panel), 13.5);
            text_width(&self.fragment(panel), 11.0) <= room
        });
        for (i, (panel, caption)) in self.panels.iter().zip(&captions).enumerate() {
            let left = MARGIN + (PANEL + GAP) * (i % COLUMNS) as f64;
            let top = tops[i / COLUMNS];
            self.panel(&mut svg, &format!("p{i}"), panel, (left, top));
            let below = (left, top + self.view.height + 19.0);
            let corner = if self.is_single() {
                (left + PANEL + GAP, top + 19.0)
            } else {
                below
            };
            self.words(&mut svg, i, panel, caption, corner, is_roomy);
        }
        self.legend(&mut svg, height - 18.0);
        svg.raw("</svg>\n");
        svg.body
    }

    /// The panels without their words, each a picture of its own.
    pub(super) fn chapters(&self, prefix: &str) -> Vec<Chapter> {
        let chapter = |(i, panel): (usize, &Panel)| {
            let mut svg = Svg::default();
            svg.raw(&format!(
                "<svg viewBox=\"-1 -1 {:.0} {:.0}\" aria-hidden=\"true\" focusable=\"false\">\n",
                PANEL + 2.0,
                self.view.height + 2.0
            ));
            self.panel(&mut svg, &format!("{prefix}p{i}"), panel, (0.0, 0.0));
            svg.raw("</svg>\n");
            Chapter {
                time_s: self.time_s(panel),
                words: panel
                    .moment
                    .words
                    .iter()
                    .map(|words| sentence(words))
                    .collect(),
                is_bad: panel.moment.bad,
                svg: svg.body,
            }
        };
        self.panels.iter().enumerate().map(chapter).collect()
    }

    /// Whether there is one panel, of a run that has no second moment: its words stand beside it.
    fn is_single(&self) -> bool {
        self.panels.len() == 1
    }

    /// Width of a caption \[px\].
    fn room(&self) -> f64 {
        if self.is_single() { BESIDE } else { PANEL }
    }

    /// Width of the picture \[px\].
    fn width(&self) -> f64 {
        if self.is_single() {
            2.0 * MARGIN + PANEL + GAP + BESIDE
        } else {
            WIDTH
        }
    }

    /// The address of what a panel shows, after the page: of a run without a tick that of the task.
    fn fragment(&self, panel: &Panel) -> String {
        if self.run.trace.is_empty() {
            of_task(&self.run.task)
        } else {
            fragment(&self.run.task, self.time_s(panel))
        }
    }

    fn shown_time(&self, panel: &Panel) -> String {
        if self.run.trace.is_empty() {
            "not run".to_owned()
        } else {
            format!("{}\u{a0}s", self.time(panel))
        }
    }

    /// All captions, for a screen reader.
    fn description(&self) -> String {
        let captions = self.panels.iter().map(|panel| {
            let words: Vec<String> = panel.moment.words.iter().map(|w| sentence(w)).collect();
            format!("{}: {}.", self.shown_time(panel), words.join("; "))
        });
        shortened(&captions.collect::<Vec<_>>().join(" "), 2000)
    }

    fn time_s(&self, panel: &Panel) -> f64 {
        panel.moment.tick as f64 * self.run.trace.step_s
    }

    /// The time of a panel \[s\], to the tick.
    fn time(&self, panel: &Panel) -> String {
        trimmed(self.time_s(panel), 4)
    }

    /// The caption of a panel from `corner` on: number, time, link, and what happened.
    fn words(
        &self,
        svg: &mut Svg,
        index: usize,
        panel: &Panel,
        caption: &[String],
        (left, top): (f64, f64),
        is_roomy: bool,
    ) {
        let badge = if panel.moment.bad { VERMILLION } else { MUTED };
        svg.disc((left + 9.0, top - 4.0), 8.5, &hex(badge.light), badge, 1.0);
        let number = (index + 1).to_string();
        svg.text(&number, (left + 9.0, top), 11.5, Anchor::Middle, PAPER);
        let time = self.shown_time(panel);
        svg.text(&time, (left + 25.0, top), 13.5, Anchor::Start, INK);
        let fragment = self.fragment(panel);
        svg.raw(&format!(
            "<a href=\"../report.html{}\">",
            escaped(&fragment)
        ));
        // the task is named above
        let shown = match fragment.split_once("&t=") {
            Some((_, time)) if !is_roomy => format!("t={time}"),
            None if !is_roomy => String::new(),
            _ => fragment,
        };
        let right = (left + self.room(), top);
        svg.text(&shown, right, 11.0, Anchor::End, BLUE);
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
        if self.panels.iter().any(|p| !p.aims.is_empty()) {
            entry(svg, "joint at its target", GREEN, "6 4", false);
        }
        if !self.scenery.goals.is_empty() {
            entry(svg, "goal", GREEN, "", true);
        }
        if self.panels.iter().any(|p| p.moment.touch_m.is_some()) {
            entry(svg, "contact", RED, "", true);
        }
        let step = typeset(self.view.grid_m(), 3);
        let words = format!("grid {step}\u{a0}m");
        svg.text(
            &words,
            (self.width() - MARGIN, y),
            WORDS,
            Anchor::End,
            MUTED,
        );
    }
}

/// What happened at a moment, in lines; each sentence begins a new one.
fn caption(panel: &Panel, room: f64) -> Vec<String> {
    let mut lines = Vec::new();
    for words in &panel.moment.words {
        lines.append(&mut wrapped(&sentence(words), WORDS, room, MOST_LINES));
    }
    lines
}

/// Words as a sentence of a caption: names are not marked as code, which a picture does not show; other code is quoted. Messages begin in
/// lower case where they follow something.
fn sentence(words: &str) -> String {
    let parts: Vec<&str> = words.split('`').collect();
    let mut plain = String::new();
    for (i, part) in parts.iter().enumerate() {
        let is_code = i % 2 == 1 && i + 1 < parts.len();
        let is_name = part.chars().any(char::is_alphanumeric);
        if is_code && !is_name {
            plain += &format!("\u{2018}{part}\u{2019}");
        } else {
            plain += part;
        }
    }
    let mut words = shortened(&plain, 600);
    if let Some(first) = words.get(..1).map(str::to_uppercase) {
        words.replace_range(..1, &first);
    }
    words
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_stand_plain_in_a_picture_and_signs_are_quoted() {
        assert_eq!(sentence("`can` touches `shelf`"), "Can touches shelf");
        assert_eq!(
            sentence("a `)` is missing"),
            "A \u{2018})\u{2019} is missing"
        );
        assert_eq!(sentence("one ` alone"), "One  alone");
        assert_eq!(sentence(""), "");
    }
}
