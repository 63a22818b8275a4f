//! # Current loop: one motor, one period, from raw codes to duties
//!
//! ```text
//! e = i_want − i,   u = u_ff + k_p·e + Σ k_i·Δt·e          on q; on d the same with i_want = 0 and u_ff = 0
//! k_i·Δt = R·w·Δt,   k_p = k_i·Δt/(1 − e⁻ˣ),   x = R·Δt/L
//! L → 0: k_p = R·w·Δt        x → 0: k_p = L·w
//!
//! |m_d| ≤ M/2,   |m_q| ≤ √(M² − m_d²),   m = u/U
//! √(M² − m²) ≥ M·(1 − z/2 − c·z²),   z = (m/M)² ≤ ¼,   c = 14 − 8·√3
//! ```
//!
//! | symbol | code | unit | meaning |
//! |---|---|---|---|
//! | i | [`CurrentOutput::current`] | A | DC-equivalent current, positive for positive torque |
//! | u | [`CurrentOutput::voltage`] | V | DC-equivalent voltage, as limited |
//! | u_ff | [`CurrentSetpoint::voltage`] | V | what is known beforehand: the back-EMF l·K_v·ω_w |
//! | U | [`CurrentMeasurement::bus`] | V | bus voltage |
//! | m | `share` | 1 | share of the bus that the span of the three duties takes |
//! | M | `max_duty` | 1 | the largest such share: duties stay within ½ ± M/2 |
//! | w | `bandwidth` | rad/s | the current closes a gap as e^(−w·t) |
//! | Δt | `period` | s | from one turn of the loop to the next |
//! | R, L | `resistance`, `inductance` | Ω, H | DC-equivalent: between two terminals |
//!
//! The gains put the regulator's zero on the winding's pole, exactly so for a voltage held over a period; what is left
//! of the loop is an integrator and the delay until duties act. Where that is a whole period, there is no overshoot up
//! to w = 1/(4·Δt), and the loop is stable up to 1/Δt. All vectors are carried in DC-equivalent numbers, in which d and
//! q have the motor's R and L and the limit of the voltage is the bus itself (see [`crate::control::phases`]).
//!
//! Where the voltage is limited, d comes first, because a current along d makes heat and no torque; q gets what is left
//! of the circle, by a bound that lies inside of it by less than 0.02 % of M and needs no root. An integral waits while
//! its error asks for still more voltage than there is, and works while it asks for less: after a saturation the
//! regulator goes on from where it was.
//!
//! The current along d is held at zero even where q gets a voltage alone: only then is the motor the DC motor of
//! [`crate::plant::winding`] at speed. Left to itself it is i_d = ω_e·L·i/R, and the motor has R + (ω_e·L)²/R for R.
//! For the same reason the voltage is turned on to where the rotor will be in the middle of the period that the duties
//! are for.
//!
//! Neglects: the voltage ω_e·L·i by which d and q disturb each other, left to the integrals; harmonics; dead time of the
//! bridge. Fails when: a feedforward that holds R·i too is given in a closed loop, where it comes on top of the
//! integral: an overshoot of up to R/(L·w) of the step then fades with L/R.
//!
//! How to measure L: see [`crate::plant::winding`]. M: one less the share of a period that the converter needs to
//! sample, both sides of the centre counted.
//!
//! Numbers: finite in, finite out, for currents and voltages up to 10³⁰ and a bus that is held above zero.
//!
//! Source: pole and zero from the step of [`crate::plant::winding`]; conditional integration as in Åström and Hägglund,
//! PID Controllers (1995), section 3.5.

use crate::control::calibration::AdcCode;
use crate::control::phases::{self, AlphaBeta, CommutationStep, DirectQuadrature, Rotation, SIX_STEPS};
use crate::number::scalar::Real;

const SQRT_3: f64 = 1.732_050_807_568_877_2;

/// What does not change from turn to turn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CurrentLoop<T = f32> {
    /// DC-equivalent current a count of 2a − b − c [A]
    amps_along: T,
    /// DC-equivalent current a count of b − c, or of the difference of two terminals [A]
    amps_across: T,
    /// k_p [V/A]
    proportional: T,
    /// k_i·Δt [V/A]
    integral: T,
    /// M [1]
    max_duty: T,
    /// M/2 [1]
    half_duty: T,
    /// 1/(2·M), the circle's curvature [1]
    bend: T,
    /// c/M³ [1]
    bend_more: T,
}

