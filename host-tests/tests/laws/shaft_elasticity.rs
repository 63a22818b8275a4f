//! Elastic shafts: rotors and body are masses on springs, with a resonance, a decay and an energy that are closed forms.

use host_tests::paper::{FOUR_HEADINGS_DEG, FOUR_WHEELS, PaperRobot, THREE_HEADINGS_DEG, THREE_WHEELS};
use model_core::effects::active::Effects;
use model_core::plant::robot::Robot;
use model_core::plant::{Input, Plant};

use crate::fixture::{Run, effect, four, gap, larger, three, with_effect};
use crate::newton::{frictionless, runge_kutta};
use crate::one_wheel::OneWheel;

const COMPLIANCE: f64 = 0.05;
const ROTOR: f64 = 6e-5;

fn with_shaft<const N: usize>(
    robot: Robot<N, f64>,
    wheel: Option<usize>,
    damping_time: f64,
    twist: [f64; 3],
) -> Run<N, f64> {
    let params = [COMPLIANCE, damping_time, ROTOR];
    Run::from(with_effect(frictionless(robot), effect("shaft_elasticity"), wheel, &params), [0.0; 3], twist)
}

/// Instants at which the twist of a shaft passes through zero [s], and what it is at its extremes between them [rad].
fn swings<const N: usize>(run: &mut Run<N, f64>, wheel: usize, dt: f64, count: usize) -> (Vec<f64>, Vec<f64>) {
    let (mut last, mut most) = (run.state.shaft_twist[wheel], 0.0_f64);
    let (mut crossings, mut extremes) = (Vec::new(), Vec::new());
    while crossings.len() < count {
        run.step(&Input::Current([0.0; N]), dt);
        let now = run.state.shaft_twist[wheel];
        most = most.max(now.abs());
        if last * now < 0.0 {
            crossings.push(run.state.time - dt * now / (now - last));
            extremes.push(most);
            most = 0.0;
        }
        last = now;
    }
    (crossings, extremes)
}

/// One wheel's shaft, let go twisted: two masses of J and 1/(g·r⁻²), g = 1/M + d²/J_body.
fn rings<const N: usize>(robot: Robot<N, f64>, p: &PaperRobot, headings: [f64; N]) {
    for (j, heading) in headings.into_iter().enumerate() {
        let mobility = OneWheel::new(p, heading).mobility() / (p.r * p.r);
        let rate = ((1.0 / ROTOR + mobility) / COMPLIANCE).sqrt();
        for damping_time in [0.0, 2e-4] {
            let mut run = with_shaft(robot, Some(j), damping_time, [0.0; 3]);
            run.state.shaft_twist[j] = 0.01;
            let (crossings, extremes) = swings(&mut run, j, 1e-5, 13);
            let found = 6.0 * std::f64::consts::TAU / (crossings[12] - crossings[0]);
            // ζ = ½·ω₀·T,  ω = ω₀·√(1 − ζ²)
            let ratio = 0.5 * rate * damping_time;
            let wanted = rate * (1.0 - ratio * ratio).sqrt();
            // midpoint rule: (ω·Δt)²/12 with ω of 700/s
            assert!((found / wanted - 1.0).abs() < 2e-5, "wheel {j}: {found} against {wanted} rad/s");
            // exp(−ζ·ω₀·t) over the time from the first extreme that is seen whole to the last
            let decay = (extremes[12] / extremes[2]).ln() / (crossings[12] - crossings[2]);
            // an extreme is seen to (ω·Δt)²/8 of it
            let what = format!("wheel {j}: decays at {decay}, not {}", -ratio * rate);
            assert!((decay + ratio * rate).abs() < 1e-3 * rate * (ratio + 1e-3), "{what}");
        }
    }
}

#[test]
fn a_twisted_shaft_rings_at_the_resonance_of_its_two_masses_and_dies_away() {
    rings(three(), &THREE_WHEELS, THREE_HEADINGS_DEG);
    rings(four(), &FOUR_WHEELS, FOUR_HEADINGS_DEG);
}

#[test]
fn the_rotors_inertia_is_that_which_the_model_has_in_any_order() {
    let heavy = 1.5e-4;
    let ring = |effects: &[(&str, &[f64])]| {
        let mut set = Effects::default();
        for (id, params) in effects {
            set.add(effect(id), None, params).expect("room");
        }
        let mut run = Run::new(Plant::new(frictionless(four()), set));
        run.state.shaft_twist = [0.01; 4];
        swings(&mut run, 2, 1e-5, 9).0[8]
    };
    let (shaft, rotor) = (("shaft_elasticity", &[COMPLIANCE, 0.0, ROTOR][..]), ("rotor_inertia", &[heavy][..]));
    let wanted = ring(&[("shaft_elasticity", &[COMPLIANCE, 0.0, heavy])]);
    assert_eq!([ring(&[shaft, rotor]), ring(&[rotor, shaft])], [wanted; 2]);
    assert!(ring(&[shaft]) < 0.8 * wanted);
}

