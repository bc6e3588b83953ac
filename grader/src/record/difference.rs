//! Where two records first differ.

use serde_json::Value;

use super::sums::Contradiction;

/// The first place, at `place` or in it, where `recorded` and `now` differ, as a path such as `tasks[3].points`.
pub fn first_difference(place: &str, recorded: &Value, now: &Value) -> Option<Contradiction> {
    let dot = if place.is_empty() { "" } else { "." };
    match (recorded, now) {
        (Value::Object(a), Value::Object(b)) if a.keys().eq(b.keys()) => a
            .iter()
            .zip(b.values())
            .find_map(|((key, a), b)| first_difference(&format!("{place}{dot}{key}"), a, b)),
        (Value::Array(a), Value::Array(b)) if a.len() == b.len() => a
            .iter()
            .zip(b)
            .enumerate()
            .find_map(|(i, (a, b))| first_difference(&format!("{place}[{i}]"), a, b)),
        (a, b) if a == b => None,
        (a, b) => Some(Contradiction {
            place: place.to_owned(),
            recorded: a.to_string(),
            follows: b.to_string(),
        }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn the_first_place_that_differs_is_named() {
        let a = json!({ "points": 2.0, "tasks": [{ "name": "fk", "log": [1, 2] }] });
        assert_eq!(first_difference("", &a, &a), None);
        for (path, other, place) in [
            ("/points", json!(3.0), "points"),
            ("/tasks/0/name", json!("ik"), "tasks[0].name"),
            ("/tasks/0/log/1", json!(3), "tasks[0].log[1]"),
            ("/tasks/0/log", json!([1]), "tasks[0].log"),
            ("/tasks/0", json!({ "name": "fk" }), "tasks[0]"),
        ] {
            let mut b = a.clone();
            *b.pointer_mut(path).unwrap() = other;
            let found = first_difference("", &a, &b).unwrap();
            assert_eq!(found.place, place);
            assert_ne!(found.recorded, found.follows);
        }
    }
}
