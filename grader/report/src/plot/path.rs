//! The TCP's path in the plane it moves in, to scale on both axes, with a close look at every goal.

use kinemark_sim::kinematics::{FramePoses, stick_figure};
use kinemark_sim::spatial::Pose;
use kinemark_sim::text::number::seconds;
use nalgebra::Vector3;

use super::Head;
use super::axis::Axis;
use super::canvas::{Align, Canvas, Entry, Swatch, WIDTH, picture, text_width};
use super::given_paths::GivenPaths;
use super::plane::Plane;
use super::reading::Axes;
use super::scenery::{Scenery, clipped};
use super::signals::{differs, stopped_s};
use super::thin::in_plane;
use super::view::{LEFT, RIGHT, View};
use crate::goal::distances_m;
use crate::palette::{
    AMBER, BLUE, Colour, GREEN, INK, MUTED, MUTED_DASHED, PURPLE_DASHED, RED, VERMILLION,
};
use crate::visible::shortened;
use kinemark_grader::record::graded::{Goal, TaskRun};
use kinemark_grader::record::quantity::with_unit;

/// A goal's circle smaller than this needs a close look \[px\].
const TOO_SMALL: f64 = 14.0;
/// A body of the scene that ends farther from its start may lie outside the picture \[m\].
const FAR_M: f64 = 1.5;
/// Goals that get one.
const MOST_CLOSE_LOOKS: usize = 6;
/// Goals that are drawn.
const MOST_GOALS: usize = 200;

/// The picture, its title and where its axes lie; `None` where there is nothing to draw.
pub(super) fn path(run: &TaskRun) -> Option<(String, String, Vec<Axes>, Head)> {
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
        .chain(
            run.paths
                .iter()
                .flat_map(|path| path.points_m.iter().copied()),
        )
        .collect();
    if places.is_empty() {
        return None;
    }
    let plane = Plane::of(&places, upward(run));
    let flat = |points: &[[f64; 3]]| points.iter().map(|p| plane.flat(p)).collect::<Vec<_>>();
    let drawn = PathPicture {
        run,
        plane,
        goals,
        tcp: flat(&tcp),
        reference: flat(reference),
        asked: GivenPaths::of(run, &plane),
        scenery: Scenery::of(run, &frame_from_world(run), &plane),
        arms: arms(run).map(|arm| arm.map_or_else(Vec::new, |arm| flat(&arm))),
    };
    let title = format!("TCP path in the frame {}", shortened(&run.seen_from, 40));
    let (svg, axes, head) = drawn.draw(&title);
    Some((svg, title, axes, head))
}

/// The frame of the path's coordinates, with the arm at home.
fn frame_from_world(run: &TaskRun) -> Pose {
    let frame = run.robot.frame(&run.seen_from);
    frame.map_or_else(Pose::identity, |frame| {
        FramePoses::new(&run.robot).world_from(frame).inverse()
    })
}

/// How far each axis of the frame points up in the world.
fn upward(run: &TaskRun) -> [f64; 3] {
    let up = frame_from_world(run).transform_vector(&Vector3::z());
    [up.x, up.y, up.z]
}

/// The arm as a line, at the first and the last tick.
fn arms(run: &TaskRun) -> [Option<Vec<[f64; 3]>>; 2] {
    let robot = &run.robot;
    let seen_from = robot.frame(&run.seen_from);
    let mut poses = FramePoses::new(robot);
    let mut at = |tick: usize| {
        let q = run.trace.q.at(tick);
        if !q.iter().all(|q| q.is_finite()) {
            return None;
        }
        poses.update(robot, q);
        Some(stick_figure(robot, &poses, seen_from))
    };
    match run.trace.len() {
        0 => [None, None],
        len => [at(0), at(len - 1)],
    }
}

/// Everything the picture shows, in its plane.
struct PathPicture<'a> {
    run: &'a TaskRun,
    plane: Plane,
    goals: &'a [Goal],
    tcp: Vec<(f64, f64)>,
    reference: Vec<(f64, f64)>,
    arms: [Vec<(f64, f64)>; 2],
    scenery: Scenery,
    asked: GivenPaths,
}

