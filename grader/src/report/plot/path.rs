//! The TCP's path in the plane it moves in, to scale on both axes, with a close look at every goal.

use kinemark_sim::kinematics::FramePoses;
use nalgebra::Vector3;

use super::axis::{Axis, extent};
use super::canvas::{Align, Canvas, Entry, Swatch, WIDTH, picture};
use super::signals::stopped_s;
use super::thin::in_plane;
use crate::graded::{Goal, TaskRun};
use crate::quantity::seconds;
use crate::report::goal::distances_m;
use crate::report::number::with_unit;
use crate::report::theme::{
    BLUE, FRAME, GREEN, GRID, INK, MUTED, MUTED_DASHED, PURPLE_DASHED, RED, VERMILLION,
};
use crate::report::visible::shortened;

const LEFT: f64 = 68.0;
const RIGHT: f64 = WIDTH - 20.0;
/// The main view's height lies between these \[px\].
const LOWEST: f64 = 200.0;
const HIGHEST: f64 = 420.0;
/// A goal's circle smaller than this needs a close look \[px\].
const TOO_SMALL: f64 = 14.0;
/// Goals that get one.
const MOST_CLOSE_LOOKS: usize = 6;
/// Goals that are drawn.
const MOST_GOALS: usize = 200;

/// One axis of the plane: which coordinate, and whether it is drawn backwards.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Along {
    coordinate: usize,
    backwards: bool,
    /// Which way it points in the world, in a word.
    toward: &'static str,
}

impl Along {
    fn of(&self, p: &[f64; 3]) -> f64 {
        let value = p[self.coordinate];
        if self.backwards { -value } else { value }
    }

    fn label(&self, unit: &str) -> String {
        let letter = ["x", "y", "z"][self.coordinate];
        format!("{letter}{} [{unit}]", self.toward)
    }
}

/// The plane of a path.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Plane {
    across: Along,
    up: Along,
}

impl Plane {
    /// The two coordinates of greatest extent; the one that points up in the world is drawn upwards.
    fn of(points: &[[f64; 3]], upward: [f64; 3]) -> Self {
        let span =
            |c: usize| extent(points.iter().map(|p| p[c])).map_or(0.0, |(min, max)| max - min);
        let spans = [span(0), span(1), span(2)];
        let mut left_out = 2;
        for c in [1, 0] {
            // a coordinate that only trembles is not preferred to one that does not move at all
            if spans[c] < spans[left_out] - 1e-9 {
                left_out = c;
            }
        }
        let kept: Vec<usize> = (0..3).filter(|c| *c != left_out).collect();
        let (first, second) = (kept[0], kept[1]);
        let (across, up) = if upward[first].abs() > upward[second].abs().max(0.5) {
            (second, first)
        } else {
            (first, second)
        };
        let along = |coordinate: usize, backwards: bool| Along {
            coordinate,
            backwards,
            toward: match upward[coordinate] {
                u if u > 0.999 => ", up",
                u if u < -0.999 => ", down",
                u if u.abs() < 1e-3 => ", sideways",
                _ => "",
            },
        };
        Self {
            across: along(across, false),
            up: along(up, upward[up] < -0.5),
        }
    }

    fn flat(&self, p: &[f64; 3]) -> (f64, f64) {
        (self.across.of(p), self.up.of(p))
    }
}

/// A view of the plane: metres to pixels, the same scale both ways.
#[derive(Debug, Clone, Copy)]
struct View {
    x: Axis,
    y: Axis,
    left: f64,
    top: f64,
    pixels_per_m: f64,
}

impl View {
    fn width(&self) -> f64 {
        (self.x.max - self.x.min) * self.pixels_per_m
    }

    fn height(&self) -> f64 {
        (self.y.max - self.y.min) * self.pixels_per_m
    }

    fn at(&self, (x, y): (f64, f64)) -> (f64, f64) {
        let x = self.left + (x - self.x.min) * self.pixels_per_m;
        let y = self.top + (self.y.max - y) * self.pixels_per_m;
        (x.clamp(-5e3, 5e3), y.clamp(-5e3, 5e3))
    }

