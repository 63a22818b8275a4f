//! # Setup: what a board and its robot are made of

use model_core::effects::active::Effects;
use model_core::plant::robot::Robot;

use super::instants::Instants;
use super::motion_sensors::GyroErrors;
use super::stand::Stand;
use super::wiring::BoardWiring;

/// What a board and its robot are made of.
#[derive(Clone, Copy, Debug)]
pub struct BoardSetup<const N: usize> {
    /// The robot
    pub robot: Robot<N, f64>,
    /// What it has besides
    pub effects: Effects<N, f64>,
    /// Capacitor on the bus, of a supply that takes no current back [F]; none: the battery takes it
    pub bus_capacitor: Option<f64>,
    /// DC-equivalent inductance of a motor [H]
    pub inductance: f64,
    /// Pole pairs of a motor
    pub pole_pairs: u8,
    /// Phase current over code [A]
    pub amps_per_count: f64,
    /// Bus voltage over code [V]
    pub bus_volts_per_count: f64,
    /// How far the converters' zeros lie from the middle, at most [counts]
    pub offset_spread: f64,
    /// σ of every converter [counts]
    pub noise: f64,
    /// How far the hall switches sit from their places, at most [rad, electrical]
    pub hall_spread: f64,
    /// How far from its edge a hall switch is undecided, reading by reading [rad, electrical]
    pub hall_chatter: f64,
    /// When currents are sampled and halls are read
    pub instants: Instants,
    /// Which leads of the motors are soldered where
    pub wirings: [BoardWiring; N],
    /// The gyro; none of a board without one
    pub gyro: Option<GyroErrors>,
    /// There is an encoder at every motor
    pub encoders: bool,
    /// The wheels are off the ground; none where they stand on it
    pub stand: Option<Stand>,
    /// What zeros, placements, rotor angles and noise are drawn with
    pub seed: u64,
}

impl<const N: usize> BoardSetup<N> {
    /// A robot on the board's default scaling: ±10 A and 36 V of full scale, offsets within 12 codes and noise of 1.5.
    pub fn new(robot: Robot<N, f64>, effects: Effects<N, f64>, seed: u64) -> Self {
        Self {
            robot,
            effects,
            bus_capacitor: None,
            inductance: 0.6e-3,
            pole_pairs: 8,
            amps_per_count: 0.0049,
            bus_volts_per_count: 0.00886,
            offset_spread: 12.0,
            noise: 1.5,
            hall_spread: 0.0,
            hall_chatter: 0.0,
            instants: Instants::default(),
            wirings: [BoardWiring::default(); N],
            gyro: None,
            encoders: false,
            stand: None,
            seed,
        }
    }

    /// The same with converters and switches that are as they should be.
    pub fn ideal(self) -> Self {
        Self { offset_spread: 0.0, noise: 0.0, hall_spread: 0.0, hall_chatter: 0.0, ..self }
    }
}
