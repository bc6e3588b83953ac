//! No function of the product is longer than a screen: one over 80 lines says why, in a line `// long: ...` above it.
//!
//! The sources are formatted, so a function ends at the first `}` that is indented as its `fn` is.

use std::path::{Path, PathBuf};

use crate::testbed::root;

/// Lines a function may have, its signature and its last brace among them.
const LONGEST: usize = 80;

/// Folders with code of the product.
const SOURCES: [&str; 7] = [
    "sim/src",
    "sim/toolbox/src",
    "grader/src",
    "grader/report/src",
    "grader/course/src",
    "grader/cli/src",
    "reference/src",
];

/// A function with more lines than it may have.
#[derive(Debug, PartialEq, Eq)]
struct TooLong {
    line: usize,
    name: String,
    lines: usize,
}

/// The functions of `text` that are too long and do not say why, outside of test modules.
fn too_long(text: &str) -> Vec<TooLong> {
    let lines: Vec<&str> = text.lines().collect();
    let indent = |line: &str| line.len() - line.trim_start().len();
    let end = |start: usize| {
        let closes = |line: &&str| {
            indent(line) == indent(lines[start]) && line.trim_start().starts_with('}')
        };
        let after = lines[start..].iter().position(closes);
        start + after.unwrap_or(lines.len() - 1 - start)
    };
    let mut found = Vec::new();
    let mut i = 0;
    while i < lines.len() {
        if lines[i].trim() == "#[cfg(test)]"
            && lines.get(i + 1).is_some_and(|next| next.ends_with('{'))
        {
            i = end(i + 1);
        }
        let length = end(i) + 1 - i;
        if let (Some(name), true) = (function_name(lines[i]), length > LONGEST) {
            let above = lines[..i].iter().rev().map(|line| line.trim());
            let mut above =
                above.take_while(|line| line.starts_with("//") || line.starts_with("#["));
            if !above.any(|line| line.starts_with("// long: ")) {
                found.push(TooLong {
                    line: i + 1,
                    name,
                    lines: length,
                });
            }
        }
        i += 1;
    }
    found
}

/// The name of the function whose body begins with `line` or after it.
fn function_name(line: &str) -> Option<String> {
    let mut words = line.split_whitespace();
    let qualifier = |word: &str| {
        word.starts_with("pub") || ["const", "async", "unsafe", "in", "crate::"].contains(&word)
    };
    let mut word = words.next()?;
    while qualifier(word) || word.ends_with(')') && !word.contains("fn") {
        word = words.next()?;
    }
    let name = words.next()?;
    let end = name
        .find(|c: char| !c.is_alphanumeric() && c != '_')
        .unwrap_or(name.len());
    (word == "fn" && !line.ends_with(';')).then(|| name[..end].to_owned())
}

fn rust_files(folder: &Path, files: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).expect("a folder of sources") {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            if path.file_name().is_none_or(|name| name != "tests") {
                rust_files(&path, files);
            }
        } else if path.extension().is_some_and(|extension| extension == "rs")
            // a graded run made up for tests
            && path.file_name().is_none_or(|name| name != "sample.rs")
        {
            files.push(path);
        }
    }
}

#[test]
fn no_function_is_longer_than_a_screen_without_a_reason() {
    let mut files = Vec::new();
    for folder in SOURCES {
        rust_files(&root().join(folder), &mut files);
    }
    assert!(files.len() > 300, "only {} files were read", files.len());
    files.sort();
    let mut complaints = String::new();
    for file in files {
        let text = std::fs::read_to_string(&file).expect("a source");
        for TooLong { line, name, lines } in too_long(&text) {
            let file = file.strip_prefix(root()).expect("below the root").display();
            complaints += &format!("{file}:{line}: `{name}` has {lines} lines\n");
        }
    }
    assert!(
        complaints.is_empty(),
        "name the stages of these and make each a function, or write `// long: why` above:\n{complaints}"
    );
}

#[test]
fn a_long_function_is_found_unless_it_says_why_or_is_a_test() {
    let function = |indent: &str, lines: usize| {
        let body = format!("{indent}    work();\n").repeat(lines - 2);
        format!("{indent}pub(crate) fn walk<T>(at: T) {{\n{body}{indent}}}\n")
    };
    let (short, long) = (function("", LONGEST), function("", LONGEST + 1));
    assert_eq!(too_long(&short), []);
    let expected = TooLong {
        line: 83,
        name: "walk".to_owned(),
        lines: 81,
    };
    assert_eq!(too_long(&format!("{short}\n\n{long}")), [expected]);
    assert_eq!(
        too_long(&format!("// long: a table, row by row\n#[inline]\n{long}")),
        []
    );
    assert_eq!(
        too_long(&format!(
            "#[cfg(test)]\nmod tests {{\n{}}}\n",
            function("    ", 90)
        )),
        []
    );
    assert_eq!(
        too_long(&format!("impl Walk {{\n{}}}\n", function("    ", 90))).len(),
        1
    );
}
