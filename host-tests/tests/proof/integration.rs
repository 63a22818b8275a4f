//! The fixed step's error, effect by effect, against the same plant at a hundredth of the step.
//!
//! The page `golden/integration.md` holds the figures; here stands what they must keep within.

use std::fmt::Write;

use host_tests::excitation::{VoltageHold, voltages};
use model_core::effects::EffectKind;
use model_core::effects::active::Effects;
use model_core::plant::robot::Robot;
use model_core::plant::{Plant, Reading};

use crate::fixture::{Run, beside, effect, four, gap, larger, plain, three, typical, usual_placement};
use crate::golden::{self, two_digits};

/// The most at 1 ms, [m/s, rad/s, m, rad, A], of a model in which nothing switches but dry friction; in proportion to the
/// step's square.
///
/// After a change Δx of the steady speed, the trapezoidal rule is at most Δx·(Δt/τ)²/(12·e) off: 2 m/s and τ = 0.3 s make
/// 0.7 µm/s, 40 rad/s and τ = 0.17 s 43 µrad/s. Reversals add what their instant is wrong by, Δt²/τ times friction's
/// 1.6 m/s² and 12 rad/s², 5 µm/s and 70 µrad/s at the most where one falls into the middle of a step. A way is late by the
/// speed's error over τ; a current is 0.03 A for each rad/s of its wheel, 0.9 A for each m/s.
const SMOOTH_AT_1_MS: [f64; 5] = [8e-6, 1.2e-4, 4e-6, 2e-5, 1e-5];

/// The same of one whose forces bend more over time.
fn smooth_at_1_ms(id: &str) -> [f64; 5] {
    match id {
        // c·ω² bends by 2·c·(ω̇² + ω·ω̈), some 500 m/s⁴ at 40 rad/s and 100 rad/s²: times Δt²/12 over 0.3 s, 12 µm/s more
        "cog_offset" => [2.4e-5, 1.2e-4, 8e-6, 2e-5, 2.4e-5],
        // 700 rad/s of ringing are (ω₀·Δt)²/12, 4 %, slow: after a step of 0.5 N·m they have 17 rad/s of the rotor, 0.5 A, and
        // by a share J/J_load of it, a tenth, of the body
        "shaft_elasticity" => [2.5e-3, 2.8e-2, 2e-4, 8e-4, 4.5e-2],
        // where a motor begins to brake or stops braking, the force's slope is that of the step's beginning: a·Δt²/(2·τ) of
        // 8 m/s² and 100 rad/s² more, 13 µm/s and 290 µrad/s
        "regeneration_asymmetry" => [2.1e-5, 4.1e-4, 8e-6, 4e-5, 2.2e-5],
        // a body on springs of 57 rad/s swings by up to 28 mm/s and 0.26 rad/s: (ω₀·Δt)²/12 of that for each radian
        "presliding" => [4e-5, 3e-4, 1.2e-5, 1e-4, 4e-5],
        // a wheel that slips settles in J/(r²·μ·N·B) = 1 ms. Of a jump by 10 rad/s the two stages keep 35 % for e⁻¹ over 1 ms
        // and 7 % for e⁻² over 2 ms: 0.17 and 0.67 rad/s off, 5 and 20 mA, and J/r times that, 0.4 and 1.4 mN·s, on the body
        "wheel_slip" | "uneven_load" => [4e-4, 4e-3, 1e-4, 1e-3, 7e-3],
        _ => SMOOTH_AT_1_MS,
    }
}

