//! The encoding of a file, kept: what is not changed comes out with the bytes that it had.

use encoding_rs::WINDOWS_1252;

use crate::course_text::decoded;

/// The encodings of tables.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    Utf8,
    Utf16Le,
    Utf16Be,
    Windows1252,
}

/// The encoding of a file, and whether a mark stands in front.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Encoding {
    kind: Kind,
    has_mark: bool,
}

impl Encoding {
    /// The text of a file with its encoding; none where a part of it is not text in any encoding known here.
    pub(super) fn read(bytes: &[u8]) -> Option<(String, Self)> {
        let (kind, has_mark) = match bytes {
            [0xef, 0xbb, 0xbf, ..] => (Kind::Utf8, true),
            [0xff, 0xfe, ..] => (Kind::Utf16Le, true),
            [0xfe, 0xff, ..] => (Kind::Utf16Be, true),
            _ if std::str::from_utf8(bytes).is_ok() => (Kind::Utf8, false),
            _ => (Kind::Windows1252, false),
        };
        let text = decoded(bytes).into_owned();
        let encoding = Self { kind, has_mark };
        // half a character would be replaced on the way in, and so be changed on the way out
        (encoding.bytes(&text) == bytes).then_some((text, encoding))
    }

    /// The bytes of a text that has only characters of the encoding ([`Encoding::has`]).
    pub(super) fn bytes(self, text: &str) -> Vec<u8> {
        let with_mark = |mark: &[u8], bytes: &mut dyn Iterator<Item = u8>| {
            let mut all = if self.has_mark {
                mark.to_vec()
            } else {
                Vec::new()
            };
            all.extend(bytes);
            all
        };
        match self.kind {
            Kind::Utf8 => with_mark(&[0xef, 0xbb, 0xbf], &mut text.bytes()),
            Kind::Utf16Le => with_mark(
                &[0xff, 0xfe],
                &mut text.encode_utf16().flat_map(u16::to_le_bytes),
            ),
            Kind::Utf16Be => with_mark(
                &[0xfe, 0xff],
                &mut text.encode_utf16().flat_map(u16::to_be_bytes),
            ),
            Kind::Windows1252 => WINDOWS_1252.encode(text).0.into_owned(),
        }
    }

    /// Whether the encoding has every character of `text`.
    pub(super) fn has(self, text: &str) -> bool {
        self.kind != Kind::Windows1252 || !WINDOWS_1252.encode(text).2
    }

    /// The text with a question mark for each character that the encoding lacks.
    pub(super) fn without_foreign(self, text: &str) -> String {
        let kept = |c: char| {
            if self.has(c.encode_utf8(&mut [0; 4])) {
                c
            } else {
                '?'
            }
        };
        text.chars().map(kept).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_encoding_comes_out_as_it_came_in() {
        let text = "id;Grüße;日本 😀";
        let utf16 = |mark: [u8; 2], bytes: fn(u16) -> [u8; 2]| -> Vec<u8> {
            let units = text.encode_utf16().flat_map(bytes);
            mark.into_iter().chain(units).collect()
        };
        for bytes in [
            text.as_bytes().to_vec(),
            format!("\u{feff}{text}").into_bytes(),
            utf16([0xff, 0xfe], u16::to_le_bytes),
            utf16([0xfe, 0xff], u16::to_be_bytes),
        ] {
            let (read, encoding) = Encoding::read(&bytes).unwrap();
            assert_eq!(read, text);
            assert_eq!(encoding.bytes(&read), bytes);
            assert!(encoding.has("日本"));
        }
    }

    #[test]
    fn every_byte_of_windows_1252_is_kept() {
        let bytes: Vec<u8> = (1..=255).collect();
        let (text, encoding) = Encoding::read(&bytes).unwrap();
        assert_eq!(encoding.bytes(&text), bytes);
        assert!(encoding.has("Grüße €") && !encoding.has("≤"));
        assert_eq!(encoding.without_foreign("ü ≤ 日"), "ü ? ?");
    }

    #[test]
    fn half_a_character_is_no_text() {
        assert!(Encoding::read(&[0xff, 0xfe, 0x00, 0xd8, 0x41, 0x00]).is_none());
        assert!(Encoding::read(&[0xff, 0xfe, 0x41]).is_none());
    }
}
