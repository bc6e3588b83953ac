//! What checks of a run look at: two that touch, a path to be followed.

use kinemark_sim::model::contact::Party;
use kinemark_sim::watch::Names;
use nalgebra::Vector3;

/// One of two that touch.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TouchingParty {
    /// Any link of the robot.
    Arm,
    /// A link, by its index among the robot's.
    Link(usize),
    /// A body, by its index in the scene.
    Body(usize),
    /// The ground.
    Ground,
}

impl TouchingParty {
    fn is(self, party: Party) -> bool {
        match (self, party) {
            (Self::Arm, Party::Link(_)) | (Self::Ground, Party::Ground) => true,
            (Self::Link(wanted), Party::Link(index)) | (Self::Body(wanted), Party::Body(index)) => {
                wanted == index
            }
            _ => false,
        }
    }

    /// Whether these two are the parties of a contact, in either order.
    pub fn meets(self, other: Self, [first, second]: [Party; 2]) -> bool {
        (self.is(first) && other.is(second)) || (self.is(second) && other.is(first))
    }
}

/// A path of straight segments for the TCP.
#[derive(Debug, Clone, PartialEq)]
pub struct PathToFollow {
    /// Its name in the task.
    pub name: String,
    /// Its points in the lab's frame, at least two \[m\].
    pub points_m: Vec<Vector3<f64>>,
    /// What is cut off each end of each segment; positive, and under half of the shortest \[m\].
    pub trim_m: f64,
}

impl TouchingParty {
    /// Its name as it stands in a sentence.
    pub fn in_sentence(self, names: &Names<'_>) -> String {
        match self {
            Self::Arm => "the arm".to_owned(),
            Self::Link(index) => format!("`{}`", names.party(Party::Link(index))),
            Self::Body(index) => format!("`{}`", names.party(Party::Body(index))),
            Self::Ground => "the ground".to_owned(),
        }
    }
}
