//! ik-reach: how near the best branch of each answer comes to its target, by Kinemark's forward kinematics \[m\].
//!
//! Each reachable case is scored by the band; the check's score is their mean. Whole turns and the order of branches make no
//! difference. A branch beyond the limits of a joint does not reach its target; to a joint that can make a full turn, whole turns make
//! no difference; with `within_limits = false` in the task, limits are not looked at.
//!
//! Where the task is about more than positions, `full_rad` and `zero_rad` are a second band, of the angle between the orientation that a
//! branch reaches and the target's, as `fk-orientation` measures it. A branch earns the less of the two, and a case what its best branch
//! earns.

use crate::attempt::branches::beyond_limit;
use crate::check::prelude::*;

/// The keys.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct Table {
    /// Distance from its target with which a case earns everything \[m\].
    full_m: f64,
    /// Distance with which a case earns nothing \[m\].
    zero_m: f64,
    /// Angle from its target with which a case earns everything \[rad\].
    full_rad: Option<At<f64>>,
    /// Angle with which a case earns nothing \[rad\].
    zero_rad: Option<At<f64>>,
}

impl FunctionTable for Table {
    const NAME: &'static str = "ik-reach";
    const FUNCTION: Option<&'static str> = Some("inverse_kinematics");
    type Check = InBand<IkReach>;

    fn read(&self, reading: &FunctionReading<'_>) -> Result<Self::Check, LabError> {
        let turned = turned_band(reading, self.full_rad.as_ref(), self.zero_rad.as_ref())?;
        reading.in_band([self.full_m, self.zero_m], "m", IkReach { turned })
    }
}

problems! {
    /// What is wrong with a band of angles.
    enum AngleProblem {
        NoOrientation:
            "lab::pose", "this task is about positions alone", "an orientation that no target has",
            "write `pose = \"full\"`, or \"axis\" or \"yaw\", below [tasks.function]";
        Missing:
            "lab::pose", "this task is about poses, and nothing says how far a branch may be turned away", "no band of angles",
            "write `full_rad = 0.001, zero_rad = 0.01`, too";
        Order { full_rad: f64, zero_rad: f64 }:
            "lab::band", "`full_rad` is {full_rad} and `zero_rad` {zero_rad}: less is better, from zero on", "in this order",
            "write the lesser number as `full_rad`";
    }
}

/// The band of angles, where the task is about more than positions.
pub(super) fn turned_band(
    reading: &FunctionReading<'_>,
    full_rad: Option<&At<f64>>,
    zero_rad: Option<&At<f64>>,
) -> Result<Option<Band>, LabError> {
    let is_turned =
        matches!(&reading.of.function, Function::InverseKinematics(form) if form.is_turned());
    match (full_rad, zero_rad, is_turned) {
        (None, None, false) => Ok(None),
        (Some(at), _, false) | (None, Some(at), false) => {
            reading.refuse_at(at, AngleProblem::NoOrientation)
        }
        (Some(full), Some(zero), true) => {
            let (full_rad, zero_rad) = (*full.get_ref(), *zero.get_ref());
            if !(full_rad >= 0.0 && full_rad <= zero_rad && zero_rad.is_finite()) {
                return reading.refuse_at(full, AngleProblem::Order { full_rad, zero_rad });
            }
            Ok(Some(Band {
                full: full_rad,
                zero: zero_rad,
            }))
        }
        (_, _, true) => reading.refuse(AngleProblem::Missing),
    }
}

/// What the branch `index` of an answer earns.
pub(super) fn branch_score(
    (branches_m, angles_rad): (&[f64], &[f64]),
    index: usize,
    (band, turned): (Band, Option<Band>),
) -> f64 {
    let of_distance = band.score(branches_m[index]);
    match turned {
        Some(turned) => of_distance.min(turned.score(angles_rad[index])),
        None => of_distance,
    }
}

/// The distance of the best branch from its target.
#[derive(Debug)]
pub(crate) struct IkReach {
    /// The band of angles, where the task is about more than positions.
    turned: Option<Band>,
}

