//! Names that a script uses and nobody declares. The engine notices each when it comes to it, and a student should not need a run for each.

use std::collections::BTreeSet;

use rhai::{AST, ASTNode, Expr, Position, Stmt};

use super::budget::place;
use super::engine::ARGUMENTS;
use super::hints::Names;
use crate::submission::controller::Grant;

/// A name that is not known where it stands.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Unknown {
    pub(super) name: String,
    /// Where it stands first, from one.
    pub(super) line: usize,
    /// It, and what to write instead.
    pub(super) help: String,
}

/// The unknown names of a script, each where it stands first, in the order of the file. Those among `but` may be declared in what was
/// taken out.
pub(super) fn unknown(ast: &AST, names: &Names, but: &[String]) -> Vec<Unknown> {
    let functions: BTreeSet<&str> = ast.iter_functions().map(|known| known.name).collect();
    let mut constants: BTreeSet<&str> = names.constants.iter().map(String::as_str).collect();
    for statement in ast.statements() {
        if let Stmt::Var(declared, ..) = statement {
            constants.insert(declared.0.as_str());
        }
    }
    let is_declared = |name: &str| {
        constants.contains(name) || ARGUMENTS.contains(&name) || but.iter().any(|it| it == name)
    };
    let is_defined = |name: &str| {
        let is_word = name.starts_with(|c: char| c.is_alphabetic() || c == '_');
        let is_granted_elsewhere = Grant::ALL.iter().any(|grant| grant.name() == name);
        !is_word
            || names.built_in.contains_key(name)
            || functions.contains(name)
            || is_granted_elsewhere
            || but.iter().any(|it| it == name)
    };
    // name, place, whether it is a function, whether it is set
    let mut seen: Vec<(String, Position, bool, bool)> = Vec::new();
    ast.walk(&mut |path| {
        match path.last() {
            Some(ASTNode::Expr(Expr::Variable(variable, short, position)))
                if short.is_none() && variable.0.is_none() && !is_declared(&variable.1) =>
            {
                let is_set = matches!(
                    path.iter().rev().nth(1),
                    Some(ASTNode::Stmt(Stmt::Assignment(assigned)))
                        if assigned.1.lhs.position() == *position
                );
                seen.push((variable.1.to_string(), *position, false, is_set));
            }
            Some(
                ASTNode::Expr(Expr::FnCall(call, position) | Expr::MethodCall(call, position))
                | ASTNode::Stmt(Stmt::FnCall(call, position)),
            ) if !is_defined(&call.name) => {
                seen.push((call.name.to_string(), *position, true, false));
            }
            _ => {}
        }
        true
    });
    // the engine has its own order of functions
    let at = |position: &Position| (position.line(), position.position());
    seen.sort_by_key(|(_, position, ..)| at(position));
    let mut found: Vec<Unknown> = Vec::new();
    for (name, position, is_function, is_set) in seen {
        let Some(place) = place(position) else {
            continue;
        };
        if found.iter().any(|known| known.name == name) {
            continue;
        }
        let (message, help) = if is_function {
            names.unknown_function(&name, &[])
        } else if is_set && super::foreign::variable(&name).is_none() {
            let help = format!("write let {name} = ...; where it is set first");
            (String::new(), Some(help))
        } else {
            names.unknown_variable(&name, Some(place), is_set)
        };
        found.push(Unknown {
            line: place.line,
            help: match help {
                Some(help) => format!("`{name}`: {help}"),
                None => message,
            },
            name,
        });
    }
    found
}

/// Names that are listed beside another one.
const MOST: usize = 6;

/// The unknown names but `name`, which stands in `line`, with their lines and what to write. What belongs to it stands in its line.
pub(super) fn listed(all: &[Unknown], name: &str, line: Option<usize>) -> Option<String> {
    let is_other = |other: &&Unknown| other.name != name && Some(other.line) != line;
    let others = all.iter().filter(is_other).take(MOST);
    let words: Vec<String> = others
        .map(|Unknown { line, help, .. }| format!("line {line}: {help}"))
        .collect();
    (!words.is_empty()).then(|| words.join("; "))
}
