//! Solids inside meshes: volume, centre of mass and inertia against work by hand and against primitive shapes, and what is said
//! about a mesh that bounds no solid.

use std::f64::consts::PI;

use kinemark_sim::model::inertia::{Inertia, Solid};
use kinemark_sim::model::mesh::{Mesh, MeshProblem};
use kinemark_sim::model::unphysical::Unphysical;
use kinemark_sim::spatial::{Symmetric3, pose, rotation_from_rpy_deg};
use nalgebra::{Matrix3, Vector3};
use proptest::prelude::*;

use crate::mesh_files::{CUBE_OBJ, Corners, corners, cube};

/// Rounding of a few dozen sums of numbers near one.
const ROUNDING: f64 = 1e-14;

/// A mesh of these triangles, through text that keeps every digit.
fn mesh_of(triangles: &[Corners]) -> Mesh {
    let mut text = String::new();
    for corners in triangles {
        for [x, y, z] in corners {
            text += &format!("v {x:?} {y:?} {z:?}\n");
        }
        text += "f -3 -2 -1\n";
    }
    Mesh::parse("mesh.obj", text.as_bytes()).expect("triangles")
}

fn moved(mesh: &Mesh, to: impl Fn(Vector3<f64>) -> Vector3<f64>) -> Mesh {
    let there = |p: [f64; 3]| to(Vector3::from(p)).into();
    let triangles: Vec<Corners> = corners(mesh).iter().map(|t| t.map(there)).collect();
    mesh_of(&triangles)
}

fn tetrahedron() -> Mesh {
    let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
    Mesh::parse("t.obj", text.as_bytes()).expect("a tetrahedron")
}

