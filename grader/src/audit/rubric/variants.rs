//! Numbers of lab.toml that no student's variant has, and variants that do not vary.

use toml::Value as Toml;

use super::{Doubt, Rubric};
use crate::audit::typed;

/// What `[variants]` says of parameters that do not vary.
fn of_nothing(rubric: &Rubric<'_>, doubts: &mut Vec<Doubt>) {
    let Some(table) = typed::table(rubric.lab) else {
        return;
    };
    let variants = table.get("variants").and_then(Toml::as_table);
    for (name, rule) in variants.into_iter().flatten() {
        let choices = rule.get("choices").and_then(Toml::as_array);
        let choices = choices.map_or(&[][..], Vec::as_slice);
        let again = (1..choices.len()).find(|i| choices[..*i].contains(&choices[*i]));
        let (what, help) = if rule.get("from").is_some() && rule.get("from") == rule.get("to") {
            let what = "its range has no width: everybody gets the same number".to_owned();
            (what, "widen it, or leave it out")
        } else if let Some(again) = again {
            let what = format!("the choice {} is there twice", choices[again]);
            (what, "take one of the two out")
        } else {
            continue;
        };
        doubts.push(Doubt {
            rule: "variants",
            of: name.clone(),
            what,
            help: help.to_owned(),
        });
    }
}

/// Parameters that vary, and have a value in lab.toml that no student draws: mostly a slip in a sign or in a range.
pub(super) fn rule(rubric: &Rubric<'_>, doubts: &mut Vec<Doubt>) {
    of_nothing(rubric, doubts);
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
