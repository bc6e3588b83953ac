//! Inverse kinematics: round trips on real arms, the textbook iterations against independent ones, targets of all kinds.

use std::f64::consts::PI;

use kinemark_sim::kinematics::chain::Chain;
use kinemark_sim::kinematics::closure::{closed_positions, loop_gap_m};
use kinemark_sim::kinematics::inverse::groups::{Group, solve_by_priority, solve_in_turn};
use kinemark_sim::kinematics::inverse::{
    ErrorClamp, Goal, IkAnswer, IkError, IkSettings, IkSolver, Method, Posture, Target,
    inverse_kinematics,
};
use kinemark_sim::kinematics::position_range::position_ranges;
use kinemark_sim::model::robot::Robot;
use kinemark_sim::spatial::{Pose, pose, rotation_exp, rotation_log};
use nalgebra::{Matrix3, Unit, Vector3};

use serde_json::Value;

use crate::arms::{Numbers, robot, rrbot};
use crate::differential::model;
use crate::golden_rrbot::{golden, numbers};

fn drawn(robot: &Robot, numbers: &mut Numbers) -> Vec<f64> {
    let ranges = position_ranges(robot);
    ranges
        .iter()
        .map(|range| range.sampled())
        .map(|(low, high)| numbers.between(low, high))
        .collect()
}

fn place(robot: &Robot, frame: &str, q: &[f64]) -> Pose {
    Chain::new(robot, robot.frame(frame).expect("the frame")).update(q)
}

/// How far two poses are apart \[m, rad\].
fn apart(a: &Pose, b: &Pose) -> (f64, f64) {
    let turn = a.rotation.matrix() * b.rotation.matrix().transpose();
    (
        (a.translation.vector - b.translation.vector).norm(),
        rotation_log(&turn).norm(),
    )
}

fn pose_goal<'f>(robot: &'f Robot, frame: &str, pose: Pose) -> Goal<'f> {
    Goal {
        frame: robot.frame(frame).expect("the frame"),
        target: Target::Pose(pose),
        weight: 1.0,
    }
}

/// How many of `count` reachable poses are reached from starts that have nothing to do with them.
fn round_trips(name: &str, frame: &str, count: usize) -> usize {
    let robot = model(name);
    let mut numbers = Numbers::new(1);
    let ranges = position_ranges(&robot);
    let goal = pose_goal(&robot, frame, Pose::identity());
    let mut solver = IkSolver::new(&robot, &[goal], IkSettings::default()).expect("a question");
    let mut solved = 0;
    for _ in 0..count {
        let wanted = place(&robot, frame, &drawn(&robot, &mut numbers));
        solver.set_target(0, Target::Pose(wanted)).expect("a pose");
        let answer = solver
            .solve(&drawn(&robot, &mut numbers))
            .expect("an answer");
        // judged here, not by the solver
        let (distance_m, angle_rad) = apart(&place(&robot, frame, &answer.q), &wanted);
        let inside = answer
            .q
            .iter()
            .zip(&ranges)
            .all(|(q, range)| range.contains(*q));
        let good = inside && distance_m <= 1e-5 && angle_rad <= 1e-5;
        assert_eq!(good, answer.reached);
        assert!(inside);
        solved += usize::from(good);
    }
    solved
}

#[test]
fn nearly_all_reachable_poses_of_the_ur5_are_reached() {
    assert!(round_trips("ur5", "tool0", 10_000) >= 9_950);
}

#[test]
fn nearly_all_reachable_poses_of_the_panda_are_reached() {
    assert!(round_trips("panda", "panda_hand_tcp", 10_000) >= 9_950);
}

/// One row of the golden file as a question.
struct Question {
    robot: Robot,
    chain: Vec<usize>,
    target: Target,
    settings: IkSettings,
    tip: String,
}

