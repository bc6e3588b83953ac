//! Texts in a record that are longer than the record: the parser makes room for so many bytes before it looks whether they are there.

use ::mcap::records::op;

/// Whether the texts of a record lie in it, where it is of a kind that is parsed.
pub(super) fn lie_in(opcode: u8, record: &[u8]) -> bool {
    match opcode {
        // its number
        op::SCHEMA => after_texts(record, 2).is_some(),
        // its number and its schema's
        op::CHANNEL => after_texts(record, 4).is_some_and(is_map),
        // two times; behind the texts a size and a checksum
        op::ATTACHMENT => after_texts(record, 16).is_some_and(|rest| rest.len() >= 8 + 4),
        _ => true,
    }
}

/// What follows the two texts that begin after so many bytes.
fn after_texts(record: &[u8], begin: usize) -> Option<&[u8]> {
    after_text(after_text(record.get(begin..)?)?)
}

/// What follows a text, which its length is written before.
fn after_text(bytes: &[u8]) -> Option<&[u8]> {
    let (length, rest) = bytes.split_first_chunk::<4>()?;
    rest.get(usize::try_from(u32::from_le_bytes(*length)).ok()?..)
}

/// Whether pairs of texts lie in `bytes`, up to the size that is written before all of them.
fn is_map(bytes: &[u8]) -> bool {
    let Some((size, mut rest)) = bytes.split_first_chunk::<4>() else {
        return false;
    };
    let whole = rest.len();
    while whole - rest.len() < u32::from_le_bytes(*size) as usize {
        match after_texts(rest, 0) {
            Some(after) => rest = after,
            None => return false,
        }
    }
    true
}
