//! Robots typed as a row of joints: `RzRyRz` turns about z, y, z; `TzRxTy` slides along z, turns about x, slides along y.
//!
//! All link frames are aligned with the world at `q = 0`. Joint 1 stands at the base's height on the z axis; each link leads from
//! its joint by `(lx, ly, lz)` to the next, and the last one to the tip, frame `tcp`. Links that move are solid, of one material.
//!
//! `H = Tz(base) J1(q1) Trans(l1) J2(q2) Trans(l2) ...`; turns are right-handed, in radians, slides in metres.

use nalgebra::{Matrix3, Vector3};

use super::assembly::assembler::{MOST_LINKS, axes_with_z_along};
use super::assembly::description::{Description, FramePart, JointPart, LinkPart, UnphysicalWords};
use super::robot_problem::{RobotError, RobotProblem};
use crate::model::inertia::{Inertia, Solid};
use crate::model::robot::{JointKind, Robot, Shape};
use crate::spatial::{Pose, pose};
use crate::text::{Dimension, Dimensions, Source, Spanned};

/// A drawn link is this part of the longest link thick.
const DRAWN_RADIUS: f64 = 0.03;

/// The density of a link where none is given: aluminium \[kg/m³\].
pub const ALUMINIUM_KG_M3: f64 = 2700.0;

/// Whether `text` starts like a joint string, so that what is wrong with it is worth telling.
pub fn looks_like_one(text: &str) -> bool {
    let mut letters = text.chars();
    matches!(letters.next(), Some('R' | 'T' | 'P'))
        && matches!(letters.next(), Some('x' | 'y' | 'z'))
}

fn joint_string(text: &str) -> Source {
    Source::new("joint string", text)
}

/// How many joints a joint string has.
///
/// # Errors
/// A problem at the letter that does not fit.
pub fn joint_count(text: &str) -> Result<usize, RobotError> {
    joints(&joint_string(text)).map(|joints| joints.len())
}

/// Makes the robot of a joint string.
///
/// `base_m` is the height of the first joint; `links_m` holds one `lx, ly, lz` per joint in metres, separated by semicolons, as in
/// `"0,0,4; 3,0,0; 1,0,0"`. A link is a cylinder, 0.03 of the longest link (or of the base, if that is higher) in radius; a link without
/// length is a ball of that radius. With `density_kg_m3` the links that move have mass, with 0 none has. Joints are called `joint1` and
/// on, links `base`, `link1` and on.
///
/// # Errors
/// A problem at the letter or the link that does not fit; a density that is negative or not finite.
pub fn robot(
    text: &str,
    base_m: f64,
    links_m: &str,
    density_kg_m3: f64,
) -> Result<Robot, RobotError> {
    let source = joint_string(text);
    let joints = joints(&source)?;
    let links = links(&Source::new("links", links_m), joints.len())?;
    made(
        source,
        &joints,
        base_m,
        &links,
        (density_kg_m3, Dimensions::default()),
    )
}

/// Names of the dimensions of a joint string in a lab, beside `link1`, `link2` and so on: the height of the first joint \[m\], and the
/// density of the links \[kg/m³\].
const BASE_HEIGHT: &str = "base_height";
const DENSITY: &str = "density";

/// The dimensions of a joint string, each link one metre along z, of aluminium, on the ground.
///
/// # Errors
/// A problem at the letter that does not fit.
pub(super) fn dimensions(source: &Source) -> Result<Dimensions, RobotError> {
    let links = 1..=joints(source)?.len();
    let link = |number| (link_name(number), Dimension::List(vec![0.0, 0.0, 1.0]));
    let base = (BASE_HEIGHT.to_owned(), Dimension::Number(0.0));
    let density = (DENSITY.to_owned(), Dimension::Number(ALUMINIUM_KG_M3));
    Ok(Dimensions::from_pairs(
        std::iter::once(base)
            .chain(links.map(link))
            .chain([density]),
    ))
}

