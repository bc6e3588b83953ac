//! The impulses of one step: of contacts, joint limits, friction and rolling resistance together, by block Gauss-Seidel over patches.
//!
//! Two problems are solved with the same rows. *Places*: the least corrections after which no surfaces overlap at the end of the step.
//! They decide which points are in contact, and change positions alone, so that they bring no energy into velocities. *Speeds*: the
//! impulses after which no point in contact approaches, and friction opposes what still slides. Normal impulses are settled first, by
//! themselves, so that what lands evenly is not thrown aside by friction at the corner that happened to be first.
//!
//! Source: Moreau, *Unilateral contact and dry friction in finite freedom dynamics* (1988); places and speeds as separate constraints:
//! Gear, Leimkuhler & Gupta, *Automatic integration of Euler-Lagrange equations with constraints* (1985).

use std::ops::Range;

use super::disk;
use super::press::{self, press};
use super::rows::Rows;

/// Most sweeps over all patches in one of the problems.
const SWEEPS: usize = 100;
/// A sweep that changes no speed by more than this part of the fastest approach is the last.
const SETTLED: f64 = 1e-10;
/// Speeds below this are rounding \[m/s\].
const ROUNDING_M_S: f64 = 1e-14;
/// Gaps below this are rounding \[m\].
const ROUNDING_M: f64 = 1e-15;
/// Surfaces this near at the end of a step touch \[m\].
const TOUCHES_M: f64 = 1e-8;
/// Energy that contact may add, as a part of what it moves about: rounding.
const NO_GAIN: f64 = 1e-12;
/// Halvings of the restitutions of a step in which they would add energy.
const HALVINGS: usize = 6;

/// A contact point, or a joint at its limit.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Point {
    pub(super) normal: usize,
    /// Rows along the two tangents; there are none where nothing rubs.
    pub(super) tangents: Option<[usize; 2]>,
    pub(super) friction: f64,
    /// Gap at the end of the step if only what is driven moved \[m\].
    pub(super) gap_m: f64,
    /// Gap that the end of the step should have at least \[m\].
    pub(super) least_gap_m: f64,
    pub(super) restitution: f64,
    /// Speed with which the point should leave at least, by its restitution \[m/s\].
    pub(super) bounce_m_s: f64,
    /// Whether it is in contact at the end of the step.
    pub(super) touches: bool,
    /// Correction of the place \[kg m\].
    pub(super) place: f64,
    /// Impulse along the normal \[N s\].
    pub(super) impulse: f64,
    /// Impulses along the tangents \[N s\].
    pub(super) rubbed: [f64; 2],
    /// Softness along the tangents, a symmetric matrix.
    pub(super) soft: [f64; 3],
}

/// Points that are settled together.
#[derive(Debug, Clone)]
pub(super) struct Patch {
    pub(super) points: Range<usize>,
    /// Resistance against rolling: the angular rows across the normal, and the lever arm of the normal force \[m\].
    pub(super) rolling: Option<Rolling>,
    /// Where its matrix starts.
    block: usize,
}

#[derive(Debug, Clone, Copy)]
pub(super) struct Rolling {
    pub(super) rows: [usize; 2],
    pub(super) arm_m: f64,
    pub(super) impulse: [f64; 2],
    pub(super) soft: [f64; 3],
}

impl Rolling {
    pub(super) fn new(rows: [usize; 2], arm_m: f64) -> Self {
        Self {
            rows,
            arm_m,
            impulse: [0.0; 2],
            soft: [0.0; 3],
        }
    }
}

/// Dry friction of a joint.
#[derive(Debug, Clone, Copy)]
pub(super) struct JointFriction {
    pub(super) row: usize,
    /// The joint, by its place in `q`.
    pub(super) joint: usize,
    /// Its greatest impulse in a step, in the positive and the negative direction \[N m s or N s\].
    pub(super) most: [f64; 2],
    pub(super) impulse: f64,
}

/// All constraints of one step.
#[derive(Debug, Clone, Default)]
pub(super) struct Constraints {
    pub(super) rows: Rows,
    pub(super) points: Vec<Point>,
    pub(super) patches: Vec<Patch>,
    pub(super) frictions: Vec<JointFriction>,
    /// Softness of the normals of each patch.
    blocks: Vec<f64>,
    /// Visits of points so far.
    visits: u64,
}

/// Which of the two problems a sweep works on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Problem {
    Places,
    Speeds,
}

impl Constraints {
    pub(super) fn clear(&mut self) {
        self.rows.clear();
        self.points.clear();
        self.patches.clear();
        self.frictions.clear();
        self.blocks.clear();
    }

    /// Adds the points from `first` on as patches.
    pub(super) fn add_patches(&mut self, first: usize, rolling: Option<Rolling>) {
        let mut from = first;
        let mut rolling = rolling;
        while from < self.points.len() {
            let to = self.points.len().min(from + press::MOST);
            self.patches.push(Patch {
                points: from..to,
                rolling: rolling.take(),
                block: 0,
            });
            from = to;
        }
    }

