//! What a module can import: output, the granted functions of the robot's model, and functions of `math.h`.

use std::cell::RefCell;
use std::rc::Rc;

use wasmi::{Caller, Engine, Error, FuncType, Linker, Memory, StoreLimits, TrapCode, ValType};

use crate::submission::controller::{Budget, Grant};
use crate::submission::output::{LONGEST_SIGNAL_NAME, Output, is_signal_name};
use crate::submission::robot_model::{Model, Quantity, cost};

/// Instructions that count like one operation of a script, for what both are charged for.
pub(super) const INSTRUCTIONS_PER_OPERATION: u64 = 40;

/// Instructions for a function of `math.h`.
const OF_MATH: u64 = 20;

/// Bytes of text for one instruction.
const BYTES_PER_INSTRUCTION: u64 = 8;

/// The module name of what is Kinemark's own, and of what C leaves undefined.
const OWN: &str = "kinemark";
const MATH: &str = "env";

type OfOne = fn(f64) -> f64;
type OfTwo = fn(f64, f64) -> f64;

/// Functions of one number, by their names in `math.h`.
const OF_ONE: &[(&str, OfOne)] = &[
    ("acos", libm::acos),
    ("acosh", libm::acosh),
    ("asin", libm::asin),
    ("asinh", libm::asinh),
    ("atan", libm::atan),
    ("atanh", libm::atanh),
    ("cbrt", libm::cbrt),
    ("ceil", libm::ceil),
    ("cos", libm::cos),
    ("cosh", libm::cosh),
    ("exp", libm::exp),
    ("exp2", libm::exp2),
    ("expm1", libm::expm1),
    ("fabs", libm::fabs),
    ("floor", libm::floor),
    ("log", libm::log),
    ("log10", libm::log10),
    ("log1p", libm::log1p),
    ("log2", libm::log2),
    ("round", libm::round),
    ("sin", libm::sin),
    ("sinh", libm::sinh),
    ("sqrt", libm::sqrt),
    ("tan", libm::tan),
    ("tanh", libm::tanh),
    ("trunc", libm::trunc),
];

/// Functions of two numbers, by their names in `math.h`.
const OF_TWO: &[(&str, OfTwo)] = &[
    ("atan2", libm::atan2),
    ("copysign", libm::copysign),
    ("fmax", libm::fmax),
    ("fmin", libm::fmin),
    ("fmod", libm::fmod),
    ("hypot", libm::hypot),
    ("pow", libm::pow),
];

/// Kinemark's own functions, besides the grants.
const OUTPUT: [&str; 3] = ["log", "plot", "fail"];

/// What imports work on.
pub(in crate::submission) struct State {
    pub(in crate::submission) limits: StoreLimits,
    pub(in crate::submission) memory: Option<Memory>,
    /// Whether the rest of the runtime of Python is there; plugins have none.
    #[cfg(feature = "python")]
    pub(in crate::submission) has_rest: bool,
    pub(in crate::submission) output: Rc<RefCell<Output>>,
    pub(in crate::submission) model: Option<Rc<Model>>,
    pub(in crate::submission) grants: Vec<Grant>,
    /// The longest text, in bytes.
    pub(in crate::submission) text_size: u64,
}

/// Why an import ended a call.
#[derive(Debug, Clone)]
pub(in crate::submission) enum Ended {
    /// The module's own words.
    Failed(String),
    /// What is wrong with how it called, and what to do.
    Misused(String, String),
    /// A budget ran out.
    Exhausted(Budget),
}

impl std::fmt::Display for Ended {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Failed(words) | Self::Misused(words, _) => f.write_str(words),
            Self::Exhausted(budget) => f.write_str(budget.name()),
        }
    }
}

impl wasmi::errors::HostError for Ended {}

/// Every function that can be imported, with the name of its module.
pub(super) fn names() -> impl Iterator<Item = (&'static str, &'static str)> {
    let of_one = OF_ONE.iter().map(|(name, _)| *name);
    let of_two = OF_TWO.iter().map(|(name, _)| *name);
    let own = OUTPUT.into_iter().chain(Grant::ALL.map(Grant::name));
    own.map(|name| (OWN, name))
        .chain(of_one.chain(of_two).map(|name| (MATH, name)))
}

/// The type of an import; `None` if there is none of this name.
pub(super) fn type_of(module: &str, name: &str) -> Option<FuncType> {
    use ValType::{F64, I32};
    names().find(|known| *known == (module, name))?;
    Some(match module {
        MATH if OF_TWO.iter().any(|(known, _)| *known == name) => FuncType::new([F64, F64], [F64]),
        MATH => FuncType::new([F64], [F64]),
        _ if name == "plot" => FuncType::new([I32, I32, F64], []),
        _ => FuncType::new([I32, I32], []),
    })
}

