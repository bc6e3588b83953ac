//! Whether a whole run is that of a known mistake: compared in the joints while the mutant runs, and given up as soon as the two can
//! no longer agree.
//!
//! Distances are root mean squares over the control ticks of the run. The mutant must differ from the reference solution, and the
//! student must not differ from the mutant, each at the shift in time that makes it hardest to say so.

use std::cmp::Ordering;

use kinemark_sim::run::BlowUp;
use kinemark_sim::ticks::Periods;
use kinemark_sim::trace::Trace;

use crate::attempt::motion::Session;
use crate::attempt::{Attempt, EndReason, Ended};
use crate::lab::staff::Mutant;
use crate::record::grade::Diagnosis;

/// A mutant nearer to the reference solution than this, in the mean over the run, shows too little of its mistake \[rad or m\].
const LEAST_TELLING: f64 = 0.02;
/// How far a student may be from a mutant, as a share of that one's distance from the reference solution.
const SHARE: f64 = 0.02;
/// How far a student may always be from a mutant: a servo's lag differs by more for other gains \[rad or m\].
const FLOOR: f64 = 1e-3;
/// A distance from the reference solution counts no more than this, so that one moment cannot excuse the others \[rad or m\].
const MOST: f64 = 1.0;
/// How much earlier or later a student may do the same \[s\].
const MOST_SHIFT_S: f64 = 0.1;
/// An arm that moves less, or is commanded nothing, makes no mistake that could be told from any other \[rad or m\].
const STILL: f64 = 0.01;
/// Calls of `control` between two looks at a mutant's run.
const CALLS_A_LOOK: u64 = 5;

/// A student's run, and the reference solution's of the same task.
#[derive(Debug, Clone, Copy)]
pub struct Compared<'t> {
    /// The student's.
    pub student: &'t Trace,
    /// Why it ended early, and when.
    pub ended: Option<&'t Ended>,
    /// The reference solution's, which came to its end.
    pub reference: &'t Trace,
    /// The periods of both.
    pub periods: Periods,
}

/// The one known mistake whose run is the student's, if there is exactly one. `stopped` is told of each that stops on the way.
pub fn whole_run<'m, 'l>(
    compared: Compared<'_>,
    mutants: impl Iterator<Item = (&'m Mutant, Session<'l>)>,
    stopped: &dyn Fn(&Mutant, Option<&Ended>),
) -> Vec<Diagnosis> {
    let mut found = mutants.filter_map(|(mutant, session)| {
        let agreement = compared.with(session, &|ended| stopped(mutant, ended))?;
        Some(Diagnosis {
            mistake: mutant.name.clone(),
            says: mutant.says.clone(),
            agreeing: agreement.agreeing,
            telling: agreement.telling,
        })
    });
    // a second one ends the search: of two that fit, neither is told
    match (found.next(), found.next()) {
        (Some(only), None) => vec![only],
        _ => Vec::new(),
    }
}

/// How many calls of `control` show the mistake, of those in which it would show.
struct Agreement {
    agreeing: u32,
    telling: u32,
}

impl Compared<'_> {
    /// Runs a mutant as long as it can agree with the student.
    fn with(&self, mut mutant: Session<'_>, stopped: &dyn Fn(Option<&Ended>)) -> Option<Agreement> {
        let mut sums = Sums::new(self);
        let look = CALLS_A_LOOK * u64::from(self.periods.ticks_per_control.get());
        let most_ticks = self.student.len() as u64 + self.most_shift_ticks() + 1;
        while !mutant.is_over() && mutant.tick() <= most_ticks {
            mutant.advance_to(mutant.tick() + look);
            stopped(mutant.ended());
            sums.see(self, mutant.so_far(), usize::MAX);
            if !sums.can_agree() {
                return None;
            }
        }
        if !mutant.is_over() {
            return None;
        }
        let mutant = mutant.finish();
        sums.see(self, &mutant.recorded, usize::MAX);
        let shift = sums.agrees()?;
        let ends_alike = same_end(self.ended, mutant.ended.as_ref(), self.most_shift_ticks());
        (ends_alike && !is_still(&mutant)).then(|| self.agreement(&mutant.recorded, shift))
    }

    fn agreement(&self, mutant: &Trace, shift: i64) -> Agreement {
        let (mut agreeing, mut telling) = (0, 0);
        for row in 0..self.rows(mutant) {
            let (Some(apart), Some(told)) = (
                self.distance(self.student, mutant, row, shift),
                self.distance(self.reference, mutant, row, 0),
            ) else {
                continue;
            };
            if told > LEAST_TELLING {
                telling += 1;
                agreeing += u32::from(apart < 0.5 * told);
            }
        }
        Agreement { agreeing, telling }
    }

    fn every(&self) -> usize {
        self.periods.ticks_per_control.get() as usize
    }

    /// Control ticks of a run.
    fn rows(&self, trace: &Trace) -> usize {
        trace.len().div_ceil(self.every())
    }

    fn most_shift(&self) -> i64 {
        (MOST_SHIFT_S / self.periods.control_s()).round() as i64
    }

    fn most_shift_ticks(&self) -> u64 {
        (MOST_SHIFT_S / self.periods.step_s).round() as u64
    }

    /// Distance in the joints of `other`, `shift` control ticks later, from a control tick of the mutant; none where `other` has none.
    fn distance(&self, other: &Trace, mutant: &Trace, row: usize, shift: i64) -> Option<f64> {
        let there = usize::try_from(row as i64 + shift).ok()?;
        if there >= self.rows(other) {
            return None;
        }
        let here = mutant.q.at(row * self.every());
        let there = other.q.at(there * self.every());
        let squares = here.iter().zip(there).map(|(a, b)| (a - b) * (a - b));
        Some(squares.sum::<f64>().sqrt())
    }
}

