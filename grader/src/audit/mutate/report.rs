//! All changes together: which checks caught how many, which changes survived, and which survivors the course staff accept.

use std::collections::BTreeMap;

use serde::Serialize;

use super::mutation::Mutation;
use super::trial::{Bench, Catch, Fate};
use crate::audit::rubric::{Accepted, CHOICE};
use crate::lab::Lab;

/// The share of the mistakes that a rubric must catch.
pub const LEAST_CAUGHT: f64 = 0.95;

/// What came of the changes of a solution.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct MutationReport {
    /// The lab.
    pub lab: String,
    /// The file of the solution.
    pub solution: String,
    /// How many changes the solution has.
    pub total: usize,
    /// How many were tried: all, or those that were drawn.
    pub tried: usize,
    /// How many of these do not compile.
    pub unparsed: usize,
    /// How many do in all answers and runs what the solution does.
    pub equivalent: usize,
    /// How many lost points.
    pub caught: usize,
    /// How many do something else and have full marks.
    pub survived: usize,
    /// How many of the survivors are as right as the solution, in the words of `accepted.toml`.
    pub choices: usize,
    /// The share that was caught, of those that are caught or survive as mistakes; `null` if there are none.
    pub share: Option<f64>,
    /// The same share with the survivors that are as right as the solution.
    pub share_of_all: Option<f64>,
    /// Every check of the lab, then what stopped programs.
    pub checks: Vec<CheckCatches>,
    /// Every change that was tried.
    pub mutations: Vec<TriedMutation>,
    /// What is wrong.
    pub problems: Vec<MutationProblem>,
}

/// How many changes a check caught.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct CheckCatches {
    /// The check, or how programs were stopped.
    #[serde(flatten)]
    pub catch: Catch,
    /// How many it caught.
    pub caught: usize,
    /// How many of these nothing else caught.
    pub only: usize,
}

/// A change, and what came of it.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct TriedMutation {
    /// The change.
    #[serde(flatten)]
    pub mutation: Mutation,
    /// What came of it.
    #[serde(flatten)]
    pub fate: Fate,
    /// Why it may survive.
    pub accepted: Option<Acceptance>,
}

/// Why a change may survive, in the words of `accepted.toml`.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Acceptance {
    /// Whether the changed solution is as right as the solution: no mistake, another choice.
    pub is_choice: bool,
    /// The reason.
    pub because: String,
}

impl TriedMutation {
    /// Whether it survived and is no mistake.
    pub fn is_choice(&self) -> bool {
        let accepted = self.accepted.as_ref();
        accepted.is_some_and(|accepted| accepted.is_choice)
    }

    /// Whether it survived, and nobody says why it may.
    pub fn is_unexplained(&self) -> bool {
        self.fate == Fate::Survived && self.accepted.is_none()
    }
}

/// Something wrong.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct MutationProblem {
    /// The number of the change, if it is about one.
    pub mutation: Option<usize>,
    /// In words.
    pub what: String,
    /// What to do.
    pub help: String,
}

impl MutationReport {
    /// The report on `fates`, each with the position of its change among those of the bench.
    pub fn new(bench: &Bench<'_>, fates: Vec<(usize, Fate)>, accepted: &Accepted) -> Self {
        let all = bench.mutations();
        let mutations: Vec<TriedMutation> = fates
            .into_iter()
            .filter_map(|(index, fate)| {
                let mutation = all.get(index)?.clone();
                let accepted = match fate {
                    Fate::Survived => accepted.mutation(&mutation.of()).map(|entry| Acceptance {
                        is_choice: entry.rule == CHOICE,
                        because: entry.because.clone(),
                    }),
                    _ => None,
                };
                Some(TriedMutation {
                    mutation,
                    fate,
                    accepted,
                })
            })
            .collect();
        let count =
            |is: fn(&Fate) -> bool| mutations.iter().filter(|tried| is(&tried.fate)).count();
        let caught = count(|fate| matches!(fate, Fate::Caught { .. }));
        let survived = count(|fate| matches!(fate, Fate::Survived));
        let choices = mutations.iter().filter(|tried| tried.is_choice()).count();
        let share = |of: usize| (of > 0).then(|| caught as f64 / of as f64);
        let mut report = Self {
            lab: bench.lab().name.clone(),
            solution: bench.solution().name().to_owned(),
            total: all.len(),
            tried: mutations.len(),
            unparsed: count(|fate| matches!(fate, Fate::Unparsed)),
            equivalent: count(|fate| matches!(fate, Fate::Equivalent)),
            caught,
            survived,
            choices,
            share: share(caught + survived - choices),
            share_of_all: share(caught + survived),
            checks: catches(bench.lab(), &mutations),
            mutations,
            problems: Vec::new(),
        };
        report.problems = report.all_problems(bench, accepted);
        report
    }

