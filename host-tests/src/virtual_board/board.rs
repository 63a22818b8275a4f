//! # Board: compare counts in, codes out, one period a call
//!
//! A robot and its effects are given as the plant of the core takes them. Each effect goes where it belongs:
//!
//! | seam | here |
//! |---|---|
//! | supply (`supply_sag`) | the battery |
//! | drive (`dead_time`) | the legs of the bridge |
//! | winding (`motor_mismatch`) | K_v and R of that motor's machine; K_t in the plant |
//! | sense (`current_sensor_offset`) | the codes of the phase currents |
//! | shaft (`backlash`) | the plant; windings and halls are on the rotor |
//! | gear, contact, body | the plant |
//!
//! `actuation_delay` is refused: on this board nothing stands between command and bridge, a late command is late on the
//! link. Within a period the wheels' speeds are those of its beginning; the plant then takes one step under the mean
//! currents.
//!
//! A period begins where duties come into force; when it is sampled say the [`Instants`]. A bridge that opens is open
//! before the sample: its enable does not wait for the duties.
//!
//! Neglects: that on the chip each motor's period begins a little after that of the one before, that an enable acts in
//! the turn that decides it, up to a period before the duties, and that the supply's code is a period old.

use firmware::codes::{Codes, MOTORS};
use firmware::exchange::TOPS;
use model_core::control::calibration::AdcCode;
use model_core::control::halls::HallCode;
use model_core::effects::active::{ActiveEffect, Effects};
use model_core::effects::card::Seam;
use model_core::effects::electrical::supply_sag::SupplySag;
use model_core::effects::{Effect, EffectSet, EffectState};
use model_core::geometry::frames::{BodyTwist, Pose};
use model_core::link::sensor_codes::SensorCodes;
use model_core::plant::{Input, Plant, State};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

use super::adc::{AdcChannel, FULL_SCALE};
use super::battery::{Battery, BusCapacitor};
use super::faults::{InjectedFault, OnBoard};
use super::instants::Instants;
pub use super::instants::PERIOD;
use super::machine::{BridgeLegs, RotorFlux};
use super::motion_sensors::MotionSensors;
use super::motor::BoardMotor;
pub use super::setup::BoardSetup;

/// The hall code of the motor that is not there: a legal position at which nothing moves.
const RESTING: HallCode = HallCode(1);

/// What a program writes for a period.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Outputs {
    /// Compare counts of every motor's three phases, of [`TOPS`]
    pub compare: [[u16; 3]; MOTORS],
    /// One bit a motor: its gate driver is enabled
    pub enabled: u8,
}

/// The board with its robot.
#[derive(Debug)]
pub struct VirtualBoard<const N: usize> {
    setup: BoardSetup<N>,
    /// The effects that the plant carries
    plant_effects: Effects<N, f64, OnBoard>,
    plant: Plant<N, f64, OnBoard>,
    state: State<N, f64>,
    /// Speeds of wheels off the ground [rad/s]
    hanging: [f64; N],
    memory: Vec<EffectState<f64>>,
    motors: [BoardMotor; N],
    battery: Battery,
    capacitor: Option<BusCapacitor>,
    bus: f64,
    /// Current drawn from the battery in the last period [A]
    drawn: f64,
    bus_channel: AdcChannel,
    sensors: MotionSensors<N>,
    rng: ChaCha8Rng,
    faults: Vec<InjectedFault>,
}

impl<const N: usize> VirtualBoard<N> {
    /// A board whose robot stands in the origin, every rotor at an angle of its own.
    pub fn new(setup: BoardSetup<N>) -> Self {
        Self::moving(setup, Pose::default(), BodyTwist::default())
    }

    /// A board whose robot is on its way.
    ///
    /// # Panics
    /// With `actuation_delay` among the effects.
    pub fn moving(setup: BoardSetup<N>, pose: Pose<f64>, twist: BodyTwist<f64>) -> Self {
        let mut rng = ChaCha8Rng::seed_from_u64(setup.seed);
        let motors = std::array::from_fn(|j| BoardMotor::new(&setup, j, &mut rng));
        let mut battery = Battery { open_circuit: setup.robot.supply, resistance: 0.0 };
        for sag in setup.effects.at(Seam::Supply) {
            if let Effect::SupplySag(SupplySag { internal_resistance, open_circuit_voltage: open }) = sag.effect {
                battery.resistance = internal_resistance;
                battery.open_circuit = if open > 0.0 { open } else { battery.open_circuit };
            }
        }
        let delayed = setup.effects.iter().any(|active| matches!(active.effect, Effect::ActuationDelay(_)));
        assert!(!delayed, "actuation_delay has no place on the board: send the commands late");
        let mut carried = Effects::none();
        for active in setup.effects.iter().filter(|active| in_plant(active)) {
            let effect = OnBoard::Effect(active.effect);
            carried.put(effect, active.wheel).expect("it was in a set of the same size");
        }
        let plant = Plant::new(setup.robot, carried);
        let state = plant.start(0.0, pose, twist);
        let mut memory = plant.memory().collect::<Vec<_>>();
        plant.restart(&state, &mut memory);
        Self {
            plant_effects: carried,
            plant,
            state,
            hanging: [0.0; N],
            memory,
            motors,
            battery,
            capacitor: setup.bus_capacitor.map(|capacitance| BusCapacitor::charged(capacitance, &battery)),
            bus: battery.bus(0.0),
            drawn: 0.0,
            bus_channel: AdcChannel { step: setup.bus_volts_per_count, offset: 0.0, noise: setup.noise },
            sensors: MotionSensors::new(setup.gyro, setup.encoders, setup.seed),
            rng,
            faults: Vec::new(),
            setup,
        }
    }

