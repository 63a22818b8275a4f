//! A sinusoidal machine of three windings that turns at a held speed, solved exactly.

use super::AMPS;
use crate::control::phases::{self, AlphaBeta, DirectQuadrature, Rotation};

/// DC-equivalent, between two terminals [Ω].
pub const RESISTANCE: f64 = 1.5;
/// DC-equivalent, between two terminals [H].
pub const INDUCTANCE: f64 = 0.6e-3;
/// λ [V·s]
const FLUX: f64 = 2.4e-3;

/// The machine: phase quantities as complex numbers (α, β).
pub struct Machine {
    /// Electrical angle of the rotor [rad], in 0 ..< 2π
    pub angle: f64,
    /// ω_e [rad/s]
    pub speed: f64,
    current: [f64; 2],
}

fn product([a, b]: [f64; 2], [c, d]: [f64; 2]) -> [f64; 2] {
    [a * c - b * d, a * d + b * c]
}

impl Machine {
    pub fn at_rest(angle: f64) -> Self {
        Self { angle, speed: 0.0, current: [0.0; 2] }
    }

    pub fn turning(speed: f64) -> Self {
        Self { speed, ..Self::at_rest(0.0) }
    }

    /// DC-equivalent back-EMF [V]: √3·ω_e·λ.
    pub fn emf(&self) -> f64 {
        phases::dc_voltage(self.speed * FLUX)
    }

    /// Phase currents [A].
    pub fn phases(&self) -> [f64; 3] {
        AlphaBeta { alpha: self.current[0], beta: self.current[1] }.inverse_clarke()
    }

    /// DC-equivalent current as the rotor sees it [A].
    pub fn current(&self) -> DirectQuadrature<f64> {
        let vector = AlphaBeta { alpha: self.current[0], beta: self.current[1] };
        let DirectQuadrature { d, q } = Rotation::of_angle(self.angle).park(vector);
        DirectQuadrature { d: phases::dc_current(d), q: phases::dc_current(q) }
    }

    /// The legs stand at these duties of the bus [V] for `dt` [s].
    pub fn run(&mut self, duties: [f64; 3], bus: f64, dt: f64) {
        let (r, l) = (0.5 * RESISTANCE, 0.5 * INDUCTANCE);
        let AlphaBeta { alpha, beta } = AlphaBeta::clarke(duties.map(|x| x * bus));
        // L·di/dt = u − R·i − j·ω·λ·e^(jθ):  i = u/R − j·ω·λ·e^(jθ)/(R + j·ω·L) and what fades as e^(−R·t/L)
        let settled = |angle: f64| {
            let (sin, cos) = (libm::sin(angle), libm::cos(angle));
            let emf = [-self.speed * FLUX * sin, self.speed * FLUX * cos];
            let reactance = self.speed * l;
            let square = r * r + reactance * reactance;
            let [x, y] = product(emf, [r / square, -reactance / square]);
            [alpha / r - x, beta / r - y]
        };
        let (before, after) = (settled(self.angle), settled(self.angle + self.speed * dt));
        let left = libm::exp(-r * dt / l);
        self.current = [0, 1].map(|k| after[k] + (self.current[k] - before[k]) * left);
        let turns = (self.angle + self.speed * dt) / core::f64::consts::TAU;
        self.angle = (turns - libm::floor(turns)) * core::f64::consts::TAU;
        // beyond what the converter reads nothing here is of use
        assert!(self.phases().iter().all(|i| i.abs() < 1900.0 * AMPS), "{:?} A", self.phases());
    }
}
