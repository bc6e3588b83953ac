//! The grade record `kinemark-grade/1`, from which every output is rendered.
//!
//! It contains no clock time, path or host name: the same submission gives the same bytes.

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::record::run_figures::RunFigures;
use crate::record::verdict::Verdict;

/// The record version that this build writes.
pub const FORMAT: &str = "kinemark-grade/1";

/// The kind of an event after which a simulation is not accurate.
const UNDER_RESOLVED: &str = "under-resolved";

/// A graded run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Grade {
    /// Always `kinemark-grade/1`.
    pub format: String,
    /// The engine and its version, such as `kinemark 0.1.0`.
    pub engine: String,
    /// `graded` with the course staff's reference and hidden cases, `practice` without.
    pub mode: GradeMode,
    /// The lab.
    pub lab: Part,
    /// The numbers of the graded variant; absent for the default variant.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub variant: Option<VariantRecord>,
    /// The robot file.
    pub robot: Part,
    /// The scenes of its motion tasks: name and digest of file and meshes.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub scenes: Vec<Part>,
    /// The submission; `name` is its file name.
    pub submission: Part,
    /// The sources that were handed in beside a compiled module, which a person can read and nothing runs: an empty list where there were
    /// none. Absent for a script.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sources: Option<Vec<Part>>,
    /// The course staff's reference folder, if it took part.
    pub reference: Option<Part>,
    /// The worst verdict of the tasks.
    pub verdict: Verdict,
    /// Points earned.
    pub points: f64,
    /// Maximum points.
    pub max_points: f64,
    /// Points of checks that are judged when the submission is handed in, in practice; they are not among the maximum points.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub points_at_hand_in: f64,
    /// One per task, in the lab's order.
    pub tasks: Vec<TaskGrade>,
}

/// No points are left out of a record.
#[expect(
    clippy::trivially_copy_pass_by_ref,
    reason = "serde passes a reference"
)]
fn is_zero(points: &f64) -> bool {
    points.abs() <= 0.0
}

/// A variant of a lab: its student and its numbers.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct VariantRecord {
    /// The student; absent if the variant file names none.
    pub student: Option<String>,
    /// All parameters of the lab.
    pub parameters: BTreeMap<String, ParameterValue>,
}

/// The value of a parameter: a number, a list of numbers, or a text.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum ParameterValue {
    /// One number.
    Number(f64),
    /// A list.
    List(Vec<f64>),
    /// A text, such as a row of joints.
    Text(String),
}

impl Grade {
    /// Whether it is of a compiled module, of which no source was handed in.
    pub fn is_without_sources(&self) -> bool {
        self.sources.as_ref().is_some_and(Vec::is_empty)
    }

    /// Whether the simulation of any of its runs, hidden ones included, is not accurate to the end.
    pub fn is_under_resolved(&self) -> bool {
        let mut tasks = self.tasks.iter();
        tasks.any(|task| task.first_unresolved().is_some() || task.unresolved_hidden() > 0)
    }
}

impl VariantRecord {
    /// The variant in words: its student and every number.
    pub fn words(&self) -> String {
        let numbers = self.parameters.iter().map(|(name, value)| match value {
            ParameterValue::Number(number) => format!("{name} = {number}"),
            ParameterValue::List(numbers) => format!("{name} = {numbers:?}"),
            ParameterValue::Text(text) => format!("{name} = {text}"),
        });
        let numbers: Vec<String> = numbers.collect();
        let whose = match &self.student {
            Some(student) => format!("variant of {student}"),
            None => "variant without a student's name".to_owned(),
        };
        format!("{whose}: {}", numbers.join(", "))
    }
}

/// Whether hidden cases took part.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum GradeMode {
    /// Visible cases only.
    Practice,
    /// Visible and hidden cases.
    Graded,
}

/// A file or folder that took part, by name and content.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Part {
    /// Its name.
    pub name: String,
    /// BLAKE3 of its bytes, in hexadecimal.
    pub digest: String,
}

/// The kind of a task.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum TaskKind {
    /// A function is called on cases.
    Function,
    /// A simulated run under `control`.
    Motion,
}

/// What is asked where a task makes its motion from the function of an earlier one that lost most of its points.
pub fn repair_first(task: &str) -> String {
    format!("Task `{task}` has lost points. If this run uses the same function, repair that first.")
}

