//! Text from a submission, made harmless to look at: what would not be seen, or would reorder or repaint what stands beside it,
//! is written out.

use std::borrow::Cow;
use std::fmt::Write as _;

/// Whether a character hides, reorders or steers what is shown around it.
fn is_unseen(c: char) -> bool {
    c.is_control()
        || matches!(c,
            '\u{00AD}' | '\u{034F}' | '\u{061C}' | '\u{115F}' | '\u{1160}' | '\u{17B4}' | '\u{17B5}' | '\u{3164}' | '\u{FEFF}' | '\u{FFA0}'
            | '\u{180B}'..='\u{180F}'
            | '\u{200B}'..='\u{200F}'
            | '\u{2028}'..='\u{202E}'
            | '\u{2060}'..='\u{206F}'
            | '\u{FDD0}'..='\u{FDEF}'
            | '\u{FE00}'..='\u{FE0F}'
            | '\u{FFF0}'..='\u{FFFB}'
            | '\u{1BCA0}'..='\u{1BCA3}'
            | '\u{1D173}'..='\u{1D17A}'
            | '\u{E0000}'..='\u{E0FFF}')
        || (c as u32) & 0xFFFE == 0xFFFE
}

/// Accents that stand on the letter before: a few make a letter, a heap of them paints over other lines.
fn is_combining(c: char) -> bool {
    matches!(c, '\u{0300}'..='\u{036F}' | '\u{0483}'..='\u{0489}' | '\u{1AB0}'..='\u{1AFF}' | '\u{1DC0}'..='\u{1DFF}'
        | '\u{20D0}'..='\u{20FF}' | '\u{FE20}'..='\u{FE2F}')
}

/// Whether a character may be a picture, which the next one may ask for in colour.
fn is_sign(c: char) -> bool {
    !c.is_ascii() && !c.is_alphanumeric() && !is_unseen(c)
}

/// Accents on one letter that are shown.
const MAX_COMBINING: usize = 3;

/// `text` with control, direction and invisible characters written out as `⟨U+202E⟩`; tabs become spaces.
pub fn visible(text: &str) -> Cow<'_, str> {
    if text.bytes().all(|b| (b' '..=b'~').contains(&b)) {
        return Cow::Borrowed(text);
    }
    let mut shown = String::with_capacity(text.len() + 16);
    let mut accents = 0;
    let mut before = ' ';
    for c in text.chars() {
        accents = if is_combining(c) { accents + 1 } else { 0 };
        match c {
            '\t' => shown.push_str("    "),
            '\n' => shown.push('⏎'),
            '\u{FE0E}' | '\u{FE0F}' if is_sign(before) => shown.push(c),
            _ if is_unseen(c) => {
                // writing into a string cannot fail
                let _ = write!(shown, "⟨U+{:04X}⟩", c as u32);
            }
            _ if accents > MAX_COMBINING => {}
            _ => shown.push(c),
        }
        before = c;
    }
    Cow::Owned(shown)
}

/// JSON with the same characters as `\u202e`, which mean the same to every reader: whoever looks at a record in a terminal sees them, too.
pub fn visible_json(json: String) -> String {
    let is_escaped = |c: char| is_unseen(c) && c != '\n';
    if !json.chars().any(is_escaped) {
        return json;
    }
    let mut shown = String::with_capacity(json.len() + 16);
    for c in json.chars() {
        if is_escaped(c) {
            for unit in c.encode_utf16(&mut [0; 2]) {
                // writing into a string cannot fail
                let _ = write!(shown, "\\u{unit:04x}");
            }
        } else {
            shown.push(c);
        }
    }
    shown
}

/// [`visible`] text of at most `max` characters, the last an ellipsis where something was cut.
pub fn shortened(text: &str, max: usize) -> String {
    // no more than `max` characters can be shown, so no more need be looked at
    let mut chars = text.chars();
    let head: String = chars.by_ref().take(max + 1).collect();
    let shown = visible(&head);
    if shown.chars().count() <= max {
        return shown.into_owned();
    }
    let mut cut: String = shown.chars().take(max.saturating_sub(1)).collect();
    cut.push('…');
    cut
}

