//! Manipulability of a frame: singular values of its Jacobian, Yoshikawa's measure, condition number.

use nalgebra::Matrix6xX;

use super::singular_values::RowJacobi;

/// Singular values below this fraction of the largest are rounding errors.
const RANK_TOLERANCE: f64 = 1e-12;

/// Manipulability of a frame in some directions, from its Jacobian.
#[derive(Debug, Clone, PartialEq)]
pub struct Manipulability {
    singular_values: Vec<f64>,
    rows: usize,
}

/// Rows of the linear velocity.
pub const LINEAR: &[usize] = &[0, 1, 2];
/// Rows of the angular velocity.
pub const ANGULAR: &[usize] = &[3, 4, 5];
/// All rows. Their singular values mix metres and radians.
pub const TWIST: &[usize] = &[0, 1, 2, 3, 4, 5];

impl Manipulability {
    /// Manipulability of the rows `rows` of `jacobian`, such as [`LINEAR`], or `&[0, 1]` for an arm in the x-y plane.
    ///
    /// # Panics
    /// If a row is not below six.
    pub fn of(jacobian: &Matrix6xX<f64>, rows: &[usize]) -> Self {
        let picked: Vec<f64> = jacobian
            .column_iter()
            .flat_map(|column| rows.iter().map(move |&row| column[row]))
            .collect();
        let mut decomposition = RowJacobi::default();
        decomposition.decompose(rows.len(), &picked);
        Self {
            singular_values: decomposition.values(),
            rows: rows.len(),
        }
    }

    /// The singular values, largest first, `min(rows, n)` of them \[m or 1 per unit of joint velocity\]: the half axes of the
    /// ellipsoid of velocities that joint velocities of length one make.
    pub fn singular_values(&self) -> &[f64] {
        &self.singular_values
    }

    /// The smallest singular value: zero in a singular configuration, and always with fewer joints than rows.
    pub fn min_singular_value(&self) -> f64 {
        if self.singular_values.len() < self.rows {
            return 0.0;
        }
        self.singular_values.last().copied().unwrap_or(0.0)
    }

    /// Yoshikawa's measure `sqrt(det(J Jᵀ))`: the product of the singular values; zero with fewer joints than rows.
    ///
    /// Source: Yoshikawa, *Manipulability of robotic mechanisms* (1985).
    pub fn yoshikawa(&self) -> f64 {
        if self.singular_values.len() < self.rows {
            return 0.0;
        }
        self.singular_values.iter().product()
    }

    /// Condition number: the ratio of the largest to the smallest of the [`Manipulability::singular_values`], at least 1; `None` if it is
    /// infinite or there are no singular values.
    pub fn condition(&self) -> Option<f64> {
        let (largest, smallest) = (self.singular_values.first()?, self.singular_values.last()?);
        (*smallest > RANK_TOLERANCE * largest).then(|| largest / smallest)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The Jacobian of a planar arm with two links of one metre, in the x-y plane.
    fn planar(q1: f64, q2: f64) -> Matrix6xX<f64> {
        let (s1, c1) = libm::sincos(q1);
        let (s12, c12) = libm::sincos(q1 + q2);
        Matrix6xX::from_row_slice(&[
            -s1 - s12,
            -s12,
            c1 + c12,
            c12,
            0.0,
            0.0,
            0.0,
            0.0,
            0.0,
            0.0,
            1.0,
            1.0,
        ])
    }

    #[test]
    fn the_measure_of_a_planar_arm_is_the_sine_of_its_elbow() {
        // |det J| = l1 l2 |sin q2|
        for q2 in [0.1, 1.0, -2.0] {
            let m = Manipulability::of(&planar(0.7, q2), &[0, 1]);
            assert!((m.yoshikawa() - libm::sin(q2).abs()).abs() < 1e-15);
            let [largest, smallest] = [m.singular_values()[0], m.singular_values()[1]];
            assert!((largest * smallest - m.yoshikawa()).abs() < 1e-15);
            assert_eq!(m.condition(), Some(largest / smallest));
            assert_eq!(m.min_singular_value(), smallest);
        }
    }

    #[test]
    fn a_straight_arm_has_no_condition_and_too_few_joints_no_measure() {
        let m = Manipulability::of(&planar(0.0, 0.0), &[0, 1]);
        // rows (0, 0) and (2, 1)
        assert!((m.singular_values()[0] - 5.0_f64.sqrt()).abs() < 1e-15);
        assert_eq!((m.yoshikawa(), m.condition()), (0.0, None));
        let m = Manipulability::of(&planar(0.3, 1.0), TWIST);
        assert_eq!((m.singular_values().len(), m.yoshikawa()), (2, 0.0));
        assert!(m.condition().is_some());
        let m = Manipulability::of(&planar(0.3, 1.0), ANGULAR);
        assert!((m.singular_values()[0] - 2.0_f64.sqrt()).abs() < 1e-15);
        let none = Manipulability::of(&Matrix6xX::zeros(0), LINEAR);
        assert_eq!((none.min_singular_value(), none.condition()), (0.0, None));
    }
}
