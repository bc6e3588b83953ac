//! From the bytes of a module to one that can run: its form, its size, its imports and its exports are checked here, so that what is
//! wrong with them is `did-not-build` with the reason.

use wasmi::{CompilationMode, Config, Engine, ExternType, FuncType, Linker, Module};

use wasmi::{StoreLimits, StoreLimitsBuilder, ValType};

use super::imports::{self, State};
use super::marks::{MARK, marked};
use super::names::FunctionNames;
use crate::submission::controller::{Budget, Mistake, Stop};

/// Version of the interface in `kinemark.h`.
pub(super) const VERSION: i32 = 1;

/// The export of the module's memory.
pub(super) const MEMORY: &str = "memory";

/// How large a module may be, and what it may take while it runs.
#[derive(Debug, Clone, Copy)]
pub(super) struct Limits {
    /// Bytes of the module.
    pub(super) module_bytes: u64,
    /// Bytes of its memory.
    pub(super) memory_bytes: usize,
    /// Elements of each of its tables.
    pub(super) table_elements: usize,
}

impl Limits {
    /// Those of a student's module of at most `module_bytes`.
    pub(super) fn of_submission(module_bytes: u64) -> Self {
        Self {
            module_bytes,
            memory_bytes: 16 << 20,
            table_elements: 10_000,
        }
    }

    /// The same for an instance.
    pub(super) fn of_instance(self) -> StoreLimits {
        StoreLimitsBuilder::new()
            .memory_size(self.memory_bytes)
            .table_elements(self.table_elements)
            .instances(1)
            .memories(1)
            .tables(MOST_TABLES)
            // else most modules fail later, where nobody sees why
            .trap_on_grow_failure(true)
            .build()
    }
}

/// Tables of a module.
pub(super) const MOST_TABLES: usize = 16;

/// Calls inside each other, and bytes of their values.
pub(super) const MOST_CALLS: usize = 1_000;
const MOST_STACK_BYTES: usize = 8 << 20;

/// A module that can run.
pub(super) struct Compiled {
    pub(super) engine: Engine,
    pub(super) module: Module,
    pub(super) linker: Linker<State>,
    pub(super) limits: Limits,
    pub(super) names: FunctionNames,
    /// The names of its exported functions.
    pub(super) functions: Vec<String>,
}

impl Compiled {
    /// Compiles `bytes` and checks what it imports and exports; `own` is the name of the lab's own function, if the task has one.
    ///
    /// # Errors
    /// [`Stop::DidNotBuild`] with the reason, and [`Stop::OverBudget`] for a module that is too large.
    pub(super) fn new(bytes: &[u8], limits: Limits, own: Option<&str>) -> Result<Self, Stop> {
        if bytes.len() as u64 > limits.module_bytes {
            return Err(Stop::OverBudget {
                budget: Budget::ModuleBytes,
                limit: limits.module_bytes,
                place: None,
                function: None,
            });
        }
        header(bytes)?;
        let engine = Engine::new(&config());
        Module::validate(&engine, bytes).map_err(|error| invalid(&error))?;
        // what is valid can be marked, and is still valid then
        let fault = |error: &dyn std::fmt::Display| Stop::GraderFault(format!("a module: {error}"));
        let names = FunctionNames::of(bytes);
        let marked = marked(bytes).map_err(|error| fault(&error))?;
        let module = Module::new(&engine, &marked).map_err(|error| {
            // two exports of one name
            if bytes
                .windows(MARK.len())
                .any(|part| part == MARK.as_bytes())
            {
                let message = format!("the module has the name `{MARK}`, which Kinemark uses");
                return refused(message, "call it something else");
            }
            invalid(&error)
        })?;
        let linker = imports::linker(&engine).map_err(|error| fault(&error))?;
        let compiled = Self {
            functions: exported_functions(&module),
            engine,
            module,
            linker,
            limits,
            names,
        };
        compiled.imports()?;
        compiled.exports(own)?;
        Ok(compiled)
    }

