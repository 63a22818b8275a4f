//! Somebody who drives: here and there at random, with rests and reversals, and back before the field ends.

use nalgebra::{Vector2, Vector3};

use crate::contact::floor_row;
use crate::drawn::Drawn;
use crate::robot_file::RobotFile;
use crate::rotated::rotated;

/// From here on the way leads back [m]
const FIELD: f64 = 1.2;

/// What somebody drives for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Style {
    /// To show what a robot does: short, hard, all axes at once.
    Excitation,
    /// To get somewhere: longer, slower, with ramps, and with time to stand.
    Everyday,
}

impl Style {
    /// How long a wish lasts [s]
    fn hold(self) -> (f64, f64) {
        match self {
            Style::Excitation => (0.1, 0.6),
            Style::Everyday => (0.6, 2.5),
        }
    }

    /// Of what a wish could be [1]
    fn part(self) -> f64 {
        match self {
            Style::Excitation => 1.0,
            Style::Everyday => 0.7,
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
        let radius = file.wheels.iter().map(|wheel| wheel.2).sum::<f64>() / file.wheels.len() as f64;
        let per_speed = file.gear_ratio * file.emf_constant / radius;
        let (wish, ramped) = (Vector3::zeros(), (Vector3::zeros(), 0.0));
        Self { per_speed, rows, voltage, drawn: Drawn::new(seed), style, until: 0.0, wish, ramped }
    }

    /// The voltages at a time [s] and a pose [m, m, rad].
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
        if self.style == Style::Everyday {
            wish = self.ramped_to(wish, time);
        }
        self.rows.iter().map(|row| row.dot(&wish).clamp(-self.voltage, self.voltage)).collect()
    }

    /// As far on the way to a wish as a ramp is at a time [s].
    fn ramped_to(&mut self, wish: Vector3<f64>, time: f64) -> Vector3<f64> {
        let (now, since) = self.ramped;
        let most = self.voltage * (time - since) / RAMP_S;
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
