//! Clearance: a cheap, conservative answer to "can any link touch anything during this step?".
//!
//! Every shape of a moving link is covered by balls along its longest side; obstacles are covered by axis-aligned boxes. The least
//! distance between the two is a budget of travel: as long as no ball can have travelled that far, by the sum of the joints' motions
//! times their lever arms, the distance need not be computed again. A link that is near counts as near until it may have moved away.

use nalgebra::Vector3;

use super::work::LOOK;
use crate::kinematics::FramePoses;
use crate::model::inertia::Solid;
use crate::model::robot::Robot;
use crate::spatial::Pose;

/// Nearer than this \[m\], links may touch: more than the distance at which the engine predicts contacts.
const NEAR_M: f64 = 2.5 * super::engine_settings::PREDICTION_M;
/// The largest budget \[m\]; it bounds how far prismatic joints can lengthen the lever arms before the next check.
const BUDGET_M: f64 = 1.0;
/// Most balls along one shape.
const MOST_BALLS: f64 = 32.0;

/// Something that a link may touch.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Obstacle {
    /// The ground: all below z = 0.
    Ground,
    /// An axis-aligned box in the world: its least and greatest corner \[m\].
    Box([Vector3<f64>; 2]),
}

/// A ball on a moving body.
#[derive(Debug, Clone)]
struct Ball {
    body: usize,
    p_in_body: Vector3<f64>,
    radius_m: f64,
}

/// The budget of one robot.
#[derive(Debug, Clone)]
pub(crate) struct Clearance {
    balls: Vec<Ball>,
    poses: FramePoses,
    /// How far a ball can go per unit of each body's joint.
    levers: Vec<f64>,
    /// Travel left before a link can be near an obstacle \[m\].
    left_m: f64,
    /// Travel left before a near link can be clear again \[m\].
    stays_near_m: f64,
    obstacles: Vec<Obstacle>,
    /// What all looks cost so far ([`super::work`]).
    work: u64,
}

impl Clearance {
    pub(crate) fn new(robot: &Robot) -> Self {
        let mut balls = Vec::new();
        for link in robot.links() {
            let Some(body) = link.attachment.body else {
                continue;
            };
            for shape in &link.shapes {
                let body_from_shape = link.attachment.body_from_here * shape.link_from_shape;
                cover(&shape.solid, body, &body_from_shape, &mut balls);
            }
        }
        let mut clearance = Self {
            balls,
            poses: FramePoses::new(robot),
            levers: vec![0.0; robot.bodies().len()],
            left_m: 0.0,
            stays_near_m: -1.0,
            obstacles: Vec::new(),
            work: 0,
        };
        clearance.measure_levers(robot, &vec![0.0; robot.n()]);
        clearance
    }

    /// Whether any moving link has a shape.
    pub(crate) fn has_shapes(&self) -> bool {
        !self.balls.is_empty()
    }

    /// Drops the budgets, because an obstacle moved.
    pub(crate) fn forget(&mut self) {
        self.left_m = 0.0;
        self.stays_near_m = -1.0;
    }

    /// Whether a link may touch an obstacle in the motion from `q` to `next_q`, while no obstacle moves farther than `others_m`; true
    /// also for NaN.
    pub(crate) fn is_near(
        &mut self,
        robot: &Robot,
        q: &[f64],
        next_q: &[f64],
        others_m: f64,
        list_obstacles: impl FnOnce(&mut Vec<Obstacle>),
    ) -> bool {
        if self.balls.is_empty() {
            return false;
        }
        let used_m = self.travel_m(robot, q, next_q) + others_m;
        self.left_m -= used_m;
        if self.left_m > NEAR_M {
            return false;
        }
        self.stays_near_m -= used_m;
        if self.stays_near_m >= 0.0 {
            return true;
        }
        self.poses.update(robot, next_q);
        self.obstacles.clear();
        list_obstacles(&mut self.obstacles);
        self.work += LOOK * (self.balls.len() * (1 + self.obstacles.len())) as u64;
        let distance_m = self.distance_m();
        self.left_m = (distance_m - others_m).min(BUDGET_M);
        self.stays_near_m = NEAR_M - distance_m;
        self.measure_levers(robot, next_q);
        // before its travel in this step a ball may have been nearer by that distance
        let is_clear = distance_m > NEAR_M + self.travel_m(robot, q, next_q) + others_m;
        !is_clear
    }

    /// What all looks cost so far ([`super::work`]).
    pub(crate) fn work(&self) -> u64 {
        self.work
    }

    /// Upper bound of the travel of any ball from `q` to `next_q` \[m\].
    pub(crate) fn travel_m(&self, robot: &Robot, q: &[f64], next_q: &[f64]) -> f64 {
        let bodies = robot.bodies().iter().zip(&self.levers);
        bodies
            .map(|(body, lever)| (body.position(next_q) - body.position(q)).abs() * lever)
            .sum()
    }

    /// The least distance between a ball and an obstacle; NaN if any is.
    fn distance_m(&self) -> f64 {
        let mut least = f64::INFINITY;
        for ball in &self.balls {
            let placed = &self.poses.placed[ball.body];
            let centre = placed.position + placed.world_from_body * ball.p_in_body;
            for obstacle in &self.obstacles {
                let distance = match obstacle {
                    Obstacle::Ground => centre.z,
                    Obstacle::Box([low, high]) => {
                        let outside = (low - centre).sup(&(centre - high));
                        outside.sup(&Vector3::zeros()).norm()
                    }
                } - ball.radius_m;
                // f64::min would drop a NaN
                if distance.is_nan() {
                    return distance;
                }
                least = least.min(distance);
            }
        }
        least
    }

