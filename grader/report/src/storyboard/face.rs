//! Solids as flat faces: what a picture is put together from.

use std::collections::{BTreeMap, BTreeSet};

use kinemark_sim::robot::inertia::Solid;
use kinemark_sim::spatial::Pose;
use nalgebra::{Point3, Vector3};

/// A colour, in red, green and blue.
pub(super) type Rgb = (u8, u8, u8);

/// A flat convex face.
#[derive(Debug, Clone)]
pub(super) struct Face {
    /// Its corners, counter-clockwise seen from outside \[m\].
    pub(super) corners: Vec<Point3<f64>>,
    /// Whether the edge from each corner to the next is an edge of the solid, to be drawn as a line.
    pub(super) edges: Vec<bool>,
    /// Its unit normal, outwards.
    pub(super) normal: Vector3<f64>,
    /// The solid it belongs to.
    pub(super) solid: usize,
    /// Whether that solid is convex and closed: none of its faces that are seen hides another.
    pub(super) convex: bool,
    pub(super) colour: Rgb,
}

/// The faces of a solid in its own frame: corners, and which edges are drawn.
#[derive(Debug, Clone, Default)]
pub(super) struct Faces {
    faces: Vec<(Vec<Point3<f64>>, Vec<bool>)>,
    convex: bool,
}

/// How finely round solids and meshes are drawn.
#[derive(Debug, Clone, Copy)]
pub(super) struct Detail {
    /// Faces around a round solid, a multiple of four.
    pub(super) around: usize,
    /// Triangles of a mesh.
    pub(super) triangles: usize,
}

impl Faces {
    pub(super) fn of(solid: &Solid, detail: Detail) -> Self {
        match *solid {
            Solid::Box { size_m } => Self::block(size_m),
            Solid::Cylinder { radius_m, length_m } => Self::turned(
                &[(radius_m, -0.5 * length_m), (radius_m, 0.5 * length_m)],
                detail.around,
                true,
            ),
            Solid::Capsule { radius_m, length_m } => {
                Self::turned(&round(radius_m, length_m, detail), detail.around, false)
            }
            Solid::Sphere { radius_m } => {
                Self::turned(&round(radius_m, 0.0, detail), detail.around, false)
            }
            Solid::Mesh(ref mesh) => {
                let mesh = &mesh.mesh;
                Self::surface(mesh.vertices(), mesh.triangles(), detail.triangles)
            }
        }
    }

    /// A stick from one point to another, for robots whose links have no shapes.
    pub(super) fn stick(a: Point3<f64>, b: Point3<f64>, radius_m: f64) -> Self {
        let along = b - a;
        let length_m = along.norm();
        if length_m <= 0.0 || !length_m.is_finite() {
            return Self::default();
        }
        let turn =
            nalgebra::Rotation3::rotation_between(&Vector3::z(), &along).unwrap_or_else(|| {
                nalgebra::Rotation3::from_axis_angle(&Vector3::x_axis(), std::f64::consts::PI)
            });
        let pose = Pose::from_parts(nalgebra::center(&a, &b).into(), turn);
        let half = 0.5 * length_m;
        let mut faces = Self::turned(&[(radius_m, -half), (radius_m, half)], 8, true);
        for (corners, _) in &mut faces.faces {
            corners
                .iter_mut()
                .for_each(|corner| *corner = pose * *corner);
        }
        faces
    }

    fn block([x, y, z]: [f64; 3]) -> Self {
        let corner = |i: usize| {
            let half = |bit: usize, size: f64| {
                if i & bit == 0 {
                    -0.5 * size
                } else {
                    0.5 * size
                }
            };
            Point3::new(half(1, x), half(2, y), half(4, z))
        };
        let sides = [
            [0, 2, 3, 1],
            [4, 5, 7, 6],
            [0, 1, 5, 4],
            [2, 6, 7, 3],
            [0, 4, 6, 2],
            [1, 3, 7, 5],
        ];
        let face = |side: [usize; 4]| (side.map(corner).to_vec(), vec![true; 4]);
        Self {
            faces: sides.into_iter().map(face).collect(),
            convex: true,
        }
    }