/// One task, graded.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TaskGrade {
    /// Its name in the lab file.
    pub name: String,
    /// Its title.
    pub title: String,
    /// Its kind.
    pub kind: TaskKind,
    /// Its outcome.
    pub verdict: Verdict,
    /// Points earned.
    pub points: f64,
    /// Maximum points.
    pub max_points: f64,
    /// As in the grade.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub points_at_hand_in: f64,
    /// The stop of the submission, if it was stopped.
    pub stopped: Option<Stopped>,
    /// Its checks, in the lab's order.
    pub checks: Vec<CheckGrade>,
    /// Common mistakes that the answers agree with.
    pub diagnoses: Vec<Diagnosis>,
    /// Visible cases of a function task, each with its answer.
    pub cases: Vec<CaseGrade>,
    /// Hidden cases of a function task, or hidden runs of a motion task, counted by class.
    pub hidden: Vec<HiddenClass>,
    /// Events in the run of a motion task (the first 100 events of joints and the first 200 others).
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub events: Vec<EventRecord>,
    /// Contacts in a scene (the first 200).
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub contacts: Vec<ContactRecord>,
    /// Operations that the submission used; in a function task those of visible cases.
    pub operations: u64,
    /// Lines the submission printed (the first 200).
    pub log: Vec<LogEntry>,
    /// Digests of the run or the answers.
    pub digests: Digests,
    /// The first difference of a motion task's run that lost points from the reference solution's run; absent if there is none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub divergence: Option<Divergence>,
    /// What the visible run of a motion task with full points took; worth no points.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub figures: Option<RunFigures>,
}

impl TaskGrade {
    /// The first event that says that the simulation of its run is not accurate from there on.
    pub fn first_unresolved(&self) -> Option<&EventRecord> {
        self.events
            .iter()
            .find(|event| event.event == UNDER_RESOLVED)
    }

    /// How many of its hidden runs are not accurate to their ends.
    pub fn unresolved_hidden(&self) -> u32 {
        self.hidden.iter().map(|class| class.under_resolved).sum()
    }
}

/// The first control tick at which a run differs from the reference solution's. It is not a mistake by itself: another path or another
/// time may be as right.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Divergence {
    /// The tick.
    pub tick: u64,
    /// Its time \[s\].
    pub time_s: f64,
    /// The signal: `tcp`, or a joint's position such as `q[1]`.
    pub signal: String,
    /// Value of the signal: x, y, z in the lab's frame, or one number.
    pub yours: Vec<f64>,
    /// Value of the signal in the reference solution's run.
    pub reference: Vec<f64>,
    /// Distance between the two values.
    pub distance: f64,
    /// Smaller distances are not reported.
    pub tolerance: f64,
    /// Unit of all four.
    pub unit: String,
    /// In words.
    pub message: String,
}

/// An event in a run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct EventRecord {
    /// The tick.
    pub tick: u64,
    /// Its time \[s\].
    pub time_s: f64,
    /// Its kind: `saturated`, `limit-hit`, `speed-limit-hit`, `under-resolved`, `near-singular`, `touched`, `moved`, `toppled`, `left-support`, `body-fell`, `diverged` or `stopped`.
    pub event: String,
    /// In words.
    pub message: String,
}

/// One contact of two parties: links of the robot, bodies of the scene, or the ground.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ContactRecord {
    /// The names of the two parties.
    pub parties: [String; 2],
    /// The first tick at which they pressed on each other.
    pub first_tick: u64,
    /// The last such tick; pauses shorter than 20 ms count as contact.
    pub last_tick: u64,
    /// The greatest normal force, mean over a physics step \[N\].
    pub peak_force_n: f64,
    /// The tick of the greatest force.
    pub peak_tick: u64,
    /// Sum of the normal impulses \[N s\].
    pub impulse_n_s: f64,
}

/// The stop of a submission in a task.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Stopped {
    /// What happened.
    pub message: String,
    /// What to do about it.
    pub help: Option<String>,
    /// What else is wrong in the file, in the order of its lines.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub further: Vec<FurtherMistake>,
    /// Line in the submission, from one.
    pub line: Option<usize>,
    /// Column in that line, in characters, from one.
    pub column: Option<usize>,
    /// The line itself; of a line of more than 160 characters what is around the column, with `…` for what is left out.
    pub source_line: Option<String>,
    /// The column in `source_line`, where that begins in the middle of the line; absent where it is `column`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub source_column: Option<usize>,
    /// The tick of a motion task at which it happened.
    pub tick: Option<u64>,
    /// The time of that tick \[s\].
    pub time_s: Option<f64>,
    /// The visible case of a function task in which it happened, or the class of a hidden one.
    pub case: Option<String>,
    /// The share of its points that a run keeps, which went on with the last command; absent where nothing was left to judge.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub kept: Option<f64>,
}

