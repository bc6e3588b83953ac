//! Diagnosis: do the student's answers or run agree with a mutant where that mutant differs from the reference?
//!
//! A mistake is named only if it explains everything: the answers agree with it wherever it would show, are right elsewhere, and agree
//! with no other mistake as well. A wrong diagnosis is worse than none.
//!
//! | file | what it holds |
//! |---|---|
//! | `ruling` | what a comparison with one mutant came to, and which of all of them is named |
//! | `answers` | the answers to the cases of a function task |
//! | `settled` | where a run with goals came to rest |
//! | `mutant_run` | what is kept of a mutant's run |
//! | `whole_run` | a run without goals, in the joints |

mod answers;
mod mutant_run;
mod ruling;
mod settled;
mod whole_run;

pub use self::answers::{MutantAnswers, function_task};
pub use self::mutant_run::MutantRun;
pub use self::ruling::{Agreement, AtGoal, NearMiss, NotNamed, Ruling};
pub use self::settled::{Settled, motion_task};
pub use self::whole_run::{Compared, Unfolding, whole_run};

use crate::record::grade::Diagnosis;

/// What was found of every mutant, and the one that is named, if one is.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Diagnosed {
    /// The mistake.
    pub named: Vec<Diagnosis>,
    /// The comparisons, in the order of the mutants. Of whole runs, those after the second mutant that agrees may be missing.
    pub rulings: Vec<Ruling>,
}

impl Diagnosed {
    /// The mistake that is named, and the comparisons if there were any.
    pub(super) fn parts(found: Option<Self>) -> (Vec<Diagnosis>, Option<Vec<Ruling>>) {
        match found {
            Some(found) => (found.named, Some(found.rulings)),
            None => (Vec::new(), None),
        }
    }
}
