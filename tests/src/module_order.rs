//! Inside a crate, modules have one order: an import against the order in docs/architecture.md fails here.
//!
//! The page holds a block for each crate, low to high, one module a line and what it holds behind the name:
//!
//! ````text
//! ```text module-order kinemark-sim
//! text      text from outside
//! model     values
//! ```
//! ````
//!
//! A module may use those above its line. Every module that the root of the crate declares must have a line.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use proc_macro2::{Delimiter, Ident, TokenStream, TokenTree};
use quote::ToTokens;
use syn::{Attribute, Item, ItemMod, Meta, UseTree};

use crate::testbed::root;

/// What marks a block of the page as an order; the name of the crate follows.
const MARK: &str = "```text module-order ";

#[test]
fn modules_use_only_what_stands_above_them() {
    let page = root().join("docs/architecture.md");
    let text = std::fs::read_to_string(&page).expect("the page");
    let folders = crate_folders();
    let orders = orders(&text);
    assert!(
        orders.iter().any(|(name, _)| name == "kinemark-sim"),
        "docs/architecture.md gives no order of kinemark-sim"
    );
    let mut found = Vec::new();
    for (name, order) in orders {
        let folder = folders
            .get(&name)
            .unwrap_or_else(|| panic!("no crate `{name}`"));
        found.extend(violations(&folder.join("src"), &order));
    }
    assert!(
        found.is_empty(),
        "against the order of docs/architecture.md:\n{}",
        found.join("\n")
    );
}

/// The folder of every crate of the workspace.
fn crate_folders() -> BTreeMap<String, PathBuf> {
    let metadata = cargo_metadata::MetadataCommand::new()
        .manifest_path(root().join("Cargo.toml"))
        .no_deps()
        .other_options(vec!["--offline".to_owned()])
        .exec()
        .expect("cargo metadata");
    let folder = |package: &cargo_metadata::Package| {
        let folder = package.manifest_path.parent().expect("a folder");
        (package.name.to_string(), folder.as_std_path().to_owned())
    };
    metadata.packages.iter().map(folder).collect()
}

/// The orders that a page gives: a crate, and its modules from low to high.
fn orders(page: &str) -> Vec<(String, Vec<String>)> {
    let mut orders = Vec::new();
    let mut lines = page.lines();
    while let Some(line) = lines.next() {
        if let Some(name) = line.strip_prefix(MARK) {
            let modules = lines
                .by_ref()
                .take_while(|line| !line.starts_with("```"))
                .filter_map(|line| line.split_whitespace().next())
                .map(str::to_owned);
            orders.push((name.trim().to_owned(), modules.collect()));
        }
    }
    orders
}

/// What goes against `order`, low to high, in the crate whose root lies in the folder `src`; a line for each, with file and line.
///
/// Paths count everywhere: in `use` (nested too), in code, in types and in the input of macros. Comments, strings and
/// whatever is compiled for tests only do not.
fn violations(src: &Path, order: &[String]) -> Vec<String> {
    let root = ["lib.rs", "main.rs"]
        .into_iter()
        .map(|name| src.join(name))
        .find(|path| path.is_file())
        .unwrap_or_else(|| panic!("no root of a crate in {}", src.display()));
    let file = parsed(&root);
    let mut crate_ = Crate::default();
    for item in &file.items {
        crate_.note(item);
    }
    for module in &crate_.modules {
        if !order.contains(module) {
            crate_.found.push(format!(
                "{}: module `{module}` has no line in the order",
                root.display()
            ));
        }
    }
    for name in order {
        if !crate_.modules.contains(name) {
            crate_.found.push(format!(
                "{}: the order names `{name}`, which is not a module",
                root.display()
            ));
        }
    }
    crate_.order = order.to_vec();
    crate_.items(&file.items, &root, src, &mut Vec::new());
    crate_.found
}

fn parsed(path: &Path) -> syn::File {
    let text =
        std::fs::read_to_string(path).unwrap_or_else(|why| panic!("{}: {why}", path.display()));
    syn::parse_file(&text).unwrap_or_else(|why| panic!("{}: {why}", path.display()))
}

/// One crate as it is walked.
#[derive(Default)]
struct Crate {
    order: Vec<String>,
    /// The modules that its root declares.
    modules: Vec<String>,
    /// Names that the root gives on, with the module each is from.
    given_on: BTreeMap<String, String>,
    /// Names of what the root itself defines.
    own: Vec<String>,
    found: Vec<String>,
}

