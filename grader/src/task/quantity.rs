//! Quantities of a robot that function tasks ask for, beside poses and Jacobians: how the TCP moves, and which efforts the joints need.
//! What is right is computed by the simulator's own kinematics and dynamics.

use kinemark_sim::dynamics::{coriolis_effort, gravity_effort, inverse_dynamics, mass_matrix};
use kinemark_sim::kinematics::derivative::jacobian_derivative;
use kinemark_sim::kinematics::{forward_kinematics, geometric_jacobian};
use kinemark_sim::model::robot::Robot;
use nalgebra::{DVector, Vector3};

use super::jacobian::jacobian_in;
use super::model::Rows;
use super::task_joints::{TaskJoints, WholeMotion};

/// A quantity that a function of a submission computes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Quantity {
    /// `velocity(robot, q, qd)`: of the TCP in the lab's frame, these rows \[m/s, then rad/s\].
    Velocity(Rows),
    /// `acceleration(robot, q, qd, qdd)`: of the TCP along the lab's axes, these rows \[m/s², then rad/s²\].
    Acceleration(Rows),
    /// `torque(robot, q, qd, qdd)`: inverse dynamics, one effort per joint, with damping and dry friction \[N m or N\].
    Torque,
    /// `gravity(robot, q)`: the efforts that hold the robot still, one per joint \[N m or N\].
    Gravity,
    /// `coriolis(robot, q, qd)`: Coriolis and centrifugal efforts, one per joint \[N m or N\].
    Coriolis,
    /// `mass_matrix(robot, q)`: the joint-space inertia, armatures included \[kg m², kg m or kg\].
    MassMatrix,
}

/// What of a motion a quantity depends on: names in submissions and units.
pub const STATE: [(&str, &str); 3] = [
    ("q", "rad or m"),
    ("qd", "rad/s or m/s"),
    ("qdd", "rad/s² or m/s²"),
];

impl Quantity {
    /// All of them; those of the TCP with `rows`.
    pub const fn all(rows: Rows) -> [Self; 6] {
        [
            Self::Velocity(rows),
            Self::Acceleration(rows),
            Self::Torque,
            Self::Gravity,
            Self::Coriolis,
            Self::MassMatrix,
        ]
    }

    /// Its name in labs and submissions.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Velocity(_) => "velocity",
            Self::Acceleration(_) => "acceleration",
            Self::Torque => "torque",
            Self::Gravity => "gravity",
            Self::Coriolis => "coriolis",
            Self::MassMatrix => "mass_matrix",
        }
    }

    /// How many of `q`, `qd`, `qdd` it depends on.
    pub const fn order(self) -> usize {
        match self {
            Self::Gravity | Self::MassMatrix => 1,
            Self::Velocity(_) | Self::Coriolis => 2,
            Self::Acceleration(_) | Self::Torque => 3,
        }
    }

    /// The parameters of its function in submissions.
    pub fn parameters(self) -> Vec<&'static str> {
        let state = STATE.iter().take(self.order()).map(|(name, _)| *name);
        std::iter::once("robot").chain(state).collect()
    }

    /// Its rows, where it has some of the six of the TCP.
    pub fn rows(self) -> Option<Rows> {
        match self {
            Self::Velocity(rows) | Self::Acceleration(rows) => Some(rows),
            _ => None,
        }
    }

    /// Whether it depends on masses.
    pub const fn needs_masses(self) -> bool {
        !matches!(self, Self::Velocity(_) | Self::Acceleration(_))
    }

    /// Whether gravity makes a difference.
    pub const fn feels_gravity(self) -> bool {
        matches!(self, Self::Torque | Self::Gravity)
    }

    /// Whether its answer is a matrix; else a list.
    pub const fn is_matrix(self) -> bool {
        matches!(self, Self::MassMatrix)
    }

    /// How many numbers its answer has for so many joints: those of a matrix row by row.
    pub fn count(self, joints: usize) -> usize {
        match self {
            Self::Velocity(rows) | Self::Acceleration(rows) => rows.indices().count(),
            Self::Torque | Self::Gravity | Self::Coriolis => joints,
            Self::MassMatrix => joints * joints,
        }
    }

    /// Its value, the numbers of a matrix row by row, where the joints of a task move as in `state`: positions, velocities and
    /// accelerations, each of as many numbers as there are joints; what is left out is zero.
    ///
    /// `frame` is the lab's, and `gravity_m_s2` is in the world. `None` where `state` does not fit the robot, there is no such frame, or
    /// loops cannot be closed or do not determine how the robot moves.
    pub fn at(
        self,
        robot: &Robot,
        joints: &TaskJoints,
        frame: &str,
        gravity_m_s2: &Vector3<f64>,
        state: &[Vec<f64>],
    ) -> Option<Vec<f64>> {
        let zeros = vec![0.0; joints.count()];
        let part = |i: usize| state.get(i).unwrap_or(&zeros).as_slice();
        let whole = joints.motion(robot, [part(0), part(1), part(2)])?;
        let WholeMotion { q, qd, qdd } = &whole;
        let (positions, velocities, accelerations) = (
            robot.positions(q).ok()?,
            robot.velocities(qd).ok()?,
            robot.accelerations(qdd).ok()?,
        );
        let efforts = match self {
            Self::Velocity(rows) => {
                let jacobian = jacobian_in(robot, frame, q, rows)?;
                let rate = |row: &Vec<f64>| row.iter().zip(qd).map(|(j, v)| j * v).sum();
                return Some(jacobian.iter().map(rate).collect());
            }
            Self::Acceleration(rows) => return acceleration(robot, frame, &whole, rows),
            Self::MassMatrix => {
                let matrix = mass_matrix(robot, &positions);
                let rows = matrix.row_iter().map(|row| row.iter().copied().collect());
                let half = joints.per_joint(robot, q, &rows.collect::<Vec<Vec<f64>>>())?;
                let both = joints.per_joint(robot, q, &transposed(&half))?;
                return Some(transposed(&both).concat());
            }
            Self::Torque => {
                inverse_dynamics(robot, gravity_m_s2, &positions, &velocities, &accelerations)
            }
            Self::Gravity => gravity_effort(robot, gravity_m_s2, &positions),
            Self::Coriolis => coriolis_effort(robot, &positions, &velocities),
        };
        let mut rows = joints.per_joint(robot, q, &[efforts.as_slice().to_vec()])?;
        rows.pop()
    }
}

