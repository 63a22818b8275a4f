//! # Motor controller: one motor's turn, once a period
//!
//! The halls are followed whether the bridge is closed or not, of a motor that was commissioned by the places of its edges.
//! While the speed is not known the motor commutates in six steps, by the middle of its sector; once the halls tell where
//! the rotor is between two edges, field-oriented.
//!
//! ```text
//! θ = θ_halls − ω_e·ε                   where the currents were sampled
//! δ = ω_e·(t_duties − t_sample + ½)     from there to the middle of the period that the duties are for
//! ū = Σ u(k − 2)/n                      between two samples the voltage of the turn before the last is on the motor
//! ```
//!
//! The instants are those of [`crate::registers::timing`]. Fails when: δ is more than half a radian, at 6,667 rad/s
//! electrical (5 m/s of the paper's robot), where the series that turns the voltage ahead ends.

use model_core::control::calibration::AdcCode;
use model_core::control::current_loop::{CurrentMeasurement, CurrentMemory, CurrentSetpoint};
use model_core::control::hall_tracker::{HallEdges, HallTracker};
use model_core::control::halls::{HallCode, HallDecoder, HallFault};
use model_core::control::phases::Rotation;

use crate::codes::PERIODS_PER_TICK;
use crate::registers::timing;
use crate::winding_config::WindingConfig;

/// A sector that no rotor is in: the current loop then applies no voltage.
const NO_SECTOR: u8 = 6;

/// Duties that put no voltage on a motor [1].
pub const NO_VOLTAGE: [f32; 3] = [0.5; 3];

/// What is measured at a motor.
#[derive(Clone, Copy, Debug)]
pub struct MotorMeasurement {
    /// The three phases
    pub codes: [AdcCode; 3],
    /// What they say without current [counts]
    pub offsets: [f32; 3],
    /// Supply [V]
    pub bus: f32,
    /// One over it [1/V]
    pub per_bus: f32,
}

/// One motor's memory.
#[derive(Clone, Copy, Debug, Default)]
pub struct MotorController {
    halls: Option<HallDecoder>,
    /// The same by the places of the edges, where they are known
    tracker: Option<HallTracker>,
    memory: CurrentMemory<f32>,
    /// Electrical angle at which the currents were sampled [2⁻¹⁶ turn]
    angle: u16,
    current: f32,
    /// The voltage decided last, which is on the motor from the next sample on [V]
    decided: f32,
    /// The one before it, which is on the motor now [V]
    applied: f32,
    /// Its sum since the last motion turn [V]
    sum: f32,
}

impl MotorController {
    /// Follows the halls.
    ///
    /// # Errors
    /// [`HallFault`] says what is wrong with the code; the rotor is then taken to be where it was.
    #[inline]
    pub fn update_halls(&mut self, code: HallCode) -> Result<(), HallFault> {
        match &mut self.halls {
            Some(halls) => halls.update(code)?,
            None => self.halls = Some(HallDecoder::new(code)?),
        }
        Ok(())
    }

    /// Follows the rotor between edges whose places are known.
    #[inline]
    pub fn track(&mut self, edges: &HallEdges) {
        if let Some(halls) = &self.halls {
            self.tracker.get_or_insert_default().update(halls, edges);
        }
    }

    /// Counts the voltage that was on the motor between the last sample and this one.
    #[inline]
    pub fn accumulate_voltage(&mut self) {
        // ū = Σ u(k − 2)/n
        self.sum += self.applied;
        self.applied = self.decided;
    }

    /// The bridge is open from now on.
    #[inline]
    pub fn bridge_opened(&mut self) {
        self.memory = CurrentMemory::default();
        (self.decided, self.applied) = (0.0, 0.0);
    }

    /// Duties of the next period [1]; those of no voltage where the bridge is to be open.
    #[inline]
    pub fn tick(
        &mut self,
        config: &WindingConfig,
        measured: &MotorMeasurement,
        setpoint: &CurrentSetpoint,
        closed: bool,
    ) -> [f32; 3] {
        let sector = self.sector(config.six_step);
        let measurement = CurrentMeasurement {
            codes: measured.codes,
            offsets: measured.offsets,
            // δ = ω_e·(t_duties − t_sample + ½)
            ahead: self.halls.as_ref().map_or(0.0, HallDecoder::ahead::<f32>) * timing::SAMPLE_TO_ACTUATION,
            bus: measured.bus,
            per_bus: measured.per_bus,
        };
        let output = match sector {
            Some(sector) => config.current_loop.six_step(&mut self.memory, &measurement, sector, setpoint),
            None => {
                let rotor = Rotation::of_code(self.angle);
                config.current_loop.field_oriented(&mut self.memory, &measurement, rotor, setpoint)
            }
        };
        self.current = output.current;
        if closed {
            self.decided = output.voltage;
            return output.duties;
        }
        self.bridge_opened();
        NO_VOLTAGE
    }

    /// The sector to commutate by, where the angle between two edges is not known or not wanted; sets the angle.
    #[inline]
    fn sector(&mut self, six_step: bool) -> Option<u8> {
        let Some(halls) = &self.halls else { return Some(NO_SECTOR) };
        if halls.is_speed_known() && !six_step {
            // θ = θ_halls − ω_e·ε
            self.angle = match &self.tracker {
                Some(tracker) => tracker.angle_code_before(halls, timing::HALLS_READ_PARTS),
                None => halls.angle_code_before(timing::HALLS_READ_PARTS),
            };
            return None;
        }
        // the middle of the sector
        self.angle = (u32::from(halls.sector()) * 65_536 / 6) as u16;
        Some(halls.sector())
    }

    /// The rotor, once a legal code was seen.
    #[inline]
    pub fn halls(&self) -> Option<&HallDecoder> {
        self.halls.as_ref()
    }

    /// Electrical angle that the currents were turned by [2⁻¹⁶ turn].
    #[inline]
    pub fn angle(&self) -> u16 {
        self.angle
    }

    /// DC-equivalent current measured last [A].
    #[inline]
    pub fn current(&self) -> f32 {
        self.current
    }

    /// Mean DC-equivalent voltage since this was last asked, a motion turn ago [V].
    #[inline]
    pub fn mean_voltage(&mut self) -> f32 {
        core::mem::take(&mut self.sum) * (1.0 / PERIODS_PER_TICK as f32)
    }
}
