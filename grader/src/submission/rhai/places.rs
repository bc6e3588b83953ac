//! Where a script has its functions, loops and declarations, for messages about what the engine knows no position of.

use std::collections::BTreeSet;

use rhai::{AST, ASTNode, Expr, Position, Stmt};

use super::budget::place;
use super::signs::is_before;
use crate::submission::controller::SourcePosition;

/// The places of one submission, each kind in the order of the file.
#[derive(Debug, Default)]
pub(super) struct Places {
    /// Names and numbers of parameters of functions, and where their bodies begin.
    functions: Vec<(String, usize, SourcePosition)>,
    /// Loops without a number of rounds.
    loops: Vec<SourcePosition>,
    /// Loops over something.
    counted_loops: Vec<SourcePosition>,
    /// Variables that are declared, and where.
    declared: Vec<(String, SourcePosition)>,
    /// Functions that are called, and where.
    calls: Vec<(String, SourcePosition)>,
}

impl Places {
    pub(super) fn of(ast: &AST) -> Self {
        let mut found = Self::default();
        for function in ast.iter_fn_def() {
            if let Some(body) = place(function.body.start_position()) {
                let name = function.name.to_string();
                found.functions.push((name, function.params.len(), body));
            }
        }
        let add = |list: &mut Vec<_>, name: &str, position: Position| {
            list.extend(place(position).map(|place| (name.to_owned(), place)));
        };
        ast.walk(&mut |path| {
            match path.last() {
                Some(ASTNode::Stmt(Stmt::Var(declared, _, position))) => {
                    add(&mut found.declared, declared.0.as_str(), *position);
                }
                Some(ASTNode::Stmt(Stmt::For(names, position))) => {
                    add(&mut found.declared, names.0.as_str(), *position);
                    found.counted_loops.extend(place(*position));
                }
                Some(ASTNode::Stmt(Stmt::While(_, position) | Stmt::Do(_, _, position))) => {
                    found.loops.extend(place(*position));
                }
                Some(
                    ASTNode::Expr(Expr::FnCall(call, position) | Expr::MethodCall(call, position))
                    | ASTNode::Stmt(Stmt::FnCall(call, position)),
                ) => add(&mut found.calls, &call.name, *position),
                _ => {}
            }
            true
        });
        // the engine has its own order of functions
        found.functions.sort_by_key(|(_, _, at)| key(*at));
        found.loops.sort_by_key(|at| key(*at));
        found.counted_loops.sort_by_key(|at| key(*at));
        found.calls.sort_by_key(|(_, at)| key(*at));
        found
    }

    /// Where the body of a function begins.
    pub(super) fn body(&self, name: &str, parameters: usize) -> Option<SourcePosition> {
        let mut functions = self.functions.iter();
        let found = functions.find(|(known, count, _)| known == name && *count == parameters);
        found.map(|(_, _, at)| *at)
    }

    /// The function around a place: its name, and where its body begins.
    pub(super) fn around(&self, at: SourcePosition) -> Option<(&str, SourcePosition)> {
        let count = self
            .functions
            .partition_point(|(_, _, body)| !is_before(at, *body));
        let (name, _, body) = self.functions.get(count.checked_sub(1)?)?;
        Some((name, *body))
    }

    /// The loop that can be the one without an end, or the function of all loops; `None` if it may be one of several functions.
    ///
    /// Only what the called function reaches counts, and what has a number of rounds only where nothing else loops. Without any loop it is
    /// `called`, where the called function begins.
    pub(super) fn endless(&self, called: Option<SourcePosition>) -> Option<SourcePosition> {
        let reached = called.and_then(|called| self.reached_from(called));
        let is_reached = |at: &&SourcePosition| match (&reached, self.around(**at)) {
            (Some(reached), Some((name, _))) => reached.contains(name),
            _ => true,
        };
        let mut loops: Vec<_> = self.loops.iter().filter(is_reached).collect();
        if loops.is_empty() {
            loops.extend(self.counted_loops.iter().filter(is_reached));
        }
        let Some((first, others)) = loops.split_first() else {
            return called;
        };
        if others.is_empty() {
            return Some(**first);
        }
        let function = self.around(**first);
        let same = others.iter().all(|other| self.around(**other) == function);
        same.then(|| function.map_or(**first, |(_, body)| body))
    }

    /// The names of the functions that may run where the function whose body begins at a place is called; `None` if none begins there.
    fn reached_from(&self, body: SourcePosition) -> Option<BTreeSet<&str>> {
        let mut functions = self.functions.iter();
        let (name, ..) = functions.find(|(_, _, begins)| *begins == body)?;
        let mut reached = BTreeSet::new();
        let mut next = vec![name.as_str()];
        while let Some(name) = next.pop() {
            if reached.insert(name) {
                let called = self.calls.iter();
                let called =
                    called.filter(|(_, at)| self.around(*at).is_some_and(|(n, _)| n == name));
                next.extend(called.map(|(called, _)| called.as_str()));
            }
        }
        Some(reached)
    }

    /// The first call of a function by itself.
    pub(super) fn recursion(&self) -> Option<SourcePosition> {
        let mut calls = self.calls.iter();
        let found = calls.find(|(called, at)| {
            let around = self.around(*at);
            around.is_some_and(|(name, _)| name == called)
        });
        found.map(|(_, at)| *at)
    }

    /// Whether a variable is declared before a place, in the same function.
    pub(super) fn is_declared_before(&self, name: &str, at: SourcePosition) -> bool {
        self.declared.iter().any(|(known, declared)| {
            known == name && is_before(*declared, at) && self.around(*declared) == self.around(at)
        })
    }

    /// The name in the definition of a function of this name.
    pub(super) fn definition(&self, name: &str, source: &str) -> Option<SourcePosition> {
        let (_, _, body) = self.functions.iter().find(|(known, ..)| known == name)?;
        let words = format!("fn {name}");
        let lines: Vec<&str> = source.lines().take(body.line).collect();
        let named = lines.iter().enumerate().rev().find_map(|(index, line)| {
            let before = line.get(..line.find(&words)?)?;
            Some(SourcePosition {
                line: index + 1,
                column: before.chars().count() + 4,
            })
        });
        Some(named.unwrap_or(*body))
    }
}

fn key(at: SourcePosition) -> (usize, usize) {
    (at.line, at.column)
}
