//! The controller of a compiled submission: a run keeps one instance, and every case of a function task has a fresh one, so that nothing
//! goes from one case to the next.

use std::cell::RefCell;
use std::rc::Rc;

use kinemark_sim::text::nearest;
use wasmi::TrapCode;

use super::imports::{Ended, State, canonical, numbers};
use super::instance::{Instance, Trouble, ended};
use super::layout::{AnswerAt, Block, Content, FIELD_BYTES, Field, UNWRITTEN, count, flatten};
use super::module::{Compiled, FUNCTIONS, Limits, MOST_CALLS, export_name, parameter_names};
use crate::submission::answer::NOT_A_NUMBER;
use crate::submission::controller::{
    Answer, Budget, Budgets, Call, Controller, Grant, Mistake, Observation, Opening, Reads,
    RobotFacts, Said, SensorFacts, Stop, Value,
};
use crate::submission::handed_in::Program;
use crate::submission::output::Output;
use crate::submission::robot_model::Model;

/// Rows of a Jacobian that there is room for.
const MOST_ROWS: usize = 6;
/// Entries of an answer that there is room for.
const MOST_ENTRIES: usize = 64;
/// Bytes of an entry's name that are read.
const LONGEST_NAME: usize = 64;

/// Runs a compiled module for one task.
pub struct PluginController {
    compiled: Compiled,
    budgets: Budgets,
    output: Rc<RefCell<Output>>,
    model: Option<Rc<Model>>,
    grants: Vec<Grant>,
    task: String,
    robot: RobotFacts,
    target: Value,
    sensors: Vec<SensorFacts>,
    /// Instructions of the calls so far.
    spent: u64,
    /// The instance of a run, with what its functions get.
    run: Option<Run>,
}

/// An instance with the block of a motion task.
struct Run {
    instance: Instance,
    block: MotionBlock,
}

/// What the functions of a motion task get, with addresses in the module's memory.
struct MotionBlock {
    robot: u32,
    task: u32,
    observation: u32,
    command: u32,
    /// Address of what is written before each call: the numbers that change, the unwritten command, the fields of the sensors and, at
    /// the end, the observation.
    changing: u32,
    bytes: Vec<u8>,
}

/// Bytes of a `km_observation`.
const OBSERVATION_BYTES: usize = 72;

impl PluginController {
    /// Compiles a module, and starts it once.
    ///
    /// # Errors
    /// [`Stop::DidNotBuild`] for what is no module that Kinemark can call, [`Stop::OverBudget`] if it is too large, and any stop of its
    /// start function.
    pub fn open(opening: &Opening) -> Result<Self, Stop> {
        let Program::Module(bytes) = &opening.program else {
            return Err(Stop::GraderFault(
                "a script is opened as a module".to_owned(),
            ));
        };
        let limits = Limits::of_submission(opening.budgets.module_bytes);
        let compiled = Compiled::new(
            bytes,
            limits,
            opening.function.as_ref().map(|asked| asked.name.as_str()),
        )?;
        let model = match &opening.granted {
            Some(granted) => Some(Rc::new(Model::new(granted, &opening.robot)?)),
            None => None,
        };
        let granted = opening.granted.as_ref();
        let mut controller = Self {
            compiled,
            budgets: opening.budgets.clone(),
            output: Rc::new(RefCell::new(Output::new(&opening.budgets))),
            model,
            grants: granted.map_or_else(Vec::new, |granted| granted.functions.clone()),
            task: opening.task.clone(),
            robot: opening.robot.clone(),
            target: opening.target.clone(),
            sensors: opening.sensors.clone(),
            spent: 0,
            run: None,
        };
        let allowed = controller.allowed();
        let run = controller.started_run(allowed);
        let (run, left) = controller.finished("km_version", allowed, run)?;
        controller.spent += allowed - left;
        controller.run = Some(run);
        Ok(controller)
    }

    /// How many instructions the next call may use.
    fn allowed(&self) -> u64 {
        let left = self.budgets.instructions_per_task - self.spent;
        left.min(self.budgets.instructions_per_call)
    }

