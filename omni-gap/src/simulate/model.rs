//! A model: the robot of a file, factors on its nominal values, and the effects that it carries.

use std::sync::Arc;

use model_core::effects::EffectKind;
use model_core::effects::active::Effects;
use model_core::effects::card::{Card, Role};
use model_core::geometry::kinematics::{Wheel, Wheels};
use model_core::number::scalar::Real;
use model_core::plant::Plant;
use model_core::plant::robot::{Friction, Nominal, Robot};
use model_core::plant::winding::Motor;

use super::keys::NOMINAL_KEYS;
use crate::log::{Change, EffectEntry, RobotFile};

/// Effects that a diagnosis may add to those of a robot file: the causes found, and the one that is being tried.
pub const ROOM_FOR_CAUSES: usize = 4;

/// An effect in a model.
#[derive(Clone, Debug, PartialEq)]
pub struct EffectInstance {
    /// Its page.
    pub id: &'static str,
    /// The wheel that it sits on alone; `None`: on all, or on the robot.
    pub wheel: Option<usize>,
    /// Its parameters in the order of its card, in SI units.
    pub params: Vec<f64>,
}

impl EffectInstance {
    /// The effect of a robot file; what the file does not state of it is typical. None where the catalogue lacks it.
    pub fn of(entry: &EffectEntry) -> Option<Self> {
        let card = EffectKind::find(&entry.id)?.card();
        let params = card.params.iter().map(|p| entry.params.get(p.key).copied().unwrap_or(p.typical)).collect();
        Some(EffectInstance { id: card.id, wheel: entry.wheel, params })
    }

    /// A number by its key; zero where the effect has none of that name.
    pub fn number(&self, key: &str) -> f64 {
        let at = self.card().params.iter().position(|p| p.key == key);
        at.map_or(0.0, |at| self.params[at])
    }

    /// The effect at its typical size.
    pub fn typical(card: &'static Card, wheel: Option<usize>) -> Self {
        Self { id: card.id, wheel, params: card.params.iter().map(|p| p.typical).collect() }
    }

    /// The effect at a size at which it does nothing.
    pub fn absent(card: &'static Card, wheel: Option<usize>) -> Self {
        Self { id: card.id, wheel, params: card.params.iter().map(|p| p.absent).collect() }
    }

    /// Its page.
    pub fn card(&self) -> &'static Card {
        EffectKind::find(self.id).expect("the id of a carried effect is one of the catalogue").card()
    }
}

/// A number of a model that a fit may free.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Slot {
    /// The factor on a nominal value.
    Nominal(Nominal),
    /// A parameter of a carried effect: (place in [`Model::effects`], place in its card).
    Param(usize, usize),
}

/// What files describe: a robot with `N` wheels, factors on its nominal values, and effects.
#[derive(Clone, Debug)]
pub struct Model<const N: usize> {
    file: Arc<RobotFile>,
    robot: Robot<N, f64>,
    /// Factors on the nominal values, in the order of [`Nominal::ALL`].
    pub factor: [f64; Nominal::COUNT],
    /// The effects, in the order of the catalogue.
    pub effects: Vec<EffectInstance>,
}

/// The plain robot of a file, in any number type.
///
/// `supply` is the voltage to assume where the file states none [V].
pub fn robot_of<const N: usize, T: Real>(file: &RobotFile, supply: f64) -> Robot<N, T> {
    let wheels = std::array::from_fn(|j| {
        let wheel = &file.wheel[j];
        Wheel::from_degrees(wheel.drive_angle_deg, T::lit(wheel.distance_m), T::lit(wheel.radius_m))
    });
    let friction = &file.friction;
    Robot {
        wheels: Wheels::new(wheels),
        motor: Motor {
            gear_ratio: T::lit(file.motor.gear_ratio),
            resistance: T::lit(file.motor.resistance_ohm),
            emf_constant: T::lit(file.motor.emf_constant_v_s),
            torque_constant: T::lit(file.motor.torque_constant_nm_per_a),
        },
        mass: T::lit(file.body.mass_kg),
        inertia: T::lit(file.body.inertia_kg_m2),
        friction: Friction {
            viscous: [friction.viscous_v_n_s_per_m, friction.viscous_vn_n_s_per_m, friction.viscous_w_nm_s].map(T::lit),
            coulomb: [friction.coulomb_v_n, friction.coulomb_vn_n, friction.coulomb_w_nm].map(T::lit),
        },
        supply: T::lit(file.supply.map_or(supply, |s| s.voltage_v)),
    }
}

