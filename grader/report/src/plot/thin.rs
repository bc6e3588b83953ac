//! Thinning of a path in a plane: what a straight line shows as well is left out.

/// How far a line may lie beside a point that it leaves out \[px\].
const BESIDE: f64 = 0.15;
/// Points that are looked at together, which bounds the work of a path that is all corners.
const TOGETHER: usize = 400;

/// Leaves out the points that a straight line passes within `beside_most` of (Ramer 1972; Douglas and Peucker 1973).
fn straightened(piece: &[(f64, f64)], beside_most: f64) -> Vec<(f64, f64)> {
    if piece.len() < 3 {
        return piece.to_vec();
    }
    let mut kept = vec![false; piece.len()];
    kept[0] = true;
    kept[piece.len() - 1] = true;
    let mut spans = vec![(0, piece.len() - 1)];
    while let Some((from, to)) = spans.pop() {
        let farthest = (from + 1..to)
            .map(|i| (beside(piece[from], piece[to], piece[i]), i))
            .max_by(|a, b| a.0.total_cmp(&b.0));
        if let Some((distance, at)) = farthest
            && distance > beside_most
        {
            kept[at] = true;
            spans.extend([(from, at), (at, to)]);
        }
    }
    let points = piece.iter().zip(&kept).filter(|(_, kept)| **kept);
    points.map(|(point, _)| *point).collect()
}

/// Distance of a point from the segment between two others.
fn beside(a: (f64, f64), b: (f64, f64), point: (f64, f64)) -> f64 {
    let from_a = |p: (f64, f64)| (p.0 - a.0, p.1 - a.1);
    let ((bx, by), (px, py)) = (from_a(b), from_a(point));
    let length_squared = bx * bx + by * by;
    let along = if length_squared > 0.0 {
        ((px * bx + py * by) / length_squared).clamp(0.0, 1.0)
    } else {
        0.0
    };
    let (dx, dy) = (px - along * bx, py - along * by);
    (dx * dx + dy * dy).sqrt()
}

/// Thins points of a plane in pixels to about `most`: what a straight line passes within some tenths of a pixel is left out, and if too
/// many are left, within so much more as it takes. The first and the last point are always kept.
pub(super) fn in_plane(points: &[(f64, f64)], most: usize) -> Vec<(f64, f64)> {
    let mut kept = points.to_vec();
    let mut beside_most = BESIDE;
    loop {
        let mut straight: Vec<(f64, f64)> = Vec::new();
        let mut from = 0;
        while from < kept.len() {
            let to = (from + TOGETHER).min(kept.len());
            straight.extend(straightened(&kept[from..to], beside_most));
            from = to;
        }
        // where the parts meet, too many were kept
        kept = if straight.len() < 2 * TOGETHER {
            straightened(&straight, beside_most)
        } else {
            straight
        };
        if kept.len() <= most.max(2) || beside_most > 1e6 {
            return kept;
        }
        beside_most *= 1.5;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_path_keeps_its_ends() {
        let points: Vec<_> = (0..10_000)
            .map(|i| (f64::from(i) * 0.01, f64::from(i % 50)))
            .collect();
        let kept = in_plane(&points, 300);
        assert!(kept.len() <= 300, "{}", kept.len());
        assert_eq!((kept[0], *kept.last().unwrap()), (points[0], points[9_999]));
    }

    #[test]
    fn a_fast_arc_is_round() {
        // a quarter of a circle of 100 px in forty ticks, amid slow ones
        let arc = (0..=40).map(|i| libm::sincos(f64::from(i) * std::f64::consts::FRAC_PI_2 / 40.0));
        let arc: Vec<_> = arc.map(|(s, c)| (100.0 * s, 100.0 * c)).collect();
        let slow = (0..8000).map(|i| (100.0 + f64::from(i) * 0.01, 0.0));
        let points: Vec<_> = arc.iter().copied().chain(slow).collect();
        let kept = in_plane(&points, 1000);
        assert!(kept.len() < 40, "{}", kept.len());
        for point in arc {
            let near = kept.windows(2).map(|two| beside(two[0], two[1], point));
            assert!(near.fold(f64::INFINITY, f64::min) < 0.5);
        }
    }
}
