//! Step responses of the course's arm: the numbers of the exercise, found independently of this program.

use kinemark_sim::control::Derivative;
use kinemark_sim::control::linear_step::Fed;
use kinemark_sim::model::air::Drag;
use kinemark_sim::model::robot::Robot;
use kinemark_sim::text::number::short;
use kinemark_toolbox::response::{
    Analysis, NoMeasure, PidGains, Response, ResponseSettings, Surroundings, Sweep, analyse,
    joint_entry, response_record, response_table, response_text,
};

use crate::{robot_of, rrbot, uarm};

/// The elbow to 1 rad with the gains of the exercise, on Earth, at a kilohertz.
fn exercise() -> ResponseSettings {
    ResponseSettings {
        joint: 1,
        fed: Fed::Position,
        step: 1.0,
        gains: PidGains {
            kp: 100.0,
            ki: 0.01,
            kd: 10.0,
        },
        derivative: Derivative::Measurement,
        gravity_compensation: false,
        effort_limit: Vec::new(),
        start: Vec::new(),
        servo_period_s: 1e-3,
        duration_s: 5.0,
        surroundings: Surroundings {
            gravity_m_s2: 9.81,
            wind_m_s: None,
            drag: None,
            dry_friction: 0.0,
        },
    }
}

fn analysed(settings: &ResponseSettings) -> Analysis {
    analyse(&rrbot(), settings, None).unwrap_or_else(|error| panic!("{error}"))
}

fn response(settings: &ResponseSettings) -> Response {
    analysed(settings).responses.remove(0)
}

fn rrbot_without_speed_limits() -> Robot {
    let text = include_str!("../../../labs/robots/rrbot.toml");
    robot_of(
        &text
            .replace("speed = 20.0, ", "")
            .replace("lower = -6.3, upper = 6.3, ", ""),
    )
}

#[track_caller]
fn near(got: Option<f64>, expected: f64, tolerance: f64) {
    let got = got.expect("a number");
    assert!(
        (got - expected).abs() <= tolerance,
        "{got} against {expected}"
    );
}

/// `tests/golden/B_linear_step.json`, "J of the actual 0.05 box section": exact partial fractions.
#[test]
fn linear_theory_has_the_measures_of_partial_fractions() {
    let of = |derivative| {
        let settings = ResponseSettings {
            derivative,
            ..exercise()
        };
        response(&settings).theory.expect("a theory").measured
    };
    let on_error = of(Derivative::Error);
    near(on_error.rise_s, 0.029_894, 1e-6);
    near(on_error.overshoot, 0.052_646, 2e-6);
    near(on_error.settling_s, 0.189_620, 5e-6);
    let on_measurement = of(Derivative::Measurement);
    // the final value is that of the last 0.2 s: 1e-5 of the step off
    near(on_measurement.rise_s, 0.201_114, 1e-5);
    near(on_measurement.settling_s, 0.365_782, 1e-4);
    near(on_measurement.final_value, 1.0, 2e-5);
}

#[test]
fn a_velocity_loop_jumps_and_creeps_in_theory() {
    let theory = response(&ResponseSettings {
        fed: Fed::Velocity,
        derivative: Derivative::Error,
        ..exercise()
    });
    let theory = theory.theory.expect("a theory");
    assert!((theory.measured.at_once - 0.983_596).abs() < 1e-6);
    near(theory.share_at_once(), 0.983_596, 1e-6);
    // 100 / 100.7; the integral adds 3e-6 in 5 s
    near(theory.share_by_proportional(), 0.993_049, 1e-6);
    near(theory.time_constant_s(), 0.101, 1e-4);
    near(theory.measured.final_value, 0.993_052, 1e-6);
    assert_eq!(theory.measured.rise_s, Some(0.0));
    assert_eq!(theory.natural_frequency_rad_s(), None);
}

/// `tests/golden/B_nonlinear_position.json`, `pos_zoh_1kHz_D_on_measurement`.
#[test]
fn the_run_has_the_measures_of_another_integrator() {
    let response = response(&exercise());
    let measured = response.measured;
    near(measured.final_value, 1.021_202, 2e-6);
    near(measured.rise_s, 0.231_68, 1e-4);
    near(measured.overshoot, 0.004_685, 1e-5);
    near(measured.beyond_command, 0.021_202, 2e-6);
    near(measured.settling_s, 0.351, 1e-3);
    let shoulder = &response.run.others[0];
    assert_eq!(shoulder.joint, 0);
    assert!((shoulder.greatest_deviation.abs() - 0.1003).abs() < 1e-4);
    assert!((shoulder.at_s - 0.087).abs() < 1e-9);
    assert!(response.run.is_limited());
    // the limit of the robot file
    assert!((response.run.peak_effort() - 100.0).abs() < 1e-12);
}

