//! The second simulator and the first one, where both describe the same physics: the paper's robots and others like them.

use ground_truth::battery::Battery;
use ground_truth::body_friction::BodyFriction;
use ground_truth::chassis::Chassis;
use ground_truth::motor::Motor;
use ground_truth::robot::{Robot, Wheel};
use ground_truth::simulation::Simulation;
use ground_truth::surroundings::Surroundings;
use host_tests::excitation::{SeededRng, VoltageHold, random_robot, voltages};
use host_tests::generic_robot::{Drivetrain, GenericRobot};
use host_tests::paper::{FOUR_HEADINGS_DEG, FOUR_WHEELS, THREE_HEADINGS_DEG, THREE_WHEELS};
use host_tests::reference::Reference;
use model_core::geometry::frames::{BodyTwist, Pose};
use model_core::plant::{Input, Plant, State};
use nalgebra::{Vector2, Vector3};

use crate::fixture::core_robot;

/// Step of the second simulator [s]
const STEP: f64 = 5e-5;
/// Steps of it in a millisecond.
const STEPS: usize = 20;

/// Noise of the paper's robots' sensors: current [A], wheel speed [rad/s], position [m], heading [rad].
const SIGMA: [f64; 4] = [0.02, 0.15, 0.003, 0.01];

/// How long the robots are compared from one start [ms].
const HORIZON_MS: usize = 500;

/// The same robot in the second simulator's words.
fn of_rig<const N: usize>(rig: &GenericRobot<N>) -> Robot {
    let wheel = |wheel: host_tests::generic_robot::Wheel| {
        let drive = wheel.drivetrain;
        let motor = Motor { torque_constant: drive.kt, ..Motor::plain(drive.resistance, drive.kv) };
        Wheel::paper(wheel.heading, wheel.distance, drive.radius, drive.gear, motor)
    };
    Robot {
        chassis: Chassis {
            mass: rig.mass,
            inertia: rig.inertia,
            centre_of_mass: Vector2::zeros(),
            height: 0.0,
            transport: 0.0,
            friction: BodyFriction::paper(rig.viscous.into(), rig.coulomb.into()),
        },
        wheels: rig.wheels.map(wheel).to_vec(),
        battery: Battery::stiff(12.0),
        command_delay: 0.0,
        surroundings: Surroundings::default(),
    }
}

/// What is read each millisecond: currents, wheel speeds, position, heading.
type Reading = [Vec<f64>; 4];

fn voltages_by_millisecond<const N: usize>(seed: u64) -> Vec<[f64; N]> {
    let holds = voltages::<N>(seed, 30, 9.0).into_iter();
    holds.flat_map(|VoltageHold { u, milliseconds }| (0..milliseconds).map(move |_| u)).take(HORIZON_MS).collect()
}

fn by_ground_truth<const N: usize>(rig: &GenericRobot<N>, twist: [f64; 3], u: &[[f64; N]]) -> Vec<Reading> {
    let mut moving = Simulation::new(of_rig(rig), STEP);
    moving.set_moving(Vector3::from(twist));
    let read = |u: &[f64; N]| {
        let (currents, speeds) = (moving.currents(u), moving.wheel_speeds().to_vec());
        let [x, y, theta] = moving.pose();
        moving.hold(u, STEPS);
        [currents, speeds, vec![x, y], vec![theta]]
    };
    u.iter().map(read).collect()
}

fn exactly<const N: usize>(rig: &GenericRobot<N>, twist: [f64; 3], u: &[[f64; N]]) -> Vec<Reading> {
    let mut robot = Reference::derived(rig).moving(twist);
    let read = |u: &[f64; N]| {
        let [x, y, theta] = robot.pose;
        let reading = [robot.currents(*u).to_vec(), robot.wheel_speeds().to_vec(), vec![x, y], vec![theta]];
        robot.advance(*u, 1e-3);
        reading
    };
    u.iter().map(read).collect()
}

/// The core, in `parts` steps a millisecond.
fn by_core<const N: usize>(rig: &GenericRobot<N>, twist: [f64; 3], u: &[[f64; N]], parts: usize) -> Vec<Reading> {
    let plant = Plant::new(core_robot::<N, f64>(rig), Default::default());
    let [v, vn, w] = twist;
    let mut state: State<N, f64> = plant.start(0.0, Pose::default(), BodyTwist { v, vn, w });
    let read = |u: &[f64; N]| {
        let mut first = None;
        for _ in 0..parts {
            let reading = plant.step(&mut state, &mut [], &Input::Voltage(*u), 1e-3 / parts as f64);
            first.get_or_insert(reading);
        }
        let reading = first.expect("at least one step");
        let Pose { x, y, theta } = reading.pose;
        [reading.current.to_vec(), reading.wheel_speed.to_vec(), vec![x, y], vec![theta]]
    };
    u.iter().map(read).collect()
}

/// RMS difference of each group over its noise [1].
fn apart(a: &[Reading], b: &[Reading]) -> [f64; 4] {
    std::array::from_fn(|group| {
        let pairs = a.iter().zip(b).flat_map(|(a, b)| a[group].iter().zip(&b[group]));
        let (sum, count) = pairs.fold((0.0, 0.0), |(sum, n), (a, b)| (sum + (a - b).powi(2), n + 1.0));
        (sum / f64::max(count, 1.0)).sqrt() / SIGMA[group]
    })
}

fn most(of: [f64; 4]) -> f64 {
    of.into_iter().fold(0.0, f64::max)
}

/// Both simulators over windows of half a second, each from a twist of its own.
fn compare<const N: usize>(rig: &GenericRobot<N>, seed: u64) {
    let mut rng = SeededRng::new(seed);
    let twist = [rng.between(-0.8, 0.8), rng.between(-0.8, 0.8), rng.between(-5.0, 5.0)];
    let u = voltages_by_millisecond::<N>(seed);
    let (second, exact) = (by_ground_truth(rig, twist, &u), exactly(rig, twist, &u));
    let [fine, shipped] = [100, 1].map(|parts| by_core(rig, twist, &u, parts));
    println!(
        "{N} wheels, seed {seed}: from the exact solution {:.4} σ, from the core at 10 µs {:.4} σ; the core at 1 ms {:.4} σ",
        most(apart(&second, &exact)),
        most(apart(&second, &fine)),
        most(apart(&shipped, &exact))
    );
    assert!(most(apart(&second, &exact)) < 0.02, "{:?}", apart(&second, &exact));
    assert!(most(apart(&second, &fine)) < 0.02, "{:?}", apart(&second, &fine));
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
