//! Diagnosis: do the student's answers or run agree with a mutant where that mutant differs from the reference?
//!
//! A mistake is named only if it explains everything: the answers agree with it wherever it would show, are right elsewhere, and agree
//! with no other mistake as well. A wrong diagnosis is worse than none.

mod whole_run;

pub use self::whole_run::{Compared, whole_run};

use crate::attempt::answers::{Answered, CaseError, CaseFacts};
use crate::attempt::branches::same_branch;
use crate::attempt::measure::relative_error;
use crate::check::{Dwell, best_dwells};
use crate::lab::staff::Mutant;
use crate::record::grade::Diagnosis;
use crate::task::jacobian;
use crate::task::model::{Band, MotionTask};
use kinemark_sim::trace::Trace;
use nalgebra::Vector3;

/// Fewer answers that show a mistake could agree by chance.
const LEAST_ANSWERS: usize = 3;
/// Positions and Jacobians computed by the same formula, written in two ways, differ only by rounding \[m\].
const SAME_POSITION_M: f64 = 1e-6;

/// The agreement of the answers with one mutant.
struct Agreement<'m> {
    mutant: &'m Mutant,
    agreeing: usize,
    telling: usize,
}

impl Agreement<'_> {
    fn diagnosis(&self) -> Diagnosis {
        Diagnosis {
            mistake: self.mutant.name.clone(),
            says: self.mutant.says.clone(),
            agreeing: self.agreeing as u32,
            telling: self.telling as u32,
        }
    }
}

/// The mistake that explains everything, if exactly one does; of several, the one that shows in more answers.
fn clear(mut candidates: Vec<Agreement<'_>>) -> Vec<Diagnosis> {
    candidates.retain(|c| c.telling > 0 && c.agreeing == c.telling);
    candidates.sort_by_key(|candidate| std::cmp::Reverse(candidate.telling));
    match candidates.as_slice() {
        [only] => vec![only.diagnosis()],
        [first, second, ..] if first.telling > second.telling => vec![first.diagnosis()],
        _ => Vec::new(),
    }
}

/// Compares the student's answers with those of each mutant on the same cases.
pub fn function_task<'m>(
    student: &[CaseFacts<'_>],
    mutants: impl Iterator<Item = (&'m Mutant, Vec<CaseFacts<'m>>)>,
    band: Band,
) -> Vec<Diagnosis> {
    let mut candidates = Vec::new();
    for (mutant, answers) in mutants {
        let (mut agreeing, mut telling, mut right_elsewhere) = (0, 0, true);
        for (student, mutant) in student.iter().zip(&answers) {
            if is_wrong(mutant, band) {
                telling += 1;
                agreeing += usize::from(agrees(student, mutant));
            } else {
                right_elsewhere &= !is_wrong(student, band);
            }
        }
        if telling >= LEAST_ANSWERS && right_elsewhere {
            candidates.push(Agreement {
                mutant,
                agreeing,
                telling,
            });
        }
    }
    clear(candidates)
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
            branches_m.is_empty()
                || branches_m.iter().any(|error_m| band.score(*error_m) <= 0.0)
                || angles_rad.iter().any(|angle_rad| *angle_rad >= TURNED_RAD)
        }
        CaseError::Unreachable { said_so } => !said_so,
        CaseError::Jacobian { relative, .. } => band.score(*relative) <= 0.0,
        CaseError::Entries(relative) => relative.iter().any(|off| band.score(*off) <= 0.0),
    }
}

fn agrees(student: &CaseFacts<'_>, mutant: &CaseFacts<'_>) -> bool {
    match (&student.answer, &mutant.answer) {
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

/// Compares the positions at which the student's run settled with those of each mutant's run.
pub fn motion_task<'m>(
    motion: &MotionTask,
    band: Band,
    student: &Trace,
    mutants: impl Iterator<Item = (&'m Mutant, Trace)>,
) -> Vec<Diagnosis> {
    let same_m = 5e-4; // a quarter of a narrow band; a servo at rest is far inside it
    let still_m = 0.01; // an arm that never moved did not go to a wrong position
    let settled = settled_at(motion, student);
    let mut candidates = Vec::new();
    for (mutant, trace) in mutants {
        let places = settled_at(motion, &trace);
        if places.len() != motion.goals.len() || settled.len() != places.len() {
            continue;
        }
        let (mut agreeing, mut telling) = (0, 0);
        let mut right_elsewhere = true;
        for ((goal, student), mutant) in motion.goals.iter().zip(&settled).zip(&places) {
            let stands_still =
                trace.is_empty() || (mutant - trace.tcp_position(0)).norm() < still_m;
            if !stands_still && (mutant - goal.position_m).norm() > band.full {
                telling += 1;
                agreeing += usize::from((student - mutant).norm() <= same_m);
            } else if !stands_still {
                right_elsewhere &= band.score((student - goal.position_m).norm()) > 0.0;
            }
        }
        if right_elsewhere {
            candidates.push(Agreement {
                mutant,
                agreeing,
                telling,
            });
        }
    }
    clear(candidates)
}

/// For each goal, the position at which a run was most nearly at rest, near its dwell that is nearest to the goal.
fn settled_at(motion: &MotionTask, trace: &Trace) -> Vec<Vector3<f64>> {
    // without a score, nearer is better
    let anywhere = Band {
        full: 0.0,
        zero: 0.0,
    };
    let near_m = 0.02; // at the end of its settling, a step response still swings by this much
    let window = 20; // ticks over which motion is measured
    let dwells = best_dwells(trace, &motion.goals, anywhere);
    let rest_position = |dwell: &Dwell| {
        let around = trace.tcp_position(dwell.last);
        let visit = (dwell.first..trace.len()).take_while(|&tick| {
            tick <= dwell.last || (trace.tcp_position(tick) - around).norm() < near_m
        });
        let moved = |tick: usize| {
            let later = (tick + window).min(trace.len() - 1);
            (trace.tcp_position(later) - trace.tcp_position(tick)).norm()
        };
        // the last tick has no tick after it and would always count as still
        let stillest = visit
            .filter(|&tick| tick + window < trace.len())
            .min_by(|&a, &b| moved(a).total_cmp(&moved(b)));
        trace.tcp_position(stillest.unwrap_or(dwell.last))
    };
    dwells.iter().map(rest_position).collect()
}
