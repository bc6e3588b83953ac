//! Targets within reach for which inverse kinematics returns nothing.

use super::{Answers, CauseOfAnswers};
use crate::attempt::answers::{Answered, CaseFacts};
use crate::task::model::Given;

pub(super) fn seen(answers: &Answers<'_>) -> Option<CauseOfAnswers> {
    let is_refused = |facts: &CaseFacts<'_>| matches!(&facts.answer, Answered::Branches(found) if found.is_empty());
    let is_reachable =
        |facts: &CaseFacts<'_>| matches!(facts.case.given, Given::Position { branches: 1.., .. });
    let all = || answers.wrong.iter().chain(&answers.right);
    let reachable = all().filter(|facts| is_reachable(facts)).count();
    let refused = answers.wrong.iter();
    let refused = refused.filter(|facts| is_reachable(facts) && is_refused(facts));
    let refused = refused.count();
    // one alone is at the boundary, and nothing at all is no answer yet
    (refused >= super::LEAST_WRONG && refused < all().count() && any_found(answers)).then(|| {
        CauseOfAnswers {
            words: format!(
                "for {refused} of {reachable} targets within reach, nothing is returned"
            ),
            question: match answers.wrong.first().map(|facts| facts.robot.n()) {
                Some(2) => "From which point do you measure the distance to the target, and how large is your `cos q2` where you return nothing?",
                _ => "Which condition of yours leads to `[]` there, and which numbers does it compare?",
            }
            .to_owned(),
        }
    })
}

/// Whether some case has branches: a starter returns none at all.
fn any_found(answers: &Answers<'_>) -> bool {
    let mut all = answers.wrong.iter().chain(&answers.right);
    all.any(|facts| matches!(&facts.answer, Answered::Branches(found) if !found.is_empty()))
}
