//! # Page: what came of the scenarios, as tables, and what is promised of them

use std::fmt::Write as _;

use super::command_timeout::CommandTimeout;
use super::figure_eight::{Commands, TrackingError, WAYS};
use super::ramps::{LEVELS, Ramp};
use super::robots;
use super::saturation::DirectionError;
use crate::golden;

/// Largest error of an acceleration [1]
pub const ACCELERATION: f64 = 0.03;

/// Largest error of the figure-eight over that of feedback alone [1]
pub const RATIO: f64 = 0.25;

/// Largest velocity error of the figure-eight by commands with acceleration and a quick integral, over that of the first way, the radius
/// of the wheels apart in both [1]
pub const BY_RAMPS: f64 = 0.5;

/// Longest time from the end of 200 ms of silence to rest, from 1 m/s [s]
pub const RESTS: f64 = 0.6;

/// Longest time from the last command to open bridges [s]: the silence, a third of a second of braking, 100 ms at rest, and
/// a turn each to see and to act.
pub const OPENS: f64 = 0.64;

/// Axes, as they are written.
const AXES: [&str; 3] = ["v", "vn", "ω"];

/// What came of one robot.
#[derive(Clone, Debug, Default)]
pub struct Robot {
    /// Its name
    pub name: &'static str,
    /// True radius over believed radius, and the same over distances, less one, seed by seed [1]
    pub geometry: Vec<[f64; 2]>,
    /// Ramps of every axis, seed by seed
    pub ramps: Vec<Vec<Ramp>>,
    /// Figure-eights with the model and by feedback alone, seed by seed
    pub eights: Vec<[TrackingError; 2]>,
    /// Figure-eights in each of their ways, seed by seed
    pub ways: Vec<Vec<TrackingError>>,
    /// Saturations with headroom, and with each wheel clipped by itself, seed by seed
    pub saturations: Vec<[DirectionError; 2]>,
    /// Silences, seed by seed
    pub silences: Vec<CommandTimeout>,
}

/// A run of the image.
#[derive(Clone, Debug)]
pub struct Emulated {
    /// Which
    pub name: String,
    /// Records that it left
    pub records: usize,
    /// Worst load [‰] and jitter [cycles]
    pub load: [u16; 2],
    /// What is not as in software
    pub differs: Option<String>,
}

/// Something that must hold.
#[derive(Clone, Debug)]
pub struct Promise {
    /// What
    pub what: String,
    /// True if it does
    pub kept: bool,
}

fn rms(values: impl Iterator<Item = f64>) -> f64 {
    let (sum, n) = values.fold((0.0, 0.0), |(sum, n), x| (sum + x * x, n + 1.0));
    f64::sqrt(sum / n)
}

impl Robot {
    /// Root mean square over the seeds: velocity [m/s] and position [m], of the model and of feedback alone.
    fn eight(&self) -> [[f64; 2]; 2] {
        [0, 1].map(|k| [rms(self.eights.iter().map(|e| e[k].velocity)), rms(self.eights.iter().map(|e| e[k].position))])
    }

    /// Root mean square over the seeds of a figure-eight in one of its ways: velocity, the same without the radius [m/s], position [m].
    fn way(&self, way: usize) -> [f64; 3] {
        let of = |what: fn(&TrackingError) -> f64| rms(self.ways.iter().filter_map(|ways| ways.get(way)).map(what));
        [of(|e| e.velocity), of(|e| e.apart), of(|e| e.position)]
    }

    /// The mean error of ramps [1], and the worst by size.
    fn error(&self, axis: usize, level: usize, braking: bool) -> [f64; 2] {
        let is = |r: &&Ramp| r.axis == axis && r.level == level && r.braking == braking;
        let errors: Vec<f64> = self.ramps.iter().flatten().filter(is).map(Ramp::error).collect();
        let worst = errors.iter().fold(0.0_f64, |most, e| if e.abs() > most.abs() { *e } else { most });
        [errors.iter().sum::<f64>() / errors.len() as f64, worst]
    }