/// The robot of a joint string with these dimensions, all of those that it has.
///
/// # Errors
/// As [`robot`].
pub(super) fn robot_of_dimensions(
    source: &Source,
    dimensions: Dimensions,
) -> Result<Robot, RobotError> {
    let joints = joints(source)?;
    let number = |name: &str| match dimensions.get(name) {
        Some(Dimension::Number(number)) => *number,
        _ => f64::NAN,
    };
    let link = |number: usize| match dimensions.get(&link_name(number)) {
        Some(Dimension::List(list)) if list.len() == 3 => Vector3::from_column_slice(list),
        _ => Vector3::repeat(f64::NAN),
    };
    let links: Vec<Vector3<f64>> = (1..=joints.len()).map(link).collect();
    let (base_m, density_kg_m3) = (number(BASE_HEIGHT), number(DENSITY));
    made(
        source.clone(),
        &joints,
        base_m,
        &links,
        (density_kg_m3, dimensions),
    )
}

fn link_name(number: usize) -> String {
    format!("link{number}")
}

fn made(
    source: Source,
    joints: &[Token],
    base_m: f64,
    links: &[Vector3<f64>],
    (density_kg_m3, dimensions): (f64, Dimensions),
) -> Result<Robot, RobotError> {
    let text = source.text().to_owned();
    if !base_m.is_finite() {
        let message = format!("the base's height must be a finite number of metres, got {base_m}");
        return refuse(&source, 0..text.len(), message, "write --base 2");
    }
    if !(density_kg_m3.is_finite() && density_kg_m3 >= 0.0) {
        let message =
            format!("the density must be zero or more and finite, got {density_kg_m3} kg/m³");
        let help = "write --density 2700 for aluminium, or 0 for links without mass";
        return refuse(&source, 0..text.len(), message, help);
    }
    let longest = links.iter().map(Vector3::norm).fold(base_m.abs(), f64::max);
    let whole = 0..text.len();
    let named = |name: String| Spanned::new(whole.clone(), name);
    let link = |name: String, end: Vector3<f64>| LinkPart {
        shapes: drawn(end, DRAWN_RADIUS * longest),
        ..LinkPart::bare(named(name))
    };
    let mut at = Vector3::new(0.0, 0.0, base_m);
    let mut parts = Description {
        name: text,
        at: whole.clone(),
        dimensions,
        links: vec![link("base".to_owned(), at)],
        joints: Vec::new(),
        frames: Vec::new(),
        loops: Vec::new(),
        warnings: Vec::new(),
        unphysical: UnphysicalWords::NONE,
        source,
    };
    let mut carrier = "base".to_owned();
    for (i, (joint, end)) in joints.iter().zip(links).enumerate() {
        let name = format!("link{}", i + 1);
        let mut moved = link(name.clone(), *end);
        moved.inertia = solid(&moved.shapes, density_kg_m3);
        parts.links.push(moved);
        let mut part = JointPart::fixed(
            Spanned::new(joint.at.clone(), format!("joint{}", i + 1)),
            named(carrier),
            named(name.clone()),
            pose(Matrix3::identity(), at),
        );
        part.kind = joint.kind;
        part.axis = joint.axis;
        parts.joints.push(part);
        carrier = name;
        at = *end;
    }
    parts.frames.push(FramePart {
        name: named("tcp".to_owned()),
        link: named(carrier),
        link_from_frame: Pose::translation(at.x, at.y, at.z),
    });
    parts.assemble()
}

/// A link to `end`, as thick as it is drawn; nothing where the radius is no size.
fn drawn(end: Vector3<f64>, radius_m: f64) -> Vec<Shape> {
    if !(radius_m > 0.0 && radius_m.is_finite()) {
        return Vec::new();
    }
    let length_m = end.norm();
    if length_m > 0.0 {
        let axes = axes_with_z_along(&(end / length_m));
        vec![Shape {
            solid: Solid::Cylinder { radius_m, length_m },
            link_from_shape: pose(axes, end / 2.0),
        }]
    } else {
        vec![Shape {
            solid: Solid::Sphere { radius_m },
            link_from_shape: Pose::identity(),
        }]
    }
}

