//! Feedforward: what is asked for is what the plant does.

use host_tests::excitation::{SeededRng, random_robot};
use host_tests::generic_robot::GenericRobot;
use model_core::geometry::frames::BodyTwist;
use model_core::plant::Input;
use model_core::plant::robot::Robot;

use crate::fixture::{Run, core_robot, four, gap, plain, three};

/// Random twists and accelerations [SI]; one of three twists rests.
fn motions(seed: u64) -> impl Iterator<Item = ([f64; 3], [f64; 3])> {
    let mut rng = SeededRng::new(seed);
    (0..60).map(move |k| {
        let mut three = |most: [f64; 3]| most.map(|m| rng.between(-m, m));
        let (x, a) = (three([1.5, 1.5, 8.0]), three([2.0, 2.0, 15.0]));
        (if k % 3 == 0 { [0.0; 3] } else { x }, a)
    })
}

fn robots<const N: usize>(paper: Robot<N, f64>) -> Vec<Robot<N, f64>> {
    let mut rng = SeededRng::new(5);
    let mut all = vec![paper];
    all.extend((0..10).map(|_| core_robot(&random_robot::<N>(&mut rng) as &GenericRobot<N>)));
    all
}

/// One step of 1 µs under what feedforward asks for: the acceleration is the one wanted.
fn arrives<const N: usize>(paper: Robot<N, f64>) {
    for robot in robots(paper) {
        for (x, a) in motions(31) {
            let demand = robot.inverse_dynamics(BodyTwist::from_array(x), BodyTwist::from_array(a));
            for input in [Input::Voltage(demand.voltage), Input::Current(demand.current)] {
                let mut run = Run::from(plain(robot), [0.0; 3], x);
                let dt = 1e-6;
                let read = run.step(&input, dt);
                let got: [f64; 3] = std::array::from_fn(|k| (run.twist()[k] - x[k]) / dt);
                // half a step on, back-EMF and viscosity have changed it by λ·a·Δt/2, with λ below 100/s: 5e-5 of 15
                assert!(gap(got, a) < 2e-3, "{got:?} for {a:?} at {x:?}");
                // a few roundings of ampere and rad/s
                assert!(gap(read.current, demand.current) < 1e-10, "{:?} for {:?}", read.current, demand.current);
            }
        }
    }
}

#[test]
fn the_plant_accelerates_as_feedforward_wants() {
    arrives::<3>(three());
    arrives::<4>(four());
}

#[test]
fn voltage_current_and_torque_are_one_statement() {
    for robot in robots(four()) {
        for (x, a) in motions(32) {
            let twist = BodyTwist::from_array(x);
            let demand = robot.inverse_dynamics(twist, BodyTwist::from_array(a));
            let speed = robot.wheels.wheel_speeds(twist);
            let current = std::array::from_fn(|j| robot.motor.current(demand.voltage[j], speed[j]));
            let torque = current.map(|i| robot.motor.torque(i));
            // a few roundings of ampere and N·m
            assert!(gap(current, demand.current) < 1e-12 && gap(torque, demand.wheel_torque) < 1e-13);
        }
    }
}

#[test]
fn the_wheel_forces_are_the_smallest_that_do_it() {
    let robot = four::<f64>();
    for (x, a) in motions(33) {
        let demand = robot.inverse_dynamics(BodyTwist::from_array(x), BodyTwist::from_array(a));
        let force: [f64; 4] = std::array::from_fn(|j| demand.wheel_torque[j] / robot.wheels.wheels()[j].radius);
        let wanted = robot.body_force_for(BodyTwist::from_array(x), BodyTwist::from_array(a));
        // a few roundings of some newtons
        assert!(gap(robot.wheels.body_force(force), wanted) < 1e-13);
        // the smallest forces have no part along the one combination that does nothing to the body
        assert!(robot.wheels.parity(force).abs() < 1e-13);
    }
}

#[test]
fn a_wanted_path_is_driven() {
    // v = sin t and so on, fed forward alone: what is left is the hold of the voltage over each step
    let robot = three::<f64>();
    let wanted = |t: f64| [0.8 * (2.0 * t).sin(), 0.5 * (3.0 * t).cos(), 4.0 * t.sin()];
    let mut run = Run::from(plain(robot), [0.0; 3], wanted(0.0));
    let (dt, mut worst) = (1e-3, 0.0_f64);
    for k in 0..3000 {
        let t = f64::from(k) * dt;
        let (x, next) = (wanted(t), wanted(t + dt));
        let middle = BodyTwist::from_array(x).mean(BodyTwist::from_array(next));
        let a = std::array::from_fn(|axis| (next[axis] - x[axis]) / dt);
        run.drive(robot.inverse_dynamics(middle, BodyTwist::from_array(a)).voltage, dt);
        worst = worst.max(gap(run.twist(), next));
    }
    // reversals, where friction turns round within a step: |K|·Δt = 6 mrad/s
    assert!(worst < 7e-3, "{worst}");
}
