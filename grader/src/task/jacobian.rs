//! The Jacobian that answers are held against: of the TCP, in the lab's frame, with the rows the lab names.

use kinemark_sim::kinematics::forward_kinematics;
use kinemark_sim::kinematics::jacobian::fill;
use kinemark_sim::model::robot::Robot;
use nalgebra::{Matrix6xX, Vector3};

use crate::task::model::Rows;

/// Returns the geometric Jacobian of the TCP as seen from the frame `frame`, row by row, shape `(rows, n)`.
///
/// Its linear rows are the derivative of the position that `forward_kinematics` answers \[m/rad or m/m\], its angular ones the
/// angular velocity about the axes of `frame` per unit of joint velocity. `None` if `q` does not fit the robot, or there is no
/// such frame.
pub fn jacobian_in(robot: &Robot, frame: &str, q: &[f64], rows: Rows) -> Option<Vec<Vec<f64>>> {
    let q = robot.positions(q).ok()?;
    let frame = robot.frame(frame)?;
    let poses = forward_kinematics(robot, &q);
    let of = |frame| {
        let mut jacobian = Matrix6xX::zeros(robot.n());
        fill(robot, &poses, frame, &mut jacobian);
        jacobian
    };
    let (of_tcp, of_lab) = (of(robot.tcp()), of(frame));
    let world_from_lab = poses.world_from(frame);
    let p_tcp_from_lab =
        poses.world_from(robot.tcp()).translation.vector - world_from_lab.translation.vector;
    let mut matrix = vec![vec![0.0; robot.n()]; rows.indices().count()];
    for joint in 0..robot.n() {
        let part = |jacobian: &Matrix6xX<f64>, first: usize| {
            Vector3::from_fn(|row, _| jacobian[(first + row, joint)])
        };
        // the lab's frame stands still in every robot of ours, and need not
        let angular_lab = part(&of_lab, 3);
        let linear = part(&of_tcp, 0) - part(&of_lab, 0) - angular_lab.cross(&p_tcp_from_lab);
        let angular = part(&of_tcp, 3) - angular_lab;
        let to_lab = world_from_lab.rotation.inverse();
        let column = [to_lab * linear, to_lab * angular];
        for (place, row) in matrix.iter_mut().zip(rows.indices()) {
            place[joint] = column[row / 3][row % 3];
        }
    }
    Some(matrix)
}

/// The Frobenius norm of a matrix, its entries taken as they are in SI units.
pub fn norm(matrix: &[Vec<f64>]) -> f64 {
    root_of_squares(matrix.iter().flatten().copied())
}

/// The Frobenius norm of the difference of two matrices of one shape.
pub fn distance(a: &[Vec<f64>], b: &[Vec<f64>]) -> f64 {
    let entries = a.iter().flatten().zip(b.iter().flatten());
    root_of_squares(entries.map(|(a, b)| a - b))
}

/// The distance of `matrix` from `truth` as a fraction of the norm of `truth`; where that is zero, the distance itself.
pub fn relative_distance(matrix: &[Vec<f64>], truth: &[Vec<f64>]) -> f64 {
    let distance = distance(matrix, truth);
    match norm(truth) {
        norm if norm > 0.0 => distance / norm,
        _ => distance,
    }
}

