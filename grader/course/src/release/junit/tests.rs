//! JUnit files read by an XML parser, and their counts.

use super::*;
use crate::release::sample::{Class, change, material};

fn documents(class: &Class) -> Vec<String> {
    let rows = class.rows();
    let made = FORM.release(&material(&rows, None)).unwrap();
    let files = made.files.into_iter();
    files
        .map(|file| String::from_utf8(file.bytes).unwrap())
        .collect()
}

#[test]
fn the_counts_are_those_of_the_cases() {
    let class = Class::hostile();
    let all = documents(&class);
    assert_eq!(all.len(), 9);
    for text in &all {
        let document = roxmltree::Document::parse(text).unwrap();
        let root = document.root_element();
        assert_eq!(root.tag_name().name(), "testsuites");
        let suites = root
            .children()
            .filter(|node| node.has_tag_name("testsuite"));
        for holder in suites.chain([root]) {
            let count = |name: &str| {
                let found = holder.descendants().filter(|node| node.has_tag_name(name));
                found.count().to_string()
            };
            for (attribute, element) in [
                ("tests", "testcase"),
                ("failures", "failure"),
                ("errors", "error"),
                ("skipped", "skipped"),
            ] {
                assert_eq!(
                    holder.attribute(attribute),
                    Some(count(element).as_str()),
                    "{attribute}"
                );
            }
        }
    }
    let document = roxmltree::Document::parse(&all[0]).unwrap();
    let points = document
        .descendants()
        .find(|node| node.attribute("name") == Some("points") && node.has_tag_name("property"));
    assert_eq!(points.unwrap().attribute("value"), Some("17.5"));
    let failure = document
        .descendants()
        .find(|node| node.has_tag_name("failure"))
        .unwrap();
    assert!(
        failure
            .attribute("message")
            .unwrap()
            .starts_with("1.2 of 3 points: case `bent`")
    );
}

#[test]
fn hostile_text_is_well_formed() {
    let mut class = Class::of_roster("id,name\ns1,Ada\n");
    class.grade("s1", 10.0);
    let hostile = "]]> <!-- & \"'\u{0}\u{7}\u{1b}[31m\u{85}\u{FFFE}\u{FFFF}\u{202E} \r\n <script> 日本 😀 /srv/ta/labs/x";
    class.of("s1").by_hand = vec![change(Some("fk/mean-error"), 0.5, hostile, false)];
    let grade = &mut class.records[0].as_mut().unwrap().grade;
    for task in &mut grade.tasks {
        task.title = hostile.to_owned();
        if let Some(stopped) = &mut task.stopped {
            stopped.message = hostile.to_owned();
        }
        for check in &mut task.checks {
            check.title = hostile.to_owned();
            check.next_step = Some(hostile.to_owned());
            for fact in &mut check.evidence {
                fact.message = hostile.to_owned();
            }
        }
    }
    let text = documents(&class).remove(0);
    let document = roxmltree::Document::parse(&text).unwrap();
    assert!(
        document
            .descendants()
            .any(|node| node.text().is_some_and(|text| text.contains("日本 😀")))
    );
    assert!(!text.contains("/home") && !text.contains("<script"));
    assert!(!text.chars().any(|c| c.is_control() && c != '\n'));
}
