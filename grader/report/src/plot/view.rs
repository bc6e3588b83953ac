//! A view of a plane, the same scale both ways: its grid, and what of a path lies in it.

use super::axis::{Axis, extent};
use super::canvas::{Align, Canvas, WIDTH};
use super::plane::Plane;
use crate::palette::{FRAME, GRID, MUTED};

/// Left and right edge of a view of full width \[px\].
pub(super) const LEFT: f64 = 68.0;
pub(super) const RIGHT: f64 = WIDTH - 20.0;
/// Its height lies between these \[px\].
const LOWEST: f64 = 200.0;
const HIGHEST: f64 = 420.0;

/// A view of the plane: metres to pixels, the same scale both ways.
#[derive(Debug, Clone, Copy)]
pub(super) struct View {
    pub(super) x: Axis,
    pub(super) y: Axis,
    pub(super) left: f64,
    pub(super) top: f64,
    pub(super) pixels_per_m: f64,
}

impl View {
    pub(super) fn width(&self) -> f64 {
        (self.x.max - self.x.min) * self.pixels_per_m
    }

    pub(super) fn height(&self) -> f64 {
        (self.y.max - self.y.min) * self.pixels_per_m
    }

    pub(super) fn at(&self, (x, y): (f64, f64)) -> (f64, f64) {
        let x = self.left + (x - self.x.min) * self.pixels_per_m;
        let y = self.top + (self.y.max - y) * self.pixels_per_m;
        (x.clamp(-5e3, 5e3), y.clamp(-5e3, 5e3))
    }

    /// Holds all points with air around them, in a frame of full width.
    pub(super) fn around(points: &[(f64, f64)], top: f64) -> Self {
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

    /// Grid, ticks and frame; `scale` and `zero` turn metres into what the labels show.
    pub(super) fn ground(&self, canvas: &mut Canvas, zero: (f64, f64), scale: f64, plane: &Plane) {
        let (w, h) = (self.width(), self.height());
        let (right, bottom) = (self.left + w, self.top + h);
        let label_axis = |axis: &Axis, zero: f64| {
            Axis::exact((axis.min - zero) * scale, (axis.max - zero) * scale)
        };
        let minus = |label: &str| match label.strip_prefix('\u{2212}') {
            Some(rest) => rest.to_owned(),
            None if label.trim_matches(['0', '.']).is_empty() => label.to_owned(),
            None => format!("\u{2212}{label}"),
        };
        for tick in label_axis(&self.x, zero.0).ticks(((w / 66.0) as usize).max(4)) {
            let x = self.at((zero.0 + tick.value / scale, 0.0)).0;
            canvas.line(&[(x, self.top), (x, bottom)], GRID, 1.0);
            canvas.text(&tick.label, (x, bottom + 13.0), Align::Middle, MUTED);
        }
        for tick in label_axis(&self.y, zero.1).ticks(((h / 44.0) as usize).max(4)) {
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

    pub(super) fn frame(&self, canvas: &mut Canvas) {
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
    pub(super) fn clip(&self, a: (f64, f64), b: (f64, f64)) -> Option<[(f64, f64); 2]> {
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
        // an end that is not cut stays the same number, by which the next segment is joined to it
        let start = if from > 0.0 { on(from) } else { a };
        let end = if to < 1.0 { on(to) } else { b };
        (from <= to).then_some([start, end])
    }

    /// The pieces of a path that lie in the frame, in pixels.
    pub(super) fn pieces(&self, path: &[(f64, f64)]) -> Vec<Vec<(f64, f64)>> {
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_path_inside_the_frame_is_one_piece() {
        let path: Vec<(f64, f64)> = (0..2000)
            .map(|i| libm::sincos(f64::from(i) * 0.0045))
            .collect();
        let view = View::around(&path, 30.0);
        let pieces = view.pieces(&path);
        assert_eq!(pieces.iter().map(Vec::len).collect::<Vec<_>>(), [2000]);
        // what leaves the frame is cut at its edge
        let half = View {
            x: Axis::exact(0.0, view.x.max),
            left: view.left,
            ..view
        };
        let pieces = half.pieces(&path);
        assert_eq!(pieces.len(), 2);
        assert!(pieces.iter().flatten().all(|p| p.0 >= half.left - 1e-9));
    }
}
