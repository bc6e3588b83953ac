//! System calls as native code makes them, with no library between it and the system.

#![expect(
    unsafe_code,
    reason = "a hostile process has no safe wrappers, and the system must refuse it all the same"
)]

use std::ffi::{CString, c_long};
use std::io;

/// Makes a system call; what it returns, or the system's error.
pub(crate) fn call<const N: usize>(number: c_long, arguments: [usize; N]) -> io::Result<usize> {
    let argument = |place: usize| arguments.get(place).copied().unwrap_or(0);
    let [a, b, c, d, e, f] = [0, 1, 2, 3, 4, 5].map(argument);
    // SAFETY: every caller hands in addresses of its own live memory or none, and keeps no value that a call could take away
    let returned = unsafe { libc::syscall(number, a, b, c, d, e, f) };
    usize::try_from(returned).map_err(|_| io::Error::last_os_error())
}

/// A path as the system takes it.
pub(crate) fn path(text: &str) -> CString {
    CString::new(text).expect("a path without a zero")
}

/// An address of something in this process.
pub(crate) fn address<T: ?Sized>(of: &T) -> usize {
    std::ptr::from_ref(of).cast::<()>() as usize
}

/// The same of something that a call writes to.
pub(crate) fn address_of<T: ?Sized>(what: &mut T) -> usize {
    std::ptr::from_mut(what).cast::<()>() as usize
}

/// A process like this one, started by `start`, which returns zero in the new one; that ends at once, and this one waits for it.
pub(crate) fn forked(start: impl FnOnce() -> io::Result<usize>) -> io::Result<String> {
    let id = start()?;
    if id == 0 {
        exit(0);
    }
    call(libc::SYS_wait4, [id, 0, 0, 0])?;
    Ok(format!("process {id}"))
}

/// Ends this process at once.
pub(crate) fn exit(code: i32) -> ! {
    // SAFETY: nothing runs after it
    unsafe { libc::_exit(code) }
}

/// Ends, or stops, this process by a signal, named without `SIG`.
pub(crate) fn die_of(name: &str) {
    if name == "SEGV" {
        // SAFETY: there is no memory there, and the process is to end by that
        unsafe { std::ptr::null::<u8>().wrapping_add(8).read_volatile() };
    }
    if name == "ABRT" {
        std::process::abort();
    }
    let signal = match name {
        "KILL" => libc::SIGKILL,
        "XCPU" => libc::SIGXCPU,
        "STOP" => libc::SIGSTOP,
        "TERM" => libc::SIGTERM,
        "SYS" => libc::SIGSYS,
        _ => panic!("no signal `{name}`"),
    };
    let own = |number| call(number, []).expect("an id");
    let _ = call(
        libc::SYS_tgkill,
        [
            own(libc::SYS_getpid),
            own(libc::SYS_gettid),
            signal as usize,
        ],
    );
}

/// A system call by the door that 32-bit programs use, where numbers mean other calls: `getpid`.
#[cfg(target_arch = "x86_64")]
pub(crate) fn of_32_bits() -> io::Result<String> {
    let returned: u64;
    // SAFETY: `getpid` of 32-bit programs changes nothing but its result
    unsafe {
        std::arch::asm!("int 0x80", inlateout("rax") 20_u64 => returned, options(nostack));
    }
    let id = i32::try_from(returned).unwrap_or(-1);
    (id > 0)
        .then(|| format!("process {id}"))
        .ok_or_else(|| io::Error::from_raw_os_error(libc::ENOSYS))
}
