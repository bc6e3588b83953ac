//! The output of a script: `print` adds a line to the log, `plot` adds a value to a signal of the report.

use rhai::{Dynamic, ImmutableString};

use super::budget::Meter;
use super::library::{Arguments, Library};
use super::mistake::{Problem, fault};
use super::operand::Operand;
use super::words::{describe, show};
use crate::submission::output::{LONGEST_SIGNAL_NAME, is_signal_name};

/// `print(a, b, ...)` takes up to this many.
const MOST_PRINTED: usize = 8;

pub(super) fn register(library: &mut Library) {
    for name in ["print", "debug"] {
        for parameters in 0..=MOST_PRINTED {
            library.function(name, parameters, print);
        }
    }
    library.function("plot", 2, plot);
}

fn print(meter: &Meter, arguments: Arguments<'_, '_>) -> Result<Dynamic, Problem> {
    let mut line = String::new();
    for (index, value) in arguments.iter().enumerate() {
        if index > 0 {
            line.push(' ');
        }
        line.push_str(&show(meter, value)?);
        meter.text(line.len())?;
    }
    meter.print(line);
    Ok(Dynamic::UNIT)
}

fn plot(meter: &Meter, arguments: Arguments<'_, '_>) -> Result<Dynamic, Problem> {
    let Ok(name) = arguments[0].as_immutable_string_ref() else {
        return Err(fault(format!(
            "`plot` takes a name and a value, plot(\"error\", e), got {}",
            describe(arguments[0])
        )));
    };
    let name: &ImmutableString = &name;
    if !is_signal_name(name) {
        return Err(fault(format!(
            "the name of a signal has 1 to {LONGEST_SIGNAL_NAME} characters"
        )));
    }
    match Operand::of(arguments[1]) {
        Operand::Vector(vector) => {
            // each sample stores its name
            meter.charge(8 * vector.len())?;
            for (index, value) in vector.elements().iter().enumerate() {
                meter.plot(format!("{name}[{index}]"), *value);
            }
        }
        operand => match operand.number().or_else(|| {
            let boolean = arguments[1].as_bool().ok()?;
            Some(f64::from(u8::from(boolean)))
        }) {
            Some(value) => meter.plot(name.to_string(), value),
            None => {
                return Err(fault(format!(
                    "`plot` shows numbers and vectors, got {}",
                    describe(arguments[1])
                )));
            }
        },
    }
    Ok(Dynamic::UNIT)
}