    /// Refuses imports that are not there, or of another type.
    fn imports(&self) -> Result<(), Stop> {
        for import in self.module.imports() {
            let (module, name) = (import.module(), import.name());
            let shown = format!("`{module}.{name}`");
            let ExternType::Func(wanted) = import.ty() else {
                let help = match OF_OBJECT_FILES.contains(&name) {
                    true => OBJECT_FILE,
                    false => {
                        "let it define its own memory, tables and globals: leave out options such as --import-memory"
                    }
                };
                return Err(refused(
                    format!("the module imports {shown}, which is no function"),
                    help,
                ));
            };
            let Some(there) = imports::type_of(module, name) else {
                return Err(refused(
                    format!("the module imports {shown}, which is not there"),
                    &missing_import(module, name),
                ));
            };
            if there != *wanted {
                return Err(refused(
                    format!(
                        "the module imports {shown} as {}, it is {}",
                        shape(wanted),
                        shape(&there)
                    ),
                    "declare it as kinemark.h does",
                ));
            }
        }
        Ok(())
    }

    /// Refuses a module without what every module has, and functions of another type than they are called with.
    fn exports(&self, own: Option<&str>) -> Result<(), Stop> {
        let is_memory = matches!(self.module.get_export(MEMORY), Some(ExternType::Memory(_)));
        if !is_memory {
            return Err(refused(
                format!("the module exports no memory named `{MEMORY}`"),
                "it has no other name in C and Rust; in WebAssembly text write (memory (export \"memory\") 2)",
            ));
        }
        for (name, counts) in REQUIRED {
            if !self.functions.iter().any(|known| known == name) {
                return Err(refused(
                    format!(
                        "the module exports no function `{name}`, so it is not made for Kinemark"
                    ),
                    "in C include kinemark.h, in Rust use the crate kinemark-plugin: they define it",
                ));
            }
            self.has_type(name, *counts)?;
        }
        let own = own.map(export_name);
        for (name, usual, _) in FUNCTIONS {
            if own.as_deref() == Some(name) || (self.has_own_type(name) && is_of_cases(name)) {
                continue;
            }
            if self.functions.iter().any(|known| known == name) {
                self.has_type(name, *usual)?;
            }
        }
        match own {
            Some(name) if self.functions.contains(&name) => self.has_type(&name, OWN_FUNCTION),
            _ => Ok(()),
        }
    }

    /// Whether an export is made for a map and an answer, as a task of poses calls it, which may be another task than this.
    fn has_own_type(&self, name: &str) -> bool {
        let own = func_type(OWN_FUNCTION);
        matches!(self.module.get_export(name), Some(ExternType::Func(there)) if there == own)
    }

    /// Refuses one of [`FUNCTIONS`] that is made for another task than the one that calls it.
    pub(super) fn is_usual(&self, name: &str) -> Result<(), Stop> {
        match FUNCTIONS.iter().find(|(known, ..)| *known == name) {
            Some((_, usual, _)) => self.has_type(name, *usual),
            None => Ok(()),
        }
    }

    fn has_type(&self, name: &str, counts: [usize; 2]) -> Result<(), Stop> {
        let wanted = func_type(counts);
        match self.module.get_export(name) {
            Some(ExternType::Func(there)) if there != wanted => Err(refused(
                format!(
                    "the module exports `{name}` as {}, it is called as {}",
                    shape(&there),
                    shape(&wanted)
                ),
                &match REQUIRED.iter().any(|(known, _)| *known == name) {
                    true => "leave it to kinemark.h, or to the crate kinemark-plugin".to_owned(),
                    false => {
                        let result = if counts[1] == 0 { "void" } else { "km_u32" };
                        declared_as(result, name, counts)
                    }
                },
            )),
            _ => Ok(()),
        }
    }
}

/// What every module exports besides its memory, with how many pointers or counts it takes and returns.
const REQUIRED: &[(&str, [usize; 2])] = &[("km_version", [0, 1]), ("km_buffer", [1, 1])];

