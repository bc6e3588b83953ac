//! What every module exports besides its functions: the version of the interface, and the place where Kinemark writes what functions
//! get.

use core::cell::UnsafeCell;
use core::ffi::c_void;
use core::ptr;

use crate::panic::watch;

/// The version of `kinemark.h` that this crate speaks.
const VERSION: u32 = 1;

/// Bytes of the buffer: enough for what most tasks give.
const BYTES: usize = 65_536;

#[repr(C, align(8))]
struct Buffer(UnsafeCell<[u8; BYTES]>);

// SAFETY: only its address is taken here; Kinemark writes to it between calls, and a module has one thread
unsafe impl Sync for Buffer {}

static BUFFER: Buffer = Buffer(UnsafeCell::new([0; BYTES]));

/// Called first: once in each instance, and before any function of the author's.
#[unsafe(no_mangle)]
extern "C" fn km_version() -> u32 {
    watch();
    VERSION
}

/// Called once in each instance: an address that is a multiple of 8 and has room for so many bytes; 0 if there is none.
#[unsafe(no_mangle)]
extern "C" fn km_buffer(bytes: usize) -> *mut c_void {
    if bytes <= BYTES {
        BUFFER.0.get().cast()
    } else {
        grown(bytes)
    }
}

/// Room that no allocator knows, at the end of the memory.
#[cfg(target_arch = "wasm32")]
fn grown(bytes: usize) -> *mut c_void {
    use core::arch::wasm32::memory_grow;

    const PAGE_BYTES: usize = 65_536;
    match memory_grow(0, bytes.div_ceil(PAGE_BYTES)) {
        usize::MAX => ptr::null_mut(),
        pages => ptr::without_provenance_mut(pages * PAGE_BYTES),
    }
}

#[cfg(not(target_arch = "wasm32"))]
fn grown(_: usize) -> *mut c_void {
    ptr::null_mut()
}
