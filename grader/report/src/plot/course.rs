//! The course of a signal as it is drawn over time: a line where an eye can follow it, and where it goes up and down faster than
//! that, a band from its lowest to its highest. All of it lies within half a pixel of the signal.

/// A point in units of a picture, y downwards.
pub(super) type Point = (i32, i32);

/// What is drawn of a signal.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Course {
    /// Unbroken lines.
    pub(super) lines: Vec<Vec<Point>>,
    /// Bands: their upper and their lower edge, both from left to right.
    pub(super) bands: Vec<[Vec<Point>; 2]>,
    /// How far above or below what is drawn a value may lie, besides its rounding to a whole unit.
    pub(super) off: f64,
}

/// How closely a signal is followed: how far beside a line a point may lie, and how wide a column is whose ups and downs may become
/// a band. A column of a pixel hides nothing that can be seen; wider ones are for what would take too many points.
#[derive(Debug, Clone, Copy)]
struct Care {
    off: f64,
    column: i32,
    /// Whether a column becomes a band by its number of points alone.
    any: bool,
}

const fn care(off: f64, column: i32) -> Care {
    Care {
        off,
        column,
        any: false,
    }
}

/// From the closest on; the last is bound to take few points.
const CARES: [Care; 9] = [
    care(1.0, 10),
    care(2.5, 10),
    care(5.0, 10),
    care(5.0, 20),
    care(5.0, 40),
    care(5.0, 80),
    care(5.0, 160),
    care(5.0, 320),
    Care {
        any: true,
        ..care(5.0, 320)
    },
];

/// Points of a column that are drawn as a line, however often it turns.
const FOLLOWED: usize = 4;
/// Turns in a column that an eye does not follow.
const TURNS: usize = 3;
/// Points that the words around a band weigh as much as.
const WORDS: usize = 6;

/// The courses of all signals of a picture, each as close as it gets with `most` points for all; where that is too few, the one that
/// takes most is followed less closely. Points are in the order of time; `None` breaks a line, unless the gap is too narrow to be seen.
pub(super) fn courses(signals: &[Vec<Option<Point>>], most: usize) -> Vec<Course> {
    let mut found: Vec<(usize, Course)> = signals
        .iter()
        .map(|signal| (0, course(signal, CARES[0])))
        .collect();
    let mut weights: Vec<usize> = found.iter().map(|(_, course)| course.weight()).collect();
    while weights.iter().sum::<usize>() > most {
        // what an eye could follow becomes a band only where nothing else helps
        let is_last = |i: usize| found[i].0 + 2 == CARES.len();
        let heaviest = (0..found.len())
            .filter(|i| found[*i].0 + 1 < CARES.len())
            .max_by_key(|i| (!is_last(*i), weights[*i], std::cmp::Reverse(*i)));
        let Some(i) = heaviest else {
            break;
        };
        let next = found[i].0 + 1;
        found[i] = (next, course(&signals[i], CARES[next]));
        weights[i] = found[i].1.weight();
    }
    found.into_iter().map(|(_, course)| course).collect()
}

impl Course {
    fn weight(&self) -> usize {
        let bands = self.bands.iter().flatten();
        let bands = bands.map(|edge| edge.len() + WORDS / 2);
        bands.chain(self.lines.iter().map(Vec::len)).sum()
    }
}

fn course(signal: &[Option<Point>], care: Care) -> Course {
    let mut drawn = Course {
        lines: Vec::new(),
        bands: Vec::new(),
        off: care.off,
    };
    for piece in pieces(signal, care.column) {
        draw(&piece, care, &mut drawn);
    }
    drawn
}

/// All points of one place along the axis: at most four are needed to draw them.
struct Place {
    first: Point,
    last: Point,
    /// The highest in the picture and the lowest, each with its number among those of the place.
    high: (usize, Point),
    low: (usize, Point),
    count: usize,
}

impl Place {
    fn new(point: Point) -> Self {
        Self {
            first: point,
            last: point,
            high: (0, point),
            low: (0, point),
            count: 1,
        }
    }

