//! Where the reference solution lost points among many draws or variants: each distinct problem is said once.

use super::Audit;
use super::form::Form;
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
/// its first place and the count.
pub(super) fn distinct(lost: Vec<Lost>, words: impl Fn(&Lost, usize) -> String) -> Vec<Problem> {
    let mut groups: Vec<(Lost, Vec<String>)> = Vec::new();
    for lost in lost {
        let is_same = |group: &&mut (Lost, Vec<String>)| group.0.problem.key == lost.problem.key;
        match groups.iter_mut().find(is_same) {
            Some((_, places)) => places.push(lost.of),
            None => {
                let places = vec![lost.of.clone()];
                groups.push((lost, places));
            }
        }
    }
    let problems = groups.into_iter().map(|(first, places)| Problem {
        what: words(&first, places.len()),
        shows_in: places,
        ..first.problem
    });
    problems.collect()
}

impl Audit {
    /// Records the results of other draws of the hidden numbers.
    pub fn draws(&mut self, tried: Draws) {
        if tried.count == 0 {
            return;
        }
        let count = tried.count;
        let problems = distinct(tried.lost, |first, places| {
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
        let found = distinct(all, |first, places| {
            format!("{places}, {}: {}", first.of, first.problem.what)
        });
        let words: Vec<&str> = found.iter().map(|problem| &problem.what[..]).collect();
        assert_eq!(words, ["2, draw 3: off by 2 mm", "1, draw 4: off by 9 mm"]);
        assert_eq!(found[0].shows_in, ["draw 3", "draw 7"]);
    }
}
