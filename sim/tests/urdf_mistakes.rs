//! Broken URDF files: each error is reported at its position, small slips are warnings, and no text costs more than its size.

use std::fmt::Write as _;

use kinemark_sim::text::Problem as _;
use proptest::prelude::*;

use crate::urdf::{arm, good, gripper, link, read};

fn inertial(mass: &str, ixx: &str) -> String {
    link(&format!(
        "<inertial>\n<mass value=\"{mass}\"/>\n<inertia ixx=\"{ixx}\" iyy=\"1\" izz=\"1\" ixy=\"0\" ixz=\"0\" iyz=\"0\"/>\n</inertial>"
    ))
}

#[test]
fn each_mistake_is_named_at_its_place() {
    let axis = "<axis xyz=\"0 0 1\"/>";
    let revolute = arm("revolute", axis);
    // text, code, line, column
    let cases: Vec<(String, &str, usize, usize)> = vec![
        // the document
        (String::new(), "robot::urdf", 1, 1),
        ("<robot name=\"r\">\n<link>\n".into(), "robot::urdf", 3, 1),
        (
            "<robot name=\"r\">\n<link name=\"a\"></lnk>\n</robot>".into(),
            "robot::urdf",
            2,
            16,
        ),
        (
            "<?xml version=\"1.0\"?>\n<!DOCTYPE r [<!ENTITY a \"b\">]>\n<robot name=\"r\"/>".into(),
            "robot::urdf",
            2,
            1,
        ),
        ("<sdf>\n</sdf>".into(), "robot::urdf", 1, 1),
        ("<robot>\n<link name=\"a\"/></robot>".into(), "robot::urdf", 1, 1),
        ("<robot name=\"r\"/>".into(), "robot::urdf", 1, 1),
        (
            "<robot name=\"r\" xmlns:xacro=\"http://ros.org/wiki/xacro\">\n <xacro:arm/>\n</robot>".into(),
            "robot::urdf",
            2,
            2,
        ),
        (
            "<robot name=\"r\">\n <xacro:arm/>\n</robot>".into(),
            "robot::urdf",
            2,
            3,
        ),
        (
            revolute.replace("\"1 2 3\"", "\"1 2 ${height}\""),
            "robot::urdf",
            5,
            14,
        ),
        // the tree
        (
            revolute.replace("<link name=\"arm\"/>", "<link name=\"arm\"/><link name=\"lost\"/>"),
            "robot::urdf",
            3,
            31,
        ),
        (
            revolute.replace("parent link=\"base\"", "parent link=\"arm\""),
            "robot::cycle",
            4,
            14,
        ),
        (
            revolute.replace(
                "</robot>",
                "<joint name=\"k\" type=\"fixed\"><parent link=\"arm\"/><child link=\"base\"/></joint></robot>",
            ),
            "robot::cycle",
            10,
            14,
        ),
        (
            revolute.replace("</robot>", "<link name=\"x\"/><link name=\"y\"/>\n\
                <joint name=\"k\" type=\"fixed\"><parent link=\"x\"/><child link=\"y\"/></joint>\n\
                <joint name=\"l\" type=\"fixed\"><parent link=\"y\"/><child link=\"x\"/></joint></robot>"),
            "robot::cycle",
            11,
            14,
        ),
        (
            revolute.replace("child link=\"arm\"", "child link=\"amr\""),
            "robot::unknown_link",
            7,
            14,
        ),
        (
            revolute.replace("parent link=\"base\"", "parent link=\"bse\""),
            "robot::unknown_link",
            6,
            15,
        ),
        (
            revolute.replace("</robot>", "<joint name=\"k\" type=\"fixed\"><parent link=\"base\"/><child link=\"arm\"/></joint></robot>"),
            "robot::two_parents",
            10,
            64,
        ),
        (
            revolute.replace("name=\"arm\"", "name=\"base\""),
            "robot::duplicate",
            3,
            13,
        ),
        (
            revolute.replace("link=\"arm\"", "link=\"world\"").replace("name=\"arm\"", "name=\"world\""),
            "robot::bad_name",
            3,
            13,
        ),
        (revolute.replace("<link name=\"arm\"/>", "<link/>"), "robot::urdf", 3, 1),
        // joints
        (revolute.replace("<child link=\"arm\"/>", ""), "robot::urdf", 4, 1),
        (revolute.replace("<child link=\"arm\"/>", "<child/>"), "robot::urdf", 7, 1),
        (revolute.replace(" type=\"revolute\"", ""), "robot::urdf", 4, 1),
        (arm("revolut", axis), "robot::urdf", 4, 23),
        (arm("revolute", "<axis xyz=\"0 0 0\"/>"), "robot::axis", 8, 12),
        (arm("planar", "<axis xyz=\"0 0 0\"/>"), "robot::axis", 8, 12),
        (arm("revolute", "<axis xyz=\"0 1\"/>"), "robot::urdf", 8, 12),
        (arm("revolute", "<axis xyz=\"0 nan 1\"/>"), "robot::urdf", 8, 14),
        (arm("revolute", "<axis xyz=\"0 1 z\"/>"), "robot::urdf", 8, 16),
        (arm("revolute", "<axis xyz=\"1,0,0\"/>"), "robot::urdf", 8, 12),
        (arm("revolute", "<axis xyz=\"0 &#x7a; 1\"/>"), "robot::urdf", 8, 12),
        (arm("revolute", "<limit lower=\"1\" upper=\"-1\"/>"), "robot::limit", 8, 1),
        (arm("revolute", "<limit lower=\"1\"/>"), "robot::limit", 8, 1),
        (arm("revolute", "<limit velocity=\"-1\"/>"), "robot::out_of_range", 8, 18),
        (arm("revolute", "<dynamics damping=\"-1\"/>"), "robot::out_of_range", 8, 20),
        (arm("revolute", "<dynamics friction=\"1e999\"/>"), "robot::urdf", 8, 21),
        (arm("revolute", "<mimic joint=\"k\"/>"), "robot::unknown_joint", 8, 15),
        (arm("revolute", "<mimic joint=\"j\"/>"), "robot::mimic", 4, 14),
        (arm("revolute", "<mimic/>"), "robot::urdf", 8, 1),
        (arm("fixed", "<mimic joint=\"j\"/>"), "robot::mimic", 8, 15),
        (arm("floating", "<mimic joint=\"j\"/>"), "robot::mimic", 8, 1),
        (
            arm("floating", "").replace("</robot>", "<link name=\"x\"/><joint name=\"k\" type=\"fixed\"><parent link=\"base\"/><child link=\"x\"/></joint></robot>"),
            "robot::urdf",
            4,
            1,
        ),
        (
            revolute.replace("</robot>", "<link name=\"x\"/>\n<joint name=\"k\" type=\"floating\"><parent link=\"arm\"/><child link=\"x\"/></joint></robot>"),
            "robot::urdf",
            11,
            1,
        ),
        (revolute.replace("xyz=\"1 2 3\"", "quat_xyzw=\"0 0 0 1\""), "robot::urdf", 5, 9),
        // links
        (inertial("-1", "1"), "robot::out_of_range", 4, 14),
        (inertial("x", "1"), "robot::urdf", 4, 14),
        (inertial("1", "2.5"), "robot::inertia", 5, 1),
        (inertial("1", "-0.1"), "robot::inertia", 5, 1),
        (inertial("1", "1").replace("ixy=\"0\"", ""), "robot::inertia", 5, 1),
        (link("<inertial>\n<mass value=\"1\"/></inertial>"), "robot::inertia", 3, 1),
        (link("<inertial>\n</inertial>"), "robot::inertia", 3, 1),
        (link("<inertial>\n<mass/></inertial>"), "robot::urdf", 4, 1),
        (link("<visual><geometry>\n<sphere/></geometry></visual>"), "robot::urdf", 4, 1),
        (link("<visual><geometry>\n<box size=\"1 -1 1\"/></geometry></visual>"), "robot::out_of_range", 4, 12),
        (link("<visual><geometry>\n<mesh/></geometry></visual>"), "robot::urdf", 4, 1),
        (link("<visual><geometry>\n<mesh filename=\"a.stl\" scale=\"1 0 1\"/></geometry></visual>"), "robot::mesh", 4, 31),
    ];
    for (text, code, line, column) in cases {
        let error = read(&text).expect_err(&text);
        assert_eq!(error.problem.code(), code, "{error}\n{text}");
        assert_eq!(error.line_and_column(), (line, column), "{error}\n{text}");
        assert!(!error.problem.label().is_empty(), "{error}");
    }
}