/// All imports.
pub(in crate::submission) fn linker(engine: &Engine) -> Result<Linker<State>, Error> {
    let mut linker = Linker::new(engine);
    for &(name, function) in OF_ONE {
        let apply = move |mut caller: Caller<'_, State>, x: f64| {
            charge(&mut caller, OF_MATH)?;
            Ok::<_, Error>(canonical(function(x)))
        };
        linker.func_wrap(MATH, name, apply)?;
    }
    for &(name, function) in OF_TWO {
        let apply = move |mut caller: Caller<'_, State>, x: f64, y: f64| {
            charge(&mut caller, OF_MATH)?;
            Ok::<_, Error>(canonical(function(x, y)))
        };
        linker.func_wrap(MATH, name, apply)?;
    }
    linker.func_wrap(
        OWN,
        "log",
        |mut caller: Caller<'_, State>, at: u32, bytes: u32| {
            let line = text(&mut caller, at, bytes)?;
            caller.data().output.borrow_mut().print(line, None);
            Ok::<_, Error>(())
        },
    )?;
    linker.func_wrap(
        OWN,
        "plot",
        |mut caller: Caller<'_, State>, at: u32, bytes: u32, value: f64| {
            let name = text(&mut caller, at, bytes)?;
            if !is_signal_name(&name) {
                return Err(Error::host(Ended::Misused(
                    format!("the name of a signal has 1 to {LONGEST_SIGNAL_NAME} characters"),
                    "shorten it, or give it one: km_plot(\"error\", e)".to_owned(),
                )));
            }
            caller.data().output.borrow_mut().plot(name, value);
            Ok::<_, Error>(())
        },
    )?;
    linker.func_wrap(
        OWN,
        "fail",
        |mut caller: Caller<'_, State>, at: u32, bytes: u32| -> Result<(), Error> {
            let words = text(&mut caller, at, bytes)?;
            Err(Error::host(Ended::Failed(words)))
        },
    )?;
    for grant in Grant::ALL {
        let call = move |mut caller: Caller<'_, State>, q: u32, out: u32| {
            granted(&mut caller, grant, q, out)
        };
        linker.func_wrap(OWN, grant.name(), call)?;
    }
    Ok(linker)
}

/// One bit pattern for every NaN, as the interpreter has it: those of `libm` differ between platforms.
pub(super) fn canonical(x: f64) -> f64 {
    if x.is_nan() {
        f64::from_bits(0x7ff8_0000_0000_0000)
    } else {
        x
    }
}

fn charge(caller: &mut Caller<'_, State>, instructions: u64) -> Result<(), Error> {
    let left = caller.get_fuel()?.checked_sub(instructions);
    caller.set_fuel(left.unwrap_or(0))?;
    match left {
        Some(_) => Ok(()),
        None => Err(TrapCode::OutOfFuel.into()),
    }
}

/// The bytes at `at`; a trap like any other access beyond the memory.
fn bytes(caller: &Caller<'_, State>, at: u32, count: u64) -> Result<Vec<u8>, Error> {
    let memory = caller.data().memory.map(|memory| memory.data(caller));
    let range = at as usize..usize::try_from(u64::from(at) + count).unwrap_or(usize::MAX);
    match memory.and_then(|memory| memory.get(range)) {
        Some(bytes) => Ok(bytes.to_vec()),
        None => Err(TrapCode::MemoryOutOfBounds.into()),
    }
}

/// A text in the module's memory, paid for.
pub(in crate::submission) fn text(
    caller: &mut Caller<'_, State>,
    at: u32,
    count: u32,
) -> Result<String, Error> {
    if u64::from(count) > caller.data().text_size {
        return Err(Error::host(Ended::Exhausted(Budget::TextSize)));
    }
    charge(
        caller,
        INSTRUCTIONS_PER_OPERATION + u64::from(count) / BYTES_PER_INSTRUCTION,
    )?;
    let bytes = bytes(caller, at, count.into())?;
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}

/// A granted function: reads `n` positions at `q`, and writes its numbers, row by row, at `out`.
fn granted(caller: &mut Caller<'_, State>, grant: Grant, q: u32, out: u32) -> Result<(), Error> {
    let name = grant.name();
    let model = caller.data().model.clone();
    let Some(model) = model.filter(|_| caller.data().grants.contains(&grant)) else {
        return Err(Error::host(Ended::Misused(
            format!("`{name}` of the robot's model is not granted in this task"),
            "the brief says which functions of the robot a task grants: compute it yourself here"
                .to_owned(),
        )));
    };
    let n = model.joints();
    charge(caller, cost(grant, n) * INSTRUCTIONS_PER_OPERATION)?;
    let q: Vec<f64> = numbers(&bytes(caller, q, 8 * n as u64)?);
    let answer = match model.answer(grant, &q) {
        Some(Quantity::Vector(numbers)) => numbers,
        Some(Quantity::Matrix(rows)) => rows.concat(),
        None => {
            return Err(Error::host(Ended::Misused(
                format!("`{name}` takes {n} positions, one per joint"),
                "give the joint positions as the observation has them".to_owned(),
            )));
        }
    };
    let written: Vec<u8> = answer
        .iter()
        .flat_map(|x| canonical(*x).to_le_bytes())
        .collect();
    let memory = caller.data().memory;
    let written = memory.map(|memory| memory.write(caller, out as usize, &written));
    match written {
        Some(Ok(())) => Ok(()),
        Some(Err(_)) | None => Err(TrapCode::MemoryOutOfBounds.into()),
    }
}

/// The numbers in a module's memory, whatever their alignment.
pub(super) fn numbers(bytes: &[u8]) -> Vec<f64> {
    let (numbers, _) = bytes.as_chunks::<8>();
    numbers
        .iter()
        .map(|bytes| f64::from_le_bytes(*bytes))
        .collect()
}
