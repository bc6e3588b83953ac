//! Bytes of a compiled submission: whatever they are, they open or are refused, and a call of what opens ends.
#![no_main]

use kinemark_fuzz::opening;
use kinemark_grader::submission::controller::{Call, Controller as _};
use kinemark_grader::submission::handed_in::Program;
use kinemark_grader::submission::plugin::PluginController;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    let opening = opening(Program::Module(bytes.to_vec()));
    if let Ok(mut module) = PluginController::open(&opening) {
        let call = Call::ForwardKinematics {
            robot: opening.robot.clone(),
            q: vec![0.5, -0.5],
        };
        let _stop = module.call(&call);
        let _stop = module.call(&Call::Init);
    }
});
