//! Checks of what a run did in a scene: names become indices of bodies and links that can do what is asked.

use std::ops::Range;
use std::sync::Arc;

use kinemark_sim::event::SeenSide;
use kinemark_sim::scene::BodyKind;
use kinemark_sim::source::suggest;
use toml::Spanned;

use super::Reader;
use crate::lab::file::{BodyFallsTable, ContactImpulseTable, SideName, SpeedAtName, TcpSpeedTable};
use crate::lab::model::{CheckKind, TaskWork};
use crate::lab::problem::LabError;
use crate::lab::scene::LabScene;
use crate::lab::watched::{Fall, SpeedAt, TouchingParty};

impl Reader<'_> {
    pub(super) fn scene_of<'w>(
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
    pub(super) fn body(&self, scene: &LabScene, name: &Spanned<String>) -> Result<usize, LabError> {
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

    /// Index of a body of the scene that can fall.
    pub(super) fn free_body(
        &self,
        scene: &LabScene,
        name: &Spanned<String>,
    ) -> Result<usize, LabError> {
        let body = self.body(scene, name)?;
        if matches!(scene.scene.bodies[body].kind, BodyKind::Free) {
            return Ok(body);
        }
        let free = scene.scene.bodies.iter();
        let free = free.filter(|body| matches!(body.kind, BodyKind::Free));
        self.report.err(
            name.span(),
            "lab::body_falls",
            format!("body `{}` cannot fall: it is not free", name.get_ref()),
            "not a free body",
            Some(suggest(
                name.get_ref(),
                "free bodies",
                free.map(|body| body.name.as_str()),
            )),
        )
    }

    pub(super) fn body_falls(
        &self,
        table: &Spanned<BodyFallsTable>,
        work: &TaskWork,
    ) -> Result<CheckKind, LabError> {
        let scene = self.scene_of(work, "body-falls", table.span())?;
        let at = table.span();
        let table = table.get_ref();
        let body = self.free_body(scene, &table.body)?;
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

    pub(super) fn contact_impulse(
        &self,
        table: &Spanned<ContactImpulseTable>,
        work: &TaskWork,
    ) -> Result<CheckKind, LabError> {
        let scene = self.scene_of(work, "contact-impulse", table.span())?;
        let at = table.span();
        let table = table.get_ref();
        let [first, second] = &table.between;
        let between = [self.party(scene, first)?, self.party(scene, second)?];
        let gives_way = |party: TouchingParty| match party {
            TouchingParty::Arm | TouchingParty::Link(_) => true,
            TouchingParty::Body(index) => {
                matches!(scene.scene.bodies[index].kind, BodyKind::Free)
            }
            TouchingParty::Ground => false,
        };
        let are_links =
            |party: &TouchingParty| matches!(party, TouchingParty::Arm | TouchingParty::Link(_));
        let why = if between.iter().all(are_links) {
            "links of one robot do not touch each other"
        } else if between[0] == between[1] {
            "nothing touches itself"
        } else if !between.into_iter().any(gives_way) {
            "neither of them gives way, so they never press on each other"
        } else {
            return Ok(CheckKind::ContactImpulse {
                between,
                band: self.band(table.full_n_s, table.zero_n_s, at)?,
            });
        };
        self.report.err(
            second.span(),
            "lab::contact_impulse",
            format!(
                "no contact of `{}` and `{}` can be: {why}",
                first.get_ref(),
                second.get_ref()
            ),
            "this one with the other",
            Some("name the arm and a body, or a free body and another".to_owned()),
        )
    }

    /// `arm`, `ground`, a link of the robot, or a body of the scene.
    fn party(&self, scene: &LabScene, name: &Spanned<String>) -> Result<TouchingParty, LabError> {
        let wanted = name.get_ref().as_str();
        let links = self.robot.links().iter().map(|link| link.name.as_str());
        let bodies = scene.scene.bodies.iter().map(|body| body.name.as_str());
        if wanted == "arm" {
            return Ok(TouchingParty::Arm);
        }
        if wanted == "ground" {
            if scene.scene.environment.ground.is_some() {
                return Ok(TouchingParty::Ground);
            }
            return self.report.err(
                name.span(),
                "lab::unknown_party",
                format!("scene `{}` has no ground", scene.name),
                "not in this scene",
                Some("give the scene a `ground` in [environment]".to_owned()),
            );
        }
        if let Some(index) = links.clone().position(|link| link == wanted) {
            return Ok(TouchingParty::Link(index));
        }
        if let Some(index) = bodies.clone().position(|body| body == wanted) {
            return Ok(TouchingParty::Body(index));
        }
        let known = ["arm", "ground"].into_iter().chain(links).chain(bodies);
        self.report.err(
            name.span(),
            "lab::unknown_party",
            format!(
                "`{wanted}` is neither a link of robot `{}` nor a body of scene `{}`",
                self.robot.name(),
                scene.name
            ),
            "nothing that could touch",
            Some(suggest(wanted, "links and bodies", known)),
        )
    }

    pub(super) fn tcp_speed(
        &self,
        table: &Spanned<TcpSpeedTable>,
        work: &TaskWork,
    ) -> Result<CheckKind, LabError> {
        let span = table.span();
        let table = table.get_ref();
        let at = match (table.at, &table.body) {
            (SpeedAtName::Run, None) => SpeedAt::Run,
            (SpeedAtName::Run, Some(body)) => {
                return self.report.err(
                    body.span(),
                    "lab::tcp_speed",
                    "`body` has no meaning over the whole run".to_owned(),
                    "not looked at",
                    Some("remove it, or write `at = \"touch\"`".to_owned()),
                );
            }
            (SpeedAtName::Touch, Some(body)) => {
                let scene = self.scene_of(work, "tcp-speed", span.clone())?;
                SpeedAt::Touch(self.body(scene, body)?)
            }
            (SpeedAtName::Touch, None) => {
                return self.report.err(
                    span,
                    "lab::tcp_speed",
                    "a speed at a touch needs the `body` that is touched".to_owned(),
                    "`body` is missing",
                    Some("add it, such as `body = \"can\"`".to_owned()),
                );
            }
        };
        Ok(CheckKind::TcpSpeed {
            at,
            band: self.band(table.full_m_s, table.zero_m_s, span)?,
        })
    }
}
