//! The script as a [`Controller`]: opened once per task, called once per case or control period.

use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;

use rhai::{
    AST, ASTNode, Caches, Dynamic, Engine, EvalAltResult, Expr, GlobalRuntimeState, Map, Position,
    Scope, Stmt,
};

use super::budget::{Meter, place};
use super::convert;
use super::engine::{self, ARGUMENTS, Globals, MEMORY};
use super::hints::Names;
use super::metered::metered;
use super::mistake::{Context, Problem, raise};
use super::places::Places;
use super::slips;
use super::unknown::unknown;
use super::weight;
use crate::submission::controller::{
    Answer, AskedFunction, Budget, Budgets, Call, Controller, ENTRY_POINTS, Mistake, Namesake,
    Opening, RobotFacts, Said, SensorFacts, SourcePosition, Stop, Value, entry_parameters,
};
use crate::submission::robot_model::Model;

/// The stack size of a thread that runs scripts.
///
/// The engine is recursive in nested functions and expressions. The deepest script that the default budgets allow needs 4 MiB in an
/// optimised build, and several times as much in a debug build.
pub const STACK_BYTES: usize = 32 << 20;

/// A script that has been read and may be called.
pub struct ScriptController {
    engine: Engine,
    ast: AST,
    source: String,
    meter: Rc<Meter>,
    globals: Rc<Globals>,
    names: Names,
    run: Run,
    task: String,
    robot: CachedRobot,
    /// The robot model of granted functions, if any is granted.
    model: Option<Rc<Model>>,
    observation: Map,
    sensors: Vec<SensorFacts>,
    /// One statement for each function that may be called: `memory.control(argument)`.
    ///
    /// A method call, because the engine gives only methods a `this`.
    statements: BTreeMap<String, AST>,
    /// The lab's own function that is called, if any.
    asked: Option<AskedFunction>,
}

/// The engine's state, kept from call to call so that it need not look up every operator and built-in again.
struct Run {
    global: GlobalRuntimeState,
    caches: Caches,
    /// The scope with the variable [`MEMORY`].
    scope: Scope<'static>,
}

/// The map `robot`, created again only for another robot.
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

/// What a script becomes before it runs: [`metered()`].
pub(super) type Rewrite = fn(&mut Engine, &Rc<Meter>, &AST, &Names) -> Result<AST, Stop>;

impl ScriptController {
    /// Compiles a script and runs its statements outside of functions.
    ///
    /// # Errors
    /// [`Stop::DidNotBuild`] if it does not compile, [`Stop::OverBudget`] if it is too long or too deep, and any stop of its top-level
    /// statements.
    pub fn open(opening: &Opening) -> Result<Self, Stop> {
        Self::rewritten(opening, metered)
    }

    /// The same with another rewriting: a test runs the script as it was read.
    pub(super) fn rewritten(opening: &Opening, rewrite: Rewrite) -> Result<Self, Stop> {
        let source = opening.program.text();
        let budgets = &opening.budgets;
        if source.len() as u64 > budgets.source_bytes {
            return Err(Stop::OverBudget {
                budget: Budget::SourceBytes,
                limit: budgets.source_bytes,
                place: None,
                function: None,
            });
        }
        let meter = Rc::new(Meter::new(budgets.clone()));
        let globals = Rc::new(Globals::default());
        let model = match &opening.granted {
            Some(granted) => Some(Rc::new(Model::new(granted, &opening.robot)?)),
            None => None,
        };
        let grants = opening.granted.as_ref().map(|g| g.functions.as_slice());
        let granted = model.as_ref().zip(grants);
        let (mut engine, mut names) = engine::build(budgets, &meter, &globals, granted);
        let observation = convert::observation_template(opening);
        let robot = CachedRobot::new(&opening.robot);
        note_fields(&mut names, &observation, &opening.target, &robot);
        names.sensors = opening
            .sensors
            .iter()
            .map(|sensor| sensor.name.clone())
            .collect();

        // a byte order mark, which editors do not show
        let source = source.trim_start_matches('\u{feff}');
        let context = Context {
            source,
            meter: &meter,
            names: &names,
            beginning: None,
        };
        if let Some(fence) = slips::chat_fence(source) {
            let mistake = context.between_fences(&engine, fence);
            return Err(Stop::DidNotBuild(mistake));
        }
        let ast = engine
            .compile(source)
            .map_err(|error| context.not_compiled(&engine, &error))?;
        refuse_known_slips(&ast)?;
        collect_names(&ast, &mut names, opening.function.as_ref());
        globals.functions.set(names.functions.len());
        let ast = rewrite(&mut engine, &meter, &ast, &names)?;

        let mut global = engine.new_global_runtime_state();
        global.lib.push(ast.shared_lib().clone());
        let mut scope = Scope::new();
        scope.push_dynamic(MEMORY, Dynamic::from_map(Map::new()));
        let statements = call_statements(&engine, &scope, &names, opening.function.as_ref())?;
        let mut caches = Caches::new();
        caches.push_fn_resolution_cache();
        let mut script = Self {
            engine,
            ast,
            source: source.to_owned(),
            meter,
            globals,
            names,
            run: Run {
                global,
                caches,
                scope,
            },
            task: opening.task.clone(),
            robot,
            model,
            observation,
            sensors: opening.sensors.clone(),
            statements,
            asked: opening.function.clone(),
        };
        script.run_top_level()?;
        Ok(script)
    }

