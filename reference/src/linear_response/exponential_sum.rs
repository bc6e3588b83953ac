//! Inverse Laplace transform of a strictly proper rational function, with bounds over intervals of time.
//!
//! Poles that stand apart give the textbook's partial fractions `c e^{pt}`. Poles that meet, or nearly, are kept
//! together as a *cluster*, where the fractions would be huge and cancel. With the cluster's poles `p₁ … p_m` and
//! `g(s)` the rest of the function, the cluster's part is
//!
//! ```text
//! Σ_k g[p₁ … p_k] / ((s - p_k) … (s - p_m))   <->   Σ_k g[p₁ … p_k] t^{m-k} exp[p_k t … p_m t]
//! ```
//!
//! where `f[x₁ … x_k]` is a divided difference. It is Newton's interpolation; poles may coincide exactly, and a single
//! pole gives the partial fraction again.
//!
//! Source: Opitz, *Steigungsmatrizen* (1964): a divided difference of `f` is an entry of `f(Z)`, `Z` with the points on
//! its diagonal and ones above it. Sums and products of functions become sums and products of such matrices.

use nalgebra::Complex;

use super::two_double::{ComplexTwoDouble, TwoDouble};

/// Poles closer than this fraction of their magnitude share a cluster. Fractions of two that stand just apart cancel by
/// a factor of 4, those of four by less than 100.
const CLUSTER_FRACTION: f64 = 0.25;

/// A sum of exponentials `f(t)`, `t` in s, `t >= 0`.
#[derive(Debug, Clone)]
pub(super) struct ExponentialSum {
    clusters: Vec<Cluster>,
}

/// The part of the sum whose poles are close to each other.
#[derive(Debug, Clone)]
struct Cluster {
    /// `p₁ … p_m` \[1/s\].
    poles: Vec<ComplexTwoDouble>,
    /// `g[p₁], g[p₁ p₂], … g[p₁ … p_m]`.
    coefficients: Vec<ComplexTwoDouble>,
    /// The largest real part of a pole \[1/s\].
    growth: f64,
    /// Poles and magnitudes of coefficients as doubles, for evaluation.
    rounded_poles: Vec<Complex<f64>>,
    rounded_coefficients: Vec<Complex<f64>>,
}

impl ExponentialSum {
    /// The transform of `numerator / (leading · Π (s - pole))`, less what lies at poles that are exactly `left_out`
    /// (if given): the transient of a step response is all but the pole at zero.
    pub(super) fn new(
        numerator: &[f64],
        leading: f64,
        poles: &[ComplexTwoDouble],
        left_out: Option<ComplexTwoDouble>,
    ) -> Self {
        let groups = grouped(poles);
        let mut clusters = Vec::new();
        for (index, group) in groups.iter().enumerate() {
            if left_out.is_some_and(|pole| group.contains(&pole)) {
                continue;
            }
            // Horner's rule at the matrix Z: the first row of numerator(Z)
            let mut row = vec![ComplexTwoDouble::ZERO; group.len()];
            for &a in numerator {
                row = times_s(&row, group);
                row[0] = row[0] + ComplexTwoDouble::real(TwoDouble::exact(a));
            }
            for (other, others) in groups.iter().enumerate() {
                if other != index {
                    for &pole in others {
                        row = divided_by_s_minus(&row, group, pole);
                    }
                }
            }
            let scale = TwoDouble::exact(1.0) / TwoDouble::exact(leading);
            clusters.push(Cluster::new(group.clone(), row).scaled(scale));
        }
        Self { clusters }
    }

    /// The sum's derivative by time, for `t > 0`.
    pub(super) fn differentiated(&self) -> Self {
        let by_time = |cluster: &Cluster| {
            Cluster::new(
                cluster.poles.clone(),
                times_s(&cluster.coefficients, &cluster.poles),
            )
        };
        Self {
            clusters: self.clusters.iter().map(by_time).collect(),
        }
    }

    /// The sum divided by `divisor`.
    pub(super) fn divided_by(&self, divisor: f64) -> Self {
        let scale = TwoDouble::exact(1.0) / TwoDouble::exact(divisor);
        Self {
            clusters: self
                .clusters
                .iter()
                .map(|cluster| cluster.scaled(scale))
                .collect(),
        }
    }

    pub(super) fn negated(&self) -> Self {
        self.divided_by(-1.0)
    }

    pub(super) fn value(&self, t_s: f64) -> f64 {
        self.clusters
            .iter()
            .map(|cluster| cluster.value(t_s).re)
            .sum()
    }

    /// A number that `|f|` does not exceed on `[from, to]`; `to` may be infinite where all poles are stable.
    pub(super) fn bound(&self, from_s: f64, to_s: f64) -> f64 {
        self.clusters
            .iter()
            .map(|cluster| cluster.bound(from_s, to_s))
            .sum()
    }

