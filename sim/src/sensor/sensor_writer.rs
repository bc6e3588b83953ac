//! The table of a sensor in a robot file that is written.

use std::fmt::Write as _;

use crate::model::robot::Robot;
use crate::model::sensor::Sensor;
use crate::part::toml_text::quoted;
use crate::random::seed_of_name;

/// Writes the table of `sensor` of `robot` to the end of `out`.
pub(crate) fn sensor_table(sensor: &Sensor, robot: &Robot, out: &mut String) {
    let (name, kind) = (quoted(&sensor.name), sensor.type_name);
    let keys = sensor.kind.keys(robot);
    let _ = write!(
        out,
        "\n[[sensors]]\nname = {name}\ntype = \"{kind}\"\n{keys}"
    );
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
    if sensor.seed != seed_of_name(&sensor.name) {
        let _ = writeln!(out, "seed = {}", sensor.seed);
    }
}
