//! How much of the TCP's pose a task asks for or gives: its position alone, or how it is turned, too.

use kinemark_sim::kinematics::forward_kinematics;
use kinemark_sim::model::robot::Robot;
use kinemark_sim::spatial::Pose;
use nalgebra::{Matrix3, Rotation3, Vector3};

use super::value::Value;

/// How much of the TCP's pose a function task asks for or gives, in the lab's frame.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum PoseForm {
    /// `[x, y, z]` \[m\].
    #[default]
    Position,
    /// `[x, y, z, yaw]`: the position, and the heading of the TCP's x axis about z of the lab's frame \[m, rad\].
    Yaw,
    /// `[x, y, z, ax, ay, az]`: the position, and the unit vector along one axis of the TCP \[m\].
    Axis {
        /// That axis in the frame of the TCP, a unit vector.
        of_tcp: Vector3<f64>,
    },
    /// The 4 x 4 matrix that takes points of the TCP's frame to the lab's.
    Full,
}

impl PoseForm {
    /// The names that labs have for them.
    pub const NAMES: [&'static str; 4] = ["position", "yaw", "axis", "full"];

    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Position => Self::NAMES[0],
            Self::Yaw => Self::NAMES[1],
            Self::Axis { .. } => Self::NAMES[2],
            Self::Full => Self::NAMES[3],
        }
    }

    /// How many numbers it has; those of a matrix row by row.
    pub fn numbers(self) -> usize {
        match self {
            Self::Position => 3,
            Self::Yaw => 4,
            Self::Axis { .. } => 6,
            Self::Full => 16,
        }
    }

    /// Whether it says more than the position.
    pub fn is_turned(self) -> bool {
        self != Self::Position
    }

    /// What an answer of this form looks like, in words.
    pub fn expected(self) -> &'static str {
        match self {
            Self::Position => "3 numbers [x, y, z]",
            Self::Yaw => "4 numbers [x, y, z, yaw]",
            Self::Axis { .. } => "6 numbers [x, y, z, ax, ay, az]",
            Self::Full => "4 x 4 numbers (rows x columns)",
        }
    }

    /// `pose` in this form: its numbers, those of a matrix row by row.
    pub fn of(self, pose: &Pose) -> Vec<f64> {
        let p = pose.translation.vector;
        let r = pose.rotation.matrix();
        let mut numbers = p.as_slice().to_vec();
        match self {
            Self::Position => {}
            Self::Yaw => numbers.push(yaw_rad(r)),
            Self::Axis { of_tcp } => numbers.extend((r * of_tcp).iter()),
            Self::Full => {
                let row = |i: usize| [r[(i, 0)], r[(i, 1)], r[(i, 2)], p[i]];
                numbers = (0..3).flat_map(row).collect();
                numbers.extend([0.0, 0.0, 0.0, 1.0]);
            }
        }
        numbers
    }

    /// The position in numbers of this form.
    pub fn position(self, numbers: &[f64]) -> Vector3<f64> {
        match self {
            Self::Full => Vector3::new(numbers[3], numbers[7], numbers[11]),
            _ => Vector3::new(numbers[0], numbers[1], numbers[2]),
        }
    }

    /// How far `numbers` of this form are from `truth`, numbers of this form: the distance \[m\] and the angle between \[rad\], which is
    /// zero where only positions count.
    ///
    /// Of a matrix the angle is `2 asin(‖R - R_true‖ / (2 √2))` in the Frobenius norm: that of the turn between two rotations, and
    /// at least as much for what is none; `π` where the norm is beyond that of any rotation. An axis is compared by its direction, and
    /// one without any is off by `π`.
    pub fn off(self, numbers: &[f64], truth: &[f64]) -> (f64, f64) {
        let distance = (self.position(numbers) - self.position(truth)).norm();
        (distance, self.angle_off(numbers, truth))
    }

    fn angle_off(self, numbers: &[f64], truth: &[f64]) -> f64 {
        use std::f64::consts::PI;
        match self {
            Self::Position => 0.0,
            Self::Yaw => {
                let turn = (numbers[3] - truth[3]).abs() % (2.0 * PI);
                turn.min(2.0 * PI - turn)
            }
            Self::Axis { .. } => {
                let axis = |of: &[f64]| Vector3::new(of[3], of[4], of[5]);
                let (axis, wanted) = (axis(numbers), axis(truth));
                match axis.norm() > 0.0 {
                    true => libm::atan2(axis.cross(&wanted).norm(), axis.dot(&wanted)),
                    false => PI,
                }
            }
            Self::Full => {
                // the last row is a matter of shape, and is looked at where answers are read
                let rotation = |of: &[f64]| Matrix3::from_fn(|i, j| of[4 * i + j]);
                let chord = (rotation(numbers) - rotation(truth)).norm();
                2.0 * libm::asin((chord / (2.0 * std::f64::consts::SQRT_2)).min(1.0))
            }
        }
    }

    /// Numbers of this form as submissions are given them: a list, or a matrix as a list of rows.
    pub fn value(self, numbers: &[f64]) -> Value {
        let list =
            |numbers: &[f64]| Value::List(numbers.iter().copied().map(Value::Number).collect());
        match self {
            Self::Full => Value::List(numbers.chunks_exact(4).map(list).collect()),
            _ => list(numbers),
        }
    }
}