    fn state(&self) -> State {
        State {
            limits: self.compiled.limits.of_instance(),
            memory: None,
            #[cfg(feature = "python")]
            has_rest: false,
            output: Rc::clone(&self.output),
            model: self.model.clone(),
            grants: self.grants.clone(),
            text_size: self.budgets.text_size,
        }
    }

    /// A fresh instance with the block of a motion task, and how many instructions are left.
    fn started_run(&self, fuel: u64) -> Result<(Run, u64), Trouble> {
        let mut instance = Instance::start(&self.compiled, self.state(), fuel)?;
        let place = |base| {
            let block = self.motion_block(base);
            let size = block.bytes.len();
            (block, size)
        };
        let (base, block) = placed(&mut instance, place)?;
        instance.write(base, &block.bytes)?;
        let left = instance.fuel();
        Ok((Run { instance, block }, left))
    }

    /// What the functions of a motion task get, at the address `base`.
    fn motion_block(&self, base: u32) -> MotionBlock {
        let mut block = Block::at(base);
        let n = self.robot.joint_names.len();
        let robot = block.robot(&self.robot);
        let task = block.text(&self.task);
        let name = match self.target {
            Value::Map(_) => "",
            _ => "target",
        };
        let mut target = Vec::new();
        flatten(name, &self.target, &mut target);
        let target = block.map(&target);

        let q = block.numbers(&vec![0.0; n]);
        let qd = block.numbers(&vec![0.0; n]);
        let effort = block.numbers(&vec![0.0; n]);
        let tcp = block.numbers(&[0.0; 3]);
        let tcp_rotation = block.numbers(&[0.0; 9]);
        let mut sensors = Vec::new();
        for sensor in &self.sensors {
            let (count, columns) = match sensor.reads {
                Reads::Truth | Reads::Number => (1, 0),
                Reads::Vector(channels) => (channels, channels),
            };
            sensors.push(Field {
                name: sensor.name.clone(),
                content: Content::At {
                    address: block.numbers(&vec![0.0; count]),
                    count,
                    columns,
                },
            });
        }
        let command = block.unwritten(n);
        let sensors = block.map(&sensors);
        let at = block.aligned();
        for number in [0.0; 3] {
            block.number(number);
        }
        for word in [count(n), q, qd, effort, tcp, task] {
            block.word(word);
        }
        block.map_word(target);
        block.map_word(sensors);
        block.word(tcp_rotation);
        // a structure with numbers of eight bytes is as long as a multiple of them
        block.word(0);
        MotionBlock {
            robot,
            task,
            observation: block.address(at),
            command,
            changing: q,
            bytes: block.into_bytes(),
        }
    }

    /// Calls a function of a motion task.
    fn in_run(&self, run: &mut Run, call: &Call) -> Result<Value, Trouble> {
        let Run { instance, block } = run;
        match call {
            Call::Control(observation) => {
                let base = block.observation + count(OBSERVATION_BYTES) - count(block.bytes.len());
                let start = (block.changing - base) as usize;
                let changing = &mut block.bytes[start..];
                let at = changing.len() - OBSERVATION_BYTES;
                let (numbers, at_end) = changing.split_at_mut(at);
                fill(
                    at_end,
                    [
                        observation.tick as f64,
                        observation.time_s,
                        observation.dt_s,
                    ],
                );
                fill(numbers, changing_numbers(observation));
                instance.write(block.changing, changing)?;
                instance.call("km_control", &[block.observation, block.command])?;
                let n = self.robot.joint_names.len();
                Ok(list(&self.written(instance, call, block.command, n)?))
            }
            _ if !self.has("km_init") => Ok(Value::Nothing),
            _ => {
                instance.call("km_init", &[block.robot, block.task])?;
                Ok(Value::Nothing)
            }
        }
    }

