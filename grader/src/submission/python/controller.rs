//! The controller of a submission in Python: a run keeps one instance of the runtime, and every case of a function task begins with the
//! memory that the file's statements left, so that nothing goes from one case to the next.

use std::cell::RefCell;
use std::rc::Rc;

use kinemark_python_wire::{Function, Load, Place, Reply};
use kinemark_sim::text::nearest;
use wasmi::TrapCode;

use super::convert;
use super::hints;
use super::instance::{Instance, MEMORY_BYTES, Trouble};
use crate::submission::controller::{
    Answer, AskedFunction, Budget, Budgets, Call, Controller, Failed, Grant, Mistake, Namesake,
    Opening, Said, SourcePosition, Stop, Value, entry_parameters,
};
use crate::submission::handed_in::Program;
use crate::submission::output::Output;
use crate::submission::plugin::{Ended, State};
use crate::submission::robot_model::Model;

/// Runs a file in Python for one task.
pub struct PythonController {
    file: String,
    source: String,
    budgets: Budgets,
    output: Rc<RefCell<Output>>,
    model: Option<Rc<Model>>,
    grants: Vec<Grant>,
    asked: Option<AskedFunction>,
    functions: Vec<Function>,
    /// Instructions of the calls so far.
    spent: u64,
    /// The instance in which the file's statements ran; the run of a motion task goes on in it.
    loaded: Instance,
    /// The instance in which cases are called, with the memory of the one above at each.
    case: Option<Instance>,
}

impl PythonController {
    /// Starts the runtime, and runs the file's statements.
    ///
    /// # Errors
    /// [`Stop::DidNotBuild`] for a file that Python cannot read, and any stop of its statements, with what they printed.
    pub fn open(opening: &Opening) -> Result<Self, Box<Failed>> {
        let Program::Python(source) = &opening.program else {
            let what = "a program of another kind is opened as Python";
            return Err(Stop::GraderFault(what.to_owned()).into());
        };
        let budgets = opening.budgets.clone();
        if source.len() as u64 > budgets.source_bytes {
            return Err(Stop::OverBudget {
                budget: Budget::SourceBytes,
                limit: budgets.source_bytes,
                place: None,
                function: None,
            }
            .into());
        }
        let granted = opening.granted.as_ref();
        let grants = granted.map_or_else(Vec::new, |granted| granted.functions.clone());
        let model = match granted {
            Some(granted) => Some(Rc::new(Model::new(granted, &opening.robot)?)),
            None => None,
        };
        let output = Rc::new(RefCell::new(Output::new(&budgets)));
        let state = state(&output, model.as_ref(), &grants, &budgets);
        let loaded = Instance::started(state).map_err(Stop::GraderFault)?;
        let mut controller = Self {
            file: opening.file.clone(),
            source: source.clone(),
            output,
            model,
            asked: opening.function.clone(),
            functions: Vec::new(),
            spent: 0,
            loaded,
            case: None,
            budgets,
            grants,
        };
        match controller.load(opening) {
            Ok(()) => Ok(controller),
            Err(stop) => Err(Box::new(Failed {
                stop,
                said: controller.unanswered(),
            })),
        }
    }

    fn load(&mut self, opening: &Opening) -> Result<(), Stop> {
        let load = Load {
            file: self.file.clone(),
            source: self.source.clone(),
            robot: convert::robot(&opening.robot, &self.grants),
            task: opening.task.clone(),
            target: convert::to_wire(&opening.target),
            sensors: convert::sensors(&opening.sensors),
            most_values: u32::try_from(self.budgets.list_size).unwrap_or(u32::MAX),
            text_size: u32::try_from(self.budgets.text_size).unwrap_or(u32::MAX),
        };
        let allowed = self.budgets.python_instructions_to_read();
        self.loaded.refuel(allowed);
        let reply = self.loaded.load(&load);
        let stopped = match &reply {
            Err(_) => self.loaded.stopped(),
            Ok(_) => None,
        };
        match self.finished(Budget::InstructionsToRead, allowed, reply, stopped)? {
            Reply::Loaded(functions) => {
                self.functions = functions;
                Ok(())
            }
            raised => Err(self.raised(raised)),
        }
    }

    /// How many instructions the next call may use, and the budget that this is.
    fn allowed(&self) -> (Budget, u64) {
        let per_call = self.budgets.python_instructions_per_call();
        let left = self.budgets.python_instructions_per_task() - self.spent;
        match left < per_call {
            true => (Budget::InstructionsPerTask, left),
            false => (Budget::InstructionsPerCall, per_call),
        }
    }

    /// Calls in the instance of the run.
    fn in_run(&mut self, call: &Call, allowed: u64) -> (Result<Reply, Trouble>, u64) {
        self.loaded.refuel(allowed);
        let reply = self.loaded.call(&convert::call(call, &self.grants));
        let left = self.loaded.fuel();
        (reply, left)
    }

