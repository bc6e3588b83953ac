//! Checks that nobody loses, and checks that are earned for nothing: by the starter, or by a submission that answers zeros.

use super::{Doubt, Rubric};
use crate::lab::{Lab, TaskWork};
use crate::record::grade::{CheckGrade, Grade, Outcome, TaskGrade};
use crate::record::quantity::{points, with_unit};
use crate::task::entry::Entry;
use crate::task::model::{Function, FunctionTask, Given};
use crate::task::pose::PoseForm;
use crate::task::quantity::Quantity;
use crate::task::task_joints::TaskJoints;

/// Less than this share of a check's points is luck: zeros are near the answer of some case.
const LUCK: f64 = 0.05;

/// Who lost in which check.
pub(super) struct Losses<'a> {
    rubric: &'a Rubric<'a>,
}

impl<'a> Losses<'a> {
    pub(super) fn of(rubric: &'a Rubric<'a>) -> Self {
        Self { rubric }
    }

    /// The grades of this check, of all who were judged in it and should lose.
    fn of_check(&self, task: &str, check: &str) -> impl Iterator<Item = &'a CheckGrade> {
        let grades = self.rubric.starter.into_iter();
        let grades = grades.chain(self.rubric.zeros).chain(self.rubric.mutants);
        grades.filter_map(move |grade| check_of(grade, task, check))
    }
}

fn check_of<'g>(grade: &'g Grade, task: &str, check: &str) -> Option<&'g CheckGrade> {
    let task: &TaskGrade = grade.tasks.iter().find(|known| known.name == task)?;
    task.checks.iter().find(|known| known.name == check)
}

/// Whether points were lost in a value that was judged: what a hidden run did not come to shows nothing of the check.
fn is_lost(grade: &CheckGrade) -> bool {
    let is_less = matches!(grade.outcome, Outcome::Partial | Outcome::None);
    is_less && (grade.evidence.is_empty() || grade.evidence.iter().any(|fact| !fact.is_note))
}

/// Checks in which neither the starter, nor a submission of zeros, nor any mutant loses a point.
pub(super) fn dead(rubric: &Rubric<'_>, doubts: &mut Vec<Doubt>) {
    // then nobody has tried to lose
    if rubric.starter.is_none() && rubric.zeros.is_none() && rubric.mutants.is_empty() {
        return;
    }
    let losses = rubric.losses();
    // where the solution stops, nobody is judged: that is the problem
    let mut graded = rubric.graded_tasks();
    let stopped: Vec<&str> = graded
        .by_ref()
        .filter(|(_, grade)| grade.stopped.is_some())
        .map(|(task, _)| task.name.as_str())
        .collect();
    let tasks = rubric.lab.tasks.iter();
    for task in tasks.filter(|task| !stopped.contains(&task.name.as_str())) {
        for check in task.checks() {
            let mut grades = losses.of_check(&task.name, &check.name);
            if grades.any(is_lost) {
                continue;
            }
            doubts.push(Doubt {
                rule: "dead",
                of: format!("{}/{}", task.name, check.name),
                what: "neither the starter nor any mutant loses a point in it".to_owned(),
                help: "add a mutant that loses here, or narrow the band, or remove the check"
                    .to_owned(),
            });
        }
    }
}

/// Whoever loses most of a check should lose at least this share of its points: less is noticed by nobody.
const HARDLY: f64 = 0.15;

/// Checks in which everybody who is judged loses next to nothing: the band reaches far beyond what anybody does.
pub(super) fn hardly(rubric: &Rubric<'_>, doubts: &mut Vec<Doubt>) {
    let losses = rubric.losses();
    for task in &rubric.lab.tasks {
        for check in task.checks() {
            let lost = losses
                .of_check(&task.name, &check.name)
                .filter(|grade| is_lost(grade))
                .map(|grade| 1.0 - grade.points / grade.max_points);
            let Some(most) = lost.reduce(f64::max).filter(|most| *most < HARDLY) else {
                continue;
            };
            doubts.push(Doubt {
                rule: "dead",
                of: format!("{}/{}", task.name, check.name),
                what: format!(
                    "who loses most of it, of the starter and all mutants, loses {} of its points",
                    with_unit(most, "")
                ),
                help: "move `zero` nearer to `full`, or add a mutant that loses more".to_owned(),
            });
        }
    }
}

