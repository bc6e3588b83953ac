//! How each student stands in each lab: which attempt counts, its points, points by hand, lateness, and what needs a person.

use jiff::Timestamp;
use kinemark_grader::record::verdict::Verdict;
use serde::Serialize;

use crate::course_file::{Attempts, CourseLab};
use crate::fixes::{Fixes, PointsChange, PointsFix};
use crate::history::{Attempt, History};
use crate::journal::MadeWith;
use crate::roster::{Person, Roster};
use crate::student::StudentId;

/// Where a student's grade in a lab is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Status {
    /// It is there.
    Graded,
    /// Something was handed in and is not graded yet.
    Pending,
    /// This machine's limits ended it, which is no grade.
    HostLimit,
    /// The grader failed, which is no grade.
    GraderFault,
    /// A file is there that nobody could be sure to be theirs.
    NeedsPerson,
    /// Nothing was handed in.
    Missing,
    /// The lab does not count for them.
    Excused,
}

impl Status {
    /// All of them.
    pub const ALL: [Self; 7] = [
        Self::Graded,
        Self::Pending,
        Self::HostLimit,
        Self::GraderFault,
        Self::NeedsPerson,
        Self::Missing,
        Self::Excused,
    ];

    /// Its name in files and tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::Graded => "graded",
            Self::Pending => "pending",
            Self::HostLimit => "host-limit",
            Self::GraderFault => "grader-fault",
            Self::NeedsPerson => "needs-person",
            Self::Missing => "missing",
            Self::Excused => "excused",
        }
    }

    /// The status of this name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|status| status.name() == name)
    }

    /// In words, for people.
    pub fn words(self) -> &'static str {
        match self {
            Self::Graded => "graded",
            Self::Pending => "not graded yet",
            Self::HostLimit => "stopped by this machine",
            Self::GraderFault => "the grader failed",
            Self::NeedsPerson => "needs you",
            Self::Missing => "missing",
            Self::Excused => "excused",
        }
    }
}

/// What is known of a record without reading all of it.
#[derive(Debug, Clone, PartialEq)]
pub struct Summary {
    /// Its verdict.
    pub verdict: Verdict,
    /// Its points.
    pub points: f64,
    /// Its maximum.
    pub max_points: f64,
    /// The engine that made it.
    pub engine: String,
    /// The version of the lab.
    pub lab_version: String,
    /// The version of the staff part.
    pub staff_version: Option<String>,
    /// Whether the simulation of any of its runs is not accurate to the end.
    pub is_under_resolved: bool,
    /// Points of each check, by `TASK/CHECK`.
    pub checks: Vec<(String, f64)>,
}

/// Points by hand, applied.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ByHand {
    /// `TASK/CHECK`, or none for the total.
    pub check: Option<String>,
    /// What it changes the total by.
    pub change: f64,
    /// Why.
    pub why: String,
    /// By whom.
    pub by: String,
    /// Whether it was decided on another record than the one that counts.
    pub is_stale: bool,
}

/// How a student stands in a lab.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Standing {
    /// The student.
    pub student: StudentId,
    /// The lab.
    pub lab: String,
    /// Where the grade is.
    pub status: Status,
    /// How many attempts there are.
    pub attempts: usize,
    /// The number of the one that counts, from one.
    pub attempt: Option<usize>,
    /// The hand-in that counts.
    pub hand_in: Option<String>,
    /// The engine and the lab that the student had, where a hand-in file says so.
    pub made_with: Option<MadeWith>,
    /// Whether the variant that came with it has other numbers than the course's.
    pub has_other_numbers: bool,
    /// Whether it is a module of which no source was handed in.
    pub is_without_sources: bool,
    /// Whether the simulation of a run of the record that counts is not accurate to the end.
    pub is_under_resolved: bool,
    /// When it was handed in, where that is known.
    pub submitted_at: Option<Timestamp>,
    /// How late \[s\]: 0 in time, absent where it is not known.
    pub late_s: Option<i64>,
    /// Whether the LMS marks it as late.
    pub marked_late: bool,
    /// The key of the record that counts.
    pub record: Option<String>,
    /// The verdict of that record.
    pub verdict: Option<Verdict>,
    /// Points of that record.
    pub record_points: Option<f64>,
    /// Points with those by hand; absent where there is no grade.
    pub points: Option<f64>,
    /// The maximum.
    pub max_points: Option<f64>,
    /// Points by hand.
    pub by_hand: Vec<ByHand>,
    /// Why it is excused.
    pub excuse: Option<String>,
    /// Why there is no grade, or why the last try to grade it again gave none.
    pub failure: Option<String>,
}

/// The attempts that have to be graded to know which counts.
pub fn counting(rule: Attempts, attempts: &[Attempt]) -> &[Attempt] {
    match rule {
        Attempts::Best => attempts,
        Attempts::Last => attempts.last().map_or(&[], std::slice::from_ref),
        Attempts::First => attempts.first().map_or(&[], std::slice::from_ref),
    }
}

