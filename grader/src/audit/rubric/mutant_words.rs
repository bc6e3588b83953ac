//! Mutants that say what another one does: two whose words were exchanged.

use super::{Doubt, Rubric};
use crate::lab::staff::Mutant;

/// Letters at the beginning of a word that decide: `rounded` fits to `rounding`.
const STEM: usize = 5;

/// Names of two mutants that have so many words more in common with the other's words than with their own.
const CROSSED: usize = 2;

/// Two mutants whose names fit the words of the other better than their own.
pub(super) fn rule(rubric: &Rubric<'_>, doubts: &mut Vec<Doubt>) {
    let mutants = &rubric.staff.mutants;
    for (i, one) in mutants.iter().enumerate() {
        let exchanged = mutants[..i].iter().find(|other| {
            let own = fits(&one.name, one) + fits(&other.name, other);
            fits(&one.name, other) + fits(&other.name, one) >= own + CROSSED
        });
        if let Some(other) = exchanged {
            doubts.push(Doubt {
                rule: "words",
                of: format!("mutant {}", one.name),
                what: format!(
                    "what mutant `{0}` says fits its name, and what it says fits the name of `{0}`",
                    other.name
                ),
                help: "exchange what the two say, or give them other names".to_owned(),
            });
        }
    }
}

/// How many words of a name are in what a mutant says.
fn fits(name: &str, mutant: &Mutant) -> usize {
    let stem = |word: &str| -> String { word.to_lowercase().chars().take(STEM).collect() };
    let says = mutant.says_in.values().chain(std::iter::once(&mutant.says));
    let said: Vec<String> = says
        .flat_map(|says| says.split(|c: char| !c.is_alphanumeric()))
        .map(stem)
        .collect();
    let words = name.split('-').filter(|word| word.chars().count() > 3);
    words.filter(|word| said.contains(&stem(word))).count()
}
