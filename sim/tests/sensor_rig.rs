//! A robot with the sensors of its file in a scene, stepped and sampled as a run does it.

use kinemark_sim::model::contact::ContactFact;
use kinemark_sim::model::robot::Robot;
use kinemark_sim::model::scene::Scene;
use kinemark_sim::model::sensor::Seen;
use kinemark_sim::sensing::Sensors;
use kinemark_sim::step::hybrid::HybridStep;

use crate::arms::robot;
use crate::contact_scenes::GRAVITY;

pub(crate) const DT: f64 = 1e-3;

pub(crate) fn text(name: &str) -> String {
    let path = format!("{}/../labs/robots/{name}.toml", env!("CARGO_MANIFEST_DIR"));
    std::fs::read_to_string(&path).expect(&path)
}

/// A robot of the labs with sensors.
pub(crate) fn equipped(name: &str, sensors: &str) -> Robot {
    robot(&(text(name) + sensors))
}

pub(crate) fn sensors(robot: &Robot) -> Sensors {
    Sensors::new(robot, robot.sensors().to_vec(), DT).expect("sensors that fit the step")
}

/// What there is before the first step, at rest, alone.
pub(crate) fn still<'a>(robot: &'a Robot, q: &'a [f64], zeros: &'a [f64]) -> Seen<'a> {
    Seen {
        tick: 0,
        robot,
        q,
        qd: zeros,
        effort: zeros,
        qdd: zeros,
        gravity_m_s2: &GRAVITY,
        contacts: &[],
    }
}

/// A robot in a scene, with the sensors of its file.
pub(crate) struct Rig {
    pub(crate) robot: Robot,
    pub(crate) step: HybridStep,
    pub(crate) sensors: Sensors,
    pub(crate) tick: u64,
    pub(crate) q: Vec<f64>,
    pub(crate) qd: Vec<f64>,
    pub(crate) qdd: Vec<f64>,
    pub(crate) effort: Vec<f64>,
    pub(crate) contacts: Vec<ContactFact>,
    pub(crate) dt_s: f64,
}

impl Rig {
    pub(crate) fn new(robot: Robot, scene: &Scene, q: &[f64], dt_s: f64) -> Self {
        let specs = robot.sensors().to_vec();
        let zeros = vec![0.0; robot.n()];
        let mut rig = Self {
            step: HybridStep::new(&robot, scene, GRAVITY, dt_s).expect("a scene"),
            sensors: Sensors::new(&robot, specs, dt_s).expect("sensors"),
            tick: 0,
            q: q.to_vec(),
            qd: zeros.clone(),
            qdd: zeros.clone(),
            effort: zeros,
            contacts: Vec::new(),
            dt_s,
            robot,
        };
        rig.sample();
        rig
    }

    pub(crate) fn sample(&mut self) {
        let seen = Seen {
            tick: self.tick,
            robot: &self.robot,
            q: &self.q,
            qd: &self.qd,
            effort: &self.effort,
            qdd: &self.qdd,
            gravity_m_s2: &GRAVITY,
            contacts: &self.contacts,
        };
        self.sensors.sample(&seen, Some(&self.step));
    }

    /// One step under `effort`, less what the switches open, and the sample after it.
    pub(crate) fn advance(&mut self, effort: &[f64]) {
        self.effort.copy_from_slice(effort);
        self.sensors.open_motors(&mut self.effort);
        let before = self.qd.clone();
        let report = self
            .step
            .advance(&self.robot, &self.effort, &mut self.q, &mut self.qd)
            .expect("a step");
        self.contacts.clone_from(&report.contacts);
        for (qdd, (after, before)) in self.qdd.iter_mut().zip(self.qd.iter().zip(&before)) {
            *qdd = (after - before) / self.dt_s;
        }
        self.tick += 1;
        self.sample();
    }

    pub(crate) fn reading(&self, name: &str) -> Vec<f64> {
        let index = self.sensors.specs().iter().position(|s| s.name == name);
        self.sensors.reading(index.expect(name)).to_vec()
    }
}
