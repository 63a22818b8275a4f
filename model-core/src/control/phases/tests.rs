use super::*;
use core::f64::consts::{FRAC_PI_3, FRAC_PI_6, TAU};

/// Tolerance: a few dozen roundings of numbers about 10.
const CLOSE: f64 = 1.0e-14 * 10.0;

/// A number in −1 ..= 1 that looks random, the same in every run.
fn noise(seed: &mut u32) -> f64 {
    *seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
    f64::from(*seed >> 8) / f64::from(1_u32 << 23) - 1.0
}

/// Three phases that sum to zero, each up to 10.
fn three(seed: &mut u32) -> [f64; 3] {
    let (a, b) = (5.0 * noise(seed), 5.0 * noise(seed));
    [a, b, -a - b]
}

fn dot(x: [f64; 3], y: [f64; 3]) -> f64 {
    x[0] * y[0] + x[1] * y[1] + x[2] * y[2]
}

fn assert_close<const M: usize>(got: [f64; M], want: [f64; M], within: f64) {
    for (g, w) in got.into_iter().zip(want) {
        assert!((g - w).abs() <= within, "{got:?} against {want:?}");
    }
}

/// Back-EMF of the three phases [V] at λ = 1 V·s and ω_e = 1 rad/s: −sin of each phase's own angle.
fn emf(angle: f64) -> [f64; 3] {
    [0.0, 1.0, 2.0].map(|k| -libm::sin(angle - k * TAU / 3.0))
}

fn span([a, b, c]: [f64; 3]) -> f64 {
    a.max(b).max(c) - a.min(b).min(c)
}

#[test]
fn a_balanced_set_is_a_vector_of_its_amplitude_and_angle() {
    for k in 0..360 {
        let angle = f64::from(k) * TAU / 360.0;
        let phases = [0.0, 1.0, 2.0].map(|k| 7.0 * libm::cos(angle - k * TAU / 3.0));
        let vector = AlphaBeta::clarke(phases);
        assert_close([vector.alpha, vector.beta], [7.0 * libm::cos(angle), 7.0 * libm::sin(angle)], CLOSE);
        let rotor = Rotation::of_angle(angle).park(vector);
        assert_close([rotor.d, rotor.q], [7.0, 0.0], CLOSE);
    }
}

#[test]
fn three_phases_come_back_from_the_rotor_at_every_angle() {
    let mut seed = 1;
    for k in 0..1000 {
        let (phases, rotation) = (three(&mut seed), Rotation::of_angle(0.05 * f64::from(k) - 20.0));
        let rotor = rotation.park(AlphaBeta::clarke(phases));
        assert_close(rotation.inverse_park(rotor).inverse_clarke(), phases, CLOSE);
    }
}

#[test]
fn what_the_phases_have_in_common_drops_out() {
    let AlphaBeta { alpha, beta } = AlphaBeta::clarke([3.0, 3.0, 3.0]);
    assert_close([alpha, beta], [0.0, 0.0], CLOSE);
    let (x, y) = (AlphaBeta::clarke([1.0, -2.0, 0.5]), AlphaBeta::clarke([5.0, 2.0, 4.5]));
    assert_close([x.alpha, x.beta], [y.alpha, y.beta], CLOSE);
}

#[test]
fn power_is_that_of_the_three_phases_and_of_the_dc_equivalent_motor() {
    let mut seed = 2;
    for k in 0..1000 {
        let (u, i) = (three(&mut seed), three(&mut seed));
        let rotation = Rotation::of_angle(0.1 * f64::from(k));
        let (u_dq, i_dq) = (rotation.park(AlphaBeta::clarke(u)), rotation.park(AlphaBeta::clarke(i)));
        // u_a·i_a + u_b·i_b + u_c·i_c = 3/2·(u_d·i_d + u_q·i_q)
        let power = dot(u, i);
        assert!((power - 1.5 * (u_dq.d * i_dq.d + u_dq.q * i_dq.q)).abs() <= 10.0 * CLOSE);
        let equivalent = dc_voltage(u_dq.q) * dc_current(i_dq.q) + dc_voltage(u_dq.d) * dc_current(i_dq.d);
        assert!((power - equivalent).abs() <= 10.0 * CLOSE);
    }
}

