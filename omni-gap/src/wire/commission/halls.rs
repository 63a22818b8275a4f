//! # Halls: the order of the codes and where their edges are, under a vector that turns slowly
//!
//! ```text
//! edge = (φ_forward + φ_back)/2,   lag = (φ_forward − φ_back)/2          the rotor is behind the vector by its friction
//! sin lag = τ_friction/τ_most
//! ```
//!
//! Neglects: cogging and a load that is not the same both ways, which move an edge by what they change of the lag. Hysteresis of
//! the switches cancels like friction.

use std::f64::consts::TAU;

use model_core::control::halls::HallCode;

/// What the halls of a motor do while the vector turns from output a to output b.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct HallsFound {
    /// The codes in the order in which they come
    pub codes: [HallCode; 6],
    /// Where each of them begins [2⁻¹⁶ turn]
    pub edges: [f64; 6],
    /// How far the rotor is behind the vector, in the mean [rad]
    pub lag: f64,
}

/// Why the codes fit no motor.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NoHalls {
    /// They did not change.
    Still,
    /// They changed, but not to six codes that follow each other in a ring; one bit a line that never changed.
    Order {
        /// Lines a = 1, b = 2, c = 4 that never changed
        stuck: u8,
    },
    /// Forward and back they follow each other in different orders.
    Back,
}

/// A way of the vector: where it stood [2⁻¹⁶ turn] and what the lines read.
pub type Way = [(f64, HallCode)];

impl HallsFound {
    /// By the way forward and the way back.
    ///
    /// # Errors
    /// [`NoHalls`] where that is no motor's answer.
    pub fn of(forward: &Way, back: &Way) -> Result<Self, NoHalls> {
        let codes = ring(forward)?;
        let mut found = Self { codes, ..Self::default() };
        for k in 0..6 {
            let pair = [codes[(k + 5) % 6], codes[k]];
            let (Some(there), Some(again)) = (crossing(forward, pair), crossing(back, pair)) else {
                return Err(NoHalls::Back);
            };
            // lag = (φ_forward − φ_back)/2, edge = φ_back + lag
            let lag = 0.5 * ((there - again + 0.5 * TAU).rem_euclid(TAU) - 0.5 * TAU);
            found.edges[k] = ((again + lag) * 65_536.0 / TAU).rem_euclid(65_536.0);
            found.lag += lag / 6.0;
        }
        if goes_round(&codes, back) { Ok(found) } else { Err(NoHalls::Back) }
    }

    /// The same seen by a motor for which forward is the other way: outputs b and c swapped.
    pub fn mirrored(&self) -> Self {
        // where code k began, forward, it ends, and what stands before it comes after
        Self {
            codes: std::array::from_fn(|k| self.codes[5 - k]),
            edges: std::array::from_fn(|k| (65_536.0 - self.edges[(6 - k) % 6]).rem_euclid(65_536.0)),
            lag: self.lag,
        }
    }

    /// Codes and edges by sectors: the one whose middle is nearest to output a is sector 0.
    pub fn sectors(&self) -> ([HallCode; 6], [u16; 6]) {
        let sector = 65_536.0 / 6.0;
        // by how much all the middles are on from k·60°, in the mean
        let on = mean_angle((0..6).map(|k| {
            let width = (self.edges[(k + 1) % 6] - self.edges[k]).rem_euclid(65_536.0);
            (self.edges[k] + 0.5 * width - sector * k as f64) * TAU / 65_536.0
        }));
        let turned = (on / (TAU / 6.0)).round().rem_euclid(6.0) as usize;
        let at = |k: usize| (k + 6 - turned) % 6;
        (
            std::array::from_fn(|k| self.codes[at(k)]),
            std::array::from_fn(|k| (self.edges[at(k)].round() as u32 % 65_536) as u16),
        )
    }
}

/// The ring of codes on a way.
fn ring(way: &Way) -> Result<[HallCode; 6], NoHalls> {
    let mut order: Vec<HallCode> = Vec::new();
    for (_, code) in way {
        if !order.contains(code) {
            order.push(*code);
        }
    }
    if order.len() < 2 {
        return Err(NoHalls::Still);
    }
    let changed = order.iter().fold(0, |changed, code| changed | (code.0 ^ order[0].0));
    let no_ring = NoHalls::Order { stuck: 7 & !changed };
    let codes = <[HallCode; 6]>::try_from(order).map_err(|_| no_ring)?;
    if goes_round(&codes, way) { Ok(codes) } else { Err(no_ring) }
}

/// True where each code on a way is followed by itself or by a neighbour in the ring.
fn goes_round(ring: &[HallCode; 6], way: &Way) -> bool {
    let are_neighbours = |one: HallCode, other: HallCode| {
        (0..6).any(|k| {
            let pair = (ring[k], ring[(k + 1) % 6]);
            pair == (one, other) || pair == (other, one)
        })
    };
    way.windows(2).all(|pair| pair[0].1 == pair[1].1 || are_neighbours(pair[0].1, pair[1].1))
}

