//! Answers of inverse kinematics in which one part is right: whether turning the first joint alone would bring the hand to its target,
//! and whether it would if the last joint's angle were half a turn minus what was returned, as a sign in the law of cosines makes it.

use std::f64::consts::PI;

use nalgebra::Vector3;

use super::{Answers, CauseOfAnswers};
use crate::attempt::answers::{Answered, CaseFacts};
use crate::task::model::Given;
use crate::task::tcp::tcp_in;

/// The hand is at its target \[m\].
const NEAR_M: f64 = 5e-3;

pub(super) fn seen(answers: &Answers<'_>) -> Option<CauseOfAnswers> {
    let missed: Vec<Missed<'_>> = answers
        .wrong
        .iter()
        .filter_map(|facts| Missed::of(facts, answers.frame))
        .collect();
    let robot = missed.first()?.facts.robot;
    let n = robot.n();
    if missed.len() < super::LEAST_WRONG || n < 2 {
        return None;
    }
    if !robot.moving_joints().all(|joint| joint.kind.turns()) {
        return None;
    }
    let name = |joint| Some(robot.moving_joints().nth(joint)?.name.as_str());
    let (first, last) = (name(0)?, name(n - 1)?);
    let all =
        |meant: &dyn Fn(&[f64]) -> Vec<f64>| missed.iter().all(|missed| missed.turns_there(meant));
    let count = missed.len();
    if all(&|q| q.to_vec()) {
        return Some(CauseOfAnswers {
            words: format!(
                "in all {count} cases that miss their target, joint `{first}` alone could bring the hand there: the other angles are right"
            ),
            question: format!(
                "Which two angles add up to the angle of joint `{first}`, and from where is each measured?"
            ),
        });
    }
    let supplement = |q: &[f64]| {
        let mut meant = q.to_vec();
        meant[n - 1] = PI - meant[n - 1];
        meant
    };
    all(&supplement).then(|| CauseOfAnswers {
        words: format!(
            "in all {count} cases that miss their target, the hand has the right distance from joint `{first}` if the angle of joint `{last}` is taken as a half turn minus that"
        ),
        question: format!(
            "Which angle of the triangle does your law of cosines give, and which one does joint `{last}` turn?"
        ),
    })
}

/// A target within reach that no answered branch reaches.
struct Missed<'a> {
    facts: &'a CaseFacts<'a>,
    frame: &'a str,
    target_m: Vector3<f64>,
    branches: &'a [Vec<f64>],
}

impl<'a> Missed<'a> {
    fn of(facts: &'a CaseFacts<'a>, frame: &'a str) -> Option<Self> {
        match (&facts.case.given, &facts.answer) {
            (
                Given::Position {
                    position_m,
                    branches: 1..,
                    ..
                },
                Answered::Branches(branches),
            ) if !branches.is_empty() => Some(Self {
                facts,
                frame,
                target_m: Vector3::from(*position_m),
                branches,
            }),
            _ => None,
        }
    }

    /// Whether the first joint alone can bring the hand to the target, from every branch as it was `meant`.
    fn turns_there(&self, meant: &dyn Fn(&[f64]) -> Vec<f64>) -> bool {
        let mut branches = self.branches.iter();
        branches.all(|q| self.nearest_m(&meant(q)).is_some_and(|off| off <= NEAR_M))
    }

    /// How near the hand comes to the target while the first joint turns once: it goes round a circle.
    fn nearest_m(&self, q: &[f64]) -> Option<f64> {
        let at = |angle: f64| {
            let mut q = q.to_vec();
            q[0] = angle;
            tcp_in(self.facts.robot, self.frame, &q)
        };
        let [start, quarter, half] = [at(0.0)?, at(0.5 * PI)?, at(PI)?];
        let centre = 0.5 * (start + half);
        let (along, aside) = (start - centre, quarter - centre);
        let to = self.target_m - centre;
        let angle = libm::atan2(to.dot(&aside), to.dot(&along));
        Some((at(angle)? - self.target_m).norm())
    }
}
