//! What the text of a line shows of another language, without parsing it: for lines that the parser never comes to.

use std::collections::BTreeSet;

use super::foreign;
use super::hints::Names;

/// Words that nobody gives to a variable.
const WORDS: [&str; 12] = [
    "pass", "and", "or", "not", "elif", "elseif", "def", "function", "lambda", "struct", "enum",
    "end",
];
/// Signs that the language does not have outside of strings and comments.
const FOREIGN_SIGNS: [&str; 10] = [".*", "./", ".^", "++", "!==", "===", "~=", "@(", "@", "~"];
/// Prefixes of modules.
const PREFIXES: [&str; 4] = ["np", "numpy", "math", "Math"];
/// Words before a parenthesis that call nothing.
const NO_CALLS: [&str; 10] = [
    "if", "for", "while", "switch", "return", "in", "fn", "function", "and", "or",
];

/// Parts of statements of other languages, and what to write instead.
const SHAPES: [(&str, &str); 5] = [
    (
        "vec![",
        "write [0.0, 0.0] or zeros(2) for vec![0.0; 2], print(x) for println!",
    ),
    ("? ", "write if condition { a } else { b }"),
    (
        "(|",
        "functions without a name are not available: write fn name(x) { ... }",
    ),
    (
        "=> {",
        "functions without a name are not available: write fn name(x) { ... }",
    ),
    (".length", "write len(x)"),
];

/// What to write for the words and signs of another language in a line without its strings and comments.
pub(super) fn of_line(code: &str) -> Vec<String> {
    let foreign_words = words(code).filter(|word| WORDS.contains(word) || PREFIXES.contains(word));
    let of_word = |word: &str| foreign::word(word).or_else(|| foreign::variable(word));
    let mut found: Vec<String> = foreign_words.filter_map(of_word).collect();
    if code.contains('^') && !code.contains(".^") {
        found.push("use ** for powers: x ** 2".to_owned());
    }
    // what a loop of another language counts with goes with the loop
    let is_loop = words(code).next() == Some("for");
    let mut seen: Vec<&str> = vec!["^"];
    for sign in FOREIGN_SIGNS {
        let is_part = seen.iter().any(|known| known.contains(sign));
        if code.contains(sign) && !is_part && !(is_loop && sign == "++") {
            seen.push(sign);
            found.extend(foreign::sign(sign));
        }
    }
    found
}

/// Where in a line a comment of MATLAB begins, as opposed to the remainder of a division: at the beginning of the line, behind what ends a
/// statement, or behind a gap and before words.
pub(super) fn percent_comment(line: &str) -> Option<usize> {
    let (code, _) = line.split_once("//").unwrap_or((line, ""));
    let begins = |at: usize| {
        let (before, after) = (&code[..at], &code[at + 1..]);
        let ends = before.trim_end().chars().next_back();
        let is_text =
            after.starts_with(' ') && after.trim_start().starts_with(|c: char| c.is_alphabetic());
        ends.is_none_or(|c| matches!(c, ';' | '{' | '}' | ','))
            || (before.ends_with("  ") && is_text)
    };
    code.match_indices('%')
        .map(|(at, _)| at)
        .find(|at| begins(*at))
}

/// Names of a file as its text has them, for what is in lines that were taken out.
pub(super) struct Written {
    functions: BTreeSet<String>,
    declared: BTreeSet<String>,
    set: BTreeSet<String>,
}

