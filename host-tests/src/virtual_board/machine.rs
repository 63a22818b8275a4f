//! # Machine: three windings in a star, turned by a magnet
//!
//! ```text
//! L·di/dt = v − R·i − j·ω·λ·e^{jθ}         i, v: space vectors in stator axes, their length that of a phase
//! v = ⅔·(v_a + v_b·e^{j120°} + v_c·e^{j240°}),  v_x = d_x·U − V_l·sat(i_x/i₀)
//! i(t) = v/R − E·e^{jωt} + (i(0) − v/R + E)·e^{−t·R/L},   E = j·ω·λ·e^{jθ(0)}/(R + j·ω·L)
//! i ← ½·(i − i*·e^{j240°·x})     phase x is open: no current along its axis, and the rest as before
//! ī_q = Im mean(i·e^{−jθ}),  DC-equivalent ī = √3/2·ī_q,  I_bus = Σ d_x·mean(i_x)
//! ```
//!
//! | symbol | code | unit | meaning |
//! |---|---|---|---|
//! | R | `resistance` | Ω | of one phase: half of the DC-equivalent one |
//! | L | `inductance` | H | of one phase: half of the DC-equivalent one |
//! | λ | `flux` | V·s | flux linkage of the magnet with a phase: K_v/(√3·p) |
//! | p | `pole_pairs` | 1 | electrical over mechanical angle |
//! | θ, ω | `angle`, `speed` | rad, rad/s | electrical angle of the magnet from the axis of phase a, and its speed |
//! | V_l, i₀ | [`LegLoss`] | V, A | what dead time takes from a leg, and the ripple around whose zero it fades |
//! | d_x, U | `duties`, `bus` | 1, V | duties of the legs, bus voltage |
//!
//! The star point floats: only the space vector of the legs' voltages matters, and the phase currents sum to zero.
//! Duties, bus voltage and speed are held over a period, and the solution is then exact, its means too; with dead time
//! a period is cut into pieces over which the loss is held.
//!
//! While the bridge is open the current is zero: the diodes carry it against the whole bus, and it is gone in a
//! fraction of a period; its last charge, some ten microseconds' worth, is not accounted for.
//!
//! Neglects: ripple, saturation, cogging, saliency, iron losses, unequal phases. Fails when: the back-EMF between two
//! phases (K_v·ω_m) exceeds the bus while the bridge is open: the diodes would brake.
//!
//! Source: the circuit itself, solved in closed form; nothing here is shared with what runs on the robot.

use std::f64::consts::{PI, TAU};

use num_complex::Complex;

/// A space vector or a phasor.
pub type Vector = Complex<f64>;

/// What dead time takes from a leg: V_l·sat(i_x/i₀).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LegLoss {
    /// V_l [V]
    pub voltage: f64,
    /// i₀ of a phase current [A]
    pub smoothing_current: f64,
}

impl LegLoss {
    /// The loss of each leg whose mean over a turn of the rotor is a DC-equivalent loss `voltage·sat(i/smoothing)` [V,
    /// A]: the same height at large currents and the same slope at zero; between them sinusoidal currents round the
    /// corner.
    pub fn dc_equivalent(voltage: f64, smoothing: f64) -> Self {
        // a square wave of height V_l has a fundamental of 4/π·V_l, and u = √3·u_q
        let leg = voltage * PI / (4.0 * 3.0_f64.sqrt());
        // in the slope u_q = V_l/i₀·i_q, so u/i = 2·V_l/i₀
        Self {
            voltage: leg,
            smoothing_current: if voltage > 0.0 { 2.0 * leg * smoothing / voltage } else { smoothing },
        }
    }
}

/// One motor's windings and magnet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Machine {
    /// R of one phase [Ω]
    pub resistance: f64,
    /// L of one phase [H]
    pub inductance: f64,
    /// λ [V·s]
    pub flux: f64,
    /// p [1]
    pub pole_pairs: f64,
    /// What the bridge takes.
    pub loss: Option<LegLoss>,
    /// A phase (0 a, 1 b, 2 c) that is not connected.
    pub open_phase: Option<usize>,
}

/// What the bridge does over a period.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BridgeLegs {
    /// Duty of each leg, 0 to 1
    pub duties: [f64; 3],
    /// Bus voltage [V]
    pub bus: f64,
    /// False: all switches are open.
    pub enabled: bool,
}

/// Where the magnet is when a period begins.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RotorFlux {
    /// Electrical angle [rad]
    pub angle: f64,
    /// Electrical speed [rad/s]
    pub speed: f64,
}

impl RotorFlux {
    /// Where it is `time` [s] later.
    pub fn after(self, time: f64) -> Self {
        Self { angle: self.angle + self.speed * time, ..self }
    }
}

/// What came of a period.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PeriodResult {
    /// Mean DC-equivalent current: torque over K_t [A]
    pub current: f64,
    /// Mean current drawn from the bus [A]
    pub bus_current: f64,
}

/// Mean over a piece.
struct ConstantPiece {
    /// of i [A]
    current: Vector,
    /// of i·e^{−jθ} [A]
    turning: Vector,
}

