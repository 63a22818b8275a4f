//! What a log makes of readings: noise, counts, and what is missing.
//!
//! ```text
//! n_k = ρ·n_{k−1} + σ·√(1 − ρ²)·e_k,  ρ = e^(−Δt/τ)        noise with a memory, its variance kept
//! ω = q·(⌊φ⌋ − ⌊φ − ω/q⌋)                                   counts of an encoder over a short time, φ in counts
//! ```

use std::fmt::Write;

use crate::drawn::Drawn;
use crate::reading::Reading;
use crate::robot_file::Noise;

/// How a robot logs.
#[derive(Clone, Debug, PartialEq)]
pub struct Logging {
    /// True noise over what the file states, of each sensor [1]
    pub noise_factor: Noise,
    /// How long noise remembers, of each sensor [s]
    pub correlation: Noise,
    /// How fast a wheel turns for one count in the time over which an encoder counts [rad/s]; 0 where it tells exactly
    pub quantum: f64,
    /// Rows that are not written, though the robot goes on [1]
    pub lost_rows: f64,
    /// Frames in which something else is taken for the robot [1]
    pub outliers: f64,
    /// Whether currents are written.
    pub currents: bool,
    /// Whether wheel speeds are.
    pub wheel_speeds: bool,
    /// Whether poses are.
    pub pose: bool,
    /// By how much of a row each is written before or after its turn, at the most [1]
    pub jitter: f64,
    /// Whether the camera has a clock of its own, and a file; none where its frames stand in rows of the drive.
    pub camera: Option<CameraClock>,
}

/// A camera that is recorded by a computer of its own.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CameraClock {
    /// Somebody has measured how its clock lies to the drive's: in all runs alike.
    Known,
    /// Nobody knows, and it is another in every run.
    Unknown,
}

/// The same number for every sensor.
const fn all(each: f64) -> Noise {
    Noise { current: each, wheel_speed: each, position: each, heading: each, gyro: each }
}

/// How far off a frame may be in which something else is taken for the robot [m]
const FAR_OFF: f64 = 0.5;

/// Most times by which true noise is larger or smaller than stated [1]
const MISSTATED: f64 = 2.5;

/// The longest that noise remembers [s]
const REMEMBERED: f64 = 0.05;

/// The most by which a row is early or late, of a row [1]
const LATEST: f64 = 0.2;

/// The coarsest counts, over the stated noise of wheel speeds [1]: as noise, q/√12 = 2.3 σ
const COARSEST: f64 = 8.0;

impl Logging {
    /// All that is measured, with white noise of the sizes that are stated.
    pub fn clean() -> Self {
        Self {
            noise_factor: all(1.0),
            correlation: all(0.0),
            quantum: 0.0,
            lost_rows: 0.0,
            outliers: 0.0,
            currents: true,
            wheel_speeds: true,
            pose: true,
            jitter: 0.0,
            camera: None,
        }
    }

    /// As robots leave logs: each of these a little out of order, and in some one group of signals missing.
    pub fn drawn(stated: &Noise, drawn: &mut Drawn) -> Self {
        let mut each = |one: &mut dyn FnMut(&mut Drawn) -> f64| Noise {
            current: one(drawn),
            wheel_speed: one(drawn),
            position: one(drawn),
            heading: one(drawn),
            gyro: one(drawn),
        };
        let noise_factor = each(&mut |drawn| drawn.log_between(1.0 / MISSTATED, MISSTATED));
        let correlation = each(&mut |drawn| drawn.between(0.0, REMEMBERED));
        let missing = drawn.below(6);
        Self {
            noise_factor,
            correlation,
            quantum: stated.wheel_speed * drawn.log_between(0.5, COARSEST),
            lost_rows: drawn.between(0.0, 0.02),
            outliers: drawn.between(0.0, 0.004),
            currents: missing != 0,
            wheel_speeds: missing != 1,
            pose: missing != 2,
            jitter: drawn.between(0.0, LATEST),
            camera: None,
        }
    }
}