#[test]
fn heat_is_that_of_the_three_resistances() {
    let mut seed = 3;
    for _ in 0..100 {
        let i = three(&mut seed);
        let AlphaBeta { alpha, beta } = AlphaBeta::clarke(i);
        let (x, y) = (dc_current(alpha), dc_current(beta));
        // R_phase·(i_a² + i_b² + i_c²) = 2·R_phase·i²
        assert!((0.7 * dot(i, i) - dc_impedance(0.7) * (x * x + y * y)).abs() <= 10.0 * CLOSE);
    }
}

#[test]
fn a_rotor_a_little_ahead_is_turned_by_that_angle() {
    for k in -50..=50 {
        let (angle, ahead) = (0.37 * f64::from(k), 0.01 * f64::from(k));
        let (got, want) = (Rotation::of_angle(angle).ahead(ahead), Rotation::of_angle(angle + ahead));
        // the next terms of the series
        let [square, left] = [ahead * ahead, libm::pow(ahead, 4.0) / 24.0];
        assert_close([got.sin, got.cos], [want.sin, want.cos], left * (1.0 + 0.2 * ahead.abs()) + CLOSE);
        let length = libm::sqrt(got.sin * got.sin + got.cos * got.cos);
        assert!(length <= 1.0 + CLOSE && length >= 1.0 - left * (1.0 + square) - CLOSE, "{length}");
    }
}

#[test]
fn naming_the_phases_onward_turns_the_vector_by_a_third() {
    let mut seed = 4;
    for _ in 0..100 {
        let [a, b, c] = three(&mut seed);
        let x = AlphaBeta::clarke([a, b, c]);
        let y = AlphaBeta::clarke([c, a, b]);
        let (sin, cos) = (libm::sin(TAU / 3.0), libm::cos(TAU / 3.0));
        assert_close([y.alpha, y.beta], [cos * x.alpha - sin * x.beta, sin * x.alpha + cos * x.beta], CLOSE);
        let duties = space_vector(x, 0.02);
        assert_close(space_vector(y, 0.02), [duties[2], duties[0], duties[1]], CLOSE);
    }
}

#[test]
fn a_sinusoidal_machine_has_the_torque_and_the_back_emf_of_its_dc_equivalent() {
    let (kv, pairs, speed) = (0.0259, 8_u8, 310.0);
    let flux = flux_linkage(kv, pairs);
    let electrical = speed * f64::from(pairs);
    for k in 0..720 {
        let angle = f64::from(k) * TAU / 720.0;
        let rotation = Rotation::of_angle(angle);
        // phase currents of 1.3 A DC-equivalent along q, as three sine waves
        let i = rotation.inverse_park(DirectQuadrature { d: 0.0, q: q_current(1.3) }).inverse_clarke();
        let back = emf(angle).map(|e| e * electrical * flux);
        // τ = Σ e_k·i_k/ω_m is K_t·i with K_t = K_v, at every angle
        assert!((dot(back, i) / speed - kv * 1.3).abs() <= 1e-15, "{angle}");
        // and the back-EMF is K_v·ω_m, all of it along q
        let e = rotation.park(AlphaBeta::clarke(back));
        assert_close([dc_voltage(e.d), dc_voltage(e.q)], [0.0, kv * speed], 1e-13);
    }
}

#[test]
fn the_largest_voltage_between_two_terminals_is_the_dc_equivalent_one() {
    // K_v is measured with open terminals: the crest of u_b − u_c
    let crest = (0..3600).map(|k| emf(f64::from(k) * TAU / 3600.0)).map(|[_, b, c]| b - c).fold(0.0, f64::max);
    assert!((crest - dc_voltage(1.0)).abs() < 1e-12, "{crest}");
}

#[test]
fn duties_give_the_voltages_between_the_terminals_and_are_centred() {
    let mut seed = 5;
    for _ in 0..1000 {
        let u = three(&mut seed);
        let [a, b, c] = space_vector(AlphaBeta::clarke(u), 1.0 / 24.0);
        assert_close([24.0 * (a - b), 24.0 * (b - c), 24.0 * (c - a)], [u[0] - u[1], u[1] - u[2], u[2] - u[0]], CLOSE);
        assert!((a.max(b).max(c) + a.min(b).min(c) - 1.0).abs() <= CLOSE, "{a} {b} {c}");
    }
    assert_eq!(space_vector(AlphaBeta::<f64>::default(), 0.1), [0.5; 3]);
}

