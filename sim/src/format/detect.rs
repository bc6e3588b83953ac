//! Which format the description of a robot is in: one line of [`FORMATS`] for each.

use crate::text::Source;

/// A format of robot descriptions that are files.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RobotFormat {
    /// A robot file of ours, TOML: [`RobotFile`](super::RobotFile).
    RobotToml,
    /// A URDF, XML: [`urdf`](mod@super::urdf).
    Urdf,
}

/// Whether a file of this text and this extension (lower case, without the point; empty for none) is of a format.
type Recognise = fn(&str, &str) -> bool;

/// The formats, the one that is recognised first before the others; the last one takes what is left.
const FORMATS: [(RobotFormat, Recognise); 2] = [
    (RobotFormat::Urdf, |text, extension| {
        let start = text.trim_start_matches('\u{feff}').trim_start();
        start.starts_with('<') || matches!(extension, "urdf" | "xml")
    }),
    (RobotFormat::RobotToml, |_, _| true),
];

/// The format of the robot that `source` describes, by its text and by the extension of its name.
pub fn detect(source: &Source) -> RobotFormat {
    let name = source.name().rsplit(['/', '\\']).next().unwrap_or_default();
    let extension = name.rsplit_once('.').map_or("", |(_, extension)| extension);
    let extension = extension.to_lowercase();
    let found = FORMATS
        .iter()
        .find(|(_, recognise)| recognise(source.text(), &extension));
    found.map_or(RobotFormat::RobotToml, |(format, _)| *format)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_text_decides_and_where_it_says_nothing_the_name() {
        for (name, text, expected) in [
            ("arm.toml", "format = 1", RobotFormat::RobotToml),
            ("arm", "", RobotFormat::RobotToml),
            ("a.urdf/arm", "format = 1", RobotFormat::RobotToml),
            ("arm.toml", "\u{feff} \n<robot/>", RobotFormat::Urdf),
            ("arm.URDF", "", RobotFormat::Urdf),
            ("b\\arm.xml", "oops", RobotFormat::Urdf),
        ] {
            assert_eq!(detect(&Source::new(name, text)), expected, "{name}");
        }
    }
}