#[test]
fn messages_name_both_roots_and_the_way_out() {
    let two = "<robot name=\"r\"><link name=\"a\"/><link name=\"b\"/></robot>";
    let error = read(two).expect_err("two roots");
    assert_eq!(
        error.to_string(),
        "links `a` and `b` are both roots: no joint has either as its child"
    );
    let error = read(&arm("revolut", "")).expect_err("a typo");
    let help = error.problem.help().expect("a help line");
    assert!(help.starts_with("did you mean `revolute`?"), "{help}");
    let error = read("<robot name=\"r\"><xacro:x/></robot>").expect_err("xacro");
    let help = error.problem.help().expect("a help line");
    assert!(help.starts_with("run xacro first"), "{help}");
}

#[test]
fn slips_of_the_pen_are_warnings_with_a_line() {
    for (text, warning) in [
        (
            arm("continuous", "<dynamics dampign=\"1\"/>"),
            "joint `j`: unknown attribute `dampign` of `<dynamics>` is left out: did you mean `damping`? (line 8)",
        ),
        (
            arm("continuous", "<limits/>"),
            "joint `j`: unknown element `<limits>` in `<joint>` is left out: did you mean `limit`? (line 8)",
        ),
        (
            arm("revolute", ""),
            "joint `j` is revolute but has no `<limit>`: it is taken as unlimited (line 4)",
        ),
        (
            arm("prismatic", "<limit effort=\"0\" velocity=\"0\"/>"),
            "joint `j`: limits from 0 to 0 say that it cannot move; they are left out (a joint that cannot move is `fixed`) (line 8)",
        ),
        (
            arm("continuous", "<limit lower=\"-1\"/>"),
            "joint `j` is continuous: its `lower` and `upper` limits are left out (line 8)",
        ),
        (
            arm("continuous", "<axis xyz=\"1 0 0\"/><axis xyz=\"0 1 0\"/>"),
            "joint `j`: a second `<axis>` is left out (line 8)",
        ),
        (
            arm("continuous", ""),
            "joint `j` moves link `arm`, which has no mass, nor has anything it carries: its acceleration is undefined",
        ),
        (
            arm("continuous", "").replace("</robot>", "<jiont name=\"k\"/></robot>"),
            "unknown element `<jiont>` is left out: did you mean `<joint>`? (line 10)",
        ),
        (
            link("<visual><geometry><box size=\"0 0 0\"/></geometry></visual>"),
            "link `base`: a box without extent is left out (line 3)",
        ),
    ] {
        let robot = good(&text);
        let found = robot.warnings().iter().any(|w| w == warning);
        assert!(found, "{warning}\n{:#?}", robot.warnings());
    }
}