    /// Holds all points with air around them, in a frame of full width.
    fn around(points: &[(f64, f64)], top: f64) -> Self {
        let reach = |of: fn(&(f64, f64)) -> f64| {
            let (min, max) = extent(points.iter().map(of)).unwrap_or((-0.5, 0.5));
            (0.5 * (min + max), (1.12 * (max - min)).max(0.05))
        };
        let ((cx, w), (cy, h)) = (reach(|p| p.0), reach(|p| p.1));
        let pixels_per_m = ((RIGHT - LEFT) / w).min(HIGHEST / h);
        let half_width = 0.5 * (RIGHT - LEFT) / pixels_per_m;
        let half_height = 0.5 * (h * pixels_per_m).max(LOWEST) / pixels_per_m;
        Self {
            x: Axis::exact(cx - half_width, cx + half_width),
            y: Axis::exact(cy - half_height, cy + half_height),
            left: LEFT,
            top,
            pixels_per_m,
        }
    }

    /// Grid, ticks and frame; `scale` and `zero` turn metres into what the labels tell.
    fn ground(&self, canvas: &mut Canvas<'_>, zero: (f64, f64), scale: f64, plane: &Plane) {
        let (w, h) = (self.width(), self.height());
        let (right, bottom) = (self.left + w, self.top + h);
        let told = |axis: &Axis, zero: f64| {
            Axis::exact((axis.min - zero) * scale, (axis.max - zero) * scale)
        };
        let minus = |label: &str| match label.strip_prefix('\u{2212}') {
            Some(rest) => rest.to_owned(),
            None if label.trim_matches(['0', '.']).is_empty() => label.to_owned(),
            None => format!("\u{2212}{label}"),
        };
        for tick in told(&self.x, zero.0).ticks(((w / 66.0) as usize).max(4)) {
            let x = self.at((zero.0 + tick.value / scale, 0.0)).0;
            canvas.line(&[(x, self.top), (x, bottom)], GRID, 1.0);
            canvas.text(&tick.label, (x, bottom + 13.0), Align::Middle, MUTED);
        }
        for tick in told(&self.y, zero.1).ticks(((h / 44.0) as usize).max(4)) {
            let y = self.at((0.0, zero.1 + tick.value / scale)).1;
            let label = if plane.up.backwards {
                minus(&tick.label)
            } else {
                tick.label
            };
            canvas.line(&[(self.left, y), (right, y)], GRID, 1.0);
            canvas.text(&label, (self.left - 8.0, y), Align::End, MUTED);
        }
    }

    fn frame(&self, canvas: &mut Canvas<'_>) {
        let (right, bottom) = (self.left + self.width(), self.top + self.height());
        let corners = [
            (self.left, self.top),
            (right, self.top),
            (right, bottom),
            (self.left, bottom),
            (self.left, self.top),
        ];
        canvas.line(&corners, FRAME, 1.0);
    }

    /// The part of a segment that lies in the frame (Liang and Barsky, 1984), in pixels.
    fn clip(&self, a: (f64, f64), b: (f64, f64)) -> Option<[(f64, f64); 2]> {
        let (right, bottom) = (self.left + self.width(), self.top + self.height());
        let d = (b.0 - a.0, b.1 - a.1);
        let (mut from, mut to) = (0.0f64, 1.0f64);
        let edges = [
            (-d.0, a.0 - self.left),
            (d.0, right - a.0),
            (-d.1, a.1 - self.top),
            (d.1, bottom - a.1),
        ];
        for (p, q) in edges {
            if p == 0.0 {
                if q < 0.0 {
                    return None;
                }
            } else if p < 0.0 {
                from = from.max(q / p);
            } else {
                to = to.min(q / p);
            }
        }
        let on = |t: f64| (a.0 + t * d.0, a.1 + t * d.1);
        (from <= to).then(|| [on(from), on(to)])
    }

    /// The pieces of a path that lie in the frame, in pixels.
    fn pieces(&self, path: &[(f64, f64)]) -> Vec<Vec<(f64, f64)>> {
        let mut pieces: Vec<Vec<(f64, f64)>> = Vec::new();
        for pair in path.windows(2) {
            let [a, b] = [pair[0], pair[1]];
            if !(a.0.is_finite() && a.1.is_finite() && b.0.is_finite() && b.1.is_finite()) {
                continue;
            }
            let Some([from, to]) = self.clip(self.at(a), self.at(b)) else {
                continue;
            };
            let count = pieces.len();
            match pieces.last_mut() {
                Some(piece) if piece.last() == Some(&from) => piece.push(to),
                _ if count < MOST_PIECES => pieces.push(vec![from, to]),
                _ => {}
            }
        }
        pieces
    }
}

/// Pieces of one path in a view.
const MOST_PIECES: usize = 60;