    /// Calls a function on a case, in a fresh instance.
    fn on_case(&self, call: &Call, instance: &mut Instance) -> Result<Value, Trouble> {
        let name = export_name(call.name());
        if !matches!(call, Call::OfRobot { .. } | Call::Free { .. }) {
            self.compiled.is_usual(&name).map_err(Trouble::Stop)?;
        }
        match call {
            Call::ForwardKinematics { robot, q } => {
                let (robot, q, out) = given(instance, robot, q, 3)?;
                instance.call(&name, &[robot, q, out])?;
                Ok(list(&self.written(instance, call, out, 3)?))
            }
            Call::InverseKinematics { robot, position_m } => {
                let n = robot.joint_names.len();
                let most = (self.budgets.list_size as usize) / n.max(1);
                let (robot, position, out) = given(instance, robot, position_m, most * n)?;
                let branches = instance.call(&name, &[robot, position, out, count(most)])?;
                let branches = counted("branches", branches, most)?;
                let numbers = self.written(instance, call, out, branches * n)?;
                Ok(rows(&numbers, n))
            }
            Call::Jacobian { robot, q } => {
                let n = robot.joint_names.len();
                let (robot, q, out) = given(instance, robot, q, MOST_ROWS * n)?;
                let written = instance.call(&name, &[robot, q, out])?;
                let written = counted("rows", written, MOST_ROWS)?;
                let numbers = self.written(instance, call, out, written * n)?;
                Ok(rows(&numbers, n))
            }
            Call::OfRobot { .. } | Call::Free { .. } => {
                let room = self.budgets.list_size as usize;
                let given = by_name(call);
                let place = |base| {
                    let mut block = Block::at(base);
                    let mut fields = Vec::new();
                    flatten("", &given, &mut fields);
                    let map = block.map(&fields);
                    let at = block.aligned();
                    block.map_word(map);
                    let map = block.address(at);
                    let answer = block.answer(MOST_ENTRIES, room);
                    let bytes = block.into_bytes();
                    let size = bytes.len();
                    ((map, answer, bytes), size)
                };
                let (base, (map, answer, bytes)) = placed(instance, place)?;
                instance.write(base, &bytes)?;
                instance.call(&name, &[map, answer.at])?;
                own_answer(instance, &answer, room)
            }
            Call::Init | Call::Control(_) => Err(Trouble::Stop(Stop::GraderFault(
                "a function of a run is called on a case".to_owned(),
            ))),
        }
    }

    /// The numbers that a function wrote; the log says where it wrote none.
    fn written(
        &self,
        instance: &Instance,
        call: &Call,
        at: u32,
        count: usize,
    ) -> Result<Vec<f64>, Trouble> {
        let numbers = read(instance, at, count)?;
        if let Some(first) = numbers.iter().position(|x| x.to_bits() == UNWRITTEN) {
            let line = format!(
                "`{}` writes nothing to `{}[{first}]`: {NOT_A_NUMBER}",
                export_name(call.name()),
                written_to(call)
            );
            self.output.borrow_mut().print(line, None);
        }
        Ok(numbers.into_iter().map(canonical).collect())
    }

    fn has(&self, export: &str) -> bool {
        self.compiled.functions.iter().any(|name| name == export)
    }

    /// The stop for a function that the module does not export.
    fn missing(&self, call: &Call) -> Stop {
        let name = export_name(call.name());
        // a function of another task is there for that task
        let is_other = |known: &&str| {
            let mut others = FUNCTIONS.iter().map(|(other, ..)| *other);
            others.any(|other| other == *known)
        };
        let exported = self.compiled.functions.iter().map(String::as_str);
        let exported: Vec<&str> = exported.filter(|known| !is_other(known)).collect();
        let near = match exported.iter().find(|known| **known == call.name()) {
            Some(bare) => Some(*bare),
            None => nearest(&name, exported.iter().copied()),
        };
        let help = match near {
            Some(near) => format!("the module exports `{near}`: call it `{name}`"),
            None => format!(
                "export it: in C define `{name}` as kinemark.h declares it, in Rust name `{}` in `export!`",
                call.name()
            ),
        };
        Stop::Missing {
            function: format!("{name}({})", parameter_names(&name)),
            help: Some(help),
            namesake: None,
        }
    }