/// The acceleration of the TCP along the axes of the frame `frame`, which stands still.
fn acceleration(
    robot: &Robot,
    frame: &str,
    WholeMotion { q, qd, qdd }: &WholeMotion,
    rows: Rows,
) -> Option<Vec<f64>> {
    let (q, qd) = (robot.positions(q).ok()?, robot.velocities(qd).ok()?);
    let jacobian = geometric_jacobian(robot, &q, robot.tcp());
    let derivative = jacobian_derivative(robot, &q, &qd, robot.tcp());
    let in_world = jacobian * DVector::from_column_slice(qdd)
        + derivative * DVector::from_column_slice(qd.as_slice());
    let poses = forward_kinematics(robot, &q);
    let to_lab = poses.world_from(robot.frame(frame)?).rotation.inverse();
    let part = |first: usize| to_lab * Vector3::from_fn(|i, _| in_world[first + i]);
    let both = [part(0), part(3)];
    Some(rows.indices().map(|row| both[row / 3][row % 3]).collect())
}

/// The columns of a matrix as rows.
fn transposed(rows: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let columns = rows.first().map_or(0, Vec::len);
    let column = |j: usize| rows.iter().map(|row| row[j]).collect();
    (0..columns).map(column).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::task::pose::pose_in;
    use kinemark_sim::dynamics::{GRAVITY_M_S2, driven_efforts, driven_mass_matrix};
    use kinemark_sim::format::RobotFile;
    use kinemark_sim::text::Source;

    fn robot(path: &str) -> Robot {
        let path = format!("{}/../labs/robots/{path}", env!("CARGO_MANIFEST_DIR"));
        let text = std::fs::read_to_string(&path).unwrap();
        RobotFile::parse(Source::new(path, text))
            .unwrap()
            .build(&[])
            .unwrap()
    }

    fn state(count: usize) -> Vec<Vec<f64>> {
        let number = |k: usize, i: usize| 0.1 * (k + 1) as f64 - 0.07 * i as f64;
        (0..3)
            .map(|k| (0..count).map(|i| number(k, i)).collect())
            .collect()
    }

    /// Velocity and acceleration against differences of the pose along a motion, for a plain robot and one with loops.
    #[test]
    fn the_tcp_moves_as_differences_of_its_pose_say() {
        let all = Rows::named(Rows::NAMES).unwrap();
        for path in ["rrbot.toml", "puma560.toml", "uarm.toml"] {
            let robot = robot(path);
            let joints = TaskJoints::of(&robot, &[]);
            let state = state(joints.count());
            let frame = robot.links()[0].name.as_str();
            let at = |t: f64| {
                let entry = |i: usize| state[0][i] + state[1][i] * t + 0.5 * state[2][i] * t * t;
                let q: Vec<f64> = (0..joints.count()).map(entry).collect();
                pose_in(&robot, frame, &joints.positions(&robot, &q).unwrap()).unwrap()
            };
            let h = 1e-4;
            let (before, now, after) = (at(-h), at(0.0), at(h));
            let of = |quantity: Quantity| {
                let gravity = &GRAVITY_M_S2;
                quantity
                    .at(&robot, &joints, frame, gravity, &state)
                    .unwrap()
            };
            let (velocity, acceleration) =
                (of(Quantity::Velocity(all)), of(Quantity::Acceleration(all)));
            let [p0, p1, p2] = [&before, &now, &after].map(|pose| pose.translation.vector);
            for i in 0..3 {
                let v = (p2[i] - p0[i]) / (2.0 * h);
                let a = (p2[i] - 2.0 * p1[i] + p0[i]) / (h * h);
                assert!(
                    (velocity[i] - v).abs() < 1e-6,
                    "{path} {i}: {} {v}",
                    velocity[i]
                );
                assert!(
                    (acceleration[i] - a).abs() < 1e-5,
                    "{path} {i}: {} {a}",
                    acceleration[i]
                );
            }
            // R after and before, R' = w x R: the turn between them, and how it changes
            let turn = |from: &_, to: &kinemark_sim::spatial::Pose| {
                let from: &kinemark_sim::spatial::Pose = from;
                let r = (to.rotation * from.rotation.inverse()).into_inner();
                Vector3::new(
                    r[(2, 1)] - r[(1, 2)],
                    r[(0, 2)] - r[(2, 0)],
                    r[(1, 0)] - r[(0, 1)],
                ) / 2.0
            };
            let (w, dw) = (
                turn(&before, &after) / (2.0 * h),
                (turn(&now, &after) - turn(&before, &now)) / (h * h),
            );
            for i in 0..3 {
                assert!((velocity[3 + i] - w[i]).abs() < 1e-6, "{path} {i}");
                assert!((acceleration[3 + i] - dw[i]).abs() < 1e-5, "{path} {i}");
            }
        }
    }

    #[test]
    fn efforts_of_loops_are_those_of_the_independent_joints() {
        let robot = robot("uarm.toml");
        let joints = TaskJoints::of(&robot, &[]);
        let state = state(joints.count());
        let frame = robot.links()[0].name.as_str();
        let of = |quantity: Quantity| {
            quantity
                .at(&robot, &joints, frame, &GRAVITY_M_S2, &state)
                .unwrap()
        };
        let expected =
            driven_efforts(&robot, &GRAVITY_M_S2, &state[0], &state[1], &state[2]).unwrap();
        for (got, expected) in of(Quantity::Torque).iter().zip(&expected.effort) {
            assert!((got - expected).abs() < 1e-12, "{got} {expected}");
        }
        let mass = driven_mass_matrix(&robot, &expected.q).unwrap();
        let got = of(Quantity::MassMatrix);
        for (i, got) in got.iter().enumerate() {
            let expected = mass[(i / joints.count(), i % joints.count())];
            assert!((got - expected).abs() < 1e-12, "{got} {expected}");
        }
        // without acceleration, friction and speed an effort is what gravity asks for
        let still = vec![state[0].clone()];
        let gravity = Quantity::Gravity.at(&robot, &joints, frame, &GRAVITY_M_S2, &still);
        let zeros = vec![0.0; joints.count()];
        let expected = driven_efforts(&robot, &GRAVITY_M_S2, &state[0], &zeros, &zeros).unwrap();
        for (got, expected) in gravity.unwrap().iter().zip(&expected.effort) {
            assert!((got - expected).abs() < 1e-12, "{got} {expected}");
        }
    }

    #[test]
    fn every_quantity_has_its_parameters_and_numbers() {
        let of = Quantity::all(Rows::LINEAR).map(|q| (q.name(), q.parameters().len(), q.count(4)));
        let expected = [
            ("velocity", 3, 3),
            ("acceleration", 4, 3),
            ("torque", 4, 4),
            ("gravity", 2, 4),
            ("coriolis", 3, 4),
            ("mass_matrix", 2, 16),
        ];
        assert_eq!(of, expected);
        assert_eq!(Quantity::Torque.parameters(), ["robot", "q", "qd", "qdd"]);
    }
}
