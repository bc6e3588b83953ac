//! How everybody stands, as the index has it: for who looks into a book without its course.

use crate::index::{Index, IndexError};
use crate::standing::{Standing, Status};
use crate::student::StudentId;

/// How a student stands in a lab.
#[derive(Debug, Clone, PartialEq)]
pub struct StandingRow {
    /// The student.
    pub student: StudentId,
    /// The lab.
    pub lab: String,
    /// Where the grade is.
    pub status: Status,
    /// How many attempts there are.
    pub attempts: usize,
    /// The key of the record that counts.
    pub record: Option<String>,
    /// Points, those by hand included.
    pub points: Option<f64>,
    /// The maximum.
    pub max_points: Option<f64>,
    /// How late the attempt is that counts \[s\].
    pub late_s: Option<i64>,
    /// Whether points by hand were decided on another record.
    pub has_stale_fix: bool,
    /// Whether it is a module of which no source was handed in.
    pub is_without_sources: bool,
    /// Whether the simulation of a run of the record that counts is not accurate to the end.
    pub is_under_resolved: bool,
}

impl From<&Standing> for StandingRow {
    fn from(standing: &Standing) -> Self {
        Self {
            student: standing.student.clone(),
            lab: standing.lab.clone(),
            status: standing.status,
            attempts: standing.attempts,
            record: standing.record.clone(),
            points: standing.points,
            max_points: standing.max_points,
            late_s: standing.late_s,
            has_stale_fix: standing.by_hand.iter().any(|fix| fix.is_stale),
            is_without_sources: standing.is_without_sources,
            is_under_resolved: standing.is_under_resolved,
        }
    }
}

/// Every row, in the order in which it was written: labs as the course has them, students as the roster has them.
///
/// # Errors
/// An index that cannot be read.
pub fn standing_rows(index: &Index) -> Result<Vec<StandingRow>, IndexError> {
    let query = "SELECT student, lab, status, attempts, record, points, max_points, late_s, has_stale_fix, is_without_sources, is_under_resolved \
        FROM standings ORDER BY rowid";
    let rows = index.rows(query, [], |row| {
        let (student, status): (String, String) = (row.get(0)?, row.get(2)?);
        let attempts: i64 = row.get(3)?;
        let (student, status) = (StudentId::new(&student).ok(), Status::named(&status));
        let (Some(student), Some(status)) = (student, status) else {
            // written by a later version
            return Ok(None);
        };
        Ok(Some(StandingRow {
            student,
            lab: row.get(1)?,
            status,
            attempts: usize::try_from(attempts).unwrap_or_default(),
            record: row.get(4)?,
            points: row.get(5)?,
            max_points: row.get(6)?,
            late_s: row.get(7)?,
            has_stale_fix: row.get(8)?,
            is_without_sources: row.get(9)?,
            is_under_resolved: row.get(10)?,
        }))
    })?;
    Ok(rows.into_iter().flatten().collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::made_up_class::{MadeUpClass, MadeUpStudent, check, task};

    #[test]
    fn rows_come_back_as_they_were_written() {
        let fk = |points| vec![task("fk", "a", vec![check("position", points, 4.0, 0.02)])];
        let mut class = MadeUpClass::of(&[
            MadeUpStudent::new("s2", fk(1.0)),
            MadeUpStudent::new("s1", fk(4.0)),
            MadeUpStudent::without("s3", Status::NeedsPerson),
        ]);
        assert_eq!(standing_rows(&class.index).unwrap(), []);
        class.standings[1].is_under_resolved = true;
        class.index.put_standings(&class.standings).unwrap();
        let expected: Vec<StandingRow> = class.standings.iter().map(StandingRow::from).collect();
        assert_eq!(standing_rows(&class.index).unwrap(), expected);
    }
}
