//! The grade record `kinemark-grade/1`: the one value every format is rendered from.
//!
//! No clock, no path, no host is in it: the same submission gives the same bytes.

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::record::verdict::Verdict;

/// The version of the record this build writes.
pub const FORMAT: &str = "kinemark-grade/1";

/// A graded run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Grade {
    /// Always `kinemark-grade/1`.
    pub format: String,
    /// The engine and its version, such as `kinemark 0.1.0`.
    pub engine: String,
    /// `graded` with the staff's reference and hidden cases, `practice` without.
    pub mode: GradeMode,
    /// The lab.
    pub lab: Part,
    /// The numbers of the variant that was graded; absent where it was the lab as everyone has it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub variant: Option<VariantRecord>,
    /// The robot file.
    pub robot: Part,
    /// The scenes of its motion tasks: name and digest of file and meshes.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub scenes: Vec<Part>,
    /// The submission; `name` is its file name.
    pub submission: Part,
    /// The staff's reference folder, if it took part.
    pub reference: Option<Part>,
    /// The worst verdict of the tasks.
    pub verdict: Verdict,
    /// Points earned.
    pub points: f64,
    /// Points there are.
    pub max_points: f64,
    /// One per task, in the lab's order.
    pub tasks: Vec<TaskGrade>,
}

/// A variant of a lab: whose it is, and its numbers.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct VariantRecord {
    /// The student; absent where the file names none.
    pub student: Option<String>,
    /// All parameters of the lab.
    pub parameters: BTreeMap<String, ParameterValue>,
}

/// The value of a parameter: a number, or a list of numbers.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum ParameterValue {
    /// One number.
    Number(f64),
    /// A list.
    List(Vec<f64>),
}

impl VariantRecord {
    /// It in words: whose it is, and every number.
    pub fn words(&self) -> String {
        let numbers = self.parameters.iter().map(|(name, value)| match value {
            ParameterValue::Number(number) => format!("{name} = {number}"),
            ParameterValue::List(numbers) => format!("{name} = {numbers:?}"),
        });
        let numbers: Vec<String> = numbers.collect();
        let whose = match &self.student {
            Some(student) => format!("variant of {student}"),
            None => "variant of nobody named".to_owned(),
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

/// Something that took part, by name and content.
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
    /// Points there are.
    pub max_points: f64,
    /// What stopped the submission, if something did.
    pub stopped: Option<Stopped>,
    /// Its checks, in the lab's order.
    pub checks: Vec<CheckGrade>,
    /// Known mistakes that the answers agree with.
    pub diagnoses: Vec<Diagnosis>,
    /// Visible cases of a function task, each with its answer.
    pub cases: Vec<CaseGrade>,
    /// Hidden cases of a function task, or hidden runs of a motion task, counted by class.
    pub hidden: Vec<HiddenClass>,
    /// What happened in the run of a motion task (the first 100 events of joints and the first 200 others).
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub events: Vec<EventRecord>,
    /// Who pressed on whom in a scene (the first 200 contacts).
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub contacts: Vec<ContactRecord>,
    /// Operations the submission used; in a function task those of visible cases.
    pub operations: u64,
    /// Lines the submission printed (the first 200).
    pub log: Vec<LogEntry>,
    /// Identity of what the submission did.
    pub digests: Digests,
    /// Where the run of a motion task that lost points first differs from the reference solution's; absent where it does not.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub divergence: Option<Divergence>,
}

/// The first control tick at which a run is not where the reference solution's is. It is no mistake by itself: another path, or
/// another time, may be as right.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Divergence {
    /// The tick.
    pub tick: u64,
    /// Its time \[s\].
    pub time_s: f64,
    /// The signal: `tcp`, or a joint's position such as `q[1]`.
    pub signal: String,
    /// The signal there: x, y, z in the lab's frame, or one number.
    pub yours: Vec<f64>,
    /// The reference solution's.
    pub reference: Vec<f64>,
    /// How far the two are from each other.
    pub distance: f64,
    /// How far they may be without being told.
    pub tolerance: f64,
    /// Unit of all four.
    pub unit: String,
    /// In words.
    pub message: String,
}

/// Something that happened in a run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct EventRecord {
    /// The tick.
    pub tick: u64,
    /// Its time \[s\].
    pub time_s: f64,
    /// Its kind: `saturated`, `limit-hit`, `speed-limit-hit`, `near-singular`, `touched`, `moved`, `toppled`, `left-support`, `body-fell`, `diverged` or `stopped`.
    pub event: String,
    /// In words.
    pub message: String,
}

/// One contact of two parties: links of the robot, bodies of the scene, or the ground.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ContactRecord {
    /// The two.
    pub parties: [String; 2],
    /// The first tick at which they pressed on each other.
    pub first_tick: u64,
    /// The last one; shorter pauses than 20 ms count as contact.
    pub last_tick: u64,
    /// The greatest normal force, mean over a physics step \[N\].
    pub peak_force_n: f64,
    /// The tick of that.
    pub peak_tick: u64,
    /// Sum of the normal impulses \[N s\].
    pub impulse_n_s: f64,
}

