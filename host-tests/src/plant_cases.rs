//! # Plant cases: what the plant's step is timed with
//!
//! The four-wheel robot at 1 kHz, driven by steps and reversals as a diagnosis would simulate them, with the effects that
//! each case names.

use model_core::effects::card::Scope;
use model_core::effects::{EffectKind, EffectState};
use model_core::geometry::frames::{BodyTwist, Pose};
use model_core::number::dual::Dual;
use model_core::number::scalar::Real;
use model_core::plant::robot::Nominal;
use model_core::plant::{Batch, Input, Plant};
use omni_gap::known_effects;
use omni_gap::log::RobotFile;
use omni_gap::simulate::{EffectInstance, Model};
use std::path::Path;

use crate::catalogue::sessions::truth;

/// Steps of a run.
pub const STEPS: usize = 10_000;

/// Length of a step [s]
pub const STEP_S: f64 = 1e-3;

/// Wheel of an effect that sits on one wheel alone.
const ODD_WHEEL: usize = 2;

/// Effects that are timed together.
#[derive(Clone, Copy, Debug)]
pub struct PlantCase {
    /// What it is called.
    pub name: &'static str,
    /// The effects by their ids.
    pub effects: &'static [&'static str],
}

/// The cases that the promises speak of.
pub const PLANT_CASES: [PlantCase; 4] = [
    PlantCase { name: "plain", effects: &[] },
    PlantCase {
        name: "three light: coriolis, floor_tilt, current_sensor_offset",
        effects: &["coriolis", "floor_tilt", "current_sensor_offset"],
    },
    PlantCase {
        name: "three of the chain: motor_mismatch, gear_efficiency, coriolis",
        effects: &["motor_mismatch", "gear_efficiency", "coriolis"],
    },
    PlantCase {
        name: "three heavy: dead_time, stribeck, wheel_slip",
        effects: &["dead_time", "stribeck", "wheel_slip"],
    },
];

/// As many as a robot has that is wrong in everything that real logs show most.
pub const TEN: PlantCase = PlantCase {
    name: "ten: from the supply to the camera",
    effects: &[
        "supply_sag",
        "dead_time",
        "motor_mismatch",
        "gear_efficiency",
        "stribeck",
        "wheel_friction",
        "roller_friction",
        "coriolis",
        "camera_latency",
        "encoder_lag",
    ],
};

/// The robot with effects of typical size.
pub fn model(effects: &[&str]) -> Model<4> {
    let file = RobotFile::parse(truth(4), Path::new("robot.toml"), &known_effects()).expect("the example is sound");
    let mut model = Model::nominal(&file, 12.0);
    for id in effects {
        let card = EffectKind::find(id).expect("an id of the catalogue").card();
        let wheel = (card.scope == Scope::OneWheel).then_some(ODD_WHEEL);
        model.add_effect(EffectInstance::typical(card, wheel));
    }
    model
}

/// The plain robot in numbers that carry eight derivatives.
pub fn with_derivatives() -> Plant<4, Dual<8>> {
    model(&[]).plant_with(|_, x| Dual::variable(x, 0))
}

/// Robots side by side.
pub const LANES: usize = 4;

/// The plain robot, side by side with some that are a little heavier each.
pub fn side_by_side() -> Batch<4, LANES> {
    let plain = model(&[]);
    let robots = std::array::from_fn(|lane| {
        let mut factor = plain.factor;
        factor[Nominal::Mass as usize] = 1.0 + 0.05 * lane as f64;
        plain.robot().scaled(&factor)
    });
    Batch::new(&robots).expect("robots on the same wheels")
}

/// All steps of every robot, from rest; a sum of what was read, so that no step can be left out.
pub fn run_side_by_side(batch: &Batch<4, LANES>) -> f64 {
    let mut state = batch.start(&[Pose::default(); LANES], &[BodyTwist::default(); LANES]);
    let mut sum = 0.0;
    for k in 0..STEPS {
        sum += batch.step(&mut state, &command(k).map(|u| [u; LANES]), STEP_S).of(0).current[0];
    }
    sum
}

/// The motor voltages of step `k` [V].
#[inline]
pub fn command(k: usize) -> [f64; 4] {
    let u = if (k / 300).is_multiple_of(2) { 6.0 } else { -5.0 };
    [u, 0.5 * u, -u, 2.0]
}

/// All steps, from rest; a sum of what was read, so that no step can be left out.
pub fn run<T: Real>(plant: &Plant<4, T>, memory: &mut [EffectState<T>]) -> T {
    let mut state = plant.start(T::zero(), Pose::default(), BodyTwist::default());
    let mut sum = T::zero();
    for k in 0..STEPS {
        let input = Input::Voltage(command(k).map(T::lit));
        sum += plant.step(&mut state, memory, &input, T::lit(STEP_S)).current[0];
    }
    sum
}
