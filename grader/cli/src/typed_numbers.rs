//! Numbers typed on the command line: joint positions, and points.

use crate::failure::Failure;

/// Numbers with commas between, as typed for `option`.
///
/// # Errors
/// Exit code 2, with the part that is no number.
pub(crate) fn numbers(text: &str, option: &str, example: &str) -> Result<Vec<f64>, Failure> {
    let number = |part: &str| match part.trim().parse::<f64>() {
        Ok(number) if number.is_finite() => Ok(number),
        _ => Err(Failure::usage(
            format!("`{}` in {option} is not a finite number", part.trim()),
            &format!("separate numbers by commas: {option} \"{example}\""),
        )),
    };
    text.split(',').map(number).collect()
}

/// Points with semicolons between, each three numbers with commas.
///
/// # Errors
/// Exit code 2, with the point that has another count of numbers.
pub(crate) fn points(text: &str) -> Result<Vec<[f64; 3]>, Failure> {
    const EXAMPLE: &str = "1.5,0.8,0.05; 1.4,1.3,0.05";
    let mut points = Vec::new();
    let parts: Vec<&str> = text.trim().trim_end_matches(';').split(';').collect();
    for (index, part) in parts.iter().enumerate() {
        let found = numbers(part, "--via", EXAMPLE)?;
        match found[..] {
            [x, y, z] => points.push([x, y, z]),
            _ => {
                return Err(Failure::usage(
                    format!(
                        "via point {} has {} numbers, and a point has three",
                        index + 1,
                        found.len()
                    ),
                    &format!("write x,y,z in metres for each: --via \"{EXAMPLE}\""),
                ));
            }
        }
    }
    Ok(points)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_are_read_with_room_around_and_a_semicolon_at_the_end() {
        let read = points(" 1.5, 0.8 ,0.05; -1,2e-1,3;").unwrap();
        assert_eq!(read, [[1.5, 0.8, 0.05], [-1.0, 0.2, 3.0]]);
        for wrong in [
            "",
            "1,2",
            "1,2,3,4",
            "1,2,x",
            "1,2,3;;4,5,6",
            "1,2,inf",
            "1,2,NaN",
        ] {
            assert!(points(wrong).is_err(), "{wrong}");
        }
    }
}
