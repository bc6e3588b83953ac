//! A starter in a language other than that of scripts for a lab that has none: the functions of its tasks, which answer nothing yet.

use std::fmt::Write as _;

use kinemark_grader::lab::{Lab, TaskWork};
use kinemark_grader::task::model::{Function, FunctionTask};

use crate::language::Language;

/// A function that the lab calls.
#[derive(Debug, Clone)]
enum Called<'l> {
    /// One of the three functions that every submission can have.
    Usual(&'l Function),
    /// One that is given a map: of the lab's own, of poses, of a quantity.
    Named(&'l FunctionTask),
    Control,
}

impl Called<'_> {
    fn name(&self) -> &str {
        match self {
            Self::Usual(function) => function.name(),
            Self::Named(task) => task.name(),
            Self::Control => "control",
        }
    }
}

/// The names of what a function is given, where they are not those of the cases: `, under q, qd and robot.NAME`.
fn names_of_given(task: &FunctionTask) -> String {
    let parameters = task.parameters();
    let (robot, others) = match parameters.split_first() {
        Some((&"robot", others)) => (
            ", and what is known of the robot under \"robot.NAME\"",
            others,
        ),
        _ => ("", &parameters[..]),
    };
    match others {
        ["given"] => robot.to_owned(),
        others => format!(" ({}{robot})", others.join(", ")),
    }
}