    /// What is promised of it.
    pub fn promises(&self) -> Vec<Promise> {
        let mut all = Vec::new();
        let mut promise = |kept: bool, what: String| all.push(Promise { what: format!("{}: {what}", self.name), kept });
        for (seed, ramp) in self.ramps.iter().enumerate().flat_map(|(k, r)| r.iter().map(move |r| (k + 1, r))) {
            let error = ramp.error();
            let what = format!("{:+.2} along {}, seed {seed}: {:+.2} %", ramp.wanted, AXES[ramp.axis], 100.0 * error);
            promise(error.abs() <= ACCELERATION, what);
        }
        let [with, without] = self.eight();
        for (k, of) in ["velocity", "position"].into_iter().enumerate() {
            let ratio = with[k] / without[k];
            promise(ratio <= RATIO, format!("figure-eight, {of}: {ratio:.3} of the error of feedback alone"));
        }
        let ([_, before, _], [_, after, _]) = (self.way(0), self.way(WAYS.len() - 1));
        let what =
            format!("figure-eight by ramps, velocity, radius apart: {:.1} of {:.1} mm/s", 1e3 * after, 1e3 * before);
        promise(after <= BY_RAMPS * before, what);
        for (k, [scaled, clipped]) in self.saturations.iter().enumerate() {
            let bites = scaled.time > 0.05 && clipped.time > 0.05;
            promise(bites, format!("saturation, seed {}: {scaled:?} and {clipped:?} for a while", k + 1));
        }
        // together, as the figure-eight: a seed whose clipped wheels happen to point the right way says little
        let [scaled, clipped] = [0, 1].map(|k| rms(self.saturations.iter().map(|pair| pair[k].rms)));
        promise(scaled < 0.5 * clipped, format!("saturation: {scaled:.4} rad against {clipped:.4} of wheels clipped"));
        for (k, s) in self.silences.iter().enumerate() {
            let kept = s.opens <= OPENS && s.rests <= RESTS && s.reported && s.drives_on && s.drives_again;
            promise(kept, format!("silence, seed {}: {s:?}", k + 1));
        }
        all
    }

    fn write(&self, page: &mut String) {
        let mut line = |text: String| writeln!(page, "{text}").expect("a string takes all");
        line(format!("\n## {}\n", self.name));
        line("Acceleration, true over wanted less one [%]: mean over the seeds, and the worst of them.\n".into());
        line("| wanted [m/s²] | axis | starting: mean | worst | braking: mean | worst |".into());
        line("|---|---|---|---|---|---|".into());
        for (level, [wanted, _]) in LEVELS.iter().enumerate() {
            for (axis, name) in AXES.iter().enumerate() {
                let [[a, b], [c, d]] = [false, true].map(|braking| self.error(axis, level, braking).map(|e| 100.0 * e));
                line(format!("| {wanted} | {name} | {a:+.1} | {b:+.1} | {c:+.1} | {d:+.1} |"));
            }
        }
        line("\nRadius and distance of the wheels are off by [%], which no feedback from wheels can see:\n".into());
        let row = |title: &str, cells: &mut dyn Iterator<Item = String>| {
            format!("| {title} | {} |", cells.collect::<Vec<_>>().join(" | "))
        };
        let seeds = 1..=self.geometry.len();
        line(row("seed", &mut seeds.clone().map(|k| k.to_string())));
        line(row("---", &mut seeds.map(|_| "---".into())));
        for (k, name) in ["radius", "distance"].into_iter().enumerate() {
            line(row(name, &mut self.geometry.iter().map(|off| format!("{:+.1}", 100.0 * off[k]))));
        }
        line("\nFigure-eight at 1 m/s: root mean square of what the robot is off the path, over the lap.\n".into());
        line("| seed | velocity [mm/s] | feedback alone | ratio | position [mm] | feedback alone | ratio |".into());
        line("|---|---|---|---|---|---|---|".into());
        let mut eight = |name: String, [[v, p], [v0, p0]]: [[f64; 2]; 2]| {
            let [a, b, c, d] = [v, v0, p, p0].map(|x| 1e3 * x);
            line(format!("| {name} | {a:.1} | {b:.1} | {:.2} | {c:.1} | {d:.1} | {:.2} |", v / v0, p / p0));
        };
        for (k, e) in self.eights.iter().enumerate() {
            eight((k + 1).to_string(), e.map(|e| [e.velocity, e.position]));
        }
        eight("all".into(), self.eight());
        line("\nThe same over all seeds, in other ways: what commands tell, the largest acceleration, and k_i. *Apart* is the velocity error".into());
        line("without what wheels of another radius than believed do to the speed.\n".into());
        line(
            "| commands | largest acceleration [m/s²] | k_i [A/rad] | velocity [mm/s] | apart [mm/s] | position [mm] |"
                .into(),
        );
        line("|---|---|---|---|---|---|".into());
        for (k, way) in WAYS.iter().enumerate() {
            let commands = if way.commands == Commands::Twist { "twist" } else { "twist and acceleration" };
            let [velocity, apart, position] = self.way(k).map(|x| 1e3 * x);
            let set = format!("{} | {}", way.acceleration, way.integral);
            line(format!("| {commands} | {set} | {velocity:.1} | {apart:.1} | {position:.1} |"));
        }
        line(
            "\nDiagonal into saturation: angle between true and wanted acceleration while not all of it fits [°].\n"
                .into(),
        );
        line("| seed | headroom: rms | most | for [ms] | each wheel clipped: rms | most | for [ms] |".into());
        line("|---|---|---|---|---|---|---|".into());
        for (k, both) in self.saturations.iter().enumerate() {
            let [s, c] =
                both.map(|x| format!("{:.1} | {:.1} | {:.0}", x.rms.to_degrees(), x.most.to_degrees(), 1e3 * x.time));
            line(format!("| {} | {s} | {c} |", k + 1));
        }
        line("\nCommands end at 1 m/s; 350 ms later one came again, and then none any more.\n".into());
        line(
            "| seed | slowed down to [m/s] | speed [m/s] | at rest after 200 ms and [ms] | bridges open after [ms] |"
                .into(),
        );
        line("|---|---|---|---|---|".into());
        for (k, s) in self.silences.iter().enumerate() {
            line(format!(
                "| {} | {:.2} | {:.2} | {:.0} | {:.0} |",
                k + 1,
                s.braked_to,
                s.speed,
                1e3 * s.rests,
                1e3 * s.opens,
            ));
        }
    }
}

