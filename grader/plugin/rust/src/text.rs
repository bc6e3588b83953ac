//! Texts without an allocator: formatted into a fixed room, and read up to a zero byte.

use core::ffi::{CStr, c_char};
use core::fmt;
use core::mem::MaybeUninit;
use core::slice;
use core::str::from_utf8_unchecked;

/// Bytes of a line or a message; what is longer is cut.
const ROOM: usize = 1_000;

/// A text of at most [`ROOM`] bytes.
pub(crate) struct Text {
    bytes: [MaybeUninit<u8>; ROOM],
    length: usize,
}

impl Text {
    pub(crate) fn new() -> Self {
        Self {
            bytes: [MaybeUninit::uninit(); ROOM],
            length: 0,
        }
    }

    pub(crate) fn as_str(&self) -> &str {
        // SAFETY: `write_str` has written so many bytes, each time whole characters
        unsafe {
            let bytes = slice::from_raw_parts(self.bytes.as_ptr().cast(), self.length);
            from_utf8_unchecked(bytes)
        }
    }
}

impl fmt::Write for Text {
    /// Appends what there is room for, and fails if that is not everything.
    fn write_str(&mut self, text: &str) -> fmt::Result {
        let free = &mut self.bytes[self.length..];
        let mut length = text.len().min(free.len());
        while !text.is_char_boundary(length) {
            length -= 1;
        }
        for (to, from) in free.iter_mut().zip(&text.as_bytes()[..length]) {
            to.write(*from);
        }
        self.length += length;
        if length == text.len() {
            Ok(())
        } else {
            Err(fmt::Error)
        }
    }
}

/// A text of Kinemark's.
///
/// # Safety
/// `text` must be the address of a text in UTF-8 that ends with a zero byte and stays unchanged for `'a`.
pub(crate) unsafe fn until_zero<'a>(text: *const c_char) -> &'a str {
    // SAFETY: as the caller says
    unsafe { from_utf8_unchecked(CStr::from_ptr(text).to_bytes()) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use core::fmt::Write as _;

    #[test]
    fn a_long_text_is_cut_between_characters() {
        let mut text = Text::new();
        assert_eq!(write!(text, "{:>999}", 7), Ok(()));
        assert_eq!(text.write_str("é and more"), Err(fmt::Error));
        assert_eq!(text.as_str().len(), 999);
        assert_eq!(text.write_str("e"), Ok(()));
        assert!(text.as_str().ends_with(" 7e"), "{:?}", text.as_str());
    }
}
