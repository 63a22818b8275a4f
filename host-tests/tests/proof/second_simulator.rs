//! The second simulator and the first one, where both describe the same physics: the paper's robots and others like them.

use ground_truth::reading::{Reading, apart};
use ground_truth::robot_file::RobotFile;
use ground_truth::simulation::Simulation;
use host_tests::excitation::{SeededRng, VoltageHold, random_robot, voltages};
use host_tests::generic_robot::{Drivetrain, GenericRobot};
use host_tests::paper::{FOUR_HEADINGS_DEG, FOUR_WHEELS, THREE_HEADINGS_DEG, THREE_WHEELS};
use host_tests::reference::Reference;
use model_core::geometry::frames::{BodyTwist, Pose};
use model_core::plant::{Input, Plant, State};
use nalgebra::Vector3;

use crate::fixture::core_robot;

/// Step of the second simulator, that of its recordings [s]
const STEP: f64 = 1e-4;
/// Steps of it in a millisecond.
const STEPS: usize = 10;

/// How long the robots are compared from one start [ms].
const HORIZON_MS: usize = 500;

/// Two drives of one robot are no further apart [σ].
const ALIKE: f64 = 0.02;

/// What the core reads on a row of a millisecond, just after the voltages u [V] have been sent.
pub fn as_read<const N: usize>(row: usize, u: &[f64; N], reading: &model_core::plant::Reading<N, f64>) -> Reading {
    let Pose { x, y, theta } = reading.pose;
    Reading {
        time: 1e-3 * row as f64,
        command: u.to_vec(),
        currents: reading.current.to_vec(),
        wheel_speeds: reading.wheel_speed.to_vec(),
        pose: [x, y, theta],
        gyro: reading.gyro,
        ..Reading::default()
    }
}

/// The same robot in the second simulator's words.
fn of_rig<const N: usize>(rig: &GenericRobot<N>) -> RobotFile {
    let drive = rig.wheels[0].drivetrain;
    RobotFile {
        wheels: rig.wheels.map(|wheel| (wheel.heading.to_degrees(), wheel.distance, wheel.drivetrain.radius)).to_vec(),
        gear_ratio: drive.gear,
        resistance: drive.resistance,
        emf_constant: drive.kv,
        torque_constant: drive.kt,
        mass: rig.mass,
        inertia: rig.inertia,
        viscous: rig.viscous,
        coulomb: rig.coulomb,
        ..RobotFile::paper(0.0)
    }
}

fn voltages_by_millisecond<const N: usize>(seed: u64) -> Vec<[f64; N]> {
    let holds = voltages::<N>(seed, 30, 9.0).into_iter();
    holds.flat_map(|VoltageHold { u, milliseconds }| (0..milliseconds).map(move |_| u)).take(HORIZON_MS).collect()
}

fn by_ground_truth<const N: usize>(rig: &GenericRobot<N>, twist: [f64; 3], u: &[[f64; N]]) -> Vec<Reading> {
    let mut moving = Simulation::new(of_rig(rig).setup().robot, STEP);
    moving.set_moving(Vector3::from(twist));
    let read = |(row, u): (usize, &[f64; N])| {
        let reading = Reading {
            time: 1e-3 * row as f64,
            command: u.to_vec(),
            currents: moving.currents(u),
            wheel_speeds: moving.wheel_speeds().to_vec(),
            pose: moving.pose(),
            gyro: moving.twist()[2],
            ..Reading::default()
        };
        moving.hold(u, STEPS);
        reading
    };
    u.iter().enumerate().map(read).collect()
}

fn exactly<const N: usize>(rig: &GenericRobot<N>, twist: [f64; 3], u: &[[f64; N]]) -> Vec<Reading> {
    let mut robot = Reference::derived(rig).moving(twist);
    let read = |(row, u): (usize, &[f64; N])| {
        let reading = Reading {
            time: 1e-3 * row as f64,
            command: u.to_vec(),
            currents: robot.currents(*u).to_vec(),
            wheel_speeds: robot.wheel_speeds().to_vec(),
            pose: robot.pose,
            gyro: robot.twist[2],
            ..Reading::default()
        };
        robot.advance(*u, 1e-3);
        reading
    };
    u.iter().enumerate().map(read).collect()
}

/// The core, in `parts` steps a millisecond.
fn by_core<const N: usize>(rig: &GenericRobot<N>, twist: [f64; 3], u: &[[f64; N]], parts: usize) -> Vec<Reading> {
    let plant = Plant::new(core_robot::<N, f64>(rig), Default::default());
    let [v, vn, w] = twist;
    let mut state: State<N, f64> = plant.start(0.0, Pose::default(), BodyTwist { v, vn, w });
    let read = |(row, u): (usize, &[f64; N])| {
        let mut first = None;
        for _ in 0..parts {
            let reading = plant.step(&mut state, &mut [], &Input::Voltage(*u), 1e-3 / parts as f64);
            first.get_or_insert(reading);
        }
        as_read(row, u, &first.expect("at least one step"))
    };
    u.iter().enumerate().map(read).collect()
}

/// Both simulators over windows of half a second, each from a twist of its own.
fn compare<const N: usize>(rig: &GenericRobot<N>, seed: u64) {
    let mut rng = SeededRng::new(seed);
    let twist = [rng.between(-0.8, 0.8), rng.between(-0.8, 0.8), rng.between(-5.0, 5.0)];
    let u = voltages_by_millisecond::<N>(seed);
    let (second, exact) = (by_ground_truth(rig, twist, &u), exactly(rig, twist, &u));
    let [fine, shipped] = [100, 1].map(|parts| by_core(rig, twist, &u, parts));
    let noise = RobotFile::paper(0.0).noise;
    let from = |one: &[Reading], other: &[Reading]| apart(one, other, &noise);
    let (from_exact, from_fine) = (from(&second, &exact), from(&second, &fine));
    println!(
        "{N} wheels, seed {seed}: from the exact solution {from_exact:.4} σ, from the core at 10 µs {from_fine:.4} σ; the core at 1 ms {:.4} σ",
        from(&shipped, &exact)
    );
    assert!(from_exact < ALIKE, "{from_exact} σ from the exact solution");
    assert!(from_fine < ALIKE, "{from_fine} σ from the core");
}

/// A robot of any geometry, mass and friction, whose wheels have the same drive.
fn any<const N: usize>(seed: u64) -> GenericRobot<N> {
    let mut rig = random_robot::<N>(&mut SeededRng::new(seed));
    let drive = rig.wheels[0].drivetrain;
    rig.wheels.iter_mut().for_each(|wheel| wheel.drivetrain = Drivetrain { radius: wheel.drivetrain.radius, ..drive });
    rig
}

#[test]
fn the_paper_s_robots_move_alike() {
    for seed in 0..10 {
        compare(&THREE_WHEELS.generic(THREE_HEADINGS_DEG), seed);
        compare(&FOUR_WHEELS.generic(FOUR_HEADINGS_DEG), 100 + seed);
    }
}

#[test]
fn robots_of_any_geometry_move_alike() {
    for seed in 0..10 {
        compare(&any::<3>(200 + seed), seed);
        compare(&any::<4>(300 + seed), seed);
    }
}
