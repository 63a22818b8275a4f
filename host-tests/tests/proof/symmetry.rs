//! Symmetry: a robot that is turned, mirrored, started later or somewhere else moves just the same.
//!
//! Friction that is counted along the body's axes does not turn with the layout. So the turn by 90° swaps the friction
//! of v and vn, and the turn by 120°, which mixes the two, is asked of a robot without Coulomb friction on them and with
//! one viscosity for both; ω keeps its own.

use host_tests::excitation::{VoltageHold, voltages};
use model_core::effects::EffectKind;
use model_core::effects::active::{Effects, MAX_EFFECTS};
use model_core::effects::card::{Card, Physics, Scope};
use model_core::plant::Plant;
use model_core::plant::robot::Robot;
use std::f64::consts::{FRAC_PI_2, PI};

use crate::fixture::{Run, four, gap, plain, three, typical, wrapped};

type Params = Vec<f64>;

/// Every effect alone at its typical size, on all wheels or the robot or one wheel, and the same seen otherwise.
fn each<const N: usize>(
    robot: (Robot<N, f64>, Robot<N, f64>),
    wheel_there: impl Fn(usize) -> usize,
    params_there: impl Fn(&Card, Params) -> Params,
    check: impl Fn(&str, f64, Plant<N, f64>, Plant<N, f64>),
) {
    check("nothing", apart(None), plain(robot.0), plain(robot.1));
    for effect in &EffectKind::ALL {
        let card = effect.card();
        for placement in crate::fixture::placements(card, N).into_iter().take(2) {
            let params = typical(card);
            let mut sets: [Effects<N, f64>; 2] = Default::default();
            sets[0].add(*effect, placement, &params).expect("a placement that the card allows");
            let there = params_there(card, params);
            sets[1].add(*effect, placement.map(&wheel_there), &there).expect("a placement that the card allows");
            let [here, there] = sets;
            check(card.id, apart(Some(card)), Plant::new(robot.0, here), Plant::new(robot.1, there));
        }
    }
}

/// How far two runs that ought to be the same may part [m/s, rad/s, m, rad].
fn apart(card: Option<&Card>) -> f64 {
    card.map_or(Physics::PASSIVE, |card| card.physics).apart
}

/// Where on the robot something is, along axes that lie to the right by `turn` [rad].
fn placed(turn: f64) -> impl Fn(&Card, Params) -> Params {
    let (sin, cos) = turn.sin_cos();
    move |card, mut params| {
        if let Some([v, vn]) = card.physics.place {
            (params[v], params[vn]) = (cos * params[v] - sin * params[vn], sin * params[v] + cos * params[vn]);
        }
        params
    }
}

fn holds<const N: usize>() -> Vec<VoltageHold<N>> {
    voltages(5, 18, 9.0)
}

#[test]
fn four_wheels_turned_by_90_degrees_are_the_same_robot() {
    let here = four::<f64>();
    let mut there = here;
    there.friction.viscous.swap(0, 1);
    there.friction.coulomb.swap(0, 1);
    // wheel j of the one is wheel j + 1 of the other, whose axes lie 90° to the right of the first one's
    each(
        (here, there),
        |j| (j + 1) % 4,
        placed(FRAC_PI_2),
        |id, apart, here, there| {
            let mut here = Run::new(here);
            let mut there = Run::from(there, [0.0, 0.0, -FRAC_PI_2], [0.0; 3]);
            for hold in holds::<4>() {
                for _ in 0..hold.milliseconds {
                    here.drive(hold.u, 1e-3);
                    there.drive(std::array::from_fn(|j| hold.u[(j + 3) % 4]), 1e-3);
                }
                let [v, vn, w] = here.twist();
                let (p, q) = (here.pose(), there.pose());
                let off = gap(there.twist(), [-vn, v, w]).max(gap(q, [p[0], p[1], p[2] - FRAC_PI_2]));
                assert!(off < apart, "{id}: {off:e}");
            }
        },
    );
}