impl Question {
    fn of(row: &Value) -> Self {
        let robot = model("humanoid25");
        let name = |value: &Value| value.as_str().expect("a name").to_owned();
        let names = row["chain"].as_array().expect("chain");
        let chain: Vec<usize> = names
            .iter()
            .map(|v| {
                let mut joints = robot.moving_joints();
                joints
                    .position(|joint| joint.name == name(v))
                    .expect("the joint")
            })
            .collect();
        let rotation: Vec<f64> = (0..3).flat_map(|k| numbers(&row["target_R"][k])).collect();
        let position = Vector3::from_vec(numbers(&row["target_position"]));
        let target = if row["position_only"] == true {
            Target::Position(position)
        } else {
            Target::Pose(pose(Matrix3::from_row_slice(&rotation), position))
        };
        let method = match row["algorithm"].as_str() {
            Some("pinv") => Method::PseudoInverse,
            _ => Method::DampedLeastSquares {
                damping: row["lambda_"].as_f64(),
            },
        };
        let settings = IkSettings {
            method,
            max_iterations: 60,
            respect_limits: false,
            chain: Some(chain.clone()),
            ..IkSettings::default()
        };
        Self {
            tip: name(&row["tip"]),
            robot,
            chain,
            target,
            settings,
        }
    }

    fn whole(&self, q_chain: &[f64]) -> Vec<f64> {
        let mut q = vec![0.0; self.robot.n()];
        for (&joint, value) in self.chain.iter().zip(q_chain) {
            q[joint] = *value;
        }
        q
    }

    fn answer(&self, q_chain: &[f64], settings: &IkSettings) -> IkAnswer {
        let tip = self.robot.frame(&self.tip).expect("the tip");
        let q0 = self.whole(q_chain);
        inverse_kinematics(&self.robot, tip, self.target, &q0, settings).expect("an answer")
    }
}

/// Two rows leap by 165 and 1250 rad on their way, which multiplies the last of the twelve digits of their target by 1e10 within seven
/// steps: whether the sixtieth step has arrived depends on it (moving the start by 1e-15 turns one in three). They are held to
/// their first steps.
fn end_depends_on_rounding(row: &Value) -> bool {
    row["algorithm"] == "pinv"
        && row["position_only"] == false
        && row["max_abs_step_rad"].as_f64().expect("a number") > 100.0
}

#[test]
fn the_textbook_iterations_end_where_independent_ones_do() {
    let file = golden("F_humanoid25.json");
    let rows = file["ik"].as_array().expect("rows");
    let mut compared = 0;
    for (i, row) in rows.iter().enumerate() {
        let question = Question::of(row);
        let answer = question.answer(&numbers(&row["q0_chain"]), &question.settings);
        assert!(answer.q.iter().all(|x| x.is_finite()) && answer.residual_m.is_finite());
        let outside = (0..answer.q.len()).filter(|j| !question.chain.contains(j));
        assert!(outside.map(|j| answer.q[j]).all(|q| q == 0.0));
        if row["reproducible"] == false {
            assert!(!answer.reached, "row {i}");
            continue;
        }
        if end_depends_on_rounding(row) {
            continue;
        }
        compared += 1;
        let expected = |key: &str| row[key].as_f64().expect("a number");
        let expected_m = expected("final_position_error_m");
        assert!(
            (answer.residual_m - expected_m).abs() <= 1e-6,
            "row {i}: {answer:?}"
        );
        let mut arrived = expected_m <= 1e-5;
        if row["position_only"] == false {
            let expected_rad = expected("final_orientation_error_rad");
            assert!(
                (answer.residual_rad - expected_rad).abs() <= 1e-6,
                "row {i}: {answer:?}"
            );
            arrived &= expected_rad <= 1e-5;
        }
        assert_eq!(answer.reached, arrived, "row {i}");
    }
    assert_eq!((rows.len(), compared), (30, 20));
}

