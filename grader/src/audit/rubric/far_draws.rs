//! Hidden numbers of quite another size than the visible ones, mostly another unit, and of the other sign.

use kinemark_sim::text::Dimension;
use kinemark_sim::text::number::short;

use super::{Doubt, Rubric};
use crate::lab::TaskWork;
use crate::task::model::{Case, Given};

/// Sizes that differ by more than this are another unit: degrees for radians are 57.
const FAR: f64 = 20.0;

/// Numbers of hidden runs whose sign is never that of the visible run, nor of any student's: a lost minus.
pub(super) fn signs(rubric: &Rubric<'_>, doubts: &mut Vec<Doubt>) {
    for task in &rubric.lab.tasks {
        let runs = rubric.staff.runs(&task.name);
        let mut classes: Vec<&str> = runs.iter().map(|run| run.class.as_str()).collect();
        classes.dedup();
        for class in classes {
            let of_class = runs.iter().filter(|run| run.class == class);
            let drawn: Vec<_> = of_class.map(|run| &run.drawn).collect();
            let names = drawn.iter().take(1).flat_map(|drawn| drawn.iter());
            for name in names.map(|(name, _)| name) {
                let own = rubric.lab.parameters.get(name).map(numbers);
                let own = own.unwrap_or_default();
                let values: Vec<Vec<f64>> = drawn
                    .iter()
                    .flat_map(|drawn| drawn.iter())
                    .filter(|(known, _)| known == name)
                    .map(|(_, value)| numbers(value))
                    .collect();
                // of about its size, and all of the other sign
                let is_turned = |i: usize, own: f64| {
                    let mut values = values.iter().filter_map(|value| value.get(i));
                    values.all(|x| x * own < 0.0 && x.abs() > 0.5 * own.abs())
                };
                let turned: Vec<usize> =
                    (0..own.len()).filter(|i| is_turned(*i, own[*i])).collect();
                // where all of a list is turned, that may be what the class is about
                let [entry] = turned[..] else { continue };
                if own.len() < 2 {
                    continue;
                }
                doubts.push(Doubt {
                    rule: "hidden",
                    of: format!("{}/{class}", task.name),
                    what: format!(
                        "`{name}[{entry}]` is {} in lab.toml, and of the other sign in every run: is a minus missing?",
                        short(own[entry])
                    ),
                    help: "draw numbers about those of lab.toml, or accept it with the reason"
                        .to_owned(),
                });
            }
        }
    }
}

fn numbers(value: &Dimension) -> Vec<f64> {
    match value {
        Dimension::Number(number) => vec![*number],
        Dimension::List(numbers) => numbers.clone(),
        Dimension::Text(_) => Vec::new(),
    }
}

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