/// A log that is being written.
#[derive(Debug)]
pub struct Log<'a> {
    logging: &'a Logging,
    stated: &'a Noise,
    sets_speed: bool,
    gyro: bool,
    /// Noise of every number of the row before, in the order in which it is drawn
    before: Vec<f64>,
    time: f64,
    noise: Drawn,
    /// Of what is lost and taken for something else: apart, so that neither changes the noise
    chance: Drawn,
}

/// What parts chance from noise.
const OF_CHANCE: u64 = 0xc4a2;

impl<'a> Log<'a> {
    /// An empty one.
    pub fn new(logging: &'a Logging, stated: &'a Noise, gyro: bool, seed: u64) -> Self {
        let (noise, chance) = (Drawn::new(seed), Drawn::new(seed ^ OF_CHANCE));
        Self { logging, stated, sets_speed: false, gyro, before: Vec::new(), time: 0.0, noise, chance }
    }

    /// The same of a drive that is told speeds, if it is.
    #[must_use]
    pub fn of_set_speeds(self, sets_speed: bool) -> Self {
        Self { sets_speed, ..self }
    }

    /// The names of its columns.
    pub fn header(&self, wheels: usize) -> String {
        let of = |is: bool, name: &str, unit: &str| {
            if is { (0..wheels).map(|j| format!(",{name}{j}_{unit}")).collect::<String>() } else { String::new() }
        };
        let Logging { currents, wheel_speeds, .. } = *self.logging;
        let u = if self.sets_speed { of(true, "wset", "rad_s") } else { of(true, "u", "V") };
        let (i, w) = (of(currents, "i", "A"), of(wheel_speeds, "w", "rad_s"));
        let pose = if self.has_pose() { ",x_m,y_m,theta_rad" } else { "" };
        let gyro = if self.gyro { ",gyro_rad_s" } else { "" };
        format!("t_s{u}{i}{w}{pose}{gyro}\n")
    }

    /// Whether poses stand in the rows of the drive.
    fn has_pose(&self) -> bool {
        self.logging.pose && self.logging.camera.is_none()
    }

