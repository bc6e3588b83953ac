//! The operation `ik`: joint positions that bring one frame, or a group of frames, to targets.

use kinemark_sim::kinematics::inverse::groups::{Group, solve_by_priority, solve_in_turn};
use kinemark_sim::kinematics::inverse::{Goal, IkAnswer, Posture};
use kinemark_sim::kinematics::{IkError, IkSettings, IkSolver, Method, Target, forward_kinematics};
use kinemark_sim::model::robot::{Frame, Robot};
use kinemark_sim::spatial::{Pose, pose};
use kinemark_sim::text::suggest;
use nalgebra::{Matrix3, Unit, Vector3};
use serde::{Deserialize, Serialize};

use super::joint_state::positions;
use super::number_fields::{Numbers, finite, finite_number};
use super::operation::{frame_or_tcp, frame_or_world};
use super::refusal::{Code, Refusal, refuse};

/// A rotation's rows may be off by this: they are often printed with six digits.
const ROTATION_TOLERANCE: f64 = 1e-5;

/// A posture is approached by this fraction of the way in a step, if the request does not say.
const DEFAULT_POSTURE_GAIN: f64 = 0.5;

/// Inverse kinematics. Out of reach is an answer: [`IkSolution::reached`] is false.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct Ik {
    /// Where to start \[rad or m\]; home where it is not given.
    pub q0: Option<Numbers>,
    /// The frame that targets are in, which must not move; the world where none is given.
    pub r#in: Option<String>,
    /// The frame to bring to `target`; the TCP where none is given.
    pub frame: Option<String>,
    /// Where to bring it.
    pub target: Option<IkTarget>,
    /// In place of `target` and `frame`: a group of targets, each with its frame.
    pub targets: Option<Vec<IkTarget>>,
    /// How the targets of a group are solved; all together where it is not given.
    pub order: Option<GroupOrder>,
    /// The method of a step.
    pub method: Option<IkMethod>,
    /// The damping of the methods that have a fixed one.
    pub damping: Option<f64>,
    /// Steps from one start.
    pub max_iterations: Option<usize>,
    /// Further starts of the method `auto`.
    pub restarts: Option<usize>,
    /// How near counts as reached.
    pub tolerance_m: Option<f64>,
    /// How near counts as reached.
    pub tolerance_rad: Option<f64>,
    /// Whether joints stay within their limits.
    pub respect_limits: Option<bool>,
    /// Names of the joints that may move; all that carry a frame where it is not given.
    pub chain: Option<Vec<String>>,
    /// Joint positions to stay near, as far as the target leaves a choice \[rad or m\].
    pub posture: Option<Numbers>,
    /// The fraction of the way there that one step makes.
    pub posture_gain: Option<f64>,
}

/// A position, an orientation, both, or a position with a direction for an axis of the frame.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct IkTarget {
    /// In a group: the frame to bring there.
    pub frame: Option<String>,
    /// In a group that is solved together: how much its error counts.
    pub weight: Option<f64>,
    /// Position of the frame's origin.
    pub position_m: Option<[f64; 3]>,
    /// Orientation as three rows.
    pub rotation: Option<[[f64; 3]; 3]>,
    /// A direction fixed in the frame.
    pub axis: Option<[f64; 3]>,
    /// Where that direction should point.
    pub direction: Option<[f64; 3]>,
}

/// How the targets of a group are solved.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum GroupOrder {
    /// One stacked error.
    Together,
    /// Each from where the one before ended; later ones may undo earlier ones.
    InTurn,
    /// Later ones only as far as earlier ones stay reached.
    Priority,
}

/// How a step is made.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum IkMethod {
    /// Damped by the error, from several starts.
    Auto,
    /// Full steps.
    PseudoInverse,
    /// Full steps with a fixed damping.
    DampedLeastSquares,
    /// The pseudo-inverse first, then damped least squares.
    Fallback,
}

/// The answer to [`Ik`].
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct IkSolution {
    /// The joint positions \[rad or m\]: where the target is not reached, the best ones found, or the last ones of a textbook method.
    pub q: Vec<f64>,
    /// Whether all targets are reached.
    pub reached: bool,
    /// The largest position error left.
    pub residual_m: f64,
    /// The largest orientation error left.
    pub residual_rad: f64,
    /// Steps of all starts together.
    pub iterations: usize,
    /// What is left of each target of a group that is solved in turn or by priority.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub targets: Option<Vec<IkResidual>>,
}

/// What is left of one target of a group.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct IkResidual {
    /// Whether it is reached.
    pub reached: bool,
    /// Position error.
    pub residual_m: f64,
    /// Orientation error.
    pub residual_rad: f64,
}

