//! What anybody can read in Kinemark's own repository: the reference solutions of the shipped labs and their salts. A course that
//! grades with them has hidden cases that are not hidden.

/// Digests (BLAKE3) of the solutions and of the salts in this repository's `reference` folder; a test holds them to it.
const PUBLIC: &[(&str, &str)] = include!("public.in");

/// What of a lab is public, in words; `None` where nothing is.
pub fn public_part(solution: &[u8], salt: Option<&str>) -> Option<&'static str> {
    if salt.is_some_and(|salt| is_public("salt", salt.as_bytes())) {
        return Some("salt");
    }
    is_public_solution(solution).then_some("reference solution")
}

/// Whether these bytes are one of the reference solutions that anybody can read.
pub fn is_public_solution(bytes: &[u8]) -> bool {
    is_public("solution", bytes)
}

fn is_public(kind: &str, bytes: &[u8]) -> bool {
    let digest = blake3::hash(bytes).to_hex();
    PUBLIC
        .iter()
        .any(|(of, known)| *of == kind && *known == digest.as_str())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `KINEMARK_BLESS=1` writes the list anew.
    #[test]
    fn the_list_is_that_of_the_repository() {
        let reference = concat!(env!("CARGO_MANIFEST_DIR"), "/../../reference");
        let mut labs: Vec<_> = std::fs::read_dir(reference)
            .unwrap()
            .map(|entry| entry.unwrap().path())
            .filter(|path| path.join("solution.rhai").is_file())
            .collect();
        labs.sort();
        assert!(labs.len() >= 5);
        let mut lines = Vec::new();
        for lab in labs {
            let solution = std::fs::read(lab.join("solution.rhai")).unwrap();
            let hidden = std::fs::read_to_string(lab.join("hidden.toml")).unwrap();
            let hidden: toml::Table = hidden.parse().unwrap();
            let salt = hidden["salt"].as_str().unwrap();
            for (kind, bytes) in [("solution", solution.as_slice()), ("salt", salt.as_bytes())] {
                lines.push(format!(
                    "    (\"{kind}\", \"{}\"),\n",
                    blake3::hash(bytes).to_hex()
                ));
                assert!(
                    std::env::var_os("KINEMARK_BLESS").is_some()
                        || public_part(&solution, Some(salt)) == Some("salt")
                );
            }
        }
        let text = format!("&[\n{}]\n", lines.concat());
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/src/public.in");
        if std::env::var_os("KINEMARK_BLESS").is_some() {
            std::fs::write(path, &text).unwrap();
        }
        assert_eq!(std::fs::read_to_string(path).unwrap(), text);
    }

    #[test]
    fn what_is_ones_own_is_not_public() {
        assert_eq!(public_part(b"fn control() {}", Some("our secret")), None);
        assert_eq!(public_part(b"fn control() {}", None), None);
    }
}
