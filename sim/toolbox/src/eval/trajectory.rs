//! The operation `trajectory`: a motion of the joints or of the TCP, sampled at given times.

use kinemark_sim::joint_space::{JointAccelerations, JointPositions, JointVelocities};
use kinemark_sim::spatial::{Pose, pose};
use kinemark_sim::trajectory::{
    AlongPath, Arc, Cubic, JerkLimited, JerkLimits, JointSample, JointTrajectory, Knot, Limits,
    Line, Path, PoseSample, Quintic, RestToRest as _, Sample, Spline, SplineEnds, Trajectory,
    TrajectoryError, Trapezoid,
};
use nalgebra::{Matrix3, Vector3};
use serde::{Deserialize, Serialize};

use super::field_reader::{Fields, FromFields};
use super::inverse_kinematics::rotation_matrix;
use super::number_fields::{Numbers, finite, matrix_rows, positive};
use super::operation::{Operation, Subject};
use super::refusal::{Code, Refusal};

/// More samples than this are asked for by mistake.
const MOST_SAMPLES: usize = 100_000;

/// A motion planned by itself, sampled at the times `at_s`.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PlanTrajectory {
    /// Times of the samples.
    pub at_s: Option<Numbers>,
    /// The motion.
    #[serde(flatten)]
    pub motion: Motion,
}

/// A motion; the field `kind` has its name.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(tag = "kind", rename_all = "kebab-case")]
pub enum Motion {
    /// A polynomial of the third degree per axis.
    Cubic(CubicMotion),
    /// A polynomial of the fifth degree per axis.
    Quintic(QuinticMotion),
    /// Constant acceleration, speed and deceleration per axis.
    Trapezoid(TrapezoidMotion),
    /// At most seven phases of constant jerk per axis.
    JerkLimited(JerkLimitedMotion),
    /// Cubic pieces through points.
    Spline(SplineMotion),
    /// A straight line of the TCP.
    Line(LineMotion),
    /// An arc of the TCP.
    Arc(ArcMotion),
}

/// From a state to a state.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CubicMotion {
    /// Start, one number per axis.
    pub from: Numbers,
    /// End.
    pub to: Numbers,
    /// How long the motion takes.
    pub duration_s: f64,
    /// Rates at the start; zero where none are given.
    pub from_qd: Option<Numbers>,
    /// Rates at the end; zero where none are given.
    pub to_qd: Option<Numbers>,
}

/// From a state to a state, accelerations included.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct QuinticMotion {
    /// Start, one number per axis.
    pub from: Numbers,
    /// End.
    pub to: Numbers,
    /// How long the motion takes.
    pub duration_s: f64,
    /// Rates at the start; zero where none are given.
    pub from_qd: Option<Numbers>,
    /// Rates at the end; zero where none are given.
    pub to_qd: Option<Numbers>,
    /// Accelerations at the start; zero where none are given.
    pub from_qdd: Option<Numbers>,
    /// Accelerations at the end; zero where none are given.
    pub to_qdd: Option<Numbers>,
}

/// From rest to rest within limits.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TrapezoidMotion {
    /// Start, one number per axis.
    pub from: Numbers,
    /// End.
    pub to: Numbers,
    /// Greatest speed.
    pub speed: Numbers,
    /// Greatest acceleration.
    pub acceleration: Numbers,
    /// Greatest deceleration; the acceleration where it is not given.
    pub deceleration: Option<Numbers>,
}

/// From rest to rest within limits, jerk included.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct JerkLimitedMotion {
    /// Start, one number per axis.
    pub from: Numbers,
    /// End.
    pub to: Numbers,
    /// Greatest speed.
    pub speed: Numbers,
    /// Greatest acceleration.
    pub acceleration: Numbers,
    /// Greatest jerk.
    pub jerk: Numbers,
}

/// Through points at given times.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SplineMotion {
    /// When each point is passed, from 0.
    pub times_s: Numbers,
    /// The points, one number per axis each.
    pub points: Vec<Vec<f64>>,
    /// Whether the ends have no acceleration; they are at rest where it is not given.
    pub natural: Option<bool>,
}

