//! Messages about unknown names: the nearest known name, and where it is defined.

use std::collections::{BTreeMap, BTreeSet};

use kinemark_sim::text::LONGEST_TYPO;

use super::foreign;
use super::places::Places;
use super::unknown::Unknown;
use crate::submission::controller::{ENTRY_POINTS, Grant, SourcePosition};

/// All names of one submission.
#[derive(Debug, Default)]
pub(super) struct Names {
    /// Built-in functions, with their numbers of parameters.
    pub(super) built_in: BTreeMap<String, BTreeSet<usize>>,
    /// The file's functions, with their parameters.
    pub(super) functions: Vec<(String, Vec<String>)>,
    /// Constants, built-in and of the file.
    pub(super) constants: BTreeSet<String>,
    /// Variables that the file declares outside of its functions.
    pub(super) top_level: BTreeSet<String>,
    /// Variables and parameters inside of functions.
    pub(super) local: BTreeSet<String>,
    /// Keys of `observation`.
    pub(super) observation: BTreeSet<String>,
    /// Keys of `robot`.
    pub(super) robot: BTreeSet<String>,
    /// Names of the parameters that hold the observation.
    pub(super) observation_parameters: BTreeSet<String>,
    /// Keys of `observation.target`, if it is a map.
    pub(super) target: BTreeSet<String>,
    /// Keys of `observation.sensors`.
    pub(super) sensors: BTreeSet<String>,
    /// Names of the parameters that hold the robot.
    pub(super) robot_parameters: BTreeSet<String>,
    /// Keys of the input of the lab's own function.
    pub(super) given: BTreeSet<String>,
    /// Where functions, loops and declarations are.
    pub(super) places: Places,
    /// Names that the file uses and nobody declares.
    pub(super) unknown: Vec<Unknown>,
    /// Names of the parameters that hold this input.
    pub(super) given_parameters: BTreeSet<String>,
}

type Words = (String, Option<String>);

impl Names {
    pub(super) fn unknown_function(&self, name: &str, arguments: &[&str]) -> Words {
        let given = match arguments.len() {
            0 => "none".to_owned(),
            count => count.to_string(),
        };
        let may_be_granted = Grant::ALL.iter().any(|grant| grant.name() == name);
        let of_a_map = may_be_granted && arguments.first() == Some(&"map");
        if let Some((_, parameters)) = self.functions.iter().find(|(known, _)| known == name) {
            if of_a_map && parameters.len() == arguments.len() && !self.built_in.contains_key(name)
            {
                return (
                    format!("`robot.{name}` is not granted in this task"),
                    Some(format!(
                        "call your own: {name}({}), and do not ask `robot` inside it",
                        parameters.join(", ")
                    )),
                );
            }
            return (
                format!(
                    "`{name}` takes {} ({}), got {given}",
                    arguments_words(parameters.len()),
                    parameters.join(", ")
                ),
                None,
            );
        }
        if let Some(counts) = self.built_in.get(name) {
            let counts: Vec<String> = counts.iter().map(ToString::to_string).collect();
            let noun = if counts == ["1"] {
                "argument"
            } else {
                "arguments"
            };
            return (
                format!("`{name}` takes {} {noun}, got {given}", counts.join(" or ")),
                None,
            );
        }
        if of_a_map {
            return (
                format!("`robot.{name}` is not granted in this task"),
                Some("write it yourself: the dimensions are in `robot`; if this line is for another task, `observation.task` is compared with another name".to_owned()),
            );
        }
        let message = format!("`{name}` is not a function");
        if let Some(help) = foreign::function(name) {
            return (message, Some(help));
        }
        let known = self
            .functions
            .iter()
            .map(|(name, _)| name.as_str())
            .chain(self.built_in.keys().map(String::as_str));
        match nearest(name, known.clone()).or_else(|| abbreviation(name, known)) {
            Some(near) => (format!("{message}: did you mean `{near}`?"), None),
            None => {
                let values = [&self.observation, &self.robot, &self.local, &self.given];
                let is_value = values.iter().any(|names| names.contains(name));
                let help = format!("elements are in square brackets: {name}[0] is the first");
                (message, is_value.then_some(help))
            }
        }
    }

