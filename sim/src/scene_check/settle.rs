//! Ten seconds of the scene alone, the robot's fixed links in it: what falls, tips over or never comes to rest.

use nalgebra::Vector3;

use super::checks::not_checked;
use super::finding::{Finding, Kind, Severity, Unchecked};
use super::progress::{Progress, Stage, Watch};
use crate::engine::{BodyState, EngineError, Layout, StepFault, WorkBudget, World};
use crate::format::RobotFile;
use crate::model::contact::{ContactFact, Party};
use crate::model::robot::Robot;
use crate::model::scene::{BodyKind, Scene, SceneBody};
use crate::spatial::{Pose, direction};
use crate::text::Source;

/// The physics step of labs \[s\].
const STEP_S: f64 = 1e-3;
/// Ten seconds of them.
const TICKS: u64 = 10_000;
/// How often it shows how far it is.
const SHOWN_TICKS: u64 = 20;
/// A party that pushes a body up within these ticks counts as its support at the start.
const STANDS_TICKS: u64 = 20;
/// A body may move this far: more than the compliance of a contact, less than one sees \[m\].
const MOVED_M: f64 = 5e-3;
/// A body may tilt this far: 9 degrees, an effect of rounding in the file \[rad\].
const TILTED_RAD: f64 = 5.0 * std::f64::consts::PI / 180.0;
/// Slower than this a body is at rest \[m/s\], \[rad/s\].
const REST: (f64, f64) = (1e-3, 1e-2);
/// Faster than this, with nothing beneath, a body falls \[m/s\].
const FALLING_M_S: f64 = 0.1;
/// The path of a shape's centre is checked in pieces of at least this \[m\]: shorter than the thickness of any shape.
const PIECE_M: f64 = 5e-4;

/// A dynamic body as it settles.
struct Falling {
    body: usize,
    start_com: Vector3<f64>,
    up_in_body: Vector3<f64>,
    /// What was beneath it at the start, and the point below it in that party's frame.
    support: Option<(Party, Vector3<f64>)>,
    /// Whether that party pushed it up first.
    supported: bool,
    /// The centres of its shapes when they were last checked.
    centres: Vec<Vector3<f64>>,
    lost: bool,
}

/// Where everything is after ten seconds.
struct Ends<'a> {
    scene: &'a Scene,
    world: &'a World,
    layout: &'a Layout,
    budget: &'a mut WorkBudget,
}

/// Simulates the scene for ten seconds, or as long as the work is not too much. `layout` becomes that of the end.
///
/// # Errors
/// Shapes or masses that the engine cannot use.
pub(super) fn check(
    scene: &Scene,
    robot: Option<&Robot>,
    layout: &mut Layout,
    findings: &mut Vec<Finding>,
    watch: Watch<'_>,
    mut budget: WorkBudget,
) -> Result<(), EngineError> {
    let nobody = nobody();
    let robot = robot.unwrap_or(&nobody);
    let gravity = scene.environment.gravity_m_s2;
    let down = direction(gravity);
    let mut world = World::new(robot, scene, &gravity, STEP_S, false)?;
    let mut falling: Vec<Falling> = scene
        .bodies
        .iter()
        .enumerate()
        .filter(|(_, body)| matches!(body.kind, BodyKind::Free))
        .map(|(index, body)| Falling::new(index, body, scene, layout, down, &mut budget))
        .collect();
    let mut facts: Vec<ContactFact> = Vec::new();
    // moved by the scene itself, or by a body that is
    let mut moved: Vec<bool> = scene.bodies.iter().map(|b| is_moved(scene, b)).collect();
    for tick in 1..=TICKS {
        if !world.is_awake() {
            break;
        }
        let time_s = tick as f64 * STEP_S;
        if tick % SHOWN_TICKS == 1 {
            watch(at_tick(tick));
        }
        let not_from_here = not_checked(Unchecked::StayFrom((tick - 1) as f64 * STEP_S));
        if budget.is_spent() {
            findings.push(not_from_here);
            return Ok(());
        }
        let before = world.work();
        if let Err(fault) = world.step(robot, None, &mut facts) {
            // the positions of the others mean nothing after that
            findings.push(match fault {
                StepFault::Lost(body) => Finding {
                    severity: Severity::Error,
                    kind: Kind::FliesApart { body, time_s },
                },
                StepFault::TooManyTriangles => not_from_here,
            });
            return Ok(());
        }
        budget.spend(world.work() - before);
        follow(scene, &world, layout);
        layout.index();
        pass_on(scene, &facts, &mut moved);
        if let Some(down) = down.filter(|_| tick <= STANDS_TICKS) {
            for one in &mut falling {
                one.note_support(&facts, &world, &down);
            }
        }
        for one in &mut falling {
            findings.extend(one.falls_through(layout, &mut budget, time_s));
        }
    }
    for one in falling.iter().filter(|one| !one.lost) {
        let state = world.body(one.body);
        let severities = if moved[one.body] {
            [Severity::Note; 2]
        } else {
            [Severity::Error, Severity::Warning]
        };
        let ends = Ends {
            scene,
            world: &world,
            layout,
            budget: &mut budget,
        };
        one.judge(ends, &state, severities, findings);
    }
    Ok(())
}

