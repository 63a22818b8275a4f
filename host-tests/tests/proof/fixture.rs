//! The core's robots, built from the reference's numbers, and runs of them.

use host_tests::excitation::VoltageHold;
use host_tests::generic_robot::GenericRobot;
use host_tests::paper::{FOUR_HEADINGS_DEG, FOUR_WHEELS, THREE_HEADINGS_DEG, THREE_WHEELS};
use model_core::effects::active::Effects;
use model_core::effects::card::{Card, Scope, Seam};
use model_core::effects::telegram::{Delivery, Telegram};
use model_core::effects::{Effect, EffectKind, EffectSet};
use model_core::geometry::frames::{BodyTwist, Pose};
use model_core::geometry::kinematics::{Wheel, Wheels};
use model_core::number::scalar::Real;
use model_core::plant::robot::{Friction, Robot};
use model_core::plant::winding::Motor;
use model_core::plant::{Input, Plant, Reading, State};

/// Bus voltage that commands refer to [V]
pub const SUPPLY: f64 = 12.0;

/// A core robot of a rig whose wheels all have the motor of the first.
pub fn core_robot<const N: usize, T: Real>(rig: &GenericRobot<N>) -> Robot<N, T> {
    let motor = rig.wheels[0].drivetrain;
    let l = T::lit;
    Robot {
        wheels: Wheels::new(rig.wheels.map(|w| Wheel {
            drive_angle: l(w.heading),
            distance: l(w.distance),
            radius: l(w.drivetrain.radius),
        })),
        motor: Motor {
            gear_ratio: l(motor.gear),
            resistance: l(motor.resistance),
            emf_constant: l(motor.kv),
            torque_constant: l(motor.kt),
        },
        mass: l(rig.mass),
        inertia: l(rig.inertia),
        friction: Friction { viscous: rig.viscous.map(l), coulomb: rig.coulomb.map(l) },
        supply: l(SUPPLY),
    }
}

/// The paper's robot on three wheels.
pub fn three<T: Real>() -> Robot<3, T> {
    core_robot(&THREE_WHEELS.generic(THREE_HEADINGS_DEG))
}

/// The paper's robot on four wheels.
pub fn four<T: Real>() -> Robot<4, T> {
    core_robot(&FOUR_WHEELS.generic(FOUR_HEADINGS_DEG))
}

/// An effect by its id.
pub fn effect(id: &str) -> EffectKind {
    EffectKind::find(id).unwrap_or_else(|| panic!("{id} is not in the catalogue"))
}

/// Parameters at which a card says that the effect is typical.
pub fn typical(card: &Card) -> Vec<f64> {
    card.params.iter().map(|p| p.typical).collect()
}

/// Parameters at which a card says that there is no effect.
pub fn absent(card: &Card) -> Vec<f64> {
    card.params.iter().map(|p| p.absent).collect()
}

/// Where an effect can sit on a robot of `wheels` wheels: on all (or the robot), and on single ones.
pub fn placements(card: &Card, wheels: usize) -> Vec<Option<usize>> {
    let single = (0..wheels).map(Some);
    match card.scope {
        Scope::Robot => vec![None],
        Scope::Wheels => std::iter::once(None).chain(single).collect(),
        Scope::OneWheel => single.collect(),
    }
}

/// Where an effect usually sits: on all wheels or the robot if it can, otherwise on wheel 1.
pub fn usual_placement(card: &Card) -> Option<usize> {
    (card.scope == Scope::OneWheel).then_some(1)
}

/// A plant with one effect.
pub fn with_effect<const N: usize, T: Real>(
    robot: Robot<N, T>,
    effect: EffectKind,
    wheel: Option<usize>,
    params: &[f64],
) -> Plant<N, T> {
    let mut effects = Effects::default();
    let params: Vec<T> = params.iter().map(|p| T::lit(*p)).collect();
    effects.add(effect, wheel, &params).expect("a placement that the card allows");
    Plant::new(robot, effects)
}

/// A plant with the effects at typical size beside which alone another shows, and with that one if it is wanted.
pub fn beside<const N: usize, T: Real>(
    robot: Robot<N, T>,
    effect: EffectKind,
    with: Option<(Option<usize>, &[f64])>,
) -> Plant<N, T> {
    let mut effects = Effects::default();
    let lit = |params: &[f64]| params.iter().map(|p| T::lit(*p)).collect::<Vec<T>>();
    if let Some(other) = effect.card().physics.shows_beside.map(self::effect) {
        effects.add(other, usual_placement(other.card()), &lit(&typical(other.card()))).expect("room");
    }
    if let Some((wheel, params)) = with {
        effects.add(effect, wheel, &lit(params)).expect("a placement that the card allows");
    }
    Plant::new(robot, effects)
}

