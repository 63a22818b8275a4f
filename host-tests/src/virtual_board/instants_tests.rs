//! The firmware's turn of one motor that is held at 5,000 rad/s electrical, on a board with the instants of the chip and on
//! boards that are half a period wrong.

use super::super::machine::{Vector, phases};
use super::*;
use firmware::codes::PERIODS_PER_TICK;
use firmware::motor_controller::{MotorController, MotorMeasurement};
use firmware::registers::timing;
use firmware::winding_config::WindingConfig;
use model_core::control::current_loop::{CurrentMeasurement, CurrentMemory, CurrentSetpoint};
use model_core::control::hall_tracker::HallEdges;
use model_core::control::phases::Rotation;
use model_core::link::block::{Block, Parameters};
use model_core::plant::paper::four_wheels;
use std::f64::consts::TAU;

/// ω_e [rad/s]: 4 m/s of the paper's robot.
const SPEED: f64 = 5_000.0;

/// R [Ω], L [H] and K_v [V·s] between two terminals: a motor that a bus of 24 V drives at this speed.
const R: f64 = 1.5;
const L: f64 = 0.6e-3;
const KV: f64 = 0.0259;
const POLE_PAIRS: u8 = 8;
const BUS: f64 = 24.0;

/// DC-equivalent current that is asked for [A].
const ASKED: f64 = 1.5;

/// A half-period.
const HALF: f64 = 0.5;

/// A motor on the board at a held speed, and what its turn decided last.
struct Rig {
    motor: BoardMotor,
    instants: Instants,
    duties: [f32; 3],
    rng: ChaCha8Rng,
    config: WindingConfig,
}

/// What a turn saw of it.
struct Seen {
    /// Angle at the sample [rad]
    angle: f64,
    codes: [AdcCode; 3],
    halls: HallCode,
    /// True currents at the sample, DC-equivalent: along d and q [A]
    current: [f64; 2],
}

impl Rig {
    fn new(instants: Instants) -> Self {
        Self::placed(instants, 0.0, 5)
    }

    /// One whose hall switches sit up to so much off their places [rad].
    fn placed(instants: Instants, spread: f64, seed: u64) -> Self {
        let mut setup = BoardSetup::new(four_wheels::<f64>(), Effects::default(), seed).ideal();
        setup.hall_spread = spread;
        (setup.robot.motor.resistance, setup.robot.motor.emf_constant) = (R, KV);
        (setup.inductance, setup.pole_pairs) = (L, POLE_PAIRS);
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let motor = BoardMotor::new(&setup, 0, &mut rng);
        let mut block = Block { robot: four_wheels::<f32>(), inductance: L as f32, ..Block::<4>::default() };
        block.robot.motor.resistance = R as f32;
        (block.amps_per_count, block.pole_pairs, block.bandwidth) = (setup.amps_per_count as f32, POLE_PAIRS, 2000.0);
        let config = WindingConfig::of(&Parameters::Four(block));
        Self { motor, instants, duties: [0.5; 3], rng, config }
    }

    /// One period under what was decided last.
    fn period(&mut self) -> Seen {
        let top = f64::from(TOPS[0]);
        let duties = self.duties.map(|duty| f64::from(firmware::exchange::compare(duty, TOPS[0])) / top);
        let magnet = RotorFlux { angle: self.motor.angle, speed: SPEED };
        let Instants { sample, halls } = self.instants;
        self.motor.period(&BridgeLegs { duties, bus: BUS, enabled: true }, magnet, sample);
        self.motor.angle = magnet.after(PERIOD).angle.rem_euclid(TAU);
        let angle = magnet.after(sample * PERIOD).angle.rem_euclid(TAU);
        let [a, b, c] = self.motor.sampled;
        // ⅔·(i_a + i_b·e^{j120°} + i_c·e^{j240°})·e^{−jθ}, √3/2 of it DC-equivalent
        let third = |k: f64| Vector::from_polar(1.0, TAU / 3.0 * k);
        let turning = (a + b * third(1.0) + c * third(2.0)) * (2.0 / 3.0) * Vector::from_polar(1.0, -angle);
        let equivalent = turning * (0.5 * 3.0_f64.sqrt());
        Seen {
            angle,
            codes: self.motor.codes(angle, &mut self.rng),
            halls: self.motor.hall_code(magnet.after((sample + halls) * PERIOD).angle, &mut self.rng),
            current: [equivalent.re, equivalent.im],
        }
    }
}

/// What has settled, over whole turns of the rotor.
#[derive(Debug)]
struct Settled {
    /// Mean current along d over the mean along q [1]
    along_d: f64,
    /// What 95 % of the samples stay below, |i_d| over the mean i_q [1]
    quantile: f64,
    /// Mean current along q [A]
    torque: f64,
    /// Mean voltage that was told [V]
    voltage: f64,
}

