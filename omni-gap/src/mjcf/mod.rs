//! # MJCF: a robot file as a model of MuJoCo
//!
//! One body on two slides and a hinge, pushed by one actuator a wheel: the transmission of a site whose `gear` is the wheel's
//! row of the kinematics, so that the actuator's velocity is the wheel's speed, its force the wheel's torque, and its control
//! the motor's voltage. Gain and velocity bias are those of the motor without inductance. Friction along the body's axes
//! is that of actuators too, since a slide's own would lie along the world's: viscous friction a bias, Coulomb friction a steep
//! one whose force is limited. MuJoCo is told of by its documentation, <https://mujoco.readthedocs.io>: delays of
//! actuators and sensors need version 4.

mod robot;

use std::fmt::Write;

use crate::log::RobotFile;
use robot::{GRAVITY, Motor, MujocoRobot};

/// A model of MuJoCo, and how true it is.
#[derive(Clone, Debug, PartialEq)]
pub struct Mjcf {
    /// The file.
    pub text: String,
    /// What it holds only nearly, in sentences.
    pub nearly: Vec<String>,
    /// Effects that it does not hold, each with the reason.
    pub left: Vec<(String, &'static str)>,
}

/// Length of MuJoCo's steps [s]
const STEP: f64 = 1e-3;

/// Share of its speed that a robot loses in a step to Coulomb friction that holds it: as steep as a step without overshoot allows.
const HELD: f64 = 0.5;

/// A robot file as a model of MuJoCo.
pub fn mjcf(file: &RobotFile) -> Mjcf {
    let robot = MujocoRobot::of(file);
    let mut text = String::new();
    // writing to a string cannot fail
    let _ = write_model(&mut text, file, &robot);
    Mjcf { text, nearly: robot.nearly, left: robot.left }
}

fn write_model(out: &mut String, file: &RobotFile, robot: &MujocoRobot) -> std::fmt::Result {
    let name: String = file.name.chars().filter(|c| c.is_alphanumeric() || "-_. ".contains(*c)).collect();
    let [x, y] = robot.pull;
    writeln!(out, "<mujoco model=\"{name}\">")?;
    writeln!(out, "  <!-- Made of a robot file by omni-gap export. Axes: x is v (ahead), y is vn (to the left).")?;
    writeln!(out, "       Control of motor j: its voltage. Sensor w j: the speed of wheel j in rad/s.")?;
    let left = robot.left.iter().map(|(effect, why)| format!("Not in this model: {effect}: {why}"));
    for note in robot.nearly.iter().map(|note| format!("Nearly: {note}")).chain(left) {
        writeln!(out, "       {note}.")?;
    }
    writeln!(out, "  -->")?;
    writeln!(out, "  <compiler angle=\"radian\"/>")?;
    writeln!(out, "  <option timestep=\"{STEP}\" integrator=\"Euler\" gravity=\"{x} {y} {}\"/>", -GRAVITY)?;
    writeln!(out, "  <default>")?;
    // friction that holds is as stiff as the step allows
    let stiff = "solreffriction=\"0.002 1\" solimpfriction=\"0.999 0.999 0.001 0.5 2\"";
    writeln!(out, "    <joint {stiff}/>")?;
    writeln!(out, "    <geom contype=\"0\" conaffinity=\"0\"/>")?;
    writeln!(out, "  </default>")?;
    write_body(out, file, robot)?;
    write_actuators(out, file, robot)?;
    write_sensors(out, robot)?;
    writeln!(out, "</mujoco>")
}

fn write_body(out: &mut String, file: &RobotFile, robot: &MujocoRobot) -> std::fmt::Result {
    let friction = &file.friction;
    let [x, y] = robot.centre;
    let (mass, inertia) = (robot.mass, robot.inertia);
    let [along, about] = robot.armature();
    let hinge = format!("frictionloss=\"{}\" armature=\"{about}\"", friction.coulomb_w_nm);
    let reach = robot.motors.iter().map(|motor| motor.at[0].hypot(motor.at[1])).fold(0.0, f64::max);
    let height = robot.motors.iter().map(|motor| motor.radius).fold(0.0, f64::max);
    writeln!(out, "  <worldbody>")?;
    writeln!(out, "    <geom name=\"floor\" type=\"plane\" size=\"5 5 0.1\" rgba=\"0.9 0.9 0.88 1\"/>")?;
    writeln!(out, "    <body name=\"robot\">")?;
    writeln!(out, "      <inertial pos=\"{x} {y} 0\" mass=\"{mass}\" diaginertia=\"{inertia} {inertia} {inertia}\"/>")?;
    writeln!(out, "      <joint name=\"x\" type=\"slide\" axis=\"1 0 0\" armature=\"{along}\"/>")?;
    writeln!(out, "      <joint name=\"y\" type=\"slide\" axis=\"0 1 0\" armature=\"{along}\"/>")?;
    writeln!(
        out,
        "      <joint name=\"heading\" type=\"hinge\" axis=\"0 0 1\" damping=\"{}\" {hinge}/>",
        friction.viscous_w_nm_s
    )?;
    writeln!(out, "      <site name=\"middle\"/>")?;
    writeln!(
        out,
        "      <geom type=\"cylinder\" size=\"{} {height}\" pos=\"0 0 {height}\" rgba=\"0.3 0.5 0.7 0.6\"/>",
        0.86 * reach
    )?;
    for (j, Motor { angle, at: [x, y], radius, .. }) in robot.motors.iter().enumerate() {
        let place = format!("pos=\"{x} {y} {radius}\" zaxis=\"{} {} 0\"", angle.sin(), -angle.cos());
        writeln!(out, "      <geom name=\"wheel{j}\" type=\"cylinder\" size=\"{radius} {}\" {place}/>", 0.3 * radius)?;
    }
    writeln!(out, "    </body>\n  </worldbody>")
}

fn write_actuators(out: &mut String, file: &RobotFile, robot: &MujocoRobot) -> std::fmt::Result {
    let range = file
        .supply
        .map(|supply| format!(" ctrllimited=\"true\" ctrlrange=\"{0} {1}\"", -supply.voltage_v, supply.voltage_v));
    let range = range.unwrap_or_default();
    writeln!(out, "  <actuator>")?;
    for (j, motor) in robot.motors.iter().enumerate() {
        // ω_j = (cos α·v + sin α·vn + d·ω)/r
        let [v, vn, w] = [motor.angle.cos(), motor.angle.sin(), motor.lever()].map(|part| part / motor.radius);
        writeln!(
            out,
            "    <general name=\"motor{j}\" site=\"middle\" gear=\"{v} {vn} 0 0 0 {w}\" gainprm=\"{}\" biastype=\"affine\" \
             biasprm=\"{} 0 {}\"{range}{}/>",
            motor.gain,
            motor.offset,
            -motor.damping,
            delayed(robot.delay)
        )?;
    }
    let friction = &file.friction;
    for (axis, gear, viscous, coulomb) in [
        ("v", "1 0 0 0 0 0", friction.viscous_v_n_s_per_m, friction.coulomb_v_n),
        ("vn", "0 1 0 0 0 0", friction.viscous_vn_n_s_per_m, friction.coulomb_vn_n),
    ] {
        let element = |name: &str, slope: f64| {
            format!(
                "    <general name=\"{name}_{axis}\" site=\"middle\" gear=\"{gear}\" gainprm=\"0\" biastype=\"affine\" biasprm=\"0 0 {}\"",
                -slope
            )
        };
        if viscous > 0.0 {
            writeln!(out, "{}/>", element("viscous", viscous))?;
        }
        // F = −F_c·sign(v), with a slope in place of the jump
        if coulomb > 0.0 {
            let limit = format!("forcelimited=\"true\" forcerange=\"{} {coulomb}\"", -coulomb);
            writeln!(out, "{} {limit}/>", element("coulomb", HELD * (robot.mass + robot.armature()[0]) / STEP))?;
        }
    }
    writeln!(out, "  </actuator>")
}

fn write_sensors(out: &mut String, robot: &MujocoRobot) -> std::fmt::Result {
    writeln!(out, "  <sensor>")?;
    for j in 0..robot.motors.len() {
        writeln!(out, "    <actuatorvel name=\"w{j}\" actuator=\"motor{j}\"/>")?;
    }
    for joint in ["x", "y", "heading"] {
        writeln!(out, "    <jointpos name=\"pose_{joint}\" joint=\"{joint}\"{}/>", delayed(robot.camera_delay))?;
    }
    writeln!(out, "    <gyro name=\"gyro\" site=\"middle\"/>")?;
    writeln!(out, "  </sensor>")
}

/// The attributes of something that comes later.
fn delayed(seconds: f64) -> String {
    if seconds <= 0.0 {
        return String::new();
    }
    format!(" delay=\"{seconds}\" nsample=\"{}\"", (seconds / STEP).ceil() as usize + 2)
}

#[cfg(test)]
mod tests;
