//! Numbers with a unit: in words of a text, such as `2 mm` or `30 N m`, and at keys of lab.toml, such as `full_m`.

use std::f64::consts::PI;

use toml::Value;

/// A number of a text with its unit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Stated<'t> {
    /// Which of the words is the number.
    pub at: usize,
    /// How many words number and unit are.
    pub words: usize,
    /// The number, in `unit`.
    pub value: f64,
    /// The unit of the house: m, s, rad, kg, N m, N, N s, m/s, rad/s.
    pub unit: &'static str,
    /// The number as it stands there.
    pub number: &'t str,
}

/// Words of a unit, what one of it is, and in which unit.
type Unit = (&'static [&'static str], f64, &'static str);

/// The longer ones first; an empty unit is one that nothing here is measured in.
const UNITS: [Unit; 33] = [
    (&["N", "m", "s/rad"], 1.0, ""),
    (&["N", "m", "per"], 1.0, ""),
    (&["N", "m/rad"], 1.0, ""),
    (&["N", "s/m"], 1.0, ""),
    (&["N", "m²"], 1.0, ""),
    (&["kg", "m²"], 1.0, ""),
    (&["N", "m"], 1.0, "N m"),
    (&["N", "s"], 1.0, "N s"),
    (&["N"], 1.0, "N"),
    (&["mm"], 1e-3, "m"),
    (&["millimetres"], 1e-3, "m"),
    (&["cm"], 1e-2, "m"),
    (&["centimetres"], 1e-2, "m"),
    (&["m"], 1.0, "m"),
    (&["metre"], 1.0, "m"),
    (&["metres"], 1.0, "m"),
    (&["ms"], 1e-3, "s"),
    (&["millisecond"], 1e-3, "s"),
    (&["milliseconds"], 1e-3, "s"),
    (&["s"], 1.0, "s"),
    (&["second"], 1.0, "s"),
    (&["seconds"], 1.0, "s"),
    (&["rad"], 1.0, "rad"),
    (&["degree"], PI / 180.0, "rad"),
    (&["degrees"], PI / 180.0, "rad"),
    (&["deg"], PI / 180.0, "rad"),
    (&["kg"], 1.0, "kg"),
    (&["g"], 1e-3, "kg"),
    (&["m/s"], 1.0, "m/s"),
    (&["mm/s"], 1e-3, "m/s"),
    (&["cm/s"], 1e-2, "m/s"),
    (&["rad/s"], 1.0, "rad/s"),
    (&["degrees/s"], PI / 180.0, "rad/s"),
];

/// The numbers with a unit among the words of a text, in their order.
pub(super) fn stated<'t>(words: &[&'t str]) -> Vec<Stated<'t>> {
    let number_at = |(at, word): (usize, &&'t str)| {
        let number = bare(word);
        let value: f64 = number.parse().ok()?;
        let (unit, scale, name) = UNITS.iter().find(|(unit, ..)| {
            let mut pairs = unit.iter().enumerate();
            pairs.all(|(i, part)| {
                // what ends a sentence, a cell or a bracket ends a unit, too
                let is_last = i + 1 == unit.len();
                words.get(at + 1 + i).is_some_and(|word| match is_last {
                    true => bare(word) == *part,
                    false => word == part,
                })
            })
        })?;
        let has_unit = !name.is_empty() && value.is_finite();
        has_unit.then_some(Stated {
            at,
            words: 1 + unit.len(),
            value: value * scale,
            unit: name,
            number,
        })
    };
    words.iter().enumerate().filter_map(number_at).collect()
}

/// A word without what stands around it.
pub(super) fn bare(word: &str) -> &str {
    let of_word = |c: char| c.is_alphanumeric() || c == '.' || c == '-';
    word.trim_matches(|c| !of_word(c)).trim_end_matches('.')
}