/// What the loop remembers: its integrals, DC-equivalent.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CurrentMemory<T = f32> {
    /// Along d [V]
    pub d: T,
    /// Along q, or of the conducting pair [V]
    pub q: T,
}

/// What the loop sees.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CurrentMeasurement<T = f32> {
    /// What the converter read of phases a, b, c
    pub codes: [AdcCode; 3],
    /// The codes of no current [counts]
    pub offsets: [T; 3],
    /// By how much the rotor will be ahead of where it was when the currents were sampled, in the middle of the period that the duties are for [rad]: ω_e times the
    /// time from the sample to there. Up to half a radian, and not looked at by six steps
    pub ahead: T,
    /// U, bus voltage, above zero [V]
    pub bus: T,
    /// 1/U, the same for all motors [1/V]
    pub per_bus: T,
}

/// What is wanted of the loop.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CurrentSetpoint<T = f32> {
    /// DC-equivalent current [A]; not looked at in an open loop
    pub current: T,
    /// DC-equivalent voltage [V]: in a closed loop what to add (the back-EMF), in an open one all of it
    pub voltage: T,
    /// True to regulate the current, false to apply the voltage as it is; along d the current is held at zero either way
    pub closed: bool,
}

/// What the loop decides.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CurrentOutput<T = f32> {
    /// Share of the period in which each leg is at the bus [1]
    pub duties: [T; 3],
    /// DC-equivalent current as measured [A]
    pub current: T,
    /// DC-equivalent voltage as limited [V]
    pub voltage: T,
}

impl<T: Real> CurrentLoop<T> {
    /// The loop of a motor with a DC-equivalent resistance [Ω] and inductance [H], a current sensor [A a count], a
    /// bandwidth [rad/s], a period [s] and the largest share of the bus [1].
    pub fn new(resistance: T, inductance: T, amps_per_count: T, bandwidth: T, period: T, max_duty: T) -> Self {
        // k_i·Δt = R·w·Δt
        let integral = resistance * bandwidth * period;
        let drop = resistance * period;
        // k_p = k_i·Δt/(1 − e⁻ˣ),  x = R·Δt/L
        let proportional = if drop < T::lit(1e-3) * inductance {
            // L·w·(1 + x/2 + …), where 1 − e⁻ˣ has lost its digits
            bandwidth * (inductance + T::lit(0.5) * drop)
        } else if drop < T::lit(100.0) * inductance {
            integral / (T::one() - (-(drop / inductance)).exp())
        } else {
            // e⁻¹⁰⁰ is nothing in either precision; asked as a product, because L may be 0
            integral
        };
        Self {
            // √3/2·(2a − b − c)/3,  √3/2·(b − c)/√3
            amps_along: amps_per_count * T::lit(0.5 / SQRT_3),
            amps_across: amps_per_count * T::lit(0.5),
            proportional,
            integral,
            max_duty,
            half_duty: T::lit(0.5) * max_duty,
            bend: T::lit(0.5) / max_duty,
            bend_more: T::lit(14.0 - 8.0 * SQRT_3) / (max_duty * max_duty * max_duty),
        }
    }

    /// One period of field-oriented control; the rotor as it was when the currents were sampled.
    #[inline]
    pub fn field_oriented(
        &self,
        memory: &mut CurrentMemory<T>,
        measured: &CurrentMeasurement<T>,
        rotor: Rotation<T>,
        setpoint: &CurrentSetpoint<T>,
    ) -> CurrentOutput<T> {
        let [a, b, c] = self.above_offset(measured);
        // i_α = A·√3/2·(2a − b − c)/3,  i_β = A·√3/2·(b − c)/√3
        let still = AlphaBeta { alpha: (a + a - b - c) * self.amps_along, beta: (b - c) * self.amps_across };
        let current = rotor.park(still);

        let d = self.regulate(&mut memory.d, -current.d, T::zero(), measured.per_bus, self.half_duty);
        // |m_q| ≤ M·(1 − z/2 − c·z²),  z = (m_d/M)²
        let square = d * d;
        let limit = self.max_duty - square * (self.bend + square * self.bend_more);
        let q = self.along_torque(&mut memory.q, current.q, measured, setpoint, limit);

        let AlphaBeta { alpha, beta } = rotor.ahead(measured.ahead).inverse_park(DirectQuadrature { d, q });
        // phases a, b, c of a DC-equivalent vector: m_α/√3, (−m_α/√3 ± m_β)/2
        let a = alpha * T::lit(1.0 / SQRT_3);
        let (along, across) = (a * T::lit(-0.5), beta * T::lit(0.5));
        let duties = phases::centred_duties([a, along + across, along - across]);
        CurrentOutput { duties, current: current.q, voltage: q * measured.bus }
    }

