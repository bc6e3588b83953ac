//! contact-impulse: how hard and how long two pressed on each other, all contacts together \[N s\].
//!
//! Measured is the sum of the normal impulses of all contacts of the two, `Σ ∫ F dt`. Two that never met have 0: an arm that stays
//! where it is touches nothing, so let this check need another.

use std::ops::Range;

use kinemark_sim::model::robot::Robot;
use kinemark_sim::model::scene::BodyKind;
use kinemark_sim::text::number::{seconds, trimmed};
use kinemark_sim::text::{Problem, suggest};
use kinemark_sim::watch::ContactSpan;
use schemars::JsonSchema;
use serde::Deserialize;
use toml::Spanned;

use crate::check::contract::{CheckKind, FirstLoss, MotionCheck};
use crate::check::facts::MotionFacts;
use crate::check::finding::Finding;
use crate::check::reading::InTask;
use crate::check::registry::MotionTable;
use crate::record::graded::Curve;
use crate::task::model::Band;
use crate::task::problem::LabError;
use crate::task::scene::LabScene;
use crate::task::watched::TouchingParty;

/// Two that cannot press on each other, or a name of neither.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
enum NoContact {
    #[error("no contact of `{first}` and `{second}` can be: {why}")]
    Never {
        first: String,
        second: String,
        why: &'static str,
    },
    #[error("scene `{scene}` has no ground")]
    NoGround { scene: String },
    #[error("`{name}` is neither a link of robot `{robot}` nor a body of scene `{scene}`")]
    Unknown {
        name: String,
        robot: String,
        scene: String,
        known: Vec<String>,
    },
}

impl Problem for NoContact {
    fn code(&self) -> &'static str {
        match self {
            Self::Never { .. } => "lab::contact_impulse",
            Self::NoGround { .. } | Self::Unknown { .. } => "lab::unknown_party",
        }
    }

    fn label(&self) -> String {
        match self {
            Self::Never { .. } => "this one with the other",
            Self::NoGround { .. } => "not in this scene",
            Self::Unknown { .. } => "nothing that could touch",
        }
        .to_owned()
    }

    fn help(&self) -> Option<String> {
        Some(match self {
            Self::Never { .. } => "name the arm and a body, or a free body and another".to_owned(),
            Self::NoGround { .. } => "give the scene a `ground` in [environment]".to_owned(),
            Self::Unknown { name, known, .. } => {
                suggest(name, "links and bodies", known.iter().map(String::as_str))
            }
        })
    }
}

/// The keys.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct Table {
    /// The two: `arm` (any link of the robot), a link, a body of the scene, or `ground`.
    #[schemars(with = "[String; 2]")]
    between: [Spanned<String>; 2],
    /// Impulse that earns all points \[N s\].
    full_n_s: f64,
    /// Impulse that earns none \[N s\].
    zero_n_s: f64,
}

impl MotionTable for Table {
    const NAME: &'static str = "contact-impulse";
    type Check = ContactImpulse;

    fn read(&self, at: Range<usize>, reading: &InTask<'_>) -> Result<ContactImpulse, LabError> {
        let scene = reading.scene(Self::NAME, at.clone())?;
        let [first, second] = &self.between;
        let between = [
            party(reading, scene, first)?,
            party(reading, scene, second)?,
        ];
        if let Some(why) = never_press(between, scene) {
            let problem = NoContact::Never {
                first: first.get_ref().clone(),
                second: second.get_ref().clone(),
                why,
            };
            return reading.report.refuse(second.span(), problem);
        }
        Ok(ContactImpulse {
            between,
            band: reading.report.band(self.full_n_s, self.zero_n_s, at)?,
        })
    }
}

/// The check as read.
#[derive(Debug)]
pub(crate) struct ContactImpulse {
    between: [TouchingParty; 2],
    band: Band,
}

impl CheckKind for ContactImpulse {
    fn band(&self, _: &Robot) -> Option<(Band, &'static str)> {
        Some((self.band, "N s"))
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
    reading: &InTask<'_>,
    scene: &LabScene,
    name: &Spanned<String>,
) -> Result<TouchingParty, LabError> {
    let wanted = name.get_ref().as_str();
    let refuse = |problem| reading.report.refuse(name.span(), problem);
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
        return refuse(NoContact::NoGround { scene });
    }
    if let Some(index) = links.clone().position(|link| link == wanted) {
        return Ok(TouchingParty::Link(index));
    }
    if let Some(index) = bodies.clone().position(|body| body == wanted) {
        return Ok(TouchingParty::Body(index));
    }
    let known = ["arm", "ground"].into_iter().chain(links).chain(bodies);
    refuse(NoContact::Unknown {
        name: wanted.to_owned(),
        robot: reading.robot.name().to_owned(),
        scene: scene.name.clone(),
        known: known.map(str::to_owned).collect(),
    })
}

/// All contacts of two, together.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Touches<'a> {
    count: usize,
    impulse_n_s: f64,
    first: &'a ContactSpan,
    hardest: &'a ContactSpan,
}

