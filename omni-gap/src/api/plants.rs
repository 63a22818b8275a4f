//! Plants: robots that are stepped by whoever calls, many of them side by side.

mod alone;
mod reset;
mod side_by_side;

use std::path::Path;

use crate::error::{Error, InputKind, Result};
use crate::log::RobotFile;

use alone::Alone;
use side_by_side::SideBySide;

pub use reset::Reset;

/// Robots of files with their effects, stepped together; each moves as it would alone, bit for bit.
///
/// Plain robots on the same wheels take their steps in the lanes of one processor register, the others one after the other,
/// on all processors where there is work enough.
///
/// ```
/// use omni_gap::api::{Plants, Reset, RobotFile, known_effects};
/// use std::path::Path;
///
/// let text = include_str!("../../robots/feup-4w/robot.toml");
/// let robot = RobotFile::parse(text, Path::new("robot.toml"), &known_effects())?;
/// let mut plants = Plants::new(&[&robot; 3], None)?;
/// // 6 V on all wheels of the first, nothing on those of the others
/// let mut volts = [0.0; 12];
/// volts[..4].fill(6.0);
/// (0..100).for_each(|_| plants.step(&volts, 1e-3, 1));
/// let state = plants.state();
/// assert!(state[5].abs() > 0.1 && state[6..].iter().all(|x| *x == 0.0));
/// plants.reset(&Reset::default());
/// assert_eq!(plants.state(), [0.0; 18]);
/// # Ok::<(), omni_gap::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Plants {
    wheels: usize,
    count: usize,
    fleet: Fleet,
}

#[derive(Clone, Debug)]
enum Fleet {
    Three(Kind<3>),
    Four(Kind<4>),
}

#[derive(Clone, Debug)]
enum Kind<const N: usize> {
    Alone(Alone<N>),
    SideBySide(SideBySide<N>),
}

