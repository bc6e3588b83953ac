//! Commands played back: what a submission earns that commands in every run what the reference solution commands in the visible one,
//! whatever it is given and whatever it measures.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError};

use kinemark_sim::text::Source;

use super::grader::examined_by;
use super::opening::opening;
use super::staff_attempts::StaffAttempts;
use crate::attempt::motion;
use crate::lab::{Lab, Staff, TaskWork};
use crate::record::grade::Grade;
use crate::submission::controller::{Answer, Call, Controller, Failed, Opening, Said, Stop};
use crate::submission::handed_in::Submission;
use crate::submission::host::{Host, InProcess, open_here};
use crate::task::value::Value;

/// What `control` answered, call by call.
type Commands = Arc<Mutex<Vec<Value>>>;

/// The grade of the commands of the visible runs, in the motion tasks that have hidden runs; `None` where there are none of these, or the
/// reference solution stops in one.
pub(crate) fn played_back(lab: &Lab, staff: &Staff, known: &StaffAttempts) -> Option<Grade> {
    let mut part = lab.clone();
    let has_hidden = |name: &str| !staff.runs(name).is_empty();
    part.tasks.retain(|task| has_hidden(&task.name));
    let mut player = Player::default();
    for task in &part.tasks {
        let TaskWork::Motion(work, _) = &task.work else {
            continue;
        };
        let mut recorder = Recorder::default();
        let opening = opening(lab, task, &Submission::from(&staff.solution));
        let run = motion::run(lab.of_task(task).workcell(), work, &opening, &mut recorder);
        if run.ended.is_some() {
            return None;
        }
        player.0.insert(task.name.clone(), recorder.0);
    }
    let is_empty = player.0.is_empty();
    let submission = Submission::from(Source::new("commands.rhai", "// commands, played back"));
    let examined = |player: &mut Player| examined_by(&part, staff, &submission, known, player);
    (!is_empty)
        .then(|| examined(&mut player))
        .flatten()
        .map(|examined| examined.graded.grade)
}

/// Opens submissions in this process, and keeps what they command.
#[derive(Default)]
struct Recorder(Commands);

impl Host for Recorder {
    fn open(&mut self, opening: &Opening) -> Result<Box<dyn Controller>, Box<Failed>> {
        Ok(Box::new(Recording {
            submission: open_here(opening)?,
            commands: self.0.clone(),
        }))
    }
}

struct Recording {
    submission: Box<dyn Controller>,
    commands: Commands,
}

impl Controller for Recording {
    fn call(&mut self, call: &Call) -> Result<Answer, Stop> {
        let answer = self.submission.call(call)?;
        if matches!(call, Call::Control(_)) {
            locked(&self.commands).push(answer.value.clone());
        }
        Ok(answer)
    }

    fn unanswered(&mut self) -> Said {
        self.submission.unanswered()
    }
}

/// Opens the commands of each task, whatever the submission; the last one is given for ever.
#[derive(Default)]
pub(super) struct Player(BTreeMap<String, Commands>);

impl Player {
    /// Of these commands in one task.
    pub(super) fn of(task: &str, commands: Vec<Value>) -> Self {
        let commands = Arc::new(Mutex::new(commands));
        Self(BTreeMap::from([(task.to_owned(), commands)]))
    }
}

impl Host for Player {
    fn open(&mut self, opening: &Opening) -> Result<Box<dyn Controller>, Box<Failed>> {
        match self.0.get(&opening.task) {
            Some(commands) => Ok(Box::new(Playing {
                commands: commands.clone(),
                next: 0,
            })),
            None => InProcess.open(opening),
        }
    }
}

struct Playing {
    commands: Commands,
    next: usize,
}

impl Controller for Playing {
    fn call(&mut self, call: &Call) -> Result<Answer, Stop> {
        let mut value = Value::Nothing;
        if matches!(call, Call::Control(_)) {
            let commands = locked(&self.commands);
            let command = commands.get(self.next).or_else(|| commands.last());
            value = command.cloned().unwrap_or(Value::Nothing);
            self.next += 1;
        }
        Ok(Answer {
            value,
            said: Said::default(),
            operations: 0,
        })
    }

    fn unanswered(&mut self) -> Said {
        Said::default()
    }
}

fn locked(commands: &Commands) -> std::sync::MutexGuard<'_, Vec<Value>> {
    commands.lock().unwrap_or_else(PoisonError::into_inner)
}
