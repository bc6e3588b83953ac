//! How the numbers of a student's variant are drawn: the rules of `[variants]` in lab.toml, and what they give for a salt and an id.

use std::collections::BTreeMap;

use kinemark_sim::random::KeyedStream;
use kinemark_sim::text::number::{short, trimmed};
use kinemark_sim::text::{Dimension, Dimensions, Spanned};
use unicode_normalization::UnicodeNormalization as _;

use super::file::{ChoicesTable, StepsTable, VariesTable};
use super::model::Lab;
use super::variant::{Variant, toml_of};
use crate::task::problem::{LabError, near, problems};
use crate::task::reporter::Reporter;

/// How the values of one parameter are drawn.
#[derive(Debug, Clone, PartialEq)]
pub struct VariantRule {
    /// The parameter.
    pub name: String,
    /// What it is drawn from.
    pub from: DrawnFrom,
}

/// What the values of a parameter are drawn from.
#[derive(Debug, Clone, PartialEq)]
pub enum DrawnFrom {
    /// The steps of a number.
    Steps(Steps),
    /// The steps of each number of a list.
    Each(Vec<Steps>),
    /// One of these, all of one shape.
    Choices(Vec<Dimension>),
}

/// Values at equal distances.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Steps {
    /// The first.
    pub from: f64,
    /// From one to the next.
    pub step: f64,
    /// How many there are.
    pub count: u64,
}

impl Steps {
    /// Value `k`, to 12 significant digits: a person reads 3.04, not 3.0399999999999996.
    fn value(&self, k: u64) -> f64 {
        let value = self.from + self.step * k as f64;
        format!("{value:.11e}").parse().unwrap_or(value)
    }

    /// The first and the last of them.
    pub(super) fn ends(&self) -> [f64; 2] {
        [self.value(0), self.value(self.count.saturating_sub(1))]
    }

    /// Whether `number` is one of them, to the digits that a person types.
    fn gives(&self, number: f64) -> bool {
        let k = ((number - self.from) / self.step).round();
        (0.0..self.count as f64).contains(&k)
            && (self.value(k as u64) - number).abs() <= 1e-9 * self.step
    }

    /// All of them in words.
    fn words(&self) -> String {
        let [_, to] = self.ends();
        format!("{} to {to} in steps of {}", self.from, self.step)
    }
}

impl VariantRule {
    /// A value of the parameter as it is typed.
    pub(crate) fn in_toml(&self, value: &Dimension) -> String {
        toml_of(value)
    }

    /// Whether a student's variant can have this value.
    pub(crate) fn gives(&self, value: &Dimension) -> bool {
        match (&self.from, value) {
            (DrawnFrom::Steps(steps), Dimension::Number(number)) => steps.gives(*number),
            (DrawnFrom::Each(each), Dimension::List(numbers)) => {
                let mut pairs = numbers.iter().zip(each);
                numbers.len() == each.len() && pairs.all(|(number, steps)| steps.gives(*number))
            }
            (DrawnFrom::Choices(choices), value) => choices.contains(value),
            (DrawnFrom::Steps(_) | DrawnFrom::Each(_), _) => false,
        }
    }

    /// The values that it gives, in words.
    pub(crate) fn words(&self) -> String {
        match &self.from {
            DrawnFrom::Steps(steps) => steps.words(),
            DrawnFrom::Each(each) => {
                let all: Vec<String> = each.iter().map(Steps::words).collect();
                all.join("; ")
            }
            DrawnFrom::Choices(choices) => {
                let all: Vec<String> = choices.iter().map(toml_of).collect();
                format!("one of {}", all.join(", "))
            }
        }
    }
}

