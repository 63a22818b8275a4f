//! # Hall tracker: where the rotor is between edges whose places are known
//!
//! ```text
//! every period              x += ω_e                       ω_e that of the halls, in angle a period
//! no edge was crossed       x = min(x, width)              it would have been
//! an edge was crossed       x = clamp(x − width, 0, ω_e)   in the last period, so not further than that
//! first of all              x = ω_e·(t₀ + ½)
//! θ = edge + s·(x − ω_e·ε)                                 from the edge by which the sector was entered
//! ```
//!
//! The switches are read once a period, so that an edge is known to a period. [`crate::control::halls`] takes the middle,
//! because edges that may stand 5° out of their places say no more. Where the places are known the edges bound the rotor
//! from both sides, and each is used for what it says: the angle goes on with the mean speed and is moved by an edge only
//! if it contradicts it. At steady speed the edges fall differently between the readings each time, and after some of
//! them the angle is known to a fraction of a period.
//!
//! Neglects: hysteresis of the switches, by which an edge lies half of it on in either direction. Fails when: the places
//! are not those of the motor; the angle is then off by as much, and by a period at most beyond it.
//!
//! Source: bounds of what was seen (set membership), as interval observers have them; here with an interval of one
//! period.

use crate::control::halls::{HALL_PARTS, HallDecoder};

/// Where the sectors begin, forward [2⁻¹⁶ turn].
// eight, so that three bits are an index
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct HallEdges([u16; 8]);

impl HallEdges {
    /// Sectors that begin there.
    pub fn new(begins: [u16; 6]) -> Self {
        Self(core::array::from_fn(|k| begins[k % 6]))
    }

    /// Where a sector begins, and its width [2⁻³² turn].
    #[inline]
    fn sector(&self, sector: u8) -> (u32, u32) {
        let begin = |k: u8| u32::from(self.0[usize::from(k & 7)]) << 16;
        // behind the last stands the first
        (begin(sector), begin(sector + 1).wrapping_sub(begin(sector)))
    }
}

/// The rotor's way through its sector, followed from period to period.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct HallTracker {
    /// x, from the edge by which it was entered [2⁻³² turn]
    within: u32,
    /// Where the sector begins, forward, and its width [2⁻³² turn]
    begin: u32,
    width: u32,
    /// True while the speed is known
    moves: bool,
}

impl HallTracker {
    /// Once a period, after the halls were followed.
    #[inline]
    pub fn update(&mut self, halls: &HallDecoder, edges: &HallEdges) {
        // at most a sixth of a turn, so that no sum below is a whole one
        let step = halls.step();
        if step == 0 || !self.moves {
            let (begin, width) = edges.sector(halls.sector());
            // x = ω_e·(t₀ + ½); the middle where the speed is not known
            let first = step.saturating_mul(u32::from(halls.since_edge())).saturating_add(step / 2).min(width);
            let within = if step == 0 { width / 2 } else { first };
            *self = Self { within, begin, width, moves: step != 0 };
        } else if halls.since_edge() == 0 {
            // x = clamp(x − width, 0, ω_e)
            let beyond = self.within.wrapping_add(step).saturating_sub(self.width).min(step);
            let (begin, width) = edges.sector(halls.sector());
            *self = Self { within: beyond.min(width), begin, width, moves: true };
        } else {
            // x = min(x, width)
            self.within = self.within.wrapping_add(step).min(self.width);
        }
    }

    /// θ a little before the halls were read [2⁻¹⁶ turn]; `before` is ε in parts of which [`HALL_PARTS`] are a period.
    #[inline]
    pub fn angle_code_before(&self, halls: &HallDecoder, before: u32) -> u16 {
        // θ = edge + s·(x − ω_e·ε)
        let way = self.within.wrapping_sub(halls.step() / HALL_PARTS * before);
        let angle = if halls.is_backwards() {
            self.begin.wrapping_add(self.width).wrapping_sub(way)
        } else {
            self.begin.wrapping_add(way)
        };
        (angle.wrapping_add(1 << 15) >> 16) as u16
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::control::halls::HallCode;
    use crate::control::wiring::nominal_edge;
    use core::f64::consts::TAU;

    /// Places of the edges, each off its place by so much [°].
    const OFF: [f64; 6] = [4.0, -5.0, 2.0, -1.0, 5.0, -3.0];

    fn edges() -> HallEdges {
        HallEdges::new(core::array::from_fn(|k| {
            nominal_edge(k as u8).wrapping_add((OFF[k] * 65_536.0 / 360.0).round() as i32 as u16)
        }))
    }

    fn code_at(angle: f64) -> HallCode {
        let turn = (angle / TAU).rem_euclid(1.0) * 65_536.0;
        let sector = (0..6).find(|k| {
            let (begin, width) = edges().sector(*k);
            ((turn * 65_536.0) as u32).wrapping_sub(begin) < width
        });
        HallCode::of_sector(sector.unwrap())
    }

    /// The largest error of an angle over many turns at a speed [rad a period], after it has settled.
    fn worst(speed: f64, angle: impl Fn(&HallTracker, &HallDecoder) -> u16) -> f64 {
        let mut at = 1.0;
        let (mut halls, mut tracker) = (HallDecoder::new(code_at(at)).unwrap(), HallTracker::default());
        let mut worst = 0.0_f64;
        for period in 0..20_000 {
            at += speed;
            halls.update(code_at(at)).unwrap();
            tracker.update(&halls, &edges());
            let told = f64::from(angle(&tracker, &halls)) * TAU / 65_536.0;
            let error = (told - at + TAU / 2.0).rem_euclid(TAU) - TAU / 2.0;
            if period > 2_000 {
                worst = worst.max(error.abs());
            }
        }
        worst
    }

    #[test]
    fn at_steady_speed_the_angle_is_nearer_than_a_reading_that_starts_anew_at_each_edge() {
        for speed in [0.251, 0.0937, -0.2003, 0.0101] {
            let tracked = worst(speed, |tracker, halls| tracker.angle_code_before(halls, 0));
            let anew = worst(speed, |_, halls| halls.angle_code());
            // half a period and 5° of place at the least; tracked: the speed of a turn known to a period
            assert!(tracked < 0.5 * speed.abs() + 0.01, "{speed}: {tracked}");
            assert!(anew > 2.0 * tracked, "{speed}: {anew} and {tracked}");
        }
    }

    #[test]
    fn a_rotor_whose_speed_is_not_known_is_in_the_middle_of_its_sector() {
        let halls = HallDecoder::new(HallCode::of_sector(2)).unwrap();
        let mut tracker = HallTracker::default();
        tracker.update(&halls, &edges());
        let (begin, width) = edges().sector(2);
        assert_eq!(u32::from(tracker.angle_code_before(&halls, 0)), begin.wrapping_add(width / 2).div_ceil(1 << 16));
    }

    #[test]
    fn a_rotor_that_is_late_waits_at_the_end_of_its_sector() {
        let mut halls = HallDecoder::new(HallCode::of_sector(0)).unwrap();
        let mut tracker = HallTracker::default();
        for sector in [1, 2, 3] {
            for wait in 0..10 {
                halls.update(HallCode::of_sector(if wait < 9 { sector - 1 } else { sector })).unwrap();
                tracker.update(&halls, &edges());
            }
        }
        for _ in 0..100 {
            halls.update(HallCode::of_sector(3)).unwrap();
            tracker.update(&halls, &edges());
        }
        assert_eq!(tracker.angle_code_before(&halls, 0), edges().0[4]);
    }
}
