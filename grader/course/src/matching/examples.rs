//! What sources say of people, and whom it leads to.

use super::{Matched, Matcher, Unmatched};
use crate::layout::{Hint, PersonFiles};
use crate::roster::Roster;
use crate::student::StudentId;

const ROSTER: &str = "\
id,name,email,lms_id,username,group,repository
s1001,Ana Lima,ana@example.org,41,alima,Alpha,
s1002,\"Müller, Jörg\",joerg@example.org,42,jmueller,Alpha,
s1003,Kim Lee,kim1@example.org,43,klee,Beta,
s1004,Kim Lee,kim2@example.org,44,klee2,Beta,
s1005,Sean O'Brien,sean@example.org,,sob,,my-own-repo
s1006,Max Alpha Beta,max@example.org,46,ana-lima,,
7,Short Id,,47,lima,,
";

fn student(hints: &[Hint]) -> Result<Matched, Unmatched> {
    let roster = Roster::parse("roster.csv", ROSTER.as_bytes()).unwrap();
    Matcher::new(&roster).student_of(hints)
}

fn found(hints: &[Hint]) -> (Vec<String>, &'static str) {
    let matched = student(hints).unwrap_or_else(|why| panic!("{hints:?}: {why:?}"));
    let ids = matched.students.iter().map(StudentId::to_string);
    (ids.collect(), matched.by)
}

fn one(id: &str, by: &'static str) -> (Vec<String>, &'static str) {
    (vec![id.to_owned()], by)
}

fn name(text: &str) -> Hint {
    Hint::Name(text.to_owned())
}

fn path(text: &str) -> Hint {
    Hint::PathName(text.to_owned())
}

fn lms(text: &str) -> Hint {
    Hint::LmsId(text.to_owned())
}

fn slug(text: &str) -> Hint {
    Hint::Slug(text.to_owned())
}

fn repository(text: &str) -> Hint {
    Hint::Repository(text.to_owned())
}

fn group(text: &str) -> Hint {
    Hint::Group(text.to_owned())
}

#[test]
fn each_kind_of_hint_leads_to_its_person() {
    let of = |text: &str| text.to_owned();
    for (hint, expected) in [
        (Hint::Id(of("S1001")), one("s1001", "id")),
        (Hint::Id(of("alima")), one("s1001", "username")),
        (lms("41"), one("s1001", "lms_id")),
        (Hint::Username(of("ALima")), one("s1001", "username")),
        (Hint::Username(of("s1001")), one("s1001", "id")),
        (Hint::Email(of("Ana@Example.org")), one("s1001", "email")),
        (name("ana  lima"), one("s1001", "name")),
        (name("Jörg Müller"), one("s1002", "name")),
        (name("Müller, Jo\u{308}rg"), one("s1002", "name")),
        (name("Sean OBrien"), one("s1005", "name")),
        (slug("limaana"), one("s1001", "name")),
        (slug("müllerjörg"), one("s1002", "name")),
        (slug("alphabetamax"), one("s1006", "name")),
        (repository("lab1-alima"), one("s1001", "repository")),
        (repository("lab1-s1002"), one("s1002", "repository")),
        (repository("my-own-repo"), one("s1005", "repository")),
        (path("lab 1 - s1003 (final)"), one("s1003", "id")),
        (path("S1003"), one("s1003", "id")),
        (path("7"), one("7", "id")),
    ] {
        assert_eq!(found(std::slice::from_ref(&hint)), expected, "{hint:?}");
    }
}

#[test]
fn a_group_leads_to_its_members() {
    let both = (vec!["s1001".to_owned(), "s1002".to_owned()], "group");
    assert_eq!(found(&[group("alpha")]), both);
    assert_eq!(found(&[name("Alpha"), group("Alpha"), path("Alpha")]), both);
    // Canvas gives a group's hand-in the user id of one member
    assert_eq!(found(&[lms("42"), slug("alpha"), group("alpha")]), both);
    // the member of another group
    assert!(student(&[lms("43"), slug("alpha"), group("alpha")]).is_err());
}