impl Lab {
    /// The variant of `student` under `salt`: the same numbers on every machine, and for every way to write the same letters (an `é`
    /// may be one character or two).
    ///
    /// # Errors
    /// An id that cannot be one.
    pub fn variant_of(&self, salt: &str, student: &str) -> Result<Variant, LabError> {
        let student: String = student.nfc().collect();
        let student = student.as_str();
        let parameters: Vec<(String, Dimension)> = self
            .variants
            .iter()
            .map(|rule| {
                let below =
                    |index, count| chosen(salt, &self.name, student, &rule.name, index, count);
                let value = match &rule.from {
                    DrawnFrom::Steps(steps) => {
                        Dimension::Number(steps.value(below(None, steps.count)))
                    }
                    DrawnFrom::Each(each) => {
                        let numbers = (0..).zip(each);
                        let drawn =
                            numbers.map(|(i, steps)| steps.value(below(Some(i), steps.count)));
                        Dimension::List(drawn.collect())
                    }
                    // reading refuses a rule without choices
                    DrawnFrom::Choices(choices) => {
                        choices[below(None, choices.len() as u64) as usize].clone()
                    }
                };
                (rule.name.clone(), value)
            })
            .collect();
        Variant::new(&self.name, Some(student), &parameters)
    }
}

/// A number below `count`, uniform, keyed by all that it depends on.
fn chosen(
    salt: &str,
    lab: &str,
    student: &str,
    parameter: &str,
    index: Option<u64>,
    count: u64,
) -> u64 {
    let index = index.map(u64::to_le_bytes);
    let index: &[u8] = index.as_ref().map_or(&[], |bytes| bytes);
    let names = [salt, lab, student, parameter];
    // a parameter has at most a million steps
    KeyedStream::new("kinemark 2026 variants v1", &names, index).below(count)
}

/// More steps than this are a slip of the pen.
const MOST_STEPS: f64 = 1e6;

problems! {
    /// What is wrong with a lab's `[variants]`.
    enum RuleProblem {
        UnknownParameter { name: String, known: Vec<String> }:
            "lab::variants", "no parameter is called `{name}`", "not in [parameters]", near(name, "parameters", known);
        Shape { name: String, base: Dimension }:
            "lab::variants", "parameter `{name}` is {base}, and this varies something else", "another shape",
            "give { from, to, step } for one number, a list of such tables for a list, or { choices = [...] } for anything";
        NoChoices:
            "lab::variants", "`choices` has nothing to choose", "an empty list", "write two or more values";
        Choice { name: String, base: Dimension, choice: String }:
            "lab::variants", "parameter `{name}` is {base}, and the choice {choice} is something else", "these choices",
            "let all of them have the shape that the parameter has";
        Steps { what: String, help: String }:
            "lab::variants", "{what}", "these steps", help.clone();
    }
}

/// Why there are no equal steps `from` one number `to` another.
fn not_steps(from: f64, to: f64, step: f64) -> RuleProblem {
    let steps = (to - from) / step;
    let (what, help) = if from > to {
        let what = format!("`from` {from} is above `to` {to}");
        (what, format!("write from = {to}, to = {from}"))
    } else if step > 0.0 && is_lost(from, to, step) {
        let what = format!(
            "a step of {step} does not show in numbers such as {from} and {to}: a student's number has 12 digits"
        );
        (what, "choose a longer step".to_owned())
    } else if step > 0.0 && steps.is_finite() && steps <= MOST_STEPS {
        let count = trimmed(steps, 2);
        // rounded, it would read as an integer
        let count = match count.contains('.') {
            true => count,
            false => steps.to_string(),
        };
        let what = format!(
            "{}, the way from {from} to {to}, is {count} steps of {step}: an integer is needed",
            short(to - from)
        );
        (
            what,
            format!("such as step = {}", near_step(to - from, steps)),
        )
    } else {
        let what = format!("from {from} to {to} is not 1 to {MOST_STEPS} steps of {step}");
        let help = "write such as { from = 2.9, to = 3.1, step = 0.01 }";
        (what, help.to_owned())
    };
    RuleProblem::Steps { what, help }
}

/// Whether a step is lost where a drawn number is written with 12 digits.
fn is_lost(from: f64, to: f64, step: f64) -> bool {
    step < 1e-11 * from.abs().max(to.abs())
}

