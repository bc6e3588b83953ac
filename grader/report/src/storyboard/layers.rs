//! One panel from back to front: the ground with its grid and shadows, the solids, and the marks before them.

use nalgebra::{Point3, Vector3};

use super::board::Board;
use super::face::Face;
use super::scenery::finite;
use super::svg::{Anchor, Svg};
use super::{PANEL, Panel, order};
use crate::palette::{
    BLUE, FRAME, GREEN, GRID, INK, PAPER, PURPLE, RED, Rgb, SHADOW, VERMILLION, hex,
};

/// Points of a line nearer to each other than this are one \[px\].
const FINE: f64 = 0.8;

impl Board<'_> {
    /// A panel whose clip has the name `clip`.
    pub(super) fn panel(&self, svg: &mut Svg, clip: &str, panel: &Panel, corner: (f64, f64)) {
        let (x, y) = corner;
        let h = self.view.height;
        svg.raw(&format!(
            "<clipPath id=\"{clip}\"><rect x=\"{x:.1}\" y=\"{y:.1}\" width=\"{PANEL:.1}\" height=\"{h}\" rx=\"5\"/></clipPath>\n\
             <g clip-path=\"url(#{clip})\">\n<rect x=\"{x:.1}\" y=\"{y:.1}\" width=\"{PANEL:.1}\" height=\"{h}\" fill=\"#F8F9FB\"/>\n"
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
        let step = self.view.grid_m();
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
        let aims: Vec<_> = panel.aims.iter().flat_map(|aim| line(aim)).collect();
        svg.lines(&aims, GREEN.light, 2.0, "6 4");
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
