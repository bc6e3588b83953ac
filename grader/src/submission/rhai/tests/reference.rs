//! The reference for students against the language as it is.

use super::stop;
use crate::submission::controller::{Budget, Budgets, Stop};
use crate::submission::rhai::foreign::RESERVED;

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

#[test]
fn reserved_words_are_refused_as_names_and_listed() {
    let reference = include_str!("../../../../../docs/script-language.md");
    for word in RESERVED {
        let listed = format!("`{word}`");
        assert!(reference.contains(&listed), "{word}");
        for source in [
            format!("fn control(o) {{ let {word} = 1; {word} }}"),
            format!("fn {word}(x) {{ x }}\nfn control(o) {{ 1 }}"),
        ] {
            let Stop::DidNotBuild(mistake) = stop(&source) else {
                panic!("{source}: it builds");
            };
            let message = format!("`{word}` is a reserved word of the language");
            assert_eq!(mistake.message, message, "{source}");
        }
    }
}
