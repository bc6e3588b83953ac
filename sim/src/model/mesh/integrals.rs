//! Volume, centre of mass and inertia of the solid inside a closed mesh, exact except for rounding.
//!
//! Every triangle spans a signed tetrahedron with a reference point; moments of the solid are sums of theirs. The reference is
//! the middle of the bounds for the centre of mass, and then the centre of mass itself, so that no digits are lost in a mesh far from
//! the origin.
//!
//! Source: Tonon, *Explicit exact formulas for the 3-D tetrahedron inertia tensor* (2005), as polynomial sums over corners.

use nalgebra::Vector3;

use super::closed;
use super::mesh_problem::MeshProblem;
use super::surface::{EMPTY, Mesh, widened};
use crate::model::inertia::Inertia;
use crate::spatial::Symmetric3;

/// Mass properties at 1 kg/m³, so that the mass is the volume.
pub(super) fn of_unit_density(mesh: &Mesh) -> Result<Inertia, MeshProblem> {
    closed::check(mesh)?;
    let (low, high) = mesh.bounds();
    let middle = Vector3::from_fn(|i, _| 0.5 * low[i] + 0.5 * high[i]);

    // volume and first moment about the middle
    let (shell_of, shells) = closed::shells(mesh);
    let mut shell_volumes = vec![0.0; shells];
    let mut volume = 0.0;
    let mut first_moment = Vector3::zeros();
    let mut area = 0.0;
    for (t, shell) in shell_of.iter().enumerate() {
        let [a, b, c] = corners_from(mesh, t, &middle);
        let v = a.dot(&b.cross(&c)) / 6.0;
        volume += v;
        shell_volumes[*shell as usize] += v;
        first_moment += (a + b + c) * (v / 4.0);
        area += 0.5 * (b - a).cross(&(c - a)).norm();
    }
    // Thinner than this, and a solid is made of the rounding of its coordinates.
    let largest = low
        .iter()
        .chain(&high)
        .fold(0.0, |m: f64, x| m.max(x.abs()));
    let noise = 8.0 * f64::EPSILON * largest * area;
    if !volume.is_finite() || !noise.is_finite() {
        return Err(MeshProblem::TooLarge);
    }
    if volume < -noise {
        return Err(MeshProblem::InsideOut { volume_m3: volume });
    }
    check_shells(mesh, &shell_of, &shell_volumes, noise)?;
    if volume <= noise {
        return Err(MeshProblem::NoVolume);
    }

    let com_from_middle = first_moment / volume;
    let com_m = middle + com_from_middle;
    let mut second = Symmetric3::default();
    for t in 0..mesh.triangles().len() {
        let [a, b, c] = corners_from(mesh, t, &middle).map(|p| p - com_from_middle);
        add_second_moment(&mut second, &a, &b, &c);
    }
    // from moments ∫x xᵀ to inertia ∫(|x|² 1 - x xᵀ)
    let about_com_kg_m2 = Symmetric3 {
        xx: second.yy + second.zz,
        yy: second.xx + second.zz,
        zz: second.xx + second.yy,
        xy: -second.xy,
        xz: -second.xz,
        yz: -second.yz,
    };
    finite(Inertia {
        mass_kg: volume,
        com_m,
        about_com_kg_m2,
    })
}

/// The same body with its density multiplied by a factor.
pub(super) fn multiplied(unit: &Inertia, factor: f64) -> Result<Inertia, MeshProblem> {
    let i = unit.about_com_kg_m2;
    finite(Inertia {
        mass_kg: unit.mass_kg * factor,
        com_m: unit.com_m,
        about_com_kg_m2: Symmetric3 {
            xx: i.xx * factor,
            yy: i.yy * factor,
            zz: i.zz * factor,
            xy: i.xy * factor,
            xz: i.xz * factor,
            yz: i.yz * factor,
        },
    })
}

fn finite(inertia: Inertia) -> Result<Inertia, MeshProblem> {
    let tensor = inertia.about_com_kg_m2.to_matrix();
    let numbers = inertia.com_m.iter().chain(tensor.iter());
    if inertia.mass_kg.is_finite() && numbers.into_iter().all(|x| x.is_finite()) {
        return Ok(inertia);
    }
    Err(MeshProblem::TooLarge)
}

fn corners_from(mesh: &Mesh, t: usize, reference: &Vector3<f64>) -> [Vector3<f64>; 3] {
    mesh.corners(t).map(|p| Vector3::from(p) - reference)
}

/// Adds `∫x xᵀ` over the tetrahedron of the origin and three corners.
fn add_second_moment(sum: &mut Symmetric3, a: &Vector3<f64>, b: &Vector3<f64>, c: &Vector3<f64>) {
    let s = a + b + c;
    let weight = a.dot(&b.cross(c)) / 120.0;
    let moment =
        |i: usize, j: usize| weight * (s[i] * s[j] + a[i] * a[j] + b[i] * b[j] + c[i] * c[j]);
    sum.xx += moment(0, 0);
    sum.yy += moment(1, 1);
    sum.zz += moment(2, 2);
    sum.xy += moment(0, 1);
    sum.xz += moment(0, 2);
    sum.yz += moment(1, 2);
}

/// How many shells, the largest first, are looked at for one that holds a cavity: or else a hostile file of half a million
/// shells would take minutes.
const HULLS: usize = 1000;

/// A shell of negative volume is a cavity if it lies in another, by their bounds, and inside out if it does not.
fn check_shells(
    mesh: &Mesh,
    shell_of: &[u32],
    volumes: &[f64],
    noise: f64,
) -> Result<(), MeshProblem> {
    if volumes.iter().all(|v| *v >= -noise) {
        return Ok(());
    }
    let mut bounds = vec![EMPTY; volumes.len()];
    for (t, shell) in shell_of.iter().enumerate() {
        let shell = &mut bounds[*shell as usize];
        *shell = mesh.corners(t).iter().fold(*shell, widened);
    }
    let mut hulls: Vec<usize> = (0..volumes.len()).filter(|s| volumes[*s] > 0.0).collect();
    hulls.sort_by(|a, b| volumes[*b].total_cmp(&volumes[*a]));
    hulls.truncate(HULLS);
    for (shell, _) in volumes.iter().enumerate().filter(|(_, v)| **v < -noise) {
        let (low, high) = bounds[shell];
        let holds = |hull: &&usize| {
            let (hull_low, hull_high) = bounds[**hull];
            (0..3).all(|i| hull_low[i] <= low[i] && high[i] <= hull_high[i])
        };
        if !hulls.iter().any(|hull| holds(&hull)) {
            let first = shell_of.iter().position(|s| *s as usize == shell);
            return Err(MeshProblem::ShellInsideOut {
                shells: volumes.len(),
                vertex: mesh.corners(first.unwrap_or(0))[0],
            });
        }
    }
    Ok(())
}