impl<const N: usize> Model<N> {
    /// The nominal model of a robot file: factors of one and the effects that the file names.
    pub fn nominal(file: &RobotFile, supply: f64) -> Self {
        let robot = robot_of(file, supply);
        let mut model =
            Self { file: Arc::new(file.clone()), robot, factor: [1.0; Nominal::COUNT], effects: Vec::new() };
        for entry in &file.effects {
            if let Some(effect) = EffectInstance::of(entry) {
                model.add_effect(effect);
            }
        }
        model
    }

    /// What it changes in the file of its robot.
    pub fn changes(&self) -> Vec<Change> {
        let numbers = NOMINAL_KEYS.iter().flat_map(|key| key.scaled(&self.file, key.factor(&self.factor)));
        let effect = |effect: &EffectInstance| {
            let params = effect.card().params.iter().zip(&effect.params).map(|(p, x)| (p.key.to_owned(), *x)).collect();
            Change::Effect(EffectEntry { id: effect.id.to_owned(), wheel: effect.wheel, params })
        };
        numbers.chain(self.effects.iter().map(effect)).collect()
    }

    /// The robot, factors not applied.
    pub fn robot(&self) -> &Robot<N, f64> {
        &self.robot
    }

    /// Adds an effect at its place in the order of the catalogue, and returns that place.
    pub fn add_effect(&mut self, effect: EffectInstance) -> usize {
        let order = |id: &str| EffectKind::ALL.iter().position(|e| e.id() == id);
        let at = self.effects.partition_point(|e| order(e.id) <= order(effect.id));
        self.effects.insert(at, effect);
        at
    }

    /// The number in a slot.
    pub fn get(&self, slot: Slot) -> f64 {
        match slot {
            Slot::Nominal(p) => self.factor[p as usize],
            Slot::Param(effect, param) => self.effects[effect].params[param],
        }
    }

    /// Puts a number into a slot.
    pub fn set(&mut self, slot: Slot, value: f64) {
        match slot {
            Slot::Nominal(p) => self.factor[p as usize] = value,
            Slot::Param(effect, param) => self.effects[effect].params[param] = value,
        }
    }

    /// True if the number in a slot is a limit, of which zero stands for none.
    pub fn is_limit(&self, slot: Slot) -> bool {
        let Slot::Param(effect, param) = slot else { return false };
        let card = self.effects[effect].card();
        card.physics.is_limit && card.params[param].role == Role::Size
    }

    /// The plant, in plain numbers.
    pub fn plant(&self) -> Plant<N, f64> {
        self.plant_with(|_, x| x)
    }

    /// The plant in any number type; `lift` makes such a number of each slot's value.
    pub fn plant_with<T: Real>(&self, lift: impl Fn(Slot, f64) -> T) -> Plant<N, T> {
        let factor = std::array::from_fn(|k| lift(Slot::Nominal(Nominal::ALL[k]), self.factor[k]));
        let robot = robot_of::<N, T>(&self.file, self.robot.supply).scaled(&factor);
        let mut carried = Effects::default();
        for (at, effect) in self.effects.iter().enumerate() {
            let params: Vec<T> = effect.params.iter().enumerate().map(|(p, x)| lift(Slot::Param(at, p), *x)).collect();
            let kind = EffectKind::find(effect.id).expect("the id of a carried effect is one of the catalogue");
            // a file is refused that leaves no room for what a diagnosis adds
            let added = carried.add(kind, effect.wheel, &params);
            added.unwrap_or_else(|why| unreachable!("{} was checked when its file was read: {why:?}", effect.id));
        }
        Plant::new(robot, carried)
    }
}