/// `tests/golden/B_nonlinear_velocity.json`: the loop without derivative at ten kilohertz, and with it at one.
#[test]
fn velocity_loops_run_where_they_are_sampled_fast_enough() {
    let slow = ResponseSettings {
        fed: Fed::Velocity,
        derivative: Derivative::Error,
        effort_limit: vec![1e9],
        ..exercise()
    };
    // at the robot's own speed limit it swings to and fro
    let held = response(&slow);
    assert_eq!(held.measured.missing, Some(NoMeasure::Unsettled));
    let diverged = analyse(&rrbot_without_speed_limits(), &slow, None)
        .unwrap_or_else(|error| panic!("{error}"))
        .responses
        .remove(0);
    assert_eq!(diverged.measured.missing, Some(NoMeasure::Diverged));
    assert_eq!(diverged.measured.final_value, None);
    let at = diverged.run.divergence.expect("a divergence");
    assert!((at.time_s - 0.002).abs() < 1e-9, "{at:?}");
    let fast = ResponseSettings {
        gains: PidGains {
            kd: 0.0,
            ..slow.gains
        },
        servo_period_s: 1e-4,
        duration_s: 5.0,
        effort_limit: Vec::new(),
        ..slow
    };
    let measured = response(&fast).measured;
    assert!(
        (measured.last_value - 0.969_68).abs() < 1e-5,
        "{measured:?}"
    );
    assert!((measured.peak - 1.017_40).abs() < 1e-5, "{measured:?}");
}

#[test]
fn the_elbow_rests_where_the_surroundings_put_it() {
    let rest = |surroundings, gravity_compensation| {
        let response = response(&ResponseSettings {
            surroundings,
            gravity_compensation,
            ..exercise()
        });
        1000.0 * response.measured.beyond_command.expect("at rest")
    };
    let earth = exercise().surroundings;
    let under = |gravity_m_s2| Surroundings {
        gravity_m_s2,
        ..earth
    };
    // [mrad], to the digits that are printed
    assert!((rest(earth, false) - 21.20).abs() < 0.005);
    assert!((rest(under(1.62), false) - 3.43).abs() < 0.005);
    assert!((rest(under(0.0), false) - 0.01).abs() < 0.005);
    let rough = Surroundings {
        dry_friction: 0.5,
        ..earth
    };
    assert!((rest(rough, true) + 2.10).abs() < 0.005);
    let windy = Surroundings {
        wind_m_s: Some([10.0, 0.0, 0.0]),
        drag: Some(Drag {
            area_m2: 0.05,
            coefficient: 1.1,
        }),
        ..earth
    };
    assert!((rest(windy, false) - 29.43).abs() < 0.005);
    let shoulder = response(&ResponseSettings {
        surroundings: windy,
        ..exercise()
    });
    let at_rest = shoulder.run.others[0].last_deviation;
    near(Some(at_rest), 0.086_06, 5e-6);
}

#[test]
fn at_ten_milliseconds_the_straight_arm_allows_a_third_less_derivative() {
    let settings = ResponseSettings {
        servo_period_s: 0.01,
        // the joint's own velocity; a difference of two samples grows by 1.20 only
        derivative: Derivative::Velocity,
        ..exercise()
    };
    let limit = response(&settings).stability.expect("limits");
    assert!(!limit.is_stable);
    assert_eq!(limit.worst_joint, 1);
    assert_eq!(format!("{:.2}", limit.growth), "1.95");
    let kd = limit
        .gains
        .iter()
        .find(|gain| gain.name == "kd")
        .expect("kd");
    assert_eq!(short(kd.limit.expect("a limit")).get(..3), Some("6.6"));
    assert_eq!(
        format!("{:.1}", 1000.0 * limit.period_s.expect("a period")),
        "6.6"
    );
    let stable = response(&exercise()).stability.expect("limits");
    assert!(stable.is_stable && stable.growth <= 1.0);
}

#[test]
fn a_sweep_has_a_row_for_each_value_and_the_same_numbers_as_alone() {
    let sweep = Sweep::parse("kd=2,10").unwrap();
    let settings = ResponseSettings {
        effort_limit: vec![30.0, 15.0],
        ..exercise()
    };
    let swept = analyse(&rrbot(), &settings, Some(&sweep)).unwrap();
    assert_eq!(swept.responses[1].measured, response(&settings).measured);
    let table = response_table(&swept);
    assert_eq!(table.head[..3], ["kd", "", "final [rad]"]);
    let first: Vec<&str> = table.rows.iter().map(|row| row[0].as_str()).collect();
    assert_eq!(first, ["2", "2", "10", "10"]);
    // 90 ms, 1.190 s and 5.7 % were measured of kd 2 by another program
    assert_eq!(table.rows[1][1], "run");
    assert!(table.rows[1][4].starts_with("90."), "{:?}", table.rows[1]);
    let record = response_record(&swept);
    assert_eq!(record["sweep"], "kd");
    assert_eq!(record["responses"][1]["settings"]["kd"], 10.0);
    let text = response_text(&swept).to_string();
    assert!(
        text.contains("kd 2: stable at a servo period of 1 ms"),
        "{text}"
    );
}

