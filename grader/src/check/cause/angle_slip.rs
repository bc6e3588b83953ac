//! Ways in which right angles come out wrong: in degrees, exchanged, with another sign, or counted from another axis.

use std::f64::consts::PI;

use kinemark_sim::model::robot::Robot;

/// What was done to the angles of an arm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum AngleSlip {
    /// In degrees.
    Degrees,
    /// Two of them exchanged.
    Exchanged([usize; 2]),
    /// All with the other sign.
    AllSigns,
    /// One with the other sign.
    Sign(usize),
    /// One counted from the axis from which the one before is counted.
    FromAxis(usize),
}

impl AngleSlip {
    /// Those that a robot's angles can suffer.
    pub(super) fn all(robot: &Robot) -> Vec<Self> {
        let n = robot.n();
        let mut all = vec![Self::Degrees, Self::AllSigns];
        all.extend((0..n).map(Self::Sign));
        all.extend((1..n).map(Self::FromAxis));
        for first in 0..n {
            all.extend((first + 1..n).map(|second| Self::Exchanged([first, second])));
        }
        // of a single joint, all signs are one sign
        all.retain(|slip| n > 1 || *slip != Self::AllSigns);
        all
    }

    /// The angles that were meant, if this was done to `q`.
    pub(super) fn undone(self, robot: &Robot, q: &[f64]) -> Vec<f64> {
        let mut meant = q.to_vec();
        match self {
            Self::Degrees => {
                for (value, joint) in meant.iter_mut().zip(robot.moving_joints()) {
                    if joint.kind.turns() {
                        *value *= PI / 180.0;
                    }
                }
            }
            Self::Exchanged([first, second]) => meant.swap(first, second),
            Self::AllSigns => meant.iter_mut().for_each(|value| *value = -*value),
            Self::Sign(joint) => meant[joint] = -meant[joint],
            Self::FromAxis(joint) => meant[joint] -= meant[joint - 1],
        }
        meant
    }

    /// After "if": `its angles are taken as degrees`.
    pub(super) fn in_words(self, robot: &Robot) -> String {
        let name = |joint| joint_name(robot, joint);
        match self {
            Self::Degrees => "the angles are taken as degrees".to_owned(),
            Self::Exchanged([first, second]) => format!(
                "the angles of joints `{}` and `{}` are exchanged",
                name(first),
                name(second)
            ),
            Self::AllSigns => "all angles get the other sign".to_owned(),
            Self::Sign(joint) => {
                format!("the angle of joint `{}` gets the other sign", name(joint))
            }
            Self::FromAxis(joint) => format!(
                "the angle of joint `{}` is counted from where that of `{}` is counted, and not from the link before it",
                name(joint),
                name(joint - 1)
            ),
        }
    }

    /// What to ask where angles are given, and taken for others.
    pub(super) fn question_of_given(self, robot: &Robot) -> String {
        match self {
            Self::Degrees => "In which unit are the angles that you are given, and in which does `sin` take them?".to_owned(),
            Self::Exchanged(_) | Self::AllSigns | Self::Sign(_) => format!(
                "Which of the angles that you are given is that of joint `{}`, and with which sign does each stand in your formula?",
                joint_name(robot, 0)
            ),
            Self::FromAxis(_) => self.question(robot),
        }
    }

    /// What to ask where angles are returned.
    pub(super) fn question(self, robot: &Robot) -> String {
        let name = |joint| joint_name(robot, joint);
        match self {
            Self::Degrees => {
                "In which unit do you return angles? The arm takes radians.".to_owned()
            }
            Self::Exchanged(_) => format!(
                "In which order do you return the angles? The first number is for joint `{}`.",
                name(0)
            ),
            Self::AllSigns => format!(
                "Which way does joint `{}` turn for a positive angle? Try one alone.",
                name(0)
            ),
            Self::Sign(0) => format!(
                "Which way does joint `{}` turn for a positive angle? Try one alone.",
                name(0)
            ),
            Self::Sign(joint) => format!(
                "Do your angles belong together? For each way to bend joint `{}` the joints before it have angles of their own.",
                name(joint)
            ),
            Self::FromAxis(joint) => format!(
                "From which line is the angle of joint `{}` counted? Draw the arm with 0.5 rad in each joint.",
                name(joint)
            ),
        }
    }
}

fn joint_name(robot: &Robot, joint: usize) -> &str {
    let found = robot.moving_joints().nth(joint);
    found.map_or("?", |joint| joint.name.as_str())
}

/// The one slip of those of a robot that explains something; none where several do, or none.
pub(super) fn only_one(robot: &Robot, explains: impl Fn(AngleSlip) -> bool) -> Option<AngleSlip> {
    let mut found = AngleSlip::all(robot)
        .into_iter()
        .filter(|slip| explains(*slip));
    let first = found.next()?;
    found.next().is_none().then_some(first)
}
