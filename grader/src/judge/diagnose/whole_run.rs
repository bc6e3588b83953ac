//! Whether a whole run agrees with that of a mutant: compared in the joints while the mutant runs, and given up as soon as the two can
//! no longer agree.
//!
//! Distances are root mean squares over the control ticks of the run. The mutant must differ from the reference solution, and the
//! student must agree with the mutant, each at the time shift that is least favourable to that conclusion.

use std::sync::Arc;

use kinemark_sim::run::DivergenceKind;
use kinemark_sim::ticks::Periods;
use kinemark_sim::trace::Trace;

use super::Diagnosed;
use super::mutant_run::{MutantRun, Positions, is_still};
use super::ruling::{Agreement, NotNamed, Ruling, only};
use crate::attempt::motion::Session;
use crate::attempt::{EndReason, Ended};
use crate::lab::staff::Mutant;

/// A mutant whose mean distance from the reference solution is less than this shows too little of its mistake \[rad or m\].
const LEAST_DISTANCE: f64 = 0.02;
/// How far a student may be from a mutant, as a fraction of the mutant's distance from the reference solution.
const SHARE: f64 = 0.02;
/// How far a student may always be from a mutant; other gains change a servo's lag by more than this \[rad or m\].
const FLOOR: f64 = 1e-3;
/// Distances from the reference solution are capped at this, so that one moment cannot dominate the others \[rad or m\].
const MOST: f64 = 1.0;
/// How much earlier or later a student may make the same motion \[s\].
const MOST_SHIFT_S: f64 = 0.1;
/// Calls of `control` between two comparisons with a mutant's run.
const CALLS_PER_COMPARISON: u64 = 5;

/// A student's run, and the reference solution's of the same task.
#[derive(Debug, Clone, Copy)]
pub struct Compared<'t> {
    /// The student's run.
    pub student: &'t Trace,
    /// Why it ended early, and when.
    pub ended: Option<&'t Ended>,
    /// The reference solution's run, which reached its end.
    pub reference: &'t Trace,
    /// The periods of both.
    pub periods: Periods,
}

/// A mutant's run: still to be made, as far as it is needed, or made before.
pub enum Unfolding<'l> {
    /// Before its first tick.
    Session(Box<Session<'l>>),
    /// Made before.
    Made(Arc<MutantRun>),
    /// It did not start.
    NotStarted,
}

/// The mutant whose run agrees with the student's, if exactly one does. `stopped` is called for each mutant that stops early.
pub fn whole_run<'m, 'l>(
    compared: Compared<'_>,
    mutants: impl Iterator<Item = (&'m Mutant, Unfolding<'l>)>,
    stopped: &dyn Fn(&Mutant, Option<&Ended>),
) -> Diagnosed {
    let mut rulings: Vec<Ruling> = Vec::new();
    let mut agreeing = 0;
    for (mutant, unfolding) in mutants {
        let (found, is_made) = match unfolding {
            Unfolding::Session(session) => {
                let found = compared.with(*session, &|ended| stopped(mutant, ended));
                (found, false)
            }
            Unfolding::Made(run) => {
                stopped(mutant, run.ended());
                (compared.with_whole(&run), true)
            }
            Unfolding::NotStarted => (Err(NotNamed::NoRun), false),
        };
        agreeing += usize::from(found.is_ok());
        rulings.push(Ruling {
            mistake: mutant.name.clone(),
            says: mutant.says.clone(),
            found,
        });
        // a second match ends the search, unless it costs nothing: then neither is reported
        if agreeing == 2 && !is_made {
            break;
        }
    }
    Diagnosed {
        named: only(&rulings),
        rulings,
    }
}