/// A pose of the TCP.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PathEnd {
    /// Position.
    pub position_m: [f64; 3],
    /// Orientation as three rows; that of the world where it is not given.
    pub rotation: Option<[[f64; 3]; 3]>,
}

/// A straight line.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LineMotion {
    /// Where it starts and ends.
    #[serde(flatten)]
    pub ends: LineEnds,
    /// How time passes along it.
    #[serde(flatten)]
    pub law: TimeLaw,
}

/// The ends of a straight line.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LineEnds {
    /// Start.
    pub from: PathEnd,
    /// End.
    pub to: PathEnd,
}

/// An arc of a circle.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ArcMotion {
    /// Which arc it is.
    #[serde(flatten)]
    pub points: ArcPoints,
    /// How time passes along it.
    #[serde(flatten)]
    pub law: TimeLaw,
}

/// The three points of an arc.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ArcPoints {
    /// Start.
    pub from: PathEnd,
    /// A point of the arc.
    pub via_m: [f64; 3],
    /// End.
    pub to: PathEnd,
}

/// How time passes along a path; the field `law` has its name.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(tag = "law", rename_all = "kebab-case")]
pub enum TimeLaw {
    /// A polynomial of the third degree.
    Cubic(LawDuration),
    /// A polynomial of the fifth degree.
    Quintic(LawDuration),
    /// Constant acceleration, speed and deceleration.
    Trapezoid(LawLimits),
    /// At most seven phases of constant jerk.
    JerkLimited(LawJerkLimits),
}

/// The parameter of a polynomial law.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LawDuration {
    /// How long the motion takes.
    pub duration_s: f64,
}

/// Limits along a path.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LawLimits {
    /// Greatest speed.
    pub speed: Numbers,
    /// Greatest acceleration.
    pub acceleration: Numbers,
}

/// Limits along a path, jerk included.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LawJerkLimits {
    /// Greatest speed.
    pub speed: Numbers,
    /// Greatest acceleration.
    pub acceleration: Numbers,
    /// Greatest jerk.
    pub jerk: Numbers,
}

/// The field `kind`, and what all kinds have.
#[derive(Deserialize)]
struct MotionHead {
    kind: MotionKind,
    at_s: Option<Numbers>,
}

#[derive(Deserialize)]
#[serde(rename_all = "kebab-case")]
enum MotionKind {
    Cubic,
    Quintic,
    Trapezoid,
    JerkLimited,
    Spline,
    Line,
    Arc,
}

#[derive(Deserialize)]
struct LawHead {
    law: Option<LawKind>,
}

#[derive(Deserialize)]
#[serde(rename_all = "kebab-case")]
enum LawKind {
    Cubic,
    Quintic,
    Trapezoid,
    JerkLimited,
}

impl FromFields for PlanTrajectory {
    fn from_fields(fields: &mut Fields) -> Result<Self, Refusal> {
        let MotionHead { kind, at_s } = fields.read()?;
        let motion = match kind {
            MotionKind::Cubic => Motion::Cubic(fields.read()?),
            MotionKind::Quintic => Motion::Quintic(fields.read()?),
            MotionKind::Trapezoid => Motion::Trapezoid(fields.read()?),
            MotionKind::JerkLimited => Motion::JerkLimited(fields.read()?),
            MotionKind::Spline => Motion::Spline(fields.read()?),
            MotionKind::Line => Motion::Line(LineMotion {
                ends: fields.read()?,
                law: TimeLaw::from_fields(fields)?,
            }),
            MotionKind::Arc => Motion::Arc(ArcMotion {
                points: fields.read()?,
                law: TimeLaw::from_fields(fields)?,
            }),
        };
        Ok(Self { at_s, motion })
    }
}

