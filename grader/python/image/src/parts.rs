//! The sections of a module as they are written, with what the ones that make a module of it need to know.

use std::error::Error;
use std::ops::Range;

use wasm_encoder::{Encode as _, Module, RawSection};
use wasmparser::{CompositeInnerType, FuncType, GlobalType, Parser, Payload, TableType, TypeRef};

/// Numbers of sections.
pub(crate) const TYPES: u8 = 1;
pub(crate) const IMPORTS: u8 = 2;
pub(crate) const TABLES: u8 = 4;
pub(crate) const MEMORIES: u8 = 5;
pub(crate) const GLOBALS: u8 = 6;
pub(crate) const EXPORTS: u8 = 7;
pub(crate) const ELEMENTS: u8 = 9;
pub(crate) const CODE: u8 = 10;
pub(crate) const DATA: u8 = 11;

/// A module in its parts. Functions are counted with the imported ones first, as everywhere in a module.
pub(crate) struct Parts<'m> {
    /// The sections, by their numbers, in order.
    pub(crate) sections: Vec<(u8, &'m [u8])>,
    pub(crate) types: Vec<FuncType>,
    /// Names of the imported functions.
    pub(crate) imports: Vec<(&'m str, &'m str)>,
    /// The type of each function.
    pub(crate) type_of: Vec<u32>,
    pub(crate) table: TableType,
    pub(crate) globals: Vec<GlobalType>,
    /// The bodies of the functions that are not imported, locals first.
    pub(crate) bodies: Vec<Range<usize>>,
}

impl<'m> Parts<'m> {
    /// The parts of `module`.
    pub(crate) fn of(module: &'m [u8]) -> Result<Self, Box<dyn Error>> {
        let mut sections = Vec::new();
        let mut types = Vec::new();
        let mut imports = Vec::new();
        let mut type_of = Vec::new();
        let mut tables = Vec::new();
        let mut globals = Vec::new();
        let mut bodies = Vec::new();
        for payload in Parser::new(0).parse_all(module) {
            let payload = payload?;
            if let Some((id, range)) = payload.as_section()
                && id != 0
            {
                sections.push((id, &module[range]));
            }
            match payload {
                Payload::DataCountSection { .. } => {
                    return Err(
                        "the module copies its own data: its memory is not all there is".into(),
                    );
                }
                Payload::StartSection { .. } => return Err("the module starts by itself".into()),
                Payload::TypeSection(reader) => {
                    for group in reader {
                        for sub in group?.into_types() {
                            let CompositeInnerType::Func(of) = sub.composite_type.inner else {
                                return Err("a type that is no function's".into());
                            };
                            types.push(of);
                        }
                    }
                }
                Payload::ImportSection(reader) => {
                    for import in reader {
                        let import = import?;
                        let TypeRef::Func(of) = import.ty else {
                            return Err(format!(
                                "{} is imported, which is no function",
                                import.name
                            )
                            .into());
                        };
                        imports.push((import.module, import.name));
                        type_of.push(of);
                    }
                }
                Payload::FunctionSection(reader) => {
                    for of in reader {
                        type_of.push(of?);
                    }
                }
                Payload::TableSection(reader) => {
                    for table in reader {
                        tables.push(table?.ty);
                    }
                }
                Payload::GlobalSection(reader) => {
                    for global in reader {
                        globals.push(global?.ty);
                    }
                }
                Payload::CodeSectionEntry(body) => bodies.push(body.range()),
                _ => {}
            }
        }
        let [table] = tables[..] else {
            return Err("the module has not one table".into());
        };
        Ok(Self {
            sections,
            types,
            imports,
            type_of,
            table,
            globals,
            bodies,
        })
    }

    /// Index of the first function that is not imported.
    pub(crate) fn first(&self) -> u32 {
        self.imports.len() as u32
    }

    /// The section of this number.
    pub(crate) fn section(&self, id: u8) -> Result<&'m [u8], Box<dyn Error>> {
        let found = self.sections.iter().find(|(of, _)| *of == id);
        Ok(found.ok_or(format!("the module has no section {id}"))?.1)
    }

    /// The module, with other contents for some sections, or without them.
    pub(crate) fn with(&self, others: Vec<(u8, Option<Vec<u8>>)>) -> Vec<u8> {
        let mut module = Module::new();
        for (id, data) in &self.sections {
            match others.iter().find(|(of, _)| of == id) {
                None => module.section(&RawSection { id: *id, data }),
                Some((_, Some(data))) => module.section(&RawSection { id: *id, data }),
                Some((_, None)) => continue,
            };
        }
        module.finish()
    }
}

/// A section that is a list, with more entries behind those it has.
pub(crate) fn with_more(
    section: &[u8],
    more: u32,
    entries: &[u8],
) -> Result<Vec<u8>, Box<dyn Error>> {
    let mut reader = wasmparser::BinaryReader::new(section, 0);
    let count = reader.read_var_u32()?;
    let mut out = Vec::with_capacity(section.len() + entries.len() + 5);
    (count + more).encode(&mut out);
    out.extend_from_slice(&section[reader.original_position()..]);
    out.extend_from_slice(entries);
    Ok(out)
}

/// A code section with these bodies.
pub(crate) fn code(bodies: &[Vec<u8>]) -> Vec<u8> {
    let mut out = Vec::new();
    (bodies.len() as u32).encode(&mut out);
    for body in bodies {
        body.as_slice().encode(&mut out);
    }
    out
}

/// What a section has behind its length.
pub(crate) fn contents(section: &impl wasm_encoder::Section) -> Result<Vec<u8>, Box<dyn Error>> {
    let mut bytes = Vec::new();
    section.encode(&mut bytes);
    Ok(behind_number(&bytes)?.to_vec())
}

/// What stands behind a number.
pub(crate) fn behind_number(bytes: &[u8]) -> Result<&[u8], Box<dyn Error>> {
    let mut reader = wasmparser::BinaryReader::new(bytes, 0);
    reader.read_var_u32()?;
    Ok(&bytes[reader.original_position()..])
}