/// The unit icosahedron, each triangle split into four `levels` times, all vertices on the unit sphere.
fn icosphere(levels: usize) -> Mesh {
    let g = (1.0 + 5.0_f64.sqrt()) / 2.0;
    let corner = |i: usize| {
        let (a, b) = ([1.0, -1.0][i / 4 % 2], [g, -g][i / 2 % 2]);
        let p = match i % 3 {
            0 => Vector3::new(0.0, a, b),
            1 => Vector3::new(a, b, 0.0),
            _ => Vector3::new(b, 0.0, a),
        };
        p.normalize()
    };
    // four sign pairs for each of three planes
    let mut points: Vec<Vector3<f64>> = Vec::new();
    for i in 0..24 {
        if points.iter().all(|p| (p - corner(i)).norm() > 0.1) {
            points.push(corner(i));
        }
    }
    assert_eq!(points.len(), 12);
    let mut triangles = Vec::new();
    let near = |a: usize, b: usize| (points[a] - points[b]).norm() < 1.1; // an edge is 1.0515
    for a in 0..12 {
        for b in a + 1..12 {
            for c in b + 1..12 {
                if near(a, b) && near(b, c) && near(c, a) {
                    let [a, b, c] = [a, b, c].map(|i| points[i]);
                    let out = a.dot(&b.cross(&c)) > 0.0;
                    triangles.push(if out { [a, b, c] } else { [a, c, b] });
                }
            }
        }
    }
    for _ in 0..levels {
        let split = |[a, b, c]: [Vector3<f64>; 3]| {
            let [ab, bc, ca] = [a + b, b + c, c + a].map(|p| p.normalize());
            [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
        };
        triangles = triangles.into_iter().flat_map(split).collect();
    }
    let triangles: Vec<Corners> = triangles
        .iter()
        .map(|t| t.map(|p| [p.x, p.y, p.z]))
        .collect();
    mesh_of(&triangles)
}

fn assert_same(got: &Inertia, expected: &Inertia, tolerance: f64) {
    let size = expected.about_com_kg_m2.to_matrix().norm();
    let tensors = got.about_com_kg_m2.to_matrix() - expected.about_com_kg_m2.to_matrix();
    assert!(
        (got.mass_kg - expected.mass_kg).abs() <= tolerance * expected.mass_kg
            && (got.com_m - expected.com_m).norm() <= tolerance
            && tensors.norm() <= tolerance * size,
        "{got:?} against {expected:?}"
    );
}

/// A box with a mass, centred on the origin.
fn weighed_box(size_m: [f64; 3], mass_kg: f64) -> Inertia {
    Solid::Box { size_m }.inertia(mass_kg).expect("a box")
}

fn at(inertia: Inertia, x: f64, y: f64, z: f64) -> Inertia {
    inertia.seen_from(&pose(Matrix3::identity(), Vector3::new(x, y, z)))
}

#[test]
fn a_tetrahedron_is_as_worked_by_hand() {
    // ∫x² = 1/60, ∫xy = 1/120 about the right-angled corner; less V c², V = 1/6, c = 1/4
    let expected = Inertia {
        mass_kg: 6.0 / 6.0,
        com_m: Vector3::repeat(0.25),
        about_com_kg_m2: Symmetric3 {
            xx: 6.0 / 80.0,
            yy: 6.0 / 80.0,
            zz: 6.0 / 80.0,
            xy: 6.0 / 480.0,
            xz: 6.0 / 480.0,
            yz: 6.0 / 480.0,
        },
    };
    assert_same(
        &tetrahedron().inertia(6.0).expect("solid"),
        &expected,
        ROUNDING,
    );
    let volume = tetrahedron().volume_m3().expect("solid");
    assert!((volume - 1.0 / 6.0).abs() < 1e-16);
}

#[test]
fn a_scaled_cube_is_a_box() {
    let scale = [0.2, 0.05, 3.0];
    let expected = at(weighed_box(scale, 2.5), 0.1, 0.025, 1.5);
    let mesh = cube().scaled(scale);
    assert_same(
        &mesh.inertia_of_mass(2.5).expect("solid"),
        &expected,
        ROUNDING,
    );
    let density = 2.5 / (scale[0] * scale[1] * scale[2]);
    assert_same(&mesh.inertia(density).expect("solid"), &expected, ROUNDING);
    assert_eq!(mesh.bounds(), ([0.0; 3], scale));
}

#[test]
fn a_mirror_image_stays_outside_out() {
    for scale in [
        [-1.0, 1.0, 1.0],
        [1.0, -2.0, 1.0],
        [-1.0, -1.0, -1.0],
        [-1.0, -1.0, 1.0],
    ] {
        let inertia = tetrahedron().scaled(scale).inertia(6.0).expect("solid");
        let expected = Vector3::from(scale) * 0.25;
        assert!((inertia.com_m - expected).norm() < ROUNDING);
        assert!(inertia.mass_kg > 0.0);
    }
    // the products of inertia over the mirrored axis change sign
    let one = tetrahedron().inertia(1.0).expect("solid").about_com_kg_m2;
    let other = tetrahedron()
        .scaled([-1.0, 1.0, 1.0])
        .inertia(1.0)
        .expect("solid");
    let other = other.about_com_kg_m2;
    assert!((one.xy + other.xy).abs() < 1e-17 && (one.yz - other.yz).abs() < 1e-17);
}

#[test]
fn an_l_shaped_solid_is_two_boxes() {
    // The caps are six-gons, started at a corner from which their fan overlaps itself.
    let outline = [(2, 0), (2, 1), (1, 1), (1, 2), (0, 2), (0, 0)];
    let mut text = String::new();
    for z in [0, 1] {
        for (x, y) in outline {
            text += &format!("v {x} {y} {z}\n");
        }
    }
    text += "f 7 8 9 10 11 12\nf 1 6 5 4 3 2\n";
    for i in 1..=6 {
        let next = i % 6 + 1;
        text += &format!("f {i} {next} {} {}\n", next + 6, i + 6);
    }
    let mesh = Mesh::parse("l.obj", text.as_bytes()).expect("a mesh");
    let long = weighed_box([2.0, 1.0, 1.0], 2.0);
    let short = weighed_box([1.0, 1.0, 1.0], 1.0);
    let expected = at(long, 1.0, 0.5, 0.5).plus(&at(short, 0.5, 1.5, 0.5));
    assert_same(&mesh.inertia(1.0).expect("solid"), &expected, ROUNDING);
}

#[test]
fn finer_spheres_come_to_the_ball_by_the_square_of_their_edge() {
    let mut before: Option<[f64; 2]> = None;
    for levels in 1..=5 {
        let mesh = icosphere(levels);
        assert_eq!(mesh.triangles().len(), 20 << (2 * levels));
        let got = mesh.inertia(1.0).expect("solid");
        let i = got.about_com_kg_m2;
        assert!(got.com_m.norm() < 1e-13 && (i.xx - i.zz).abs() < 1e-13 && i.xy.abs() < 1e-13);
        let errors = [4.0 * PI / 3.0 - got.mass_kg, 8.0 * PI / 15.0 - i.xx];
        if let Some(before) = before {
            for (coarse, fine) in before.iter().zip(errors) {
                // edges halve, so the error is a fourth; the next term is of fourth order
                let ratio = coarse / fine;
                assert!((3.6..4.1).contains(&ratio), "{ratio} at {levels}");
            }
        }
        before = Some(errors);
    }
}

#[test]
fn a_solid_far_away_keeps_its_digits() {
    let offset = Vector3::new(1000.0, -2000.0, 500.0);
    let near = tetrahedron().scaled([0.1; 3]);
    let far = moved(&near, |p| p + offset);
    let expected = at(near.inertia(1.0).expect("near"), 1000.0, -2000.0, 500.0);
    // Coordinates near 2000 are rounded to 2e-13 m, 2e-12 of the edge, and the tensor is of fifth degree in them. About the
    // origin the tensor would be 1e9 times that of the body, and 1e-7 of it lost.
    assert_same(&far.inertia(1.0).expect("far"), &expected, 2e-11);
    // with nothing to round, all digits are kept
    let far = moved(&cube().scaled([0.125; 3]), |p| p + Vector3::repeat(1024.0));
    let cube = weighed_box([0.125; 3], 3.0);
    let centre = 1024.0 + 0.0625;
    assert_same(
        &far.inertia_of_mass(3.0).expect("far"),
        &at(cube, centre, centre, centre),
        ROUNDING,
    );
}

#[test]
fn shells_add_up_and_cavities_are_left_out() {
    let hull = corners(&cube().scaled([4.0; 3]));
    let hole = moved(&cube(), |p| p + Vector3::repeat(1.0));
    let inwards = corners(&hole)
        .iter()
        .map(|[a, b, c]| [*a, *c, *b])
        .collect::<Vec<_>>();
    let beside = corners(&moved(&cube(), |p| p + Vector3::new(10.0, 0.0, 0.0)));
    let solid = |size: f64| weighed_box([size; 3], size * size * size);

    let two = mesh_of(&[&hull[..], &beside[..]].concat());
    let expected = at(solid(4.0), 2.0, 2.0, 2.0).plus(&at(solid(1.0), 10.5, 0.5, 0.5));
    assert_same(&two.inertia(1.0).expect("two shells"), &expected, ROUNDING);

    // what is left and the filling are the whole
    let hollow = mesh_of(&[&hull[..], &inwards[..]].concat());
    let hollow = hollow.inertia(1.0).expect("hollow");
    let whole = hollow.plus(&at(solid(1.0), 1.5, 1.5, 1.5));
    assert_same(&whole, &at(solid(4.0), 2.0, 2.0, 2.0), ROUNDING);

    // the same shell in the open is a mistake, though the sum is positive
    let shift = |p: [f64; 3]| [p[0] + 10.0, p[1], p[2]];
    let lost: Vec<Corners> = inwards.iter().map(|t| t.map(shift)).collect();
    let problem = mesh_of(&[&hull[..], &lost[..]].concat()).volume_m3();
    assert_eq!(
        problem,
        Err(MeshProblem::ShellInsideOut {
            shells: 2,
            vertex: [11.0, 1.0, 1.0]
        })
    );
}

#[test]
fn a_hole_is_named_by_its_edges() {
    let leaky = CUBE_OBJ.replace("f 5 6 7 8\n", "");
    let mesh = Mesh::parse("a.obj", leaky.as_bytes()).expect("five faces");
    let problem = mesh.inertia(1.0).expect_err("no lid");
    assert_eq!(
        problem.to_string(),
        "the mesh is not closed: 4 edges are open, (1.0, 0.0, 1.0) to (0.0, 0.0, 1.0); (1.0, 1.0, 1.0) to (1.0, 0.0, 1.0); \
         (0.0, 0.0, 1.0) to (0.0, 1.0, 1.0); and 1 more"
    );
    assert!(
        problem
            .help()
            .is_some_and(|help| help.contains("fill the holes"))
    );
    // nearly equal is not equal: vertices that should meet are named as they are, to single precision
    let torn = CUBE_OBJ.replace("f 5 6 7 8", "v 1 1 1.0001\nf 5 6 9 8");
    let mesh = Mesh::parse("a.obj", torn.as_bytes()).expect("six faces");
    assert!(
        mesh.check_closed()
            .expect_err("torn")
            .to_string()
            .contains("1.0001")
    );
}

#[test]
fn flipped_triangles_are_distinguished_from_their_neighbours() {
    let mut triangles = corners(&icosphere(1));
    triangles[17].swap(0, 1);
    let problem = mesh_of(&triangles).check_closed().expect_err("one flipped");
    let MeshProblem::Flipped { count: 1, first } = &problem else {
        panic!("{problem}");
    };
    assert_eq!(first[..], [triangles[17]]);
    assert!(
        problem
            .to_string()
            .starts_with("1 triangle is wound against its neighbours")
    );
    // a patch whose inner triangle has no disagreeing edge at all
    let mut triangles = corners(&icosphere(2));
    for triangle in &mut triangles[..4] {
        triangle.swap(1, 2);
    }
    let problem = mesh_of(&triangles)
        .check_closed()
        .expect_err("four flipped");
    assert!(
        matches!(problem, MeshProblem::Flipped { count: 4, .. }),
        "{problem}"
    );
}

#[test]
fn inside_out_is_said() {
    let inwards: Vec<Corners> = corners(&cube())
        .iter()
        .map(|[a, b, c]| [*a, *c, *b])
        .collect();
    let problem = mesh_of(&inwards).volume_m3().expect_err("inside out");
    assert_eq!(
        problem.to_string(),
        "the mesh is inside out: its triangles face inwards (signed volume -1.000000e0 m³); flip them"
    );
}

#[test]
fn doubled_faces_and_strange_surfaces_are_refused() {
    let doubled = format!("{CUBE_OBJ}f 5 6 7 8\n");
    let mesh = Mesh::parse("a.obj", doubled.as_bytes()).expect("a mesh");
    let problem = mesh.check_closed().expect_err("doubled");
    assert!(
        matches!(problem, MeshProblem::Crowded { edges: 5, .. }),
        "{problem}"
    );

    // the projective plane on six vertices: closed, every edge twice, one side
    let faces = [
        "1 2 3", "1 3 4", "1 4 5", "1 5 6", "1 6 2", "2 3 5", "3 4 6", "4 5 2", "5 6 3", "6 2 4",
    ];
    let mut text = String::new();
    for i in 0..6 {
        text += &format!("v {i} {} {}\n", i * i, i * i * i);
    }
    for face in faces {
        text += &format!("f {face}\n");
    }
    let mesh = Mesh::parse("a.obj", text.as_bytes()).expect("a mesh");
    assert_eq!(mesh.check_closed(), Err(MeshProblem::OneSided));
}

#[test]
fn what_cannot_be_weighed_is_refused() {
    let flat = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 3 2\n";
    let flat = Mesh::parse("a.obj", flat.as_bytes()).expect("a leaf");
    assert_eq!(flat.volume_m3(), Err(MeshProblem::NoVolume));
    // rotated and far away, where rounding gives it a thickness
    let turn = rotation_from_rpy_deg([33.0, 21.0, 57.0]);
    let square = cube().scaled([1.0, 1.0, 0.0]);
    let tilted = moved(&square, |p| turn * p + Vector3::new(70.1, -300.3, 1000.7));
    assert!(tilted.volume_m3().is_err());
    assert_eq!(
        cube().scaled([1.0, 0.0, 1.0]).volume_m3(),
        Err(MeshProblem::NoVolume)
    );
    for scale in [1e100, 1e200, f64::INFINITY, f64::NAN] {
        let problem = cube().scaled([scale; 3]).inertia(1e10);
        assert_eq!(problem, Err(MeshProblem::TooLarge), "{scale}");
    }
    // thin is not flat
    let foil = cube().scaled([1.0, 1.0, 1e-9]).volume_m3().expect("foil");
    assert!((foil - 1e-9).abs() < 1e-22);
    for density in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let problem = cube().inertia(density);
        assert!(matches!(problem, Err(MeshProblem::Amount { .. })));
        assert!(cube().inertia_of_mass(density).is_err());
    }
}

#[test]
fn welding_leaves_as_many_vertices_as_euler_counts() {
    // V - E + F = 2 with E = 3F/2
    let mesh = icosphere(3);
    assert_eq!(mesh.vertices().len(), mesh.triangles().len() / 2 + 2);
}

proptest! {
    #[test]
    fn a_turned_solid_has_the_turned_tensor(
        rpy in prop::array::uniform3(-180.0..180.0),
        shift in prop::array::uniform3(-2.0..2.0),
        size in prop::array::uniform3(0.05..2.0),
    ) {
        let mesh = tetrahedron().scaled(size);
        let a_from_b = pose(rotation_from_rpy_deg(rpy), Vector3::from(shift));
        let turned = moved(&mesh, |p| a_from_b.rotation * p + a_from_b.translation.vector);
        let got = turned.inertia(700.0).expect("solid");
        // coordinates near 2 are rounded to 2e-16, 1e-14 of the least edge
        assert_same(&got, &mesh.inertia(700.0).expect("solid").seen_from(&a_from_b), 1e-12);
        prop_assert!(Unphysical::inertia(&got).is_none());
    }
}
