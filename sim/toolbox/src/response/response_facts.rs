//! An analysis for people: what was analysed, the table of measures, and what the table does not say.

use kinemark_sim::control::Derivative;
use kinemark_sim::control::linear_step::Fed;
use kinemark_sim::text::number::{seconds, short, significant};

use super::analysis::{Analysis, NoMeasure, Response};
use super::response_run::OtherJoint;
use super::response_table::response_table;
use super::stability_limit::{GainLimit, StabilityLimit};
use super::sweep::Varied;
use crate::styled_text::{Emphasis, StyledText};

/// Width of the labels before the facts.
const LABEL_WIDTH: usize = 10;
/// Width of a line.
const WIDEST: usize = 100;
/// Other joints that are listed, those that move most.
const MOST_OTHERS: usize = 6;

/// What there is to say of a response, if there is something.
type Words = fn(&Analysis, &Response) -> Option<String>;

/// What an analysis shows, in one line.
pub fn title(analysis: &Analysis) -> String {
    let what = match analysis.settings.fed {
        Fed::Position => "position",
        Fed::Velocity => "velocity",
    };
    let (joint, robot) = (analysis.joint(), &analysis.robot);
    format!("Step response of joint `{joint}` of {robot}: {what}")
}

/// Labels and facts: what was analysed, the theory, how the other joints moved, and where the loop is stable.
pub fn facts(analysis: &Analysis) -> Vec<(String, String)> {
    let mut facts = vec![
        ("step".to_owned(), step(analysis)),
        ("servos".to_owned(), servos(analysis)),
        ("around".to_owned(), surroundings(analysis)),
    ];
    let kinds: [(&str, Words); 5] = [
        ("theory", theory_words),
        ("run", missing),
        ("run", drift),
        ("others", others),
        ("stability", stability),
    ];
    for (what, words) in kinds {
        let of_each = analysis.responses.iter();
        let of_each = of_each.map(|response| (analysis.label(response), words(analysis, response)));
        facts.extend(
            together(of_each.collect())
                .into_iter()
                .map(|words| (what.to_owned(), words)),
        );
    }
    facts
}

/// What there is to say of each value of a sweep, with the value before it; what is the same for all is said once.
fn together(of_each: Vec<(Option<String>, Option<String>)>) -> Vec<String> {
    let first = of_each.first().and_then(|(_, words)| words.clone());
    if of_each.iter().all(|(_, words)| *words == first) {
        return first.into_iter().collect();
    }
    let said = of_each
        .into_iter()
        .filter_map(|(label, words)| match label {
            Some(label) => Some(format!("{label}: {}", words?)),
            None => words,
        });
    said.collect()
}

/// An analysis as text for people.
pub fn response_text(analysis: &Analysis) -> StyledText {
    let mut text = StyledText::default();
    text.push(Emphasis::Strong, title(analysis));
    text.plain("\n\n");
    let lines = response_table(analysis).lines();
    for (i, line) in lines.iter().enumerate() {
        let emphasis = if i == 0 {
            Emphasis::Faint
        } else {
            Emphasis::Plain
        };
        text.push(emphasis, line.as_str());
        text.plain("\n");
    }
    text.plain("\n");
    let indent = " ".repeat(LABEL_WIDTH + 1);
    let mut before = String::new();
    for (label, fact) in facts(analysis) {
        let shown = if label == before { "" } else { &label };
        text.push(Emphasis::Faint, format!("{shown:<LABEL_WIDTH$}"));
        let options = textwrap::Options::new(WIDEST)
            .initial_indent(&indent)
            .subsequent_indent(&indent)
            .break_words(false);
        let wrapped = textwrap::fill(&fact, options);
        text.plain(format!(" {}\n", wrapped.trim_start()));
        before = label;
    }
    text
}

fn step(analysis: &Analysis) -> String {
    let settings = &analysis.settings;
    let unit = analysis.unit(settings.joint);
    let (Some(first), joint) = (analysis.responses.first(), analysis.joint()) else {
        return String::new();
    };
    let from = short(first.start);
    let to = swept_or(analysis, Varied::Step, first.command);
    let stays = match settings.fed {
        Fed::Position => "all other joints are commanded to stay at their start",
        Fed::Velocity => "all other joints are commanded to velocity 0",
    };
    let alone = if analysis.joints.len() > 1 {
        format!("; {stays}")
    } else {
        String::new()
    };
    let duration = seconds(settings.duration_s);
    format!("`{joint}` from {from} {unit} to {to} {unit}, {duration}{alone}")
}

