//! The kinds of sensors, one file each, and the tables of sensors in a robot file or wherever else sensors are described.

#[cfg(test)]
mod documentation;
mod kind;
mod of_joint;
mod registry;
mod sensor_problem;
mod sensor_reader;
mod sensor_schema;
mod sensor_writer;

pub use sensor_problem::SensorProblem;
pub(crate) use sensor_reader::sensors_of;
pub use sensor_reader::{SensorTable, read_all};
pub(crate) use sensor_writer::sensor_table;

#[cfg(test)]
pub(crate) use tests::example;

#[cfg(test)]
mod tests {
    use super::kind::KINDS;
    use super::registry::Kind;
    use crate::format::{RobotError, RobotFile};
    use crate::model::robot::Robot;
    use crate::model::sensor::{Sensor, replaced};
    use crate::text::{Problem as _, Source};

    /// The robot `rrbot` of the labs with more tables at the end of its file.
    fn equipped(tables: &str) -> Result<Robot, RobotError> {
        let rrbot = include_str!("../../../labs/robots/rrbot.toml");
        RobotFile::parse(Source::new("robot.toml", format!("{rrbot}{tables}")))?.build(&[])
    }

    fn table(kind: &Kind, more: &str) -> String {
        let Kind { name, example, .. } = kind;
        format!("\n[[sensors]]\nname = 'example'\ntype = '{name}'\n{example}\n{more}")
    }

    /// The example of a kind on `rrbot`, called `example`.
    pub(crate) fn example(kind: &str) -> Sensor {
        let kind = KINDS.iter().find(|known| known.name == kind).unwrap();
        equipped(&table(kind, "")).unwrap().sensors()[0].clone()
    }

    #[test]
    fn a_sensor_of_every_kind_is_read_and_what_is_written_is_read_again() {
        for kind in KINDS {
            let mut tables = vec![
                table(kind, ""),
                table(kind, "delay_s = 0.004\nrate_hz = 100\n"),
            ];
            if kind.is_noisy {
                tables.push(table(
                    kind,
                    "noise = 0.001\nquantisation = 0.0015\nseed = 7\n",
                ));
            }
            for table in tables {
                let first = equipped(&table).unwrap_or_else(|error| panic!("{error}\n{table}"));
                let [sensor] = first.sensors() else {
                    panic!("one sensor in {table}");
                };
                assert_eq!(sensor.type_name, kind.name);
                let written = first.to_toml(&mut str::to_owned);
                let again = RobotFile::parse(Source::new("robot.toml", written));
                let again = again.and_then(|file| file.build(&[])).unwrap();
                assert_eq!(first.sensors(), again.sensors(), "{table}");
            }
        }
    }

    #[test]
    fn a_sensor_of_every_kind_refuses_keys_of_others_and_needs_its_own() {
        for kind in KINDS {
            let mistaken = |table: &str| {
                let error = equipped(table).expect_err(table);
                assert_eq!(error.problem.code(), "robot::sensor", "{error}\n{table}");
                assert!(error.problem.help().is_some(), "{error}");
                error.to_string()
            };
            let name = kind.name;
            assert_eq!(
                mistaken(&table(kind, "colour = 'red'\n")),
                format!("a sensor of type `{name}` has no `colour`")
            );
            let (bare, example) = (table(kind, ""), kind.example);
            let error = mistaken(&bare.replace(example, ""));
            assert!(error.starts_with("sensor `example` has no `"), "{error}");
        }
    }

    #[test]
    fn a_change_takes_the_place_of_its_name_or_the_end() {
        let named = |name: &str, kind: &str| Sensor {
            name: name.to_owned(),
            ..example(kind)
        };
        let given = [named("a", "contact"), named("b", "contact")];
        let changes = [named("c", "wrench"), named("a", "wrench")];
        let sensors = replaced(&given, changes.clone());
        let [c, a] = changes;
        assert_eq!(sensors, [a, named("b", "contact"), c]);
    }
}
