//! The address space of an instance's memory: as much as a submission may have, of which the system gives what is written. An interpreter of
//! WebAssembly without it keeps the memory in a vector, which is copied as a whole where it grows and is then twice as large.

use memmap2::MmapMut;

use super::instance::MEMORY_BYTES;

/// The address space of one memory.
pub(super) struct Region(MmapMut);

impl Region {
    /// One that is all zero.
    ///
    /// # Errors
    /// The system's, where it has none.
    pub(super) fn new() -> std::io::Result<Self> {
        let region = MmapMut::map_anon(MEMORY_BYTES)?;
        // a start writes most of the first 12 MB: in six pages rather than three thousand, where the system has such
        #[cfg(target_os = "linux")]
        let _ = region.advise(memmap2::Advice::HugePage);
        Ok(Self(region))
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
        // SAFETY: the bytes are this region's, and whoever calls sees to the rest
        unsafe { std::slice::from_raw_parts_mut(self.0.as_mut_ptr(), self.0.len()) }
    }
}