#[test]
fn three_wheels_turned_by_120_degrees_are_the_same_robot() {
    let mut robot = three::<f64>();
    robot.friction.viscous[1] = robot.friction.viscous[0];
    robot.friction.coulomb[..2].fill(0.0);
    let third = 2.0 * PI / 3.0;
    each(
        (robot, robot),
        |j| (j + 1) % 3,
        placed(third),
        |id, apart, here, there| {
            let mut here = Run::new(here);
            let mut there = Run::from(there, [0.0, 0.0, -third], [0.0; 3]);
            for hold in holds::<3>() {
                for _ in 0..hold.milliseconds {
                    here.drive(hold.u, 1e-3);
                    there.drive(std::array::from_fn(|j| hold.u[(j + 2) % 3]), 1e-3);
                }
                let [v, vn, w] = here.twist();
                let (sin, cos) = third.sin_cos();
                let (p, q) = (here.pose(), there.pose());
                let turned = [cos * v - sin * vn, sin * v + cos * vn, w];
                let off = gap(there.twist(), turned).max(gap(q, [p[0], p[1], p[2] - third]));
                assert!(off < apart, "{id}: {off:e}");
            }
        },
    );
}

/// Left and right swapped: vn and ω change sign, wheel j becomes `wheel[j]` and drives the other way.
fn mirrored<const N: usize>(robot: Robot<N, f64>, wheel: [usize; N]) {
    let params = |card: &Card, mut params: Params| {
        card.physics.mirrored.iter().for_each(|k| params[*k] = -params[*k]);
        params
    };
    each(
        (robot, robot),
        |j| wheel[j],
        params,
        |id, apart, here, there| {
            let (mut here, mut there) = (Run::new(here), Run::new(there));
            for hold in holds::<N>() {
                let mut u = [0.0; N];
                for j in 0..N {
                    u[wheel[j]] = -hold.u[j];
                }
                for _ in 0..hold.milliseconds {
                    let (a, b) = (here.drive(hold.u, 1e-3), there.drive(u, 1e-3));
                    // a current is twist errors times l·Kv/(r·R), about one ampere for each m/s
                    let off = gap(a.current, wheel.map(|k| -b.current[k]));
                    assert!(off < 10.0 * apart, "{id}, a current: {off:e}");
                }
                let ([v, vn, w], [x, y, theta]) = (here.twist(), here.pose());
                let off = gap(there.twist(), [v, -vn, -w]).max(gap(there.pose(), [x, -y, -theta]));
                assert!(off < apart, "{id}: {off:e}");
            }
        },
    );
}

#[test]
fn a_robot_seen_in_a_mirror_is_the_same_robot() {
    // drive angles 150°, 270°, 30° become 180° less each: 30°, 270°, 150°; 90°, 180°, 270°, 0° become 90°, 0°, 270°, 180°
    mirrored(three::<f64>(), [2, 1, 0]);
    mirrored(four::<f64>(), [0, 3, 2, 1]);
}

#[test]
fn a_run_that_starts_later_is_the_same_run() {
    let robot = four::<f64>();
    each(
        (robot, robot),
        |j| j,
        |_, params| params,
        |id, _, here, there| {
            let (mut here, mut there) = (Run::new(here), Run::new(there));
            there.state.time = 1000.3;
            if EffectKind::find(id).is_some_and(|kind| kind.card().physics.ages) {
                for hold in holds::<4>() {
                    here.play(&[hold], 1, |_, _| {});
                    there.play(&[hold], 1, |_, _| {});
                }
                // what goes by the time that a robot has run has to show it
                assert!(gap(here.twist(), there.twist()) > 1e-3, "{id}");
                return;
            }
            for hold in holds::<4>() {
                for _ in 0..hold.milliseconds {
                    let (a, b) = (here.drive(hold.u, 1e-3), there.drive(hold.u, 1e-3));
                    // at 1000 s time itself is rounded by 1e-13 s, and a delay sees 2000 steps' sum of that, 2e-10 s; the
                    // robot moves at 2 m/s and the voltage may change by 18 V within a step
                    assert!(gap(a.current, b.current) < 1e-5, "{id}: {:?} against {:?}", a.current, b.current);
                }
                assert!(gap(here.twist(), there.twist()) < 1e-6, "{id}");
                assert!(gap(here.pose(), there.pose()) < 1e-6, "{id}");
            }
        },
    );
}

