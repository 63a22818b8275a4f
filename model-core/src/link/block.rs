//! # Block: the parameters that a robot accepts
//!
//! Everything that makes the same firmware drive one robot or another: its geometry, motors, body, limits, gains, what
//! its codes mean, and the effects that it should undo. The host writes it from a robot file, the robot keeps it, and
//! both hold it to the same bounds with the same function, [`Block::check`].
//!
//! ```text
//! magic "OMNI" · version u16 · length u16 · wheels u8 · mode u8 · feedforward u8 · commutation u8 · pole pairs u8
//! · wheels × (α [rad], d [m], r [m]) f32
//! · l, R, K_v, K_t, L, M, J, B_v, B_vn, B_ω, C_v, C_vn, C_ω, supply f32
//! · limits: current, speed, acceleration along v and vn, about the vertical axis, lowest and highest bus voltage f32
//! · feedback of wheel speeds, of wheel angles, bandwidth of the currents f32
//! · current of one count (below zero where the code falls with the current), bus voltage of one count f32
//! · linear range of the current amplifiers, continuous current of a motor, its thermal time constant f32
//! · effects u8 × (code u8 · wheel u8, 0xff where on all · its card's parameters f32)
//! · how motors are wired, where any was commissioned, and what gyro and encoders are worth, where there are any
//! · CRC-32 of all before (ISO HDLC)
//! ```
//!
//! All little endian and SI; voltages, currents, R and L are DC-equivalent. What stands behind `length` is not looked at.

use crc::{CRC_32_ISO_HDLC, Crc};

use crate::control::wiring::MotorWiring;
use crate::effects::active::MOST_UNDONE;
use crate::effects::card::MAX_PARAMS;
use crate::geometry::kinematics::{Wheel, Wheels};
use crate::link::bytes::{Reader, Writer};
use crate::link::hello::Commutation;
use crate::link::sensor_codes::SensorScales;
use crate::plant::robot::{Friction, Robot};
use crate::plant::winding::Motor;

mod bounds;
mod effects;
mod error;
mod limits;
mod sensors;
mod wirings;

pub use bounds::{BoundedField, MAX_TRIP_COUNTS, TRIP_OVER_LIMIT, USABLE_COUNTS, trip_current};
pub use effects::{BlockEffect, BlockEffects, EFFECT_CODES, EffectCode};
pub use error::{BlockError, BlockErrorKind};
pub use limits::Limits;

/// Version of the form that this program writes and the newest that it reads.
pub const VERSION: u16 = 3;

/// Room that is enough for every block.
pub const MAX_BYTES: usize = 1280;

const MAGIC: [u8; 4] = *b"OMNI";
const HEADER: usize = 13;
const CHECK: Crc<u32> = Crc::<u32>::new(&CRC_32_ISO_HDLC);

/// The longest block that there can be: four wheels, all effects with all parameters, all motors' wirings.
const LONGEST: usize = HEADER
    + 4 * (4 * 3 + bounds::SCALARS.len())
    + 1
    + MOST_UNDONE * (2 + 4 * MAX_PARAMS)
    + (1 + 4 * wirings::BYTES + SensorScales::BYTES)
    + 4;
const _: () = assert!(LONGEST <= MAX_BYTES, "every block fits");

/// How the wheels are driven.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[repr(u8)]
pub enum ControlMode {
    /// By the model's voltages alone.
    Voltage,
    /// By currents that a loop holds.
    #[default]
    Current,
}

/// The parameters of a robot with `N` wheels.
#[derive(Clone, Copy, Debug)]
pub struct Block<const N: usize> {
    /// The plain model.
    pub robot: Robot<N, f32>,
    /// L, DC-equivalent [H]
    pub inductance: f32,
    /// How the wheels are driven.
    pub mode: ControlMode,
    /// True: the model goes ahead of the feedback; false: feedback alone, to compare with.
    pub feedforward: bool,
    /// How the motors' phases are driven.
    pub commutation: Commutation,
    /// p [1]
    pub pole_pairs: u8,
    /// What it must not do.
    pub limits: Limits,
    /// Current for an error of a wheel's speed [A·s/rad]
    pub feedback: f32,
    /// Current for an error of a wheel's angle [A/rad]
    pub feedback_integral: f32,
    /// Bandwidth of the currents' loop [rad/s]
    pub bandwidth: f32,
    /// Phase current of one count; below zero where the code falls while the current into the motor rises [A]
    pub amps_per_count: f32,
    /// Bus voltage of one count [V]
    pub bus_volts_per_count: f32,
    /// Phase current either way up to which the amplifiers are straight [A]
    pub linear_range: f32,
    /// I_c, current that a motor bears for ever ([`crate::control::thermal`]) [A]
    pub continuous_current: f32,
    /// τ, thermal time constant of a motor's winding [s]
    pub heating_time: f32,
    /// Effects that the robot should undo.
    pub effects: BlockEffects,
    /// How the motors are wired; none of one that was never commissioned.
    pub wiring: [Option<MotorWiring>; N],
    /// What counts of gyro and encoders are worth; zeros of a robot without them.
    pub sensors: SensorScales,
}

