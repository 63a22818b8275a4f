//! Energy: friction takes it and never gives it, turning forces do no work, and what sticks stays.

use host_tests::excitation::voltages;
use model_core::effects::EffectKind;
use model_core::effects::active::{Effects, MAX_EFFECTS};
use model_core::effects::card::{Card, Role, Scope, Seam, Stage};
use model_core::number::scalar::Real;
use model_core::plant::robot::Robot;
use model_core::plant::{Input, Plant};

use crate::fixture::{Run, effect, four, gap, larger, placements, plain, three, typical, with_effect};

/// Kinetic energy of body and wheels [J]; `inertia` is that of a wheel at its shaft [kg·m²].
fn energy<const N: usize, T: Real + Into<f64>>(run: &Run<N, T>, inertia: f64) -> f64 {
    let [v, vn, w] = run.twist();
    let robot = run.plant.robot();
    let mut sum = 0.5 * robot.mass.into() * (v * v + vn * vn) + 0.5 * robot.inertia.into() * w * w;
    for speed in robot.wheels.wheel_speeds(run.state.twist) {
        let speed: f64 = speed.into();
        sum += 0.5 * inertia * speed * speed;
    }
    sum
}

/// Every effect of some kind that can sit on all wheels or on the robot, typical, as many together as a model has room for
/// beside another, and the inertia that they add to a wheel [kg·m²].
fn everything<const N: usize, T: Real>(of: impl Fn(&Card) -> bool) -> Vec<(Effects<N, T>, f64)> {
    let wanted = |effect: &&EffectKind| effect.card().scope != Scope::OneWheel && of(effect.card());
    let all: Vec<&EffectKind> = EffectKind::ALL.iter().filter(wanted).collect();
    let together = |group: &[&EffectKind]| {
        let (mut effects, mut inertia) = (Effects::default(), 0.0);
        for effect in group {
            let params = typical(effect.card());
            inertia += effect.card().physics.inertia.map_or(0.0, |k| params[k]);
            let params: Vec<T> = params.into_iter().map(T::lit).collect();
            effects.add(**effect, None, &params).expect("room for as many");
        }
        (effects, inertia)
    };
    all.chunks(MAX_EFFECTS - 1).map(together).collect()
}

/// Each friction-like effect at several sizes, and all at once.
fn friction_like<const N: usize>(robot: Robot<N, f64>, check: impl Fn(&str, Plant<N, f64>, f64)) {
    for effect in EffectKind::ALL.iter().filter(|e| e.card().physics.passive) {
        let card = effect.card();
        for placement in placements(card, N).into_iter().take(2) {
            for part in [0.1, 0.5, 1.0] {
                let mut params = typical(card);
                for (value, p) in params.iter_mut().zip(card.params) {
                    if p.role == Role::Size {
                        // from absent to the bound that lies on the typical value's side
                        let most = if p.typical < p.absent { p.within.0 } else { p.within.1 };
                        *value = p.absent + part * (most - p.absent);
                    }
                }
                let inertia = card.physics.inertia.map_or(0.0, |k| params[k]);
                // an inertia on one wheel alone is not what `energy` counts
                if inertia == 0.0 || placement.is_none() {
                    check(
                        &format!("{} {params:?} on {placement:?}", card.id),
                        with_effect(robot, *effect, placement, &params),
                        inertia,
                    );
                }
            }
        }
    }
    for (all, inertia) in everything(|card| card.physics.passive) {
        check("all together", Plant::new(robot, all), inertia);
    }
    check("nothing", plain(robot), 0.0);
}

/// From several twists with the input held, no step may add to the energy; the robot comes to rest and stays there.
fn only_loses<const N: usize>(robot: Robot<N, f64>, input: Input<N, f64>) {
    friction_like(robot, |what, plant, inertia| {
        for twist in [[1.2, -0.7, 5.0], [0.3, 0.0, 0.0], [0.0, 0.0, -8.0], [-0.02, 0.03, 0.1]] {
            let mut run = Run::from(plant, [0.0; 3], twist);
            let first = energy(&run, inertia);
            let mut last = first;
            // heavy wheels roll on for some seconds
            for step in 0..if inertia > 0.0 { 16_000 } else { 1500 } {
                run.step(&input, 1e-3);
                let now = energy(&run, inertia);
                // rounding of the first energy; a body at rest keeps 1e-6 m/s where sweeps over budgets stop
                let rounding = 1e-15 * first + 1e-11;
                assert!(now <= last + rounding, "{what} from {twist:?}: step {step} adds {:e} J", now - last);
                last = now;
            }
            assert!(last < 1e-9, "{what} from {twist:?}: {last:e} J are left");
        }
    });
}

