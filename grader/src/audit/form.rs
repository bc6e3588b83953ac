//! A lab in one form: its own numbers and salt, another salt, or a student's variant. What the course staff's submissions do in it is
//! tried once and kept, so that parts of an audit can be done in any order, and at once.

use kinemark_sim::text::Source;

use super::Row;
use crate::judge::{Examined, MovedBody, StaffAttempts, examined};
use crate::lab::Lab;
use crate::lab::staff::Staff;
use crate::record::grade::Grade;
use crate::submission::handed_in::Submission;

/// A lab in one form, with the course staff's part of it.
#[derive(Debug)]
pub struct Form<'a> {
    pub(super) lab: &'a Lab,
    pub(super) staff: &'a Staff,
    known: StaffAttempts,
}

/// What one part of an audit found.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Found {
    /// Its rows, in order.
    pub rows: Vec<Row>,
    /// The grade, if it came to one.
    pub grade: Option<Grade>,
}

impl<'a> Form<'a> {
    /// Nothing tried yet.
    pub fn new(lab: &'a Lab, staff: &'a Staff) -> Self {
        Self {
            lab,
            staff,
            known: StaffAttempts::new(lab, staff),
        }
    }

    /// The course staff's part.
    pub fn staff(&self) -> &'a Staff {
        self.staff
    }

    /// A student's submission, graded in this process as [`grade`](crate::judge::grade) does: for who grades many of them.
    pub fn graded(&self, submission: &Submission) -> Option<Grade> {
        let examined = examined(self.lab, self.staff, submission, &self.known)?;
        Some(examined.graded.grade)
    }

    /// A submission of the course staff, graded.
    pub(super) fn examined(&self, submission: &Source) -> Option<Examined> {
        self.examined_in(self.lab, submission)
    }

    /// The same in the mutant's tasks alone.
    pub(super) fn examined_in(&self, part: &Lab, submission: &Source) -> Option<Examined> {
        examined(part, self.staff, &Submission::from(submission), &self.known)
    }

    /// The grade of a submission that answers zeros.
    pub fn zeros(&self) -> Option<Grade> {
        let source = Source::new("zeros.rhai", super::zeros(self.lab));
        Some(self.examined(&source)?.graded.grade)
    }

    /// The grade of a submission that commands in every run what the reference solution commands in the visible one, in the motion tasks
    /// that have hidden runs; `None` where there are none.
    pub fn played_back(&self) -> Option<Grade> {
        crate::judge::played_back(self.lab, self.staff, &self.known)
    }

    /// Bodies of the lab's scenes that fall or slide while the arm stands still.
    pub fn moved_bodies(&self) -> Vec<MovedBody> {
        crate::judge::moved_bodies(self.lab)
    }

    /// The grade of the reference solution where every motion task is simulated with half the physics step, in visible cases and runs;
    /// `None` where that makes no lab.
    pub fn finer(&self) -> Option<Grade> {
        let lab = self.lab.with_half_step().ok()?;
        let visible = self.staff.without_hidden();
        let finer = Form::new(&lab, &visible);
        Some(finer.examined(&visible.solution)?.graded.grade)
    }

    /// Makes the runs and answers of mutant `index` with which all other submissions are compared. They are made when they are needed;
    /// this is for who does several things at once, so that none waits for another.
    pub fn prepare_mutant(&self, index: usize) {
        let Some(mutant) = self.staff.mutants.get(index) else {
            return;
        };
        for task in &self.lab.tasks {
            if mutant.tasks.contains(&task.name) {
                crate::judge::prepare_mutant(self.lab, self.staff, (task, mutant), &self.known);
            }
        }
    }
}