/// Solves for the target, or for the group of targets in their order.
///
/// # Errors
///
/// The refusal that the same request in JSON is answered with.
pub fn ik(robot: &Robot, request: &Ik) -> Result<IkSolution, Refusal> {
    let q0 = match &request.q0 {
        Some(q0) => positions(robot, "q0", q0)?.as_slice().to_vec(),
        None => robot.home().to_vec(),
    };
    let base = frame_or_world(robot, request.r#in.as_deref())?;
    let world_from_base = base.map_or_else(|| Ok(Pose::identity()), |base| fixed(robot, base));
    let goals = request.goals(robot, &world_from_base?)?;
    let settings = request.settings(robot)?;
    let solved = match request.order {
        None | Some(GroupOrder::Together) => {
            let answer = IkSolver::new(robot, &goals, settings)?.solve(&q0)?;
            return solution(&answer.q, answer.reached, &[&answer], None);
        }
        Some(GroupOrder::InTurn) => {
            let groups = goals.iter().map(|goal| Group {
                goals: vec![*goal],
                settings: settings.clone(),
            });
            solve_in_turn(robot, &groups.collect::<Vec<Group<'_>>>(), &q0)?
        }
        Some(GroupOrder::Priority) => {
            let levels: Vec<Vec<Goal<'_>>> = goals.iter().map(|goal| vec![*goal]).collect();
            solve_by_priority(robot, &levels, &settings, &q0)?
        }
    };
    let residual = |answer: &IkAnswer| {
        Ok(IkResidual {
            reached: answer.reached,
            residual_m: finite_number(answer.residual_m)?,
            residual_rad: finite_number(answer.residual_rad)?,
        })
    };
    let targets: Result<_, Refusal> = solved.groups.iter().map(residual).collect();
    let groups: Vec<&IkAnswer> = solved.groups.iter().collect();
    solution(&solved.q, solved.reached, &groups, Some(targets?))
}

/// The solution at `q`, of which `groups` were solved one by one.
fn solution(
    q: &[f64],
    reached: bool,
    groups: &[&IkAnswer],
    targets: Option<Vec<IkResidual>>,
) -> Result<IkSolution, Refusal> {
    let worst = |part: fn(&IkAnswer) -> f64| {
        let parts = groups.iter().map(|answer| part(answer));
        finite_number(parts.fold(0.0, f64::max))
    };
    Ok(IkSolution {
        q: finite(q)?,
        reached,
        residual_m: worst(|answer| answer.residual_m)?,
        residual_rad: worst(|answer| answer.residual_rad)?,
        iterations: groups.iter().map(|answer| answer.iterations).sum(),
        targets,
    })
}

/// The pose of a frame that does not move; a target in a moving one would move with the answer.
fn fixed(robot: &Robot, frame: &Frame) -> Result<Pose, Refusal> {
    if frame.attachment.body.is_some() {
        return refuse(
            Code::OutOfRange,
            format!(
                "`in` names `{}`, which moves with the robot; name a frame that is fixed to the world",
                frame.name
            ),
        );
    }
    let home = robot
        .positions(robot.home())
        .map_err(|error| Refusal::new(Code::WrongLength, error))?;
    Ok(forward_kinematics(robot, &home).world_from(frame))
}

impl Ik {
    /// One goal by `frame` and `target`, or several by `targets`.
    fn goals<'r>(
        &self,
        robot: &'r Robot,
        world_from_base: &Pose,
    ) -> Result<Vec<Goal<'r>>, Refusal> {
        let goal = |path: &str, frame: &Option<String>, target: &IkTarget| {
            Ok(Goal {
                frame: frame_or_tcp(robot, frame.as_deref())?,
                target: target.in_world(path, world_from_base)?,
                weight: target.weight.unwrap_or(1.0),
            })
        };
        let excluded = match (&self.target, &self.targets) {
            (None, None) => return refuse(Code::MissingField, "`target` is missing"),
            (Some(IkTarget { frame: Some(_), .. }), None) => {
                "`target.frame` is for `targets`; a single target has `frame` beside it"
            }
            (
                Some(IkTarget {
                    weight: Some(_), ..
                }),
                None,
            ) => "`target.weight` is for `targets`; a single target has `frame` beside it",
            (Some(target), None) => return Ok(vec![goal("target", &self.frame, target)?]),
            (_, Some(_)) if self.frame.is_some() => {
                "`frame` and `targets` exclude each other; each of `targets` has its own frame"
            }
            (Some(_), Some(_)) => {
                "`target` and `targets` exclude each other; each of `targets` has its own frame"
            }
            (None, Some(targets)) => {
                let targets = targets.iter().enumerate();
                let goals = targets
                    .map(|(i, target)| goal(&format!("targets[{i}]"), &target.frame, target));
                return goals.collect();
            }
        };
        refuse(Code::UnknownField, excluded)
    }

    fn method(&self) -> Result<Method, Refusal> {
        let damping = self.damping;
        Ok(match self.method {
            Some(IkMethod::DampedLeastSquares) => Method::DampedLeastSquares { damping },
            Some(IkMethod::Fallback) => Method::Fallback { damping },
            _ if damping.is_some() => {
                return refuse(
                    Code::OutOfRange,
                    "`damping` is for the methods `damped-least-squares` and `fallback`",
                );
            }
            None | Some(IkMethod::Auto) => Method::Auto,
            Some(IkMethod::PseudoInverse) => Method::PseudoInverse,
        })
    }

    fn settings(&self, robot: &Robot) -> Result<IkSettings, Refusal> {
        let method = self.method()?;
        let posture = match (&self.posture, self.posture_gain) {
            (None, None) => None,
            (None, Some(_)) => {
                return refuse(
                    Code::UnknownField,
                    "`posture_gain` is for `posture`, which is not given",
                );
            }
            (Some(q), gain) => Some(Posture {
                q: positions(robot, "posture", q)?.as_slice().to_vec(),
                gain: gain.unwrap_or(DEFAULT_POSTURE_GAIN),
            }),
        };
        let default = IkSettings::default();
        Ok(IkSettings {
            method,
            max_iterations: self.max_iterations.unwrap_or(default.max_iterations),
            restarts: self.restarts.unwrap_or(default.restarts),
            tolerance_m: self.tolerance_m.unwrap_or(default.tolerance_m),
            tolerance_rad: self.tolerance_rad.unwrap_or(default.tolerance_rad),
            respect_limits: self.respect_limits.unwrap_or(default.respect_limits),
            chain: self.chain_entries(robot)?,
            posture,
            ..default
        })
    }

    /// The entries of `q` of the joints that may move.
    fn chain_entries(&self, robot: &Robot) -> Result<Option<Vec<usize>>, Refusal> {
        let entry = |name: &String| {
            let found = robot.moving_joints().position(|joint| joint.name == *name);
            found.ok_or_else(|| {
                let known = robot.moving_joints().map(|joint| joint.name.as_str());
                let known = suggest(name, "joints that move", known);
                let message = format!("no joint that moves is called `{name}`; {known}");
                Refusal::new(Code::UnknownJoint, message)
            })
        };
        let names = self.chain.as_ref();
        let entries = names.map(|names| names.iter().map(entry).collect());
        entries.transpose()
    }
}

