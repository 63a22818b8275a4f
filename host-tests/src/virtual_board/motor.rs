//! # Motor: windings, converters and switches of one motor, with its leads where they are soldered

use model_core::control::calibration::AdcCode;
use model_core::control::halls::HallCode;
use model_core::effects::Effect;
use rand::RngExt;
use rand_chacha::ChaCha8Rng;

use super::adc::AdcChannel;
use super::halls::HallSwitches;
use super::instants::PERIOD;
use super::machine::{BridgeLegs, LegLoss, Machine, PeriodResult, RotorFlux, Vector, phases};
use super::setup::BoardSetup;
use super::wiring::BoardWiring;

/// A motor with its converters and switches.
#[derive(Clone, Copy, Debug)]
pub struct BoardMotor {
    pub machine: Machine,
    pub channels: [AdcChannel; 3],
    pub halls: HallSwitches,
    /// How far from its edge a switch is undecided [rad, electrical]
    hall_chatter: f64,
    /// o of `current_sensor_offset` [A, DC-equivalent]
    sensor_offset: f64,
    /// Which of its leads is soldered where
    pub wiring: BoardWiring,
    /// Space vector of the phase currents [A]
    pub current: Vector,
    /// Phase currents when they were sampled last [A]
    pub sampled: [f64; 3],
    /// Electrical angle [rad]
    pub angle: f64,
    pub outcome: PeriodResult,
}

impl BoardMotor {
    /// Motor `j` with its mismatch, dead time and whatever is drawn.
    pub fn new<const N: usize>(setup: &BoardSetup<N>, j: usize, rng: &mut ChaCha8Rng) -> Self {
        let motor = setup.robot.motor;
        let (mut k, mut rho, mut loss, mut sensor_offset) = (1.0, 1.0, None, 0.0);
        for active in setup.effects.iter().filter(|active| active.on(j)) {
            match active.effect {
                Effect::MotorMismatch(odd) => (k, rho) = (odd.torque_constant_ratio, odd.resistance_ratio),
                Effect::DeadTime(d) => loss = Some(LegLoss::dc_equivalent(d.voltage_loss, d.smoothing_current)),
                Effect::CurrentSensorOffset(sensor) => sensor_offset = sensor.offset,
                _ => {}
            }
        }
        let mut machine =
            Machine::dc_equivalent(rho * motor.resistance, setup.inductance, k * motor.emf_constant, setup.pole_pairs);
        machine.loss = loss;
        let mut within = |most: f64| most * rng.random_range(-1.0..=1.0);
        let channels = [(); 3].map(|()| AdcChannel {
            step: setup.amps_per_count,
            offset: 2048.0 + within(setup.offset_spread),
            noise: setup.noise,
        });
        let halls = HallSwitches { errors: [(); 3].map(|()| within(setup.hall_spread)) };
        let angle = within(std::f64::consts::PI).rem_euclid(std::f64::consts::TAU);
        let (current, outcome) = (Vector::default(), PeriodResult::default());
        let wiring = setup.wirings[j];
        let hall_chatter = setup.hall_chatter;
        Self {
            machine,
            channels,
            halls,
            hall_chatter,
            sensor_offset,
            wiring,
            current,
            sampled: [0.0; 3],
            angle,
            outcome,
        }
    }

    /// What its hall lines read at an electrical angle [rad]: within the chatter of an edge now this, now that.
    pub fn hall_code(&self, angle: f64, rng: &mut ChaCha8Rng) -> HallCode {
        let off = if self.hall_chatter > 0.0 { self.hall_chatter * rng.random_range(-1.0..=1.0) } else { 0.0 };
        HallCode(self.wiring.lines(self.halls.code(angle + off)))
    }

    /// A period whose currents are sampled when a `sample` of it is over [1].
    pub fn period(&mut self, legs: &BridgeLegs, magnet: RotorFlux, sample: f64) {
        if !legs.enabled {
            self.current = Vector::default();
        }
        let before = self.part(sample, legs, magnet);
        self.sampled = phases(self.current);
        let after = self.part(1.0 - sample, legs, magnet.after(sample * PERIOD));
        let mean = |before: f64, after: f64| sample * before + (1.0 - sample) * after;
        self.outcome = PeriodResult {
            current: mean(before.current, after.current),
            bus_current: mean(before.bus_current, after.bus_current),
        };
    }

    /// A share of a period [1]; one of no length leaves all as it is.
    fn part(&mut self, share: f64, legs: &BridgeLegs, magnet: RotorFlux) -> PeriodResult {
        if share > 0.0 {
            self.machine.period(&mut self.current, legs, magnet, share * PERIOD)
        } else {
            PeriodResult::default()
        }
    }

    /// Codes of the phase currents, sampled while the rotor is at an electrical angle [rad].
    pub fn codes(&self, angle: f64, rng: &mut ChaCha8Rng) -> [AdcCode; 3] {
        // the effect speaks of the DC-equivalent current: what reads o too much there turns with the rotor, i_q =
        // 2/√3·o
        let turning = Vector::new(0.0, 2.0 / 3.0_f64.sqrt() * self.sensor_offset) * Vector::from_polar(1.0, angle);
        let wrong = phases(turning);
        let flowing = std::array::from_fn(|x| self.sampled[x] + wrong[x]);
        let measured = self.wiring.measured(flowing);
        std::array::from_fn(|x| AdcCode(self.channels[x].code(measured[x], rng)))
    }
}
