//! `roster.csv`: who takes the course. The only place with names.

use std::collections::BTreeMap;

use kinemark_sim::text::nearest;

use crate::course_text::decoded;
use crate::student::{StudentId, folded};

/// The columns with a meaning; others are kept for people and never read.
pub const COLUMNS: [&str; 8] = [
    "id",
    "name",
    "email",
    "section",
    "lms_id",
    "username",
    "group",
    "repository",
];

/// A person of the roster.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Person {
    /// The id, which everything else goes by.
    pub id: StudentId,
    /// Full name; empty where the roster has none.
    pub name: String,
    /// Address; empty where the roster has none.
    pub email: String,
    /// Section or tutorial group; empty where there is none.
    pub section: String,
    /// The id that the LMS uses in names of files, such as Canvas's user id; empty where it is unknown.
    pub lms_id: String,
    /// The login at the LMS or at a code host; empty where it is unknown.
    pub username: String,
    /// The group that hands in together; empty where there is none.
    pub group: String,
    /// The name of the repository of this person; empty where it ends in the username or the id.
    pub repository: String,
}

/// Who takes the course, in the order of the file.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Roster {
    people: Vec<Person>,
}

/// What is wrong with a roster.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error, miette::Diagnostic)]
#[error("{path}, line {line}: {problem}")]
pub struct RosterError {
    /// The file, as a person knows it.
    pub path: String,
    /// The line, from one.
    pub line: u64,
    /// What is wrong, in words.
    pub problem: String,
    /// What to do.
    #[help]
    pub help: String,
}

impl Roster {
    /// Reads a roster: a header, then a line a person, fields apart by `,`, `;` or tabs.
    ///
    /// # Errors
    /// A header without `id`, an id twice or one that differs from another only in case or composition, an lms_id or username of two
    /// people, a column that nearly has a name with a meaning, more fields than the header has.
    pub fn parse(path: &str, bytes: &[u8]) -> Result<Self, RosterError> {
        let text = decoded(bytes);
        let error = |line: u64, problem: String, help: &str| RosterError {
            path: path.to_owned(),
            line,
            problem,
            help: help.to_owned(),
        };
        let mut reader = csv::ReaderBuilder::new()
            .delimiter(delimiter(&text))
            .flexible(true)
            .trim(csv::Trim::All)
            .from_reader(text.as_bytes());
        let unread = |why: &csv::Error| {
            let line = why.position().map_or(1, csv::Position::line);
            error(line, format!("it cannot be read: {why}"), "save it as CSV")
        };
        let header = reader.headers().map_err(|why| unread(&why))?.clone();
        let columns = columns(&header).map_err(|(problem, help)| error(1, problem, &help))?;
        let has_open_quote = text.matches('"').count() % 2 == 1;
        let mut people: Vec<Person> = Vec::new();
        let mut taken = Taken::default();
        for record in reader.records() {
            let record = record.map_err(|why| unread(&why))?;
            let line = record.position().map_or(0, csv::Position::line);
            let field = |name: &str| {
                let at = columns.get(name);
                at.and_then(|at| record.get(*at))
                    .unwrap_or_default()
                    .to_owned()
            };
            if record.iter().all(str::is_empty) {
                continue;
            }
            // a name may go over two lines, but then its quote is closed
            if has_open_quote && record.iter().any(|field| field.contains(['\n', '\r'])) {
                return Err(error(
                    line,
                    "a field goes on over the end of its line".to_owned(),
                    "close the quote `\"` in this line, or take it out",
                ));
            }
            let beyond = record.iter().skip(header.len());
            if !beyond.clone().all(str::is_empty) {
                let problem = format!(
                    "{} fields, where the header has {}",
                    record.len(),
                    header.len()
                );
                return Err(error(line, problem, MORE_FIELDS));
            }
            if let Some((problem, help)) = is_no_id(&field("id")) {
                return Err(error(line, problem, help));
            }
            let id = StudentId::new(&field("id"))
                .map_err(|why| error(line, why, "give everybody an id of their own"))?;
            let person = Person {
                name: field("name"),
                email: field("email"),
                section: field("section"),
                lms_id: field("lms_id"),
                username: field("username"),
                group: field("group"),
                repository: field("repository"),
                id,
            };
            taken
                .add(line, &person)
                .map_err(|problem| error(line, problem, "give each person a value of their own"))?;
            people.push(person);
        }
        if people.is_empty() {
            return Err(error(
                1,
                "nobody is in it".to_owned(),
                "add a line a person below the header",
            ));
        }
        Ok(Self { people })
    }

