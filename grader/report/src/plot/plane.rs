//! The plane a path is drawn in: which two coordinates, and which way is up.

use super::axis::extent;

/// One axis of the plane: which coordinate, and whether it is drawn backwards.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Along {
    pub(super) coordinate: usize,
    pub(super) backwards: bool,
    /// Which way it points in the world, in a word.
    pub(super) toward: &'static str,
}

impl Along {
    pub(super) fn of(&self, p: &[f64; 3]) -> f64 {
        let value = p[self.coordinate];
        if self.backwards { -value } else { value }
    }

    /// Its letter.
    pub(super) fn letter(&self) -> &'static str {
        ["x", "y", "z"][self.coordinate]
    }

    pub(super) fn label(&self, unit: &str) -> String {
        let letter = self.letter();
        format!("{letter}{} [{unit}]", self.toward)
    }
}

/// The plane of a path.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Plane {
    pub(super) across: Along,
    pub(super) up: Along,
}

impl Plane {
    /// The two coordinates of greatest extent; the one that points up in the world is drawn upwards.
    pub(super) fn of(points: &[[f64; 3]], upward: [f64; 3]) -> Self {
        Self::showing(points, upward, None)
    }

    /// The same, but that the coordinate `shown` is among the two.
    pub(super) fn showing(points: &[[f64; 3]], upward: [f64; 3], shown: Option<usize>) -> Self {
        let span =
            |c: usize| extent(points.iter().map(|p| p[c])).map_or(0.0, |(min, max)| max - min);
        let spans = [span(0), span(1), span(2)];
        let mut others = [2, 1, 0].into_iter().filter(|c| Some(*c) != shown);
        let mut left_out = others.next().unwrap_or(2);
        for c in others {
            // a coordinate that only trembles is not preferred to one that does not move at all
            if spans[c] < spans[left_out] - 1e-9 {
                left_out = c;
            }
        }
        let kept: Vec<usize> = (0..3).filter(|c| *c != left_out).collect();
        let (first, second) = (kept[0], kept[1]);
        let (across, up) = if upward[first].abs() > upward[second].abs().max(0.5) {
            (second, first)
        } else {
            (first, second)
        };
        let along = |coordinate: usize, backwards: bool| Along {
            coordinate,
            backwards,
            toward: match upward[coordinate] {
                u if u > 0.999 => ", up",
                u if u < -0.999 => ", down",
                u if u.abs() < 1e-3 => ", sideways",
                _ => "",
            },
        };
        Self {
            across: along(across, false),
            up: along(up, upward[up] < -0.5),
        }
    }

    pub(super) fn flat(&self, p: &[f64; 3]) -> (f64, f64) {
        (self.across.of(p), self.up.of(p))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_lab_frame_is_drawn_x_up_and_y_to_the_right() {
        let points = [[4.0, 0.0, 0.05], [2.0, 1.4, 0.05], [2.0, -1.4, 0.05]];
        let plane = Plane::of(&points, [1.0, 0.0, 0.0]);
        assert_eq!((plane.up.coordinate, plane.across.coordinate), (0, 1));
        assert_eq!(plane.up.label("m"), "x, up [m]");
        assert_eq!(plane.across.label("m"), "y, sideways [m]");
        assert_eq!(plane.flat(&[4.0, 1.0, 0.0]), (1.0, 4.0));
    }

    #[test]
    fn a_level_plane_is_seen_from_above() {
        let points = [[0.0, 0.0, 0.5], [1.0, 2.0, 0.5]];
        let plane = Plane::of(&points, [0.0, 0.0, 1.0]);
        assert_eq!((plane.up.coordinate, plane.across.coordinate), (1, 0));
    }

    #[test]
    fn an_axis_that_points_down_is_drawn_backwards() {
        let points = [[0.0, 0.0, 0.0], [1.0, 0.0, 2.0]];
        let plane = Plane::of(&points, [0.0, 0.0, -1.0]);
        assert_eq!(plane.flat(&[1.0, 0.0, 2.0]), (1.0, -2.0));
        assert_eq!(plane.up.label("m"), "z, down [m]");
    }
}
