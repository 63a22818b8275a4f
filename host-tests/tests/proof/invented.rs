//! Effects that the catalogue does not have, written against the mechanism alone.

use std::cell::RefCell;

use model_core::effects::Effect;
use model_core::effects::card::{Card, Param, Physics, Role, Scope, Seam, Undone};
use model_core::effects::seams::{Body, Bridge, Contact, EffectContext, Gear, Sense, StepOutcome, Supply, Winding};
use model_core::number::scalar::Real;

const PARAM: Param =
    Param { key: "x", symbol: "x", unit: "1", absent: 0.0, typical: 1.0, within: (0.0, 1e3), role: Role::Size };

const BLANK: Card = Card {
    id: "invented",
    title: "",
    summary: "",
    equation: "",
    source: "",
    seams: &[],
    scope: Scope::Wheels,
    params: &[PARAM],
    memory: 0,
    needs_current: false,
    signature: "",
    look_alikes: &[],
    code: 0,
    undone: Undone::No("it is invented"),
    physics: Physics::PASSIVE,
};

/// Teeth of the motor that pull the wheel into 18 places a turn: τ += x·sin(18·angle).
pub struct Cogging;

impl<T: Real> Effect<T> for Cogging {
    fn card(&self) -> &'static Card {
        &const { Card { seams: &[Seam::Gear], ..BLANK } }
    }
    fn gear(&self, p: &[T], _: &[T], at: &EffectContext<T>, x: &mut Gear<T>) {
        x.torque += p[0] * (T::lit(18.0) * at.wheel_angle).sin_cos().0;
    }
}

/// A carpet on the half of the floor beyond x = 0.2 m, where the body's Coulomb friction is (1 + x) times as large.
pub struct Carpet;

impl<T: Real> Effect<T> for Carpet {
    fn card(&self) -> &'static Card {
        &const { Card { seams: &[Seam::Body], scope: Scope::Robot, ..BLANK } }
    }
    fn body(&self, p: &[T], _: &[T], at: &EffectContext<T>, x: &mut Body<T>) {
        if at.pose.x > T::lit(0.2) {
            x.budget = x.budget.map(|b| b * (T::one() + p[0]));
        }
    }
}

/// A wind along the world's x axis: a force of x [N].
pub struct Wind;

impl<T: Real> Effect<T> for Wind {
    fn card(&self) -> &'static Card {
        &const { Card { seams: &[Seam::Body], scope: Scope::Robot, ..BLANK } }
    }
    fn body(&self, p: &[T], _: &[T], at: &EffectContext<T>, x: &mut Body<T>) {
        let (sin, cos) = at.pose.theta.sin_cos();
        x.force[0] += p[0] * cos;
        x.force[1] -= p[0] * sin;
    }
}

/// A winding that warms up: R·(1 + x·s), where s rises with i² and falls with 1 s.
pub struct Heating;

impl<T: Real> Effect<T> for Heating {
    fn card(&self) -> &'static Card {
        &const { Card { seams: &[Seam::Winding], memory: 1, ..BLANK } }
    }
    fn winding(&self, p: &[T], s: &[T], _: &EffectContext<T>, x: &mut Winding<T>) {
        x.resistance *= T::one() + p[0] * s[0];
    }
    fn advance(&self, _: &[T], s: &mut [T], at: &EffectContext<T>, done: &StepOutcome<T>) {
        s[0] += at.dt * (done.current * done.current - s[0]);
    }
    fn restart(&self, _: &[T], s: &mut [T], at: &EffectContext<T>) {
        // as if it had run at this speed for long
        s[0] = at.wheel_speed.abs();
    }
}

/// A winding with an inductance of x [mH].
pub struct Inductance;

impl<T: Real> Effect<T> for Inductance {
    fn card(&self) -> &'static Card {
        &const { Card { seams: &[Seam::Winding], ..BLANK } }
    }
    fn winding(&self, p: &[T], _: &[T], _: &EffectContext<T>, x: &mut Winding<T>) {
        x.inductance += T::lit(1e-3) * p[0];
    }
}

/// A battery that empties: its voltage has fallen by x for every ampere-second drawn [V/(A·s)].
pub struct Emptying;

impl<T: Real> Effect<T> for Emptying {
    fn card(&self) -> &'static Card {
        &const { Card { seams: &[Seam::Supply], scope: Scope::Robot, memory: 1, ..BLANK } }
    }
    fn supply(&self, p: &[T], s: &[T], _: &EffectContext<T>, x: &mut Supply<T>) {
        x.voltage -= p[0] * s[0];
    }
    fn advance(&self, _: &[T], s: &mut [T], at: &EffectContext<T>, done: &StepOutcome<T>) {
        s[0] += at.dt * done.bus_current;
    }
}

