//! Robots that nobody has seen: layout, size and every number drawn, and a file that is wrong by what it states.
//!
//! A robot m times as heavy as the paper's is like it in all that has no dimension: the same accelerations, the same times,
//! the same share of its voltage for the same speed. With λ = m^(1/3) and its supply U times the paper's:
//!
//! ```text
//! d, r ~ λ     J ~ m·λ²     B, C ~ m (about the centre · λ, λ²)     Kv, Kt ~ U·λ     R ~ U²/m     σ_i ~ m/U
//! ```

use crate::drawn::Drawn;
use crate::robot_file::{Noise, RobotFile};

/// A robot, and what its file says of it.
#[derive(Clone, Debug, PartialEq)]
pub struct DrawnRobot {
    /// What is true of it.
    pub truth: RobotFile,
    /// What a diagnosis is given: each number wrong by its own draw of what is stated of it.
    pub file: RobotFile,
    /// The number that is wrong by [`FAR_OFF`] instead, in every fifth robot, by its key in the file.
    pub far_off: Option<&'static str>,
    /// By how many of its sigmas each of [`NUMBERS`] is wrong [1]
    off: [f64; NUMBERS.len()],
}

/// Mass of the lightest and of the heaviest [kg]
const MASS: (f64, f64) = (2.0, 40.0);

/// By how much each number is drawn off what its size would have [1]
const SPREAD: f64 = 0.3;

/// By how many stated sigmas one number of some files is off [1]
pub const FAR_OFF: f64 = 2.0;

/// Drive angles of each layout [°]: the paper's, crosses, and wheels where there was room.
const LAYOUTS: [&[f64]; 5] = [
    &[150.0, 270.0, 30.0],
    &[90.0, 180.0, 270.0, 0.0],
    &[135.0, 225.0, 315.0, 45.0],
    &[140.0, 270.0, 40.0],
    &[80.0, 190.0, 275.0, 10.0],
];

/// By how much the wheels of an irregular layout are turned beside that, at the most [°]
const IRREGULAR_DEG: f64 = 8.0;

/// The layouts from here on are irregular.
const FIRST_IRREGULAR: usize = 3;

/// A number of a robot file, its key, and where it stands.
#[derive(Clone, Copy, Debug)]
pub struct Number {
    /// The key in the file.
    pub key: &'static str,
    /// One sigma of its relative uncertainty where the file states none, as the data contract has it [1]
    pub uncertainty: f64,
    /// Multiplies it.
    pub scale: fn(&mut RobotFile, f64),
}

/// All numbers of which a file may be uncertain.
pub const NUMBERS: [Number; 13] = [
    Number { key: "mass_kg", uncertainty: 0.01, scale: |file, by| file.mass *= by },
    Number { key: "radius_m", uncertainty: 0.01, scale: |file, by| file.wheels.iter_mut().for_each(|w| w.2 *= by) },
    Number { key: "distance_m", uncertainty: 0.01, scale: |file, by| file.wheels.iter_mut().for_each(|w| w.1 *= by) },
    Number { key: "emf_constant_V_s", uncertainty: 0.03, scale: |file, by| file.emf_constant *= by },
    Number { key: "torque_constant_Nm_per_A", uncertainty: 0.03, scale: |file, by| file.torque_constant *= by },
    Number { key: "resistance_ohm", uncertainty: 0.1, scale: |file, by| file.resistance *= by },
    Number { key: "inertia_kg_m2", uncertainty: 0.1, scale: |file, by| file.inertia *= by },
    Number { key: "viscous_v_N_s_per_m", uncertainty: 0.2, scale: |file, by| file.viscous[0] *= by },
    Number { key: "viscous_vn_N_s_per_m", uncertainty: 0.2, scale: |file, by| file.viscous[1] *= by },
    Number { key: "viscous_w_Nm_s", uncertainty: 0.2, scale: |file, by| file.viscous[2] *= by },
    Number { key: "coulomb_v_N", uncertainty: 0.2, scale: |file, by| file.coulomb[0] *= by },
    Number { key: "coulomb_vn_N", uncertainty: 0.2, scale: |file, by| file.coulomb[1] *= by },
    Number { key: "coulomb_w_Nm", uncertainty: 0.2, scale: |file, by| file.coulomb[2] *= by },
];

impl DrawnRobot {
    /// The same seed draws the same robot.
    pub fn new(seed: u64) -> Self {
        let mut drawn = Drawn::new(seed);
        let truth = truth(seed, &mut drawn);
        let mut file = truth.clone();
        let far_off = (drawn.below(5) == 0).then(|| drawn.below(NUMBERS.len() as u32) as usize);
        let mut off = [0.0; NUMBERS.len()];
        for (k, number) in NUMBERS.iter().enumerate() {
            // within two sigma, so that no other number is as far off as the one that is meant to be
            let within = std::iter::repeat_with(|| drawn.normal()).find(|z| z.abs() < FAR_OFF).expect("most are");
            off[k] = if far_off == Some(k) { FAR_OFF.copysign(within) } else { within };
            (number.scale)(&mut file, 1.0 + number.uncertainty * off[k]);
        }
        Self { truth, file, far_off: far_off.map(|k| NUMBERS[k].key), off }
    }

    /// The same with some numbers of the file true: where one of them is what is hidden, it is wrong by that alone.
    #[must_use]
    pub fn with_true(mut self, keys: &[&str]) -> Self {
        for (number, off) in NUMBERS.iter().zip(&self.off).filter(|(number, _)| keys.contains(&number.key)) {
            (number.scale)(&mut self.file, 1.0 / (1.0 + number.uncertainty * off));
        }
        self.far_off = self.far_off.filter(|key| !keys.contains(key));
        self
    }
}

