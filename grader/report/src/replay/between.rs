//! The way between the frames of a track: what each of the four frames around a moment counts for where something is at it.
//!
//! The viewer takes the same way (`grader/web/src/between.ts`), so that here is known how far it is from the run's.

/// What the frames at `ticks` count for at `tick`, which lies between the second and the third.
///
/// The way is the cubic through these two whose slope at each is that of the parabola through a frame and its neighbours. At an end a
/// frame stands for its missing neighbour, too, and the slope there is that of the line to its one neighbour.
pub(super) fn weights(ticks: [f64; 4], tick: f64) -> [f64; 4] {
    let step = ticks[2] - ticks[1];
    if step <= 0.0 {
        return [0.0, 1.0, 0.0, 0.0];
    }
    let f = (tick - ticks[1]) / step;
    let (before, after) = (ticks[1] - ticks[0], ticks[3] - ticks[2]);
    // how much of a slope is the line between both frames; the rest is the line beyond
    let near = if before > 0.0 {
        before / (before + step)
    } else {
        1.0
    };
    let far = if after > 0.0 {
        after / (after + step)
    } else {
        1.0
    };
    let lower = if before > 0.0 {
        (1.0 - near) * (step / before)
    } else {
        0.0
    };
    let upper = if after > 0.0 {
        (1.0 - far) * (step / after)
    } else {
        0.0
    };
    let (leaving, arriving) = (f * (1.0 - f) * (1.0 - f), -f * f * (1.0 - f));
    let rise = f * f * (3.0 - 2.0 * f);
    [
        -leaving * lower,
        1.0 - rise + leaving * (lower - near) - arriving * far,
        rise + leaving * near + arriving * (far - upper),
        arriving * upper,
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_parabola_is_met_between_frames_however_far_apart_they_are() {
        let parabola = |x: f64| 3.0 - 0.5 * x + 0.07 * x * x;
        let ticks = [0.0, 10.0, 12.0, 40.0];
        for tick in [10.0, 10.5, 11.0, 12.0] {
            let weights = weights(ticks, tick);
            let met: f64 = (0..4).map(|i| weights[i] * parabola(ticks[i])).sum();
            assert!((met - parabola(tick)).abs() < 1e-12, "{tick}: {met}");
            assert!((weights.iter().sum::<f64>() - 1.0).abs() < 1e-12);
        }
    }

    /// By hand: with two frames there is one line, and half way is half of each.
    #[test]
    fn of_two_frames_the_way_is_straight() {
        let halves = weights([5.0, 5.0, 9.0, 9.0], 7.0);
        assert!((halves[1] - 0.5).abs() + (halves[2] - 0.5).abs() < 1e-15);
        assert_eq!([halves[0], halves[3]].map(f64::abs), [0.0, 0.0]);
        assert_eq!(weights([5.0; 4], 5.0), [0.0, 1.0, 0.0, 0.0]);
    }
}