impl Written {
    /// The names in the lines of a file without their strings and comments.
    pub(super) fn of<'l>(lines: impl Iterator<Item = &'l str>) -> Self {
        let mut written = Self {
            functions: BTreeSet::new(),
            declared: BTreeSet::new(),
            set: BTreeSet::new(),
        };
        for code in lines {
            let all: Vec<&str> = words(code).collect();
            for pair in all.windows(2) {
                match pair[0] {
                    "fn" => written.functions.insert(pair[1].to_owned()),
                    "let" | "const" | "for" => written.declared.insert(pair[1].to_owned()),
                    _ => false,
                };
            }
            if all.first() == Some(&"fn") {
                written
                    .declared
                    .extend(all[1..].iter().map(|name| (*name).to_owned()));
            }
            written.set.extend(set_in(code).map(str::to_owned));
        }
        written
    }

    /// What to write for calls and assignments in a line that was taken out: elements in round brackets, functions of other languages,
    /// names that are set and nowhere declared.
    pub(super) fn of_taken_out(&self, code: &str, names: &Names) -> Vec<String> {
        let mut found: Vec<String> = SHAPES
            .iter()
            .filter(|(shape, _)| code.contains(shape))
            .map(|(_, help)| (*help).to_owned())
            .collect();
        if let Some(name) = set_in(code).filter(|name| !self.declared.contains(*name)) {
            found.push(format!(
                "`{name}`: write let {name} = ...; where it is set first"
            ));
        }
        for (at, _) in code.match_indices('(') {
            let before = &code[..at];
            let is_word = |c: char| c.is_alphanumeric() || c == '_';
            let name = before
                .rsplit(|c: char| !is_word(c))
                .next()
                .unwrap_or_default();
            let owner = before[..before.len() - name.len()].chars().next_back();
            let is_known = names.is_function(name) || self.functions.contains(name);
            if name.is_empty() || is_known || NO_CALLS.contains(&name) {
                continue;
            }
            if owner == Some('.') {
                found.extend(foreign::function(name).map(|help| format!("`{name}`: {help}")));
            } else if self.declared.contains(name) || self.set.contains(name) {
                found.push(format!(
                    "`{name}`: elements are in square brackets: {name}[0] is the first"
                ));
            } else if let Some(help) = foreign::function(name) {
                found.push(format!("`{name}`: {help}"));
            }
        }
        found
    }
}

fn words(code: &str) -> impl Iterator<Item = &str> {
    let words = code.split(|c: char| !(c.is_alphanumeric() || c == '_'));
    words.filter(|word| !word.is_empty())
}

/// The name that a line sets: `x` of `x = 1;`.
fn set_in(code: &str) -> Option<&str> {
    let (name, value) = code.split_once('=')?;
    let name = name.trim();
    let is_name = name.starts_with(|c: char| c.is_alphabetic() || c == '_')
        && name.chars().all(|c| c.is_alphanumeric() || c == '_');
    let is_word = ["let", "const", "return", "if", "while", "for", "this"].contains(&name);
    (is_name && !is_word && !value.starts_with('=')).then_some(name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_comment_of_matlab_is_no_remainder() {
        assert_eq!(percent_comment("% all of it"), Some(0));
        assert_eq!(percent_comment("x = 1; % one"), Some(7));
        assert_eq!(percent_comment("x = 1   % gain, 1/s"), Some(8));
        assert_eq!(percent_comment("let x = a % b;"), None);
        assert_eq!(percent_comment("let x = a  %  2;"), None);
        assert_eq!(percent_comment("let x = 1; // 3 % of it"), None);
    }

    #[test]
    fn names_of_lines_that_were_taken_out_are_read_from_their_text() {
        let lines = [
            "let l = [1, 2];",
            "fn own(q) {",
            "m = l(1) + own(2) + numel(l) + q(1)",
        ];
        let written = Written::of(lines.into_iter());
        let found = written.of_taken_out(lines[2], &Names::default());
        assert_eq!(
            found,
            [
                "`m`: write let m = ...; where it is set first",
                "`l`: elements are in square brackets: l[0] is the first",
                "`numel`: write len(x)",
                "`q`: elements are in square brackets: q[0] is the first",
            ]
        );
    }

    #[test]
    fn what_the_language_has_is_no_habit() {
        for code in [
            "let x = #{ a: 1 };",
            "if x.a != 2 && !done { this.x += 1; }",
            "for i in 0..3 { x.a -= i ** 2; }",
            "let t = v.T * -1;",
        ] {
            assert_eq!(of_line(code), Vec::<String>::new(), "{code}");
        }
    }
}