#[test]
fn the_first_textbook_steps_are_those_traced_by_an_independent_tool() {
    let file = golden("F_humanoid25.json");
    for (i, row) in file["ik"].as_array().expect("rows").iter().enumerate() {
        let question = Question::of(row);
        let trace = row["trace_first"].as_array().expect("a trace");
        // one step at a time, so that a leap does not multiply the rounding of the one before
        for pair in trace.windows(2).take(4) {
            let [before, after] = [0, 1].map(|k| numbers(&pair[k]));
            let one = IkSettings {
                max_iterations: 1,
                ..question.settings.clone()
            };
            let answer = question.answer(&before[1..], &one);
            assert_eq!(answer.iterations, 1);
            let largest = question.chain.iter().map(|&j| answer.q[j].abs());
            let scale = largest.fold(1.0, f64::max);
            for (&joint, value) in question.chain.iter().zip(&after[1..]) {
                // twelve digits before the step, which a leap of 100 rad multiplies
                let tolerance = 1e-10 * scale * scale;
                assert!(
                    (answer.q[joint] - value).abs() <= tolerance,
                    "row {i}: {} against {value}",
                    answer.q[joint]
                );
            }
        }
    }
}

#[test]
fn a_target_out_of_reach_is_answered_with_the_nearest_position() {
    // the course's arm: links of 1 m and its tool; straight towards a point beyond its reach is the best it can do
    let robot = rrbot();
    let tcp = robot.tcp();
    let straight = Chain::new(&robot, tcp)
        .update(&[0.0, 0.0])
        .translation
        .vector;
    let shoulder_to_tcp = 2.0;
    for method in [
        Method::Auto,
        Method::DampedLeastSquares { damping: None },
        Method::Fallback { damping: None },
    ] {
        let settings = IkSettings {
            method,
            ..IkSettings::default()
        };
        let beyond = straight + Vector3::new(0.0, 0.0, 0.5);
        let answer = inverse_kinematics(
            &robot,
            tcp,
            Target::Position(beyond),
            &[0.4, -0.3],
            &settings,
        )
        .expect("an answer");
        assert!(!answer.reached);
        assert!(
            (answer.residual_m - 0.5).abs() < 1e-6,
            "{method:?} {answer:?}"
        );
        assert!(answer.residual_rad <= 0.0);
        // hopelessly far
        let far = straight + Vector3::new(0.0, 0.0, 1e200);
        let answer =
            inverse_kinematics(&robot, tcp, Target::Position(far), &[0.4, -0.3], &settings)
                .expect("an answer");
        assert!(
            !answer.reached
                && answer.residual_m.is_finite()
                && answer.q.iter().all(|q| q.is_finite())
        );
        assert!(answer.residual_m >= 1e200 - shoulder_to_tcp);
    }
}

#[test]
fn an_error_clamp_takes_a_far_target_in_pieces() {
    let robot = model("ur5");
    let frame = robot.frame("tool0").expect("tool");
    let q0 = [0.1, -1.2, 1.4, -0.8, -1.3, 0.2];
    let mut wanted = place(&robot, "tool0", &q0);
    wanted.translation.vector.y += 0.25;
    let clamp = ErrorClamp {
        distance_m: 0.05,
        angle_rad: 0.1,
    };
    let settings = IkSettings {
        method: Method::PseudoInverse,
        error_clamp: Some(clamp),
        ..IkSettings::default()
    };
    let answer =
        inverse_kinematics(&robot, frame, Target::Pose(wanted), &q0, &settings).expect("an answer");
    assert!(answer.reached);
    // five pieces of 0.05 m, and what Newton needs at the end
    assert!((6..=12).contains(&answer.iterations), "{answer:?}");
    // one step moves the frame about as far as the clamp says
    let one = IkSettings {
        max_iterations: 1,
        ..settings
    };
    let answer =
        inverse_kinematics(&robot, frame, Target::Pose(wanted), &q0, &one).expect("an answer");
    assert!((answer.residual_m - 0.2).abs() < 0.01, "{answer:?}");
}