/// The functions that tasks name, with the same counts, and their parameters in C.
pub(super) const FUNCTIONS: &[(&str, [usize; 2], &str)] = &[
    (
        "km_forward_kinematics",
        [3, 0],
        "const km_robot *robot, const double *q, double *position",
    ),
    (
        "km_inverse_kinematics",
        [4, 1],
        "const km_robot *robot, const double *position, double *branches, km_u32 most",
    ),
    (
        "km_jacobian",
        [3, 1],
        "const km_robot *robot, const double *q, double *matrix",
    ),
    ("km_init", [2, 0], "const km_robot *robot, const char *task"),
    (
        "km_control",
        [2, 0],
        "const km_observation *observation, double *command",
    ),
];

/// The counts of a function of the lab's own, and its parameters in C.
const OWN_FUNCTION: [usize; 2] = [2, 0];
const OWN_PARAMETERS: &str = "const km_map *given, km_answer *answer";

/// Whether a function is called on cases, so that a task of poses may call it with a map.
fn is_of_cases(export: &str) -> bool {
    !matches!(export, "km_init" | "km_control")
}

fn func_type([parameters, results]: [usize; 2]) -> FuncType {
    let words = |count| vec![ValType::I32; count];
    FuncType::new(words(parameters), words(results))
}

/// What to write in C for an export that is called with so many parameters and results.
fn declared_as(result: &str, export: &str, counts: [usize; 2]) -> String {
    let known = FUNCTIONS.iter().any(|(known, ..)| *known == export);
    match export.strip_prefix("km_") {
        // kinemark.h declares the name for tasks of positions
        Some(name) if known && counts == OWN_FUNCTION && is_of_cases(export) => {
            format!(
                "in C write KM_EXPORT({export}) {result} {name}({OWN_PARAMETERS}), in Rust name `{name}` after `own` in `export!`"
            )
        }
        _ => format!(
            "in C declare it as {result} {export}({})",
            declared_parameters(export)
        ),
    }
}

/// How C declares the parameters of an export that a task calls.
fn declared_parameters(export: &str) -> &'static str {
    let known = FUNCTIONS.iter().find(|(known, ..)| *known == export);
    known.map_or(OWN_PARAMETERS, |(.., parameters)| parameters)
}

/// The names of its parameters, with commas between them.
pub(super) fn parameter_names(export: &str) -> String {
    let declared = declared_parameters(export).split(", ");
    let names = declared.filter_map(|one| one.rsplit([' ', '*']).next());
    names.collect::<Vec<&str>>().join(", ")
}

/// The export of the function that scripts call `name`.
pub(super) fn export_name(name: &str) -> String {
    format!("km_{name}")
}

fn config() -> Config {
    let mut config = Config::default();
    config
        .consume_fuel(true)
        .compilation_mode(CompilationMode::Eager)
        .set_max_recursion_depth(MOST_CALLS)
        .set_max_stack_height(MOST_STACK_BYTES)
        .wasm_multi_memory(false)
        .wasm_tail_call(false)
        .ignore_custom_sections(true);
    config
}

/// Refuses what is no core module of version 1, in words.
fn header(bytes: &[u8]) -> Result<(), Stop> {
    let help = "hand in the module that your compiler or linker wrote: clang with --target=wasm32, or cargo with --target wasm32-unknown-unknown";
    match bytes.get(4..8) {
        Some([1, 0, 0, 0]) => Ok(()),
        Some([_, _, 1, 0]) => Err(refused(
            "the file is a WebAssembly component, not a core module".to_owned(),
            help,
        )),
        Some(_) => Err(refused(
            "the file is WebAssembly of another version than 1".to_owned(),
            help,
        )),
        None => Err(refused(
            "the file ends within the header of a WebAssembly module".to_owned(),
            help,
        )),
    }
}

fn exported_functions(module: &Module) -> Vec<String> {
    let functions = module
        .exports()
        .filter(|export| matches!(export.ty(), ExternType::Func(_)));
    functions.map(|export| export.name().to_owned()).collect()
}

/// What the validator says about a module.
fn invalid(error: &wasmi::Error) -> Stop {
    let message = error.to_string();
    let help = if message.contains("SIMD") {
        "build it without SIMD: leave out -msimd128 and target features such as +simd128"
    } else if message.contains("threads") || message.contains("shared") {
        "build it without threads and shared memory"
    } else if message.contains("memory64") || message.contains("64-bit") {
        "build it for wasm32, not for wasm64"
    } else if message.contains("not enabled") {
        "build it for plain wasm32: leave out the target features that it names"
    } else {
        "build it again: the file may be cut off or changed after it was built"
    };
    refused(format!("the module is not valid: {message}"), help)
}

