//! The machine against the laws of its circuit, written down a second time.

use super::*;

/// R [Ω], L [H], K_v [V·s] of the DC motor that it stands for.
const R: f64 = 4.3111;
const L: f64 = 0.6e-3;
const KV: f64 = 0.0259;
const DT: f64 = 50e-6;
const BUS: f64 = 12.0;

fn machine() -> Machine {
    Machine::dc_equivalent(R, L, KV, 8)
}

/// Duties whose mean vector over a period is `d + jq` [V] in the axes of the magnet at the period's middle.
fn duties(magnet: RotorFlux, d: f64, q: f64) -> [f64; 3] {
    phases(Vector::new(d, q) * Vector::from_polar(1.0, magnet.after(0.5 * DT).angle)).map(|v| 0.5 + v / BUS)
}

/// Runs with held d and q voltages [V] until all is settled, and gives the mean of the last periods, a whole turn of
/// them.
fn settled(machine: &Machine, speed: f64, d: f64, q: f64) -> PeriodResult {
    let (mut current, mut magnet) = (Vector::default(), RotorFlux { angle: 0.3, speed });
    let turn = if speed == 0.0 { 1 } else { (TAU / (speed.abs() * DT)).round() as usize };
    let mut mean = PeriodResult::default();
    for k in 0..1000 + turn {
        let legs = BridgeLegs { duties: duties(magnet, d, q), bus: BUS, enabled: true };
        let outcome = machine.period(&mut current, &legs, magnet, DT);
        magnet.angle += magnet.speed * DT;
        if k >= 1000 {
            mean.current += outcome.current / turn as f64;
            mean.bus_current += outcome.bus_current / turn as f64;
        }
    }
    mean
}

#[test]
fn locked_it_is_the_dc_motor_at_every_angle() {
    for k in 0..36 {
        let (mut current, magnet) = (Vector::default(), RotorFlux { angle: f64::from(k) * TAU / 36.0, speed: 0.0 });
        let u = 5.0;
        let legs = BridgeLegs { duties: duties(magnet, 0.0, u / 3.0_f64.sqrt()), bus: BUS, enabled: true };
        let mut outcome = PeriodResult::default();
        for n in 1..=40 {
            outcome = machine().period(&mut current, &legs, magnet, DT);
            // ∫i dt over the period, of i(t) = u/R·(1 − e^{−t·R/L})
            let e = |t: f64| (-t * R / L).exp();
            let (from, to) = (DT * f64::from(n - 1), DT * f64::from(n));
            let mean = u / R * (1.0 - L / (R * DT) * (e(from) - e(to)));
            assert!((outcome.current - mean).abs() < 1e-12, "{} for {mean}", outcome.current);
        }
        // U·I_bus = R·i², e^{−40·0.36} of it on the way
        assert!((BUS * outcome.bus_current - u * u / R).abs() < 1e-5 * u * u / R, "{outcome:?}");
    }
}

#[test]
fn the_settled_current_is_what_voltage_less_back_emf_drives_through_the_resistance() {
    for motor_speed in [-200.0, -40.0, 40.0, 200.0] {
        let (m, speed) = (machine(), 8.0 * motor_speed);
        let u = 3.0;
        // the d axis is held free of current by v_d = −ω·L·i_q, as a current loop does; sinc: a held vector in turning
        // axes
        let want = (u - KV * motor_speed) / R;
        let i_q = 2.0 / 3.0_f64.sqrt() * want;
        let half = 0.5 * speed * DT;
        let held = half / half.sin();
        let got = settled(&m, speed, -speed * m.inductance * i_q * held, u / 3.0_f64.sqrt() * held);
        // held vectors ripple: (ω·Δt)²/24 of the voltage across L, 2 parts in ten thousand at 1600 rad/s
        assert!((got.current - want).abs() < 2e-3 * u / R, "{} for {want} at {motor_speed}", got.current);
    }
}

#[test]
fn the_bus_pays_for_heat_and_for_the_shaft() {
    // the power balance of one period, its integrals taken from many small ones
    for (angle, speed) in [(0.0, 0.0), (1.0, 500.0), (2.0, -3000.0), (4.0, 9000.0)] {
        let m = machine();
        let start = Vector::new(0.7, -1.1);
        let legs = BridgeLegs { duties: [0.8, 0.3, 0.45], bus: BUS, enabled: true };
        let mut whole = start;
        let outcome = m.period(&mut whole, &legs, RotorFlux { angle, speed }, DT);
        let (mut current, mut heat, n) = (start, 0.0, 10_000);
        for k in 0..n {
            let h = DT / f64::from(n);
            let before = current;
            m.period(&mut current, &legs, RotorFlux { angle: angle + speed * h * f64::from(k), speed }, h);
            // 3/2·R·|i|², by the trapezium
            heat += 1.5 * m.resistance * 0.5 * (before.norm_sqr() + current.norm_sqr()) * h;
        }
        assert!((whole - current).norm() < 1e-10);
        let stored = 1.5 * 0.5 * m.inductance * (current.norm_sqr() - start.norm_sqr());
        // τ·ω_m = K_v·i·ω_m, with the DC-equivalent current
        let shaft = KV * outcome.current * speed / m.pole_pairs * DT;
        let paid = BUS * outcome.bus_current * DT;
        // the trapezium's error is below 1e-6 of the heat
        assert!((paid - heat - stored - shaft).abs() < 1e-6 * (heat + paid.abs()), "{paid} {heat} {stored} {shaft}");
    }
}

