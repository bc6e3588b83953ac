//! A class of attackers and one good submission: it has the very record that it has alone.

use crate::case::{Kind, all_cases};
use crate::course_class::{LAB, course, grade, hand_in, records, standings};
use crate::folder::{lay_out, make};
use crate::testbed::TestBed;

#[test]
fn a_good_submission_among_attacks_keeps_its_record() {
    let alone = TestBed::new();
    hand_in(&alone, "in/good.rhai", "good");
    course(&alone, "id,name\ngood,Good\n");
    let ran = grade(&alone, &[]);
    assert_eq!(ran.code, Some(0), "{ran:?}");

    let class = TestBed::new();
    hand_in(&class, "in/good.rhai", "good");
    let mut roster = "id,name\ngood,Good\n".to_owned();
    let mut attackers = 0;
    for (name, case) in all_cases() {
        let is_handed_in = case.lab == LAB && case.expect.is_some();
        if !is_handed_in || matches!(case.kind, Kind::Files | Kind::Frames) {
            continue;
        }
        let bed = TestBed::new();
        lay_out(&case, &bed);
        for step in &case.steps {
            make(step, &bed);
        }
        for ending in ["rhai", "wasm"] {
            if let Ok(bytes) = std::fs::read(bed.path(&format!("submission.{ending}"))) {
                class.write(&format!("in/{name}.{ending}"), bytes);
                roster += &format!("{name},A {name}\n");
                attackers += 1;
            }
        }
    }
    assert!(attackers >= 60, "{attackers} attackers");
    course(&class, &roster);
    let ran = grade(&class, &[]);
    assert!(matches!(ran.code, Some(0 | 1)), "{ran:?}");
    let of_good = |bed: &TestBed| {
        let all = standings(bed);
        let good = all.into_iter().find(|(student, ..)| student == "good");
        let (_, status, points, record) = good.expect("a row");
        // everybody has a record of their own, with every digest
        let records = records(bed).into_iter();
        let mut named = records.filter(|(path, _)| path.contains(record.as_str().expect("a name")));
        let (_, bytes) = named.next().expect("a record");
        (status, points, record, bytes)
    };
    assert_eq!(of_good(&class), of_good(&alone));
}
