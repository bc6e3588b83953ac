//! Constraint rows: how each constraint sees the velocities of what moves, and how an impulse along it changes them.
//!
//! All velocities are one vector: first the joint rates of the robot, then six numbers (linear, angular) for each dynamic body. A row
//! touches at most two movers.

use std::ops::Range;

/// A mover's part of a row.
#[derive(Debug, Clone, Copy)]
struct Block {
    /// Where the mover's velocities start in the vector of all.
    at: usize,
    len: usize,
    /// Where its entries start in the pools.
    from: usize,
}

impl Block {
    const NONE: Self = Self {
        at: 0,
        len: 0,
        from: 0,
    };

    fn velocities(&self) -> Range<usize> {
        self.at..self.at + self.len
    }

    fn entries(&self) -> Range<usize> {
        self.from..self.from + self.len
    }
}

#[derive(Debug, Clone, Copy)]
struct Row {
    blocks: [Block; 2],
    /// Speed of what follows a prescribed motion.
    driven: f64,
    /// Change of the speed by an impulse of one.
    softness: f64,
}

/// The rows of one step.
#[derive(Debug, Clone, Default)]
pub(super) struct Rows {
    rows: Vec<Row>,
    jacobian: Vec<f64>,
    response: Vec<f64>,
}

impl Rows {
    pub(super) fn clear(&mut self) {
        self.rows.clear();
        self.jacobian.clear();
        self.response.clear();
    }

    /// Starts a row with no mover yet, for which what is driven has the speed `driven`; returns its index.
    pub(super) fn start(&mut self, driven: f64) -> usize {
        self.rows.push(Row {
            blocks: [Block::NONE; 2],
            driven,
            softness: 0.0,
        });
        self.rows.len() - 1
    }

    /// Adds a mover to the last row: its speed is `jacobian · velocities[at..]`. Its response is not known yet.
    pub(super) fn add(&mut self, at: usize, jacobian: &[f64]) {
        let Some(row) = self.rows.last_mut() else {
            return;
        };
        let block = Block {
            at,
            len: jacobian.len(),
            from: self.jacobian.len(),
        };
        let free = usize::from(row.blocks[0].len > 0);
        row.blocks[free] = block;
        self.jacobian.extend_from_slice(jacobian);
    }

    /// Computes all responses; `respond(at, jacobian, response)` writes the change of the velocities from `at` on by an impulse of one.
    pub(super) fn respond(&mut self, mut respond: impl FnMut(usize, &[f64], &mut [f64])) {
        self.response.resize(self.jacobian.len(), 0.0);
        for row in &mut self.rows {
            row.softness = 0.0;
            for block in row.blocks.iter().filter(|block| block.len > 0) {
                let (jacobian, response) = (
                    &self.jacobian[block.entries()],
                    &mut self.response[block.entries()],
                );
                respond(block.at, jacobian, response);
                row.softness += dot(jacobian, response);
            }
        }
    }

    /// The speed along row `row` at `velocities`.
    pub(super) fn speed(&self, row: usize, velocities: &[f64]) -> f64 {
        self.rows[row].driven + self.along(row, velocities)
    }

    /// What the movers of `row` alone contribute to it: with displacements for `velocities`, the change of a gap.
    pub(super) fn along(&self, row: usize, velocities: &[f64]) -> f64 {
        let [first, second] = &self.rows[row].blocks;
        let part = |block: &Block| {
            let jacobian = &self.jacobian[block.entries()];
            dot(jacobian, &velocities[block.velocities()])
        };
        part(first) + part(second)
    }

    /// Change of the speed along `row` by an impulse of one along it.
    pub(super) fn softness(&self, row: usize) -> f64 {
        self.rows[row].softness
    }

    /// Change of the speed along `first` by an impulse of one along `second`, which has the same movers.
    pub(super) fn coupling(&self, first: usize, second: usize) -> f64 {
        let (first, second) = (&self.rows[first], &self.rows[second]);
        let mut change = 0.0;
        for (a, b) in first.blocks.iter().zip(&second.blocks) {
            change += dot(&self.jacobian[a.entries()], &self.response[b.entries()]);
        }
        change
    }

    /// Changes `velocities` by an impulse along `row`.
    pub(super) fn push(&self, row: usize, impulse: f64, velocities: &mut [f64]) {
        for block in &self.rows[row].blocks {
            let response = &self.response[block.entries()];
            let velocities = &mut velocities[block.velocities()];
            let add = |velocities: &mut [f64], response: &[f64]| {
                for (velocity, response) in velocities.iter_mut().zip(response) {
                    *velocity += response * impulse;
                }
            };
            match (<&mut [f64; 6]>::try_from(&mut *velocities), six(response)) {
                (Ok(velocities), Some(response)) => add(velocities, response),
                _ => add(velocities, response),
            }
        }
    }
}

/// Those of a body, whose number the compiler knows.
fn six(list: &[f64]) -> Option<&[f64; 6]> {
    list.try_into().ok()
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    match (six(a), six(b)) {
        (Some(a), Some(b)) => {
            (a[0] * b[0] + a[1] * b[1]) + (a[2] * b[2] + a[3] * b[3]) + (a[4] * b[4] + a[5] * b[5])
        }
        _ => a.iter().zip(b).map(|(a, b)| a * b).sum(),
    }
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
        rows.add(1, &[1.0]);
        let wall = rows.start(3.0);
        rows.add(0, &[-1.0]);
        rows.respond(|at, jacobian, response| {
            response[0] = jacobian[0] / if at == 0 { 2.0 } else { 4.0 };
        });
        let mut velocities = [1.0, 5.0];
        assert_eq!(rows.speed(between, &velocities), 4.0);
        assert_eq!(rows.speed(wall, &velocities), 2.0);
        assert_eq!(rows.softness(between), 0.75);
        rows.push(between, 2.0, &mut velocities);
        assert_eq!(velocities, [0.0, 5.5]);
    }
}
