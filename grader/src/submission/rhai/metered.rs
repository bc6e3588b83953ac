//! The script as it runs: what the engine does without counting it is charged.
//!
//! The engine copies what is read out of `this`, compares a value with every arm of a `switch`, makes whole lists and catches mistakes
//! in one operation each. So the tree of a script is rewritten before it runs: such an expression is put into another one, which the
//! engine has evaluated here, and here it is charged. The engine counts the other one, too, which is taken back: so a script in which
//! nothing is large takes the operations that it has steps. Operators are evaluated here for another reason, speed, and count as before.

use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;

use rhai::{
    AST, ASTFlags, ASTNode, Dynamic, Engine, EvalAltResult, EvalContext, Expr, Expression,
    FnCallExpr, INT, Module, Position, ScriptFuncDef, Shared, Stmt,
};

use super::arithmetic::{self, Apply};
use super::budget::Meter;
use super::hints::Names;
use super::mistake::{Problem, raise};
use super::weight::{charge_for_copy, parts};
use crate::submission::controller::Stop;

/// An operator between two values. The engine would look it up among all functions by the types of both, every time.
///
/// No script can write this name or one of the next ones. Names are searched in order: those that are used most come first.
const OPERATOR: &str = "!operator";

/// A value that is copied out of `this`.
const COPIED: &str = "!value out of `this`";

/// A list or map of constants, which is made element by element: where it is an argument, the engine makes it in one operation.
const WRITTEN_OUT: &str = "a written list";

/// A value before which the engine looks at something many times: at the arms of a `switch` for what it chooses, at functions for the
/// last argument of a call.
const LOOKED_FOR: &str = "a search";

/// A value that `this` gets, after which the engine looks through all of `this`.
const KEPT: &str = "a value for `this`";

/// What comes first where a mistake is caught.
const CAUGHT: &str = "a caught mistake";

/// The body of a rewritten function. It stands in the source below, which is read after the script's.
const BODY: &str = "body_of_the_function";

/// A list or map of this many constants is written out.
const LEAST_WRITTEN_OUT: usize = 16;

/// Up to this many arms of a `switch` are tried in one operation.
const FEW_ARMS: usize = 64;

/// With this many arguments or more, a function that is not defined is looked for by every combination of "this type" and "any type", of
/// the first ones: each takes as long as looking at so many parts.
const MANY_ARGUMENTS: usize = 5;
const MOST_COMBINED: usize = 16;
const OF_A_COMBINATION: usize = 6;

/// The operations that a mistake takes which is caught.
const OF_A_MISTAKE: u64 = 8;

type Evaluated = Result<Dynamic, Box<EvalAltResult>>;

/// The script `ast` with charges in it, for this engine, which reads no other script afterwards.
///
/// # Errors
/// [`Stop::GraderFault`], which no script causes.
pub(super) fn metered(
    engine: &mut Engine,
    meter: &Rc<Meter>,
    ast: &AST,
    names: &Names,
) -> Result<AST, Stop> {
    let mut statements = ast.statements().to_vec();
    let mut bodies = Vec::new();
    let mut functions: Vec<(Shared<ScriptFuncDef>, Option<usize>)> = Vec::new();
    let mut rewriting = Rewriting::new(names);
    rewriting.statements(&mut statements);
    for function in ast.iter_fn_def() {
        rewriting.is_changed = false;
        let mut body = statements_of(function);
        rewriting.statements(&mut body);
        let index = rewriting.is_changed.then(|| {
            bodies.push(block(body, function.body.start_position()));
            bodies.len() - 1
        });
        functions.push((Rc::clone(function), index));
    }
    let count = bodies.len();
    register(engine, meter, bodies)
        .map_err(|error| Stop::GraderFault(format!("the meter: {error}")))?;
    let stand_ins = stand_ins(engine, count)?;
    let mut module = Module::new();
    for (function, index) in functions {
        match index.and_then(|index| stand_ins.get(index)) {
            None => module.set_script_fn(function),
            // only what is read from a source can be the body of a function
            Some(stand_in) => module.set_script_fn(ScriptFuncDef {
                body: stand_in.body.clone(),
                ..(*function).clone()
            }),
        };
    }
    Ok(AST::new(statements, module))
}

