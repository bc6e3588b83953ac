//! A case of forward or inverse kinematics as a sketch: the arm, where its TCP is or should get, and where the answer has it.

use super::axis::{Axis, extent};
use super::canvas::{Align, Canvas, Entry, Swatch, sized_picture};
use super::plane::Plane;
use super::view::View;
use crate::palette::{BLUE, Colour, GREEN, MUTED, VERMILLION, VERMILLION_DASHED};
use kinemark_grader::record::shown_case::{AnsweredPlace, ShownPlaces};

/// Width and height \[px\].
const SIZE: (f64, f64) = (320.0, 240.0);
/// The view in it: left, top, right and bottom \[px\].
const EDGES: (f64, f64, f64, f64) = (44.0, 10.0, 312.0, 218.0);
/// An answer farther away than so many extents of the arm is not in the picture: a line leads to it.
const FARTHEST: f64 = 2.0;
/// An axis that holds more than this share of an error is shown.
const SHARE: f64 = 0.7;

/// The picture; `title` is what a screen reader says.
pub(crate) fn case_picture(title: &str, places: &ShownPlaces) -> String {
    let plane = plane(places);
    let flat = |points: &[[f64; 3]]| points.iter().map(|p| plane.flat(p)).collect::<Vec<_>>();
    let view = view(places, &plane);
    sized_picture(title, SIZE, |canvas| {
        view.ground(canvas, (0.0, 0.0), 1.0, &plane);
        view.frame(canvas);
        let (left, top, edge, bottom) = EDGES;
        canvas.text(
            plane.up.letter(),
            (left + 10.0, top + 11.0),
            Align::Middle,
            MUTED,
        );
        canvas.text(
            plane.across.letter(),
            (edge - 10.0, bottom - 11.0),
            Align::Middle,
            MUTED,
        );
        let right = plane.flat(&places.right_m);
        arm(canvas, &view, &flat(&places.arm_m), MUTED);
        // the right ones lie above the wrong ones
        let mut answered: Vec<&AnsweredPlace> = places.answered.iter().collect();
        answered.sort_by_key(|place| place.is_right);
        for place in &answered {
            let colour = if place.is_right { BLUE } else { VERMILLION };
            arm(canvas, &view, &flat(&place.arm_m), colour);
        }
        for place in answered.iter().filter(|place| !place.is_right) {
            for piece in view.pieces(&[right, plane.flat(&place.tcp_m)]) {
                canvas.line(&piece, VERMILLION_DASHED, 1.4);
            }
        }
        let of_target = match places.is_out_of_reach() {
            true => MUTED,
            false => GREEN,
        };
        canvas.ring(view.at(right), 6.0, of_target, 2.0);
        for place in answered {
            let at = view.at(plane.flat(&place.tcp_m));
            match view.clip(at, at) {
                Some(_) if place.is_right => canvas.disc(at, 3.2, BLUE, 1.0),
                Some(_) => canvas.cross(at, 5.0, VERMILLION, 2.2),
                None => {}
            }
        }
    })
}

/// What the pictures of some cases show: a small picture of each line or mark, and its words.
pub(crate) fn case_legend<'p>(
    all: impl Iterator<Item = &'p ShownPlaces> + Clone,
) -> Vec<(String, String)> {
    let mut entries = Vec::new();
    let is_given = all.clone().any(|places| !places.arm_m.is_empty());
    if is_given {
        entries.push(Entry::new(
            Swatch::Line(MUTED),
            "arm at the joint positions given",
        ));
        entries.push(Entry::new(Swatch::Ring(GREEN), "where its TCP is"));
    }
    let mut targets = all.clone().filter(|places| places.arm_m.is_empty());
    if targets.clone().any(|places| !places.is_out_of_reach()) {
        entries.push(Entry::new(Swatch::Ring(GREEN), "where the TCP should be"));
    }
    if targets.any(ShownPlaces::is_out_of_reach) {
        entries.push(Entry::new(Swatch::Ring(MUTED), "target out of reach"));
    }
    let answered = || all.clone().flat_map(|places| &places.answered);
    let at_joints = |is_right: bool| {
        answered().any(|place| place.is_right == is_right && !place.arm_m.is_empty())
    };
    if at_joints(true) {
        entries.push(Entry::new(Swatch::Line(BLUE), "arm at a right answer"));
    }
    if at_joints(false) {
        entries.push(Entry::new(
            Swatch::Line(VERMILLION),
            "arm at a wrong answer",
        ));
    }
    if answered().any(|place| place.is_right && place.arm_m.is_empty()) {
        entries.push(Entry::new(Swatch::Dot(BLUE), "right answer"));
    }
    if answered().any(|place| !place.is_right) {
        let words = if is_given { "wrong answer" } else { "its TCP" };
        entries.push(Entry::new(Swatch::Cross(VERMILLION), words));
    }
    entries.iter().map(Entry::shown).collect()
}