#[test]
fn a_step_backwards_mirrors_the_one_forwards() {
    let settings = ResponseSettings {
        surroundings: Surroundings {
            gravity_m_s2: 0.0,
            ..exercise().surroundings
        },
        ..exercise()
    };
    let forwards = response(&settings).measured;
    let backwards = response(&ResponseSettings {
        step: -1.0,
        ..settings
    });
    let backwards = backwards.measured;
    near(backwards.rise_s, forwards.rise_s.expect("a rise"), 1e-9);
    near(backwards.overshoot, forwards.overshoot.expect("one"), 1e-9);
    assert!((backwards.peak + forwards.peak).abs() < 1e-9);
}

#[test]
fn what_cannot_be_analysed_is_refused_with_a_reason_and_help() {
    let arm = rrbot();
    assert_eq!(joint_entry(&arm, Some("elbow")).unwrap(), 1);
    let unknown = joint_entry(&arm, Some("elbw")).unwrap_err();
    assert!(unknown.help().contains("did you mean `elbow`?"));
    let which = joint_entry(&arm, None).unwrap_err();
    assert!(which.help().contains("--joint: shoulder, elbow"));
    let refused = |settings: &ResponseSettings| {
        let error = analyse(&arm, settings, None).unwrap_err();
        assert!(!error.help().is_empty());
        error.to_string()
    };
    let base = exercise();
    for (settings, why) in [
        (
            ResponseSettings {
                step: 0.0,
                ..base.clone()
            },
            "the step must be",
        ),
        (
            ResponseSettings {
                duration_s: 0.1,
                ..base.clone()
            },
            "longer than 0.2 s",
        ),
        (
            ResponseSettings {
                duration_s: 1e9,
                ..base.clone()
            },
            "physics steps",
        ),
        (
            ResponseSettings {
                servo_period_s: 0.0,
                ..base.clone()
            },
            "the servo period",
        ),
        (
            ResponseSettings {
                start: vec![0.0; 3],
                ..base.clone()
            },
            "the start has 3 numbers",
        ),
        (
            ResponseSettings {
                effort_limit: vec![1.0; 3],
                ..base.clone()
            },
            "the effort limit has 3",
        ),
        (
            ResponseSettings {
                effort_limit: vec![-1.0],
                ..base.clone()
            },
            "must be positive",
        ),
        (
            ResponseSettings {
                gains: PidGains {
                    kd: -1.0,
                    ..base.gains
                },
                ..base.clone()
            },
            "`kd` must be zero or more",
        ),
        (
            ResponseSettings {
                surroundings: Surroundings {
                    wind_m_s: Some([1.0, 0.0, 0.0]),
                    ..base.surroundings
                },
                ..base.clone()
            },
            "no link of `rrbot` has drag",
        ),
    ] {
        let message = refused(&settings);
        assert!(message.contains(why), "{message}");
    }
}

#[test]
fn a_robot_with_loops_and_one_that_slides_are_analysed_too() {
    let linkage = uarm();
    let joint = linkage.independent()[0];
    let settings = ResponseSettings {
        joint,
        step: 0.1,
        gains: PidGains {
            kp: 5.0,
            ki: 0.0,
            kd: 0.1,
        },
        ..exercise()
    };
    let analysis = analyse(&linkage, &settings, None).unwrap();
    assert!(analysis.responses[0].theory.is_some() && analysis.responses[0].stability.is_some());
    // 2 kg without damping under a spring of 800 N/m: 20 rad/s
    let slider = robot_of(
        "format = 1\nname = 'slider'\n[[links]]\nname = 'rail'\n[[links]]\nname = 'cart'\ninertia = { mass_kg = 2.0, tensor_kg_m2 = [1, 1, 1, 0, 0, 0] }\n[[joints]]\nname = 'slide'\ntype = 'prismatic'\nparent = 'rail'\nchild = 'cart'\naxis = [1, 0, 0]\n",
    );
    let settings = ResponseSettings {
        joint: joint_entry(&slider, None).unwrap(),
        gains: PidGains {
            kp: 800.0,
            ki: 0.0,
            kd: 0.0,
        },
        ..exercise()
    };
    let analysis = analyse(&slider, &settings, None).unwrap();
    let response = &analysis.responses[0];
    let theory = response.theory.as_ref().expect("a theory");
    near(theory.natural_frequency_rad_s(), 20.0, 1e-12);
    near(theory.damping_ratio(), 0.0, 0.0);
    assert_eq!(response.measured.missing, Some(NoMeasure::Unsettled));
    let text = response_text(&analysis).to_string();
    assert!(
        text.contains("never settles") && text.contains("final [m]"),
        "{text}"
    );
}
