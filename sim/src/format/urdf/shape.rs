//! Shapes of a URDF link: from `<collision>`, else from `<visual>`, with each mesh file asked for once.

use std::collections::BTreeMap;
use std::sync::Arc;

use super::origin::origin;
use crate::format::robot_format::ReadFile;
use crate::format::robot_problem::{KIND, RobotError};
use crate::format::xml::reader::{Node, Reader, elements};
use crate::model::inertia::{MeshSolid, Solid};
use crate::model::mesh::surface::Mesh;
use crate::model::robot::Shape;
use crate::part::part_problem::PartProblem;
use crate::part::shape_count::ShapeCount;
use crate::part::values::Allowed;

/// A mesh file may be used at this many scales: each is a copy of its own.
const MOST_SCALES: usize = 8;

/// The mesh files asked for so far.
pub(super) struct Meshes<'a> {
    read: &'a mut ReadFile<'a>,
    files: BTreeMap<String, Result<Copies, String>>,
    count: ShapeCount,
}

/// One mesh at the scales it is used at.
struct Copies {
    unscaled: Arc<Mesh>,
    /// By the bits of the scale.
    scaled: BTreeMap<[u64; 3], Arc<Mesh>>,
}

impl<'a> Meshes<'a> {
    pub(super) fn new(read: &'a mut ReadFile<'a>) -> Self {
        Self {
            read,
            files: BTreeMap::new(),
            count: ShapeCount::default(),
        }
    }

    /// The mesh of `file` at `scale`, or what is wrong with it.
    fn get(&mut self, file: &str, scale: [f64; 3]) -> Result<Arc<Mesh>, String> {
        if !self.files.contains_key(file) {
            let copies = self.load(file);
            self.files.insert(file.to_owned(), copies);
        }
        let copies = match self.files.get_mut(file) {
            Some(Ok(copies)) => copies,
            Some(Err(message)) => return Err(message.clone()),
            None => return Err("was not read".to_owned()),
        };
        let bits = scale.map(f64::to_bits);
        if bits == [1.0_f64.to_bits(); 3] {
            return Ok(Arc::clone(&copies.unscaled));
        }
        if let Some(mesh) = copies.scaled.get(&bits) {
            return Ok(Arc::clone(mesh));
        }
        if copies.scaled.len() >= MOST_SCALES {
            return Err(format!("is used at more than {MOST_SCALES} scales"));
        }
        let mesh = Arc::new(copies.unscaled.scaled(scale));
        copies.scaled.insert(bits, Arc::clone(&mesh));
        Ok(mesh)
    }

    fn load(&mut self, file: &str) -> Result<Copies, String> {
        if file.to_ascii_lowercase().ends_with(".dae") {
            return Err("is COLLADA, which is not supported: convert it to STL or OBJ".to_owned());
        }
        let bytes = (self.read)(file).map_err(|why| format!("not found: {why}"))?;
        let mesh = Mesh::parse(file, &bytes).map_err(|why| format!("cannot be used: {why}"))?;
        Ok(Copies {
            unscaled: Arc::new(mesh),
            scaled: BTreeMap::new(),
        })
    }
}

/// The shapes of a link.
pub(super) fn shapes(
    reader: &mut Reader<'_>,
    meshes: &mut Meshes<'_>,
    owner: &str,
    link: Node<'_>,
) -> Result<Vec<Shape>, RobotError> {
    let has_collision = elements(link).any(|child| child.tag_name().name() == "collision");
    let from = if has_collision { "collision" } else { "visual" };
    let mut shapes = Vec::new();
    for node in elements(link).filter(|child| child.tag_name().name() == from) {
        reader.check(
            node,
            owner,
            &["name", "group"],
            &["origin", "geometry", "material", "verbose", "surface"],
        );
        let link_from_shape = origin(reader, node, owner)?;
        let Some(geometry) = reader.child(node, "geometry", owner) else {
            let message = format!("{owner}: `<{from}>` without `<geometry>` is left out");
            reader.warn(Reader::tag(node), &message);
            continue;
        };
        let known = ["box", "cylinder", "sphere", "capsule", "mesh"];
        reader.check(geometry, owner, &[], &known);
        let mut solids = elements(geometry).filter(|s| known.contains(&s.tag_name().name()));
        let Some(node) = solids.next() else {
            continue;
        };
        if let Some(second) = solids.next() {
            let message = format!("{owner}: a second shape in one `<geometry>` is left out");
            reader.warn(Reader::tag(second), &message);
        }
        if let Some(solid) = solid(reader, meshes, owner, node)? {
            let at = Reader::tag(node);
            let mut counted = meshes.count.shape(KIND);
            if let (Ok(()), Solid::Mesh(mesh)) = (&counted, &solid) {
                counted = meshes.count.mesh(KIND, mesh.mesh.triangles().len());
            }
            counted.or_else(|problem| reader.err(at, problem))?;
            shapes.push(Shape {
                solid,
                link_from_shape,
            });
        }
    }
    Ok(shapes)
}

