//! Built-ins of lists, maps and strings, charged by the number of elements that they process.

use std::any::TypeId;
use std::cmp::Ordering;
use std::ops;

use rhai::{Array, Dynamic, INT, ImmutableString, Map};

use super::arithmetic::equal;
use super::budget::Meter;
use super::library::{Arguments, Library};
use super::linear::index;
use super::mistake::{Problem, fault, fault_with_help};
use super::operand::{as_number, as_whole, count, number};
use super::range::Range;
use super::vector::{Matrix, Vector};
use super::weight::size;
use super::words::{describe, show};

pub(super) fn register(library: &mut Library) {
    let module = library.module_mut();
    module.set_iterable::<Array>();
    module.set_iterable::<Range>();
    module.set_iterable::<ops::Range<INT>>();
    module.set_iterable::<ops::RangeInclusive<INT>>();
    module.set_iter(TypeId::of::<ImmutableString>(), |text| {
        Box::new(Characters {
            text: text.cast(),
            next: 0,
        })
    });

    library.function("len", 1, |_, arguments| {
        length(arguments[0]).map(Dynamic::from_int)
    });
    library.internal("get$len", &[TypeId::of::<Dynamic>()], |_, arguments| {
        length(arguments[0]).map(Dynamic::from_int)
    });
    library.function("is_empty", 1, |_, arguments| {
        Ok((length(arguments[0])? == 0).into())
    });
    register_changes(library);
    register_lists(library);
    register_maps(library);
    library.function("to_string", 1, |meter, arguments| {
        show(meter, arguments[0]).map(Dynamic::from)
    });
    library.function("contains", 2, contains);
    library.function("range", 1, |_, arguments| {
        let to = count("range", arguments[0])? as INT;
        Ok(Dynamic::from(Range { from: 0, to }))
    });
    library.function("range", 2, |_, arguments| {
        match (as_whole(arguments[0]), as_whole(arguments[1])) {
            (Some(from), Some(to)) => Ok(Dynamic::from(Range { from, to })),
            _ => Err(fault("`range` takes integers")),
        }
    });
}

/// An iterator over the characters of a string, each made when it is needed.
struct Characters {
    text: ImmutableString,
    /// The byte at which the next one begins.
    next: usize,
}

impl Iterator for Characters {
    type Item = Dynamic;

    fn next(&mut self) -> Option<Dynamic> {
        let character = self.text.get(self.next..)?.chars().next()?;
        self.next += character.len_utf8();
        Some(ImmutableString::from(character.to_string()).into())
    }
}

fn length(value: &Dynamic) -> Result<INT, Problem> {
    let length = if let Some(vector) = value.read_lock::<Vector>() {
        vector.len()
    } else if let Ok(list) = value.as_array_ref() {
        list.len()
    } else if let Some(matrix) = value.read_lock::<Matrix>() {
        matrix.rows()
    } else if let Ok(map) = value.as_map_ref() {
        map.len()
    } else if let Ok(text) = value.as_immutable_string_ref() {
        text.chars().count()
    } else {
        return Err(fault(format!(
            "`len` takes a list, a vector, a matrix, a map or a string, got {}",
            describe(value)
        )));
    };
    Ok(length as INT)
}

