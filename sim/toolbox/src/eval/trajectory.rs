//! The operation `trajectory`: a motion of the joints or of the TCP, sampled at given times.

use kinemark_sim::spatial::{Pose, pose};
use kinemark_sim::trajectory::{
    AlongPath, Arc, Cubic, JerkLimited, JerkLimits, JointSample, JointTrajectory, Knot, Limits,
    Line, Path, PoseSample, Quintic, RestToRest as _, Sample, Spline, SplineEnds, Trajectory,
    TrajectoryError, Trapezoid,
};
use nalgebra::{Matrix3, Vector3};
use serde::{Deserialize, Serialize};

use super::inverse_kinematics::rotation_matrix;
use super::number_fields::{Numbers, finite, matrix_rows, positive};
use super::refusal::{Code, Refusal, refuse};

/// More samples than this are asked for by mistake.
const MOST_SAMPLES: usize = 100_000;

/// A motion planned by itself, sampled at given times.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct PlanTrajectory {
    /// The motion.
    pub kind: Motion,
    /// Times of the samples.
    pub at_s: Option<Numbers>,
}

/// A motion of axes, from `from` to `to` with one number per axis each, or of the TCP along a path.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Motion {
    /// A polynomial of the third degree per axis.
    Cubic {
        /// Where each axis starts.
        from: Numbers,
        /// Where each axis ends.
        to: Numbers,
        /// How long the motion takes.
        duration_s: f64,
        /// Rates at the start; zero where none are given.
        from_qd: Option<Numbers>,
        /// Rates at the end; zero where none are given.
        to_qd: Option<Numbers>,
    },
    /// A polynomial of the fifth degree per axis.
    Quintic {
        /// Where each axis starts.
        from: Numbers,
        /// Where each axis ends.
        to: Numbers,
        /// How long the motion takes.
        duration_s: f64,
        /// Rates at the start; zero where none are given.
        from_qd: Option<Numbers>,
        /// Rates at the end; zero where none are given.
        to_qd: Option<Numbers>,
        /// Accelerations at the start; zero where none are given.
        from_qdd: Option<Numbers>,
        /// Accelerations at the end; zero where none are given.
        to_qdd: Option<Numbers>,
    },
    /// Constant acceleration, speed and deceleration per axis, from rest to rest within limits.
    Trapezoid {
        /// Where each axis starts.
        from: Numbers,
        /// Where each axis ends.
        to: Numbers,
        /// Greatest speed.
        speed: Numbers,
        /// Greatest acceleration.
        acceleration: Numbers,
        /// Greatest deceleration; the acceleration where it is not given.
        deceleration: Option<Numbers>,
    },
    /// At most seven phases of constant jerk per axis, from rest to rest within limits.
    JerkLimited {
        /// Where each axis starts.
        from: Numbers,
        /// Where each axis ends.
        to: Numbers,
        /// Greatest speed.
        speed: Numbers,
        /// Greatest acceleration.
        acceleration: Numbers,
        /// Greatest jerk.
        jerk: Numbers,
    },
    /// Cubic pieces through points at given times.
    Spline {
        /// When each point is passed, from 0.
        times_s: Numbers,
        /// The points, one number per axis each.
        points: Vec<Vec<f64>>,
        /// Whether the ends have no acceleration; they are at rest where it is not given.
        natural: Option<bool>,
    },
    /// A straight line of the TCP.
    Line {
        /// Where the TCP starts.
        from: PathEnd,
        /// Where it ends.
        to: PathEnd,
        /// How time passes along the path.
        law: TimeLaw,
    },
    /// An arc of the TCP.
    Arc {
        /// Where the TCP starts.
        from: PathEnd,
        /// A point of the arc.
        via_m: [f64; 3],
        /// Where it ends.
        to: PathEnd,
        /// How time passes along the path.
        law: TimeLaw,
    },
}

/// A pose of the TCP.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct PathEnd {
    /// Position.
    pub position_m: [f64; 3],
    /// Orientation as three rows; that of the world where it is not given.
    pub rotation: Option<[[f64; 3]; 3]>,
}