impl Stopped {
    /// The column in [`Self::source_line`], from one.
    pub fn column_in_source_line(&self) -> Option<usize> {
        self.source_column.or(self.column)
    }
}

/// What else is wrong in a submission, besides the mistake that stopped it.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FurtherMistake {
    /// The lines, from one; at least one.
    pub lines: Vec<usize>,
    /// What to do about it.
    pub help: String,
}

impl FurtherMistake {
    /// Its lines and what to do, such as `lines 3, 5: write x ** 2`.
    pub fn words(&self) -> String {
        let lines: Vec<String> = self.lines.iter().map(ToString::to_string).collect();
        let noun = if lines.len() == 1 { "line" } else { "lines" };
        format!("{noun} {}: {}", lines.join(", "), self.help)
    }
}

/// How many of a check's points were earned.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Outcome {
    /// All of them.
    Full,
    /// Some of them.
    Partial,
    /// None of them.
    None,
    /// None, because a check that it needs earned none, or the submission was stopped before.
    NotJudged,
    /// Not decided in practice: it is judged with the reference solution, when the submission is handed in. Its points are not among the
    /// maximum points.
    AtHandIn,
}

/// One check, graded.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CheckGrade {
    /// Its name in the lab file.
    pub name: String,
    /// Its title.
    pub title: String,
    /// Its outcome.
    pub outcome: Outcome,
    /// Points earned, an integer number of hundredths.
    pub points: f64,
    /// Maximum points.
    pub max_points: f64,
    /// The measured value and its band.
    pub measure: Option<Measure>,
    /// The moment at which it began to lose points in the run of a motion task: when the judged curve first leaves the band of full
    /// points, if every moment of that curve is compared with the band, else the earliest moment of its evidence. Absent if there is none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub first_lost: Option<Instant>,
    /// Why points were lost, worst first; empty if none were.
    pub evidence: Vec<Evidence>,
    /// The next step, if points were lost.
    pub next_step: Option<String>,
    /// Whether the next step is the lab's question, to which `kinemark hint TASK/CHECK` has hints; left out if it is not.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub has_hints: bool,
    /// The name of the check of the same task to look at first, because it may be why this one lost its points, or could not be judged; absent if
    /// there is none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub look_first_at: Option<String>,
}

/// A moment of the visible run of a motion task, which the report shows.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Instant {
    /// The tick.
    pub tick: u64,
    /// Its time \[s\].
    pub time_s: f64,
}

/// A measured value and the band it was judged by: `full` earns all points, `zero` none, between them they fall linearly.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Measure {
    /// What was measured, such as `mean position error`.
    pub quantity: String,
    /// The value, of the visible run or cases; absent where it is not finite.
    pub value: Option<f64>,
    /// Unit of value and band; empty for a ratio.
    pub unit: String,
    /// The value that earns all points.
    pub full: f64,
    /// The value that earns none.
    pub zero: f64,
    /// The value that the reference solution reaches in the same variant, where the band depends on it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub reference: Option<f64>,
    /// The value of the linear loop, where the lab predicts one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub prediction: Option<f64>,
}

impl Measure {
    /// Margin of the value to `full`, negative outside, in the unit of the measure.
    pub fn margin(&self) -> Option<f64> {
        let toward = if self.zero >= self.full { 1.0 } else { -1.0 };
        self.value.map(|value| (self.full - value) * toward)
    }
}

/// A fact that cost points.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Evidence {
    /// What happened, in a sentence with its numbers.
    pub message: String,
    /// The signal it shows in, such as `tcp`, `q[1]`, `effort[0]`, or the function called.
    pub signal: String,
    /// The tick of the visible run at which it first went wrong, or was worst. For another run only the message gives a time.
    pub tick: Option<u64>,
    /// The time of that tick \[s\].
    pub time_s: Option<f64>,
    /// The run in which it happened, if not the visible one: the name of the level of a robustness check.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub run: Option<String>,
    /// The visible case of a function task, or the class of hidden ones.
    pub case: Option<String>,
    /// The value there.
    pub value: Option<f64>,
    /// The limit with which it was compared.
    pub limit: Option<f64>,
    /// Unit of value and limit.
    pub unit: String,
    /// Whether it is the mistake that the whole run, or all answers together, show: to be looked at first.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub is_cause: bool,
    /// Whether it says only how the points came about: that they are a mean, or that the check was not judged in a hidden run.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub is_note: bool,
}

