//! Meshes with so many triangles that contact and pages get slow.

use crate::model::inertia::Solid;
use crate::model::robot::Link;

/// So many triangles in all draw and touch without a wait.
const LIGHT: usize = 20_000;
/// So many of the heaviest links are named.
const MOST_NAMED: usize = 5;

/// A warning with the heaviest links, where the meshes of all of them have too many triangles, each counted as often as it is used.
pub(super) fn warning(links: &[Link]) -> Option<String> {
    let mut heavy: Vec<(usize, &str)> = links
        .iter()
        .map(|link| (triangles(link), link.name.as_str()))
        .filter(|(triangles, _)| *triangles > 0)
        .collect();
    let all: usize = heavy.iter().map(|(triangles, _)| triangles).sum();
    if all <= LIGHT {
        return None;
    }
    // links of the same weight in file order
    heavy.sort_by_key(|(triangles, _)| std::cmp::Reverse(*triangles));
    let named: Vec<String> = heavy
        .iter()
        .take(MOST_NAMED)
        .map(|(triangles, name)| {
            let name: String = name.chars().take(60).collect();
            format!("`{name}` {triangles}")
        })
        .collect();
    Some(format!(
        "the meshes have {all} triangles, more than {LIGHT}: contact and pages get slow; the heaviest links are {}; decimate their \
         meshes, or use boxes and cylinders in <collision> or `shapes`",
        named.join(", ")
    ))
}

fn triangles(link: &Link) -> usize {
    let solids = link.shapes.iter().map(|shape| &shape.solid);
    solids
        .map(|solid| match solid {
            Solid::Mesh(mesh) => mesh.mesh.triangles().len(),
            _ => 0,
        })
        .sum()
}