/// How far the simulation is.
fn at_tick(tick: u64) -> Progress {
    Progress {
        stage: Stage::Settling,
        done: tick,
        of: TICKS,
    }
}

/// Moves the bodies of `layout` to their poses in `world`; a sleeping body has not moved.
fn follow(scene: &Scene, world: &World, layout: &mut Layout) {
    for (index, body) in scene.bodies.iter().enumerate() {
        if !matches!(body.kind, BodyKind::Fixed) {
            let state = world.body(index);
            if !state.sleeps {
                layout.place_body(index, &state.world_from_body);
            }
        }
    }
}

/// Marks dynamic bodies that touch a moved one as moved too.
fn pass_on(scene: &Scene, facts: &[ContactFact], moved: &mut [bool]) {
    for fact in facts {
        if let [Party::Body(first), Party::Body(second)] = fact.parties {
            let either = moved[first] || moved[second];
            for body in [first, second] {
                moved[body] |= either && matches!(scene.bodies[body].kind, BodyKind::Free);
            }
        }
    }
}

/// A robot without shape or mass: the engine's world always has a robot.
fn nobody() -> Robot {
    let text = "format = 1\nname = 'nobody'\nlinks = [{ name = 'nobody' }]";
    let file = RobotFile::parse(Source::new("nobody", text));
    file.and_then(|file| file.build(&[]))
        .expect("one link is a robot")
}

fn com(body: &SceneBody, world_from_body: &Pose) -> Vector3<f64> {
    world_from_body
        .transform_point(&body.inertia.com_m.into())
        .coords
}

impl Falling {
    fn new(
        index: usize,
        body: &SceneBody,
        scene: &Scene,
        layout: &Layout,
        down: Option<Vector3<f64>>,
        budget: &mut WorkBudget,
    ) -> Self {
        let start_com = com(body, &body.world_from_body);
        let up = down.map_or_else(Vector3::z, |down| -down);
        let below = down.and_then(|down| layout.below(index, &start_com, &down, budget));
        // it starts inside something: an overlap, or a ring around a peg
        let below = below.filter(|(_, p_in_world)| *p_in_world != start_com);
        Self {
            body: index,
            start_com,
            up_in_body: body.world_from_body.inverse_transform_vector(&up),
            support: below.map(|(party, p_in_world)| {
                let p = match party {
                    Party::Body(index) => {
                        scene.bodies[index]
                            .world_from_body
                            .inverse_transform_point(&p_in_world.into())
                            .coords
                    }
                    Party::Ground | Party::Link(_) => p_in_world,
                };
                (party, p)
            }),
            supported: false,
            centres: layout.centres_of(index).collect(),
            lost: false,
        }
    }

