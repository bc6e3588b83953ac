//! The flat faces of a solid, in its own frame.

use nalgebra::Point3;

use super::surface::Surface;
use super::thinned::thinned;

/// A flat convex face: its corners, counter-clockwise seen from outside \[m\], and whether the edge from each corner to the next is an
/// edge of the solid, to be drawn as a line.
pub(crate) type FlatFace = (Vec<Point3<f64>>, Vec<bool>);

/// The faces of a solid.
#[derive(Debug, Clone, Default)]
pub(crate) struct Faces {
    /// The faces.
    pub(crate) faces: Vec<FlatFace>,
    /// Whether the solid is convex and closed: none of its faces that are seen hides another.
    pub(crate) is_convex: bool,
}

/// How finely round solids and meshes are drawn.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Detail {
    /// Faces around a round solid, a multiple of four.
    pub(crate) around: usize,
    /// Triangles of a mesh.
    pub(crate) triangles: usize,
}

impl Faces {
    /// Faces of a solid that is convex and closed.
    pub(super) fn convex(faces: Vec<FlatFace>) -> Self {
        Self {
            faces,
            is_convex: true,
        }
    }

    /// A solid of revolution about z through `(radius, height)`, bottom to top, with flat ends.
    pub(crate) fn turned(profile: &[(f64, f64)], around: usize, rims: bool) -> Self {
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
        Self::convex(faces)
    }

    /// A capsule along z, or a ball where the straight part has no length.
    pub(super) fn round(radius_m: f64, length_m: f64, detail: Detail) -> Self {
        let profile = round_profile(radius_m, length_m, detail.around);
        Self::turned(&profile, detail.around, false)
    }

    /// The triangles of a mesh, about `most` of them where it has more.
    pub(super) fn thinned(vertices: &[[f64; 3]], triangles: &[[u32; 3]], most: usize) -> Self {
        let (vertices, triangles) = thinned(vertices, triangles, most);
        let face = |triangle: &[u32; 3]| {
            let corners = triangle.map(|i| Point3::from(vertices[i as usize]));
            (corners.to_vec(), vec![false; 3])
        };
        Self {
            faces: triangles.iter().map(face).collect(),
            is_convex: false,
        }
    }

    /// The corners of all faces.
    pub(super) fn corners(&self) -> impl Iterator<Item = Point3<f64>> {
        self.faces
            .iter()
            .flat_map(|(corners, _)| corners.iter().copied())
    }

    /// All faces as triangles.
    pub(super) fn surface(&self) -> Surface {
        let (mut vertices, mut triangles) = (Vec::new(), Vec::new());
        for (corners, _) in &self.faces {
            let first = vertices.len() as u32;
            vertices.extend(corners.iter().map(|p| [p.x, p.y, p.z]));
            let fan = 1..(corners.len() as u32).saturating_sub(1);
            triangles.extend(fan.map(|i| [first, first + i, first + i + 1]));
        }
        Surface::Made {
            vertices,
            triangles,
        }
    }

    /// Every face looks away from the middle, and the faces close: their areas as vectors add up to nothing.
    #[cfg(test)]
    pub(crate) fn assert_closed(&self) {
        use nalgebra::Vector3;
        let mut sum = Vector3::zeros();
        for (corners, edges) in &self.faces {
            let mut area = Vector3::zeros();
            for i in 1..corners.len() - 1 {
                let [a, b, c] = [0, i, i + 1].map(|i| corners[i]);
                area += (b - a).cross(&(c - a));
            }
            let centre = corners
                .iter()
                .fold(Vector3::zeros(), |sum, p| sum + p.coords)
                / corners.len() as f64;
            assert!(centre.dot(&area) > 0.0, "{corners:?}");
            assert_eq!(corners.len(), edges.len());
            sum += area;
        }
        assert!(sum.norm() < 1e-12, "{sum}");
    }
}

/// The profile of a capsule, or of a ball where the straight part has no length.
fn round_profile(radius_m: f64, length_m: f64, around: usize) -> Vec<(f64, f64)> {
    let rings = (around / 4).max(2);
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