/// The statements of a function, which only a walk through them shows.
fn statements_of(function: &Shared<ScriptFuncDef>) -> Vec<Stmt> {
    let mut module = Module::new();
    module.set_script_fn(Rc::clone(function));
    let alone = AST::new([], module);
    let mut statements = Vec::new();
    alone.walk(&mut |path| {
        if let [ASTNode::Stmt(statement)] = path {
            statements.push((*statement).clone());
        }
        true
    });
    statements
}

/// Statements as a block in braces that begins at a position.
fn block(statements: Vec<Stmt>, begins: Position) -> Expr {
    let block = rhai::StmtBlock::new(statements, begins, begins);
    Expr::Stmt(Box::new(block))
}

/// Functions whose bodies are the rewritten ones, in their order.
fn stand_ins(engine: &Engine, count: usize) -> Result<Vec<Shared<ScriptFuncDef>>, Stop> {
    let source: String = (0..count)
        .map(|index| format!("fn f{index}() {{ {BODY} {index} }}\n"))
        .collect();
    let ast = engine
        .compile(source)
        .map_err(|error| Stop::GraderFault(format!("the bodies of functions: {error}")))?;
    let mut found: Vec<Shared<ScriptFuncDef>> = ast.iter_fn_def().cloned().collect();
    found.sort_by_key(|function| function.body.start_position().line());
    Ok(found)
}

/// Registers how the expressions are evaluated that rewriting puts in.
fn register(engine: &mut Engine, meter: &Rc<Meter>, bodies: Vec<Expr>) -> Result<(), String> {
    let own = Rc::clone(meter);
    engine
        .register_custom_syntax([BODY, "$int$"], false, move |context, inputs| {
            // a statement and an expression that no script has
            own.uncount(2);
            let index = inputs[0].get_literal_value::<INT>();
            let body = index.and_then(|index| bodies.get(usize::try_from(index).ok()?));
            match body {
                Some(body) => context.eval_expression_tree(&Expression::from(body)),
                None => Ok(Dynamic::UNIT),
            }
        })
        .map_err(|error| error.to_string())?;
    hook(engine, meter, COPIED, |meter, context, inputs, _| {
        meter.uncount(1);
        let value = context.eval_expression_tree(&inputs[0])?;
        charge(meter, charge_for_copy(meter, &value), inputs)?;
        Ok(value)
    })?;
    hook(engine, meter, WRITTEN_OUT, |meter, context, inputs, _| {
        meter.uncount(1);
        context.eval_expression_tree(&inputs[0])
    })?;
    hook(
        engine,
        meter,
        LOOKED_FOR,
        |meter, context, inputs, looks| {
            meter.uncount(1);
            let looks = looks.as_int().unwrap_or_default();
            let looks = usize::try_from(looks).unwrap_or_default();
            charge(meter, meter.glance(looks), inputs)?;
            context.eval_expression_tree(&inputs[0])
        },
    )?;
    hook(engine, meter, KEPT, |meter, context, inputs, _| {
        meter.uncount(1);
        let value = context.eval_expression_tree(&inputs[0])?;
        let kept = context.this_ptr().map_or(0, parts);
        charge(meter, meter.glance(kept), inputs)?;
        Ok(value)
    })?;
    hook(engine, meter, OPERATOR, |meter, context, inputs, known| {
        let [left, right] = inputs else {
            return Ok(Dynamic::UNIT);
        };
        let Some(Operator {
            apply,
            position,
            is_lent,
        }) = known.read_lock::<Operator>().map(|known| known.clone())
        else {
            return Ok(Dynamic::UNIT);
        };
        // a variable on the left is lent to the operator, after the right was evaluated
        let (left, right) = if is_lent {
            let right = context.eval_expression_tree(right)?;
            (context.eval_expression_tree(left)?, right)
        } else {
            let left = context.eval_expression_tree(left)?;
            (left, context.eval_expression_tree(right)?)
        };
        let counted = meter.count_one();
        meter.at(position);
        counted
            .and_then(|()| meter.glance(parts(&left)))
            .and_then(|()| apply(meter, &left, &right))
            .map_err(|problem| raise(problem, position))
    })?;
    hook(engine, meter, CAUGHT, |meter, context, inputs, is_named| {
        charge(meter, meter.operations(OF_A_MISTAKE), inputs)?;
        // the variable is the newest, and holds a copy of what was thrown
        let thrown = context.scope().iter_raw().next();
        if let (Ok(true), Some((_, _, thrown))) = (is_named.as_bool(), thrown) {
            charge(meter, charge_for_copy(meter, thrown), inputs)?;
        }
        Ok(Dynamic::UNIT)
    })
}

