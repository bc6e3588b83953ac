//! Mesh files: what each form means, and what is said about a broken one.

use kinemark_sim::model::mesh::{Mesh, MeshProblem, Place};
use proptest::prelude::*;

pub(crate) type Corners = [[f64; 3]; 3];

/// The unit cube with a corner at the origin, as six quads wound counter-clockwise from outside.
pub(crate) const CUBE_OBJ: &str = "\
v 0 0 0
v 1 0 0
v 1 1 0
v 0 1 0
v 0 0 1
v 1 0 1
v 1 1 1
v 0 1 1
f 1 4 3 2
f 5 6 7 8
f 1 2 6 5
f 2 3 7 6
f 3 4 8 7
f 4 1 5 8
";

pub(crate) fn cube() -> Mesh {
    Mesh::parse("cube.obj", CUBE_OBJ.as_bytes()).expect("a cube")
}

pub(crate) fn corners(mesh: &Mesh) -> Vec<Corners> {
    let vertices = mesh.vertices();
    let triangles = mesh.triangles().iter();
    triangles.map(|t| t.map(|v| vertices[v as usize])).collect()
}

pub(crate) fn text_stl(triangles: &[Corners]) -> String {
    let mut text = "solid part\n".to_owned();
    for corners in triangles {
        text += " facet normal 0 0 0\n  outer loop\n";
        for [x, y, z] in corners {
            text += &format!("   vertex {x:e} {y:e} {z:e}\n");
        }
        text += "  endloop\n endfacet\n";
    }
    text + "endsolid part\n"
}

pub(crate) fn binary_stl(title: &str, triangles: &[Corners]) -> Vec<u8> {
    let mut bytes = vec![b' '; 80];
    bytes[..title.len()].copy_from_slice(title.as_bytes());
    bytes.extend((triangles.len() as u32).to_le_bytes());
    for corners in triangles {
        bytes.extend([0; 12]);
        for x in corners.iter().flatten() {
            bytes.extend((*x as f32).to_le_bytes());
        }
        bytes.extend([0; 2]);
    }
    bytes
}

fn problem(name: &str, bytes: &[u8]) -> MeshProblem {
    Mesh::parse(name, bytes).expect_err("a broken file")
}

fn message(name: &str, text: &str) -> String {
    problem(name, text.as_bytes()).to_string()
}

#[test]
fn the_three_forms_of_a_cube_are_one_mesh() {
    let cube = cube();
    assert_eq!((cube.vertices().len(), cube.triangles().len()), (8, 12));
    let corners = corners(&cube);
    let text = Mesh::parse("cube.STL", text_stl(&corners).as_bytes()).expect("text");
    let binary = Mesh::parse("a/b.c/cube.Stl", &binary_stl("part", &corners)).expect("binary");
    assert_eq!(text, cube);
    assert_eq!(binary, cube);
}

#[test]
fn text_keeps_its_digits_and_binary_has_single_precision() {
    let thin = [[[0.1, 0.2, 0.3], [1.0 / 3.0, 0.7, 1e-30], [-1e20, 5.5, 0.0]]];
    let text = Mesh::parse("a.stl", text_stl(&thin).as_bytes()).expect("text");
    let binary = Mesh::parse("a.stl", &binary_stl("", &thin)).expect("binary");
    let lowest = |mesh: &Mesh| mesh.bounds().0[1].to_bits();
    assert_eq!(lowest(&text), 0.2_f64.to_bits());
    assert_eq!(lowest(&binary), f64::from(0.2_f32).to_bits());
}

#[test]
fn a_binary_file_may_start_like_a_text() {
    let corners = corners(&cube());
    for title in ["solid part", "solid", "solid\n facet normal 0 0 1"] {
        let mesh = Mesh::parse("a.stl", &binary_stl(title, &corners)).expect(title);
        assert_eq!(mesh, cube());
    }
    // and is reported as cut off instead of being read as text
    let bytes = binary_stl("solid part", &corners);
    let cut = problem("a.stl", &bytes[..bytes.len() - 7]);
    assert!(matches!(cut, MeshProblem::BinaryLength { .. }), "{cut}");
}

