//! Numbers of lab.toml that no student's variant has.

use super::{Doubt, Rubric};

/// Parameters that vary, and have a value in lab.toml that no student draws: mostly a slip in a sign or in a range.
pub(super) fn rule(rubric: &Rubric<'_>, doubts: &mut Vec<Doubt>) {
    for rule in &rubric.lab.variants {
        let Some(value) = rubric.lab.parameters.get(&rule.name) else {
            continue;
        };
        if !rule.gives(value) {
            doubts.push(Doubt {
                rule: "variants",
                of: rule.name.clone(),
                what: format!(
                    "lab.toml has {}, and students get {}",
                    rule.in_toml(value),
                    rule.words()
                ),
                help: "is a sign wrong, or a range? Let the number of lab.toml be one of them"
                    .to_owned(),
            });
        }
    }
}
