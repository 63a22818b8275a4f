//! The core against the exact reference, on the paper's two robots, over seconds of random motion.
//!
//! Where the bounds come from. The core steps 1 ms. Smooth motion adds |λ|³Δt²/12 of a change. An axis that reverses within
//! a step spends Coulomb friction on each side of it for the time that is due, but for what the instant is wrong by, which
//! is of the same order; it dies out with the robot's own time constant of 0.2 to 0.3 s. The pose integrates both. Single
//! precision rounds each number at 6e-8; over thousands of steps of a pose of a metre the roundings walk to 1e-5.

use host_tests::excitation::voltages;
use host_tests::paper::{FOUR_WHEELS, THREE_WHEELS};
use host_tests::reference::Reference;
use model_core::number::scalar::Real;
use model_core::plant::robot::Robot;

use crate::fixture::{Run, four, gap, larger, plain, three};

/// Largest errors of a run.
#[derive(Clone, Copy, Debug, Default)]
struct Errors {
    /// v, vn [m/s]
    speed: f64,
    /// ω [rad/s]
    turning: f64,
    /// x, y [m]
    place: f64,
    /// θ [rad]
    heading: f64,
    /// Motor currents [A]
    current: f64,
    /// Wheel speeds [rad/s]
    wheel: f64,
}

impl Errors {
    fn worst(self, other: Self) -> Self {
        Self {
            speed: larger(self.speed, other.speed),
            turning: larger(self.turning, other.turning),
            place: larger(self.place, other.place),
            heading: larger(self.heading, other.heading),
            current: larger(self.current, other.current),
            wheel: larger(self.wheel, other.wheel),
        }
    }

    fn within(self, most: Self) -> bool {
        let all = |e: Self| [e.speed, e.turning, e.place, e.heading, e.current, e.wheel];
        all(self).into_iter().zip(all(most)).all(|(e, m)| e <= m)
    }
}

/// Runs both over random holds (about 4.4 s) with `steps` steps a millisecond.
fn compare<const N: usize, T: Real + Into<f64>>(
    robot: Robot<N, T>,
    mut exact: Reference<N>,
    seed: u64,
    steps: u32,
) -> Errors {
    let mut run = Run::new(plain(robot));
    let mut worst = Errors::default();
    for hold in voltages::<N>(seed, 40, 9.0) {
        for _ in 0..hold.milliseconds {
            let (current, wheel) = (exact.currents(hold.u), exact.wheel_speeds());
            let read = run.drive(hold.u, 1e-3 / f64::from(steps));
            for _ in 1..steps {
                run.drive(hold.u, 1e-3 / f64::from(steps));
            }
            exact.advance(hold.u, 1e-3);
            let (x, p) = (run.twist(), run.pose());
            worst = worst.worst(Errors {
                speed: gap([x[0], x[1]], [exact.twist[0], exact.twist[1]]),
                turning: (x[2] - exact.twist[2]).abs(),
                place: gap([p[0], p[1]], [exact.pose[0], exact.pose[1]]),
                heading: (p[2] - exact.pose[2]).abs(),
                current: gap(read.current.map(Into::into), current),
                wheel: gap(read.wheel_speed.map(Into::into), wheel),
            });
        }
    }
    worst
}

/// The worst of five seeds, on three wheels and on four.
fn both<T: Real + Into<f64>>(steps: u32) -> Errors {
    (1..=5).fold(Errors::default(), |worst, seed| {
        worst.worst(compare(three::<T>(), Reference::<3>::printed(&THREE_WHEELS), seed, steps)).worst(compare(
            four::<T>(),
            Reference::<4>::printed(&FOUR_WHEELS),
            seed,
            steps,
        ))
    })
}

/// What the orders of the step lead one to expect at 1 ms. After a change Δx of the steady speed the trapezoidal rule is at
/// most Δx·(Δt/τ)²/(12·e) off: 2 m/s and τ = 0.3 s make 0.7 µm/s, 40 rad/s and τ = 0.17 s 43 µrad/s. The instant of a
/// reversal is taken from a straight line, wrong by at most Δt²/(8·τ), and friction's 2·1.7 m/s² and 2·9 rad/s² turn round
/// there: 1.4 µm/s and 13 µrad/s. A wheel turns by v/r + ω·d/r, 15 µrad/s more than 2.7 times the body; a current by
/// l·Kv/R = 0.03 A for each rad/s of its wheel. The places are what such errors leave in 0.2 s each, some with one sign.
const BOUND: Errors = Errors { speed: 4e-6, turning: 6e-5, place: 4e-6, heading: 2e-5, current: 7e-6, wheel: 2.4e-4 };

