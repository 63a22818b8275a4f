//! # Phases: three phase currents and voltages ↔ one DC-equivalent motor
//!
//! ```text
//! α = (2a − b − c)/3,  β = (b − c)/√3                Clarke, which keeps amplitudes
//! a = α,  b = (−α + √3·β)/2,  c = (−α − √3·β)/2      and back, with a + b + c = 0
//! d =  cos θ·α + sin θ·β                             Park
//! q = −sin θ·α + cos θ·β
//! P = u_a·i_a + u_b·i_b + u_c·i_c = 3/2·(u_d·i_d + u_q·i_q)
//!
//! i = √3/2·i_q,  u = √3·u_q,  R = 2·R_phase,  L = 2·L_phase     the DC-equivalent motor
//! P = u·i,   τ = K_t·i,   e = K_v·ω_m,   λ = K_v/(√3·p)
//!
//! δ_k = ½ + (u_k − ½·(max u + min u))/U              space vector by min-max
//! max δ − min δ = (max u − min u)/U ≤ √3·|u_αβ|/U    so that √3·|u_αβ| up to U has duties within 0 ..= 1
//! ```
//!
//! | symbol | code | unit | meaning |
//! |---|---|---|---|
//! | a, b, c | `[a, b, c]` | A, V | of the three phases; a current is positive into the motor |
//! | α, β | [`AlphaBeta`] | A, V | the same as a vector that stands still; α along phase a |
//! | d, q | [`DirectQuadrature`] | A, V | the same as a vector that turns with the rotor; d along its flux |
//! | θ | [`Rotation`] | rad | electrical angle of the rotor's flux, from phase a |
//! | i, u | `current`, `voltage` | A, V | DC-equivalent: torque over K_t, and what a DC motor would need for it |
//! | λ | [`flux_linkage`] | V·s | back-EMF of phase a is −ω_e·λ·sin θ |
//! | p | `pole_pairs` | 1 | electrical turns in a turn of the motor |
//! | δ | `duties` | 1 | share of the period in which a leg is at the bus |
//!
//! The motor's numbers are those between two terminals, as a DC motor has them: so a motor driven by field-oriented
//! control and one driven by six steps have the same R, L, K_v and K_t, and the model needs one motor only. Positive i_q
//! makes positive torque.
//!
//! Six steps: of two phases one is driven up and one down, the third waits at mid-voltage. In the middle of a sector the
//! vector is then the one of field-oriented control at i_d = 0; at its ends it is 30° off.
//!
//! Neglects: harmonics of the back-EMF, saliency, a common current of the three phases (there is no wire for it; what
//! the three sensors have in common drops out). Fails when: the duties' span is larger than 1; they are then beyond
//! 0 ..= 1, see [`crate::control::current_loop`] for the limit.
//!
//! How to measure λ: turn the motor at known speed with open terminals; λ is the amplitude between two terminals over
//! √3·ω_e. The sense of the phases: apply a slowly turning vector; the halls must count up.
//!
//! Source: Clarke (1943), Park (1929); DC-equivalent numbers from P = u·i and τ = K_t·i; the min-max rule from
//! Blasko, IEEE Trans. Ind. Appl. 33 (1997).

use crate::number::scalar::Real;
use crate::number::trig::sin_cos_of_code_f32;

const SQRT_3: f64 = 1.732_050_807_568_877_2;

/// A current [A] or voltage [V] vector that stands still.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct AlphaBeta<T = f32> {
    /// α, along phase a
    pub alpha: T,
    /// β, a quarter turn ahead of it
    pub beta: T,
}

/// A current [A] or voltage [V] vector that turns with the rotor.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct DirectQuadrature<T = f32> {
    /// d, along the rotor's flux
    pub d: T,
    /// q, a quarter turn ahead of it; its current makes the torque
    pub q: T,
}

/// Where the rotor's flux points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rotation<T = f32> {
    sin: T,
    cos: T,
}

impl<T: Real> AlphaBeta<T> {
    /// Clarke's vector of three phases, which keeps their amplitude; what they have in common drops out.
    #[inline]
    pub fn clarke([a, b, c]: [T; 3]) -> Self {
        // α = (2a − b − c)/3,  β = (b − c)/√3
        Self { alpha: (a + a - b - c) * T::lit(1.0 / 3.0), beta: (b - c) * T::lit(1.0 / SQRT_3) }
    }

    /// The three phases of the vector, with sum zero.
    #[inline]
    pub fn inverse_clarke(self) -> [T; 3] {
        // a = α,  b = (−α + √3·β)/2,  c = (−α − √3·β)/2
        let (along, across) = (self.alpha * T::lit(-0.5), self.beta * T::lit(0.5 * SQRT_3));
        [self.alpha, along + across, along - across]
    }
}

impl Rotation<f32> {
    /// The rotor at an electrical angle [2⁻¹⁶ turn].
    #[inline]
    pub fn of_code(angle: u16) -> Self {
        let (sin, cos) = sin_cos_of_code_f32(angle);
        Self { sin, cos }
    }
}

impl<T: Real> Rotation<T> {
    /// The rotor at an electrical angle [rad].
    #[inline]
    pub fn of_angle(angle: T) -> Self {
        let (sin, cos) = angle.sin_cos();
        Self { sin, cos }
    }

