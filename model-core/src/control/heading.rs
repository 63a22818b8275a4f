//! # Heading: a gyro finds what the wheels cannot know of the body's turning
//!
//! ```text
//! ψ̇ = s·c − b                                   yaw rate of the body
//! b ← b + (mean of s·c over a window at rest − b)/n        n windows, the last sixteen count
//! e ← e + (x_ω − ψ̇)·Δt                           how far the heading is behind that of the reference
//! Δω = k_ψ·e
//! ω̂_j ← ω̂_j − G_j·(0, 0, Δω)/r_j                 what the motion controller gets for the wheels' speeds
//! ```
//!
//! | symbol | code | unit | meaning |
//! |---|---|---|---|
//! | c, s | `code`, `scale` | 1, rad/s | code of the gyro, and what one count is worth |
//! | b | `bias` | rad/s | what the gyro tells of a robot that stands |
//! | x_ω | `reference` | rad/s | yaw rate of the reference |
//! | e | `behind` | rad | held within ±[`MOST_BEHIND`] |
//! | k_ψ | [`GAIN`] | 1/s | |
//!
//! Wheels tell the body's yaw rate through their distance from its centre, and through a floor on which they do not slip: 2 % more
//! distance is 7.2° in a whole turn. The gyro knows nothing of either. A robot that is behind its reference is told that its
//! wheels turn slower about the vertical than they do; so the reference stays what was commanded, and friction goes on being that
//! of its direction.
//!
//! The reference rests and no wheel passes edges: then the gyro's reading is its bias, if it keeps still over a window, and what
//! the heading was behind is forgotten. Until a first window was seen nothing is corrected.
//!
//! Neglects: the gyro's own scale error, which is the heading's from then on (calibrate s by turning the robot); its filter and
//! the turn between reading and use, some ms, which are a lead of x_ω times as much while the robot turns. Fails when: the robot is
//! carried slowly and evenly about while it rests; the window's limits are what finds that out.
//!
//! How to choose k_ψ: below half the bandwidth of the wheels' feedback about the vertical (51 rad/s, see
//! [`observer`](crate::control::observer)), and so that e = (1 − d/d′)·x_ω/k_ψ, what is left while the robot turns, is small: 0.2°
//! at 3 rad/s and 2 %.
//!
//! Source: proportional correction of a dead-reckoned heading by a rate gyro (Borenstein, Feng, Gyrodometry, ICRA 1996, has the
//! same two sensors); bias by zero-rate updates, a classic of inertial navigation.

use crate::link::sensor_codes::SensorScales;

/// k_ψ [1/s]
pub const GAIN: f32 = 20.0;

/// Most that a heading is counted behind [rad]: a robot that was held does not spin when it is let go.
pub const MOST_BEHIND: f32 = 0.1;

/// Turns of a window at rest: 0.256 s.
pub const WINDOW: u16 = 256;

/// Windows at rest that a bias is the mean of, about: 4 s. One of a gyro of 0.014 °/s/√Hz knows it to 0.02 °/s, sixteen to 0.005 °/s.
const WINDOWS: u8 = 16;

/// Most by which readings of a window at rest differ [rad/s]: ten times the rms noise of a gyro of 0.014 °/s/√Hz at 1 kHz.
const MOST_SPREAD: f32 = 0.055;

/// Largest bias [rad/s]: 3 °/s; ±1 °/s at 25 °C and 0.015 °/s/K (BMI088, BST-BMI088-DS001 revision 1.4, gyroscope specification).
const MOST_BIAS: f32 = 0.053;

/// Of what the heading is behind, what is left after a turn without a reading [1]: half of it fades in 35 ms.
const FADING: f32 = 0.98;

/// What is known of the heading, and of the gyro.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HeadingHold {
    scale: f32,
    dt: f32,
    bias: Option<f32>,
    /// Windows that it is the mean of, [`WINDOWS`] at the most
    windows: u8,
    window: Window,
    behind: f32,
}

/// Readings at rest: how many, their sum, the least and the most [rad/s].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Window {
    turns: u16,
    sum: f32,
    least: f32,
    most: f32,
}

impl Window {
    /// Takes a reading; the mean, where the window is full and still.
    fn take(&mut self, rate: f32) -> Option<f32> {
        if self.turns == 0 {
            (self.least, self.most) = (rate, rate);
        }
        self.turns += 1;
        self.sum += rate;
        (self.least, self.most) = (self.least.min(rate), self.most.max(rate));
        if self.turns < WINDOW {
            return None;
        }
        let Window { sum, least, most, .. } = core::mem::take(self);
        let mean = sum / f32::from(WINDOW);
        (most - least <= MOST_SPREAD && mean.abs() <= MOST_BIAS).then_some(mean)
    }
}

impl HeadingHold {
    /// For a gyro of this scale, and turns of this length [s].
    pub fn new(scales: &SensorScales, dt: f32) -> Self {
        Self { scale: scales.gyro, dt, bias: None, windows: 0, window: Window::default(), behind: 0.0 }
    }

    /// True if there is a gyro.
    pub fn has_gyro(&self) -> bool {
        self.scale != 0.0
    }

