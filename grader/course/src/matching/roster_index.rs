//! The roster by everything that a source may say of a person.

use std::collections::{BTreeMap, BTreeSet};

use super::full_name::{comparable, slug, slugs};
use crate::roster::{Person, Roster};
use crate::student::folded;

/// Numbers of people on the roster, by what they are looked up by.
type Column = BTreeMap<String, BTreeSet<usize>>;

/// A roster, ready to be asked.
#[derive(Debug)]
pub(super) struct RosterIndex<'r> {
    roster: &'r Roster,
    ids: Column,
    lms_ids: Column,
    usernames: Column,
    emails: Column,
    names: Column,
    slugs: Column,
    repositories: Column,
    groups: Column,
    /// Groups by the slugs of their names.
    group_slugs: BTreeMap<String, Vec<String>>,
    /// Values that a typo may have come from, by column.
    columns: Vec<Vec<(String, usize)>>,
}

impl<'r> RosterIndex<'r> {
    pub(super) fn new(roster: &'r Roster) -> Self {
        let people = roster.people();
        let by = |value: fn(&Person) -> &str, key: fn(&str) -> String| {
            let mut column = Column::new();
            for (i, person) in people.iter().enumerate() {
                let key = key(value(person));
                if !key.is_empty() {
                    column.entry(key).or_default().insert(i);
                }
            }
            column
        };
        let mut by_slug = Column::new();
        for (i, person) in people.iter().enumerate() {
            for slug in slugs(&person.name) {
                by_slug.entry(slug).or_default().insert(i);
            }
        }
        let groups = by(|person| &person.group, comparable);
        let mut group_slugs: BTreeMap<String, Vec<String>> = BTreeMap::new();
        for group in groups.keys() {
            let slug = slug(group);
            if !slug.is_empty() {
                group_slugs.entry(slug).or_default().push(group.clone());
            }
        }
        let ids = by(|person| person.id.as_str(), folded);
        let usernames = by(|person| &person.username, folded);
        let emails = by(|person| &person.email, folded);
        let names = by(|person| &person.name, comparable);
        let values = |column: &Column| -> Vec<(String, usize)> {
            let pairs = column
                .iter()
                .flat_map(|(value, people)| people.iter().map(|&i| (value.clone(), i)));
            pairs.collect()
        };
        Self {
            columns: [&ids, &names, &usernames, &emails].map(values).to_vec(),
            lms_ids: by(|person| &person.lms_id, folded),
            repositories: by(|person| &person.repository, folded),
            groups,
            group_slugs,
            slugs: by_slug,
            ids,
            usernames,
            emails,
            names,
            roster,
        }
    }

    /// Everybody.
    pub(super) fn people(&self) -> &'r [Person] {
        self.roster.people()
    }

    /// Values that a typo may have come from, each with whose it is: a column of them for ids, names, logins and addresses.
    pub(super) fn columns(&self) -> &[Vec<(String, usize)>] {
        &self.columns
    }

    pub(super) fn id(&self, id: &str) -> BTreeSet<usize> {
        at(&self.ids, &folded(id))
    }

    pub(super) fn lms_id(&self, id: &str) -> BTreeSet<usize> {
        at(&self.lms_ids, &folded(id))
    }

    pub(super) fn username(&self, name: &str) -> BTreeSet<usize> {
        at(&self.usernames, &folded(name))
    }

    pub(super) fn email(&self, email: &str) -> BTreeSet<usize> {
        at(&self.emails, &folded(email))
    }

    pub(super) fn name(&self, name: &str) -> BTreeSet<usize> {
        at(&self.names, &comparable(name))
    }

    pub(super) fn slug(&self, text: &str) -> BTreeSet<usize> {
        at(&self.slugs, &slug(text))
    }

    /// The members of a group, by its name or by the slug of its name.
    pub(super) fn group(&self, name: &str) -> BTreeSet<usize> {
        let members = at(&self.groups, &comparable(name));
        if !members.is_empty() {
            return members;
        }
        // two groups that differ in spaces alone are none
        match self.group_slugs.get(&slug(name)).map(Vec::as_slice) {
            Some([group]) => at(&self.groups, group),
            _ => BTreeSet::new(),
        }
    }

    /// Whose repository it is: by its whole name, else by the login or the id that it ends in.
    pub(super) fn repository(&self, name: &str) -> BTreeSet<usize> {
        let name = folded(name);
        let whole = at(&self.repositories, &name);
        if !whole.is_empty() {
            return whole;
        }
        let mut people = BTreeSet::new();
        let cuts = name.match_indices('-').map(|(at, _)| at + 1);
        for from in std::iter::once(0).chain(cuts) {
            if from > 0 && is_short(&name[from..]) {
                continue;
            }
            let mut of_ending = at(&self.usernames, &name[from..]);
            of_ending.append(&mut at(&self.ids, &name[from..]));
            // a person whose repository has another name is not meant
            of_ending.retain(|&i| self.people()[i].repository.is_empty());
            people.append(&mut of_ending);
        }
        people
    }

    /// Whose ids stand in a name: the whole name, else every id in it that is no part of a longer word.
    pub(super) fn ids_in(&self, name: &str) -> BTreeSet<usize> {
        let name = folded(name);
        let whole = at(&self.ids, &name);
        if !whole.is_empty() {
            return whole;
        }
        let mut people = BTreeSet::new();
        for (from, to) in spans(&name) {
            if !is_short(&name[from..to]) {
                people.append(&mut at(&self.ids, &name[from..to]));
            }
        }
        people
    }
}

fn at(column: &Column, key: &str) -> BTreeSet<usize> {
    column.get(key).cloned().unwrap_or_default()
}

/// Whether an id may stand in a name by chance: `1` in `lab 1`.
fn is_short(id: &str) -> bool {
    let count = id.chars().count();
    count < 2 || (count < 3 && id.chars().all(char::is_numeric))
}

/// Words of a name beyond which none is looked for in it.
const MOST_WORDS: usize = 24;

/// All parts of a name that begin and end with a word.
fn spans(name: &str) -> Vec<(usize, usize)> {
    let mut words: Vec<(usize, usize)> = Vec::new();
    let mut inside = false;
    for (i, c) in name.char_indices() {
        let end = i + c.len_utf8();
        match (c.is_alphanumeric(), words.last_mut()) {
            (true, Some(word)) if inside => word.1 = end,
            (true, _) => words.push((i, end)),
            (false, _) => {}
        }
        inside = c.is_alphanumeric();
    }
    words.truncate(MOST_WORDS);
    let mut spans = Vec::new();
    for (i, (from, _)) in words.iter().enumerate() {
        spans.extend(words[i..].iter().map(|(_, to)| (*from, *to)));
    }
    spans
}
