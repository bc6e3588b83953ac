//! Logs of our own and of others, as tables.

use std::collections::BTreeMap;
use std::io::Cursor;

use ::mcap::records::MessageHeader;
use ::mcap::{Compression, WriteOptions};

use super::*;
use crate::log::mcap;
use crate::log_request::LogRequest;
use kinemark_grader::record::sample;

/// A log with messages `(topic, encoding, time, data)`.
fn log_of(messages: &[(&str, &str, u64, &[u8])]) -> Vec<u8> {
    let options = WriteOptions::new().compression(Some(Compression::Zstd));
    let mut writer = options.create(Cursor::new(Vec::new())).unwrap();
    for (topic, encoding, log_time, data) in messages {
        let channel = writer
            .add_channel(0, topic, encoding, &BTreeMap::new())
            .unwrap();
        let header = MessageHeader {
            channel_id: channel,
            sequence: 0,
            log_time: *log_time,
            publish_time: *log_time,
        };
        writer.write_to_known_channel(&header, data).unwrap();
    }
    writer.finish().unwrap();
    writer.into_inner().into_inner()
}

fn csv_of(log: &[u8], topic: &str) -> String {
    let found = tables(log).unwrap();
    let mut bytes = Vec::new();
    let mut at = Some(&mut bytes);
    let out = found
        .tables
        .iter()
        .map(|table| (table.topic == topic).then(|| at.take()).flatten());
    let out = out.collect();
    write_csv(log, &found.tables, out).unwrap();
    String::from_utf8(bytes).unwrap()
}

#[test]
fn the_values_of_a_run_are_those_of_its_trace_to_the_last_bit() {
    let run = sample::task_run();
    let log = mcap(&run, &sample::graded().grade, &[], LogRequest::default()).unwrap();
    let text = csv_of(&log, "/signals");
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    let head = reader.headers().unwrap().clone();
    let at = |name: &str| head.iter().position(|column| column == name).unwrap();
    assert_eq!(head.get(0), Some("time_s"));
    // as the log has them: by signal, base to tip
    assert!(at("q_shoulder") < at("q_elbow") && at("q_elbow") < at("qd_shoulder"));
    let mut rows = 0;
    for row in reader.records() {
        let row = row.unwrap();
        let number = |i: usize| row[i].parse::<f64>().unwrap();
        let tick = (number(0) / run.trace.step_s).round() as usize;
        assert_eq!(number(0), tick as f64 / 1000.0);
        for (signal, name) in [
            (&run.trace.q, "q"),
            (&run.trace.qd, "qd"),
            (&run.trace.effort, "effort"),
        ] {
            for (i, joint) in ["shoulder", "elbow"].into_iter().enumerate() {
                let value = number(at(&format!("{name}_{joint}")));
                assert_eq!(
                    value.to_bits(),
                    signal.at(tick)[i].to_bits(),
                    "{name} {tick}"
                );
            }
        }
        rows += 1;
    }
    assert_eq!(rows, 801);
    let joints = csv_of(&log, "/joint_states");
    assert!(
        joints.starts_with(
            "\"time_s\",\"timestamp.sec\",\"timestamp.nsec\",\"joints.shoulder.position\",\"joints.shoulder.velocity\""
        ),
        "{}",
        &joints[..200]
    );
    assert!(csv_of(&log, "/tf").contains("\"transforms.forearm.translation.x\""));
}

#[test]
fn texts_are_quoted_and_no_formulas() {
    let message = br#"{"=key": "=1+1", "b": "a;b,\"c\"\nd", "c": -1.5, "d": "-1.5", "e": true, "f": null, "g": 1e-7, "h": "\t@x"}"#;
    let text = csv_of(&log_of(&[("/t", "json", 1_500_000_000, message)]), "/t");
    assert_eq!(
        text,
        "\"time_s\",\"'=key\",\"b\",\"c\",\"d\",\"e\",\"f\",\"g\",\"h\"\n\
         1.5,\"'=1+1\",\"a;b,\"\"c\"\"\nd\",-1.5,\"'-1.5\",\"true\",\"\",1e-7,\"'\t@x\"\n"
    );
}

