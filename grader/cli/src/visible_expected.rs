//! What visible cases of functions of a lab's own are to answer, written into lab.toml from the reference solution: all else of the file
//! stays as it was typed.

use kinemark_grader::judge::answers_of;
use kinemark_grader::lab::Lab;
use kinemark_grader::task::files::{Files, Replaced};
use kinemark_grader::task::problem::LoadError;
use kinemark_grader::task::value::Value;
use kinemark_sim::text::Source;
use toml_edit::{Array, ArrayOfTables, DocumentMut, InlineTable, Item, TableLike};

/// A lab.toml in which cases wait for what is expected of them.
pub(crate) struct Waiting {
    path: String,
    document: DocumentMut,
    /// Index of a task and of a case in it, in the order of the file.
    cases: Vec<[usize; 2]>,
}

/// Why a case cannot be filled.
#[derive(Debug, thiserror::Error)]
pub(crate) enum Unfilled {
    /// The solution has no answer.
    #[error("task `{task}`: {why}")]
    NoAnswer { task: String, why: String },
    /// What it answers cannot stand in a lab.
    #[error(
        "case `{case}` of task `{task}`: the solution answers {what}, which no lab file can expect"
    )]
    NoNumber {
        task: String,
        case: String,
        what: String,
    },
}

impl Waiting {
    /// The cases of `text`, the lab.toml at `path`, that give something and do not say what is expected; with `all`, also those that say
    /// it. `None` where there are none, or where the text is no TOML, which loading it explains better.
    pub(crate) fn find(path: &str, text: &str, all: bool) -> Option<Self> {
        let document: DocumentMut = text.parse().ok()?;
        let mut cases = Vec::new();
        for (task, table) in tasks(&document).enumerate() {
            let given = table
                .get("function")
                .and_then(|function| function.get("cases"));
            for (case, table) in given.into_iter().flat_map(tables).enumerate() {
                if table.contains_key("given") && (all || !table.contains_key("expected")) {
                    cases.push([task, case]);
                }
            }
        }
        (!cases.is_empty()).then(|| Self {
            path: path.to_owned(),
            document,
            cases,
        })
    }

    /// The lab called `name` as it will be, but for what is expected of these cases.
    ///
    /// # Errors
    /// [`LoadError`] where something else in it is wrong.
    pub(crate) fn lab(&self, files: &dyn Files, name: &str) -> Result<Lab, LoadError> {
        let mut document = self.document.clone();
        for &[task, case] in &self.cases {
            // cases of one task expect entries of the same names
            let stated = tasks(&self.document).nth(task).and_then(|task| {
                let cases = task.get("function")?.get("cases")?;
                let mut stated = tables(cases).filter_map(|case| case.get("expected")?.as_value());
                stated.next().cloned()
            });
            let unknown = || {
                tasks(&self.document)
                    .nth(task)
                    .map_or(0.0.into(), of_entries)
            };
            put(&mut document, [task, case], stated.unwrap_or_else(unknown));
        }
        let text = document.to_string();
        let files = Replaced {
            path: self.path.clone(),
            text: &text,
            rest: files,
        };
        Lab::load(&files, name)
    }

    /// The text of lab.toml with what `solution` answers in `lab`, which is [`Self::lab`].
    ///
    /// # Errors
    /// [`Unfilled`] where it has no answer, or one that is no number, list or matrix, or a map of these.
    pub(crate) fn filled(&self, lab: &Lab, solution: &Source) -> Result<String, Unfilled> {
        let mut document = self.document.clone();
        for (index, task) in lab.tasks.iter().enumerate() {
            let here: Vec<usize> = self
                .cases
                .iter()
                .filter_map(|&[task, case]| (task == index).then_some(case))
                .collect();
            if here.is_empty() {
                continue;
            }
            let answers = answers_of(lab, task, solution).map_err(|why| Unfilled::NoAnswer {
                task: task.name.clone(),
                why,
            })?;
            for case in here {
                let answer = answers.get(case).unwrap_or(&Value::Nothing);
                let typed = typed(answer).map_err(|what| Unfilled::NoNumber {
                    task: task.name.clone(),
                    case: self.name_of([index, case]),
                    what,
                })?;
                put(&mut document, [index, case], typed);
            }
        }
        Ok(document.to_string())
    }

    fn name_of(&self, [task, case]: [usize; 2]) -> String {
        let name = tasks(&self.document).nth(task).and_then(|task| {
            let case = tables(task.get("function")?.get("cases")?).nth(case)?;
            Some(case.get("name")?.as_str()?.to_owned())
        });
        name.unwrap_or_default()
    }
}

/// What stands for an answer that nobody knows yet: zero, or zeros by the names of the entries that the task speaks of.
fn of_entries(task: &dyn TableLike) -> toml_edit::Value {
    let checks = task.get("checks").into_iter().flat_map(tables);
    let read = checks.filter_map(|check| {
        let kind = check.get("function-cases")?.as_table_like()?;
        Some(kind.get("entry")?.as_str()?.to_owned())
    });
    let turns = task
        .get("function")
        .and_then(|function| function.get("turns")?.as_array());
    let turning = turns.into_iter().flatten();
    let turning = turning.filter_map(|name| Some(name.as_str()?.to_owned()));
    let mut zeros = InlineTable::new();
    for name in read.chain(turning) {
        zeros.insert(&name, 0.0.into());
    }
    match zeros.is_empty() {
        true => 0.0.into(),
        false => zeros.into(),
    }
}

/// The tables of `[[tasks]]`.
fn tasks(document: &DocumentMut) -> impl Iterator<Item = &dyn TableLike> {
    document.get("tasks").into_iter().flat_map(tables)
}

