//! The moments of a run that a storyboard shows: its start and end, the most telling between, and others evenly in time
//! and along the way.

use kinemark_sim::engine::Party;
use kinemark_sim::event::EventKind;
use nalgebra::Vector3;

use crate::grade::{Outcome, TaskGrade};
use crate::graded::TaskRun;
use crate::report::goal::current_goal;
use crate::report::number::{significant, with_unit};

/// Moments of a storyboard.
const MOMENTS: usize = 6;
/// Moments nearer to each other than this part of a run are one.
const APART: f64 = 0.015;
/// Bodies that touch each other before this have stood so from the start \[s\].
const SETTLED_S: f64 = 0.1;
/// Causes that are told of one moment.
const MOST_WORDS: usize = 2;

/// A moment of a run.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Moment {
    /// The tick, one that was recorded.
    pub(super) tick: usize,
    /// What happened then.
    pub(super) words: Vec<String>,
    /// Whether it cost points, or ended the run.
    pub(super) bad: bool,
    /// Where two pressed on each other, in the world \[m\].
    pub(super) touch_m: Option<Vector3<f64>>,
}

/// A moment that might be shown, the more telling the higher its rank.
struct Candidate {
    rank: f64,
    tick: u64,
    words: String,
    bad: bool,
    touch_m: Option<Vector3<f64>>,
}

/// At most six moments in the order of time; none of a run without a tick.
pub(super) fn moments(run: &TaskRun, grade: &TaskGrade) -> Vec<Moment> {
    let Some(last) = run.trace.len().checked_sub(1) else {
        return Vec::new();
    };
    let plain = |tick: usize, words: &str| Moment {
        tick,
        words: vec![words.to_owned()],
        bad: false,
        touch_m: None,
    };
    let mut chosen = vec![plain(0, "start")];
    if last > 0 {
        chosen.push(plain(last, "end"));
    }
    if let (Some(words), Some(end)) = (ended_early(run, grade), chosen.last_mut()) {
        end.words.push(words);
        end.bad = true;
    }
    let mut candidates = candidates(run, grade);
    // equal ranks in the order of time
    candidates.sort_by(|a, b| b.rank.total_cmp(&a.rank).then(a.tick.cmp(&b.tick)));
    let apart = (APART * last as f64) as usize;
    for candidate in candidates {
        let tick = (candidate.tick as usize).min(last);
        let full = chosen.len() >= MOMENTS;
        let near = chosen
            .iter_mut()
            .min_by_key(|moment| moment.tick.abs_diff(tick))
            .filter(|moment| moment.tick.abs_diff(tick) <= apart);
        match near {
            Some(moment)
                if moment
                    .words
                    .iter()
                    .any(|said| said_in(said, &candidate.words)) =>
            {
                // why it cost points says what happened, too
                moment.words.retain(|said| !said_in(said, &candidate.words));
                moment.words.push(candidate.words);
                moment.bad |= candidate.bad;
            }
            Some(moment) if moment.words.len() < MOST_WORDS => {
                moment.words.push(candidate.words);
                moment.bad |= candidate.bad;
                moment.touch_m = moment.touch_m.or(candidate.touch_m);
            }
            Some(_) => {}
            None if !full => chosen.push(Moment {
                tick,
                words: vec![candidate.words],
                bad: candidate.bad,
                touch_m: candidate.touch_m,
            }),
            None => {}
        }
    }
    chosen.sort_by_key(|moment| moment.tick);
    let progress = progress(run);
    // the middle of the longest part that nothing is shown of
    while chosen.len() < MOMENTS {
        let gaps = chosen.windows(2).enumerate();
        let gaps = gaps.filter(|(_, pair)| pair[1].tick - pair[0].tick > 1);
        let long = |pair: &[Moment]| progress[pair[1].tick] - progress[pair[0].tick];
        let widest = gaps.max_by(|(i, a), (j, b)| long(a).total_cmp(&long(b)).then(j.cmp(i)));
        let Some((i, pair)) = widest else {
            break;
        };
        let middle = 0.5 * (progress[pair[0].tick] + progress[pair[1].tick]);
        let tick = progress.partition_point(|done| *done < middle);
        let tick = tick.clamp(pair[0].tick + 1, pair[1].tick - 1);
        chosen.insert(i + 1, plain(tick, ""));
    }
    for moment in &mut chosen {
        moment.words.retain(|words| !words.is_empty());
        // what happened says more than where the arm is; start and end have both
        let only = moment.words.len() < MOST_WORDS && moment.touch_m.is_none() && !moment.bad;
        if only && moment.words.iter().all(|w| w == "end" || w == "start") {
            moment.words.extend(whereabouts(run, moment.tick));
        }
    }
    chosen
}

