//! Whose row it is in a file of the LMS: by what identifies a person there, and by the name only where nothing speaks against it. Where
//! that leaves a doubt it is nobody's.

use std::collections::BTreeMap;

use super::Row;
use super::formula::unguarded;
use crate::student::folded;

/// What a row of a file says of a person; empty where it says nothing.
#[derive(Debug, Clone, Default)]
pub(super) struct Keys {
    /// The LMS's own number of the person, as in `lms_id` of the roster.
    pub(super) lms_id: String,
    /// The id of the roster.
    pub(super) id: String,
    /// The e-mail address.
    pub(super) email: String,
    /// The login.
    pub(super) login: String,
    /// The full name, in the order in which it is spoken or as `Last, First`.
    pub(super) name: String,
}

impl Keys {
    /// What a person would call the row.
    pub(super) fn who(&self) -> &str {
        let all = [&self.name, &self.email, &self.login, &self.id, &self.lms_id];
        all.into_iter()
            .find(|key| !key.is_empty())
            .map_or("no name", String::as_str)
    }
}

/// Who has a value; `None` where several people have it.
type Index = BTreeMap<String, Option<usize>>;

/// The people of the roster by what identifies them.
pub(super) struct Directory<'a> {
    rows: &'a [Row<'a>],
    lms_ids: Index,
    ids: Index,
    emails: Index,
    usernames: Index,
    names: Index,
}

impl<'a> Directory<'a> {
    pub(super) fn new(rows: &'a [Row<'a>]) -> Self {
        let index = |value: fn(&Row<'_>) -> String| {
            let mut index = Index::new();
            for (at, row) in rows.iter().enumerate() {
                let value = value(row);
                if !value.is_empty() {
                    let known = index.entry(value).or_insert(Some(at));
                    if *known != Some(at) {
                        *known = None;
                    }
                }
            }
            index
        };
        Self {
            rows,
            lms_ids: index(|row| folded(&row.person.lms_id)),
            ids: index(|row| row.person.id.folded()),
            emails: index(|row| folded(&row.person.email)),
            usernames: index(|row| folded(&row.person.username)),
            names: index(|row| spoken(&row.person.name)),
        }
    }

    /// The person that `keys` say. `names` counts the names in the file ([`names_of`]).
    ///
    /// # Errors
    /// Why it is nobody for certain, in words.
    pub(super) fn find(
        &self,
        keys: &Keys,
        names: &BTreeMap<String, usize>,
    ) -> Result<usize, String> {
        let found = [
            hit(&self.lms_ids, &keys.lms_id),
            hit(&self.ids, &keys.id),
            hit(&self.emails, &keys.email),
            self.login(&keys.login),
        ];
        let mut found: Vec<usize> = found.into_iter().flatten().collect();
        found.sort_unstable();
        found.dedup();
        match found[..] {
            [one] => Ok(one),
            [first, second, ..] => Err(format!(
                "it has something of {} and something of {}",
                self.rows[first].person.id, self.rows[second].person.id
            )),
            [] => self.by_name(keys, names),
        }
    }

    /// The person that a single value says, whatever it is.
    ///
    /// # Errors
    /// Why it is nobody for certain, in words.
    pub(super) fn find_any(&self, value: &str) -> Result<usize, String> {
        let keys = Keys {
            lms_id: value.to_owned(),
            id: value.to_owned(),
            email: value.to_owned(),
            login: value.to_owned(),
            name: String::new(),
        };
        // the course's own id is what the column is for
        match hit(&self.ids, value) {
            Some(one) => Ok(one),
            None => self.find(&keys, &BTreeMap::new()),
        }
    }

    /// A login is the username; where the roster has none, LMSs use the address or the id.
    fn login(&self, login: &str) -> Option<usize> {
        let without_username = |at: &usize| self.rows[*at].person.username.is_empty();
        hit(&self.usernames, login)
            .or_else(|| hit(&self.emails, login))
            .or_else(|| hit(&self.ids, login).filter(without_username))
    }

    fn by_name(&self, keys: &Keys, names: &BTreeMap<String, usize>) -> Result<usize, String> {
        let name = spoken(&keys.name);
        let nobody = || "nobody in roster.csv has its id, address or name".to_owned();
        if name.is_empty() {
            return Err(nobody());
        }
        if names.get(&name).is_some_and(|count| *count > 1) {
            return Err(
                "several rows have this name, and nothing else says who they are".to_owned(),
            );
        }
        let at = match self.names.get(&name) {
            None => return Err(nobody()),
            Some(None) => return Err("several people in roster.csv have this name".to_owned()),
            Some(Some(at)) => *at,
        };
        let person = self.rows[at].person;
        for (what, there, here) in [
            ("the LMS's id", &keys.lms_id, &person.lms_id),
            ("the id", &keys.id, &person.id.as_str().to_owned()),
            ("the e-mail address", &keys.email, &person.email),
            ("the login", &keys.login, &person.username),
        ] {
            if !there.is_empty() && !here.is_empty() && folded(there) != folded(here) {
                return Err(format!(
                    "the name is that of {}, but {what} is not: `{there}` there, `{here}` in roster.csv",
                    person.id
                ));
            }
        }
        Ok(at)
    }
}

