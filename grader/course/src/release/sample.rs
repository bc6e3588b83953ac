//! A class to try the forms on: hostile names, every status, points by hand, and grades of a made-up run.

use std::sync::LazyLock;

use kinemark_grader::record::grade::Grade;
use kinemark_grader::record::hints::{CheckHints, Hints};
use kinemark_grader::record::sample;
use kinemark_grader::record::verdict::Verdict;

use super::{Columns, Export, Material, OpenFiles, Row};
use crate::book::{Inputs, Record};
use crate::roster::Roster;
use crate::standing::{ByHand, Standing, Status};
use crate::student::StudentId;

/// The maximum of every grade here.
const MAXIMUM: f64 = 24.0;

/// Names that break what is careless.
pub(super) const HOSTILE: [(&str, &str); 8] = [
    ("s01", "Ada \"The Countess\" Lovelace, Lady"),
    ("s02", "Line\nBreak; Semicolon"),
    ("s03", "=SUM(A1) Formula"),
    ("s04", "山田 太郎"),
    ("s05", "محمد الخوارزمي"),
    ("s06", "Zoë 😀 Ångström"),
    ("s07", "O'Brien_12_x_y <script>"),
    (
        "s08",
        "A name of a hundred and twenty characters, which is longer than any field in the database of anybody has room for, so there",
    ),
];

static GRADE: LazyLock<Grade> = LazyLock::new(|| {
    let mut grade = sample::graded().grade;
    // forward kinematics first
    grade.tasks.remove(0);
    grade.max_points = MAXIMUM;
    grade
});

/// The hints of the lab: of the check that lost points in every grade, and of one that lost none.
static HINTS: LazyLock<Hints> = LazyLock::new(|| {
    let of = |check: &str, hints: [&str; 2]| CheckHints {
        task: "fk".to_owned(),
        check: check.to_owned(),
        title: "Hinted".to_owned(),
        hints: hints.map(str::to_owned).to_vec(),
    };
    let lost = of(
        "mean-error",
        ["Which angle is it?", "It is q1 + q2 <here>."],
    );
    let full = of("no-such", ["Which point?", "The elbow."]);
    [lost, full].into_iter().collect()
});

/// The grade that everybody has.
pub(super) fn grade() -> Grade {
    GRADE.clone()
}

/// People, how they stand, and their records.
pub(super) struct Class {
    pub(super) roster: Roster,
    pub(super) standings: Vec<Standing>,
    pub(super) records: Vec<Option<Record>>,
}

impl Class {
    /// A class of which nobody handed anything in.
    pub(super) fn of_roster(text: &str) -> Self {
        let roster = Roster::parse("roster.csv", text.as_bytes()).unwrap();
        let people = roster.people();
        let standings = people.iter().map(|person| missing(&person.id)).collect();
        Self {
            standings,
            records: vec![None; people.len()],
            roster,
        }
    }

    /// Everybody of [`HOSTILE`] with 17.5, 16.5 ... points and an address, and behind them one of every other status:
    /// `m` missing, `e` excused, `h` host limit, `g` grader fault, `p` pending, `n` needs a person, `b` with points by hand alone.
    pub(super) fn hostile() -> Self {
        let mut text = "id,name,email,username,lms_id\n".to_owned();
        for (i, (id, name)) in HOSTILE.iter().enumerate() {
            let name = name.replace('"', "\"\"");
            text += &format!("{id},\"{name}\",{id}@x.org,login{id},{}\n", 1000 + i);
        }
        for (i, id) in ["m", "e", "h", "g", "p", "n", "b"].iter().enumerate() {
            text += &format!("{id},Person {id},{id}@x.org,login{id},{}\n", 2000 + i);
        }
        let mut class = Self::of_roster(&text);
        for (i, (id, _)) in HOSTILE.iter().enumerate() {
            class.grade(id, 17.5 - i as f64);
        }
        for (id, status) in [
            ("e", Status::Excused),
            ("h", Status::HostLimit),
            ("g", Status::GraderFault),
            ("p", Status::Pending),
            ("n", Status::NeedsPerson),
            ("b", Status::Graded),
        ] {
            class.of(id).status = status;
        }
        let by_hand = class.of("b");
        by_hand.points = Some(20.0);
        by_hand.by_hand = vec![change(None, 20.0, "shown in person", false)];
        class
    }

    fn at(&self, id: &str) -> usize {
        let mut people = self.roster.people().iter();
        people.position(|person| person.id.as_str() == id).unwrap()
    }

    /// How somebody stands, to change it.
    pub(super) fn of(&mut self, id: &str) -> &mut Standing {
        let at = self.at(id);
        &mut self.standings[at]
    }

    /// Gives somebody a grade of these points.
    pub(super) fn grade(&mut self, id: &str, points: f64) {
        let at = self.at(id);
        let mut grade = grade();
        grade.points = points;
        let standing = &mut self.standings[at];
        standing.status = Status::Graded;
        standing.attempts = 1;
        standing.attempt = Some(1);
        standing.verdict = Some(Verdict::Missed);
        standing.points = Some(points);
        standing.record_points = Some(points);
        standing.max_points = Some(grade.max_points);
        self.records[at] = Some(Record::new(inputs(), grade));
    }

    pub(super) fn rows(&self) -> Vec<Row<'_>> {
        let people = self.roster.people().iter().zip(&self.standings);
        people
            .zip(&self.records)
            .map(|((person, standing), record)| Row {
                person,
                standing,
                record: record.as_ref(),
                report: Some("<!DOCTYPE html><title>report</title>"),
                hints: &HINTS,
                is_of_earlier_lab: false,
            })
            .collect()
    }
}

/// What a form is made from, with a file that is filled in.
pub(super) fn material<'a>(rows: &'a [Row<'a>], export: Option<&'a [u8]>) -> Material<'a> {
    Material {
        lab: "01-kinematics",
        title: "Kinematics",
        max_points: MAXIMUM,
        rows,
        export: export.map(|bytes| Export {
            name: "Grades-R-Lab 1-77.csv",
            bytes,
        }),
        columns: Columns::default(),
        open: OpenFiles::default(),
    }
}

/// Points by hand.
pub(super) fn change(check: Option<&str>, change: f64, why: &str, is_stale: bool) -> ByHand {
    ByHand {
        check: check.map(str::to_owned),
        change,
        why: why.to_owned(),
        by: "ta".to_owned(),
        is_stale,
    }
}

fn missing(student: &StudentId) -> Standing {
    Standing {
        student: student.clone(),
        lab: "01-kinematics".to_owned(),
        status: Status::Missing,
        attempts: 0,
        attempt: None,
        hand_in: None,
        made_with: None,
        has_other_numbers: false,
        is_without_sources: false,
        is_under_resolved: false,
        submitted_at: None,
        late_s: None,
        marked_late: false,
        record: None,
        verdict: None,
        record_points: None,
        points: None,
        max_points: None,
        by_hand: Vec::new(),
        excuse: None,
        failure: None,
    }
}

fn inputs() -> Inputs {
    Inputs {
        engine: "kinemark 0.1.0+aa".to_owned(),
        lab_name: "01-kinematics".to_owned(),
        lab: "l".to_owned(),
        robot: "r".to_owned(),
        scenes: Vec::new(),
        staff: None,
        variant_of: None,
        file: "submission.rhai".to_owned(),
        submission: "u".to_owned(),
        sources: None,
        lab_version: "v".to_owned(),
        staff_version: None,
    }
}