impl Crate {
    /// Takes note of an item of the root.
    fn note(&mut self, item: &Item) {
        match item {
            Item::Mod(module) if is_for_tests(&module.attrs) => {}
            Item::Mod(module) => self.modules.push(module.ident.to_string()),
            Item::Use(given) => {
                let mut names = Vec::new();
                leaves(&given.tree, None, &mut names);
                self.given_on.extend(names);
            }
            Item::Macro(defined) => self
                .own
                .extend(defined.ident.as_ref().map(Ident::to_string)),
            Item::Const(defined) => self.own.push(defined.ident.to_string()),
            Item::Static(defined) => self.own.push(defined.ident.to_string()),
            Item::Fn(defined) => self.own.push(defined.sig.ident.to_string()),
            Item::Struct(defined) => self.own.push(defined.ident.to_string()),
            Item::Enum(defined) => self.own.push(defined.ident.to_string()),
            Item::Trait(defined) => self.own.push(defined.ident.to_string()),
            Item::Type(defined) => self.own.push(defined.ident.to_string()),
            _ => {}
        }
    }

    /// Walks the items of the module `here`, which are in `file`; its child modules have their files in `folder`.
    fn items(&mut self, items: &[Item], file: &Path, folder: &Path, here: &mut Vec<String>) {
        for item in items {
            match item {
                Item::Mod(module) => {
                    if !is_for_tests(&module.attrs) {
                        here.push(module.ident.to_string());
                        self.module(module, file, folder, here);
                        here.pop();
                    }
                }
                other => {
                    if let Item::Macro(given) = other {
                        self.declared_by_macro(given.mac.tokens.clone(), folder, here);
                    }
                    self.tokens(other.to_token_stream(), file, here);
                }
            }
        }
    }

    /// Walks the files whose modules a macro declares: those of `folder` that its input names.
    fn declared_by_macro(&mut self, input: TokenStream, folder: &Path, here: &mut Vec<String>) {
        for token in input {
            if let TokenTree::Ident(name) = token {
                let inside = folder.join(name.to_string());
                let paths = [folder.join(format!("{name}.rs")), inside.join("mod.rs")];
                if let Some(path) = paths.iter().find(|path| path.is_file()) {
                    here.push(name.to_string());
                    self.items(&parsed(path).items, path, &inside, here);
                    here.pop();
                }
            }
        }
    }

    fn module(&mut self, module: &ItemMod, file: &Path, folder: &Path, here: &mut Vec<String>) {
        let name = module.ident.to_string();
        assert!(
            !module
                .attrs
                .iter()
                .any(|attribute| attribute.path().is_ident("path")),
            "{}: module `{name}` lies elsewhere by `#[path]`, where this test does not look",
            file.display()
        );
        let inside = folder.join(&name);
        if let Some((_, items)) = &module.content {
            self.items(items, file, &inside, here);
            return;
        }
        let leaf = folder.join(format!("{name}.rs"));
        let path = if leaf.is_file() {
            leaf
        } else {
            inside.join("mod.rs")
        };
        self.items(&parsed(&path).items, &path, &inside, here);
    }

    /// Looks for paths from the root of the crate in the tokens of one item.
    fn tokens(&mut self, tokens: TokenStream, file: &Path, here: &[String]) {
        let tokens: Vec<TokenTree> = tokens.into_iter().collect();
        let mut at = 0;
        while at < tokens.len() {
            match &tokens[at] {
                TokenTree::Punct(hash) if hash.as_char() == '#' && tests_follow(&tokens[at..]) => {
                    at = after_item(&tokens, at + 2);
                    continue;
                }
                TokenTree::Group(group) => self.tokens(group.stream(), file, here),
                TokenTree::Ident(start) => {
                    let mut climbed = here.to_vec();
                    match start.to_string().as_str() {
                        "crate" => climbed.clear(),
                        "super" => {
                            climbed.pop();
                        }
                        "self" => {}
                        _ => {
                            at += 1;
                            continue;
                        }
                    }
                    // `self` alone is the value of a method, `crate` alone a visibility
                    if is_colons(&tokens, at + 1) {
                        at = self.path(&tokens, at + 3, climbed, file, here);
                        continue;
                    }
                }
                _ => {}
            }
            at += 1;
        }
    }

    /// Follows a path whose modules so far are `base`, from token `at`; returns where it ends.
    fn path(
        &mut self,
        tokens: &[TokenTree],
        mut at: usize,
        mut base: Vec<String>,
        file: &Path,
        here: &[String],
    ) -> usize {
        loop {
            match tokens.get(at) {
                Some(TokenTree::Ident(name)) if name == "super" => {
                    base.pop();
                }
                Some(TokenTree::Ident(name)) if base.is_empty() => {
                    self.used(&name.to_string(), name, file, here);
                    base.push(name.to_string());
                }
                Some(TokenTree::Ident(name)) => base.push(name.to_string()),
                Some(TokenTree::Group(group)) if group.delimiter() == Delimiter::Brace => {
                    for branch in branches(group.stream()) {
                        self.path(&branch, 0, base.clone(), file, here);
                    }
                    return at + 1;
                }
                Some(TokenTree::Punct(star)) if star.as_char() == '*' && base.is_empty() => {
                    let line = star.span().start().line;
                    self.found.push(format!(
                        "{}:{line}: `crate::*` says nothing of what it uses",
                        file.display()
                    ));
                    return at + 1;
                }
                _ => return at,
            }
            if !is_colons(tokens, at + 1) {
                return at + 1;
            }
            at += 3;
        }
    }

