//! Units of what a joint does: one that turns has rad and N m, one that slides m and N.

use kinemark_sim::model::robot::Robot;

/// The units of one joint, or of all joints of a robot.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum JointUnits {
    /// It turns.
    Turning,
    /// It slides.
    Sliding,
    /// Of several joints, some turn and some slide.
    Mixed,
}

impl JointUnits {
    /// Those of the joint with index `joint` in `q`.
    pub fn of(robot: &Robot, joint: usize) -> Self {
        match robot.moving_joints().nth(joint) {
            Some(joint) if !joint.kind.turns() => Self::Sliding,
            _ => Self::Turning,
        }
    }

    /// Those of all joints of `robot`.
    pub fn of_all(robot: &Robot) -> Self {
        let units = (0..robot.n()).map(|joint| Self::of(robot, joint));
        units
            .reduce(|a, b| if a == b { a } else { Self::Mixed })
            .unwrap_or(Self::Turning)
    }

    /// Of a position.
    pub fn position(self) -> &'static str {
        match self {
            Self::Turning => "rad",
            Self::Sliding => "m",
            Self::Mixed => "rad or m",
        }
    }

    /// Of a velocity or speed.
    pub fn speed(self) -> &'static str {
        match self {
            Self::Turning => "rad/s",
            Self::Sliding => "m/s",
            Self::Mixed => "rad/s or m/s",
        }
    }

    /// Of an effort.
    pub fn effort(self) -> &'static str {
        match self {
            Self::Turning => "N m",
            Self::Sliding => "N",
            Self::Mixed => "N m or N",
        }
    }
}

#[cfg(test)]
mod tests {
    use kinemark_sim::format::RobotFile;
    use kinemark_sim::text::Source;

    use super::*;

    #[test]
    fn a_robot_of_both_kinds_has_both_units() {
        let units = |kinds: [&str; 2]| {
            let [first, second] = kinds;
            let text = format!(
                r#"
                format = 1
                name = "two"
                links = [{{ name = "base" }}, {{ name = "first" }}, {{ name = "second" }}]
                joints = [
                    {{ name = "a", type = "{first}", parent = "base", child = "first", axis = [0.0, 0.0, 1.0] }},
                    {{ name = "b", type = "{second}", parent = "first", child = "second", axis = [0.0, 0.0, 1.0] }},
                ]
                frames = [{{ name = "tcp", link = "second" }}]
                "#
            );
            let file = RobotFile::parse(Source::new("two.toml", text)).unwrap();
            let robot = file.build(&[]).unwrap();
            (JointUnits::of(&robot, 1), JointUnits::of_all(&robot))
        };
        assert_eq!(
            units(["revolute", "prismatic"]),
            (JointUnits::Sliding, JointUnits::Mixed)
        );
        assert_eq!(
            units(["prismatic", "prismatic"]),
            (JointUnits::Sliding, JointUnits::Sliding)
        );
        assert_eq!(
            units(["prismatic", "continuous"]),
            (JointUnits::Turning, JointUnits::Mixed)
        );
    }
}
