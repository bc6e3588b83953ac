//! The runtime of submissions in Python, as a WebAssembly module: RustPython's virtual machine with `math`, `numpy` and what submissions are
//! given. The grader writes requests into its memory and reads replies from it (`kinemark-python-wire`).
//!
//! The module is trusted, the file that it runs is not: it sees what this module gives it, and the module sees the imports below only. One
//! thread runs it, one request at a time.

mod convert;
mod host;
mod observation;
mod raised;
mod run;
mod start;

use std::cell::RefCell;

use kinemark_python_wire::{Call, Load, Reply, from_bytes, to_bytes};
use rustpython_vm::Interpreter;

use run::Loaded;

// SAFETY: the module has one thread
#[global_allocator]
static MEMORY: kinemark_python_pools::Pools<std::alloc::System> =
    unsafe { kinemark_python_pools::Pools::new(std::alloc::System) };

/// Bytes that are free after the start: what most calls take, so that the memory of a case does not grow beyond that with which it begins.
const ROOM: usize = 1 << 20;

/// What stays from request to request.
struct Runtime {
    interpreter: Interpreter,
    names: start::Names,
    loaded: Option<Loaded>,
}

thread_local! {
    static RUNTIME: RefCell<Option<Runtime>> = const { RefCell::new(None) };
    static REQUEST: RefCell<Vec<u8>> = const { RefCell::new(Vec::new()) };
    static REPLY: RefCell<Vec<u8>> = const { RefCell::new(Vec::new()) };
}

/// Starts the interpreter: done once, when the image of its memory is made.
#[unsafe(no_mangle)]
pub extern "C" fn km_start() {
    std::panic::set_hook(Box::new(|panic| host::panicked(&panic.to_string())));
    let (interpreter, names) = start::started();
    // the allocator keeps what it has taken
    drop(std::hint::black_box(Vec::<u8>::with_capacity(ROOM)));
    RUNTIME.with(|runtime| {
        *runtime.borrow_mut() = Some(Runtime {
            interpreter,
            names,
            loaded: None,
        });
    });
}

/// Room for a request of so many bytes.
#[unsafe(no_mangle)]
pub extern "C" fn km_room(bytes: u32) -> *mut u8 {
    REQUEST.with(|request| {
        let mut request = request.borrow_mut();
        request.clear();
        request.resize(bytes as usize, 0);
        request.as_mut_ptr()
    })
}

/// Loads a submission; the length of the reply.
#[unsafe(no_mangle)]
pub extern "C" fn km_load() -> u32 {
    reply(|runtime, request| {
        let load: Load = from_bytes(request)?;
        let Runtime {
            interpreter,
            names,
            loaded,
        } = runtime;
        let (reply, now) = interpreter.enter(|vm| run::load(vm, names, load));
        *loaded = now;
        Ok(reply)
    })
}

/// Calls a function of the submission; the length of the reply.
#[unsafe(no_mangle)]
pub extern "C" fn km_call() -> u32 {
    reply(|runtime, request| {
        let call: Call = from_bytes(request)?;
        let Runtime {
            interpreter,
            names,
            loaded,
        } = runtime;
        let Some(loaded) = loaded else {
            return Err("no submission is loaded".to_owned());
        };
        Ok(interpreter.enter(|vm| loaded.call(vm, names, call)))
    })
}

/// Where the last reply is.
#[unsafe(no_mangle)]
pub extern "C" fn km_reply() -> *const u8 {
    REPLY.with(|reply| reply.borrow().as_ptr())
}

/// Where the submission was when it was stopped from outside; the length of the reply. What it does not touch is in any state then.
#[unsafe(no_mangle)]
pub extern "C" fn km_stopped() -> u32 {
    let stopped = raised::stopped();
    let bytes = to_bytes(&stopped).unwrap_or_default();
    // what held the last reply may be borrowed
    let bytes = Box::leak(bytes.into_boxed_slice());
    REPLY.with(|reply| match reply.try_borrow_mut() {
        Ok(mut reply) => {
            reply.clear();
            reply.extend_from_slice(bytes);
            bytes.len() as u32
        }
        Err(_) => 0,
    })
}

/// Answers the request; a request that cannot be read ends the module, since only the grader makes requests.
fn reply(answer: impl FnOnce(&mut Runtime, &[u8]) -> Result<Reply, String>) -> u32 {
    let request = REQUEST.with(|request| std::mem::take(&mut *request.borrow_mut()));
    let replied = RUNTIME.with(|runtime| match runtime.borrow_mut().as_mut() {
        Some(runtime) => answer(runtime, &request).and_then(|reply| to_bytes(&reply)),
        None => Err("the runtime is not started".to_owned()),
    });
    REQUEST.with(|place| *place.borrow_mut() = request);
    match replied {
        Ok(bytes) => REPLY.with(|reply| {
            *reply.borrow_mut() = bytes;
            reply.borrow().len() as u32
        }),
        Err(why) => panic!("{why}"),
    }
}

/// No randomness: what draws a number at the start gets the same bytes each time.
///
/// # Safety
/// `bytes` has room for `count` bytes, as `getrandom` says.
#[unsafe(no_mangle)]
unsafe extern "Rust" fn __getrandom_v03_custom(
    bytes: *mut u8,
    count: usize,
) -> Result<(), getrandom::Error> {
    // SAFETY: as above
    unsafe { std::ptr::write_bytes(bytes, 0x5a, count) };
    Ok(())
}
