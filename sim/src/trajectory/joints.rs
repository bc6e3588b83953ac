//! Several axes that start and end together: a motion of all joints.

use super::axis::{Knot, RestToRest, Sample, Trajectory};
use super::cubic::Cubic;
use super::quintic::Quintic;
use super::spline::{Spline, SplineEnds};
use super::trajectory_error::{TrajectoryError, count};
use crate::joint_space::{JointAccelerations, JointPositions, JointVelocities};

/// Positions, velocities and accelerations of all joints, shape `(n)` each.
#[derive(Debug, Clone, PartialEq)]
pub struct JointSample {
    /// Positions.
    pub q: JointPositions,
    /// Velocities.
    pub qd: JointVelocities,
    /// Accelerations.
    pub qdd: JointAccelerations,
}

impl JointSample {
    /// At `q`, not moving.
    pub fn at_rest(q: JointPositions) -> Self {
        let n = q.len();
        Self {
            q,
            qd: JointVelocities::zeros(n),
            qdd: JointAccelerations::zeros(n),
        }
    }

    fn counted(&self, n: usize) -> Result<(), TrajectoryError> {
        count("joint positions", self.q.len(), n)?;
        count("joint velocities", self.qd.len(), n)?;
        count("joint accelerations", self.qdd.len(), n)
    }

    fn axis(&self, i: usize) -> Sample {
        Sample {
            position: self.q.as_slice()[i],
            velocity: self.qd.as_slice()[i],
            acceleration: self.qdd.as_slice()[i],
        }
    }
}

/// One trajectory an axis, in joint order, all ending at the same time.
#[derive(Debug, Clone, PartialEq)]
pub struct JointTrajectory<A> {
    axes: Vec<A>,
    duration_s: f64,
}

impl<A: Trajectory<Sample = Sample>> JointTrajectory<A> {
    /// Synchronizes all axes: they start and end together, with the duration of the slowest.
    ///
    /// A faster axis is slowed down: with `k` its own duration over the common one, its speed is scaled by `k`, its acceleration by `k²`
    /// and its jerk by `k³`, so that it still keeps its limits. Velocities at the ends are scaled as well: give axes with such velocities
    /// equal durations.
    ///
    /// # Errors
    /// `TooFew` without any axis.
    pub fn together(axes: Vec<A>) -> Result<Self, TrajectoryError> {
        if axes.is_empty() {
            return Err(TrajectoryError::TooFew {
                what: "axes",
                got: 0,
                least: 1,
            });
        }
        let duration_s = axes
            .iter()
            .fold(0.0, |t: f64, axis| t.max(axis.duration_s()));
        Ok(Self { axes, duration_s })
    }

    /// The trajectories of the axes, in joint order, each with its own duration.
    pub fn axes(&self) -> &[A] {
        &self.axes
    }

    fn axis_at(&self, axis: &A, t_s: f64) -> Sample {
        if t_s < 0.0 {
            return axis.at(f64::NEG_INFINITY);
        }
        if t_s > self.duration_s {
            return axis.at(f64::INFINITY);
        }
        let own_s = axis.duration_s();
        // the slowest axis keeps its own time; so do all axes if none moves and all durations are zero
        if own_s >= self.duration_s {
            return axis.at(t_s);
        }
        let k = own_s / self.duration_s;
        // rounding must not move it past its end or leave it short of it; NaN stays NaN
        let own_t_s = if t_s >= self.duration_s || t_s * k > own_s {
            own_s
        } else {
            t_s * k
        };
        let sample = axis.at(own_t_s);
        Sample {
            position: sample.position,
            velocity: sample.velocity * k,
            acceleration: sample.acceleration * k * k,
        }
    }
}