    /// Runs the statements outside of functions one by one, so that a constant is known to the functions the next one calls.
    #[expect(
        deprecated,
        reason = "the engine's other ways run all statements at once"
    )]
    fn run_top_level(&mut self) -> Result<(), Stop> {
        self.meter.start();
        let mut scope = Scope::new();
        for statement in self.ast.statements() {
            // constants are in the scope; the value of a bare expression is not used
            let _ = self
                .engine
                .eval_statements_raw(
                    &mut self.run.global,
                    &mut self.run.caches,
                    &mut scope,
                    std::slice::from_ref(statement),
                )
                .map_err(|error| {
                    let mut context = self.context(None);
                    context.beginning = place(statement.position());
                    context.running(&error)
                })?;
            if let Stmt::Var(declared, ..) = statement {
                let name = declared.0.as_str();
                if let (Some(true), Some(value)) = (scope.is_constant(name), scope.get(name)) {
                    let mut constants = self.globals.constants.borrow_mut();
                    constants.insert(name.to_owned(), value.clone());
                    self.names.constants.insert(name.to_owned());
                }
            }
        }
        self.meter.finish();
        Ok(())
    }

    /// The context for messages about a run of `function` or of the top level.
    fn context(&self, function: Option<&str>) -> Context<'_> {
        let places = &self.names.places;
        let body = function.and_then(|name| places.body(name, self.parameters_of(name).len()));
        Context {
            source: &self.source,
            meter: &self.meter,
            names: &self.names,
            beginning: body,
        }
    }

    /// The parameters of a function that the grader calls; empty for others.
    fn parameters_of(&self, name: &str) -> Vec<&str> {
        match &self.asked {
            Some(asked) if asked.name == name => {
                asked.parameters.iter().map(String::as_str).collect()
            }
            _ => entry_parameters(name).to_vec(),
        }
    }

    #[expect(
        deprecated,
        reason = "the engine's other ways look up every operator and built-in again at each call"
    )]
    fn call_function(
        &mut self,
        name: &str,
        arguments: impl IntoIterator<Item = Dynamic>,
    ) -> Result<Value, Stop> {
        let Some(statement) = self.statements.get(name) else {
            return Err(Stop::GraderFault(format!("no statement calls `{name}`")));
        };
        for (cell, argument) in self.globals.arguments.iter().zip(arguments) {
            cell.set(argument);
        }
        let Run {
            global,
            caches,
            scope,
        } = &mut self.run;
        let result = self
            .engine
            .eval_statements_raw(global, caches, scope, statement.statements());
        let value = result.map_err(|error| self.context(Some(name)).running(&error))?;
        self.check_memory(name)?;
        convert::to_value(&self.meter, &value).map_err(|problem| self.after_call(name, problem))
    }

    /// Empties `this`: what is kept in one case of a function task could say in another how many there are, and which are hidden.
    fn forget(&mut self) {
        if let Some(memory) = self.run.scope.get_mut(MEMORY) {
            *memory = Dynamic::from_map(Map::new());
        }
    }

    /// Checks the budgets of size for `this` as a whole, including its vectors.
    fn check_memory(&self, name: &str) -> Result<(), Stop> {
        let memory = self.run.scope.get(MEMORY).unwrap_or(&Dynamic::UNIT);
        if !memory.is_map() {
            return Err(Stop::Crashed(Mistake {
                message: "`this` is not a map any more".to_owned(),
                place: None,
                help: Some("keep values under names: this.count = 0".to_owned()),
                further: Vec::new(),
            }));
        }
        weight::check_size(&self.meter, memory).map_err(|problem| self.after_call(name, problem))
    }

    /// The stop for a problem with the answer or `this` of `function`.
    fn after_call(&self, function: &str, problem: Problem) -> Stop {
        let error: Box<EvalAltResult> = raise(problem, Position::NONE);
        self.context(Some(function)).running(&error)
    }

    /// The stop for a function that is missing or has other parameters; `None` if it is optional.
    fn missing(&self, name: &str) -> Option<Stop> {
        let parameters = self.parameters_of(name);
        let mut functions = self.names.functions.iter();
        let namesake = functions.find(|(known, _)| known == name);
        (name != "init" || namesake.is_some()).then(|| Stop::Missing {
            function: format!("{name}({})", parameters.join(", ")),
            help: self.names.missing(name, &parameters),
            namesake: namesake.map(|(_, got)| Namesake {
                parameters: got.len(),
                wanted: parameters.len(),
                place: self.names.places.definition(name, &self.source),
            }),
        })
    }
}