    /// Judges that `here` uses `name` of the crate's root.
    fn used(&mut self, name: &str, token: &Ident, file: &Path, here: &[String]) {
        let Some(user) = here.first() else {
            return; // the root gives on what it likes
        };
        let used = match self.given_on.get(name) {
            Some(module) => module.clone(),
            None => name.to_owned(),
        };
        let place = format!("{}:{}", file.display(), token.span().start().line);
        let rank = |module: &str| self.order.iter().position(|known| known == module);
        match (rank(user), rank(&used)) {
            (Some(user_rank), Some(used_rank)) if used_rank > user_rank => {
                self.found.push(format!(
                    "{place}: `{user}` uses `{used}`, which is below it"
                ));
            }
            (_, None) if !self.own.contains(&used) && !self.modules.contains(&used) => {
                self.found.push(format!(
                    "{place}: `{user}` uses `{used}`, of which nothing is known"
                ));
            }
            _ => {}
        }
    }
}

/// The names that a `use` of the root brings, each with the module it is from.
fn leaves(tree: &UseTree, module: Option<&str>, names: &mut Vec<(String, String)>) {
    let mut named = |name: &Ident| {
        let name = name.to_string();
        names.push((name.clone(), module.map_or(name, str::to_owned)));
    };
    match tree {
        UseTree::Path(path) => {
            let first = path.ident.to_string();
            let skipped = matches!(first.as_str(), "crate" | "self");
            let module = module.map_or_else(|| (!skipped).then_some(first), |m| Some(m.to_owned()));
            leaves(&path.tree, module.as_deref(), names);
        }
        UseTree::Name(name) => named(&name.ident),
        UseTree::Rename(rename) => named(&rename.rename),
        UseTree::Group(group) => group
            .items
            .iter()
            .for_each(|item| leaves(item, module, names)),
        UseTree::Glob(_) => {}
    }
}

/// Whether two colons are at token `at`.
fn is_colons(tokens: &[TokenTree], at: usize) -> bool {
    let colon = |token: Option<&TokenTree>| matches!(token, Some(TokenTree::Punct(colon)) if colon.as_char() == ':');
    colon(tokens.get(at)) && colon(tokens.get(at + 1))
}

/// The branches of a nested `use`, between its commas.
fn branches(tokens: TokenStream) -> Vec<Vec<TokenTree>> {
    let mut branches = vec![Vec::new()];
    for token in tokens {
        if matches!(&token, TokenTree::Punct(comma) if comma.as_char() == ',') {
            branches.push(Vec::new());
        } else if let Some(branch) = branches.last_mut() {
            branch.push(token);
        }
    }
    branches
}

fn is_for_tests(attributes: &[Attribute]) -> bool {
    attributes.iter().any(|attribute| {
        matches!(&attribute.meta, Meta::List(list) if list.path.is_ident("cfg") && says_test(list.tokens.clone()))
    })
}

/// Whether the condition of a `cfg` holds in tests only.
fn says_test(condition: TokenStream) -> bool {
    let words = condition.to_string();
    let mut words = words.split(|c: char| !(c.is_alphanumeric() || c == '_'));
    words.clone().any(|word| word == "test") && words.all(|word| word != "not" && word != "any")
}

/// Whether the tokens begin with `#[cfg(test)]`.
fn tests_follow(tokens: &[TokenTree]) -> bool {
    let Some(TokenTree::Group(attribute)) = tokens.get(1) else {
        return false;
    };
    let mut inside = attribute.stream().into_iter();
    let is_cfg = matches!(inside.next(), Some(TokenTree::Ident(word)) if word == "cfg");
    is_cfg
        && matches!(inside.next(), Some(TokenTree::Group(condition)) if says_test(condition.stream()))
}

/// Behind the item that begins at token `at`: its block, or its semicolon.
fn after_item(tokens: &[TokenTree], at: usize) -> usize {
    let ends = |token: &TokenTree| match token {
        TokenTree::Group(group) => group.delimiter() == Delimiter::Brace,
        TokenTree::Punct(mark) => mark.as_char() == ';',
        _ => false,
    };
    let length = tokens[at.min(tokens.len())..].iter().position(ends);
    length.map_or(tokens.len(), |length| at + length + 1)
}

