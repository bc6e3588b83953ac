//! What a link or a body is made of: its shapes and surface, how it resists the air, and its mass properties given or taken from the shapes.

use std::ops::Range;
use std::sync::Arc;

use nalgebra::Vector3;

use super::part_problem::{PartError, PartProblem};
use super::part_tables::{
    ContactTable, DragTable, InertiaTable, MeshTable, NumberAt, RoundTable, ShapeTable,
};
use super::values::{Allowed, Values};
use crate::model::air::Drag;
use crate::model::inertia::{Inertia, MeshSolid, Solid};
use crate::model::mesh::mesh_problem::MeshProblem;
use crate::model::robot::{Contact, Shape};
use crate::model::unphysical::Unphysical;
use crate::spatial::Symmetric3;
use crate::text::{Located, Spanned};

impl Values<'_> {
    pub(crate) fn shape(&self, table: &Spanned<ShapeTable>) -> Result<Shape, PartError> {
        let round = |round: &RoundTable| -> Result<(f64, f64), PartError> {
            Ok((
                self.number(&round.radius_m, "radius_m", Allowed::Positive)?,
                self.number(&round.length_m, "length_m", Allowed::Positive)?,
            ))
        };
        let ShapeTable {
            cuboid,
            cylinder,
            capsule,
            sphere,
            mesh,
            origin,
        } = table.get_ref();
        let solid = match (cuboid, cylinder, capsule, sphere, mesh) {
            (Some(b), None, None, None, None) => {
                let [x, y, z] = &b.size_m;
                Solid::Box {
                    size_m: [
                        self.number(x, "size_m", Allowed::Positive)?,
                        self.number(y, "size_m", Allowed::Positive)?,
                        self.number(z, "size_m", Allowed::Positive)?,
                    ],
                }
            }
            (None, Some(c), None, None, None) => {
                let (radius_m, length_m) = round(c)?;
                Solid::Cylinder { radius_m, length_m }
            }
            (None, None, Some(c), None, None) => {
                let (radius_m, length_m) = round(c)?;
                Solid::Capsule { radius_m, length_m }
            }
            (None, None, None, Some(s), None) => Solid::Sphere {
                radius_m: self.number(&s.radius_m, "radius_m", Allowed::Positive)?,
            },
            (None, None, None, None, Some(m)) => self.mesh(m)?,
            _ => {
                return self.err(
                    table.span(),
                    PartProblem::Toml {
                        message: "a shape is exactly one of `box`, `cylinder`, `capsule`, `sphere`, `mesh`"
                            .to_owned(),
                        help: Some("{ box = { size_m = [0.05, 0.05, 1.0] } }".to_owned()),
                    },
                );
            }
        };
        Ok(Shape {
            solid,
            link_from_shape: self.origin(origin.as_ref())?,
        })
    }

    fn mesh(&self, table: &MeshTable) -> Result<Solid, PartError> {
        let file = table.file.get_ref();
        let scale: Option<[f64; 3]> = match &table.scale {
            Some(scale) => Some(self.triple(scale, "scale")?.into()),
            None => None,
        };
        if scale.is_some_and(|scale| scale.contains(&0.0)) {
            return self.err(
                table.file.span(),
                PartProblem::Mesh {
                    message: format!("mesh `{file}` is scaled to nothing"),
                    help: Some("no part of `scale` may be zero".to_owned()),
                },
            );
        }
        match self.meshes.get(file) {
            Some(mesh) => Ok(Solid::Mesh(MeshSolid {
                file: file.as_str().into(),
                scale: scale.unwrap_or([1.0; 3]),
                mesh: match scale {
                    Some(scale) => Arc::new(mesh.scaled(scale)),
                    None => Arc::clone(mesh),
                },
                convex: table.convex.as_ref().is_some_and(|c| *c.get_ref()),
            })),
            None => self.err(
                table.file.span(),
                PartProblem::Mesh {
                    message: format!("mesh `{file}` was not read"),
                    help: Some(format!("meshes lie beside the {} file", self.kind)),
                },
            ),
        }
    }

    /// The surface of what has `shapes`.
    pub(crate) fn contact(
        &self,
        table: &ContactTable,
        shapes: &[Shape],
    ) -> Result<Contact, PartError> {
        let ContactTable {
            friction,
            restitution,
            rolling_m,
        } = table;
        Ok(Contact {
            friction: self.number(friction, "friction", Allowed::NotNegative)?,
            restitution: self.number_or(
                restitution.as_ref(),
                "restitution",
                Allowed::Fraction, // above one, every bounce would add energy
                0.0,
            )?,
            rolling_m: self.number_or(
                rolling_m.as_ref(),
                "rolling_m",
                Allowed::NotNegative,
                Contact::usual_rolling_m(shapes),
            )?,
        })
    }

    pub(crate) fn drag(&self, table: &DragTable) -> Result<Drag, PartError> {
        let DragTable {
            area_m2,
            coefficient,
        } = table;
        Ok(Drag {
            area_m2: self.number(area_m2, "area_m2", Allowed::NotNegative)?,
            coefficient: self.number(coefficient, "coefficient", Allowed::NotNegative)?,
        })
    }

    /// The mass properties of `owner` ("link `arm`"), in its own frame.
    pub(crate) fn inertia(
        &self,
        owner: &str,
        shapes: &[Shape],
        table: &Spanned<InertiaTable>,
    ) -> Result<Inertia, PartError> {
        if let Some(tensor) = &table.get_ref().tensor_kg_m2 {
            return self.given_inertia(owner, table, tensor);
        }
        if table.get_ref().com_m.is_some() {
            return self.refuse_inertia(
                table.span(),
                format!("{owner} has `com_m` but no `tensor_kg_m2`"),
                "leave `com_m` out to take both from the shapes, or give the tensor too",
            );
        }
        if shapes.is_empty() {
            return self.refuse_inertia(
                table.span(),
                format!("{owner} has no shapes to take its inertia from"),
                "add `shapes`, or give `com_m` and `tensor_kg_m2`",
            );
        }
        self.inertia_of_shapes(owner, shapes, table)
    }

    fn refuse_inertia<T>(
        &self,
        at: Range<usize>,
        message: String,
        help: &str,
    ) -> Result<T, PartError> {
        let help = help.to_owned();
        self.err(at, PartProblem::Inertia { message, help })
    }

    /// Mass properties written out in full; the tensor is about the centre of mass, which is the owner's origin where the file does
    /// not say. A robot's may be such as no body can have: what comes of that is for its links together.
    fn given_inertia(
        &self,
        owner: &str,
        table: &Spanned<InertiaTable>,
        tensor: &Spanned<[NumberAt; 6]>,
    ) -> Result<Inertia, PartError> {
        let given = table.get_ref();
        let Some(mass) = &given.mass_kg else {
            return self.refuse_inertia(
                table.span(),
                format!("{owner} has an inertia tensor but no mass"),
                "add `mass_kg`",
            );
        };
        let about_com_kg_m2 = self.tensor(tensor.get_ref())?;
        // contact would not hold such a body
        let is_body = self.kind == "scene";
        let allowed = if is_body {
            Allowed::NotNegative
        } else {
            Allowed::Any
        };
        let mass_kg = self.number(mass, "mass_kg", allowed)?;
        if is_body && let Some(why) = Unphysical::tensor(&about_com_kg_m2, mass_kg) {
            let help = "the order is [ixx, iyy, izz, ixy, ixz, iyz], about the centre of mass";
            return self.refuse_inertia(tensor.span(), format!("{owner}: {why}"), help);
        }
        Ok(Inertia {
            mass_kg,
            com_m: match &given.com_m {
                Some(com) => self.triple(com, "com_m")?,
                None => Vector3::zeros(),
            },
            about_com_kg_m2,
        })
    }

    /// A tensor as the file lists it: the diagonal first, then `xy`, `xz`, `yz` \[kg m²\].
    fn tensor(&self, numbers: &[NumberAt; 6]) -> Result<Symmetric3, PartError> {
        let [xx, yy, zz, xy, xz, yz] = numbers;
        let part = |n| self.number(n, "tensor_kg_m2", Allowed::Any);
        Ok(Symmetric3 {
            xx: part(xx)?,
            yy: part(yy)?,
            zz: part(zz)?,
            xy: part(xy)?,
            xz: part(xz)?,
            yz: part(yz)?,
        })
    }

    /// Mass properties from shapes of one density, which is given or follows from the mass of all of them together; overlaps count
    /// twice.
    fn inertia_of_shapes(
        &self,
        owner: &str,
        shapes: &[Shape],
        table: &Spanned<InertiaTable>,
    ) -> Result<Inertia, PartError> {
        let InertiaTable {
            mass_kg,
            density_kg_m3,
            ..
        } = table.get_ref();
        let from_mesh = |problem: MeshProblem| {
            let message = format!("{owner} cannot take its inertia from its mesh: {problem}");
            let help = problem.help();
            Located::new(
                PartProblem::Mesh { message, help },
                self.source,
                table.span(),
            )
        };
        let volumes = shapes
            .iter()
            .map(|shape| shape.solid.volume_m3().map_err(from_mesh))
            .collect::<Result<Vec<f64>, _>>()?;
        let volume: f64 = volumes.iter().sum();
        let density = match (mass_kg, density_kg_m3) {
            (Some(mass), None) => self.number(mass, "mass_kg", Allowed::NotNegative)? / volume,
            (None, Some(density)) => self.number(density, "density_kg_m3", Allowed::NotNegative)?,
            _ => {
                return self.refuse_inertia(
                    table.span(),
                    format!("{owner} needs either a mass or a density"),
                    "write `mass_kg` or `density_kg_m3`, one of them",
                );
            }
        };
        let mut sum = Inertia::zero();
        for (shape, volume) in shapes.iter().zip(volumes) {
            let mass = match (mass_kg, shapes) {
                // one shape keeps the mass as typed, without a rounding through its volume
                (Some(mass), [_]) => self.number(mass, "mass_kg", Allowed::NotNegative)?,
                _ => density * volume,
            };
            let part = shape.solid.inertia(mass).map_err(from_mesh)?;
            sum = sum.plus(&part.seen_from(&shape.link_from_shape));
        }
        Ok(sum)
    }
}
