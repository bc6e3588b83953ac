//! Where a function of the lab's own writes its answer.

use core::ffi::c_char;
use core::{ptr, slice};

/// Where a function of the lab's own writes its answer: named numbers, lists and matrices.
///
/// An empty name says that the value is the answer itself; then it is the only one.
#[repr(C)]
pub struct Answer {
    fields: *mut Entry,
    count: u32,
    most_fields: u32,
    numbers: *mut f64,
    used: u32,
    most_numbers: u32,
}

/// A `km_field` to be written.
#[repr(C)]
struct Entry {
    name: *const c_char,
    numbers: *const f64,
    text: *const c_char,
    count: u32,
    columns: u32,
}

/// Bytes of a name that Kinemark reads, without the zero byte after it.
const LONGEST_NAME: usize = 63;

const NO_ROOM: &str = "the answer has no room for so much";

impl Answer {
    /// Adds a number.
    ///
    /// # Panics
    /// If there is no room for it: an answer has 64 entries and as many numbers as the lab's longest list.
    #[track_caller]
    pub fn number(&mut self, name: &str, number: f64) {
        self.add(name, &[number], 0);
    }

    /// Adds a list of numbers: an array `&[x, y]`, or any slice.
    ///
    /// # Panics
    /// If there is no room for it, as in [`number`](Self::number).
    #[track_caller]
    pub fn list(&mut self, name: &str, numbers: &[f64]) {
        self.add(name, numbers, numbers.len());
    }

    /// Adds a matrix, row by row: `&[[1.0, 0.0], [0.0, 1.0]]`.
    ///
    /// # Panics
    /// If there is no room for it, as in [`number`](Self::number).
    #[track_caller]
    pub fn matrix<const N: usize>(&mut self, name: &str, rows: &[[f64; N]]) {
        self.add(name, rows.as_flattened(), N);
    }

    #[track_caller]
    fn add(&mut self, name: &str, numbers: &[f64], columns: usize) {
        assert!(self.count < self.most_fields, "{NO_ROOM}");
        let name = self.kept_name(name);
        let from = self.used as usize;
        // SAFETY: Kinemark gives the address of so many numbers; names take theirs from the end
        let room = unsafe { slice::from_raw_parts_mut(self.numbers, self.most_numbers as usize) };
        let Some(place) = room[from..].get_mut(..numbers.len()) else {
            panic!("{NO_ROOM}")
        };
        place.copy_from_slice(numbers);
        let entry = Entry {
            name,
            numbers: place.as_ptr(),
            text: ptr::null(),
            count: numbers.len() as u32,
            columns: columns as u32,
        };
        // SAFETY: Kinemark gives the address of so many fields, of which this is one
        unsafe { self.fields.add(self.count as usize).write(entry) };
        self.count += 1;
        self.used += numbers.len() as u32;
    }

    /// The address of the name with a zero byte at its end, in the last of the room for numbers: it is read after the call.
    #[track_caller]
    fn kept_name(&mut self, name: &str) -> *const c_char {
        if name.is_empty() {
            return ptr::null();
        }
        assert!(
            name.len() <= LONGEST_NAME,
            "`{name}` is longer than {LONGEST_NAME} bytes"
        );
        let words = (name.len() as u32 + 1).div_ceil(8);
        assert!(words <= self.most_numbers - self.used, "{NO_ROOM}");
        self.most_numbers -= words;
        // SAFETY: so many bytes were the end of the room for numbers, and are the name's from now on
        unsafe {
            let at = self.numbers.add(self.most_numbers as usize).cast::<u8>();
            at.copy_from_nonoverlapping(name.as_ptr(), name.len());
            at.add(name.len()).write(0);
            at.cast()
        }
    }
}

#[cfg(target_pointer_width = "32")]
const _: () = {
    use core::mem::{align_of, offset_of, size_of};

    assert!(size_of::<Answer>() == 24 && align_of::<Answer>() == 4);
    assert!(offset_of!(Answer, fields) == 0);
    assert!(offset_of!(Answer, count) == 4);
    assert!(offset_of!(Answer, most_fields) == 8);
    assert!(offset_of!(Answer, numbers) == 12);
    assert!(offset_of!(Answer, used) == 16);
    assert!(offset_of!(Answer, most_numbers) == 20);

    assert!(size_of::<Entry>() == 20 && align_of::<Entry>() == 4);
    assert!(offset_of!(Entry, name) == 0);
    assert!(offset_of!(Entry, numbers) == 4);
    assert!(offset_of!(Entry, text) == 8);
    assert!(offset_of!(Entry, count) == 12);
    assert!(offset_of!(Entry, columns) == 16);
};

#[cfg(test)]
mod tests {
    use super::*;
    use crate::map::tests::panicked;
    use crate::text::until_zero;
    use std::string::{String, ToString as _};
    use std::vec::Vec;

    /// An answer with room for so many fields and numbers.
    fn answer(fields: usize, numbers: usize) -> Answer {
        let (most_fields, most_numbers) = (fields as u32, numbers as u32);
        let fields = Vec::<Entry>::with_capacity(fields).leak();
        Answer {
            fields: fields.as_mut_ptr(),
            count: 0,
            most_fields,
            numbers: std::vec![f64::NAN; numbers].leak().as_mut_ptr(),
            used: 0,
            most_numbers,
        }
    }

    /// What Kinemark reads: the name, the numbers and the columns of each entry.
    fn read(answer: &Answer) -> Vec<(String, &[f64], u32)> {
        // SAFETY: the fields were written by `answer`
        unsafe {
            let fields = slice::from_raw_parts(answer.fields, answer.count as usize);
            let fields = fields.iter().map(|entry| {
                let name = match entry.name.is_null() {
                    true => "(itself)".to_string(),
                    false => until_zero(entry.name).to_string(),
                };
                let numbers = slice::from_raw_parts(entry.numbers, entry.count as usize);
                (name, numbers, entry.columns)
            });
            fields.collect()
        }
    }

    #[test]
    fn entries_keep_their_names_and_shapes() {
        let mut out = answer(4, 20);
        out.number("inertia", 0.5);
        out.list("gains", &[1.0, 2.0]);
        out.matrix("mass", &[[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]]);
        out.list("none", &[]);
        assert_eq!(
            read(&out),
            [
                ("inertia".to_string(), &[0.5][..], 0),
                ("gains".to_string(), &[1.0, 2.0], 2),
                ("mass".to_string(), &[1.0, 2.0, 3.0, 4.0, 5.0, 6.0], 3),
                ("none".to_string(), &[], 0),
            ]
        );
        let mut out = answer(1, 1);
        out.number("", 2.0);
        assert_eq!(read(&out), [("(itself)".to_string(), &[2.0][..], 0)]);
    }

    #[test]
    fn names_and_numbers_share_the_room() {
        // a name of 7 bytes and its zero byte take the room of a number
        let mut out = answer(9, 3);
        out.list("seven77", &[1.0, 2.0]);
        assert_eq!(read(&out), [("seven77".to_string(), &[1.0, 2.0][..], 2)]);
        for (fields, numbers, name) in [
            (9, 2, "seven77"),
            (9, 3, "eight888"),
            (0, 9, "a"),
            (9, 0, "a"),
        ] {
            assert_eq!(
                panicked(|| answer(fields, numbers).list(name, &[1.0, 2.0])),
                NO_ROOM
            );
        }
    }
}
