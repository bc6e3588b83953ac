//! The operations: one line each, and how a line of JSON becomes an answer.

use kinemark_sim::model::robot::{Frame, Robot};
use kinemark_sim::model::scene::Scene;
use kinemark_sim::text::suggest;
use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::{Map, Value, json};

use super::dynamics::{aba, bias, coriolis, crba, energy, gravity, inverse_dynamics, rnea};
use super::field_reader;
use super::inverse_kinematics::ik;
use super::kinematics::{com, fk, jacobian, jacobian_derivative, manipulability, workspace};
use super::refusal::{Code, Refusal, refuse};
use super::robot_info::info;
use super::simulation::simulate;
use super::trajectory::trajectory;

/// What requests are about.
#[derive(Debug, Clone, Copy)]
pub struct Subject<'a> {
    /// The robot.
    pub robot: &'a Robot,
    /// What is around it in a simulation.
    pub scene: Option<&'a Scene>,
}

type Fields = Map<String, Value>;
type AnswerFn = fn(Subject<'_>, Fields) -> Result<Fields, Refusal>;

/// One thing that can be requested.
#[derive(Debug, Clone, Copy)]
pub struct Operation {
    /// What `op` says.
    pub name: &'static str,
    answer: AnswerFn,
}

const fn operation(name: &'static str, answer: AnswerFn) -> Operation {
    Operation { name, answer }
}

/// All operations, in the order in which the documentation has them.
#[rustfmt::skip]
pub const OPERATIONS: [Operation; 18] = [
    operation("info", |on, fields| answer(fields, |request| Ok(info(on.robot, request)))),
    operation("fk", |on, fields| answer(fields, |request| fk(on.robot, request))),
    operation("jacobian", |on, fields| answer(fields, |request| jacobian(on.robot, request))),
    operation("jacobian_derivative", |on, fields| answer(fields, |request| jacobian_derivative(on.robot, request))),
    operation("manipulability", |on, fields| answer(fields, |request| manipulability(on.robot, request))),
    operation("workspace", |on, fields| answer(fields, |request| workspace(on.robot, request))),
    operation("ik", |on, fields| answer(fields, |request| ik(on.robot, request))),
    operation("com", |on, fields| answer(fields, |request| com(on.robot, request))),
    operation("rnea", |on, fields| answer(fields, |request| rnea(on.robot, request))),
    operation("bias", |on, fields| answer(fields, |request| bias(on.robot, request))),
    operation("gravity", |on, fields| answer(fields, |request| gravity(on.robot, request))),
    operation("coriolis", |on, fields| answer(fields, |request| coriolis(on.robot, request))),
    operation("inverse_dynamics", |on, fields| answer(fields, |request| inverse_dynamics(on.robot, request))),
    operation("crba", |on, fields| answer(fields, |request| crba(on.robot, request))),
    operation("aba", |on, fields| answer(fields, |request| aba(on.robot, request))),
    operation("energy", |on, fields| answer(fields, |request| energy(on.robot, request))),
    operation("trajectory", |_, fields| answer(fields, trajectory)),
    operation("simulate", |on, fields| answer(fields, |request| simulate(on, request))),
];

/// Reads the request, and writes what it is answered with.
fn answer<Q: DeserializeOwned, A: Serialize>(
    fields: Fields,
    answered: impl FnOnce(&Q) -> Result<A, Refusal>,
) -> Result<Fields, Refusal> {
    match serde_json::to_value(answered(&field_reader::request(fields)?)?) {
        Ok(Value::Object(answer)) => Ok(answer),
        other => refuse(
            Code::Fault,
            format!("the answer is no object, please report this: {other:?}"),
        ),
    }
}

/// The names of all operations with commas between.
pub fn operation_names() -> String {
    OPERATIONS.map(|operation| operation.name).join(", ")
}

/// Answers a line of JSON; the answer has the request's `id`, and `error` where there is a refusal.
pub fn answer_line(subject: Subject<'_>, line: &[u8]) -> Map<String, Value> {
    let request: Value = match serde_json::from_slice(line.trim_ascii_end()) {
        Ok(request) => request,
        Err(error) => return refused(Refusal::new(Code::BadJson, no_json(&error, line))),
    };
    let Value::Object(mut request) = request else {
        let message = "a request is an object, such as {\"op\": \"info\"}";
        return refused(Refusal::new(Code::BadRequest, message));
    };
    let id = request.remove("id");
    let mut whole = answer_request(subject, request).unwrap_or_else(refused);
    whole.insert("id".to_owned(), id.unwrap_or(Value::Null));
    whole
}

/// Why a line is no JSON: the column alone, for the line is always the first of its request.
fn no_json(error: &serde_json::Error, line: &[u8]) -> String {
    let rest = &line[error.column().saturating_sub(1).min(line.len())..];
    if rest.starts_with(b"NaN") {
        return "JSON has no NaN: leave the field out".to_owned();
    }
    let whole = error.to_string();
    let place = format!(" at line {} column {}", error.line(), error.column());
    let why = whole.strip_suffix(place.as_str()).unwrap_or(&whole);
    format!("column {}: {why}", error.column())
}

/// The answer to a line of which not even the `id` is known.
pub fn refused(refusal: Refusal) -> Map<String, Value> {
    Map::from_iter([
        ("error".to_owned(), json!(refusal)),
        ("id".to_owned(), Value::Null),
    ])
}

fn answer_request(subject: Subject<'_>, mut request: Fields) -> Result<Fields, Refusal> {
    let op = match request.remove("op") {
        Some(Value::String(op)) => op,
        Some(_) => return refuse(Code::WrongType, "`op` must be a string"),
        None => return refuse(Code::MissingField, "`op` is missing"),
    };
    let Some(found) = OPERATIONS.iter().find(|known| known.name == op) else {
        let known = suggest(&op, "operations", OPERATIONS.iter().map(|known| known.name));
        return refuse(Code::UnknownOp, format!("no operation `{op}`; {known}"));
    };
    (found.answer)(subject, request)
}

/// A frame or a link of the robot.
fn frame<'r>(robot: &'r Robot, name: &str) -> Result<&'r Frame, Refusal> {
    robot.frame(name).ok_or_else(|| {
        let known = robot.frames().iter().map(|frame| frame.name.as_str());
        let known = suggest(name, "frames", known);
        Refusal::new(
            Code::UnknownFrame,
            format!("no frame is called `{name}`; {known}"),
        )
    })
}

/// The frame a request is about; the TCP where it names none.
pub(super) fn frame_or_tcp<'r>(robot: &'r Robot, name: Option<&str>) -> Result<&'r Frame, Refusal> {
    name.map_or_else(|| Ok(robot.tcp()), |name| frame(robot, name))
}

/// The frame that coordinates are expressed in; `None` for the world.
pub(super) fn frame_or_world<'r>(
    robot: &'r Robot,
    name: Option<&str>,
) -> Result<Option<&'r Frame>, Refusal> {
    let name = name.filter(|name| *name != "world");
    name.map(|name| frame(robot, name)).transpose()
}
