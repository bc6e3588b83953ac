//! Constraint rows: how each constraint sees the velocities of what moves, and how an impulse along it changes them.
//!
//! All velocities are one vector: first the joint rates of the robot, then six numbers (linear, angular) for each dynamic body. The
//! robot's have zeros behind them, so that every mover starts at a multiple of six, and the compiler knows how long a part of a row is.
//! A row touches at most two movers.

use std::ops::Range;

/// Numbers of a part.
pub(super) const PART: usize = 6;

type Part = [f64; PART];

#[derive(Debug, Clone, Copy)]
struct Row {
    /// Where its parts start in the pools.
    from: usize,
    /// How many parts each of its movers has.
    parts: [usize; 2],
    /// Speed of what follows a prescribed motion.
    driven: f64,
    /// Change of the speed by an impulse of one.
    softness: f64,
}

impl Row {
    fn entries(&self) -> Range<usize> {
        self.from..self.from + self.parts[0] + self.parts[1]
    }

    /// The parts of each mover.
    fn movers(&self) -> [Range<usize>; 2] {
        let between = self.from + self.parts[0];
        [self.from..between, between..between + self.parts[1]]
    }
}

/// The rows of one step.
#[derive(Debug, Clone, Default)]
pub(super) struct Rows {
    rows: Vec<Row>,
    /// Where the velocities of a part are in the vector of all, in parts.
    at: Vec<usize>,
    jacobian: Vec<Part>,
    response: Vec<Part>,
}

impl Rows {
    pub(super) fn clear(&mut self) {
        self.rows.clear();
        self.at.clear();
        self.jacobian.clear();
        self.response.clear();
    }

    /// Starts a row with no mover yet, for which what is driven has the speed `driven`; returns its index.
    pub(super) fn start(&mut self, driven: f64) -> usize {
        self.rows.push(Row {
            from: self.at.len(),
            parts: [0; 2],
            driven,
            softness: 0.0,
        });
        self.rows.len() - 1
    }

    /// Adds a mover to the last row: its speed is `jacobian · velocities[at..]`, where `at` is a multiple of [`PART`]. Its response is
    /// not known yet.
    pub(super) fn add(&mut self, at: usize, jacobian: &[f64]) {
        let Some(row) = self.rows.last_mut() else {
            return;
        };
        let parts = jacobian.chunks(PART);
        row.parts[usize::from(row.parts[0] > 0)] = parts.len();
        for (i, entries) in parts.enumerate() {
            let mut part = [0.0; PART];
            part[..entries.len()].copy_from_slice(entries);
            self.jacobian.push(part);
            self.at.push(at / PART + i);
        }
    }

    /// Computes all responses; `respond(at, jacobian, response)` writes the change of the velocities from `at` on by an impulse of one.
    pub(super) fn respond(&mut self, mut respond: impl FnMut(usize, &[f64], &mut [f64])) {
        self.response.resize(self.jacobian.len(), [0.0; PART]);
        for row in &mut self.rows {
            row.softness = 0.0;
            for mover in row.movers() {
                let Some(at) = self.at[mover.clone()].first() else {
                    continue;
                };
                let jacobian = self.jacobian[mover.clone()].as_flattened();
                let response = &mut self.response[mover.clone()];
                respond(PART * at, jacobian, response.as_flattened_mut());
                row.softness += dot(&self.jacobian[mover], response);
            }
        }
    }

    /// The speed along row `row` at `velocities`.
    pub(super) fn speed(&self, row: usize, velocities: &[f64]) -> f64 {
        self.rows[row].driven + self.along(row, velocities)
    }

    /// What the movers of `row` alone contribute to it: with displacements for `velocities`, the change of a gap.
    pub(super) fn along(&self, row: usize, velocities: &[f64]) -> f64 {
        let (velocities, _) = velocities.as_chunks();
        let entries = self.rows[row].entries();
        let parts = self.jacobian[entries.clone()].iter().zip(&self.at[entries]);
        parts
            .map(|(part, at)| product(part, &velocities[*at]))
            .sum()
    }

    /// Change of the speed along `row` by an impulse of one along it.
    pub(super) fn softness(&self, row: usize) -> f64 {
        self.rows[row].softness
    }

    /// Change of the speed along `first` by an impulse of one along `second`, which has the same movers.
    pub(super) fn coupling(&self, first: usize, second: usize) -> f64 {
        let [first, second] = [first, second].map(|row| self.rows[row].entries());
        dot(&self.jacobian[first], &self.response[second])
    }

    /// Changes `velocities` by an impulse along `row`.
    pub(super) fn push(&self, row: usize, impulse: f64, velocities: &mut [f64]) {
        let (velocities, _) = velocities.as_chunks_mut::<PART>();
        let entries = self.rows[row].entries();
        for (part, at) in self.response[entries.clone()].iter().zip(&self.at[entries]) {
            for (velocity, response) in velocities[*at].iter_mut().zip(part) {
                *velocity += response * impulse;
            }
        }
    }
}

fn dot(a: &[Part], b: &[Part]) -> f64 {
    a.iter().zip(b).map(|(a, b)| product(a, b)).sum()
}

fn product(a: &Part, b: &Part) -> f64 {
    (a[0] * b[0] + a[1] * b[1]) + (a[2] * b[2] + a[3] * b[3]) + (a[4] * b[4] + a[5] * b[5])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_row_between_two_movers_by_hand() {
        let mut rows = Rows::default();
        // two masses of 2 and 4 kg on a line, the second seen against the first, and a wall that comes with 3 m/s
        let between = rows.start(0.0);
        rows.add(0, &[-1.0]);
        rows.add(PART, &[1.0]);
        let wall = rows.start(3.0);
        rows.add(0, &[-1.0]);
        rows.respond(|at, jacobian, response| {
            response[0] = jacobian[0] / if at == 0 { 2.0 } else { 4.0 };
        });
        let mut velocities = [0.0; 2 * PART];
        (velocities[0], velocities[PART]) = (1.0, 5.0);
        assert_eq!(rows.speed(between, &velocities), 4.0);
        assert_eq!(rows.speed(wall, &velocities), 2.0);
        assert_eq!(rows.softness(between), 0.75);
        rows.push(between, 2.0, &mut velocities);
        assert_eq!((velocities[0], velocities[PART]), (0.0, 5.5));
        // a robot of seven joints has two parts
        let long = rows.start(0.0);
        rows.add(0, &[1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0]);
        rows.respond(|_, jacobian, response| response.copy_from_slice(jacobian));
        let mut velocities = [1.0; 2 * PART];
        assert_eq!(rows.along(long, &velocities), 28.0);
        assert_eq!(rows.softness(long), 140.0);
        rows.push(long, 2.0, &mut velocities);
        assert_eq!(velocities[5..9], [13.0, 15.0, 1.0, 1.0]);
    }
}
