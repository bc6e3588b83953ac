//! Faces from back to front, cut where they pass through each other, so that painting them in turn shows what is seen.
//!
//! Source: Fuchs, Kedem and Naylor, *On visible surface generation by a priori tree structures* (1980): a plane through one face
//! parts the others into those on the viewer's side and those behind it; cut is what lies on both.

use nalgebra::{Point3, Vector3};

use super::face::Face;

/// Planes that are tried at each step.
const TRIED: usize = 7;
/// Faces, with those that cutting made, from which on nothing is cut any more.
const MOST_FACES: usize = 12_000;

/// A list that is still to be parted, or that is painted as it is.
enum Work {
    Part(Vec<Face>),
    Paint(Vec<Face>),
}

/// Where a face lies to a plane.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Side {
    Front,
    Behind,
    On,
    Both,
}

/// `faces` as a viewer far off in the direction `toward` has to paint them; lengths below `epsilon_m` count as nothing.
pub(super) fn back_to_front(faces: Vec<Face>, toward: &Vector3<f64>, epsilon_m: f64) -> Vec<Face> {
    let mut painted = Vec::with_capacity(faces.len());
    let mut count = faces.len();
    let mut work = vec![Work::Part(faces)];
    while let Some(next) = work.pop() {
        let mut faces = match next {
            Work::Paint(faces) => {
                painted.extend(faces);
                continue;
            }
            Work::Part(faces) => faces,
        };
        let depth = |face: &Face| {
            let sum: f64 = face.corners.iter().map(|p| p.coords.dot(toward)).sum();
            sum / face.corners.len() as f64
        };
        let one = faces.windows(2).all(|pair| pair[0].solid == pair[1].solid);
        // what is seen of one convex solid does not hide itself; small triangles of one mesh need not be cut
        if one || count > MOST_FACES {
            if !faces.iter().all(|face| one && face.convex) {
                faces.sort_by(|a, b| depth(a).total_cmp(&depth(b)));
            }
            painted.extend(faces);
            continue;
        }
        let (normal, at) = splitter(&faces, epsilon_m);
        let before = faces.len();
        let [mut front, mut behind, mut on] = [const { Vec::new() }; 3];
        for face in faces {
            match side(&face, &normal, &at, epsilon_m) {
                Side::Front => front.push(face),
                Side::Behind => behind.push(face),
                Side::On => on.push(face),
                Side::Both => {
                    let [above, below] = cut(face, &normal, &at);
                    front.extend(above);
                    behind.extend(below);
                }
            }
        }
        count += (front.len() + behind.len() + on.len()).saturating_sub(before);
        let (near, far) = if normal.dot(toward) >= 0.0 {
            (front, behind)
        } else {
            (behind, front)
        };
        work.push(Work::Part(near));
        work.push(Work::Paint(on));
        work.push(Work::Part(far));
    }
    painted
}

/// The plane that cuts the fewest and parts them most evenly: one through a face, or upright or level between two solids.
fn splitter(faces: &[Face], epsilon_m: f64) -> (Vector3<f64>, Point3<f64>) {
    let step = faces.len().div_ceil(TRIED).max(1);
    let through = faces.iter().step_by(step);
    let through = through.map(|face| (face.normal, face.corners[0]));
    let mut best: Option<(usize, Vector3<f64>, Point3<f64>)> = None;
    for (i, (normal, at)) in through.chain(between(faces)).enumerate() {
        let (mut front, mut behind, mut both) = (0usize, 0usize, 0usize);
        for face in faces {
            match side(face, &normal, &at, epsilon_m) {
                Side::Front => front += 1,
                Side::Behind => behind += 1,
                Side::Both => both += 1,
                Side::On => {}
            }
        }
        // one that goes through no face must part them, or there would be no end
        if i >= faces.len().div_ceil(step) && (front == 0 || behind == 0) {
            continue;
        }
        let cost = 6 * both + front.abs_diff(behind);
        if best.as_ref().is_none_or(|(least, ..)| cost < *least) {
            best = Some((cost, normal, at));
        }
    }
    best.map_or((Vector3::z(), Point3::origin()), |(_, normal, at)| {
        (normal, at)
    })
}

