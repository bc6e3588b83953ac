//! How large a value is: what a copy of it costs, and what of it is in the budgets of size.

use std::any::TypeId;

use rhai::{Array, Dynamic, ImmutableString, Map};

use super::budget::Meter;
use super::mistake::Problem;
use super::vector::{Matrix, Vector};
use crate::submission::controller::Budget;

/// Charges for a copy of a value that the engine makes and does not count.
pub(super) fn charge_for_copy(meter: &Meter, value: &Dynamic) -> Result<(), Problem> {
    if value.is_array() || value.is_map() || value.is_string() {
        meter.charge(size(value))?;
    }
    Ok(())
}

/// Refuses a value beyond a budget of size, including its vectors, which the engine does not count.
pub(super) fn check_size(meter: &Meter, value: &Dynamic) -> Result<(), Problem> {
    let mut weight = Weight::default();
    weight.add(value);
    meter.within(Budget::ListSize, weight.elements + weight.numbers)?;
    meter.within(Budget::MapSize, weight.entries)?;
    meter.within(Budget::TextSize, weight.bytes)
}

/// A list or a map takes as long to copy as so many numbers: it has memory of its own.
const CONTAINER: usize = 4;

/// So many lists and maps in a value are free.
const FEW_CONTAINERS: usize = 8;

/// Keys of maps up to this many bytes have no memory of their own.
const SHORT_KEY: usize = 23;

/// The cost of a copy of a value, in elements; vectors are shared.
pub(super) fn size(value: &Dynamic) -> usize {
    let mut weight = Weight::default();
    weight.add(value);
    let containers = weight.containers.saturating_sub(FEW_CONTAINERS);
    weight.elements + weight.entries + weight.bytes + weight.key_bytes + CONTAINER * containers
}

/// The elements and entries that the engine visits where it looks for how large a value is.
pub(super) fn parts(value: &Dynamic) -> usize {
    if !(value.is_array() || value.is_map()) {
        return 0;
    }
    let mut weight = Weight::default();
    weight.add(value);
    weight.elements + weight.entries
}

#[derive(Default)]
struct Weight {
    /// Elements of lists.
    elements: usize,
    /// Elements of vectors and matrices.
    numbers: usize,
    /// Entries of maps.
    entries: usize,
    /// Bytes of strings.
    bytes: usize,
    /// Bytes of long keys.
    key_bytes: usize,
    /// Lists and maps.
    containers: usize,
}

impl Weight {
    fn add(&mut self, value: &Dynamic) {
        // asked once: most values are numbers, and this is done whenever a list or map is mentioned
        let kind = value.type_id();
        if kind == TypeId::of::<f64>() || kind == TypeId::of::<bool>() {
            return;
        }
        if kind == TypeId::of::<Vector>() {
            self.numbers += value.read_lock::<Vector>().map_or(0, |vector| vector.len());
        } else if kind == TypeId::of::<Array>() {
            if let Ok(list) = value.as_array_ref() {
                let list: &Array = &list;
                self.containers += 1;
                self.elements += list.len();
                list.iter().for_each(|element| self.add(element));
            }
        } else if kind == TypeId::of::<Map>() {
            if let Ok(map) = value.as_map_ref() {
                let map: &Map = &map;
                self.containers += 1;
                self.entries += map.len();
                for (key, element) in map {
                    self.key_bytes += key_bytes(key);
                    self.add(element);
                }
            }
        } else if kind == TypeId::of::<ImmutableString>() {
            if let Ok(text) = value.as_immutable_string_ref() {
                self.bytes += text.len();
            }
        } else if let Some(matrix) = value.read_lock::<Matrix>() {
            self.numbers += matrix.rows() * matrix.columns();
        }
    }
}

/// The bytes of a key that are copied with it.
fn key_bytes(key: &str) -> usize {
    if key.len() > SHORT_KEY { key.len() } else { 0 }
}