/// Draws the picture; `None` where there is nothing to draw.
pub(super) fn path(run: &TaskRun) -> Option<(String, String)> {
    let positions = |tick: usize| {
        let p = run.trace.tcp_position(tick);
        [p.x, p.y, p.z]
    };
    let tcp: Vec<[f64; 3]> = (0..run.trace.len()).map(positions).collect();
    let reference = run
        .reference_tcp
        .as_ref()
        .map_or(&[][..], |path| &path.points_m);
    let goals = &run.goals[..run.goals.len().min(MOST_GOALS)];
    let places: Vec<[f64; 3]> = tcp
        .iter()
        .chain(reference)
        .copied()
        .chain(goals.iter().map(|goal| goal.position_m))
        .collect();
    if places.is_empty() {
        return None;
    }
    let plane = Plane::of(&places, upward(run));
    let flat = |points: &[[f64; 3]]| points.iter().map(|p| plane.flat(p)).collect::<Vec<_>>();
    let drawn = Drawn {
        run,
        plane,
        goals,
        tcp: flat(&tcp),
        reference: flat(reference),
        arms: arms(run).map(|arm| arm.map_or_else(Vec::new, |arm| flat(&arm))),
    };
    let title = format!("TCP path in the frame `{}`", shortened(&run.seen_from, 40));
    Some((drawn.draw(&title), title))
}

/// How far each axis of the frame points up in the world.
fn upward(run: &TaskRun) -> [f64; 3] {
    let Some(frame) = run.robot.frame(&run.seen_from) else {
        return [0.0, 0.0, 1.0];
    };
    let world_from_frame = FramePoses::new(&run.robot).world_from(frame);
    let up = world_from_frame.rotation.inverse() * Vector3::z();
    [up.x, up.y, up.z]
}

/// The arm from its first joint that moves to the TCP, at the first and the last tick.
fn arms(run: &TaskRun) -> [Option<Vec<[f64; 3]>>; 2] {
    let robot = &run.robot;
    let tcp = robot.tcp();
    // links from the TCP's down to the first that moves
    let mut links = Vec::new();
    let mut link = tcp.link;
    while let Some(joint) = robot.joints().iter().find(|joint| joint.child == link) {
        links.push(link);
        link = joint.parent;
    }
    let seen_from = robot.frame(&run.seen_from);
    let mut poses = FramePoses::new(robot);
    let mut at = |tick: usize| {
        let q = run.trace.q.at(tick);
        if !q.iter().all(|q| q.is_finite()) {
            return None;
        }
        poses.update(robot, q);
        let world_from_frame = seen_from.map(|frame| poses.world_from(frame));
        let place = |frame| {
            let pose = poses.world_from(frame);
            let pose =
                world_from_frame.map_or(pose, |world_from_frame| world_from_frame.inv_mul(&pose));
            let p = pose.translation.vector;
            [p.x, p.y, p.z]
        };
        let chain = links.iter().rev().map(|link| &robot.frames()[*link]);
        Some(chain.chain([tcp]).map(place).collect())
    };
    match run.trace.len() {
        0 => [None, None],
        len => [at(0), at(len - 1)],
    }
}

/// Everything the picture shows, in its plane.
struct Drawn<'a> {
    run: &'a TaskRun,
    plane: Plane,
    goals: &'a [Goal],
    tcp: Vec<(f64, f64)>,
    reference: Vec<(f64, f64)>,
    arms: [Vec<(f64, f64)>; 2],
}