impl Plants {
    /// What a state is made of: the pose in the world, then the velocity along the body's axes.
    pub const STATE: [&'static str; 6] = ["x_m", "y_m", "theta_rad", "v_m_s", "vn_m_s", "w_rad_s"];

    /// One plant for each robot file, at rest where the world begins. `supply` [V] is assumed where a file states none.
    ///
    /// # Errors
    /// Where there is no robot, they have not as many wheels each, or one has effects that ask for the supply and states none.
    pub fn new(robots: &[&RobotFile], supply: Option<f64>) -> Result<Self> {
        let place = |file: &RobotFile| Path::new(&file.name).to_owned();
        let Some(first) = robots.first() else {
            return Err(Error::input(Path::new("robots"), "there is none", "Give one robot file at the least")
                .of_kind(InputKind::Missing));
        };
        let wheels = first.wheel.len();
        if let Some(other) = robots.iter().find(|robot| robot.wheel.len() != wheels) {
            let problem = format!("{} wheels, where {} has {wheels}", other.wheel.len(), first.name);
            return Err(Error::input(&place(other), problem, "Step robots with as many wheels each together")
                .of_kind(InputKind::Conflict));
        }
        let unsaid = |robot: &&&RobotFile| robot.supply.is_none() && supply.is_none() && !robot.effects.is_empty();
        if let Some(robot) = robots.iter().find(unsaid) {
            let problem = "it has effects and states no supply, which some of them ask for";
            return Err(Error::input(&place(robot), problem, "Add [supply] voltage_v, or name the supply's voltage")
                .of_kind(InputKind::Missing));
        }
        let supply = supply.unwrap_or(1.0);
        let fleet = match wheels {
            3 => Fleet::Three(Kind::of(robots, supply)),
            _ => Fleet::Four(Kind::of(robots, supply)),
        };
        Ok(Self { wheels, count: robots.len(), fleet })
    }

    /// How many wheels each robot has.
    pub fn wheels(&self) -> usize {
        self.wheels
    }

    /// How many robots there are.
    pub fn count(&self) -> usize {
        self.count
    }

    /// Puts all robots where they are to begin; what effects remember is forgotten, and readings are zero until a step is taken.
    ///
    /// # Panics
    /// Where there are states and not one for each robot.
    pub fn reset(&mut self, to: &Reset<'_>) {
        assert!(to.states.is_empty() || to.states.len() == self.count, "one state a robot");
        match &mut self.fleet {
            Fleet::Three(kind) => kind.reset(to),
            Fleet::Four(kind) => kind.reset(to),
        }
    }

    /// Holds motor voltages [V] for `dt_s` [s], which is gone through in so many equal steps of the plant; the voltages are those
    /// of the first robot wheel by wheel, then of the next.
    ///
    /// # Panics
    /// Where there is not one voltage for each wheel of each robot.
    pub fn step(&mut self, voltage: &[f64], dt_s: f64, steps: usize) {
        assert_eq!(voltage.len(), self.count * self.wheels, "one voltage a wheel of each robot");
        match &mut self.fleet {
            Fleet::Three(kind) => kind.step(voltage, dt_s, steps),
            Fleet::Four(kind) => kind.step(voltage, dt_s, steps),
        }
    }

    /// Where the robots are: for each the numbers of [`Plants::STATE`].
    pub fn state(&self) -> Vec<f64> {
        let mut all = Vec::with_capacity(self.count * Self::STATE.len());
        self.for_states(|state| all.extend(state));
        all
    }

    /// The same as bytes of the machine's order, eight a number, at the end of `to`.
    pub fn state_bytes(&self, to: &mut Vec<u8>) {
        self.for_states(|state| state.iter().for_each(|x| to.extend(x.to_ne_bytes())));
    }

    fn for_states(&self, take: impl FnMut([f64; 6])) {
        match &self.fleet {
            Fleet::Three(kind) => kind.for_states(take),
            Fleet::Four(kind) => kind.for_states(take),
        }
    }

    /// The names of a reading's numbers, as a run log has them.
    pub fn reading_columns(&self) -> Vec<String> {
        let wheels = |stem: &str, unit: &str| (0..self.wheels).map(|j| format!("{stem}{j}_{unit}")).collect::<Vec<_>>();
        let rest = ["x_m", "y_m", "theta_rad", "gyro_rad_s"].map(str::to_owned).to_vec();
        [wheels("i", "A"), wheels("w", "rad_s"), rest].concat()
    }

    /// What the sensors said at the beginning of the last step, just after its voltages were applied: a row of a run log without
    /// noise, for each robot the numbers of [`Plants::reading_columns`].
    pub fn reading(&self) -> Vec<f64> {
        match &self.fleet {
            Fleet::Three(kind) => kind.reading(),
            Fleet::Four(kind) => kind.reading(),
        }
    }
}

impl<const N: usize> Kind<N> {
    fn of(robots: &[&RobotFile], supply: f64) -> Self {
        SideBySide::of(robots, supply).map_or_else(|| Self::Alone(Alone::of(robots, supply)), Self::SideBySide)
    }

    fn reset(&mut self, to: &Reset<'_>) {
        match self {
            Self::Alone(robots) => robots.reset(to),
            Self::SideBySide(robots) => robots.reset(to),
        }
    }

    fn step(&mut self, voltage: &[f64], dt_s: f64, steps: usize) {
        let dt = dt_s / steps as f64;
        match self {
            Self::Alone(robots) => robots.step(voltage, dt, steps),
            Self::SideBySide(robots) => robots.step(voltage, dt, steps),
        }
    }

    fn for_states(&self, take: impl FnMut([f64; 6])) {
        match self {
            Self::Alone(robots) => robots.states().for_each(take),
            Self::SideBySide(robots) => robots.states().for_each(take),
        }
    }

    fn reading(&self) -> Vec<f64> {
        let mut all = Vec::new();
        let take = |reading: model_core::plant::Reading<N, f64>| {
            all.extend(reading.current);
            all.extend(reading.wheel_speed);
            all.extend([reading.pose.x, reading.pose.y, reading.pose.theta, reading.gyro]);
        };
        match self {
            Self::Alone(robots) => robots.readings().for_each(take),
            Self::SideBySide(robots) => robots.readings().for_each(take),
        }
        all
    }
}

#[cfg(test)]
mod tests;
