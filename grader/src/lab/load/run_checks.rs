//! Checks of what a run did in a scene, and of paths: names become indices, paths are long enough for what is cut off them.

use std::ops::Range;
use std::sync::Arc;

use kinemark_sim::event::SeenSide;
use kinemark_sim::scene::BodyKind;
use kinemark_sim::source::suggest;
use nalgebra::Vector3;
use toml::Spanned;

use super::Reader;
use crate::lab::file::{
    BodyFallsTable, ContactImpulseTable, NumberAt, PathCoverageTable, PathDeviationTable, SideName,
    SpeedAtName, TcpSpeedTable,
};
use crate::lab::model::{CheckKind, TaskWork};
use crate::lab::problem::LabError;
use crate::lab::scene::LabScene;
use crate::lab::watched::{Fall, PathToFollow, Shares, SpeedAt, TouchingParty};

/// More points than any path of a lab has: each costs memory for every tick.
const MOST_POINTS: usize = 100;

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

    pub(super) fn path_deviation(
        &self,
        table: &Spanned<PathDeviationTable>,
    ) -> Result<CheckKind, LabError> {
        let at = table.span();
        let table = table.get_ref();
        Ok(CheckKind::PathDeviation {
            path: self.path(&table.points_m, &table.trim_m)?,
            band: self.band(table.full_m, table.zero_m, at)?,
        })
    }

    pub(super) fn path_coverage(
        &self,
        table: &Spanned<PathCoverageTable>,
    ) -> Result<CheckKind, LabError> {
        let at = table.span();
        let table = table.get_ref();
        let (full, zero) = (table.full, table.zero);
        // here more is better, unlike in other bands
        if !(0.0 <= zero && zero <= full && full <= 1.0 && full > 0.0) {
            return self.report.err(
                at,
                "lab::band",
                format!("a coverage needs 0 <= zero <= full <= 1 and `full` above 0, got full = {full} and zero = {zero}"),
                "this band",
                Some("such as `full = 0.98, zero = 0.5`".to_owned()),
            );
        }
        Ok(CheckKind::PathCoverage {
            path: self.path(&table.points_m, &table.trim_m)?,
            within_m: self.positive(&table.within_m, "`within_m`")?,
            shares: Shares { full, zero },
        })
    }

    fn path(
        &self,
        points: &Spanned<Vec<[f64; 3]>>,
        trim: &NumberAt,
    ) -> Result<PathToFollow, LabError> {
        let points_m: Vec<Vector3<f64>> = points.get_ref().iter().map(|p| (*p).into()).collect();
        let refuse = |message: String| {
            self.report.err(
                points.span(),
                "lab::path",
                message,
                "this path",
                Some("give points in the lab's frame [m], as [x, y, z]".to_owned()),
            )
        };
        if !(2..=MOST_POINTS).contains(&points_m.len()) {
            let count = points_m.len();
            return refuse(format!("a path has 2 to {MOST_POINTS} points, got {count}"));
        }
        if let Some(at) = points_m
            .iter()
            .position(|p| !p.iter().all(|x| x.abs() <= 1e6))
        {
            return refuse(format!("point {} of the path is not within 1e6 m", at + 1));
        }
        let trim_m = self.positive(trim, "`trim_m`")?;
        let lengths = points_m.windows(2).map(|ends| (ends[1] - ends[0]).norm());
        for (i, length_m) in lengths.enumerate() {
            if 2.0 * trim_m >= length_m {
                return self.report.err(
                    trim.span(),
                    "lab::path",
                    format!(
                        "segment {} of the path is {length_m} m long: nothing is left of it with {trim_m} m cut off each end",
                        i + 1
                    ),
                    "too much is cut off",
                    Some("cut off less, or leave out one of two points that are as near".to_owned()),
                );
            }
        }
        Ok(PathToFollow { points_m, trim_m })
    }
}
