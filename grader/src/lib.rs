//! Lab and submission in, graded run out. No terminal, no clock, no process, no file: what must not differ between machines
//! lives here.
//!
//! | module | what it holds |
//! |---|---|
//! | [`record`] | the grade and what is drawn with it, for every renderer |
//! | [`submission`] | the seam to a student's code, and the script host behind it |
//! | [`task`] | what a task asks for, its robot and its scene |
//! | [`lab`] | labs, their hidden cases and known mistakes |
//! | [`attempt`] | a submission tried on one task |
//! | [`check`] | one file per check |
//! | [`judge`] | from attempts to a grade |
//! | [`compare`] | two graded submissions beside each other |
//! | [`audit`] | the grader of a lab, graded |

#![cfg_attr(
    test,
    expect(
        clippy::float_cmp,
        reason = "tests state exact values where exactness is the claim"
    )
)]

pub mod attempt;
pub mod audit;
pub mod check;
pub mod compare;
pub mod judge;
pub mod lab;
pub mod record;
pub mod submission;
pub mod task;
