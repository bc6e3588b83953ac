//! Variants that choose: a text such as a row of joints, a list, a number, each as likely; and what a student's file may say.

use std::collections::BTreeMap;

use kinemark_grader::lab::variant::Variant;
use kinemark_grader::lab::{Lab, Staff};
use kinemark_grader::task::model::Given;
use kinemark_sim::text::{Dimension, Source};

use crate::graded_rubrics::motion_lab;
use crate::own_lab::OwnLab;

const LAB: &str = r#"
format = 1
name = "95-choices"
title = "Choices"
robot = "= row"

[parameters]
row = "RzTx"
first = [1.0, 0.0, 0.0]
base = 0.5

[variants]
row = { choices = ["RzTx", "RyRx", "TzRx"] }
first = { choices = [[1.0, 0.0, 0.0], [0.0, 0.0, 1.0]] }
base = { choices = [0.5, 0.75, 2] }

[dimensions]
base_height = "= base"
link1 = "= first"

[[tasks]]
name = "fk"
title = "Where it is"
function = { call = "forward_kinematics", cases = [{ name = "a", q_rad = [0.3, 0.2] }] }
checks = [{ name = "c", title = "C", points = 1.0, fk-error = { full_m = 0.1, zero_m = 0.2 } }]
"#;

fn own_lab() -> OwnLab {
    OwnLab::new("95-choices", LAB)
}

#[test]
fn every_choice_is_drawn_and_makes_its_robot() {
    let own = own_lab();
    let lab = own.lab();
    assert_eq!(lab.robot.name(), "RzTx");
    let mut seen: BTreeMap<String, u32> = BTreeMap::new();
    for student in 0..300 {
        let variant = lab
            .variant_of("a salt", &format!("s{student}"))
            .expect("an id");
        variant.check_drawn(&lab).expect("drawn");
        let again = Variant::parse(Source::new("variant.toml", variant.text())).expect("written");
        assert_eq!(again.text(), variant.text());
        let theirs = Lab::load_variant(&own, "95-choices", Some(&variant)).expect("a lab");
        let Some(Dimension::Text(row)) = theirs.parameters.get("row") else {
            panic!("no row");
        };
        assert_eq!(theirs.robot.name(), row);
        assert_eq!(
            theirs.robot.dimensions().get("link1"),
            theirs.parameters.get("first")
        );
        for (name, value) in variant.parameters() {
            *seen.entry(format!("{name} {value:?}")).or_default() += 1;
        }
    }
    assert_eq!(seen.len(), 3 + 2 + 3, "{seen:?}");
    // 100 or 150 are expected of each, with a standard deviation below 9
    assert!(
        seen.values().all(|count| (65..190).contains(count)),
        "{seen:?}"
    );
}

#[test]
fn a_students_file_has_one_of_the_choices() {
    let lab = own_lab().lab();
    for (row, expected) in [
        ("row = \"RyRx\"", None),
        (
            "row = \"RyRy\"",
            Some("no student's variant of lab `95-choices` has row = \"RyRy\""),
        ),
        ("row = 3", Some("parameter `row` is a text, got one number")),
        ("base = 0.6", Some("has base = 0.6")),
    ] {
        let text = format!("format = 1\nlab = \"95-choices\"\n[parameters]\n{row}\n");
        let variant = Variant::parse(Source::new("variant.toml", text)).expect("a variant");
        let refused = variant
            .check_fits(&lab)
            .and_then(|()| variant.check_drawn(&lab));
        match (refused, expected) {
            (Ok(()), None) => {}
            (Err(error), Some(expected)) => {
                assert!(error.to_string().contains(expected), "{row}: {error}");
            }
            (other, _) => panic!("{row}: {other:?}"),
        }
    }
}

