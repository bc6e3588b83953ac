//! Via points: is each reachable without collision, and can the TCP follow the straight line from one to the next?

use nalgebra::Vector3;

use super::checks::{TOUCH_M, Work, not_checked};
use super::finding::{Finding, Kind, LineStop, LineStopCause, Severity, Unchecked};
use super::progress::{Progress, Stage, Watch};
use crate::engine::{Layout, Overlap, WorkBudget};
use crate::kinematics::branches::{BranchFinder, Reach};
use crate::kinematics::{FramePoses, IkError};
use crate::model::contact::Party;
use crate::model::robot::Robot;
use crate::model::scene::{BodyKind, Scene};

/// Distance between the samples of a line \[m\] ...
const SAMPLE_M: f64 = 0.01;
/// ... unless there were more of them than this.
const MOST_SAMPLES: f64 = 10_000.0;
/// Near a singular configuration joints move far: a piece is halved this often before the branch counts as changed.
const HALVINGS: u32 = 6;
/// What looking for a configuration costs for each joint, in the units of a [`WorkBudget`].
const SOLVE: u64 = 2_000;
/// A joint that moves farther than this between two samples has changed its branch \[rad\], \[m\].
const JUMP: (f64, f64) = (0.5, 0.1);

/// Checks all via points of `work`, and then the lines between those that are reachable, until the work is too much.
pub(super) fn check(
    scene: &Scene,
    work: &Work<'_>,
    layout: &mut Layout,
    findings: &mut Vec<Finding>,
    watch: Watch<'_>,
    budget: WorkBudget,
) -> Result<(), IkError> {
    if work.via_in_world.is_empty() {
        return Ok(());
    }
    let points = work.via_in_world.len();
    let mut at = |done: usize| {
        watch(Progress {
            stage: Stage::Via,
            done: done as u64,
            of: (2 * points - 1) as u64,
        });
    };
    let mut follower = Follower {
        scene,
        robot: work.robot,
        finder: BranchFinder::new(work.robot, &work.start_q)?,
        poses: FramePoses::new(work.robot),
        layout,
        budget,
    };
    let mut usable: Vec<Option<Vec<Vec<f64>>>> = Vec::new();
    for (point, p_in_world) in work.via_in_world.iter().enumerate() {
        at(point);
        let before = findings.len();
        let found = follower.point(point, p_in_world, findings)?;
        if follower.is_spent() {
            // what was found of it is not the whole of it
            findings.truncate(before);
            findings.push(not_checked(Unchecked::ViaFrom(point)));
            return Ok(());
        }
        usable.push(found);
    }
    for (from, pair) in work.via_in_world.windows(2).enumerate() {
        at(points + from);
        let before = findings.len();
        if let [Some(branches), Some(_)] = &usable[from..from + 2] {
            let blocked = if work.in_straight_lines {
                Severity::Error
            } else {
                Severity::Warning
            };
            follower.line(from, &pair[0], &pair[1], branches, blocked, findings)?;
        }
        if follower.is_spent() {
            findings.truncate(before);
            findings.push(not_checked(Unchecked::LinesFrom(from)));
            return Ok(());
        }
    }
    Ok(())
}

/// What the robot collides with in one configuration.
struct Collisions {
    /// The deepest overlap with something that cannot move.
    deepest: Option<Overlap>,
    /// Dynamic bodies that it touches.
    touched: Vec<usize>,
}

struct Follower<'a> {
    scene: &'a Scene,
    robot: &'a Robot,
    finder: BranchFinder<'a>,
    poses: FramePoses,
    layout: &'a mut Layout,
    budget: WorkBudget,
}

