//! An effect touches the seams that its card lists, and no other.

use host_tests::excitation::SeededRng;
use model_core::effects::card::Seam;
use model_core::effects::seams::{
    Body, Bridge, Contact, EffectContext, Gear, Sense, Shaft, SpeedDrive, StepOutcome, Supply, Winding,
};
use model_core::effects::telegram::{Command, Delivery};
use model_core::effects::{Effect, EffectKind, EffectSet, EffectState};
use model_core::geometry::frames::{BodyTwist, Pose};

use crate::fixture::typical;

/// A description whose numbers are random but physical.
pub trait Described: Clone {
    /// One of them.
    fn random(rng: &mut SeededRng) -> Self;
    /// All its numbers.
    fn numbers(&self) -> Vec<f64>;
}

fn pose(rng: &mut SeededRng) -> Pose<f64> {
    Pose { x: rng.between(-2.0, 2.0), y: rng.between(-2.0, 2.0), theta: rng.between(-7.0, 7.0) }
}

/// What an effect could be told.
pub fn at(rng: &mut SeededRng) -> EffectContext<f64> {
    let time = rng.between(0.0, 20.0);
    EffectContext {
        time,
        dt: rng.between(1e-4, 5e-3),
        wheel: rng.below(3) as usize,
        wheel_angle: rng.between(-50.0, 50.0),
        wheel_speed: rng.between(-60.0, 60.0),
        rotor_angle: rng.between(-50.0, 50.0),
        rotor_speed: rng.between(-60.0, 60.0),
        rim_speed: rng.between(-2.0, 2.0),
        heat: rng.between(0.0, 500.0),
        gear_ratio: rng.between(1.0, 20.0),
        reach: rng.between(0.05, 0.5),
        pose: pose(rng),
        twist: BodyTwist { v: rng.between(-2.0, 2.0), vn: rng.between(-2.0, 2.0), w: rng.between(-9.0, 9.0) },
        acceleration: [(); 3].map(|()| rng.between(-5.0, 5.0)),
        bus: rng.between(9.0, 13.0),
        nominal_supply: 12.0,
    }
}

impl Described for Command<f64> {
    fn random(rng: &mut SeededRng) -> Self {
        let sent = rng.between(-12.0, 12.0);
        Self { sent, arrived: sent }
    }
    fn numbers(&self) -> Vec<f64> {
        vec![self.sent, self.arrived]
    }
}

impl Described for SpeedDrive<f64> {
    fn random(rng: &mut SeededRng) -> Self {
        Self::following(rng.between(-40.0, 40.0))
    }
    fn numbers(&self) -> Vec<f64> {
        vec![self.command, self.before, self.mean, self.after]
    }
}

impl Described for Supply<f64> {
    fn random(rng: &mut SeededRng) -> Self {
        Self { current: rng.between(-5.0, 20.0), voltage: rng.between(9.0, 13.0) }
    }
    fn numbers(&self) -> Vec<f64> {
        vec![self.current, self.voltage]
    }
}

impl Described for Bridge<f64> {
    fn random(rng: &mut SeededRng) -> Self {
        let voltage = rng.between(-12.0, 12.0);
        let current = rng.between(-4.0, 4.0);
        Self {
            command: voltage,
            bus: 12.0,
            current,
            voltage,
            sampled: voltage,
            drop: 0.1,
            braking_drop: 0.1,
            drop_current: 0.02,
            current_limit: 3.0,
        }
    }
    fn numbers(&self) -> Vec<f64> {
        let Self { command, bus, current, voltage, sampled, drop, braking_drop, drop_current, current_limit } = *self;
        vec![command, bus, current, voltage, sampled, drop, braking_drop, drop_current, current_limit]
    }
}

impl Described for Winding<f64> {
    fn random(rng: &mut SeededRng) -> Self {
        Self {
            current: rng.between(-4.0, 4.0),
            speed: rng.between(-60.0, 60.0),
            resistance: rng.between(1.0, 6.0),
            inductance: rng.between(0.0, 1e-3),
            emf_constant: rng.between(0.05, 0.2),
            torque_constant: rng.between(0.05, 0.2),
            torque: rng.between(-0.01, 0.01),
            torque_bend: rng.between(-1e-3, 0.0),
        }
    }
    fn numbers(&self) -> Vec<f64> {
        let Self { current, speed, resistance, inductance, emf_constant, torque_constant, torque, torque_bend } = *self;
        vec![current, speed, resistance, inductance, emf_constant, torque_constant, torque, torque_bend]
    }
}

impl Described for Shaft<f64> {
    fn random(rng: &mut SeededRng) -> Self {
        Self {
            inertia: rng.between(0.0, 1e-4),
            stiffness: rng.between(0.0, 50.0),
            damping: rng.between(0.0, 1e-2),
            play: rng.between(0.0, 0.05),
            rotor: rng.between(0.0, 1e-4),
        }
    }
    fn numbers(&self) -> Vec<f64> {
        vec![self.inertia, self.stiffness, self.damping, self.play, self.rotor]
    }
}

