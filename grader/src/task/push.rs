//! Pushes of a motion task, or of a level of a robustness sweep: on what, when, how hard, and where.

use kinemark_sim::model::push::{Push, Pushed};
use kinemark_sim::model::robot::Robot;
use kinemark_sim::model::scene::BodyKind;
use kinemark_sim::text::number::{seconds, trimmed};
use kinemark_sim::text::{Spanned, suggest};
use kinemark_sim::ticks::Periods;
use nalgebra::Vector3;
use schemars::JsonSchema;
use serde::Deserialize;

use super::problem::{LabError, problems};
use super::reporter::Reporter;
use super::scene::LabScene;

/// Pushes of one task.
const MOST_PUSHES: usize = 100;

/// A push on a link or a body.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct PushTable {
    /// A link behind a joint that moves, or a dynamic body of the scene.
    on: Spanned<String>,
    /// When it begins, a whole multiple of the physics step \[s\].
    at_s: Spanned<f64>,
    /// How long it lasts, a whole multiple of the physics step \[s\].
    for_s: Spanned<f64>,
    /// Force, `[x, y, z]` in the world \[N\].
    force_n: Option<Spanned<[f64; 3]>>,
    /// Moment besides that of the force, `[x, y, z]` in the world \[N m\]; links only.
    moment_n_m: Option<Spanned<[f64; 3]>>,
    /// Where the force acts, in the link's frame \[m\]; the centre of mass where it is left out.
    point_m: Option<Spanned<[f64; 3]>>,
}

impl PushTable {
    /// The push in words, as typed: `a push of 5 N on `can` at 1 s`.
    pub(crate) fn in_words(&self) -> String {
        let size = |typed: &Option<Spanned<[f64; 3]>>| match typed {
            Some(typed) => Vector3::from(*typed.get_ref()).norm(),
            None => 0.0,
        };
        let sizes = [(size(&self.force_n), "N"), (size(&self.moment_n_m), "N m")];
        let sizes = sizes.iter().filter(|(size, _)| *size > 0.0);
        let sizes: Vec<String> = sizes
            .map(|(size, unit)| format!("{} {unit}", trimmed(*size, 3)))
            .collect();
        let at = seconds(*self.at_s.get_ref());
        let on = self.on.get_ref();
        format!("a push of {} on `{on}` at {at}", sizes.join(" and "))
    }
}

problems! {
    /// What is wrong with a push.
    enum PushProblem {
        TooMany { count: usize }:
            "lab::push", "a task has at most {MOST_PUSHES} pushes, got {count}", "too many pushes";
        Unknown { on: String, help: String }:
            "lab::push", "`{on}` is no link of the robot and no body of the scene", "nothing of this name", help;
        Fixed { on: String }:
            "lab::push", "`{on}` does not move, whatever pushes it", "fixed",
            "name a link behind a joint that moves, or a body of type `free`";
        OnBody { on: String }:
            "lab::push", "a body is pushed at its centre of mass, without a moment", "this push",
            format!("leave `point_m` and `moment_n_m` out: they are for links, and `{on}` is a body");
        NoForce:
            "lab::push", "a push needs a force or a moment", "no push",
            "add `force_n = [x, y, z]` in the axes of the world";
        Late { at_s: f64, run_s: f64 }:
            "lab::push", "a push at {at_s} s is after the end of a run of {run_s} s", "never happens";
        Negative { at_s: f64 }:
            "lab::push", "a push is at a time from 0 s on, got {at_s} s", "before the run";
    }
}

/// What pushes are read with.
pub(crate) struct PushReading<'a> {
    /// Where problems are reported.
    pub(crate) report: Reporter<'a>,
    /// The robot, whose links may be pushed.
    pub(crate) robot: &'a Robot,
    /// The scene, whose bodies may be pushed.
    pub(crate) scene: Option<&'a LabScene>,
    /// Step, servo period, control period.
    pub(crate) periods: &'a Periods,
    /// How long the run is, in ticks.
    pub(crate) ticks: u64,
}

impl PushReading<'_> {
    /// The pushes of these tables.
    pub(crate) fn all(&self, tables: &[Spanned<PushTable>]) -> Result<Vec<Push>, LabError> {
        if let Some(table) = tables.get(MOST_PUSHES) {
            let count = tables.len();
            return self.report.refuse_at(table, PushProblem::TooMany { count });
        }
        tables.iter().map(|table| self.push(table)).collect()
    }

    fn push(&self, typed: &Spanned<PushTable>) -> Result<Push, LabError> {
        let table = typed.get_ref();
        let (periods, ticks) = (self.periods, self.ticks);
        let on = self.pushed(table)?;
        let vector = |typed: &Option<Spanned<[f64; 3]>>, what| match typed {
            Some(typed) => self.report.vector(typed, what),
            None => Ok(Vector3::zeros()),
        };
        let force_n = vector(&table.force_n, "the force of a push")?;
        let moment_n_m = vector(&table.moment_n_m, "the moment of a push")?;
        if force_n == Vector3::zeros() && moment_n_m == Vector3::zeros() {
            return self.report.refuse_at(typed, PushProblem::NoForce);
        }
        let p_m = match (&table.point_m, on) {
            (Some(point), _) => self.report.vector(point, "the point of a push")?,
            (None, Pushed::Link(link)) => self.robot.links()[link].inertia.com_m,
            (None, Pushed::Body(_)) => Vector3::zeros(),
        };
        let from_tick = match *table.at_s.get_ref() {
            at_s if at_s < 0.0 => {
                let problem = PushProblem::Negative { at_s };
                return self.report.refuse_at(&table.at_s, problem);
            }
            at_s if at_s > 0.0 => {
                self.report
                    .whole_ticks(periods, at_s, &table.at_s, "the time of a push")?
            }
            _ => 0,
        };
        if from_tick >= ticks {
            let (at_s, run_s) = (*table.at_s.get_ref(), periods.time_s(ticks));
            let problem = PushProblem::Late { at_s, run_s };
            return self.report.refuse_at(&table.at_s, problem);
        }
        let for_s = self.report.positive(&table.for_s, "the length of a push")?;
        let lasts =
            self.report
                .whole_ticks(periods, for_s, &table.for_s, "the length of a push")?;
        Ok(Push {
            on,
            p_m,
            force_n,
            moment_n_m,
            from_tick,
            end_tick: from_tick + lasts,
        })
    }

    /// What a push is on, which must be able to move.
    fn pushed(&self, table: &PushTable) -> Result<Pushed, LabError> {
        let name = table.on.get_ref();
        let on = name.clone();
        let links = self.robot.links();
        if let Some(link) = links.iter().position(|link| link.name == *name) {
            if links[link].attachment.body.is_none() {
                return self.report.refuse_at(&table.on, PushProblem::Fixed { on });
            }
            return Ok(Pushed::Link(link));
        }
        let bodies = self.scene.map_or(&[][..], |scene| &scene.scene.bodies);
        let Some(body) = bodies.iter().position(|body| body.name == *name) else {
            let names = links.iter().map(|link| link.name.as_str());
            let names = names.chain(bodies.iter().map(|body| body.name.as_str()));
            let help = suggest(name, "links and bodies", names);
            let problem = PushProblem::Unknown { on, help };
            return self.report.refuse_at(&table.on, problem);
        };
        if !matches!(bodies[body].kind, BodyKind::Free) {
            return self.report.refuse_at(&table.on, PushProblem::Fixed { on });
        }
        if table.point_m.is_some() || table.moment_n_m.is_some() {
            return self.report.refuse_at(&table.on, PushProblem::OnBody { on });
        }
        Ok(Pushed::Body(body))
    }
}
