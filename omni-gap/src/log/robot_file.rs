//! # The robot file: the nominal model, as a person writes it
//!
//! Keys, units and defaults are those of `robot.toml`. A [`RobotFile`] that exists is sound: numbers are finite and in
//! bounds, the wheels can tell the body's motion, and every effect is one that the caller's [`Catalogue`] knows.
//!
//! [`Catalogue`]: super::Catalogue

use super::commissioned::CommissionedFile;
use super::controller::ControllerFile;
use model_core::effects::nominal;
use model_core::geometry::kinematics::Wheel;
use schemars::JsonSchema;
use serde::Serialize;
use std::collections::BTreeMap;

/// One wheel. Wheel j rolls along (cos a, sin a) of the body axes.
#[derive(Debug, Clone, Copy, PartialEq, JsonSchema, Serialize)]
pub struct WheelFile {
    /// Direction of rolling in body axes (degrees).
    pub drive_angle_deg: f64,
    /// From the centre of the robot to the wheel (m).
    pub distance_m: f64,
    /// Radius of the wheel (m).
    pub radius_m: f64,
}

impl WheelFile {
    /// The wheel as the model has it.
    pub fn wheel(&self) -> Wheel<f64> {
        Wheel::from_degrees(self.drive_angle_deg, self.distance_m, self.radius_m)
    }
}

/// The motor and its gear, one model for all wheels.
#[derive(Debug, Clone, Copy, PartialEq, JsonSchema, Serialize)]
pub struct MotorFile {
    /// Motor speed over wheel speed (1).
    pub gear_ratio: f64,
    /// Winding resistance R (Ω).
    pub resistance_ohm: f64,
    /// Kv at the motor shaft (V/(rad/s)).
    #[serde(rename = "emf_constant_V_s")]
    pub emf_constant_v_s: f64,
    /// Kt at the motor shaft (N·m/A).
    #[serde(rename = "torque_constant_Nm_per_A")]
    pub torque_constant_nm_per_a: f64,
}

/// The body.
#[derive(Debug, Clone, Copy, PartialEq, JsonSchema, Serialize)]
pub struct BodyFile {
    /// Mass (kg).
    pub mass_kg: f64,
    /// Inertia about the vertical axis (kg·m²).
    pub inertia_kg_m2: f64,
}

/// Viscous and Coulomb friction along v, vn and about the vertical axis.
#[derive(Debug, Clone, Copy, Default, PartialEq, JsonSchema, Serialize)]
pub struct FrictionFile {
    /// In N·s/m.
    #[serde(rename = "viscous_v_N_s_per_m")]
    pub viscous_v_n_s_per_m: f64,
    /// In N·s/m.
    #[serde(rename = "viscous_vn_N_s_per_m")]
    pub viscous_vn_n_s_per_m: f64,
    /// In N·m·s.
    #[serde(rename = "viscous_w_Nm_s")]
    pub viscous_w_nm_s: f64,
    /// In N.
    #[serde(rename = "coulomb_v_N")]
    pub coulomb_v_n: f64,
    /// In N.
    #[serde(rename = "coulomb_vn_N")]
    pub coulomb_vn_n: f64,
    /// In N·m.
    #[serde(rename = "coulomb_w_Nm")]
    pub coulomb_w_nm: f64,
}

/// One-sigma noise of each measured signal.
#[derive(Debug, Clone, Copy, PartialEq, JsonSchema, Serialize)]
pub struct SensorsFile {
    /// In A.
    #[serde(rename = "current_noise_A")]
    pub current_noise_a: f64,
    /// In rad/s.
    pub wheel_speed_noise_rad_s: f64,
    /// In m.
    pub position_noise_m: f64,
    /// In rad.
    pub heading_noise_rad: f64,
    /// Of the yaw rate (rad/s); where absent, what a log shows of it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub gyro_noise_rad_s: Option<f64>,
    /// Of the battery's voltage (V); where absent, what a log shows of it.
    #[serde(rename = "battery_noise_V", skip_serializing_if = "Option::is_none")]
    pub battery_noise_v: Option<f64>,
}

impl SensorsFile {
    /// Sensors without noise.
    pub const SILENT: SensorsFile = SensorsFile {
        current_noise_a: 0.0,
        wheel_speed_noise_rad_s: 0.0,
        position_noise_m: 0.0,
        heading_noise_rad: 0.0,
        gyro_noise_rad_s: Some(0.0),
        battery_noise_v: Some(0.0),
    };
}

impl Default for SensorsFile {
    /// The noise taken where the file is silent.
    fn default() -> Self {
        SensorsFile {
            current_noise_a: 0.02,
            wheel_speed_noise_rad_s: 0.15,
            position_noise_m: 0.003,
            heading_noise_rad: 0.01,
            gyro_noise_rad_s: None,
            battery_noise_v: None,
        }
    }
}

/// What the numbers were identified from, as `identify` leaves it.
#[derive(Debug, Clone, Copy, Default, PartialEq, JsonSchema, Serialize)]
pub struct IdentifiedFile {
    /// Rows a second of its recordings (1/s).
    pub rate_hz: Option<f64>,
}

