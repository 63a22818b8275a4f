//! The keys of a robot file's nominal numbers, and what a model's factors make of them.

use model_core::plant::robot::Nominal;

use crate::log::{Change, RobotFile};

/// A nominal number of a robot file.
#[derive(Clone, Copy, Debug)]
pub struct NominalKey {
    /// Its key.
    pub key: &'static str,
    /// The table that holds it; `wheel` stands for every wheel.
    pub table: &'static str,
    /// Its SI unit.
    pub unit: &'static str,
    /// The factors that multiply it.
    pub factors: &'static [Nominal],
    read: fn(&RobotFile) -> f64,
}

const fn key(
    key: &'static str,
    table: &'static str,
    unit: &'static str,
    factors: &'static [Nominal],
    read: fn(&RobotFile) -> f64,
) -> NominalKey {
    NominalKey { key, table, unit, factors, read }
}

/// All of them, in the order of the file. Of the wheels, the first one's number stands for all.
pub const NOMINAL_KEYS: [NominalKey; 13] = [
    key("distance_m", "wheel", "m", &[Nominal::CenterDistance], |f| f.wheel[0].distance_m),
    key("radius_m", "wheel", "m", &[Nominal::WheelRadius], |f| f.wheel[0].radius_m),
    key("resistance_ohm", "motor", "Ω", &[Nominal::Resistance], |f| f.motor.resistance_ohm),
    key("emf_constant_V_s", "motor", "V·s", &[Nominal::TorqueConstant], |f| f.motor.emf_constant_v_s),
    key("torque_constant_Nm_per_A", "motor", "N·m/A", &[Nominal::TorqueConstant, Nominal::KtOverKv], |f| {
        f.motor.torque_constant_nm_per_a
    }),
    key("mass_kg", "body", "kg", &[Nominal::Mass], |f| f.body.mass_kg),
    key("inertia_kg_m2", "body", "kg·m²", &[Nominal::Inertia], |f| f.body.inertia_kg_m2),
    key("viscous_v_N_s_per_m", "friction", "N·s/m", &[Nominal::ViscousV], |f| f.friction.viscous_v_n_s_per_m),
    key("viscous_vn_N_s_per_m", "friction", "N·s/m", &[Nominal::ViscousVn], |f| f.friction.viscous_vn_n_s_per_m),
    key("viscous_w_Nm_s", "friction", "N·m·s", &[Nominal::ViscousW], |f| f.friction.viscous_w_nm_s),
    key("coulomb_v_N", "friction", "N", &[Nominal::CoulombV], |f| f.friction.coulomb_v_n),
    key("coulomb_vn_N", "friction", "N", &[Nominal::CoulombVn], |f| f.friction.coulomb_vn_n),
    key("coulomb_w_Nm", "friction", "N·m", &[Nominal::CoulombW], |f| f.friction.coulomb_w_nm),
];

impl NominalKey {
    /// The number of this key.
    pub fn of(key: &str) -> Option<&'static NominalKey> {
        NOMINAL_KEYS.iter().find(|k| k.key == key)
    }

    /// The number that this factor alone multiplies.
    pub fn alone(nominal: Nominal) -> Option<&'static NominalKey> {
        NOMINAL_KEYS.iter().find(|key| key.factors == [nominal])
    }

    /// The file's number (of the first wheel, for a wheel's key) in SI units.
    pub fn value(&self, file: &RobotFile) -> f64 {
        (self.read)(file)
    }

    /// The product of this number's factors.
    pub fn factor(&self, factors: &[f64; Nominal::COUNT]) -> f64 {
        self.factors.iter().map(|p| factors[*p as usize]).product()
    }

    /// The changes that multiply this number of a file; for a wheel's key, of all its wheels.
    pub fn scaled(&self, file: &RobotFile, factor: f64) -> Vec<Change> {
        if self.table != "wheel" {
            let path = format!("{}.{}", self.table, self.key);
            return vec![Change::Number { path, value: self.value(file) * factor }];
        }
        file.wheel
            .iter()
            .enumerate()
            .map(|(j, wheel)| {
                let old = if self.key == "radius_m" { wheel.radius_m } else { wheel.distance_m };
                Change::Number { path: format!("wheel[{j}].{}", self.key), value: old * factor }
            })
            .collect()
    }
}