impl FromFields for TimeLaw {
    fn from_fields(fields: &mut Fields) -> Result<Self, Refusal> {
        let LawHead { law } = fields.read()?;
        Ok(match law.unwrap_or(LawKind::Quintic) {
            LawKind::Cubic => Self::Cubic(fields.read()?),
            LawKind::Quintic => Self::Quintic(fields.read()?),
            LawKind::Trapezoid => Self::Trapezoid(fields.read()?),
            LawKind::JerkLimited => Self::JerkLimited(fields.read()?),
        })
    }
}

/// The answer to [`PlanTrajectory`].
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum PlannedMotion {
    /// A motion of axes.
    Axes(AxisSamples),
    /// A motion of the TCP.
    Path(PathSamples),
}

/// A motion of axes, a row for each time.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct AxisSamples {
    /// How long the motion takes.
    pub duration_s: f64,
    /// Positions.
    pub q: Vec<Vec<f64>>,
    /// Velocities.
    pub qd: Vec<Vec<f64>>,
    /// Accelerations.
    pub qdd: Vec<Vec<f64>>,
}

/// A motion of the TCP, an entry for each time.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PathSamples {
    /// How long the motion takes.
    pub duration_s: f64,
    /// Length of the path.
    pub length_m: f64,
    /// Positions.
    pub position_m: Vec<Vec<f64>>,
    /// Orientations, three rows each.
    pub rotation: Vec<Vec<Vec<f64>>>,
    /// Velocities.
    pub velocity_m_s: Vec<Vec<f64>>,
    /// Angular velocities.
    pub angular_velocity_rad_s: Vec<Vec<f64>>,
    /// Accelerations.
    pub acceleration_m_s2: Vec<Vec<f64>>,
    /// Angular accelerations.
    pub angular_acceleration_rad_s2: Vec<Vec<f64>>,
}

impl From<TrajectoryError> for Refusal {
    fn from(error: TrajectoryError) -> Self {
        Self::new(Code::CannotPlan, error.to_string())
    }
}

impl Operation for PlanTrajectory {
    const NAME: &'static str = "trajectory";
    type Answer = PlannedMotion;

    fn answer(self, _: Subject<'_>) -> Result<PlannedMotion, Refusal> {
        let at_s = self.at_s.as_ref().map_or(&[][..], Numbers::as_slice);
        if at_s.len() > MOST_SAMPLES {
            let message = format!("{} times are more than {MOST_SAMPLES}", at_s.len());
            return Err(Refusal::new(Code::TooLarge, message));
        }
        match &self.motion {
            Motion::Cubic(motion) => motion.sampled(at_s),
            Motion::Quintic(motion) => motion.sampled(at_s),
            Motion::Trapezoid(motion) => motion.sampled(at_s),
            Motion::JerkLimited(motion) => motion.sampled(at_s),
            Motion::Spline(motion) => motion.sampled(at_s),
            Motion::Line(LineMotion { ends, law }) => {
                let (from, to) = (ends.from.pose("from")?, ends.to.pose("to")?);
                law.sampled_along(Line::between(&from, &to)?, at_s)
            }
            Motion::Arc(ArcMotion { points, law }) => {
                let (from, to) = (points.from.pose("from")?, points.to.pose("to")?);
                law.sampled_along(Arc::through(&from, points.via_m.into(), &to)?, at_s)
            }
        }
    }
}

/// Start and end, which have one number per axis each.
fn ends(from: &Numbers, to: &Numbers) -> Result<(Vec<f64>, Vec<f64>), Refusal> {
    let (from, to) = (from.as_slice(), to.as_slice());
    if from.len() == to.len() {
        return Ok((from.to_vec(), to.to_vec()));
    }
    let message = format!("`from` has {} numbers, `to` {}", from.len(), to.len());
    Err(Refusal::new(Code::WrongLength, message))
}

/// Rates of `n` axes; zero where none are given.
fn rates(name: &str, given: Option<&Numbers>, n: usize) -> Result<Vec<f64>, Refusal> {
    given.map_or_else(|| Ok(vec![0.0; n]), |rates| rates.per_axis(name, n))
}