impl Controller for ScriptController {
    fn call(&mut self, call: &Call) -> Result<Answer, Stop> {
        let name = call.name();
        let defined = self.statements.contains_key(name);
        if !defined && let Some(missing) = self.missing(name) {
            return Err(missing);
        }
        if let (Some(model), Some(facts)) = (&self.model, call.robot()) {
            model.is_now(facts)?;
        }
        self.meter.start();
        if !matches!(call, Call::Init | Call::Control(_)) {
            self.forget();
        }
        let vector = |elements: &[f64]| Dynamic::from(super::vector::Vector::new(elements));
        let value = match call {
            Call::ForwardKinematics { robot, q } | Call::Jacobian { robot, q } => {
                let robot = self.robot.of(robot);
                self.call_function(name, [robot, vector(q)])
            }
            Call::InverseKinematics { robot, position_m } => {
                let robot = self.robot.of(robot);
                self.call_function(name, [robot, vector(position_m)])
            }
            Call::OfRobot { robot, given, .. } => {
                let robot = self.robot.of(robot);
                let given = given.iter().map(|(_, value)| convert::to_dynamic(value));
                self.call_function(name, std::iter::once(robot).chain(given))
            }
            Call::Free { robot, given, .. } => {
                self.names.given = given.iter().map(|(key, _)| key.clone()).collect();
                let robot = robot.as_ref().map(|robot| self.robot.of(robot));
                let given = convert::to_dynamic(&Value::Map(given.clone()));
                self.call_function(name, robot.into_iter().chain([given]))
            }
            Call::Init if !defined => Ok(Value::Nothing),
            Call::Init => {
                let robot = self.robot.map.clone();
                let task = self.task.as_str().into();
                self.call_function(name, [robot, task])
            }
            Call::Control(observation) => {
                let observation =
                    convert::observation(&self.observation, &self.sensors, observation);
                self.call_function(name, [observation])
            }
        };
        let operations = self.meter.finish();
        let value = value?;
        if !convert::is_finite(&value) {
            self.meter.log_not_a_number();
        }
        Ok(Answer {
            value,
            said: self.meter.take_output(),
            operations,
        })
    }

    fn unanswered(&mut self) -> Said {
        self.meter.take_output()
    }
}

/// Makes the statements that call the file's functions.
fn call_statements(
    engine: &Engine,
    scope: &Scope<'_>,
    names: &Names,
    asked: Option<&AskedFunction>,
) -> Result<BTreeMap<String, AST>, Stop> {
    let defined = |name: &str, parameters: usize| {
        let mut functions = names.functions.iter();
        functions.any(|(known, got)| known == name && got.len() == parameters)
    };
    let entry_points = ENTRY_POINTS.iter();
    let entry_points = entry_points.map(|(name, parameters)| (*name, parameters.len()));
    let asked = asked.map(|asked| (asked.name.as_str(), asked.parameters.len()));
    entry_points
        .chain(asked)
        .filter(|(name, parameters)| defined(name, *parameters))
        .map(|(name, parameters)| {
            let arguments = ARGUMENTS[..parameters].join(", ");
            let text = format!("{MEMORY}.{name}({arguments})");
            let statement = engine
                .compile_with_scope(scope, text)
                .map_err(|error| Stop::GraderFault(format!("the call of `{name}`: {error}")))?;
            Ok((name.to_owned(), statement))
        })
        .collect()
}

/// Why a lab's own function cannot have the name `name`; `None` if it can.
pub fn refused_name(name: &str) -> Option<&'static str> {
    let first = name.starts_with(|c: char| c.is_ascii_lowercase());
    let plain = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_';
    if !first || name.len() > 64 || !name.chars().all(plain) {
        return Some("it is not in lower snake case");
    }
    if ENTRY_POINTS.iter().any(|(known, _)| *known == name) {
        return Some("it is called in motion tasks");
    }
    let budgets = Budgets::default();
    let meter = Rc::new(Meter::new(budgets.clone()));
    let (engine, names) = engine::build(&budgets, &meter, &Rc::default(), None);
    if names.is_function(name) || names.constants.contains(name) {
        return Some("the language has something of this name");
    }
    match engine.compile(format!("fn {name}(given) {{ 0 }}")) {
        Ok(_) => None,
        Err(_) => Some("it is a word of the language"),
    }
}

/// The most characters of a name.
const LONGEST_NAME: usize = 200;

