//! # Oddities: physics that no entry of the diagnosis's catalogue describes
//!
//! Each is a law of its own: on the body (`load`, `towed`, `gusts`, `floor`), on what feeds it (`converter`, `drive`), or on
//! one wheel (`wheel`, some of it in `spells`). What is out of order in sensors is elsewhere (`misread`). Here stands which
//! of them a robot has, and what they remember.

pub mod converter;
pub mod drive;
pub mod floor;
pub mod gusts;
pub mod load;
pub mod spells;
pub mod towed;
pub mod wheel;

use nalgebra::Vector2;

use crate::oddities::converter::{Converter, Converting};
use crate::oddities::drive::{Foldback, Strain, to_level};
use crate::oddities::floor::{Planks, Ridge};
use crate::oddities::gusts::Gusts;
use crate::oddities::load::{Load, Swing};
use crate::oddities::towed::Towed;
use crate::oddities::wheel::{Hub, LostPhase, Tooth};
use crate::shaft::Twisted;

/// What a robot has of them; by default nothing.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Oddities {
    /// The time of the room when the robot's begins [s]: wind and spells go by that
    pub clock: f64,
    /// A load that swings.
    pub load: Option<Load>,
    /// A weight on a string.
    pub towed: Option<Towed>,
    /// Wind.
    pub gusts: Option<Gusts>,
    /// What lies on the floor.
    pub ridge: Option<Ridge>,
    /// A floor of planks.
    pub planks: Option<Planks>,
    /// A slow converter behind the battery.
    pub converter: Option<Converter>,
    /// How far levels of the command are apart [V]; 0 where it has none
    pub levels: f64,
    /// Below what command bridges let go [V]
    pub coasts_below: f64,
    /// Drives that spare their motors.
    pub foldback: Option<Foldback>,
    /// A damaged tooth.
    pub tooth: Option<Tooth>,
    /// A hub that slips.
    pub hub: Option<Hub>,
    /// A phase that is lost now and then.
    pub lost_phase: Option<LostPhase>,
}

/// What they remember from one step to the next.
#[derive(Debug, Default, PartialEq)]
pub struct Memory {
    /// Of the load.
    pub swing: Swing,
    /// How far the weight on the string has been dragged [m]
    pub dragged: Vector2<f64>,
    /// Of the converter.
    pub converting: Converting,
    /// How far the hub has slipped [rad]
    pub slipped: f64,
    /// What each drive thinks of its motor.
    pub strains: Vec<Strain>,
}

impl Memory {
    /// At rest in the origin, with so many wheels.
    pub fn at_rest(wheels: usize) -> Self {
        Self { strains: vec![Strain::default(); wheels], ..Self::default() }
    }
}

impl Clone for Memory {
    fn clone(&self) -> Self {
        let mut new = Self::default();
        new.clone_from(self);
        new
    }

    /// Without asking for memory, where there is enough: it is done every step.
    fn clone_from(&mut self, from: &Self) {
        // named one by one, so that none is forgotten
        let Self { swing, dragged, converting, slipped, strains } = from;
        (self.swing, self.dragged, self.converting, self.slipped) = (*swing, *dragged, *converting, *slipped);
        self.strains.clone_from(strains);
    }
}

impl Oddities {
    /// What drives make of voltages that they are told [V].
    pub fn hear(&self, memory: &Memory, heard: &mut [f64]) {
        if let Some(foldback) = self.foldback {
            let spared = heard.iter_mut().zip(&memory.strains).filter(|(_, strain)| strain.spared);
            spared.for_each(|(u, _)| *u *= foldback.share);
        }
        if self.levels > 0.0 {
            heard.iter_mut().for_each(|u| *u = to_level(*u, self.levels));
        }
    }

    /// Whether a robot has any.
    pub fn any(&self) -> bool {
        *self != Self { clock: self.clock, ..Self::default() }
    }

    /// What is left of the voltages in wheel j's motor [1] under what its bridge hears [V], at a time since the beginning [s]
    /// and an angle of its rotor [rad].
    pub fn leaves(&self, j: usize, heard: f64, (time, angle): (f64, f64)) -> f64 {
        match &self.lost_phase {
            _ if heard.abs() < self.coasts_below => 0.0,
            Some(lost) if lost.wheel == j => lost.leaves(self.clock + time, angle),
            _ => 1.0,
        }
    }

    /// What the battery gives [A] of a current that bridges draw [A].
    pub fn supplied(&self, drawn: f64, memory: &Memory) -> f64 {
        if self.converter.is_some() { memory.converting.current } else { drawn }
    }

    /// What a tooth of wheel j adds to a torque [N·m], at an angle of the wheel [rad].
    pub fn over_tooth(&self, j: usize, torque: f64, angle: f64) -> f64 {
        match self.tooth {
            Some(tooth) if tooth.wheel == j => torque + tooth.torque(angle),
            _ => torque,
        }
    }

    /// What the hub of wheel j leaves of its shaft's torque, at a speed between wheel and rotor [rad/s].
    pub fn through_hub(&self, j: usize, twisted: Twisted, speed: f64) -> Twisted {
        match self.hub {
            Some(hub) if hub.wheel == j => hub.limited(twisted, speed),
            _ => twisted,
        }
    }

    /// How far the hub of wheel j has slipped [rad].
    pub fn slipped(&self, j: usize, memory: &Memory) -> f64 {
        if self.hub.is_some_and(|hub| hub.wheel == j) { memory.slipped } else { 0.0 }
    }
}
