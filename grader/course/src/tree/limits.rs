//! How much is read of a source: what a file says of its own size is not believed, what comes out of it is counted.

/// Limits on a source and on the archives inside it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Limits {
    /// Entries of a folder or of one archive.
    pub entries: usize,
    /// Bytes of a name with its folders.
    pub name_bytes: usize,
    /// Bytes unpacked from the whole source, archives inside archives included.
    pub total_bytes: u64,
    /// Bytes unpacked for one person.
    pub person_bytes: u64,
    /// Bytes of an archive inside a source, which is held in memory while it is read.
    pub nested_bytes: u64,
    /// Archives inside each other, below the source itself.
    pub nesting: u32,
}

impl Default for Limits {
    /// A class of thousands fits, each with a working folder of logs and reports; one person's bomb ends at that person's share.
    fn default() -> Self {
        Self {
            entries: 100_000,
            name_bytes: 1_000,
            total_bytes: 64 << 30,
            person_bytes: 256 << 20,
            nested_bytes: 128 << 20,
            nesting: 2,
        }
    }
}