/// The arm as a line with its joints.
fn arm(canvas: &mut Canvas, view: &View, points: &[(f64, f64)], colour: Colour) {
    for piece in view.pieces(points) {
        canvas.line(&piece, colour, 3.0);
    }
    // the last is the TCP, which has a mark of its own
    let joints = points.iter().take(points.len().saturating_sub(1));
    for joint in joints.map(|p| view.at(*p)) {
        if view.clip(joint, joint).is_some() {
            canvas.disc(joint, 3.6, colour, 1.0);
        }
    }
}

/// All that the picture should hold, but for answers that are far away.
fn shown_points(places: &ShownPlaces) -> Vec<[f64; 3]> {
    let arms = places.answered.iter().flat_map(|place| &place.arm_m);
    let mut points: Vec<[f64; 3]> = places.arm_m.iter().chain(arms).copied().collect();
    points.push(places.right_m);
    let size = diagonal(&points);
    let near = |p: &&[f64; 3]| {
        let off = distance(p, &places.right_m);
        off <= FARTHEST * size || size == 0.0
    };
    let answered: Vec<[f64; 3]> = places.answered.iter().map(|place| place.tcp_m).collect();
    points.extend(answered.iter().filter(near));
    points
}

fn distance(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    let squares = a.iter().zip(b).map(|(a, b)| (a - b) * (a - b));
    squares.sum::<f64>().sqrt()
}

/// The diagonal of the box around points.
fn diagonal(points: &[[f64; 3]]) -> f64 {
    let span = |c: usize| extent(points.iter().map(|p| p[c])).map_or(0.0, |(min, max)| max - min);
    (0..3).map(|c| span(c) * span(c)).sum::<f64>().sqrt()
}

/// The plane in which most of the arm is seen, unless it hides what is wrong.
fn plane(places: &ShownPlaces) -> Plane {
    let wrong = places.answered.iter().filter(|place| !place.is_right);
    let worst = wrong
        .filter(|place| place.tcp_m.iter().all(|x| x.is_finite()))
        .max_by(|a, b| {
            let off = |place: &AnsweredPlace| distance(&place.tcp_m, &places.right_m);
            off(a).total_cmp(&off(b))
        });
    let hidden = worst.and_then(|place| {
        let size = distance(&place.tcp_m, &places.right_m);
        let along = |c: &usize| (place.tcp_m[*c] - places.right_m[*c]).abs();
        (0..3).find(|c| size > 0.0 && along(c) > SHARE * size)
    });
    Plane::showing(&shown_points(places), places.upward, hidden)
}

