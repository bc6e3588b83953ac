//! Worksheets in several languages and encodings, read back as Moodle's import reads them.

use std::collections::BTreeMap;
use std::io::Read as _;

use super::*;
use crate::release::sample::{Class, HOSTILE, change, material};
use crate::release::{Columns, Export, Row};

/// A row as Moodle's import takes it.
#[derive(Debug, PartialEq)]
struct Imported {
    grade: Option<f64>,
    feedback: String,
}

/// Reads a worksheet as `importgradeslib.php` does: UTF-8 with or without a mark, cells by `fgetcsv` with a backslash as escape, a row
/// must have as many cells as the header, columns by their exact headers, the participant behind the language's word for it.
fn import(bytes: &[u8], headers: [&str; 4], word: &str, decimal: &str) -> BTreeMap<u64, Imported> {
    let text = std::str::from_utf8(bytes).unwrap();
    let text = text.trim_start_matches('\u{feff}').replace("\r\n", "\n");
    let header = text.lines().next().unwrap();
    let is_wide = header.matches(';').count() > header.matches(',').count();
    let delimiter = if is_wide { b';' } else { b',' };
    let mut reader = csv::ReaderBuilder::new()
        .delimiter(delimiter)
        .escape(Some(b'\\'))
        .double_quote(true)
        .from_reader(text.as_bytes());
    let header = reader.headers().unwrap().clone();
    let at = |name: &str| header.iter().position(|header| header == name).unwrap();
    let [id, grade, _modified, feedback] = headers.map(at);
    let mut all = BTreeMap::new();
    // an error where a row has another number of cells
    for row in reader.records().map(Result::unwrap) {
        let number = row[id].strip_prefix(word).unwrap().trim();
        let Ok(number) = number.parse() else { continue };
        // unformat_float: spaces away, the language's sign to a point, then what PHP reads of it
        let grade = row[grade].trim().replace(' ', "").replace(decimal, ".");
        let grade = (!grade.is_empty()).then(|| grade.parse().unwrap());
        let feedback = row[feedback].to_owned();
        all.insert(number, Imported { grade, feedback });
    }
    all
}

const ENGLISH: [&str; 4] = [
    "Identifier",
    "Grade",
    "Last modified (grade)",
    "Feedback comments",
];

fn quoted(text: &str) -> String {
    format!("\"{}\"", text.replace('"', "\"\""))
}

/// A worksheet of the hostile class in English, with a column that nobody knows and a row of somebody else.
fn worksheet(maximum: &str) -> String {
    let mut text = "Identifier,\"Full name\",\"Email address\",Status,Grade,\"Maximum grade\",\"Grade can be changed\",\"Mystery; column\",\"Last modified (grade)\",\"Feedback comments\"\r\n".to_owned();
    let mut row = |number: usize, name: &str, email: &str| {
        text += &format!(
            "\"Participant {number}\",{},{email},\"Submitted for grading - \",,{maximum},Yes,\"=1+1 \"\"kept\"\"\",\"Wednesday, 23 September 2026, 9:00 PM\",\r\n",
            quoted(name)
        );
    };
    for (i, (id, name)) in HOSTILE.iter().enumerate() {
        row(100 + i, name, &format!("{}@X.org", id.to_uppercase()));
    }
    for (i, id) in ["m", "e", "h", "g", "p", "n", "b"].iter().enumerate() {
        row(200 + i, &format!("Person {id}"), &format!("{id}@x.org"));
    }
    row(300, "A Guest", "guest@x.org");
    text
}