impl<A: RestToRest> JointTrajectory<A> {
    /// Moves all joints from rest at `from` to rest at `to`, shape `(n)`, each under its own limits, shape `(n)`.
    ///
    /// # Errors
    /// `TooFew` without joints, `WrongCount` where shapes differ, and what the axes refuse.
    pub fn rest_to_rest(
        from: &JointPositions,
        to: &JointPositions,
        limits: &[A::Limits],
    ) -> Result<Self, TrajectoryError> {
        count("joint positions at the end", to.len(), from.len())?;
        count("limits of the joints", limits.len(), from.len())?;
        let ends = from.as_slice().iter().zip(to.as_slice());
        Self::together(
            ends.zip(limits)
                .map(|((&start, &end), limits)| A::rest_to_rest(start, end, limits))
                .collect::<Result<_, _>>()?,
        )
    }
}

impl JointTrajectory<Cubic> {
    /// Cubics between two configurations with velocities, shape `(n)`, in `duration_s`; accelerations in the samples are
    /// not used.
    ///
    /// # Errors
    /// `TooFew` without joints, `WrongCount` where shapes differ, and what [`Cubic::between`] refuses.
    pub fn between(
        start: &JointSample,
        end: &JointSample,
        duration_s: f64,
    ) -> Result<Self, TrajectoryError> {
        let n = start.q.len();
        start.counted(n)?;
        end.counted(n)?;
        let knot = |sample: Sample| Knot {
            position: sample.position,
            velocity: sample.velocity,
        };
        Self::together(
            (0..n)
                .map(|i| Cubic::between(knot(start.axis(i)), knot(end.axis(i)), duration_s))
                .collect::<Result<_, _>>()?,
        )
    }
}

impl JointTrajectory<Quintic> {
    /// Quintics between two full states, shape `(n)`, in `duration_s`.
    ///
    /// # Errors
    /// `TooFew` without joints, `WrongCount` where shapes differ, and what [`Quintic::between`] refuses.
    pub fn between(
        start: &JointSample,
        end: &JointSample,
        duration_s: f64,
    ) -> Result<Self, TrajectoryError> {
        let n = start.q.len();
        start.counted(n)?;
        end.counted(n)?;
        Self::together(
            (0..n)
                .map(|i| Quintic::between(start.axis(i), end.axis(i), duration_s))
                .collect::<Result<_, _>>()?,
        )
    }
}

impl JointTrajectory<Spline> {
    /// Splines from rest to rest through `points`, shape `(m)` of `(n)`, at `times_s`, shape `(m)`.
    ///
    /// # Errors
    /// `TooFew` without joints or below two points, `WrongCount` where shapes differ, and what [`Spline::through`] refuses.
    pub fn through(times_s: &[f64], points: &[JointPositions]) -> Result<Self, TrajectoryError> {
        let n = points.first().map_or(0, JointPositions::len);
        for point in points {
            count("joint positions of a via point", point.len(), n)?;
        }
        Self::together(
            (0..n)
                .map(|i| {
                    let axis: Vec<f64> = points.iter().map(|point| point.as_slice()[i]).collect();
                    Spline::through(times_s, &axis, SplineEnds::AT_REST)
                })
                .collect::<Result<_, _>>()?,
        )
    }
}

impl<A: Trajectory<Sample = Sample>> Trajectory for JointTrajectory<A> {
    type Sample = JointSample;

    fn duration_s(&self) -> f64 {
        self.duration_s
    }

