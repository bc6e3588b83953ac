//! Suggestions for a mistyped name: the nearest known name, or the list of known names.

/// Names longer than this many bytes are not searched for typos: the distance costs time and memory by the product of the lengths.
pub const LONGEST_TYPO: usize = 64;

/// A part that two names share has at least this many bytes: `x` is no hint to `max_x`.
const SHORTEST_PART: usize = 4;

/// The known name nearest to `given`, if one is near enough to be a typo, or is the same name with a word more or less in front or
/// behind, as in `index_q1` and `Left_index_q1`.
pub fn nearest<'a>(given: &str, known: impl Iterator<Item = &'a str>) -> Option<&'a str> {
    if given.len() > LONGEST_TYPO {
        return None;
    }
    let given = given.to_lowercase();
    let mut typo: Option<(usize, &str)> = None;
    let mut extended: Option<((bool, usize), &str)> = None;
    for name in known.filter(|name| name.len() <= LONGEST_TYPO) {
        let lower = name.to_lowercase();
        let distance = strsim::damerau_levenshtein(&given, &lower);
        if distance <= name.chars().count().max(3) / 3 && typo.is_none_or(|(d, _)| distance < d) {
            typo = Some((distance, name));
        }
        // a name that has all of the given one is nearer than one that lacks a part
        let by = (lower.len() < given.len(), lower.len().abs_diff(given.len()));
        if is_extension(&given, &lower) && extended.is_none_or(|(d, _)| by < d) {
            extended = Some((by, name));
        }
    }
    // a shared word says more than letters in common, but not than one slip of the pen
    match (typo, extended) {
        (Some((0 | 1, name)), _) | (_, Some((_, name))) | (Some((_, name)), None) => Some(name),
        (None, None) => None,
    }
}

/// Whether one of two names is the other with words in front or behind, joined by `_`.
fn is_extension(a: &str, b: &str) -> bool {
    let (short, long) = if a.len() < b.len() { (a, b) } else { (b, a) };
    let front = long.strip_suffix(short);
    let behind = long.strip_prefix(short);
    short.len() >= SHORTEST_PART
        && (front.is_some_and(|front| front.ends_with('_'))
            || behind.is_some_and(|behind| behind.starts_with('_')))
}

/// "did you mean `x`?" if a known name is near, else the list of known names; for help lines about names.
pub fn suggest<'a>(given: &str, what: &str, known: impl Iterator<Item = &'a str>) -> String {
    let known: Vec<&str> = known.collect();
    match nearest(given, known.iter().copied()) {
        Some(near) => format!("did you mean `{near}`? {what}: {}", known.join(", ")),
        None if known.is_empty() => format!("{what}: none"),
        None => format!("{what}: {}", known.join(", ")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_typo_finds_its_name_and_a_stranger_does_not() {
        let known = ["shoulder", "elbow"];
        assert_eq!(nearest("elbwo", known.into_iter()), Some("elbow"));
        assert_eq!(nearest("gripper", known.into_iter()), None);
        assert_eq!(nearest("elbow", ["elbow"].into_iter()), Some("elbow"));
        // a very long name, as in a broken file, gives no suggestion
        let long = "x".repeat(1_000_000);
        assert_eq!(nearest(&long, [long.as_str()].into_iter()), None);
    }

    #[test]
    fn a_name_with_a_word_more_or_less_is_near() {
        let known = ["Left_thumb_q1", "Left_index_q1", "index", "max_x"];
        for (given, near) in [
            ("index_q1", Some("Left_index_q1")),
            ("left_index", Some("Left_index_q1")),
            ("index_q2_link", Some("index")),
            // a slip of the pen is nearer than a word in front
            ("Left_index_q2", Some("Left_index_q1")),
            ("x", None),
            ("q1", None),
        ] {
            assert_eq!(nearest(given, known.into_iter()), near, "{given}");
        }
        // no word, only letters
        assert_eq!(nearest("index", ["superindex"].into_iter()), None);
    }
}
