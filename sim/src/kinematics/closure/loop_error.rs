//! Why loops cannot be closed, with what is left open and what to do.

use super::{CLOSED, following::FURTHEST};

/// Why loops cannot be closed.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum LoopError {
    /// No position of the dependent joints closes the loops.
    #[error("the loop cannot be closed: {} is left", left(*gap_m, *angle_rad))]
    Open {
        /// Largest distance left \[m\].
        gap_m: f64,
        /// Largest angle left between axes \[rad\].
        angle_rad: f64,
    },
    /// More or fewer joints are passive than the loops determine.
    #[error("{passive} joints are passive, but the loops determine {determined}")]
    PassiveCount {
        /// Joints marked passive.
        passive: usize,
        /// Joints the loops determine at that position.
        determined: usize,
    },
    /// The loops close there, but not on the straight way from home.
    #[error(
        "the loops close there, but open on the straight way from home: it lies on another branch"
    )]
    Apart,
    /// The position is too far from home to be followed in small steps.
    #[error("a joint is {far:?} from home: loops are followed up to {FURTHEST} rad or m")]
    TooFar {
        /// The farthest way asked for \[rad or m\].
        far: f64,
    },
    /// The passive joints do not follow from the others at that position.
    #[error("the loops do not determine the dependent joints at this position (it is singular)")]
    Singular,
}

/// A gap and an angle in words, what is zero left out.
fn left(gap_m: f64, angle_rad: f64) -> String {
    let mut parts = Vec::new();
    if gap_m > CLOSED {
        parts.push(format!("a gap of {gap_m:.3e} m"));
    }
    if angle_rad > CLOSED {
        parts.push(format!("an angle of {angle_rad:.3e} rad"));
    }
    parts.join(" and ")
}

impl LoopError {
    /// What to do.
    pub fn help(&self) -> &'static str {
        match self {
            Self::Open { .. } => {
                "check the two frames and the lengths; give passive joints a `guess` near the closed position"
            }
            Self::PassiveCount { .. } => {
                "mark as `passive` all joints of the loop that have no drive; if it is flat at home, give them another `guess`"
            }
            Self::Apart => "give the joints a `guess` on that branch",
            Self::TooFar { .. } => "take whole turns off the angles",
            Self::Singular => {
                "give the joints a `guess` away from flat positions, or mark other joints `passive`"
            }
        }
    }
}