/// How everybody of the roster stands in `lab`, in the roster's order. `summary` knows the records; `open` are students of whom a file
/// waits for a person.
pub fn standings(
    lab: &CourseLab,
    roster: &Roster,
    fixes: &Fixes,
    history: &History,
    open: &[StudentId],
    summary: impl Fn(&str) -> Option<Summary>,
) -> Vec<Standing> {
    let people = roster.people().iter();
    people
        .map(|person| of_person(lab, person, fixes, history, open, &summary))
        .collect()
}

fn of_person(
    lab: &CourseLab,
    person: &Person,
    fixes: &Fixes,
    history: &History,
    open: &[StudentId],
    summary: &impl Fn(&str) -> Option<Summary>,
) -> Standing {
    let student = &person.id;
    let attempts = history.attempts(&lab.name, student);
    let known: Vec<Option<Summary>> = attempts
        .iter()
        .map(|attempt| attempt.record().and_then(summary))
        .collect();
    let chosen = chosen(lab.attempts, &known);
    let attempt = chosen.map(|index| &attempts[index]);
    let record = chosen.and_then(|index| known[index].clone());
    let excuse = fixes
        .excuses
        .iter()
        .find(|excuse| excuse.lab == lab.name && excuse.student == *student);
    let failure = attempt.and_then(|attempt| attempt.failure.as_ref());
    let mut status = match (&record, attempt) {
        (Some(_), _) => Status::Graded,
        (None, Some(_)) => match failure.map(|failure| failure.verdict) {
            Some(Verdict::HostLimit) => Status::HostLimit,
            Some(_) => Status::GraderFault,
            None => Status::Pending,
        },
        (None, None) if open.contains(student) => Status::NeedsPerson,
        (None, None) => Status::Missing,
    };
    if excuse.is_some() {
        status = Status::Excused;
    }
    let of_student = |fix: &&PointsFix| fix.lab == lab.name && fix.student == *student;
    let fixed: Vec<&PointsFix> = fixes.points.iter().filter(of_student).collect();
    let key = attempt.and_then(Attempt::record);
    let (points, by_hand) = match (status, &record) {
        (Status::Graded, Some(record)) => with_fixes(Some(record), &fixed, key),
        // a total given by hand needs no file, and no grade: work shown in person
        (Status::Missing | Status::NeedsPerson | Status::HostLimit | Status::GraderFault, None) => {
            with_fixes(None, &fixed, None)
        }
        _ => (None, Vec::new()),
    };
    if points.is_some() {
        status = Status::Graded;
    }
    let due = due(lab, student, fixes);
    Standing {
        student: student.clone(),
        lab: lab.name.clone(),
        status,
        attempts: attempts.len(),
        attempt: chosen.map(|index| index + 1),
        hand_in: attempt.map(|attempt| attempt.hand_in.id.clone()),
        made_with: attempt.and_then(|attempt| attempt.hand_in.made_with.clone()),
        has_other_numbers: attempt.is_some_and(|attempt| attempt.hand_in.has_other_numbers),
        is_without_sources: attempt.is_some_and(|attempt| attempt.hand_in.is_without_sources),
        is_under_resolved: record
            .as_ref()
            .is_some_and(|record| record.is_under_resolved),
        submitted_at: attempt.and_then(|attempt| attempt.hand_in.submitted_at),
        late_s: attempt.and_then(|attempt| late_s(attempt, due)),
        marked_late: attempt.is_some_and(|attempt| attempt.hand_in.marked_late == Some(true)),
        record: key.map(str::to_owned),
        verdict: record.as_ref().map(|record| record.verdict),
        record_points: record.as_ref().map(|record| record.points),
        points,
        max_points: record.as_ref().map(|record| record.max_points),
        by_hand,
        excuse: excuse.map(|excuse| excuse.why.clone()),
        failure: failure.map(|failure| failure.what.clone()),
    }
}

/// When a student's work is due: more time that was given counts.
fn due(lab: &CourseLab, student: &StudentId, fixes: &Fixes) -> Option<Timestamp> {
    let mut extensions = fixes.extensions.iter();
    let more = extensions.find(|more| more.lab == lab.name && more.student == *student);
    more.map(|more| more.due).or(lab.due)
}

/// The attempt that counts. Where the best one counts, an attempt without a decided grade counts only if there is no other.
fn chosen(rule: Attempts, known: &[Option<Summary>]) -> Option<usize> {
    let last = known.len().checked_sub(1)?;
    Some(match rule {
        Attempts::First => 0,
        Attempts::Last => last,
        Attempts::Best => {
            let decided = known.iter().enumerate().filter_map(|(index, record)| {
                let record = record.as_ref()?;
                record
                    .verdict
                    .is_decided()
                    .then_some((index, record.points))
            });
            // the latest among equals
            let best = decided.max_by(|one, other| one.1.total_cmp(&other.1));
            best.map_or(last, |(index, _)| index)
        }
    })
}