impl<const N: usize> Default for Block<N> {
    /// A block of zeros, to be filled; it is not sound.
    fn default() -> Self {
        Self {
            robot: Robot {
                wheels: Wheels::new([Wheel::default(); N]),
                motor: Motor::default(),
                mass: 0.0,
                inertia: 0.0,
                friction: Friction::default(),
                supply: 0.0,
            },
            inductance: 0.0,
            mode: ControlMode::default(),
            feedforward: true,
            commutation: Commutation::default(),
            pole_pairs: 0,
            limits: Limits::default(),
            feedback: 0.0,
            feedback_integral: 0.0,
            bandwidth: 0.0,
            amps_per_count: 0.0,
            bus_volts_per_count: 0.0,
            linear_range: 0.0,
            continuous_current: 0.0,
            heating_time: 0.0,
            effects: BlockEffects::default(),
            wiring: [None; N],
            sensors: SensorScales::default(),
        }
    }
}

/// The parameters of a robot.
// There is one of them, and it lies in fixed memory.
#[allow(clippy::large_enum_variant)]
#[derive(Clone, Copy, Debug)]
pub enum Parameters {
    /// With three wheels.
    Three(Block<3>),
    /// With four wheels.
    Four(Block<4>),
}

impl<const N: usize> Block<N> {
    /// Every scalar, in the order of the form and of its bounds.
    fn scalars(&mut self) -> [&mut f32; bounds::SCALARS.len()] {
        let Robot { motor, mass, inertia, friction, supply, .. } = &mut self.robot;
        let [viscous_v, viscous_vn, viscous_w] = &mut friction.viscous;
        let [coulomb_v, coulomb_vn, coulomb_w] = &mut friction.coulomb;
        let Limits { current, speed, acceleration: [along_v, along_vn, about], under_voltage, over_voltage } =
            &mut self.limits;
        [
            &mut motor.gear_ratio,
            &mut motor.resistance,
            &mut motor.emf_constant,
            &mut motor.torque_constant,
            &mut self.inductance,
            mass,
            inertia,
            viscous_v,
            viscous_vn,
            viscous_w,
            coulomb_v,
            coulomb_vn,
            coulomb_w,
            supply,
            current,
            speed,
            along_v,
            along_vn,
            about,
            under_voltage,
            over_voltage,
            &mut self.feedback,
            &mut self.feedback_integral,
            &mut self.bandwidth,
            &mut self.amps_per_count,
            &mut self.bus_volts_per_count,
            &mut self.linear_range,
            &mut self.continuous_current,
            &mut self.heating_time,
        ]
    }

    /// Holds every number to its bounds.
    ///
    /// # Errors
    /// [`BlockError`] names the first number that is not within them.
    pub fn check(&self) -> Result<(), BlockError> {
        let mut copy = *self;
        for wheel in self.robot.wheels.wheels() {
            for (field, x) in bounds::WHEEL.iter().zip([wheel.drive_angle, wheel.distance, wheel.radius]) {
                field.check(x)?;
            }
        }
        for (field, x) in bounds::SCALARS.iter().zip(copy.scalars()) {
            field.check(*x)?;
        }
        bounds::POLE_PAIRS.check(f32::from(self.pole_pairs))?;
        if !self.robot.wheels.is_regular() {
            return Err(BlockError::because(BlockErrorKind::Wheels, "drive_angle_deg"));
        }
        bounds::check_limits(self.robot.supply, &self.limits, self.amps_per_count, self.bus_volts_per_count)?;
        bounds::check_currents(self.limits.current, self.amps_per_count, self.linear_range, self.continuous_current)?;
        self.effects.check(N)?;
        sensors::check(&self.sensors)?;
        wirings::check(&self.wiring)
    }

    /// Writes the block into `out` and returns how many bytes it has.
    ///
    /// # Errors
    /// [`BlockError`] as [`Block::check`]; a block that is not sound is not written.
    pub fn encode(&self, out: &mut [u8; MAX_BYTES]) -> Result<usize, BlockError> {
        self.check()?;
        let mut copy = *self;
        let effects = self.effects.iter().map(|effect| 2 + 4 * effect.params().len()).sum::<usize>();
        let length = HEADER
            + 4 * (3 * N + bounds::SCALARS.len())
            + 1
            + effects
            + sensors::tail_length(&self.wiring, &self.sensors)
            + 4;
        let mut writer = Writer::new(out);
        writer.bytes(&MAGIC);
        writer.u16(VERSION);
        writer.u16(length as u16);
        writer.bytes(&[N as u8, self.mode as u8, u8::from(self.feedforward)]);
        writer.bytes(&[self.commutation.code(), self.pole_pairs]);
        for wheel in self.robot.wheels.wheels() {
            [wheel.drive_angle, wheel.distance, wheel.radius].into_iter().for_each(|x| writer.f32(x));
        }
        copy.scalars().into_iter().for_each(|x| writer.f32(*x));
        writer.u8(self.effects.len() as u8);
        for effect in self.effects.iter() {
            writer.bytes(&[effect.code(), effect.wheel().unwrap_or(effects::EVERY_WHEEL)]);
            effect.params().iter().for_each(|x| writer.f32(*x));
        }
        sensors::write_tail(&self.wiring, &self.sensors, &mut writer);
        writer.u32(CHECK.checksum(writer.written()));
        writer.len().filter(|written| *written == length).ok_or(BlockError::because(BlockErrorKind::Length, "length"))
    }

