//! Turns the engine's errors into messages for students: plain words, the position, what to do.

use rhai::{Dynamic, Engine, EvalAltResult, ParseError, ParseErrorType, Position};

use super::budget::{Meter, place};
use super::foreign;
use super::hints::{self, Names};
use super::signs::Signs;
use super::unknown::others;
use crate::submission::controller::{Budget, Mistake, SourcePosition, Stop};

/// The help for a fraction as an index.
pub(super) const WHOLE_INDEX: &str = "round(i) makes it whole; a vector takes 2.0 for 2";

/// The reason why a built-in has no result.
#[derive(Debug)]
pub(super) enum Problem {
    /// An error of the student.
    Fault(Fault),
    /// A budget ran out; the meter knows which one. A script cannot catch this.
    Exhausted,
}

/// An error without its position, which only the engine knows.
#[derive(Debug, Clone)]
pub(super) struct Fault {
    pub(super) message: String,
    pub(super) help: Option<String>,
    /// An index and the length that it exceeds, if the message should name the variable, which only the source does.
    pub(super) past_the_end: Option<(usize, usize)>,
}

/// A fault without help.
pub(super) fn fault(message: impl Into<String>) -> Problem {
    Problem::Fault(Fault {
        message: message.into(),
        help: None,
        past_the_end: None,
    })
}

/// A fault with help.
pub(super) fn fault_with_help(message: impl Into<String>, help: impl Into<String>) -> Problem {
    Problem::Fault(Fault {
        message: message.into(),
        help: Some(help.into()),
        past_the_end: None,
    })
}

/// Raises a problem in the engine.
pub(super) fn raise(problem: Problem, position: Position) -> Box<EvalAltResult> {
    Box::new(match problem {
        Problem::Fault(fault) => EvalAltResult::ErrorRuntime(Dynamic::from(fault), position),
        Problem::Exhausted => EvalAltResult::ErrorTerminated(Dynamic::UNIT, position),
    })
}

/// The context for the message of an error.
#[derive(Clone, Copy)]
pub(super) struct Context<'a> {
    pub(super) source: &'a str,
    pub(super) meter: &'a Meter,
    pub(super) names: &'a Names,
    /// The position where the called function begins.
    pub(super) beginning: Option<SourcePosition>,
}