/// A number of the settings, or that it is what the sweep varies.
fn swept_or(analysis: &Analysis, varied: Varied, value: f64) -> String {
    if analysis.varied == Some(varied) {
        "(swept)".to_owned()
    } else {
        short(value)
    }
}

fn servos(analysis: &Analysis) -> String {
    let settings = &analysis.settings;
    let gains = settings.gains;
    let swept = |varied: Varied, value: f64| swept_or(analysis, varied, value);
    let kp = swept(Varied::Kp, gains.kp);
    let (ki, kd) = (swept(Varied::Ki, gains.ki), swept(Varied::Kd, gains.kd));
    let period = swept(Varied::ServoPeriodMs, 1000.0 * settings.servo_period_s);
    let every = if analysis.joints.len() > 1 {
        " on every joint"
    } else {
        ""
    };
    let of = match settings.derivative {
        Derivative::Error => "error",
        Derivative::Measurement => "measurement",
        Derivative::Velocity => "velocity",
    };
    let limit = analysis
        .responses
        .first()
        .map(|first| first.run.effort_limit);
    let limit = match limit.filter(|limit| limit.is_finite()) {
        Some(limit) => format!("at most {} {}", short(limit), analysis.effort_unit()),
        None => "no effort limit".to_owned(),
    };
    let compensation = if settings.gravity_compensation {
        ", gravity compensation"
    } else {
        ""
    };
    format!(
        "kp {kp}, ki {ki}, kd {kd}{every}; derivative of the {of}, sampled every {period} ms, {limit}{compensation}"
    )
}

fn surroundings(analysis: &Analysis) -> String {
    let around = &analysis.settings.surroundings;
    let gravity = swept_or(analysis, Varied::Gravity, around.gravity_m_s2);
    let mut words = format!("gravity {gravity} m/s²");
    if analysis.varied == Some(Varied::Wind) {
        words += ", wind (swept) m/s along x";
    } else if let Some([x, y, z]) = around.wind_m_s {
        words += &format!(", wind ({}, {}, {}) m/s", short(x), short(y), short(z));
    }
    if let Some(drag) = around.drag {
        let (area, coefficient) = (short(drag.area_m2), short(drag.coefficient));
        words += &format!(", drag of every link {area} m² with coefficient {coefficient}");
    }
    if around.dry_friction > 0.0 || analysis.varied == Some(Varied::Friction) {
        let friction = swept_or(analysis, Varied::Friction, around.dry_friction);
        words += &format!(
            ", dry friction of {friction} {} more in every joint",
            analysis.effort_unit()
        );
    }
    words
}

fn theory_words(analysis: &Analysis, response: &Response) -> Option<String> {
    let theory = response.theory.as_ref()?;
    let linear = &theory.linear_loop;
    let revolute = analysis.revolute[analysis.settings.joint];
    let (inertia_unit, damping_unit) = if revolute {
        ("kg m²", "N m s/rad")
    } else {
        ("kg", "N s/m")
    };
    let mut words = format!(
        "the joint alone, all others held: {} {inertia_unit}, damping {} {damping_unit}",
        short(linear.inertia_kg_m2),
        short(linear.damping_n_m_s)
    );
    if let (Some(frequency), Some(ratio)) =
        (theory.natural_frequency_rad_s(), theory.damping_ratio())
    {
        let (frequency, ratio) = (short(frequency), short(ratio));
        words += &format!("; natural frequency {frequency} rad/s, damping ratio {ratio}");
    }
    if let (Some(at_once), Some(to), Some(time_s)) = (
        theory.share_at_once(),
        theory.share_by_proportional(),
        theory.time_constant_s(),
    ) {
        if at_once > 0.0 {
            words += &format!("; {at_once:.5} of the step at once, then");
        } else {
            words += ";";
        }
        let time = significant(time_s, 3);
        words += &format!(" to {to:.5} of it with a time constant of {time} s");
        if linear.ki > 0.0 {
            words += ", the rest by the integral";
        }
    }
    if !linear.is_bounded() {
        words += "; it swings ever wider: (damping + kd) kp is less than inertia times ki";
    }
    Some(words)
}

