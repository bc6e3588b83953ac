//! lab.toml as it is typed: what an audit needs beyond what the lab became.

use toml::{Table, Value};

use crate::lab::Lab;

/// The file as a table; a lab that was loaded has one.
pub(in crate::audit) fn table(lab: &Lab) -> Option<Table> {
    lab.source.text().parse().ok()
}

/// A number, with a point or without.
pub(in crate::audit) fn number(value: &Value) -> Option<f64> {
    let integer = || value.as_integer().map(|integer| integer as f64);
    value.as_float().or_else(integer)
}

/// The tables of the list called `list`.
pub(in crate::audit) fn tables<'t>(table: &'t Table, list: &str) -> Vec<&'t Table> {
    let items = table.get(list).and_then(Value::as_array);
    let items = items.into_iter().flatten();
    items.filter_map(Value::as_table).collect()
}

/// What a table says is its `name`; empty where it says none.
pub(in crate::audit) fn name(table: &Table) -> &str {
    table
        .get("name")
        .and_then(Value::as_str)
        .unwrap_or_default()
}

/// The table of this name in the list called `list`.
pub(in crate::audit) fn named<'t>(table: &'t Table, list: &str, wanted: &str) -> Option<&'t Table> {
    let mut all = tables(table, list).into_iter();
    all.find(|table| name(table) == wanted)
}

/// The kind of a check with its keys: its only table.
pub(in crate::audit) fn kind(check: &Table) -> Option<(&str, &Table)> {
    let mut entries = check.iter();
    entries.find_map(|(key, value)| Some((key.as_str(), value.as_table()?)))
}
