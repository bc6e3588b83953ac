//! Two that a check names because they may touch: the arm, a link, a body of the scene, the ground.

use kinemark_sim::model::scene::BodyKind;
use kinemark_sim::text::Spanned;

use super::reading::{At, MotionReading};
use crate::task::problem::{LabError, near, problems};
use crate::task::scene::LabScene;
use crate::task::watched::TouchingParty;

problems! {
    /// Two that cannot press on each other, or a name of neither.
    enum PartyProblem {
        NeverPress { first: String, second: String, why: &'static str }:
            "lab::contact_impulse", "no contact of `{first}` and `{second}` can be: {why}", "this one with the other",
            "name the arm and a body, or a dynamic body and another";
        NoGround { scene: String }:
            "lab::unknown_party", "scene `{scene}` has no ground", "not in this scene",
            "give the scene a `ground` in [environment]";
        Unknown { name: String, robot: String, scene: String, known: Vec<String> }:
            "lab::unknown_party", "`{name}` is neither a link of robot `{robot}` nor a body of scene `{scene}`",
            "nothing that could touch", near(name, "links and bodies", known);
    }
}

/// The two of these names, which could press on each other, for a check of `kind`.
pub(super) fn two_that_touch(
    reading: &MotionReading<'_>,
    kind: &'static str,
    [first, second]: &[At<String>; 2],
) -> Result<[TouchingParty; 2], LabError> {
    let scene = reading.scene(kind)?;
    let between = [
        party(reading, scene, first)?,
        party(reading, scene, second)?,
    ];
    match never_press(between, scene) {
        None => Ok(between),
        Some(why) => {
            let problem = PartyProblem::NeverPress {
                first: first.get_ref().clone(),
                second: second.get_ref().clone(),
                why,
            };
            reading.refuse_at(second, problem)
        }
    }
}

/// Why two never press on each other, if they do not.
fn never_press(between: [TouchingParty; 2], scene: &LabScene) -> Option<&'static str> {
    let gives_way = |party: TouchingParty| match party {
        TouchingParty::Arm | TouchingParty::Link(_) => true,
        TouchingParty::Body(index) => {
            matches!(scene.scene.bodies[index].kind, BodyKind::Free)
        }
        TouchingParty::Ground => false,
    };
    let is_link =
        |party: &TouchingParty| matches!(party, TouchingParty::Arm | TouchingParty::Link(_));
    if between.iter().all(is_link) {
        Some("links of one robot do not touch each other")
    } else if between[0] == between[1] {
        Some("nothing touches itself")
    } else if !between.into_iter().any(gives_way) {
        Some("neither of them gives way, so they never press on each other")
    } else {
        None
    }
}

/// `arm`, `ground`, a link of the robot, or a body of the scene.
fn party(
    reading: &MotionReading<'_>,
    scene: &LabScene,
    name: &Spanned<String>,
) -> Result<TouchingParty, LabError> {
    let wanted = name.get_ref().as_str();
    let links = reading.robot.links().iter().map(|link| link.name.as_str());
    let bodies = scene.scene.bodies.iter().map(|body| body.name.as_str());
    if wanted == "arm" {
        return Ok(TouchingParty::Arm);
    }
    if wanted == "ground" {
        if scene.scene.environment.ground.is_some() {
            return Ok(TouchingParty::Ground);
        }
        let scene = scene.name.clone();
        return reading.refuse_at(name, PartyProblem::NoGround { scene });
    }
    if let Some(index) = links.clone().position(|link| link == wanted) {
        return Ok(TouchingParty::Link(index));
    }
    if let Some(index) = bodies.clone().position(|body| body == wanted) {
        return Ok(TouchingParty::Body(index));
    }
    let known = ["arm", "ground"].into_iter().chain(links).chain(bodies);
    let problem = PartyProblem::Unknown {
        name: wanted.to_owned(),
        robot: reading.robot.name().to_owned(),
        scene: scene.name.clone(),
        known: known.map(str::to_owned).collect(),
    };
    reading.refuse_at(name, problem)
}
