//! The moments of a run that a storyboard shows: its start and end, where points were lost, the most telling between, and others
//! evenly in time and along the way.

use kinemark_sim::text::number::seconds;
use kinemark_sim::watch::event::EventKind;
use nalgebra::Vector3;

use super::cause::{Cause, causes};
use super::target::{Target, targets};
use crate::goal::current_goal;
use crate::moment::last_before;
use kinemark_grader::record::grade::TaskGrade;
use kinemark_grader::record::graded::TaskRun;
use kinemark_grader::record::quantity::with_unit;
use kinemark_sim::text::number::typeset;

/// Moments of a storyboard.
const MOMENTS: usize = 6;
/// Moments nearer to each other than this part of a run are one.
const APART: f64 = 0.015;
/// Causes of one moment that are shown in full.
const MOST_WORDS: usize = 2;

/// A moment of a run.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Moment {
    /// The tick, one that was recorded.
    pub(super) tick: usize,
    /// What happened then, a sentence each.
    pub(super) words: Vec<String>,
    /// Whether it cost points, or ended the run.
    pub(super) bad: bool,
    /// Where two pressed on each other, in the world \[m\].
    pub(super) touch_m: Option<Vector3<f64>>,
}

/// A moment in the making.
struct Chosen {
    moment: Moment,
    /// Its causes, the most telling first.
    causes: Vec<Cause>,
}

impl Chosen {
    fn plain(tick: usize, words: &str) -> Self {
        Self {
            moment: Moment {
                tick,
                words: vec![words.to_owned()],
                bad: false,
                touch_m: None,
            },
            causes: Vec::new(),
        }
    }

    /// Adds what also happened here, unless it is there already.
    fn take(&mut self, new: Cause) {
        let is_known = self.causes.iter().any(|cause| match &new.lost {
            Some(_) => cause.lost == new.lost,
            // why it cost points says what happened, too
            None => said_in(&new.words, &cause.words),
        });
        if !is_known {
            self.causes.push(new);
        }
    }

    /// The moment with its causes in words.
    fn into_moment(mut self, step_s: f64) -> Moment {
        let tick = self.moment.tick;
        // the costliest first; of equal ones the more telling
        self.causes.sort_by(|a, b| b.cost.total_cmp(&a.cost));
        let (full, more) = self.causes.split_at(self.causes.len().min(MOST_WORDS));
        let mut words: Vec<String> = full
            .iter()
            .map(|cause| cause.caption_at(tick, step_s))
            .collect();
        let also: Vec<&str> = more.iter().filter_map(|c| c.lost.as_deref()).collect();
        if !also.is_empty() {
            words.push(format!("lost here, too: {}", also.join(", ")));
        }
        self.moment.words.append(&mut words);
        self.moment.bad |= self.causes.iter().any(|cause| cause.lost.is_some());
        let touch_m = full.iter().find_map(|cause| cause.touch_m);
        self.moment.touch_m = self.moment.touch_m.or(touch_m);
        self.moment
    }
}