impl Drawn<'_> {
    fn draw(&self, title: &str) -> String {
        let legend = self.legend();
        let mut top = 0.0;
        picture("", 1.0, |canvas| top = canvas.legend(&legend, 20.0, 50.0));
        let view = View::around(&self.extremes(), top + 21.0);
        let close: Vec<&Goal> = self
            .goals
            .iter()
            .filter(|goal| goal.zero_m * view.pixels_per_m < TOO_SMALL && goal.zero_m > 0.0)
            .take(MOST_CLOSE_LOOKS)
            .collect();
        let columns = close.len().clamp(1, 3);
        let below = view.top + view.height() + if close.is_empty() { 42.0 } else { 56.0 };
        let rows = close.len().div_ceil(columns) as f64;
        let height = below + rows * CLOSE_PITCH;
        picture(title, height, |canvas| {
            canvas.title(title, (20.0, 24.0));
            canvas.legend(&legend, 20.0, 50.0);
            canvas.heading(&self.plane.up.label("m"), (20.0, top + 8.0));
            self.main(canvas, &view);
            let middle = 0.5 * (LEFT + RIGHT);
            let across = self.plane.across.label("m");
            canvas.text(
                &across,
                (middle, view.top + view.height() + 31.0),
                Align::Middle,
                MUTED,
            );
            let pitch = (WIDTH - 40.0) / columns as f64;
            for (i, goal) in close.iter().enumerate() {
                let left = 20.0 + pitch * (i % columns) as f64;
                let number = self
                    .goals
                    .iter()
                    .position(|g| std::ptr::eq(g, *goal))
                    .unwrap_or(i)
                    + 1;
                self.close_look(
                    canvas,
                    goal,
                    number,
                    (left, below + CLOSE_PITCH * (i / columns) as f64),
                );
            }
        })
    }

    fn legend(&self) -> Vec<Entry> {
        let mut legend = vec![Entry::new(Swatch::Line(BLUE), "TCP")];
        if !self.reference.is_empty() {
            legend.push(Entry::new(Swatch::Line(PURPLE_DASHED), "reference"));
        }
        if !self.tcp.is_empty() {
            legend.push(Entry::new(Swatch::Ring(BLUE), "start"));
            match stopped_s(self.run) {
                Some(t_s) => {
                    let words = format!("stopped here, {}", seconds(t_s));
                    legend.push(Entry::new(Swatch::Cross(RED), words));
                }
                None => legend.push(Entry::new(Swatch::Dot(BLUE), "end")),
            }
        }
        if !self.arms[1].is_empty() {
            legend.push(Entry::new(Swatch::Line(MUTED_DASHED), "arm at the start"));
            legend.push(Entry::new(Swatch::Line(MUTED), "at the end"));
        }
        if !self.goals.is_empty() {
            legend.push(Entry::new(Swatch::Ring(GREEN), "full points"));
            legend.push(Entry::new(Swatch::Ring(VERMILLION), "none outside"));
        }
        legend
    }

    /// Points that the main view must hold.
    fn extremes(&self) -> Vec<(f64, f64)> {
        let mut points: Vec<(f64, f64)> = self.tcp.clone();
        points.extend(&self.reference);
        points.extend(self.arms.iter().flatten());
        for goal in self.goals {
            let (x, y) = self.plane.flat(&goal.position_m);
            let r = if goal.zero_m.is_finite() {
                goal.zero_m
            } else {
                0.0
            };
            points.extend([(x - r, y - r), (x + r, y + r)]);
        }
        points
    }

    fn main(&self, canvas: &mut Canvas<'_>, view: &View) {
        view.ground(canvas, (0.0, 0.0), 1.0, &self.plane);
        view.frame(canvas);
        for (arm, colour, width) in [
            (&self.arms[0], MUTED_DASHED, 2.0),
            (&self.arms[1], MUTED, 2.0),
        ] {
            let arm: Vec<_> = arm.iter().map(|p| view.at(*p)).collect();
            canvas.line(&arm, colour, width);
            for joint in arm.iter().rev().skip(1) {
                canvas.disc(*joint, 3.5, MUTED, 1.0);
            }
        }
        for (i, goal) in self.goals.iter().enumerate() {
            let at = view.at(self.plane.flat(&goal.position_m));
            self.circles(canvas, goal, at, view.pixels_per_m);
            canvas.line(&[(at.0 - 7.0, at.1), (at.0 + 7.0, at.1)], GREEN, 1.4);
            canvas.line(&[(at.0, at.1 - 7.0), (at.0, at.1 + 7.0)], GREEN, 1.4);
            let beside = (at.0 + 9.0, at.1 + 13.0);
            canvas.text(&format!("goal {}", i + 1), beside, Align::Start, INK);
        }
        self.paths(canvas, view, 1000);
        if let Some(start) = self.tcp.iter().find(|p| p.0.is_finite() && p.1.is_finite()) {
            canvas.ring(view.at(*start), 5.0, BLUE, 2.0);
        }
        if let Some(end) = self
            .tcp
            .iter()
            .rev()
            .find(|p| p.0.is_finite() && p.1.is_finite())
        {
            match stopped_s(self.run) {
                Some(_) => canvas.cross(view.at(*end), 6.0, RED, 2.5),
                None => canvas.disc(view.at(*end), 4.5, BLUE, 1.0),
            }
        }
    }

    fn paths(&self, canvas: &mut Canvas<'_>, view: &View, most: usize) {
        for (path, colour, width) in [
            (&self.reference, PURPLE_DASHED, 2.0),
            (&self.tcp, BLUE, 2.0),
        ] {
            for piece in view.pieces(path) {
                canvas.line(&in_plane(&piece, most), colour, width);
            }
        }
    }

    /// A goal's two circles, to scale.
    fn circles(&self, canvas: &mut Canvas<'_>, goal: &Goal, at: (f64, f64), pixels_per_m: f64) {
        for (radius_m, colour) in [(goal.zero_m, VERMILLION), (goal.full_m, GREEN)] {
            let radius = radius_m * pixels_per_m;
            if radius.is_finite() && radius > 0.5 {
                canvas.disc(at, radius, colour, 0.12);
                canvas.ring(at, radius, colour, 1.2);
            }
        }
    }

    /// The surroundings of a goal, offsets in millimetres.
    fn close_look(
        &self,
        canvas: &mut Canvas<'_>,
        goal: &Goal,
        number: usize,
        (left, top): (f64, f64),
    ) {
        let half_m = 1.35 * goal.zero_m;
        let centre = self.plane.flat(&goal.position_m);
        let view = View {
            x: Axis::exact(centre.0 - half_m, centre.0 + half_m),
            y: Axis::exact(centre.1 - half_m, centre.1 + half_m),
            left: left + 42.0,
            top: top + 14.0,
            pixels_per_m: CLOSE_SIZE / (2.0 * half_m),
        };
        let letter = |along: Along| ["x", "y", "z"][along.coordinate];
        let (across, up) = (letter(self.plane.across), letter(self.plane.up));
        let heading = format!("goal {number}: {across} and {up} from it [mm]");
        canvas.heading(&heading, (left, top));
        view.ground(canvas, centre, 1e3, &self.plane);
        self.circles(canvas, goal, view.at(centre), view.pixels_per_m);
        self.paths(canvas, &view, 250);
        view.frame(canvas);
        let nearest = distances_m(self.run, goal)
            .enumerate()
            .filter(|(_, distance)| distance.is_finite())
            .min_by(|a, b| a.1.total_cmp(&b.1));
        let Some((nearest, distance_m)) = nearest else {
            return;
        };
        // the end of the judged stay, else the nearest the TCP came
        let tick = goal
            .stay
            .map_or(nearest, |(_, last)| (last as usize).min(self.tcp.len() - 1));
        let at = view.at(self.tcp[tick]);
        let inside = view.clip(at, at).is_some();
        if inside {
            canvas.disc(at, 3.5, INK, 1.0);
        }
        let words = match (goal.stay, inside) {
            (Some(_), _) => "dot: end of the stay".to_owned(),
            (None, true) => format!("dot: nearest, {}", with_unit(distance_m, "m")),
            (None, false) => format!("nearest: {}", with_unit(distance_m, "m")),
        };
        let below = view.top + CLOSE_SIZE + 31.0;
        canvas.text(
            &words,
            (view.left + 0.5 * CLOSE_SIZE, below),
            Align::Middle,
            MUTED,
        );
    }
}