/// [`visible`] text of at most `max` characters that ends with a whole sentence, or else with a whole word and an ellipsis.
pub(crate) fn shortened_in_words(text: &str, max: usize) -> String {
    let cut = shortened(text, max);
    // what is not cut has no ellipsis of ours
    if cut.chars().count() < max || visible(text) == cut {
        return cut;
    }
    let kept = cut.trim_end_matches('…');
    // a sentence that is less than a half says too little
    let sentence = kept.rfind(". ").filter(|end| 2 * end >= kept.len());
    if let Some(end) = sentence {
        return kept[..=end].to_owned();
    }
    match kept.rfind(' ').filter(|end| 2 * end >= kept.len()) {
        Some(end) => {
            let words = kept[..end].trim_end_matches([',', ';', ':', '(', ' ', '-']);
            format!("{words} …")
        }
        None => cut,
    }
}

/// A file name without extension of lowercase letters, digits and hyphens: safe on every system.
pub(crate) fn file_stem(text: &str) -> String {
    let mut stem = String::new();
    for c in text.chars().take(60) {
        if c.is_ascii_alphanumeric() {
            stem.push(c.to_ascii_lowercase());
        } else if !stem.is_empty() && !stem.ends_with('-') {
            stem.push('-');
        }
    }
    let stem = stem.trim_end_matches('-');
    if stem.is_empty() {
        "unnamed".to_owned()
    } else {
        stem.to_owned()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn json_means_the_same_and_hides_nothing() {
        let value = serde_json::json!({ "a": "x\u{202e}y\u{9b}31m\u{e0001}\n\"é" });
        let text = serde_json::to_string_pretty(&value).unwrap();
        let shown = visible_json(text);
        assert_eq!(
            shown,
            "{\n  \"a\": \"x\\u202ey\\u009b31m\\udb40\\udc01\\n\\\"é\"\n}"
        );
        assert_eq!(
            serde_json::from_str::<serde_json::Value>(&shown).unwrap(),
            value
        );
    }

    #[test]
    fn escapes_and_overrides_are_written_out() {
        assert_eq!(visible("\u{1b}[31mred"), "⟨U+001B⟩[31mred");
        assert_eq!(visible("a\u{202E}b"), "a⟨U+202E⟩b");
        assert_eq!(visible("x\u{0}\u{85}\u{FFFF}"), "x⟨U+0000⟩⟨U+0085⟩⟨U+FFFF⟩");
        assert_eq!(visible("größe ∂q/∂t 日本"), "größe ∂q/∂t 日本");
        // what Unicode calls default ignorable: a name with it looks like one without
        assert_eq!(visible("⚠\u{FE0F}"), "⚠\u{FE0F}");
        for c in [
            '\u{17B4}',
            '\u{180B}',
            '\u{FE0F}',
            '\u{1BCA0}',
            '\u{1D173}',
            '\u{E0100}',
        ] {
            assert_eq!(visible(&format!("a{c}")), format!("a⟨U+{:04X}⟩", c as u32));
        }
    }

    #[test]
    fn heaps_of_accents_are_cut() {
        let heap = format!("a{}", "\u{0301}".repeat(200));
        assert_eq!(visible(&heap).chars().count(), 1 + MAX_COMBINING);
    }

    #[test]
    fn long_text_ends_in_an_ellipsis() {
        assert_eq!(shortened("abcdef", 6), "abcdef");
        assert_eq!(shortened("abcdefg", 6), "abcde…");
        assert_eq!(shortened(&"x".repeat(1_000_000), 4), "xxx…");
    }

    #[test]
    fn long_words_end_with_a_sentence_or_a_word() {
        let short = "It stops here.";
        assert_eq!(shortened_in_words(short, 14), short);
        let two = "The first is said. The second is far too long to be said.";
        assert_eq!(shortened_in_words(two, 30), "The first is said.");
        // the first sentence alone would say too little
        let little = "No. The second is far too long to be said at all";
        assert_eq!(
            shortened_in_words(little, 30),
            "No. The second is far too …"
        );
        let value = "on the line, up to (root mean square) far beyond the band";
        assert_eq!(shortened_in_words(value, 21), "on the line, up to …");
        assert_eq!(shortened_in_words(&"x".repeat(30), 10), "xxxxxxxxx…");
        for max in 1..60 {
            for text in [two, little, value] {
                let said = shortened_in_words(text, max);
                assert!(said.chars().count() <= max, "{max}: {said}");
            }
        }
    }

    #[test]
    fn file_stems_are_plain() {
        assert_eq!(file_stem("../../etc/<Passwd>"), "etc-passwd");
        assert_eq!(file_stem("\u{202E}"), "unnamed");
        assert_eq!(file_stem("move to B"), "move-to-b");
    }
}