impl Described for Gear<f64> {
    fn random(rng: &mut SeededRng) -> Self {
        let torque = rng.between(-0.5, 0.5);
        Self {
            motor_torque: torque,
            coulomb_share: rng.between(0.0, 0.05),
            torque,
            budget: rng.between(0.05, 0.1),
            bias: rng.between(-0.05, 0.05),
            damping: rng.between(0.0, 1e-3),
            inertia: rng.between(0.0, 1e-4),
        }
    }
    fn numbers(&self) -> Vec<f64> {
        let Self { motor_torque, coulomb_share, torque, budget, bias, damping, inertia } = *self;
        vec![motor_torque, coulomb_share, torque, budget, bias, damping, inertia]
    }
}

impl Described for Contact<f64> {
    fn random(rng: &mut SeededRng) -> Self {
        let (sin, cos) = rng.between(-3.0, 3.0).sin_cos();
        let radius = rng.between(0.02, 0.05);
        Self {
            row: [cos, sin, 0.089],
            radius,
            per_radius: 1.0 / radius,
            load: rng.between(3.0, 9.0),
            load_shift: [rng.between(-2.0, 2.0), rng.between(-2.0, 2.0)],
            creep: rng.between(0.0, 0.02),
            shape: 1.0,
            position: [0.089 * sin, -0.089 * cos],
            roller_friction: rng.between(0.0, 0.5),
            roller_damping: rng.between(0.0, 0.5),
            inertia: rng.between(0.0, 1e-4),
            ..Contact::default()
        }
    }
    fn numbers(&self) -> Vec<f64> {
        let [a, b, c] = self.row;
        let mut all = vec![a, b, c, self.radius, self.load, self.creep, self.grip, self.stiffness, self.shape];
        all.extend(self.position.into_iter().chain(self.load_shift).chain([
            self.roller_friction,
            self.roller_damping,
            self.inertia,
        ]));
        all
    }
}

impl Described for Body<f64> {
    fn random(rng: &mut SeededRng) -> Self {
        let mut three = |most: f64| [(); 3].map(|()| rng.between(-most, most));
        let (force, rate, budget) = (three(5.0), [three(1.0), three(1.0), three(1.0)], three(2.0).map(f64::abs));
        let mass = rng.between(1.0, 4.0);
        let mass = [[mass, 0.0, 0.0], [0.0, mass, 0.0], [0.0, 0.0, rng.between(0.01, 0.03)]];
        Self { mass, force, rate, budget }
    }
    fn numbers(&self) -> Vec<f64> {
        let mut all: Vec<f64> = self.mass.iter().flatten().copied().collect();
        all.extend(self.force.iter().chain(self.rate.iter().flatten()).chain(&self.budget));
        all
    }
}

impl Described for Sense<f64> {
    fn random(rng: &mut SeededRng) -> Self {
        Self {
            current: rng.between(-4.0, 4.0),
            wheel_speed: rng.between(-60.0, 60.0),
            pose: pose(rng),
            gyro: rng.between(-9.0, 9.0),
        }
    }
    fn numbers(&self) -> Vec<f64> {
        vec![self.current, self.wheel_speed, self.pose.x, self.pose.y, self.pose.theta, self.gyro]
    }
}

/// True if the hook changed any bit of any of 50 random descriptions.
fn touches<D: Described>(seed: u64, hook: impl Fn(&EffectContext<f64>, &mut D)) -> bool {
    let mut rng = SeededRng::new(seed);
    (0..50).any(|_| {
        let at = at(&mut rng);
        let before = D::random(&mut rng);
        let mut after = before.clone();
        hook(&at, &mut after);
        let bits = |d: &D| d.numbers().into_iter().map(f64::to_bits).collect::<Vec<_>>();
        bits(&before) != bits(&after)
    })
}

/// A telegram that a record shows as lost for certain, one of ten.
pub const LOST: Option<Delivery> = Some(Delivery::Shown(10.0));

/// When the hooks are asked: when a run has gone on long enough for what grows with time to show [s].
pub const NOW: f64 = 10.0;

/// A memory as it is after some steps, just before then.
pub fn remembered(effect: &Effect<f64>, rng: &mut SeededRng) -> Vec<EffectState<f64>> {
    let mut s: Vec<_> = effect.start().into_iter().collect();
    effect.restart(&mut s, &EffectContext { time: NOW - 0.1, ..at(rng) });
    for k in 0..40 {
        let done = StepOutcome {
            command: rng.between(-9.0, 9.0),
            set_speed: rng.between(-40.0, 40.0),
            current: rng.between(-3.0, 3.0),
            wheel_speed: rng.between(-50.0, 50.0),
            heat: rng.between(0.0, 0.1),
            bus_current: rng.between(-1.0, 9.0),
            mean_twist: BodyTwist { v: rng.between(-2.0, 2.0), vn: rng.between(-2.0, 2.0), w: rng.between(-9.0, 9.0) },
            bus: 12.0,
        };
        effect.advance(&mut s, &EffectContext { time: NOW - 0.1 + 2.5e-3 * f64::from(k), ..at(rng) }, &done);
    }
    s
}

