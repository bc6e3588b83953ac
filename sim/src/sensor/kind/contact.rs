//! contact: sum of the normal forces on a link over everything that presses on it, their mean over the last step, N.

use schemars::JsonSchema;
use serde::Deserialize;

use crate::model::contact::Party;
use crate::model::robot::Robot;
use crate::model::sensor::{Gauge, Seen, SensorKind, Surroundings};
use crate::part::part_problem::PartError;
use crate::part::toml_text::quoted;
use crate::sensor::registry::{KindTable, SensorReading};
use crate::text::Spanned;

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct Table {
    /// The link that is pressed.
    link: Spanned<String>,
}

impl KindTable for Table {
    const NAME: &'static str = "contact";
    #[cfg(test)]
    const EXAMPLE: &'static str = "link = 'forearm'";
    type Kind = Contact;

    fn read(&self, reading: &SensorReading<'_>) -> Result<Contact, PartError> {
        let links = reading.robot.links().iter().map(|link| link.name.as_str());
        let link = reading.values.index("link", &self.link, links)?;
        Ok(Contact { link })
    }
}

#[derive(Debug, Clone, Copy)]
pub(super) struct Contact {
    /// Index among all links.
    link: usize,
}

impl SensorKind for Contact {
    fn unit(&self, _: &Robot, _: usize) -> &'static str {
        "N"
    }

    fn keys(&self, robot: &Robot) -> String {
        format!("link = {}\n", quoted(&robot.links()[self.link].name))
    }

    fn gauge(&self, _: &Robot, _: f64) -> Box<dyn Gauge> {
        Box::new(*self)
    }
}

impl Gauge for Contact {
    fn read(&mut self, seen: &Seen<'_>, _: &dyn Surroundings, values: &mut [f64]) {
        let here = Party::Link(self.link);
        let facts = seen.contacts.iter();
        let facts = facts.filter(|fact| fact.parties.contains(&here));
        values[0] = facts.map(|fact| fact.force_n).sum();
    }
}
