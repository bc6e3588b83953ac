//! Whether a run with goals came to rest where that of a mutant did.

use std::ops::Deref;

use kinemark_sim::trace::Trace;
use nalgebra::{Rotation3, Vector3};

use super::Diagnosed;
use super::ruling::{Agreement, AtGoal, NotNamed, Ruling, clear};
use crate::check::{Dwell, best_dwells};
use crate::lab::staff::Mutant;
use crate::task::model::{Band, GoalOrientation, MotionGoal, MotionTask};

/// A quarter of a narrow band; a servo at rest is far inside it \[m\].
const SAME_M: f64 = 5e-4;
/// As much is clearly another orientation \[rad\].
const TURNED_RAD: f64 = 0.02;
/// As little is the same one \[rad\].
const SAME_RAD: f64 = 5e-3;
/// An arm that never moved did not go to a wrong position \[m\].
const STILL_M: f64 = 0.01;

/// Where a run came to rest.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Settled {
    /// The TCP at the start; nothing in a run without a tick.
    start: Option<Vector3<f64>>,
    /// For each goal, where it was most nearly at rest; empty where there was no time for all of them.
    places: Vec<Rest>,
}

/// The TCP where it is most nearly at rest, in the lab's frame.
#[derive(Debug, Clone, PartialEq)]
struct Rest {
    position_m: Vector3<f64>,
    rotation: Rotation3<f64>,
}

impl Rest {
    /// How far it is turned away from what a goal asks for, in `[0, π]` \[rad\]; zero where that asks for no orientation.
    fn turned_rad(&self, goal: &MotionGoal) -> f64 {
        let orientation = goal.orientation.as_ref();
        orientation.map_or(0.0, |wanted| wanted.angle_rad(&self.rotation))
    }

    /// Whether it is the other, as far as a goal asks.
    fn is_at(&self, other: &Self, goal: &MotionGoal) -> bool {
        let apart = self.rotation.inverse() * other.rotation;
        let is_turned_alike = goal.orientation.is_none()
            || GoalOrientation::Rotation(Rotation3::identity()).angle_rad(&apart) <= SAME_RAD;
        (self.position_m - other.position_m).norm() <= SAME_M && is_turned_alike
    }
}

impl Settled {
    /// Of a run of `motion`.
    pub fn of(motion: &MotionTask, trace: &Trace) -> Self {
        Self {
            start: (!trace.is_empty()).then(|| trace.tcp_position(0)),
            places: settled_at(motion, trace),
        }
    }

    /// How far `student` agrees with this run of a mutant.
    fn compared(
        &self,
        student: &Self,
        motion: &MotionTask,
        band: Band,
    ) -> Result<Agreement, NotNamed> {
        let places = &self.places;
        if places.len() != motion.goals.len() || student.places.len() != places.len() {
            return Err(NotNamed::NoRest);
        }
        let (mut agreeing, mut telling) = (0, 0);
        let mut right_elsewhere = true;
        let mut not_telling = Vec::new();
        for ((goal, student), mutant) in motion.goals.iter().zip(&student.places).zip(places) {
            let from_start_m = self
                .start
                .map_or(0.0, |start| (mutant.position_m - start).norm());
            let off_m = (mutant.position_m - goal.position_m).norm();
            let turned_rad = mutant.turned_rad(goal);
            if from_start_m < STILL_M {
                not_telling.push(AtGoal::Start {
                    from_start_m,
                    still_m: STILL_M,
                });
            } else if off_m > band.full || turned_rad >= TURNED_RAD {
                telling += 1;
                agreeing += usize::from(student.is_at(mutant, goal));
            } else {
                let is_near = band.score((student.position_m - goal.position_m).norm()) > 0.0;
                right_elsewhere &= is_near && student.turned_rad(goal) < TURNED_RAD;
                not_telling.push(AtGoal::There {
                    off_m,
                    full_m: band.full,
                    turned_rad: goal.orientation.map(|_| [turned_rad, TURNED_RAD]),
                });
            }
        }
        if !right_elsewhere {
            return Err(NotNamed::WrongElsewhere);
        }
        if telling == 0 {
            return Err(NotNamed::NoGoal(not_telling));
        }
        Ok(Agreement { agreeing, telling })
    }
}

/// Compares the positions at which the student's run settled with those of each mutant's run.
pub fn motion_task<'m, S: Deref<Target: AsRef<Settled>>>(
    motion: &MotionTask,
    band: Band,
    student: &Settled,
    mutants: impl Iterator<Item = (&'m Mutant, S)>,
) -> Diagnosed {
    let rulings = mutants.map(|(mutant, settled)| Ruling {
        mistake: mutant.name.clone(),
        says: mutant.says.clone(),
        found: settled.as_ref().compared(student, motion, band),
    });
    let rulings: Vec<Ruling> = rulings.collect();
    Diagnosed {
        named: clear(&rulings),
        rulings,
    }
}

/// For each goal, where a run was most nearly at rest, near its dwell that is nearest to the goal.
fn settled_at(motion: &MotionTask, trace: &Trace) -> Vec<Rest> {
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
        let tick = stillest.unwrap_or(dwell.last);
        Rest {
            position_m: trace.tcp_position(tick),
            rotation: trace.tcp_rotation(tick),
        }
    };
    dwells.iter().map(rest_position).collect()
}
