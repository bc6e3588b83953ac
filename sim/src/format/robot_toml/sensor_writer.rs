//! The tables of sensors in a robot file that is written.

use std::fmt::Write as _;

use super::robot_writer::{quoted, triple};
use crate::model::robot::Robot;
use crate::model::sensor::{Sensor, SensorKind, default_seed};

impl Robot {
    pub(crate) fn sensor_table(&self, sensor: &Sensor, out: &mut String) {
        let _ = write!(
            out,
            "\n[[sensors]]\nname = {}\ntype = \"{}\"\n",
            quoted(&sensor.name),
            sensor.kind.name()
        );
        let joint = |joint: usize| format!("joint = {}\n", quoted(&self.joints()[joint].name));
        match &sensor.kind {
            SensorKind::JointPosition { joint: of }
            | SensorKind::JointVelocity { joint: of }
            | SensorKind::JointEffort { joint: of }
            | SensorKind::Wrench { joint: of } => out.push_str(&joint(*of)),
            SensorKind::LimitSwitch(switch) => {
                out.push_str(&joint(switch.joint));
                let _ = write!(
                    out,
                    "at = {:?}\nside = \"{}\"\n",
                    switch.at,
                    switch.side.name()
                );
                if !switch.opens_motor {
                    out.push_str("opens_motor = false\n");
                }
            }
            SensorKind::RangeFinder(finder) => {
                let _ = write!(
                    out,
                    "frame = {}\naxis = {}\nrange_m = {:?}\n",
                    quoted(&self.frames()[finder.frame].name),
                    triple(&finder.axis),
                    finder.range_m
                );
            }
            SensorKind::Contact { link } => {
                let _ = writeln!(out, "link = {}", quoted(&self.links()[*link].name));
            }
        }
        for (key, value) in [
            ("noise", sensor.noise),
            ("quantisation", sensor.quantisation),
            ("delay_s", sensor.delay_s),
        ] {
            if value != 0.0 {
                let _ = writeln!(out, "{key} = {value:?}");
            }
        }
        if let Some(rate_hz) = sensor.rate_hz {
            let _ = writeln!(out, "rate_hz = {rate_hz:?}");
        }
        if sensor.seed != default_seed(&sensor.name) {
            let _ = writeln!(out, "seed = {}", sensor.seed);
        }
    }
}