#[test]
fn a_run_somewhere_else_in_the_world_is_the_same_run() {
    fn check<const N: usize>(robot: Robot<N, f64>) {
        let [x0, y0, turn] = [3.0, -2.0, 2.1];
        let params = |card: &Card, mut params: Params| {
            card.physics.direction.into_iter().for_each(|k| params[k] = wrapped(params[k] + turn));
            if let Some([x, y]) = card.physics.world_place {
                let (sin, cos) = turn.sin_cos();
                (params[x], params[y]) =
                    (x0 + cos * params[x] - sin * params[y], y0 + sin * params[x] + cos * params[y]);
            }
            params
        };
        each(
            (robot, robot),
            |j| j,
            params,
            |id, apart, here, there| {
                let mut here = Run::from(here, [0.0; 3], [0.3, 0.2, -1.0]);
                let mut there = Run::from(there, [x0, y0, turn], [0.3, 0.2, -1.0]);
                for hold in holds::<N>() {
                    for _ in 0..hold.milliseconds {
                        here.drive(hold.u, 1e-3);
                        there.drive(hold.u, 1e-3);
                    }
                    let ([x, y, theta], (sin, cos)) = (here.pose(), turn.sin_cos());
                    let moved = [x0 + cos * x - sin * y, y0 + sin * x + cos * y, theta + turn];
                    let off = gap(here.twist(), there.twist()).max(gap(there.pose(), moved));
                    assert!(off < apart, "{id}: {off:e}");
                }
            },
        );
    }
    check(three::<f64>());
    check(four::<f64>());
}

#[test]
fn all_effects_together_keep_the_symmetry_of_four_wheels() {
    // every one that looks the same from all sides, where voltages drive
    let all: Vec<_> = EffectKind::ALL.iter().filter(|e| e.card().scope != Scope::OneWheel).collect();
    let all: Vec<_> = all.into_iter().filter(|e| !e.card().of_speed_drive()).collect();
    let all: Vec<_> = all.into_iter().filter(|e| e.card().physics.direction.is_none()).collect();
    for group in all.chunks(MAX_EFFECTS) {
        keep_the_symmetry(group);
    }
}

fn keep_the_symmetry(all: &[&EffectKind]) {
    let robot = four::<f64>();
    let together = |turn| {
        let mut effects = Effects::default();
        for effect in all {
            effects
                .add(**effect, None, &placed(turn)(effect.card(), typical(effect.card())))
                .expect("room for as many");
        }
        effects
    };
    let apart: f64 = all.iter().map(|e| e.card().physics.apart).sum();
    // by 180° every axis goes over into itself
    let mut here = Run::new(Plant::new(robot, together(0.0)));
    let mut there = Run::from(Plant::new(robot, together(PI)), [0.0, 0.0, PI], [0.0; 3]);
    for hold in holds::<4>() {
        for _ in 0..hold.milliseconds {
            here.drive(hold.u, 1e-3);
            there.drive(std::array::from_fn(|j| hold.u[(j + 2) % 4]), 1e-3);
        }
        let ([v, vn, w], p) = (here.twist(), here.pose());
        let off = gap(there.twist(), [-v, -vn, w]).max(gap(there.pose(), [p[0], p[1], p[2] + PI]));
        assert!(off < apart, "{off:e}");
    }
}