fn touches(contacts: &[ContactSpan], between: [TouchingParty; 2]) -> Option<Touches<'_>> {
    let mut all: Option<Touches<'_>> = None;
    for span in contacts {
        if !between[0].meets(between[1], span.parties) {
            continue;
        }
        let so_far = all.get_or_insert(Touches {
            count: 0,
            impulse_n_s: 0.0,
            first: span,
            hardest: span,
        });
        so_far.count += 1;
        so_far.impulse_n_s += span.impulse_n_s;
        if span.first_tick < so_far.first.first_tick {
            so_far.first = span;
        }
        if span.peak_force_n > so_far.hardest.peak_force_n {
            so_far.hardest = span;
        }
    }
    all
}

impl MotionCheck for ContactImpulse {
    fn judge(&self, facts: &MotionFacts<'_>) -> Finding {
        let found = touches(&facts.trace.contacts, self.between);
        let value = found.map_or(0.0, |touches| touches.impulse_n_s);
        let [a, b] = self.between.map(|party| party.told(&facts.names));
        let quantity = format!("impulse between {a} and {b}");
        let mut finding = Finding::against(self.band, value, "N s", quantity);
        if let Some(touches) = found {
            finding = finding.shown_at(facts, || {
                let message = message(facts, &touches);
                let first = touches.first.first_tick as usize;
                (message, "contacts".to_owned(), first)
            });
        }
        finding
            .advise(format!("Leave more room between {a} and {b} on the way."))
            .drawn(self.curve(facts))
    }

    fn first_loss(&self) -> FirstLoss {
        FirstLoss::Evidence
    }
}

fn message(facts: &MotionFacts<'_>, touches: &Touches<'_>) -> String {
    let [a, b] = touches.first.parties.map(|party| facts.names.party(party));
    let contacts = match touches.count {
        1 => "in this contact".to_owned(),
        count => format!("in {count} contacts"),
    };
    format!(
        "`{a}` first touched `{b}` at {}; {contacts} the impulse is {} N s, and the force {} N at its peak, at {}",
        seconds(facts.motion.periods.time_s(touches.first.first_tick)),
        trimmed(touches.impulse_n_s, 3),
        trimmed(touches.hardest.peak_force_n, 1),
        seconds(facts.motion.periods.time_s(touches.hardest.peak_tick)),
    )
}

impl ContactImpulse {
    /// The impulse so far, each contact's added where its force is at its peak: what went before and after is not in a trace.
    fn curve(&self, facts: &MotionFacts<'_>) -> Curve {
        let ticks = facts.trace.len();
        let mut values = vec![0.0; ticks];
        let contacts = facts.trace.contacts.iter();
        let [one, other] = self.between;
        for span in contacts.filter(|span| one.meets(other, span.parties)) {
            let from = (span.peak_tick as usize).min(ticks);
            for value in &mut values[from..] {
                *value += span.impulse_n_s;
            }
        }
        let found = touches(&facts.trace.contacts, self.between);
        let marks = found.map(|touches| {
            let at = facts.motion.periods.time_s(touches.first.first_tick);
            (at, "first touch".to_owned())
        });
        let title = "impulse so far, each contact's at its peak";
        Curve {
            marks: marks.into_iter().collect(),
            ..facts.curve(title, "N s", values, self.band)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use kinemark_sim::model::contact::Party;
    use nalgebra::Vector3;

    fn span(parties: [Party; 2], first_tick: u64, impulse_n_s: f64, peak_n: f64) -> ContactSpan {
        ContactSpan {
            parties,
            first_tick,
            last_tick: first_tick + 9,
            peak_force_n: peak_n,
            peak_tick: first_tick + 4,
            impulse_n_s,
            depth_m: 0.0,
            p_first_in_world: Vector3::zeros(),
        }
    }

    #[test]
    fn contacts_of_the_two_add_up_and_others_do_not_count() {
        let (shelf, can) = (Party::Body(0), Party::Body(1));
        let contacts = [
            span([shelf, can], 1, 9.0, 4.0),
            span([Party::Link(2), shelf], 50, 0.25, 30.0),
            span([Party::Link(2), can], 60, 0.75, 5.0),
            span([Party::Link(1), shelf], 40, 0.125, 20.0),
            span([Party::Link(2), Party::Ground], 70, 0.5, 1.0),
        ];
        let arm_and = |other| touches(&contacts, [TouchingParty::Arm, other]);
        let of_shelf = arm_and(TouchingParty::Body(0)).expect("two contacts");
        assert_eq!((of_shelf.count, of_shelf.impulse_n_s), (2, 0.375));
        assert_eq!(of_shelf.first.first_tick, 40);
        assert_eq!(of_shelf.hardest.peak_tick, 54);
        let of_ground = arm_and(TouchingParty::Ground).expect("one contact");
        assert_eq!(of_ground.impulse_n_s, 0.5);
        // the order in which the lab names them says nothing
        for between in [
            [TouchingParty::Body(1), TouchingParty::Body(0)],
            [TouchingParty::Body(0), TouchingParty::Body(1)],
        ] {
            let found = touches(&contacts, between).expect("shelf and can");
            assert_eq!(found.impulse_n_s, 9.0);
        }
        let link = TouchingParty::Link(1);
        let found = touches(&contacts, [TouchingParty::Body(0), link]).expect("one");
        assert_eq!(found.impulse_n_s, 0.125);
        assert!(arm_and(TouchingParty::Body(7)).is_none());
    }
}
