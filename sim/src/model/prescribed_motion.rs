//! Prescribed motion of a kinematic body: a pose and a twist for every time, unaffected by contact.

use crate::spatial::{Pose, Twist, pose, rotation_exp, rotation_log};

/// A law of motion in the world.
#[derive(Debug, Clone, PartialEq)]
pub struct Motion {
    law: Law,
}

#[derive(Debug, Clone, PartialEq)]
enum Law {
    /// A constant velocity from the pose at time zero.
    Steady {
        world_from_start: Pose,
        twist: Twist,
    },
    /// In a straight line at constant speed from each point to the next.
    Waypoints {
        /// At least two, with increasing times.
        points: Vec<Waypoint>,
        /// The twist from each point but the last to the next.
        twists: Vec<Twist>,
        repeat: bool,
    },
}

/// A pose at a time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Waypoint {
    /// The time at which the body is there \[s\].
    pub time_s: f64,
    /// The pose of the body.
    pub world_from_body: Pose,
}

impl Motion {
    /// Moves from `world_from_start` at time zero with a constant velocity in world axes.
    pub fn steady(world_from_start: Pose, twist: Twist) -> Self {
        let law = Law::Steady {
            world_from_start,
            twist,
        };
        Self { law }
    }

    /// Moves through `points`: at rest before the first and after the last or, if `repeat` is set, from the last on to the first again.
    /// `None` for fewer than two points or times that do not increase.
    ///
    /// Between two points the origin moves in a straight line and the body rotates about one axis by the smaller angle, both at constant
    /// speed. If the motion repeats, the last pose should equal the first, or the body jumps.
    pub fn through(points: Vec<Waypoint>, repeat: bool) -> Option<Self> {
        let rising = |pair: &[Waypoint]| pair[0].time_s < pair[1].time_s;
        if points.len() < 2 || !points.windows(2).all(rising) {
            return None;
        }
        let twists = points.windows(2).map(|pair| even_pace(&pair[0], &pair[1]));
        let law = Law::Waypoints {
            twists: twists.collect(),
            points,
            repeat,
        };
        Some(Self { law })
    }

    /// Pose of the body at `time_s`, velocity of its origin and angular velocity, world axes.
    ///
    /// At a waypoint the velocity is that of the following segment.
    pub fn at(&self, time_s: f64) -> (Pose, Twist) {
        match &self.law {
            Law::Steady {
                world_from_start,
                twist,
            } => (moved(world_from_start, twist, time_s), *twist),
            Law::Waypoints {
                points,
                twists,
                repeat,
            } => {
                let (first, last) = (points[0].time_s, points[points.len() - 1].time_s);
                let mut time_s = time_s;
                if *repeat && time_s > first {
                    time_s = first + (time_s - first) % (last - first); // exact: a remainder has no rounding
                }
                // how many points have been reached
                let reached = points.partition_point(|point| point.time_s <= time_s);
                match (reached.checked_sub(1), twists.get(reached.wrapping_sub(1))) {
                    (None, _) => (points[0].world_from_body, Twist::zero()),
                    (Some(i), None) => (points[i].world_from_body, Twist::zero()),
                    (Some(i), Some(twist)) => {
                        let from = &points[i];
                        let pose = moved(&from.world_from_body, twist, time_s - from.time_s);
                        (pose, *twist)
                    }
                }
            }
        }
    }
}

/// `start` after moving with `twist` for `time_s`.
fn moved(start: &Pose, twist: &Twist, time_s: f64) -> Pose {
    pose(
        rotation_exp(&(twist.angular * time_s)) * start.rotation.matrix(),
        start.translation.vector + twist.linear * time_s,
    )
}