#[test]
fn hints_that_agree_make_each_other_sure() {
    // equal names, and something else that says which
    assert_eq!(found(&[lms("44"), slug("leekim")]), one("s1004", "lms_id"));
    let email = Hint::Email("kim1@example.org".to_owned());
    assert_eq!(found(&[email, name("Kim Lee")]), one("s1003", "email"));
    assert_eq!(
        found(&[name("Ana Lima"), path("Ana Lima s1001")]),
        one("s1001", "id")
    );
    // no lms_id on the roster denies nothing
    assert_eq!(
        found(&[lms("99"), slug("obriensean")]),
        one("s1005", "name")
    );
}

#[test]
fn nobody_is_guessed() {
    for (hints, why, near) in [
        (vec![], "nothing in the source says whose it is", vec![]),
        (
            vec![name("Ana Lina")],
            "nobody on the roster is `Ana Lina`: no id, name, login, address, repository or group",
            vec!["s1001"],
        ),
        (
            vec![name("Kim Lee")],
            "2 people on the roster have the name `Kim Lee`",
            vec!["s1003", "s1004"],
        ),
        (
            vec![name("Ana Lima"), path("s1002")],
            "it leads to different people: the name `Ana Lima` to s1001; the id `s1002` to s1002",
            vec!["s1001", "s1002"],
        ),
        (
            vec![lms("41"), slug("leekim")],
            "it leads to different people: the lms_id `41` to s1001; the name `leekim` to s1003, s1004",
            vec!["s1001", "s1003", "s1004"],
        ),
        (
            vec![Hint::Id("s1010".to_owned()), name("Ana Lima")],
            "no id on the roster is `s1010`",
            vec!["s1001"],
        ),
        (
            vec![lms("99"), slug("limaana")],
            "the LMS has `99` for them, roster.csv has lms_id `41`",
            vec!["s1001"],
        ),
        (
            vec![path("s1001 and s1002")],
            "nobody on the roster is `s1001 and s1002`: no id, name, login, address, repository or group",
            vec![],
        ),
        // an id that may stand there by chance
        (
            vec![path("lab 7")],
            "nobody on the roster is `lab 7`: no id, name, login, address, repository or group",
            vec![],
        ),
        (
            vec![path("xs1001")],
            "nobody on the roster is `xs1001`: no id, name, login, address, repository or group",
            vec!["s1001"],
        ),
        // `lima` or `ana-lima`
        (
            vec![repository("lab1-ana-lima")],
            "2 people on the roster have the repository `lab1-ana-lima`",
            vec!["s1006", "7"],
        ),
    ] {
        let unmatched = student(&hints).unwrap_err();
        assert_eq!(unmatched.why, why);
        let ids: Vec<&str> = unmatched.nearest.iter().map(StudentId::as_str).collect();
        assert!(ids.starts_with(&near), "{why}: {ids:?}");
    }
}

#[test]
fn a_name_under_two_numbers_is_nobody_s() {
    let roster = Roster::parse("roster.csv", ROSTER.as_bytes()).unwrap();
    let person = |text: &str, number: &str, other: Option<Hint>| PersonFiles {
        hints: [name(text), path(text)].into_iter().chain(other).collect(),
        lms_number: Some(number.to_owned()),
        ..PersonFiles::default()
    };
    let all = [
        person("Ana Lima", "11", None),
        person(
            "Ana Lima",
            "12",
            Some(Hint::Email("ana@example.org".to_owned())),
        ),
        person("Jörg Müller", "13", None),
    ];
    let found = Matcher::new(&roster).students_of_all(&all);
    let unmatched = found[0].as_ref().unwrap_err();
    assert_eq!(
        unmatched.why,
        "two people in the source have the name `Ana Lima`"
    );
    assert_eq!(unmatched.nearest[0].as_str(), "s1001");
    assert_eq!(found[1].as_ref().unwrap().by, "email");
    assert_eq!(found[2].as_ref().unwrap().students[0].as_str(), "s1002");
}
