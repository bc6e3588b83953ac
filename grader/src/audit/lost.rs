//! Where the reference solution lost points among many draws or variants: each distinct problem is said once.

use super::Audit;
use super::form::Form;
use super::hidden_losses::LostDraw;
use super::row::{Problem, Row, Tried};

/// A variant, or a draw, in which the reference solution lost points.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Lost {
    /// The student or the draw.
    pub(super) of: String,
    /// The numbers, in words.
    pub(super) numbers: String,
    pub(super) problem: Problem,
}

/// The results of other draws of the hidden numbers.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Draws {
    count: u32,
    lost: Vec<Lost>,
}

impl Draws {
    /// Tries the reference solution in `form`, a draw that is called `name`.
    pub fn draw(&mut self, form: &Form<'_>, name: &str) {
        self.count += 1;
        let (_, problems) = form.solved();
        let lost = problems.into_iter().map(|problem| Lost {
            of: name.to_owned(),
            numbers: String::new(),
            problem,
        });
        self.lost.extend(lost);
    }

    /// Adds the results of other draws, which come after these.
    pub fn join(&mut self, other: Self) {
        self.count += other.count;
        self.lost.extend(other.lost);
    }
}

/// A problem for each that is distinct, in the order in which they are found first, with where it shows; `words` says that of one with
/// its first place and the count. Losses that `known` rows have said, with the same number or in the same hidden classes, are one problem
/// for each task.
pub(super) fn distinct(
    lost: Vec<Lost>,
    known: &[Row],
    words: impl Fn(&Lost, usize) -> String,
) -> Vec<Problem> {
    let mut groups: Vec<Group> = Vec::new();
    for lost in lost {
        let is_known = known.iter().any(|row| says(row, &lost.problem));
        let is_same = |group: &&mut Group| match is_known {
            true => group.is_known && group.first.problem.task == lost.problem.task,
            false => !group.is_known && group.first.problem.key == lost.problem.key,
        };
        match groups.iter_mut().find(is_same) {
            Some(group) => group.join(lost),
            None => groups.push(Group {
                places: vec![lost.of.clone()],
                checks: lost.problem.check.clone().into_iter().collect(),
                first: lost,
                is_known,
            }),
        }
    }
    groups
        .into_iter()
        .map(|group| group.problem(&words))
        .collect()
}

/// Whether a row of the solution says what a problem of a check is: in the same words of what is visible, and of the same hidden classes.
fn says(row: &Row, problem: &Problem) -> bool {
    let visible = |text: &str| text.lines().next().map(str::to_owned);
    let is_in_class = |lost: &LostDraw| {
        let mut of_row = row.hidden.iter();
        of_row.any(|known| known.draw.class == lost.draw.class)
    };
    problem.check.is_some()
        && row.tried == Tried::Reference
        && (&row.task, &row.check) == (&problem.task, &problem.check)
        && row.problem.as_deref().and_then(visible) == visible(&problem.what)
        && problem.hidden.iter().all(is_in_class)
}

/// Losses that are said together.
struct Group {
    first: Lost,
    /// The draws or students, each once.
    places: Vec<String>,
    /// The checks, each once.
    checks: Vec<String>,
    /// Whether rows before have said what is lost.
    is_known: bool,
}

impl Group {
    fn join(&mut self, lost: Lost) {
        if lost.of == self.first.of {
            self.first.problem.hidden.extend(lost.problem.hidden);
        }
        if !self.places.contains(&lost.of) {
            self.places.push(lost.of);
        }
        let check = lost.problem.check.into_iter();
        let is_new = |check: &String| !self.checks.contains(check);
        let check: Vec<String> = check.filter(is_new).collect();
        self.checks.extend(check);
    }

    fn problem(self, words: impl Fn(&Lost, usize) -> String) -> Problem {
        let mut first = self.first;
        if self.is_known {
            let task = first.problem.task.as_deref().unwrap_or_default();
            let checks: Vec<String> = self.checks.iter().map(|name| format!("`{name}`")).collect();
            first.problem.what = format!(
                "task `{task}` loses points as above, in {}",
                checks.join(", ")
            );
            // of several checks none is the one
            first.problem.check = first.problem.check.filter(|_| self.checks.len() == 1);
        }
        Problem {
            what: words(&first, self.places.len()),
            shows_in: self.places,
            ..first.problem
        }
    }
}

impl Audit {
    /// Records the results of other draws of the hidden numbers.
    pub fn draws(&mut self, tried: Draws) {
        if tried.count == 0 {
            return;
        }
        let count = tried.count;
        let problems = distinct(tried.lost, &self.rows, |first, places| {
            let (of, what) = (&first.of, &first.problem.what);
            format!("in {places} of {count}, first in {of}: {what}")
        });
        let form = format!("hidden numbers of {count} draws");
        self.rows
            .extend(Row::all((Tried::Reference, &form), None, problems));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_the_same_problem_is_said_once_with_where_it_shows() {
        let lost = |of: &str, key: &str, what: &str| Lost {
            of: of.to_owned(),
            numbers: String::new(),
            problem: Problem {
                key: key.to_owned(),
                ..Problem::from((what.to_owned(), "mend it"))
            },
        };
        let all = vec![
            lost("draw 3", "fk/position", "off by 2 mm"),
            lost("draw 4", "ik/reach", "off by 9 mm"),
            lost("draw 7", "fk/position", "off by 4 mm"),
        ];
        let found = distinct(all, &[], |first, places| {
            format!("{places}, {}: {}", first.of, first.problem.what)
        });
        let words: Vec<&str> = found.iter().map(|problem| &problem.what[..]).collect();
        assert_eq!(words, ["2, draw 3: off by 2 mm", "1, draw 4: off by 9 mm"]);
        assert_eq!(found[0].shows_in, ["draw 3", "draw 7"]);
    }

    #[test]
    fn what_rows_before_have_said_is_said_together() {
        let lost = |of: &str, check: &str| Lost {
            of: of.to_owned(),
            numbers: String::new(),
            problem: Problem {
                key: format!("knock/{check}"),
                task: Some("knock".to_owned()),
                check: Some(check.to_owned()),
                ..Problem::from((format!("{check} lost, with numbers"), "mend it"))
            },
        };
        let known = |check: &str| {
            let problem = lost("", check).problem;
            Row::new(
                (Tried::Reference, "own hidden cases"),
                None,
                None,
                Some(problem),
            )
        };
        let all = vec![
            lost("draw 1", "shelf"),
            lost("draw 1", "touch"),
            lost("draw 1", "speed"),
            lost("draw 2", "shelf"),
            lost("draw 2", "touch"),
        ];
        let found = distinct(all, &[known("shelf"), known("speed")], |first, places| {
            format!("{places}, {}: {}", first.of, first.problem.what)
        });
        let words: Vec<&str> = found.iter().map(|problem| &problem.what[..]).collect();
        assert_eq!(
            words,
            [
                "2, draw 1: task `knock` loses points as above, in `shelf`, `speed`",
                "2, draw 1: touch lost, with numbers"
            ]
        );
        assert_eq!(found[0].shows_in, ["draw 1", "draw 2"]);
        // another number of the same check is no repetition
        let mut other = lost("draw 3", "shelf");
        other.problem.what = "shelf lost, with another number".to_owned();
        let other = distinct(vec![other], &[known("shelf")], |first, _| {
            first.problem.what.clone()
        });
        assert_eq!(other[0].what, "shelf lost, with another number");
        assert_eq!(
            (&found[0].check, found[1].check.as_deref()),
            (&None, Some("touch"))
        );
    }
}
