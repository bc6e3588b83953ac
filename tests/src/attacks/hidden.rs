//! The numbers of hidden cases and runs, as course staff list them: none of them may be in anything that a graded submission brings about.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError};

use aho_corasick::AhoCorasick;
use serde_json::Value;

use crate::folder::filled;
use crate::run::SALT;
use crate::testbed::TestBed;

/// Digits of a number that no other number has by chance.
const DIGITS: usize = 9;

/// What is looked for, by lab.
static KNOWN: Mutex<BTreeMap<String, Arc<Hidden>>> = Mutex::new(BTreeMap::new());

/// The hidden numbers of a lab, each as text and as its eight bytes.
struct Hidden {
    numbers: Vec<f64>,
    forms: AhoCorasick,
}

/// A hidden number of the lab that stands in `bytes`, as text or as its eight bytes.
pub(crate) fn hidden_number_in(lab: &str, bytes: &[u8]) -> Option<f64> {
    let hidden = of_lab(lab);
    let found = hidden.forms.find(bytes)?;
    Some(hidden.numbers[found.pattern().as_usize() / 2])
}

/// The first digits of a number, with its point and without its sign.
fn leading_digits(number: f64) -> String {
    number.abs().to_string().chars().take(DIGITS + 1).collect()
}

/// The hidden numbers of a lab with the salt of all cases; those that have so few digits that they may stand anywhere are left out.
fn of_lab(lab: &str) -> Arc<Hidden> {
    let mut known = KNOWN.lock().unwrap_or_else(PoisonError::into_inner);
    let hidden = known.entry(lab.to_owned()).or_insert_with(|| {
        let (labs, reference) = (
            filled("--labs={root}/labs"),
            filled("--reference={root}/reference"),
        );
        let words = [
            "lab", "draws", lab, &labs, &reference, "--salt", SALT, "--json",
        ];
        let ran = TestBed::new().run(&words);
        let list: Value = serde_json::from_str(&ran.stdout).expect("a list");
        let mut numbers = Vec::new();
        for draw in list["draws"].as_array().expect("draws") {
            collect(&draw["numbers"], &mut numbers);
        }
        numbers.retain(|number| leading_digits(*number).len() > DIGITS);
        assert!(!numbers.is_empty(), "no hidden numbers in {lab}");
        let forms = numbers.iter().flat_map(|number| {
            [
                leading_digits(*number).into_bytes(),
                number.to_le_bytes().to_vec(),
            ]
        });
        let forms = AhoCorasick::new(forms).expect("a search");
        Arc::new(Hidden { numbers, forms })
    });
    Arc::clone(hidden)
}

fn collect(value: &Value, numbers: &mut Vec<f64>) {
    match value {
        Value::Number(number) => numbers.extend(number.as_f64()),
        Value::Array(values) => values.iter().for_each(|value| collect(value, numbers)),
        Value::Object(entries) => entries.values().for_each(|value| collect(value, numbers)),
        Value::Null | Value::Bool(_) | Value::String(_) => {}
    }
}

#[test]
fn a_hidden_number_is_found_as_text_and_as_bytes() {
    let lab = "01-kinematics";
    let numbers = &of_lab(lab).numbers;
    assert!(numbers.len() > 100, "{} numbers", numbers.len());
    let one = numbers[7];
    for bytes in [
        format!("q = {one}").into_bytes(),
        one.to_le_bytes().to_vec(),
    ] {
        assert_eq!(hidden_number_in(lab, &bytes), Some(one));
    }
    assert_eq!(hidden_number_in(lab, b"q = 0.5"), None);
}