/// How time passes along a path: from rest to rest, in a time or within limits.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum TimeLaw {
    /// A polynomial of the third degree.
    Cubic {
        /// How long the motion takes.
        duration_s: f64,
    },
    /// A polynomial of the fifth degree; the law where none is given.
    #[serde(alias = "")]
    Quintic {
        /// How long the motion takes.
        duration_s: f64,
    },
    /// Constant acceleration, speed and deceleration.
    Trapezoid {
        /// Greatest speed.
        speed: Numbers,
        /// Greatest acceleration.
        acceleration: Numbers,
    },
    /// At most seven phases of constant jerk.
    JerkLimited {
        /// Greatest speed.
        speed: Numbers,
        /// Greatest acceleration.
        acceleration: Numbers,
        /// Greatest jerk.
        jerk: Numbers,
    },
}

/// The answer to [`PlanTrajectory`].
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(untagged)]
pub enum PlannedMotion {
    /// A motion of axes, a row for each time.
    Axes {
        /// How long the motion takes.
        duration_s: f64,
        /// Positions.
        q: Vec<Vec<f64>>,
        /// Velocities.
        qd: Vec<Vec<f64>>,
        /// Accelerations.
        qdd: Vec<Vec<f64>>,
    },
    /// A motion of the TCP, an entry for each time.
    Path {
        /// How long the motion takes.
        duration_s: f64,
        /// Length of the path.
        length_m: f64,
        /// Positions.
        position_m: Vec<Vec<f64>>,
        /// Orientations, three rows each.
        rotation: Vec<Vec<Vec<f64>>>,
        /// Velocities.
        velocity_m_s: Vec<Vec<f64>>,
        /// Angular velocities.
        angular_velocity_rad_s: Vec<Vec<f64>>,
        /// Accelerations.
        acceleration_m_s2: Vec<Vec<f64>>,
        /// Angular accelerations.
        angular_acceleration_rad_s2: Vec<Vec<f64>>,
    },
}

impl From<TrajectoryError> for Refusal {
    fn from(error: TrajectoryError) -> Self {
        Self::new(Code::CannotPlan, error)
    }
}

/// Plans the motion and samples it.
///
/// # Errors
///
/// The refusal that the same request in JSON is answered with.
pub fn trajectory(request: &PlanTrajectory) -> Result<PlannedMotion, Refusal> {
    let at_s = request.at_s.as_ref().map_or(&[][..], Numbers::as_slice);
    if at_s.len() > MOST_SAMPLES {
        let message = format!("{} times are more than {MOST_SAMPLES}", at_s.len());
        return refuse(Code::TooLarge, message);
    }
    match &request.kind {
        Motion::Cubic {
            from,
            to,
            duration_s,
            from_qd,
            to_qd,
        } => axis_samples(
            Ends::of(from, to)?.cubics(*duration_s, [from_qd, to_qd])?,
            at_s,
        ),
        Motion::Quintic {
            from,
            to,
            duration_s,
            from_qd,
            to_qd,
            from_qdd,
            to_qdd,
        } => {
            let rates = [from_qd, to_qd, from_qdd, to_qdd];
            axis_samples(Ends::of(from, to)?.quintics(*duration_s, rates)?, at_s)
        }
        Motion::Trapezoid {
            from,
            to,
            speed,
            acceleration,
            deceleration,
        } => {
            let ends = Ends::of(from, to)?;
            axis_samples(
                ends.trapezoids(speed, acceleration, deceleration.as_ref())?,
                at_s,
            )
        }
        Motion::JerkLimited {
            from,
            to,
            speed,
            acceleration,
            jerk,
        } => axis_samples(
            Ends::of(from, to)?.jerk_limited(speed, acceleration, jerk)?,
            at_s,
        ),
        Motion::Spline {
            times_s,
            points,
            natural,
        } => axis_samples(splines(times_s, points, natural.unwrap_or(false))?, at_s),
        Motion::Line { from, to, law } => {
            law.sampled_along(Line::between(&from.pose("from")?, &to.pose("to")?)?, at_s)
        }
        Motion::Arc {
            from,
            via_m,
            to,
            law,
        } => {
            let (from, to) = (from.pose("from")?, to.pose("to")?);
            law.sampled_along(Arc::through(&from, (*via_m).into(), &to)?, at_s)
        }
    }
}

