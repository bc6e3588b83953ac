//! Names that a script uses and nobody declares. The engine notices each when it comes to it, and a student should not need a run for each.

use std::collections::BTreeSet;

use rhai::{AST, ASTNode, Expr, Position, Stmt};

use super::budget::place;
use super::engine::ARGUMENTS;
use super::foreign;
use super::hints::Names;
use crate::record::grade::FurtherMistake;
use crate::submission::controller::Grant;

/// A name that is not known where it stands.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Unknown {
    pub(super) name: String,
    /// Where it stands first, from one.
    pub(super) line: usize,
    /// It, and what to write instead.
    pub(super) help: String,
    /// Whether it is set in a block, and used outside of it.
    pub(super) is_used_outside: bool,
    is_call: bool,
}

/// Unknown names that are looked for: each is compared with all known ones, and more than that nobody reads.
const MOST_FOUND: usize = 40;

/// The unknown names of a script, each where it stands first, in the order of the file. Those among `but` may be declared in what was
/// taken out.
pub(super) fn unknown(ast: &AST, names: &Names, but: &BTreeSet<String>) -> Vec<Unknown> {
    let variables = variables(ast);
    let mut found: Vec<Unknown> = Vec::new();
    let all = used(ast, names, but);
    for used in &all {
        if found.len() == MOST_FOUND {
            break;
        }
        let Some(place) = place(used.position) else {
            continue;
        };
        let name = used.name.clone();
        // once as a variable, and once as what is called
        let is_call = used.of == Of::Call;
        if found
            .iter()
            .any(|known| known.name == name && known.is_call == is_call)
        {
            continue;
        }
        let mut is_used_outside = false;
        let (message, help) = match used.of {
            Of::Call if variables.contains(&name) => {
                let help = format!("elements are in square brackets: {name}[0] is the first");
                (String::new(), Some(help))
            }
            Of::Call => names.unknown_function(&name, &[]),
            Of::Assignment if foreign::variable(&name).is_none() => {
                let outside = block_to_leave(used, &all);
                is_used_outside = outside.is_some();
                let help = match outside {
                    Some(line) => {
                        format!("write let {name} = 0; before the block that begins in line {line}")
                    }
                    None if is_outside_of_functions(ast, used.position) => {
                        format!("outside of functions write const {name} = ...;")
                    }
                    None => format!("write let {name} = ...; where it is set first"),
                };
                (String::new(), Some(help))
            }
            Of::Assignment | Of::Value => names.unknown_variable(&name, Some(place), false),
        };
        found.push(Unknown {
            line: place.line,
            help: match help {
                Some(help) => format!("`{name}`: {help}"),
                None => message,
            },
            is_used_outside,
            is_call,
            name,
        });
    }
    found
}

/// Whether a name at a position is set by a statement outside of all functions.
fn is_outside_of_functions(ast: &AST, position: Position) -> bool {
    ast.statements().iter().any(|statement| {
        matches!(statement, Stmt::Assignment(assigned) if assigned.1.lhs.position() == position)
    })
}

/// The line of the outermost block in which a name is set and outside of which it is used, too.
fn block_to_leave(set: &Used, all: &[Used]) -> Option<usize> {
    let of_name = all.iter().filter(|used| used.name == set.name);
    let is_around = |block: &&Position| of_name.clone().all(|used| used.blocks.contains(*block));
    // from the innermost outwards
    let outside = set
        .blocks
        .iter()
        .rev()
        .take_while(|block| !is_around(block));
    Some(place(*outside.last()?)?.line)
}

/// What a name is used for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Of {
    Call,
    Assignment,
    Value,
}

/// A name that is not declared where it is used.
struct Used {
    name: String,
    position: Position,
    of: Of,
    /// Where the blocks around it begin, from the outermost.
    blocks: Vec<Position>,
}

