//! One joint under PID control, linear, continuous and without gravity: its loops as transfer functions, and their step
//! responses by partial fractions.
//!
//! The joint is `J dω/dt + b ω = torque`, so the plant is `1/(Js + b)` to the velocity and `1/(s(Js + b))` to the
//! position. The controller `C = Kp + Ki/s + Kd s` is ideal: no filter on the derivative, no limit, no sampling.
//!
//! Source: Åström & Murray, *Feedback Systems* (2008), sec. 8.2 (transfer functions), 10.1 (PID).

use nalgebra::Complex;

/// Gains of a PID controller whose output is a torque \[N m\].
///
/// Units are those of a position loop; in a velocity loop each gains a factor s, since the error is in rad/s.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PidGains {
    /// Proportional gain \[N m/rad\].
    pub kp: f64,
    /// Integral gain \[N m/(rad s)\].
    pub ki: f64,
    /// Derivative gain \[N m s/rad\].
    pub kd: f64,
}

/// One revolute joint with viscous damping.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct JointPlant {
    /// Moment of inertia `J` about the joint \[kg m²\].
    pub inertia_kg_m2: f64,
    /// Viscous damping `b` \[N m s/rad\].
    pub damping_n_m_s: f64,
}

/// What the derivative term differentiates.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum DerivativeOn {
    /// The error: a step of the reference kicks.
    Error,
    /// The measurement: the reference does not pass through it, which takes `Kd s` out of the numerator.
    Measurement,
}

/// A joint with its controller.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PidLoop {
    /// The joint.
    pub plant: JointPlant,
    /// The controller.
    pub gains: PidGains,
}

impl PidLoop {
    /// From reference to position \[rad/rad\]: `(Kd s² + Kp s + Ki) / (J s³ + (b + Kd) s² + Kp s + Ki)`.
    pub fn position_closed_loop(&self, derivative: DerivativeOn) -> TransferFunction {
        TransferFunction::new(&self.controller(derivative), &self.position_denominator())
    }

    /// From reference to velocity \[(rad/s)/(rad/s)\]: `(Kd s² + Kp s + Ki) / ((J + Kd) s² + (b + Kp) s + Ki)`.
    ///
    /// With the derivative on the error the response jumps to `Kd/(J + Kd)` at once. Without `Kd` this is the PI loop.
    pub fn velocity_closed_loop(&self, derivative: DerivativeOn) -> TransferFunction {
        let (PidGains { kp, ki, kd }, plant) = (self.gains, self.plant);
        let denominator = [plant.inertia_kg_m2 + kd, plant.damping_n_m_s + kp, ki];
        TransferFunction::new(&self.controller(derivative), &denominator)
    }

    /// From a disturbing torque at the joint to position \[rad/(N m)\], in the position loop:
    /// `s / (J s³ + (b + Kd) s² + Kp s + Ki)`. Returns to zero if `Ki > 0`.
    pub fn disturbance_to_position(&self) -> TransferFunction {
        TransferFunction::new(&[1.0, 0.0], &self.position_denominator())
    }

    /// `s C(s)`, without `Kd` where the reference does not pass through the derivative.
    fn controller(&self, derivative: DerivativeOn) -> [f64; 3] {
        let PidGains { kp, ki, kd } = self.gains;
        match derivative {
            DerivativeOn::Error => [kd, kp, ki],
            DerivativeOn::Measurement => [0.0, kp, ki],
        }
    }

    fn position_denominator(&self) -> [f64; 4] {
        let (PidGains { kp, ki, kd }, plant) = (self.gains, self.plant);
        [plant.inertia_kg_m2, plant.damping_n_m_s + kd, kp, ki]
    }
}

/// A proper ratio of polynomials of degree three at most, without common factors of `s`.
#[derive(Debug, Clone, PartialEq)]
pub struct TransferFunction {
    /// In descending powers of `s`.
    numerator: Vec<f64>,
    /// In descending powers of `s`; the leading coefficient is not zero.
    denominator: Vec<f64>,
    poles: Vec<Complex<f64>>,
}

impl TransferFunction {
    /// `numerator / denominator`, both in descending powers of `s`, less common factors of `s`.
    fn new(numerator: &[f64], denominator: &[f64]) -> Self {
        let without_leading_zeros = |descending: &[f64]| -> Vec<f64> {
            descending
                .iter()
                .copied()
                .skip_while(|&a| a == 0.0)
                .collect()
        };
        let mut numerator = without_leading_zeros(numerator);
        let mut denominator = without_leading_zeros(denominator);
        while numerator.last() == Some(&0.0) && denominator.last() == Some(&0.0) {
            numerator.pop();
            denominator.pop();
        }
        let poles = roots(&denominator);
        Self {
            numerator,
            denominator,
            poles,
        }
    }

    /// Poles \[1/s\] with multiplicity; a pair is exactly conjugate.
    ///
    /// Exact to a few last places if they are well separated; two whose distance is a fraction `g` of their size lose `1/g` of that.
    pub fn poles(&self) -> &[Complex<f64>] {
        &self.poles
    }

    /// The value at `s = 0`; `None` with a pole there. It is the steady state of a unit step only if stable.
    pub fn dc_gain(&self) -> Option<f64> {
        let [above, below] =
            [&self.numerator, &self.denominator].map(|p| p.last().copied().unwrap_or(0.0));
        (below != 0.0).then(|| above / below)
    }

