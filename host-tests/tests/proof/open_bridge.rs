//! A robot of which single bridges are open, as a fault leaves it, is the one whose motors there have infinite resistance.

use host_tests::excitation::voltages;
use host_tests::paper::{FOUR_HEADINGS_DEG, FOUR_WHEELS, PaperRobot, THREE_HEADINGS_DEG, THREE_WHEELS};
use host_tests::reference::Reference;
use model_core::plant::Input;
use model_core::plant::robot::Robot;

use crate::fixture::{Run, effect, four, gap, plain, three, with_effect};

/// Largest errors of speeds [m/s, rad/s] and of currents [A] over random voltages, the bridges of `open` open.
fn compare<const N: usize>(robot: Robot<N, f64>, paper: PaperRobot, headings: [f64; N], open: [bool; N]) -> [f64; 2] {
    let mut rig = paper.generic(headings);
    for (wheel, _) in rig.wheels.iter_mut().zip(open).filter(|(_, open)| *open) {
        wheel.drivetrain.resistance = f64::INFINITY;
    }
    let (mut run, mut exact) = (Run::new(plain(robot)), Reference::derived(&rig));
    let mut worst = [0.0_f64; 2];
    for hold in voltages::<N>(5, 40, 9.0) {
        for _ in 0..hold.milliseconds {
            let current = exact.currents(hold.u);
            let bridges = std::array::from_fn(|j| (!open[j]).then_some(hold.u[j]));
            let read = run.step(&Input::Bridges(bridges), 1e-3);
            exact.advance(hold.u, 1e-3);
            worst = [worst[0].max(gap(run.twist(), exact.twist)), worst[1].max(gap(read.current, current))];
        }
    }
    worst
}

#[test]
fn the_core_stays_with_the_reference() {
    let mut worst = [0.0_f64; 2];
    for wheel in 0..4 {
        let one = std::array::from_fn(|j| j == wheel);
        let two = std::array::from_fn(|j| j == wheel || j == (wheel + 1) % 4);
        for open in [one, two] {
            let errors = compare(four(), FOUR_WHEELS, FOUR_HEADINGS_DEG, open);
            worst = [worst[0].max(errors[0]), worst[1].max(errors[1])];
        }
        if wheel < 3 {
            let open = std::array::from_fn(|j| j == wheel);
            let errors = compare(three(), THREE_WHEELS, THREE_HEADINGS_DEG, open);
            worst = [worst[0].max(errors[0]), worst[1].max(errors[1])];
        }
    }
    // a wheel that turns freely joins the axes: a reversal is found by the same straight line, as with all bridges closed
    assert!(worst[0] < 6e-5 && worst[1] < 7e-6, "{worst:?}");
}

#[test]
fn all_bridges_open_carry_no_current_and_all_driven_are_voltages() {
    let drop = || with_effect(four::<f64>(), effect("supply_sag"), None, &[0.2, 0.0]);
    let mut ways = [0; 4].map(|_| Run::from(drop(), [0.0; 3], [0.6, -0.4, 3.0]));
    let u = [3.0, -2.0, 5.0, 1.0];
    for _ in 0..300 {
        let inputs =
            [Input::Bridges([None; 4]), Input::Current([0.0; 4]), Input::Bridges(u.map(Some)), Input::Voltage(u)];
        let step = |(run, input): (&mut Run<4, f64>, _)| run.step(&input, 1e-3).current;
        let currents: Vec<_> = ways.iter_mut().zip(inputs).map(step).collect();
        assert!(currents[0] == currents[1] && currents[2] == currents[3], "{currents:?}");
    }
    assert!(gap(ways[0].twist(), ways[1].twist()) == 0.0 && gap(ways[2].twist(), ways[3].twist()) == 0.0);
}

#[test]
fn a_bridge_that_is_open_draws_nothing_from_the_battery() {
    let mut robot = four::<f64>();
    robot.friction.coulomb = [1e3; 3];
    let (supply, resistance) = (robot.supply, robot.motor.resistance);
    let mut run = Run::new(with_effect(robot, effect("supply_sag"), None, &[0.5, 0.0]));
    let (u, open) = (9.0, 2);
    let bridges = std::array::from_fn(|j| (j != open).then_some(u));
    let mut read = run.step(&Input::Bridges(bridges), 1e-3);
    for _ in 0..10 {
        read = run.step(&Input::Bridges(bridges), 1e-3);
    }
    // U = U0 − Rb·Σ (u/U0)·i over three bridges, with i = (u·U/U0)/R of motors that stand
    let duty = u / supply;
    let bus = supply / (1.0 + 0.5 * 3.0 * duty * duty / resistance);
    for j in 0..4 {
        let wanted = if j == open { 0.0 } else { duty * bus / resistance };
        assert!((read.current[j] - wanted).abs() < 1e-9, "wheel {j}: {} against {wanted} A", read.current[j]);
    }
}
