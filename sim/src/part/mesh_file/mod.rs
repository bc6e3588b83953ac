//! Mesh files: STL, binary or text, and OBJ.

mod mesh_reader;
mod obj;
mod stl;
