//! The reference solution of lab 3: straight lines from point to point, and at each moment the command that makes the arm stand where
//! it is meant to stand.

use std::array::from_fn;

use kinemark_plugin::linear::{array, norm};
use kinemark_plugin::math::{acos, atan2, cos, lerp, quintic, sin};
use kinemark_plugin::robot_model::gravity;
use kinemark_plugin::{Observation, Robot, Submission, export};

/// The servo's stiffness \[N m/rad\].
const KP: f64 = 100.0;
/// On the average of a line \[m/s\].
const SPEED: f64 = 0.4;
/// The same in task "hold", where nothing is in the way \[m/s\].
const BRISK: f64 = 1.0;
/// For the stays of task "hold", so that the arm comes to rest \[s\].
const DWELL: f64 = 2.0;

#[derive(Default)]
struct Knocker {
    base_height: f64,
    link_lengths: [f64; 2],
    /// The points on the way, beginning with where the hand is at first \[m\].
    points: Vec<[f64; 3]>,
    /// Index of the point that the hand comes from.
    leg: usize,
    /// When it left there \[s\].
    began: f64,
}

export!(Knocker: init, control);

impl Submission for Knocker {
    fn init(&mut self, robot: &Robot, _: &str) {
        self.base_height = robot.dimensions().number("base_height");
        self.link_lengths = robot.dimensions().array("link_lengths");
    }

    fn control(&mut self, observation: &Observation, command: &mut [f64]) {
        let (name, speed, dwell) = match observation.task() {
            "hold" => ("target", BRISK, DWELL),
            _ => ("points", SPEED, 0.0),
        };
        if self.points.is_empty() {
            self.points.push(observation.tcp());
            self.points
                .extend(observation.target().rows(name).map(array::<3>));
        }
        let (from, to) = (self.points[self.leg], self.points[self.leg + 1]);
        let duration = norm(from_fn::<f64, 3, _>(|i| to[i] - from[i])) / speed;
        let since = observation.time() - self.began;
        if since >= duration + dwell && self.leg + 2 < self.points.len() {
            self.leg += 1;
            self.began = observation.time();
        }
        let s = quintic(since / duration);
        let q = self.angles(from_fn(|i| lerp(from[i], to[i], s)));
        // at rest the servo gives KP (command - q), and the arm needs gravity(q)
        let carried: [f64; 2] = gravity(&q);
        command.copy_from_slice(&from_fn::<f64, 2, _>(|i| q[i] + carried[i] / KP));
    }
}

impl Knocker {
    /// The angles that bring the hand to `position`, with the elbow bent as it is at the start.
    fn angles(&self, position: [f64; 3]) -> [f64; 2] {
        let l = self.link_lengths;
        let u = position[0] - self.base_height;
        let y = position[1];
        let c = (u * u + y * y - l[0] * l[0] - l[1] * l[1]) / (2.0 * l[0] * l[1]);
        let bend = acos(c.clamp(-1.0, 1.0));
        let shoulder = atan2(y, u) - atan2(l[1] * sin(bend), l[0] + l[1] * cos(bend));
        [shoulder, bend]
    }
}
