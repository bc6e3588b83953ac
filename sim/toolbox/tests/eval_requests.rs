//! Typed requests, written and read again: what a caller in Rust sends is what the operation reads.

use std::fmt::Debug;

use kinemark_toolbox::eval::{
    Aba, AngleSet, ArcMotion, ArcPoints, Com, CountedLinks, Fields, Fk, FrameName, FromFields,
    GroupOrder, Ik, IkMethod, IkTarget, Jacobian, LawLimits, Manipulability, Motion, Numbers,
    Operation, PathEnd, PlanTrajectory, ServoDerivative, ServoMode, ServoTable, Simulate,
    SplineMotion, Subject, TimeLaw, TwistRows, Workspace,
};
use serde::Serialize;
use serde_json::Value;

use crate::rrbot;

fn written_and_read<T: Serialize + FromFields + PartialEq + Debug>(request: &T) {
    let Ok(Value::Object(object)) = serde_json::to_value(request) else {
        panic!("{request:?} is no object");
    };
    let mut fields = Fields::of_request(object);
    let read = T::from_fields(&mut fields).unwrap_or_else(|error| panic!("{error:?}"));
    assert_eq!(&read, request);
    assert_eq!(fields.finish(), Ok(()));
}

fn pose(x: f64) -> PathEnd {
    PathEnd {
        position_m: [x, 0.0, 0.0],
        rotation: None,
    }
}

#[test]
fn requests_read_back() {
    let q = || Numbers::List(vec![0.25, -1.5]);
    let tcp = || Some(FrameName("tcp".to_owned()));
    written_and_read(&Fk {
        q: q(),
        frame: tcp(),
        r#in: None,
    });
    written_and_read(&Jacobian {
        q: Numbers::One(0.5),
        frame: None,
        r#in: None,
        angles: Some(AngleSet::Zyz),
    });
    written_and_read(&Manipulability {
        q: q(),
        frame: None,
        r#in: None,
        rows: Some(TwistRows::Numbered(vec![0, 5])),
    });
    written_and_read(&Workspace {
        frame: None,
        samples: Some(7),
        from_m: Some([0.0, 1.0, 2.0]),
    });
    written_and_read(&Com {
        q: q(),
        r#in: None,
        counted: Some(CountedLinks::All),
    });
    written_and_read(&Aba {
        q: q(),
        qd: q(),
        effort: q(),
        gravity_m_s2: Some([0.0, 0.0, -1.62]),
    });
}

#[test]
fn groups_of_targets_read_back() {
    let target = |position_m, rotation| IkTarget {
        frame: None,
        weight: Some(0.5),
        position_m,
        rotation,
        axis: None,
        direction: None,
    };
    let turned = [[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]];
    written_and_read(&Ik {
        q0: Some(Numbers::List(vec![0.0, 1.0])),
        r#in: Some(FrameName("lab".to_owned())),
        frame: None,
        target: None,
        targets: Some(vec![
            target(Some([1.0, 2.0, 3.0]), None),
            target(None, Some(turned)),
        ]),
        order: Some(GroupOrder::InTurn),
        method: Some(IkMethod::DampedLeastSquares),
        damping: Some(0.1),
        max_iterations: Some(10),
        restarts: Some(0),
        tolerance_m: Some(1e-3),
        tolerance_rad: None,
        respect_limits: Some(false),
        chain: Some(vec!["elbow".to_owned()]),
        posture: None,
        posture_gain: None,
    });
}

#[test]
fn motions_read_back_by_their_kind() {
    written_and_read(&PlanTrajectory {
        at_s: Some(Numbers::One(0.5)),
        motion: Motion::Spline(SplineMotion {
            times_s: Numbers::List(vec![0.0, 1.0]),
            points: vec![vec![0.0], vec![1.0]],
            natural: Some(true),
        }),
    });
    written_and_read(&PlanTrajectory {
        at_s: None,
        motion: Motion::Arc(ArcMotion {
            points: ArcPoints {
                from: pose(0.0),
                via_m: [1.0, 1.0, 0.0],
                to: pose(2.0),
            },
            law: TimeLaw::Trapezoid(LawLimits {
                speed: Numbers::One(1.0),
                acceleration: Numbers::One(2.0),
            }),
        }),
    });
}

#[test]
fn a_run_is_answered_without_json() {
    let numbers = || Numbers::List(vec![0.0, 0.0]);
    let request = Simulate {
        q0: numbers(),
        qd0: numbers(),
        command: Some(numbers()),
        commands: None,
        command_period_s: None,
        duration_s: 0.1,
        servo_period_s: 0.001,
        physics_step_s: None,
        sample_period_s: 0.05,
        servo: ServoTable {
            mode: ServoMode::Position,
            derivative: Some(ServoDerivative::Velocity),
            kp: Some(Numbers::One(100.0)),
            ki: None,
            kd: Some(Numbers::One(10.0)),
            effort_limit: None,
            integral_limit: None,
            gravity_compensation: Some(true),
        },
        gravity_m_s2: None,
    };
    written_and_read(&request);
    let robot = rrbot();
    let subject = Subject {
        robot: &robot,
        scene: None,
    };
    let run = request
        .answer(subject)
        .unwrap_or_else(|refusal| panic!("{refusal:?}"));
    assert_eq!(run.t_s, [0.0, 0.05, 0.1]);
    // straight up without a command stays straight up
    assert_eq!(run.q, vec![vec![0.0, 0.0]; 3]);
    assert_eq!((run.sensors, run.scene), (None, None));
}
