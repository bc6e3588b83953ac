//! Names that Windows takes for devices, whatever ending they have.

/// Whether Windows takes a name without its ending for a device.
pub fn is_device(name: &str) -> bool {
    let name = name.to_ascii_lowercase();
    let numbered = |kind: &str| {
        let number = name.strip_prefix(kind);
        number.is_some_and(|number| number.len() == 1 && number.as_bytes()[0].is_ascii_digit())
    };
    matches!(name.as_str(), "con" | "prn" | "aux" | "nul") || numbered("com") || numbered("lpt")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn devices_are_known_in_any_case() {
        for name in ["con", "NUL", "Com1", "lpt9"] {
            assert!(is_device(name), "{name}");
        }
        for name in ["", "com", "com10", "comx", "console"] {
            assert!(!is_device(name), "{name}");
        }
    }
}
