//! A text as one word of a command line that a student may paste into a shell.

/// Characters that a shell keeps as they are, outside of quotes.
fn is_plain(c: char) -> bool {
    c.is_ascii_alphanumeric() || matches!(c, '-' | '_' | '.' | '/' | '+' | ',' | ':' | '@')
}

/// Characters that mean something to a shell even between double quotes: to POSIX shells, to PowerShell (which takes typographic quotes
/// for quotes), or to that of Windows.
fn is_active(c: char) -> bool {
    c.is_control()
        || matches!(
            c,
            '$' | '`' | '"' | '\\' | '!' | '%' | '\u{201C}'..='\u{201E}'
        )
}

/// `text` as one word that means the same to every shell; none where no quotes would make it so.
pub(super) fn shell_word(text: &str) -> Option<String> {
    if text.is_empty() || text.contains(is_active) {
        return None;
    }
    // no option of the command
    let text = if text.starts_with('-') {
        format!("./{text}")
    } else {
        text.to_owned()
    };
    Some(if text.chars().all(is_plain) {
        text
    } else {
        format!("\"{text}\"")
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_word_stays_one_and_no_shell_runs_it() {
        for (text, word) in [
            ("submission.rhai", Some("submission.rhai")),
            (
                "Lab 1 – Lösung (2).rhai",
                Some("\"Lab 1 – Lösung (2).rhai\""),
            ),
            ("-rf.rhai", Some("./-rf.rhai")),
            ("- a;rm.rhai", Some("\"./- a;rm.rhai\"")),
            ("a&b|c>d'e~.rhai", Some("\"a&b|c>d'e~.rhai\"")),
            ("$(rm -rf ~).rhai", None),
            ("`id`.rhai", None),
            ("a\"b.rhai", None),
            ("%PATH%!x!.rhai", None),
            ("a\u{201D}b.rhai", None),
            ("", None),
        ] {
            assert_eq!(shell_word(text).as_deref(), word, "{text}");
        }
    }
}