    /// Calls in an instance that is as the file's statements left it.
    fn on_case(
        &mut self,
        call: &Call,
        allowed: u64,
    ) -> Result<(Result<Reply, Trouble>, u64), String> {
        let state = || {
            state(
                &self.output,
                self.model.as_ref(),
                &self.grants,
                &self.budgets,
            )
        };
        let mut case = match self.case.take() {
            Some(case) => case,
            None => Instance::empty(state())?,
        };
        if !case.become_like(&self.loaded)? {
            // before the next one: a worker has little address space
            drop(case);
            case = Instance::empty(state())?;
            case.become_like(&self.loaded)?;
        }
        case.refuel(allowed);
        let reply = case.call(&convert::call(call, &self.grants));
        let left = case.fuel();
        self.case = Some(case);
        Ok((reply, left))
    }

    /// The reply to a request that could use `allowed` instructions of `budget`, or the stop that it ended with.
    fn finished(
        &self,
        budget: Budget,
        allowed: u64,
        reply: Result<Reply, Trouble>,
        stopped: Option<kinemark_python_wire::Stopped>,
    ) -> Result<Reply, Stop> {
        let error = match reply {
            Ok(reply) => return Ok(reply),
            Err(Trouble::Fault(what)) => return Err(Stop::GraderFault(what)),
            Err(Trouble::Ended(error)) => error,
        };
        let (at, function, panic) = match stopped {
            Some(stopped) => (
                stopped.place.map(|at| self.place(at)),
                stopped.function,
                stopped.panic,
            ),
            None => (None, None, None),
        };
        let over = |budget, limit| Stop::OverBudget {
            budget,
            limit,
            place: at,
            function: function.clone().filter(|name| name != "<module>"),
        };
        let crashed = |message: &str, help: &str| {
            Stop::Crashed(Mistake {
                message: message.to_owned(),
                place: at,
                help: Some(help.to_owned()),
                further: Vec::new(),
            })
        };
        let budgets = &self.budgets;
        match error.downcast_ref::<Ended>() {
            Some(Ended::Failed(words)) => return Err(crashed(words, "")),
            Some(Ended::Misused(words, help)) => return Err(crashed(words, help)),
            Some(Ended::Exhausted(budget)) => return Err(over(*budget, budgets.text_size)),
            None => {}
        }
        Err(match error.as_trap_code() {
            Some(TrapCode::OutOfFuel) => over(
                budget,
                match budget {
                    Budget::InstructionsPerTask => budgets.python_instructions_per_task(),
                    _ => allowed,
                },
            ),
            Some(TrapCode::GrowthOperationLimited) => crashed(
                &format!("MemoryError: more than {} MiB are used", MEMORY_BYTES >> 20),
                "make lists and texts smaller, and let nothing grow from call to call",
            ),
            Some(TrapCode::StackOverflow | TrapCode::MemoryOutOfBounds) => crashed(
                "RecursionError: expressions or calls are too deep inside each other",
                "look for a function or an object that contains itself, and split long expressions",
            ),
            // what Rust's own checks end is a fault of the runtime, which the file brought about
            Some(TrapCode::UnreachableCodeReached) => {
                let what = panic.unwrap_or_default();
                match what.contains("capacity overflow") || what.contains("memory allocation") {
                    true => crashed(
                        "MemoryError: a value is larger than any memory",
                        "look at the sizes of lists, texts and arrays on this line",
                    ),
                    false => crashed(
                        &format!(
                            "SystemError: the runtime of Python cannot go on: {}",
                            what.replace('\n', " ")
                        ),
                        "write the line in another way, and report it: it is a fault of the runtime",
                    ),
                }
            }
            _ => Stop::GraderFault(format!("the runtime of Python: {error}")),
        })
    }

    /// The stop for an exception.
    fn raised(&self, reply: Reply) -> Stop {
        let Reply::Raised {
            kind,
            message,
            place: at,
            name,
            is_of_compiler,
        } = reply
        else {
            return Stop::GraderFault("the runtime of Python gave another reply".to_owned());
        };
        let line = at.and_then(|at| self.line(at));
        let mistake = Mistake {
            help: hints::help(
                &kind,
                &message,
                name.as_deref(),
                line.unwrap_or_default(),
                &self.source,
            ),
            message: match message.is_empty() {
                true => kind,
                false => format!("{kind}: {message}"),
            },
            place: at.map(|at| match is_of_compiler {
                // the compiler counts characters itself
                true => SourcePosition {
                    line: at.line as usize,
                    column: at.column as usize,
                },
                false => self.place(at),
            }),
            further: Vec::new(),
        };
        match is_of_compiler {
            true => Stop::DidNotBuild(mistake),
            false => Stop::Crashed(mistake),
        }
    }

    fn line(&self, at: Place) -> Option<&str> {
        let line = (at.line as usize).checked_sub(1)?;
        self.source.lines().nth(line)
    }

