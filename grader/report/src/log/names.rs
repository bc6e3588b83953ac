//! Names of frames and fields in a log: unique, and none that would lead a viewer astray.

use kinemark_sim::model::robot::{Frame, Robot};

use crate::visible::shortened;

/// The fixed root of every log.
pub(super) const WORLD: &str = "world";

/// What stands before the frames of the reference solution's motion.
pub(super) const REFERENCE: &str = "reference/";

/// What stands before the frames of a scene's bodies.
const BODY: &str = "body/";

/// A frame's name in the log. `world` is the root, and viewers take `base_link`, `odom`, `map` and `earth` for a fixed ground: a
/// robot's frame of such a name is put under the robot's own, and so is one that is called as only bodies and the reference's frames
/// are.
pub(super) fn frame_id(robot: &Robot, frame: &Frame) -> String {
    let moves = frame.attachment.body.is_some();
    let misleads = match frame.name.as_str() {
        WORLD => true,
        "base_link" | "odom" | "map" | "earth" => moves,
        name => is_taken(name),
    };
    if !misleads {
        return frame.name.clone();
    }
    let mut name = format!("{}/{}", robot.name(), frame.name);
    // a robot may be called `body`, or have a frame of this name, too
    while is_taken(&name) || robot.frame(&name).is_some() {
        name.insert_str(0, "robot/");
    }
    name
}

/// Whether a name begins as those of bodies and of the reference's frames do.
fn is_taken(name: &str) -> bool {
    [BODY, REFERENCE]
        .into_iter()
        .any(|prefix| name.starts_with(prefix))
}

/// A frame's name by the name the robot knows it by; a frame it does not know is the world.
pub(super) fn frame_id_of(robot: &Robot, name: &str) -> String {
    robot
        .frame(name)
        .map_or_else(|| WORLD.to_owned(), |frame| frame_id(robot, frame))
}

/// The frame of a body of the scene: never that of a link.
pub(super) fn body_frame(name: &str) -> String {
    format!("{BODY}{name}")
}

/// Field names from free text: letters, digits and underscores, no two the same, in the same order.
pub(super) fn fields<'a>(names: impl Iterator<Item = &'a str>) -> Vec<String> {
    let mut fields: Vec<String> = Vec::new();
    for name in names {
        let word = |c: char| if c.is_alphanumeric() { c } else { '_' };
        let wanted: String = shortened(name, 40).chars().map(word).collect();
        let mut field = wanted.clone();
        let mut number = 2;
        while fields.contains(&field) || field.is_empty() {
            field = format!("{wanted}_{number}");
            number += 1;
        }
        fields.push(field);
    }
    fields
}

#[cfg(test)]
mod tests {
    use kinemark_sim::format::RobotFile;
    use kinemark_sim::text::Source;

    use super::*;

    /// The course's arm under another name, with frames of these names.
    fn arm(name: &str, frames: &[&str]) -> Robot {
        let mut text = include_str!("../../../../labs/robots/rrbot.toml").to_owned();
        text = text.replacen("name = \"rrbot\"", &format!("name = \"{name}\""), 1);
        for frame in frames {
            text += &format!("\n[[frames]]\nname = \"{frame}\"\nlink = \"forearm\"\n");
        }
        let file = RobotFile::parse(Source::new("arm.toml", text)).unwrap();
        file.build(&[]).unwrap()
    }

    #[test]
    fn no_frame_of_a_robot_is_called_as_a_body_or_the_root() {
        let called = |robot: &Robot, name: &str| frame_id_of(robot, name);
        let plain = arm("rrbot", &["body/can", "reference/upper", "body"]);
        assert_eq!(called(&plain, "body/can"), "rrbot/body/can");
        assert_eq!(called(&plain, "reference/upper"), "rrbot/reference/upper");
        assert_eq!(called(&plain, "body"), "body");
        let body = arm("body", &["base_link"]);
        assert_eq!(called(&body, "base_link"), "robot/body/base_link");
        let both = arm("rrbot", &["rrbot/base_link", "base_link"]);
        assert_eq!(called(&both, "rrbot/base_link"), "rrbot/base_link");
        assert_eq!(called(&both, "base_link"), "robot/rrbot/base_link");
    }

    #[test]
    fn fields_are_plain_and_differ() {
        let names = ["elbow error", "elbow-error", "", "<b>\u{202E}", "größe"];
        let expected = ["elbow_error", "elbow_error_2", "_2", "_b__U_202E_", "größe"];
        assert_eq!(fields(names.into_iter()), expected);
    }
}
