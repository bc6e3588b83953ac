//! The reference solution of lab 0: one PID law, one PI law, and gravity taken out of the loop where it stands in the way.

use std::array::from_fn;

use kinemark_plugin::linear::array;
use kinemark_plugin::math::{pow, sqrt};
use kinemark_plugin::robot_model::gravity;
use kinemark_plugin::{Answer, Map, Observation, Submission, export, plot};

#[derive(Default)]
struct Motors {
    /// The integral of the error, by joint.
    sum: [f64; 2],
}

export!(Motors: control, own position_loop, velocity_loop);

impl Motors {
    /// The loop J a + (b + kd) v + kp x of a joint with a PD controller: how it answers, and what a constant load leaves over.
    fn position_loop(&mut self, given: &Map, answer: &mut Answer) {
        // a box that turns about one end: about its own middle, then moved by half its length
        let m = given.number("mass");
        let (length, width) = (given.number("length"), given.number("width"));
        let (kp, damping) = (given.number("kp"), given.number("damping"));
        let inertia = m * (pow(length, 2.0) + pow(width, 2.0)) / 12.0 + m * pow(length / 2.0, 2.0);
        let damping_ratio = (damping + given.number("kd")) / (2.0 * sqrt(kp * inertia));
        let steady_state_error = if given.number("ki") > 0.0 {
            0.0
        } else {
            given.number("load_torque") / kp
        };
        answer.number("damping_ratio", damping_ratio);
        answer.number("inertia", inertia);
        answer.number("natural_frequency", sqrt(kp / inertia));
        answer.number("steady_state_error", steady_state_error);
    }

    /// The loop J a + (b + kp) v of a joint under velocity control, and how far its gains may go at this control period.
    fn velocity_loop(&mut self, given: &Map, answer: &mut Answer) {
        let (kp, damping) = (given.number("kp"), given.number("damping"));
        let inertia = given.number("inertia");
        answer.number("final_speed", kp / (damping + kp));
        answer.number("largest_kd", inertia);
        answer.number("largest_kp", 2.0 * inertia / given.number("period"));
        answer.number("time_constant", inertia / (damping + kp));
    }

    fn integrate(&mut self, error: [f64; 2], dt: f64) {
        for (sum, error) in self.sum.iter_mut().zip(error) {
            *sum += error * dt;
        }
    }
}

impl Submission for Motors {
    fn control(&mut self, observation: &Observation, command: &mut [f64]) {
        let target = observation.target();
        let (q, qd): ([f64; 2], [f64; 2]) = (array(observation.q()), array(observation.qd()));
        if observation.task() == "warm-up" {
            command.copy_from_slice(&[target.number("shoulder_rad"), 0.0]);
            return;
        }
        let kp = target.number("kp");
        if observation.task() == "speed" {
            let error = [0.0 - qd[0], target.number("elbow_rad_s") - qd[1]];
            self.integrate(error, observation.dt());
            let ki = target.number("ki");
            command.copy_from_slice(&from_fn::<f64, 2, _>(|i| kp * error[i] + ki * self.sum[i]));
            return;
        }
        let error = [0.0 - q[0], target.number("elbow_rad") - q[1]];
        plot("error[0]", error[0]);
        plot("error[1]", error[1]);
        let kd = target.number("kd");
        if observation.task() == "hold" {
            let carried: [f64; 2] = gravity(&q);
            command.copy_from_slice(&from_fn::<f64, 2, _>(|i| {
                kp * error[i] - kd * qd[i] + carried[i]
            }));
            return;
        }
        // the derivative is taken of the measurement: the error's jumps with the command
        self.integrate(error, observation.dt());
        let ki = target.number("ki");
        command.copy_from_slice(&from_fn::<f64, 2, _>(|i| {
            kp * error[i] + ki * self.sum[i] - kd * qd[i]
        }));
    }
}
