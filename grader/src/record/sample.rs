//! A graded run to try the renderers on: a real simulation with a grade made by hand.

use kinemark_sim::control::{Derivative, Gains, Mode, ServoSettings};
use kinemark_sim::format::RobotFile;
use kinemark_sim::model::robot::Robot;
use kinemark_sim::run::{Observation, Setup, run};
use kinemark_sim::text::Source;
use kinemark_sim::ticks::Periods;
use kinemark_sim::trace::{LogLine, PlotSignal, Trace, TraceRecorder};
use kinemark_sim::watch::event::{Event, EventKind};
use nalgebra::Vector3;

use crate::record::grade::{
    CaseGrade, CheckGrade, Diagnosis, Digests, Evidence, FORMAT, Grade, GradeMode, HiddenClass,
    Instant, LogEntry, Measure, Outcome, Part, SecondDigests, Stopped, TaskGrade, TaskKind,
};
use crate::record::graded::{Curve, Goal, GradedRun, TaskRun, TcpPath};
use crate::record::shown_case::{AnsweredPlace, ShownCase, ShownCases, ShownPlaces};
use crate::record::verdict::Verdict;

/// The arm of the course.
pub fn arm() -> Robot {
    let source = Source::new(
        "rrbot.toml",
        include_str!("../../../labs/robots/rrbot.toml"),
    );
    RobotFile::parse(source)
        .and_then(|file| file.build(&[]))
        .expect("the course's robot file is right")
}

/// Joint positions that bring the TCP sideways to (2, `y`), elbow toward the ceiling.
fn reach(y: f64) -> [f64; 2] {
    let bend = libm::acos(y * y / 2.0 - 1.0);
    let side = y.signum();
    [
        side * (std::f64::consts::FRAC_PI_2 - bend / 2.0),
        side * bend,
    ]
}

fn smooth(s: f64) -> f64 {
    let s = s.clamp(0.0, 1.0);
    s * s * s * (10.0 + s * (6.0 * s - 15.0))
}

/// A trace of `ticks` milliseconds; `slow` stretches the motion.
fn trace(robot: &Robot, ticks: u64, slow: f64) -> Trace {
    let gains = [30.0, 15.0].map(|effort_limit| Gains {
        kp: 100.0,
        ki: 0.0,
        kd: 10.0,
        effort_limit,
        integral_limit: f64::INFINITY,
    });
    let setup = Setup {
        robot,
        scene: None,
        tcp: robot.tcp(),
        seen_from: robot
            .frame("lab")
            .expect("the arm has the frame of its lab"),
        periods: Periods::new(0.001, 0.001, 0.01).expect("whole periods"),
        gravity_m_s2: Vector3::new(0.0, 0.0, -9.81),
        servo: ServoSettings {
            mode: Mode::Position,
            derivative: Derivative::Velocity,
            gains: gains.to_vec(),
            gravity_compensation: true,
        },
        sensors: Vec::new(),
        start_q: vec![0.0; 2],
        start_qd: vec![0.0; 2],
        laws: None,
        pushes: Vec::new(),
        ticks,
    };
    let (a, b) = (reach(1.4), reach(-1.4));
    let mut recorder = TraceRecorder::new(&setup);
    let control = |o: &Observation<'_>, command: &mut [f64]| -> Result<(), ()> {
        let s = smooth(o.time_s / (1.6 * slow));
        let u = if o.time_s < 3.2 * slow { 0.0 } else { 1.0 };
        for i in 0..2 {
            command[i] = s * a[i] + u * (b[i] - a[i]);
        }
        Ok(())
    };
    run(&setup, control, &mut recorder).expect("the servo fits the arm");
    recorder.finish()
}

/// A motion task on the course's arm with two goals.
pub fn task_run() -> TaskRun {
    task_run_of(8)
}