/// Plays turns, of which `decide` says duties and voltage, until all is settled and then 200 turns of the rotor.
fn settled(mut rig: Rig, mut decide: impl FnMut(&WindingConfig, &Seen) -> ([f32; 3], f32)) -> Settled {
    let turns = (200.0 * TAU / (SPEED * PERIOD)).round() as usize;
    let (mut voltage, mut d, mut q) = (0.0, Vec::new(), 0.0);
    for k in 0..4_000 + turns {
        let seen = rig.period();
        let told;
        (rig.duties, told) = decide(&rig.config, &seen);
        if k >= 4_000 {
            voltage += f64::from(told) / turns as f64;
            q += seen.current[1] / turns as f64;
            d.push(seen.current[0]);
        }
    }
    let along_d = d.iter().sum::<f64>() / turns as f64 / q;
    let mut sizes: Vec<f64> = d.iter().map(|d| (d / q).abs()).collect();
    sizes.sort_by(f64::total_cmp);
    Settled { along_d, quantile: sizes[turns * 95 / 100], torque: q, voltage }
}

/// A turn that knows the rotor's angle at the sample.
fn by_exact_angle(instants: Instants, setpoint: CurrentSetpoint) -> Settled {
    let mut memory = CurrentMemory::default();
    settled(Rig::new(instants), move |config, seen| {
        let measured = CurrentMeasurement {
            codes: seen.codes,
            offsets: [2048.0; 3],
            ahead: (SPEED * PERIOD) as f32 * timing::SAMPLE_TO_ACTUATION,
            bus: BUS as f32,
            per_bus: 1.0 / BUS as f32,
        };
        let output = config.current_loop.field_oriented(
            &mut memory,
            &measured,
            Rotation::of_angle(seen.angle as f32),
            &setpoint,
        );
        (output.duties, output.voltage)
    })
}

/// The firmware's turn, by its halls.
fn by_halls(instants: Instants, setpoint: CurrentSetpoint) -> Settled {
    by_halls_of(Rig::new(instants), None, setpoint)
}

/// The same of a rig, by the places of its edges where they are known.
fn by_halls_of(rig: Rig, edges: Option<HallEdges>, setpoint: CurrentSetpoint) -> Settled {
    let mut motor = MotorController::default();
    settled(rig, move |config, seen| {
        motor.update_halls(seen.halls).expect("a legal code");
        edges.iter().for_each(|edges| motor.track(edges));
        let measured =
            MotorMeasurement { codes: seen.codes, offsets: [2048.0; 3], bus: BUS as f32, per_bus: 1.0 / BUS as f32 };
        motor.accumulate_voltage();
        let duties = motor.tick(config, &measured, &setpoint, true);
        (duties, motor.mean_voltage() * PERIODS_PER_TICK as f32)
    })
}

/// K_v·ω_m [V]
fn emf() -> f64 {
    KV * SPEED / f64::from(POLE_PAIRS)
}

fn closed() -> CurrentSetpoint {
    CurrentSetpoint { current: ASKED as f32, voltage: emf() as f32, closed: true }
}

/// How far the voltage that is told lies off what the DC motor needs, u = R·i + K_v·ω_m [V].
fn voltage_error(settled: &Settled) -> f64 {
    settled.voltage - (R * settled.torque + emf())
}

/// A vector that is held turns against the rotor by ω_e·Δt within a period: 1 − sin x/x = 0.26 % of it is lost, x = ω_e·Δt/2,
/// and as much of L·di/dt; 1 % of the voltage in all.
const VOLTAGE: f64 = 0.01 * BUS;

#[test]
fn at_5000_rad_s_with_the_exact_angle_the_current_is_along_q_and_the_voltage_that_of_the_dc_motor() {
    let settled = by_exact_angle(Instants::default(), closed());
    println!("exact angle: {settled:?}, voltage off by {:+.3} V", voltage_error(&settled));
    assert!(settled.along_d.abs() <= 0.02 && settled.quantile <= 0.02, "{settled:?}");
    assert!((settled.torque - ASKED).abs() < 0.01 * ASKED, "{settled:?}");
    assert!(voltage_error(&settled).abs() < VOLTAGE, "{}", voltage_error(&settled));
}

