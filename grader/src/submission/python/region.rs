//! The address space of an instance's memory: as much as a submission may have, of which the system gives what is written. An interpreter of
//! WebAssembly without it keeps the memory in a vector, which is copied as a whole where it grows and is then twice as large.

use std::sync::{Mutex, PoisonError};

use memmap2::MmapMut;

use super::instance::MEMORY_BYTES;

/// Those that were given back, for the next instances, to which the system need not give their bytes anew.
static KEPT: Mutex<Vec<MmapMut>> = Mutex::new(Vec::new());
/// A task has two instances.
const MOST_KEPT: usize = 2;

/// The address space of one memory.
pub(super) struct Region {
    /// There until it is given back.
    bytes: Option<MmapMut>,
    /// Whether it is worth keeping: one in which a memory has grown holds more than the next instance needs.
    pub(super) is_kept: bool,
}

impl Region {
    /// One whose bytes can be anything: who makes a memory of it clears what that begins with, and what it grows by.
    ///
    /// # Errors
    /// The system's, where it has none.
    pub(super) fn new() -> std::io::Result<Self> {
        let kept = KEPT.lock().unwrap_or_else(PoisonError::into_inner).pop();
        let bytes = match kept {
            Some(kept) => kept,
            None => fresh()?,
        };
        Ok(Self {
            bytes: Some(bytes),
            is_kept: false,
        })
    }

    /// All of it.
    ///
    /// # Safety
    /// It is lent once, and not used after this region is dropped.
    #[expect(
        unsafe_code,
        reason = "the interpreter asks for bytes that last for ever"
    )]
    pub(super) unsafe fn lend(&mut self) -> &'static mut [u8] {
        let Some(bytes) = &mut self.bytes else {
            return &mut [];
        };
        // SAFETY: the bytes are this region's, and whoever calls sees to the rest
        unsafe { std::slice::from_raw_parts_mut(bytes.as_mut_ptr(), bytes.len()) }
    }
}

impl Drop for Region {
    fn drop(&mut self) {
        let mut kept = KEPT.lock().unwrap_or_else(PoisonError::into_inner);
        if self.is_kept && kept.len() < MOST_KEPT {
            kept.extend(self.bytes.take());
        }
    }
}

fn fresh() -> std::io::Result<MmapMut> {
    let region = MmapMut::map_anon(MEMORY_BYTES)?;
    // a start writes most of the first 9 MB: in five pages rather than two thousand, where the system has such
    #[cfg(target_os = "linux")]
    let _ = region.advise(memmap2::Advice::HugePage);
    Ok(region)
}