impl Follower<'_> {
    /// Whether the work so far is too much.
    fn is_spent(&mut self) -> bool {
        let solved = std::mem::take(&mut self.finder.solved);
        self.budget.spend(solved * SOLVE * self.robot.n() as u64);
        self.budget.is_spent()
    }

    fn collisions_at(&mut self, q: &[f64]) -> Collisions {
        self.poses.update(self.robot, q);
        self.layout.place_robot(self.robot, &self.poses);
        let mut collisions = Collisions {
            deepest: None,
            touched: Vec::new(),
        };
        for overlap in self.layout.of_links(TOUCH_M, &mut self.budget) {
            let [Party::Link(link), other] = overlap.parties else {
                continue;
            };
            // a link that no joint moves was reported at the start
            if self.robot.links()[link].attachment.body.is_none() {
                continue;
            }
            match other {
                Party::Body(index) if matches!(self.scene.bodies[index].kind, BodyKind::Free) => {
                    collisions.touched.push(index);
                }
                _ => {
                    let is_deeper = collisions
                        .deepest
                        .is_none_or(|c| overlap.depth_m > c.depth_m);
                    if is_deeper {
                        collisions.deepest = Some(overlap);
                    }
                }
            }
        }
        collisions
    }

    /// The branches of a via point, unless it is unreachable or all of them collide.
    fn point(
        &mut self,
        point: usize,
        p_in_world: &Vector3<f64>,
        findings: &mut Vec<Finding>,
    ) -> Result<Option<Vec<Vec<f64>>>, IkError> {
        let mut report = |severity, kind| findings.push(Finding { severity, kind });
        let found = match self.finder.reach(p_in_world)? {
            Reach::In(found) => found,
            Reach::Not { residual_m, .. } => {
                let kind = Kind::ViaUnreachable { point, residual_m };
                report(Severity::Error, kind);
                return Ok(None);
            }
        };
        let branches = found.len();
        let mut shallowest: Option<Overlap> = None;
        let (mut colliding, mut touching) = (0, 0);
        let mut bodies = Vec::new();
        for q in &found {
            let collisions = self.collisions_at(q);
            if let Some(overlap) = collisions.deepest {
                colliding += 1;
                if shallowest.is_none_or(|s| overlap.depth_m < s.depth_m) {
                    shallowest = Some(overlap);
                }
            } else if !collisions.touched.is_empty() {
                touching += 1;
                bodies.extend(collisions.touched);
            }
        }
        let all = colliding == branches;
        if let Some(overlap) = shallowest {
            let severity = if all { Severity::Error } else { Severity::Note };
            let kind = Kind::ViaCollides {
                point,
                branches,
                colliding,
                overlap,
            };
            report(severity, kind);
        }
        if touching > 0 {
            let kind = Kind::ViaTouches {
                point,
                branches,
                touching,
                bodies: each_once(bodies),
            };
            report(Severity::Note, kind);
        }
        Ok((!all).then_some(found))
    }

    /// Follows the straight line from every branch of its first point.
    fn line(
        &mut self,
        from: usize,
        p_from: &Vector3<f64>,
        p_to: &Vector3<f64>,
        branches: &[Vec<f64>],
        all_blocked: Severity,
        findings: &mut Vec<Finding>,
    ) -> Result<(), IkError> {
        let mut farthest: Option<LineStop> = None;
        let (mut blocked, mut touching) = (0, 0);
        let mut bodies = Vec::new();
        for q in branches {
            let (stop, touched) = self.follow(q, p_from, p_to)?;
            if let Some(stop) = stop {
                blocked += 1;
                if farthest.is_none_or(|f| stop.along_m > f.along_m) {
                    farthest = Some(stop);
                }
            } else if !touched.is_empty() {
                touching += 1;
                bodies.extend(touched);
            }
        }
        let mut report = |severity, kind| findings.push(Finding { severity, kind });
        if let Some(stop) = farthest {
            let severity = if blocked == branches.len() {
                all_blocked
            } else {
                Severity::Note
            };
            let kind = Kind::LineBlocked {
                from,
                branches: branches.len(),
                blocked,
                stop,
            };
            report(severity, kind);
        }
        if touching > 0 {
            let kind = Kind::LineTouches {
                from,
                branches: branches.len(),
                touching,
                bodies: each_once(bodies),
            };
            report(Severity::Note, kind);
        }
        Ok(())
    }

    /// Follows the line from `q`: where the robot stops, if it does, and the dynamic bodies it touches before that.
    fn follow(
        &mut self,
        q: &[f64],
        p_from: &Vector3<f64>,
        p_to: &Vector3<f64>,
    ) -> Result<(Option<LineStop>, Vec<usize>), IkError> {
        let length_m = (p_to - p_from).norm();
        let pieces = (length_m / SAMPLE_M).ceil().clamp(1.0, MOST_SAMPLES);
        let at = |part: f64| p_from + (p_to - p_from) * part;
        let mut q = q.to_vec();
        let mut touched = Vec::new();
        for sample in 0..=pieces as usize {
            // then nothing of the line counts
            if self.is_spent() {
                break;
            }
            let part = sample as f64 / pieces;
            let before = (part - 1.0 / pieces).max(0.0);
            let mut cause = self.go(&mut q, &at(before), &at(part), HALVINGS)?;
            if cause.is_none() {
                let collisions = self.collisions_at(&q);
                cause = collisions.deepest.map(LineStopCause::Collides);
                touched.extend(collisions.touched);
                touched = each_once(touched);
            }
            if let Some(cause) = cause {
                let stop = LineStop {
                    along_m: part * length_m,
                    p_in_world: at(part),
                    cause,
                };
                return Ok((Some(stop), touched));
            }
        }
        Ok((None, touched))
    }

    /// Moves `q`, at which the TCP is at `p_from`, until the TCP is at `p_to`; where joints move far, the piece is halved up to
    /// `halvings` times. Returns what prevents it, if anything does.
    fn go(
        &mut self,
        q: &mut Vec<f64>,
        p_from: &Vector3<f64>,
        p_to: &Vector3<f64>,
        halvings: u32,
    ) -> Result<Option<LineStopCause>, IkError> {
        let next = match self.finder.follow(q, p_to)? {
            Ok(next) => next,
            Err(residual_m) => return Ok(Some(LineStopCause::OutOfReach { residual_m })),
        };
        let jump = self.jump(q, &next);
        if jump.is_none() {
            *q = next;
            return Ok(None);
        }
        if halvings == 0 {
            return Ok(jump);
        }
        let middle = (p_from + p_to) * 0.5;
        match self.go(q, p_from, &middle, halvings - 1)? {
            None => self.go(q, &middle, p_to, halvings - 1),
            stopped => Ok(stopped),
        }
    }

    fn jump(&self, q: &[f64], next: &[f64]) -> Option<LineStopCause> {
        let mut farthest = None;
        let mut most_times = 1.0;
        for (joint, (q, next)) in q.iter().zip(next).enumerate() {
            let by = (next - q).abs();
            let allowed = if self.finder.turns(joint) {
                JUMP.0
            } else {
                JUMP.1
            };
            if by / allowed > most_times {
                most_times = by / allowed;
                farthest = Some(LineStopCause::Jumps { joint, by });
            }
        }
        farthest
    }
}

fn each_once(mut bodies: Vec<usize>) -> Vec<usize> {
    bodies.sort_unstable();
    bodies.dedup();
    bodies
}
