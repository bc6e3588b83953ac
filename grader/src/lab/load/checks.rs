//! Checks: exactly one kind each, a band in order, earlier checks needed by name, and a task that has what they look at.

use std::ops::Range;

use kinemark_sim::source::suggest;
use kinemark_sim::ticks::whole_ratio;
use toml::Spanned;

use super::Reader;
use crate::lab::file::{BandM, BandS, CheckTable, FunctionCasesTable, SpanName};
use crate::lab::model::{Band, Check, CheckKind, Function, Given, MatchSpan, TaskWork};
use crate::lab::problem::LabError;

impl Reader<'_> {
    pub(super) fn band(&self, full: f64, zero: f64, at: Range<usize>) -> Result<Band, LabError> {
        if full.is_finite() && zero.is_finite() && full <= zero {
            return Ok(Band { full, zero });
        }
        self.report.err(
            at,
            "lab::band",
            format!("a band needs `full` at or below `zero`, got {full} and {zero}"),
            "this band",
            Some(
                "`full` is the value that earns all points, `zero` the one that earns none"
                    .to_owned(),
            ),
        )
    }

    pub(super) fn check(
        &self,
        spanned: &Spanned<CheckTable>,
        earlier: &[Check],
        work: &TaskWork,
        task: &str,
    ) -> Result<Check, LabError> {
        let table = spanned.get_ref();
        let name = table.name.get_ref();
        let points = *table.points.get_ref();
        if !(points > 0.0 && points <= 1000.0) {
            return self.report.err(
                table.points.span(),
                "lab::points",
                format!(
                    "check `{name}` must be worth more than 0 and at most 1000 points, got {points}"
                ),
                "out of range",
                Some(
                    "points are earned, never taken away: write what full marks are worth"
                        .to_owned(),
                ),
            );
        }
        let mut needs = Vec::new();
        for needed in &table.needs {
            match earlier
                .iter()
                .position(|check| check.name == *needed.get_ref())
            {
                Some(index) => needs.push(index),
                None => {
                    let known = earlier.iter().map(|check| check.name.as_str());
                    return self.report.err(
                        needed.span(),
                        "lab::unknown_check",
                        format!(
                            "no earlier check of this task is called `{}`",
                            needed.get_ref()
                        ),
                        "must stand before this check",
                        Some(suggest(needed.get_ref(), "earlier checks", known)),
                    );
                }
            }
        }
        let mut kinds = self.kinds(table, work, task)?;
        if let Some(table) = &table.robustness {
            kinds.push(self.robustness(table, earlier, work)?);
        }
        let (Some(kind), true) = (kinds.pop(), kinds.is_empty()) else {
            return self.report.err(
                table.name.span(),
                "lab::check_kind",
                format!("check `{name}` must have exactly one kind"),
                "this check",
                Some("add one table, such as [tasks.checks.pose-reached]".to_owned()),
            );
        };
        self.fits(&kind, work, &table.name)?;
        // what earned nothing undisturbed is not tried again
        if let CheckKind::Robustness(ladder) = &kind
            && !needs.contains(&ladder.check)
        {
            needs.push(ladder.check);
        }
        Ok(Check {
            name: name.clone(),
            title: table.title.clone(),
            points,
            needs,
            hint: table.hint.clone(),
            kind,
        })
    }

    fn kinds(
        &self,
        table: &CheckTable,
        work: &TaskWork,
        task: &str,
    ) -> Result<Vec<CheckKind>, LabError> {
        let step_s = match work {
            TaskWork::Motion(motion) => motion.periods.step_s,
            TaskWork::Function(_) => 1.0,
        };
        let metres = |band: &Spanned<BandM>| {
            let BandM { full_m, zero_m } = *band.get_ref();
            self.band(full_m, zero_m, band.span())
        };
        let seconds = |band: &Spanned<BandS>| {
            let BandS { full_s, zero_s } = *band.get_ref();
            self.band(full_s, zero_s, band.span())
        };
        let mut kinds = Vec::new();
        if let Some(reached) = &table.joint_reached {
            let wanted = reached.joint.get_ref();
            let names: Vec<&str> = self
                .robot
                .moving_joints()
                .map(|joint| joint.name.as_str())
                .collect();
            let Some(joint) = names.iter().position(|name| name == wanted) else {
                return self.report.err(
                    reached.joint.span(),
                    "lab::unknown_joint",
                    format!(
                        "robot `{}` has no joint `{wanted}` that moves",
                        self.robot.name()
                    ),
                    "not a joint of this robot",
                    Some(suggest(wanted, "joints", names.into_iter())),
                );
            };
            let hold_s = self.positive(&reached.hold_s, "`hold_s`")?;
            let Some(hold_ticks) = whole_ratio(hold_s, step_s) else {
                return self.report.err(
                    reached.hold_s.span(),
                    "lab::periods",
                    format!("{hold_s} s is not a whole number of physics steps of {step_s} s"),
                    "does not divide",
                    None,
                );
            };
            if matches!(work, TaskWork::Motion(motion) if hold_ticks > motion.ticks) {
                return self.report.err(
                    reached.hold_s.span(),
                    "lab::periods",
                    format!("{hold_s} s is longer than the run"),
                    "longer than the run",
                    None,
                );
            }
            kinds.push(CheckKind::JointReached {
                joint,
                position: reached.position_rad,
                hold_ticks,
                band: self.band(
                    *reached.full_rad.get_ref(),
                    reached.zero_rad,
                    reached.full_rad.span(),
                )?,
            });
        }
        if let Some(band) = &table.fk_error {
            kinds.push(CheckKind::FkError(metres(band)?));
        }
        if let Some(band) = &table.ik_reach {
            kinds.push(CheckKind::IkReach(metres(band)?));
        }
        if let Some(band) = &table.ik_branches {
            kinds.push(CheckKind::IkBranches(metres(band)?));
        }
        if table.ik_unreachable.is_some() {
            kinds.push(CheckKind::IkUnreachable);
        }
        if let Some(band) = &table.jacobian_match {
            let ratio = band.get_ref();
            kinds.push(CheckKind::JacobianMatch(self.band(
                ratio.full,
                ratio.zero,
                band.span(),
            )?));
        }
        if let Some(band) = &table.pose_reached {
            kinds.push(CheckKind::PoseReached(metres(band)?));
        }
        if let Some(band) = &table.finish_time {
            kinds.push(CheckKind::FinishTime(seconds(band)?));
        }
        if let Some(band) = &table.overshoot {
            let ratio = band.get_ref();
            kinds.push(CheckKind::Overshoot(self.band(
                ratio.full,
                ratio.zero,
                band.span(),
            )?));
        }
        if let Some(band) = &table.effort_saturation {
            kinds.push(CheckKind::EffortSaturation(seconds(band)?));
        }
        if let Some(band) = &table.joint_limits {
            let b = band.get_ref();
            kinds.push(CheckKind::JointLimits(self.band(
                b.full_rad,
                b.zero_rad,
                band.span(),
            )?));
        }
        if let Some(table) = &table.trajectory_match {
            let t = table.get_ref();
            let refuse = |message: String, help: &str| {
                self.report.err(
                    table.span(),
                    "lab::trajectory_match",
                    message,
                    "this check",
                    Some(help.to_owned()),
                )
            };
            if !self.reference_paths.iter().any(|(name, _)| *name == task) {
                return refuse(
                    format!("`reference-path.json` has no path for task `{task}`"),
                    "put the reference solution's TCP path there: see docs/lab-format.md",
                );
            }
            let max_shift_s = match (t.over, t.max_shift_s) {
                (SpanName::Dwells, Some(_)) => {
                    return refuse(
                        "`max_shift_s` has no meaning over `dwells`, which are found wherever they are".to_owned(),
                        "remove it",
                    );
                }
                (_, None) => 0.0,
                (SpanName::Run, Some(shift_s)) if (0.0..=60.0).contains(&shift_s) => shift_s,
                (SpanName::Run, Some(shift_s)) => {
                    return refuse(
                        format!("`max_shift_s` must be 0 to 60 s, got {shift_s}"),
                        "change it",
                    );
                }
            };
            kinds.push(CheckKind::TrajectoryMatch {
                span: match t.over {
                    SpanName::Dwells => MatchSpan::Dwells,
                    SpanName::Run => MatchSpan::Run,
                },
                max_shift_ticks: (max_shift_s / step_s).round() as u64,
                band: self.band(t.full_m, t.zero_m, table.span())?,
            });
        }
        if let Some(table) = &table.body_falls {
            kinds.push(self.body_falls(table, work)?);
        }
        if let Some(table) = &table.contact_impulse {
            kinds.push(self.contact_impulse(table, work)?);
        }
        if let Some(table) = &table.tcp_speed {
            kinds.push(self.tcp_speed(table, work)?);
        }
        if let Some(table) = &table.path_deviation {
            kinds.push(self.path_deviation(table, work)?);
        }
        if let Some(table) = &table.path_coverage {
            kinds.push(self.path_coverage(table, work)?);
        }
        if let Some(table) = &table.path_speed {
            kinds.push(self.path_speed(table, work)?);
        }
        if let Some(table) = &table.time_limit {
            kinds.push(self.time_limit(table, work)?);
        }
        kinds.extend(self.step_kinds(table, work)?);
        if let Some(table) = &table.function_cases {
            kinds.push(self.function_cases(table, work)?);
        }
        Ok(kinds)
    }

    fn function_cases(
        &self,
        table: &Spanned<FunctionCasesTable>,
        work: &TaskWork,
    ) -> Result<CheckKind, LabError> {
        let typed = table.get_ref();
        if let (Some(entry), TaskWork::Function(task)) = (&typed.entry, work)
            && let Some(Given::Values { expected, .. }) = task.cases.first().map(|case| &case.given)
        {
            let names = || expected.iter().map(|(name, _)| name.as_str());
            if names().all(|name| name.is_empty() || name != entry.get_ref()) {
                return self.report.err(
                    entry.span(),
                    "lab::unknown_entry",
                    format!("no case expects an entry `{}`", entry.get_ref()),
                    "not an entry of `expected`",
                    Some(suggest(
                        entry.get_ref(),
                        "entries",
                        names().filter(|name| !name.is_empty()),
                    )),
                );
            }
        }
        Ok(CheckKind::FunctionCases {
            band: self.band(typed.full, typed.zero, table.span())?,
            entry: typed.entry.as_ref().map(|entry| entry.get_ref().clone()),
        })
    }

    /// A check must look at something its task has.
    fn fits(
        &self,
        kind: &CheckKind,
        work: &TaskWork,
        at: &Spanned<String>,
    ) -> Result<(), LabError> {
        let wanted = match (kind, work) {
            (CheckKind::FkError(_), TaskWork::Function(task))
                if task.function == Function::ForwardKinematics =>
            {
                return Ok(());
            }
            (
                CheckKind::IkReach(_) | CheckKind::IkBranches(_) | CheckKind::IkUnreachable,
                TaskWork::Function(task),
            ) if task.function == Function::InverseKinematics => return Ok(()),
            (CheckKind::JacobianMatch(_), TaskWork::Function(task))
                if matches!(task.function, Function::Jacobian(_)) =>
            {
                return Ok(());
            }
            (
                CheckKind::PoseReached(_)
                | CheckKind::FinishTime(_)
                | CheckKind::Overshoot(_)
                | CheckKind::TrajectoryMatch { .. },
                TaskWork::Motion(task),
            ) => {
                if !task.goals.is_empty() {
                    return Ok(());
                }
                "`goals` in [tasks.motion]"
            }
            (
                CheckKind::JointReached { .. }
                | CheckKind::EffortSaturation(_)
                | CheckKind::JointLimits(_)
                | CheckKind::BodyFalls(_)
                | CheckKind::ContactImpulse { .. }
                | CheckKind::TcpSpeed { .. }
                | CheckKind::PathDeviation { .. }
                | CheckKind::PathCoverage { .. }
                | CheckKind::PathSpeed { .. }
                | CheckKind::TimeLimit { .. }
                | CheckKind::Robustness(_)
                | CheckKind::RiseTime { .. }
                | CheckKind::SettlingTime { .. }
                | CheckKind::StepOvershoot { .. }
                | CheckKind::SteadyError { .. }
                | CheckKind::EffortPeak { .. }
                | CheckKind::EffortRms { .. }
                | CheckKind::Energy(_)
                | CheckKind::Jerk(_)
                | CheckKind::JointSpeed(_)
                | CheckKind::Chatter { .. },
                TaskWork::Motion(_),
            ) => return Ok(()),
            (CheckKind::FunctionCases { .. }, TaskWork::Function(task))
                if matches!(task.function, Function::Free(_)) =>
            {
                return Ok(());
            }
            (CheckKind::FunctionCases { .. }, _) => {
                "a function task of the lab's own, with `given` and `expected`"
            }
            (CheckKind::FkError(_), _) => "a function task of `forward_kinematics`",
            (CheckKind::IkReach(_) | CheckKind::IkBranches(_) | CheckKind::IkUnreachable, _) => {
                "a function task of `inverse_kinematics`"
            }
            (CheckKind::JacobianMatch(_), _) => "a function task of `jacobian`",
            (_, TaskWork::Function(_)) => "a motion task",
        };
        self.report.err(
            at.span(),
            "lab::check_kind",
            format!(
                "check `{}` of kind `{}` needs {wanted}",
                at.get_ref(),
                kind.name()
            ),
            "this check",
            None,
        )
    }
}
