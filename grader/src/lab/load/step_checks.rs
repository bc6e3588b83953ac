//! Checks of step responses, efforts, energy and smoothness: joints by name, windows inside the run, predictions that stay bounded.

use std::ops::Range;

use kinemark_sim::control::linear_step::Fed;
use kinemark_sim::source::suggest;
use toml::Spanned;

use super::Reader;
use crate::lab::file::step::{
    BandRadS, ChatterTable, EffortTable, OfName, RiseTimeTable, SettlingTimeTable,
    SteadyErrorTable, StepKeys, StepOvershootTable,
};
use crate::lab::file::{CheckTable, NumberAt};
use crate::lab::joint_units::JointUnits;
use crate::lab::model::{Band, CheckKind, TaskWork};
use crate::lab::problem::LabError;
use crate::lab::step::StepResponse;

/// The part at the end whose mean is the final value, where the lab does not say \[s\].
const FINAL_S: f64 = 0.2;
/// The same for the steady error \[s\].
const LAST_S: f64 = 0.5;

impl Reader<'_> {
    /// The kinds of this file that a check has.
    pub(super) fn step_kinds(
        &self,
        table: &CheckTable,
        work: &TaskWork,
    ) -> Result<Vec<CheckKind>, LabError> {
        let mut kinds = Vec::new();
        if let Some(table) = &table.rise_time {
            kinds.push(self.rise_time(table, work)?);
        }
        if let Some(table) = &table.settling_time {
            kinds.push(self.settling_time(table, work)?);
        }
        if let Some(table) = &table.step_overshoot {
            kinds.push(self.step_overshoot(table, work)?);
        }
        if let Some(table) = &table.steady_error {
            kinds.push(self.steady_error(table, work)?);
        }
        if let Some(table) = &table.effort_peak {
            let (joint, band) = self.effort(table)?;
            kinds.push(CheckKind::EffortPeak { joint, band });
        }
        if let Some(table) = &table.effort_rms {
            let (joint, band) = self.effort(table)?;
            kinds.push(CheckKind::EffortRms { joint, band });
        }
        if let Some(table) = &table.energy {
            let band = table.get_ref();
            let band = self.band(band.full_j, band.zero_j, table.span())?;
            kinds.push(CheckKind::Energy(band));
        }
        if let Some(table) = &table.joint_speed {
            let BandRadS {
                full_rad_s,
                zero_rad_s,
            } = *table.get_ref();
            let band = self.band(full_rad_s, zero_rad_s, table.span())?;
            kinds.push(CheckKind::JointSpeed(band));
        }
        if let Some(table) = &table.jerk {
            let band = table.get_ref();
            let band = self.band(band.full_m_s3, band.zero_m_s3, table.span())?;
            kinds.push(CheckKind::Jerk(band));
        }
        if let Some(table) = &table.chatter {
            let ChatterTable {
                joint,
                full_hz,
                zero_hz,
            } = table.get_ref();
            kinds.push(CheckKind::Chatter {
                joint: joint.as_ref().map(|name| self.joint(name)).transpose()?,
                band: self.band(*full_hz, *zero_hz, table.span())?,
            });
        }
        Ok(kinds)
    }

    /// Index of a joint in `q`.
    fn joint(&self, name: &Spanned<String>) -> Result<usize, LabError> {
        let joints = self.robot.moving_joints();
        let names: Vec<&str> = joints.map(|joint| joint.name.as_str()).collect();
        let found = names.iter().position(|known| known == name.get_ref());
        match found {
            Some(index) => Ok(index),
            None => self.report.err(
                name.span(),
                "lab::unknown_joint",
                format!(
                    "robot `{}` has no joint `{}` that moves",
                    self.robot.name(),
                    name.get_ref()
                ),
                "not a joint of this robot",
                Some(suggest(name.get_ref(), "joints", names.into_iter())),
            ),
        }
    }

    fn effort(&self, table: &Spanned<EffortTable>) -> Result<(Option<usize>, Band), LabError> {
        let EffortTable {
            joint,
            full_n_m,
            zero_n_m,
        } = table.get_ref();
        Ok((
            joint.as_ref().map(|name| self.joint(name)).transpose()?,
            self.band(*full_n_m, *zero_n_m, table.span())?,
        ))
    }

    fn rise_time(
        &self,
        table: &Spanned<RiseTimeTable>,
        work: &TaskWork,
    ) -> Result<CheckKind, LabError> {
        let at = table.span();
        let table = table.get_ref();
        let from = self.share(&table.from, "`from`", 0.1)?;
        let to = self.share(&table.to, "`to`", 0.9)?;
        if from >= to {
            let typed = table.from.as_ref().or(table.to.as_ref());
            return self.report.err(
                typed.map_or(at, Spanned::span),
                "lab::step",
                format!("a rise goes up: `from` must be below `to`, got {from} and {to}"),
                "this share of the step",
                Some("left out they are 0.1 and 0.9".to_owned()),
            );
        }
        let response = self.step_response(table.keys(), FINAL_S, at.clone(), work)?;
        Ok(CheckKind::RiseTime {
            response,
            from,
            to,
            band: self.band(table.full_s, table.zero_s, at)?,
        })
    }

    fn settling_time(
        &self,
        table: &Spanned<SettlingTimeTable>,
        work: &TaskWork,
    ) -> Result<CheckKind, LabError> {
        let at = table.span();
        let table = table.get_ref();
        let within = self.share(&table.within, "`within`", 0.02)?;
        let response = self.step_response(table.keys(), FINAL_S, at.clone(), work)?;
        Ok(CheckKind::SettlingTime {
            response,
            within,
            band: self.band(table.full_s, table.zero_s, at)?,
        })
    }

    fn step_overshoot(
        &self,
        table: &Spanned<StepOvershootTable>,
        work: &TaskWork,
    ) -> Result<CheckKind, LabError> {
        let at = table.span();
        let table = table.get_ref();
        let response = self.step_response(table.keys(), FINAL_S, at.clone(), work)?;
        Ok(CheckKind::StepOvershoot {
            response,
            band: self.band(table.full, table.zero, at)?,
        })
    }

    fn steady_error(
        &self,
        table: &Spanned<SteadyErrorTable>,
        work: &TaskWork,
    ) -> Result<CheckKind, LabError> {
        let at = table.span();
        let table = table.get_ref();
        let response = self.step_response(table.keys(), LAST_S, at.clone(), work)?;
        let unit = match table.of {
            OfName::Position => "rad",
            OfName::Velocity => "rad_s",
        };
        let Some(target) = response.target else {
            return self.report.err(
                at,
                "lab::step",
                "a steady error is the distance from a target".to_owned(),
                "the target is missing",
                Some(format!("add it, such as `target_{unit} = 1.0`")),
            );
        };
        let (right, wrong) = match table.of {
            OfName::Position => (
                [&table.full_rad, &table.zero_rad],
                [&table.full_rad_s, &table.zero_rad_s],
            ),
            OfName::Velocity => (
                [&table.full_rad_s, &table.zero_rad_s],
                [&table.full_rad, &table.zero_rad],
            ),
        };
        let help = format!("write `full_{unit}` and `zero_{unit}`");
        if let Some(typed) = wrong.into_iter().flatten().next() {
            return self.report.err(
                typed.span(),
                "lab::step",
                "the band has the unit of another signal than `of` names".to_owned(),
                "of the wrong unit",
                Some(help),
            );
        }
        let [Some(full), Some(zero)] = right else {
            return self.report.err(
                at,
                "lab::step",
                "a steady error needs its band".to_owned(),
                "the band is not complete",
                Some(help),
            );
        };
        Ok(CheckKind::SteadyError {
            band: self.band(*full.get_ref(), *zero.get_ref(), at)?,
            response,
            target,
        })
    }

    /// A share of the step, above 0 and below 1.
    fn share(&self, typed: &Option<NumberAt>, what: &str, absent: f64) -> Result<f64, LabError> {
        let Some(number) = typed else {
            return Ok(absent);
        };
        let value = *number.get_ref();
        if value > 0.0 && value < 1.0 {
            return Ok(value);
        }
        self.report.err(
            number.span(),
            "lab::step",
            format!("{what} is a share of the step, above 0 and below 1, got {value}"),
            "this share",
            Some(format!("left out it is {absent}")),
        )
    }

    /// What a check at `at` looks at; `absent_s` is the length of its last part where the lab does not say.
    fn step_response(
        &self,
        keys: StepKeys<'_>,
        absent_s: f64,
        at: Range<usize>,
        work: &TaskWork,
    ) -> Result<StepResponse, LabError> {
        let joint = self.joint(keys.joint)?;
        let (of, target, foreign, wanted) = match keys.of {
            OfName::Position => (
                Fed::Position,
                keys.target_rad,
                keys.target_rad_s,
                "target_rad",
            ),
            OfName::Velocity => (
                Fed::Velocity,
                keys.target_rad_s,
                keys.target_rad,
                "target_rad_s",
            ),
        };
        if let Some(typed) = foreign {
            return self.report.err(
                typed.span(),
                "lab::step",
                "the target has the unit of another signal than `of` names".to_owned(),
                "of the wrong unit",
                Some(format!("write `{wanted}`, or change `of`")),
            );
        }
        let prediction = match keys.prediction {
            Some(table) => Some(self.prediction(table, of)?),
            None => None,
        };
        if prediction.is_some() && target.is_none() {
            return self.report.err(
                at,
                "lab::step",
                "a prediction needs to know the step".to_owned(),
                "the target is missing",
                Some(format!("add it, such as `{wanted} = 1.0`")),
            );
        }
        Ok(StepResponse {
            joint,
            units: JointUnits::of(self.robot, joint),
            of,
            target: target.as_ref().map(|number| *number.get_ref()),
            final_ticks: self.final_ticks(keys.last, absent_s, at, work)?,
            prediction,
        })
    }

    /// Ticks of the part at the end that counts.
    fn final_ticks(
        &self,
        (typed, what): (&Option<NumberAt>, &str),
        absent_s: f64,
        at: Range<usize>,
        work: &TaskWork,
    ) -> Result<usize, LabError> {
        // a function task is refused later, with the kind's name
        let TaskWork::Motion(motion) = work else {
            return Ok(1);
        };
        let length_s = match typed {
            Some(number) => self.positive(number, what)?,
            None => absent_s,
        };
        let ticks = (length_s / motion.periods.step_s).round().max(1.0);
        if ticks < motion.ticks as f64 {
            return Ok(ticks as usize);
        }
        self.report.err(
            typed.as_ref().map_or(at, Spanned::span),
            "lab::periods",
            format!(
                "{what} is {length_s} s, and the run has {} s in all",
                motion.periods.time_s(motion.ticks)
            ),
            "not shorter than the run",
            Some(format!("make {what} shorter, or the run longer")),
        )
    }
}
