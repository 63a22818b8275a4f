//! # Wiring: which lead of a motor is soldered where
//!
//! ```text
//! δ_out[x] = δ_x                                   phase x ∈ {a, b, c} hangs on output out[x]
//! n_x = n[conv[x]],  or 4095 − n[conv[x]]          its converter, and one whose code falls with the current
//! sector of a code: k where codes[k] is the code   rotor's flux between edge k and edge k + 1
//! edge k nominal: k·60° − 30°
//! ```
//!
//! A board that is wired as its table of pins says needs none of this; it is what a commissioning finds of one that is not.
//! Everything is put right where codes come in and duties go out, so that no law behind it knows of wires: a code that
//! falls is turned round about the middle of the range and is then one that rises, a hall code is put into the one that
//! the sequence of [`crate::control::halls`] has for its sector.
//!
//! Only two orders of the outputs are needed, forward and with two swapped: a motor whose three leads are moved on in a
//! ring turns the same way, with its edges a third of a turn on.
//!
//! Source: definitions.

use crate::control::calibration::{AdcCode, FULL_SCALE};
use crate::control::halls::HallCode;

/// How one motor is wired.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MotorWiring {
    /// The output that phases a, b and c hang on
    pub outputs: [u8; 3],
    /// The converter that measures their currents
    pub converters: [u8; 3],
    /// True where its code falls with the current into the motor
    pub inverted: [bool; 3],
    /// The hall code of every sector
    pub codes: [HallCode; 6],
    /// Where each sector begins, forward [2⁻¹⁶ turn]
    pub edges: [u16; 6],
}

/// Where the phases of one motor go: what codes and duties are put right with, every period.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MotorLeads {
    outputs: [u8; 3],
    converters: [u8; 3],
    /// What turns a code round, or nothing
    turns: [u16; 3],
}

impl MotorLeads {
    /// The codes of phases a, b, c of what the converters read.
    #[inline]
    pub fn phases(&self, [a, b, c]: [AdcCode; 3]) -> [AdcCode; 3] {
        // four, so that two bits are an index
        let read = [a, b, c, AdcCode(0)];
        let of = |x: usize| {
            let AdcCode(code) = read[usize::from(self.converters[x] & 3)];
            // n_x = 4095 − n, which of twelve bits is each of them turned
            AdcCode(code ^ self.turns[x])
        };
        [of(0), of(1), of(2)]
    }

    /// The duties of the outputs that give phases a, b, c theirs.
    #[inline]
    pub fn duties(&self, [a, b, c]: [f32; 3]) -> [f32; 3] {
        let mut duties = [0.0; 4];
        for (output, duty) in self.outputs.into_iter().zip([a, b, c]) {
            // δ_out[x] = δ_x
            duties[usize::from(output & 3)] = duty;
        }
        let [a, b, c, _] = duties;
        [a, b, c]
    }
}

impl Default for MotorWiring {
    /// As the table of pins says.
    fn default() -> Self {
        Self {
            outputs: [0, 1, 2],
            converters: [0, 1, 2],
            inverted: [false; 3],
            codes: core::array::from_fn(|k| HallCode::of_sector(k as u8)),
            edges: core::array::from_fn(|k| nominal_edge(k as u8)),
        }
    }
}

/// Where a sector begins if all switches are in their places [2⁻¹⁶ turn].
pub fn nominal_edge(sector: u8) -> u16 {
    // k·60° − 30° = (2·k − 1)·2¹⁶/12, rounded
    ((i32::from(sector % 6) * 2 - 1) * 65_536 + 6).div_euclid(12) as u16
}

/// The furthest that an edge may lie from its place [2⁻¹⁶ turn]: 45°, half a sector for switches that are all moved and 15°
/// for each.
pub const MOST_EDGE_ERROR: u16 = 8192;