#[test]
fn one_turn_of_the_axes_is_one_exchange_of_the_phases() {
    let m = Machine { loss: Some(LegLoss::dc_equivalent(0.3, 0.05)), ..machine() };
    let run = |shift: usize| {
        let mut current = Vector::from_polar(0.8, 0.2 + TAU / 3.0 * shift as f64);
        let mut duties = [0.7, 0.2, 0.6];
        duties.rotate_right(shift);
        let magnet = RotorFlux { angle: 0.9 + TAU / 3.0 * shift as f64, speed: 700.0 };
        let outcome = m.period(&mut current, &BridgeLegs { duties, bus: BUS, enabled: true }, magnet, DT);
        let mut left = phases(current);
        left.rotate_left(shift);
        (outcome, left)
    };
    let (first, left) = run(0);
    for shift in [1, 2] {
        let (other, others) = run(shift);
        assert!((first.current - other.current).abs() < 1e-13);
        assert!((first.bus_current - other.bus_current).abs() < 1e-13);
        assert!(left.iter().zip(others).all(|(a, b)| (a - b).abs() < 1e-13));
    }
}

#[test]
fn an_open_bridge_carries_nothing() {
    let mut current = Vector::new(3.0, 1.0);
    let legs = BridgeLegs { duties: [0.9, 0.1, 0.1], bus: BUS, enabled: false };
    let outcome = machine().period(&mut current, &legs, RotorFlux { angle: 1.0, speed: 900.0 }, DT);
    assert_eq!((outcome, current), (PeriodResult::default(), Vector::default()));
}

#[test]
fn dead_time_costs_its_dc_equivalent_voltage_over_a_turn() {
    let (voltage, smoothing) = (0.3, 0.05);
    let m = Machine { loss: Some(LegLoss::dc_equivalent(voltage, smoothing)), ..machine() };
    // slow enough for the winding to follow, 50 periods for a sixth of a turn
    let speed = TAU / (300.0 * DT);
    for u in [2.0, -3.0] {
        let want = (u - KV * speed / 8.0 - voltage * f64::signum(u)) / R;
        let got = settled(&m, speed, 0.0, u / 3.0_f64.sqrt()).current;
        // the loss jumps six times a turn and ripples ±5 % of the loss in between; what it does to i_d is second order
        assert!((got - want).abs() < 0.04 * voltage / R + 2e-3 * u.abs() / R, "{got} for {want}");
    }
    // within the ripple it is a resistance of V_d/i₀
    let u = 0.05;
    let got = settled(&m, 0.0, 0.0, u / 3.0_f64.sqrt()).current;
    assert!((got - u / (R + voltage / smoothing)).abs() < 1e-9, "{got}");
}

#[test]
fn the_mean_of_an_exponential_is_the_same_on_both_sides_of_its_series() {
    for turn in 0..12 {
        let at = |size: f64| mean_exp(Vector::from_polar(size, TAU / 12.0 * f64::from(turn)));
        assert!((at(0.5 - 1e-9) - at(0.5 + 1e-9)).norm() < 2e-9);
        assert!((at(1e-12) - 1.0).norm() < 1e-12 && at(0.0) == Vector::new(1.0, 0.0));
    }
}

#[test]
fn a_machine_with_an_open_phase_is_the_circuit_of_the_other_two() {
    // 2·L·di/dt = v_y − v_z − 2·R·i − (e_y − e_z), by small steps of the circuit itself
    let (duties, magnet, dt) = ([0.7, 0.2, 0.5], RotorFlux { angle: 0.4, speed: 900.0 }, 50e-6);
    for open in 0..3 {
        let m = Machine { open_phase: Some(open), ..machine() };
        let (y, z) = ((open + 1) % 3, (open + 2) % 3);
        let legs = BridgeLegs { duties, bus: BUS, enabled: true };
        let (mut current, mut outcome) = (Vector::default(), PeriodResult::default());
        let (mut i, mut torque, mut drawn) = (0.0, 0.0, 0.0);
        for k in 0..20 {
            outcome = m.period(&mut current, &legs, magnet.after(f64::from(k) * dt), dt);
            (torque, drawn) = (0.0, 0.0);
            let steps = 2000;
            for n in 0..steps {
                let angle = magnet.after((f64::from(k) + (f64::from(n) + 0.5) / f64::from(steps)) * dt).angle;
                // e_x = −ω·λ·sin(θ − 120°·x)
                let of = |x: usize| -(angle - std::f64::consts::TAU / 3.0 * x as f64).sin();
                let emf = 900.0 * m.flux * (of(y) - of(z));
                let rate = ((duties[y] - duties[z]) * BUS - 2.0 * m.resistance * i - emf) / (2.0 * m.inductance);
                let middle = i + 0.5 * rate * dt / f64::from(steps);
                i += rate * dt / f64::from(steps);
                // ī = √3/2·i_q, and the power of the back-EMF is 3/2·ω·λ·i_q
                torque += 0.5 * 3.0_f64.sqrt() * middle * (of(y) - of(z)) * (2.0 / 3.0) / f64::from(steps);
                drawn += (duties[y] - duties[z]) * middle / f64::from(steps);
            }
        }
        let flows = phases(current);
        assert!(flows[open].abs() < 1e-12 && (flows[y] + flows[z]).abs() < 1e-12, "{flows:?}");
        // first-order steps of 25 ns
        assert!((flows[y] - i).abs() < 1e-4 * i.abs().max(1.0), "{open}: {} {i}", flows[y]);
        assert!((outcome.current - torque).abs() < 1e-3 && (outcome.bus_current - drawn).abs() < 1e-3, "{outcome:?}");
    }
}