/// How late an attempt is, where both times are known.
fn late_s(attempt: &Attempt, due: Option<Timestamp>) -> Option<i64> {
    let late = attempt.hand_in.submitted_at?.as_second() - due?.as_second();
    Some(late.max(0))
}

/// Points with those by hand: checks first, then the total.
fn with_fixes(
    record: Option<&Summary>,
    fixes: &[&PointsFix],
    key: Option<&str>,
) -> (Option<f64>, Vec<ByHand>) {
    let mut total = record.map(|record| record.points);
    let mut by_hand = Vec::new();
    let (of_checks, of_total): (Vec<&&PointsFix>, Vec<&&PointsFix>) =
        fixes.iter().partition(|fix| fix.check.is_some());
    for fix in of_checks.into_iter().chain(of_total) {
        let earned = match &fix.check {
            None => total,
            Some(check) => record
                .and_then(|record| record.checks.iter().find(|(name, _)| name == check))
                .map(|(_, points)| *points),
        };
        let change = match (fix.change, earned) {
            (PointsChange::Set(points), earned) => points - earned.unwrap_or(0.0),
            (PointsChange::Add(points), _) => points,
        };
        // a check that is not there any more: the fix is stale and changes nothing
        let is_lost = fix.check.is_some() && earned.is_none();
        if !is_lost {
            total = Some((total.unwrap_or(0.0) + change).max(0.0));
        }
        by_hand.push(ByHand {
            check: fix.check.clone(),
            change: if is_lost { 0.0 } else { change },
            why: fix.why.clone(),
            by: fix.by.clone(),
            is_stale: is_lost
                || fix
                    .record
                    .as_deref()
                    .is_some_and(|record| Some(record) != key),
        });
    }
    // hundredths, as every total of a record
    (total.map(|total| (total * 100.0).round() / 100.0), by_hand)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn summary(points: f64, verdict: Verdict) -> Option<Summary> {
        Some(Summary {
            verdict,
            points,
            max_points: 24.0,
            engine: String::new(),
            lab_version: String::new(),
            staff_version: None,
            is_under_resolved: false,
            checks: vec![("fk/position".to_owned(), 2.0)],
        })
    }

    #[test]
    fn a_status_has_one_name_everywhere() {
        for status in Status::ALL {
            assert_eq!(serde_json::to_value(status).unwrap(), status.name());
            assert_eq!(Status::named(status.name()), Some(status));
        }
        assert_eq!(Status::named("unheard-of"), None);
    }

    #[test]
    fn the_rule_chooses_the_attempt() {
        let known = [
            summary(10.0, Verdict::Missed),
            summary(20.0, Verdict::Missed),
            summary(20.0, Verdict::Missed),
            summary(0.0, Verdict::HostLimit),
        ];
        assert_eq!(chosen(Attempts::First, &known), Some(0));
        assert_eq!(chosen(Attempts::Last, &known), Some(3));
        assert_eq!(chosen(Attempts::Best, &known), Some(2));
        assert_eq!(chosen(Attempts::Best, &[None, None]), Some(1));
        assert_eq!(chosen(Attempts::Best, &[]), None);
    }

    fn fix(check: Option<&str>, change: PointsChange, record: Option<&str>) -> PointsFix {
        PointsFix {
            student: StudentId::new("s1").unwrap(),
            lab: "01".to_owned(),
            check: check.map(str::to_owned),
            change,
            record: record.map(str::to_owned),
            why: "w".to_owned(),
            by: "b".to_owned(),
        }
    }

    #[test]
    fn points_by_hand_are_applied_and_stale_ones_marked() {
        let record = summary(10.0, Verdict::Missed);
        let record = record.as_ref();
        let of_check = fix(Some("fk/position"), PointsChange::Set(5.0), Some("k1"));
        let bonus = fix(None, PointsChange::Add(0.5), None);
        let (total, by_hand) = with_fixes(record, &[&bonus, &of_check], Some("k2"));
        assert_eq!(total, Some(13.5));
        assert_eq!(by_hand[0].change, 3.0);
        assert!(by_hand[0].is_stale && !by_hand[1].is_stale);
        let gone = fix(Some("fk/speed"), PointsChange::Set(5.0), None);
        let (total, by_hand) = with_fixes(record, &[&gone], Some("k1"));
        assert_eq!(total, Some(10.0));
        assert!(by_hand[0].is_stale);
        let shown = fix(None, PointsChange::Set(20.0), None);
        assert_eq!(with_fixes(None, &[&shown], None).0, Some(20.0));
        let away = fix(None, PointsChange::Add(-99.0), None);
        assert_eq!(with_fixes(record, &[&away], None).0, Some(0.0));
    }
}