/// What is found in a made-up crate of `files` with the modules `low`, `middle` and `high`, in this order.
fn found_in(files: &[(&str, &str)]) -> Vec<String> {
    let folder = tempfile::tempdir().expect("a folder");
    for (name, text) in files {
        let path = folder.path().join(name);
        std::fs::create_dir_all(path.parent().expect("a folder")).expect("a folder");
        std::fs::write(path, text).expect("a file");
    }
    let order = ["low", "middle", "high"].map(str::to_owned);
    let found = violations(folder.path(), &order);
    let shown = folder.path().display().to_string();
    found
        .into_iter()
        .map(|line| line.replace(&shown, "").replace('\\', "/"))
        .collect()
}

const ROOT: (&str, &str) = (
    "lib.rs",
    "mod high; mod low; pub mod middle; pub use high::Tall; #[cfg(test)] mod rig; struct Own;",
);

#[test]
fn every_spelling_of_a_path_against_the_order_is_found() {
    for (text, line) in [
        ("use crate::high::A;", 1),
        ("use crate::{low::A,\n middle::{B, C}};", 2),
        ("use super::high;", 1),
        ("fn f() {\n let x = crate::high::a();\n}", 2),
        ("fn f(x: &super::high::A) {}", 1),
        ("fn f() { assert!(crate::high::a() == 1); }", 1),
        ("mod inner { use super::super::high::A; }", 1),
        ("mod inner { use super::{A, super::{low::B, high}}; }", 1),
        ("use crate::Tall;", 1),
        (
            "impl A {\n #[cfg(test)] fn a() {}\n fn b() { crate::high::a() }\n}",
            3,
        ),
        ("#[cfg(not(test))] use crate::high::A;", 1),
    ] {
        let found = found_in(&[ROOT, ("low.rs", text), ("middle.rs", ""), ("high.rs", "")]);
        let [only] = found.as_slice() else {
            panic!("{text}: {found:#?}");
        };
        assert!(
            only.starts_with(&format!("/low.rs:{line}: `low` uses")),
            "{text}: {only}"
        );
    }
}

#[test]
fn what_follows_the_order_is_let_be() {
    let high = "//! crate::nothing::A\n use crate::low::A; use super::middle::{self, B}; use self::inner::C; mod inner;
        /// [`crate::high`]
        pub(crate) fn f(&self) -> &str { self.x(); \"crate::nowhere::A\" }
        use crate::Own;
        #[cfg(test)] mod tests { use crate::nothing::A; }
        #[cfg(test)] use crate::nothing::B;";
    let inner = "use super::super::low::A; use crate::high::f; use crate::middle; use super::*;";
    let low = "#[cfg(test)]\nmod tests { use crate::high::A; }\n impl A { #[cfg(test)] fn a() { crate::high::f() } }";
    let files = [
        ROOT,
        ("low/mod.rs", low),
        ("middle.rs", ""),
        ("high/mod.rs", high),
        ("high/inner.rs", inner),
    ];
    assert_eq!(found_in(&files), Vec::<String>::new());
}

#[test]
fn a_file_deep_in_a_module_is_read() {
    let files = [
        ROOT,
        ("low/mod.rs", "mod deep;"),
        ("low/deep.rs", "mod deeper;"),
        ("low/deep/deeper.rs", "\nuse super::super::super::high::A;"),
        ("middle.rs", ""),
        ("high.rs", ""),
    ];
    assert_eq!(
        found_in(&files),
        ["/low/deep/deeper.rs:2: `low` uses `high`, which is below it"]
    );
}

#[test]
fn a_file_that_a_macro_declares_is_read() {
    let files = [
        ROOT,
        ("low/mod.rs", "files! { motion deep other }"),
        ("low/deep.rs", "use crate::high::A;"),
        ("middle.rs", ""),
        ("high.rs", ""),
    ];
    assert_eq!(
        found_in(&files),
        ["/low/deep.rs:1: `low` uses `high`, which is below it"]
    );
}

#[test]
fn a_module_without_a_line_and_a_line_without_a_module_are_found() {
    let root = ("lib.rs", "mod low; mod high; mod stray;");
    let files = [
        root,
        ("low.rs", "use crate::stray::A; use crate::unheard::B;"),
        ("high.rs", ""),
        ("stray.rs", ""),
    ];
    assert_eq!(
        found_in(&files),
        [
            "/lib.rs: module `stray` has no line in the order",
            "/lib.rs: the order names `middle`, which is not a module",
            "/low.rs:1: `low` uses `unheard`, of which nothing is known",
        ]
    );
}

#[test]
fn the_order_is_read_from_its_block() {
    let page = "x\n```text module-order a-b\nlow   what it holds\n\nhigh\n```\n```text\nno\n```\n";
    assert_eq!(
        orders(page),
        [("a-b".to_owned(), vec!["low".to_owned(), "high".to_owned()])]
    );
}