/// How often each name is in a file.
pub(super) fn names_of<'k>(keys: impl Iterator<Item = &'k Keys>) -> BTreeMap<String, usize> {
    let mut names = BTreeMap::new();
    for keys in keys {
        *names.entry(spoken(&keys.name)).or_insert(0) += 1;
    }
    names
}

fn hit(index: &Index, value: &str) -> Option<usize> {
    *index.get(&folded(unguarded(value)))?
}

/// A name as it is compared: in the order in which it is spoken, with single spaces.
fn spoken(name: &str) -> String {
    let name = unguarded(name.trim());
    let parts: Vec<&str> = name.split(',').collect();
    let name = match parts[..] {
        [last, first] => format!("{first} {last}"),
        _ => name.to_owned(),
    };
    let folded = folded(&name);
    let words: Vec<&str> = folded.split_whitespace().collect();
    words.join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::release::sample::Class;

    fn keys(id: &str, email: &str, login: &str, name: &str) -> Keys {
        Keys {
            lms_id: String::new(),
            id: id.to_owned(),
            email: email.to_owned(),
            login: login.to_owned(),
            name: name.to_owned(),
        }
    }

    fn class() -> Class {
        Class::of_roster(
            "id,name,email,username,lms_id\n\
             s1,Ada Lovelace,ada@x.org,ada,11\n\
             s2,Li Wei,li1@x.org,,12\n\
             s3,Li Wei,li2@x.org,,\n\
             s4,Zoë Ångström,,,\n\
             s5,\"=SUM(A1) Formula\",shared@x.org,,\n\
             s6,Bo,shared@x.org,,\n",
        )
    }

    #[test]
    fn people_are_found_by_what_identifies_them() {
        let class = class();
        let rows = class.rows();
        let directory = Directory::new(&rows);
        let find = |keys: &Keys| {
            let found = directory.find(keys, &names_of([keys].into_iter()));
            found.map(|at| rows[at].person.id.to_string())
        };
        for (keys, who) in [
            (keys("S1", "", "", ""), "s1"),
            (keys("", "ADA@x.org", "", "Somebody Else"), "s1"),
            (keys("", "", "ada", ""), "s1"),
            // an address or an id as login
            (keys("", "", "li1@x.org", ""), "s2"),
            (keys("", "", "s3", ""), "s3"),
            (keys("", "", "", "Ångström, Zoë"), "s4"),
            (keys("", "", "", "zoe\u{308}  A\u{30a}ngstro\u{308}m"), "s4"),
            (keys("", "", "", "=\"=SUM(A1) Formula\""), "s5"),
            (keys("", "", "", "'=SUM(A1) Formula"), "s5"),
            // an address that nobody has says nothing where the roster has none
            (keys("", "private@y.org", "", "Zoë Ångström"), "s4"),
            (keys("", "shared@x.org", "", "Bo"), "s6"),
        ] {
            assert_eq!(find(&keys).as_deref(), Ok(who), "{keys:?}");
        }
        for (keys, why) in [
            (
                keys("s2", "li2@x.org", "", ""),
                "something of s2 and something of s3",
            ),
            (keys("", "", "", "Li Wei"), "several people in roster.csv"),
            (keys("", "", "", "Nobody"), "nobody in roster.csv"),
            (keys("", "", "", ""), "nobody in roster.csv"),
            (keys("", "shared@x.org", "", ""), "nobody in roster.csv"),
            // an address of two people says nothing against a name
            (keys("", "shared@x.org", "", "Bo B"), "nobody in roster.csv"),
            (
                keys("", "other@x.org", "", "Ada Lovelace"),
                "the name is that of s1, but the e-mail address is not",
            ),
        ] {
            let found = find(&keys).unwrap_err();
            assert!(found.contains(why), "{keys:?}: {found}");
        }
    }

    #[test]
    fn a_name_that_the_file_has_twice_is_nobodys() {
        let class = class();
        let rows = class.rows();
        let directory = Directory::new(&rows);
        let all = [keys("", "", "", "Bo"), keys("", "", "", "BO")];
        let found = directory.find(&all[0], &names_of(all.iter()));
        assert!(found.unwrap_err().contains("several rows"));
    }

    #[test]
    fn one_value_can_be_an_id_an_address_or_a_number() {
        let class = class();
        let rows = class.rows();
        let directory = Directory::new(&rows);
        for (value, at) in [("s2", 1), ("ada@x.org", 0), ("ada", 0), ("12", 1)] {
            assert_eq!(directory.find_any(value), Ok(at), "{value}");
        }
        assert!(directory.find_any("").is_err());
    }
}