/// Functions that change their first argument, which the script gives as a variable.
fn register_changes(library: &mut Library) {
    library.function("push", 2, |meter, arguments| {
        changeable(arguments[0])?;
        let value = std::mem::take(arguments[1]);
        if let Some(mut vector) = arguments[0].write_lock::<Vector>() {
            let number = number("push", &value)?;
            meter.list(vector.len() + 1)?;
            let mut elements = vector.elements().to_vec();
            elements.push(number);
            *vector = Vector::new(&elements);
            return Ok(Dynamic::UNIT);
        }
        let mut list = list_mut("push", arguments[0])?;
        meter.list(list.len() + 1)?;
        list.push(value);
        Ok(Dynamic::UNIT)
    });
    library.function("pop", 1, |meter, arguments| {
        changeable(arguments[0])?;
        let mut list = list_mut("pop", arguments[0])?;
        meter.charge(list.len())?;
        list.pop().ok_or_else(|| fault("`pop` from an empty list"))
    });
    library.function("insert", 3, |meter, arguments| {
        changeable(arguments[0])?;
        let value = std::mem::take(arguments[2]);
        let position = std::mem::take(arguments[1]);
        let mut list = list_mut("insert", arguments[0])?;
        meter.list(list.len() + 1)?;
        let at = index(&position, list.len() + 1, "list", "places")?;
        list.insert(at, value);
        Ok(Dynamic::UNIT)
    });
    library.function("remove", 2, |meter, arguments| {
        changeable(arguments[0])?;
        let key = std::mem::take(arguments[1]);
        if let Ok(mut map) = arguments[0].as_map_mut() {
            let map: &mut Map = &mut map;
            meter.charge(map.len())?;
            let key = key
                .into_immutable_string()
                .map_err(|_| fault("the key of a map is a string"))?;
            return Ok(map.remove(key.as_str()).unwrap_or_default());
        }
        let mut list = list_mut("remove", arguments[0])?;
        meter.charge(list.len())?;
        let at = index(&key, list.len(), "list", "elements")?;
        Ok(list.remove(at))
    });
    library.function("clear", 1, |_, arguments| {
        changeable(arguments[0])?;
        if let Ok(mut map) = arguments[0].as_map_mut() {
            map.clear();
            return Ok(Dynamic::UNIT);
        }
        list_mut("clear", arguments[0])?.clear();
        Ok(Dynamic::UNIT)
    });
}

fn changeable(value: &Dynamic) -> Result<(), Problem> {
    if value.is_read_only() {
        Err(fault_with_help(
            "a constant cannot change",
            "copy it with `let` first",
        ))
    } else {
        Ok(())
    }
}

fn list_mut<'a>(
    name: &str,
    value: &'a mut Dynamic,
) -> Result<impl ops::DerefMut<Target = Array> + use<'a>, Problem> {
    let got = describe(value);
    value
        .as_array_mut()
        .map_err(|_| fault(format!("`{name}` takes a list, got {got}")))
}

/// Functions that make a new list.
fn register_lists(library: &mut Library) {
    library.function("concat", 2, |meter, arguments| {
        let mut joined = elements(meter, "concat", arguments[0])?;
        let tail = elements(meter, "concat", arguments[1])?;
        meter.list(joined.len() + tail.len())?;
        joined.extend(tail);
        Ok(in_kind(joined, arguments[0]))
    });
    library.function("slice", 3, |meter, arguments| {
        let all = elements(meter, "slice", arguments[0])?;
        let (from, to) = (count("slice", arguments[1])?, count("slice", arguments[2])?);
        match all.get(from..to) {
            Some(part) => Ok(in_kind(part.to_vec(), arguments[0])),
            None => Err(fault(format!(
                "`slice` from {from} to {to} goes past the end of {}",
                describe(arguments[0])
            ))),
        }
    });
    library.function("reverse", 1, |meter, arguments| {
        let mut all = elements(meter, "reverse", arguments[0])?;
        all.reverse();
        Ok(in_kind(all, arguments[0]))
    });
    library.function("sort", 1, |meter, arguments| {
        let mut all = elements(meter, "sort", arguments[0])?;
        // n log n comparisons of about an operation each
        meter.charge(8 * all.len() * (all.len().max(2).ilog2() as usize))?;
        if all
            .iter()
            .all(|x| as_number(x).is_some_and(|x| !x.is_nan()))
        {
            all.sort_by(|a, b| {
                as_number(a)
                    .partial_cmp(&as_number(b))
                    .unwrap_or(Ordering::Equal)
            });
        } else if all.iter().all(Dynamic::is_string) {
            all.sort_by_cached_key(|text| text.clone().into_string().unwrap_or_default());
        } else {
            return Err(fault("`sort` takes a list of numbers, or of strings"));
        }
        Ok(in_kind(all, arguments[0]))
    });
}

