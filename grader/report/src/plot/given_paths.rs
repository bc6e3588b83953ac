//! The paths that were asked for, in the plane of the plot: dashed lines with their names, in the tubes of their bands.

use super::canvas::{Align, Canvas, Entry, Swatch};
use super::plane::Plane;
use super::scenery::clipped;
use super::view::View;
use crate::palette::{Colour, GREEN, GREEN_DASHED, INK, VERMILLION};
use crate::visible::shortened;
use kinemark_grader::record::graded::{AskedPath, TaskRun};

/// Paths that are drawn.
const MOST_PATHS: usize = 20;
/// A tube narrower than this to each side would not be seen \[px\].
const THINNEST: f64 = 0.7;
/// Corners of the half circle at each end of a tube's piece.
const ROUND: usize = 8;

/// A path in the plane.
struct Flat {
    name: String,
    points: Vec<(f64, f64)>,
    /// Radii of the tubes with their colours, the widest first \[m\].
    tubes: Vec<(f64, Colour)>,
}

/// All paths of a run, in the plane of its plot.
pub(super) struct GivenPaths(Vec<Flat>);

impl GivenPaths {
    pub(super) fn of(run: &TaskRun, plane: &Plane) -> Self {
        let flat = |path: &AskedPath| {
            let tubes = path.tube_m.map_or([0.0; 2], |[full, zero]| [zero, full]);
            let tubes = tubes.into_iter().zip([VERMILLION, GREEN]);
            Flat {
                name: shortened(&path.name, 24),
                points: path.points_m.iter().map(|p| plane.flat(p)).collect(),
                tubes: tubes
                    .filter(|(radius_m, _)| *radius_m > 0.0 && radius_m.is_finite())
                    .collect(),
            }
        };
        Self(run.paths.iter().take(MOST_PATHS).map(flat).collect())
    }

    /// Points that the view must hold.
    pub(super) fn extremes(&self) -> impl Iterator<Item = (f64, f64)> {
        self.0.iter().flat_map(|path| path.points.iter().copied())
    }

    pub(super) fn legend(&self, legend: &mut Vec<Entry>) {
        if self.0.is_empty() {
            return;
        }
        legend.push(Entry::new(Swatch::Line(GREEN_DASHED), "path asked for"));
        let tubes = self.0.iter().flat_map(|path| &path.tubes);
        if tubes.count() > 0 {
            legend.push(Entry::new(Swatch::Area(GREEN), "full points"));
            legend.push(Entry::new(Swatch::Area(VERMILLION), "partial points"));
        }
    }

    /// The tubes, which lie below all else.
    pub(super) fn tubes(&self, canvas: &mut Canvas, view: &View) {
        let (low, high) = ((view.x.min, view.y.min), (view.x.max, view.y.max));
        for path in &self.0 {
            for (radius_m, colour) in &path.tubes {
                if radius_m * view.pixels_per_m < THINNEST {
                    continue;
                }
                for ends in path.points.windows(2) {
                    let outline = stadium([ends[0], ends[1]], *radius_m);
                    let inside = clipped(&outline, low, high);
                    let points: Vec<_> = inside.iter().map(|p| view.at(*p)).collect();
                    canvas.polygon(&points, *colour, 0.13);
                }
            }
        }
    }

    /// The lines, each with its name at its first point.
    pub(super) fn lines(&self, canvas: &mut Canvas, view: &View) {
        for path in &self.0 {
            for piece in view.pieces(&path.points) {
                canvas.line(&piece, GREEN_DASHED, 1.8);
            }
            for point in path.points.iter().map(|p| view.at(*p)) {
                if view.clip(point, point).is_some() {
                    canvas.disc(point, 2.6, GREEN, 1.0);
                }
            }
        }
    }

    /// The names, above all else.
    pub(super) fn names(&self, canvas: &mut Canvas, view: &View) {
        for path in &self.0 {
            if let [first, second, ..] = path.points[..] {
                let (a, b) = (view.at(first), view.at(second));
                // beside the first point, on the side the path does not take
                let (dx, align) = if b.0 > a.0 {
                    (-9.0, Align::End)
                } else {
                    (9.0, Align::Start)
                };
                let dy = if b.1 > a.1 { -11.0 } else { 13.0 };
                canvas.text(&path.name, (a.0 + dx, a.1 + dy), align, INK);
            }
        }
    }
}

/// The outline of all points within `radius` of a segment.
fn stadium([a, b]: [(f64, f64); 2], radius: f64) -> Vec<(f64, f64)> {
    let (dx, dy) = (b.0 - a.0, b.1 - a.1);
    let heading = if dx == 0.0 && dy == 0.0 {
        0.0
    } else {
        libm::atan2(dy, dx)
    };
    let half = |centre: (f64, f64), start: f64| {
        (0..=ROUND).map(move |i| {
            let angle = start + std::f64::consts::PI * i as f64 / ROUND as f64;
            let (s, c) = libm::sincos(angle);
            (centre.0 + radius * c, centre.1 + radius * s)
        })
    };
    let quarter = std::f64::consts::FRAC_PI_2;
    half(b, heading - quarter)
        .chain(half(a, heading + quarter))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tube_is_as_wide_as_its_band_everywhere() {
        let ends = [(1.0, 2.0), (4.0, 6.0)];
        let outline = stadium(ends, 0.5);
        for p in &outline {
            // distance from the segment from (1, 2) to (4, 6), of length 5
            let t = ((p.0 - 1.0) * 0.6 + (p.1 - 2.0) * 0.8).clamp(0.0, 5.0);
            let (x, y) = (1.0 + 0.6 * t - p.0, 2.0 + 0.8 * t - p.1);
            assert!(((x * x + y * y).sqrt() - 0.5).abs() < 1e-12, "{p:?}");
        }
        assert!(
            stadium([(0.0, 0.0); 2], 1.0)
                .iter()
                .all(|p| p.0.is_finite())
        );
    }
}
