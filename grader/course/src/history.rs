//! The journal, read: each student's attempts at each lab, and the record that is the grade of each.

use std::collections::{BTreeMap, BTreeSet};

use jiff::Timestamp;
use kinemark_grader::record::verdict::Verdict;

use crate::fixes::{FileFix, Fixes};
use crate::journal::{Entry, Event, Graded, HandIn};
use crate::student::StudentId;

/// A hand-in with its grades, in the order of time.
#[derive(Debug, Clone, PartialEq)]
pub struct Attempt {
    /// What was handed in.
    pub hand_in: HandIn,
    /// When the course first read it.
    pub read_at: Timestamp,
    /// Its grades, the earliest first; the last one stands.
    pub grades: Vec<GradeEvent>,
    /// Why the last try to grade it gave no grade.
    pub failure: Option<Failure>,
}

/// Why a hand-in could not be graded.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Failure {
    /// `host-limit` or `grader-fault`.
    pub verdict: Verdict,
    /// What happened, in words.
    pub what: String,
}

/// A record became the grade of a hand-in.
#[derive(Debug, Clone, PartialEq)]
pub struct GradeEvent {
    /// When.
    pub at: Timestamp,
    /// By whose command.
    pub by: String,
    /// The key of the record.
    pub record: String,
    /// Its points, as they were when it became the grade.
    pub points: Option<f64>,
    /// Why, where it replaced an earlier one.
    pub why: Option<String>,
}

impl Attempt {
    /// The key of the record that is its grade; none where it is not graded yet.
    pub fn record(&self) -> Option<&str> {
        self.grades.last().map(|grade| grade.record.as_str())
    }

    /// When it was handed in, as far as that is known: as the LMS says, else when the course first read it.
    pub fn time(&self) -> Timestamp {
        self.hand_in.submitted_at.unwrap_or(self.read_at)
    }
}

/// What happened in a course.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct History {
    attempts: BTreeMap<(String, StudentId), Vec<Attempt>>,
    /// The place of each hand-in by its id.
    places: BTreeMap<String, (String, StudentId, usize)>,
    /// Hand-ins that were read and do not count, because people decided otherwise since.
    pub withdrawn: Vec<HandIn>,
    /// Digests of the paths of files that count for nobody.
    ignored: BTreeSet<String>,
    /// Grades that went out: when, the lab, the form, and the record of each student.
    pub releases: Vec<Release>,
}

/// Grades that went to the LMS.
#[derive(Debug, Clone, PartialEq)]
pub struct Release {
    /// When.
    pub at: Timestamp,
    /// The lab.
    pub lab: String,
    /// The form, such as `moodle`.
    pub to: String,
    /// The key of each student's record.
    pub records: BTreeMap<StudentId, String>,
}

impl History {
    /// Reads entries that are in the order of time. A hand-in that is there twice counts once; a grade of an unknown hand-in, whose
    /// line another book has, waits for it and counts for nothing.
    pub fn of(entries: impl IntoIterator<Item = Entry>) -> Self {
        let mut history = Self::default();
        for entry in entries {
            let Entry { at, by, event } = entry;
            match event {
                Event::HandIn(hand_in) => history.hand_in(at, *hand_in),
                Event::Graded(graded) => history.graded(at, by, graded),
                Event::NotGraded {
                    hand_in,
                    verdict,
                    what,
                } => {
                    if let Some(attempt) = history.attempt_mut(&hand_in) {
                        attempt.failure = Some(Failure { verdict, what });
                    }
                }
                Event::Ignored { places, .. } => history.ignored.extend(places),
                Event::Released { lab, to, records } => history.releases.push(Release {
                    at,
                    lab,
                    to,
                    records,
                }),
            }
        }
        for attempts in history.attempts.values_mut() {
            // stable: those of one time stay in the order in which they were read
            attempts.sort_by_key(|attempt| (attempt.time(), attempt.hand_in.attempt));
        }
        history
    }