    /// Everybody, in the order of the file.
    pub fn people(&self) -> &[Person] {
        &self.people
    }

    /// The person with this id.
    pub fn get(&self, id: &StudentId) -> Option<&Person> {
        self.people.iter().find(|person| person.id == *id)
    }
}

/// What one person has and no other may.
#[derive(Default)]
struct Taken(BTreeMap<(&'static str, String), (u64, String)>);

impl Taken {
    fn add(&mut self, line: u64, person: &Person) -> Result<(), String> {
        for (what, value) in [
            ("id", person.id.as_str()),
            ("lms_id", &person.lms_id),
            ("username", &person.username),
            ("repository", &person.repository),
        ] {
            if value.is_empty() {
                continue;
            }
            let first = self
                .0
                .insert((what, folded(value)), (line, value.to_owned()));
            match first {
                None => {}
                Some((first, known)) if known == value => {
                    return Err(format!("line {first} has the {what} `{value}`, too"));
                }
                Some((first, known)) => {
                    return Err(format!(
                        "{what} `{value}` differs from `{known}` in line {first} only by case or by how accents are typed"
                    ));
                }
            }
        }
        Ok(())
    }
}

/// What to do about a line with too many fields.
const MORE_FIELDS: &str = "put a field that has the sign between fields in it into quotes, such as \"Lee, Ann\", or take the sign out";

/// Why a text is no id that somebody chose, with what to do: it has other fields in it, or a spreadsheet has changed it.
fn is_no_id(text: &str) -> Option<(String, &'static str)> {
    // several fields in one
    if [",", ";", "\t"]
        .iter()
        .any(|sign| text.matches(sign).count() > 1)
    {
        let problem = format!("the id `{text}` has the sign between fields in it");
        return Some((problem, "use the same sign in all lines"));
    }
    let (number, power) = text.split_once(['E', 'e'])?;
    let is_number = number.contains(['.', ',']) && number.chars().all(|c| !c.is_alphabetic());
    let is_power = power.strip_prefix(['+', '-'])?.parse::<u8>().is_ok();
    (is_number && is_power).then(|| {
        (
            format!("the id `{text}` was a long number that a spreadsheet has shortened"),
            "write the number itself; in the spreadsheet, format the column as text",
        )
    })
}

/// The name of a column without what people put between its words.
fn plain_name(name: &str) -> String {
    folded(name).replace(['-', '_', ' ', '.'], "")
}

/// Names of columns for people that are no slips of one of [`COLUMNS`].
const OTHER_WORDS: [&str; 6] = ["surname", "session", "station", "fname", "lname", "emails"];

/// A column that is nearly one with a meaning, which no other column is; with that one.
fn misspelt<'h>(
    header: &'h csv::StringRecord,
    at: &BTreeMap<&'static str, usize>,
) -> Option<(&'h str, &'static str)> {
    let free = || COLUMNS.into_iter().filter(|known| !at.contains_key(known));
    let names = header.iter().enumerate();
    let mut others = names.filter(|(i, name)| {
        let is_read = at.values().any(|known| known == i);
        // the same column under its name and another writing of it
        let is_known = COLUMNS
            .iter()
            .any(|known| plain_name(known) == plain_name(name));
        !is_read && !is_known && !OTHER_WORDS.contains(&plain_name(name).as_str())
    });
    others.find_map(|(_, name)| {
        // an `id` is near to too much
        let known = free().filter(|known| known.len() > 2);
        Some((name, nearest(&plain_name(name), known)?))
    })
}

/// Where the columns are.
fn columns(header: &csv::StringRecord) -> Result<BTreeMap<&'static str, usize>, (String, String)> {
    let mut at = BTreeMap::new();
    for (i, name) in header.iter().enumerate() {
        // any other is a column for people
        let known = COLUMNS.iter().find(|known| folded(name) == **known);
        if let Some(known) = known
            && at.insert(*known, i).is_some()
        {
            return Err((
                format!("the column `{known}` is there twice"),
                "keep one of the two".to_owned(),
            ));
        }
    }
    // as people write them: `E-Mail`, `LMS ID`
    for (i, name) in header.iter().enumerate() {
        let mut known = COLUMNS.iter();
        if let Some(known) = known.find(|known| plain_name(name) == plain_name(known)) {
            at.entry(*known).or_insert(i);
        }
    }
    if at.contains_key("id") {
        return match misspelt(header, &at) {
            None => Ok(at),
            Some((name, known)) => Err((
                format!("the column `{name}` would not be read"),
                format!("did you mean `{known}`? A column for people alone needs another name"),
            )),
        };
    }
    let found: Vec<&str> = header.iter().collect();
    Err((
        format!("there is no column `id`; found: {}", found.join(", ")),
        format!("the first line names the columns: {}", COLUMNS.join(",")),
    ))
}

