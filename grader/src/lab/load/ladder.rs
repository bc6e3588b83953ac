//! A robustness check: it repeats an earlier check, and every rung changes something, by a sensible amount.

use kinemark_sim::source::suggest;
use kinemark_sim::ticks::whole_ratio;
use toml::Spanned;

use super::Reader;
use crate::lab::file::NumberAt;
use crate::lab::ladder::{Ladder, Rung};
use crate::lab::ladder_tables::{RobustnessTable, RungTable};
use crate::lab::model::{Check, CheckKind, MotionTask, TaskWork};
use crate::lab::problem::LabError;

/// Rungs of one ladder: each is a run of its own.
const MOST_RUNGS: usize = 10;
/// Control periods by which a command may be late.
const MOST_DELAY_PERIODS: u64 = 1000;

impl Reader<'_> {
    pub(super) fn robustness(
        &self,
        table: &Spanned<RobustnessTable>,
        earlier: &[Check],
        work: &TaskWork,
    ) -> Result<CheckKind, LabError> {
        let at = table.span();
        let table = table.get_ref();
        let TaskWork::Motion(motion) = work else {
            return self.report.err(
                at,
                "lab::check_kind",
                "a check of kind `robustness` needs a motion task".to_owned(),
                "there is no run to disturb in this task",
                None,
            );
        };
        // one that climbs a ladder itself has no run of its own
        let repeatable = |check: &&Check| !matches!(check.kind, CheckKind::Robustness(_));
        let wanted = table.check.get_ref();
        let found = earlier
            .iter()
            .filter(repeatable)
            .find(|c| c.name == *wanted);
        let Some(found) = found else {
            let known = earlier.iter().filter(repeatable);
            return self.report.err(
                table.check.span(),
                "lab::unknown_check",
                format!("no earlier check of this task that can be repeated is called `{wanted}`"),
                "must stand before this check",
                Some(suggest(
                    wanted,
                    "earlier checks",
                    known.map(|check| check.name.as_str()),
                )),
            );
        };
        let check = earlier.iter().position(|check| check.name == found.name);
        if !(1..=MOST_RUNGS).contains(&table.rungs.len()) {
            return self.report.err(
                at,
                "lab::robustness",
                format!(
                    "a ladder has 1 to {MOST_RUNGS} rungs, got {}",
                    table.rungs.len()
                ),
                "this check",
                Some("such as `rungs = [{ name = \"late\", delay_ms = 10 }]`".to_owned()),
            );
        }
        self.unique("rung", table.rungs.iter().map(|rung| &rung.get_ref().name))?;
        let rungs = table.rungs.iter();
        let rungs = rungs.map(|rung| self.rung(rung, motion));
        Ok(CheckKind::Robustness(Ladder {
            check: check.unwrap_or_default(),
            rungs: rungs.collect::<Result<_, _>>()?,
        }))
    }

    fn rung(&self, spanned: &Spanned<RungTable>, motion: &MotionTask) -> Result<Rung, LabError> {
        let table = spanned.get_ref();
        let typed = |number: &Option<NumberAt>, what: &str, absent: f64| match number {
            None => Ok(absent),
            Some(number) => self.positive(number, what),
        };
        let (delay_periods, delay_s) = match &table.delay_ms {
            None => (0, 0.0),
            Some(delay_ms) => {
                let delay_s = self.positive(delay_ms, "`delay_ms`")? / 1000.0;
                let period_s = motion.periods.control_s();
                match whole_ratio(delay_s, period_s) {
                    Some(periods) if periods <= MOST_DELAY_PERIODS => (periods as u32, delay_s),
                    _ => {
                        let nearest = (delay_s / period_s).round().max(1.0);
                        let nearest_ms = nearest.min(MOST_DELAY_PERIODS as f64) * period_s * 1e3;
                        return self.report.err(
                            delay_ms.span(),
                            "lab::periods",
                            format!(
                                "a delay of {} ms is not 1 to {MOST_DELAY_PERIODS} whole control periods of {} ms",
                                delay_ms.get_ref(),
                                crate::record::quantity::trimmed(period_s * 1e3, 6)
                            ),
                            "does not divide",
                            Some(format!(
                                "the nearest delay that fits is {} ms",
                                crate::record::quantity::trimmed(nearest_ms, 6)
                            )),
                        );
                    }
                }
            }
        };
        let (q_noise, qd_noise) = match &table.noise {
            None => (0.0, 0.0),
            Some(noise) => {
                let of = noise.get_ref();
                let fits = |x: f64| (0.0..=1e3).contains(&x);
                if !(fits(of.q_rad) && fits(of.qd_rad_s) && of.q_rad + of.qd_rad_s > 0.0) {
                    return self.report.err(
                        noise.span(),
                        "lab::out_of_range",
                        format!(
                            "noise is up to 1000 and not all zero, got q_rad = {} and qd_rad_s = {}",
                            of.q_rad, of.qd_rad_s
                        ),
                        "this noise",
                        Some("such as `noise = { q_rad = 1e-4, qd_rad_s = 1e-2 }`".to_owned()),
                    );
                }
                (of.q_rad, of.qd_rad_s)
            }
        };
        let mut heaviest: Option<(&NumberAt, &str)> = None;
        for (number, what) in [
            (&table.payload_kg, "`payload_kg`"),
            (&table.friction_n_m, "`friction_n_m`"),
            (&table.damping, "`damping`"),
            (&table.share, "`share`"),
        ] {
            // beyond this, only numbers blow up
            if let Some(number) = number.as_ref().filter(|number| *number.get_ref() > 1e6) {
                heaviest = Some((number, what));
            }
        }
        if let Some((number, what)) = heaviest {
            return self.report.err(
                number.span(),
                "lab::out_of_range",
                format!("{what} is at most 1e6, got {:e}", number.get_ref()),
                "out of range",
                None,
            );
        }
        let rung = Rung {
            name: table.name.get_ref().clone(),
            share: typed(&table.share, "`share`", 1.0)?,
            q_noise,
            qd_noise,
            delay_periods,
            delay_s,
            payload_kg: typed(&table.payload_kg, "`payload_kg`", 0.0)?,
            friction: typed(&table.friction_n_m, "`friction_n_m`", 0.0)?,
            damping: match &table.damping {
                None => None,
                Some(number) => Some(self.positive(number, "`damping`")?),
            },
        };
        let damped = self.robot.joints().iter().any(|joint| joint.damping > 0.0);
        if let Some(damping) = table.damping.as_ref().filter(|_| !damped) {
            return self.report.err(
                damping.span(),
                "lab::robustness",
                format!(
                    "robot `{}` has no damping that could be multiplied",
                    self.robot.name()
                ),
                "changes nothing",
                Some("add dry friction instead, such as `friction_n_m = 0.3`".to_owned()),
            );
        }
        if rung.told().is_empty() {
            return self.report.err(
                spanned.span(),
                "lab::robustness",
                format!("rung `{}` changes nothing", rung.name),
                "this rung",
                Some(
                    "give it `noise`, `delay_ms`, `payload_kg`, `friction_n_m` or `damping`"
                        .to_owned(),
                ),
            );
        }
        Ok(rung)
    }
}
