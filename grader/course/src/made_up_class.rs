//! A made-up class with its book, for tests.

use kinemark_grader::record::grade::{
    CheckGrade, Diagnosis, Digests, Evidence, FORMAT, Grade, GradeMode, HiddenClass, Measure,
    Outcome, Part, TaskGrade, TaskKind,
};
use kinemark_grader::record::verdict::Verdict;

use crate::book::{Book, Inputs, Record};
use crate::history::History;
use crate::index::Index;
use crate::roster::Roster;
use crate::standing::{Standing, Status};
use crate::student::StudentId;

/// The lab of the class.
pub(crate) const LAB: &str = "01-kinematics";

/// A class: rows of the roster, records, how everybody stands.
pub(crate) struct MadeUpClass {
    /// Its book lies here as long as it is used.
    _bed: tempfile::TempDir,
    pub(crate) index: Index,
    pub(crate) roster: Roster,
    pub(crate) standings: Vec<Standing>,
}

/// A student and what they handed in.
pub(crate) struct MadeUpStudent {
    pub(crate) id: String,
    pub(crate) name: String,
    pub(crate) section: String,
    /// The digest of the file; who has the same has the same record.
    pub(crate) file: String,
    pub(crate) has_variant: bool,
    pub(crate) status: Status,
    pub(crate) attempts: usize,
    pub(crate) late_s: Option<i64>,
    pub(crate) tasks: Vec<TaskGrade>,
}

impl MadeUpStudent {
    /// A graded student with one attempt in time.
    pub(crate) fn new(id: &str, tasks: Vec<TaskGrade>) -> Self {
        Self {
            id: id.to_owned(),
            name: format!("Name of {id}"),
            section: String::new(),
            file: format!("file of {id}"),
            has_variant: false,
            status: Status::Graded,
            attempts: 1,
            late_s: Some(0),
            tasks,
        }
    }

    /// One without a hand-in.
    pub(crate) fn without(id: &str, status: Status) -> Self {
        Self {
            status,
            attempts: 0,
            late_s: None,
            ..Self::new(id, Vec::new())
        }
    }

    fn record(&self) -> Option<Record> {
        if self.tasks.is_empty() {
            return None;
        }
        let text = str::to_owned;
        let inputs = Inputs {
            engine: text("kinemark 0.1.0 (engine aa)"),
            lab_name: text(LAB),
            lab: text("l"),
            robot: text("r"),
            scenes: Vec::new(),
            staff: None,
            variant_of: self.has_variant.then(|| self.id.clone()),
            file: text("submission.rhai"),
            submission: self.file.clone(),
            sources: None,
            lab_version: text("0123456789abcdef"),
            staff_version: None,
        };
        Some(Record::new(inputs, grade(self.tasks.clone())))
    }

    fn standing(&self, record: Option<&Record>) -> Standing {
        let record = record.filter(|_| self.status == Status::Graded);
        Standing {
            student: StudentId::new(&self.id).unwrap(),
            lab: LAB.to_owned(),
            status: self.status,
            attempts: self.attempts,
            attempt: (self.attempts > 0).then_some(self.attempts),
            hand_in: None,
            made_with: None,
            has_other_numbers: false,
            is_without_sources: false,
            is_under_resolved: false,
            submitted_at: None,
            late_s: self.late_s,
            marked_late: false,
            record: record.map(|record| record.key.clone()),
            verdict: record.map(|record| record.grade.verdict),
            record_points: record.map(|record| record.grade.points),
            points: record.map(|record| record.grade.points),
            max_points: record.map(|record| record.grade.max_points),
            by_hand: Vec::new(),
            excuse: None,
            failure: None,
        }
    }
}

