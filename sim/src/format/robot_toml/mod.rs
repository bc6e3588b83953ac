//! Robot files: TOML, with expressions over named dimensions; read and written.

mod dh;
mod drives;
mod robot_reader;
mod robot_tables;
mod robot_writer;

pub use robot_tables::RobotFile;

use super::mesh_location::MeshLocation;
use super::robot_format::{Likeness, RobotFormat};
use super::xml::document::root_name;

pub(super) const FORMAT: RobotFormat = RobotFormat {
    name: "a robot file",
    likeness: |text, extension| match (root_name(text), extension) {
        (None, "toml") => Likeness::Sure,
        (None, _) => Likeness::Possible,
        (Some(_), _) => Likeness::None,
    },
    read: |source, _, read| RobotFile::parse(source)?.with_meshes(read)?.build(&[]),
    write: Some(|robot, name_mesh| robot.to_toml(name_mesh)),
    mesh_location: |name| MeshLocation::Relative(name),
    is_of_ros: false,
    #[cfg(test)]
    sample: (
        "rrbot.toml",
        include_str!("../../../../labs/robots/rrbot.toml"),
    ),
};
