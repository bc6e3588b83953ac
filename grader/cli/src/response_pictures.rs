//! The pictures of a step response: all signals over the whole run, the rise from near, and the rest from near.

use kinemark_report::plot::{
    Plot, ResponseCurve, ResponsePanel, ResponsePicture, response_picture,
};
use kinemark_sim::control::linear_step::Fed;
use kinemark_toolbox::response::{Analysis, Response, title};

/// Other joints that are drawn, those that move most.
const MOST_OTHERS: usize = 4;
/// How far around the command the rest is drawn at least, as a share of the step.
const NEAR: f64 = 0.03;

/// The pictures of an analysis, the most important one first.
pub(crate) fn response_pictures(analysis: &Analysis) -> Vec<Plot> {
    let mut pictures = vec![whole(analysis)];
    pictures.extend(rise(analysis));
    pictures.extend(rest(analysis));
    let drawn = pictures.iter().map(response_picture);
    drawn.collect()
}

fn labels(analysis: &Analysis) -> Vec<String> {
    let responses = analysis.responses.iter();
    responses
        .filter_map(|response| analysis.label(response))
        .collect()
}

fn signal(analysis: &Analysis, joint: usize) -> String {
    let what = match analysis.settings.fed {
        Fed::Position => "position",
        Fed::Velocity => "velocity",
    };
    format!("{}, {what}", analysis.joints[joint])
}

/// When the only run diverged, if it did \[s\].
fn stopped_s(analysis: &Analysis) -> Option<f64> {
    match &analysis.responses[..] {
        [only] => only.run.divergence.as_ref().map(|at| at.time_s),
        _ => None,
    }
}

/// The longest duration among the responses \[s\].
fn end_s(analysis: &Analysis) -> f64 {
    let durations = analysis
        .responses
        .iter()
        .map(|response| response.settings.duration_s);
    durations.fold(0.0, f64::max)
}

/// What is drawn of a run that diverged: as far around the step as a run that swings ever wider is of interest.
fn near_step(analysis: &Analysis) -> Option<(f64, f64)> {
    let mut diverged = analysis
        .responses
        .iter()
        .filter(|response| response.run.divergence.is_some());
    let response = diverged.next()?;
    let air = 2.0 * response.settings.step.abs();
    let (low, high) = (
        response.start.min(response.command),
        response.start.max(response.command),
    );
    Some((low - air, high + air))
}

fn run_curve(series: usize, response: &Response) -> ResponseCurve<'_> {
    ResponseCurve {
        series,
        is_prediction: false,
        step_s: response.run.step_s,
        values: &response.run.values,
    }
}

/// The runs of the joint, and the linear predictions above them: where both are one, both are seen.
fn joint_panel(analysis: &Analysis, range: Option<(f64, f64)>) -> ResponsePanel<'_> {
    let responses = analysis.responses.iter().enumerate();
    let mut curves: Vec<ResponseCurve<'_>> = responses
        .clone()
        .map(|(i, response)| run_curve(i, response))
        .collect();
    let mut before: Vec<&[f64]> = Vec::new();
    for (series, response) in responses {
        let Some(theory) = &response.theory else {
            continue;
        };
        // gravity and wind are not in the theory: one line stands for all
        if before.contains(&&theory.values[..]) {
            continue;
        }
        before.push(&theory.values);
        curves.push(ResponseCurve {
            series,
            is_prediction: true,
            step_s: response.run.step_s,
            values: &theory.values,
        });
    }
    let joint = analysis.settings.joint;
    let mut commands = analysis.responses.iter().map(|response| response.command);
    let first = commands.next();
    ResponsePanel {
        name: signal(analysis, joint),
        unit: analysis.unit(joint).to_owned(),
        curves,
        // a sweep of the step has no one command
        command: first.filter(|first| commands.all(|command| command.to_bits() == first.to_bits())),
        limit: None,
        range,
    }
}

/// Entries of the other joints of a response that are drawn, in the order of `q`.
fn drawn_others(analysis: &Analysis) -> Vec<usize> {
    let Some(first) = analysis.responses.first() else {
        return Vec::new();
    };
    let most = |i: usize| {
        let deviations = analysis.responses.iter();
        let deviations = deviations.map(|response| response.run.others[i].greatest_deviation.abs());
        deviations.fold(0.0, f64::max)
    };
    let mut others: Vec<usize> = (0..first.run.others.len()).collect();
    others.sort_by(|a, b| most(*b).total_cmp(&most(*a)));
    others.truncate(MOST_OTHERS);
    others.sort_unstable();
    others
}

fn whole(analysis: &Analysis) -> ResponsePicture<'_> {
    let responses = || analysis.responses.iter().enumerate();
    let mut panels = vec![joint_panel(analysis, near_step(analysis))];
    for i in drawn_others(analysis) {
        let curves = responses().map(|(series, response)| ResponseCurve {
            values: &response.run.others[i].values,
            ..run_curve(series, response)
        });
        let joint = analysis.responses[0].run.others[i].joint;
        panels.push(ResponsePanel {
            name: signal(analysis, joint),
            unit: analysis.unit(joint).to_owned(),
            curves: curves.collect(),
            command: Some(analysis.responses[0].run.others[i].command),
            limit: None,
            range: None,
        });
    }
    let efforts = responses().map(|(series, response)| ResponseCurve {
        values: &response.run.effort,
        ..run_curve(series, response)
    });
    let limit = analysis
        .responses
        .first()
        .map(|first| first.run.effort_limit);
    panels.push(ResponsePanel {
        name: format!("{}, effort", analysis.joint()),
        unit: analysis.effort_unit().replace(' ', "\u{a0}"),
        curves: efforts.collect(),
        command: None,
        limit: limit.filter(|limit| limit.is_finite()),
        range: None,
    });
    ResponsePicture {
        title: title(analysis),
        labels: labels(analysis),
        end_s: end_s(analysis),
        stopped_s: stopped_s(analysis),
        panels,
    }
}

/// The first part, in which the joint rises; none where nothing rises, or where the whole run is hardly longer.
fn rise(analysis: &Analysis) -> Option<ResponsePicture<'_>> {
    let rises = analysis
        .responses
        .iter()
        .filter_map(|response| response.measured.rise_s);
    let longest_s = rises.reduce(f64::max)?;
    let steps = analysis
        .responses
        .iter()
        .map(|response| response.run.step_s);
    let least_s = 40.0 * steps.fold(0.0, f64::max);
    let end_s = (2.0 * longest_s).max(least_s);
    (end_s < 0.5 * self::end_s(analysis)).then(|| ResponsePicture {
        title: "The rise, from near".to_owned(),
        labels: labels(analysis),
        end_s,
        stopped_s: None,
        panels: vec![joint_panel(analysis, near_step(analysis))],
    })
}

/// The whole run near the command and the final values; none where nothing comes to rest.
fn rest(analysis: &Analysis) -> Option<ResponsePicture<'_>> {
    let ends = analysis
        .responses
        .iter()
        .filter(|response| response.measured.missing.is_none());
    let ends = ends.filter_map(|response| Some((response.command, response.measured.final_value?)));
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    for (command, end) in ends {
        low = low.min(command).min(end);
        high = high.max(command).max(end);
    }
    let air = NEAR * analysis.settings.step.abs();
    (low <= high).then(|| ResponsePicture {
        title: "The rest, from near".to_owned(),
        labels: labels(analysis),
        end_s: end_s(analysis),
        stopped_s: stopped_s(analysis),
        panels: vec![joint_panel(analysis, Some((low - air, high + air)))],
    })
}
