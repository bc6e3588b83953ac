//! Values as the text of a TOML file that is written.

use nalgebra::Vector3;

/// A text with the quotes and escapes of TOML.
pub(crate) fn quoted(text: &str) -> String {
    toml::Value::String(text.to_owned()).to_string()
}

/// Three numbers as a list, each so that it is read back to the last bit.
pub(crate) fn triple(v: &Vector3<f64>) -> String {
    format!("[{:?}, {:?}, {:?}]", v.x, v.y, v.z)
}
