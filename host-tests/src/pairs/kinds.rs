//! What may differ in a pair, and how a pair is recorded.

use ground_truth::causes::cause;
use ground_truth::drawn::Drawn;
use ground_truth::drawn_robot::DrawnRobot;
use ground_truth::recording::{Plan, Session as Recorded};
use ground_truth::setup::Setup;
use omni_gap::Session;
use omni_gap::error::Result;

use crate::laboratory::cases;
use crate::laboratory::through_files::read;

/// What differs between two sessions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PairKind {
    /// Nothing.
    Nothing,
    /// A mass that was added.
    Mass,
    /// One motor is weaker.
    Motor,
    /// Another floor, with other friction.
    Floor,
    /// Another latency of the camera.
    Latency,
    /// Another firmware, with another dead time.
    DeadTime,
}

impl PairKind {
    /// All of them.
    pub const ALL: [PairKind; 6] =
        [PairKind::Nothing, PairKind::Mass, PairKind::Motor, PairKind::Floor, PairKind::Latency, PairKind::DeadTime];

    /// Its name in a table.
    pub const fn name(self) -> &'static str {
        match self {
            PairKind::Nothing => "nothing",
            PairKind::Mass => "added mass",
            PairKind::Motor => "one weaker motor",
            PairKind::Floor => "another floor",
            PairKind::Latency => "another latency",
            PairKind::DeadTime => "another dead time",
        }
    }

    /// The least and the most that is put, as multiples of what is typical.
    const fn times(self) -> (f64, f64) {
        match self {
            PairKind::Nothing => (0.0, 0.0),
            PairKind::Mass => (1.5, 4.0),
            PairKind::Motor => (0.8, 2.0),
            PairKind::Floor => (0.7, 1.5),
            PairKind::Latency => (0.5, 1.5),
            PairKind::DeadTime => (0.7, 2.0),
        }
    }
}

/// How both sides are recorded; the voltage is for a supply of 12 V.
pub const PLAN: Plan = Plan { runs: 4, duration: 5.0, ..cases::PLAN };

/// The supply that [`PLAN`] is for [V]
const SUPPLY_V: f64 = 12.0;

/// What parts the recording of B from that of A.
const OF_B: u64 = 0xb0b0;

/// A pair, and what was put into one side.
#[derive(Debug)]
pub struct RecordedPair {
    /// The first session.
    pub a: Session,
    /// The second.
    pub b: Session,
    /// What differs.
    pub kind: PairKind,
    /// The wheel on which it sits.
    pub wheel: Option<usize>,
    /// The true change of the number that sizes it, from A to B, in the number's own unit; of friction its share of
    /// the plain one [1].
    pub change: f64,
}

/// Records a pair: the same seed gives the same bytes. In every other seed what differs is in A.
///
/// # Errors
/// Where no folder can be written or read.
pub fn recorded(kind: PairKind, seed: u64, plan: &Plan) -> Result<RecordedPair> {
    let robot = DrawnRobot::new(seed);
    let mut drawn = Drawn::new(seed ^ OF_B);
    let (least, most) = kind.times();
    let times = drawn.between(least, most);
    let wheel = drawn.below(robot.truth.wheels.len() as u32) as usize;
    let plain = robot.truth.setup();
    let (changed, change) = put(kind, &plain, wheel, times);
    let in_a = !seed.is_multiple_of(2);
    let plan = Plan { voltage: plan.voltage * robot.truth.supply / SUPPLY_V, ..*plan };
    let session = |setup: &Setup, seed: u64| read(&Recorded::of(&robot.file, setup, &plan, seed));
    let (of_a, of_b) = if in_a { (&changed, &plain) } else { (&plain, &changed) };
    Ok(RecordedPair {
        a: session(of_a, seed)?,
        b: session(of_b, seed ^ OF_B)?,
        kind,
        wheel: (kind == PairKind::Motor).then_some(wheel),
        change: if in_a { -change } else { change },
    })
}

/// The setup with what differs, and by how much the number that sizes it changes.
fn put(kind: PairKind, plain: &Setup, wheel: usize, times: f64) -> (Setup, f64) {
    let mut changed = plain.clone();
    let mut hide = |id: &str, on: Option<usize>| (cause(id).expect("a cause").put)(&mut changed, on, times);
    match kind {
        PairKind::Nothing => {}
        PairKind::Mass => hide("mass", None),
        PairKind::Motor => hide("motor_mismatch", Some(wheel)),
        PairKind::Floor => {
            hide("coulomb_friction", None);
            hide("viscous_friction", None);
        }
        PairKind::Latency => hide("camera_latency", None),
        PairKind::DeadTime => hide("dead_time", None),
    }
    let change = match kind {
        PairKind::Nothing => 0.0,
        PairKind::Mass => changed.robot.chassis.mass - plain.robot.chassis.mass,
        PairKind::Motor => {
            let constant = |setup: &Setup| setup.robot.wheels[wheel].motor.torque_constant;
            constant(&changed) / constant(plain) - 1.0
        }
        // the same share on every axis
        PairKind::Floor => changed.robot.chassis.friction.coulomb.x / plain.robot.chassis.friction.coulomb.x - 1.0,
        PairKind::Latency => changed.sensors.camera.latency - plain.sensors.camera.latency,
        PairKind::DeadTime => {
            let loss = |setup: &Setup| setup.robot.wheels[wheel].bridge.dead_time_loss;
            loss(&changed) - loss(plain)
        }
    };
    (changed, change)
}
