//! An analysis as JSON: all of its numbers, and the curves where they are wanted.

use kinemark_sim::control::Derivative;
use kinemark_sim::control::linear_step::Fed;
use serde_json::{Map, Value, json};

use super::analysis::{Analysis, Measured, NoMeasure, Response};
use super::linear_theory::LinearTheory;
use super::settings::ResponseSettings;
use super::stability_limit::StabilityLimit;

/// The numbers of an analysis. Angles in rad, lengths in m, times in s, efforts in N m or N; a number that does not exist or is infinite
/// is null.
pub fn response_record(analysis: &Analysis) -> Value {
    let responses = analysis.responses.iter();
    let responses = responses.map(|response| one(analysis, response));
    json!({
        "robot": analysis.robot,
        "joint": analysis.joint(),
        "of": match analysis.settings.fed {
            Fed::Position => "position",
            Fed::Velocity => "velocity",
        },
        "unit": analysis.unit(analysis.settings.joint),
        "sweep": analysis.varied.map(|varied| varied.name()),
        "responses": responses.collect::<Vec<Value>>(),
    })
}

fn one(analysis: &Analysis, response: &Response) -> Value {
    let mut run = of_measured(&response.measured);
    let curves = &response.run;
    let others = curves.others.iter().map(|other| {
        json!({
            "joint": analysis.joints[other.joint],
            "unit": analysis.unit(other.joint),
            "greatest_deviation": other.greatest_deviation,
            "at_s": other.at_s,
            "last_deviation": other.last_deviation,
        })
    });
    run.insert("peak_effort".to_owned(), json!(curves.peak_effort()));
    run.insert("is_limited".to_owned(), json!(curves.is_limited()));
    run.insert("others".to_owned(), others.collect());
    let divergence = curves.divergence.as_ref();
    let divergence = divergence.map(|at| json!({ "time_s": at.time_s, "how": at.how }));
    run.insert("divergence".to_owned(), json!(divergence));
    json!({
        "value": response.value,
        "settings": of_settings(&response.settings),
        "start": response.start,
        "command": response.command,
        "run": run,
        "linear": response.theory.as_ref().map(of_theory),
        "stability": response.stability.as_ref().map(|limit| of_stability(analysis, limit)),
    })
}

fn of_settings(settings: &ResponseSettings) -> Value {
    let around = &settings.surroundings;
    json!({
        "step": settings.step,
        "kp": settings.gains.kp,
        "ki": settings.gains.ki,
        "kd": settings.gains.kd,
        "derivative": match settings.derivative {
            Derivative::Error => "error",
            Derivative::Measurement => "measurement",
            Derivative::Velocity => "velocity",
        },
        "gravity_compensation": settings.gravity_compensation,
        "servo_period_s": settings.servo_period_s,
        "duration_s": settings.duration_s,
        "gravity_m_s2": around.gravity_m_s2,
        "wind_m_s": around.wind_m_s,
        "drag": around.drag.map(|drag| json!({ "area_m2": drag.area_m2, "coefficient": drag.coefficient })),
        "dry_friction": around.dry_friction,
    })
}

fn of_measured(measured: &Measured) -> Map<String, Value> {
    let missing = measured.missing.map(|missing| match missing {
        NoMeasure::Diverged => "diverged",
        NoMeasure::HardlyMoved => "hardly-moved",
        NoMeasure::Unsettled => "unsettled",
    });
    let entries = [
        ("at_once", json!(measured.at_once)),
        ("final", json!(measured.final_value)),
        ("last", json!(measured.last_value)),
        ("peak", json!(measured.peak)),
        ("final_less_command", json!(measured.beyond_command)),
        ("rise_s", json!(measured.rise_s)),
        ("settling_s", json!(measured.settling_s)),
        ("overshoot", json!(measured.overshoot)),
        ("missing", json!(missing)),
    ];
    entries
        .map(|(name, value)| (name.to_owned(), value))
        .into_iter()
        .collect()
}

fn of_theory(theory: &LinearTheory) -> Value {
    let mut record = of_measured(&theory.measured);
    let more = [
        ("inertia", json!(theory.linear_loop.inertia_kg_m2)),
        ("damping", json!(theory.linear_loop.damping_n_m_s)),
        ("is_bounded", json!(theory.linear_loop.is_bounded())),
        (
            "natural_frequency_rad_s",
            json!(theory.natural_frequency_rad_s()),
        ),
        ("damping_ratio", json!(theory.damping_ratio())),
        ("share_at_once", json!(theory.share_at_once())),
        (
            "share_by_proportional",
            json!(theory.share_by_proportional()),
        ),
        ("time_constant_s", json!(theory.time_constant_s())),
    ];
    record.extend(more.map(|(name, value)| (name.to_owned(), value)));
    Value::Object(record)
}

fn of_stability(analysis: &Analysis, limit: &StabilityLimit) -> Value {
    let gains = limit
        .gains
        .iter()
        .map(|gain| (gain.name.to_owned(), json!(gain.limit)));
    json!({
        "is_stable": limit.is_stable,
        "growth": limit.growth,
        "worst_joint": analysis.joints[limit.worst_joint],
        "share_of_all_gains": limit.share_of_all,
        "limits": gains.collect::<Map<String, Value>>(),
        "servo_period_s": limit.period_s,
    })
}
