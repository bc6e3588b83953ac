//! The storyboard of a motion task: six moments of the run in one picture, for places that show no page.

mod camera;
mod face;
mod moment;
mod order;
mod stage;
mod svg;

use nalgebra::{Point3, Vector3};

use self::camera::Camera;
use self::face::{Face, Rgb};
use self::moment::{Moment, moments};
use self::stage::Stage;
use self::svg::{Anchor, Svg, escaped, hex, text_width, wrapped};
use crate::grade::TaskGrade;
use crate::graded::TaskRun;
use crate::report::number::significant;
use crate::report::theme::{
    BLUE, Colour, FRAME, GREEN, GRID, INK, MUTED, PAPER, PURPLE, RED, VERMILLION,
};
use crate::report::visible::{shortened, visible};

/// Width of the picture, its margin, and the room between two panels \[px\].
const WIDTH: f64 = 1000.0;
const MARGIN: f64 = 20.0;
const GAP: f64 = 16.0;
const COLUMNS: usize = 3;
const PANEL: f64 = (WIDTH - 2.0 * MARGIN - 2.0 * GAP) / COLUMNS as f64;
/// Height of the view in a panel lies between these \[px\].
const LOWEST: f64 = 200.0;
const HIGHEST: f64 = 340.0;
/// Air around what is shown \[px\].
const AIR: f64 = 16.0;
/// Size of captions and height of their lines \[px\].
const WORDS: f64 = 12.0;
const LINE: f64 = 16.0;
/// Lines of a caption.
const MOST_LINES: usize = 5;
/// What is farther from the middle of the start than this many times its size is not shown.
const FAR: f64 = 1.5;
/// Goals and paths that are drawn.
const MOST_GOALS: usize = 50;
const MOST_PATHS: usize = 20;
/// Points of a line nearer to each other than this are one \[px\].
const FINE: f64 = 0.8;
/// Where no light falls on the ground.
const SHADOW: Rgb = (228, 231, 236);
const FONT: &str = "'DejaVu Sans',system-ui,'Segoe UI',Roboto,'Helvetica Neue',Arial,sans-serif";

/// The storyboard of `run` with what its grade says of it, as an SVG of its own. The same run and grade give the same bytes.
///
/// A run without a tick has one panel: the arm as its file has it.
pub fn storyboard(run: &TaskRun, grade: &TaskGrade) -> String {
    let stage = Stage::of(run);
    let camera = Camera::of(run);
    let mut panels: Vec<Panel> = moments(run, grade)
        .into_iter()
        .map(|moment| Panel::of(&stage, Some(moment.tick), moment))
        .collect();
    if panels.is_empty() {
        let words = grade
            .stopped
            .as_ref()
            .map(|stopped| format!("stopped before the first tick: {}", stopped.message));
        let words = words.unwrap_or_else(|| "stopped before the first tick".to_owned());
        let moment = Moment {
            tick: 0,
            words: vec![words],
            bad: true,
            touch_m: None,
        };
        panels.push(Panel::of(&stage, None, moment));
    }
    let scenery = Scenery::of(run, &stage);
    let board = Board {
        view: View::around(&camera, &panels, &scenery),
        run,
        grade,
        camera,
        panels,
        scenery,
    };
    board.draw()
}

/// One moment with all that is seen at it.
struct Panel {
    moment: Moment,
    faces: Vec<Face>,
    joints: Vec<Point3<f64>>,
    tcp: Point3<f64>,
}

impl Panel {
    fn of(stage: &Stage<'_>, tick: Option<usize>, moment: Moment) -> Self {
        let (joints, tcp) = stage.joints(tick);
        Self {
            faces: stage.faces(tick),
            moment,
            joints,
            tcp,
        }
    }
}

/// What is the same in all panels, in the world.
struct Scenery {
    trail: Vec<Point3<f64>>,
    reference: Vec<Point3<f64>>,
    paths: Vec<Vec<Point3<f64>>>,
    goals: Vec<Point3<f64>>,
}

impl Scenery {
    fn of(run: &TaskRun, stage: &Stage<'_>) -> Self {
        let world_from_told = stage.world_from_told();
        let placed = |p: &[f64; 3]| world_from_told * Point3::from(*p);
        let reference = run.reference_tcp.iter().flat_map(|path| &path.points_m);
        let paths = run.paths.iter().take(MOST_PATHS);
        let goals = run.goals.iter().take(MOST_GOALS);
        Self {
            trail: (0..run.trace.len())
                .map(|tick| world_from_told * Point3::from(run.trace.tcp_position(tick)))
                .collect(),
            reference: reference.map(placed).collect(),
            paths: paths
                .map(|path| path.points_m.iter().map(placed).collect())
                .collect(),
            goals: goals.map(|goal| placed(&goal.position_m)).collect(),
        }
    }
}