    /// The history as people decided on its files: what belongs to somebody else, or to nobody, does not count.
    #[must_use]
    pub fn decided(mut self, fixes: &Fixes) -> Self {
        let by_place: BTreeMap<String, &FileFix> =
            fixes.files.iter().map(|fix| (fix.place(), fix)).collect();
        let counts = |attempt: &Attempt| {
            let hand_in = &attempt.hand_in;
            let decisions = hand_in.places.iter();
            let mut decisions = decisions.filter_map(|place| by_place.get(place)).peekable();
            if decisions.peek().is_none() {
                // what only a decision gave to somebody, and the decision is gone
                return hand_in.matched_by != "fixes" || hand_in.places.is_empty();
            }
            decisions.any(|fix| fix.student.as_ref() == Some(&hand_in.student))
        };
        for attempts in self.attempts.values_mut() {
            let gone = attempts.extract_if(.., |attempt| !counts(attempt));
            self.withdrawn.extend(gone.map(|attempt| attempt.hand_in));
        }
        self.attempts.retain(|_, attempts| !attempts.is_empty());
        self
    }

    /// Every hand-in that was read, those that do not count among them.
    fn read(&self) -> impl Iterator<Item = &HandIn> {
        let counted = self.attempts.values().flatten();
        counted
            .map(|attempt| &attempt.hand_in)
            .chain(&self.withdrawn)
    }

    /// The hand-ins that a decision on a file makes and that nobody has written yet: the file was read as somebody else's.
    pub fn reassigned(&self, fix: &FileFix) -> Vec<HandIn> {
        let Some(student) = &fix.student else {
            return Vec::new();
        };
        let place = fix.place();
        let mut made: Vec<HandIn> = Vec::new();
        for hand_in in self
            .read()
            .filter(|hand_in| hand_in.places.contains(&place))
        {
            let theirs = HandIn {
                student: student.clone(),
                sources: None,
                is_without_sources: false,
                matched_by: "fixes".to_owned(),
                variant_of: None,
                ..hand_in.clone()
            }
            .identified();
            if !self.knows(&theirs.id) && made.iter().all(|known| known.id != theirs.id) {
                made.push(theirs);
            }
        }
        made
    }

    /// Whether a file on which a person decided was read: as somebody's, or as nobody's.
    pub fn has_read(&self, fix: &FileFix) -> bool {
        let place = fix.place();
        let mut read = self.read();
        read.any(|hand_in| hand_in.places.contains(&place))
            || (fix.student.is_none() && self.ignored.contains(&place))
    }

    /// Whether a path of this digest was noted as nobody's.
    pub fn has_ignored(&self, place: &str) -> bool {
        self.ignored.contains(place)
    }

    /// Whether a hand-in that was read before is handed in anew: the source gives no time, and the student's last is another.
    pub fn is_anew(&self, hand_in: &HandIn) -> bool {
        let last = self.attempts(&hand_in.lab, &hand_in.student).last();
        hand_in.submitted_at.is_none()
            && hand_in.attempt.is_none()
            && self.knows(&hand_in.id)
            && last.is_some_and(|last| last.hand_in.id != hand_in.id)
            && self.withdrawn.iter().all(|gone| gone.id != hand_in.id)
    }

    fn hand_in(&mut self, at: Timestamp, hand_in: HandIn) {
        if self.places.contains_key(&hand_in.id) {
            if hand_in.submitted_at.is_none()
                && let Some(attempt) = self.attempt_mut(&hand_in.id)
            {
                // handed in anew: where the source gives no time, what is read last is the latest
                attempt.read_at = at;
            }
            return;
        }
        let (lab, student) = (hand_in.lab.clone(), hand_in.student.clone());
        let attempts = self
            .attempts
            .entry((lab.clone(), student.clone()))
            .or_default();
        let place = (lab, student, attempts.len());
        self.places.insert(hand_in.id.clone(), place);
        attempts.push(Attempt {
            hand_in,
            read_at: at,
            grades: Vec::new(),
            failure: None,
        });
    }

    fn graded(&mut self, at: Timestamp, by: String, graded: Graded) {
        let Some(attempt) = self.attempt_mut(&graded.hand_in) else {
            return;
        };
        attempt.failure = None;
        // two shards that grade the same say the same
        if attempt.record() != Some(graded.record.as_str()) {
            attempt.grades.push(GradeEvent {
                at,
                by,
                record: graded.record,
                points: graded.points,
                why: graded.why,
            });
        }
    }