/// Squares of distances summed at one shift.
#[derive(Debug, Clone, Copy, Default)]
struct Sum {
    squares: f64,
    count: usize,
}

impl Sum {
    fn add(&mut self, distance: Option<f64>) {
        if let Some(distance) = distance {
            self.squares += distance * distance;
            self.count += 1;
        }
    }

    fn mean(&self) -> f64 {
        self.squares / self.count.max(1) as f64
    }
}

/// What is known of a mutant's run so far, at each shift from the earliest to the latest.
struct Sums {
    /// From the student.
    apart: Vec<Sum>,
    /// From the reference solution.
    told: Vec<Sum>,
    most_shift: i64,
    rows: usize,
    seen: usize,
}

impl Sums {
    fn new(compared: &Compared<'_>) -> Self {
        let most_shift = compared.most_shift();
        let none = vec![Sum::default(); 2 * most_shift as usize + 1];
        Self {
            apart: none.clone(),
            told: none,
            most_shift,
            rows: compared.rows(compared.student),
            seen: 0,
        }
    }

    fn shifts(&self) -> impl Iterator<Item = i64> + use<> {
        -self.most_shift..=self.most_shift
    }

    /// Adds the control ticks of the mutant's run that are new, up to the first `most`.
    fn see(&mut self, compared: &Compared<'_>, mutant: &Trace, most: usize) {
        let until = compared.rows(mutant).min(self.rows).min(most);
        for row in self.seen..until {
            for (i, shift) in self.shifts().enumerate() {
                self.apart[i].add(compared.distance(compared.student, mutant, row, shift));
                let told = compared.distance(compared.reference, mutant, row, shift);
                self.told[i].add(told.map(|told| told.min(MOST)));
            }
        }
        self.seen = until.max(self.seen);
    }

    /// The square of the mean distance at which a student still agrees, for a mean square from the reference solution.
    fn tolerance(told: f64) -> f64 {
        (FLOOR * FLOOR).max(SHARE * SHARE * told)
    }

    /// Whether the run can still end in agreement: even if the mutant were far from the reference solution, and the student where
    /// the mutant is, through all of the rest.
    fn can_agree(&self) -> bool {
        let rest = self.rows - self.seen;
        let told = self.shifts().zip(&self.told).map(|(shift, sum)| {
            let rows = self.rows.saturating_sub(shift.unsigned_abs() as usize);
            (sum.squares + rest as f64 * MOST * MOST) / rows.max(1) as f64
        });
        let tolerance = Self::tolerance(told.fold(f64::INFINITY, f64::min));
        self.apart
            .iter()
            .any(|sum| sum.squares <= tolerance * self.rows as f64)
    }

    /// The shift at which the student agrees best, if the mutant is telling and the student agrees.
    fn agrees(&self) -> Option<i64> {
        let told = self.told.iter().map(Sum::mean);
        let told = told.fold(f64::INFINITY, f64::min);
        let compared = self
            .shifts()
            .zip(&self.apart)
            .filter(|(_, sum)| sum.count > 0);
        // of shifts that are equal the smallest
        let (shift, apart) = compared.min_by(|a, b| {
            let by_distance = a.1.mean().total_cmp(&b.1.mean());
            by_distance.then_with(|| a.0.abs().cmp(&b.0.abs()))
        })?;
        let is_telling = told >= LEAST_TELLING * LEAST_TELLING;
        (is_telling && apart.mean() <= Self::tolerance(told)).then_some(shift)
    }
}

/// Whether two runs came to their ends, or diverged in the same way at nearly the same time.
fn same_end(student: Option<&Ended>, mutant: Option<&Ended>, most_ticks: u64) -> bool {
    match (student, mutant) {
        (None, None) => true,
        (Some(student), Some(mutant)) => match (&student.why, &mutant.why) {
            (EndReason::Diverged { what: a, .. }, EndReason::Diverged { what: b, .. }) => {
                student.at.abs_diff(mutant.at) <= most_ticks && same_loss(a, b)
            }
            _ => false,
        },
        _ => false,
    }
}