    /// A solid of revolution about z through `(radius, height)`, bottom to top, with flat ends.
    fn turned(profile: &[(f64, f64)], around: usize, rims: bool) -> Self {
        let ring = |(radius, height): (f64, f64)| -> Vec<Point3<f64>> {
            let corner = |i: usize| {
                let (s, c) = libm::sincos(std::f64::consts::TAU * i as f64 / around as f64);
                Point3::new(radius * c, radius * s, height)
            };
            (0..around).map(corner).collect()
        };
        let rings: Vec<Vec<Point3<f64>>> = profile.iter().copied().map(ring).collect();
        let mut faces = Vec::new();
        for pair in rings.windows(2) {
            for i in 0..around {
                let j = (i + 1) % around;
                let corners = vec![pair[0][i], pair[0][j], pair[1][j], pair[1][i]];
                faces.push((corners, vec![rims, false, rims, false]));
            }
        }
        if let (Some(bottom), Some(top)) = (rings.first(), rings.last()) {
            let edges = vec![rims; around];
            faces.push((bottom.iter().rev().copied().collect(), edges.clone()));
            faces.push((top.clone(), edges));
        }
        Self {
            faces,
            convex: true,
        }
    }

    fn surface(vertices: &[[f64; 3]], triangles: &[[u32; 3]], most: usize) -> Self {
        let (vertices, triangles) = thinned(vertices, triangles, most);
        let face = |triangle: &[u32; 3]| {
            let corners = triangle.map(|i| Point3::from(vertices[i as usize]));
            (corners.to_vec(), vec![false; 3])
        };
        Self {
            faces: triangles.iter().map(face).collect(),
            convex: false,
        }
    }

    /// Moves the faces to where their solid is. Faces without an area, or at no place, are left out.
    pub(super) fn place(&self, pose: &Pose, solid: usize, colour: Rgb, faces: &mut Vec<Face>) {
        for (corners, edges) in &self.faces {
            let corners: Vec<_> = corners.iter().map(|corner| pose * corner).collect();
            let Some(normal) = normal(&corners) else {
                continue;
            };
            faces.push(Face {
                corners,
                edges: edges.clone(),
                normal,
                solid,
                convex: self.convex,
                colour,
            });
        }
    }
}

/// The unit normal of a flat polygon, by Newell's sums; none where it has no area.
fn normal(corners: &[Point3<f64>]) -> Option<Vector3<f64>> {
    let first = corners.first()?;
    let mut sum = Vector3::zeros();
    for (i, a) in corners.iter().enumerate() {
        let b = &corners[(i + 1) % corners.len()];
        sum += (a - first).cross(&(b - first));
    }
    let length = sum.norm();
    (length.is_finite() && length > 1e-18).then(|| sum / length)
}

/// The profile of a capsule, or of a ball where the straight part has no length.
fn round(radius_m: f64, length_m: f64, detail: Detail) -> Vec<(f64, f64)> {
    let rings = (detail.around / 4).max(2);
    let quarter = |i: usize| {
        let (s, c) = libm::sincos(std::f64::consts::FRAC_PI_2 * i as f64 / rings as f64);
        (radius_m * s, radius_m * c)
    };
    // from pole to equator; the pole itself is a small flat face
    let cap = (0..=rings).map(|i| {
        let (radius, height) = quarter(i);
        (radius.max(0.02 * radius_m), height)
    });
    let bottom = cap.clone().map(|(r, h)| (r, -0.5 * length_m - h));
    let top = cap.rev().map(|(r, h)| (r, 0.5 * length_m + h));
    let skipped = usize::from(length_m <= 0.0);
    bottom.chain(top.skip(skipped)).collect()
}

/// Vertices and triangles over them.
type Surface = (Vec<[f64; 3]>, Vec<[u32; 3]>);

