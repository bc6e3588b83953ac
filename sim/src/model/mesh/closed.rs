//! Whether triangles bound a solid: every directed edge has exactly one opposite edge; and where not, which edges are wrong.

use super::mesh_problem::MeshProblem;
use super::surface::Mesh;

/// Number of edges or triangles that a message names.
const NAMED: usize = 3;

/// One use of an edge: its vertices, the smaller index first, the triangle, and whether the triangle runs from the smaller to the larger.
type Use = (u32, u32, u32, bool);

/// Checks that every edge has two triangles, which run along it in opposite directions.
pub(super) fn check(mesh: &Mesh) -> Result<(), MeshProblem> {
    let uses = uses_by_edge(mesh);
    let mut leaky = Named::default();
    let mut crowded = Named::default();
    let mut wound_alike = false;
    for edge in uses.chunk_by(same_edge) {
        match edge {
            [one] => leaky.add(mesh, one),
            [one, other] => wound_alike |= one.3 == other.3,
            more => crowded.add(mesh, &more[0]),
        }
    }
    if leaky.count > 0 {
        return Err(MeshProblem::Leaky {
            open_edges: leaky.count,
            first: leaky.first,
        });
    }
    if crowded.count > 0 {
        return Err(MeshProblem::Crowded {
            edges: crowded.count,
            first: crowded.first,
        });
    }
    if wound_alike {
        return Err(flipped(mesh, &uses));
    }
    Ok(())
}

/// All uses of edges, sorted by vertices: the uses of one edge are adjacent, and messages do not vary.
fn uses_by_edge(mesh: &Mesh) -> Vec<Use> {
    let mut uses: Vec<Use> = Vec::with_capacity(3 * mesh.triangles().len());
    for (t, &[a, b, c]) in mesh.triangles().iter().enumerate() {
        for (from, to) in [(a, b), (b, c), (c, a)] {
            uses.push((from.min(to), from.max(to), t as u32, from < to));
        }
    }
    uses.sort_unstable();
    uses
}

fn same_edge(one: &Use, other: &Use) -> bool {
    (one.0, one.1) == (other.0, other.1)
}

/// A count of edges and the ends of the first few, each in the direction its triangle runs.
#[derive(Default)]
struct Named {
    count: usize,
    first: Vec<[[f64; 3]; 2]>,
}

impl Named {
    fn add(&mut self, mesh: &Mesh, &(low, high, _, forward): &Use) {
        self.count += 1;
        if self.first.len() < NAMED {
            let [low, high] = [low, high].map(|v| mesh.vertices()[v as usize]);
            self.first.push(match forward {
                true => [low, high],
                false => [high, low],
            });
        }
    }
}

/// The triangles to flip, the smaller group of each shell, in a mesh whose every edge has two triangles.
fn flipped(mesh: &Mesh, uses: &[Use]) -> MeshProblem {
    let count = mesh.triangles().len();
    // neighbours over each edge, and whether they agree
    let mut neighbours: Vec<Vec<(usize, bool)>> = vec![Vec::with_capacity(3); count];
    for pair in uses.chunk_by(same_edge) {
        if let [one, other] = pair {
            let (a, b) = (one.2 as usize, other.2 as usize);
            let agree = one.3 != other.3;
            neighbours[a].push((b, agree));
            neighbours[b].push((a, agree));
        }
    }
    // traverse each shell from its first triangle, and flip every triangle that disagrees with the one before it
    let mut turned: Vec<Option<bool>> = vec![None; count];
    let mut to_flip: Vec<usize> = Vec::new();
    for start in 0..count {
        if turned[start].is_some() {
            continue;
        }
        turned[start] = Some(false);
        let mut shell = vec![(start, false)];
        let mut visited = 0;
        while let Some(&(t, t_turned)) = shell.get(visited) {
            visited += 1;
            for &(other, agree) in &neighbours[t] {
                let should = t_turned == agree;
                match turned[other] {
                    None => {
                        turned[other] = Some(should);
                        shell.push((other, should));
                    }
                    Some(is) if is != should => return MeshProblem::OneSided,
                    Some(_) => {}
                }
            }
        }
        let many_turned = 2 * shell.iter().filter(|(_, turned)| *turned).count() > shell.len();
        let fewer = shell.iter().filter(|(_, turned)| *turned != many_turned);
        to_flip.extend(fewer.map(|(t, _)| *t));
    }
    to_flip.sort_unstable();
    MeshProblem::Flipped {
        count: to_flip.len(),
        first: to_flip
            .iter()
            .take(NAMED)
            .map(|t| mesh.corners(*t))
            .collect(),
    }
}

/// The shells of the mesh, which are sets of triangles connected by vertices: the shell of each triangle, and the number of shells.
///
/// Shells are numbered by their first triangles.
pub(super) fn shells(mesh: &Mesh) -> (Vec<u32>, usize) {
    // union-find over vertices, always towards the smaller
    let mut parent: Vec<u32> = (0..mesh.vertices().len() as u32).collect();
    for &[a, b, c] in mesh.triangles() {
        for other in [b, c] {
            let (one, other) = (root(&mut parent, a), root(&mut parent, other));
            parent[one.max(other) as usize] = one.min(other);
        }
    }
    let mut shell_of_root: Vec<Option<u32>> = vec![None; parent.len()];
    let mut count = 0;
    let mut shell_of = Vec::with_capacity(mesh.triangles().len());
    for &[a, _, _] in mesh.triangles() {
        let root = root(&mut parent, a) as usize;
        let shell = *shell_of_root[root].get_or_insert_with(|| {
            count += 1;
            count - 1
        });
        shell_of.push(shell);
    }
    (shell_of, count as usize)
}

fn root(parent: &mut [u32], mut v: u32) -> u32 {
    while parent[v as usize] != v {
        // path halving, for the next search
        parent[v as usize] = parent[parent[v as usize] as usize];
        v = parent[v as usize];
    }
    v
}