#[test]
fn choices_that_are_none_are_refused() {
    for (from, to, expected) in [
        (
            "[\"RzTx\", \"RyRx\", \"TzRx\"]",
            "[]",
            "`choices` has nothing to choose",
        ),
        (
            "\"TzRx\"]",
            "3]",
            "parameter `row` is a text, and the choice 3.0 is something else",
        ),
        (
            "[0.0, 0.0, 1.0]]",
            "[0.0, 1.0]]",
            "parameter `first` is a list of 3, and the choice [0.0, 1.0]",
        ),
        (
            "{ choices = [0.5, 0.75, 2] }",
            "{ choice = [0.5, 0.75, 2] }",
            "{ choices = [...] }",
        ),
        (
            "row = \"RzTx\"",
            "row = \"= base\"",
            "expressions are over parameters",
        ),
        (
            "base = 0.5",
            "base = \"0,5\"",
            "a number in quotes is a text",
        ),
        (
            "base_height = \"= base\"",
            "base_height = \"= row\"",
            "base_height",
        ),
        (
            "base_height = \"= base\"",
            "base_height = \"= row + 1\"",
            "`row` is a text, and an expression is over numbers",
        ),
        ("\"= row\"", "\"= base\"", "expected"),
        ("row = \"RzTx\"", "row = \"RzTq\"", "`q` is no axis"),
    ] {
        match own_lab().with("lab.toml", from, to).load() {
            Ok(_) => panic!("{to} is accepted"),
            Err(error) => assert!(error.to_string().contains(expected), "{to}: {error}"),
        }
    }
}

#[test]
fn hidden_cases_and_runs_draw_every_choice() {
    let own = motion_lab()
        .with(
            "hidden.toml",
            "count = 2\nparameters = { out = [0.45, 0.55] }",
            "count = 20\nparameters = { out = { choices = [0.45, 0.55] } }",
        )
        .with(
            "hidden.toml",
            "count = 3\ngiven = { mass_kg = [0.2, 2.0]",
            "count = 40\ngiven = { mass_kg = { choices = [0.25, 1, 4.0] }",
        );
    let lab = own.lab();
    let staff = own.staff(&lab).expect("the course staff's part");
    let mut seen: BTreeMap<String, u32> = BTreeMap::new();
    for run in staff.runs("go") {
        let out = run.lab.parameters.get("out");
        *seen.entry(format!("{out:?}")).or_default() += 1;
    }
    assert_eq!(seen.values().sum::<u32>(), 20);
    assert_eq!(seen.len(), 2, "{seen:?}");
    for case in staff.hidden("lever") {
        let Given::Values { given, .. } = &case.given else {
            panic!("{case:?}");
        };
        *seen.entry(format!("{:?}", given[1])).or_default() += 1;
    }
    assert_eq!(seen.len(), 2 + 3, "{seen:?}");
    assert!(seen.contains_key("(\"mass_kg\", Number(1.0))"), "{seen:?}");
}

#[test]
fn hidden_choices_that_are_none_are_refused() {
    for (from, to, expected) in [
        (
            "out = [0.45, 0.55]",
            "out = { choices = [] }",
            "`choices` has nothing to choose",
        ),
        (
            "out = [0.45, 0.55]",
            "out = { choices = [0.45, \"far\"] }",
            "the first choice is one number, and another is a text",
        ),
        (
            "out = [0.45, 0.55]",
            "out = { choices = [\"near\", \"far\"] }",
            "the ranges or choices of `out` do not fit its shape",
        ),
        (
            "out = [0.45, 0.55]",
            "out = { choice = [0.45, 0.55] }",
            "unknown key `choice`",
        ),
        (
            "out = [0.45, 0.55]",
            "out = [\"near\", \"far\"]",
            "of texts write { choices = [...] }",
        ),
        (
            "mass_kg = [0.2, 2.0]",
            "mass_kg = { choices = [\"light\", \"heavy\"] }",
            "`mass_kg` is given as a text",
        ),
    ] {
        let own = motion_lab().with("hidden.toml", from, to);
        let lab = own.lab();
        match Staff::load(&own, &lab, None) {
            Ok(_) => panic!("{to} is accepted"),
            Err(error) => assert!(error.to_string().contains(expected), "{to}: {error}"),
        }
    }
}