/// The uses of names that are not declared, in the order of the file.
fn used(ast: &AST, names: &Names, but: &BTreeSet<String>) -> Vec<Used> {
    let functions: BTreeSet<&str> = ast.iter_functions().map(|known| known.name).collect();
    let top_level = ast
        .statements()
        .iter()
        .filter_map(|statement| match statement {
            Stmt::Var(declared, ..) => Some(declared.0.as_str()),
            _ => None,
        });
    let top_level: BTreeSet<&str> = top_level.collect();
    let is_among_others = |name: &str| but.contains(name);
    let is_declared = |name: &str| {
        top_level.contains(name)
            || names.constants.contains(name)
            || ARGUMENTS.contains(&name)
            || is_among_others(name)
    };
    let is_defined = |name: &str| {
        let is_operator = !name.starts_with(|c: char| c.is_alphabetic() || c == '_');
        // what another task grants is called in a part that this one does not come to
        let may_be_granted = Grant::ALL.iter().any(|grant| grant.name() == name);
        is_operator
            || may_be_granted
            || names.built_in.contains_key(name)
            || functions.contains(name)
            || is_among_others(name)
    };
    let mut used = Vec::new();
    ast.walk(&mut |path| {
        let found = match path.last() {
            Some(ASTNode::Expr(Expr::Variable(variable, short, position)))
                if short.is_none() && variable.0.is_none() && !is_declared(&variable.1) =>
            {
                let is_set = matches!(
                    path.iter().rev().nth(1),
                    Some(ASTNode::Stmt(Stmt::Assignment(assigned)))
                        if assigned.1.lhs.position() == *position
                );
                let of = if is_set { Of::Assignment } else { Of::Value };
                Some((&variable.1, *position, of))
            }
            Some(
                ASTNode::Expr(Expr::FnCall(call, position) | Expr::MethodCall(call, position))
                | ASTNode::Stmt(Stmt::FnCall(call, position)),
            ) if !is_defined(&call.name) => Some((&call.name, *position, Of::Call)),
            _ => None,
        };
        used.extend(found.map(|(name, position, of)| Used {
            name: name.to_string(),
            position,
            of,
            blocks: blocks(path),
        }));
        true
    });
    // the engine has its own order of functions
    used.sort_by_key(|used| (used.position.line(), used.position.position()));
    used
}

/// Where the blocks around the last of these nodes begin, from the outermost.
fn blocks(path: &[ASTNode<'_>]) -> Vec<Position> {
    let of_node = |node: &ASTNode<'_>| match node {
        ASTNode::Stmt(
            Stmt::If(_, position)
            | Stmt::While(_, position)
            | Stmt::Do(_, _, position)
            | Stmt::For(_, position)
            | Stmt::Switch(_, position),
        ) => Some(*position),
        _ => None,
    };
    path.iter().filter_map(of_node).collect()
}

/// The names of variables, wherever they are declared or set.
fn variables(ast: &AST) -> BTreeSet<String> {
    let parameters = ast.iter_functions().flat_map(|function| function.params);
    let mut variables: BTreeSet<String> = parameters.map(ToString::to_string).collect();
    ast.walk(&mut |path| {
        match path.last() {
            Some(ASTNode::Stmt(Stmt::Var(declared, ..))) => {
                variables.insert(declared.0.as_str().to_owned());
            }
            Some(ASTNode::Stmt(Stmt::Assignment(assigned))) => {
                if let Expr::Variable(variable, ..) = &assigned.1.lhs {
                    variables.insert(variable.1.to_string());
                }
            }
            _ => {}
        }
        true
    });
    variables
}

/// Names that are listed beside another one.
const MOST: usize = 12;

/// The unknown names but `name`, which stands in `line`. What belongs to it stands in its line.
pub(super) fn others(all: &[Unknown], name: &str, line: Option<usize>) -> Vec<FurtherMistake> {
    let is_other = |other: &&Unknown| other.name != name && Some(other.line) != line;
    let others = all.iter().filter(is_other).take(MOST);
    others
        .map(|Unknown { line, help, .. }| FurtherMistake {
            lines: vec![*line],
            help: help.clone(),
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_very_many_unknown_names_the_first_ones_are_found() {
        let source: String = (0..500).map(|i| format!("x{i};\n")).collect();
        let mut engine = rhai::Engine::new_raw();
        engine.set_optimization_level(rhai::OptimizationLevel::None);
        let ast = engine.compile(source).unwrap();
        let found = unknown(&ast, &Names::default(), &BTreeSet::new());
        let lines: Vec<usize> = found.iter().map(|unknown| unknown.line).collect();
        assert_eq!(lines, (1..=MOST_FOUND).collect::<Vec<_>>());
    }
}