/// The mass properties of shapes of one density; none where they are beyond what a number can hold.
fn solid(shapes: &[Shape], density_kg_m3: f64) -> Inertia {
    let of_shape = |shape: &Shape| {
        let mass_kg = density_kg_m3 * shape.solid.volume_m3().ok()?;
        let inertia = shape.solid.inertia(mass_kg).ok()?;
        Some(inertia.seen_from(&shape.link_from_shape))
    };
    let parts = shapes.iter().filter_map(of_shape);
    let sum = parts.fold(Inertia::zero(), |sum, part| sum.plus(&part));
    let about_origin = sum.about_origin_kg_m2().to_matrix();
    if sum.mass_kg > 0.0 && about_origin.iter().all(|x| x.is_finite()) {
        sum
    } else {
        Inertia::zero()
    }
}

fn refuse<T>(
    source: &Source,
    at: std::ops::Range<usize>,
    message: String,
    help: &str,
) -> Result<T, RobotError> {
    let problem = RobotProblem::Own {
        code: "robot::config_string",
        message,
        label: "here".to_owned(),
        help: Some(help.to_owned()),
    };
    Err(RobotError::new(problem, source, at))
}

struct Token {
    kind: JointKind,
    axis: Vector3<f64>,
    at: std::ops::Range<usize>,
}

fn joints(source: &Source) -> Result<Vec<Token>, RobotError> {
    const HELP: &str =
        "write pairs like Rz (turns about z), or Tx or Px (slides along x), without spaces: RzRyRz";
    let text = source.text();
    let mut tokens = Vec::new();
    let mut letters = text.char_indices();
    while let Some((start, letter)) = letters.next() {
        let here = start..start + letter.len_utf8();
        let kind = match letter {
            'R' => JointKind::Continuous,
            'T' | 'P' => JointKind::Prismatic,
            _ => {
                let sign = text[..start].chars().count() + 1;
                let message = format!(
                    "joint string, sign {sign}: `{letter}` is not a joint (R, T or P, then x, y or z)"
                );
                return refuse(source, here, message, HELP);
            }
        };
        let axis = match letters.next() {
            Some((_, 'x')) => Vector3::x(),
            Some((_, 'y')) => Vector3::y(),
            Some((_, 'z')) => Vector3::z(),
            Some((at, other)) => {
                let message = format!("`{other}` is no axis: expected x, y or z after `{letter}`");
                return refuse(source, at..at + other.len_utf8(), message, HELP);
            }
            None => {
                let message = format!("`{letter}` at the end has no axis: expected x, y or z");
                return refuse(source, here, message, HELP);
            }
        };
        if tokens.len() == MOST_LINKS {
            let message = format!("more than {MOST_LINKS} joints");
            return refuse(source, here, message, "describe a shorter robot");
        }
        let at = start..start + 2;
        tokens.push(Token { kind, axis, at });
    }
    if tokens.is_empty() {
        let message = "an empty string has no joints".to_owned();
        return refuse(source, 0..0, message, HELP);
    }
    Ok(tokens)
}