fn truth(seed: u64, drawn: &mut Drawn) -> RobotFile {
    let paper = RobotFile::paper(0.0);
    let mass = drawn.log_between(MASS.0, MASS.1);
    let supply = if mass < 8.0 { 12.0 } else { [24.0, 48.0][drawn.below(2) as usize] };
    let (m, u) = (mass / paper.mass, supply / paper.supply);
    let lambda = libm::cbrt(m);
    let layout = drawn.below(LAYOUTS.len() as u32) as usize;
    let mut turned = || if layout < FIRST_IRREGULAR { 0.0 } else { drawn.between(-IRREGULAR_DEG, IRREGULAR_DEG) };
    let (_, distance, radius) = paper.wheels[0];
    let wheels = LAYOUTS[layout].iter().map(|deg| (deg + turned(), distance * lambda, radius * lambda)).collect();
    let mut robot = RobotFile {
        name: format!("robot-{seed:016x}"),
        wheels,
        gear_ratio: paper.gear_ratio,
        resistance: paper.resistance * u * u / m,
        emf_constant: paper.emf_constant * u * lambda,
        torque_constant: paper.torque_constant * u * lambda,
        mass,
        inertia: paper.inertia * m * lambda * lambda,
        viscous: scaled(paper.viscous, [m, m, m * lambda * lambda]),
        coulomb: scaled(paper.coulomb, [m, m, m * lambda]),
        noise: paper.noise,
        supply,
        drive: None,
    };
    // but the mass, which is drawn already
    for number in &NUMBERS[1..] {
        (number.scale)(&mut robot, 1.0 + drawn.between(-SPREAD, SPREAD));
    }
    // one motor has one constant, whichever way power goes
    robot.torque_constant = robot.emf_constant;
    let mut noise = |sigma: f64| sigma * drawn.log_between(0.5, 2.0);
    let Noise { current, wheel_speed, position, heading, gyro } = paper.noise;
    robot.noise = Noise {
        current: noise(current * m / u),
        wheel_speed: noise(wheel_speed / lambda),
        position: noise(position),
        heading: noise(heading),
        gyro: noise(gyro),
    };
    robot
}

fn scaled(numbers: [f64; 3], by: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|k| numbers[k] * by[k])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_same_seed_draws_the_same_robot_and_layouts_and_sizes_differ() {
        let robots: Vec<DrawnRobot> = (0..200).map(DrawnRobot::new).collect();
        assert_eq!(robots[7], DrawnRobot::new(7));
        let count = |is: &dyn Fn(&DrawnRobot) -> bool| robots.iter().filter(|robot| is(robot)).count();
        assert!((60..=100).contains(&count(&|robot| robot.truth.wheels.len() == 3)));
        // as many light as heavy ones: √(2·40) kg parts them
        assert!((80..=120).contains(&count(&|robot| robot.truth.mass < 80_f64.sqrt())));
        assert!((25..=55).contains(&count(&|robot| robot.far_off.is_some())), "one in five");
        assert!(robots.iter().all(|robot| (MASS.0..=MASS.1).contains(&robot.truth.mass)));
    }

    #[test]
    fn files_are_wrong_by_what_they_state_and_far_off_by_twice_that() {
        let robots: Vec<DrawnRobot> = (0..400).map(DrawnRobot::new).collect();
        let off = |robot: &DrawnRobot| (robot.file.resistance / robot.truth.resistance - 1.0) / 0.1;
        for robot in &robots {
            let far = robot.far_off == Some("resistance_ohm");
            assert!(if far { (off(robot).abs() - 2.0).abs() < 1e-9 } else { off(robot).abs() < 2.0 });
        }
        let mean_square = robots.iter().map(|robot| off(robot).powi(2)).sum::<f64>() / robots.len() as f64;
        // a normal distribution cut off at two sigma has 0.774; four standard errors of 400 draws
        assert!((mean_square - 0.774).abs() < 0.2, "{mean_square}");
    }

    #[test]
    fn a_number_that_is_what_is_hidden_is_true_in_the_file_otherwise() {
        let robot = (0..).map(DrawnRobot::new).find(|robot| robot.far_off == Some("mass_kg")).expect("one in 65");
        let with_true = robot.clone().with_true(&["mass_kg", "resistance_ohm"]);
        assert!((with_true.file.mass / robot.truth.mass - 1.0).abs() < 1e-12);
        assert!((with_true.file.resistance / robot.truth.resistance - 1.0).abs() < 1e-12);
        assert_eq!((with_true.file.inertia, with_true.far_off), (robot.file.inertia, None));
    }

    #[test]
    fn a_heavy_robot_accelerates_and_runs_as_fast_as_a_light_one_within_the_spread() {
        for seed in 0..100 {
            let robot = DrawnRobot::new(seed).truth;
            let paper = RobotFile::paper(0.0);
            // rim speed per full voltage; force of a stalled wheel per mass
            let speed = |f: &RobotFile| f.supply * f.wheels[0].2 / (f.gear_ratio * f.emf_constant);
            let stalled =
                |f: &RobotFile| f.gear_ratio * f.torque_constant * f.supply / (f.resistance * f.wheels[0].2 * f.mass);
            for of in [speed, stalled] {
                let ratio = of(&robot) / of(&paper);
                // two or three numbers of ± 30 %
                assert!((0.25..4.0).contains(&ratio), "seed {seed}: {ratio}");
            }
        }
    }
}