    /// The names of the columns of a camera's own file.
    pub fn camera_header() -> &'static str {
        "t_s,x_m,y_m,theta_rad\n"
    }

    /// A row of it, of a pose at a time [s] that the camera's clock shows as another [s]; nothing where it is lost.
    pub fn frame(&mut self, (time, stamp): (f64, f64), pose: [f64; 3]) -> String {
        let elapsed = time - self.time;
        self.time = time;
        let mut number = 0;
        let [x, y, heading] = self.seen(pose, &mut number, elapsed, true);
        let lost = self.chance.between(0.0, 1.0) < self.logging.lost_rows;
        if lost { String::new() } else { format!("{stamp:.6},{x:.6},{y:.6},{heading:.6}\n") }
    }

    /// A row, with a pose if the camera took a frame; nothing where it is lost.
    pub fn row(&mut self, reading: &Reading, framed: bool) -> String {
        let mut line = format!("{:.6}", reading.time);
        let mut put = |value: Option<f64>| match value {
            Some(value) => write!(line, ",{value:.6}").expect("a string takes any text"),
            None => line.push(','),
        };
        let elapsed = reading.time - self.time;
        self.time = reading.time;
        reading.command.iter().for_each(|u| put(Some(*u)));
        let mut number = 0;
        let (logging, stated) = (self.logging, self.stated);
        let (factor, memory) = (&logging.noise_factor, &logging.correlation);
        for i in &reading.currents {
            let seen = i + self.noise(&mut number, stated.current * factor.current, memory.current, elapsed);
            if logging.currents {
                put(Some(seen));
            }
        }
        for (j, w) in reading.wheel_speeds.iter().enumerate() {
            let sigma = stated.wheel_speed * factor.wheel_speed;
            let seen =
                self.counted(*w, reading.wheel_angles[j]) + self.noise(&mut number, sigma, memory.wheel_speed, elapsed);
            if logging.wheel_speeds {
                put(Some(seen));
            }
        }
        // drawn on every row, so that a faster camera does not change all other noise
        let seen = self.seen(reading.pose, &mut number, elapsed, framed);
        if self.has_pose() {
            seen.into_iter().for_each(|x| put(framed.then_some(x)));
        }
        if self.gyro {
            let sigma = stated.gyro * factor.gyro;
            put(Some(reading.gyro + self.noise(&mut number, sigma, memory.gyro, elapsed)));
        }
        let lost = self.chance.between(0.0, 1.0) < logging.lost_rows;
        if lost { String::new() } else { line + "\n" }
    }

    /// A pose with its noise, or elsewhere.
    fn seen(&mut self, pose: [f64; 3], number: &mut usize, elapsed: f64, framed: bool) -> [f64; 3] {
        let (logging, stated) = (self.logging, self.stated);
        let (factor, memory) = (&logging.noise_factor, &logging.correlation);
        let elsewhere = framed && self.chance.between(0.0, 1.0) < logging.outliers;
        let position = (stated.position * factor.position, memory.position);
        let heading = (stated.heading * factor.heading, memory.heading);
        let mut seen = pose;
        for (x, (sigma, memory)) in seen.iter_mut().zip([position, position, heading]) {
            *x += self.noise(number, sigma, memory, elapsed);
            if elsewhere {
                *x += self.chance.between(-FAR_OFF, FAR_OFF);
            }
        }
        seen
    }

    /// The noise of the next number of a row.
    fn noise(&mut self, number: &mut usize, sigma: f64, memory: f64, elapsed: f64) -> f64 {
        let fresh = sigma * self.noise.normal();
        let k = *number;
        *number += 1;
        if k == self.before.len() {
            self.before.push(fresh);
        } else {
            let kept = if memory > 0.0 { libm::exp(-elapsed / memory) } else { 0.0 };
            self.before[k] = kept * self.before[k] + (1.0 - kept * kept).sqrt() * fresh;
        }
        self.before[k]
    }

    /// What counts tell of a speed [rad/s] at an angle [rad].
    fn counted(&self, speed: f64, angle: f64) -> f64 {
        let q = self.logging.quantum;
        if q == 0.0 {
            return speed;
        }
        // in counts, of which there are as many in a turn as make q of one in COUNTED seconds
        let now = angle / (q * COUNTED);
        q * (now.floor() - (now - speed / q).floor())
    }
}

/// How long an encoder counts [s]
const COUNTED: f64 = 5e-3;

#[cfg(test)]
mod tests {
    use super::*;

    /// Rows of a robot at rest, but that it turns its wheels, 5 ms apart.
    fn rows(logging: &Logging, speed: f64, count: usize) -> Vec<Vec<Option<f64>>> {
        let stated = Noise { current: 0.02, wheel_speed: 0.15, position: 0.003, heading: 0.01, gyro: 0.005 };
        let mut log = Log::new(logging, &stated, true, 4);
        let row = |k: usize| Reading {
            time: 5e-3 * k as f64,
            command: vec![1.0; 3],
            currents: vec![0.5; 3],
            wheel_speeds: vec![speed; 3],
            wheel_angles: vec![5e-3 * k as f64 * speed; 3],
            ..Reading::default()
        };
        let text: String = (0..count).map(|k| log.row(&row(k), true)).collect();
        text.lines().map(|line| line.split(',').map(|cell| cell.parse().ok()).collect()).collect()
    }

    fn moments(of: impl Iterator<Item = f64>) -> (f64, f64) {
        let all: Vec<f64> = of.collect();
        let mean = all.iter().sum::<f64>() / all.len() as f64;
        (mean, all.iter().map(|x| (x - mean) * (x - mean)).sum::<f64>() / all.len() as f64)
    }