fn links(source: &Source, joints: usize) -> Result<Vec<Vector3<f64>>, RobotError> {
    let example = vec!["0,0,1"; joints.min(4)].join("; ");
    let help = format!("write one lx,ly,lz per joint, in metres: --links \"{example}\"");
    let mut links = Vec::with_capacity(joints);
    let mut start = 0;
    for piece in source.text().split(';') {
        let at = start..start + piece.len();
        start = at.end + 1;
        if piece.trim().is_empty() && start > source.text().len() {
            break; // nothing, or nothing after the last semicolon
        }
        let numbers: Option<Vec<f64>> = piece
            .split(',')
            .map(|number| number.trim().parse().ok().filter(|x: &f64| x.is_finite()))
            .collect();
        match numbers.as_deref() {
            Some(&[x, y, z]) => links.push(Vector3::new(x, y, z)),
            _ => {
                let message = format!(
                    "link {} is `{}`: expected three finite numbers",
                    links.len() + 1,
                    piece.trim()
                );
                return refuse(source, at, message, &help);
            }
        }
    }
    if links.len() != joints {
        let plural = |n: usize, what: &str| format!("{n} {what}{}", if n == 1 { "" } else { "s" });
        let message = format!(
            "{} for {}",
            plural(links.len(), "link"),
            plural(joints, "joint")
        );
        return refuse(source, 0..source.text().len(), message, &help);
    }
    Ok(links)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kinematics::forward_kinematics;

    #[test]
    fn what_is_no_configuration_is_refused_at_its_letter() {
        for (text, column) in [
            ("", 1),
            ("R", 1),
            ("Rw", 2),
            ("RzRy3", 5),
            ("zR", 1),
            ("rzry", 1),
            ("Rz Ry", 3),
            ("RzRyRzX", 7),
            ("RzÄy", 3),
        ] {
            let error = robot(text, 0.0, "", 0.0).expect_err(text);
            assert_eq!(error.line_and_column(), (1, column), "{text}: {error}");
        }
        let error = robot("RzRxq", 0.0, "", 0.0).expect_err("q");
        assert_eq!(
            error.to_string(),
            "joint string, sign 5: `q` is not a joint (R, T or P, then x, y or z)"
        );
    }

    #[test]
    fn what_starts_with_a_joint_is_meant_as_one() {
        assert!(looks_like_one("RzRyRz") && looks_like_one("Tx?"));
        assert!(!looks_like_one("rrbot") && !looks_like_one("R"));
    }

    #[test]
    fn links_are_three_numbers_per_joint() {
        for (links, column) in [
            ("", 1),
            ("0,0,1", 1),
            ("0,0,1; 0,0", 7),
            ("0,0,1; 0,0,x", 7),
            ("0,0,1; 0,0,inf", 7),
            ("0,0,1; 0,0,1; 1,1,1", 1),
            ("0,0,1;; 0,0,1", 7),
        ] {
            let error = robot("RzTx", 0.0, links, 0.0).expect_err(links);
            assert_eq!(error.line_and_column(), (1, column), "{links}: {error}");
        }
        assert!(robot("RzTx", 0.0, "0,0,1; 0,0,1;", 0.0).is_ok());
        assert!(robot("RzTx", f64::NAN, "0,0,1; 0,0,1", 0.0).is_err());
    }

    #[test]
    fn links_have_the_mass_of_their_material() {
        // cylinders of 2 m and 1 m, 0.03 of 2 m in radius, and a ball where there is no length
        let arm = robot("RzRyRx", 0.5, "0,0,2; 0,0,0; 1,0,0", ALUMINIUM_KG_M3).unwrap();
        let r: f64 = 0.06;
        let area = std::f64::consts::PI * r * r;
        let masses: Vec<f64> = arm.links().iter().map(|l| l.inertia.mass_kg).collect();
        let expected = [
            0.0,
            2.0 * area * 2700.0,
            4.0 / 3.0 * area * r * 2700.0,
            area * 2700.0,
        ];
        for (mass, expected) in masses.iter().zip(expected) {
            assert!(
                (mass - expected).abs() <= 1e-12 * expected,
                "{mass} {expected}"
            );
        }
        assert_eq!(arm.links()[3].inertia.com_m, Vector3::new(0.5, 0.0, 0.0));
        // m (3 r² + l²) / 12 across, m r² / 2 along
        let of = &arm.links()[3].inertia;
        let across = of.mass_kg * (3.0 * r * r + 1.0) / 12.0;
        assert!((of.about_com_kg_m2.yy - across).abs() < 1e-12);
        assert!((of.about_com_kg_m2.xx - of.mass_kg * r * r / 2.0).abs() < 1e-12);
        let light = robot("Rz", 0.0, "1,0,0", 0.0).unwrap();
        assert_eq!(light.mass_kg().to_bits(), 0.0_f64.to_bits());
        // beyond what a number holds there is no mass, and no panic
        assert!(robot("Rz", 0.0, "1e150,0,0", ALUMINIUM_KG_M3).is_ok());
        for density in [-1.0, f64::NAN, f64::INFINITY] {
            assert!(robot("Rz", 0.0, "1,0,0", density).is_err());
        }
    }

    #[test]
    fn a_right_angle_turns_the_next_link() {
        let arm = robot("RzTx", 2.0, "1,0,0; 0,0,0.5", 0.0).unwrap();
        let q = arm.positions(&[std::f64::consts::FRAC_PI_2, 0.25]).unwrap();
        let tip = forward_kinematics(&arm, &q).world_from(arm.tcp());
        // one metre along the turned x, a quarter more by the slide, half a metre up
        let expected = Vector3::new(0.0, 1.25, 2.5);
        assert!((tip.translation.vector - expected).norm() < 1e-15, "{tip}");
    }
}
