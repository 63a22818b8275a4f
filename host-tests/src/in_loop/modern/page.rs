//! # Page: what came of many seeds, as quantiles, and what is promised of them

use std::fmt::Write as _;

use super::{BOUND_CURRENT, CHATTER, EIGHT, Law, TUNING};
use crate::in_loop::figure_eight::TrackingError;
use crate::in_loop::page::{Emulated, Promise};
use crate::in_loop::ramps::{LEVELS, Ramp};
use crate::in_loop::saturation::DirectionError;

/// What 95 % of the accelerations' errors stay within, radius and distance of the wheels apart [1].
pub const ACCELERATION: f64 = 0.03;

/// The share that is meant by that [1].
const MOST: f64 = 0.95;

/// The quantiles that are printed [1].
const QUANTILES: [f64; 3] = [0.05, 0.5, 0.95];

/// Axes, as they are written.
const AXES: [&str; 3] = ["v", "vn", "ω"];

/// Ramps of one seed, all axes, and its true radius and distance over those believed [1].
#[derive(Clone, Debug)]
pub struct SeedRamps {
    /// The ramps
    pub ramps: Vec<Ramp>,
    /// Radius and distance [1]
    pub geometry: [f64; 2],
}

/// What came of a robot under a law, seed by seed.
#[derive(Clone, Debug)]
pub struct Driven {
    /// Which robot, and by which law
    pub name: String,
    /// True if its accelerations are promised
    pub promised: bool,
    /// Ramps
    pub ramps: Vec<SeedRamps>,
    /// Figure-eights; none of a robot that was not asked
    pub eights: Vec<TrackingError>,
}

/// All that came.
#[derive(Clone, Debug)]
pub struct Results {
    /// Robots and laws
    pub driven: Vec<Driven>,
    /// Gains that were found for the wheels' own controllers [A·s/rad, A/rad]
    pub gains: [f32; 2],
    /// The modern robot with currents that are bound
    pub bound: Vec<DirectionError>,
    /// The image
    pub emulated: Vec<Emulated>,
}

/// How a law is called on the page.
pub fn name(law: Law) -> &'static str {
    match law {
        Law::Model => "the firmware",
        Law::FeedbackAlone => "the same without the model's feedforward",
        Law::WheelPi(_) => "wheel speeds by PI",
    }
}

/// The value below which a share of these lies, straight between two of them; none of nothing.
fn quantile(values: impl Iterator<Item = f64>, share: f64) -> Option<f64> {
    let mut sorted: Vec<f64> = values.collect();
    sorted.sort_by(f64::total_cmp);
    let place = share * (sorted.len().checked_sub(1)? as f64);
    let (below, above) = (sorted[place.floor() as usize], sorted[place.ceil() as usize]);
    Some(below + (above - below) * place.fract())
}

/// Three quantiles, as they are written, with so many digits.
fn three(values: impl Iterator<Item = f64> + Clone, digits: usize) -> String {
    let one = |share| quantile(values.clone(), share).map_or("–".into(), |x| format!("{x:.digits$}"));
    QUANTILES.map(one).join(" | ")
}

impl Driven {
    /// Errors of the ramps of an axis and a level, starting and braking, and the same with the wheels' geometry apart [1].
    fn errors(&self, axis: usize, level: usize) -> Vec<[f64; 2]> {
        let of = |seed: &SeedRamps| {
            let geometry = seed.geometry;
            let ramps = seed.ramps.iter().filter(move |ramp| ramp.axis == axis && ramp.level == level);
            ramps.map(|ramp| [ramp.error(), ramp.error_apart(geometry)]).collect::<Vec<_>>()
        };
        self.ramps.iter().flat_map(of).collect()
    }

    /// What 95 % of the errors stay within, geometry apart [1].
    fn most(&self, axis: usize, level: usize) -> f64 {
        quantile(self.errors(axis, level).iter().map(|error| error[1].abs()), MOST).unwrap_or(f64::INFINITY)
    }

    fn promises(&self) -> Vec<Promise> {
        let places = (0..LEVELS.len()).flat_map(|level| (0..AXES.len()).map(move |axis| (axis, level)));
        places
            .filter(|_| self.promised)
            .map(|(axis, level)| {
                let (most, [wanted, _]) = (self.most(axis, level), LEVELS[level]);
                let what = format!("{}: {wanted} m/s² along {}: {:.2} %", self.name, AXES[axis], 100.0 * most);
                Promise { what, kept: most <= ACCELERATION }
            })
            .collect()
    }

    fn write(&self, page: &mut String) -> std::fmt::Result {
        writeln!(page, "\n### {} ({} seeds)\n", self.name, self.ramps.len())?;
        writeln!(page, "| wanted [m/s²] | axis | 5 % | median | 95 % | apart: 5 % | median | 95 % | 95 % within ± |")?;
        writeln!(page, "|---|---|---|---|---|---|---|---|---|")?;
        for (level, [wanted, _]) in LEVELS.iter().enumerate() {
            for (axis, name) in AXES.iter().enumerate() {
                let errors = self.errors(axis, level);
                let [all, apart] = [0, 1].map(|k| three(errors.iter().map(move |error| 100.0 * error[k]), 1));
                let most = 100.0 * self.most(axis, level);
                writeln!(page, "| {wanted} | {name} | {all} | {apart} | {most:.1} |")?;
            }
        }
        Ok(())
    }
}