/// The same motion task, of so many seconds, six at least.
pub fn task_run_of(seconds: u32) -> TaskRun {
    let ticks = 1000 * seconds;
    let robot = arm();
    let mut trace_of_run = trace(&robot, ticks.into(), 1.0);
    let reference = trace(&robot, ticks.into(), 1.1);
    let points_m = (0..=ticks as usize / 10).map(|i| {
        let p = reference.tcp_position(i * 10);
        [p.x, p.y, p.z]
    });
    let reference_tcp = Some(TcpPath {
        period_s: 0.01,
        points_m: points_m.collect(),
    });
    let goals = [(1.4, Some((1900, 2400))), (-1.4, Some((5200, 5700)))];
    let goals = goals.map(|(y, stay)| Goal {
        position_m: [2.0, y, 0.05],
        dwell_s: 0.5,
        full_m: 0.002,
        zero_m: 0.02,
        stay,
    });
    let samples = (0..u64::from(ticks) / 10).map(|i| (i * 10, libm::sin(i as f64 * 0.02) * 0.3));
    trace_of_run.plots = vec![
        PlotSignal {
            name: "elbow error".to_owned(),
            samples: samples.collect(),
        },
        PlotSignal {
            name: "<script>alert(1)</script>\u{202E}\u{1b}[31m & a name that is far too long to be shown in full".to_owned(),
            samples: vec![(0, 1.0), (2000, f64::NAN), (4000, 3.0), (4010, f64::INFINITY), (6000, -1e5)],
        },
    ];
    trace_of_run.log = [
        "going to goal 1",
        "<b>reached</b> goal 1",
        "going to goal 2 \u{1b}[31m\u{202E}",
    ]
    .iter()
    .zip([0u64, 2400, 3200])
    .map(|(text, tick)| LogLine {
        tick,
        text: (*text).to_owned(),
        line: Some(2),
    })
    .collect();
    let off_line = (0..=ticks as usize).map(|tick| {
        let p = trace_of_run.tcp_position(tick);
        let r = reference.tcp_position(tick);
        (p - r).norm()
    });
    let values: Vec<f64> = off_line.collect();
    let curves = vec![Curve {
        reference: None,
        check: "trajectory-match".to_owned(),
        title: "distance to the reference path".to_owned(),
        unit: "m".to_owned(),
        t_s: (0..=ticks).map(|tick| f64::from(tick) / 1000.0).collect(),
        values,
        full: Some(0.05),
        zero: Some(0.25),
        marks: vec![
            (0.62, "first outside".to_owned()),
            (0.78, "worst before the goal".to_owned()),
            (3.71, "worst".to_owned()),
        ],
        step: None,
    }];
    TaskRun {
        task: "move".to_owned(),
        robot,
        scene: None,
        sensors: Vec::new(),
        seen_from: "lab".to_owned(),
        mode: Mode::Position,
        effort_limits: vec![30.0, 15.0],
        trace: trace_of_run,
        goals: goals.to_vec(),
        reference_tcp,
        paths: Vec::new(),
        curves,
        check_titles: Default::default(),
        divergence: None,
        reference_overlay: None,
    }
}

/// The same run, ended by the controller after `ticks` ticks.
pub fn stopped_after(ticks: u64) -> TaskRun {
    let mut run = task_run();
    let mut short = trace(&run.robot, ticks, 1.0);
    short.events.push(Event {
        tick: ticks + 1,
        kind: EventKind::Stopped,
    });
    run.trace = short;
    run.goals.iter_mut().for_each(|goal| goal.stay = None);
    run.curves.clear();
    run
}

