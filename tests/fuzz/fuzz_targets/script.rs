//! Text of a script: whatever it is, it opens or is refused, and a call of what opens ends within its budgets.
#![no_main]

use kinemark_fuzz::opening;
use kinemark_grader::submission::controller::{Call, Controller as _};
use kinemark_grader::submission::handed_in::Program;
use kinemark_grader::submission::rhai::ScriptController;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| {
    let opening = opening(Program::Script(text.to_owned()));
    if let Ok(mut script) = ScriptController::open(&opening) {
        let call = Call::ForwardKinematics {
            robot: opening.robot.clone(),
            q: vec![0.5, -0.5],
        };
        let _stop = script.call(&call);
        let _stop = script.call(&Call::Init);
    }
});
