//! The hints of a source, led to people of the roster and weighed against each other.

use std::collections::{BTreeMap, BTreeSet};

use kinemark_sim::text::nearest;

use super::full_name::comparable;
use super::roster_index::RosterIndex;
use crate::layout::{Hint, PersonFiles};
use crate::roster::Roster;
use crate::student::{StudentId, folded};

/// Whose files they are.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Matched {
    /// The student, or all members of a group.
    pub students: Vec<StudentId>,
    /// By what: `id`, `lms_id`, `username`, `email`, `repository`, `name`, `group`.
    pub by: &'static str,
}

/// Why nobody but a person can say whose they are.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Unmatched {
    /// Why, in words.
    pub why: String,
    /// What to do.
    pub help: String,
    /// Students that come near, for a person to choose from.
    pub nearest: Vec<StudentId>,
}

/// So many students that come near are named.
const MOST_NEAREST: usize = 5;

/// Near students are searched for so many times in a source: with the wrong roster nobody is on it, and the search is slow.
const MOST_SUGGESTED: usize = 200;

/// Finds students on a roster.
#[derive(Debug)]
pub struct Matcher<'r> {
    index: RosterIndex<'r>,
}

/// Whom one hint leads to.
struct Lead<'h> {
    by: &'static str,
    hint: &'h Hint,
    /// Numbers on the roster; several for a group, and where people share what the hint says.
    people: BTreeSet<usize>,
}

impl<'r> Matcher<'r> {
    /// Prepares a roster.
    pub fn new(roster: &'r Roster) -> Self {
        Self {
            index: RosterIndex::new(roster),
        }
    }

    /// The students of everybody in a source, in the same order. A name that two of them have, under two numbers of the LMS, is no
    /// hint: one may have left the course.
    pub fn students_of_all(&self, people: &[PersonFiles]) -> Vec<Result<Matched, Unmatched>> {
        let mut numbers: BTreeMap<String, BTreeSet<&str>> = BTreeMap::new();
        for person in people {
            for name in names(&person.hints) {
                let number = person.lms_number.as_deref();
                numbers.entry(name).or_default().extend(number);
            }
        }
        let mut unmatched = 0;
        let mut students = Vec::with_capacity(people.len());
        for person in people {
            let shared = names(&person.hints)
                .into_iter()
                .find(|name| numbers.get(name).is_some_and(|numbers| numbers.len() > 1));
            let suggests = unmatched < MOST_SUGGESTED;
            let student = match shared {
                None => self.weighed(&person.hints, suggests),
                Some(name) => self.student_of_namesake(&person.hints, &name, suggests),
            };
            unmatched += usize::from(student.is_err());
            students.push(student);
        }
        students
    }

    /// The student whom `hints` lead to.
    ///
    /// # Errors
    /// Hints that lead to nobody, to several, or to different people.
    pub fn student_of(&self, hints: &[Hint]) -> Result<Matched, Unmatched> {
        self.weighed(hints, true)
    }

    fn weighed(&self, hints: &[Hint], suggests: bool) -> Result<Matched, Unmatched> {
        let leads: Vec<Lead<'_>> = hints.iter().filter_map(|hint| self.lead(hint)).collect();
        if let Some(contradiction) = self.contradiction(hints, &leads, suggests) {
            return Err(contradiction);
        }
        let (groups, others): (Vec<&Lead<'_>>, Vec<&Lead<'_>>) =
            leads.iter().partition(|lead| lead.by == "group");
        let single = others.iter().filter(|lead| lead.people.len() == 1);
        let people: BTreeSet<usize> = single
            .flat_map(|lead| lead.people.iter().copied())
            .collect();
        let one_group = groups.windows(2).all(|two| two[0].people == two[1].people);
        match (people.first(), groups.first()) {
            _ if people.len() > 1 || !one_group => Err(self.different_people(&leads)),
            (Some(&person), None) => self.one(person, &leads),
            (Some(&person), Some(group)) => self.one_or_group(person, group, &leads),
            (None, Some(group)) if others.is_empty() => Ok(self.matched(&group.people, "group")),
            (None, Some(_)) => Err(self.different_people(&leads)),
            (None, None) if leads.is_empty() => Err(self.nobody(hints, suggests)),
            (None, None) => Err(self.several(&leads, hints)),
        }
    }