fn solid(
    reader: &mut Reader<'_>,
    meshes: &mut Meshes<'_>,
    owner: &str,
    node: Node<'_>,
) -> Result<Option<Solid>, RobotError> {
    let size = |reader: &Reader<'_>, name: &str| -> Result<f64, RobotError> {
        reader.required(node, name, owner)?;
        let size = reader.number(node, name, owner, Allowed::NotNegative)?;
        Ok(size.unwrap_or(0.0))
    };
    let (solid, sizes) = match node.tag_name().name() {
        "box" => {
            reader.check(node, owner, &["size"], &[]);
            let at = reader.required(node, "size", owner)?.span();
            let size_m = reader.triple(node, "size", owner)?.unwrap_or_default();
            if let Some(negative) = size_m.iter().find(|size| **size < 0.0) {
                let problem = PartProblem::OutOfRange {
                    what: format!("box `size` of {owner}"),
                    expected: "zero or more",
                    found: negative.to_string(),
                };
                return reader.err(at, problem);
            }
            (Solid::Box { size_m }, size_m)
        }
        "sphere" => {
            reader.check(node, owner, &["radius"], &[]);
            let radius_m = size(reader, "radius")?;
            (Solid::Sphere { radius_m }, [radius_m; 3])
        }
        round @ ("cylinder" | "capsule") => {
            reader.check(node, owner, &["radius", "length"], &[]);
            let (radius_m, length_m) = (size(reader, "radius")?, size(reader, "length")?);
            let solid = if round == "cylinder" {
                Solid::Cylinder { radius_m, length_m }
            } else {
                Solid::Capsule { radius_m, length_m }
            };
            (solid, [radius_m, radius_m, length_m])
        }
        _ => return mesh(reader, meshes, owner, node),
    };
    if sizes.contains(&0.0) {
        let message = format!(
            "{owner}: a {} without extent is left out",
            node.tag_name().name()
        );
        reader.warn(Reader::tag(node), &message);
        return Ok(None);
    }
    Ok(Some(solid))
}

fn mesh(
    reader: &mut Reader<'_>,
    meshes: &mut Meshes<'_>,
    owner: &str,
    node: Node<'_>,
) -> Result<Option<Solid>, RobotError> {
    reader.check(node, owner, &["filename", "scale"], &[]);
    let filename = reader.required(node, "filename", owner)?;
    let file = filename.get_ref();
    let scale = reader.triple(node, "scale", owner)?.unwrap_or([1.0; 3]);
    if scale.contains(&0.0) {
        let problem = PartProblem::Mesh {
            message: format!("{owner}: mesh `{file}` is scaled to nothing"),
            help: Some("no part of `scale` may be zero".to_owned()),
        };
        let at = node.attribute_node("scale").map(|a| a.range_value());
        return reader.err(at.unwrap_or(filename.span()), problem);
    }
    match meshes.get(file, scale) {
        Ok(mesh) => Ok(Some(Solid::Mesh(MeshSolid {
            file: file.as_str().into(),
            scale,
            mesh,
            convex: true, // as every mesh that moves
        }))),
        Err(why) => {
            reader.warn(filename.span(), &format!("{owner}: mesh `{file}` {why}"));
            Ok(None)
        }
    }
}
