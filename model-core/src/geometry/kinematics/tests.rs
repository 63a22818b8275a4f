use super::*;
use crate::number::dual::Dual;
use core::f64::consts::{FRAC_PI_2, FRAC_PI_3, PI};

const D: f64 = 0.089;
const R: f64 = 0.0325;

/// Tolerance: a few dozen roundings of numbers about 1.
const CLOSE: f64 = 1.0e-14;

fn papers_three() -> Wheels<3, f64> {
    Wheels::new([150.0, 270.0, 30.0].map(|deg| Wheel::from_degrees(deg, D, R)))
}

fn papers_four() -> Wheels<4, f64> {
    Wheels::new([90.0, 180.0, 270.0, 0.0].map(|deg| Wheel::from_degrees(deg, D, R)))
}

/// A number in −1 ..= 1 that looks random, the same in every run.
fn noise(seed: &mut u32) -> f64 {
    *seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
    f64::from(*seed >> 8) / f64::from(1_u32 << 23) - 1.0
}

/// Wheels near the evenly spread ones, each off by up to 17°, 20 mm and 5 mm.
fn irregular<const N: usize>(seed: &mut u32) -> Wheels<N, f64> {
    Wheels::new(array::from_fn(|j| Wheel {
        drive_angle: 2.0 * PI * j as f64 / N as f64 + 0.3 * noise(seed),
        distance: 0.1 + 0.02 * noise(seed),
        radius: 0.03 + 0.005 * noise(seed),
    }))
}

fn twist(seed: &mut u32) -> BodyTwist<f64> {
    BodyTwist { v: noise(seed), vn: noise(seed), w: 5.0 * noise(seed) }
}

fn assert_close<const M: usize>(got: [f64; M], want: [f64; M], within: f64) {
    for (g, w) in got.into_iter().zip(want) {
        assert!((g - w).abs() <= within, "{got:?} against {want:?}");
    }
}

#[test]
fn three_rim_speeds_are_those_of_equation_2() {
    let BodyTwist { v, vn, w } = BodyTwist { v: 0.7, vn: -0.4, w: 1.3 };
    let (s, c) = (libm::sin(FRAC_PI_3), libm::cos(FRAC_PI_3));
    let want = [-s * v + c * vn + D * w, -vn + D * w, s * v + c * vn + D * w];
    assert_close(papers_three().rim_speeds(BodyTwist { v, vn, w }), want, CLOSE);
}

#[test]
fn the_twist_of_three_rims_is_that_of_equations_3_to_5() {
    let [v0, v1, v2] = [0.31, -0.52, 0.87];
    // v = (√3/3)·(v₂ − v₀),  vn = (v₀ + v₂)/3 − 2·v₁/3,  ω = (v₀ + v₁ + v₂)/(3·d)
    let want = [libm::sqrt(3.0) / 3.0 * (v2 - v0), (v0 + v2) / 3.0 - 2.0 / 3.0 * v1, (v0 + v1 + v2) / (3.0 * D)];
    assert_close(papers_three().twist([v0, v1, v2]).to_array(), want, CLOSE);
}

#[test]
fn four_rim_speeds_are_those_of_equation_6_to_the_last_bit() {
    let BodyTwist { v, vn, w } = BodyTwist { v: 0.7, vn: -0.4, w: 1.3 };
    let want = [vn + D * w, -v + D * w, -vn + D * w, v + D * w];
    assert_eq!(papers_four().rim_speeds(BodyTwist { v, vn, w }), want);
}

#[test]
fn the_twist_of_four_rims_is_that_of_equations_7_to_9() {
    let [v0, v1, v2, v3] = [0.31, -0.52, 0.87, 0.11];
    // v = ½·(v₃ − v₁),  vn = ½·(v₀ − v₂),  ω = (v₀ + v₁ + v₂ + v₃)/(4·d)
    let want = [0.5 * (v3 - v1), 0.5 * (v0 - v2), (v0 + v1 + v2 + v3) / (4.0 * D)];
    assert_close(papers_four().twist([v0, v1, v2, v3]).to_array(), want, CLOSE);
}