/// At most six moments in the order of time; none of a run without a tick.
pub(super) fn moments(run: &TaskRun, grade: &TaskGrade) -> Vec<Moment> {
    let Some(last) = run.trace.len().checked_sub(1) else {
        return Vec::new();
    };
    let mut chosen = vec![Chosen::plain(0, "start")];
    if last > 0 {
        chosen.push(Chosen::plain(last, "end"));
    }
    if let Some(words) = ended_early(run, grade) {
        // a run that went on after the stop shows it where it was, and its end as well
        match stopped_at(grade).filter(|tick| *tick > 0 && *tick < last) {
            Some(tick) => chosen.push(Chosen::plain(tick, &words)),
            None => {
                if let Some(end) = chosen.last_mut() {
                    end.moment.words.push(words);
                }
            }
        }
        if let Some(shown) = chosen.last_mut() {
            shown.moment.bad = true;
        }
    }
    let mut causes = causes(run, grade);
    // equal ranks in the order of time
    causes.sort_by(|a, b| b.rank.total_cmp(&a.rank).then(a.tick.cmp(&b.tick)));
    let apart = (APART * last as f64) as usize;
    for cause in causes {
        let tick = (cause.tick as usize).min(last);
        let full = chosen.len() >= MOMENTS;
        let off = |chosen: &Chosen| chosen.moment.tick.abs_diff(tick);
        let near = chosen.iter_mut().min_by_key(|chosen| off(chosen));
        match near.filter(|chosen| off(chosen) <= apart) {
            Some(near) => near.take(cause),
            None if !full => {
                let mut new = Chosen::plain(tick, "");
                new.take(cause);
                chosen.push(new);
            }
            None => {}
        }
    }
    let step_s = run.trace.step_s;
    let mut chosen: Vec<Moment> = chosen.into_iter().map(|c| c.into_moment(step_s)).collect();
    chosen.sort_by_key(|moment| moment.tick);
    let progress = progress(run);
    // the middle of the longest part that nothing is shown of, not near to what is shown as long as there is another
    let mut air = last / (2 * MOMENTS);
    while chosen.len() < MOMENTS {
        let gaps = chosen.windows(2).enumerate();
        let gaps = gaps.filter(|(_, pair)| pair[1].tick - pair[0].tick > 2 * air + 1);
        let long = |pair: &[Moment]| progress[pair[1].tick] - progress[pair[0].tick];
        let widest = gaps.max_by(|(i, a), (j, b)| long(a).total_cmp(&long(b)).then(j.cmp(i)));
        let Some((i, pair)) = widest else {
            if air == 0 {
                break;
            }
            air = 0;
            continue;
        };
        let middle = 0.5 * (progress[pair[0].tick] + progress[pair[1].tick]);
        let tick = progress.partition_point(|done| *done < middle);
        let tick = tick.clamp(pair[0].tick + air + 1, pair[1].tick - air - 1);
        chosen.insert(i + 1, Chosen::plain(tick, "").moment);
    }
    let targets = targets(run);
    for moment in &mut chosen {
        moment.words.retain(|words| !words.is_empty());
        // what happened says more than where the arm is; start and end have both
        let only = moment.words.len() < MOST_WORDS && moment.touch_m.is_none() && !moment.bad;
        if only && moment.words.iter().all(|w| w == "end" || w == "start") {
            moment.words.extend(whereabouts(run, &targets, moment.tick));
        }
    }
    chosen
}

/// Whether one message contains the beginning of another: its first two words.
fn said_in(said: &str, message: &str) -> bool {
    let mut ends = said.match_indices(' ').map(|(at, _)| at);
    ends.nth(1)
        .is_some_and(|end| message.contains(&said[..end]))
}

/// How far a run is at each tick: the mean of the parts of its time, which counts twice, and of the TCP's path that are behind it, never
/// less than before. So a step that is over soon leaves some moments for the rest of the run.
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
    let done = |(tick, behind_m): (usize, &f64)| 2.0 * tick as f64 / last + behind_m / whole_m;
    path.iter().enumerate().map(done).collect()
}

/// The tick that shows where the submission was stopped: the one before the call that failed.
fn stopped_at(grade: &TaskGrade) -> Option<usize> {
    let before = last_before(grade.stopped.as_ref()?)?;
    Some(before.tick as usize)
}

/// Why the run ended before its time, if it did. What is shown of the end is the tick before the call that failed.
fn ended_early(run: &TaskRun, grade: &TaskGrade) -> Option<String> {
    if let Some(stopped) = &grade.stopped
        && last_before(stopped).is_some()
    {
        let at = seconds(stopped.time_s.unwrap_or_default());
        let line = stopped
            .line
            .map_or(String::new(), |line| format!(" (line {line})"));
        return Some(format!("stopped at {at}: {}{line}", stopped.message));
    }
    let ends = [EventKind::Diverged, EventKind::Stopped];
    let ended = run.trace.events.iter().find(|e| ends.contains(&e.kind));
    ended.map(|event| run.names().event(&event.kind))
}

/// Where the TCP is: how far from the goal it goes to; of a step response where the joint is; else its position.
fn whereabouts(run: &TaskRun, targets: &[Target], tick: usize) -> Option<String> {
    let p = run.trace.tcp_position(tick);
    if !p.iter().all(|x| x.is_finite()) {
        return None;
    }
    if let Some(goal) = current_goal(&run.goals, tick as u64) {
        let far = (p - Vector3::from(run.goals[goal].position_m)).norm();
        let far = with_unit(far, "m");
        return Some(format!("TCP {far} from goal {}", goal + 1));
    }
    if !targets.is_empty() {
        let words: Vec<String> = targets.iter().map(|t| t.describe(run, tick)).collect();
        return Some(words.join(", "));
    }
    let shown = [p.x, p.y, p.z].map(|x| {
        // a thousandth of a millimetre is noise here
        typeset((x * 1e4).round() / 1e4, 4)
    });
    Some(format!("TCP at ({}) m", shown.join(", ")))
}

#[cfg(test)]
mod tests {
    use super::*;
    use kinemark_grader::record::grade::{CheckGrade, Divergence, Evidence, Instant};
    use kinemark_grader::record::sample;

    fn of(run: &TaskRun) -> Vec<Moment> {
        let graded = sample::graded();
        let grade = graded.grade.tasks.iter().find(|task| task.name == "move");
        moments(run, grade.expect("the motion task"))
    }