/// The constant velocity from one point to the next.
fn even_pace(from: &Waypoint, to: &Waypoint) -> Twist {
    let time_s = to.time_s - from.time_s;
    let (a, b) = (&from.world_from_body, &to.world_from_body);
    let turn = b.rotation.matrix() * a.rotation.matrix().transpose();
    Twist {
        linear: (b.translation.vector - a.translation.vector) / time_s,
        angular: rotation_log(&turn) / time_s,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spatial::rotation_from_rpy_deg;
    use nalgebra::{Matrix3, Vector3};
    use std::f64::consts::FRAC_PI_2;

    fn at(time_s: f64, xyz: [f64; 3], yaw_deg: f64) -> Waypoint {
        let rotation = rotation_from_rpy_deg([0.0, 0.0, yaw_deg]);
        Waypoint {
            time_s,
            world_from_body: pose(rotation, Vector3::from(xyz)),
        }
    }

    #[test]
    fn a_steady_motion_by_hand() {
        let start = pose(Matrix3::identity(), Vector3::new(1.0, 0.0, 0.5));
        let twist = Twist {
            linear: Vector3::new(0.0, 2.0, 0.0),
            angular: Vector3::new(0.0, 0.0, FRAC_PI_2),
        };
        let (pose, now) = Motion::steady(start, twist).at(1.0);
        assert_eq!(pose.translation.vector, Vector3::new(1.0, 2.0, 0.5));
        // a quarter turn takes x to y, to a rounding of the sine
        assert!((pose.rotation * Vector3::x() - Vector3::y()).norm() < 1e-15);
        assert_eq!(now, twist);
    }

    #[test]
    fn waypoints_by_hand() {
        let motion = Motion::through(
            vec![
                at(1.0, [0.0, 0.0, 0.0], 0.0),
                at(3.0, [4.0, 0.0, 0.0], 90.0),
                at(4.0, [4.0, 0.0, 3.0], 90.0),
            ],
            false,
        )
        .unwrap();
        let x = |time_s| motion.at(time_s).0.translation.vector;
        let v = |time_s| motion.at(time_s).1.linear;
        let zero = Vector3::zeros();
        // at rest before, on the way, and at rest after
        assert_eq!((x(0.0), v(0.0)), (zero, zero));
        assert_eq!((x(1.0), v(1.0)), (zero, Vector3::new(2.0, 0.0, 0.0)));
        assert_eq!(x(2.5), Vector3::new(3.0, 0.0, 0.0));
        assert_eq!(v(3.0), Vector3::new(0.0, 0.0, 3.0));
        assert_eq!(x(3.5), Vector3::new(4.0, 0.0, 1.5));
        assert_eq!((x(4.0), v(4.0)), (Vector3::new(4.0, 0.0, 3.0), zero));
        assert_eq!((x(1e9), v(1e9)), (Vector3::new(4.0, 0.0, 3.0), zero));
        // halfway through the quarter turn
        let (half, twist) = motion.at(2.0);
        let expected = rotation_from_rpy_deg([0.0, 0.0, 45.0]);
        assert!((half.rotation.matrix() - expected).norm() < 1e-15);
        assert!((twist.angular - Vector3::z() * FRAC_PI_2 / 2.0).norm() < 1e-15);
    }

    #[test]
    fn a_repeated_motion_goes_to_and_fro() {
        let points = vec![
            at(0.0, [0.0; 3], 0.0),
            at(1.0, [1.0, 0.0, 0.0], 0.0),
            at(2.0, [0.0; 3], 0.0),
        ];
        let motion = Motion::through(points, true).unwrap();
        for lap in [0.0, 2.0, 4.0, 2e6] {
            let (pose, twist) = motion.at(lap + 0.25);
            assert_eq!((pose.translation.x, twist.linear.x), (0.25, 1.0));
            let (pose, twist) = motion.at(lap + 1.75);
            assert_eq!((pose.translation.x, twist.linear.x), (0.25, -1.0));
            assert_eq!(motion.at(lap).1.linear.x, 1.0);
        }
    }

    #[test]
    fn points_that_do_not_follow_each_other_are_no_motion() {
        let here = at(1.0, [0.0; 3], 0.0);
        assert_eq!(Motion::through(vec![], false), None);
        assert_eq!(Motion::through(vec![here], true), None);
        assert_eq!(Motion::through(vec![here, here], true), None);
        let never = at(f64::NAN, [0.0; 3], 0.0);
        assert_eq!(Motion::through(vec![here, never], true), None);
    }

    proptest::proptest! {
        #[test]
        fn the_twist_is_the_slope_of_the_pose(
            time_s in 0.1..2.9_f64,
            yaw in -170.0..170.0_f64, roll in -80.0..80.0_f64, x in -2.0..2.0_f64,
        ) {
            let last = Waypoint {
                time_s: 3.0,
                world_from_body: pose(
                    rotation_from_rpy_deg([roll, 0.0, yaw]),
                    Vector3::new(x, 1.0, 0.0),
                ),
            };
            let motion = Motion::through(vec![at(0.0, [0.0; 3], 20.0), last], false).unwrap();
            let h = 1e-5; // truncation O(h²) and round-off O(ε/h) both near 1e-11
            let ((a, _), (b, _)) = (motion.at(time_s - h), motion.at(time_s + h));
            let (_, twist) = motion.at(time_s);
            let linear = (b.translation.vector - a.translation.vector) / (2.0 * h);
            let turn = b.rotation.matrix() * a.rotation.matrix().transpose();
            proptest::prop_assert!((linear - twist.linear).norm() < 1e-9);
            proptest::prop_assert!((rotation_log(&turn) / (2.0 * h) - twist.angular).norm() < 1e-9);
            // and it arrives
            let (end, _) = motion.at(3.0 - 1e-12);
            let missed = end.rotation.matrix() - last.world_from_body.rotation.matrix();
            proptest::prop_assert!(missed.norm() < 1e-10);
        }
    }
}