/// The same with the rounding of single precision: each of some 200 steps that a motion remembers rounds 1 m/s and 16 rad/s
/// by half an ulp, 3e-8 and 5e-7, and θ of up to 10 rad by 5e-7 in each of 4400 steps, mostly cancelling.
const BOUND_SINGLE: Errors =
    Errors { speed: 1e-5, turning: 1.6e-4, place: 2e-5, heading: 1e-4, current: 2e-5, wheel: 6e-4 };

#[test]
fn in_double_precision_the_core_stays_with_the_reference() {
    let worst = both::<f64>(1);
    assert!(worst.within(BOUND), "{worst:?}");
}

#[test]
fn in_single_precision_the_core_stays_with_the_reference() {
    let worst = both::<f32>(1);
    assert!(worst.within(BOUND_SINGLE), "{worst:?}");
}

#[test]
fn single_precision_adds_rounding_and_nothing_else() {
    let mut worst = 0.0_f64;
    let mut double = Run::new(plain(four::<f64>()));
    let mut single = Run::new(plain(four::<f32>()));
    for hold in voltages::<4>(3, 40, 9.0) {
        for _ in 0..hold.milliseconds {
            double.drive(hold.u, 1e-3);
            single.drive(hold.u, 1e-3);
            worst = worst.max(gap(double.twist(), single.twist())).max(gap(double.pose(), single.pose()));
        }
    }
    // 4400 steps, each rounding θ of some 10 rad and speeds of 20 rad/s by up to 1e-6, mostly cancelling
    assert!(worst < 5e-5, "{worst}");
}

#[test]
fn a_reversal_costs_in_proportion_to_the_square_of_the_step() {
    let (coarse, fine) = (both::<f64>(1), both::<f64>(4));
    // a quarter of the step, a sixteenth of the error: second order, which a factor of 10 tells from first
    assert!(fine.speed < coarse.speed / 10.0 && fine.turning < coarse.turning / 10.0, "{coarse:?}, {fine:?}");
}

#[test]
fn without_a_reversal_half_the_step_leaves_a_quarter_of_the_error() {
    // all axes move on in the direction in which they start
    let (x, u) = ([0.5, 0.4, 2.0], [1.0, -1.0, 6.0]);
    let error = |steps: u32| {
        let mut exact = Reference::<3>::printed(&THREE_WHEELS).moving(x);
        let mut run = Run::from(plain(three::<f64>()), [0.0; 3], x);
        exact.advance(u, 0.5);
        for _ in 0..500 * steps / 4 {
            run.drive(u, 4e-3 / f64::from(steps));
        }
        assert!(exact.twist.iter().all(|x| *x > 0.0), "{:?} has turned round", exact.twist);
        [gap(run.twist(), exact.twist), gap(run.pose(), exact.pose)]
    };
    let [coarse, middle, fine] = [1, 2, 4].map(error);
    for (a, b) in [(coarse, middle), (middle, fine)] {
        for k in 0..2 {
            // what is left of third order at 4 ms moves the ratio by some λ·Δt = 4 %
            assert!((a[k] / b[k] - 4.0).abs() < 0.2, "{a:?}, {b:?}");
        }
    }
}

#[test]
fn the_core_settles_where_the_reference_settles() {
    fn check<const N: usize, T: Real + Into<f64>>(robot: Robot<N, T>, exact: Reference<N>, within: f64) {
        for hold in voltages::<N>(11, 12, 9.0) {
            let mut exact = exact.clone();
            let mut run = Run::new(plain(robot));
            exact.advance(hold.u, 5.0);
            for _ in 0..5000 {
                run.drive(hold.u, 1e-3);
            }
            let off = gap(run.twist(), exact.twist);
            assert!(off < within, "{:?} against {:?} under {:?}", run.twist(), exact.twist, hold.u);
            let read = run.drive(hold.u, 1e-3);
            assert!(gap(read.current.map(Into::into), exact.currents(hold.u)) < within);
        }
    }
    // the step's fixed point is that of the equation; 1e-9: what is left of e^(−λt) after 5 s, and rounding
    check(three::<f64>(), Reference::<3>::printed(&THREE_WHEELS), 1e-9);
    check(four::<f64>(), Reference::<4>::printed(&FOUR_WHEELS), 1e-9);
    // ω of 8 to 16 rad/s has an ulp of 1e-6. What a step would add, λ·Δt·Δω with λ of 6/s, is rounded away once it is
    // below half an ulp: Δω stops at 0.5e-6/0.006 = 0.8e-4, and twice that above 16 rad/s
    check(three::<f32>(), Reference::<3>::printed(&THREE_WHEELS), 2e-4);
    check(four::<f32>(), Reference::<4>::printed(&FOUR_WHEELS), 2e-4);
}
