//! The operations: one line each, and how a line of JSON becomes an answer.

use kinemark_sim::model::robot::{Frame, Robot};
use kinemark_sim::model::scene::Scene;
use kinemark_sim::text::suggest;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};

use super::dynamics::{Aba, Bias, Coriolis, Crba, Energy, Gravity, InverseDynamics, Rnea};
use super::field_reader::{Fields, FromFields};
use super::inverse_kinematics::Ik;
use super::kinematics::{Com, Fk, Jacobian, JacobianDerivative, Manipulability, Workspace};
use super::refusal::{Code, Refusal};
use super::robot_info::Info;
use super::simulation::Simulate;
use super::trajectory::PlanTrajectory;

/// What requests are about.
#[derive(Debug, Clone, Copy)]
pub struct Subject<'a> {
    /// The robot.
    pub robot: &'a Robot,
    /// What is around it in a simulation.
    pub scene: Option<&'a Scene>,
}

/// One thing that can be requested: its fields are those of the type.
pub trait Operation: FromFields {
    /// What `op` says.
    const NAME: &'static str;
    /// The fields of the answer.
    type Answer: Serialize;

    /// Answers the request.
    ///
    /// # Errors
    /// What cannot be asked of this robot, or has no answer.
    fn answer(self, subject: Subject<'_>) -> Result<Self::Answer, Refusal>;
}

type AnswerFn = fn(Subject<'_>, Fields) -> Result<Map<String, Value>, Refusal>;

/// An operation by its name.
#[derive(Debug, Clone, Copy)]
pub struct NamedOperation {
    /// What `op` says.
    pub name: &'static str,
    answer: AnswerFn,
}

const fn operation<O: Operation>() -> NamedOperation {
    NamedOperation {
        name: O::NAME,
        answer: |subject, mut fields| {
            let request = O::from_fields(&mut fields)?;
            fields.finish()?;
            match serde_json::to_value(request.answer(subject)?) {
                Ok(Value::Object(answer)) => Ok(answer),
                other => Err(Refusal::new(
                    Code::Fault,
                    format!("the answer is no object, please report this: {other:?}"),
                )),
            }
        },
    }
}

/// All operations, in the order in which the documentation has them.
pub const OPERATIONS: [NamedOperation; 18] = [
    operation::<Info>(),
    operation::<Fk>(),
    operation::<Jacobian>(),
    operation::<JacobianDerivative>(),
    operation::<Manipulability>(),
    operation::<Workspace>(),
    operation::<Ik>(),
    operation::<Com>(),
    operation::<Rnea>(),
    operation::<Bias>(),
    operation::<Gravity>(),
    operation::<Coriolis>(),
    operation::<InverseDynamics>(),
    operation::<Crba>(),
    operation::<Aba>(),
    operation::<Energy>(),
    operation::<PlanTrajectory>(),
    operation::<Simulate>(),
];

/// The names of all operations with commas between.
pub fn operation_names() -> String {
    OPERATIONS.map(|operation| operation.name).join(", ")
}

/// Answers a line of JSON; the answer has the request's `id`, and `error` where there is a refusal.
pub fn answer_line(subject: Subject<'_>, line: &[u8]) -> Map<String, Value> {
    let request: Value = match serde_json::from_slice(line.trim_ascii_end()) {
        Ok(request) => request,
        Err(error) => return refused(Refusal::new(Code::BadJson, error.to_string())),
    };
    let Value::Object(mut request) = request else {
        let message = "a request is an object, such as {\"op\": \"info\"}";
        return refused(Refusal::new(Code::BadRequest, message));
    };
    let id = request.remove("id");
    let mut whole = answer(subject, request).unwrap_or_else(error_field);
    whole.insert("id".to_owned(), id.unwrap_or(Value::Null));
    whole
}

/// The answer to a line of which not even the `id` is known.
pub fn refused(refusal: Refusal) -> Map<String, Value> {
    let mut whole = error_field(refusal);
    whole.insert("id".to_owned(), Value::Null);
    whole
}

fn error_field(refusal: Refusal) -> Map<String, Value> {
    let error = serde_json::json!({ "code": refusal.code, "message": refusal.message });
    Map::from_iter([("error".to_owned(), error)])
}

fn answer(
    subject: Subject<'_>,
    mut request: Map<String, Value>,
) -> Result<Map<String, Value>, Refusal> {
    let op = match request.remove("op") {
        Some(Value::String(op)) => op,
        Some(_) => return Err(Refusal::new(Code::WrongType, "`op` must be a string")),
        None => return Err(Refusal::new(Code::MissingField, "`op` is missing")),
    };
    let Some(found) = OPERATIONS.iter().find(|known| known.name == op) else {
        let known = suggest(&op, "operations", OPERATIONS.iter().map(|known| known.name));
        let message = format!("no operation `{op}`; {known}");
        return Err(Refusal::new(Code::UnknownOp, message));
    };
    (found.answer)(subject, Fields::of_request(request))
}

/// The name of a frame of the robot, or of a link; `world` where coordinates may be in the world.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct FrameName(pub String);

impl FrameName {
    pub(crate) fn of<'r>(&self, robot: &'r Robot) -> Result<&'r Frame, Refusal> {
        robot.frame(&self.0).ok_or_else(|| {
            let known = robot.frames().iter().map(|frame| frame.name.as_str());
            let known = suggest(&self.0, "frames", known);
            let message = format!("no frame is called `{}`; {known}", self.0);
            Refusal::new(Code::UnknownFrame, message)
        })
    }
}

/// The frame a request is about; the TCP where it names none.
pub(crate) fn frame_or_tcp<'r>(
    robot: &'r Robot,
    name: Option<&FrameName>,
) -> Result<&'r Frame, Refusal> {
    name.map_or_else(|| Ok(robot.tcp()), |name| name.of(robot))
}

/// The frame that coordinates are expressed in; `None` for the world.
pub(crate) fn frame_or_world<'r>(
    robot: &'r Robot,
    name: Option<&FrameName>,
) -> Result<Option<&'r Frame>, Refusal> {
    let name = name.filter(|name| name.0 != "world");
    name.map(|name| name.of(robot)).transpose()
}