    /// How a function gets at a value that the grader gives to another one; `None` if it gives no such value.
    fn given_elsewhere(&self, name: &str, place: Option<SourcePosition>) -> Option<String> {
        let (function, _) = self.places.around(place?)?;
        let gives = |entry: &str| {
            let mut entries = ENTRY_POINTS.iter();
            let found = entries.find(|(known, _)| *known == entry);
            found.is_some_and(|(_, parameters)| parameters.contains(&name))
        };
        match function {
            "control" if gives("init") => Some(format!(
                "only `init` is given it: write this.{name} = {name}; there, and this.{name} here"
            )),
            "init" if gives("control") => Some(format!("only `control` is given `{name}`")),
            function if ENTRY_POINTS.iter().any(|(entry, _)| *entry == function) => None,
            function if gives("init") || gives("control") => {
                Some(format!("pass it to `{function}` as an argument"))
            }
            _ => None,
        }
    }

    /// The words for a map that is indexed as if it were a list; `None` if nobody knows its keys.
    pub(super) fn indexed_map(&self, owner: &str) -> Option<Words> {
        let keys = self.keys_of(owner)?;
        let first = keys.iter().next()?;
        let all: Vec<&str> = keys.iter().map(String::as_str).collect();
        Some((
            format!("`{owner}` is a map here, and has no elements by number"),
            Some(format!("it has {}: write {owner}.{first}", all.join(", "))),
        ))
    }

    /// The keys of a map that the grader gives, by the name it goes by.
    fn keys_of(&self, owner: &str) -> Option<&BTreeSet<String>> {
        let keys = if owner == "observation" || self.observation_parameters.contains(owner) {
            &self.observation
        } else if owner == "target" && !self.target.is_empty() {
            &self.target
        } else if owner == "sensors" && !self.sensors.is_empty() {
            &self.sensors
        } else if self.given_parameters.contains(owner) {
            &self.given
        } else if owner == "robot" || self.robot_parameters.contains(owner) {
            &self.robot
        } else {
            return None;
        };
        Some(keys)
    }

    /// The message for a variable that is not known; `is_set` where it stands on the left of `=`.
    pub(super) fn unknown_variable(
        &self,
        name: &str,
        place: Option<SourcePosition>,
        is_set: bool,
    ) -> Words {
        let message = format!("variable `{name}` is not known here");
        if let Some(help) = foreign::variable(name) {
            return (message, Some(help));
        }
        if let Some(help) = self.given_elsewhere(name, place) {
            return (message, Some(help));
        }
        if place.is_some_and(|place| self.places.is_declared_before(name, place)) {
            let help = format!(
                "`{name}` ends with the block in which it is declared: write let {name} = 0; before that block, and {name} = ...; without `let` inside it"
            );
            return (message, Some(help));
        }
        if self.top_level.contains(name) {
            return (
                message,
                Some(format!(
                    "a `let` outside of a function is not seen inside: write const {name} = ..., or keep it in `this`"
                )),
            );
        }
        if self.is_function(name) {
            return (
                format!("`{name}` is a function"),
                Some(format!("call it: {name}(...)")),
            );
        }
        if is_set {
            let around = place.and_then(|place| self.places.around(place));
            let help = match around.map(|(function, _)| function) {
                None => format!("outside of functions write const {name} = ...;"),
                Some("init") => {
                    format!("write this.{name} = ...; what `let` declares is gone when `init` ends")
                }
                Some("control") => format!(
                    "declare it first: let {name} = ...; it lasts for this call. What the next call should still know is this.{name}, first set in `init`"
                ),
                _ => format!("declare it first: let {name} = ...;"),
            };
            return (message, Some(help));
        }
        if self.observation.contains(name) {
            return (message, Some(format!("write observation.{name}")));
        }
        if self.robot.contains(name) {
            return (message, Some(format!("write robot.{name}")));
        }
        let known = self
            .local
            .iter()
            .chain(&self.top_level)
            .chain(&self.constants);
        match nearest(name, known.map(String::as_str)) {
            Some(near) => (format!("{message}: did you mean `{near}`?"), None),
            None => (
                message,
                Some(format!("declare it first: let {name} = ...;")),
            ),
        }
    }

