//! What an address has in it, so that only who was given it is answered: other users of this machine reach the same port.

use blake3::Hash;

use crate::failure::Failure;

/// Digits of an address: 128 bits.
const DIGITS: usize = 32;

/// What the addresses of one server are made of. Nothing of it outlives the server.
pub(crate) struct Token {
    key: [u8; 32],
}

/// A key is not for people.
impl std::fmt::Debug for Token {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("Token")
    }
}

impl Token {
    /// One that nobody can guess.
    pub(super) fn fresh() -> Result<Self, Failure> {
        let mut key = [0; 32];
        getrandom::fill(&mut key).map_err(|error| {
            Failure::fault(
                format!("this system gives no random bytes: {error}"),
                "open report.html from the folder instead",
            )
        })?;
        Ok(Self { key })
    }

    /// The part of an address that opens everything.
    pub(super) fn of_all(&self) -> String {
        self.part("everything that is served")
    }

    /// The part of an address that opens the folder `name` of those that are listed, and nothing else: a page in it may be of whoever
    /// was graded, and knows its own address.
    pub(super) fn of_folder(&self, name: &str) -> String {
        self.part(&format!("the folder {name}"))
    }

    fn part(&self, what: &str) -> String {
        let hash = blake3::keyed_hash(&self.key, what.as_bytes());
        hash.to_hex()[..DIGITS].to_owned()
    }

    /// Whether `part` of an address opens what is in the folder `name` of those that are listed.
    pub(super) fn opens(&self, part: &str, name: &str) -> bool {
        // digests are compared in the same time wherever they differ
        let digest = |part: &str| -> Hash { blake3::hash(part.as_bytes()) };
        let given = digest(part);
        let is_all = given == digest(&self.of_all());
        let is_folder = given == digest(&self.of_folder(name));
        is_all || is_folder
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_was_given_out_opens_something() {
        let (token, other) = (Token { key: [1; 32] }, Token { key: [2; 32] });
        assert!(token.opens(&token.of_all(), "s1") && token.opens(&token.of_all(), ""));
        assert!(token.opens(&token.of_folder("s1"), "s1"));
        let all = token.of_all();
        for part in [
            token.of_folder("s2"),
            other.of_all(),
            other.of_folder("s1"),
            all[..31].to_owned(),
            all + "0",
            String::new(),
        ] {
            assert!(!token.opens(&part, "s1"), "{part}");
        }
        assert_ne!(
            Token::fresh().unwrap().of_all(),
            Token::fresh().unwrap().of_all()
        );
        assert_eq!(format!("{token:?}"), "Token");
    }
}
