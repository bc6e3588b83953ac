//! Traces written by hand, judged by a check as a lab file has it.

use kinemark_sim::run::{Recorder as _, Row, Setup};
use kinemark_sim::trace::TraceRecorder;

use super::{Finding, MotionFacts, judge_motion};
use crate::lab::{Lab, TaskWork};
use crate::record::names::Names;
use crate::task::files::Files;
use crate::task::model::Band;

/// One row of the course's arm.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct HandRow {
    pub(super) q: [f64; 2],
    pub(super) qd: [f64; 2],
    pub(super) command: [f64; 2],
    pub(super) effort: [f64; 2],
}

/// A lab and its robot.
struct OneLab(String, String);

const ARM: &str = include_str!("../../../labs/robots/rrbot.toml");

impl Files for OneLab {
    fn name(&self) -> String {
        "by hand".to_owned()
    }

    fn bytes(&self, path: &str) -> Result<Option<Vec<u8>>, String> {
        Ok(match path {
            "by-hand/lab.toml" => Some(self.0.clone().into_bytes()),
            "robots/rrbot.toml" => Some(self.1.clone().into_bytes()),
            _ => None,
        })
    }

    fn list(&self, folder: &str) -> Vec<String> {
        let names: &[&str] = match folder {
            "" => &["by-hand", "robots"],
            "robots" => &["rrbot.toml"],
            _ => &[],
        };
        names.iter().map(|name| (*name).to_owned()).collect()
    }
}

/// What the check `kind = {...}` finds in the run that `row` gives at each time \[s\], in a task with the keys of `motion`.
pub(super) fn judged(motion: &str, kind: &str, row: impl Fn(f64) -> HandRow) -> Finding {
    found(ARM, motion, kind, row)
}

/// The same of an arm whose elbow does not turn but slides, along the upper arm.
pub(super) fn judged_sliding(motion: &str, kind: &str, row: impl Fn(f64) -> HandRow) -> Finding {
    let (before, elbow) = ARM.split_once("name = \"elbow\"").expect("an elbow");
    let elbow = elbow.replacen("revolute", "prismatic", 1).replacen(
        "axis = [0.0, 1.0, 0.0]",
        "axis = [0.0, 0.0, 1.0]",
        1,
    );
    let arm = format!("{before}name = \"elbow\"{elbow}");
    found(&arm, motion, kind, row)
}

/// The same of an arm whose elbow has no drive.
pub(super) fn judged_undriven(motion: &str, kind: &str, row: impl Fn(f64) -> HandRow) -> Finding {
    let arm = ARM.replacen("name = \"elbow\"", "name = \"elbow\"\npassive = true", 1);
    found(&arm, motion, kind, row)
}

/// Why a check is refused for an arm whose joints have no limits.
pub(super) fn refused_without_limits(motion: &str, kind: &str) -> String {
    let lines = ARM.lines().filter(|line| !line.starts_with("limit = "));
    let arm: String = lines.flat_map(|line| [line, "\n"]).collect();
    match Lab::load(&OneLab(lab_text(motion, kind), arm), "by-hand") {
        Ok(_) => panic!("the check is read"),
        Err(error) => format!("{:?}", miette::Report::new(error)),
    }
}

fn lab_text(motion: &str, kind: &str) -> String {
    format!(
        "format = 1\nname = \"by-hand\"\ntitle = \"By hand\"\nrobot = \"rrbot\"\nframe = \"lab\"\n\
         [[tasks]]\nname = \"step\"\ntitle = \"Step\"\n[tasks.motion]\n{motion}\n\
         [[tasks.checks]]\nname = \"check\"\ntitle = \"Check\"\npoints = 1.0\n{kind}\n"
    )
}

fn found(arm: &str, motion: &str, kind: &str, row: impl Fn(f64) -> HandRow) -> Finding {
    let text = lab_text(motion, kind);
    let lab = Lab::load(&OneLab(text, arm.to_owned()), "by-hand")
        .unwrap_or_else(|error| panic!("{error:?}"));
    let task = &lab.tasks[0];
    let TaskWork::Motion(motion, checks) = &task.work else {
        panic!("a motion task");
    };
    let robot = &lab.robot;
    let setup = Setup {
        robot,
        scene: None,
        tcp: robot.tcp(),
        seen_from: robot.frame(&lab.frame).expect("the lab's frame"),
        periods: motion.periods,
        gravity_m_s2: motion.gravity_m_s2,
        servo: motion.servo.clone(),
        sensors: Vec::new(),
        start_q: motion.start_q.clone(),
        start_qd: vec![0.0; robot.n()],
        laws: None,
        pushes: Vec::new(),
        ticks: motion.ticks,
    };
    let mut recorder = TraceRecorder::new(&setup);
    for tick in 0..=motion.ticks {
        let row = row(motion.periods.time_s(tick));
        recorder.row(Row {
            tick,
            q: &row.q,
            qd: &row.qd,
            command: &row.command,
            effort: &row.effort,
            sensors: &[],
            scene: None,
        });
    }
    let trace = recorder.finish();
    let facts = MotionFacts {
        robot,
        names: Names {
            robot,
            scene: None,
            seen_from: &lab.frame,
        },
        motion,
        trace: &trace,
        dwells: Vec::new(),
        pose_band: Band {
            full: 0.0,
            zero: 1.0,
        },
        reference: None,
        solution: None,
        reached: &[],
        sweeps: Vec::new(),
    };
    judge_motion(&checks[0], &facts)
}

/// The value a finding measured; infinity where it has none.
pub(super) fn value(finding: &Finding) -> f64 {
    let measure = finding.measure.as_ref().expect("a measure");
    measure.value.unwrap_or(f64::INFINITY)
}