    /// One period under these outputs; the codes are those of its instants.
    pub fn period(&mut self, outputs: &Outputs) -> Codes {
        if let Some(capacitor) = &mut self.capacitor {
            capacitor.period(&self.battery, self.drawn, PERIOD);
        }
        self.bus = self.bus_now();
        let speeds = self.rotor_speeds();
        let mut codes = self.resting();
        let Instants { sample, halls } = self.setup.instants;
        for (j, motor) in self.motors.iter_mut().enumerate() {
            let legs = BridgeLegs {
                duties: motor
                    .wiring
                    .windings(outputs.compare[j].map(|count| (f64::from(count) / f64::from(TOPS[j])).min(1.0))),
                bus: self.bus,
                enabled: outputs.enabled >> j & 1 != 0,
            };
            // ω = p·l·ω_w
            let speed = motor.machine.pole_pairs * self.setup.robot.motor.gear_ratio * speeds[j];
            let magnet = RotorFlux { angle: motor.angle, speed };
            motor.period(&legs, magnet, sample);
            motor.angle = magnet.after(PERIOD).angle.rem_euclid(std::f64::consts::TAU);
            codes.halls[j] = motor.hall_code(magnet.after((sample + halls) * PERIOD).angle, &mut self.rng);
            codes.phases[j] = motor.codes(magnet.after(sample * PERIOD).angle, &mut self.rng);
        }
        codes.bus = AdcCode(self.bus_channel.code(self.bus, &mut self.rng));
        self.drawn = self.motors.iter().map(|motor| motor.outcome.bus_current).sum();
        self.move_on();
        self.sensors.turn(speeds, PERIOD);
        self.spoil(&mut codes, outputs.enabled);
        codes
    }

    /// What gyro and encoders say at the end of the last period.
    pub fn sensors(&mut self) -> SensorCodes {
        self.sensors.read(self.state.twist.w, self.setup.robot.motor.gear_ratio)
    }

    /// Robot or wheels, a period on.
    fn move_on(&mut self) {
        let currents = self.currents();
        let Some(stand) = self.setup.stand else {
            self.plant.step(&mut self.state, &mut self.memory, &Input::Current(currents), PERIOD);
            return;
        };
        let motor = self.setup.robot.motor;
        for (j, speed) in self.hanging.iter_mut().enumerate() {
            let blocked =
                self.faults.iter().any(|fault| matches!(fault, InjectedFault::Blocked { motor } if *motor == j));
            // τ = l·K_t·i
            let torque = motor.gear_ratio * motor.torque_constant * currents[j];
            *speed = if blocked { 0.0 } else { stand.speed_after(*speed, torque, PERIOD) };
        }
    }

    /// The codes of a board on which nothing is connected.
    fn resting(&mut self) -> Codes {
        let zero = AdcChannel { step: 1.0, offset: 2048.0, noise: self.setup.noise };
        let rng = &mut self.rng;
        let unconnected: [[AdcCode; 3]; MOTORS] =
            std::array::from_fn(
                |j| {
                    if j < N { [AdcCode(0); 3] } else { [(); 3].map(|()| AdcCode(zero.code(0.0, rng))) }
                },
            );
        Codes { phases: unconnected, bus: AdcCode(0), halls: [RESTING; MOTORS], driver_fault: false }
    }

    /// What faults make of the codes.
    fn spoil(&self, codes: &mut Codes, enabled: u8) {
        for fault in &self.faults {
            match *fault {
                InjectedFault::Short { motor, phase } if enabled >> motor & 1 != 0 => {
                    codes.phases[motor][phase] = AdcCode(FULL_SCALE);
                }
                InjectedFault::Halls { motor, code } => codes.halls[motor] = HallCode(code),
                InjectedFault::DriverLine => codes.driver_fault = true,
                InjectedFault::StuckAmplifier { motor, phase, code } => codes.phases[motor][phase] = AdcCode(code),
                InjectedFault::TurnedAmplifier { motor, phase } => {
                    let turned =
                        2.0 * self.motors[motor].channels[phase].offset - f64::from(codes.phases[motor][phase].0);
                    codes.phases[motor][phase] = AdcCode((turned.round() as u16).min(FULL_SCALE));
                }
                _ => {}
            }
        }
    }

