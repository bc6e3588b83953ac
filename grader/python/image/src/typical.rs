//! What most submissions do: programs as students write them, and the calls that the grader makes of them. What they use of the runtime is
//! what a start should have at hand.

use kinemark_python_wire::{Call, Load, Reads, Robot, Value};

/// The programs, each with how many of its calls end with an exception, as they are to.
const PROGRAMS: [(&str, usize); 10] = [
    (include_str!("typical/scalars.py"), 0),
    (include_str!("typical/arrays.py"), 0),
    (include_str!("typical/objects.py"), 3),
    (include_str!("typical/operations.py"), 1),
    (include_str!("typical/names_of_numpy.py"), 1),
    (include_str!("typical/names_of_python.py"), 0),
    (include_str!("typical/syntax.py"), 0),
    // without `init`
    (include_str!("typical/trajectories.py"), 0),
    (include_str!("typical/damped.py"), 1),
    (include_str!("typical/waypoints.py"), 1),
];
/// Files that are not loaded: one that cannot be read, and two whose statements fail.
const NOT_LOADED: [&str; 3] = [
    "def control(observation)\n    return [0, 0]\n",
    "import numpy\n\nstart = nothing\n",
    "from scipy import optimize\n",
];
/// Calls of `control`.
const TICKS: u64 = 40;

/// A program, and its calls in order.
pub(crate) struct Typical {
    pub(crate) load: Load,
    /// Whether it can be loaded.
    pub(crate) is_loaded: bool,
    pub(crate) calls: Vec<Call>,
    /// How many of them end with an exception.
    pub(crate) raised: usize,
}

/// All of them.
pub(crate) fn all() -> impl Iterator<Item = Typical> {
    let loaded = PROGRAMS.into_iter().map(|(source, raised)| Typical {
        load: load(source),
        is_loaded: true,
        calls: calls(),
        raised,
    });
    loaded.chain(NOT_LOADED.into_iter().map(|source| Typical {
        load: load(source),
        is_loaded: false,
        calls: Vec::new(),
        raised: 0,
    }))
}

fn load(source: &str) -> Load {
    Load {
        file: "submission.py".to_owned(),
        source: source.to_owned(),
        robot: robot(),
        task: "move".to_owned(),
        target: Value::Map(vec![
            ("p".to_owned(), vector(&[2.0, 1.4, 0.0])),
            ("speed".to_owned(), Value::Number(0.2)),
        ]),
        sensors: vec![
            ("touch".to_owned(), Reads::Truth),
            ("distance".to_owned(), Reads::Number),
            ("force".to_owned(), Reads::Vector(3)),
        ],
        most_values: 10_000,
        text_size: 4_000,
    }
}

fn vector(values: &[f64]) -> Value {
    Value::Numbers {
        rows: None,
        values: values.to_vec(),
    }
}

fn robot() -> Robot {
    let fields = [
        ("name", Value::Text("rrbot".to_owned())),
        ("joints", Value::Integer(2)),
        (
            "joint_names",
            Value::List(
                ["shoulder", "elbow"]
                    .map(|name| Value::Text(name.to_owned()))
                    .to_vec(),
            ),
        ),
        ("lower", vector(&[-6.3; 2])),
        ("upper", vector(&[6.3; 2])),
        ("effort", vector(&[30.0, 15.0])),
        ("base_height", Value::Number(2.0)),
        ("link_lengths", vector(&[1.0, 0.9])),
        ("link_offset", Value::Number(0.1)),
    ];
    let granted = ["fk", "jacobian", "gravity", "mass_matrix"];
    Robot {
        fields: fields
            .map(|(name, value)| (name.to_owned(), value))
            .to_vec(),
        granted: granted.map(str::to_owned).to_vec(),
    }
}

fn calls() -> Vec<Call> {
    let function = |name: &str, argument: &[f64]| Call::Function {
        name: name.to_owned(),
        robot: Some(robot()),
        arguments: vec![vector(argument)],
    };
    let mut calls = vec![
        function("forward_kinematics", &[0.3, -0.4]),
        function("inverse_kinematics", &[2.5, 0.9, 0.2]),
        function("jacobian", &[0.3, -0.4]),
        Call::Init,
    ];
    calls.extend((0..TICKS).map(|tick| {
        Call::Control {
            tick,
            time_s: tick as f64 * 0.01,
            dt_s: 0.01,
            // q, qd, effort, tcp, its rotation, the sensors
            numbers: [
                &[0.3, -0.4, 0.01, 0.02, 1.5, -0.5, 2.5, 0.9, 0.2][..],
                &[1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0],
                &[0.0, 0.5, 1.0, 2.0, 3.0],
            ]
            .concat(),
        }
    }));
    calls
}