impl IkTarget {
    fn in_world(&self, path: &str, world_from_base: &Pose) -> Result<Target, Refusal> {
        let position_m = self
            .position_m
            .map(|p| world_from_base.transform_point(&p.into()).coords);
        let rotation = self.rotation.as_ref();
        let rotation = rotation
            .map(|rows| rotation_matrix(&format!("{path}.rotation"), rows))
            .transpose()?;
        let rotation = rotation.map(|r| world_from_base.rotation.matrix() * r);
        let refused = |code, message: &str| refuse(code, format!("`{path}`: {message}"));
        match (position_m, rotation, self.axis, self.direction) {
            (Some(position_m), None, None, None) => Ok(Target::Position(position_m)),
            (Some(position_m), Some(rotation), None, None) => {
                Ok(Target::Pose(pose(rotation, position_m)))
            }
            (None, Some(rotation), None, None) => Ok(Target::Rotation(rotation)),
            (Some(position_m), None, Some(axis), Some(direction)) => {
                let unit = |v: Vector3<f64>| Unit::try_new(v, f64::MIN_POSITIVE);
                let direction = world_from_base.rotation * Vector3::from(direction);
                match (unit(axis.into()), unit(direction)) {
                    (Some(axis_in_frame), Some(direction_in_world)) => Ok(Target::Axis {
                        position_m,
                        axis_in_frame,
                        direction_in_world,
                    }),
                    _ => refused(Code::OutOfRange, "`axis` and `direction` must not be zero"),
                }
            }
            (None, None, None, None) => refused(
                Code::MissingField,
                "a target has `position_m`, `rotation`, both, or `position_m` with `axis` and `direction`",
            ),
            _ => refused(
                Code::MissingField,
                "`axis`, `direction` and `position_m` belong together, without `rotation`",
            ),
        }
    }
}

impl From<IkError> for Refusal {
    fn from(error: IkError) -> Self {
        let code = match error {
            IkError::JointCount { .. } => Code::WrongLength,
            IkError::NoSuchJoint { .. } => Code::UnknownJoint,
            IkError::Value { .. } => Code::OutOfRange,
            IkError::NoGoal => Code::MissingField,
            IkError::Budget { .. } => Code::TooLarge,
            IkError::Loops(error) => return Self::from(error),
        };
        Self::new(code, error)
    }
}

/// Three rows as a matrix, if they are those of a rotation.
pub(super) fn rotation_matrix(path: &str, rows: &[[f64; 3]; 3]) -> Result<Matrix3<f64>, Refusal> {
    let r = Matrix3::from_fn(|i, j| rows[i][j]);
    let off = (r * r.transpose() - Matrix3::identity()).amax();
    if off <= ROTATION_TOLERANCE && r.determinant() > 0.0 {
        return Ok(r);
    }
    refuse(
        Code::OutOfRange,
        format!(
            "`{path}` is not a rotation: its rows must have length 1, be at right angles and be right-handed"
        ),
    )
}
