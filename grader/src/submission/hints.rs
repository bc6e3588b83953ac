//! What to say about names nobody knows: misspelt ones, and those people bring from MATLAB and Python.

use std::collections::{BTreeMap, BTreeSet};

/// Everything that has a name in one submission.
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
    /// Parameters that stand for the observation, whatever the file calls them.
    pub(super) observation_parameters: BTreeSet<String>,
    /// Parameters that stand for the robot.
    pub(super) robot_parameters: BTreeSet<String>,
}

/// Functions of other languages, and what to write here.
pub(super) const FOREIGN_FUNCTIONS: &[(&str, &str)] = &[
    ("arctan2", "write atan2(y, x)"),
    ("arctan", "write atan(x)"),
    ("arccos", "write acos(x)"),
    ("arcsin", "write asin(x)"),
    ("power", "write x ** y"),
    ("fabs", "write abs(x)"),
    (
        "log",
        "write ln(x) for the natural logarithm, log10(x) for that to base 10",
    ),
    ("length", "write len(x)"),
    ("numel", "write len(x)"),
    ("size", "write len(x), or rows(m) and cols(m)"),
    ("shape", "write len(x), or rows(m) and cols(m)"),
    ("disp", "write print(x)"),
    ("printf", "write print(\"x =\", x)"),
    ("fprintf", "write print(\"x =\", x)"),
    ("println", "write print(x)"),
    ("sprintf", "join texts with +: \"x = \" + x"),
    ("format", "join texts with +: \"x = \" + x"),
    ("str", "write to_string(x), or join texts with +"),
    ("num2str", "write to_string(x), or join texts with +"),
    ("float", "numbers need no conversion"),
    ("int", "write trunc(x), floor(x) or round(x)"),
    ("to_int", "write trunc(x), floor(x) or round(x)"),
    ("to_float", "numbers need no conversion"),
    ("fix", "write trunc(x)"),
    ("mod", "write a % b; its sign is that of b"),
    ("rem", "write a % b; its sign is that of b"),
    ("fmod", "write a % b; its sign is that of b"),
    ("array", "write vector([1, 2]) or matrix([[1, 2], [3, 4]])"),
    ("append", "write list.push(x), or concat(a, b)"),
    ("extend", "write concat(a, b)"),
    ("matmul", "write a * b"),
    (
        "multiply",
        "write a * b; vectors multiply element by element",
    ),
    ("times", "write a * b; vectors multiply element by element"),
    ("pinv", "write transpose(J) * solve(J * transpose(J), v)"),
    ("mldivide", "write solve(A, b)"),
    ("lstsq", "write solve(transpose(A) * A, transpose(A) * b)"),
    ("degrees", "write deg(x)"),
    ("rad2deg", "write deg(x)"),
    ("to_degrees", "write deg(x)"),
    ("radians", "write rad(x)"),
    ("deg2rad", "write rad(x)"),
    ("to_radians", "write rad(x)"),
    ("wrapToPi", "write wrap_pi(x)"),
    ("identity", "write eye(n)"),
    ("magnitude", "write norm(v)"),
    ("isnan", "write is_nan(x)"),
    ("isnumeric", "there is no test of types"),
    ("type_of", "there is no test of types"),
    (
        "sleep",
        "nothing waits here: `control` is called every control period",
    ),
    (
        "pause",
        "nothing waits here: `control` is called every control period",
    ),
    (
        "wait",
        "nothing waits here: `control` is called every control period",
    ),
    (
        "tic",
        "there is no clock: observation.time is the time of the run",
    ),
    (
        "toc",
        "there is no clock: observation.time is the time of the run",
    ),
    (
        "timestamp",
        "there is no clock: observation.time is the time of the run",
    ),
    (
        "rand",
        "there is no randomness: the same run gives the same bits",
    ),
    (
        "random",
        "there is no randomness: the same run gives the same bits",
    ),
    (
        "randn",
        "there is no randomness: the same run gives the same bits",
    ),
    ("map", "write a `for` loop"),
    ("filter", "write a `for` loop"),
    ("reduce", "write a `for` loop"),
];

/// Variables of other languages, and what to write here.
pub(super) const FOREIGN_VARIABLES: &[(&str, &str)] = &[
    (
        "np",
        "functions are built in: write sin(x) and pi, without a prefix",
    ),
    (
        "numpy",
        "functions are built in: write sin(x) and pi, without a prefix",
    ),
    (
        "math",
        "functions are built in: write sin(x) and pi, without a prefix",
    ),
    (
        "Math",
        "functions are built in: write sin(x) and pi, without a prefix",
    ),
    ("self", "what is kept between calls is in `this`"),
    ("True", "write true"),
    ("False", "write false"),
    ("None", "write ()"),
    ("null", "write ()"),
    ("nil", "write ()"),
    ("NULL", "write ()"),
    ("Inf", "write inf"),
    (
        "end",
        "blocks end with `}`; the last element is v[len(v) - 1]",
    ),
];

