//! Paths of a machine, taken out of text that students get: a message may name a folder of whoever graded, or of whoever wrote it.

/// The text with the last name alone of every path that begins at the root of a machine, at a drive, at a server or at a home folder.
/// Addresses of the web and ratios such as `m/s` stay.
pub(super) fn without_paths(text: &str) -> String {
    let mut out = String::new();
    let mut rest = text;
    while let Some(at) = start_of_path(rest, out.chars().next_back()) {
        let (before, path) = rest.split_at(at);
        out += before;
        let end = path.find(ends_path).unwrap_or(path.len());
        let (path, after) = path.split_at(end);
        out += last_name(path);
        rest = after;
    }
    out + rest
}

/// Where the next path begins; `before` is the character before the text.
fn start_of_path(text: &str, before: Option<char>) -> Option<usize> {
    let mut previous = before;
    for (at, c) in text.char_indices() {
        let stands_alone =
            !previous.is_some_and(|p| p.is_alphanumeric() || "/\\:.~_-)".contains(p));
        previous = Some(c);
        if stands_alone && is_path(&text[at..]) {
            return Some(at);
        }
    }
    None
}

/// Whether a text begins with a path of at least two names.
fn is_path(text: &str) -> bool {
    let word = &text[..text.find(ends_path).unwrap_or(text.len())];
    let below = |root: &str| {
        let names = word.strip_prefix(root)?;
        let mut parts = names.split(['/', '\\']);
        let has_name = parts.next().is_some_and(|first| !first.is_empty());
        Some((has_name, parts.next().is_some()))
    };
    if word.starts_with("file:") {
        return true;
    }
    let is_drive = word.chars().next().is_some_and(|c| c.is_ascii_alphabetic())
        && (word[1..].starts_with(":\\") || word[1..].starts_with(":/"))
        && !word[1..].starts_with("://");
    is_drive
        || matches!(below("\\\\"), Some((true, _)))
        || matches!(below("~/"), Some((true, _)))
        || matches!(below("/"), Some((true, true)))
}

fn ends_path(c: char) -> bool {
    c.is_whitespace()
        || matches!(
            c,
            '"' | '\'' | '`' | '<' | '>' | '|' | ',' | ';' | '(' | ')' | '*'
        )
}

fn last_name(path: &str) -> &str {
    let path = path.trim_end_matches(['/', '\\', '.']);
    path.rsplit(['/', '\\']).next().unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_are_cut_to_their_last_name() {
        for (text, cut) in [
            (
                "cannot read /srv/ta/labs/x.toml: no",
                "cannot read x.toml: no",
            ),
            ("in `C:\\Users\\ta\\lab1.zip`", "in `lab1.zip`"),
            ("\\\\server\\share\\a.rhai, line 3", "a.rhai, line 3"),
            ("~/courses/robots", "robots"),
            ("file:///tmp/x/y.html and /tmp/a/b", "y.html and b"),
            ("(/opt/km/bin)", "(bin)"),
            ("/srv/ta/labs/x.toml:12:3", "x.toml:12:3"),
        ] {
            assert_eq!(without_paths(text), cut, "{text}");
        }
    }

    #[test]
    fn what_is_no_path_stays() {
        for text in [
            "12.4 mm/s of 3 N/m",
            "18.5 / 24 points",
            "see https://example.org/a/b",
            "fk/position and 1/2",
            "a // comment",
            "/2",
            "q1 + q2; C: the third",
            "größe/länge/日本",
            "",
        ] {
            assert_eq!(without_paths(text), text);
        }
    }
}