/// Rows of `n` joints as a function of the tick gives them, on a chain of `n` links.
pub fn chain(n: usize, ticks: u64, row: impl Fn(u64, usize) -> f64) -> TaskRun {
    use kinemark_sim::run::{Recorder as _, Row};
    let mut text = "format = 1\nname = \"chain\"\n[[links]]\nname = \"l0\"\ninertia = { mass_kg = 1.0, com_m = [0.0, 0.0, 0.1], tensor_kg_m2 = [0.1, 0.1, 0.1, 0.0, 0.0, 0.0] }\n".to_owned();
    for i in 1..=n {
        let parent = i - 1;
        text.push_str(&format!(
            "[[links]]\nname = \"l{i}\"\ninertia = {{ mass_kg = 1.0, com_m = [0.0, 0.0, 0.1], tensor_kg_m2 = [0.1, 0.1, 0.1, 0.0, 0.0, 0.0] }}\n\
             [[joints]]\nname = \"joint-{i}\"\ntype = \"revolute\"\nparent = \"l{parent}\"\nchild = \"l{i}\"\n\
             origin = {{ xyz_m = [0.0, 0.0, 0.2] }}\naxis = [0.0, 1.0, 0.0]\n"
        ));
    }
    let robot = RobotFile::parse(Source::new("chain.toml", text))
        .and_then(|file| file.build(&[]))
        .expect("the chain is a robot");
    let gains = Gains {
        kp: 1.0,
        ki: 0.0,
        kd: 0.0,
        effort_limit: f64::INFINITY,
        integral_limit: f64::INFINITY,
    };
    let setup = Setup {
        robot: &robot,
        scene: None,
        tcp: robot.tcp(),
        seen_from: &robot.frames()[0],
        periods: Periods::new(0.001, 0.001, 0.01).expect("whole periods"),
        gravity_m_s2: Vector3::new(0.0, 0.0, -9.81),
        servo: ServoSettings {
            mode: Mode::Velocity,
            derivative: Derivative::Error,
            gains: vec![gains; n],
            gravity_compensation: false,
        },
        sensors: Vec::new(),
        start_q: vec![0.0; n],
        start_qd: vec![0.0; n],
        laws: None,
        pushes: Vec::new(),
        ticks,
    };
    let mut recorder = TraceRecorder::new(&setup);
    for tick in 0..ticks {
        let row: Vec<f64> = (0..n).map(|joint| row(tick, joint)).collect();
        recorder.row(Row {
            tick,
            q: &row,
            qd: &row,
            command: &row,
            effort: &row,
            sensors: &[],
            scene: None,
        });
    }
    let trace = recorder.finish();
    TaskRun {
        task: "wander".to_owned(),
        scene: None,
        sensors: Vec::new(),
        seen_from: "l0".to_owned(),
        mode: Mode::Velocity,
        effort_limits: vec![f64::INFINITY; n],
        trace,
        goals: Vec::new(),
        reference_tcp: None,
        paths: Vec::new(),
        curves: Vec::new(),
        check_titles: Default::default(),
        divergence: None,
        reference_overlay: None,
        robot,
    }
}

fn part(name: &str, seed: u8) -> Part {
    Part {
        name: name.to_owned(),
        digest: blake3::hash(&[seed]).to_hex().to_string(),
    }
}

fn measure(
    quantity: &str,
    value: Option<f64>,
    unit: &str,
    full: f64,
    zero: f64,
) -> Option<Measure> {
    Some(Measure {
        reference: None,
        prediction: None,
        quantity: quantity.to_owned(),
        value,
        unit: unit.to_owned(),
        full,
        zero,
    })
}

fn check(
    name: &str,
    title: &str,
    outcome: Outcome,
    points: (f64, f64),
    measure: Option<Measure>,
) -> CheckGrade {
    CheckGrade {
        name: name.to_owned(),
        title: title.to_owned(),
        outcome,
        points: points.0,
        max_points: points.1,
        measure,
        first_lost: None,
        evidence: Vec::new(),
        next_step: None,
        has_hints: false,
        look_first_at: None,
    }
}

fn task(
    name: &str,
    title: &str,
    kind: TaskKind,
    verdict: Verdict,
    checks: Vec<CheckGrade>,
) -> TaskGrade {
    TaskGrade {
        points_at_hand_in: 0.0,
        name: name.to_owned(),
        title: title.to_owned(),
        kind,
        verdict,
        points: checks.iter().map(|check| check.points).sum(),
        max_points: checks.iter().map(|check| check.max_points).sum(),
        stopped: None,
        checks,
        diagnoses: Vec::new(),
        cases: Vec::new(),
        hidden: Vec::new(),
        events: Vec::new(),
        contacts: Vec::new(),
        operations: 12_345,
        log: Vec::new(),
        digests: Digests {
            all: blake3::hash(name.as_bytes()).to_hex().to_string(),
            seconds: vec![
                SecondDigests {
                    q: String::new(),
                    qd: String::new(),
                    command: String::new(),
                    effort: String::new(),
                    tcp: String::new(),
                    bodies: None,
                    sensors: None,
                };
                8
            ],
            rungs: Vec::new(),
        },
        divergence: None,
        figures: None,
    }
}

fn instant(tick: u64) -> Option<Instant> {
    Some(Instant {
        tick,
        time_s: tick as f64 / 1000.0,
    })
}

fn evidence(
    message: &str,
    signal: &str,
    at: (Option<u64>, Option<&str>),
    numbers: (f64, f64, &str),
) -> Evidence {
    Evidence {
        message: message.to_owned(),
        signal: signal.to_owned(),
        tick: at.0,
        time_s: at.0.map(|tick| tick as f64 / 1000.0),
        case: at.1.map(str::to_owned),
        value: Some(numbers.0),
        limit: Some(numbers.1),
        unit: numbers.2.to_owned(),
        ..Evidence::default()
    }
}