/// Whether one message tells what another begins with: its first two words.
fn said_in(said: &str, message: &str) -> bool {
    let mut ends = said.match_indices(' ').map(|(at, _)| at);
    ends.nth(1)
        .is_some_and(|end| message.contains(&said[..end]))
}

/// How far a run is at each tick: the mean of the parts of its time and of the TCP's path that are behind it, never less than before.
fn progress(run: &TaskRun) -> Vec<f64> {
    let mut behind_m = 0.0;
    let mut before = None;
    let mut path: Vec<f64> = Vec::with_capacity(run.trace.len());
    for tick in 0..run.trace.len() {
        let p = run.trace.tcp_position(tick);
        if p.iter().all(|x| x.abs() < 1e6) {
            behind_m += before.map_or(0.0, |before: Vector3<f64>| (p - before).norm());
            before = Some(p);
        }
        path.push(behind_m);
    }
    let last = path.len().saturating_sub(1).max(1) as f64;
    let whole_m = behind_m.max(1e-3);
    let done = |(tick, behind_m): (usize, &f64)| tick as f64 / last + behind_m / whole_m;
    path.iter().enumerate().map(done).collect()
}

/// Why the run ended before its time, if it did.
fn ended_early(run: &TaskRun, grade: &TaskGrade) -> Option<String> {
    let stopped = grade
        .stopped
        .as_ref()
        .filter(|stopped| stopped.tick.is_some());
    if let Some(stopped) = stopped {
        return Some(format!("stopped: {}", stopped.message));
    }
    let ends = [EventKind::Diverged, EventKind::Stopped];
    let ended = run.trace.events.iter().find(|e| ends.contains(&e.kind));
    ended.map(|event| run.names().event(&event.kind))
}

fn candidates(run: &TaskRun, grade: &TaskGrade) -> Vec<Candidate> {
    let names = run.names();
    let mut found = Vec::new();
    let mut add = |rank: f64, tick: u64, words: String, bad: bool| {
        found.push(Candidate {
            rank,
            tick,
            words,
            bad,
            touch_m: None,
        });
    };
    // where points were lost, the most first
    for check in &grade.checks {
        if matches!(check.outcome, Outcome::Full | Outcome::NotJudged) {
            continue;
        }
        let told = check.evidence.iter().find_map(|e| Some((e.tick?, e)));
        if let Some((tick, evidence)) = told {
            let lost = (check.max_points - check.points) / check.max_points.max(1e-9);
            let words = format!("{}: {}", check.title, evidence.message);
            add(80.0 + lost, tick, words, true);
        }
    }
    // goals reached: the start of the stay that was judged, if it was there
    for (i, goal) in run.goals.iter().enumerate() {
        let Some((from, to)) = goal.stay else {
            continue;
        };
        // it begins at the edge of the band; where it ends is where the arm stood
        let tick = (to as usize).min(run.trace.len().saturating_sub(1));
        let off_m = (run.trace.tcp_position(tick) - Vector3::from(goal.position_m)).norm();
        if off_m <= goal.full_m {
            add(60.0, from, format!("goal {} reached", i + 1), false);
        } else if off_m <= goal.zero_m {
            let off = with_unit(off_m, "m");
            add(60.0, from, format!("at goal {}, {off} off", i + 1), false);
        }
    }
    let mut told = Vec::new();
    for event in &run.trace.events {
        let rank = match event.kind {
            EventKind::BodyFell { .. } => 90.0,
            EventKind::Toppled { .. } => 55.0,
            EventKind::LimitHit { .. } => 40.0,
            EventKind::Moved { .. } => 35.0,
            EventKind::LeftSupport { .. } => 30.0,
            EventKind::Saturated { .. } | EventKind::SpeedLimitHit { .. } => 20.0,
            EventKind::NearSingular => 15.0,
            EventKind::Touched { .. } | EventKind::Diverged | EventKind::Stopped => continue,
        };
        let words = names.event(&event.kind);
        // a loop that buzzes at its limit says so a thousand times
        if !told.contains(&words) {
            add(rank, event.tick, words.clone(), false);
            told.push(words);
        }
        if told.len() > 40 {
            break;
        }
    }
    if let Some(divergence) = &run.divergence {
        let far = with_unit(divergence.distance, &divergence.unit);
        let signal = &divergence.signal;
        let words = format!("first differs from the reference: {far} in `{signal}`");
        add(45.0, divergence.tick, words, false);
    }
    // what the arm touched, each pair once; what stood on something from the start is no news
    let mut pairs = Vec::new();
    for contact in &run.trace.contacts {
        let arm = contact.parties.iter().any(|p| matches!(p, Party::Link(_)));
        let settles = !arm && contact.first_tick as f64 * run.trace.step_s < SETTLED_S;
        if settles || pairs.contains(&contact.parties) || pairs.len() > 40 {
            continue;
        }
        pairs.push(contact.parties);
        let [first, second] = contact.parties.map(|party| names.party(party));
        found.push(Candidate {
            rank: if arm { 70.0 } else { 25.0 },
            tick: contact.first_tick,
            words: format!("`{first}` touches `{second}`"),
            bad: false,
            touch_m: Some(contact.p_first_in_world),
        });
    }
    found
}