    /// The result of a call of `called`, which could use `allowed` instructions, or the stop that it ended with.
    fn finished<T>(
        &self,
        called: &str,
        allowed: u64,
        result: Result<T, Trouble>,
    ) -> Result<T, Stop> {
        result.map_err(|trouble| match trouble {
            Trouble::Stop(stop) => stop,
            Trouble::Ended { error, function } => {
                let function = function.and_then(|index| self.compiled.names.get(index));
                self.stop(called, allowed, &error, function)
            }
        })
    }

    fn stop(
        &self,
        called: &str,
        allowed: u64,
        error: &wasmi::Error,
        function: Option<&str>,
    ) -> Stop {
        let over = |budget, limit| Stop::OverBudget {
            budget,
            limit,
            place: None,
            function: function.map(str::to_owned),
        };
        let budgets = &self.budgets;
        // the function that is called needs no second mention
        let within = match function.filter(|name| *name != called) {
            Some(name) => format!(", in the function `{name}`"),
            None => String::new(),
        };
        let crashed = |message: String, help: &str| {
            Stop::Crashed(Mistake {
                message,
                place: None,
                help: Some(help.to_owned()),
                further: Vec::new(),
            })
        };
        match ended(error) {
            Some(Ended::Failed(words)) => {
                let help = "these are the module's own words: a panic, or a call of `km_fail`";
                // a panic names its place itself, and what runs then is the machinery of panics
                let within = match words.starts_with("panicked") {
                    true => "",
                    false => &within,
                };
                return crashed(format!("{words}{within}"), help);
            }
            Some(Ended::Misused(words, help)) => return crashed(format!("{words}{within}"), help),
            Some(Ended::Exhausted(budget)) => return over(*budget, budgets.text_size),
            None => {}
        }
        let (what, help) = match error.as_trap_code() {
            Some(TrapCode::OutOfFuel) if allowed < budgets.instructions_per_call => {
                return over(Budget::InstructionsPerTask, budgets.instructions_per_task);
            }
            Some(TrapCode::OutOfFuel) => {
                return over(Budget::InstructionsPerCall, budgets.instructions_per_call);
            }
            Some(TrapCode::StackOverflow) => {
                return over(Budget::CallDepth, MOST_CALLS as u64);
            }
            Some(trap) => trap_words(trap),
            None => return Stop::GraderFault(format!("`{called}` of a module: {error}")),
        };
        crashed(format!("`{called}` {what}{within}"), help)
    }
}

