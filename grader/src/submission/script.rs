//! The script as a [`Controller`]: opened once per task, called once per case or control period.

use std::cell::RefCell;
use std::collections::BTreeSet;
use std::rc::Rc;

use rhai::{
    AST, ASTNode, Caches, CallFnOptions, Dynamic, Engine, EvalAltResult, Expr, Map, Position,
    Scope, Stmt,
};

use super::budget::{Meter, place};
use super::convert;
use super::engine::{self, Constants};
use super::hints::{ENTRY_POINTS, Names};
use super::list;
use super::mistake::{Context, Problem, raise};
use crate::controller::{
    Answer, Budget, Call, Controller, Mistake, Opening, RobotFacts, Stop, Value,
};

/// A script that has been read and may be called.
pub struct ScriptController {
    engine: Engine,
    ast: AST,
    source: String,
    meter: Rc<Meter>,
    names: Names,
    /// What `this` is: a map that is kept between calls.
    memory: Dynamic,
    task: String,
    robot: CachedRobot,
    observation: Map,
}

/// The map `robot`, made again only for another robot.
struct CachedRobot {
    facts: RobotFacts,
    map: Dynamic,
}

impl CachedRobot {
    fn new(facts: &RobotFacts) -> Self {
        Self {
            facts: facts.clone(),
            map: convert::robot(facts),
        }
    }

    fn of(&mut self, facts: &RobotFacts) -> Dynamic {
        if self.facts != *facts {
            *self = Self::new(facts);
        }
        self.map.clone()
    }
}

impl ScriptController {
    /// Reads a script and runs what stands outside of its functions.
    ///
    /// # Errors
    /// [`Stop::DidNotBuild`] if it is no program, [`Stop::OverBudget`] if it is too long or too deep, and whatever its top level
    /// runs into.
    pub fn open(opening: &Opening) -> Result<Self, Stop> {
        let budgets = &opening.budgets;
        if opening.source.len() as u64 > budgets.source_bytes {
            return Err(Stop::OverBudget {
                budget: Budget::SourceBytes,
                limit: budgets.source_bytes,
                place: None,
            });
        }
        let meter = Rc::new(Meter::new(budgets.clone()));
        let constants: Constants = Rc::new(RefCell::default());
        let (engine, mut names) = engine::build(budgets, &meter, &constants);
        let observation = convert::observation_template(opening);
        let robot = CachedRobot::new(&opening.robot);
        names.observation = observation.keys().map(ToString::to_string).collect();
        names.robot = robot
            .map
            .as_map_ref()
            .map(|map| map.keys().map(ToString::to_string).collect())
            .unwrap_or_default();

        let context = Context {
            source: &opening.source,
            meter: &meter,
            names: &names,
        };
        let ast = engine
            .compile(&opening.source)
            .map_err(|error| context.parsing(&error))?;
        refuse_known_slips(&ast)?;
        collect_names(&ast, &mut names);

        let mut script = Self {
            engine,
            ast,
            source: opening.source.clone(),
            meter,
            names,
            memory: Dynamic::from_map(Map::new()),
            task: opening.task.clone(),
            robot,
            observation,
        };
        script.run_top_level(&constants)?;
        Ok(script)
    }

    /// Runs the statements outside of functions one by one, so that a constant is known to the functions the next one calls.
    #[expect(
        deprecated,
        reason = "the engine's other ways run all statements at once"
    )]
    fn run_top_level(&mut self, constants: &Constants) -> Result<(), Stop> {
        self.meter.start();
        let mut global = self.engine.new_global_runtime_state();
        global.lib.push(self.ast.shared_lib().clone());
        let mut caches = Caches::new();
        let mut scope = Scope::new();
        for statement in self.ast.statements() {
            self.engine
                .eval_statements_raw(
                    &mut global,
                    &mut caches,
                    &mut scope,
                    std::slice::from_ref(statement),
                )
                .map_err(|error| self.context().running(&error))?;
            if let Stmt::Var(declared, ..) = statement {
                let name = declared.0.as_str();
                if let (Some(true), Some(value)) = (scope.is_constant(name), scope.get(name)) {
                    constants
                        .borrow_mut()
                        .insert(name.to_owned(), value.clone());
                    self.names.constants.insert(name.to_owned());
                }
            }
        }
        self.meter.finish();
        Ok(())
    }

    fn context(&self) -> Context<'_> {
        Context {
            source: &self.source,
            meter: &self.meter,
            names: &self.names,
        }
    }

    /// Lines printed and values plotted by a call that stopped, which has no answer to carry them.
    pub fn unanswered(&mut self) -> (Vec<String>, Vec<(String, f64)>) {
        self.meter.take_output()
    }

    fn call_function(
        &mut self,
        name: &str,
        arguments: impl IntoIterator<Item = Dynamic>,
    ) -> Result<Value, Stop> {
        let arguments: Vec<Dynamic> = arguments.into_iter().collect();
        let options = CallFnOptions::new()
            .eval_ast(false)
            .bind_this_ptr(&mut self.memory);
        let result = self.engine.call_fn_with_options::<Dynamic>(
            options,
            &mut Scope::new(),
            &self.ast,
            name,
            arguments,
        );
        let value = result.map_err(|error| self.context().running(&error))?;
        self.check_memory()?;
        convert::to_value(&self.meter, &value).map_err(|problem| self.after_call(problem))
    }

    /// Holds `this` to the budgets of size as a whole, vectors included.
    fn check_memory(&self) -> Result<(), Stop> {
        if !self.memory.is_map() {
            return Err(Stop::Crashed(Mistake {
                message: "`this` is no map any more".to_owned(),
                place: None,
                help: Some("keep values under names: this.count = 0".to_owned()),
            }));
        }
        list::weigh(&self.meter, &self.memory).map_err(|problem| self.after_call(problem))
    }

    fn after_call(&self, problem: Problem) -> Stop {
        let error: Box<EvalAltResult> = raise(problem, Position::NONE);
        self.context().running(&error)
    }

    fn missing(&self, name: &str) -> Option<Stop> {
        let (_, parameters) = ENTRY_POINTS.iter().find(|(entry, _)| *entry == name)?;
        let found = self
            .names
            .functions
            .iter()
            .any(|(known, got)| known == name && got.len() == parameters.len());
        let is_optional =
            name == "init" && !self.names.functions.iter().any(|(known, _)| known == name);
        (!found && !is_optional).then(|| Stop::Missing {
            function: format!("{name}({})", parameters.join(", ")),
            help: self.names.missing(name, parameters),
        })
    }
}