    /// Visits of points since the last call: what settling costs.
    pub(super) fn take_visits(&mut self) -> u64 {
        std::mem::take(&mut self.visits)
    }

    /// Computes what does not change while the step is settled; the rows know their responses.
    pub(super) fn prepare(&mut self) {
        self.blocks.clear();
        let rows = &self.rows;
        for patch in &mut self.patches {
            patch.block = self.blocks.len();
            for i in patch.points.clone() {
                for j in patch.points.clone() {
                    let (a, b) = (self.points[i].normal, self.points[j].normal);
                    let known = self.blocks.len();
                    let m = patch.points.len();
                    let (row, column) = (i - patch.points.start, j - patch.points.start);
                    // symmetric
                    let entry = if column < row {
                        self.blocks[known - (row - column) * (m - 1)]
                    } else {
                        rows.coupling(a, b)
                    };
                    self.blocks.push(entry);
                }
                if let Some(tangents) = self.points[i].tangents {
                    self.points[i].soft = softness(rows, tangents);
                }
            }
            if let Some(rolling) = &mut patch.rolling {
                rolling.soft = softness(rows, rolling.rows);
            }
        }
    }

    /// Finds the corrections of places after which nothing overlaps, adds them to `displacement`, and notes which points touch.
    pub(super) fn find_touches(&mut self, displacement: &mut [f64]) {
        for point in &mut self.points {
            point.touches = true;
            self.rows.push(point.normal, point.place, displacement);
        }
        self.settle_normals(Problem::Places, displacement, 0.0);
        for point in &mut self.points {
            let gap = point.gap_m + self.rows.along(point.normal, displacement);
            point.touches = point.place > 0.0 || gap <= point.least_gap_m + TOUCHES_M;
            if !point.touches {
                (point.impulse, point.rubbed) = (0.0, [0.0; 2]);
            }
        }
    }

    /// Whether any point touches.
    pub(super) fn any_touches(&self) -> bool {
        self.points.iter().any(|point| point.touches)
    }

    /// Moves `displacement`, in which each impulse acted for `after_s`, to where nothing overlaps.
    pub(super) fn correct_places(&mut self, displacement: &mut [f64], after_s: f64) {
        for point in &mut self.points {
            // what the impulse did already is part of the place
            let done = point.impulse * after_s;
            if !point.touches {
                self.rows.push(point.normal, point.place, displacement);
            } else {
                point.place = done;
            }
        }
        self.settle_normals(Problem::Places, displacement, 0.0);
    }

    /// Finds the impulses, starting from those that the points have, and adds their effect to `velocities`.
    pub(super) fn settle(&mut self, velocities: &mut [f64]) {
        let free = velocities.to_vec();
        let mut bounce = 1.0;
        let bounces = self.points.iter().any(|point| point.bounce_m_s > 0.0);
        for halving in 0..=HALVINGS {
            self.settle_once(velocities, bounce);
            // Newton's law of restitution may ask for more energy than friction left
            if !bounces || !self.gains(&free, velocities) {
                break;
            }
            bounce = if halving + 1 < HALVINGS {
                bounce * 0.5
            } else {
                0.0
            };
            velocities.copy_from_slice(&free);
        }
    }

    fn settle_once(&mut self, velocities: &mut [f64], bounce: f64) {
        let mut fastest = 0.0_f64;
        for point in self.points.iter().filter(|point| point.touches) {
            fastest = fastest.max(self.rows.speed(point.normal, velocities).abs());
            if point.friction > 0.0
                && let Some([first, second]) = point.tangents
            {
                let along = [first, second].map(|row| self.rows.speed(row, velocities));
                fastest = fastest.max(along[0].abs()).max(along[1].abs());
            }
        }
        for point in self.points.iter().filter(|point| point.touches) {
            self.rows.push(point.normal, point.impulse, velocities);
            if let Some(tangents) = point.tangents {
                for (row, impulse) in tangents.into_iter().zip(point.rubbed) {
                    self.rows.push(row, impulse, velocities);
                }
            }
        }
        for patch in &self.patches {
            if let Some(rolling) = patch.rolling {
                for (row, impulse) in rolling.rows.into_iter().zip(rolling.impulse) {
                    self.rows.push(row, impulse, velocities);
                }
            }
        }
        for friction in &self.frictions {
            self.rows.push(friction.row, friction.impulse, velocities);
        }
        let settled = ROUNDING_M_S + SETTLED * fastest;
        self.settle_normals(Problem::Speeds, velocities, bounce);
        if self.is_smooth() {
            return;
        }
        for sweep in 0..SWEEPS {
            let mut changed = 0.0_f64;
            for turn in 0..self.patches.len() {
                let index = match sweep % 2 {
                    0 => turn,
                    _ => self.patches.len() - 1 - turn,
                };
                changed = changed.max(self.rub(index, velocities));
                changed = changed.max(self.roll(index, velocities));
                changed =
                    changed.max(self.press(index, Problem::Speeds, velocities, bounce, false));
            }
            changed = changed.max(self.brake_joints(velocities));
            if changed <= settled {
                break;
            }
        }
    }

