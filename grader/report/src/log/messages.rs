//! The messages of a log: gathered topic by topic, each with its time and the schema it keeps to.

use foxglove::Encode;
use prost_reflect::MessageDescriptor;

use super::mcap::LogError;
use super::message::Flat;
use super::protobuf;
use super::schema::{self, Schema};
use crate::log_request::{Encoding, LogRequest};
use kinemark_grader::record::graded::TaskRun;

/// A channel to be: its topic and the schema of its messages.
pub(super) struct Topic {
    pub(super) topic: String,
    pub(super) schema: Schema,
    /// By which its messages become JSON, where they do.
    into_json: Option<MessageDescriptor>,
}

/// A message to be.
pub(super) struct Message {
    pub(super) log_time_ns: u64,
    pub(super) topic: usize,
    /// Where its bytes are.
    pub(super) bytes: std::ops::Range<usize>,
}

/// The messages of a run, gathered by topic and then written by time.
pub(super) struct Messages<'a> {
    pub(super) run: &'a TaskRun,
    /// How messages of Foxglove's are written.
    encoding: Encoding,
    /// Flat signals a second; those of the submission and of checks at most so many.
    pub(super) signal_rate_hz: f64,
    pub(super) topics: Vec<Topic>,
    pub(super) messages: Vec<Message>,
    pub(super) bytes: Vec<u8>,
}

impl<'a> Messages<'a> {
    /// All messages of a run.
    pub(super) fn gather(run: &'a TaskRun, request: LogRequest) -> Result<Self, LogError> {
        let mut log = Self::new(run, request);
        log.scenes()?;
        log.motion()?;
        log.ghost()?;
        log.signals()?;
        log.sensors()?;
        log.errors()?;
        log.plots()?;
        log.checks()?;
        log.lines()?;
        Ok(log)
    }

    fn new(run: &'a TaskRun, request: LogRequest) -> Self {
        Self {
            run,
            encoding: request.encoding,
            signal_rate_hz: request.signal_rate_hz(),
            topics: Vec::new(),
            messages: Vec::new(),
            bytes: Vec::new(),
        }
    }

    /// A topic of flat numbers, which are JSON always: they have the names that joints, sensors and students have.
    pub(super) fn flat_topic(
        &mut self,
        topic: impl Into<String>,
        title: &str,
        fields: &[(String, String)],
    ) -> usize {
        self.topic(topic.into(), schema::flat(title, fields), None)
    }

    /// A topic of messages of Foxglove's.
    pub(super) fn known_topic<M: Encode>(&mut self, topic: &str) -> Result<usize, LogError> {
        let binary = schema::protobuf::<M>();
        let topic = topic.to_owned();
        match self.encoding {
            Encoding::Protobuf => Ok(self.topic(topic, binary, None)),
            Encoding::Json => {
                let described = protobuf::described(&binary.name, &binary.data);
                let described = described.map_err(LogError::Message)?;
                Ok(self.topic(topic, schema::json_of::<M>(), Some(described)))
            }
        }
    }

    fn topic(
        &mut self,
        topic: String,
        schema: Schema,
        into_json: Option<MessageDescriptor>,
    ) -> usize {
        self.topics.push(Topic {
            topic,
            schema,
            into_json,
        });
        self.topics.len() - 1
    }

    /// Flat numbers.
    pub(super) fn numbers(
        &mut self,
        topic: usize,
        log_time_ns: u64,
        values: Vec<(&str, f64)>,
    ) -> Result<(), LogError> {
        let start = self.bytes.len();
        serde_json::to_writer(&mut self.bytes, &Flat { values })?;
        self.push(topic, log_time_ns, start);
        Ok(())
    }

    /// A message of Foxglove's.
    pub(super) fn message<M: Encode>(
        &mut self,
        topic: usize,
        log_time_ns: u64,
        message: &M,
    ) -> Result<(), LogError> {
        let start = self.bytes.len();
        let encoded = message.encode(&mut self.bytes);
        encoded.map_err(|error| LogError::Message(error.to_string()))?;
        if let Some(described) = &self.topics[topic].into_json {
            let json = protobuf::of_own(described, &self.bytes[start..]);
            let json = json.map_err(LogError::Message)?;
            self.bytes.truncate(start);
            serde_json::to_writer(&mut self.bytes, &json)?;
        }
        self.push(topic, log_time_ns, start);
        Ok(())
    }

    fn push(&mut self, topic: usize, log_time_ns: u64, start: usize) {
        self.messages.push(Message {
            log_time_ns,
            topic,
            bytes: start..self.bytes.len(),
        });
    }

    /// The time of a tick \[ns\].
    pub(super) fn ns(&self, tick: u64) -> u64 {
        (tick as f64 * self.run.trace.step_s * 1e9).round() as u64
    }

    /// Ticks nearest to a rate, the first and the last among them.
    pub(super) fn ticks(&self, rate_hz: f64) -> Vec<usize> {
        let last = match self.run.trace.len() {
            0 => return Vec::new(),
            len => len - 1,
        };
        let mut ticks: Vec<usize> = (0..)
            .map(|k| (f64::from(k) / (rate_hz * self.run.trace.step_s)).round() as usize)
            .take_while(|tick| *tick <= last)
            .collect();
        // a rate above the tick's own asks for the same tick twice
        ticks.dedup();
        if ticks.last() != Some(&last) {
            ticks.push(last);
        }
        ticks
    }
}
