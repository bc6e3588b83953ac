//! `course.sqlite`: the book as tables, for statistics, for `course status`, and for other programs. It holds nothing that is not in
//! records and journal, and is made anew whenever it is missing, damaged or of another version.
//!
//! It is written as a whole under another name and then renamed, so that no lock is needed and no reader sees half of it.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use kinemark_grader::record::grade::{CheckGrade, Grade, Outcome, TaskGrade};
use kinemark_grader::record::verdict::Verdict;
use rusqlite::{Connection, OpenFlags, Row, Transaction, params};

use crate::book::{Book, BookError, Record};
use crate::durable::{self, Readers};
use crate::history::History;
use crate::private_files::{UNFINISHED, private_folder};
use crate::standing::{Standing, Summary};

/// Its name in the book.
pub const INDEX_FILE: &str = "course.sqlite";

/// The version of the tables; docs/book.md describes them.
const SCHEMA: i64 = 3;

const TABLES: &str = include_str!("index.sql");

/// What goes wrong with the index.
#[derive(Debug, thiserror::Error)]
pub enum IndexError {
    /// A record or a folder of the book.
    #[error(transparent)]
    Book(#[from] BookError),
    /// The file of the index.
    #[error("`{}`: {why}", path.display())]
    File {
        /// The file.
        path: PathBuf,
        /// Why, in words.
        why: String,
    },
}

/// The index of a book.
#[derive(Debug)]
pub struct Index {
    connection: Connection,
    path: PathBuf,
}

impl Index {
    /// The index of `book` with everything that is in it now; `history` is its journal in the state `state`
    /// ([`crate::journal::Journal::state`]).
    ///
    /// # Errors
    /// [`IndexError`]; a damaged index is none, it is made anew.
    pub fn refresh(book: &Book, history: &History, state: &str) -> Result<Self, IndexError> {
        let path = book.root().join(INDEX_FILE);
        let keys = book.record_keys().map_err(|error| IndexError::File {
            path: book.root().join("records"),
            why: error.to_string(),
        })?;
        if let Some(index) = Self::existing(&path) {
            if index.is_current(state, &keys) {
                return Ok(index);
            }
            if let Ok(index) = index.renewed(book, history, state, &keys) {
                return Ok(index);
            }
        }
        let empty = Self {
            connection: memory(&path)?,
            path,
        };
        empty.renewed(book, history, state, &keys)
    }

    /// The index that a book has, as it is: what was written since its last command is not in it. None where there is none, or one
    /// that is damaged or of another version.
    pub fn of(book: &Path) -> Option<Self> {
        Self::existing(&book.join(INDEX_FILE))
    }

    /// The index that is there, if it is whole and of this version.
    fn existing(path: &Path) -> Option<Self> {
        let flags = OpenFlags::SQLITE_OPEN_READ_ONLY | OpenFlags::SQLITE_OPEN_URI;
        let connection = Connection::open_with_flags(uri(path), flags).ok()?;
        let schema: i64 = connection
            .query_row("PRAGMA user_version", [], |row| row.get(0))
            .ok()?;
        let sound: String = connection
            .query_row("PRAGMA quick_check(1)", [], |row| row.get(0))
            .ok()?;
        (schema == SCHEMA && sound == "ok").then(|| Self {
            connection,
            path: path.to_owned(),
        })
    }

    fn is_current(&self, state: &str, keys: &[String]) -> bool {
        let known: Result<String, _> =
            self.connection
                .query_row("SELECT value FROM meta WHERE name = 'state'", [], |row| {
                    row.get(0)
                });
        known.is_ok_and(|known| known == state)
            && self.keys().is_ok_and(|known| known.iter().eq(keys))
    }

    fn keys(&self) -> rusqlite::Result<BTreeSet<String>> {
        let mut query = self.connection.prepare("SELECT key FROM records")?;
        let keys = query.query_map([], |row| row.get(0))?;
        keys.collect()
    }

