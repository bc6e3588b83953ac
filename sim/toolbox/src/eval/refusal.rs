//! Why a request is not answered: a documented code, and a message for a person.

use kinemark_sim::model::unphysical::UnphysicalLinks;
use serde::{Deserialize, Serialize};

/// The code of a refusal; docs/robot-eval.md has the table.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Code {
    /// The line is not JSON.
    BadJson,
    /// The line is JSON, but not an object.
    BadRequest,
    /// A required field is left out.
    MissingField,
    /// No operation has this name.
    UnknownOp,
    /// The operation does not have this field, or not together with another one.
    UnknownField,
    /// The robot has no frame of this name.
    UnknownFrame,
    /// The robot has no moving joint of this name.
    UnknownJoint,
    /// A string where a number belongs, and the like.
    WrongType,
    /// Too many or too few numbers.
    WrongLength,
    /// A value that the field cannot have.
    OutOfRange,
    /// A time that is not a whole number of the shorter one.
    BadPeriod,
    /// A line, a run or an answer beyond a limit.
    TooLarge,
    /// No trajectory meets what is asked for.
    CannotPlan,
    /// The loops of the robot do not close.
    OpenLoop,
    /// The configuration is singular for this operation.
    Singular,
    /// Nothing has mass.
    NoMass,
    /// No body can have the mass properties of a link.
    Unphysical,
    /// The simulation cannot start.
    CannotRun,
    /// The simulation diverged.
    Diverged,
    /// The answer is not finite.
    NotFinite,
    /// A fault of this program.
    Fault,
}

/// Why a request is not answered.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Refusal {
    /// For programs.
    pub code: Code,
    /// For people: names the field, its value and what was expected.
    pub message: String,
}

impl Refusal {
    pub(crate) fn new(code: Code, message: impl ToString) -> Self {
        let message = message.to_string();
        Self { code, message }
    }
}

impl From<&UnphysicalLinks> for Refusal {
    fn from(links: &UnphysicalLinks) -> Self {
        Self::new(Code::Unphysical, links)
    }
}

/// A refusal in place of an answer.
pub(crate) fn refuse<T>(code: Code, message: impl ToString) -> Result<T, Refusal> {
    Err(Refusal::new(code, message))
}