/// The functions that the tasks of a lab call, each once, and the tasks that call them.
fn called(lab: &Lab) -> Vec<(Called<'_>, Vec<&str>)> {
    let mut all: Vec<(Called<'_>, Vec<&str>)> = Vec::new();
    for task in &lab.tasks {
        let one = match &task.work {
            TaskWork::Function(task, _) if task.is_usual() => Called::Usual(&task.function),
            TaskWork::Function(task, _) => Called::Named(task),
            TaskWork::Motion(..) => Called::Control,
        };
        match all.iter_mut().find(|(known, _)| known.name() == one.name()) {
            Some((_, tasks)) => tasks.push(&task.name),
            None => all.push((one, vec![&task.name])),
        }
    }
    all
}

/// The starter of a lab that has none of its own; none for a script, which every lab has.
pub(crate) fn plugin_starter(lab: &Lab, language: Language) -> Option<String> {
    let called = called(lab);
    match language {
        Language::Rhai => None,
        Language::Python => Some(python_starter(lab, &called)),
        Language::Rust => Some(in_rust(lab, &called)),
        Language::C => Some(in_c(lab, &called)),
    }
}

/// The title of the lab on one line, which ends no comment.
fn title(lab: &Lab) -> String {
    let words: Vec<&str> = lab.title.split_whitespace().collect();
    words.join(" ").replace("*/", "* /")
}

fn of_tasks(tasks: &[&str]) -> String {
    let names: Vec<String> = tasks.iter().map(|name| format!("\"{name}\"")).collect();
    let word = if names.len() == 1 { "Task" } else { "Tasks" };
    format!("{word} {}", names.join(", "))
}

fn in_c(lab: &Lab, called: &[(Called<'_>, Vec<&str>)]) -> String {
    let build = Language::C.build_line().unwrap_or_default();
    let mut text = format!(
        "/* {}\n *\n * brief.html says what is asked for, kinemark.h what there is to call.\n *\n *     {build}\n *     kinemark grade\n */\n#include \"kinemark.h\"\n",
        title(lab)
    );
    for (one, tasks) in called {
        let of = of_tasks(tasks);
        // into a string: nothing can fail
        let _ = match one {
            Called::Usual(Function::ForwardKinematics(_)) => write!(
                text,
                "\n/* {of}: write x, y and z of the TCP in metres. */\n\
                 void km_forward_kinematics(const km_robot *robot, const double *q, double *position) {{\n    \
                 (void)robot, (void)q;\n    position[0] = 0.0, position[1] = 0.0, position[2] = 0.0;\n}}\n"
            ),
            Called::Usual(Function::InverseKinematics(_)) => write!(
                text,
                "\n/* {of}: write every way to get to position = {{x, y, z}}, one joint position after the other, and return how many ways \
                 there are. */\n\
                 km_u32 km_inverse_kinematics(const km_robot *robot, const double *position, double *branches, km_u32 most) {{\n    \
                 (void)robot, (void)position, (void)branches, (void)most;\n    return 0;\n}}\n"
            ),
            Called::Usual(Function::Jacobian(rows)) => {
                let names: Vec<&str> = rows.names().collect();
                write!(
                    text,
                    "\n/* {of}: write the rows of the Jacobian ({}), one number a joint in each, and return how many rows there are. */\n\
                     km_u32 km_jacobian(const km_robot *robot, const double *q, double *matrix) {{\n    (void)q;\n    \
                     for (km_u32 i = 0; i < {rows} * robot->joints; i++) matrix[i] = 0.0;\n    return {rows};\n}}\n",
                    names.join(", "),
                    rows = names.len()
                )
            }
            Called::Named(task) => write!(
                text,
                "\n/* {of}: km_number(*given, \"NAME\") and km_numbers(*given, \"NAME\") are what is given{}, \
                 km_answer_number(answer, \"NAME\", x) and\n * km_answer_list write the answer; without a name it is the answer itself. */\n\
                 KM_EXPORT(km_{name}) void {own}(const km_map *given, km_answer *answer) {{\n    (void)given, (void)answer;\n}}\n",
                names_of_given(task),
                name = task.name(),
                // kinemark.h declares some of the usual names for what it grants
                own = match task.function {
                    Function::Free(_) => format!("km_{}", task.name()),
                    _ => task.name().to_owned(),
                }
            ),
            // every usual function stands above
            Called::Usual(_) => Ok(()),
            Called::Control => write!(
                text,
                "\n/* {of}, called every control period: write one number for each joint. */\n\
                 void km_control(const km_observation *observation, double *command) {{\n    \
                 for (km_u32 i = 0; i < observation->joints; i++) command[i] = 0.0;\n}}\n"
            ),
        };
    }
    text
}

fn python_starter(lab: &Lab, called: &[(Called<'_>, Vec<&str>)]) -> String {
    let mut functions = String::new();
    for (one, tasks) in called {
        let of = of_tasks(tasks);
        // into a string: nothing can fail
        let _ = match one {
            Called::Usual(Function::ForwardKinematics(_)) => write!(
                functions,
                "\n\ndef forward_kinematics(robot: Robot, q: Vector):\n    \
                 # {of}: return x, y and z of the TCP in metres.\n    return [0.0, 0.0, 0.0]\n"
            ),
            Called::Usual(Function::InverseKinematics(_)) => write!(
                functions,
                "\n\ndef inverse_kinematics(robot: Robot, position: Vector):\n    \
                 # {of}: return a list of every way to get to position = [x, y, z], each the position of every joint.\n    return []\n"
            ),
            Called::Usual(Function::Jacobian(rows)) => {
                let names: Vec<&str> = rows.names().collect();
                write!(
                    functions,
                    "\n\ndef jacobian(robot: Robot, q: Vector):\n    \
                     # {of}: return the rows of the Jacobian ({}), one number a joint in each.\n    \
                     return np.zeros(({}, robot.joints))\n",
                    names.join(", "),
                    names.len()
                )
            }
            Called::Named(task) => {
                let parameters = task.parameters();
                let typed: Vec<String> = parameters
                    .iter()
                    .map(|name| match *name {
                        "robot" => "robot: Robot".to_owned(),
                        "given" => "given: Given".to_owned(),
                        name => format!("{name}: Vector"),
                    })
                    .collect();
                write!(
                    functions,
                    "\n\ndef {}({}):\n    # {of}: the brief says what to return.\n    return None\n",
                    task.name(),
                    typed.join(", ")
                )
            }
            // every usual function stands above
            Called::Usual(_) => Ok(()),
            Called::Control => write!(
                functions,
                "\n\ndef control(observation: Observation):\n    \
                 # {of}, called every control period: return one number for each joint.\n    \
                 return np.zeros(len(observation.q))\n"
            ),
        };
    }
    let title: Vec<&str> = lab.title.split_whitespace().collect();
    let types = ["Given", "Observation", "Robot", "Vector"].into_iter();
    let used = types.filter(|name| functions.contains(&format!(": {name}")));
    format!(
        "# {}\n#\n# brief.html says what is asked for, python.md what there is to use.\n#\n#     kinemark grade\n\
         from __future__ import annotations\n\nfrom typing import TYPE_CHECKING\n\nimport numpy as np\n\n\
         if TYPE_CHECKING:  # for your editor: kinemark.pyi says what the parameters have\n    \
         from kinemark import {}\n{functions}",
        title.join(" "),
        used.collect::<Vec<&str>>().join(", ")
    )
}

/// A function in Rust: what it imports, and its text.
fn rust_function(one: &Called<'_>, of: &str) -> (&'static [&'static str], String) {
    match one {
        Called::Usual(Function::ForwardKinematics(_)) => (
            &["Robot"],
            format!(
                "\n    // {of}: return [x, y, z] of the TCP in metres.\n    fn forward_kinematics(&mut self, robot: &Robot, q: &[f64]) -> [f64; 3] {{\n        [0.0, 0.0, 0.0]\n    }}\n"
            ),
        ),
        Called::Usual(Function::InverseKinematics(_)) => (
            &["Robot", "Rows"],
            format!(
                "\n    // {of}: push the joint positions of every way to get to `position`.\n    fn inverse_kinematics(&mut self, robot: &Robot, position: [f64; 3], branches: &mut Rows) {{}}\n"
            ),
        ),
        Called::Usual(Function::Jacobian(rows)) => {
            let names: Vec<&str> = rows.names().collect();
            let text = format!(
                "\n    // {of}: push the rows of the Jacobian ({}), one number a joint in each.\n    fn jacobian(&mut self, robot: &Robot, q: &[f64], rows: &mut Rows) {{\n        \
                 for _ in 0..{} {{\n            rows.push(&vec![0.0; q.len()]);\n        }}\n    }}\n",
                names.join(", "),
                names.len()
            );
            (&["Robot", "Rows"], text)
        }
        Called::Named(task) => (
            &["Answer", "Map"],
            format!(
                "\n    // {of}: given.number(\"NAME\") and given.numbers(\"NAME\") are what is given{}, answer.number(\"NAME\", x) and\n    \
                 // answer.list write the answer; without a name it is the answer itself.\n    fn {name}(&mut self, given: &Map, answer: &mut Answer) {{}}\n",
                names_of_given(task),
                name = task.name()
            ),
        ),
        // every usual function stands above
        Called::Usual(_) => (&[], String::new()),
        Called::Control => (
            &["Observation"],
            format!(
                "\n    // {of}, called every control period: write one number for each joint.\n    fn control(&mut self, observation: &Observation, command: &mut [f64]) {{\n        command.fill(0.0);\n    }}\n"
            ),
        ),
    }
}

fn in_rust(lab: &Lab, called: &[(Called<'_>, Vec<&str>)]) -> String {
    let build = Language::Rust.build_line().unwrap_or_default();
    let mut imports = vec!["Submission", "export"];
    let (mut exported, mut own) = (Vec::new(), Vec::new());
    let (mut of_trait, mut of_type) = (String::new(), String::new());
    for (one, tasks) in called {
        let (imported, text) = rust_function(one, &of_tasks(tasks));
        imports.extend(imported);
        if matches!(one, Called::Named(_)) {
            own.push(one.name());
            of_type += &text;
        } else {
            exported.push(one.name());
            of_trait += &text;
        }
    }
    imports.sort_unstable();
    imports.dedup();
    let own = own.join(", ");
    let own = (!own.is_empty()).then(|| format!("own {own}"));
    exported.extend(own.as_deref());
    let block = |head: &str, functions: &str| match functions.trim_start_matches('\n') {
        "" => format!("{head} {{}}\n"),
        functions => format!("{head} {{\n{functions}}}\n"),
    };
    let trait_block = block("impl Submission for Work", &of_trait);
    let type_block = match of_type.as_str() {
        "" => String::new(),
        functions => format!("\n{}", block("impl Work", functions)),
    };
    format!(
        "//! {}\n//!\n//! brief.html says what is asked for. Build with `{build}`, and grade with `kinemark grade`.\n\
         //! What you print with `kinemark_plugin::log!` is in the report; `println!` prints nowhere.\n\n\
         // Until your formulas use them all: then delete this line, and the compiler finds what you forgot.\n\
         #![allow(unused_variables)]\n\n\
         use kinemark_plugin::{{{}}};\n\n\
         // The functions that are called from outside.\nexport!(Work: {});\n\n\
         /// What you keep from call to call, in fields that you add. Each run begins with `Work::default()`.\n\
         #[derive(Default)]\nstruct Work {{}}\n\n{trait_block}{type_block}",
        title(lab),
        imports.join(", "),
        exported.join(", "),
    )
}
