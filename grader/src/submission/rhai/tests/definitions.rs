//! The definitions for editors against the language as it is, and the index of functions in its reference, which is made from them.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;
use std::path::Path;
use std::rc::Rc;

use crate::submission::controller::Budgets;
use crate::submission::rhai::{DEFINITIONS, budget::Meter, engine};
use crate::task::grant::Grant;

const BEGIN: &str = "<!-- functions: begin -->\n";
const END: &str = "<!-- functions: end -->";

/// One function of the definitions.
struct Defined {
    name: &'static str,
    /// `(x: number, y: number) -> number`.
    signature: &'static str,
    /// The names of its parameters.
    parameters: Vec<&'static str>,
    says: &'static str,
}

/// The functions in the order of the file; the line above each says what it does.
fn defined() -> Vec<Defined> {
    let lines: Vec<&str> = DEFINITIONS.lines().collect();
    let pairs = lines
        .windows(2)
        .filter_map(|pair| Some((pair[0], pair[1].strip_prefix("fn ")?)));
    pairs
        .map(|(above, line)| {
            let at = line.find('(').expect("parameters");
            let (name, signature) = line.split_at(at);
            let signature = signature.strip_suffix(';').expect("a `;`");
            let (inside, _) = signature[1..].split_once(')').expect("a `)`");
            let named = |part: &'static str| part.split(':').next().expect("a name").trim();
            Defined {
                name,
                signature,
                parameters: match inside {
                    "" => Vec::new(),
                    _ => inside.split(", ").map(named).collect(),
                },
                says: above.strip_prefix("/// ").expect("what it does"),
            }
        })
        .collect()
}

#[test]
fn every_function_is_defined_with_its_numbers_of_arguments() {
    let meter = Rc::new(Meter::new(Budgets::default()));
    let (_, names) = engine::build(&Budgets::default(), &meter, &Rc::default(), None);
    let mut built_in = names.built_in;
    for grant in Grant::ALL {
        built_in
            .entry(grant.name().to_owned())
            .or_default()
            .insert(2);
    }
    let mut found: BTreeMap<String, BTreeSet<usize>> = BTreeMap::new();
    for function in defined() {
        let counts = found.entry(function.name.to_owned()).or_default();
        if function.parameters == ["...values"] {
            // any number of them: as many as there are
            counts.extend(&built_in[function.name]);
        } else {
            counts.insert(function.parameters.len());
        }
        assert!(function.says.ends_with('.'), "{}", function.name);
    }
    assert_eq!(found, built_in);
    for constant in &names.constants {
        assert!(
            DEFINITIONS.contains(&format!("const {constant}: number;")),
            "{constant}"
        );
    }
}

/// The index in docs/script-language.md is made from the definitions; `KINEMARK_BLESS=1` writes it anew.
#[test]
fn the_index_of_functions_is_current() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/script-language.md");
    let page = std::fs::read_to_string(&path).expect("docs/script-language.md");
    let (before, rest) = page.split_once(BEGIN).expect("where the index begins");
    let (_, after) = rest.split_once(END).expect("where it ends");
    let mut functions = defined();
    functions.sort_by_key(|function| (function.name.to_lowercase(), function.parameters.len()));
    let mut index = "\n| function | returns | what it does |\n|---|---|---|\n".to_owned();
    for function in &functions {
        let returns = function
            .signature
            .split_once(" -> ")
            .map_or("", |(_, kind)| kind);
        let _ = writeln!(
            index,
            "| `{}({})` | {} | {} |",
            function.name,
            function.parameters.join(", "),
            returns.replace(" | ", " or ").replace('?', "any"),
            function.says.replace('|', "\\|"),
        );
    }
    let current = format!("{before}{BEGIN}{index}\n{END}{after}");
    if std::env::var_os("KINEMARK_BLESS").is_some() {
        std::fs::write(&path, &current).expect("docs/script-language.md is written");
    }
    assert!(
        page == current,
        "docs/script-language.md: run KINEMARK_BLESS=1 cargo test"
    );
}