fn view(places: &ShownPlaces, plane: &Plane) -> View {
    let points: Vec<(f64, f64)> = shown_points(places).iter().map(|p| plane.flat(p)).collect();
    let reach = |of: fn(&(f64, f64)) -> f64| {
        let (min, max) = extent(points.iter().map(of)).unwrap_or((-0.5, 0.5));
        (0.5 * (min + max), (1.16 * (max - min)).max(0.02))
    };
    let ((cx, w), (cy, h)) = (reach(|p| p.0), reach(|p| p.1));
    let (left, top, right, bottom) = EDGES;
    let pixels_per_m = ((right - left) / w).min((bottom - top) / h);
    let half = |pixels: f64| 0.5 * pixels / pixels_per_m;
    View {
        x: Axis::exact(cx - half(right - left), cx + half(right - left)),
        y: Axis::exact(cy - half(bottom - top), cy + half(bottom - top)),
        left,
        top,
        pixels_per_m,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use kinemark_grader::record::shown_case::BranchCount;

    fn places(answered: [f64; 3], is_right: bool) -> ShownPlaces {
        ShownPlaces {
            upward: [0.0, 0.0, 1.0],
            right_m: [1.0, 1.0, 0.2],
            branches: None,
            arm_m: vec![[0.0, 0.0, 0.2], [1.0, 0.0, 0.2], [1.0, 1.0, 0.2]],
            answered: vec![AnsweredPlace {
                tcp_m: answered,
                arm_m: Vec::new(),
                is_right,
            }],
        }
    }

    #[test]
    fn a_level_arm_is_seen_from_above_unless_the_answer_is_off_upwards() {
        let seen = |answered| {
            let plane = plane(&places(answered, false));
            (plane.across.coordinate, plane.up.coordinate)
        };
        assert_eq!(seen([0.5, 1.0, 0.2]), (0, 1));
        assert_eq!(seen([1.0, 1.0, 0.9]), (0, 2));
        // far away, and no number at all
        assert_eq!(seen([1e9, 1.0, 0.2]), (0, 1));
        assert_eq!(seen([f64::NAN, 1.0, 0.2]), (0, 1));
    }

    #[test]
    fn an_answer_far_away_does_not_shrink_the_arm() {
        let near = view(
            &places([0.5, 1.0, 0.2], false),
            &plane(&places([0.5, 1.0, 0.2], false)),
        );
        let far = places([1e7, 1.0, 0.2], false);
        assert_eq!(view(&far, &plane(&far)).pixels_per_m, near.pixels_per_m);
        let svg = case_picture("bent", &far);
        assert!(
            svg.contains("<title>bent</title>") && !svg.contains("NaN"),
            "{svg}"
        );
    }

    #[test]
    fn a_right_answer_has_a_dot_and_a_wrong_one_a_cross_with_a_line_to_it() {
        let colour = |colour: Colour| crate::palette::hex(colour.light);
        // the style sheet has every colour
        let drawn = |is_right| {
            let svg = case_picture("", &places([0.5, 1.0, 0.2], is_right));
            svg.split_once("</style>")
                .expect("a style sheet")
                .1
                .to_owned()
        };
        assert!(drawn(true).contains(&colour(BLUE)) && !drawn(true).contains(&colour(VERMILLION)));
        assert!(!drawn(false).contains(&colour(BLUE)));
        assert!(drawn(false).matches(&colour(VERMILLION)).count() >= 2);
    }

    #[test]
    fn the_legend_says_what_is_drawn() {
        let words = |all: &[ShownPlaces]| -> Vec<String> {
            let legend = case_legend(all.iter());
            legend.into_iter().map(|(_, words)| words).collect()
        };
        let wrong = places([0.5, 1.0, 0.2], false);
        assert_eq!(
            words(std::slice::from_ref(&wrong)),
            [
                "arm at the joint positions given",
                "where its TCP is",
                "wrong answer"
            ]
        );
        let mut inverse = wrong;
        inverse.answered[0].arm_m = std::mem::take(&mut inverse.arm_m);
        let answer = ["arm at a wrong answer", "its TCP"];
        let with = |first: &[&'static str]| [first, &answer[..]].concat();
        assert_eq!(
            words(std::slice::from_ref(&inverse)),
            with(&["where the TCP should be"])
        );
        let mut beyond = inverse.clone();
        beyond.branches = Some(BranchCount { found: 0, all: 0 });
        assert_eq!(
            words(std::slice::from_ref(&beyond)),
            with(&["target out of reach"])
        );
        assert_eq!(
            words(&[inverse, beyond.clone()]),
            with(&["where the TCP should be", "target out of reach"])
        );
        let svg = case_picture("", &beyond);
        let (_, drawn) = svg.split_once("</style>").expect("a style sheet");
        assert!(
            !drawn.contains(&crate::palette::hex(GREEN.light)),
            "{drawn}"
        );
    }
}
