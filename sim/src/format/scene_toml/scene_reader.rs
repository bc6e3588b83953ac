//! From the tables of a scene file to the scene: every number in its range, every body whole.

use std::ops::Range;

use nalgebra::Vector3;

use super::scene_problem::{SceneError, SceneProblem};
use super::scene_tables::{
    BodyTable, BodyType, EnvironmentTable, SceneFile, SceneTables, WindTable,
};
use crate::model::air::{AIR_DENSITY_KG_M3, Drag};
use crate::model::gust::Gust;
use crate::model::inertia::{Inertia, Solid, principal_moments};
use crate::model::robot::{Contact, Shape};
use crate::model::scene::{BodyKind, Environment, Scene, SceneBody, Wind};
use crate::part::document::Tables as _;
use crate::part::part_problem::PartProblem;
use crate::part::part_tables::{ContactTable, ShapeTable};
use crate::part::values::{Allowed, Values};
use crate::spatial::Twist;
use crate::text::{Dimension, Spanned};

/// A scene has at most this many bodies: far more than a lab needs, and few enough that their contacts fit a step.
const MOST_BODIES: usize = 1000;

/// Beyond this, forces are lost in rounding \[kg\].
const MOST_MASS_KG: f64 = 1e9;
/// The least part of its greatest principal moment that a body has about each axis: below, it is a line without thickness.
const LEAST_MOMENT: f64 = 1e-9;

impl SceneFile {
    /// Makes the scene, with the dimensions `changed` instead of the file's (those of a variant or a hidden case).
    ///
    /// # Errors
    /// Whatever makes the file no scene: see [`SceneProblem`].
    pub fn build(&self, changed: &[(String, Dimension)]) -> Result<Scene, SceneError> {
        let dimensions = self.changed(changed)?;
        let values = self.values(&dimensions);
        Resolver { file: self, values }.scene()
    }
}

pub(super) struct Resolver<'a> {
    pub(super) file: &'a SceneFile,
    pub(super) values: Values<'a>,
}