/// The supply.
#[derive(Debug, Clone, Copy, PartialEq, JsonSchema, Serialize)]
pub struct SupplyFile {
    /// In V.
    #[serde(rename = "voltage_V")]
    pub voltage_v: f64,
}

/// What an experiment may ask of the robot; absent means no limit stated.
#[derive(Debug, Clone, Copy, Default, PartialEq, JsonSchema, Serialize)]
pub struct LimitsFile {
    /// Largest motor current (A).
    #[serde(rename = "current_A")]
    pub current_a: Option<f64>,
    /// Largest body speed (m/s).
    pub speed_m_s: Option<f64>,
    /// Side of the free floor (m).
    pub field_m: Option<f64>,
}

/// One effect that the nominal model includes.
#[derive(Debug, Clone, PartialEq, JsonSchema, Serialize)]
pub struct EffectEntry {
    /// Its id in the catalogue.
    pub id: String,
    /// The wheel it sits on, counted from 0; none where it sits on all of them or on the body.
    pub wheel: Option<usize>,
    /// The parameters the file gives, by key; units stand in the keys.
    pub params: BTreeMap<String, f64>,
}

/// A sound robot file.
#[derive(Debug, Clone, PartialEq, JsonSchema, Serialize)]
pub struct RobotFile {
    /// Version of the form; 1 where absent.
    pub schema: Option<u32>,
    /// The robot's name.
    pub name: String,
    /// Three or four wheels, in wheel order.
    pub wheel: Vec<WheelFile>,
    /// The motor.
    pub motor: MotorFile,
    /// The body.
    pub body: BodyFile,
    /// Friction; zero where absent.
    pub friction: FrictionFile,
    /// Noise.
    pub sensors: SensorsFile,
    /// One-sigma relative uncertainties that the file states, by key. Ask [`RobotFile::relative_uncertainty`].
    pub uncertainty: BTreeMap<String, f64>,
    /// What the numbers were identified from, where they were.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub identified: Option<IdentifiedFile>,
    /// The supply.
    pub supply: Option<SupplyFile>,
    /// Limits for experiments.
    pub limits: Option<LimitsFile>,
    /// What only the robot's controller needs to know.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub controller: Option<ControllerFile>,
    /// How motors are wired, where that was found out.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub commissioned: Vec<CommissionedFile>,
    /// Effects, in the file's order.
    pub effects: Vec<EffectEntry>,
}

/// Where a nominal number stands: its key in the file, its field here.
macro_rules! place_of {
    ($file:ident, $key:ident, $wheel:ident, $($borrow:tt)+) => {
        match $key {
            "distance_m" if $wheel < $file.wheel.len() => Some($($borrow)+ $file.wheel[$wheel].distance_m),
            "radius_m" if $wheel < $file.wheel.len() => Some($($borrow)+ $file.wheel[$wheel].radius_m),
            "resistance_ohm" => Some($($borrow)+ $file.motor.resistance_ohm),
            "emf_constant_V_s" => Some($($borrow)+ $file.motor.emf_constant_v_s),
            "torque_constant_Nm_per_A" => Some($($borrow)+ $file.motor.torque_constant_nm_per_a),
            "mass_kg" => Some($($borrow)+ $file.body.mass_kg),
            "inertia_kg_m2" => Some($($borrow)+ $file.body.inertia_kg_m2),
            "viscous_v_N_s_per_m" => Some($($borrow)+ $file.friction.viscous_v_n_s_per_m),
            "viscous_vn_N_s_per_m" => Some($($borrow)+ $file.friction.viscous_vn_n_s_per_m),
            "viscous_w_Nm_s" => Some($($borrow)+ $file.friction.viscous_w_nm_s),
            "coulomb_v_N" => Some($($borrow)+ $file.friction.coulomb_v_n),
            "coulomb_vn_N" => Some($($borrow)+ $file.friction.coulomb_vn_n),
            "coulomb_w_Nm" => Some($($borrow)+ $file.friction.coulomb_w_nm),
            _ => None,
        }
    };
}

impl RobotFile {
    /// One-sigma relative uncertainty (1) of a nominal parameter, by its key in the robot file; none for other keys.
    pub fn relative_uncertainty(&self, key: &str) -> Option<f64> {
        let default = nominal::numbers().find(|number| number.key == key)?.relative_uncertainty;
        Some(self.uncertainty.get(key).copied().unwrap_or(default))
    }

    /// A nominal number by its key, in the key's unit; of a wheel's numbers, that of this wheel.
    pub fn nominal(&self, key: &str, wheel: usize) -> Option<f64> {
        place_of!(self, key, wheel, &).copied()
    }

    /// The same, to be changed.
    pub fn nominal_mut(&mut self, key: &str, wheel: usize) -> Option<&mut f64> {
        place_of!(self, key, wheel, &mut)
    }

    /// Kv times the gear ratio: volts per wheel speed (V/(rad/s)).
    pub fn volts_per_wheel_speed(&self) -> f64 {
        self.motor.emf_constant_v_s * self.motor.gear_ratio
    }
}