#[test]
fn the_whole_bus_is_reached_at_every_angle_and_just_reached_at_six() {
    let mut widest = 0.0_f64;
    for k in 0..3600 {
        let rotation = Rotation::of_angle(f64::from(k) * TAU / 3600.0);
        let vector = rotation.inverse_park(DirectQuadrature { d: 0.0, q: q_voltage(24.0) });
        let duties = space_vector(vector, 1.0 / 24.0);
        widest = widest.max(span(duties));
        // sine waves without the common part would already need 2/√3 of the bus
        assert!(duties.iter().all(|d| (-CLOSE..=1.0 + CLOSE).contains(d)), "{duties:?}");
    }
    assert!((widest - 1.0).abs() < CLOSE, "{widest}");
}

#[test]
fn in_the_middle_of_a_sector_six_steps_are_field_oriented_control() {
    for (k, step) in SIX_STEPS.into_iter().enumerate() {
        let rotation = Rotation::of_angle(k as f64 * FRAC_PI_3);
        // u between the two terminals, the third at mid-voltage
        let u = rotation.park(AlphaBeta::clarke(step.phases(5.0, -5.0, 0.0)));
        assert_close([dc_voltage(u.d), dc_voltage(u.q)], [0.0, 10.0], CLOSE);
        let i = rotation.park(AlphaBeta::clarke(step.phases(2.0, -2.0, 0.0)));
        assert_close([dc_current(i.d), dc_current(i.q)], [0.0, 2.0], CLOSE);
    }
}

#[test]
fn every_phase_is_up_down_and_idle_twice_in_a_turn() {
    for phase in [Phase::A, Phase::B, Phase::C] {
        let count =
            |part: fn(CommutationStep) -> Phase| SIX_STEPS.into_iter().filter(|step| part(*step) == phase).count();
        assert_eq!((count(|s| s.up), count(|s| s.down), count(|s| s.idle)), (2, 2, 2));
    }
    for k in 0..6 {
        let (here, opposite) = (SIX_STEPS[k], SIX_STEPS[(k + 3) % 6]);
        assert_eq!((here.up, here.down, here.idle), (opposite.down, opposite.up, opposite.idle));
        let next = SIX_STEPS[(k + 1) % 6];
        assert!(here.up == next.up || here.down == next.down, "one leg at a time");
    }
}

#[test]
fn six_steps_make_three_over_pi_of_the_torque_and_fall_to_cos_30_at_the_ends() {
    // torque of a held current over a sector: the mean of cos over ±30° is 3/π
    let points = 6000;
    let (mut sum, mut least) = (0.0, 1.0_f64);
    for n in 0..points {
        let angle = (f64::from(n) + 0.5) * TAU / f64::from(points);
        let sector = libm::floor((angle + FRAC_PI_6) / FRAC_PI_3) as usize % 6;
        let i = SIX_STEPS[sector].phases(1.0, -1.0, 0.0);
        // over √3, the torque that a DC-equivalent ampere makes in field-oriented control
        let torque = dot(emf(angle), i) / SQRT_3;
        sum += torque;
        least = least.min(torque);
    }
    let mean = sum / f64::from(points);
    // the rule of middles errs by (π/6000)²/6
    assert!((mean - 3.0 / core::f64::consts::PI).abs() < 1e-6, "{mean}");
    assert!((least - libm::cos(FRAC_PI_6)).abs() < 1e-3, "{least}");
}

#[test]
fn the_robots_duties_are_those_of_double_precision_to_a_few_roundings() {
    let mut seed = 6;
    for k in 0..1000 {
        let (d, q) = (3.0 * noise(&mut seed), 12.0 * noise(&mut seed));
        let angle = 0.01 * f64::from(k) as f32;
        let single = Rotation::of_angle(angle).inverse_park(DirectQuadrature { d: d as f32, q: q as f32 });
        let double = Rotation::of_angle(f64::from(angle)).inverse_park(DirectQuadrature { d, q });
        let (single, double) = (space_vector(single, 1.0 / 24.0), space_vector(double, 1.0 / 24.0));
        // ten roundings of 6·10⁻⁸ and the error of the sine, of numbers up to 1
        assert_close(single.map(f64::from), double, 7e-7);
    }
}
