//! Workers that run Python: one serves all tasks of a submission, and the largest submission leaves address space.

use std::time::Duration;

use kinemark_grader::submission::controller::{Call, Opening};
use kinemark_grader::submission::handed_in::Program;
use kinemark_grader::submission::host::Host as _;
use kinemark_grader::task::value::Value;
use rustix::process::Pid;

use crate::host_limits::sealed_worker;
use crate::worker::{WorkerHost, host, opening};

const LONGEST: Duration = Duration::from_secs(60);
const SMALL: &str =
    "import numpy as np\n\n\ndef forward_kinematics(robot, q):\n    return np.array([0, 1.0, 2])\n";
/// Fills what a submission may have, in its statements and in a case.
const LARGE: &str = "kept = bytearray(48 << 20)\n\n\ndef forward_kinematics(robot, q):\n    more = bytearray(4 << 20)\n    return [len(kept), len(more), 0]\n";
/// What a worker should not come near to: seven eighths of its 512 MB.
const MOST_KILOBYTES: u64 = 448 << 10;

pub(crate) fn a_worker_serves_the_next_task() {
    let mut host = host(LONGEST);
    let first = task(&mut host, SMALL, [0.0, 1.0, 2.0]);
    for _ in 0..5 {
        assert_eq!(task(&mut host, SMALL, [0.0, 1.0, 2.0]), first);
    }
}

pub(crate) fn the_largest_submission_leaves_address_space() {
    let mut host = host(LONGEST);
    for _ in 0..3 {
        let bytes = [f64::from(48 << 20), f64::from(4 << 20), 0.0];
        let worker = task(&mut host, LARGE, bytes);
        let status = format!("/proc/{}/status", worker.as_raw_nonzero());
        let status =
            std::fs::read_to_string(status).expect("the worker is kept until the next task");
        let peak = status.lines().find_map(|line| line.strip_prefix("VmPeak:"));
        let peak = peak.and_then(|line| line.split_whitespace().next()?.parse().ok());
        let peak: u64 = peak.expect("the most address space");
        assert!(peak < MOST_KILOBYTES, "{peak} KB");
    }
}

/// Runs a task of one case, and says which worker it was that served it.
fn task(host: &mut WorkerHost, source: &str, answer: [f64; 3]) -> Pid {
    let opening = Opening {
        program: Program::Python(source.to_owned()),
        ..opening("submission.py", String::new())
    };
    let mut controller = host.open(&opening).expect("it is loaded");
    let case = Call::ForwardKinematics {
        robot: opening.robot.clone(),
        q: vec![0.0],
    };
    let answered = controller.call(&case).expect("an answer");
    assert_eq!(
        answered.value,
        Value::List(answer.map(Value::Number).to_vec())
    );
    sealed_worker().expect("a worker")
}