fn finite(p: &Point3<f64>) -> bool {
    p.iter().all(|x| x.abs() < 1e6)
}

/// From metres to the pixels of a panel, the same in all panels.
#[derive(Debug, Clone, Copy)]
struct View {
    /// Middle of what is shown, in the plane of the picture \[m\].
    middle: (f64, f64),
    pixels_per_m: f64,
    height: f64,
    /// Size of what is shown \[m\].
    size_m: f64,
    /// Least and greatest corner of what is shown, in the world \[m\].
    low: Point3<f64>,
    high: Point3<f64>,
}

impl View {
    fn around(camera: &Camera, panels: &[Panel], scenery: &Scenery) -> Self {
        let of_panel = |panel: &Panel| {
            let corners = panel.faces.iter().flat_map(|face| face.corners.clone());
            let joints = panel.joints.iter().chain([&panel.tcp]).copied();
            corners.chain(joints).collect::<Vec<_>>()
        };
        let lines = scenery.paths.iter().flatten();
        let mut kept: Vec<Point3<f64>> = panels.first().map(of_panel).unwrap_or_default();
        kept.extend(scenery.goals.iter().chain(&scenery.reference).chain(lines));
        kept.retain(finite);
        let bounds = |points: &[Point3<f64>]| {
            let first = points.first().copied().unwrap_or_else(Point3::origin);
            let fold = |(low, high): (Point3<f64>, Point3<f64>), p: &Point3<f64>| {
                (low.inf(p), high.sup(p))
            };
            points.iter().fold((first, first), fold)
        };
        let (low, high) = bounds(&kept);
        let (centre, reach) = (nalgebra::center(&low, &high), FAR * (high - low).norm());
        let near = |p: &Point3<f64>| (p - centre).norm() <= reach.max(0.5);
        let later = panels.iter().skip(1).flat_map(of_panel);
        kept.extend(later.chain(scenery.trail.iter().copied()).filter(near));
        let (low, high) = bounds(&kept);
        let flat: Vec<(f64, f64)> = kept.iter().map(|p| camera.flat(p)).collect();
        let span = |of: fn(&(f64, f64)) -> f64| {
            let values = flat.iter().map(of);
            let least = values.clone().fold(f64::INFINITY, f64::min);
            let greatest = values.fold(f64::NEG_INFINITY, f64::max);
            if least <= greatest {
                (0.5 * (least + greatest), (greatest - least).max(0.02))
            } else {
                (0.0, 1.0)
            }
        };
        let ((x, w), (y, h)) = (span(|p| p.0), span(|p| p.1));
        let across = PANEL - 2.0 * AIR;
        let pixels_per_m = (across / w).min((HIGHEST - 2.0 * AIR) / h);
        Self {
            middle: (x, y),
            pixels_per_m,
            height: (h * pixels_per_m + 2.0 * AIR)
                .clamp(LOWEST, HIGHEST)
                .round(),
            size_m: (high - low).norm().max(0.02),
            low,
            high,
        }
    }

    /// Where a point of the picture's plane is in a panel whose upper left corner is `corner`.
    fn at(&self, (x, y): (f64, f64), corner: (f64, f64)) -> (f64, f64) {
        let px = corner.0 + 0.5 * PANEL + (x - self.middle.0) * self.pixels_per_m;
        let py = corner.1 + 0.5 * self.height - (y - self.middle.1) * self.pixels_per_m;
        (px.clamp(-5e3, 5e3), py.clamp(-5e3, 5e3))
    }

    /// Height of the ground: zero, unless everything is far above it or something is below.
    fn floor_m(&self) -> f64 {
        let low = self.low.z;
        if low >= -0.02 * self.size_m && low <= 0.3 * self.size_m {
            low.min(0.0)
        } else {
            low
        }
    }
}

/// The picture.
struct Board<'a> {
    run: &'a TaskRun,
    grade: &'a TaskGrade,
    camera: Camera,
    view: View,
    panels: Vec<Panel>,
    scenery: Scenery,
}

