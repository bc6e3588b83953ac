//! Everything that can be wrong with a scene file.

use crate::part::part_problem::{PartError, PartProblem};
use crate::text::{Located, Problem};

/// A problem in a scene file, with its place.
pub type SceneError = Located<SceneProblem>;

impl From<PartError> for SceneError {
    fn from(error: PartError) -> Self {
        error.map(SceneProblem::Part)
    }
}

/// What is wrong with a scene file.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[expect(missing_docs, reason = "each message says what its variant is")]
pub enum SceneProblem {
    #[error(transparent)]
    Part(#[from] PartProblem),
    #[error("body `{body}` has no shapes")]
    NoShapes { body: String },
    #[error("{message}")]
    Mass { message: String, help: String },
    #[error("{message}")]
    OpenMesh { message: String, help: String },
    #[error("{message}")]
    Motion { message: String, help: String },
    #[error("a gust needs a wind to blow along, and this one has no velocity")]
    GustWithoutWind,
}

impl Problem for SceneProblem {
    fn code(&self) -> &'static str {
        match self {
            Self::Part(part) => part.codes().scene,
            Self::NoShapes { .. } => "scene::no_shapes",
            Self::Mass { .. } => "scene::mass",
            Self::OpenMesh { .. } => "scene::open_mesh",
            Self::Motion { .. } => "scene::motion",
            Self::GustWithoutWind => "scene::gust_without_wind",
        }
    }

    fn label(&self) -> String {
        match self {
            Self::Part(part) => return part.label(),
            Self::NoShapes { .. } | Self::Mass { .. } => "this body",
            Self::OpenMesh { .. } => "this mesh",
            Self::Motion { .. } => "this motion",
            Self::GustWithoutWind => "this gust",
        }
        .to_owned()
    }

    fn help(&self) -> Option<String> {
        match self {
            Self::Part(part) => part.help(),
            Self::NoShapes { .. } => Some(
                "add `shapes`: a body without them touches nothing and cannot be seen".to_owned(),
            ),
            Self::Mass { help, .. } | Self::OpenMesh { help, .. } | Self::Motion { help, .. } => {
                Some(help.clone())
            }
            Self::GustWithoutWind => {
                Some("give `velocity_m_s` a direction, or leave the gust out".to_owned())
            }
        }
    }
}
