//! Which tasks a change can reach: those whose functions, with all that these mention, have it in them. In the others the changed solution
//! does what the solution does.

use std::collections::BTreeSet;

use crate::lab::{Lab, TaskWork};
use crate::submission::rhai::{Bytes, Part, ProgramTree};

/// What each task of a lab may run of a solution.
pub(super) struct Influence {
    /// Names that each task reaches, in the lab's order.
    reached: Vec<(String, BTreeSet<String>)>,
    /// Functions, and what is declared outside of them, with their names.
    named: Vec<(String, Bytes)>,
}

impl Influence {
    pub(super) fn new(lab: &Lab, program: &str) -> Self {
        let tree = ProgramTree::read(program).unwrap_or_default();
        let of = |at: &Bytes| program.get(at.clone()).unwrap_or_default().to_owned();
        let functions = tree.functions.iter();
        let mut named: Vec<(String, Bytes)> = functions
            .map(|function| (of(&function.name), function.whole.clone()))
            .collect();
        let is_inside = |at: &Bytes, whole: &Bytes| whole.start <= at.start && at.end <= whole.end;
        let mut mentions: Vec<(String, BTreeSet<String>)> = tree
            .functions
            .iter()
            .map(|function| (of(&function.name), function.mentions.clone()))
            .collect();
        let declared = tree.parts.iter().filter_map(|part| match part {
            Part::Declaration { name, value, .. } => Some((name, value)),
            _ => None,
        });
        for (name, value) in declared {
            let mut functions = tree.functions.iter();
            if functions.any(|function| is_inside(name, &function.whole)) {
                continue;
            }
            named.push((of(name), name.start..value.end));
            let names = tree.parts.iter().filter_map(|part| match part {
                Part::Name { at } | Part::Call { name: at, .. } if is_inside(at, value) => {
                    Some(of(at))
                }
                _ => None,
            });
            mentions.push((of(name), names.collect()));
        }
        let reached = lab.tasks.iter().map(|task| {
            let entries: &[&str] = match &task.work {
                TaskWork::Function(function, _) => &[function.name()],
                TaskWork::Motion(..) => &["init", "control"],
            };
            let entries = entries.iter().map(|name| (*name).to_owned());
            (task.name.clone(), closure(entries.collect(), &mentions))
        });
        Self {
            reached: reached.collect(),
            named,
        }
    }

    /// The tasks that a change of these bytes can reach.
    pub(super) fn tasks(&self, at: &Bytes) -> Vec<&str> {
        let mut named = self.named.iter();
        let around = named.find(|(_, whole)| whole.start <= at.start && at.end <= whole.end);
        let reached = self.reached.iter();
        let tasks =
            reached.filter(|(_, names)| around.is_none_or(|(name, _)| names.contains(name)));
        tasks.map(|(task, _)| task.as_str()).collect()
    }
}

/// All names that these lead to.
fn closure(
    mut names: BTreeSet<String>,
    mentions: &[(String, BTreeSet<String>)],
) -> BTreeSet<String> {
    loop {
        let led = mentions.iter().filter(|(name, _)| names.contains(name));
        let led: BTreeSet<String> = led.flat_map(|(_, further)| further.clone()).collect();
        let before = names.len();
        names.extend(led);
        if names.len() == before {
            return names;
        }
    }
}