    /// Takes the party that pushes it up as its support, even if its centre is beyond the edge.
    fn note_support(&mut self, facts: &[ContactFact], world: &World, down: &Vector3<f64>) {
        let me = Party::Body(self.body);
        for fact in facts {
            let [first, second] = fact.parties;
            let lift = -fact.normal_impulse_n_s.dot(down);
            let other = match (first == me, second == me) {
                (false, true) if lift > 0.0 => first,
                (true, false) if lift < 0.0 => second,
                _ => continue,
            };
            if self.supported || other == Party::Ground {
                continue;
            }
            let p_in_world = fact.p_centre_in_world;
            let p = match other {
                Party::Body(index) => {
                    let world_from_other = world.body(index).world_from_body;
                    world_from_other
                        .inverse_transform_point(&p_in_world.into())
                        .coords
                }
                Party::Ground | Party::Link(_) => p_in_world,
            };
            self.support = Some((other, p));
            self.supported = true;
        }
    }

    /// That it fell through something since the last check, if it did so for the first time.
    fn falls_through(
        &mut self,
        layout: &Layout,
        budget: &mut WorkBudget,
        time_s: f64,
    ) -> Option<Finding> {
        if self.lost {
            return None;
        }
        let through = self.entered(layout, budget)?;
        self.lost = true;
        Some(Finding {
            severity: Severity::Error,
            kind: Kind::FallsThrough {
                body: self.body,
                through,
                time_s,
            },
        })
    }

    /// What the centre of one of its shapes went into since the last check.
    fn entered(&mut self, layout: &Layout, budget: &mut WorkBudget) -> Option<Party> {
        let mut entered = None;
        for (last, now) in self.centres.iter_mut().zip(layout.centres_of(self.body)) {
            if (now - *last).norm() >= PIECE_M {
                entered = entered.or_else(|| layout.entered(self.body, last, &now, budget));
                *last = now;
            }
        }
        entered
    }

    fn judge(
        &self,
        ends: Ends<'_>,
        state: &BodyState,
        [bad, doubtful]: [Severity; 2],
        findings: &mut Vec<Finding>,
    ) {
        let Ends {
            scene,
            world,
            layout,
            budget,
        } = ends;
        let down = direction(scene.environment.gravity_m_s2);
        let body = self.body;
        let described = &scene.bodies[body];
        let mut report = |severity, kind| findings.push(Finding { severity, kind });
        let now = com(described, &state.world_from_body);
        let (speed_m_s, turning_rad_s) = (state.twist.linear.norm(), state.twist.angular.norm());
        if let Some(down) = down {
            let falls = !state.sleeps && state.twist.linear.dot(&down) > FALLING_M_S;
            if falls && layout.below(body, &now, &down, budget).is_none() {
                return report(Severity::Error, Kind::FallsForever { body });
            }
            if let Some((support, p)) = self.support
                && support != Party::Ground
            {
                let place = match support {
                    Party::Body(index) => {
                        let world_from_support = world.body(index).world_from_body;
                        world_from_support.transform_point(&p.into()).coords
                    }
                    Party::Ground | Party::Link(_) => p,
                };
                let below_m = (now - place).dot(&down);
                if below_m > 0.0 {
                    let kind = Kind::FallsOff {
                        body,
                        support,
                        below_m,
                    };
                    return report(bad, kind);
                }
            }
        }
        let rests = state.sleeps || (speed_m_s <= REST.0 && turning_rad_s <= REST.1);
        if !rests {
            report(
                doubtful,
                Kind::NeverRests {
                    body,
                    speed_m_s,
                    turning_rad_s,
                },
            );
        }
        let distance_m = (now - self.start_com).norm();
        let up = down.map_or_else(Vector3::z, |down| -down);
        let up_now = state.world_from_body.transform_vector(&self.up_in_body);
        let tilt_rad = libm::atan2(up.cross(&up_now).norm(), up.dot(&up_now));
        if !(distance_m <= MOVED_M && tilt_rad <= TILTED_RAD) {
            report(
                doubtful,
                Kind::Moves {
                    body,
                    distance_m,
                    tilt_rad,
                },
            );
        }
    }
}

/// Whether the scene itself makes this body move: by a prescribed motion, an initial velocity, or the wind.
fn is_moved(scene: &Scene, body: &SceneBody) -> bool {
    let still = Vector3::zeros();
    let thrown = body.twist.linear != still || body.twist.angular != still;
    let blown = body.drag.is_some() && scene.environment.wind.is_some();
    matches!(body.kind, BodyKind::Kinematic(_)) || thrown || blown
}
