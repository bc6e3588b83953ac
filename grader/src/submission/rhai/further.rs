//! What else of another language stands further down in a file that does not parse: the parser stops at the first, and a student should
//! not need a run for each.

use super::foreign;
use super::signs::Signs;
use crate::submission::controller::SourcePosition;

/// Places that are listed.
const MOST: usize = 5;

/// Words that nobody gives to a variable.
const WORDS: [&str; 10] = [
    "and", "or", "not", "elif", "elseif", "def", "function", "lambda", "struct", "enum",
];
/// Signs that the language does not have outside of strings and comments.
const FOREIGN_SIGNS: [&str; 10] = [".*", "./", ".^", "++", "===", "!==", "~=", "@", "~", "^"];
/// Prefixes of modules.
const PREFIXES: [&str; 4] = ["np", "numpy", "math", "Math"];

/// The lines below `after`, each with what to write there.
pub(super) fn further(signs: &Signs, after: SourcePosition) -> Option<String> {
    let mut found: Vec<(usize, String)> = Vec::new();
    for (line, text) in signs.lines().filter(|(line, _)| *line > after.line) {
        if found.len() == MOST {
            break;
        }
        if let Some(help) = of_line(&text) {
            found.push((line, help));
        }
    }
    let words = found
        .iter()
        .map(|(line, help)| format!("line {line}: {help}"));
    let words: Vec<String> = words.collect();
    (!words.is_empty()).then(|| words.join("; "))
}

/// What to write for the first thing of another language in a line without its strings and comments.
fn of_line(text: &str) -> Option<String> {
    let words = text.split(|c: char| !(c.is_alphanumeric() || c == '_'));
    let mut words = words.filter(|word| !word.is_empty());
    let word = words.find(|word| WORDS.contains(word) || PREFIXES.contains(word));
    if let Some(word) = word {
        return foreign::word(word).or_else(|| foreign::variable(word));
    }
    if text.contains('^') && !text.contains(".^") {
        return Some("use ** for powers: x ** 2".to_owned());
    }
    let sign = FOREIGN_SIGNS.iter().find(|sign| text.contains(**sign))?;
    foreign::sign(sign)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_stands_further_down_is_listed_once_a_line() {
        let source = "let x = ;\nlet y = x^2; // and so on\nif a and b { }\nlet s = \"or\";\nlet z = math.sin(1) ^ 2;\n";
        let at = SourcePosition { line: 1, column: 9 };
        assert_eq!(
            further(&Signs::of(source), at).as_deref(),
            Some(
                "line 2: use ** for powers: x ** 2; line 3: write && for \"and\"; line 5: functions are built in: write sin(x) and pi, without a prefix"
            )
        );
    }

    #[test]
    fn what_the_language_has_is_not_listed() {
        let source = "\nlet x = #{ a: 1 };\nif x.a != 2 && !done { this.x += 1; }\nfor i in 0..3 { x.a -= i ** 2; }\nlet t = v.T * -1;\n";
        let at = SourcePosition { line: 1, column: 1 };
        assert_eq!(further(&Signs::of(source), at), None);
    }
}