/// What only the object files of a compiler import, before they are linked.
const OF_OBJECT_FILES: &[&str] = &[
    "__wasm_call_ctors",
    "__linear_memory",
    "__stack_pointer",
    "__indirect_function_table",
];
const OBJECT_FILE: &str =
    "this is an object file, not a module yet: leave out -c, and let the compiler link it";

/// Functions of the C library that students call, and what there is instead.
const OF_THE_C_LIBRARY: &[(&[&str], &str)] = &[
    (
        &[
            "printf", "puts", "putchar", "fprintf", "sprintf", "snprintf", "vprintf", "iprintf",
        ],
        "there is no standard output: `km_log(\"text\")` and `km_log_number(\"name\", x)` write to the log of the report",
    ),
    (
        &[
            "malloc", "calloc", "realloc", "free", "_Znwm", "_Znam", "_ZdlPv", "_Znwj", "_Znaj",
        ],
        "there is no heap in C and C++: use arrays of a fixed size, static where they are large",
    ),
    (&["fma"], "write a * b + c: there is no fused multiply-add"),
    (
        &[
            "sinf", "cosf", "tanf", "asinf", "acosf", "atanf", "atan2f", "sqrtf", "powf", "expf",
            "logf", "fabsf", "hypotf", "fmodf",
        ],
        "use double and the function without the f at its end",
    ),
    (
        &["rand", "srand", "random", "time", "clock", "gettimeofday"],
        "there is no clock and no chance: the observation has the time, and every run is the same",
    ),
    (
        &["exit", "abort", "_Exit"],
        "`km_fail(\"why\")` ends a call",
    ),
    (
        &["sincos"],
        "call `sin` and `cos`, or build with -fno-builtin",
    ),
    (OF_OBJECT_FILES, OBJECT_FILE),
];

/// What to do about an import that is not there.
fn missing_import(module: &str, name: &str) -> String {
    if module.starts_with("wasi") {
        return "there is no WASI here: no files, clocks or standard output. In C leave out <stdio.h> and <stdlib.h>; in Rust build for wasm32-unknown-unknown".to_owned();
    }
    if module.contains("wbindgen") || name.contains("wbindgen") {
        return "build it with cargo alone, not with wasm-bindgen or wasm-pack".to_owned();
    }
    if name.starts_with("km_") {
        return "Kinemark defines no function `km_...`: include kinemark.h, which declares what there is by its own name".to_owned();
    }
    if let Some((_, help)) = OF_THE_C_LIBRARY
        .iter()
        .find(|(known, _)| known.contains(&name))
    {
        return (*help).to_owned();
    }
    // __addtf3, __multf3, __trunctfdf2: what long double is made of
    if name.starts_with("__") && name.contains("tf") {
        return "use double: there is no long double in WebAssembly, and no literals such as 1.0L"
            .to_owned();
    }
    let known: Vec<&str> = imports::names().map(|(_, name)| name).collect();
    match kinemark_sim::text::nearest(name, known.iter().copied()) {
        Some(near) => format!("did you mean `{near}`? docs/plugin.md lists what can be imported"),
        None => "define it in your own code; docs/plugin.md lists what can be imported".to_owned(),
    }
}

/// A function's type in words: `(i32, i32) -> (f64)`.
fn shape(function: &FuncType) -> String {
    let list = |types: &[ValType]| {
        let names: Vec<String> = types
            .iter()
            .map(|of| format!("{of:?}").to_lowercase())
            .collect();
        names.join(", ")
    };
    format!(
        "({}) -> ({})",
        list(function.params()),
        list(function.results())
    )
}

/// The stop of a module that cannot be used.
pub(super) fn refused(message: String, help: &str) -> Stop {
    Stop::DidNotBuild(Mistake {
        message,
        place: None,
        help: Some(help.to_owned()),
        further: Vec::new(),
    })
}
