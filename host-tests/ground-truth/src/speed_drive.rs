//! A drive that controls the speed of its wheel: what it hears, what it makes the wheel follow, and the voltages for that.
//!
//! ```text
//! w_d: w_set(t − t_d), or a straight line to it          what it demands
//! T_s·dr/dt = (1 − k)·w_h − r                            what it makes the wheel follow; w_h = w_d where |w_d| ≥ w₀, else 0
//! u = K·r + A·dr/dt + P·(r − w) + I                      |u| ≤ U
//! dI/dt = (P/T_i)·(r − w)                                |I| ≤ I_m, and only while that does not drive u further out
//! ```
//!
//! On a wheel that carries the inertia J, behind a gear l:
//!
//! ```text
//! τ·dw/dt = (u − u_L)/K − w        K = l·Kv,  τ = J·R/(l²·Kt·Kv),  u_L = R/(l·Kt) times what the load takes [N·m]
//! ```
//!
//! Without I and with A = 0 that is a lag T·dw/dt = r − w − u_L/(K + P) with T = K·τ/(K + P): the stiffer, the sooner, and
//! by u_L/(K + P) short. With I nothing stays short that I_m can hold.
//!
//! Source: Åström, Hägglund, PID Controllers, 1995, ch. 3 (set-point filter, feedforward, anti-windup).

/// A drive of all wheels, each controlled by itself.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpeedDrive {
    /// t_d, from the speed that is set to the moment at which it is heard [s]
    pub dead_time: f64,
    /// How long it takes to a new set speed, along a straight line [s]; 0 where it jumps. One that does tells what it demands,
    /// and that is what is logged.
    pub line: f64,
    /// w₀, below which a set speed is left out [rad/s]
    pub threshold: f64,
    /// T_s, over which a set speed is smoothed [s]; 0 where it is not
    pub smoothing: f64,
    /// k, by how much the drive counts a speed too large [1]
    pub shortfall: f64,
    /// K, what a speed induces [V·s]
    pub induced: f64,
    /// A, what a change of speed takes [V·s²]
    pub inertial: f64,
    /// P [V·s]
    pub proportional: f64,
    /// T_i [s]; infinite where there is no integral part
    pub integral_time: f64,
    /// I_m [V]
    pub integral_most: f64,
    /// U, what the supply leaves [V]
    pub most: f64,
    /// How often it looks [s]
    pub period: f64,
}

/// What drives remember, one number a wheel.
#[derive(Debug, Default, PartialEq)]
pub struct Driving {
    /// What was set last [rad/s]
    pub goals: Vec<f64>,
    /// w_d [rad/s]
    pub demands: Vec<f64>,
    /// How fast that changes [rad/s²]
    pub slopes: Vec<f64>,
    /// r [rad/s]
    pub followed: Vec<f64>,
    /// I [V]
    pub integrals: Vec<f64>,
    /// u since they last looked [V]
    pub volts: Vec<f64>,
    /// When they look again [s]
    pub next: f64,
}

impl Driving {
    /// At rest, of so many wheels.
    pub fn at_rest(wheels: usize) -> Self {
        let none = || vec![0.0; wheels];
        Self {
            goals: none(),
            demands: none(),
            slopes: none(),
            followed: none(),
            integrals: none(),
            volts: none(),
            next: 0.0,
        }
    }
}

impl Clone for Driving {
    fn clone(&self) -> Self {
        let mut new = Self::default();
        new.clone_from(self);
        new
    }

    /// Without asking for memory, where there is enough: it is done every step.
    fn clone_from(&mut self, from: &Self) {
        // named one by one, so that none is forgotten
        let Self { goals, demands, slopes, followed, integrals, volts, next } = from;
        self.goals.clone_from(goals);
        self.demands.clone_from(demands);
        self.slopes.clone_from(slopes);
        self.followed.clone_from(followed);
        self.integrals.clone_from(integrals);
        self.volts.clone_from(volts);
        self.next = *next;
    }
}

/// Two times that are no further apart are the same [s]: sums of steps round.
const ROUNDED: f64 = 1e-9;

impl SpeedDrive {
    /// w_h of a speed that is set [rad/s].
    pub fn heard(&self, set: f64) -> f64 {
        if set.abs() < self.threshold { 0.0 } else { set }
    }