#[test]
fn an_axis_target_leaves_the_turn_about_it_free() {
    let robot = model("panda");
    let frame = robot.frame("panda_hand_tcp").expect("tcp");
    let mut numbers = Numbers::new(5);
    for _ in 0..200 {
        let wanted = place(&robot, "panda_hand_tcp", &drawn(&robot, &mut numbers));
        let axis = Unit::new_normalize(Vector3::new(0.3, -0.2, 1.0));
        let direction = Unit::new_normalize(wanted.rotation * axis.as_ref());
        let target = Target::Axis {
            position_m: wanted.translation.vector,
            axis_in_frame: axis,
            direction_in_world: direction,
        };
        let answer = inverse_kinematics(
            &robot,
            frame,
            target,
            &drawn(&robot, &mut numbers),
            &IkSettings::default(),
        )
        .expect("an answer");
        assert!(answer.reached, "{answer:?}");
        let got = place(&robot, "panda_hand_tcp", &answer.q);
        assert!((got.translation.vector - wanted.translation.vector).norm() <= 1e-5);
        let pointed = got.rotation * axis.as_ref();
        assert!(pointed.cross(&direction).norm() <= 1e-5 && pointed.dot(&direction) > 0.0);
        // and an orientation alone
        let target = Target::Rotation(*wanted.rotation.matrix());
        let answer = inverse_kinematics(
            &robot,
            frame,
            target,
            &drawn(&robot, &mut numbers),
            &IkSettings::default(),
        )
        .expect("an answer");
        assert!(answer.reached && answer.residual_m == 0.0);
        assert!(apart(&place(&robot, "panda_hand_tcp", &answer.q), &wanted).1 <= 1e-5);
    }
}

#[test]
fn answers_stay_near_the_start_by_whole_turns() {
    let robot = model("ur5");
    let frame = robot.frame("tool0").expect("tool");
    let q = [0.3, -1.0, 1.2, 0.5, 1.1, -0.4];
    let wanted = Target::Pose(place(&robot, "tool0", &q));
    let mut q0 = q.map(|q| q + 0.05);
    // the first joint one turn on, which its limits of two turns allow
    q0[0] += 2.0 * PI - 0.5;
    let answer =
        inverse_kinematics(&robot, frame, wanted, &q0, &IkSettings::default()).expect("an answer");
    assert!(answer.reached);
    let ranges = position_ranges(&robot);
    for ((q, q0), range) in answer.q.iter().zip(&q0).zip(&ranges) {
        let other = q - 2.0 * PI * (q - q0).signum();
        assert!(
            (q - q0).abs() <= PI || !range.contains(other),
            "{:?}",
            answer.q
        );
    }
}

#[test]
fn limits_bind_where_they_are_respected() {
    let robot = model("panda");
    let frame = robot.frame("panda_hand_tcp").expect("tcp");
    // the elbow bends in one direction only: 0.5 rad in the other is 0.57 beyond its limit
    let beyond = [0.2, 0.3, -0.4, 0.5, 0.5, 1.9, 0.1, 0.0, 0.0];
    let wanted = place(&robot, "panda_hand_tcp", &beyond);
    let mut q0 = beyond;
    q0[0] += 0.3;
    let ranges = position_ranges(&robot);
    let inside = |q: &[f64]| q.iter().zip(&ranges).all(|(q, range)| range.contains(*q));
    for method in [
        Method::Auto,
        Method::PseudoInverse,
        Method::DampedLeastSquares { damping: None },
        Method::Fallback { damping: Some(0.1) },
    ] {
        for respect_limits in [true, false] {
            let settings = IkSettings {
                method,
                respect_limits,
                ..IkSettings::default()
            };
            let target = Target::Pose(wanted);
            let answer =
                inverse_kinematics(&robot, frame, target, &q0, &settings).expect("an answer");
            if respect_limits {
                assert!(inside(&answer.q), "{method:?} {answer:?}");
            } else {
                assert!(answer.reached, "{method:?} {answer:?}");
            }
        }
    }
}

