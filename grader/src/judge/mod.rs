//! From a lab and a submission to a graded run: every task is attempted, its checks judge the attempts, and the record is made once,
//! from their findings.

mod case_grades;
mod check_grades;
pub mod diagnose;
pub mod divergence;
mod expected;
mod explanation;
mod exposed;
mod first_lost;
mod function_task;
mod grader;
mod hidden_attempts;
mod judged;
mod motion_judge;
mod motion_record;
mod motion_task;
mod opening;
mod playback;
mod practice_form;
mod reached;
pub mod reference_run;
mod robustness_sweep;
mod shown_cases;
mod side_by_side;
mod single_case;
mod solution_end;
mod staff_attempts;
pub(crate) mod staff_faults;
mod standing;

pub use expected::{answers_of, with_expected};
pub use explanation::explain;
pub(crate) use exposed::drawn_in_words;
pub use exposed::{ExposedLab, NoAnswer, expose};
pub(crate) use grader::{Examined, examined, prepare_mutant};
pub use grader::{Interrupted, Parts, engine, engine_digest, grade, parts};
pub(crate) use opening::opening;
pub(crate) use playback::played_back;
pub use practice_form::{NoPractice, practice};
pub(crate) use solution_end::{SolutionEnd, solution_end};
pub(crate) use staff_attempts::StaffAttempts;
pub use standing::MovedBody;
pub(crate) use standing::moved_bodies;
