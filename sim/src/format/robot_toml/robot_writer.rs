//! A robot as a robot file, whatever it was read from: every number worked out, in the order of the robot.

use std::fmt::Write as _;

use nalgebra::{Matrix3, Vector3};

use crate::model::drive::Drive;
use crate::model::inertia::{Inertia, Solid};
use crate::model::joint_friction::JointFriction;
use crate::model::robot::{Joint, JointKind, Link, Robot, Shape};
use crate::model::unphysical::Unphysical;
use crate::part::toml_text::{quoted, triple};
use crate::sensor::sensor_table;
use crate::spatial::{Pose, rotation_from_rpy_deg, rpy_deg_from_rotation};

/// A rotation is written by angles if they give it back this exactly.
const SAME_ROTATION: f64 = 1e-15;

impl Robot {
    /// Writes the robot file of this robot; `mesh_path` gives the path of a mesh relative to the new file.
    ///
    /// Expressions have become numbers, so there are no dimensions. Reading it again gives the same robot but for rounding.
    pub fn to_toml(&self, mesh_path: &mut dyn FnMut(&str) -> String) -> String {
        let mut out = format!("format = 1\nname = {}\n", quoted(self.name()));
        for link in self.links() {
            let _ = write!(out, "\n[[links]]\nname = {}\n", quoted(&link.name));
            if !link.shapes.is_empty() {
                let shapes: Vec<String> = link
                    .shapes
                    .iter()
                    .map(|shape| format!("  {},\n", self::shape(shape, mesh_path)))
                    .collect();
                let _ = writeln!(out, "shapes = [\n{}]", shapes.concat());
            }
            if link.inertia != Inertia::zero() {
                let accepts = self.has_accepted(link);
                let _ = writeln!(out, "inertia = {}", inertia(&link.inertia, accepts));
            }
            if let Some(contact) = &link.contact {
                let _ = writeln!(
                    out,
                    "contact = {{ friction = {:?}, restitution = {:?}, rolling_m = {:?} }}",
                    contact.friction, contact.restitution, contact.rolling_m
                );
            }
            if let Some(drag) = &link.drag {
                let _ = writeln!(
                    out,
                    "drag = {{ area_m2 = {:?}, coefficient = {:?} }}",
                    drag.area_m2, drag.coefficient
                );
            }
        }
        for joint in self.joints() {
            self.joint_table(joint, &mut out);
        }
        for frame in &self.frames()[self.links().len()..] {
            let link = &self.links()[frame.link];
            let _ = write!(
                out,
                "\n[[frames]]\nname = {}\nlink = {}\n",
                quoted(&frame.name),
                quoted(&link.name)
            );
            let link_from_frame = link
                .attachment
                .body_from_here
                .inv_mul(&frame.attachment.body_from_here);
            line(&mut out, "origin", &link_from_frame);
        }
        for closing in self.loops() {
            let [first, second] = closing.links.map(|i| quoted(&self.links()[i].name));
            let _ = write!(
                out,
                "\n[[loops]]\ntype = \"{}\"\nlinks = [{first}, {second}]\n",
                closing.kind.name()
            );
            line(&mut out, "frame_on_first", &closing.link_from_end[0]);
            line(&mut out, "frame_on_second", &closing.link_from_end[1]);
        }
        for sensor in self.sensors() {
            sensor_table(sensor, self, &mut out);
        }
        out
    }

    /// Whether the tensor of a link is one that no body can have, and is taken as it is.
    fn has_accepted(&self, link: &Link) -> bool {
        let refused = self.unphysical().map_or(&[][..], |found| found.links());
        link.attachment.body.is_some()
            && Unphysical::inertia(&link.inertia).is_some()
            && !refused.iter().any(|refused| refused.name == link.name)
    }

    fn joint_table(&self, joint: &Joint, out: &mut String) {
        let _ = write!(
            out,
            "\n[[joints]]\nname = {}\ntype = \"{}\"\nparent = {}\nchild = {}\n",
            quoted(&joint.name),
            joint.kind.name(),
            quoted(&self.links()[joint.parent].name),
            quoted(&self.links()[joint.child].name)
        );
        line(out, "origin", &joint.parent_from_child);
        if joint.kind == JointKind::Fixed {
            return;
        }
        let _ = writeln!(out, "axis = {}", triple(&joint.axis));
        let number = |out: &mut String, key: &str, value: f64| {
            if value != 0.0 {
                let _ = writeln!(out, "{key} = {value:?}");
            }
        };
        number(out, "damping", joint.damping);
        if joint.dry_friction != JointFriction::default() {
            let _ = writeln!(out, "dry_friction = {}", friction(&joint.dry_friction));
        }
        number(out, "armature", joint.armature);
        if let Some(drive) = &joint.drive {
            let _ = writeln!(out, "drive = {{ {} }}", drive_keys(drive));
        }
        number(out, "guess", joint.guess);
        if joint.passive {
            out.push_str("passive = true\n");
        }
        if let Some(mimic) = &joint.mimic {
            let _ = writeln!(
                out,
                "mimic = {{ joint = {}, multiplier = {:?}, offset = {:?} }}",
                quoted(&self.joints()[mimic.joint].name),
                mimic.multiplier,
                mimic.offset
            );
        }
        let limits: Vec<String> = [
            ("lower", joint.limits.lower),
            ("upper", joint.limits.upper),
            ("speed", joint.limits.speed),
            ("effort", joint.limits.effort),
        ]
        .into_iter()
        .filter_map(|(key, value)| Some(format!("{key} = {:?}", value?)))
        .collect();
        if !limits.is_empty() {
            let _ = writeln!(out, "limit = {{ {} }}", limits.join(", "));
        }
    }
}

