//! Bytes to mesh, in each format that a name can announce, and its mass properties.
#![no_main]

use kinemark_sim::model::mesh::Mesh;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    for name in ["fuzz.stl", "fuzz.obj", "fuzz"] {
        if let Ok(mesh) = Mesh::parse(name, bytes) {
            // a mesh that encloses nothing has no inertia, and says so
            let _inertia = mesh.inertia(1000.0);
            let _scaled = mesh.scaled([1.0, -2.0, 0.5]).inertia(1000.0);
        }
    }
});
