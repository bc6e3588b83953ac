//! The parts of a program are those of the engine's own tree.

use std::collections::{BTreeMap, BTreeSet};

use rhai::{ASTNode, Engine, Expr, Position};

use crate::submission::rhai::{Part, ProgramTree};

/// Operators by their places, each with the place at which its left operand begins.
type Operators = BTreeMap<(usize, usize), (String, (usize, usize))>;

fn place(position: Position) -> (usize, usize) {
    (
        position.line().unwrap_or(0),
        position.position().unwrap_or(0),
    )
}

/// Where an expression begins: the engine's place of an operator is that of its sign.
fn leftmost(expression: &Expr) -> Position {
    match expression {
        Expr::FnCall(call, _) if call.op_token.is_some() && call.args.len() == 2 => {
            leftmost(&call.args[0])
        }
        Expr::Dot(of, ..) | Expr::Index(of, ..) => leftmost(&of.lhs),
        other => other.start_position(),
    }
}

fn of_engine(program: &str) -> (Operators, BTreeSet<(usize, usize)>) {
    let mut engine = Engine::new_raw();
    engine.set_optimization_level(rhai::OptimizationLevel::None);
    engine.set_max_expr_depths(0, 0);
    let ast = engine.compile(program).unwrap();
    let (mut operators, mut numbers) = (Operators::new(), BTreeSet::new());
    ast.walk(&mut |path| {
        match path.last() {
            Some(ASTNode::Expr(Expr::FnCall(call, position)))
                if call.op_token.is_some() && call.args.len() == 2 =>
            {
                let left = place(leftmost(&call.args[0]));
                operators.insert(place(*position), (call.name.to_string(), left));
            }
            Some(ASTNode::Expr(
                Expr::IntegerConstant(_, position) | Expr::FloatConstant(_, position),
            )) => {
                numbers.insert(place(*position));
            }
            _ => {}
        }
        true
    });
    (operators, numbers)
}

fn of_parts(program: &str) -> (Operators, BTreeSet<(usize, usize)>) {
    let place = |at: usize| {
        let before = &program[..at];
        let line = before.rsplit('\n').next().unwrap_or_default();
        (before.matches('\n').count() + 1, line.chars().count() + 1)
    };
    let tree = ProgramTree::read(program).unwrap();
    let (mut operators, mut numbers) = (Operators::new(), BTreeSet::new());
    for part in &tree.parts {
        match part {
            Part::Operator { at, left, .. } => {
                let sign = &program[at.clone()];
                // the engine's tree has no parentheses, and keeps `&&` otherwise
                let open = program[left.clone()]
                    .chars()
                    .take_while(|c| *c == '(')
                    .count();
                if !matches!(sign, "&&" | "||") {
                    operators.insert(place(at.start), (sign.to_owned(), place(left.start + open)));
                }
            }
            Part::Number { at, .. } => {
                numbers.insert(place(at.start));
            }
            _ => {}
        }
    }
    (operators, numbers)
}

#[test]
fn parts_are_where_the_engine_has_them() {
    let programs = [
        include_str!("../../../../../reference/00-step-response/solution.rhai"),
        include_str!("../../../../../reference/01-kinematics/solution.rhai"),
        include_str!("../../../../../reference/02-jacobian-velocity/solution.rhai"),
        include_str!("../../../../../reference/03-knock-with-position/solution.rhai"),
        include_str!("../../../../../reference/04-knock-with-velocity/solution.rhai"),
        "let a = -b ** 2 + c[1 + d].e(f * g)[0] - #{ h: 1 + 2, \"i\": [3 * j] }.h;",
        "for k in 0..3 { let l = if k > 1 { k * 2 } else if k == 0 { 7 } else { k - 1 } + 4; }",
        "let m = 3; while m > 0 { m -= 1; if m == 1 { break; } } do { m += 2; } while m < 9;",
        "switch n { 1 => o + 1, 2 if p > 2 => { q * 3 } _ => r / 4 } -5;",
        "try { s(1 - 2); } catch (t) { u + 1; }\nfn v(w) { return w % 2 == 1 || w >= 4 && 5 <= w; }",
        "fn x() { y() + `a ${z + 1} b ${2 * c} d` + 6 }",
        "loop { let a = [1, 2 + 3][0..2]; if (a + (b - c)) * d != 4 { return; } }",
    ];
    for program in programs {
        let (operators, numbers) = of_engine(program);
        let (found, found_numbers) = of_parts(program);
        assert_eq!(found, operators, "{program}");
        // the engine keeps the values of cases as keys of a table
        if !program.starts_with("switch") {
            assert_eq!(found_numbers, numbers, "{program}");
        }
        assert!(!operators.is_empty());
    }
}