    /// Whether nothing rubs.
    fn is_smooth(&self) -> bool {
        let rubs =
            |point: &Point| point.touches && point.friction > 0.0 && point.tangents.is_some();
        self.frictions.is_empty()
            && !self.points.iter().any(rubs)
            && self.patches.iter().all(|patch| patch.rolling.is_none())
    }

    /// Whether the impulses bring energy into what they act on: their work is that at the mean of the speeds before and after.
    fn gains(&self, free: &[f64], velocities: &[f64]) -> bool {
        let (mut work, mut turnover) = (0.0, 0.0);
        let mut add = |row: usize, impulse: f64| {
            let speeds = [free, velocities].map(|velocities| self.rows.speed(row, velocities));
            work += 0.5 * impulse * (speeds[0] + speeds[1]);
            turnover += impulse.abs() * (speeds[0].abs() + speeds[1].abs());
        };
        for point in &self.points {
            add(point.normal, point.impulse);
            if let Some(tangents) = point.tangents {
                add(tangents[0], point.rubbed[0]);
                add(tangents[1], point.rubbed[1]);
            }
        }
        for rolling in self.patches.iter().filter_map(|patch| patch.rolling) {
            add(rolling.rows[0], rolling.impulse[0]);
            add(rolling.rows[1], rolling.impulse[1]);
        }
        for friction in &self.frictions {
            add(friction.row, friction.impulse);
        }
        work > NO_GAIN * turnover
    }

    fn settle_normals(&mut self, problem: Problem, values: &mut [f64], bounce: f64) {
        let mut fastest = 0.0_f64;
        for point in self.points.iter().filter(|point| point.touches) {
            let value = match problem {
                Problem::Places => point.place * self.rows.softness(point.normal),
                Problem::Speeds => self.rows.speed(point.normal, values),
            };
            fastest = fastest.max(value.abs());
        }
        for sweep in 0..SWEEPS {
            let mut changed = 0.0_f64;
            for turn in 0..self.patches.len() {
                // to and fro: what is on top must reach the bottom, and the bottom the top
                let index = match sweep % 2 {
                    0 => turn,
                    _ => self.patches.len() - 1 - turn,
                };
                let change = if sweep == 0 {
                    let even = self.press(index, problem, values, bounce, true);
                    even.max(self.press(index, problem, values, bounce, false))
                } else {
                    self.press(index, problem, values, bounce, false)
                };
                changed = changed.max(change);
                if problem == Problem::Places {
                    fastest = fastest.max(change);
                }
            }
            let rounding = match problem {
                Problem::Places => ROUNDING_M,
                Problem::Speeds => ROUNDING_M_S,
            };
            if changed <= rounding + SETTLED * fastest || self.patches.len() == 1 {
                break;
            }
        }
    }

    /// Settles the normals of a patch; returns the greatest change of a speed or gap.
    // long: gathers the block, solves it and spreads the result; each half needs the arrays of the other
    fn press(
        &mut self,
        index: usize,
        problem: Problem,
        values: &mut [f64],
        bounce: f64,
        evenly: bool,
    ) -> f64 {
        let patch = &self.patches[index];
        let count = patch.points.len();
        let block = &self.blocks[patch.block..patch.block + count * count];
        let mut chosen = [0; press::MOST];
        let mut m = 0;
        for i in 0..count {
            if self.points[patch.points.start + i].touches {
                chosen[m] = i;
                m += 1;
            }
        }
        if m == 0 {
            return 0.0;
        }
        self.visits += m as u64;
        let mut matrix = [0.0; press::MOST * press::MOST];
        let mut p = [0.0; press::MOST];
        let mut offset = [0.0; press::MOST];
        let mut most = 0.0_f64;
        for (a, i) in chosen[..m].iter().enumerate() {
            most = most.max(block[i * count + i]);
            for (b, j) in chosen[..m].iter().enumerate() {
                matrix[a * m + b] = block[i * count + j];
            }
        }
        if most <= 0.0 {
            return 0.0;
        }
        let mut scale = 0.0_f64;
        for (a, i) in chosen[..m].iter().enumerate() {
            let point = &self.points[patch.points.start + i];
            (offset[a], p[a]) = match problem {
                Problem::Places => (
                    point.gap_m - point.least_gap_m + self.rows.along(point.normal, values),
                    point.place,
                ),
                Problem::Speeds => (
                    self.rows.speed(point.normal, values) - bounce * point.bounce_m_s,
                    point.impulse,
                ),
            };
            scale = scale.max(offset[a].abs());
        }
        for a in 0..m {
            // at first the softness pulls all impulses of the patch towards zero, afterwards towards what they are
            if !evenly {
                matrix[a * m + a] += press::SOFT * most;
            }
            let row = &matrix[a * m..(a + 1) * m];
            offset[a] -= row.iter().zip(&p[..m]).map(|(n, p)| n * p).sum::<f64>();
            if evenly {
                matrix[a * m + a] += press::SOFT * most;
            }
        }
        let before = p;
        press(&matrix[..m * m], &offset[..m], &mut p[..m], 1e-14 * scale);
        let mut changed = 0.0_f64;
        for (a, i) in chosen[..m].iter().enumerate() {
            let point = &mut self.points[patch.points.start + i];
            let change = p[a] - before[a];
            match problem {
                Problem::Places => point.place = p[a],
                Problem::Speeds => point.impulse = p[a],
            }
            if change != 0.0 {
                self.rows.push(point.normal, change, values);
                let effect: f64 = (0..m)
                    .map(|b| block[i * count + chosen[b]] * (p[b] - before[b]))
                    .sum();
                changed = changed.max(effect.abs());
            }
        }
        changed
    }