impl Controller for PluginController {
    fn call(&mut self, call: &Call) -> Result<Answer, Stop> {
        let name = export_name(call.name());
        if !self.has(&name) && !matches!(call, Call::Init) {
            return Err(self.missing(call));
        }
        if let (Some(model), Some(facts)) = (&self.model, call.robot()) {
            model.is_now(facts)?;
        }
        let allowed = self.allowed();
        let (value, left) = if matches!(call, Call::Init | Call::Control(_)) {
            let Some(mut run) = self.run.take() else {
                return Err(Stop::GraderFault("a run without an instance".to_owned()));
            };
            run.instance.refuel(allowed);
            let value = self.in_run(&mut run, call);
            let left = run.instance.fuel();
            self.run = Some(run);
            (value, left)
        } else {
            match Instance::start(&self.compiled, self.state(), allowed) {
                Ok(mut instance) => {
                    let value = self.on_case(call, &mut instance);
                    (value, instance.fuel())
                }
                Err(trouble) => (Err(trouble), 0),
            }
        };
        let operations = allowed - left.min(allowed);
        self.spent += operations;
        let value = self.finished(&name, allowed, value)?;
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

/// Gets a block for what `place` makes at an address, and makes it there: once to know its size, once with its address.
fn placed<T>(
    instance: &mut Instance,
    place: impl Fn(u32) -> (T, usize),
) -> Result<(u32, T), Trouble> {
    let (_, size) = place(0);
    let base = instance.block(size)?;
    let (made, _) = place(base);
    Ok((base, made))
}

/// Writes a robot, what a function gets of a case, and room for so many numbers; the addresses of the three.
fn given(
    instance: &mut Instance,
    robot: &RobotFacts,
    input: &[f64],
    room: usize,
) -> Result<(u32, u32, u32), Trouble> {
    let place = |base| {
        let mut block = Block::at(base);
        let robot = block.robot(robot);
        let input = block.numbers(input);
        let out = block.unwritten(room);
        let bytes = block.into_bytes();
        let size = bytes.len();
        ((robot, input, out, bytes), size)
    };
    let (base, (robot, input, out, bytes)) = placed(instance, place)?;
    instance.write(base, &bytes)?;
    Ok((robot, input, out))
}

/// The numbers of an observation that change from call to call, in the order of the block.
fn changing_numbers(observation: &Observation) -> impl Iterator<Item = f64> {
    let Observation {
        q,
        qd,
        effort,
        tcp_m,
        tcp_rotation,
        sensors,
        ..
    } = observation;
    let rotation = tcp_rotation.as_flattened();
    let parts = [q, qd, effort, &tcp_m[..], rotation, sensors];
    parts.into_iter().flatten().copied()
}

/// Writes numbers to the beginning of a block.
fn fill(block: &mut [u8], numbers: impl IntoIterator<Item = f64>) {
    let (places, _) = block.as_chunks_mut::<8>();
    for (place, number) in places.iter_mut().zip(numbers) {
        *place = number.to_le_bytes();
    }
}

fn list(numbers: &[f64]) -> Value {
    Value::List(numbers.iter().copied().map(Value::Number).collect())
}

/// So many numbers of the memory.
fn read(instance: &Instance, at: u32, count: usize) -> Result<Vec<f64>, Trouble> {
    match instance.bytes(at, 8 * count) {
        Some(bytes) => Ok(numbers(bytes)),
        None => Err(unreadable(
            "its answer lies outside of the memory".to_owned(),
        )),
    }
}

/// What a function that is called with one map is given: its own input, and the robot's under `robot`.
fn by_name(call: &Call) -> Value {
    let mut given = match call {
        Call::OfRobot { given, .. } | Call::Free { given, .. } => given.clone(),
        _ => Vec::new(),
    };
    if let Some(robot) = call.robot() {
        let mut facts = robot.dimensions.clone();
        let entries = [
            ("lower", list(&robot.lower)),
            ("upper", list(&robot.upper)),
            ("effort_limit", list(&robot.effort)),
            ("joints", Value::Number(robot.joint_names.len() as f64)),
            ("name", Value::Text(robot.name.clone())),
        ];
        facts.extend(entries.map(|(name, value)| (name.to_owned(), value)));
        given.push(("robot".to_owned(), Value::Map(facts)));
    }
    Value::Map(given)
}

/// What a function writes to, as `kinemark.h` calls it.
fn written_to(call: &Call) -> &'static str {
    match call {
        Call::ForwardKinematics { .. } => "position",
        Call::InverseKinematics { .. } => "branches",
        Call::Jacobian { .. } => "matrix",
        Call::Init | Call::Control(_) => "command",
        Call::OfRobot { .. } | Call::Free { .. } => "answer",
    }
}

/// An answer that cannot be read.
fn unreadable(message: String) -> Trouble {
    Trouble::Stop(Stop::Crashed(Mistake {
        message,
        place: None,
        help: Some(
            "write answers where the function is given room for them, as kinemark.h says"
                .to_owned(),
        ),
        further: Vec::new(),
    }))
}

/// How much a function says it wrote, of what there is room for.
fn counted(what: &str, written: Option<u32>, most: usize) -> Result<usize, Trouble> {
    let written = written.unwrap_or(0) as usize;
    if written > most {
        return Err(unreadable(format!(
            "it returned {written} {what}, there is room for {most}"
        )));
    }
    Ok(written)
}

/// Numbers row by row.
fn rows(numbers: &[f64], columns: usize) -> Value {
    Value::List(numbers.chunks_exact(columns.max(1)).map(list).collect())
}

/// What a function of the lab's own wrote: a map, or one entry without a name.
fn own_answer(instance: &Instance, answer: &AnswerAt, room: usize) -> Result<Value, Trouble> {
    let outside = || unreadable("its answer lies outside of the memory".to_owned());
    let word = |at: u32| {
        let bytes = instance.bytes(at, 4)?;
        Some(u32::from_le_bytes(bytes.try_into().ok()?))
    };
    let entries = word(answer.count).ok_or_else(outside)? as usize;
    if entries > MOST_ENTRIES {
        return Err(unreadable(format!(
            "its answer has {entries} entries, there is room for {MOST_ENTRIES}"
        )));
    }
    let mut read_so_far = 0;
    let mut map = Vec::new();
    for entry in 0..entries {
        let field = answer.fields + count(entry * FIELD_BYTES);
        let words = [0, 4, 12, 16].map(|offset| word(field + offset));
        let [Some(name), Some(at), Some(length), Some(columns)] = words else {
            return Err(outside());
        };
        read_so_far += length as usize;
        if read_so_far > room {
            return Err(unreadable(format!(
                "its answer has more than {room} numbers"
            )));
        }
        let numbers = read(instance, at, length as usize)?;
        let numbers: Vec<f64> = numbers.into_iter().map(canonical).collect();
        let value = match (columns as usize, numbers.as_slice()) {
            (0, [number]) => Value::Number(*number),
            (columns, _) if columns > 0 && columns < numbers.len() => {
                Value::List(numbers.chunks(columns).map(list).collect())
            }
            _ => list(&numbers),
        };
        let name = match name {
            0 => String::new(),
            at => text(instance, at).ok_or_else(outside)?,
        };
        map.push((name, value));
    }
    // as the maps of scripts are, so that the same answer has the same digest
    map.sort_by(|(a, _), (b, _)| a.cmp(b));
    match &map[..] {
        [] => Ok(Value::Nothing),
        [(name, value)] if name.is_empty() => Ok(value.clone()),
        _ => Ok(Value::Map(map)),
    }
}

/// A short text that ends with a zero byte.
fn text(instance: &Instance, at: u32) -> Option<String> {
    let mut bytes = Vec::new();
    for offset in 0..count(LONGEST_NAME) {
        match instance.bytes(at.checked_add(offset)?, 1)? {
            [0] => break,
            byte => bytes.extend_from_slice(byte),
        }
    }
    Some(String::from_utf8_lossy(&bytes).into_owned())
}

/// A trap in words, and what to look for.
fn trap_words(trap: TrapCode) -> (&'static str, &'static str) {
    match trap {
        TrapCode::UnreachableCodeReached => (
            "stops itself",
            "a failed assertion, an `abort`, a panic, or the end of a function that should return something",
        ),
        TrapCode::MemoryOutOfBounds => (
            "reads or writes outside of its memory",
            "look for a wrong index or pointer, a function that calls itself too often, or large arrays inside functions: they share a small \
             stack, so make them static in C, or a `Vec` in Rust",
        ),
        TrapCode::TableOutOfBounds | TrapCode::IndirectCallToNull | TrapCode::BadSignature => (
            "calls a function pointer that is none",
            "look for a pointer that is not set, or set to a function of another type",
        ),
        TrapCode::IntegerDivisionByZero => (
            "divides an integer by zero",
            "check the divisor, or use double: 1.0 / 0.0 is no error",
        ),
        TrapCode::IntegerOverflow | TrapCode::BadConversionToInteger => (
            "converts a number that no integer can hold",
            "check that the number is finite and small enough before it becomes an integer",
        ),
        TrapCode::GrowthOperationLimited => (
            "wants more memory, or a larger table, than a module may have",
            "a module has 16 MiB: use again what is there, and let nothing grow from call to call",
        ),
        TrapCode::StackOverflow | TrapCode::OutOfFuel => ("runs too long", "look for a loop"),
        _ => ("stops", "look at what it does last: `km_log` shows it"),
    }
}
