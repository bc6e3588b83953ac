//! Why loops cannot be closed: the remaining gap, and what to do.

use super::{CLOSED, following::FURTHEST};

/// Why loops cannot be closed.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum LoopError {
    /// No positions of the dependent joints close the loops.
    #[error("the loop cannot be closed: {} is left", left(*gap_m, *angle_rad))]
    Open {
        /// Largest remaining distance \[m\].
        gap_m: f64,
        /// Largest remaining angle between axes \[rad\].
        angle_rad: f64,
    },
    /// More or fewer joints are passive than the loops determine.
    #[error("{passive} joints are passive, but the loops determine {determined}")]
    PassiveCount {
        /// Number of joints marked passive.
        passive: usize,
        /// Number of joints that the loops determine in that configuration.
        determined: usize,
    },
    /// The loops close there, but not along the straight joint path from home.
    #[error(
        "the loops close there, but not along the straight joint path from home: the configuration is on another branch"
    )]
    Apart,
    /// The configuration is too far from home to be followed in small steps.
    #[error("a joint is {far:?} from home: loops are followed up to {FURTHEST} rad or m")]
    TooFar {
        /// The largest distance of a joint from home \[rad or m\].
        far: f64,
    },
    /// The passive joints do not follow from the others in that configuration.
    #[error(
        "the loops do not determine the dependent joints in this configuration (it is singular)"
    )]
    Singular,
}

/// A gap and an angle in words; the one that is zero is left out.
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
                "check the two frames and the lengths; give passive joints a `guess` near the closed configuration"
            }
            Self::PassiveCount { .. } => {
                "mark as `passive` all joints of the loop that have no drive; if it is flat at home, give them another `guess`"
            }
            Self::Apart => "give the joints a `guess` on that branch",
            Self::TooFar { .. } => "remove full turns from the angles",
            Self::Singular => {
                "give the joints a `guess` away from flat configurations, or mark other joints `passive`"
            }
        }
    }
}
