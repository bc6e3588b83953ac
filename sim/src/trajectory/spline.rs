//! Spline: one axis through via points at given times, position, velocity and acceleration continuous.

use super::axis::{Knot, Sample, Trajectory};
use super::cubic::Cubic;
use super::trajectory_error::{TrajectoryError, count, finite, in_range};

/// Boundary conditions of a [`Spline`] at its two ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum SplineEnds {
    /// Clamped: given velocities \[rad/s or m/s\]; both zero for a motion from rest to rest.
    Clamped {
        /// Velocity at the first point.
        start_velocity: f64,
        /// Velocity at the last point.
        end_velocity: f64,
    },
    /// Natural: zero acceleration at both ends; the velocities follow.
    Natural,
}

impl SplineEnds {
    /// From rest to rest.
    pub const AT_REST: Self = Self::Clamped {
        start_velocity: 0.0,
        end_velocity: 0.0,
    };
}

/// A cubic between each pair of successive via points, twice continuously differentiable at all of them.
#[derive(Debug, Clone, PartialEq)]
pub struct Spline {
    times_s: Vec<f64>,
    /// One cubic between each pair of successive via points: one less than times, and at least one.
    pieces: Vec<Cubic>,
}

impl Spline {
    /// The spline through `positions` \[rad or m\], shape `(m)`, at `times_s`, shape `(m)`; the first time is 0, and `m >=
    /// 2`.
    ///
    /// Two points with clamped ends are one [`Cubic`]; two points with natural ends are a straight line.
    ///
    /// # Errors
    /// `TooFew` below two points, `WrongCount` where the lists differ in length, `FirstTimeNotZero`, `TimesNotIncreasing`,
    /// `NotFinite`, and `OutOfRange` where accelerations leave the range of numbers.
    ///
    /// Source: Biagiotti & Melchiorri, *Trajectory Planning for Automatic Machines and Robots* (2008), sec. 4.4, solved
    /// for the velocities; the natural ends are `2 v₀ + v₁ = 3 (p₁ - p₀) / h₀` and its mirror.
    pub fn through(
        times_s: &[f64],
        positions: &[f64],
        ends: SplineEnds,
    ) -> Result<Self, TrajectoryError> {
        check_times(times_s)?;
        count("positions of via points", positions.len(), times_s.len())?;
        for &position in positions {
            finite("position of a via point", position)?;
        }
        let steps_s: Vec<f64> = times_s.windows(2).map(|pair| pair[1] - pair[0]).collect();
        let slopes: Vec<f64> = positions
            .windows(2)
            .zip(&steps_s)
            .map(|(pair, step_s)| in_range("mean velocity", (pair[1] - pair[0]) / step_s))
            .collect::<Result<_, _>>()?;
        let velocities = knot_velocities(&steps_s, &slopes, ends)?;
        let knots: Vec<Knot> = positions
            .iter()
            .zip(&velocities)
            .map(|(&position, &velocity)| Knot { position, velocity })
            .collect();
        let pieces = knots
            .windows(2)
            .zip(&steps_s)
            .map(|(pair, &step_s)| Cubic::between(pair[0], pair[1], step_s))
            .collect::<Result<_, _>>()?;
        Ok(Self {
            times_s: times_s.to_vec(),
            pieces,
        })
    }

    /// The times of the via points \[s\].
    pub fn times_s(&self) -> &[f64] {
        &self.times_s
    }
}

fn check_times(times_s: &[f64]) -> Result<(), TrajectoryError> {
    if times_s.len() < 2 {
        return Err(TrajectoryError::TooFew {
            what: "via points",
            got: times_s.len(),
            least: 2,
        });
    }
    if finite("time of a via point", times_s[0])? != 0.0 {
        return Err(TrajectoryError::FirstTimeNotZero { got_s: times_s[0] });
    }
    for (before, pair) in times_s.windows(2).enumerate() {
        if finite("time of a via point", pair[1])? <= pair[0] {
            return Err(TrajectoryError::TimesNotIncreasing {
                index: before + 1,
                got_s: pair[1],
                previous_s: pair[0],
            });
        }
    }
    Ok(())
}

/// The velocities at the via points that make acceleration continuous; each row of the system is scaled to a diagonal of 2.
fn knot_velocities(
    steps_s: &[f64],
    slopes: &[f64],
    ends: SplineEnds,
) -> Result<Vec<f64>, TrajectoryError> {
    let pieces = steps_s.len();
    let (first, last) = match ends {
        SplineEnds::Clamped {
            start_velocity,
            end_velocity,
        } => (
            // 2 v = 2 v_given
            (0.0, 2.0 * finite("start velocity", start_velocity)?),
            (0.0, 2.0 * finite("end velocity", end_velocity)?),
        ),
        SplineEnds::Natural => ((1.0, 3.0 * slopes[0]), (1.0, 3.0 * slopes[pieces - 1])),
    };

    // forward sweep of the tridiagonal system: v[i] = right[i] - upper[i] v[i + 1]
    let mut upper = vec![0.5 * first.0];
    let mut right = vec![0.5 * first.1];
    for i in 1..pieces {
        // h[i] v[i-1] + 2 (h[i-1] + h[i]) v[i] + h[i-1] v[i+1] = 3 (h[i] m[i-1] + h[i-1] m[i]), divided by h[i-1] + h[i]
        let weight = steps_s[i] / (steps_s[i - 1] + steps_s[i]);
        let diagonal = 2.0 - weight * upper[i - 1];
        let sum = 3.0 * (weight * slopes[i - 1] + (1.0 - weight) * slopes[i]);
        upper.push((1.0 - weight) / diagonal);
        right.push((sum - weight * right[i - 1]) / diagonal);
    }
    let (lower, sum) = last;
    right.push((sum - lower * right[pieces - 1]) / (2.0 - lower * upper[pieces - 1]));

    // back substitution
    for i in (0..pieces).rev() {
        right[i] -= upper[i] * right[i + 1];
    }
    for &velocity in &right {
        in_range("velocity at a via point", velocity)?;
    }
    Ok(right)
}