/// Words of other languages' syntax, and what to write here.
const FOREIGN_SYNTAX: &[(&str, &str)] = &[
    ("and", "write && for \"and\""),
    ("or", "write || for \"or\""),
    ("not", "write ! for \"not\""),
    ("elif", "write else if"),
    ("elseif", "write else if"),
    ("def", "a function is written fn name(parameters) { ... }"),
    (
        "function",
        "a function is written fn name(parameters) { ... }",
    ),
    ("func", "a function is written fn name(parameters) { ... }"),
    ("lambda", "write a function with a name: fn name(x) { ... }"),
    ("end", "blocks are written { ... }"),
    ("then", "write if condition { ... }"),
    ("var", "declare a variable with let x = 1;"),
    ("double", "declare a variable with let x = 1;"),
    ("float", "declare a variable with let x = 1;"),
    ("int", "declare a variable with let x = 1;"),
    ("import", "everything there is, is built in"),
    ("from", "everything there is, is built in"),
];

/// Signs of other languages' syntax, and what to write here.
const FOREIGN_SIGNS: &[(&str, &str)] = &[
    (".*", "write *: vectors multiply element by element"),
    ("./", "write /: vectors divide element by element"),
    (".^", "write **: vectors go element by element"),
    ("++", "write x += 1"),
    ("--", "write x -= 1"),
    (":=", "write let x = 1; to declare and x = 2; to change"),
    ("@", "write * for the product of matrices"),
    ("#", "a comment begins with //"),
    ("?", "write if condition { a } else { b }"),
    (
        "'",
        "a text goes in double quotes; the transpose is transpose(m)",
    ),
];

/// Functions of `robot` that a task may grant.
const GRANTED: [&str; 4] = ["fk", "jacobian", "gravity", "mass_matrix"];

/// What a submission's functions are called with.
pub(super) const ENTRY_POINTS: &[(&str, &[&str])] = &[
    ("forward_kinematics", &["robot", "q"]),
    ("inverse_kinematics", &["robot", "position"]),
    ("init", &["robot", "task"]),
    ("control", &["observation"]),
];

type Words = (String, Option<String>);

