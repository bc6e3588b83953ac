//! Hidden numbers of quite another size than the visible ones: mostly another unit.

use kinemark_sim::text::number::short;

use super::{Doubt, Rubric};
use crate::lab::TaskWork;
use crate::task::model::{Case, Given};

/// Sizes that differ by more than this are another unit: degrees for radians are 57.
const FAR: f64 = 20.0;

/// Compares what each draw gives with the visible cases of its task, name by name.
pub(super) fn rule(rubric: &Rubric<'_>, doubts: &mut Vec<Doubt>) {
    for task in &rubric.lab.tasks {
        let TaskWork::Function(function, _) = &task.work else {
            continue;
        };
        let draws = rubric.staff.draws.iter();
        for draw in draws.filter(|draw| draw.task == task.name) {
            let class = draw
                .cases
                .first()
                .and_then(|case| case.hidden_class.clone());
            let far = sizes(&draw.cases).into_iter().find_map(|(name, drawn)| {
                let visible = sizes(&function.cases);
                let (_, visible) = visible.iter().find(|(known, _)| *known == name)?;
                let is_far = drawn > FAR * visible || *visible > FAR * drawn;
                (is_far && drawn > 0.0 && *visible > 0.0).then_some((name, drawn, *visible))
            });
            if let Some((name, drawn, visible)) = far {
                doubts.push(Doubt {
                    rule: "hidden",
                    of: format!("{}/{}", task.name, class.unwrap_or_default()),
                    what: format!(
                        "it draws numbers of up to {} for `{name}`, and visible cases have at most {}: is that the same unit?",
                        short(drawn),
                        short(visible)
                    ),
                    help: "draw numbers of the size of the visible ones, or show a visible case of this size"
                        .to_owned(),
                });
            }
        }
    }
}

/// The greatest size of each thing that cases give, by its name. Positions of joints and of the TCP are looked at elsewhere: against limits
/// and reach.
fn sizes(cases: &[Case]) -> Vec<(String, f64)> {
    let mut sizes: Vec<(String, f64)> = Vec::new();
    for (name, numbers) in cases.iter().flat_map(given) {
        let size = numbers.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        match sizes.iter_mut().find(|(known, _)| *known == name) {
            Some((_, known)) => *known = known.max(size),
            None => sizes.push((name, size)),
        }
    }
    sizes
}

fn given(case: &Case) -> Vec<(String, Vec<f64>)> {
    match &case.given {
        Given::Q(_) | Given::Position { .. } => Vec::new(),
        Given::Motion(rows) => {
            let names = ["q", "qd", "qdd"].into_iter().zip(rows).skip(1);
            names
                .map(|(name, row)| (name.to_owned(), row.clone()))
                .collect()
        }
        Given::Values { given, .. } => {
            let entries = given.iter();
            entries
                .map(|(name, entry)| (name.clone(), entry.numbers()))
                .collect()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::task::entry::Entry;

    #[test]
    fn the_greatest_size_of_each_name_is_found() {
        let case = |numbers: &[f64]| Case {
            name: String::new(),
            hidden_class: None,
            row: None,
            dimensions: Vec::new(),
            robot: None,
            given: Given::Values {
                given: vec![
                    ("mass".to_owned(), Entry::Number(numbers[0])),
                    ("at".to_owned(), Entry::List(numbers.to_vec())),
                ],
                expected: Vec::new(),
            },
        };
        let cases = [case(&[0.5, -3.0]), case(&[-0.7, 1.0])];
        let expected = [("mass".to_owned(), 0.7), ("at".to_owned(), 3.0)];
        assert_eq!(sizes(&cases), expected);
    }
}