    fn all_problems(&self, bench: &Bench<'_>, accepted: &Accepted) -> Vec<MutationProblem> {
        let unexplained = self.mutations.iter().filter(|tried| tried.is_unexplained());
        let mut problems: Vec<MutationProblem> = unexplained
            .map(|tried| MutationProblem {
                mutation: Some(tried.mutation.number),
                what: format!("mutation {} keeps all points", tried.mutation.number),
                help: "narrow a band, add a case or a hidden one in which it shows, or accept it with a reason in accepted.toml"
                    .to_owned(),
            })
            .collect();
        for of in accepted.mutations() {
            problems.extend(self.stale(bench, of));
        }
        // of a few the share is luck
        if let (true, Some(share)) = (self.tried == self.total, self.share)
            && share < LEAST_CAUGHT
        {
            problems.push(MutationProblem {
                mutation: None,
                what: format!(
                    "{:.1} % of the mistakes are caught, and at least {:.0} % must be",
                    100.0 * share,
                    100.0 * LEAST_CAUGHT
                ),
                help: "let the checks notice more of the survivors: accepted ones count, too"
                    .to_owned(),
            });
        }
        problems
    }

    /// What is wrong with accepting the change called `of`; nothing where it survived or was not tried.
    fn stale(&self, bench: &Bench<'_>, of: &str) -> Option<MutationProblem> {
        let all = bench.mutations().iter();
        let alike = all.filter(|mutation| covers(of, &mutation.of())).count();
        if alike == 0 {
            return Some(no_mutation(of));
        }
        let tried: Vec<&TriedMutation> = self
            .mutations
            .iter()
            .filter(|tried| covers(of, &tried.mutation.of()))
            .collect();
        // a line may be there twice: one of them that was not drawn may survive
        let survives = tried.iter().any(|tried| tried.fate == Fate::Survived);
        if survives || tried.len() < alike {
            return None;
        }
        let tried = tried.first()?;
        let why = match &tried.fate {
            Fate::Caught { by } => {
                let by: Vec<String> = by.iter().map(Catch::words).collect();
                format!("it is caught by {}", by.join(", "))
            }
            Fate::Equivalent => "it does what the solution does".to_owned(),
            Fate::Unparsed | Fate::Survived => "it does not compile".to_owned(),
        };
        Some(MutationProblem {
            mutation: Some(tried.mutation.number),
            what: format!("accepted.toml accepts the mutation `{of}`, and {why}"),
            help: "remove the entry".to_owned(),
        })
    }
}

/// Whether an entry of `accepted.toml` is about a change: it names the change, or its line alone, which stands for all changes of the line.
pub(in crate::audit) fn covers(entry: &str, change: &str) -> bool {
    let rest = change.strip_prefix(entry);
    rest.is_some_and(|rest| rest.is_empty() || rest.starts_with(" -> "))
}

/// What is wrong with an entry that names no change of the solution.
pub(in crate::audit) fn no_mutation(of: &str) -> MutationProblem {
    MutationProblem {
        mutation: None,
        what: format!(
            "accepted.toml accepts the mutation `{of}`, and the solution has no such line or change"
        ),
        help: "remove the entry, or write the line as `lab check --mutate` prints it".to_owned(),
    }
}

/// A row for every check of the lab, then one for each task and verdict with which programs were stopped.
fn catches(lab: &Lab, mutations: &[TriedMutation]) -> Vec<CheckCatches> {
    let mut counts: BTreeMap<&Catch, (usize, usize)> = BTreeMap::new();
    for tried in mutations {
        let Fate::Caught { by } = &tried.fate else {
            continue;
        };
        for catch in by {
            let (caught, only) = counts.entry(catch).or_default();
            *caught += 1;
            *only += usize::from(by.len() == 1);
        }
    }
    let mut rows = Vec::new();
    for task in &lab.tasks {
        let names = task.checks().into_iter().map(|check| Catch {
            task: task.name.clone(),
            check: Some(check.name.clone()),
            stopped: None,
        });
        let stops = counts
            .keys()
            .filter(|catch| catch.task == task.name && catch.stopped.is_some());
        let all: Vec<Catch> = names.chain(stops.map(|catch| (*catch).clone())).collect();
        rows.extend(all.into_iter().map(|catch| {
            let (caught, only) = counts.get(&catch).copied().unwrap_or_default();
            CheckCatches {
                catch,
                caught,
                only,
            }
        }));
    }
    rows
}
