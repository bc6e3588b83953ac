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

/// A finger of two joints; `index_q2` mimics `master`, on line 9, and `Left_index_q1` is of this kind.
fn hand(master: &str, kind: &str) -> String {
    format!(
        "<robot name=\"r\">\n<link name=\"palm\"/>\n<link name=\"near\"/>\n<link name=\"far\"/>\n\
         <joint name=\"Left_index_q1\" type=\"{kind}\"><parent link=\"palm\"/><child link=\"near\"/></joint>\n\
         <joint name=\"index_q2\" type=\"continuous\">\n<parent link=\"near\"/>\n<child link=\"far\"/>\n\
         <mimic joint=\"{master}\" multiplier=\"2\"/>\n</joint>\n</robot>\n"
    )
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
        (
            revolute
                .replace("<joint", "<jont")
                .replace("</joint>", "</jont>"),
            "robot::urdf",
            4,
            1,
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
        (arm("revolute", "<mimic joint=\"j\"/>"), "robot::mimic", 4, 14),
        (arm("revolute", "<mimic/>"), "robot::urdf", 8, 1),
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
        (inertial("x", "1"), "robot::urdf", 4, 14),
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
fn a_joint_that_follows_itself_is_refused_with_the_flag_that_helps() {
    for text in [
        arm("revolute", "<mimic joint=\"j\"/>"),
        hand("Left_index_q1", "continuous").replace(
            "<child link=\"near\"/>",
            "<child link=\"near\"/><mimic joint=\"index_q2\"/>",
        ),
    ] {
        let error = read(&text).expect_err(&text);
        assert!(
            error.to_string().ends_with("mimics itself in a circle"),
            "{error}"
        );
        let help = error.problem.help().expect("a help line");
        assert!(help.contains("--ignore-mimic"), "{help}");
    }
}

#[test]
fn all_mistakes_of_a_file_are_reported_at_once_in_the_order_of_the_text() {
    let text = "<robot name=\"r\">
<link name=\"a\"><inertial><mass value=\"x\"/></inertial></link>
<link name=\"b\"><visual><geometry><box size=\"1 -1 1\"/></geometry></visual></link>
<joint name=\"j\" type=\"continuous\"><parent link=\"a\"/><child link=\"b\"/><axis xyz=\"0 0 0\"/></joint>
</robot>";
    let lines = |text: &str| -> Vec<usize> {
        let error = read(text).expect_err(text);
        let others = error.others().iter();
        std::iter::once(&error)
            .chain(others)
            .map(|one| one.line_and_column().0)
            .collect()
    };
    assert_eq!(lines(text), [2, 3, 4]);
    // without a tree, what stands in links and joints is looked at all the same
    let broken = text.replace("child link=\"b\"", "child link=\"c\"");
    assert_eq!(lines(&broken), [2, 3, 4, 4]);
    // no more than a person mends at once, and no more than the text is worth
    let links: String = (0..100_000)
        .map(|i| format!("<link nmae=\"{i}\"/>\n"))
        .collect();
    assert_eq!(
        lines(&format!("<robot name=\"r\">{links}</robot>")).len(),
        10
    );
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
            arm("fixed", "<mimic joint=\"j\"/>"),
            "joint `j` is fixed: its `<mimic>` is left out (line 8)",
        ),
        (
            arm("floating", "<mimic joint=\"j\"/>"),
            "joint `j` has more than one motion: its `<mimic>` is left out (line 8)",
        ),
        (
            arm("continuous", "<mimic joint=\"nobody\"/>"),
            "joint `j`: it follows nothing and has an entry of its own in q, since it mimics `nobody`, which is not there (line 8)",
        ),
        (
            hand("index_q1", "continuous"),
            "joint `index_q2`: it follows nothing and has an entry of its own in q, since it mimics `index_q1`, which is not there; did you mean `Left_index_q1`? (line 9)",
        ),
        (
            hand("Left_index_q1", "fixed"),
            "joint `index_q2`: it follows nothing and has an entry of its own in q, since it mimics `Left_index_q1`, which is fixed (line 9)",
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