/// The planes of the boxes along the axes around some of the solids.
fn between(faces: &[Face]) -> Vec<(Vector3<f64>, Point3<f64>)> {
    let mut boxes: Vec<(usize, Point3<f64>, Point3<f64>)> = Vec::new();
    for face in faces {
        let known = boxes.iter().position(|(solid, ..)| *solid == face.solid);
        let at = match known {
            Some(at) => at,
            None if boxes.len() >= TRIED => continue,
            None => {
                boxes.push((face.solid, face.corners[0], face.corners[0]));
                boxes.len() - 1
            }
        };
        let (_, low, high) = &mut boxes[at];
        for p in &face.corners {
            *low = low.inf(p);
            *high = high.sup(p);
        }
    }
    let axes = [Vector3::x(), Vector3::y(), Vector3::z()];
    let planes = boxes.into_iter().flat_map(|(_, low, high)| {
        let of = move |axis: Vector3<f64>| [(axis, low), (axis, high)];
        axes.into_iter().flat_map(of)
    });
    planes.collect()
}

fn height(p: &Point3<f64>, normal: &Vector3<f64>, at: &Point3<f64>) -> f64 {
    (p - at).dot(normal)
}

fn side(face: &Face, normal: &Vector3<f64>, at: &Point3<f64>, epsilon_m: f64) -> Side {
    let (mut above, mut below) = (false, false);
    for p in &face.corners {
        let height = height(p, normal, at);
        above |= height > epsilon_m;
        below |= height < -epsilon_m;
    }
    match (above, below) {
        (true, true) => Side::Both,
        (true, false) => Side::Front,
        (false, true) => Side::Behind,
        (false, false) => Side::On,
    }
}

