//! # Robots: what is believed, and what is true
//!
//! The block that a robot gets is made of a robot file; the robot that it then drives is another one. Every number of
//! it is off by a draw of what the file states of it, or, where it states nothing, of the robot file's defaults:
//!
//! | number | σ |
//! |---|---|
//! | mass; radius and distance of the wheels | 1 % |
//! | K_v, K_t, each for itself | 3 % |
//! | R, inertia | 10 % |
//! | each of the six numbers of friction | 20 % |
//!
//! truth = belief·e^(σ·n), n ~ N(0, 1). Besides, the battery sags, the converters have offsets and noise, and the hall
//! switches sit up to 5° (electrical) off their places.

use model_core::effects::EffectKind;
use model_core::effects::active::Effects;
use model_core::geometry::kinematics::Wheels;
use model_core::link::block::{Block, BlockEffects, ControlMode, Limits, Parameters};
use model_core::link::hello::Commutation;
use model_core::link::sensor_codes::SensorScales;
use model_core::plant::robot::Robot;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

use crate::virtual_board::BoardSetup;

/// k_p, current for an error of a wheel's speed [A·s/rad]
pub const FEEDBACK: f32 = 0.3;

/// k_i, current for an error of a wheel's angle [A/rad]
pub const FEEDBACK_INTEGRAL: f32 = 0.05;

/// Bandwidth of the currents' loop [rad/s]
pub const BANDWIDTH: f32 = 2000.0;

/// Largest current of a motor [A]
pub const CURRENT: f32 = 4.0;

/// Internal resistance of the battery [Ω]
pub const SAG: f64 = 0.15;

/// How far a hall switch sits from its place at most [rad, electrical]
pub const HALL_SPREAD: f64 = 5.0 * std::f64::consts::PI / 180.0;

/// A parameter block of any number of wheels.
pub trait ToParameters {
    /// The parameters of this robot.
    fn parameters(&self) -> Parameters;
}

impl ToParameters for Block<3> {
    fn parameters(&self) -> Parameters {
        Parameters::Three(*self)
    }
}

impl ToParameters for Block<4> {
    fn parameters(&self) -> Parameters {
        Parameters::Four(*self)
    }
}

/// The block of a robot as it is believed to be, with the gains recommended above.
pub fn block<const N: usize>(robot: Robot<N, f32>) -> Block<N> {
    Block {
        robot,
        inductance: 0.6e-3,
        mode: ControlMode::Current,
        feedforward: true,
        commutation: Commutation::FieldOriented,
        pole_pairs: 8,
        limits: Limits {
            current: CURRENT,
            speed: 2.0,
            acceleration: [3.0, 3.0, 30.0],
            under_voltage: 8.0,
            over_voltage: 16.0,
        },
        feedback: FEEDBACK,
        feedback_integral: FEEDBACK_INTEGRAL,
        bandwidth: BANDWIDTH,
        amps_per_count: 0.0049,
        bus_volts_per_count: 0.00886,
        linear_range: 9.4,
        continuous_current: 2.0,
        heating_time: 10.0,
        effects: BlockEffects::default(),
        wiring: [None; N],
        sensors: SensorScales::default(),
    }
}

/// A robot that is off by a draw from what is believed of it.
pub fn perturbed<const N: usize>(believed: &Robot<N, f64>, seed: u64) -> Robot<N, f64> {
    let mut rng = ChaCha8Rng::seed_from_u64(seed ^ 0x0ff_0ff);
    let mut off = |x: &mut f64, sigma: f64| {
        let n: f64 = StandardNormal.sample(&mut rng);
        *x *= (sigma * n).exp();
    };
    let mut robot = *believed;
    let mut wheels = *robot.wheels.wheels();
    let (mut radius, mut distance) = (1.0, 1.0);
    off(&mut radius, 0.01);
    off(&mut distance, 0.01);
    for wheel in &mut wheels {
        wheel.radius *= radius;
        wheel.distance *= distance;
    }
    robot.wheels = Wheels::new(wheels);
    off(&mut robot.mass, 0.01);
    off(&mut robot.motor.emf_constant, 0.03);
    off(&mut robot.motor.torque_constant, 0.03);
    off(&mut robot.motor.resistance, 0.1);
    off(&mut robot.inertia, 0.1);
    let friction = &mut robot.friction;
    friction.viscous.iter_mut().chain(&mut friction.coulomb).for_each(|x| off(x, 0.2));
    robot
}

/// Radius and distance of the wheels, true over believed [1].
pub fn geometry<const N: usize>(believed: &Robot<N, f64>, truth: &Robot<N, f64>) -> [f64; 2] {
    let [here, there] = [truth, believed].map(|robot| robot.wheels.wheels()[0]);
    [here.radius / there.radius, here.distance / there.distance]
}

/// A board with a robot that is off, on a battery that sags.
pub fn board<const N: usize>(believed: &Robot<N, f64>, seed: u64) -> BoardSetup<N> {
    let mut besides = Effects::default();
    besides.add(EffectKind::SupplySag, None, &[SAG, 0.0]).expect("room for one");
    BoardSetup { hall_spread: HALL_SPREAD, ..BoardSetup::new(perturbed(believed, seed), besides, seed) }
}