/// The same of one that something else is late in, in proportion to the step.
fn late_at_1_ms(id: &str) -> Option<[f64; 5]> {
    Some(match id {
        // the bus is that of the currents at the step's beginning: 0.1 Ω·10 A/s·1 ms of 12 V, of 2 m/s and 40 rad/s
        "supply_sag" => [2e-4, 3e-3, 1e-4, 1e-3, 2e-4],
        // the budget of a wheel is that of its speed at the step's beginning: a part of its friction, up to a half of
        // 1.6 m/s² and of 12 rad/s², is a step late at every start and reversal
        // (friction_ellipse: that of the body is the share of an axis in the speed at the step's beginning)
        "friction_ellipse" | "gear_efficiency" | "stribeck" | "supply_sag, dead_time, gear_efficiency" => {
            [8e-4, 8e-3, 3e-4, 2e-3, 8e-4]
        }
        // where two directions come to rest in one step, the instant of one changes with the other's friction, which is not
        // looked at again: that friction, 0.6 N at one rim of the light body, is up to a step late
        "wheel_friction" | "asymmetric_friction" | "roller_friction" | "friction_warmup" => {
            [3.2e-4, 3.2e-3, 1e-4, 1e-3, 4e-4]
        }
        // Near rest a detent more or less is passed, which lends 2·√(τ_c² + τ_s²)/(N·l) = 48 µJ: 1 cm/s at a rim that moves as
        // 1 kg, and 0.5 mm from one to the next
        "cogging" => [1e-2, 6e-2, 5e-4, 6e-3, 1e-2],
        // the radius is that at the step's beginning: 5e-3 of 16 N on 1 kg, and on 0.0169 kg·m² at 89 mm, for half a step twice
        "wheel_eccentricity" | "roller_ripple" => [8e-5, 5e-4, 1e-5, 6e-5, 8e-5],
        // the instant at which teeth meet is up to a step late: a rotor that 0.1 N·m has driven through the play turns 7 rad/s
        // faster, which is 0.2 A, and 0.013 N·s at a rim
        "backlash" => [1e-2, 0.13, 1e-3, 4e-3, 0.25],
        // the resistance is that of the step's beginning, half a step late: it rises by α·R_θ/τ times up to 70 W, 0.07/s, so
        // that 4 A are 0.14 mA off, and the speed by as much as such a current makes in 0.1 s
        "winding_heating" => [3e-5, 3e-4, 1e-5, 5e-5, 1.4e-4],
        // where friction holds until the current has risen enough, a part of L/R = 0.12 ms of it is not spent, in any step
        // that is longer: 1.6 m/s² and 12 rad/s²
        "winding_inductance" => [1.9e-4, 1.4e-3, 6e-5, 5e-4, 3e-4],
        // along its way a ripple is a row of hills, a·n·l/r = 320/m of the force: on their crests a slow wheel's error grows
        // by e in 1/√(320/m·1 m/s²) = 56 ms, by 400 in a third of a second
        "commutation_ripple" => [3.2e-3, 4.8e-2, 1.6e-3, 8e-3, 4e-3],
        // poses are remembered 4 ms apart, with chords between them: 100 rad/s² and 8 m/s² times (4 ms)²/8, at any step
        "camera_latency" | "clock_drift" => [8e-6, 1.2e-4, 3e-5, 4e-4, 1e-5],
        // what is read is the mean over 0.1 ms, of the reference over its step of 0.01 ms: of a jump by 18 V, 4.2 A, which a
        // lag of 2 ms smooths, 0.09 ms/(2·T)
        "current_lag" => [8e-6, 1.2e-4, 4e-6, 2e-5, 0.1],
        // the acceleration is that of the last step: for one step after a jump of the voltages a wheel may push with 0.4 N too
        // much, 0.2 mm/s and 2 mrad/s at a time, and spins up by 0.2 rad/s more, 6 mA
        "load_transfer" => [8e-4, 8e-3, 1.2e-4, 2e-3, 2e-2],
        // where a current passes zero the torque of a motor with dead time bends: over a step in which its wheel slips it is
        // that along the line at its end
        "dead_time, wheel_slip" => [4e-4, 5e-3, 1.2e-4, 2e-3, 2.5e-2],
        _ => return None,
    })
}

/// The most that steps of so many milliseconds may be off by.
fn most_at(id: &str, milliseconds: f64) -> [f64; 5] {
    if id == SLOWED_AND_SLIPPING {
        // friction that depends on the speed is late, in proportion to the step, and a wheel that slips is off by its square
        let (late, off) = (most_at("stribeck", milliseconds), most_at("wheel_slip", milliseconds));
        return std::array::from_fn(|k| late[k] + off[k]);
    }
    match late_at_1_ms(id) {
        Some(late) => late.map(|late| milliseconds * late),
        None => smooth_at_1_ms(id).map(|smooth| milliseconds * milliseconds * smooth),
    }
}

/// Three effects, as their row is called.
const SLOWED_AND_SLIPPING: &str = "stribeck, wheel_slip, rotor_inertia";

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
            let input = run.send(hold.u);
            for _ in 0..steps {
                let twist = run.twist();
                let read = run.step(&input, dt);
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
        all.push((card.id, beside(robot, *effect, Some((usual_placement(card), &typical(card))))));
    }
    // laws that need each other's answer, and the worst that wheels meet together
    for (name, ids) in [
        ("dead_time, wheel_slip", &["dead_time", "wheel_slip"][..]),
        (SLOWED_AND_SLIPPING, &["stribeck", "wheel_slip", "rotor_inertia"]),
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
    page += "The largest error over two seconds of random driving at up to 9 V (drives that control the speed: 9 rad/s), each model against itself at steps of 10 µs.\n";
    page += "Every effect has its typical size. Halving the step quarters the error, but where friction depends on the speed\n";
    page +=
        "or on its direction (gear_efficiency, stribeck, friction_ellipse), where the bus depends on the currents\n";
    page += "(supply_sag) or a torque bends while its wheel slips (dead_time, wheel_slip), where the radius\n";
    page += "is that at a step's beginning (wheel_eccentricity, roller_ripple), where a load goes by the acceleration of the step\n";
    page +=
        "before (load_transfer, beside wheel_slip as uneven_load), and where a motor is as warm as before the step\n";
    page += "(winding_heating): there it halves it. Where two directions come to rest in one step (wheel_friction,\n";
    page += "asymmetric_friction, roller_friction, friction_warmup), where teeth meet (backlash), and where a current rises while\n";
    page += "friction still holds (winding_inductance), it depends on the instants, up to a step late. Which detent a robot stops\n";
    page += "in or starts from is decided by the smallest differences (cogging), and along a ripple (commutation_ripple) errors\n";
    page += "grow.\n";
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
            for (error, most) in errors.iter().zip(most_at(id, step)) {
                assert!(*error <= most, "{id} at {step} ms: {errors:?}");
            }
        }
    }
    golden::holds("integration.md", &page);
}