/// Start and end of a motion, which have one number per axis each.
struct Ends<'n> {
    from: &'n [f64],
    to: &'n [f64],
}

impl<'n> Ends<'n> {
    fn of(from: &'n Numbers, to: &'n Numbers) -> Result<Self, Refusal> {
        let (from, to) = (from.as_slice(), to.as_slice());
        if from.len() == to.len() {
            return Ok(Self { from, to });
        }
        let message = format!("`from` has {} numbers, `to` {}", from.len(), to.len());
        refuse(Code::WrongLength, message)
    }

    /// A motion of each axis, by its index.
    fn axes<A>(
        &self,
        axis: impl FnMut(usize) -> Result<A, TrajectoryError>,
    ) -> Result<Vec<A>, Refusal> {
        let axes: Result<Vec<A>, TrajectoryError> = (0..self.from.len()).map(axis).collect();
        Ok(axes?)
    }

    /// Numbers per axis; zero where none are given.
    fn rates(&self, name: &str, given: &Option<Numbers>) -> Result<Vec<f64>, Refusal> {
        let n = self.from.len();
        let given = given.as_ref();
        given.map_or_else(|| Ok(vec![0.0; n]), |rates| rates.per_axis(name, n))
    }

    fn cubics(
        &self,
        duration_s: f64,
        [from_qd, to_qd]: [&Option<Numbers>; 2],
    ) -> Result<Vec<Cubic>, Refusal> {
        let from_qd = self.rates("from_qd", from_qd)?;
        let to_qd = self.rates("to_qd", to_qd)?;
        let duration_s = positive("duration_s", duration_s)?;
        let knot = |position, velocity| Knot { position, velocity };
        self.axes(|i| {
            let (start, end) = (knot(self.from[i], from_qd[i]), knot(self.to[i], to_qd[i]));
            Cubic::between(start, end, duration_s)
        })
    }

    fn quintics(
        &self,
        duration_s: f64,
        [from_qd, to_qd, from_qdd, to_qdd]: [&Option<Numbers>; 4],
    ) -> Result<Vec<Quintic>, Refusal> {
        let (from_qd, from_qdd) = (
            self.rates("from_qd", from_qd)?,
            self.rates("from_qdd", from_qdd)?,
        );
        let (to_qd, to_qdd) = (self.rates("to_qd", to_qd)?, self.rates("to_qdd", to_qdd)?);
        let duration_s = positive("duration_s", duration_s)?;
        let sample = |position, velocity, acceleration| Sample {
            position,
            velocity,
            acceleration,
        };
        self.axes(|i| {
            let start = sample(self.from[i], from_qd[i], from_qdd[i]);
            let end = sample(self.to[i], to_qd[i], to_qdd[i]);
            Quintic::between(start, end, duration_s)
        })
    }

    fn trapezoids(
        &self,
        speed: &Numbers,
        acceleration: &Numbers,
        deceleration: Option<&Numbers>,
    ) -> Result<Vec<Trapezoid>, Refusal> {
        let n = self.from.len();
        let speed = speed.per_axis("speed", n)?;
        let acceleration = acceleration.per_axis("acceleration", n)?;
        let slow = deceleration.map(|slow| slow.per_axis("deceleration", n));
        let slow = slow.transpose()?.unwrap_or_else(|| acceleration.clone());
        self.axes(|i| {
            let limits = Limits {
                speed: speed[i],
                acceleration: acceleration[i],
            };
            Trapezoid::with_deceleration(self.from[i], self.to[i], &limits, slow[i])
        })
    }

    fn jerk_limited(
        &self,
        speed: &Numbers,
        acceleration: &Numbers,
        jerk: &Numbers,
    ) -> Result<Vec<JerkLimited>, Refusal> {
        let n = self.from.len();
        let speed = speed.per_axis("speed", n)?;
        let acceleration = acceleration.per_axis("acceleration", n)?;
        let jerk = jerk.per_axis("jerk", n)?;
        self.axes(|i| {
            let limits = JerkLimits {
                speed: speed[i],
                acceleration: acceleration[i],
                jerk: jerk[i],
            };
            JerkLimited::rest_to_rest(self.from[i], self.to[i], &limits)
        })
    }
}

