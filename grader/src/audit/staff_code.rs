//! Tries the course staff's code: solution and mutants must compile, and the solution must answer the hidden cases whose expected
//! answers it defines. Loading a lab runs none of this code.

use kinemark_sim::text::{Problem, Source};

use crate::judge::staff_faults::staff_fault;
use crate::judge::{opening, with_expected};
use crate::lab::Lab;
use crate::lab::staff::Staff;
use crate::record::staff_fault::StaffSubmission;
use crate::submission::handed_in::Submission;
use crate::submission::rhai::ScriptController;
use crate::task::problem::{LabError, LoadError, problems};
use crate::task::reporter::Reporter;

problems! {
    /// What is wrong with the reference solution as the measure of hidden cases.
    enum SolutionProblem {
        NoAnswer { why: String }:
            "staff::solution", "{why}", "what is expected here is what the solution answers",
            "correct `solution.rhai`, or draw other numbers";
    }
}

/// Tries the code of `staff`, the course staff's part of `lab`.
///
/// # Errors
/// [`LoadError`] at the line of a submission that does not compile, or at the random hidden cases that the solution does not answer.
pub fn staff_code(lab: &Lab, staff: &Staff) -> Result<(), LoadError> {
    builds(lab, None, StaffSubmission::Solution, &staff.solution)?;
    answers(lab, staff)?;
    for mutant in &staff.mutants {
        let task = mutant.tasks.first().map(String::as_str);
        let whose = StaffSubmission::Mutant(mutant.name.clone());
        builds(lab, task, whose, &mutant.source)?;
    }
    Ok(())
}

/// Refuses a submission that does not compile.
fn builds(
    lab: &Lab,
    task: Option<&str>,
    whose: StaffSubmission,
    source: &Source,
) -> Result<(), LabError> {
    let mut tasks = lab.tasks.iter();
    let Some(task) = tasks.find(|known| task.is_none_or(|name| known.name == name)) else {
        return Ok(());
    };
    match ScriptController::open(&opening(lab, task, &Submission::from(source))) {
        Ok(_) => Ok(()),
        Err(stop) => match staff_fault(whose, None, source, &stop) {
            Some(fault) => Err(fault.map(|fault| Box::new(fault) as Box<dyn Problem>)),
            None => Ok(()),
        },
    }
}

/// Refuses random hidden cases to which the solution has no answer.
fn answers(lab: &Lab, staff: &Staff) -> Result<(), LabError> {
    let Some(source) = &staff.hidden_source else {
        return Ok(());
    };
    for draw in &staff.draws {
        let Some(task) = lab.tasks.iter().find(|task| task.name == draw.task) else {
            continue;
        };
        if let Err(why) = with_expected(lab, task, &draw.cases, &staff.solution) {
            let problem = SolutionProblem::NoAnswer { why };
            return Reporter { source }.refuse(draw.at.clone(), problem);
        }
    }
    Ok(())
}