fn friction(friction: &JointFriction) -> String {
    let JointFriction { positive, negative } = friction;
    if friction.is_symmetric() {
        format!("{positive:?}")
    } else {
        format!("{{ positive = {positive:?}, negative = {negative:?} }}")
    }
}

fn drive_keys(drive: &Drive) -> String {
    let line = drive.line.map(|line| {
        let (stall, free_speed) = (line.stall, line.free_speed);
        format!("stall = {stall:?}, free_speed = {free_speed:?}, ")
    });
    format!(
        "{}ratio = {:?}, rotor_inertia = {:?}, efficiency = {:?}",
        line.unwrap_or_default(),
        drive.ratio,
        drive.rotor_inertia_kg_m2,
        drive.efficiency
    )
}

/// One key with an origin, left out where it is the identity.
fn line(out: &mut String, key: &str, pose: &Pose) {
    let parts = origin_parts(pose);
    if !parts.is_empty() {
        let _ = writeln!(out, "{key} = {{ {} }}", parts.join(", "));
    }
}

fn origin_parts(pose: &Pose) -> Vec<String> {
    let mut parts = Vec::new();
    let position = &pose.translation.vector;
    if *position != Vector3::zeros() {
        parts.push(format!("xyz_m = {}", triple(position)));
    }
    let rotation = pose.rotation.matrix();
    if *rotation != Matrix3::identity() {
        parts.push(self::rotation(rotation));
    }
    parts
}

/// By angles in degrees where they give the matrix back, else by two axes.
fn rotation(r: &Matrix3<f64>) -> String {
    let exact = rpy_deg_from_rotation(r);
    // short angles first: 90, not 90.00000000000001
    let short = exact.map(|degrees| (degrees * 1e6).round() / 1e6);
    for angles in [short, exact] {
        if (rotation_from_rpy_deg(angles) - r).amax() <= SAME_ROTATION {
            return format!("rpy_deg = {}", triple(&Vector3::from(angles)));
        }
    }
    let [x, y] = [0, 1].map(|i| triple(&r.column(i).into_owned()));
    format!("x_axis = {x}, y_axis = {y}")
}

fn shape(shape: &Shape, mesh_path: &mut dyn FnMut(&str) -> String) -> String {
    let solid = match &shape.solid {
        Solid::Box { size_m } => {
            format!("box = {{ size_m = {} }}", triple(&Vector3::from(*size_m)))
        }
        Solid::Cylinder { radius_m, length_m } => {
            format!("cylinder = {{ radius_m = {radius_m:?}, length_m = {length_m:?} }}")
        }
        Solid::Capsule { radius_m, length_m } => {
            format!("capsule = {{ radius_m = {radius_m:?}, length_m = {length_m:?} }}")
        }
        Solid::Sphere { radius_m } => format!("sphere = {{ radius_m = {radius_m:?} }}"),
        Solid::Mesh(mesh) => {
            let file = quoted(&mesh_path(&mesh.file));
            if mesh.scale.iter().all(|s| s.to_bits() == 1.0_f64.to_bits()) {
                format!("mesh = {{ file = {file} }}")
            } else {
                let scale = triple(&Vector3::from(mesh.scale));
                format!("mesh = {{ file = {file}, scale = {scale} }}")
            }
        }
    };
    let origin = origin_parts(&shape.link_from_shape);
    if origin.is_empty() {
        format!("{{ {solid} }}")
    } else {
        format!("{{ {solid}, origin = {{ {} }} }}", origin.join(", "))
    }
}

fn inertia(inertia: &Inertia, accepts: bool) -> String {
    let t = &inertia.about_com_kg_m2;
    let accepted = if accepts {
        ", accept_unphysical = true"
    } else {
        ""
    };
    format!(
        "{{ mass_kg = {:?}, com_m = {}, tensor_kg_m2 = [{:?}, {:?}, {:?}, {:?}, {:?}, {:?}]{accepted} }}",
        inertia.mass_kg,
        triple(&inertia.com_m),
        t.xx,
        t.yy,
        t.zz,
        t.xy,
        t.xz,
        t.yz
    )
}
