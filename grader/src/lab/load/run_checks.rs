//! Checks of what a run did in a scene: names become indices.

use std::ops::Range;
use std::sync::Arc;

use kinemark_sim::event::SeenSide;
use kinemark_sim::scene::BodyKind;
use kinemark_sim::source::suggest;
use toml::Spanned;

use super::Reader;
use crate::lab::file::{BodyFallsTable, SideName};
use crate::lab::model::{CheckKind, TaskWork};
use crate::lab::problem::LabError;
use crate::lab::scene::LabScene;
use crate::lab::watched::Fall;

impl Reader<'_> {
    fn scene_of<'w>(
        &self,
        work: &'w TaskWork,
        kind: &str,
        at: Range<usize>,
    ) -> Result<&'w Arc<LabScene>, LabError> {
        let scene = match work {
            TaskWork::Motion(motion) => motion.scene.as_ref(),
            TaskWork::Function(_) => None,
        };
        match scene {
            Some(scene) => Ok(scene),
            None => self.report.err(
                at,
                "lab::check_kind",
                format!("a check of kind `{kind}` needs `scene` in [tasks.motion]"),
                "there is no scene in this task",
                Some("name one, such as `scene = \"shelf-and-can\"`".to_owned()),
            ),
        }
    }

    /// Index of a body of the scene.
    fn body(&self, scene: &LabScene, name: &Spanned<String>) -> Result<usize, LabError> {
        let names = scene.scene.bodies.iter().map(|body| body.name.as_str());
        let found = names.clone().position(|known| known == name.get_ref());
        match found {
            Some(index) => Ok(index),
            None => self.report.err(
                name.span(),
                "lab::unknown_body",
                format!("scene `{}` has no body `{}`", scene.name, name.get_ref()),
                "not a body of this scene",
                Some(suggest(name.get_ref(), "bodies", names)),
            ),
        }
    }

    pub(super) fn body_falls(
        &self,
        table: &Spanned<BodyFallsTable>,
        work: &TaskWork,
    ) -> Result<CheckKind, LabError> {
        let scene = self.scene_of(work, "body-falls", table.span())?;
        let at = table.span();
        let table = table.get_ref();
        let body = self.body(scene, &table.body)?;
        if !matches!(scene.scene.bodies[body].kind, BodyKind::Free) {
            let free = scene.scene.bodies.iter();
            let free = free.filter(|body| matches!(body.kind, BodyKind::Free));
            return self.report.err(
                table.body.span(),
                "lab::body_falls",
                format!(
                    "body `{}` cannot fall: it is not free",
                    table.body.get_ref()
                ),
                "not a free body",
                Some(suggest(
                    table.body.get_ref(),
                    "free bodies",
                    free.map(|body| body.name.as_str()),
                )),
            );
        }
        let (toppled, moved) = (table.toppled.unwrap_or(0.6), table.moved.unwrap_or(0.3));
        if !(0.0 <= moved && moved <= toppled && toppled <= 1.0) {
            return self.report.err(
                at,
                "lab::body_falls",
                format!("`moved` and `toppled` are shares in order, 0 <= moved <= toppled <= 1, got {moved} and {toppled}"),
                "this check",
                Some("left out they are 0.3 and 0.6".to_owned()),
            );
        }
        Ok(CheckKind::BodyFalls(Fall {
            body,
            side: table.side.map(|side| match side {
                SideName::Far => SeenSide::Far,
                SideName::Near => SeenSide::Near,
                SideName::Left => SeenSide::Left,
                SideName::Right => SeenSide::Right,
            }),
            toppled,
            moved,
        }))
    }
}
