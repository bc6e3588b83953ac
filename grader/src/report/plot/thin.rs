//! Thinning: a polyline keeps what can be seen of it, peaks above all.

/// Points of a polyline in units of a picture, broken where a value was not finite.
pub(super) type Pieces = Vec<Vec<(i32, i32)>>;

/// Points in one column of the picture: where it is entered and left, its lowest and its highest.
#[derive(Debug, Clone, Copy)]
struct Column {
    index: i32,
    first: (i32, i32),
    last: (i32, i32),
    low: (usize, (i32, i32)),
    high: (usize, (i32, i32)),
    count: usize,
}

impl Column {
    fn new(index: i32, point: (i32, i32)) -> Self {
        Self {
            index,
            first: point,
            last: point,
            low: (0, point),
            high: (0, point),
            count: 1,
        }
    }

    fn add(&mut self, point: (i32, i32)) {
        if point.1 < self.low.1.1 {
            self.low = (self.count, point);
        }
        if point.1 > self.high.1.1 {
            self.high = (self.count, point);
        }
        self.last = point;
        self.count += 1;
    }

    fn write(&self, piece: &mut Vec<(i32, i32)>) {
        let (one, other) = if self.low.0 <= self.high.0 {
            (self.low.1, self.high.1)
        } else {
            (self.high.1, self.low.1)
        };
        for point in [self.first, one, other, self.last] {
            push(piece, point);
        }
    }
}

/// Adds a point; one that lies on the straight line of those around it is not kept.
fn push(piece: &mut Vec<(i32, i32)>, point: (i32, i32)) {
    if piece.last() == Some(&point) {
        return;
    }
    if let [.., before, last] = piece.as_mut_slice() {
        let level = before.1 == last.1 && last.1 == point.1 && before.0 <= last.0;
        let upright = before.0 == last.0
            && last.0 == point.0
            && (last.1 - before.1).signum() == (point.1 - last.1).signum();
        if level || upright {
            *last = point;
            return;
        }
    }
    piece.push(point);
}

/// How far a line may lie beside a point that it leaves out, in units of a picture: a quarter of a pixel.
const BESIDE: f64 = 2.5;
/// And where it would have too many points otherwise: three pixels.
const FAR_BESIDE: f64 = 30.0;
/// Points that are looked at for a line, however few it may keep.
const FINE: usize = 1400;

/// Leaves out the points that a straight line passes within `beside_most` of (Ramer 1972; Douglas and Peucker 1973).
fn straightened(piece: &[(i32, i32)], beside_most: f64) -> Vec<(i32, i32)> {
    if piece.len() < 3 {
        return piece.to_vec();
    }
    let mut kept = vec![false; piece.len()];
    kept[0] = true;
    kept[piece.len() - 1] = true;
    let mut spans = vec![(0, piece.len() - 1)];
    while let Some((from, to)) = spans.pop() {
        let farthest = (from + 1..to)
            .map(|i| (beside(piece[from], piece[to], piece[i]), i))
            .max_by(|a, b| a.0.total_cmp(&b.0));
        if let Some((distance, at)) = farthest
            && distance > beside_most
        {
            kept[at] = true;
            spans.extend([(from, at), (at, to)]);
        }
    }
    let points = piece.iter().zip(&kept).filter(|(_, kept)| **kept);
    points.map(|(point, _)| *point).collect()
}

/// Distance of a point from the segment between two others.
fn beside(a: (i32, i32), b: (i32, i32), point: (i32, i32)) -> f64 {
    let from_a = |p: (i32, i32)| (f64::from(p.0 - a.0), f64::from(p.1 - a.1));
    let ((bx, by), (px, py)) = (from_a(b), from_a(point));
    let length_squared = bx * bx + by * by;
    let along = if length_squared > 0.0 {
        ((px * bx + py * by) / length_squared).clamp(0.0, 1.0)
    } else {
        0.0
    };
    let (dx, dy) = (px - along * bx, py - along * by);
    (dx * dx + dy * dy).sqrt()
}

