//! Which regime of a drive explains best when an effect shows.
//!
//! ```text
//! cos = Σ e·f / √(Σ e² · Σ f²)
//! ```
//!
//! with e the root mean square of the change over an interval, f that of what marks the regime: 1 where the one goes with the
//! other throughout. A regime has several marks where an effect may grow with a power of it; the best counts.

use model_core::effects::shows::Regime;
use model_core::plant::Plant;

use super::restarted::RowBeside;

/// Regimes.
pub(super) const REGIMES: usize = Regime::ALL.len();

/// A wheel turns slowly below these [rad/s]
const SLOW: [f64; 3] = [1.5, 3.0, 8.0];
/// The robot moves above that, at its wheels [rad/s]
const STILL: f64 = 0.1;
/// A current flows above that [A]
const NO_CURRENT: f64 = 0.1;
/// For how long something has just happened: two lengths, as effects differ in theirs [s]
const JUST: [f64; 2] = [0.02, 0.06];

/// A drive in which something shows.
pub(super) struct Driven<'a, const N: usize> {
    /// The model.
    pub plant: &'a Plant<N, f64>,
    /// Its rows.
    pub rows: &'a [RowBeside<N>],
    /// What each motor is commanded, row by row, as a share of the largest.
    pub command: &'a [[f64; N]],
    /// Wheels at which the effect shows, and whether it is one of wheels.
    pub wheels: &'a [usize],
    pub of_wheels: bool,
    /// Whether it shows in the pose: nothing else sums up a way.
    pub in_pose: bool,
    /// Rows a second [1/s], and rows of an interval
    pub rate: (f64, usize),
    /// Noise of positions and of headings [m] [rad]
    pub pose_noise: [f64; 2],
}

