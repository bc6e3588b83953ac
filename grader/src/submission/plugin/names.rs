//! The names of a module's functions, from its name section, for messages.

use std::collections::BTreeMap;

use wasmparser::{KnownCustom, Name, Parser, Payload};

/// Names by the index of the function.
#[derive(Debug, Default)]
pub(super) struct FunctionNames(BTreeMap<u32, String>);

/// Longer names are cut.
const LONGEST: usize = 100;

impl FunctionNames {
    /// The names in a module's name section; none where there is no section that can be read. It is not part of what a module means, so
    /// nothing in it is an error.
    pub(super) fn of(module: &[u8]) -> Self {
        let mut names = BTreeMap::new();
        for payload in Parser::new(0).parse_all(module) {
            let Ok(Payload::CustomSection(section)) = payload else {
                if payload.is_err() {
                    break;
                }
                continue;
            };
            let KnownCustom::Name(subsections) = section.as_known() else {
                continue;
            };
            for subsection in subsections {
                let Ok(Name::Function(functions)) = subsection else {
                    continue;
                };
                for function in functions.into_iter().map_while(Result::ok) {
                    names.insert(function.index, readable(function.name));
                }
            }
        }
        Self(names)
    }

    /// The name of the function with this index.
    pub(super) fn get(&self, index: u32) -> Option<&str> {
        self.0.get(&index).map(String::as_str)
    }
}

/// A name as its author wrote it: without the mangling of the Rust compiler, and without the hash that it adds, `::h0123456789abcdef`.
fn readable(name: &str) -> String {
    let demangled = rustc_demangle::try_demangle(name).map(|name| format!("{name:#}"));
    let name = demangled.as_deref().unwrap_or(name);
    let plain = match name.rsplit_once("::h") {
        Some((path, hash))
            if hash.len() == 16 && hash.bytes().all(|byte| byte.is_ascii_hexdigit()) =>
        {
            path
        }
        _ => name,
    };
    plain.chars().take(LONGEST).collect()
}