    /// Something goes wrong, from the next period on.
    pub fn inject(&mut self, fault: InjectedFault) {
        if let InjectedFault::Offset { motor, phase, counts } = fault {
            self.motors[motor].channels[phase].offset = counts;
        }
        self.faults.push(fault);
        self.rebuild();
    }

    /// All faults are mended; a converter's zero stays where it was put.
    pub fn clear_faults(&mut self) {
        self.faults.clear();
        self.rebuild();
    }

    /// The plant with the wheels that are blocked now.
    fn rebuild(&mut self) {
        let mut effects = self.plant_effects;
        for fault in &self.faults {
            match *fault {
                InjectedFault::Blocked { motor } => effects.put(OnBoard::BlockedWheel, Some(motor)),
                InjectedFault::Held => effects.put(OnBoard::HeldBody, None),
                _ => continue,
            }
            .expect("room for what is held");
        }
        for (j, motor) in self.motors.iter_mut().enumerate() {
            motor.machine.open_phase = self.faults.iter().find_map(|fault| match *fault {
                InjectedFault::OpenPhase { motor, phase } if motor == j => Some(phase),
                _ => None,
            });
        }
        self.plant = Plant::new(self.setup.robot, effects);
    }

    fn bus_now(&self) -> f64 {
        let held =
            self.faults.iter().rev().find_map(|fault| if let InjectedFault::Bus(u) = fault { Some(*u) } else { None });
        let battery = || self.battery.bus(self.drawn);
        held.unwrap_or_else(|| self.capacitor.map_or_else(battery, |capacitor| capacitor.voltage))
    }

    /// What the board and its robot are made of.
    pub fn setup(&self) -> &BoardSetup<N> {
        &self.setup
    }

    /// Where the robot is.
    pub fn state(&self) -> &State<N, f64> {
        &self.state
    }

    /// Speed of each wheel at its shaft [rad/s].
    pub fn wheel_speeds(&self) -> [f64; N] {
        if self.setup.stand.is_some() {
            return self.hanging;
        }
        // a wheel that rolls turns with the body; the plant keeps the speed of one that slips
        if self.plant_effects.none_at(Seam::Contact) {
            self.setup.robot.wheels.wheel_speeds(self.state.twist)
        } else {
            self.state.wheel_speed
        }
    }

    /// Speed of each rotor, counted at its wheel's shaft [rad/s]: that of its wheel, unless the shaft between them yields.
    fn rotor_speeds(&self) -> [f64; N] {
        let yields =
            |effect: &OnBoard| matches!(effect, OnBoard::Effect(Effect::Backlash(_) | Effect::ShaftElasticity(_)));
        if self.setup.stand.is_none() && self.plant_effects.iter().any(|active| yields(&active.effect)) {
            self.state.rotor_speed
        } else {
            self.wheel_speeds()
        }
    }

    /// Mean DC-equivalent current of each motor over the last period [A].
    pub fn currents(&self) -> [f64; N] {
        std::array::from_fn(|j| self.motors[j].outcome.current)
    }

    /// Electrical angle of each rotor at the end of the last period [rad], 0 to 2π.
    pub fn angles(&self) -> [f64; N] {
        std::array::from_fn(|j| self.motors[j].angle)
    }

    /// Bus voltage over the last period [V].
    pub fn bus(&self) -> f64 {
        self.bus
    }

    /// Mean current drawn from the battery over the last period [A].
    pub fn bus_current(&self) -> f64 {
        self.drawn
    }

    /// How far each motor's switches sit from their places [rad, electrical].
    pub fn hall_errors(&self) -> [[f64; 3]; N] {
        std::array::from_fn(|j| self.motors[j].halls.errors)
    }

    /// Currents of each motor's windings when they were sampled last [A].
    pub fn winding_currents(&self) -> [[f64; 3]; N] {
        std::array::from_fn(|j| self.motors[j].sampled)
    }

    /// Codes of zero current, phase by phase [counts].
    pub fn offsets(&self) -> [[f64; 3]; N] {
        std::array::from_fn(|j| self.motors[j].channels.map(|channel| channel.offset))
    }
}

/// True for an effect that acts where the plant is: all but those of battery and bridge.
fn in_plant(active: &ActiveEffect<Effect<f64>>) -> bool {
    active.effect.card().seams.iter().any(|seam| !matches!(seam, Seam::Supply | Seam::Bridge))
}

#[cfg(test)]
#[path = "board_tests.rs"]
mod tests;

#[cfg(test)]
#[path = "instants_tests.rs"]
mod instants_tests;