    /// The message for a key that the map `owner` at a place does not have.
    pub(super) fn unknown_key(
        &self,
        owner: Option<&str>,
        key: &str,
        place: Option<SourcePosition>,
    ) -> Words {
        let function = place.and_then(|place| self.places.around(place));
        let has_this = function.is_none_or(|(name, _)| matches!(name, "init" | "control"));
        if owner == Some("this") && !has_this {
            return (
                format!("`this.{key}` is not known in this function"),
                Some(
                    "only `init` and `control` have `this`: take what is given as an argument, such as `robot`"
                        .to_owned(),
                ),
            );
        }
        if owner == Some("this") {
            return (
                format!("`this.{key}` is not set yet"),
                Some("set it in init(robot, task)".to_owned()),
            );
        }
        let Some(keys) = owner.and_then(|owner| self.keys_of(owner)) else {
            let both = self.observation.iter().chain(&self.robot);
            let message = match owner {
                Some(owner) => format!("`{owner}` has no `{key}`"),
                None => format!("the map has no `{key}`"),
            };
            let both = both.chain(&self.target).chain(&self.sensors);
            return match nearest(key, both.map(String::as_str)) {
                Some(near) => (format!("{message}: did you mean `{near}`?"), None),
                None if self.target.is_empty() => (
                    message,
                    Some("get(map, key, otherwise) asks without failing".to_owned()),
                ),
                None => {
                    let keys: Vec<&str> = self.target.iter().map(String::as_str).collect();
                    let help = format!("`observation.target` has {} in this task", keys.join(", "));
                    (message, Some(help))
                }
            };
        };
        let owner = owner.unwrap_or("it");
        let message = format!("`{owner}` has no `{key}`");
        if keys.contains(key) && !std::ptr::eq(keys, &raw const self.robot) {
            return (
                message,
                Some(format!(
                    "this `{owner}` is a map of your own: print({owner}) shows what it has"
                )),
            );
        }
        if keys.contains(key) {
            // that of the lab has it, and this is that of a case
            return (
                format!("{message} in this case"),
                Some(format!(
                    "the robot of this case is another one: print({owner}) shows what it has"
                )),
            );
        }
        let mut help = format!(
            "it has {}",
            keys.iter().cloned().collect::<Vec<_>>().join(", ")
        );
        if owner == "target" || self.target == *keys {
            help += " in this task; if this line is for another one, `observation.task` is compared with another name";
        }
        match nearest(key, keys.iter().map(String::as_str)) {
            Some(near) => (format!("{message}: did you mean `{near}`?"), Some(help)),
            None => (message, Some(help)),
        }
    }

    /// The help for a missing function that a task calls.
    pub(super) fn missing(&self, name: &str, parameters: &[&str]) -> Option<String> {
        let wanted = format!("{name}({})", parameters.join(", "));
        if self.functions.iter().any(|(known, _)| known == name) {
            return Some(format!("write fn {wanted}"));
        }
        let candidates = self
            .functions
            .iter()
            .map(|(name, _)| name.as_str())
            .filter(|known| ENTRY_POINTS.iter().all(|(entry, _)| entry != known));
        match nearest(name, candidates) {
            Some(near) => Some(format!("rename `{near}` to `{name}`")),
            None => Some(format!("write fn {wanted} {{ ... }}")),
        }
    }

    pub(super) fn is_function(&self, name: &str) -> bool {
        self.built_in.contains_key(name) || self.functions.iter().any(|(known, _)| known == name)
    }
}

