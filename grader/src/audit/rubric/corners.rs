//! Corners of what students draw in which the reference solution loses points: the variants of some students, whom twenty drawn ones may
//! miss.

use super::{Doubt, Rubric};
use crate::audit::variants::NOT_LOADED;

/// A doubt for each distinct problem.
pub(super) fn rule(rubric: &Rubric<'_>, doubts: &mut Vec<Doubt>) {
    let Some(corners) = rubric.corners else {
        return;
    };
    let count = corners.count();
    let problems = corners.problems(|first, places| {
        let (of, what) = (&first.of, &first.problem.what);
        format!("in {places} of {count} corners, first with {of}: {what}")
    });
    doubts.extend(problems.into_iter().map(|problem| Doubt {
        rule: "corners",
        of: match problem.key.split_once(": ") {
            _ if problem.key == NOT_LOADED => "variants".to_owned(),
            // of a stop the rest of the key is no place
            Some((task, _)) => task.to_owned(),
            None => problem.key,
        },
        what: problem.what,
        help: format!("narrow the range in [variants], {}", problem.help),
    }));
}
