//! What a motion task changes around its robot and in its joints: gravity, wind, dry friction.

use std::sync::Arc;

use kinemark_sim::dynamics::GRAVITY_M_S2;
use kinemark_sim::model::air::AIR_DENSITY_KG_M3;
use kinemark_sim::model::gust::Gust;
use kinemark_sim::model::joint_friction::JointFriction;
use kinemark_sim::model::scene::{Environment, Scene, Wind};
use kinemark_sim::text::Spanned;
use nalgebra::Vector3;

use super::{Reader, numbers};
use crate::lab::file::{FrictionAt, FrictionTable, MotionTable, WindTable};
use crate::task::problem::{LabError, problems};
use crate::task::scene::LabScene;

/// No number here is beyond this, in SI units: far beyond any lab, and its powers stay finite.
const MOST: f64 = 1e6;

/// The surroundings of a task.
pub(super) struct Surroundings {
    pub(super) scene: Option<Arc<LabScene>>,
    pub(super) air: Option<Arc<Scene>>,
    pub(super) gravity_m_s2: Vector3<f64>,
    pub(super) dry_friction: Option<Arc<[JointFriction]>>,
}

problems! {
    /// What is wrong with the surroundings of a task.
    enum SurroundingsProblem {
        TooLarge { what: &'static str }:
            "lab::out_of_range", "{what} is beyond 1e6", "out of range";
        Negative { what: &'static str, value: f64 }:
            "lab::out_of_range", "{what} must be zero or more, got {value}", "out of range";
        GustWithoutWind:
            "lab::wind", "a gust blows along the mean wind, which is zero", "has no direction",
            "give `velocity_m_s` a direction";
        Frictions { count: String, n: usize }:
            "lab::joint_count", "`dry_friction` has {count} for {n} joints", "one per joint that moves",
            "give one for all joints, or one per joint";
    }
}

impl Reader<'_> {
    /// The surroundings of a task in `scene`, if it has one: gravity, wind and joint friction of the task before those of scene and robot.
    pub(super) fn surroundings(
        &self,
        motion: &MotionTable,
        scene: Option<Arc<LabScene>>,
    ) -> Result<Surroundings, LabError> {
        let dry_friction = match &motion.dry_friction {
            None => None,
            Some(typed) => Some(self.dry_friction(typed)?),
        };
        let gravity_m_s2 = match &motion.gravity_m_s2 {
            None => None,
            Some(typed) => Some(self.report.vector(typed, "gravity")?),
        };
        let wind = match &motion.wind {
            None => None,
            Some(typed) => Some(self.wind(typed)?),
        };
        let Some(scene) = scene else {
            let gravity_m_s2 = gravity_m_s2.unwrap_or(GRAVITY_M_S2);
            let air = wind.map(|wind| Scene::of_air(gravity_m_s2, wind));
            return Ok(Surroundings {
                scene: None,
                air: air.map(Arc::new),
                gravity_m_s2,
                dry_friction,
            });
        };
        let stated = &scene.scene.environment;
        let scene = if gravity_m_s2.is_none() && wind.is_none() {
            scene
        } else {
            let environment = Environment {
                gravity_m_s2: gravity_m_s2.unwrap_or(stated.gravity_m_s2),
                wind: wind.or_else(|| stated.wind.clone()),
                ground: stated.ground,
            };
            Arc::new(scene.in_environment(environment))
        };
        Ok(Surroundings {
            gravity_m_s2: scene.scene.environment.gravity_m_s2,
            scene: Some(scene),
            air: None,
            dry_friction,
        })
    }

    fn wind(&self, typed: &Spanned<WindTable>) -> Result<Wind, LabError> {
        let table = typed.get_ref();
        let velocity_m_s = self.report.vector(&table.velocity_m_s, "the wind")?;
        let air_density_kg_m3 = match &table.air_density_kg_m3 {
            None => AIR_DENSITY_KG_M3,
            Some(density) => self.positive(density, "the density of air")?,
        };
        let gust = match &table.gust {
            None => None,
            Some(gust) if velocity_m_s == Vector3::zeros() => {
                let problem = SurroundingsProblem::GustWithoutWind;
                return self.report.refuse_at(gust, problem);
            }
            Some(gust) => Some(Gust {
                speed_m_s: self.positive(&gust.get_ref().speed_m_s, "the speed of gusts")?,
                correlation_s: self
                    .positive(&gust.get_ref().correlation_s, "the correlation of gusts")?,
                seed: gust.get_ref().seed,
            }),
        };
        Ok(Wind {
            velocity_m_s,
            air_density_kg_m3,
            gust,
        })
    }

    fn dry_friction(
        &self,
        typed: &Spanned<FrictionTable>,
    ) -> Result<Arc<[JointFriction]>, LabError> {
        let n = self.robot.n();
        let frictions: Vec<JointFriction> = match typed.get_ref() {
            FrictionTable::All(friction) => vec![of_joint(*friction); n],
            FrictionTable::Each(list) => list.iter().map(|one| of_joint(*one)).collect(),
        };
        if frictions.len() != n {
            let count = numbers(frictions.len());
            let problem = SurroundingsProblem::Frictions { count, n };
            return self.report.refuse_at(typed, problem);
        }
        for friction in &frictions {
            for value in [friction.positive, friction.negative] {
                let what = "`dry_friction`";
                if value < 0.0 {
                    let problem = SurroundingsProblem::Negative { what, value };
                    return self.report.refuse_at(typed, problem);
                }
                if value > MOST {
                    let problem = SurroundingsProblem::TooLarge { what };
                    return self.report.refuse_at(typed, problem);
                }
            }
        }
        Ok(frictions.into())
    }
}

fn of_joint(typed: FrictionAt) -> JointFriction {
    match typed {
        FrictionAt::Both(effort) => JointFriction::both(effort),
        FrictionAt::Directions { positive, negative } => JointFriction { positive, negative },
    }
}