/// Where the TCP is: how far from the goal it goes to, else its position.
fn whereabouts(run: &TaskRun, tick: usize) -> Option<String> {
    let p = run.trace.tcp_position(tick);
    if !p.iter().all(|x| x.is_finite()) {
        return None;
    }
    if let Some(goal) = current_goal(&run.goals, tick as u64) {
        let far = (p - Vector3::from(run.goals[goal].position_m)).norm();
        let far = with_unit(far, "m");
        return Some(format!("TCP {far} from goal {}", goal + 1));
    }
    let shown = [p.x, p.y, p.z].map(|x| {
        // a thousandth of a millimetre is noise here
        significant((x * 1e4).round() / 1e4, 4)
    });
    Some(format!("TCP at ({}) m", shown.join(", ")))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::sample;

    fn of(run: &TaskRun) -> Vec<Moment> {
        let graded = sample::graded();
        let grade = graded.grade.tasks.iter().find(|task| task.name == "move");
        moments(run, grade.expect("the motion task"))
    }

    #[test]
    fn a_run_is_told_in_six_moments_in_order() {
        let run = sample::task_run();
        let moments = of(&run);
        assert_eq!(moments.len(), 6);
        assert_eq!((moments[0].tick, moments[5].tick), (0, 8000));
        assert!(moments.windows(2).all(|pair| pair[0].tick < pair[1].tick));
        let words: Vec<String> = moments.iter().map(|m| m.words.join("; ")).collect();
        assert!(words[0].starts_with("start"), "{words:?}");
        assert!(words[5].starts_with("end"), "{words:?}");
        assert!(
            words.iter().any(|w| w.contains("goal 1 reached")),
            "{words:?}"
        );
        assert!(
            words.iter().any(|w| w.contains("goal 2 reached")),
            "{words:?}"
        );
        assert!(words.iter().all(|w| !w.is_empty()), "{words:?}");
    }

    #[test]
    fn a_short_run_has_as_many_moments_as_ticks() {
        for (ticks, expected) in [(0, 1), (1, 2), (3, 4), (700, 6)] {
            let moments = of(&sample::stopped_after(ticks));
            assert_eq!(moments.len(), expected, "{ticks}: {moments:?}");
            assert!(moments[expected - 1].bad, "{moments:?}");
        }
        assert_eq!(of(&sample::chain(2, 0, |_, _| 0.0)), []);
    }
}
