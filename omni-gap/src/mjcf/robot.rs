//! A robot as MuJoCo's elements can hold it: what of a robot file's effects goes into numbers, and what cannot.

use crate::log::RobotFile;
use crate::simulate::EffectInstance;

/// A wheel and the motor on it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Motor {
    /// Where the wheel rolls in body axes (rad).
    pub angle: f64,
    /// Where the wheel touches the floor in body axes (m).
    pub at: [f64; 2],
    /// Radius of the wheel (m).
    pub radius: f64,
    /// Torque at the wheel per volt at the bridge, the wheel at rest (N·m/V).
    pub gain: f64,
    /// Torque at the wheel that is lost per speed of the wheel: back-EMF and friction (N·m·s).
    pub damping: f64,
    /// Torque at the wheel while the bridge is told no voltage (N·m).
    pub offset: f64,
}

/// A robot as MuJoCo's elements can hold it.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct MujocoRobot {
    pub motors: Vec<Motor>,
    /// Mass (kg) and inertia about the centre of mass (kg·m²).
    pub mass: f64,
    pub inertia: f64,
    /// Centre of mass in body axes (m).
    pub centre: [f64; 2],
    /// Inertia of a wheel and what turns with it, at the wheel (kg·m²).
    pub wheel_inertia: f64,
    /// Delay of the command, and of the camera (s).
    pub delay: f64,
    pub camera_delay: f64,
    /// Pull of a tilted floor in the world's axes, as an acceleration (m/s²).
    pub pull: [f64; 2],
    /// What goes in only nearly, in sentences.
    pub nearly: Vec<String>,
    /// Effects that do not go in, each with the reason.
    pub left: Vec<(String, &'static str)>,
}

/// Standard gravity [m/s²]
pub(super) const GRAVITY: f64 = 9.80665;

impl MujocoRobot {
    /// The robot of a file.
    pub fn of(file: &RobotFile) -> Self {
        let motors = (0..file.wheel.len()).map(|j| Motor::of(file, j, &Scales::default())).collect();
        let mut robot = Self {
            motors,
            mass: file.body.mass_kg,
            inertia: file.body.inertia_kg_m2,
            centre: [0.0; 2],
            wheel_inertia: 0.0,
            delay: 0.0,
            camera_delay: 0.0,
            pull: [0.0; 2],
            nearly: Vec::new(),
            left: Vec::new(),
        };
        if !file.effects.iter().any(|effect| effect.id == "coriolis") {
            robot.nearly.push(CORIOLIS.to_owned());
        }
        for effect in file.effects.iter().filter_map(EffectInstance::of) {
            robot.add(file, &effect);
        }
        robot
    }

    fn add(&mut self, file: &RobotFile, effect: &EffectInstance) {
        let of = |key| effect.number(key);
        match effect.id {
            "coriolis" if of("factor") == 1.0 => {}
            "coriolis" => self.left.push((named(effect), "a body in MuJoCo has the whole of it, factor 1")),
            "rotor_inertia" => {
                self.wheel_inertia += of("inertia_at_wheel_kg_m2");
                self.nearly.push(ROTORS.to_owned());
            }
            "actuation_delay" => self.delay += of("delay_s"),
            "camera_latency" => self.camera_delay += of("latency_s"),
            "cog_offset" => self.centre = [of("offset_v_m"), of("offset_vn_m")],
            "floor_tilt" => {
                let pull = GRAVITY * of("tilt_rad").sin();
                self.pull = [pull * of("direction_rad").cos(), pull * of("direction_rad").sin()];
            }
            _ => self.add_to_wheels(file, effect),
        }
    }

    /// Effects that change the motors of one wheel, or of all.
    fn add_to_wheels(&mut self, file: &RobotFile, effect: &EffectInstance) {
        let of = |key| effect.number(key);
        let change: &dyn Fn(usize, &mut Motor) = match effect.id {
            "motor_mismatch" => &|j, motor| {
                let scales = Scales { constants: of("torque_constant_ratio"), resistance: of("resistance_ratio") };
                let changed = Motor::of(file, j, &scales);
                let plain = Motor::of(file, j, &Scales::default());
                motor.offset *= changed.gain / plain.gain;
                motor.gain *= changed.gain / plain.gain;
                motor.damping += changed.damping - plain.damping;
            },
            // u_eff = u·(1 + g) + o
            "drive_gain" => &|_, motor| {
                motor.offset += motor.gain * of("offset_V");
                motor.gain *= 1.0 + of("gain_error");
            },
            "wheel_radius_error" => &|_, motor| motor.radius *= 1.0 + of("radius_error"),
            "wheel_misalignment" => &|_, motor| motor.angle += of("angle_rad"),
            "wheel_friction" => {
                self.left.push((named(effect), "its Coulomb part: an actuator has no dry friction"));
                &|_, motor| motor.damping += of("damping_Nms")
            }
            _ => return self.left.push((named(effect), "MuJoCo has no element for it")),
        };
        let on_it = |(j, _): &(usize, &mut Motor)| effect.wheel.is_none_or(|wheel| wheel == *j);
        self.motors.iter_mut().enumerate().filter(on_it).for_each(|(j, motor)| change(j, motor));
    }

    /// What the wheels' inertia adds to mass (kg) and inertia (kg·m²), where the wheels are the same in all directions.
    pub fn armature(&self) -> [f64; 2] {
        let of = |motor: &Motor| self.wheel_inertia / motor.radius.powi(2);
        // half the trace along v and vn: J_w/r²·(cos² + sin²)/2 of each wheel
        let along = self.motors.iter().map(|motor| 0.5 * of(motor)).sum();
        let about = self.motors.iter().map(|motor| of(motor) * motor.lever().powi(2)).sum();
        [along, about]
    }
}

impl Motor {
    fn of(file: &RobotFile, wheel: usize, scales: &Scales) -> Self {
        let (motor, wheel) = (&file.motor, &file.wheel[wheel]);
        let angle = wheel.drive_angle_deg.to_radians();
        let (x, y) = wheel.wheel().contact_point();
        let (l, r) = (motor.gear_ratio, motor.resistance_ohm * scales.resistance);
        let torque = motor.torque_constant_nm_per_a * scales.constants;
        let emf = motor.emf_constant_v_s * scales.constants;
        // τ_wheel = l·K_t·(u − l·K_v·ω_wheel)/R
        Self {
            angle,
            at: [x, y],
            radius: wheel.radius_m,
            gain: l * torque / r,
            damping: l * l * torque * emf / r,
            offset: 0.0,
        }
    }

    /// Lever of the wheel's force about the robot's middle (m).
    pub fn lever(&self) -> f64 {
        // d = x·sin α − y·cos α
        self.at[0] * self.angle.sin() - self.at[1] * self.angle.cos()
    }
}

/// By how much a motor differs from the file's.
struct Scales {
    constants: f64,
    resistance: f64,
}

impl Default for Scales {
    fn default() -> Self {
        Self { constants: 1.0, resistance: 1.0 }
    }
}

/// `motor_mismatch (wheel 2)`
fn named(effect: &EffectInstance) -> String {
    effect.wheel.map_or_else(|| effect.id.to_owned(), |wheel| format!("{} (wheel {wheel})", effect.id))
}

const CORIOLIS: &str = "a body in MuJoCo carries its velocity round while it turns; the robot file leaves that out (add \
                        [effects.coriolis] to compare the two)";

const ROTORS: &str = "the inertia of rotors and wheels is armature of the body's joints: the same in all directions, and carried \
                      round with the body, which wheels do not do";