    /// Reads what follows the wheels' number; all but the bounds.
    fn read(reader: &mut Reader) -> Result<Self, BlockError> {
        let mut block = Self::default();
        let short = BlockError::because(BlockErrorKind::Length, "length");
        let [mode, feedforward, commutation, pole_pairs] = reader.array().ok_or(short)?;
        block.mode = match mode {
            0 => ControlMode::Voltage,
            1 => ControlMode::Current,
            _ => {
                return Err(BlockError { value: f32::from(mode), ..BlockError::because(BlockErrorKind::Mode, "mode") });
            }
        };
        block.feedforward = match feedforward {
            0 => false,
            1 => true,
            _ => {
                return Err(BlockError {
                    value: f32::from(feedforward),
                    ..BlockError::because(BlockErrorKind::Mode, "feedforward")
                });
            }
        };
        let unknown =
            BlockError { value: f32::from(commutation), ..BlockError::because(BlockErrorKind::Mode, "commutation") };
        block.commutation = Commutation::from_code(commutation).ok_or(unknown)?;
        block.pole_pairs = pole_pairs;
        let mut wheels = [Wheel::default(); N];
        for wheel in &mut wheels {
            let Wheel { drive_angle, distance, radius } = wheel;
            // before anything is computed with them
            for (field, x) in bounds::WHEEL.iter().zip([drive_angle, distance, radius]) {
                *x = reader.f32().ok_or(short)?;
                field.check(*x)?;
            }
        }
        block.robot.wheels = Wheels::new(wheels);
        for x in block.scalars() {
            *x = reader.f32().ok_or(short)?;
        }
        for _ in 0..reader.u8().ok_or(short)? {
            let effect = BlockEffect::read(reader, short)?;
            block.effects.push(effect)?;
        }
        (block.wiring, block.sensors) = sensors::read_tail(reader, short)?;
        block.check()?;
        Ok(block)
    }
}

impl Parameters {
    /// Writes the block into `out` and returns how many bytes it has.
    ///
    /// # Errors
    /// [`BlockError`] as [`Block::check`]; a block that is not sound is not written.
    pub fn encode(&self, out: &mut [u8; MAX_BYTES]) -> Result<usize, BlockError> {
        match self {
            Parameters::Three(block) => block.encode(out),
            Parameters::Four(block) => block.encode(out),
        }
    }

    /// Reads a block; bytes that follow it are not looked at.
    ///
    /// # Errors
    /// [`BlockError`] says what is wrong with it.
    pub fn decode(bytes: &[u8]) -> Result<Parameters, BlockError> {
        let short = BlockError::because(BlockErrorKind::Length, "length");
        let mut reader = Reader::new(bytes);
        if reader.array::<4>() != Some(MAGIC) {
            return Err(BlockError::because(BlockErrorKind::Magic, "magic"));
        }
        let version = reader.u16().ok_or(short)?;
        if version != VERSION {
            let reason = if version > VERSION { BlockErrorKind::Newer } else { BlockErrorKind::Older };
            return Err(BlockError { value: f32::from(version), ..BlockError::because(reason, "version") });
        }
        let length = usize::from(reader.u16().ok_or(short)?);
        let possible = (HEADER + 4..=MAX_BYTES).contains(&length);
        let block = bytes.get(..length).filter(|_| possible).ok_or(short)?;
        let (before, check) = block.split_last_chunk::<4>().ok_or(short)?;
        if CHECK.checksum(before).to_le_bytes() != *check {
            return Err(BlockError::because(BlockErrorKind::Checksum, "checksum"));
        }
        let mut reader = Reader::new(before.get(8..).ok_or(short)?);
        match reader.u8().ok_or(short)? {
            3 => Block::read(&mut reader).map(Parameters::Three),
            4 => Block::read(&mut reader).map(Parameters::Four),
            other => {
                Err(BlockError { value: f32::from(other), ..BlockError::because(BlockErrorKind::Wheels, "wheels") })
            }
        }
    }
}

/// The checksum that a block carries, as a [`Hello`](crate::link::hello::Hello) names it; `None` where there is no
/// block.
pub fn checksum(bytes: &[u8]) -> Option<u32> {
    let length = bytes.strip_prefix(&MAGIC)?.get(2..)?.first_chunk::<2>().map(|x| u16::from_le_bytes(*x))?;
    bytes.get(..usize::from(length))?.last_chunk::<4>().map(|x| u32::from_le_bytes(*x))
}

#[cfg(test)]
mod tests;