    /// The largest real part of a pole \[1/s\], `None` for the empty sum.
    pub(super) fn slowest_growth(&self) -> Option<f64> {
        self.clusters
            .iter()
            .map(|cluster| cluster.growth)
            .max_by(f64::total_cmp)
    }
}

/// A sum of exponentials with its derivatives by time.
#[derive(Debug, Clone)]
pub(super) struct Curve {
    /// `f, f', f'' …`, the last only for bounds; all with the same clusters.
    orders: Vec<ExponentialSum>,
}

/// What is known of a curve, its slope and its bend on an interval of time.
#[derive(Debug, Clone, Copy)]
pub(super) struct Enclosure {
    /// `f, f', f''` in the middle.
    middle: [f64; 3],
    /// How far each may be from that elsewhere in the interval.
    change: [f64; 3],
}

impl Curve {
    /// Terms of the expansion that bounds an interval. A curve can start as `t⁴` while each exponential in it is of order
    /// one: only terms beyond the fourth then show how small it is.
    const TERMS: usize = 9;

    pub(super) fn new(f: ExponentialSum) -> Self {
        let mut orders = vec![f];
        for k in 0..Self::TERMS {
            orders.push(orders[k].differentiated());
        }
        Self { orders }
    }

    pub(super) fn f(&self) -> &ExponentialSum {
        &self.orders[0]
    }

    pub(super) fn slope(&self) -> &ExponentialSum {
        &self.orders[1]
    }

    /// Bounds `f`, `f'` and `f''` on an interval.
    ///
    /// Clusters slower than the interval are expanded together in Taylor's series at its middle, so that what cancels
    /// between them does so here. Faster ones are bounded by their size, so that ringing that has died away does not
    /// count over long times.
    pub(super) fn enclosure(&self, from_s: f64, to_s: f64) -> Enclosure {
        let half_s = (to_s - from_s) / 2.0;
        let middle_s = from_s + half_s;
        let (mut middle, mut change) = ([0.0; 3], [0.0; 3]);
        let (mut slow, mut slow_bound) = ([0.0; Self::TERMS], 0.0);
        for (index, cluster) in self.orders[0].clusters.iter().enumerate() {
            let basis = cluster.basis(middle_s);
            let of_order = |n: usize| &self.orders[n].clusters[index];
            let is_slow = cluster.speed() * half_s <= 1.0;
            for n in 0..if is_slow { Self::TERMS } else { 3 } {
                let value = of_order(n).combined(&basis).re;
                if n < 3 {
                    middle[n] += value;
                }
                if is_slow {
                    slow[n] += value;
                } else {
                    change[n] += 2.0 * of_order(n).bound(from_s, to_s);
                }
            }
            if is_slow {
                slow_bound += of_order(Self::TERMS).bound(from_s, to_s);
            }
        }
        for (n, change) in change.iter_mut().enumerate() {
            // Σ_k |f^(n+k)| h^k / k!, the last term with its bound over the interval
            let mut factor = 1.0;
            for (k, derivative) in slow[n + 1..].iter().chain([&slow_bound]).enumerate() {
                factor *= half_s / (k + 1) as f64;
                *change += derivative.abs() * factor;
            }
        }
        Enclosure { middle, change }
    }
}

impl Enclosure {
    /// A number that `f` does not exceed.
    pub(super) fn highest(&self) -> f64 {
        self.middle[0] + self.change[0]
    }

    /// Whether `f` provably never takes the value.
    pub(super) fn never_at(&self, level: f64) -> bool {
        (self.middle[0] - level).abs() > self.change[0]
    }

    /// Whether `f` provably only rises or only falls.
    pub(super) fn is_monotone(&self) -> bool {
        self.middle[1].abs() > self.change[1]
    }

    /// Whether `f` provably bends to one side only, so that its slope is zero at most once.
    pub(super) fn bends_one_way(&self) -> bool {
        self.middle[2].abs() > self.change[2]
    }
}

impl Cluster {
    fn new(poles: Vec<ComplexTwoDouble>, coefficients: Vec<ComplexTwoDouble>) -> Self {
        let rounded_poles: Vec<_> = poles.iter().map(|p| p.rounded()).collect();
        let growth = rounded_poles
            .iter()
            .map(|p| p.re)
            .fold(f64::NEG_INFINITY, f64::max);
        let rounded_coefficients = coefficients.iter().map(|c| c.rounded()).collect();
        Self {
            poles,
            coefficients,
            growth,
            rounded_poles,
            rounded_coefficients,
        }
    }

    fn scaled(&self, factor: TwoDouble) -> Self {
        let coefficients = self.coefficients.iter().map(|&c| c * factor).collect();
        Self::new(self.poles.clone(), coefficients)
    }