impl Context<'_> {
    /// Whether a name at a place is set there: an `=` follows.
    fn is_set(&self, name: &str, place: SourcePosition) -> bool {
        let line = self.line(place.line).unwrap_or_default();
        let rest = line.chars().skip(place.column.saturating_sub(1));
        let rest: String = rest.collect();
        let rest = rest.strip_prefix(name).unwrap_or_default().trim_start();
        rest.starts_with('=') && !rest.starts_with("==")
    }

    /// Explains why the file does not compile, and what else is wrong further down.
    pub(super) fn not_compiled(&self, engine: &Engine, error: &ParseError) -> Stop {
        match self.parsing(error) {
            Stop::DidNotBuild(mistake) => {
                let further = self.further(engine, &mistake);
                Stop::DidNotBuild(Mistake { further, ..mistake })
            }
            other => other,
        }
    }

    /// The mistake at which the parser stops, if it is one and no budget.
    pub(super) fn parse_mistake(&self, error: &ParseError) -> Option<Mistake> {
        match self.parsing(error) {
            Stop::DidNotBuild(mistake) => Some(mistake),
            _ => None,
        }
    }

    /// Explains why the file does not compile.
    pub(super) fn parsing(&self, error: &ParseError) -> Stop {
        let ParseError(kind, position) = error;
        // the engine reports the end of the file as a line after the last
        let place = place(*position)
            .filter(|place| self.line(place.line).is_some())
            .or_else(|| self.end_of_source());
        match &**kind {
            ParseErrorType::ExprTooDeep => self.over(Budget::ExpressionDepth, place),
            ParseErrorType::LiteralTooLarge(what, _) => self.over(size_budget(what), place),
            kind => Stop::DidNotBuild(self.unparsed(kind, place)),
        }
    }

    /// Explains why the run ended.
    // long: one arm per error of the engine: a table, and as long as the engine has errors
    pub(super) fn running(&self, error: &EvalAltResult) -> Stop {
        let mut inner = error;
        while let EvalAltResult::ErrorInFunctionCall(_, _, nested, _) = inner {
            inner = nested;
        }
        // the engine reports the position of the call for a limit that was reached inside
        let own_place = (!inner.is_system_exception()).then(|| place(inner.position()));
        let place = own_place.flatten().or_else(|| self.place_of_limit(inner));
        if let Some(budget) = self.meter.exhausted() {
            return self.over(budget, place);
        }
        let mut unknown = None;
        let (message, help) = match inner {
            EvalAltResult::ErrorParsing(kind, position) => {
                return self.parsing(&ParseError(Box::new(kind.clone()), *position));
            }
            EvalAltResult::ErrorStackOverflow(_) => return self.over(Budget::CallDepth, place),
            EvalAltResult::ErrorDataTooLarge(what, _) => {
                return self.over(size_budget(what), place);
            }
            EvalAltResult::ErrorRuntime(thrown, _) => self.thrown(thrown, place),
            EvalAltResult::ErrorFunctionNotFound(signature, _) => {
                let (name, arguments) = hints::signature(signature);
                unknown = Some(name);
                self.names.unknown_function(name, &arguments)
            }
            EvalAltResult::ErrorVariableNotFound(name, _) => {
                unknown = Some(name.as_str());
                self.unknown_variable(name, place)
            }
            EvalAltResult::ErrorPropertyNotFound(key, _) => {
                self.names
                    .unknown_key(self.owner_of(place).as_deref(), key, place)
            }
            EvalAltResult::ErrorDotExpr(text, _) => property_words(text),
            EvalAltResult::ErrorIndexingType(text, _) => (
                format!(
                    "this cannot be indexed or set like that: {}",
                    type_words(text)
                ),
                Some("v[0] is an element of a vector or list, m[0][1] one of a matrix; zeros(4) is a vector and zeros(4, 4) a matrix".to_owned()),
            ),
            EvalAltResult::ErrorUnboundThis(_) => (
                "`this` is not known in this function".to_owned(),
                Some(
                    "only `init` and `control` have `this`: pass what is needed as an argument"
                        .to_owned(),
                ),
            ),
            EvalAltResult::ErrorFor(_) => (
                "`for` goes over a range, a list, a vector or a string".to_owned(),
                Some(
                    "count with `for i in 0..n`; go over a map with `for key in keys(m)`"
                        .to_owned(),
                ),
            ),
            EvalAltResult::ErrorAssignmentToConstant(name, _) if name.is_empty() => {
                ("a constant cannot change".to_owned(), None)
            }
            EvalAltResult::ErrorAssignmentToConstant(name, _) => (
                format!("`{name}` is a constant and cannot change"),
                Some("keep what changes in `this`, or copy it with `let`".to_owned()),
            ),
            EvalAltResult::ErrorNonPureMethodCallOnConstant(..) => (
                "a constant cannot change".to_owned(),
                Some("copy it with `let` first".to_owned()),
            ),
            EvalAltResult::ErrorMismatchDataType(wanted, got, _)
                if matches!(wanted.as_str(), "i64" | "INT") =>
            {
                (
                    format!("the index of a list is an integer, got {}", type_words(got)),
                    Some(match type_words(got).as_str() {
                        "a range" => "slice(a, 0, 3) is the part from index 0 to before 3".to_owned(),
                        _ => WHOLE_INDEX.to_owned(),
                    }),
                )
            }
            EvalAltResult::ErrorMismatchDataType(wanted, got, _)
            | EvalAltResult::ErrorMismatchOutputType(wanted, got, _) => {
                let is_key = type_words(wanted) == "a string";
                let owner = self.owner_of(place).filter(|_| is_key);
                let of_map = owner.and_then(|owner| self.names.indexed_map(&owner));
                of_map.unwrap_or_else(|| {
                    (
                        format!("expected {}, got {}", type_words(wanted), type_words(got)),
                        None,
                    )
                })
            }
            EvalAltResult::ErrorStringBounds(length, index, _) => (
                format!("index {index} is outside of a string of {length}"),
                None,
            ),
            other => (plain(&other.to_string()), None),
        };
        let line = place.map(|place| place.line);
        let further = unknown.map(|name| others(&self.names.unknown, name, line));
        Stop::Crashed(Mistake {
            message: shortened(message),
            place,
            help: help.map(shortened),
            further: further.unwrap_or_default(),
        })
    }

    /// The words for a variable that is not known at a place.
    fn unknown_variable(
        &self,
        name: &str,
        place: Option<SourcePosition>,
    ) -> (String, Option<String>) {
        let is_set = place.is_some_and(|place| self.is_set(name, place));
        let (message, help) = self.names.unknown_variable(name, place, is_set);
        // what is used behind the block that sets it
        let mut unknown = self.names.unknown.iter();
        let known = unknown.find(|known| known.name == name && known.is_used_outside);
        let before = known.map(|known| {
            let own = format!("`{name}`: ");
            known.help.trim_start_matches(&own).to_owned()
        });
        (message, before.or(help))
    }

    /// Where a limit was reached, of which the engine knows only where the grader's call stands.
    fn place_of_limit(&self, error: &EvalAltResult) -> Option<SourcePosition> {
        let places = &self.names.places;
        let last = || self.meter.last_place().or(self.beginning);
        match self.meter.exhausted() {
            Some(Budget::OperationsPerCall | Budget::OperationsPerTask) => self
                .meter
                .recent_place()
                .or_else(|| places.endless(self.beginning)),
            None if matches!(error, EvalAltResult::ErrorStackOverflow(_)) => {
                places.recursion().or_else(last)
            }
            _ => last(),
        }
    }

    fn over(&self, budget: Budget, place: Option<SourcePosition>) -> Stop {
        Stop::OverBudget {
            budget,
            limit: self.meter.limit(budget),
            place,
            function: None,
        }
    }

    /// A built-in's fault, or what the student's own `throw` carries.
    fn thrown(&self, thrown: &Dynamic, place: Option<SourcePosition>) -> (String, Option<String>) {
        let Some(fault) = thrown.read_lock::<Fault>() else {
            let text = super::words::show_briefly(thrown);
            return (format!("the script threw: {text}"), None);
        };
        if let (Some((index, length)), Some(name)) = (fault.past_the_end, self.indexed(place)) {
            return hints::past_the_end(index, length, &name);
        }
        (fault.message.clone(), fault.help.clone())
    }

    /// The name of what is indexed at a position: `q` of `q[i + 2]`, wherever in the brackets that is.
    fn indexed(&self, place: Option<SourcePosition>) -> Option<String> {
        let place = place?;
        let signs = Signs::of(self.source);
        let behind = SourcePosition {
            column: place.column + 1,
            ..place
        };
        let (bracket, _) = signs.open_at(behind).filter(|(_, sign)| *sign == '[')?;
        signs.word_before(bracket)
    }

    /// The name before the `[` or `.` at or before a position: `q` of `q[2]`.
    fn owner_of(&self, place: Option<SourcePosition>) -> Option<String> {
        let place = place?;
        let before: Vec<char> = self.line(place.line)?.chars().take(place.column).collect();
        let separator = before.iter().rposition(|&c| c == '[' || c == '.')?;
        let name: String = before[..separator]
            .iter()
            .rev()
            .take_while(|c| c.is_alphanumeric() || **c == '_')
            .collect();
        let name: String = name.chars().rev().collect();
        (!name.is_empty()).then_some(name)
    }

    pub(super) fn line(&self, number: usize) -> Option<&str> {
        self.source.lines().nth(number.checked_sub(1)?)
    }

    fn end_of_source(&self) -> Option<SourcePosition> {
        let line = self.source.lines().count().max(1);
        Some(SourcePosition {
            line,
            column: self.line(line).map_or(1, |text| text.chars().count() + 1),
        })
    }
}

