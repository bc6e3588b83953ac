//! Hosts that open submissions: this process, or one that starts workers.

use super::controller::{Controller, Failed, Opening};
use super::handed_in::Program;
use super::plugin::PluginController;
use super::rhai::ScriptController;

/// Opens a submission for a task: in this process, or in a worker.
pub trait Host {
    /// Starts the submission of `opening`.
    ///
    /// # Errors
    /// [`Failed`] if it cannot start.
    fn open(&mut self, opening: &Opening) -> Result<Box<dyn Controller>, Box<Failed>>;

    /// Called when a task begins, to show progress.
    fn begins(&mut self, _task: &str) {}

    /// Other hosts, at most so many, for runs of the same submission at the same time: one for each processor that has nothing else to do.
    fn beside(&mut self, _most: usize) -> Vec<Box<dyn Host + Send>> {
        Vec::new()
    }
}

/// Runs submissions in this process.
#[derive(Debug, Default)]
pub struct InProcess;

impl Host for InProcess {
    fn open(&mut self, opening: &Opening) -> Result<Box<dyn Controller>, Box<Failed>> {
        open_here(opening)
    }
}

/// Opens a submission in this process, whatever it is made of.
///
/// # Errors
/// [`Failed`] if it cannot start.
pub fn open_here(opening: &Opening) -> Result<Box<dyn Controller>, Box<Failed>> {
    Ok(match opening.program {
        Program::Script(_) => Box::new(ScriptController::open(opening)?),
        Program::Module(_) => Box::new(PluginController::open(opening)?),
        #[cfg(feature = "python")]
        Program::Python(_) => Box::new(super::python::PythonController::open(opening)?),
        #[cfg(not(feature = "python"))]
        Program::Python(_) => return Err(without_python().into()),
    })
}

/// The stop where Python is left out of the build: in a browser.
#[cfg(not(feature = "python"))]
fn without_python() -> super::controller::Stop {
    super::controller::Stop::DidNotBuild(super::controller::Mistake {
        message: "this build of Kinemark does not run Python".to_owned(),
        place: None,
        help: Some("grade it with the program that you install, or hand in a script".to_owned()),
        further: Vec::new(),
    })
}
