//! STL, binary and text: corners, three to a facet, of single precision in binary files.
//!
//! Binary: 80 bytes of anything, the count as u32, then 50 bytes a facet (normal, three corners, two bytes of colour), all
//! little-endian. Text: `solid name`, facets, `endsolid name`, one or more times.

use crate::model::mesh::mesh_problem::{MeshProblem, Place, shown};
use crate::model::mesh::surface::{MAX_TRIANGLES, Mesh, Welder};

const HEADER: usize = 84;
const FACET: usize = 50;

/// Reads either form.
pub(super) fn read(bytes: &[u8]) -> Result<Mesh, MeshProblem> {
    // A binary header may start with `solid` too, so the exact length decides, and then zero bytes, which no text has and
    // a binary file that was cut off nearly always has.
    let counted = bytes
        .get(80..HEADER)
        .and_then(|count| count.try_into().ok())
        .map(u32::from_le_bytes);
    let length_fits = counted.is_some_and(|count| binary_length(count) == bytes.len() as u64);
    if !length_fits && starts_as_text(bytes) && !bytes.contains(&0) {
        return read_text(bytes);
    }
    match counted {
        Some(count) if length_fits => read_binary(&bytes[HEADER..], count),
        Some(count) => Err(MeshProblem::BinaryLength {
            count,
            expected: binary_length(count),
            found: bytes.len(),
        }),
        None => Err(MeshProblem::NoHeader { found: bytes.len() }),
    }
}

fn binary_length(count: u32) -> u64 {
    HEADER as u64 + FACET as u64 * u64::from(count)
}

fn starts_as_text(bytes: &[u8]) -> bool {
    let start = without_mark(bytes).trim_ascii_start();
    let word = start.get(..5).unwrap_or_default();
    let rest = start.get(5);
    word.eq_ignore_ascii_case(b"solid") && rest.is_none_or(u8::is_ascii_whitespace)
}

/// Without the byte-order mark some editors put before a text.
fn without_mark(bytes: &[u8]) -> &[u8] {
    bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes)
}

fn read_binary(facets: &[u8], count: u32) -> Result<Mesh, MeshProblem> {
    if count as usize > MAX_TRIANGLES {
        return Err(MeshProblem::TooManyTriangles);
    }
    let mut welder = Welder::default();
    for (facet, bytes) in facets.chunks_exact(FACET).enumerate() {
        let mut corners = [[0.0; 3]; 3];
        // the normal, 12 bytes, is passed over: exporters leave it zero
        let numbers = bytes[12..48].as_chunks::<4>().0;
        for (i, number) in numbers.iter().enumerate() {
            let x = f32::from_le_bytes(*number);
            if !x.is_finite() {
                return Err(MeshProblem::NotFinite {
                    place: Place::Byte(HEADER + facet * FACET + 12 + 4 * i),
                    found: x.to_string(),
                });
            }
            corners[i / 3][i % 3] = f64::from(x);
        }
        welder.add(corners)?;
    }
    welder.finish()
}

fn read_text(bytes: &[u8]) -> Result<Mesh, MeshProblem> {
    let mut words = Words::new(without_mark(bytes));
    let mut welder = Welder::default();
    while let Some(word) = words.next_word() {
        if !word.eq_ignore_ascii_case(b"solid") {
            return Err(words.refusal("`solid` or the end of the file", Some(word)));
        }
        words.skip_line(); // the name, which may hold any word
        loop {
            let word = words.next_word();
            if is(word, "endsolid") {
                words.skip_line();
                break;
            }
            if !is(word, "facet") {
                return Err(words.refusal("`facet` or `endsolid`", word));
            }
            let corners = read_facet(&mut words)?;
            welder.add(corners)?;
        }
    }
    welder.finish()
}

/// What stands between `facet` and the end of `endfacet`.
fn read_facet(words: &mut Words<'_>) -> Result<[[f64; 3]; 3], MeshProblem> {
    words.expect("normal", "`normal` and three numbers")?;
    for _ in 0..3 {
        // Not read as a number: the normal of a thin triangle is often `nan`.
        if words.next_word().is_none() {
            return Err(words.refusal("`normal` and three numbers", None));
        }
    }
    words.expect("outer", "`outer loop`")?;
    words.expect("loop", "`outer loop`")?;
    let mut corners = [[0.0; 3]; 3];
    for corner in &mut corners {
        words.expect("vertex", "`vertex`: a facet has three")?;
        for x in corner {
            *x = words.coordinate()?;
        }
    }
    words.expect("endloop", "`endloop`: a facet has three vertices")?;
    words.expect("endfacet", "`endfacet`")?;
    Ok(corners)
}

fn is(word: Option<&[u8]>, expected: &str) -> bool {
    word.is_some_and(|word| word.eq_ignore_ascii_case(expected.as_bytes()))
}

/// The words of a text, in bytes because names in STL files are in any encoding, and the line each stands on.
struct Words<'a> {
    rest: &'a [u8],
    line: usize,
}

impl<'a> Words<'a> {
    fn new(rest: &'a [u8]) -> Self {
        Self { rest, line: 1 }
    }

    fn next_word(&mut self) -> Option<&'a [u8]> {
        let start = self.rest.iter().position(|b| !b.is_ascii_whitespace());
        let (space, rest) = self.rest.split_at(start.unwrap_or(self.rest.len()));
        self.line += newlines(space);
        let end = rest.iter().position(u8::is_ascii_whitespace);
        let (word, rest) = rest.split_at(end.unwrap_or(rest.len()));
        self.rest = rest;
        (!word.is_empty()).then_some(word)
    }

    fn skip_line(&mut self) {
        let end = self.rest.iter().position(|b| matches!(b, b'\n' | b'\r'));
        self.rest = &self.rest[end.unwrap_or(self.rest.len())..];
    }

    fn expect(&mut self, word: &str, expected: &'static str) -> Result<(), MeshProblem> {
        let found = self.next_word();
        if is(found, word) {
            return Ok(());
        }
        Err(self.refusal(expected, found))
    }

    fn coordinate(&mut self) -> Result<f64, MeshProblem> {
        let word = self.next_word();
        let number = word
            .and_then(|word| std::str::from_utf8(word).ok())
            .and_then(|word| word.parse::<f64>().ok());
        match (number, word) {
            (Some(x), _) if x.is_finite() => Ok(x),
            (Some(_), Some(word)) => Err(MeshProblem::NotFinite {
                place: Place::Line(self.line),
                found: shown(word),
            }),
            _ => Err(self.refusal("a number", word)),
        }
    }

    fn refusal(&self, expected: &'static str, found: Option<&[u8]>) -> MeshProblem {
        MeshProblem::Syntax {
            line: self.line,
            expected,
            found: found.map_or_else(|| "the end of the file".to_owned(), shown),
        }
    }
}

fn newlines(space: &[u8]) -> usize {
    space.iter().filter(|b| **b == b'\n').count()
}