    fn value(&self, t_s: f64) -> Complex<f64> {
        self.combined(&self.basis(t_s))
    }

    /// `t^{m-k} exp[p_k t … p_m t]` for each `k`.
    fn basis(&self, t_s: f64) -> Vec<Complex<f64>> {
        let m = self.rounded_poles.len();
        (0..m)
            .map(|k| {
                let points: Vec<_> = self.rounded_poles[k..].iter().map(|p| p * t_s).collect();
                exp_divided_difference(&points) * libm::pow(t_s, (m - 1 - k) as f64)
            })
            .collect()
    }

    fn combined(&self, basis: &[Complex<f64>]) -> Complex<f64> {
        self.rounded_coefficients
            .iter()
            .zip(basis)
            .map(|(c, f)| c * f)
            .sum()
    }

    /// The largest magnitude of a pole \[1/s\].
    fn speed(&self) -> f64 {
        self.rounded_poles
            .iter()
            .map(|p| size(*p))
            .fold(0.0, f64::max)
    }

    /// `|exp[w₀ … w_j]| <= e^{max Re w} / j!`, and `t^j e^{σt}` rises to its only maximum at `t = -j/σ`.
    fn bound(&self, from_s: f64, to_s: f64) -> f64 {
        let mut sum = 0.0;
        let mut factorial = 1.0;
        for (j, coefficient) in self.rounded_coefficients.iter().rev().enumerate() {
            factorial *= j.max(1) as f64;
            let worst_s = if self.growth < 0.0 {
                (-(j as f64) / self.growth).clamp(from_s, to_s)
            } else {
                to_s
            };
            let size = libm::hypot(coefficient.re, coefficient.im);
            sum +=
                size * libm::pow(worst_s, j as f64) * libm::exp(self.growth * worst_s) / factorial;
        }
        sum
    }
}

/// First row of the matrix of `s · g(s)`, from that of `g(s)`.
fn times_s(row: &[ComplexTwoDouble], poles: &[ComplexTwoDouble]) -> Vec<ComplexTwoDouble> {
    (0..row.len())
        .map(|k| {
            let diagonal = row[k] * poles[k];
            if k == 0 {
                diagonal
            } else {
                diagonal + row[k - 1]
            }
        })
        .collect()
}

/// First row of the matrix of `g(s) / (s - pole)`, from that of `g(s)`; `pole` is none of `poles`.
fn divided_by_s_minus(
    row: &[ComplexTwoDouble],
    poles: &[ComplexTwoDouble],
    pole: ComplexTwoDouble,
) -> Vec<ComplexTwoDouble> {
    let mut quotient: Vec<ComplexTwoDouble> = Vec::with_capacity(row.len());
    for (k, &entry) in row.iter().enumerate() {
        let known = if k == 0 {
            entry
        } else {
            entry - quotient[k - 1]
        };
        quotient.push(known / (poles[k] - pole));
    }
    quotient
}

/// Splits poles into clusters: connected by steps of at most [`CLUSTER_FRACTION`] of the larger magnitude.
fn grouped(poles: &[ComplexTwoDouble]) -> Vec<Vec<ComplexTwoDouble>> {
    let mut left = poles.to_vec();
    let mut groups = Vec::new();
    while let Some(seed) = left.pop() {
        let mut group = vec![seed];
        let mut next = 0;
        while next < group.len() {
            let here: ComplexTwoDouble = group[next];
            let near = |pole: &ComplexTwoDouble| {
                let size = here.magnitude().max(pole.magnitude());
                (here - *pole).magnitude() <= CLUSTER_FRACTION * size
            };
            let (joined, apart): (Vec<_>, Vec<_>) = left.into_iter().partition(near);
            group.extend(joined);
            left = apart;
            next += 1;
        }
        groups.push(group);
    }
    groups
}

/// The divided difference of the exponential at `points`, which may coincide; `points` is not empty.
fn exp_divided_difference(points: &[Complex<f64>]) -> Complex<f64> {
    if let [only] = points {
        return exp(*only);
    }
    let n = points.len();
    let centre = points.iter().sum::<Complex<f64>>() / n as f64;
    let radius = points.iter().map(|w| size(w - centre)).fold(0.0, f64::max);
    if radius <= 1.0 {
        return exp(centre) * centred_series(points, centre);
    }
    // the two points furthest apart, so that the difference loses least
    let (mut i, mut j, mut furthest) = (0, 1, 0.0);
    for a in 0..n {
        for b in a + 1..n {
            let distance = size(points[a] - points[b]);
            if distance > furthest {
                (i, j, furthest) = (a, b, distance);
            }
        }
    }
    let without = |left_out: usize| -> Vec<Complex<f64>> {
        (0..n)
            .filter(|&k| k != left_out)
            .map(|k| points[k])
            .collect()
    };
    (exp_divided_difference(&without(i)) - exp_divided_difference(&without(j)))
        / (points[j] - points[i])
}

