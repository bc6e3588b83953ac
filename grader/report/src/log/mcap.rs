//! The log of a run as MCAP: what viewers such as Foxglove and Lichtblick replay. The clock is the simulation's.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::io::Cursor;

use mcap::records::{MessageHeader, Metadata};
use mcap::{Compression, WriteOptions};

use super::messages::Messages;
use crate::log_request::LogRequest;
use crate::visible::visible;
use kinemark_grader::record::grade::Grade;
use kinemark_grader::record::graded::TaskRun;

/// A file that travels inside the log.
#[derive(Debug, Clone, Copy)]
pub struct Attachment<'a> {
    /// Its name.
    pub name: &'a str,
    /// Its media type, such as `application/json`.
    pub media_type: &'a str,
    /// Its content.
    pub bytes: &'a [u8],
}

/// A log that could not be written.
#[derive(Debug, thiserror::Error)]
pub enum LogError {
    /// The writer refused.
    #[error("the log cannot be written: {0}")]
    Write(#[from] mcap::McapError),
    /// A message has no JSON form.
    #[error("a message cannot be written as JSON: {0}")]
    Json(#[from] serde_json::Error),
    /// A message has no binary form.
    #[error("a message cannot be written as protobuf: {0}")]
    Message(String),
}

/// Writes the log of `run`, with the digests of `grade` as metadata and `attachments` beside the messages.
///
/// Topics: `/tf`, `/tcp` and `/joint_states` at 60 Hz, first and last tick included; `/scene` and `/reference/scene` once; `/reference/tf`, where the run brings the
/// reference solution's motion, at 60 Hz;
/// `/signals`, `/sensors` and `/errors` at 100 Hz or the rate of `request`; `/plots` what the submission drew; `/checks/...` what checks
/// judged; `/log` events and printed lines. Messages with Foxglove's schemas are protobuf or JSON, flat numbers are JSON; poses are rounded
/// to nanometres, all else is as it was computed. The same run gives the same bytes.
///
/// # Errors
/// [`LogError`] if the writer refuses, which no run of a robot should make it do.
pub fn mcap(
    run: &TaskRun,
    grade: &Grade,
    attachments: &[Attachment<'_>],
    request: LogRequest,
) -> Result<Vec<u8>, LogError> {
    write(Messages::gather(run, request)?, grade, attachments)
}

fn write(
    mut log: Messages<'_>,
    grade: &Grade,
    attachments: &[Attachment<'_>],
) -> Result<Vec<u8>, LogError> {
    let options = WriteOptions::new()
        .profile("")
        .library("kinemark")
        .compression(Some(Compression::Zstd))
        .compression_threads(0);
    let mut writer = options.create(Cursor::new(Vec::new()))?;
    let mut channels = Vec::new();
    for topic in &log.topics {
        let schema = &topic.schema;
        let id = writer.add_schema(&schema.name, schema.encoding, &schema.data)?;
        channels.push(writer.add_channel(
            id,
            &topic.topic,
            schema.of_messages,
            &BTreeMap::new(),
        )?);
    }
    // stable, so that messages of one instant keep the order of their topics
    log.messages.sort_by_key(|message| message.log_time_ns);
    let mut sequence = vec![0u32; channels.len()];
    for message in &log.messages {
        let header = MessageHeader {
            channel_id: channels[message.topic],
            sequence: sequence[message.topic],
            log_time: message.log_time_ns,
            publish_time: message.log_time_ns,
        };
        sequence[message.topic] += 1;
        writer.write_to_known_channel(&header, &log.bytes[message.bytes.clone()])?;
    }
    writer.write_metadata(&Metadata {
        name: "kinemark".to_owned(),
        metadata: facts(log.run, grade),
    })?;
    for attachment in attachments {
        writer.attach(&mcap::Attachment {
            log_time: 0,
            create_time: 0,
            name: attachment.name.to_owned(),
            media_type: attachment.media_type.to_owned(),
            data: Cow::Borrowed(attachment.bytes),
        })?;
    }
    writer.finish()?;
    Ok(writer.into_inner().into_inner())
}

/// What the log rests on.
fn facts(run: &TaskRun, grade: &Grade) -> BTreeMap<String, String> {
    let mut facts = BTreeMap::from([
        ("engine".to_owned(), grade.engine.clone()),
        ("task".to_owned(), run.task.clone()),
        ("step_s".to_owned(), run.trace.step_s.to_string()),
        ("lab".to_owned(), grade.lab.name.clone()),
        ("lab_digest".to_owned(), grade.lab.digest.clone()),
        ("robot".to_owned(), grade.robot.name.clone()),
        ("robot_digest".to_owned(), grade.robot.digest.clone()),
        ("submission".to_owned(), grade.submission.name.clone()),
        (
            "submission_digest".to_owned(),
            grade.submission.digest.clone(),
        ),
    ]);
    facts.insert("seeds".to_owned(), seeds(run));
    if let Some(task) = grade.tasks.iter().find(|task| task.name == run.task) {
        facts.insert("trace_digest".to_owned(), task.digests.all.clone());
    }
    facts
}

/// The seeds of all that was drawn in the run: `sensor NAME 42, gust 7`, or `none`.
fn seeds(run: &TaskRun) -> String {
    let sensors = run.sensors.iter();
    let mut seeds: Vec<String> = sensors
        .map(|sensor| format!("sensor {} {}", visible(&sensor.name), sensor.seed))
        .collect();
    let wind = run
        .scene
        .as_ref()
        .and_then(|scene| scene.scene.environment.wind.as_ref());
    if let Some(gust) = wind.and_then(|wind| wind.gust.as_ref()) {
        seeds.push(format!("gust {}", gust.seed));
    }
    if seeds.is_empty() {
        return "none".to_owned();
    }
    seeds.join(", ")
}

#[cfg(test)]
mod tests {
    use serde_json::{Value, json};

    use super::super::json::Json;
    use super::super::protobuf;
    use super::*;
    use crate::log_request::Encoding;
    use kinemark_grader::record::sample;

    fn written(run: &TaskRun) -> Vec<u8> {
        let attachments = [Attachment {
            name: "rrbot.toml",
            media_type: "application/toml",
            bytes: b"format = 1",
        }];
        let graded = sample::graded();
        mcap(run, &graded.grade, &attachments, LogRequest::default()).unwrap()
    }

    fn written_as(run: &TaskRun, encoding: Encoding, rate_hz: Option<u32>) -> Vec<u8> {
        let request = LogRequest { encoding, rate_hz };
        mcap(run, &sample::graded().grade, &[], request).unwrap()
    }

    fn value(json: Json) -> Value {
        match json {
            Json::Null => Value::Null,
            Json::Bool(value) => value.into(),
            Json::Number(number) => Value::Number(number),
            Json::Text(text) => text.into(),
            Json::List(items) => items.into_iter().map(value).collect(),
            Json::Object(members) => members
                .into_iter()
                .map(|(name, member)| (name, value(member)))
                .collect(),
        }
    }

    /// Topic, schema, time and content of every message, as the reader gives them; it checks every CRC.
    fn read(bytes: &[u8]) -> Vec<(String, String, u64, Value)> {
        let messages = ::mcap::MessageStream::new(bytes).unwrap().map(|message| {
            let message = message.unwrap();
            let schema = message.channel.schema.as_ref().unwrap();
            let encodings = (
                schema.encoding.as_str(),
                message.channel.message_encoding.as_str(),
            );
            let content = match encodings {
                ("jsonschema", "json") => {
                    let described: Value = serde_json::from_slice(&schema.data).unwrap();
                    assert_eq!(described["title"], json!(schema.name));
                    serde_json::from_slice(&message.data).unwrap()
                }
                ("protobuf", "protobuf") => {
                    let described = protobuf::described(&schema.name, &schema.data).unwrap();
                    value(protobuf::parse(&described, &message.data).unwrap())
                }
                other => panic!("{other:?}"),
            };
            (
                message.channel.topic.clone(),
                schema.name.clone(),
                message.log_time,
                content,
            )
        });
        messages.collect()
    }

    #[test]
    fn the_log_reads_back() {
        let run = sample::task_run();
        let bytes = written(&run);
        let messages = read(&bytes);
        let count = |topic: &str| messages.iter().filter(|message| message.0 == topic).count();
        let topics = [
            "/tf",
            "/tcp",
            "/joint_states",
            "/scene",
            "/reference/scene",
            "/signals",
            "/errors",
        ];
        assert_eq!(topics.map(count), [481, 481, 481, 1, 1, 801, 801]);
        assert!(messages.is_sorted_by_key(|message| message.2));
        assert_eq!(
            messages.last().map(|message| message.2),
            Some(8_000_000_000)
        );

        let summary = ::mcap::Summary::read(&bytes).unwrap().unwrap();
        let statistics = summary.stats.unwrap();
        assert_eq!(statistics.message_count, messages.len() as u64);
        assert_eq!(
            (statistics.attachment_count, statistics.metadata_count),
            (1, 1)
        );
        assert!(!summary.chunk_indexes.is_empty());
    }

    #[test]
    fn the_reference_is_a_ghost_with_frames_of_its_own() {
        let topics = |run: &TaskRun| {
            let mut topics: Vec<String> = read(&written(run))
                .into_iter()
                .map(|message| message.0)
                .collect();
            topics.sort();
            topics.dedup();
            topics
        };
        let mut run = sample::task_run();
        assert!(!topics(&run).contains(&"/reference/tf".to_owned()));
        run.reference_overlay = Some(sample::stopped_after(700).trace);
        let messages = read(&written(&run));
        let of = |topic: &str| {
            messages
                .iter()
                .filter(|message| message.0 == topic)
                .map(|message| &message.3)
                .collect::<Vec<_>>()
        };
        let poses = of("/reference/tf");
        assert_eq!(poses.len(), 481);
        let children: Vec<&str> = poses[480]["transforms"]
            .as_array()
            .unwrap()
            .iter()
            .map(|t| t["child_frame_id"].as_str().unwrap())
            .collect();
        assert_eq!(
            children,
            [
                "reference/base",
                "reference/upper",
                "reference/forearm",
                "reference/tcp",
                "reference/lab"
            ]
        );
        // its root hangs on the world, and it stands still once it ended
        assert_eq!(poses[480]["transforms"][0]["parent_frame_id"], "world");
        assert_eq!(
            poses[480]["transforms"][2]["rotation"],
            poses[50]["transforms"][2]["rotation"]
        );
        let scene = &of("/reference/scene")[0]["entities"];
        let frames: Vec<&str> = scene
            .as_array()
            .unwrap()
            .iter()
            .map(|e| e["frame_id"].as_str().unwrap())
            .collect();
        assert_eq!(
            frames,
            [
                "lab",
                "reference/base",
                "reference/upper",
                "reference/forearm"
            ]
        );
        let alpha = scene[1]["cubes"][0]["color"]["a"].as_f64().unwrap();
        assert!(alpha < 0.5, "{alpha}");
    }

    #[test]
    fn frames_form_one_tree_under_the_world_and_carry_the_motion() {
        let run = sample::task_run();
        let last = read(&written(&run))
            .into_iter()
            .rfind(|message| message.0 == "/tf")
            .unwrap();
        let transforms = last.3["transforms"].as_array().unwrap().clone();
        let branches: Vec<(&str, &str)> = transforms
            .iter()
            .map(|t| {
                (
                    t["parent_frame_id"].as_str().unwrap(),
                    t["child_frame_id"].as_str().unwrap(),
                )
            })
            .collect();
        let expected = [
            ("world", "base"),
            ("base", "upper"),
            ("upper", "forearm"),
            ("forearm", "tcp"),
            ("base", "lab"),
        ];
        assert_eq!(branches, expected);
        // the elbow's angle is the turn of the forearm on the upper arm
        let q = run.trace.q.at(8000)[1];
        let (y, w) = (
            &transforms[2]["rotation"]["y"],
            &transforms[2]["rotation"]["w"],
        );
        let angle = 2.0 * libm::atan2(y.as_f64().unwrap(), w.as_f64().unwrap());
        // elements are rounded to a billionth
        assert!((angle - q).abs() < 1e-8, "{angle} {q}");
    }

    #[test]
    fn schemas_of_a_viewer_bear_its_names() {
        for (topic, name, _, _) in read(&written(&sample::task_run())) {
            let expected = match topic.as_str() {
                "/tf" => "foxglove.FrameTransforms",
                "/scene" | "/reference/scene" => "foxglove.SceneUpdate",
                "/joint_states" => "foxglove.JointStates",
                "/tcp" => "foxglove.PoseInFrame",
                "/log" => "foxglove.Log",
                _ => continue,
            };
            assert_eq!(name, expected);
        }
    }

    #[test]
    fn both_encodings_say_the_same() {
        let mut run = sample::task_run();
        run.reference_overlay = Some(sample::stopped_after(700).trace);
        let [binary, text] = [Encoding::Protobuf, Encoding::Json]
            .map(|encoding| read(&written_as(&run, encoding, None)));
        assert_eq!(binary.len(), text.len());
        for (binary, text) in binary.iter().zip(&text) {
            assert_eq!(binary, text);
        }
    }

    #[test]
    fn signals_have_the_rate_that_is_asked_for() {
        let run = sample::task_run();
        let count = |rate_hz| {
            let messages = read(&written_as(&run, Encoding::Protobuf, rate_hz));
            messages
                .iter()
                .filter(|message| message.0 == "/signals")
                .count()
        };
        // eight seconds, and the first tick
        assert_eq!([None, Some(10), Some(1000)].map(count), [801, 81, 8001]);
        // no more than there are ticks
        assert_eq!(count(Some(10_000)), 8001);
    }

    #[test]
    fn the_same_run_gives_the_same_bytes() {
        assert_eq!(written(&sample::task_run()), written(&sample::task_run()));
    }

    #[test]
    fn events_and_printed_lines_are_in_the_log() {
        let messages = read(&written(&sample::stopped_after(700)));
        let lines: Vec<&Value> = messages
            .iter()
            .filter(|message| message.0 == "/log")
            .map(|message| &message.3)
            .collect();
        assert!(lines.iter().any(|line| line["level"] == json!(4)
            && line["message"] == json!("the submission was stopped")));
        let messages = read(&written(&sample::task_run()));
        let printed = messages.iter().map(|message| &message.3);
        let printed = printed.filter(|line| line["name"] == json!("submission"));
        let lines: Vec<&Value> = printed.map(|line| &line["line"]).collect();
        assert_eq!(lines, [&json!(2); 3]);
        let saturated = "effort of `shoulder` reached its limit";
        assert!(
            messages
                .iter()
                .any(|message| message.3["message"] == json!(saturated))
        );
        assert!(
            messages.iter().any(
                |message| message.3["message"] == json!("going to goal 2 ⟨U+001B⟩[31m⟨U+202E⟩")
            )
        );
    }

    #[test]
    fn numbers_that_are_not_finite_are_left_out() {
        let run = sample::chain(2, 20, |tick, joint| {
            if tick == 10 && joint == 0 {
                f64::NAN
            } else {
                0.5
            }
        });
        let messages = read(&written(&run));
        let at = |topic: &str| {
            messages
                .iter()
                .find(|message| message.0 == topic && message.2 == 10_000_000)
                .map(|message| &message.3)
        };
        assert_eq!(
            at("/signals").map(|signals| signals.get("q_joint_1").is_some()),
            Some(false)
        );
        assert_eq!(
            at("/signals").map(|signals| signals.get("q_joint_2").is_some()),
            Some(true)
        );
    }

    #[test]
    fn a_run_without_a_row_is_a_log_of_its_scene() {
        let messages = read(&written(&sample::chain(2, 0, |_, _| 0.0)));
        assert_eq!(messages.len(), 1);
        assert_eq!(messages[0].0, "/scene");
    }
}