#[test]
fn a_posture_is_kept_while_the_tip_stays() {
    let robot = model("panda");
    let frame = robot.frame("panda_hand_tcp").expect("tcp");
    let q = [0.2, 0.3, -0.4, -1.6, 0.5, 1.9, 0.1, 0.0, 0.0];
    let wanted = Target::Pose(place(&robot, "panda_hand_tcp", &q));
    let off = |a: &[f64], b: &[f64]| {
        a.iter()
            .zip(b)
            .take(7)
            .map(|(a, b)| (a - b) * (a - b))
            .sum::<f64>()
            .sqrt()
    };
    // a posture the pose allows is found exactly, from another one on the same self-motion
    let q0 = [0.6, 0.1, -0.9, -1.7, 0.2, 1.6, 0.6, 0.0, 0.0];
    let without =
        inverse_kinematics(&robot, frame, wanted, &q0, &IkSettings::default()).expect("an answer");
    let settings = IkSettings {
        posture: Some(Posture {
            q: q.to_vec(),
            gain: 1.0,
        }),
        ..IkSettings::default()
    };
    let with = inverse_kinematics(&robot, frame, wanted, &q0, &settings).expect("an answer");
    assert!(without.reached && with.reached);
    assert!(off(&without.q, &q) > 0.05, "{}", off(&without.q, &q));
    assert!(off(&with.q, &q) < 1e-4, "{} {:?}", off(&with.q, &q), with);
    // the iteration of the textbook, step by step in the null space
    for method in [
        Method::PseudoInverse,
        Method::DampedLeastSquares {
            damping: Some(0.05),
        },
    ] {
        let settings = IkSettings {
            method,
            posture: Some(Posture {
                q: q.to_vec(),
                gain: 0.3,
            }),
            ..IkSettings::default()
        };
        let answer = inverse_kinematics(&robot, frame, wanted, &q0, &settings).expect("an answer");
        assert!(
            answer.reached && off(&answer.q, &q) < 1e-3,
            "{} {answer:?}",
            off(&answer.q, &q)
        );
    }
}

#[test]
fn the_fallback_takes_over_where_the_pseudo_inverse_leaves() {
    let file = golden("F_humanoid25.json");
    let rows = file["ik"].as_array().expect("rows");
    let row = rows.iter().find(|row| row["target"] == "out_of_reach");
    let row = row.expect("the row");
    let mut question = Question::of(row);
    let q0 = numbers(&row["q0_chain"]);
    let settings = question.settings.clone();
    let solve = |question: &Question, method: Method| {
        let settings = IkSettings {
            method,
            ..settings.clone()
        };
        question.answer(&q0, &settings)
    };
    let damping = Some(0.1);
    let damped = solve(&question, Method::DampedLeastSquares { damping });
    let fallback = solve(&question, Method::Fallback { damping });
    assert_eq!(
        (fallback.q, fallback.iterations),
        (damped.q, 60 + damped.iterations)
    );
    // if the first start converges there is no second
    let start = place(&question.robot, &question.tip, &question.whole(&q0));
    let near = start.translation.vector + Vector3::new(0.01, 0.0, 0.01);
    question.target = Target::Position(near);
    let first = solve(&question, Method::PseudoInverse);
    assert!(first.reached);
    assert_eq!(first, solve(&question, Method::Fallback { damping }));
}

