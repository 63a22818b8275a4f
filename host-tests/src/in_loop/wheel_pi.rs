//! # Wheel PI: what most robots do, to compare with
//!
//! ```text
//! e_j = ω_j − ω̂_j
//! i_j = k_p·e_j + I_j within ±i_max,   I_j ← I_j + k_i·Δt·e_j while i_j is within
//! ```
//!
//! | symbol | code | unit | meaning |
//! |---|---|---|---|
//! | ω_j, ω̂_j | | rad/s | speed of a wheel's shaft: as the reference asks for, and by the times of its hall edges |
//! | i_j | | A | current of its motor |
//! | k_p | `proportional` | A·s/rad | |
//! | k_i | `integral` | A/rad | |
//! | i_max | `most` | A | |
//!
//! Each wheel for itself, without a model. All else is the firmware's: the reference with its largest accelerations, the
//! currents' loop, the halls, the protections.

use firmware::codes::TICK_SECONDS;
use firmware::motion::MotionOutput;
use firmware::winding_signals::WindingFeedback;
use model_core::geometry::kinematics::Wheels;

/// Speed controllers of four wheels.
#[derive(Clone, Copy, Debug)]
pub struct WheelPi {
    wheels: Wheels<4>,
    gains: [f32; 2],
    most: f32,
    integral: [f32; 4],
}

impl WheelPi {
    /// For these wheels as they are believed to be, with k_p [A·s/rad] and k_i [A/rad] and a largest current [A].
    pub fn new(wheels: Wheels<4>, gains: [f32; 2], most: f32) -> Self {
        Self { wheels, gains, most, integral: [0.0; 4] }
    }

    /// One turn: puts its currents in place of what was decided.
    pub fn turn(&mut self, feedback: &WindingFeedback, output: &mut MotionOutput) {
        if output.setpoints.enabled == 0 {
            self.integral = [0.0; 4];
            return;
        }
        let [proportional, integral] = self.gains;
        let wanted = self.wheels.wheel_speeds(output.reference);
        for (j, sum) in self.integral.iter_mut().enumerate() {
            let error = wanted[j] - feedback.wheel_speed[j];
            let asked = proportional * error + *sum;
            let current = asked.clamp(-self.most, self.most);
            if asked == current {
                *sum += integral * TICK_SECONDS * error;
            }
            output.setpoints.current[j] = current;
            output.setpoints.voltage[j] = 0.0;
        }
    }
}
