//! Effects that the catalogue does not have, written against the mechanism alone.

use std::cell::RefCell;

use model_core::effect_set;
use model_core::effects::card::{Card, Scope, Seam};
use model_core::effects::electrical::supply_sag::{self, SupplySag};
use model_core::effects::seams::{Body, Bridge, Contact, EffectContext, Gear, Sense, StepOutcome, Supply, Winding};
use model_core::effects::{Hooks, Needs, Numbers, State};

use crate::blank_card::BLANK;

/// A number that is kept.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Kept(pub f64);

impl Numbers<f64> for Kept {
    fn for_each_mut(&mut self, mut visit: impl FnMut(&mut f64)) {
        visit(&mut self.0);
    }
}

impl State<f64> for Kept {
    fn start() -> Self {
        Self(0.0)
    }
}

effect_set! {
    /// The effects invented here, and one of the catalogue to go along with them.
    pub enum Invented, InventedState [] [f64] {
        Cogging(Cogging, &const { Card { seams: &[Seam::Gear], ..BLANK } }),
        Carpet(Carpet, &const { Card { seams: &[Seam::Body], scope: Scope::Robot, ..BLANK } }),
        Wind(Wind, &const { Card { seams: &[Seam::Body], scope: Scope::Robot, ..BLANK } }),
        Heating(Heating, &const { Card { seams: &[Seam::Winding], ..BLANK } }),
        Inductance(Inductance, &const { Card { seams: &[Seam::Winding], ..BLANK } }),
        Emptying(Emptying, &const { Card { seams: &[Seam::Supply], scope: Scope::Robot, ..BLANK } }),
        Limit(Limit, &const { Card { seams: &[Seam::Bridge], ..BLANK } }),
        LargeWheel(LargeWheel, &const { Card { seams: &[Seam::Contact], ..BLANK } }),
        Glass(Glass, &const { Card { seams: &[Seam::Contact], ..BLANK } }),
        Eccentric(Eccentric, &const { Card { seams: &[Seam::Sense], ..BLANK } }),
        GyroScale(GyroScale, &const { Card { seams: &[Seam::Sense], scope: Scope::Robot, ..BLANK } }),
        GyroOffset(GyroOffset, &const { Card { seams: &[Seam::Sense], scope: Scope::Robot, ..BLANK } }),
        WheelSpy(WheelSpy, &const { Card { seams: &[Seam::Bridge, Seam::Winding, Seam::Gear, Seam::Contact, Seam::Sense], ..BLANK } }),
        RobotSpy(RobotSpy, &const { Card { seams: &[Seam::Supply, Seam::Body, Seam::Sense], scope: Scope::Robot, ..BLANK } }),
        SupplySag(SupplySag<f64>, &supply_sag::CARD),
    }
}

/// Teeth of the motor that pull the wheel into 18 places a turn: τ += x·sin(18·angle).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cogging(pub f64);

impl Hooks<f64> for Cogging {
    type State = ();
    const NEEDS: Needs = Needs { angle: true, ..Needs::NOTHING };

    fn gear(&self, _: &(), at: &EffectContext<f64>, x: &mut Gear<f64>) {
        x.torque += self.0 * (18.0 * at.wheel_angle).sin_cos().0;
    }
}

/// A carpet on the half of the floor beyond x = 0.2 m, where the body's Coulomb friction is (1 + x) times as large.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Carpet(pub f64);

impl Hooks<f64> for Carpet {
    type State = ();

    fn body(&self, _: &(), at: &EffectContext<f64>, x: &mut Body<f64>) {
        if at.pose.x > 0.2 {
            x.budget = x.budget.map(|b| b * (1.0 + self.0));
        }
    }
}

/// A wind along the world's x axis: a force of x [N].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wind(pub f64);

impl Hooks<f64> for Wind {
    type State = ();

    fn body(&self, _: &(), at: &EffectContext<f64>, x: &mut Body<f64>) {
        let (sin, cos) = at.pose.theta.sin_cos();
        x.force[0] += self.0 * cos;
        x.force[1] -= self.0 * sin;
    }
}

/// A winding that warms up: R·(1 + x·s), where s rises with i² and falls with 1 s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Heating(pub f64);

impl Hooks<f64> for Heating {
    type State = Kept;

    fn winding(&self, s: &Kept, _: &EffectContext<f64>, x: &mut Winding<f64>) {
        x.resistance *= 1.0 + self.0 * s.0;
    }
    fn advance(&self, s: &mut Kept, at: &EffectContext<f64>, done: &StepOutcome<f64>) {
        s.0 += at.dt * (done.current * done.current - s.0);
    }
    fn restart(&self, s: &mut Kept, at: &EffectContext<f64>) {
        // as if it had run at this speed for long
        s.0 = at.wheel_speed.abs();
    }
}

/// A winding with an inductance of x [mH].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Inductance(pub f64);

impl Hooks<f64> for Inductance {
    type State = ();

    fn winding(&self, _: &(), _: &EffectContext<f64>, x: &mut Winding<f64>) {
        x.inductance += 1e-3 * self.0;
    }
}

/// A battery that empties: its voltage has fallen by x for every ampere-second drawn [V/(A·s)].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Emptying(pub f64);

impl Hooks<f64> for Emptying {
    type State = Kept;

