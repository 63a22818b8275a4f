//! An effect that the catalogue does not have, in the same plant: `cargo run --release -p omni-gap --example own_effect`.
//!
//! A carpet lies beyond x = 0.5 m and brakes the robot by B·v on top of its own friction. The robot drives straight
//! ahead, onto the carpet, once with it and once without. To have the diagnosis know an effect too, give it a file in
//! `model-core/src/effects/` and name it in `effects/mod.rs`.

use std::path::Path;

use model_core::effect_set;
use model_core::effects::Hooks;
use model_core::effects::active::Effects;
use model_core::effects::card::{Card, Param, Physics, Role, Scope, Seam, Undone};
use model_core::effects::seams::{Body, EffectContext};
use model_core::effects::shows::{Channel, Parity, Regime, Shows};
use model_core::geometry::frames::{BodyTwist, Pose};
use model_core::plant::{Input, Plant};
use omni_gap::api::{Error, RobotFile, known_effects};
use omni_gap::simulate::robot_of;

/// Where the carpet begins, along the world's x axis [m]
const EDGE_M: f64 = 0.5;

/// The page of the effect as data.
const CARPET: Card = Card {
    id: "carpet",
    title: "Carpet",
    summary: "A part of the floor brakes the robot by a force that grows with its speed.",
    equation: "F = −B·v where x > 0.5 m",
    source: "an example",
    seams: &[Seam::Body],
    scope: Scope::Robot,
    params: &[Param {
        key: "viscous_N_s_per_m",
        symbol: "B",
        unit: "N·s/m",
        absent: 0.0,
        typical: 3.0,
        within: (0.0, 50.0),
        role: Role::Size,
    }],
    needs_current: false,
    shows: Shows { channels: &[Channel::WheelSpeed], regime: Regime::Speed, parity: Parity::Odd, order: None },
    signature: "slower than the model beyond the edge, on any heading",
    look_alikes: &[],
    code: 0,
    undone: Undone::No("a robot does not know where the carpet lies"),
    physics: Physics::PASSIVE,
};

/// The carpet: its B [N·s/m].
#[derive(Clone, Copy, Debug, PartialEq)]
struct Carpet(f64);

impl Hooks<f64> for Carpet {
    type State = ();

    fn body(&self, (): &(), at: &EffectContext<f64>, x: &mut Body<f64>) {
        if at.pose.x > EDGE_M {
            // F = −B·v
            x.force[0] -= self.0 * at.twist.v;
            x.force[1] -= self.0 * at.twist.vn;
        }
    }
}

effect_set! {
    /// The effects of this program: one.
    enum OwnEffects, OwnStates [] [f64] { Carpet(Carpet, &CARPET) }
}

/// How far the robot gets in two seconds at 6 V [m].
fn distance(robot: &RobotFile, effects: Effects<4, f64, OwnEffects>) -> f64 {
    let plant = Plant::new(robot_of::<4, f64>(robot, 12.0), effects);
    let mut memory: Vec<OwnStates> = plant.memory().collect();
    let mut state = plant.start(0.0, Pose::default(), BodyTwist::default());
    for _ in 0..2000 {
        // wheels 1 and 3 of the paper's robot drive along v
        plant.step(&mut state, &mut memory, &Input::Voltage([0.0, -6.0, 0.0, 6.0]), 1e-3);
    }
    state.pose.x
}

/// The program; the tests call it too.
pub fn main() -> Result<(), Error> {
    let text = include_str!("../robots/feup-4w/robot.toml");
    let robot = RobotFile::parse(text, Path::new("examples/feup-4w/robot.toml"), &known_effects())?;
    let mut effects = Effects::none();
    effects
        .put(OwnEffects::Carpet(Carpet(CARPET.params[0].typical)), None)
        .expect("it sits on the robot, as its card says");
    let (bare, carpet) = (distance(&robot, Effects::none()), distance(&robot, effects));
    println!(
        "after two seconds at 6 V: {bare:.2} m on the bare floor, {carpet:.2} m with the carpet beyond {EDGE_M} m"
    );
    assert!(carpet < bare && carpet > EDGE_M, "the carpet brakes, and only beyond its edge");
    Ok(())
}
