//! Whether the answers to the cases of a function task agree with those of a mutant.

use super::Diagnosed;
use super::ruling::{Agreement, NearMiss, NotNamed, Ruling, clear};
use crate::attempt::answers::{Answered, CaseError, CaseFacts};
use crate::attempt::branches::same_branch;
use crate::attempt::measure::relative_error;
use crate::lab::staff::Mutant;
use crate::task::jacobian;
use crate::task::model::Band;

/// Fewer answers that show a mistake could agree by chance.
const LEAST_ANSWERS: usize = 3;
/// Positions and Jacobians computed by the same formula, written in two ways, differ only by rounding \[m\].
const SAME_POSITION_M: f64 = 1e-6;

/// The answers of a mutant to all cases of a task, and which of them show its mistake.
#[derive(Debug, Clone, PartialEq)]
pub struct MutantAnswers {
    answers: Vec<Answered>,
    /// For each, whether it earns nothing.
    wrong: Vec<bool>,
    /// The answer that is most nearly so far off that it earns nothing, among those that are not.
    nearest: Option<NearMiss>,
}

impl MutantAnswers {
    /// Of the answers `facts`, judged by `band`.
    pub fn of(facts: &[CaseFacts<'_>], band: Band) -> Self {
        let wrong: Vec<bool> = facts.iter().map(|facts| is_wrong(facts, band)).collect();
        let right = facts.iter().zip(&wrong).filter(|(_, wrong)| !**wrong);
        let misses = right.filter_map(|(facts, _)| {
            let (error, unit) = worst_error(facts)?;
            Some(NearMiss {
                case: facts.case.name.clone(),
                error,
                needed: band.zero,
                unit,
            })
        });
        let nearest = misses.max_by(|a, b| a.error.total_cmp(&b.error));
        Self {
            answers: facts.iter().map(|facts| facts.answer.clone()).collect(),
            wrong,
            nearest,
        }
    }

    /// How far `student` agrees.
    fn compared(&self, student: &[CaseFacts<'_>], band: Band) -> Result<Agreement, NotNamed> {
        let (mut agreeing, mut telling, mut right_elsewhere) = (0, 0, true);
        for ((student, answer), wrong) in student.iter().zip(&self.answers).zip(&self.wrong) {
            if *wrong {
                telling += 1;
                agreeing += usize::from(agrees(student, answer));
            } else {
                right_elsewhere &= !is_wrong(student, band);
            }
        }
        if telling < LEAST_ANSWERS {
            return Err(NotNamed::FewAnswers {
                telling,
                cases: self.answers.len(),
                needed: LEAST_ANSWERS,
                nearest: self.nearest.clone(),
            });
        }
        if !right_elsewhere {
            return Err(NotNamed::WrongElsewhere);
        }
        Ok(Agreement { agreeing, telling })
    }
}

/// Compares the student's answers with those of each mutant to the same cases.
pub fn function_task<'m, A: AsRef<MutantAnswers>>(
    student: &[CaseFacts<'_>],
    mutants: impl Iterator<Item = (&'m Mutant, A)>,
    band: Band,
) -> Diagnosed {
    let rulings = mutants.map(|(mutant, answers)| Ruling {
        mistake: mutant.name.clone(),
        says: mutant.says.clone(),
        found: answers.as_ref().compared(student, band),
    });
    let rulings: Vec<Ruling> = rulings.collect();
    Diagnosed {
        named: clear(&rulings),
        rulings,
    }
}

/// A pose that is turned by this is clearly turned \[rad\].
const TURNED_RAD: f64 = 0.02;

/// Whether an answer is so far off that it earns nothing: a mistake clearly shows there.
fn is_wrong(facts: &CaseFacts<'_>, band: Band) -> bool {
    match &facts.error {
        CaseError::Position(error_m) => band.score(*error_m) <= 0.0,
        CaseError::Pose {
            position_m,
            angle_rad,
        } => band.score(*position_m) <= 0.0 || *angle_rad >= TURNED_RAD,
        CaseError::Reach {
            branches_m,
            angles_rad,
            ..
        } => {
            angles_rad.iter().any(|angle_rad| *angle_rad >= TURNED_RAD)
                || branches_m.is_empty()
                || branches_m.iter().any(|error_m| band.score(*error_m) <= 0.0)
        }
        CaseError::Unreachable { said_so } => !said_so,
        CaseError::Jacobian { relative, .. } => band.score(*relative) <= 0.0,
        CaseError::Entries(relative) => relative.iter().any(|off| band.score(*off) <= 0.0),
    }
}

/// How far an answer is off, where that is a number, with its unit.
fn worst_error(facts: &CaseFacts<'_>) -> Option<(f64, &'static str)> {
    let worst = |errors: &[f64]| errors.iter().copied().fold(0.0, f64::max);
    match &facts.error {
        CaseError::Position(error_m)
        | CaseError::Pose {
            position_m: error_m,
            ..
        } => Some((*error_m, "m")),
        CaseError::Reach { branches_m, .. } => Some((worst(branches_m), "m")),
        CaseError::Unreachable { .. } => None,
        CaseError::Jacobian { relative, .. } => Some((*relative, "")),
        CaseError::Entries(relative) => Some((worst(relative), "")),
    }
}

fn agrees(student: &CaseFacts<'_>, mutant: &Answered) -> bool {
    match (&student.answer, mutant) {
        (Answered::Position(a), Answered::Position(b)) => {
            (a - b).norm() <= SAME_POSITION_M * (1.0 + b.norm())
        }
        // one branch may be missing: that is a different mistake, with a check of its own
        (Answered::Branches(a), Answered::Branches(b)) => {
            let found = |q: &Vec<f64>| b.iter().any(|other| close(student, q, other));
            a.is_empty() == b.is_empty() && a.iter().all(found)
        }
        (Answered::Pose(a), Answered::Pose(b)) => relative_error(a, b, 1.0) <= SAME_POSITION_M,
        (Answered::Matrix(a), Answered::Matrix(b)) => {
            jacobian::distance(a, b) <= SAME_POSITION_M * (1.0 + jacobian::norm(b))
        }
        (Answered::Entries(a), Answered::Entries(b)) => a
            .iter()
            .zip(b)
            .all(|(a, b)| relative_error(a, b, 0.0) <= SAME_POSITION_M),
        // NaN where the mutant gives NaN too
        (Answered::Invalid(_), Answered::Invalid(_)) => true,
        _ => false,
    }
}

fn close(facts: &CaseFacts<'_>, a: &[f64], b: &[f64]) -> bool {
    // the same configuration: the same numbers up to full turns and rounding
    same_branch(facts.robot, a, b)
        && a.iter().zip(b).all(|(a, b)| {
            let circle = 2.0 * std::f64::consts::PI;
            let gap = (a - b).abs() % circle;
            gap.min(circle - gap) <= 1e-6 || (a - b).abs() <= 1e-6
        })
}
