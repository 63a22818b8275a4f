//! Somebody who drives: here and there at random, with rests and reversals, and back before the field ends.

use nalgebra::{Vector2, Vector3};

use crate::contact::floor_row;
use crate::drawn::Drawn;
use crate::robot_file::RobotFile;
use crate::rotated::rotated;

/// From here on the way leads back [m]
const FIELD: f64 = 1.2;

/// How long a wish lasts [s]
const HOLD: (f64, f64) = (0.1, 0.6);

/// A driver with a taste of its own.
#[derive(Clone, Debug)]
pub struct Driver {
    /// Voltage of each wheel per speed of the floor below it [V per m/s], by the file
    per_speed: f64,
    rows: Vec<Vector3<f64>>,
    /// The most that a motor is given [V]
    voltage: f64,
    drawn: Drawn,
    until: f64,
    wish: Vector3<f64>,
}

impl Driver {
    /// One that knows a robot by its file and gives its motors no more than so much [V].
    pub fn new(file: &RobotFile, voltage: f64, seed: u64) -> Self {
        let setup = file.setup();
        let rows = setup.robot.wheels.iter().map(|wheel| floor_row(wheel.contact, wheel.heading)).collect();
        let radius = file.wheels.iter().map(|wheel| wheel.2).sum::<f64>() / file.wheels.len() as f64;
        let per_speed = file.gear_ratio * file.emf_constant / radius;
        Self { per_speed, rows, voltage, drawn: Drawn::new(seed), until: 0.0, wish: Vector3::zeros() }
    }

    /// The voltages at a time [s] and a pose [m, m, rad].
    pub fn command(&mut self, time: f64, [x, y, heading]: [f64; 3]) -> Vec<f64> {
        if time >= self.until - 1e-9 {
            self.until = time + self.drawn.between(HOLD.0, HOLD.1);
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
        self.rows.iter().map(|row| row.dot(&wish).clamp(-self.voltage, self.voltage)).collect()
    }

    /// A twist, in volts at the rims: a rest, the last one reversed, a slow one, or any.
    fn next_wish(&mut self) -> Vector3<f64> {
        let most = self.voltage / self.per_speed;
        let part = match self.drawn.below(8) {
            0 => return Vector3::zeros(),
            1 => return -self.wish,
            2 => 0.3,
            _ => 1.0,
        };
        let mut any = |most: f64| self.drawn.between(-most, most);
        let arm = self.rows[0].z.abs();
        part * self.per_speed * Vector3::new(any(most), any(most), 0.5 * any(most / arm))
    }
}
