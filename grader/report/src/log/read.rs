//! The messages of any MCAP log, with every checksum looked at and every size bounded.

mod chunks;
mod sums;
mod texts;

use std::sync::Arc;

use ::mcap::records::{Record, op};
use ::mcap::sans_io::linear_reader::{LinearReadEvent, LinearReader, LinearReaderOptions};
use ::mcap::{Channel, McapError, parse_record};

/// One record, unpacked.
const MOST_RECORD_BYTES: usize = 64 << 20;
/// All records together, unpacked: a small file can unpack to any size.
const MOST_BYTES: u64 = 4 << 30;
/// What a log of any size may unpack to, and how many times its own size besides. Messages of an arm that stands still pack well.
const ANY_BYTES: u64 = 64 << 20;
const TIMES: u64 = 200;
/// Topics and schemas, which are held as long as the log is read.
const MOST_KNOWN_BYTES: usize = 32 << 20;

/// Bytes that may come of a log, unpacked or as tables.
pub(super) fn most_of(log: &[u8], most: u64) -> u64 {
    most.min(ANY_BYTES + TIMES * log.len() as u64)
}

/// A log that cannot be read, or not as a table.
#[derive(Debug, thiserror::Error)]
pub enum ReadError {
    /// It has no byte.
    #[error("it is empty")]
    Empty,
    /// It does not begin as an MCAP file.
    #[error("it is not an MCAP log: it does not begin as one")]
    Foreign,
    /// It ends too early.
    #[error("the file is incomplete (cut off after {messages} messages)")]
    CutOff {
        /// Messages before the end.
        messages: u64,
    },
    /// Its bytes contradict each other.
    #[error("it is damaged after {messages} messages: {why}")]
    Damaged {
        /// Messages before the damage.
        messages: u64,
        /// What is wrong.
        why: String,
    },
    /// Its chunks are packed in a way that is not read.
    #[error("its chunks are compressed with `{name}`; zstd and uncompressed ones are read")]
    Compression {
        /// The name of the compression.
        name: String,
    },
    /// It unpacks to more than makes sense.
    #[error("it is too large: {what}")]
    TooLarge {
        /// What is too large.
        what: String,
    },
    /// It holds no message.
    #[error("it holds no messages")]
    NoMessages,
    /// No topic of it is written as JSON or protobuf.
    #[error("none of its topics is JSON, or protobuf with its schema: {}", .topics.join(", "))]
    Unread {
        /// Its topics with their encodings.
        topics: Vec<String>,
    },
    /// A message is not what its channel says.
    #[error("message {number} of topic `{topic}` is no {form}: {why}")]
    Message {
        /// Its topic.
        topic: String,
        /// Which message of the topic, from one.
        number: u64,
        /// What it should be.
        form: String,
        /// What is wrong.
        why: String,
    },
    /// The schema of a topic does not describe its messages.
    #[error("the schema of topic `{topic}` cannot be read: {why}")]
    Schema {
        /// The topic.
        topic: String,
        /// What is wrong.
        why: String,
    },
    /// A table could not be written.
    #[error("a table cannot be written: {0}")]
    Write(std::io::Error),
}

impl ReadError {
    /// What to do about it.
    pub fn way_out(&self) -> &'static str {
        match self {
            Self::Empty | Self::Foreign => {
                "name a log such as out/TASK/run.mcap, which `kinemark grade` writes"
            }
            Self::CutOff { .. } | Self::Damaged { .. } => {
                "copy it again, or grade again; for a log of another program, `mcap recover FILE`"
            }
            Self::Compression { .. } => {
                "pack it anew: `mcap compress --compression zstd LOG -o NEW`"
            }
            Self::TooLarge { .. } => "cut out a part of it: `mcap filter LOG -o PART -s 0 -e 10`",
            Self::NoMessages => "name a log of a run; this one has nothing to export",
            Self::Unread { .. } => {
                "only JSON and protobuf messages become tables; convert others with the tools of their format"
            }
            Self::Message { .. } | Self::Schema { .. } => {
                "export another topic with --topic, or write the log anew"
            }
            Self::Write(_) => "free some space, or choose another place with --out",
        }
    }
}

/// One message of a log.
pub(super) struct LogMessage<'a> {
    pub(super) channel: &'a Arc<Channel<'static>>,
    /// \[ns\]
    pub(super) log_time_ns: u64,
    pub(super) data: &'a [u8],
}