    /// The response to a unit step from rest; `None` if a pole is zero or two coincide, for which simple fractions do not suffice.
    pub fn step_response(&self) -> Option<StepResponse> {
        let constant = self.dc_gain()?;
        let leading = self.denominator[0];
        let fraction = |i: usize| {
            let pole = self.poles[i];
            let others = self.poles.iter().enumerate().filter(|(j, _)| *j != i);
            // the product, not the slope of the denominator: it does not cancel where poles are near
            let slope: Complex<f64> = others.map(|(_, other)| pole - other).product();
            value_and_slope(&self.numerator, pole).0 / (pole * slope * leading)
        };
        let fractions: Vec<_> = (0..self.poles.len())
            .map(|i| (self.poles[i], fraction(i)))
            .collect();
        let finite = fractions
            .iter()
            .all(|(_, c)| c.re.is_finite() && c.im.is_finite());
        finite.then_some(StepResponse {
            constant,
            fractions,
        })
    }
}

/// The response to a unit step, `y(t) = constant + Σ c e^{pt}`.
#[derive(Debug, Clone, PartialEq)]
pub struct StepResponse {
    constant: f64,
    /// Pole \[1/s\] and coefficient.
    fractions: Vec<(Complex<f64>, Complex<f64>)>,
}

impl StepResponse {
    /// The value at `t_s >= 0`; at zero, that just after the step.
    pub fn at(&self, t_s: f64) -> f64 {
        let of_pole = |(pole, c): &(Complex<f64>, Complex<f64>)| {
            let (sin, cos) = libm::sincos(pole.im * t_s);
            libm::exp(pole.re * t_s) * (c.re * cos - c.im * sin)
        };
        self.constant + self.fractions.iter().map(of_pole).sum::<f64>()
    }

    /// How far [`Self::at`] may be off while no fraction grows: as poles meet, fractions become large and cancel, and the
    /// poles themselves lose as many digits again.
    pub fn round_off(&self) -> f64 {
        let size: f64 = self
            .fractions
            .iter()
            .map(|(_, c)| libm::hypot(c.re, c.im))
            .sum();
        16.0 * f64::EPSILON * (1.0 + size) * (1.0 + size)
    }
}

/// Roots of a polynomial of degree one to three in descending powers; none of a constant.
fn roots(descending: &[f64]) -> Vec<Complex<f64>> {
    let mut roots = match *descending {
        [a, b] => vec![Complex::new(-b / a, 0.0)],
        [a, b, c] => roots_of_quadratic(a, b, c).to_vec(),
        [a, b, c, d] => {
            let real = real_root(&[a, b, c, d], d);
            // divided from the end at which the terms of the root are larger: from the other, its rounding would swallow two small roots
            let [b, c] = if (a * real * real * real).abs() > d.abs() {
                let constant = -d / real;
                [(constant - c) / real, constant]
            } else {
                let linear = b + a * real;
                [linear, c + linear * real]
            };
            let [first, second] = roots_of_quadratic(a, b, c);
            vec![Complex::new(real, 0.0), first, second]
        }
        _ => Vec::new(),
    };
    for root in &mut roots {
        for _ in 0..2 {
            let (value, slope) = value_and_slope(descending, *root);
            let step = value / slope;
            // a double root has no slope
            if step.re.is_finite() && step.im.is_finite() {
                *root -= step;
            }
        }
    }
    roots
}

/// A root of a cubic by bisection, down to neighbouring doubles: a cubic has opposite signs far out.
fn real_root(descending: &[f64; 4], constant: f64) -> f64 {
    if constant == 0.0 {
        return 0.0;
    }
    let value = |x: f64| descending.iter().fold(0.0, |value, a| value * x + a);
    let largest = descending.iter().fold(0.0_f64, |most, a| most.max(a.abs()));
    // Cauchy's bound on the size of roots
    let bound = 1.0 + largest / descending[0].abs();
    let rises = descending[0] > 0.0;
    // the sign of the constant gives that of a root, and this end of the search is zero
    let (mut near, mut far) = (
        0.0,
        if (constant > 0.0) == rises {
            -bound
        } else {
            bound
        },
    );
    loop {
        let middle = 0.5 * (near + far);
        // no number between them is left
        if middle <= near.min(far) || middle >= near.max(far) {
            return middle;
        }
        if (value(middle) > 0.0) == (constant > 0.0) {
            near = middle;
        } else {
            far = middle;
        }
    }
}

/// Roots of `a s² + b s + c`, without the difference that would cancel.
fn roots_of_quadratic(a: f64, b: f64, c: f64) -> [Complex<f64>; 2] {
    let discriminant = b * b - 4.0 * a * c;
    if discriminant < 0.0 {
        let pair = Complex::new(-b / (2.0 * a), libm::sqrt(-discriminant) / (2.0 * a));
        return [pair, pair.conj()];
    }
    let q = -0.5 * (b + libm::copysign(libm::sqrt(discriminant), b));
    let second = if q == 0.0 { 0.0 } else { c / q };
    [q / a, second].map(|root| Complex::new(root, 0.0))
}

/// Value and slope of a polynomial at `s`, by Horner's rule.
fn value_and_slope(descending: &[f64], s: Complex<f64>) -> (Complex<f64>, Complex<f64>) {
    let zero = Complex::new(0.0, 0.0);
    descending.iter().fold((zero, zero), |(value, slope), &a| {
        (value * s + a, slope * s + value)
    })
}
