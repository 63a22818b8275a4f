//! # Parity: the model's results, bit by bit
//!
//! The same functions, in single precision, on the host and on the chip: 20,000 results are folded into one number
//! (FNV-1a over their bits). A test on the host, the image in the emulator and a test on the board compare it.

use model_core::control::braking::BrakingBand;
use model_core::control::calibration::AdcCode;
use model_core::control::compensation::Compensation;
use model_core::control::current_loop::{CurrentLoop, CurrentMeasurement, CurrentMemory, CurrentSetpoint};
use model_core::control::motion_controller::{Controller, Measurement, Memory, Settings};
use model_core::control::phases::Rotation;
use model_core::effects::active::Effects;
use model_core::effects::body::coriolis::{self, Coriolis};
use model_core::geometry::frames::{BodyTwist, Pose};
use model_core::number::scalar::Real;
use model_core::plant::paper;
use model_core::plant::{Input, Plant};

/// How many results [`hash`] folds.
pub const RESULTS: u32 = 20_000;

model_core::effect_set! {
    /// What the plants here could carry: a plant of the whole catalogue would fill the test's image with laws that none of
    /// its results needs.
    enum Carried, CarriedState [] [f32] { Coriolis(Coriolis<f32>, &coriolis::CARD) }
}

/// FNV-1a, 64 bits.
#[derive(Clone, Copy, Debug)]
struct Fold {
    hash: u64,
    results: u32,
}

impl Fold {
    fn add(&mut self, result: f32) {
        for byte in result.to_bits().to_le_bytes() {
            self.hash = (self.hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3);
        }
        self.results += 1;
    }

    fn add_all<const K: usize>(&mut self, results: [f32; K]) {
        results.into_iter().for_each(|result| self.add(result));
    }
}

/// Numbers in −1 ..= 1, the same on every machine (a linear congruential generator's upper 24 bits).
struct Draws(u32);

impl Draws {
    fn next(&mut self) -> f32 {
        self.0 = self.0.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        // 24 bits fit a single's mantissa
        (self.0 >> 8) as f32 / 8_388_608.0 - 1.0
    }
}

/// The folded bits of [`RESULTS`] results of the model: trigonometry, inverse dynamics, plant, motion turn and current
/// loop, three and four wheels.
pub fn hash() -> u64 {
    let mut fold = Fold { hash: 0xcbf2_9ce4_8422_2325, results: 0 };
    let mut draws = Draws(1);
    let three = Plant::<3, f32, Carried>::new(paper::three_wheels(), Effects::none());
    let four = Plant::<4, f32, Carried>::new(paper::four_wheels(), Effects::none());
    let rest = Pose { x: 0.0, y: 0.0, theta: 0.0 };
    let mut three_state = three.start(0.0, rest, BodyTwist::from_array([0.0; 3]));
    let mut four_state = four.start(0.0, rest, BodyTwist::from_array([0.0; 3]));
    let controller = Controller::new(&Settings {
        robot: paper::four_wheels(),
        compensation: Compensation::none(),
        acceleration: [3.0, 3.0, 20.0],
        current_limit: 2.5,
        braking: BrakingBand::unlimited(),
        max_duty: 0.9,
        feedback: 0.05,
        feedback_integral: 0.2,
        feedforward: true,
        working: [true; 4],
        dt: 1.0e-3,
    });
    let current_loop = CurrentLoop::new(4.3111, 0.6e-3, 0.0049, 2000.0, 50.0e-6, 0.9);
    let (mut motion, mut winding) = (Memory::default(), CurrentMemory::default());
    while fold.results < RESULTS {
        let (sin, cos) = Real::sin_cos(40.0 * draws.next());
        fold.add_all([sin, cos, Real::atan2(draws.next(), draws.next())]);

        let twist = BodyTwist::from_array([draws.next(), draws.next(), 5.0 * draws.next()]);
        let acceleration = BodyTwist::from_array([3.0 * draws.next(), 3.0 * draws.next(), 10.0 * draws.next()]);
        fold.add_all(three.robot().inverse_dynamics(twist, acceleration).voltage);
        fold.add_all(four.robot().inverse_dynamics(twist, acceleration).voltage);

        let volts = [12.0 * draws.next(), 12.0 * draws.next(), 12.0 * draws.next(), 12.0 * draws.next()];
        let [a, b, c, _] = volts;
        fold.add_all(three.step(&mut three_state, &mut [], &Input::Voltage([a, b, c]), 1.0e-3).current);
        fold.add_all(four.step(&mut four_state, &mut [], &Input::Voltage(volts), 1.0e-3).current);
        fold.add_all(four_state.twist.to_array());

        let measured = Measurement { wheel_speed: volts, bus: 12.0 };
        fold.add_all(controller.tick(&mut motion, &measured, twist).voltage);
        let codes = [a, b, c].map(|x| AdcCode((2048.0 + 20.0 * x) as u16));
        let rotor = Rotation::of_code((32_768.0 + 32_767.0 * draws.next()) as u16);
        let measured = CurrentMeasurement { codes, offsets: [2048.0; 3], ahead: 0.02, bus: 12.0, per_bus: 1.0 / 12.0 };
        let setpoint = CurrentSetpoint { current: draws.next(), voltage: a, closed: true };
        fold.add_all(current_loop.field_oriented(&mut winding, &measured, rotor, &setpoint).duties);
    }
    fold.hash
}