impl<const N: usize> Driven<'_, N> {
    /// How well each regime explains a size that is told row by row, in the order of [`Regime::ALL`].
    pub fn explain(&self, size: &[f64]) -> [f64; REGIMES] {
        let size = self.intervals(size);
        Regime::ALL.map(|regime| {
            let marks = self.marks(regime).into_iter().map(|mark| alike(&size, &self.intervals(&mark)));
            marks.fold(0.0, f64::max)
        })
    }

    /// What marks a regime, row by row.
    fn marks(&self, regime: Regime) -> Vec<Vec<f64>> {
        let flag = |is: bool| f64::from(u8::from(is));
        let slow = |limit: f64| move |r, j| flag(self.speed(r, j).abs() < limit && self.command[r][j] != 0.0);
        let twist = |r: usize| self.rows[r].truth.twist;
        let along = |r: usize| twist(r).v.hypot(twist(r).vn);
        match regime {
            Regime::Always => vec![self.body(|_| 1.0)],
            Regime::Motion => vec![self.any(|r, j| self.speed(r, j).abs() > STILL)],
            Regime::Speed => {
                let rate = |r| (along(r) / self.pose_noise[0]).hypot(twist(r).w / self.pose_noise[1]);
                vec![
                    self.wheel(|r, j| self.speed(r, j)),
                    self.wheel(|r, j| self.speed(r, j).powi(2)),
                    self.body(along),
                    self.body(|r| along(r).powi(2)),
                    self.body(rate),
                    self.body(|r| rate(r) * r as f64),
                ]
            }
            Regime::AlongAxle if self.of_wheels => vec![self.wheel(|r, j| self.along_axle(r, j))],
            Regime::AlongAxle => Vec::new(),
            Regime::Creeping => SLOW.map(|limit| self.wheel(slow(limit))).to_vec(),
            Regime::Reversal => {
                let turns = |r: usize, j| {
                    let [before, now] = [r - 1, r].map(|r| self.speed(r, j));
                    before * now <= 0.0 && before != now
                };
                self.just()
                    .map(|span| self.wheel(|r, j| flag((r.saturating_sub(span - 1).max(1)..=r).any(|r| turns(r, j)))))
                    .to_vec()
            }
            Regime::Acceleration => {
                let next = |r: usize| (r + 1).min(self.rows.len() - 1);
                let gains = |r, j| self.speed(next(r), j) - self.speed(r, j);
                // load moves along the axle, away from where the robot speeds up to
                let loses = |r, j| self.along_axle(next(r), j) - self.along_axle(r, j);
                vec![
                    self.wheel(gains),
                    self.wheel(|r, j| gains(r, j).powi(2)),
                    self.wheel(|r, j| loses(r, j) * self.current(r, j)),
                    self.wheel(|r, j| loses(r, j) * self.current(r, j).powi(2)),
                ]
            }
            Regime::Voltage => vec![self.wheel(|r, j| self.command[r][j])],
            Regime::Driven => vec![self.wheel(|r, j| flag(self.current(r, j).abs() > NO_CURRENT))],
            Regime::Current => {
                let of = |power| self.wheel(|r, j| self.current(r, j).powi(power));
                let late = self.wheel(|r, j| self.current(r, j) * r as f64);
                vec![of(1), of(2), of(3), late]
            }
            Regime::Braking => {
                let brakes = |r, j| self.current(r, j) * self.speed(r, j) < 0.0;
                vec![self.wheel(|r, j| flag(brakes(r, j)))]
            }
            Regime::CommandChange => {
                let changed = |span, r: usize, j| self.command[r][j] - self.command[r.saturating_sub(span)][j];
                self.just().map(|span| self.wheel(|r, j| changed(span, r, j))).to_vec()
            }
            Regime::TurningWhileDriving => vec![self.body(|r| twist(r).w * along(r))],
            Regime::Aslant => {
                let both = |r: usize| twist(r).v * twist(r).vn;
                vec![self.body(both), self.body(|r| both(r) / along(r).powi(2).max(f64::MIN_POSITIVE))]
            }
            Regime::Distance | Regime::Turned if !self.in_pose => Vec::new(),
            Regime::Distance => {
                let far = |r: usize| self.rows[r].model.pose.x.hypot(self.rows[r].model.pose.y);
                vec![self.body(far), self.body(|r| far(r).powi(2))]
            }
            Regime::Turned => vec![self.body(|r| (0.5 * self.rows[r].model.pose.theta).sin())],
        }
    }

    /// A mark of the body.
    fn body(&self, of: impl Fn(usize) -> f64) -> Vec<f64> {
        (0..self.rows.len()).map(of).collect()
    }

    /// A mark of the wheels: the root of the sum of its squares.
    fn wheel(&self, of: impl Fn(usize, usize) -> f64) -> Vec<f64> {
        self.body(|r| self.wheels.iter().map(|j| of(r, *j).powi(2)).sum::<f64>().sqrt())
    }

    /// 1 where something is so at any of the wheels.
    fn any(&self, is: impl Fn(usize, usize) -> bool) -> Vec<f64> {
        self.body(|r| f64::from(u8::from(self.wheels.iter().any(|j| is(r, *j)))))
    }

    /// For how many rows something has just happened.
    fn just(&self) -> [usize; 2] {
        JUST.map(|seconds| (seconds * self.rate.0) as usize)
    }

    /// Speed of a wheel that rolls [rad/s]
    fn speed(&self, r: usize, j: usize) -> f64 {
        let wheels = &self.plant.robot().wheels;
        let ([v, vn, w], twist) = (wheels.rows()[j], self.rows[r].truth.twist);
        (v * twist.v + vn * twist.vn + w * twist.w) / wheels.wheels()[j].radius
    }

    /// How fast a wheel is moved along its axle [m/s]
    fn along_axle(&self, r: usize, j: usize) -> f64 {
        let wheels = &self.plant.robot().wheels;
        let ([v, vn, _], twist) = (wheels.rows()[j], self.rows[r].truth.twist);
        v * twist.vn - vn * twist.v
    }

    /// Current of a motor as the model says it [A]
    fn current(&self, r: usize, j: usize) -> f64 {
        self.rows[r].model.current[j]
    }

    /// Root mean squares, interval by interval.
    fn intervals(&self, x: &[f64]) -> Vec<f64> {
        x.chunks(self.rate.1).map(|x| (x.iter().map(|x| x * x).sum::<f64>() / x.len() as f64).sqrt()).collect()
    }
}

/// The cosine of the angle between two lists; 0 where one is nothing.
fn alike(a: &[f64], b: &[f64]) -> f64 {
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let size = (dot(a, a) * dot(b, b)).sqrt();
    if size > 0.0 { dot(a, b) / size } else { 0.0 }
}
