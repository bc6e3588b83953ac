//! The changes that are made to a solution: each kind looks for the parts of the program that it can change, and says what stands there
//! instead.

use std::collections::BTreeMap;

use serde::Serialize;

use crate::submission::rhai::{Bytes, Part, ProgramTree};

/// A program with its parts.
pub(super) struct Program<'p> {
    pub(super) text: &'p str,
    pub(super) tree: &'p ProgramTree,
}

impl<'p> Program<'p> {
    pub(super) fn of(&self, at: &Bytes) -> &'p str {
        self.text.get(at.clone()).unwrap_or_default()
    }

    /// Whether a part is in the brackets of an index.
    fn is_in_index(&self, at: &Bytes) -> bool {
        self.tree.parts.iter().any(|part| match part {
            Part::Index { at: index } => index.start <= at.start && at.end <= index.end,
            _ => false,
        })
    }

    /// A negative number or operand where `at` is, which never forms `--` with what is before it.
    fn negative(&self, at: &Bytes, operand: &str) -> String {
        let before = &self.text[..at.start];
        if before.ends_with('-') {
            format!("(-{operand})")
        } else {
            format!("-{operand}")
        }
    }
}

/// Bytes of the program, and what stands there instead.
pub(super) type Replaced = (Bytes, String);

/// A kind of change: its name, and what it does.
pub(super) struct Operator {
    pub(super) name: &'static str,
    pub(super) find: fn(&Program<'_>, &mut Vec<Replaced>),
}

/// A kind of change in a record.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(transparent)]
pub struct OperatorName(pub &'static str);

/// The kind whose change takes more words than a line has.
pub(super) const DELAY: &str = "delay";

/// The kinds, in the order in which changes of the same place are numbered.
pub(super) const OPERATORS: &[Operator] = &[
    Operator {
        name: "sign",
        find: sign,
    },
    Operator {
        name: "operator",
        find: operator,
    },
    Operator {
        name: "function",
        find: function,
    },
    Operator {
        name: "index",
        find: index,
    },
    Operator {
        name: "order",
        find: order,
    },
    Operator {
        name: "signal",
        find: signal,
    },
    Operator {
        name: "term",
        find: term,
    },
    Operator {
        name: "degrees",
        find: degrees,
    },
    Operator {
        name: "gain",
        find: gain,
    },
    Operator {
        name: "constant",
        find: constant,
    },
    Operator {
        name: "condition",
        find: condition,
    },
    Operator {
        name: DELAY,
        find: delay,
    },
];

/// The sign of a number, of an operand, and of a result that has two.
fn sign(program: &Program<'_>, found: &mut Vec<Replaced>) {
    for part in &program.tree.parts {
        match part {
            Part::Number { at, value, .. } if *value != 0.0 && !program.is_in_index(at) => {
                let text = program.of(at);
                let other = match text.strip_prefix('-') {
                    Some(positive) => positive.to_owned(),
                    None => program.negative(at, text),
                };
                found.push((at.clone(), other));
            }
            Part::Minus { at } => found.push((at.clone(), String::new())),
            Part::Call { name, whole, .. } if matches!(program.of(name), "sqrt" | "acos") => {
                found.push((whole.clone(), program.negative(whole, program.of(whole))));
            }
            _ => {}
        }
    }
}

/// An operator for its opposite.
fn operator(program: &Program<'_>, found: &mut Vec<Replaced>) {
    for part in &program.tree.parts {
        let (Part::Operator { at, .. } | Part::Change { at }) = part else {
            continue;
        };
        let other = match program.of(at) {
            "+" => "-",
            "-" => "+",
            "*" => "/",
            "/" | "**" => "*",
            "+=" => "-=",
            "-=" => "+=",
            "*=" => "/=",
            "/=" => "*=",
            _ => continue,
        };
        found.push((at.clone(), other.to_owned()));
    }
}

/// A function for its partner.
fn function(program: &Program<'_>, found: &mut Vec<Replaced>) {
    for part in &program.tree.parts {
        let Part::Call {
            name,
            whole,
            arguments,
        } = part
        else {
            continue;
        };
        let other = match program.of(name) {
            "sin" => "cos",
            "cos" => "sin",
            "asin" => "acos",
            "acos" => "asin",
            "min" => "max",
            "max" => "min",
            "floor" => "ceil",
            "ceil" => "floor",
            "atan2" => {
                if let [y, x] = arguments.as_slice() {
                    let quotient = format!("atan(({}) / ({}))", program.of(y), program.of(x));
                    found.push((whole.clone(), quotient));
                }
                continue;
            }
            _ => continue,
        };
        found.push((name.clone(), other.to_owned()));
    }
}

/// An index for its neighbour, and a variable such as `l1` for another one that differs in its number.
fn index(program: &Program<'_>, found: &mut Vec<Replaced>) {
    let parts = &program.tree.parts;
    let is_end_of_range = |at: &Bytes| {
        parts.iter().any(|part| match part {
            Part::Operator {
                at: operator,
                left,
                right,
            } => program.of(operator).starts_with("..") && (left == at || right == at),
            _ => false,
        })
    };
    let is_whole_index = |at: &Bytes| {
        let mut parts = parts.iter();
        parts.any(|part| matches!(part, Part::Index { at: index } if index == at))
    };
    let siblings = numbered(program);
    for part in parts {
        match part {
            Part::Number {
                at,
                value,
                is_whole: true,
            } if program.is_in_index(at) && (is_whole_index(at) || is_end_of_range(at)) => {
                let other = if *value >= 1.0 {
                    value - 1.0
                } else {
                    value + 1.0
                };
                found.push((at.clone(), other.to_string()));
            }
            Part::Name { at } => {
                let others = siblings.iter().filter(|(name, function)| {
                    function.start <= at.start
                        && at.end <= function.end
                        && *name != program.of(at)
                        && stem(name) == stem(program.of(at))
                        && is_numbered(program.of(at))
                });
                found.extend(others.map(|(name, _)| (at.clone(), (*name).to_owned())));
            }
            _ => {}
        }
    }
}

/// The variables with a number at their end, each with the function that declares it.
fn numbered<'p>(program: &Program<'p>) -> Vec<(&'p str, Bytes)> {
    let declared = program.tree.parts.iter().filter_map(|part| match part {
        Part::Declaration { name, .. } => Some(name),
        _ => None,
    });
    let in_function = declared.filter_map(|name| {
        let mut functions = program.tree.functions.iter();
        let around = functions
            .find(|known| known.whole.start <= name.start && name.end <= known.whole.end)?;
        Some((program.of(name), around.whole.clone()))
    });
    in_function.filter(|(name, _)| is_numbered(name)).collect()
}

fn stem(name: &str) -> &str {
    name.trim_end_matches(|c: char| c.is_ascii_digit())
}

fn is_numbered(name: &str) -> bool {
    name.ends_with(|c: char| c.is_ascii_digit())
}

/// Neighbours in a list and among arguments, exchanged.
fn order(program: &Program<'_>, found: &mut Vec<Replaced>) {
    for part in &program.tree.parts {
        let (Part::List { elements }
        | Part::Call {
            arguments: elements,
            ..
        }) = part
        else {
            continue;
        };
        // the title of a plot, say
        let is_text = |at: &Bytes| program.of(at).starts_with(['"', '`']);
        if matches!(part, Part::Call { .. }) && elements.iter().any(is_text) {
            continue;
        }
        for pair in elements.windows(2) {
            let (one, other) = (&pair[0], &pair[1]);
            if program.of(one) != program.of(other) {
                let between = program.of(&(one.end..other.start));
                let exchanged = format!("{}{between}{}", program.of(other), program.of(one));
                found.push((one.start..other.end, exchanged));
            }
        }
    }
}

/// Positions for velocities, and the reverse.
fn signal(program: &Program<'_>, found: &mut Vec<Replaced>) {
    for part in &program.tree.parts {
        let Part::Property { at, .. } = part else {
            continue;
        };
        let other = match program.of(at) {
            "q" => "qd",
            "qd" => "q",
            _ => continue,
        };
        found.push((at.clone(), other.to_owned()));
    }
}

/// One operand left out.
fn term(program: &Program<'_>, found: &mut Vec<Replaced>) {
    for part in &program.tree.parts {
        let Part::Operator { at, left, right } = part else {
            continue;
        };
        let whole = left.start..right.end;
        let [before, behind] = [left, right].map(|at| program.of(at).to_owned());
        match program.of(at) {
            "+" | "*" | "&&" | "||" => {
                found.push((whole.clone(), before));
                found.push((whole, behind));
            }
            "-" => {
                let negative = program.negative(&whole, &behind);
                found.push((whole.clone(), before));
                found.push((whole, negative));
            }
            "/" | "**" => found.push((whole, before)),
            _ => {}
        }
    }
}

/// Degrees for radians, and radians for degrees.
fn degrees(program: &Program<'_>, found: &mut Vec<Replaced>) {
    for part in &program.tree.parts {
        let angle = match part {
            Part::Call {
                name,
                whole,
                arguments,
            } => match (program.of(name), arguments.as_slice()) {
                ("sin" | "cos" | "tan", [angle]) => angle,
                ("asin" | "acos" | "atan" | "atan2", _) => {
                    found.push((whole.clone(), format!("deg({})", program.of(whole))));
                    continue;
                }
                ("deg" | "rad", [angle]) => {
                    found.push((whole.clone(), format!("({})", program.of(angle))));
                    continue;
                }
                _ => continue,
            },
            Part::Property { at, whole } => {
                let name = program.of(at);
                let is_angle = name == "q" || name == "qd";
                if is_angle || name.ends_with("_rad") || name.ends_with("_rad_s") {
                    whole
                } else {
                    continue;
                }
            }
            _ => continue,
        };
        for unit in ["deg", "rad"] {
            found.push((angle.clone(), format!("{unit}({})", program.of(angle))));
        }
    }
}

/// A gain that is a tenth smaller or greater: a constant of the file, a number with a decimal point, or `kp`, `ki` and `kd` of a target.
fn gain(program: &Program<'_>, found: &mut Vec<Replaced>) {
    let parts = &program.tree.parts;
    let is_of_constant = |at: &Bytes| {
        parts.iter().any(|part| match part {
            Part::Declaration {
                value,
                is_constant: true,
                ..
            } => value.start <= at.start && at.end <= value.end,
            _ => false,
        })
    };
    for part in parts {
        match part {
            Part::Number {
                at,
                value,
                is_whole,
            } if *value != 0.0 && !program.is_in_index(at) && (!is_whole || is_of_constant(at)) => {
                for factor in [0.9, 1.1] {
                    found.push((at.clone(), number(value * factor)));
                }
            }
            Part::Property { at, whole } if matches!(program.of(at), "kp" | "ki" | "kd") => {
                for factor in ["0.9", "1.1"] {
                    found.push((whole.clone(), format!("({factor} * {})", program.of(whole))));
                }
            }
            _ => {}
        }
    }
}

/// A number as people write it, without what binary fractions add behind its twelfth digit.
fn number(value: f64) -> String {
    let text = format!("{value:.11e}");
    let rounded: f64 = text.parse().unwrap_or(value);
    let plain = format!("{rounded}");
    match plain.contains(['.', 'e']) {
        true => plain,
        false => plain + ".0",
    }
}

/// 0 and 1 for a number.
fn constant(program: &Program<'_>, found: &mut Vec<Replaced>) {
    for part in &program.tree.parts {
        let Part::Number {
            at,
            value,
            is_whole,
        } = part
        else {
            continue;
        };
        if program.is_in_index(at) {
            continue;
        }
        for other in [0.0_f64, 1.0] {
            // what is typed as 0 or 1 is exactly that
            if value.to_bits() != other.to_bits() {
                let text = if *is_whole {
                    other.to_string()
                } else {
                    number(other)
                };
                found.push((at.clone(), text));
            }
        }
    }
}

/// A comparison the other way round, and the other branch.
fn condition(program: &Program<'_>, found: &mut Vec<Replaced>) {
    let mut equalities = Vec::new();
    for part in &program.tree.parts {
        let Part::Operator { at, left, right } = part else {
            continue;
        };
        let other = match program.of(at) {
            "<" => ">",
            ">" => "<",
            "<=" => ">=",
            ">=" => "<=",
            "==" => "!=",
            "!=" => "==",
            "&&" => "||",
            "||" => "&&",
            _ => continue,
        };
        if matches!(other, "==" | "!=") {
            equalities.push(left.start..right.end);
        }
        found.push((at.clone(), other.to_owned()));
    }
    for part in &program.tree.parts {
        if let Part::Condition { at } = part
            // which is the other branch already
            && !equalities.contains(at)
        {
            found.push((at.clone(), format!("!({})", program.of(at))));
        }
    }
}

/// `control` answers what it should have answered a control period before.
fn delay(program: &Program<'_>, found: &mut Vec<Replaced>) {
    let mut names: BTreeMap<&str, &Bytes> = BTreeMap::new();
    for function in &program.tree.functions {
        names.insert(program.of(&function.name), &function.name);
    }
    let Some(at) = names.get("control") else {
        return;
    };
    // names that the file does not have
    let free = |name: &str| {
        let mut name = name.to_owned();
        while program.text.contains(&name) {
            name.push('_');
        }
        name
    };
    let (punctual, kept) = (free("punctual_control"), free("answer_before"));
    let late = format!(
        "control(observation) {{ let now = this.{punctual}(observation); \
         let late = if \"{kept}\" in this {{ this.{kept} }} else {{ now }}; this.{kept} = now; late }} fn {punctual}"
    );
    found.push(((*at).clone(), late));
}