/// A bridge that is cut at a part x of the bus voltage, from 20 ms on.
pub struct Limit;

impl<T: Real> Effect<T> for Limit {
    fn card(&self) -> &'static Card {
        &const { Card { seams: &[Seam::Bridge], ..BLANK } }
    }
    fn bridge(&self, p: &[T], _: &[T], at: &EffectContext<T>, x: &mut Bridge<T>) {
        if at.time > T::lit(0.0195) {
            let most = p[0] * x.bus;
            x.voltage = x.voltage.clamp(-most, most);
            x.sampled = x.sampled.clamp(-most, most);
        }
    }
}

/// A wheel whose radius is larger by the part x.
pub struct LargeWheel;

impl<T: Real> Effect<T> for LargeWheel {
    fn card(&self) -> &'static Card {
        &const { Card { seams: &[Seam::Contact], ..BLANK } }
    }
    fn contact(&self, p: &[T], _: &[T], _: &EffectContext<T>, x: &mut Contact<T>) {
        x.radius *= T::one() + p[0];
    }
}

/// An encoder that reads x times the wheel's angle on top of its speed.
pub struct Eccentric;

impl<T: Real> Effect<T> for Eccentric {
    fn card(&self) -> &'static Card {
        &const { Card { seams: &[Seam::Sense], ..BLANK } }
    }
    fn sense(&self, p: &[T], _: &[T], at: &EffectContext<T>, x: &mut Sense<T>) {
        x.wheel_speed += p[0] * at.wheel_angle;
    }
}

thread_local! {
    /// What the spies were told: which hook, and where.
    pub static SEEN: RefCell<Vec<(&'static str, EffectContext<f64>)>> = const { RefCell::new(Vec::new()) };
}

fn record_hook(hook: &'static str, at: &EffectContext<f64>) {
    SEEN.with_borrow_mut(|seen| seen.push((hook, *at)));
}

/// A spy on wheels: it changes nothing, and remembers what it is told.
pub struct WheelSpy;

impl Effect<f64> for WheelSpy {
    fn card(&self) -> &'static Card {
        const SEAMS: &[Seam] = &[Seam::Bridge, Seam::Winding, Seam::Gear, Seam::Contact, Seam::Sense];
        &const { Card { seams: SEAMS, memory: 1, ..BLANK } }
    }
    fn bridge(&self, _: &[f64], _: &[f64], at: &EffectContext<f64>, _: &mut Bridge<f64>) {
        record_hook("drive", at);
    }
    fn winding(&self, _: &[f64], _: &[f64], at: &EffectContext<f64>, _: &mut Winding<f64>) {
        record_hook("winding", at);
    }
    fn gear(&self, _: &[f64], _: &[f64], at: &EffectContext<f64>, _: &mut Gear<f64>) {
        record_hook("gear", at);
    }
    fn contact(&self, _: &[f64], _: &[f64], at: &EffectContext<f64>, _: &mut Contact<f64>) {
        record_hook("contact", at);
    }
    fn sense(&self, _: &[f64], _: &[f64], at: &EffectContext<f64>, _: &mut Sense<f64>) {
        record_hook("sense", at);
    }
    fn advance(&self, _: &[f64], _: &mut [f64], at: &EffectContext<f64>, _: &StepOutcome<f64>) {
        record_hook("advance", at);
    }
}

/// A spy on the robot.
pub struct RobotSpy;

impl Effect<f64> for RobotSpy {
    fn card(&self) -> &'static Card {
        &const { Card { seams: &[Seam::Supply, Seam::Body, Seam::Sense], scope: Scope::Robot, memory: 1, ..BLANK } }
    }
    fn supply(&self, _: &[f64], _: &[f64], at: &EffectContext<f64>, _: &mut Supply<f64>) {
        record_hook("supply", at);
    }
    fn body(&self, _: &[f64], _: &[f64], at: &EffectContext<f64>, _: &mut Body<f64>) {
        record_hook("body", at);
    }
    fn sense(&self, _: &[f64], _: &[f64], at: &EffectContext<f64>, _: &mut Sense<f64>) {
        record_hook("sense", at);
    }
    fn advance(&self, _: &[f64], _: &mut [f64], at: &EffectContext<f64>, _: &StepOutcome<f64>) {
        record_hook("advance", at);
    }
}