#[test]
fn hooks_that_a_card_does_not_list_change_nothing_and_those_it_lists_do() {
    for (k, effect) in EffectKind::ALL.iter().enumerate() {
        let card = effect.card();
        let mut rng = SeededRng::new(k as u64);
        let effect = effect.with(&typical(card)).expect("as many as on the card");
        let s = remembered(&effect, &mut rng);
        let seed = rng.bits();
        // the description is asked just after what is remembered
        let now = |at: &EffectContext<f64>| EffectContext { time: NOW, ..*at };
        for seam in Seam::ALL {
            let touched = match seam {
                Seam::Command => touches(seed, |_, x| effect.command(&mut s.clone(), LOST, x)),
                Seam::SpeedDrive => touches(seed, |at, x| effect.speed_drive(&s, &now(at), x)),
                Seam::Supply => touches(seed, |at, x| effect.supply(&s, &now(at), x)),
                Seam::Bridge => touches(seed, |at, x| effect.bridge(&s, &now(at), x)),
                Seam::Winding => touches(seed, |at, x| effect.winding(&s, &now(at), x)),
                Seam::Shaft => touches(seed, |at, x| effect.shaft(&s, &now(at), x)),
                Seam::Gear => touches(seed, |at, x| effect.gear(&s, &now(at), x)),
                Seam::Contact => touches(seed, |at, x| effect.contact(&s, &now(at), x)),
                Seam::Body => touches(seed, |at, x| effect.body(&s, &now(at), x)),
                Seam::Sense => touches(seed, |at, x| effect.sense(&s, &now(at), x)),
            };
            let listed = card.seams.contains(&seam);
            assert_eq!(touched, listed, "{} at {seam:?}: touches it? {touched}; its card lists it? {listed}", card.id);
        }
    }
}

#[test]
fn a_hook_is_a_pure_function_of_what_it_is_given() {
    for effect in &EffectKind::ALL {
        let effect = effect.with(&typical(effect.card())).expect("as many as on the card");
        let s = remembered(&effect, &mut SeededRng::new(1));
        let twice: Vec<_> = (0..2)
            .map(|_| {
                let mut rng = SeededRng::new(4);
                let at = at(&mut rng);
                let (mut drive, mut gear) = (Bridge::random(&mut rng), Gear::random(&mut rng));
                let (mut contact, mut sense) = (Contact::random(&mut rng), Sense::random(&mut rng));
                effect.bridge(&s, &at, &mut drive);
                effect.gear(&s, &at, &mut gear);
                effect.contact(&s, &at, &mut contact);
                effect.sense(&s, &at, &mut sense);
                [drive.numbers(), gear.numbers(), contact.numbers(), sense.numbers()].concat()
            })
            .collect();
        assert_eq!(twice[0], twice[1], "{}", effect.card().id);
    }
}

#[test]
fn only_a_law_that_says_so_looks_at_the_current() {
    for effect in &EffectKind::ALL {
        let card = effect.card();
        let effect = effect.with(&typical(card)).expect("as many as on the card");
        let s = remembered(&effect, &mut SeededRng::new(2));
        let mut rng = SeededRng::new(6);
        let looks = (0..50).any(|_| {
            let at = EffectContext { time: NOW, ..at(&mut rng) };
            let (mut a, mut b) = (Bridge::random(&mut rng), Winding::random(&mut rng));
            // a law may look at the sign of the current, or at its size
            let other = rng.between(-4.0, 4.0);
            let (mut c, mut d) = (Bridge { current: other, ..a }, Winding { current: other, ..b });
            effect.bridge(&s, &at, &mut a);
            effect.bridge(&s, &at, &mut c);
            effect.winding(&s, &at, &mut b);
            effect.winding(&s, &at, &mut d);
            a.voltage != c.voltage || b.resistance != d.resistance || b.torque_constant != d.torque_constant
        });
        assert_eq!(looks, card.needs_current, "{}: looks at the current? {looks}", card.id);
    }
}

#[test]
fn sensing_and_its_way_back_undo_each_other() {
    for effect in EffectKind::ALL.iter().filter(|effect| effect.card().seams.contains(&Seam::Sense)) {
        let effect = effect.with(&typical(effect.card())).expect("as many as on the card");
        let mut rng = SeededRng::new(3);
        for _ in 0..50 {
            // constant velocity, straight on: the way back of a delay is exact there
            let mut here = at(&mut rng);
            here.twist.w = 0.0;
            let mut s: Vec<_> = effect.start().into_iter().collect();
            effect.restart(&mut s, &here);
            let truth = Sense { pose: here.pose, ..Sense::random(&mut rng) };
            let mut x = truth;
            effect.sense(&s, &here, &mut x);
            effect.invert_sensing(&here, &mut x);
            let off = truth.numbers().iter().zip(x.numbers()).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            // roundings of numbers up to 60
            assert!(off < 1e-12, "{}: {off:e}", effect.card().id);
        }
    }
}
