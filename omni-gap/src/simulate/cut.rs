//! A run in parts, each begun where it is known how fast the robot goes.
//!
//! Nothing before a part is simulated, so that it begins with what was measured around its first row. Hall edges tell no speed
//! of a wheel that hardly turns: a part that begins while the other wheels turn would begin at rest, and all of its first
//! windows with it. So the place of a cut is looked for around its equal share of the run.

use super::aligned_run::AlignedRun;
use super::start::begins_known;

/// How far from its equal share a cut is looked for, as a part of a part [1].
const LOOKED: f64 = 0.25;

/// The run cut into `parts` of about equal length, each beginning on a row of the driving signal.
pub fn cut<const N: usize>(run: &AlignedRun<N>, parts: usize) -> Vec<AlignedRun<N>> {
    let rows = run.rows();
    let driven_from = |row: usize| (row..rows).find(|row| run.driven[*row]).unwrap_or(rows);
    let apart = (LOOKED * rows as f64 / parts as f64) as usize;
    let place = |k: usize| match driven_from(k * rows / parts) {
        row if k == 0 || row == rows => row,
        row => known_near(run, row, apart),
    };
    let places: Vec<usize> = (0..=parts).map(place).collect();
    places.windows(2).filter(|ends| ends[1] > ends[0]).map(|ends| run.part(ends[0]..ends[1])).collect()
}

/// The nearest row of the driving signal that a run may begin at, or the row itself where there is none as near as `apart`.
fn known_near<const N: usize>(run: &AlignedRun<N>, row: usize, apart: usize) -> usize {
    let may = |other: &usize| run.driven[*other] && begins_known(run, *other);
    let both = |off: usize| [row.checked_sub(off), Some(row + off).filter(|after| *after < run.rows())];
    (0..=apart).flat_map(both).flatten().find(may).unwrap_or(row)
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;
    use crate::log::{Catalogue, Channel, Group, RobotFile, Run};

    /// Nine seconds at a hundred rows each. Speeds of wheels 0 and 2 are told all along, those of the others from `told_s` on.
    fn run(told_s: f64) -> AlignedRun<4> {
        let text = include_str!("../../robots/feup-4w/robot.toml");
        let robot = RobotFile::parse(text, Path::new("robot.toml"), &Catalogue::default()).unwrap();
        let t_s: Vec<f64> = (0..900).map(|row| f64::from(row) / 100.0).collect();
        let speed = |wheel: usize| {
            let told = |t: &f64| if wheel.is_multiple_of(2) || *t >= told_s { 5.0 } else { f64::NAN };
            Channel::from_values(t_s.iter().map(told))
        };
        let u = Group::new((0..4).map(|_| Channel::from_values(t_s.iter().map(|_| 3.0))).collect());
        let w = Group::new((0..4).map(speed).collect());
        AlignedRun::new(&Run { t_s, u: Some(u), w: Some(w), ..Run::default() }, &robot).unwrap()
    }

    fn rows(parts: &[AlignedRun<4>]) -> Vec<usize> {
        parts.iter().map(AlignedRun::rows).collect()
    }

    #[test]
    fn where_all_speeds_are_told_the_parts_are_equal() {
        assert_eq!(rows(&cut(&run(0.0), 3)), [300, 300, 300]);
    }

    #[test]
    fn a_part_begins_where_the_speeds_of_all_wheels_are_told() {
        // the first of the others is a row away from what is told: the next sample is due
        assert_eq!(rows(&cut(&run(3.5), 3)), [349, 251, 300]);
    }

    #[test]
    fn where_they_are_told_nowhere_near_a_part_begins_at_its_share() {
        assert_eq!(rows(&cut(&run(5.0), 3)), [300, 300, 300]);
    }
}
