//! What a robot remembers from one step to the next.

use nalgebra::{Vector2, Vector3};

/// The state of a simulated robot; of the body, it is that of the point that is followed.
#[derive(Clone, Debug, Default, PartialEq)]
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
    /// Speeds of the wheels, then of the rotors as the wheels would see them behind a rigid gear [rad/s]
    pub shafts: Vec<f64>,
    /// By how much the wheels have turned [rad]
    pub turned: Vec<f64>,
    /// Currents [A]; of a winding without inductance that of the middle of the last step
    pub currents: Vec<f64>,
    /// Force with which each contact patch is strained [N]
    pub strained: Vec<f64>,
    /// By how much each elastic shaft is twisted, at the wheel [rad]
    pub windup: Vec<f64>,
    /// What the battery has lost by polarisation [V]
    pub polarisation: f64,
}

impl State {
    /// At rest in the origin, with so many wheels.
    pub fn at_rest(wheels: usize) -> Self {
        let still = vec![0.0; wheels];
        Self {
            shafts: vec![0.0; 2 * wheels],
            turned: still.clone(),
            currents: still.clone(),
            strained: still.clone(),
            windup: still,
            ..Self::default()
        }
    }
}
