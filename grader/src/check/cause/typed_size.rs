//! Answers that are right for the lab's arm and wrong for arms of other sizes: a size is typed in.

use super::{Answers, CauseOfAnswers};
use crate::attempt::answers::CaseFacts;
use crate::task::model::Given;

pub(super) fn seen(answers: &Answers<'_>) -> Option<CauseOfAnswers> {
    let is_other = |facts: &&&CaseFacts<'_>| !facts.case.dimensions.is_empty();
    let are_other = answers.wrong.iter().all(|facts| is_other(&facts));
    let own_right = answers
        .right
        .iter()
        .filter(|facts| !is_other(facts))
        .count();
    // what is out of reach is refused by luck, too
    let is_within =
        |facts: &&&CaseFacts<'_>| !matches!(facts.case.given, Given::Position { branches: 0, .. });
    let other_right = answers.right.iter().filter(is_other).filter(is_within);
    let other_right = other_right.count();
    (are_other && own_right >= super::LEAST_WRONG && other_right == 0).then(|| CauseOfAnswers {
        words:
            "right in every case with the arm of this lab, and wrong in every case with another arm"
                .to_owned(),
        question:
            "Which sizes of the arm does your function take from `robot`, each from the right place, and does each of its terms hold for any of them? `robot` has those of the case."
                .to_owned(),
    })
}