/// The part of a face before a plane and the part behind it.
fn cut(face: Face, normal: &Vector3<f64>, at: &Point3<f64>) -> [Option<Face>; 2] {
    let heights: Vec<f64> = face.corners.iter().map(|p| height(p, normal, at)).collect();
    let part = |sign: f64| {
        let (mut corners, mut edges) = (Vec::new(), Vec::new());
        for (i, a) in face.corners.iter().enumerate() {
            let j = (i + 1) % face.corners.len();
            let (ha, hb) = (sign * heights[i], sign * heights[j]);
            if ha >= 0.0 {
                corners.push(*a);
                edges.push(face.edges[i]);
            }
            if (ha >= 0.0) != (hb >= 0.0) {
                let b = &face.corners[j];
                corners.push(a + (b - a) * (ha / (ha - hb)));
                if ha >= 0.0 {
                    // what follows runs along the cut, up to where the outline comes back
                    edges.push(false);
                } else {
                    edges.push(face.edges[i]);
                }
            }
        }
        (corners.len() > 2).then(|| Face {
            corners,
            edges,
            ..face.clone()
        })
    };
    [part(1.0), part(-1.0)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solid::{Detail, drawn};
    use crate::storyboard::face::place;
    use kinemark_sim::model::inertia::Solid;
    use kinemark_sim::spatial::{Pose, pose};
    use nalgebra::Matrix3;

    const DETAIL: Detail = Detail {
        around: 16,
        triangles: 200,
    };

    fn block(size_m: [f64; 3], at: [f64; 3], solid: usize, faces: &mut Vec<Face>) {
        let pose = pose(Matrix3::identity(), Vector3::from(at));
        let block = drawn(&Solid::Box { size_m }).faces(DETAIL);
        place(&block, &pose, solid, (0, 0, 0), faces);
    }

    fn seen(faces: Vec<Face>, toward: &Vector3<f64>) -> Vec<Face> {
        let seen = |face: &Face| face.normal.dot(toward) > 0.0;
        faces.into_iter().filter(seen).collect()
    }

    /// The solid painted last over the point where the line through `p` along `toward` meets the faces.
    fn on_top(painted: &[Face], p: &Point3<f64>, toward: &Vector3<f64>) -> Option<(usize, f64)> {
        let mut top = None;
        for face in painted {
            let down = face.normal.dot(toward);
            let t = (face.corners[0] - p).dot(&face.normal) / down;
            let hit = p + toward * t;
            let inside = (0..face.corners.len()).all(|i| {
                let (a, b) = (face.corners[i], face.corners[(i + 1) % face.corners.len()]);
                (b - a).cross(&(hit - a)).dot(&face.normal) >= 0.0
            });
            if inside {
                top = Some((face.solid, t));
            }
        }
        top
    }

    #[test]
    fn boxes_that_pass_through_each_other_are_painted_as_they_are_seen() {
        let toward = Vector3::new(0.5, -0.7, 0.4).normalize();
        let mut faces = Vec::new();
        block([2.0, 0.3, 0.3], [0.0, 0.0, 0.0], 0, &mut faces);
        block([0.3, 2.0, 0.3], [0.1, 0.1, 0.05], 1, &mut faces);
        block([0.3, 0.3, 2.0], [0.05, -0.1, 0.1], 2, &mut faces);
        let faces = seen(faces, &toward);
        let painted = back_to_front(faces.clone(), &toward, 1e-9);
        assert!(painted.len() > faces.len(), "something is cut");
        // lines of sight all over the picture: what was painted last is the nearest
        let right = Vector3::z().cross(&toward).normalize();
        let up = toward.cross(&right);
        let mut hits = 0;
        for i in -60..60 {
            for j in -60..60 {
                let p =
                    Point3::from(right * (f64::from(i) * 0.0201) + up * (f64::from(j) * 0.0203));
                let Some((_, shown)) = on_top(&painted, &p, &toward) else {
                    continue;
                };
                let nearest = faces
                    .iter()
                    .filter_map(|face| on_top(std::slice::from_ref(face), &p, &toward))
                    .map(|(_, t)| t)
                    .fold(f64::NEG_INFINITY, f64::max);
                assert!((shown - nearest).abs() < 1e-6, "{p}: {shown} {nearest}");
                hits += 1;
            }
        }
        assert!(hits > 1000, "{hits}");
    }

    #[test]
    fn a_cut_keeps_the_area_and_draws_no_line_along_itself() {
        let mut faces = Vec::new();
        block([2.0, 2.0, 2.0], [0.0; 3], 0, &mut faces);
        let top = faces.into_iter().find(|f| f.normal.z > 0.5).expect("top");
        let normal = Vector3::new(1.0, 0.3, 0.0).normalize();
        let parts = cut(top, &normal, &Point3::new(0.2, 0.0, 0.0));
        let mut area = 0.0;
        for part in parts.into_iter().flatten() {
            assert_eq!(part.edges.iter().filter(|drawn| !**drawn).count(), 1);
            for i in 0..part.corners.len() {
                let (a, b) = (part.corners[i], part.corners[(i + 1) % part.corners.len()]);
                area += 0.5 * (a.x * b.y - b.x * a.y);
                let along = (height(&a, &normal, &Point3::new(0.2, 0.0, 0.0))).abs() < 1e-12
                    && (height(&b, &normal, &Point3::new(0.2, 0.0, 0.0))).abs() < 1e-12;
                assert_eq!(along, !part.edges[i]);
            }
        }
        assert!((area - 4.0).abs() < 1e-12, "{area}");
    }

    #[test]
    fn one_convex_solid_is_not_cut() {
        let toward = Vector3::new(0.5, -0.7, 0.4).normalize();
        let mut faces = Vec::new();
        place(
            &drawn(&Solid::Sphere { radius_m: 1.0 }).faces(DETAIL),
            &Pose::identity(),
            0,
            (0, 0, 0),
            &mut faces,
        );
        let faces = seen(faces, &toward);
        let count = faces.len();
        assert_eq!(back_to_front(faces, &toward, 1e-9).len(), count);
    }
}