    /// The rotor turned on by a small angle [rad], its sine and cosine to within δ⁵/120 and δ⁴/24.
    ///
    /// A vector gets shorter by that, by δ⁴/24 of it, and never longer.
    #[inline]
    pub fn ahead(self, angle: T) -> Self {
        // cos δ = 1 − δ²/2 + …,  sin δ = δ − δ³/6 + …
        let square = angle * angle;
        let cos = T::one() - T::lit(0.5) * square;
        let sin = angle - T::lit(1.0 / 6.0) * square * angle;
        // sin(θ + δ) = sin θ·cos δ + cos θ·sin δ,  cos(θ + δ) = cos θ·cos δ − sin θ·sin δ
        Self { sin: self.sin * cos + self.cos * sin, cos: self.cos * cos - self.sin * sin }
    }

    /// Park's vector: the one that stands still, seen from the rotor.
    #[inline]
    pub fn park(self, x: AlphaBeta<T>) -> DirectQuadrature<T> {
        // d = cos θ·α + sin θ·β,  q = −sin θ·α + cos θ·β
        DirectQuadrature { d: self.cos * x.alpha + self.sin * x.beta, q: self.cos * x.beta - self.sin * x.alpha }
    }

    /// The rotor's vector, seen from where the phases stand.
    #[inline]
    pub fn inverse_park(self, x: DirectQuadrature<T>) -> AlphaBeta<T> {
        // α = cos θ·d − sin θ·q,  β = sin θ·d + cos θ·q
        AlphaBeta { alpha: self.cos * x.d - self.sin * x.q, beta: self.sin * x.d + self.cos * x.q }
    }
}

/// DC-equivalent current [A] of a phase amplitude along q [A].
#[inline]
pub fn dc_current<T: Real>(i_q: T) -> T {
    // i = √3/2·i_q
    T::lit(0.5 * SQRT_3) * i_q
}

/// Phase amplitude along q [A] of a DC-equivalent current [A].
#[inline]
pub fn q_current<T: Real>(current: T) -> T {
    // i_q = 2/√3·i
    T::lit(2.0 / SQRT_3) * current
}

/// DC-equivalent voltage [V] of a phase amplitude along q [V].
#[inline]
pub fn dc_voltage<T: Real>(u_q: T) -> T {
    // u = √3·u_q
    T::lit(SQRT_3) * u_q
}

/// Phase amplitude along q [V] of a DC-equivalent voltage [V].
#[inline]
pub fn q_voltage<T: Real>(voltage: T) -> T {
    // u_q = u/√3
    T::lit(1.0 / SQRT_3) * voltage
}

/// DC-equivalent resistance [Ω] or inductance [H] of one phase's: that between two terminals.
#[inline]
pub fn dc_impedance<T: Real>(of_phase: T) -> T {
    // R = 2·R_phase,  L = 2·L_phase
    of_phase + of_phase
}

/// λ, the flux that the rotor links with a phase [V·s], of K_v at the motor's shaft [V·s].
#[inline]
pub fn flux_linkage<T: Real>(emf_constant: T, pole_pairs: u8) -> T {
    // λ = K_v/(√3·p)
    q_voltage(emf_constant) / T::count(u16::from(pole_pairs))
}

/// Duties of three legs [1] for a voltage vector [V]: its three phases, moved together so that they are centred.
///
/// `per_bus` is one over the bus voltage [1/V].
#[inline]
pub fn space_vector<T: Real>(voltage: AlphaBeta<T>, per_bus: T) -> [T; 3] {
    let share = AlphaBeta { alpha: voltage.alpha * per_bus, beta: voltage.beta * per_bus };
    centred_duties(share.inverse_clarke())
}

/// Duties [1] of three shares of the bus with sum zero [1], moved together so that they are centred about ½.
#[inline]
pub fn centred_duties<T: Real>([a, b, c]: [T; 3]) -> [T; 3] {
    let (lower, upper) = if b < a { (b, a) } else { (a, b) };
    let middle = c.max(lower).min(upper);
    // δ_k = ½ + (u_k − ½·(max u + min u))/U;  max u + min u = −(the middle one), as the three have sum zero
    let shift = T::lit(0.5) + T::lit(0.5) * middle;
    [a + shift, b + shift, c + shift]
}

/// Who conducts in a sector of six steps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CommutationStep {
    /// Phase that is driven up (0 a, 1 b, 2 c)
    pub up: Phase,
    /// Phase that is driven down
    pub down: Phase,
    /// Phase that waits at mid-voltage
    pub idle: Phase,
}

/// A phase of the motor.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Phase {
    /// a
    A,
    /// b
    B,
    /// c
    C,
}

impl Phase {
    /// What belongs to this phase, of a, b, c.
    #[inline]
    pub fn of<X>(self, [a, b, c]: [X; 3]) -> X {
        match self {
            Self::A => a,
            Self::B => b,
            Self::C => c,
        }
    }
}

impl CommutationStep {
    /// What is up, down and idle, as phases a, b, c.
    #[inline]
    pub fn phases<X: Copy>(self, up: X, down: X, idle: X) -> [X; 3] {
        [Phase::A, Phase::B, Phase::C].map(|phase| {
            if phase == self.up {
                up
            } else if phase == self.down {
                down
            } else {
                idle
            }
        })
    }
}

/// Who conducts in each of the six sectors so that the torque is positive; sector k is centred on θ = k·60°.
///
/// At θ = 0 the back-EMF of phase b is at +√3/2, that of c at −√3/2 and that of a at 0 of its amplitude.
pub const SIX_STEPS: [CommutationStep; 6] = {
    use Phase::{A, B, C};
    [
        CommutationStep { up: B, down: C, idle: A },
        CommutationStep { up: B, down: A, idle: C },
        CommutationStep { up: C, down: A, idle: B },
        CommutationStep { up: C, down: B, idle: A },
        CommutationStep { up: A, down: B, idle: C },
        CommutationStep { up: A, down: C, idle: B },
    ]
};

#[cfg(test)]
mod tests;