/// A step of which `way` is a multiple, near the one of which it is `steps`: with few digits where there is such a one.
fn near_step(way: f64, steps: f64) -> f64 {
    let in_digits = |value: f64, digits: usize| {
        let text = format!("{value:.digits$e}");
        text.parse::<f64>().unwrap_or(value)
    };
    let nearest = steps.round().max(1.0);
    // a hundred around it: a short step is worth more than the nearest one
    let around = (0..100).flat_map(|off| [nearest + f64::from(off), nearest - f64::from(off)]);
    around
        .filter(|count| *count >= 1.0)
        .map(|count| (count, in_digits(way / count, 1)))
        .find(|(count, step)| (count * step - way).abs() <= 1e-9 * step)
        .map_or_else(|| in_digits(way / nearest, 11), |(_, step)| step)
}

/// The rules of a lab's `[variants]`.
pub(super) fn rules(
    report: Reporter<'_>,
    table: &BTreeMap<Spanned<String>, Spanned<VariesTable>>,
    stated: &Dimensions,
) -> Result<Vec<VariantRule>, LabError> {
    let mut rules = Vec::new();
    for (at, typed) in table {
        let name = at.get_ref();
        let Some(base) = stated.get(name) else {
            let problem = RuleProblem::UnknownParameter {
                name: name.clone(),
                known: stated.names().map(str::to_owned).collect(),
            };
            return report.refuse_at(at, problem);
        };
        let steps = |table: &StepsTable| {
            steps_of(table).or_else(|problem| report.refuse_at(typed, problem))
        };
        let from = match (typed.get_ref(), base) {
            (VariesTable::Steps(table), Dimension::Number(_)) => DrawnFrom::Steps(steps(table)?),
            (VariesTable::Each(each), Dimension::List(base)) if each.len() == base.len() => {
                DrawnFrom::Each(each.iter().map(steps).collect::<Result<_, _>>()?)
            }
            (VariesTable::Choices(ChoicesTable { choices }), base) => {
                if choices.is_empty() {
                    return report.refuse_at(typed, RuleProblem::NoChoices);
                }
                let shape = base.to_string();
                if let Some(other) = choices.iter().find(|choice| choice.to_string() != shape) {
                    let problem = RuleProblem::Choice {
                        name: name.clone(),
                        base: base.clone(),
                        choice: toml_of(other),
                    };
                    return report.refuse_at(typed, problem);
                }
                DrawnFrom::Choices(choices.clone())
            }
            _ => {
                let (name, base) = (name.clone(), base.clone());
                return report.refuse_at(typed, RuleProblem::Shape { name, base });
            }
        };
        let name = name.clone();
        rules.push(VariantRule { name, from });
    }
    Ok(rules)
}