/// A common mistake that the answers agree with.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Diagnosis {
    /// The mistake's name in the reference folder.
    pub mistake: String,
    /// The mistake in words.
    pub says: String,
    /// Answers that show the mistake.
    pub agreeing: u32,
    /// Answers in which the mistake would show.
    pub telling: u32,
}

/// A visible case of a function task.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CaseGrade {
    /// Its name.
    pub name: String,
    /// The input of the function.
    pub given: String,
    /// Its answer.
    pub answer: String,
    /// The right answer, if it does not give away another task.
    pub expected: Option<String>,
    /// Error of the answer \[m\]; absent if there is no answer or the error is not finite.
    pub error_m: Option<f64>,
    /// Of a Jacobian: distance from the true one as a fraction of its norm; absent if it is not finite.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub relative_error: Option<f64>,
    /// Whether the answer is within the band's `full`.
    pub good: bool,
}

/// Hidden cases or runs of one class; only their number is reported.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct HiddenClass {
    /// The class of case, such as `unequal links`.
    pub class: String,
    /// Cases with a good answer; runs in which every check is full.
    pub good: u32,
    /// All cases or runs of the class.
    pub total: u32,
    /// Runs whose simulation is not accurate to their ends: `under-resolved`. Left out if there are none.
    #[serde(default, skip_serializing_if = "is_none")]
    pub under_resolved: u32,
}

fn is_none(count: &u32) -> bool {
    *count == 0
}

/// A line the submission printed.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LogEntry {
    /// The tick of the call in a motion task, the number of the case in a function task.
    pub at: u64,
    /// The text.
    pub text: String,
    /// The line of the script that printed it. Left out where that is not known: of a module, and of notes of the grader.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub line: Option<usize>,
}

/// Digests of a submission's run or answers in a task, in hexadecimal BLAKE3.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Digests {
    /// Digest of the whole run, or of all answers in order.
    pub all: String,
    /// Digests of every simulated second of a motion task.
    pub seconds: Vec<SecondDigests>,
    /// Digests of the runs under the disturbances of robustness checks, if there are any.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub rungs: Vec<LevelDigest>,
}

/// Digest of one run under a disturbance.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LevelDigest {
    /// The robustness check's name.
    pub check: String,
    /// The name of the level.
    pub rung: String,
    /// Digest of the whole run, in hexadecimal BLAKE3.
    pub digest: String,
}

/// Digests of one simulated second.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SecondDigests {
    /// Joint positions.
    pub q: String,
    /// Joint velocities.
    pub qd: String,
    /// Commands.
    pub command: String,
    /// Efforts.
    pub effort: String,
    /// TCP poses.
    pub tcp: String,
    /// Poses of the scene's bodies, if any can move.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub bodies: Option<String>,
    /// Readings of the sensors, if there are any.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sensors: Option<String>,
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The published schema is that of the code; `KINEMARK_BLESS=1` writes it anew.
    #[test]
    fn the_published_schema_is_current() {
        let path = concat!(
            env!("CARGO_MANIFEST_DIR"),
            "/../docs/grade-format.schema.json"
        );
        let schema = serde_json::to_string_pretty(&schemars::schema_for!(Grade)).unwrap() + "\n";
        let published = std::fs::read_to_string(path).unwrap_or_default();
        if published != schema && std::env::var_os("KINEMARK_BLESS").is_some() {
            std::fs::write(path, &schema).unwrap();
        }
        assert!(
            published == schema,
            "docs/grade-format.schema.json was not that of the code: KINEMARK_BLESS=1 cargo test writes it (docs/tests.md)"
        );
    }

    #[test]
    fn a_margin_is_positive_inside_the_band_whichever_way_it_runs() {
        let measure = |value, full, zero| Measure {
            quantity: String::new(),
            value: Some(value),
            unit: String::new(),
            full,
            zero,
            reference: None,
            prediction: None,
        };
        assert_eq!(measure(1.0, 2.0, 4.0).margin(), Some(1.0));
        assert_eq!(measure(3.0, 2.0, 4.0).margin(), Some(-1.0));
        assert_eq!(measure(0.5, 1.0, 0.0).margin(), Some(-0.5));
    }
}
