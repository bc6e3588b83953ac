//! Gradebooks as Canvas exports them, filled in and read back as its importer reads them.

use std::collections::BTreeMap;

use super::*;
use crate::release::sample::{Class, HOSTILE, material};
use crate::release::{Columns, Row};

/// Grades of an assignment by the student's number, as `gradebook_importer.rb` reads them: cells apart by commas or by semicolons
/// (whichever gives every one of the first three lines as many cells), numbers with a comma turned into numbers with a point, the row
/// of the maxima and that of manual posting passed over, the column by its number.
fn import(bytes: &[u8], assignment: &str) -> BTreeMap<String, String> {
    let text = std::str::from_utf8(bytes)
        .unwrap()
        .trim_start_matches('\u{feff}');
    let fields = |delimiter: char| text.lines().next().unwrap().split(delimiter).count();
    let delimiter = if fields(';') > fields(',') {
        b';'
    } else {
        b','
    };
    let mut reader = csv::ReaderBuilder::new()
        .delimiter(delimiter)
        .has_headers(false)
        .from_reader(text.as_bytes());
    let rows: Vec<csv::StringRecord> = reader.records().map(Result::unwrap).collect();
    let header = &rows[0];
    assert!(header[0].contains("Student") && header[1].contains("ID"));
    let suffix = format!("({assignment})");
    let column = header
        .iter()
        .position(|title| title.ends_with(&suffix))
        .unwrap();
    let mut grades = BTreeMap::new();
    for row in &rows[1..] {
        let is_posting = row
            .iter()
            .all(|cell| cell.trim().is_empty() || cell.starts_with("Manual Posting"));
        if row[0].contains("Points Possible") || is_posting {
            continue;
        }
        let grade = row[column].trim();
        let is_number = !grade.is_empty()
            && grade
                .chars()
                .all(|c| c.is_ascii_digit() || ",.-%".contains(c));
        let grade = if is_number {
            grade.replace(',', ".")
        } else {
            grade.to_owned()
        };
        grades.insert(row[1].to_owned(), grade);
    }
    grades
}

/// The name as Canvas writes it: formulas wrapped.
fn student(name: &str) -> String {
    let name = if name.trim_start().starts_with('=') {
        format!("=\"{name}\"")
    } else {
        name.to_owned()
    };
    format!("\"{}\"", name.replace('"', "\"\""))
}

fn gradebook() -> String {
    let mut text = "\u{feff}Student,ID,SIS User ID,SIS Login ID,Section,Lab 0 (4314281),\"Lab 1, Kinematics (4314282)\",Assignments Current Score,Final Score\n\
        ,,,,,,Manual Posting,,\n\
        \"    Points Possible\",,,,,10.00,24.00,(read only),(read only)\n"
        .to_owned();
    for (i, (id, name)) in HOSTILE.iter().enumerate() {
        text += &format!(
            "{},{},{id},login{id},\"A, B\",9.50,,95.00,95.00\n",
            student(name),
            1000 + i
        );
    }
    for (i, id) in ["m", "e", "h", "g", "p", "n", "b"].iter().enumerate() {
        text += &format!("\"{id}, Person\",{},,,A,,,,\n", 2000 + i);
    }
    text + "\"Student, Test\",99,,abc,A,,,,\n"
}