    #[test]
    fn a_run_is_shown_in_six_moments_in_order() {
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
        assert!(words.iter().all(|w| !w.is_empty()), "{words:?}");
    }

    fn lost(name: &str, cost: f64, ticks: &[u64]) -> CheckGrade {
        let graded = sample::graded();
        let check = &graded.grade.tasks[3].checks[3];
        let evidence = ticks.iter().map(|tick| Evidence {
            message: format!("{name} at tick {tick}"),
            tick: Some(*tick),
            time_s: Some(*tick as f64 / 1000.0),
            ..check.evidence[0].clone()
        });
        let first = ticks.iter().min().map(|tick| Instant {
            tick: *tick,
            time_s: *tick as f64 / 1000.0,
        });
        CheckGrade {
            name: name.to_owned(),
            title: format!("Check {name}"),
            points: 0.0,
            max_points: cost,
            first_lost: first,
            evidence: evidence.collect(),
            ..check.clone()
        }
    }

    fn captions(checks: Vec<CheckGrade>) -> Vec<String> {
        let mut graded = sample::graded();
        let grade = &mut graded.grade.tasks[3];
        grade.checks = checks;
        let moments = moments(&sample::task_run(), grade);
        assert!(moments.len() == 6, "{moments:?}");
        moments
            .iter()
            .map(|moment| moment.words.join("; "))
            .collect()
    }

    #[test]
    fn the_costliest_losses_and_the_first_come_before_all_else() {
        let captions = captions(vec![
            lost("first", 0.1, &[300]),
            lost("cheap", 0.5, &[1500]),
            lost("dear", 6.0, &[7000, 4000]),
            lost("middling", 2.0, &[5500]),
            lost("cheaper", 0.4, &[6300]),
        ]);
        assert_eq!(
            captions[1],
            "lost: Check first (0 of 0.1): first at tick 300"
        );
        assert_eq!(
            captions[2],
            "lost: Check cheap (0 of 0.5): cheap at tick 1500"
        );
        assert!(
            captions[3].starts_with("lost: Check middling (0 of 2)"),
            "{captions:?}"
        );
        assert!(
            captions[4].starts_with("lost: Check dear (0 of 6)"),
            "{captions:?}"
        );
        // no more room: neither the cheapest check nor a goal
        assert!(
            !captions.iter().any(|words| words.contains("cheaper")),
            "{captions:?}"
        );
    }

    #[test]
    fn causes_of_one_moment_share_a_panel_the_costliest_first() {
        let captions = captions(vec![
            lost("small", 1.0, &[8000]),
            lost("large", 6.0, &[8000]),
            lost("late", 2.0, &[7950]),
            lost("untimed", 3.0, &[]),
        ]);
        assert_eq!(
            captions[5],
            "end; lost: Check large (0 of 6): large at tick 8000; \
             lost at 7.95 s: Check late (0 of 2): late at tick 7950; lost here, too: Check small (0 of 1)"
        );
    }

    #[test]
    fn a_loss_begins_where_the_band_was_left() {
        let mut check = lost("slow", 2.0, &[5000]);
        check.first_lost = Some(Instant {
            tick: 1900,
            time_s: 1.9,
        });
        let captions = captions(vec![check]);
        let began = "lost: Check slow (0 of 2): beyond 50.0 mm from here on";
        assert!(
            captions.iter().any(|words| words.starts_with(began)),
            "{captions:?}"
        );
    }

    #[test]
    fn the_reference_is_described_in_words_and_with_its_own_time() {
        let mut run = sample::task_run();
        run.divergence = Some(Divergence {
            tick: 50,
            time_s: 0.05,
            signal: "q[1]".to_owned(),
            yours: vec![0.1],
            reference: vec![0.2],
            distance: 0.1,
            tolerance: 0.02,
            unit: "rad".to_owned(),
            message: String::new(),
        });
        assert_eq!(
            of(&run)[0].words[..2],
            [
                "start",
                "at 0.05 s: first differs from the reference: joint elbow is 0.1 rad off"
            ]
        );
    }

    #[test]
    fn moments_between_are_spread_over_a_run_that_moves_at_its_start_only() {
        let run = sample::chain(2, 8000, |tick, joint| {
            (joint as f64 + 1.0) * (tick.min(200) as f64) / 200.0
        });
        let mut graded = sample::graded();
        let grade = &mut graded.grade.tasks[3];
        grade.checks.clear();
        let moments = moments(&run, grade);
        assert_eq!(moments.len(), 6);
        let apart = moments.windows(2).map(|pair| pair[1].tick - pair[0].tick);
        assert!(apart.min() > Some(600), "{moments:?}");
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