impl Machine {
    /// A machine that is, seen from outside, the DC motor of these numbers: R [Ω], L [H] and K_v [V·s] at its shaft.
    pub fn dc_equivalent(resistance: f64, inductance: f64, emf_constant: f64, pole_pairs: u8) -> Self {
        let p = f64::from(pole_pairs);
        Self {
            resistance: 0.5 * resistance,
            inductance: 0.5 * inductance,
            flux: emf_constant / (3.0_f64.sqrt() * p),
            pole_pairs: p,
            loss: None,
            open_phase: None,
        }
    }

    /// Takes the current [A] through a period of `dt` [s].
    pub fn period(&self, current: &mut Vector, legs: &BridgeLegs, magnet: RotorFlux, dt: f64) -> PeriodResult {
        if !legs.enabled {
            *current = Vector::default();
            return PeriodResult::default();
        }
        let pieces = self.pieces(dt);
        let share = 1.0 / f64::from(pieces);
        let mut outcome = PeriodResult::default();
        for k in 0..pieces {
            let begins = magnet.after(dt * share * f64::from(k));
            let piece = self.piece(current, self.voltage(legs, *current), begins, dt * share);
            // ī = √3/2·ī_q
            outcome.current += share * 0.5 * 3.0_f64.sqrt() * piece.turning.im;
            // I_bus = Σ d_x·ī_x
            let drawn: f64 = phases(piece.current).iter().zip(legs.duties).map(|(i, d)| d * i).sum();
            outcome.bus_current += share * drawn;
        }
        outcome
    }

    /// How many pieces a period is cut into.
    fn pieces(&self, dt: f64) -> u32 {
        // a loss held over a piece of h changes the current by V_l/i₀·h/L of itself: kept below an eighth
        self.loss.map_or(1, |loss| {
            let slope = loss.voltage / loss.smoothing_current;
            (8.0 * slope * dt / self.inductance).ceil().clamp(16.0, 1000.0) as u32
        })
    }

    /// Space vector of the legs' voltages [V].
    fn voltage(&self, legs: &BridgeLegs, current: Vector) -> Vector {
        let flowing = phases(current);
        let leg = |x: usize| {
            // v_x = d_x·U − V_l·sat(i_x/i₀)
            let lost = self.loss.map_or(0.0, |l| l.voltage * (flowing[x] / l.smoothing_current).clamp(-1.0, 1.0));
            Vector::from_polar(1.0, TAU / 3.0 * x as f64) * (legs.duties[x] * legs.bus - lost)
        };
        // v = ⅔·(v_a + v_b·e^{j120°} + v_c·e^{j240°})
        (leg(0) + leg(1) + leg(2)) * (2.0 / 3.0)
    }

    /// The exact solution over a piece of `dt` [s] with the voltage [V] held.
    fn piece(&self, current: &mut Vector, voltage: Vector, magnet: RotorFlux, dt: f64) -> ConstantPiece {
        let (r, l, w) = (self.resistance, self.inductance, magnet.speed);
        let rotor = Vector::from_polar(1.0, magnet.angle);
        let settled = voltage / r;
        // E = j·ω·λ·e^{jθ(0)}/(R + j·ω·L)
        let induced = Vector::new(0.0, w * self.flux) * rotor / Vector::new(r, w * l);
        let fading = *current - settled + induced;
        let (turn, fade) = (Vector::new(0.0, w * dt), Vector::new(-dt * r / l, 0.0));
        // i(t) = v/R − E·e^{jωt} + (i(0) − v/R + E)·e^{−t·R/L}
        *current = settled - induced * turn.exp() + fading * fade.exp();
        let free = ConstantPiece {
            current: settled - induced * mean_exp(turn) + fading * mean_exp(fade),
            turning: (settled * mean_exp(-turn) - induced + fading * mean_exp(fade - turn)) * rotor.conj(),
        };
        let Some(open) = self.open_phase else { return free };
        // the open terminal's voltage lies along the phase's axis: across it nothing changes
        let mirror = Vector::from_polar(-1.0, 2.0 * TAU / 3.0 * open as f64);
        // i ← ½·(i − i*·e^{j240°·x})
        *current = (*current + mirror * current.conj()) * 0.5;
        // mean(i*·e^{−jθ})
        let mirrored = settled.conj() * mean_exp(-turn) - induced.conj() * mean_exp(-2.0 * turn)
            + fading.conj() * mean_exp(fade - turn);
        ConstantPiece {
            current: (free.current + mirror * free.current.conj()) * 0.5,
            turning: (free.turning + mirror * mirrored * rotor.conj()) * 0.5,
        }
    }
}

/// Phase currents of a space vector [A].
pub fn phases(current: Vector) -> [f64; 3] {
    // i_x = Re(i·e^{−j120°·x})
    std::array::from_fn(|x| (current * Vector::from_polar(1.0, -TAU / 3.0 * x as f64)).re)
}

/// Mean of e^{z·s} over s in 0..1: (e^z − 1)/z.
fn mean_exp(z: Vector) -> Vector {
    if z.norm() > 0.5 {
        return (z.exp() - 1.0) / z;
    }
    // 1 + z/2·(1 + z/3·(1 + …)); at |z| = 0.5 the rest after 16 is below 2⁻⁵³
    (2..=16).rev().fold(Vector::new(1.0, 0.0), |sum, k| Vector::new(1.0, 0.0) + z * sum / f64::from(k))
}

#[cfg(test)]
#[path = "machine_tests.rs"]
mod tests;