#[test]
fn without_damping_it_keeps_its_energy_and_with_damping_it_loses() {
    let energy = |run: &Run<4, f64>| {
        let [v, vn, w] = run.twist();
        let robot = run.plant.robot();
        let shafts = (0..4).map(|j| {
            0.5 * ROTOR * run.state.rotor_speed[j].powi(2) + 0.5 * run.state.shaft_twist[j].powi(2) / COMPLIANCE
        });
        0.5 * robot.mass * (v * v + vn * vn) + 0.5 * robot.inertia * w * w + shafts.sum::<f64>()
    };
    for damping_time in [0.0, 2e-4] {
        let mut run = with_shaft(four(), None, damping_time, [0.3, -0.2, 2.0]);
        run.state.shaft_twist = [0.02, -0.01, 0.015, 0.0];
        let (first, mut last) = (energy(&run), energy(&run));
        for _ in 0..5000 {
            run.step(&Input::Current([0.0; 4]), 1e-3);
            let now = energy(&run);
            assert!(now <= last * (1.0 + 1e-13), "{now} after {last} J");
            last = now;
        }
        // the midpoint rule keeps a quadratic form: 5000 roundings
        assert_eq!((last / first - 1.0).abs() < 1e-11, damping_time == 0.0, "{last} of {first} J");
    }
}

/// d/dt of (v, vn, ω; speed and twist of each rotor), written out; `K` is 3 + 2·N.
fn rate<const N: usize, const K: usize>(
    (p, headings): (&PaperRobot, [f64; N]),
    damping_time: f64,
    u: [f64; N],
    x: [f64; K],
) -> [f64; K] {
    let (mut rate, mut force) = ([0.0; K], [0.0; 3]);
    for j in 0..N {
        let (sin, cos) = headings[j].to_radians().sin_cos();
        let wheel = (cos * x[0] + sin * x[1] + p.d * x[2]) / p.r;
        let (rotor, twist) = (x[3 + 2 * j], x[4 + 2 * j]);
        let motor = p.l * p.kt * (u[j] - p.l * p.kv * rotor) / p.resistance;
        let shaft = (twist + damping_time * (rotor - wheel)) / COMPLIANCE;
        rate[3 + 2 * j] = (motor - shaft) / ROTOR;
        rate[4 + 2 * j] = rotor - wheel;
        for (force, along) in force.iter_mut().zip([cos, sin, p.d]) {
            *force += along * shaft / p.r;
        }
    }
    rate[0] = force[0] / p.mass;
    rate[1] = force[1] / p.mass;
    rate[2] = force[2] / p.inertia;
    rate
}

fn is_driven<const N: usize, const K: usize>(robot: Robot<N, f64>, p: &PaperRobot, headings: [f64; N], u: [f64; N]) {
    let (damping_time, start) = (2e-4, [0.1, -0.05, 0.3]);
    let off = |dt: f64| {
        let mut run = with_shaft(robot, None, damping_time, start);
        let mut x = [0.0; K];
        x[..3].copy_from_slice(&start);
        for j in 0..N {
            x[3 + 2 * j] = run.state.rotor_speed[j];
        }
        let mut worst = 0.0;
        for _ in 0..(0.3 / dt).round() as usize {
            let read = run.drive(u, dt);
            for j in 0..N {
                // what the current sensor sees is the rotor's back-EMF; an ampere counts as 1 m/s
                let current = (u[j] - p.l * p.kv * x[3 + 2 * j]) / p.resistance;
                worst = larger(worst, (read.current[j] - current).abs());
            }
            for _ in 0..10 {
                x = runge_kutta(|x| rate((p, headings), damping_time, u, x), x, 0.1 * dt);
            }
            worst = larger(worst, gap(run.twist(), [x[0], x[1], x[2]]));
        }
        worst
    };
    let (coarse, fine) = (off(2e-4), off(1e-4));
    // 0.25·rad/s of ringing of ω, which (ω·Δt)²/12 = 4e-4 delays by 1e-3 of a turn each 40 ms before it has died away
    assert!(fine < 3e-3, "{N} wheels: {fine:e}");
    assert!((3.3..4.7).contains(&(coarse / fine)), "{N} wheels: {coarse:e} and {fine:e}");
}

#[test]
fn a_robot_that_is_driven_moves_as_its_equations_integrated_for_themselves() {
    is_driven::<3, 9>(three(), &THREE_WHEELS, THREE_HEADINGS_DEG, [-3.0, -1.5, 8.0]);
    is_driven::<4, 11>(four(), &FOUR_WHEELS, FOUR_HEADINGS_DEG, [8.0, -5.0, -4.0, 8.0]);
}

#[test]
fn a_shaft_that_hardly_gives_way_is_a_rigid_one_with_the_rotors_inertia() {
    let robot = four::<f64>();
    let stiff = with_effect(robot, effect("shaft_elasticity"), None, &[1e-4, 2e-4, ROTOR]);
    let rigid = with_effect(robot, effect("rotor_inertia"), None, &[ROTOR]);
    let (mut stiff, mut rigid) = (Run::new(stiff), Run::new(rigid));
    for k in 0..600 {
        let u = if k < 300 { [6.0, -2.0, 1.0, 4.0] } else { [-3.0, 5.0, 2.0, -4.0] };
        stiff.drive(u, 1e-3);
        rigid.drive(u, 1e-3);
        // κ·J = (78 µs)² behind: of 8 m/s² and 80 rad/s² less than a step's
        assert!(gap(stiff.twist(), rigid.twist()) < 2e-2, "{:?}, not {:?}", stiff.twist(), rigid.twist());
    }
    assert!(gap(stiff.twist(), rigid.twist()) < 1e-4, "{:?}, not {:?}", stiff.twist(), rigid.twist());
}