#[test]
fn two_tips_that_share_a_joint_are_solved_together_in_turn_and_by_priority() {
    let robot = model("humanoid25");
    let mut numbers = Numbers::new(8);
    let goal = |frame: &str, p: Vector3<f64>| Goal {
        frame: robot.frame(frame).expect("frame"),
        target: Target::Position(p),
        weight: 1.0,
    };
    let mut by_turn = 0;
    for _ in 0..50 {
        let q = drawn(&robot, &mut numbers);
        let [left, right] =
            ["left_gear", "right_gear"].map(|f| goal(f, place(&robot, f, &q).translation.vector));
        let q0 = vec![0.05; robot.n()];
        let settings = IkSettings::default();
        let together = IkSolver::new(&robot, &[left, right], settings.clone())
            .expect("a question")
            .solve(&q0)
            .expect("an answer");
        assert!(together.reached, "{together:?}");
        for goal in [left, right] {
            let Target::Position(wanted) = goal.target else {
                unreachable!("asked for above")
            };
            assert!(
                (place(&robot, &goal.frame.name, &together.q)
                    .translation
                    .vector
                    - wanted)
                    .norm()
                    <= 1e-5
            );
        }
        // the right arm turns the chest away from the left hand, unless the second group keeps to the arm
        let chest = robot
            .moving_joints()
            .position(|joint| joint.name == "chest_z")
            .expect("the joint");
        let arm: Vec<usize> = Chain::new(&robot, right.frame)
            .joints()
            .iter()
            .copied()
            .filter(|&j| j != chest)
            .collect();
        let groups = [
            Group {
                goals: vec![left],
                settings: settings.clone(),
            },
            Group {
                goals: vec![right],
                settings: IkSettings {
                    chain: Some(arm),
                    ..settings.clone()
                },
            },
        ];
        let in_turn = solve_in_turn(&robot, &groups, &q0).expect("an answer");
        assert!(in_turn.groups[0].reached);
        by_turn += usize::from(in_turn.reached);
        let by_priority = solve_by_priority(&robot, &[vec![left], vec![right]], &settings, &q0)
            .expect("an answer");
        assert!(by_priority.groups[0].reached, "{by_priority:?}");
        assert!(by_priority.groups[1].residual_m <= in_turn.groups[1].residual_m + 0.1);
    }
    assert!(by_turn > 10, "{by_turn}");
}

/// A four-bar on a lift: crank 0.2 m, coupler 0.5 m, rocker 0.4 m, ground 0.5 m, so that the crank goes all the way round.
fn four_bar() -> Robot {
    robot(
        r#"
        format = 1
        name = "four-bar"
        links = [{ name = "ground" }, { name = "frame" }, { name = "crank" }, { name = "coupler" }, { name = "rocker" }]
        [[joints]]
        name = "lift"
        type = "prismatic"
        parent = "ground"
        child = "frame"
        axis = [0, 0, 1]
        limit = { lower = 0.0, upper = 1.0 }
        [[joints]]
        name = "drive"
        type = "continuous"
        parent = "frame"
        child = "crank"
        axis = [0, 0, 1]
        guess = 1.0
        [[joints]]
        name = "knee"
        type = "revolute"
        parent = "crank"
        child = "coupler"
        origin = { xyz_m = [0.2, 0, 0] }
        axis = [0, 0, 1]
        passive = true
        guess = -0.5
        [[joints]]
        name = "pivot"
        type = "revolute"
        parent = "frame"
        child = "rocker"
        origin = { xyz_m = [0.5, 0, 0] }
        axis = [0, 0, 1]
        passive = true
        guess = 1.5
        [[frames]]
        name = "tcp"
        link = "coupler"
        origin = { xyz_m = [0.25, 0.1, 0] }
        [[loops]]
        type = "revolute"
        links = ["coupler", "rocker"]
        frame_on_first = { xyz_m = [0.5, 0, 0] }
        frame_on_second = { xyz_m = [0.4, 0, 0] }
        "#,
    )
}