/// What stopped a submission in a task.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Stopped {
    /// What happened.
    pub message: String,
    /// Something to do.
    pub help: Option<String>,
    /// Line in the submission, from one.
    pub line: Option<usize>,
    /// Column in that line, in characters, from one.
    pub column: Option<usize>,
    /// The line itself.
    pub source_line: Option<String>,
    /// The tick of a motion task at which it happened.
    pub tick: Option<u64>,
    /// The time of that tick \[s\].
    pub time_s: Option<f64>,
    /// The visible case of a function task in which it happened, or the class of a hidden one.
    pub case: Option<String>,
}

/// How much of a check's points was earned.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Outcome {
    /// All of them.
    Full,
    /// Some of them.
    Partial,
    /// None of them.
    None,
    /// None, because a check it needs earned none, or the submission was stopped before.
    NotJudged,
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
    /// Points earned, in whole hundredths.
    pub points: f64,
    /// Points there are.
    pub max_points: f64,
    /// What was measured against the band.
    pub measure: Option<Measure>,
    /// Where it began to lose points in the run of a motion task: where the curve it judged first leaves the band of full points, if
    /// every moment of that curve is held against the band, else the earliest moment of its evidence. Absent where no moment is told.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub first_lost: Option<Instant>,
    /// Why points were lost, worst first; empty where none were.
    pub evidence: Vec<Evidence>,
    /// One thing to do next, where points were lost.
    pub next_step: Option<String>,
}

/// A moment of the run of a motion task: the visible one, which the report shows.
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
    /// The value; absent where it is not finite.
    pub value: Option<f64>,
    /// Unit of value and band; empty for a ratio.
    pub unit: String,
    /// The value that earns all points.
    pub full: f64,
    /// The value that earns none.
    pub zero: f64,
}

impl Measure {
    /// How far the value lies inside `full` (positive) or outside it (negative), in the unit of the measure.
    pub fn margin(&self) -> Option<f64> {
        let toward = if self.zero >= self.full { 1.0 } else { -1.0 };
        self.value.map(|value| (self.full - value) * toward)
    }
}

/// A fact that cost points.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Evidence {
    /// What happened, in a sentence with its numbers.
    pub message: String,
    /// The signal it shows in, such as `tcp`, `q[1]`, `effort[0]`, or the function called.
    pub signal: String,
    /// The tick of a motion task at which it first went wrong, or at its worst; always one of the visible run. Of another run only
    /// the message tells a time.
    pub tick: Option<u64>,
    /// The time of that tick \[s\].
    pub time_s: Option<f64>,
    /// The run it happened in, where that is not the visible one: the name of the rung of a robustness check.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub run: Option<String>,
    /// The visible case of a function task, or the class of hidden ones.
    pub case: Option<String>,
    /// The value there.
    pub value: Option<f64>,
    /// The limit it was held against.
    pub limit: Option<f64>,
    /// Unit of value and limit.
    pub unit: String,
}

/// A known mistake that the answers agree with.
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
    /// What the function was given.
    pub given: String,
    /// What it answered.
    pub answer: String,
    /// What would have been right, where telling it gives no other task away.
    pub expected: Option<String>,
    /// Error of the answer \[m\]; absent where there is none or it is not finite.
    pub error_m: Option<f64>,
    /// Of a Jacobian: distance from the true one as a fraction of its norm; absent where it is not finite.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub relative_error: Option<f64>,
    /// Whether the answer is within the band's `full`.
    pub good: bool,
}

/// Hidden cases or runs of one class: only their number is told.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct HiddenClass {
    /// The class of case, such as `unequal links`.
    pub class: String,
    /// Cases with a good answer; runs in which every check is full.
    pub good: u32,
    /// Cases or runs there are.
    pub total: u32,
}

/// A line the submission printed.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LogEntry {
    /// The tick of the call in a motion task, the number of the case in a function task.
    pub at: u64,
    /// The text.
    pub text: String,
}

/// Identity of what a submission did in a task, in hexadecimal BLAKE3.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Digests {
    /// Of the whole run, or of all answers in order.
    pub all: String,
    /// Of every simulated second of a motion task.
    pub seconds: Vec<SecondDigests>,
    /// Of the runs under disturbances that robustness checks asked for, where there were any.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub rungs: Vec<LevelDigest>,
}

/// Identity of one run under a disturbance.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LevelDigest {
    /// The robustness check's name.
    pub check: String,
    /// The rung's name.
    pub rung: String,
    /// Of the whole run, in hexadecimal BLAKE3.
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
    /// Poses of the scene's bodies, where any can move.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub bodies: Option<String>,
    /// Readings of the sensors, where there are any.
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
        };
        assert_eq!(measure(1.0, 2.0, 4.0).margin(), Some(1.0));
        assert_eq!(measure(3.0, 2.0, 4.0).margin(), Some(-1.0));
        assert_eq!(measure(0.5, 1.0, 0.0).margin(), Some(-0.5));
    }
}