    /// A copy with what is missing, put in place of this one.
    fn renewed(
        self,
        book: &Book,
        history: &History,
        state: &str,
        keys: &[String],
    ) -> Result<Self, IndexError> {
        let path = self.path.clone();
        let failed = |error: rusqlite::Error| IndexError::File {
            path: path.clone(),
            why: error.to_string(),
        };
        let mut fresh = memory(&path)?;
        copy(&self.connection, &mut fresh).map_err(failed)?;
        let known = self.keys().unwrap_or_default();
        let change = fresh.transaction().map_err(failed)?;
        let there: BTreeSet<&String> = keys.iter().collect();
        for gone in known.iter().filter(|key| !there.contains(key)) {
            remove(&change, gone).map_err(failed)?;
        }
        for key in keys.iter().filter(|key| !known.contains(*key)) {
            // a damaged one is not there
            if let Some(record) = book.record(key)? {
                add(&change, &record).map_err(failed)?;
            }
        }
        write_history(&change, history).map_err(failed)?;
        change
            .execute(
                "INSERT OR REPLACE INTO meta VALUES ('state', ?1)",
                params![state],
            )
            .map_err(failed)?;
        change.commit().map_err(failed)?;
        let index = Self {
            connection: fresh,
            path: path.clone(),
        };
        index.put_in_place()?;
        Ok(index)
    }

    /// Writes it to its place in the book, whole.
    fn put_in_place(&self) -> Result<(), IndexError> {
        let failed = |why: String| IndexError::File {
            path: self.path.clone(),
            why,
        };
        let folder = durable::parent(&self.path);
        private_folder(folder).map_err(|error| failed(error.to_string()))?;
        let file = Readers::Owner
            .temporary_file()
            .prefix(UNFINISHED)
            .tempfile_in(folder)
            .map_err(|error| failed(error.to_string()))?;
        let mut disk = Connection::open_with_flags(
            uri(file.path()),
            OpenFlags::SQLITE_OPEN_READ_WRITE | OpenFlags::SQLITE_OPEN_URI,
        )
        .map_err(|error| failed(error.to_string()))?;
        copy(&self.connection, &mut disk).map_err(|error| failed(error.to_string()))?;
        drop(disk);
        durable::put_in_place(file, &self.path).map_err(|error| failed(error.to_string()))
    }

    /// Writes how everybody stands, for whoever queries the file.
    ///
    /// # Errors
    /// A full disk.
    pub fn put_standings(&mut self, standings: &[Standing]) -> Result<(), IndexError> {
        let path = self.path.clone();
        let failed = |error: rusqlite::Error| IndexError::File {
            path: path.clone(),
            why: error.to_string(),
        };
        let digest = digest_of(standings);
        let known: Option<String> = self
            .connection
            .query_row(
                "SELECT value FROM meta WHERE name = 'standings'",
                [],
                |row| row.get(0),
            )
            .ok();
        if known.as_deref() == Some(digest.as_str()) {
            return Ok(());
        }
        let mut fresh = memory(&path)?;
        copy(&self.connection, &mut fresh).map_err(failed)?;
        let change = fresh.transaction().map_err(failed)?;
        write_standings(&change, standings, &digest).map_err(failed)?;
        change.commit().map_err(failed)?;
        self.connection = fresh;
        self.put_in_place()
    }

    /// What is known of the records of a lab, by key.
    ///
    /// # Errors
    /// An index that cannot be read.
    pub fn summaries(&self, lab: &str) -> Result<BTreeMap<String, Summary>, IndexError> {
        self.read_summaries(lab)
            .map_err(|error| self.failed(&error))
    }

