//! Hall sensors as the only measure of speed: what a drive makes of the time between edges.

use std::f64::consts::TAU;

/// The hall sensors of one wheel.
#[derive(Clone, Copy, Debug, Default)]
pub struct Halls {
    /// Angle that the wheel has turned through [rad]
    angle: f64,
    /// The last edge: its number and its time [s]
    last: Option<(f64, f64)>,
    /// Speed over the last whole interval [rad/s], and whether it has been told yet
    speed: f64,
    fresh: bool,
    held: f64,
}

impl Halls {
    /// The wheel turns at `speed` [rad/s] for `dt` [s] from the time `t` [s] on.
    pub fn turn(&mut self, t: f64, speed: f64, dt: f64, edges_per_turn: f64) {
        let edge = TAU / edges_per_turn;
        let before = self.angle;
        self.angle += speed * dt;
        let (from, to) = ((before / edge).floor(), (self.angle / edge).floor());
        if from == to {
            return;
        }
        // the edge that was crossed last, and when within the step
        let crossed = if to > from { to } else { to + 1.0 };
        let now = t + dt * (crossed * edge - before) / (self.angle - before);
        if let Some((number, since)) = self.last {
            // the same edge crossed back is a reversal, and no interval has ended
            if crossed != number {
                self.speed = (crossed - number) * edge / (now - since);
                self.fresh = true;
            }
        }
        self.last = Some((crossed, now));
    }

    /// What the drive tells now [rad/s]: a new interval's speed with its noise [rad/s], or the one told before.
    pub fn read(&mut self, noise: f64) -> f64 {
        if self.fresh {
            self.held = self.speed + noise;
            self.fresh = false;
        }
        self.held
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_steady_wheel_is_told_its_speed_in_both_directions() {
        for speed in [7.0, -7.0] {
            let mut halls = Halls::default();
            for k in 0..2000 {
                halls.turn(f64::from(k) * 1e-4, speed, 1e-4, 240.0);
            }
            assert!((halls.read(0.0) - speed).abs() < 1e-9, "{}", halls.read(0.0));
        }
    }

    #[test]
    fn an_edge_crossed_back_is_no_interval() {
        let mut halls = Halls::default();
        for (k, speed) in [3.0, 3.0, -3.0, -3.0].into_iter().enumerate() {
            halls.turn(k as f64, speed, 1.0, 1.0);
        }
        assert_eq!(halls.read(0.0), 0.0);
    }
}
