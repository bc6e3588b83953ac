//! Rows of numbers that a function returns without an allocator: branches of the inverse kinematics, rows of a Jacobian.

/// Where a function writes rows of `n` numbers, one number per joint.
pub struct Rows<'a> {
    numbers: &'a mut [f64],
    columns: usize,
    written: usize,
}

impl<'a> Rows<'a> {
    pub(crate) fn new(numbers: &'a mut [f64], columns: usize) -> Self {
        Self {
            numbers,
            columns,
            written: 0,
        }
    }

    /// Adds a row: an array `&[q1, q2]`, or any slice.
    ///
    /// # Panics
    /// If it has not one number per joint, or if there is no room: for 6 rows of a Jacobian, for several hundred branches.
    #[track_caller]
    pub fn push(&mut self, row: &[f64]) {
        let columns = self.columns;
        assert!(
            row.len() == columns,
            "a row of {} numbers, for {columns} joints",
            row.len()
        );
        let mut places = self.numbers.chunks_exact_mut(columns.max(1));
        match places.nth(self.written) {
            Some(place) => place.copy_from_slice(row),
            None => panic!("there is no room for more than {} rows", self.written),
        }
        self.written += 1;
    }

    /// How many rows it has.
    pub fn len(&self) -> usize {
        self.written
    }

    /// Whether it has no row yet.
    pub fn is_empty(&self) -> bool {
        self.written == 0
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::map::tests::panicked;

    #[test]
    fn rows_follow_each_other_as_far_as_there_is_room() {
        let mut numbers = [0.0; 5];
        let mut rows = Rows::new(&mut numbers, 2);
        assert!(rows.is_empty());
        rows.push(&[1.0, 2.0]);
        rows.push(&std::vec![3.0, 4.0]);
        assert_eq!(rows.len(), 2);
        assert_eq!(&numbers[..], [1.0, 2.0, 3.0, 4.0, 0.0]);
        assert_eq!(
            panicked(|| {
                let mut numbers = [0.0; 3];
                let mut rows = Rows::new(&mut numbers, 2);
                rows.push(&[1.0, 2.0]);
                rows.push(&[3.0, 4.0]);
            }),
            "there is no room for more than 1 rows"
        );
        assert_eq!(
            panicked(|| Rows::new(&mut [0.0; 9], 2).push(&[1.0, 2.0, 3.0])),
            "a row of 3 numbers, for 2 joints"
        );
    }
}