/// The message for an index past the end of the variable `name`.
pub(super) fn past_the_end(index: usize, length: usize, name: &str) -> Words {
    const JOINT_VECTORS: [&str; 6] = ["q", "qd", "effort", "lower", "upper", "joint_names"];
    let message = match length.checked_sub(1) {
        None => format!("index {index} is past the end: `{name}` is empty"),
        Some(last) if index == length && JOINT_VECTORS.contains(&name) => format!(
            "index {index} is past the end: joint {length} is {name}[{last}], counting starts at 0"
        ),
        Some(last) => format!(
            "index {index} is past the end: the last is {name}[{last}], counting starts at 0"
        ),
    };
    (message, None)
}

/// The name and the types of the arguments in the engine's `name (type, type)`.
pub(super) fn signature(text: &str) -> (&str, Vec<&str>) {
    let (name, rest) = text.split_once(" (").unwrap_or((text, ")"));
    let inside = rest.strip_suffix(')').unwrap_or(rest);
    let types = inside.split(", ").filter(|kind| !kind.is_empty()).collect();
    (name, types)
}

fn arguments_words(count: usize) -> String {
    match count {
        0 => "no arguments".to_owned(),
        1 => "1 argument".to_owned(),
        count => format!("{count} arguments"),
    }
}

/// The longest known name that is the beginning of `name`: `cos` of `cosine`.
fn abbreviation<'a>(name: &str, known: impl Iterator<Item = &'a str>) -> Option<&'a str> {
    known
        .filter(|known| known.len() > 2 && name.starts_with(known))
        .max_by_key(|known| known.len())
}

/// The known name that a typo could have made `name` from; the first among equally near ones.
fn nearest<'a>(name: &str, known: impl Iterator<Item = &'a str>) -> Option<&'a str> {
    let is_searched = |name: &str| name.len() <= LONGEST_TYPO;
    if !is_searched(name) {
        return None;
    }
    let slips = 1 + name.chars().count() / 5;
    let lower = name.to_lowercase();
    known
        // a single letter is near to every other
        .filter(|known| *known != name && known.len() > 1 && name.len() > 1)
        .filter(|known| is_searched(known) && known.len().abs_diff(name.len()) <= 4 * slips)
        .map(|known| {
            let known_lower = known.to_lowercase();
            let shared = lower.chars().zip(known_lower.chars());
            // among equally near names, prefer one with the same first letter
            let unlike = lower.len() - shared.take_while(|(a, b)| a == b).count().min(lower.len());
            ((strsim::osa_distance(&lower, &known_lower), unlike), known)
        })
        .filter(|((distance, _), _)| *distance <= slips)
        .min_by_key(|(key, _)| *key)
        .map(|(_, known)| known)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_slip_of_the_keyboard_is_found_and_another_word_is_not() {
        let known = ["sin", "sign", "observation", "q", "qd"];
        let near = |name| nearest(name, known.into_iter());
        assert_eq!(near("sinn"), Some("sin"));
        assert_eq!(near("observaton"), Some("observation"));
        assert_eq!(near("Observation"), Some("observation"));
        assert_eq!(near("qdd"), Some("qd"));
        assert_eq!(near("velocity"), None);
        assert_eq!(near("x"), None);
    }

    #[test]
    fn a_very_long_name_is_compared_with_nothing() {
        let [long, other] = ["a", "b"].map(|last| "ab".repeat(LONGEST_TYPO / 2) + last);
        assert_eq!(nearest(&long, [other.as_str()].into_iter()), None);
        let [long, other] = [&long[1..], &other[1..]];
        assert_eq!(nearest(long, [other].into_iter()), Some(other));
    }

    #[test]
    fn a_signature_falls_into_name_and_types() {
        assert_eq!(signature("fk (map, vector)"), ("fk", vec!["map", "vector"]));
        assert_eq!(signature("now ()"), ("now", vec![]));
    }
}
