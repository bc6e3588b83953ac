//! Points as cells of a table have them: with a decimal point or a decimal comma, at most two decimals, no zeros at the end.

use kinemark_grader::record::quantity::points;

/// What stands before the decimals.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Decimal {
    Point,
    Comma,
}

impl Decimal {
    /// The one that cells have; none where no number among them has decimals, or where they differ.
    pub(super) fn of_cells<'a>(cells: impl Iterator<Item = &'a str>) -> Option<Self> {
        let mut found = None;
        for cell in cells {
            let Some(sign) = last_sign(cell).filter(|_| number(cell).is_some()) else {
                continue;
            };
            let decimal = match sign {
                ',' => Self::Comma,
                _ => Self::Point,
            };
            match found {
                Some(other) if other != decimal => return None,
                _ => found = Some(decimal),
            }
        }
        found
    }

    /// Points in a cell.
    pub(super) fn cell(self, value: f64) -> String {
        let text = points_text(value);
        match self {
            Self::Point => text,
            Self::Comma => text.replace('.', ","),
        }
    }
}

/// Points with a decimal point.
pub(super) fn points_text(value: f64) -> String {
    points(value)
}

/// Whether a cell says these points, with however many zeros.
pub(super) fn says(cell: &str, value: f64) -> bool {
    number(cell).is_some_and(|said| (said - value).abs() < 0.005)
}

/// The number in a cell. No LMS groups digits in these cells, so the last point or comma stands before the decimals; Moodle once wrote
/// `4.50 / 10.00`.
pub(super) fn number(cell: &str) -> Option<f64> {
    let cell = cell.split('/').next()?.trim();
    let plain = |c: char| c.is_ascii_digit() || matches!(c, '.' | ',' | '-');
    let digits: String = cell.chars().filter(|c| !c.is_whitespace()).collect();
    if !digits.chars().all(plain) || !digits.chars().any(|c| c.is_ascii_digit()) {
        return None;
    }
    let (whole, decimals) = match digits.rfind(['.', ',']) {
        Some(at) => (&digits[..at], &digits[at + 1..]),
        None => (digits.as_str(), ""),
    };
    let whole: String = whole.chars().filter(|c| !matches!(c, '.' | ',')).collect();
    format!("{whole}.{decimals}0").parse().ok()
}

/// The last point or comma of a cell's number.
fn last_sign(cell: &str) -> Option<char> {
    let number = cell.split('/').next()?;
    number.chars().rev().find(|c| matches!(c, '.' | ','))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_of_cells_are_read_in_every_spelling() {
        for (cell, value) in [
            ("4.50", 4.5),
            ("4,5", 4.5),
            (" 24 ", 24.0),
            ("4.50 / 10.00", 4.5),
            ("-0.5", -0.5),
            ("1.234,50", 1234.5),
            ("1 234,5", 1234.5),
            (",5", 0.5),
        ] {
            assert_eq!(number(cell), Some(value), "{cell}");
        }
        for cell in ["", "-", "EX", "N/A", "(read only)", "4.5 points"] {
            assert_eq!(number(cell), None, "{cell}");
        }
    }

    #[test]
    fn the_decimal_sign_is_that_of_the_cells() {
        let of = |cells: &[&str]| Decimal::of_cells(cells.iter().copied());
        assert_eq!(of(&["", "24,00", "4,5"]), Some(Decimal::Comma));
        assert_eq!(of(&["24.00"]), Some(Decimal::Point));
        assert_eq!(of(&["24", "", "1.2.a"]), None);
        assert_eq!(of(&["24.00", "4,5"]), None);
    }

    #[test]
    fn points_have_two_decimals_at_most() {
        assert_eq!(Decimal::Comma.cell(18.5), "18,5");
        assert_eq!(Decimal::Point.cell(24.0), "24");
        assert_eq!(Decimal::Point.cell(0.1 + 0.2), "0.3");
        assert!(says("18,50", 18.5) && !says("18.4", 18.5) && !says("", 0.0));
    }
}
