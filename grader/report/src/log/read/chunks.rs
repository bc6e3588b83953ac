//! Uncompressed chunks whose records do not fill them: the reader of logs takes the lengths in them for granted.

use ::mcap::records::op;

/// Opcode and length before every record.
const HEAD: usize = 9;
/// Times, unpacked size and checksum before the name of a chunk's compression.
const BEFORE_NAME: usize = 8 + 8 + 8 + 4;

/// Where the first chunk starts whose records are longer or shorter than it says. What cannot be followed is left to the reader.
pub(super) fn first_torn(log: &[u8]) -> Option<usize> {
    let mut at = ::mcap::MAGIC.len();
    loop {
        let (opcode, record) = record(log.get(at..)?)?;
        if opcode == op::DATA_END || opcode == op::FOOTER {
            return None;
        }
        if opcode == op::CHUNK && uncompressed(record).is_some_and(|records| !fills(records)) {
            return Some(at);
        }
        at += HEAD + record.len();
    }
}

/// The record at the start of `bytes`, if all of it is there.
fn record(bytes: &[u8]) -> Option<(u8, &[u8])> {
    let length = usize::try_from(u64_at(bytes, 1)?).ok()?;
    let end = HEAD.checked_add(length)?;
    Some((bytes[0], bytes.get(HEAD..end)?))
}

/// The records in a chunk that is not compressed.
fn uncompressed(chunk: &[u8]) -> Option<&[u8]> {
    let name = chunk.get(BEFORE_NAME..BEFORE_NAME + 4)?;
    if name != [0; 4] {
        return None;
    }
    let size = usize::try_from(u64_at(chunk, BEFORE_NAME + 4)?).ok()?;
    chunk.get(BEFORE_NAME + 12..)?.get(..size)
}

/// Whether records lie end to end up to the last byte.
fn fills(mut records: &[u8]) -> bool {
    while !records.is_empty() {
        match record(records) {
            Some((_, record)) => records = &records[HEAD + record.len()..],
            None => return false,
        }
    }
    true
}

fn u64_at(bytes: &[u8], at: usize) -> Option<u64> {
    let eight = bytes.get(at..at.checked_add(8)?)?;
    Some(u64::from_le_bytes(eight.try_into().ok()?))
}