    fn at(&self, t_s: f64) -> JointSample {
        let samples: Vec<Sample> = self
            .axes
            .iter()
            .map(|axis| self.axis_at(axis, t_s))
            .collect();
        JointSample {
            q: JointPositions::new(samples.iter().map(|sample| sample.position)),
            qd: JointVelocities::new(samples.iter().map(|sample| sample.velocity)),
            qdd: JointAccelerations::new(samples.iter().map(|sample| sample.acceleration)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::trajectory::axis::Limits;
    use crate::trajectory::trapezoid::Trapezoid;

    const LIMITS: Limits = Limits {
        speed: 1.0,
        acceleration: 1.0,
    };

    #[test]
    fn the_faster_axis_waits_for_the_slower() {
        // 3 m: 1 + 2 + 1 = 4 s; 0.25 m alone: 1 s, so four times slower: half way at 2 s with 0.5 / 4 m/s
        let from = JointPositions::new([0.0, 0.1, 0.7]);
        let to = JointPositions::new([3.0, -0.15, 0.7]);
        let motion = JointTrajectory::<Trapezoid>::rest_to_rest(&from, &to, &[LIMITS; 3]).unwrap();
        assert_eq!(motion.duration_s(), 4.0);
        let middle = motion.at(2.0);
        assert!((middle.q.as_slice()[1] + 0.025).abs() < 1e-15);
        assert!((middle.qd.as_slice()[1] + 0.125).abs() < 1e-15);
        assert_eq!(middle.q.as_slice()[2], 0.7);
        assert!((motion.at(1.0).qdd.as_slice()[1] + 1.0 / 16.0).abs() < 1e-15);
        assert_eq!(motion.at(0.0).q, from);
        assert_eq!(motion.at(4.0).q, to);
        assert_eq!(motion.at(5.0), JointSample::at_rest(to));
        assert_eq!(motion.at(f64::NEG_INFINITY), JointSample::at_rest(from));
        assert!(motion.at(f64::NAN).q.as_slice()[0].is_nan());
    }

    #[test]
    fn joints_that_all_stand_still_take_no_time() {
        let q = JointPositions::new([0.3, -0.4]);
        let motion = JointTrajectory::<Trapezoid>::rest_to_rest(&q, &q, &[LIMITS; 2]).unwrap();
        assert_eq!(motion.duration_s(), 0.0);
        assert_eq!(motion.at(0.0), JointSample::at_rest(q));
    }

    #[test]
    fn joint_vectors_do_what_their_axes_do() {
        let start = JointSample {
            q: JointPositions::new([0.0, 1.0]),
            qd: JointVelocities::new([0.5, 0.0]),
            qdd: JointAccelerations::new([0.0, -1.0]),
        };
        let end = JointSample::at_rest(JointPositions::new([1.0, 0.2]));
        let quintic = JointTrajectory::<Quintic>::between(&start, &end, 2.0).unwrap();
        assert_eq!(quintic.at(0.0), start);
        assert_eq!(quintic.at(2.0), end);
        let alone = Quintic::between(start.axis(1), end.axis(1), 2.0).unwrap();
        assert_eq!(quintic.at(0.6).axis(1), alone.at(0.6));
        let cubic = JointTrajectory::<Cubic>::between(&start, &end, 2.0).unwrap();
        assert_eq!(cubic.at(0.0).qd, start.qd);
        let via = [0.0, 0.5, 1.0].map(|x| JointPositions::new([x, x * x]));
        let spline = JointTrajectory::<Spline>::through(&[0.0, 1.0, 3.0], &via).unwrap();
        assert_eq!(spline.at(1.0).q, via[1]);
        assert_eq!(spline.at(3.0).q, via[2]);
    }

    #[test]
    fn wrong_counts_are_reported() {
        let (two, three) = (JointPositions::zeros(2), JointPositions::zeros(3));
        let text = |error: TrajectoryError| error.to_string();
        assert_eq!(
            text(JointTrajectory::<Trapezoid>::rest_to_rest(&two, &two, &[LIMITS]).unwrap_err()),
            "limits of the joints: expected 2 values, got 1"
        );
        assert_eq!(
            text(
                JointTrajectory::<Quintic>::between(
                    &JointSample::at_rest(two.clone()),
                    &JointSample::at_rest(three.clone()),
                    1.0
                )
                .unwrap_err()
            ),
            "joint positions: expected 2 values, got 3"
        );
        assert_eq!(
            text(JointTrajectory::<Spline>::through(&[0.0, 1.0], &[two, three]).unwrap_err()),
            "joint positions of a via point: expected 2 values, got 3"
        );
        assert_eq!(
            text(JointTrajectory::<Spline>::through(&[0.0, 1.0], &[]).unwrap_err()),
            "at least 1 axes are needed, got 0"
        );
    }
}