fn fk() -> TaskGrade {
    let mut mean = check(
        "mean-error",
        "Mean position error",
        Outcome::Partial,
        (1.2, 3.0),
        measure("mean position error", Some(0.0031), "m", 1e-4, 5e-3),
    );
    mean.evidence.push(evidence(
        "case `bent`: the answer is 12.4 mm from the true position (1.5403, 0.8415, 0.0500)",
        "forward_kinematics",
        (None, Some("bent")),
        (0.0124, 1e-4, "m"),
    ));
    mean.next_step = Some("Draw the arm at q = (0, pi/2) and follow the second link: its angle to the x axis is q1 + q2.".to_owned());
    let mut fk = task(
        "fk",
        "Forward kinematics",
        TaskKind::Function,
        Verdict::Missed,
        vec![
            check(
                "straight",
                "Straight arm",
                Outcome::Full,
                (1.0, 1.0),
                measure("position error", Some(2.2e-16), "m", 1e-4, 5e-3),
            ),
            mean,
        ],
    );
    fk.diagnoses.push(Diagnosis {
        mistake: "absolute-elbow".to_owned(),
        says: "the elbow's angle is taken as absolute: q2 is relative to the upper arm, so the forearm points along q1 + q2".to_owned(),
        agreeing: 5,
        telling: 6,
    });
    let case = |name: &str,
                given: &str,
                answer: &str,
                expected: Option<&str>,
                error_m: Option<f64>,
                good| CaseGrade {
        name: name.to_owned(),
        given: given.to_owned(),
        answer: answer.to_owned(),
        expected: expected.map(str::to_owned),
        error_m,
        relative_error: None,
        good,
    };
    fk.cases = vec![
        case(
            "straight",
            "q = [0, 0]",
            "[4, 0, 0.05]",
            Some("[4, 0, 0.05]"),
            Some(0.0),
            true,
        ),
        case(
            "bent",
            "q = [0.5, 1.2]",
            "[3.24, 1.411485, 0.05]",
            Some("[2.748738, 1.471090, 0.05]"),
            Some(0.4948),
            false,
        ),
        case(
            "hostile",
            "q = [9, 9]",
            "<img src=x onerror=alert(1)>\u{202E}\u{1b}[2J",
            None,
            None,
            false,
        ),
    ];
    fk.hidden = vec![
        HiddenClass {
            class: "unequal links".to_owned(),
            good: 3,
            total: 12,
            under_resolved: 0,
        },
        HiddenClass {
            class: "equal links".to_owned(),
            good: 8,
            total: 8,
            under_resolved: 0,
        },
    ];
    fk.log = vec![LogEntry {
        at: 1,
        text: "case bent: q12 = 1.2".to_owned(),
        line: Some(3),
    }];
    fk
}

fn ik() -> TaskGrade {
    let mut ik = task(
        "ik",
        "Inverse kinematics",
        TaskKind::Function,
        Verdict::Crashed,
        vec![
            check(
                "error",
                "Position reached by the answer",
                Outcome::NotJudged,
                (0.0, 2.0),
                None,
            ),
            check(
                "branches",
                "Both elbow positions",
                Outcome::NotJudged,
                (0.0, 1.0),
                None,
            ),
        ],
    );
    ik.stopped = Some(Stopped {
        further: Vec::new(),
        kept: None,
        message: "function not found: `atan` with 2 arguments".to_owned(),
        help: Some("the angle of a point is `atan2(y, x)`".to_owned()),
        line: Some(14),
        column: Some(14),
        source_column: None,
        source_line: Some(
            "    let q1 = atan(p[1], p[0]) - atan2(s, c); // <script>alert('x')</script>"
                .to_owned(),
        ),
        tick: None,
        time_s: None,
        case: Some("reach-right".to_owned()),
    });
    ik
}