    /// One period of six steps; without a legal sector no voltage is applied.
    #[inline]
    pub fn six_step(
        &self,
        memory: &mut CurrentMemory<T>,
        measured: &CurrentMeasurement<T>,
        sector: u8,
        setpoint: &CurrentSetpoint<T>,
    ) -> CurrentOutput<T> {
        // an arm each, so that every phase is at a place known beforehand: a third fewer instructions than a table
        match sector {
            0 => self.conduct(SIX_STEPS[0], memory, measured, setpoint),
            1 => self.conduct(SIX_STEPS[1], memory, measured, setpoint),
            2 => self.conduct(SIX_STEPS[2], memory, measured, setpoint),
            3 => self.conduct(SIX_STEPS[3], memory, measured, setpoint),
            4 => self.conduct(SIX_STEPS[4], memory, measured, setpoint),
            5 => self.conduct(SIX_STEPS[5], memory, measured, setpoint),
            _ => {
                *memory = CurrentMemory::default();
                CurrentOutput { duties: [T::lit(0.5); 3], current: T::zero(), voltage: T::zero() }
            }
        }
    }

    /// One period of six steps, in one of these.
    #[inline(always)]
    fn conduct(
        &self,
        step: CommutationStep,
        memory: &mut CurrentMemory<T>,
        measured: &CurrentMeasurement<T>,
        setpoint: &CurrentSetpoint<T>,
    ) -> CurrentOutput<T> {
        let up = step.up.of(measured.codes).counts::<T>() - step.up.of(measured.offsets);
        let down = step.down.of(measured.codes).counts::<T>() - step.down.of(measured.offsets);
        // i = (i_up − i_down)/2
        let current = (up - down) * self.amps_across;
        let share = self.along_torque(&mut memory.q, current, measured, setpoint, self.max_duty);
        // δ = ½ ± m/2
        let (half, away) = (T::lit(0.5), T::lit(0.5) * share);
        CurrentOutput { duties: step.phases(half + away, half - away, half), current, voltage: share * measured.bus }
    }

    /// The codes less what they are at no current [counts].
    #[inline]
    fn above_offset(&self, measured: &CurrentMeasurement<T>) -> [T; 3] {
        let ([a, b, c], [a0, b0, c0]) = (measured.codes, measured.offsets);
        [a.counts::<T>() - a0, b.counts::<T>() - b0, c.counts::<T>() - c0]
    }

    /// The share of the bus [1] that makes the torque: regulated, or the voltage alone.
    #[inline]
    fn along_torque(
        &self,
        integral: &mut T,
        current: T,
        measured: &CurrentMeasurement<T>,
        setpoint: &CurrentSetpoint<T>,
        limit: T,
    ) -> T {
        if setpoint.closed {
            return self.regulate(integral, setpoint.current - current, setpoint.voltage, measured.per_bus, limit);
        }
        *integral = T::zero();
        // m = u/U, |m| ≤ M
        (setpoint.voltage * measured.per_bus).clamp(-limit, limit)
    }

    /// The share of the bus [1] that closes an error [A], and the integral's [V] next value.
    #[inline]
    fn regulate(&self, integral: &mut T, error: T, forward: T, per_bus: T, limit: T) -> T {
        // u = u_ff + k_p·e + Σ k_i·Δt·e,  m = u/U
        let demanded = (self.proportional * error + forward + *integral) * per_bus;
        let next = *integral + self.integral * error;
        if demanded.abs() <= limit {
            *integral = next;
            return demanded;
        }
        // a saturated integral works only where its error asks for less
        if demanded < T::zero() {
            if error > T::zero() {
                *integral = next;
            }
            -limit
        } else {
            if error < T::zero() {
                *integral = next;
            }
            limit
        }
    }
}

#[cfg(test)]
mod tests;