    /// T, with which a wheel follows r without the integral part [s].
    pub fn answers_in(&self) -> f64 {
        // T = K·τ/(K + P), A = K·τ
        self.inertial / (self.induced + self.proportional)
    }

    /// Tuned to another T [s], which is less than τ, with an integral part that does not overshoot.
    pub fn tune(&mut self, answers_in: f64) {
        self.proportional = self.inertial / answers_in - self.induced;
        // a damping of 1 or more: T_i ≥ 4·T·P/(K + P)
        self.integral_time = self.integral_time.max(4.0 * answers_in);
    }

    /// Whether it looks at a time [s].
    pub fn looks(&self, driving: &Driving, time: f64) -> bool {
        time >= driving.next - ROUNDED
    }

    /// Begins the way to a new set speed [rad/s] of wheel j.
    fn demand(&self, driving: &mut Driving, j: usize, set: f64) {
        if self.line == 0.0 {
            driving.demands[j] = set;
        } else if set != driving.goals[j] {
            driving.slopes[j] = (set - driving.demands[j]) / self.line;
        } else if driving.demands[j] == set {
            driving.slopes[j] = 0.0;
        }
        driving.goals[j] = set;
    }

    /// Looks at a time [s] at the speeds that were set a dead time ago and at those of the wheels [rad/s].
    pub fn look(&self, driving: &mut Driving, time: f64, set: &[f64], speeds: impl Iterator<Item = f64>) {
        driving.next = time + self.period;
        for (j, (set, speed)) in set.iter().zip(speeds).enumerate() {
            self.demand(driving, j, *set);
            let (demand, slope) = (driving.demands[j], driving.slopes[j]);
            let target = (1.0 - self.shortfall) * self.heard(demand);
            let mut rate = if demand.abs() < self.threshold { 0.0 } else { (1.0 - self.shortfall) * slope };
            if self.smoothing > 0.0 {
                rate = (target - driving.followed[j]) / self.smoothing;
            } else {
                driving.followed[j] = target;
            }
            let off = driving.followed[j] - speed;
            let asked = self.induced * driving.followed[j] + self.inertial * rate + self.proportional * off;
            let voltage = asked + driving.integrals[j];
            driving.volts[j] = voltage.clamp(-self.most, self.most);
            if voltage == driving.volts[j] || voltage * off < 0.0 {
                let more = self.period * self.proportional / self.integral_time * off;
                driving.integrals[j] = (driving.integrals[j] + more).clamp(-self.integral_most, self.integral_most);
            }
            // no further than to what is set, whatever rounding says
            let (ends, after) = (driving.goals[j], demand + slope * self.period);
            driving.demands[j] = if (ends - after) * slope > 0.0 { after } else { ends };
            // r is held until the next look, and goes on by an exponential
            if self.smoothing > 0.0 {
                driving.followed[j] =
                    target + (driving.followed[j] - target) * libm::exp(-self.period / self.smoothing);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// K [V·s], τ [s], and how often the drive looks [s].
    const WHEEL: (f64, f64, f64) = (0.13, 0.3, 1e-5);

    fn drive() -> SpeedDrive {
        let (induced, time, period) = WHEEL;
        SpeedDrive {
            dead_time: 0.0,
            line: 0.0,
            threshold: 0.0,
            smoothing: 0.0,
            shortfall: 0.0,
            induced,
            inertial: induced * time,
            proportional: 1.0,
            integral_time: f64::INFINITY,
            integral_most: 3.0,
            most: f64::INFINITY,
            period,
        }
    }

    /// Speeds of a wheel from rest, look by look, under a set speed [rad/s] and a load [V].
    fn driven(drive: &SpeedDrive, set: f64, load: f64, seconds: f64) -> Vec<f64> {
        let (induced, time, period) = WHEEL;
        let (mut driving, mut speed) = (Driving::at_rest(1), 0.0);
        let looks = (seconds / period).round() as usize;
        let mut look = |k: usize| {
            let before = speed;
            drive.look(&mut driving, k as f64 * period, &[set], std::iter::once(before));
            // exact, for a voltage that is held
            let ends = (driving.volts[0] - load) / induced;
            speed = ends + (before - ends) * libm::exp(-period / time);
            before
        };
        (0..looks).map(&mut look).collect()
    }

    #[test]
    fn a_step_is_answered_by_the_lag_of_the_closed_form() {
        for answers_in in [0.002, 0.05] {
            let mut drive = drive();
            drive.tune(answers_in);
            assert!((drive.answers_in() / answers_in - 1.0).abs() < 1e-12);
            drive.integral_time = f64::INFINITY;
            for (k, speed) in driven(&drive, 20.0, 0.0, 0.3).into_iter().enumerate().step_by(500) {
                let expected = 20.0 * -libm::expm1(-(k as f64) * WHEEL.2 / answers_in);
                // half a look of 10 µs late, of a slope of 20/T
                assert!((speed - expected).abs() < 20.0 / answers_in * WHEEL.2, "{k}: {speed} against {expected}");
            }
        }
    }

    #[test]
    fn a_load_leaves_it_short_by_what_stiffness_says_and_an_integral_part_takes_that_away() {
        let (load, mut drive) = (0.5, drive());
        let ends = |drive: &SpeedDrive| *driven(drive, 20.0, load, 3.0).last().expect("looks");
        // u_L/(K + P)
        assert!((20.0 - ends(&drive) - load / (0.13 + 1.0)).abs() < 1e-9);
        drive.integral_time = 0.2;
        assert!((ends(&drive) - 20.0).abs() < 1e-4, "{}", ends(&drive));
        // and no more than it can hold: the rest stays, as without it
        drive.integral_most = 0.2;
        assert!((20.0 - ends(&drive) - (load - 0.2) / (0.13 + 1.0)).abs() < 1e-9);
    }

    #[test]
    fn a_drive_that_counts_too_much_stays_short_by_that_share() {
        let short = SpeedDrive { shortfall: 0.04, integral_time: 0.2, ..drive() };
        let ends = *driven(&short, 20.0, 0.3, 3.0).last().expect("looks");
        assert!((ends - 0.96 * 20.0).abs() < 1e-4, "{ends}");
    }

    #[test]
    fn a_smoothed_set_speed_is_followed_as_a_lag_of_that_time_alone() {
        let smooth = SpeedDrive { smoothing: 0.05, proportional: 20.0, ..drive() };
        for (k, speed) in driven(&smooth, 20.0, 0.0, 0.3).into_iter().enumerate().step_by(500) {
            let expected = 20.0 * -libm::expm1(-(k as f64) * WHEEL.2 / 0.05);
            assert!((speed - expected).abs() < 20.0 / 0.05 * 2.0 * WHEEL.2, "{k}: {speed} against {expected}");
        }
    }

    #[test]
    fn a_drive_that_goes_along_a_line_is_on_it_at_every_look_and_stays_where_it_ends() {
        let line = SpeedDrive { line: 0.05, proportional: 1.0, ..drive() };
        for (k, speed) in driven(&line, 20.0, 0.0, 0.1).into_iter().enumerate() {
            let expected = 20.0 * (k as f64 * WHEEL.2 / 0.05).min(1.0);
            // half a look late, but for the corners
            assert!((speed - expected).abs() < 20.0 / 0.05 * WHEEL.2, "{k}: {speed} against {expected}");
        }
    }

    #[test]
    fn small_speeds_are_left_out_and_large_ones_heard_whole() {
        let deaf = SpeedDrive { threshold: 2.0, ..drive() };
        assert_eq!([1.99, -1.99, 2.0, -7.0].map(|set| deaf.heard(set)), [0.0, 0.0, 2.0, -7.0]);
    }

    #[test]
    fn what_the_supply_cannot_give_is_not_stored_up() {
        // 20 rad/s take 2.6 V, and none is left to be fast with
        let weak = SpeedDrive { most: 2.7, integral_time: 0.02, ..drive() };
        let speeds = driven(&weak, 20.0, 0.0, 3.0);
        let expected = 2.7 / 0.13 * -libm::expm1(-0.1 / WHEEL.1);
        assert!((speeds[(0.1 / WHEEL.2) as usize] - expected).abs() < 1e-3);
        let most = speeds.iter().copied().fold(0.0, f64::max);
        assert!(most < 20.0 * 1.01, "{most}");
    }
}