    /// Friction at the points of a patch, for their present normal impulses; returns the greatest change of a speed.
    fn rub(&mut self, index: usize, velocities: &mut [f64]) -> f64 {
        let mut changed = 0.0_f64;
        for i in self.patches[index].points.clone() {
            let point = &mut self.points[i];
            let (true, Some(tangents)) = (point.touches && point.friction > 0.0, point.tangents)
            else {
                continue;
            };
            let most = point.friction * point.impulse;
            if most <= 0.0 && point.rubbed.iter().all(|x| *x == 0.0) {
                continue;
            }
            self.visits += 1;
            let change = slide(
                &self.rows,
                tangents,
                point.soft,
                most,
                &mut point.rubbed,
                velocities,
            );
            changed = changed.max(change);
        }
        changed
    }

    /// Resistance against rolling of a patch; returns the greatest change of a speed of its rim.
    fn roll(&mut self, index: usize, velocities: &mut [f64]) -> f64 {
        let patch = &mut self.patches[index];
        let Some(rolling) = &mut patch.rolling else {
            return 0.0;
        };
        let points = &self.points[patch.points.clone()];
        let pressed: f64 = points.iter().map(|point| point.impulse).sum();
        let most = rolling.arm_m * pressed;
        if most <= 0.0 && rolling.impulse.iter().all(|x| *x == 0.0) {
            return 0.0;
        }
        self.visits += 1;
        let change = slide(
            &self.rows,
            rolling.rows,
            rolling.soft,
            most,
            &mut rolling.impulse,
            velocities,
        );
        change * rolling.arm_m
    }

    fn brake_joints(&mut self, velocities: &mut [f64]) -> f64 {
        let mut changed = 0.0_f64;
        for friction in &mut self.frictions {
            let softness = self.rows.softness(friction.row);
            if softness <= 0.0 {
                continue;
            }
            let speed = self.rows.speed(friction.row, velocities);
            let wanted = friction.impulse - speed / softness;
            // opposes motion in the positive direction with a negative impulse
            let next = wanted.clamp(-friction.most[0], friction.most[1]);
            let change = next - friction.impulse;
            friction.impulse = next;
            self.visits += 1;
            if change != 0.0 {
                self.rows.push(friction.row, change, velocities);
                changed = changed.max((change * softness).abs());
            }
        }
        changed
    }
}

fn softness(rows: &Rows, [first, second]: [usize; 2]) -> [f64; 3] {
    [
        rows.softness(first),
        rows.coupling(first, second),
        rows.softness(second),
    ]
}

/// Finds the impulse along two rows, at most `most`, that leaves them the least energy; returns the change of the speed.
fn slide(
    rows: &Rows,
    pair: [usize; 2],
    soft: [f64; 3],
    most: f64,
    impulse: &mut [f64; 2],
    velocities: &mut [f64],
) -> f64 {
    let [a, b, d] = soft;
    let [x, y] = *impulse;
    let speeds = pair.map(|row| rows.speed(row, velocities));
    let without = [speeds[0] - a * x - b * y, speeds[1] - b * x - d * y];
    let next = disk::friction(soft, without, most);
    let change = [next[0] - x, next[1] - y];
    *impulse = next;
    for (row, change) in pair.into_iter().zip(change) {
        if change != 0.0 {
            rows.push(row, change, velocities);
        }
    }
    let effect = [a * change[0] + b * change[1], b * change[0] + d * change[1]];
    effect[0].abs().max(effect[1].abs())
}