#[test]
fn a_robot_with_loops_stays_closed() {
    let robot = four_bar();
    let tcp = robot.tcp();
    assert_eq!(robot.independent(), [0, 1]);
    for (lift, drive) in [(0.2, 1.4), (0.9, -2.0), (0.5, 3.0), (0.0, 0.2)] {
        let q = closed_positions(&robot, &[lift, drive]).expect("closed");
        let wanted = Chain::new(&robot, tcp).update(&q);
        for method in [
            Method::Auto,
            Method::DampedLeastSquares { damping: None },
            Method::DampedLeastSquares {
                damping: Some(0.05),
            },
        ] {
            for target in [
                Target::Position(wanted.translation.vector),
                Target::Pose(wanted),
            ] {
                let settings = IkSettings {
                    method,
                    ..IkSettings::default()
                };
                let answer = inverse_kinematics(&robot, tcp, target, robot.home(), &settings)
                    .expect("an answer");
                assert!(
                    loop_gap_m(&robot, &answer.q) <= 1e-9,
                    "{method:?}: {}",
                    loop_gap_m(&robot, &answer.q)
                );
                if method == Method::Auto {
                    assert!(answer.reached, "{lift} {drive}: {answer:?}");
                }
            }
        }
        // unreachable, but the loops are closed all the same
        let beyond = Target::Position(wanted.translation.vector + Vector3::new(2.0, 0.0, 0.0));
        let answer = inverse_kinematics(
            &robot,
            tcp,
            beyond,
            &q,
            &IkSettings {
                restarts: 3,
                ..IkSettings::default()
            },
        )
        .expect("an answer");
        assert!(!answer.reached && loop_gap_m(&robot, &answer.q) <= 1e-9);
    }
    // a start that is open is closed first
    let q0 = [0.3, 0.8, 0.0, 0.0];
    let here = Target::Position(
        Chain::new(&robot, tcp)
            .update(&closed_positions(&robot, &[0.3, 0.8]).expect("closed"))
            .translation
            .vector,
    );
    let answer =
        inverse_kinematics(&robot, tcp, here, &q0, &IkSettings::default()).expect("an answer");
    assert!(answer.reached && answer.iterations <= 2, "{answer:?}");
}

#[test]
fn a_mimic_joint_moves_with_its_master_and_keeps_its_own_limits() {
    let robot = robot(
        r#"
        format = 1
        name = "finger"
        links = [{ name = "palm" }, { name = "near" }, { name = "far" }]
        [[joints]]
        name = "bend"
        type = "revolute"
        parent = "palm"
        child = "near"
        axis = [0, 1, 0]
        limit = { lower = -2.0, upper = 2.0 }
        [[joints]]
        name = "follow"
        type = "revolute"
        parent = "near"
        child = "far"
        origin = { xyz_m = [0.1, 0, 0] }
        axis = [0, 1, 0]
        mimic = { joint = "bend", multiplier = 2.0, offset = 0.1 }
        limit = { lower = -1.0, upper = 1.1 }
        [[frames]]
        name = "tcp"
        link = "far"
        origin = { xyz_m = [0.1, 0, 0] }
        "#,
    );
    let ranges = position_ranges(&robot);
    // 2 q + 0.1 from -1 to 1.1
    assert!((ranges[0].lower + 0.55).abs() < 1e-15 && (ranges[0].upper - 0.5).abs() < 1e-15);
    let tcp = robot.tcp();
    let at = |q: f64| Target::Position(Chain::new(&robot, tcp).update(&[q]).translation.vector);
    let answer = inverse_kinematics(&robot, tcp, at(0.4), &[-0.3], &IkSettings::default())
        .expect("an answer");
    assert!(
        answer.reached && (answer.q[0] - 0.4).abs() < 1e-5,
        "{answer:?}"
    );
    let answer = inverse_kinematics(&robot, tcp, at(0.8), &[-0.3], &IkSettings::default())
        .expect("an answer");
    assert!(
        !answer.reached && (answer.q[0] - 0.5).abs() < 1e-12,
        "{answer:?}"
    );
}