fn root_of_squares(entries: impl Iterator<Item = f64>) -> f64 {
    entries.map(|x| x * x).sum::<f64>().sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use kinemark_sim::format::RobotFile;
    use kinemark_sim::text::Source;

    /// A planar arm of two unequal links whose lab frame is that of lab 1, and one whose lab frame rides on the first link.
    fn arm(frame_link: &str) -> Robot {
        let text = format!(
            r#"
            format = 1
            name = "arm"
            links = [{{ name = "base" }}, {{ name = "upper" }}, {{ name = "slide" }}, {{ name = "forearm" }}]
            frames = [
                {{ name = "tcp", link = "forearm", origin = {{ xyz_m = [0.1, 0.2, 0.8], rpy_deg = [10.0, 20.0, 30.0] }} }},
                {{ name = "lab", link = "{frame_link}", origin = {{ xyz_m = [0.3, 0.0, 0.1], x_axis = [0.0, 0.0, 1.0], y_axis = [1.0, 0.0, 0.0] }} }},
            ]
            [[joints]]
            name = "shoulder"
            type = "revolute"
            parent = "base"
            child = "upper"
            origin = {{ xyz_m = [0.0, 0.1, 2.0] }}
            axis = [0.0, 1.0, 0.0]
            [[joints]]
            name = "reach"
            type = "prismatic"
            parent = "upper"
            child = "slide"
            origin = {{ xyz_m = [0.0, 0.0, 1.3], rpy_deg = [0.0, 15.0, 40.0] }}
            axis = [0.0, 0.0, 1.0]
            [[joints]]
            name = "elbow"
            type = "revolute"
            parent = "slide"
            child = "forearm"
            axis = [0.6, 0.0, 0.8]
            "#
        );
        let file = RobotFile::parse(Source::new("arm.toml", text)).unwrap();
        file.build(&[]).unwrap()
    }

    const ALL: [&str; 6] = Rows::NAMES;

    #[test]
    fn it_is_the_derivative_of_the_forward_kinematics() {
        let all = Rows::named(ALL).unwrap();
        let h = 1e-5; // truncation O(h²) and round-off O(ε/h) meet near 1e-10
        for robot in [arm("base"), arm("upper")] {
            for q in [[0.0; 3], [0.7, 0.2, -1.1], [-2.6, -0.4, 3.0]] {
                let jacobian = jacobian_in(&robot, "lab", &q, all).unwrap();
                let lab_from_tcp = |q: &[f64]| {
                    let poses = forward_kinematics(&robot, &robot.positions(q).unwrap());
                    let world_from_lab = poses.world_from(robot.frame("lab").unwrap());
                    world_from_lab.inv_mul(&poses.world_from(robot.tcp()))
                };
                for joint in 0..3 {
                    let moved = |by: f64| {
                        let mut q = q;
                        q[joint] += by;
                        lab_from_tcp(&q)
                    };
                    let (after, before) = (moved(h), moved(-h));
                    let linear = (after.translation.vector - before.translation.vector) / (2.0 * h);
                    let turned = after.rotation * before.rotation.inverse();
                    // the part of a small turn that is odd in it: its angle comes from an arc cosine, which is blind near 1
                    let r = turned.matrix();
                    let odd = |i, j| (r[(i, j)] - r[(j, i)]) / 2.0;
                    let angular = Vector3::new(odd(2, 1), odd(0, 2), odd(1, 0)) / (2.0 * h);
                    for (row, expected) in linear.iter().chain(angular.iter()).enumerate() {
                        let got = jacobian[row][joint];
                        assert!(
                            (got - expected).abs() <= 1e-9,
                            "{row} {joint}: {got} {expected}"
                        );
                    }
                }
            }
        }
    }

    #[test]
    fn a_planar_arm_at_right_angles_is_worked_by_hand() {
        // straight up: the shoulder moves what is `r` above it by `r` along y of the lab
        let robot = arm("base");
        let rows = Rows::named(["x", "y", "rz"]).unwrap();
        let jacobian = jacobian_in(&robot, "lab", &[0.0; 3], rows).unwrap();
        let poses = forward_kinematics(&robot, &robot.positions(&[0.0; 3]).unwrap());
        let p = poses.world_from(robot.tcp()).translation.vector;
        for (got, expected) in [
            (jacobian[0][0], -p.x),      // x of the lab is up
            (jacobian[1][0], p.z - 2.0), // y of the lab is x of the world
            (jacobian[2][0], 1.0),       // the joint's axis is z of the lab
        ] {
            assert!((got - expected).abs() <= 1e-12, "{got} {expected}");
        }
        assert_eq!(jacobian_in(&robot, "lab", &[0.0; 2], rows), None);
        assert_eq!(jacobian_in(&robot, "nowhere", &[0.0; 3], rows), None);
    }

    #[test]
    fn a_distance_is_relative_to_what_there_is() {
        let truth = vec![vec![3.0, 0.0], vec![0.0, 4.0]];
        let other = vec![vec![3.0, 0.3], vec![0.4, 4.0]];
        assert!((relative_distance(&other, &truth) - 0.1).abs() <= 1e-15);
        let nothing = vec![vec![0.0; 2]; 2];
        assert_eq!(relative_distance(&nothing, &nothing), 0.0);
        assert_eq!(relative_distance(&truth, &nothing), 5.0);
        let nan = vec![vec![f64::NAN; 2]; 2];
        assert!(relative_distance(&nan, &truth).is_nan());
    }
}