/// `Σ_j h_j(w - centre) / (n - 1 + j)!`, with `h_j` the complete homogeneous symmetric polynomials.
fn centred_series(points: &[Complex<f64>], centre: Complex<f64>) -> Complex<f64> {
    // Within radius 1 the terms fall below a double's last place before the 24th.
    const TERMS: usize = 24;
    let mut h = [Complex::new(0.0, 0.0); TERMS];
    h[0] = Complex::new(1.0, 0.0);
    for w in points {
        for j in 1..TERMS {
            h[j] += (w - centre) * h[j - 1];
        }
    }
    let mut factorial: f64 = (1..points.len()).map(|k| k as f64).product();
    let mut sum = Complex::new(0.0, 0.0);
    for (j, h_j) in h.iter().enumerate() {
        sum += h_j / factorial;
        factorial *= (points.len() + j) as f64;
    }
    sum
}

fn exp(z: Complex<f64>) -> Complex<f64> {
    let size = libm::exp(z.re);
    let (sin, cos) = libm::sincos(z.im);
    Complex::new(size * cos, size * sin)
}

fn size(z: Complex<f64>) -> f64 {
    libm::hypot(z.re, z.im)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn real(points: &[f64]) -> Vec<Complex<f64>> {
        points.iter().map(|&x| Complex::new(x, 0.0)).collect()
    }

    #[test]
    fn a_divided_difference_of_equal_points_is_a_derivative() {
        // f[x, x, x] = f''(x) / 2
        let d = exp_divided_difference(&real(&[-1.5; 3])).re;
        assert!((d - libm::exp(-1.5) / 2.0).abs() < 1e-16, "{d}");
    }

    #[test]
    fn series_and_recursion_agree_where_they_meet() {
        for spread in [0.999, 1.001] {
            let d = exp_divided_difference(&real(&[-3.0 - spread, -3.0 + spread])).re;
            let exact = libm::exp(-3.0) * libm::sinh(spread) / spread;
            assert!((d - exact).abs() < 1e-16, "{d} {exact}");
        }
    }

    #[test]
    fn a_cluster_equals_its_partial_fractions() {
        // 1/((s+2)(s+2.09)) as one cluster of two
        let poles = [
            ComplexTwoDouble::exact(-2.0, 0.0),
            ComplexTwoDouble::exact(-2.09, 0.0),
        ];
        let sum = ExponentialSum::new(&[1.0], 1.0, &poles, None);
        assert_eq!(sum.clusters.len(), 1);
        for t in [0.0, 0.1, 1.0, 7.0, 40.0, 1000.0] {
            let exact = (libm::exp(-2.0 * t) - libm::exp(-2.09 * t)) / 0.09;
            assert!(
                (sum.value(t) - exact).abs() < 1e-15,
                "t={t}: {} {exact}",
                sum.value(t)
            );
        }
    }

    #[test]
    fn bounds_hold_inside_their_interval() {
        let poles = [
            ComplexTwoDouble::exact(-1.0, 5.0),
            ComplexTwoDouble::exact(-1.0, -5.0),
            ComplexTwoDouble::exact(-3.0, 0.0),
            ComplexTwoDouble::exact(-3.0, 0.0),
        ];
        let curve = Curve::new(ExponentialSum::new(&[1.0, -2.0, 7.0], 1.0, &poles, None));
        for (from, to) in [(0.0, 0.01), (0.0, 0.3), (0.1, 2.0), (1.5, 1.6), (5.0, 50.0)] {
            let bounds = curve.enclosure(from, to);
            for k in 0..=100 {
                let t = from + (to - from) * k as f64 / 100.0;
                for n in 0..3 {
                    let value = curve.orders[n].value(t);
                    assert!(
                        value.abs() <= curve.orders[n].bound(from, to),
                        "order {n} at {t}: {value}"
                    );
                    let moved = (value - bounds.middle[n]).abs();
                    assert!(
                        moved <= bounds.change[n] + 1e-14,
                        "order {n} at {t}: {moved} {bounds:?}"
                    );
                }
            }
        }
    }

    #[test]
    fn a_start_of_fourth_order_is_seen_to_be_small() {
        // 1/((s+1)(s+2)(s+3)(s+4)(s+5)) starts as t⁴/24, from five exponentials of size 1/24 to 1/4
        let poles = [-1.0, -2.0, -3.0, -4.0, -5.0].map(|p| ComplexTwoDouble::exact(p, 0.0));
        let curve = Curve::new(ExponentialSum::new(&[1.0], 1.0, &poles, None));
        let bounds = curve.enclosure(0.01, 0.012);
        assert!(bounds.is_monotone() && bounds.bends_one_way(), "{bounds:?}");
    }
}
