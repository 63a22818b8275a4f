//! What several laws are held to: a robot without friction, and equations of motion that are integrated for themselves.

use model_core::plant::robot::{Friction, Robot};

/// The same robot, with nothing that the floor takes.
pub fn frictionless<const N: usize>(robot: Robot<N, f64>) -> Robot<N, f64> {
    Robot { friction: Friction::default(), ..robot }
}

/// The classical Runge–Kutta step of dx/dt = rate(x).
pub fn runge_kutta<const K: usize>(rate: impl Fn([f64; K]) -> [f64; K], x: [f64; K], dt: f64) -> [f64; K] {
    let moved = |k: [f64; K], h: f64| std::array::from_fn(|n| x[n] + h * k[n]);
    let a = rate(x);
    let b = rate(moved(a, 0.5 * dt));
    let c = rate(moved(b, 0.5 * dt));
    let d = rate(moved(c, dt));
    std::array::from_fn(|n| x[n] + dt / 6.0 * (a[n] + 2.0 * b[n] + 2.0 * c[n] + d[n]))
}

/// Holds the largest that something is off to be small at steps of 1 ms, and to fall as the step's square.
pub fn second_order(what: &str, most: f64, off: impl Fn(f64) -> f64) {
    let (coarse, fine) = (off(2e-3), off(1e-3));
    assert!(fine < most, "{what}: {fine:e}");
    assert!((3.5..4.5).contains(&(coarse / fine)), "{what}: {coarse:e} and {fine:e}");
}
