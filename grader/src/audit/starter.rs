//! The starter: it runs, earns almost nothing, and makes no mistake yet.

use kinemark_sim::text::Source;

use super::form::{Form, Found};
use super::reference::stop_problem;
use super::row::{Problem, Row, Tried};
use crate::judge::Examined;
use crate::record::quantity::points;
use crate::record::verdict::Verdict;

/// The share of a lab's points that a starter may earn, for a warm-up task that it solves.
pub const MOST_STARTER_SHARE: f64 = 0.1;

impl Form<'_> {
    /// Tries the starter: it must run, earn almost nothing, and be diagnosed with no mistake.
    pub fn starter(&self, starter: &Source) -> Found {
        let (lab, staff) = (self.lab, self.staff);
        let Some(Examined { graded, .. }) = self.examined(starter) else {
            return Found::default();
        };
        let grade = graded.grade;
        let failed = grade
            .tasks
            .iter()
            .find(|task| !matches!(task.verdict, Verdict::Passed | Verdict::Missed));
        let most = MOST_STARTER_SHARE * grade.max_points;
        let named = grade.tasks.iter().find(|task| !task.diagnoses.is_empty());
        let problem = if let Some(task) = failed {
            let help = "a starter runs as it is, and misses";
            let problem = stop_problem(lab, staff, task, starter, help);
            let what = format!("task `{}`: {}", task.name, problem.what);
            Some(Problem { what, ..problem })
        } else if grade.points > most {
            let what = format!(
                "{} points for nothing done, and at most {} may be",
                points(grade.points),
                points(most)
            );
            let help = "let the checks that it passes need one that it fails";
            Some(Problem::from((what, help)))
        } else {
            named.map(|task| {
                let found = &task.diagnoses[0];
                let what = format!(
                    "task `{}` is diagnosed with the mistake `{}`: it does the same in {} of {} places where that shows",
                    task.name, found.mistake, found.agreeing, found.telling
                );
                Problem::from((
                    what,
                    "a starter makes no mistake yet: change it or the mutant",
                ))
            })
        };
        let earned = Some((grade.points, grade.max_points));
        let row = Row::new((Tried::Starter, ""), None, earned, problem);
        Found {
            rows: vec![row],
            grade: Some(grade),
        }
    }
}