fn release(rows: &[Row<'_>], text: &str) -> Made {
    FORM.release(&material(rows, Some(text.as_bytes())))
        .unwrap()
}

#[test]
fn a_gradebook_is_read_back_by_the_rules_of_the_importer() {
    let class = Class::hostile();
    let rows = class.rows();
    let made = release(&rows, &gradebook());
    let grades = import(&made.files[0].bytes, "4314282");
    for i in 0..HOSTILE.len() {
        let points: f64 = grades[&(1000 + i).to_string()].parse().unwrap();
        assert_eq!(points, 17.5 - i as f64);
    }
    for (number, grade) in [
        ("2000", ""),
        ("2001", "EX"),
        ("2002", ""),
        ("2003", ""),
        ("2004", ""),
        ("2005", ""),
        ("2006", "20"),
        ("99", ""),
    ] {
        assert_eq!(grades[number], grade, "{number}");
    }
    assert!(
        !made
            .notes
            .iter()
            .any(|note| matches!(note, Note::NotInRoster { .. }))
    );
    // the other assignment is as it was
    assert_eq!(
        import(&made.files[0].bytes, "4314281"),
        import(gradebook().as_bytes(), "4314281")
    );
}

#[test]
fn nothing_but_the_column_is_touched_and_a_second_time_changes_nothing() {
    let class = Class::hostile();
    let rows = class.rows();
    let text = gradebook();
    let made = release(&rows, &text);
    let again = String::from_utf8(made.files[0].bytes.clone()).unwrap();
    assert_eq!(release(&rows, &again).files, made.files);
    let mut emptied = Sheet::read("x", again.as_bytes()).unwrap();
    let students: Vec<usize> = emptied
        .below_header()
        .filter(|row| is_student(&emptied, *row))
        .collect();
    for row in students {
        emptied.set(row, 6, "");
    }
    assert_eq!(String::from_utf8(emptied.bytes()).unwrap(), text);
}

#[test]
fn a_gradebook_with_decimal_commas_keeps_them() {
    let mut class = Class::of_roster("id,name,lms_id\ns1,Ada,7\ns2,Bo,8\n");
    class.grade("s1", 18.5);
    class.grade("s2", 24.0);
    let rows = class.rows();
    for possible in ["24,00", "24"] {
        let text = format!(
            "Student;ID;SIS Login ID;Section;01-kinematics (5)\n    Points Possible;;;;{possible}\nAda;7;a;S;\nBo;8;b;S;24,00\n"
        );
        let made = release(&rows, &text);
        let filled = String::from_utf8(made.files[0].bytes.clone()).unwrap();
        // 24,00 says 24 already
        assert!(
            filled.ends_with("Ada;7;a;S;18,5\nBo;8;b;S;24,00\n"),
            "{filled}"
        );
        assert_eq!(import(filled.as_bytes(), "5")["7"], "18.5");
    }
}

#[test]
fn people_are_matched_by_number_id_login_and_unique_name() {
    let mut class = Class::of_roster(
        "id,name,username,lms_id\ns1,Ada,,11\ns2,Bo,,\ns3,Cy,cyrus,\ns4,Doe Jane,,\ns5,Jane Doe,,\ns6,Eve,,\n",
    );
    for (i, id) in ["s1", "s2", "s3", "s4", "s5", "s6"].iter().enumerate() {
        class.grade(id, i as f64 + 1.0);
    }
    let rows = class.rows();
    let text = "Student,ID,SIS User ID,SIS Login ID,Section,Kinematics (5)\n\
        \"X\",11,,,S,\n\
        \"X\",12,s2,,S,\n\
        \"X\",13,,cyrus,S,\n\
        \"Doe, Jane\",14,,,S,\n\
        \"Jane Doe\",15,,,S,\n\
        \"Eve\",16,,,S,N/A\n";
    let made = release(&rows, text);
    let grades = import(&made.files[0].bytes, "5");
    let grades: Vec<&str> = grades.values().map(String::as_str).collect();
    // `Doe, Jane` and `Jane Doe` are one name
    assert_eq!(grades, ["1", "2", "3", "", "", "N/A"]);
    let notes: Vec<String> = made.notes.iter().map(ToString::to_string).collect();
    assert!(
        notes[0].contains("line 5 (Doe, Jane): left as it is: several rows have this name"),
        "{notes:?}"
    );
    assert!(notes.iter().any(|note| {
        note.starts_with("s6: no points are written, because the assignment is not assigned")
    }));
}

#[test]
fn names_in_two_columns_are_one_name() {
    let mut class = Class::of_roster("id,name\ns1,Jane Doe\n");
    class.grade("s1", 2.0);
    let rows = class.rows();
    let text = "LastName,FirstName,ID,SIS Login ID,Section,Kinematics (5)\nDoe,Jane,14,jd,S,\n";
    let made = release(&rows, text);
    assert!(made.files[0].bytes.ends_with(b"Doe,Jane,14,jd,S,2\n"));
}

#[test]
fn the_column_is_certain_or_refused() {
    let class = Class::hostile();
    let rows = class.rows();
    let header = "Student,ID,SIS Login ID,Section,Kinematics (5),Kinematics again (6),Essay (7),Final Score\n    Points Possible,,,,24,24,24,(read only)\n";
    let with = |points: Option<&str>, text: &str| {
        let named = Material {
            columns: Columns {
                points,
                ..Columns::default()
            },
            ..material(&rows, Some(text.as_bytes()))
        };
        match FORM.release(&named) {
            Ok(_) => String::new(),
            Err(error) => error.to_string(),
        }
    };
    for named in ["Kinematics (5)", "6", "essay", "Essay (7)"] {
        assert_eq!(with(Some(named), header), "", "{named}");
    }
    for (named, text, part) in [
        (
            None,
            header,
            "several columns for the lab (Kinematics or 01-kinematics): Kinematics (5) | Kinematics again (6)",
        ),
        (
            Some("Quiz"),
            header,
            "no column for `Quiz`; found: Kinematics (5) | Kinematics again (6) | Essay (7)",
        ),
        (Some("Final Score"), header, "`Final Score` is read-only"),
        (
            None,
            "Student,ID,SIS Login ID,Section,Essay (7)\n",
            "no column for the lab (Kinematics or 01-kinematics); found: Essay (7)",
        ),
        (
            None,
            "Student,ID,SIS Login ID,Section,Kinematics (5)\n    Points Possible,,,,100.00\nLovelace,1000,,S,\n",
            "line 2: the maximum is 100 there, and 24 in the lab",
        ),
        (
            None,
            "Student,ID,SIS Login ID,Section,Kinematics (5)\n    Points Possible,,,,(read only)\n",
            "`Kinematics (5)` is read-only",
        ),
        (None, "Name,Kinematics (5)\n", "no column for `Student`"),
    ] {
        let refused = with(named, text);
        assert!(refused.contains(part), "{refused}");
    }
}

#[test]
fn who_is_excused_in_canvas_stays_so() {
    let mut class = Class::of_roster("id,name\ns1,Ada\ns2,Bo\ns3,Cy\n");
    class.grade("s1", 2.0);
    class.of("s2").status = Status::Excused;
    class.of("s3").status = Status::Excused;
    let rows = class.rows();
    let text = "Student,ID,SIS Login ID,Section,Kinematics (5)\nAda,1,s1,,EX\nBo,2,s2,,ex\nCy,3,s3,,4.00\n";
    let made = release(&rows, text);
    let filled = String::from_utf8(made.files[0].bytes.clone()).unwrap();
    assert!(
        filled.ends_with("Ada,1,s1,,EX\nBo,2,s2,,ex\nCy,3,s3,,EX\n"),
        "{filled}"
    );
    let notes: Vec<String> = made.notes.iter().map(ToString::to_string).collect();
    assert_eq!(
        notes,
        [
            "s1: no points are written, because they are excused in the LMS: excuse them in fixes.toml too, or remove it there",
            "s3: EX replaces 4.00",
        ]
    );
}

#[test]
fn an_excused_person_who_is_not_there_is_noted() {
    let mut class = Class::of_roster("id,name\ns1,Ada\n");
    class.of("s1").status = Status::Excused;
    let rows = class.rows();
    let text = "Student,ID,SIS Login ID,Section,Kinematics (5)\n";
    let notes = release(&rows, text).notes;
    assert!(
        matches!(&notes[..], [Note::NotInExport { .. }]),
        "{notes:?}"
    );
}

#[test]
fn a_grade_of_an_earlier_lab_is_not_written_where_the_maximum_is_another() {
    let mut class = Class::hostile();
    // everybody else was regraded: the lab counts to 30 by now
    for id in ["s02", "s03"] {
        class.of(id).max_points = Some(30.0);
    }
    let rows = class.rows();
    let text = "Student,ID,SIS User ID,SIS Login ID,Section,Kinematics (5)\n    Points Possible,,,,,30.00\n\
        Ada,1000,s01,,S,\nLine,1001,s02,,S,\n";
    let of = |maximum: f64| Material {
        max_points: maximum,
        ..material(&rows, Some(text.as_bytes()))
    };
    let made = FORM.release(&of(30.0)).unwrap();
    let cells = String::from_utf8(made.files[0].bytes.clone()).unwrap();
    assert!(
        cells.contains("s01,,S,\n") && cells.contains("s02,,S,16.5\n"),
        "{cells}"
    );
    let notes: Vec<String> = made.notes.iter().map(ToString::to_string).collect();
    assert!(
        notes.contains(
            &"s01: 17.5 of 24 points are not written, because the LMS counts to 30: regrade the lab, or enter them there by hand"
                .to_owned()
        ),
        "{notes:?}"
    );
    // nobody was regraded yet: neither a scaled number nor one of another maximum
    let text = text.replace("Line,1001,s02,,S,\n", "");
    let of = |maximum: f64| Material {
        max_points: maximum,
        ..material(&rows, Some(text.as_bytes()))
    };
    let made = FORM.release(&of(30.0)).unwrap();
    assert_eq!(made.files[0].bytes, text.as_bytes());
    let error = FORM.release(&of(24.0)).unwrap_err().to_string();
    assert!(
        error.contains("the maximum is 30 there, and 24 in the lab"),
        "{error}"
    );
}