#[test]
fn text_in_odd_clothes_is_read() {
    let plain = text_stl(&corners(&cube()));
    let two_solids = plain.clone() + &plain.to_uppercase().replace("PART", "");
    for text in [
        plain.replace('\n', "\r\n"),
        plain.replace("\n ", "  \n\n\t "),
        plain.replace("part", "facet normal endsolid of \u{e9}"),
        format!("\u{feff}{plain}"),
        plain.replace("normal 0 0 0", "normal nan -nan(ind) 0"),
    ] {
        assert_eq!(Mesh::parse("a.stl", text.as_bytes()).expect(&text), cube());
    }
    let mesh = Mesh::parse("a.stl", two_solids.as_bytes()).expect("two solids");
    assert_eq!((mesh.vertices().len(), mesh.triangles().len()), (8, 24));
}

#[test]
fn a_name_in_another_encoding_is_passed_over() {
    let bytes = [
        b"solid pi\xe8ce\n",
        text_stl(&corners(&cube())).split_off(11).as_bytes(),
    ]
    .concat();
    assert_eq!(Mesh::parse("a.stl", &bytes).expect("latin 1"), cube());
}

#[test]
fn every_way_to_name_a_corner_is_read() {
    let head = "mtllib x.mtl\no part # one\nv 0 0 0 1.0\nv 1 0 0 0.5 0.5 0.5\nv 0 1 0\nvt 0 0\nvn 0 0 1\ns off\n";
    for face in [
        "f 1 2 3",
        "f 1/1 2/1 3/1",
        "f 1//1 2//1 3//1",
        "f 1/1/1 2/1/1 3/1/1 # last",
        "f -3 -2 -1",
        "f -3/-1/-1 -2/-1/-1 -1/-1/-1\r",
        "f 1 \\\n2 \\\r\n3",
    ] {
        let mesh = Mesh::parse("a.obj", format!("{head}{face}\n").as_bytes()).expect(face);
        assert_eq!(
            corners(&mesh),
            [[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]]
        );
    }
}

#[test]
fn equal_corners_become_one_vertex_and_slivers_of_two_points_go() {
    let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv -0 0 -0.0\nv 9 9 9\nf 1 2 3\nf 4 3 2\nf 1 4 2\n";
    let mesh = Mesh::parse("a.obj", text.as_bytes()).expect("two triangles");
    // the unused vertex is gone too, and does not widen the bounds
    assert_eq!(mesh.vertices().len(), 3);
    assert_eq!(mesh.triangles(), [[0, 1, 2], [0, 2, 1]]);
    assert_eq!(mesh.bounds(), ([0.0; 3], [1.0, 1.0, 0.0]));
}

#[test]
fn an_unknown_extension_names_the_known_ones() {
    for name in ["arm.dae", "stl", "arm.stl.gz", ""] {
        let unknown = problem(name, b"solid");
        assert!(unknown.to_string().contains(&format!("`{name}`")));
        let help = unknown.help().expect("a way out");
        assert!(help.contains(".stl") && help.contains(".obj"), "{help}");
    }
}

#[test]
fn a_count_is_never_believed() {
    let mut bytes = binary_stl("part", &corners(&cube()));
    bytes[80..84].copy_from_slice(&u32::MAX.to_le_bytes());
    assert_eq!(
        problem("a.stl", &bytes).to_string(),
        "the header of the binary STL counts 4294967295 triangles (byte 80), which take 214748364834 bytes, but the file has 684"
    );
    assert_eq!(
        problem("a.stl", &bytes[..83]),
        MeshProblem::NoHeader { found: 83 }
    );
    assert_eq!(problem("a.stl", b""), MeshProblem::Empty);
    assert_eq!(problem("a.obj", b""), MeshProblem::Empty);
    let none = binary_stl("part", &[]);
    assert_eq!(
        problem("a.stl", &none),
        MeshProblem::NoTriangles { dropped: 0 }
    );
}

#[test]
fn a_number_that_is_none_is_refused_where_it_stands() {
    let mut triangles = corners(&cube());
    triangles[1][2][1] = f64::NAN;
    let place = Place::Byte(84 + 50 + 12 + 4 * 7);
    assert_eq!(
        problem("a.stl", &binary_stl("", &triangles)),
        MeshProblem::NotFinite {
            place,
            found: "NaN".to_owned()
        }
    );
    let text = text_stl(&triangles);
    assert_eq!(
        message("a.stl", &text),
        "line 13: coordinate `NaN` is not a finite number"
    );
    // beyond any precision
    let text = text.replace("NaN", "1e400");
    assert!(message("a.stl", &text).contains("`1e400`"));
    let obj = "v 0 0 0\nv 0 -inf 0\n";
    assert_eq!(
        message("a.obj", obj),
        "line 2: coordinate `-inf` is not a finite number"
    );
}