/// What ends a key of lab.toml, the longer ones first.
const ENDS_OF_KEYS: [(&str, f64, &str); 12] = [
    ("n_m", 1.0, "N m"),
    ("n_s", 1.0, "N s"),
    ("rad_s", 1.0, "rad/s"),
    ("m_s", 1.0, "m/s"),
    ("m_s3", 1.0, ""),
    ("deg_s", PI / 180.0, "rad/s"),
    ("ms", 1e-3, "s"),
    ("s", 1.0, "s"),
    ("m", 1.0, "m"),
    ("rad", 1.0, "rad"),
    ("deg", PI / 180.0, "rad"),
    ("kg", 1.0, "kg"),
];

/// The unit of what stands at a key of lab.toml, where its end says one.
pub(super) fn unit_of_key(key: &str) -> Option<&'static str> {
    let (_, unit) = end_of_key(key)?;
    Some(unit)
}

/// What one is at a key, and in which unit.
fn end_of_key(key: &str) -> Option<(f64, &'static str)> {
    let (_, scale, unit) = ENDS_OF_KEYS.iter().find(|(end, ..)| {
        key.strip_suffix(end)
            .is_some_and(|rest| rest.is_empty() || rest.ends_with('_'))
    })?;
    (!unit.is_empty()).then_some((*scale, *unit))
}

/// The numbers with a unit at `key` of lab.toml and below it, those in expressions such as `"= 0.5 * period"` too.
pub(super) fn typed_at(key: &str, value: &Value) -> Vec<(f64, &'static str)> {
    let of_unit = |number: f64| end_of_key(key).map(|(scale, unit)| (number * scale, unit));
    match value {
        Value::Float(number) => of_unit(*number).into_iter().collect(),
        Value::Integer(number) => of_unit(*number as f64).into_iter().collect(),
        Value::Array(items) => items.iter().flat_map(|item| typed_at(key, item)).collect(),
        Value::Table(table) => table
            .iter()
            .flat_map(|(key, item)| typed_at(key, item))
            .collect(),
        Value::String(text) => {
            let parts = text.split(|c: char| !(c.is_ascii_digit() || ".e-".contains(c)));
            let numbers = parts.filter_map(|part| part.parse::<f64>().ok());
            numbers.filter_map(of_unit).collect()
        }
        Value::Boolean(_) | Value::Datetime(_) => Vec::new(),
    }
}

/// Whether two numbers are the same but for rounding.
pub(super) fn is_same(a: f64, b: f64) -> bool {
    (a - b).abs() <= 1e-6 * b.abs()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(text: &str) -> Vec<(f64, &'static str)> {
        let words: Vec<&str> = text.split_whitespace().collect();
        let stated = stated(&words).into_iter();
        stated.map(|stated| (stated.value, stated.unit)).collect()
    }

    #[test]
    fn numbers_with_a_unit_are_found_in_words() {
        for (text, expected) in [
            ("within 2 mm.", vec![(0.002, "m")]),
            ("at most 30 N m at the shoulder", vec![(30.0, "N m")]),
            (
                "(0.5 kg), 3 N s; 2 N.",
                vec![(0.5, "kg"), (3.0, "N s"), (2.0, "N")],
            ),
            (
                "100 N m per rad, 100 N m/rad, 5 N m s/rad, 0.1 kg m²",
                vec![],
            ),
            ("a turn of **180** degrees", vec![(PI, "rad")]),
            ("3 times, 2 places", vec![]),
            ("250 mm/s", vec![(0.25, "m/s")]),
        ] {
            assert_eq!(found(text), expected, "{text}");
        }
    }

    #[test]
    fn numbers_with_a_unit_are_found_at_keys() {
        let text = "check = { full_m = 2e-3, zero_n_m = 3, last_s = 0.5, within = 0.1, q_deg = [180], full_s = \"= reference + 1.2\" }";
        let table: toml::Table = text.parse().expect("TOML");
        let mut found = typed_at("check", &table["check"]);
        found.sort_by(|a, b| a.0.total_cmp(&b.0));
        let expected = [
            (0.002, "m"),
            (0.5, "s"),
            (1.2, "s"),
            (3.0, "N m"),
            (PI, "rad"),
        ];
        assert_eq!(found, expected);
    }
}