/// Why the run has no measures.
fn missing(_: &Analysis, response: &Response) -> Option<String> {
    if let Some(divergence) = &response.run.divergence {
        return Some(format!(
            "diverges at {}: {}",
            seconds(divergence.time_s),
            divergence.how.trim_end_matches(',')
        ));
    }
    match response.measured.missing? {
        NoMeasure::Diverged => Some("its numbers are not finite".to_owned()),
        NoMeasure::HardlyMoved => Some("hardly moves towards its command: no rise, settling and overshoot".to_owned()),
        NoMeasure::Unsettled => Some("never settles: in the last 0.2 s it still goes further than 5 % of its step from its mean".to_owned()),
    }
}

/// That the run still moves at its end, where the last value and the mean at the end differ in the digits of the table.
fn drift(analysis: &Analysis, response: &Response) -> Option<String> {
    let measured = &response.measured;
    let end = measured.final_value?;
    let apart = (measured.last_value - end).abs();
    if apart < 5e-5 * response.settings.step.abs() || measured.missing.is_some() {
        return None;
    }
    let unit = analysis.unit(analysis.settings.joint);
    Some(format!(
        "still moves at its end: {:.5} {unit} at {}, where the mean over the last 0.2 s is {end:.5} {unit}",
        measured.last_value,
        seconds(response.settings.duration_s)
    ))
}

fn others(analysis: &Analysis, response: &Response) -> Option<String> {
    let mut others: Vec<&OtherJoint> = response.run.others.iter().collect();
    others.sort_by(|a, b| {
        let sizes = [a, b].map(|other| other.greatest_deviation.abs());
        sizes[1].total_cmp(&sizes[0])
    });
    let words = others.iter().take(MOST_OTHERS).map(|other| {
        format!(
            "`{}` is off its command by {:.4} {} at most, at {}, and by {:.5} at the end",
            analysis.joints[other.joint],
            other.greatest_deviation.abs(),
            analysis.unit(other.joint),
            seconds(other.at_s),
            other.last_deviation.abs()
        )
    });
    let mut words: Vec<String> = words.collect();
    if others.len() > MOST_OTHERS {
        words.push("all others less".to_owned());
    }
    (!words.is_empty()).then(|| words.join("; "))
}

fn stability(analysis: &Analysis, response: &Response) -> Option<String> {
    let limit = response.stability.as_ref()?;
    let period = short(1000.0 * response.settings.servo_period_s);
    let now = if limit.is_stable {
        format!("stable at a servo period of {period} ms")
    } else {
        let joint = &analysis.joints[limit.worst_joint];
        format!(
            "unstable at a servo period of {period} ms, where it grows by a factor of {:.2} a sample, `{joint}` most",
            limit.growth
        )
    };
    let up_to_period = match limit.period_s {
        None => "with these gains at no servo period".to_owned(),
        Some(limit_s) if limit_s.is_infinite() => "with these gains at any servo period".to_owned(),
        Some(limit_s) => format!(
            "with these gains up to a servo period of {} ms",
            short(1000.0 * limit_s)
        ),
    };
    Some(format!("{now}; {}; {up_to_period}", up_to_gains(limit)))
}

/// Up to which gains the loop is stable.
fn up_to_gains(limit: &StabilityLimit) -> String {
    let stable: Vec<&GainLimit> = limit
        .gains
        .iter()
        .filter(|gain| gain.limit.is_some())
        .collect();
    if stable.is_empty() {
        return match limit.share_of_all {
            Some(share) if share < 1.0 => format!(
                "no single gain makes it stable, all gains together do at {} of what they are",
                significant(share, 3)
            ),
            _ => "no gain makes it stable".to_owned(),
        };
    }
    let each = stable.iter().filter_map(|gain| {
        let value = gain.limit?;
        Some(match value.is_infinite() {
            true => format!("any {}", gain.name),
            false => format!("{} {}", gain.name, short(value)),
        })
    });
    let each = each.collect::<Vec<_>>().join(", ");
    format!("changing one gain on every joint, stable up to {each}")
}
