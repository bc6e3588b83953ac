//! Exceptions and stops as the grader reads them: what, and where in the submission.

use std::cell::RefCell;

use kinemark_python_wire::{Place, Reply, Stopped};
use rustpython_compiler_core::SourceLocation;
use rustpython_vm::builtins::{PyBaseExceptionRef, PyCode, PyInt, PyStr};
use rustpython_vm::frame::current_thread_iframe;
use rustpython_vm::{AsObject, Py, VirtualMachine};

use crate::host;

/// Characters of a message that are kept.
const LONGEST_MESSAGE: usize = 500;

thread_local! {
    static FILE: RefCell<String> = const { RefCell::new(String::new()) };
}

/// Sets the name of the submission's file, by which its frames are known.
pub(crate) fn set_file(file: &str) {
    FILE.with(|own| file.clone_into(&mut own.borrow_mut()));
}

fn is_own(code: &Py<PyCode>) -> bool {
    FILE.with(|own| code.code.source_path.as_wtf8().to_string() == *own.borrow())
}

fn place(at: SourceLocation) -> Place {
    Place {
        line: at.line.get() as u32,
        column: at.character_offset.get() as u32,
    }
}

/// Where an instruction of a code object comes from.
fn place_in(code: &Py<PyCode>, instruction: usize) -> Option<Place> {
    let locations = &code.code.locations;
    let at = instruction.min(locations.len().checked_sub(1)?);
    Some(place(locations[at].0))
}

/// Where the statement of an instruction is. What stands before the first statement has the line of the `def`, or of the file's beginning:
/// whoever is there is about to run a statement, since a loop that begins a function jumps back to behind it.
fn place_of_statement(code: &Py<PyCode>, instruction: usize) -> Option<Place> {
    let place = place_in(code, instruction);
    let next = match code.code.obj_name.as_wtf8().to_string().as_str() {
        "<module>" if instruction == 0 => place_in(code, 1),
        // a comprehension begins with its own line
        name if name.starts_with('<') => None,
        _ => {
            let head = code.code.first_line_number.map(|line| line.get() as u32);
            let rest = (instruction..code.code.locations.len()).filter_map(|at| place_in(code, at));
            rest.into_iter().find(|place| Some(place.line) != head)
        }
    };
    next.or(place)
}

/// What is wrong with a file that cannot be compiled.
pub(crate) fn not_compiled(error: &PyBaseExceptionRef, vm: &VirtualMachine) -> Reply {
    reply(error, true, vm)
}

/// An exception that a submission did not catch.
pub(crate) fn raised(error: &PyBaseExceptionRef, vm: &VirtualMachine) -> Reply {
    reply(error, false, vm)
}

fn reply(error: &PyBaseExceptionRef, is_of_compiler: bool, vm: &VirtualMachine) -> Reply {
    let kind = error.class().name().to_string();
    let attribute = |name: &'static str| error.as_object().get_attr(name, vm).ok();
    let text = |name| {
        let value = attribute(name)?;
        let text = value.downcast_ref::<PyStr>()?;
        Some(text.to_string())
    };
    let message = match is_of_compiler {
        true => text("msg"),
        false => error.as_object().str(vm).ok().map(|text| text.to_string()),
    };
    let message: String = message
        .unwrap_or_default()
        .chars()
        .take(LONGEST_MESSAGE)
        .collect();
    let number = |name| {
        let value = attribute(name)?;
        let number = value.downcast_ref::<PyInt>()?;
        number.try_to_primitive::<u32>(vm).ok()
    };
    let mut at = None;
    if is_of_compiler {
        at = number("lineno").map(|line| Place {
            line: line.max(1),
            column: number("offset").unwrap_or(1).max(1),
        });
    }
    let mut step = if at.is_none() {
        error.__traceback__()
    } else {
        None
    };
    while let Some(traceback) = step {
        let code = traceback.frame.iframe().code();
        if is_own(code) {
            let instruction = usize::try_from(traceback.lasti).unwrap_or(0) / 2;
            at = place_in(code, instruction);
            let line = traceback.lineno.get() as u32;
            // what was compiled for another line says less than the line of the traceback
            if at.is_none_or(|at| at.line != line) {
                at = Some(Place { line, column: 1 });
            }
        }
        step = traceback.next.lock().clone();
    }
    Reply::Raised {
        kind,
        message,
        place: at,
        name: text("name"),
        is_of_compiler,
    }
}

/// The line of the submission that runs now; 0 if none of it does.
pub(crate) fn current_line() -> u32 {
    let (place, _) = running();
    place.map_or(0, |place| place.line)
}

/// Where the submission is, read without running anything: it was stopped in the middle.
pub(crate) fn stopped() -> Stopped {
    let (place, function) = running();
    Stopped {
        place,
        function,
        panic: host::last_panic(),
    }
}

/// The place in the submission that runs now, and its function.
fn running() -> (Option<Place>, Option<String>) {
    let mut frame = current_thread_iframe();
    while !frame.is_null() {
        // SAFETY: the chain holds the frames that run, which live until they return, and nothing returned since
        let here = unsafe { &*frame };
        let code = here.code();
        if is_own(code) {
            let place = place_of_statement(code, (here.get_lasti() as usize).saturating_sub(1));
            return (place, Some(code.code.obj_name.as_wtf8().to_string()));
        }
        frame = here.previous();
    }
    (None, None)
}
