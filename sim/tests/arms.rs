//! Robots that the tests share: the course's arm, and trees drawn from a seed.

use kinemark_sim::format::{ReadFile, ReadOptions, RobotError, RobotFile, detect};
use kinemark_sim::model::robot::Robot;
use kinemark_sim::random::SplitMix64;
use kinemark_sim::text::Source;

/// Reads the robot of a description in any format.
pub(crate) fn read_robot(
    source: Source,
    options: &ReadOptions,
    read: &mut ReadFile<'_>,
) -> Result<Robot, RobotError> {
    (detect(&source).read)(source, options, read)
}

/// Reads a robot from text.
pub(crate) fn robot(text: &str) -> Robot {
    let file = RobotFile::parse(Source::new("robot.toml", text)).expect("readable");
    file.build(&[]).expect("a robot")
}

/// A robot of the labs.
pub(crate) fn lab_robot(name: &str) -> Robot {
    let path = format!("{}/../labs/robots/{name}.toml", env!("CARGO_MANIFEST_DIR"));
    robot(&std::fs::read_to_string(&path).expect(&path))
}

/// The arm of the course.
pub(crate) fn rrbot() -> Robot {
    lab_robot("rrbot")
}

/// The arm of the course without limits of position, speed and effort, for what limits would hide.
pub(crate) fn rrbot_without_limits() -> Robot {
    let path = format!("{}/../labs/robots/rrbot.toml", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(&path).expect(&path);
    let lines = text.lines().filter(|line| !line.starts_with("limit"));
    robot(&lines.collect::<Vec<_>>().join("\n"))
}

/// Numbers drawn from a seed, in the ranges that tests ask for.
pub(crate) struct Numbers(SplitMix64);

impl Numbers {
    pub(crate) fn new(seed: u64) -> Self {
        Self(SplitMix64::new(seed))
    }

    /// The next number in `[low, high)`.
    pub(crate) fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.0.uniform()
    }

    pub(crate) fn vector(&mut self, n: usize, size: f64) -> Vec<f64> {
        (0..n).map(|_| self.between(-size, size)).collect()
    }
}

/// A tree of `joints` joints of all kinds with skew axes, turned inertias, damping and armature.
pub(crate) fn random_tree(seed: u64, joints: usize) -> Robot {
    let mut r = Numbers::new(seed);
    let mut text = String::from("format = 1\nname = \"tree\"\n[[links]]\nname = \"l0\"\n");
    let triple = |v: Vec<f64>| format!("[{}, {}, {}]", v[0], v[1], v[2]);
    for j in 1..=joints {
        let com = triple(r.vector(3, 0.2));
        // diag(a, b, c) with a < b + c and so on, then a little off-diagonal
        let (a, b, c) = (
            r.between(0.02, 0.03),
            r.between(0.02, 0.03),
            r.between(0.02, 0.03),
        );
        let off = r.vector(3, 0.002);
        text += &format!(
            "[[links]]\nname = \"l{j}\"\ninertia = {{ mass_kg = {}, com_m = {com}, tensor_kg_m2 = [{a}, {b}, {c}, {}, {}, {}] }}\n",
            r.between(0.3, 2.0),
            off[0],
            off[1],
            off[2]
        );
    }
    for j in 1..=joints {
        let parent = r.between(0.0, j as f64) as usize;
        let kind = ["revolute", "prismatic", "continuous", "fixed"][if j == 1 {
            0
        } else {
            r.between(0.0, 4.0) as usize
        }];
        let (xyz, rpy, axis) = (
            triple(r.vector(3, 0.5)),
            triple(r.vector(3, 180.0)),
            triple(r.vector(3, 1.0)),
        );
        text += &format!(
            "[[joints]]\nname = \"j{j}\"\ntype = \"{kind}\"\nparent = \"l{parent}\"\nchild = \"l{j}\"\norigin = {{ xyz_m = {xyz}, rpy_deg = {rpy} }}\n"
        );
        if kind != "fixed" {
            text += &format!(
                "axis = {axis}\ndamping = {}\narmature = {}\n",
                r.between(0.0, 0.5),
                r.between(0.0, 0.1)
            );
        }
    }
    robot(&text)
}
