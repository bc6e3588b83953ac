//! Maps from names to numbers and texts: the dimensions of a robot, what a task sets, readings of sensors, what a function is given.

use core::ffi::c_char;
use core::fmt;
use core::slice::{self, ChunksExact};
use core::str::from_utf8_unchecked;

use crate::linear::array;
use crate::text::until_zero;

/// Named numbers, lists of numbers, matrices and texts.
///
/// What lies in an inner map has the name `"outer.inner"`, and what lies in a mixed list `"list[0]"`. A value that is no map is the
/// only field of one, under the name that its function's documentation says.
#[repr(C)]
pub struct Map {
    fields: *const Field,
    count: u32,
}

/// A named value of a [`Map`].
#[repr(C)]
pub struct Field {
    name: *const c_char,
    numbers: *const f64,
    text: *const c_char,
    count: u32,
    columns: u32,
}

impl Map {
    /// All fields, in the order in which the lab has them.
    pub fn fields(&self) -> &[Field] {
        // SAFETY: Kinemark gives the address of so many fields, which stay as they are during the call
        unsafe { part(self.fields, self.count) }
    }

    /// The field of this name, if there is one.
    pub fn get(&self, name: &str) -> Option<&Field> {
        self.fields().iter().find(|field| field.has_name(name))
    }

    /// The number of this name, in the unit that the lab's brief says; 1 for true and 0 for false.
    ///
    /// # Panics
    /// If there is no number of this name.
    #[track_caller]
    pub fn number(&self, name: &str) -> f64 {
        match self.numbers(name) {
            [number] => *number,
            numbers => panic!("`{name}` has {} numbers, not one", numbers.len()),
        }
    }

    /// The numbers of this name: a list, or a matrix row by row.
    ///
    /// # Panics
    /// If there are no numbers of this name.
    #[track_caller]
    pub fn numbers(&self, name: &str) -> &[f64] {
        match self.get(name) {
            Some(field) if field.text().is_none() => field.numbers(),
            _ => self.lacks("are no numbers", name),
        }
    }

    /// The numbers of this name as an array.
    ///
    /// ```
    /// # fn f(robot: &kinemark_plugin::Robot) {
    /// let [l1, l2] = robot.dimensions().array("link_lengths");
    /// # let _ = l1 + l2;
    /// # }
    /// ```
    ///
    /// # Panics
    /// If there are not `N` numbers of this name.
    #[track_caller]
    pub fn array<const N: usize>(&self, name: &str) -> [f64; N] {
        array(self.numbers(name))
    }

    /// The rows of the matrix of this name; a list is one row.
    ///
    /// # Panics
    /// If there are no numbers of this name.
    #[track_caller]
    pub fn rows(&self, name: &str) -> ChunksExact<'_, f64> {
        match self.get(name) {
            Some(field) if field.text().is_none() => field.rows(),
            _ => self.lacks("are no numbers", name),
        }
    }

    /// The text of this name.
    ///
    /// # Panics
    /// If there is no text of this name.
    #[track_caller]
    pub fn text(&self, name: &str) -> &str {
        match self.get(name).and_then(Field::text) {
            Some(text) => text,
            None => self.lacks("is no text", name),
        }
    }

    #[cold]
    #[track_caller]
    fn lacks(&self, what: &str, name: &str) -> ! {
        panic!("there {what} named `{name}`; {self:?}")
    }
}

/// The names of its fields.
impl fmt::Debug for Map {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.count == 0 {
            return f.write_str("the map is empty");
        }
        for (i, field) in self.fields().iter().enumerate() {
            f.write_str(if i == 0 { "there are `" } else { ", `" })?;
            f.write_str(field.name())?;
            f.write_str("`")?;
        }
        Ok(())
    }
}

impl Field {
    /// Its name.
    pub fn name(&self) -> &str {
        // SAFETY: Kinemark gives the address of a text, which stays as it is during the call
        unsafe { until_zero(self.name) }
    }

    /// Whether it has this name.
    fn has_name(&self, name: &str) -> bool {
        let mut at = self.name.cast::<u8>();
        // SAFETY: the text ends with a zero byte, and the reading with the first byte that differs or is zero
        unsafe {
            for byte in name.bytes() {
                if *at != byte || byte == 0 {
                    return false;
                }
                at = at.add(1);
            }
            *at == 0
        }
    }

    /// Its numbers: one, those of a list, or those of a matrix row by row; none for a text.
    pub fn numbers(&self) -> &[f64] {
        if self.numbers.is_null() {
            return &[];
        }
        // SAFETY: Kinemark gives the address of so many numbers, which stay as they are during the call
        unsafe { part(self.numbers, self.count) }
    }