impl Results {
    /// What is promised.
    pub fn promises(&self) -> Vec<Promise> {
        let mut all: Vec<Promise> = self.driven.iter().flat_map(Driven::promises).collect();
        for (k, bound) in self.bound.iter().enumerate() {
            let what = format!("currents bound, seed {}: for {:.3} s", k + 1, bound.time);
            all.push(Promise { what, kept: bound.time > 0.05 });
        }
        for run in &self.emulated {
            let why = run.differs.as_deref().unwrap_or_default();
            all.push(Promise {
                what: format!("{}: the image against the host: {why}", run.name),
                kept: why.is_empty(),
            });
        }
        all
    }

    /// The page.
    pub fn page(&self) -> String {
        let mut page = String::new();
        self.write(&mut page).expect("a string takes all");
        page
    }

    fn write(&self, page: &mut String) -> std::fmt::Result {
        let seeds = self.bound.len();
        let [p, i] = self.gains;
        writeln!(
            page,
            "# Many seeds, and a modern robot\n\n\
             {seeds} seeds. The paper's robots are off and spoiled as on `in_loop.md`. The modern robot is `examples/ssl-24v`: 24 V, 0.6 Ω, \
             2.5 kg, 3 m/s,\n4 m/s²; it is off by the same draws and has, besides, a floor that holds 0.9 to 1.1 of its weight, wheels of 15 \
             rollers with up to 0.5 % of\nripple, 0.005 to 0.015 rad of play in each gear, hall switches that are undecided within {CHATTER}° (electrical) \
             of an edge, and a link on which\ncommands are up to 5 ms late. Commands come a hundred times a second.\n\n\
             Compared with it: the same loop without the model's feedforward, and a PI controller of each wheel's speed with {p} A·s/rad and \
             {i} A/rad,\nthe best of 20 pairs on the figure-eight of seeds {}, {} and {}, which are not judged.\n\n\
             Promised: 95 % of the firmware's accelerations are within ±{:.0} %, radius and distance of the wheels apart, which no feedback from \
             wheels can see.",
            TUNING[0],
            TUNING[1],
            TUNING[2],
            100.0 * ACCELERATION,
        )?;
        writeln!(page, "\n## Accelerations\n\nTrue over wanted less one [%], starting and braking together.")?;
        self.driven.iter().try_for_each(|driven| driven.write(page))?;
        let [size, speed] = EIGHT;
        writeln!(
            page,
            "\n## Figure-eight of the modern robot\n\n\
             At {speed} m/s, {:.0} m long, commands with acceleration: root mean square of what the robot is off the path, over the lap.\n\n\
             | law | velocity [mm/s]: 5 % | median | 95 % | radius apart: 5 % | median | 95 % | position [mm]: 5 % | median | 95 % |\n\
             |---|---|---|---|---|---|---|---|---|---|",
            2.0 * size
        )?;
        for driven in self.driven.iter().filter(|driven| !driven.eights.is_empty()) {
            let of = |what: fn(&TrackingError) -> f64| three(driven.eights.iter().map(move |e| 1e3 * what(e)), 1);
            let [velocity, apart, position] = [of(|e| e.velocity), of(|e| e.apart), of(|e| e.position)];
            writeln!(page, "| {} | {velocity} | {apart} | {position} |", driven.name)?;
        }
        let of = |what: fn(&DirectionError) -> f64, digits| three(self.bound.iter().map(what), digits);
        writeln!(
            page,
            "\n## Currents that bind\n\n\
             The modern robot with {BOUND_CURRENT} A a motor, told to go off at 20° with 6 m/s²: angle between true and wanted acceleration while \
             not all of it fits.\n\n\
             | | 5 % | median | 95 % |\n|---|---|---|---|\n| root mean square [°] | {} |\n| most [°] | {} |\n| for [ms] | {} |",
            of(|bound| bound.rms.to_degrees(), 1),
            of(|bound| bound.most.to_degrees(), 1),
            of(|bound| 1e3 * bound.time, 0),
        )?;
        writeln!(
            page,
            "\n## The image in the emulator\n\nThe records are those of the same library on the host, bit for bit, load and jitter apart.\n\n\
             | run | records |\n|---|---|"
        )?;
        self.emulated.iter().try_for_each(|run| writeln!(page, "| {} | {} |", run.name, run.records))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_quantile_lies_straight_between_two_values() {
        let of = |share| quantile([3.0, 1.0, 2.0, 5.0, 4.0].into_iter(), share);
        assert_eq!([0.0, 0.5, 0.6, 1.0].map(of), [Some(1.0), Some(3.0), Some(3.4), Some(5.0)]);
        assert_eq!(quantile(std::iter::empty(), 0.5), None);
    }
}
