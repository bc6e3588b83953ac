//! Levels of a robustness sweep that start elsewhere, start moving, or push: a carriage that nobody drives ends where each level takes it.

use crate::own_lab::{OwnLab, check, message};

/// A carriage of 2 kg that slides along x without friction, so that gravity does nothing to it.
const ROBOT: &str = r#"
format = 1
name = "carriage"
links = [
    { name = "rail" },
    { name = "sled", shapes = [{ box = { size_m = [0.1, 0.1, 0.1] } }], inertia = { mass_kg = 2.0, com_m = [0, 0, 0], tensor_kg_m2 = [0.004, 0.004, 0.004, 0, 0, 0] } },
]
joints = [{ name = "slide", type = "prismatic", parent = "rail", child = "sled", axis = [1, 0, 0], limit = { lower = -5, upper = 5, effort = 30 } }]
frames = [{ name = "tcp", link = "sled" }]
"#;

/// At rest at 0 the carriage is 0.3 m from where it should be: a quarter of the points.
const LAB: &str = r#"
format = 1
name = "95-levels"
title = "Levels"
robot = "carriage"

[[tasks]]
name = "drift"
title = "Do nothing"

[tasks.motion]
mode = "effort"
duration_s = 2.0

[[tasks.checks]]
name = "there"
title = "At 0.3 m"
points = 1.0
joint-reached = { joint = "slide", position_rad = 0.3, hold_s = 0.001, full_rad = 0.001, zero_rad = 0.3997 }

[[tasks.checks]]
name = "disturbed"
title = "Also when disturbed"
points = 4.0
robustness = { check = "there", rungs = [
    { name = "elsewhere", start_offset_rad = [0.3] },
    { name = "moving", start_offset_rad_s = [0.15] },
    { name = "both", start_offset_rad = [0.1], start_offset_rad_s = [0.1] },
    { name = "pushed", pushes = [{ on = "sled", at_s = 0.0, for_s = 0.2, force_n = [1.5789473684210527, 0, 0] }] },
    { name = "pushed-back", pushes = [{ on = "sled", at_s = 0.5, for_s = 0.5, force_n = [-0.4, 0, 0] }] },
] }
"#;

const NOTHING: &str = "fn control(observation) { [0.0] }";

fn lab() -> OwnLab {
    let lab = OwnLab::new("95-levels", LAB);
    lab.write("labs/robots/carriage.toml", ROBOT);
    lab
}

#[test]
fn a_level_starts_elsewhere_starts_moving_or_pushes() {
    let task = lab().graded(NOTHING, 1);
    assert_eq!(check(&task, "there")["points"], 0.25, "{task}");
    // 0.3 = 0.3 = 0.15 * 2 = 0.1 + 0.1 * 2; 0.158 m/s after 0.2 s, half as fast in the mean until then; the last one ends at
    // -(0.025 + 0.1) m, where nothing is earned
    let disturbed = check(&task, "disturbed");
    assert_eq!(disturbed["points"], 3.2, "{task}");
    let said = message(disturbed);
    for word in [
        "in the run `pushed-back` (a push of 0.4 N on `sled` at 0.5 s)",
        "0.425 m from 0.3 m",
    ] {
        assert!(said.contains(word), "{said}");
    }
}

/// Two of the same levels under other names, in another order, with other shares.
const AGAIN: &str = r#"
[[tasks.checks]]
name = "again"
title = "Disturbed again"
points = 4.0
robustness = { check = "there", rungs = [
    { name = "back", share = 1, pushes = [{ on = "sled", at_s = 0.5, for_s = 0.5, force_n = [-0.4, 0, 0] }] },
    { name = "slow", share = 1, start_offset_rad_s = [0.1] },
    { name = "moved", share = 2, start_offset_rad = [0.3] },
] }
"#;

#[test]
fn a_level_that_two_checks_share_is_judged_for_each_in_its_place() {
    let lab = OwnLab::new("95-levels", format!("{LAB}{AGAIN}"));
    lab.write("labs/robots/carriage.toml", ROBOT);
    let task = lab.graded(NOTHING, 1);
    let disturbed = check(&task, "disturbed");
    assert_eq!(disturbed["points"], 3.2, "{task}");
    let again = check(&task, "again");
    // nothing of `back`, half of `moved`; `slow` ends at 0.2 m, 0.1 m off: three quarters of a quarter
    assert_eq!(again["points"], 2.75, "{task}");
    assert!(message(again).contains("in the run `back`"), "{task}");
    let rungs = task["digests"]["rungs"].as_array().expect("rungs");
    let names: Vec<&str> = rungs
        .iter()
        .map(|rung| rung["rung"].as_str().expect("a name"))
        .collect();
    let all = [
        "elsewhere",
        "moving",
        "both",
        "pushed",
        "pushed-back",
        "back",
        "slow",
        "moved",
    ];
    assert_eq!(names, all);
    let digest = |name: &str| {
        let at = names.iter().position(|known| *known == name);
        &rungs[at.expect("a level")]["digest"]
    };
    assert_eq!(digest("back"), digest("pushed-back"));
    assert_eq!(digest("moved"), digest("elsewhere"));
    assert_ne!(digest("slow"), digest("moving"));
}

#[test]
fn levels_that_cannot_be_are_refused() {
    let offset = "start_offset_rad = [0.3]";
    lab().is_refused(
        NOTHING,
        &[
            (
                offset,
                "start_offset_rad = [0.3, 0.1]",
                "lab::joint_count",
                "joints: slide",
            ),
            (
                offset,
                "start_offset_rad = [1e9]",
                "lab::out_of_range",
                "beyond 1000",
            ),
            (
                offset,
                "start_offset_rad = [0.0]",
                "lab::robustness",
                "changes nothing",
            ),
            (
                "force_n = [-0.4, 0, 0]",
                "force_n = [0, 0, 0]",
                "lab::push",
                "needs a force",
            ),
            (
                "on = \"sled\", at_s = 0.5",
                "on = \"sledge\", at_s = 0.5",
                "lab::push",
                "links and bodies: rail, sled",
            ),
            ("at_s = 0.5", "at_s = 2.5", "lab::push", "after the end"),
        ],
    );
}