/// A surface of at most about `most` triangles: vertices in one cell of a grid become one.
///
/// Source: Rossignac and Borrel, *Multi-resolution 3D approximations* (1993).
fn thinned(vertices: &[[f64; 3]], triangles: &[[u32; 3]], most: usize) -> Surface {
    if triangles.len() <= most {
        return (vertices.to_vec(), triangles.to_vec());
    }
    let mut low = [f64::INFINITY; 3];
    let mut high = [f64::NEG_INFINITY; 3];
    for vertex in vertices {
        for k in 0..3 {
            low[k] = low[k].min(vertex[k]);
            high[k] = high[k].max(vertex[k]);
        }
    }
    let widest = (0..3).map(|k| high[k] - low[k]).fold(0.0, f64::max);
    // a closed surface through c cells a side crosses about 3 c^2 of them, with two triangles in each
    let mut cells = (most as f64 / 6.0).sqrt() * 2.0;
    loop {
        let size = (widest / cells).max(1e-12);
        let mut numbers: BTreeMap<[i64; 3], u32> = BTreeMap::new();
        let mut sums: Vec<([f64; 3], f64)> = Vec::new();
        let mut of_vertex = Vec::with_capacity(vertices.len());
        for vertex in vertices {
            let cell = [0, 1, 2].map(|k| ((vertex[k] - low[k]) / size).floor() as i64);
            let number = *numbers.entry(cell).or_insert_with(|| {
                sums.push(([0.0; 3], 0.0));
                sums.len() as u32 - 1
            });
            let (sum, count) = &mut sums[number as usize];
            (0..3).for_each(|k| sum[k] += vertex[k]);
            *count += 1.0;
            of_vertex.push(number);
        }
        let mut kept = BTreeSet::new();
        for triangle in triangles {
            let [a, b, c] = triangle.map(|i| of_vertex[i as usize]);
            if a != b && b != c && c != a {
                // the same triangle whichever corner is told first
                let least = a.min(b).min(c);
                kept.insert(match least {
                    _ if least == a => [a, b, c],
                    _ if least == b => [b, c, a],
                    _ => [c, a, b],
                });
            }
        }
        if kept.len() <= most || cells < 2.0 {
            let mean = |(sum, count): &([f64; 3], f64)| sum.map(|s| s / count);
            let kept = kept.into_iter().take(most).collect();
            return (sums.iter().map(mean).collect(), kept);
        }
        cells *= 0.75;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const DETAIL: Detail = Detail {
        around: 16,
        triangles: 200,
    };

    /// Every face looks away from the middle, and the faces close: their areas as vectors add up to nothing.
    fn closed(faces: &Faces) {
        let mut placed = Vec::new();
        faces.place(&Pose::identity(), 0, (0, 0, 0), &mut placed);
        let mut sum = Vector3::zeros();
        for face in &placed {
            let centre = face
                .corners
                .iter()
                .fold(Vector3::zeros(), |sum, p| sum + p.coords)
                / face.corners.len() as f64;
            assert!(centre.dot(&face.normal) > 0.0, "{face:?}");
            assert_eq!(face.corners.len(), face.edges.len());
            for i in 1..face.corners.len() - 1 {
                let [a, b, c] = [0, i, i + 1].map(|i| face.corners[i]);
                sum += (b - a).cross(&(c - a));
            }
        }
        assert!(sum.norm() < 1e-12, "{sum}");
    }

    #[test]
    fn solids_are_closed_and_look_outwards() {
        for solid in [
            Solid::Box {
                size_m: [1.0, 2.0, 3.0],
            },
            Solid::Cylinder {
                radius_m: 0.5,
                length_m: 2.0,
            },
            Solid::Capsule {
                radius_m: 0.5,
                length_m: 2.0,
            },
            Solid::Sphere { radius_m: 0.5 },
        ] {
            closed(&Faces::of(&solid, DETAIL));
        }
        for to in [Point3::new(0.0, 0.0, -1.0), Point3::new(1.0, 2.0, 3.0)] {
            closed(&Faces::stick(-to, to, 0.1));
        }
        assert!(
            Faces::stick(Point3::origin(), Point3::origin(), 0.1)
                .faces
                .is_empty()
        );
    }

    #[test]
    fn a_fine_mesh_is_thinned_and_keeps_its_extent() {
        // a wavy square of 20,000 triangles
        let n = 100u32;
        let mut vertices = Vec::new();
        for i in 0..=n {
            for j in 0..=n {
                let (x, y) = (f64::from(i) / 100.0, f64::from(j) / 100.0);
                vertices.push([x, y, 0.1 * libm::sin(7.0 * x)]);
            }
        }
        let mut triangles = Vec::new();
        for i in 0..n {
            for j in 0..n {
                let a = i * (n + 1) + j;
                triangles.push([a, a + n + 1, a + 1]);
                triangles.push([a + 1, a + n + 1, a + n + 2]);
            }
        }
        let (thin, faces) = thinned(&vertices, &triangles, 500);
        assert!((100..=500).contains(&faces.len()), "{}", faces.len());
        let reach = |k: usize| thin.iter().map(|v| v[k]).fold(0.0, f64::max);
        assert!(reach(0) > 0.9 && reach(1) > 0.9);
        assert_eq!(thinned(&vertices, &triangles, 500), (thin, faces));
    }
}