type Evaluate =
    fn(&Meter, &mut EvalContext<'_, '_, '_, '_, '_, '_>, &[Expression<'_>], &Dynamic) -> Evaluated;

/// Registers how the expressions with a name are evaluated.
fn hook(
    engine: &mut Engine,
    meter: &Rc<Meter>,
    name: &str,
    evaluate: Evaluate,
) -> Result<(), String> {
    let meter = Rc::clone(meter);
    let evaluate =
        move |context: &mut EvalContext<'_, '_, '_, '_, '_, '_>,
              inputs: &[Expression<'_>],
              state: &Dynamic| evaluate(&meter, context, inputs, state);
    engine
        .register_custom_syntax_handler(name, false, evaluate)
        .map(|_| ())
}

/// What was charged, and where: the engine counts some operations without a position.
fn charge(
    meter: &Meter,
    charged: Result<(), Problem>,
    inputs: &[Expression<'_>],
) -> Result<(), Box<EvalAltResult>> {
    let position = inputs.first().map_or(Position::NONE, Expression::position);
    meter.at(position);
    charged.map_err(|problem| raise(problem, position))
}

/// What a chain of `.` and `[]` ends in.
#[derive(Clone, Copy, PartialEq, Eq)]
enum End {
    Property,
    Index,
    Call,
}

/// An operator in a script.
#[derive(Clone)]
struct Operator {
    apply: Apply,
    position: Position,
    /// Whether its left side is a variable.
    is_lent: bool,
}

/// The rewriting of a script.
struct Rewriting<'n> {
    /// Built-in functions, with their numbers of parameters.
    built_in: &'n BTreeMap<String, BTreeSet<usize>>,
    /// The script's functions, with theirs.
    own: BTreeMap<&'n str, BTreeSet<usize>>,
    is_changed: bool,
}

impl<'n> Rewriting<'n> {
    fn new(names: &'n Names) -> Self {
        let mut own: BTreeMap<&str, BTreeSet<usize>> = BTreeMap::new();
        for (name, parameters) in &names.functions {
            own.entry(name).or_default().insert(parameters.len());
        }
        Self {
            built_in: &names.built_in,
            own,
            is_changed: false,
        }
    }

    fn statements(&mut self, statements: &mut [Stmt]) {
        for statement in statements {
            self.statement(statement);
        }
    }

    fn statement(&mut self, statement: &mut Stmt) {
        match statement {
            Stmt::Var(declared, ..) => self.value(&mut declared.1),
            Stmt::Expr(expr) => self.value(expr),
            Stmt::BreakLoop(Some(expr), ..) | Stmt::Return(Some(expr), ..) => self.value(expr),
            Stmt::FnCall(call, _) => self.arguments(call),
            Stmt::Block(block) => self.statements(block.statements_mut()),
            Stmt::If(flow, _) | Stmt::While(flow, _) | Stmt::Do(flow, ..) => {
                self.value(&mut flow.expr);
                self.statements(flow.body.statements_mut());
                self.statements(flow.branch.statements_mut());
            }
            Stmt::For(names, _) => {
                let flow = &mut names.2;
                self.value_from_its_beginning(&mut flow.expr);
                self.statements(flow.body.statements_mut());
            }
            Stmt::TryCatch(flow, _) => {
                self.statements(flow.body.statements_mut());
                self.statements(flow.branch.statements_mut());
                let is_named = !flow.expr.is_unit();
                let mut caught = Expr::Unit(flow.branch.position());
                self.put(&mut caught, CAUGHT, is_named.into());
                let caught = Stmt::Expr(Box::new(caught));
                flow.branch.statements_mut().insert(0, caught);
            }
            Stmt::Assignment(assigned) => {
                let sides = &mut assigned.1;
                self.value(&mut sides.rhs);
                let end = self.links(&mut sides.lhs);
                if end == Some(End::Property) && is_of_this(&sides.lhs) {
                    self.put(&mut sides.rhs, KEPT, Dynamic::UNIT);
                }
            }
            Stmt::Switch(choice, _) => {
                let (expr, arms) = &mut **choice;
                self.value(expr);
                for arm in &mut arms.expressions {
                    self.value(&mut arm.lhs);
                    self.value(&mut arm.rhs);
                }
                let same = arms.cases.values().map(|case| case.blocks.len()).max();
                let tried = arms.ranges.len() + same.unwrap_or_default();
                if tried > FEW_ARMS {
                    self.put(expr, LOOKED_FOR, (tried as INT).into());
                }
            }
            _ => {}
        }
    }

    /// An expression whose value is used.
    fn value(&mut self, expr: &mut Expr) {
        match expr {
            Expr::ThisPtr(_) => self.put(expr, COPIED, Dynamic::UNIT),
            Expr::Dot(..) | Expr::Index(..) => {
                let end = self.links(expr);
                if is_of_this(expr) && end != Some(End::Call) {
                    self.put(expr, COPIED, Dynamic::UNIT);
                }
            }
            Expr::Array(..) | Expr::Map(..)
                if expr.is_constant() && constants(expr) >= LEAST_WRITTEN_OUT =>
            {
                self.put(expr, WRITTEN_OUT, Dynamic::UNIT);
            }
            Expr::Array(elements, _) | Expr::InterpolatedString(elements, _) => {
                elements.iter_mut().for_each(|element| self.value(element));
            }
            Expr::Map(entries, _) => {
                let entries = entries.0.iter_mut();
                entries.for_each(|(_, entry)| self.value(entry));
            }
            Expr::And(parts, _) | Expr::Or(parts, _) | Expr::Coalesce(parts, _) => {
                parts.iter_mut().for_each(|part| self.value(part));
            }
            Expr::FnCall(call, position) => {
                self.arguments(call);
                let position = *position;
                if let Some(operator) = operator(call, position) {
                    let inputs = std::mem::take(&mut call.args);
                    self.put_all(expr, inputs, OPERATOR, Dynamic::from(operator), position);
                }
            }
            Expr::Stmt(block) => self.statements(block.statements_mut()),
            _ => {}
        }
    }

    /// The same where messages about the value give the position of its beginning.
    fn value_from_its_beginning(&mut self, expr: &mut Expr) {
        if let Expr::And(parts, _) | Expr::Or(parts, _) | Expr::Coalesce(parts, _) = expr {
            // it begins where its first part does
            for (index, part) in parts.iter_mut().enumerate() {
                match index {
                    0 => self.value_from_its_beginning(part),
                    _ => self.value(part),
                }
            }
            return;
        }
        let begins = expr.start_position();
        self.value(expr);
        if let Expr::Custom(_, position) = expr {
            *position = begins;
        }
    }

    /// The arguments of a call. A built-in is lent its first one, and a function of the script gets a copy.
    fn arguments(&mut self, call: &mut FnCallExpr) {
        let name = call.name.as_str();
        let is_built_in = self.built_in.contains_key(name) && !self.own.contains_key(name);
        let lends = (call.is_operator_call() || is_built_in) && !call.capture_parent_scope;
        for (index, argument) in call.args.iter_mut().enumerate() {
            let is_lent = index == 0 && lends && matches!(argument, Expr::ThisPtr(_));
            if !is_lent {
                self.value(argument);
            }
        }
        self.search(call, 0);
    }

    /// Charges for the search for a function that is not defined; a method has one more argument before those in brackets.
    fn search(&mut self, call: &mut FnCallExpr, before: usize) {
        let all = before + call.args.len();
        let is_one_of = |counts: Option<&BTreeSet<usize>>, count: usize| {
            counts.is_some_and(|counts| counts.contains(&count))
        };
        let name = call.name.as_str();
        if all < MANY_ARGUMENTS
            || is_one_of(self.own.get(name), call.args.len())
            || is_one_of(self.built_in.get(name), all)
        {
            return;
        }
        let looks = OF_A_COMBINATION << all.min(MOST_COMBINED);
        if let Some(last) = call.args.last_mut() {
            self.put(last, LOOKED_FOR, (looks as INT).into());
        }
    }

    /// The values in a chain such as `a.b[i].f(x)`, and what it ends in; `None` if it is no chain.
    fn links(&mut self, chain: &mut Expr) -> Option<End> {
        let is_index = matches!(chain, Expr::Index(..));
        let (Expr::Dot(link, flags, _) | Expr::Index(link, flags, _)) = chain else {
            return None;
        };
        if !matches!(link.lhs, Expr::ThisPtr(_) | Expr::Variable(..)) {
            self.value(&mut link.lhs);
        }
        let ends = flags.contains(ASTFlags::BREAK);
        Some(self.next_links(&mut link.rhs, is_index, ends))
    }

    /// The links after a `.` or a `[`; if that one `ends` the chain, what comes next is an index and no link.
    fn next_links(&mut self, next: &mut Expr, is_index: bool, ends: bool) -> End {
        let is_next_index = matches!(next, Expr::Index(..));
        match next {
            Expr::Dot(link, flags, _) | Expr::Index(link, flags, _) if !ends => {
                self.link(&mut link.lhs, is_index);
                let ends = flags.contains(ASTFlags::BREAK);
                self.next_links(&mut link.rhs, is_next_index, ends)
            }
            last => self.link(last, is_index),
        }
    }

    /// One link: an index, a property or the call of a method.
    fn link(&mut self, link: &mut Expr, is_index: bool) -> End {
        match link {
            index if is_index => {
                self.value_from_its_beginning(index);
                End::Index
            }
            Expr::MethodCall(call, _) => {
                call.args
                    .iter_mut()
                    .for_each(|argument| self.value(argument));
                self.search(call, 1);
                End::Call
            }
            _ => End::Property,
        }
    }

    /// Puts an expression into one that is evaluated here.
    fn put(&mut self, expr: &mut Expr, name: &'static str, state: Dynamic) {
        let position = expr.position();
        let inner = std::mem::take(expr);
        self.put_all(expr, [inner], name, state, position);
    }

    /// Puts several.
    fn put_all(
        &mut self,
        expr: &mut Expr,
        inputs: impl IntoIterator<Item = Expr>,
        name: &'static str,
        state: Dynamic,
        position: Position,
    ) {
        self.is_changed = true;
        *expr = Expr::Custom(
            Box::new(rhai::CustomExpr {
                inputs: inputs.into_iter().collect(),
                tokens: [name.into()].into_iter().collect(),
                state,
                scope_may_be_changed: false,
                self_terminated: false,
            }),
            position,
        );
    }
}

/// The operator of a call between two values; `this` is left to the engine, which lends it.
fn operator(call: &FnCallExpr, position: Position) -> Option<Operator> {
    let [left, right] = call.args.as_slice() else {
        return None;
    };
    let is_this = |side: &Expr| matches!(side, Expr::ThisPtr(_));
    if !call.is_operator_call() || call.capture_parent_scope || is_this(left) || is_this(right) {
        return None;
    }
    Some(Operator {
        apply: arithmetic::between(call.name.as_str())?,
        position,
        is_lent: matches!(left, Expr::Variable(..)),
    })
}

/// Whether a chain begins with `this`.
fn is_of_this(chain: &Expr) -> bool {
    matches!(chain, Expr::Dot(link, ..) | Expr::Index(link, ..) if matches!(link.lhs, Expr::ThisPtr(_)))
}

/// The constants in a list or map of constants, and the lists and maps.
fn constants(expr: &Expr) -> usize {
    match expr {
        Expr::Array(elements, _) => 1 + elements.iter().map(constants).sum::<usize>(),
        Expr::Map(entries, _) => {
            1 + entries
                .0
                .iter()
                .map(|(_, entry)| constants(entry))
                .sum::<usize>()
        }
        _ => 1,
    }
}