/// The steps of a table.
fn steps_of(table: &StepsTable) -> Result<Steps, RuleProblem> {
    let StepsTable { from, to, step } = *table;
    let whole = ((to - from) / step).round();
    let fits = step > 0.0
        && !is_lost(from, to, step)
        && (0.0..=MOST_STEPS).contains(&whole)
        && (from + whole * step - to).abs() <= 1e-6 * step;
    if !fits {
        return Err(not_steps(from, to, step));
    }
    Ok(Steps {
        from,
        step,
        count: whole as u64 + 1,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_name_draws_one_variant_however_its_letters_are_written() {
        let lab = "format = 1\nname = \"x\"\ntitle = \"X\"\nrobot = \"r\"\n\
            parameters = { far = 3.0 }\nvariants = { far = { from = 0.0, to = 1000.0, step = 1.0 } }\n\
            [[tasks]]\nname = \"t\"\ntitle = \"T\"\n\
            function = { call = \"forward_kinematics\", cases = [{ name = \"c\", q_rad = [0.0] }] }\n\
            checks = [{ name = \"c\", title = \"C\", points = 1.0, fk-error = { full_m = 0.1, zero_m = 0.2 } }]\n";
        let robot = "format = 1\nname = \"r\"\n\
            links = [{ name = \"a\" }, { name = \"b\", shapes = [{ box = { size_m = [1.0, 1.0, 1.0] } }], inertia = { mass_kg = 1.0 } }]\n\
            joints = [{ name = \"j\", type = \"revolute\", parent = \"a\", child = \"b\", axis = [0.0, 0.0, 1.0] }]\n";
        let files =
            crate::lab::copies::Copies::from_texts([("x/lab.toml", lab), ("robots/r.toml", robot)]);
        let lab = Lab::load(&files, "x").unwrap();
        let [composed, apart, other] = ["Ren\u{e9}e", "Rene\u{301}e", "Renee"]
            .map(|id| lab.variant_of("salt", id).unwrap().text());
        assert_eq!(composed, apart);
        assert_ne!(composed, other);
    }

    #[test]
    fn every_number_that_is_drawn_is_known_and_no_other() {
        let steps = Steps {
            from: 2.9,
            step: 0.01,
            count: 21,
        };
        assert!((0..21).all(|k| steps.gives(steps.value(k))));
        for other in [2.89, 2.905, 3.11, 0.0, 1e300, -1e300, f64::NAN] {
            assert!(!steps.gives(other), "{other}");
        }
        assert_eq!(steps.words(), "2.9 to 3.1 in steps of 0.01");
        let one = Steps {
            from: 5.0,
            step: 1e-12,
            count: 1,
        };
        assert!(one.gives(5.0) && !one.gives(5.1));
    }

    #[test]
    fn steps_are_all_reached_and_given_in_short() {
        let steps = Steps {
            from: 2.9,
            step: 0.01,
            count: 21,
        };
        assert_eq!(steps.value(14), 3.04);
        assert_eq!(steps.value(20), 3.1);
        let mut seen = [0_u32; 21];
        for student in 0..2100 {
            let k = chosen("salt", "lab", &format!("s{student}"), "x", None, 21);
            seen[k as usize] += 1;
        }
        // however many digits the first has
        for (from, step) in [(123_456.789_123_4, 1e-3), (99_999.500_000_01, 1e-5)] {
            assert!(!is_lost(from, from + 20.0 * step, step));
            let steps = Steps {
                from,
                step,
                ..steps
            };
            assert!((0..21).all(|k| steps.gives(steps.value(k))), "{from}");
        }
        // 100 are expected of each, with a standard deviation of 10
        assert!(seen.iter().all(|&n| (50..150).contains(&n)), "{seen:?}");
    }

    #[test]
    fn what_is_no_row_of_steps_is_reported_with_a_step_that_is() {
        for (numbers, what, help) in [
            (
                [1.9, 2.3, 0.07],
                "0.4, the way from 1.9 to 2.3, is 5.71 steps of 0.07: an integer is needed",
                "such as step = 0.08",
            ),
            (
                [2.9, 2.3, 0.1],
                "`from` 2.9 is above `to` 2.3",
                "write from = 2.3, to = 2.9",
            ),
            (
                [0.0, 1.0, -0.1],
                "from 0 to 1 is not 1 to 1000000 steps of -0.1",
                "write such as { from = 2.9, to = 3.1, step = 0.01 }",
            ),
            (
                [1_000_000_000_000_001.0, 1_000_000_000_000_005.0, 1.0],
                "a step of 1 does not show in numbers such as 1000000000000001 and 1000000000000005: a student's number has 12 digits",
                "choose a longer step",
            ),
        ] {
            let [from, to, step] = numbers;
            let RuleProblem::Steps {
                what: found,
                help: advice,
            } = not_steps(from, to, step)
            else {
                panic!("{numbers:?}");
            };
            assert_eq!((found.as_str(), advice.as_str()), (what, help));
        }
    }

    #[test]
    fn every_part_of_the_key_matters() {
        let of = |salt, lab, student, parameter, index| {
            chosen(salt, lab, student, parameter, index, u64::MAX)
        };
        let one = of("a", "b", "c", "d", None);
        assert_eq!(one, of("a", "b", "c", "d", None));
        for other in [
            of("x", "b", "c", "d", None),
            of("a", "x", "c", "d", None),
            of("a", "b", "x", "d", None),
            of("a", "b", "c", "x", None),
            of("a", "b", "c", "d", Some(0)),
            of("ab", "", "c", "d", None),
        ] {
            assert_ne!(one, other);
        }
    }
}