fn moving() -> TaskGrade {
    let mut matching = check(
        "trajectory-match",
        "Follows the reference path",
        Outcome::None,
        (0.0, 1.5),
        measure(
            "worst distance to the reference path",
            Some(1.87),
            "m",
            0.05,
            0.25,
        ),
    );
    matching.evidence = vec![
        evidence(
            "the TCP is 1.87 m from the reference path at 3.71 s; 0.25 m earns nothing",
            "tcp",
            (Some(3710), None),
            (1.87, 0.25, "m"),
        ),
        evidence(
            "the TCP first leaves the band of full points at 0.62 s",
            "tcp",
            (Some(620), None),
            (0.0501, 0.05, "m"),
        ),
    ];
    matching.first_lost = instant(620);
    matching.next_step = Some("Lead the arm over time instead of stepping the command: `quintic(t / 1.6)` blends from one pose to the next.".to_owned());
    let mut saturation = check(
        "saturation",
        "Effort within its limits",
        Outcome::Partial,
        (0.4, 0.5),
        measure("time at the effort limit", Some(0.183), "s", 0.1, 0.5),
    );
    saturation.evidence = vec![evidence(
        "joint `shoulder` is at its limit of 30 N m for 0.183 s from 3.2 s on",
        "effort[0]",
        (Some(3200), None),
        (0.183, 0.1, "s"),
    )];
    saturation.first_lost = instant(3200);
    let mut moving = task(
        "move",
        "Move to two places",
        TaskKind::Motion,
        Verdict::Missed,
        vec![
            check(
                "goals",
                "Goals reached and held",
                Outcome::Full,
                (2.0, 2.0),
                measure(
                    "worst distance during the stay",
                    Some(0.00013),
                    "m",
                    2e-3,
                    2e-2,
                ),
            ),
            check(
                "time",
                "Done in time",
                Outcome::Full,
                (1.0, 1.0),
                measure("time of the last stay", Some(5.7), "s", 6.0, 8.0),
            ),
            saturation,
            matching,
        ],
    );
    moving.log = vec![
        LogEntry {
            at: 0,
            text: "going to goal 1".to_owned(),
            line: Some(2),
        },
        LogEntry {
            at: 2400,
            text: "<b>reached</b> goal 1 \u{1b}[31mred\u{1b}[0m \u{202E}desrever".to_owned(),
            line: Some(2),
        },
    ];
    moving
}

/// The cases of the sample's forward kinematics, of which one answer is wrong.
fn fk_cases() -> ShownCases {
    let places = |arm_m: [[f64; 3]; 3], tcp_m: [f64; 3], is_right| ShownPlaces {
        upward: [1.0, 0.0, 0.0],
        right_m: arm_m[2],
        arm_m: arm_m.to_vec(),
        branches: None,
        answered: vec![AnsweredPlace {
            tcp_m,
            arm_m: Vec::new(),
            is_right,
        }],
    };
    let case = |name: &str, is_good, places| ShownCase {
        name: name.to_owned(),
        is_good,
        places: Some(places),
        numbers: Vec::new(),
    };
    let base = [0.0, 0.0, 0.05];
    let bent = [base, [1.755, 0.959, 0.05], [2.748_738, 1.471_090, 0.05]];
    let straight = [base, [2.0, 0.0, 0.05], [4.0, 0.0, 0.05]];
    ShownCases {
        task: "fk".to_owned(),
        seen_from: "lab".to_owned(),
        cases: vec![
            case("bent", false, places(bent, [3.24, 1.411_485, 0.05], false)),
            case("straight", true, places(straight, straight[2], true)),
        ],
    }
}

/// A graded run with every kind of outcome.
pub fn graded() -> GradedRun {
    let warm_up = task(
        "warm-up",
        "Warm-up",
        TaskKind::Motion,
        Verdict::Passed,
        vec![check(
            "turned",
            "One joint turned by half a radian",
            Outcome::Full,
            (1.0, 1.0),
            measure("angle turned", Some(0.499_8), "rad", 0.45, 0.1),
        )],
    );
    let tasks = vec![warm_up, fk(), ik(), moving()];
    GradedRun {
        grade: Grade {
            points_at_hand_in: 0.0,
            format: FORMAT.to_owned(),
            engine: "kinemark 0.1.0".to_owned(),
            mode: GradeMode::Practice,
            variant: None,
            lab: part("01-kinematics", 1),
            robot: part("rrbot", 2),
            scenes: Vec::new(),
            submission: part("submission.rhai", 3),
            sources: None,
            reference: None,
            verdict: Verdict::Crashed,
            points: tasks.iter().map(|task| task.points).sum(),
            max_points: tasks.iter().map(|task| task.max_points).sum(),
            tasks,
        },
        title: "Where is the hand?".to_owned(),
        staff_faults: Vec::new(),
        runs: vec![task_run()],
        cases: vec![fk_cases()],
    }
}