/// Calls `each` with every message of a log, in the order in which they are written.
///
/// # Errors
/// What is wrong with the log, and what `each` finds. A log whose bytes are not those that were written is reported as damaged, whatever
/// the damage looks like.
pub(super) fn messages(
    log: &[u8],
    each: &mut dyn FnMut(LogMessage<'_>) -> Result<(), ReadError>,
) -> Result<(), ReadError> {
    let mut count = 0;
    let read = stream(log, &mut count, each);
    read.map_err(|error| match error {
        ReadError::Empty | ReadError::Foreign | ReadError::Damaged { .. } | ReadError::Write(_) => {
            error
        }
        other => match sums::mismatch(log) {
            Some(why) => ReadError::Damaged {
                messages: count,
                why: why.to_owned(),
            },
            None => other,
        },
    })
}

/// A reader that checks every sum there is.
fn checking_reader() -> LinearReader {
    let options = LinearReaderOptions::default()
        .with_record_length_limit(MOST_RECORD_BYTES)
        .with_validate_chunk_crcs(true)
        // before a message of theirs is looked at
        .with_prevalidate_chunk_crcs(true)
        .with_validate_data_section_crc(true)
        .with_validate_summary_section_crc(true)
        .with_check_finishes_after_end_magic(true);
    LinearReader::new_with_options(options)
}

/// What has come of a log so far, against what may.
struct Taken {
    /// Bytes that all its records may unpack to.
    most: u64,
    unpacked: u64,
    /// Bytes of topics and schemas.
    known_bytes: usize,
}

impl Taken {
    /// Counts a record, before anything is made of it.
    fn unpack(&mut self, size: usize) -> Result<(), ReadError> {
        self.unpacked += size as u64;
        if self.unpacked > self.most {
            return Err(ReadError::TooLarge {
                what: format!("it unpacks to more than {} MiB", self.most >> 20),
            });
        }
        Ok(())
    }

    /// Counts a topic or a schema, which stays in memory.
    fn keep(&mut self, size: usize) -> Result<(), ReadError> {
        self.known_bytes += size;
        if self.known_bytes > MOST_KNOWN_BYTES {
            return Err(ReadError::TooLarge {
                what: format!(
                    "its schemas and topics take more than {} MiB",
                    MOST_KNOWN_BYTES >> 20
                ),
            });
        }
        Ok(())
    }
}

fn stream(
    log: &[u8],
    count: &mut u64,
    each: &mut dyn FnMut(LogMessage<'_>) -> Result<(), ReadError>,
) -> Result<(), ReadError> {
    if log.is_empty() {
        return Err(ReadError::Empty);
    }
    let magic = ::mcap::MAGIC;
    if !log.starts_with(&magic[..magic.len().min(log.len())]) {
        return Err(ReadError::Foreign);
    }
    let mut reader = checking_reader();
    let mut channels = ::mcap::read::ChannelAccumulator::default();
    // the reader must not see a chunk that contradicts itself
    let torn = chunks::first_torn(log);
    let mut rest = &log[..torn.unwrap_or(log.len())];
    let mut taken = Taken {
        most: most_of(log, MOST_BYTES),
        unpacked: 0,
        known_bytes: 0,
    };
    while let Some(event) = reader.next_event() {
        let event = event.map_err(|error| match (error, torn) {
            (McapError::UnexpectedEof, Some(_)) => ReadError::Damaged {
                messages: *count,
                why: "the records of a chunk are longer than the chunk".to_owned(),
            },
            (error, _) => read_error(error, *count),
        })?;
        let (opcode, data) = match event {
            LinearReadEvent::ReadRequest(need) => {
                let (now, later) = rest.split_at(need.min(rest.len()));
                reader.insert(now.len()).copy_from_slice(now);
                reader.notify_read(now.len());
                rest = later;
                continue;
            }
            LinearReadEvent::Record { opcode, data } => (opcode, data),
        };
        let size = data.len();
        taken.unpack(size)?;
        let Some(record) = parsed(opcode, data, *count)? else {
            continue;
        };
        if matches!(record, Record::Schema { .. } | Record::Channel(_)) {
            taken.keep(size)?;
        }
        let known = match record {
            Record::Schema { header, data } => channels.add_schema_from_slice(header, &data),
            Record::Channel(channel) => channels.add_channel(channel),
            Record::Message { header, data } => {
                let Some(channel) = channels.get(header.channel_id) else {
                    return Err(ReadError::Damaged {
                        messages: *count,
                        why: format!(
                            "a message names channel {}, which it has not",
                            header.channel_id
                        ),
                    });
                };
                each(LogMessage {
                    channel: &channel,
                    log_time_ns: header.log_time,
                    data: &data,
                })?;
                *count += 1;
                Ok(())
            }
            _ => Ok(()),
        };
        known.map_err(|error| read_error(error, *count))?;
    }
    Ok(())
}

/// A record of a kind that tables need; of the others nothing is, not even a checksum.
fn parsed(opcode: u8, data: &[u8], messages: u64) -> Result<Option<Record<'_>>, ReadError> {
    if !matches!(
        opcode,
        op::SCHEMA | op::CHANNEL | op::MESSAGE | op::ATTACHMENT
    ) {
        return Ok(None);
    }
    if !texts::lie_in(opcode, data) {
        return Err(ReadError::Damaged {
            messages,
            why: "a text is longer than its record".to_owned(),
        });
    }
    let record = parse_record(opcode, data).map_err(|error| read_error(error, messages))?;
    Ok(Some(record))
}

/// The reader's errors, in words.
fn read_error(error: McapError, messages: u64) -> ReadError {
    match error {
        McapError::UnexpectedEof => ReadError::CutOff { messages },
        McapError::UnsupportedCompression(name) => ReadError::Compression { name },
        McapError::RecordTooLarge { len, .. } | McapError::ChunkTooLarge(len) => {
            ReadError::TooLarge {
                what: format!("a record of {len} bytes, at most {MOST_RECORD_BYTES} are read"),
            }
        }
        McapError::BadChunkCrc { .. }
        | McapError::BadDataCrc { .. }
        | McapError::BadSummaryCrc { .. }
        | McapError::BadAttachmentCrc { .. } => ReadError::Damaged {
            messages,
            why: "a checksum does not match".to_owned(),
        },
        other => ReadError::Damaged {
            messages,
            why: other.to_string(),
        },
    }
}