impl CubicMotion {
    fn sampled(&self, at_s: &[f64]) -> Result<PlannedMotion, Refusal> {
        let (from, to) = ends(&self.from, &self.to)?;
        let n = from.len();
        let state = |q, qd| JointSample {
            q: JointPositions::new(q),
            qd: JointVelocities::new(qd),
            qdd: JointAccelerations::zeros(n),
        };
        let start = state(from, rates("from_qd", self.from_qd.as_ref(), n)?);
        let end = state(to, rates("to_qd", self.to_qd.as_ref(), n)?);
        let duration_s = positive("duration_s", self.duration_s)?;
        axis_samples(
            &JointTrajectory::<Cubic>::between(&start, &end, duration_s)?,
            at_s,
        )
    }
}

impl QuinticMotion {
    fn sampled(&self, at_s: &[f64]) -> Result<PlannedMotion, Refusal> {
        let (from, to) = ends(&self.from, &self.to)?;
        let n = from.len();
        let start = JointSample {
            q: JointPositions::new(from),
            qd: JointVelocities::new(rates("from_qd", self.from_qd.as_ref(), n)?),
            qdd: JointAccelerations::new(rates("from_qdd", self.from_qdd.as_ref(), n)?),
        };
        let end = JointSample {
            q: JointPositions::new(to),
            qd: JointVelocities::new(rates("to_qd", self.to_qd.as_ref(), n)?),
            qdd: JointAccelerations::new(rates("to_qdd", self.to_qdd.as_ref(), n)?),
        };
        let duration_s = positive("duration_s", self.duration_s)?;
        axis_samples(
            &JointTrajectory::<Quintic>::between(&start, &end, duration_s)?,
            at_s,
        )
    }
}

fn limits(speed: &Numbers, acceleration: &Numbers, n: usize) -> Result<Vec<Limits>, Refusal> {
    let speed = speed.per_axis("speed", n)?;
    let acceleration = acceleration.per_axis("acceleration", n)?;
    let both = speed.into_iter().zip(acceleration);
    Ok(both
        .map(|(speed, acceleration)| Limits {
            speed,
            acceleration,
        })
        .collect())
}

fn jerk_limits(
    speed: &Numbers,
    acceleration: &Numbers,
    jerk: &Numbers,
    n: usize,
) -> Result<Vec<JerkLimits>, Refusal> {
    let limits = limits(speed, acceleration, n)?.into_iter();
    let all = limits.zip(jerk.per_axis("jerk", n)?);
    Ok(all
        .map(|(limits, jerk)| JerkLimits {
            speed: limits.speed,
            acceleration: limits.acceleration,
            jerk,
        })
        .collect())
}

impl TrapezoidMotion {
    fn sampled(&self, at_s: &[f64]) -> Result<PlannedMotion, Refusal> {
        let (from, to) = ends(&self.from, &self.to)?;
        let n = from.len();
        let limits = limits(&self.speed, &self.acceleration, n)?;
        let slow = match &self.deceleration {
            Some(deceleration) => deceleration.per_axis("deceleration", n)?,
            None => limits.iter().map(|limits| limits.acceleration).collect(),
        };
        let axis = |i: usize| Trapezoid::with_deceleration(from[i], to[i], &limits[i], slow[i]);
        let axes: Result<Vec<Trapezoid>, TrajectoryError> = (0..n).map(axis).collect();
        axis_samples(&JointTrajectory::together(axes?)?, at_s)
    }
}

impl JerkLimitedMotion {
    fn sampled(&self, at_s: &[f64]) -> Result<PlannedMotion, Refusal> {
        let (from, to) = ends(&self.from, &self.to)?;
        let limits = jerk_limits(&self.speed, &self.acceleration, &self.jerk, from.len())?;
        let (from, to) = (JointPositions::new(from), JointPositions::new(to));
        let motion = JointTrajectory::<JerkLimited>::rest_to_rest(&from, &to, &limits)?;
        axis_samples(&motion, at_s)
    }
}

