//! Text that a spreadsheet would run: a cell that begins as a formula does gets an apostrophe in front, which spreadsheets do not show.

use std::borrow::Cow;

/// Text for a cell that comes from a student or a roster. Numbers such as -0.5 stay numbers.
///
/// Source: OWASP, *CSV Injection*. Full-width signs count too, and so do signs behind spaces, which some programs cut off.
pub(super) fn harmless(text: &str) -> Cow<'_, str> {
    if is_formula(text) && !is_number(text) {
        Cow::Owned(format!("'{text}"))
    } else {
        Cow::Borrowed(text)
    }
}

/// What a cell says without the guard that [`harmless`], or Canvas with `="..."`, put around it.
pub(super) fn unguarded(cell: &str) -> &str {
    if let Some(text) = cell.strip_prefix('\'').filter(|text| is_formula(text)) {
        return text;
    }
    let inside = cell.strip_prefix("=\"");
    inside
        .and_then(|text| text.strip_suffix('"'))
        .unwrap_or(cell)
}

fn is_formula(text: &str) -> bool {
    let begins = |c: char| {
        matches!(
            c,
            '=' | '+' | '-' | '@' | '\t' | '\r' | '\n' | '＝' | '＋' | '－' | '＠'
        )
    };
    text.starts_with(begins) || text.trim_start().starts_with(begins)
}

fn is_number(text: &str) -> bool {
    // `-inf` parses, and would be a formula
    text.parse::<f64>().is_ok() && !text.contains(|c: char| c.is_ascii_alphabetic())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn formulas_are_guarded_and_numbers_are_not() {
        for text in [
            "=SUM(A1)", "+1+1", "-cmd", "@x", "\t=1", "\r1", " =1", "＝1", "-", "-inf",
        ] {
            assert_eq!(harmless(text), format!("'{text}"));
            assert_eq!(unguarded(&harmless(text)), text);
        }
        for text in ["-0.5", "+3", "s1", "", "a=b", "'=x"] {
            assert_eq!(harmless(text), text);
        }
    }

    #[test]
    fn the_guards_are_taken_off_again() {
        assert_eq!(unguarded("=\"=SUM(A1) Formula\""), "=SUM(A1) Formula");
        assert_eq!(unguarded("'tis"), "'tis");
        assert_eq!(unguarded("O'Brien"), "O'Brien");
    }
}