impl Board<'_> {
    fn draw(&self) -> String {
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

    /// The time of a panel \[s\], to the tick.
    fn time(&self, panel: &Panel) -> String {
        seconds(panel.moment.tick as f64 * self.run.trace.step_s)
    }

    fn panel(&self, svg: &mut Svg, index: usize, panel: &Panel, corner: (f64, f64)) {
        let (x, y) = corner;
        let h = self.view.height;
        svg.raw(&format!(
            "<clipPath id=\"p{index}\"><rect x=\"{x:.1}\" y=\"{y:.1}\" width=\"{PANEL:.1}\" height=\"{h}\" rx=\"5\"/></clipPath>\n\
             <g clip-path=\"url(#p{index})\">\n<rect x=\"{x:.1}\" y=\"{y:.1}\" width=\"{PANEL:.1}\" height=\"{h}\" fill=\"#F8F9FB\"/>\n"
        ));
        self.ground(svg, panel, corner);
        self.solids(svg, panel, corner);
        self.marks(svg, panel, corner);
        svg.raw("</g>\n");
        let edge = if panel.moment.bad { VERMILLION } else { FRAME };
        svg.raw(&format!(
            "<rect x=\"{x:.1}\" y=\"{y:.1}\" width=\"{PANEL:.1}\" height=\"{h}\" rx=\"5\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.2\"/>\n",
            hex(edge.light)
        ));
    }

    /// The grid, and the shadows of a light straight above.
    fn ground(&self, svg: &mut Svg, panel: &Panel, corner: (f64, f64)) {
        let floor = self.view.floor_m();
        let at = |x: f64, y: f64| {
            let p = Point3::new(x, y, floor);
            self.view.at(self.camera.flat(&p), corner)
        };
        let fall = panel.faces.iter().filter(|face| face.normal.z > 1e-6);
        let shadows: Vec<Vec<_>> = fall
            .map(|face| face.corners.iter().map(|p| at(p.x, p.y)).collect())
            .collect();
        svg.areas(&shadows, SHADOW);
        let step = round_step(self.view.size_m / 9.0);
        let cells = |low: f64, high: f64| {
            let air = 0.12 * self.view.size_m;
            let from = ((low - air) / step).floor() as i64;
            let to = ((high + air) / step).ceil() as i64;
            (from, to.min(from + 60))
        };
        let (x0, x1) = cells(self.view.low.x, self.view.high.x);
        let (y0, y1) = cells(self.view.low.y, self.view.high.y);
        let m = |cell: i64| cell as f64 * step;
        let mut lines: Vec<Vec<(f64, f64)>> = Vec::new();
        lines.extend((x0..=x1).map(|x| vec![at(m(x), m(y0)), at(m(x), m(y1))]));
        lines.extend((y0..=y1).map(|y| vec![at(m(x0), m(y)), at(m(x1), m(y))]));
        svg.lines(&lines, darker(GRID.light, 0.93), 0.8, "");
    }

    /// The solids, from back to front.
    fn solids(&self, svg: &mut Svg, panel: &Panel, corner: (f64, f64)) {
        let toward = &self.camera.toward;
        // what looks away is behind what looks here; a surface with holes is seen from inside, too
        let seen = |face: &&Face| !face.convex || face.normal.dot(toward) > 1e-9;
        let faces: Vec<Face> = panel.faces.iter().filter(seen).cloned().collect();
        let painted = order::back_to_front(faces, toward, 1e-7 * self.view.size_m);
        let mut areas: Vec<Vec<(f64, f64)>> = Vec::new();
        let mut edges: Vec<Vec<(f64, f64)>> = Vec::new();
        let mut of = None;
        for face in &painted {
            let colour = self.shaded(face);
            if of != Some((colour, face.solid)) {
                flush(svg, &mut areas, &mut edges, of.map(|(colour, _)| colour));
                of = Some((colour, face.solid));
            }
            let points: Vec<_> = face
                .corners
                .iter()
                .map(|p| self.view.at(self.camera.flat(p), corner))
                .collect();
            // the edges of what is too narrow would cover it
            if narrowest(&points) > 2.5 {
                let drawn = (0..points.len()).filter(|i| face.edges[*i]);
                edges.extend(drawn.map(|i| vec![points[i], points[(i + 1) % points.len()]]));
            }
            areas.push(points);
        }
        flush(svg, &mut areas, &mut edges, of.map(|(colour, _)| colour));
    }

    /// The colour of a face under a light from above, before and left of the viewer.
    fn shaded(&self, face: &Face) -> Rgb {
        let camera = &self.camera;
        let light = Vector3::z() * 0.75 + camera.toward * 0.55 - camera.right * 0.35;
        let normal = if face.normal.dot(&camera.toward) < 0.0 {
            -face.normal
        } else {
            face.normal
        };
        let bright = normal.dot(&light.normalize()).max(0.0);
        // few steps, so that neighbours of nearly one colour are written as one
        darker(face.colour, 0.56 + ((0.46 * bright) * 40.0).round() / 40.0)
    }

    /// Paths, goals, joints, the TCP, and where two touch, in front of all.
    fn marks(&self, svg: &mut Svg, panel: &Panel, corner: (f64, f64)) {
        let flat = |p: &Point3<f64>| self.view.at(self.camera.flat(p), corner);
        let line = |points: &[Point3<f64>]| thin(points.iter().map(|p| finite(p).then(|| flat(p))));
        let paths: Vec<_> = self.scenery.paths.iter().flat_map(|p| line(p)).collect();
        svg.lines(&paths, GREEN.light, 1.5, "6 4");
        let reference = line(&self.scenery.reference);
        svg.lines(&reference, PURPLE.light, 1.5, "5 4");
        for (i, goal) in self.scenery.goals.iter().enumerate() {
            if !finite(goal) {
                continue;
            }
            let at = flat(goal);
            svg.disc(at, 5.0, "#FFFFFF", GREEN, 2.0);
            svg.disc(at, 1.2, "#FFFFFF", GREEN, 1.6);
            if self.scenery.goals.len() > 1 && i < 9 {
                let beside = (at.0 + 9.0, at.1 + 4.0);
                svg.text(&(i + 1).to_string(), beside, 11.0, Anchor::Start, GREEN);
            }
        }
        let until = (panel.moment.tick + 1).min(self.scenery.trail.len());
        let trail = line(&self.scenery.trail[..until]);
        svg.lines(&trail, (255, 255, 255), 3.4, "");
        svg.lines(&trail, BLUE.light, 2.0, "");
        if panel.joints.len() <= 12 {
            for joint in panel.joints.iter().filter(|p| finite(p)) {
                svg.disc(flat(joint), 3.0, "#FFFFFF", INK, 1.4);
            }
        }
        if finite(&panel.tcp) {
            svg.disc(flat(&panel.tcp), 3.6, &hex(BLUE.light), PAPER, 1.2);
        }
        if let Some(touch) = panel.moment.touch_m.map(Point3::from).filter(finite) {
            let (x, y) = flat(&touch);
            svg.disc((x, y), 8.0, "none", RED, 2.0);
            let cross = [
                vec![(x - 11.0, y), (x - 6.0, y)],
                vec![(x + 6.0, y), (x + 11.0, y)],
                vec![(x, y - 11.0), (x, y - 6.0)],
                vec![(x, y + 6.0), (x, y + 11.0)],
            ];
            svg.lines(&cross, RED.light, 2.0, "");
        }
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
        let fragment = format!("#task={}&t={time}", in_fragment(&self.run.task));
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
        let step = significant(round_step(self.view.size_m / 9.0), 3);
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

fn flush(
    svg: &mut Svg,
    areas: &mut Vec<Vec<(f64, f64)>>,
    edges: &mut Vec<Vec<(f64, f64)>>,
    colour: Option<Rgb>,
) {
    if let Some(colour) = colour {
        svg.areas(areas, colour);
        svg.lines(edges, darker(colour, 0.62), 0.6, "");
    }
    areas.clear();
    edges.clear();
}

/// The lines through points, broken where one is none, without points that show nothing new.
fn thin(points: impl Iterator<Item = Option<(f64, f64)>>) -> Vec<Vec<(f64, f64)>> {
    let mut lines: Vec<Vec<(f64, f64)>> = vec![Vec::new()];
    let mut left_out = None;
    for point in points {
        let Some((x, y)) = point else {
            lines.push(Vec::new());
            left_out = None;
            continue;
        };
        let Some(line) = lines.last_mut() else {
            continue;
        };
        let near = line
            .last()
            .is_some_and(|(a, b): &(f64, f64)| (a - x).abs().max((b - y).abs()) < FINE);
        if near {
            left_out = Some((x, y));
        } else {
            line.push((x, y));
            left_out = None;
        }
    }
    if let Some(line) = lines.last_mut() {
        line.extend(left_out);
    }
    lines
}

/// Twice the area over the perimeter: about how wide a convex area is where it is narrow \[px\].
fn narrowest(points: &[(f64, f64)]) -> f64 {
    let (mut area, mut around) = (0.0, 0.0);
    for (i, a) in points.iter().enumerate() {
        let b = points[(i + 1) % points.len()];
        area += a.0 * b.1 - b.0 * a.1;
        let (dx, dy) = (b.0 - a.0, b.1 - a.1);
        around += (dx * dx + dy * dy).sqrt();
    }
    if around > 0.0 {
        area.abs() / around
    } else {
        0.0
    }
}

fn darker((r, g, b): Rgb, by: f64) -> Rgb {
    let part = |c: u8| (f64::from(c) * by).round().clamp(0.0, 255.0) as u8;
    (part(r), part(g), part(b))
}

/// The next of 1, 2, 5, 10 … times a power of ten that is not below `step`.
fn round_step(step: f64) -> f64 {
    let unit = libm::pow(10.0, libm::floor(libm::log10(step.max(1e-6))));
    let times = [1.0, 2.0, 5.0]
        .into_iter()
        .find(|times| times * unit >= step);
    times.unwrap_or(10.0) * unit
}

/// Seconds to the millisecond, without trailing zeros.
fn seconds(t_s: f64) -> String {
    let text = format!("{t_s:.3}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// A task's name in the fragment of an address.
fn in_fragment(name: &str) -> String {
    let mut safe = String::new();
    for byte in name.bytes() {
        if byte.is_ascii_alphanumeric() || b"-._~".contains(&byte) {
            safe.push(char::from(byte));
        } else {
            safe.push_str(&format!("%{byte:02X}"));
        }
    }
    safe
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::sample;

    /// What must hold of every storyboard, whatever the run.
    fn sound(run: &TaskRun) -> String {
        let graded = sample::graded();
        let grade = graded.grade.tasks.iter().find(|task| task.name == "move");
        let grade = grade.expect("the motion task");
        let svg = storyboard(run, grade);
        assert_eq!(svg, storyboard(run, grade), "the same bytes");
        assert!(svg.starts_with("<svg ") && svg.ends_with("</svg>\n"));
        assert!(
            !svg.contains("NaN") && !svg.contains("inf "),
            "numbers only"
        );
        assert!(svg.len() < 900_000, "{} bytes", svg.len());
        svg
    }

    fn panels(svg: &str) -> usize {
        svg.matches("<clipPath").count()
    }

    #[test]
    fn a_run_is_shown_in_six_panels_with_their_links() {
        let svg = sound(&sample::task_run());
        assert_eq!(panels(&svg), 6);
        assert!(svg.contains("href=\"../report.html#task=move&amp;t=8\""));
        assert!(svg.contains("Goal 1 reached"), "its captions");
        assert!(svg.contains("reference"), "its legend");
    }

    #[test]
    fn runs_of_no_tick_of_one_and_of_many_joints_are_shown() {
        assert_eq!(panels(&sound(&sample::chain(2, 0, |_, _| 0.0))), 1);
        assert_eq!(panels(&sound(&sample::stopped_after(0))), 1);
        assert_eq!(panels(&sound(&sample::stopped_after(3))), 4);
        let wave =
            |tick: u64, joint: usize| 0.2 * libm::sin(0.004 * tick as f64 + 0.5 * joint as f64);
        assert_eq!(panels(&sound(&sample::chain(25, 1000, wave))), 6);
    }

    #[test]
    fn positions_that_are_no_numbers_are_shown_as_they_last_were() {
        let wild = |tick: u64, _: usize| match tick {
            0..400 => 0.001 * tick as f64,
            400..600 => f64::NAN,
            _ => f64::INFINITY,
        };
        sound(&sample::chain(3, 1000, wild));
        sound(&sample::chain(3, 1000, |tick, _| {
            libm::pow(10.0, tick as f64 * 0.3)
        }));
    }

    #[test]
    fn hostile_names_are_words_in_the_picture() {
        let mut graded = sample::graded();
        let grade = &mut graded.grade.tasks[3];
        let hostile = "</text><script>alert(1)</script>\u{0}\u{1b}[2J\u{202E}\"'&".repeat(30);
        grade.title.clone_from(&hostile);
        for check in &mut grade.checks {
            check.title.clone_from(&hostile);
        }
        let mut run = sample::task_run();
        run.task = "a b\"<".to_owned();
        let svg = storyboard(&run, grade);
        assert!(!svg.contains("<script") && !svg.contains(['\0', '\u{1b}', '\u{202E}']));
        assert!(svg.contains("#task=a%20b%22%3C&amp;t="));
        #[cfg(not(target_family = "wasm"))]
        crate::report::png::png(&svg).expect("a picture");
    }
}
