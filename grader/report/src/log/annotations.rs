//! Notes on a run: what the submission drew, what checks judged, and lines of events, prints and marks.

use std::borrow::Cow;

use foxglove::messages::Log;
use foxglove::messages::log::Level;
use kinemark_sim::watch::event::EventKind;

use super::mcap::LogError;
use super::message::time;
use super::messages::Messages;
use super::names::fields;
use crate::visible::visible;

/// A line of a log to be.
struct Line<'a> {
    ns: u64,
    level: Level,
    message: Cow<'a, str>,
    /// Who says it.
    name: &'a str,
    /// The line of the submission that printed it.
    source_line: Option<usize>,
}

impl Messages<'_> {
    /// What the submission drew, all values of a tick in one message.
    pub(super) fn plots(&mut self) -> Result<(), LogError> {
        let run = self.run;
        if run.trace.plots.is_empty() {
            return Ok(());
        }
        let names = fields(run.trace.plots.iter().map(|plot| plot.name.as_str()));
        let described: Vec<_> = names
            .iter()
            .zip(&run.trace.plots)
            .map(|(name, plot)| (name.clone(), visible(&plot.name).into_owned()))
            .collect();
        let topic = self.flat_topic("/plots", "kinemark.Plots", &described);
        let mut samples: Vec<(u64, usize, f64)> = Vec::new();
        for (i, plot) in run.trace.plots.iter().enumerate() {
            samples.extend(plot.samples.iter().map(|(tick, value)| (*tick, i, *value)));
        }
        samples.sort_by_key(|(tick, i, _)| (*tick, *i));
        for at_tick in samples.chunk_by(|a, b| a.0 == b.0) {
            let mut values: Vec<(&str, f64)> = Vec::new();
            for (_, i, value) in at_tick {
                let name = names[*i].as_str();
                // of two values of one tick the later stands
                match values.last_mut() {
                    Some(last) if last.0 == name => last.1 = *value,
                    _ => values.push((name, *value)),
                }
            }
            self.numbers(topic, self.ns(at_tick[0].0), values)?;
        }
        Ok(())
    }

    /// What checks judged, with their bands.
    pub(super) fn checks(&mut self) -> Result<(), LogError> {
        let run = self.run;
        let names = fields(run.curves.iter().map(|curve| curve.check.as_str()));
        for (curve, name) in run.curves.iter().zip(&names) {
            let what = visible(&format!("{} [{}]", curve.title, curve.unit)).into_owned();
            let described = [
                ("value", what.as_str()),
                ("full", "earns all points"),
                ("zero", "earns none"),
            ];
            let described = described.map(|(name, what)| (name.to_owned(), what.to_owned()));
            let topic = self.flat_topic(format!("/checks/{name}"), "kinemark.Judged", &described);
            let mut next_s = f64::NEG_INFINITY;
            let last = curve.t_s.len().saturating_sub(1);
            for (i, (t_s, value)) in curve.t_s.iter().zip(&curve.values).enumerate() {
                let is_due = *t_s >= next_s || i == last;
                if !t_s.is_finite() || *t_s < 0.0 || !is_due {
                    continue;
                }
                // a hair early, so that rounding does not skip every second one
                next_s = t_s + 0.999 / self.signal_rate_hz;
                let mut values = vec![("value", *value)];
                values.extend(curve.full.map(|full| ("full", full)));
                values.extend(curve.zero.map(|zero| ("zero", zero)));
                self.numbers(topic, (t_s * 1e9).round() as u64, values)?;
            }
        }
        Ok(())
    }

    /// Events, printed lines, and the moments checks marked.
    pub(super) fn lines(&mut self) -> Result<(), LogError> {
        let run = self.run;
        let topic = self.known_topic::<Log>("/log")?;
        let mut lines: Vec<Line<'_>> = Vec::new();
        let names = run.names();
        for event in &run.trace.events {
            let message = names.event(&event.kind);
            lines.push(Line {
                ns: self.ns(event.tick),
                level: level(&event.kind),
                message: message.into(),
                name: "run",
                source_line: None,
            });
        }
        for contact in &run.trace.contacts {
            let [first, second] = contact.parties.map(|party| names.party(party));
            let message = format!(
                "`{first}` and `{second}` touch until {:.3} s: at most {:.3} N, {:.4} N s in all",
                contact.last_tick as f64 * run.trace.step_s,
                contact.peak_force_n,
                contact.impulse_n_s
            );
            let ns = self.ns(contact.first_tick);
            lines.push(Line {
                ns,
                level: Level::Info,
                message: message.into(),
                name: "contact",
                source_line: None,
            });
        }
        for line in &run.trace.log {
            lines.push(Line {
                ns: self.ns(line.tick),
                level: Level::Info,
                message: line.text.as_str().into(),
                name: "submission",
                source_line: line.line,
            });
        }
        for curve in &run.curves {
            for (t_s, text) in curve
                .marks
                .iter()
                .filter(|(t_s, _)| t_s.is_finite() && *t_s >= 0.0)
            {
                lines.push(Line {
                    ns: (t_s * 1e9).round() as u64,
                    level: Level::Info,
                    message: text.as_str().into(),
                    name: &curve.check,
                    source_line: None,
                });
            }
        }
        for Line {
            ns,
            level,
            message,
            name,
            source_line,
        } in lines
        {
            let line = Log {
                timestamp: Some(time(ns)),
                level: level as i32,
                message: visible(&message).into_owned(),
                name: name.to_owned(),
                file: String::new(),
                line: source_line
                    .and_then(|line| u32::try_from(line).ok())
                    .unwrap_or(0),
            };
            self.message(topic, ns, &line)?;
        }
        Ok(())
    }
}

/// How much an event matters.
fn level(event: &EventKind) -> Level {
    match event {
        EventKind::Diverged | EventKind::Stopped => Level::Error,
        EventKind::Saturated { .. }
        | EventKind::LimitHit { .. }
        | EventKind::SpeedLimitHit { .. }
        | EventKind::UnderResolved { .. } => Level::Warning,
        _ => Level::Info,
    }
}