impl Trajectory for Spline {
    type Sample = Sample;

    fn duration_s(&self) -> f64 {
        self.times_s[self.pieces.len()]
    }

    fn at(&self, t_s: f64) -> Sample {
        if t_s > self.duration_s() {
            return self.pieces[self.pieces.len() - 1].at(f64::INFINITY);
        }
        // the piece that starts at or before this time; the last one at the end, where its own duration is hit exactly
        let after = self.times_s.partition_point(|&time_s| time_s <= t_s);
        let piece = after.saturating_sub(1).min(self.pieces.len() - 1);
        self.pieces[piece].at(t_s - self.times_s[piece])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn three_points_agree_with_the_hand_solution() {
        // h = 1, 2; slopes 1 and -1/2; clamped at rest: 6 v = 3 (2 · 1 + 1 · (-1/2)), v = 3/4
        let spline = Spline::through(&[0.0, 1.0, 3.0], &[0.0, 1.0, 0.0], SplineEnds::AT_REST);
        let spline = spline.unwrap();
        let knot = spline.at(1.0);
        assert_eq!(knot.position, 1.0);
        // thirds are not exact: a few roundings of numbers up to 6
        assert!((knot.velocity - 0.75).abs() < 1e-15);
        // left: 6 · (0 - 1) + 4 · 3/4 = -3; right: (6 · (0 - 1) - 4 · 2 · 3/4) / 4 = -3
        assert!((knot.acceleration + 3.0).abs() < 1e-14);
        // 6 · 1 - 2 · 3/4
        assert!((spline.at(0.0).acceleration - 4.5).abs() < 1e-14);
        assert_eq!(spline.duration_s(), 3.0);
        assert_eq!(spline.at(3.0).position, 0.0);
    }

    #[test]
    fn natural_ends_do_not_accelerate() {
        // 0, 1, 0 at equal steps: v = 3/2, 0, -3/2; the middle acceleration is -3
        let spline = Spline::through(&[0.0, 1.0, 2.0], &[0.0, 1.0, 0.0], SplineEnds::Natural);
        let spline = spline.unwrap();
        assert!((spline.at(0.0).velocity - 1.5).abs() < 1e-15);
        assert!(spline.at(0.0).acceleration.abs() < 1e-14);
        assert!((spline.at(1.0).acceleration + 3.0).abs() < 1e-14);
        assert!(spline.at(2.0).acceleration.abs() < 1e-14);
        let line = Spline::through(&[0.0, 2.0], &[1.0, 2.0], SplineEnds::Natural).unwrap();
        assert_eq!(line.at(1.0).velocity, 0.5);
    }

    #[test]
    fn two_points_are_one_cubic() {
        let ends = SplineEnds::Clamped {
            start_velocity: 1.0,
            end_velocity: -0.5,
        };
        let spline = Spline::through(&[0.0, 0.7], &[0.2, 0.9], ends).unwrap();
        let start = Knot {
            position: 0.2,
            velocity: 1.0,
        };
        let end = Knot {
            position: 0.9,
            velocity: -0.5,
        };
        let cubic = Cubic::between(start, end, 0.7).unwrap();
        for t_s in [-1.0, 0.0, 0.3, 0.7, 2.0] {
            assert_eq!(spline.at(t_s), cubic.at(t_s));
        }
        assert!(spline.at(f64::NAN).position.is_nan());
    }

    #[test]
    fn a_cubic_is_its_own_spline() {
        let position = |t: f64| 1.0 + t * (-2.0 + t * (0.5 + t));
        let velocity = |t: f64| -2.0 + t * (1.0 + 3.0 * t);
        let times_s = [0.0, 0.25, 1.0, 1.5, 2.0];
        let ends = SplineEnds::Clamped {
            start_velocity: velocity(0.0),
            end_velocity: velocity(2.0),
        };
        let spline = Spline::through(&times_s, &times_s.map(position), ends).unwrap();
        for t_s in [0.1, 0.25, 0.8, 1.2, 1.9] {
            // positions up to 7, a dozen operations
            assert!((spline.at(t_s).position - position(t_s)).abs() < 1e-13);
            assert!((spline.at(t_s).velocity - velocity(t_s)).abs() < 1e-13);
        }
    }

    #[test]
    fn wrong_points_are_reported() {
        let text = |times_s: &[f64], positions: &[f64]| {
            Spline::through(times_s, positions, SplineEnds::AT_REST)
                .unwrap_err()
                .to_string()
        };
        assert_eq!(
            text(&[0.0], &[1.0]),
            "at least 2 via points are needed, got 1"
        );
        assert_eq!(text(&[], &[]), "at least 2 via points are needed, got 0");
        assert_eq!(
            text(&[0.0, 2.0, 1.5], &[1.0, 2.0, 3.0]),
            "times of via points must increase: point 2 (from 0) is at 1.5 s, the one before at 2 s"
        );
        assert_eq!(
            text(&[0.5, 2.0], &[1.0, 2.0]),
            "the first via point must be at 0 s, got 0.5 s: count time from the first point"
        );
        assert_eq!(
            text(&[0.0, 2.0], &[1.0]),
            "positions of via points: expected 2 values, got 1"
        );
        assert_eq!(
            text(&[0.0, f64::NAN], &[1.0, 2.0]),
            "time of a via point must be a finite number, got NaN"
        );
    }
}