#[test]
fn large_and_deep_texts_are_refused_or_read_in_time() {
    let refused = |text: String| {
        let error = read(&text).expect_err("too much");
        assert!(error.to_string().len() < 5000);
        error.problem.code()
    };
    let n = 150_000;
    // one megabyte of open elements, closed and not
    assert_eq!(refused("<a>".repeat(350_000)), "robot::urdf");
    let deep = format!(
        "<robot name=\"r\"><link name=\"a\">{}{}</link></robot>",
        "<a>".repeat(n),
        "</a>".repeat(n)
    );
    assert_eq!(good(&deep).warnings().len(), 1);
    // slips without number
    let slips = format!(
        "<robot name=\"r\"><link name=\"a\">{}</link></robot>",
        "<b/>\n".repeat(n)
    );
    assert_eq!(
        good(&slips).warnings().last().map(String::as_str),
        Some("and 149900 more warnings")
    );
    // attributes, namespaces
    let attributes: String = (0..n).fold(String::new(), |mut text, i| {
        let _ = write!(text, " a{i}=\"\"");
        text
    });
    assert_eq!(refused(format!("<robot{attributes}/>")), "robot::urdf");
    let nested: String = (0..n).fold(String::new(), |mut text, i| {
        let _ = write!(text, "<a xmlns:n{i}=\"{i}\">");
        text
    });
    assert_eq!(refused(nested), "robot::urdf");
    // links, joints, joints that unfold, names
    assert_eq!(
        refused(format!(
            "<robot name=\"r\">{}</robot>",
            "<link name=\"a\"/>".repeat(3000)
        )),
        "robot::too_large"
    );
    let ball = "<collision><geometry><sphere radius=\"1\"/></geometry></collision>";
    assert_eq!(
        refused(format!(
            "<robot name=\"r\"><link name=\"a\">{}</link></robot>",
            ball.repeat(2001)
        )),
        "robot::too_large"
    );
    let planar =
        "<joint name=\"j\" type=\"planar\"><parent link=\"a\"/><child link=\"a\"/></joint>";
    assert_eq!(
        refused(format!("<robot name=\"r\">{}</robot>", planar.repeat(1001))),
        "robot::too_large"
    );
    let fixed = "<joint name=\"j\" type=\"fixed\"><parent link=\"a\"/><child link=\"a\"/></joint>";
    assert_eq!(
        refused(format!(
            "<robot name=\"r\"><link name=\"a\"/>{}</robot>",
            fixed.repeat(10_000)
        )),
        "robot::two_parents"
    );
    assert_eq!(
        refused(format!("<robot name=\"{}\"/>", "r".repeat(1_000_000))),
        "robot::urdf"
    );
    // a banner in a comment is none of these
    let banner = format!(
        "<robot name=\"r\"><!-- {} --><link name=\"a\"/></robot>",
        "=".repeat(5000)
    );
    assert_eq!(good(&banner).links().len(), 1);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(256))]

    #[test]
    fn cutting_and_changing_bytes_never_panics(cut in 0usize..600, at in 0usize..600, byte in 0x20u8..0x7f) {
        let text = gripper();
        let mut bytes = text.into_bytes();
        let (cut, at) = (cut % bytes.len(), at % bytes.len());
        bytes[at] = byte;
        for part in [&bytes[..], &bytes[..cut]] {
            let text = std::str::from_utf8(part).expect("only ASCII");
            if let Err(error) = read(text) {
                let (line, column) = error.line_and_column();
                prop_assert!(line == 1 && column <= text.len() + 1, "{error}");
            }
        }
    }
}

#[test]
fn a_malformed_attribute_is_reported_with_how_one_is_written() {
    for text in [
        "<robot name=\"r\"><link=\"a\"/></robot>",
        "<robot name=\"r\"><link name \"a\"/></robot>",
        "<robot name=\"r\"><link name=a/></robot>",
    ] {
        let error = read(text).expect_err(text);
        let help = error.problem.help();
        let written = Some("an attribute is name=\"value\"");
        assert_eq!(help.as_deref(), written, "{text}: {error}");
    }
}
