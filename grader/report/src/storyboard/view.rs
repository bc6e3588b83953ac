//! Which part of the world a panel shows, and how large: the same in all panels, so that they can be compared.

use nalgebra::Point3;

use super::camera::Camera;
use super::scenery::{Scenery, finite};
use super::{PANEL, Panel};

/// Height of the view in a panel lies between these \[px\].
const LOWEST: f64 = 200.0;
const HIGHEST: f64 = 340.0;
/// Air around what is shown \[px\].
const AIR: f64 = 16.0;
/// What is farther from the middle of the start than this many times its size is not shown.
const FAR: f64 = 1.5;

/// From metres to the pixels of a panel, the same in all panels.
#[derive(Debug, Clone, Copy)]
pub(super) struct View {
    /// Middle of what is shown, in the plane of the picture \[m\].
    middle: (f64, f64),
    pixels_per_m: f64,
    pub(super) height: f64,
    /// Size of what is shown \[m\].
    pub(super) size_m: f64,
    /// Least and greatest corner of what is shown, in the world \[m\].
    pub(super) low: Point3<f64>,
    pub(super) high: Point3<f64>,
}

impl View {
    pub(super) fn around(camera: &Camera, panels: &[Panel], scenery: &Scenery) -> Self {
        let of_panel = |panel: &Panel| {
            let corners = panel.faces.iter().flat_map(|face| face.corners.clone());
            let joints = panel.joints.iter().chain([&panel.tcp]);
            let seen = joints.chain(panel.aims.iter().flatten()).copied();
            corners.chain(seen).collect::<Vec<_>>()
        };
        let lines = scenery.paths.iter().flatten();
        let mut kept: Vec<Point3<f64>> = panels.first().map(of_panel).unwrap_or_default();
        kept.extend(scenery.goals.iter().chain(&scenery.reference).chain(lines));
        kept.retain(finite);
        let bounds = |points: &[Point3<f64>]| {
            let first = points.first().copied().unwrap_or_else(Point3::origin);
            let fold = |(low, high): (Point3<f64>, Point3<f64>), p: &Point3<f64>| {
                (low.inf(p), high.sup(p))
            };
            points.iter().fold((first, first), fold)
        };
        let (low, high) = bounds(&kept);
        let (centre, reach) = (nalgebra::center(&low, &high), FAR * (high - low).norm());
        let near = |p: &Point3<f64>| (p - centre).norm() <= reach.max(0.5);
        let later = panels.iter().skip(1).flat_map(of_panel);
        kept.extend(later.chain(scenery.trail.iter().copied()).filter(near));
        let (low, high) = bounds(&kept);
        let flat: Vec<(f64, f64)> = kept.iter().map(|p| camera.flat(p)).collect();
        let span = |of: fn(&(f64, f64)) -> f64| {
            let values = flat.iter().map(of);
            let least = values.clone().fold(f64::INFINITY, f64::min);
            let greatest = values.fold(f64::NEG_INFINITY, f64::max);
            if least <= greatest {
                (0.5 * (least + greatest), (greatest - least).max(0.02))
            } else {
                (0.0, 1.0)
            }
        };
        let ((x, w), (y, h)) = (span(|p| p.0), span(|p| p.1));
        let across = PANEL - 2.0 * AIR;
        let pixels_per_m = (across / w).min((HIGHEST - 2.0 * AIR) / h);
        Self {
            middle: (x, y),
            pixels_per_m,
            height: (h * pixels_per_m + 2.0 * AIR)
                .clamp(LOWEST, HIGHEST)
                .round(),
            size_m: (high - low).norm().max(0.02),
            low,
            high,
        }
    }

    /// Where a point of the picture's plane is in a panel whose upper left corner is `corner`.
    pub(super) fn at(&self, (x, y): (f64, f64), corner: (f64, f64)) -> (f64, f64) {
        let px = corner.0 + 0.5 * PANEL + (x - self.middle.0) * self.pixels_per_m;
        let py = corner.1 + 0.5 * self.height - (y - self.middle.1) * self.pixels_per_m;
        (px.clamp(-5e3, 5e3), py.clamp(-5e3, 5e3))
    }

    /// Height of the ground: zero, unless everything is far above it or something is below.
    pub(super) fn floor_m(&self) -> f64 {
        let low = self.low.z;
        if low >= -0.02 * self.size_m && low <= 0.3 * self.size_m {
            low.min(0.0)
        } else {
            low
        }
    }

    /// Distance between lines of the grid: about nine over what is shown.
    pub(super) fn grid_m(&self) -> f64 {
        round_step(self.size_m / 9.0)
    }
}

/// The next of 1, 2, 5, 10 … times a power of ten that is not below `step`.
fn round_step(step: f64) -> f64 {
    let unit = libm::pow(10.0, libm::floor(libm::log10(step.max(1e-6))));
    let times = [1.0, 2.0, 5.0]
        .into_iter()
        .find(|times| times * unit >= step);
    times.unwrap_or(10.0) * unit
}
