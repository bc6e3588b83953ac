//! Numbers over time, each under a name of its own: of joints, of sensors, and how far the TCP is from its goal.

use kinemark_sim::model::sensor::Measured;

use super::mcap::LogError;
use super::messages::Messages;
use super::names::fields;
use crate::goal::current_goal;

impl Messages<'_> {
    /// Every number of every joint under a name of its own.
    pub(super) fn signals(&mut self) -> Result<(), LogError> {
        let run = self.run;
        let joints = fields(run.robot.moving_joints().map(|joint| joint.name.as_str()));
        let turns: Vec<bool> = run
            .robot
            .moving_joints()
            .map(|joint| joint.kind.turns())
            .collect();
        let trace = &run.trace;
        let sources = [&trace.q, &trace.qd, &trace.command, &trace.effort];
        let mut names = Vec::new();
        for signal in sources {
            for (i, joint) in joints.iter().enumerate() {
                let unit = match (signal.name(), turns[i]) {
                    ("q", true) => "rad",
                    ("q", false) => "m",
                    ("qd", true) => "rad/s",
                    ("qd", false) => "m/s",
                    ("effort", true) => "N m",
                    ("effort", false) => "N",
                    _ => "the unit of the servo's mode",
                };
                names.push((format!("{}_{joint}", signal.name()), unit.to_owned()));
            }
        }
        let topic = self.flat_topic("/signals", "kinemark.Signals", &names);
        for tick in self.ticks(self.signal_rate_hz) {
            let values = sources.iter().flat_map(|signal| signal.at(tick));
            let values = names
                .iter()
                .map(|(name, _)| name.as_str())
                .zip(values.copied());
            let values = values.collect();
            self.numbers(topic, self.ns(tick as u64), values)?;
        }
        Ok(())
    }

    /// Every number of every sensor under a name of its own.
    pub(super) fn sensors(&mut self) -> Result<(), LogError> {
        let run = self.run;
        if run.sensors.is_empty() {
            return Ok(());
        }
        let channels = run.sensors.iter().flat_map(|sensor| {
            let parts = match sensor.kind.measured() {
                Measured::Switch | Measured::Number => vec![sensor.name.clone()],
                Measured::Parts(names) => {
                    let names = names.iter();
                    names
                        .map(|part| format!("{} {part}", sensor.name))
                        .collect()
                }
            };
            parts.into_iter().map(|name| (name, sensor.type_name))
        });
        let (spoken, kinds): (Vec<String>, Vec<&str>) = channels.unzip();
        let names = fields(spoken.iter().map(String::as_str));
        let kinds = kinds
            .iter()
            .map(|kind| format!("a reading of a {kind} sensor"));
        let described: Vec<_> = names.iter().cloned().zip(kinds).collect();
        let topic = self.flat_topic("/sensors", "kinemark.Sensors", &described);
        for tick in self.ticks(self.signal_rate_hz) {
            let values = run.trace.sensors.at(tick).iter().copied();
            let values = names.iter().map(String::as_str).zip(values).collect();
            self.numbers(topic, self.ns(tick as u64), values)?;
        }
        Ok(())
    }

    /// How far the TCP is from the goal it is on its way to.
    pub(super) fn errors(&mut self) -> Result<(), LogError> {
        let run = self.run;
        if run.goals.is_empty() {
            return Ok(());
        }
        let names = [
            ("goal", "number of the goal, from one"),
            ("distance_m", "distance of the TCP to the goal, m"),
            ("full_m", "distance that earns all points, m"),
            ("zero_m", "distance that earns none, m"),
        ];
        let described: Vec<_> = names
            .iter()
            .map(|(name, what)| ((*name).to_owned(), (*what).to_owned()))
            .collect();
        let topic = self.flat_topic("/errors", "kinemark.Errors", &described);
        for tick in self.ticks(self.signal_rate_hz) {
            let Some(index) = current_goal(&run.goals, tick as u64) else {
                continue;
            };
            let goal = &run.goals[index];
            let distance_m =
                (run.trace.tcp_position(tick) - nalgebra::Vector3::from(goal.position_m)).norm();
            let values = [(index + 1) as f64, distance_m, goal.full_m, goal.zero_m];
            let values = names.iter().map(|(name, _)| *name).zip(values).collect();
            self.numbers(topic, self.ns(tick as u64), values)?;
        }
        Ok(())
    }
}
