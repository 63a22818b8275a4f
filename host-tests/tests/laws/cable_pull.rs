//! Pull of a cable: a central force that has a potential, so that energy and angular momentum about the anchor stay.

use model_core::effects::active::Effects;
use model_core::plant::robot::Robot;
use model_core::plant::{Input, Plant};

use crate::fixture::{Run, effect, four, larger, plain, three, with_effect};
use crate::newton::{frictionless, second_order};

/// Ten times what is typical, so that the robot goes round the anchor within seconds.
const FORCE: f64 = 3.0;
const ANCHOR: [f64; 2] = [1.0, 0.5];
const CORE: f64 = 0.05;

fn swinging<const N: usize>(robot: Robot<N, f64>) -> Run<N, f64> {
    let mut effects = Effects::default();
    effects.add(effect("cable_pull"), None, &[FORCE, ANCHOR[0], ANCHOR[1], CORE]).expect("room");
    effects.add(effect("coriolis"), None, &[1.0]).expect("room");
    Run::from(Plant::new(frictionless(robot), effects), [0.4, -0.1, 0.3], [0.8, -0.5, 3.0])
}

/// Energy [J], with F times the distance as potential, and angular momentum about the anchor [kg·m²/s].
fn kept<const N: usize>(run: &Run<N, f64>) -> [f64; 2] {
    let (mass, world, [x, y, _]) = (run.plant.robot().mass, run.state.pose.to_world(run.state.twist), run.pose());
    let (x, y) = (x - ANCHOR[0], y - ANCHOR[1]);
    let potential = FORCE * x.hypot(y).hypot(CORE);
    [0.5 * mass * (world.x * world.x + world.y * world.y) + potential, mass * (x * world.y - y * world.x)]
}

/// How far what ought to stay is off over two seconds, in which the robot goes round the anchor.
fn off<const N: usize>(robot: Robot<N, f64>, which: usize, dt: f64) -> f64 {
    let mut run = swinging(robot);
    let (first, [_, _, theta]) = (kept(&run), run.pose());
    let mut worst = 0.0;
    for _ in 0..(2.0 / dt).round() as usize {
        run.step(&Input::Current([0.0; N]), dt);
        worst = larger(worst, (kept(&run)[which] - first[which]).abs());
    }
    // it is fastened at the centre and turns on evenly
    assert!((run.pose()[2] - theta - 6.0).abs() < 1e-12);
    worst
}

#[test]
fn energy_and_angular_momentum_about_the_anchor_stay() {
    for (what, which) in [("energy", 0), ("angular momentum", 1)] {
        // turns that are wrong by (ω·Δt)²/12, 8e-7 a radian, of some J and kg·m²/s, and the swing's own midpoint rule
        second_order(what, 2e-5, |dt| off(three(), which, dt));
        second_order(what, 2e-5, |dt| off(four(), which, dt));
    }
}

#[test]
fn a_pull_below_dry_friction_moves_nothing_and_one_above_it_draws_the_robot_to_the_anchor() {
    // break-away along the easier axis at C_v = 1.87 N
    let at_rest = |force: f64| {
        let mut run = Run::new(with_effect(four::<f64>(), effect("cable_pull"), None, &[force, 1.0, 0.0, CORE]));
        for _ in 0..6000 {
            run.drive([0.0; 4], 1e-3);
        }
        run
    };
    assert_eq!(at_rest(1.8).pose(), [0.0; 3]);
    let [x, y, theta] = at_rest(4.0).pose();
    // where the pull has faded to the friction: x/√(x² + ε²) = C/F before the anchor, or nearer
    let holds = CORE * (1.8738 / 4.0) / (1.0_f64 - (1.8738_f64 / 4.0).powi(2)).sqrt();
    assert!((1.0 - x).abs() <= holds + 1e-3 && y == 0.0 && theta == 0.0, "{x}");
    assert_eq!(Run::new(plain(four::<f64>())).pose(), [0.0; 3]);
}
