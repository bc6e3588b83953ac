//! Uncompressed chunks whose records do not fill them: the reader of logs takes the lengths in them for granted.

use ::mcap::records::op;

/// Opcode and length before every record.
const HEAD: usize = 9;
/// Times, unpacked size and checksum before the name of a chunk's compression.
const BEFORE_NAME: usize = 8 + 8 + 8 + 4;

/// Where the first chunk starts whose records are longer or shorter than it says, cut off at the end of the log or not. The reader looks
/// for chunks up to the footer. What cannot be followed is left to it.
pub(super) fn first_torn(log: &[u8]) -> Option<usize> {
    let mut at = ::mcap::MAGIC.len();
    loop {
        let length = usize::try_from(u64_at(log.get(at..)?, 1)?).ok()?;
        let content = &log[at + HEAD..];
        match log[at] {
            op::FOOTER => return None,
            op::CHUNK if is_torn(&content[..length.min(content.len())]) => return Some(at),
            _ => at = at.checked_add(HEAD)?.checked_add(length)?,
        }
    }
}

/// Whether the records in a chunk that is not compressed miss its end. What is not there is taken to be right.
fn is_torn(chunk: &[u8]) -> bool {
    if chunk.get(BEFORE_NAME..BEFORE_NAME + 4) != Some(&[0; 4]) {
        return false;
    }
    match u64_at(chunk, BEFORE_NAME + 4).map(usize::try_from) {
        Some(Ok(size)) => !fill(&chunk[BEFORE_NAME + 12..], size),
        _ => false,
    }
}

/// Whether records lie end to end up to byte `size`, as far as they are there.
fn fill(records: &[u8], size: usize) -> bool {
    let mut at = 0;
    while at < size {
        let Some(length) = u64_at(records, at + 1) else {
            return size - at >= HEAD;
        };
        match usize::try_from(length).map(|length| length.checked_add(at + HEAD)) {
            Ok(Some(end)) if end <= size => at = end,
            _ => return false,
        }
    }
    true
}

fn u64_at(bytes: &[u8], at: usize) -> Option<u64> {
    let eight = bytes.get(at..at.checked_add(8)?)?;
    Some(u64::from_le_bytes(eight.try_into().ok()?))
}
