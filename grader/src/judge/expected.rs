//! Expected answers of hidden cases: for a function of the lab's own, the reference solution is called on them.

use kinemark_sim::text::Source;

use super::opening::opening;
use crate::attempt::ended::record_of;
use crate::attempt::function;
use crate::lab::TaskWork;
use crate::lab::{Lab, Task};
use crate::submission::answer::named_entries;
use crate::submission::handed_in::Submission;
use crate::task::model::{Case, Function, Given};
use crate::task::value::Value;

/// What `solution` answers in the visible cases of `task`, where that is a function of the lab's own; else nothing.
///
/// # Errors
/// The reason why the solution has no answer, in words.
pub fn answers_of(lab: &Lab, task: &Task, solution: &Source) -> Result<Vec<Value>, String> {
    let TaskWork::Function(work, _) = &task.work else {
        return Ok(Vec::new());
    };
    let opening = opening(lab, task, &Submission::from(solution));
    function::answers(lab.of_task(task).workcell(), work, &work.cases, &opening)
        .map_err(|stop| record_of(&stop, solution.text()).message)
}

/// `cases` of `task` with their expected entries, in the form of the visible cases.
///
/// # Errors
/// The reason why the solution has no answer, in words.
pub fn with_expected(
    lab: &Lab,
    task: &Task,
    cases: &[Case],
    solution: &Source,
) -> Result<Vec<Case>, String> {
    let mut cases = cases.to_vec();
    let TaskWork::Function(work, _) = &task.work else {
        return Ok(cases);
    };
    if !matches!(work.function, Function::Free(_)) {
        return Ok(cases);
    }
    let Some(Given::Values {
        expected: names, ..
    }) = work.cases.first().map(|case| &case.given)
    else {
        return Ok(cases);
    };
    let opening = opening(lab, task, &Submission::from(solution));
    let answers = function::answers(lab.of_task(task).workcell(), work, &cases, &opening)
        .map_err(|stop| record_of(&stop, solution.text()).message)?;
    for (case, answer) in cases.iter_mut().zip(answers) {
        if let Given::Values { expected, .. } = &mut case.given {
            *expected = named_entries(&answer, names)
                .map_err(|what| format!("`{}` of the solution returned {what}", work.name()))?;
        }
    }
    Ok(cases)
}
