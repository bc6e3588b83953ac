//! What `observation.target` holds, from what a lab wrote: any value of TOML that the language of submissions has too.

use kinemark_sim::text::Spanned;

use super::Reader;
use crate::submission::controller::Budgets;
use crate::task::problem::{LabError, problems};
use crate::task::value::Value;

problems! {
    /// What a target cannot hold.
    enum TargetProblem {
        Date:
            "lab::target", "a target holds numbers, strings, booleans, lists and tables of them", "a date or a time in it",
            "write a date as a string, in quotes";
        TooLong { most: u64, values: u64 }:
            "lab::target", "a target holds at most {most} values, this one {values}", "too long",
            "give submissions the few numbers that the rest follows from";
    }
}

impl Reader<'_> {
    pub(super) fn target(&self, typed: &Spanned<toml::Value>) -> Result<Value, LabError> {
        let mut values = 0;
        let Some(value) = value(typed.get_ref(), &mut values) else {
            return self.report.refuse_at(typed, TargetProblem::Date);
        };
        // more would be over the budgets of whoever copies it
        let most = Budgets::default().list_size;
        if values > most {
            let problem = TargetProblem::TooLong { most, values };
            return self.report.refuse_at(typed, problem);
        }
        Ok(value)
    }
}

/// The value as submissions get it; `None` where it holds a date. Counts its parts in `values`.
fn value(typed: &toml::Value, values: &mut u64) -> Option<Value> {
    *values += 1;
    Some(match typed {
        toml::Value::String(text) => Value::Text(text.clone()),
        toml::Value::Integer(whole) => Value::Number(*whole as f64),
        toml::Value::Float(number) => Value::Number(*number),
        toml::Value::Boolean(truth) => Value::Boolean(*truth),
        toml::Value::Datetime(_) => return None,
        toml::Value::Array(items) => Value::List(
            items
                .iter()
                .map(|item| value(item, values))
                .collect::<Option<_>>()?,
        ),
        toml::Value::Table(table) => Value::Map(
            table
                .iter()
                .map(|(key, item)| Some((key.clone(), value(item, values)?)))
                .collect::<Option<_>>()?,
        ),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_value_but_a_date_has_its_like_in_a_script() {
        let table: toml::Table = toml::from_str(
            r#"v = { move = "line", by = [1, 2.5], fast = true, rows = [[0, 1], []] }"#,
        )
        .unwrap();
        let list =
            |numbers: &[f64]| Value::List(numbers.iter().map(|x| Value::Number(*x)).collect());
        let mut values = 0;
        assert_eq!(
            value(&table["v"], &mut values),
            Some(Value::Map(vec![
                ("by".to_owned(), list(&[1.0, 2.5])),
                ("fast".to_owned(), Value::Boolean(true)),
                ("move".to_owned(), Value::Text("line".to_owned())),
                (
                    "rows".to_owned(),
                    Value::List(vec![list(&[0.0, 1.0]), list(&[])])
                ),
            ]))
        );
        assert_eq!(values, 11);
        let table: toml::Table = toml::from_str("v = [2026-01-01]").unwrap();
        assert_eq!(value(&table["v"], &mut 0), None);
    }
}