/// The tables of a list, whichever way it is typed.
fn tables(list: &Item) -> Box<dyn Iterator<Item = &dyn TableLike> + '_> {
    match list {
        Item::ArrayOfTables(tables) => Box::new(ArrayOfTables::iter(tables).map(as_like)),
        Item::Value(toml_edit::Value::Array(array)) => Box::new(
            array
                .iter()
                .filter_map(toml_edit::Value::as_inline_table)
                .map(as_like),
        ),
        _ => Box::new(std::iter::empty()),
    }
}

fn as_like<T: TableLike>(table: &T) -> &dyn TableLike {
    table
}

/// Puts what is expected of a case at its end, or in the place of what is there.
fn put(document: &mut DocumentMut, [task, case]: [usize; 2], expected: toml_edit::Value) {
    let cases = document
        .get_mut("tasks")
        .and_then(|tasks| nth(tasks, task))
        .and_then(|task| task.get_mut("function")?.get_mut("cases"));
    match cases {
        Some(Item::ArrayOfTables(tables)) => {
            if let Some(table) = tables.get_mut(case) {
                table.insert("expected", Item::Value(expected));
            }
        }
        Some(Item::Value(toml_edit::Value::Array(array))) => {
            let table = array
                .iter_mut()
                .filter_map(|value| value.as_inline_table_mut());
            if let Some(table) = table.into_iter().nth(case) {
                append(table, expected);
            }
        }
        _ => {}
    }
}

/// The table with this index of a list, whichever way it is typed.
fn nth(list: &mut Item, index: usize) -> Option<&mut dyn TableLike> {
    match list {
        Item::ArrayOfTables(tables) => tables
            .get_mut(index)
            .map(|table| table as &mut dyn TableLike),
        Item::Value(toml_edit::Value::Array(array)) => {
            let table = array.get_mut(index)?.as_inline_table_mut()?;
            Some(table as &mut dyn TableLike)
        }
        _ => None,
    }
}

/// Adds `expected` to a table in braces; the space before the closing brace stays there.
fn append(table: &mut InlineTable, expected: toml_edit::Value) {
    if let Some(there) = table.get_mut("expected") {
        let decor = there.decor().clone();
        *there = expected;
        *there.decor_mut() = decor;
        return;
    }
    let mut expected = expected;
    if let Some((_, last)) = table.iter_mut().last() {
        let space = last.decor().suffix().cloned();
        last.decor_mut().set_suffix("");
        expected.decor_mut().set_prefix(" ");
        expected.decor_mut().set_suffix(space.unwrap_or_default());
    }
    table.insert("expected", expected);
}

/// An answer as a lab file has it; what it is where none can.
fn typed(answer: &Value) -> Result<toml_edit::Value, String> {
    Ok(match answer {
        // with an exponent where it is tiny, not with sixteen zeros
        Value::Number(number) if number.is_finite() => format!("{number:?}")
            .parse()
            .unwrap_or_else(|_| (*number).into()),
        Value::Number(number) => return Err(number.to_string()),
        Value::List(values) => {
            let values: Result<Array, String> = values.iter().map(typed).collect();
            values?.into()
        }
        Value::Map(entries) => {
            let mut table = InlineTable::new();
            for (name, value) in entries {
                table.insert(name, typed(value)?);
            }
            table.into()
        }
        Value::Nothing => return Err("nothing".to_owned()),
        Value::Boolean(value) => return Err(value.to_string()),
        Value::Text(text) => return Err(format!("the text {text:?}")),
        Value::Other(kind) => return Err(format!("a value of type {kind}")),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const LAB: &str = r#"# a comment
[[tasks]]
name = "fk"
[tasks.function]
call = "forward_kinematics"
cases = [{ name = "up", q_rad = [0.0] }]

[[tasks]]
name = "ratio"   # its own
[tasks.function]
call = "ratio"
cases = [
    { name = "one", given = { x = 1.0 } },   # to be filled
    { name = "two", given = { x = 2.0 }, expected = 9.5 },
]

[[tasks]]
name = "roots"
[tasks.function]
call = "roots"

[[tasks.function.cases]]
name = "whole"
given = { b = -3.0, c = 2.0 }
"#;

    fn put_all(all: bool) -> String {
        let waiting = Waiting::find("lab.toml", LAB, all).expect("cases");
        let mut document = waiting.document.clone();
        for case in waiting.cases {
            let answer = Value::Map(vec![(
                "roots".to_owned(),
                Value::List(vec![Value::Number(1.0), Value::Number(0.1 + 0.2)]),
            )]);
            put(&mut document, case, typed(&answer).expect("a value"));
        }
        document.to_string()
    }

    #[test]
    fn what_is_missing_is_added_and_all_else_stays() {
        let entry = "expected = { roots = [1.0, 0.30000000000000004] }";
        let wanted = LAB
            .replace(
                "{ x = 1.0 } },   # to",
                &format!("{{ x = 1.0 }}, {entry} }},   # to"),
            )
            .replace("c = 2.0 }\n", &format!("c = 2.0 }}\n{entry}\n"));
        assert_eq!(put_all(false), wanted);
        assert_eq!(put_all(true), wanted.replace("expected = 9.5", entry));
    }

    #[test]
    fn what_no_lab_can_expect_is_named() {
        let refused = [
            (Value::Nothing, "nothing"),
            (Value::Number(f64::NAN), "NaN"),
            (
                Value::List(vec![Value::Text("a".to_owned())]),
                "the text \"a\"",
            ),
        ];
        for (value, words) in refused {
            assert_eq!(typed(&value).expect_err("refused"), words);
        }
        assert!(Waiting::find("lab.toml", "[[tasks", false).is_none());
    }
}