    fn attempt_mut(&mut self, hand_in: &str) -> Option<&mut Attempt> {
        let (lab, student, index) = self.places.get(hand_in)?;
        let attempts = self.attempts.get_mut(&(lab.clone(), student.clone()))?;
        attempts.get_mut(*index)
    }

    /// The attempts of a student at a lab, the earliest first.
    pub fn attempts(&self, lab: &str, student: &StudentId) -> &[Attempt] {
        let key = (lab.to_owned(), student.clone());
        self.attempts.get(&key).map_or(&[], Vec::as_slice)
    }

    /// All attempts at a lab, by student.
    pub fn of_lab(&self, lab: &str) -> impl Iterator<Item = (&StudentId, &[Attempt])> {
        let all = self.attempts.iter();
        let of_lab = all.filter(move |((name, _), _)| name == lab);
        of_lab.map(|((_, student), attempts)| (student, attempts.as_slice()))
    }

    /// Labs with attempts and their students, sorted.
    pub fn all(&self) -> impl Iterator<Item = (&str, &StudentId, &[Attempt])> {
        let all = self.attempts.iter();
        all.map(|((lab, student), attempts)| (lab.as_str(), student, attempts.as_slice()))
    }

    /// Whether the last try to grade a hand-in gave no grade.
    pub fn has_failed(&self, hand_in: &str) -> bool {
        let Some((lab, student, _)) = self.places.get(hand_in) else {
            return false;
        };
        let mut attempts = self.attempts(lab, student).iter();
        attempts.any(|attempt| attempt.hand_in.id == hand_in && attempt.failure.is_some())
    }

    /// Whether a hand-in of this id was read before.
    pub fn knows(&self, hand_in: &str) -> bool {
        self.places.contains_key(hand_in)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(second: i64) -> Timestamp {
        Timestamp::from_second(second).unwrap()
    }

    fn hand_in(submitted: Option<i64>, submission: &str) -> HandIn {
        HandIn {
            id: String::new(),
            student: StudentId::new("s1").unwrap(),
            lab: "01".to_owned(),
            submission: submission.to_owned(),
            file: "submission.rhai".to_owned(),
            sources: None,
            is_without_sources: false,
            matched_by: "id".to_owned(),
            submitted_at: submitted.map(at),
            marked_late: None,
            attempt: None,
            lms_number: None,
            variant_of: None,
            made_with: None,
            has_other_numbers: false,
            places: Vec::new(),
        }
        .identified()
    }

    fn entry(second: i64, event: Event) -> Entry {
        Entry {
            at: at(second),
            by: "ta".to_owned(),
            event,
        }
    }

    fn graded(hand_in: &HandIn, record: &str) -> Event {
        Event::Graded(Graded {
            hand_in: hand_in.id.clone(),
            record: record.to_owned(),
            points: None,
            why: None,
        })
    }

    #[test]
    fn attempts_are_in_the_order_of_the_lms_and_the_last_grade_stands() {
        let (first, second) = (hand_in(Some(5), "aa"), hand_in(Some(9), "bb"));
        let student = first.student.clone();
        let history = History::of([
            entry(10, Event::HandIn(Box::new(second.clone()))),
            entry(11, Event::HandIn(Box::new(first.clone()))),
            entry(12, Event::HandIn(Box::new(first.clone()))),
            entry(13, graded(&first, "k1")),
            entry(14, graded(&first, "k1")),
            entry(15, graded(&first, "k2")),
            entry(16, graded(&hand_in(None, "cc"), "k3")),
        ]);
        let attempts = history.attempts("01", &student);
        assert_eq!(attempts.len(), 2);
        assert_eq!(attempts[0].hand_in, first);
        assert_eq!(attempts[0].record(), Some("k2"));
        assert_eq!(attempts[0].grades.len(), 2);
        assert_eq!(attempts[1].record(), None);
        assert!(history.knows(&second.id) && !history.knows("x"));
        assert_eq!(history.of_lab("02").count(), 0);
    }
}