/// A plant with one effect that the catalogue does not have.
pub fn with_invented<const N: usize, E: EffectSet<f64>>(
    robot: Robot<N, f64>,
    effect: E,
    wheel: Option<usize>,
) -> Plant<N, f64, E> {
    let mut effects = Effects::none();
    effects.put(effect, wheel).expect("a placement that the card allows");
    Plant::new(robot, effects)
}

/// A plant without effects.
pub fn plain<const N: usize, T: Real>(robot: Robot<N, T>) -> Plant<N, T> {
    Plant::new(robot, Effects::default())
}

/// A run of a plant.
#[derive(Clone, Debug)]
pub struct Run<const N: usize, T: Real, E: EffectSet<T> = Effect<T>> {
    /// The model.
    pub plant: Plant<N, T, E>,
    /// Where it is.
    pub state: State<N, T>,
    /// What its effects remember.
    pub memory: Vec<E::State>,
    /// Telegrams with commands so far.
    sent: u32,
}

/// One of so many telegrams is lost, as if a record showed it by this evidence [1]: for certain at a share of a fifth, the
/// largest that may be lost, and in part at less.
const LOST: (u32, f64) = (3, 5.0);

impl<const N: usize, T: Real, E: EffectSet<T>> Run<N, T, E> {
    /// From rest in the origin.
    pub fn new(plant: Plant<N, T, E>) -> Self {
        Self::from(plant, [0.0; 3], [0.0; 3])
    }

    /// From a pose [m, m, rad] and a twist [m/s, m/s, rad/s].
    pub fn from(plant: Plant<N, T, E>, pose: [f64; 3], twist: [f64; 3]) -> Self {
        let [x, y, theta] = pose.map(T::lit);
        let state = plant.start(T::zero(), Pose { x, y, theta }, BodyTwist::from_array(twist.map(T::lit)));
        let memory = plant.memory().collect::<Vec<_>>();
        Self { plant, state, memory, sent: 0 }
    }

    /// One step.
    pub fn step(&mut self, input: &Input<N, T>, dt: f64) -> Reading<N, T> {
        self.plant.step(&mut self.state, &mut self.memory, input, T::lit(dt))
    }

    /// One step under voltages [V]; of a robot whose drives control the speed under as many rad/s.
    pub fn drive(&mut self, u: [f64; N], dt: f64) -> Reading<N, T> {
        let input = self.send(u);
        self.step(&input, dt)
    }

    /// What arrives of such a command.
    pub fn send(&mut self, u: [f64; N]) -> Input<N, T> {
        let u = u.map(T::lit);
        let by_voltage = self.plant.effects().none_at(Seam::SpeedDrive);
        let sent = if by_voltage { Input::Voltage(u) } else { Input::SetSpeed(u) };
        let (one_of, evidence) = LOST;
        self.sent += 1;
        let shown = Delivery::Shown(if self.sent.is_multiple_of(one_of) { evidence } else { 0.0 });
        let telegram = Telegram { all: shown, each: [shown; N] };
        self.plant.receive(&mut self.memory, &sent, Some(&telegram))
    }

    /// One step of drives that control the speed [rad/s].
    pub fn set_speed(&mut self, speed: [f64; N], dt: f64) -> Reading<N, T> {
        self.step(&Input::SetSpeed(speed.map(T::lit)), dt)
    }

    /// Whole holds, `steps` steps a millisecond; `seen` is called after every step.
    pub fn play(&mut self, holds: &[VoltageHold<N>], steps: u32, mut seen: impl FnMut(&Self, Reading<N, T>)) {
        for hold in holds {
            for _ in 0..hold.milliseconds {
                let input = self.send(hold.u);
                for _ in 0..steps {
                    let reading = self.step(&input, 1e-3 / f64::from(steps));
                    seen(self, reading);
                }
            }
        }
    }

    /// v, vn, ω [m/s, m/s, rad/s]
    pub fn twist(&self) -> [f64; 3]
    where
        T: Into<f64>,
    {
        self.state.twist.to_array().map(Into::into)
    }

    /// x, y, θ [m, m, rad]
    pub fn pose(&self) -> [f64; 3]
    where
        T: Into<f64>,
    {
        [self.state.pose.x, self.state.pose.y, self.state.pose.theta].map(Into::into)
    }
}

/// Largest difference of two lists of numbers; infinite if one of them is not finite.
pub fn gap<const M: usize>(a: [f64; M], b: [f64; M]) -> f64 {
    a.into_iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, larger)
}

/// The larger of two; infinite if one of them is no number, which must not pass for small.
pub fn larger(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() { f64::INFINITY } else { a.max(b) }
}

/// The angle within ±π [rad].
pub fn wrapped(angle: f64) -> f64 {
    let (sin, cos) = angle.sin_cos();
    sin.atan2(cos)
}