impl SplineMotion {
    fn sampled(&self, at_s: &[f64]) -> Result<PlannedMotion, Refusal> {
        let n = self.points.first().map_or(0, Vec::len);
        if let Some(other) = self.points.iter().find(|point| point.len() != n) {
            let message = format!("a point has {} numbers, the first {n}", other.len());
            return Err(Refusal::new(Code::WrongLength, message));
        }
        let ends = match self.natural {
            Some(true) => SplineEnds::Natural,
            _ => SplineEnds::AT_REST,
        };
        let axis = |i: usize| {
            let axis: Vec<f64> = self.points.iter().map(|point| point[i]).collect();
            Spline::through(self.times_s.as_slice(), &axis, ends)
        };
        let axes: Result<Vec<Spline>, TrajectoryError> = (0..n).map(axis).collect();
        axis_samples(&JointTrajectory::together(axes?)?, at_s)
    }
}

fn axis_samples<A: Trajectory<Sample = Sample>>(
    motion: &JointTrajectory<A>,
    at_s: &[f64],
) -> Result<PlannedMotion, Refusal> {
    let samples: Vec<JointSample> = at_s.iter().map(|&t| motion.at(t)).collect();
    let column = |part: &dyn Fn(&JointSample) -> Result<Vec<f64>, Refusal>| {
        samples
            .iter()
            .map(part)
            .collect::<Result<Vec<_>, Refusal>>()
    };
    Ok(PlannedMotion::Axes(AxisSamples {
        duration_s: motion.duration_s(),
        q: column(&|sample| finite(sample.q.as_slice()))?,
        qd: column(&|sample| finite(sample.qd.as_slice()))?,
        qdd: column(&|sample| finite(sample.qdd.as_slice()))?,
    }))
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
        let extent = path.extent();
        match self {
            Self::Quintic(LawDuration { duration_s }) => {
                let duration_s = positive("duration_s", *duration_s)?;
                let (start, end) = (Sample::at_rest(0.0), Sample::at_rest(extent));
                path_samples(path, Quintic::between(start, end, duration_s)?, at_s)
            }
            Self::Cubic(LawDuration { duration_s }) => {
                let duration_s = positive("duration_s", *duration_s)?;
                let (start, end) = (Knot::at_rest(0.0), Knot::at_rest(extent));
                path_samples(path, Cubic::between(start, end, duration_s)?, at_s)
            }
            Self::Trapezoid(law) => {
                let limits = limits(&law.speed, &law.acceleration, 1)?;
                let slow = limits[0].acceleration;
                let law = Trapezoid::with_deceleration(0.0, extent, &limits[0], slow)?;
                path_samples(path, law, at_s)
            }
            Self::JerkLimited(law) => {
                let limits = jerk_limits(&law.speed, &law.acceleration, &law.jerk, 1)?;
                let law = JerkLimited::rest_to_rest(0.0, extent, &limits[0])?;
                path_samples(path, law, at_s)
            }
        }
    }
}

fn path_samples<P: Path, L: Trajectory<Sample = Sample>>(
    path: P,
    law: L,
    at_s: &[f64],
) -> Result<PlannedMotion, Refusal> {
    let motion = AlongPath::new(path, law)?;
    let samples: Vec<PoseSample> = at_s.iter().map(|&t| motion.at(t)).collect();
    let column = |part: &dyn Fn(&PoseSample) -> Vector3<f64>| {
        let rows = samples.iter().map(|sample| finite(part(sample).as_slice()));
        rows.collect::<Result<Vec<_>, Refusal>>()
    };
    let rotations = samples
        .iter()
        .map(|sample| matrix_rows(sample.world_from_tcp.rotation.matrix()));
    Ok(PlannedMotion::Path(PathSamples {
        duration_s: motion.duration_s(),
        length_m: motion.path().length_m(),
        position_m: column(&|s| s.world_from_tcp.translation.vector)?,
        rotation: rotations.collect::<Result<_, Refusal>>()?,
        velocity_m_s: column(&|s| s.twist.linear)?,
        angular_velocity_rad_s: column(&|s| s.twist.angular)?,
        acceleration_m_s2: column(&|s| s.twist_rate.linear)?,
        angular_acceleration_rad_s2: column(&|s| s.twist_rate.angular)?,
    }))
}