#[test]
fn questions_without_sense_are_errors_and_odd_ones_are_answered() {
    let robot = model("ur5");
    let frame = robot.frame("tool0").expect("tool");
    let q0 = [0.0; 6];
    let target = Target::Position(Vector3::new(0.4, 0.2, 0.3));
    let ask =
        |target, q0: &[f64], settings| inverse_kinematics(&robot, frame, target, q0, &settings);
    let default = IkSettings::default;
    assert!(matches!(
        ask(target, &[0.0; 5], default()),
        Err(IkError::JointCount {
            expected: 6,
            found: 5,
            ..
        })
    ));
    assert!(matches!(
        ask(target, &[f64::NAN; 6], default()),
        Err(IkError::Value { .. })
    ));
    let nowhere = Target::Position(Vector3::new(f64::INFINITY, 0.0, 0.0));
    assert!(matches!(
        ask(nowhere, &q0, default()),
        Err(IkError::Value { .. })
    ));
    assert!(matches!(
        ask(
            target,
            &q0,
            IkSettings {
                chain: Some(vec![6]),
                ..default()
            }
        ),
        Err(IkError::NoSuchJoint { index: 6, count: 6 })
    ));
    assert!(matches!(
        ask(
            target,
            &q0,
            IkSettings {
                max_iterations: usize::MAX,
                ..default()
            }
        ),
        Err(IkError::Budget { .. })
    ));
    assert!(matches!(
        ask(
            target,
            &q0,
            IkSettings {
                tolerance_m: f64::NAN,
                ..default()
            }
        ),
        Err(IkError::Value { .. })
    ));
    let negative = Method::DampedLeastSquares {
        damping: Some(-0.1),
    };
    assert!(matches!(
        ask(
            target,
            &q0,
            IkSettings {
                method: negative,
                ..default()
            }
        ),
        Err(IkError::Value { .. })
    ));
    assert!(matches!(
        IkSolver::new(&robot, &[], default()),
        Err(IkError::NoGoal)
    ));
    // no step at all, no joint that may move, a frame that does not move, damping of zero at the straight arm
    let still = ask(
        target,
        &q0,
        IkSettings {
            max_iterations: 0,
            ..default()
        },
    )
    .expect("an answer");
    assert_eq!((still.iterations, still.reached), (0, false));
    let held = ask(
        target,
        &q0,
        IkSettings {
            chain: Some(vec![]),
            ..default()
        },
    )
    .expect("an answer");
    assert_eq!((held.q, held.reached), (q0.to_vec(), false));
    let base = robot.frame("base_link").expect("base");
    let fixed = inverse_kinematics(
        &robot,
        base,
        Target::Pose(Pose::identity()),
        &q0,
        &default(),
    )
    .expect("an answer");
    assert!(fixed.reached);
    let undamped = Method::DampedLeastSquares { damping: Some(0.0) };
    let straight = ask(
        target,
        &q0,
        IkSettings {
            method: undamped,
            ..default()
        },
    )
    .expect("an answer");
    assert!(straight.q.iter().all(|q| q.is_finite()));
    // half a turn away, where the way round is not unique
    let half = pose(
        rotation_exp(&Vector3::new(0.0, 0.0, PI)) * place(&robot, "tool0", &q0).rotation.matrix(),
        Vector3::new(0.3, 0.3, 0.4),
    );
    assert!(
        ask(Target::Pose(half), &q0, default())
            .expect("an answer")
            .reached
    );
}

#[test]
fn the_same_question_has_the_same_answer_bit_for_bit() {
    let robot = model("panda");
    let frame = robot.frame("panda_hand_tcp").expect("tcp");
    let mut numbers = Numbers::new(12);
    let goal = pose_goal(&robot, "panda_hand_tcp", Pose::identity());
    let mut kept = IkSolver::new(&robot, &[goal], IkSettings::default()).expect("a question");
    for _ in 0..100 {
        let target = Target::Pose(place(
            &robot,
            "panda_hand_tcp",
            &drawn(&robot, &mut numbers),
        ));
        let q0 = drawn(&robot, &mut numbers);
        let fresh = inverse_kinematics(&robot, frame, target, &q0, &IkSettings::default())
            .expect("an answer");
        kept.set_target(0, target).expect("a pose");
        assert_eq!(kept.solve(&q0).expect("an answer"), fresh);
    }
}