/// Thins points in the order of time to about `most`, over a picture `width` units wide: each column keeps its first, lowest,
/// highest and last point, so that no peak is lost, and of these goes what a straight line shows as well, to a quarter of a pixel;
/// where too many are left, to so much more, at most three pixels, as it takes, and then in wider columns. `None` breaks the line.
pub(super) fn over_time(
    points: impl Iterator<Item = Option<(i32, i32)>>,
    width: i32,
    most: usize,
) -> Pieces {
    let points: Vec<_> = points.collect();
    let count = |pieces: &Pieces| pieces.iter().map(Vec::len).sum::<usize>();
    let fine = in_columns(&points, width, FINE);
    let mut beside_most = BESIDE;
    while beside_most <= FAR_BESIDE {
        let straight = fine.iter().map(|piece| straightened(piece, beside_most));
        let straight: Pieces = straight.collect();
        if count(&straight) <= most {
            return straight;
        }
        beside_most *= 1.5;
    }
    // no line but an area, which wider columns show as well
    let coarse = in_columns(&points, width, most);
    let straight = coarse.iter().map(|piece| straightened(piece, BESIDE));
    straight.collect()
}

/// The first, lowest, highest and last point of each column; about `most` of them.
fn in_columns(points: &[Option<(i32, i32)>], width: i32, most: usize) -> Pieces {
    let column_width = (4 * width / most.max(4) as i32).max(1);
    let mut pieces = Pieces::new();
    let mut piece = Vec::new();
    let mut open: Option<Column> = None;
    let mut gap = false;
    for point in points {
        let Some(point) = *point else {
            gap = true;
            continue;
        };
        let index = point.0.div_euclid(column_width);
        match &mut open {
            // a gap narrower than a column cannot be seen
            Some(column) if column.index == index => column.add(point),
            _ => {
                if let Some(column) = open.replace(Column::new(index, point)) {
                    column.write(&mut piece);
                    if gap {
                        pieces.push(std::mem::take(&mut piece));
                    }
                }
            }
        }
        gap = false;
    }
    if let Some(column) = open {
        column.write(&mut piece);
    }
    if !piece.is_empty() {
        pieces.push(piece);
    }
    pieces
}

/// Thins points of a plane to at most `most`: a point nearer to the last kept one than a distance is left out, the distance
/// growing from half a pixel until the rest is few enough. The last point is always kept.
pub(super) fn in_plane(points: &[(f64, f64)], most: usize) -> Vec<(f64, f64)> {
    let mut apart = 0.5;
    loop {
        let mut kept: Vec<(f64, f64)> = Vec::new();
        for &point in points {
            let near = kept.last().is_some_and(|last| {
                let (dx, dy) = (point.0 - last.0, point.1 - last.1);
                dx * dx + dy * dy < apart * apart
            });
            if !near {
                kept.push(point);
            }
        }
        if let (Some(last), Some(kept_last)) = (points.last(), kept.last())
            && last != kept_last
        {
            kept.push(*last);
        }
        if kept.len() <= most.max(2) || apart > 1e6 {
            return kept;
        }
        apart *= 1.5;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_peak_of_one_tick_stays() {
        let points = (0..8001).map(|i| Some((i * 6 / 10, if i == 4321 { -500 } else { i % 7 })));
        let pieces = over_time(points, 4800, 1500);
        let count: usize = pieces.iter().map(Vec::len).sum();
        assert!(count <= 1504, "{count}");
        assert!(pieces[0].iter().any(|p| p.1 == -500));
    }

    #[test]
    fn a_smooth_line_takes_few_points_and_is_nowhere_far() {
        let wave = |i: i32| (i, (1000.0 * libm::sin(f64::from(i) * 0.002)) as i32);
        let pieces = over_time((0..8001).map(|i| Some(wave(i))), 8000, 1500);
        let kept = &pieces[0];
        assert!(kept.len() < 120, "{}", kept.len());
        for i in 0..8001 {
            let point = wave(i);
            let mut segments = kept.windows(2);
            // what a column leaves out lies within it
            assert!(segments.any(|two| beside(two[0], two[1], point) <= BESIDE + 2.0));
        }
    }

    #[test]
    fn a_level_line_is_two_points() {
        let pieces = over_time((0..8001).map(|i| Some((i, 5))), 8000, 1500);
        assert_eq!(pieces, [vec![(0, 5), (8000, 5)]]);
    }

    #[test]
    fn a_gap_breaks_the_line() {
        let points = [Some((0, 0)), None, None, Some((9, 1))];
        assert_eq!(
            over_time(points.into_iter(), 10, 100),
            [vec![(0, 0)], vec![(9, 1)]]
        );
        assert_eq!(over_time(std::iter::empty(), 10, 100), Pieces::new());
    }

    #[test]
    fn a_path_keeps_its_ends() {
        let points: Vec<_> = (0..10_000)
            .map(|i| (f64::from(i) * 0.01, f64::from(i % 50)))
            .collect();
        let kept = in_plane(&points, 300);
        assert!(kept.len() <= 300);
        assert_eq!((kept[0], *kept.last().unwrap()), (points[0], points[9_999]));
    }
}
