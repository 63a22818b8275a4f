//! Somebody who drives: here and there at random, with rests and reversals, and back before the field ends.

use nalgebra::{Vector2, Vector3};

use crate::contact::floor_row;
use crate::drawn::Drawn;
use crate::robot_file::RobotFile;
use crate::rotated::rotated;

/// From here on the way leads back [m]
const FIELD: f64 = 1.2;

/// What somebody drives for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Style {
    /// To show what a robot does: short, hard, all axes at once.
    Excitation,
    /// To get somewhere: longer, slower, with ramps, and with time to stand.
    Everyday,
    /// To show what a robot does whose drives control speed: all axes, by ramps that its motors can follow.
    SetPoints {
        /// How long a ramp to full speed takes [s]
        ramp: f64,
    },
}

impl Style {
    /// How long a wish lasts [s]
    fn hold(self) -> (f64, f64) {
        match self {
            Style::Excitation => (0.1, 0.6),
            Style::Everyday => (0.6, 2.5),
            // long enough for some wishes to come true
            Style::SetPoints { ramp } => (0.3_f64.max(0.1 * ramp), 1.2_f64.max(0.4 * ramp)),
        }
    }

    /// Of what a wish could be [1]
    fn part(self) -> f64 {
        match self {
            Style::Excitation => 1.0,
            Style::Everyday | Style::SetPoints { .. } => 0.7,
        }
    }

    /// How long a ramp to full voltage, or full speed, takes [s]; none where there is no ramp
    fn ramp(self) -> Option<f64> {
        match self {
            Style::Excitation => None,
            Style::Everyday => Some(RAMP_S),
            Style::SetPoints { ramp } => Some(ramp),
        }
    }
}

/// How long an everyday ramp to full voltage takes [s]
const RAMP_S: f64 = 0.8;

/// A driver with a taste of its own.
#[derive(Clone, Debug)]
pub struct Driver {
    /// Voltage of each wheel per speed of the floor below it [V per m/s], by the file
    per_speed: f64,
    rows: Vec<Vector3<f64>>,
    /// The most that a motor is given [V]
    voltage: f64,
    /// Whether it tells the wheels speeds instead of voltages.
    sets_speed: bool,
    /// Of the wheels [m]
    radii: Vec<f64>,
    drawn: Drawn,
    style: Style,
    until: f64,
    wish: Vector3<f64>,
    /// What has come of the wish so far, and when
    ramped: (Vector3<f64>, f64),
}

impl Driver {
    /// One that knows a robot by its file and gives its motors no more than so much [V].
    pub fn new(file: &RobotFile, voltage: f64, style: Style, seed: u64) -> Self {
        let setup = file.setup();
        let rows = setup.robot.wheels.iter().map(|wheel| floor_row(wheel.contact, wheel.heading)).collect();
        let per_speed = file.gear_ratio * file.emf_constant / file.mean_radius();
        let (wish, ramped) = (Vector3::zeros(), (Vector3::zeros(), 0.0));
        let (sets_speed, radii) = (file.drive.is_some(), file.wheels.iter().map(|wheel| wheel.2).collect());
        Self { per_speed, rows, voltage, sets_speed, radii, drawn: Drawn::new(seed), style, until: 0.0, wish, ramped }
    }

    /// The voltages, or the wheel speeds of a drive that controls these, at a time [s] and a pose [m, m, rad].
    pub fn command(&mut self, time: f64, [x, y, heading]: [f64; 3]) -> Vec<f64> {
        if time >= self.until - 1e-9 {
            let (least, most) = self.style.hold();
            self.until = time + self.drawn.between(least, most);
            self.wish = self.next_wish();
        }
        let mut wish = self.wish;
        let place = Vector2::new(x, y);
        if place.norm() > FIELD {
            // the part that leads further out is turned round
            let out = rotated(-heading, place / place.norm());
            let along = wish.xy().dot(&out);
            if along > 0.0 {
                wish -= 2.0 * along * Vector3::new(out.x, out.y, 0.0);
            }
        }
        if let Some(ramp) = self.style.ramp() {
            wish = self.ramped_to(wish, time, ramp);
        }
        if self.sets_speed {
            return self.set_speeds(wish);
        }
        self.rows.iter().map(|row| row.dot(&wish).clamp(-self.voltage, self.voltage)).collect()
    }

    /// The speeds of the wheels for a twist in volts at the rims [rad/s]: slower in all where one wheel alone could not, for
    /// wheels that do not roll together fight each other.
    fn set_speeds(&self, wish: Vector3<f64>) -> Vec<f64> {
        let most = self.rows.iter().map(|row| row.dot(&wish).abs()).fold(self.voltage, f64::max);
        let part = self.voltage / most;
        let speed = |(row, radius): (&Vector3<f64>, &f64)| part * row.dot(&wish) / (self.per_speed * radius);
        self.rows.iter().zip(&self.radii).map(speed).collect()
    }

    /// As far on the way to a wish as a ramp, which takes so long in all [s], is at a time [s].
    fn ramped_to(&mut self, wish: Vector3<f64>, time: f64, ramp: f64) -> Vector3<f64> {
        let (now, since) = self.ramped;
        let most = self.voltage * (time - since) / ramp;
        let arm = self.rows[0].z.abs();
        let most = Vector3::new(most, most, most / arm);
        self.ramped = (Vector3::from_fn(|k, _| now[k] + (wish[k] - now[k]).clamp(-most[k], most[k])), time);
        self.ramped.0
    }

    /// A twist, in volts at the rims: a rest, the last one reversed, a slow one, or any.
    fn next_wish(&mut self) -> Vector3<f64> {
        let most = self.voltage / self.per_speed;
        let part = match self.drawn.below(8) {
            0 => return Vector3::zeros(),
            1 => return -self.wish,
            2 => 0.3,
            _ => self.style.part(),
        };
        let mut any = |most: f64| self.drawn.between(-most, most);
        let arm = self.rows[0].z.abs();
        part * self.per_speed * Vector3::new(any(most), any(most), 0.5 * any(most / arm))
    }
}
