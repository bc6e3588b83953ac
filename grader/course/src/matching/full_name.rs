//! Full names as they are compared: what an LMS takes out of a name, or turns around in it, does not count.

use unicode_normalization::char::is_combining_mark;

use crate::student::folded;

/// A name without what Moodle keeps out of names of files, `_` as a space, and "Last, First" turned around.
pub(super) fn comparable(name: &str) -> String {
    let mut plain = String::with_capacity(name.len());
    for c in folded(name).chars() {
        match c {
            '&' | '<' | '>' | '"' | '`' | '|' | '\'' | ':' | '\\' | '/' => {}
            // typed in place of an apostrophe
            '\u{2018}' | '\u{2019}' | '\u{2bc}' => {}
            '_' => plain.push(' '),
            c if c.is_control() => {}
            c => plain.push(c),
        }
    }
    let plain = without_rows_of_dots(&plain);
    let turned = match plain.split_once(',') {
        Some((last, first)) if !first.contains(',') => format!("{first} {last}"),
        _ => plain,
    };
    let words: Vec<&str> = turned.split_whitespace().collect();
    // once more: accents on the two sides of what was taken out may compose now
    folded(&words.join(" "))
}

/// Moodle takes out two dots and more in a row, because they lead out of a folder.
fn without_rows_of_dots(text: &str) -> String {
    let mut kept = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(at) = rest.find("..") {
        kept.push_str(&rest[..at]);
        rest = rest[at..].trim_start_matches('.');
    }
    kept + rest
}

/// A name as Canvas writes it in front of files: lower case, letters and digits alone.
pub(super) fn slug(name: &str) -> String {
    let kept = |c: &char| c.is_alphanumeric() || is_combining_mark(*c);
    folded(name).chars().filter(kept).collect()
}

/// The slugs that a name can have: Canvas begins with the last name, and which of the words that is only the person knows.
pub(super) fn slugs(name: &str) -> Vec<String> {
    let mut slugs = vec![slug(name)];
    let plain = match name.split_once(',') {
        Some((last, first)) => format!("{} {}", first.trim(), last.trim()),
        None => name.to_owned(),
    };
    let words: Vec<&str> = plain.split_whitespace().collect();
    for at in 0..words.len() {
        let turned = [&words[at..], &words[..at]].concat();
        slugs.push(slug(&turned.concat()));
    }
    slugs.sort();
    slugs.dedup();
    slugs.retain(|slug| !slug.is_empty());
    slugs
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_that_an_lms_wrote_compare_as_the_roster_has_them() {
        for (roster, lms) in [
            ("Ana Lima", "Lima, Ana"),
            ("Sean O'Brien", "Sean OBrien"),
            ("Sean O\u{2019}Brien", "Sean OBrien"),
            ("Jo_Ann  Li", "jo ann li"),
            ("A. B.. C", "A. B C"),
            ("Ren\u{e9}e", "Rene\u{301}e"),
            ("=SUM(A1) Formula", "=SUM(A1) Formula"),
        ] {
            assert_eq!(comparable(roster), comparable(lms), "{roster}");
        }
        assert_ne!(comparable("Ana Lima"), comparable("Lima Ana"));
    }

    #[test]
    fn a_slug_begins_with_any_of_the_words() {
        assert_eq!(slug("de Lima, Ana-Maria"), "delimaanamaria");
        assert!(slugs("Ana-Maria de Lima").contains(&slug("de Lima, Ana-Maria")));
        assert!(slugs("de Lima, Ana-Maria").contains(&slug("Ana-Maria de Lima")));
        assert_eq!(slugs("王小明"), ["王小明"]);
        assert!(slugs("🤖").is_empty());
    }
}
