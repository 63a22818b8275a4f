//! What motors are told, or the drives that control the speeds of their wheels.

use model_core::plant::Input;

use crate::log::RobotFile;

/// Voltages [V]; of drives that control wheel speed, the speeds at which motors would idle at them.
pub fn commanded<const N: usize>(file: &RobotFile, by_set_speed: bool, volts: [f64; N]) -> Input<N, f64> {
    if by_set_speed {
        let volts_per_speed = file.volts_per_wheel_speed();
        Input::SetSpeed(volts.map(|u| u / volts_per_speed))
    } else {
        Input::Voltage(volts)
    }
}
