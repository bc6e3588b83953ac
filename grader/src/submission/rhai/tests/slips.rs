//! The corpus of slips: files as students really type them, and what they read about each.

use serde::Deserialize;

use super::{numbers, observation, opening};
use crate::record::grade::FurtherMistake;
use crate::submission::controller::{Call, Controller as _, Mistake, Stop, Value};
use crate::submission::rhai::ScriptController;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Corpus {
    slips: Vec<Slip>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Slip {
    name: String,
    #[serde(default)]
    target: Target,
    source: String,
    says: String,
}

#[derive(Deserialize, Default)]
#[serde(rename_all = "lowercase")]
enum Target {
    #[default]
    List,
    Map,
}

/// What stops a file: its place, the message, the help.
fn says(slip: &Slip) -> String {
    let mut opening = opening(&slip.source);
    opening.target = match slip.target {
        Target::List => Value::List(vec![numbers([2.0, 1.4, 0.0]), numbers([2.0, -1.4, 0.0])]),
        Target::Map => Value::Map(vec![
            ("kp".to_owned(), Value::Number(100.0)),
            ("points".to_owned(), numbers([2.0, 1.4])),
        ]),
    };
    let ran = ScriptController::open(&opening).and_then(|mut script| {
        script.call(&Call::Init)?;
        script.call(&Call::Control(observation()))
    });
    let mistake = match ran {
        Ok(answer) => return format!("it runs: {answer:?}"),
        Err(Stop::DidNotBuild(mistake) | Stop::Crashed(mistake)) => mistake,
        Err(Stop::OverBudget { budget, place, .. }) => Mistake {
            message: budget.name().to_owned(),
            place,
            help: None,
            further: Vec::new(),
        },
        Err(other) => return format!("{other:?}"),
    };
    let place = mistake
        .place
        .map(|place| format!("{}:{} ", place.line, place.column));
    let help = mistake.help.map(|help| format!(" | {help}"));
    let further: Vec<String> = mistake.further.iter().map(FurtherMistake::words).collect();
    let further = match &further[..] {
        [] => String::new(),
        further => format!(" || {}", further.join("; ")),
    };
    format!(
        "{}{}{}{further}",
        place.unwrap_or_default(),
        mistake.message,
        help.unwrap_or_default()
    )
}

#[test]
fn every_slip_is_named_at_its_place_with_a_way_out() {
    let corpus: Corpus = toml::from_str(include_str!("slips.toml")).expect("the corpus");
    let wrong: Vec<String> = corpus
        .slips
        .iter()
        .map(|slip| (slip, says(slip)))
        .filter(|(slip, says)| slip.says != *says)
        .map(|(slip, says)| format!("{}\n  says  {says}\n  and not {}", slip.name, slip.says))
        .collect();
    assert!(wrong.is_empty(), "\n{}", wrong.join("\n"));
}
