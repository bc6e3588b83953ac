//! Wavefront OBJ: its vertices and polygons; everything about looks is passed over.
//!
//! A polygon becomes a fan from its first corner. For one that is flat but not convex some triangles of the fan overlap with
//! opposite signs, which leaves closedness, volume and inertia right.

use crate::model::mesh::mesh_problem::{MeshProblem, Place, shown};
use crate::model::mesh::surface::{Mesh, Welder};

/// Statements that say nothing about the polygons.
const PASSED_OVER: [&str; 17] = [
    "vt", "vn", "vp", "o", "g", "s", "mg", "l", "p", "usemtl", "mtllib", "usemap", "maplib", "lod",
    "bevel", "c_interp", "d_interp",
];

/// Reads the statements line by line.
pub(super) fn read(bytes: &[u8]) -> Result<Mesh, MeshProblem> {
    let mut vertices: Vec<[f64; 3]> = Vec::new();
    let mut welder = Welder::default();
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let mut lines = bytes.split(|b| *b == b'\n').enumerate();
    while let Some((number, start)) = lines.next() {
        let line = number + 1;
        let mut statement = Vec::new();
        let mut part = start;
        // a backslash at the end continues the statement on the next line
        while let Some(head) = continued(part) {
            statement.push(head);
            part = lines.next().map_or(&[][..], |(_, next)| next);
        }
        statement.push(part);
        let mut words = statement.into_iter().flat_map(words_of);
        let Some(keyword) = words.next() else {
            continue;
        };
        match keyword {
            b"v" => vertices.push(vertex(words, line)?),
            b"f" => face(words, line, &vertices, &mut welder)?,
            other if PASSED_OVER.iter().any(|known| known.as_bytes() == other) => {}
            other => {
                return Err(MeshProblem::Syntax {
                    line,
                    expected: "`v`, `f` or another statement of a polygon mesh",
                    found: shown(other),
                });
            }
        }
    }
    welder.finish()
}

/// The line without its continuation mark, if it has one.
fn continued(line: &[u8]) -> Option<&[u8]> {
    if line.contains(&b'#') {
        return None; // the mark is part of a comment
    }
    line.strip_suffix(b"\r").unwrap_or(line).strip_suffix(b"\\")
}

/// The words before a comment.
fn words_of(line: &[u8]) -> impl Iterator<Item = &[u8]> {
    let end = line.iter().position(|b| *b == b'#').unwrap_or(line.len());
    line[..end]
        .split(u8::is_ascii_whitespace)
        .filter(|word| !word.is_empty())
}

/// Three coordinates; a weight or a colour after them is passed over.
fn vertex<'a>(
    mut words: impl Iterator<Item = &'a [u8]>,
    line: usize,
) -> Result<[f64; 3], MeshProblem> {
    let mut p = [0.0; 3];
    for x in &mut p {
        let word = words.next();
        let number = word
            .and_then(|word| std::str::from_utf8(word).ok())
            .and_then(|word| word.parse::<f64>().ok());
        *x = match (number, word) {
            (Some(x), _) if x.is_finite() => x,
            (Some(_), Some(word)) => {
                return Err(MeshProblem::NotFinite {
                    place: Place::Line(line),
                    found: shown(word),
                });
            }
            _ => {
                return Err(MeshProblem::Syntax {
                    line,
                    expected: "three numbers after `v`",
                    found: found(word),
                });
            }
        };
    }
    Ok(p)
}

/// Adds the fan of one polygon.
fn face<'a>(
    mut words: impl Iterator<Item = &'a [u8]>,
    line: usize,
    vertices: &[[f64; 3]],
    welder: &mut Welder,
) -> Result<(), MeshProblem> {
    let mut next = || {
        let word = words.next();
        word.map(|word| corner(word, line, vertices)).transpose()
    };
    let (first, second, third) = (next()?, next()?, next()?);
    let (Some(first), Some(mut before), Some(mut corner)) = (first, second, third) else {
        return Err(MeshProblem::Syntax {
            line,
            expected: "three or more corners after `f`",
            found: found(None),
        });
    };
    loop {
        welder.add([first, before, corner])?;
        before = corner;
        corner = match next()? {
            Some(corner) => corner,
            None => return Ok(()),
        };
    }
}

/// The vertex of a corner `v`, `v/vt`, `v//vn` or `v/vt/vn`.
fn corner(word: &[u8], line: usize, vertices: &[[f64; 3]]) -> Result<[f64; 3], MeshProblem> {
    let syntax = || MeshProblem::Syntax {
        line,
        expected: "a corner `v`, `v/vt`, `v//vn` or `v/vt/vn` of integers",
        found: shown(word),
    };
    let text = std::str::from_utf8(word).map_err(|_| syntax())?;
    let mut parts = text.split('/');
    let index = parts.next().unwrap_or_default();
    let index: i64 = index.parse().map_err(|_| syntax())?;
    let looks: Vec<&str> = parts.take(3).collect();
    let whole = |part: &&str| part.is_empty() || part.parse::<i64>().is_ok();
    if looks.len() > 2 || !looks.iter().all(whole) {
        return Err(syntax());
    }
    // from one, or back from the latest
    let at = if index > 0 {
        usize::try_from(index).ok().map(|i| i - 1)
    } else {
        usize::try_from(index.unsigned_abs())
            .ok()
            .and_then(|back| vertices.len().checked_sub(back))
    };
    at.and_then(|at| vertices.get(at))
        .copied()
        .ok_or(MeshProblem::NoSuchVertex {
            line,
            index,
            count: vertices.len(),
        })
}

fn found(word: Option<&[u8]>) -> String {
    word.map_or_else(|| "the end of the line".to_owned(), shown)
}
