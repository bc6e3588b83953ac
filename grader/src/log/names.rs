//! Names of frames and fields in a log: unique, and none that would lead a viewer astray.

use kinemark_sim::robot::{Frame, Robot};

use crate::report::visible::shortened;

/// The fixed root of every log.
pub(super) const WORLD: &str = "world";

/// What stands before the frames of the reference solution's motion.
pub(super) const REFERENCE: &str = "reference/";

/// A frame's name in the log. `world` is the root, and viewers take `base_link`, `odom`, `map` and `earth` for a fixed ground: a
/// robot's frame of such a name is put under the robot's own.
pub(super) fn frame_id(robot: &Robot, frame: &Frame) -> String {
    let moves = frame.attachment.body.is_some();
    let misleads = match frame.name.as_str() {
        WORLD => true,
        "base_link" | "odom" | "map" | "earth" => moves,
        _ => false,
    };
    if misleads {
        format!("{}/{}", robot.name(), frame.name)
    } else {
        frame.name.clone()
    }
}

/// A frame's name by the name the robot knows it by; a frame it does not know is the world.
pub(super) fn frame_id_of(robot: &Robot, name: &str) -> String {
    robot
        .frame(name)
        .map_or_else(|| WORLD.to_owned(), |frame| frame_id(robot, frame))
}

/// The frame of a body of the scene: never that of a link.
pub(super) fn body_frame(name: &str) -> String {
    format!("body/{name}")
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
    use super::*;

    #[test]
    fn fields_are_plain_and_differ() {
        let names = ["elbow error", "elbow-error", "", "<b>\u{202E}", "größe"];
        let expected = ["elbow_error", "elbow_error_2", "_2", "_b__U_202E_", "größe"];
        assert_eq!(fields(names.into_iter()), expected);
    }
}