#[test]
fn with_the_bridge_open_friction_only_takes() {
    only_loses(three(), Input::Current([0.0; 3]));
    only_loses(four(), Input::Current([0.0; 4]));
}

#[test]
fn with_the_motors_shorted_friction_only_takes() {
    only_loses(three(), Input::Voltage([0.0; 3]));
    only_loses(four(), Input::Voltage([0.0; 4]));
}

/// Energy that appears beyond the motors' work in a step, largest over a random drive [J].
fn gained<const N: usize>(plant: Plant<N, f64>, inertia: f64, steps: u32) -> f64 {
    let kt = plant.robot().motor.wheel_torque_constant();
    let mut run = Run::new(plant);
    let mut most = 0.0_f64;
    for hold in voltages::<N>(21, 16, 9.0) {
        for _ in 0..hold.milliseconds * steps {
            let before = energy(&run, inertia);
            let here = run.drive(hold.u, 1e-3 / f64::from(steps));
            let after = energy(&run, inertia);
            let there = run.clone().drive(hold.u, 1e-3 / f64::from(steps));
            // ½·(τ(t) + τ(t + Δt))·½·(ω(t) + ω(t + Δt))·Δt: the midpoint rule's own work
            let work: f64 = (0..N)
                .map(|j| {
                    let torque = 0.5 * kt * (here.current[j] + there.current[j]);
                    torque * 0.5 * (here.wheel_speed[j] + there.wheel_speed[j]) * 1e-3 / f64::from(steps)
                })
                .sum();
            most = larger(most, after - before - work);
        }
    }
    most
}

#[test]
fn driven_or_not_friction_adds_nothing_to_the_motors_work() {
    let robot = four::<f64>();
    // on the shafts: what is in bridge and winding does not turn, and what a contact loses is not the motors' work
    for e in EffectKind::ALL.iter().filter(|e| e.card().seams == [Seam::Gear] && e.card().physics.passive) {
        let id = e.card().id;
        for placement in [None, Some(2)].into_iter().filter(|placement| e.card().scope.admits(*placement, 4)) {
            let inertia = e.card().physics.inertia.map_or(0.0, |k| typical(e.card())[k]);
            if inertia > 0.0 && placement.is_some() {
                continue;
            }
            let plant = with_effect(robot, *e, placement, &typical(e.card()));
            let [coarse, fine] = [1, 4].map(|steps| gained(plant, inertia, steps));
            // In a step in which something turns round, friction is spent for the whole step against the way it ends:
            // budget (2 N at most on an axis) times the way gone before, ½·a·Δt² with a of 10 m/s² = 5e-6 m
            assert!(coarse < 1e-5, "{id} on {placement:?}: {coarse:e} J");
            // the way gone before falls with the square of the step
            assert!(fine < 1e-6, "{id} on {placement:?}: {coarse:e} J, and {fine:e} J in a quarter of the step");
        }
    }
}

#[test]
fn the_turning_force_does_no_work() {
    let mut robot = four::<f64>();
    robot.friction = Default::default();
    let mut run = Run::from(with_effect(robot, effect("coriolis"), None, &[1.0]), [0.0; 3], [1.2, -0.7, 5.0]);
    let (first, start) = (energy(&run, 0.0), run.state.pose.to_world(run.state.twist));
    for _ in 0..2000 {
        run.step(&Input::Current([0.0; 4]), 1e-3);
    }
    // the linearly implicit midpoint rule turns by an angle that is wrong by (ω·Δt)³/12 a step, 2e-5 rad in all, and keeps
    // the length of the velocity
    assert!((energy(&run, 0.0) - first).abs() < 1e-12 * first, "{} against {first} J", energy(&run, 0.0));
    let world = run.state.pose.to_world(run.state.twist);
    assert!(gap([world.x, world.y], [start.x, start.y]) < 5e-5, "{world:?} against {start:?}");
}