    #[test]
    fn noise_has_the_size_that_it_has_and_not_the_one_that_is_stated() {
        let twice = Logging { noise_factor: all(2.0), ..Logging::clean() };
        let (mean, variance) = moments(rows(&twice, 0.0, 10_000).iter().map(|row| row[4].expect("a current")));
        assert!((mean - 0.5).abs() < 4.0 * 0.04 / 100.0, "{mean}");
        // the variance of a variance: 2·σ⁴/n
        assert!((variance / 0.0016 - 1.0).abs() < 4.0 * (2.0_f64 / 1e4).sqrt(), "{variance}");
    }

    #[test]
    fn noise_with_a_memory_keeps_its_size_and_forgets_as_fast_as_it_says() {
        let slow = Logging { correlation: all(0.02), ..Logging::clean() };
        let seen: Vec<f64> = rows(&slow, 0.0, 40_000).iter().map(|row| row[4].expect("a current") - 0.5).collect();
        let (_, variance) = moments(seen.iter().copied());
        let (_, together) = moments(seen.windows(2).map(|pair| pair[0] + pair[1]));
        // var(a + b) = 2·σ²·(1 + ρ); 8 rows to forget leave n/8 that are their own
        let correlation = together / (2.0 * variance) - 1.0;
        assert!((variance / 0.0004 - 1.0).abs() < 4.0 * (2.0_f64 * 8.0 / 4e4).sqrt(), "{variance}");
        assert!((correlation - libm::exp(-0.25)).abs() < 0.02, "{correlation}");
    }

    #[test]
    fn counts_are_whole_and_right_in_the_mean() {
        let coarse = Logging { quantum: 1.0, noise_factor: all(0.0), ..Logging::clean() };
        let speeds: Vec<f64> = rows(&coarse, 2.317_3, 1000).iter().map(|row| row[7].expect("a speed")).collect();
        assert!(speeds.iter().all(|w| *w == 2.0 || *w == 3.0));
        let (mean, _) = moments(speeds.into_iter());
        assert!((mean - 2.317_3).abs() < 2e-3, "{mean}");
    }

    #[test]
    fn rows_are_lost_and_frames_are_elsewhere_as_often_as_it_says() {
        let count = 20_000;
        let careless = Logging { lost_rows: 0.02, outliers: 0.004, ..Logging::clean() };
        let all = rows(&careless, 0.0, count);
        let lost = (count - all.len()) as f64;
        assert!((lost - 400.0).abs() < 4.0 * 392.0_f64.sqrt(), "{lost}");
        // even between −0.5 and 0.5 m, and seen from 0.05 m on
        let elsewhere = all.iter().filter(|row| row[10].expect("a pose").abs() > 0.05).count() as f64;
        assert!((elsewhere - 0.9 * 0.004 * all.len() as f64).abs() < 4.0 * 71.0_f64.sqrt(), "{elsewhere}");
        assert!(all.windows(2).all(|pair| pair[0][0] < pair[1][0]));
    }

    #[test]
    fn what_is_not_logged_has_no_column_and_a_drawn_log_misses_one_group_at_most() {
        for seed in 0..60 {
            let stated = all(0.1);
            let logging = Logging::drawn(&stated, &mut Drawn::new(seed));
            let header = Log::new(&logging, &stated, false, 1).header(3);
            let has = |name: &str| header.trim().split(',').any(|column| column == name);
            assert_eq!(
                [has("i2_A"), has("w2_rad_s"), has("x_m")],
                [logging.currents, logging.wheel_speeds, logging.pose]
            );
            let missing = [logging.currents, logging.wheel_speeds, logging.pose].iter().filter(|is| !**is).count();
            assert!(missing <= 1 && has("u0_V"));
        }
    }
}
