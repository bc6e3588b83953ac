//! The interface between the grader and a student's code: calls go in, answers come out, and a stop says why there is no answer.
//!
//! One trait, whatever the submission is made of, with two transports: this process, and a worker process. Both carry these types and
//! give the same bits.

use kinemark_sim::format::ReadOptions;
use serde::{Deserialize, Serialize};

use super::handed_in::Program;
use crate::record::grade::FurtherMistake;
pub use crate::task::grant::Grant;
pub use crate::task::value::Value;

/// Runs one submission for one task.
pub trait Controller {
    /// Calls one of the submission's functions.
    ///
    /// # Errors
    /// [`Stop`] if there is no answer. After [`Stop::Crashed`] and [`Stop::OverBudget`] it can be called again.
    fn call(&mut self, call: &Call) -> Result<Answer, Stop>;

    /// The output of the last call before it was stopped, which no answer carries: students look there for the reason.
    fn unanswered(&mut self) -> Said;
}

/// The output of a call besides its value.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Said {
    /// Lines it printed.
    pub log: Vec<PrintedLine>,
    /// Values it plotted, by name, in order.
    pub plots: Vec<(String, f64)>,
}

/// A submission that ended before it answered: why, and what it said until then.
#[derive(Debug, Clone, PartialEq)]
pub struct Failed {
    /// Why it ended.
    pub stop: Stop,
    /// What it said.
    pub said: Said,
}

impl From<Stop> for Box<Failed> {
    fn from(stop: Stop) -> Self {
        let said = Said::default();
        Self::new(Failed { stop, said })
    }
}

#[cfg(test)]
impl Said {
    /// The texts of the printed lines.
    pub(crate) fn texts(&self) -> Vec<&str> {
        self.log.iter().map(|line| line.text.as_str()).collect()
    }
}

/// A line that a submission printed, or that the host says among them.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct PrintedLine {
    /// The text.
    pub text: String,
    /// The line of the script whose call printed it; none in a module, and of what the host says.
    pub line: Option<usize>,
}

/// The opening of a controller, once per task.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Opening {
    /// File name of the submission, for messages.
    pub file: String,
    /// The submission's code.
    pub program: Program,
    /// Name of the task.
    pub task: String,
    /// The robot of the task.
    pub robot: RobotFacts,
    /// The value of `observation.target`.
    pub target: Value,
    /// The sensors, in the order of their readings.
    pub sensors: Vec<SensorFacts>,
    /// The budgets of the code.
    pub budgets: Budgets,
    /// The functions of the robot's model that the task grants, if any.
    pub granted: Option<Granted>,
    /// The function that is called, if it is not one that every submission can have.
    pub function: Option<AskedFunction>,
}

/// A function that the tasks of one lab ask for.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct AskedFunction {
    /// Its name.
    pub name: String,
    /// Names of its parameters.
    pub parameters: Vec<String>,
}

/// The granted functions, and the files of the robot's model; its dimensions are those of [`RobotFacts`].
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Granted {
    /// The functions.
    pub functions: Vec<Grant>,
    /// Path of the robot file, for messages.
    pub robot_path: String,
    /// The robot file's text.
    pub robot_text: String,
    /// How it is read, where it is a URDF.
    pub read_options: ReadOptions,
    /// Bytes of its meshes, by their names in the robot file.
    pub meshes: Vec<(String, Vec<u8>)>,
    /// The lab's frame.
    pub frame: String,
    /// Gravity in the world \[m/s²\].
    pub gravity_m_s2: [f64; 3],
}

/// The facts about the robot for a submission: the map `robot`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RobotFacts {
    /// The robot's name.
    pub name: String,
    /// Names of the joints that move, in the order of `q`.
    pub joint_names: Vec<String>,
    /// The dimensions of the robot file: numbers and lists of numbers.
    pub dimensions: Vec<(String, Value)>,
    /// Lower position limits, shape `(n)`; minus infinity without a limit \[rad or m\].
    pub lower: Vec<f64>,
    /// Upper position limits, shape `(n)`; infinity without a limit \[rad or m\].
    pub upper: Vec<f64>,
    /// Effort limits of the task's servo, shape `(n)`; infinity without a limit \[N m or N\].
    pub effort: Vec<f64>,
}

/// A call of one of the submission's functions.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub enum Call {
    /// `forward_kinematics(robot, q)`.
    ForwardKinematics {
        /// The robot of the case.
        robot: RobotFacts,
        /// Joint positions \[rad or m\].
        q: Vec<f64>,
    },
    /// `inverse_kinematics(robot, position)`.
    InverseKinematics {
        /// The robot of the case.
        robot: RobotFacts,
        /// Position of the TCP in the lab's frame \[m\].
        position_m: [f64; 3],
    },
    /// `jacobian(robot, q)`.
    Jacobian {
        /// The robot of the case.
        robot: RobotFacts,
        /// Joint positions \[rad or m\].
        q: Vec<f64>,
    },
    /// A function of the robot that is not one of those above, of poses or of a quantity: `velocity(robot, q, qd)` and others.
    OfRobot {
        /// The function's name.
        function: String,
        /// The robot of the case.
        robot: RobotFacts,
        /// Its other arguments, by the names of the parameters.
        given: Vec<(String, Value)>,
    },
    /// A function of the lab's own: `function(given)`, or `function(robot, given)`.
    Free {
        /// The function's name.
        function: String,
        /// The robot of the case, where the task gives it.
        robot: Option<RobotFacts>,
        /// Its input: numbers, lists and matrices.
        given: Vec<(String, Value)>,
    },
    /// `init(robot, task)`, once before the first `Control`; without an `init`, a submission returns nothing.
    Init,
    /// `control(observation)`.
    Control(Observation),
}

