//! Suggestions for a mistyped name: the nearest known name, or the list of known names.

/// Names longer than this many bytes are not searched for typos: the distance costs time and memory by the product of the lengths.
pub const LONGEST_TYPO: usize = 64;

/// The known name nearest to `given`, if one is near enough to be a typo.
pub fn nearest<'a>(given: &str, known: impl Iterator<Item = &'a str>) -> Option<&'a str> {
    if given.len() > LONGEST_TYPO {
        return None;
    }
    let lower = given.to_lowercase();
    known
        .filter(|name| name.len() <= LONGEST_TYPO)
        .map(|name| {
            (
                strsim::damerau_levenshtein(&lower, &name.to_lowercase()),
                name,
            )
        })
        .filter(|(distance, name)| *distance <= (name.chars().count().max(3)) / 3)
        .min_by_key(|(distance, _)| *distance)
        .map(|(_, name)| name)
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
        // a very long name, as in a broken file, gives no suggestion
        let long = "x".repeat(1_000_000);
        assert_eq!(nearest(&long, [long.as_str()].into_iter()), None);
    }
}