    /// The rows of a query, each made by `read`.
    pub(crate) fn rows<T>(
        &self,
        query: &str,
        params: impl rusqlite::Params,
        read: impl FnMut(&Row<'_>) -> rusqlite::Result<T>,
    ) -> Result<Vec<T>, IndexError> {
        let rows = || -> rusqlite::Result<Vec<T>> {
            let mut query = self.connection.prepare(query)?;
            query.query_map(params, read)?.collect()
        };
        rows().map_err(|error| self.failed(&error))
    }

    fn failed(&self, error: &rusqlite::Error) -> IndexError {
        IndexError::File {
            path: self.path.clone(),
            why: error.to_string(),
        }
    }

    fn read_summaries(&self, lab: &str) -> rusqlite::Result<BTreeMap<String, Summary>> {
        let mut summaries = BTreeMap::new();
        let mut query = self.connection.prepare(
            "SELECT key, verdict, points, max_points, engine, lab_version, staff_version, is_under_resolved FROM records WHERE lab = ?1",
        )?;
        let mut rows = query.query(params![lab])?;
        while let Some(row) = rows.next()? {
            let verdict: String = row.get(1)?;
            let key: String = row.get(0)?;
            let summary = Summary {
                verdict: Verdict::named(&verdict).unwrap_or(Verdict::GraderFault),
                points: row.get(2)?,
                max_points: row.get(3)?,
                engine: row.get(4)?,
                lab_version: row.get(5)?,
                staff_version: row.get(6)?,
                is_under_resolved: row.get(7)?,
                checks: Vec::new(),
            };
            summaries.insert(key, summary);
        }
        let mut query = self.connection.prepare(
            "SELECT record, task || '/' || name, points FROM checks WHERE record IN \
             (SELECT key FROM records WHERE lab = ?1) ORDER BY record, place",
        )?;
        let mut rows = query.query(params![lab])?;
        while let Some(row) = rows.next()? {
            let key: String = row.get(0)?;
            if let Some(summary) = summaries.get_mut(&key) {
                summary.checks.push((row.get(1)?, row.get(2)?));
            }
        }
        Ok(summaries)
    }

    /// The tables, to query.
    pub fn connection(&self) -> &Connection {
        &self.connection
    }
}

/// A digest of how everybody stands.
fn digest_of(standings: &[Standing]) -> String {
    // plain values: they always have a JSON form
    let text = serde_json::to_vec(standings).unwrap_or_default();
    blake3::hash(&text).to_hex().to_string()
}

/// A path for SQLite that takes no lock: the file is only ever read whole, or replaced.
fn uri(path: &Path) -> String {
    let mut uri = "file:".to_owned();
    for byte in path.to_string_lossy().bytes() {
        match byte {
            b'/' | b'-' | b'_' | b'.' | b':' => uri.push(char::from(byte)),
            byte if byte.is_ascii_alphanumeric() => uri.push(char::from(byte)),
            b'\\' if cfg!(windows) => uri.push('/'),
            byte => uri += &format!("%{byte:02X}"),
        }
    }
    uri + "?nolock=1"
}

fn memory(path: &Path) -> Result<Connection, IndexError> {
    let made = Connection::open_in_memory().and_then(|connection| {
        connection.execute_batch(TABLES)?;
        connection.pragma_update(None, "user_version", SCHEMA)?;
        Ok(connection)
    });
    made.map_err(|error| IndexError::File {
        path: path.to_owned(),
        why: error.to_string(),
    })
}

/// Copies a whole database.
fn copy(from: &Connection, to: &mut Connection) -> rusqlite::Result<()> {
    let backup = rusqlite::backup::Backup::new(from, to)?;
    match backup.step(-1)? {
        rusqlite::backup::StepResult::Done => Ok(()),
        _ => Err(rusqlite::Error::InvalidQuery),
    }
}

fn remove(change: &Transaction<'_>, key: &str) -> rusqlite::Result<()> {
    for table in ["mistakes", "checks", "tasks"] {
        change.execute(&format!("DELETE FROM {table} WHERE record = ?1"), [key])?;
    }
    change.execute("DELETE FROM records WHERE key = ?1", [key])?;
    Ok(())
}

fn add(change: &Transaction<'_>, record: &Record) -> rusqlite::Result<()> {
    let Record {
        key, inputs, grade, ..
    } = record;
    change
        .prepare_cached(
            "INSERT INTO records VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9, ?10, ?11)",
        )?
        .execute(params![
            key,
            inputs.lab_name,
            inputs.submission,
            inputs.engine,
            inputs.lab_version,
            inputs.staff_version,
            inputs.variant_of,
            grade.verdict.name(),
            grade.points,
            grade.max_points,
            grade.is_under_resolved(),
        ])?;
    add_tasks(change, key, grade)
}

fn add_tasks(change: &Transaction<'_>, key: &str, grade: &Grade) -> rusqlite::Result<()> {
    for (place, task) in grade.tasks.iter().enumerate() {
        change
            .prepare_cached("INSERT INTO tasks VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9)")?
            .execute(params![
                key,
                place as i64,
                task.name,
                task.title,
                task.verdict.name(),
                task.points,
                task.max_points,
                task.operations as i64,
                task.digests.all,
            ])?;
        for (place, check) in task.checks.iter().enumerate() {
            add_check(change, key, place, task, check)?;
        }
        for diagnosis in &task.diagnoses {
            change
                .prepare_cached("INSERT INTO mistakes VALUES (?1, ?2, ?3, ?4)")?
                .execute(params![key, task.name, diagnosis.mistake, diagnosis.says])?;
        }
    }
    Ok(())
}

fn add_check(
    change: &Transaction<'_>,
    key: &str,
    place: usize,
    task: &TaskGrade,
    check: &CheckGrade,
) -> rusqlite::Result<()> {
    let measure = check.measure.as_ref();
    let outcome = match check.outcome {
        Outcome::Full => "full",
        Outcome::Partial => "partial",
        Outcome::None => "none",
        Outcome::NotJudged => "not-judged",
        Outcome::AtHandIn => "at-hand-in",
    };
    // evidence that names a class is about hidden cases or runs
    let classes: Vec<&str> = task
        .hidden
        .iter()
        .map(|class| class.class.as_str())
        .collect();
    let is_hidden =
        |case: &Option<String>| case.as_deref().is_some_and(|case| classes.contains(&case));
    let only_hidden =
        !check.evidence.is_empty() && check.evidence.iter().all(|fact| is_hidden(&fact.case));
    change
        .prepare_cached(
            "INSERT INTO checks VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9, ?10, ?11, ?12, ?13, ?14, ?15)",
        )?
        .execute(params![
            key,
            task.name,
            place as i64,
            check.name,
            check.title,
            outcome,
            check.points,
            check.max_points,
            measure.map(|measure| measure.quantity.as_str()),
            measure.and_then(|measure| measure.value),
            measure.map(|measure| measure.unit.as_str()),
            measure.map(|measure| measure.full),
            measure.map(|measure| measure.zero),
            check.first_lost.map(|instant| instant.time_s),
            only_hidden,
        ])?;
    Ok(())
}

fn write_history(change: &Transaction<'_>, history: &History) -> rusqlite::Result<()> {
    change.execute_batch("DELETE FROM grades; DELETE FROM hand_ins;")?;
    for (lab, student, attempts) in history.all() {
        for (number, attempt) in attempts.iter().enumerate() {
            let hand_in = &attempt.hand_in;
            change
                .prepare_cached("INSERT INTO hand_ins VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9)")?
                .execute(params![
                    hand_in.id,
                    student.as_str(),
                    lab,
                    number as i64 + 1,
                    hand_in.submission,
                    attempt.read_at.to_string(),
                    hand_in.submitted_at.map(|at| at.to_string()),
                    hand_in.matched_by,
                    attempt
                        .failure
                        .as_ref()
                        .map(|failure| failure.what.as_str()),
                ])?;
            for grade in &attempt.grades {
                change
                    .prepare_cached("INSERT INTO grades VALUES (?1, ?2, ?3, ?4, ?5)")?
                    .execute(params![
                        hand_in.id,
                        grade.record,
                        grade.at.to_string(),
                        grade.by,
                        grade.why,
                    ])?;
            }
        }
    }
    Ok(())
}

fn write_standings(
    change: &Transaction<'_>,
    standings: &[Standing],
    digest: &str,
) -> rusqlite::Result<()> {
    change.execute_batch("DELETE FROM standings;")?;
    for standing in standings {
        change
            .prepare_cached(
                "INSERT INTO standings VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9, ?10, ?11, ?12, ?13)",
            )?
            .execute(params![
                standing.student.as_str(),
                standing.lab,
                standing.status.name(),
                standing.attempts as i64,
                standing.attempt.map(|attempt| attempt as i64),
                standing.record,
                standing.record_points,
                standing.points,
                standing.max_points,
                standing.late_s,
                standing.by_hand.iter().any(|fix| fix.is_stale),
                standing.is_without_sources,
                standing.is_under_resolved,
            ])?;
    }
    change.execute(
        "INSERT OR REPLACE INTO meta VALUES ('standings', ?1)",
        params![digest],
    )?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use kinemark_grader::record::grade::{EventRecord, HiddenClass};
    use kinemark_grader::record::sample;

    use super::*;
    use crate::book::Inputs;
    use crate::journal::{Event, Graded, HandIn};
    use crate::student::StudentId;

    fn record(submission: &str) -> Record {
        let text = str::to_owned;
        let inputs = Inputs {
            engine: text("kinemark 0.1.0"),
            lab_name: text("01"),
            lab: text("l"),
            robot: text("r"),
            scenes: Vec::new(),
            staff: None,
            variant_of: None,
            file: text("submission.rhai"),
            submission: text(submission),
            sources: None,
            lab_version: text("v"),
            staff_version: None,
        };
        Record::new(inputs, sample::graded().grade)
    }

    fn book_with(records: &[&Record]) -> (tempfile::TempDir, Book) {
        let bed = tempfile::tempdir().unwrap();
        // a name that a URI has to escape
        let book = Book::new(&bed.path().join("my book? #1 %41"));
        for record in records {
            book.put_record(record).unwrap();
        }
        (bed, book)
    }

    #[test]
    fn the_index_follows_the_book() {
        let (one, two) = (record("aa"), record("bb"));
        let (_bed, book) = book_with(&[&one]);
        let history = History::default();
        let index = Index::refresh(&book, &history, "1").unwrap();
        let summaries = index.summaries("01").unwrap();
        let summary = &summaries[&one.key];
        assert_eq!(summary.points, one.grade.points);
        let checks: usize = one.grade.tasks.iter().map(|task| task.checks.len()).sum();
        assert_eq!(summary.checks.len(), checks);
        assert!(!summary.is_under_resolved);
        book.put_record(&two).unwrap();
        let index = Index::refresh(&book, &history, "1").unwrap();
        assert_eq!(index.summaries("01").unwrap().len(), 2);
        assert!(index.summaries("02").unwrap().is_empty());
        std::fs::remove_file(
            book.root()
                .join("records")
                .join(&one.key[..2])
                .join(format!("{}.json", one.key)),
        )
        .unwrap();
        let index = Index::refresh(&book, &history, "1").unwrap();
        assert_eq!(index.summaries("01").unwrap().len(), 1);
    }

    #[test]
    fn a_damaged_index_is_made_anew() {
        let one = record("aa");
        let (_bed, book) = book_with(&[&one]);
        let path = book.root().join(INDEX_FILE);
        let history = History::default();
        Index::refresh(&book, &history, "1").unwrap();
        let whole = std::fs::read(&path).unwrap();
        for damage in [
            b"garbage".to_vec(),
            Vec::new(),
            whole[..whole.len() / 2].to_vec(),
        ] {
            std::fs::write(&path, damage).unwrap();
            let index = Index::refresh(&book, &history, "1").unwrap();
            assert_eq!(index.summaries("01").unwrap().len(), 1);
            assert!(Index::existing(&path).is_some());
        }
    }

    /// Whoever has it open and locked stands in nobody's way.
    #[test]
    fn no_lock_is_asked_for() {
        let (one, two) = (record("aa"), record("bb"));
        let (_bed, book) = book_with(&[&one]);
        let history = History::default();
        Index::refresh(&book, &history, "1").unwrap();
        let other = Connection::open(book.root().join(INDEX_FILE)).unwrap();
        other.execute_batch("BEGIN EXCLUSIVE").unwrap();
        assert!(Index::refresh(&book, &history, "1").is_ok());
        book.put_record(&two).unwrap();
        let mut index = Index::refresh(&book, &history, "2").unwrap();
        index.put_standings(&[]).unwrap();
        assert_eq!(index.summaries("01").unwrap().len(), 2);
        let keys = "SELECT count(*) FROM records";
        let seen: i64 = other.query_row(keys, [], |row| row.get(0)).unwrap();
        assert_eq!(seen, 1, "a reader keeps what it opened");
    }

    #[test]
    fn a_run_that_is_not_resolved_is_known_of_its_record() {
        let (accurate, mut hidden, mut visible) = (record("aa"), record("bb"), record("cc"));
        let task = &mut hidden.grade.tasks[0];
        task.hidden.push(HiddenClass {
            class: "far".to_owned(),
            good: 2,
            total: 2,
            under_resolved: 1,
        });
        let event = EventRecord {
            tick: 5,
            time_s: 0.005,
            event: "under-resolved".to_owned(),
            message: "`elbow` turns too fast".to_owned(),
        };
        visible.grade.tasks[0].events.push(event);
        let (_bed, book) = book_with(&[&accurate, &hidden, &visible]);
        let index = Index::refresh(&book, &History::default(), "1").unwrap();
        let summaries = index.summaries("01").unwrap();
        let known = [&accurate, &hidden, &visible].map(|one| summaries[&one.key].is_under_resolved);
        assert_eq!(known, [false, true, true]);
    }

    #[test]
    fn hand_ins_and_their_grades_are_rows() {
        let one = record("aa");
        let (_bed, book) = book_with(&[&one]);
        let hand_in = HandIn {
            id: String::new(),
            student: StudentId::new("s1").unwrap(),
            lab: "01".to_owned(),
            submission: "aa".to_owned(),
            file: "submission.rhai".to_owned(),
            sources: None,
            is_without_sources: false,
            matched_by: "id".to_owned(),
            submitted_at: None,
            marked_late: None,
            attempt: None,
            lms_number: None,
            variant_of: None,
            made_with: None,
            has_other_numbers: false,
            places: Vec::new(),
        }
        .identified();
        let at = jiff::Timestamp::from_second(1).unwrap();
        let entry = |event| crate::journal::Entry {
            at,
            by: "ta".to_owned(),
            event,
        };
        let graded = Graded {
            hand_in: hand_in.id.clone(),
            record: one.key.clone(),
            points: None,
            why: None,
        };
        let history = History::of([
            entry(Event::HandIn(Box::new(hand_in))),
            entry(Event::Graded(graded)),
        ]);
        let index = Index::refresh(&book, &history, "1").unwrap();
        let joined: (String, f64) = index
            .connection()
            .query_row(
                "SELECT student, points FROM hand_ins JOIN grades ON hand_in = id JOIN records ON key = record",
                [],
                |row| Ok((row.get(0)?, row.get(1)?)),
            )
            .unwrap();
        assert_eq!(joined, ("s1".to_owned(), one.grade.points));
    }
}
