//! The cases of a function task judged one by one: what each earns in each check, for the course staff. A record has the means alone.

use nalgebra::Vector3;

use crate::attempt::answers::{Answered, CaseFacts};
use crate::check::{Check, Finding, FunctionCheck};
use crate::lab::Lab;
use crate::task::model::{FunctionTask, Given};
use crate::task::tcp::tcp_in;

/// One case, judged by itself.
#[derive(Debug)]
pub(super) struct SingleCase {
    /// The finding of each check; `None` of a check that does not look at such a case, as one of reach at a target out of reach.
    pub(super) findings: Vec<Option<Finding>>,
    /// Of inverse kinematics: the distance of each answered branch from the target, in the order of the answer \[m\].
    pub(super) branches_m: Vec<f64>,
}

/// Every case of `facts` by itself. Whether a check needs another one is not considered.
pub(super) fn single_cases(
    lab: &Lab,
    checks: &[Check<dyn FunctionCheck>],
    task: &FunctionTask,
    facts: &[CaseFacts<'_>],
) -> Vec<SingleCase> {
    let cases = facts.iter().map(|facts| {
        let findings = checks.iter().map(|check| {
            let finding = check.kind.judge(task, std::slice::from_ref(facts));
            // a case that loses points always has its evidence
            let was_judged = !finding.is_lost() || !finding.evidence.is_empty();
            was_judged.then_some(finding)
        });
        SingleCase {
            findings: findings.collect(),
            branches_m: branches_m(lab, facts),
        }
    });
    cases.collect()
}

fn branches_m(lab: &Lab, facts: &CaseFacts<'_>) -> Vec<f64> {
    let (Given::Position { position_m, .. }, Answered::Branches(branches)) =
        (&facts.case.given, &facts.answer)
    else {
        return Vec::new();
    };
    let target = Vector3::from(*position_m);
    let distances = branches.iter().map(|q| {
        let reached = tcp_in(facts.robot, &lab.frame, q);
        reached.map_or(f64::INFINITY, |p| (p - target).norm())
    });
    distances.collect()
}
