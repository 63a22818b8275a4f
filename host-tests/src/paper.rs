//! # The paper's two robots (Table 3)
//!
//! One prototype that carries three or four wheels. Wheels, gears and motors are the same in both; mass, inertia and
//! friction are not. The paper takes Kt = Kv (SI units).

use crate::generic_robot::{Drivetrain, GenericRobot, Wheel};

/// One robot in the paper's own symbols.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PaperRobot {
    /// d, centre to wheel [m]
    pub d: f64,
    /// r, wheel radius [m]
    pub r: f64,
    /// l, gear ratio, motor turns per wheel turn [1]
    pub l: f64,
    /// Kv, electromotive constant at the motor shaft [V/(rad/s)]
    pub kv: f64,
    /// Kt, torque constant at the motor shaft [N·m/A]
    pub kt: f64,
    /// R, winding resistance [Ω]
    pub resistance: f64,
    /// M, mass [kg]
    pub mass: f64,
    /// J, inertia about the vertical [kg·m²]
    pub inertia: f64,
    /// Bv, Bvn, Bω, viscous friction [N/(m/s), N/(m/s), N·m/(rad/s)]
    pub viscous: [f64; 3],
    /// Cv, Cvn, Cω, Coulomb friction [N, N, N·m]
    pub coulomb: [f64; 3],
}

/// The robot on three wheels, Table 3.
pub const THREE_WHEELS: PaperRobot = PaperRobot {
    d: 0.089,
    r: 0.0325,
    l: 5.0,
    kv: 0.0259,
    kt: 0.0259,
    resistance: 4.3111,
    mass: 1.944,
    inertia: 0.0169,
    viscous: [0.5082, 0.4870, 0.0130],
    coulomb: [1.9068, 2.0423, 0.0971],
};

/// The robot on four wheels, Table 3.
pub const FOUR_WHEELS: PaperRobot = PaperRobot {
    mass: 2.34,
    inertia: 0.0228,
    viscous: [0.4978, 0.6763, 0.0141],
    coulomb: [1.8738, 2.2198, 0.1385],
    ..THREE_WHEELS
};

/// Drive angles of the three wheels [°], as eq. 2 implies them: wheel j rolls along (cos α, sin α) of (v, vn).
pub const THREE_HEADINGS_DEG: [f64; 3] = [150.0, 270.0, 30.0];

/// Drive angles of the four wheels [°], as eq. 6 implies them.
pub const FOUR_HEADINGS_DEG: [f64; 4] = [90.0, 180.0, 270.0, 0.0];

impl PaperRobot {
    /// The same robot with the bridges open: no current flows, whatever the voltage (R → ∞), as in experiment 2.
    pub fn open_bridge(self) -> Self {
        Self { resistance: f64::INFINITY, ..self }
    }

    /// The same robot with other body friction: viscous [N/(m/s), N/(m/s), N·m/(rad/s)], Coulomb [N, N, N·m].
    pub fn with_friction(self, viscous: [f64; 3], coulomb: [f64; 3]) -> Self {
        Self { viscous, coulomb, ..self }
    }

    /// Motor, gear and wheel, as every wheel of this robot has them.
    pub fn drivetrain(&self) -> Drivetrain {
        Drivetrain { radius: self.r, gear: self.l, kv: self.kv, kt: self.kt, resistance: self.resistance }
    }

    /// The robot as a list of wheels, for the derived matrices; one wheel for each drive angle [°].
    pub fn generic<const N: usize>(&self, headings_deg: [f64; N]) -> GenericRobot<N> {
        let wheel = |deg: f64| Wheel { heading: deg.to_radians(), distance: self.d, drivetrain: self.drivetrain() };
        GenericRobot {
            wheels: headings_deg.map(wheel),
            mass: self.mass,
            inertia: self.inertia,
            viscous: self.viscous,
            coulomb: self.coulomb,
        }
    }
}