    /// The student of files whose name another person in the source has as well: something else has to say who it is.
    fn student_of_namesake(
        &self,
        hints: &[Hint],
        name: &str,
        suggests: bool,
    ) -> Result<Matched, Unmatched> {
        let is_name = |hint: &Hint| comparable(hint.text()) == name;
        let (names, others): (Vec<Hint>, Vec<Hint>) = hints.iter().cloned().partition(is_name);
        self.weighed(&others, suggests).map_err(|unmatched| {
            let near = names.iter().filter_map(|hint| self.lead(hint));
            let near: BTreeSet<usize> = near.flat_map(|lead| lead.people).collect();
            let mut nearest = self.ids(near);
            nearest.extend(unmatched.nearest);
            Unmatched {
                why: format!(
                    "two people in the source have the name {}",
                    names.first().map_or_else(String::new, shown)
                ),
                help: which_of_them(hints),
                nearest: unique(nearest),
            }
        })
    }

    /// Whom a hint leads to, if anybody.
    fn lead<'h>(&self, hint: &'h Hint) -> Option<Lead<'h>> {
        let index = &self.index;
        let (by, people) = match hint {
            Hint::Id(id) => first_of([
                ("id", index.id(id)),
                ("username", index.username(id)),
                ("lms_id", index.lms_id(id)),
            ])?,
            Hint::LmsId(id) => first_of([("lms_id", index.lms_id(id)), ("id", index.id(id))])?,
            Hint::Username(name) => {
                first_of([("username", index.username(name)), ("id", index.id(name))])?
            }
            Hint::Email(email) => ("email", index.email(email)),
            Hint::Name(name) => ("name", index.name(name)),
            Hint::Slug(slug) => ("name", index.slug(slug)),
            Hint::Repository(name) => ("repository", index.repository(name)),
            Hint::Group(name) => ("group", index.group(name)),
            Hint::PathName(name) => ("id", index.ids_in(name)),
        };
        let is_vague = matches!(hint, Hint::PathName(_)) && people.len() > 1;
        (!people.is_empty() && !is_vague).then_some(Lead { by, hint, people })
    }

    /// What the roster denies: an id that is not on it, an LMS's id that is another than the one it has of this person.
    fn contradiction(
        &self,
        hints: &[Hint],
        leads: &[Lead<'_>],
        suggests: bool,
    ) -> Option<Unmatched> {
        let led = |hint: &Hint| leads.iter().any(|lead| lead.hint == hint);
        let near = || self.ids(leads.iter().flat_map(|lead| lead.people.iter().copied()));
        for hint in hints {
            let known = match hint {
                Hint::Id(_) if !led(hint) => None,
                Hint::LmsId(_) if !led(hint) => {
                    let of_others = leads.iter().filter(|lead| lead.people.len() == 1);
                    let people = of_others.flat_map(|lead| lead.people.iter());
                    let mut ids = people.map(|&i| &self.index.people()[i].lms_id);
                    match ids.find(|id| !id.is_empty()) {
                        Some(known) => Some(known.clone()),
                        None => continue,
                    }
                }
                _ => continue,
            };
            let mut nearest = near();
            if suggests {
                nearest.extend(self.nearest(std::slice::from_ref(hint)));
            }
            return Some(Unmatched {
                why: match known {
                    None => format!("no id on the roster is {}", shown(hint)),
                    Some(known) => format!(
                        "the LMS has {} for them, roster.csv has lms_id `{known}`",
                        shown(hint)
                    ),
                },
                help: "correct roster.csv, or name the student in fixes.toml".to_owned(),
                nearest: unique(nearest),
            });
        }
        None
    }

    /// One person, unless something that several people share denies it.
    fn one(&self, person: usize, leads: &[Lead<'_>]) -> Result<Matched, Unmatched> {
        if leads.iter().any(|lead| !lead.people.contains(&person)) {
            return Err(self.different_people(leads));
        }
        let single = leads.iter().filter(|lead| lead.people.len() == 1);
        let by = single.map(|lead| lead.by).min_by_key(|by| rank(by));
        Ok(self.matched(&BTreeSet::from([person]), by.unwrap_or("name")))
    }

    /// A person and a group: the group's hand-in where the person is known by an id and in the group, and its name is nobody's.
    fn one_or_group(
        &self,
        person: usize,
        group: &Lead<'_>,
        leads: &[Lead<'_>],
    ) -> Result<Matched, Unmatched> {
        let text = folded(group.hint.text());
        let denies = |lead: &Lead<'_>| {
            let same_text = lead.by != "group" && folded(lead.hint.text()) == text;
            same_text || !lead.people.contains(&person)
        };
        if leads.iter().any(denies) {
            return Err(self.different_people(leads));
        }
        Ok(self.matched(&group.people, "group"))
    }

    fn matched(&self, people: &BTreeSet<usize>, by: &'static str) -> Matched {
        Matched {
            students: self.ids(people.iter().copied()),
            by,
        }
    }

    fn different_people(&self, leads: &[Lead<'_>]) -> Unmatched {
        let mut said: Vec<String> = Vec::new();
        for lead in leads {
            let ids = self.ids(lead.people.iter().copied());
            let ids: Vec<&str> = ids.iter().take(3).map(StudentId::as_str).collect();
            let more = if lead.people.len() > 3 { ", ..." } else { "" };
            let line = format!(
                "the {} {} to {}{more}",
                lead.by,
                shown(lead.hint),
                ids.join(", ")
            );
            if !said.contains(&line) {
                said.push(line);
            }
        }
        Unmatched {
            why: format!("it leads to different people: {}", said.join("; ")),
            help: "name the student in fixes.toml".to_owned(),
            nearest: unique(self.ids(leads.iter().flat_map(|lead| lead.people.iter().copied()))),
        }
    }

    /// People who share what the source says.
    fn several(&self, leads: &[Lead<'_>], hints: &[Hint]) -> Unmatched {
        let lead = &leads[0];
        Unmatched {
            why: format!(
                "{} people on the roster have the {} {}",
                lead.people.len(),
                lead.by,
                shown(lead.hint)
            ),
            help: which_of_them(hints),
            nearest: unique(self.ids(lead.people.iter().copied())),
        }
    }

    fn nobody(&self, hints: &[Hint], suggests: bool) -> Unmatched {
        let mut texts: Vec<String> = Vec::new();
        for hint in hints {
            let text = shown(hint);
            if !texts.contains(&text) {
                texts.push(text);
            }
        }
        Unmatched {
            why: match texts.as_slice() {
                [] => "nothing in the source says whose it is".to_owned(),
                texts => format!(
                    "nobody on the roster is {}: no id, name, login, address, repository or group",
                    texts.join(" or ")
                ),
            },
            help: "correct roster.csv, or name the student in fixes.toml".to_owned(),
            nearest: match suggests {
                true => self.nearest(hints),
                false => Vec::new(),
            },
        }
    }

    /// Students whose id, name, login or address is nearly what a hint says.
    fn nearest(&self, hints: &[Hint]) -> Vec<StudentId> {
        let texts: BTreeSet<String> = hints.iter().map(|hint| comparable(hint.text())).collect();
        let mut found = Vec::new();
        for text in &texts {
            for column in self.index.columns() {
                let values = column.iter().map(|(value, _)| value.as_str());
                if let Some(near) = nearest(text, values) {
                    let same = column.iter().filter(|(value, _)| value == near);
                    found.extend(same.map(|(_, person)| *person));
                }
            }
        }
        unique(self.ids(found))
    }

    fn ids(&self, people: impl IntoIterator<Item = usize>) -> Vec<StudentId> {
        let ids = people
            .into_iter()
            .map(|i| self.index.people()[i].id.clone());
        let mut seen = BTreeSet::new();
        ids.filter(|id| seen.insert(id.clone())).collect()
    }
}

/// The first way to read a hint that leads to anybody.
fn first_of<const N: usize>(
    ways: [(&'static str, BTreeSet<usize>); N],
) -> Option<(&'static str, BTreeSet<usize>)> {
    ways.into_iter().find(|(_, people)| !people.is_empty())
}

/// Which of two ways says more about a person.
fn rank(by: &str) -> usize {
    let ways = [
        "id",
        "lms_id",
        "username",
        "email",
        "repository",
        "name",
        "group",
    ];
    ways.iter().position(|way| *way == by).unwrap_or(ways.len())
}

/// The names among hints, as they are compared.
fn names(hints: &[Hint]) -> Vec<String> {
    let name = |hint: &Hint| match hint {
        Hint::Name(name) | Hint::Slug(name) => Some(comparable(name)),
        _ => None,
    };
    hints.iter().filter_map(name).collect()
}

/// What a hint says, in a message.
fn shown(hint: &Hint) -> String {
    format!("`{}`", kinemark_report::visible::visible(hint.text()))
}

fn unique(ids: Vec<StudentId>) -> Vec<StudentId> {
    let mut seen = BTreeSet::new();
    let new = ids.into_iter().filter(|id| seen.insert(id.clone()));
    new.take(MOST_NEAREST).collect()
}

/// What to do where a name is that of several people.
fn which_of_them(hints: &[Hint]) -> String {
    let has_lms_id = hints.iter().any(|hint| matches!(hint, Hint::LmsId(_)));
    match has_lms_id {
        true => "add the id of the LMS to roster.csv (lms_id), or name the student in fixes.toml",
        false => "name the student in fixes.toml",
    }
    .to_owned()
}