    fn supply(&self, s: &Kept, _: &EffectContext<f64>, x: &mut Supply<f64>) {
        x.voltage -= self.0 * s.0;
    }
    fn advance(&self, s: &mut Kept, at: &EffectContext<f64>, done: &StepOutcome<f64>) {
        s.0 += at.dt * done.bus_current;
    }
}

/// A bridge that is cut at a part x of the bus voltage, from 20 ms on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limit(pub f64);

impl Hooks<f64> for Limit {
    type State = ();

    fn bridge(&self, _: &(), at: &EffectContext<f64>, x: &mut Bridge<f64>) {
        if at.time > 0.0195 {
            let most = self.0 * x.bus;
            x.voltage = x.voltage.clamp(-most, most);
            x.sampled = x.sampled.clamp(-most, most);
        }
    }
}

/// A wheel whose radius is larger by the part x.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LargeWheel(pub f64);

impl Hooks<f64> for LargeWheel {
    type State = ();

    fn contact(&self, _: &(), _: &EffectContext<f64>, x: &mut Contact<f64>) {
        x.radius *= 1.0 + self.0;
    }
}

/// A floor so slippery that it holds the part x of a wheel's load; it looks at the wheel's angle, and finds nothing there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Glass(pub f64);

impl Hooks<f64> for Glass {
    type State = ();
    const NEEDS: Needs = Needs { angle: true, ..Needs::NOTHING };

    fn contact(&self, _: &(), _: &EffectContext<f64>, x: &mut Contact<f64>) {
        (x.grip, x.stiffness, x.shape) = (self.0, 30.0, 1.0);
    }
}

/// An encoder that reads x times the wheel's angle on top of its speed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Eccentric(pub f64);

impl Hooks<f64> for Eccentric {
    type State = ();
    const NEEDS: Needs = Needs { angle: true, ..Needs::NOTHING };

    fn sense(&self, _: &(), at: &EffectContext<f64>, x: &mut Sense<f64>) {
        x.wheel_speed += self.0 * at.wheel_angle;
    }
}

thread_local! {
    /// What the spies were told: which hook, and where.
    pub static SEEN: RefCell<Vec<(&'static str, EffectContext<f64>)>> = const { RefCell::new(Vec::new()) };
}

fn record_hook(hook: &'static str, at: &EffectContext<f64>) {
    SEEN.with_borrow_mut(|seen| seen.push((hook, *at)));
}

/// A gyro that reads x times too much: ω ← x·ω.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GyroScale(pub f64);

impl Hooks<f64> for GyroScale {
    type State = ();

    fn sense(&self, _: &(), _: &EffectContext<f64>, x: &mut Sense<f64>) {
        x.gyro *= self.0;
    }
    fn invert_sensing(&self, _: &EffectContext<f64>, x: &mut Sense<f64>) {
        x.gyro /= self.0;
    }
}

/// A gyro that reads x [rad/s] more: ω ← ω + x.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GyroOffset(pub f64);

impl Hooks<f64> for GyroOffset {
    type State = ();

    fn sense(&self, _: &(), _: &EffectContext<f64>, x: &mut Sense<f64>) {
        x.gyro += self.0;
    }
    fn invert_sensing(&self, _: &EffectContext<f64>, x: &mut Sense<f64>) {
        x.gyro -= self.0;
    }
}

/// A spy on wheels: it changes nothing, and remembers what it is told.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WheelSpy;

impl Hooks<f64> for WheelSpy {
    type State = Kept;
    const NEEDS: Needs = Needs { angle: true, ..Needs::NOTHING };

    fn bridge(&self, _: &Kept, at: &EffectContext<f64>, _: &mut Bridge<f64>) {
        record_hook("drive", at);
    }
    fn winding(&self, _: &Kept, at: &EffectContext<f64>, _: &mut Winding<f64>) {
        record_hook("winding", at);
    }
    fn gear(&self, _: &Kept, at: &EffectContext<f64>, _: &mut Gear<f64>) {
        record_hook("gear", at);
    }
    fn contact(&self, _: &Kept, at: &EffectContext<f64>, _: &mut Contact<f64>) {
        record_hook("contact", at);
    }
    fn sense(&self, _: &Kept, at: &EffectContext<f64>, _: &mut Sense<f64>) {
        record_hook("sense", at);
    }
    fn advance(&self, _: &mut Kept, at: &EffectContext<f64>, _: &StepOutcome<f64>) {
        record_hook("advance", at);
    }
}

/// A spy on the robot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RobotSpy;

impl Hooks<f64> for RobotSpy {
    type State = Kept;
    const NEEDS: Needs = Needs { angle: true, ..Needs::NOTHING };

    fn supply(&self, _: &Kept, at: &EffectContext<f64>, _: &mut Supply<f64>) {
        record_hook("supply", at);
    }
    fn body(&self, _: &Kept, at: &EffectContext<f64>, _: &mut Body<f64>) {
        record_hook("body", at);
    }
    fn sense(&self, _: &Kept, at: &EffectContext<f64>, _: &mut Sense<f64>) {
        record_hook("sense", at);
    }
    fn advance(&self, _: &mut Kept, at: &EffectContext<f64>, _: &StepOutcome<f64>) {
        record_hook("advance", at);
    }
}
