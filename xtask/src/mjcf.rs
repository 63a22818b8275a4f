//! # MJCF: exported models in MuJoCo, beside the product's own simulator
//!
//! A robot file with each effect that MuJoCo can hold is exported and simulated; `host-tests/mujoco/exported.py` plays the same
//! voltages in MuJoCo and says by how much both differ.

use std::fs;
use std::path::Path;

use crate::folder::told;
use crate::line::{Line, top};

/// Where all of it goes.
const FOLDER: &str = "target/mjcf";

/// The robot of all of them, and what MuJoCo has unasked.
const ROBOT: &str = "examples/feup-4w/robot.toml";
const CORIOLIS: &str = "\n[effects.coriolis]\n";

/// What is added to the robot file, under a name, and by how much both may differ of what each signal moves, root mean square.
const CASES: [(&str, &str, &str); 9] = [
    ("plain", "", "0.01"),
    ("mismatch", "[[effects.motor_mismatch]]\nwheel = 2\ntorque_constant_ratio = 0.88\n", "0.01"),
    ("gain", "[[effects.drive_gain]]\nwheel = 3\ngain_error = -0.05\n", "0.01"),
    ("radius", "[[effects.wheel_radius_error]]\nwheel = 1\nradius_error = 0.02\n", "0.01"),
    ("misalignment", "[[effects.wheel_misalignment]]\nwheel = 1\nangle_rad = 0.05\n", "0.01"),
    ("offset", "[effects.cog_offset]\noffset_v_m = 0.006\noffset_vn_m = 0.003\n", "0.01"),
    ("tilt", "[effects.floor_tilt]\ntilt_rad = 0.0175\n", "0.01"),
    ("delay", "[effects.actuation_delay]\ndelay_s = 0.01\n[effects.camera_latency]\nlatency_s = 0.04\n", "0.02"),
    // the wheels' inertia goes in only nearly
    ("inertia", "[effects.rotor_inertia]\ninertia_at_wheel_kg_m2 = 7.5e-5\n", "0.2"),
];

/// The commands of one case.
fn lines(python: &Path, name: &str, most: &str) -> [Line; 3] {
    let input = format!("{FOLDER}/demo/session/runs/run00.csv");
    let [robot, model, run] = ["toml", "xml", "csv"].map(|suffix| format!("{FOLDER}/{name}.{suffix}"));
    [
        Line::of(&format!("cargo omni-gap --quiet export {robot} --out {model}")),
        Line::of(&format!("cargo omni-gap --quiet simulate {robot} --input {input} --noise false --out {run}")),
        Line::of("").word(python).word("host-tests/mujoco/exported.py").word(model).word(run).word(most),
    ]
}

/// Does it.
///
/// # Errors
/// What to tell the person.
pub fn perform(python: &Path) -> Result<(), String> {
    Line::of(&format!("cargo omni-gap --quiet demo --out {FOLDER}/demo")).announced()?;
    let robot = told(ROBOT, fs::read_to_string(top().join(ROBOT)))?;
    for (name, effects, most) in CASES {
        let path = top().join(FOLDER).join(name).with_extension("toml");
        told(&path.display().to_string(), fs::write(&path, format!("{robot}{CORIOLIS}{effects}")))?;
        lines(python, name, most).iter().try_for_each(Line::announced)?;
    }
    Ok(())
}
