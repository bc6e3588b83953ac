//! contact-impulse: how hard and how long two pressed on each other, all contacts together \[N s\].
//!
//! Measured is the sum of the normal impulses of all contacts of the two, `Σ ∫ F dt`. Two that could touch but never did
//! have 0, and two that can never touch are refused. An arm that stays where it is touches nothing, so let this check need another.

use kinemark_sim::model::scene::BodyKind;
use kinemark_sim::watch::ContactSpan;
use toml::Spanned;

use crate::check::prelude::*;
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

/// The keys.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct Table {
    /// The two: `arm` (any link of the robot), a link, a body of the scene, or `ground`.
    between: [At<String>; 2],
    /// Impulse that earns all points \[N s\].
    full_n_s: BandEnd,
    /// Impulse that earns none \[N s\].
    zero_n_s: BandEnd,
}

impl MotionTable for Table {
    const NAME: &'static str = "contact-impulse";
    type Check = InBand<ContactImpulse>;

    fn read(&self, reading: &MotionReading<'_>) -> Result<Self::Check, LabError> {
        let scene = reading.scene(Self::NAME)?;
        let [first, second] = &self.between;
        let between = [
            party(reading, scene, first)?,
            party(reading, scene, second)?,
        ];
        if let Some(why) = never_press(between, scene) {
            let problem = PartyProblem::NeverPress {
                first: first.get_ref().clone(),
                second: second.get_ref().clone(),
                why,
            };
            return reading.refuse_at(second, problem);
        }
        reading.in_band(
            [self.full_n_s, self.zero_n_s],
            "N s",
            ContactImpulse(between),
        )
    }
}

/// The impulse between these two.
#[derive(Debug)]
pub(crate) struct ContactImpulse([TouchingParty; 2]);

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

impl RunMeasure for ContactImpulse {
    fn judge(&self, facts: &MotionFacts<'_>, band: Band) -> Finding {
        let found = touches(&facts.trace.contacts, self.0);
        let value = found.map_or(0.0, |touches| touches.impulse_n_s);
        let [a, b] = self.0.map(|party| party.in_sentence(&facts.names));
        let quantity = format!("impulse between {a} and {b}");
        let mut curve = facts.curve(
            "impulse so far, each contact's at its peak",
            "N s",
            self.so_far(facts),
            band,
        );
        let mut finding = Finding::against(band, value, "N s", quantity);
        if let Some(touches) = found {
            let first = touches.first.first_tick as usize;
            curve.marks = vec![(facts.time_s(first), "first touch".to_owned())];
            finding = finding.shown_at(facts, || {
                (message(facts, &touches), "contacts".to_owned(), first)
            });
        }
        finding
            .advise(format!("Leave more room between {a} and {b} on the way."))
            .drawn(curve)
    }
}

fn message(facts: &MotionFacts<'_>, touches: &Touches<'_>) -> String {
    let [a, b] = touches.first.parties.map(|party| facts.names.party(party));
    let contacts = match touches.count {
        1 => "in this contact".to_owned(),
        count => format!("in {count} contacts"),
    };
    let first = (touches.first.first_tick as usize).min(facts.last_tick());
    format!(
        "`{a}` first touched `{b}` at {}, with the hand at {}; {contacts} the impulse is {} N s, and the force {} N at its peak, at {}",
        seconds(facts.motion.periods.time_s(touches.first.first_tick)),
        list(facts.trace.tcp_position(first).as_slice()),
        trimmed(touches.impulse_n_s, 3),
        trimmed(touches.hardest.peak_force_n, 1),
        seconds(facts.motion.periods.time_s(touches.hardest.peak_tick)),
    )
}

impl ContactImpulse {
    /// The impulse so far, each contact's added where its force is at its peak: what went before and after is not in a trace.
    fn so_far(&self, facts: &MotionFacts<'_>) -> Vec<f64> {
        let ticks = facts.trace.len();
        let mut values = vec![0.0; ticks];
        let [one, other] = self.0;
        let contacts = facts.trace.contacts.iter();
        for span in contacts.filter(|span| one.meets(other, span.parties)) {
            let from = (span.peak_tick as usize).min(ticks);
            for value in &mut values[from..] {
                *value += span.impulse_n_s;
            }
        }
        values
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
