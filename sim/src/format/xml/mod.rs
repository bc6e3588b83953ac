//! Descriptions in XML, whatever their format: documents that are safe to walk, elements and attributes, each with its place.

pub(super) mod document;
pub(super) mod reader;