#[test]
fn a_broken_text_is_named_by_its_line() {
    let stl = text_stl(&corners(&cube()));
    let cut = stl.len() / 2;
    for (text, expected) in [
        (
            stl.replacen("endloop", "vertex 0 0 0", 1),
            "line 7: expected `endloop`",
        ),
        (
            stl.replacen("vertex", "vertx", 1),
            "line 4: expected `vertex`",
        ),
        (
            stl.replacen("0e0", "0,0", 1),
            "line 4: expected a number, found `0,0`",
        ),
        (
            stl.replacen("endsolid part", "", 1),
            "found the end of the file",
        ),
        (stl[..cut].to_owned(), "found the end of the file"),
        (
            stl.clone() + "rest",
            "line 87: expected `solid` or the end of the file, found `rest`",
        ),
        ("solid".to_owned(), "line 1: expected `facet` or `endsolid`"),
        ("garbage".to_owned(), "84 bytes"),
    ] {
        let message = message("a.stl", &text);
        assert!(message.contains(expected), "{message}");
    }
    let v = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    for (text, expected) in [
        (
            "v 0 0",
            "line 1: expected three numbers after `v`, found the end of the line",
        ),
        ("v 0 0 x", "found `x`"),
        ("f 1 2", "expected three or more corners"),
        ("f 1 2 3/a", "line 4: expected a corner"),
        ("f 1 2 3/1/1/1", "expected a corner"),
        (
            "f 1 2 4",
            "line 4: vertex 4 is not there: 3 vertices come before this line",
        ),
        ("f 0 1 2", "vertex 0 is not there"),
        ("f 1 2 -4", "vertex -4 is not there"),
        ("f -9223372036854775808 1 2", "is not there"),
        ("f 99999999999999999999 1 2", "expected a corner"),
        (
            "{\"json\": 1}",
            "line 4: expected `v`, `f` or another statement",
        ),
    ] {
        let message = message(
            "a.obj",
            &format!("{v}{text}").replace(&format!("{v}v"), "v"),
        );
        assert!(message.contains(expected), "{message}");
    }
    assert!(message("a.obj", v).contains("no triangle"));
    assert!(message("a.obj", &format!("{v}f 1 1 2\n")).contains("1 in the file"));
}

#[test]
fn a_face_of_too_many_corners_is_refused() {
    let text = format!("v 0 0 0\nf{}\n", " 1".repeat(2_000_003));
    assert_eq!(
        problem("a.obj", text.as_bytes()),
        MeshProblem::TooManyTriangles
    );
}

proptest! {
    #[test]
    fn no_bytes_make_it_panic(bytes in proptest::collection::vec(any::<u8>(), 0..300)) {
        for name in ["a.stl", "a.obj"] {
            if let Ok(mesh) = Mesh::parse(name, &bytes) {
                let _ = mesh.inertia(1000.0);
            }
        }
    }

    #[test]
    fn no_damaged_file_makes_it_panic(
        at in 0_usize..2000,
        put in proptest::collection::vec(any::<u8>(), 0..6),
        take in 0_usize..60,
    ) {
        let triangles = corners(&cube());
        for (name, bytes) in [
            ("a.stl", binary_stl("solid part", &triangles)),
            ("a.stl", text_stl(&triangles).into_bytes()),
            ("a.obj", CUBE_OBJ.as_bytes().to_vec()),
        ] {
            let mut bytes = bytes;
            let at = at % bytes.len();
            let end = (at + take).min(bytes.len());
            bytes.splice(at..end, put.iter().copied());
            match Mesh::parse(name, &bytes).and_then(|mesh| mesh.inertia(1000.0)) {
                Ok(inertia) => prop_assert!(inertia.mass_kg > 0.0),
                Err(problem) => prop_assert!(problem.to_string().len() < 600),
            }
        }
    }
}