fn release(rows: &[Row<'_>], bytes: &[u8]) -> Made {
    FORM.release(&material(rows, Some(bytes))).unwrap()
}

#[test]
fn a_worksheet_is_read_back_by_the_rules_of_the_import() {
    let class = Class::hostile();
    let rows = class.rows();
    let text = worksheet("24.00");
    let made = release(&rows, text.as_bytes());
    assert_eq!(made.files[0].path, "Grades-R-Lab 1-77.csv");
    let imported = import(&made.files[0].bytes, ENGLISH, "Participant ", ".");
    for i in 0..HOSTILE.len() {
        let row = &imported[&(100 + i as u64)];
        assert_eq!(row.grade, Some(17.5 - i as f64), "{i}");
        assert!(
            row.feedback.starts_with("Kinemark, Kinematics: 1"),
            "{}",
            row.feedback
        );
        assert!(!row.feedback.contains(['\n', '\\', '"', '<']) || row.feedback.contains("<br>"));
    }
    // missing, excused, host limit, grader fault, pending, needs a person: empty, and never 0
    for number in (200..206).chain([300]) {
        let row = &imported[&number];
        assert_eq!((row.grade, row.feedback.as_str()), (None, ""), "{number}");
    }
    assert_eq!(imported[&206].grade, Some(20.0));
    assert!(
        imported[&206]
            .feedback
            .contains("By hand: +20 for the total: shown in person")
    );
    let guests: Vec<&Note> = made
        .notes
        .iter()
        .filter(|note| matches!(note, Note::NotInRoster { .. }))
        .collect();
    // the name of the second person takes two lines
    assert_eq!(
        guests[0].to_string(),
        "line 18 (A Guest): left as it is: nobody in roster.csv has its id, address or name"
    );
    assert_eq!(guests.len(), 1);
}

#[test]
fn everything_but_two_columns_keeps_its_bytes_and_a_second_time_changes_nothing() {
    let class = Class::hostile();
    let rows = class.rows();
    let text = worksheet("24.00");
    let once = release(&rows, text.as_bytes()).files;
    let twice = release(&rows, &once[0].bytes);
    assert_eq!(twice.files, once);
    // without grade and comment the lines are those of before
    let plain = |text: &str| {
        let mut sheet = Sheet::read("x", text.as_bytes()).unwrap();
        let below: Vec<usize> = sheet.below_header().collect();
        for row in below {
            sheet.set(row, 4, "");
            sheet.set(row, 9, "");
        }
        String::from_utf8(sheet.bytes())
            .unwrap()
            .replace("\"\"\r\n", "\r\n")
    };
    let filled = String::from_utf8(once[0].bytes.clone()).unwrap();
    assert_eq!(plain(&filled), plain(&text));
    assert!(filled.contains("\"=1+1 \"\"kept\"\"\""));
    assert!(filled.contains("\"Participant 102\",\"=SUM(A1) Formula\",S03@X.org"));
}

#[test]
fn a_german_worksheet_in_its_own_signs() {
    let class = Class::hostile();
    let rows = class.rows();
    let header = "ID;\"Vollständiger Name\";E-Mail-Adresse;Status;Gruppe;Bewertung;Bestwertung;\"Bewertung kann geändert werden\";\"Zuletzt geändert (Abgabe)\";\"Zuletzt geändert (Bewertung)\";\"Feedback als Kommentar\"\n";
    let headers = [
        "ID",
        "Bewertung",
        "Zuletzt geändert (Bewertung)",
        "Feedback als Kommentar",
    ];
    // by the maxima; by the language where these have no decimals; cells apart by commas
    for (maximum, delimiter) in [("24,00", ";"), ("24", ";"), ("24", ",")] {
        let body =
            format!("Teilnehmer/in1001;\"Zoë 😀 Ångström\";s06@x.org;-;;;{maximum};Ja;-;-;\n");
        let text = format!("{header}{body}").replace(';', delimiter);
        let made = release(&rows, text.as_bytes());
        let imported = import(&made.files[0].bytes, headers, "Teilnehmer/in", ",");
        assert_eq!(imported[&1001].grade, Some(12.5));
        let filled = String::from_utf8(made.files[0].bytes.clone()).unwrap();
        let cell = if delimiter == ";" {
            ";12,5;"
        } else {
            ",\"12,5\","
        };
        assert!(filled.contains(cell), "{filled}");
        assert_eq!(release(&rows, filled.as_bytes()).files, made.files);
    }
    // German headers, and points before the decimals: the cells decide
    let body = "Teilnehmer/in1001;Zoë;s06@x.org;-;;;24.00;Ja;-;-;\n";
    let made = release(&rows, (header.to_owned() + body).as_bytes());
    let filled = String::from_utf8(made.files[0].bytes.clone()).unwrap();
    assert!(filled.contains(";12.5;24.00;"), "{filled}");
}

#[test]
fn headers_are_known_in_every_language() {
    let class = Class::hostile();
    let rows = class.rows();
    for (header, identifier) in [
        (
            "Identifiant,Nom complet,Adresse de courriel,Statut,Note,Note maximale,La note peut être modifiée,Dernière modification (note),Feedback par commentaires",
            "Participant 7",
        ),
        (
            "Identificador,Nombre completo,Dirección de correo,Estado,Calificación,Calificación máxima,x,Última modificación (calificación),Comentarios de retroalimentación",
            "Participante 7",
        ),
        (
            "Identificativo,Nome,Indirizzo email,Stato,Valutazione,Valutazione massima,x,Ultima modifica (valutazione),Commenti",
            "Partecipante 7",
        ),
        (
            "Identificatie,Volledige naam,E-mailadres,Status,Cijfer,Maximaal cijfer,x,Laatst gewijzigd (beoordeling),Feedback tekstvak",
            "Deelnemer 7",
        ),
        (
            "Identificador,Nome completo,Endereço de e-mail,Estado,Avaliação,Nota máxima,x,Última atualização (avaliação),Comentários de feedback",
            "Participante 7",
        ),
        (
            "Identifierare,Fullständigt namn,E-postadress,Status,Betyg,Maxbetyg,x,Senast modifierat (betyg),Återkopplingskommentarer",
            "Deltagare 7",
        ),
        (
            "IDENTIFIER,Full Name,Email Address,Status,Grade,Maximum Grade,x,Last Modified (Grade),Feedback Comments",
            "Participant 7",
        ),
    ] {
        let text = format!("{header}\n{identifier},Zoë 😀 Ångström,,-,,24,x,-,\n");
        let made = release(&rows, text.as_bytes());
        let filled = String::from_utf8(made.files[0].bytes.clone()).unwrap();
        let grade = if header.starts_with("IDENT") {
            ",12.5,24"
        } else {
            ",\"12,5\",24"
        };
        assert!(filled.contains(grade), "{filled}");
        assert!(
            filled.contains("Kinemark, Kinematics: 12.5 of 24 points"),
            "{header}"
        );
    }
}

#[test]
fn other_encodings_come_back_as_they_were() {
    let mut class = Class::hostile();
    class.of("s06").by_hand = vec![change(None, 0.5, "≤ 日本", false)];
    let rows = class.rows();
    let text = worksheet("24.00");
    // UTF-16 as spreadsheets write it, apart by tabs
    let tabs = text
        .replace(',', "\t")
        .replace("Wednesday\t 23 September 2026\t ", "");
    let utf16: Vec<u8> = [0xff, 0xfe]
        .into_iter()
        .chain(tabs.encode_utf16().flat_map(u16::to_le_bytes))
        .collect();
    let made = release(&rows, &utf16);
    let filled = encoding_rs::UTF_16LE.decode(&made.files[0].bytes).0;
    assert!(
        filled.contains(
            "s01@x.org"
                .to_uppercase()
                .replace("X.ORG", "X.org")
                .as_str()
        )
    );
    assert!(filled.contains("\t17.5\t24.00\t"), "{filled}");
    assert_eq!(release(&rows, &made.files[0].bytes).files, made.files);
    // Windows-1252: a character that it lacks is written as HTML writes it
    let header =
        "Identifier;Full name;Email address;Grade;Last modified (grade);Feedback comments\r\n";
    let narrow = format!("{header}Participant 5;Zo\u{eb};s06@x.org;;-;\r\n");
    let bytes = encoding_rs::WINDOWS_1252.encode(&narrow).0.into_owned();
    let made = release(&rows, &bytes);
    let filled = encoding_rs::WINDOWS_1252.decode(&made.files[0].bytes).0;
    assert!(filled.contains(";Zoë;s06@x.org;12,5;-;"), "{filled}");
    assert!(filled.contains("&#8804; &#26085;&#26412;"), "{filled}");
    assert_eq!(release(&rows, &made.files[0].bytes).files, made.files);
}

#[test]
fn people_are_matched_by_number_address_and_unique_name_and_never_by_a_guess() {
    let mut class = Class::of_roster(
        "id,name,email\ns1,Li Wei,li1@x.org\ns2,Li Wei,li2@x.org\ns3,Bo Ek,bo@x.org\ns4,Kim,\n",
    );
    for (id, points) in [("s1", 1.0), ("s2", 2.0), ("s3", 3.0), ("s4", 4.0)] {
        class.grade(id, points);
    }
    let rows = class.rows();
    let text = "Identifier,Full name,ID number,Email address,Grade,Maximum grade,Last modified (grade)\n\
        Participant 1,Li Wei,,li1@x.org,,24.00,-\n\
        Participant 2,Li Wei,S2,,,24.00,-\n\
        Participant 3,Bo Ek,,private@y.org,,24.00,-\n\
        Participant 4,Kim,,,,24.00,-\n\
        Participant 5,Kim Other,s4,bo@x.org,,24.00,-\n";
    let made = release(&rows, text.as_bytes());
    let filled = String::from_utf8(made.files[0].bytes.clone()).unwrap();
    let grades: Vec<&str> = filled
        .lines()
        .skip(1)
        .map(|line| line.split(',').nth(4).unwrap())
        .collect();
    assert_eq!(grades, ["1", "2", "", "4", ""]);
    let notes: Vec<String> = made.notes.iter().map(ToString::to_string).collect();
    assert_eq!(
        notes,
        [
            "line 4 (Bo Ek): left as it is: the name is that of s3, but the e-mail address is not: `private@y.org` there, `bo@x.org` in roster.csv",
            "line 6 (Kim Other): left as it is: it has something of s3 and something of s4",
            "s3: not in the LMS's file, or not for certain: write the id, e-mail address or name of the LMS into roster.csv",
        ]
    );
}

#[test]
fn what_people_wrote_is_kept_and_what_is_replaced_is_noted() {
    let mut class = Class::of_roster("id,name\ns1,Ada\ns2,Bo\ns3,Cy\n");
    class.grade("s1", 10.0);
    class.grade("s2", 25.0);
    let rows = class.rows();
    let text = "Identifier,Full name,Grade,Maximum grade,Last modified (grade),Feedback comments\n\
        Participant 1,Ada,9.50 / 24.00,24.00,-,See me\n\
        Participant 2,Bo,-,24.00,-,\"Kinemark, Old: 3 of 24 points.\"\n\
        Participant 3,Cy,11.00,24.00,-,Well done\n";
    let made = release(&rows, text.as_bytes());
    let filled = String::from_utf8(made.files[0].bytes.clone()).unwrap();
    let lines: Vec<&str> = filled.lines().collect();
    assert_eq!(lines[1], "Participant 1,Ada,10,24.00,-,See me");
    assert!(lines[2].starts_with("Participant 2,Bo,-,24.00,-,\"Kinemark, Kinematics: 25 of 24"));
    assert_eq!(lines[3], "Participant 3,Cy,11.00,24.00,-,Well done");
    let notes: Vec<String> = made.notes.iter().map(ToString::to_string).collect();
    assert_eq!(
        notes,
        [
            "s1: 10 replaces 9.50 / 24.00",
            "s1: the comment that is there is kept",
            "s2: 25 points are not written, because the LMS takes no more than 24: enter them there by hand",
        ]
    );
}

#[test]
fn a_worksheet_that_does_not_fit_is_refused_with_what_to_do() {
    let class = Class::hostile();
    let rows = class.rows();
    let refused = |text: &str| {
        let error = FORM
            .release(&material(&rows, Some(text.as_bytes())))
            .unwrap_err();
        let help = miette::Diagnostic::help(&error).unwrap().to_string();
        format!("{error} / {help}")
    };
    for (text, part) in [
        (
            worksheet("100.00"),
            "line 2: the maximum is 100 there, and 24 in the lab / set the maximum of the assignment to 24 and download the file again; points are not scaled",
        ),
        (
            "Identifier,Grade,Scale,Last modified (grade)\n".to_owned(),
            "graded on a scale of words",
        ),
        (
            "Identifier,Full name,Points\n".to_owned(),
            "no column for the points (`Grade`); found: Identifier | Full name | Points / download the worksheet with Moodle in English",
        ),
        (
            "Identifier,Grade,Grade,Last modified (grade)\n".to_owned(),
            "several columns for the points (`Grade`): Grade | Grade",
        ),
        (
            "Identifier,Full name,Grade,Last modified (grade)\nParticipant 1,Doe, Jo,,-,x\n"
                .to_owned(),
            "line 2: 6 cells, and the header has 4",
        ),
        ("PK\u{3}\u{4}".to_owned(), "is a spreadsheet or an archive"),
    ] {
        let refused = refused(&text);
        assert!(refused.contains(part), "{refused}");
    }
}

#[test]
fn columns_in_an_unknown_language_can_be_named() {
    let mut class = Class::of_roster("id,name\ns1,Ada\n");
    class.grade("s1", 10.0);
    let rows = class.rows();
    let text = "Identifier,Matrikel,Pisteet,Last modified (grade),Palaute\nParticipant 1,s1,,-,\n";
    let named = Material {
        columns: Columns {
            id: Some("matrikel"),
            points: Some("Pisteet"),
            comment: Some("Palaute"),
        },
        export: Some(Export {
            name: "a/b.csv",
            bytes: text.as_bytes(),
        }),
        ..material(&rows, None)
    };
    let made = FORM.release(&named).unwrap();
    assert_eq!(made.files[0].path, "b.csv");
    let filled = String::from_utf8(made.files[0].bytes.clone()).unwrap();
    assert!(
        filled.contains("Participant 1,s1,10,-,\"Kinemark, "),
        "{filled}"
    );
    let wrong = Material {
        columns: Columns {
            points: Some("Punkte"),
            ..named.columns
        },
        ..named
    };
    let error = FORM.release(&wrong).unwrap_err().to_string();
    assert!(
        error.contains("no column for `Punkte`; found: Identifier | Matrikel"),
        "{error}"
    );
}

/// Whose a file of the zip is, and its name there, by `importziplib.php`: the first part of the path with four parts apart by `_`, whose
/// second is the number of a participant.
fn feedback_file(path: &str, participants: &[u64]) -> Option<(u64, String)> {
    let name = path.rsplit('/').next()?;
    if name.starts_with(['.', '~']) {
        return None;
    }
    let mut parts: Vec<&str> = path.split('/').collect();
    while !parts.is_empty() {
        let info: Vec<&str> = parts.remove(0).splitn(5, '_').collect();
        let Some(Ok(number)) = info.get(1).map(|part| part.parse()) else {
            continue;
        };
        if info.len() < 4
            || !participants.contains(&number)
            || info[2..4] != ["assignsubmission", "file"]
        {
            continue;
        }
        let rest = [
            &[info.get(4).copied().unwrap_or_default()],
            parts.as_slice(),
        ]
        .concat();
        return Some((number, rest.join("/").trim_start_matches('/').to_owned()));
    }
    None
}

#[test]
fn the_zip_is_read_back_by_the_rules_of_its_import() {
    let class = Class::hostile();
    let rows = class.rows();
    let made = release(&rows, worksheet("24.00").as_bytes());
    assert_eq!(made.files[1].path, "feedback.zip");
    let bytes = made.files[1].bytes.clone();
    let mut zip = zip::ZipArchive::new(std::io::Cursor::new(bytes)).unwrap();
    let participants: Vec<u64> = (100..108).chain(200..207).collect();
    let mut found: BTreeMap<u64, Vec<String>> = BTreeMap::new();
    for i in 0..zip.len() {
        let mut file = zip.by_index(i).unwrap();
        let mut text = String::new();
        file.read_to_string(&mut text).unwrap();
        let (number, name) = feedback_file(&file.name().unwrap(), &participants).unwrap();
        match name.as_str() {
            "feedback.txt" => assert!(text.chars().count() <= 2000),
            "feedback.html" => assert!(text.len() < 100_000 && text.starts_with("<!DOCTYPE html>")),
            other => panic!("{other}"),
        }
        found.entry(number).or_default().push(name);
    }
    let numbers: Vec<u64> = found.keys().copied().collect();
    let expected: Vec<u64> = (100..108).chain([206]).collect();
    assert_eq!(numbers, expected);
    assert!(
        found
            .values()
            .all(|names| names == &["feedback.txt", "feedback.html"])
    );
    assert_eq!(rows.len(), participants.len());
}

#[test]
fn a_row_with_another_maximum_than_its_grade_is_left_as_it_is() {
    let mut class = Class::hostile();
    class.of("s02").max_points = Some(30.0);
    let rows = class.rows();
    let text = worksheet("24.00");
    let made = FORM
        .release(&material(&rows, Some(text.as_bytes())))
        .unwrap();
    let other: Vec<&Note> = made
        .notes
        .iter()
        .filter(|note| matches!(note, Note::OtherMaximum { .. }))
        .collect();
    assert_eq!(other.len(), 1, "{:?}", made.notes);
    assert_eq!(
        other[0].to_string(),
        "s02: 16.5 of 30 points are not written, because the LMS counts to 24: regrade the lab, or enter them there by hand"
    );
    let lines = String::from_utf8(made.files[0].bytes.clone()).unwrap();
    assert!(
        !lines.contains(",16.5,") && lines.contains(",17.5,"),
        "{lines}"
    );
}