    /// A place of the runtime, whose columns count bytes, for people, who count characters.
    fn place(&self, at: Place) -> SourcePosition {
        let line = at.line as usize;
        let bytes = (at.column as usize).saturating_sub(1);
        let column = match self.line(at) {
            Some(text) => {
                let before = text.char_indices().take_while(|(begin, _)| *begin < bytes);
                before.count() + bytes.saturating_sub(text.len()) + 1
            }
            None => bytes + 1,
        };
        SourcePosition { line, column }
    }

    /// The parameters of a function that the grader calls.
    fn parameters_of(&self, name: &str) -> Vec<&str> {
        match &self.asked {
            Some(asked) if asked.name == name => {
                asked.parameters.iter().map(String::as_str).collect()
            }
            _ => entry_parameters(name).to_vec(),
        }
    }

    /// The stop for a function that is missing, or that cannot be called with so many arguments; `None` if all is well.
    fn missing(&self, name: &str) -> Option<Stop> {
        let wanted = self.parameters_of(name).len();
        let defined = self.functions.iter().find(|known| known.name == name);
        let mut namesake = None;
        if let Some(defined) = defined {
            let (least, most) = defined.parameters;
            let fits = wanted >= least as usize && most.is_none_or(|most| wanted <= most as usize);
            if fits {
                return None;
            }
            namesake = Some(Namesake {
                parameters: most.unwrap_or(least) as usize,
                wanted,
                place: defined.place.map(|at| self.place(at)),
            });
        } else if name == "init" || (name == "control" && self.has("init")) {
            // a controller may be made by `init`
            return None;
        }
        Some(self.is_missing(name, namesake))
    }

    fn has(&self, name: &str) -> bool {
        self.functions.iter().any(|known| known.name == name)
    }

    fn is_missing(&self, name: &str, namesake: Option<Namesake>) -> Stop {
        let parameters = self.parameters_of(name);
        let head = format!("def {name}({}):", parameters.join(", "));
        let known = self.functions.iter().map(|known| known.name.as_str());
        let inside = |line: &str| {
            let text = line.trim_start();
            let named = text
                .strip_prefix("def ")
                .and_then(|rest| rest.strip_prefix(name));
            text.len() < line.len() && named.is_some_and(|rest| rest.trim_start().starts_with('('))
        };
        let help = match nearest(name, known).filter(|near| *near != name) {
            None if self.source.lines().any(inside) => format!(
                "`def {name}` stands inside of another function or a class: write it at the beginning of a line, or give it a global name there"
            ),
            Some(near) => format!("rename `{near}`: {head}"),
            None => format!("write {head}"),
        };
        Stop::Missing {
            function: format!("{name}({})", parameters.join(", ")),
            help: Some(help),
            namesake,
        }
    }
}

impl Controller for PythonController {
    fn call(&mut self, call: &Call) -> Result<Answer, Stop> {
        if let Some(missing) = self.missing(call.name()) {
            return Err(missing);
        }
        if let (Some(model), Some(facts)) = (&self.model, call.robot()) {
            model.is_now(facts)?;
        }
        let (budget, allowed) = self.allowed();
        let is_of_run = matches!(call, Call::Init | Call::Control(_));
        let (reply, left) = match is_of_run {
            true => self.in_run(call, allowed),
            false => self.on_case(call, allowed).map_err(Stop::GraderFault)?,
        };
        let operations = allowed - left.min(allowed);
        self.spent += operations;
        let stopped = match (&reply, is_of_run) {
            (Ok(_), _) => None,
            (Err(_), true) => self.loaded.stopped(),
            // an instance that was stopped is as nobody knows
            (Err(_), false) => self.case.take().and_then(|mut case| case.stopped()),
        };
        let value = match self.finished(budget, allowed, reply, stopped)? {
            Reply::Returned(value) => convert::from_wire(value),
            Reply::Missing if matches!(call, Call::Init) => Value::Nothing,
            Reply::Missing => return Err(self.is_missing(call.name(), None)),
            Reply::TooMany => {
                return Err(Stop::Crashed(Mistake {
                    message: format!(
                        "`{}` returned more than {} values",
                        call.name(),
                        self.budgets.list_size
                    ),
                    place: None,
                    help: Some("return what the brief asks for, and nothing else".to_owned()),
                    further: Vec::new(),
                }));
            }
            raised => return Err(self.raised(raised)),
        };
        Ok(Answer {
            value,
            said: self.output.borrow_mut().take(),
            operations,
        })
    }

    fn unanswered(&mut self) -> Said {
        self.output.borrow_mut().take()
    }
}

fn state(
    output: &Rc<RefCell<Output>>,
    model: Option<&Rc<Model>>,
    grants: &[Grant],
    budgets: &Budgets,
) -> State {
    State {
        limits: wasmi::StoreLimits::default(),
        memory: None,
        has_rest: false,
        output: Rc::clone(output),
        model: model.cloned(),
        grants: grants.to_vec(),
        text_size: budgets.text_size,
    }
}