    /// One turn: the gyro said `code`, the reference turned with `reference` [rad/s] meanwhile, and the robot rests if `rests`.
    pub fn turn(&mut self, code: Option<i16>, reference: f32, rests: bool) {
        if rests {
            self.behind = 0.0;
        } else {
            self.window = Window::default();
        }
        let Some(code) = code else {
            self.window = Window::default();
            self.behind *= FADING;
            return;
        };
        // s·c
        let rate = self.scale * f32::from(code);
        if rests {
            if let Some(mean) = self.window.take(rate) {
                self.windows = (self.windows + 1).min(WINDOWS);
                let before = self.bias.unwrap_or(mean);
                // b ← b + (mean − b)/n
                self.bias = Some(before + (mean - before) / f32::from(self.windows));
            }
        } else if let Some(bias) = self.bias {
            // e ← e + (x_ω − ψ̇)·Δt
            self.behind = (self.behind + (reference - (rate - bias)) * self.dt).clamp(-MOST_BEHIND, MOST_BEHIND);
        }
    }

    /// Δω [rad/s]
    pub fn correction(&self) -> f32 {
        GAIN * self.behind
    }

    /// What the gyro tells of a robot that stands [rad/s], once it is known.
    pub fn bias(&self) -> Option<f32> {
        self.bias
    }

    /// Goes on with what another one knows, of the same gyro.
    pub fn take_over(&mut self, old: &Self) {
        if self.scale == old.scale {
            *self = *old;
        }
    }

    /// Forgets the motion, not the gyro.
    pub fn forget(&mut self) {
        self.behind = 0.0;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SCALES: SensorScales = SensorScales { gyro: 0.001, encoder: 0.0 };
    const DT: f32 = 1e-3;

    /// A gyro that has read 20 counts, 0.02 rad/s, of a robot that stood.
    fn rested() -> HeadingHold {
        let mut hold = HeadingHold::new(&SCALES, DT);
        (0..WINDOW).for_each(|_| hold.turn(Some(20), 0.0, true));
        hold
    }

    #[test]
    fn a_bias_is_the_mean_of_a_whole_window_at_rest() {
        let mut hold = HeadingHold::new(&SCALES, DT);
        for k in 0..WINDOW {
            assert_eq!(hold.bias(), None);
            hold.turn(Some(if k % 2 == 0 { 10 } else { 30 }), 0.0, true);
        }
        assert!((hold.bias().expect("a window is full") - 0.02).abs() < 1e-6);
        // a turn that does not rest begins it anew
        let mut hold = HeadingHold::new(&SCALES, DT);
        (0..2 * WINDOW).for_each(|k| hold.turn(Some(20), 0.0, k % 200 != 0));
        assert_eq!(hold.bias(), None);
    }

    #[test]
    fn a_bias_is_the_mean_of_windows_and_follows_one_that_wanders() {
        let mut hold = HeadingHold::new(&SCALES, DT);
        for code in [10, 20, 30] {
            (0..WINDOW).for_each(|_| hold.turn(Some(code), 0.0, true));
        }
        assert!((hold.bias().expect("three windows") - 0.02).abs() < 1e-6);
        (0..60).for_each(|_| (0..WINDOW).for_each(|_| hold.turn(Some(-10), 0.0, true)));
        assert!((hold.bias().expect("many windows") + 0.01).abs() < 1e-3);
    }

    #[test]
    fn a_robot_that_is_shaken_carried_or_has_no_reading_teaches_no_bias() {
        let learned = |code: fn(u16) -> Option<i16>| {
            let mut hold = HeadingHold::new(&SCALES, DT);
            (0..4 * WINDOW).for_each(|k| hold.turn(code(k), 0.0, true));
            hold.bias()
        };
        // 3.1 °/s; 0.056 rad/s from one end to the other; a reading that is missing in every window
        assert_eq!(learned(|_| Some(54)), None);
        assert_eq!(learned(|k| Some(if k % 64 == 0 { 28 } else { -28 })), None);
        assert_eq!(learned(|k| (k % 255 != 0).then_some(20)), None);
        assert!(learned(|k| Some(if k % 64 == 0 { 27 } else { -28 })).is_some());
    }

    #[test]
    fn nothing_is_corrected_before_the_bias_is_known() {
        let mut hold = HeadingHold::new(&SCALES, DT);
        (0..100).for_each(|_| hold.turn(Some(500), 1.0, false));
        assert_eq!(hold.correction(), 0.0);
    }

    #[test]
    fn what_the_body_lacks_of_the_references_turn_is_made_up_for() {
        let mut hold = rested();
        // the reference turns with 1 rad/s, the body with 0.98: 0.02 rad in a second
        (0..1000).for_each(|_| hold.turn(Some(1000), 1.0, false));
        assert!((hold.correction() - GAIN * 0.02).abs() < 1e-4, "{}", hold.correction());
        hold.turn(Some(20), 0.0, true);
        assert_eq!(hold.correction(), 0.0, "at rest it is forgotten");
    }

    #[test]
    fn a_robot_that_is_held_is_not_behind_by_more_than_the_most() {
        let mut hold = rested();
        (0..5000).for_each(|_| hold.turn(Some(20), 1.0, false));
        assert!((hold.correction() - GAIN * MOST_BEHIND).abs() < 1e-5);
    }

    #[test]
    fn without_readings_a_correction_fades() {
        let mut hold = rested();
        (0..1000).for_each(|_| hold.turn(Some(1000), 1.0, false));
        let before = hold.correction();
        (0..35).for_each(|_| hold.turn(None, 1.0, false));
        assert!((hold.correction() / before - 0.5).abs() < 0.01);
    }

    #[test]
    fn another_block_of_the_same_gyro_goes_on_and_of_another_begins_anew() {
        let old = rested();
        let mut same = HeadingHold::new(&SCALES, DT);
        same.take_over(&old);
        let mut other = HeadingHold::new(&SensorScales { gyro: -0.001, ..SCALES }, DT);
        other.take_over(&old);
        assert_eq!((same.bias(), other.bias()), (old.bias(), None));
    }
}