impl Call {
    /// The name of the function in scripts.
    pub fn name(&self) -> &str {
        match self {
            Self::ForwardKinematics { .. } => "forward_kinematics",
            Self::InverseKinematics { .. } => "inverse_kinematics",
            Self::Jacobian { .. } => "jacobian",
            Self::OfRobot { function, .. } | Self::Free { function, .. } => function,
            Self::Init => "init",
            Self::Control(_) => "control",
        }
    }

    /// The robot of its case; `None` in a motion task, whose robot is that of the [`Opening`].
    pub fn robot(&self) -> Option<&RobotFacts> {
        match self {
            Self::ForwardKinematics { robot, .. }
            | Self::InverseKinematics { robot, .. }
            | Self::Jacobian { robot, .. }
            | Self::OfRobot { robot, .. } => Some(robot),
            Self::Free { robot, .. } => robot.as_ref(),
            Self::Init | Self::Control(_) => None,
        }
    }
}

/// The argument of `control`, without task and target, which are in the [`Opening`].
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Observation {
    /// The tick.
    pub tick: u64,
    /// Its time \[s\].
    pub time_s: f64,
    /// The control period \[s\].
    pub dt_s: f64,
    /// Joint positions \[rad or m\].
    pub q: Vec<f64>,
    /// Joint velocities \[rad/s or m/s\].
    pub qd: Vec<f64>,
    /// Joint efforts of the tick before \[N m or N\].
    pub effort: Vec<f64>,
    /// Position of the TCP in the lab's frame \[m\].
    pub tcp_m: [f64; 3],
    /// Rotation matrix of the TCP in the lab's frame, row by row: its columns are the axes of the TCP.
    pub tcp_rotation: [[f64; 3]; 3],
    /// All numbers of the sensor readings, in order.
    pub sensors: Vec<f64>,
}

/// The keys of `observation` that differ from call to call, besides `sensors`; `task` and `target` are the same in all of them.
pub(crate) const MEASURED: [&str; 8] = [
    "tick",
    "time",
    "dt",
    "q",
    "qd",
    "effort",
    "tcp",
    "tcp_rotation",
];

/// The facts about a sensor for a submission.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct SensorFacts {
    /// Its name in `observation.sensors`.
    pub name: String,
    /// The type of its readings.
    pub reads: Reads,
}

/// The type of a sensor's readings.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Reads {
    /// A boolean, transported as one number that is zero for false.
    Truth,
    /// A number.
    Number,
    /// A vector with this many numbers.
    Vector(usize),
}

/// The result of a call.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Answer {
    /// The return value of the function.
    pub value: Value,
    /// Its output.
    pub said: Said,
    /// Operations it used; instructions of a compiled module.
    pub operations: u64,
}

/// The functions of a submission that tasks call, and the names of their parameters.
pub(super) const ENTRY_POINTS: &[(&str, &[&str])] = &[
    ("forward_kinematics", &["robot", "q"]),
    ("inverse_kinematics", &["robot", "position"]),
    ("jacobian", &["robot", "q"]),
    ("init", &["robot", "task"]),
    ("control", &["observation"]),
];

/// The parameters of one of [`ENTRY_POINTS`]; empty for others.
pub(super) fn entry_parameters(name: &str) -> &'static [&'static str] {
    let mut entries = ENTRY_POINTS.iter();
    let entry = entries.find(|(entry, _)| *entry == name);
    entry.map_or(&[], |(_, parameters)| parameters)
}

/// A position in the submission; line and column count from one, the column in characters.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct SourcePosition {
    /// The line.
    pub line: usize,
    /// The column.
    pub column: usize,
}

/// An error in a submission.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Mistake {
    /// The message: a lowercase fragment with names and values.
    pub message: String,
    /// The position, if the host knows it.
    pub place: Option<SourcePosition>,
    /// What to do about it.
    pub help: Option<String>,
    /// What else is wrong in the file, as far as that is known, in the order of its lines.
    pub further: Vec<FurtherMistake>,
}

/// A function of the right name with another number of parameters.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct Namesake {
    /// Its number of parameters.
    pub parameters: usize,
    /// The number it is called with.
    pub wanted: usize,
    /// Its position, if the host knows it.
    pub place: Option<SourcePosition>,
}