impl Controller for ScriptController {
    fn call(&mut self, call: &Call) -> Result<Answer, Stop> {
        let name = match call {
            Call::ForwardKinematics { .. } => "forward_kinematics",
            Call::InverseKinematics { .. } => "inverse_kinematics",
            Call::Init => "init",
            Call::Control(_) => "control",
        };
        if let Some(missing) = self.missing(name) {
            return Err(missing);
        }
        self.meter.start();
        let vector =
            |elements: &[f64]| Dynamic::from(super::vector::Vector::new(elements.to_vec()));
        let value = match call {
            Call::ForwardKinematics { robot, q } => {
                let robot = self.robot.of(robot);
                self.call_function(name, [robot, vector(q)])
            }
            Call::InverseKinematics { robot, position_m } => {
                let robot = self.robot.of(robot);
                self.call_function(name, [robot, vector(position_m)])
            }
            Call::Init if !self.names.functions.iter().any(|(known, _)| known == name) => {
                Ok(Value::Nothing)
            }
            Call::Init => {
                let robot = self.robot.map.clone();
                let task = self.task.as_str().into();
                self.call_function(name, [robot, task])
            }
            Call::Control(observation) => {
                let observation = convert::observation(&self.observation, observation);
                self.call_function(name, [observation])
            }
        };
        let operations = self.meter.finish();
        let value = value?;
        let (log, plots) = self.meter.take_output();
        Ok(Answer {
            value,
            log,
            plots,
            operations,
        })
    }
}

/// Refuses what the engine would run with another meaning than the student's.
fn refuse_known_slips(ast: &AST) -> Result<(), Stop> {
    let mut slip = None;
    ast.walk(&mut |path| {
        slip = match path.last() {
            Some(ASTNode::Expr(Expr::FnCall(call, position))) if call.name == "^" => Some((
                "`^` is not a power here",
                "use ** for powers: x ** 2",
                *position,
            )),
            Some(ASTNode::Expr(Expr::Index(index, _, position)))
                if matches!(index.rhs, Expr::IntegerConstant(index, _) if index < 0) =>
            {
                Some((
                    "an index is negative",
                    "counting starts at 0; the last is v[len(v) - 1]",
                    *position,
                ))
            }
            _ => None,
        };
        slip.is_none()
    });
    match slip {
        None => Ok(()),
        Some((message, help, position)) => Err(Stop::DidNotBuild(Mistake {
            message: message.to_owned(),
            place: place(position),
            help: Some(help.to_owned()),
        })),
    }
}

/// Notes what the file declares.
fn collect_names(ast: &AST, names: &mut Names) {
    for function in ast.iter_functions() {
        let parameters: Vec<String> = function.params.iter().map(ToString::to_string).collect();
        names.local.extend(parameters.iter().cloned());
        match (function.name, parameters.first()) {
            ("control", Some(first)) => {
                names.observation_parameters.insert(first.clone());
            }
            ("forward_kinematics" | "inverse_kinematics" | "init", Some(first)) => {
                names.robot_parameters.insert(first.clone());
            }
            _ => {}
        }
        names.functions.push((function.name.to_owned(), parameters));
    }
    // the engine keeps functions in an order of its own
    names.functions.sort();
    let mut local = BTreeSet::new();
    let mut top_level = BTreeSet::new();
    for statement in ast.statements() {
        if let Stmt::Var(declared, ..) = statement {
            top_level.insert(declared.0.as_str().to_owned());
        }
    }
    ast.walk(&mut |path| {
        if let Some(ASTNode::Stmt(Stmt::Var(declared, ..))) = path.last() {
            local.insert(declared.0.as_str().to_owned());
        }
        true
    });
    names.local.extend(local);
    names.top_level = top_level;
}