/// Shortens a message with a very long name or string in it.
pub(super) fn shortened(text: String) -> String {
    const LONGEST: usize = 400;
    if text.chars().count() <= LONGEST {
        return text;
    }
    text.chars().take(LONGEST).chain("...".chars()).collect()
}

fn size_budget(what: &str) -> Budget {
    if what.contains("tring") {
        Budget::TextSize
    } else if what.contains("map") {
        Budget::MapSize
    } else {
        Budget::ListSize
    }
}

/// The engine's sentence as a lowercase fragment: `Expecting '(' ...` becomes ``expecting `(` ...``.
pub(super) fn plain(text: &str) -> String {
    let text = text
        .split(" (line ")
        .next()
        .unwrap_or(text)
        .replace('\'', "`");
    let mut characters = text.chars();
    characters.next().map_or_else(String::new, |first| {
        first.to_lowercase().chain(characters).collect()
    })
}

/// ``a vector has no `y` `` from the engine's `Unknown property 'y' - a getter is not registered for type 'vector'`, and what to write
/// instead.
fn property_words(text: &str) -> (String, Option<String>) {
    let mut quoted = text.split('\'').skip(1).step_by(2);
    match (quoted.next(), quoted.next()) {
        (Some(property), Some(kind)) => (
            format!("{} has no `{property}`", type_words(kind)),
            foreign::function(property),
        ),
        _ => (plain(text), None),
    }
}

fn type_words(kind: &str) -> String {
    match kind {
        "i64" | "INT" | "integer" => "an integer".to_owned(),
        "f64" => "a number".to_owned(),
        "bool" => "true or false".to_owned(),
        "string" | "char" | "&str | ImmutableString | String" => "a string".to_owned(),
        "array" => "a list".to_owned(),
        "map" => "a map".to_owned(),
        "()" => "nothing `()`".to_owned(),
        "vector" => "a vector".to_owned(),
        "matrix" => "a matrix".to_owned(),
        other if other.contains("range::Range") => "a range".to_owned(),
        other if other.contains("ImmutableString") => "a string".to_owned(),
        other if other.ends_with("Vector") => "a vector".to_owned(),
        other if other.ends_with("Matrix") => "a matrix".to_owned(),
        other => other.to_owned(),
    }
}
