//! The visible cases of a function task as a page draws them: where the arm is and where an answer has it, and each number of an answer
//! beside the right one.

/// The cases of a function task that are drawn.
#[derive(Debug, Clone, PartialEq)]
pub struct ShownCases {
    /// The task's name.
    pub task: String,
    /// The frame of its positions.
    pub seen_from: String,
    /// Those without a good answer first.
    pub cases: Vec<ShownCase>,
}

/// One visible case.
#[derive(Debug, Clone, PartialEq)]
pub struct ShownCase {
    /// Its name.
    pub name: String,
    /// Whether its answer is good.
    pub is_good: bool,
    /// Where the TCP is and is said to be, of a function that is about its place.
    pub places: Option<ShownPlaces>,
    /// The numbers of an answer that is not good, beside the right ones.
    pub numbers: Vec<ComparedNumbers>,
}

/// The arm of a case, and where the answer has it.
#[derive(Debug, Clone, PartialEq)]
pub struct ShownPlaces {
    /// How far each axis of the frame points up in the world, with the arm at home.
    pub upward: [f64; 3],
    /// Where the TCP is at the positions given, or where it should get, in the task's frame \[m\].
    pub right_m: [f64; 3],
    /// The arm as a line at the positions given; empty where they are what is asked for \[m\].
    pub arm_m: Vec<[f64; 3]>,
    /// Of inverse kinematics: how many branches reach it, none of a target out of reach.
    pub branches: Option<BranchCount>,
    /// What was answered: one place of forward kinematics, and one a branch of inverse kinematics.
    pub answered: Vec<AnsweredPlace>,
}

impl ShownPlaces {
    /// Whether no joint positions put the TCP where it is asked for.
    pub fn is_out_of_reach(&self) -> bool {
        self.branches.is_some_and(|count| count.all == 0)
    }
}

/// Branches of a case of inverse kinematics.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct BranchCount {
    /// How many different right ones were answered: one that is answered twice counts once.
    pub found: u32,
    /// How many there are.
    pub all: u32,
}

/// Where an answer has the TCP.
#[derive(Debug, Clone, PartialEq)]
pub struct AnsweredPlace {
    /// The TCP \[m\].
    pub tcp_m: [f64; 3],
    /// The arm as a line at answered positions; empty where a place was answered \[m\].
    pub arm_m: Vec<[f64; 3]>,
    /// Whether it earns the points.
    pub is_right: bool,
}

/// The numbers of one entry of an answer.
#[derive(Debug, Clone, PartialEq)]
pub struct ComparedNumbers {
    /// The entry's name; empty where the answer has one entry only.
    pub name: String,
    /// How many of them are in a row.
    pub columns: usize,
    /// Each, row by row.
    pub numbers: Vec<ComparedNumber>,
}

/// An answered number beside the right one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ComparedNumber {
    /// The answer.
    pub answered: f64,
    /// What is right.
    pub right: f64,
    /// Whether it is near enough: by itself it would not cost points.
    pub is_right: bool,
}
