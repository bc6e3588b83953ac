//! The reference of checks in docs/lab-format.md, made from the list of kinds, the first comment of each file and its table's keys.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use schemars::Schema;
use serde_json::Value;

use super::kind::KINDS;
use super::registry::Kind;

const BEGIN: &str = "<!-- checks: generated -->\n";
const END: &str = "<!-- /checks -->";

fn in_repository(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(path)
}

fn source_of(kind: &Kind) -> String {
    let path = format!("grader/src/check/kind/{}.rs", kind.module);
    std::fs::read_to_string(in_repository(&path)).expect("a file of this kind")
}

/// Rustdoc's brackets as Markdown has them.
fn plain(text: &str) -> String {
    text.replace("\\[", "[").replace("\\]", "]")
}

/// The first comment of a file, paragraph by paragraph, without the kind's name.
fn paragraphs(kind: &Kind) -> Vec<String> {
    let source = source_of(kind);
    let lines = source.lines().map_while(|line| line.strip_prefix("//!"));
    let text: Vec<&str> = lines
        .map(|line| line.strip_prefix(' ').unwrap_or(line))
        .collect();
    let text = text.join("\n");
    let begin = format!("{}: ", kind.name);
    let text = text
        .strip_prefix(&begin)
        .unwrap_or_else(|| panic!("{}.rs begins with `//! {begin}`", kind.module));
    let (first, rest) = text.split_at(1);
    let text = format!("{}{rest}", first.to_uppercase());
    text.split("\n\n").map(plain).collect()
}

/// One row per key: name, type, whether it is needed, and its comment.
fn keys(schema: &Value, within: &str, rows: &mut String) {
    let required = schema["required"].as_array();
    let is_required =
        |key: &str| required.is_some_and(|keys| keys.iter().any(|known| known == key));
    let properties = schema["properties"].as_object();
    for (key, property) in properties.into_iter().flatten() {
        let needed = if is_required(key) { "yes" } else { "" };
        let comment = property["description"].as_str().unwrap_or_default();
        let comment = plain(comment).replace('\n', " ");
        let _ = writeln!(rows, "| `{within}{key}` | {needed} | {comment} |");
    }
}

/// Tables inside the table of a kind, by the key under which they stand.
fn inner<'s>(schema: &'s Value, key: &str) -> Option<&'s Value> {
    let property = &schema["properties"][key];
    let options = property["anyOf"].as_array().into_iter().flatten();
    let candidates = [property, &property["items"]].into_iter().chain(options);
    let reference = candidates
        .filter_map(|value| value["$ref"].as_str())
        .next()?;
    let name = reference.strip_prefix("#/$defs/")?;
    Some(&schema["$defs"][name]).filter(|found| found["properties"].is_object())
}

fn section(kind: &Kind) -> String {
    let mut text = format!("##### {}\n\n{}\n", kind.name, paragraphs(kind).join("\n\n"));
    let schema: Schema = (kind.schema)();
    let schema = schema.as_value();
    let mut rows = String::new();
    keys(schema, "", &mut rows);
    for key in schema["properties"]
        .as_object()
        .into_iter()
        .flatten()
        .map(|(key, _)| key)
    {
        let Some(table) = inner(schema, key) else {
            continue;
        };
        keys(table, &format!("{key}."), &mut rows);
        let definitions = &schema["$defs"];
        for deeper in table["properties"]
            .as_object()
            .into_iter()
            .flatten()
            .map(|(key, _)| key)
        {
            let mut within = table.clone();
            within["$defs"] = definitions.clone();
            if let Some(table) = inner(&within, deeper) {
                keys(table, &format!("{key}.{deeper}."), &mut rows);
            }
        }
    }
    if rows.is_empty() {
        text += "\nIt has no keys: write `{}`.\n";
    } else {
        let _ = write!(text, "\n| key | needed | meaning |\n|---|---|---|\n{rows}");
    }
    text
}

fn reference() -> String {
    let mut text = String::new();
    for (title, of_motion) in [("Of function tasks", false), ("Of motion tasks", true)] {
        let _ = write!(
            text,
            "#### {title}\n\n| kind | what is measured |\n|---|---|\n"
        );
        let kinds: Vec<&Kind> = KINDS
            .iter()
            .filter(|kind| kind.of_motion == of_motion)
            .collect();
        for kind in &kinds {
            let first = paragraphs(kind).swap_remove(0).replace('\n', " ");
            let _ = writeln!(text, "| [`{0}`](#{0}) | {first} |", kind.name);
        }
        for kind in kinds {
            let _ = write!(text, "\n{}", section(kind));
        }
        text.push('\n');
    }
    text
}

/// The reference is that of the code; `KINEMARK_BLESS=1` writes it anew.
#[test]
fn the_reference_of_checks_is_current() {
    let path = in_repository("docs/lab-format.md");
    let page = std::fs::read_to_string(&path).expect("docs/lab-format.md");
    let (before, rest) = page.split_once(BEGIN).expect("where the reference begins");
    let (_, after) = rest.split_once(END).expect("where it ends");
    let current = format!("{before}{BEGIN}{}{END}{after}", reference());
    if std::env::var_os("KINEMARK_BLESS").is_some() {
        std::fs::write(&path, &current).expect("docs/lab-format.md is written");
    }
    assert!(
        page == current,
        "docs/lab-format.md: run KINEMARK_BLESS=1 cargo test"
    );
}

#[test]
fn every_file_of_a_kind_is_in_the_list_and_named_after_it() {
    let folder = in_repository("grader/src/check/kind");
    let files = std::fs::read_dir(folder).expect("the folder of kinds");
    let names = files.map(|file| {
        file.expect("a file")
            .file_name()
            .into_string()
            .expect("a name")
    });
    let mut files: Vec<String> = names.filter(|name| name != "mod.rs").collect();
    files.sort_unstable();
    let mut listed: Vec<String> = KINDS
        .iter()
        .map(|kind| format!("{}.rs", kind.module))
        .collect();
    listed.sort_unstable();
    assert_eq!(listed, files);
    for kind in KINDS {
        assert_eq!(kind.module.replace('_', "-"), kind.name);
    }
}