/// On a floor tilted by `tilt`, from rest, after 2 s: has anything moved at all?
fn moves<const N: usize, T: Real + Into<f64>>(
    robot: Robot<N, T>,
    tilt: f64,
    mut effects: Effects<N, T>,
    theta: f64,
) -> bool {
    effects.add(effect("floor_tilt"), None, &[T::lit(tilt), T::lit(0.5)]).expect("room");
    let start = [0.3, -0.2, theta];
    let mut run = Run::from(Plant::new(robot, effects), start, [0.0; 3]);
    let pose = run.pose();
    for _ in 0..2000 {
        run.drive([0.0; N], 1e-3);
    }
    run.pose() != pose || run.twist() != [0.0; 3]
}

#[test]
fn a_robot_on_a_floor_tilted_too_little_stays_exactly_where_it_is() {
    // break-away: sin β = C_v/(M·g) = 0.082 at the least (four wheels); in any other direction more
    for theta in [0.0, 0.5, 1.3, -2.0] {
        assert!(!moves(three::<f64>(), 0.08, Effects::default(), theta), "three wheels, {theta}");
        assert!(!moves(four::<f64>(), 0.08, Effects::default(), theta), "four wheels, {theta}");
        assert!(!moves(three::<f32>(), 0.08, Effects::default(), theta), "three wheels, single precision, {theta}");
        assert!(!moves(four::<f32>(), 0.08, Effects::default(), theta), "four wheels, single precision, {theta}");
    }
    assert!(moves(four::<f64>(), 0.085, Effects::default(), 0.5), "C_v holds 0.0817");
    assert!(!moves(four::<f64>(), 0.09, Effects::default(), 0.5 + std::f64::consts::FRAC_PI_2), "C_vn holds 0.0969");
}

#[test]
fn a_robot_with_friction_on_its_shafts_stays_exactly_where_it_is() {
    for theta in [0.0, 0.5, 1.3, -2.0] {
        for card in EffectKind::ALL
            .map(EffectKind::card)
            .into_iter()
            .filter(|card| card.seams == [Seam::Gear] && card.scope != Scope::OneWheel)
        {
            let alone = |other: &Card| other.id == card.id;
            assert!(!moves(three::<f64>(), 0.08, everything(alone)[0].0, theta), "three wheels, {}, {theta}", card.id);
            assert!(!moves(four::<f64>(), 0.08, everything(alone)[0].0, theta), "four wheels, {}, {theta}", card.id);
            assert!(
                !moves(four::<f32>(), 0.08, everything(alone)[0].0, theta),
                "single precision, {}, {theta}",
                card.id
            );
        }
        // with the turning force, and all that lies between command and wheel; a contact that gives way does not hold
        let held = |card: &Card| card.physics.passive && card.stage() != Stage::Contact;
        let stays = |moves: bool, what: &str| assert!(!moves, "{what}, {theta}");
        everything(held)
            .into_iter()
            .for_each(|(all, _)| stays(moves(three::<f64>(), 0.08, all, theta), "three wheels"));
        everything(held).into_iter().for_each(|(all, _)| stays(moves(four::<f64>(), 0.08, all, theta), "four wheels"));
        everything(held)
            .into_iter()
            .for_each(|(all, _)| stays(moves(four::<f32>(), 0.08, all, theta), "single precision"));
    }
    // static friction is 1.5 times the kinetic: between the two a robot at rest stays
    assert!(!moves(four::<f64>(), 0.1, everything(|card| card.id == "stribeck")[0].0, 0.5), "stribeck holds 0.12");
    assert!(moves(four::<f64>(), 0.1, Effects::default(), 0.5));
}

#[test]
fn one_wheel_sticks_while_the_others_turn() {
    // a great deal of friction on the shaft of wheel 3, driven by the others
    let plant = with_effect(four::<f64>(), effect("stribeck"), Some(3), &[3.0, 0.5, 2.0]);
    let mut run = Run::new(plant);
    let (mut stuck, mut turning) = (0.0_f64, 0.0_f64);
    for _ in 0..500 {
        // forces that do not drive wheel 3: forward is left to wheel 1, which also turns the body
        let read = run.drive([4.0, -3.0, -4.0, 0.0], 1e-3);
        stuck = larger(stuck, read.wheel_speed[3].abs());
        turning = larger(turning, read.wheel_speed[0].abs());
    }
    // sweeps stop at 1e-6 m/s, over a radius of 32.5 mm
    assert!(stuck < 1e-4 && turning > 1.0, "wheel 3 turns at {stuck} rad/s, wheel 0 at {turning}");
}