#[test]
fn three_forces_do_to_the_body_what_equations_13_to_15_say() {
    let [f0, f1, f2] = [1.1, -2.0, 0.6];
    // F_v = (f₂ − f₀)·sin 60°,  F_vn = −f₁ + (f₂ + f₀)·cos 60°,  Γ = (f₀ + f₁ + f₂)·d
    let (s, c) = (libm::sin(FRAC_PI_3), libm::cos(FRAC_PI_3));
    let want = [(f2 - f0) * s, -f1 + (f2 + f0) * c, (f0 + f1 + f2) * D];
    assert_close(papers_three().body_force([f0, f1, f2]), want, CLOSE);
}

#[test]
fn four_forces_do_to_the_body_what_equations_18_to_20_say() {
    let [f0, f1, f2, f3] = [1.1, -2.0, 0.6, 0.3];
    // F_v = f₃ − f₁,  F_vn = f₀ − f₂,  Γ = (f₀ + f₁ + f₂ + f₃)·d
    let want = [f3 - f1, f0 - f2, (f0 + f1 + f2 + f3) * D];
    assert_close(papers_four().body_force([f0, f1, f2, f3]), want, CLOSE);
}

#[test]
fn wheels_at_any_angles_give_back_the_motion_they_were_given() {
    fn check<const N: usize>(seed: &mut u32) {
        let (wheels, twist) = (irregular::<N>(seed), twist(seed));
        assert!(wheels.is_regular());
        // conditioning of GᵀG below 1000 in these geometries
        let within = 1000.0 * 4.0 * f64::EPSILON * 5.0;
        assert_close(wheels.twist(wheels.rim_speeds(twist)).to_array(), twist.to_array(), within);
        assert_close(wheels.twist_of_wheel_speeds(wheels.wheel_speeds(twist)).to_array(), twist.to_array(), within);
        let force = [noise(seed), noise(seed), 0.1 * noise(seed)];
        assert_close(wheels.body_force(wheels.wheel_forces(force)), force, within);
    }
    let mut seed = 1;
    for _ in 0..200 {
        check::<3>(&mut seed);
        check::<4>(&mut seed);
    }
}

#[test]
fn the_power_of_the_forces_is_the_same_at_the_rims_and_at_the_body() {
    fn check<const N: usize>(seed: &mut u32) {
        let (wheels, twist) = (irregular::<N>(seed), twist(seed));
        let forces = array::from_fn(|_| noise(seed));
        let at_rims: f64 = wheels.rim_speeds(twist).iter().zip(forces).map(|(v, f)| v * f).sum();
        let at_body = linalg::dot(wheels.body_force(forces), twist.to_array());
        assert!((at_rims - at_body).abs() < CLOSE, "{at_rims} against {at_body}");
    }
    let mut seed = 2;
    for _ in 0..200 {
        check::<3>(&mut seed);
        check::<4>(&mut seed);
    }
}

#[test]
fn the_split_of_a_force_is_the_smallest_that_does_it() {
    let mut seed = 3;
    let wheels = irregular::<4>(&mut seed);
    let forces = wheels.wheel_forces([1.0, -2.0, 0.1]);
    // whatever could be added without effect on the body lies along n, and the split has none of it
    let idle: f64 = forces.iter().zip(wheels.parity_vector()).map(|(f, n)| f * n).sum();
    assert!(idle.abs() < CLOSE, "{idle}");
}

#[test]
fn a_rigid_motion_has_no_parity_and_the_rest_of_four_rims_is_all_parity() {
    let mut seed = 4;
    for _ in 0..200 {
        let (wheels, twist) = (irregular::<4>(&mut seed), twist(&mut seed));
        assert!(wheels.parity(wheels.rim_speeds(twist)).abs() < CLOSE);
        let rim: [f64; 4] = array::from_fn(|_| noise(&mut seed));
        let (fitted, n) = (wheels.rim_speeds(wheels.twist(rim)), wheels.parity_vector());
        let parity = wheels.parity(rim);
        assert_close(array::from_fn(|j| rim[j] - fitted[j]), n.map(|n| n * parity), 100.0 * CLOSE);
    }
}

#[test]
fn the_papers_four_wheels_are_checked_by_their_alternating_sum() {
    let wheels = papers_four();
    assert_close(wheels.parity_vector(), [0.5, -0.5, 0.5, -0.5], f64::EPSILON);
    assert!((wheels.parity([0.4, 0.1, 0.2, -0.1]) - 0.3).abs() < CLOSE);
    assert_eq!(wheels.parity([0.25, -0.5, -0.25, 0.5]), 0.0);
}

