//! The findings of a scene check, as data.

use nalgebra::Vector3;

use crate::engine::Overlap;
use crate::model::contact::Party;

/// How bad a finding is, the worst first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Severity {
    /// The scene does not work as described.
    Error,
    /// It may not be what was meant.
    Warning,
    /// Good to know.
    Note,
}

impl Severity {
    /// Its name in messages.
    pub fn name(self) -> &'static str {
        match self {
            Self::Error => "error",
            Self::Warning => "warning",
            Self::Note => "note",
        }
    }
}

/// One finding of a scene check.
#[derive(Debug, Clone, PartialEq)]
pub struct Finding {
    /// How bad it is.
    pub severity: Severity,
    /// What it is.
    pub kind: Kind,
}

/// The kinds of findings. Bodies, links and joints are given by index; via points count from 0.
#[derive(Debug, Clone, PartialEq)]
pub enum Kind {
    /// Two parties overlap at the start.
    Overlap(Overlap),
    /// A joint starts beyond its limits.
    StartBeyondLimit {
        /// Its index in `q`.
        joint: usize,
        /// Where it starts \[rad or m\].
        position: f64,
        /// The limit that it exceeds \[rad or m\].
        limit: f64,
    },
    /// A joint of the robot moves no inertia, so that no simulation of it can start.
    CannotMove {
        /// The joint.
        joint: String,
    },
    /// The centre of a body's shape went into something.
    FallsThrough {
        /// The body.
        body: usize,
        /// What it went into.
        through: Party,
        /// When \[s\].
        time_s: f64,
    },
    /// A body ends lower than its support.
    FallsOff {
        /// The body.
        body: usize,
        /// What was beneath it at the start.
        support: Party,
        /// How far its centre of mass ends below the point of support \[m\].
        below_m: f64,
    },
    /// A body still falls at the end, and nothing is beneath it.
    FallsForever {
        /// The body.
        body: usize,
    },
    /// A body's motion is no longer finite.
    FliesApart {
        /// The body, if it is known.
        body: Option<usize>,
        /// When \[s\].
        time_s: f64,
    },
    /// A body does not stay where it starts.
    Moves {
        /// The body.
        body: usize,
        /// How far its centre of mass ends from where it starts \[m\].
        distance_m: f64,
        /// By how much it ends tilted \[rad\].
        tilt_rad: f64,
    },
    /// A body still moves at the end.
    NeverRests {
        /// The body.
        body: usize,
        /// How fast its origin is then \[m/s\].
        speed_m_s: f64,
        /// How fast it turns then \[rad/s\].
        turning_rad_s: f64,
    },
    /// The TCP does not reach a via point.
    ViaUnreachable {
        /// The point.
        point: usize,
        /// What is left at the nearest position found \[m\].
        residual_m: f64,
    },
    /// With the TCP at a via point, a link collides with something that cannot move.
    ViaCollides {
        /// The point.
        point: usize,
        /// Branches that reach it.
        branches: usize,
        /// How many of them collide.
        colliding: usize,
        /// The shallowest of their overlaps: the collision of the best branch.
        overlap: Overlap,
    },
    /// With the TCP at a via point, a link touches a dynamic body.
    ViaTouches {
        /// The point.
        point: usize,
        /// Branches that reach it.
        branches: usize,
        /// How many of them touch a dynamic body and collide with nothing.
        touching: usize,
        /// The bodies.
        bodies: Vec<usize>,
    },
    /// The straight line from one via point to the next cannot be followed.
    LineBlocked {
        /// The point at which the line starts; it ends at the next point.
        from: usize,
        /// Branches it was followed from.
        branches: usize,
        /// How many of them cannot follow it.
        blocked: usize,
        /// Where the best of these stops.
        stop: LineStop,
    },
    /// Something was not checked, because it would have been too much work.
    NotChecked(Unchecked),
    /// The straight line leads the robot into dynamic bodies.
    LineTouches {
        /// The point at which the line starts; it ends at the next point.
        from: usize,
        /// Branches it was followed from.
        branches: usize,
        /// How many of them follow it and touch a dynamic body.
        touching: usize,
        /// The bodies.
        bodies: Vec<usize>,
    },
}

impl Kind {
    /// Its stable name.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Overlap(_) => "overlap",
            Self::StartBeyondLimit { .. } => "start-beyond-limit",
            Self::CannotMove { .. } => "cannot-move",
            Self::FallsThrough { .. } => "falls-through",
            Self::FallsOff { .. } => "falls-off",
            Self::FallsForever { .. } => "falls-forever",
            Self::FliesApart { .. } => "flies-apart",
            Self::Moves { .. } => "moves",
            Self::NeverRests { .. } => "never-rests",
            Self::ViaUnreachable { .. } => "via-unreachable",
            Self::ViaCollides { .. } => "via-collides",
            Self::ViaTouches { .. } => "via-touches",
            Self::LineBlocked { .. } => "line-blocked",
            Self::LineTouches { .. } => "line-touches",
            Self::NotChecked(_) => "not-checked",
        }
    }
}

/// What was not checked.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Unchecked {
    /// Some pairs of shapes, for overlaps at the start.
    Overlaps,
    /// Whether bodies stay, in a scene with so many overlaps that it would fly apart.
    Stay,
    /// Whether bodies stay, from this time on \[s\].
    StayFrom(f64),
    /// A via point, all after it, and all lines.
    ViaFrom(usize),
    /// The line that begins at this via point, and all after it.
    LinesFrom(usize),
}

/// Where a robot stops following a line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LineStop {
    /// How far along the line \[m\].
    pub along_m: f64,
    /// The point, in the world \[m\].
    pub p_in_world: Vector3<f64>,
    /// Why.
    pub cause: LineStopCause,
}

/// Why a line cannot be followed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum LineStopCause {
    /// No configuration within the joint limits is near the one before.
    OutOfReach {
        /// What is left at the nearest position found \[m\].
        residual_m: f64,
    },
    /// The next configuration is far from the one before: the robot would have to change its branch.
    Jumps {
        /// The joint that would move farthest, by its index in `q`.
        joint: usize,
        /// How far it would move within one sample of the line \[rad or m\].
        by: f64,
    },
    /// A link collides with something that cannot move.
    Collides(Overlap),
}
