//! Meshes with fewer triangles.

use std::collections::{BTreeMap, BTreeSet};

/// Vertices and triangles over them.
type Triangulation = (Vec<[f64; 3]>, Vec<[u32; 3]>);

/// A surface of at most about `most` triangles: vertices in one cell of a grid become one.
///
/// Source: Rossignac and Borrel, *Multi-resolution 3D approximations* (1993).
pub(super) fn thinned(vertices: &[[f64; 3]], triangles: &[[u32; 3]], most: usize) -> Triangulation {
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
                // the same triangle whichever corner comes first
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
