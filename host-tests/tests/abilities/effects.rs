//! Effects that stand only here, and a robot that has no friction to hide them.

use std::cell::RefCell;

use model_core::effect_set;
use model_core::effects::active::Effects;
use model_core::effects::card::{Card, Scope, Seam};
use model_core::effects::seams::{Body, Contact, EffectContext, Gear, Sense, Shaft};
use model_core::effects::{Hooks, Needs};
use model_core::geometry::frames::{BodyTwist, Pose};
use model_core::plant::paper;
use model_core::plant::robot::{Friction, Robot};
use model_core::plant::{Input, Plant, Reading, State};

use crate::blank_card::BLANK;

const fn at(seam: &'static [Seam], scope: Scope) -> Card {
    Card { seams: seam, scope, ..BLANK }
}

effect_set! {
    /// The effects that stand only here.
    pub enum Ability, AbilityState [] [f64] {
        OffCentre(OffCentre, &const { at(&[Seam::Body], Scope::Robot) }),
        YieldingShaft(YieldingShaft, &const { at(&[Seam::Shaft], Scope::Wheels) }),
        Rollers(Rollers, &const { at(&[Seam::Contact], Scope::Wheels) }),
        Turned(Turned, &const { at(&[Seam::Contact], Scope::Wheels) }),
        WheelWitness(WheelWitness, &const { at(&[Seam::Gear], Scope::Wheels) }),
        BodyWitness(BodyWitness, &const { at(&[Seam::Sense], Scope::Robot) }),
    }
}

/// A centre of mass at `offset` from the centre that poses refer to, along the body's axes [m], with the moment of
/// inertia about it [kg·m²].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OffCentre {
    pub offset: [f64; 2],
    pub inertia: f64,
}

impl Hooks<f64> for OffCentre {
    type State = ();

    fn body(&self, _: &(), at: &EffectContext<f64>, x: &mut Body<f64>) {
        let (m, [cx, cy]) = (x.total_mass(), self.offset);
        let BodyTwist { v, vn, w } = at.twist;
        // momentum M·(v, vn, ω) of a mass that moves with (v − ω·c_y, vn + ω·c_x)
        x.mass = [[m, 0.0, -m * cy], [0.0, m, m * cx], [-m * cy, m * cx, self.inertia + m * (cx * cx + cy * cy)]];
        let [p, q] = [m * (v - w * cy), m * (vn + w * cx)];
        // it keeps its direction in the world: F = (ω·q, −ω·p, vn·p − v·q)
        x.force[0] += w * q;
        x.force[1] -= w * p;
        x.force[2] += vn * p - v * q;
        // −∂F/∂(v, vn, ω)
        let slope = [
            [0.0, w * m, q + w * m * cx],
            [-w * m, 0.0, -p + w * m * cy],
            [vn * m - q, p - v * m, -vn * m * cy - v * m * cx],
        ];
        for (rate, slope) in x.rate.iter_mut().flatten().zip(slope.iter().flatten()) {
            *rate -= slope;
        }
    }
}

/// A shaft between rotor and wheel, all counted at the wheel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct YieldingShaft {
    /// [kg·m²]
    pub rotor: f64,
    /// [N·m/rad]
    pub stiffness: f64,
    /// [N·m·s]
    pub damping: f64,
    /// [rad]
    pub play: f64,
}

impl Hooks<f64> for YieldingShaft {
    type State = ();

    fn shaft(&self, _: &(), _: &EffectContext<f64>, x: &mut Shaft<f64>) {
        *x = Shaft { inertia: self.rotor, stiffness: self.stiffness, damping: self.damping, play: self.play, ..*x };
    }
}

/// Dry [N] and viscous [N·s/m] friction of the rollers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rollers(pub f64, pub f64);

impl Hooks<f64> for Rollers {
    type State = ();

    fn contact(&self, _: &(), _: &EffectContext<f64>, x: &mut Contact<f64>) {
        x.roller_friction += self.0;
        x.roller_damping += self.1;
    }
}

/// Wheels that are mounted turned by an angle [rad].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Turned(pub f64);

impl Hooks<f64> for Turned {
    type State = ();

    fn contact(&self, _: &(), _: &EffectContext<f64>, x: &mut Contact<f64>) {
        let [cos, sin, _] = x.row;
        let (s, c) = self.0.sin_cos();
        let (cos, sin) = (cos * c - sin * s, sin * c + cos * s);
        // the contact point moves with (v − ω·y, vn + ω·x)
        x.row = [cos, sin, sin * x.position[0] - cos * x.position[1]];
    }
}

thread_local! {
    /// What the witnesses were told since it was last emptied.
    pub static TOLD: RefCell<Vec<EffectContext<f64>>> = const { RefCell::new(Vec::new()) };
}

/// Writes down what a wheel's gear is told.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WheelWitness;

impl Hooks<f64> for WheelWitness {
    type State = ();
    const NEEDS: Needs = Needs { angle: true, heat: true, acceleration: true, ..Needs::NOTHING };

    fn gear(&self, _: &(), at: &EffectContext<f64>, _: &mut Gear<f64>) {
        TOLD.with_borrow_mut(|told| told.push(*at));
    }
}

/// Writes down what the robot's sensors are told.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BodyWitness;

impl Hooks<f64> for BodyWitness {
    type State = ();
    const NEEDS: Needs = Needs { angle: true, heat: true, acceleration: true, ..Needs::NOTHING };

    fn sense(&self, _: &(), at: &EffectContext<f64>, _: &mut Sense<f64>) {
        TOLD.with_borrow_mut(|told| told.push(*at));
    }
}

/// The paper's four wheels without any friction of the body.
pub fn frictionless() -> Robot<4, f64> {
    Robot { friction: Friction::default(), ..paper::four_wheels() }
}

/// A robot on its way.
#[derive(Debug)]
pub struct Way<const N: usize> {
    pub plant: Plant<N, f64, Ability>,
    pub state: State<N, f64>,
}

impl<const N: usize> Way<N> {
    /// A robot with these effects on all wheels, which begins with a velocity.
    pub fn begin(robot: Robot<N, f64>, abilities: &[Ability], twist: [f64; 3]) -> Self {
        let mut effects = Effects::none();
        abilities.iter().for_each(|ability| effects.put(*ability, None).expect("a placement that the card allows"));
        let plant = Plant::new(robot, effects);
        let state = plant.start(0.0, Pose::default(), BodyTwist::from_array(twist));
        Self { plant, state }
    }

    pub fn step(&mut self, input: &Input<N, f64>, dt: f64) -> Reading<N, f64> {
        self.plant.step(&mut self.state, &mut [], input, dt)
    }

    /// Without any current, for some steps.
    pub fn coast(&mut self, steps: usize, dt: f64) {
        for _ in 0..steps {
            self.step(&Input::Current([0.0; N]), dt);
        }
    }
}
