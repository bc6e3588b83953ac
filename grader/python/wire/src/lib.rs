//! What the grader and the runtime of Python say to each other: requests go into the module's memory, replies come out of it, both as
//! `postcard`. The grader and the runtime are built from one checkout, so that there is no second version to understand.

use serde::{Deserialize, Serialize};

/// A value that crosses.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub enum Value {
    /// `None`.
    Nothing,
    /// `True` or `False`.
    Boolean(bool),
    /// An int or a float; to Python a float.
    Number(f64),
    /// An int, to Python.
    Integer(i64),
    /// A str.
    Text(String),
    /// A list or tuple.
    List(Vec<Value>),
    /// Numbers: a vector, or `rows` rows of a matrix.
    Numbers {
        /// Rows of a matrix; none for a vector.
        rows: Option<u32>,
        /// The numbers, row by row.
        values: Vec<f64>,
    },
    /// A dict with texts as keys, or an object with fields.
    Map(Vec<(String, Value)>),
    /// Something that cannot cross; its type's name.
    Other(String),
}

/// The facts about a robot: what `robot` holds.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Robot {
    /// Its fields, in order.
    pub fields: Vec<(String, Value)>,
    /// The functions that the task grants.
    pub granted: Vec<String>,
}

/// The type of a sensor's readings.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Reads {
    /// A truth value, as a number that is zero for false.
    Truth,
    /// A number.
    Number,
    /// So many numbers.
    Vector(u32),
}

/// A submission to load.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Load {
    /// Its file's name, for messages.
    pub file: String,
    /// Its text.
    pub source: String,
    /// The robot of the task.
    pub robot: Robot,
    /// The task's name.
    pub task: String,
    /// `observation.target`.
    pub target: Value,
    /// The sensors by name, in the order of their readings.
    pub sensors: Vec<(String, Reads)>,
    /// The most values that an answer may have.
    pub most_values: u32,
    /// The longest text that is printed, in bytes.
    pub text_size: u32,
}

/// A call of one of its functions.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub enum Call {
    /// `init(robot, task)`; a submission without it does nothing.
    Init,
    /// `control(observation)`: tick, time and period \[s\], then all numbers in order: q, qd, effort, tcp (3), rotation (9), sensors.
    Control {
        /// The tick.
        tick: u64,
        /// Its time \[s\].
        time_s: f64,
        /// The control period \[s\].
        dt_s: f64,
        /// The numbers.
        numbers: Vec<f64>,
    },
    /// A function of a case.
    Function {
        /// Its name.
        name: String,
        /// The robot of the case, where it is given one.
        robot: Option<Robot>,
        /// Its other arguments.
        arguments: Vec<Value>,
    },
}

/// A place in the submission; line and column count from one, the column in characters.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct Place {
    /// The line.
    pub line: u32,
    /// The column.
    pub column: u32,
}

/// A function of the submission.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Function {
    /// Its name.
    pub name: String,
    /// How many arguments it needs, and how many it takes at most; none without a bound.
    pub parameters: (u32, Option<u32>),
    /// Where it is defined.
    pub place: Option<Place>,
}

/// What a request ends with.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub enum Reply {
    /// It is loaded; the functions that it has.
    Loaded(Vec<Function>),
    /// The return value.
    Returned(Value),
    /// The return value has more values than an answer may have.
    TooMany,
    /// The submission has no such function.
    Missing,
    /// An exception ended it.
    Raised {
        /// Its type: `NameError`.
        kind: String,
        /// Its message.
        message: String,
        /// Where in the submission.
        place: Option<Place>,
        /// The name that was looked for, where it was one.
        name: Option<String>,
        /// Whether the file could not be compiled, so that nothing of it ran.
        is_of_compiler: bool,
    },
}

/// Where a submission was when it was stopped from outside.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Stopped {
    /// The place in the submission.
    pub place: Option<Place>,
    /// The function of the submission.
    pub function: Option<String>,
    /// What the runtime said when it stopped itself.
    pub panic: Option<String>,
}

/// A request or a reply as bytes.
///
/// # Errors
/// A value that `postcard` cannot write, which none of these is.
pub fn to_bytes<T: Serialize>(value: &T) -> Result<Vec<u8>, String> {
    postcard::to_stdvec(value).map_err(|error| error.to_string())
}

/// A request or a reply from bytes.
///
/// # Errors
/// Bytes that are not those of a `T`.
pub fn from_bytes<'b, T: Deserialize<'b>>(bytes: &'b [u8]) -> Result<T, String> {
    postcard::from_bytes(bytes).map_err(|error| error.to_string())
}