/// Where two codes change into each other on a way, in the mean over all times [rad]; none where they do not.
fn crossing(way: &Way, [one, other]: [HallCode; 2]) -> Option<f64> {
    let mut met = way
        .windows(2)
        .filter(|pair| [(one, other), (other, one)].contains(&(pair[0].1, pair[1].1)))
        .map(|pair| 0.5 * (pair[0].0 + pair[1].0) * TAU / 65_536.0)
        .peekable();
    met.peek()?;
    Some(mean_angle(met))
}

/// The direction of the sum of unit vectors [rad].
fn mean_angle(angles: impl Iterator<Item = f64>) -> f64 {
    let (sin, cos) = angles.fold((0.0, 0.0), |(sin, cos), angle| (sin + angle.sin(), cos + angle.cos()));
    f64::atan2(sin, cos)
}

#[cfg(test)]
mod tests {
    use super::*;

    const PLAIN: [u8; 6] = [1, 3, 2, 6, 4, 5];
    /// Where the sectors begin [°].
    const EDGES: [f64; 6] = [327.0, 34.0, 88.0, 151.0, 214.0, 268.0];

    fn code_at(degrees: f64) -> HallCode {
        let inside =
            |k: &usize| (degrees - EDGES[*k]).rem_euclid(360.0) < (EDGES[(k + 1) % 6] - EDGES[*k]).rem_euclid(360.0);
        HallCode(PLAIN[(0..6).find(inside).unwrap()])
    }

    /// The vector from one angle to another in steps of 0.3°, the rotor so far behind it [°].
    fn way(from: f64, to: f64, lag: f64) -> Vec<(f64, HallCode)> {
        let steps = ((to - from).abs() / 0.3) as usize;
        let at = |k: usize| from + (to - from) * k as f64 / steps as f64;
        (0..=steps).map(|k| (at(k) / 360.0 * 65_536.0, code_at(at(k) - (to - from).signum() * lag))).collect()
    }

    #[test]
    fn the_lag_of_friction_cancels_and_is_told() {
        let found = HallsFound::of(&way(-60.0, 420.0, 20.0), &way(420.0, -60.0, 20.0)).unwrap();
        assert!((found.lag.to_degrees() - 20.0).abs() < 0.3, "{found:?}");
        let (codes, edges) = found.sectors();
        assert_eq!(codes.map(|code| code.0), PLAIN);
        for (edge, degrees) in edges.iter().zip(EDGES) {
            assert!((f64::from(*edge) * 360.0 / 65_536.0 - degrees).abs() < 0.2, "{edges:?}");
        }
    }

    #[test]
    fn a_motor_that_turns_the_other_way_has_the_ring_backwards() {
        let found = HallsFound::of(&way(-60.0, 420.0, 5.0), &way(420.0, -60.0, 5.0)).unwrap();
        let (codes, edges) = found.mirrored().sectors();
        assert_eq!(codes.map(|code| code.0), [1, 5, 4, 6, 2, 3]);
        // what ends sector 0 forward begins it backward
        for (edge, degrees) in edges.iter().zip([326.0, 33.0, 92.0, 146.0, 209.0, 272.0]) {
            assert!((f64::from(*edge) * 360.0 / 65_536.0 - degrees).abs() < 0.2, "{edges:?}");
        }
        assert_eq!(found.mirrored().mirrored().sectors(), found.sectors());
    }

    #[test]
    fn an_edge_on_which_it_trembles_is_one_edge() {
        let mut forward = way(-60.0, 420.0, 0.0);
        let at = forward.windows(2).position(|pair| pair[0].1 != pair[1].1).unwrap();
        (forward[at].1, forward[at + 1].1) = (forward[at + 1].1, forward[at].1);
        assert!(HallsFound::of(&forward, &way(420.0, -60.0, 0.0)).is_ok());
    }

    #[test]
    fn what_is_no_motor_is_told() {
        let still = vec![(0.0, HallCode(1)); 100];
        assert_eq!(HallsFound::of(&still, &still), Err(NoHalls::Still));
        let stuck = |way: Vec<(f64, HallCode)>| {
            way.into_iter().map(|(at, code)| (at, HallCode(code.0 | 2))).collect::<Vec<_>>()
        };
        let told = HallsFound::of(&stuck(way(-60.0, 420.0, 5.0)), &stuck(way(420.0, -60.0, 5.0)));
        assert_eq!(told, Err(NoHalls::Order { stuck: 2 }));
        let forward = way(-60.0, 420.0, 5.0);
        assert_eq!(HallsFound::of(&forward, &still), Err(NoHalls::Back));
    }
}