    fn measure_levers(&mut self, robot: &Robot, q: &[f64]) {
        self.levers.fill(0.0);
        for ball in &self.balls {
            let reach = &mut self.levers[ball.body];
            *reach = reach.max(ball.p_in_body.norm());
        }
        // children come after their parents: the distance from each joint to its farthest ball
        for (i, body) in robot.bodies().iter().enumerate().rev() {
            let slid = if body.turns {
                0.0
            } else {
                body.position(q).abs() + self.left_m.max(0.0)
            };
            if let Some(parent) = body.parent {
                let beyond = body.p_body_in_parent.norm() + slid + self.levers[i];
                self.levers[parent] = self.levers[parent].max(beyond);
            }
        }
        for (lever, body) in self.levers.iter_mut().zip(robot.bodies()) {
            if !body.turns {
                *lever = 1.0;
            }
        }
    }
}

/// Covers a solid with balls along the longest side of its box.
fn cover(solid: &Solid, body: usize, body_from_shape: &Pose, balls: &mut Vec<Ball>) {
    if let Solid::Sphere { radius_m } = solid {
        balls.push(Ball {
            body,
            p_in_body: body_from_shape.translation.vector,
            radius_m: *radius_m,
        });
        return;
    }
    let (centre, half) = solid.extent_m();
    let along = half.imax();
    let across = (0..3)
        .filter(|i| *i != along)
        .map(|i| half[i])
        .fold(0.0, f64::max);
    let slices = (half[along] / across).ceil().clamp(1.0, MOST_BALLS);
    let slice = half[along] / slices;
    let mut corner = half;
    corner[along] = slice;
    for i in 0..slices as usize {
        let mut p = centre;
        p[along] += -half[along] + slice * (2.0 * i as f64 + 1.0);
        balls.push(Ball {
            body,
            p_in_body: body_from_shape.rotation * p + body_from_shape.translation.vector,
            radius_m: corner.norm(),
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::format::RobotFile;
    use crate::text::Source;

    const LIFT: &str = "format = 1\nname = 'lift'\n[[links]]\nname = 'base'\n[[links]]\nname = 'car'\n\
        shapes = [{ box = { size_m = [0.2, 0.1, 1.0] } }]\ninertia = { mass_kg = 1.0 }\n[[joints]]\nname = 'slide'\n\
        type = 'prismatic'\nparent = 'base'\nchild = 'car'\naxis = [1.0, 0.0, 0.0]\n";

    fn lift() -> Robot {
        RobotFile::parse(Source::new("lift", LIFT))
            .unwrap()
            .build(&[])
            .unwrap()
    }

    fn wall(x_m: f64) -> Obstacle {
        Obstacle::Box([
            Vector3::new(x_m, -1.0, -1.0),
            Vector3::new(x_m + 1.0, 1.0, 1.0),
        ])
    }

    #[test]
    fn a_car_is_near_the_wall_only_where_it_is() {
        let robot = lift();
        let mut clearance = Clearance::new(&robot);
        let mut looks = 0;
        let mut near_from = None;
        for step in 0..1000 {
            let q = |step: i32| [f64::from(step) * 1e-3];
            let near = clearance.is_near(&robot, &q(step), &q(step + 1), 0.0, |list| {
                looks += 1;
                list.push(wall(1.0));
            });
            if near && near_from.is_none() {
                near_from = Some(q(step)[0]);
            }
        }
        // its front face meets the wall at 0.9 m; balls of half a slice of 0.2 m stand out by no more than 0.1 m
        let from = near_from.unwrap();
        assert!((0.75..0.9).contains(&from), "{from}");
        assert!(looks < 300, "{looks}");
    }

    #[test]
    fn what_is_near_is_not_looked_at_again_until_it_has_moved_away() {
        let robot = lift();
        let mut clearance = Clearance::new(&robot);
        let mut looks = 0;
        let mut near_at = |clearance: &mut Clearance, from: f64, to: f64| {
            clearance.is_near(&robot, &[from], &[to], 0.0, |list| {
                looks += 1;
                list.push(wall(1.0));
            })
        };
        // pressed on the wall it trembles for a thousand steps, then backs off
        for step in 0..1000 {
            let tremble = f64::from(step % 2) * 1e-9;
            assert!(near_at(&mut clearance, 0.9 + tremble, 0.9 + 1e-9 - tremble));
        }
        for step in 0..500 {
            let x = 0.9 - f64::from(step) * 1e-3;
            assert_eq!(near_at(&mut clearance, x, x - 1e-3), {
                // the car as far away as a fresh look finds it
                let mut fresh = Clearance::new(&robot);
                fresh.is_near(&robot, &[x], &[x - 1e-3], 0.0, |list| list.push(wall(1.0)))
            });
        }
        assert!(looks < 50, "{looks}");
    }

    #[test]
    fn a_state_that_is_no_number_counts_as_near() {
        let robot = lift();
        let mut clearance = Clearance::new(&robot);
        assert!(clearance.is_near(&robot, &[0.0], &[f64::NAN], 0.0, |list| {
            list.push(wall(5.0))
        }));
    }
}