/// Checks in which the starter, or a submission of zeros, earns something.
pub(super) fn free(rubric: &Rubric<'_>, doubts: &mut Vec<Doubt>) {
    let tried = [
        ("the starter", rubric.starter),
        ("a submission that answers zeros", rubric.zeros),
    ];
    for task in &rubric.lab.tasks {
        for check in task.checks() {
            let earned = tried.iter().find_map(|(who, grade)| {
                let grade = check_of((*grade)?, &task.name, &check.name)?;
                (grade.points > LUCK * check.points).then_some((who, grade.points))
            });
            if let Some((who, earned)) = earned {
                doubts.push(Doubt {
                    rule: "free",
                    of: format!("{}/{}", task.name, check.name),
                    what: format!(
                        "{who} earns {} of {} points in it",
                        points(earned),
                        points(check.points)
                    ),
                    help: "let it need a check that is not earned for nothing".to_owned(),
                });
            }
        }
    }
}

/// A submission that answers zeros to everything, in the shapes that the tasks of `lab` ask for.
pub fn zeros(lab: &Lab) -> String {
    let mut text = String::new();
    let mut defined: Vec<&str> = Vec::new();
    for task in &lab.tasks {
        let lab = lab.of_task(task);
        let (name, arguments, answer) = match &task.work {
            TaskWork::Motion(..) => ("control", "observation".to_owned(), list(lab.robot.n())),
            TaskWork::Function(function, _) => {
                let (arguments, answer) = zeros_of(lab, function);
                (function.name(), arguments, answer)
            }
        };
        if !defined.contains(&name) {
            defined.push(name);
            text += &format!("fn {name}({arguments}) {{ {answer} }}\n");
        }
    }
    text
}

/// The parameters of a function, and an answer of zeros.
fn zeros_of(lab: &Lab, task: &FunctionTask) -> (String, String) {
    let joints = TaskJoints::of(&lab.robot, &task.about.ignored).count();
    let answer = match &task.function {
        Function::ForwardKinematics(PoseForm::Full) => {
            let rows = format!("{row}, {row}, {row}, [0.0, 0.0, 0.0, 1.0]", row = list(4));
            format!("[{rows}]")
        }
        Function::ForwardKinematics(form) => list(form.numbers()),
        Function::InverseKinematics(_) => format!("[{}]", list(joints)),
        Function::Jacobian(rows) => {
            let rows = vec![list(joints); rows.indices().count()];
            format!("[{}]", rows.join(", "))
        }
        Function::Quantity(Quantity::MassMatrix) => {
            format!("[{}]", vec![list(joints); joints].join(", "))
        }
        Function::Quantity(quantity) => list(quantity.count(joints)),
        Function::Free(_) => match task.cases.first().map(|case| &case.given) {
            Some(Given::Values { expected, .. }) => of_entries(expected),
            _ => "0".to_owned(),
        },
    };
    (task.parameters().join(", "), answer)
}

fn list(count: usize) -> String {
    format!("[{}]", vec!["0.0"; count].join(", "))
}

fn of_entries(entries: &[(String, Entry)]) -> String {
    let zero = |value: &Entry| match value {
        Entry::Number(_) => "0.0".to_owned(),
        Entry::List(values) => list(values.len()),
        Entry::Matrix(rows) => {
            let rows: Vec<String> = rows.iter().map(|row| list(row.len())).collect();
            format!("[{}]", rows.join(", "))
        }
    };
    match entries {
        [(name, value)] if name.is_empty() => zero(value),
        entries => {
            let entries = entries
                .iter()
                .map(|(name, value)| format!("{name}: {}", zero(value)));
            format!("#{{ {} }}", entries.collect::<Vec<_>>().join(", "))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::grade::Evidence;

    #[test]
    fn what_a_hidden_run_did_not_judge_is_no_loss_of_the_check() {
        let graded = |outcome, notes: &[bool]| CheckGrade {
            name: "time".to_owned(),
            title: "In time".to_owned(),
            outcome,
            points: 0.5,
            max_points: 1.0,
            measure: None,
            first_lost: None,
            evidence: notes
                .iter()
                .map(|is_note| Evidence {
                    is_note: *is_note,
                    ..Evidence::default()
                })
                .collect(),
            next_step: None,
            has_hints: false,
            look_first_at: None,
        };
        assert!(!is_lost(&graded(Outcome::Partial, &[true, true])));
        assert!(is_lost(&graded(Outcome::Partial, &[true, false])));
        assert!(is_lost(&graded(Outcome::None, &[])));
        assert!(!is_lost(&graded(Outcome::Full, &[false])));
        assert!(!is_lost(&graded(Outcome::NotJudged, &[false])));
    }
}
