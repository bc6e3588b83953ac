//! What feedback says, and that it stays within its length whatever it is made from.

use proptest::prelude::*;

use super::*;
use crate::release::sample::{Class, change, material};
use crate::standing::Status;

fn text_of(class: &Class, at: usize) -> String {
    let rows = class.rows();
    Feedback::of(&material(&rows, None), &rows[at])
        .unwrap()
        .text()
}

#[test]
fn feedback_says_what_matters() {
    let mut class = Class::of_roster("id,name\ns1,Ada\n");
    class.grade("s1", 18.5);
    let standing = class.of("s1");
    standing.record_points = Some(17.5);
    standing.late_s = Some(2 * 3600 + 5 * 60 + 7);
    standing.by_hand = vec![
        change(
            Some("fk/mean-error"),
            1.5,
            "the projector hid a line, see /srv/ta/notes/x.md",
            false,
        ),
        change(None, -0.5, "no name in the header", false),
        change(Some("gone/check"), 0.0, "of an older lab", true),
    ];
    let text = text_of(&class, 0);
    for part in [
        "Kinemark, Kinematics: 18.5 of 24 points (17.5 from the checks).\n",
        "Handed in 2\u{a0}h 5\u{a0}min after the due time.\n",
        "By hand: +1.5 for Mean position error: the projector hid a line, see x.md\n",
        "By hand: −0.5 for the total: no name in the header\n",
        "- Forward kinematics, Mean position error: 1.2 of 3 points. case `bent`: the answer is 12.4 mm",
        " Next: Draw the arm at q = (0, pi/2)",
        " Which angle is it? It is q1 + q2 <here>.\n",
        "To see the runs: kinemark grade 01-kinematics submission.rhai\n",
    ] {
        assert!(text.contains(part), "{part}\n{text}");
    }
    assert!(!text.contains("older lab") && !text.contains("/home"));
    let rows = class.rows();
    let feedback = Feedback::of(&material(&rows, None), &rows[0]).unwrap();
    assert!(is_ours(&feedback.html()) && is_ours(&feedback.line()));
    assert!(!feedback.line().contains('\n') && !feedback.html().contains('\n'));
    let page = feedback.page();
    assert!(page.contains("the projector hid a line"));
    assert!(page.contains("It is q1 + q2 &lt;here&gt;."));
    assert!(!page.contains("The elbow.") && !page.contains("kinemark hint"));
}

/// A line with what was lost comes before the hints of another.
#[test]
fn hints_take_no_room_from_losses() {
    let mut class = Class::of_roster("id,name\ns1,Ada\n");
    class.grade("s1", 12.0);
    let record = class.records[0].as_mut().unwrap();
    let task = &mut record.grade.tasks[0];
    let lost = task
        .checks
        .iter()
        .find(|check| check.name == "mean-error")
        .unwrap()
        .clone();
    for number in 0..40 {
        let mut check = lost.clone();
        check.name = format!("c{number}");
        task.checks.push(check);
    }
    let text = text_of(&class, 0);
    let without = Hints::default();
    let mut rows = class.rows();
    rows[0].hints = &without;
    let plain = Feedback::of(&material(&rows, None), &rows[0]).unwrap();
    let losses = |text: &str| text.matches("\n- Forward kinematics,").count();
    assert_eq!(losses(&text), losses(&plain.text()));
    assert!(losses(&text) > 2 && text.contains("more losses of"));
    assert!(text.matches("Which angle is it?").count() < losses(&text));
    assert!(text.chars().count() <= MOST_CHARACTERS);
}

#[test]
fn lateness_is_in_its_two_greatest_units() {
    for (seconds, words) in [
        (59, "59\u{a0}s"),
        (3600, "1\u{a0}h"),
        (86_400 * 3 + 7 * 3600 + 5, "3\u{a0}d 7\u{a0}h"),
        (86_401, "1\u{a0}d"),
    ] {
        assert_eq!(duration(seconds), words);
    }
}

#[test]
fn who_has_no_grade_has_no_feedback() {
    let class = Class::hostile();
    let rows = class.rows();
    let material = material(&rows, None);
    for row in &rows {
        let has_grade = row.standing.status == Status::Graded;
        assert_eq!(Feedback::of(&material, row).is_some(), has_grade);
    }
}

#[test]
fn html_is_escaped() {
    assert_eq!(
        escaped("a<b> & \"c\" 'd' \\e"),
        "a&lt;b&gt; &amp; &quot;c&quot; &#39;d&#39; &#92;e"
    );
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(40))]

    #[test]
    fn a_text_is_never_too_long_and_always_has_a_loss(
        message in "\\PC{0,3000}",
        title in "\\PC{1,300}",
        why in "\\PC{0,3000}",
        fixes in 0usize..12,
        checks in 1usize..40,
    ) {
        let mut class = Class::of_roster("id,name\ns1,Ada\n");
        class.grade("s1", 3.0);
        let standing = class.of("s1");
        standing.late_s = Some(i64::MAX);
        standing.by_hand = vec![change(None, 0.25, &why, false); fixes];
        let grade = &mut class.records[0].as_mut().unwrap().grade;
        grade.submission.name = title.clone();
        let task = &mut grade.tasks[0];
        task.title = title.clone();
        task.checks[1].title = title.clone();
        task.checks[1].evidence[0].message = message;
        task.checks[1].next_step = Some(why);
        let check = task.checks[1].clone();
        task.checks.extend(vec![check; checks]);
        let rows = class.rows();
        let mut material = material(&rows, None);
        material.title = &title;
        let feedback = Feedback::of(&material, &rows[0]).unwrap();
        for text in [feedback.text(), feedback.line()] {
            prop_assert!(text.chars().count() <= MOST_CHARACTERS, "{}", text.chars().count());
            prop_assert!(text.contains(": 1.2 of 3 points."), "{text}");
        }
        prop_assert!(feedback.page().len() <= 100_000);
    }
}

/// What a student pastes into a shell runs nothing but the grader.
#[test]
fn the_command_to_paste_is_quoted() {
    for (name, word) in [
        ("Lab 1 – Lösung.rhai", "\"Lab 1 – Lösung.rhai\""),
        ("Lab 1 $(rm -rf ~).rhai", "submission.rhai"),
        ("-rf.rhai", "./-rf.rhai"),
        ("a\u{202E}b.rhai", "submission.rhai"),
    ] {
        let mut class = Class::of_roster("id,name\ns1,Ada\n");
        class.grade("s1", 3.0);
        let record = class.records[0].as_mut().unwrap();
        record.grade.submission.name = name.to_owned();
        let line = format!("To see the runs: kinemark grade 01-kinematics {word}\n");
        let text = text_of(&class, 0);
        assert!(text.contains(&line), "{line}{text}");
    }
}
