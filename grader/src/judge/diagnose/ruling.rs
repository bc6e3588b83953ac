//! What a comparison with a mutant came to: it explains everything, or the rule that kept it from that, with its numbers.

use crate::record::grade::Diagnosis;

/// A comparison with one mutant.
#[derive(Debug, Clone, PartialEq)]
pub struct Ruling {
    /// The mutant's name.
    pub mistake: String,
    /// The mistake in words.
    pub says: String,
    /// How far the student agrees; or why the mutant is not compared, or cannot be meant.
    pub found: Result<Agreement, NotNamed>,
}

/// In how many places a mutant shows its mistake, and in how many of those the student agrees with it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Agreement {
    /// Answers, goals or control ticks in which the student agrees.
    pub agreeing: usize,
    /// Those in which the mistake would show.
    pub telling: usize,
}

/// Why a mutant is not named.
#[derive(Debug, Clone, PartialEq)]
pub enum NotNamed {
    /// Too few of its answers are so far off that they earn nothing.
    FewAnswers {
        /// Such answers.
        telling: usize,
        /// All answers.
        cases: usize,
        /// As many are needed.
        needed: usize,
        /// The answer that is most nearly so far off, among those that are not.
        nearest: Option<NearMiss>,
    },
    /// The student is wrong in an answer, or at a goal, in which the mutant is right.
    WrongElsewhere,
    /// No goal at which its mistake shows: one entry a goal.
    NoGoal(Vec<AtGoal>),
    /// A run that does not come to its end, or stays too short of time to rest once for each goal.
    NoRest,
    /// Its run hardly differs from that of the reference solution \[rad or m\].
    NearReference {
        /// The least root mean square of their distance, over all shifts.
        mean: f64,
        /// The least that counts.
        needed: f64,
    },
    /// The student is too far from it \[rad or m\]; `None` where the comparison was given up on the way.
    Far {
        /// The least root mean square of their distance, over all shifts, and the greatest that agrees.
        mean_and_most: Option<[f64; 2]>,
    },
    /// The two runs do not end in the same way.
    EndsOtherwise,
    /// It does not move, or commands nothing.
    Still,
    /// It does not start.
    NoRun,
}

/// An answer that is off, and not far enough.
#[derive(Debug, Clone, PartialEq)]
pub struct NearMiss {
    /// The case.
    pub case: String,
    /// How far it is off.
    pub error: f64,
    /// As much earns nothing.
    pub needed: f64,
    /// The unit of both; empty for a relative error.
    pub unit: &'static str,
}

/// What a mutant does at a goal where its mistake does not show.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum AtGoal {
    /// Its nearest stay is where it started, so that it says nothing.
    Start {
        /// The distance from the start \[m\].
        from_start_m: f64,
        /// Less than this counts as the start \[m\].
        still_m: f64,
    },
    /// It is there.
    There {
        /// Its distance from the goal \[m\].
        off_m: f64,
        /// As much earns all points \[m\].
        full_m: f64,
        /// Where the goal asks for an orientation, how far it is turned away, and how far counts \[rad\].
        turned_rad: Option<[f64; 2]>,
    },
}

impl Ruling {
    /// The diagnosis, if the mistake shows and the student agrees wherever it does.
    fn diagnosis(&self) -> Option<Diagnosis> {
        let Ok(Agreement { agreeing, telling }) = self.found else {
            return None;
        };
        (telling > 0 && agreeing == telling).then(|| self.named(agreeing, telling))
    }

    fn named(&self, agreeing: usize, telling: usize) -> Diagnosis {
        Diagnosis {
            mistake: self.mistake.clone(),
            says: self.says.clone(),
            agreeing: agreeing as u32,
            telling: telling as u32,
        }
    }
}

/// The mistake that explains everything, if exactly one does; of several, the one that shows in more places.
pub(super) fn clear(rulings: &[Ruling]) -> Vec<Diagnosis> {
    let mut candidates: Vec<Diagnosis> = rulings.iter().filter_map(Ruling::diagnosis).collect();
    candidates.sort_by_key(|candidate| std::cmp::Reverse(candidate.telling));
    match &mut candidates[..] {
        [first, second, ..] if first.telling == second.telling => Vec::new(),
        [] => Vec::new(),
        [..] => {
            candidates.truncate(1);
            candidates
        }
    }
}

/// The mistake that agrees with a whole run, if exactly one does.
pub(super) fn only(rulings: &[Ruling]) -> Vec<Diagnosis> {
    let mut agreeing = rulings.iter().filter_map(|ruling| {
        let Agreement { agreeing, telling } = *ruling.found.as_ref().ok()?;
        Some(ruling.named(agreeing, telling))
    });
    match (agreeing.next(), agreeing.next()) {
        (Some(only), None) => vec![only],
        _ => Vec::new(),
    }
}
