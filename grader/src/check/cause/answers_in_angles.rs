//! Answers of inverse kinematics whose angles all suffer from the same slip, or whose last joint is right, so that only the others are
//! wrong; and answers of forward kinematics to angles that do.

use nalgebra::Vector3;

use super::angle_slip::only_one;
use super::{Answers, CauseOfAnswers};
use crate::attempt::answers::{Answered, CaseFacts};
use crate::task::model::Given;
use crate::task::tcp::tcp_in;

/// Positions that are the same \[m\].
const SAME_M: f64 = 1e-4;
/// Angles that are the same mistake put the arm this near its target \[m\]; a slip that does not explain it ends much further off.
const NEAR_M: f64 = 5e-3;

pub(super) fn seen(answers: &Answers<'_>) -> Option<CauseOfAnswers> {
    of_inverse(answers).or_else(|| of_forward(answers))
}

/// The target of a case that is within reach, and the branches that were answered.
fn branches<'a>(facts: &'a CaseFacts<'_>) -> Option<(Vector3<f64>, &'a [Vec<f64>])> {
    match (&facts.case.given, &facts.answer) {
        (
            Given::Position {
                position_m,
                branches: 1..,
                ..
            },
            Answered::Branches(found),
        ) if !found.is_empty() => Some((Vector3::from(*position_m), found)),
        _ => None,
    }
}

fn of_inverse(answers: &Answers<'_>) -> Option<CauseOfAnswers> {
    let wrong: Vec<_> = answers
        .wrong
        .iter()
        .filter_map(|facts| Some((*facts, branches(facts)?)))
        .collect();
    if wrong.len() < super::LEAST_WRONG {
        return None;
    }
    let robot = wrong[0].0.robot;
    let slip = only_one(robot, |slip| {
        wrong.iter().all(|(facts, (target, branches))| {
            let mut branches = branches.iter();
            branches.all(|q| {
                let meant = slip.undone(facts.robot, q);
                let p = tcp_in(facts.robot, answers.frame, &meant);
                p.is_some_and(|p| (p - target).norm() <= NEAR_M)
            })
        })
    })?;
    let count = wrong.len();
    Some(CauseOfAnswers {
        words: format!(
            "in all {count} cases that miss their target, the arm gets there if {}",
            slip.in_words(robot)
        ),
        question: slip.question(robot),
    })
}

fn of_forward(answers: &Answers<'_>) -> Option<CauseOfAnswers> {
    let wrong: Vec<_> = answers
        .wrong
        .iter()
        .filter_map(|facts| match &facts.case.given {
            Given::Q(q) => Some((*facts, q, facts.answer.position()?)),
            _ => None,
        })
        .collect();
    if wrong.len() < super::LEAST_WRONG {
        return None;
    }
    // a slip is of joints that the robot of every case has
    let robots = wrong.iter().map(|(facts, ..)| facts.robot);
    let robot = robots.min_by_key(|robot| robot.n())?;
    // of a pose the orientation alone may be wrong
    let is_right = |(facts, q, answered): &(&CaseFacts<'_>, &Vec<f64>, Vector3<f64>)| {
        let p = tcp_in(facts.robot, answers.frame, q);
        p.is_some_and(|p| (p - answered).norm() <= SAME_M)
    };
    if wrong.iter().any(is_right) {
        return None;
    }
    let slip = only_one(robot, |slip| {
        wrong.iter().all(|(facts, q, answered)| {
            let taken = slip.undone(facts.robot, q);
            let p = tcp_in(facts.robot, answers.frame, &taken);
            p.is_some_and(|p| (p - answered).norm() <= SAME_M)
        })
    })?;
    let count = wrong.len();
    Some(CauseOfAnswers {
        words: format!(
            "all {count} wrong positions are where the arm would be if {}",
            slip.in_words(robot)
        ),
        question: slip.question_of_given(robot),
    })
}