/// The heading of the x axis about z \[rad\].
fn yaw_rad(r: &Matrix3<f64>) -> f64 {
    libm::atan2(r[(1, 0)], r[(0, 0)])
}

/// The pose of the TCP in the frame `frame` at `q`, shape `(n)`; `None` if `q` does not fit the robot, or there is no such frame.
pub fn pose_in(robot: &Robot, frame: &str, q: &[f64]) -> Option<Pose> {
    let q = robot.positions(q).ok()?;
    let poses = forward_kinematics(robot, &q);
    let world_from_lab = poses.world_from(robot.frame(frame)?);
    Some(world_from_lab.inv_mul(&poses.world_from(robot.tcp())))
}

/// The pose at a position that is turned so.
pub fn pose_at(position_m: Vector3<f64>, rotation: Rotation3<f64>) -> Pose {
    Pose::from_parts(position_m.into(), rotation)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{FRAC_PI_2, PI};

    fn turned(rotation: Rotation3<f64>) -> Pose {
        pose_at(Vector3::new(1.0, 2.0, 3.0), rotation)
    }

    #[test]
    fn a_pose_has_its_numbers_in_every_form() {
        let quarter = turned(Rotation3::from_axis_angle(&Vector3::z_axis(), FRAC_PI_2));
        let of_tcp = Vector3::y();
        let near = |form: PoseForm, expected: &[f64]| {
            let numbers = form.of(&quarter);
            assert_eq!(numbers.len(), form.numbers());
            for (got, expected) in numbers.iter().zip(expected) {
                assert!((got - expected).abs() < 1e-15, "{form:?}: {numbers:?}");
            }
        };
        near(PoseForm::Position, &[1.0, 2.0, 3.0]);
        near(PoseForm::Yaw, &[1.0, 2.0, 3.0, FRAC_PI_2]);
        near(PoseForm::Axis { of_tcp }, &[1.0, 2.0, 3.0, -1.0, 0.0, 0.0]);
        let rows = [
            [0.0, -1.0, 0.0, 1.0],
            [1.0, 0.0, 0.0, 2.0],
            [0.0, 0.0, 1.0, 3.0],
            [0.0, 0.0, 0.0, 1.0],
        ];
        near(PoseForm::Full, rows.as_flattened());
    }

    #[test]
    fn what_is_off_is_a_distance_and_an_angle() {
        let about = |axis, angle| Rotation3::from_axis_angle(&axis, angle);
        let truth = turned(about(Vector3::z_axis(), 3.0));
        for angle in [0.0, 1e-9, 0.5, 2.9, PI] {
            // 3 + 0.5 is past half a turn: the heading jumps there, and what is off does not
            let other = turned(about(Vector3::z_axis(), 3.0 + angle));
            for form in [
                PoseForm::Yaw,
                PoseForm::Axis {
                    of_tcp: Vector3::x(),
                },
                PoseForm::Full,
            ] {
                let (distance, off) = form.off(&form.of(&other), &form.of(&truth));
                assert_eq!(distance, 0.0);
                // near half a turn the chord says little about the angle
                assert!((off - angle).abs() < 1e-7, "{form:?} {angle}: {off}");
            }
        }
        let tilted = turned(about(Vector3::x_axis(), 0.3) * about(Vector3::z_axis(), 3.0));
        let (_, off) = PoseForm::Full.off(&PoseForm::Full.of(&tilted), &PoseForm::Full.of(&truth));
        assert!((off - 0.3).abs() < 1e-12, "{off}");
        // what is no rotation is off by more, never by nothing
        let mut scaled = PoseForm::Full.of(&truth);
        for i in [0, 1, 2, 4, 5, 6, 8, 9, 10] {
            scaled[i] *= 9.0;
        }
        assert_eq!(
            PoseForm::Full.off(&scaled, &PoseForm::Full.of(&truth)).1,
            PI
        );
        let axis = PoseForm::Axis {
            of_tcp: Vector3::x(),
        };
        let none = [1.0, 2.0, 3.0, 0.0, 0.0, 0.0];
        assert_eq!(axis.off(&none, &axis.of(&truth)).1, PI);
    }
}