/// Refuses code that the engine would run with another meaning than the student's, and names of a length that nobody reads.
fn refuse_known_slips(ast: &AST) -> Result<(), Stop> {
    let mut slips = Vec::new();
    ast.walk(&mut |path| {
        match path.last() {
            Some(ASTNode::Expr(Expr::FnCall(call, position))) if call.name == "^" => {
                slips.push((
                    place(*position),
                    "`^` is not a power here".to_owned(),
                    "use ** for powers: x ** 2",
                ));
            }
            Some(ASTNode::Expr(Expr::Index(index, _, position)))
                if matches!(index.rhs, Expr::IntegerConstant(index, _) if index < 0) =>
            {
                slips.push((
                    place(*position),
                    "an index is negative".to_owned(),
                    "counting starts at 0; the last is v[len(v) - 1]",
                ));
            }
            Some(node) => {
                let long = names_of(node).find(|name| is_too_long(name));
                slips.extend(long.map(|name| too_long(name, node.position())));
            }
            None => {}
        }
        true
    });
    for function in ast.iter_fn_def() {
        let mut names = std::iter::once(&function.name).chain(&function.params);
        let long = names.find(|name| is_too_long(name));
        slips.extend(long.map(|name| too_long(name, function.body.start_position())));
    }
    // the first in the file, because the engine has its own order of functions
    let first = slips
        .into_iter()
        .min_by_key(|(place, ..)| place.map(|place| (place.line, place.column)));
    match first {
        None => Ok(()),
        Some((place, message, help)) => Err(Stop::DidNotBuild(Mistake {
            message,
            place,
            help: Some(help.to_owned()),
            further: Vec::new(),
        })),
    }
}

/// The names that a node itself has.
fn names_of<'n>(node: &'n ASTNode<'_>) -> impl Iterator<Item = &'n str> {
    let (one, keys) = match node {
        ASTNode::Stmt(Stmt::Var(declared, ..)) => (Some(declared.0.as_str()), None),
        ASTNode::Stmt(Stmt::For(declared, _)) => (Some(declared.0.as_str()), None),
        ASTNode::Stmt(Stmt::FnCall(call, _))
        | ASTNode::Expr(Expr::FnCall(call, _) | Expr::MethodCall(call, _)) => {
            (Some(call.name.as_str()), None)
        }
        ASTNode::Expr(Expr::Variable(variable, ..)) => (Some(variable.1.as_str()), None),
        ASTNode::Expr(Expr::Property(property, _)) => (Some(property.2.as_str()), None),
        ASTNode::Expr(Expr::Map(entries, _)) => (None, Some(&entries.0)),
        _ => (None, None),
    };
    let keys = keys.into_iter().flatten();
    one.into_iter().chain(keys.map(|(key, _)| key.as_str()))
}

/// Notes the names of what an observation, a target and a robot have.
fn note_fields(names: &mut Names, observation: &Map, target: &Value, robot: &CachedRobot) {
    let keys = |map: &Map| map.keys().map(ToString::to_string).collect();
    names.observation = keys(observation);
    if let Value::Map(entries) = target {
        names.target = entries.iter().map(|(key, _)| key.clone()).collect();
    }
    names.robot = robot
        .map
        .as_map_ref()
        .map(|map| keys(&map))
        .unwrap_or_default();
}

fn is_too_long(name: &str) -> bool {
    name.len() > LONGEST_NAME && name.chars().count() > LONGEST_NAME
}

fn too_long(name: &str, position: Position) -> (Option<SourcePosition>, String, &'static str) {
    let length = name.chars().count();
    (
        place(position),
        format!("a name has {length} characters"),
        "a name has up to 200 characters",
    )
}

/// Records the declarations of the file.
fn collect_names(ast: &AST, names: &mut Names, asked: Option<&AskedFunction>) {
    for function in ast.iter_functions() {
        let parameters: Vec<String> = function.params.iter().map(ToString::to_string).collect();
        names.local.extend(parameters.iter().cloned());
        match (function.name, parameters.first()) {
            ("control", Some(first)) => {
                names.observation_parameters.insert(first.clone());
            }
            ("forward_kinematics" | "inverse_kinematics" | "jacobian" | "init", Some(first)) => {
                names.robot_parameters.insert(first.clone());
            }
            (name, Some(_)) if asked.is_some_and(|asked| asked.name == name) => {
                let wanted = asked.iter().flat_map(|asked| &asked.parameters);
                for (wanted, own) in wanted.zip(&parameters) {
                    match wanted.as_str() {
                        "robot" => names.robot_parameters.insert(own.clone()),
                        "given" => names.given_parameters.insert(own.clone()),
                        _ => false,
                    };
                }
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
    names.places = Places::of(ast);
    names.top_level = top_level;
    names.unknown = unknown(ast, names, &BTreeSet::new());
}
