//! A robot from its text: which format the text is in, and how it is read.

use kinemark_sim::format::urdf;
use kinemark_sim::format::urdf::UrdfOptions;
use kinemark_sim::format::{RobotError, RobotFile, joint_string};
use kinemark_sim::model::robot::Robot;
use kinemark_sim::text::Source;

/// The format of a robot's description.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RobotFormat {
    /// A robot file (TOML).
    Toml,
    /// A URDF (XML).
    Urdf,
}

impl RobotFormat {
    /// The format of a text: XML is a URDF, whatever its name; else the ending of the name decides.
    pub fn of(name: &str, text: &str) -> Self {
        let is_xml = text
            .trim_start_matches('\u{feff}')
            .trim_start()
            .starts_with('<');
        let ending = name
            .rsplit_once('.')
            .map(|(_, ending)| ending.to_lowercase());
        if is_xml || matches!(ending.as_deref(), Some("urdf" | "xml")) {
            Self::Urdf
        } else {
            Self::Toml
        }
    }
}

/// What reads a mesh that a description names: its bytes, or why there are none.
pub trait MeshReader {
    /// Reads the mesh that the description calls `name`.
    ///
    /// # Errors
    /// Why it cannot be read, for a person.
    fn read_mesh(&mut self, name: &str) -> Result<Vec<u8>, String>;
}

/// Reads the robot of a description.
///
/// # Errors
/// Whatever makes the text no robot, with its place.
pub fn robot(
    source: Source,
    format: RobotFormat,
    options: &UrdfOptions,
    meshes: &mut dyn MeshReader,
) -> Result<Robot, RobotError> {
    let mut read_mesh = |name: &str| meshes.read_mesh(name);
    match format {
        RobotFormat::Toml => RobotFile::parse(source)?.with_meshes(read_mesh)?.build(&[]),
        RobotFormat::Urdf => urdf::robot(source, options, &mut read_mesh),
    }
}

/// Whether a text is meant as a joint string such as `RzRyRz`.
pub fn is_meant_as_joint_string(text: &str) -> bool {
    joint_string::looks_like_one(text)
}

/// The robot of a joint string such as `RzRyRz`, with the height of its first joint and one `lx,ly,lz` per joint \[m\].
///
/// # Errors
/// What is wrong with the joints or the links, with its place.
pub fn robot_of_joint_string(
    joints: &str,
    base_m: f64,
    links_m: &str,
) -> Result<Robot, RobotError> {
    joint_string::robot(joints, base_m, links_m)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_text_decides_the_format_before_the_name() {
        for (name, text, format) in [
            ("arm.toml", "format = 1", RobotFormat::Toml),
            ("arm", "name = \"x\"", RobotFormat::Toml),
            ("arm.urdf", "", RobotFormat::Urdf),
            ("arm.URDF", "robot", RobotFormat::Urdf),
            ("arm.toml", "\u{feff}\n <robot/>", RobotFormat::Urdf),
        ] {
            assert_eq!(RobotFormat::of(name, text), format, "{name} {text}");
        }
    }
}
