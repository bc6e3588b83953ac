//! A grade explained to the course staff, with nothing withheld: every hidden case and run with its numbers. Never for students.

use kinemark_sim::text::Dimensions;
use serde::Serialize;

use crate::record::grade::{CaseGrade, Evidence, Measure, Stopped, TaskKind};
use crate::record::graded::GradedRun;
use crate::record::hints::Hints;
use crate::record::quantity::with_unit_unlike;

/// A hidden case or run with its numbers.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct HiddenDraw {
    /// The task.
    pub task: String,
    /// Whether it is a case of a function or a run.
    pub kind: TaskKind,
    /// Its class, which is all that students see of it.
    pub class: String,
    /// Its number within its class, from one.
    pub number: u32,
    /// What was drawn: the input of a case and the dimensions of its robot, or the parameters of a run.
    #[serde(serialize_with = "by_name")]
    pub numbers: Dimensions,
    /// The numbers in words, with fewer digits.
    pub words: String,
    /// The right answer to a case in words. For inverse kinematics it is that of the reference solution.
    pub expected: Option<String>,
}

impl HiddenDraw {
    /// Its class and number in words: `case 3 of the class "a longer forearm"`.
    pub fn name(&self) -> String {
        let what = match self.kind {
            TaskKind::Function => "case",
            TaskKind::Motion => "run",
        };
        format!("{what} {} of the class \"{}\"", self.number, self.class)
    }
}

/// A grade with everything that is hidden in it. It is for the course staff: it has hidden numbers and the reference solution's runs.
#[derive(Debug, Clone)]
pub struct Explanation {
    /// The grade, made again: equal to the record of it where engine, lab and submission are the same.
    pub graded: GradedRun,
    /// The tasks with hidden cases or runs, in the lab's order.
    pub tasks: Vec<ExplainedTask>,
    /// The hints of the lab.
    pub hints: Hints,
}

/// A task with hidden cases or runs.
#[derive(Debug, Clone)]
pub struct ExplainedTask {
    /// Its name.
    pub name: String,
    /// Its title.
    pub title: String,
    /// Its kind.
    pub kind: TaskKind,
    /// The share of points of each check before it is rounded, in `[0, 1]`: of a motion task in the visible run alone, of a function
    /// task over all cases.
    pub scores: Vec<f64>,
    /// Whether the hidden ones count in the grade. Hidden runs do not if the visible run did not reach its end.
    pub counts: bool,
    /// All cases of a function task as one attempt; each hidden run as one.
    pub attempts: Vec<ExplainedAttempt>,
}

/// An attempt at an exposed lab.
#[derive(Debug, Clone)]
pub struct ExplainedAttempt {
    /// The grade in that lab, with the reference solution's motion in its runs.
    pub graded: GradedRun,
    /// The hidden cases, or the one hidden run.
    pub draws: Vec<ExplainedDraw>,
}

/// A hidden case or run with what the submission made of it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ExplainedDraw {
    /// The case or run.
    pub draw: HiddenDraw,
    /// Whether it counts as good in its class.
    pub good: bool,
    /// Of a case: answer, expected answer and error.
    pub case: Option<CaseGrade>,
    /// Of a case of inverse kinematics: the distance of each answered branch from the target, in the order of the answer \[m\].
    pub branches_m: Vec<f64>,
    /// The stop of the submission in it.
    pub stopped: Option<Stopped>,
    /// Its checks, in the lab's order.
    pub checks: Vec<DrawCheck>,
}

/// A check in one hidden case or run.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct DrawCheck {
    /// Its name.
    pub name: String,
    /// Its title.
    pub title: String,
    /// What earns all points and what earns none, in words.
    pub bounds: [String; 2],
    /// The share of its points; `None` where it was not judged, or does not look at such a case.
    pub score: Option<f64>,
    /// The share that goes into the points: that of a run is rounded down to twentieths. The points of a function task are made from
    /// all its cases, so a case has no share of its own.
    pub counted: Option<f64>,
    /// What was measured, with its band.
    pub measure: Option<Measure>,
    /// The value of the reference solution in the same run.
    pub reference: Option<f64>,
    /// Why points were lost.
    pub evidence: Vec<Evidence>,
}

impl DrawCheck {
    /// Whether points were lost in it, or it was not judged in a run.
    pub fn is_lost(&self) -> bool {
        self.counted.or(self.score).is_some_and(|score| score < 1.0)
    }

    /// What was measured in words: of a run the value, of a case what is wrong with the answer.
    pub fn words(&self) -> String {
        let of_run = self.measure.as_ref().filter(|_| self.counted.is_some());
        if let Some(measure) = of_run {
            let value = measure.value.map_or_else(
                || "nothing to measure".to_owned(),
                |value| with_unit_unlike(value, measure.full, &measure.unit),
            );
            // of a sweep, the level that lost most
            let level = self.evidence.iter().find_map(|fact| fact.run.as_deref());
            let level = level.map_or_else(String::new, |level| format!(", least under `{level}`"));
            return format!("{}: {value}{level}", measure.quantity);
        }
        match (self.evidence.first(), self.score) {
            (Some(fact), _) => fact.message.clone(),
            (None, Some(_)) => "right".to_owned(),
            (None, None) => "not judged".to_owned(),
        }
    }
}

impl ExplainedTask {
    /// Its hidden cases or runs by class, classes in the order of their first draw.
    pub fn classes(&self) -> Vec<(&str, Vec<&ExplainedDraw>)> {
        let mut classes: Vec<(&str, Vec<&ExplainedDraw>)> = Vec::new();
        for draw in self.attempts.iter().flat_map(|attempt| &attempt.draws) {
            let class = draw.draw.class.as_str();
            match classes.iter_mut().find(|(known, _)| *known == class) {
                Some((_, draws)) => draws.push(draw),
                None => classes.push((class, vec![draw])),
            }
        }
        classes
    }
}

impl Explanation {
    /// All hidden cases and runs, in the order of tasks and draws.
    pub fn draws(&self) -> impl Iterator<Item = &ExplainedDraw> {
        let attempts = self.tasks.iter().flat_map(|task| &task.attempts);
        attempts.flat_map(|attempt| &attempt.draws)
    }
}

/// Numbers as a map.
fn by_name<S: serde::Serializer>(numbers: &Dimensions, into: S) -> Result<S::Ok, S::Error> {
    into.collect_map(numbers.iter())
}