impl Compared<'_> {
    /// Runs a mutant for as long as it can still agree with the student.
    fn with(
        &self,
        mut mutant: Session<'_>,
        stopped: &dyn Fn(Option<&Ended>),
    ) -> Result<Agreement, NotNamed> {
        let mut sums = Sums::new(self);
        let interval = CALLS_PER_COMPARISON * u64::from(self.periods.ticks_per_control.get());
        let most_ticks = self.student.len() as u64 + self.most_shift_ticks() + 1;
        let given_up = NotNamed::Far {
            mean_and_most: None,
        };
        while !mutant.is_over() && mutant.tick() <= most_ticks {
            mutant.advance_to(mutant.tick() + interval);
            stopped(mutant.ended());
            sums.add_ticks(self, self.of_trace(mutant.so_far()), usize::MAX);
            if !sums.can_agree() {
                return Err(given_up);
            }
        }
        if !mutant.is_over() {
            return Err(NotNamed::EndsOtherwise);
        }
        let mutant = mutant.finish();
        let positions = self.of_trace(&mutant.recorded);
        sums.add_ticks(self, positions, usize::MAX);
        self.decided(&sums, positions, mutant.ended.as_ref(), || {
            is_still(&mutant)
        })
    }

    /// The same with a mutant's run that is whole already.
    fn with_whole(&self, mutant: &MutantRun) -> Result<Agreement, NotNamed> {
        let mut sums = Sums::new(self);
        let positions = mutant.positions();
        sums.add_ticks(self, positions, usize::MAX);
        self.decided(&sums, positions, mutant.ended(), || mutant.is_still)
    }

    fn decided(
        &self,
        sums: &Sums,
        mutant: Positions<'_>,
        ended: Option<&Ended>,
        is_still: impl FnOnce() -> bool,
    ) -> Result<Agreement, NotNamed> {
        let shift = sums.agrees()?;
        if !same_end(self.ended, ended, self.most_shift_ticks()) {
            return Err(NotNamed::EndsOtherwise);
        }
        if is_still() {
            return Err(NotNamed::Still);
        }
        Ok(self.agreement(mutant, shift))
    }

    fn agreement(&self, mutant: Positions<'_>, shift: i64) -> Agreement {
        let (mut agreeing, mut telling) = (0, 0);
        for row in 0..mutant.count() {
            let (Some(from_student), Some(from_reference)) = (
                self.distance(self.student, mutant.at(row), row, shift),
                self.distance(self.reference, mutant.at(row), row, 0),
            ) else {
                continue;
            };
            if from_reference > LEAST_DISTANCE {
                telling += 1;
                agreeing += usize::from(from_student < 0.5 * from_reference);
            }
        }
        Agreement { agreeing, telling }
    }

    fn every(&self) -> usize {
        self.periods.ticks_per_control.get() as usize
    }

    fn of_trace<'t>(&self, trace: &'t Trace) -> Positions<'t> {
        Positions::Trace(trace, self.every())
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

    /// The distance in the joints between control tick `row` of the mutant, at which they are `here`, and the one `shift` ticks later in
    /// `other`; `None` if `other` has no such tick.
    fn distance(&self, other: &Trace, here: &[f64], row: usize, shift: i64) -> Option<f64> {
        let there = usize::try_from(row as i64 + shift).ok()?;
        if there >= self.rows(other) {
            return None;
        }
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

/// Sums over a mutant's run so far, at each shift from the earliest to the latest.
struct Sums {
    /// Squared distances from the student.
    from_student: Vec<Sum>,
    /// Squared distances from the reference solution.
    from_reference: Vec<Sum>,
    most_shift: i64,
    /// Control ticks of the student's run.
    rows: usize,
    /// Control ticks that are summed already.
    summed: usize,
}

impl Sums {
    fn new(compared: &Compared<'_>) -> Self {
        let most_shift = compared.most_shift();
        let none = vec![Sum::default(); 2 * most_shift as usize + 1];
        Self {
            from_student: none.clone(),
            from_reference: none,
            most_shift,
            rows: compared.rows(compared.student),
            summed: 0,
        }
    }

    fn shifts(&self) -> impl Iterator<Item = i64> + use<> {
        -self.most_shift..=self.most_shift
    }

    /// Adds the new control ticks of the mutant's run, up to the first `most`.
    fn add_ticks(&mut self, compared: &Compared<'_>, mutant: Positions<'_>, most: usize) {
        let until = mutant.count().min(self.rows).min(most);
        for row in self.summed..until {
            let here = mutant.at(row);
            for (i, shift) in self.shifts().enumerate() {
                self.from_student[i].add(compared.distance(compared.student, here, row, shift));
                let distance = compared.distance(compared.reference, here, row, shift);
                self.from_reference[i].add(distance.map(|distance| distance.min(MOST)));
            }
        }
        self.summed = until.max(self.summed);
    }

    /// The mean square up to which a student agrees, for a mean square from the reference solution.
    fn tolerance(from_reference: f64) -> f64 {
        (FLOOR * FLOOR).max(SHARE * SHARE * from_reference)
    }

    /// Whether the runs can still agree: in the most favourable case, in which the mutant is far from the reference solution and the
    /// student is at the mutant for the rest of the run.
    fn can_agree(&self) -> bool {
        let rest = self.rows - self.summed;
        let sums = self.shifts().zip(&self.from_reference);
        let from_reference = sums.map(|(shift, sum)| {
            let rows = self.rows.saturating_sub(shift.unsigned_abs() as usize);
            (sum.squares + rest as f64 * MOST * MOST) / rows.max(1) as f64
        });
        let tolerance = Self::tolerance(from_reference.fold(f64::INFINITY, f64::min));
        self.from_student
            .iter()
            .any(|sum| sum.squares <= tolerance * self.rows as f64)
    }

    /// The shift at which the student agrees best, if the mutant shows its mistake and the student agrees.
    fn agrees(&self) -> Result<i64, NotNamed> {
        let from_reference = self.from_reference.iter().map(Sum::mean);
        let from_reference = from_reference.fold(f64::INFINITY, f64::min);
        let compared = self
            .shifts()
            .zip(&self.from_student)
            .filter(|(_, sum)| sum.count > 0);
        // the smallest among equal shifts
        let nearest = compared.min_by(|a, b| {
            let by_distance = a.1.mean().total_cmp(&b.1.mean());
            by_distance.then_with(|| a.0.abs().cmp(&b.0.abs()))
        });
        let Some((shift, from_student)) = nearest else {
            return Err(NotNamed::EndsOtherwise);
        };
        let shows_mistake = from_reference >= LEAST_DISTANCE * LEAST_DISTANCE;
        if !shows_mistake {
            return Err(NotNamed::NearReference {
                mean: from_reference.sqrt(),
                needed: LEAST_DISTANCE,
            });
        }
        let most = Self::tolerance(from_reference);
        let agrees = from_student.mean() <= most;
        let mean_and_most = Some([from_student.mean().sqrt(), most.sqrt()]);
        agrees
            .then_some(shift)
            .ok_or(NotNamed::Far { mean_and_most })
    }
}

/// Whether both runs reached their ends, or diverged in the same way at nearly the same time.
fn same_end(student: Option<&Ended>, mutant: Option<&Ended>, most_ticks: u64) -> bool {
    match (student, mutant) {
        (None, None) => true,
        (Some(student), Some(mutant)) => match (&student.why, &mutant.why) {
            (EndReason::Diverged { what: a, .. }, EndReason::Diverged { what: b, .. }) => {
                student.at.abs_diff(mutant.at) <= most_ticks && same_divergence(a, b)
            }
            _ => false,
        },
        _ => false,
    }
}

/// Whether two runs diverged at the same joint or body, and in the same way.
fn same_divergence(a: &DivergenceKind, b: &DivergenceKind) -> bool {
    match (a, b) {
        (DivergenceKind::NotFinite { joint: a }, DivergenceKind::NotFinite { joint: b })
        | (DivergenceKind::Runaway { joint: a, .. }, DivergenceKind::Runaway { joint: b, .. }) => {
            a == b
        }
        (
            DivergenceKind::BodyRunaway { body: a, .. },
            DivergenceKind::BodyRunaway { body: b, .. },
        ) => a == b,
        (DivergenceKind::InContact { body: a }, DivergenceKind::InContact { body: b }) => a == b,
        _ => false,
    }
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
            sums.add_ticks(&compared, compared.of_trace(mutant), row + 1);
            if lost.is_none() && !sums.can_agree() {
                lost = Some(row);
            }
        }
        (sums.agrees().ok(), lost)
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
        // 0.08 rad² remain, which about 0.1 rad for ten control ticks use up
        assert!(lost < Some(45), "{lost:?}");
    }

    #[test]
    fn a_mutant_like_the_reference_but_for_a_shift_proves_nothing() {
        let reference = trace(step(0.2, 1.0));
        let mutant = trace(step(0.28, 1.0));
        assert_eq!(compared(&mutant, &mutant, &reference).0, None);
        let mutant = trace(step(0.5, 1.0));
        assert_eq!(compared(&mutant, &mutant, &reference).0, Some(0));
    }

    #[test]
    fn runaways_are_the_same_where_the_same_was_lost_at_the_same_time() {
        let lost = |tick, joint| {
            let what = DivergenceKind::Runaway {
                joint,
                kinetic_j: 2e6,
                bound_j: 1e6,
                at_start: false,
            };
            let why = EndReason::Diverged { what, cause: None };
            Ended::because(why, tick)
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
            Some(Ended::because(why, 500))
        };
        assert!(!same(stopped(), stopped()));
    }
}