/// The whole page.
pub fn page(robots: &[Robot], emulated: &[Emulated]) -> String {
    let mut page = format!(
        "# The robot's program in the loop\n\n\
         Made by `cargo xtask pil`; to rewrite it, `BLESS=1 cargo xtask pil`. The program drives a robot that is not what its \
         parameter\nblock says: every number is off by a draw of its stated uncertainty (mass, radius, distance 1 %; K_v, K_t \
         3 %; R, inertia 10 %;\nfriction 20 %), the battery has {} Ω, the converters have 12 bits, offsets and noise, the hall \
         switches sit up to {:.0}° (electrical)\noff their places and are all that tells of speeds, and duties act a period \
         late. Gains: {} A·s/rad, {} A/rad, currents {} rad/s.\n\n\
         Promised: every acceleration within ±{:.0} %; the figure-eight, over all seeds, with at most {} of the error of the same \
         loop\nwithout the model's feedforward, and by commands with acceleration and a quick integral with at most {} of its velocity error, the\nradius of the wheels apart; in saturation, over all seeds, less than half the angle of wheels clipped by \
         themselves;\nfrom 1 m/s at rest {:.0} ms after the end of 200 ms without a command at the latest, and bridges open {:.0} ms after the \
         last\ncommand. Accelerations are slopes of the true speed over the middle half of a ramp; those about the vertical are \
         meant at\nthe wheels' rims.\n",
        robots::SAG,
        robots::HALL_SPREAD.to_degrees(),
        robots::FEEDBACK,
        robots::FEEDBACK_INTEGRAL,
        robots::BANDWIDTH,
        100.0 * ACCELERATION,
        RATIO,
        BY_RAMPS,
        1e3 * RESTS,
        1e3 * OPENS,
    );
    robots.iter().for_each(|robot| robot.write(&mut page));
    page += "\n## The image in the emulator\n\nSeed 1 of every scenario, on four wheels and, but for two axes, on three, and one scenario again. The records are those of the same \
             library on the host, bit for bit, load and\njitter apart; those of the repetition are the same with them. One \
             instruction is one nanosecond there.\n\n| run | records | load [‰] | jitter [cycles] |\n|---|---|---|---|\n";
    for run in emulated {
        let [load, jitter] = run.load;
        writeln!(page, "| {} | {} | {load} | {jitter} |", run.name, run.records).expect("a string takes all");
    }
    page
}

/// Where a page differs from the one that was blessed: other words, or numbers off by more than a share and two of the
/// last digit: other machines round sines and logarithms differently, and noise goes its own way from there.
pub fn differences(blessed: &str, now: &str, share: f64) -> Vec<String> {
    golden::lines(blessed, now, |old, new| {
        let (a, b): (Vec<&str>, Vec<&str>) = (old.split_whitespace().collect(), new.split_whitespace().collect());
        a.len() == b.len() && a.iter().zip(&b).all(|(a, b)| near(a, b, share))
    })
}

/// The same word, or a number that is near.
fn near(a: &str, b: &str, share: f64) -> bool {
    let (Ok(x), Ok(y)) = (a.parse::<f64>(), b.parse::<f64>()) else { return a == b };
    let digits = a.split_once('.').map_or(0, |(_, after)| after.len());
    (x - y).abs() <= share * x.abs() + 2.01 * 0.1_f64.powi(digits as i32)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pages_differ_where_words_do_or_numbers_by_more_than_their_share() {
        assert!(differences("| a | +1.0 | 200 |", "| a | +1.2 | 208 |", 0.05).is_empty());
        assert!(differences("| a | +0.1 |", "| a | -0.1 |", 0.05).is_empty());
        assert_eq!(differences("| a | +1.0 |", "| a | +1.3 |", 0.05).len(), 1);
        assert_eq!(differences("| a | 1 |", "| b | 1 |", 0.05).len(), 1);
        assert_eq!(differences("a", "a\nb", 0.05), ["line 2:\n  - \n  + b"]);
    }
}