/// Whether the same was lost first.
fn same_loss(a: &BlowUp, b: &BlowUp) -> bool {
    match (a, b) {
        (BlowUp::NotFinite { joint: a }, BlowUp::NotFinite { joint: b })
        | (BlowUp::Runaway { joint: a, .. }, BlowUp::Runaway { joint: b, .. }) => a == b,
        (BlowUp::BodyRunaway { body: a, .. }, BlowUp::BodyRunaway { body: b, .. }) => a == b,
        (BlowUp::InContact { body: a }, BlowUp::InContact { body: b }) => a == b,
        _ => false,
    }
}

/// Whether an arm stayed where it began, or was commanded nothing.
fn is_still(run: &Attempt<Trace>) -> bool {
    let trace = &run.recorded;
    if trace.is_empty() {
        return true;
    }
    let start = trace.q.at(0);
    let moved = (0..trace.len()).any(|tick| {
        let pairs = trace.q.at(tick).iter().zip(start);
        pairs.map(|(q, start)| (q - start).abs()).any(|moved| {
            // a number that is none has moved as well
            moved.partial_cmp(&STILL) != Some(Ordering::Less)
        })
    });
    let commanded =
        (0..trace.len()).any(|tick| trace.command.at(tick).iter().any(|c| c.abs() > 0.0));
    !(moved && commanded)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::sample::chain;

    fn trace(of: impl Fn(f64) -> f64) -> Trace {
        chain(1, 2001, |tick, _| of(0.001 * tick as f64)).trace
    }

    /// The shift at which a student agrees with a mutant, and the control tick from which it could no longer.
    fn compared(
        student: &Trace,
        mutant: &Trace,
        reference: &Trace,
    ) -> (Option<i64>, Option<usize>) {
        let compared = Compared {
            student,
            ended: None,
            reference,
            periods: Periods::new(0.001, 0.001, 0.01).unwrap(),
        };
        let mut sums = Sums::new(&compared);
        let mut lost = None;
        for row in 0..compared.rows(mutant) {
            sums.see(&compared, mutant, row + 1);
            if lost.is_none() && !sums.can_agree() {
                lost = Some(row);
            }
        }
        (sums.agrees(), lost)
    }

    /// A step that begins at `from_s` and ends at `to`.
    fn step(from_s: f64, to: f64) -> impl Fn(f64) -> f64 {
        move |t| to * (1.0 - libm::exp(-5.0 * (t - from_s).max(0.0)))
    }

    #[test]
    fn a_student_agrees_within_a_fiftieth_and_a_tenth_of_a_second() {
        let reference = trace(step(0.2, 1.0));
        let mutant = trace(step(0.2, 0.5));
        let agrees = |student| compared(&trace(student), &mutant, &reference);
        assert_eq!(agrees(step(0.2, 0.5)), (Some(0), None));
        // 0.4 rad from the reference in the mean: 8 mrad are left
        assert_eq!(agrees(step(0.2, 0.508)), (Some(0), None));
        assert_eq!(agrees(step(0.3, 0.5)), (Some(10), None));
        assert_eq!(agrees(step(0.1, 0.5)), (Some(-10), None));
        for near_miss in [
            step(0.2, 0.515),
            step(0.2, 0.485),
            step(0.36, 0.5),
            step(0.2, 1.0),
        ] {
            let (agreed, lost) = agrees(near_miss);
            assert_eq!(agreed, None);
            assert!(lost.is_some());
        }
    }

    #[test]
    fn a_run_that_left_the_students_is_given_up_early() {
        let reference = trace(step(0.2, 1.0));
        let (_, lost) = compared(&trace(step(0.2, 1.0)), &trace(step(0.2, -1.0)), &reference);
        // 0.08 rad² are left to it, which some 0.1 rad for ten control ticks use up
        assert!(lost < Some(45), "{lost:?}");
    }

    #[test]
    fn a_mutant_like_the_reference_but_for_a_shift_tells_nothing() {
        let reference = trace(step(0.2, 1.0));
        let mutant = trace(step(0.28, 1.0));
        assert_eq!(compared(&mutant, &mutant, &reference).0, None);
        let mutant = trace(step(0.5, 1.0));
        assert_eq!(compared(&mutant, &mutant, &reference).0, Some(0));
    }

    #[test]
    fn runaways_are_the_same_where_the_same_was_lost_at_the_same_time() {
        let lost = |tick, joint| {
            let what = BlowUp::Runaway {
                joint,
                kinetic_j: 2e6,
                bound_j: 1e6,
            };
            let why = EndReason::Diverged { what, cause: None };
            Ended { at: tick, why }
        };
        let same = |a: Option<Ended>, b: Option<Ended>| same_end(a.as_ref(), b.as_ref(), 100);
        assert!(same(None, None));
        assert!(same(Some(lost(500, 1)), Some(lost(600, 1))));
        assert!(!same(Some(lost(500, 1)), Some(lost(601, 1))));
        assert!(!same(Some(lost(500, 1)), Some(lost(500, 0))));
        assert!(!same(Some(lost(500, 1)), None));
        assert!(!same(None, Some(lost(500, 1))));
        let stopped = || {
            let why = EndReason::InvalidOutput("no".to_owned());
            Some(Ended { at: 500, why })
        };
        assert!(!same(stopped(), stopped()));
    }
}
