//! # Between two sign changes the robot is linear
//!
//! With u held and the signs fixed, `dx/dt = A·x + c`. A is symmetric in the metric of the masses (m·A is symmetric), so
//! it has three real rates λᵢ and the solution is written down at once, with no matrix to exponentiate:
//!
//! ```text
//! x = S·z,  zᵢ(t) = zᵢ(0) + pᵢ·φ₁(λᵢ, t),  pᵢ = λᵢ·zᵢ(0) + (S⁻¹·c)ᵢ,  φ₁(λ, t) = (e^{λt} − 1)/λ
//! ```
//!
//! That form also tells when something happens. Any reading f = w·x + f₀ has `df/dt = Σ (wᵀS)ᵢ·pᵢ·e^{λᵢt}`, a sum of
//! three real exponentials. Divide such a sum by its first term, differentiate, and one term is gone; so the zeros of the
//! shorter sum bracket those of the longer one (Rolle). Every turn of f is found that way, and between two turns f crosses
//! a level at most once: no crossing can hide between two samples.

use nalgebra::{Matrix3, SymmetricEigen, Vector3};

/// The exact solution of `dx/dt = A·x + c` from a given x(0).
#[derive(Clone, Debug)]
pub struct Flow {
    /// S: columns are the modes, in units of x.
    modes: Matrix3<f64>,
    /// λ [1/s]
    rates: Vector3<f64>,
    /// z(0)
    start: Vector3<f64>,
    /// p = dz/dt at t = 0
    slope: Vector3<f64>,
}

/// φ₁(λ, t) = ∫₀ᵗ e^{λs} ds [s].
fn phi1(rate: f64, t: f64) -> f64 {
    if rate == 0.0 { t } else { (rate * t).exp_m1() / rate }
}

/// φ₂(λ, t) = ∫₀ᵗ φ₁(λ, s) ds [s²].
fn phi2(rate: f64, t: f64) -> f64 {
    let y = rate * t;
    if y.abs() > 0.5 {
        // φ₂ = (φ₁ − t)/λ
        return (phi1(rate, t) - t) / rate;
    }
    // φ₂ = t²·Σ yⁿ/(n + 2)!, without the difference of two near numbers
    let (mut sum, mut term) = (0.0, 0.5);
    for n in 0..16 {
        sum += term;
        term *= y / f64::from(n + 3);
    }
    t * t * sum
}

impl Flow {
    /// A [1/s …], the masses M, M, J that make m·A symmetric, the constant c [m/s², m/s², rad/s²], and x(0).
    pub fn new(a: &Matrix3<f64>, inertia: &Vector3<f64>, c: &Vector3<f64>, x0: &Vector3<f64>) -> Self {
        let root = Matrix3::from_diagonal(&inertia.map(f64::sqrt));
        let root_inv = Matrix3::from_diagonal(&inertia.map(|m| m.sqrt().recip()));
        // m^½·A·m^−½ = Q·Λ·Qᵀ,  S = m^−½·Q,  S⁻¹ = Qᵀ·m^½
        let symmetric = root * a * root_inv;
        let skew = (symmetric - symmetric.transpose()).amax();
        assert!(skew <= 1e-12 * symmetric.amax(), "m·A must be symmetric; {skew:e} 1/s is not");
        let eigen = SymmetricEigen::new(symmetric);
        let inverse = eigen.eigenvectors.transpose() * root;
        let start = inverse * x0;
        let rates = eigen.eigenvalues;
        Self { modes: root_inv * eigen.eigenvectors, rates, start, slope: rates.component_mul(&start) + inverse * c }
    }

    /// x(t) [m/s, m/s, rad/s].
    pub fn at(&self, t: f64) -> Vector3<f64> {
        // z(t) = z(0) + p·φ₁(λ, t)
        self.modes * (self.start + self.slope.component_mul(&self.rates.map(|rate| phi1(rate, t))))
    }

    /// ∫₀ᵗ x ds [m, m, rad], in body axes.
    pub fn integral(&self, t: f64) -> Vector3<f64> {
        // ∫z = z(0)·t + p·φ₂(λ, t)
        self.modes * (self.start * t + self.slope.component_mul(&self.rates.map(|rate| phi2(rate, t))))
    }

    /// A bound on |xₖ| over 0 … t: each mode runs one way, so its ends bound it.
    pub fn bound(&self, axis: usize, t: f64) -> f64 {
        (0..3)
            .map(|i| {
                let end = self.start[i] + self.slope[i] * phi1(self.rates[i], t);
                self.modes[(axis, i)].abs() * self.start[i].abs().max(end.abs())
            })
            .sum()
    }

    /// The fastest rate |λ| [1/s].
    pub fn fastest(&self) -> f64 {
        self.rates.amax()
    }

    /// When w·x + f₀ first rises through zero within 0 … `until` [s]; rises smaller than `slack` are rounding.
    pub fn first_rise(&self, w: &Vector3<f64>, f0: f64, until: f64, slack: f64) -> Option<f64> {
        let f = |t: f64| w.dot(&self.at(t)) + f0;
        // df/dt = Σ (wᵀS)ᵢ·pᵢ·e^{λᵢt}
        let weight = self.modes.transpose() * w;
        let slopes = (0..3).map(|i| (self.rates[i], weight[i] * self.slope[i])).collect();
        let mut from = 0.0;
        for to in zeros(slopes, until).into_iter().chain([until]) {
            if f(to) > slack {
                return Some(if f(from) < 0.0 { bisect(f, from, to) } else { from });
            }
            from = to;
        }
        None
    }
}

/// All sign changes of Σ c·e^{μt} within 0 … `until`, ascending; the terms are (μ [1/s], c).
pub fn zeros(mut terms: Vec<(f64, f64)>, until: f64) -> Vec<f64> {
    terms.retain(|&(_, c)| c != 0.0);
    if terms.len() < 2 {
        return Vec::new();
    }
    // The slowest term is divided out, so that the others decay and nothing overflows.
    terms.sort_by(|a, b| b.0.total_cmp(&a.0));
    let slowest = terms[0].0;
    let shifted: Vec<_> = terms.iter().map(|&(rate, c)| (rate - slowest, c)).collect();
    let g = |t: f64| shifted.iter().map(|&(rate, c)| c * (rate * t).exp()).sum::<f64>();
    // dg/dt has one term fewer
    let turns = zeros(shifted[1..].iter().map(|&(rate, c)| (rate, rate * c)).collect(), until);
    let mut found = Vec::new();
    let mut from = 0.0;
    for to in turns.into_iter().chain([until]) {
        if g(from) * g(to) < 0.0 {
            found.push(bisect(g, from, to));
        }
        from = to;
    }
    found
}

/// The sign change of f within `from` … `to`, to the last bit that a halving can tell; f has moved on at the answer.
fn bisect(f: impl Fn(f64) -> f64, mut from: f64, mut to: f64) -> f64 {
    let before = f(from) > 0.0;
    loop {
        let middle = 0.5 * (from + to);
        if middle <= from || middle >= to {
            return to;
        }
        if (f(middle) > 0.0) == before { from = middle } else { to = middle }
    }
}
