//! The old paths of what moved, until every crate names the new ones.
#![allow(missing_docs, reason = "goes when every crate names the new paths")]

pub mod air {
    pub use crate::model::air::*;
}
pub mod source {
    pub use crate::text::{Located, Problem, Source, TomlRefusal, nearest, suggest};
}
pub mod robot {
    pub use crate::format::{
        RobotError, RobotFile, RobotProblem, joint_string as config_string, urdf,
    };
    pub use crate::model::robot::{Frame, Joint, JointKind, Limits, Link, Robot};
    pub use crate::model::{extent, inertia, mesh, robot as model};
    pub use crate::text::{Dimension, Dimensions, expression};
    pub mod file {
        pub use crate::format::RobotFile;
        pub use crate::text::{Dimension, Dimensions};
    }
    pub mod part {
        pub use crate::format::PartProblem;
    }
    pub mod problem {
        pub use crate::format::{RobotError, RobotProblem};
    }
}
pub mod scene {
    pub use crate::format::{SceneError, SceneFile, SceneProblem};
    pub use crate::model::air::Drag;
    pub use crate::model::gust::{Gust, GustSequence};
    pub use crate::model::prescribed_motion::{Motion, Waypoint};
    pub use crate::model::scene::{BodyKind, Environment, Scene, SceneBody, Wind};
}
pub mod sensor {
    pub use crate::format::{SensorProblem, SensorTable, resolve, resolve_all};
    pub use crate::model::sensor::*;
    pub use crate::sensing::{Seen, SensorError, Sensors};
}
pub mod joint {
    pub use crate::joint_space::*;
}
pub mod event {
    pub use crate::watch::event::*;
}
pub mod event_words {
    pub use crate::watch::Names;
}
pub mod runaway {
    pub use crate::diagnosis::{Cause, likely_cause};
    pub use crate::run::{BlowUp, RUNAWAY_SPEED_M_S};
}
pub mod hybrid {
    pub use crate::step::hybrid::*;
}