/// The reason why a call has no answer.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub enum Stop {
    /// The submission does not compile.
    DidNotBuild(Mistake),
    /// It has no such function; `help` gives the nearest name, or the right parameters.
    Missing {
        /// The function's name and parameters: `control(observation)`.
        function: String,
        /// What to do about it.
        help: Option<String>,
        /// A function of this name with other parameters.
        namesake: Option<Namesake>,
    },
    /// It failed while running.
    Crashed(Mistake),
    /// It used up a budget.
    OverBudget {
        /// The budget.
        budget: Budget,
        /// The limit of the budget.
        limit: u64,
        /// The position where it ran out, if the host knows it.
        place: Option<SourcePosition>,
        /// The function of a compiled module in which it ran out, if the host knows it.
        function: Option<String>,
    },
    /// This machine's clock or memory ended it; it says nothing about the work.
    HostLimit(HostLimit),
    /// The grader failed; the student is not at fault.
    GraderFault(String),
    /// The user interrupted it.
    Interrupted,
}

/// A budget of a submission; all budgets are counted, none is timed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Budget {
    /// Operations of one call.
    OperationsPerCall,
    /// Operations of a whole task.
    OperationsPerTask,
    /// Nested calls of functions.
    CallDepth,
    /// Expressions inside expressions.
    ExpressionDepth,
    /// Elements of one list.
    ListSize,
    /// Characters of one string.
    TextSize,
    /// Entries of one map.
    MapSize,
    /// Bytes of a script.
    SourceBytes,
    /// Instructions of one call of a compiled module.
    InstructionsPerCall,
    /// Instructions of a compiled module in a whole task.
    InstructionsPerTask,
    /// Bytes of a compiled module.
    ModuleBytes,
    /// Instructions for reading a file in Python and running the statements outside of functions.
    InstructionsToRead,
}

impl Budget {
    /// The counted quantity in words: `operations in one call`.
    pub fn name(self) -> &'static str {
        match self {
            Self::OperationsPerCall => "operations in one call",
            Self::OperationsPerTask => "operations in one task",
            Self::CallDepth => "nested function calls",
            Self::ExpressionDepth => "expressions inside each other",
            Self::ListSize => "elements in one list, or in all of `this`",
            Self::TextSize => "characters in one string",
            Self::MapSize => "entries in one map",
            Self::SourceBytes => "bytes of source",
            Self::InstructionsPerCall => "instructions in one call",
            Self::InstructionsPerTask => "instructions in one task",
            Self::ModuleBytes => "bytes of module",
            Self::InstructionsToRead => "instructions for reading the file",
        }
    }
}

/// A limit of the machine, not of the submission.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum HostLimit {
    /// The wall clock or CPU time of the worker.
    Time,
    /// The memory of the worker.
    Memory,
}

/// The value of every budget.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Budgets {
    /// Operations of one call.
    pub operations_per_call: u64,
    /// Operations of a whole task.
    pub operations_per_task: u64,
    /// Functions calling functions.
    pub call_depth: u64,
    /// Expressions inside expressions.
    pub expression_depth: u64,
    /// Elements of one list.
    pub list_size: u64,
    /// Characters of one text.
    pub text_size: u64,
    /// Entries of one map.
    pub map_size: u64,
    /// Lines printed in a task that are kept.
    pub log_lines: u64,
    /// Values plotted in a task that are kept.
    pub plot_samples: u64,
    /// Bytes of a script.
    pub source_bytes: u64,
    /// Instructions of one call of a compiled module.
    pub instructions_per_call: u64,
    /// Instructions of a compiled module in a whole task.
    pub instructions_per_task: u64,
    /// Bytes of a compiled module.
    pub module_bytes: u64,
}

/// Instructions of the runtime that Python may use for an operation of a script: what a line of both does then costs about the same share.
const PYTHON_INSTRUCTIONS_PER_OPERATION: u64 = 2_000;

impl Budgets {
    /// Instructions of one call of a submission in Python.
    pub fn python_instructions_per_call(&self) -> u64 {
        self.operations_per_call
            .saturating_mul(PYTHON_INSTRUCTIONS_PER_OPERATION)
    }

    /// Instructions for reading a file in Python, which a call does not have to pay for.
    pub fn python_instructions_to_read(&self) -> u64 {
        // a file as large as it may be takes 1,400 million if it has nothing but small functions
        self.python_instructions_per_call().saturating_mul(100)
    }

    /// Instructions of a submission in Python in a whole task, without those for reading it.
    pub fn python_instructions_per_task(&self) -> u64 {
        self.operations_per_task
            .saturating_mul(PYTHON_INSTRUCTIONS_PER_OPERATION)
    }
}

impl Default for Budgets {
    fn default() -> Self {
        Self {
            operations_per_call: 25_000,
            operations_per_task: 5_000_000,
            call_depth: 32,
            expression_depth: 64,
            list_size: 1_000,
            text_size: 4_000,
            map_size: 256,
            log_lines: 1_000,
            plot_samples: 50_000,
            source_bytes: 65_536,
            instructions_per_call: 1_000_000,
            instructions_per_task: 200_000_000,
            module_bytes: 262_144,
        }
    }
}
