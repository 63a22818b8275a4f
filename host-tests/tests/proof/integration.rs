//! The fixed step's error, effect by effect, against the same plant at a hundredth of the step.
//!
//! The page `golden/integration.md` holds the figures; here stands what they must keep within.

use std::fmt::Write;

use host_tests::excitation::{VoltageHold, voltages};
use model_core::effects::EffectKind;
use model_core::effects::active::Effects;
use model_core::plant::robot::Robot;
use model_core::plant::{Plant, Reading};

use crate::fixture::{Run, effect, four, gap, larger, plain, three, typical, usual_placement, with_effect};
use crate::golden::{self, two_digits};

/// The nominal model's most at 1 ms [m/s, rad/s, m, rad, A]; in proportion to the step.
///
/// A reversal spends friction for up to a step too long, |K|·Δt: 1.05 mm/s and 6.1 mrad/s, felt on two reversals in short
/// succession, of which the motors damp the first within 100 ms. That makes 2 mm/s and 12 mrad/s; over 100 ms 0.2 mm and
/// 1.2 mrad each time, some of the dozen reversals in 2 s adding up; a current is l·Kv/R = 0.03 A for each rad/s of its
/// wheel, 0.9 A for each m/s.
const AT_1_MS: [f64; 5] = [2e-3, 12e-3, 1e-3, 3e-3, 2e-3];

/// What is seen every 2 ms: v, vn, ω; the pose and the currents that are read.
struct Seen<const N: usize> {
    twist: [f64; 3],
    pose: [f64; 3],
    current: [f64; N],
}

/// Two seconds of random holds, whole numbers of 2 ms.
fn holds<const N: usize>() -> Vec<VoltageHold<N>> {
    let mut left = 2000;
    let mut holds = voltages::<N>(17, 60, 9.0);
    holds.retain_mut(|hold| {
        hold.milliseconds = hold.milliseconds.next_multiple_of(2).min(left);
        left -= hold.milliseconds;
        hold.milliseconds > 0
    });
    holds
}

/// A run with steps of `dt` = 2 ms/`steps`.
fn record<const N: usize>(plant: Plant<N, f64>, steps: u32) -> Vec<Seen<N>> {
    let dt = 2e-3 / f64::from(steps);
    let mut run = Run::new(plant);
    let mut seen = Vec::new();
    for hold in holds::<N>() {
        for _ in 0..hold.milliseconds / 2 {
            let mut first: Option<(Reading<N, f64>, [f64; 3])> = None;
            for _ in 0..steps {
                let twist = run.twist();
                let read = run.drive(hold.u, dt);
                first.get_or_insert((read, twist));
            }
            let (read, twist) = first.expect("a step");
            seen.push(Seen { twist, pose: [read.pose.x, read.pose.y, read.pose.theta], current: read.current });
        }
    }
    seen
}

/// Largest differences: [m/s, rad/s, m, rad, A].
fn differences<const N: usize>(a: &[Seen<N>], b: &[Seen<N>]) -> [f64; 5] {
    a.iter().zip(b).fold([0.0; 5], |worst, (a, b)| {
        let [v, vn, w] = [0, 1, 2].map(|k| (a.twist[k] - b.twist[k]).abs());
        let [x, y, theta] = [0, 1, 2].map(|k| (a.pose[k] - b.pose[k]).abs());
        let now = [larger(v, vn), w, larger(x, y), theta, gap(a.current, b.current)];
        std::array::from_fn(|k| larger(worst[k], now[k]))
    })
}

fn models<const N: usize>(robot: Robot<N, f64>) -> Vec<(&'static str, Plant<N, f64>)> {
    let mut all = vec![("nothing", plain(robot))];
    for effect in &EffectKind::ALL {
        let card = effect.card();
        all.push((card.id, with_effect(robot, *effect, usual_placement(card), &typical(card))));
    }
    // laws that need each other's answer, and the worst that wheels meet together
    for (name, ids) in [
        ("dead_time, wheel_slip", &["dead_time", "wheel_slip"][..]),
        ("stribeck, wheel_slip, rotor_inertia", &["stribeck", "wheel_slip", "rotor_inertia"]),
        ("supply_sag, dead_time, gear_efficiency", &["supply_sag", "dead_time", "gear_efficiency"]),
    ] {
        let mut effects = Effects::default();
        for id in ids {
            let effect = effect(id);
            effects.add(effect, None, &typical(effect.card())).expect("room");
        }
        all.push((name, Plant::new(robot, effects)));
    }
    all
}

/// Rows of the page, and (id, errors at 1 ms, errors at 2 ms).
fn rows<const N: usize>(robot: Robot<N, f64>) -> Vec<(&'static str, [f64; 5], [f64; 5])> {
    models(robot)
        .into_iter()
        .map(|(id, plant)| {
            let fine = record(plant, 200);
            (id, differences(&record(plant, 2), &fine), differences(&record(plant, 1), &fine))
        })
        .collect()
}

#[test]
fn the_steps_error_is_what_the_page_says() {
    let (three, four) = std::thread::scope(|scope| {
        let three = scope.spawn(|| rows(three()));
        let four = rows(four());
        (three.join().expect("three wheels"), four)
    });
    let mut page = String::from("# What a step costs\n\n");
    page += "The largest error over two seconds of random driving at up to 9 V, each model against itself at steps of 10 µs.\n";
    page += "Every effect has its typical size. The errors come from the instants at which something switches: an axis or a\n";
    page += "wheel that turns round spends friction for up to a step too long.\n";
    let _ =
        page.write_str("`host-tests/tests/proof/integration.rs` makes this page and holds its figures to bounds.\n");
    for (wheels, rows) in [("Three wheels", &three), ("Four wheels", &four)] {
        for (k, step) in ["1 ms", "2 ms"].into_iter().enumerate() {
            let _ = writeln!(page, "\n## {wheels}, steps of {step}\n");
            page += "| effect | v, vn [mm/s] | ω [mrad/s] | x, y [mm] | θ [mrad] | current [mA] |\n";
            page += "|---|---|---|---|---|---|\n";
            for (id, at_1, at_2) in rows {
                let cells = if k == 0 { at_1 } else { at_2 }.map(|x| two_digits(1e3 * x)).join(" | ");
                let _ = writeln!(page, "| {id} | {cells} |");
            }
        }
    }
    for (id, at_1, at_2) in three.iter().chain(&four) {
        for (step, errors) in [(1.0, at_1), (2.0, at_2)] {
            let room = match *id {
                "nothing" => [1.0; 5],
                // a wheel that slips and has inertia ends an implicit step, first order: it spins up by 0.2 N·m/J_w =
                // 2600 rad/s², so that its speed is 1.3 rad/s late in a step of 1 ms and its current 40 mA; the force
                // that is late with it turns the light body
                "stribeck, wheel_slip, rotor_inertia" => [2.0, 5.0, 2.0, 4.0, 20.0],
                // friction that the effect adds is spent too long as well: stribeck has half as much again, a gear a sixth
                _ => [2.0; 5],
            };
            for ((error, most), room) in errors.iter().zip(AT_1_MS).zip(room) {
                assert!(*error <= step * room * most, "{id} at {step} ms: {errors:?}");
            }
        }
    }
    golden::holds("integration.md", &page);
}
