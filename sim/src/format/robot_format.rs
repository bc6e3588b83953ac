//! What a format of robot descriptions is, and which one a description is in. The list of formats is [`super::ROBOT_FORMATS`].

use serde::{Deserialize, Serialize};

use super::ROBOT_FORMATS;
use super::mesh_location::MeshLocation;
use super::robot_problem::RobotError;
use crate::model::robot::Robot;
use crate::model::unphysical::OnUnphysical;
use crate::text::Source;

/// Gets the bytes of a file by the name that a description has for it, or why there are none.
pub type ReadFile<'a> = dyn FnMut(&str) -> Result<Vec<u8>, String> + 'a;

/// Gets the name that a new description should have for a mesh by the name that the robot has for it.
pub type NameMesh<'a> = dyn FnMut(&str) -> String + 'a;

/// How a description is read.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub struct ReadOptions {
    /// Whether a mimic joint gets an entry of its own in `q`, as if it followed nothing; formats of ROS only.
    pub ignore_mimic: bool,
    /// What becomes of tensors that no body can have; formats of ROS only: a robot file says it itself, link by link.
    pub on_unphysical: OnUnphysical,
}

/// How much a file looks like one of a format.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Likeness {
    /// It is something else.
    None,
    /// It may be one that is broken.
    Possible,
    /// It is one and no other.
    Sure,
}

/// A format of robot descriptions that are files.
#[derive(Debug)]
pub struct RobotFormat {
    /// What messages call a description, with its article.
    pub name: &'static str,
    /// How much a file looks like one, by its text and by the extension of its name (lower case, without the point; empty for none).
    pub likeness: fn(text: &str, extension: &str) -> Likeness,
    /// Reads the robot of a description. A shape whose file cannot be read is a problem or one of [`Robot::warnings`].
    pub read: fn(Source, &ReadOptions, &mut ReadFile<'_>) -> Result<Robot, RobotError>,
    /// Writes a description, if robots can be written in the format.
    pub write: Option<fn(&Robot, &mut NameMesh<'_>) -> String>,
    /// Where a mesh lies that a description names so.
    pub mesh_location: fn(&str) -> MeshLocation<'_>,
    /// Whether it is one of ROS: meshes may lie in packages, and [`ReadOptions`] count.
    pub is_of_ros: bool,
    /// A description, with the name of its file.
    #[cfg(test)]
    pub(super) sample: (&'static str, &'static str),
}

/// The format of the robot that `source` describes, by its text and by the extension of its name.
pub fn detect(source: &Source) -> &'static RobotFormat {
    let name = source.name().rsplit(['/', '\\']).next().unwrap_or_default();
    let extension = name.rsplit_once('.').map_or("", |(_, extension)| extension);
    let extension = extension.to_lowercase();
    let likeness = |format: &RobotFormat| (format.likeness)(source.text(), &extension);
    let mut best = &ROBOT_FORMATS[0];
    for format in &ROBOT_FORMATS[1..] {
        if likeness(format) > likeness(best) {
            best = format;
        }
    }
    best
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sample_of_each_format_is_recognised_as_that_and_no_other() {
        for format in ROBOT_FORMATS {
            let (name, text) = format.sample;
            assert_eq!(detect(&Source::new(name, text)).name, format.name, "{name}");
            let extension = name.rsplit_once('.').map_or("", |(_, extension)| extension);
            for other in ROBOT_FORMATS {
                let is_sure = (other.likeness)(text, extension) == Likeness::Sure;
                assert_eq!(is_sure, other.name == format.name, "{name}: {}", other.name);
            }
        }
    }

    #[test]
    fn the_sample_of_each_format_is_read_and_what_is_written_is_read_again() {
        let options = ReadOptions::default();
        for format in ROBOT_FORMATS {
            let (name, text) = format.sample;
            let read = |text: &str| {
                (format.read)(Source::new(name, text), &options, &mut |_| {
                    Err("no file".to_owned())
                })
            };
            let robot = read(text).unwrap_or_else(|error| panic!("{name}: {error}"));
            assert!(robot.n() > 0, "{name}");
            if let Some(write) = format.write {
                // expressions are written as numbers, so dimensions are not
                let again = read(&write(&robot, &mut str::to_owned)).unwrap();
                assert_eq!(again.links(), robot.links(), "{name}");
                assert_eq!(again.joints(), robot.joints(), "{name}");
                assert_eq!(again.frames(), robot.frames(), "{name}");
            }
            let broken = read(&text.replace("parent", "parnet")).expect_err(name);
            assert!(broken.line_and_column().0 > 1, "{name}: {broken}");
        }
    }

    #[test]
    fn the_text_decides_and_where_it_says_nothing_the_name() {
        for (name, text, expected) in [
            ("arm.toml", "format = 1", "a robot file"),
            ("arm", "", "a robot file"),
            ("arm", "name = \"x\"", "a robot file"),
            ("a.urdf/arm", "format = 1", "a robot file"),
            ("arm.toml", "\u{feff} \n<robot/>", "a URDF"),
            ("arm", "<?xml version='1.0'?><!-- <a> --><robot>", "a URDF"),
            ("arm", "<sdf/>", "a URDF"),
            ("arm.URDF", "", "a URDF"),
            ("b\\arm.xml", "oops", "a URDF"),
        ] {
            assert_eq!(detect(&Source::new(name, text)).name, expected, "{name}");
        }
    }
}
