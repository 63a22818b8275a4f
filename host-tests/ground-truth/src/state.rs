//! What a robot remembers from one step to the next.

use nalgebra::{Vector2, Vector3};

use crate::oddities::Memory;
use crate::speed_drive::Driving;

/// The state of a simulated robot; of the body, it is that of the point that is followed.
#[derive(Debug, Default, PartialEq)]
pub struct State {
    /// [s]
    pub time: f64,
    /// Where the point is in the world [m]
    pub position: Vector2<f64>,
    /// θ, not wrapped [rad]
    pub heading: f64,
    /// v, vn, ω of the point along the body's axes [m/s, m/s, rad/s]
    pub twist: Vector3<f64>,
    /// By how much that changed over the last step, per time
    pub twist_rate: Vector3<f64>,
    /// Speeds of each wheel and of its rotor, as the wheel would see that behind a rigid gear [rad/s]
    pub shafts: Vec<Vector2<f64>>,
    /// By how much these have turned [rad]
    pub turned: Vec<Vector2<f64>>,
    /// Currents [A]; of a winding without inductance that of the middle of the last step
    pub currents: Vec<f64>,
    /// Of each motor's winding and housing, above the air's [K]
    pub temperatures: Vec<[f64; 2]>,
    /// Force with which each contact patch is strained [N]
    pub strained: Vec<f64>,
    /// The same of what gives between body and floor, along v, vn and about the centre [N, N, N·m]
    pub given: Vector3<f64>,
    /// What the battery has lost by polarisation [V]
    pub polarisation: f64,
    /// What drives remember that control speed.
    pub driving: Driving,
    /// What oddities remember.
    pub memory: Memory,
}

impl State {
    /// At rest in the origin, with so many wheels.
    pub fn at_rest(wheels: usize) -> Self {
        Self {
            shafts: vec![Vector2::zeros(); wheels],
            turned: vec![Vector2::zeros(); wheels],
            currents: vec![0.0; wheels],
            temperatures: vec![[0.0; 2]; wheels],
            strained: vec![0.0; wheels],
            driving: Driving::at_rest(wheels),
            memory: Memory::at_rest(wheels),
            ..Self::default()
        }
    }
}

impl Clone for State {
    fn clone(&self) -> Self {
        let mut new = Self::default();
        new.clone_from(self);
        new
    }

    /// Without asking for memory, where there is enough: it is done every step.
    fn clone_from(&mut self, from: &Self) {
        // named one by one, so that none is forgotten
        let Self {
            time,
            position,
            heading,
            twist,
            twist_rate,
            shafts,
            turned,
            currents,
            temperatures,
            strained,
            given,
            polarisation,
            driving,
            memory,
        } = from;
        (self.time, self.position, self.heading) = (*time, *position, *heading);
        (self.twist, self.twist_rate) = (*twist, *twist_rate);
        self.shafts.clone_from(shafts);
        self.turned.clone_from(turned);
        self.currents.clone_from(currents);
        self.temperatures.clone_from(temperatures);
        self.strained.clone_from(strained);
        (self.given, self.polarisation) = (*given, *polarisation);
        self.driving.clone_from(driving);
        self.memory.clone_from(memory);
    }
}