    /// The rows of a matrix; a list or a number is one row.
    pub fn rows(&self) -> ChunksExact<'_, f64> {
        let columns = self.columns.max(1) as usize;
        self.numbers().chunks_exact(columns)
    }

    /// Its text; `None` for numbers.
    pub fn text(&self) -> Option<&str> {
        if self.text.is_null() {
            return None;
        }
        // SAFETY: Kinemark gives the address of so many bytes of UTF-8, which stay as they are during the call
        unsafe {
            let bytes = part(self.text.cast(), self.count);
            Some(from_utf8_unchecked(bytes))
        }
    }
}

/// So many elements at an address; none for none.
///
/// # Safety
/// There must be so many at `at`, which stay as they are for `'a`.
pub(crate) unsafe fn part<'a, T>(at: *const T, count: u32) -> &'a [T] {
    if count == 0 {
        return &[];
    }
    // SAFETY: as the caller says
    unsafe { slice::from_raw_parts(at, count as usize) }
}

#[cfg(target_pointer_width = "32")]
const _: () = {
    use core::mem::{align_of, offset_of, size_of};

    assert!(size_of::<Map>() == 8 && align_of::<Map>() == 4);
    assert!(offset_of!(Map, fields) == 0);
    assert!(offset_of!(Map, count) == 4);

    assert!(size_of::<Field>() == 20 && align_of::<Field>() == 4);
    assert!(offset_of!(Field, name) == 0);
    assert!(offset_of!(Field, numbers) == 4);
    assert!(offset_of!(Field, text) == 8);
    assert!(offset_of!(Field, count) == 12);
    assert!(offset_of!(Field, columns) == 16);
};

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use core::ffi::CStr;
    use core::ptr;
    use std::string::{String, ToString};
    use std::vec::Vec;

    pub(crate) fn numbers(name: &'static CStr, numbers: &'static [f64], columns: u32) -> Field {
        Field {
            name: name.as_ptr(),
            numbers: numbers.as_ptr(),
            text: ptr::null(),
            count: numbers.len() as u32,
            columns,
        }
    }

    fn text(name: &'static CStr, text: &'static CStr) -> Field {
        Field {
            name: name.as_ptr(),
            numbers: ptr::null(),
            text: text.as_ptr(),
            count: text.count_bytes() as u32,
            columns: 0,
        }
    }

    pub(crate) fn map(fields: Vec<Field>) -> Map {
        let fields = fields.leak();
        Map {
            fields: fields.as_ptr(),
            count: fields.len() as u32,
        }
    }

    /// The words of a panic in `function`.
    pub(crate) fn panicked(function: impl FnOnce() + std::panic::UnwindSafe) -> String {
        let payload = std::panic::catch_unwind(function).expect_err("no panic");
        let constant = payload.downcast_ref::<&str>().map(ToString::to_string);
        constant.unwrap_or_else(|| payload.downcast_ref::<String>().expect("words").clone())
    }

    fn example() -> Map {
        map(std::vec![
            numbers(c"speed", &[0.4], 0),
            numbers(c"from", &[1.0, 2.0, 3.0], 3),
            numbers(c"points", &[1.0, 2.0, 3.0, 4.0], 2),
            text(c"side", c"left"),
        ])
    }

    #[test]
    fn values_are_found_by_their_whole_names() {
        let map = example();
        assert_eq!(map.number("speed").to_bits(), 0.4_f64.to_bits());
        assert_eq!(map.numbers("from"), [1.0, 2.0, 3.0]);
        let from: [f64; 3] = map.array("from");
        assert_eq!(&from[..], map.numbers("from"));
        assert_eq!(
            map.rows("points").collect::<Vec<_>>(),
            [[1.0, 2.0], [3.0, 4.0]]
        );
        assert_eq!(map.rows("from").collect::<Vec<_>>(), [[1.0, 2.0, 3.0]]);
        assert_eq!(map.rows("speed").collect::<Vec<_>>(), [[0.4]]);
        assert_eq!(map.text("side"), "left");
        for name in ["spee", "speeds", "speed\0", "", "\0"] {
            assert!(map.get(name).is_none(), "{name:?}");
        }
        let names: Vec<&str> = map.fields().iter().map(Field::name).collect();
        assert_eq!(names, ["speed", "from", "points", "side"]);
    }

    #[test]
    fn what_is_not_there_is_said_with_what_is() {
        assert_eq!(
            panicked(|| _ = example().number("sped")),
            "there are no numbers named `sped`; there are `speed`, `from`, `points`, `side`"
        );
        assert_eq!(
            panicked(|| _ = example().numbers("side").len()),
            "there are no numbers named `side`; there are `speed`, `from`, `points`, `side`"
        );
        assert_eq!(
            panicked(|| _ = example().text("speed").len()),
            "there is no text named `speed`; there are `speed`, `from`, `points`, `side`"
        );
        assert_eq!(
            panicked(|| _ = map(Vec::new()).number("speed")),
            "there are no numbers named `speed`; the map is empty"
        );
        assert_eq!(
            panicked(|| _ = example().number("from")),
            "`from` has 3 numbers, not one"
        );
        assert_eq!(
            panicked(|| _ = example().array::<2>("from")),
            "an array of 2 is made from 3 numbers"
        );
    }
}
