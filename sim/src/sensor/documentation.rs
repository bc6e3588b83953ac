//! The list of kinds in docs/robot-format.md, made from the first comment of each kind's file and the keys of its table.

use std::fmt::Write as _;
use std::path::Path;

use serde::de::value::Error;
use serde::de::{Deserializer, Error as _, Visitor};
use serde::{Deserialize, forward_to_deserialize_any};

use super::kind::KINDS;
use super::registry::Kind;

const BEGIN: &str = "<!-- sensors: generated -->\n";
const END: &str = "<!-- /sensors -->";

/// Keeps the names of the fields of the structure that is read from it, and gives nothing.
struct Keys<'k>(&'k mut &'static [&'static str]);

impl<'de> Deserializer<'de> for Keys<'_> {
    type Error = Error;

    fn deserialize_any<V: Visitor<'de>>(self, _: V) -> Result<V::Value, Error> {
        Err(Error::custom("a table of keys"))
    }

    fn deserialize_struct<V: Visitor<'de>>(
        self,
        _: &'static str,
        fields: &'static [&'static str],
        _: V,
    ) -> Result<V::Value, Error> {
        *self.0 = fields;
        Err(Error::custom("its keys are known now"))
    }

    forward_to_deserialize_any! {
        bool i8 i16 i32 i64 i128 u8 u16 u32 u64 u128 f32 f64 char str string bytes byte_buf option unit unit_struct newtype_struct
        seq tuple tuple_struct map enum identifier ignored_any
    }
}

/// The keys of a table, in the order of its declaration.
pub(super) fn keys<'de, T: Deserialize<'de>>() -> &'static [&'static str] {
    let mut keys: &'static [&'static str] = &[];
    assert!(
        T::deserialize(Keys(&mut keys)).is_err(),
        "nothing was given"
    );
    keys
}

fn in_repository(path: &str) -> std::path::PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(path)
}

/// The first paragraph of the first comment of its file, without its name and the full stop.
fn what_it_reads(kind: &Kind) -> String {
    let module = kind.name.replace('-', "_");
    let path = in_repository(&format!("sim/src/sensor/kind/{module}.rs"));
    let source = std::fs::read_to_string(path).expect("a file of this kind");
    let lines = source.lines().map_while(|line| line.strip_prefix("//! "));
    let text = lines.collect::<Vec<&str>>().join(" ");
    let text = text.strip_prefix(&format!("{}: ", kind.name));
    let text = text.unwrap_or_else(|| panic!("{module}.rs begins with its kind's name"));
    text.trim_end_matches('.').to_owned()
}

fn list() -> String {
    let mut text = "| `type` | what it reads | keys of its own |\n|---|---|---|\n".to_owned();
    for kind in KINDS {
        let keys = (kind.own_keys)().iter().map(|key| format!("`{key}`"));
        let keys = keys.collect::<Vec<String>>().join(", ");
        assert!(!keys.is_empty(), "{}: keys", kind.name);
        let _ = writeln!(
            text,
            "| `{}` | {} | {keys} |",
            kind.name,
            what_it_reads(kind)
        );
    }
    text
}

/// The list is that of the code; `KINEMARK_BLESS=1` writes it anew.
#[test]
fn the_list_of_sensors_is_current() {
    let path = in_repository("docs/robot-format.md");
    let page = std::fs::read_to_string(&path).expect("docs/robot-format.md");
    let (before, rest) = page.split_once(BEGIN).expect("where the list begins");
    let (_, after) = rest.split_once(END).expect("where it ends");
    let current = format!("{before}{BEGIN}{}{END}{after}", list());
    if std::env::var_os("KINEMARK_BLESS").is_some() {
        std::fs::write(&path, &current).expect("docs/robot-format.md is written");
    }
    assert!(
        page == current,
        "docs/robot-format.md: run KINEMARK_BLESS=1 cargo test"
    );
}