impl PathPicture<'_> {
    fn draw(&self, title: &str) -> (String, Vec<Axes>, Head) {
        let legend = self.legend();
        let mut top = 0.0;
        picture("", 1.0, |canvas| top = canvas.legend(&legend, 20.0, 50.0));
        let view = View::around(&self.extremes(), top + 27.0);
        let close: Vec<&Goal> = self
            .goals
            .iter()
            .filter(|goal| goal.zero_m * view.pixels_per_m < TOO_SMALL && goal.zero_m > 0.0)
            .take(MOST_CLOSE_LOOKS)
            .collect();
        let columns = close.len().clamp(1, 3);
        let below = view.top + view.height() + if close.is_empty() { 42.0 } else { 56.0 };
        let rows = close.len().div_ceil(columns) as f64;
        let size = if columns < 3 { 210.0 } else { 140.0 };
        let height = below + rows * (size + CLOSE_WORDS);
        let mut axes = vec![Axes::in_plane(&view, &self.plane)];
        let svg = picture(title, height, |canvas| {
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
                let view = self.close_look(
                    canvas,
                    goal,
                    number,
                    (left, below + (size + CLOSE_WORDS) * (i / columns) as f64),
                    size,
                );
                axes.push(Axes::in_plane(&view, &self.plane));
            }
        });
        let head = Head::above(&legend, top, height);
        (svg, axes, head)
    }

    fn legend(&self) -> Vec<Entry> {
        let mut legend = vec![Entry::new(Swatch::Line(BLUE), "TCP")];
        if !self.reference.is_empty() {
            legend.push(Entry::new(Swatch::Line(PURPLE_DASHED), "reference"));
        }
        self.asked.legend(&mut legend);
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
        if let Some((t_s, words)) = differs(self.run) {
            let words = format!("{words}, {}", seconds(t_s));
            legend.push(Entry::new(Swatch::Number(1), words));
        }
        if !self.arms[1].is_empty() {
            legend.push(Entry::new(Swatch::Line(MUTED_DASHED), "arm at the start"));
            legend.push(Entry::new(Swatch::Line(MUTED), "at the end"));
        }
        if !self.scenery.is_empty() {
            legend.push(Entry::new(Swatch::Body(MUTED), "what stands there"));
        }
        if !self.scenery.at_end.is_empty() {
            let start = "what can move, at the start";
            legend.push(Entry::new(Swatch::Outline(AMBER), start));
            legend.push(Entry::new(Swatch::Body(AMBER), "at the end"));
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
        points.extend(self.asked.extremes());
        // where the scene's bodies start is part of the picture, where they end only if that is not far off
        for (start, end) in self.scenery.at_start.iter().zip(&self.scenery.at_end) {
            points.extend(start);
            let near = |p: &&(f64, f64)| {
                start
                    .iter()
                    .any(|s| (s.0 - p.0).abs().max((s.1 - p.1).abs()) < FAR_M)
            };
            points.extend(end.iter().filter(near));
        }
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

    fn main(&self, canvas: &mut Canvas, view: &View) {
        view.ground(canvas, (0.0, 0.0), 1.0, &self.plane);
        self.around(canvas, view);
        self.asked.tubes(canvas, view);
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
        for goal in self.goals {
            let at = view.at(self.plane.flat(&goal.position_m));
            self.circles(canvas, goal, at, view.pixels_per_m);
            canvas.line(&[(at.0 - 7.0, at.1), (at.0 + 7.0, at.1)], GREEN, 1.4);
            canvas.line(&[(at.0, at.1 - 7.0), (at.0, at.1 + 7.0)], GREEN, 1.4);
        }
        let lines = self.lines(view);
        for (at, words) in self.goal_words(view) {
            let (place, align) = beside(at, text_width(&words), view, &lines);
            canvas.text(&words, place, align, INK);
        }
        self.paths(canvas, view, 1000);
        // on top, so that its gaps show the TCP where both agree
        self.asked.lines(canvas, view);
        self.asked.names(canvas, view);
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
        let differs = self.run.divergence.as_ref();
        let differs = differs.and_then(|found| self.tcp.get(found.tick as usize));
        if let Some(at) = differs.filter(|p| p.0.is_finite() && p.1.is_finite()) {
            canvas.number(1, view.at(*at));
        }
    }

    /// The bodies of the scene, as far as they lie in the view.
    fn around(&self, canvas: &mut Canvas, view: &View) {
        let (low, high) = ((view.x.min, view.y.min), (view.x.max, view.y.max));
        let mut draw = |outlines: &[Vec<(f64, f64)>], colour: Colour, alpha: f64| {
            for outline in outlines {
                let inside = clipped(outline, low, high);
                let mut points: Vec<_> = inside.iter().map(|p| view.at(*p)).collect();
                canvas.polygon(&points, colour, alpha);
                points.extend(points.first().copied());
                canvas.line(&points, colour, 1.2);
            }
        };
        draw(&self.scenery.standing, MUTED, 0.2);
        draw(&self.scenery.at_start, AMBER, 0.0);
        draw(&self.scenery.at_end, AMBER, 0.25);
    }

    /// Lines that words should not stand on: the arms, and the path in few points.
    fn lines(&self, view: &View) -> Vec<Vec<(f64, f64)>> {
        let every = self.tcp.len() / 500 + 1;
        let path: Vec<_> = self.tcp.iter().step_by(every).copied().collect();
        let arms = self.arms.iter().cloned();
        let lines = arms.chain([path, self.reference.clone()]);
        lines.flat_map(|line| view.pieces(&line)).collect()
    }

    /// Numbers of the goals, those of nearly the same place together.
    fn goal_words(&self, view: &View) -> Vec<((f64, f64), String)> {
        let mut places: Vec<((f64, f64), String)> = Vec::new();
        for (i, goal) in self.goals.iter().enumerate() {
            let at = view.at(self.plane.flat(&goal.position_m));
            let near = |place: &&mut ((f64, f64), String)| {
                (place.0.0 - at.0).abs() < 60.0 && (place.0.1 - at.1).abs() < 16.0
            };
            match places.iter_mut().find(near) {
                Some((_, words)) => words.push_str(&format!(", {}", i + 1)),
                None => places.push((at, format!("goal {}", i + 1))),
            }
        }
        for (_, words) in &mut places {
            *words = shortened(words, 20);
        }
        places
    }

    fn paths(&self, canvas: &mut Canvas, view: &View, most: usize) {
        for (path, colour, width) in [
            (&self.tcp, BLUE, 2.2),
            // on top, so that its gaps show the TCP where both agree
            (&self.reference, PURPLE_DASHED, 1.6),
        ] {
            for piece in view.pieces(path) {
                canvas.line(&in_plane(&piece, most), colour, width);
            }
        }
    }

    /// A goal's two circles, to scale.
    fn circles(&self, canvas: &mut Canvas, goal: &Goal, at: (f64, f64), pixels_per_m: f64) {
        for (radius_m, colour) in [(goal.zero_m, VERMILLION), (goal.full_m, GREEN)] {
            let radius = radius_m * pixels_per_m;
            if radius.is_finite() && radius > 0.5 {
                canvas.disc(at, radius, colour, 0.12);
                canvas.ring(at, radius, colour, 1.2);
            }
        }
    }

    /// The surroundings of a goal, offsets in millimetres, and their view.
    fn close_look(
        &self,
        canvas: &mut Canvas,
        goal: &Goal,
        number: usize,
        (left, top): (f64, f64),
        size: f64,
    ) -> View {
        let half_m = 1.35 * goal.zero_m;
        let centre = self.plane.flat(&goal.position_m);
        let view = View {
            x: Axis::exact(centre.0 - half_m, centre.0 + half_m),
            y: Axis::exact(centre.1 - half_m, centre.1 + half_m),
            left: left + 42.0,
            top: top + 14.0,
            pixels_per_m: size / (2.0 * half_m),
        };
        let (across, up) = (self.plane.across.letter(), self.plane.up.letter());
        let heading = format!("goal {number}: {across}, {up} [mm]");
        canvas.heading(&heading, (left, top));
        view.ground(canvas, centre, 1e3, &self.plane);
        self.circles(canvas, goal, view.at(centre), view.pixels_per_m);
        self.paths(canvas, &view, 250);
        self.asked.lines(canvas, &view);
        view.frame(canvas);
        let nearest = distances_m(self.run, goal)
            .enumerate()
            .filter(|(_, distance)| distance.is_finite())
            .min_by(|a, b| a.1.total_cmp(&b.1));
        let Some((nearest, distance_m)) = nearest else {
            return view;
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
        let below = view.top + size + 31.0;
        canvas.text(
            &words,
            (view.left + 0.5 * size, below),
            Align::Middle,
            MUTED,
        );
        view
    }
}

/// Where words of a width stand beside a point: below it to the right, or where fewer lines run through them.
fn beside(
    (x, y): (f64, f64),
    width: f64,
    view: &View,
    lines: &[Vec<(f64, f64)>],
) -> ((f64, f64), Align) {
    let places = [
        (9.0, 13.0, Align::Start),
        (9.0, -12.0, Align::Start),
        (-9.0, 13.0, Align::End),
        (-9.0, -12.0, Align::End),
    ];
    let places = places.map(|(dx, dy, align)| ((x + dx, y + dy), align));
    let crossed = |((x, y), align): &((f64, f64), Align)| {
        let left = if *align == Align::End { x - width } else { *x };
        let words = View {
            x: Axis::exact(0.0, width),
            y: Axis::exact(0.0, 14.0),
            left,
            top: y - 7.0,
            pixels_per_m: 1.0,
        };
        let segments = lines.iter().flat_map(|line| line.windows(2));
        let through = segments.filter(|two| words.clip(two[0], two[1]).is_some());
        let is_inside = left >= view.left
            && left + width <= view.left + view.width()
            && y - 7.0 >= view.top
            && y + 7.0 <= view.top + view.height();
        through.count() + if is_inside { 0 } else { 1000 }
    };
    places.into_iter().min_by_key(crossed).unwrap_or(places[0])
}

/// Above and below a close look: its heading, labels and words \[px\].
const CLOSE_WORDS: f64 = 66.0;