/// Edge of a close look \[px\].
const CLOSE_SIZE: f64 = 150.0;
/// From one row of close looks to the next \[px\].
const CLOSE_PITCH: f64 = CLOSE_SIZE + 66.0;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_lab_frame_is_drawn_x_up_and_y_to_the_right() {
        let points = [[4.0, 0.0, 0.05], [2.0, 1.4, 0.05], [2.0, -1.4, 0.05]];
        let plane = Plane::of(&points, [1.0, 0.0, 0.0]);
        assert_eq!((plane.up.coordinate, plane.across.coordinate), (0, 1));
        assert_eq!(plane.up.label("m"), "x, up [m]");
        assert_eq!(plane.across.label("m"), "y, sideways [m]");
        assert_eq!(plane.flat(&[4.0, 1.0, 0.0]), (1.0, 4.0));
    }

    #[test]
    fn a_level_plane_is_seen_from_above() {
        let points = [[0.0, 0.0, 0.5], [1.0, 2.0, 0.5]];
        let plane = Plane::of(&points, [0.0, 0.0, 1.0]);
        assert_eq!((plane.up.coordinate, plane.across.coordinate), (1, 0));
    }

    #[test]
    fn an_axis_that_points_down_is_drawn_backwards() {
        let points = [[0.0, 0.0, 0.0], [1.0, 0.0, 2.0]];
        let plane = Plane::of(&points, [0.0, 0.0, -1.0]);
        assert_eq!(plane.flat(&[1.0, 0.0, 2.0]), (1.0, -2.0));
        assert_eq!(plane.up.label("m"), "z, down [m]");
    }
}