impl Names {
    pub(super) fn unknown_function(&self, name: &str, arguments: &[&str]) -> Words {
        let given = match arguments.len() {
            0 => "none".to_owned(),
            count => count.to_string(),
        };
        if let Some((_, parameters)) = self.functions.iter().find(|(known, _)| known == name) {
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
        if GRANTED.contains(&name) && arguments.first() == Some(&"map") {
            return (
                format!("`robot.{name}` is not granted in this task"),
                Some("write it yourself: the dimensions are in `robot`".to_owned()),
            );
        }
        let message = format!("`{name}` is not a function");
        if let Some(help) = look_up(FOREIGN_FUNCTIONS, name) {
            return (message, Some(help));
        }
        let known = self
            .functions
            .iter()
            .map(|(name, _)| name.as_str())
            .chain(self.built_in.keys().map(String::as_str));
        match nearest(name, known) {
            Some(near) => (format!("{message}: did you mean `{near}`?"), None),
            None => (message, None),
        }
    }

    pub(super) fn unknown_variable(&self, name: &str) -> Words {
        let message = format!("variable `{name}` is not known here");
        if let Some(help) = look_up(FOREIGN_VARIABLES, name) {
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

    pub(super) fn unknown_key(&self, owner: Option<&str>, key: &str) -> Words {
        if owner == Some("this") {
            return (
                format!("`this.{key}` is not set yet"),
                Some("set it in init(robot, task)".to_owned()),
            );
        }
        let keys = match owner {
            Some(name) if name == "observation" || self.observation_parameters.contains(name) => {
                &self.observation
            }
            Some(name) if name == "robot" || self.robot_parameters.contains(name) => &self.robot,
            _ => {
                let both = self.observation.iter().chain(&self.robot);
                let message = match owner {
                    Some(owner) => format!("`{owner}` has no `{key}`"),
                    None => format!("the map has no `{key}`"),
                };
                return match nearest(key, both.map(String::as_str)) {
                    Some(near) => (format!("{message}: did you mean `{near}`?"), None),
                    None => (
                        message,
                        Some("get(map, key, otherwise) asks without failing".to_owned()),
                    ),
                };
            }
        };
        let owner = owner.unwrap_or("it");
        let message = format!("`{owner}` has no `{key}`");
        let help = format!(
            "it has {}",
            keys.iter().cloned().collect::<Vec<_>>().join(", ")
        );
        match nearest(key, keys.iter().map(String::as_str)) {
            Some(near) => (format!("{message}: did you mean `{near}`?"), Some(help)),
            None => (message, Some(help)),
        }
    }

    /// What to do when the function a task calls is missing.
    pub(super) fn missing(&self, name: &str, parameters: &[&str]) -> Option<String> {
        let wanted = format!("{name}({})", parameters.join(", "));
        if let Some((_, got)) = self.functions.iter().find(|(known, _)| known == name) {
            return Some(format!(
                "`{name}` takes {}, yours takes {}: write fn {wanted}",
                arguments_words(parameters.len()),
                got.len()
            ));
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

/// Says that an index is past the end of the variable `name`.
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

/// What to write instead of a reserved word or symbol.
pub(super) fn reserved(word: &str) -> Option<String> {
    let help = match word {
        "eval" | "Fn" | "call" | "curry" => "functions are called by name",
        "import" | "export" | "as" | "module" | "use" => "everything there is, is built in",
        "type_of" | "is_def_var" | "is_def_fn" | "is_shared" => "there is no test of this",
        "|" | "||" => "functions without a name are not available: write fn name(x) { ... }",
        other => return look_up(FOREIGN_SIGNS, other).or_else(|| look_up(FOREIGN_SYNTAX, other)),
    };
    Some(help.to_owned())
}

/// Help if a line shows another language's syntax at or before a column.
pub(super) fn foreign_syntax(line: &str, column: usize) -> Option<String> {
    let characters: Vec<char> = line.chars().collect();
    let column = column.saturating_sub(1).min(characters.len());
    // the word the parser stopped at, and the one before it
    let around: String = characters
        .iter()
        .enumerate()
        .filter(|(i, c)| *i < column || c.is_alphanumeric() || **c == '_')
        .map(|(_, c)| *c)
        .collect();
    let mut words = around
        .split(|c: char| !(c.is_alphanumeric() || c == '_'))
        .filter(|word| !word.is_empty());
    let stopped: String = characters[column..]
        .iter()
        .take_while(|c| c.is_alphanumeric() || **c == '_')
        .collect();
    let before = characters[..column]
        .split(|c| !(c.is_alphanumeric() || *c == '_'))
        .rfind(|word| !word.is_empty())
        .map(|word| word.iter().collect::<String>());
    look_up(FOREIGN_SYNTAX, &stopped)
        .or_else(|| look_up(FOREIGN_SYNTAX, &before?))
        .or_else(|| look_up(FOREIGN_SYNTAX, words.next()?))
        .or_else(|| {
            let near: String = characters[column.saturating_sub(2)..]
                .iter()
                .take(4)
                .collect();
            FOREIGN_SIGNS
                .iter()
                .find(|(sign, _)| near.contains(sign))
                .map(|(_, help)| (*help).to_owned())
        })
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

fn look_up(table: &[(&str, &str)], name: &str) -> Option<String> {
    table
        .iter()
        .find(|(known, _)| *known == name)
        .map(|(_, help)| (*help).to_owned())
}

/// The known name that is a slip of the keyboard away, the first of equals.
fn nearest<'a>(name: &str, known: impl Iterator<Item = &'a str>) -> Option<&'a str> {
    let slips = 1 + name.chars().count() / 5;
    let lower = name.to_lowercase();
    let mut best: Option<(usize, &str)> = None;
    for candidate in known {
        if candidate == name {
            continue;
        }
        let distance = strsim::osa_distance(&lower, &candidate.to_lowercase());
        if distance <= slips && best.is_none_or(|(least, _)| distance < least) {
            best = Some((distance, candidate));
        }
    }
    best.map(|(_, candidate)| candidate)
        // one letter is a slip away from every other
        .filter(|candidate| candidate.chars().count() > 1 && name.chars().count() > 1)
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
    fn words_of_other_languages_are_seen_where_the_parser_stops() {
        assert!(foreign_syntax("if a and b {", 6).is_some_and(|help| help.contains("&&")));
        assert!(foreign_syntax("def control(o):", 5).is_some_and(|help| help.contains("fn")));
        assert!(foreign_syntax("let x = 1 +", 12).is_none());
    }

    #[test]
    fn a_signature_falls_into_name_and_types() {
        assert_eq!(signature("fk (map, vector)"), ("fk", vec!["map", "vector"]));
        assert_eq!(signature("now ()"), ("now", vec![]));
    }
}