fn splines(times_s: &Numbers, points: &[Vec<f64>], natural: bool) -> Result<Vec<Spline>, Refusal> {
    let n = points.first().map_or(0, Vec::len);
    if let Some(other) = points.iter().find(|point| point.len() != n) {
        let message = format!("a point has {} numbers, the first {n}", other.len());
        return refuse(Code::WrongLength, message);
    }
    let ends = if natural {
        SplineEnds::Natural
    } else {
        SplineEnds::AT_REST
    };
    let axis = |i: usize| {
        let axis: Vec<f64> = points.iter().map(|point| point[i]).collect();
        Spline::through(times_s.as_slice(), &axis, ends)
    };
    Ok((0..n).map(axis).collect::<Result<_, _>>()?)
}

fn axis_samples<A: Trajectory<Sample = Sample>>(
    axes: Vec<A>,
    at_s: &[f64],
) -> Result<PlannedMotion, Refusal> {
    let motion = JointTrajectory::together(axes)?;
    let samples: Vec<JointSample> = at_s.iter().map(|&t| motion.at(t)).collect();
    let column = |part: fn(&JointSample) -> &[f64]| {
        let rows = samples.iter().map(|sample| finite(part(sample)));
        rows.collect::<Result<Vec<_>, Refusal>>()
    };
    Ok(PlannedMotion::Axes {
        duration_s: motion.duration_s(),
        q: column(|sample| sample.q.as_slice())?,
        qd: column(|sample| sample.qd.as_slice())?,
        qdd: column(|sample| sample.qdd.as_slice())?,
    })
}

impl PathEnd {
    fn pose(&self, name: &str) -> Result<Pose, Refusal> {
        let rotation = match &self.rotation {
            Some(rows) => rotation_matrix(&format!("{name}.rotation"), rows)?,
            None => Matrix3::identity(),
        };
        Ok(pose(rotation, self.position_m.into()))
    }
}

impl TimeLaw {
    fn sampled_along(&self, path: impl Path, at_s: &[f64]) -> Result<PlannedMotion, Refusal> {
        let extent = [path.extent()];
        let ends = Ends {
            from: &[0.0],
            to: &extent,
        };
        match self {
            Self::Cubic { duration_s } => {
                path_samples(path, ends.cubics(*duration_s, [&None; 2])?, at_s)
            }
            Self::Quintic { duration_s } => {
                path_samples(path, ends.quintics(*duration_s, [&None; 4])?, at_s)
            }
            Self::Trapezoid {
                speed,
                acceleration,
            } => path_samples(path, ends.trapezoids(speed, acceleration, None)?, at_s),
            Self::JerkLimited {
                speed,
                acceleration,
                jerk,
            } => path_samples(path, ends.jerk_limited(speed, acceleration, jerk)?, at_s),
        }
    }
}

/// The path by the law of its one axis, the distance along it.
fn path_samples<L: Trajectory<Sample = Sample>>(
    path: impl Path,
    mut law: Vec<L>,
    at_s: &[f64],
) -> Result<PlannedMotion, Refusal> {
    let motion = AlongPath::new(path, law.swap_remove(0))?;
    let samples: Vec<PoseSample> = at_s.iter().map(|&t| motion.at(t)).collect();
    let column = |part: fn(&PoseSample) -> Vector3<f64>| {
        let rows = samples.iter().map(|sample| finite(part(sample).as_slice()));
        rows.collect::<Result<Vec<_>, Refusal>>()
    };
    let rotations = samples
        .iter()
        .map(|sample| matrix_rows(sample.world_from_tcp.rotation.matrix()));
    Ok(PlannedMotion::Path {
        duration_s: motion.duration_s(),
        length_m: motion.path().length_m(),
        position_m: column(|s| s.world_from_tcp.translation.vector)?,
        rotation: rotations.collect::<Result<_, Refusal>>()?,
        velocity_m_s: column(|s| s.twist.linear)?,
        angular_velocity_rad_s: column(|s| s.twist.angular)?,
        acceleration_m_s2: column(|s| s.twist_rate.linear)?,
        angular_acceleration_rad_s2: column(|s| s.twist_rate.angular)?,
    })
}