/// What stands between fields: whichever the header has most of.
pub(crate) fn delimiter(text: &str) -> u8 {
    let header = text.lines().next().unwrap_or_default();
    let count = |sign: u8| header.bytes().filter(|byte| *byte == sign).count();
    [b',', b';', b'\t']
        .into_iter()
        .rev()
        .max_by_key(|sign| count(*sign))
        .unwrap_or(b',')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_roster_of_a_spreadsheet_is_read() {
        let text = "\u{feff}ID;Name;E-Mail;section;points\r\ns1;\"Müller; Jörg\";x;A;1;\r\n\r\ns2;Öz;;B\r\n";
        let roster = Roster::parse("roster.csv", text.as_bytes()).unwrap();
        let people = roster.people();
        assert_eq!(people.len(), 2);
        assert_eq!(people[0].name, "Müller; Jörg");
        assert_eq!(people[0].email, "x");
        assert_eq!(
            (people[1].section.as_str(), people[1].email.as_str()),
            ("B", "")
        );
        assert_eq!(roster.get(&StudentId::new("s2").unwrap()), Some(&people[1]));
    }

    #[test]
    fn columns_for_people_are_theirs() {
        for header in [
            "id,name,surname",
            "id,name,session",
            "id,fname,lname",
            "id,email,e-mail",
            "id,group,grade,note",
        ] {
            let fields = header.replace("id", "s1");
            let roster = Roster::parse("roster.csv", format!("{header}\n{fields}\n").as_bytes());
            assert!(roster.is_ok(), "{header}: {roster:?}");
        }
    }

    #[test]
    fn what_two_people_share_is_refused_with_both_lines() {
        for (text, part) in [
            (
                "id,name\ns1,A\nS1,B\n",
                "id `S1` differs from `s1` in line 2 only by case",
            ),
            ("id,name\nRen\u{e9}e,A\nRene\u{301}e,B\n", "line 2"),
            ("id,lms_id\ns1,7\ns2,7\n", "line 2 has the lms_id `7`, too"),
            ("name\nA\n", "there is no column `id`; found: name"),
            ("id,id\ns1,s2\n", "`id` is there twice"),
            (
                "id,sectoin\ns1,A\n",
                "the column `sectoin` would not be read",
            ),
            (
                "id,name,section\ns1,Lee, Ann,B\n",
                "4 fields, where the header has 3",
            ),
            (
                "id,name,section\ns1;Ann;B\n",
                "has the sign between fields in it",
            ),
            ("id\n1.00104E+06\n", "that a spreadsheet has shortened"),
            ("id,name\n", "nobody is in it"),
            ("id,name\n,A\n", "the student id is empty"),
        ] {
            let error = Roster::parse("roster.csv", text.as_bytes()).unwrap_err();
            assert!(error.to_string().contains(part), "{error}");
        }
    }

    #[test]
    fn an_open_quote_does_not_swallow_the_others() {
        let text = "id,name\ns1,Ana\ns2,\"Zoe\ns3,Kim\n";
        let error = Roster::parse("roster.csv", text.as_bytes()).unwrap_err();
        assert_eq!(error.line, 3);
        assert!(error.help.contains("close the quote"));
    }
}
