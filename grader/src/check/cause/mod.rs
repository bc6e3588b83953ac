//! Causes: the one mistake that a whole run, or all answers together, show before a sentence is chosen. One file a cause.
//!
//! A cause says what is seen, from which moment on, and asks; it does not say what to write. It is named only where what is seen leaves
//! no other reading that is tried here. It knows the robot, the task and what the submission did, and no reference: so practice has the
//! causes of a graded run.

mod angle_slip;
mod angles_for_velocities;
mod answers_in_angles;
mod answers_in_axes;
mod clamped;
mod compensation;
mod degrees;
mod elbow_alone;
mod first_direction;
mod frozen_angles;
mod goal_angles;
mod goal_order;
mod idle;
mod integral_away;
mod late;
mod law;
mod left_out;
mod lets_go;
mod no_stop;
mod refused;
mod runs_away;
mod saturated;
mod setpoint;
mod stops_short;
mod tcp_command;
mod typed_size;
mod wrong_speed;
mod wrong_term;

pub(super) use self::law::Law;
pub(super) use self::setpoint::wrong_setpoint;
pub(super) use self::wrong_term::{creeping_law, gravity_term, speed_term};
use super::facts::MotionFacts;
use super::finding::Finding;
use crate::attempt::answers::CaseFacts;
use crate::record::grade::Evidence;
use crate::task::model::FunctionTask;

/// What is seen of a run.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Cause {
    /// It in words.
    words: String,
    /// The signal that shows it.
    signal: String,
    /// The earliest tick that shows it.
    tick: usize,
    /// What to ask oneself; none where the lab's own question is the better one.
    question: Option<String>,
}

/// A run that lost points.
struct Lost<'a> {
    facts: &'a MotionFacts<'a>,
    /// The first tick at which a check lost points, where that is known.
    first_lost: Option<usize>,
}

/// In the order in which they are looked for: what is wrong from the first call on, then what goes wrong on the way, then what is
/// missing in the end.
const OF_RUNS: [fn(&Lost<'_>) -> Option<Cause>; 18] = [
    idle::seen,
    angles_for_velocities::seen,
    degrees::seen,
    goal_order::seen,
    goal_angles::seen,
    left_out::seen,
    first_direction::seen,
    frozen_angles::seen,
    runs_away::seen,
    wrong_speed::seen,
    integral_away::seen,
    compensation::seen,
    no_stop::seen,
    stops_short::seen,
    lets_go::seen,
    late::seen,
    saturated::seen,
    clamped::seen,
];

/// The cause of a run that lost points, `first_lost` at the earliest.
pub(crate) fn of_run(facts: &MotionFacts<'_>, first_lost: Option<usize>) -> Option<Cause> {
    if facts.trace.len() < 2 || facts.robot.n() == 0 {
        return None;
    }
    let lost = Lost { facts, first_lost };
    OF_RUNS.iter().find_map(|seen| seen(&lost))
}

impl Cause {
    /// A finding that begins with this cause.
    pub(crate) fn explains(self, facts: &MotionFacts<'_>, finding: &mut Finding) {
        let evidence = Evidence {
            is_cause: true,
            ..facts.evidence(self.words, self.signal, self.tick)
        };
        finding.evidence.insert(0, evidence);
        if let Some(question) = self.question {
            finding.next_step = question;
            finding.insists = true;
        }
    }
}

/// What all answers of a function task show together.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct CauseOfAnswers {
    /// It in words.
    words: String,
    /// What to ask oneself.
    question: String,
}

/// The answers to the visible cases, as causes see them.
struct Answers<'a> {
    /// The frame in which positions are.
    frame: &'a str,
    /// Those of visible cases that are wrong, at least [`LEAST_WRONG`].
    wrong: Vec<&'a CaseFacts<'a>>,
    /// The others of visible cases.
    right: Vec<&'a CaseFacts<'a>>,
}

/// Fewer wrong answers may agree with a mistake by chance.
const LEAST_WRONG: usize = 2;

const OF_ANSWERS: [fn(&Answers<'_>) -> Option<CauseOfAnswers>; 5] = [
    refused::seen,
    typed_size::seen,
    answers_in_axes::seen,
    answers_in_angles::seen,
    elbow_alone::seen,
];

/// The cause of wrong answers; `is_right` says which are right.
pub(crate) fn of_answers(
    frame: &str,
    facts: &[CaseFacts<'_>],
    is_right: impl Fn(&CaseFacts<'_>) -> bool,
) -> Option<CauseOfAnswers> {
    let visible = facts.iter().filter(|facts| facts.is_visible());
    let (right, wrong): (Vec<_>, Vec<_>) = visible.partition(|facts| is_right(facts));
    if wrong.len() < LEAST_WRONG {
        return None;
    }
    let answers = Answers {
        frame,
        wrong,
        right,
    };
    OF_ANSWERS.iter().find_map(|seen| seen(&answers))
}

impl CauseOfAnswers {
    /// A finding about answers to `task` that begins with this cause.
    pub(crate) fn explains(self, task: &FunctionTask, finding: &mut Finding) {
        let evidence = Evidence {
            message: self.words,
            signal: task.name().to_owned(),
            is_cause: true,
            ..Evidence::default()
        };
        finding.evidence.insert(0, evidence);
        finding.next_step = self.question;
        finding.insists = true;
    }
}