#[test]
fn what_a_message_lacks_is_an_empty_field() {
    let log = log_of(&[
        ("/t", "json", 0, br#"{"a": 1, "c": 2}"#),
        ("/other", "json", 0, b"1"),
        ("/t", "json", 1, br#"{"b": 3, "a": 18446744073709551615}"#),
    ]);
    assert_eq!(
        csv_of(&log, "/t"),
        "\"time_s\",\"b\",\"a\",\"c\"\n0,\"\",1,2\n0.000000001,3,18446744073709551615,\"\"\n"
    );
}

#[test]
fn other_encodings_are_named_and_passed_over() {
    let log = log_of(&[("/p", "protobuf", 0, b"\x08"), ("/j", "json", 0, b"{}")]);
    let found = tables(&log).unwrap();
    assert_eq!(found.foreign, [("/p".to_owned(), "protobuf".to_owned())]);
    assert_eq!(found.tables.len(), 1);
    let error = tables(&log_of(&[("/p", "protobuf", 0, b"\x08")])).unwrap_err();
    assert_eq!(
        error.to_string(),
        "none of its topics is JSON, or protobuf with its schema: `/p` is `protobuf`"
    );
}

/// A system that lets a file grow no further says the same of it as a log whose tables are too large, and means another thing.
#[test]
fn a_file_that_may_not_grow_is_no_fault_of_the_log() {
    struct Full;
    impl Write for Full {
        fn write(&mut self, _: &[u8]) -> std::io::Result<usize> {
            Err(std::io::ErrorKind::FileTooLarge.into())
        }
        fn flush(&mut self) -> std::io::Result<()> {
            Ok(())
        }
    }
    let log = log_of(&[("/t", "json", 0, br#"{"a": 1}"#)]);
    let found = tables(&log).unwrap();
    let error = write_csv(&log, &found.tables, vec![Some(Full)]).unwrap_err();
    assert!(matches!(error, ReadError::Write(_)), "{error}");
    assert!(matches!(
        unfit(std::io::Error::other(Spent)),
        ReadError::TooLarge { .. }
    ));
}

#[test]
fn every_file_that_is_no_log_is_refused() {
    let whole = log_of(&[("/t", "json", 0, br#"{"a": 1}"#)]);
    let refusal = |bytes: &[u8]| tables(bytes).unwrap_err().to_string();
    assert_eq!(refusal(b""), "it is empty");
    assert_eq!(
        refusal(b"%PDF-1.7"),
        "it is not an MCAP log: it does not begin as one"
    );
    assert_eq!(refusal(&log_of(&[])), "it holds no messages");
    assert_eq!(
        refusal(&log_of(&[("/t", "json", 0, b"{1}")])),
        "message 1 of topic `/t` is no JSON: key must be a string at line 1 column 2"
    );
    // wherever it is cut off, and whichever byte is turned over: an error or the same rows, never a panic
    for length in 1..whole.len() {
        let _ = tables(&whole[..length]).unwrap_err();
    }
    let rows = csv_of(&whole, "/t");
    for at in 0..whole.len() {
        let mut bytes = whole.clone();
        bytes[at] ^= 0x41;
        if let Ok(found) = tables(&bytes) {
            let mut out = Vec::new();
            write_csv(&bytes, &found.tables, vec![Some(&mut out)]).unwrap();
            let text = String::from_utf8(out).unwrap();
            assert_eq!(text.lines().count(), rows.lines().count(), "byte {at}");
        }
    }
}

/// Takes the checksums of data and summary out of a log, as writers leave them out.
fn without_sums(log: &mut [u8]) {
    let footer = log.len() - 8 - 29;
    let summary = u64::from_le_bytes(log[footer + 9..footer + 17].try_into().unwrap());
    log[footer + 25..footer + 29].fill(0);
    let summary = usize::try_from(summary).unwrap();
    let end = if summary == 0 { footer } else { summary };
    log[end - 4..end].fill(0);
}

/// Each bit of a log, flipped alone: damage, or no difference.
#[test]
fn a_bit_that_turned_over_is_damage() {
    let whole = log_of(&[
        ("/t", "json", 0, br#"{"a": 1, "b": [2, 3]}"#),
        ("/other", "json", 1, br#"{"name": "x"}"#),
        ("/t", "json", 2, br#"{"a": 4, "b": [5, 6]}"#),
    ]);
    let expected = tables(&whole).unwrap();
    let footer = whole.len() - 8 - 29;
    let summary = u64::from_le_bytes(whole[footer + 9..footer + 17].try_into().unwrap());
    // the end of the data has a checksum for all before it, and none of its own
    let end = usize::try_from(summary).unwrap() - 13..usize::try_from(summary).unwrap();
    for at in ::mcap::MAGIC.len()..whole.len() {
        for bit in 0..8 {
            let mut bytes = whole.clone();
            bytes[at] ^= 1 << bit;
            match tables(&bytes) {
                Err(ReadError::Damaged { .. }) => {}
                Ok(found) if end.contains(&at) || at >= footer => assert_eq!(found, expected),
                Err(_) if end.contains(&at) || at >= footer => {}
                other => panic!("byte {at}, bit {bit}: {other:?}"),
            }
        }
    }
}

/// The reader of logs subtracts the lengths of records from that of their chunk.
#[test]
fn a_chunk_that_is_shorter_than_its_records_is_damage() {
    let options = WriteOptions::new().compression(None);
    let mut writer = options.create(Cursor::new(Vec::new())).unwrap();
    let channel = writer
        .add_channel(0, "/t", "json", &BTreeMap::new())
        .unwrap();
    let header = MessageHeader {
        channel_id: channel,
        sequence: 0,
        log_time: 0,
        publish_time: 0,
    };
    writer.write_to_known_channel(&header, b"1").unwrap();
    writer.finish().unwrap();
    let mut bytes = writer.into_inner().into_inner();
    without_sums(&mut bytes);
    assert_eq!(tables(&bytes).unwrap().tables[0].rows, 1);
    let chunk = bytes[8..].windows(9).position(|nine| nine[0] == 0x06);
    // past magic, opcode, length, times, unpacked size; the checksum and the packed size
    let at = 8 + chunk.unwrap() + 9 + 24;
    bytes[at..at + 4].fill(0);
    for less in [1_u64, 9, 20] {
        let mut torn = bytes.clone();
        let size = u64::from_le_bytes(torn[at + 8..at + 16].try_into().unwrap());
        torn[at + 8..at + 16].copy_from_slice(&(size - less).to_le_bytes());
        let error = tables(&torn).unwrap_err();
        assert!(
            matches!(&error, ReadError::Damaged { why, .. } if why.contains("longer than the chunk")),
            "{error}"
        );
    }
}

/// A chunk whose only record is longer than its packed size, of this many bytes.
fn torn_chunk(bytes: usize) -> Vec<u8> {
    let record = [
        &[0x05][..],
        &[bytes as u8, 0, 0, 0, 0, 0, 0, 0],
        &vec![0; bytes],
    ]
    .concat();
    let packed = (record.len() as u64 - 1).to_le_bytes();
    [&[0; 32][..], &packed, &record].concat()
}

/// The reader looks at what there is of a chunk, and for chunks behind the end of the data.
#[test]
fn a_torn_chunk_is_damage_where_it_is_cut_off_and_behind_the_data() {
    let whole = log_of_records(&[(0x06, torn_chunk(30))]);
    let content = ::mcap::MAGIC.len() + 9;
    for end in content..=whole.len() {
        let error = tables(&whole[..end]).unwrap_err();
        let seen = end >= content + 40 + 9;
        assert_eq!(
            matches!(error, ReadError::Damaged { .. }),
            seen,
            "{end}: {error}"
        );
    }
    let behind = log_of_records(&[(0x0f, vec![0; 4]), (0x06, torn_chunk(30))]);
    let error = tables(&behind).unwrap_err();
    assert!(matches!(error, ReadError::Damaged { .. }), "{error}");
    // all that is missing is the end
    let mut sound = torn_chunk(30);
    sound[32] += 1;
    let sound = log_of_records(&[(0x06, sound)]);
    for end in content..content + 40 + 9 + 30 {
        let error = tables(&sound[..end]).unwrap_err();
        assert!(matches!(error, ReadError::CutOff { .. }), "{end}: {error}");
    }
}

/// A log of these records, without a checksum.
fn log_of_records(records: &[(u8, Vec<u8>)]) -> Vec<u8> {
    let mut log = ::mcap::MAGIC.to_vec();
    let end = [(0x0f, vec![0; 4]), (0x02, vec![0; 20])];
    for (opcode, record) in records.iter().chain(&end) {
        log.push(*opcode);
        log.extend((record.len() as u64).to_le_bytes());
        log.extend(record);
    }
    log.extend(::mcap::MAGIC);
    log
}

/// The parser of records makes room for a text as long as it says, and takes an attachment to be as long as its head.
#[test]
fn a_text_that_is_longer_than_its_record_is_damage() {
    let lying = u32::MAX.to_le_bytes();
    let schema = [&[1, 0][..], &lying, &lying].concat();
    let channel = [&[1, 0, 0, 0][..], &lying, &lying].concat();
    let map = [&[1, 0, 0, 0][..], &[0; 8], &[8, 0, 0, 0], &lying, &lying].concat();
    let attachment = [&[0; 16][..], &lying, &lying].concat();
    let mut records = vec![(3, schema), (4, channel), (4, map), (9, attachment)];
    for opcode in [3, 4, 9] {
        records.extend((0..40).map(|length| (opcode, vec![0; length])));
    }
    for (opcode, record) in records {
        let length = record.len();
        match tables(&log_of_records(&[(opcode, record)])).unwrap_err() {
            // all of its texts are empty
            ReadError::NoMessages => assert!(length >= 2 + 8, "{opcode} {length}"),
            ReadError::Damaged { .. } => {}
            other => panic!("{opcode} {length}: {other}"),
        }
    }
    // of other records nothing is needed
    let header = [&lying[..], &lying].concat();
    let error = tables(&log_of_records(&[(1, header)])).unwrap_err();
    assert!(matches!(error, ReadError::NoMessages), "{error}");
}

/// A few kilobytes that would unpack to much, or become much.
#[test]
fn small_logs_cost_little() {
    // many topics of many columns with long names
    let wide: Vec<String> = (0..300)
        .map(|i| format!("\"{}{i}\": 0", "n".repeat(900)))
        .collect();
    let wide = format!("{{{}}}", wide.join(","));
    let topics: Vec<String> = (0..200).map(|i| format!("/{i}")).collect();
    let many: Vec<_> = topics
        .iter()
        .map(|topic| (topic.as_str(), "json", 0, wide.as_bytes()))
        .collect();
    let log = log_of(&many);
    assert!(log.len() < 100_000, "{}", log.len());
    let error = tables(&log).unwrap_err().to_string();
    assert!(error.contains("too large"), "{error}");
    // one row that is wide, and a great many that are empty
    let row = format!("[{}0]", "0,".repeat(9_999));
    let mut rows: Vec<(&str, &str, u64, &[u8])> = vec![("/t", "json", 0, row.as_bytes())];
    rows.extend((0..10_000).map(|i| ("/t", "json", i, &b"0"[..])));
    let log = log_of(&rows);
    let found = tables(&log).unwrap();
    let mut written = 0_u64;
    struct Count<'a>(&'a mut u64);
    impl std::io::Write for Count<'_> {
        fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
            *self.0 += bytes.len() as u64;
            Ok(bytes.len())
        }
        fn flush(&mut self) -> std::io::Result<()> {
            Ok(())
        }
    }
    let error = write_csv(&log, &found.tables, vec![Some(Count(&mut written))]).unwrap_err();
    assert!(error.to_string().contains("too large"), "{error}");
    let most = most_of(&log, MOST_TABLES_BYTES);
    assert!(written <= most && most < 128 << 20, "{written} of {most}");
}

#[test]
fn a_member_called_as_the_first_column_has_another_name() {
    let log = log_of(&[("/t", "json", 1_000_000_000, br#"{"time_s": 7}"#)]);
    assert_eq!(csv_of(&log, "/t"), "\"time_s\",\"\\time_s\"\n1,7\n");
}

#[test]
fn columns_are_described_as_the_schema_has_them() {
    let run = sample::task_run();
    let log = mcap(&run, &sample::graded().grade, &[], LogRequest::default()).unwrap();
    let found = tables(&log).unwrap();
    let of = |topic: &str| found.tables.iter().find(|table| table.topic == topic);
    let signals = &of("/signals").unwrap().described;
    assert_eq!(signals["q_shoulder"], "rad");
    assert_eq!(signals["effort_elbow"], "N m");
    let joints = &of("/joint_states").unwrap().described;
    assert_eq!(
        joints["joints.elbow.velocity"],
        "Joint velocity. Rad/s for revolute joints, m/s for prismatic joints."
    );
}

#[test]
fn a_compression_that_is_not_read_is_named() {
    let mut bytes = log_of(&[("/t", "json", 0, br#"{"a": 1}"#)]);
    let at = bytes.windows(4).position(|four| four == b"zstd").unwrap();
    bytes[at..at + 4].copy_from_slice(b"zlib");
    // with its checksums it is damaged: nobody wrote that
    assert!(matches!(tables(&bytes), Err(ReadError::Damaged { .. })));
    without_sums(&mut bytes);
    assert_eq!(
        tables(&bytes).unwrap_err().to_string(),
        "its chunks are compressed with `zlib`; zstd and uncompressed ones are read"
    );
}