#[test]
fn at_5000_rad_s_by_polled_halls_the_current_is_along_q_in_the_mean_over_a_turn() {
    let settled = by_halls(Instants::default(), closed());
    println!("polled halls: {settled:?}, voltage off by {:+.3} V", voltage_error(&settled));
    assert!(settled.along_d.abs() <= 0.02, "{settled:?}");
    // an angle of when the halls were read, and not of the sample, would be off by ω_e·ε in the mean
    let unmoved = SPEED * PERIOD * f64::from(timing::HALLS_READ);
    assert!(settled.along_d.abs() < 0.5 * unmoved, "{settled:?} of {unmoved}");
    assert!(voltage_error(&settled).abs() < VOLTAGE, "{}", voltage_error(&settled));
    // an edge is known to a period, ±½·ω_e·Δt: so far the voltage may be turned until the next edge, and L·di/dt is what
    // that leaves
    let turned = 0.5 * SPEED * PERIOD * settled.voltage;
    let most = turned * (TAU / 6.0 / SPEED) / L / ASKED;
    assert!(settled.quantile < most, "{settled:?} of {most}");
    assert!((settled.torque - ASKED).abs() < 0.02 * ASKED, "{settled:?}");
}

#[test]
fn a_board_that_samples_half_a_period_later_breaks_the_voltage() {
    let settled = by_exact_angle(Instants { sample: HALF, ..Instants::default() }, closed());
    // the vector is turned half a period too far: sin(ω_e·Δt/2) of u_d = −ω_e·L·i is told as u_q
    let told = SPEED * L * ASKED * (0.5 * SPEED * PERIOD).sin();
    assert!(voltage_error(&settled).abs() > 2.0 * VOLTAGE, "{} V, foretold {told}", voltage_error(&settled));
}

#[test]
fn halls_that_are_read_half_a_period_from_where_they_are_said_to_be_break_the_direction() {
    let chip = Instants::default();
    for wrong in [chip.halls - HALF, chip.halls + HALF] {
        let settled = by_halls(Instants { halls: wrong, ..chip }, closed());
        assert!(settled.along_d.abs() > 0.08, "{settled:?}");
    }
}

#[test]
fn the_currents_are_those_of_the_instant() {
    for sample in [0.0, 0.25, 0.5] {
        let mut rig = Rig::new(Instants { sample, ..Instants::default() });
        rig.duties = [0.2, 0.8, 0.5];
        let before = rig.motor.current;
        let magnet = RotorFlux { angle: rig.motor.angle, speed: SPEED };
        rig.period();
        let mut alone = before;
        let duties =
            [0.2, 0.8, 0.5].map(|duty| f64::from(firmware::exchange::compare(duty, TOPS[0])) / f64::from(TOPS[0]));
        let legs = BridgeLegs { duties, bus: BUS, enabled: true };
        if sample > 0.0 {
            rig.motor.machine.period(&mut alone, &legs, magnet, sample * PERIOD);
        }
        assert!(rig.motor.sampled.iter().zip(phases(alone)).all(|(a, b)| (a - b).abs() < 1e-12), "{sample}");
        // and the period goes on as if nobody had looked
        let mut whole = before;
        let outcome = rig.motor.machine.period(&mut whole, &legs, magnet, PERIOD);
        assert!((whole - rig.motor.current).norm() < 1e-12);
        assert!((outcome.current - rig.motor.outcome.current).abs() < 1e-12);
        assert!((outcome.bus_current - rig.motor.outcome.bus_current).abs() < 1e-12);
    }
}

/// The edges of a rig as a commissioning finds them, each off by up to a degree [2⁻¹⁶ turn].
fn learned_edges(rig: &Rig, off: [f64; 6]) -> HallEdges {
    let errors = rig.motor.halls.errors;
    // sector k begins where switch 1 goes on, 0 off, 2 on, 1 off, 0 on, 2 off after the last: k·60° − 30° and its error
    let switch = [2, 1, 0, 2, 1, 0];
    HallEdges::new(std::array::from_fn(|k| {
        let degrees = 60.0 * k as f64 - 30.0 + errors[switch[k]].to_degrees() + off[k];
        (degrees.rem_euclid(360.0) * 65_536.0 / 360.0).round() as u32 as u16
    }))
}

#[test]
fn at_5000_rad_s_by_learned_edges_less_current_is_along_d_than_by_edges_taken_to_be_in_their_places() {
    const OFF: [f64; 6] = [1.0, -1.0, 0.5, -0.5, 1.0, -1.0];
    let spread = 5.0_f64.to_radians();
    let (mut taken, mut learned) = (Vec::new(), Vec::new());
    for seed in 1..=8 {
        let rig = || Rig::placed(Instants::default(), spread, seed);
        let edges = learned_edges(&rig(), OFF);
        taken.push(by_halls_of(rig(), None, closed()).quantile);
        learned.push(by_halls_of(rig(), Some(edges), closed()).quantile);
    }
    println!("95 % of |i_d|/i_q: {taken:.2?} by places taken, {learned:.2?} by learned ones");
    assert!(taken.iter().zip(&learned).all(|(taken, learned)| *learned < 0.5 * taken), "{taken:?} {learned:?}");
}
