//! The starters: that in Rhai runs, earns almost nothing, and makes no mistake yet; none in another language has the solution in it.

use kinemark_sim::text::Source;

use super::Audit;
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

impl Audit {
    /// Doubts a starter in another language that has most of the solution in that language in it.
    pub fn starter_beside_solution(&mut self, file: &str, starter: &str, solution: &str) {
        /// A shorter line is in every program.
        const TELLING: usize = 16;
        /// How lines begin that a starter has, too.
        const FRAME: [&str; 10] = [
            "#", "//", "/*", "*", "\"\"\"", "import ", "from ", "use ", "def ", "fn ",
        ];
        let lines = |text: &'_ str| -> Vec<String> {
            let lines = text
                .lines()
                .map(|line| line.trim().trim_start_matches("pub "));
            let is_own = |line: &&str| {
                line.len() >= TELLING && !FRAME.iter().any(|frame| line.starts_with(frame))
            };
            lines.filter(is_own).map(str::to_owned).collect()
        };
        let (starter, solution) = (lines(starter), lines(solution));
        let given = solution
            .iter()
            .filter(|line| starter.contains(line))
            .count();
        if given > 0 && 2 * given >= solution.len() {
            let what = format!(
                "{file} has {given} of {} lines of the reference solution",
                solution.len()
            );
            let help = "leave the functions empty, as the starter in Rhai does";
            self.add((Tried::Starter, file), None, None, Some((what, help)));
        }
    }
}
