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
        of: match problem.key == NOT_LOADED {
            true => "variants".to_owned(),
            false => problem.key,
        },
        what: problem.what,
        help: format!("narrow the range in [variants], {}", problem.help),
    }));
}
