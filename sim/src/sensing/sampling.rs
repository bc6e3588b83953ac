//! All sensors of one run, tick by tick: what the world shows them, and what they tell.

use nalgebra::Vector3;

use super::device::Device;
use super::limit_switch::Opening;
use super::wrench::{Gauge, MeanMotion};
use crate::engine::{EngineError, LinkShapes};
use crate::kinematics::FramePoses;
use crate::model::contact::{ContactFact, Party};
use crate::model::robot::Robot;
use crate::model::sensor::{Sensor, SensorKind, moved_by};
use crate::step::hybrid::HybridStep;

/// What there is to measure at one tick. Vectors have shape `(n)`.
#[derive(Clone, Copy)]
pub struct Seen<'a> {
    /// The tick.
    pub tick: u64,
    /// The robot.
    pub robot: &'a Robot,
    /// Joint positions \[rad or m\].
    pub q: &'a [f64],
    /// Joint velocities \[rad/s or m/s\].
    pub qd: &'a [f64],
    /// Efforts applied in the last step; zeros before the first \[N m or N\].
    pub effort: &'a [f64],
    /// Mean accelerations over the last step: the change of `qd` in it by its length; zeros before the first \[rad/s²
    /// or m/s²\].
    pub qdd: &'a [f64],
    /// Gravity in the world \[m/s²\].
    pub gravity_m_s2: &'a Vector3<f64>,
    /// Who pressed on whom in the last step.
    pub contacts: &'a [ContactFact],
    /// The scene as it stands, for rays; without it they see the robot only.
    pub scene: Option<&'a HybridStep>,
}

/// A sensor that cannot be read at this physics step.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SensorError {
    /// A delay between two steps.
    #[error(
        "sensor `{sensor}`: a delay of {delay_s} s is not a whole number of physics steps of {step_s} s; the nearest is {nearest_s} s"
    )]
    Delay {
        /// The sensor.
        sensor: String,
        /// Its delay \[s\].
        delay_s: f64,
        /// The physics step \[s\].
        step_s: f64,
        /// The nearest delay that fits \[s\].
        nearest_s: f64,
    },
    /// A delay with too many values under way.
    #[error(
        "sensor `{sensor}`: a delay of {delay_s} s is too long; at this physics step it is at most {most_s} s"
    )]
    LongDelay {
        /// The sensor.
        sensor: String,
        /// Its delay \[s\].
        delay_s: f64,
        /// The longest one \[s\].
        most_s: f64,
    },
    /// Values that would fall between two steps.
    #[error(
        "sensor `{sensor}`: at {rate_hz} Hz, values are not a whole number of physics steps of {step_s} s apart; the nearest rate is {nearest_hz} Hz"
    )]
    Rate {
        /// The sensor.
        sensor: String,
        /// Its rate \[Hz\].
        rate_hz: f64,
        /// The physics step \[s\].
        step_s: f64,
        /// The nearest rate that fits \[Hz\].
        nearest_hz: f64,
    },
    /// A link that rays cannot meet.
    #[error(transparent)]
    Shape(#[from] EngineError),
}

/// The sensors of one run. A copy goes on with the same noise and the same values under way.
#[derive(Clone)]
pub struct Sensors {
    specs: Vec<Sensor>,
    units: Vec<Unit>,
    values: Vec<f64>,
    step_s: f64,
    /// Room for rays, if there is a range finder.
    sight: Option<Sight>,
    /// Room for wrenches, if there is a gauge.
    motion: Option<MeanMotion>,
}

/// One sensor at work.
#[derive(Clone)]
struct Unit {
    device: Device,
    /// Where its channels start among the values.
    start: usize,
    /// Of a limit switch, whether it is pressed, undelayed.
    pressed: bool,
    /// Of a limit switch, the motor that it opens.
    opens: Option<Opening>,
    /// Of a wrench sensor, what it carries.
    gauge: Option<Gauge>,
}

#[derive(Clone)]
struct Sight {
    poses: FramePoses,
    links: LinkShapes,
}

impl Sensors {
    /// The `sensors` of `robot` in a run with steps of `step_s`.
    ///
    /// # Errors
    /// A delay or a rate that is not a whole number of steps; with a range finder, a mesh of a link that has no convex hull.
    ///
    /// # Panics
    /// If a sensor was resolved against another robot that has more joints, links or frames.
    pub fn new(robot: &Robot, sensors: Vec<Sensor>, step_s: f64) -> Result<Self, SensorError> {
        let mut units = Vec::with_capacity(sensors.len());
        let mut width = 0;
        for sensor in &sensors {
            units.push(Unit {
                device: Device::new(sensor, step_s)?,
                start: width,
                pressed: false,
                opens: match &sensor.kind {
                    SensorKind::LimitSwitch(switch) => switch.opens(robot),
                    _ => None,
                },
                gauge: match sensor.kind {
                    SensorKind::Wrench { joint } => Some(Gauge::new(robot, joint)),
                    _ => None,
                },
            });
            width += sensor.kind.channels();
        }
        let any = |wanted: fn(&SensorKind) -> bool| sensors.iter().any(|s| wanted(&s.kind));
        Ok(Self {
            sight: if any(|kind| matches!(kind, SensorKind::RangeFinder(_))) {
                Some(Sight {
                    poses: FramePoses::new(robot),
                    links: LinkShapes::new(robot)?,
                })
            } else {
                None
            },
            motion: any(|kind| matches!(kind, SensorKind::Wrench { .. }))
                .then(|| MeanMotion::new(robot)),
            units,
            values: vec![0.0; width],
            step_s,
            specs: sensors,
        })
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.specs.is_empty()
    }

