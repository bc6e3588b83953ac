//! The messages of a log: gathered topic by topic, each with its time and the schema it keeps to.

use serde::Serialize;
use serde_json::Value;

use super::mcap::LogError;
use kinemark_grader::record::graded::TaskRun;

/// Flat signals a second; those of the submission and of checks at most so many.
pub(super) const SIGNAL_RATE_HZ: f64 = 100.0;

/// A channel to be: its topic and the schema of its messages.
pub(super) struct Topic {
    pub(super) topic: String,
    pub(super) schema_name: String,
    pub(super) schema: Value,
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
    pub(super) topics: Vec<Topic>,
    pub(super) messages: Vec<Message>,
    pub(super) bytes: Vec<u8>,
}

impl<'a> Messages<'a> {
    /// All messages of a run.
    pub(super) fn gather(run: &'a TaskRun) -> Result<Self, LogError> {
        let mut log = Self::new(run);
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

    fn new(run: &'a TaskRun) -> Self {
        Self {
            run,
            topics: Vec::new(),
            messages: Vec::new(),
            bytes: Vec::new(),
        }
    }

    pub(super) fn topic(
        &mut self,
        topic: impl Into<String>,
        schema_name: impl Into<String>,
        mut schema: Value,
    ) -> usize {
        // whether a JSON map is sorted depends on how its crate was built; the bytes must not
        schema.sort_all_objects();
        self.topics.push(Topic {
            topic: topic.into(),
            schema_name: schema_name.into(),
            schema,
        });
        self.topics.len() - 1
    }

    pub(super) fn message(
        &mut self,
        topic: usize,
        log_time_ns: u64,
        message: &impl Serialize,
    ) -> Result<(), LogError> {
        let start = self.bytes.len();
        serde_json::to_writer(&mut self.bytes, message)?;
        self.messages.push(Message {
            log_time_ns,
            topic,
            bytes: start..self.bytes.len(),
        });
        Ok(())
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
