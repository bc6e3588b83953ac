//! Annotations read as the runner of GitHub Actions reads a line of output.

use super::*;
use crate::release::sample::{Class, material};

/// A command of a line: kind, properties and message, with the runner's unescaping.
fn parsed(line: &str) -> (String, Vec<(String, String)>, String) {
    let unescaped = |text: &str| {
        let text = text.replace("%0D", "\r").replace("%0A", "\n");
        text.replace("%3A", ":")
            .replace("%2C", ",")
            .replace("%25", "%")
    };
    let rest = line.strip_prefix("::").unwrap();
    let (head, message) = rest.split_once("::").unwrap();
    let (kind, properties) = head.split_once(' ').unwrap();
    let properties = properties.split(',').map(|property| {
        let (name, value) = property.split_once('=').unwrap();
        (name.to_owned(), unescaped(value))
    });
    (kind.to_owned(), properties.collect(), unescaped(message))
}

fn text_of(class: &Class) -> String {
    let rows = class.rows();
    let made = FORM.release(&material(&rows, None)).unwrap();
    assert_eq!(made.files[0].path, "s1.txt");
    String::from_utf8(made.files[0].bytes.clone()).unwrap()
}

#[test]
fn every_line_is_a_command() {
    let mut class = Class::of_roster("id,name\ns1,Ada\n");
    class.grade("s1", 10.0);
    let grade = &mut class.records[0].as_mut().unwrap().grade;
    let hostile = "100 %\r\n::error::x, y: z\u{1b}[31m";
    grade.tasks[0].checks[1].evidence[0].message = hostile.to_owned();
    grade.tasks[0].checks[1].title = hostile.to_owned();
    let text = text_of(&class);
    let all: Vec<_> = text.lines().map(parsed).collect();
    let loss = all
        .iter()
        .find(|(_, _, message)| message.starts_with("100 %\n"))
        .unwrap();
    assert_eq!(loss.0, "warning");
    assert_eq!(loss.1[0], ("file".to_owned(), "submission.rhai".to_owned()));
    assert!(loss.1[1].1.contains("100 %") && loss.1[1].1.contains("x, y: z⟨U+001B⟩"));
    let (kind, properties, message) = all.last().unwrap();
    assert_eq!(
        (kind.as_str(), message.as_str()),
        ("notice", "10 of 24 points")
    );
    assert_eq!(properties[0].1, "Kinematics");
}

#[test]
fn a_stop_is_marked_at_its_line() {
    let mut class = Class::of_roster("id,name\ns1,Ada\n");
    class.grade("s1", 10.0);
    let grade = &mut class.records[0].as_mut().unwrap().grade;
    grade.tasks[0].stopped = Some(kinemark_grader::record::grade::Stopped {
        message: "`q` has no `x`".to_owned(),
        help: Some("write q[0]".to_owned()),
        line: Some(7),
        column: Some(3),
        ..Default::default()
    });
    let text = text_of(&class);
    let line = text.lines().find(|line| line.contains("line=7")).unwrap();
    assert_eq!(
        line,
        "::error file=submission.rhai,line=7,col=3,title=Forward kinematics%3A missed::`q` has no `x`%0ANext: write q[0]"
    );
}
