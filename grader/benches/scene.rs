//! A whole run with contact, as lab 4 asks for it: 8 s at 1 ms, a script's `control` at 100 Hz, a velocity servo at 1 kHz, shelf and can.

use criterion::{Criterion, criterion_group, criterion_main};
use kinemark_grader::judge::grade;
use kinemark_grader::lab::Lab;
use kinemark_grader::submission::handed_in::Submission;
use kinemark_grader::submission::host::InProcess;
use kinemark_grader::task::files::Files;
use kinemark_sim::text::Source;
use kinemark_sim::watch::event::EventKind;

/// The labs of the course, and one lab more.
struct Labs;

impl Files for Labs {
    fn name(&self) -> String {
        "labs".to_owned()
    }

    fn bytes(&self, path: &str) -> Result<Option<Vec<u8>>, String> {
        if path == "90-sweep/lab.toml" {
            return Ok(Some(LAB.as_bytes().to_vec()));
        }
        let labs = concat!(env!("CARGO_MANIFEST_DIR"), "/../labs");
        Ok(std::fs::read(format!("{labs}/{path}")).ok())
    }

    fn list(&self, _: &str) -> Vec<String> {
        Vec::new()
    }
}

const LAB: &str = r#"
format = 1
name = "90-sweep"
title = "Sweep"
robot = "rrbot"
frame = "lab"

[[tasks]]
name = "sweep"
title = "Two straight lines"

[tasks.motion]
mode = "velocity"
scene = "shelf-and-can"
duration_s = 8.0
start_rad = [0.775397496610753, 1.5907976603682872]
servo = { kp = 20.0, ki = 50.0, gravity_compensation = true, effort_limit = [30.0, 15.0] }

[[tasks.checks]]
name = "there"
title = "The shoulder is there"
points = 1.0
joint-reached = { joint = "shoulder", position_rad = 0.0, hold_s = 0.5, full_rad = 10.0, zero_rad = 20.0 }
"#;

/// Lines from (2, 1.4) by (1.25, 1.4) to (1.25, 0.6) at 0.25 m/s, tracked with the Jacobian.
const SWEEP: &str = r#"
const VIA = [[2.0, 1.4], [1.25, 1.4], [1.25, 0.6]];
const SPEED = 0.25;

fn init(robot, task) {
    this.robot = robot;
    this.segment = 0;
    this.since = 0.0;
}

fn jacobian(robot, q) {
    let l = robot.link_lengths;
    let s1 = l[0] * sin(q[0]);
    let c1 = l[0] * cos(q[0]);
    let s12 = l[1] * sin(q[0] + q[1]);
    let c12 = l[1] * cos(q[0] + q[1]);
    matrix([[-s1 - s12, -s12], [c1 + c12, c12]])
}

fn control(observation) {
    let from = vector(VIA[this.segment]);
    let to = vector(VIA[this.segment + 1]);
    let length = norm(to - from);
    let along = (to - from) / length;
    let gone = SPEED * (observation.time - this.since);
    if gone >= length && this.segment == 0 {
        this.segment = 1;
        this.since = observation.time;
    }
    let p = vector([observation.tcp[0], observation.tcp[1]]);
    let wanted = from + along * min(gone, length);
    let v = (wanted - p) * 4.0;
    if gone < length {
        v = v + along * SPEED;
    }
    jacobian(this.robot, observation.q).solve(v)
}
"#;

fn run(c: &mut Criterion) {
    let lab = Lab::load(&Labs, "90-sweep").expect("lab");
    let submission = Submission::from(Source::new("submission.rhai", SWEEP));
    let graded = grade(&lab, None, &submission, &mut InProcess).expect("graded");
    // a run in which nothing fell would be measured for nothing
    let events = &graded.runs[0].trace.events;
    let fell = |kind: &EventKind| matches!(kind, EventKind::BodyFell { .. });
    assert!(
        events.iter().any(|event| fell(&event.kind)),
        "{:?} {events:?}",
        graded.grade.tasks[0].stopped
    );
    let mut group = c.benchmark_group("scene");
    group.sample_size(20);
    group.bench_function("lab-4 run, 8 s, script at 100 Hz", |b| {
        b.iter(|| grade(&lab, None, &submission, &mut InProcess));
    });
    group.finish();
}

criterion_group!(benches, run);
criterion_main!(benches);
