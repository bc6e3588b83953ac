//! The checksums of a whole log, looked at when something in it cannot be read: is it what was written, or damaged since?

use ::mcap::MAGIC;
use ::mcap::records::op;

/// Opcode and length before every record.
const HEAD: usize = 9;
/// Starts of the summary and of its offsets, and the checksum.
const FOOTER: usize = 8 + 8 + 4;
/// A checksum.
const DATA_END: usize = 4;

/// Which checksum is not that of the bytes, in words; none where they all are, where a log has none, and where none can be found.
pub(super) fn mismatch(log: &[u8]) -> Option<&'static str> {
    let footer_at = log.len().checked_sub(HEAD + FOOTER + MAGIC.len())?;
    let (footer, magic) = log[footer_at..].split_at(HEAD + FOOTER);
    if magic != MAGIC || footer[0] != op::FOOTER || number(&footer[1..9])? != FOOTER as u64 {
        return None;
    }
    let summary_at = match usize::try_from(number(&footer[9..17])?).ok()? {
        0 => footer_at,
        at => at,
    };
    let (all, sum) = (&log[..footer_at + HEAD + 16], &footer[HEAD + 16..]);
    if summary_at <= footer_at && differs(all.get(summary_at..)?, sum) {
        return Some("the checksum of its summary does not match");
    }
    let data_end_at = summary_at.checked_sub(HEAD + DATA_END)?;
    let data_end = log.get(data_end_at..summary_at)?;
    if data_end[0] != op::DATA_END || number(&data_end[1..9])? != DATA_END as u64 {
        return Some("the end of its data is not where it was written");
    }
    differs(&log[..data_end_at], &data_end[HEAD..])
        .then_some("the checksum of its data does not match")
}

/// Whether a checksum that is there is not that of `bytes`.
fn differs(bytes: &[u8], sum: &[u8]) -> bool {
    sum != [0; 4] && crc32fast::hash(bytes).to_le_bytes() != sum
}

fn number(eight: &[u8]) -> Option<u64> {
    Some(u64::from_le_bytes(eight.try_into().ok()?))
}
