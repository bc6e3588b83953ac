//! The reference for students against the language as it is.

use crate::submission::controller::{Budget, Budgets};

/// The reference names everything that is built in, and the budgets as they are.
#[test]
fn the_reference_is_complete() {
    let reference = include_str!("../../../../../docs/script-language.md");
    let meter = std::rc::Rc::new(crate::submission::rhai::budget::Meter::new(
        Budgets::default(),
    ));
    let (_, names) = crate::submission::rhai::engine::build(
        &Budgets::default(),
        &meter,
        &std::rc::Rc::default(),
        None,
    );
    let words: std::collections::BTreeSet<&str> = reference
        .split(|c: char| !(c.is_alphanumeric() || c == '_'))
        .collect();
    for name in names.built_in.keys().chain(&names.constants) {
        assert!(
            words.contains(name.as_str()),
            "`{name}` is not in docs/script-language.md"
        );
    }
    for budget in [
        Budget::OperationsPerCall,
        Budget::OperationsPerTask,
        Budget::CallDepth,
        Budget::ExpressionDepth,
        Budget::ListSize,
        Budget::TextSize,
        Budget::MapSize,
        Budget::SourceBytes,
    ] {
        let row = format!("| {} | {} |", budget.name(), meter.limit(budget));
        assert!(
            reference.contains(&row),
            "docs/script-language.md lacks the row {row}"
        );
    }
}