    /// The sensors, in the order of the readings.
    pub fn specs(&self) -> &[Sensor] {
        &self.specs
    }

    /// Channels of all sensors together.
    pub fn width(&self) -> usize {
        self.values.len()
    }

    /// What sensor `i` tells: one number, six for a wrench, zeros before the first sample.
    ///
    /// # Panics
    /// If there is no such sensor.
    pub fn reading(&self, i: usize) -> &[f64] {
        let start = self.units[i].start;
        &self.values[start..start + self.specs[i].kind.channels()]
    }

    /// The channels of all sensors, in order.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// Shows the sensors what there is at a tick; once for each tick, in order, before anyone reads them.
    ///
    /// # Panics
    /// If a vector does not have the shape of the robot, or the robot is not the one the sensors were made for.
    pub fn sample(&mut self, seen: &Seen<'_>) {
        let Seen { tick, robot, .. } = *seen;
        let mut is_sighted = false;
        let mut is_moved = false;
        for (spec, unit) in self.specs.iter().zip(&mut self.units) {
            let body = |joint| moved_by(robot, joint);
            if let SensorKind::LimitSwitch(switch) = &spec.kind {
                unit.pressed =
                    body(switch.joint).is_some_and(|body| switch.is_pressed(body.position(seen.q)));
            }
            let channels = spec.kind.channels();
            let held = &mut self.values[unit.start..unit.start + channels];
            if !unit.device.is_due(tick) {
                unit.device.receive(tick, held);
                continue;
            }
            let mut raw = [0.0; 6];
            let value = &mut raw[..channels];
            match &spec.kind {
                SensorKind::JointPosition { joint } => {
                    value[0] = body(*joint).map_or(0.0, |body| body.position(seen.q));
                    unit.device.disturb(value);
                }
                SensorKind::JointVelocity { joint } => {
                    value[0] = body(*joint).map_or(0.0, |body| body.rate(seen.qd));
                    unit.device.disturb(value);
                }
                SensorKind::JointEffort { joint } => {
                    value[0] = body(*joint).map_or(0.0, |body| seen.effort[body.q_index]);
                    unit.device.disturb(value);
                }
                SensorKind::LimitSwitch(_) => value[0] = f64::from(u8::from(unit.pressed)),
                SensorKind::RangeFinder(finder) => {
                    let met = self.sight.as_mut().and_then(|sight| {
                        if !is_sighted {
                            sight.poses.update(robot, seen.q);
                            is_sighted = true;
                        }
                        finder.distance_m(robot, &sight.poses, &sight.links, seen.scene)
                    });
                    // drawn in any case, so that noise does not depend on what was seen before
                    value[0] = met.unwrap_or(finder.range_m);
                    unit.device.disturb(value);
                    value[0] = match met {
                        Some(_) => value[0].max(0.0).min(finder.range_m),
                        None => finder.range_m,
                    };
                }
                SensorKind::Contact { link } => {
                    value[0] = normal_force_n(seen.contacts, *link);
                    unit.device.disturb(value);
                }
                SensorKind::Wrench { .. } => {
                    if let (Some(gauge), Some(motion)) = (&unit.gauge, &mut self.motion) {
                        if !is_moved {
                            motion.update(seen, self.step_s);
                            is_moved = true;
                        }
                        let (gravity, contacts) = (seen.gravity_m_s2, seen.contacts);
                        let air = seen.scene.and_then(HybridStep::air_of_last_step);
                        raw = gauge.wrench(motion, gravity, contacts, air, self.step_s);
                    }
                    unit.device.disturb(&mut raw);
                }
            }
            unit.device.send(tick, &raw[..channels], held);
            unit.device.receive(tick, held);
        }
    }

    /// Takes from `effort`, shape `(n)`, what pushes a joint towards a limit switch that is pressed and opens its
    /// motor. Noise, rate and delay do not matter to the circuit: what counts is the position of the last sample.
    ///
    /// # Panics
    /// If `effort` does not have the shape of the robot.
    pub fn open_motors(&self, effort: &mut [f64]) {
        for unit in &self.units {
            if let (Some(opening), true) = (unit.opens, unit.pressed) {
                opening.open(effort);
            }
        }
    }
}

/// The sum of the normal forces on a link \[N\].
fn normal_force_n(contacts: &[ContactFact], link: usize) -> f64 {
    contacts
        .iter()
        .filter(|fact| fact.parties.contains(&Party::Link(link)))
        .map(|fact| fact.force_n)
        .sum()
}

impl std::fmt::Debug for Sensors {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Sensors")
            .field("specs", &self.specs)
            .field("values", &self.values)
            .finish_non_exhaustive()
    }
}