impl MotorWiring {
    /// True where it is some wiring: each lead once, each code once, the edges in their order and near their places.
    pub fn is_possible(&self) -> bool {
        let each_once = |order: [u8; 3]| (0..3).all(|lead| order.contains(&lead));
        let codes = self.codes.iter().fold(0_u16, |seen, code| seen | 1 << (code.0 & 15));
        let in_order = (0..6_usize).all(|k| {
            let width = self.edges[(k + 1) % 6].wrapping_sub(self.edges[k]);
            let error = self.edges[k].wrapping_sub(nominal_edge(k as u8)).cast_signed();
            // forward, by less than half a turn
            0 < width && width < 32_768 && error.unsigned_abs() <= MOST_EDGE_ERROR
        });
        each_once(self.outputs)
            && each_once(self.converters)
            && codes & !0xff == 0
            && codes.count_ones() == 6
            && in_order
    }

    /// Its leads alone.
    pub fn leads(&self) -> MotorLeads {
        let Self { outputs, converters, inverted, .. } = *self;
        MotorLeads { outputs, converters, turns: inverted.map(|inverted| if inverted { FULL_SCALE } else { 0 }) }
    }

    /// The code that stands for a line's code in [`crate::control::halls`], by that code; 0 for one that no sector gives.
    pub fn hall_table(&self) -> [HallCode; 8] {
        let mut table = [HallCode(0); 8];
        for (sector, code) in self.codes.into_iter().enumerate() {
            if let Some(slot) = table.get_mut(usize::from(code.0)) {
                *slot = HallCode::of_sector(sector as u8);
            }
        }
        table
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const CROSSED: MotorWiring = MotorWiring {
        outputs: [0, 2, 1],
        converters: [2, 0, 1],
        inverted: [true, false, true],
        codes: [HallCode(6), HallCode(4), HallCode(5), HallCode(1), HallCode(3), HallCode(2)],
        edges: [60_000, 5_500, 16_000, 27_000, 38_500, 49_000],
    };

    #[test]
    fn a_board_without_mistakes_changes_nothing() {
        let plain = MotorWiring::default();
        assert!(plain.is_possible());
        let codes = [1, 2049, 4095].map(AdcCode);
        assert_eq!((plain.leads().phases(codes), plain.leads().duties([0.1, 0.2, 0.3])), (codes, [0.1, 0.2, 0.3]));
        for code in (0..8).map(HallCode) {
            let same = if code.sector().is_some() { code } else { HallCode(0) };
            assert_eq!(plain.hall_table()[usize::from(code.0)], same);
        }
    }

    #[test]
    fn leads_come_back_to_where_they_belong() {
        assert!(CROSSED.is_possible());
        assert_eq!(CROSSED.leads().duties([0.1, 0.2, 0.3]), [0.1, 0.3, 0.2]);
        // phase a is read by converter c, turned round: 4095 − 2148 = 1947
        assert_eq!(CROSSED.leads().phases([2000, 0, 2148].map(AdcCode)), [1947, 2000, 4095].map(AdcCode));
        for (sector, code) in CROSSED.codes.iter().enumerate() {
            assert_eq!(CROSSED.hall_table()[usize::from(code.0)].sector(), Some(sector as u8));
        }
        assert_eq!([0, 7].map(|code| CROSSED.hall_table()[code].sector()), [None, None]);
    }

    #[test]
    fn nominal_edges_are_half_a_sector_before_the_middles() {
        for sector in 0..6 {
            let degrees = f64::from(nominal_edge(sector)) * 360.0 / 65_536.0;
            assert!((degrees - (f64::from(sector) * 60.0 + 330.0) % 360.0).abs() < 0.003, "{sector}: {degrees}");
        }
    }

    #[test]
    fn what_is_no_wiring_is_told() {
        let wrong = [
            MotorWiring { outputs: [0, 0, 1], ..CROSSED },
            MotorWiring { converters: [0, 1, 3], ..CROSSED },
            MotorWiring { codes: [HallCode(1); 6], ..CROSSED },
            MotorWiring { codes: CROSSED.codes.map(|code| HallCode(code.0 + 8)), ..CROSSED },
            MotorWiring { edges: [60_000, 60_000, 16_000, 27_000, 38_500, 49_000], ..CROSSED },
            MotorWiring { edges: CROSSED.edges.map(|edge| edge.wrapping_add(9_000)), ..CROSSED },
        ];
        assert!(wrong.iter().all(|wiring| !wiring.is_possible()));
    }
}