impl Resolver<'_> {
    pub(super) fn err<T>(
        &self,
        at: Range<usize>,
        problem: impl Into<SceneProblem>,
    ) -> Result<T, SceneError> {
        self.file.err(at, problem)
    }

    fn scene(&self) -> Result<Scene, SceneError> {
        let tables = &self.file.tables;
        if tables.bodies.len() > MOST_BODIES {
            let problem = PartProblem::TooLarge {
                kind: SceneTables::KIND,
                parts: "bodies",
                found: tables.bodies.len(),
                most: MOST_BODIES,
            };
            return self.err(tables.name.span(), problem);
        }
        let names = tables.bodies.iter().map(|body| &body.name);
        let help = "a name is not empty, and `world` and `ground` are taken";
        self.values
            .check_names("body", names, &["world", "ground"], help)?;
        Ok(Scene {
            name: tables.name.get_ref().clone(),
            environment: self.environment(&tables.environment)?,
            bodies: tables
                .bodies
                .iter()
                .map(|table| self.body(table))
                .collect::<Result<_, _>>()?,
        })
    }

    fn environment(&self, table: &EnvironmentTable) -> Result<Environment, SceneError> {
        let EnvironmentTable {
            gravity_m_s2,
            ground,
            wind,
        } = table;
        Ok(Environment {
            gravity_m_s2: match gravity_m_s2 {
                Some(gravity) => self.values.vector(gravity, "gravity_m_s2")?,
                None => Environment::default().gravity_m_s2,
            },
            ground: ground
                .as_ref()
                .map(|ground| self.contact(ground, &[]))
                .transpose()?,
            wind: wind.as_ref().map(|wind| self.wind(wind)).transpose()?,
        })
    }

    fn wind(&self, table: &WindTable) -> Result<Wind, SceneError> {
        let velocity_m_s = self
            .values
            .vector(table.velocity_m_s.get_ref(), "velocity_m_s")?;
        let air_density_kg_m3 = match &table.air_density_kg_m3 {
            Some(density) => {
                self.values
                    .bounded(density, "air_density_kg_m3", Allowed::Positive)?
            }
            None => AIR_DENSITY_KG_M3,
        };
        let gust = match &table.gust {
            None => None,
            Some(gust) if velocity_m_s == Vector3::zeros() => {
                return self.err(gust.span(), SceneProblem::GustWithoutWind);
            }
            Some(gust) => {
                let gust = gust.get_ref();
                let number = |n, what, allowed| self.values.bounded(n, what, allowed);
                Some(Gust {
                    speed_m_s: number(&gust.speed_m_s, "speed_m_s", Allowed::NotNegative)?,
                    correlation_s: number(&gust.correlation_s, "correlation_s", Allowed::Positive)?,
                    seed: gust.seed,
                })
            }
        };
        Ok(Wind {
            velocity_m_s,
            air_density_kg_m3,
            gust,
        })
    }

    fn body(&self, table: &BodyTable) -> Result<SceneBody, SceneError> {
        let name = table.name.get_ref();
        let body_type = *table.kind.get_ref();
        if table.shapes.is_empty() {
            let body = name.clone();
            return self.err(table.name.span(), SceneProblem::NoShapes { body });
        }
        let shapes = table
            .shapes
            .iter()
            .map(|shape| self.shape(name, body_type, shape))
            .collect::<Result<Vec<_>, _>>()?;
        let inertia = self.inertia(table, &shapes)?;
        let origin = table.origin.as_ref();
        let start = self.values.origin(origin.map(Spanned::get_ref))?;
        if let Some(origin) = origin {
            self.values
                .within(origin.span(), "xyz_m", start.translation.vector.as_slice())?;
        }
        let (kind, world_from_body, twist) = match (body_type, &table.motion) {
            (BodyType::Kinematic, Some(motion)) => {
                let motion = self.motion(name, motion, origin.map(Spanned::span), start)?;
                let (pose, twist) = motion.at(0.0);
                (BodyKind::Kinematic(motion), pose, twist)
            }
            (BodyType::Kinematic, None) => {
                let problem = SceneProblem::Motion {
                    message: format!("kinematic body `{name}` has no motion"),
                    help: "add `motion`, or make it `fixed` or `free`".to_owned(),
                };
                return self.err(table.kind.span(), problem);
            }
            (_, Some(motion)) => {
                let problem = SceneProblem::Motion {
                    message: format!("only a kinematic body has a motion, and `{name}` is none"),
                    help: "make it `kinematic`; a dynamic body may start with a `velocity`"
                        .to_owned(),
                };
                return self.err(motion.span(), problem);
            }
            (BodyType::Fixed, None) => (BodyKind::Fixed, start, Twist::zero()),
            (BodyType::Free, None) => (BodyKind::Free, start, self.velocity(table)?),
        };
        if let (Some(velocity), false) = (&table.velocity, body_type == BodyType::Free) {
            let problem = SceneProblem::Motion {
                message: format!(
                    "only a dynamic body can start with a velocity, and `{name}` is not dynamic"
                ),
                help: "a kinematic body moves by its `motion`, a fixed one not at all".to_owned(),
            };
            return self.err(velocity.span(), problem);
        }
        let contact = self.contact(&table.contact, &shapes)?;
        Ok(SceneBody {
            name: name.clone(),
            kind,
            shapes,
            inertia,
            contact,
            world_from_body,
            twist,
            drag: self.drag(table)?,
        })
    }

    fn shape(
        &self,
        body: &str,
        body_type: BodyType,
        table: &Spanned<ShapeTable>,
    ) -> Result<Shape, SceneError> {
        let shape = self.values.shape(table)?;
        let size_m = match &shape.solid {
            Solid::Box { size_m } => Vector3::from(*size_m).amax(),
            Solid::Cylinder { radius_m, length_m } | Solid::Capsule { radius_m, length_m } => {
                radius_m.max(*length_m)
            }
            Solid::Sphere { radius_m } => *radius_m,
            Solid::Mesh(solid) => {
                let (low, high) = solid.mesh.bounds();
                Vector3::from(low).amax().max(Vector3::from(high).amax())
            }
        };
        let reach_m = [size_m, shape.link_from_shape.translation.vector.amax()];
        self.values
            .within(table.span(), "size and origin of a shape", &reach_m)?;
        let (Solid::Mesh(solid), Some(mesh)) = (&shape.solid, &table.get_ref().mesh) else {
            return Ok(shape);
        };
        let file = &solid.file;
        if !solid.convex && body_type != BodyType::Fixed {
            let problem = SceneProblem::OpenMesh {
                message: format!("body `{body}` moves, so its mesh `{file}` must be convex"),
                help: "add `convex = true` to take its convex hull, or split it into several"
                    .to_owned(),
            };
            return self.err(mesh.file.span(), problem);
        }
        // a mesh that encloses a volume has a hull that does
        match solid.mesh.volume_m3() {
            Err(problem) if solid.convex => {
                let message = format!("mesh `{file}` has no convex hull: {problem}");
                let help = problem.help();
                self.err(mesh.file.span(), PartProblem::Mesh { message, help })
            }
            _ => Ok(shape),
        }
    }

    fn inertia(&self, table: &BodyTable, shapes: &[Shape]) -> Result<Inertia, SceneError> {
        let name = table.name.get_ref();
        let free = *table.kind.get_ref() == BodyType::Free;
        let Some(stated) = &table.inertia else {
            if !free {
                return Ok(Inertia::zero());
            }
            let problem = SceneProblem::Mass {
                message: format!("dynamic body `{name}` has no mass"),
                help: "add `inertia = { mass_kg = 0.4 }`, or a `density_kg_m3`, or make it `fixed`"
                    .to_owned(),
            };
            return self.err(table.name.span(), problem);
        };
        let refuse = |message: String, help: &str| {
            let help = help.to_owned();
            self.err(stated.span(), PartProblem::Inertia { message, help })
        };
        for (key, given) in [
            ("accept_unphysical", stated.get_ref().accept_unphysical),
            ("balance", stated.get_ref().balance),
        ] {
            if given {
                return refuse(
                    format!("body `{name}` cannot be unphysical: contact would not hold it"),
                    &format!("leave `{key}` out"),
                );
            }
        }
        let inertia = self
            .values
            .inertia(&format!("body `{name}`"), shapes, stated)?;
        if !free {
            return Ok(inertia);
        }
        let mass = inertia.mass_kg;
        if !(mass > 0.0 && mass.is_finite()) {
            return refuse(
                format!("dynamic body `{name}` needs a positive mass, got {mass:?} kg"),
                "a body without mass cannot be moved by forces; make it `fixed` or `kinematic`",
            );
        }
        if mass > MOST_MASS_KG {
            return refuse(
                format!(
                    "dynamic body `{name}` has a mass of {mass:e} kg, at most {MOST_MASS_KG:e}"
                ),
                "what is heavier than all else stands still anyway; make it `fixed`",
            );
        }
        let [least, _, greatest] = principal_moments(&inertia.about_com_kg_m2);
        if !(least > LEAST_MOMENT * greatest && greatest.is_finite()) {
            return refuse(
                format!(
                    "dynamic body `{name}` has no moment of inertia about some axis: {least:.3e} kg m², against {greatest:.3e}"
                ),
                "give it thickness: each principal moment must be positive",
            );
        }
        self.values
            .within(stated.span(), "com_m", inertia.com_m.as_slice())?;
        Ok(inertia)
    }

    fn drag(&self, table: &BodyTable) -> Result<Option<Drag>, SceneError> {
        let Some(drag) = &table.drag else {
            return Ok(None);
        };
        let name = table.name.get_ref();
        if *table.kind.get_ref() != BodyType::Free {
            let problem = SceneProblem::Motion {
                message: format!("air moves only dynamic bodies, and `{name}` is not dynamic"),
                help: "leave `drag` out".to_owned(),
            };
            return self.err(drag.span(), problem);
        }
        let table = drag.get_ref();
        let drag = self.values.drag(table)?;
        for (at, what, value) in [
            (&table.area_m2, "area_m2", drag.area_m2),
            (&table.coefficient, "coefficient", drag.coefficient),
        ] {
            self.values.within(at.span(), what, &[value])?;
        }
        Ok(Some(drag))
    }

    fn contact(&self, table: &ContactTable, shapes: &[Shape]) -> Result<Contact, SceneError> {
        let contact = self.values.contact(table, shapes)?;
        let at = table.friction.span();
        self.values.within(at, "friction", &[contact.friction])?;
        if let Some(rolling) = &table.rolling_m {
            self.values
                .within(rolling.span(), "rolling_m", &[contact.rolling_m])?;
        }
        Ok(contact)
    }
}
