//! Errors of meshes, worded for the person who exported the mesh.

use std::fmt;

use super::surface::MAX_TRIANGLES;

/// A position in a mesh file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Place {
    /// Offset from the start of a binary file.
    Byte(usize),
    /// Line of a text file, from one.
    Line(usize),
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Byte(offset) => write!(f, "byte {offset}"),
            Self::Line(line) => write!(f, "line {line}"),
        }
    }
}

/// An error of a mesh. Coordinates are those of the mesh: those in the file until it is scaled.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[expect(missing_docs, reason = "each message says what its variant is")]
pub enum MeshProblem {
    #[error("`{name}` is not a mesh format that this version reads")]
    UnknownFormat { name: String },
    #[error("the mesh file is empty")]
    Empty,
    #[error(
        "an STL file starts with `solid` or with a header of 84 bytes, but this one has {found} bytes and neither"
    )]
    NoHeader { found: usize },
    #[error(
        "the header of the binary STL counts {count} triangles (byte 80), which take {expected} bytes, but the file has {found}"
    )]
    BinaryLength {
        count: u32,
        expected: u64,
        found: usize,
    },
    #[error("{place}: coordinate {found} is not a finite number")]
    NotFinite { place: Place, found: String },
    #[error("line {line}: expected {expected}, found {found}")]
    Syntax {
        line: usize,
        expected: &'static str,
        found: String,
    },
    #[error("line {line}: vertex {index} is not there: {count} vertices come before this line")]
    NoSuchVertex {
        line: usize,
        index: i64,
        count: usize,
    },
    #[error("the mesh has more than {MAX_TRIANGLES} triangles")]
    TooManyTriangles,
    #[error("the mesh has no triangle{}", dropped_words(*.dropped))]
    NoTriangles { dropped: usize },
    #[error(
        "the mesh is not closed: {} open, {}",
        counted(*.open_edges, "edge is", "edges are"),
        edge_list(.first, *.open_edges)
    )]
    Leaky {
        open_edges: usize,
        first: Vec<[[f64; 3]; 2]>,
    },
    #[error(
        "{} wound against {} neighbours (a flipped triangle): {}",
        counted(*.count, "triangle is", "triangles are"),
        if *.count == 1 { "its" } else { "their" },
        triangle_list(.first, *.count)
    )]
    Flipped {
        count: usize,
        first: Vec<[[f64; 3]; 3]>,
    },
    #[error(
        "{} shared by more than two triangles: {}",
        counted(*.edges, "edge is", "edges are"),
        edge_list(.first, *.edges)
    )]
    Crowded {
        edges: usize,
        first: Vec<[[f64; 3]; 2]>,
    },
    #[error(
        "the mesh has only one side, as a Möbius strip has: no winding separates inside from outside"
    )]
    OneSided,
    #[error(
        "the mesh is inside out: its triangles face inwards (signed volume {volume_m3:.6e} m³); flip them"
    )]
    InsideOut { volume_m3: f64 },
    #[error(
        "one of the {shells} shells of the mesh is inside out and in no other shell: the one with the vertex {}; flip its triangles",
        point(*.vertex)
    )]
    ShellInsideOut { shells: usize, vertex: [f64; 3] },
    #[error("the mesh encloses no volume: its triangles lie flat on one another")]
    NoVolume,
    #[error("the mesh is too large to be weighed: its volume or inertia is not a finite number")]
    TooLarge,
    #[error("{what} of a mesh must be positive and finite, got {found} {unit}")]
    Amount {
        what: &'static str,
        unit: &'static str,
        found: f64,
    },
}

impl MeshProblem {
    /// What to do, if there is more to say than the message.
    pub fn help(&self) -> Option<String> {
        let help = match self {
            Self::UnknownFormat { .. } => "known here: .stl (binary or text), .obj",
            Self::Empty | Self::NoHeader { .. } | Self::NoTriangles { .. } => {
                "export the mesh again, as triangles"
            }
            Self::BinaryLength { .. } => {
                "the file was cut off, or changed as if it were text; copy or export it again"
            }
            Self::NotFinite { .. } => "export the mesh again, without broken vertices",
            Self::Syntax { .. } => "correct the line, or export the mesh again as triangles",
            Self::NoSuchVertex { .. } => {
                "vertices count from 1 over the whole file; -1 is the latest, 0 is none"
            }
            Self::TooManyTriangles => "decimate the mesh: a link rarely needs more than 20000",
            Self::Leaky { .. } => {
                "fill the holes and merge vertices that lie on one another, or give the link its mass, com and tensor"
            }
            Self::Flipped { .. } => "recalculate the normals to the outside and export again",
            Self::Crowded { .. } => {
                "remove doubled and inner faces, so that each edge has two triangles"
            }
            Self::OneSided => "rebuild the surface as the skin of a solid",
            Self::InsideOut { .. } | Self::ShellInsideOut { .. } => {
                "recalculate the normals to the outside; a mirror in the exporter does this too"
            }
            Self::NoVolume => {
                "give the surface a thickness, or give the link its mass, com and tensor"
            }
            Self::TooLarge => "check the scale: lengths are in metres",
            Self::Amount { .. } => return None,
        };
        Some(help.to_owned())
    }
}

fn dropped_words(dropped: usize) -> String {
    if dropped == 0 {
        return String::new();
    }
    format!(" that is one: {dropped} in the file, each with two equal corners")
}

fn counted(count: usize, one: &str, many: &str) -> String {
    format!("{count} {}", if count == 1 { one } else { many })
}

/// Seven significant digits: all that single precision resolves, without its noise.
fn coordinate(x: f64) -> String {
    let rounded: f64 = format!("{x:.6e}").parse().unwrap_or(x);
    format!("{rounded:?}")
}

fn point([x, y, z]: [f64; 3]) -> String {
    format!("({}, {}, {})", coordinate(x), coordinate(y), coordinate(z))
}

fn edge_list(first: &[[[f64; 3]; 2]], count: usize) -> String {
    let edges = first
        .iter()
        .map(|[a, b]| format!("{} to {}", point(*a), point(*b)));
    with_rest(edges.collect(), count)
}

fn triangle_list(first: &[[[f64; 3]; 3]], count: usize) -> String {
    let triangles = first.iter().map(|corners| corners.map(point).join(" "));
    with_rest(triangles.collect(), count)
}

fn with_rest(named: Vec<String>, count: usize) -> String {
    let rest = count.saturating_sub(named.len());
    let named = named.join("; ");
    if rest == 0 {
        named
    } else {
        format!("{named}; and {rest} more")
    }
}

/// A word of a file as a message shows it: quoted, and cut where it is too long to read.
pub(crate) fn shown(word: &[u8]) -> String {
    let text = String::from_utf8_lossy(word.get(..40).unwrap_or(word));
    let more = if word.len() > 40 { "..." } else { "" };
    format!("`{}{more}`", text.escape_debug())
}
