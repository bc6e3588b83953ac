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

use super::anderson::Anderson;
use super::disk::Response;
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
    /// What the tangents answer to impulses along them.
    pub(super) across: Response,
    /// Where the last search for friction at its limit ended.
    pub(super) edge: f64,
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
    impulse: [f64; 2],
    across: Response,
    edge: f64,
}

impl Rolling {
    pub(super) fn new(rows: [usize; 2], arm_m: f64) -> Self {
        Self {
            rows,
            arm_m,
            impulse: [0.0; 2],
            across: Response::default(),
            edge: 0.0,
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
    acceleration: Acceleration,
    /// Visits of points so far.
    visits: u64,
}

/// All impulses of one step as a list, and how they are extrapolated.
#[derive(Debug, Clone, Default)]
struct Acceleration {
    anderson: Anderson,
    impulses: Vec<f64>,
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
                    self.points[i].across = response(rows, tangents);
                }
            }
            if let Some(rolling) = &mut patch.rolling {
                rolling.across = response(rows, rolling.rows);
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
        if !self.points.iter().any(|point| point.bounce_m_s > 0.0) {
            self.settle_once(velocities, 1.0);
            return;
        }
        let free = velocities.to_vec();
        let mut bounce = 1.0;
        for halving in 0..=HALVINGS {
            self.settle_once(velocities, bounce);
            // Newton's law of restitution may ask for more energy than friction left
            if !self.gains(&free, velocities) {
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
        let round = if self.goes_to_and_fro() { 2 } else { 1 };
        self.acceleration.anderson.start(velocities);
        for sweep in 0..SWEEPS {
            let mut changed = 0.0_f64;
            for turn in 0..self.patches.len() {
                let index = self.in_turn(sweep, turn);
                changed = changed.max(self.rub(index, velocities));
                changed = changed.max(self.roll(index, velocities));
                changed =
                    changed.max(self.press(index, Problem::Speeds, velocities, bounce, false));
            }
            changed = changed.max(self.brake_joints(velocities));
            if changed <= settled {
                break;
            }
            if (sweep + 1) % round == 0 {
                self.accelerate(velocities);
            }
        }
    }

    /// Whether every second sweep goes back: what is on top must reach the bottom, and the bottom the top. Two patches are in turn either
    /// way, and back and forth would only visit each twice.
    fn goes_to_and_fro(&self) -> bool {
        self.patches.len() > 2
    }

    /// The patch that a sweep visits after `turn` others.
    fn in_turn(&self, sweep: usize, turn: usize) -> usize {
        if self.goes_to_and_fro() && sweep % 2 == 1 {
            self.patches.len() - 1 - turn
        } else {
            turn
        }
    }

    /// Moves all impulses on to where the sweeps tend, unless a surface would pull.
    fn accelerate(&mut self, velocities: &mut [f64]) {
        let Acceleration { anderson, impulses } = &mut self.acceleration;
        list_impulses(&self.points, &self.patches, &self.frictions, impulses);
        let points = &self.points;
        let allows = |list: &[f64]| {
            let mut list = list.iter();
            points.iter().all(|point| {
                let impulse = list.next().copied().unwrap_or(0.0);
                if point.tangents.is_some() {
                    list.nth(1);
                }
                impulse >= 0.0
            })
        };
        if !anderson.next(impulses, velocities, allows) {
            return;
        }
        let mut list = impulses.iter().copied();
        let mut take = |impulse: &mut f64| {
            if let Some(next) = list.next() {
                *impulse = next;
            }
        };
        for point in &mut self.points {
            take(&mut point.impulse);
            if point.tangents.is_some() {
                point.rubbed.iter_mut().for_each(&mut take);
            }
        }
        let rolling = self
            .patches
            .iter_mut()
            .filter_map(|patch| patch.rolling.as_mut());
        rolling.for_each(|rolling| rolling.impulse.iter_mut().for_each(&mut take));
        for friction in &mut self.frictions {
            take(&mut friction.impulse);
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
                let index = self.in_turn(sweep, turn);
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
    fn press(
        &mut self,
        index: usize,
        problem: Problem,
        values: &mut [f64],
        bounce: f64,
        evenly: bool,
    ) -> f64 {
        let points = self.patches[index].points.clone();
        let mut chosen = [0; press::MOST];
        let mut m = 0;
        for i in points {
            if self.points[i].touches {
                chosen[m] = i;
                m += 1;
            }
        }
        self.visits += m as u64;
        let task = (problem, bounce, evenly);
        // the size is known to the compiler: most patches have one, two or four points
        match m {
            0 => 0.0,
            1 => self.press_first::<1>(index, &chosen, task, values),
            2 => self.press_first::<2>(index, &chosen, task, values),
            3 => self.press_first::<3>(index, &chosen, task, values),
            4 => self.press_first::<4>(index, &chosen, task, values),
            5 => self.press_first::<5>(index, &chosen, task, values),
            6 => self.press_first::<6>(index, &chosen, task, values),
            7 => self.press_first::<7>(index, &chosen, task, values),
            _ => self.press_first::<{ press::MOST }>(index, &chosen, task, values),
        }
    }

    /// Settles the normals of the first `M` of these points of a patch.
    fn press_first<const M: usize>(
        &mut self,
        index: usize,
        chosen: &[usize; press::MOST],
        (problem, bounce, evenly): (Problem, f64, bool),
        values: &mut [f64],
    ) -> f64 {
        let chosen: [usize; M] = std::array::from_fn(|a| chosen[a]);
        let patch = &self.patches[index];
        let (first, count) = (patch.points.start, patch.points.len());
        let block = &self.blocks[patch.block..patch.block + count * count];
        let block = chosen.map(|i| chosen.map(|j| block[(i - first) * count + j - first]));
        let most = (0..M).map(|a| block[a][a]).fold(0.0, f64::max);
        if most <= 0.0 {
            return 0.0;
        }
        let mut p = [0.0; M];
        let mut offset = [0.0; M];
        let mut scale = 0.0_f64;
        for (a, i) in chosen.into_iter().enumerate() {
            let point = &self.points[i];
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
        let mut softened = block;
        for a in 0..M {
            softened[a][a] += press::SOFT * most;
            // at first the softness pulls all impulses of the patch towards zero, afterwards towards what they are
            let known = if evenly { &block[a] } else { &softened[a] };
            offset[a] -= known.iter().zip(&p).map(|(n, p)| n * p).sum::<f64>();
        }
        let before = p;
        press(&softened, &offset, &mut p, 1e-14 * scale);
        let change: [f64; M] = std::array::from_fn(|a| p[a] - before[a]);
        let mut changed = 0.0_f64;
        for (a, i) in chosen.into_iter().enumerate() {
            let point = &mut self.points[i];
            match problem {
                Problem::Places => point.place = p[a],
                Problem::Speeds => point.impulse = p[a],
            }
            if change[a] != 0.0 {
                self.rows.push(point.normal, change[a], values);
                let effect: f64 = block[a].iter().zip(&change).map(|(n, p)| n * p).sum();
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
                &point.across,
                most,
                (&mut point.rubbed, &mut point.edge),
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
            &rolling.across,
            most,
            (&mut rolling.impulse, &mut rolling.edge),
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

/// Writes all impulses, those of points first.
fn list_impulses(
    points: &[Point],
    patches: &[Patch],
    frictions: &[JointFriction],
    list: &mut Vec<f64>,
) {
    list.clear();
    for point in points {
        list.push(point.impulse);
        if point.tangents.is_some() {
            list.extend(point.rubbed);
        }
    }
    for rolling in patches.iter().filter_map(|patch| patch.rolling) {
        list.extend(rolling.impulse);
    }
    list.extend(frictions.iter().map(|friction| friction.impulse));
}

fn response(rows: &Rows, [first, second]: [usize; 2]) -> Response {
    Response::new([
        rows.softness(first),
        rows.coupling(first, second),
        rows.softness(second),
    ])
}

/// Finds the impulse along two rows, at most `most`, that leaves them the least energy; returns the change of the speed.
fn slide(
    rows: &Rows,
    pair: [usize; 2],
    across: &Response,
    most: f64,
    (impulse, edge): (&mut [f64; 2], &mut f64),
    velocities: &mut [f64],
) -> f64 {
    let was = *impulse;
    let done = across.times(was);
    let without = [0, 1].map(|i| rows.speed(pair[i], velocities) - done[i]);
    *impulse = across.friction(without, most, edge);
    let change = [impulse[0] - was[0], impulse[1] - was[1]];
    for (row, change) in pair.into_iter().zip(change) {
        if change != 0.0 {
            rows.push(row, change, velocities);
        }
    }
    let effect = across.times(change);
    effect[0].abs().max(effect[1].abs())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::engine::rows::PART;

    /// A column of blocks of different masses on the ground, each of which slides over the one below; all fall with 1 m/s.
    fn column(blocks: usize) -> (Constraints, Vec<f64>) {
        let mut constraints = Constraints::default();
        let mut velocities = vec![0.0; blocks * PART];
        for upper in 0..blocks {
            let speeds = &mut velocities[upper * PART..][..3];
            speeds.copy_from_slice(&[upper as f64, 1.0 - upper as f64 * 0.3, -1.0]);
            let mut row = |axis: usize| {
                let rows = &mut constraints.rows;
                let index = rows.start(0.0);
                let mut jacobian = [0.0; PART];
                for (block, sign) in [(upper.checked_sub(1), -1.0), (Some(upper), 1.0)] {
                    jacobian[axis] = sign;
                    if let Some(block) = block {
                        rows.add(block * PART, &jacobian);
                    }
                }
                index
            };
            let point = Point {
                normal: row(2),
                tangents: Some([row(0), row(1)]),
                friction: 0.4,
                touches: true,
                ..Point::default()
            };
            constraints.points.push(point);
            constraints.add_patches(upper, None);
        }
        constraints.rows.respond(|at, jacobian, response| {
            let per_mass = 1.0 / (1.0 + (at / PART % 3) as f64);
            for (response, jacobian) in response.iter_mut().zip(jacobian) {
                *response = jacobian * per_mass;
            }
        });
        constraints.prepare();
        (constraints, velocities)
    }

    /// How far friction is beyond its limit, at most, as a part of the limit.
    fn beyond(constraints: &Constraints) -> f64 {
        let points = constraints.points.iter();
        let beyond = points.map(|point| {
            let [x, y] = point.rubbed;
            (x * x + y * y).sqrt() / (point.friction * point.impulse) - 1.0
        });
        beyond.fold(f64::NEG_INFINITY, f64::max)
    }

    #[test]
    fn friction_is_within_its_limit_even_where_sweeps_run_out() {
        // three blocks settle in 58 sweeps, sixty do not in a hundred
        for blocks in [2, 3, 60, 61] {
            let (mut constraints, mut velocities) = column(blocks);
            constraints.settle(&mut velocities);
            // normals settle after friction in each sweep, so that what is left of them is left here, too
            let beyond = beyond(&constraints);
            assert!(beyond < SETTLED, "{blocks} blocks: {beyond}");
        }
    }
}
