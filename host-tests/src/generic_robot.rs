//! A robot as a list of wheels, each with a drive of its own.

/// Motor, gear and wheel of one corner.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drivetrain {
    /// r, wheel radius [m]
    pub radius: f64,
    /// l, gear ratio, motor turns per wheel turn [1]
    pub gear: f64,
    /// Kv, electromotive constant at the motor shaft [V/(rad/s)]
    pub kv: f64,
    /// Kt, torque constant at the motor shaft [N·m/A]
    pub kt: f64,
    /// R, winding resistance [Ω]; infinite for an open bridge
    pub resistance: f64,
}

/// One wheel and where it sits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wheel {
    /// α, the direction in which it rolls, from v towards vn [rad]
    pub heading: f64,
    /// d, lever arm of its rolling direction about the centre [m]
    pub distance: f64,
    /// What drives it.
    pub drivetrain: Drivetrain,
}

/// Any robot of N wheels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GenericRobot<const N: usize> {
    /// The wheels, in order.
    pub wheels: [Wheel; N],
    /// M [kg]
    pub mass: f64,
    /// J [kg·m²]
    pub inertia: f64,
    /// Bv, Bvn, Bω [N/(m/s), N/(m/s), N·m/(rad/s)]
    pub viscous: [f64; 3],
    /// Cv, Cvn, Cω [N, N, N·m]
    pub coulomb: [f64; 3],
}