/// The elements of a list or vector, charged for a copy of them.
fn elements(meter: &Meter, name: &str, value: &Dynamic) -> Result<Array, Problem> {
    if let Some(vector) = value.read_lock::<Vector>() {
        meter.charge(vector.len())?;
        return Ok(vector.elements().iter().map(|x| (*x).into()).collect());
    }
    match value.as_array_ref() {
        Ok(list) => {
            let list: &Array = &list;
            meter.charge((8 * list.len()).max(size(value)))?;
            Ok(list.clone())
        }
        Err(_) => Err(fault(format!(
            "`{name}` takes a list or a vector, got {}",
            describe(value)
        ))),
    }
}

/// A vector if the original was one and all elements are numbers, else a list.
fn in_kind(elements: Array, original: &Dynamic) -> Dynamic {
    if original.read_lock::<Vector>().is_some() {
        let numbers: Option<Vec<f64>> = elements.iter().map(as_number).collect();
        if let Some(numbers) = numbers {
            return Dynamic::from(Vector::new(&numbers));
        }
    }
    Dynamic::from_array(elements)
}

fn register_maps(library: &mut Library) {
    library.function("keys", 1, |meter, arguments| {
        with_map(meter, "keys", arguments[0], |map| {
            map.keys().map(|key| key.clone().into()).collect()
        })
    });
    library.function("values", 1, |meter, arguments| {
        with_map(meter, "values", arguments[0], |map| {
            map.values().cloned().collect()
        })
    });
    library.function("get", 3, |meter, arguments| {
        let otherwise = std::mem::take(arguments[2]);
        let Ok(map) = arguments[0].as_map_ref() else {
            return Err(fault(format!(
                "`get` takes a map, a key and what holds if there is none, got {}",
                describe(arguments[0])
            )));
        };
        let map: &Map = &map;
        meter.charge(map.len())?;
        let Ok(key) = arguments[1].as_immutable_string_ref() else {
            return Err(fault("the key of a map is a string"));
        };
        let Some(found) = map.get(key.as_str()) else {
            return Ok(otherwise);
        };
        meter.charge(size(found))?;
        Ok(found.clone())
    });
}

fn with_map(
    meter: &Meter,
    name: &str,
    value: &Dynamic,
    list: impl Fn(&Map) -> Array,
) -> Result<Dynamic, Problem> {
    let Ok(map) = value.as_map_ref() else {
        return Err(fault(format!(
            "`{name}` takes a map, got {}",
            describe(value)
        )));
    };
    let map: &Map = &map;
    meter.charge((8 * map.len()).max(size(value)))?;
    Ok(Dynamic::from_array(list(map)))
}

/// Whether a list contains a value, a map a key, or a string a string: the operator `in`.
fn contains(meter: &Meter, arguments: Arguments<'_, '_>) -> Result<Dynamic, Problem> {
    let (container, wanted) = (&*arguments[0], &*arguments[1]);
    if let Ok(map) = container.as_map_ref() {
        let map: &Map = &map;
        meter.charge(map.len())?;
        return match wanted.as_immutable_string_ref() {
            Ok(key) => Ok(map.contains_key(key.as_str()).into()),
            Err(_) => Err(fault("the key of a map is a string")),
        };
    }
    if let (Ok(text), Ok(part)) = (
        container.as_immutable_string_ref(),
        wanted.as_immutable_string_ref(),
    ) {
        meter.charge(text.len() + part.len())?;
        return Ok(text.contains(part.as_str()).into());
    }
    if let Some(range) = Range::of(container) {
        return Ok(as_whole(wanted)
            .is_some_and(|whole| range.contains(whole))
            .into());
    }
    for element in elements(meter, "contains", container)? {
        if equal(meter, &element, wanted)? {
            return Ok(true.into());
        }
    }
    Ok(false.into())
}