    fn add(&mut self, point: Point) {
        if point.1 < self.high.1.1 {
            self.high = (self.count, point);
        }
        if point.1 > self.low.1.1 {
            self.low = (self.count, point);
        }
        self.last = point;
        self.count += 1;
    }

    fn write(&self, piece: &mut Vec<Point>) {
        let (one, other) = if self.high.0 <= self.low.0 {
            (self.high.1, self.low.1)
        } else {
            (self.low.1, self.high.1)
        };
        let start = piece.len();
        for point in [self.first, one, other, self.last] {
            if piece[start..].last() != Some(&point) {
                piece.push(point);
            }
        }
    }
}

/// The unbroken pieces of a signal, with at most four points at each place along the axis. A gap narrower than `narrowest` is closed.
fn pieces(signal: &[Option<Point>], narrowest: i32) -> Vec<Vec<Point>> {
    let mut pieces: Vec<Vec<Point>> = Vec::new();
    let mut piece: Vec<Point> = Vec::new();
    let mut open: Option<Place> = None;
    let mut gap = false;
    for point in signal {
        let Some(point) = *point else {
            gap = true;
            continue;
        };
        match &mut open {
            Some(place) if place.last.0 == point.0 => place.add(point),
            _ => {
                if let Some(place) = open.replace(Place::new(point)) {
                    place.write(&mut piece);
                    if gap && point.0 - place.last.0 >= narrowest {
                        pieces.push(std::mem::take(&mut piece));
                    }
                }
            }
        }
        gap = false;
    }
    if let Some(place) = open {
        place.write(&mut piece);
        pieces.push(piece);
    }
    pieces
}

/// Adds what is drawn of a piece.
fn draw(piece: &[Point], care: Care, drawn: &mut Course) {
    let columns = columns(piece, care);
    let mut from = 0;
    while from < columns.len() {
        let is_band = columns[from].is_band;
        let same = columns[from..].iter().take_while(|c| c.is_band == is_band);
        let to = from + same.count();
        if is_band {
            drawn.bands.push(band(piece, &columns[from..to], care.off));
        } else {
            // up to where the band after it begins
            let last = columns[to - 1].end.min(piece.len() - 1);
            let points = &piece[columns[from].start..=last];
            drawn.lines.push(followed(points, care.off));
        }
        from = to;
    }
}

/// A column: the points it holds, and how it is drawn.
struct Column {
    start: usize,
    end: usize,
    is_band: bool,
}

fn columns(piece: &[Point], care: Care) -> Vec<Column> {
    let mut columns: Vec<Column> = Vec::new();
    let mut index = None;
    for (i, point) in piece.iter().enumerate() {
        let its = Some(point.0.div_euclid(care.column));
        match columns.last_mut() {
            Some(column) if index == its => column.end = i + 1,
            _ => columns.push(Column {
                start: i,
                end: i + 1,
                is_band: false,
            }),
        }
        index = its;
    }
    let line = followed(piece, care.off);
    let mut at = 0;
    for column in &mut columns {
        let end = piece[column.end - 1].0;
        let count = line[at..].iter().take_while(|p| p.0 <= end).count();
        if count > FOLLOWED {
            let turns = (at.max(1)..(at + count).min(line.len() - 1)).filter(|i| {
                let (before, after) = (line[*i].1 - line[i - 1].1, line[i + 1].1 - line[*i].1);
                before.signum() * after.signum() < 0
            });
            column.is_band = care.any || turns.count() >= TURNS;
        }
        at += count;
    }
    columns
}