#[test]
fn a_multiple_of_a_quarter_turn_drives_exactly_along_an_axis() {
    fn check<T: Real>() {
        for (deg, x, y) in [(0.0, 1.0, 0.0), (90.0, 0.0, 1.0), (180.0, -1.0, 0.0), (270.0, 0.0, -1.0)] {
            for turn in [-360.0, 0.0] {
                let [cos, sin] = Wheel::<T>::from_degrees(deg + turn, T::one(), T::one()).direction();
                assert!(cos == T::lit(x) && sin == T::lit(y), "{deg}°: {cos:?}, {sin:?}");
            }
        }
    }
    check::<f32>();
    check::<f64>();
    check::<Dual<1>>();
}

#[test]
fn an_exact_direction_still_has_its_derivative() {
    let wheel = Wheel { drive_angle: Dual::<1>::variable(FRAC_PI_2, 0), ..Wheel::default() };
    let [cos, sin] = wheel.direction();
    // ∂cos α/∂α = −1 and ∂sin α/∂α = 0 at a quarter turn
    assert!(cos.re == 0.0 && (cos.eps[0] + 1.0).abs() < CLOSE);
    assert!(sin.re == 1.0 && sin.eps[0].abs() < CLOSE);
}

#[test]
fn a_wheel_stands_a_quarter_turn_behind_its_drive() {
    assert_eq!(papers_four().contact_points(), [(D, 0.0), (0.0, D), (-D, 0.0), (0.0, -D)]);
    for (wheel, (x, y)) in papers_three().wheels().iter().zip(papers_three().contact_points()) {
        let angle = wheel.drive_angle - FRAC_PI_2;
        assert_close([x, y], [D * libm::cos(angle), D * libm::sin(angle)], CLOSE);
    }
}

#[test]
fn turning_on_the_spot_moves_every_contact_point_along_its_drive() {
    let mut seed = 5;
    let wheels = irregular::<4>(&mut seed);
    let rim = wheels.rim_speeds(BodyTwist { v: 0.0, vn: 0.0, w: 1.0 });
    for (j, (x, y)) in wheels.contact_points().into_iter().enumerate() {
        // ω × p = (−y, x), along (cos α, sin α)
        let [cos, sin] = wheels.wheels()[j].direction();
        assert!((rim[j] - (-y * cos + x * sin)).abs() < CLOSE);
    }
}

#[test]
fn wheels_that_leave_a_direction_free_are_told_and_give_zeros() {
    let parallel = Wheels::new([0.3_f64; 4].map(|a| Wheel { drive_angle: a, distance: D, radius: R }));
    assert!(!parallel.is_regular());
    assert_eq!(parallel.twist([1.0; 4]).to_array(), [0.0; 3]);
    let central = Wheels::new([150.0, 270.0, 30.0].map(|deg| Wheel::from_degrees(deg, 0.0_f32, 0.03)));
    assert!(!central.is_regular());
    assert_eq!(central.wheel_forces([1.0; 3]), [0.0; 3]);
    let single = Wheels::new([0.3_f32, 0.3, 0.3, 1.9].map(|a| Wheel { drive_angle: a, distance: 0.1, radius: 0.03 }));
    assert!(!single.is_regular(), "two directions for three unknowns");
    assert!(papers_three().is_regular() && papers_four().is_regular());
}

#[test]
fn single_precision_agrees_with_double() {
    let coarse = Wheels::new([150.0, 270.0, 30.0].map(|deg| Wheel::from_degrees(deg, D as f32, R as f32)));
    let rim = coarse.rim_speeds(BodyTwist { v: 0.7, vn: -0.4, w: 1.3 });
    let fine = papers_three().rim_speeds(BodyTwist { v: 0.7, vn: -0.4, w: 1.3 });
    // three roundings of numbers below 1
    assert_close(rim.map(f64::from), fine, 3.0e-7);
    let back = coarse.twist(rim);
    assert_close(back.to_array().map(f64::from), [0.7, -0.4, 1.3], 2.0e-6);
}