impl MadeUpClass {
    /// The class of these students, in their order.
    pub(crate) fn of(students: &[MadeUpStudent]) -> Self {
        let bed = tempfile::tempdir().unwrap();
        let book = Book::new(bed.path());
        let mut roster = csv::Writer::from_writer(Vec::new());
        roster.write_record(["id", "name", "section"]).unwrap();
        let mut standings = Vec::new();
        for student in students {
            let record = student.record();
            if let Some(record) = &record {
                book.put_record(record).unwrap();
            }
            roster
                .write_record([&student.id, &student.name, &student.section])
                .unwrap();
            standings.push(student.standing(record.as_ref()));
        }
        let roster = Roster::parse("roster.csv", &roster.into_inner().unwrap()).unwrap();
        let index = Index::refresh(&book, &History::default(), "1").unwrap();
        Self {
            _bed: bed,
            index,
            roster,
            standings,
        }
    }
}

fn grade(tasks: Vec<TaskGrade>) -> Grade {
    let part = |name: &str| Part {
        name: name.to_owned(),
        digest: "d".to_owned(),
    };
    Grade {
        points_at_hand_in: 0.0,
        format: FORMAT.to_owned(),
        engine: "kinemark 0.1.0".to_owned(),
        mode: GradeMode::Graded,
        lab: part(LAB),
        variant: None,
        robot: part("rrbot"),
        scenes: Vec::new(),
        sources: None,
        submission: part("submission.rhai"),
        reference: Some(part(LAB)),
        verdict: tasks
            .iter()
            .map(|task| task.verdict)
            .min()
            .unwrap_or(Verdict::Passed),
        points: tasks.iter().map(|task| task.points).sum(),
        max_points: tasks.iter().map(|task| task.max_points).sum(),
        tasks,
    }
}

/// A task with these checks, whose answers have the digest `digest`.
pub(crate) fn task(name: &str, digest: &str, checks: Vec<CheckGrade>) -> TaskGrade {
    let is_full = checks.iter().all(|check| check.outcome == Outcome::Full);
    TaskGrade {
        points_at_hand_in: 0.0,
        name: name.to_owned(),
        title: format!("Task {name}"),
        kind: TaskKind::Function,
        verdict: if is_full {
            Verdict::Passed
        } else {
            Verdict::Missed
        },
        points: checks.iter().map(|check| check.points).sum(),
        max_points: checks.iter().map(|check| check.max_points).sum(),
        stopped: None,
        checks,
        diagnoses: Vec::new(),
        cases: Vec::new(),
        hidden: vec![HiddenClass {
            class: "hidden class".to_owned(),
            good: 1,
            total: 2,
            under_resolved: 0,
        }],
        events: Vec::new(),
        contacts: Vec::new(),
        operations: 1000,
        log: Vec::new(),
        digests: Digests {
            all: digest.to_owned(),
            seconds: Vec::new(),
            rungs: Vec::new(),
        },
        divergence: None,
        figures: None,
    }
}

/// A check with so many of its points, and a measure in the unit m over the band 0.01 to 0.05.
pub(crate) fn check(name: &str, points: f64, max_points: f64, value: f64) -> CheckGrade {
    CheckGrade {
        name: name.to_owned(),
        title: format!("Check {name}"),
        outcome: match points {
            full if full >= max_points => Outcome::Full,
            some if some > 0.0 => Outcome::Partial,
            _ => Outcome::None,
        },
        points,
        max_points,
        measure: Some(Measure {
            quantity: "error".to_owned(),
            value: Some(value),
            unit: "m".to_owned(),
            full: 0.01,
            zero: 0.05,
            reference: None,
            prediction: None,
        }),
        first_lost: None,
        evidence: Vec::new(),
        next_step: None,
        has_hints: false,
        look_first_at: None,
    }
}

/// The same check, whose only evidence is of a hidden class.
pub(crate) fn lost_in_hidden(mut check: CheckGrade) -> CheckGrade {
    check.evidence = vec![Evidence {
        message: "hidden".to_owned(),
        case: Some("hidden class".to_owned()),
        ..Evidence::default()
    }];
    check
}

/// The same task, which agrees with a known mistake.
pub(crate) fn with_mistake(mut task: TaskGrade, mistake: &str) -> TaskGrade {
    task.diagnoses = vec![Diagnosis {
        mistake: mistake.to_owned(),
        says: format!("It is `{mistake}`."),
        agreeing: 9,
        telling: 9,
    }];
    task
}