/// The edges of neighbouring columns, each from its highest to its lowest, with the way into the next.
fn band(piece: &[Point], columns: &[Column], off: f64) -> [Vec<Point>; 2] {
    let mut upper: Vec<Point> = Vec::new();
    let mut lower: Vec<Point> = Vec::new();
    for column in columns {
        let last = column.end.min(piece.len() - 1);
        let heights = || piece[column.start..=last].iter().map(|p| p.1);
        let (left, right) = (piece[column.start].0, piece[last].0);
        let (top, bottom) = (heights().min(), heights().max());
        upper.extend(top.into_iter().flat_map(|y| [(left, y), (right, y)]));
        lower.extend(bottom.into_iter().flat_map(|y| [(left, y), (right, y)]));
    }
    [upper, lower].map(|edge| followed(&edge, off))
}

/// The points of a line that passes no farther than `off` above or below any of `points`, which run to the right: from each on as far
/// as one stroke does.
///
/// Source: Tomek, *Two algorithms for piecewise-linear continuous approximation of functions of one variable* (1974); here each
/// stroke ends on a point.
pub(super) fn followed(points: &[Point], off: f64) -> Vec<Point> {
    let Some((&first, rest)) = points.split_first() else {
        return Vec::new();
    };
    let mut kept = vec![first];
    let mut anchor = first;
    // the last point the open stroke reaches, and the slopes with which it passes all others
    let mut reached: Option<Point> = None;
    let (mut least, mut most) = (f64::NEG_INFINITY, f64::INFINITY);
    for &point in rest {
        let from = |anchor: Point| {
            let (dx, dy) = (point.0 - anchor.0, point.1 - anchor.1);
            (f64::from(dx), f64::from(dy))
        };
        let (mut dx, mut dy) = from(anchor);
        if let Some(before) = reached {
            let slope = dy / dx;
            if !(least <= slope && slope <= most) {
                kept.push(before);
                anchor = before;
                reached = None;
                (least, most) = (f64::NEG_INFINITY, f64::INFINITY);
                (dx, dy) = from(anchor);
            }
        }
        if dx > 0.0 {
            least = least.max((dy - off) / dx);
            most = most.min((dy + off) / dx);
            reached = Some(point);
        } else if dy.abs() > off {
            // an upright stroke
            kept.push(point);
            anchor = point;
        }
    }
    let last = reached.unwrap_or(points[points.len() - 1]);
    if kept.last() != Some(&last) {
        kept.push(last);
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Heights of what is drawn within half a unit of a place: the lowest number and the greatest.
    fn read(course: &Course, x: i32) -> Option<(f64, f64)> {
        let (from, to) = (f64::from(x) - 0.5, f64::from(x) + 0.5);
        let mut found: Option<(f64, f64)> = None;
        let mut see = |y: f64| {
            let (low, high) = found.unwrap_or((y, y));
            found = Some((low.min(y), high.max(y)));
        };
        for line in course.lines.iter().chain(course.bands.iter().flatten()) {
            for two in line.windows(2) {
                let [a, b] = [two[0], two[1]].map(|p| (f64::from(p.0), f64::from(p.1)));
                if b.0 < from || a.0 > to {
                    continue;
                }
                let at = |x: f64| {
                    let share = if b.0 > a.0 {
                        (x - a.0) / (b.0 - a.0)
                    } else {
                        0.0
                    };
                    a.1 + share.clamp(0.0, 1.0) * (b.1 - a.1)
                };
                see(at(from.max(a.0)));
                see(if b.0 > a.0 { at(to.min(b.0)) } else { b.1 });
            }
        }
        found
    }

    /// What is drawn of `signal` is read at each of its points as a range that holds it.
    fn holds(course: &Course, signal: &[Option<Point>]) {
        for point in signal.iter().flatten() {
            let (low, high) = read(course, point.0).expect("something is drawn");
            let y = f64::from(point.1);
            let off = course.off + 1e-6;
            assert!(
                low - off <= y && y <= high + off,
                "{point:?}: {low} to {high}"
            );
        }
    }

    fn one(signal: &[Option<Point>], most: usize) -> Course {
        let course = courses(&[signal.to_vec()], most).remove(0);
        holds(&course, signal);
        course
    }

    fn every(points: impl Iterator<Item = Point>) -> Vec<Option<Point>> {
        points.map(Some).collect()
    }

    #[test]
    fn a_peak_of_one_tick_stays() {
        let wave = (0..8001).map(|i| (i * 6 / 10, if i == 4321 { -500 } else { i % 7 }));
        let course = one(&every(wave), 1500);
        let edges = course.bands.iter().flatten();
        assert!(
            course
                .lines
                .iter()
                .chain(edges)
                .flatten()
                .any(|p| p.1 == -500)
        );
        assert!(course.weight() <= 1500);
    }

    #[test]
    fn a_smooth_line_takes_few_points_and_is_nowhere_far() {
        let wave = (0..8001).map(|i| (i, (1000.0 * libm::sin(f64::from(i) * 0.002)) as i32));
        let course = one(&every(wave), 1500);
        assert!((course.off, course.bands.len()) == (1.0, 0));
        assert!(course.lines[0].len() < 250, "{}", course.lines[0].len());
    }

    #[test]
    fn a_chatter_is_a_band_and_what_is_around_it_a_line() {
        // up and down at each tick between 2000 and 4000
        let height = |i: i32| match i {
            2000..4000 => 100 * (i % 2),
            _ => 50,
        };
        let signal = every((0..6000).map(|i| (i, height(i))));
        let course = one(&signal, 1500);
        assert_eq!((course.lines.len(), course.bands.len()), (2, 1));
        assert!(course.weight() < 40, "{course:?}");
        let edges = [vec![(2000, 0), (4000, 0)], vec![(2000, 100), (4000, 100)]];
        assert_eq!(course.bands[0], edges);
        assert_eq!(read(&course, 3000), Some((0.0, 100.0)));
        assert_eq!(read(&course, 1000), Some((50.0, 50.0)));
    }

    #[test]
    fn however_few_points_there_are_a_fast_wave_is_no_slow_one() {
        let wave = |i: i32| (i, (700.0 * libm::sin(f64::from(i) * 0.3)) as i32);
        let signal = every((0..5520).map(wave));
        let course = one(&signal, 200);
        assert!(course.lines.is_empty() && course.weight() <= 250);
        // at any place it is read as going from low to high
        for x in (100..5400).step_by(37) {
            let (low, high) = read(&course, x).expect("a band");
            assert!(low < -600.0 && high > 600.0, "{x}: {low} to {high}");
        }
    }

    #[test]
    fn the_heaviest_of_a_picture_gives_way() {
        let noise = |i: i32| {
            (
                i,
                (i.wrapping_mul(7_919) ^ (i >> 3).wrapping_mul(104_729)) % 400,
            )
        };
        let smooth = every((0..5520).map(|i| (i, i / 10)));
        let noisy = every((0..5520).map(noise));
        let found = courses(&[smooth.clone(), noisy.clone()], 600);
        assert!((found[0].off - 1.0).abs() < 1e-9 && found[1].off > 1.0);
        holds(&found[0], &smooth);
        holds(&found[1], &noisy);
    }

    #[test]
    fn a_level_line_is_two_points_and_a_step_four() {
        let level = every((0..8001).map(|i| (i, 5)));
        assert_eq!(one(&level, 1500).lines, [vec![(0, 5), (8000, 5)]]);
        let step = every((0..9).map(|i| (i, 0)).chain((8..20).map(|i| (i, 100))));
        let corners = vec![(0, 0), (8, 0), (8, 100), (19, 100)];
        assert_eq!(one(&step, 1500).lines, [corners]);
    }

    #[test]
    fn a_gap_breaks_the_line_where_it_can_be_seen() {
        let points = |to: i32| [Some((0, 0)), None, None, Some((to, 1))];
        let lines = |signal: &[Option<Point>]| course(signal, CARES[0]).lines;
        assert_eq!(lines(&points(15)), [vec![(0, 0)], vec![(15, 1)]]);
        assert_eq!(lines(&points(9)), [vec![(0, 0), (9, 1)]]);
        assert!(lines(&[]).is_empty() && lines(&[None, None]).is_empty());
    }
}
