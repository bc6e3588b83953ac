//! The fresh table and files that are filled in, read back by a plain CSV reader.

use super::*;
use crate::release::sample::{Class, HOSTILE, change, material};
use crate::release::{Columns, Note, Row};

fn text_of(made: &Made) -> String {
    String::from_utf8(made.files[0].bytes.clone()).unwrap()
}

fn read(text: &str) -> Vec<csv::StringRecord> {
    let mut reader = csv::ReaderBuilder::new()
        .has_headers(false)
        .from_reader(text.as_bytes());
    // an error where a row has another number of cells
    reader.records().map(Result::unwrap).collect()
}

fn fill(rows: &[Row<'_>], text: &str, columns: Columns<'_>) -> Result<Made, ReleaseError> {
    FORM.release(&Material {
        columns,
        ..material(rows, Some(text.as_bytes()))
    })
}

#[test]
fn a_fresh_table_has_a_row_for_everybody_and_a_column_a_check() {
    let mut class = Class::hostile();
    class.of("s02").late_s = Some(90);
    class.of("s02").by_hand = vec![change(Some("fk/mean-error"), 0.5, "why, \"so\"", false)];
    let rows = class.rows();
    let made = FORM.release(&material(&rows, None)).unwrap();
    let table = read(&text_of(&made));
    assert_eq!(table.len(), 1 + rows.len());
    let header: Vec<&str> = table[0].iter().take(8).collect();
    assert_eq!(
        header,
        [
            "id",
            "points",
            "max_points",
            "status",
            "late_s",
            "comment",
            "fk/straight",
            "fk/mean-error"
        ]
    );
    let second: Vec<&str> = table[2].iter().collect();
    assert_eq!(second[..5], ["s02", "16.5", "24", "graded", "90"]);
    assert!(second[5].contains(" | By hand: +0.5 for Mean position error: why, \"so\" | "));
    assert_eq!(second[6..8], ["1", "1.7"]);
    let missing: Vec<&str> = table[9].iter().collect();
    assert_eq!(missing[..6], ["m", "", "24", "missing", "", ""]);
    assert!(missing[6..].iter().all(|cell| cell.is_empty()));
    // no name anywhere
    assert!(!text_of(&made).contains("Lovelace"));
}

#[test]
fn no_cell_of_a_fresh_table_is_a_formula() {
    let mut class = Class::of_roster("id,name\n=SUM(A1),x\n-0.5,y\n\"+1,2\",z\n@x,u\n");
    for (id, points) in [("=SUM(A1)", 1.0), ("-0.5", 2.0), ("+1,2", 3.0), ("@x", 4.0)] {
        class.grade(id, points);
    }
    let rows = class.rows();
    let made = FORM.release(&material(&rows, None)).unwrap();
    let table = read(&text_of(&made));
    let ids: Vec<&str> = table.iter().skip(1).map(|row| &row[0]).collect();
    assert_eq!(ids, ["'=SUM(A1)", "-0.5", "'+1,2", "'@x"]);
    for cell in table.iter().flatten() {
        let is_formula =
            cell.starts_with(['=', '+', '-', '@', '\t', '\r']) && cell.parse::<f64>().is_err();
        assert!(!is_formula, "{cell}");
    }
    // filled with the same grades it stays as it is: the guarded ids are known again
    let again = fill(&rows, &text_of(&made), Columns::default()).unwrap();
    assert_eq!(text_of(&again), text_of(&made));
    assert!(again.notes.is_empty(), "{:?}", again.notes);
}

#[test]
fn named_columns_of_any_table_are_filled() {
    let class = Class::hostile();
    let rows = class.rows();
    let text = "Matrikelnummer;Name;Punkte;Notiz;Rest\r\ns01;\"Ada; Lady\";;;=A1\r\nlogins02;x;;;\r\nm@x.org;y;;;\r\nguest;z;;;\r\n";
    let columns = Columns {
        id: Some("matrikelnummer"),
        points: Some("Punkte"),
        comment: Some("Notiz"),
    };
    let made = fill(&rows, text, columns).unwrap();
    let filled = text_of(&made);
    let lines: Vec<&str> = filled.lines().collect();
    assert!(lines[1].starts_with("s01;\"Ada; Lady\";17,5;"), "{filled}");
    assert!(
        lines[1].ends_with(";=A1") && lines[1].contains("Kinemark, Kinematics: 17.5 of 24 points.")
    );
    assert!(lines[2].starts_with("logins02;x;16,5;"));
    assert_eq!(lines[3..], ["m@x.org;y;;;", "guest;z;;;"]);
    assert_eq!(text_of(&fill(&rows, &filled, columns).unwrap()), filled);
    let left_out = made
        .notes
        .iter()
        .filter(|note| matches!(note, Note::NotInExport { .. }));
    assert_eq!(left_out.count(), HOSTILE.len() - 2 + 1);
}

#[test]
fn characters_that_a_file_cannot_hold_are_noted() {
    let mut class = Class::of_roster("id,name\ns1,Ada\n");
    class.grade("s1", 10.0);
    class.of("s1").by_hand = vec![change(None, 1.0, "日本 ü", false)];
    let rows = class.rows();
    let text = "id,points,comment,ä\ns1,,,\n";
    let bytes = encoding_rs::WINDOWS_1252.encode(text).0.into_owned();
    let made = FORM.release(&material(&rows, Some(&bytes))).unwrap();
    let filled = encoding_rs::WINDOWS_1252.decode(&made.files[0].bytes).0;
    assert!(filled.contains("the total: ?? ü"), "{filled}");
    assert!(matches!(&made.notes[..], [Note::Unencodable { .. }]));
    let again = FORM
        .release(&material(&rows, Some(&made.files[0].bytes)))
        .unwrap();
    assert_eq!(again.files, made.files);
}

#[test]
fn columns_that_are_not_there_are_refused() {
    let class = Class::hostile();
    let rows = class.rows();
    for (text, columns, part) in [
        (
            "a,b\n",
            Columns::default(),
            "no column for `id`; found: a | b",
        ),
        ("id,b\n", Columns::default(), "no column for `points`"),
        (
            "id,points\n",
            Columns {
                comment: Some("c"),
                ..Columns::default()
            },
            "no column for `c`",
        ),
        (
            "id,id,points\n",
            Columns::default(),
            "several columns for id",
        ),
    ] {
        let error = fill(&rows, text, columns).unwrap_err().to_string();
        assert!(error.contains(part), "{error}");
    }
}