impl AnswerMeasure for IkReach {
    fn judge(&self, cases: &Cases<'_>) -> Finding {
        let score = |facts: &CaseFacts<'_>| {
            let CaseError::Reach {
                branches_m,
                angles_rad,
                ..
            } = &facts.error
            else {
                return None;
            };
            let Some(turned) = self.turned else {
                let nearest_m = branches_m.first().copied().unwrap_or(f64::INFINITY);
                let message = || message(facts, nearest_m);
                return Some(CaseScore::of(facts, nearest_m, cases.band, message));
            };
            let both = (branches_m.as_slice(), angles_rad.as_slice());
            let of = |index: usize| branch_score(both, index, (cases.band, Some(turned)));
            // of branches that earn as much, the nearest
            let best = (0..branches_m.len())
                .rev()
                .max_by(|a, b| of(*a).total_cmp(&of(*b)));
            let off_m = best.map_or(f64::INFINITY, |best| branches_m[best]);
            let score = best.map_or(0.0, of);
            let words = || match best.filter(|best| cases.band.score(branches_m[*best]) >= 1.0) {
                Some(best) => format!(
                    "{}: the arm ends turned {} away from the target",
                    facts.label(),
                    with_unit(angles_rad[best], "rad")
                ),
                None => message(facts, off_m),
            };
            let lost = (score < 1.0).then(|| WrongAnswer::whole(facts, off_m, words()));
            Some(CaseScore {
                score,
                lost: lost.into_iter().collect(),
            })
        };
        cases.mean_score("targets reached", score).advise(
            "Put your angles through your own forward kinematics: it must give the target back.",
        )
    }

    fn bounds(&self, full: String, zero: String) -> [String; 2] {
        of_every_target((full, zero), self.turned)
    }
}

/// What the brief says of a band in which every target is judged, and of that of angles, where there is one.
pub(super) fn of_every_target((full, zero): (String, String), turned: Option<Band>) -> [String; 2] {
    let of = |angle: fn(Band) -> f64, word: &str| {
        turned.map_or(String::new(), |band| format!(" {word} {} rad", angle(band)))
    };
    [
        format!("every target within {full}{}", of(|band| band.full, "and")),
        format!("every target {zero}{} off", of(|band| band.zero, "or")),
    ]
}

fn message(facts: &CaseFacts<'_>, nearest_m: f64) -> String {
    let name = facts.label();
    match &facts.answer {
        Answered::Branches(branches) if branches.is_empty() => {
            // the lab's own target may be the one that is wrong
            format!(
                "{name}: inverse_kinematics returned [], expected the angles of a target within reach"
            )
        }
        _ => without_answer(facts).unwrap_or_else(|| {
            let beyond = any_beyond_limit(facts).filter(|_| !nearest_m.is_finite());
            let missed = || format!("the arm ends {} from the target", metres(nearest_m));
            format!("{name}: {}", beyond.unwrap_or_else(missed))
        }),
    }
}

/// The first joint that some branch of an answer puts beyond its limits, in words.
pub(super) fn any_beyond_limit(facts: &CaseFacts<'_>) -> Option<String> {
    let Answered::Branches(branches) = &facts.answer else {
        return None;
    };
    let mut beyond = branches.iter();
    beyond.find_map(|q| beyond_limit(facts.robot, q))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_band_of_angles_is_in_the_table() {
        let ends = || ("0.01 mm".to_owned(), "5.0 mm".to_owned());
        let turned = Band {
            full: 1e-5,
            zero: 0.05,
        };
        let [full, zero] = of_every_target(ends(), Some(turned));
        assert_eq!(full, "every target within 0.01 mm and 0.00001 rad");
        assert_eq!(zero, "every target 5.0 mm or 0.05 rad off");
        let [full, zero] = of_every_target(ends(), None);
        assert_eq!(full, "every target within 0.01 mm");
        assert_eq!(zero, "every target 5.0 mm off");
    }
}
